:- module(ev3dev_pddl,
          [ pddl_domain/1,              % :File
            pddl_problem/1,             % :File
            pddl_write/1                % :File
          ]).
:- set_prolog_flag(generate_debug_info, false).
:- use_module(private/load/compiled, []).
:- reexport(golog).
:- use_module(library(lists), [append/3, member/2]).
:- use_module(private/files/directory,
              [file_path/2, readable_file/3, write_file/2]).
:- use_module(private/checks/checks, [must_be/2]).
:- use_module(private/errors/errors, [throw_error/3]).
:- use_module(private/errors/public_clauses, [term_expansion/4]).
:- use_module(private/golog/pddl_text, [pddl_parts/2]).
:- use_module(private/golog/s_expressions, [expression/3]).
:- use_module(private/golog/theory, [declare_domain/1]).

/** <module> Domains and problems in PDDL, the language of planners

A domain and a problem in files become facts of library(ev3dev/golog) in the
module that calls. Then they can be planned, run on the robot, and changed:

```
?- pddl_domain('gripper.pddl'), pddl_problem('gripper-4.pddl').
?- do(achieve(pddl_goal), History).
```

Read are STRIPS and ADL with types: negative, disjunctive and quantified
preconditions, equality, conditional and universal effects. Names are in small
letters, as PDDL knows no capital ones. What becomes what:

  - An action `move` with two parameters
    `prim_action(move(A, B))`, its poss/2, causes_true/3 and causes_false/3
  - A predicate that an action changes
    rel_fluent/1
  - Another predicate
    A condition pddl_fact(Atom)
  - An object
    A condition pddl_is(Object, Type), true for all its types
  - `:init`
    initially/2 and pddl_fact/1
  - `:goal`
    proc(pddl_goal, Condition)
*/

:- meta_predicate
    pddl_domain(:),
    pddl_problem(:),
    pddl_write(:).

:- dynamic
    made/3,                             % Module, domain or problem, Ref
    theory/2.                           % Module, Theory

%   A theory is theory(Supers, Predicates): Type-Super, and for each predicate
%   predicate(Name, Types, Kind). Kind is `fluent` if an action changes it,
%   else `static`.

%!  pddl_domain(:File) is det.
%
%   Read the domain in File. What was read before by this predicate and by
%   pddl_problem/1 in this module is forgotten.
%
%   @error existence_error(source_sink, File)
%   @error syntax_error(pddl), with file and line
%   @error domain_error(pddl_requirement, Keyword) if it asks for more than
%          ADL, as for numbers or time

pddl_domain(M:File) :-
    read_define(File, domain, Parts, Path),
    checked_requirements(Parts, Path),
    findall(Type-Super,
            ( typed_part(':types', Parts, Path, Type, Supers),
              member(Super, Supers) ),
            AllSupers),
    findall(Predicate, declared_predicate(Parts, Path, Predicate),
            Predicates),
    Theory = theory(AllSupers, Predicates),
    findall(Clause, domain_clause(Parts, Theory, Path, Clause), Clauses),
    forget(M, problem),
    forget(M, domain),
    retractall(theory(M, _)),
    assertz(theory(M, Theory)),
    make(Clauses, M, domain).

%!  pddl_problem(:File) is det.
%
%   Read the problem in File, after its domain. What another problem made is
%   forgotten.
%
%   @error existence_error(source_sink, File)
%   @error syntax_error(pddl), with file and line
%   @error existence_error(pddl_predicate, Name) if the domain has not what
%          :init or :goal uses
%   @error existence_error(pddl_domain, Module) if no domain was read

pddl_problem(M:File) :-
    read_define(File, problem, Parts, Path),
    (   theory(M, Theory)
    ->  true
    ;   throw_error(existence_error(pddl_domain, M), _,
                    'pddl_domain/1 comes before pddl_problem/1')
    ),
    findall(Clause, problem_clause(Parts, Theory, Path, Clause), Clauses),
    forget(M, problem),
    make(Clauses, M, problem).

