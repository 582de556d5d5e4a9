% A robot that wanders about by three rules, the most important first.
%
%   ?- start.
%
% It needs two large motors, an ultrasonic sensor that points ahead, and a
% touch sensor at its front, at any ports. Stop it with Ctrl-C: the wheels
% always stop at the end.

:- use_module(library(ev3dev)).
:- use_module(library(ev3dev/rules)).

% It drives back from what it has run into.
escape :: touch(_, 1)              ~> go_cm(30, -15), turn(30, 120).

% It turns while something is near: turn/1 does not wait, so the guard is
% checked again and again.
avoid  :: us_dist_cm(_, D), D < 25 ~> turn(30).

wander :: true                     ~> go(40).

start :-
    set_robot(5.6, 10.6, outB, outC),
    behave([escape, avoid, wander]).
