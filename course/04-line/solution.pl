% A robot that follows the left edge of a black line: PID.

:- use_module(library(ev3dev)).
:- use_module(library(ev3dev/drive)).

start :-
    set_robot(5.6, 10.6, outB, outC),
    follow_line(0, 0).

follow_line(Error0, Sum0) :-
    col_reflect(in2, Light),
    Error is Light-50,
    Sum is max(-100, min(100, Sum0 + Error*0.02)),
    Rate is 1.6*Error + 0.3*Sum + 0.06*(Error-Error0)/0.02,
    drive_cm(16, Rate, [acceleration(100)]),
    ignore(drive_wait([timeout(0.02)], timeout)),
    follow_line(Error, Sum).
