% A traffic light that turns green for whoever presses the key in the middle.
%
%   ?- start.
%
% The brick's lights, its screen and its speaker tell what it shows. Any other
% key ends the program.

:- use_module(library(ev3dev)).

%!  start is semidet.
%
%   Be a traffic light until a key but `enter` is pressed. Fails if this is no
%   brick with keys, lights, a speaker and a screen.

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
    pause(900),
    show(amber),
    pause(1000),
    show(green),
    forall(between(1, 5, _), tick),
    show(amber),
    pause(1000).

tick :-
    tone(1200, 50),
    pause(450).

%   sleep/1 would do as well, but simulated time knows nothing of it.
pause(Milliseconds) :-
    Tempo is 60000 / Milliseconds,
    tones([rest(quarter)], [tempo(Tempo)]).

%!  show(+Colour) is semidet.
%
%   Show one of the three colours.

show(Colour) :-
    forall(member(Light, [left, right]), led(Light, Colour)),
    screen_clear,
    screen_rectangle(20, 1, 50, 126, [width(2)]),
    forall(lamp(_, Y, _), screen_circle(45, Y, 17)),
    lamp(Colour, Height, Word),
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
