% A program in the style of PLNXT's students: the robot looks around with
% triggers, and a loop reads the light sensor.
%
%   ?- start.
%
% It drives about on white for half a minute, turns aside before walls, and
% turns back where the floor is dark. Its first line finds plnxt.pl in this
% folder.

:- consult('plnxt.pl').

nxt_robot_definition(nxt, '/dev/rfcomm0', bt, on, 17.6, 10.6, 'B', 'C', 'A',
                     false, 'S4', 'S3', 'S2', 'S1').

start :-
    nxt_open,
    nxt_light_LED(activate, force),
    trigger_create(wall,
                   ( nxt_ultrasonic(Distance, force), Distance < 25 ),
                   [ nxt_stop, nxt_play_tone(880, 100), nxt_rotate(300, 100),
                     nxt_go(400) ],
                   inf),
    trigger_create(over, time_is_up, nxt_stop),
    timer_create(clock, 30, assertz(time_is_up)),
    nxt_go(400),
    look_at_the_floor,
    retractall(time_is_up),
    nxt_close.

:- dynamic time_is_up/0.

look_at_the_floor :-
    (   time_is_up
    ->  true
    ;   nxt_light(Light, force),
        react(Light),
        sleep(0.1),
        look_at_the_floor
    ).

react(Light) :-
    (   Light < 30
    ->  nxt_go_cm(-400, 15),
        nxt_rotate(300, 130),
        nxt_go(400)
    ;   true
    ).
