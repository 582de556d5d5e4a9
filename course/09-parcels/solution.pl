% A robot with a gripper that brings four parcels to their stations. It looks
% for each with the ultrasonic sensor at in1.

:- use_module(library(ev3dev)).
:- use_module(library(ev3dev/drive)).
:- use_module(library(ev3dev/gripper)).

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
    forall(place(X, Y), ignore(bring(X, Y))).

bring(X, Y) :-
    fetch(X, Y),
    col_color(in3, Color),
    station(Color, StationX, StationY),
    deliver(StationX, StationY).

%   The sensor is 7 cm ahead of the middle of the robot, the jaws are 11 cm
%   ahead, and the parcel is 2.5 cm deep from its face to its middle.
fetch(X, Y) :-
    release,
    go_to(X, Y-27),
    look(Heading),
    face(Heading),
    us_dist_cm(in1, Cm),
    go_cm(20, Cm-1.5),
    grip.

%   The robot sees the parcel from several headings; it lies in the middle of
%   these. Others are farther away than 28 cm.
look(Heading) :-
    findall(Seen, seen(Seen), Headings),
    Headings = [First|_],
    last(Headings, Last),
    Heading is (First+Last)/2.

seen(Heading) :-
    between(-8, 8, Step),
    Heading is 5*Step,
    face(Heading),
    us_dist_cm(in1, Cm),
    Cm < 28.

deliver(X, Y) :-
    go_to(X, Y+35),
    face(180),
    go_cm(20, 24),
    release,
    go_cm(-20, 24).
