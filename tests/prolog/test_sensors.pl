:- use_module('../support/trees').
:- use_module(library(ev3dev/drive)).

% As a student's own file adds a sensor.
:- multifile ev3dev_sensors:reading/4.

ev3dev_sensors:reading(voltage, ['ev3-analog-01'], 'ANALOG', 0).
ev3dev_sensors:reading(us_dist_inches, ['ev3-analog-01'], 'ANALOG', 0).

% ---------------- KINDS

:- begin_tests(kinds).
% Of the last two, which sit at the same port, one at a time.
all_kinds(Last, [ in1-'lego-ev3-us', in2-'lego-ev3-color', in3-'lego-ev3-gyro',
                  in4-Last ]).

test(each_kind_has_its_predicate,
     [ forall(( tree(Tree),
                member(Last-Own, [ 'lego-ev3-touch'-touch_sensor(P),
                                   'lego-ev3-ir'-infrared_sensor(P) ]),
                member(Goal-P-Port, [ light_sensor(P)-P-in2,
                                      ultrasonic_sensor(P)-P-in1,
                                      gyro_sensor(P)-P-in3,
                                      Own-P-in4 ]) )),
       all(P == [Port]) ]) :-
    all_kinds(Last, Devices),
    with_tree(Tree, Devices, Goal).
test(several_are_listed_in_port_order,
     [forall(tree(Tree)), all(P == [in2, in3])]) :-
    with_tree(Tree, light_sensor(P)).
test(the_long_spelling_is_taken, [forall(tree(Tree))]) :-
    with_tree(Tree, light_sensor('ev3-ports:in2')).
test(another_kind_fails, [forall(tree(Tree)), fail]) :-
    with_tree(Tree, light_sensor(in1)).
test(none_fails, [forall(tree(Tree)), fail]) :-
    with_tree(Tree, [], gyro_sensor(_)).
test(a_port_is_no_number,
     [forall(tree(Tree)), error(type_error(_, 2), _)]) :-
    with_tree(Tree, light_sensor(2)).
:- end_tests(kinds).

% ---------------- READINGS

:- begin_tests(readings).
% The values of a sensor, from value0 on.
shows(Port, Values) :-
    forall(nth0(Index, Values, Value),
           ( atom_concat(value, Index, Attribute),
             put_attribute(Port, Attribute, Value) )).

% reading(Goal, Type, Mode, Raw, V, Value): with a sensor of Type at in1 that
% shows Raw, Goal puts it into Mode and V becomes Value.
reading(col_ambient(in1, V),    'lego-ev3-color', 'COL-AMBIENT', 42, V, 42).
reading(col_reflect(in1, V),    'lego-ev3-color', 'COL-REFLECT', 42, V, 42).
reading(col_color(in1, V),      'lego-ev3-color', 'COL-COLOR',   5,  V, 5).
reading(col_rgb_raw(in1, V),    'lego-ev3-color', 'RGB-RAW',     42, V, rgb(42, 0, 0)).
reading(us_dist_cm(in1, V),     'lego-ev3-us',    'US-DIST-CM',  843, V, 84.3).
reading(us_dist_inches(in1, V), 'lego-ev3-us',    'US-DIST-IN',  332, V, 33.2).
reading(gyro_ang(in1, V),       'lego-ev3-gyro',  'GYRO-ANG',    -30, V, -30).
reading(gyro_ang_rate(in1, V, _), 'lego-ev3-gyro', 'GYRO-G&A',  -30, V, -30).
reading(gyro_rate(in1, V),      'lego-ev3-gyro',  'GYRO-G&A',    0,   V, 0).
reading(touch(in1, V),          'lego-ev3-touch', 'TOUCH',       1, V, 1).
reading(ir_prox(in1, V),        'lego-ev3-ir',    'IR-PROX',     35, V, 35).

test(each_is_a_mode_and_a_scaled_value,
     [ forall(( tree(Tree),
                reading(Goal, Type, Mode, Raw, V, Value) )), true(V-M == Value-Mode) ]) :-
    with_tree(Tree, [in1-Type],
              ( shows(in1, [Raw, 0, 0]),
                Goal,
                get_attribute(in1, mode, M) )).
test(each_fails_at_a_sensor_of_another_type_and_writes_nothing,
     [ forall(( tree(Tree),
                reading(Goal, Type, _, _, _, _), Type \== 'lego-ev3-gyro' )),
       true(W == []) ]) :-
    with_tree(Tree, [in1-'lego-ev3-gyro'],
              ( \+ Goal,
                written(W) )).
