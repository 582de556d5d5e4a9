:- use_module('../support/trees').

% ---------------- DEVICES

:- begin_tests(devices).
test(motors_are_listed_in_port_order,
     [forall(tree(Tree)), all(P == [outA, outB, outC, outD])]) :-
    with_tree(Tree, [],
              ( plug(outD, 'lego-nxt-motor'),
                plug(outB, 'lego-ev3-l-motor'),
                plug(outC, 'lego-ev3-l-motor'),
                plug(outA, 'lego-ev3-m-motor'),
                tacho_motor(P) )).
test(sensors_are_listed_in_port_order,
     [ forall(tree(Tree)),
       all(P-T == [in1-'lego-ev3-gyro', in2-'lego-ev3-touch',
                   in4-'lego-ev3-us']) ]) :-
    with_tree(Tree, [],
              ( plug(in4, 'lego-ev3-us'),
                plug(in2, 'lego-ev3-touch'),
                plug(in1, 'lego-ev3-gyro'),
                lego_sensor(P, T) )).
test(a_type_selects_ports,
     [forall(tree(Tree)), all(P == [outB, outC, outD])]) :-
    with_tree(Tree, tacho_motor(P, 'lego-ev3-l-motor')).
test(a_port_gives_type_and_path,
     [forall(tree(Tree)), true(T-Is == 'lego-ev3-us'-Path)]) :-
    with_tree(Tree, ( lego_sensor(in1, T, Is),
                      attribute_directory(in1, Path) )).
test(a_path_gives_the_port, [forall(tree(Tree)), true(P == outC)]) :-
    with_tree(Tree, ( attribute_directory(outC, Path),
                      tacho_motor(P, _, Path) )).
test(the_long_spelling_of_a_port_is_left_as_it_is,
     [forall(tree(Tree)), true(P-T == 'ev3-ports:outA'-'lego-ev3-m-motor')]) :-
    P = 'ev3-ports:outA',
    with_tree(Tree, tacho_motor(P, T)).
test(each_kind_of_motor_has_its_enumerator,
     [forall(tree(Tree)), true([L, M, N] == [[outB], [outA], [outC]])]) :-
    with_tree(Tree, [ outA-'lego-ev3-m-motor', outB-'lego-ev3-l-motor',
                      outC-'lego-nxt-motor' ],
              ( findall(P, ev3_large_motor(P), L),
                findall(P, ev3_medium_motor(P), M),
                findall(P, nxt_motor(P), N) )).
% A controller has eight servos.
test(a_servo_is_found,
     [ all(P == ['in1:i2c88:sv2', 'in1:i2c88:sv10']) ]) :-
    with_tree(plain, [],
              ( add_device('servo-motor/motor0', 'in1:i2c88:sv10', 'ms-8ch-servo'),
                add_device('servo-motor/motor1', 'in1:i2c88:sv2', 'ms-8ch-servo'),
                servo_motor(P) )).
test(a_port_with_no_device_fails, [forall(tree(Tree)), fail]) :-
    with_tree(Tree, tacho_motor(outE)).
test(a_sensor_is_no_motor, [forall(tree(Tree)), fail]) :-
    with_tree(Tree, tacho_motor(in1)).
test(an_empty_tree_has_no_devices, [forall(tree(Tree)), true(Ps == [])]) :-
    with_tree(Tree, [], findall(P, (tacho_motor(P) ; lego_sensor(P) ; servo_motor(P)), Ps)).
test(other_boards_addresses_are_used_as_they_are,
     [forall(tree(Tree)), all(P == ['spi0.1:MA', 'spi0.1:MB'])]) :-
    with_tree(Tree, [outA-'lego-nxt-motor', outB-'lego-nxt-motor'],
              ( show_attribute(outA, address, 'spi0.1:MB'),
                show_attribute(outB, address, 'spi0.1:MA'),
                nxt_motor(P) )).
test(a_port_is_no_number,
     [forall(tree(Tree)), error(type_error(atom, 1), _)]) :-
    with_tree(Tree, tacho_motor(1)).
test(asking_for_devices_writes_nothing,
     [forall(tree(Tree)), true(W == [])]) :-
    with_tree(Tree, ( forall(tacho_motor(_, _, _), true),
                      forall(lego_sensor(_, _, _), true),
                      written(W) )).
:- end_tests(devices).

attribute_directory(Port, Directory) :-
    attribute_path(Port, address, File),
    file_directory_name(File, Directory).

