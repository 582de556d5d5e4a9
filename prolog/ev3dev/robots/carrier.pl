% The robot of the paper with a gripper ahead of it, which the medium motor
% closes: set_robot(5.6, 10.6, outB, outC), set_gripper(outA, []). The color
% sensor at in3 looks ahead, at what the jaws may hold.

left_wheel(outB, 5.6).
right_wheel(outC, 5.6).
axle(10.6).
hull(circle(8)).
mass(0.85).

motor(outA, 'lego-ev3-m-motor', [stops(0, 90)]).
motor(outB, 'lego-ev3-l-motor').
motor(outC, 'lego-ev3-l-motor').
gripper(outA, 0, 11, [opening(9), lifts(true)]).

sensor(in1, 'lego-ev3-us',     0, 7,   0).
sensor(in2, 'lego-ev3-color', -3, 6.5, -30).
sensor(in3, 'lego-ev3-color',  0, 7,   0, [looks(ahead)]).
sensor(in4, 'lego-ev3-gyro',   0, 0,   0).
