:- module(ev3dev_pddl,
          [ pddl_domain/1,              % :File
            pddl_problem/1,             % :File
            pddl_write/1                % :File
          ]).
:- set_prolog_flag(generate_debug_info, false).
:- use_module(private/load/compiled, []).
:- reexport(golog).
:- use_module(library(assoc),
              [ assoc_to_keys/2, empty_assoc/1, gen_assoc/3, get_assoc/3,
                list_to_assoc/2, put_assoc/4
              ]).
:- use_module(library(lists), [append/3, max_list/2, member/2, nth1/4]).
:- use_module(private/basics/fields,
              [fields/1, goal_expansion/2, term_expansion/2]).
:- use_module(private/files/directory, [file_path/2, write_file/2]).
:- use_module(private/checks/checks, [must_be/2]).
:- use_module(private/errors/errors, [throw_error/3]).
:- use_module(private/errors/public_clauses, [term_expansion/4]).
:- use_module(private/golog/pddl_grammar,
              [ distinct/3, fields/4, keywords/3, names/4, not_read/3, part/4,
                read_define/5, shape/3, shaped/5, shown/2, unknown/5
              ]).
:- use_module(private/golog/pddl_text, [pddl_parts/2]).
:- use_module(private/golog/programs,
              [condition_construct/1, construct/1]).
:- use_module(private/golog/s_expressions,
              [place_text/4, wrong/3, wrong/4]).
:- use_module(private/golog/theory, [declare_domain/1]).

/** <module> Domains and problems in PDDL, the language of planners

A domain and a problem in files become facts of library(ev3dev/golog) in the
module that calls. Then they can be planned, run on the robot, and changed:

```
?- pddl_domain('gripper.pddl'), pddl_problem('gripper-4.pddl').
?- do(achieve(pddl_goal), History).
```

The languages are STRIPS and ADL with types: negative, disjunctive and
quantified preconditions, equality, conditional and universal effects; also
derived predicates and costs of actions. A file that uses more, or a name that
is not declared, is an error with file, line and column. Names are in small
letters, as PDDL knows no capital ones. What becomes what:

  - An action `move` with two parameters
    `prim_action(move(A, B))`, its poss/2, causes_true/3 and causes_false/3
  - A predicate that an action changes
    rel_fluent/1
  - A derived predicate
    pddl_derived(Stratum, Atom, Condition)
  - Another predicate
    A condition pddl_fact(Atom)
  - An object
    A condition pddl_is(Object, Type), true for all its types
  - `:init`
    initially/2, pddl_fact/1, and pddl_value(Function, Number)
  - `:goal`
    proc(pddl_goal, Condition)
  - `:metric minimize (total-cost)`
    action_cost(Action, Cost), which `achieve(pddl_goal, [cheapest(true)])`
    counts

A predicate or action with the name of a construct of Golog, such as `done`
with one argument, gets an underscore at its end.
*/

:- meta_predicate
    pddl_domain(:),
    pddl_problem(:),
    pddl_write(:).

:- dynamic
    made/3,                             % Module, domain or problem, Ref
    placed/2,                           % Ref, File:Line
    theory/2.                           % Module, Theory

:- thread_local
    wider/2.                            % Name/Arity of a predicate, Argument

%   Types is an assoc from a type to all that it belongs to, Objects from an
%   object to all its types, Predicates from Name/Arity to predicate(Kind,
%   GologName, ListsOfTypes), Functions from Name/Arity to ListsOfTypes. Kind
%   is `fluent` if an action changes it, `derived`, or `static`.

:- fields(theory(path, name, types, objects, predicates, functions)).

%!  pddl_domain(:File) is det.
%
%   Read the domain in File. What was read before by this predicate and by
%   pddl_problem/1 in this module is forgotten. A predicate that is used for
%   more types than it is declared for is a warning.
%
%   @error existence_error(source_sink, File)
%   @error syntax_error(pddl), with file, line and column, as all others
%   @error domain_error(pddl_keyword, Keyword) if it is not known
%   @error existence_error(Kind, Name) if it is not declared: Kind is
%          `pddl_type`, `pddl_object`, `pddl_predicate` or `pddl_function`

pddl_domain(M:File) :-
    must_be(nonvar, File),
    read_define(File, domain, Name, Parts, Path),
    retractall(wider(_, _)),
    domain_theory(Name, Parts, Path, Theory0),
    findall(Clause, domain_clause(Parts, Theory0, Clause), Clauses1),
    widened(Theory0, Theory),
    findall(Clause, fluent_clause(Theory, _, Clause), Clauses2),
    forget(M, problem),
    forget(M, domain),
    retractall(theory(M, _)),
    assertz(theory(M, Theory)),
    make(Clauses1, M, domain),
    make(Clauses2, M, domain).

%!  pddl_problem(:File) is det.
%
%   Read the problem in File, after its domain. What another problem made is
%   forgotten.
%
%   @error existence_error(pddl_domain, Module) if no domain was read
%   @error as pddl_domain/1

