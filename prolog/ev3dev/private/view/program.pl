:- module(ev3dev_view_program,
          [ watch_program/0,
            leave_program/0,
            program_state/1,            % -State
            probe_program/0,
            stop_program/0,
            lift_latch/0,
            view_thread/0
          ]).
:- use_module(library(lists), [delete/3, member/2]).
:- use_module('../native',
              [ view_latch_/0, view_lift_/0, view_stop_motors_/0,
                view_thread_/1, view_users_/1 ]).

/** <module> The program that is watched

Whether a program runs at the toplevel, and how it is stopped.
*/

:- dynamic
    state/1,                            % idle, running
    queries/1,                          % how many there were
    stopping/1,                         % the thread that does it
    hook/1.                             % a clause

state(running).
queries(0).

%!  program_state(-State) is det.
%
%   State is `idle` while the toplevel waits for a query, else `running`.

program_state(State) :-
    (   state(State0)
    ->  State = State0
    ;   State = running
    ).

set_state(State) :-
    (   state(State)
    ->  true
    ;   retractall(state(_)),
        assertz(state(State))
    ).

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
    asserta((user:expand_query(_, _, _, _) :-
                 ev3dev_view_program:query_begins,
                 fail),
            Hook1),
    asserta((user:message_hook(Message, Kind, _) :-
                 ev3dev_view_program:message_seen(Message, Kind),
                 fail),
            Hook2),
    assertz(hook(Hook1)),
    assertz(hook(Hook2)).

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
    catch(thread_signal(main, ev3dev_view_program:probed), _, true).

probed :-
    (   reads_query
    ->  set_state(idle)
    ;   set_state(running)
    ).

%   True if the toplevel of this thread waits for a query. Then there are few
%   frames above it; in a deep recursion there is no need to look at all.
reads_query :-
    prolog_current_frame(Frame),
    reads_query(Frame, 100).

reads_query(Frame, Left) :-
    prolog_frame_attribute(Frame, predicate_indicator, Indicator),
    (   reader(Indicator)
    ->  true
    ;   Left > 0,
        prolog_frame_attribute(Frame, parent, Parent),
        Left1 is Left - 1,
        reads_query(Parent, Left1)
    ).

%   Prolog may have given up some of these frames for their last calls.
reader('$toplevel':read_query_line/2).
reader('$toplevel':read_query/3).
reader('$toplevel':read_expanded_query/3).
reader('$toplevel':read_term_as_atom/2).

%!  stop_program is det.
%
%   Stop all motors, interrupt the program, and stop the motors once more when
%   it has ended. Until then no motor can be started. Does not wait for the
%   end of the program.

stop_program :-
    view_latch_,
    stop_motors,
    with_mutex(ev3dev_view_stop, begin_to_stop).

stop_motors :-
    catch(view_stop_motors_, _, true),
    !.
stop_motors.

begin_to_stop :-
    stopping(Thread),
    catch(thread_property(Thread, status(running)), _, fail),
    !.
begin_to_stop :-
    retractall(stopping(_)),
    thread_create(interrupt, Thread, [detached(true)]),
    assertz(stopping(Thread)).

interrupt :-
    view_thread,
    thread_self(Me),
    view_users_(Users0),
    delete(Users0, 1, Users),
    forall(member(User, Users),
           send_signal(User, ev3dev_view_program:interrupted_thread(Me))),
    (   send_signal(main, ev3dev_view_program:interrupted(Me))
    ->  thread_get_message(answer(Answer)),
        until_ended(Answer, Me)
    ;   true
    ),
    forall(member(User, Users),
           until_over(User)),
    stop_motors,
    with_mutex(ev3dev_view_stop,
               ( retractall(stopping(Me)),
                 view_lift_ )).

send_signal(Thread, Goal) :-
    catch(thread_signal(Thread, Goal), _, fail).

%   The signals run in the program's threads.
interrupted(Stopper) :-
    (   reads_query
    ->  answer(Stopper, ended)
    ;   queries(Count),
        set_state(running),
        answer(Stopper, interrupted(Count)),
        abort
    ).

interrupted_thread(_) :-
    abort.

ended_since(Count0, Stopper) :-
    (   reads_query
    ->  Answer = ended
    ;   queries(Count),
        Count =\= Count0
    ->  Answer = ended
    ;   Answer = interrupted(Count0)
    ),
    answer(Stopper, Answer).

answer(Stopper, Answer) :-
    catch(thread_send_message(Stopper, answer(Answer)), _, true).

%   While the cleanup of the program goes on, ask again. The toplevel says
%   that a query was aborted before it reads the next one.
until_ended(ended, _) :-
    set_state(idle).
until_ended(interrupted(Count), Me) :-
    sleep(0.02),
    (   program_state(idle)
    ->  true
    ;   send_signal(main, ev3dev_view_program:ended_since(Count, Me))
    ->  await_end(Count, Me)
    ;   true
    ).

await_end(Count, Me) :-
    (   thread_get_message(Me, answer(Answer), [timeout(0.05)])
    ->  (   Answer == ended
        ->  set_state(idle)
        ;   until_ended(interrupted(Count), Me)
        )
    ;   program_state(idle)
    ->  true
    ;   catch(thread_property(main, status(running)), _, fail)
    ->  await_end(Count, Me)
    ;   true
    ).

until_over(Thread) :-
    (   catch(thread_property(Thread, status(running)), _, fail)
    ->  sleep(0.02),
        until_over(Thread)
    ;   true
    ).

%!  lift_latch is det.
%
%   Let motors start again, unless a program is still to be interrupted.

lift_latch :-
    with_mutex(ev3dev_view_stop,
               (   stopping(Thread),
                   catch(thread_property(Thread, status(running)), _, fail)
               ->  true
               ;   view_lift_
               )).

%!  view_thread is det.
%
%   This thread serves the view from now on, and is no part of the program.

view_thread :-
    view_thread_(true),
    thread_at_exit(ev3dev_view_program:view_thread_ended).

view_thread_ended :-
    view_thread_(false).
