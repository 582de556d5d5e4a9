% A vehicle that looks for the light: the wires cross, and it always goes
% ahead a little. Both eyes are dazzled when the lamp is 40 cm ahead.

:- use_module(library(ev3dev)).

start :-
    set_robot(5.6, 10.6, outB, outC),
    drive.

drive :-
    col_ambient(in2, Left),
    col_ambient(in3, Right),
    (   Left + Right > 190
    ->  go_cm(20, 40)
    ;   wires(Left, Right, SpeedLeft, SpeedRight),
        motors_run([run(outB, SpeedLeft), run(outC, SpeedRight)]),
        wait(0.05),
        drive
    ).

wires(Left, Right, SpeedLeft, SpeedRight) :-
    Difference is max(-12, min(12, 3*(Left-Right))),
    SpeedLeft is 25 - Difference,
    SpeedRight is 25 + Difference.
