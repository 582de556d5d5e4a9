% A robot that finds the ball, grips it, and puts it into the goal.
%
%   ?- start.
%
% The goal is 160 cm ahead of the start. The ultrasonic sensor points ahead,
% and the gripper is at outA: the robot `carrier`.

:- use_module(library(ev3dev)).
:- use_module(library(ev3dev/drive)).
:- use_module(library(ev3dev/gripper)).

start :-
    set_robot(5.6, 10.6, outB, outC),
    set_gripper(outA, []),
    set_pose(0, 0, 0),
    look(60, 65, Far),
    go_cm(30, Far-15),
    look(30, 25, Near),
    go_cm(15, Near-1),                  % Now it is between the jaws.
    grip,
    go_to(0, 120),
    go_to(0, 155),
    release,
    go_cm(30, -20).

%   Look around, Angle degrees to both sides, and face what is nearer than
%   Limit. The robot sees the ball from several headings; it lies in the
%   middle of these.
look(Angle, Limit, Cm) :-
    pose(_, _, Ahead),
    From is Ahead-Angle,
    To is Ahead+Angle,
    findall(Heading, seen(From, To, Limit, Heading), Headings),
    sum_list(Headings, Sum),
    length(Headings, Count),
    Count > 0,
    Middle is Sum/Count,
    face(Middle),
    us_dist_cm(in1, Cm).

%   True of each Heading in steps of 5 degrees at which something is near.
seen(From, To, Limit, Heading) :-
    Steps is round((To-From)/5),
    between(0, Steps, Step),
    Heading is From + 5*Step,
    face(Heading),
    us_dist_cm(in1, Cm),
    Cm < Limit.
