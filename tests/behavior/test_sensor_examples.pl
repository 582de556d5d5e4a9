% The examples that need other sensors than the paper's robot has, run.

:- use_module('../support/trees').
:- load_files(thermometer:example(thermometer), []).
:- load_files(remote_control:example(remote_control), []).

:- begin_tests(thermometer).
test(shows_how_warm_it_is,
     [ forall(( behaving(Tree),
                member(Type, ['lego-nxt-temp', 'ms-ir-thermometer']) )),
       true(Shown == "  -4.5 C = \n") ]) :-
    with_sensor(Tree, Type, [temperature(-4.5)],
                with_output_to(string(Shown), thermometer:thermometer(1))).
test(has_a_star_a_degree, true(Shown == "  19.6 C = ********************\n")) :-
    with_tree(plain, [in1-'lego-nxt-temp'],
              ( put_attribute(in1, value0, 196),
                with_output_to(string(Shown), thermometer:thermometer(1)) )).
test(tells_the_trend, [ forall(member(Before-Now-Sign, [ 20.0-20.1-(=), 20.0-19.9-(=),
                                                         20.0-20.2-(+), 20.0-19.0-(-) ])),
                        true(S == Sign) ]) :-
    thermometer:trend(Before, Now, S).
test(goes_on, true(Lines == ["  21.5 C = **********************",
                             "  21.5 C = **********************", ""])) :-
    with_tree(plain, [in1-'lego-nxt-temp'],
              with_output_to(string(Shown), thermometer:thermometer(2))),
    split_string(Shown, "\n", "", Lines).
test(goes_on_until_the_sensor_is_gone, true(Lines >= 2)) :-
    with_tree(plain, [in1-'lego-nxt-temp'],
              ( later(3, unplug(in1)),
                with_output_to(string(Shown), ignore(thermometer:thermometer)) )),
    split_string(Shown, "\n", "", Parts),
    length(Parts, Count),
    Lines is Count - 1.
test(fails_without_a_sensor, [fail]) :-
    with_tree(plain, thermometer:thermometer).
:- end_tests(thermometer).

:- begin_tests(remote_control).
test(goes_turns_and_stops_as_it_is_told, true(End-States == true-([]/[]))) :-
    with_sensor(simulator, 'lego-ev3-ir', [],
                setup_call_cleanup(
                    thread_create(remote_control:drive, Robot, []),
                    ( told([red_up, blue_up], ( sim_pose(_, Y, _), Y > 10 )),
                      sim_pose(X, _, Heading),
                      near(X, 0, 1), near(Heading, 0, 3),
                      told([blue_up], turns(0, 1)),
                      told([red_up, blue_down], turns(1, -1)),
                      told([], turns(0, 0)),
                      told([red_down, blue_down], turns(-1, -1)),
                      told([red_up, red_down], turns(0, 0)),
                      sim_remote(1, [red_up]),
                      sim_remote(2, [beacon])
                    ),
                    ( sim_remote(1, [beacon]),
                      thread_join(Robot, End),
                      motor_states(outB, Left), motor_states(outC, Right)
                    ))),
    States = Left/Right.
test(fails_without_an_infrared_sensor, [fail]) :-
    with_tree(plain, remote_control:drive).
test(fails_without_a_motor, [fail]) :-
    with_tree(plain, [in1-'lego-ev3-ir'],
              ( put_attribute(in1, mode, 'IR-REMOTE'),
                put_attribute(in1, value0, 1),
                remote_control:drive )).
test(the_wheels_stop_however_it_ends, true(End-Left == over-stop)) :-
    with_tree(plain, [in1-'lego-ev3-ir', outB-'lego-ev3-l-motor', outC-'lego-ev3-l-motor'],
              ( put_attribute(in1, mode, 'IR-REMOTE'),
                put_attribute(in1, value0, 1),
                thread_self(Me),
                meanwhile(( eventually(get_attribute(outB, command, 'run-forever')),
                            thread_signal(Me, throw(over)),
                            thread_get_message(never) ),
                          catch(remote_control:drive, End, true)),
                get_attribute(outB, command, Left) )).

:- meta_predicate told(+, 0).

% Hold these buttons until something has come of it.
told(Buttons, Goal) :-
    sim_remote(1, Buttons),
    eventually(Goal).

turns(Left, Right) :-
    speed(outB, L),
    speed(outC, R),
    Left =:= sign(L),
    Right =:= sign(R).
:- end_tests(remote_control).
