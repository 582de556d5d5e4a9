% Driving through rooms that are not wholly known.

:- use_module('../support/rooms').
:- use_module('../support/cases').
:- use_module('../support/trees/simulated', [simulated_pause/1]).
:- use_module('../support/trees').
:- use_module(library(ev3dev/drive)).
:- use_module(library(ev3dev/roadmap)).
:- use_module(library(sgml)).

:- initialization(load_files(room_example:example(room_navigation), [])).

:- dynamic driving/0.

:- begin_tests(navigation).
robot_at(X, Y, Heading) :-
    set_robot(5.6, 10.6, outB, outC),
    set_pose(X, Y, Heading).

unharmed(X, Y) :-
    sim_collisions([]),
    sim_pose(AtX, AtY, _),
    near(AtX, X, 3),
    near(AtY, Y, 3).

stands(Ports) :-
    sim_step(1),
    forall(member(Port, Ports), ( speed(Port, Speed), Speed =:= 0 )).

test(an_empty_map_in_a_full_room) :-
    with_sim(room,
             ( robot_at(40, 40, 40),
               navigate_to([], 260-210, [obstacles(Found)]),
               unharmed(260, 210),
               stands([outB, outC]) )),
    Found = [polygon([_-_, _-_, _-_|_])|_].
test(what_the_map_has_is_not_found_anew, [true(Found == [])]) :-
    with_sim(room,
             ( robot_at(40, 40, 40),
               navigate_to(room, 260-210, [obstacles(Found)]),
               unharmed(260, 210) )).
test(already_there) :-
    with_sim(room, ( robot_at(40, 40, 40),
                     navigate_to(room, 41-40),
                     sim_pose(X, Y, Heading) )),
    near(X, 40, 0.01),
    near(Y, 40, 0.01),
    near(Heading, 40, 0.01).
test(shut_in_by_what_it_did_not_know, [true(Reason-Hits == unreachable-[])]) :-
    with_sim([ start(0, 0, 0), wall(-40, -40, -40, 40), wall(40, -40, 40, 40),
               wall(-40, -40, 40, -40), wall(-40, 40, 40, 40) ],
             ( robot_at(0, 0, 0),
               navigate_to([], 0-100, [reason(Reason)]),
               sim_collisions(Hits) )).
test(shut_in_fails, [fail]) :-
    with_sim([ start(0, 0, 0), circle(0, 100, 20) ],
             ( robot_at(0, 0, 0),
               navigate_to([], 0-100) )).
test(nothing_moves_where_the_map_has_no_way,
     [true(Reason/Time == unreachable/0)]) :-
    with_sim(room, ( robot_at(40, 40, 40),
                     sim_time(Before),
                     navigate_to(room, 90-165, [reason(Reason)]),
                     sim_trace(Trace),
                     sim_pose(_, _, Heading),
                     sim_time(After) )),
    After - Before < 0.1,
    near(Heading, 40, 0.001),
    aggregate_all(count, moved(Trace), Time).

moved(Trace) :-
    member(_-written(File, 'run-forever'), Trace),
    sub_atom(File, _, _, 0, command).

test(a_wheel_is_held_fast, [true(Reason == stalled)]) :-
    with_sim(room, ( robot_at(40, 40, 40),
                     sim_jam(outB, true),
                     sim_jam(outC, true),
                     navigate_to([], 260-210, [reason(Reason)]),
                     stands([outB, outC]) )).
test(without_a_sensor, [fail]) :-
    with_sim(room, ( robot_at(40, 40, 40),
                     sim_unplug(in1),
                     sim_step(1),
                     navigate_to([], 260-210) )).
test(without_a_robot, [fail]) :-
    with_sim([], ( robot_at(0, 0, 0),
                   sim_unplug(outB),
                   sim_step(1),
                   navigate_to([], 0-50) )).
test(few_steps_are_soon_over, [true(Reason == exhausted)]) :-
    with_sim(room, ( robot_at(40, 40, 40),
                     navigate_to([], 260-210, [steps(2), reason(Reason)]) )).
test(an_exception_stops_it) :-
    with_sim(room, ( robot_at(40, 40, 40),
                     catch(for_seconds(4, navigate_to([], 260-210)), _, true),
                     sim_pose(X, Y, _),
                     stands([outB, outC]) )),
    sqrt((X - 260)^2 + (Y - 210)^2) > 50.
test(another_thread_stops_it, [forall(between(1, 8, At)), true(Reason == stopped)]) :-
    on(simulator, ( robot_at(40, 40, 40),
                    setup_call_cleanup(
                        assertz(driving),
                        ( later(At, stop_running),
                          navigate_to([], 260-210, [reason(Reason)]) ),
                        retractall(driving)),
                    stands([outB, outC]) )).
% Slowly and if there is nothing.
test(through_fuse, [forall(tree(mount))]) :-
    on_slow_mount([start(0, 0, 0)], arrives(10, 20)).

arrives(X, Y) :-
    robot_at(0, 0, 0),
    navigate_to([], X-Y, [speed(5), reason(reached)]),
    sim_pose(AtX, AtY, _),
    near(AtX, X, 6),
    near(AtY, Y, 6).

