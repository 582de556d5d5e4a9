% A robot that explores an unknown room, draws a map, and uses it to drive
% home.
%
%   ?- start.
%
% In the simulator this is the world `room`. The map is drawn into the file
% explored.svg, and explored.pl is a world that can be simulated:
% sim_start('explored.pl').

:- use_module(library(ev3dev)).
:- use_module(library(ev3dev/drive)).
:- use_module(library(ev3dev/map)).
:- use_module(library(ev3dev/roadmap)).

start :-
    start('explored').

%!  start(+File) is semidet.
%
%   File is the name of the picture and of the world, without extension.

start(File) :-
    set_robot(5.6, 10.6, outB, outC),
    set_pose(0, 0, 0),
    explore([reason(Reason)]),
    map_stop,
    atom_concat(File, '.svg', Picture),
    atom_concat(File, '.pl', World),
    map_svg(Picture),
    map_save(World),
    map_facts(Facts),
    length(Facts, Count),
    format("~w: ~w facts~n", [Reason, Count]),
    home(Facts).

home(Map) :-
    pose(X, Y, _),
    (   roadmap_path(Map, X-Y, 0-0, [_|Points])
    ;   roadmap_path(Map, X-Y, 0-0, [_|Points], [radius(6), margin(0.5)])
    ),
    !,
    forall(member(A-B, Points), go_to(A, B, [speed(cm_per_s(18))])),
    writeln('at home').
