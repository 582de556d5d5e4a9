:- module(ev3dev_limits,
          [ within_seconds/2,           % +Seconds, :Goal
            clock_changes/1,            % :Goal
            forget_plans/0
          ]).
:- use_module(errors, [goal_of_program/1]).
:- use_module(plans,
              [clock/1, plan/3, plan/4, planned/4, unplan/1]).
:- use_module(one_of, [one_of/2]).

:- meta_predicate
    within_seconds(+, 0),
    clock_changes(0).

/** <module> How long a goal may take

The end of for_seconds/2 is a plan, which is made again whenever another clock
is in use. So it counts on also in a simulation that Goal starts itself.
*/

:- dynamic held/3.                      % Id, Thread, Seconds that are left

%!  within_seconds(+Seconds, :Goal) is semidet.
%
%   Call Goal once, and leave it when Seconds of simulated time have passed.

within_seconds(Seconds, Goal) :-
    clock(Now),
    End is Now + Seconds,
    catch(setup_call_cleanup(
              plan(End, ev3dev_limits:time_is_up(Id), Id),
              once(goal_of_program(Goal)),
              end_limit(Id)),
          ev3dev_time_is_up(Id),
          true).

end_limit(Id) :-
    unplan(Id),
    retractall(held(Id, _, _)).

time_is_up(Id) :-
    throw(ev3dev_time_is_up(Id)).

%!  clock_changes(:Goal) is semidet.
%
%   Call Goal once, which starts a simulation, ends it, or goes back in time.
%   What time is left to within_seconds/2 is left after it, too, in whatever
%   simulation that is, and stands still while there is none.

clock_changes(Goal) :-
    findall(held(Id, Thread, Left), time_left(Id, Thread, Left), Limits),
    once(Goal),
    forall(( one_of(Limits, held(Id, Thread, Left)),
             is_limit(Id)
           ),
           count_on(Id, Thread, Left)).

time_left(Id, Thread, Left) :-
    clock(Now),
    planned(End, Id, Thread, ev3dev_limits:time_is_up(Id)),
    Left is max(0, End - Now).
time_left(Id, Thread, Left) :-
    held(Id, Thread, Left).

%   Its goal may have ended meanwhile.
is_limit(Id) :-
    (   planned(_, Id, _, _)
    ->  true
    ;   held(Id, _, _)
    ->  true
    ).

count_on(Id, Thread, Left) :-
    end_limit(Id),
    (   clock(Now)
    ->  End is Now + Left,
        plan(End, ev3dev_limits:time_is_up(Id), Id, Thread)
    ;   assertz(held(Id, Thread, Left))
    ).

%!  forget_plans is det.
%
%   Forget what sim_at/2 has planned: the simulation ends.

forget_plans :-
    forall(( planned(_, Id, _, Goal),
             Goal \= ev3dev_limits:time_is_up(_)
           ),
           unplan(Id)).
