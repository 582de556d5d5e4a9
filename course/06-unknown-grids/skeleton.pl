% A robot that finds its way over an unknown grid, from the cell [0, 0] to [7,
% 7]. It looks before each move, and remembers obstacles in obstructed/1.

:- use_module(library(ev3dev)).
:- use_module(library(ev3dev/grid)).

start :-
    set_robot(5.6, 10.6, outB, outC),
    set_grid([]),
    plan_and_go_to([7, 7], _, [planner(plan)]).

%   plan(+Start, +Goal, -Plan), as in the last task. This planner knows nothing
%   of obstacles. The robot calls it again whenever it has seen one.
plan(state([X, Y], [0, 1]), state([GoalX, GoalY], _), Plan) :-
    Up is GoalY-Y,
    Right is GoalX-X,
    findall(move, between(1, Up, _), Ups),
    findall(move, between(1, Right, _), Rights),
    append(Ups, [right|Rights], Plan).
