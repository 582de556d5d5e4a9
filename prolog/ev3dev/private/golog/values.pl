:- module(ev3dev_golog_values,
          [ fluent_value/4,             % ?Fluent, ?Value, +Situation,
                                        % +Context
            value/5,                    % +Fluent, -Value, +Situation,
                                        % +Context, +Module
            known_value/4,              % +Fluent, -Value, +Situation,
                                        % +Context
            known_or_declared/3,        % +Fluent, +Situation, +Module
            asks_unknown/3,             % +Condition, +Situation, +Context
            evaluated_arguments/4,      % +Term, -Evaluated, +Situation,
                                        % +Context
            fluents_now/3               % +Situation, +Context, -Pairs
          ]).
:- use_module('../basics/fields', [goal_expansion/2, term_expansion/2]).
:- use_module(library(assoc), [assoc_to_keys/2, get_assoc/3]).
:- use_module(library(lists), [append/3, member/2]).
:- use_module(context,
              [ context_mode/2, context_module/2, in_mode/3, is_recorded/1,
                print_once/3
              ]).
:- use_module(situation, [initial_situation/1]).
:- use_module(theory,
              [ has_clauses/2, has_possible_values/1, initial_value/3,
                is_fluent/2, is_kind/3,
                is_set_by_exogenous/2, located/3
              ]).

/** <module> The values of fluents

An effect that is still open is decided by regression, when the value of its
fluent is asked: whether its condition held in the situation before it.
*/

%   decided(+Condition, +Situation, +Context) is semidet: conditions.pl says
%   whether Condition holds.

:- multifile decided/3.

%!  fluent_value(?Fluent, ?Value, +Situation, +Context) is nondet.
%
%   True if the fluent has Value. A Fluent with variables is instantiated to
%   each.

fluent_value(F, V, S, Context) :-
    context_module(Context, M),
    (   ground(F)
    ->  value(F, V0, S, Context, M),
        V = V0
    ;   findall(F, is_fluent(F, M), Fs0),
        sort_if_open(Fs0, F, S, M, Fs),
        member(F, Fs),
        value(F, V0, S, Context, M),
        V = V0
    ).

%   Fluents whose declaration leaves variables: those with a value.

sort_if_open(Fs0, F, Situation, M, Fs) :-
    (   ground(Fs0)
    ->  Fs = Fs0
    ;   fluents_with_values(Fs0, F, Situation, M, Fs)
    ).

%   Fs are the ground ones of Declared, and those of the form F that have a
%   value, in standard order.

fluents_with_values(Declared, F, Situation, M, Fs) :-
    Situation = situation(values: Values),
    assoc_to_keys(Values, Keys),
    findall(F, member(F, Keys), Fs1),
    findall(F, ( M:initially(F, _), ground(F) ), Fs2),
    findall(G, ( member(G, Declared), ground(G) ), Fs3),
    append(Fs1, Fs2, Fs4),
    append(Fs3, Fs4, Fs5),
    sort(Fs5, Fs).

%!  value(+Fluent, -Value, +Situation, +Context, +Module) is nondet.
%
%   Value is that of the ground Fluent; in the mode `possible`, on
%   backtracking each possible one.

value(F, V, Situation, Context, M) :-
    Situation = situation(values: Values, open: Open),
    (   get_assoc(F, Values, v(C, V0))
    ->  true
    ;   C = 0,
        V0 = '$initial'
    ),
    (   Open == []
    ->  V1 = V0
    ;   open_value(Open, C, F, V2, Context)
    ->  V1 = V2
    ;   V1 = V0
    ),
    (   V1 == '$initial'
    ->  (   initial_value(F, V3, M)
        ->  true
        ;   may_have(F, Vs0, M)
        ->  V3 = '$possible'(Vs0)
        ;   no_initial_value(F, M, Context),
            fail
        )
    ;   V1 == '$sensed'
    ->  throw('$golog_unknown'(F))
    ;   V1 \== '$unknown',
        V3 = V1
    ),
    (   nonvar(V3),
        V3 = '$possible'(Vs)
    ->  context_mode(Context, Mode),
        (   Mode == possible
        ->  member(V, Vs)
        ;   Mode == stored,
            V = V3
        )
    ;   V = V3
    ).

open_value([open(C1, F1, V1, Condition, S1)|Open], C, F, V, Context) :-
    C1 > C,
    (   copy_term(F1-V1-Condition, F-V2-Condition2),
        (   S1 == rigid
        ->  initial_situation(S2)
        ;   S2 = S1
        ),
        decided(Condition2, S2, Context)
    ->  V = V2
    ;   open_value(Open, C, F, V, Context)
    ).

%   may_have(+Fluent, -Values, +Module) is semidet: in a domain with possible
%   values, Fluent has no value before it is sensed, but these are all that it
%   may have.

