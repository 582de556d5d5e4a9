:- module(naive_layers,
          [ layered_program/2,          % +Seed, -Case
            naive_table/3               % +Case, +Times, -Table
          ]).
:- use_module(simulation).
:- use_module(library(ev3dev/layers), [op(_, _, _)]).
:- use_module(library(apply)).
:- use_module(library(lists)).
:- use_module(library(random)).

/** <module> Layered programs, and what they mean

A second interpreter of the rules of library(ev3dev/layers), the simplest one
that can be: a value is looked for in all moments back to the first, and all
rules are asked for each. It says nothing about why, and checks nothing.

A case is case(Rules, Count, Senses): rules of a random program, how many
moments there are, counted from 0, and sense(Moment, Sense, Value) for what is
perceived. A program may contradict itself, but no fluent depends on itself at
one moment: the body of one may ask the value of lower ones only.
*/

% ---------------- PROGRAMS

%!  layered_program(+Seed, -Case)

layered_program(Seed, case(Rules, Count, Senses)) :-
    set_random(seed(Seed)),
    random_between(8, 20, Count),
    findall(sense(Moment, Sense, Value),
            ( between(0, Count, Moment),
              member(Sense, [s(1), s(2), s(3)]),
              perceived(Value) ),
            Senses),
    findall(Rule,
            ( member(N, [0, 1, 2, 3, 4]),
              random_member(Several, [1, 1, 1, 2]),
              between(1, Several, _),
              rule(N, Rule) ),
            Rules0),
    findall(Rule, ( member(N, [0, 1, 2]), relation(N, Rule) ), Relations),
    findall(Rule, ( member(Port, [outB, outC]), set_rule(Port, Rule) ), Sets),
    append([Rules0, Relations, Sets], Rules1),
    random_permutation(Rules1, Rules).

perceived(Value) :-
    random_between(0, 5, Value),
    Value =\= 5.                        % then it shows nothing

rule(N, (assign(Fluent, Value) <- Body)) :-
    random_between(1, 3, Count),
    body(Count, N, Xs, Body0),
    (   N =:= 4                         % a fluent with an argument
    ->  ( Xs = [X|_] -> true ; X = 0 ),
        Fluent = seen(X)
    ;   Fluent = f(N)
    ),
    random_between(0, 4, Constant),
    (   Xs = [Y|_],
        maybe(0.3)
    ->  Body = (Body0, Value is (Y + Constant) mod 5)
    ;   Value = Constant,
        Body = Body0
    ).

relation(N, (Head <- Body)) :-
    random_between(1, 2, Count),
    body(Count, 5, Xs, Body),
    ( Xs = [X|_] -> true ; X = 1 ),
    Head =.. [p, N, X].

set_rule(Port, (set(Port, Speed) <- Body)) :-
    random_between(0, 3, N),
    random_member(Port-Body-Speed,
                  [ Port-val(f(N), Speed)-Speed,
                    Port-(p(1, X), Speed is 2*X)-Speed,
                    Port-sense(s(1), Speed)-Speed,
                    Port-( val(f(1), X) -> Speed = X ; Speed = 9 )-Speed ]).

%   body(+Count, +N, -Xs, -Body): Xs are variables that Body binds. It asks
%   relations only if it is not that of one: N is 5 there.

body(1, N, Xs, Body) :-
    !,
    part(N, Xs, Body).
body(Count, N, Xs, (Part, Body)) :-
    part(N, Xs1, Part),
    Less is Count - 1,
    body(Less, N, Xs2, Body),
    append(Xs1, Xs2, Xs).

part(N, Xs, Part) :-
    findall(Kind,
            (   member(Kind, [sense, sense, was, was, since, no_was, less,
                              either, if, unless])
            ;   N > 0, N < 5, member(Kind, [val, val])
            ;   N < 5, member(Kind, [ask, no_ask])
            ),
            Kinds),
    random_member(Kind, Kinds),
    random_between(0, 4, C),
    random_between(1, 3, S),
    random_between(0, 3, F),
    Lower is max(0, min(N, 4) - 1),
    random_between(0, Lower, L),
    kind(Kind, s(S), C, f(F), f(L), Xs, Part).

kind(sense, S, _, _, _, [X], sense(S, X)).
kind(less, S, C, _, _, [X], ( sense(S, X), X =< C )).
kind(was, _, _, F, _, [X], was(F, X, _)).
kind(since, _, C, F, _, [],
     ( was(F, _, Then), sense(time, Now), Now - Then < 0.06*C )).
