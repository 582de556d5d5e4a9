:- module(ev3dev_golog_transitions,
          [ step/5,                     % +Program0, +Situation0, -Program,
                                        % -Situation, +Context
            is_final/3,                 % +Program, +Situation, +Context
            run/5,                      % +Program, +Situation0, -Situation,
                                        % +Length, +Context
            made_possible/4,            % +Action, -Condition, +Situation,
                                        % +Context
            is_preempted/4,             % +Program0, +Program, +Situation,
                                        % +Context
            simplified/2,               % +Program0, -Program
            program_shown/2             % +Program0, -Program
          ]).
:- use_module(library(lists),
              [append/3, member/2, nth1/3, select/3]).
:- use_module(library(random), [random_between/3]).
:- use_module(context,
              [ blocked/2, context_module/2, context_option/2, entered/4,
                stepping/2, triggered/3
              ]).
:- use_module(domain,
              [ chosen/3, domain_value/4, done/4, evaluated_arguments/4,
                holds/3, marked/3, situation_count/2, situation_history/2
              ]).
:- use_module(programs,
              [construct/1, fresh/4, mapped/3, weak_construct/1]).
:- use_module(theory,
              [ has_clauses/2, is_exogenous/2, is_kind/3, located/3,
                proc_body/3
              ]).
:- use_module('../errors', [throw_error/3]).

/** <module> The language: which steps a program can take

step/5 is Trans and is_final/3 is Final of the literature: De Giacomo,
Lesperance, Levesque: ConGolog, a concurrent programming language based on the
situation calculus, AI 121 (2000), for the constructs of Golog and ConGolog;
De Giacomo, Lesperance, Levesque, Sardina: IndiGolog (2009) for those of
IndiGolog. if/3 and while/2 make their test and the first step of their body
one step, as there. A condition with free variables has a step for each of its
solutions.
*/

:- multifile
    planned_step/5,
    planned_final/3.

%   planned_step(+Program0, +Situation0, -Program, -Situation, +Context)
%   is nondet.
%   planned_final(+Program, +Situation, +Context) is semidet.
%   Trans and Final of the constructs that look ahead, in search.pl

                /*******************************
                *             FINAL            *
                *******************************/

%!  is_final(+Program, +Situation, +Context) is semidet.
%
%   True if Program may end in Situation.

is_final(E, S, X) :-
    final(E, S, X),
    !.

final(E, S, X) :-
    (   var(E)
    ->  unbound_program
    ;   construct(E)
    ->  final_construct(E, S, X)
    ;   context_module(X, M),
        domain_names(E, M)
    ->  final_named(E, S, X, M)
    ;   weak_construct(E)
    ->  final_weak(E, S, X)
    ;   context_module(X, M),
        unknown_program(E, M)
    ).

final_named(E, S, X, M) :-
    is_kind(proc, E, M),
    proc_body(E, Body, M),
    entered(final, E, X, X1),
    final(Body, S, X1).

final_construct([], _, _).
final_construct([E|Es], S, X) :-
    is_final(E, S, X),
    is_final(Es, S, X).
final_construct(ndet(A, B), S, X) :-
    either_final(A, B, S, X).
final_construct(rndet(A, B), S, X) :-
    either_final(A, B, S, X).
%   As in IndiGolog: either may take the steps, and both must agree to end.
final_construct(wndet(A, B), S, X) :-
    is_final(A, S, X),
    is_final(B, S, X).
final_construct(if(P, A, B), S, X) :-
    (   holds(P, S, X)
    *-> is_final(A, S, X)
    ;   is_final(B, S, X)
    ).
final_construct(while(P, E), S, X) :-
    (   \+ holds(P, S, X)
    ->  true
    ;   holds(P, S, X),
        is_final(E, S, X)
    ).
final_construct(star(_), _, _).
final_construct(star(_, _), _, _).
final_construct(pi(Vs, E), S, X) :-
    final_pick(Vs, E, S, X).
final_construct(pi(V, D, E), S, X) :-
    final_pick((V, D), E, S, X).
final_construct(rpi(Vs, E), S, X) :-
    final_pick(Vs, E, S, X).
final_construct(rpi(V, D, E), S, X) :-
    final_pick((V, D), E, S, X).
final_construct(conc(A, B), S, X) :-
    both_final(A, B, S, X).
final_construct('$turn'(A, B), S, X) :-
    both_final(A, B, S, X).
