% The robot of the paper: set_robot(5.6, 10.6, outB, outC).

left_wheel(outB, 5.6).
right_wheel(outC, 5.6).
axle(10.6).
hull(circle(8)).
mass(0.75).

motor(outA, 'lego-ev3-m-motor').
motor(outB, 'lego-ev3-l-motor').
motor(outC, 'lego-ev3-l-motor').

% A color sensor on the left and one on the right; each points aside.
sensor(in1, 'lego-ev3-us',     0, 7,     0).
sensor(in2, 'lego-ev3-color', -3, 6.5, -30).
sensor(in3, 'lego-ev3-color',  3, 6.5,  30).
sensor(in4, 'lego-ev3-gyro',   0, 0,     0).
