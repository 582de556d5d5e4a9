% A robot that goes on until something is in its way, and then turns aside.
%
%   ?- start.
%
% It needs two large motors and an ultrasonic sensor that looks ahead, at
% whichever port; a gyro makes its turns exact. Stop it by Ctrl-C: however it
% ends, the wheels stop.

:- use_module(library(ev3dev)).

start :-
    set_robot(5.6, 10.6, outB, outC),
    setup_call_cleanup(
        true,
        obstacle_avoidance,
        ignore(stop)).

obstacle_avoidance :-
    (   us_dist_cm(_, Distance),
        Distance > 50
    ->  go(20)
    ;   turn(20, 90)
    ),
    !,
    obstacle_avoidance.
