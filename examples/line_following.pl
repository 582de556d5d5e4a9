% A robot that follows the left edge of a black line by one colour sensor.
%
%   ?- start.
%
% The sensor looks at the floor, at in2 or else at any port. Half of its light
% comes back where the edge is below it. How far it is from that, for how long
% it has been, and how fast that changes make the rate at which the robot
% turns: a PID control. Stop it by Ctrl-C: however it ends, the wheels stop.

:- use_module(library(ev3dev)).
:- use_module(library(ev3dev/drive)).

%   Degrees a second for each percent, for each percent and second, and for
%   each percent a second.
gain(proportional, 1.6).
gain(integral, 0.3).
gain(derivative, 0.06).

%   How fast, in cm a second, and how often, in seconds.
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

%   Positive where it is too bright: the line is on the right.
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
    % Meanwhile it drives on.
    drive_wait([timeout(Period)], timeout),
    !,
    line_following(Eye, Error, Sum).
