% A robot that finds its way over a grid of cells it does not know.
%
%   ?- start([3, 3]).
%
% It plans a way to its goal, takes it, and looks before each move. Where its
% ultrasonic sensor sees something in the next cell it notes an obstacle and
% plans anew from where it stands. Cells are 20 cm wide; the robot starts in
% the cell [0,0] and looks along y. How plans are made is another file's
% business: grid_planner.pl.

:- use_module(library(ev3dev)).
:- use_module(grid_planner).

:- dynamic
    state_position/2,                   % Cell, Direction
    obstructed/1.                       % Cell

start :-
    start([3, 3]).

%!  start(+Goal) is semidet.
%
%   Go to a cell. Fails if there is no way.

start(Goal) :-
    set_robot(5.6, 10.6, outB, outC),
    retractall(obstructed(_)),
    set_state([0, 0], [0, 1]),
    (   plan_and_go_to(Goal, [0, 1])
    ->  format("arrived at ~w~n", [Goal])
    ;   format("there is no way to ~w~n", [Goal]),
        fail
    ).

%!  plan_and_go_to(+Cell, +Direction) is semidet.
%
%   Go to a cell and look in a direction there. Fails if what is known by then
%   leaves no way.

plan_and_go_to(Cell, Direction) :-
    state_position(Cell0, Direction0),
    plan(free_cell, state(Cell0, Direction0), state(Cell, Direction), Plan),
    format("at ~w: ~w~n", [Cell0, Plan]),
    (   execute_plan(Plan)
    ->  true
    ;   plan_and_go_to(Cell, Direction)
    ).

free_cell([X, Y]) :-
    between(0, 7, X),
    between(0, 7, Y),
    \+ obstructed([X, Y]).

%!  execute_plan(+Plan) is semidet.
%
%   Carry out the actions of a plan. Fails at the first that is not possible;
%   state_position/2 tells how far the robot has come.

execute_plan([]).
execute_plan([Action|Plan]) :-
    execute(Action),
    !,
    execute_plan(Plan).

execute(move) :-
    state_position([X0, Y0], [DX, DY]),
    X is X0 + DX,
    Y is Y0 + DY,
    is_free([X, Y]),
    go_cm(20, 20),
    set_state([X, Y], [DX, DY]).
execute(right) :-
    state_position(Cell, [DX, DY]),
    turn(20, 90),
    Left is -DX,
    set_state(Cell, [DY, Left]).
execute(left) :-
    state_position(Cell, [DX, DY]),
    turn(20, -90),
    Left is -DY,
    set_state(Cell, [Left, DX]).

%!  is_free(+Cell) is semidet.
%
%   True if nothing stands in the cell before the robot; else noted.

is_free(Cell) :-
    us_dist_cm(_, Distance),
    (   Distance > 20
    ->  true
    ;   format("obstacle in ~w~n", [Cell]),
        assertz(obstructed(Cell)),
        fail
    ).

set_state(Cell, Direction) :-
    retractall(state_position(_, _)),
    assertz(state_position(Cell, Direction)).