%   make(+Clauses, +Module, +Of): nothing is changed before all of a file has
%   been understood.

make(Clauses, M, Of) :-
    declare_domain(M),
    dynamic(( M:pddl_fact/1, M:pddl_is/2 )),
    forall(member(Clause, Clauses),
           ( assertz(M:Clause, Ref),
             assertz(made(M, Of, Ref)) )).

forget(M, Of) :-
    forall(retract(made(M, Of, Ref)), catch(erase(Ref), error(_, _), true)).

problem_clause(Parts, Theory, Path, pddl_is(Object, Type)) :-
    no_names_of_fluents(Parts, Theory, Path),
    object(':objects', Parts, Theory, Path, Object, Type).
problem_clause(Parts, Theory, Path, Clause) :-
    member([':init'|Atoms], Parts),
    member(Atom, Atoms),
    init(Atom, Theory, Path, Kind, Fact),
    (   Kind == fluent
    ->  Clause = initially(Fact, true)
    ;   Clause = pddl_fact(Fact)
    ).
problem_clause(Parts, Theory, _, initially(Fluent, false)) :-
    Theory = theory(_, Predicates),
    member(predicate(Name, Types, fluent), Predicates),
    \+ ( Types == [],
         member([':init'|Atoms], Parts),
         memberchk([Name], Atoms) ),
    length(Types, Arity),
    functor(Fluent, Name, Arity).
problem_clause(Parts, Theory, Path, proc(pddl_goal, Goal)) :-
    (   member([':goal', Goal0], Parts)
    ->  condition(Goal0, [], Theory, Path, Goal)
    ;   wrong(Path, 'there is no :goal')
    ).

%   An object would stand for the value of such a fluent.

no_names_of_fluents(Parts, theory(_, Predicates), Path) :-
    (   member([':objects'|Names], Parts),
        member(Name, Names),
        memberchk(predicate(Name, [], fluent), Predicates)
    ->  format(atom(Why), '~w is an object, and a predicate that changes',
               [Name]),
        wrong(Path, Why)
    ;   true
    ).

% ---------------- FILES

read_define(File, What, Parts, Path) :-
    must_be(nonvar, File),
    (   readable_file(File, pddl, Path)
    ->  true
    ;   throw_error(existence_error(source_sink, File), _, '')
    ),
    setup_call_cleanup(
        open(Path, read, Stream, [encoding(utf8)]),
        expression(Stream, Path, Expression),
        close(Stream)),
    (   Expression = [define, [What, _]|Parts]
    ->  true
    ;   format(atom(Why), 'it does not begin with (define (~w ..', [What]),
        wrong(Path, Why)
    ).

wrong(Path, Why) :-
    format(atom(Text), '~w: ~w', [Path, Why]),
    throw_error(syntax_error(pddl), _, Text).

checked_requirements(Parts, Path) :-
    (   member([':requirements'|Keywords], Parts),
        member(Keyword, Keywords),
        \+ is_known(Keyword)
    ->  format(atom(Text), '~w: only STRIPS and ADL are read', [Path]),
        throw_error(domain_error(pddl_requirement, Keyword), _, Text)
    ;   true
    ).

is_known(Keyword) :-
    memberchk(Keyword,
              [ ':strips', ':typing', ':negative-preconditions',
                ':disjunctive-preconditions', ':equality',
                ':existential-preconditions', ':universal-preconditions',
                ':quantified-preconditions', ':conditional-effects',
                ':adl' ]).

%   typed(+List, -Pairs, +Path) is det: Name-Types for each of a list as
%   `a b - t c - (either t u) d`.

typed(List, Pairs, Path) :-
    typed(List, [], Pairs, Path).

typed([], Names, Pairs, _) :-
    with_types(Names, [object], Pairs).
typed([Item|Items], Names, Pairs, Path) :-
    (   Item == (-)
    ->  (   Items = [Type|Rest],
            types(Type, Types)
        ->  with_types(Names, Types, Pairs1),
            typed(Rest, [], Pairs2, Path),
            append(Pairs1, Pairs2, Pairs)
        ;   wrong(Path, 'a type is missing after -')
        )
    ;   atom(Item)
    ->  append(Names, [Item], Names1),
        typed(Items, Names1, Pairs, Path)
    ;   format(atom(Why), 'a name is expected, not ~p', [Item]),
        wrong(Path, Why)
    ).

