% A room with boxes, another one in each run.

:- use_module(library(ev3dev/exercise)).

exercise(obstacles, [seconds(60), noise(true), seeds(1-10)]).

world(Seed, World) :-
    random_room(Seed, [boxes(3-5), pillars(0)], World).

score(partial(5), 'explores: visits 32 squares of 30 cm', Share) :-
    cells_visited(30, Count),
    Share is (Count-1)/31.
%   Ultrasound misses some corners: a good robot touches one or two, one that
%   turns too late touches five.
score(4, 'touches something at most twice while it visits 18 squares') :-
    explored,
    collisions(Count),
    Count =< 2.
score(1, 'still moves at the end') :-
    explored,
    ended(over).

explored :-
    cells_visited(30, Count),
    Count >= 18.
