:- use_module('../support/trees').
:- use_module('../support/child').
:- use_module('../support/simulation', [near/3]).
:- use_module('../support/old_prolog').
:- use_module(library(ev3dev/odometry), [pose/3]).

% The paper's robot, without a gyro unless one is asked for.
with_robot(Tree, Goal) :-
    with_robot(Tree, [], Goal).

with_robot(Tree, Sensors, Goal) :-
    append(Sensors,
           [ outA-'lego-ev3-m-motor', outB-'lego-ev3-l-motor',
             outC-'lego-ev3-l-motor' ],
           Devices),
    with_tree(Tree, Devices,
              ( set_robot(5.6, 10.6, outB, outC),
                Goal )).

with_drive(Tree, Goal) :-
    with_drive(Tree, [], Goal).

with_drive(Tree, Sensors, Goal) :-
    patiently(Tree, with_robot(Tree, Sensors, Goal)).

wheels(Attribute, Left-Right) :-
    get_attribute(outB, Attribute, Left),
    get_attribute(outC, Attribute, Right).

% The wheels are there, within the tolerance of a motor.
wheels_near(Left, Right, Tolerance) :-
    current_tree(Tree),
    settle(Tree),
    wheels(position, L-R),
    atom_number(L, AtLeft),
    atom_number(R, AtRight),
    near(AtLeft, Left, Tolerance),
    near(AtRight, Right, Tolerance).

% On a busy machine a time limit may come before the wheels have started.
wheels_left(Left) :-
    wheels(command, C),
    (   memberchk(C, [stop-stop, ''-''])
    ->  Left = at_rest
    ;   Left = C
    ).

running :-
    runs(outB),
    runs(outC).

% ---------------- DESCRIPTION

:- begin_tests(set_robot).
test(is_remembered,
     [forall(tree(Tree)), true([W, A, L, R] == [5.6, 10.6, outB, outC])]) :-
    with_robot(Tree, robot(W, A, L, R)).
test(replaces_the_robot_before,
     [forall(tree(Tree)), all(W-L == [3-outC])]) :-
    with_robot(Tree, ( set_robot(3, 8, outC, outB),
                       robot(W, _, L, _) )).
test(takes_the_long_spelling_of_ports,
     [forall(tree(Tree)), true(W == '525'-'525')]) :-
    with_robot(Tree, ( set_robot(5.6, 10.6, 'ev3-ports:outB', 'ev3-ports:outC'),
                       go(50),
                       wheels(speed_sp, W) )).
test(fails_and_changes_nothing_unless_two_equal_motors_are_there,
     [ forall(( tree(Tree),
                member(L-R, [ outA-outB, outB-outB, outB-'ev3-ports:outB',
                              outB-outE, outE-outB, in1-outB ]) )),
       all(Left-Right == [outB-outC]) ]) :-
    with_robot(Tree, ( \+ set_robot(5.6, 10.6, L, R),
                       robot(_, _, Left, Right) )).
test(a_wrong_argument_throws_and_changes_nothing,
     [ forall(( tree(Tree),
                member([W, A, L, R]-Error,
                       [ [_, 1, outB, outC]-instantiation_error,
                         [1, _, outB, outC]-instantiation_error,
                         [1, 1, _, outC]-instantiation_error,
                         [1, 1, outB, _]-instantiation_error,
                         [x, 1, outB, outC]-type_error(evaluable, x/0),
                         [0, 1, outB, outC]-domain_error(positive_number, 0),
                         [1, -1, outB, outC]-domain_error(positive_number, -1),
                         [1, 1, 7, outC]-type_error(atom, 7) ]) )),
       true(Caught-Left == caught-outB) ]) :-
    with_robot(Tree, ( catch(set_robot(W, A, L, R), error(Error, _), Caught = caught),
                       robot(_, _, Left, _) )).
test(an_option_that_is_none_throws,
     [forall(tree(Tree)), error(domain_error(robot_option, axle_ofset(1)), _)]) :-
    with_robot(Tree, set_robot(5.6, 10.6, outB, outC, [axle_ofset(1)])).
