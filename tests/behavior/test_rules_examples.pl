% The examples of library(ev3dev/rules) do in the simulator what they say;
% tests/sessions/play.py plays what docs/reactive.md shows of them.

:- use_module('../support/simulation').
:- use_module(library(ev3dev/events), [event/2]).

:- initialization(load_examples).

%   Each in a module of its own: all have a start/0.
load_examples :-
    forall(member(Name, [ rules_wander, rules_bumper_car, rules_light_seeker,
                          rules_line_follower, rules_sumo,
                          rules_traffic_light, rules_processes,
                          plnxt_program ]),
           load_files(Name:example(Name), [])).

%   Run an example, and look at its poses.
driven(World, Options, Seconds, Goal, Poses, Collisions) :-
    with_sim(World,
             ( for_seconds(Seconds, Goal),
               sim_collisions(Collisions),
               sim_trace(Trace),
               assertion(at_rest) ),
             Options),
    findall(pose(Time, X, Y), member(Time-pose(X, Y, _), Trace), Poses).

nearest(Poses, X0, Y0, Nearest) :-
    aggregate_all(min(D),
                  ( member(pose(_, X, Y), Poses), distance(X, Y, X0, Y0, D) ),
                  Nearest).

distance(X1, Y1, X2, Y2, Distance) :-
    Distance is sqrt((X1 - X2)^2 + (Y1 - Y2)^2).

gets_around(Poses) :-
    aggregate_all(max(X), member(pose(_, X, _), Poses), East),
    aggregate_all(max(Y), member(pose(_, _, Y), Poses), North),
    East > 200,
    North > 150.

:- begin_tests(rules_wander).
test(gets_around_and_frees_itself) :-
    driven(room, [robot(touch)], 90, rules_wander:start, Poses, Collisions),
    gets_around(Poses),
    Collisions \== [],
    last(Poses, pose(Time, _, _)),
    Time > 85.
test(escapes_each_time_that_it_is_touched, true(Backward >= 2)) :-
    with_sim([],
             ( sim_press(in4, [after(2), for(0.1)]),
               sim_press(in4, [after(8), for(0.1)]),
               for_seconds(14, rules_wander:start),
               sim_trace(Trace) ),
             [robot(touch)]),
    aggregate_all(count,
                  ( member(_-written(File, Text), Trace),
                    sub_atom(File, _, _, 0, speed_sp),
                    atom_number(Text, Speed),
                    Speed < -100 ),
                  Backward).
:- end_tests(rules_wander).

:- begin_tests(rules_bumper_car).
test(drives_a_minute_without_a_collision, true(Collisions == [])) :-
    driven(room, [], 60, rules_bumper_car:start, Poses, Collisions),
    gets_around(Poses).
test(backs_off_when_its_bumper_is_pressed) :-
    with_sim([],
             ( sim_press(in4, [after(2), for(0.2)]),
               for_seconds(3.2, rules_bumper_car:start),
               sim_pose(_, Y, _) ),
             [robot(touch)]),
    near(Y, 25, 10).
:- end_tests(rules_bumper_car).

:- begin_tests(rules_light_seeker).
test(comes_near_the_lamp_again_and_again_and_flees, true(Collisions == [])) :-
    driven(lights, [], 60, rules_light_seeker:start, Poses, Collisions),
    findall(Near,
            ( member(pose(_, X, Y), Poses),
              distance(X, Y, 150, 190, D),
              ( D < 75 -> Near = true ; D > 90 -> Near = false ) ),
            Nears),
    changes(Nears, Changes),
    Changes >= 5.
test(searches_where_it_is_dark) :-
    driven([ambient(2)], [], 12, rules_light_seeker:start, Poses, []),
    last(Poses, pose(_, X, Y)),
    distance(X, Y, 0, 0, D),
    D > 10.

changes(Values, Changes) :-
    aggregate_all(count,
                  ( nextto(Before, After, Values), Before \== After ),
                  Changes).
:- end_tests(rules_light_seeker).

:- begin_tests(rules_line_follower).
test(gets_around, true(Collisions == [])) :-
    driven(line, [noise(true)], 60, rules_line_follower:start, Poses,
           Collisions),
    forall(member([X, Y], [[190, 90], [110, 100], [60, 150], [30, 90],
                           [60, 40]]),
           ( nearest(Poses, X, Y, Nearest), near(Nearest, 0, 5) )).
test(stands_before_an_obstacle_until_it_is_gone, true(Collisions == [])) :-
    with_sim(line,
             ( sim_at(2, sim_add(circle(150, 40, 4))),
               sim_at(15, sim_remove(circle(150, 40, 4))),
               for_seconds(22, rules_line_follower:start),
               sim_collisions(Collisions),
               sim_trace(Trace) )),
    findall(pose(T, X, Y), member(T-pose(X, Y, _), Trace), Poses),
    \+ ( member(pose(T, _, _), Poses), T > 8, T < 15 ),
    nearest(Poses, 190, 70, Nearest),
    near(Nearest, 0, 5).
