:- module(ev3dev_lego_sensors, []).
:- use_module('../../basics/small_lists', [one_of/2]).

/** <module> LEGO's sensors and their modes

Loaded when library(ev3dev/sensor_info) is first asked for it.

@see http://docs.ev3dev.org for what the drivers say of each
*/

%!  type(?Type, ?What) is nondet.
%
%   True if What is a sensor of Type, in words.

:- public type/2.

type('lego-ev3-color', 'EV3 color sensor').
type('lego-ev3-us', 'EV3 ultrasonic sensor').
type('lego-ev3-gyro', 'EV3 gyro').
type('lego-ev3-ir', 'EV3 infrared sensor').
type('lego-ev3-touch', 'EV3 touch sensor').
type(Type, 'EV3 sensor that is a voltage') :-
    ev3_analog(Type).
type('nxt-analog', 'any NXT sensor that is a voltage').
type('lego-nxt-touch', 'NXT touch sensor').
type('lego-nxt-light', 'NXT light sensor').
type('lego-nxt-sound', 'NXT sound sensor').
type('lego-nxt-us', 'NXT ultrasonic sensor').
type('lego-nxt-temp', 'NXT temperature sensor').
type('lego-power-storage', 'LEGO energy meter').

%   Named by a resistor; that of 02 is the touch sensor's.

ev3_analog(Type) :-
    one_of([ '01', '03', '04', '05', '06', '07', '08', '09', '10', '11', '12',
             '13', '14' ], Number),
    atom_concat('ev3-analog-', Number, Analog),
    Type = Analog.

%!  mode(?Type, ?Mode, ?Count, ?Decimals, ?Units, ?Meaning) is nondet.
%
%   See sensor_mode/6.

:- public mode/6.

mode('lego-ev3-color', 'COL-REFLECT', 1, 0, pct,
     'its own red light that comes back, 0 to 100').
mode('lego-ev3-color', 'COL-AMBIENT', 1, 0, pct,
     'light around it, 0 to 100').
mode('lego-ev3-color', 'COL-COLOR', 1, 0, col,
     '0 none, 1 black, 2 blue, 3 green, 4 yellow, 5 red, 6 white, 7 brown').
mode('lego-ev3-color', 'REF-RAW', 2, 0, '',
     'light with its lamp on, and off, 0 to 1023; more light is lower').
mode('lego-ev3-color', 'RGB-RAW', 3, 0, '',
     'red, green, blue, 0 to 1023, not calibrated').
mode('lego-ev3-color', 'COL-CAL', 4, 0, '',
     'factory calibration; the sensor loses contact').

mode('lego-ev3-us', 'US-DIST-CM', 1, 1, cm,
     'distance, 0 to 255.0; 255.0 is also nothing there').
mode('lego-ev3-us', 'US-DIST-IN', 1, 1, in,
     'distance, 0 to 100.3; 100.3 is also nothing there').
mode('lego-ev3-us', 'US-LISTEN', 1, 0, '',
     '1 while it hears another such sensor').
mode('lego-ev3-us', 'US-SI-CM', 1, 1, cm,
     'distance when the mode was written; not twice in 250 ms').
mode('lego-ev3-us', 'US-SI-IN', 1, 1, in,
     'distance when the mode was written; not twice in 250 ms').
mode('lego-ev3-us', 'US-DC-CM', 1, 1, cm,
     'distance, as US-DIST-CM').
mode('lego-ev3-us', 'US-DC-IN', 1, 1, in,
     'distance, as US-DIST-IN').

mode('lego-ev3-gyro', 'GYRO-ANG', 1, 0, deg,
     'angle since the mode was set, clockwise').
mode('lego-ev3-gyro', 'GYRO-RATE', 1, 0, 'd/s',
     'rate, -440 to 440, clockwise').
mode('lego-ev3-gyro', 'GYRO-FAS', 1, 0, '',
     'rate in finer steps, -1464 to 1535').
mode('lego-ev3-gyro', 'GYRO-G&A', 2, 0, '',
     'angle in degrees, and rate in degrees per second').
mode('lego-ev3-gyro', 'GYRO-CAL', 4, 0, '',
     'calibration').
