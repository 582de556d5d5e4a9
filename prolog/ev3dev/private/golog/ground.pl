:- module(ev3dev_golog_ground,
          [ only_relations/1,           % +Module
            ground_actions/2,           % +Module, -Actions
            ground_action/4,            % +Action, +Module, -Condition,
                                        % -Effects
            ground_condition/3          % +Condition, +Module, -Expression
          ]).
:- use_module(library(lists), [append/3, member/2]).
:- use_module(programs, [condition_construct/1, fresh/4]).
:- use_module(theory,
              [ domain_list/3, has_clauses/2, is_kind/3, is_sensing_action/2,
                names_fluent/2, proc_body/3
              ]).
:- use_module('../errors/errors', [throw_error/3]).

/** <module> A domain of Golog whose fluents are true or false, made ground

What does not depend on fluents is decided here: of a condition remains an
Expression of what has to be tested. It is `true`, `false`, a ground fluent,
`[and|Es]`, `[or|Es]` or `[not, E]`. Planners can do with it what they like.
*/

%!  only_relations(+Module) is det.
%
%   @error domain_error(pddl_fluent, Fluent) if it has other values than true
%          and false

only_relations(M) :-
    (   member(Head, [prim_fluent(F), fun_fluent(F)]),
        has_clauses(M, Head),
        M:Head
    ->  throw_error(domain_error(pddl_fluent, F), _,
                    'PDDL has true and false only: rel_fluent/1')
    ;   true
    ).

%!  ground_actions(+Module, -Actions) is det.
%
%   Actions are those that sense nothing, sorted.

ground_actions(M, As) :-
    findall(A, ( M:prim_action(A), ground(A), \+ is_sensing_action(A, M) ),
            As0),
    sort(As0, As).

%!  ground_action(+Action, +Module, -Condition, -Effects) is semidet.
%
%   Effects is a list of effect(Truth, Fluent, Condition). Fails if Action is
%   never possible.
%
%   @error domain_error(pddl_condition, Condition) if it is not only about
%          fluents and goals of Prolog, or mixes them

ground_action(A, M, Condition, Effects) :-
    findall(E, ( M:poss(A, P), residual(P, M, E) ), Es),
    any_of(Es, Condition),
    Condition \== false,
    findall(Effect, effect(A, M, Effect), Effects).

effect(A, M, effect(Truth, F, E)) :-
    (   M:causes_false(A, F, P),
        Truth = false
    ;   M:causes_true(A, F, P),
        Truth = true
    ),
    ( ground(F) -> true ; M:rel_fluent(F), must_be_ground(F) ),
    residual(P, M, E).

%!  ground_condition(+Condition, +Module, -Expression) is det.
%
%   @error domain_error(pddl_condition, Condition), as above

ground_condition(P, M, E) :-
    findall(R, residual(P, M, R), Rs),
    any_of(Rs, E).

%   residual(+Condition, +Module, -Expression) is nondet: Condition holds if
%   one of Expression does. Goals that are about no fluent bind variables.

residual(P, M, E) :-
    (   conjunction(P, Q, R)
    ->  residual(Q, M, E1),
        residual(R, M, E2),
        both(E1, E2, E)
    ;   disjunction(P, Ps)
    ->  member(Q, Ps),
        residual(Q, M, E)
    ;   ( P = neg(Q) ; P = not(Q) ; P = (\+ Q) )
    ->  ground_condition(Q, M, E1),
        opposite(E1, E),
        E \== false
    ;   P = some(Vs, D, Q)
    ->  residual(some((Vs, D), Q), M, E)
    ;   P = some(Vs, Q0)
    ->  fresh(Vs, Q0, Q, Choices),
        chosen(Choices, M),
        residual(Q, M, E)
    ;   P = all(Vs, D, Q)
    ->  residual(neg(some(Vs, D, neg(Q))), M, E)
    ;   P = all(Vs, Q)
    ->  residual(neg(some(Vs, neg(Q))), M, E)
    ;   is_kind(fluent, P, M),
        P =.. [_|Arguments],
        \+ names_fluent(Arguments, M),
        \+ \+ M:rel_fluent(P)
    ->  M:rel_fluent(P),
        must_be_ground(P),
        E = P
    ;   is_kind(proc, P, M)
    ->  proc_body(P, Q, M),
        residual(Q, M, E)
    ;   P \== true,
        P \== false,
        ( condition_construct(P) ; names_fluent(P, M) )
    ->  undecided(P)
    ;   call(M:P),
        E = true
    ).

must_be_ground(F) :-
    (   ground(F)
    ->  true
    ;   undecided(F)
    ).

undecided(P) :-
    throw_error(domain_error(pddl_condition, P), _,
                'PDDL cannot say that').

conjunction(and(P, Q), P, Q).
conjunction((P, Q), P, Q).
conjunction(and([]), true, true).
conjunction(and([P|Ps]), P, and(Ps)).
conjunction(equiv(P, Q), impl(P, Q), impl(Q, P)).

disjunction(or(P, Q), [P, Q]).
disjunction((P ; Q), [P, Q]) :-
    P \= (_ -> _).
disjunction(or(Ps), Ps).
disjunction(impl(P, Q), [neg(P), Q]).

chosen([], _).
chosen([V-D|Choices], M) :-
    (   D = in(Sort)
    ->  domain_list(Sort, M, Values),
        member(V, Values)
    ;   true
    ),
    chosen(Choices, M).

both(P, Q, R) :-
    (   P == true
    ->  R = Q
    ;   Q == true
    ->  R = P
    ;   parts_of(and, P, Ps),
        parts_of(and, Q, Qs),
        append(Ps, Qs, Rs),
        R = [and|Rs]
    ).

any_of(Rs0, E) :-
    sort(Rs0, Rs),
    (   memberchk(true, Rs)
    ->  E = true
    ;   Rs == []
    ->  E = false
    ;   Rs = [E]
    ->  true
    ;   E = [or|Rs]
    ).

parts_of(Word, P, Parts) :-
    (   P = [Word|Parts0]
    ->  Parts = Parts0
    ;   Parts = [P]
    ).

opposite(E0, E) :-
    (   E0 == true
    ->  E = false
    ;   E0 == false
    ->  E = true
    ;   E = [not, E0]
    ).