kind(no_was, _, C, F, _, [], \+ was(F, C, _)).
kind(either, S, C, F, _, [X], ( sense(S, X) ; was(F, X, _), X > C )).
kind(if, S, C, F, _, [X], ( sense(S, C) -> X = C ; was(F, X, _) )).
kind(unless, S, C, F, _, [X], ( was(F, X, _), \+ ( sense(S, Y), Y > X+C ) )).
kind(val, _, _, _, L, [X], val(L, X)).
kind(ask, _, C, _, _, [X], p(R, X)) :-
    R is C mod 3.
kind(no_ask, S, C, _, _, [X], ( sense(S, X), \+ p(R, X) )) :-
    R is C mod 3.

% ---------------- THEIR MEANING

:- dynamic
    rule_of/2,                          % Head, Body
    perceived_at/3,                     % Moment, Sense, Value
    time_of/2,                          % Moment, Time
    assigned/3.                         % Moment, Fluent, Values

%!  naive_table(+Case, +Times, -Table)
%
%   Times are those of the moments. Table has for each moment
%   at(Moment, Values, Sets), the Fluent-Value and the Port-Speed of it, up to
%   the first moment at which rules contradict each other: contradiction(Moment).

naive_table(case(Rules, _, Senses), Times, Table) :-
    retractall(rule_of(_, _)),
    retractall(perceived_at(_, _, _)),
    retractall(time_of(_, _)),
    retractall(assigned(_, _, _)),
    forall(member((Head <- Body), Rules), assertz(rule_of(Head, Body))),
    forall(member(sense(Moment, Sense, Value), Senses),
           assertz(perceived_at(Moment, Sense, Value))),
    forall(nth0(Moment, Times, Time), assertz(time_of(Moment, Time))),
    length(Times, Count),
    table(0, Count, Table).

table(Count, Count, []) :- !.
table(Moment, Count, [Row|Rows]) :-
    fluents(Moment, Fluents),
    findall(Fluent-Value,
            ( member(Fluent, Fluents), holds(val(Fluent, Value), Moment) ),
            Values),
    findall(Port-Speed,
            ( rule_of(set(Port, Speed), Body), holds(Body, Moment) ),
            Sets0),
    sort(Sets0, Sets),
    (   (   member(Fluent, Fluents),
            values(Fluent, Moment, [_, _|_])
        ;   member(Port-A, Sets),
            member(Port-B, Sets),
            A \== B
        )
    ->  Row = contradiction(Moment),
        Rows = []
    ;   Row = at(Moment, Values, Sets),
        Next is Moment + 1,
        table(Next, Count, Rows)
    ).

%   All that have been assigned until Moment.

fluents(Moment, Fluents) :-
    findall(Fluent,
            ( between(0, Moment, Then),
              rule_of(assign(Fluent, _), Body),
              holds(Body, Then) ),
            Fluents0),
    sort(Fluents0, Fluents).

holds(true, _).
holds((A, B), Moment) :- holds(A, Moment), holds(B, Moment).
holds((If -> Then ; Else), Moment) :-
    !,
    ( holds(If, Moment) -> holds(Then, Moment) ; holds(Else, Moment) ).
holds((A ; B), Moment) :- ( holds(A, Moment) ; holds(B, Moment) ).
holds(\+ A, Moment) :- \+ holds(A, Moment).
holds(sense(time, Time), Moment) :- !, time_of(Moment, Time).
holds(sense(Sense, Value), Moment) :- perceived_at(Moment, Sense, Value).
holds(val(Fluent, Value), Moment) :-
    values(Fluent, Moment, Values),
    (   Values = [Value0|_]
    ->  Value = Value0
    ;   holds(was(Fluent, Value, _), Moment)
    ).
holds(was(Fluent, Value, Since), Moment) :-
    Last is Moment - 1,
    last_assigned(Last, Fluent, Then),
    values(Fluent, Then, [Value|_]),
    time_of(Then, Since).
holds(p(R, X), Moment) :- rule_of(p(R, X), Body), holds(Body, Moment).
holds(Goal, _) :-
    member(Goal, [_ is _, _ = _, _ < _, _ =< _, _ > _]),
    call(Goal).

last_assigned(Moment, Fluent, Then) :-
    Moment >= 0,
    (   values(Fluent, Moment, [_|_])
    ->  Then = Moment
    ;   Before is Moment - 1,
        last_assigned(Before, Fluent, Then)
    ).

%   The values that Moment assigns; kept, as each asks those before.

values(Fluent, Moment, Values) :-
    (   assigned(Moment, Fluent, Values0)
    ->  true
    ;   findall(Value,
                ( rule_of(assign(Fluent, Value), Body), holds(Body, Moment) ),
                Found),
        sort(Found, Values0),
        assertz(assigned(Moment, Fluent, Values0))
    ),
    Values = Values0.
