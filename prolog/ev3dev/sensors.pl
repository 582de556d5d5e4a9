:- module(ev3dev_sensors,
          [ light_sensor/1,             % ?Port
            ultrasonic_sensor/1,        % ?Port
            gyro_sensor/1,              % ?Port
            touch_sensor/1,             % ?Port
            infrared_sensor/1,          % ?Port
            col_ambient/2,              % ?Port, -Percent
            col_reflect/2,              % ?Port, -Percent
            col_color/2,                % ?Port, -Color
            col_rgb_raw/2,              % ?Port, -RGB
            col_rgb_raw/4,              % ?Port, -Red, -Green, -Blue
            us_dist_cm/2,               % ?Port, -Centimeters
            us_dist_inches/2,           % ?Port, -Inches
            us_listen/2,                % ?Port, -Heard
            gyro_ang/2,                 % ?Port, -Degrees
            gyro_rate/2,                % ?Port, -DegreesPerSecond
            gyro_ang_rate/3,            % ?Port, -Degrees, -DegreesPerSecond
            gyro_reset/1,               % +Port
            touch/2,                    % ?Port, -Pressed
            ir_prox/2,                  % ?Port, -Percent
            sensor_reading/3,           % +Reading, ?Port, -Value
            sensor_value/4,             % ?Port, +Mode, +Index, -Value
            sensor_values/3,            % ?Port, +Mode, -Values
            adjust_val/3,               % +Port, +Raw, -Value
            reading_of/4                % ?Reading, ?Types, ?Mode, ?Index
          ]).
:- set_prolog_flag(generate_debug_info, false).
:- use_module(private/errors/public_clauses, [term_expansion/4]).
:- use_module(private/explain/hints).
:- use_module(driver, [lego_sensor/2]).
:- use_module(private/devices/sensor_type, [sensor_of/3]).
:- use_module(private/native/native,
              [ sensor_known_/3, sensor_restart_/3, sensor_scale_/3,
                sensor_value_/5, sensor_value_or_why_/5, sensor_values_/5 ]).

/** <module> Sensors

Each reading of a sensor, for example `us_dist_cm`, stands for a mode of the
sensor and a value in that mode. Values are scaled: integers if the mode has
no decimals, else floats.

All predicates here fail if there is no such sensor. An unbound port is the
first port that has one; on backtracking, the next:

```
?- us_dist_cm(Port, Distance).
Port = in1,
Distance = 84.3.
```

Changing the mode of a sensor takes time: 10 ms, for a sensor on the I2C bus
50 ms, for the infrared sensor 1.1 s. So a predicate changes the mode only if
the sensor is in another mode. If a sensor has lost contact, a call waits up
to 2 s for it and then throws existence_error(sensor, Port).

Most sensors of other makers are on the I2C bus. The address of such a sensor
is that of the port and its own, `in1:i2c1`; a program may name it `in1`. The
kernel reads it ten times a second.

This library has the EV3's own sensors and those of the NXT that measure the
same. Others are in library(ev3dev/infrared) and library(ev3dev/nxt_sensors).
library(ev3dev/sensor_info) has a table of all sensors and their modes.

## Adding a sensor {#adding-a-sensor}

The readings are a table of facts. A program adds one with a fact of its own:

```
:- multifile ev3dev_sensors:reading/4.

ev3dev_sensors:reading(weight, ['my-scale'], 'WEIGHT', 0).

?- sensor_reading(weight, in2, Grams).
```
*/

:- multifile reading/4.

%!  reading_of(?Reading, ?Types, ?Mode, ?Index) is nondet.
%
%   True if the sensors of Types show Reading as value Index of Mode.
%   Libraries that add readings use it.

reading_of(Reading, Types, Mode, Index) :-
    (   \+ reading(Reading, _, _, _)
    ->  known(Reading, Types, Mode, Index)
    ;   known(Reading, Types, Mode, Index)
    ;   reading(Reading, Types, Mode, Index)
    ).

%!  reading(?Reading, ?Types, ?Mode, ?Index) is nondet.
%
%   The same, of the readings that a program has added.

%!  known(?Reading, ?Types, ?Mode, ?Index) is nondet.
%
%   The same, of the readings that this library knows.

