:- module(ev3dev_view_program,
          [ watch_program/0,
            leave_program/0,
            program_state/1,            % -State
            in_main/1,                  % :Goal
            part_begins/1,              % +Thread
            part_ends/1,                % +Thread
            prints/0,
            probe_program/0,
            stop_program/0,
            end_program/1,              % +Seconds
            lift_latch/0,
            is_stopping/0,
            stopped/0,
            view_thread/0
          ]).
:- use_module(library(lists), [delete/3, member/2]).
:- use_module('../native/native',
              [ view_latch_/0, view_lift_/0, view_prints_/1,
                view_stop_motors_/0, view_thread_/1, view_users_/1 ]).
:- use_module('../run/prompt', [reads_query/0]).

/** <module> The program that is watched

Whether a program runs at the toplevel, and how it is stopped.

Where Prolog has no threads, the program itself serves the page, between two
of its goals. Who began it interrupts it if is_stopping/0 is true, and calls
stopped/0 when it has ended.
*/

:- meta_predicate in_main(0).

:- dynamic
    queries/1,                          % how many there were
    stopping/1,                         % the thread that does it
    pressed/0,                          % STOP, while a thread does it
    asked/1,                            % a thread that is to be interrupted
    part/1,                             % a thread with a goal of a page
    next_probe/2,                       % Time, Pause
    hook/1.                             % a clause

queries(0).

%!  program_state(-State) is det.
%
%   State is `idle` while the toplevel waits for a query and no goal of a page
%   runs, else `running`.

program_state(State) :-
    (   part(_)
    ->  State = running
    ;   main_state(State)
    ).

main_state(State) :-
    flag(ev3dev_view_idle, Idle, Idle),
    (   Idle =:= 1
    ->  State = idle
    ;   State = running,
        probe_again
    ).

%   A flag is set at once; two threads do this.
set_state(State) :-
    (   State == idle
    ->  Idle = 1
    ;   Idle = 0
    ),
    flag(ev3dev_view_idle, _, Idle),
    prints.

%!  prints is det.
%
%   What is written from now on is the program's, or the toplevel's.

prints :-
    program_state(State),
    (   State == running
    ->  view_prints_(true)
    ;   catch(flush_output(user_output), _, true),
        view_prints_(false)
    ).

%!  part_begins(+Thread) is det.
%!  part_ends(+Thread) is det.
%
%   A thread solves a goal of a page, as a part of the program; or it waits to
%   be asked for another answer, or has ended.

part_begins(Thread) :-
    part_ends(Thread),
    assertz(part(Thread)),
    prints.

part_ends(Thread) :-
    retractall(part(Thread)),
    prints.

%!  watch_program is det.
%!  leave_program is det.
%
%   Note from now on when queries begin and end; and no more.

:- multifile
    user:expand_query/4,
    user:message_hook/3.
:- dynamic
    user:expand_query/4,
    user:message_hook/3.

watch_program :-
    leave_program,
    asserta((user:expand_query(_Query, _, _, _) :-
                 ev3dev_view_program:query_begins,
                 fail),
            Hook1),
    asserta((user:message_hook(Message, Kind, _) :-
                 ev3dev_view_program:message_seen(Message, Kind),
                 fail),
            Hook2),
    assertz(hook(Hook1)),
    assertz(hook(Hook2)),
    prints.

leave_program :-
    forall(retract(hook(Hook)),
           erase(Hook)).

query_begins :-
    (   is_main
    ->  retract(queries(Count0)),
        Count is Count0 + 1,
        assertz(queries(Count)),
        set_state(running)
    ;   true
    ).

message_seen(Message, Kind) :-
    (   ends(Message, Kind),
        is_main
    ->  set_state(idle)
    ;   true
    ).

ends(query(_), _).
ends(unhandled_exception(_), _).
ends(unwind(abort), _).
ends('$aborted', _).
ends(_, banner).

is_main :-
    thread_self(main).

%!  probe_program is det.
%
%   Have the program say whether it runs. Does not wait for the answer.

probe_program :-
    probe(0.1).

probe(Pause) :-
    get_time(Now),
    Next is Now + Pause,
    retractall(next_probe(_, _)),
    assertz(next_probe(Next, Pause)),
    in_main(ev3dev_view_program:probed).

%!  in_main(:Goal) is det.
%
%   Have the main thread call Goal between two of its own, and do not wait for
%   that; if there is no other thread, call it now.

in_main(Goal) :-
    (   current_prolog_flag(threads, true)
    ->  catch(thread_signal(main, Goal), _, true)
    ;   ignore(Goal)
    ).

%   Nothing says when the toplevel begins to wait for its first query: it is
%   asked again, ever more seldom.
probe_again :-
    (   queries(0),
        next_probe(Next, Pause),
        get_time(Now),
        Now >= Next
    ->  Longer is Pause*2,
        probe(Longer)
    ;   true
    ).

probed :-
    (   reads_query
    ->  set_state(idle)
    ;   set_state(running)
    ).

%!  stop_program is det.
%
%   Stop all motors, interrupt the program, and stop the motors once more when
%   it has ended. Until then no motor can be started. Does not wait for the
%   end of the program.

stop_program :-
    view_latch_,
    stop_motors,
    with_mutex(ev3dev_view_stop, begin_to_stop).

%!  end_program(+Seconds) is semidet.
%
%   The same, and wait for the end of the program. Fails if it has not ended
%   after so long.

