% A robot that drives squares of a meter, to the right and then to the left,
% and prints its computed pose. If the robot stands at another place, the
% sizes given to set_robot/4 are not exact: see calibrate/3.
%
%   ?- start.

:- use_module(library(ev3dev)).
:- use_module(library(ev3dev/drive)).

start :-
    set_robot(5.6, 10.6, outB, outC),
    set_pose(0, 0, 0),
    square(100, 90),
    square(100, -90).

square(Side, Corner) :-
    forall(between(1, 4, _),
           ( go_cm(30, Side),
             turn(20, Corner) )),
    pose(X, Y, Heading),
    format("at ~1f cm, ~1f cm, heading ~1f degrees~n", [X, Y, Heading]).
