% A grid that the program does not know, another one in each run.

:- use_module(library(ev3dev/exercise)).

exercise(unknown_grids, [seconds(240), noise(true), seeds(1-10), cpu(30)]).

%   The walls are so far away that a robot which is 2 cm off does not touch them.
world(Seed, [bounds(-14, -14, 154, 154)|World]) :-
    random_grid(Seed, [boxes(8-12), free([[7, 7]])], World0),
    select(bounds(_, _, _, _), World0, World).

score(partial(2), 'comes nearer to the cell [7, 7]', Share) :-
    ended_near(140-140, Cm),
    Share is 1 - (Cm-8)/190.
score(4, 'is there at the end') :-
    there.
score(2, 'touches nothing on its way there') :-
    there,
    collisions(0).
score(2, 'takes less than 80 s') :-
    there,
    duration(Seconds),
    Seconds < 80.

there :-
    ended_near(140-140, Cm),
    Cm < 8.
