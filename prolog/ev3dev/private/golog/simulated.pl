:- module(ev3dev_golog_simulated,
          [ tried_in_simulator/5,       % +Entry, +Situation0, +Situation1,
                                        % -Situation, +Context
            simulation_kept/1           % :Goal
          ]).
:- use_module(library(lists), [member/2]).
:- use_module(context, [context_module/2]).
:- use_module(progression, [entries_done/4]).
:- use_module(theory, [has_clauses/2]).
:- use_module(world, [run_directly/4, sensing_entries/4]).

/** <module> Search that tries the robot's actions in the simulator

For the option simulate(true) of search/2 and search/3. Each action that the
search considers is carried out in the simulation, by robot_action/2 or
robot_sense/3. If it fails, the plan goes another way. When the search goes
back, so does the simulation, and after the search all is as it was before.
*/

:- meta_predicate simulation_kept(0).

%!  simulation_kept(:Goal) is semidet.
%
%   Call Goal once. Then the simulation, if one runs, is where it was.

simulation_kept(Goal) :-
    (   simulates
    ->  setup_call_cleanup(
            ev3dev_sim_time:sim_snapshot(Snapshot),
            once(Goal),
            ev3dev_sim_time:sim_restore(Snapshot))
    ;   once(Goal)
    ).

simulates :-
    current_predicate(ev3dev_sim_time:sim_snapshot/1),
    ev3dev_native:sim_active_.

%!  tried_in_simulator(+Entry, +Situation0, +Situation1, -Situation,
%!                     +Context) is nondet.
%
%   Entry leads from Situation0 to Situation1. True if it is not an action of
%   the robot, or succeeds in the simulation; Situation has what it sensed
%   there. On backtracking the simulation goes back.

tried_in_simulator(A, _, S1, S, X) :-
    context_module(X, M),
    (   simulates,
        of_robot(A, M)
    ->  ev3dev_sim_time:sim_snapshot(Snapshot),
        (   true
        ;   ev3dev_sim_time:sim_restore(Snapshot),
            fail
        ),
        once(run_directly(A, M, Outcome, Value)),
        Outcome == done,
        sensing_entries(A, Value, M, Entries),
        entries_done(Entries, S1, S, X)
    ;   S = S1
    ).

of_robot(A, M) :-
    (   has_clauses(M, robot_action(_, _, _)),
        (   is_list(A)
        ->  member(Part, A)
        ;   Part = A
        ),
        \+ \+ M:robot_action(_, Part, _)
    ->  true
    ;   has_clauses(M, robot_action(_, _)),
        \+ \+ M:robot_action(A, _)
    ->  true
    ;   has_clauses(M, robot_sense(_, _, _)),
        \+ \+ M:robot_sense(A, _, _)
    ).
