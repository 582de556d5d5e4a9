:- module(ev3dev_golog_progression,
          [ situation/3,                % +History, -Situation, +Context
            done/4,                     % +Entry, +Situation0, -Situation,
                                        % +Context
            entries_done/4              % +Entries, +Situation0, -Situation,
                                        % +Context
          ]).
:- use_module('../basics/fields',
              [fields/1, goal_expansion/2, term_expansion/2]).
:- use_module(library(assoc), [get_assoc/3, put_assoc/4]).
:- use_module(library(lists), [append/3, reverse/2]).
:- use_module(context, [context_mode/2, context_module/2]).
:- use_module(effects, [effect/4]).
:- use_module(possible_effects, [effects_known/5]).
:- use_module(situation, [initial_situation/1]).
:- use_module(theory, [names_fluent/2]).
:- use_module(values, [evaluated_arguments/4]).

:- fields(open(count, fluent, value, condition, base)).

/** <module> The situation after an action

An effect on a fluent with a variable that neither its condition nor the
declaration of the fluent enumerates is kept in Open, with the situation
before it, and is decided by regression when a value is asked. If its
condition compares, and so depends on the situation by values only, these are
put in, and it hides the older effects under the same condition: Open does not
grow with each action.
*/

%!  situation(+History, -Situation, +Context) is det.
%
%   Situation is the one after History, a list, newest first.

situation(History, Situation, Context) :-
    reverse(History, Entries),
    initial_situation(Situation0),
    entries_done(Entries, Situation0, Situation, Context).

%!  done(+Entry, +Situation0, -Situation, +Context) is det.
%
%   Situation is what follows on Situation0 by Entry: an action, a list of
%   actions that several agents do at the same time, or a sensing result
%   e(Fluent, Value) or e(Action, Outcome).

done(Entry, S0, S, Context) :-
    S0 = situation(H, C0, Values0, Open0, Done0),
    C is C0+1,
    effects(Entry, S0, Context, Effects),
    with_effects(Effects, C, S0, Context, Values0, Values, Open0, Open),
    noted_done(Entry, Done0, Done),
    S = situation([Entry|H], C, Values, Open, Done).

%   Of a step of several actions, also each of them

noted_done(Entry, Done0, Done) :-
    (   ground(Entry)
    ->  put_assoc(Entry, Done0, true, Done1),
        (   Entry = [_|_]
        ->  all_noted(Entry, Done1, Done)
        ;   Done = Done1
        )
    ;   Done = Done0
    ).

all_noted([], Done, Done).
all_noted([A|As], Done0, Done) :-
    put_assoc(A, Done0, true, Done1),
    all_noted(As, Done1, Done).

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
    (   Entry = [_|_],
        is_list(Entry)
    ->  step_effects(Entry, S0, Context, Effects)
    ;   context_mode(Context, known)
    ->  context_module(Context, M),
        effects_known(Entry, S0, Context, M, Effects)
    ;   ground(Entry)
    ->  findall(Effect, effect(Entry, S0, Context, Effect), Effects)
    ;   findall(Entry-Effect, effect(Entry, S0, Context, Effect), Pairs),
        of_same(Pairs, Entry, Effects)
    ).

%   Of several actions at the same time

step_effects([], _, _, []).
step_effects([A|As], S0, Context, Effects) :-
    effects(A, S0, Context, Effects1),
    step_effects(As, S0, Context, Effects2),
    append(Effects1, Effects2, Effects).

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

without_hidden([], _F, _P, _Base, _C, []).
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
    O = open(count: C),
    !,
    after_same(Os0, C, New, Os).
after_same(Os, _, New, [New|Os]).
