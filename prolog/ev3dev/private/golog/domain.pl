:- module(ev3dev_golog_domain,
          [ initial_situation/1,        % -Situation
            situation_history/2,        % +Situation, -History
            situation_count/2,          % +Situation, -Count
            situation_state/2,          % +Situation, -State
            situation/3,                % +History, -Situation, +Context
            history_shortened/3,        % +Length, +Situation0, -Situation
            done/4,                     % +Entry, +Situation0, -Situation,
                                        % +Context
            entries_done/4,             % +Entries, +Situation0, -Situation,
                                        % +Context
            marked/3,                   % +Entry, +Situation0, -Situation
            fluent_value/4,             % ?Fluent, ?Value, +Situation,
                                        % +Context
            evaluated_arguments/4,      % +Term, -Evaluated, +Situation,
                                        % +Context
            was_done/2,                 % ?Action, +Situation
            holds/3,                    % +Condition, +Situation, +Context
            domain_value/4,             % -Value, +Domain, +Situation,
                                        % +Context
            chosen/3,                   % +Choices, +Situation, +Context
            condition_of/3,             % +Condition, -Body, +Context
            sensed_later/4,             % +Action, +Situation0, -Situation,
                                        % +Context
            fluent_in/4,                % +Condition, -Fluent, +Situation,
                                        % +Context
            opened/4,                   % +Condition, +Situation0, -Situation,
                                        % +Context
            assumed/3,                  % +Case, +Situation0, -Situation
            branch_on/3,                % +Fluent, +Condition, +Context
            fluents_now/3               % +Situation, +Context, -Pairs
          ]).
:- use_module(library(assoc),
              [ assoc_to_keys/2, assoc_to_list/2, empty_assoc/1, get_assoc/3,
                put_assoc/4
              ]).
:- use_module(library(lists), [append/3, member/2, reverse/2]).
:- use_module(library(pairs), [group_pairs_by_key/2]).
:- use_module(context,
              [ call_of/3, context_effort/2, context_mode/2, context_module/2,
                dual/2, entered/4, in_mode/3, is_recorded/1, print_once/3
              ]).
:- use_module(effort, [asks_history/1, polled/1]).
:- use_module(programs,
              [ closed/1, condition_construct/1, fresh/4 ]).
:- use_module(theory,
              [ domain_list/3, has_clauses/2, initial_value/3, is_fluent/2,
                is_kind/3, is_sensing_action/2, is_set_by_exogenous/2,
                located/3, names_fluent/2, possible_of/2, proc_body/3
              ]).
:- use_module('../errors/errors', [throw_error/3]).

/** <module> Situations, the values of fluents, conditions

A situation is what a history makes of the initial one:

    s(History, Count, Values, Open, Done)

History is a list, newest first, of actions and sensing results, perhaps only
the newest of them; Count counts all. Values is an AVL tree with the value of
each ground fluent that an entry has set. So the database is progressed with
each action, a look-up does not depend on the length of the history, and
backtracking to an earlier situation costs nothing. Done is the set of all
entries.

An effect on a fluent with a variable that neither its condition nor the
declaration of the fluent enumerates is kept in Open, with the situation
before it, and is decided by regression when a value is asked. If its
condition compares, and so depends on the situation by values only, these are
put in, and it hides the older effects under the same condition: Open does not
grow with each action.

Sources: Levesque, Reiter, Lesperance, Lin, Scherl: GOLOG (1997); De Giacomo,
Lesperance, Levesque: ConGolog (2000), De Giacomo, Levesque: An incremental
interpreter for high-level programs with sensing (1999).
*/

%!  initial_situation(-Situation) is det.
%
%   Situation is the one in which nothing has happened.

initial_situation(s([], 0, Empty, [], Empty)) :-
    empty_assoc(Empty).

%!  situation_history(+Situation, -History) is det.
%!  situation_count(+Situation, -Count) is det.
%
%   History has the entries of Situation, or the newest of them; Count is how
%   many there are in all.

situation_history(s(History, _, _, _, _), History).

situation_count(s(_, Count, _, _, _), Count).

%!  situation_state(+Situation, -State) is semidet.
%
%   Situations of the same State, a list of Fluent-Value, have the same
%   future, but for conditions that ask what was done. Fails if there are
%   effects that are still to be decided.

