:- module(ev3dev_golog_theory,
          [ declare_domain/1,           % +Module
            vocabulary/1,               % ?PredicateIndicator
            prepare/1,                  % +Module
            has_possible_values/1,      % +Module
            possible_of/2,              % +Values, -Value
            has_clauses/2,              % +Module, +Head
            is_kind/3,                  % +Kind, +Term, +Module
            names_of/3,                 % +Kind, +Module, -PredicateIndicator
            names_fluent/2,             % +Term, +Module
            is_fluent/2,                % +Term, +Module
            is_exogenous/2,             % +Action, +Module
            is_sensing_action/2,        % +Action, +Module
            rules_out/2,                % +Action, +Module
            is_set_by_exogenous/2,      % +Fluent, +Module
            program_in/4,               % +Module0, +Program0, -Module,
                                        % -Program
            restored/3,                 % +Condition, -Body, +Module
            has_situations/1,           % +Module
            has_agents/1,               % +Module
            has_step_rules/1,           % +Module
            derived_rule/4,             % ?Stratum, ?Fluent, -Condition,
                                        % +Module
            precondition/3,             % +Action, -Condition, +Module
            located_precondition/4,     % +Action, -Condition, -Place, +Module
            proc_body/3,                % +Call, -Body, +Module
            initial_value/3,            % +Fluent, -Value, +Module
            located/3,                  % +Module, +What, -Place
            proc_place/4,               % +Proc, +Term, +Module, -Place
            domain_list/3               % +Sort, +Module, -Values
          ]).
:- use_module(library(lists), [append/3, member/2, select/4]).
:- use_module(programs, [has_binder/1, renamed/2]).
:- use_module('../errors/error_texts', [clause_place/2, place_first/2]).
:- use_module('../errors/errors', [throw_error/3]).

/** <module> The domain: what a program's module says about its world

A domain is a set of facts and clauses in the module of the program. They are
called there, never copied. For speed, prepare/1 notes which functors are
fluents, actions and procedures.
*/

%   Notes on a module, kept by each thread for itself.

:- thread_local
    noted/4,                            % Kind, Name, Arity, Module
    noted_any/2,                        % Kind, Module
    with_binder/3,                      % Name, Arity, Module
    prepared/2,                         % Module, Signature
    uncertain/1,                        % Module
    stratum/4,                          % Name, Arity, Module, Stratum
    kept_initial/4,                     % Hash, Module, Fluent, Value
    kept_place/4.                       % Proc, Functor, Module, Place

%!  vocabulary(?PI) is nondet.
%
%   PI is the indicator of a predicate that a domain may define.

vocabulary(prim_action/1).
vocabulary(exog_action/1).
vocabulary(prim_fluent/1).
vocabulary(rel_fluent/1).
vocabulary(fun_fluent/1).
vocabulary(action_cost/2).
vocabulary(poss/2).
vocabulary(initially/2).
vocabulary(causes_val/4).
vocabulary(causes_true/3).
vocabulary(causes_false/3).
vocabulary(senses/2).
vocabulary(senses/5).
vocabulary(sensed_values/2).
vocabulary(forget/2).
vocabulary(cache/1).
vocabulary(proc/2).
vocabulary(rule/3).
vocabulary(execute/2).
vocabulary(execute/3).
vocabulary(how_to_execute/3).
vocabulary(translate_exog/2).
vocabulary(translate_sensing/3).
vocabulary(translateExogAction/2).
vocabulary(translateSensing/3).
vocabulary(exog_occurs/1).
vocabulary(initialize/0).
vocabulary(finalize/0).
vocabulary(actionNum/2).
vocabulary(controller/1).
vocabulary(robot_action/2).
vocabulary(robot_sense/3).
vocabulary(robot_exog/2).
vocabulary(progress_params/3).
vocabulary(roll_parameters/3).
vocabulary(simulator/2).
vocabulary(server_port/1).
vocabulary(em_address/2).
vocabulary(load_device/3).
vocabulary(load_devices/1).
vocabulary(senses/1).
vocabulary(causes/4).
vocabulary(settles/5).
vocabulary(rejects/5).
vocabulary(primitive_action/1).
vocabulary(restoreSitArg/3).
vocabulary(restore_situation/3).
vocabulary(agent/1).
vocabulary(agent_of/2).
vocabulary(together/2).
vocabulary(excludes/2).
vocabulary(always/1).
vocabulary(derived/2).
vocabulary(robot_action/3).

