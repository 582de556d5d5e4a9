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
            until/3,                    % :Condition, :Goal, -Which
            both/2,                     % :Goal1, :Goal2
            race/2                      % :Goals, -Winner
          ]).
:- set_prolog_flag(generate_debug_info, false).
:- use_module(private/load/compiled, []).
:- use_module(private/basics/fields,
              [fields/1, goal_expansion/2, term_expansion/2]).
:- use_module(private/checks/checks, [must_be/2, must_be_goal/1]).
:- use_module(private/errors/errors,
              [error_within/3, in_own_name/1, throw_error/3]).
:- use_module(private/errors/frames, [goal_of_program/1]).
:- use_module(private/errors/public_clauses, [term_expansion/4]).
:- use_module(private/checks/arguments,
              [must_be_options/3, number_value/3, option/3]).
:- use_module(private/run/brick,
              [brick/1, in_brick/2, is_apart/1, switch_brick/1, of_brick/1]).
:- use_module(private/simulation/random_seed, [branch_seed/1, seed_branch/1]).
:- use_module(private/devices/conditions, [condition_goal/2]).
:- use_module(private/basics/small_lists, [one_of/2]).
:- use_module(private/journal/causes, [acting_for/2, begins/1]).
:- use_module(private/run/prompt, [acting_at_prompt/1, reads_query/0]).
:- use_module(private/run/waits,
              [ in_guard/2, leave/2, let_others_go_on/0, listen_for_events/1,
                listening/3
              ]).
:- use_module(private/native/native,
              [ branches_begin_/0, branches_end_/0, branches_leave_/0,
                branches_look_/2, cause_now_/1, cause_set_/1, commands_/1,
                guards_/0, motors_stop_/2, now_/1, serve_at_prompt_/0,
                slices_/1, tick_after_/1
              ]).
:- use_module(time, [wait/1]).

:- fields(branch(number, engine, goal, over, commands, cause, brick)).

:- initialization(guards_, now).

:- meta_predicate
    on(0, 0),
    on(0, 0, +),
    every(+, 0),
    every(+, 0, +),
    after(+, 0),
    after(+, 0, +),
    until(0, 0),
    until(0, 0, -),
    both(0, 0),
    race(:, -).

/** <module> Events

Actions that happen while a program does something else, in one thread:

```
?- on(touch(_, 1), say(ouch)),
   every(5, ( battery(percent, P), writeln(P) )),
   until(( us_dist_cm(_, D), D < 20 ), go(40)).
```

The thread that calls on/2, every/2 or after/2 serves its events whenever it
waits or reads a sensor by a predicate of this pack: every 20 ms by the clock
of the brick, or of the simulation. The main thread also serves them while the
toplevel waits for a query, unless the clock is a virtual one, which stands
still there. A thread that only computes serves none.
There are no other threads. So nothing happens at the same time, and a run on
the virtual clock is the same each time.

Conditions are checked each time, so they should be quick, and must not wait.
One that reads a sensor in another mode than the last one takes 10 ms.
*/

%   event_(Brick, Id, Kind, Action): Kind is on(Condition, Options),
%   every(Seconds) or after(Seconds), in the order in which they were added.
%   state_(Brick, Id, State): State changes only when something happens. Next
%   is the number of the next event that gets no name.
:- thread_local
    event_/4,
    state_/3,
    next/2.                             % Brick, Next
:- of_brick([event_/4, state_/3, next/2]).

%   Seconds between two looks.
look_every(0.02).

%!  on(:Condition, :Action) is det.
%!  on(:Condition, :Action, +Options) is det.
%
%   From now on, call Action each time that Condition becomes true. Does not
%   wait. Condition is a goal, or compares sensors as for sensor_wait/1:
%   `us_dist_cm(in1) < 20`. Its bindings reach Action, as in
%   `on(( light(L), L < 20 ), format("~w~n", [L]))`. Action may move the robot
%   and wait; meanwhile the program is interrupted, and the event does not
%   happen again. Events of one moment happen in the order in which they were
%   added. If Action fails or throws, a message is printed and the event
%   stays; if Condition throws, a message is printed and the event ends.
%   Options:
%
%     - id(+Id)
%       A name for event_cancel/1. An event with the same Id is replaced.
%     - count(+N)
%       End after N times. Default is `inf`.
%     - stable(+Seconds)
%       Condition must have been true for that long. Default is 0.
%     - rearm(:Condition)
%       When the event may happen again. Default: when Condition is false. So
%       a threshold can have a second value:
%       `on(( light(L), L < 20 ), stop, [rearm(( light(M), M > 30 ))])`.
%     - armed(+Boolean)
%       If `false`, the event must be rearmed first: a Condition that is true
%       from the start has not become true. So a key that nobody pressed is
%       not released: `on(\+ touch(_, 1), stop, [armed(false)])`. Default is
%       `true`.
%
%   @error permission_error(wait, guard, Id) if Condition waits or
%          starts a motor
%   @error domain_error(event_option, Option)

