% What sensors say of themselves, and the table of what they are.

:- use_module('../support/trees').

% As a student's own file adds a sensor.
:- multifile
    ev3dev_sensor_info:known_type/2,
    ev3dev_sensor_info:known_mode/6.

ev3dev_sensor_info:known_type('my-scale', 'kitchen scale').
ev3dev_sensor_info:known_mode('my-scale', 'WEIGHT', 1, 1, g, 'weight in grams').

:- begin_tests(sensor_mode).
test(of_a_type, all(Mode/Count/Decimals/Units ==
                    [ 'REFLECT'/1/1/pct, 'AMBIENT'/1/1/pct ])) :-
    sensor_mode('lego-nxt-light', Mode, Count, Decimals, Units, _).
test(types_by_a_mode, true(Types == ['ht-nxt-compass', 'ms-absolute-imu'])) :-
    findall(Type, sensor_mode(Type, 'COMPASS', _, _, _, _), Types0),
    sort(Types0, Types).
test(each_is_sound, [forall(sensor_mode(Type, Mode, Count, Decimals, Units, Text))]) :-
    once(sensor_type(Type, What)),
    forall(member(Atom, [Type, Mode, Units, Text, What]), atom(Atom)),
    Text \== '',
    atom_length(Units, Length), Length =< 4,
    between(1, 23, Count),
    between(0, 3, Decimals).
test(each_is_there_once) :-
    findall(Type-Mode, sensor_mode(Type, Mode, _, _, _, _), All),
    length(All, Count),
    sort(All, Sorted),
    length(Sorted, Count),
    Count > 150.
test(each_type_has_modes, [forall(sensor_type(Type, _))]) :-
    once(sensor_mode(Type, _, _, _, _, _)).
test(a_program_adds_one, true(W-M == 'kitchen scale'-'weight in grams')) :-
    once(sensor_type('my-scale', W)),
    once(sensor_mode('my-scale', 'WEIGHT', 1, 1, g, M)).
test(what_is_not_in_the_table_fails, [fail]) :-
    sensor_mode('lego-ev3-nose', _, _, _, _, _).
test(each_reading_is_of_a_mode,
     [ forall(( ev3dev_sensors:reading_of(_, Types, Mode, Index),
                member(Type, Types) )) ]) :-
    once(sensor_mode(Type, Mode, Count, _, _, _)),
    Index < Count.

% The table here, and that of the simulator, were written apart. The simulator is a
% brick with ev3dev-stretch: it cannot load di-dflex, and knows fewer modes of one.
later('ht-super-pro', 'LED').
later('ht-super-pro', 'AOUT-0').
later('ht-super-pro', 'AOUT-1').

test(each_is_as_the_simulator_has_it,
     [ forall(( sensor_type(Type, _), \+ memberchk(Type, ['my-scale', 'di-dflex']) )),
       true(Says == Known) ]) :-
    with_sensor(simulator, Type, [],
                ( sensor_attribute(in1, modes, Text),
                  atomic_list_concat(Names, ' ', Text),
                  findall(Name/Count/Decimals/Units,
                          ( member(Name, Names),
                            % Single ultrasonic shots need a pause.
                            sim_step(0.3),
                            mode(in1, Name),
                            sensor_attribute(in1, num_values, Count),
                            sensor_attribute(in1, decimals, Decimals),
                            sensor_attribute(in1, units, Units) ),
                          Says) )),
    findall(Name/Count/Decimals/Units,
            ( sensor_mode(Type, Name, Count, Decimals, Units, _),
              \+ later(Type, Name) ),
            Known).
:- end_tests(sensor_mode).

:- begin_tests(sensor_info).
test(tells_all_of_a_compass,
     [ forall(behaving(Tree)),
       true(Info == [ type('ht-nxt-compass'), what('HiTechnic compass'),
                      mode('COMPASS'), values([90]), units(deg),
                      modes([mode('COMPASS', 1, 0, deg, Text)]),
                      commands(['BEGIN-CAL', 'END-CAL']) ]) ]) :-
    once(sensor_mode('ht-nxt-compass', 'COMPASS', _, _, _, Text)),
    with_sensor(Tree, 'ht-nxt-compass', [start(0, 0, 90)], sensor_info(in1, Info)).
