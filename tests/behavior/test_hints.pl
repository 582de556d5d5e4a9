% No call fails in silence for want of a device: once a predicate and cause there
% is a warning with what is connected, and a cure.

:- use_module('../support/child').
:- use_module('../support/trees').
:- use_module(library(ev3dev/drive)).
:- use_module(library(ev3dev/events), [every/3]).
:- use_module(library(ev3dev/grid)).
:- use_module(library(ev3dev/raw)).

%   The texts of the hints that Goal, which fails, prints in a session that has
%   had none.
hints(Goal, Texts) :-
    hints_of(once, Goal, Texts).

hints_of(Flag, Goal, Texts) :-
    with_flag(Flag, warnings(\+ Goal, Warnings)),
    findall(Text, member(ev3dev(hint(Text)), Warnings), Texts).

%   The same of a Goal that succeeds.

advice(Flag, Goal, Texts) :-
    with_flag(Flag, warnings(once(Goal), Warnings)),
    findall(Text, member(ev3dev(hint(Text)), Warnings), Texts).

with_flag(Flag, Goal) :-
    current_prolog_flag(ev3dev_hints, Before),
    retractall(ev3dev_hints:told(_)),
    setup_call_cleanup(
        set_prolog_flag(ev3dev_hints, Flag),
        Goal,
        set_prolog_flag(ev3dev_hints, Before)).

no_robot :-
    retractall(ev3dev_robot_state:described(_, _, _)).

a_robot :-
    set_robot(5.6, 10.6, outB, outC).

