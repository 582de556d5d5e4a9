:- module(pddl_validator,
          [ verdict/4,                  % +Domain, +Problem, +Plan, -Verdict
            plan_cost/4                 % +Domain, +Problem, +Plan, -Cost
          ]).
:- use_module(library(lists)).
:- use_module(library(occurs)).
:- use_module(library(pairs)).
:- use_module(library(readutil)).

/** <module> Does a plan solve a problem in PDDL?

It shares nothing with library(ev3dev/pddl): its own reader, and the meaning of
PDDL taken literally, by sets of atoms. An atom is a list, as in the files.
*/

%!  verdict(+Domain, +Problem, +Plan, -Verdict) is det.
%
%   Domain and Problem are files, Plan is a list of terms, the first first.
%   Verdict is `solved`, `unsolved`, or impossible(Action).

verdict(Domain, Problem, Plan, Verdict) :-
    parsed(Domain, [define, _|D]),
    parsed(Problem, [define, _|P]),
    findall(Sub-Super, ( member([':types'|L], D), pairs(L, Ps),
                         member(Sub-Super, Ps) ), Types),
    findall(O-T, ( ( member([':constants'|L], D)
                   ; member([':objects'|L], P) ),
                   pairs(L, Ps), member(O-T, Ps) ), Objects),
    World = world(D, Types, Objects),
    member([':init'|Init], P),
    sort(Init, State),
    run(Plan, State, World, Verdict0),
    (   Verdict0 = state(End)
    ->  member([':goal', Goal], P),
        closed(End, World, Closed),
        ( true(Goal, [], Closed, World) -> Verdict = solved
        ; Verdict = unsolved )
    ;   Verdict = Verdict0
    ),
    !.

run([], State, _, state(State)).
run([Term|Plan], State00, World, Verdict) :-
    closed(State00, World, State0),
    Term =.. [Name|Arguments],
    World = world(D, _, _),
    (   member([':action', Name|Parts], D),
        value(':parameters', Parts, [], List),
        pairs(List, Parameters),
        bound(Parameters, Arguments, World, Bindings),
        value(':precondition', Parts, [and], Pre),
        true(Pre, Bindings, State0, World)
    ->  value(':effect', Parts, [and], Effect),
        findall(A, change(Effect, Bindings, State0, World, add(A)), Adds),
        findall(A, change(Effect, Bindings, State0, World, del(A)), Dels),
        subtract(State00, Dels, State1),
        append(Adds, State1, State2),
        sort(State2, State),
        run(Plan, State, World, Verdict)
    ;   Verdict = impossible(Term)
    ).

%   The state with what is derived. A predicate is complete before another one
%   whose rules mention it; the rest, which mention each other, come together.

closed(State0, World, State) :-
    World = world(D, _, _),
    findall(Name, member([':derived', [Name|_], _], D), Names0),
    sort(Names0, Names),
    completed(Names, World, State0, State).

completed([], _, State, State) :-
    !.
completed(Names, World, State0, State) :-
    World = world(D, _, _),
    (   select(Name, Names, Rest),
        \+ ( member([':derived', [Name|_], Condition], D),
             sub_term(Other, Condition),
             memberchk(Other, Rest) )
    ->  derived([Name], World, State0, State1),
        completed(Rest, World, State1, State)
    ;   derived(Names, World, State0, State)
    ).

derived(Names, World, State0, State) :-
    World = world(D, _, _),
    findall([Name|Arguments],
            ( member([':derived', [Name|List], Condition], D),
              memberchk(Name, Names),
              pairs(List, Parameters),
              bound(Parameters, Arguments, World, Bindings),
              true(Condition, Bindings, State0, World) ),
            New),
    append(New, State0, State1),
    sort(State1, State2),
    ( State2 == State0 -> State = State0
    ; derived(Names, World, State2, State) ).

%!  plan_cost(+Domain, +Problem, +Plan, -Cost) is det.

plan_cost(Domain, Problem, Plan, Cost) :-
    parsed(Domain, [define, _|D]),
    parsed(Problem, [define, _|P]),
    member([':init'|Init], P),
    findall(C, ( member(Term, Plan),
                 Term =.. [Name|Arguments],
                 member([':action', Name|Parts], D),
                 value(':parameters', Parts, [], List),
                 pairs(List, Parameters),
                 pairs_keys(Parameters, Variables),
                 pairs_keys_values(Bindings, Variables, Arguments),
                 value(':effect', Parts, [and], [and|Effects]),
                 member([increase, ['total-cost'], Value], Effects),
                 (   Value = [_|_]
                 ->  put(Value, Bindings, Function),
                     member([=, Function, Number], Init)
                 ;   Number = Value
                 ),
                 atom_number(Number, C) ),
            Cs),
    sum_list(Cs, Cost).

