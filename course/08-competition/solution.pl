% The post, for two rounds.

:- use_module(library(ev3dev)).
:- use_module(library(ev3dev/drive)).

start :-
    set_robot(5.6, 10.6, outB, outC),
    drive(none, 8),
    stop.

%   The last station is remembered, so that each is called out once.
drive(_, 0) :-
    !.
drive(Last, Left0) :-
    (   col_color(in3, Color),
        station(Color, Station),
        Station \== Last
    ->  say(Station),
        Left is Left0-1,
        Next = Station
    ;   Left = Left0,
        Next = Last
    ),
    control,
    drive(Next, Left).

station(5, red).
station(4, yellow).
station(3, green).
station(2, blue).

control :-
    col_reflect(in2, Light),
    Rate is 1.5*(Light-50),
    drive_cm(22, Rate, [acceleration(100)]),
    ignore(drive_wait([timeout(0.02)], timeout)).
