:- module(ev3dev_golog_no_plan,
          [ no_plan/4                   % +Goal, -Why, +Situation, +Context
          ]).
:- use_module(library(assoc), [empty_assoc/1, get_assoc/3, put_assoc/4]).
:- use_module(library(lists), [append/3, member/2, reverse/2]).
:- use_module(context, [context_module/2, unblock/0, was_given_up/2]).
:- use_module(ground, [conjunction/3]).
:- use_module(planning_task, [ground_problem/7]).
:- use_module(programs, [in_books/2]).
:- use_module(theory, [is_kind/3, proc_body/3]).
:- use_module(transitions, [run/5]).
:- use_module(values, [fluents_now/3]).

/** <module> Why there is no plan

The planner says which conditions of the goal have no plan together. Then
actions are tried that make no condition false again: what even these do not
reach, no plan reaches.
*/

%!  no_plan(+Goal, -Why, +Situation, +Context) is semidet.
%
%   Why is no_plan(Conditions, Missing), or gave_up(Limit). Fails if there is
%   a plan. library(ev3dev/golog) explains it, why_not/2.

no_plan(Goal, Why, S, X) :-
    tried([Goal], S, X, Tried),
    (   Tried = gave_up(_)
    ->  Why = Tried
    ;   Tried == none,
        context_module(X, M),
        findall(P, condition_in(Goal, M, P), Ps),
        needed(Ps, [], Needed, S, X),
        missing(Needed, Missing, S, X, M),
        Why = no_plan(Needed, Missing)
    ).

tried(Ps, S, X, Tried) :-
    unblock,
    (   run(achieve(and(Ps), [ shortest(false),
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

needed([], Kept, Needed, _, _) :-
    reverse(Kept, Needed).
needed([P|Ps], Kept, Needed, S, X) :-
    append(Kept, Ps, Others),
    (   Others \== [],
        tried(Others, S, X, none)
    ->  needed(Ps, Kept, Needed, S, X)
    ;   needed(Ps, [P|Kept], Needed, S, X)
    ).

%   missing(+Conditions, -Missing, +Situation, +Context, +Module): Missing is
%   a list of missing(Fact, Action): no action makes Fact true, which Action
%   or the goal needs.

missing(Ps, Missing, S, X, M) :-
    fluents_now(S, X, Values),
    (   ground_problem(M, and(Ps), Values, none, Grounds0, Rules, Goal)
    ->  findall(ground(F, If, [effect(true, F, true)]),
                member(rule(F, If), Rules), Derived),
        append(Derived, Grounds0, Grounds),
        empty_assoc(None),
        findall(Known,
                ( member(F-V, Values),
                  ( V == true -> Fact = F ; Fact = (F = V) ),
                  ( Known = Fact ; Known = was(Fact) ) ),
                Knowns),
        all_put(Knowns, None, K0),
        reached(Grounds, K0, K),
        findall(L-goal, lacking(Goal, K, L), Todo),
        roots(Todo, [], Grounds, K, Missing0),
        sort(Missing0, Missing)
    ;   Missing = []
    ).

all_put([], K, K).
all_put([L|Ls], K0, K) :-
    put_assoc(L, K0, true, K1),
    all_put(Ls, K1, K).

reached(Grounds, K0, K) :-
    findall(L,
            ( member(ground(_, If, Effects), Grounds),
              possible(If, K0),
              member(Effect, Effects),
              makes(Effect, L, If1),
              \+ get_assoc(L, K0, _),
              possible(If1, K0) ),
            Ls),
    (   Ls == []
    ->  K = K0
    ;   all_put(Ls, K0, K1),
        reached(Grounds, K1, K)
    ).

makes(effect(Truth, Fact, If), L, If) :-
    ( Truth == true -> L = Fact ; L = [not, Fact] ).

possible(E, K) :-
    (   E = [and|Es]
    ->  \+ ( member(Part, Es), \+ possible(Part, K) )
    ;   E = [or|Es]
    ->  member(Part, Es),
        possible(Part, K)
    ;   E = [not, F],
        negation(F, N),
        N \== E
    ->  possible(N, K)
    ;   E = [not, F]
    ->  ( get_assoc(E, K, _) ; \+ get_assoc(was(F), K, _) )
    ;   E == true
    ->  true
    ;   get_assoc(E, K, _)
    ),
    !.

negation(E, N) :-
    (   E = [not, N]
    ->  true
    ;   E = [Word|Es]
    ->  ( Word == and -> Other = or ; Other = and ),
        N = [Other|Ns],
        findall([not, Part], member(Part, Es), Ns)
    ;   N = [not, E]
    ).

%   L is a part of the Expression that is not reached.

lacking(E, K, L) :-
    \+ possible(E, K),
    (   E = [Word|Es],
        Word \== not
    ->  member(Part, Es),
        lacking(Part, K, L)
    ;   E = [not, F],
        negation(F, N),
        N \== E
    ->  lacking(N, K, L)
    ;   E \== false,
        L = E
    ).

%   What no action makes true at all is to blame for the others.

roots([], _, _, _, []).
roots([L-By|Todo0], Seen, Grounds, K, Missing) :-
    (   memberchk(L, Seen)
    ->  Missing = Missing1,
        Todo = Todo0
    ;   findall(L1-A,
                ( member(ground(A, If, Effects), Grounds),
                  member(Effect, Effects),
                  makes(Effect, L, If1),
                  ( lacking(If, K, L1) ; lacking(If1, K, L1) ) ),
                Needs),
        (   Needs == []
        ->  ( L = [not, F] -> Fact = neg(F) ; Fact = L ),
            Missing = [missing(Fact, By)|Missing1]
        ;   Missing = Missing1
        ),
        append(Todo0, Needs, Todo)
    ),
    roots(Todo, [L|Seen], Grounds, K, Missing1).
