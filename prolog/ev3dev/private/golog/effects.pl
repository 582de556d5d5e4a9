:- module(ev3dev_golog_effects,
          [ effect/4,                   % +Entry, +Situation0, +Context,
                                        % -Effect
            effect_if/7,                % +Fluent, +Value, +Condition,
                                        % +Situation0, +Context, +Module,
                                        % -Effect
            internal_effect/5,          % +Entry, +Situation0, +Context,
                                        % +Module, -Effect
            is_internal/1,              % +Entry
            equations_for/4,            % +Fluent, +Condition, -Equations,
                                        % -Rest
            caused/5                    % +Action, ?Fluent, -Value,
                                        % -Condition, +Module
          ]).
:- use_module(library(lists), [append/3, member/2]).
:- use_module(conditions, [all_hold/3, holds/3, holds_once/3]).
:- use_module(context, [context_module/2]).
:- use_module(theory, [is_fluent/2, is_kind/3, is_sensing_action/2]).

/** <module> The effects of an action

An effect is set(Fluent, Value), or open(Fluent, Value, Condition) if neither
the condition nor the declaration of the fluent enumerates its variables.
*/

%!  effect(+Entry, +Situation0, +Context, -Effect) is nondet.

effect(Entry, S0, Context, Effect) :-
    context_module(Context, M),
    (   \+ is_kind(action, Entry, M),
        is_internal(Entry)
    ->  internal_effect(Entry, S0, Context, M, Effect)
    ;   effect_in(Entry, S0, Context, M, Effect)
    ).

%!  is_internal(+Entry) is semidet.
%!  internal_effect(+Entry, +Situation0, +Context, +Module,
%!                  -Effect) is nondet.
%
%   As effect/4, for what is not an action of the domain.

is_internal(e(_, _)).
is_internal(set(_)).
is_internal(unset(_)).
is_internal(sim(_)).

internal_effect(e(X, V), S0, Context, M, Effect) :-
    sensed_effect(X, V, S0, Context, M, Effect).
internal_effect(set(F), _, _, _, set(F, true)).
internal_effect(unset(F), _, _, _, set(F, false)).
internal_effect(sim(A), S0, Context, M, Effect) :-
    effect_in(A, S0, Context, M, Effect).

effect_in(A, S0, Context, M, Effect) :-
    caused(A, F, V, Condition, M),
    effect_if(F, V, Condition, S0, Context, M, Effect).
effect_in(A, _, _, M, Effect) :-
    M:forget(A, F),
    (   ground(F)
    ->  Effect = set(F, '$unknown')
    ;   Effect = open(F, '$unknown', true)
    ).

%!  caused(+Action, ?Fluent, -Value, -Condition, +Module) is nondet.

caused(A, F, V, C, M) :-
    M:causes_val(A, F, V, C).
caused(A, F, true, C, M) :-
    M:causes_true(A, F, C).
caused(A, F, false, C, M) :-
    M:causes_false(A, F, C).

%   The name of a fluent wins over that of an action. The functor decides
%   where X is open.

sensed_effect(X, V, S0, Context, M, Effect) :-
    (   nonvar(X),
        is_kind(fluent, X, M),
        \+ \+ is_fluent(X, M)
    ->  Effect = set(X, V)
    ;   M:senses(X, F),
        Effect = set(F, V)
    ;   M:senses(X, V, F, V2, Condition),
        effect_if(F, V2, Condition, S0, Context, M, Effect)
    ;   nonvar(X),
        \+ is_sensing_action(X, M),
        Effect = set(X, V)
    ).

%!  effect_if(+Fluent, +Value, +Condition, +Situation0, +Context, +Module,
%!           -Effect) is nondet.
%
%   Effect is there if Condition holds.

effect_if(F, V, Condition, S0, Context, M, Effect) :-
    (   ground(F)
    ->  holds_once(Condition, S0, Context),
        Effect = set(F, V)
    ;   open_effect(F, V, Condition, S0, Context, M, Effect)
    ).

