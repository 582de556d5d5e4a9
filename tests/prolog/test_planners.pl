% Planners: what they claim holds, on many random maps.

:- asserta(user:file_search_path(library, prolog)).
:- use_module('../support/cases').
:- use_module('../support/old_prolog').
:- use_module(library(ev3dev/planners)).
:- use_module(library(assoc)).

%   A random map with start and goal, the same for the same Seed: three to
%   ten cells each way, up to 45 % of them obstructed.

task(Seed, Options, task(Map, Start, Goal)) :-
    set_random(seed(Seed)),
    random_between(2, 9, X2),
    random_between(2, 9, Y2),
    random(R),
    Share is 0.45 * R,
    random_member(Neighbors, [4, 8]),
    findall([X, Y],
            ( between(0, X2, X), between(0, Y2, Y), maybe(Share) ),
            Cells),
    grid_map([ bounds(0, 0, X2, Y2), obstacles(Cells),
               neighbors(Neighbors)
             | Options
             ], Map),
    random_state(Map, Start),
    random_state(Map, Goal).

random_state(Map, state(Cell, Direction)) :-
    findall(Free, free_cell(Map, Free), Frees),
    (   random_member(Cell, Frees)
    ->  true
    ;   Cell = [0, 0]
    ),
    findall(D, grid_direction(Map, D), Directions),
    random_member(Direction, Directions).

%   Of every fifth task, any direction will do at the goal.

problem(Seed, task(Map, Start, Goal), Problem) :-
    Goal = state(Cell, _),
    (   Seed mod 5 =:= 0
    ->  grid_problem(Map, Start, state(Cell, _), Problem)
    ;   grid_problem(Map, Start, Goal, Problem)
    ).

solve(Planner, Problem, Solution) :-
    (   plan(Planner, Problem, Plan, Facts)
    ->  option(cost(Cost), Facts),
        option(steps(Steps), Facts),
        Solution = solution(Plan, Cost, Steps)
    ;   Solution = none
    ).

%   A plan holds: each step is one that the problem has, over free cells, the
%   costs add up, and it ends in a goal.

holds(Problem, Map, solution(Plan, Cost, Steps)) :-
    Problem = problem(Start, Goal, Options),
    option(successor(Next_4), Options),
    foldl(step(Next_4, Map), Plan, Start-0, End-Cost),
    length(Plan, Steps),
    (   Goal = any(Goals)
    ->  memberchk(End, Goals)
    ;   End == Goal
    ).

step(Next_4, Map, Action, State0-Cost0, State-Cost) :-
    call(Next_4, State0, Action, State, Cost1),
    grid_step(Map, Action, State0, State),
    State = state(Cell, _),
    free_cell(Map, Cell),
    !,
    Cost is Cost0 + Cost1.

%   What is wrong with the planners in a task.

wrong(Seed, Planner, Why) :-
    task(Seed, [], Task),
    Task = task(Map, _, _),
    problem(Seed, Task, Problem),
    task(Seed, [move_cost(1), diagonal_cost(1), turn_cost(1)], Unit),
    problem(Seed, Unit, UnitProblem),
    solve(dijkstra, Problem, Cheapest),
    solve(dijkstra, UnitProblem, Shortest),
    planner(Planner),
    solve(Planner, Problem, Solution),
    wrong_solution(Planner, Problem, Map, Solution, Cheapest, Shortest, Why).

wrong_solution(_, _, _, none, none, _, _) :-
    !,
    fail.
wrong_solution(_, _, _, none, _, _, finds_none) :-
    !.
wrong_solution(_, _, _, Solution, none, _, finds(Solution)) :-
    !.
wrong_solution(_, Problem, Map, Solution, _, _, does_not_hold(Solution)) :-
    \+ holds(Problem, Map, Solution),
    !.
wrong_solution(Planner, _, _, solution(_, Cost, Steps),
               solution(_, Least, _), solution(_, _, Fewest),
               broken(Claim, Cost-Least, Steps-Fewest)) :-
    planner_claim(Planner, Claim),
    \+ kept(Claim, Cost, Least, Steps, Fewest).

kept(least_cost, Cost, Least, _, _) :-
    Cost =:= Least.
kept(fewest_steps, _, _, Steps, Fewest) :-
    Steps =:= Fewest.
kept(cost_within(Factor), Cost, Least, _, _) :-
    Cost =< Factor * Least.
