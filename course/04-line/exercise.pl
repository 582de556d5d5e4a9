% A closed line, another one in each run.

:- use_module(library(ev3dev/exercise)).

exercise(line, [seconds(60), noise(true), seeds(1-10)]).

world(Seed, World) :-
    random_track(Seed, [radius(60)], World).

score(partial(5), 'of the lap, within 3 cm of the line', Share) :-
    lap_fraction(3, Share).
score(1, 'the whole lap') :-
    lap.
score(2, 'the whole lap, and does not shake') :-
    lap,
    smooth.
score(2, 'the same at 15 cm per second') :-
    lap,
    smooth,
    path_length(Cm),
    duration(Seconds),
    Cm/Seconds > 15.

lap :-
    lap_fraction(3, Share),
    Share > 0.97.

%   The line turns by 1 to 1.5 degrees per cm.
smooth :-
    path_turns(Degrees),
    path_length(Cm),
    Degrees/Cm < 2.