types(Type, Types) :-
    (   atom(Type)
    ->  Types = [Type]
    ;   Type = [either|Types]
    ).

with_types([], _, []).
with_types([Name|Names], Types, [Name-Types|Pairs]) :-
    with_types(Names, Types, Pairs).

% ---------------- CLAUSES

domain_clause(Parts, Theory, Path, pddl_is(Object, Type)) :-
    object(':constants', Parts, Theory, Path, Object, Type).
domain_clause(_, theory(_, Predicates), _, (rel_fluent(Fluent) :- Body)) :-
    member(predicate(Name, Types, fluent), Predicates),
    length(Types, Arity),
    functor(Fluent, Name, Arity),
    Fluent =.. [_|Variables],
    all_of_types(Variables, Types, Goals),
    goal_of(Goals, Body).
domain_clause(Parts, Theory, Path, Clause) :-
    member([':action', Name|Items], Parts),
    action_clause(Name, Items, Theory, Path, Clause).

typed_part(Keyword, Parts, Path, Name, Types) :-
    member([Keyword|List], Parts),
    typed(List, Pairs, Path),
    member(Name-Types, Pairs).

%   object(+Keyword, +Parts, +Theory, +Path, -Object, -Type) is nondet: each
%   Object with each of its types.

object(Keyword, Parts, Theory, Path, Object, Type) :-
    typed_part(Keyword, Parts, Path, Object, Types),
    findall(Above, ( member(Type0, Types), is_below(Type0, Above, Theory) ),
            All0),
    sort([object|All0], All),
    member(Type, All).

is_below(Type, Type, _).
is_below(Type0, Type, Theory) :-
    Theory = theory(Supers, _),
    member(Type0-Type1, Supers),
    Type1 \== Type0,
    is_below(Type1, Type, Theory).

declared_predicate(Parts, Path, predicate(Name, Types, Kind)) :-
    member([':predicates'|Predicates], Parts),
    member([Name|Parameters], Predicates),
    typed(Parameters, Pairs, Path),
    findall(Type, member(_-Type, Pairs), Types),
    length(Types, Arity),
    (   changed_predicate(Parts, Name, Arity)
    ->  Kind = fluent
    ;   Kind = static
    ).

changed_predicate(Parts, Name, Arity) :-
    member([':action', _|Items], Parts),
    append(_, [':effect', Effect|_], Items),
    effect_atom(Effect, [Name|Arguments]),
    length(Arguments, Arity).

effect_atom([Word|Rest], Atom) :-
    (   Word == and
    ->  member(Effect, Rest),
        effect_atom(Effect, Atom)
    ;   memberchk(Word, [when, forall])
    ->  Rest = [_, Effect],
        effect_atom(Effect, Atom)
    ;   Word == not
    ->  Rest = [Atom]
    ;   Atom = [Word|Rest]
    ).

all_of_types([], [], []).
all_of_types([V|Vs], [Types|Rest], [Goal|Goals]) :-
    of_types(V, Types, Goal),
    all_of_types(Vs, Rest, Goals).

of_types(V, [Type], pddl_is(V, Type)) :-
    !.
of_types(V, [Type|Types], (pddl_is(V, Type) ; Goal)) :-
    of_types(V, Types, Goal).

goal_of([], true).
goal_of([Goal|Goals], Body) :-
    (   Goals == []
    ->  Body = Goal
    ;   Body = (Goal, Rest),
        goal_of(Goals, Rest)
    ).

% ---------------- ACTIONS

%   action_clause(+Name, +Items, +Theory, +Path, -Clause) is nondet. A static
%   condition comes as soon as its parameters are known.