mode('lego-ev3-gyro', 'TILT-RATE', 1, 0, 'd/s',
     'rate about the second axis; newer sensors only').
mode('lego-ev3-gyro', 'TILT-ANG', 1, 0, deg,
     'angle about the second axis; newer sensors only').

mode('lego-ev3-ir', 'IR-PROX', 1, 0, pct,
     'proximity, 0 to 100; 100 is 70 cm or more').
mode('lego-ev3-ir', 'IR-SEEK', 8, 0, pct,
     'for channels 1 to 4: heading of the beacon, -25 to 25, and \c
      distance, 0 to 100, -128 for none').
mode('lego-ev3-ir', 'IR-REMOTE', 4, 0, btn,
     'for channels 1 to 4: which buttons are held, 0 to 11').
mode('lego-ev3-ir', 'IR-REM-A', 1, 0, '',
     'buttons of channel 1 as bits 4 to 7: red up, red down, blue up, \c
      blue down').
mode('lego-ev3-ir', 'IR-S-ALT', 4, 0, pct,
     'not usable: the sensor resets').
mode('lego-ev3-ir', 'IR-CAL', 2, 0, '',
     'calibration').

mode('lego-ev3-touch', 'TOUCH', 1, 0, '',
     '1 while it is pressed, else 0').

mode(Type, 'ANALOG', 1, 3, 'V', 'voltage on pin 6, 0 to 5') :-
    ev3_analog(Type).

mode('nxt-analog', 'ANALOG-0', 1, 3, 'V',
     'voltage on pin 1, 0 to 5, with pin 5 low').
mode('nxt-analog', 'ANALOG-1', 1, 3, 'V',
     'voltage on pin 1, 0 to 5, with pin 5 high').

mode('lego-nxt-touch', 'TOUCH', 1, 0, '',
     '1 while it is pressed, else 0').

mode('lego-nxt-light', 'REFLECT', 1, 1, pct,
     'its own light that comes back, 0 to 100').
mode('lego-nxt-light', 'AMBIENT', 1, 1, pct,
     'light around it, 0 to 100').

mode('lego-nxt-sound', 'DB', 1, 1, pct,
     'voltage of the microphone, 0 to 100; high in silence').
mode('lego-nxt-sound', 'DBA', 1, 1, pct,
     'the same, weighted as the ear does').

mode('lego-nxt-us', 'US-DIST-CM', 1, 0, cm,
     'distance, 0 to 255; 255 is also nothing there').
mode('lego-nxt-us', 'US-DIST-IN', 1, 1, in,
     'distance, 0 to 100.0; 100.0 is also nothing there').
mode('lego-nxt-us', 'US-SI-CM', 1, 0, cm,
     'distance when the mode was written').
mode('lego-nxt-us', 'US-SI-IN', 1, 1, in,
     'distance when the mode was written').
mode('lego-nxt-us', 'US-LISTEN', 1, 0, '',
     '1 while it hears another such sensor').

mode('lego-nxt-temp', 'NXT-TEMP-C', 1, 1, 'C',
     'degrees Celsius, -55.0 to 128.0').
mode('lego-nxt-temp', 'NXT-TEMP-F', 1, 1, 'F',
     'degrees Fahrenheit, -67.0 to 262.4').

mode('lego-power-storage', 'IN-VOLT', 1, 3, 'V',
     'voltage in, 0 to 10').
mode('lego-power-storage', 'IN-AMP', 1, 3, 'A',
     'current in, 0 to 10').
mode('lego-power-storage', 'OUT-VOLT', 1, 3, 'V',
     'voltage out, 0 to 10').
mode('lego-power-storage', 'OUT-AMP', 1, 3, 'A',
     'current out, 0 to 10').
mode('lego-power-storage', 'JOULE', 1, 0, 'J',
     'energy stored, 0 to 100').
mode('lego-power-storage', 'IN-WATT', 1, 3, 'W',
     'power in, 0 to 10').
mode('lego-power-storage', 'OUT-WATT', 1, 3, 'W',
     'power out, 0 to 10').
mode('lego-power-storage', 'ALL', 7, 3, '',
     'volts and amperes in, volts and amperes out, joules / 1000, \c
      watts in, watts out').