test(each_fails_without_a_sensor, [ forall(( tree(Tree),
                                             reading(Goal, _, _, _, _, _) )), fail ]) :-
    with_tree(Tree, [], Goal).
test(each_fails_for_another_value,
     [ forall(( tree(Tree), reading(Goal, Type, _, _, V, _) )), fail ]) :-
    with_tree(Tree, [in1-Type],
              ( V = other,
                Goal )).
test(us_listen_is_0_or_1, [forall(tree(Tree)), true(V == 1)]) :-
    with_tree(Tree, [in1-'lego-ev3-us'],
              ( put_attribute(in1, decimals, 0),
                put_attribute(in1, value0, 1),
                us_listen(in1, V) )).
test(col_rgb_raw_has_three_values,
     [forall(tree(Tree)), true([R, G, B] == [1, 2, 3])]) :-
    with_tree(Tree, ( shows(in2, [1, 2, 3]),
                      col_rgb_raw(in2, R, G, B) )).
test(col_rgb_raw_takes_a_list,
     [forall(tree(Tree)), true([R, G, B] == [1, 2, 3])]) :-
    with_tree(Tree, ( shows(in2, [1, 2, 3]),
                      col_rgb_raw(in2, [R, G, B]) )).
test(an_unbound_port_is_each_that_has_one,
     [forall(tree(Tree)), all(P-V == [in2-42, in3-17])]) :-
    with_tree(Tree, ( shows(in2, [42]),
                      shows(in3, [17]),
                      col_ambient(P, V) )).
test(an_unbound_port_is_each_for_colours_too,
     [forall(tree(Tree)), all(P-V == [in2-rgb(42, 0, 0), in3-rgb(1, 2, 3)])]) :-
    with_tree(Tree, ( shows(in2, [42, 0, 0]),
                      shows(in3, [1, 2, 3]),
                      col_rgb_raw(P, V) )).
test(a_value_selects_a_port, [forall(tree(Tree)), all(P == [in3])]) :-
    with_tree(Tree, ( put_attribute(in3, value0, 17),
                      col_ambient(P, 17) )).
test(the_long_spelling_is_taken, [forall(tree(Tree)), true(V == 84.3)]) :-
    with_tree(Tree, ( shows(in1, [843]),
                      us_dist_cm('ev3-ports:in1', V) )).
test(a_port_is_no_number,
     [ forall(( tree(Tree),
                member(Goal, [us_dist_cm(1, _), col_rgb_raw(1, _), gyro_reset(1)]) )),
       error(type_error(_, 1), _) ]) :-
    with_tree(Tree, Goal).
:- end_tests(readings).

:- begin_tests(gyro).
test(shows_angle_and_rate_at_once, [forall(tree(Tree)), all(P-A-R == [in4-90-7])]) :-
    with_tree(Tree, ( put_attribute(in4, mode, 'GYRO-G&A'),
                      put_attribute(in4, value0, 90),
                      put_attribute(in4, value1, 7),
                      gyro_ang_rate(P, A, R) )).
test(the_angle_goes_on_when_the_rate_is_read, true(Off =< 2)) :-
    with_tree(simulator,
              ( set_robot(5.6, 10.6, outB, outC),
                turn(20, 90),
                gyro_ang(in4, A),
                gyro_rate(in4, _),
                gyro_ang(in4, B),
                gyro_ang_rate(in4, C, _),
                mode(in4, M), M == 'GYRO-G&A',
                sensor_reading(gyro_ang, in4, D) )),
    Off is max(abs(A - 90), max(abs(B - 90), max(abs(C - 90), abs(D - 90)))).
test(a_reset_makes_the_angle_0_in_either_mode, true(As == [0, 0, 0])) :-
    with_tree(simulator,
              ( set_robot(5.6, 10.6, outB, outC),
                turn(20, 90),
                gyro_reset(in4), gyro_ang(in4, A0),
                turn(20, -90),
                gyro_rate(in4, _),
                gyro_reset(in4), gyro_ang(in4, A1),
                gyro_ang_rate(in4, A2, _) )),
    As = [A0, A1, A2].
test(a_turn_is_as_exact_in_the_mode_of_angle_and_rate) :-
    with_tree(simulator,
              ( set_robot(5.6, 10.0, outB, outC),
                gyro_rate(in4, _),
                turn(20, 90),
                mode(in4, 'GYRO-G&A'),
                gyro_ang(in4, A) )),
    assertion(abs(A - 90) =< 2).
