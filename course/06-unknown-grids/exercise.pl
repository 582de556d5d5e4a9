% A grid that the program does not know, another one in each run.

:- use_module(library(ev3dev/exercise)).

exercise(unknown_grids, [seconds(240), noise(true), seeds(1-10), cpu(30)]).

world(Seed, World) :-
    random_grid(Seed, [boxes(8-12), free([[7, 7]])], World).

score(partial(4), 'comes nearer to the cell [7, 7]', Share) :-
    ended_near(140-140, Cm),
    Share is 1 - (Cm-8)/190.
score(4, 'is there at the end') :-
    ended_near(140-140, Cm),
    Cm < 8.
score(2, 'touches nothing') :-
    collisions(0),
    path_length(Cm), Cm > 100.