%   What a domain of library(ev3dev/golog_classic) has, too. Its situation is
%   a fluent. It is printed as S.

with_situations(( prim_action(A) :- primitive_action(A) )).
with_situations(prim_fluent('$VAR'('S'))).
with_situations(initially('$VAR'('S'), s0)).
with_situations(causes_val(A, '$VAR'('S'), do(A, S), S = '$VAR'('S'))).

%!  declare_domain(+Module) is det.
%
%   Declare in Module what a domain may define dynamic and multifile, unless
%   it is defined there already: a domain may leave out what it does not need,
%   and its clauses may stand in any order and in several files.

declare_domain(Module) :-
    forall(vocabulary(PI), declare(Module, PI)),
    (   predicate_property(Module:situation_history(_, _),
                           imported_from(ev3dev_golog_classic)),
        \+ Module:prim_fluent('$VAR'('S'))
    ->  forall(with_situations(Clause), assertz(Module:Clause))
    ;   true
    ).

declare(Module, Name/Arity) :-
    catch(( dynamic(Module:Name/Arity),
            multifile(Module:Name/Arity) ),
          error(permission_error(_, _, _), _), true).

%   A module without a domain of its own has that of `user`.

declare_missing(Module) :-
    (   vocabulary(Name/Arity),
        functor(Head, Name, Arity),
        \+ predicate_property(Module:Head, dynamic),
        \+ has_own(Module, Head),
        declare(Module, Name/Arity),
        fail
    ;   true
    ).

%   Prolog itself may have one, as rule/3.

has_own(Module, Head) :-
    predicate_property(Module:Head, number_of_clauses(_)),
    \+ predicate_property(Module:Head, built_in).

%!  has_clauses(+Module, +Head) is semidet.
%
%   True if Module defines the predicate of Head by at least one clause, or
%   natively.

has_clauses(Module, Head) :-
    (   predicate_property(Module:Head, number_of_clauses(Count))
    ->  Count > 0
    ;   predicate_property(Module:Head, foreign)
    ).

%!  prepare(+Module) is det.
%
%   Note the functors of the domain in Module, unless the notes are up to
%   date.

prepare(Module) :-
    retractall(kept_initial(_, Module, _, _)),
    (   prepared(Module, _)
    ->  true
    ;   declare_missing(Module)
    ),
    signature(Module, Signature),
    (   prepared(Module, Old),
        Old == Signature
    ->  true
    ;   retractall(noted(_, _, _, Module)),
        retractall(noted_any(_, Module)),
        retractall(with_binder(_, _, Module)),
        retractall(kept_place(_, _, Module, _)),
        retractall(prepared(Module, _)),
        retractall(uncertain(Module)),
        retractall(stratum(_, _, Module, _)),
        forall(kind(Kind, Head, Term),
               note_heads(Module, Kind, Head, Term)),
        conditions_checked(Module),
        note_binders(Module),
        note_possible_values(Module),
        forall(checked(Module), true),
        note_strata(Module),
        assertz(prepared(Module, Signature))
    ).

%   A clause with this Head is about a Kind, Term. A change of a signed one is
%   noticed.

kind(Kind, Head, Term) :-
    signed(Kind, Head, Term).
kind(relational, rel_fluent(F), F).
kind(derived, pddl_derived(_, F, _), F).    % comes with actions
kind(derived, derived(F, _), F).
kind(proc, holds(P, _), P).         % the domain's own
kind(held, holds(P, _), P).

