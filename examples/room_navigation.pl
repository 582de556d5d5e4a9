% A robot that drives through a room of which it knows but a part.
%
%   ?- start.
%   ?- start(260-40).
%
% It is told of the walls and of one box. A second box and a pillar it finds
% with its ultrasonic sensor: it goes only where it has looked, and plans anew
% with what it has seen. Place it where start/3 of the map says. In the
% simulator that is the world `room`.

:- use_module(library(ev3dev)).
:- use_module(library(ev3dev/drive)).
:- use_module(library(ev3dev/roadmap)).

%   What the robot is told of, in cm, and where it stands and looks.

told([ bounds(0, 0, 300, 250),
       box(90, 165, 40, 25, 20)
     ]).

stands(40, 40, 40).

start :-
    start(260-210).

%!  start(+Goal) is semidet.
%
%   Go from where the robot stands first to a place, X-Y. Fails if it cannot
%   be reached.

start(Goal) :-
    set_robot(5.6, 10.6, outB, outC),
    told(Map),
    stands(X, Y, Heading),
    set_pose(X, Y, Heading),
    navigate_to(Map, Goal, [reason(Reason), obstacles(Found)]),
    length(Found, Count),
    format("~w; found ~w pieces of obstacles~n", [Reason, Count]),
    Reason == reached.

%!  picture(+Goal, +File) is semidet.
%
%   Draw the way to a place as it looks with what the robot is told: an SVG
%   file.

picture(Goal, File) :-
    told(Map),
    stands(X, Y, _),
    roadmap_svg(Map, X-Y, Goal, File, []).
