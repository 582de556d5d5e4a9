:- use_module('../support/trees').

% Ports of Tree.
in_tree(Tree, Goal) :-
    on(Tree, ( equip(Tree, [ port(in1)-'ev3-input-port',
                             port(in2)-'ev3-input-port',
                             port(in3)-'ev3-input-port',
                             port(in4)-'ev3-input-port',
                             port(outA)-'ev3-output-port',
                             port(outB)-'ev3-output-port',
                             port(outC)-'ev3-output-port',
                             port(outD)-'ev3-output-port' ]),
               Goal )).

% Play the kernel: once Attribute of a plain port is Text, Goal.
obey(plain, Port, Attribute, Text, Goal) :-
    !,
    eventually(get_attribute(port(Port), Attribute, Text)),
    call(Goal),
    forever.
obey(_, _, _, _, _) :-
    forever.

forever :-
    repeat,
    sleep(1),
    fail.

:- begin_tests(lego_port).
test(in_their_order,
     [ forall(tree(Tree)),
       true(Ports == [in1, in2, in3, in4, outA, outB, outC, outD]) ]) :-
    in_tree(Tree, findall(P, lego_port(P), Ports)).
test(in_either_spelling, [forall(tree(Tree))]) :-
    in_tree(Tree, ( lego_port(outA), lego_port('ev3-ports:outA'), \+ lego_port(outE) )).
:- end_tests(lego_port).

:- begin_tests(port_mode).
test(auto_at_first,
     [forall(tree(Tree)), true(Modes == [auto])]) :-
    in_tree(Tree, ( findall(M, port_mode(_, M), Ms), sort(Ms, Modes) )).
test(modes, [forall(tree(Tree)), true(Modes == [auto, 'tacho-motor', 'dc-motor', led, raw])]) :-
    in_tree(Tree, port_modes(outA, Modes)).
test(no_modes, true(Modes == [])) :-
    with_tree(plain, [port(outA)-'ev3-output-port'],
              ( put_attribute(port(outA), modes, ''),
                port_modes(outA, Modes) )).
test(status, [forall(tree(Tree)), true(S == 'no-motor')]) :-
    in_tree(Tree, port_status(outD, S)).
test(makes_a_device_appear_and_waits_for_it,
     [ forall(( tree(Tree),
                member(Port-Mode-Class-Type,
                       [ outA-'dc-motor'-dc_motor-'rcx-motor',
                         outD-'tacho-motor'-tacho_motor-'lego-ev3-l-motor',
                         in1-'ev3-analog'-lego_sensor-'ev3-analog-01',
                         in1-'nxt-analog'-lego_sensor-'nxt-analog' ]) )),
       true(M == Mode) ]) :-
    Goal =.. [Class, Port],
    in_tree(Tree, ( ( Tree == plain -> ignore(unplug(Port)) ; true ),
                    meanwhile(obey(Tree, Port, mode, Mode, plug(Port, Type)),
                              ( port_mode(Port, Mode), call(Goal) )),
                    port_mode(Port, M) )).
test(a_light_appears,
     [forall(behaving(Tree)), true(C == off)]) :-
    in_tree(Tree, ( port_mode(outD, led), led(outD, C) )).
test(the_device_can_be_used_at_once,
     [forall(behaving(Tree)), true(D == 40)]) :-
    in_tree(Tree, ( port_mode(outA, 'dc-motor'), dc_motor_run(outA, 40),
                    dc_motor_duty(outA, D) )).
test(what_was_there_is_gone, [forall(behaving(Tree)), fail]) :-
    in_tree(Tree, ( tacho_motor(outA), port_mode(outA, 'dc-motor'), tacho_motor(outA) )).
test(and_comes_back, [forall(behaving(Tree)), true(T == 'lego-ev3-m-motor')]) :-
    in_tree(Tree, ( port_mode(outA, raw), \+ tacho_motor(outA),
                    port_mode(outA, auto), tacho_motor(outA, T) )).
test(a_mode_that_is_the_present_one_changes_nothing,
     [forall(behaving(Tree)), true(F1 == F2)]) :-
    in_tree(Tree, ( port_mode(outA, 'dc-motor'),
                    subsystem_detect(outA, _, F1, '/sys/class/dc-motor/*'),
                    port_mode('ev3-ports:outA', 'dc-motor'),
                    subsystem_detect(outA, _, F2, '/sys/class/dc-motor/*') )).
test(an_absent_port_fails, [forall(tree(Tree)), fail]) :-
    in_tree(Tree, ( port_mode(outE, _) ; port_mode(outE, led) ;
                    port_modes(outE, _) ; port_status(outE, _) )).
test(no_ports, [fail]) :-
    with_tree(plain, port_mode(outA, 'dc-motor')).
test(an_unknown_mode_throws,
     [forall(behaving(Tree)), error(domain_error(mode, 'dc_motor'), _)]) :-
    in_tree(Tree, port_mode(outA, 'dc_motor')).
test(a_device_that_does_not_appear_fails, [fail]) :-
    with_tree(plain, [port(outA)-'ev3-output-port'], port_mode(outA, 'dc-motor')).
test(the_wait_can_be_interrupted, true(E == time_limit_exceeded)) :-
    with_tree(plain, [port(outA)-'ev3-output-port'],
              catch(call_with_time_limit(0.1, port_mode(outA, 'dc-motor')), E, true)).
test(what_is_no_mode_throws_and_writes_nothing,
     [ forall(member(Port-Mode-Error,
                     [ outA-7-type_error(atom, 7),
                       _-led-instantiation_error, 7-led-type_error(_, 7) ])),
       true(E-W == caught-[]) ]) :-
    with_tree(plain, [port(outA)-'ev3-output-port'],
              ( catch(port_mode(Port, Mode), error(Error, _), E = caught),
                written(W) )).
