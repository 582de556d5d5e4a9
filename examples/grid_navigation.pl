% A robot that finds its path over an unknown grid of cells.
%
%   ?- start([3, 3]).
%
% It plans a path to its goal, follows it, and looks before each move. If its
% ultrasonic sensor sees something in the next cell, it adds an obstacle to
% the map and plans again from its cell. Cells are 20 cm wide; the robot
% starts in the cell [0,0] and looks along y.
%
% The planner is one of library(ev3dev/planners), or another program, such as
% that in grid_planner.pl:
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

%   Messages during the drive and at its end.

tell(plan(state(Cell, _), Plan)) :-
    format("at ~w: ~w~n", [Cell, Plan]).
tell(obstacle(Cell)) :-
    format("obstacle in ~w~n", [Cell]).

tell(reached, Goal) :-
    !,
    format("arrived at ~w~n", [Goal]).
tell(no_way, Goal) :-
    !,
    format("there is no way to ~w~n", [Goal]).
tell(Reason, Goal) :-
    format("cannot go on to ~w: ~w~n", [Goal, Reason]).

%   True if the robot may enter a cell, as far as it knows. The planner of
%   grid_planner.pl calls this.

free_cell([X, Y]) :-
    between(0, 7, X),
    between(0, 7, Y),
    \+ obstructed([X, Y]).
