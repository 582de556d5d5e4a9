% A robot that knows its room, but not its place. It finds its place, and
% drives from place to place by the map. If you carry it away, it notices that
% and finds its place again.
%
%   ?- start.
%   ?- start([60-60, 240-200]).
%
% In the simulator this is the world `room`. The map is that world.

:- use_module(library(ev3dev)).
:- use_module(library(ev3dev/drive)).
:- use_module(library(ev3dev/localize)).
:- use_module(library(ev3dev/roadmap)).

start :-
    start([40-210, 250-210, 250-40, 40-40]).

%!  start(+Places) is semidet.
%
%   Go to Places, one after the other. Fails if a place cannot be reached.

start(Places) :-
    set_robot(5.6, 10.6, outB, outC),
    localize_start(room, [correct_odometry(true)]),
    find_out,
    forall(member(Place, Places), visit(Place)),
    localize_stop.

%   If two places look alike, it sees the difference from another place.

find_out :-
    localize_scan([turns(2), reason(_)]),
    localized(Confidence),
    (   Confidence > 0.6
    ->  localized_pose(X, Y, Heading, _),
        format("I am at ~0f, ~0f and look to ~0f degrees: ~0f % sure~n",
               [X, Y, Heading, 100*Confidence])
    ;   us_dist_cm(_, Free),
        (   Free > 40
        ->  go_cm(30, 20, [reason(_)])
        ;   turn(30, 120, [reason(_)])
        ),
        find_out
    ).

visit(Place) :-
    pose(X, Y, _),
    (   roadmap_path(room, X-Y, Place, [_|Points])
    ;   roadmap_path(room, X-Y, Place, [_|Points], [margin(0.5)])
    ),
    !,
    legs(Points, Place).

%   It drives in small steps, so that it soon notices that it is lost.

legs([], X-Y) :-
    format("at ~w, ~w~n", [X, Y]).
legs([X-Y|Points], Place) :-
    go_to(X, Y, [speed(cm_per_s(18)), reason(Reason)]),
    localized(Confidence),
    (   Confidence < 0.35
    ->  writeln('Where am I?'),
        find_out,
        visit(Place)
    ;   Reason == reached
    ->  legs(Points, Place)
    ;   go_cm(20, -5, [reason(_)]),
        visit(Place)
    ).
