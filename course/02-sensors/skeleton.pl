% A vehicle that looks for the light. The left eye is at in2, the left wheel
% at outB; the right eye is at in3, the right wheel at outC.

:- use_module(library(ev3dev)).

start :-
    set_robot(5.6, 10.6, outB, outC),
    drive.

drive :-
    col_ambient(in2, Left),             % 0 is dark, 100 is bright
    col_ambient(in3, Right),
    wires(Left, Right, SpeedLeft, SpeedRight),
    motors_run([run(outB, SpeedLeft), run(outC, SpeedRight)]),
    wait(0.05),
    drive.

%   Each eye drives the wheel on its own side. What does the vehicle do? What
%   if the wires cross? Far from the lamp it is dark: does the vehicle move at
%   all?
wires(Left, Right, Left, Right).
