% A square of 60 cm, clockwise, from the lower left corner and back.

:- use_module(library(ev3dev/exercise)).

exercise(first_moves, [seconds(60), noise(true), seeds(1-5)]).

world(_, [bounds(0, 0, 160, 160), start(50, 50, 0)]).

score(2, 'is at the second corner (110, 110)') :-
    time_to(110-110, 5, _).
score(3, 'is at all corners, clockwise') :-
    all_corners.
score(3, 'is back at the start, within 4 cm') :-
    all_corners,
    ended_near(50-50, Cm),
    Cm < 4.
score(2, 'touches nothing on the way, and ends by itself') :-
    all_corners,
    collisions(0),
    ended(exit(0)).

all_corners :-
    time_to(50-110, 5, First),
    time_to(110-110, 5, Second),
    time_to(110-50, 5, Third),
    First < Second,
    Second < Third.