pddl_problem(M:File) :-
    must_be(nonvar, File),
    read_define(File, problem, _, Parts, Path),
    (   theory(M, Theory0)
    ->  true
    ;   throw_error(existence_error(pddl_domain, M), _,
                    'pddl_domain/1 comes before pddl_problem/1')
    ),
    retractall(wider(_, _)),
    problem_theory(Parts, Path, Theory0, Theory1),
    findall(Clause, problem_clause(Parts, Theory1, Clause), Clauses1),
    widened(Theory1, Theory),
    findall(Clause, ( wider(PI, _), fluent_clause(Theory, PI, Clause) ),
            Clauses2),
    forget(M, problem),
    make(Clauses1, M, problem),
    make(Clauses2, M, problem).

%   make(+Clauses, +Module, +Of): nothing is changed before all of a file has
%   been understood.

make(Clauses, M, Of) :-
    declare_domain(M),
    dynamic(( M:pddl_fact/1, M:pddl_is/2, M:pddl_value/2, M:pddl_cost/2 )),
    forall(member(Clause0, Clauses),
           ( ( Clause0 = at(Place, Clause) -> true ; Clause = Clause0 ),
             assertz(M:Clause, Ref),
             assertz(made(M, Of, Ref)),
             ( nonvar(Place) -> assertz(placed(Ref, Place)) ; true ) )).

forget(M, Of) :-
    forall(retract(made(M, Of, Ref)),
           ( retractall(placed(Ref, _)),
             catch(erase(Ref), error(_, _), true) )).

%   Where the clauses of an action are written

:- multifile ev3dev_error_texts:written_at/2.

ev3dev_error_texts:written_at(Ref, Place) :-
    placed(Ref, Place).

% ---------------- DECLARATIONS

domain_theory(Name, Parts, Path, Theory) :-
    all_requirements(Parts, Path),
    types(Parts, Path, Types),
    T = theory(path: Path, types: Types),
    empty_assoc(None),
    objects(':constants', Parts, T, None, Objects),
    findall(declared(PI, Lists, Place),
            declared(':predicates', Parts, T, PI, Lists, Place), Declared),
    findall(PI-Place, member(declared(PI, _, Place), Declared), Places),
    distinct(Places, 'the predicate', Path),
    changed(Parts, Changed),
    findall(N/A, ( part(':derived', Parts, _, [e(_, [e(_, N)|Es])|_]),
                   names(Es, variable, Path, Vs), length(Vs, A) ), Derived),
    findall(PI-predicate(Kind, GologName, Lists),
            ( member(declared(PI, Lists, _), Declared),
              kind(PI, Changed, Derived, Kind),
              golog_name(PI, Kind, GologName) ),
            Predicates0),
    list_to_assoc(Predicates0, Predicates),
    findall(PI-Lists, declared(':functions', Parts, T, PI, Lists, _),
            Functions0),
    sort(Functions0, Functions1),
    list_to_assoc(Functions1, Functions),
    Theory = theory(Path, Name, Types, Objects, Predicates, Functions).

