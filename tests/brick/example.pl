/*  The installed pack's example plans a way over its grid.

        swipl -g main -t 'halt(1)' tests/brick/example.pl
*/

:- use_module(library(ev3dev)).
:- use_module(library(ev3dev/planners), [grid_map/2, grid_problem/4, planner/1]).
:- module_property(ev3dev, file(File)),
   file_directory_name(File, Prolog),
   file_directory_name(Prolog, Pack),
   atom_concat(Pack, '/examples/grid_navigation.pl', Example),
   user:load_files(Example, []).

main :-
    Start = state([0, 0], [0, 1]),
    Goal = state([3, 3], [0, 1]),
    plan(free_cell, Start, Goal, Own),
    format('~w~n', [Own]),
    moves(Own),
    grid_map([], Map),
    grid_problem(Map, Start, Goal, Problem),
    forall(planner(Planner),
           ( ev3dev_planners:plan(Planner, Problem, Plan),
             format('~w: ~w~n', [Planner, Plan]),
             moves(Plan)
           )),
    halt(0).

moves(Plan) :-
    findall(move, member(move, Plan), Moves),
    length(Moves, 6).
