% Sensors of the NXT and of other makers, over three trees.

:- use_module('../support/trees').

%!  shows(Goal, Type, Mode, Raw, Decimals, V, Plain, World, Simulated)
%
%   With a sensor of Type at in1 that shows the numbers Raw with Decimals, Goal
%   puts it into Mode and V becomes Plain. In World, V becomes Simulated.

shows(nxt_light(P, V), P, 'lego-nxt-light', 'REFLECT', [553], 1,
      V, 55.3, [], 92.2).
shows(nxt_light(P, V), P, 'lego-nxt-light', 'REFLECT', [-12], 1,
      V, -1.2, [floor(black)], 5.9).
shows(nxt_ambient(P, V), P, 'lego-nxt-light', 'AMBIENT', [121], 1,
      V, 12.1, [ambient(33)], 33.0).
shows(nxt_sound(P, V), P, 'lego-nxt-sound', 'DB', [900], 1,
      V, 10.0, [loudness(30)], 30.0).
shows(nxt_sound(P, V), P, 'lego-nxt-sound', 'DB', [1000], 1,
      V, 0.0, [], 0.0).
shows(temperature(P, V), P, 'lego-nxt-temp', 'NXT-TEMP-C', [-45], 1,
      V, -4.5, [temperature(-4.5)], -4.5).
shows(temperature(P, V), P, 'ht-nxt-barometric', 'TEMP', [215], 1,
      V, 21.5, [], 21.5).
shows(temperature(P, V), P, 'ms-ir-thermometer', 'AMBIENT-C', [2155], 2,
      V, 21.55, [temperature(30)], 30.0).
shows(target_temperature(P, V), P, 'ms-ir-thermometer', 'TARGET-C', [3650], 2,
      V, 36.5, [], 21.5).
shows(pressure(P, V), P, 'ht-nxt-barometric', 'PRESS', [30000], 3,
      V, 1015.917, [], 1013.242).
shows(pressure(P, V), P, 'ms-pps58-nx', 'ABS-MBAR', [2500], 0,
      V, 2500, [], 1013).
shows(compass(P, V), P, 'ht-nxt-compass', 'COMPASS', [270], 0,
      V, 270, [start(0, 0, -90)], 270).
shows(compass(P, V), P, 'ms-absolute-imu', 'COMPASS', [12], 0,
      V, 12, [start(0, 0, 400)], 40).
shows(ht_color(P, V), P, 'ht-nxt-color', 'COLOR', [8], 0,
      V, 8, [floor(red)], 8).
shows(ht_color(P, V), P, 'ht-nxt-color-v2', 'COLOR', [17], 0,
      V, 17, [floor(blue)], 3).
shows(ht_color_rgb(P, V), P, 'ht-nxt-color', 'ALL', [8, 200, 10, 20], 0,
      V, rgb(200, 10, 20), [floor('#406080')], rgb(64, 96, 128)).
shows(ht_color_rgb(P, V), P, 'ht-nxt-color-v2', 'RGB', [200, 10, 20], 0,
      V, rgb(200, 10, 20), [floor('#406080')], rgb(64, 96, 128)).
shows(ht_gyro_rate(P, V), P, 'ht-nxt-gyro', 'GYRO', [-30], 0,
      V, -30, [], 0).
shows(ht_eopd(P, long, V), P, 'ht-nxt-eopd', 'LONG', [35], 0,
      V, 35, [wall(-50, 20.5, 50, 20.5)], 18).
shows(ht_eopd(P, short, V), P, 'ht-nxt-eopd', 'SHORT', [7], 0,
      V, 7, [wall(-50, 20.5, 50, 20.5)], 4).
shows(acceleration(P, X, Y, Z), P, 'ht-nxt-accel', 'ALL',
      [50, 0, 206, 0, 1, 2], 0,
      [X, Y, Z], [1.0, 0.005, -0.99], [], [0.0, 0.0, 1.0]).
shows(acceleration(P, X, Y, Z), P, 'ms-absolute-imu', 'ACCEL',
      [10, -20, 1000], 3,
      [X, Y, Z], [0.01, -0.02, 1.0], [], [0.0, 0.0, 1.0]).
shows(acceleration(P, X, Y, Z), P, 'mi-xg1300l', 'ACCEL', [10, -20, 1000], 3,
      [X, Y, Z], [0.01, -0.02, 1.0], [], [0.0, 0.0, 1.0]).
shows(rotation_rate(P, X, Y, Z), P, 'ms-absolute-imu', 'GYRO', [1, -2, 30], 1,
      [X, Y, Z], [0.1, -0.2, 3.0], [], [0.0, 0.0, 0.0]).
