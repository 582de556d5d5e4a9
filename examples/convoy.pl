% Three robots in a column: the first one drives at changing speeds, and the
% others keep their distance.
%
%   ?- start.
%
% The first one reports its speed to the others, ten times a second, so they
% brake when it brakes. Each corrects its distance by its own ultrasonic
% sensor.

:- use_module(library(ev3dev)).
:- use_module(library(ev3dev/bricks)).
:- use_module(library(ev3dev/sim)).

start :-
    start([]).

%   Options are those of sim_start/2.

start(Options) :-
    setup_call_cleanup(
        sim_start(convoy, [ clock(virtual),
                            robots([ first-default, second-default,
                                     third-default ])
                          | Options ]),
        ( bricks_do(drive), report ),
        forall(member(Name, [first, second, third]), brick_close(Name))).

drive :-
    set_robot(5.6, 10.6, outB, outC),
    use_brick(Name),
    (   Name == first
    ->  lead
    ;   keep_up(0)
    ).

%   Speeds in percent, and seconds.

lead :-
    forall(member(Speed-Seconds, [20-3, 45-4, 10-2, 35-3, 0-2]),
           lead(Speed, Seconds)),
    send_both(over).

lead(Speed, Seconds) :-
    go(Speed),
    Count is Seconds*10,
    forall(between(1, Count, _), ( send_both(speed(Speed)), wait(0.1) )).

send_both(Message) :-
    forall(member(To, [second, third]), robot_send(To, Message)).

%   It keeps 25 cm; each cm more or less changes the speed by 2 percent.

keep_up(Speed0) :-
    (   robot_receive(first, Message, [timeout(0)])
    ->  true
    ;   Message = speed(Speed0)
    ),
    (   Message = speed(Speed)
    ->  us_dist_cm(in1, Distance),
        Own is max(-30, min(100, Speed + 2*(Distance-25))),
        go(Own),
        wait(0.05),
        keep_up(Speed)
    ;   stop
    ).

report :-
    findall(Y, ( member(Name, [first, second, third]),
                 with_brick(Name, sim_pose(_, Y, _)) ),
            [First, Second, Third]),
    Ahead is First-Second,
    Behind is Second-Third,
    format("the first drove to ~0f cm; ~0f and ~0f cm between them~n",
           [First, Ahead, Behind]).