situation_state(s(_, _, Values, [], _), State) :-
    assoc_to_list(Values, Pairs),
    untimed(Pairs, State).

untimed([], []).
untimed([F-v(_, V)|Pairs], [F-V|State]) :-
    untimed(Pairs, State).

%!  situation(+History, -Situation, +Context) is det.
%
%   Situation is the one after History, a list, newest first.

situation(History, Situation, Context) :-
    reverse(History, Entries),
    initial_situation(Situation0),
    entries_done(Entries, Situation0, Situation, Context).

%!  history_shortened(+Length, +Situation0, -Situation) is det.
%
%   Situation has only the newest Length entries of the history in its list.

history_shortened(Length, s(H0, C, V, O, D), s(H, C, V, O, D)) :-
    first_of(Length, H0, H).

first_of(N, List0, List) :-
    (   N > 0,
        List0 = [X|Xs0]
    ->  List = [X|Xs],
        N1 is N-1,
        first_of(N1, Xs0, Xs)
    ;   List = []
    ).

%!  marked(+Entry, +Situation0, -Situation) is det.
%
%   Situation has Entry in its history; no fluent changes.

marked(Entry, s(H, C0, V, O, D), s([Entry|H], C, V, O, D)) :-
    C is C0+1.

%!  done(+Entry, +Situation0, -Situation, +Context) is det.
%
%   Situation is what follows on Situation0 by Entry: an action, or a sensing
%   result e(Fluent, Value) or e(Action, Outcome).

done(Entry, S0, S, Context) :-
    S0 = s(H, C0, Values0, Open0, Done0),
    C is C0+1,
    effects(Entry, S0, Context, Effects),
    with_effects(Effects, C, S0, Context, Values0, Values, Open0, Open),
    (   ground(Entry)
    ->  put_assoc(Entry, Done0, true, Done)
    ;   Done = Done0
    ),
    S = s([Entry|H], C, Values, Open, Done).

%!  entries_done(+Entries, +Situation0, -Situation, +Context) is det.
%
%   As done/4 for each of Entries, the oldest first.

entries_done([], S, S, _).
entries_done([Entry|Entries], S0, S, Context) :-
    done(Entry, S0, S1, Context),
    entries_done(Entries, S1, S, Context).

%   An effect keeps the variables of its action: a test later in the program
%   may bind them.

effects(Entry, S0, Context, Effects) :-
    (   context_mode(Context, known)
    ->  context_module(Context, M),
        effects_known(Entry, S0, Context, M, Effects)
    ;   ground(Entry)
    ->  findall(Effect, effect(Entry, S0, Context, Effect), Effects)
    ;   findall(Entry-Effect, effect(Entry, S0, Context, Effect), Pairs),
        of_same(Pairs, Entry, Effects)
    ).

of_same([], _, []).
of_same([Entry-Effect|Pairs], Entry, [Effect|Effects]) :-
    of_same(Pairs, Entry, Effects).

%   The first effect on a fluent counts.

with_effects([], _, _, _, Values, Values, Open, Open).
with_effects([Effect|Effects], C, S0, Context, Values0, Values, Open0,
             Open) :-
    (   Effect = set(F, V)
    ->  Open1 = Open0,
        (   get_assoc(F, Values0, v(C, _))
        ->  Values1 = Values0
        ;   put_assoc(F, Values0, v(C, V), Values1)
        )
    ;   Effect = open(F, V, Condition0),
        Values1 = Values0,
        rigid(Condition0, S0, Context, Condition, Base),
        without_hidden(Open0, F, Condition, Base, C, Open1a),
        after_same(Open1a, C, open(C, F, V, Condition, Base), Open1)
    ),
    with_effects(Effects, C, S0, Context, Values1, Values, Open1, Open).

%   without_hidden(+Open0, +Fluent, +Condition, +Base, +Count, -Open): Open is
%   Open0 without the older effects that one on Fluent hides: if its Condition
%   is `true`, or if it is rigid and theirs is the same.

