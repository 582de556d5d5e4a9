:- module(ev3dev_sensor_table, []).
:- use_module('../basics/small_lists', [one_of/2]).

/** <module> The table of sensors and their modes

library(ev3dev/sensor_info) loads it when it is first asked for.

@see http://docs.ev3dev.org for what the drivers say of each
*/

%!  type(?Type, ?What) is nondet.
%
%   True if What is a sensor of Type, in words.

:- public type/2.

type(Type, What) :-
    sensor(Type, What, _).

%!  mode(?Type, ?Mode, ?Count, ?Decimals, ?Units, ?Meaning) is nondet.
%
%   See sensor_mode/6.

:- public mode/6.

mode(Type, Mode, Count, Decimals, Units, Meaning) :-
    sensor(Type, _, Modes),
    one_of(Modes, mode(Mode, Count, Decimals, Units, Meaning)).

% ---------------- LEGO

%   A resistor names an EV3 sensor; that of 02 is the touch sensor's.

ev3_analog(Type) :-
    one_of([ '01', '03', '04', '05', '06', '07', '08', '09', '10', '11', '12',
             '13', '14' ], Number),
    atom_concat('ev3-analog-', Number, Analog),
    Type = Analog.

sensor(Type, 'EV3 sensor that is a voltage',
  [ mode('ANALOG', 1, 3, 'V', 'voltage on pin 6, 0 to 5') ]) :-
    ev3_analog(Type).
