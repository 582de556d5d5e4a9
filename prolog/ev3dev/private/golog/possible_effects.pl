:- module(ev3dev_golog_possible_effects,
          [ effects_known/5             % +Entry, +Situation, +Context,
                                        % +Module, -Effects
          ]).
:- use_module(library(lists), [append/3, member/2]).
:- use_module(library(pairs), [group_pairs_by_key/2]).
:- use_module(conditions, [holds/3, holds_once/3]).
:- use_module(context, [in_mode/3]).
:- use_module(effects,
              [caused/5, effect_if/7, internal_effect/5, is_internal/1]).
:- use_module(theory, [is_fluent/2, is_kind/3, located/3, possible_of/2]).
:- use_module(values, [value/5]).
:- use_module('../errors/errors', [throw_error/3]).

/** <module> The effects of an action in a domain with possible values
*/

%!  effects_known(+Entry, +Situation, +Context, +Module, -Effects) is det.
%
%   The values of a fluent after an action are those that it may cause, and if
%   it is not known to cause any, also those before; after one that forgets
%   them, those of the beginning.

effects_known(Entry, S, X, M, Effects) :-
    (   \+ is_kind(action, Entry, M),
        is_internal(Entry)
    ->  internal_effects(Entry, S, X, M, Effects)
    ;   acted_effects(Entry, S, X, M, Effects)
    ).

internal_effects(Entry, S, X, M, Effects) :-
    (   Entry = sim(A)
    ->  acted_effects(A, S, X, M, Effects)
    ;   Entry = e(A, Outcome)
    ->  findall(Effect,
                ( internal_effect(Entry, S, X, M, Effect)
                ; M:settles(A, Outcome, F, V, Condition),
                  effect_if(F, V, Condition, S, X, M, Effect),
                  arg(1, Effect, F1),
                  must_be_declared(F1, A, M)
                ),
                Effects1),
        findall(F-V, rejected(A, Outcome, F, V, S, X, M), Pairs),
        by_fluent(Pairs, Rejected),
        findall(set(F, Value),
                ( member(F-Vs, Rejected),
                  \+ memberchk(set(F, _), Effects1),
                  remaining(F, Vs, Entry, S, X, M, Value) ),
                Effects2),
        append(Effects1, Effects2, Effects)
    ;   findall(Effect, internal_effect(Entry, S, X, M, Effect), Effects)
    ).

acted_effects(A, S, X, M, Effects) :-
    in_mode(possible, X, Any),
    findall(F-V,
            ( may_cause(A, F, V, Condition, M),
              instance(F, M),
              holds(Condition, S, Any),
              must_be_declared(F, A, M) ),
            Pairs),
    by_fluent(Pairs, Caused),
    findall(Effect,
            ( member(F-Vs1, Caused),
              (   must_cause(A, F, S, X, M)
              ->  Vs = Vs1
              ;   findall(V, value(F, V, S, Any, M), Vs0),
                  append(Vs0, Vs1, Vs)
              ),
              possible_of(Vs, Value),
              Effect = set(F, Value)
            ; M:forget(A, F),
              instance(F, M),
              must_be_declared(F, A, M),
              Effect = set(F, '$initial')
            ),
            Effects).

may_cause(A, F, V, Condition, M) :-
    caused(A, F, V, Condition, M).
may_cause(A, F, V, Condition, M) :-
    M:causes(A, F, V, Condition).

%   causes/4 says all about its fluent.

must_cause(A, F, S, X, M) :-
    (   M:causes(A, F, _, _)
    ;   caused(A, F, _, Condition, M),
        holds(Condition, S, X)
    ),
    !.

rejected(A, Outcome, F, V, S, X, M) :-
    M:rejects(A, Outcome, F, V, Condition),
    instance(F, M),
    must_be_declared(F, A, M),
    in_mode(possible, X, Any),
    value(F, V, S, Any, M),
    holds_once(Condition, S, X).

remaining(F, Rejected, Entry, S, X, M, Value) :-
    in_mode(possible, X, Any),
    findall(V,
            ( value(F, V, S, Any, M), \+ memberchk(V, Rejected) ),
            Vs),
    (   possible_of(Vs, Value)
    ->  true
    ;   located(M, fluent(F), Where),
        format(atom(Text), '~wno possible value of ~q is left after ~q: \c
                            what was sensed contradicts what was known',
               [Where, F, Entry]),
        throw_error(domain_error(golog_sensing, Entry), _, Text)
    ).

instance(F, M) :-
    (   ground(F)
    ->  true
    ;   is_kind(fluent, F, M)
    ->  is_fluent(F, M)
    ;   true
    ).

must_be_declared(F, A, M) :-
    (   ground(F)
    ->  true
    ;   located(M, fluent(F), Where),
        functor(A, Name, Arity),
        format(atom(Text), '~wwhich fluents ~q changes is open: the \c
                            declaration of the fluent must enumerate its \c
                            arguments in a domain with possible values',
               [Where, Name/Arity]),
        throw_error(instantiation_error, _, Text)
    ).

by_fluent(Pairs0, Groups) :-
    keysort(Pairs0, Pairs),
    group_pairs_by_key(Pairs, Groups).