without_hidden([], _, _, _, _, []).
without_hidden([O|Os0], F, P, Base, C, Os) :-
    O = open(C1, F1, _, P1, Base1),
    (   C1 < C,
        (   P == true
        ->  subsumes_term(F, F1)
        ;   Base == rigid,
            Base1 == rigid,
            F-P =@= F1-P1
        )
    ->  Os = Os1
    ;   Os = [O|Os1]
    ),
    without_hidden(Os0, F, P, Base, C, Os1).

%   rigid(+Condition0, +Situation, +Context, -Condition, -Base): Condition0
%   does not depend on Situation once its fluents have been replaced by their
%   values: Base is `rigid`. Else it is Situation.

rigid(P0, S, Context, P, Base) :-
    context_module(Context, M),
    (   comparisons(P0, S, Context, M, P1),
        \+ names_fluent(P1, M)
    ->  P = P1,
        Base = rigid
    ;   P = P0,
        Base = S
    ).

comparisons(P0, S, Context, M, P) :-
    nonvar(P0),
    (   P0 == true
    ->  P = true
    ;   P0 = neg(Q0)
    ->  P = neg(Q),
        comparisons(Q0, S, Context, M, Q)
    ;   ( P0 = and(Q0, R0), P = and(Q, R) ; P0 = or(Q0, R0), P = or(Q, R) )
    ->  comparisons(Q0, S, Context, M, Q),
        comparisons(R0, S, Context, M, R)
    ;   ( P0 = (_ = _) ; P0 = (_ \= _) ; P0 = (_ == _) ; P0 = (_ \== _) )
    ->  once(evaluated_arguments(P0, P, S, Context))
    ).

%   Newest first; those of one action in the order of the clauses.

after_same([O|Os0], C, New, [O|Os]) :-
    O = open(C, _, _, _, _),
    !,
    after_same(Os0, C, New, Os).
after_same(Os, _, New, [New|Os]).

%   effect(+Entry, +Situation0, +Context, -Effect): set(Fluent, Value) or
%   open(Fluent, Value, Condition)

effect(Entry, S0, Context, Effect) :-
    context_module(Context, M),
    (   \+ is_kind(action, Entry, M),
        is_internal(Entry)
    ->  internal_effect(Entry, S0, Context, M, Effect)
    ;   effect_in(Entry, S0, Context, M, Effect)
    ).

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

effect_if(F, V, Condition, S0, Context, M, Effect) :-
    (   ground(F)
    ->  holds_once(Condition, S0, Context),
        Effect = set(F, V)
    ;   open_effect(F, V, Condition, S0, Context, M, Effect)
    ).

%   Equations of the condition may give the variables of F their values. Else
%   the declaration of the fluent enumerates them.

open_effect(F, V, Condition, S0, Context, M, Effect) :-
    conjuncts(Condition, Conjuncts),
    term_variables(F, Variables),
    equations(Conjuncts, Variables, Equations, Rest),
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
%   nothing and is no comparison that needs their arguments.

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

all_hold([], _, _).
all_hold([P|Ps], S, Context) :-
    holds(P, S, Context),
    all_hold(Ps, S, Context).

holds_once(Condition, S, Context) :-
    (   Condition == true
    ->  true
    ;   holds(Condition, S, Context)
    ->  true
    ).

                /*******************************
                *            VALUES            *
                *******************************/

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

sort_if_open(Fs0, F, s(_, _, Values, _, _), M, Fs) :-
    (   ground(Fs0)
    ->  Fs = Fs0
    ;   assoc_to_keys(Values, Keys),
        findall(F, member(F, Keys), Fs1),
        findall(F,
                ( M:initially(F, _), ground(F) ),
                Fs2),
        findall(G, ( member(G, Fs0), ground(G) ), Fs3),
        append(Fs1, Fs2, Fs4),
        append(Fs3, Fs4, Fs5),
        sort(Fs5, Fs)
    ).

%   value(+Fluent, -Value, +Situation, +Context, +Module) is semidet; in the
%   mode `possible` on backtracking each possible value.

value(F, V, s(_, _, Values, Open, _), Context, M) :-
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
        holds_once(Condition2, S2, Context)
    ->  V = V2
    ;   open_value(Open, C, F, V, Context)
    ).

