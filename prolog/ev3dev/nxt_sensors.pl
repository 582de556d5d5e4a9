:- module(ev3dev_nxt_sensors,
          [ nxt_light/2,                % ?Port, -Percent
            nxt_ambient/2,              % ?Port, -Percent
            nxt_sound/2,                % ?Port, -Percent
            temperature/2,              % ?Port, -Celsius
            target_temperature/2,       % ?Port, -Celsius
            pressure/2,                 % ?Port, -Hectopascal
            compass/2,                  % ?Port, -Degrees
            ht_color/2,                 % ?Port, -Number
            ht_color_rgb/2,             % ?Port, -RGB
            ht_gyro_rate/2,             % ?Port, -DegreesPerSecond
            ht_eopd/3,                  % ?Port, +Range, -Percent
            acceleration/4,             % ?Port, -X, -Y, -Z
            rotation_rate/4,            % ?Port, -X, -Y, -Z
            tilt/4,                     % ?Port, -X, -Y, -Z
            magnetic_field/4,           % ?Port, -X, -Y, -Z
            angle_deg/2,                % ?Port, -Degrees
            angle_total/2,              % ?Port, -Degrees
            angle_rpm/2,                % ?Port, -RevolutionsPerMinute
            light_row/2,                % ?Port, -Percents
            line_leader/3,              % ?Port, -Steering, -Seen
            energy_meter/4              % ?Port, -In, -Out, -Joules
          ]).
:- set_prolog_flag(generate_debug_info, false).
:- use_module(private/errors/errors, [domain_error/2]).
:- use_module(private/errors/public_clauses, [term_expansion/4]).
:- use_module(private/checks/arguments, [word/2]).
:- use_module(sensors, [reading_of/4, sensor_reading/3]).
:- use_module(private/devices/sensor_type, [sensor_to_read/3]).
:- use_module(private/native/native, [sensor_values_/5]).
:- use_module(private/basics/small_lists).

/** <module> Sensors of the NXT and of other makers

LEGO's sensors for the NXT, and those of HiTechnic (`ht_`), mindsensors and
others. If several sensors measure the same, one predicate reads them all:
temperature/2 reads LEGO's thermometer, HiTechnic's barometer and mindsensors'
infrared thermometer. The name of an argument or the comment gives the unit.

All predicates here fail if there is no such sensor. An unbound port is the
first port that has one; on backtracking, the next.

The brick does not recognize a sensor that is only a voltage, for example
those of nxt_sound/2, ht_gyro_rate/2 and ht_eopd/3: name it by port_device/2.
*/

% Reads a sensor by its port if several rows of the table have the Reading.
measured(Reading, Port, Value) :-
    nonvar(Port),
    !,
    sensor_reading(Reading, Port, Value).
measured(Reading, Port, Value) :-
    findall(Type,
            ( reading_of(Reading, Types, _, _),
              one_of(Types, Type)
            ),
            All),
    sensor_to_read(Port, All, _),
    sensor_reading(Reading, Port, Value).

%   forced(Kind, Value): PLNXT has these predicates, too, with the arguments
%   (Value, force). library(ev3dev/plnxt) adds a clause.
:- multifile forced/2.

% Reads as many values as the list Values has elements.
values(Port, Types, Mode, Values) :-
    length(Values, Count),
    sensor_values_(Port, Types, Mode, Count, Values).

%!  nxt_light(?Port, -Percent) is nondet.
%!  nxt_ambient(?Port, -Percent) is nondet.
%
%   True if the NXT's light sensor measures Percent. nxt_light/2 measures the
%   reflected light of its own red lamp, nxt_ambient/2 the light around it,
%   with the lamp off. Percent is from 0 to 100, and a little beyond where it
%   is very dark or very bright.

nxt_light(Port, Percent) :-
    (   Percent == force
    ->  forced(light, Port)
    ;   sensor_reading(nxt_light, Port, Percent)
    ).

nxt_ambient(Port, Percent) :-
    sensor_reading(nxt_ambient, Port, Percent).

%!  nxt_sound(?Port, -Percent) is nondet.
%
%   True if the NXT's sound sensor measures the loudness Percent: 0 is
%   silence, 100 the loudest sound that it can measure. ev3dev shows the
%   microphone's voltage, which is high in silence; Percent is 100 minus that.

nxt_sound(Port, Percent) :-
    (   Percent == force
    ->  forced(sound, Port)
    ;   sound(Port, Percent)
    ).

sound(Port, Percent) :-
    values(Port, ['lego-nxt-sound'], 'DB', [Voltage]),
    Percent is 100 - Voltage.