test(in_a_plain_tree, true(Mode/Values/Units/Count/Commands ==
                           'US-DIST-CM'/[84.3]/cm/5/[])) :-
    with_tree(plain, ( put_attribute(in1, units, cm),
                       sensor_info(in1, Info) )),
    memberchk(mode(Mode), Info),
    memberchk(values(Values), Info),
    memberchk(units(Units), Info),
    memberchk(modes(Modes), Info),
    memberchk(commands(Commands), Info),
    length(Modes, Count).
test(leaves_the_sensor_in_its_mode, true(W == [])) :-
    with_tree(plain, ( sensor_info(in1, _), written(W) )).
test(of_a_sensor_that_is_in_no_table,
     true(Info == [ type('my-nose'), mode('SMELL'), values([0]), units(''),
                    modes([mode('SMELL'), mode('STINK')]), commands([]) ])) :-
    with_tree(plain, [in1-'lego-nxt-temp'],
              ( put_attribute(in1, driver_name, 'my-nose'),
                put_attribute(in1, modes, 'SMELL STINK'),
                put_attribute(in1, mode, 'SMELL'),
                put_attribute(in1, decimals, 0),
                put_attribute(in1, value0, 0),
                sensor_info(in1, Info) )).
test(each_sensor_in_turn, all(P-T == [ in1-'lego-ev3-us', in2-'lego-ev3-color',
                                       in3-'lego-ev3-color', in4-'lego-ev3-gyro' ])) :-
    with_tree(plain, ( sensor_info(P, Info), memberchk(type(T), Info) )).
test(of_no_sensor_fails, [fail]) :-
    with_tree(plain, sensor_info(in9, _)).
test(a_port_is_no_number, error(type_error(_, 7), _)) :-
    with_tree(plain, sensor_info(7, _)).
:- end_tests(sensor_info).

:- begin_tests(sensor_command).
test(is_written, true(Text == 'BEGIN-CAL')) :-
    with_tree(plain, ['in1:i2c1'-'ht-nxt-compass'],
              ( sensor_command(in1, 'BEGIN-CAL'),
                get_attribute('in1:i2c1', command, Text) )).
test(is_taken, [forall(behaving(Tree))]) :-
    with_sensor(Tree, 'ht-nxt-compass', [],
                ( sensor_command(in1, 'BEGIN-CAL'),
                  sensor_command('in1:i2c1', 'END-CAL') )).
test(that_it_has_not,
     [forall(behaving(Tree)), error(domain_error(command, 'JUMP'), _)]) :-
    with_sensor(Tree, 'ht-nxt-compass', [], sensor_command(in1, 'JUMP')).
test(to_a_sensor_that_has_none,
     [forall(behaving(Tree)), error(domain_error(command, 'RESET'), _)]) :-
    with_sensor(Tree, 'lego-ev3-gyro', [], sensor_command(in1, 'RESET')).
test(to_no_sensor_fails, [fail]) :-
    with_tree(plain, sensor_command(in9, 'RESET')).
test(needs_both, [ forall(member(P-C, [_-'RESET', in1-_])), error(instantiation_error, _) ]) :-
    with_tree(plain, sensor_command(P, C)).
:- end_tests(sensor_command).

:- begin_tests(socket).
test(a_port_finds_what_is_on_its_bus, true(P-T-Q == 'in1:i2c1'-'ht-nxt-compass'-Path)) :-
    with_tree(plain, ['in1:i2c1'-'ht-nxt-compass'],
              ( lego_sensor(P, _),
                lego_sensor(in1, T, Path),
                lego_sensor('ev3-ports:in1:i2c1', T, Q),
                mode(in1, 'COMPASS'),
                value(in1, 0, 0),
                sensor_attribute('ev3-ports:in1', decimals, 0) )).
test(it_is_written_by_its_port, true(Mode == 'NXT-TEMP-F')) :-
    with_tree(plain, ['in1:i2c76'-'lego-nxt-temp'],
              ( mode(in1, 'NXT-TEMP-F'), get_attribute('in1:i2c76', mode, Mode) )).
test(another_address_is_another_sensor, [fail]) :-
    with_tree(plain, ['in1:i2c76'-'lego-nxt-temp'], lego_sensor('in1:i2c1')).
test(the_simulator_takes_it, [true(Sensors == [])]) :-
    with_sensor(simulator, 'ht-nxt-compass', [],
                ( lego_sensor(P),
                  sim_unplug(P),
                  sim_step(0.3),
                  findall(S, lego_sensor(S), Sensors) )).
:- end_tests(socket).
