:- module(ev3dev_time_limits,
          [ within_seconds/3,           % +Seconds, :Goal, -How
            clock_changes/1,            % :Goal
            forget_plans/0
          ]).
:- use_module('../run/brick', [brick/1]).
:- use_module('../errors/errors', [throw_error/3]).
:- use_module('../errors/frames', [goal_of_program/1]).
:- use_module('../native/native',
              [ limit_call_/2, limit_insist_/4, thought_begins_/1,
                thought_nothing_/2 ]).
:- use_module(schedule,
              [clock/1, plan/3, plan/4, planned/4, unplan/1]).
:- use_module('../basics/small_lists', [one_of/2]).

:- meta_predicate
    within_seconds(+, 0, -),
    clock_changes(0).

/** <module> Limits of the time that a goal may take

The end of for_seconds/2 is a plan, which is made again whenever another clock
is in use. So it counts on also in a simulation that Goal starts itself.

A goal is left by an abort, which catch/3 throws again when it has caught it,
until it comes to limit_call_/2. A goal that goes on all the same, in the
recovery or in a clean-up, has a grace; from then on it is aborted again
before each goal that it calls.

While a program computes, no time passes on the virtual clock, and the plan
does not come. An alarm looks at the goal five times a second by the wall
clock. What it looks at are inferences, which do not depend on the machine,
and seconds in which the goal is idle: on a slow processor computing is long.
*/

:- dynamic
    limit/3,                            % Id, Thread, Way
    held/4,                             % Brick, Id, Thread, Seconds left
    left/3,                             % Id, Thread, Why
    used/5,                             % Id, Inferences, all Inferences so
                                        % far, Time, Idle
    alarm_of/2,                         % Id, Alarm
    aborts/1,                           % Ball
    most/2.                             % Inferences, Seconds

:- volatile
    aborts/1.

%   For each second of simulated time, and as long as none passes; seconds in
%   which it is idle while none passes. A brick has less than a million
%   inferences in a second.
most(100000000, 120).

%   How long a clean-up may take: seconds of simulated time, inferences,
%   seconds in which it is idle.
grace(1, 10000000, 10).

%   In seconds. A test looks more often.
:- dynamic look_every/1.
look_every(0.2).

%!  within_seconds(+Seconds, :Goal, -How) is semidet.
%
%   Call Goal once, and leave it when Seconds of simulated time have passed.
%   How is `over` then, else `ended`.
%
%   @error resource_error(inferences) if Goal computes for too long, and no
%          time passes
%   @error resource_error(seconds) if it sleeps for too long

within_seconds(Seconds, Goal, How) :-
    clock(Now),
    End is Now + Seconds,
    setup_call_cleanup(
        begin_limit(End, Id),
        within_limit(Id, Goal, How),
        end_limit(Id)).

begin_limit(End, Id) :-
    plan(End, ev3dev_time_limits:time_is_up(Id), Id),
    thread_self(Me),
    (   nb_current(ev3dev_branch, Branch),
        Branch \== []
    ->  Way = branch
    ;   Way = thread
    ),
    assertz(limit(Id, Me, Way)),
    begin_use(Id),
    set_alarm(Id).

end_limit(Id) :-
    retractall(limit(Id, _, _)),
    forall(retract(alarm_of(Id, Alarm)),
           remove_alarm(Alarm)),
    unplan(Id),
    retractall(held(_, Id, _, _)),
    retractall(used(Id, _Inferences, _, _, _)),
    retractall(left(Id, _, _)).

%   The engine of a branch could not yield to others from native code.
within_limit(Id, Goal, How) :-
    (   limit(Id, _, thread)
    ->  limit_call_(Id, Goal)
    ;   catch(once(goal_of_program(Goal)), ev3dev_time_is_up(Id), true)
    ),
    (   \+ left(Id, _, _)
    ->  How = ended
    ;   left(Id, _, over)
    ->  How = over
    ;   left(Id, _, Why),
        too_much(Why, Text),
        throw_error(resource_error(Why), for_seconds/2, Text)
    ).