:- end_tests(port_mode).

:- begin_tests(port_device).
test(what_is_where,
     [ forall(tree(Tree)),
       true(Ds == [ in1-'lego-ev3-us', in2-'lego-ev3-color',
                    in3-'lego-ev3-color', in4-'lego-ev3-gyro',
                    outA-'lego-ev3-m-motor', outB-'lego-ev3-l-motor',
                    outC-'lego-ev3-l-motor' ]) ]) :-
    in_tree(Tree, findall(P-D, port_device(P, D), Ds)).
test(at_one_port, [forall(tree(Tree)), true(D == 'lego-ev3-m-motor')]) :-
    in_tree(Tree, ( port_device('ev3-ports:outA', D), \+ port_device(outD, _) )).
test(a_port_is_told_of_a_motor,
     [ forall(( tree(Tree),
                member(Type, ['lego-nxt-motor', 'act-l12-ev3-50']) )),
       true(T == Type) ]) :-
    in_tree(Tree, ( meanwhile(obey(Tree, outA, set_device, Type,
                                   ( unplug(outA), plug(outA, Type) )),
                              port_device(outA, Type)),
                    tacho_motor(outA, T) )).
test(a_port_is_told_of_a_sensor_and_its_address, true(T == 'lego-nxt-temp')) :-
    in_tree(plain, ( unplug(in1),
                     meanwhile(obey(plain, in1, set_device, 'lego-nxt-temp 76',
                                    plug(in1, 'lego-nxt-temp')),
                               port_device(in1, 'lego-nxt-temp 76')),
                     lego_sensor(in1, T) )).
test(what_is_there_already_is_not_written, true(W == [])) :-
    with_tree(plain, [outA-'lego-ev3-l-motor', port(outA)-'ev3-output-port'],
              ( port_device(outA, 'lego-ev3-l-motor'), written(W) )).
test(a_motor_that_there_is_not_throws_and_changes_nothing,
     [forall(tree(Tree)), true(T-E == 'lego-ev3-m-motor'-caught)]) :-
    in_tree(Tree, ( catch(port_device(outA, 'lego-ev3-xl-motor'),
                          error(domain_error(motor_type, 'lego-ev3-xl-motor'), _),
                          E = caught),
                    tacho_motor(outA, T) )).
test(a_port_that_cannot_be_told_throws,
     [ forall(( behaving(Tree),
                member(Port-Type, [ outD-'lego-nxt-motor', in1-'lego-nxt-light' ]) )),
       error(permission_error(write, unsupported_attribute, _), _) ]) :-
    in_tree(Tree, port_device(Port, Type)).
test(a_device_that_does_not_appear_fails, [fail]) :-
    with_tree(plain, [port(outA)-'ev3-output-port'], port_device(outA, 'lego-nxt-motor')).
test(the_wait_can_be_interrupted, true(E == time_limit_exceeded)) :-
    with_tree(plain, [port(outA)-'ev3-output-port'],
              catch(call_with_time_limit(0.1, port_device(outA, 'lego-nxt-motor')),
                    E, true)).
test(an_absent_port_fails, [forall(tree(Tree)), fail]) :-
    in_tree(Tree, ( port_device(outE, _) ; port_device(outE, 'lego-nxt-motor') )).
test(what_is_no_device_throws_and_writes_nothing,
     [ forall(member(Port-Device-Error,
                     [ outA-7-type_error(atom, 7), outA-''-domain_error(motor_type, ''),
                       _-'lego-nxt-motor'-instantiation_error ])),
       true(E-W == caught-[]) ]) :-
    with_tree(plain, [port(outA)-'ev3-output-port'],
              ( catch(port_device(Port, Device), error(Error, _), E = caught),
                written(W) )).
:- end_tests(port_device).

:- begin_tests(new_devices).
% What is just plugged in is not yet open to the program: udev takes 0.5 s.

test(a_motor_that_was_just_plugged_in_is_waited_for,
     [forall(member(Goal, [ motor_run(outD, 50), motor_run(outD, 50, 90),
                            motors_run([run(outB, 20), run(outD, 50)]),
                            speed_sp(outD, 100), motor_stop(outD),
                            motor_reset(outD), run_forever(outD, 100),
                            motor_run_direct(outD, 30),
                            motor_run_timed(outD, 50, 0.1),
                            motor_position(outD, 0),
                            command(outD, stop) ]))]) :-
    on(simulator, ( sim_plug(outD, 'lego-ev3-l-motor'), sim_step(0.41),
                    tacho_motor(outD), sim_time(T0),
                    call(Goal),
                    sim_time(T), T - T0 > 0.3 )).
test(others_do_not_run_before_it) :-
    on(simulator, ( sim_plug(outD, 'lego-ev3-l-motor'), sim_step(0.41),
                    motors_run([run(outB, 20), run(outD, 50)]),
                    sim_trace(Trace),
                    findall(T, member(T-written(_, 'run-forever'), Trace), [T1, T2]),
                    T2 - T1 < 0.01 )).
test(the_wait_can_be_interrupted, true(E == time_limit_exceeded)) :-
    on(simulator,
       ( sim_stop, sim_start(room, [clock(scaled(0.1))]),
         sim_plug(outD, 'lego-ev3-l-motor'), sim_step(0.41),
         catch(call_with_time_limit(0.2, motor_run(outD, 50)), E, true) )).
test(what_can_never_be_written_is_told_at_once,
     [forall(behaving(Tree)), error(permission_error(write, attribute, _), _)]) :-
    on(Tree, motor_attribute(outB, max_speed, 2000)).
:- end_tests(new_devices).