test(a_length_that_is_no_length_throws,
     [ forall(( tree(Tree),
                member(Length0, [inf, nan, 10**400, -1.0e308]), evaluated(Length0, Length) )),
       error(domain_error(positive_number, _), _) ]) :-
    with_robot(Tree, set_robot(Length, 10.6, outB, outC)).
test(writes_nothing, [forall(tree(Tree)), true(W == [])]) :-
    with_robot(Tree, written(W)).
:- end_tests(set_robot).

:- begin_tests(no_robot, [ setup(retractall(ev3dev_robot_state:described(_, _, _))) ]).
test(nothing_can_be_done_without_a_robot,
     [ forall(( tree(Tree),
                member(Goal, [ robot(_, _, _, _), go(50), go(50, 90), go(50, 0),
                               go_cm(50, 10), turn(50), turn(50, 90) ]) )),
       true(W == []) ]) :-
    with_tree(Tree, ( \+ Goal,
                      written(W) )).
test(stop_stops_all_motors,
     [forall(tree(Tree)), true(Bs == [brake-stop, brake-stop])]) :-
    with_tree(Tree, ( motor_run(outA, 50),
                      motor_run(outD, 20),
                      stop,
                      findall(Action-Command,
                              ( member(Port, [outA, outD]),
                                get_attribute(Port, stop_action, Action),
                                get_attribute(Port, command, Command) ),
                              Bs) )).
:- end_tests(no_robot).

% ---------------- GOING

:- begin_tests(go).
test(go_1_runs_both_wheels,
     [forall(tree(Tree)), true(S-C == ('525'-'525')-('run-forever'-'run-forever'))]) :-
    with_robot(Tree, ( go(50),
                       wheels(speed_sp, S),
                       wheels(command, C) )).
test(go_1_backwards, [forall(tree(Tree)), true(S == '-525'-'-525')]) :-
    with_robot(Tree, ( go(-50),
                       wheels(speed_sp, S) )).
test(go_1_takes_an_expression,
     [forall(tree(Tree)), true(S == '262'-'262')]) :-
    with_robot(Tree, ( go(min(50, 100 / 4)),
                       wheels(speed_sp, S) )).
test(go_2_turns_both_wheels_and_waits,
     [forall(behaving(Tree)), true(A == hold-hold)]) :-
    with_drive(Tree, ( go(50, 180),
                       wheels_near(180, 180, 3),
                       wheels(stop_action, A) )).
test(go_2_has_the_sign_of_both,
     [forall(( behaving(Tree),
               member(Speed-Angle-D, [ -50-180-(-180), 50-(-180)-(-180),
                                       -50-(-180)-180 ]) ))]) :-
    with_drive(Tree, ( go(Speed, Angle),
                       wheels_near(D, D, 3) )).
test(go_cm_is_the_papers_formula,
     [forall(( behaving(Tree),
               member(Distance, [10, -3, 20.5]) ))]) :-
    Angle is Distance * 360 / (pi * 5.6),
    with_drive(Tree, ( go_cm(20, Distance),
                       wheels_near(Angle, Angle, 3) )).
test(an_impossible_move_fails_and_writes_nothing,
     [ forall(( tree(Tree),
                member(Goal, [ go(101), go(10**400), turn(101),
                               go(0, 90), go(101, 90), go(50, 10**400),
                               go_cm(0, 10), go_cm(101, 10), turn(0, 90),
                               go(101, 0), go_cm(101, 0), turn(101, 0) ]) )),
       true(W == []) ]) :-
    with_robot(Tree, ( \+ Goal,
                       written(W) )).
test(nothing_to_do_is_done,
     [ forall(( tree(Tree),
                member(Goal, [ go(50, 0), go(50, 0.0), go_cm(50, 0), turn(50, 0),
                               go_cm(-50, 0), go(0), turn(0) ]) )) ]) :-
    with_robot(Tree, ( Goal,
                       settle(Tree),
                       speed(outB, 0),
                       speed(outC, 0) )).