final_construct(pconc(A, B), S, X) :-
    both_final(A, B, S, X).
final_construct(rconc(A, B), S, X) :-
    both_final(A, B, S, X).
final_construct(rconc(Es), S, X) :-
    all_final(Es, S, X).
final_construct(rrobin(Es), S, X) :-
    all_final(Es, S, X).
final_construct(iconc(_), _, _).
final_construct(interrupt(_, _), _, _).
final_construct(interrupt(_, _, _), _, _).
final_construct(search(E), S, X) :-
    is_final(E, S, X).
final_construct(search(E, _), S, X) :-
    is_final(E, S, X).
final_construct(search(E, _, _), S, X) :-
    is_final(E, S, X).
final_construct(searchn(E, _), S, X) :-
    is_final(E, S, X).
final_construct(searchc(E), S, X) :-
    is_final(E, S, X).
final_construct(searchc(E, _), S, X) :-
    is_final(E, S, X).
final_construct('$path'(E, Path, At, Options), S, X) :-
    planned_final('$path'(E, Path, At, Options), S, X).
final_construct(gexec(C, E), S, X) :-
    (   context_option(assume, X)
    ->  is_final(E, S, X)
    ;   final_guarded(C, E, S, X)
    ).
final_construct(gexec2(C, E), S, X) :-
    final_guarded(C, E, S, X).
final_construct(goal(Success, E, _, _), S, X) :-
    (   holds(Success, S, X)
    ->  true
    ;   is_final(E, S, X)
    ).
final_construct(atomic(E), S, X) :-
    is_final(E, S, X).
final_construct('$atomic'(E), S, X) :-
    is_final(E, S, X).
final_construct(for(V, D, E), S, X) :-
    for_program(V, D, E, S, X, Program),
    is_final(Program, S, X).
final_construct(exogint(E, _), S, X) :-
    is_final(E, S, X).

either_final(A, B, S, X) :-
    (   is_final(A, S, X)
    ->  true
    ;   is_final(B, S, X)
    ).

both_final(A, B, S, X) :-
    is_final(A, S, X),
    is_final(B, S, X).

all_final([], _, _).
all_final([E|Es], S, X) :-
    is_final(E, S, X),
    all_final(Es, S, X).

final_pick(Vs, E0, S, X) :-
    fresh(Vs, E0, E, Choices),
    chosen(Choices, S, X),
    is_final(E, S, X).

final_guarded(C, E, S, X) :-
    (   \+ holds(C, S, X)
    ->  true
    ;   is_final(E, S, X)
    ).

final_weak(achieve(Goal), S, X) :-
    context_module(X, M),
    (   has_clauses(M, rule(_, _, _))
    ->  rule_of(M, Goal, Guard, Body),
        holds(Guard, S, X),
        is_final(Body, S, X)
    ;   holds(Goal, S, X)
    ).
final_weak(time(E, _), S, X) :-
    is_final(E, S, X).
final_weak(ttime(E, _), S, X) :-
    is_final(E, S, X).
final_weak(sync(Es), S, X) :-
    all_final(Es, S, X).

                /*******************************
                *             TRANS            *
                *******************************/

%!  step(+Program0, +Situation0, -Program, -Situation, +Context) is nondet.
%
%   True if Program0 can take a step in Situation0, and Program remains in
%   Situation. The history of Situation has at most one entry more.

step(E, S, E1, S1, X) :-
    (   var(E)
    ->  unbound_program
    ;   construct(E)
    ->  step_construct(E, S, E1, S1, X)
    ;   context_module(X, M),
        domain_names(E, M)
    ->  step_named(E, S, E1, S1, X, M)
    ;   weak_construct(E)
    ->  step_weak(E, S, E1, S1, X)
    ;   context_module(X, M),
        unknown_program(E, M)
    ).

%   The domain has a procedure or an action with this functor.

domain_names(E, M) :-
    (   is_kind(proc, E, M)
    ->  true
    ;   is_kind(action, E, M)
    ).

unbound_program :-
    throw_error(instantiation_error, _,
                'a part of a program is still a variable when it is to run').

unknown_program(E, M) :-
    (   callable(E)
    ->  functor(E, Name, Arity),
        What = Name/Arity
    ;   What = E
    ),
    located(M, in_program(E), Where),
    format(atom(Text), '~wthere is no construct, procedure or action ~q',
           [Where, What]),
    throw_error(existence_error(golog_program, What), _, Text).