on(Condition, Action) :-
    on(Condition, Action, []).

on(Condition0, Action, Options) :-
    must_be_goal(Condition0),
    condition_goal(Condition0, Condition),
    must_be_goal(Action),
    must_be_options(event_option, [id, count, stable, rearm, armed],
                    Options),
    option(stable(Stable0), Options, 0),
    number_value(seconds, Stable0, Stable),
    Condition = Module:_,
    (   option(rearm(Rearm0), Options)
    ->  must_be(callable, Rearm0),
        condition_goal(Module:Rearm0, Rearm1),
        Rearm = rearm(Rearm1)
    ;   Rearm = rearm
    ),
    option(armed(Armed), Options, true),
    must_be(boolean, Armed),
    count_option(Options, Count),
    (   Armed == true
    ->  State = armed(Count)
    ;   State = happened(Count)
    ),
    add_event(on(Condition, Stable, Rearm), Action, State, Options).

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

count_option(Options, Count) :-
    option(count(Count), Options, inf),
    (   Count == inf
    ->  true
    ;   must_be(positive_integer, Count)
    ).

add_event(Kind, Action, State, Options) :-
    brick(Brick),
    (   option(id(Id), Options)
    ->  must_be(ground, Id),
        forget(Brick, Id)
    ;   next_id(Brick, Id)
    ),
    in_own_name(assertz(event_(Brick, Id, Kind, Action))),  % not cyclic
    assertz(state_(Brick, Id, State)),
    look_every(Seconds),
    listen_for_events(Seconds),
    serve_at_prompt_.

next_id(Brick, Id) :-
    (   retract(next(Brick, Id0))
    ->  true
    ;   Id0 = 0
    ),
    Next is Id0 + 1,
    assertz(next(Brick, Next)),
    Id = Id0.

%!  event_cancel(?Id) is semidet.
%
%   End the event Id of this thread, or all if Id is unbound. Fails if this
%   thread has no such event.

event_cancel(Id) :-
    brick(Brick),
    \+ \+ event_(Brick, Id, _, _),
    forget(Brick, Id).

forget(Brick, Id) :-
    retractall(event_(Brick, Id, _, _)),
    retractall(state_(Brick, Id, _)).

%!  event(?Id, ?Kind) is nondet.
%
%   True if this thread has an event Id; Kind is `on`, `every` or `after`.

event(Id, Kind) :-
    brick(Brick),
    event_(Brick, Id, Term, _),
    functor(Term, Kind, _).

% ---------------- SERVE

:- multifile ev3dev_waits:serve_events/0.

ev3dev_waits:serve_events :-
    ev3dev_events:serve.

%   The events are those at the beginning: an action may add and cancel some.
serve :-
    brick(Own),
    findall(Brick, other_brick(Own, Brick), Others0),
    sort(Others0, Others),
    serve(Own),
    forall(one_of(Others, Brick),
           in_brick(Brick, serve(Brick))).

%   A simulation of with_sim/2 is for itself.
other_brick(Own, Brick) :-
    event_(Brick, _, _, _),
    Brick \== Own,
    \+ is_apart(Own),
    \+ is_apart(Brick).

serve(Brick) :-
    (   event_(Brick, _, _, _)
    ->  now_(Now),
        findall(Id, event_(Brick, Id, _, _), Ids),
        forall(( one_of(Ids, Id), event_(Brick, Id, Kind, Action),
                 state_(Brick, Id, State) ),
               serve(State, Kind, Id, Now, Action))
    ;   true
    ).

%   The native code calls this in the main thread while Prolog waits for input
%   at its terminal, if it is time to serve. It serves while the
%   toplevel waits for a query; it does not interrupt a program that reads, or
%   that a break or the tracer shows.
:- public serve_at_prompt/0.

serve_at_prompt :-
    (   reads_query,
        \+ ( current_prolog_flag(break_level, Level), Level > 0 )
    ->  look_every(Seconds),
        % Also while events are served, and after an exception.
        tick_after_(Seconds),
        catch(acting_at_prompt(serve), E, left_at_prompt(E)),
        tick_after_(Seconds)
    ;   true
    ).