sensor('lego-ev3-color', 'EV3 color sensor',
  [ mode('COL-REFLECT', 1, 0, pct,
         'its own red light that comes back, 0 to 100'),
    mode('COL-AMBIENT', 1, 0, pct, 'light around it, 0 to 100'),
    mode('COL-COLOR', 1, 0, col,
         '0 none, 1 black, 2 blue, 3 green, 4 yellow, 5 \c
          red, 6 white, 7 brown'),
    mode('REF-RAW', 2, 0, '',
         'light with its lamp on, and off, 0 to 1023; more \c
          light is lower'),
    mode('RGB-RAW', 3, 0, '', 'red, green, blue, 0 to 1023, not calibrated'),
    mode('COL-CAL', 4, 0, '',
         'factory calibration; the sensor loses contact') ]).
sensor('lego-ev3-us', 'EV3 ultrasonic sensor',
  [ mode('US-DIST-CM', 1, 1, cm,
         'distance, 0 to 255.0; 255.0 is also nothing there'),
    mode('US-DIST-IN', 1, 1, in,
         'distance, 0 to 100.3; 100.3 is also nothing there'),
    mode('US-LISTEN', 1, 0, '', '1 while it hears another such sensor'),
    mode('US-SI-CM', 1, 1, cm,
         'distance when the mode was written; not twice in 250 ms'),
    mode('US-SI-IN', 1, 1, in,
         'distance when the mode was written; not twice in 250 ms'),
    mode('US-DC-CM', 1, 1, cm, 'distance, as US-DIST-CM'),
    mode('US-DC-IN', 1, 1, in, 'distance, as US-DIST-IN') ]).
sensor('lego-ev3-gyro', 'EV3 gyro',
  [ mode('GYRO-ANG', 1, 0, deg, 'angle since the mode was set, clockwise'),
    mode('GYRO-RATE', 1, 0, 'd/s', 'rate, -440 to 440, clockwise'),
    mode('GYRO-FAS', 1, 0, '', 'rate in finer steps, -1464 to 1535'),
    mode('GYRO-G&A', 2, 0, '',
         'angle in degrees, and rate in degrees per second'),
    mode('GYRO-CAL', 4, 0, '', 'calibration'),
    mode('TILT-RATE', 1, 0, 'd/s',
         'rate about the second axis; newer sensors only'),
    mode('TILT-ANG', 1, 0, deg,
         'angle about the second axis; newer sensors only') ]).
sensor('lego-ev3-ir', 'EV3 infrared sensor',
  [ mode('IR-PROX', 1, 0, pct, 'proximity, 0 to 100; 100 is 70 cm or more'),
    mode('IR-SEEK', 8, 0, pct,
         'for channels 1 to 4: heading of the beacon, -25 \c
          to 25, and distance, 0 to 100, -128 for none'),
    mode('IR-REMOTE', 4, 0, btn,
         'for channels 1 to 4: which buttons are held, 0 to 11'),
    mode('IR-REM-A', 1, 0, '',
         'buttons of channel 1 as bits 4 to 7: red up, red \c
          down, blue up, blue down'),
    mode('IR-S-ALT', 4, 0, pct, 'not usable: the sensor resets'),
    mode('IR-CAL', 2, 0, '', 'calibration') ]).
sensor('lego-ev3-touch', 'EV3 touch sensor',
  [ mode('TOUCH', 1, 0, '', '1 while it is pressed, else 0') ]).
sensor('nxt-analog', 'any NXT sensor that is a voltage',
  [ mode('ANALOG-0', 1, 3, 'V', 'voltage on pin 1, 0 to 5, with pin 5 low'),
    mode('ANALOG-1', 1, 3, 'V',
         'voltage on pin 1, 0 to 5, with pin 5 high') ]).
sensor('lego-nxt-touch', 'NXT touch sensor',
  [ mode('TOUCH', 1, 0, '', '1 while it is pressed, else 0') ]).
sensor('lego-nxt-light', 'NXT light sensor',
  [ mode('REFLECT', 1, 1, pct, 'its own light that comes back, 0 to 100'),
    mode('AMBIENT', 1, 1, pct, 'light around it, 0 to 100') ]).
sensor('lego-nxt-sound', 'NXT sound sensor',
  [ mode('DB', 1, 1, pct,
         'voltage of the microphone, 0 to 100; high in silence'),
    mode('DBA', 1, 1, pct, 'the same, weighted as the ear does') ]).
sensor('lego-nxt-us', 'NXT ultrasonic sensor',
  [ mode('US-DIST-CM', 1, 0, cm,
         'distance, 0 to 255; 255 is also nothing there'),
    mode('US-DIST-IN', 1, 1, in,
         'distance, 0 to 100.0; 100.0 is also nothing there'),
    mode('US-SI-CM', 1, 0, cm, 'distance when the mode was written'),
    mode('US-SI-IN', 1, 1, in, 'distance when the mode was written'),
    mode('US-LISTEN', 1, 0, '', '1 while it hears another such sensor') ]).
sensor('lego-nxt-temp', 'NXT temperature sensor',
  [ mode('NXT-TEMP-C', 1, 1, 'C', 'degrees Celsius, -55.0 to 128.0'),
    mode('NXT-TEMP-F', 1, 1, 'F', 'degrees Fahrenheit, -67.0 to 262.4') ]).
sensor('lego-power-storage', 'LEGO energy meter',
  [ mode('IN-VOLT', 1, 3, 'V', 'voltage in, 0 to 10'),
    mode('IN-AMP', 1, 3, 'A', 'current in, 0 to 10'),
    mode('OUT-VOLT', 1, 3, 'V', 'voltage out, 0 to 10'),
    mode('OUT-AMP', 1, 3, 'A', 'current out, 0 to 10'),
    mode('JOULE', 1, 0, 'J', 'energy stored, 0 to 100'),
    mode('IN-WATT', 1, 3, 'W', 'power in, 0 to 10'),
    mode('OUT-WATT', 1, 3, 'W', 'power out, 0 to 10'),
    mode('ALL', 7, 3, '',
         'volts and amperes in, volts and amperes out, joules \c
          / 1000, watts in, watts out') ]).

% ---------------- OTHER MAKERS

sensor('di-dflex', 'Dexter Industries dFlex',
  [ mode('FLEX', 1, 0, '', 'how far it is bent, 0 to 100') ]).
sensor('ht-nxt-eopd', 'HiTechnic optical proximity detector',
  [ mode('LONG', 1, 0, '',
         'own light that comes back, 0 to 100, over the long range'),
    mode('SHORT', 1, 0, '',
         'own light that comes back, 0 to 100, over the short range') ]).
sensor('ht-nxt-force', 'HiTechnic force sensor',
  [ mode('FORCE', 1, 0, '', 'force, 0 to 1023, not linear') ]).
sensor('ht-nxt-mag', 'HiTechnic magnetic sensor',
  [ mode('MAG', 1, 0, '', 'magnetic field, 0 to 1023') ]).
sensor('ht-nxt-gyro', 'HiTechnic gyro',
  [ mode('GYRO', 1, 0, 'd/s', 'rate, -540 to 400') ]).
sensor('ms-nxt-touch-mux', 'mindsensors multiplexer of touch sensors',
  [ mode('TOUCH-MUX', 3, 0, '',
         '1 for each of three that is pressed, else 0') ]).
sensor('ht-nxt-compass', 'HiTechnic compass',
  [ mode('COMPASS', 1, 0, deg, 'degrees from north, clockwise, 0 to 359') ]).
sensor('ht-nxt-color', 'HiTechnic color sensor',
  [ mode('COLOR', 1, 0, '', 'color number, 0 black to 17 white'),
    mode('RED', 1, 0, '', 'red, 0 to 255'),
    mode('GREEN', 1, 0, '', 'green, 0 to 255'),
    mode('BLUE', 1, 0, '', 'blue, 0 to 255'),
    mode('RAW', 3, 0, '', 'red, green, blue, 0 to 65535'),
    mode('NORM', 4, 0, '',
         'red, green, blue, the strongest 255, and another'),
    mode('ALL', 4, 0, '', 'color number, red, green, blue') ]).
sensor('ht-nxt-color-v2', 'HiTechnic color sensor V2',
  [ mode('COLOR', 1, 0, '', 'color number, 0 black to 17 white'),
    mode('RGB', 4, 0, '', 'red, green, blue, white, 0 to 255'),
    mode('NORM', 4, 0, '', 'red, green, blue, white, the strongest 255'),
    mode('PASSIVE', 4, 0, '', 'red, green, blue, white with its lamp off'),
    mode('RAW', 4, 0, '', 'red, green, blue, white, not calibrated') ]).
sensor('ht-nxt-ir-seek-v2', 'HiTechnic infrared seeker V2',
  [ mode('DC', 1, 0, '',
         'direction of steady light: 0 none, 1 far left, \c
          5 ahead, 9 far right'),
    mode('AC', 1, 0, '',
         'direction of pulsed light: 0 none, 1 far left, \c
          5 ahead, 9 far right'),
    mode('DC-ALL', 7, 0, '',
         'direction, five strengths from left to right, \c
          0 to 255, and their mean'),
    mode('AC-ALL', 6, 0, '',
         'direction, and five strengths from left to right, 0 to 255') ]).
sensor('ht-nxt-angle', 'HiTechnic angle sensor',
  [ mode('ANGLE', 1, 0, deg, 'angle of the axle, 0 to 359'),
    mode('ANGLE-ACC', 1, 0, deg, 'angle since the last reset'),
    mode('SPEED', 1, 0, 'RPM', 'revolutions per minute') ]).
sensor('ht-nxt-accel', 'HiTechnic acceleration sensor',
  [ mode('ACCEL', 1, 0, '', 'upper 8 of 10 bits along x'),
    mode('ALL', 6, 0, '',
         'upper 8 bits along x, y, z, then lower 2 bits; 200 to the g') ]).
sensor('ht-nxt-barometric', 'HiTechnic barometer',
  [ mode('PRESS', 1, 3, inHg,
         'pressure of the air in inches of mercury, about 30'),
    mode('TEMP', 1, 1, 'C', 'degrees Celsius') ]).
sensor('ht-nxt-pir', 'HiTechnic motion detector',
  [ mode('PROX', 1, 0, pct, 'change of warmth before it, -100 to 100') ]).
sensor('ht-nxt-ir-link', 'HiTechnic infrared link',
  [ mode('IRLINK', 1, 0, '', 'state of the link') ]).
sensor('ht-nxt-ir-receiver',
       'HiTechnic receiver of LEGO train remote controls',
  [ mode('1-MOTOR', 1, 0, pct, 'speed asked for, -100 to 100, -128 to brake'),
    mode('8-MOTOR', 8, 0, pct,
         'speeds asked for on channels 1 to 4, two each') ]).
sensor('ht-super-pro', 'HiTechnic SuperPro board',
  [ mode('AIN', 4, 0, '', 'analog inputs, 0 to 1023'),
    mode('DIN', 1, 0, '', 'digital inputs as bits'),
    mode('DOUT', 1, 0, '', 'digital outputs as bits'),
    mode('DCTRL', 1, 0, '', 'which digital ones are outputs, as bits'),
    mode('STROBE', 1, 0, '', 'strobe output as bits'),
    mode('LED', 1, 0, '', '0 dark, 1 red, 2 blue, 3 both'),
    mode('AOUT-0', 5, 0, '',
         'first analog output: mode, frequency and voltage as bytes'),
    mode('AOUT-1', 5, 0, '',
         'second analog output: mode, frequency and voltage as bytes') ]).
sensor('ht-nxt-smux', 'HiTechnic sensor multiplexer',
  [ mode('MUX', 2, 0, '',
         '0 halted, 1 detecting, 2 running; status as bits') ]).
sensor('ms-absolute-imu', 'mindsensors accelerometer, compass and gyro',
  [ mode('TILT', 3, 0, deg, 'tilt about x, y, z, -90 to 90'),
    mode('ACCEL', 3, 3, g, 'acceleration along x, y, z'),
    mode('COMPASS', 1, 0, deg, 'degrees from north, clockwise'),
    mode('MAG', 3, 0, '', 'magnetic field along x, y, z'),
    mode('GYRO', 3, 1, 'd/s', 'rate about x, y, z'),
    mode('ALL', 23, 0, '',
         'all registers; only the first eight can be read') ]).
sensor('ms-angle', 'mindsensors GlideWheel',
  [ mode('ANGLE', 1, 0, deg, 'angle since the last reset'),
    mode('ANGLE2', 1, 1, deg, 'angle since the last reset, by half degrees'),
    mode('SPEED', 1, 0, rpm, 'revolutions per minute'),
    mode('ALL', 3, 0, '',
         'angle in degrees, in half degrees, and revolutions per minute') ]).
sensor('ms-light-array', 'mindsensors row of light sensors',
  [ mode('CAL', 8, 0, pct, 'light from left to right, 0 to 100'),
    mode('RAW', 8, 0, '', 'light from left to right, not calibrated') ]).
sensor('ms-line-leader', 'mindsensors line follower',
  [ mode('PID', 1, 0, pct, 'steering, -100 to 100'),
    mode('PID-ALL', 3, 0, '',
         'steering, place of the line, 10 to 80, and a bit \c
          for each sensor'),
    mode('CAL', 8, 0, pct, 'light from left to right, 0 to 100'),
    mode('RAW', 8, 0, '', 'light from left to right, not calibrated') ]).
sensor('ms-nxtmmx', 'mindsensors motor multiplexer',
  [ mode('STATUS', 1, 3, 'V', 'voltage of its battery'),
    mode('STATUS-OLD', 1, 3, 'V', 'the same with older firmware') ]).
sensor('ms-8ch-servo', 'mindsensors servo controller',
  [ mode('V3', 1, 3, 'V', 'voltage of its battery, 4.7 to 9.4'),
    mode('OLD', 1, 3, 'V', 'the same with older firmware') ]).
sensor('ms-ev3-smux', 'mindsensors EV3 sensor multiplexer',
  [ mode('MUX', 1, 0, '', 'nothing; its sensors are devices of their own') ]).
sensor('ms-nxtcam', 'mindsensors camera',
  [ mode('TRACK', 6, 0, '',
         'objects in sight; of the first: color, x and y of two corners') ]).
sensor('ms-nxtcam5', 'mindsensors camera 5',
  [ mode('TRACK', 6, 0, '',
         'objects in sight; of the first: color, x and y of two corners') ]).
sensor('ms-pixy-adapter', 'mindsensors adapter of the Pixy camera',
  [ mode('TRACK', 6, 0, '',
         'objects in sight; of the first: color, x and y of two corners') ]).
sensor('pixy-lego', 'Pixy camera',
  [ mode('ALL', 6, 0, '',
         'signature (two bytes), x, y, width, height of \c
          the largest object'),
    mode('SIG1', 5, 0, '',
         'objects of signature 1; of the largest: x, y, width, height'),
    mode('SIG2', 5, 0, '',
         'objects of signature 2; of the largest: x, y, width, height'),
    mode('SIG3', 5, 0, '',
         'objects of signature 3; of the largest: x, y, width, height'),
    mode('SIG4', 5, 0, '',
         'objects of signature 4; of the largest: x, y, width, height'),
    mode('SIG5', 5, 0, '',
         'objects of signature 5; of the largest: x, y, width, height'),
    mode('SIG6', 5, 0, '',
         'objects of signature 6; of the largest: x, y, width, height'),
    mode('SIG7', 5, 0, '',
         'objects of signature 7; of the largest: x, y, width, height') ]).
sensor('ms-ir-thermometer', 'mindsensors infrared thermometer',
  [ mode('AMBIENT-C', 1, 2, 'C', 'temperature around it in degrees Celsius'),
    mode('AMBIENT-F', 1, 2, 'F',
         'temperature around it in degrees Fahrenheit'),
    mode('TARGET-C', 1, 2, 'C',
         'temperature of what it looks at in degrees Celsius'),
    mode('TARGET-F', 1, 2, 'F',
         'temperature of what it looks at in degrees Fahrenheit') ]).
sensor('ms-pps58-nx', 'mindsensors pneumatic pressure sensor',
  [ mode('RAW', 1, 0, 'Pa', 'pressure in pascal'),
    mode('ABS-PSI', 1, 0, 'PSI', 'pressure in pounds per square inch'),
    mode('ABS-MBAR', 1, 0, mbar, 'pressure in millibar'),
    mode('ABS-KPA', 1, 0, kPa, 'pressure in kilopascal'),
    mode('REL-PSI', 1, 0, 'PSI',
         'pressure above the reference, in pounds per square inch'),
    mode('REL-MBAR', 1, 0, mbar, 'pressure above the reference, in millibar'),
    mode('REL-KPA', 1, 0, kPa,
         'pressure above the reference, in kilopascal') ]).
sensor('ms-tof', 'mindsensors distance sensor by time of flight',
  [ mode('DIST', 1, 0, mm, 'distance, 30 to 2000'),
    mode('VOLT', 1, 0, mV, 'supply voltage') ]).
sensor('mi-xg1300l', 'Microinfinity gyro and accelerometer',
  [ mode('ANGLE', 1, 2, deg, 'angle, -180 to 180'),
    mode('SPEED', 1, 2, 'd/s', 'rate'),
    mode('ACCEL', 3, 3, g, 'acceleration along x, y, z'),
    mode('ALL', 5, 0, '',
         'angle and rate in hundredths, acceleration along \c
          x, y, z in thousandths of a g') ]).