action_clause(Name, Items, Theory, Path, Clause) :-
    part(':parameters', Items, [], List),
    part(':precondition', Items, [and], Pre0),
    ( Pre0 == [] -> Pre = [and] ; Pre = Pre0 ),
    quantified(List, [], Path, Bound, _, Variables),
    Action =.. [Name|Variables],
    condition(Pre, Bound, Theory, Path, Condition0),
    conjuncts(Condition0, Conjuncts),
    split(Conjuncts, Statics, Others),
    (   typed(List, Parameters, Path),
        findall(Types, member(_-Types, Parameters), AllTypes),
        body(Variables, AllTypes, [], Statics, Goals),
        goal_of(Goals, Body),
        Clause = (prim_action(Action) :- Body)
    ;   conjunction(Others, Condition),
        Clause = poss(Action, Condition)
    ;   part(':effect', Items, [and], Effect),
        effect(Effect, Bound, true, Theory, Path, change(Truth, Fluent, If)),
        (   Truth == true
        ->  Clause = causes_true(Action, Fluent, If)
        ;   Clause = causes_false(Action, Fluent, If)
        )
    ).

part(Keyword, Items, Default, Value) :-
    (   append(_, [Keyword, Value0|_], Items)
    ->  Value = Value0
    ;   Value = Default
    ).

with_variables([], [], []).
with_variables([Name|Names], [Name-V|Bound], [V|Vs]) :-
    with_variables(Names, Bound, Vs).

conjuncts(Condition, Conjuncts) :-
    (   Condition = and(Conjuncts0)
    ->  Conjuncts = Conjuncts0
    ;   Conjuncts = [Condition]
    ).

conjunction(Conjuncts, Condition) :-
    (   Conjuncts == []
    ->  Condition = true
    ;   Conjuncts = [Condition]
    ->  true
    ;   Condition = and(Conjuncts)
    ).

split([], [], []).
split([C|Cs], Statics, Others) :-
    (   C = pddl_fact(_)
    ->  Statics = [C|Statics1],
        Others = Others1
    ;   Statics = Statics1,
        Others = [C|Others1]
    ),
    split(Cs, Statics1, Others1).

body([], [], _, Statics, Statics).
body([V|Vs], [Types|AllTypes], Known0, Statics0, Goals) :-
    of_types(V, Types, Goal),
    Known = [V|Known0],
    now_known(Statics0, Known, Now, Statics),
    body(Vs, AllTypes, Known, Statics, Goals1),
    append([Goal|Now], Goals1, Goals).

now_known([], _, [], []).
now_known([S|Ss], Known, Now, Later) :-
    (   term_variables(S, Vs),
        \+ ( member(V, Vs), \+ ( member(K, Known), K == V ) )
    ->  Now = [S|Now1],
        Later = Later1
    ;   Now = Now1,
        Later = [S|Later1]
    ),
    now_known(Ss, Known, Now1, Later1).

%   effect(+Expression, +Bound, +If, +Theory, +Path, -Change) is nondet.

effect([Word|Rest], Bound, If, T, Path, Change) :-
    (   Word == and
    ->  member(Effect, Rest),
        effect(Effect, Bound, If, T, Path, Change)
    ;   Word == when
    ->  Rest = [P0, Effect],
        condition(P0, Bound, T, Path, P),
        both(If, P, If1),
        effect(Effect, Bound, If1, T, Path, Change)
    ;   Word == forall
    ->  Rest = [List, Effect],
        quantified(List, Bound, Path, Bound1, Goals, _),
        conjunction(Goals, OfTypes),
        both(If, OfTypes, If1),
        effect(Effect, Bound1, If1, T, Path, Change)
    ;   Word == not
    ->  Rest = [Atom],
        atom_term(Atom, Bound, T, Path, _, Fluent),
        Change = change(false, Fluent, If)
    ;   atom_term([Word|Rest], Bound, T, Path, _, Fluent),
        Change = change(true, Fluent, If)
    ).

both(P, Q, R) :-
    (   P == true
    ->  R = Q
    ;   Q == true
    ->  R = P
    ;   conjuncts(P, Ps),
        conjuncts(Q, Qs),
        append(Ps, Qs, Rs),
        R = and(Rs)
    ).

