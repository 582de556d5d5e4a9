/*  The installed pack's example finds a way over its grid.

        swipl -g main -t 'halt(1)' tests/brick/example.pl
*/

:- use_module(library(ev3dev)).
:- module_property(ev3dev, file(File)),
   file_directory_name(File, Prolog),
   file_directory_name(Prolog, Pack),
   atom_concat(Pack, '/examples/grid_navigation.pl', Example),
   user:load_files(Example, []).

main :-
    plan(free_cell, state([0, 0], [0, 1]), state([3, 3], [0, 1]), Plan),
    format('~w~n', [Plan]),
    findall(move, member(move, Plan), Moves),
    length(Moves, 6),
    halt(0).
