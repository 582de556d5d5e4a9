% A robot that follows the left edge of a black line by one color sensor.
%
%   ?- start.
%
% The sensor points at the floor. It is at in2, or else at any port. Above the
% edge, half of its light comes back. The deviation from this value, its sum
% over time and its rate of change give the rate at which the robot turns: a
% PID control. Stop it with Ctrl-C: the wheels always stop at the end.

:- use_module(library(ev3dev)).
:- use_module(library(ev3dev/drive)).

%   P, I and D: degrees per second for each percent, for each percent times
%   second, and for each percent per second.
gain(proportional, 1.6).
gain(integral, 0.3).
gain(derivative, 0.06).

%   The speed in cm per second, and the period of the control in seconds.
speed(12).
period(0.02).

start :-
    set_robot(5.6, 10.6, outB, outC),
    eye(Eye),
    error(Eye, Error),
    setup_call_cleanup(
        true,
        line_following(Eye, Error, 0),
        ignore(stop)).

eye(in2) :-
    light_sensor(in2),
    !.
eye(Eye) :-
    light_sensor(Eye),
    !.

%   The deviation is positive if it is too bright: the line is on the right.
error(Eye, Error) :-
    col_reflect(Eye, Light),
    Error is Light - 50.

line_following(Eye, Error0, Sum0) :-
    error(Eye, Error),
    period(Period),
    Sum is max(-100, min(100, Sum0 + Error * Period)),
    Change is (Error - Error0) / Period,
    gain(proportional, P),
    gain(integral, I),
    gain(derivative, D),
    Rate is P * Error + I * Sum + D * Change,
    speed(Speed),
    drive_cm(Speed, Rate, [acceleration(100)]),
    % The robot keeps driving during the wait.
    drive_wait([timeout(Period)], timeout),
    !,
    line_following(Eye, Error, Sum).