shows(tilt(P, X, Y, Z), P, 'ms-absolute-imu', 'TILT', [1, -2, 80], 0,
      [X, Y, Z], [1, -2, 80], [], [0, 0, 90]).
shows(magnetic_field(P, X, Y, Z), P, 'ms-absolute-imu', 'MAG', [1, -2, 80], 0,
      [X, Y, Z], [1, -2, 80], [], [0, 300, -400]).
shows(angle_deg(P, V), P, 'ht-nxt-angle', 'ANGLE', [359], 0,
      V, 359, [], 0).
shows(angle_total(P, V), P, 'ht-nxt-angle', 'ANGLE-ACC', [-720], 0,
      V, -720, [], 0).
shows(angle_total(P, V), P, 'ms-angle', 'ANGLE2', [905], 1,
      V, 90.5, [], 0.0).
shows(angle_rpm(P, V), P, 'ht-nxt-angle', 'SPEED', [-60], 0,
      V, -60, [], 0).
shows(angle_rpm(P, V), P, 'ms-angle', 'SPEED', [60], 0,
      V, 60, [], 0).
shows(light_row(P, V), P, 'ms-light-array', 'CAL', [1, 2, 3, 4, 5, 6, 7, 8], 0,
      V, [1, 2, 3, 4, 5, 6, 7, 8], [],
      [100, 100, 100, 100, 100, 100, 100, 100]).
shows(light_row(P, V), P, 'ms-line-leader', 'CAL', [1, 2, 3, 4, 5, 6, 7, 8], 0,
      V, [1, 2, 3, 4, 5, 6, 7, 8], [],
      [100, 100, 100, 100, 100, 100, 100, 100]).
shows(line_leader(P, S, L), P, 'ms-line-leader', 'PID-ALL', [-30, 25, 6], 0,
      S-L, -30-[2, 3], [line(black, 1, [2.2- -50, 2.2-50])], 71-[7]).
shows(line_leader(P, S, L), P, 'ms-line-leader', 'PID-ALL', [100, 80, -128], 0,
      S-L, 100-[8], [], 0-[]).
shows(energy_meter(P, I, O, J), P, 'lego-power-storage', 'ALL',
      [7200, 100, 500, 20, 50, 720, 10], 3,
      m(I, O, J), m(power(7.2, 0.1, 0.72), power(0.5, 0.02, 0.01), 50), [],
      m(power(0.0, 0.0, 0.0), power(0.0, 0.0, 0.0), 50)).
shows(touch(P, V), P, 'lego-nxt-touch', 'TOUCH', [1], 0,
      V, 1, [], 0).
shows(us_dist_cm(P, V), P, 'lego-nxt-us', 'US-DIST-CM', [80], 0,
      V, 80, [wall(-100, 60.5, 100, 60.5)], 60).
shows(us_dist_inches(P, V), P, 'lego-nxt-us', 'US-DIST-IN', [314], 1,
      V, 31.4, [], 100.0).
shows(us_listen(P, V), P, 'lego-nxt-us', 'US-LISTEN', [1], 0,
      V, 1, [], 0).
shows(sensor_reading(force, P, V), P, 'ht-nxt-force', 'FORCE', [700], 0,
      V, 700, [], 0).
shows(sensor_reading(magnet, P, V), P, 'ht-nxt-mag', 'MAG', [500], 0,
      V, 500, [], 512).
shows(sensor_reading(motion, P, V), P, 'ht-nxt-pir', 'PROX', [-7], 0,
      V, -7, [], 0).
shows(sensor_reading(flex, P, V), P, 'di-dflex', 'FLEX', [50], 0,
      V, 50, [], 0).
shows(sensor_reading(tof_dist_mm, P, V), P, 'ms-tof', 'DIST', [1234], 0,
      V, 1234, [wall(-100, 60.5, 100, 60.5)], 600).

row(Goal, Type) :-
    shows(Goal, in1, Type, _, _, _, _, _, _, _).

number_of(Row) :-
    aggregate_all(count, row(_, _), Count),
    between(1, Count, Row).

% With the sensor of row number Row in Tree, its goal makes V of what is there.
expect(Tree, Row, V, Expected) :-
    findall(r(Goal, Type, Mode, Raw, Decimals, V0, Plain, World, Simulated),
            shows(Goal, in1, Type, Mode, Raw, Decimals, V0, Plain, World,
                  Simulated),
            Rows),
    nth1(Row, Rows,
         r(Goal, Type, Mode, Raw, Decimals, V, Plain, World, Simulated)),
    (   Tree == plain
    ->  Expected = Plain
    ;   Expected = Simulated
    ),
    with_sensor(Tree, Type, World,
                ( show(Tree, Raw, Decimals),
                  once(Goal),
                  mode(in1, Mode0),
                  Mode0 == Mode )).

