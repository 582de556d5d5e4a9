% The same tests over three trees: plain files, the simulator within the
% process on its virtual clock, and the simulator's files through FUSE.

:- use_module('../support/trees').

:- begin_tests(devices).
test(motors_in_the_order_of_ports,
     [forall(tree(Tree)), true(Ports == [outA, outB, outC])]) :-
    on(Tree, findall(Port, tacho_motor(Port), Ports)).
test(sensors_with_their_types,
     [ forall(tree(Tree)),
       true(Types == [ in1-'lego-ev3-us', in2-'lego-ev3-color',
                       in3-'lego-ev3-color', in4-'lego-ev3-gyro' ]) ]) :-
    on(Tree, findall(Port-Type, lego_sensor(Port, Type), Types)).
test(a_port_in_either_spelling,
     [forall(tree(Tree)), true(Max-Max == 1050-1050)]) :-
    on(Tree, ( max_speed(outB, Max), max_speed('ev3-ports:outB', Max) )).
test(what_is_absent_fails, [forall(tree(Tree))]) :-
    on(Tree, ( \+ tacho_motor(outD),
               \+ motor_run(outD, 50),
               \+ motor_run(outD, 50, 90),
               \+ touch(_, _),
               \+ position(outD, _) )).
test(kinds, [forall(tree(Tree)), true(Kinds == [outA]-[outB, outC]-[in1])]) :-
    on(Tree, ( findall(P, ev3_medium_motor(P), Medium),
               findall(P, ev3_large_motor(P), Large),
               findall(P, ultrasonic_sensor(P), Sonic),
               Kinds = Medium-Large-Sonic )).
test(a_pattern_below_sys_class,
     [forall(tree(Tree)), true(Types == ['lego-ev3-m-motor'])]) :-
    on(Tree, findall(Type,
                     subsystem_detect(outA, Type, _,
                                      '/sys/class/tacho-motor/motor*'),
                     Types)).
test(files_can_be_read_by_name, [forall(tree(Tree)), true(Max == 1560)]) :-
    on(Tree, ( max_speed_file(outA, File), file_read(File, Max) )).
test(a_table_of_all, [forall(tree(Tree))]) :-
    on(Tree, with_output_to(string(Table), ev3_devices)),
    forall(member(Port, ["in1", "in4", "outA", "outC"]),
           sub_string(Table, _, _, _, Port)).

test(a_tree_that_is_switched_is_seen, true(A-B == 1050-[])) :-
    on(simulator, ( max_speed(outB, A),
                    with_tree(plain, [], findall(P, tacho_motor(P), B)) )).
:- end_tests(devices).

:- begin_tests(attributes).
test(set_points_are_stored, [forall(tree(Tree)), true(S-P == -321-77)]) :-
    on(Tree, ( speed_sp(outB, -321), position_sp(outB, 77),
               speed_sp(outB, S), position_sp(outB, P) )).
test(any_attribute, [forall(tree(Tree)), true(Action == hold)]) :-
    on(Tree, ( motor_attribute(outA, stop_action, hold),
               motor_attribute(outA, stop_action, Action) )).
test(the_state_of_a_motor_at_rest, [forall(tree(Tree)), true(S-Fs == ''-[])]) :-
    on(Tree, ( state(outB, S), motor_states(outB, Fs) )).
test(an_attribute_that_is_not_there,
     [forall(tree(Tree)), error(existence_error(file, _), context(_, _))]) :-
    on(Tree, motor_attribute(outB, colour, _)).
test(too_fast_for_the_kernel,
     [forall(behaving(Tree)), error(domain_error(speed_sp, 5000), _)]) :-
    on(Tree, speed_sp(outB, 5000)).
test(no_such_command,
     [forall(behaving(Tree)), error(domain_error(command, jump), _)]) :-
    on(Tree, command(outB, jump)).
test(no_such_mode,
     [forall(behaving(Tree)), error(domain_error(mode, 'COL-TASTE'), _)]) :-
    on(Tree, mode(in2, 'COL-TASTE')).
test(what_can_only_be_read,
     [ forall(behaving(Tree)),
       error(permission_error(write, attribute, _), _) ]) :-
    on(Tree, motor_attribute(outB, max_speed, 2000)).
test(what_can_only_be_written,
     [ forall(behaving(Tree)),
       error(permission_error(read, attribute, _), _) ]) :-
    on(Tree, motor_attribute(outB, command, _)).
test(no_such_value,
     [ forall(behaving(Tree)),
       error(domain_error(sensor_value_index, 5), _) ]) :-
    on(Tree, value(in1, 5, _)).
:- end_tests(attributes).

:- begin_tests(sensors).
test(distances_have_decimals, [forall(tree(Tree))]) :-
    on(Tree, ( us_dist_cm(Port, Distance),
               Port == in1,
               float(Distance),
               Distance > 3, Distance =< 255 )).
test(modes_follow_what_is_asked,
     [forall(tree(Tree)), true(Mode == 'COL-AMBIENT')]) :-
    on(Tree, ( col_reflect(in2, _), col_ambient(in2, Light),
               between(0, 100, Light), mode(in2, Mode) )).
