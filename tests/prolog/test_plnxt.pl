% library(ev3dev/plnxt), in the simulator.

:- use_module('../support/simulation').
:- use_module(library(ev3dev/plnxt)).
:- use_module(library(ev3dev/events), [event/2, on/2]).

:- dynamic seen/1, user:nxt_robot_definition/14, user:nxt_robot_definition/13.

% Open in a world of its own, and leave nothing.
nxt(World, Goal) :-
    nxt(World, Goal, []).

:- meta_predicate nxt(+, 0), nxt(+, 0, +).

nxt(World, Goal, Options) :-
    retractall(seen(_)),
    with_sim(World,
             ( set_robot(5.6, 10.6, outB, outC),
               setup_call_cleanup(nxt_open, once(Goal), nxt_close) ),
             Options).

% With a definition of the robot
defined(Fact, Goal) :-
    setup_call_cleanup(assertz(user:Fact), once(Goal), retractall(user:Fact)).

:- meta_predicate defined(+, 0).

see(What) :-
    ev3_time(Time),
    Rounded is round(Time * 10) / 10.0,
    assertz(seen(What-Rounded)).

all_seen(All) :-
    findall(What, seen(What), All).

:- begin_tests(robot).
% The first test: no robot has been set yet.
test(is_the_default_one, true(Robot == [5.6, 10.6, outB, outC])) :-
    with_sim([], ( nxt_open, robot(D, A, L, R), nxt_close )),
    Robot = [D, A, L, R].
test(is_the_one_that_was_set, true(Left-Right == outC-outB)) :-
    with_sim([], ( set_robot(5.6, 10.6, outC, outB),
                   nxt_open, robot(_, _, Left, Right), nxt_close )).
test(is_that_of_its_definition, true(Found == [11, outC, outB])) :-
    defined(nxt_robot_definition(me, '/dev/rfcomm0', bt, on, 17.5, 11, 'C', 'B',
                                 'A', false, 'S1', 'S2', 'S3', 'S4'),
            nxt([], ( robot(D, A, L, R), near(D, 5.57, 0.01),
                      Found = [A, L, R] ))).
test(may_be_defined_with_thirteen_arguments, true(A == 12)) :-
    defined(nxt_robot_definition(me, bt, on, 17.5, 12, 'C', 'B',
                                 'A', false, 'S1', 'S2', 'S3', 'S4'),
            nxt([], robot(_, A, _, _))).
test(may_have_its_motors_reversed) :-
    defined(nxt_robot_definition(me, '/dev/rfcomm0', bt, on, 17.5, 11, 'B', 'C',
                                 'A', true, 'S1', 'S2', 'S3', 'S4'),
            nxt([], ( nxt_go_cm(300, 20), sim_pose(_, Y, _) ))),
    near(Y, -20, 1).
test(has_motors_by_letters, error(domain_error(nxt_motor, x))) :-
    defined(nxt_robot_definition(me, '/dev/rfcomm0', bt, on, 17.5, 11, x, 'B',
                                 'A', false, 'S1', 'S2', 'S3', 'S4'),
            nxt([], true)).
test(has_sensors_by_numbers, error(domain_error(nxt_sensor, 7))) :-
    defined(nxt_robot_definition(me, '/dev/rfcomm0', bt, on, 17.5, 11, 'C', 'B',
                                 'A', false, 7, 'S2', 'S3', 'S4'),
            nxt([], true)).
test(is_not_opened_without_its_motors, fail) :-
    defined(nxt_robot_definition(me, '/dev/rfcomm0', bt, on, 17.5, 11, 'D', 'B',
                                 'A', false, 'S1', 'S2', 'S3', 'S4'),
            nxt([], true)).
test(does_what_it_is_asked_to_by_its_name) :-
    nxt([], ( nxt_robot(nxt, true), nxt_goal(nxt, true),
              nxt_goal(nxt, true, []) )).
test(fails_with_its_goal, fail) :-
    nxt([], nxt_robot(nxt, fail)).
test(knows_its_name, error(existence_error(nxt_robot, you))) :-
    nxt([], nxt_robot(you, true)).
:- end_tests(robot).

:- begin_tests(moves).
test(go_until_they_are_stopped) :-
    nxt([], ( nxt_go(400), wait(2), nxt_stop, wait(1), at_rest,
              sim_pose(_, Y, _) )),
    % degrees a second, wheels of 17.6 cm
    near(Y, 400 / 360 * 17.6 * 2, 3).
