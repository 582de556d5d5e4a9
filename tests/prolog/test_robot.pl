:- use_module('../support/trees').
:- use_module('../support/simulation', [near/3]).
:- use_module('../support/old_prolog').
:- use_module(library(ev3dev)).
:- use_module(library(lists)).
:- use_module(library(time)).

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

                /*******************************
                *          DESCRIPTION         *
                *******************************/

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

:- begin_tests(no_robot, [ setup(retractall(ev3dev_robot_state:robot(_, _, _, _))) ]).

test(nothing_can_be_done_without_a_robot,
     [ forall(( tree(Tree),
                member(Goal, [ robot(_, _, _, _), stop, go(50), go(50, 90),
                               go_cm(50, 10), turn(50), turn(50, 90) ]) )),
       true(W == []) ]) :-
    with_tree(Tree, ( \+ Goal,
                      written(W) )).

:- end_tests(no_robot).

                /*******************************
                *            GOING             *
                *******************************/

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
     [forall(tree(Tree)), true(S-A == ('525'-'525')-(hold-hold))]) :-
    with_robot(Tree, obeying([outB, outC],
                             ( go(50, 180),
                               wheels_near(180, 180, 10),
                               wheels(speed_sp, S),
                               wheels(stop_action, A) ))).
test(go_2_has_the_sign_of_both,
     [ forall(( tree(Tree),
                member(Speed-Angle-D, [ -50-180-'-180', 50-(-180)-'-180',
                                        -50-(-180)-'180' ]) )),
       true(P == D-D) ]) :-
    with_robot(Tree, obeying([outB, outC],
                             ( go(Speed, Angle),
                               wheels(position_sp, P) ))).
test(go_cm_is_the_papers_formula,
     [ forall(( tree(Tree),
                member(Distance, [10, -3, 20.5]) )), true(P == Angle-Angle) ]) :-
    Expected is round((Distance * 360) / (pi * 5.6)),
    atom_number(Angle, Expected),
    with_robot(Tree, obeying([outB, outC],
                             ( go_cm(20, Distance),
                               wheels(position_sp, P) ))).
test(an_impossible_move_fails_and_writes_nothing,
     [ forall(( tree(Tree),
                member(Goal, [ go(0), go(0.0), go(101), go(10**400),
                               go(0, 90), go(50, 0), go(101, 90), go(50, 10**400),
                               go_cm(50, 0), go_cm(0, 10), go_cm(101, 10) ]) )),
       true(W == []) ]) :-
    with_robot(Tree, ( \+ Goal,
                       written(W) )).
test(an_infinite_speed_fails_and_writes_nothing,
     [forall(( tree(Tree), evaluated(inf, Speed) )), true(W == [])]) :-
    with_robot(Tree, ( \+ go(Speed),
                       written(W) )).
