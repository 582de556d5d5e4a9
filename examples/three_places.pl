% A robot visits three places, and drives around what is in its way: a
% controller of three layers, as a logic program over time.
%
%   ?- start.
%
% It needs two large motors and an ultrasonic sensor that points ahead. It
% begins at 30, 30 and looks to the north. Stop it with Ctrl-C.
%
% After David Poole, Logic Programming for Robot Control, 1995.

:- use_module(library(ev3dev)).
:- use_module(library(ev3dev/drive)).
:- use_module(library(ev3dev/layers)).

% The next place.
:- layer(places).

assign(to_do, [80-40, 170-90, 60-150]) <- \+ was(to_do, _, _).
assign(to_do, Places)                  <- was(to_do, [_|Places], _), arrived.
assign(goal, Place)                    <- val(to_do, [Place|_]).

arrived <-
    was(goal, X-Y, _),
    sense(pose, pose(X1, Y1, _)),
    sqrt((X - X1)^2 + (Y - Y1)^2) < 6.

finished <- val(to_do, []).

% Where to steer: away from an obstacle, and a little beyond it, else to the
% goal.
:- layer(steering).

near <- sense(us_dist_cm, Distance), Distance < 24.

assign(met, obstacle) <- near.

met_since(Seconds) <-
    was(met, obstacle, Then),
    sense(time, Now),
    Seconds is Now - Then.

turning <- near.
turning <- met_since(Seconds), Seconds < 0.3.
passing <- met_since(Seconds), Seconds < 1.4, \+ turning.

steer(away)      <- turning.
steer(ahead)     <- passing.
steer(to(Angle)) <- \+ turning, \+ passing, angle_to_goal(Angle).

angle_to_goal(Angle) <-
    val(goal, X-Y),
    sense(pose, pose(X1, Y1, Heading)),
    Turn is atan2(X - X1, Y - Y1) * 180 / pi - Heading,
    heading_wrapped(Turn, Angle).

% How fast each wheel turns.
:- layer(wheels).

wheels(30, -30) <- steer(away).
wheels(35, 35)  <- steer(ahead).
wheels(L, R)    <-
    steer(to(Angle)),
    Turn is max(-25, min(25, Angle)),
    Speed is max(5, 30 - abs(Turn)),
    L is Speed + Turn,
    R is Speed - Turn.

set(outB, Speed) <- wheels(Speed, _).
set(outC, Speed) <- wheels(_, Speed).

start :-
    set_robot(5.6, 10.6, outB, outC),
    set_pose(30, 30, 0),
    control([until(finished)]).