%   absent(Goal, Start): Goal fails for want of a device; so the hint begins.
absent(i2c_read(in9, 0, 8, _), 'there is no sensor at in9; there are: in1').
absent(i2c_write(in9, 65, [1]), 'there is no sensor at in9; there are: in1').
absent(analog_voltage(in1, _), 'in1 has lego-ev3-us, no analog sensor; there are: in1').
absent(analog_voltage(_, _), 'no analog sensor is connected; there are: in1').
absent(motor_run(outb, 50), 'there is no motor at outb; there are: outA').
absent(motor_run("outb", 50), 'there is no motor at outb; there are: outA').
absent(motor_run(in1, 50), 'in1 has lego-ev3-us, no motor; there are: outA').
absent(motor_run(outE, 50, 90), 'there is no motor at outE').
absent(motors_run([run(outB, 9), run(outE, 9)]), 'there is no motor at outE').
absent(motor_run_timed(outE, 50, 1), 'there is no motor at outE').
absent(motor_run_direct(outE, 50), 'there is no motor at outE').
absent(motor_run_until_stalled(outE, 50), 'there is no motor at outE').
absent(motor_start(outE), 'there is no motor at outE').
absent(motor_stop(outE), 'there is no motor at outE').
absent(motor_reset(outE), 'there is no motor at outE').
absent(run_forever(outE, 50), 'there is no motor at outE').
absent(motor_wait(outE, [], _), 'there is no motor at outE').
absent(motor_wait([outB, outE], [], _), 'there is no motor at outE').
absent(motor_wait_while(outE, running), 'there is no motor at outE').
absent(motor_position(outE, _), 'there is no motor at outE').
absent(motor_position(outE, 0), 'there is no motor at outE').
absent(motor_speed(outE, _), 'there is no motor at outE').
absent(motor_gear(outE, _), 'there is no motor at outE').
absent(motor_gear(outE, 3), 'there is no motor at outE').
absent(motor_ramps(outE, _, _), 'there is no motor at outE').
absent(motor_speed_pid(outE, _), 'there is no motor at outE').
absent(motor_hold_pid(outE, pid(1, 2, 3)), 'there is no motor at outE').
absent(motor_duty(outE, _), 'there is no motor at outE').
absent(motor_states(outE, _), 'there is no motor at outE').
absent(speed_file(outE, _), 'there is no motor at outE').
absent(dc_motor_ramps(outE, _, _), 'there is no motor without').
absent(dc_motor_duty(_, _), 'no motor without rotation sensor is connected').
absent(dc_motor_run_timed(outE, 50, 1), 'there is no motor without').
absent(dc_motor_run_direct(outB, 50), 'outB has lego-ev3-l-motor, no motor without').
absent(servo_motor_rate(sv1, _), 'there is no servo at sv1').
absent(servo_motor_angle(sv1, 9), 'there is no servo at sv1').
absent(sensor_info(in9, _), 'there is no sensor at in9').
absent(sensor_command(in9, 'RESET'), 'there is no sensor at in9').
absent(motor_polarity(outE, _), 'there is no motor at outE').
absent(motor_ramps(outE, 1, 1), 'there is no motor at outE').
absent(position(outE, _), 'there is no motor at outE').
absent(command(outE, stop), 'there is no motor at outE').
absent(speed_adjust(50, outE, _), 'there is no motor at outE').
absent(dc_motor_run(outE, 50), 'there is no motor without rotation sensor at outE').
absent(dc_motor_stop(outE), 'there is no motor without rotation sensor at outE').
absent(servo_motor_position(sv1, 5), 'there is no servo at sv1').
absent(servo_motor_position(_, _), 'no servo is connected').
absent(servo_motor_float(sv1), 'there is no servo at sv1').
absent(us_dist_cm(in2, _), 'in2 has lego-ev3-color, no ultrasonic sensor').
absent(us_dist_cm('In1', _), 'there is no ultrasonic sensor at In1').
absent(touch(in5, 1), 'there is no touch sensor at in5').
absent(touch(_, _), 'no touch sensor is connected; there are: in1').
absent(touch(_, 1), 'no touch sensor is connected; there are: in1').
absent(ir_prox(_, _), 'no infrared sensor is connected').
absent(ir_remote(in5, 1, _), 'there is no infrared sensor at in5').
absent(gyro_reset(in1), 'in1 has lego-ev3-us, no gyro').
absent(col_rgb_raw(in5, _), 'there is no color sensor at in5').
absent(compass(_, _), 'no ht-nxt-compass or ms-absolute-imu is connected').
absent(temperature(in5, _), 'there is no lego-nxt-temp or ').
absent(temperature(_, _), 'no lego-nxt-temp or ').
absent(acceleration(_, _, _, _), 'no ht-nxt-accel or ').
absent(sensor_value(in5, 'TOUCH', 0, _), 'there is no sensor with the mode TOUCH at in5').
absent(sensor_value(_, 'FOO', 0, _), 'no sensor with the mode FOO is connected').
absent(sensor_values(_, 'FOO', _), 'no sensor with the mode FOO is connected').
absent(value(in9, 0, _), 'there is no sensor at in9').
absent(mode(in9, 'TOUCH'), 'there is no sensor at in9').
absent(adjust_val(in9, 1, _), 'there is no sensor at in9').
absent(sensor_reading(foo, _, _), 'no sensor has a reading foo').
absent(set_robot(5, 9, outB, outE), 'there is no motor at outE').
absent(set_robot(5, 9, outA, outB),
       'outA (lego-ev3-m-motor) and outB (lego-ev3-l-motor) are motors of different types').
absent(set_robot(5, 9, outB, outB), 'outB is one motor, and a robot needs two').
absent(us_dist_cm(in1, white), 'us_dist_cm/2 gives a number, not white').
absent(us_dist_cm(_, in1), 'us_dist_cm/2 gives a number, not in1: the port is the first').
absent(us_dist_cm(in1, _ < 20), 'us_dist_cm/2 gives a number, not ').
absent(col_color(in2, white), 'col_color/2 gives a number, not white: white is 6').
absent(col_color(_, "red"), 'col_color/2 gives a number, not "red": red is 5').
absent(led(nowhere, red), 'there is no light nowhere').
absent(led(nowhere, _), 'there is no light nowhere').
absent(led_trigger(nowhere, none), 'there is no light nowhere').
absent(led_blink(nowhere, _, _), 'there is no light nowhere').
absent(led_blink(nowhere, 5, 5), 'there is no light nowhere').
absent(port_mode(in9, _), 'there is no port in9').
absent(port_mode(in9, auto), 'there is no port in9').
absent(port_status(in9, _), 'there is no port in9').
absent(port_device(in9, 'lego-ev3-us'), 'there is no port in9').
absent(plan_and_go_to([1, 1], _), 'there is no grid').
absent(state_position(_, _), 'there is no grid').
absent(grid_place([0, 0], [0, 1]), 'there is no grid').