show(plain, Raw, Decimals) :-
    !,
    lego_sensor(in1, _, Path),
    forall(nth0(Index, Raw, Number),
           ( atomic_list_concat([Path, '/value', Index], File),
             write_file(File, Number) )),
    length(Raw, Count),
    atom_concat(Path, '/num_values', CountFile),
    write_file(CountFile, Count),
    atom_concat(Path, '/decimals', DecimalsFile),
    write_file(DecimalsFile, Decimals).
show(_, _, _).

write_file(File, Number) :-
    setup_call_cleanup(
        open(File, write, Stream),
        format(Stream, "~w~n", [Number]),
        close(Stream)).

same(X, Y) :-
    number(X),
    !,
    ( integer(X) -> X == Y ; float(Y), abs(X - Y) < 0.06 ).
same(X, Y) :-
    compound(X),
    !,
    X =.. [F|Xs],
    Y =.. [F|Ys],
    maplist(same, Xs, Ys).
same(X, X).

% The kernel cannot load di-dflex: its table of names lacks it.
loads(plain, _) :- !.
loads(_, Row) :-
    findall(Type, shows(_, _, Type, _, _, _, _, _, _, _), Types),
    nth1(Row, Types, Type),
    Type \== 'di-dflex'.

:- begin_tests(more_sensors).
test(each_shows_what_there_is,
     [ forall(( tree(Tree), number_of(Row), loads(Tree, Row) )),
       true(same(Expected, V)) ]) :-
    expect(Tree, Row, V, Expected).
test(each_fails_at_another_sensor_and_writes_nothing,
     [ forall(row(Goal, _)), true(W == []) ]) :-
    with_tree(plain, [in1-'lego-ev3-gyro'], ( \+ Goal, written(W) )).
test(each_fails_without_a_sensor, [forall(row(Goal, _)), fail]) :-
    with_tree(plain, [], Goal).
test(each_leaves_no_choice_at_a_port,
     [ forall(shows(Goal, in1, Type, _, Raw, Decimals, _, _, _, _)) ]) :-
    with_sensor(plain, Type, [],
                ( show(plain, Raw, Decimals),
                  call_cleanup(Goal, Det = true),
                  Det == true )).
test(each_finds_its_port,
     [ forall(shows(Goal, P, Type, _, Raw, Decimals, _, _, _, _)),
       true(Ports == [Port]) ]) :-
    (   sensor_bus(Type, Address)
    ->  atomic_list_concat([in1, Address], ':', Port)
    ;   Port = in1
    ),
    with_tree(plain, [Port-Type, in4-'lego-ev3-gyro'],
              ( show(plain, Raw, Decimals), findall(P, Goal, Ports) )).

test(several_kinds_of_thermometer_in_the_order_of_ports,
     all(P-V == [in1-21.5, 'in2:i2c1'-0.0, in4-0.0])) :-
    with_tree(plain, [ in4-'ms-ir-thermometer', in3-'lego-ev3-us',
                       in1-'lego-nxt-temp', 'in2:i2c1'-'ht-nxt-barometric' ],
              temperature(P, V)).
test(a_bound_value_selects, all(P == ['in2:i2c1'])) :-
    with_tree(plain, [in1-'ht-nxt-compass', 'in2:i2c1'-'ht-nxt-compass'],
              ( put_attribute('in2:i2c1', value0, 90),
                compass(P, 90) )).
test(a_wrong_range_of_the_proximity_detector,
     [ forall(member(Range-Error, [ _-instantiation_error,
                                    far-domain_error(eopd_range, far),
                                    1-type_error(atom, 1) ])),
       error(Error, _) ]) :-
    with_tree(plain, [in1-'ht-nxt-eopd'], ht_eopd(in1, Range, _)).
test(a_port_is_no_number, [forall(row_at(7, Goal)), error(type_error(_, 7), _)]) :-
    with_tree(plain, Goal).

row_at(Port, Goal) :-
    shows(Goal, Port, _, _, _, _, _, _, _, _).

test(an_nxt_touch_sensor_is_one, [forall(tree(Tree)), true(P-Q == in1-Expected)]) :-
    with_sensor(Tree, 'lego-nxt-touch', [], touch_sensor(P)),
    with_sensor(Tree, 'lego-nxt-us', [],
                ( ultrasonic_sensor(Q), ultrasonic_sensor(in1),
                  \+ ultrasonic_sensor(in2), \+ touch_sensor(in1) )),
    Expected = 'in1:i2c1'.
:- end_tests(more_sensors).