known(col_ambient,        ['lego-ev3-color'], 'COL-AMBIENT', 0).
known(col_reflect,        ['lego-ev3-color'], 'COL-REFLECT', 0).
known(col_color,          ['lego-ev3-color'], 'COL-COLOR', 0).
known(us_dist_cm,         ['lego-ev3-us', 'lego-nxt-us'], 'US-DIST-CM', 0).
known(us_dist_inches,     ['lego-ev3-us', 'lego-nxt-us'], 'US-DIST-IN', 0).
known(us_listen,          ['lego-ev3-us', 'lego-nxt-us'], 'US-LISTEN', 0).
known(gyro_ang,           ['lego-ev3-gyro'], 'GYRO-ANG', 0).
known(gyro_rate,          ['lego-ev3-gyro'], 'GYRO-G&A', 1).
known(touch,              ['lego-ev3-touch', 'lego-nxt-touch'], 'TOUCH', 0).
known(ir_prox,            ['lego-ev3-ir'], 'IR-PROX', 0).
known(nxt_light,          ['lego-nxt-light'], 'REFLECT', 0).
known(nxt_ambient,        ['lego-nxt-light'], 'AMBIENT', 0).
known(temperature,        ['lego-nxt-temp'], 'NXT-TEMP-C', 0).
known(temperature,        ['ht-nxt-barometric'], 'TEMP', 0).
known(temperature,        ['ms-ir-thermometer'], 'AMBIENT-C', 0).
known(target_temperature, ['ms-ir-thermometer'], 'TARGET-C', 0).
known(compass,            ['ht-nxt-compass', 'ms-absolute-imu'],
      'COMPASS', 0).
known(ht_color,           ['ht-nxt-color', 'ht-nxt-color-v2'], 'COLOR', 0).
known(ht_gyro_rate,       ['ht-nxt-gyro'], 'GYRO', 0).
known(angle_deg,          ['ht-nxt-angle'], 'ANGLE', 0).
known(angle_total,        ['ht-nxt-angle'], 'ANGLE-ACC', 0).
known(angle_total,        ['ms-angle'], 'ANGLE2', 0).
known(angle_rpm,          ['ht-nxt-angle', 'ms-angle'], 'SPEED', 0).
known(force,              ['ht-nxt-force'], 'FORCE', 0).
known(magnet,             ['ht-nxt-mag'], 'MAG', 0).
known(motion,             ['ht-nxt-pir'], 'PROX', 0).
known(flex,               ['di-dflex'], 'FLEX', 0).
known(tof_dist_mm,        ['ms-tof'], 'DIST', 0).
known(analog_voltage,     ['nxt-analog'], 'ANALOG-0', 0).
known(analog_voltage,
      [ 'ev3-analog-01', 'ev3-analog-03', 'ev3-analog-04', 'ev3-analog-05',
        'ev3-analog-06', 'ev3-analog-07', 'ev3-analog-08', 'ev3-analog-09',
        'ev3-analog-10', 'ev3-analog-11', 'ev3-analog-12', 'ev3-analog-13',
        'ev3-analog-14' ], 'ANALOG', 0).

% The native code asks for rows: its query would be shown in the tracer.
:- '$hide'(known/4).

%!  sensor_reading(+Reading, ?Port, -Value) is nondet.
%
%   True if the sensor at Port shows Value for a Reading of the table. Fails
%   if the table has no such reading. Some readings have no predicate of their
%   own: `force` and `magnet`, both from 0 to 1023, `motion` from -100 to 100,
%   `flex` from 0 to 100, and `tof_dist_mm`. `analog_voltage` has one in
%   library(ev3dev/raw).

sensor_reading(Reading, Port, Value) :-
    (   var(Port)
    ->  (   reading_of(Reading, Types, Mode, Index),
            sensor_value_(Port, Types, Mode, Index, Read)
        *-> Value = Read
        ;   no_sensor_for(Reading, Port)
        )
    ;   (   known(Reading, Types, Mode, Index)
        ;   reading(Reading, Types, Mode, Index)
        ),
        sensor_value_(Port, Types, Mode, Index, Read)
    ->  Value = Read
    ;   no_sensor_for(Reading, Port)
    ).

