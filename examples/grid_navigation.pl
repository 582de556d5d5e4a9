% A robot that finds its way over a grid of cells it does not know.
%
%   ?- start([3, 3]).
%
% It plans a way to its goal, takes it, and looks before each move. Where its
% ultrasonic sensor sees something in the next cell it notes an obstacle and
% plans anew from where it stands. Cells are 20 cm wide; the robot starts in
% the cell [0,0] and looks along y.
%
% How plans are made is another matter: by one of library(ev3dev/planners), or
% by a planner of one's own, such as that in grid_planner.pl:
%
%   ?- start([3, 3], a_star).
%   ?- start([3, 3], own_plan(free_cell)).

:- use_module(library(ev3dev)).
:- use_module(library(ev3dev/grid)).
:- use_module(grid_planner).

start :-
    start([3, 3]).

start(Goal) :-
    start(Goal, d_star_lite).

%!  start(+Goal, :Planner) is semidet.
%
%   Go to a cell. Fails if the robot does not get there.

start(Goal, Planner) :-
    set_robot(5.6, 10.6, outB, outC),
    set_grid([]),
    plan_and_go_to(Goal, [0, 1],
                   [planner(Planner), tell(tell), reason(Reason)]),
    tell(Reason, Goal),
    Reason == reached.

%   What happens on the way, and how it ended.

tell(plan(state(Cell, _), Plan)) :-
    format("at ~w: ~w~n", [Cell, Plan]).
tell(obstacle(Cell)) :-
    format("obstacle in ~w~n", [Cell]).

tell(reached, Goal) :-
    format("arrived at ~w~n", [Goal]).
tell(no_way, Goal) :-
    format("there is no way to ~w~n", [Goal]).
tell(Reason, Goal) :-
    \+ memberchk(Reason, [reached, no_way]),
    format("cannot go on to ~w: ~w~n", [Goal, Reason]).

%   For a planner of one's own: cells into which the robot may go, as far as
%   it knows.

free_cell([X, Y]) :-
    between(0, 7, X),
    between(0, 7, Y),
    \+ obstructed([X, Y]).
