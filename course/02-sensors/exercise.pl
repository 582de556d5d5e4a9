% A lamp in a dark hall, ahead of the robot and to one side.

:- use_module(library(ev3dev/exercise)).

exercise(sensors, [seconds(60), noise(true), seeds(1-10)]).

world(Seed, [ bounds(0, 0, 300, 300), ambient(5), lamp(X, Y, 25),
              start(150, 60, 0) ]) :-
    lamp_at(Seed, X, Y).

%   So far to a side that nobody comes within 25 cm who drives straight ahead.
lamp_at(Seed, X, Y) :-
    X is 150 + (1 - Seed mod 2 * 2)*(45 + Seed*31 mod 40),
    Y is 170 + Seed*37 mod 80.

score(partial(2), 'comes nearer to the lamp', Share) :-
    lamp(Lamp),
    nearest(Lamp, Near),
    distance(150-60, Lamp, Far),
    Share is (Far-Near)/(Far-25).
score(3, 'comes within 25 cm of it') :-
    lamp(Lamp),
    time_to(Lamp, 25, _).
score(2, 'touches nothing') :-
    lamp(Lamp),
    time_to(Lamp, 25, _),
    collisions(0).
score(3, 'is within 40 cm of it at the end') :-
    lamp(Lamp),
    time_to(Lamp, 25, _),
    ended_near(Lamp, Cm),
    Cm < 40.

%   The lamp of this run.
lamp(X-Y) :-
    run_world(Facts),
    memberchk(lamp(X, Y, _), Facts).

nearest(Lamp, Near) :-
    between(1, 300, Near),
    time_to(Lamp, Near, _),
    !.

distance(X-Y, X1-Y1, Distance) :-
    Distance is sqrt((X1-X)**2 + (Y1-Y)**2).
