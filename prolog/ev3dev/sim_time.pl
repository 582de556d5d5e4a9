:- module(ev3dev_sim_time,
          [ sim_wait/1,                 % +Seconds
            sim_step/1,                 % +Seconds
            sim_time/1,                 % -Seconds
            sim_snapshot/1,             % -Snapshot
            sim_restore/1               % +Snapshot
          ]).
:- set_prolog_flag(generate_debug_info, false).
:- use_module(private/errors,
              [ domain_error/2, evaluated/2, must_be/2, term_expansion/2
              ]).
:- use_module(sim_hand, [added_facts/1, set_added_facts/1]).
:- use_module(private/native,
              [ sim_restore_/1, sim_snapshot_/1, sim_snapshots_/1,
                sim_step_/1, sim_time_/1, sim_wait_/1 ]).

/** <module> Simulated time

The part of library(ev3dev/sim) that lets time pass, and goes back in time.
All predicates fail if no simulation runs.
*/

%!  sim_wait(+Seconds) is semidet.
%
%   Wait until Seconds of simulated time have passed, like sleep/1 on a brick.
%   With the virtual clock, time jumps to the end of the wait as soon as no
%   other thread runs or waits for an earlier moment. Seconds may be an
%   arithmetic expression.
%
%   @error domain_error(seconds, Seconds) if Seconds is negative

sim_wait(Seconds0) :-
    evaluated(Seconds0, Seconds),
    sim_wait_(Seconds).

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
    sim_restore_(State),
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
