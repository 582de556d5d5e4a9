% A square of 60 cm.

:- use_module(library(ev3dev)).

start :-
    set_robot(5.6, 10.6, outB, outC),
    side, side, side, side.

side :-
    go_cm(30, 60),
    turn(20, 90).