:- end_tests(rules_line_follower).

:- begin_tests(rules_sumo).
in_ring(Poses) :-
    forall(member(pose(_, X, Y), Poses),
           ( distance(X, Y, 0, 0, D), D < 77 )).

test(finds_the_other_one_and_pushes_it) :-
    driven(sumo, [], 20, rules_sumo:start, Poses, Collisions),
    in_ring(Poses),
    Collisions \== [],
    nearest(Poses, -25, -35, Nearest),
    near(Nearest, 16, 1).
test(stays_in_the_ring_when_the_other_one_is_gone, true(Collisions == [])) :-
    findall(Fact,
            ( world_fact(sumo, Fact), Fact \= circle(_, _, _) ),
            Alone),
    driven(Alone, [], 120, rules_sumo:start, Poses, Collisions),
    in_ring(Poses),
    % It goes to the edge, too.
    aggregate_all(max(D),
                  ( member(pose(_, X, Y), Poses), distance(X, Y, 0, 0, D) ),
                  Farthest),
    Farthest > 60.

world_fact(World, Fact) :-
    atomic_list_concat(['prolog/ev3dev/worlds/', World, '.pl'], File),
    read_file_to_terms(File, Facts, []),
    member(Fact, Facts).
:- end_tests(rules_sumo).

:- begin_tests(rules_traffic_light).
:- dynamic seen/3.

test(has_four_states_and_blinks_by_night,
     true(Seen == [ 2-red-red, 4.5-red-amber, 6-green-green, 11-amber-amber,
                    13-red-red, 16.2-amber-amber, 16.7-off-off,
                    17.2-amber-amber, 22-red-red, 25-red-amber ])) :-
    retractall(seen(_, _, _)),
    with_sim([ambient(20)],
             ( forall(member(Time, [2, 4.5, 6, 11, 13, 16.2, 16.7, 17.2, 22,
                                    25]),
                      sim_at(Time, note(Time))),
               sim_at(16, sim_show(in2, value0, 0)),
               sim_at(20, sim_unshow(in2, value0)),
               for_seconds(30, rules_traffic_light:start),
               findall(Light-Color, led(Light, Color), Last) )),
    findall(Time-L-R, retract(seen(Time, L, R)), Seen),
    Last == [left-off, right-off].

note(Time) :-
    led(left, L),
    led(right, R),
    assertz(seen(Time, L, R)).
:- end_tests(rules_traffic_light).

:- begin_tests(rules_processes).
test(drives_out_at_an_order_waits_and_comes_back) :-
    with_sim([wall(-50, 150, 50, 150)],
             ( sim_press(enter, [after(1)]),
               sim_press(up, [after(12)]),
               for_seconds(22, rules_processes:start),
               sim_pose(X, Y, Heading),
               sim_collisions([]),
               sim_trace(Trace) )),
    findall(pose(T, X1, Y1), member(T-pose(X1, Y1, _), Trace), Poses),
    nearest(Poses, 0, 113, Nearest),
    near(Nearest, 0, 5),
    \+ ( member(pose(T, _, _), Poses), T > 9, T < 12 ),
    near(X, 0, 2),
    near(Y, 0, 2),
    near(sin(Heading * pi / 180), 0, 0.1).
test(comes_back_at_once_when_it_is_recalled) :-
    with_sim([wall(-50, 150, 50, 150)],
             ( sim_press(enter, [after(1)]),
               sim_press(down, [after(3)]),
               for_seconds(12, rules_processes:start),
               sim_pose(X, Y, _),
               sim_trace(Trace) )),
    findall(pose(T, X1, Y1), member(T-pose(X1, Y1, _), Trace), Poses),
    nearest(Poses, 0, 113, Nearest),
    Nearest > 60,
    near(X, 0, 2),
    near(Y, 0, 2).
test(leaves_no_event_behind, true(Ids == [])) :-
    with_sim([], for_seconds(1, rules_processes:start)),
    findall(Id, event(Id, _), Ids).
:- end_tests(rules_processes).

:- begin_tests(plnxt_program).
world([ bounds(0, 0, 150, 150), start(40, 40, 30),
        patch(black, [100-0, 150-0, 150-150, 100-150]) ]).

test(stays_on_white_and_away_from_walls_for_its_time) :-
    world(World),
    with_sim(World,
             ( plnxt_program:start,
               sim_time(Time),
               sim_collisions([]),
               at_rest,
               findall(Id, event(Id, _), []),
               sim_trace(Trace) )),
    near(Time, 30, 0.5),
    findall(X, member(_-pose(X, _, _), Trace), Xs),
    max_list(Xs, East),
    East < 110,
    min_list(Xs, West),
    West < 40.
:- end_tests(plnxt_program).