too_much(inferences, Text) :-
    most(Most, _),
    format(atom(Text),
           'the program computed for ~D inferences, and lets no simulated \c
            time pass; a loop needs wait/1, or reads a sensor', [Most]).
too_much(seconds, Text) :-
    most(_, Most),
    format(atom(Text),
           'the program slept for ~w s, or read, and lets no simulated time \c
            pass; wait/1 does', [Most]).

time_is_up(Id) :-
    leave(Id, over).

leave(Id, Why) :-
    (   left(Id, _, _)
    ->  insist(Id)
    ;   thread_self(Me),
        assertz(left(Id, Me, Why)),
        begin_use(Id),
        grace(Seconds, _, _),
        unplan(Id),
        (   clock(Now)
        ->  Again is Now + Seconds,
            plan(Again, ev3dev_time_limits:time_is_up(Id), Id, Me)
        ;   true
        ),
        ball(Id, Ball),
        throw(Ball)
    ).

:- public insist/1.

insist(Id) :-
    ball(Id, Ball),
    (   limit(Id, Thread, thread)
    ->  limit_insist_(Id, Thread, ev3dev_time_limits:insist(Id), Ball)
    ;   limit(Id, _, branch)
    ->  throw(Ball)
    ;   true
    ).

ball(Id, Ball) :-
    (   limit(Id, _, branch)
    ->  Ball = ev3dev_time_is_up(Id)
    ;   abort_ball(Ball)
    ).

%   What abort/0 throws, without what else it does: it drops what was written
%   and is not flushed yet. Newer versions have another term.
abort_ball(Ball) :-
    (   aborts(_)
    ->  true
    ;   limit_call_(-1, catch(throw('$aborted'), _, true)),
        (   aborts(_)
        ->  true
        ;   assertz(aborts(unwind(abort)))
        )
    ),
    aborts(Ball),
    !.

%!  is_left_by(+Id, +Ball) is semidet.
%
%   True if Ball leaves the goal of the limit Id, and not that of one around
%   it. limit_call_/2 calls this when Ball has come to it.

:- public is_left_by/2.

is_left_by(-1, Ball) :-
    !,
    assertz(aborts(Ball)).
is_left_by(Id, Ball) :-
    left(Id, Me, _),
    abort_ball(Ball),
    \+ ( left(Outer, Me, _),
         Outer < Id
       ).

% ---------------- ALARM

%   In a Prolog without library(time) nothing looks.
set_alarm(Id) :-
    look_every(Seconds),
    Alarm = time:alarm(Seconds, ev3dev_time_limits:look(Id), New,
                       [remove(true)]),
    (   catch(use_module(library(time), []), error(_, _), fail),
        catch(Alarm, error(_, _), fail)
    ->  assertz(alarm_of(Id, New))
    ;   true
    ).

remove_alarm(Alarm) :-
    Remove = time:remove_alarm(Alarm),
    catch(Remove, error(_, _), true).

:- public look/1.

look(Id) :-
    (   thought_begins_(Before)
    ->  looked(Id),
        thought_nothing_(Before, 3)
    ;   looked(Id)
    ).

looked(Id) :-
    retractall(alarm_of(Id, _)),
    (   limit(Id, _, _)
    ->  set_alarm(Id),
        use(Id, Inferences, Idle),
        allowed(Id, MostInferences, MostIdle),
        (   Inferences > MostInferences
        ->  leave(Id, inferences)
        ;   Idle > MostIdle
        ->  leave(Id, seconds)
        ;   is_overdue(Id)
        ->  leave(Id, over)
        ;   true
        )
    ;   true
    ).

allowed(Id, Inferences, Seconds) :-
    (   left(Id, _, _)
    ->  grace(_, Inferences, Seconds)
    ;   most(Inferences, Seconds)
    ),
    !.

%   By a clock that follows the wall, a goal that computes is left here.
is_overdue(Id) :-
    planned(End, Id, _, _),
    clock(Now),
    Now > End + 0.5.

%   What was used since: inferences, less those for which there was time, and
%   seconds in which it was idle since time has passed. In the debugger a
%   person thinks, not the program.

begin_use(Id) :-
    used_so_far(All, Now, Idle),
    retractall(used(Id, _Inferences, _, _, _)),
    assertz(used(Id, 0, All, Now, Idle)).

use(Id, Inferences, Seconds) :-
    used_so_far(All, Now, Idle),
    retract(used(Id, Inferences0, All0, Before, Since0)),
    !,
    passed(Before, Now, Passed),
    most(Most, _),
    Inferences is max(0, Inferences0 + All - All0 - truncate(Passed*Most)),
    (   Now == Before,
        \+ current_prolog_flag(debug, true)
    ->  Since = Since0
    ;   Since = Idle
    ),
    Seconds is Idle - Since,
    assertz(used(Id, Inferences, All, Now, Since)).

passed(Before, Now, Passed) :-
    (   number(Before),
        number(Now)
    ->  Passed is max(0, Now - Before)
    ;   Passed = 0
    ).

%   Computing counts a tenth: a step may take long, and be one inference. To
%   wait for a processor counts nothing.
used_so_far(All, Now, Idle) :-
    statistics(inferences, All),
    statistics(cputime, Computed),
    waited_for_processor(Delay),
    get_time(Wall),
    Idle is Wall - 0.9*Computed - Delay,
    ignore(clock(Now)).

%   The kernel says it in nanoseconds, in the second number of this file. If
%   it does not, such waiting counts as idle.
waited_for_processor(Seconds) :-
    catch(setup_call_cleanup(
              open('/proc/thread-self/schedstat', read, In),
              read_string(In, _, Text),
              close(In)), error(_, _), fail),
    split_string(Text, " ", "", [_, Delay|_]),
    number_string(Nanoseconds, Delay),
    !,
    Seconds is Nanoseconds/1.0e9.
waited_for_processor(0).

% ---------------- OTHER CLOCKS

%!  clock_changes(:Goal) is semidet.
%
%   Call Goal once, which starts a simulation, ends it, or goes back in time.
%   What time is left to within_seconds/3 is left after it, too, in whatever
%   simulation that is, and stands still while there is none.

clock_changes(Goal) :-
    clock_changes(_, Goal).

%   Of one thread, or of all.
clock_changes(Thread, Goal) :-
    findall(Id-Left, time_left(Id, Thread, Left), Limits),
    once(Goal),
    forall(( one_of(Limits, Id-Left),
             limit(Id, Of, _)           % its goal may have ended meanwhile
           ),
           count_on(Id, Of, Left)).

:- multifile ev3dev_brick:switch/1.

ev3dev_brick:switch(Goal) :-
    thread_self(Me),
    limit(_, Me, _),
    !,
    clock_changes(Me, Goal).

time_left(Id, Thread, Left) :-
    clock(Now),
    planned(End, Id, Thread, ev3dev_time_limits:time_is_up(Id)),
    Left is max(0, End - Now).
time_left(Id, Thread, Left) :-
    brick(Brick),
    held(Brick, Id, Thread, Left).

count_on(Id, Thread, Left) :-
    unplan(Id),
    retractall(held(_, Id, _, _)),
    (   clock(Now)
    ->  End is Now + Left,
        plan(End, ev3dev_time_limits:time_is_up(Id), Id, Thread)
    ;   brick(Brick),
        assertz(held(Brick, Id, Thread, Left))
    ).

%!  forget_plans is det.
%
%   Forget what sim_at/2 has planned: the simulation ends.

forget_plans :-
    forall(( planned(_, Id, _, Goal),
             Goal \= ev3dev_time_limits:time_is_up(_)
           ),
           unplan(Id)).
