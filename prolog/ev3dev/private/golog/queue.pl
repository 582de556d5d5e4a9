:- module(ev3dev_golog_queue,
          [ queue_new/1,                % -Queue
            queue_end/1,                % +Queue
            queue_put/2,                % +Queue, +Message
            queue_take/2,               % +Queue, ?Message
            queue_wait/3                % +Queue, +Seconds, -Message
          ]).
:- set_prolog_flag(generate_debug_info, false).

/** <module> Queues of messages

Queues of SWI-Prolog, which threads share. A page has neither threads nor such
queues: there they are facts.
*/

:- dynamic message/2.                   % Queue, Message
:- volatile message/2.

has_threads :-
    current_prolog_flag(threads, true).

%!  queue_new(-Queue) is det.
%!  queue_end(+Queue) is det.

queue_new(Queue) :-
    (   has_threads
    ->  message_queue_create(Queue)
    ;   flag(ev3dev_golog_queue, Number, Number+1),
        Queue = queue(Number)
    ).

queue_end(Queue) :-
    (   has_threads
    ->  catch(message_queue_destroy(Queue), error(_, _), true)
    ;   retractall(message(Queue, _))
    ).

%!  queue_put(+Queue, +Message) is det.
%!  queue_take(+Queue, ?Message) is semidet.
%
%   Messages are taken in their order. Does not wait.

queue_put(Queue, Message) :-
    (   has_threads
    ->  thread_send_message(Queue, Message)
    ;   assertz(message(Queue, Message))
    ).

queue_take(Queue, Message) :-
    (   has_threads
    ->  thread_peek_message(Queue, Message),
        thread_get_message(Queue, Message)
    ;   retract(message(Queue, Message)),
        !
    ).

%!  queue_wait(+Queue, +Seconds, -Message) is semidet.
%
%   Wait for a message, at most for Seconds, or `infinite`. Fails if none
%   comes. Without threads nobody else can send one.

queue_wait(Queue, Seconds, Message) :-
    (   has_threads
    ->  (   Seconds == infinite
        ->  thread_get_message(Queue, Message)
        ;   thread_get_message(Queue, Message, [timeout(Seconds)])
        )
    ;   queue_take(Queue, Message)
    ->  true
    ;   (   Seconds == infinite
        ->  sleep(0.02)
        ;   sleep(Seconds)
        ),
        fail
    ).