test(an_infinite_speed_fails_and_writes_nothing,
     [forall(( tree(Tree), evaluated(inf, Speed) )), true(W == [])]) :-
    with_robot(Tree, ( \+ go(Speed),
                       written(W) )).
test(a_motor_that_is_missing_fails_and_starts_none,
     [ forall(( tree(Tree),
                member(Goal, [ go(50), go(50, 90), go_cm(50, 10), turn(50), turn(50, 90),
                               go(50, 0), go_cm(50, 0), turn(50, 0) ]) )),
       true(W == []) ]) :-
    with_robot(Tree, ( unplug(outC),
                       \+ Goal,
                       written(outB, W) )).
test(what_is_no_number_throws_and_writes_nothing,
     [ forall(( tree(Tree),
                member(Goal-Error,
                       [ go(_)-instantiation_error,
                         go(fast)-type_error(evaluable, fast/0),
                         go(_, 90)-instantiation_error,
                         go(50, _)-instantiation_error,
                         go(50, far)-type_error(evaluable, far/0),
                         go_cm(50, _)-instantiation_error,
                         go_cm(50, far)-type_error(evaluable, far/0),
                         turn(_)-instantiation_error,
                         turn(fast)-type_error(evaluable, fast/0),
                         turn(_, 90)-instantiation_error,
                         turn(50, _)-instantiation_error,
                         turn(50, far)-type_error(evaluable, far/0) ]) )),
       true(Caught-W == caught-[]) ]) :-
    with_robot(Tree, ( catch(Goal, error(Error, _), Caught = caught),
                       written(W) )).
:- end_tests(go).

:- begin_tests(stop).
test(brakes_both_wheels,
     [forall(tree(Tree)), true(C-A == (stop-stop)-(brake-brake))]) :-
    with_robot(Tree, ( go(50),
                       stop,
                       wheels(command, C),
                       wheels(stop_action, A) )).
test(stops_the_other_wheel_when_one_is_missing,
     [ forall(( tree(Tree),
                member(Missing-Other, [outB-outC, outC-outB]) )), true(C == stop) ]) :-
    with_robot(Tree, ( go(50),
                       unplug(Missing),
                       \+ stop,
                       get_attribute(Other, command, C) )).
test(from_another_thread_ends_a_move_which_fails,
     [forall(tree(Tree)), true(Ended-Ws == fails-[])]) :-
    with_robot(Tree, ( running,
                       meanwhile(( eventually(wheels(command, 'run-forever'-'run-forever')),
                                   stop,
                                   stops(outB),
                                   stops(outC) ),
                                 warnings(( go_cm(5, 10000)
                                          -> Ended = succeeds ; Ended = fails ), Ws)) )).
:- end_tests(stop).

:- begin_tests(interrupted).
test(a_time_limit_stops_both_wheels,
     [ forall(( tree(Tree),
                member(Goal, [go_cm(5, 10000), go(5, 360000), turn(5, 36000)]) )),
       true(E-Left == time_limit_exceeded-at_rest) ]) :-
    with_robot(Tree, ( running,
                       catch(call_with_time_limit(0.05, Goal), E, true),
                       wheels_left(Left) )).
test(a_signal_stops_both_wheels,
     [forall(tree(Tree)), true(E-C == enough-(stop-stop))]) :-
    with_robot(Tree, ( running,
                       thread_self(Me),
                       later(0.05, thread_signal(Me, throw(enough))),
                       catch(go_cm(20, 1000), E, true),
                       wheels(command, C) )).
test(an_unplugged_wheel_stops_the_other_one,
     [ forall(( tree(Tree), member(Gone-Other, [outB-outC, outC-outB]) )),
       true(F-C == existence_error(motor, Gone)-stop) ]) :-
    with_robot(Tree, ( running,
                       later(0.05, unplug(Gone)),
                       catch(go_cm(20, 1000), error(F, context(_/_, _)), true),
                       get_attribute(Other, command, C) )).
