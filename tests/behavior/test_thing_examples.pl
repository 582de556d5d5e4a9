% The examples with things that robots push, with noise, from 20 seeds each;
% library(ev3dev/sim) says where things are in the end.

:- use_module('../support/simulation').
:- use_module(library(ev3dev/bricks)).
:- use_module(library(ev3dev/drive), [go_cm/2]).
:- use_module(library(ev3dev/gripper)).

:- initialization(forall(member(Name, [clear_the_ring, sort_parcels, goal]),
                         load_files(Name:example(Name), []))).

%   Things is where all things are at the end, and Place is the robot's.
ended(Example, World, Robot, Seed, Seconds, Things, X-Y) :-
    with_sim(World,
             ( for_seconds(Seconds, ignore(Example:start)),
               sim_things(Things),
               sim_pose(X, Y, _) ),
             [robot(Robot), noise(true), seed(Seed)]).

within(thing(Name, X, Y, _), Places) :-
    memberchk(Name-[X1, Y1, X2, Y2], Places),
    X > X1, X < X2, Y > Y1, Y < Y2.

:- begin_tests(thing_examples).
test(clear_the_ring_pushes_cans_off_and_stays_on,
     [forall(between(1, 20, Seed)), true(Left =< 1)]) :-
    ended(clear_the_ring, cans, default, Seed, 200, Things, X-Y),
    sqrt(X*X + Y*Y) < 77,
    aggregate_all(count,
                  ( member(thing(_, X1, Y1, _), Things),
                    sqrt(X1*X1 + Y1*Y1) < 72 ), Left).
test(sort_parcels_brings_each_to_its_station,
     [forall(between(1, 20, Seed)), true(Wrong == [])]) :-
    ended(sort_parcels, parcels, carrier, Seed, 150, Things, _),
    findall(Thing,
            ( member(Thing, Things),
              \+ within(Thing, [ red_parcel-[25, 10, 55, 40],
                                 yellow_parcel-[65, 10, 95, 40],
                                 green_parcel-[105, 10, 135, 40],
                                 blue_parcel-[145, 10, 175, 40] ]) ),
            Wrong).
%   The ball lies somewhere before the robot.
test(goal_puts_the_ball_into_the_goal,
     [forall(between(1, 20, Seed)), true(within(Ball, [ball-[-30, 100, 30, 115]]))]) :-
    read_term_from_world(soccer, Facts),
    X is (Seed*7) mod 31 - 15,
    Y is -((Seed*5) mod 21),
    findall(Fact,
            ( member(Fact0, Facts),
              (   Fact0 = circle(0, 0, Radius, Options)
              ->  Fact = circle(X, Y, Radius, Options)
              ;   Fact = Fact0
              ) ), World),
    ended(goal, World, carrier, Seed, 60, [Ball], _).
test(two_robots_carry_a_bar, true(Y > 80)) :-
    sim_start(bar, [ clock(virtual),
                     robots([back-carrier, front-carrier]) ]),
    bricks_do([back, front],
              ( set_robot(5.6, 10.6, outB, outC), set_gripper(outA, []),
                go_cm(20, 21), grip )),
    concurrent(2, [ with_brick(back, go_cm(20, 100)),
                    with_brick(front, go_cm(-20, 100)) ], []),
    bricks_do([back, front], release),
    with_brick(back, sim_thing(bar, _, Y, _)),
    sim_stop.

read_term_from_world(World, Facts) :-
    atomic_list_concat(['prolog/ev3dev/worlds/', World, '.pl'], File),
    read_file_to_terms(File, Facts, []).
:- end_tests(thing_examples).