no_sensor_for(Reading, Port) :-
    (   reading_of(Reading, _, _, _)
    ->  fail_because(absent(reading(Reading), Port))
    ;   fail_because(no_reading(Reading))
    ).

:- multifile ev3dev_hints:reading_types/2.

ev3dev_hints:reading_types(Reading, Types) :-
    reading_of(Reading, Types, _, _).

%   A lookup takes as long as reading a file does. So the clause of a reading
%   that is known here names its row, which the native code keeps. It asks
%   first whether what the last calls have found answers this one, too. The
%   table is asked if there is no such sensor at the port, or if a program has
%   added rows.

goal_expansion(sensor_reading(Reading, Port, Value), Goal) :-
    atom(Reading),
    findall(Mode, known(Reading, _, Mode, _), [_]),
    Goal = (   sensor_known_(Reading, Port, Value)
           ->  true
           ;   nonvar(Port)
           ->  (   sensor_value_(Port, Reading, row, row, Read)
               ->  (   Value = Read
                   ->  true
                   ;   other_value(Reading, Value)
                   )
               ;   table_reading(Reading, Port, Value)
               )
           ;   reading(Reading, _, _, _)
           ->  table_reading(Reading, Port, Value)
           ;   nonvar(Value),
               \+ number(Value)
           ->  other_value(Reading, Value)
           ;   sensor_value_or_why_(Port, Reading, row, row, Value)
           ).

%   A sensor has another value, which is no news; or the program compares it
%   with what is not a number.

other_value(Reading, Value) :-
    \+ number(Value),
    fail_because(no_number(Reading, Value)).

table_reading(Reading, Port, Value) :-
    sensor_reading(Reading, Port, Value).

%!  light_sensor(?Port) is nondet.
%!  ultrasonic_sensor(?Port) is nondet.
%!  gyro_sensor(?Port) is nondet.
%!  touch_sensor(?Port) is nondet.
%!  infrared_sensor(?Port) is nondet.
%
%   True if a sensor of this kind is plugged into Port. All find sensors of
%   the EV3; ultrasonic_sensor/1 and touch_sensor/1 find those of the NXT too.

light_sensor(Port) :-
    lego_sensor(Port, 'lego-ev3-color').

ultrasonic_sensor(Port) :-
    sensor_of(Port, ['lego-ev3-us', 'lego-nxt-us'], _).

gyro_sensor(Port) :-
    lego_sensor(Port, 'lego-ev3-gyro').

touch_sensor(Port) :-
    sensor_of(Port, ['lego-ev3-touch', 'lego-nxt-touch'], _).

infrared_sensor(Port) :-
    lego_sensor(Port, 'lego-ev3-ir').

%!  col_ambient(?Port, -Percent) is nondet.
%!  col_reflect(?Port, -Percent) is nondet.
%
%   True if the color sensor measures Percent, from 0 to 100: col_ambient/2
%   the light around it, col_reflect/2 the reflected light of its red lamp.

col_ambient(Port, Percent) :-
    sensor_reading(col_ambient, Port, Percent).

col_reflect(Port, Percent) :-
    sensor_reading(col_reflect, Port, Percent).

%!  col_color(?Port, -Color) is nondet.
%
%   True if the color sensor sees Color: 0 none, 1 black, 2 blue, 3 green,
%   4 yellow, 5 red, 6 white, 7 brown.

col_color(Port, Color) :-
    sensor_reading(col_color, Port, Color).

%!  col_rgb_raw(?Port, -RGB) is nondet.
%!  col_rgb_raw(?Port, -Red, -Green, -Blue) is nondet.
%
%   True if the color sensor measures Red, Green and Blue, each from 0 to 1023
%   and not calibrated. RGB is the term `rgb(Red, Green, Blue)`; a list
%   `[Red, Green, Blue]` in its place is unified, too.

col_rgb_raw(Port, RGB) :-
    (   nonvar(RGB),
        RGB = [Red, Green, Blue]
    ->  true
    ;   RGB = rgb(Red, Green, Blue)
    ),
    col_rgb_raw(Port, Red, Green, Blue).

col_rgb_raw(Port, Red, Green, Blue) :-
    sensor_values_(Port, ['lego-ev3-color'], 'RGB-RAW', 3,
                   [Red, Green, Blue]).

