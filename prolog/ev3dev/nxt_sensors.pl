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
:- use_module(private/errors, [domain_error/2, must_be/2, term_expansion/2]).
:- use_module(sensors, [reading_types/2, sensor_reading/3]).
:- use_module(private/sensor_type, [sensor_of/3]).
:- use_module(private/native, [sensor_values_/5]).
:- use_module(private/one_of).

/** <module> Sensors of the NXT and of other makers

LEGO's sensors for the NXT, and those of HiTechnic (`ht_`), mindsensors and
others. What several of them measure has one predicate: temperature/2 takes
the thermometer of LEGO, HiTechnic's barometer and mindsensors' infrared
thermometer. Numbers come in the units that their names or descriptions tell.

All predicates here fail if there is no such sensor. An unbound port is the
first port that has one; on backtracking, the next.

What is only a voltage, as nxt_sound/2, ht_gyro_rate/2 and ht_eopd/3, the
brick does not recognise: the port has to be told what it has.
*/

% A sensor for which several rows of the table count, by its port.
measured(Reading, Port, Value) :-
    nonvar(Port),
    !,
    sensor_reading(Reading, Port, Value).
measured(Reading, Port, Value) :-
    findall(Type,
            ( reading_types(Reading, Types),
              one_of(Types, Type)
            ),
            All),
    sensor_of(Port, All, _),
    sensor_reading(Reading, Port, Value).

% So many values of a sensor of one of these types.
values(Port, Types, Mode, Values) :-
    length(Values, Count),
    sensor_values_(Port, Types, Mode, Count, Values).

%!  nxt_light(?Port, -Percent) is nondet.
%!  nxt_ambient(?Port, -Percent) is nondet.
%
%   True if the NXT's light sensor sees that much light: nxt_light/2 that of
%   its own red lamp that comes back, nxt_ambient/2 that around it, with its
%   lamp off. From 0 to 100, and a little beyond where it is very dark or very
%   bright.

nxt_light(Port, Percent) :-
    sensor_reading(nxt_light, Port, Percent).

nxt_ambient(Port, Percent) :-
    sensor_reading(nxt_ambient, Port, Percent).

%!  nxt_sound(?Port, -Percent) is nondet.
%
%   True if the NXT's sound sensor hears it that loud: 0 is silence, 100 as
%   loud as it can tell. The microphone's voltage is high in silence, and
%   ev3dev shows the voltage; here it is turned round.

nxt_sound(Port, Percent) :-
    values(Port, ['lego-nxt-sound'], 'DB', [Voltage]),
    Percent is 100 - Voltage.

%!  temperature(?Port, -Celsius) is nondet.
%!  target_temperature(?Port, -Celsius) is nondet.
%
%   True if it is that warm at the sensor, in degrees Celsius; or, for
%   target_temperature/2, where the infrared thermometer of mindsensors looks.

temperature(Port, Celsius) :-
    measured(temperature, Port, Celsius).

target_temperature(Port, Celsius) :-
    sensor_reading(target_temperature, Port, Celsius).

%!  pressure(?Port, -Hectopascal) is nondet.
%
%   True if that is the pressure of the air at HiTechnic's barometer, or in
%   the tube of mindsensors' pneumatic sensor. A hectopascal is a millibar.

