% A traffic light that turns green when somebody presses the middle button.
%
%   ?- start.
%
% The brick shows the color by its lights, its screen and its speaker. Any
% other button ends the program.

:- use_module(library(ev3dev)).

%!  start is semidet.
%
%   Be a traffic light until somebody presses a button other than `enter`.
%   Fails if the brick lacks buttons, lights, a speaker or a screen.

start :-
    show(red),
    button_wait(Key, pressed),
    (   Key == enter
    ->  turn_green,
        start
    ;   switch_off
    ).

turn_green :-
    tone(880, 100),
    wait(0.9),
    show(amber),
    wait(1),
    show(green),
    forall(between(1, 5, _), tick),
    show(amber),
    wait(1).

tick :-
    tone(1200, 50),
    wait(0.45).

%!  show(+Color) is semidet.
%
%   Show one of the three colors.

show(Color) :-
    forall(member(Light, [left, right]), led(Light, Color)),
    screen_clear,
    screen_rectangle(20, 1, 50, 126, [width(2)]),
    forall(lamp(_, Y, _), screen_circle(45, Y, 17)),
    lamp(Color, Height, Word),
    screen_circle(45, Height, 17, [fill(true)]),
    screen_text(125, 54, Word, [font(large), align(center)]),
    screen_show.

lamp(red,    22,  'Stop').
lamp(amber,  64,  'Ready').
lamp(green, 106,  'Go').

switch_off :-
    forall(member(Light, [left, right]), led(Light, off)),
    screen_clear,
    screen_show.
