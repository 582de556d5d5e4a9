% Ways between obstacles, and driving through rooms that are not wholly known.

:- use_module(rooms).
:- use_module(cases).
:- use_module(simulated_tree, [hold_clock/0, release_clock/0]).
:- use_module(simulation).
:- use_module(tree, [meanwhile/2]).
:- use_module(trees).
:- use_module(old_prolog).
:- use_module(library(ev3dev)).
:- use_module(library(ev3dev/drive)).
:- use_module(library(ev3dev/roadmap)).
:- use_module(library(ev3dev/sim)).
:- use_module(library(readutil)).
:- use_module(library(sgml)).

:- initialization(load_files(room_example:example(room_navigation), [])).

:- begin_tests(roadmap).

%   A fact of each kind that a world may have, away from the way.
world_fact(bounds(-500, -500, 500, 500)).
world_fact(wall(200, 0, 200, 50)).
world_fact(wall(200, 0, 200, 50, 2)).
world_fact(box(50, 50, 10, 10)).
world_fact(box(50, 50, 10, 10, 45)).
world_fact(circle(200, 200, 5)).
world_fact(floor(yellow)).
world_fact(patch(blue, [[0, 0], [9, 0], [9, 9]])).
world_fact(line('#102030', 2, [[0, 0], [100, 100]])).
world_fact(lamp(1, 1, 12)).
world_fact(lamp(1, 1, 12, outD)).
world_fact(beacon(1, 1, 1)).
world_fact(ambient(3)).
world_fact(temperature(20)).
world_fact(loudness(3)).
world_fact(start(0, 0, 0)).
world_fact(map(20, ["#.S.L"])).

test(each_fact_of_the_simulators_vocabulary_is_accepted,
     [ forall(world_fact(Fact)) ]) :-
    roadmap_path([Fact], 0-150, 100-150, Points),
    Points = [_, _|_].
test(what_stops_no_robot_changes_no_path) :-
    Box = box(50, 50, 10, 10),
    roadmap_path([Box], 0-0, 100-100, Points),
    forall(member(Fact, [ beacon(1, 1, 1), temperature(20), loudness(3),
                          lamp(1, 1, 12, outD) ]),
           ( roadmap_path([Fact, Box], 0-0, 100-100, Points1),
             same_way(Points, Points1) )).

square([polygon([40-40, 60-40, 60-60, 40-60])]).

same_way([], []).
same_way([X1-Y1|Way1], [X2-Y2|Way2]) :-
    near(X1, X2, 0.001),
    near(Y1, Y2, 0.001),
    same_way(Way1, Way2).

test(nothing_in_the_way) :-
    roadmap_path([], 0-0, 30-40, Points, [length(Length)]),
    same_way(Points, [0-0, 30-40]),
    near(Length, 50, 0.001).
test(around_a_corner_by_arcs) :-
    square(Map),
    roadmap_legs(Map, 20-40, 60-80, Legs, [length(Length)]),
    Legs = [line(_, _)|_],
    last(Legs, line(_, _)),
    % Tangents to a circle of 11 cm around the corner, and its arc
    Direct is sqrt(20^2 + 20^2),
    Tangent is sqrt(Direct^2 - 12^2),
    Shortest is 2 * Tangent + 12 * (pi - 2 * acos(12 / Direct)),
    Length >= Shortest - 0.001,
    Length =< 1.01 * Shortest.
test(an_arc_turns_as_arc_cm_does, [forall(member(From-To-Sign,
     [(20-40)-(60-80)-1, (60-80)-(20-40)-(-1)]))]) :-
    square(Map),
    roadmap_legs(Map, From, To, Legs, []),
    findall(Radius-Angle, member(arc(_, _, Radius, Angle), Legs), Arcs),
    Arcs = [_|_],
    forall(member(Radius-Angle, Arcs),
           ( Radius * Sign >= 6, Angle > 0 )).
test(corners_stay_where_no_arc_fits) :-
    square(Map),
    roadmap_legs(Map, 20-40, 60-80, Legs, [arc_radius(500)]),
    Legs = [line(_, _), line(_, _)|_],
    \+ memberchk(arc(_, _, _, _), Legs).