%!  temperature(?Port, -Celsius) is nondet.
%!  target_temperature(?Port, -Celsius) is nondet.
%
%   True if the sensor measures the temperature Celsius, in degrees Celsius.
%   target_temperature/2 reads the temperature of the thing at which the
%   infrared thermometer of mindsensors points.

temperature(Port, Celsius) :-
    measured(temperature, Port, Celsius).

target_temperature(Port, Celsius) :-
    sensor_reading(target_temperature, Port, Celsius).

%!  pressure(?Port, -Hectopascal) is nondet.
%
%   True if Hectopascal is the pressure of the air at HiTechnic's barometer,
%   or in the tube of mindsensors' pneumatic sensor. A hectopascal is a
%   millibar.

pressure(Port, Hectopascal) :-
    sensor_to_read(Port, ['ht-nxt-barometric', 'ms-pps58-nx'],
                             Type),
    pressure_of(Type, Port, Pressure),
    Hectopascal = Pressure.

% An inch of mercury is 33.8639 hPa.
pressure_of('ht-nxt-barometric', Port, Pressure) :-
    values(Port, ['ht-nxt-barometric'], 'PRESS', [Inches]),
    Pressure is Inches * 33.8639.
pressure_of('ms-pps58-nx', Port, Pressure) :-
    values(Port, ['ms-pps58-nx'], 'ABS-MBAR', [Pressure]).

%!  compass(?Port, -Degrees) is nondet.
%
%   True if the compass points in the direction Degrees: from north,
%   clockwise, 0 to 359.

compass(Port, Degrees) :-
    sensor_reading(compass, Port, Degrees).

%!  ht_color(?Port, -Number) is nondet.
%!  ht_color_rgb(?Port, -RGB) is nondet.
%
%   True if HiTechnic's color sensor, of version 1 or 2, sees a color.
%   Number is 0 black, 1 violet, 2 purple, 3 blue, 4 green, 5 lime, 6 yellow,
%   7 orange, 8 red, 9 crimson, 10 magenta, 11 to 16 pale colors, 17 white.
%   RGB is the term `rgb(Red, Green, Blue)`, each from 0 to 255.

ht_color(Port, Number) :-
    sensor_reading(ht_color, Port, Number).

ht_color_rgb(Port, RGB) :-
    sensor_to_read(Port, ['ht-nxt-color', 'ht-nxt-color-v2'], Type),
    rgb_of(Type, Port, Seen),
    RGB = Seen.

rgb_of('ht-nxt-color', Port, rgb(Red, Green, Blue)) :-
    values(Port, ['ht-nxt-color'], 'ALL', [_, Red, Green, Blue]).
rgb_of('ht-nxt-color-v2', Port, rgb(Red, Green, Blue)) :-
    values(Port, ['ht-nxt-color-v2'], 'RGB', [Red, Green, Blue]).

%!  ht_gyro_rate(?Port, -DegreesPerSecond) is nondet.
%
%   True if HiTechnic's gyro turns at DegreesPerSecond. At rest it may show a
%   few degrees per second more or less than 0. This offset is constant.

ht_gyro_rate(Port, DegreesPerSecond) :-
    sensor_reading(ht_gyro_rate, Port, DegreesPerSecond).

%!  ht_eopd(?Port, +Range, -Percent) is nondet.
%
%   True if Percent, from 0 to 100, of the light of HiTechnic's optical
%   proximity detector comes back. Range is `long` or `short`. The distance is
%   a constant divided by Percent. The constant depends on the surface.
%
%   @error domain_error(eopd_range, Range)

ht_eopd(Port, Range0, Percent) :-
    word(Range0, Range),
    (   eopd_mode(Range, Mode)
    ->  true
    ;   domain_error(eopd_range, Range)
    ),
    values(Port, ['ht-nxt-eopd'], Mode, [Percent]).

eopd_mode(long,  'LONG').
eopd_mode(short, 'SHORT').

%!  acceleration(?Port, -X, -Y, -Z) is nondet.
%
%   True if the sensor measures the acceleration X, Y and Z along its three
%   axes, in g. A sensor that is level and at rest measures 1 g along z. Reads
%   the sensors of HiTechnic, mindsensors and Microinfinity.
%
%   @see http://www.hitechnic.com, sensor NAC1040, for its 200 counts per g

acceleration(Port, X, Y, Z) :-
    sensor_to_read(Port, [ 'ht-nxt-accel', 'ms-absolute-imu',
                                     'mi-xg1300l' ], Type),
    acceleration_of(Type, Port, Felt),
    Felt = [X, Y, Z].

