:- module(ev3dev_golog_steps,
          [ agent_of/3,                 % +Action, -Agent, +Module
            needed/3,                   % +Action, -Other, +Module
            refused/3,                  % +Step, +Module, -Why
            step_after/5,               % +Step, +Situation0, -Situation,
                                        % -Why, +Context
            always/3,                   % -Condition, -Place, +Module
            sorted_steps/2              % +History0, -History
          ]).
:- use_module(library(lists), [append/3, member/2]).
:- use_module(conditions, [holds/3]).
:- use_module(context, [context_module/2]).
:- use_module(effects, [effect/4]).
:- use_module(progression, [done/4]).
:- use_module(theory, [is_sensing_action/2]).
:- use_module('../errors/error_texts', [clause_place/2]).

/** <module> Steps of several actions at the same time

A step is a sorted list of actions of different agents. It is an entry of the
history. The conditions of its actions are those before it, and its effects
are all of theirs.

Sources: Reiter: Natural Actions, Concurrency and Continuous Time in the
Situation Calculus (1996). Boutilier, Brafman: Partial-Order Planning with
Concurrent Interacting Actions (2001), for actions that need or exclude others
in the same step.
*/

%!  agent_of(+Action, -Agent, +Module) is semidet.
%
%   Agent does Action, which is ground: the one that agent_of/2 says, else the
%   first argument, if that is an agent.

agent_of(A, Agent, M) :-
    (   M:agent_of(A, Agent0)
    ->  Agent = Agent0
    ;   compound(A),
        arg(1, A, Agent0),
        \+ \+ M:agent(Agent0),
        Agent = Agent0
    ).

%!  needed(+Action, -Other, +Module) is nondet.
%
%   A step with Action has another action that unifies with Other.

needed(A, Other, M) :-
    M:together(A, Other).

%!  excluded(+Action1, +Action2, +Module) is semidet.

excluded(A, B, M) :-
    (   M:excludes(A, B)
    ;   M:excludes(B, A)
    ),
    !.

%!  always(-Condition, -Place, +Module) is nondet.
%
%   Condition holds after each step. Place is File:Line of its clause, or
%   `none`.

always(Condition, Place, M) :-
    clause(M:always(Condition), Body, Ref),
    call(M:Body),
    clause_place(Ref, Place).

%!  refused(+Step, +Module, -Why) is semidet.
%
%   The actions of Step do not belong together, whatever the situation. Why is
%
%     - agent_of(Action)
%       Action belongs to no agent, so it is a step by itself.
%     - senses(Action)
%       Action senses, so it is a step by itself.
%     - one_at_a_time(Agent, Action1, Action2)
%     - together(Action, Other)
%     - excludes(Action1, Action2)

refused(Step, M, Why) :-
    refused_(Step, M, Why0),
    !,
    Why = Why0.

refused_([A, B|As], M, Why) :-
    Step = [A, B|As],
    (   member(Action, Step),
        (   \+ agent_of(Action, _, M)
        ->  Why = agent_of(Action)
        ;   is_sensing_action(Action, M)
        ->  Why = senses(Action)
        )
    ;   pair(Step, One, Other),
        (   agent_of(One, Agent, M),
            agent_of(Other, Agent, M)
        ->  Why = one_at_a_time(Agent, One, Other)
        ;   excluded(One, Other, M)
        ->  Why = excludes(One, Other)
        )
    ).
refused_(Step, M, together(A, Other)) :-
    member(A, Step),
    needed(A, Other, M),
    \+ ( member(B, Step),
         B \== A,
         \+ B \= Other ).

pair(Step, One, Other) :-
    append(_, [One|Rest], Step),
    member(Other, Rest).

%!  step_after(+Step, +Situation0, -Situation, -Why, +Context) is det.
%
%   Situation is that after Step, whose actions are possible, if they fit
%   together. Else it is unbound, and Why is as in refused/3, or
%
%     - one_value(Fluent, Action1, Action2)
%       They would give Fluent two values.
%     - always(Condition)
%       Condition would not hold then.
%
%   Step may also be a single action.

step_after(Entry, S0, S, Why, X) :-
    context_module(X, M),
    (   is_list(Entry)
    ->  Step = Entry
    ;   Step = [Entry]
    ),
    (   refused(Step, M, Why0)
    ->  Why = Why0
    ;   two_values(Step, S0, X, Why0)
    ->  Why = Why0
    ;   done(Entry, S0, S1, X),
        (   always(Condition, _, M),
            \+ holds(Condition, S1, X)
        ->  Why = always(Condition)
        ;   S = S1
        )
    ).

two_values([A, B|As], S, X, one_value(F, One, Other)) :-
    findall(Action-Effects,
            ( member(Action, [A, B|As]),
              findall(F-V, effect(Action, S, X, set(F, V)), Effects) ),
            All),
    pair(All, One-Effects1, Other-Effects2),
    member(F-V1, Effects1),
    member(F0-V2, Effects2),
    F0 == F,
    V1 \== V2.

%!  sorted_steps(+History0, -History) is det.
%
%   History is History0 with the actions of each step in their order.

sorted_steps([], []).
sorted_steps([Entry0|Entries0], [Entry|Entries]) :-
    (   sorted_step(Entry0, Entry1)
    ->  Entry = Entry1
    ;   Entry = Entry0
    ),
    sorted_steps(Entries0, Entries).

sorted_step(Entry0, Entry) :-
    ground(Entry0),
    (   is_list(Entry0)
    ->  sort(Entry0, Entry)
    ;   ( Entry0 = failed(Step0), Entry = failed(Step)
        ; Entry0 = interrupted(Step0), Entry = interrupted(Step) ),
        is_list(Step0)
    ->  sort(Step0, Step)
    ).