test(bad_option, [ forall(bad(Option, Formal)), error(Formal) ]) :-
    with_sim(room, ( robot_at(40, 40, 40),
                     navigate_to([], 260-210, [Option]) )).

bad(speed(0), domain_error(positive_number, 0)).
bad(tolerance(-1), domain_error(positive_number, -1)).
bad(steps(few), type_error(integer, few)).
bad(steps(-1), type_error(nonneg, -1)).
bad(sensor(0, a, 0), type_error(evaluable, a/0)).
bad(radius(_), instantiation_error).
bad(sensor(0, 7), domain_error(roadmap_option, sensor(0, 7))).
bad(length(_), domain_error(roadmap_option, length(_))).

test(the_example) :-
    with_sim(room,
             ( with_output_to(string(Said), room_example:start),
               unharmed(260, 210) )),
    sub_string(Said, 0, _, _, "reached").
test(the_example_draws) :-
    tmp_file(way, File),
    setup_call_cleanup(
        true,
        ( room_example:picture(260-210, File),
          load_xml(File, [element(svg, _, _)|_], []) ),
        delete_file(File)).

%   Stop the robot until it gives up: a stop has no effect if it comes just as
%   a move ends by itself.

stop_running :-
    driving,
    !,
    (   motor_states(outB, [running|_])
    ->  stop
    ;   true
    ),
    simulated_pause(0.02),
    stop_running.
stop_running.
:- end_tests(navigation).

:- begin_tests(rooms).
%   A robot with a margin of 6 cm gets there; or not even one with none.

expected(Room, Reason) :-
    room_map(Room, Map),
    Room = room(_, _, Start/_, Goal),
    (   roadmap_path(Map, Start, Goal, _, [margin(6)])
    ->  Reason = reached
    ;   roadmap_path(Map, Start, Goal, _, [margin(0)])
    ->  true
    ;   Reason = unreachable
    ).

drives_well(Number, Options, Tolerance) :-
    room(Number, Room),
    drive_room(Room, Options, Reason, outcome(Collisions, Error, _)),
    (   Collisions == 0,
        expected(Room, Reason),
        (   Reason == reached
        ->  Error =< Tolerance
        ;   true
        )
    ->  true
    ;   print_message(error,
                      format("room ~w: ~w, ~w collisions, ~1f cm off",
                             [Number, Reason, Collisions, Error])),
        fail
    ).

test(a_hundred_rooms_without_a_collision) :-
    forall(case(100, Number), drives_well(Number, [], 3)).
test(a_hundred_rooms_with_noise) :-
    forall(case(100, Number),
           ( noisy(Number, Robot),
             drives_well(Number, [seed(Number), robot(Robot)], 6) )).

%   A motor that is 5 % stronger than the other one, on the left or on the
%   right; motors, encoders, gyro and ultrasonic sensor are noisy, and the gyro
%   drifts.

noisy(Number, [ left_wheel(outB, 5.6), right_wheel(outC, 5.6), axle(10.6),
                hull(circle(8)), mass(0.75),
                motor(outA, 'lego-ev3-m-motor'),
                motor(outB, 'lego-ev3-l-motor'),
                motor(outC, 'lego-ev3-l-motor'),
                sensor(in1, 'lego-ev3-us', 0, 7, 0),
                sensor(in4, 'lego-ev3-gyro', 0, 0, 0),
                noise(in1, 0.2, 0),
                noise(in4, 0.3, 0.02),
                noise(outB, 0.5, Left),
                noise(outC, 0.5, Right),
                encoder_noise(outB, 0.5),
                encoder_noise(outC, 0.5)
              ]) :-
    Left is 5 * (Number mod 2),
    Right is 5 - Left.

% Looking for a way that is not there takes long, a quarter of an hour each on an
% emulated EV3.
test(shut_in_goals_are_reported, [condition(all_cases), true(Others == [])]) :-
    findall(Reason-Collisions,
            ( case(20, Number),
              room(Number, Room),
              shut(Room, Shut),
              drive_room(Shut, [], Reason, outcome(Collisions, _, _)),
              Reason-Collisions \== unreachable-0
            ),
            Others).

%   Walls around the goal of which the robot does not know.

shut(room(Known, Unknown, (X-Y)/Heading, GX-GY),
     room(Known, [box(GX, Y1, 60, 4), box(GX, Y2, 60, 4),
                  box(X1, GY, 4, 60), box(X2, GY, 4, 60)|Unknown],
          (X-Y)/Heading, GX-GY)) :-
    max(abs(X - GX), abs(Y - GY)) > 45,
    X1 is GX - 28,
    X2 is GX + 28,
    Y1 is GY - 28,
    Y2 is GY + 28.

%   They test something only if a robot that does not look runs into it.

test(who_does_not_look_runs_into_something, [condition(all_cases), true(Hits > 20)]) :-
    aggregate_all(count,
                  ( between(1, 100, Number),
                    room(Number, Room),
                    hits_blindly(Room) ),
                  Hits).

hits_blindly(Room) :-
    Room = room(Known, _, Start/_, Goal),
    room_map(Room, Map),
    roadmap_legs(Known, Start, Goal, Legs, []),
    member(line(From, To), Legs),
    roadmap_path(Map, From, To, Points, [margin(0)]),
    Points \= [_, _],
    !.
:- end_tests(rooms).