kept(any, _, _, _, _).

:- dynamic blocked/1.                   % Cell, of maps that change

free(Cell) :-
    \+ blocked(Cell).

block(Cell) :-
    assertz(blocked(Cell)).

unblock(Cell) :-
    retractall(blocked(Cell)).

:- begin_tests(random_maps).
test(every_planner_keeps_its_claim_on_random_maps, true(Wrong == [])) :-
    findall(Seed-Planner-Why,
            ( case(150, 1000, Seed), wrong(Seed, Planner, Why) ),
            Wrong).
test(the_maps_are_a_fair_lot, condition(all_cases)) :-
    findall(Solution,
            ( case(150, 1000, Seed),
              task(Seed, [], Task),
              problem(Seed, Task, Problem),
              solve(a_star, Problem, Solution)
            ),
            Solutions),
    length(Solutions, Count),
    aggregate_all(count, member(none, Solutions), Unreachable),
    aggregate_all(count,
                  ( member(solution(_, _, Steps), Solutions), Steps > 8 ),
                  Long),
    Unreachable > Count / 10,
    Long > Count / 5.
% Dijkstra's own results against the simplest method there is: let costs fall
% until none falls any more.
test(dijkstra_agrees_with_relaxation_on_60_maps, true(Wrong == [])) :-
    findall(Seed,
            ( case(60, Seed),
              task(Seed, [], Task),
              problem(Seed, Task, Problem),
              solve(dijkstra, Problem, Solution),
              \+ agrees(Solution, Task, Problem)
            ),
            Wrong).
test(the_heuristic_is_consistent_on_60_maps, true(Wrong == [])) :-
    findall(Seed-State-Action,
            ( case(60, Seed),
              task(Seed, [], Task),
              Task = task(Map, _, Goal),
              problem(1, Task, problem(_, _, Options)),
              option(heuristic(Estimate_3), Options),
              option(successor(Next_4), Options),
              state(Map, State),
              call(Estimate_3, State, Goal, Here),
              call(Next_4, State, Action, Next, Cost),
              call(Estimate_3, Next, Goal, There),
              Here > Cost + There
            ),
            Wrong).
test(the_way_back_is_the_way_there_on_60_maps, true(Wrong == [])) :-
    findall(Seed,
            ( case(60, Seed),
              task(Seed, [], Task),
              Task = task(Map, _, _),
              problem(1, Task, problem(_, _, Options)),
              option(predecessor(Previous_4), Options),
              option(successor(Next_4), Options),
              findall(w(From, Action, To, Cost),
                      ( state(Map, From),
                        call(Next_4, From, Action, To, Cost)
                      ),
                      Ahead),
              findall(w(From, Action, To, Cost),
                      ( state(Map, To),
                        call(Previous_4, To, Action, From, Cost)
                      ),
                      Back),
              msort(Ahead, Sorted),
              \+ msort(Back, Sorted)
            ),
            Wrong).

state(Map, state(Cell, Direction)) :-
    grid_cell(Map, Cell),
    grid_direction(Map, Direction).

agrees(Solution, task(Map, Start, _), problem(_, Goal, Options)) :-
    option(successor(Next_4), Options),
    findall(way(From, To, Cost),
            ( state(Map, From), call(Next_4, From, _, To, Cost) ),
            Ways),
    list_to_assoc([Start-0], Costs0),
    relax(Ways, Costs0, Costs),
    (   Goal = any(Goals)
    ->  true
    ;   Goals = [Goal]
    ),
    findall(Cost, ( member(G, Goals), get_assoc(G, Costs, Cost) ), Found),
    (   Solution = solution(_, Least, _)
    ->  min_list(Found, Least)
    ;   Found == []
    ).

relax(Ways, Costs0, Costs) :-
    foldl(relax_way, Ways, Costs0-same, Costs1-Changed),
    (   Changed == same
    ->  Costs = Costs1
    ;   relax(Ways, Costs1, Costs)
    ).

relax_way(way(From, To, Cost), Costs0-Changed0, Costs-Changed) :-
    (   get_assoc(From, Costs0, Before),
        New is Before + Cost,
        \+ ( get_assoc(To, Costs0, Old), Old =< New )
    ->  put_assoc(To, Costs0, New, Costs),
        Changed = changed
    ;   Costs = Costs0,
        Changed = Changed0
    ).
:- end_tests(random_maps).