end_program(Seconds) :-
    stop_program,
    get_time(Now),
    End is Now + Seconds,
    until_stopped(End).

until_stopped(End) :-
    (   is_stopping
    ->  get_time(Now),
        Now < End,
        sleep(0.01),
        until_stopped(End)
    ;   true
    ).

stop_motors :-
    catch(view_stop_motors_, _, true),
    !.
stop_motors.

begin_to_stop :-
    is_stopping,
    !,
    retractall(pressed),
    assertz(pressed).
begin_to_stop :-
    retractall(stopping(_)),
    retractall(pressed),
    (   current_prolog_flag(threads, true)
    ->  thread_create(interrupt, Thread, [detached(true)]),
        assertz(stopping(Thread))
    ;   part(_)
    ->  assertz(stopping(main))
    ;   view_lift_
    ).

%!  stopped is det.
%
%   The program, which was also who serves the page, has ended.

stopped :-
    retractall(part(_)),
    set_state(idle),
    (   retract(stopping(main))
    ->  stop_motors,
        view_lift_
    ;   true
    ).

interrupt :-
    view_thread,
    thread_self(Me),
    between(1, inf, Round),
    interrupt_users(Me-Round),
    with_mutex(ev3dev_view_stop, is_over(Me)),
    !.

%   Another program may have begun meanwhile, and STOP was pressed again.
is_over(Me) :-
    (   retract(pressed)
    ->  fail
    ;   retractall(stopping(Me)),
        view_lift_
    ).

interrupt_users(Me) :-
    view_users_(Users0),
    delete(Users0, 1, Users),
    retractall(asked(_)),
    forall(member(User, [main|Users]),
           assertz(asked(User))),
    % The latch may have ended one already.
    forall(member(User, Users),
           ignore(send_signal(User, ev3dev_view_program:
                                        interrupted_thread(User)))),
    asked_main(interrupted(Me), 0.05, Me, Answer),
    until_ended(Answer, Me),
    forall(member(User, Users),
           until_over(User, 0.02)),
    stop_motors.

send_signal(Thread, Goal) :-
    catch(thread_signal(Thread, Goal), _, fail).

%   asked_main(+Question, +Seconds, +Me, -Answer): the main thread calls
%   Question as a signal, which answers Me, a thread and the number of its
%   round, as answers to former rounds may still come. A signal that comes
%   just before a thread begins to read or to wait in the kernel is seen after
%   that only, so it is sent again, ever more seldom. Only the first one of
%   interrupted/1 that is seen counts. Answer is `ended` if there is no such
%   thread.
asked_main(Question, Seconds, Me, Answer) :-
    (   \+ send_signal(main, ev3dev_view_program:Question)
    ->  Answer = ended
    ;   Me = Thread-Round,
        thread_get_message(Thread, answer(Round, Said), [timeout(Seconds)])
    ->  Answer = Said
    ;   Question = ended_since(_, _),
        main_state(idle)
    ->  Answer = ended
    ;   Longer is min(1, Seconds*2),
        asked_main(Question, Longer, Me, Answer)
    ).

%   The signals run in the program's threads.
interrupted(Stopper) :-
    (   \+ retract(asked(main))
    ->  true
    ;   at_prompt
    ->  answer(Stopper, ended)
    ;   queries(Count),
        set_state(running),
        answer(Stopper, interrupted(Count)),
        abort
    ).

interrupted_thread(Me) :-
    (   retract(asked(Me))
    ->  abort
    ;   true
    ).

%   Another query may begin before the stopper gets the answer.
at_prompt :-
    reads_query,
    set_state(idle).

ended_since(Count0, Stopper) :-
    (   at_prompt
    ->  Answer = ended
    ;   queries(Count),
        Count =\= Count0
    ->  Answer = ended
    ;   Answer = interrupted(Count0)
    ),
    answer(Stopper, Answer).

answer(Stopper-Round, Answer) :-
    catch(thread_send_message(Stopper, answer(Round, Answer)), _, true).

%   While the cleanup of the program goes on, ask again. The toplevel says
%   that a query was aborted before it reads the next one.
until_ended(ended, _).
until_ended(interrupted(Count), Me) :-
    sleep(0.02),
    (   main_state(idle)
    ->  true
    ;   asked_main(ended_since(Count, Me), 0.05, Me, Answer),
        until_ended(Answer, Me)
    ).

until_over(Thread, Seconds) :-
    (   catch(thread_property(Thread, status(running)), _, fail)
    ->  sleep(Seconds),
        ignore(send_signal(Thread,
                           ev3dev_view_program:interrupted_thread(Thread))),
        Longer is min(1, Seconds*2),
        until_over(Thread, Longer)
    ;   true
    ).

%!  lift_latch is det.
%
%   Let motors start again, unless a program is still to be interrupted.

lift_latch :-
    with_mutex(ev3dev_view_stop,
               (   is_stopping
               ->  true
               ;   view_lift_
               )).

%!  is_stopping is semidet.
%
%   The program is to be interrupted, and has not ended yet.

is_stopping :-
    stopping(Thread),
    catch(thread_property(Thread, status(running)), _, fail),
    !.

%!  view_thread is det.
%
%   This thread serves the view from now on, and is not a part of the program.

view_thread :-
    view_thread_(true),
    thread_at_exit(ev3dev_view_program:view_thread_ended).

view_thread_ended :-
    view_thread_(false).
