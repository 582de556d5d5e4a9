:- module(ev3dev_schedule,
          [ plan/3,                     % +Seconds, :Goal, -Id
            plan/4,                     % +Seconds, :Goal, +Id, +Thread
            unplan/1,                   % +Id
            planned/4,                  % ?Seconds, ?Id, ?Thread, ?Goal
            run_due_goals/0,
            clock/1                     % -Seconds
          ]).
:- use_module('../basics/fields',
              [fields/1, goal_expansion/2, term_expansion/2]).
:- use_module('../run/brick', [brick/1, of_brick/1]).
:- use_module('../errors/frames', [goal_of_program/1]).
:- use_module('../native/native', [sim_clock_/1, sim_plan_/1]).

:- fields(planned(brick, seconds, id, thread, goal)).

:- meta_predicate
    plan(+, 0, -),
    plan(+, 0, +, +).

/** <module> Goals that are planned for a simulated time

Each runs in the thread that planned it, when this waits or uses a device.
*/

:- dynamic planned/5.                   % Brick, Seconds, Id, Thread, Goal
:- of_brick([planned/5]).

%!  planned(?Seconds, ?Id, ?Thread, ?Goal) is nondet.
%
%   True if Goal is planned for that simulated time of the brick in use, in
%   Thread.

planned(Seconds, Id, Thread, Goal) :-
    brick(Brick),
    planned(Brick, Seconds, Id, Thread, Goal).

%!  clock(-Seconds) is semidet.
%
%   True if Seconds of simulated time have passed since the start. Takes no
%   turn, and no time passes. Fails if no simulation runs.

clock(Seconds) :-
    sim_clock_(Seconds).

%!  plan(+Seconds, :Goal, -Id) is det.
%!  plan(+Seconds, :Goal, +Id, +Thread) is det.
%
%   Call Goal once at that simulated time, in this thread, or in Thread. If
%   that is another one, only its next plan of its own rings its bell.

plan(Seconds, Goal, Id) :-
    thread_self(Me),
    flag(ev3dev_sim_plan, Id, Id + 1),
    plan(Seconds, Goal, Id, Me).

plan(Seconds, Goal, Id, Thread) :-
    brick(Brick),
    assertz(planned(Brick, Seconds, Id, Thread, Goal)),
    (   thread_self(Thread)
    ->  ring(Seconds)
    ;   true
    ).

ring(Seconds) :-
    (   clock(Now)
    ->  After is max(0, Seconds - Now),
        sim_plan_(After)
    ;   true
    ).

%!  unplan(+Id) is det.

unplan(Id) :-
    retractall(planned(id: Id)).

%!  run_due_goals is det.
%
%   Call the goals that this thread has planned and whose time has come. The
%   native code calls this when a plan of this thread is due.

run_due_goals :-
    thread_self(Me),
    brick(Brick),
    clock(Now),
    findall(Seconds-Id, planned(Brick, Seconds, Id, Me, _), Planned0),
    msort(Planned0, Planned),
    run_due(Planned, Brick, Now, Me),
    !.
run_due_goals.

:- multifile ev3dev_waits:serve_planned/0.

ev3dev_waits:serve_planned :-
    planned(brick: _),
    !,
    run_due_goals.

%   The clock counts nanoseconds.
run_due([Seconds-Id|Planned], Brick, Now, Me) :-
    Seconds =< Now + 1.0e-6,
    !,
    (   retract(planned(Brick, Seconds, Id, Me, Goal))
    ->  run_planned(Goal)
    ;   true
    ),
    run_due(Planned, Brick, Now, Me).
run_due([Seconds-_|_], _, _, _) :-
    % An earlier one was due, or sim_restore/1 went back in time.
    ring(Seconds).

run_planned(Goal) :-
    (   goal_of_program(Goal)
    ->  true
    ;   print_message(warning, ev3dev(planned_goal_failed(Goal)))
    ).

:- multifile prolog:message//1.

prolog:message(ev3dev(planned_goal_failed(Goal))) -->
    [ 'A goal planned by sim_at/2 failed: ~p'-[Goal] ].