%   No program could catch it.
left_at_prompt(E) :-
    (   ( E == '$aborted' ; E == unwind(abort) )
    ->  true
    ;   print_message(error, unhandled_exception(E))
    ).

serve(due(Next, Count), Kind, Id, Now, Action) :-
    !,
    (   Now + 1.0e-9 >= Next
    ->  again(Kind, Next, Count, State),
        change(Id, running(State)),
        happen(Id, Kind, Action)
    ;   true
    ).
serve(running(_), _Kind, _Id, _Now, _Action) :- !.
serve(happened(Count), on(Condition, _, Rearm), Id, _, _) :-
    !,
    (   is_armed(Rearm, Id, Condition)
    ->  change(Id, armed(Count))
    ;   true
    ).
serve(State, on(Condition, Stable, _), Id, Now, Action) :-
    (   looked_at(Id, Condition)        % its bindings reach Action
    ->  (   is_stable(State, Stable, Id, Now, Count)
        ->  (   Count == 1
            ->  After = over
            ;   less(Count, Left),
                After = happened(Left)
            ),
            change(Id, running(After)),
            happen(Id, on(Condition), Action)
        ;   true
        )
    ;   State = since(_, Count)
    ->  change(Id, armed(Count))
    ;   true
    ).

%   An error in a condition is printed once, and ends the event.
looked_at(Id, Condition) :-
    catch(in_guard(Id, Condition), E, true),
    (   var(E)
    ->  true
    ;   E = error(_, _),
        E \= error(permission_error(wait, guard, _), _)
    ->  change(Id, over),
        print_error(E, Id, on),
        fail
    ;   throw(E)
    ).

again(after(_), _, _, over).
again(every(Seconds), Next0, Count0, State) :-
    (   Count0 == 1
    ->  State = over
    ;   less(Count0, Count),
        Next is Next0 + Seconds,
        State = due(Next, Count)
    ).

less(inf, inf) :- !.
less(Count0, Count) :-
    Count is Count0 - 1.

is_armed(rearm, Id, Condition) :-
    \+ looked_at(Id, Condition).
is_armed(rearm(Condition), Id, _) :-
    \+ \+ looked_at(Id, Condition).

is_stable(since(Since, Count), Stable, _, Now, Count) :-
    Now + 1.0e-9 >= Since + Stable.
is_stable(armed(Count), Stable, Id, Now, Count) :-
    (   Stable =:= 0
    ->  true
    ;   change(Id, since(Now, Count)),
        fail
    ).

%   A missed time is not made up for.
happened(Id) :-
    brick(Brick),
    (   event_(Brick, Id, Kind, _),
        state_(Brick, Id, running(State0))
    ->  now_(Now),
        (   State0 = due(Next0, Count),
            Next0 < Now,
            Kind = every(Seconds)
        ->  Missed is ceiling((Now - Next0) / max(Seconds, 0.001)),
            Next is Next0 + Missed * Seconds,
            State = due(Next, Count)
        ;   State = State0
        ),
        change(Id, State)
    ;   true                            % the action has ended it
    ).

change(Id, State) :-
    brick(Brick),
    (   State == over
    ->  forget(Brick, Id)
    ;   retract(state_(Brick, Id, _))
    ->  assertz(state_(Brick, Id, State))
    ;   true
    ).

%   Prints errors; a program's own interrupt goes on its way. The event stays
%   in either case, also after an abort, which catch/3 does not see.
happen(Id, Kind, Action) :-
    setup_call_cleanup(true,
                       act(Id, Kind, Action),
                       happened(Id)).

act(Id, Kind, Action) :-
    functor(Kind, Name, _),
    event_condition(Kind, Condition),
    (   of_library(Action)
    ->  true
    ;   begins(event(Id, Condition))
    ),
    catch(acting_for(ev3dev_events:ignore_failure(Id, Name, Action),
                     event(Id, Condition)),
          E, true),
    (   var(E)
    ->  true
    ;   E = error(_, _)
    ->  print_error(E, Id, Name)
    ;   throw(E)
    ).

%   Events of the libraries themselves would fill the log of the page.
of_library(Module:_) :-
    sub_atom(Module, 0, _, _, ev3dev_).

event_condition(on(_:Condition), Values) :-
    !,
    copy_term_nat(Condition, Values).
event_condition(Kind, Kind).

print_error(E0, Id, Name) :-
    format(atom(Where), 'in event ~p (~w)', [Id, Name]),
    error_within(E0, Where, E),
    print_message(error, E).