%!  us_dist_cm(?Port, -Centimeters) is nondet.
%!  us_dist_inches(?Port, -Inches) is nondet.
%
%   True if the ultrasonic sensor measures this distance: the EV3's sensor to
%   a tenth of a centimeter, the NXT's to a whole one. If it sees nothing, it
%   reports 255 cm, or 100.3 inches (NXT: 100.0).

us_dist_cm(Port, Centimeters) :-
    sensor_reading(us_dist_cm, Port, Centimeters).

us_dist_inches(Port, Inches) :-
    sensor_reading(us_dist_inches, Port, Inches).

%!  us_listen(?Port, -Heard) is nondet.
%
%   True if Heard is 1 while the ultrasonic sensor hears another one, else 0.

us_listen(Port, Heard) :-
    sensor_reading(us_listen, Port, Heard).

%!  gyro_ang(?Port, -Degrees) is nondet.
%
%   True if the gyro has turned by Degrees since its last reset, clockwise
%   positive.

gyro_ang(Port, Degrees) :-
    sensor_reading(gyro_ang, Port, Degrees).

%!  gyro_rate(?Port, -DegreesPerSecond) is nondet.
%
%   True if the gyro turns at DegreesPerSecond, up to 440, clockwise positive.
%   The first call puts the gyro into its mode for angle and rate, where it
%   stays: gyro_ang/2 and moves read the angle there, too, and the angle goes
%   on from where it was. In this mode the oldest gyros ignore gyro_reset/1,
%   which then throws.

gyro_rate(Port, DegreesPerSecond) :-
    sensor_reading(gyro_rate, Port, DegreesPerSecond).

%!  gyro_ang_rate(?Port, -Degrees, -DegreesPerSecond) is nondet.
%
%   True if the gyro has turned by Degrees and turns at DegreesPerSecond, both
%   of the same moment: gyro_ang/2 and gyro_rate/2 in one reading.

gyro_ang_rate(Port, Degrees, DegreesPerSecond) :-
    sensor_values_(Port, ['lego-ev3-gyro'], 'GYRO-G&A', 2,
                   [Degrees, DegreesPerSecond]).

%!  gyro_reset(+Port) is semidet.
%
%   Make the gyro's present angle 0. Takes 10 ms.

gyro_reset(Port) :-
    sensor_restart_(Port, ['lego-ev3-gyro'], 'GYRO-ANG').

%!  touch(?Port, -Pressed) is nondet.
%
%   True if Pressed is 1 while the touch sensor is pressed, else 0. The brick
%   does not recognize every touch sensor of the NXT: port_device/2 names it.

touch(Port, Pressed) :-
    sensor_reading(touch, Port, Pressed).

%!  ir_prox(?Port, -Percent) is nondet.
%
%   True if the infrared sensor sees something at the proximity Percent: 0 is
%   near, 100 about 70 cm or more.

ir_prox(Port, Percent) :-
    sensor_reading(ir_prox, Port, Percent).

%!  sensor_value(?Port, +Mode, +Index, -Value) is nondet.
%
%   True if value number Index, from 0 to 7, of the sensor at Port is Value in
%   Mode. Reads any sensor in any of its modes. An unbound Port enumerates the
%   ports that have a sensor with Mode.
%
%   @error domain_error(mode, Mode) if the sensor at Port has no such mode
%   @error domain_error(sensor_value_index, Index) if Mode has no such value

sensor_value(Port, Mode, Index, Value) :-
    sensor_value_or_why_(Port, [], Mode, Index, Value).

%!  sensor_values(?Port, +Mode, -Values) is nondet.
%
%   True if Values is the list of all values, at most eight, that the sensor
%   at Port shows in Mode. Reads any sensor in any of its modes, and all
%   values at once if the sensor allows it. An unbound Port enumerates the
%   ports that have a sensor with Mode.
%
%   @error domain_error(mode, Mode) if the sensor at Port has no such mode

sensor_values(Port, Mode, Values) :-
    sensor_values_(Port, [], Mode, 0, Values).

%!  adjust_val(+Port, +Raw, -Value) is semidet.
%
%   True if Value is the integer Raw, as value/3 reads it, scaled by the
%   decimals of the sensor's present mode.

adjust_val(Port, Raw, Value) :-
    sensor_scale_(Port, Raw, Value).