:- begin_tests(repairs).
%   A robot that goes on by a few steps while cells of its map come and go;
%   after each change D* Lite against a search from scratch.

walk(Seed, Repaired, Anew) :-
    task(Seed, [free(user:free)], task(Map, Start, Goal)),
    unblock(_),
    grid_problem(Map, Start, Goal, Problem),
    planning(d_star_lite, Problem, Planning),
    walk(12, Map, Goal, Start, [], Planning, 0, Repaired, 0, Anew).

walk(0, _, _, _, _, _, Repaired, Repaired, Anew, Anew) :-
    !.
walk(N, Map, Goal, Start, Changed, Planning0, R0, R, A0, A) :-
    grid_problem(Map, Start, Goal, Problem),
    solve(a_star, Problem, Best),
    replan(Start, Changed, Result, Planning0, Planning),
    same(Best, Result, Problem, Map),
    % What the first search expands, both have to.
    (   N =:= 12
    ->  R1 = R0,
        A1 = A0
    ;   Result =.. [_|Last],
        last(Last, Facts),
        option(expanded(Repaired), Facts),
        planning(d_star_lite, Problem, Fresh),
        replan(Start, [], FreshResult, Fresh, _),
        FreshResult =.. [_|FreshLast],
        last(FreshLast, FreshFacts),
        option(expanded(Again), FreshFacts),
        R1 is R0 + Repaired,
        A1 is A0 + Again
    ),
    advance(Best, Map, Start, Start1),
    random_between(0, 3, Count),
    findall(Cell,
            ( between(1, Count, _),
              random_state(Map, state(Cell, _)),
              \+ Start1 = state(Cell, _)
            ),
            Appearing),
    findall(Cell, ( blocked(Cell), maybe(0.3) ), Fading),
    forall(member(Cell, Appearing), block(Cell)),
    forall(member(Cell, Fading), unblock(Cell)),
    append(Appearing, Fading, Cells),
    grid_changed(Map, Cells, States),
    N1 is N - 1,
    walk(N1, Map, Goal, Start1, States, Planning, R1, R, A1, A).

same(none, no_plan(_), _, _).
same(solution(_, Cost, _), plan(Plan, Facts), Problem, Map) :-
    option(cost(Cost), Facts),
    option(steps(Steps), Facts),
    holds(Problem, Map, solution(Plan, Cost, Steps)).

advance(none, _, State, State).
advance(solution(Plan, _, _), Map, State0, State) :-
    random_between(0, 2, Count),
    advance_by(Count, Plan, Map, State0, State).

advance_by(Count, Plan, Map, State0, State) :-
    (   Count > 0,
        Plan = [Action|Rest]
    ->  grid_step(Map, Action, State0, State1),
        Count1 is Count - 1,
        advance_by(Count1, Rest, Map, State1, State)
    ;   State = State0
    ).

test(d_star_lite_repairs_as_well_as_it_replans_on_random_walks) :-
    findall(Repaired-Anew,
            ( case(50, 200, Seed), once(walk(Seed, Repaired, Anew)) ),
            Walks),
    aggregate_all(count, case(50, 200, _), Count),
    length(Walks, Count),
    aggregate_all(sum(R), member(R-_, Walks), Repaired),
    aggregate_all(sum(A), member(_-A, Walks), Anew),
    Repaired * 2 < Anew.
test(every_planner_replans, [forall(planner(Planner))]) :-
    grid_map([rows(["....", "....", "^..."]), free(user:free)], Map),
    unblock(_),
    grid_start(Map, Start),
    grid_problem(Map, Start, state([0, 2], _), Problem),
    planning(Planner, Problem, Planning0),
    replan(Start, [], plan([move, move], _), Planning0, Planning1),
    block([0, 2]),
    grid_changed(Map, [[0, 2]], Changed),
    replan(state([0, 1], [0, 1]), Changed, no_plan(_), Planning1, Planning2),
    unblock([0, 2]),
    block([0, 1]),
    grid_changed(Map, [[0, 2], [0, 1]], Changed2),
    replan(Start, Changed2, plan(Plan, Facts), Planning2, _),
    aggregate_all(count, member(move, Plan), 4),
    option(steps(Steps), Facts),
    length(Plan, Steps).
:- end_tests(repairs).

:- begin_tests(any_problem).
step(N, double, Next, 1) :-
    Next is 2*N,
    Next =< 100.
