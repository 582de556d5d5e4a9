% A square of 60 cm. Type `start.`, and the robot drives it.

:- use_module(library(ev3dev)).

start :-
    set_robot(5.6, 10.6, outB, outC),
    go_cm(30, 60).
    % And now?