test(a_turn_is_as_exact_if_the_rate_is_read_meanwhile) :-
    with_tree(simulator,
              ( set_robot(5.6, 10.0, outB, outC),
                sim_place(150, 150, 0),
                turn(20, 90, [wait(false)]),
                wait(0.4),
                gyro_rate(in4, R), R > 5,
                drive_wait([], reached),
                gyro_ang(in4, A) )),
    assertion(abs(A - 90) =< 3).
test(its_own_mode_shows_no_second_value, error(domain_error(sensor_value_index, 1), _)) :-
    with_tree(simulator, ( put_attribute(in4, mode, 'GYRO-G&A'),
                      sensor_value(in4, 'GYRO-ANG', 1, _) )).
:- end_tests(gyro).

:- begin_tests(sensor_reading).
test(a_program_adds_a_sensor_by_a_fact,
     [forall(tree(Tree)), all(P-V == [in2-2.15])]) :-
    with_tree(Tree, [in1-'lego-ev3-us', in2-'ev3-analog-01'],
              ( put_attribute(in2, value0, 2150),
                sensor_reading(voltage, P, V) )).
test(a_program_adds_a_sensor_to_a_reading_of_the_table,
     [forall(tree(Tree)), all(P == [in1, in2])]) :-
    with_tree(Tree, [in1-'lego-ev3-us', in2-'ev3-analog-01'],
              us_dist_inches(P, _)).
test(a_sensor_that_was_added_is_read_by_its_port,
     [forall(tree(Tree)), true(V == 2.15)]) :-
    with_tree(Tree, [in1-'lego-ev3-us', in2-'ev3-analog-01'],
              ( put_attribute(in2, value0, 2150),
                us_dist_inches(in2, V) )).
test(an_added_sensor_fails_elsewhere, [forall(tree(Tree)), fail]) :-
    with_tree(Tree, sensor_reading(voltage, _, _)).
test(of_several_sensors_with_a_reading_that_at_the_port_is_meant,
     [forall(tree(Tree)), true(V == 21.5)]) :-
    with_tree(Tree, [in1-'lego-nxt-temp', in2-'ms-ir-thermometer'],
              ( put_attribute(in1, value0, 215),
                sensor_reading(temperature, in1, V) )).
test(what_is_not_in_the_table_fails, [forall(tree(Tree)), fail]) :-
    with_tree(Tree, sensor_reading(smell, _, _)).
:- end_tests(sensor_reading).

% ---------------- MODES

% Whether nobody has written the mode of a sensor since. A plain file is marked
% by a second line, as what is written may be what it held; of the others it is
% known.
marked(Port) :-
    current_tree(plain),
    !,
    get_attribute(Port, mode, Mode),
    atom_concat(Mode, '\nuntouched', Text),
    put_attribute(Port, mode, Text).
marked(Port) :-
    is_marked(Port).

is_marked(Port) :-
    current_tree(plain),
    !,
    attribute_path(Port, mode, File),
    read_file_to_string(File, Text, []),
    sub_string(Text, _, _, _, "untouched"),
    !.
is_marked(Port) :-
    written(Port, Written),
    \+ memberchk(mode=_, Written).

:- begin_tests(modes).
test(the_present_mode_is_not_written_again,
     [ forall(( tree(Tree),
                member(Goal, [ us_dist_cm(in1, _), col_reflect(in2, _),
                               sensor_value(in1, 'US-DIST-CM', 0, _),
                               mode(in1, 'US-DIST-CM'), gyro_ang(in4, _) ]) )) ]) :-
    with_tree(Tree, ( marked(in1), marked(in2), marked(in4),
                      Goal,
                      is_marked(in1), is_marked(in2), is_marked(in4) )).
% A kernel has no text that is too long.
test(another_mode_is_written_whole,
     [ true(Text == "US-LISTEN\n") ]) :-
    with_tree(plain, ( marked(in1),
                       us_listen(in1, _),
                       attribute_path(in1, mode, File),
                       read_file_to_string(File, Text, []) )).
test(only_the_sensor_that_is_read_changes_its_mode,
     [forall(tree(Tree)), true(W == [in2-(mode='COL-AMBIENT')])]) :-
    with_tree(Tree, ( once(col_ambient(_, _)),
                      written(W) )).
test(gyro_reset_writes_the_mode_even_if_it_is_the_present_one, [forall(tree(Tree))]) :-
    with_tree(Tree, ( marked(in4),
                      gyro_reset('ev3-ports:in4'),
                      \+ is_marked(in4),
                      get_attribute(in4, mode, 'GYRO-ANG') )).
test(gyro_reset_fails_at_another_sensor_and_writes_nothing,
     [forall(tree(Tree)), true(W == [])]) :-
    with_tree(Tree, ( \+ gyro_reset(in1),
                      \+ gyro_reset(in9),
                      written(W) )).