step(N, add_one, Next, 3) :-
    Next is N + 1,
    Next =< 100.

back(N, double, Before, 1) :-
    N mod 2 =:= 0,
    N > 0,
    Before is N // 2.
back(N, add_one, Before, 3) :-
    N > 0,
    Before is N - 1.

sum(problem(1, Goal, [ successor(step), predecessor(back) ]), Goal).

result(Plan, Number) :-
    foldl([Action, N0, N]>>once(step(N0, Action, N, _)), Plan, 1, Number).

:- dynamic seen/1.

see(State) :-
    assertz(seen(State)).

test(numbers_are_states_as_well, [forall(planner(Planner))]) :-
    sum(Problem, 10),
    plan(Planner, Problem, Plan, Facts),
    result(Plan, 10),
    (   planner_claim(Planner, least_cost)
    ->  % 1 2 4 5 10
        option(cost(6), Facts)
    ;   true
    ).
test(there_may_be_several_goals, [forall(planner(Planner))]) :-
    sum(Problem, any([99, 64, 77])),
    plan(Planner, Problem, Plan),
    result(Plan, End),
    memberchk(End, [99, 64, 77]),
    (   planner_claim(Planner, least_cost)
    ->  End == 64
    ;   true
    ).
test(no_goal_is_none, [forall(planner(Planner)), fail]) :-
    sum(Problem, any([])),
    plan(Planner, Problem, _).
test(who_is_there_needs_no_plan,
     [forall(planner(Planner)), Plan-Cost-Expanded == []-0-0]) :-
    sum(Problem, any([7, 1])),
    plan(Planner, Problem, Plan, Facts),
    option(cost(Cost), Facts),
    option(expanded(Expanded), Facts).
test(what_cannot_be_reached_fails, [forall(planner(Planner)), fail]) :-
    plan(Planner, problem(5, 3, [successor(step), predecessor(back)]), _).
test(each_expansion_is_told, [forall(planner(Planner))]) :-
    retractall(seen(_)),
    plan(Planner, problem(1, 97, [ successor(step), predecessor(back),
                                   expanding(see)
                                 ]), _, Facts),
    option(expanded(Expanded), Facts),
    aggregate_all(count, seen(_), Expanded),
    Expanded > 0.
test(a_plan_may_be_asked_for_a_plan) :-
    sum(Problem, 4),
    plan(breadth_first, Problem, [double, double]),
    \+ plan(breadth_first, Problem, [add_one, double, double]).
test(each_planner_is_known, [forall(planner(Planner))]) :-
    planner(Planner),
    planner_claim(Planner, _).
test(any_weight_from_1_on_will_do, Claim == cost_within(1.5)) :-
    planner(weighted_a_star(1.5)),
    planner_claim(weighted_a_star(1.5), Claim).
test(too_light_a_weight_is_none, fail) :-
    planner(weighted_a_star(0.5)).
:- end_tests(any_problem).

:- begin_tests(bad_problems).
ok(Options, problem(1, 10, Options)).

any(N, add_one, Next, 1) :-
    Next is N + 1,
    Next =< 10.
free_of_charge(N, add_one, Next, 0) :-
    Next is N + 1.
dear(N, add_one, Next, dear) :-
    Next is N + 1.
loose(_, add_one, _, 1).
silent(_, _, _) :-
    fail.
words(_, _, many).

test(planner_unbound, error(instantiation_error, _)) :-
    ok([successor(any)], Problem),
    plan(_, Problem, _).
test(no_such_planner, error(domain_error(planner, dowsing), _)) :-
    ok([successor(any)], Problem),
    plan(dowsing, Problem, _).
test(no_such_weight,
     error(domain_error(planner, weighted_a_star(0)), _)) :-
    ok([successor(any)], Problem),
    plan(weighted_a_star(0), Problem, _).
test(no_problem, error(domain_error(planning_problem, 7), _)) :-
    plan(a_star, 7, _).
test(problem_unbound, error(instantiation_error, _)) :-
    plan(a_star, _, _).
test(start_unbound, error(instantiation_error, _)) :-
    plan(a_star, problem(_, 1, [successor(any)]), _).
test(goal_unbound, error(instantiation_error, _)) :-
    plan(a_star, problem(1, f(_), [successor(any)]), _).
test(options_are_no_list, error(type_error(list, x), _)) :-
    plan(a_star, problem(1, 2, x), _).