problem_theory(Parts, Path, Theory0, Theory) :-
    Theory0 = theory(_, Name, Types, Constants, Predicates, Functions),
    all_requirements(Parts, Path),
    (   part(':domain', Parts, Place, [E|_]),
        E \= e(_, Name)
    ->  shown(E, Text),
        wrong(Path, Place, 'the problem is of the domain ~w, not of ~w, \c
                            which was read'-[Text, Name])
    ;   true
    ),
    T = theory(path: Path, types: Types),
    objects(':objects', Parts, T, Constants, Objects),
    Theory = theory(Path, Name, Types, Objects, Predicates, Functions).

all_requirements(Parts, Path) :-
    forall(part(':requirements', Parts, _, Items),
           keywords(requirement, Items, Path)).

%   types(+Parts, +Path, -Types): a type that stands only after a - is one,
%   too.

types(Parts, Path, Types) :-
    findall(Name, ( part(':types', Parts, _, Items),
                    names(Items, name, Path, Names),
                    member(Name, Names) ), Declared),
    findall(Sub-Super, ( member(name(Sub, Supers, _), Declared),
                         member(Super, Supers) ), Edges),
    findall(Type, ( Type = object
                  ; member(Sub-Super, Edges),
                    ( Type = Sub ; Type = Super ) ), All0),
    sort(All0, All),
    findall(Type-Above, ( member(Type, All),
                          above([Type, object], Edges, [], Above) ), Pairs),
    list_to_assoc(Pairs, Types),
    (   member(name(Sub, Supers, Place), Declared),
        member(Super, Supers),
        Super \== object,
        Sub \== object,
        get_assoc(Super, Types, Above),
        memberchk(Sub, Above)
    ->  wrong(Path, Place, 'the type ~w is one of itself'-[Sub])
    ;   true
    ).

above([], _, All0, All) :-
    sort(All0, All).
above([Type|Types], Edges, All0, All) :-
    (   memberchk(Type, All0)
    ->  above(Types, Edges, All0, All)
    ;   findall(Super, member(Type-Super, Edges), Supers),
        append(Supers, Types, Types1),
        above(Types1, Edges, [Type|All0], All)
    ).

%   typed(+List, +Kind, +Theory, -Names): as names/4, with known types.

typed(List, Kind, T, Names) :-
    T = theory(path: Path, types: Types),
    names(List, Kind, Path, Names),
    (   member(name(_, Lists, Place), Names),
        member(Type, Lists),
        \+ get_assoc(Type, Types, _)
    ->  assoc_to_keys(Types, Known),
        unknown(pddl_type, Type, Place, Known, Path)
    ;   true
    ).

%   objects(+Keyword, +Parts, +Theory, +Objects0, -Objects)

objects(Keyword, Parts, T, Objects0, Objects) :-
    T = theory(path: Path),
    findall(Name, ( part(Keyword, Parts, _, Items),
                    typed(Items, name, T, Names),
                    member(Name, Names) ), New),
    findall(Name-Place, member(name(Name, _, Place), New), Places),
    distinct(Places, 'the object', Path),
    added(New, T, Objects0, Objects).

added([], _, Objects, Objects).
added([name(Name, Types0, Place)|Names], T, Objects0, Objects) :-
    all_types(Types0, T, Types),
    (   get_assoc(Name, Objects0, Old),
        Old \== Types
    ->  T = theory(path: Path),
        wrong(Path, Place, '~w is a constant of the domain already, and of \c
                            another type'-[Name])
    ;   put_assoc(Name, Objects0, Types, Objects1),
        added(Names, T, Objects1, Objects)
    ).

all_types(Types0, T, All) :-
    T = theory(types: Types),
    findall(Above, ( member(Type, Types0), get_assoc(Type, Types, Aboves),
                     member(Above, Aboves) ), All0),
    sort(All0, All).

%   declared(+Keyword, +Parts, +Theory, -Name/Arity, -Lists, -Place) is
%   nondet. Lists has the types of each argument.

declared(Keyword, Parts, T, Name/Arity, Lists, Place) :-
    T = theory(path: Path),
    part(Keyword, Parts, _, Items),
    names(Items, skeleton, Path, Skeletons),
    member(name([e(_, Name)|Parameters], Of, Place), Skeletons),
    (   Of == [number]
    ->  true
    ;   wrong(Path, Place, 'only numbers are read as values'-[])
    ),
    typed(Parameters, variable, T, Names),
    findall(Types, member(name(_, Types, _), Names), Lists),
    length(Lists, Arity).

changed(Parts, Changed) :-
    findall(Name/Arity,
            ( part(':action', Parts, _, Items),
              append(_, [e(_, ':effect'), Effect|_], Items),
              effect_atom(Effect, [e(_, Name)|Es]),
              length(Es, Arity) ),
            Changed0),
    sort(Changed0, Changed).

effect_atom(e(_, [e(_, Word)|Es]), Atom) :-
    (   memberchk(Word, [and, not])
    ->  member(E, Es),
        effect_atom(E, Atom)
    ;   memberchk(Word, [when, forall])
    ->  append(_, [E], Es),
        effect_atom(E, Atom)
    ;   Atom = [e(_, Word)|Es]
    ).

kind(PI, Changed, Derived, Kind) :-
    (   memberchk(PI, Derived)
    ->  Kind = derived
    ;   memberchk(PI, Changed)
    ->  Kind = fluent
    ;   Kind = static
    ).

golog_name(Name/Arity, Kind, GologName) :-
    functor(Term, Name, Arity),
    (   ( Kind == action, construct(Term)
        ; memberchk(Kind, [fluent, derived]), condition_construct(Term) )
    ->  atom_concat(Name, '_', GologName)
    ;   GologName = Name
    ).

% ---------------- CLAUSES

problem_clause(Parts, T, pddl_is(Object, Type)) :-
    T = theory(path: Path, objects: Objects, predicates: Predicates),
    part(':objects', Parts, _, Items),
    names(Items, name, Path, Names),
    member(name(Object, _, Place), Names),
    (   get_assoc(Object/0, Predicates, predicate(fluent, _, _))
    ->  wrong(Path, Place,
              '~w is an object, and a predicate that changes'-[Object])
    ;   get_assoc(Object, Objects, Types),
        member(Type, Types)
    ).
problem_clause(Parts, T, Clause) :-
    part(':init', Parts, _, Facts),
    member(Fact, Facts),
    init(Fact, Facts, T, Clause).
problem_clause(Parts, T, initially(Fluent, false)) :-
    T = theory(predicates: Predicates),
    gen_assoc(N0/Arity, Predicates, predicate(fluent, Name, _)),
    \+ ( Arity =:= 0,
         part(':init', Parts, _, Facts),
         memberchk(e(_, [e(_, N0)]), Facts) ),
    functor(Fluent, Name, Arity).
problem_clause(Parts, T, Clause) :-
    T = theory(path: Path),
    (   part(':goal', Parts, Place, Items)
    ->  (   Items = [Goal0]
        ->  condition(Goal0, [], T, Goal),
            Place = Line:_,
            Clause = at(Path:Line, proc(pddl_goal, Goal))
        ;   wrong(Path, Place, ':goal has one condition, such as (and ..)'-[])
        )
    ;   wrong(Path, 1:1, 'there is no :goal'-[])
    ).
problem_clause(Parts, T, (action_cost(A, Cost) :- pddl_cost(A, Cost))) :-
    part(':metric', Parts, Place, Items),
    T = theory(path: Path, functions: Functions),
    (   Items = [e(_, minimize), e(_, [e(_, 'total-time')])]
    ->  fail                            % each action takes one step
    ;   Items = [e(_, minimize), e(_, [e(_, 'total-cost')])]
    ->  declared_function('total-cost'/0, Place, Functions, Path, _)
    ;   wrong(Path, Place, 'only (:metric minimize (total-cost)) is read'-[])
    ),
    place_text(Path, Place, 'only achieve(pddl_goal, [cheapest(true)]) \c
                             counts the costs'-[], Note),
    print_message(informational, format('~w', [Note])).

%   init(+Fact, +Facts, +Theory, -Clause) is nondet. What is not mentioned in
%   :init is false.

init(e(Place, Fact), Facts, T, Clause) :-
    T = theory(path: Path, functions: Functions),
    (   Fact = [e(_, =), e(FPlace, [e(_, F)|Es]), e(_, Number)]
    ->  length(Es, Arity),
        declared_function(F/Arity, FPlace, Functions, Path, Lists),
        arguments(Es, Lists, 1, F/Arity, [], T, Arguments),
        (   atom(Number),
            atom_number(Number, Value)
        ->  Term =.. [F|Arguments],
            Clause = pddl_value(Term, Value)
        ;   wrong(Path, Place, 'a number is the value of ~w'-[F])
        )
    ;   Fact = [e(_, at), e(_, Time), e(_, [_|_])],
        atom(Time),
        atom_number(Time, _)
    ->  wrong(Path, Place, 'facts that come later are not read'-[])
    ;   Fact = [e(_, not), Atom]
    ->  atom_term(Atom, [], T, _, _),
        Atom = e(_, Es),
        (   member(e(_, Es1), Facts),
            same(Es1, Es)
        ->  wrong(Path, Place, 'this is true in :init, and false, too'-[])
        ;   fail
        )
    ;   atom_term(e(Place, Fact), [], T, Kind, Atom),
        (   Kind == fluent
        ->  Clause = initially(Atom, true)
        ;   Kind == static
        ->  Clause = pddl_fact(Atom)
        ;   shown(e(Place, Fact), Text),
            wrong(Path, Place, '~w is derived: only :derived makes it \c
                                true'-[Text])
        )
    ).

same(Es1, Es2) :-
    shown(e(_, Es1), Text),
    shown(e(_, Es2), Text).

domain_clause(Parts, T, pddl_is(Object, Type)) :-
    part(':constants', Parts, _, _),
    T = theory(objects: Objects),
    gen_assoc(Object, Objects, Types),
    member(Type, Types).
domain_clause(Parts, T, Clause) :-
    T = theory(path: Path),
    findall(Action, ( part(':action', Parts, Place, Items),
                      begun(Items, Place, Path, Action) ), Actions),
    findall(Name-Place, member(action(Name, Place, _), Actions), Places),
    distinct(Places, 'the action', Path),
    member(action(Name, Place0, Items), Actions),
    fields(action, Items, Path, Fields),
    action_clause(Name, Fields, T, Clause1),
    (   Clause1 = poss(_, _),
        part(':precondition', Fields, Place1, _)
    ->  Place1 = Line:_
    ;   Place0 = Line:_
    ),
    Clause = at(Path:Line, Clause1).
domain_clause(Parts, T, (pddl_derived(Stratum, Atom, Condition) :- Body)) :-
    findall(Rule, ( part(':derived', Parts, Place, Items),
                    rule(Items, Place, T, Rule) ), Rules),
    strata(Rules, T, Strata),
    member(rule(Atom, AllTypes, Condition0, _), Rules),
    functor(Atom, Name, Arity),
    memberchk(Name/Arity-Stratum, Strata),
    Atom =.. [_|Variables],
    bodies(Variables, AllTypes, Condition0, Body, Condition).

fluent_clause(T, PI, (rel_fluent(Fluent) :- Body)) :-
    T = theory(predicates: Predicates),
    gen_assoc(PI, Predicates, predicate(fluent, Name, Lists)),
    PI = _/Arity,
    functor(Fluent, Name, Arity),
    Fluent =.. [_|Variables],
    all_of_types(Variables, Lists, Goals),
    goal_of(Goals, Body).

%   widened(+Theory0, -Theory): arguments that are used for more types than
%   they are declared for are for all.

widened(Theory0, Theory) :-
    Theory0 = theory(Path, Name, Types, Objects, Predicates0, Functions),
    findall(PI-I, wider(PI, I), Wider),
    all_widened(Wider, Predicates0, Predicates),
    Theory = theory(Path, Name, Types, Objects, Predicates, Functions).

all_widened([], Predicates, Predicates).
all_widened([PI-I|Wider], Predicates0, Predicates) :-
    (   get_assoc(PI, Predicates0, predicate(Kind, Name, Lists0))
    ->  nth1(I, Lists0, _, Others),
        nth1(I, Lists, [object], Others),
        put_assoc(PI, Predicates0, predicate(Kind, Name, Lists), Predicates1)
    ;   Predicates1 = Predicates0       % it is a function
    ),
    all_widened(Wider, Predicates1, Predicates).

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

begun(Items, Place, Path, action(Name, NamePlace, Fields)) :-
    (   Items = [e(NamePlace, Name)|Fields],
        names([e(NamePlace, Name)], name, Path, _)
    ->  true
    ;   wrong(Path, Place, 'an action begins with its name'-[])
    ).

%   action_clause(+Name, +Fields, +Theory, -Clause) is nondet.

action_clause(Name0, Fields, T, Clause) :-
    field(':parameters', Fields, e(Place, List)),
    variables(e(Place, List), [], T, Bound, AllTypes, Variables),
    length(Variables, Arity),
    golog_name(Name0/Arity, action, Name),
    Action =.. [Name|Variables],
    field(':precondition', Fields, Pre),
    condition(Pre, Bound, T, Condition0),
    bodies(Variables, AllTypes, Condition0, Body, Condition),
    field(':effect', Fields, Effect),
    findall(Bound-Change, effect(Effect, Bound, true, T, Change), Changes),
    (   Clause = (prim_action(Action) :- Body)
    ;   Clause = poss(Action, Condition)
    ;   member(Bound-change(true, Fluent, If), Changes),
        Clause = causes_true(Action, Fluent, If)
    ;   member(Bound-change(false, Fluent, If), Changes),
        Clause = causes_false(Action, Fluent, If)
    ;   findall(Bound-Cost, member(Bound-cost(Cost), Changes), Costs),
        cost_of(Costs, Bound, 0, Goals, C),
        goal_of(Goals, CostBody),
        Clause = (pddl_cost(Action, C) :- CostBody)
    ).

field(Keyword, Fields, E) :-
    (   part(Keyword, Fields, _, [E0])
    ->  E = E0
    ;   E = e(0:0, [])
    ).

%   cost_of(+Costs, +Bound, +Sum, -Goals, ?Cost): Goals compute Cost.

cost_of([], _, Sum, [Cost is Sum], Cost).
cost_of([Bound-Cost0|Costs], Bound, Sum, Goals, Cost) :-
    (   number(Cost0)
    ->  Goals = Goals1,
        Sum1 = Sum+Cost0
    ;   Goals = [pddl_value(Cost0, Value)|Goals1],
        Sum1 = Sum+Value
    ),
    cost_of(Costs, Bound, Sum1, Goals1, Cost).

%   bodies(+Variables, +AllTypes, +Condition0, -Body, -Condition): Body is of
%   what does not change, each goal as soon as its variables are known.

bodies(Variables, AllTypes, Condition0, Body, Condition) :-
    conjuncts(Condition0, Conjuncts),
    split(Conjuncts, Statics, Others),
    body(Variables, AllTypes, [], Statics, Goals),
    goal_of(Goals, Body),
    conjunction(Others, Condition).

conjuncts(Condition, Conjuncts) :-
    (   Condition = and(Conjuncts0)
    ->  Conjuncts = Conjuncts0
    ;   Condition == true
    ->  Conjuncts = []
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

%   effect(+Expression, +Bound, +If, +Theory, -Change) is nondet: Change is
%   change(Truth, Fluent, If), or cost(Cost).

effect(e(Place, E), Bound, If, T, Change) :-
    T = theory(path: Path),
    (   E == []
    ->  fail
    ;   E = [e(_, Word)|Es],
        shaped(effect, Word, Place, Es, Path)
    ->  effect(Word, Es, Place, Bound, If, T, Change)
    ;   changed_atom(true, e(Place, E), Bound, If, T, Change)
    ).

effect(and, Es, _, Bound, If, T, Change) :-
    member(E, Es),
    effect(E, Bound, If, T, Change).
effect(when, [P0, E], _, Bound, If0, T, Change) :-
    condition(P0, Bound, T, P),
    both(If0, P, If),
    effect(E, Bound, If, T, Change).
effect(forall, [List, E], _, Bound0, If0, T, Change) :-
    variables(List, Bound0, T, Bound, AllTypes, Vs),
    all_of_types(Vs, AllTypes, Goals),
    conjunction(Goals, OfTypes),
    both(If0, OfTypes, If),
    effect(E, Bound, If, T, Change).
effect(not, [E], _, Bound, If, T, Change) :-
    changed_atom(false, E, Bound, If, T, Change).
effect(increase, [e(Place, F), E], _, Bound, If, T, cost(Cost)) :-
    T = theory(path: Path, functions: Functions),
    (   F = [e(_, 'total-cost')]
    ->  declared_function('total-cost'/0, Place, Functions, Path, _)
    ;   not_read(increase, Place, Path)
    ),
    E = e(CostPlace, Value),
    (   If \== true
    ->  wrong(Path, Place, 'a cost under a condition is not read'-[])
    ;   atom(Value),
        atom_number(Value, Cost)
    ->  true
    ;   Value = [e(_, Name)|Es],
        atom(Name),
        \+ memberchk(Name, [+, -, *, /])
    ->  length(Es, Arity),
        declared_function(Name/Arity, CostPlace, Functions, Path, Lists),
        arguments(Es, Lists, 1, Name/Arity, Bound, T, Arguments),
        Cost =.. [Name|Arguments]
    ;   shown(E, Text),
        wrong(Path, CostPlace, 'a cost is a number or a function, not ~w'-
                               [Text])
    ).

changed_atom(Truth, E, Bound, If, T, change(Truth, Fluent, If)) :-
    atom_term(E, Bound, T, Kind, Fluent),
    (   Kind == fluent
    ->  true
    ;   T = theory(path: Path),
        E = e(Place, _),
        shown(E, Text),
        wrong(Path, Place, '~w is derived, so no action changes it'-[Text])
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

% ---------------- DERIVED PREDICATES

%   rule(+Items, +Place, +Theory, -Rule): rule(Atom, AllTypes, Condition,
%   Place)

rule(Items, Place, T, rule(Atom, AllTypes, Condition, Place)) :-
    T = theory(path: Path, predicates: Predicates),
    (   Items = [e(HeadPlace, [e(_, Name)|List]), E]
    ->  variables(e(HeadPlace, List), [], T, Bound, AllTypes, Vs),
        length(Vs, Arity),
        declared_predicate(Name/Arity, HeadPlace, Predicates, Path,
                           predicate(_, GologName, _)),
        Atom =.. [GologName|Vs],
        condition(E, Bound, T, Condition)
    ;   wrong(Path, Place, 'a rule is (:derived (at ?x) CONDITION)'-[])
    ).

%   strata(+Rules, +Theory, -Strata): Name/Arity-Stratum for each head. A
%   predicate whose absence is asked for has a lower stratum.

strata(Rules, T, Strata) :-
    findall(Name/Arity-0, ( member(rule(Head, _, _, _), Rules),
                            functor(Head, Name, Arity) ), Strata0),
    sort(Strata0, Strata1),
    findall(uses(Name/Arity, PI, More),
            ( member(rule(Head, _, Condition, _), Rules),
              functor(Head, Name, Arity),
              used(Condition, 0, PI, More),
              memberchk(PI-_, Strata1) ),
            Uses),
    length(Strata1, Most),
    strata(Strata1, Uses, Most, Rules, T, Strata).

strata(Strata0, Uses, Most, Rules, T, Strata) :-
    findall(PI-Highest,
            ( member(PI-N, Strata0),
              findall(M, ( member(uses(PI, Used, More), Uses),
                           memberchk(Used-M0, Strata0),
                           M is M0+More ), Ms),
              max_list([N|Ms], Highest) ),
            Strata1),
    (   member(Name/Arity-N, Strata1),
        N > Most
    ->  functor(Head, Name, Arity),
        memberchk(rule(Head, _, _, Place), Rules),
        T = theory(path: Path),
        wrong(Path, Place, '~w depends on its own absence'-[Name])
    ;   Strata1 == Strata0
    ->  Strata = Strata0
    ;   strata(Strata1, Uses, Most, Rules, T, Strata)
    ).

%   used(+Condition, +Negated, -PI, -Negated1) is nondet.

used(P, N, PI, M) :-
    (   ( P = and(Ps) ; P = or(Ps) )
    ->  member(Q, Ps),
        used(Q, N, PI, M)
    ;   P = some(_, Q)
    ->  used(Q, N, PI, M)
    ;   ( P = neg(Q) ; P = impl(Q, _) ),
        N1 is 1-N,
        used(Q, N1, PI, M)
    ;   P = impl(_, Q)
    ->  used(Q, N, PI, M)
    ;   P \= neg(_),
        functor(P, Name, Arity),
        PI = Name/Arity,
        M = N
    ).

% ---------------- CONDITIONS

%   condition(+Expression, +Bound, +Theory, -Condition) is det. Bound has
%   bound(Name, Variable, Types) for each parameter.

condition(e(Place, E), Bound, T, P) :-
    T = theory(path: Path),
    (   E == []
    ->  P = true
    ;   E = [e(_, Word)|Es],
        shaped(condition, Word, Place, Es, Path)
    ->  condition(Word, Es, Bound, T, P)
    ;   atom_term(e(Place, E), Bound, T, Kind, Atom),
        ( Kind == static -> P = pddl_fact(Atom) ; P = Atom )
    ).

condition(and, Es, Bound, T, P) :-
    all_conditions(Es, Bound, T, Ps0),
    flat(Ps0, Ps),
    conjunction(Ps, P).
condition(or, Es, Bound, T, or(Ps)) :-
    all_conditions(Es, Bound, T, Ps).
condition(not, [E], Bound, T, neg(P)) :-
    condition(E, Bound, T, P).
condition(imply, [E, F], Bound, T, impl(P, Q)) :-
    condition(E, Bound, T, P),
    condition(F, Bound, T, Q).
condition(exists, [List, E], Bound, T, some(Vs, and(Ps))) :-
    quantified(List, E, Bound, T, Vs, Goals, P),
    append(Goals, [P], Ps).
condition(forall, [List, E], Bound, T, neg(some(Vs, and(Ps)))) :-
    quantified(List, E, Bound, T, Vs, Goals, P),
    append(Goals, [neg(P)], Ps).
condition(=, [E, F], Bound, T, A = B) :-
    (   E = e(Place, [_|_])
    ->  T = theory(path: Path),
        not_read(=, Place, Path)
    ;   term(E, Bound, T, A, _),
        term(F, Bound, T, B, _)
    ).

all_conditions([], _, _, []).
all_conditions([E|Es], Bound, T, [P|Ps]) :-
    condition(E, Bound, T, P),
    all_conditions(Es, Bound, T, Ps).

flat([], []).
flat([P|Ps], Flat) :-
    conjuncts(P, First),
    flat(Ps, Rest),
    append(First, Rest, Flat).

quantified(List, E, Bound0, T, Vs, Goals, P) :-
    variables(List, Bound0, T, Bound, AllTypes, Vs),
    all_of_types(Vs, AllTypes, Goals),
    condition(E, Bound, T, P).

%   variables(+Expression, +Bound0, +Theory, -Bound, -AllTypes, -Variables)

variables(e(Place, List), Bound0, T, Bound, AllTypes, Vs) :-
    T = theory(path: Path),
    (   is_list(List)
    ->  typed(List, variable, T, Names)
    ;   wrong(Path, Place, 'a list such as (?x ?y) is expected, not ~w'-
                           [List])
    ),
    findall(Name-NamePlace, member(name(Name, _, NamePlace), Names), Places),
    distinct(Places, 'the variable', Path),
    bound(Names, Bound0, Bound, AllTypes, Vs).

bound([], Bound, Bound, [], []).
bound([name(Name, Types, _)|Names], Bound0, Bound, [Types|AllTypes],
      [V|Vs]) :-
    bound(Names, [bound(Name, V, Types)|Bound0], Bound, AllTypes, Vs).

%   atom_term(+Expression, +Bound, +Theory, -Kind, -Atom) is det.

atom_term(e(Place, E), Bound, T, Kind, Atom) :-
    T = theory(path: Path, predicates: Predicates),
    (   E = [e(_, Name)|Es],
        atom(Name),
        \+ shape(_, Name, any),
        \+ shape(_, Name, 1)
    ->  length(Es, Arity),
        declared_predicate(Name/Arity, Place, Predicates, Path,
                           predicate(Kind, GologName, Lists)),
        arguments(Es, Lists, 1, Name/Arity, Bound, T, Arguments),
        Atom =.. [GologName|Arguments]
    ;   shown(e(Place, E), Text),
        wrong(Path, Place, 'a fact such as (at ?x) is expected, not ~w'-
                           [Text])
    ).

declared_predicate(PI, Place, Predicates, Path, Predicate) :-
    (   get_assoc(PI, Predicates, Found)
    ->  Predicate = Found
    ;   PI = Name/_,
        not_read(Name, Place, Path),
        not_declared(pddl_predicate, PI, Place, Predicates, Path)
    ).

declared_function(PI, Place, Functions, Path, Lists) :-
    (   get_assoc(PI, Functions, Found)
    ->  Lists = Found
    ;   not_declared(pddl_function, PI, Place, Functions, Path)
    ).

not_declared(Kind, Name/Arity, Place, Assoc, Path) :-
    assoc_to_keys(Assoc, Declared),
    (   member(Name/Count, Declared)
    ->  wrong(Path, Place, 'the number of arguments of ~w is ~d, not ~d'-
                           [Name, Count, Arity],
              existence_error(Kind, Name))
    ;   findall(Other, member(Other/_, Declared), Known),
        unknown(Kind, Name, Place, Known, Path)
    ).

%   arguments(+Expressions, +Lists, +I, +PI, +Bound, +Theory, -Arguments):
%   Lists are the types that the predicate PI is declared for, from argument I
%   on.

arguments([], [], _, _PI, _, _, []).
arguments([E|Es], [Wanted|Lists], I, PI, Bound, T, [A|As]) :-
    term(E, Bound, T, A, Types),
    fitting(Types, Wanted, I, PI, E, T),
    I1 is I+1,
    arguments(Es, Lists, I1, PI, Bound, T, As).

term(e(Place, E), Bound, T, A, Types) :-
    T = theory(path: Path, objects: Objects),
    (   atom(E)
    ->  (   member(bound(E, A0, Types0), Bound)
        ->  A = A0,
            Types = Types0
        ;   get_assoc(E, Objects, Types)
        ->  A = E
        ;   sub_atom(E, 0, 1, _, ?)
        ->  wrong(Path, Place, 'the variable ~w is no parameter'-[E])
        ;   findall(Name, member(bound(Name, _, _), Bound), Names),
            assoc_to_keys(Objects, Keys),
            append(Names, Keys, Known),
            unknown(pddl_object, E, Place, Known, Path)
        )
    ;   shown(e(Place, E), Text),
        wrong(Path, Place, 'an object is expected, not ~w'-[Text])
    ).

%   fitting(+Types, +Wanted, +I, +PI, +Expression, +Theory): an argument that
%   may be of a type that is not declared is a warning; one that cannot be of
%   a declared one is an error.

fitting(Types, Wanted, I, PI, E, T) :-
    (   one_above(Types, Wanted, T)
    ->  true
    ;   T = theory(path: Path),
        E = e(Place, _),
        PI = Name/_,
        findall(Type, ( member(Type, Types),
                        \+ ( member(Other, Types),
                             Other \== Type,
                             one_above([Other], [Type], T) ) ), Own),
        atomic_list_concat(Own, ', ', Has),
        atomic_list_concat(Wanted, ', ', Wants),
        shown(E, Text),
        Why = '~w has the type ~w, but ~w is for ~w'-
              [Text, Has, Name, Wants],
        (   \+ one_above(Wanted, Own, T)
        ->  wrong(Path, Place, Why)
        ;   wider(PI, I)
        ->  true
        ;   assertz(wider(PI, I)),
            place_text(Path, Place, Why, Message),
            print_message(warning, format('~w', [Message]))
        )
    ).

%   One of Types is, or is below, one of Wanted.

one_above(Types, Wanted, T) :-
    T = theory(types: AllTypes),
    member(Type, Types),
    get_assoc(Type, AllTypes, Above),
    member(One, Wanted),
    memberchk(One, Above),
    !.

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
    pddl_parts(M, parts(Objects, Predicates, Rules, Actions, Init, Goal)),
    (   member(action(_, _, Effects), Actions),
        member([increase|_], Effects)
    ->  Functions = [['total-cost']]
    ;   Functions = []
    ),
    file_name_extension(Base, Extension, File),
    atom_concat(Base, '-problem', ProblemBase),
    file_name_extension(ProblemBase, Extension, ProblemFile),
    file_base_name(Base, Name0),
    downcase_atom(Name0, Name),
    write_file(File, domain_text(Name, Objects, Predicates, Functions, Rules,
                                 Actions)),
    write_file(ProblemFile, problem_text(Name, Init, Goal, Functions)).

domain_text(Name, Objects, Predicates, Functions, Rules, Actions, Stream) :-
    format(Stream, '(define (domain ~w)~n  (:requirements :adl', [Name]),
    ( Rules == [] -> true ; write(Stream, ' :derived-predicates') ),
    ( Functions == [] -> true ; write(Stream, ' :action-costs') ),
    format(Stream, ')~n', []),
    part_text(Stream, ':constants', Objects),
    part_text(Stream, ':predicates', Predicates),
    ( Functions == [] -> true ; part_text(Stream, ':functions', Functions) ),
    forall(member(Rule, Rules),
           ( write(Stream, '  '),
             expression_text(Rule, Stream),
             nl(Stream) )),
    forall(member(action(Action, Condition, Effects), Actions),
           ( format(Stream, '  (:action ~w~n    :parameters ()', [Action]),
             format(Stream, '~n    :precondition ', []),
             condition_text(Condition, Stream),
             format(Stream, '~n    :effect ', []),
             expression_text([and|Effects], Stream),
             format(Stream, ')~n', []) )),
    format(Stream, ')~n', []).

problem_text(Name, Init, Goal, Functions, Stream) :-
    format(Stream, '(define (problem ~w-problem)~n  (:domain ~w)~n',
           [Name, Name]),
    part_text(Stream, ':init', Init),
    format(Stream, '  (:goal ', []),
    condition_text(Goal, Stream),
    format(Stream, ')~n', []),
    forall(member(Function, Functions),
           part_text(Stream, ':metric minimize', [Function])),
    format(Stream, ')~n', []).

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
