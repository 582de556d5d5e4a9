:- module(ev3dev_golog_effort,
          [ effort/4,                   % +Limits, +Options, +Outer, -Effort
            watched_effort/3,           % :Watch, +Record, -Effort
            counted/2,                  % +Depth, +Effort
            counted_natively/3,         % +Steps, +Inferences, +Effort
            polled/1,                   % +Effort
            in_trial/1,                 % +Effort
            effort_id/2,                % +Effort, -Id
            asked_history/1,            % +Effort
            asks_history/1,             % +Effort
            how_far/2                   % +Effort, -Far
          ]).
:- use_module('../basics/fields',
              [fields/1, goal_expansion/2, term_expansion/2]).

:- fields(effort(id, steps, deepest, limits, cpu, inferences, trial,
                 watch, outer, asked)).
:- fields(watch(closure, record, next)).

/** <module> The effort and the limits of a search

An effort counts the steps of a search, and knows its limits:

    effort(Id, Steps, Deepest, Limits, Cpu0, Inferences0, Trial, Watch,
           Outer, Asked)

A limit is steps(N), inferences(N) or seconds(S). Seconds are those in which
the thread computes, so another program cannot use them up. At a limit
'$golog_gave_up'(Id, Limit) is thrown. A search within another one counts
for both. Watch is watch(Closure, Record, Next): of an online run, what else
may end it. From the time Next on call(Closure, Record, Effort) is called;
then again after 15 ms. Trial is true if the search tries actions in the
simulator, Asked if a condition has asked what was done before. An effort is
changed in place, also when a search goes back.
*/

:- meta_predicate watched_effort(2, +, -).

%!  effort(+Limits, +Options, +Outer, -Effort) is det.
%
%   Effort is that of a search which begins within Outer. Options are the
%   words of its context.

effort(Limits, Options, Outer, Effort) :-
    Effort = effort(Id, 0, 0, Limits, Cpu, Inferences, Trial, Watch, Outer,
                    false),
    flag(ev3dev_golog_effort, Id, Id+1),
    statistics(cputime, Cpu),
    statistics(inferences, Inferences),
    (   Outer == none
    ->  Watch = none,
        Trial0 = false
    ;   Outer = effort(watch: Watch, trial: Trial0)
    ),
    (   memberchk(simulate, Options)
    ->  Trial = true
    ;   Trial = Trial0
    ).

%!  watched_effort(:Watch, +Record, -Effort) is det.
%
%   Effort is that of a step of an online run.

watched_effort(Watch, Record, Effort) :-
    get_time(Now),
    next_look(Now, Next),
    statistics(cputime, Cpu),
    Effort = effort(none, 0, 0, [], Cpu, 0, false,
                    watch(Watch, Record, Next), none, false).

next_look(Now, Next) :-
    Next is Now+0.015.

%!  counted(+Depth, +Effort) is det.
%
%   A search looks for a step at Depth.

counted(Depth, Effort) :-
    one_more(Depth, Effort),
    polled(Effort).

one_more(Depth, Effort) :-
    (   Effort == none
    ->  true
    ;   Effort = effort(steps: Steps0),
        Steps is Steps0+1,
        set_field(Effort, effort(steps: Steps)),
        Effort = effort(deepest: Deepest),
        (   Depth > Deepest
        ->  set_field(Effort, effort(deepest: Depth))
        ;   true
        ),
        Effort = effort(outer: Outer),
        one_more(0, Outer)
    ).

%!  counted_natively(+Steps, +Inferences, +Effort) is det.
%
%   Native code has taken Steps more. It has computed for as long as Prolog
%   takes for Inferences.

counted_natively(Steps, Inferences, Effort) :-
    (   Effort == none
    ->  true
    ;   Effort = effort(steps: Steps0, inferences: Start0, outer: Outer),
        Steps1 is Steps0+Steps,
        Start is Start0-Inferences,
        set_field(Effort, effort(steps: Steps1)),
        set_field(Effort, effort(inferences: Start)),
        counted_natively(Steps, Inferences, Outer)
    ).

%!  polled(+Effort) is det.
%
%   The same step goes on: is a limit reached, and is it time to look?

polled(Effort) :-
    (   Effort == none
    ->  true
    ;   all_within(Effort),
        Effort = effort(watch: Watch),
        (   Watch == none
        ->  true
        ;   looked(Watch, Effort)
        )
    ).

all_within(Effort) :-
    (   Effort == none
    ->  true
    ;   Effort = effort(limits: Limits),
        within(Limits, Effort),
        Effort = effort(outer: Outer),
        all_within(Outer)
    ).

within([], _).
within([Limit|Limits], Effort) :-
    (   is_reached(Limit, Effort)
    ->  effort_id(Effort, Id),
        throw('$golog_gave_up'(Id, Limit))
    ;   within(Limits, Effort)
    ).

is_reached(steps(Most), Effort) :-
    Effort = effort(steps: Steps),
    Steps > Most,
    set_field(Effort, effort(steps: Most)).  % The next one is not tried.
is_reached(inferences(Most), Effort) :-
    spent(Effort, Inferences, _),
    Inferences > Most.
is_reached(seconds(Most), Effort) :-
    spent(Effort, _, Seconds),
    Seconds >= Most.

spent(Effort, Inferences, Seconds) :-
    Effort = effort(cpu: Cpu0, inferences: Inferences0),
    statistics(inferences, Inferences1),
    Inferences is Inferences1-Inferences0,
    statistics(cputime, Cpu),
    Seconds is Cpu-Cpu0.

looked(Watch, Effort) :-
    Watch = watch(Closure, Record, Next0),
    get_time(Now),
    (   Now < Next0
    ->  true
    ;   call(Closure, Record, Effort),
        get_time(Later),
        next_look(Later, Next),
        set_field(Watch, watch(next: Next))
    ).

%!  in_trial(+Effort) is semidet.
%
%   True if the robot of the simulator may stand where a plan has led it.

in_trial(Effort) :-
    Effort = effort(trial: true).

%!  asks_history(+Effort) is det.
%!  asked_history(+Effort) is semidet.
%
%   A condition asks what was done before, in this search or around it.

asks_history(Effort) :-
    (   Effort == none
    ->  true
    ;   set_field(Effort, effort(asked: true)),
        Effort = effort(outer: Outer),
        asks_history(Outer)
    ).

asked_history(Effort) :-
    Effort = effort(asked: true).

%!  effort_id(+Effort, -Id) is det.

effort_id(Effort, Id) :-
    Effort = effort(id: Id).

%!  how_far(+Effort, -Far) is det.
%
%   Far is [steps(N), depth(D), inferences(I), seconds(S)]: what a search has
%   cost so far, and the most steps that it was from its beginning.

how_far(Effort, [ steps(Steps), depth(Deepest), inferences(Inferences),
                  seconds(Seconds) ]) :-
    Effort = effort(steps: Steps, deepest: Deepest),
    spent(Effort, Inferences, Seconds).