%   Equations of the condition may give the variables of F their values. Else
%   the declaration of the fluent enumerates them.

open_effect(F, V, Condition, S0, Context, M, Effect) :-
    equations_for(F, Condition, Equations, Rest),
    Equations \== [],
    !,
    all_hold(Equations, S0, Context),
    (   ground(F)
    ->  once(all_hold(Rest, S0, Context)),
        Effect = set(F, V)
    ;   open_effect(F, V, and(Rest), S0, Context, M, Effect)
    ).
open_effect(F, V, Condition, S0, Context, M, Effect) :-
    (   is_kind(fluent, F, M)
    ->  findall(i(F, V, Condition), is_fluent(F, M), Instances0),
        sort(Instances0, Instances),
        member(i(F1, V1, Condition1), Instances)
    ;   F1 = F,
        V1 = V,
        Condition1 = Condition
    ),
    (   ground(F1)
    ->  holds_once(Condition1, S0, Context),
        Effect = set(F1, V1)
    ;   is_positive(Condition1),
        solved(F1-V1, Condition1, S0, Context, Solved)
    ->  member(F1-V1, Solved),
        Effect = set(F1, V1)
    ;   term_variables(F1, Variables),
        term_variables(Condition1-V1, Others),
        \+ shared(Variables, Others)
    ->  holds_once(Condition1, S0, Context),
        Effect = open(F1, V1, true)
    ;   Effect = open(F1, V1, Condition1)
    ).

%   The condition itself enumerates the fluents that are set, if it negates
%   nothing and is not a comparison that needs their arguments.

is_positive(Condition) :-
    nonvar(Condition),
    (   ( Condition = and(P, Q) ; Condition = or(P, Q) )
    ->  is_positive(P),
        is_positive(Q)
    ;   ( Condition = and(Ps) ; Condition = or(Ps) )
    ->  is_list(Ps),
        \+ ( member(P, Ps), \+ is_positive(P) )
    ;   Condition = some(_, P)
    ->  is_positive(P)
    ;   callable(Condition),
        functor(Condition, Name, _),
        \+ memberchk(Name, [ neg, all, impl, equiv, \+, not, \=, \==, ==,
                             true, ->, ;, know, kwhether ])
    ).

solved(FV, Condition, S, Context, Solved) :-
    catch(findall(FV, holds(Condition, S, Context), Solved0),
          error(instantiation_error, _), fail),
    ground(Solved0),
    sort(Solved0, Solved).

shared(Xs, Ys) :-
    member(X, Xs),
    member(Y, Ys),
    X == Y,
    !.

%!  equations_for(+Fluent, +Condition, -Equations, -Rest) is det.
%
%   Equations are the parts of the conjunction Condition that give variables
%   of Fluent their values, Rest are the others.

equations_for(F, Condition, Equations, Rest) :-
    conjuncts(Condition, Conjuncts),
    term_variables(F, Variables),
    equations(Conjuncts, Variables, Equations, Rest).

conjuncts(Condition, Conjuncts) :-
    (   var(Condition)
    ->  Conjuncts = [Condition]
    ;   Condition = and(P, Q)
    ->  conjuncts(P, Ps),
        conjuncts(Q, Qs),
        append(Ps, Qs, Conjuncts)
    ;   Condition = and(List),
        is_list(List)
    ->  all_conjuncts(List, Conjuncts)
    ;   Conjuncts = [Condition]
    ).

all_conjuncts([], []).
all_conjuncts([P|Ps], Conjuncts) :-
    conjuncts(P, Conjuncts1),
    all_conjuncts(Ps, Conjuncts2),
    append(Conjuncts1, Conjuncts2, Conjuncts).

equations([], _, [], []).
equations([P|Ps], Variables, Equations, Rest) :-
    (   nonvar(P),
        P = (A = B),
        member(X, [A, B]),
        var(X),
        shared([X], Variables)
    ->  Equations = [P|Equations1],
        Rest = Rest1
    ;   Equations = Equations1,
        Rest = [P|Rest1]
    ),
    equations(Ps, Variables, Equations1, Rest1).