signed(fluent, prim_fluent(F), F).
signed(fluent, rel_fluent(F), F).
signed(fluent, fun_fluent(F), F).
signed(action, prim_action(A), A).
signed(exogenous, exog_action(A), A).
signed(precondition, poss(A, _), A).
signed(initial, initially(F, _), F).
signed(sensed, senses(_, F), F).
signed(sensed, senses(_, _, F, _, _), F).
signed(proc, proc(P, _), P).
signed(proc, restoreSitArg(P, _, _), P).
signed(proc, restore_situation(P, _, _), P).
signed(uncertain, settles(_, _, F, _, _), F).
signed(uncertain, rejects(_, _, F, _, _), F).
signed(uncertain, causes(_, F, _, _), F).
signed(uncertain, senses(A), A).
signed(agents, agent(R), R).
signed(agent_of, agent_of(A, _), A).
signed(step_rule, together(A, _), A).
signed(step_rule, excludes(A, _), A).
signed(step_rule, always(P), P).
signed(derivation, derived(F, _), F).
signed(effect, causes_val(_, F, _, _), F).
signed(effect, causes_true(_, F, _), F).
signed(effect, causes_false(_, F, _), F).

signature(Module, Signature) :-
    findall(Sign,
            ( signed(_, Head, _), sign(Module, Head, Sign) ),
            Signature).

sign(Module, Head, Count-Generation) :-
    (   predicate_property(Module:Head, number_of_clauses(Count))
    ->  true
    ;   Count = 0
    ),
    (   Property =.. [last_modified_generation, Generation],
        % SWI-Prolog 7.2.3 has no such property.
        catch(predicate_property(Module:Head, Property), _, fail)
    ->  true
    ;   Generation = 0
    ).

note_heads(Module, Kind, Head, Term) :-
    (   has_clauses(Module, Head),
        \+ predicate_property(Module:Head, imported_from(ev3dev_golog)),
        catch(clause(Module:Head, Body), _, fail),
        Body \== fail,
        note(Term, Kind, Module),
        fail
    ;   true
    ).

note(Term, Kind, Module) :-
    (   var(Term)
    ->  ( noted_any(Kind, Module) -> true
        ; assertz(noted_any(Kind, Module)) )
    ;   functor(Term, Name, Arity),
        (   noted(Kind, Name, Arity, Module)
        ->  true
        ;   assertz(noted(Kind, Name, Arity, Module))
        )
    ).

note_binders(Module) :-
    (   has_clauses(Module, proc(_, _)),
        catch(clause(Module:proc(Call, Body), Goal), _, fail),
        nonvar(Call),
        functor(Call, Name, Arity),
        \+ with_binder(Name, Arity, Module),
        ( var(Body), Goal \== true ; has_binder(Body) ),
        assertz(with_binder(Name, Arity, Module)),
        fail
    ;   true
    ).

%!  is_kind(+Kind, +Term, +Module) is semidet.
%
%   True if a clause of the domain is about a Kind with the name and number of
%   arguments of Term. Kind is one of `fluent`, `relational`, `action`,
%   `exogenous`, `derived`, `precondition`, `initial`, `sensed`, `proc`,
%   `uncertain`. A clause whose head is a variable is asked.

is_kind(Kind, Term, Module) :-
    (   compound(Term)
    ->  compound_name_arity(Term, Name, Arity), % functor/3 refuses go()
        Arity \== 0
    ;   functor(Term, Name, Arity)
    ),
    (   noted(Kind, Name, Arity, Module)
    ->  true
    ;   noted_any(Kind, Module)
    ->  functor(Template, Name, Arity),
        \+ \+ asked(Kind, Template, Module)
    ;   fail
    ).

asked(Kind, Template, Module) :-
    kind(Kind, Head, Template),
    Module:Head.

%!  names_of(+Kind, +Module, -PI) is nondet.
%
%   PI is Name/Arity of a Kind that a clause of the domain names.

names_of(Kind, Module, Name/Arity) :-
    noted(Kind, Name, Arity, Module).
names_of(action, Module, Name/Arity) :-
    noted_any(action, Module),
    has_clauses(Module, primitive_action(_)),
    clause(Module:primitive_action(A), _),
    nonvar(A),
    functor(A, Name, Arity).

%!  names_fluent(+Term, +Module) is semidet.
%
%   True if Term, or a part of it, has the form of a fluent.

names_fluent(Term, M) :-
    callable(Term),
    (   is_kind(fluent, Term, M)
    ->  true
    ;   compound(Term),
        arg(_, Term, Argument),
        names_fluent(Argument, M)
    ->  true
    ).

