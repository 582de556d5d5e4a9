% A robot that follows the left edge of a black line by its left eye, in2.

:- use_module(library(ev3dev)).
:- use_module(library(ev3dev/drive)).

start :-
    set_robot(5.6, 10.6, outB, outC),
    follow_line.

%   On the edge the floor sends back about half of the light.
follow_line :-
    col_reflect(in2, Light),            % 0 is black, 100 is white
    Error is Light-50,
    rate(Error, Rate),
    drive_cm(10, Rate, [acceleration(100)]),
    ignore(drive_wait([timeout(0.02)], timeout)),
    follow_line.

%   How many degrees per second to the right, for an Error?
rate(_, 0).