test(a_blocked_wheel_stops_both_and_fails,
     [forall(tree(Tree)), true(Ws-C == [ev3dev(stalled([outB, outC]))]-(stop-stop))]) :-
    with_robot(Tree, ( running,
                       block(outB),
                       warnings(go_cm(20, 100), Ws),
                       wheels(command, C) )).
:- end_tests(interrupted).

% ---------------- TURNING

:- begin_tests(turn_without_gyro).
test(turn_1_runs_the_wheels_against_each_other,
     [forall(tree(Tree)), true(S == '525'-'-525')]) :-
    with_robot(Tree, ( turn(50),
                       wheels(speed_sp, S) )).
test(turn_1_beyond_max_speed_fails_and_writes_nothing,
     [forall(tree(Tree)), true(W == [])]) :-
    with_robot(Tree, ( \+ turn(101),
                       written(W) )).
test(turn_2_is_the_papers_formula,
     [forall(( behaving(Tree),
               member(Speed-Degrees-Sign, [20-90-1, 20-(-90)-1, -20-90-(-1), 20-45.5-1]) ))]) :-
    Left is Sign * 10.6 / 5.6 * Degrees,
    Right is -Left,
    with_drive(Tree, ( turn(Speed, Degrees),
                       wheels_near(Left, Right, 3) )).
test(turn_2_by_nothing_succeeds, [forall(( tree(Tree),
                                           member(Speed, [20, -20]) ))]) :-
    with_drive(Tree, ( turn(Speed, 0),
                       wheels_near(0, 0, 1) )).
test(an_impossible_turn_fails_and_writes_nothing,
     [ forall(( tree(Tree),
                member(Goal, [ turn(0, 90), turn(101, 90), turn(20, 1.0e300) ]) )),
       true(W == []) ]) :-
    with_robot(Tree, ( \+ Goal,
                       written(W) )).
:- end_tests(turn_without_gyro).

gyro_angle(Angle) :-
    get_attribute(in4, value0, Text),
    atom_number(Text, Angle).

gyro([in4-'lego-ev3-gyro']).

:- begin_tests(turn_with_gyro).
test(ends_within_a_degree_and_holds_both,
     [ forall(( behaving(Tree),
                member(Speed-Degrees-Target, [ 40-90-90, 40-(-60)-(-60), -40-60-(-60) ]) )),
       true(A == hold-hold) ]) :-
    gyro(Gyro),
    with_drive(Tree, Gyro, ( turn(Speed, Degrees),
                             gyro_angle(Angle),
                             near(Angle, Target, 1),
                             wheels(stop_action, A) )).
test(by_nothing_it_succeeds, [forall(tree(Tree))]) :-
    gyro(Gyro),
    with_drive(Tree, Gyro, ( turn(20, 0), wheels_near(0, 0, 1) )).
test(starts_from_whatever_the_gyro_shows, [forall(behaving(Tree))]) :-
    gyro(Gyro),
    with_drive(Tree, Gyro, ( turn(50, 100),
                             gyro_angle(Before),
                             turn(40, 45),
                             gyro_angle(After),
                             Turned is After - Before,
                             near(Turned, 45, 1) )).
test(nothing_moves_then_it_fails_with_a_warning_and_stops,
     [forall(tree(Tree)), true(Ws-C == [ev3dev(stalled([outB, outC]))]-(stop-stop))]) :-
    gyro(Gyro),
    with_robot(Tree, Gyro, ( block(outB),
                       block(outC),
                       warnings(turn(20, 90), Ws),
                       wheels(command, C) )).
test(the_gyro_counts_the_other_way_then_it_fails_with_a_warning_and_stops,
     [ forall(( behaving(Tree), member(Goal, [turn(40, 90), turn(-20, 360)]) )),
       true(Ws-C == [ev3dev(astray([outC, outB]))]-(stop-stop)) ]) :-
    gyro(Gyro),
    with_robot(Tree, Gyro, ( set_robot(5.6, 10.6, outC, outB),
                             warnings(Goal, Ws),
                             wheels(command, C) )).