%!  is_fluent(?Term, +Module) is nondet.
%
%   True if the domain declares Term a fluent. A Term with variables is
%   instantiated to each fluent, if the declaration has them.

is_fluent(Term, Module) :-
    (   ground(Term)
    ->  declared_fluent(Term, Module),
        !
    ;   declared_fluent(Term, Module)
    ).

declared_fluent(Term, Module) :-
    Module:prim_fluent(Term).
declared_fluent(Term, Module) :-
    Module:rel_fluent(Term).
declared_fluent(Term, Module) :-
    Module:fun_fluent(Term).

%!  is_exogenous(+Action, +Module) is semidet.

is_exogenous(Action, Module) :-
    nonvar(Action),
    is_kind(exogenous, Action, Module),
    \+ \+ Module:exog_action(Action).

%!  is_sensing_action(+Action, +Module) is semidet.

is_sensing_action(Action, Module) :-
    has_clauses(Module, senses(_, _)),
    \+ \+ Module:senses(Action, _),
    !.
is_sensing_action(Action, Module) :-
    has_clauses(Module, senses(_, _, _Fluent, _, _)),
    \+ \+ Module:senses(Action, _, _Of, _, _),
    !.
is_sensing_action(Action, Module) :-
    has_possible_values(Module),
    rules_out(Action, Module).

%!  rules_out(+Action, +Module) is semidet.
%
%   What Action senses settles or rejects possible values.

rules_out(Action, Module) :-
    (   Module:senses(Action)
    ;   Module:settles(Action, _, _Fluent, _, _)
    ;   Module:rejects(Action, _, _Fluent, _, _)
    ),
    !.

%!  is_set_by_exogenous(+Fluent, +Module) is semidet.
%
%   True if an exogenous action may give Fluent a value.

is_set_by_exogenous(Fluent, Module) :-
    functor(Fluent, Name, Arity),
    functor(F, Name, Arity),
    member(Head, [ causes_val(A, F, _, _), causes_true(A, F, _),
                   causes_false(A, F, _) ]),
    has_clauses(Module, Head),
    clause(Module:Head, _),
    ( var(A) ; is_kind(exogenous, A, Module) ),
    !.

%!  proc_body(+Call, -Body, +Module) is nondet.
%
%   Body is what a clause of proc/2 says for Call. The variables that
%   constructs of Body bind are renamed, so that a value in Call is never
%   taken for one of them.

proc_body(Call, Body, Module) :-
    functor(Call, Name, Arity),
    (   with_binder(Name, Arity, Module)
    ->  functor(Head, Name, Arity),
        clause(Module:proc(Head, Body0), Goal),
        (   nonvar(Body0),
            Goal == true
        ->  renamed(Head-Body0, Head1-Body1),
            Head1 = Call,
            Body = Body1
        ;   Head = Call,
            call(Module:Goal),
            renamed(Body0, Body)
        )
    ;   call(Module:proc(Call, Body))
    ).
proc_body(Call, Body, Module) :-
    restored(Call, Body, Module).

%!  restored(+Condition, -Body, +Module) is nondet.
%
%   In a domain with situations, Condition stands for Body.

restored(P, Body, M) :-
    (   M:restoreSitArg(P, '$VAR'('S'), Body)
    ;   M:restore_situation(P, '$VAR'('S'), Body)
    ;   is_kind(held, P, M),
        Body = holds(P, '$VAR'('S'))
    ).

%!  program_in(+Module0, +Program0, -Module, -Program) is det.
%
%   Program0, in Module0, is Program of the domain in Module: in A : B the
%   atom A is a module if there is one, and Module0 has no A.

program_in(M0, E0, M, E) :-
    (   nonvar(E0),
        E0 = A:B,
        atom(A),
        current_predicate(_, A:_),
        \+ ( prepare(M0),
             ( is_kind(action, A, M0) ; is_kind(proc, A, M0) ) )
    ->  program_in(A, B, M, E)
    ;   M = M0,
        E = E0
    ).

%!  has_situations(+Module) is semidet.
%
%   True in a domain of library(ev3dev/golog_classic).

has_situations(M) :-
    noted(fluent, '$VAR', 1, M).

