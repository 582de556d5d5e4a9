:- module(ev3dev_messages,
          [ send_message/3,             % +Brick, +Name, +Term
            receive_message/3,          % +Brick, +Name, +Term
            next_message/4              % +Until, +Late, -From, ?Term
          ]).
:- use_module('../basics/fields',
              [fields/1, goal_expansion/2, term_expansion/2]).
:- use_module('../run/brick',
              [brick/1, in_brick/2, is_simulated/0, of_brick/1]).
:- use_module('../../time', [ev3_time/1, wait/1]).

:- fields(message(brick, at, sender, number, name, term)).

/** <module> Messages from brick to brick

In a simulation a message arrives 10 ms later, as by radio; so which one comes
first does not depend on threads. Messages of the same moment come in the
order of their senders' bricks, and those of one sender in theirs.
*/

:- dynamic message/6.                   % To, At, Sender, Number, Name, Term
:- volatile message/6.
:- of_brick([message/6]).

%   How long one takes, and between two looks for one, in seconds.

delay(0.01).
look(0.02).

%!  send_message(+Brick, +Name, +Term) is det.
%
%   The brick in use, which is called Name, sends Term to Brick.

send_message(Brick, Name, Term) :-
    brick(Sender),
    in_brick(Brick, arrival(At)),
    put(Brick, At, Sender, Name, Term).

%!  receive_message(+Brick, +Name, +Term) is det.
%
%   One from another program arrives now.

receive_message(Brick, Name, Term) :-
    put(Brick, 0, -1, Name, Term).

put(Brick, At, Sender, Name, Term0) :-
    copy_term_nat(Term0, Term),
    flag(ev3dev_message, Number, Number+1),
    assertz(message(Brick, At, Sender, Number, Name, Term)).

arrival(At) :-
    ev3_time(Now),
    (   is_simulated
    ->  delay(Delay),
        At is Now+Delay
    ;   At = Now
    ).

%!  next_message(+Until, -Late, -From, ?Term) is det.
%
%   Take the first message for the brick in use that unifies with From and
%   Term. Waits for one until the time Until, a number or `inf`; Late is
%   whether that came first.

next_message(Until, Late, From, Term) :-
    ev3_time(Now),
    brick(Me),
    (   taken(Me, Now, From, Term)
    ->  Late = false
    ;   Until \== inf,
        Now >= Until
    ->  Late = true
    ;   pause(Me, Now, Until, Pause),
        wait(Pause),
        next_message(Until, Late, From, Term)
    ).

taken(Me, Now, From, Term) :-
    findall(At-Sender-Number,
            ( message(Me, At, Sender, Number, From, Term), At =< Now ),
            Keys0),
    msort(Keys0, [At-Sender-Number|_]),
    retract(message(Me, At, Sender, Number, From, Term)),
    !.

%   Until one is there that is known to be coming.

pause(Me, Now, Until, Pause) :-
    look(Look),
    findall(At, ( message(brick: Me, at: At), At > Now ), Coming),
    Latest is Now+Look,
    msort([Latest|Coming], [First0|_]),
    (   Until \== inf,
        Until < First0
    ->  First = Until
    ;   First = First0
    ),
    Pause is max(0, First-Now).
