% A robot that drives until it sees an obstacle, and then turns aside.
%
%   ?- start.
%
% It needs two large motors and, at any port, an ultrasonic sensor that points
% ahead; a gyro makes its turns exact. Stop it with Ctrl-C: the wheels always
% stop at the end.

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