%!  has_agents(+Module) is semidet.
%!  has_step_rules(+Module) is semidet.
%
%   True if the domain names agents; if it says which actions need or exclude
%   others in the same step, or what holds after each step.

has_agents(M) :-
    has_noted(agents, M).

has_step_rules(M) :-
    has_noted(step_rule, M).

has_noted(Kind, M) :-
    (   noted(Kind, _, _, M)
    ->  true
    ;   noted_any(Kind, M)
    ).

%!  derived_rule(?Stratum, ?Fluent, -Condition, +Module) is nondet.
%
%   Fluent holds if Condition does. The absence of a fluent is asked for in
%   higher strata only.

derived_rule(Stratum, F, Condition, M) :-
    has_clauses(M, pddl_derived(_, _, _)),
    M:pddl_derived(Stratum, F, Condition).
derived_rule(Stratum, F, Condition, M) :-
    has_clauses(M, derived(_, _)),
    M:derived(F, Condition),
    (   ground(F)
    ->  true
    ;   is_fluent(F, M)
    *-> true
    ;   true
    ),
    functor(F, Name, Arity),
    stratum(Name, Arity, M, Stratum0),
    Stratum = Stratum0.

%   The strata of the derived fluents by their functors: that of a fluent is
%   as high as those that its conditions ask for, and higher than those whose
%   absence they ask for.

note_strata(M) :-
    findall(Head-Uses, derivation(M, Head, Uses), Derivations),
    length(Derivations, Most),
    findall(Head-0, member(Head-_, Derivations), Strata0),
    sort(Strata0, Strata1),
    strata(Strata1, Derivations, Most, Strata, M),
    forall(member(Name/Arity-Stratum, Strata),
           assertz(stratum(Name, Arity, M, Stratum))).

derivation(M, Name/Arity, Uses) :-
    has_clauses(M, derived(_, _)),
    clause(M:derived(F, Condition), _),
    functor(F, Name, Arity),
    findall(Use, used(Condition, positive, [], M, Use), Uses0),
    sort(Uses0, Uses).

strata(Strata0, Derivations, Most, Strata, M) :-
    (   member(Head-Uses, Derivations),
        memberchk(Head-Stratum0, Strata0),
        member(Sign-Used, Uses),
        memberchk(Used-Stratum1, Strata0),
        (   Sign == positive
        ->  Least = Stratum1
        ;   Least is Stratum1+1
        ),
        Least > Stratum0
    ->  (   Least > Most
        ->  Head = Name/Arity,
            functor(F, Name, Arity),
            located(M, derived(F), Where),
            format(atom(Text), '~wit depends on its own absence', [Where]),
            throw_error(domain_error(golog_derived, Head), _, Text)
        ;   true
        ),
        once(select(Head-Stratum0, Strata0, Head-Least, Strata1)),
        strata(Strata1, Derivations, Most, Strata, M)
    ;   Strata = Strata0
    ).

%   used(+Condition, +Sign, +Procedures, +Module, -Use) is nondet: Condition
%   asks for a derived fluent: Use is positive-Functor or negative-Functor.

used(P, Sign, Procs, M, Use) :-
    callable(P),
    functor(P, Name, Arity),
    (   is_kind(derived, P, M)
    ->  Use = Sign-(Name/Arity)
    ;   is_kind(proc, P, M)
    ->  \+ memberchk(Name/Arity-Sign, Procs),
        functor(General, Name, Arity),
        clause(M:proc(General, Body), _),
        used(Body, Sign, [Name/Arity-Sign|Procs], M, Use)
    ;   P = all(_, _)
    ->  negative_too(P, Procs, M, Use)
    ;   P = all(_, _, _)
    ->  negative_too(P, Procs, M, Use)
    ;   memberchk(Name/Arity,
                  [ neg/1, not/1, (\+)/1, impl/2, equiv/2, (-)/1, (=>)/2,
                    (<=>)/2, (->)/2 ])
    ->  negative_too(P, Procs, M, Use)
    ;   compound(P),
        arg(_, P, Q),
        used(Q, Sign, Procs, M, Use)
    ).

%   What is not simply asked for counts as asked for by its absence.

negative_too(P, Procs, M, Use) :-
    arg(_, P, Q),
    used(Q, negative, Procs, M, Use).

