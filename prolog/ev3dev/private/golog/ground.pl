:- module(ev3dev_golog_ground,
          [ only_relations/1,           % +Module
            ground_actions/2,           % +Module, -Actions
            ground_action/4,            % +Action, +Module, -Condition,
                                        % -Effects
            ground_rules/2,             % +Module, -Rules
            ground_condition/3,         % +Condition, +Module, -Expression
            with_values_of/2,           % +Pairs, :Goal
            value_added/3,              % +Fluent, +Value, +Module
            possible_value/2,           % ?Fluent, ?Value
            asked_for/2,                % :Goal, -Functors
            is_relation/2,              % +Fluent, +Module
            exclude/2,                  % +Expression1, +Expression2
            conjunction/3               % +Condition, -Part1, -Part2
          ]).
:- use_module(library(lists), [append/3, member/2]).
:- use_module(effects, [equations_for/4]).
:- use_module(programs, [condition_construct/1, fresh/4]).
:- use_module(theory,
              [ derived_rule/4, domain_list/3, has_clauses/2, is_fluent/2,
                is_kind/3, is_sensing_action/2, located/3, names_fluent/2,
                proc_body/3
              ]).
:- use_module('../errors/errors', [throw_error/3]).

/** <module> A domain of Golog, made ground

What does not depend on fluents is decided here. The rest of a condition is an
Expression that has to be tested. It is `true`, `false`, a ground fluent that
is true, `Fluent = Value` for one with other values, `[and|Es]`, `[or|Es]` or
`[not, E]`. Planners can do with it what they like.

A condition may compute with the value of a fluent. It is decided for each
value that the fluent may come to have, so these must be known:
with_values_of/2, value_added/3.
*/

:- meta_predicate with_values_of(+, 0), asked_for(0, -).

:- thread_local
    possible_/3,                        % Hash, Fluent, Value
    asked_/1.                           % Name/Arity

%!  with_values_of(+Pairs, :Goal) is semidet.
%
%   Run Goal once. While it runs, fluents have the values of Pairs, a list of
%   Fluent-Value, and those that value_added/3 adds.

with_values_of(Pairs, Goal) :-
    setup_call_cleanup(
        forall(member(F-V, Pairs), add_value(F, V)),
        once(Goal),
        retractall(possible_(_, _, _))).

add_value(F, V) :-
    term_hash(F, Hash),
    assertz(possible_(Hash, F, V)).

%!  value_added(+Fluent, +Value, +Module) is semidet.
%
%   Fluent, which is no relation, may come to have Value. Fails if that was
%   known.

value_added(F, V, M) :-
    \+ is_relation(F, M),
    \+ ( possible_value(F, V0), V0 == V ),
    add_value(F, V).

%!  possible_value(?Fluent, ?Value) is nondet.

possible_value(F, V) :-
    term_hash(F, Hash),                 % a variable if F has one
    possible_(Hash, F, V).

%!  asked_for(:Goal, -Functors) is semidet.
%
%   Run Goal once. Functors are a list of Name/Arity of the fluents whose
%   values it asked for.

asked_for(Goal, Functors) :-
    retractall(asked_(_)),
    once(Goal),
    findall(Functor, asked_(Functor), Functors).

asked_value(F, V) :-
    functor(F, Name, Arity),
    ( asked_(Name/Arity) -> true ; assertz(asked_(Name/Arity)) ),
    possible_value(F, V).

%!  only_relations(+Module) is det.
%
%   @error domain_error(pddl_fluent, Fluent) if it has other values than true
%          and false

