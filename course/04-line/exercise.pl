% A closed line, another one in each run.

:- use_module(library(ev3dev/exercise)).

exercise(line, [seconds(90), noise(true), seeds(1-10)]).

world(Seed, World) :-
    random_track(Seed, [radius(60)], World).

score(partial(6), 'of the lap', Share) :-
    lap_fraction(5, Share).
score(2, 'the whole lap') :-
    lap_fraction(5, Share),
    Share > 0.97.
score(2, 'the whole lap at 8 cm per second in the mean') :-
    lap_fraction(5, Share),
    Share > 0.97,
    path_length(Cm),
    duration(Seconds),
    Cm/Seconds > 8.