%   A fluent without a value: no condition about it holds. That is as it
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
    S = s(_, _, Values, _, _),
    context_module(Context, M),
    in_mode(stored, Context, Stored),
    assoc_to_keys(Values, Fs1),
    findall(F,
            ( M:initially(F, _), ground(F) ),
            Fs2),
    findall(F, ( is_fluent(F, M), ground(F) ), Fs3),
    append(Fs1, Fs2, Fs4),
    append(Fs3, Fs4, Fs5),
    sort(Fs5, Fs),
    findall(F-V, ( member(F, Fs), known_value(F, V, S, Stored) ), Pairs).

known_value(F, V, S, Context) :-
    context_module(Context, M),
    S = s(_, _, Values, _, _),
    (   get_assoc(F, Values, _)
    ->  \+ F = '$assumed'(_)
    ;   is_kind(initial, F, M)
    ),
    value(F, V, S, Context, M).

%!  was_done(?Entry, +Situation) is nondet.

was_done(Entry, s(_, _, _, _, Done)) :-
    (   ground(Entry)
    ->  get_assoc(Entry, Done, _)
    ;   assoc_to_keys(Done, Entries),
        member(Entry, Entries)
    ).

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

known_or_declared(F, s(_, _, Values, _, _), M) :-
    (   ground(F),
        get_assoc(F, Values, _)
    ->  true
    ;   \+ \+ is_fluent(F, M)
    ).

                /*******************************
                *          CONDITIONS          *
                *******************************/

%!  holds(+Condition, +Situation, +Context) is nondet.
%
%   True if Condition holds. A Condition without free variables succeeds once.

holds(P, S, Context) :-
    (   var(P)
    ->  throw_error(instantiation_error, _,
                    'a condition is still a variable when it is tested')
    ;   closed(P)
    ->  holds_(P, S, Context),
        !
    ;   holds_(P, S, Context)
    ).

holds_(P, S, Context) :-
    (   condition_construct(P)
    ->  holds_construct(P, S, Context)
    ;   context_mode(Context, Mode),
        (   ( Mode == plain ; Mode == possible )
        ->  holds_atom(P, S, Context)
        ;   Mode == known
        ->  known_atom(P, S, Context)
        ;   catch(holds_atom(P, S, Context), '$golog_unknown'(F),
                  holds_if_assumed(P, F, S, Context))
        )
    ).

holds_atom(P, S, Context) :-
    (   P = _:_
    ->  call_of(P, P, Context)
    ;   context_module(Context, M),
        is_kind(proc, P, M)
    ->  condition_of(P, Body, Context),
        entered(condition, P, Context, Context1),
        holds(Body, S, Context1)
    ;   context_module(Context, M),
        is_kind(fluent, P, M)
    ->  evaluated_arguments(P, F, S, Context),
        (   known_or_declared(F, S, M)
        ->  fluent_value(F, V, S, Context),
            V == true
        ;   call_of(P, F, Context)
        )
    ;   evaluated_arguments(P, Goal, S, Context),
        call_of(P, Goal, Context)
    ).

%!  condition_of(+Call, -Body, +Context) is nondet.

condition_of(Call, Body, Context) :-
    context_module(Context, M),
    proc_body(Call, Body, M).

holds_construct(true, _, _).
holds_construct(and(P, Q), S, X) :-
    holds(P, S, X),
    holds(Q, S, X).
holds_construct(and(Ps), S, X) :-
    all_hold(Ps, S, X).
holds_construct(or(P, Q), S, X) :-
    (   holds(P, S, X)
    ;   holds(Q, S, X)
    ).
holds_construct(or(Ps), S, X) :-
    member(P, Ps),
    holds(P, S, X).
holds_construct(neg(P), S, X0) :-
    dual(X0, X),
    \+ holds(P, S, X).
holds_construct(\+ P, S, X) :-
    holds_construct(neg(P), S, X).
holds_construct(not(P), S, X) :-
    holds_construct(neg(P), S, X).
holds_construct((P, Q), S, X) :-
    holds(P, S, X),
    holds(Q, S, X).
holds_construct((P ; Q), S, X) :-
    (   nonvar(P),
        P = (If -> Then)
    ->  holds_if(If, Then, Q, S, X)
    ;   (   holds(P, S, X)
        ;   holds(Q, S, X)
        )
    ).
holds_construct((P -> Q), S, X) :-
    holds_if(P, Q, false, S, X).