only_relations(M) :-
    (   member(Head, [prim_fluent(F), fun_fluent(F)]),
        has_clauses(M, Head),
        M:Head
    ->  located(M, fluent(F), Where),
        format(atom(Text), '~wPDDL has true and false only: rel_fluent/1',
               [Where]),
        throw_error(domain_error(pddl_fluent, F), _, Text)
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
%   Effects is a list of effect(Value, Fluent, Condition). Fails if Action is
%   never possible.
%
%   @error domain_error(pddl_condition, Condition) if it is not only about
%          fluents and goals of Prolog, or mixes them

ground_action(A, M, Condition, Effects) :-
    findall(E, ( M:poss(A, P), residual(P, M, E) ), Es),
    any_of(Es, Condition),
    Condition \== false,
    findall(effect(V, F, P),
            ( effect(A, M, F, V, P), \+ exclude(Condition, P) ),
            Effects).

effect(A, M, F, V, E) :-
    (   M:causes_false(A, F, P),
        V = false
    ;   M:causes_true(A, F, P),
        V = true
    ;   M:causes_val(A, F, V, P)
    ),
    (   ground(F)
    ->  residual(P, M, E)
    ;   equations_for(F, P, Equations, Rest),
        residual(and(Equations), M, E1),
        ( ground(F) -> true ; is_fluent(F, M) ),
        residual(and(Rest), M, E2),
        both(E1, E2, E)
    ),
    must_be_ground(F-V, M).

%!  exclude(+Expression1, +Expression2) is semidet.
%
%   True if it is easily seen that both cannot hold, as they ask for two
%   values of a fluent.

exclude(E1, E2) :-
    (   E1 = [or|Es]
    ->  \+ ( member(E, Es), \+ exclude(E, E2) )
    ;   E2 = [or|Es]
    ->  \+ ( member(E, Es), \+ exclude(E1, E) )
    ;   \+ both(E1, E2, _)
    ).

%!  ground_rules(+Module, -Rules) is det.
%
%   Rules is a list of rule(Fluent, Condition) for the derived fluents.

ground_rules(M, Rules) :-
    findall(rule(F, E),
            ( derived_rule(_, F, P, M),
              must_be_ground(F, M),
              ground_condition(P, M, E),
              E \== false ),
            Rules).

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
    ;   is_kind(derived, P, M)
    ->  arguments_with_values(P, P, Q, E1, M),
        must_be_ground(Q, M),
        both(E1, Q, E)
    ;   is_kind(proc, P, M)
    ->  proc_body(P, Q, M),
        residual(Q, M, E)
    ;   P \== true,
        P \== false,
        ( condition_construct(P) ; P = _:_, names_fluent(P, M) )
    ->  undecided(P, M)
    ;   arguments_with_values(P, P, Q, E1, M),
        holds_with(Q, E2, M),
        both(E1, E2, E)
    ).

holds_with(P, E, M) :-
    (   \+ is_kind(fluent, P, M)
    ->  call(M:P),
        E = true
    ;   is_relation(P, M)
    ->  M:rel_fluent(P),
        must_be_ground(P, M),
        E = P
    ;   asked_value(P, true),
        E = (P = true)
    ).

%!  is_relation(+Fluent, +Module) is semidet.

is_relation(F, M) :-
    \+ \+ M:rel_fluent(F).

%   arguments_with_values(+Term0, +Condition, -Term, -Expression, +Module) is
%   nondet.
%
%   Term is Term0, a part of Condition, with the fluents in its arguments
%   replaced by values, if Expression holds.

arguments_with_values(T0, P, T, E, M) :-
    (   compound(T0)
    ->  compound_name_arguments(T0, Name, Arguments0),
        all_with_values(Arguments0, P, Arguments, E, M),
        compound_name_arguments(T, Name, Arguments)
    ;   T = T0,
        E = true
    ).

all_with_values([], _, [], true, _).
all_with_values([T0|Ts0], P, [T|Ts], E, M) :-
    with_value(T0, P, T, E1, M),
    all_with_values(Ts0, P, Ts, E2, M),
    both(E1, E2, E).

with_value(T0, P, T, E, M) :-
    (   \+ names_fluent(T0, M)
    ->  T = T0,
        E = true
    ;   arguments_with_values(T0, P, T1, E1, M),
        (   \+ is_kind(fluent, T1, M)
        ->  T = T1,
            E = E1
        ;   is_relation(T1, M)
        ->  undecided(P, M)
        ;   \+ asked_value(T1, _),
            \+ is_fluent(T1, M)
        ->  T = T1,
            E = E1
        ;   asked_value(T1, T),
            both(E1, T1 = T, E)
        )
    ).

must_be_ground(F, M) :-
    (   ground(F)
    ->  true
    ;   undecided(F, M)
    ).

undecided(P, M) :-
    located(M, in_program([P]), Where),
    format(atom(Text), '~wPDDL cannot say that', [Where]),
    throw_error(domain_error(pddl_condition, P), _, Text).

%!  conjunction(+Condition, -Part1, -Part2) is semidet.

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

%   both(+Expression1, +Expression2, -Expression) is semidet: fails if they
%   ask for two values of a fluent.

both(P, Q, R) :-
    (   P == true
    ->  R = Q
    ;   Q == true
    ->  R = P
    ;   parts_of(and, P, Ps),
        parts_of(and, Q, Qs),
        \+ ( member(F = V1, Ps), member(F = V2, Qs), V1 \== V2 ),
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
