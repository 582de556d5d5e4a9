:- module(ev3dev_events,
          [ on/2,                       % :Condition, :Action
            on/3,                       % :Condition, :Action, +Options
            every/2,                    % +Seconds, :Action
            every/3,                    % +Seconds, :Action, +Options
            after/2,                    % +Seconds, :Action
            after/3,                    % +Seconds, :Action, +Options
            event_cancel/1,             % ?Id
            event/2,                    % ?Id, ?Kind
            until/2,                    % :Condition, :Goal
            until/3                     % :Condition, :Goal, -Which
          ]).
:- set_prolog_flag(generate_debug_info, false).
:- use_module(private/errors,
              [ domain_error/2, goal_of_program/1, must_be/2,
                term_expansion/2
              ]).
:- use_module(private/arguments,
              [must_be_options/3, number_value/3, option/3]).
:- use_module(private/waits,
              [in_guard/2, leave/2, listen_for_events/1, listening/3]).
:- use_module(private/native,
              [ commands_/1, motors_stop_/2, now_/1, slices_/1 ]).
:- use_module(time, [wait/1]).

:- meta_predicate
    on(0, 0),
    on(0, 0, +),
    every(+, 0),
    every(+, 0, +),
    after(+, 0),
    after(+, 0, +),
    until(0, 0),
    until(0, 0, -).

/** <module> Events

What is to happen while a program does something else, in one thread:

```
?- on(touch(_, 1), say(ouch)),
   every(5, ( battery(percent, P), writeln(P) )),
   until(( us_dist_cm(_, D), D < 20 ), go(40)).
```

The thread that calls on/2, every/2 or after/2 serves its events whenever it
waits or reads a sensor by a predicate of this pack: every 20 ms by the clock
of the brick, or of the simulation. A thread that only computes serves none.
There are no other threads. So nothing happens at the same time, and a run on
the virtual clock is the same each time.

Conditions are looked at each time, so they should be quick, and must not
wait. One that reads a sensor in another mode than the last one takes 10 ms.
*/

%   event(Id, Kind, Action, State): Kind is on(Condition, Options),
%   every(Seconds) or after(Seconds). State changes only when something
%   happens.
:- thread_local event_/4.

%   Seconds between two looks.
look_every(0.02).

%!  on(:Condition, :Action) is det.
%!  on(:Condition, :Action, +Options) is det.
%
%   From now on, call Action each time that Condition becomes true. Does not
%   wait. The bindings of Condition reach Action, as in
%   `on(( light(L), L < 20 ), format("~w~n", [L]))`. Action may move the robot
%   and wait; it interrupts the program for so long, and its event happens only
%   once at a time. If Action fails or throws, a warning is printed and the
%   event stays. Options:
%
%     - id(+Id)
%       A name for event_cancel/1. An event with the same Id is replaced.
%     - count(+N)
%       End after N times. Default is `inf`.
%     - stable(+Seconds)
%       Condition must have been true for that long. Default is 0.
%     - rearm(:Condition)
%       When it may happen again. Default: when Condition is false. So a
%       threshold can have two sides:
%       `on(( light(L), L < 20 ), stop, [rearm(( light(M), M > 30 ))])`.
%
%   @error permission_error(wait, guard, Id) if Condition waits
%   @error domain_error(event_option, Option)

on(Condition, Action) :-
    on(Condition, Action, []).

on(Condition, Action, Options) :-
    must_be_goal(Condition),
    must_be_goal(Action),
    must_be_options(event_option, [id, count, stable, rearm], Options),
    option(stable(Stable0), Options, 0),
    number_value(seconds, Stable0, Stable),
    Condition = Module:_,
    (   option(rearm(Rearm0), Options)
    ->  must_be(callable, Rearm0),
        Rearm = rearm(Module:Rearm0)
    ;   Rearm = rearm
    ),
    count_option(Options, Count),
    add_event(on(Condition, Stable, Rearm), Action, armed(Count), Options).