test(a_time_limit_stops_both_wheels,
     [forall(tree(Tree)), true(E-Left == time_limit_exceeded-at_rest)]) :-
    gyro(Gyro),
    with_robot(Tree, Gyro, ( catch(call_with_time_limit(0.1, turn(5, 30000)), E, true),
                             wheels_left(Left) )).
test(unplugging_the_gyro_stops_both_wheels,
     [forall(tree(Tree)), true(F-C == existence_error(sensor, in4)-(stop-stop))]) :-
    gyro(Gyro),
    with_robot(Tree, Gyro, ( later(0.1, unplug(in4)),
                       catch(turn(20, 900), error(F, _), true),
                       wheels(command, C) )).
test(unplugging_a_wheel_stops_the_other_one,
     [forall(tree(Tree)), true(F-C == existence_error(motor, outB)-stop)]) :-
    gyro(Gyro),
    with_robot(Tree, Gyro, ( later(0.1, unplug(outB)),
                       catch(turn(20, 900), error(F, _), true),
                       get_attribute(outC, command, C) )).
test(an_impossible_turn_fails_and_writes_nothing,
     [ forall(( tree(Tree),
                member(Goal, [ turn(0, 90), turn(101, 90), turn(20, 1.0e300),
                               turn(20, 10**400) ]) )),
       true(W == []) ]) :-
    gyro(Gyro),
    with_robot(Tree, Gyro, ( \+ Goal,
                       written(W) )).
:- end_tests(turn_with_gyro).

% ---------------- ONE DRIVE

