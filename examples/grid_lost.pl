% A robot on the grid of the paper's section 6. It knows the map, but not its
% own cell. It looks and moves until only one cell is possible, and then goes
% to its goal.
%
%   ?- start([0, 0]).
%
% In the simulator this is the world `grid`. Place the robot in the middle of
% any free cell, in a direction of the grid.

:- use_module(library(ev3dev)).
:- use_module(library(ev3dev/grid)).
:- use_module(library(ev3dev/grid_belief)).

obstacles([ [1, 1], [0, 3], [2, 2], [2, 3], [4, 3], [3, 5], [5, 1], [6, 4],
            [1, 6], [5, 6] ]).

start :-
    start([0, 0]).

%!  start(+Goal) is semidet.
%
%   Find out where the robot is, and go to the cell Goal.

start(Goal) :-
    set_robot(5.6, 10.6, outB, outC),
    obstacles(Obstacles),
    grid_map([obstacles(Obstacles)], Map),
    grid_localize(Map, state(Cell, Direction), [tell(show)]),
    format("I am in ~w and look to ~w~n", [Cell, Direction]),
    set_grid([start(Cell, Direction), obstacles(Obstacles)]),
    plan_and_go_to(Goal, _).

%   The number of states that are still probable.

show(Free, Belief) :-
    grid_belief_entropy(Belief, Bits),
    grid_belief_best(Belief, state(Cell, _), Probability),
    format("~w free: ~1f bits, best ~w with ~2f~n",
           [Free, Bits, Cell, Probability]).