%!  every(+Seconds, :Action) is det.
%!  every(+Seconds, :Action, +Options) is det.
%!  after(+Seconds, :Action) is det.
%!  after(+Seconds, :Action, +Options) is det.
%
%   Call Action each time that Seconds have passed, or once when they have.
%   Does not wait. Options: `id` and, for every/3, `count` as for on/3. If the
%   thread does not wait for longer, Action is called once, and not again for
%   the times that it missed.
%
%   @error domain_error(seconds, Seconds)
%   @error domain_error(event_option, Option)

every(Seconds, Action) :-
    every(Seconds, Action, []).

every(Seconds0, Action, Options) :-
    number_value(seconds, Seconds0, Seconds),
    must_be_goal(Action),
    must_be_options(event_option, [id, count], Options),
    count_option(Options, Count),
    now_(Now),
    Next is Now + Seconds,
    add_event(every(Seconds), Action, due(Next, Count), Options).

after(Seconds, Action) :-
    after(Seconds, Action, []).

after(Seconds0, Action, Options) :-
    number_value(seconds, Seconds0, Seconds),
    must_be_goal(Action),
    must_be_options(event_option, [id], Options),
    now_(Now),
    Next is Now + Seconds,
    add_event(after(Seconds), Action, due(Next, 1), Options).

must_be_goal(Goal) :-
    strip_module(Goal, _, Plain),
    must_be(callable, Plain).

count_option(Options, Count) :-
    option(count(Count), Options, inf),
    (   Count == inf
    ->  true
    ;   must_be(positive_integer, Count)
    ).

add_event(Kind, Action, State, Options) :-
    (   option(id(Id), Options)
    ->  must_be(ground, Id),
        retractall(event_(Id, _, _, _))
    ;   flag(ev3dev_event, Id, Id + 1)
    ),
    assertz(event_(Id, Kind, Action, State)),
    look_every(Seconds),
    listen_for_events(Seconds).

%!  event_cancel(?Id) is semidet.
%
%   End the event Id of this thread, or all if Id is unbound. Fails if there
%   is none.

event_cancel(Id) :-
    (   event_(Id, _, _, _)
    ->  retractall(event_(Id, _, _, _))
    ;   fail
    ).

%!  event(?Id, ?Kind) is nondet.
%
%   True if this thread has an event Id; Kind is `on`, `every` or `after`.

event(Id, Kind) :-
    event_(Id, Term, _, _),
    functor(Term, Kind, _).

                 /*******************************
                 *            SERVE             *
                 *******************************/

:- multifile ev3dev_waits:serve_events/0.

ev3dev_waits:serve_events :-
    ev3dev_events:serve.

%   Which there are at the beginning: an action may add and cancel events.
serve :-
    (   event_(_, _, _, _)
    ->  now_(Now),
        findall(Id, event_(Id, _, _, _), Ids),
        forall(( member_of(Ids, Id), event_(Id, Kind, Action, State) ),
               serve(State, Kind, Id, Now, Action))
    ;   true
    ).

member_of([Element|_], Element).
member_of([_|Elements], Element) :-
    member_of(Elements, Element).

serve(due(Next, Count), Kind, Id, Now, Action) :-
    !,
    (   Now + 1.0e-9 >= Next
    ->  again(Kind, Next, Now, Count, Id, State),
        change(Id, State),
        happen(Id, Kind, Action)
    ;   true
    ).
serve(running(_), _, _, _, _) :- !.
serve(happened(Count), on(Condition, _, Rearm), Id, _, _) :-
    !,
    (   is_armed(Rearm, Id, Condition)
    ->  change(Id, armed(Count))
    ;   true
    ).
serve(State, on(Condition, Stable, _), Id, Now, Action) :-
    (   in_guard(Id, Condition)         % its bindings reach Action
    ->  (   is_stable(State, Stable, Id, Now, Count)
        ->  change(Id, running(Count)),
            happen(Id, on(Condition), Action),
            happened(Id, Count)
        ;   true
        )
    ;   State = since(_, Count)
    ->  change(Id, armed(Count))
    ;   true
    ).

again(after(_), _, _, _, _, over).
again(every(Seconds), Next0, Now, Count0, _, State) :-
    (   Count0 == 1
    ->  State = over
    ;   less(Count0, Count),
        Next1 is Next0 + Seconds,
        Next is max(Next1, Now),
        State = due(Next, Count)
    ).

