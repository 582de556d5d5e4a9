% Where the robot is by its wheels and its gyro.

:- use_module('../support/trees').
:- use_module('../support/robots').
:- use_module(library(ev3dev/drive)).

:- begin_tests(odometry).
test(counts_from_where_the_robot_was_set,
     [forall(tree(Tree)), true(P == [0.0, 0.0, 0.0])]) :-
    on(Tree, ( set_robot(5.6, 10.6, outB, outC),
               pose(X, Y, H),
               P = [X, Y, H] )).
test(is_where_it_was_said_to_be,
     [forall(tree(Tree)), true(P-U == [10.0, -20.5, 400.0]-0.0)]) :-
    on(Tree, ( set_robot(5.6, 10.6, outB, outC),
               set_pose(10, -41/2, 400),
               pose(X, Y, H),
               pose_uncertainty([[U|_]|_]),
               P = [X, Y, H] )).
% One wheel after the other: whenever else these files are read, it is along
% the same two arcs.
test(plain_files_that_another_program_moves, [true]) :-
    with_tree(plain, [outB-'lego-ev3-l-motor', outC-'lego-ev3-l-motor'],
              ( set_robot(5.6, 10.6, outB, outC),
                forall(( member(Port, [outB, outC]), between(1, 20, I) ),
                       ( Count is I * 10,
                         put_attribute(Port, position, Count),
                         pose(_, _, _) )),
                pose(X, Y, H) )),
    Turned is 200 * 5.6 * pi / 360 / 10.6,
    near(X, 10.6 * (1 - cos(Turned)), 0.01),
    near(Y, 10.6 * sin(Turned), 0.01),
    near(H, 0, 0.01).
test(right_however_the_motors_are_run,
     [forall(member(Goal,
                    [ ( motors_run([run(outB, 40), run(outC, 20)]),
                        sim_step(3), stop, sim_step(1) ),
                      ( motors_run([run(outB, -40), run(outC, 20)]),
                        sim_step(3), stop, sim_step(1) ),
                      ( motors_run([run(outB, -40), run(outC, -45)]),
                        sim_step(3), stop, sim_step(1) ),
                      ( motor_run(outB, 30, 500), motor_run(outC, 50, -500) ),
                      ( go(30), sim_step(1), turn(30), sim_step(1), go(-30),
                        sim_step(2), stop, sim_step(1) ),
                      ( motor_attribute(outB, duty_cycle_sp, 40),
                        motor_attribute(outC, duty_cycle_sp, -30),
                        command(outB, 'run-direct'),
                        command(outC, 'run-direct'),
                        sim_step(2), stop_all_motors, sim_step(1) )
                    ]))]) :-
    quiet(false, ( Goal, pose_is_right )).
test(right_while_the_robot_moves) :-
    quiet(false, ( motors_run([run(outB, 60), run(outC, 40)]),
                   forall(between(1, 50, _),
                          ( sim_step(0.037), pose_is_right(0.3, 1) )) )).
test(right_when_other_threads_drive) :-
    quiet(false, ( thread_create(motor_run(outB, 40, 720), A, []),
                   thread_create(motor_run(outC, 30, 300), B, []),
                   thread_join(A, true),
                   thread_join(B, true),
                   pose_is_right )).
test(nothing_looks_meanwhile_and_it_is_right_all_the_same) :-
    quiet(false, ( motors_run([run(outB, 40), run(outC, -20)]),
                   sim_step(4), stop, sim_step(100), pose_is_right )).
test(a_motor_that_is_reset_has_not_turned,
     [forall(member(Goal, [ motor_reset(outB), position(outB, 5000),
                            position(outB, -3), command(outC, reset),
                            ( position(outB, P), motor_position(outB, P + 30) ) ]))]) :-
    quiet(false, ( go_cm(30, 50), Goal, sim_step(0.5), pose_is_right(0.3, 1),
                   go_cm(30, 20), turn(30, 30), Goal, go_cm(30, 20),
                   pose_is_right(0.3, 1) )).
test(a_motor_that_is_reset_while_it_turns) :-
    quiet(false, ( steer(40, 30), sim_step(1), motor_reset(outB), sim_step(1),
                   pose_is_right )).
test(a_motor_that_is_plugged_in_again_has_not_turned) :-
    quiet(false, ( go_cm(30, 50), sim_unplug(outB), sim_step(1),
                   sim_plug(outB, 'lego-ev3-l-motor'), sim_step(1),
                   pose_is_right,
                   go_cm(30, 20), turn(30, 30),
                   pose_is_right )).
test(the_wheels_do_when_the_gyro_is_unplugged) :-
    quiet(true, ( turn(30, 90, []), sim_unplug(in4), sim_step(1),
                  go_cm(30, 20, []), turn(30, -45, []), pose_is_right,
                  sim_plug(in4, 'lego-ev3-gyro'), sim_step(2),
                  turn(30, 60, []), go_cm(30, 20, []),
                  pose_is_right(0.5, 1) )).
