% Registers of sensors on the I2C bus, and voltages, over three trees.

:- use_module('../support/trees').
:- use_module(library(ev3dev/raw)).

:- meta_predicate with_compass(+, 0).

% A compass at in1. A plain file has its registers.
with_compass(Tree, Goal) :-
    with_sensor(Tree, 'ht-nxt-compass', [],
                ( registers(Tree), settle(Tree), call(Goal) )).

registers(plain) :-
    !,
    attribute_path('in1:i2c1', direct, File),
    setup_call_cleanup(
        open(File, write, Stream, [type(binary)]),
        ( forall(member(Text, ['V1.0    ', 'HITECHNC', 'Compass ']),
                 forall(sub_atom(Text, _, 1, _, Char),
                        ( char_code(Char, Code), put_byte(Stream, Code) ))),
          forall(between(24, 254, _), put_byte(Stream, 0)) ),
        close(Stream)).
registers(_).

%   Let time pass until a sensor is there.

appears(Port) :-
    between(1, 100, _),
    sim_wait(0.05),
    lego_sensor(Port, _),
    !.

:- begin_tests(i2c).
test(registers_are_read,
     [forall(tree(Tree)), true(Makers == ['HITECHNC'])]) :-
    with_compass(Tree,
                 setof(Maker,
                       Port^Bytes^( member(Port, [in1, "in1", 'ev3-ports:in1', 'in1:i2c1']),
                                    i2c_read(Port, 8, 8, Bytes),
                                    atom_codes(Maker, Bytes) ),
                       Makers)).
test(what_is_written_is_read,
     [forall(tree(Tree)), true(Read == [[67, 0], [1, 2, 200, 255], Most])]) :-
    numlist(100, 131, Most),
    with_compass(Tree, ( i2c_write(in1, 0x40, [67, 0]),
                         i2c_write("in1", 128, [1, 2, 200, 255]),
                         i2c_write(in1, 223, Most),
                         i2c_read(in1, 0x40, 2, Command),
                         i2c_read(in1, 128, 4, Bytes),
                         i2c_read(in1, 223, 32, Last) )),
    Read = [Command, Bytes, Last].
test(a_bound_value_is_compared, [forall(tree(Tree)), fail]) :-
    with_compass(Tree, i2c_read(in1, 8, 2, [1, 2])).
