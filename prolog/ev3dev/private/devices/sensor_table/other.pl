:- module(ev3dev_other_sensors, []).

/** <module> Sensors of other makers and their modes

Loaded when library(ev3dev/sensor_info) is first asked for it.

@see http://docs.ev3dev.org for what the drivers say of each
*/

%!  type(?Type, ?What) is nondet.
%
%   True if What is a sensor of Type, in words.

:- public type/2.

type('di-dflex', 'Dexter Industries dFlex').
type('ht-nxt-eopd', 'HiTechnic optical proximity detector').
type('ht-nxt-force', 'HiTechnic force sensor').
type('ht-nxt-mag', 'HiTechnic magnetic sensor').
type('ht-nxt-gyro', 'HiTechnic gyro').
type('ms-nxt-touch-mux', 'mindsensors multiplexer of touch sensors').
type('ht-nxt-compass', 'HiTechnic compass').
type('ht-nxt-color', 'HiTechnic color sensor').
type('ht-nxt-color-v2', 'HiTechnic color sensor V2').
type('ht-nxt-ir-seek-v2', 'HiTechnic infrared seeker V2').
type('ht-nxt-angle', 'HiTechnic angle sensor').
type('ht-nxt-accel', 'HiTechnic acceleration sensor').
type('ht-nxt-barometric', 'HiTechnic barometer').
type('ht-nxt-pir', 'HiTechnic motion detector').
type('ht-nxt-ir-link', 'HiTechnic infrared link').
type('ht-nxt-ir-receiver',
           'HiTechnic receiver of LEGO train remote controls').
type('ht-super-pro', 'HiTechnic SuperPro board').
type('ht-nxt-smux', 'HiTechnic sensor multiplexer').
type('ms-absolute-imu', 'mindsensors accelerometer, compass and gyro').
type('ms-angle', 'mindsensors GlideWheel').
type('ms-light-array', 'mindsensors row of light sensors').
type('ms-line-leader', 'mindsensors line follower').
type('ms-nxtmmx', 'mindsensors motor multiplexer').
type('ms-8ch-servo', 'mindsensors servo controller').
type('ms-ev3-smux', 'mindsensors EV3 sensor multiplexer').
type('ms-nxtcam', 'mindsensors camera').
type('ms-nxtcam5', 'mindsensors camera 5').
type('ms-pixy-adapter', 'mindsensors adapter of the Pixy camera').
type('pixy-lego', 'Pixy camera').
type('ms-ir-thermometer', 'mindsensors infrared thermometer').
type('ms-pps58-nx', 'mindsensors pneumatic pressure sensor').
type('ms-tof', 'mindsensors distance sensor by time of flight').
type('mi-xg1300l', 'Microinfinity gyro and accelerometer').

%!  mode(?Type, ?Mode, ?Count, ?Decimals, ?Units, ?Meaning) is nondet.
%
%   See sensor_mode/6.

:- public mode/6.

mode('di-dflex', 'FLEX', 1, 0, '',
     'how far it is bent, 0 to 100').

mode('ht-nxt-eopd', 'LONG', 1, 0, '',
     'own light that comes back, 0 to 100, over the long range').
mode('ht-nxt-eopd', 'SHORT', 1, 0, '',
     'own light that comes back, 0 to 100, over the short range').

mode('ht-nxt-force', 'FORCE', 1, 0, '',
     'force, 0 to 1023, not linear').

mode('ht-nxt-mag', 'MAG', 1, 0, '',
     'magnetic field, 0 to 1023').

mode('ht-nxt-gyro', 'GYRO', 1, 0, 'd/s',
     'rate, -540 to 400').

mode('ms-nxt-touch-mux', 'TOUCH-MUX', 3, 0, '',
     '1 for each of three that is pressed, else 0').

mode('ht-nxt-compass', 'COMPASS', 1, 0, deg,
     'degrees from north, clockwise, 0 to 359').

mode('ht-nxt-color', 'COLOR', 1, 0, '',
     'color number, 0 black to 17 white').
mode('ht-nxt-color', 'RED', 1, 0, '',
     'red, 0 to 255').
mode('ht-nxt-color', 'GREEN', 1, 0, '',
     'green, 0 to 255').
mode('ht-nxt-color', 'BLUE', 1, 0, '',
     'blue, 0 to 255').
mode('ht-nxt-color', 'RAW', 3, 0, '',
     'red, green, blue, 0 to 65535').
mode('ht-nxt-color', 'NORM', 4, 0, '',
     'red, green, blue, the strongest 255, and another').
mode('ht-nxt-color', 'ALL', 4, 0, '',
     'color number, red, green, blue').

mode('ht-nxt-color-v2', 'COLOR', 1, 0, '',
     'color number, 0 black to 17 white').