:- begin_tests(moving_sensors).
test(a_compass_turns_with_the_robot, [forall(behaving(Tree))]) :-
    with_sensor(Tree, 'ht-nxt-compass', [],
                ( compass(in1, 0),
                  set_robot(5.6, 10.6, outB, outC),
                  turn(30, 90),
                  settle(Tree),
                  compass(in1, Heading) )),
    near(Heading, 90, 4).
test(an_angle_sensor_is_on_the_axle_and_can_be_reset, [forall(behaving(Tree))]) :-
    with_sensor(Tree, 'ht-nxt-angle', [],
                ( set_robot(5.6, 10.6, outB, outC),
                  go_cm(40, 10),
                  settle(Tree),
                  angle_total('ev3-ports:in1', Turned),
                  position(outB, Counts),
                  sensor_command(in1, 'RESET'),
                  settle(Tree),
                  angle_total(in1, Zero) )),
    near(Turned, Counts, 4),
    Zero == 0.
:- end_tests(moving_sensors).

:- begin_tests(sensor_values).
% Modes whose raw data are read at once, and some that are not.
several('lego-ev3-color', 'RGB-RAW').
several('lego-ev3-color', 'REF-RAW').
several('lego-ev3-gyro', 'GYRO-G&A').
several('lego-ev3-ir', 'IR-SEEK').
several('lego-ev3-ir', 'IR-REMOTE').
several('lego-power-storage', 'ALL').
several('ht-nxt-accel', 'ALL').
several('ht-nxt-color', 'RAW').
several('ht-nxt-color', 'ALL').
several('ht-nxt-color-v2', 'NORM').
several('ht-nxt-color-v2', 'RAW').
several('ht-nxt-ir-seek-v2', 'DC-ALL').
several('ms-absolute-imu', 'MAG').
several('ms-absolute-imu', 'ACCEL').
several('ms-absolute-imu', 'GYRO').
several('ms-absolute-imu', 'ALL').
several('ms-light-array', 'RAW').
several('ms-line-leader', 'PID-ALL').
several('ms-nxtcam', 'TRACK').
several('lego-nxt-temp', 'NXT-TEMP-C').

test(are_those_of_the_files,
     [ forall(( behaving(Tree), several(Type, Mode) )),
       true(Once-Again == Files-Files) ]) :-
    World = [ beacon(20, 60, 1), beacon(-50, 60, 4), floor('#c08040'),
              line(black, 2, [1- -10, 1-10]) ],
    with_sensor(Tree, Type, World,
                ( sensor_values(in1, Mode, Once),
                  sensor_values(in1, Mode, Again),
                  length(Again, Count),
                  Last is Count - 1,
                  findall(V,
                          ( between(0, Last, I), sensor_value(in1, Mode, I, V) ),
                          Files) )).
test(come_from_the_raw_data_the_second_time,
     true(Read == ['bin_data'])) :-
    with_sensor(simulator, 'ht-nxt-accel', [],
                ( sensor_values(in1, 'ALL', Values),
                  sensor_values(in1, 'ALL', Values),
                  sim_trace(Before),
                  sensor_values(in1, 'ALL', Values),
                  sim_trace(After) )),
    append(Before, New, After),
    findall(Name,
            ( member(_-read(File, _), New), file_base_name(File, Name) ),
            Read).
test(are_as_many_as_the_mode_has, true(Values == [1, 2, 3, 0, 0])) :-
    with_tree(plain, [in1-'ht-super-pro'],
              ( forall(nth0(I, [1, 2, 3], V),
                       ( atom_concat(value, I, A), put_attribute(in1, A, V) )),
                put_attribute(in1, num_values, 5),
                sensor_values(in1, 'AOUT-0', Values) )).
test(of_each_sensor_with_the_mode, all(P == [in2, in3])) :-
    with_tree(plain, sensor_values(P, 'COL-COLOR', _)).
test(of_an_absent_sensor_fail, [fail]) :-
    with_tree(plain, sensor_values(in9, 'COL-COLOR', _)).
test(of_no_mode_at_all_fail, [fail]) :-
    with_tree(plain, sensor_values(_, 'NO-MODE', _)).
test(of_a_mode_that_the_sensor_lacks,
     [forall(behaving(Tree)), error(domain_error(mode, 'TASTE'), _)]) :-
    with_sensor(Tree, 'ht-nxt-accel', [], sensor_values(in1, 'TASTE', _)).
test(a_wrong_argument_throws,
     [ forall(member(Port-Mode-Error, [ in1-_-instantiation_error,
                                        in1-7-type_error(_, 7),
                                        7-'COL-COLOR'-type_error(_, 7) ])),
       error(Error, _) ]) :-
    with_tree(plain, sensor_values(Port, Mode, _)).
:- end_tests(sensor_values).