holds_construct(impl(P, Q), S, X) :-
    (   holds_construct(neg(P), S, X)
    ;   holds(Q, S, X)
    ).
holds_construct(equiv(P, Q), S, X) :-
    holds_if(P, Q, neg(Q), S, X).
holds_construct(some(Vs, P0), S, X) :-
    fresh(Vs, P0, P, Choices),
    chosen(Choices, S, X),
    holds(P, S, X).
holds_construct(some(V, D, P), S, X) :-
    holds_construct(some((V, D), P), S, X).
holds_construct(all(Vs, P0), S, X) :-
    fresh(Vs, P0, P, Choices),
    \+ ( chosen(Choices, S, X),
         \+ holds(P, S, X) ).
holds_construct(all(V, D, P), S, X) :-
    holds_construct(all((V, D), P), S, X).
holds_construct(done(A0), S, X) :-
    context_effort(X, Effort),
    asks_history(Effort),
    evaluated_arguments(A0, A, S, X),
    was_done(A, S).
holds_construct(haveExecuted(A), S, X) :-
    holds_construct(done(A), S, X).
holds_construct(know(F), S, X0) :-
    in_mode(known, X0, X),
    is_known(F, S, X).
holds_construct(kwhether(F), S, X) :-
    holds_construct(know(F), S, X).
holds_construct(possibly(P), S, X0) :-
    in_mode(possible, X0, X),
    holds(P, S, X).

holds_if(P, Q, R, S, X) :-
    context_mode(X, Mode),
    (   ( Mode == known ; Mode == possible )
    ->  (   holds(and(P, Q), S, X)
        ;   holds(and(neg(P), R), S, X)
        )
    ;   holds(P, S, X)
    ->  holds(Q, S, X)
    ;   holds(R, S, X)
    ).

is_known(F0, S, X) :-
    context_module(X, M),
    evaluated_arguments(F0, F, S, X),
    (   is_kind(fluent, F, M)
    ->  ( ground(F) -> true ; is_fluent(F, M) ),
        known_value(F, _, S, X)
    ;   holds(F0, S, X)
    ->  true
    ;   holds(neg(F0), S, X)
    ).

                /*******************************
                *       POSSIBLE VALUES        *
                *******************************/

%   In a domain with possible values a fluent may have '$possible'(Set), two
%   values or more. A condition is known if it holds for each value, possible
%   if for some. Each simple condition in it takes the values by itself, so
%   `known` and `possible` change places under a negation only, and what is
%   known is true; but or(p, neg(p)) is not known if neither of its parts is.
%   This is how the evaluator of IndiGolog does it, after Vassos: A
%   feasible approach to disjunctive knowledge in situation calculus (2005),
%   and Sardina, Vassos: The Wumpus World in IndiGolog (2005).

%   known_atom(+Condition, +Situation, +Context) is nondet. True if Condition,
%   without constructs, holds whichever possible values its fluents have.

known_atom(P, S, Context) :-
    context_module(Context, M),
    (   P \= _:_,
        is_kind(proc, P, M)
    ->  holds_atom(P, S, Context)
    ;   dual(Context, Any),
        findall(P-Case, case(P, S, Any, M, Case), Cases0),
        sort(Cases0, Cases),
        (   Cases = [P-Case]
        ->  is_satisfied(Case, P, Context)
        ;   findall(P,
                    ( member(P-Case, Cases),
                      is_satisfied(Case, P, Context) ),
                    Ps0),
            sort(Ps0, Ps),
            member(P, Ps),
            \+ ( member(P-Case, Cases),
                 \+ is_satisfied(Case, P, Context) )
        )
    ).

%   case(+Condition, +Situation, +Context, +Module, -Case) is nondet: Case is
%   what Condition comes to for some possible values.

case(P, S, X, M, Case) :-
    (   P = _:_
    ->  Case = call(P)
    ;   evaluated_arguments(P, P1, S, X),
        (   is_kind(fluent, P, M),
            known_or_declared(P1, S, M)
        ->  fluent_value(P1, V, S, X),
            Case = is(V)
        ;   Case = call(P1)
        )
    ).

is_satisfied(is(V), _, _) :-
    V == true.
is_satisfied(call(Goal), P, X) :-
    call_of(P, Goal, X).