test(go_a_distance_by_either_sign,
     [ forall(member(Speed-Distance-Expected,
                     [400-15-15, -400-15-(-15), 400-(-15)-(-15)])) ]) :-
    nxt([], ( nxt_go_cm(Speed, Distance), sim_pose(_, Y, _) )),
    near(Y, Expected, 0.5).
test(go_for_a_time) :-
    nxt([], ( nxt_go_sec(-200, 2), at_rest, sim_pose(_, Y, _) )),
    near(Y, -19.6, 3).
test(stop_after_an_exception) :-
    nxt([], ( catch(( sim_at(1, throw(over)), nxt_go_sec(200, 9) ), over, true),
              at_rest )).
test(rotate_on_the_spot, [forall(member(Angle, [90, -45]))]) :-
    nxt([], ( nxt_rotate(300, Angle), sim_pose(X, Y, Heading) )),
    near(X, 0, 0.5),
    near(Y, 0, 0.5),
    near(Heading, Angle, 1).
test(turn_around_the_inner_wheel,
     [forall(member(Angle-Side, [90-1, -90-(-1)]))]) :-
    nxt([], ( nxt_turn(300, Angle), sim_pose(X, Y, Heading) )),
    near(X, Side * 5.3, 0.5),
    near(Y, 5.3, 0.5),
    near(Heading, Angle, 2).
test(fail_if_a_wheel_is_blocked, fail) :-
    nxt([], ( sim_jam(outB, true), nxt_go_cm(300, 20) )).
test(fail_if_too_fast, fail) :-
    nxt([], nxt_go(5000)).
test(succeed_if_a_trigger_has_stopped_them) :-
    nxt([], ( trigger_create(_, ( ev3_time(T), T > 1 ), nxt_stop),
              nxt_go_cm(300, 100),
              sim_pose(_, Y, _) )),
    Y < 30.
:- end_tests(moves).

:- begin_tests(sensors).
test(measure_at_any_port) :-
    nxt(room, ( nxt_ultrasonic(D, force), nxt_light(L, force) )),
    D > 50,
    L > 50.
test(measure_at_the_port_of_the_definition, true(L == 7)) :-
    defined(nxt_robot_definition(me, '/dev/rfcomm0', bt, on, 17.5, 11, 'B', 'C',
                                 'A', false, 'S4', 'S2', 'S3', 'S1'),
            nxt(room, ( sim_show(in3, value0, 7), nxt_light(L, force) ))).
test(measure_touch, true(A-B == 0-1)) :-
    nxt([], ( nxt_touch(A, force), sim_press(in4), sim_step(0.1),
              nxt_touch(B, force) ),
        [robot(touch)]).
test(measure_sound_and_light_of_the_nxt) :-
    nxt([loudness(40)],
        ( sim_unplug(in2), sim_unplug(in3), sim_step(2),
          sim_plug(in3, 'lego-nxt-light'), sim_plug(in2, 'lego-nxt-sound'),
          sim_step(2), port_device(in2, 'lego-nxt-sound'), sim_step(2),
          nxt_light(Light, force), nxt_sound(Sound, force) )),
    number(Light),
    near(Sound, 40, 2).
test(remember_what_they_have_read_last, true(Values == [50, 50, 20])) :-
    nxt(room, ( sim_show(in1, value0, 500), nxt_ultrasonic(A0, force),
                sim_show(in1, value0, 200), nxt_ultrasonic(B0),
                nxt_ultrasonic(_, force), nxt_ultrasonic(C0) )),
    maplist(whole, [A0, B0, C0], Values).
test(read_if_there_is_no_last_value) :-
    nxt(room, ( nxt_light(L), nxt_ultrasonic(D) )),
    number(L),
    number(D).
% Bricks that share a program know nothing of each other's readings.
test(are_those_of_the_own_brick, true(Whole-Others == 50-[7])) :-
    setup_call_cleanup(
        assertz(ev3dev_plnxt:read_last(other, ultrasonic, 7)),
        nxt(room, ( sim_show(in1, value0, 500), nxt_ultrasonic(D),
                    findall(Cm, ev3dev_plnxt:read_last(other, _, Cm), Others) )),
        retractall(ev3dev_plnxt:read_last(other, _, _))),
    whole(D, Whole).
test(fail_if_there_is_none,
     [ fail, forall(member(Goal, [nxt_touch(_), nxt_touch(_, force),
                                  nxt_sound(_), nxt_sound(_, force)])) ]) :-
    nxt(room, Goal).
test(compare_a_bound_value, fail) :-
    nxt(room, nxt_ultrasonic(1, force)).
test(of_the_nxt_are_read_by_port_as_before, fail) :-
    nxt(room, nxt_light(in2, _)).
