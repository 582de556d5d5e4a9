% The grid of grid_navigation.pl with the map and the planner on this
% machine, and the robot on another one.
%
%   ?- start(ssh('robot@ev3dev.local'), [3, 3]).
%
% Without a brick this starts a simulated robot in another process, if the
% pack is installed:
%
%   ?- start.
%
% The brick moves, looks, and notes the obstacles that it finds. Here, each
% plan is made and printed. A plan is one message to the brick, and one back.

:- use_module(library(ev3dev/bricks)).
:- use_module(grid_planner).

start :-
    Work = 'use_module(library(ev3dev/sim)),\c
            sim_start(grid, [clock(virtual)]),\c
            use_module(library(ev3dev/worker)),work',
    start(command(swipl, ['-q', '-g', Work, '-t', halt]), [3, 3]).

start(Where, Goal) :-
    setup_call_cleanup(brick_open(robot, Where),
                       drive(robot, Goal),
                       brick_close(robot)).

%!  drive(+Name, +Goal) is semidet.
%
%   Lead the far brick Name to a cell. It starts in the cell [0,0] and looks
%   along y.

drive(Name, Goal) :-
    far(Name, ( use_module(library(ev3dev/grid)),
                set_robot(5.6, 10.6, outB, outC),
                set_grid([]) )),
    go_on(Name, Goal, none).

go_on(Name, Goal, Known) :-
    far(Name, ( state_position(Cell, Direction),
                findall(Obstacle, obstructed(Obstacle), Obstacles) )),
    (   Obstacles == Known
    ->  format("cannot go on at ~w~n", [Cell]),
        fail
    ;   own_plan(known_free(Obstacles),
                 state(Cell, Direction), state(Goal, _), Plan)
    ->  format("at ~w, obstacles ~w: ~w~n", [Cell, Obstacles, Plan]),
        (   far(Name, execute_plan(Plan))
        ->  format("arrived at ~w~n", [Goal])
        ;   go_on(Name, Goal, Obstacles)
        )
    ;   format("there is no way to ~w~n", [Goal]),
        fail
    ).

known_free(Obstacles, [X, Y]) :-
    between(0, 7, X),
    between(0, 7, Y),
    \+ memberchk([X, Y], Obstacles).
