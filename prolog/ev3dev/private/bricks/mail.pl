:- module(ev3dev_mail,
          [ join_mail/1,                % +HostPort
            leave_mail/0,
            send_mail/3               % +To, +From, +Term
          ]).
:- use_module('../run/brick', [named_brick/3]).
:- use_module('../errors/errors', [throw_error/3]).
:- use_module(messages, [receive_message/3]).
:- use_module('../processes/redis',
              [ask/3, connected/2, connection_lost/1, disconnected/1]).
:- use_module(library(lists), [last/2, member/2]).
:- use_module(library(socket), [gethostname/1]).

/** <module> Messages between programs, by a Redis server

All programs read one stream, `ev3dev:mail`, of which the server keeps the
newest thousand entries: to, from, program, number, term. A thread with a
connection of its own takes those to a brick of this program. If the server
goes away it tries again, and goes on after the entry that it has read last;
a message that is sent again after that has the same number, and is dropped.
*/

:- dynamic
    joined/3,                           % HostPort, Program, Thread
    sender/1,                           % Redis
    last_number/2.                      % Program, Number
:- volatile
    joined/3,
    sender/1,
    last_number/2.

kept(1000).

%   Milliseconds of the server; a longer command would be deaf for longer.
block(200).

%!  join_mail(+HostPort) is det.
%
%   Send to and receive from the programs that use this server.
%
%   @error permission_error(join, redis, HostPort) if this program has joined
%   @error existence_error(redis_server, HostPort)
%   @error existence_error(library, redis)

join_mail(HostPort) :-
    (   joined(Other, _, _)
    ->  throw_error(permission_error(join, redis, Other), _,
                    'this program has joined already')
    ;   true
    ),
    connected(HostPort, Redis),
    newest(Redis, Last),
    gethostname(Host),
    current_prolog_flag(pid, Pid),
    get_time(Now),
    format(atom(Program), '~w-~w-~3f', [Host, Pid, Now]),
    thread_create(ev3dev_mail:receiver(HostPort, Redis, Last, Program),
                  Thread, []),
    assertz(joined(HostPort, Program, Thread)).

newest(Redis, Last) :-
    (   ask(Redis, xrevrange('ev3dev:mail', +, -, count, 1), [[Last|_]])
    ->  true
    ;   Last = '0-0'
    ).

%!  leave_mail is det.

leave_mail :-
    forall(retract(joined(_, _, Thread)),
           ( catch(thread_send_message(Thread, over), error(_, _), true),
             catch(thread_join(Thread, _), error(_, _), true) )),
    forall(retract(sender(Redis)), disconnected(Redis)),
    retractall(last_number(_, _)).

:- initialization(at_halt(ev3dev_mail:leave_mail), now).

% ---------------- SENDING

%!  send_mail(+To, +From, +Term) is semidet.
%
%   Fails if this program has not joined.
%
%   @error existence_error(redis_server, HostPort) if it is not there

send_mail(To, From, Term) :-
    joined(HostPort, Program, _),
    flag(ev3dev_mail, Number, Number+1),
    format(string(Text), '~k', [Term]),
    kept(Kept),
    Entry = xadd('ev3dev:mail', maxlen, Kept, *, to, To, from, From,
                 program, Program, number, Number, term, Text),
    with_mutex(ev3dev_mail, added(HostPort, Entry, 1)).

%   Once more with a new connection.

added(HostPort, Entry, Tries) :-
    (   sender(Redis)
    ->  true
    ;   connected(HostPort, Redis),
        assertz(sender(Redis))
    ),
    catch(ask(Redis, Entry, _), Error, true),
    (   var(Error)
    ->  true
    ;   connection_lost(Error),
        Tries > 0
    ->  retractall(sender(_)),
        disconnected(Redis),
        added(HostPort, Entry, 0)
    ;   throw(Error)
    ).

% ---------------- RECEIVING

receiver(HostPort, Redis, Last0, Program) :-
    catch(received(Redis, Last0, Program, Last), Error, true),
    (   var(Error)
    ->  disconnected(Redis)             % leave_mail/0
    ;   Error = lost(Last, Why)
    ->  disconnected(Redis),
        (   connection_lost(Why)
        ->  true
        ;   print_message(warning, Why)
        ),
        print_message(warning, ev3dev(mail_lost(HostPort))),
        again(HostPort, Last, Program)
    ;   throw(Error)
    ).

again(HostPort, Last, Program) :-
    thread_self(Me),
    (   thread_get_message(Me, over, [timeout(1)])
    ->  true
    ;   catch(connected(HostPort, Redis), error(_, _), fail)
    ->  receiver(HostPort, Redis, Last, Program)
    ;   again(HostPort, Last, Program)
    ).

received(Redis, Last0, Program, Last) :-
    thread_self(Me),
    (   thread_peek_message(Me, over)
    ->  Last = Last0
    ;   block(Block),
        catch(( ask(Redis, xread(count, 100, block, Block,
                                 streams, 'ev3dev:mail', Last0),
                    [[_, Entries]])
              ->  true
              ;   Entries = []
              ), Error,
              throw(lost(Last0, Error))),
        forall(member([_, Fields], Entries),
               catch(taken(Fields, Program), error(_, _), true)),
        (   last(Entries, [Last1|_])
        ->  true
        ;   Last1 = Last0
        ),
        received(Redis, Last1, Program, Last)
    ).

%   What cannot be read is dropped.

taken([to, To, from, From, program, Program, number, Number, term, Text],
      Me) :-
    Program \== Me,
    integer(Number),
    \+ ( last_number(Program, Before), Number =< Before ),
    brick_of(To, Brick),
    catch(term_to_atom(Term, Text), error(_, _), fail),
    !,
    retractall(last_number(Program, _)),
    assertz(last_number(Program, Number)),
    receive_message(Brick, From, Term).
taken(_, _).

brick_of(To, Brick) :-
    named_brick(To, Brick, _),
    integer(Brick).

:- multifile prolog:message//1.

prolog:message(ev3dev(mail_lost(HostPort))) -->
    [ 'The Redis server ~w does not answer; trying again.'-[HostPort] ].
