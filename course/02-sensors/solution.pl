% A vehicle that looks for the light: the wires cross, and it always goes
% ahead a little. Near the lamp it comes to rest.

:- use_module(library(ev3dev)).

start :-
    set_robot(5.6, 10.6, outB, outC),
    drive.

drive :-
    col_ambient(in2, Left),
    col_ambient(in3, Right),
    (   Left + Right > 120,
        us_dist_cm(in1, Distance),
        Distance < 200
    ->  Base = 8
    ;   Base = 25
    ),
    Difference is max(-12, min(12, 3*(Left-Right))),
    SpeedLeft is Base - Difference,
    SpeedRight is Base + Difference,
    (   us_dist_cm(in1, Ahead),
        Ahead < 20
    ->  stop
    ;   motors_run([run(outB, SpeedLeft), run(outC, SpeedRight)]),
        wait(0.05),
        drive
    ).