test(the_gyro_may_be_reset_or_read_otherwise) :-
    quiet(true, ( turn(30, 90, []), gyro_reset(in4), turn(30, 30, []),
                  gyro_rate(in4, _), turn(30, 60, [use_gyro(true)]),
                  motors_run([run(outB, 20), run(outC, -20)]),
                  gyro_rate(in4, _), sim_step(1), gyro_ang(in4, _),
                  sim_step(1), stop, sim_step(1),
                  pose_is_right(0.5, 1) )).
test(a_robot_that_is_described_anew_is_where_it_was, true(P0 == P1)) :-
    quiet(false, ( go_to(10, 20), pose(X0, Y0, H0), P0 = [X0, Y0, H0],
                   set_robot(5.5, 10.5, outB, outC),
                   pose(X1, Y1, H1), P1 = [X1, Y1, H1] )).
test(uncertainty_grows_with_the_way, true(B > A)) :-
    quiet(false, ( go_cm(30, 50), pose_uncertainty([[A|_]|_]),
                   turn(30, 90), go_cm(30, 50),
                   pose_uncertainty([[B, XY, XH], [XY1, _, YH],
                                     [XH1, YH1, _]]) )),
    near(XY, XY1, 1.0e-9),
    near(XH, XH1, 1.0e-9),
    near(YH, YH1, 1.0e-9).
test(the_gyro_makes_the_heading_certain, true(Sd < 2)) :-
    noisy(1, true, ( forall(between(1, 5, _),
                            ( go_cm(30, 100, []), turn(30, 180, []) )),
                     pose_uncertainty([_, _, [_, _, HH]]),
                     Sd is sqrt(HH) )).
test(without_a_gyro_a_turn_is_as_uncertain_as_the_axle) :-
    slipping(1, slip(0.03, 0.03), false,
             ( turn(30, 3600, []),
               pose(_, _, H), sim_pose(_, _, H0),
               pose_uncertainty([_, _, [_, _, HH]]) )),
    Off is abs(H - H0),
    Off > 60,
    Off < 3 * sqrt(HH).
test(the_gyro_teaches_how_the_robot_turns) :-
    slipping(1, slip(0.05, 0.05), true,
             ( sim_step(10), turn(30, 720, []), turn(30, -360, []),
               sim_unplug(in4), sim_step(1),
               turn(30, 1080, []), pose_is_right(1, 5) )).
test(a_robot_that_is_described_anew_is_believed) :-
    robot_of(5.6, 5.6, 10.07, true, bias(0, 0), Robot),
    drives(1, Robot, ( sim_step(10), turn(30, 720, []),
                       sim_unplug(in4), sim_step(1),
                       set_robot(5.6, 10.07, outB, outC),
                       turn(30, 1080, []), pose_is_right(1, 3) )).
test(drift_shows_while_the_robot_rests,
     [forall(member(Drift, [0.5, -1, 2]))]) :-
    robot_of(5.6, 5.6, 10.6, true, none, Robot0),
    append(Robot0, [noise(in4, 0.3, Drift)], Robot),
    drives(1, Robot, ( forall(between(1, 80, _),
                              ( sim_step(0.1), pose(_, _, _) )),
                       go_cm(30, 100, []), turn(30, 90, []),
                       go_cm(30, 100, []),
                       pose_is_right(4, 3) )).
test(wraps_headings,
     [forall(member(H-W, [ 0-0.0, 180-180.0, -180-180.0, 190-(-170.0),
                           -190-170.0, 720+1-1.0, 540-180.0 ])),
      true(W1 =:= W)]) :-
    heading_wrapped(H, W1).
test(options_are_remembered, true(S-G == 55-false)) :-
    setup_call_cleanup(
        ( drive_option(speed, 50+5), drive_option(use_gyro, false) ),
        ( drive_option(speed, S), drive_option(use_gyro, G) ),
        ( drive_option(speed, 40), drive_option(use_gyro, true) )).
test(the_speed_may_have_a_unit,
     [forall(member(Speed-Valid, [cm_per_s(4*5)-cm_per_s(20), dps(-100)-dps(-100), rpm(60)-rpm(60)])),
      true(S == Valid)]) :-
    setup_call_cleanup(
        drive_option(speed, Speed),
        drive_option(speed, S),
        drive_option(speed, 40)).
test(moves_take_the_speed_with_its_unit, true(Far == [])) :-
    with_sim([], ( set_robot(5.6, 10.6, outB, outC),
                   set_pose(0, 0, 0),
                   setup_call_cleanup(
                       drive_option(speed, dps(180)),
                       go_to(0, 10),
                       drive_option(speed, 40)),
                   sim_trace(Trace),
                   findall(Max,
                           ( member(Port, [motor1, motor2]),
                             findall(V, ( member(_-written(File, V0), Trace),
                                          sub_atom(File, _, _, _, Port),
                                          sub_atom(File, _, _, 0, speed_sp),
                                          atom_number(V0, V) ), Vs),
                             max_list(Vs, Max),
                             \+ near(Max, 180, 9) ),
                           Far) )).
test(a_speed_of_0_is_none, [forall(member(S, [cm_per_s(0), rpm(0), 0])), error(domain_error(speed, S), _)]) :-
    drive_option(speed, S).
:- end_tests(odometry).