test(an_option_that_is_none,
     [ forall(member(Option, [heuristics(words), x, successor(any, any)])),
       error(domain_error(problem_option, Option), _) ]) :-
    ok([successor(any), Option], Problem),
    plan(a_star, Problem, _).
test(no_successor,
     error(existence_error(problem_option, successor), _)) :-
    plan(a_star, problem(1, 2, []), _).
test(no_predecessor,
     [ forall(member(Planner, [ bidirectional_breadth_first,
                                bidirectional_a_star, d_star_lite
                              ])),
       error(existence_error(problem_option, predecessor), _)
     ]) :-
    ok([successor(any)], Problem),
    plan(Planner, Problem, _).
test(costs_nothing,
     [ forall(planner(Planner)), error(domain_error(positive_number, 0), _) ]) :-
    ok([successor(free_of_charge), predecessor(free_of_charge)], Problem),
    plan(Planner, Problem, _).
test(costs_a_word, error(type_error(number, dear), _)) :-
    ok([successor(dear)], Problem),
    plan(a_star, Problem, _).
test(leads_to_a_variable, error(instantiation_error, _)) :-
    ok([successor(loose)], Problem),
    plan(a_star, Problem, _).
test(heuristic_fails, error(domain_error(heuristic(2, 10), _), _)) :-
    ok([successor(any), heuristic(silent)], Problem),
    plan(a_star, Problem, _).
test(heuristic_is_a_word, error(type_error(number, many), _)) :-
    ok([successor(any), heuristic(words)], Problem),
    plan(a_star, Problem, _).
test(changed_is_no_list, error(type_error(list, x), _)) :-
    ok([successor(any)], Problem),
    planning(a_star, Problem, Planning),
    replan(1, x, _, Planning, _).
test(no_planning, error(domain_error(planning, x), _)) :-
    replan(1, [], _, x, _).
:- end_tests(bad_problems).

:- begin_tests(grid_map).
map(Options, Map) :-
    grid_map([rows(["..#", ".O.", ">.."])|Options], Map).

test(rows_are_drawn_from_below,
     Frees == [[0,0], [1,0], [2,0], [0,1], [2,1], [0,2], [1,2]]) :-
    map([], Map),
    findall(Cell, free_cell(Map, Cell), Frees).
test(rows_may_be_atoms) :-
    grid_map([rows(['.#'])], Map),
    free_cell(Map, [0, 0]),
    \+ free_cell(Map, [1, 0]).
test(start_is_drawn, Start == state([0,0], [1,0])) :-
    map([], Map),
    grid_start(Map, Start).
test(no_start_is_drawn, fail) :-
    grid_map([], Map),
    grid_start(Map, _).
test(eight_by_eight_by_default, true(Count == 64)) :-
    grid_map([], Map),
    aggregate_all(count, free_cell(Map, _), Count).
test(bounds_may_go_below_0, true(Cells == [[-1,-1], [0,-1]])) :-
    grid_map([bounds(-1, -1, 0, -1)], Map),
    findall(Cell, grid_cell(Map, Cell), Cells).
test(turning_right_goes_round, [forall(member(N, [4, 8])), Passed == All]) :-
    grid_map([neighbors(N)], Map),
    findall(D, grid_direction(Map, D), All),
    round(N, Map, right, [0, 1], Passed).
test(turning_left_goes_back, [forall(member(N, [4, 8]))]) :-
    grid_map([neighbors(N)], Map),
    forall(grid_direction(Map, D),
           ( grid_step(Map, right, state([0,0], D), S),
             grid_step(Map, left, S, state([0,0], D))
           )).
test(headings_are_clockwise,
     Headings == [0, 45, 90, 135, 180, 225, 270, 315]) :-
    grid_map([neighbors(8)], Map),
    findall(H, ( grid_direction(Map, D), direction_heading(D, H) ), Headings).
test(beside_a_diagonal, [Left, Right] == [[0,1], [1,0]]) :-
    grid_beside([0,0], [1,1], Left, Right).
test(beside_another, [Left, Right] == [[6,5], [5,4]]) :-
    grid_beside([5,5], [1,-1], Left, Right).
test(nothing_beside_a_straight_move, fail) :-
    grid_beside([0,0], [1,0], _, _).