step_named(E, S, E1, S1, X, M) :-
    is_kind(proc, E, M),
    (   is_kind(action, E, M)
    ->  (   proc_step(E, S, E1, S1, X, M)
        ;   action_step(E, S, E1, S1, X, M)
        )
    ;   !,
        proc_step(E, S, E1, S1, X, M)
    ).
step_named(E, S, E1, S1, X, M) :-
    \+ is_kind(proc, E, M),
    action_step(E, S, E1, S1, X, M).

proc_step(E, S, E1, S1, X, M) :-
    proc_body(E, Body, M),
    entered(step, E, X, X1),
    step(Body, S, E1, S1, X1).

%   A primitive action: the fluents in its arguments are evaluated first.

action_step(A0, S, [], S1, X, M) :-
    action_now(A0, A, S, X, M),
    done(A, S, S1, X).

action_now(A0, A, S, X, M) :-
    evaluated_arguments(A0, A, S, X),
    (   ground(A)
    ->  possible(A, S, X, M),
        !
    ;   possible(A, S, X, M)
    ).

possible(A, S, X, M) :-
    (   ground(A),
        \+ M:prim_action(A)
    ->  blocked(A, prim_action(A)),
        fail
    ;   true
    ),
    M:prim_action(A),
    (   is_kind(precondition, A, M)
    ->  true
    ;   no_precondition(A, M)
    ),
    (   M:poss(A, Condition),
        (   holds(Condition, S, X)
        *-> true
        ;   blocked(A, Condition),
            fail
        )
    *-> true
    ;   blocked(A, poss(A)),
        fail
    ).

%!  made_possible(+Action, -Condition, +Situation, +Context) is det.
%
%   Condition is the one of poss/2 that holds for Action, else `true`.

made_possible(A, Condition, S, X) :-
    context_module(X, M),
    (   is_kind(precondition, A, M),
        M:poss(A, Condition0),
        holds(Condition0, S, X)
    ->  Condition = Condition0
    ;   Condition = true
    ).