%   impossible(Goal, Start): what the robot that is set cannot do.
impossible(motor_run(outB, 150), 'outB cannot run at 150 %').
impossible(motor_run(outB, -150, 9), 'outB cannot run at -150 %').
impossible(motors_run([run(outB, 50), run(outC, 101)]), 'outC cannot run at 101 %').
impossible(motor_run(outB, 0, 90), 'outB cannot move at a speed of 0').
impossible(run_forever(outB, 99999), 'outB cannot run at a speed_sp of 99999').
impossible(go(150), 'outB cannot run at 150 %').
impossible(turn(150), 'outB cannot run at 150 %').
impossible(go(150, 90), 'the robot cannot run at 150 %').
impossible(go_cm(150, 90), 'the robot cannot run at 150 %').
impossible(turn(150, 90), 'the robot cannot run at 150 %').
impossible(go_cm(0, 90), 'the robot cannot move at a speed of 0').
impossible(turn(0, 90), 'the robot cannot move at a speed of 0').
impossible(drive_cm(5000, 0),
           'the robot cannot go at 5000 cm/s and turn by 0 degrees/s').
impossible(turn(20, 1.0e308), 'the robot cannot make a move that is so long or so slow').
impossible(go_to(1.0e308, 0), 'the robot cannot make a move that is so long or so slow').
impossible(go_cm(0.001, 9), 'the robot cannot make a move that is so long or so slow').
impossible(motor_run(outB, 50, 1.0e308), 'outB cannot turn by 1.0e+308 degrees').
impossible(motor_run(outB, 0.001, 9), 'outB cannot turn by 9 degrees at 0.001 %').
impossible(motor_run_to(outB, 50, 1.0e308), 'outB cannot turn to 1.0e+308 degrees').
impossible(motor_run_timed(outB, 0.001, 2), 'outB cannot run for 2 s at 0.001 %').
impossible(motors_turn([move(outB, 20, 9), move(outC, 20, 1.0e300)], []),
           'outC cannot turn by 1.0e+300 degrees').
impossible(( motor_gear(outB, 3), motor_run(outB, dps(400)) ),
           'outB cannot run at 114 %').
impossible(go(cm_per_s(500)), 'outB cannot run at 974.4 %').
impossible(led(left, blue), 'left cannot show blue').
impossible(sim_press(in4), 'in4 has lego-ev3-gyro, no touch sensor').
impossible(sim_release(in4), 'in4 has lego-ev3-gyro, no touch sensor').
impossible(sim_unplug(outD), 'nothing is plugged into outD').
impossible(( every(0.1, stop, [count(1)]), go_cm(20, 50) ),
           'the robot did not arrive: another command').
impossible(( every(0.1, stop, [count(1)]), motor_run(outB, 20, 900) ),
           'outB did not arrive: another command').

%   strange(Goal, Start): Goal succeeds, but nobody means its units or options.
strange(set_robot(56, 106, outB, outC),
        'these are wheels of 56 cm and an axle of 106 cm: set_robot/4 expects cm').
strange(set_robot(0.056, 0.106, outB, outC), 'these are wheels of 0.056 cm').
strange(set_robot(10.6, 5.6, outB, outC), 'the wheels, 10.6 cm, are larger than the axle').
strange(tone(440, 0.5), 'that is 0.5 ms: tone/2 expects milliseconds').
strange(led_blink(left, 1, 1), 'that is 1 ms: led_blink/3 expects milliseconds').
strange(motor_run_timed(outB, 50, 2000), 'that takes 33 minutes: motor_run_timed/3 expects').
strange(motor_run(outB, 50, 9, [stop_action(brake), stop_action(coast)]),
        'the option stop_action is given twice').
strange(go_cm(20, 5, [timeout(9), timeout=3]), 'the option timeout is given twice').

%   What is as it should be.
usual(set_robot(5.6, 10.6, outB, outC)).
usual(set_robot(3, 6, outB, outC)).
usual(set_robot(8.2, 20, outB, outC)).
usual(tone(440, 100)).
usual(tone(440, 0)).
usual(led_blink(left, 10, 9)).
usual(led_blink(left, 9, 10)).
usual(motor_run_timed(outB, 50, 20)).
usual(motor_run_timed(outB, 50, 1, [stop_action(hold)])).
usual(motor_run_timed(outB, 50, 1, [ramp_up(100)])).
usual(with_sim(room, true, [clock(virtual)])).
usual(col_color(in2, _)).
usual(( every(0.1, stop, [count(1)]), ignore(go_cm(20, 0)) )).

