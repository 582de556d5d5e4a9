:- module(ev3dev_golog_no_plan,
          [ no_plan/5                   % +Goal, +Options, -Why, +Situation,
                                        % +Context
          ]).
:- use_module(library(assoc), [empty_assoc/1, get_assoc/3, put_assoc/4]).
:- use_module(library(lists), [append/3, member/2, reverse/2]).
:- use_module(context, [context_module/2, unblock/0, was_given_up/2]).
:- use_module(ground, [conjunction/3]).
:- use_module(planning_task, [ground_problem/5]).
:- use_module(programs, [in_books/2]).
:- use_module(theory, [is_kind/3, proc_body/3]).
:- use_module(transitions, [run/5]).
:- use_module(values, [fluents_now/3]).

/** <module> Why there is no plan

The planner says which conditions of the goal have no plan together. Then
actions are tried that make nothing false, and each negation holds: what even
these do not reach, no plan reaches.
*/

%!  no_plan(+Goal, +Options, -Why, +Situation, +Context) is semidet.
%
%   Options are those of achieve/2; only concurrent/1 counts here. Why is
%   no_plan(Conditions, Missing), or gave_up(Limit). Fails if there is a plan.
%   library(ev3dev/golog) explains it, why_not/2.

no_plan(Goal, Options, Why, S, X) :-
    (   memberchk(concurrent(Agents), Options)
    ->  true
    ;   Agents = false
    ),
    tried([Goal], Agents, S, X, Tried),
    (   Tried = gave_up(_)
    ->  Why = Tried
    ;   Tried == none,
        context_module(X, M),
        findall(P, condition_in(Goal, M, P), Ps),
        needed(Ps, [], Agents, Needed, S, X),
        missing(Needed, Missing, S, X, M),
        Why = no_plan(Needed, Missing)
    ).

tried(Ps, Agents, S, X, Tried) :-
    unblock,
    (   run(achieve(and(Ps), [ shortest(false), concurrent(Agents),
                               gives_up(inferences(5000000)) ]),
            S, _, any, X)
    ->  Tried = plan
    ;   was_given_up(Limit, _)
    ->  Tried = gave_up(Limit)
    ;   Tried = none
    ).

condition_in(P, M, C) :-
    (   ( conjunction(P, Q, R) ; in_books(P, and(Q, R)) )
    ->  ( condition_in(Q, M, C) ; condition_in(R, M, C) )
    ;   is_kind(proc, P, M),
        findall(Body, proc_body(P, Body, M), [Body])
    ->  condition_in(Body, M, C)
    ;   P \== true,
        C = P
    ).

%   Each condition that is left out has no part in it.

needed([], Kept, _, Needed, _, _) :-
    reverse(Kept, Needed).
needed([P|Ps], Kept, Agents, Needed, S, X) :-
    append(Kept, Ps, Others),
    (   Others \== [],
        tried(Others, Agents, S, X, none)
    ->  needed(Ps, Kept, Agents, Needed, S, X)
    ;   needed(Ps, [P|Kept], Agents, Needed, S, X)
    ).

%   missing(+Conditions, -Missing, +Situation, +Context, +Module): Missing is
%   a list of missing(Fact, Action): no action makes Fact true, which Action
%   or the goal needs.

missing(Ps, Missing, S, X, M) :-
    fluents_now(S, X, Values),
    (   ground_problem(M, and(Ps), Values, none,
                       problem(Facts, Grounds0, Rules, Goal, _))
    ->  findall(ground(F, If, [effect(true, F, true)]),
                member(rule(F, If), Rules), Derived),
        append(Derived, Grounds0, Grounds),
        empty_assoc(None),
        reached([true|Facts], Grounds, None, K),
        findall(Fact-goal, lacking(Goal, K, Fact), Todo),
        roots(Todo, [], Grounds, K, Missing0),
        sort(Missing0, Missing)
    ;   Missing = []
    ).

reached([], _, K, K).
reached([Fact0|Facts0], Grounds, K0, K) :-
    all_put([Fact0|Facts0], K0, K1),
    findall(Fact,
            ( member(ground(_, If, Effects), Grounds),
              possible(If, K1),
              member(effect(true, Fact, If1), Effects),
              \+ get_assoc(Fact, K1, _),
              possible(If1, K1) ),
            Facts),
    reached(Facts, Grounds, K1, K).

all_put([], K, K).
all_put([Fact|Facts], K0, K) :-
    put_assoc(Fact, K0, true, K1),
    all_put(Facts, K1, K).

possible(E, K) :-
    (   E = [Word|Es]
    ->  (   Word == and
        ->  \+ ( member(Part, Es), \+ possible(Part, K) )
        ;   Word == not
        ->  true
        ;   member(Part, Es),
            possible(Part, K)
        ->  true
        )
    ;   get_assoc(E, K, _)
    ).

%   lacking(+Expression, +Known, -Fact) is nondet: Fact is not reached.

lacking(E, K, Fact) :-
    \+ possible(E, K),
    (   E = [_|Es]
    ->  member(Part, Es),
        lacking(Part, K, Fact)
    ;   E \== false,
        Fact = E
    ).

%   What no action makes true at all is to blame for the others.

roots([], _, _, _, []).
roots([Fact-By|Todo0], Seen, Grounds, K, Missing) :-
    findall(Need-A,
            ( member(ground(A, If, Effects), Grounds),
              member(effect(true, Fact, If1), Effects),
              ( lacking(If, K, Need) ; lacking(If1, K, Need) ) ),
            Needs),
    (   memberchk(Fact, Seen)
    ->  Todo = Todo0,
        Missing = Missing1
    ;   append(Todo0, Needs, Todo),
        (   Needs == []
        ->  Missing = [missing(Fact, By)|Missing1]
        ;   Missing = Missing1
        )
    ),
    roots(Todo, [Fact|Seen], Grounds, K, Missing1).