test(what_a_sensor_says_of_itself_stays, [forall(behaving(Tree)), true(Byte == 0'H)]) :-
    with_compass(Tree, ( i2c_write(in1, 8, [0]), i2c_read(in1, 8, 1, [Byte]) )).
test(the_measurement_is_at_66, [forall(behaving(Tree)), true(X-Y == 90-0)]) :-
    with_sensor(Tree, 'ht-nxt-compass', [start(0, 0, 90)],
                ( settle(Tree), compass(in1, 90), i2c_read(in1, 66, 2, [X, Y]) )).
test(without_a_sensor_they_fail,
     [forall(tree(Tree)), fail]) :-
    with_compass(Tree, ( i2c_read(in3, 0, 8, _) ; i2c_write(in3, 65, [1]) )).
test(a_sensor_that_is_pulled_out_is_none, [forall(tree(Tree)), fail]) :-
    with_tree(Tree, ['in1:i2c1'-'ht-nxt-compass'],
              ( registers(Tree), settle(Tree),
                i2c_read(in1, 0, 1, _),
                ( Tree == plain -> unplug('in1:i2c1') ; sim_unplug(in1), sim_wait(1) ),
                i2c_read(in1, 0, 1, _) )).
test(one_that_is_plugged_in_again_is_read_and_written_at_once,
     [forall(behaving(Tree)), true(Byte == 7)]) :-
    with_compass(Tree, ( i2c_write(in1, 65, [9]),
                         sim_unplug(in1), sim_wait(1),
                         sim_plug(in1, 'ht-nxt-compass'),
                         appears(in1),
                         i2c_write(in1, 65, [7]),
                         i2c_read(in1, 65, 1, [Byte]) )).
test(another_sensor_is_named,
     [ forall(( tree(Tree),
                member(Goal-Called, [ i2c_read(in1, 0, 8, _)-(i2c_read/4),
                                      i2c_write(in1, 65, [1])-(i2c_write/3) ]) )),
       true(E == error(domain_error(i2c_sensor, in1), context(Called, Text))) ]) :-
    Text = 'the lego-ev3-us at in1 is not on the I2C bus',
    with_tree(Tree, catch(Goal, E, true)).
test(a_refused_call_writes_nothing,
     [ forall(member(Goal, [ i2c_write(in1, 65, [1, 300]), i2c_write(in1, 250, [1, 2, 3, 4, 5, 6]),
                             i2c_write(in1, 255, [1]), i2c_write(in1, 65, []) ])),
       true(E-Trace == domain-[]) ]) :-
    with_compass(simulator,
                 ( catch(Goal, error(domain_error(_, _), _), E = domain),
                   sim_trace(Events) )),
    findall(F, ( member(_-written(F, _), Events), sub_atom(F, _, _, 0, direct) ), Trace).
test(too_many_are_explained,
     [ forall(member(Goal-Culprit, [ i2c_read(in1, 0, 33, _)-33, i2c_read(in1, 250, 6, _)-6,
                                     i2c_write(in1, 254, [1, 2])-[1, 2] ])),
       true(Domain-Text == i2c_count-Expected) ]) :-
    format(atom(Expected), 'the count must be from 1 to 32 bytes, up to register 254, not ~p', [Culprit]),
    catch(Goal, error(domain_error(Domain, Culprit), context(_, Text)), true).
test(a_plain_file_that_is_too_short_is_no_sensor, error(syntax_error(attribute), _)) :-
    with_tree(plain, ['in1:i2c1'-'ht-nxt-compass'],
              ( put_attribute('in1:i2c1', direct, short), i2c_read(in1, 4, 8, _) )).
:- end_tests(i2c).

:- begin_tests(analog_voltage).
test(is_that_of_the_sensor,
     [ forall(( tree(Tree), member(Type, ['nxt-analog', 'ev3-analog-01', 'ev3-analog-14']) )),
       all(P-V == [in1-2.504]) ]) :-
    with_tree(Tree, [in1-Type, in4-'lego-ev3-gyro'],
              ( put_attribute(in1, value0, 2504),
                put_attribute(in1, decimals, 3),
                analog_voltage(P, V) )).
test(at_a_port_it_leaves_no_choice,
     [ forall(( tree(Tree), member(Port, [in1, "in1", 'ev3-ports:in1']) )), true(Det == true) ]) :-
    with_tree(Tree, [in1-'ev3-analog-01'],
              call_cleanup(analog_voltage(Port, _), Det = true)).
test(in_the_order_of_ports, all(P-V == [in1-1.5, in2-0.3, in4-5.0])) :-
    with_tree(simulator,
              [ in4-'nxt-analog', in1-'ev3-analog-03', in2-'nxt-analog', in3-'lego-ev3-us' ],
              ( member(Port-Raw, [in1-1500, in2-300, in4-5000]),
                sim_show(Port, value0, Raw),
                Port == in4,
                analog_voltage(P, V) )).
test(measures_with_the_lamp_off, true(Mode == 'ANALOG-0')) :-
    with_tree(simulator, [in1-'nxt-analog'],
              ( mode(in1, 'ANALOG-1'), analog_voltage(in1, _), mode(in1, Mode) )).
test(a_port_is_put_into_a_mode_for_it,
     [ forall(( behaving(Tree), member(Mode, ['nxt-analog', 'ev3-analog']) )),
       true(V-Type == 2.504-'lego-ev3-us') ]) :-
    with_tree(Tree, [in1-'lego-ev3-us'],
              ( port_mode(in1, Mode),
                sim_show(in1, value0, 2504),
                analog_voltage(in1, V),
                port_mode(in1, auto),
                appears(in1),
                lego_sensor(in1, Type),
                \+ analog_voltage(in1, _) )).
test(a_bumper_is_a_switch_to_5_volts,
     [forall(behaving(Tree)), true(Free-Pressed == 0.0-5.0)]) :-
    with_sensor(Tree, 'lego-ev3-touch', [],
                ( port_mode(in1, 'ev3-analog'),
                  settle(Tree),
                  analog_voltage(in1, Free),
                  sim_press(in1),
                  settle(Tree),
                  analog_voltage(in1, Pressed) )).
test(pin_1_has_the_resistor_by_which_the_port_knows_it,
     [forall(behaving(Tree)), true(V == 0.417)]) :-
    with_sensor(Tree, 'lego-ev3-touch', [],
                ( port_mode(in1, 'nxt-analog'),
                  settle(Tree),
                  analog_voltage(in1, V) )).
test(can_be_waited_for, true(Reason == reached)) :-
    with_tree(simulator, [in1-'nxt-analog'],
              ( sim_at(1, sim_show(in1, value0, 3000)),
                sensor_wait(analog_voltage(in1) > 2.5, [timeout(3), reason(Reason)]) )).
test(fails_without_a_sensor, [forall(member(P, [_, in1])), fail]) :-
    with_tree(plain, [], analog_voltage(P, _)).
:- end_tests(analog_voltage).