%   A call of the robot before set_robot/4.
early(Goal) :-
    member(Goal,
           [ go(20), go(20, 90), go_cm(20, 10), turn(20), turn(20, 90),
             pose(_, _, _), set_pose(0, 0, 0), go_to(10, 10),
             go_to(10, 10, 0), face(90), drive_cm(10, 0), steer(20, 10),
             arc(20, 10), arc_cm(20, 10, 90), set_grid([]),
             pose_uncertainty(_), calibrate(axle, [], _) ]).

begins(Text, Start) :-
    sub_atom(Text, 0, _, _, Start).

:- begin_tests(hints, [setup(no_robot)]).
test(what_is_missing_is_told_once,
     [forall(( tree(Tree), absent(Goal, Start) )), true(Texts = [_])]) :-
    with_tree(Tree, [ in1-'lego-ev3-us', in2-'lego-ev3-color',
                      outA-'lego-ev3-m-motor', outB-'lego-ev3-l-motor',
                      outC-'lego-ev3-l-motor' ],
              hints(( Goal ; Goal ), Texts)),
    Texts = [Text],
    assertion(begins(Text, Start)).
test(a_port_at_which_nothing_appears_is_told,
     true(Texts == ['nothing came of dc-motor at outA'])) :-
    with_tree(plain, [port(outA)-'ev3-output-port'],
              hints(port_mode(outA, 'dc-motor'), Texts)).
test(what_is_impossible_is_told_once,
     [forall(( behaving(Tree), impossible(Goal, Start) )), true(Texts = [_])]) :-
    on(Tree, ( a_robot, hints(( Goal ; Goal ), Texts) )),
    Texts = [Text],
    assertion(begins(Text, Start)).
test(what_nobody_means_is_told_once,
     [forall(strange(Goal, Start)), true(Texts = [_])]) :-
    on(simulator, ( a_robot, advice(once, Goal, Texts) )),
    Texts = [Text],
    assertion(begins(Text, Start)).
test(advice_is_no_error, [forall(strange(Goal, _))]) :-
    on(simulator, ( a_robot, advice(error, Goal, _) )).
test(advice_can_be_off, [forall(strange(Goal, _)), true(Texts == [])]) :-
    on(simulator, ( a_robot, advice(off, Goal, Texts) )).
test(nothing_is_told_of_what_is_usual, [forall(usual(Goal)), true(Texts == [])]) :-
    on(simulator, ( a_robot, advice(once, Goal, Texts) )).
test(a_robot_is_to_be_set_first,
     [ forall(early(Goal)), setup(no_robot),
       true(Texts == ['no robot is set: see set_robot/4']) ]) :-
    on(simulator, hints(Goal, Texts)).
test(each_predicate_is_told_once, true(Texts = [Text, Text])) :-
    on(simulator,
       ( a_robot, sim_unplug(outC), sim_step(1),
         hints(( go_cm(20, 10) ; go_cm(30, 9) ; turn(9, 9) ; go_cm(20, 0) ; turn(20, 0) ),
               Texts) )),
    Texts = [Text|_],
    assertion(begins(Text, 'there is no motor at outC; there are: outA')).
test(each_call_of_a_robot_that_has_lost_a_motor,
     [ forall(member(Goal, [ go(20), go(20, 9), go_cm(20, 0), turn(20, 0), stop,
                             pose(_, _, _), set_pose(0, 0, 0), pose_uncertainty(_),
                             drive_cm(9, 9), face(9), go_to(9, 9), set_grid([]) ])),
       true(Texts = [_]) ]) :-
    on(simulator,
       ( a_robot, sim_unplug(outC), sim_step(1), hints(Goal, Texts) )),
    Texts = [Text],
    assertion(begins(Text, 'there is no motor at outC; there are: outA')).
test(a_gyro_is_needed_to_calibrate, true(Texts = [_])) :-
    in_touch_world(( a_robot, hints(calibrate(axle, [], _), Texts) )),
    Texts = [Text],
    assertion(begins(Text, 'no gyro is connected')).
