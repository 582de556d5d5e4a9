% The post. The left eye, in2, follows the left edge of the track; the right
% eye, in3, sees the stations: red, yellow, green and blue.

:- use_module(library(ev3dev)).
:- use_module(library(ev3dev/drive)).

start :-
    set_robot(5.6, 10.6, outB, outC),
    drive(none).

%   The last station is remembered, so that each is called out once.
drive(Last) :-
    station(Station),
    !,
    (   Station == Last
    ->  true
    ;   say(Station)
    ),
    control,
    drive(Station).
drive(Last) :-
    control,
    drive(Last).

station(red) :-
    col_color(in3, 5).                  % and the other three?

control :-
    col_reflect(in2, Light),
    Rate is 1.5*(Light-50),
    drive_cm(10, Rate, [acceleration(100)]),
    ignore(drive_wait([timeout(0.02)], timeout)).
