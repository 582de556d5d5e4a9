% A robot that follows the left edge of a black line, and waits while
% something is in its way.
%
%   ?- start.
%
% The robot follows the line by one endless action, a PID control. A rule
% above interrupts it, and later it begins again: it knows nothing of rules.
%
% It needs a color sensor that points at the floor, at in2, and an ultrasonic
% sensor that points ahead. Stop it with Ctrl-C.

:- use_module(library(ev3dev)).
:- use_module(library(ev3dev/drive)).
:- use_module(library(ev3dev/rules)).

halt_for :: us_dist_cm(_, D), D < 12 ~> stop.
follow   :: true                     ~> line_following.

start :-
    set_robot(5.6, 10.6, outB, outC),
    behave([halt_for, follow]).

%   P, I and D: degrees per second for each percent, for each percent times
%   second, and for each percent per second.
gain(proportional, 1.6).
gain(integral, 0.3).
gain(derivative, 0.06).

%   The speed in cm per second, and the period of the control in seconds.
speed_cm(12).
period(0.02).

line_following :-
    edge_error(Error),
    line_following(Error, 0).

%   The deviation is positive if it is too bright: the line is on the right.
edge_error(Error) :-
    col_reflect(in2, Light),
    Error is Light - 50.

line_following(Error0, Sum0) :-
    edge_error(Error),
    period(Period),
    Sum is max(-100, min(100, Sum0 + Error * Period)),
    Change is (Error - Error0) / Period,
    gain(proportional, P),
    gain(integral, I),
    gain(derivative, D),
    Rate is P * Error + I * Sum + D * Change,
    speed_cm(Speed),
    drive_cm(Speed, Rate, [acceleration(100)]),
    drive_wait([timeout(Period)], timeout),
    !,
    line_following(Error, Sum).
