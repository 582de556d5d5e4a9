:- module(ev3dev_waits,
          [ waited/1,                   % +Reason
            listening/3,                % +Seconds, :Closure, :Goal
            leave/2,                    % +Listener, +Ball
            listen_for_events/1,        % +Seconds
            event_period/2,             % -Before, +Period
            in_guard/2,                 % +Name, :Goal
            serve_at_read/0,
            let_others_go_on/0,
            let_page_in/0
          ]).
:- set_prolog_flag(generate_debug_info, false).
:- use_module('../basics/fields',
              [fields/1, goal_expansion/2, term_expansion/2]).
:- use_module(brick, [brick/1, in_brick/2]).
:- use_module('../native/native',
              [ read_on_/0, serve_if_due_/0, tick_after_/1, tick_at_once_/0
              ]).
:- use_module('../basics/small_lists', [append_lists/3, one_of/2]).
:- use_module('../errors/errors', [throw_error/3]).
:- use_module('../errors/frames', [goal_of_program/1, goal_of_program/2]).

:- fields(listener(closure, state, period, brick)).

:- meta_predicate
    listening(+, 1, 0),
    in_guard(+, 0).

/** <module> Waits, and what happens meanwhile

A native wait returns `pause` or `tick` after each slice of time, or `yield`
in a branch, with a choice point, and at its end its reason, or what is to be
thrown. So a caller writes

```
    wait_(Seconds, Reason),
    waited(Reason),
    !
```

Between two slices Prolog handles its signals. An exception that leaves the
wait ends it: a move stops its motors.

A tick is a slice at whose end this thread serves its listeners and events:
those that library(ev3dev/events) and library(ev3dev/rules) add. A program
that does not load them has no ticks.

Listeners are in a backtrackable global variable. So an exception, a failure
and a cut end them.
*/

%!  waited(+Reason) is semidet.
%
%   True if a wait is over. Fails back into it if not, once the events of this
%   thread that are due have been served.
%
%   @error permission_error(wait, guard, Name) in a guard, see in_guard/2

waited(Reason) :-
    (   Reason == pause
    ->  no_guard,
        % No tick is due while time stands.
        ignore(time_goes_on),
        let_page_in,
        fail
    ;   Reason == tick
    ->  no_guard,
        serve,
        let_page_in,
        fail
    ;   Reason == yield
    ->  no_guard,
        yield,
        serve,
        fail
    ;   Reason = throw(Formal, Called, Message)
    ->  throw_error(Formal, Called, Message)
    ;   true
    ).

%   The native code asks it before it starts a motor, too.
:- public no_guard/0.

no_guard :-
    (   nb_current(ev3dev_guard, Name),
        Name \== []
    ->  throw_error(permission_error(wait, guard, Name), _,
                    'a condition may only look')
    ;   true
    ).

%!  in_guard(+Name, :Goal) is semidet.
%
%   Call Goal once, which is the guard of Name, or its condition. It must not
%   wait or start a motor, and serves no events.

in_guard(Name, Goal) :-
    b_setval(ev3dev_guard, Name),
    goal_of_program(Goal, Name),
    !,
    b_setval(ev3dev_guard, []).

%!  listening(+Seconds, :Closure, :Goal) is semidet.
%
%   Call Goal once. Meanwhile, each time that this thread has waited for
%   Seconds, call(Closure, Listener) is called, with the brick in use that is
%   so now. It may call leave/2 with that Listener.

listening(Seconds, Closure, Goal) :-
    listeners(Outer),
    period(Outer, Before),
    Period is min(Seconds, Before),
    brick(Brick),
    append_lists(Outer, [listener(Closure, [], Period, Brick)], Listeners),
    b_setval(ev3dev_listeners, Listeners),
    tick_after_(Period),
    goal_of_program(Goal),
    !,
    b_setval(ev3dev_listeners, Outer).

listeners(Listeners) :-
    (   nb_current(ev3dev_listeners, Listeners)
    ->  true
    ;   Listeners = []
    ).

%   The period of the innermost is the shortest.
period([], Period) :-
    (   nb_current(ev3dev_event_period, Seconds),
        Seconds \== []
    ->  Period = Seconds
    ;   Period = 1.0
    ).
period([listener(_, _, Period, _)], Period) :- !.
period([_|Listeners], Period) :-
    period(Listeners, Period).