test(corners_may_be_lists_and_clockwise, [forall(member(Polygon,
     [ [[40, 40], [60, 40], [60, 60], [40, 60]],
       [40-60, 60-60, 60-40, 40-40] ]))]) :-
    square(Map),
    roadmap_path(Map, 0-50, 100-50, Points),
    roadmap_path([polygon(Polygon)], [0, 50], [100, 50], Points1),
    same_way(Points, Points1).
test(each_method_finds_a_way,
     [forall(member(Method, [visibility, prm, rrt_star]))]) :-
    roadmap_path(room, 40-40, 270-220, Points,
                 [method(Method), length(Length)]),
    Points = [40.0-40.0|_],
    last(Points, 270.0-220.0),
    Length < 320.
test(the_same_seed_gives_the_same_way,
     [forall(member(Method, [prm, rrt_star]))]) :-
    Options = [method(Method), margin(20)],
    roadmap_path(room, 40-40, 270-220, Points1, [seed(7)|Options]),
    roadmap_path(room, 40-40, 270-220, Points2, [seed(7)|Options]),
    roadmap_path(room, 40-40, 270-220, Points3, [seed(8)|Options]),
    Points1 == Points2,
    Points1 \== Points3.
test(a_map_that_is_drawn) :-
    roadmap_path(maze, 45-45, 45-255, _, [margin(1)]).
test(a_concave_polygon_holds_one_fast, [fail]) :-
    Horseshoe = polygon([ 0-0, 40-0, 40-5, 5-5, 5-95, 95-95, 95-5, 55-5,
                          55-0, 100-0, 100-100, 0-100 ]),
    roadmap_path([Horseshoe], 50-50, 50-(-50), _).
test(no_way_through_a_wall, [fail]) :-
    roadmap_path([bounds(0, 0, 100, 100), wall(50, 0, 50, 100)],
                 20-20, 80-80, _).
test(the_way_is_as_wide_as_the_robot) :-
    Map = [bounds(0, 0, 100, 100), wall(50, 0, 50, 40), wall(50, 60, 50, 100)],
    roadmap_path(Map, 20-20, 80-80, _, [radius(9), margin(0.9)]),
    \+ roadmap_path(Map, 20-20, 80-80, _, [radius(9), margin(1.1)]).
test(too_near_to_the_goal, [fail]) :-
    square(Map),
    roadmap_path(Map, 0-0, 50-50, _).
test(too_near_to_the_start, [fail]) :-
    square(Map),
    roadmap_path(Map, 50-65, 0-0, _).
test(places_may_be_expressions) :-
    X = 10,
    roadmap_path([], (X + 1)-(2 * X), [X / 4, 0], Points),
    same_way(Points, [11-20, 2.5-0]).
test(points_that_are_given_are_compared, [fail]) :-
    roadmap_path([], 0-0, 30-40, []).
test(a_picture) :-
    tmp_file(roadmap, File),
    setup_call_cleanup(
        true,
        ( roadmap_svg(room, 40-40, 270-220, File, []),
          load_xml(File, [element(svg, _, _)|_], []) ),
        delete_file(File)).
test(no_picture_where_there_is_no_way, [true(\+ exists_file(File))]) :-
    square(Map),
    tmp_file(roadmap, File),
    \+ roadmap_svg(Map, 0-0, 50-50, File, []).

:- end_tests(roadmap).

:- begin_tests(roadmap_bad_input).

impossible(polygon([0-0, 10-0])).
impossible(polygon([0-0, 10-10, 10-0, 0-10])).
impossible(polygon([0-0, 10-0, 20-0])).
impossible(box(0, 0, 0, 10)).
impossible(wall(5, 5, 5, 5)).
impossible(circle(0, 0, -1)).
impossible(bounds(10, 0, 0, 10)).
impossible(circle(1.0e20, 0, 1)).
impossible(circle(X, 0, 1)) :- evaluated(inf, X).

test(impossible, [ forall(impossible(Fact)),
                   error(domain_error(possible_geometry, _)) ]) :-
    roadmap_path([Fact], 100-100, 200-200, _).