add_device(Name, Address, Type) :-
    tree_root(Root),
    atomic_list_concat([Root, Name], /, Directory),
    make_directory_path(Directory),
    add_file(Directory, driver_name, Type),
    add_file(Directory, address, Address).

add_file(Directory, Name, Text) :-
    atomic_list_concat([Directory, Name], /, File),
    setup_call_cleanup(open(File, write, Out),
                       format(Out, "~w~n", [Text]),
                       close(Out)).

% ---------------- ATTRIBUTES

:- begin_tests(attributes).
test(motor_attributes_are_read,
     [ forall(( tree(Tree),
                member(Goal-Value,
                       [ speed(outB, V)-0,
                         speed_sp(outB, V)-0,
                         max_speed(outB, V)-1050,
                         position(outB, V)-0,
                         position_sp(outB, V)-0,
                         state(outB, V)-'',
                         motor_states(outB, V)-[],
                         motor_attribute(outB, stop_action, V)-coast,
                         motor_attribute(outB, count_per_rot, V)-360,
                         motor_attribute(outB, polarity, V)-normal ]) )),
       true(V == Value) ]) :-
    with_tree(Tree, Goal).
test(sensor_attributes_are_read,
     [ forall(( tree(Tree),
                member(Goal-Value,
                       [ mode(in1, V)-'US-DIST-CM',
                         value(in1, 0, V)-843,
                         value(in1, 2, V)-7,
                         decimals(in1, V)-1,
                         sensor_attribute(in1, num_values, V)-1 ]) )),
       true(V == Value) ]) :-
    with_tree(Tree, ( put_attribute(in1, value0, 843),
                      put_attribute(in1, value2, 7),
                      Goal )).
test(the_long_spelling_of_a_port_is_taken,
     [ forall(( tree(Tree),
                member(Goal, [ max_speed('ev3-ports:outB', 1050),
                               position('ev3-ports:outB', 5),
                               mode('ev3-ports:in1', 'US-DIST-CM'),
                               value('ev3-ports:in1', 0, 843),
                               command('ev3-ports:outB', stop),
                               speed_sp_file('ev3-ports:outB', _) ]) )) ]) :-
    with_tree(Tree, ( put_attribute(in1, value0, 843),
                      Goal )).
test(an_unbound_port_enumerates,
     [forall(tree(Tree)), all(P-S == [outA-1560, outB-1050, outC-1050, outD-1050])]) :-
    with_tree(Tree, max_speed(P, S)).
test(a_bound_value_selects_ports,
     [forall(tree(Tree)), all(P == [outB, outC, outD])]) :-
    with_tree(Tree, max_speed(P, 1050)).
test(states_are_a_list_in_the_kernels_order,
     [forall(tree(Tree)), true(S-T == 'running stalled'-[running, stalled])]) :-
    with_tree(Tree, ( put_attribute(outB, state, 'running stalled'),
                      state(outB, S),
                      motor_states(outB, T) )).
test(a_bound_value_is_written,
     [ forall(( tree(Tree),
                member(Goal-(Port-Attribute=Text),
                       [ speed_sp(outB, -300)-(outB-speed_sp='-300'),
                         position(outB, 90)-(outB-position='90'),
                         position_sp(outB, 90)-(outB-position_sp='90'),
                         command(outB, 'run-direct')-(outB-command='run-direct'),
                         mode(in2, 'COL-COLOR')-(in2-mode='COL-COLOR'),
                         motor_attribute(outB, polarity, inversed)-
                             (outB-polarity=inversed),
                         sensor_attribute(in2, mode, "RGB-RAW")-
                             (in2-mode='RGB-RAW') ]) )),
       true(Written == [Port-(Attribute=Text)]) ]) :-
    with_tree(Tree, ( Goal,
                      written(Written) )).
test(what_can_only_be_read_is_compared,
     [ forall(( tree(Tree),
                member(Goal, [ speed(outB, 10), max_speed(outB, 10),
                               state(outB, running), motor_states(outB, [running]),
                               value(in1, 0, 10), decimals(in1, 3) ]) )),
       true(Written == []) ]) :-
    with_tree(Tree, ( \+ Goal,
                      written(Written) )).