%!  precondition(+Action, -Condition, +Module) is nondet.
%!  located_precondition(+Action, -Condition, -Place, +Module) is nondet.
%
%   A clause of poss/2 says that Action is possible if Condition holds. Place
%   is File:Line of it, or `none`.

precondition(A, Condition, M) :-
    (   has_situations(M)
    ->  Condition = poss(A, '$VAR'('S'))
    ;   M:poss(A, Condition)
    ).

located_precondition(A, Condition, Place, M) :-
    has_clauses(M, poss(_, _)),
    (   has_situations(M)
    ->  clause(M:poss(A, '$VAR'('S')), Condition, Ref)
    ;   clause(M:poss(A, Condition), Body, Ref),
        call(M:Body)
    ),
    clause_place(Ref, Place).

%   checked(+Module) is nondet: step_checks.pl adds what must be right.

:- multifile checked/1.

%   The second argument of poss/2 is neither free nor a situation.

conditions_checked(M) :-
    (   \+ has_situations(M),
        has_clauses(M, poss(_, _)),
        catch(clause(M:poss(A, Condition), Body, Ref), _, fail),
        var(Condition),
        ( Body == true ; is_situation(Condition, Body, M) )
    ->  clause_place(Ref, Place),
        place_first(Place, Where),
        short(poss(A), Short),
        format(atom(Text), '~w~p: the second argument is a condition, as in \c
                            poss(Action, true), and not a situation. \c
                            library(ev3dev/golog_classic) runs programs \c
                            with situations', [Where, Short]),
        throw_error(instantiation_error, _, Text)
    ;   true
    ).

is_situation(S, Body, M) :-
    compound(Body),
    (   Body =.. [Name|Arguments],
        append(_, [Last], Arguments),
        Last == S,
        functor(Body, Name, Arity),
        functor(Head, Name, Arity),
        has_clauses(M, Head),
        arg(Arity, Head, Term),
        catch(clause(M:Head, _), _, fail),
        nonvar(Term),
        memberchk(Term, [s0, do(_, _)])
    ;   arg(_, Body, Goal),
        is_situation(S, Goal, M)
    ),
    !.

%!  initial_value(+Fluent, -Value, +Module) is semidet.
%
%   Value is the first that initially/2 answers for a ground Fluent; in a
%   domain with possible values all, as possible_of/2 has them. What it
%   answered is kept until prepare/1.

initial_value(Fluent, Value, Module) :-
    term_hash(Fluent, Hash),
    (   kept_initial(Hash, Module, Fluent, Kept)
    ->  Kept = value(Value)
    ;   initial_values(Fluent, Value0, Module)
    ->  assertz(kept_initial(Hash, Module, Fluent, value(Value0))),
        Value = Value0
    ;   assertz(kept_initial(Hash, Module, Fluent, none)),
        fail
    ).

initial_values(Fluent, Value, Module) :-
    (   uncertain(Module)
    ->  findall(V, Module:initially(Fluent, V), Values),
        possible_of(Values, Value)
    ;   Module:initially(Fluent, Value)
    ).

%!  possible_of(+Values, -Value) is semidet.
%
%   Value is the only one of Values, else '$possible'(Set). Fails if there are
%   none.

possible_of(Values, Value) :-
    sort(Values, Set),
    (   Set = [Value0]
    ->  Value = Value0
    ;   Set = [_|_],
        Value = '$possible'(Set)
    ).

%!  has_possible_values(+Module) is semidet.
%
%   True if fluents of the domain may have several possible values: it says
%   what settles or rejects one, or gives a fluent two initial values.

has_possible_values(Module) :-
    uncertain(Module).

note_possible_values(Module) :-
    (   noted(uncertain, _, _, Module)
    ->  assertz(uncertain(Module))
    ;   noted_any(uncertain, Module)
    ->  assertz(uncertain(Module))
    ;   findall(F-V,
                ( has_clauses(Module, initially(_, _)),
                  clause(Module:initially(F, V), true),
                  ground(F) ),
                Pairs0),
        sort(Pairs0, Pairs),
        append(_, [F1-_, F2-_|_], Pairs),
        F1 == F2
    ->  assertz(uncertain(Module))
    ;   true
    ).

%!  domain_list(+Sort, +Module, -Values) is det.
%
%   Values are those of Sort: a list, or the name of a unary predicate that
%   answers one list or enumerates values.

domain_list(Sort, Module, Values) :-
    (   is_list(Sort)
    ->  Values = Sort
    ;   callable(Sort)
    ->  catch(findall(Answer, call(Module:Sort, Answer), Answers),
              error(existence_error(procedure, PI), Context),
              no_sort(PI, Context, Sort, Module)),
        (   Answers = [List],
            is_list(List)
        ->  Values = List
        ;   Values = Answers
        )
    ;   located(Module, in_program([Sort]), Where),
        format(atom(Text), '~wa sort is a list, or the name of a predicate \c
                            with one argument, and not ~q', [Where, Sort]),
        throw_error(domain_error(golog_sort, Sort), _, Text)
    ).

no_sort(PI, Context, Sort, Module) :-
    (   strip_module(PI, _, Name/Arity),
        functor(Sort, Name, Arity0),
        Arity is Arity0+1
    ->  located(Module, in_program([Sort]), Where),
        format(atom(Text), '~wthere is no sort ~q: a list, or a predicate \c
                            ~q', [Where, Sort, Name/Arity]),
        throw_error(existence_error(golog_condition, Name/Arity), _, Text)
    ;   throw(error(existence_error(procedure, PI), Context))
    ).

%!  located(+Module, +What, -Text) is det.
%
%   Text is `File:Line: Clause: ` for the first clause of the domain that
%   What is about, else empty. What is
%
%     - in_program(Terms)
%       the first proc/2 in whose body the first of Terms stands, else the
%       first clause with a condition in which it does; or so for another of
%       Terms
%     - open(Kind)
%       the only proc/2 that has a variable without a value in the place of a
%       Kind, `program` or `condition`
%     - proc(Call)
%     - action(Action)
%     - fluent(Fluent)
%     - derived(Fluent)
%     - precondition(Action, Condition)
%       the poss/2, or the rule for steps, that says so; else a poss/2 of
%       Action, else its declaration
%     - executes(Action)
%       what says how to execute Action, else its declaration
%     - clause(Heads)
%       the first clause with one of Heads

located(Module, What, Text) :-
    (   about(What, Module, Head, Ref)
    ->  clause_place(Ref, Place),
        place_first(Place, Where),
        short(Head, Short),
        format(atom(Text), '~w~q: ', [Where, Short])
    ;   Text = ''
    ).

about(in_program(Terms), Module, Head, Ref) :-
    member(Term, Terms),
    says(Head, Said),
    has_clauses(Module, Head),
    clause(Module:Head, _, Ref),
    \+ \+ stands_in(Term, Said),
    !.
about(open(Kind), Module, proc(Call, _), Ref) :-
    has_clauses(Module, proc(_, _)),
    findall(Call-Ref,
            ( clause(Module:proc(Call, Body), true, Ref),
              \+ \+ ( numbervars(Call, 0, _),
                      is_open(Kind, Body) ) ),
            [Call-Ref]).
about(proc(Call), Module, proc(Call, _), Ref) :-
    has_clauses(Module, proc(_, _)),
    clause(Module:proc(Call, _), _, Ref),
    !.
about(action(Action), Module, Head, Ref) :-
    clause_about(Action, [prim_action(Term)], Term, Module, Head, Ref).
about(fluent(Fluent), Module, Head, Ref) :-
    clause_about(Fluent, [ prim_fluent(Term), rel_fluent(Term),
                           fun_fluent(Term) ], Term, Module, Head, Ref).
about(derived(Fluent), Module, Head, Ref) :-
    clause_about(Fluent, [derived(Term, _)], Term, Module, Head, Ref).
about(precondition(Action, Condition), Module, Head, Ref) :-
    (   has_situations(Module)
    ->  Head = poss(Action, '$VAR'('S')),
        clause(Module:Head, _, Ref)
    ;   rule_for_steps(Condition, Heads),
        about(clause(Heads), Module, Head, Ref)
    ->  true
    ;   about(clause([poss(Action, Condition)]), Module, Head, Ref)
    ->  true
    ;   clause_about(Action, [poss(Term, _)], Term, Module, Head, Ref)
    ->  true
    ;   about(action(Action), Module, Head, Ref)
    ),
    !.
about(executes(Action), Module, Head, Ref) :-
    (   about(clause([robot_sense(Action, _, _), robot_action(Action, _)]),
              Module, Head, Ref)
    ->  true
    ;   about(action(Action), Module, Head, Ref)
    ).
about(clause(Heads), Module, Head, Ref) :-
    member(Head, Heads),
    has_clauses(Module, Head),
    clause(Module:Head, _, Ref),
    !.

%   Condition may be a rule for steps, as in refused/3 of steps.pl.

rule_for_steps(together(A, B), [together(A, B)]).
rule_for_steps(excludes(A, B), [excludes(A, B), excludes(B, A)]).
rule_for_steps(always(P), [always(P)]).
rule_for_steps(one_at_a_time(Agent, _, _), [agent(Agent)]).
rule_for_steps(one_value(_, A, _), [prim_action(A)]).
rule_for_steps(agent_of(A), [prim_action(A)]).
rule_for_steps(senses(A), [senses(A, _), senses(A, _, _Fluent, _, _)]).

%   says(?Head, ?Said): Said is the program or the condition in a clause.

says(proc(_, Said), Said).
says(poss(_, Said), Said).
says(causes_val(_, _, _, Said), Said).
says(causes_true(_, _, Said), Said).
says(causes_false(_, _, Said), Said).
says(causes(_, _, _, Said), Said).
says(senses(_, _, _Fluent, _, Said), Said).
says(settles(_, _, _Fluent, _, Said), Said).
says(rejects(_, _, _Fluent, _, Said), Said).
says(derived(_, Said), Said).
says(always(Said), Said).

is_open(Kind, Body) :-
    (   place_for(Kind, Body, Part),
        var(Part)
    ->  true
    ;   compound(Body),
        arg(_, Body, Part),
        nonvar(Part),
        is_open(Kind, Part)
    ->  true
    ).

place_for(condition, ?(P), P).
place_for(condition, if(P, _, _), P).
place_for(condition, while(P, _), P).
place_for(condition, interrupt(P, _), P).
place_for(program, [E|_], E).
place_for(program, if(_, E, _), E).
place_for(program, if(_, _, E), E).
place_for(program, while(_, E), E).
place_for(program, interrupt(_, E), E).

clause_about(About, Heads, Term, Module, Head, Ref) :-
    functor(About, Name, Arity),
    member(Head, Heads),
    has_clauses(Module, Head),
    clause(Module:Head, _, Ref),
    ( var(Term) ; functor(Term, Name, Arity) ),
    !.

stands_in(Term, Body) :-
    nonvar(Body),
    (   Term = Body
    ->  true
    ;   compound(Body),
        arg(_, Body, Argument),
        stands_in(Term, Argument)
    ).

short(Head, Short) :-
    Head =.. [Name, Term|_],
    (   var(Term)
    ->  functor(Head, _, Arity),
        Short = Name/Arity
    ;   compound(Term)
    ->  functor(Term, TermName, Arity),
        Short =.. [Name, TermName/Arity]
    ;   Short =.. [Name, Term]
    ).

%!  proc_place(+Proc, +Term, +Module, -Place) is det.
%
%   Place is File:Line of the first clause of Proc, Name/Arity, in whose body
%   something stands with the functor of Term; else of its first clause; else
%   `none`. It is looked up once.

proc_place(Proc, Term, Module, Place) :-
    functor(Term, Name, Arity),
    (   kept_place(Proc, Name/Arity, Module, Place0)
    ->  true
    ;   functor(General, Name, Arity),
        Proc = ProcName/ProcArity,
        functor(Call, ProcName, ProcArity),
        findall(Body-Ref, clause(Module:proc(Call, Body), _, Ref), Clauses),
        (   (   member(Body-Ref, Clauses),
                stands_in(General, Body)
            ;   member(_-Ref, Clauses)
            )
        ->  clause_place(Ref, Place0)
        ;   Place0 = none
        ),
        assertz(kept_place(Proc, Name/Arity, Module, Place0))
    ),
    Place = Place0.
