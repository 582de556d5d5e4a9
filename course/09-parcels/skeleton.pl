% A robot with a gripper at outA that brings parcels to their stations. The
% color sensor at in3 looks at what lies between the jaws.

:- use_module(library(ev3dev)).
:- use_module(library(ev3dev/drive)).
:- use_module(library(ev3dev/gripper)).

% Where a parcel waits, and where each color belongs.
place(40, 125).
place(80, 125).
place(120, 125).
place(160, 125).

station(5, 40, 25).                     % red
station(4, 80, 25).                     % yellow
station(3, 120, 25).                    % green
station(2, 160, 25).                    % blue

start :-
    set_robot(5.6, 10.6, outB, outC),
    set_gripper(outA, []),
    set_pose(25, 75, 0),
    fetch(40, 125),
    deliver(40, 25).                    % and if it is not red?

%   The jaws are 11 cm ahead of the middle of the robot.
fetch(X, Y) :-
    release,
    go_to(X, Y-35),
    face(0),
    go_cm(20, 24),
    grip.

deliver(X, Y) :-
    go_to(X, Y+35),
    face(180),
    go_cm(20, 24),
    release,
    go_cm(-20, 24).