%   What a program prints that makes a move of each kind, once it has loaded a
%   library: where the robot is then, and when.
moved(Library, Output) :-
    format(string(Program),
           ":- use_module(library(~w)).
            :- use_module(library(ev3dev)).
:- use_module(library(ev3dev/odometry), [pose/3]).
            :- use_module(library(ev3dev/sim)).
            main :-
                sim_start([], [clock(virtual)]),
                set_robot(5.6, 10.6, outB, outC),
                forall(member(Goal, [ turn(30, 90), go_cm(30, 20), go(-20, 360),
                                      turn(-20, 45) ]),
                       ( Goal,
                         sim_pose(X, Y, Heading),
                         sim_time(Time),
                         print([X, Y, Heading, Time]), nl )).", [Library]),
    run_program(Program, [goal(main)], Status, Output),
    assertion(Status == exit(0)).

:- begin_tests(one_drive).
test(go_and_turn_do_the_same_whatever_else_is_loaded,
     [ forall(member(Library, ['ev3dev/drive', 'ev3dev/grid'])), true(A == B) ]) :-
    moved(ev3dev, A),
    moved(Library, B),
    once(sub_string(A, _, _, _, "[")).
test(what_was_driven_before_the_library_was_loaded_counts) :-
    run_program(":- use_module(library(ev3dev)).
:- use_module(library(ev3dev/odometry), [pose/3]).
                 :- use_module(library(ev3dev/sim)).
                 main :-
                     sim_start([], [clock(virtual)]),
                     set_robot(5.6, 10.6, outB, outC),
                     motor_run(outB, 20, 360, [wait(false)]),
                     motor_run(outC, 20, 360),
                     sim_wait(1),
                     use_module(library(ev3dev/drive)),
                     pose(_, Y, _),
                     Cm is round(Y),
                     print(Cm).", [goal(main)], Status, Output),
    Status-Output == exit(0)-"18".
:- end_tests(one_drive).

:- begin_tests(units).
test(a_speed_in_cm_per_second_is_that_of_the_robot) :-
    with_sim([], ( set_robot(5.6, 10.6, outB, outC),
                   go(cm_per_s(10)), wait(1),
                   sim_pose(_, Y0, _), wait(2), sim_pose(_, Y1, _), stop )),
    near(Y1 - Y0, 20, 0.3).
test(go_cm_and_turn_take_units, [ forall(member(Speed, [cm_per_s(10), rps(0.5), rpm(30)])) ]) :-
    with_sim([], ( set_robot(5.6, 10.6, outB, outC),
                   go_cm(Speed, 20), turn(Speed, 90),
                   sim_pose(X, Y, H) )),
    near(X, 0, 0.5), near(Y, 20, 0.5), near(H, 90, 2).
test(go_takes_rotations_of_the_wheels) :-
    with_sim([], ( set_robot(5.6, 10.6, outB, outC),
                   go(30, rotations(2)), sim_pose(_, Y, _) )),
    near(Y, 2 * pi * 5.6, 0.5).
test(too_fast_is_impossible,
     [ forall(member(Goal, [go(cm_per_s(60)), go_cm(cm_per_s(60), 10), turn(rps(3), 90)])), fail ]) :-
    with_sim([], ( set_robot(5.6, 10.6, outB, outC), Goal )).
test(what_is_no_number_throws,
     [ forall(member(Goal, [go(cm_per_s(a)), go_cm(cm_per_s(a), 10), turn(rps(a)), turn(rps(a), 9)])),
       error(type_error(evaluable, a/0), _) ]) :-
    with_sim([], ( set_robot(5.6, 10.6, outB, outC), Goal )).
:- end_tests(units).

:- begin_tests(gear).
% Its motors turn three times as fast as its wheels.
geared(Goal) :-
    D is 5.6 / 3,
    with_sim([], Goal,
             [ robot([ left_wheel(outB, D), right_wheel(outC, D), axle(10.6), hull(circle(8)),
                       mass(0.75), motor(outB, 'lego-ev3-l-motor'),
                       motor(outC, 'lego-ev3-l-motor') ]) ]).

built(Options) :-
    set_robot(5.6, 10.6, outB, outC, Options).

test(distances_angles_and_speeds_are_those_of_the_wheels) :-
    geared(( built([gear(36/12)]), go_cm(30, 20), turn(30, 90), go(rpm(40), rotations(1)),
             sim_pose(X, Y, H), near(X, pi * 5.6, 0.5), near(Y, 20, 0.5), near(H, 90, 2),
             go(cm_per_s(6)), wait(1), sim_pose(X1, _, _), wait(2), sim_pose(X2, _, _), stop,
             near(X2 - X1, 12, 0.3) )).
test(the_robot_knows_where_it_is) :-
    geared(( built([gear(3)]), go_cm(30, 20), pose(X, Y, H),
             sim_pose(X1, Y1, H1), near(X, X1, 0.3), near(Y, Y1, 0.3), near(H, H1, 1) )).
test(it_is_that_of_the_motors, true(B-C == 3.0-3.0)) :-
    geared(( built([gear(3)]), motor_gear(outB, B), motor_gear(outC, C) )).
test(without_the_option_the_motors_keep_theirs) :-
    geared(( motor_gear(outB, 3), motor_gear(outC, 3), built([]), go_cm(30, 20),
             sim_pose(_, Y, _), near(Y, 20, 0.5) )).
test(a_change_counts_from_now_on_and_moves_nothing) :-
    geared(( built([]), go_cm(30, 60), motor_gear(outB, 3), motor_gear(outC, 3),
             pose(_, Y0, _), near(Y0, 60, 0.5), go_cm(30, 20),
             pose(_, Y, _), near(Y, 80, 0.5),
             sim_pose(_, Y1, _), near(Y1, 40, 0.5) )).
test(a_wrong_one_throws_and_changes_nothing, true(E-G == caught-1.0)) :-
    geared(( catch(built([gear(0)]), error(domain_error(positive_number, 0), _), E = caught),
             motor_gear(outB, G) )).
test(a_robot_that_cannot_be_set_changes_nothing, true(G == 1.0)) :-
    geared(( \+ set_robot(5.6, 10.6, outB, outD, [gear(3)]), motor_gear(outB, G) )).
:- end_tests(gear).