less(inf, inf) :- !.
less(Count0, Count) :-
    Count is Count0 - 1.

is_armed(rearm, Id, Condition) :-
    \+ in_guard(Id, Condition).
is_armed(rearm(Condition), Id, _) :-
    \+ \+ in_guard(Id, Condition).

is_stable(since(Since, Count), Stable, _, Now, Count) :-
    Now + 1.0e-9 >= Since + Stable.
is_stable(armed(Count), Stable, Id, Now, Count) :-
    (   Stable =:= 0
    ->  true
    ;   change(Id, since(Now, Count)),
        fail
    ).

happened(Id, Count0) :-
    (   event_(Id, _, _, running(_))
    ->  (   Count0 == 1
        ->  change(Id, over)
        ;   less(Count0, Count),
            change(Id, happened(Count))
        )
    ;   true                            % the action has cancelled it
    ).

change(Id, State) :-
    (   retract(event_(Id, Kind, Action, _))
    ->  (   State == over
        ->  true
        ;   assertz(event_(Id, Kind, Action, State))
        )
    ;   true
    ).

%   What a program's own interrupt is goes on its way: only errors are
%   printed.
happen(Id, Kind, Action) :-
    functor(Kind, Name, _),
    catch(ignore_failure(Id, Name, Action), E, true),
    (   var(E)
    ->  true
    ;   E = error(_, _)
    ->  print_message(error, ev3dev(event_error(Id, Name, E)))
    ;   throw(E)
    ).

ignore_failure(Id, Name, Action) :-
    (   goal_of_program(Action)
    ->  true
    ;   print_message(warning, ev3dev(event_failed(Id, Name)))
    ).

:- multifile prolog:message//1.

prolog:message(ev3dev(event_error(Id, Name, E))) -->
    [ 'Event ~p (~w): '-[Id, Name] ],
    '$messages':translate_message(E).
prolog:message(ev3dev(event_failed(Id, Name))) -->
    [ 'Event ~p (~w): its action failed'-[Id, Name] ].

                 /*******************************
                 *            UNTIL             *
                 *******************************/

%!  until(:Condition, :Goal) is semidet.
%!  until(:Condition, :Goal, -Which) is semidet.
%
%   Call Goal, and leave it as soon as Condition is true: a move is stopped,
%   and so are motors that Goal has started. If Goal has started something
%   that goes on by itself, as go/1, it is waited until Condition is true.
%   Which is `condition`, or `goal` if Goal succeeded before. Fails if Goal
%   fails. If Condition is true at once, Goal is not called.
%
%   ```
%   ?- until(touch(_, 1), go(30)).
%   ?- until(( us_dist_cm(_, D), D < 20 ), forever_zigzag).
%   ```
%
%   Condition is looked at every 20 ms while Goal waits or reads sensors.
%
%   @error permission_error(wait, guard, until) if Condition waits

until(Condition, Goal) :-
    until(Condition, Goal, _).

until(Condition, Goal, Which) :-
    must_be_goal(Condition),
    must_be_goal(Goal),
    (   \+ \+ in_guard(until, Condition)
    ->  Which0 = condition
    ;   flag(ev3dev_until, Id, Id + 1),
        look_every(Seconds),
        commands_(From),
        catch(listening(Seconds, ev3dev_events:until_tick(Id, Condition),
                        ev3dev_events:to_the_end(Goal)),
              ev3dev_until(Id),
              Left = true),
        (   Left == true
        ->  commands_(Before),
            motors_stop_(From, Before),
            Which0 = condition
        ;   Which0 = goal
        )
    ),
    Which = Which0.

until_tick(Id, Condition, Listener) :-
    (   in_guard(until, Condition)
    ->  leave(Listener, ev3dev_until(Id))
    ;   true
    ).

%   What did not wait goes on by itself.
to_the_end(Goal) :-
    slices_(Slices0),
    goal_of_program(Goal),
    !,
    slices_(Slices),
    (   Slices > Slices0
    ->  true
    ;   repeat,
        wait(3600),
        fail
    ).