ignore_failure(Id, Name, Action) :-
    (   goal_of_program(Action)
    ->  true
    ;   print_message(warning, ev3dev(event_failed(Id, Name)))
    ).

:- multifile prolog:message//1.

prolog:message(ev3dev(event_failed(Id, Name))) -->
    [ 'The action of event ~p (~w) failed'-[Id, Name] ].

% ---------------- UNTIL

%!  until(:Condition, :Goal) is semidet.
%!  until(:Condition, :Goal, -Which) is semidet.
%
%   Call Goal, and interrupt it as soon as Condition is true: a move is
%   stopped, and so are motors that Goal has started. If Goal has started
%   something that goes on by itself, such as go/1, until/2 waits until
%   Condition is true. Which is `condition`, or `goal` if Goal succeeded
%   before. Fails if Goal fails. If Condition is true at once, Goal is not
%   called.
%
%   ```
%   ?- until(touch(_, 1), go(30)).
%   ?- until(us_dist_cm(in1) < 20, go(30)).
%   ?- until(( us_dist_cm(_, D), D < 20 ), forever_zigzag).
%   ```
%
%   Condition is checked every 20 ms while Goal waits or reads sensors.
%
%   @error permission_error(wait, guard, until) if Condition waits or
%          starts a motor

until(Condition, Goal) :-
    until(Condition, Goal, _).

until(Condition0, Goal, Which) :-
    must_be_goal(Condition0),
    condition_goal(Condition0, Condition),
    must_be_goal(Goal),
    must_be_which(Which),
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