test(nothing_is_told_where_the_answer_is_no,
     [ forall(member(Goal,
                     [ touch(_, 1), touch(in4, 1), touch(in4, 7),
                       us_dist_cm(_, 7), speed(outB, 77), speed(_, 77), tacho_motor(outD), tacho_motor(_, foo),
                       lego_sensor(in5), ultrasonic_sensor(in4), gyro_sensor(in4),
                       dc_motor(_), servo_motor(_), lego_port(in9),
                       led(nowhere), led(left, off), led_blink(left, _, _),
                       button(enter), button_wait(_, _, [timeout(0.1)]),
                       motor_run(outB, 20, 360, [timeout(0.1)]),
                       sensor_mode(foo, _, _, _, _, _),
                       state(outB, running), battery(type, foo) ])),
       true(Texts == []) ]) :-
    in_touch_world(hints(Goal, Texts)).

in_touch_world(Goal) :-
    setup_call_cleanup(
        sim_start(room, [clock(virtual), robot(touch)]),
        Goal,
        sim_stop).

test(a_name_that_was_nearly_right_is_suggested,
     [ forall(member(Goal-End,
                     [ motor_run(outb, 50)-'. Did you mean outB?',
                       motor_run('OUTB', 50)-'. Did you mean outB?',
                       motor_run(b, 50)-'. Did you mean outB?',
                       motor_run('B', 50)-'. Did you mean outB?',
                       motor_run(motor_b, 50)-'. Did you mean outB?',
                       us_dist_cm('IN1', _)-'. Did you mean in1?',
                       us_dist_cm(s1, _)-'. Did you mean in1?',
                       led(lef, red)-'. Did you mean left?',
                       motor_run(outD, 50)-'outC (lego-ev3-l-motor)',
                       motor_run(outE, 50)-'outC (lego-ev3-l-motor)' ])),
       true(Texts = [_]) ]) :-
    on(simulator, hints(Goal, Texts)),
    Texts = [Text],
    assertion(sub_atom(Text, _, _, 0, End)).
test(what_was_just_plugged_in_takes_a_while, true(Texts = [_])) :-
    in_touch_world(
        ( sim_unplug(in1), sim_step(1),
          sim_plug(in1, 'lego-ev3-us'),
          hints(us_dist_cm(in1, _), Texts) )),
    Texts = [Text],
    assertion(begins(Text, 'there is no ultrasonic sensor at in1 yet')).
test(where_nothing_is_connected_the_directory_is_told,
     [forall(tree(Tree)), true(Texts = [_])]) :-
    with_tree(Tree, [], ( ev3_sysfs(Directory), hints(touch(_, _), Texts) )),
    Texts = [Text],
    atom_concat('nothing is connected in ', Directory, End),
    assertion(sub_atom(Text, _, _, 0, End)).
test(without_a_simulation_the_simulator_says_so,
     [ forall(member(Goal, [ sim_pose(_, _, _), sim_stop, sim_wait(1), sim_step(1),
                             sim_press(enter), sim_press(enter, []),
                             sim_add(circle(1, 1, 1)), sim_plug(in1, 'lego-ev3-us'),
                             sim_snapshot(_), sim_trace(_), sim_time(_) ])),
       true(Texts == ['no simulation runs: see sim_start/1']) ]) :-
    hints(Goal, Texts).
test(a_brick_without_buttons_or_speaker,
     [ forall(member(Goal, [ button(_), button(enter), button_wait(_, _),
                             button_wait(_, _, [timeout(1)]), button_events(_),
                             battery(voltage, _), screen_show, tone(440, 10) ])),
       condition(tree(plain)), true(Texts = [_]) ]) :-
    with_tree(plain, [],
              setup_call_cleanup(
                  ( ev3_dev(Before), tree_root(Root), ev3_dev(Root) ),
                  hints(Goal, Texts),
                  ev3_dev(Before))).
:- end_tests(hints).

:- begin_tests(flag, [setup(no_robot)]).
test(is_once_at_first) :-
    run_program(":- use_module(library(ev3dev)).\n",
                [ goal('current_prolog_flag(ev3dev_hints, once)'),
                  hints(default)
                ], exit(0), _).