pressure(Port, Hectopascal) :-
    sensor_of(Port, ['ht-nxt-barometric', 'ms-pps58-nx'],
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
%   True if the compass looks in that direction: degrees from north,
%   clockwise, 0 to 359.

compass(Port, Degrees) :-
    sensor_reading(compass, Port, Degrees).

%!  ht_color(?Port, -Number) is nondet.
%!  ht_color_rgb(?Port, -RGB) is nondet.
%
%   True if HiTechnic's colour sensor, of version 1 or 2, sees a colour.
%   Number is 0 black, 1 violet, 2 purple, 3 blue, 4 green, 5 lime, 6 yellow,
%   7 orange, 8 red, 9 crimson, 10 magenta, 11 to 16 pale colours, 17 white.
%   RGB is the term `rgb(Red, Green, Blue)`, each from 0 to 255.

ht_color(Port, Number) :-
    sensor_reading(ht_color, Port, Number).

ht_color_rgb(Port, RGB) :-
    sensor_of(Port, ['ht-nxt-color', 'ht-nxt-color-v2'], Type),
    rgb_of(Type, Port, Seen),
    RGB = Seen.

rgb_of('ht-nxt-color', Port, rgb(Red, Green, Blue)) :-
    values(Port, ['ht-nxt-color'], 'ALL', [_, Red, Green, Blue]).
rgb_of('ht-nxt-color-v2', Port, rgb(Red, Green, Blue)) :-
    values(Port, ['ht-nxt-color-v2'], 'RGB', [Red, Green, Blue]).

%!  ht_gyro_rate(?Port, -DegreesPerSecond) is nondet.
%
%   True if HiTechnic's gyro turns at that rate. At rest it may show some
%   degrees more or less than 0, always the same.

ht_gyro_rate(Port, DegreesPerSecond) :-
    sensor_reading(ht_gyro_rate, Port, DegreesPerSecond).

%!  ht_eopd(?Port, +Range, -Percent) is nondet.
%
%   True if HiTechnic's optical proximity detector sees that much of its own
%   light come back, from 0 to 100. Range is `long` or `short`. The distance
%   is some constant divided by Percent, which depends on the surface.
%
%   @error domain_error(eopd_range, Range)

ht_eopd(Port, Range, Percent) :-
    must_be(nonvar, Range),
    (   eopd_mode(Range, Mode)
    ->  true
    ;   domain_error(eopd_range, Range)
    ),
    values(Port, ['ht-nxt-eopd'], Mode, [Percent]).

eopd_mode(long,  'LONG').
eopd_mode(short, 'SHORT').

%!  acceleration(?Port, -X, -Y, -Z) is nondet.
%
%   True if the sensor feels that acceleration along its three axes, in g. One
%   that lies level and at rest feels 1 g along z. Takes the sensors of
%   HiTechnic, mindsensors and Microinfinity.
%
%   @see http://www.hitechnic.com, sensor NAC1040, for its 200 counts to the g

acceleration(Port, X, Y, Z) :-
    sensor_of(Port, [ 'ht-nxt-accel', 'ms-absolute-imu',
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

% The upper eight bits are signed, the lower two are the lowest of their byte.
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
%   True if mindsensors' AbsoluteIMU turns at these rates about its three
%   axes, in degrees per second; is tilted by these angles, from -90 to 90
%   degrees; or feels a magnetic field of that strength, in units of its own.
%   The rates go up to 250 at first; `ACCEL-4G` and further commands make it
%   coarser.

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
%   True if an axle is turned to that angle, 0 to 359 (HiTechnic only); has
%   turned that far in all since the last `RESET`, see sensor_command/2; or
%   turns that fast. Takes HiTechnic's angle sensor and mindsensors'
%   GlideWheel, which tells half degrees.

angle_deg(Port, Degrees) :-
    sensor_reading(angle_deg, Port, Degrees).

angle_total(Port, Degrees) :-
    measured(angle_total, Port, Degrees).

angle_rpm(Port, RevolutionsPerMinute) :-
    sensor_reading(angle_rpm, Port, RevolutionsPerMinute).

%!  light_row(?Port, -Percents) is nondet.
%
%   True if Percents is the list of what the eight light sensors see in a row
%   of mindsensors' LightSensorArray or LineLeader, from left to right, each
%   from 0 to 100. The sensor has to be told what is white and black first, by
%   the commands `CAL-WHITE` and `CAL-BLACK`.

light_row(Port, Percents) :-
    sensor_values_(Port, ['ms-light-array', 'ms-line-leader'],
                                  'CAL', 8, Percents).

%!  line_leader(?Port, -Steering, -Seen) is nondet.
%
%   True if mindsensors' LineLeader wants a robot to steer so that it follows
%   the line: Steering, from -100 to 100, is to be added to the speed of the
%   left motor and subtracted from that of the right one. Seen is the list of
%   those of its eight sensors, 1 on the left to 8 on the right, that see the
%   line.

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
%   True if LEGO's energy meter measures this: In and Out are terms
%   `power(Volts, Amperes, Watts)`, Joules is what it has stored.

energy_meter(Port, power(InV, InA, InW), power(OutV, OutA, OutW), Joules) :-
    values(Port, ['lego-power-storage'], 'ALL',
           [InV, InA, OutV, OutA, Stored, InW, OutW]),
    % The kernel gives all seven three decimals, which joules have not.
    Joules is round(Stored * 1000).