acceleration_of('ht-nxt-accel', Port, [X, Y, Z]) :-
    values(Port, ['ht-nxt-accel'], 'ALL', [X1, Y1, Z1, X0, Y0, Z0]),
    ten_bits(X1, X0, X),
    ten_bits(Y1, Y0, Y),
    ten_bits(Z1, Z0, Z).
acceleration_of('ms-absolute-imu', Port, [X, Y, Z]) :-
    values(Port, ['ms-absolute-imu'], 'ACCEL', [X, Y, Z]).
acceleration_of('mi-xg1300l', Port, [X, Y, Z]) :-
    values(Port, ['mi-xg1300l'], 'ACCEL', [X, Y, Z]).

% The upper eight bits are signed. The lower two are the last bits of Lower.
ten_bits(Upper, Lower, G) :-
    (   Upper > 127
    ->  High = Upper - 256
    ;   High = Upper
    ),
    G is (High * 4 + (Lower /\ 3)) / 200.0.

%!  rotation_rate(?Port, -X, -Y, -Z) is nondet.
%!  tilt(?Port, -X, -Y, -Z) is nondet.
%!  magnetic_field(?Port, -X, -Y, -Z) is nondet.
%
%   True if mindsensors' AbsoluteIMU measures X, Y and Z about its three axes:
%   rates in degrees per second; tilts from -90 to 90 degrees; or the magnetic
%   field, in units of the sensor. At first rates go up to 250; `ACCEL-4G` and
%   further commands extend the range and make the values coarser.

rotation_rate(Port, X, Y, Z) :-
    values(Port, ['ms-absolute-imu'], 'GYRO', [X, Y, Z]).

tilt(Port, X, Y, Z) :-
    values(Port, ['ms-absolute-imu'], 'TILT', [X, Y, Z]).

magnetic_field(Port, X, Y, Z) :-
    values(Port, ['ms-absolute-imu'], 'MAG', [X, Y, Z]).

%!  angle_deg(?Port, -Degrees) is nondet.
%!  angle_total(?Port, -Degrees) is nondet.
%!  angle_rpm(?Port, -RevolutionsPerMinute) is nondet.
%
%   True if an axle stands at the angle Degrees, 0 to 359 (HiTechnic only);
%   has turned by Degrees in all since the last `RESET`, see sensor_command/2;
%   or turns at RevolutionsPerMinute. Reads HiTechnic's angle sensor and
%   mindsensors' GlideWheel, which measures half degrees.

angle_deg(Port, Degrees) :-
    sensor_reading(angle_deg, Port, Degrees).

angle_total(Port, Degrees) :-
    measured(angle_total, Port, Degrees).

angle_rpm(Port, RevolutionsPerMinute) :-
    sensor_reading(angle_rpm, Port, RevolutionsPerMinute).

%!  light_row(?Port, -Percents) is nondet.
%
%   True if Percents is the list of the light that the eight light sensors of
%   mindsensors' LightSensorArray or LineLeader measure, from left to right,
%   each from 0 to 100. Calibrate the sensor first on white and on black, by
%   the commands `CAL-WHITE` and `CAL-BLACK`.

light_row(Port, Percents) :-
    sensor_values_(Port, ['ms-light-array', 'ms-line-leader'],
                                  'CAL', 8, Percents).

%!  line_leader(?Port, -Steering, -Seen) is nondet.
%
%   True if mindsensors' LineLeader computes Steering, from -100 to 100. A
%   robot follows the line if it adds Steering to the speed of the left motor
%   and subtracts it from the speed of the right motor. Seen is the list of
%   the sensors that see the line, from 1 on the left to 8 on the right.

line_leader(Port, Steering, Seen) :-
    values(Port, ['ms-line-leader'], 'PID-ALL', [Steering0, _, Bits]),
    findall(Sensor,
            ( between(1, 8, Sensor),
              Bits /\ (1 << (Sensor - 1)) =\= 0
            ),
            Sensors),
    Steering = Steering0,
    Seen = Sensors.

%!  energy_meter(?Port, -In, -Out, -Joules) is nondet.
%
%   True if LEGO's energy meter measures the power In and Out, two terms
%   `power(Volts, Amperes, Watts)`, and the stored energy Joules.

energy_meter(Port, power(InV, InA, InW), power(OutV, OutA, OutW), Joules) :-
    values(Port, ['lego-power-storage'], 'ALL',
           [InV, InA, OutV, OutA, Stored, InW, OutW]),
    % The kernel gives all seven values three decimals; joules have none.
    Joules is round(Stored * 1000).