test(have_a_lamp) :-
    nxt([ambient(30)],
        ( nxt_light(On, force),
          nxt_light_LED(deactivate, force), nxt_light(Off, force),
          mode(in2, Mode1),
          nxt_light_LED(activate), mode(in2, Mode2) )),
    On > 50,
    near(Off, 30, 2),
    Mode1-Mode2 == 'COL-AMBIENT'-'COL-REFLECT'.
test(play_tones_without_waiting) :-
    nxt([], ( ev3_time(T0), nxt_play_tone(440, 500), ev3_time(T1),
              sim_trace(Trace) )),
    T1 - T0 < 0.1,
    once(member(_-tone(440), Trace)).

whole(Value, Whole) :-
    Whole is round(Value).
:- end_tests(sensors).

:- begin_tests(triggers).
test(happen_once, true(All == [x-1.0])) :-
    nxt([], ( trigger_create(a, flips, [see(x)]), wait(5), all_seen(All) )).
test(happen_count_times, true(All == [x-1.0, x-3.0])) :-
    nxt([], ( trigger_create(a, flips, see(x), 2), wait(9), all_seen(All) )).
test(happen_each_time, true(Count == 5)) :-
    nxt([], ( trigger_create(a, flips, see(x), inf), wait(10),
              all_seen(All) )),
    length(All, Count).
test(have_lists_of_goals, true(All == [x-1.0, y-1.5])) :-
    nxt([], ( trigger_create(a, [flips, true], [see(x), sleep(0.5), see(y)]),
              wait(3), all_seen(All) )).
test(pass_on_what_the_condition_has_found, true(All == [found(1)-1.0])) :-
    nxt([], ( trigger_create(_, ( flips, X = 1 ), see(found(X))), wait(2),
              all_seen(All) )).
test(get_an_id, true(Ids == [A, B])) :-
    nxt([], ( trigger_create(A, fail, true), trigger_create(B, fail, true),
              findall(Id, event(nxt_trigger(Id), _), Ids) )),
    A \== B.
test(are_killed, true(All == [])) :-
    nxt([], ( trigger_create(a, flips, see(a)), trigger_create(b, flips, see(b)),
              trigger_kill(a), trigger_kill(a), trigger_killall,
              timer_kill(a), wait(3), all_seen(All) )).
test(end_when_the_robot_is_closed, true(Ids == [])) :-
    nxt([], ( trigger_create(a, fail, true), timer_create(a, 1, true) )),
    findall(Id, event(Id, _), Ids).
test(may_create_triggers, true(All == [x-1.0, y-3.0])) :-
    nxt([], ( trigger_create(a, flips,
                             [ see(x),
                               trigger_create(b, flips_again, see(y)) ]),
              wait(6), all_seen(All) )).
test(must_not_wait_in_a_condition,
     error(permission_error(wait, guard, nxt_trigger(a)))) :-
    nxt([], ( trigger_create(a, nxt_go_cm(300, 1), true), wait(1) )).
test(have_timers, true(All == [once-1.0, twice-1.5, twice-3.0])) :-
    nxt([], ( timer_create(a, 1, see(once)),
              timer_create(b, 1.5, [see(twice)], 2),
              wait(6), all_seen(All) )).
test(timers_are_killed, true(All == [])) :-
    nxt([], ( timer_create(a, 1, see(a)), timer_create(b, 1, see(b)),
              timer_kill(a), timer_killall, wait(3), all_seen(All) )).
test(are_listed, true(Ids == [nxt_trigger(a), nxt_timer(b)])) :-
    nxt([], ( trigger_create(a, fail, true), timer_create(b, 1, true), on(fail, true),
              setup_call_cleanup(
                  asserta((user:message_hook(ev3dev(plnxt_events(Listed)), _, _) :-
                               assertz(user:seen(Listed))), Ref),
                  nxt_threads,
                  erase(Ref)),
              all_seen([Ids]) )).

% True from 1 to 2 s, from 3 to 4 s, ...
flips :-
    ev3_time(Time),
    1 is truncate(Time) mod 2.

flips_again :-
    ev3_time(Time),
    Time >= 3.
:- end_tests(triggers).

:- begin_tests(programs).
test(sleep_is_a_wait, true(All == [x-1.0, slept-2.0])) :-
    nxt([], ( trigger_create(a, plunit_triggers:flips, see(x)),
              sleep(2), see(slept), all_seen(All) )).
test(find_the_file_beside_them) :-
    exists_file('examples/plnxt.pl').
:- end_tests(programs).