must_be_which(Which) :-
    (   ( var(Which) ; memberchk(Which, [condition, goal]) )
    ->  true
    ;   throw_error(domain_error(until_which, Which), _,
                    'put parentheses around a condition of several goals, \c
                     as in until((Goal1, Goal2), Goal)')
    ).

until_tick(Id, Condition, Listener) :-
    (   in_guard(until, Condition)
    ->  leave(Listener, ev3dev_until(Id))
    ;   true
    ).

%   Waits forever after a goal that did not wait: what it started goes on.
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

% ---------------- BRANCHES

%!  both(:Goal1, :Goal2) is semidet.
%!  race(:Goals, -Winner) is semidet.
%
%   Call goals at the same time, in this thread: each goes on when another one
%   waits. both/2 succeeds when both have succeeded; if one fails, the other
%   is interrupted, and both/2 fails. race/2 succeeds when the first of a list
%   of Goals succeeds, and interrupts the others: their moves stop, and so do
%   the motors that they have started. Winner is the number of the first, from
%   1 on; if several succeed at the same time, the earliest in the list.
%   race/2 fails if all goals fail.
%
%   ```
%   ?- both(go_cm(30, 100), tones([tone(440, 500), tone(880, 500)])).
%   ?- race([go_cm(30, 100), button_wait(enter, pressed)], Winner).
%   ```
%
%   A goal that reads sensors and does not wait lets the others go on every
%   20 ms; one that only computes lets no other go on. Events that a goal adds
%   end with it.
%
%   @error existence_error(feature, engines) in SWI-Prolog before 7.3.26
%   @error what one of the goals throws; the others are interrupted

both(Goal1, Goal2) :-
    must_be_goal(Goal1),
    must_be_goal(Goal2),
    branches([Goal1, Goal2], all, _).

race(Module:Goals0, Winner) :-
    must_be(list, Goals0),
    forall(one_of(Goals0, Goal), must_be_goal(Goal)),
    qualified(Goals0, Module, Goals),
    branches(Goals, first, Winner0),
    Winner = Winner0.

qualified([], _, []).
qualified([Goal|Goals], Module, [Module:Goal|Qualified]) :-
    qualified(Goals, Module, Qualified).

:- if(current_predicate(engine_create/3)).

branches(Goals, Which, Winner) :-
    setup_call_cleanup(
        created(Goals, 1, Branches),
        run_branches(Branches, Which, Winner),
        leave_branches(Branches)).

%   branch(Number, Engine, Goal, Over, Commands, Cause, Brick): Over is
%   `false`, true(Goal) or `failed`, Commands are the ranges of commands that
%   it gave, Cause is what it acts for, and Brick is in use there. These are
%   changed by nb_setarg/3.

created([], _, []).
created([Goal|Goals], Number,
        [branch(Number, Engine, Goal, false, [], [], Brick)|Branches]) :-
    brick(Brick),
    branch_seed(Seed),
    engine_create(Goal, ev3dev_events:in_branch(Goal, Seed), Engine),
    Next is Number + 1,
    created(Goals, Next, Branches).

in_branch(Goal, Seed) :-
    b_setval(ev3dev_branch, true),
    seed_branch(Seed),
    goal_of_program(Goal),
    !.

run_branches(Branches, Which, Winner) :-
    repeat,
    setup_call_cleanup(                 % also after an abort
        branches_begin_,
        once(( each_goes_on(Branches, Which),
               branches_look_(Seconds, Bricks)
             )),
        branches_end_),
    (   is_decided(Branches, Which, Decision)
    ->  true
    ;   Seconds > 0
    ->  wait_in(Bricks, Seconds),
        fail
    ;   let_others_go_on,
        fail
    ),
    !,
    Decision = over(Winner),
    taken_over(Branches, Which, Winner).

wait_in([], _).
wait_in([Brick|Bricks], Seconds) :-
    in_brick(Brick, wait(Seconds)),
    wait_in(Bricks, Seconds).

%   In the order of the list; a race is over with the first.
each_goes_on([], _).
each_goes_on([Branch|Branches], Which) :-
    (   Branch = branch(over: false)
    ->  goes_on(Branch)
    ;   true
    ),
    (   Which == first,
        Branch = branch(over: true(_))
    ->  true
    ;   Which == all,
        Branch = branch(over: failed)
    ->  true
    ;   each_goes_on(Branches, Which)
    ).

goes_on(Branch) :-
    Branch = branch(engine: Engine),
    commands_(From),
    % A branch has its own brick, and its own cause.
    brick(OuterBrick),
    Branch = branch(brick: Brick),
    switch_brick(Brick),
    cause_now_(Outer),
    Branch = branch(cause: Cause),
    (   Cause == []
    ->  true
    ;   cause_set_(Cause)
    ),
    (   catch(engine_next(Engine, Answer), E, true)
    ->  (   nonvar(E)
        ->  set_field(Branch, branch(over: failed))
        ;   Answer == tick
        ->  true
        ;   set_field(Branch, branch(over: true(Answer)))
        )
    ;   set_field(Branch, branch(over: failed))
    ),
    cause_now_(Own),
    set_field(Branch, branch(cause: Own)),
    cause_set_(Outer),
    brick(OwnBrick),
    set_field(Branch, branch(brick: OwnBrick)),
    switch_brick(OuterBrick),
    commands_(Before),
    (   From =:= Before
    ->  true
    ;   Branch = branch(commands: Commands),
        joined(Commands, From, Before, Joined),
        set_field(Branch, branch(commands: Joined))
    ),
    (   nonvar(E)
    ->  throw(E)
    ;   true
    ).

joined([From0-From|Ranges], From, Before, [From0-Before|Ranges]) :- !.
joined(Ranges, From, Before, [From-Before|Ranges]).

is_decided(Branches, first, over(Winner)) :-
    (   one_of(Branches, Branch),
        Branch = branch(over: true(_))
    ->  Branch = branch(number: Winner)
    ;   \+ ( one_of(Branches, Branch), Branch = branch(over: false) ),
        Winner = none
    ).
is_decided(Branches, all, over(Winner)) :-
    (   one_of(Branches, Branch),
        Branch = branch(over: failed)
    ->  Winner = none
    ;   \+ ( one_of(Branches, Branch), Branch = branch(over: false) ),
        Winner = all
    ).

%   The bindings of what has succeeded.
taken_over(Branches, first, Winner) :-
    integer(Winner),
    one_of(Branches, branch(number: Winner, goal: Goal, over: true(Goal))),
    !.
taken_over(Branches, all, all) :-
    answers(Branches).

answers([]).
answers([Branch|Branches]) :-
    Branch = branch(goal: Goal, over: true(Goal)),
    answers(Branches).

%   To destroy an engine runs its clean-ups, which may wait.
leave_branches([]).
leave_branches([Branch|Branches]) :-
    Branch = branch(engine: Engine, over: Over, commands: Commands,
                    brick: Brick),
    (   Over == false
    ->  motors_stopped(Commands)
    ;   true
    ),
    setup_call_cleanup(
        branches_leave_,
        in_brick(Brick, catch(engine_destroy(Engine), _, true)),
        branches_end_),
    leave_branches(Branches).

motors_stopped([]).
motors_stopped([From-Before|Ranges]) :-
    motors_stop_(From, Before),
    motors_stopped(Ranges).

:- multifile ev3dev_waits:yield/0.

ev3dev_waits:yield :-
    engine_yield(tick).

:- else.

branches(_, _, _) :-
    throw_error(existence_error(feature, engines), _,
                'this SWI-Prolog has no engines').

:- endif.
