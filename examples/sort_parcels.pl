% A robot with a gripper that brings each parcel to the station of its color.
%
%   ?- start.
%
% Its gripper is at outA, and the color sensor at in3 looks ahead, between the
% jaws: the robot `carrier`. A parcel stays in sight while it is carried, so
% the rules need no memory for it.

:- use_module(library(ev3dev)).
:- use_module(library(ev3dev/drive)).
:- use_module(library(ev3dev/gripper)).
:- use_module(library(ev3dev/rules)).

% Where parcels wait, in cm from the start, and where each color belongs.
shelf(15, 50).
shelf(55, 50).
shelf(95, 50).
shelf(135, 50).

station(5, 15, -45).                    % red
station(4, 55, -45).                    % yellow
station(3, 95, -45).                    % green
station(2, 135, -45).                   % blue

:- dynamic visited/2.

% The most important rule comes first.
carry :: gripping, parcel(Color), station(Color, X, Y) ~> deliver(X, Y).
leave :: parcel(_), pose(_, Y, _), Y < 0 ~> go_cm(30, -25).
take  :: parcel(_) ~> go_cm(10, 2.2), grip.
fetch :: shelf(X, Y), \+ visited(X, Y) ~> fetch(X, Y).

parcel(Color) :-
    col_color(in3, Color),
    Color > 0.

% Along y, so that the jaws are not aslant.
deliver(X, Y) :-
    go_to(X, Y+30),
    go_to(X, Y),
    release.

fetch(X, Y) :-
    go_to(X, Y-35),
    assertz(visited(X, Y)),
    face(0),
    go_cm(15, 30).

start :-
    set_robot(5.6, 10.6, outB, outC),
    set_gripper(outA, []),
    retractall(visited(_, _)),
    set_pose(0, 0, 0),
    behave([carry, leave, take, fetch]).