test(a_motor_that_is_missing_fails_and_starts_none,
     [ forall(( tree(Tree),
                member(Goal, [go(50), go(50, 90), go_cm(50, 10), turn(50), turn(50, 90)]) )),
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
                       meanwhile(( eventually(wheels(command, 'run-to-rel-pos'-'run-to-rel-pos')),
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

                /*******************************
                *           TURNING            *
                *******************************/

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
     [ forall(( tree(Tree),
                member(Speed-Degrees-Sign, [20-90-1, 20-(-90)-1, -20-90-(-1), 20-45.5-1]) )),
       true(P == L-R) ]) :-
    Left is Sign * round(10.6 / 5.6 * Degrees),
    Right is -Left,
    atom_number(L, Left),
    atom_number(R, Right),
    with_robot(Tree, obeying([outB, outC],
                             ( turn(Speed, Degrees),
                               wheels(position_sp, P),
                               wheels_near(Left, Right, 10) ))).
test(turn_2_by_nothing_succeeds, [forall(( tree(Tree),
                                           member(Speed, [20, -20]) ))]) :-
    with_robot(Tree, ( turn(Speed, 0),
                       wheels_near(0, 0, 1) )).
test(an_impossible_turn_fails_and_writes_nothing,
     [ forall(( tree(Tree),
                member(Goal, [ turn(0, 90), turn(101, 90), turn(20, 1.0e300) ]) )),
       true(W == []) ]) :-
    with_robot(Tree, ( \+ Goal,
                       written(W) )).

:- end_tests(turn_without_gyro).

% Where it does not turn by itself, a thread plays the robot on the spot: its
% wheels turn as they are told by speed_sp and command, and the gyro counts the
% robot's angle.
play_gyro(_) :-
    \+ current_tree(plain),
    !.
play_gyro(Angle0) :-
    wheel_speed(outB, Left),
    wheel_speed(outC, Right),
    Angle is Angle0 + 0.01 * (Left - Right) / 2 * 5.6 / 10.6,
    Shown is round(Angle),
    put_attribute(in4, value0, Shown),
    sleep(0.01),
    play_gyro(Angle).

gyro_angle(Angle) :-
    get_attribute(in4, value0, Text),
    atom_number(Text, Angle).

% The robot has been turned before.
turned_already(Angle) :-
    (   current_tree(plain)
    ->  eventually(( gyro_angle(Angle), Angle =\= 0 ))
    ;   turn(50, 100),
        gyro_angle(Angle)
    ).

wheel_speed(Port, Speed) :-
    get_attribute(Port, command, Command),
    (   Command == 'run-forever'
    ->  get_attribute(Port, speed_sp, Text),
        atom_number(Text, Speed)
    ;   Speed = 0
    ).

gyro([in4-'lego-ev3-gyro']).

:- begin_tests(turn_with_gyro).

test(ends_within_a_degree_and_brakes_both,
     [ forall(( tree(Tree),
                member(Speed-Degrees-Target, [ 40-90-90, 40-(-60)-(-60), -40-60-(-60) ]) )),
       true(Ended-C-A == within-(stop-stop)-(brake-brake)) ]) :-
    gyro(Gyro),
    with_robot(Tree, Gyro,
               meanwhile(play_gyro(0),
                         ( turn(Speed, Degrees),
                           gyro_angle(Angle),
                           ( abs(Angle - Target) =< 1 -> Ended = within ; Ended = Angle ),
                           wheels(command, C),
                           wheels(stop_action, A) ))).
test(by_nothing_it_succeeds, [forall(tree(Tree))]) :-
    gyro(Gyro),
    with_robot(Tree, Gyro, ( turn(20, 0), wheels_near(0, 0, 1) )).
test(starts_from_whatever_the_gyro_shows,
     [forall(tree(Tree)), true(Ended == within)]) :-
    gyro(Gyro),
    with_robot(Tree, Gyro,
               meanwhile(play_gyro(1000),
                         ( turned_already(Before),
                           turn(40, 45),
                           gyro_angle(After),
                           Turned is After - Before,
                           ( abs(Turned - 45) =< 1 -> Ended = within ; Ended = Turned ) ))).
test(nothing_moves_then_it_fails_with_a_warning_and_stops,
     [forall(tree(Tree)), true(Ws-C == [ev3dev(turn(stalled, 90))]-(stop-stop))]) :-
    gyro(Gyro),
    with_robot(Tree, Gyro, ( block(outB),
                       block(outC),
                       warnings(turn(20, 90), Ws),
                       wheels(command, C) )).
test(the_gyro_counts_the_other_way_then_it_fails_with_a_warning_and_stops,
     [forall(tree(Tree)), true(Ws-C == [ev3dev(turn(astray, 90))]-(stop-stop))]) :-
    gyro(Gyro),
    with_robot(Tree, Gyro,
               meanwhile(play_gyro(0),
                         ( set_robot(5.6, 10.6, outC, outB),
                           warnings(turn(40, 90), Ws),
                           wheels(command, C) ))).
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
                               turn(20, 10**400), turn(20, 40000) ]) )),
       true(W == []) ]) :-
    gyro(Gyro),
    with_robot(Tree, Gyro, ( \+ Goal,
                       written(W) )).

:- end_tests(turn_with_gyro).