% ---------------- CONDITIONS

%   condition(+Expression, +Bound, +Theory, +Path, -Condition) is det. Bound
%   has a Prolog variable for each parameter.

condition(E, Bound, T, Path, P) :-
    (   E = [Word|Rest],
        condition(Word, Rest, Bound, T, Path, P0)
    ->  P = P0
    ;   format(atom(Why), 'a condition is expected, not ~p', [E]),
        wrong(Path, Why)
    ).

condition(and, Es, Bound, T, Path, P) :-
    !,
    all_conditions(Es, Bound, T, Path, Ps0),
    flat(Ps0, Ps),
    conjunction(Ps, P).
condition(or, Es, Bound, T, Path, or(Ps)) :-
    !,
    all_conditions(Es, Bound, T, Path, Ps).
condition(not, [E], Bound, T, Path, neg(P)) :-
    !,
    condition(E, Bound, T, Path, P).
condition(imply, [E, F], Bound, T, Path, impl(P, Q)) :-
    !,
    condition(E, Bound, T, Path, P),
    condition(F, Bound, T, Path, Q).
condition(exists, [List, E], Bound, T, Path, some(Vs, and(Ps))) :-
    !,
    quantified(List, Bound, Path, Bound1, Goals, Vs),
    condition(E, Bound1, T, Path, P),
    append(Goals, [P], Ps).
condition(forall, [List, E], Bound, T, Path, neg(some(Vs, and(Ps)))) :-
    !,
    quantified(List, Bound, Path, Bound1, Goals, Vs),
    condition(E, Bound1, T, Path, P),
    append(Goals, [neg(P)], Ps).
condition(=, [A0, B0], Bound, _, Path, A = B) :-
    !,
    argument(A0, Bound, Path, A),
    argument(B0, Bound, Path, B).
condition(Name, Arguments, Bound, T, Path, P) :-
    atom_term([Name|Arguments], Bound, T, Path, Kind, Atom),
    (   Kind == fluent
    ->  P = Atom
    ;   P = pddl_fact(Atom)
    ).

all_conditions([], _, _, _, []).
all_conditions([E|Es], Bound, T, Path, [P|Ps]) :-
    condition(E, Bound, T, Path, P),
    all_conditions(Es, Bound, T, Path, Ps).

flat([], []).
flat([P|Ps], Flat) :-
    (   P == true
    ->  First = []
    ;   conjuncts(P, First)
    ),
    flat(Ps, Rest),
    append(First, Rest, Flat).

quantified(List, Bound, Path, Bound1, Goals, Vs) :-
    typed(List, Pairs, Path),
    findall(Name, member(Name-_, Pairs), Names),
    findall(Types, member(_-Types, Pairs), AllTypes),
    with_variables(Names, New, Vs),
    all_of_types(Vs, AllTypes, Goals),
    append(New, Bound, Bound1).

