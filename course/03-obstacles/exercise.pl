% A room with boxes, another one in each run.

:- use_module(library(ev3dev/exercise)).

exercise(obstacles, [seconds(60), noise(true), seeds(1-10)]).

world(Seed, World) :-
    random_room(Seed, [boxes(3-5), pillars(0)], World).

score(partial(4), 'gets around: 14 squares of 30 cm', Share) :-
    cells_visited(30, Count),
    Share is (Count-1)/13.
score(5, 'touches nothing while it does') :-
    collisions(0),
    cells_visited(30, Count),
    Count >= 8.
score(1, 'is still under way at the end') :-
    ended(over),
    cells_visited(30, Count),
    Count >= 8.
