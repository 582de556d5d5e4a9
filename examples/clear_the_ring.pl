% A robot that pushes all cans out of a ring, and stays in it.
%
%   ?- start.
%
% The ring is black and what is around it is white. Two color sensors look
% down at its front, the left one at in2, the right one at in3. An ultrasonic
% sensor points ahead. Stop it with Ctrl-C.

:- use_module(library(ev3dev)).
:- use_module(library(ev3dev/rules)).

% At the edge the can ahead has just left the ring. The robot goes back.
edge :: white(_) ~> go_cm(40, -30).

% Something is near: it is a can, as the ring is free of other things. The
% robot has turned to the right; it hears the can 15 degrees before it looks
% at its middle.
push :: us_dist_cm(_, D), D < 60 ~> turn(20, 14), go_cm(40, 100).

% Nothing is near: the robot looks around, and then from another place.
find :: true ~> [turn(25):5, go(30):1].

white(Port) :-
    member(Port, [in2, in3]),
    col_reflect(Port, Light),
    Light > 40.

start :-
    set_robot(5.6, 10.6, outB, outC),
    behave([edge, push, find]).