value(Key, [Key, Value|_], _, Value) :- !.
value(Key, [_|Rest], Default, Value) :- !, value(Key, Rest, Default, Value).
value(_, [], Default, Default).

bound([], [], _, []).
bound([V-T|Parameters], [A|Arguments], World, [V-A|Bindings]) :-
    of_type(A, T, World),
    bound(Parameters, Arguments, World, Bindings).

of_type(O, T, world(_, Types, Objects)) :-
    member(O-T0, Objects),
    below(T0, T, Types).

below(T, T, _).
below(_, object, _).
below(T0, T, Types) :-
    member(T0-T1, Types),
    T1 \== T0,
    below(T1, T, Types).

true([and|Es], B, S, W) :- !, forall(member(E, Es), true(E, B, S, W)).
true([or|Es], B, S, W) :- !, member(E, Es), true(E, B, S, W), !.
true([not, E], B, S, W) :- !, \+ true(E, B, S, W).
true([imply, P, Q], B, S, W) :-
    !,
    ( true(P, B, S, W) -> true(Q, B, S, W) ; true ).
true([=, X, Y], B, _, _) :-
    !,
    put([X, Y], B, [A, A]).
true([exists, L, E], B, S, W) :-
    !,
    pairs(L, Ps),
    bound(Ps, _, W, B1),
    append(B1, B, B2),
    true(E, B2, S, W),
    !.
true([forall, L, E], B, S, W) :- !, \+ true([exists, L, [not, E]], B, S, W).
true(Atom0, B, S, _) :-
    put(Atom0, B, Atom),
    memberchk(Atom, S).

change([and|Es], B, S, W, C) :- !, member(E, Es), change(E, B, S, W, C).
change([when, P, E], B, S, W, C) :-
    !,
    true(P, B, S, W),
    change(E, B, S, W, C).
change([forall, L, E], B, S, W, C) :-
    !,
    pairs(L, Ps),
    bound(Ps, _, W, B1),
    append(B1, B, B2),
    change(E, B2, S, W, C).
change([not, A0], B, _, _, del(A)) :- !, put(A0, B, A).
change([increase|_], _, _, _, _) :- !, fail.
change(A0, B, _, _, add(A)) :- put(A0, B, A).

put([], _, []).
put([X0|Xs0], B, [X|Xs]) :-
    ( memberchk(X0-X1, B) -> X = X1 ; X = X0 ),
    put(Xs0, B, Xs).

%   a b - t c: a-t, b-t, c-object

pairs(List, Pairs) :-
    (   append(Names, [-, Type|Rest], List),
        \+ memberchk(-, Names)
    ->  findall(N-Type, member(N, Names), Pairs1),
        pairs(Rest, Pairs2),
        append(Pairs1, Pairs2, Pairs)
    ;   findall(N-object, member(N, List), Pairs)
    ).

parsed(File, Expression) :-
    read_file_to_string(File, Text0, []),
    split_string(Text0, "\n", "", Lines0),
    findall(Line, ( member(Line0, Lines0),
                    split_string(Line0, ";", "", [Line|_]) ), Lines),
    atomic_list_concat(Lines, ' ', Text1),
    spaced(Text1, '(', Text2),
    spaced(Text2, ')', Text3),
    downcase_atom(Text3, Text),
    atomic_list_concat(Words0, ' ', Text),
    findall(W, ( member(W0, Words0), normalize_space(atom(W), W0),
                 W \== '' ), Words),
    one(Words, Expression, []).

spaced(Text0, Bracket, Text) :-
    atomic_list_concat(Parts, Bracket, Text0),
    atomic_list_concat([' ', Bracket, ' '], Between),
    atomic_list_concat(Parts, Between, Text).

one(['('|Words], List, Rest) :- !, many(Words, List, Rest).
one([Word|Rest], Word, Rest).

many([')'|Rest], [], Rest) :- !.
many(Words, [First|List], Rest) :-
    one(Words, First, Words1),
    many(Words1, List, Rest).