%!  leave(+Listener, +Ball)
%
%   Throw Ball now, and again at each tick until the goal of the Listener is
%   left: so a program that catches everything cannot keep it alive.

leave(Listener, Ball) :-
    set_field(Listener, listener(state: leave(Ball))),
    throw(Ball).

%!  listen_for_events(+Seconds) is det.
%
%   From now on this thread serves its events each time that it has waited for
%   Seconds.

listen_for_events(Seconds) :-
    nb_setval(ev3dev_event_period, Seconds),
    listeners(Listeners),
    period(Listeners, Period),
    tick_after_(Period).

%!  event_period(-Before, +Period) is det.
%
%   The period of this thread's events was Before, and is Period from now on,
%   at the next tick: seconds, or `[]` if it has none.

event_period(Before, Period) :-
    (   nb_current(ev3dev_event_period, Before0)
    ->  true
    ;   Before0 = []
    ),
    nb_setval(ev3dev_event_period, Period),
    (   Period == []
    ->  true
    ;   tick_at_once_
    ),
    Before = Before0.

%!  serve_at_read is det.
%
%   Serve events while the program reads a sensor, and does not wait. The
%   native code calls this at most once in a period.

serve_at_read :-
    (   nb_current(ev3dev_guard, Name),
        Name \== []
    ->  true
    ;   branch
    ->  true
    ;   serve
    ).

%   A branch that reads a sensor, and whose time is over, lets the others go
%   on first. The native code calls this, and binds Woken; the read that it
%   was called for, Name(A, B, C, D, E), has succeeded without reading.
:- public read_later/7.

read_later(Name, A, B, C, D, E, Woken) :-
    Read =.. [Name, A, B, C, D, E],
    freeze(Woken, ev3dev_waits:read_after_others(Read)).

read_after_others(Read) :-
    (   nb_current(ev3dev_guard, Name),
        Name \== []
    ->  true
    ;   yield_if_possible,
        serve
    ),
    read_on_,
    ev3dev_native:Read.

%!  let_others_go_on is det.
%
%   Between two rounds of branches that did not wait: this thread serves its
%   events, if it is time to; if it runs a branch itself, others go on.

let_others_go_on :-
    (   branch
    ->  yield_if_possible
    ;   serve_if_due_
    ).

branch :-
    nb_current(ev3dev_branch, Branch),
    Branch \== [].

%   It is not while native code calls Prolog, as in with_output_to/2, or in a
%   clean-up after an exception. The error of Prolog's instruction needs room
%   on the global stack, and crashes a 32-bit Prolog (9.0.4, 9.2.9) if that is
%   made only then.
yield_if_possible :-
    \+ \+ length(_, 100),
    catch(yield, error(permission_error(execute, vmi, _), _), true).

%!  serve_events is det.
%!  serve_planned is det.
%
%   Serve the events of this thread, and the goals that are planned for it:
%   library(ev3dev/events) and the simulator add a clause each.

%!  yield is det.
%
%   Lets the other branches of race/2 or both/2 go on; library(ev3dev/events)
%   adds the clause.

%!  page_turn is det.
%
%   Lets the page go on that Prolog runs in; if there is one, it adds the
%   clause.

%!  time_goes_on is semidet.
%
%   Between two slices of a wait: time that stood in a menu passes again. What
%   prints around queries adds the clause.

:- multifile
    page_turn/0,
    serve_events/0,
    serve_planned/0,
    time_goes_on/0,
    yield/0.

%!  let_page_in is det.
%
%   The same, also if Prolog runs in no page: between two native calls of a
%   long computation, which Prolog counts as few inferences.

let_page_in :-
    (   page_turn
    ->  true
    ;   true
    ).

serve :-
    forall(serve_planned, true),
    listeners(Listeners),
    serve(Listeners).

serve(Listeners) :-
    Listeners == [],
    \+ ( nb_current(ev3dev_event_period, Period), Period \== [] ),
    !,
    % They were left by an exception.
    tick_after_(infinite).
serve(Listeners) :-
    period(Listeners, Period),
    % Also while events are served, and after an exception.
    tick_after_(Period),
    forall(serve_events, true),
    \+ ( one_of(Listeners, Listener),
         \+ serve_listener(Listener)
       ),
    tick_after_(Period).

serve_listener(Listener) :-
    Listener = listener(Closure, State, _, Brick),
    (   State = leave(Ball)
    ->  throw(Ball)
    ;   in_brick(Brick, call(Closure, Listener))
    ).