test(an_absent_device_fails,
     [ forall(( tree(Tree),
                member(Goal, [ speed(outE, _), speed_sp(outE, _),
                               speed_sp(outE, 1), max_speed(outE, _),
                               position(outE, _), position(outE, 1),
                               position_sp(outE, _), state(outE, _),
                               motor_states(outE, _), command(outE, stop),
                               motor_attribute(outE, nothing, _),
                               mode(outB, _), mode(in5, 'COL-COLOR'),
                               value(in5, 0, _), decimals(in5, _),
                               sensor_attribute(in5, nothing, _) ]) )),
       fail ]) :-
    with_tree(Tree, Goal).
test(writing_needs_a_port,
     [ forall(( tree(Tree),
                member(Goal, [ position(_, 0), speed_sp(_, 0), command(_, stop),
                               position_sp(_, 0), mode(_, 'COL-COLOR'),
                               motor_attribute(_, stop_action, hold) ]) )),
       error(instantiation_error, _) ]) :-
    with_tree(Tree, Goal).
test(a_refused_write_writes_nothing,
     [forall(tree(Tree)), true(Written == [])]) :-
    with_tree(Tree, ( catch(position(_, 7), error(instantiation_error, _), true),
                      catch(speed_sp(outB, f(x)), error(type_error(_, _), _), true),
                      written(Written) )).
test(an_attribute_must_be_named,
     [forall(tree(Tree)), error(instantiation_error, _)]) :-
    with_tree(Tree, motor_attribute(outB, _, _)).
test(an_attribute_that_is_not_there_throws,
     [forall(tree(Tree)), error(existence_error(file, File), _)]) :-
    with_tree(Tree, ( attribute_path(outB, nothing, File),
                      motor_attribute(outB, nothing, _) )).
test(a_command_must_be_given,
     [forall(tree(Tree)), error(instantiation_error, _)]) :-
    with_tree(Tree, command(outB, _)).
test(a_value_has_a_number,
     [ forall(( tree(Tree),
                member(Index-Error,
                       [ _-instantiation_error,
                         a-type_error(_, a),
                         1.0-type_error(_, 1.0),
                         -1-type_error(nonneg, -1),
                         8-domain_error(sensor_value_index, 8) ]) )),
       error(Error, _) ]) :-
    with_tree(Tree, value(in1, Index, _)).
:- end_tests(attributes).

:- begin_tests(attribute_files).
test(each_attribute_has_its_file,
     [ forall(( tree(Tree),
                member(Goal-(Port/Attribute),
                       [ command_file(outB, F)-outB/command,
                         speed_file(outB, F)-outB/speed,
                         speed_sp_file(outB, F)-outB/speed_sp,
                         max_speed_file(outB, F)-outB/max_speed,
                         position_file(outB, F)-outB/position,
                         position_sp_file(outB, F)-outB/position_sp,
                         state_file(outB, F)-outB/state,
                         mode_file(in1, F)-in1/mode,
                         value_file(in1, 0, F)-in1/value0,
                         decimals_file(in1, F)-in1/decimals ]) )),
       true(F == File) ]) :-
    with_tree(Tree, ( Goal,
                      attribute_path(Port, Attribute, File) )).
test(an_unbound_port_enumerates,
     [forall(tree(Tree)), all(P == [outA, outB, outC, outD])]) :-
    with_tree(Tree, command_file(P, _)).
test(an_absent_device_has_no_file, [forall(tree(Tree)), fail]) :-
    with_tree(Tree, command_file(outE, _)).
test(a_value_file_needs_a_number,
     [forall(tree(Tree)), error(instantiation_error, _)]) :-
    with_tree(Tree, value_file(in1, _, _)).
:- end_tests(attribute_files).

% ---------------- REFUSED BY KERNEL

% In a plain tree a file of the kernel's own stands in for an attribute: it
% takes integers from -1000 to 1000, and refuses others as a motor does.
kernel_file('/proc/self/oom_score_adj').

in_place_of(_, _, _) :-
    \+ current_tree(plain),
    !.
in_place_of(Port, Attribute, Target) :-
    attribute_path(Port, Attribute, Path),
    delete_file(Path),
    link_file(Target, Path, symbolic).

:- begin_tests(refused_by_the_kernel,
               [ condition(( kernel_file(File), exists_file(File) )) ]).