% From the middle of a map: which moves are there with one neighbor blocked?
test(no_diagonal_past_a_corner, [Moves == [4-3, 8-5]]) :-
    findall(N-Count,
            ( member(N, [4, 8]),
              grid_map([bounds(0, 0, 2, 2), obstacles([[2,1]]),
                        neighbors(N)], Map),
              grid_problem(Map, state([1,1], [0,1]), state([0,0], _),
                           problem(_, _, Options)),
              option(successor(Next_4), Options),
              aggregate_all(count,
                            ( grid_direction(Map, D),
                              call(Next_4, state([1,1], D), move, _, _)
                            ),
                            Count)
            ),
            Moves).
% The states of grid_changed/3 are all, and only those, whose ways may change.
test(changed_is_what_changes, [forall(member(N, [4, 8])), Told == Real]) :-
    Cell = [2, 1],
    ways(N, [], Before),
    ways(N, [Cell], After),
    findall(State,
            ( member(State-Ways, Before),
              \+ memberchk(State-Ways, After)
            ),
            Real0),
    sort(Real0, Real),
    grid_map([bounds(0, 0, 4, 4), neighbors(N)], Map),
    grid_changed(Map, [Cell], Told0),
    % A move off the map does not count, be the cell free or not.
    findall(State, ( member(State, Told0), memberchk(State, Real) ), Told1),
    length(Told0, CountTold),
    length(Real, CountReal),
    CountTold - CountReal =< N,
    sort(Told1, Told).
test(neighbors_are_4_or_8, error(domain_error(neighbors, 6), _)) :-
    grid_map([neighbors(6)], _).
test(bounds_hold_a_cell, error(domain_error(bounds, bounds(1,0,0,0)), _)) :-
    grid_map([bounds(1, 0, 0, 0)], _).
test(bounds_are_integers, error(type_error(integer, a), _)) :-
    grid_map([bounds(0, 0, a, 0)], _).
test(rows_are_text, error(type_error(atom, f(x)), _)) :-
    grid_map([rows([f(x)])], _).
test(rows_have_known_characters, error(domain_error(map_row, "..?"), _)) :-
    grid_map([rows(["..?"])], _).
test(a_map_has_one_start, error(domain_error(map_row, "v."), _)) :-
    grid_map([rows(["S#", "v.", "^."])], _).
test(a_start_may_be_an_s) :-
    grid_map([rows([".#", "S."])], Map),
    nonvar(Map).
test(cells_are_pairs, error(domain_error(grid_cell, [1,2,3]), _)) :-
    grid_map([obstacles([[1,2,3]])], _).
test(cells_are_bound, error(instantiation_error, _)) :-
    grid_map([obstacles([[1,_]])], _).
test(costs_are_positive, error(type_error(_, 0), _)) :-
    grid_map([turn_cost(0)], _).
test(options_are_a_list, error(type_error(list, x), _)) :-
    grid_map(x, _).
test(options_are_those_of_a_map,
     [ forall(member(Option, [fade(3), bounds(7, 7), neighbor(8)])),
       error(domain_error(grid_option, Option), _) ]) :-
    grid_map([Option], _).
test(no_diagonal_state_with_four_neighbors,
     error(domain_error(grid_state, state([0,0], [1,1])), _)) :-
    grid_map([], Map),
    grid_problem(Map, state([0,0], [1,1]), state([1,1], _), _).
test(no_state, error(domain_error(grid_state, [0,0]), _)) :-
    grid_map([], Map),
    grid_problem(Map, [0,0], state([1,1], _), _).
test(no_action, error(domain_error(grid_action, jump), _)) :-
    grid_map([], Map),
    grid_step(Map, jump, state([0,0], [0,1]), _).

round(0, _, _, _, []) :-
    !.
round(N, Map, Turn, Direction, [Direction|Rest]) :-
    grid_step(Map, Turn, state([0,0], Direction), state(_, Next)),
    N1 is N - 1,
    round(N1, Map, Turn, Next, Rest).

ways(N, Cells, Ways) :-
    grid_map([bounds(0, 0, 4, 4), neighbors(N), obstacles(Cells)], Map),
    grid_problem(Map, state([0,0], [0,1]), state([4,4], _),
                 problem(_, _, Options)),
    option(successor(Next_4), Options),
    findall(state(Cell, D)-Nexts,
            ( grid_cell(Map, Cell),
              grid_direction(Map, D),
              findall(Action-Next,
                      call(Next_4, state(Cell, D), Action, Next, _),
                      Nexts)
            ),
            Ways).
:- end_tests(grid_map).
