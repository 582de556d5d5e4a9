:- module(ev3dev_golog_pddl_text,
          [ pddl_parts/2                % +Module, -Parts
          ]).
:- use_module(library(lists), [append/3, member/2]).
:- use_module(library(pairs), [group_pairs_by_key/2]).
:- use_module(ground,
              [ ground_action/4, ground_actions/2, ground_condition/3,
                ground_rules/2, only_relations/1
              ]).
:- use_module(planning_task, [cost/4]).
:- use_module(theory,
              [derived_rule/4, has_clauses/2, located/3, prepare/1]).
:- use_module('../errors/errors', [throw_error/3]).

/** <module> A domain of Golog as PDDL

PDDL knows no rules and no goals of Prolog. So each ground action becomes one
without parameters: ground.pl.
*/

%!  pddl_parts(+Module, -Parts) is det.
%
%   Parts is parts(Objects, Predicates, Rules, Actions, Init, Goal), which are
%   lists as in the text. An action is action(Name, Condition, Effects). There
%   are costs if and only if an effect is [increase|_].
%
%   @error domain_error(pddl_fluent, Fluent) if it has other values than true
%          and false
%   @error domain_error(pddl_condition, Condition), see ground.pl
%   @error domain_error(pddl_name, Term) if two have the same name in PDDL
%   @error existence_error(pddl_goal, Module)

pddl_parts(M, parts(Objects, Predicates, Rules, Actions, Init, Goal)) :-
    prepare(M),
    only_relations(M),
    no_step_rules(M),
    (   M:proc(pddl_goal, Goal0)
    ->  true
    ;   throw_error(existence_error(pddl_goal, M), _,
                    'there is no proc(pddl_goal, Condition)')
    ),
    ground_rules(M, GroundRules),
    findall(F, ( M:rel_fluent(F), ground(F)
               ; member(rule(F, _), GroundRules) ), Fs0),
    sort(Fs0, Fs),
    ground_actions(M, As),
    findall(Argument, ( member(F, Fs), F =.. [_|Arguments],
                        member(Argument, Arguments) ), Arguments0),
    sort(Arguments0, AllArguments),
    distinct_names(AllArguments, Objects),
    distinct_names(As, _),
    distinct_names(Fs, _),
    findall(F, derived(M, F), Derived),
    append(Derived, Fs, AllFs),
    findall(Head, ( member(F, AllFs), head(F, Head, _) ), Predicates0),
    sort(Predicates0, Predicates),
    findall((Stratum-Head)-[and, Condition|Equations],
            ( member(rule(F, E), GroundRules),
              once(derived_rule(Stratum, F, _, M)),
              head(F, Head, Equations),
              text_of(E, Condition0),
              ( Condition0 == true -> Condition = [and]
              ; Condition = Condition0 ) ),
            Cases0),
    keysort(Cases0, Cases),
    group_pairs_by_key(Cases, Groups),
    findall([':derived', Head, [or|Alternatives]],
            member((_-Head)-Alternatives, Groups), Rules),
    findall(Action, ( member(A, As), action(A, M, Action) ), Actions),
    findall(E, ( member(F, Fs),
                 \+ member(rule(F, _), GroundRules),
                 once(M:initially(F, V)), V == true,
                 atom_of(F, E) ), Init),
    condition(Goal0, M, Goal).

no_step_rules(M) :-
    (   member(Rule, [together(_, _), excludes(_, _), always(_)]),
        has_clauses(M, Rule),
        clause(M:Rule, _)
    ->  located(M, clause([Rule]), Where),
        format(atom(Text), '~wPDDL cannot say what agents do in one step',
               [Where]),
        throw_error(domain_error(pddl_condition, Rule), _, Text)
    ;   true
    ).

derived(M, F) :-
    has_clauses(M, pddl_derived(_, _, _)),
    clause(M:pddl_derived(_, F, _), _).
derived(M, F) :-
    has_clauses(M, derived(_, _)),
    clause(M:derived(F, _), _).

%   head(+Atom, -Head, -Equations): Head has a variable for each argument.

head(F, [Name|Vs], Equations) :-
    F =.. [Name0|Arguments],
    name_of(Name0, Name),
    equations(Arguments, 1, Vs, Equations).

equations([], _, [], []).
equations([A0|As], N, [V|Vs], [[=, V, A]|Equations]) :-
    ( var(A0) -> true ; name_of(A0, A) ),
    atom_concat('?x', N, V),
    N1 is N+1,
    equations(As, N1, Vs, Equations).

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

% ---------------- ACTIONS

action(A, M, action(Name, Condition, Effects)) :-
    ground_action(A, M, E, Effects0),
    text_of(E, Condition),
    action_name(A, Name),
    findall(Effect, ( member(Effect0, Effects0), effect(Effect0, Effect)
                    ; has_clauses(M, action_cost(_, _)),
                      cost(true, A, M, Cost),
                      Effect = [increase, ['total-cost'], Cost] ),
            Effects).

effect(effect(Truth, F, E), Effect) :-
    atom_of(F, Atom),
    ( Truth == true -> Change = Atom ; Change = [not, Atom] ),
    text_of(E, If),
    ( If == true -> Effect = Change ; Effect = [when, If, Change] ).

condition(P, M, E) :-
    ground_condition(P, M, E0),
    text_of(E0, E).

text_of(E0, E) :-
    (   memberchk(E0, [true, false])
    ->  E = E0
    ;   E0 = [Word|Es0]
    ->  findall(E1, ( member(E2, Es0), text_of(E2, E1) ), Es),
        E = [Word|Es]
    ;   atom_of(E0, E)
    ).