test(may_be_set_before_the_pack_is_loaded) :-
    run_program(":- use_module(library(ev3dev)).\n",
                [ goal('current_prolog_flag(ev3dev_hints, error)'),
                  hints(error)
                ], exit(0), _).
test(a_program_that_tries_again_and_again_is_told_once) :-
    run_program(":- use_module(library(ev3dev)).\n",
                [ goal('\\+ ( between(1, 9, _), touch(in5, 1) )'),
                  env('EV3DEV_SYSFS'='/tmp'), hints(default)
                ], _, Output),
    findall(At, sub_string(Output, At, _, _, "no touch sensor at in5"), [_]).
test(off_tells_nothing, true(Texts == [])) :-
    on(simulator, hints_of(off, motor_run(outb, 50), Texts)).
test(error_throws_what_is_missing,
     [ forall(( tree(Tree),
                member(Goal-Formal,
                       [ motor_run(outE, 50)-existence_error(motor, outE),
                         position(outE, _)-existence_error(motor, outE),
                         us_dist_cm(in9, _)-existence_error(sensor, in9),
                         touch(_, _)-existence_error(sensor, any),
                         led(nowhere, red)-existence_error(light, nowhere),
                         go(20)-existence_error(robot, any),
                         motor_run(outB, 150)-domain_error(speed, 150),
                         motor_wait(outE, [], _)-existence_error(motor, outE),
                         gyro_reset(in1)-existence_error(sensor, in1) ]) )),
       setup(no_robot), true(Caught-Called == Formal-Name/Arity) ]) :-
    functor(Goal, Name, Arity),
    with_tree(Tree,
              with_flag(error,
                        catch(Goal, error(Caught, context(Called, _)), true))).
test(an_error_of_stop_comes_when_the_other_motor_is_stopped,
     [true(Speed == 0)]) :-
    on(simulator,
       ( a_robot, go(20), sim_unplug(outB), sim_step(1),
         with_flag(error, catch(stop, error(existence_error(motor, outB), _), true)),
         sim_step(1), speed(outC, Speed) )).
test(the_words_of_the_error_are_those_of_the_hint, true(Text == Message)) :-
    on(simulator,
       ( hints(motor_run(outb, 50), [Text]),
         with_flag(error, catch(motor_run(outb, 50),
                                error(_, context(_, Message)), true)) )).
test(what_has_been_told_is_bounded, true(Count == 100)) :-
    on(simulator,
       hints(( between(1, 300, N),
               atom_concat(port, N, Port),
               motor_run(Port, 50) ),
             Texts)),
    length(Texts, Count).
:- end_tests(flag).

:- begin_tests(debug, [setup(no_robot)]).
%   What `debug(ev3dev)` says of Goal, which fails, if hints are off.
said_of(Goal, Said) :-
    setup_call_cleanup(
        ( debug(ev3dev),
          asserta((prolog:debug_print_hook(ev3dev, Format, Arguments) :-
                       format(atom(Line), Format, Arguments),
                       assertz(plunit_debug:said(Line))),
                  Hook)
        ),
        \+ Goal,
        ( erase(Hook),
          nodebug(ev3dev)
        )),
    findall(Line, retract(said(Line)), Said).

:- dynamic said/1.
:- multifile prolog:debug_print_hook/3.
:- dynamic prolog:debug_print_hook/3.

test(says_what_a_hint_says_each_time,
     [forall(( tree(Tree), absent(Goal, Start) )), true(Said = [_, _])]) :-
    with_tree(Tree, [ in1-'lego-ev3-us', in2-'lego-ev3-color',
                      outA-'lego-ev3-m-motor', outB-'lego-ev3-l-motor',
                      outC-'lego-ev3-l-motor' ],
              said_of(( Goal ; Goal ), Said)),
    forall(member(Text, Said), assertion(begins(Text, Start))).
test(says_how_a_move_ended) :-
    on(simulator, said_of(motor_run(outB, 20, 360, [timeout(0.1)]), [Said])),
    assertion(sub_atom(Said, _, _, 0, 'ended early: timeout')).
test(in_a_fresh_session_the_topic_is_known) :-
    run_program(":- use_module(library(ev3dev)).\n", [goal('debug(ev3dev)')],
                exit(0), Output),
    assertion(Output == "").
:- end_tests(debug).
