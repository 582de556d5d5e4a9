:- module(ev3dev_worker, [work/0]).
:- set_prolog_flag(generate_debug_info, false).
:- use_module(private/load/compiled, []).
:- use_module(private/processes/descriptors, [taken/3]).
:- use_module(private/errors/frames, [goal_of_program/1]).
:- use_module(private/bricks/far_frames,
              [ beat/1, protocol/1, receive_frames/2, send_frame/4 ]).
:- use_module(private/native/native, [stop_all_bricks_/0, stop_turning_/1]).
:- user:use_module(library(ev3dev)).
:- use_module(library(process), [process_kill/2]).
:- use_module(library(unix), [dup/2]).

/** <module> The brick's side of a far brick

brick_open/2 of library(ev3dev/bricks) starts this on a far brick, as

```
swipl -q -g "use_module(library(ev3dev/worker)),work" -t halt
```

It calls the goals that a program on another machine sends with far/2, one
after the other, in the module `user`.
*/

:- dynamic running/1.
:- volatile running/1.

%!  work is det.
%
%   Answers at the standard streams, until the program there says `end`, its
%   stream ends, or it is silent for a second. Then all motors stop, and the
%   process ends.

work :-
    taken(0, read, In),
    % What a goal prints goes where its answer goes, also that of a process
    % that it starts.
    dup(1, 2),
    Out = user_output,
    set_stream(Out, encoding(utf8)),
    set_stream(Out, buffer(line)),
    set_stream(Out, alias(user_error)),
    protocol(Version),
    send_frame(Out, hello, 0, Version),
    thread_self(Main),
    thread_create(listen(In, Out, Main), _, [detached(true)]),
    thread_create(beat(Out), _, [detached(true)]),
    serve(Out).

%   Another thread listens, also while a goal runs.

listen(In, Out, Main) :-
    receive_frames(In, ev3dev_worker:hear(In, Out, Main)),
    leave.

hear(In, _, _, hello, _, Version) :-
    !,
    (   protocol(Version)
    ->  set_stream(In, timeout(1))
    ;   leave
    ).
hear(_, _, Main, call, Number, Request) :-
    !,
    thread_send_message(Main, request(Number, Request)).
hear(_, _, Main, load, Number, Request) :-
    !,
    thread_send_message(Main, request(Number, Request)).
hear(_, _, Main, cancel, Number, _) :-
    !,
    thread_signal(Main, ev3dev_worker:cancel(Number)).
hear(_, Out, _, idle, Number, _) :-
    !,
    (   running(_)
    ->  Ports = []
    ;   stop_turning_(Ports)
    ),
    answer(Out, Number, yes(Ports)).
hear(_, _, _, stop, _, _) :-
    !,
    stop_all_bricks_.
hear(_, _, _, end, _, _) :-
    !,
    leave.
hear(_In, _Out, _Main, _, _Number, _Version).

%   SIGTERM stops the motors whatever the goal does, and ends the process
%   within two seconds.

leave :-
    current_prolog_flag(pid, Process),
    process_kill(Process, term).

cancel(Number) :-
    (   running(Number)
    ->  throw(ev3dev_worker(canceled))
    ;   thread_self(Me),
        thread_peek_message(Me, request(Number, _))
    ->  thread_get_message(Me, request(Number, _))
    ;   true
    ).

serve(Out) :-
    thread_self(Me),
    repeat,
    % Prolog handles its signals in between.
    thread_get_message(Me, request(Number, Request), [timeout(0.5)]),
    catch(serve(Out, Number, Request), ev3dev_worker(canceled),
          stop_all_bricks_),
    fail.

serve(Out, Number, Request) :-
    assertz(running(Number)),
    call_cleanup(served(Request, Answer), retractall(running(_))),
    answer(Out, Number, Answer).

served(Request, Answer) :-
    (   catch(done(Request, Result), Error, true)
    ->  (   var(Error)
        ->  Answer = yes(Result)
        ;   Error = ev3dev_worker(canceled)
        ->  throw(Error)
        ;   Answer = error(Error)
        )
    ;   Answer = no
    ).

done(goal(Variables, Goal), Variables) :-
    goal_of_program(user:Goal).
done(file(Name, Text), []) :-
    setup_call_cleanup(
        open_string(Text, Stream),
        load_files(user:Name, [stream(Stream)]),
        close(Stream)).
done(unreadable, _) :-
    throw(error(type_error(sendable, goal), _)).

answer(Out, Number, Answer0) :-
    copy_term_nat(Answer0, Answer),
    catch(send_frame(Out, answer, Number, Answer), error(Formal, Context),
          send_frame(Out, answer, Number,
                     error(error(Formal, Context)))).