far(1.0e20-0).
far(0-(-2000000)).
far(X-0) :- evaluated(nan, X).
far(X-0) :- evaluated(inf, X).

test(a_start_beyond_10_km, [ forall(far(Point)), error(domain_error(point, _)) ]) :-
    roadmap_path([], Point, 200-200, _).
test(a_goal_beyond_10_km, [ forall(far(Point)), error(domain_error(point, _)) ]) :-
    roadmap_path([], 200-200, Point, _).
test(a_drawing_with_an_unknown_character, error(domain_error(map_row, "#?#"))) :-
    roadmap_path([map(20, ["#?#"])], 100-100, 200-200, _).
test(a_drawing_with_two_starts, error(domain_error(map_row, "^.S"))) :-
    roadmap_path([map(20, ["^.S"])], 100-100, 200-200, _).
test(a_fact_without_arguments, error(domain_error(roadmap_fact, room))) :-
    roadmap_path([room], 0-0, 10-10, _).
test(unknown_fact, error(domain_error(roadmap_fact, pond(1, 2)))) :-
    roadmap_path([pond(1, 2)], 0-0, 1-1, _).
test(too_many_arguments, error(domain_error(roadmap_fact, _))) :-
    roadmap_path([circle(1, 2, 3, 4)], 0-0, 1-1, _).
test(fact_of_words, error(type_error(number, a))) :-
    roadmap_path([circle(a, 2, 3)], 0-0, 1-1, _).
test(unbound_fact, error(_)) :-
    roadmap_path([_], 0-0, 1-1, _).
test(corner_that_is_none, error(domain_error(point, a+b))) :-
    roadmap_path([polygon([0-0, 1-1, a+b])], 0-0, 1-1, _).
test(no_such_world, error(existence_error(world, nowhere))) :-
    roadmap_path(nowhere, 0-0, 1-1, _).
test(unbound_map, error(instantiation_error)) :-
    roadmap_path(_, 0-0, 1-1, _).
test(unbound_start, error(instantiation_error)) :-
    roadmap_path([], _, 1-1, _).
test(unbound_goal, error(instantiation_error)) :-
    roadmap_path([], 0-0, _-1, _).
test(no_place, error(domain_error(point, here))) :-
    roadmap_path([], 0-0, here, _).
test(bad_option, [ forall(bad(Option, Formal)), error(Formal) ]) :-
    roadmap_path([], 0-0, 1-1, _, [Option]).

bad(radius(0), domain_error(positive_number, 0)).
bad(radius(a), type_error(evaluable, a/0)).
bad(margin(-1), domain_error(nonneg, -1)).
bad(arc_radius(0), domain_error(positive_number, 0)).
bad(method(guess), domain_error(roadmap_method, guess)).
bad(method(_), instantiation_error).
bad(samples(-1), type_error(nonneg, -1)).
bad(samples(1000000), domain_error(samples, 1000000)).
bad(seed(x), type_error(integer, x)).
bad(steps(5), domain_error(roadmap_option, steps(5))).
bad(raduis(5), domain_error(roadmap_option, raduis(5))).

test(options_that_are_no_list, error(type_error(list, x))) :-
    roadmap_path([], 0-0, 1-1, _, x).

:- end_tests(roadmap_bad_input).

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
    with_sim(room, ( robot_at(40, 40, 40),
                     meanwhile(stop_running(At),
                               navigate_to([], 260-210, [reason(Reason)])),
                     stands([outB, outC]) )).
test(through_fuse_in_real_time, [forall(tree(mount))]) :-
    on(mount, ( robot_at(40, 40, 40),
                navigate_to(room, 50-60),
                unharmed(50, 60) )).
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

%   Stop the robot once, when it moves after so many seconds: while it waits
%   for time to pass, since it may stand by itself right after that.

stop_running(At) :-
    repeat,
    sleep(0.001),
    sim_time(Now),
    Now >= At,
    setup_call_cleanup(
        hold_clock,
        ( sleep(0.02), motor_states(outB, [running|_]), stop ),
        release_clock),
    !,
    repeat,
    sleep(1),
    fail.

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

%   They are no test unless whoever does not look runs into something.

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