%   effects_known(+Entry, +Situation, +Context, +Module, -Effects) is det. The
%   values of a fluent after an action are those that it may cause, and if it
%   is not known to cause any, also those before; after one that forgets them,
%   those of the beginning.

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

                /*******************************
                *     WHAT WILL BE SENSED      *
                *******************************/

%   A conditional plan is made before its actions have sensed anything. After
%   a sensing action the value of its fluent is '$sensed'. A condition that
%   depends on it cannot be decided, but its cases can be assumed one by one:
%   '$golog_branch'(Cases) is thrown, and the planner goes on in each. So a
%   plan never relies on a value that it does not test. A case is
%   Test-Assumption; the Test of the last may be `else`.

%!  sensed_later(+Action, +Situation0, -Situation, +Context) is det.
%
%   Action has been done in Situation0, and what it senses is open. If it
%   senses anything, the history gets a mark, so that no plan goes on.

sensed_later(A, S0, S, Context) :-
    context_module(Context, M),
    findall(F, sensed_fluent(A, F, M), Fs),
    (   Fs == []
    ->  S = S0
    ;   marked('$sensed', S0, S1),
        all_open(Fs, S1, S)
    ).

sensed_fluent(A, F, M) :-
    is_sensing_action(A, M),
    (   M:senses(A, F)
    ;   M:senses(A, _, F, _, _)
    ),
    ( ground(F) -> true ; is_fluent(F, M) ).

all_open(Fs, s(H, C, Values0, Open, Done), s(H, C, Values, Open, Done)) :-
    open_values(Fs, v(C, '$sensed'), Values0, Values).

open_values([], _, Values, Values).
open_values([F|Fs], Value, Values0, Values) :-
    put_assoc(F, Values0, Value, Values1),
    open_values(Fs, Value, Values1, Values).

%!  opened(+Condition, +Situation0, -Situation, +Context) is det.
%
%   The values of the fluents in Condition are open, whatever they are in
%   Situation0.

opened(P, S0, S, Context) :-
    (   ground(P),
        \+ quantified(P)
    ->  findall(F, fluent_in(P, F, S0, Context), Fs),
        all_open(Fs, S0, S)
    ;   no_branch(P, 'it has variables', Context)
    ).

quantified(P) :-
    compound(P),
    (   functor(P, Name, Arity),
        memberchk(Name/Arity, [some/2, some/3, all/2, all/3])
    ->  true
    ;   arg(_, P, Q),
        quantified(Q)
    ).

%!  fluent_in(+Condition, -Fluent, +Situation, +Context) is nondet.
%
%   Condition asks for the value of Fluent.

fluent_in(P, F, S, Context) :-
    callable(P),
    context_module(Context, M),
    (   \+ condition_construct(P),
        is_kind(proc, P, M)
    ->  condition_of(P, Body, Context),
        entered(condition, P, Context, Context1),
        fluent_in(Body, F, S, Context1)
    ;   is_kind(fluent, P, M),
        arguments_known(P, F, S, Context, M),
        known_or_declared(F, S, M)
    ;   compound(P),
        arg(_, P, Q),
        fluent_in(Q, F, S, Context)
    ).

%   holds_if_assumed(+Condition, +Fluent, +Situation, +Context): the value of
%   Fluent is open. True if Condition is assumed to hold.

holds_if_assumed(P0, F, S, Context) :-
    context_module(Context, M),
    (   P0 == F
    ->  P = F
    ;   arguments_known(P0, P1, S, Context, M),
        value_last(P1, P)
    ),
    (   is_assumed(P, S, Truth)
    ->  Truth == true
    ;   branch_on(F, P, Context)
    ).

value_last(P0, P) :-
    (   nonvar(P0),
        ( P0 = (Value = F) ; P0 = (Value == F) ),
        atomic(Value),
        compound(F)
    ->  P = (F = Value)
    ;   P = P0
    ).

%!  branch_on(+Fluent, +Condition, +Context)
%
%   Throw the cases in which Condition is to be planned for, as the value of
%   Fluent is open: its values if the domain names them, else that Condition
%   holds, and that it does not. Condition is `none` if Fluent is needed for
%   something else, such as the argument of an action.
%
%   @error domain_error(golog_branch, Condition) if it has variables, or
%          Fluent