test(gyro_reset_needs_a_port,
     [forall(tree(Tree)), error(instantiation_error, _)]) :-
    with_tree(Tree, gyro_reset(_)).
test(a_signal_may_ask_for_the_sensor_that_is_settling,
     [forall(tree(Tree)), true(V-M == 35-'IR-PROX')]) :-
    with_tree(Tree, [in1-'lego-ev3-ir'],
              ( put_attribute(in1, mode, 'IR-SEEK'),
                put_attribute(in1, value0, 35),
                thread_self(Me),
                later(0.05, thread_signal(Me, sensor_value(in1, 'IR-SEEK', 0, _))),
                call_with_time_limit(300, ir_prox(in1, V)),
                get_attribute(in1, mode, M) )).
test(a_time_limit_gets_through_to_a_sensor_that_settles,
     [forall(tree(Tree)), true(Ball == time_limit_exceeded)]) :-
    with_tree(Tree, [in1-'lego-ev3-ir'],
              ( put_attribute(in1, mode, 'IR-SEEK'),
                catch(call_with_time_limit(0.05, to_and_fro), Ball, true) )).

% Settles in each mode, again and again: on the virtual clock that takes no time.
to_and_fro :-
    repeat,
    ir_prox(in1, _),
    mode(in1, 'IR-SEEK'),
    fail.
:- end_tests(modes).

:- begin_tests(sensor_value).
test(gives_any_value_in_any_mode,
     [forall(tree(Tree)), true(V-M == 7-'COL-COLOR')]) :-
    with_tree(Tree, ( put_attribute(in2, value2, 7),
                      sensor_value(in2, 'COL-COLOR', 2, V),
                      get_attribute(in2, mode, M) )).
test(an_unbound_port_is_each_that_has_the_mode,
     [forall(tree(Tree)), all(P == [in2, in3])]) :-
    with_tree(Tree, sensor_value(P, 'COL-COLOR', 0, _)).
test(a_mode_that_no_sensor_has_fails_for_an_unbound_port, [forall(tree(Tree)), fail]) :-
    with_tree(Tree, sensor_value(_, 'NO-MODE', 0, _)).
test(an_absent_sensor_fails, [forall(tree(Tree)), fail]) :-
    with_tree(Tree, sensor_value(in9, 'COL-COLOR', 0, _)).
test(a_wrong_argument_throws_and_writes_nothing,
     [ forall(( tree(Tree),
                member(Port-Mode-Index0-Error,
                       [ in1-_-0-instantiation_error,
                         in1-'US-LISTEN'-_-instantiation_error,
                         in1-'US-LISTEN'-a-type_error(integer, a),
                         in1-'US-LISTEN'-8-domain_error(sensor_value_index, 8),
                         in1-'US-LISTEN'-(-1)-domain_error(sensor_value_index, -1),
                         in1-7-0-type_error(_, 7),
                         7-'US-LISTEN'-0-type_error(_, 7) ]) ,
                Index = Index0 )),
       true(Caught-W == caught-[]) ]) :-
    with_tree(Tree, ( catch(sensor_value(Port, Mode, Index, _), error(Error, _), Caught = caught),
                      written(W) )).
:- end_tests(sensor_value).

:- begin_tests(adjust_val).
test(scales_by_the_decimals_of_the_present_mode,
     [ forall(( tree(Tree),
                member(Decimals-Raw-Value, [ 0-843-843, 1-843-84.3, 2-(-5)-(-0.05),
                                             3-0-0.0 ]) )),
       true(V == Value) ]) :-
    with_tree(Tree, ( put_attribute(in1, decimals, Decimals),
                      adjust_val(in1, Raw, V) )).
test(fails_without_a_sensor, [forall(tree(Tree)), fail]) :-
    with_tree(Tree, [], adjust_val(in1, 843, _)).
test(a_wrong_argument_throws,
     [ forall(( tree(Tree),
                member(Port-Raw-Error, [ _-1-instantiation_error,
                                         in1-_-instantiation_error,
                                         in1-1.5-type_error(integer, 1.5),
                                         in1-a-type_error(integer, a) ]) )),
       error(Error, _) ]) :-
    with_tree(Tree, adjust_val(Port, Raw, _)).
test(a_raw_value_beyond_64_bits_throws,
     [forall(tree(Tree)), error(representation_error(_), _)]) :-
    Raw is 10**400,
    with_tree(Tree, adjust_val(in1, Raw, _)).
:- end_tests(adjust_val).