atom_term([Name|Arguments0], Bound, T, Path, Kind, Atom) :-
    all_arguments(Arguments0, Bound, Path, Arguments),
    Atom =.. [Name|Arguments],
    (   T = theory(_, Predicates),
        member(predicate(Name, Types, Kind0), Predicates),
        same_length(Types, Arguments)
    ->  Kind = Kind0
    ;   length(Arguments, Arity),
        format(atom(Text), '~w: the domain has no predicate ~w with ~d \c
                            arguments', [Path, Name, Arity]),
        throw_error(existence_error(pddl_predicate, Name), _, Text)
    ).

same_length([], []).
same_length([_|Xs], [_|Ys]) :-
    same_length(Xs, Ys).

all_arguments([], _, _, []).
all_arguments([A0|As0], Bound, Path, [A|As]) :-
    argument(A0, Bound, Path, A),
    all_arguments(As0, Bound, Path, As).

argument(A0, Bound, Path, A) :-
    (   atom(A0),
        sub_atom(A0, 0, 1, _, ?)
    ->  (   member(Name-V, Bound),
            Name == A0
        ->  A = V
        ;   format(atom(Why), 'the variable ~w is no parameter', [A0]),
            wrong(Path, Why)
        )
    ;   atom(A0)
    ->  A = A0
    ;   format(atom(Why), 'an object is expected, not ~p', [A0]),
        wrong(Path, Why)
    ).

%   What is not mentioned in :init is false.

init([not|_], _T, _Path, _Kind, _Fact) :-
    !,
    fail.
init(Atom, T, Path, Kind, Fact) :-
    (   Atom = [_|_]
    ->  atom_term(Atom, [], T, Path, Kind, Fact)
    ;   format(atom(Why), 'a fact is expected, not ~p', [Atom]),
        wrong(Path, Why)
    ).

% ---------------- WRITING

%!  pddl_write(:File) is det.
%
%   Write the domain of this module to File, and its initial situation with
%   the goal of `proc(pddl_goal, Condition)` to the file whose name has
%   `-problem` more, before its extension. Any planner of ADL can read them:
%   each ground action becomes an action without parameters, as prim_action/1
%   may be rules. The domain has only relational fluents, which rel_fluent/1
%   enumerates; conditions about them, and any goals of Prolog about what does
%   not change. Sensing actions are left out.
%
%   @error domain_error(pddl_fluent, Fluent) if it has other values than true
%          and false
%   @error domain_error(pddl_condition, Condition) if it cannot be said in
%          PDDL, as done(Action)
%   @error domain_error(pddl_name, Term) if two actions, fluents or objects
%          have the same name in PDDL
%   @error existence_error(pddl_goal, Module)
%   @error the errors of open/4

pddl_write(M:File0) :-
    file_path(File0, File),
    declare_domain(M),
    pddl_parts(M, parts(Objects, Predicates, Actions, Init, Goal)),
    file_name_extension(Base, Extension, File),
    atom_concat(Base, '-problem', ProblemBase),
    file_name_extension(ProblemBase, Extension, ProblemFile),
    file_base_name(Base, Name0),
    downcase_atom(Name0, Name),
    write_file(File, domain_text(Name, Objects, Predicates, Actions)),
    write_file(ProblemFile, problem_text(Name, Init, Goal)).

domain_text(Name, Objects, Predicates, Actions, Stream) :-
    format(Stream, '(define (domain ~w)~n  (:requirements :adl)~n', [Name]),
    part_text(Stream, ':constants', Objects),
    part_text(Stream, ':predicates', Predicates),
    forall(member(action(Action, Condition, Effects), Actions),
           ( format(Stream, '  (:action ~w~n    :parameters ()', [Action]),
             format(Stream, '~n    :precondition ', []),
             condition_text(Condition, Stream),
             format(Stream, '~n    :effect ', []),
             expression_text([and|Effects], Stream),
             format(Stream, ')~n', []) )),
    format(Stream, ')~n', []).

problem_text(Name, Init, Goal, Stream) :-
    format(Stream, '(define (problem ~w-problem)~n  (:domain ~w)~n',
           [Name, Name]),
    part_text(Stream, ':init', Init),
    format(Stream, '  (:goal ', []),
    condition_text(Goal, Stream),
    format(Stream, '))~n', []).

part_text(Stream, Keyword, Items) :-
    format(Stream, '  (~w', [Keyword]),
    forall(member(Item, Items),
           ( format(Stream, '~n    ', []), expression_text(Item, Stream) )),
    format(Stream, ')~n', []).

condition_text(Condition, Stream) :-
    (   Condition == true
    ->  expression_text([and], Stream)
    ;   Condition == false
    ->  expression_text([or], Stream)
    ;   expression_text(Condition, Stream)
    ).

expression_text(E, Stream) :-
    (   E = [First|Rest]
    ->  format(Stream, '(', []),
        expression_text(First, Stream),
        forall(member(Item, Rest),
               ( format(Stream, ' ', []), expression_text(Item, Stream) )),
        format(Stream, ')', [])
    ;   format(Stream, '~w', [E])
    ).
