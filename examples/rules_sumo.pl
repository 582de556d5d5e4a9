% A sumo robot: it finds the other one, pushes it, and stays in the ring.
%
%   ?- start.
%
% The ring is black and what is around it is white. Two color sensors look
% down at its front, the left one at in2, the right one at in3. An ultrasonic
% sensor points ahead. Stop it with Ctrl-C.

:- use_module(library(ev3dev)).
:- use_module(library(ev3dev/rules)).

% Staying in the ring comes first. It turns away from the side of the edge.
edge_left  :: white(in2) ~> go_cm(50, -15), turn(50, 110).
edge_right :: white(in3) ~> go_cm(50, -15), turn(50, -110).

% It is faster when it is near. go/1 follows the distance.
push :: us_dist_cm(_, D), D < 60 ~> Speed is 100 - D, go(Speed).

find :: true ~> [turn(30):2.5, go(50):1.5].

white(Port) :-
    col_reflect(Port, Light),
    Light > 40.

start :-
    set_robot(5.6, 10.6, outB, outC),
    behave([edge_left, edge_right, push, find]).
