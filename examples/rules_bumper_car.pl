% leJOS's bumper car: it drives on, and turns away from walls.
%
%   ?- start.
%
% In leJOS this is two classes with takeControl, action and suppress, and an
% Arbitrator. Here takeControl is the guard, and suppress needs no code: a
% move that is interrupted stops by itself. The first rule is the most
% important; in leJOS the last behavior is.
%
% It needs two large motors and an ultrasonic sensor that points ahead; a
% touch sensor helps, too. Stop it with Ctrl-C.

:- use_module(library(ev3dev)).
:- use_module(library(ev3dev/rules)).

detect_wall   :: wall_ahead ~> go_cm(30, -15), turn(30, 100).
drive_forward :: true       ~> go(40).

wall_ahead :-
    us_dist_cm(_, Distance),
    Distance < 20.
wall_ahead :-
    touch_sensor(Port),
    touch(Port, 1).

start :-
    set_robot(5.6, 10.6, outB, outC),
    behave([detect_wall, drive_forward]).
