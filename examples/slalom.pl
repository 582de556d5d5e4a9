% A robot that drives around poles in a row, 60 cm apart, in arcs to their
% left and right in turn. It starts in the row, 30 cm before the first pole,
% and looks along the row.
%
%   ?- start.
%   ?- start(Poles).

:- use_module(library(ev3dev)).
:- use_module(library(ev3dev/drive)).

start :-
    start(4).

start(Poles) :-
    set_robot(5.6, 10.6, outB, outC),
    slalom(Poles, 60).

%   The robot crosses the row halfway between two poles, at 60 degrees. From
%   there, an arc of 120 degrees leads around a pole to the next crossing.

slalom(Poles, Gap) :-
    Radius is Gap / sqrt(3),
    turn(20, -60),
    past(Poles, 1, Radius).

past(0, Side, _) :-
    !,
    turn(20, 60 * Side).
past(Poles, Side, Radius) :-
    arc_cm(30, Side * Radius, 120),
    Left is Poles - 1,
    Other is -Side,
    past(Left, Other, Radius).