mode('ht-nxt-color-v2', 'RGB', 4, 0, '',
     'red, green, blue, white, 0 to 255').
mode('ht-nxt-color-v2', 'NORM', 4, 0, '',
     'red, green, blue, white, the strongest 255').
mode('ht-nxt-color-v2', 'PASSIVE', 4, 0, '',
     'red, green, blue, white with its lamp off').
mode('ht-nxt-color-v2', 'RAW', 4, 0, '',
     'red, green, blue, white, not calibrated').

mode('ht-nxt-ir-seek-v2', 'DC', 1, 0, '',
     'direction of steady light: 0 none, 1 far left, 5 ahead, 9 far right').
mode('ht-nxt-ir-seek-v2', 'AC', 1, 0, '',
     'direction of pulsed light: 0 none, 1 far left, 5 ahead, 9 far right').
mode('ht-nxt-ir-seek-v2', 'DC-ALL', 7, 0, '',
     'direction, five strengths from left to right, 0 to 255, and \c
      their mean').
mode('ht-nxt-ir-seek-v2', 'AC-ALL', 6, 0, '',
     'direction, and five strengths from left to right, 0 to 255').

mode('ht-nxt-angle', 'ANGLE', 1, 0, deg,
     'angle of the axle, 0 to 359').
mode('ht-nxt-angle', 'ANGLE-ACC', 1, 0, deg,
     'angle since the last reset').
mode('ht-nxt-angle', 'SPEED', 1, 0, 'RPM',
     'revolutions per minute').

mode('ht-nxt-accel', 'ACCEL', 1, 0, '',
     'upper 8 of 10 bits along x').
mode('ht-nxt-accel', 'ALL', 6, 0, '',
     'upper 8 bits along x, y, z, then lower 2 bits; 200 to the g').

mode('ht-nxt-barometric', 'PRESS', 1, 3, inHg,
     'pressure of the air in inches of mercury, about 30').
mode('ht-nxt-barometric', 'TEMP', 1, 1, 'C',
     'degrees Celsius').

mode('ht-nxt-pir', 'PROX', 1, 0, pct,
     'change of warmth before it, -100 to 100').

mode('ht-nxt-ir-link', 'IRLINK', 1, 0, '',
     'state of the link').

mode('ht-nxt-ir-receiver', '1-MOTOR', 1, 0, pct,
     'speed asked for, -100 to 100, -128 to brake').
mode('ht-nxt-ir-receiver', '8-MOTOR', 8, 0, pct,
     'speeds asked for on channels 1 to 4, two each').

mode('ht-super-pro', 'AIN', 4, 0, '',
     'analog inputs, 0 to 1023').
mode('ht-super-pro', 'DIN', 1, 0, '',
     'digital inputs as bits').
mode('ht-super-pro', 'DOUT', 1, 0, '',
     'digital outputs as bits').
mode('ht-super-pro', 'DCTRL', 1, 0, '',
     'which digital ones are outputs, as bits').
mode('ht-super-pro', 'STROBE', 1, 0, '',
     'strobe output as bits').
mode('ht-super-pro', 'LED', 1, 0, '',
     '0 dark, 1 red, 2 blue, 3 both').
mode('ht-super-pro', 'AOUT-0', 5, 0, '',
     'first analog output: mode, frequency and voltage as bytes').
mode('ht-super-pro', 'AOUT-1', 5, 0, '',
     'second analog output: mode, frequency and voltage as bytes').

mode('ht-nxt-smux', 'MUX', 2, 0, '',
     '0 halted, 1 detecting, 2 running; status as bits').

mode('ms-absolute-imu', 'TILT', 3, 0, deg,
     'tilt about x, y, z, -90 to 90').
mode('ms-absolute-imu', 'ACCEL', 3, 3, g,
     'acceleration along x, y, z').
mode('ms-absolute-imu', 'COMPASS', 1, 0, deg,
     'degrees from north, clockwise').
mode('ms-absolute-imu', 'MAG', 3, 0, '',
     'magnetic field along x, y, z').
mode('ms-absolute-imu', 'GYRO', 3, 1, 'd/s',
     'rate about x, y, z').
mode('ms-absolute-imu', 'ALL', 23, 0, '',
     'all registers; only the first eight can be read').

mode('ms-angle', 'ANGLE', 1, 0, deg,
     'angle since the last reset').
mode('ms-angle', 'ANGLE2', 1, 1, deg,
     'angle since the last reset, by half degrees').
mode('ms-angle', 'SPEED', 1, 0, rpm,
     'revolutions per minute').
mode('ms-angle', 'ALL', 3, 0, '',
     'angle in degrees, in half degrees, and revolutions per minute').

mode('ms-light-array', 'CAL', 8, 0, pct,
     'light from left to right, 0 to 100').
mode('ms-light-array', 'RAW', 8, 0, '',
     'light from left to right, not calibrated').

mode('ms-line-leader', 'PID', 1, 0, pct,
     'steering, -100 to 100').
mode('ms-line-leader', 'PID-ALL', 3, 0, '',
     'steering, place of the line, 10 to 80, and a bit for each sensor').
mode('ms-line-leader', 'CAL', 8, 0, pct,
     'light from left to right, 0 to 100').
mode('ms-line-leader', 'RAW', 8, 0, '',
     'light from left to right, not calibrated').

mode('ms-nxtmmx', 'STATUS', 1, 3, 'V',
     'voltage of its battery').
mode('ms-nxtmmx', 'STATUS-OLD', 1, 3, 'V',
     'the same with older firmware').

mode('ms-8ch-servo', 'V3', 1, 3, 'V',
     'voltage of its battery, 4.7 to 9.4').
mode('ms-8ch-servo', 'OLD', 1, 3, 'V',
     'the same with older firmware').

mode('ms-ev3-smux', 'MUX', 1, 0, '',
     'nothing; its sensors are devices of their own').

mode('ms-nxtcam', 'TRACK', 6, 0, '',
     'objects in sight; of the first: color, x and y of two corners').

mode('ms-nxtcam5', 'TRACK', 6, 0, '',
     'objects in sight; of the first: color, x and y of two corners').

mode('ms-pixy-adapter', 'TRACK', 6, 0, '',
     'objects in sight; of the first: color, x and y of two corners').

mode('pixy-lego', 'ALL', 6, 0, '',
     'signature (two bytes), x, y, width, height of the largest object').
mode('pixy-lego', 'SIG1', 5, 0, '',
     'objects of signature 1; of the largest: x, y, width, height').
mode('pixy-lego', 'SIG2', 5, 0, '',
     'objects of signature 2; of the largest: x, y, width, height').
mode('pixy-lego', 'SIG3', 5, 0, '',
     'objects of signature 3; of the largest: x, y, width, height').
mode('pixy-lego', 'SIG4', 5, 0, '',
     'objects of signature 4; of the largest: x, y, width, height').
mode('pixy-lego', 'SIG5', 5, 0, '',
     'objects of signature 5; of the largest: x, y, width, height').
mode('pixy-lego', 'SIG6', 5, 0, '',
     'objects of signature 6; of the largest: x, y, width, height').
mode('pixy-lego', 'SIG7', 5, 0, '',
     'objects of signature 7; of the largest: x, y, width, height').

mode('ms-ir-thermometer', 'AMBIENT-C', 1, 2, 'C',
     'temperature around it in degrees Celsius').
mode('ms-ir-thermometer', 'AMBIENT-F', 1, 2, 'F',
     'temperature around it in degrees Fahrenheit').
mode('ms-ir-thermometer', 'TARGET-C', 1, 2, 'C',
     'temperature of what it looks at in degrees Celsius').
mode('ms-ir-thermometer', 'TARGET-F', 1, 2, 'F',
     'temperature of what it looks at in degrees Fahrenheit').

mode('ms-pps58-nx', 'RAW', 1, 0, 'Pa',
     'pressure in pascal').
mode('ms-pps58-nx', 'ABS-PSI', 1, 0, 'PSI',
     'pressure in pounds per square inch').
mode('ms-pps58-nx', 'ABS-MBAR', 1, 0, mbar,
     'pressure in millibar').
mode('ms-pps58-nx', 'ABS-KPA', 1, 0, kPa,
     'pressure in kilopascal').
mode('ms-pps58-nx', 'REL-PSI', 1, 0, 'PSI',
     'pressure above the reference, in pounds per square inch').
mode('ms-pps58-nx', 'REL-MBAR', 1, 0, mbar,
     'pressure above the reference, in millibar').
mode('ms-pps58-nx', 'REL-KPA', 1, 0, kPa,
     'pressure above the reference, in kilopascal').

mode('ms-tof', 'DIST', 1, 0, mm,
     'distance, 30 to 2000').
mode('ms-tof', 'VOLT', 1, 0, mV,
     'supply voltage').

mode('mi-xg1300l', 'ANGLE', 1, 2, deg,
     'angle, -180 to 180').
mode('mi-xg1300l', 'SPEED', 1, 2, 'd/s',
     'rate').
mode('mi-xg1300l', 'ACCEL', 3, 3, g,
     'acceleration along x, y, z').
mode('mi-xg1300l', 'ALL', 5, 0, '',
     'angle and rate in hundredths, acceleration along x, y, z in \c
      thousandths of a g').