branch_on(F, P, Context) :-
    (   cases(F, P, Context, Cases)
    ->  throw('$golog_branch'(Cases))
    ;   P == none
    ->  no_branch(F, 'an action or an effect needs its value', Context)
    ;   no_branch(P, 'it has variables', Context)
    ).

cases(F, _, Context, Cases) :-
    context_module(Context, M),
    (   is_kind(relational, F, M)
    ->  Cases = [F-is(F, true), else-is(F, false)]
    ;   has_clauses(M, sensed_values(_, _)),
        M:sensed_values(F, Sort)
    ->  domain_list(Sort, M, Values),
        findall((F = V)-is(F, V), member(V, Values), Cases)
    ).
cases(F, P, _, [P-Case, else-holds(P, false)]) :-
    P \== none,
    ground(P),
    (   P == F
    ->  Case = is(F, true)
    ;   ( P = (Of = Value) ; P = (Of == Value) ),
        Of == F,
        atomic(Value)
    ->  Case = is(F, Value)
    ;   Case = holds(P, true)
    ).

%   Fluents with a known value are replaced by it.

with_known(T0, T, S, Context, M) :-
    arguments_known(T0, T1, S, Context, M),
    (   callable(T1),
        ground(T1),
        is_kind(fluent, T1, M),
        known_or_declared(T1, S, M)
    ->  catch(value(T1, T, S, Context, M), '$golog_unknown'(_), T = T1)
    ;   T = T1
    ).

arguments_known(T0, T, S, Context, M) :-
    (   compound(T0)
    ->  T0 =.. [Name|As0],
        all_known(As0, As, S, Context, M),
        T =.. [Name|As]
    ;   T = T0
    ).

all_known([], [], _, _, _).
all_known([A0|As0], [A|As], S, Context, M) :-
    with_known(A0, A, S, Context, M),
    all_known(As0, As, S, Context, M).

%   Assumed since the last of its open fluents was sensed

is_assumed(P, s(_, _, Values, _, _), Truth) :-
    ground(P),
    get_assoc('$assumed'(P), Values, v(C, Truth)),
    \+ ( open_since(P, Values, C1),
         C1 > C ).

open_since(P, Values, C) :-
    callable(P),
    (   get_assoc(P, Values, v(C, '$sensed'))
    ;   compound(P),
        arg(_, P, Q),
        open_since(Q, Values, C)
    ).

%!  assumed(+Case, +Situation0, -Situation) is det.
%
%   Case is is(Fluent, Value), or holds(Condition, Truth).

assumed(Case, s(H, C, Values0, Open, Done), s(H, C, Values, Open, Done)) :-
    (   Case = is(F, V)
    ->  put_assoc(F, Values0, v(C, V), Values)
    ;   Case = holds(P, Truth),
        put_assoc('$assumed'(P), Values0, v(C, Truth), Values)
    ).

no_branch(P, Why, Context) :-
    context_module(Context, M),
    located(M, in_program(P), Where),
    format(atom(Text), '~wno plan can branch on ~p, which is still to be \c
                        sensed: ~w. A sensed_values/2 for the fluent would \c
                        help', [Where, P, Why]),
    throw_error(domain_error(golog_branch, P), _, Text).

%!  chosen(?Choices, +Situation, +Context) is nondet.
%
%   Gives each variable of Choices with a domain a value of it, on
%   backtracking each.

chosen([], _, _).
chosen([V-D|Choices], S, Context) :-
    (   D = in(Domain)
    ->  domain_value(V, Domain, S, Context)
    ;   true
    ),
    context_effort(Context, Effort),
    polled(Effort),
    chosen(Choices, S, Context).

%!  domain_value(-Value, +Domain, +Situation, +Context) is nondet.
%
%   Domain is a list, a sort, or a fluent whose value is one of these.

domain_value(Value, Domain0, S, Context) :-
    context_module(Context, M),
    (   is_list(Domain0)
    ->  Domain = Domain0
    ;   callable(Domain0),
        is_kind(fluent, Domain0, M)
    ->  fluent_value(Domain0, Domain, S, Context)
    ;   Domain = Domain0
    ),
    domain_list(Domain, M, Values),
    member(Value, Values).
