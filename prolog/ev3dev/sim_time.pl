:- module(ev3dev_sim_time,
          [ sim_wait/1,                 % +Seconds
            sim_step/1,                 % +Seconds
            sim_time/1,                 % -Seconds
            sim_snapshot/1,             % -Snapshot
            sim_restore/1,              % +Snapshot
            sim_at/2,                   % +Seconds, :Goal
            for_seconds/2               % +Seconds, :Goal
          ]).
:- set_prolog_flag(generate_debug_info, false).
:- use_module(private/checks/checks,
              [evaluated/2, must_be/2, must_be_goal/1]).
:- use_module(private/errors/errors, [domain_error/2]).
:- use_module(private/errors/frames, [goal_of_program/1]).
:- use_module(private/errors/public_clauses, [term_expansion/4]).
:- use_module(private/checks/arguments, [number_value/3]).
:- use_module(private/simulation/time_limits,
              [clock_changes/1, within_seconds/3]).
:- use_module(private/simulation/schedule, [plan/3]).
:- use_module(private/run/brick, [is_simulated/0]).
:- use_module(private/run/waits, [waited/1]).
:- use_module(sim_hand, [added_facts/1, set_added_facts/1]).
:- use_module(private/native/native,
              [ commands_/1, motors_stop_/2, running_/1, sim_restore_/1,
                sim_snapshot_/1, sim_snapshots_/1, sim_step_/1, sim_time_/1,
                sim_wait_/2, slices_/1 ]).

:- meta_predicate
    sim_at(+, 0),
    for_seconds(+, 0),
    to_the_end(0, +).

/** <module> Simulated time

The part of library(ev3dev/sim) that lets time pass, and goes back in time.
All predicates fail if no simulation runs.
*/

%!  sim_wait(+Seconds) is semidet.
%
%   Wait until Seconds of simulated time have passed, like wait/1 of
%   library(ev3dev/time), which also works on a brick.
%   With the virtual clock, time jumps to the end of the wait as soon as no
%   other thread runs or waits for an earlier moment. Seconds may be an
%   arithmetic expression.
%
%   @error domain_error(seconds, Seconds) if Seconds is negative

sim_wait(Seconds0) :-
    evaluated(Seconds0, Seconds),
    sim_wait_(Seconds, Reason),
    waited(Reason),
    !.

%!  sim_step(+Seconds) is semidet.
%
%   Let Seconds of simulated time pass at once, with any clock. Seconds may be
%   an arithmetic expression.
%
%   @error domain_error(seconds, Seconds) if Seconds is negative

sim_step(Seconds0) :-
    evaluated(Seconds0, Seconds),
    sim_step_(Seconds).

%!  sim_time(-Seconds) is semidet.
%
%   True if Seconds of simulated time have passed since the start.

sim_time(Seconds) :-
    sim_time_(Seconds).

%!  sim_snapshot(-Snapshot) is semidet.
%!  sim_restore(+Snapshot) is semidet.
%
%   Save the state of the simulation, and restore it: the robot, its motors
%   and sensors, the world and the time. A program can restore a Snapshot any
%   number of times, and so compare what different actions do. A Snapshot
%   takes about 20 kB.

sim_snapshot(snapshot(State, Added)) :-
    collect_snapshots,
    sim_snapshot_(State),
    added_facts(Added).

sim_restore(Snapshot) :-
    must_be(nonvar, Snapshot),
    (   Snapshot = snapshot(State, Added)
    ->  true
    ;   domain_error(simulator_snapshot, Snapshot)
    ),
    clock_changes(sim_restore_(State)),
    set_added_facts(Added).

%   Prolog counts the atoms that may be garbage and collects after 10000. It
%   cannot learn that a snapshot is larger than others. So those are counted
%   here.

:- dynamic collection_at/1.

collection_at(1000).

collect_snapshots :-
    sim_snapshots_(Count),
    collection_at(Limit),
    Count >= Limit,
    !,
    garbage_collect_atoms,
    sim_snapshots_(Left),
    Next is max(1000, 2*Left),
    retractall(collection_at(_)),
    assertz(collection_at(Next)).
collect_snapshots.

%!  sim_at(+Seconds, :Goal) is semidet.
%
%   Plan to call Goal once at a simulated time, see sim_time/1. Does not wait.
%   So a test lets something happen to a program:
%
%   ```
%   ?- sim_at(3, sim_unplug(outB)), go_cm(20, 200).
%   ```
%
%   Goal runs in the thread that planned it, as soon as this thread waits for
%   a move, a sound or a button, or uses a device, and the time has come; so
%   it may come a little late, and not at all while the thread only computes.
%   An exception of Goal ends what the thread was doing, and a Goal that fails
%   prints a warning. The plans end with the simulation. sim_restore/1 does
%   not plan again what has run. For keys and touch sensors, sim_press/2 is
%   more exact.
%
%   @error domain_error(seconds, Seconds)

sim_at(Seconds0, Goal) :-
    number_value(seconds, Seconds0, Seconds),
    must_be_goal(Goal),
    sim_time_(_),
    plan(Seconds, Goal, _).

%!  for_seconds(+Seconds, :Goal) is semidet.
%
%   Call Goal once, and leave it when Seconds of simulated time have passed,
%   also if Goal starts a simulation of its own, or goes back in time: so a
%   test runs a program that does not end by itself. Succeeds when the
%   time is over, or earlier if Goal succeeds; fails if Goal fails before.
%   When the time is over, the motors that Goal started are stopped. If Goal
%   only starts motors, such as go/1, for_seconds/2 waits until then.
%
%   Goal is left by an abort, so it may catch all exceptions. Its clean-ups
%   have another second of simulated time; what goes on then, as `main :-
%   catch(run, _, main)`, is left all the same, wherever it is.
%
%   On the virtual clock no time passes while Goal computes. It may use 100
%   million inferences for each second of simulated time, and as many while
%   time stands, which takes some seconds; then it is left, and for_seconds/2
%   throws an error. So it does after 120 s by the wall clock in which Goal
%   sleeps, or reads from the terminal, and no time passes; computing counts
%   a tenth, and nothing counts while it is debugged. (A goal of race/2 or
%   both/2 that only computes is not left.)
%
%   @error domain_error(seconds, Seconds)
%   @error resource_error(inferences) if Goal is left because it computes
%   @error resource_error(seconds) if Goal is left because it sleeps

for_seconds(Seconds0, Goal) :-
    number_value(seconds, Seconds0, Seconds),
    must_be_goal(Goal),
    sim_time_(_),
    commands_(From),
    within_seconds(Seconds, ev3dev_sim_time:to_the_end(Goal, From), How),
    (   How == over,
        is_simulated                    % Goal may have ended that
    ->  commands_(Before),
        motors_stop_(From, Before)
    ;   true
    ).

to_the_end(Goal, From) :-
    slices_(Slices0),
    goal_of_program(Goal),
    !,
    slices_(Slices),
    commands_(Before),
    (   Slices =:= Slices0,
        Before =\= From,
        running_([_|_])
    ->  repeat,
        sim_wait(3600),
        fail
    ;   true
    ).
