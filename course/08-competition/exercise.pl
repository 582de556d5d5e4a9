% The post: a track with four stations, each a piece of colored floor on the
% right of the track. The robot must call them out when it passes, for two
% rounds; the faster, the better.

:- use_module(library(ev3dev/exercise)).

exercise(competition, [seconds(150), noise(true), seeds(1-5), cpu(30)]).

world(_, delivery).

rounds([red, yellow, green, blue, red, yellow, green, blue]).

score(partial(6), 'of the stations of two rounds, in their order', Share) :-
    in_order(Count),
    Share is Count/8.
score(partial(2), 'two rounds in less than 120 s; all points for 50 s',
      Share) :-
    in_order(8),
    duration(Seconds),
    Share is (120-Seconds)/70.
score(2, 'touches nothing while it does') :-
    in_order(Count),
    Count >= 4,
    collisions(0).

%   The number of stations that were called out before a wrong one.
in_order(Count) :-
    findall(Text, said(Text), Said),
    rounds(Stations),
    in_order(Said, Stations, 0, Count).

in_order([Station|Said], [Station|Stations], Count0, Count) :-
    !,
    Count1 is Count0+1,
    in_order(Said, Stations, Count1, Count).
in_order(_, _, Count, Count).
