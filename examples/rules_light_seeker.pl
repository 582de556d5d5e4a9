% A robot that seeks the light, and flees when it is dazzled.
%
%   ?- start.
%
% Two color sensors are its eyes, the left one at in2, the right one at in3.
% An ultrasonic sensor points ahead. Stop it with Ctrl-C.

:- use_module(library(ev3dev)).
:- use_module(library(ev3dev/drive)).
:- use_module(library(ev3dev/rules)).

avoid :: us_dist_cm(_, D), D < 20 ~> turn(30).

% The action waits, so it is not interrupted by seek and search.
flee  :: dazzled ~> tone(880, 100), turn(40, 180), go_cm(40, 60).

% steer/2 does not wait. So to_light/2 is called again when Left or Right
% changes.
seek  :: eyes(Left, Right), Left + Right > 14 ~> to_light(Left, Right).

% The actions of a list take turns: turn for 4 s, drive for 2 s, and again.
search :: true ~> [turn(20):4, go(30):2].

eyes(Left, Right) :-
    col_ambient(in2, Left),
    col_ambient(in3, Right).

dazzled :-
    eyes(Left, Right),
    max(Left, Right) > 55.

%   The more light there is on the right, the more to the right.
to_light(Left, Right) :-
    Direction is max(-60, min(60, 300 * (Right - Left) / (Right + Left))),
    steer(30, Direction).

start :-
    set_robot(5.6, 10.6, outB, outC),
    behave([avoid, flee, seek, search]).
