:- module(ev3dev_golog_step_checks, []).
:- use_module(library(lists), [member/2]).
:- use_module(steps, [agent_of/3]).
:- use_module(theory,
              [has_agents/1, has_possible_values/1, is_kind/3]).
:- use_module('../errors/error_texts', [clause_place/2, place_first/2]).
:- use_module('../errors/errors', [throw_error/3]).

/** <module> What a domain says about steps must be possible

A wrong clause of agent/1, agent_of/2, together/2, excludes/2, always/1,
derived/2 or robot_action/3 is an error before the first step, with its place.
*/

:- multifile ev3dev_golog_theory:checked/1.

ev3dev_golog_theory:checked(M) :-
    declaration(Head),
    clause(M:Head, Body, Ref),
    wrong(Head, Body, M, Formal, What),
    clause_place(Ref, Place),
    place_first(Place, Where),
    functor(Head, Name, Arity),
    format(atom(Text), '~w~w/~w: ~w', [Where, Name, Arity, What]),
    throw_error(Formal, _, Text).

declaration(agent(_)).
declaration(agent_of(_, _)).
declaration(together(_, _)).
declaration(excludes(_, _)).
declaration(always(_)).
declaration(derived(_, _)).
declaration(robot_action(_, _, _)).

%   wrong(+Head, +Body, +Module, -Formal, -Text) is nondet.

wrong(agent(R), Body, M, Formal, Text) :-
    call(M:Body),
    \+ atom(R),
    Text = 'an agent is an atom, the name of its brick',
    ( var(R) -> Formal = instantiation_error ; Formal = type_error(atom, R) ).
wrong(Head, _, M, existence_error(golog_agent, M), Text) :-
    memberchk(Head, [ agent_of(_, _), together(_, _), excludes(_, _),
                      robot_action(_, _, _) ]),
    \+ has_agents(M),
    Text = 'the domain has no agents: agent(Name) declares one'.
wrong(Head, _, M, Formal, Text) :-
    (   Head = agent_of(A, R)
    ;   Head = robot_action(R, A, _)
    ),
    (   wrong_action(A, M, Formal, Text)
    ;   nonvar(R),
        \+ M:agent(R),
        Formal = existence_error(golog_agent, R),
        format(atom(Text), 'there is no agent ~q; agent/1 declares one', [R])
    ).
wrong(Head, Body, M, Formal, Text) :-
    (   Head = together(A, B)
    ;   Head = excludes(A, B)
    ),
    (   wrong_action(A, M, Formal, Text)
    ;   wrong_action(B, M, Formal, Text)
    ;   Body == true,
        ground(A-B),
        agent_of(A, R, M),
        agent_of(B, R, M),
        Formal = domain_error(golog_step, [A, B]),
        format(atom(Text), 'both are actions of ~q, and an agent does one \c
                            action in a step', [R])
    ).
wrong(always(P), Body, M, Formal, Text) :-
    (   wrong_condition(P, Body, Formal, Text)
    ;   callable(P),
        \+ asks_for(P, M),
        Formal = domain_error(golog_condition, P),
        Text = 'the condition names no fluent, so no step changes it'
    ).
wrong(derived(F, P), Body, M, Formal, Text) :-
    (   \+ callable(F),
        Text = 'the first argument is a fluent, the second a condition',
        (   var(F)
        ->  Formal = instantiation_error
        ;   Formal = type_error(callable, F)
        )
    ;   wrong_condition(P, Body, Formal, Text)
    ;   callable(F),
        functor(F, Name, Arity),
        functor(General, Name, Arity),
        Formal = domain_error(golog_derived, Name/Arity),
        (   is_kind(action, General, M)
        ->  format(atom(Text), '~q is an action', [Name/Arity])
        ;   has_value_of_its_own(General, Head, M)
        ->  functor(Head, HeadName, HeadArity),
            format(atom(Text), '~q is derived, so ~w/~w says nothing \c
                                about it',
                   [Name/Arity, HeadName, HeadArity])
        )
    ;   has_possible_values(M),
        Formal = permission_error(derive, golog_domain, M),
        Text = 'in a domain with possible values nothing is derived'
    ).

wrong_action(A, M, Formal, Text) :-
    nonvar(A),
    (   \+ callable(A)
    ->  Formal = type_error(callable, A),
        format(atom(Text), '~q is no action', [A])
    ;   \+ is_kind(action, A, M),
        functor(A, Name, Arity),
        Formal = existence_error(golog_action, Name/Arity),
        format(atom(Text), 'there is no action ~q; prim_action/1 declares \c
                            one', [Name/Arity])
    ).

wrong_condition(P, Body, Formal, Text) :-
    Text = 'the condition is still a variable, or a number',
    (   var(P)
    ->  Body == true,
        Formal = instantiation_error
    ;   \+ callable(P),
        Formal = type_error(callable, P)
    ).

asks_for(P, M) :-
    (   var(P)
    ->  true
    ;   callable(P),
        (   member(Kind, [fluent, derived, proc]),
            is_kind(Kind, P, M)
        ;   memberchk(P, [done(_), haveExecuted(_), _:_])
        ;   compound(P),
            arg(_, P, Q),
            compound_or_fluent(Q, M)
        )
    ),
    !.

compound_or_fluent(Q, M) :-
    nonvar(Q),
    asks_for(Q, M).

%   The domain gives Fluent a value by a clause of Head.

has_value_of_its_own(Fluent, Head, M) :-
    member(Head, [ causes_val(_, F, _, _), causes_true(_, F, _),
                   causes_false(_, F, _), initially(F, _), senses(_, F) ]),
    clause(M:Head, _),
    nonvar(F),
    F = Fluent.