no_precondition(A, M) :-
    (   is_exogenous(A, M)
    ->  true
    ;   functor(A, Name, Arity),
        located(M, action(A), Where),
        format(atom(Text), '~wthe action ~q has no precondition: there is \c
                            no poss/2 for it', [Where, Name/Arity]),
        throw_error(existence_error(golog_precondition, Name/Arity), _,
                    Text)
    ).

% Golog

step_construct([E|Es], S, E1, S1, X) :-
    (   Es == []
    ->  step(E, S, E1, S1, X)
    ;   (   is_final(E, S, X),
            step_rest(Es, S, E1, S1, X)
        ;   step(E, S, E2, S1, X),
            E1 = [E2|Es]
        )
    ).
step_construct(?(P), S, E1, S1, X) :-
    step_test(P, S, E1, S1, X).
step_construct(ndet(A, B), S, E1, S1, X) :-
    (   step(A, S, E1, S1, X)
    ;   step(B, S, E1, S1, X)
    ).
step_construct(if(P, A, B), S, E1, S1, X) :-
    (   holds(P, S, X)
    *-> step(A, S, E1, S1, X)
    ;   step(B, S, E1, S1, X)
    ).
step_construct(while(P, E), S, [E1, while(P, E)], S1, X) :-
    holds(P, S, X),
    step(E, S, E1, S1, X).
step_construct(star(E), S, [E1, star(E)], S1, X) :-
    step(E, S, E1, S1, X).
step_construct(star(E, N0), S, E1, S1, X) :-
    N is N0-1,
    N >= 0,
    step(E, S, E2, S1, X),
    (   N =:= 0
    ->  E1 = E2
    ;   E1 = [E2, star(E, N)]
    ).
step_construct(pi(Vs, E), S, E1, S1, X) :-
    step_pick(Vs, E, S, E1, S1, X).
step_construct(pi(V, D, E), S, E1, S1, X) :-
    (   nonvar(V),
        V = r(V1)
    ->  step_random_pick((V1, D), E, S, E1, S1, X)
    ;   step_pick((V, D), E, S, E1, S1, X)
    ).

% ConGolog

step_construct(conc(A, B), S, E1, S1, X) :-
    (   allowed(A, B, S, X),
        step(A, S, A1, S1, X),
        turned(X, A1, B, E1)
    ;   allowed(B, A, S, X),
        step(B, S, B1, S1, X),
        E1 = conc(A, B1)
    ).
step_construct('$turn'(A, B), S, E1, S1, X) :-
    (   allowed(B, A, S, X),
        step(B, S, B1, S1, X),
        E1 = conc(A, B1)
    ;   allowed(A, B, S, X),
        step(A, S, A1, S1, X),
        turned(X, A1, B, E1)
    ).
step_construct(pconc(A, B), S, E1, S1, X) :-
    (   allowed(A, B, S, X),
        step(A, S, A1, S1, X)
    *-> E1 = pconc(A1, B)
    ;   allowed(B, A, S, X),
        step(B, S, B1, S1, X),
        E1 = pconc(A, B1)
    ).
step_construct(iconc(E), S, E1, S1, X) :-
    step(E, S, E2, S1, X),
    turned(X, E2, iconc(E), E1).
step_construct(interrupt(P, E), S, [E1, interrupt(P, E)], S1, X) :-
    holds(P, S, X),
    triggered(P, X, X1),
    step(E, S, E1, S1, X1).
step_construct(interrupt(Vs, P, E), S, [E1, interrupt(Vs, P, E)], S1, X) :-
    fresh(Vs, P-E, P1-E0, Choices),
    chosen(Choices, S, X),
    holds(P1, S, X),
    triggered(P1, X, X1),
    step(E0, S, E1, S1, X1).
step_construct(prioritized_interrupts(Es), S, E1, S1, X) :-
    (   first_step(Es, S, Es1, S1, X)
    *-> E1 = prioritized_interrupts(Es1)
    ;   \+ ( member(E, Es), in_atom(E, S, X) ),
        S1 = S,
        stopped(Es, E1)
    ).
step_construct(prioritized_interrupts_simple(Es), S, E1, S1, X) :-
    step_construct(prioritized_interrupts(Es), S, E1, S1, X).

% IndiGolog

step_construct(search(E), S, E1, S1, X) :-
    planned_step(search(E), S, E1, S1, X).
step_construct(search(E, M), S, E1, S1, X) :-
    planned_step(search(E, M), S, E1, S1, X).
step_construct(search(E, M, Options), S, E1, S1, X) :-
    planned_step(search(E, M, Options), S, E1, S1, X).
step_construct(searchn(E, _), S, E1, S1, X) :-
    planned_step(search(E), S, E1, S1, X).
step_construct(searchc(E), S, E1, S1, X) :-
    planned_step(searchc(E), S, E1, S1, X).
step_construct(searchc(E, _), S, E1, S1, X) :-
    planned_step(searchc(E), S, E1, S1, X).
step_construct('$path'(E, Path, At, Options), S, E1, S1, X) :-
    planned_step('$path'(E, Path, At, Options), S, E1, S1, X).
step_construct(gexec(C, E), S, E1, S1, X) :-
    (   context_option(assume, X)
    ->  done(e(C, true), S, S2, X),
        step(E, S2, E2, S1, X),
        E1 = gexec2(C, E2)
    ;   holds(C, S, X),
        step(E, S, E2, S1, X),
        E1 = gexec(C, E2)
    ).
step_construct(gexec2(C, E), S, gexec2(C, E1), S1, X) :-
    holds(C, S, X),
    step(E, S, E1, S1, X).
step_construct(goal(Success, E, Failure, Recovery), S, E1, S1, X) :-
    \+ holds(Success, S, X),
    (   holds(Failure, S, X)
    ->  step(Recovery, S, E1, S1, X)
    ;   step(E, S, E2, S1, X),
        E1 = goal(Success, E2, Failure, Recovery)
    ).
step_construct(wndet(A, B), S, E1, S1, X) :-
    (   step(A, S, E2, S2, X)
    *-> E1 = E2,
        S1 = S2
    ;   step(B, S, E1, S1, X)
    ).
step_construct(rndet(A, B), S, E1, S1, X) :-
    shuffled([A, B], Es),
    member(E, Es),
    step(E, S, E1, S1, X).
step_construct(rpi(Vs, E), S, E1, S1, X) :-
    step_random_pick(Vs, E, S, E1, S1, X).
step_construct(rpi(V, D, E), S, E1, S1, X) :-
    step_random_pick((V, D), E, S, E1, S1, X).
step_construct(rconc(A, B), S, E1, S1, X) :-
    shuffled([1, 2], Order),
    member(Which, Order),
    (   Which == 1
    ->  allowed(A, B, S, X),
        step(A, S, A1, S1, X),
        E1 = rconc(A1, B)
    ;   allowed(B, A, S, X),
        step(B, S, B1, S1, X),
        E1 = rconc(A, B1)
    ).
step_construct(rconc(Es), S, rconc([E1|Rest]), S1, X) :-
    numbers(Es, 1, Numbers),
    shuffled(Numbers, Order),
    member(Number, Order),
    nth1_rest(Number, Es, E, Rest),
    all_allowed(Rest, E, S, X),
    step(E, S, E1, S1, X).
step_construct(rrobin(Es), S, rrobin(Es1), S1, X) :-
    select(E, Es, Rest),
    all_allowed(Rest, E, S, X),
    step(E, S, E1, S1, X),
    append(Rest, [E1], Es1).
step_construct(atomic(E), S, '$atomic'(E1), S1, X) :-
    step(E, S, E1, S1, X).
step_construct('$atomic'(E), S, '$atomic'(E1), S1, X) :-
    step(E, S, E1, S1, X).
step_construct(for(V, D, E), S, E1, S1, X) :-
    for_program(V, D, E, S, X, Program),
    step(Program, S, E1, S1, X).
step_construct(??(P), S, [], S1, X) :-
    holds(P, S, X),
    marked(test(P), S, S1).
step_construct(exogint(E, P), S, exogint(E1, P), S1, X) :-
    step(E, S, E1, S1, X).

%   What follows a first part that may end

step_rest(Es, S, E1, S1, X) :-
    (   Es = [E]
    ->  step(E, S, E1, S1, X)
    ;   step(Es, S, E1, S1, X)
    ).

step_test(P, S, E1, S1, X) :-
    (   P == wait_exog_action
    ->  E1 = [],
        marked(wait, S, S1)
    ;   P == printHistory
    ->  situation_history(S, History),
        print_message(informational, golog(history(History))),
        E1 = [],
        S1 = S
    ;   E1 = [],
        S1 = S,
        holds(P, S, X)
    ).

step_pick(Vs, E0, S, E1, S1, X) :-
    fresh(Vs, E0, E, Choices),
    chosen(Choices, S, X),
    step(E, S, E1, S1, X).

step_random_pick(Vs, E0, S, E1, S1, X) :-
    fresh(Vs, E0, E, Choices),
    findall(Choices, chosen(Choices, S, X), All0),
    shuffled(All0, All),
    member(Choices, All),
    step(E, S, E1, S1, X).

for_program(V, D, E, S, X, Program) :-
    findall(Value, domain_value(Value, D, S, X), Values),
    for_each(Values, V, E, Program).

for_each([], _, _, []).
for_each([Value|Values], V, E0, [E|Es]) :-
    fresh(V, E0, E, [Value-_]),
    for_each(Values, V, E0, Es).

%   An online run takes turns: after a step of the first program the second
%   one comes first. Offline, all orders are enumerated anyway.

turned(X, A, B, E) :-
    (   context_option(online, X)
    ->  E = '$turn'(A, B)
    ;   E = conc(A, B)
    ).

%   allowed(+Program, +Other, +Situation, +Context): Program may take a step
%   now, because Other is not in the middle of an atomic/1.

allowed(_, Other, S, X) :-
    \+ in_atom(Other, S, X).

all_allowed([], _, _, _).
all_allowed([Other|Others], E, S, X) :-
    allowed(E, Other, S, X),
    all_allowed(Others, E, S, X).

in_atom(E, S, X) :-
    atom_in(E, Inner),
    \+ is_final(Inner, S, X),
    !.

%   atom_in(+Program, -Inner) is nondet: atomic(Inner) is under way in a part
%   of Program that may take a step next.

atom_in(E, Inner) :-
    nonvar(E),
    atom_in_(E, Inner).

atom_in_('$atomic'(E), E).
atom_in_([E|_], Inner) :-
    atom_in(E, Inner).
atom_in_(conc(A, B), Inner) :-
    atom_in_list([A, B], Inner).
atom_in_('$turn'(A, B), Inner) :-
    atom_in_list([A, B], Inner).
atom_in_(pconc(A, B), Inner) :-
    atom_in_list([A, B], Inner).
atom_in_(rconc(A, B), Inner) :-
    atom_in_list([A, B], Inner).
atom_in_(rconc(Es), Inner) :-
    atom_in_list(Es, Inner).
atom_in_(rrobin(Es), Inner) :-
    atom_in_list(Es, Inner).
atom_in_(prioritized_interrupts(Es), Inner) :-
    atom_in_list(Es, Inner).
atom_in_(gexec(_, E), Inner) :-
    atom_in(E, Inner).
atom_in_(gexec2(_, E), Inner) :-
    atom_in(E, Inner).
atom_in_('$path'(E, _, _, _), Inner) :-
    atom_in(E, Inner).
atom_in_(goal(_, E, _, _), Inner) :-
    atom_in(E, Inner).

atom_in_list(Es, Inner) :-
    member(E, Es),
    atom_in(E, Inner).

% Interrupts

%   first_step(+Es, +S, -Es1, -S1, +X): the first of Es that can take a step
%   takes it, unless another is in the middle of an atomic/1.

first_step(Es, S, Es1, S1, X) :-
    (   append(Before, [E|After], Es),
        in_atom(E, S, X)
    ->  step(E, S, E1, S1, X),
        append(Before, [E1|After], Es1)
    ;   first_of(Es, S, Es1, S1, X)
    ).

first_of([E|Es], S, Es1, S1, X) :-
    (   step(E, S, E1, S2, X)
    *-> Es1 = [E1|Es],
        S1 = S2
    ;   Es1 = [E|Es2],
        first_of(Es, S, Es2, S1, X)
    ).

%   When none of them can take a step, the interrupts stop. What one of them
%   has begun is still to be ended.

stopped([], []).
stopped([E0|Es0], E) :-
    without_interrupts(E0, E1),
    stopped(Es0, E2),
    (   E1 == []
    ->  E = E2
    ;   E2 == []
    ->  E = E1
    ;   E = pconc(E1, E2)
    ).

without_interrupts(E0, E) :-
    (   var(E0)
    ->  E = E0
    ;   E0 = interrupt(_, _)
    ->  E = []
    ;   E0 = interrupt(_, _, _)
    ->  E = []
    ;   E0 = [E1|Es1]
    ->  without_interrupts(E1, E2),
        without_interrupts(Es1, Es2),
        (   E2 == []
        ->  E = Es2
        ;   E = [E2|Es2]
        )
    ;   E0 = conc(A0, B0)
    ->  without_interrupts(A0, A),
        without_interrupts(B0, B),
        E = conc(A, B)
    ;   E0 = pconc(A0, B0)
    ->  without_interrupts(A0, A),
        without_interrupts(B0, B),
        E = pconc(A, B)
    ;   E = E0
    ).

%!  is_preempted(+Program0, +Program, +Situation, +Context) is semidet.
%
%   Program0 has taken a step to Program. True if in Situation a part of
%   Program0 with a higher priority than the one that took the step can take
%   a step, too. Not if the step is part of an atomic/1.

is_preempted(E0, E, S, X) :-
    \+ ( atom_in(E, Inner),
         \+ ( atom_in(E0, Inner0), Inner0 =@= Inner ) ),
    preempted_by(E0, E, S, X),
    !.

preempted_by(E0, E, S, X) :-
    nonvar(E0),
    preempted(E0, E, S, X).

preempted([A0|As], E, S, X) :-
    (   As == []
    ->  preempted_by(A0, E, S, X)
    ;   nonvar(E),
        E = [A|Bs],
        Bs =@= As
    ->  preempted_by(A0, A, S, X)
    ;   preempted_by(As, E, S, X)
    ).
preempted(conc(A0, B0), E, S, X) :-
    preempted_in_pair(A0, B0, E, S, X).
preempted('$turn'(A0, B0), E, S, X) :-
    preempted_in_pair(A0, B0, E, S, X).
preempted(rconc(A0, B0), E, S, X) :-
    preempted_in_pair(A0, B0, E, S, X).
preempted(pconc(A0, B0), pconc(A, B), S, X) :-
    (   A0 =@= A
    ->  (   can_step(A0, S, X)
        ->  true
        ;   preempted_by(B0, B, S, X)
        )
    ;   preempted_by(A0, A, S, X)
    ).
preempted(prioritized_interrupts(Es0), prioritized_interrupts(Es), S, X) :-
    preempted_in_list(Es0, Es, S, X).
preempted(gexec(C, E0), gexec(C, E), S, X) :-
    preempted_by(E0, E, S, X).
preempted(gexec2(C, E0), gexec2(C, E), S, X) :-
    preempted_by(E0, E, S, X).
preempted(goal(P, E0, F, R), goal(P, E, F, R), S, X) :-
    preempted_by(E0, E, S, X).
preempted(interrupt(_, B0), [B|_], S, X) :-
    preempted_by(B0, B, S, X).
preempted(while(_, B0), [B|_], S, X) :-
    preempted_by(B0, B, S, X).
preempted(if(P, A0, B0), E, S, X) :-
    (   holds(P, S, X)
    ->  preempted_by(A0, E, S, X)
    ;   preempted_by(B0, E, S, X)
    ).
preempted(E0, E, S, X) :-
    callable(E0),
    context_module(X, M),
    is_kind(proc, E0, M),
    proc_body(E0, Body, M),
    entered(preempted, E0, X, X1),
    preempted_by(Body, E, S, X1).

preempted_in_pair(A0, B0, E, S, X) :-
    arg(1, E, A),
    arg(2, E, B),
    (   A0 =@= A
    ->  preempted_by(B0, B, S, X)
    ;   preempted_by(A0, A, S, X)
    ).

preempted_in_list([E0|Es0], [E|Es], S, X) :-
    (   E0 =@= E
    ->  (   can_step(E0, S, X)
        ->  true
        ;   preempted_in_list(Es0, Es, S, X)
        )
    ;   preempted_by(E0, E, S, X)
    ).

can_step(E, S, X) :-
    stepping(X, X1),
    \+ \+ step(E, S, _, _, X1).

% What the domain may define otherwise

step_weak(wait, S, [], S1, _) :-
    marked(wait, S, S1).
step_weak(wait_exog, S, [], S1, _) :-
    marked(wait, S, S1).
step_weak(commit, S, [], S1, _) :-
    marked(commit, S, S1).
step_weak(branch(P), S, [], S1, _) :-
    marked(branch(P), S, S1).
step_weak(abort, S, [], S1, _) :-
    marked(abort, S, S1).
step_weak(abort(P), S, [], S1, X) :-
    done(e(P, false), S, S1, X).
step_weak(e(F0, V0), S, [], S1, X) :-
    evaluated_arguments(F0, F, S, X),
    evaluated_arguments(v(V0), v(V), S, X),
    done(e(F, V), S, S1, X).
step_weak(set(F0), S, [], S1, X) :-
    evaluated_arguments(F0, F, S, X),
    done(set(F), S, S1, X).
step_weak(unset(F0), S, [], S1, X) :-
    evaluated_arguments(F0, F, S, X),
    done(unset(F), S, S1, X).
step_weak(sim(A0), S, [], S1, X) :-
    evaluated_arguments(A0, A, S, X),
    done(sim(A), S, S1, X).
step_weak(achieve(Goal), S, E1, S1, X) :-
    context_module(X, M),
    (   has_clauses(M, rule(_, _, _))
    ->  rule_of(M, Goal, Guard, Body),
        holds(Guard, S, X),
        step(Body, S, E1, S1, X)
    ;   \+ holds(Goal, S, X),
        planned_step(achieve(Goal), S, E1, S1, X)
    ).
step_weak(time(E, Seconds), S, E1, S1, X) :-
    step_in_time(E, Seconds, S, E1, S1, X).
step_weak(ttime(E, Seconds), S, ttime(E1, Seconds), S1, X) :-
    step_in_time(E, Seconds, S, E1, S1, X).
step_weak(sync(Es), S, sync(Es1), S1, X) :-
    together(Es, S, Es1, S1, _, X).

step_in_time(E, Seconds, S, E1, S1, X) :-
    catch(call_with_time_limit(Seconds, once(step(E, S, E1, S1, X))),
          time_limit_exceeded, fail).

rule_of(M, Goal, Guard, Body) :-
    Rule = rule(Goal, Guard, Body),
    M:Rule.

%   All programs take the same action; tests before it are each one's own.

together([], S, [], S, _, _).
together([E|Es], S, [E1|Es1], S1, A, X) :-
    to_action(E, S, E1, S2, A, X),
    (   Es == []
    ->  Es1 = [],
        S1 = S2
    ;   together(Es, S, Es1, S1, A, X)
    ).

to_action(E, S, E1, S1, A, X) :-
    step(E, S, E2, S2, X),
    situation_count(S, C),
    situation_count(S2, C2),
    (   C2 =:= C
    ->  to_action(E2, S2, E1, S1, A, X)
    ;   situation_history(S2, [A|_]),
        E1 = E2,
        S1 = S2
    ).

% Chance

shuffled(List, Shuffled) :-
    keyed(List, Keyed0),
    keysort(Keyed0, Keyed),
    without_keys(Keyed, Shuffled).

keyed([], []).
keyed([X|Xs], [Key-X|Ys]) :-
    random_between(0, 1000000000, Key),
    keyed(Xs, Ys).

without_keys([], []).
without_keys([_-X|Xs], [X|Ys]) :-
    without_keys(Xs, Ys).

numbers([], _, []).
numbers([_|Xs], N, [N|Ns]) :-
    N1 is N+1,
    numbers(Xs, N1, Ns).

nth1_rest(N, List, X, Rest) :-
    nth1(N, List, X),
    N0 is N-1,
    length(Before, N0),
    append(Before, [_|After], List),
    append(Before, After, Rest).

                /*******************************
                *              RUN             *
                *******************************/

%!  run(+Program, +Situation0, -Situation, +Length, +Context) is nondet.
%
%   True if Program can run from Situation0 to its end in Situation. Length is
%   `any`, or at(Count, History): the history of Situation is that, so that
%   steps which lead elsewhere are given up.

run(E0, S0, S, Length, X) :-
    simplified(E0, E),
    (   E == []
    ->  S = S0
    ;   (   is_final(E, S0, X),
            S = S0
        ;   step(E, S0, E1, S1, X),
            on_the_way(Length, S1),
            run(E1, S1, S, Length, X)
        )
    ).

on_the_way(any, _).
on_the_way(at(Count, Histories), S) :-
    situation_count(S, C),
    C =< Count,
    situation_history(S, History),
    arg(1, Histories, Wanted),
    Skip is Count-C,
    \+ \+ ( length(Newer, Skip),
            append(Newer, History, Wanted) ).

%!  simplified(+Program0, -Program) is det.
%
%   Program is Program0 without the empty programs that actions and tests have
%   left where the next step may begin. So a step of Program always makes a
%   difference to it.

simplified(E0, E) :-
    (   nonvar(E0),
        simpler(E0, E1)
    ->  E = E1
    ;   E = E0
    ).

simpler([A0|As], E) :-
    simplified(A0, A),
    (   A == []
    ->  (   As = [B]
        ->  simplified(B, E)
        ;   simplified(As, E)
        )
    ;   E = [A|As]
    ).
simpler(conc(A0, B0), conc(A, B)) :-
    simplified(A0, A),
    simplified(B0, B).
simpler('$turn'(A0, B0), '$turn'(A, B)) :-
    simplified(A0, A),
    simplified(B0, B).
simpler(pconc(A0, B0), pconc(A, B)) :-
    simplified(A0, A),
    simplified(B0, B).
simpler(rconc(A0, B0), rconc(A, B)) :-
    simplified(A0, A),
    simplified(B0, B).
simpler(prioritized_interrupts(Es0), prioritized_interrupts(Es)) :-
    all_simplified(Es0, Es).
simpler(gexec(C, E0), gexec(C, E)) :-
    simplified(E0, E).
simpler(gexec2(C, E0), gexec2(C, E)) :-
    simplified(E0, E).
simpler(goal(P, E0, F, R), goal(P, E, F, R)) :-
    simplified(E0, E).
simpler('$path'(_, [], _, _), []).
simpler('$atomic'(E0), '$atomic'(E)) :-
    simplified(E0, E).

all_simplified([], []).
all_simplified([E0|Es0], [E|Es]) :-
    simplified(E0, E),
    all_simplified(Es0, Es).

%!  program_shown(+Program0, -Program) is det.
%
%   Program is Program0 as the program's author knows it: without marks of
%   the interpreter.

program_shown(E0, E) :-
    (   \+ compound(E0)
    ->  E = E0
    ;   E0 = '$turn'(A0, B0)
    ->  program_shown(A0, A),
        program_shown(B0, B),
        E = conc(A, B)
    ;   E0 = '$atomic'(A0)
    ->  program_shown(A0, A),
        E = atomic(A)
    ;   E0 = '$path'(A0, _, _, _)
    ->  program_shown(A0, A),
        E = search(A)
    ;   mapped(program_shown, E0, E)
    ).
