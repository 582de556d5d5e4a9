% A robot that drives through a room and knows only a part of it.
%
%   ?- start.
%   ?- start(260-40).
%
% Its map has the walls and one box. It finds a second box and a pillar with
% its ultrasonic sensor: it drives only where it has looked, and plans again
% with each new obstacle. Place it at start/3 of the map. In the simulator
% this is the world `room`.

:- use_module(library(ev3dev)).
:- use_module(library(ev3dev/drive)).
:- use_module(library(ev3dev/roadmap)).

%   The map that the robot gets, in cm, and its pose at the start.

known_map([ bounds(0, 0, 300, 250),
            box(90, 165, 40, 25, 20)
          ]).

stands(40, 40, 40).

start :-
    start(260-210).

%!  start(+Goal) is semidet.
%
%   Go from the start of the map to a place, X-Y. Fails if the robot cannot
%   reach it.

start(Goal) :-
    set_robot(5.6, 10.6, outB, outC),
    known_map(Map),
    stands(X, Y, Heading),
    set_pose(X, Y, Heading),
    navigate_to(Map, Goal, [reason(Reason), obstacles(Found)]),
    length(Found, Count),
    format("~w; found ~w pieces of obstacles~n", [Reason, Count]),
    Reason == reached.

%!  picture(+Goal, +File) is semidet.
%
%   Draw the path to a place over the map to an SVG file. The picture has only
%   the obstacles of the map.

picture(Goal, File) :-
    known_map(Map),
    stands(X, Y, _),
    roadmap_svg(Map, X-Y, Goal, File, []).