test(a_value_that_is_not_accepted_is_a_domain_error,
     [ forall(( tree(Tree),
                member(Goal-(Attribute-Value),
                       [ speed_sp(outB, 99999)-(speed_sp-99999),
                         speed_sp(outB, 99999999999)-(speed_sp-99999999999),
                         speed_sp(outB, fast)-(speed_sp-fast),
                         command(outB, jump)-(command-jump),
                         mode(in1, 'NO-MODE')-(mode-'NO-MODE'),
                         sensor_value(in1, 'NO-MODE', 0, _)-(mode-'NO-MODE') ]) )),
       error(domain_error(Attribute, Value), context(_/_, _)) ]) :-
    kernel_file(File),
    with_tree(Tree, ( in_place_of(outB, speed_sp, File),
                      in_place_of(outB, command, File),
                      in_place_of(in1, mode, File),
                      Goal )).
test(the_message_names_the_file_and_gives_the_kernels_words,
     true(sub_atom(Message, _, _, _, 'Invalid argument'))) :-
    kernel_file(File),
    catch(file_write(File, foo), error(_, context(file_write/2, Message)), true),
    sub_atom(Message, _, _, _, File),
    !.
:- end_tests(refused_by_the_kernel).

% ---------------- UNPLUG AND REPLUG

:- begin_tests(replug).
test(a_motor_under_another_number_is_found_again,
     [forall(tree(Tree)), true(File1-V == File2-17)]) :-
    with_tree(Tree, ( position(outB, 0),
                      unplug(outB),
                      plug(outB, 'lego-ev3-l-motor'),
                      attribute_path(outB, position, File2),
                      put_attribute(outB, position, 17),
                      position(outB, V),
                      position_file(outB, File1) )).
test(a_command_reaches_the_new_motor,
     [forall(tree(Tree)), true(C == 'run-forever')]) :-
    with_tree(Tree, ( command(outB, stop),
                      unplug(outB),
                      plug(outB, 'lego-ev3-l-motor'),
                      motor_run(outB, 20),
                      get_attribute(outB, command, C) )).
test(a_sensor_under_another_number_is_found_again,
     [forall(tree(Tree)), true(D == 12.5)]) :-
    with_tree(Tree, ( us_dist_cm(in1, _),
                      unplug(in1),
                      plug(in1, 'lego-ev3-us'),
                      put_attribute(in1, value0, 125),
                      us_dist_cm(in1, D) )).
test(a_sensor_at_another_port_is_found_by_an_unbound_one,
     [forall(tree(Tree)), true(P == in3)]) :-
    with_tree(Tree, [in1-'lego-ev3-us'],
              ( us_dist_cm(_, _),
                unplug(in1),
                plug(in3, 'lego-ev3-us'),
                eventually(us_dist_cm(P, _)) )).
test(another_type_at_the_port_is_noticed,
     [forall(tree(Tree)), true(T == 'lego-ev3-touch')]) :-
    with_tree(Tree, ( us_dist_cm(in1, _),
                      unplug(in1),
                      plug(in1, 'lego-ev3-touch'),
                      \+ us_dist_cm(in1, _),
                      lego_sensor(in1, T) )).
test(a_motor_of_another_type_has_its_own_max_speed,
     [forall(tree(Tree)), true(S == 1560)]) :-
    with_tree(Tree, ( max_speed(outB, 1050),
                      motor_run(outB, 50),
                      unplug(outB),
                      plug(outB, 'lego-ev3-m-motor'),
                      motor_run(outB, 50),
                      get_attribute(outB, speed_sp, '780'),
                      max_speed(outB, S) )).
test(an_unplugged_device_fails, [forall(tree(Tree))]) :-
    with_tree(Tree, ( position(outB, 0),
                      us_dist_cm(in1, _),
                      unplug(outB),
                      unplug(in1),
                      \+ position(outB, _),
                      \+ command(outB, stop),
                      \+ us_dist_cm(in1, _),
                      \+ mode(in1, _) )).
test(an_unplugged_device_is_soon_no_longer_listed,
     [forall(tree(Tree)), true(Ps == [outA, outC, outD])]) :-
    with_tree(Tree, ( tacho_motor(outB),
                      unplug(outB),
                      eventually(\+ ( tacho_motor(P), P == outB )),
                      findall(P, tacho_motor(P), Ps) )).
test(a_device_plugged_in_is_found_at_once, [forall(tree(Tree))]) :-
    with_tree(Tree, [],
              ( \+ tacho_motor(outB),
                plug(outB, 'lego-ev3-l-motor'),
                tacho_motor(outB) )).
:- end_tests(replug).
