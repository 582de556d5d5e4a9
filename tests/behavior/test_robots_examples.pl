% The examples of several robots in one world do what they say.

:- use_module('../support/cases').
:- use_module('../support/simulation').
:- use_module(library(ev3dev/bricks)).
:- use_module(library(thread)).

:- initialization(( load_files(sumo_match:example(sumo_match), []),
                    load_files(convoy:example(convoy), []),
                    load_files(map_together:example(map_together), []),
                    load_files(carry_together:example(carry_together), []) )).

printed(Goal, Lines) :-
    with_output_to(string(Text), Goal),
    split_string(Text, "\n", "\n", Lines).

:- dynamic place/3.

% Notes where all three are, ten times a second, for these seconds.
watch(Seconds) :-
    Count is Seconds*10,
    forall(between(1, Count, _),
           ( with_brick(first, ( wait(0.1), sim_pose(_, A, _) )),
             with_brick(second, sim_pose(_, B, _)),
             with_brick(third, sim_pose(_, C, _)),
             assertz(place(A, B, C)) )).

:- begin_tests(robots_examples).
test(the_heavier_and_stronger_wins, [forall(case(20, Seed)), true(Winner == east)]) :-
    sumo_match:match(Winner, [noise(true), seed(Seed)]).
test(nobody_is_left_in_the_ring, Names == [local]) :-
    printed(sumo_match:start, ["east wins"]),
    findall(Name, brick(Name), Names).
test(a_convoy_keeps_its_distance, Wrong == []) :-
    setup_call_cleanup(
        sim_start(convoy, [ clock(virtual), noise(true),
                            robots([first-default, second-default, third-default]) ]),
        ( retractall(user:place(_, _, _)),
          concurrent(2, [bricks_do(convoy:drive), watch(14)], []) ),
        forall(member(Name, [first, second, third]), brick_close(Name))),
    aggregate_all(max(A), place(A, _, _), Farthest),
    assertion(Farthest > 250),
    findall(A-B-C, ( place(A, B, C),
                     \+ ( between_(25, A-B, 60), between_(25, B-C, 60) ) ), Wrong).
test(a_convoy_says_where_it_is, Line == "the first drove to 268 cm; 40 and 40 cm between them") :-
    printed(convoy:start, [Line]).
test(two_robots_draw_one_map, Near-Far == true-true) :-
    printed(map_together:start, Lines),
    length(Lines, 20),
    findall(D, ( map_together:seen(X, Y), D is sqrt((X-150)**2 + (Y-60)**2),
                 between_(8, D, 16) ), OnPillar),
    length(OnPillar, Count),
    ( Count > 2 -> Near = true ; Near = Count ),
    % What only the scout has seen
    ( map_together:seen(X1, _), X1 > 290 -> Far = true ; Far = false ).
test(two_robots_carry_a_bar_through_a_door, Steps-Place == Expected-there) :-
    Expected = [ "[go(anna,west,south),go(bob,east,north)]",
                 "[grip(anna),grip(bob)]",
                 "[carry(anna,1,2),carry(bob,1,2)]",
                 "[carry(anna,2,3),carry(bob,2,3)]",
                 "[carry(anna,2,3),carry(bob,2,3)]",
                 "[carry(anna,3,4),carry(bob,3,4)]",
                 "[carry(anna,4,5),carry(bob,4,5)]",
                 "[release(anna),release(bob)]" ],
    carried([], Steps, Place).
test(nobody_stops_them, Count == 7) :-
    carried([stop(false)], Steps, there),
    length(Steps, Count).
test(with_noise_the_bar_arrives_too, [forall(case(5, Seed)), true(Place == there)]) :-
    carried([noise(true), seed(Seed)], _, Place).

%   Steps are the lines that are printed. Place is `there` if the bar lies within
%   5 cm of the last mark.
carried(Options, Steps, Place) :-
    printed(carry_together:start(Options), Lines),
    once(append(Steps, [Last], Lines)),
    split_string(Last, " ", ",", [_, "steps;", "the", "bar", "lies", "at", X0, Y0, "cm."]),
    maplist(number_string, [X, Y], [X0, Y0]),
    ( sqrt(X**2 + (Y-160)**2) < 5 -> Place = there ; Place = X-Y ).

between_(Low, Value, High) :-
    Low =< Value,
    Value =< High.
:- end_tests(robots_examples).