test(a_mode_that_another_program_changed_is_seen,
     [forall(tree(Tree)), true(Mode == 'COL-AMBIENT')]) :-
    on(Tree, ( col_ambient(in2, _),
               mode_file(in2, File),
               file_write(File, 'COL-COLOR'),
               col_ambient(in2, _),
               file_read(File, Mode) )).
test(any_value_of_any_mode, [forall(tree(Tree))]) :-
    on(Tree, ( sensor_value(in3, 'RGB-RAW', 0, Red), integer(Red),
               col_rgb_raw(in3, rgb(_, _, Blue)), integer(Blue) )).
test(raw_and_adjusted, [forall(tree(Tree))]) :-
    on(Tree, ( us_dist_cm(in1, _), value(in1, 0, Raw), integer(Raw),
               decimals(in1, 1), adjust_val(in1, Raw, Adjusted),
               Adjusted =:= Raw / 10.0 )).
test(the_gyro_starts_from_0, [forall(tree(Tree)), true(Angle == 0)]) :-
    on(Tree, ( gyro_reset(in4), gyro_ang(in4, Angle) )).
test(the_wrong_sensor_fails, [forall(tree(Tree)), fail]) :-
    on(Tree, col_ambient(in1, _)).
:- end_tests(sensors).

:- begin_tests(motors).
test(runs_until_it_is_stopped, [forall(behaving(Tree)), true(R == stopped)]) :-
    on(Tree, ( motor_run(outA, 50),
               motor_wait(outA, [timeout(0.3)], timeout),
               position(outA, There), There > 50,
               motor_stop(outA),
               motor_states(outA, []),
               motor_run(outA, -20),
               meanwhile(( sleep(0.1), motor_stop(outA) ),
                         motor_wait(outA, [], R)) )).
test(turns_by_an_angle, [forall(tree(Tree))]) :-
    on(Tree, ( obeying([outA], motor_run(outA, 50, 180)),
               settle(Tree), position(outA, There),
               near(There, 180, 5) )).
test(turns_back_at_a_negative_speed, [forall(behaving(Tree))]) :-
    on(Tree, ( motor_run(outA, -50, 90), settle(Tree),
               position(outA, There), near(There, -90, 2) )).
% Each counts from where the motor is when it begins, wherever that is in its swing.
test(moves_in_a_row_add_up) :-
    on(simulator, ( forall(between(1, 4, _), motor_run(outA, 60, 45)),
                    settle(simulator), position(outA, There), near(There, 180, 2) )).
test(moves_from_rest_add_up, [forall(behaving(Tree))]) :-
    on(Tree, ( forall(between(1, 4, _), ( motor_run(outA, 60, 45), settle(Tree) )),
               position(outA, There), near(There, 180, 2) )).
test(a_new_zero_is_where_the_next_move_counts_from,
     [forall(behaving(Tree))]) :-
    on(Tree, ( motor_run(outA, 60, 90),
               motor_stop(outA, coast), settle(Tree), position(outA, 0),
               motor_run(outA, 60, 90), settle(Tree),
               position(outA, There), near(There, 90, 2) )).
test(too_fast_fails_and_moves_nothing,
     [forall(tree(Tree)), true(P == 0)]) :-
    on(Tree, ( \+ motor_run(outA, 101), \+ motor_run(outA, 0, 90),
               position(outA, P) )).
test(a_time_limit_stops_it, [forall(behaving(Tree)), true(Fs == [])]) :-
    on(Tree, ( catch(call_with_time_limit(0.1, ( motor_run(outA, 1, 36000),
                                                 fail )),
                     time_limit_exceeded, true)
             ; true )),
    on(Tree, motor_states(outA, Fs)).
test(a_timeout_stops_it, [forall(behaving(Tree)), true(Fs == [])]) :-
    on(Tree, ( \+ motor_run(outA, 5, 3600, [timeout(0.2)]),
               motor_states(outA, Fs) )).
:- end_tests(motors).

:- begin_tests(robot).
test(goes_a_distance, [forall(behaving(Tree))]) :-
    on(Tree, ( set_robot(5.6, 10.6, outB, outC),
               go_cm(40, 10),
               position(outB, Left), position(outC, Right),
               near(Left, 205, 6), near(Right, 205, 6) )).
test(turns_by_the_gyro, [forall(behaving(Tree))]) :-
    on(Tree, ( set_robot(5.6, 10.6, outB, outC),
               gyro_ang(_, Before),
               sim_pose(_, _, Heading0),
               turn(30, 45),
               gyro_ang(_, After),
               Turned is After - Before,
               near(Turned, 45, 1),
               sim_pose(_, _, Heading),
               Really is Heading - Heading0,
               near(Really, 45, 2.5) )).
test(stops, [forall(tree(Tree))]) :-
    on(Tree, ( set_robot(5.6, 10.6, outB, outC), go(20), stop,
               motor_states(outB, []), motor_states(outC, []) )).
test(needs_two_motors_of_one_type, [forall(tree(Tree)), fail]) :-
    on(Tree, set_robot(5.6, 10.6, outA, outB)).
:- end_tests(robot).
