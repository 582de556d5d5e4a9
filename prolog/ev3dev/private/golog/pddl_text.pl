:- module(ev3dev_golog_pddl_text,
          [ pddl_parts/2                % +Module, -Parts
          ]).
:- use_module(library(lists), [append/3, member/2]).
:- use_module(programs, [fresh/4]).
:- use_module(theory,
              [domain_list/3, has_clauses/2, is_sensing_action/2]).
:- use_module('../errors', [throw_error/3]).

/** <module> A domain of Golog as PDDL

PDDL knows no rules and no goals of Prolog. So each ground action becomes one
without parameters, and what does not depend on fluents is decided here: of a
condition remains what has to be tested.
*/

%!  pddl_parts(+Module, -Parts) is det.
%
%   Parts is parts(Objects, Predicates, Actions, Init, Goal), in the lists of
%   s_expressions.pl. An action is action(Name, Condition, Effects).
%
%   @error domain_error(pddl_fluent, Fluent) if it has other values than true
%          and false
%   @error domain_error(pddl_name, Term) if two have the same name in PDDL
%   @error existence_error(pddl_goal, Module)

pddl_parts(M, parts(Objects, Predicates, Actions, Init, Goal)) :-
    only_relations(M),
    (   M:proc(pddl_goal, Goal0)
    ->  true
    ;   throw_error(existence_error(pddl_goal, M), _,
                    'there is no proc(pddl_goal, Condition)')
    ),
    findall(F, ( M:rel_fluent(F), ground(F) ), Fs0),
    sort(Fs0, Fs),
    findall(A, ( M:prim_action(A), ground(A), \+ is_sensing_action(A, M) ),
            As0),
    sort(As0, As),
    findall(Argument, ( member(F, Fs), F =.. [_|Arguments],
                        member(Argument, Arguments) ), Arguments0),
    sort(Arguments0, AllArguments),
    distinct_names(AllArguments, Objects),
    distinct_names(As, _),
    distinct_names(Fs, _),
    findall([Name|Vs], ( member(F, Fs), F =.. [Name0|Arguments1],
                         name_of(Name0, Name), variables(Arguments1, 1, Vs) ),
            Predicates0),
    sort(Predicates0, Predicates),
    findall(Action, ( member(A, As), action(A, M, Action) ), Actions),
    findall(E, ( member(F, Fs), once(M:initially(F, V)), V == true,
                 atom_of(F, E) ), Init),
    condition(Goal0, M, Goal).

only_relations(M) :-
    (   member(Head, [prim_fluent(F), fun_fluent(F)]),
        has_clauses(M, Head),
        M:Head
    ->  throw_error(domain_error(pddl_fluent, F), _,
                    'PDDL has true and false only: rel_fluent/1')
    ;   true
    ).

variables([], _, []).
variables([_|As], N, [V|Vs]) :-
    atom_concat('?x', N, V),
    N1 is N+1,
    variables(As, N1, Vs).

%   A name of PDDL has small letters, digits, - and _, and begins with a
%   letter.

name_of(Term, Name) :-
    format(atom(Text0), '~w', [Term]),
    downcase_atom(Text0, Text),
    atom_codes(Text, Codes0),
    named(Codes0, Codes),
    atom_codes(Name0, Codes),
    (   Codes = [C|_],
        code_type(C, alpha),
        C =\= 0'_
    ->  Name = Name0
    ;   atom_concat(n, Name0, Name)
    ).

named([], []).
named([C|Codes0], Named) :-
    (   ( code_type(C, csym), C < 128 ; C =:= 0'- )
    ->  Named = [C|Codes]
    ;   memberchk(C, `() `)
    ->  Named = Codes
    ;   C =:= 0',
    ->  Named = [0'-|Codes]
    ;   Named = [0'_|Codes]
    ),
    named(Codes0, Codes).

action_name(A, Name) :-
    A =.. Parts0,
    findall(Part, ( member(Part0, Parts0), name_of(Part0, Part) ), Parts),
    atomic_list_concat(Parts, -, Name).

distinct_names(Terms, Names) :-
    findall(Name-Term, ( member(Term, Terms), action_name(Term, Name) ),
            Pairs0),
    msort(Pairs0, Pairs),
    (   append(_, [Name-_, Name-Term|_], Pairs)
    ->  format(atom(Text), 'two of them would be called ~w in PDDL', [Name]),
        throw_error(domain_error(pddl_name, Term), _, Text)
    ;   findall(Name, member(Name-_, Pairs), Names)
    ).

atom_of(F, E) :-
    F =.. Parts,
    findall(Name, ( member(Part, Parts), name_of(Part, Name) ), E).

                /*******************************
                *            ACTIONS           *
                *******************************/

action(A, M, action(Name, Condition, Effects)) :-
    findall(R, ( M:poss(A, P), residual(P, M, R) ), Rs),
    any_of(Rs, Condition),
    Condition \== false,
    action_name(A, Name),
    findall(E, effect(A, M, E), Effects).

effect(A, M, E) :-
    (   M:causes_false(A, F, P),
        Truth = false
    ;   M:causes_true(A, F, P),
        Truth = true
    ),
    ( ground(F) -> true ; M:rel_fluent(F) ),
    residual(P, M, R),
    atom_of(F, E0),
    ( Truth == true -> E1 = E0 ; E1 = [not, E0] ),
    ( R == true -> E = E1 ; E = [when, R, E1] ).

                /*******************************
                *           CONDITIONS         *
                *******************************/

condition(P, M, E) :-
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
    ->  condition(Q, M, E1),
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
    ;   \+ \+ M:rel_fluent(P)
    ->  M:rel_fluent(P),
        atom_of(P, E)
    ;   \+ \+ M:proc(P, _)
    ->  M:proc(P, Q),
        residual(Q, M, E)
    ;   call(M:P),
        E = true
    ).

conjunction(and(P, Q), P, Q).
conjunction((P, Q), P, Q).
conjunction(and([]), true, true).
conjunction(and([P|Ps]), P, and(Ps)).
conjunction(equiv(P, Q), impl(P, Q), impl(Q, P)).

disjunction(or(P, Q), [P, Q]).
disjunction((P ; Q), [P, Q]).
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