may_have(F, Vs, M) :-
    is_still_unknown(F, M),
    (   is_kind(relational, F, M)
    ->  Vs = [false, true]
    ;   has_clauses(M, sensed_values(_, _)),
        M:sensed_values(F, Vs0),
        sort(Vs0, Vs),
        Vs = [_, _|_]
    ->  true
    ).

is_still_unknown(F, M) :-
    has_possible_values(M),
    (   is_kind(sensed, F, M)
    ->  true
    ;   is_kind(uncertain, F, M)
    ).

%!  asks_unknown(+Condition, +Situation, +Context) is semidet.
%
%   In a domain with possible values Condition asks for a fluent that has none
%   before it is sensed.

asks_unknown(P, S, Context) :-
    context_module(Context, M),
    has_possible_values(M),
    unknown_in(P, S, Context, M).

unknown_in(P, S, Context, M) :-
    (   callable(P),
        ground(P),
        is_kind(fluent, P, M),
        is_still_unknown(P, M),
        is_fluent(P, M),
        \+ value(P, _, S, Context, M)
    ->  true
    ;   compound(P),
        arg(_, P, Q),
        unknown_in(Q, S, Context, M)
    ->  true
    ).

%   A fluent without a value: a condition about it is false. That is as it
%   should be if its value comes from outside; else it is most likely
%   forgotten, or the program asks before it looks. A plan may well do that,
%   as it does not look; it is made again then.

no_initial_value(F, M, Context) :-
    (   is_kind(relational, F, M)
    ->  Kind = informational
    ;   Kind = warning
    ),
    (   is_kind(initial, F, M)
    ->  true
    ;   is_still_unknown(F, M)
    ->  true
    ;   is_kind(sensed, F, M)
    ->  (   is_recorded(Context)
        ->  located(M, fluent(F), Where),
            print_once(M, Kind, not_sensed_yet(Where, F))
        ;   true
        )
    ;   Kind == warning,
        is_set_by_exogenous(F, M)
    ->  true
    ;   located(M, fluent(F), Where),
        print_once(M, Kind, no_initial_value(Where, F))
    ).

%!  fluents_now(+Situation, +Context, -Pairs) is det.
%
%   Pairs is a list of Fluent-Value of all ground fluents that have a value,
%   or '$possible'(Values), in standard order.

fluents_now(S, Context, Pairs) :-
    context_module(Context, M),
    in_mode(stored, Context, Stored),
    findall(F, is_fluent(F, M), Declared),
    fluents_with_values(Declared, _, S, M, Fs),
    findall(F-V, ( member(F, Fs), known_value(F, V, S, Stored) ), Pairs).

%!  known_value(+Fluent, -Value, +Situation, +Context) is nondet.
%
%   As value/5, if the domain or an entry has given Fluent a value.

known_value(F, V, S, Context) :-
    context_module(Context, M),
    S = situation(values: Values),
    (   get_assoc(F, Values, _)
    ->  \+ F = '$assumed'(_)
    ;   is_kind(initial, F, M)
    ),
    value(F, V, S, Context, M).

%!  evaluated_arguments(+Term, -Evaluated, +Situation, +Context) is nondet.
%
%   Evaluated is Term with the fluents in its arguments replaced by their
%   values.

evaluated_arguments(T0, T, S, Context) :-
    (   compound(T0)
    ->  context_module(Context, M),
        compound_name_arity(T0, Name, Arity),
        compound_name_arity(T, Name, Arity),
        arguments_with_values(1, Arity, T0, T, S, Context, M)
    ;   T = T0
    ).

arguments_with_values(I, Arity, T0, T, S, Context, M) :-
    (   I > Arity
    ->  true
    ;   arg(I, T0, A0),
        arg(I, T, A),
        with_values(A0, A, S, Context, M),
        I1 is I+1,
        arguments_with_values(I1, Arity, T0, T, S, Context, M)
    ).

%   with_values(+Term0, -Term, +Situation, +Context, +Module) is nondet.
%   True if Term is Term0 with its fluents replaced by their values.

with_values(T0, T, S, Context, M) :-
    (   var(T0)
    ->  T = T0
    ;   atom(T0)
    ->  (   is_kind(fluent, T0, M),
            is_fluent(T0, M)
        ->  value(T0, T, S, Context, M)
        ;   T = T0
        )
    ;   compound(T0)
    ->  compound_name_arity(T0, Name, Arity),
        compound_name_arity(T1, Name, Arity),
        arguments_with_values(1, Arity, T0, T1, S, Context, M),
        (   is_kind(fluent, T1, M),
            known_or_declared(T1, S, M)
        ->  fluent_value(T1, T, S, Context)
        ;   T = T1
        )
    ;   T = T0
    ).

%!  known_or_declared(+Fluent, +Situation, +Module) is semidet.

known_or_declared(F, Situation, M) :-
    Situation = situation(values: Values),
    (   ground(F),
        get_assoc(F, Values, _)
    ->  true
    ;   \+ \+ is_fluent(F, M)
    ).
