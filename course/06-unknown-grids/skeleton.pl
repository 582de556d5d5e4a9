% A robot that finds its way over an unknown grid, from the cell [0, 0] to [7,
% 7]. It looks before each move, and remembers obstacles in obstructed/1.

:- use_module(library(ev3dev)).
:- use_module(library(ev3dev/grid)).

start :-
    set_robot(5.6, 10.6, outB, outC),
    set_grid([]),
    plan_and_go_to([7, 7], _, [planner(up_and_right)]).

%   This planner knows nothing of obstacles. The robot asks it again whenever
%   it has seen one.
up_and_right(state([X, Y], Direction), state([GoalX, GoalY], _), Plan) :-
    Up is GoalY-Y,
    Right is GoalX-X,
    Direction = [0, 1],
    findall(move, between(1, Up, _), Ups),
    findall(move, between(1, Right, _), Rights),
    append(Ups, [right|Rights], Plan).
