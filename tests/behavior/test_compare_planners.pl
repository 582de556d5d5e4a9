% Planners side by side: is what is printed and drawn what they did?

:- asserta(user:file_search_path(library, prolog)).
:- asserta(user:file_search_path(example, examples)).
:- use_module(library(ev3dev/planners)).
:- use_module(library(ev3dev/roadmap), []).

:- initialization(load_files(compare:example(compare_planners), [])).

:- begin_tests(compare_planners).
map(Options, Map) :-
    grid_map([rows([".....#.", ".###.#.", "...#.#.", "^..#..."])|Options],
             Map).

compared(Options, Output, Runs) :-
    map([], Map),
    with_output_to(string(Output),
                   compare_planners(Map, state([6,3], _),
                                    [runs(Runs)|Options])).

test(prints_a_line_for_each) :-
    compared([], Output, Runs),
    length(Runs, 10),
    split_string(Output, "\n", "", Lines),
    length(Lines, 12),
    forall(( planner(Planner), format(string(Name), "~w ", [Planner]) ),
           ( member(Line, Lines), string_concat(Name, _, Line) )).
test(knows_what_is_known, Replans == [0]) :-
    compared([known(true)], _, Runs),
    findall(R, ( member(run(_, Facts), Runs), option(replans(R), Facts) ), Rs),
    sort(Rs, Replans).
% 15 moves of 20, with 4 turns of 10.
test(the_best_plans_cost_the_same, Costs == [340]) :-
    compared([known(true)], _, Runs),
    findall(Cost,
            ( member(run(Planner, Facts), Runs),
              planner_claim(Planner, least_cost),
              option(cost(Cost), Facts)
            ),
            Costs0),
    sort(Costs0, Costs).
test(has_to_replan_on_an_unknown_map) :-
    compared([], _, Runs),
    forall(member(run(_, Facts), Runs),
           ( option(replans(Replans), Facts), Replans > 0 )).
test(repairing_expands_least) :-
    compared([planners([d_star_lite, dijkstra])], _,
            [run(_, Repaired), run(_, Again)]),
    option(expanded(R), Repaired),
    option(expanded(A), Again),
    R < A.
test(roadmaps_are_beside_them,
     true(Costs == [visibility-true, prm-true, rrt-true, rrt_bidirectional-true, rrt_star-true])) :-
    findall(roadmap(M), member(M, [visibility, prm, rrt, rrt_bidirectional, rrt_star]), Roadmaps),
    compared([known(true), planners([a_star|Roadmaps])], Output, [run(a_star, Facts)|Runs]),
    option(cost(Best), Facts),
    % Around corners it is shorter, but chance makes detours.
    findall(M-Is,
            ( member(run(roadmap(M), Facts1), Runs),
              option(cost(Cost), Facts1), option(expanded(E), Facts1), option(steps(S), Facts1),
              ( Cost > 0.6 * Best, Cost < 1.3 * Best, E >= S, S > 4 -> Is = true ; Is = Cost ) ),
            Costs),
    once(sub_string(Output, _, _, _, "roadmap(rrt_bidirectional) ")).
test(a_roadmap_without_a_way_has_no_cost, Missing == true) :-
    grid_map([rows([".#.", "^#."])], Map),
    with_output_to(string(_),
                   compare_planners(Map, state([2,0], _),
                                    [runs([run(_, Facts)]), planners([roadmap(rrt)])])),
    ( option(cost(_), Facts) -> Missing = false ; Missing = true ).
test(a_roadmap_counts_the_turns_on_the_spot, Cost == 80) :-
    grid_map([rows(["....", "...."])], Map),
    with_output_to(string(_),
                   compare_planners(Map, state([0,0], _),
                                    [ runs([run(_, Facts)]), planners([roadmap(rrt)]),
                                      start(state([3,0], [1,0])) ])),
    % 60 cm, and half a turn before
    option(cost(Cost), Facts).
test(a_roadmap_is_drawn, Count == 1) :-
    tmp_file(planners, File),
    setup_call_cleanup(
        true,
        ( compared([planners([roadmap(rrt)]), svg(File)], _, _),
          read_file_to_string(File, Text, []) ),
        delete_file(File)),
    occurrences(Text, "<polyline", Count).
test(a_roadmap_of_no_method, error(domain_error(roadmap_method, x), _)) :-
    compared([planners([roadmap(x)])], _, _).
test(only_those_asked_for, Planners == [greedy_best_first, a_star]) :-
    compared([planners([greedy_best_first, a_star])], _, Runs),
    findall(Planner, member(run(Planner, _), Runs), Planners).
test(no_way_has_no_cost, Missing == 10) :-
    grid_map([rows([".#.", "^#."])], Map),
    with_output_to(string(Output),
                   compare_planners(Map, state([2,0], _), [runs(Runs)])),
    forall(member(run(_, Facts), Runs), \+ option(cost(_), Facts)),
    split_string(Output, "\n", " ", Lines),
    aggregate_all(count,
                  ( member(Line, Lines), string_concat(_, " -", Line) ),
                  Missing).
% A cell is drawn as blue as often it was expanded: where nothing was, white.
test(draws_what_was_expanded) :-
    tmp_file(planners, File),
    setup_call_cleanup(
        true,
        ( compared([planners([dijkstra, greedy_best_first]), svg(File)], _, _),
          read_file_to_string(File, Text, []) ),
        delete_file(File)),
    occurrences(Text, "<rect", 57),         % 2 * 28 cells, and all around
    occurrences(Text, "fill=\"#444\"", 16),
    occurrences(Text, "<polyline", 2),
    occurrences(Text, "rgb(", Blue),
    Blue > 24,
    occurrences(Text, "fill=\"#fff\"", White),
    Blue + White =:= 56 - 16 + 1,
    once(sub_string(Text, _, _, _, ">dijkstra<")).
test(the_example_compares) :-
    tmp_file(compare, Directory),
    make_directory(Directory),
    working_directory(Here, Directory),
    setup_call_cleanup(
        true,
        ( with_output_to(string(Output), compare:start),
          exists_file('planners_known.svg'),
          exists_file('planners_unknown.svg') ),
        ( working_directory(_, Here),
          delete_directory_and_contents(Directory) )),
    occurrences(Output, "d_star_lite", 2).
test(planner_is_none, error(domain_error(planner, x), _)) :-
    compared([planners([x])], _, _).
test(known_is_no_boolean, error(type_error(_, perhaps), _)) :-
    compared([known(perhaps)], _, _).
test(an_option_that_is_none,
     [ forall(member(Option, [know(true), planner(a_star), x])),
       error(domain_error(planner_option, Option), _) ]) :-
    compared([Option], _, _).
test(options_are_no_list, error(type_error(list, x), _)) :-
    map([], Map),
    compare_planners(Map, state([6,3], _), x).
test(goal_is_none, error(domain_error(grid_state, x), _)) :-
    map([], Map),
    compare_planners(Map, x, []).
test(picture_cannot_be_written,
     error(existence_error(_, '/nowhere/at/all.svg'), _)) :-
    compared([planners([a_star]), svg('/nowhere/at/all.svg')], _, _).

occurrences(Text, Part, Count) :-
    aggregate_all(count, sub_string(Text, _, _, _, Part), Count).
:- end_tests(compare_planners).
