:- module(ev3dev_golog_transitions,
          [ step/5,                     % +Program0, +Situation0, -Program,
                                        % -Situation, +Context
            is_final/3,                 % +Program, +Situation, +Context
            run/5,                      % +Program, +Situation0, -Situation,
                                        % +Length, +Context
            is_possible/3,              % +Action, +Situation, +Context
            made_possible/4,            % +Action, -Condition, +Situation,
                                        % +Context
            is_preempted/4,             % +Program0, +Program, +Situation,
                                        % +Context
            higher_can_step/3,          % +Notes, +Situation, +Context
            in_atom/3,                  % +Program, +Situation, +Context
            simplified/3,               % +Program0, -Program, +Context
            program_shown/2             % +Program0, -Program
          ]).
:- use_module(library(lists),
              [append/3, member/2, select/3, select/4]).
:- use_module(library(random), [random_permutation/2]).
:- use_module(context,
              [ blocked/2, context_module/2, context_option/2, entered/4,
                is_recorded/1, noted/2, place_in/3, recorded_step/3,
                stepping/2
              ]).
:- use_module(conditions, [chosen/3, domain_value/4, holds/3]).
:- use_module(progression, [done/4]).
:- use_module(situation, [marked/3, situation_count/2, situation_history/2]).
:- use_module(steps, [step_after/5]).
:- use_module(values, [evaluated_arguments/4]).
:- use_module(hints, [hint/3]).
:- use_module(programs,
              [construct/1, fresh/4, mapped/3, parts/5, weak_construct/1]).
:- use_module(theory,
              [ has_step_rules/1, is_exogenous/2, is_kind/3, located/3,
                located_precondition/4, precondition/3, proc_body/3
              ]).
:- use_module('../checks/checks', [must_be/2]).
:- use_module('../errors/errors', [throw_error/3]).

/** <module> The language: which steps a program can take

step/5 is Trans and is_final/3 is Final of the literature: De Giacomo,
Lesperance, Levesque: ConGolog, a concurrent programming language based on the
situation calculus, AI 121 (2000), for the constructs of Golog and ConGolog;
De Giacomo, Lesperance, Levesque, Sardina: IndiGolog (2009) for those of
IndiGolog. if/3 and while/2 make their test and the first step of their body
one step, as there. A condition with free variables has a step for each of its
solutions. search.pl adds the constructs that look ahead.
*/

:- multifile
    step_construct/5,
    ends/3.

% ---------------- FINAL

%!  is_final(+Program, +Situation, +Context) is semidet.
%
%   True if Program may end in Situation.

is_final(E, S, X) :-
    final(E, S, X),
    !.

final(E, S, X) :-
    (   var(E)
    ->  unbound_program(X)
    ;   E = [First|Rest]
    ->  is_final(First, S, X),
        is_final(Rest, S, X)
    ;   construct(E)
    ->  final_construct(E, S, X)
    ;   context_module(X, M),
        domain_names(E, M)
    ->  is_kind(proc, E, M),
        proc_body(E, Body, M),
        entered(final, E, X, X1),
        final(Body, S, X1)
    ;   weak_construct(E)
    ->  final_construct(E, S, X)
    ;   unknown_program(E, X)
    ).

final_construct(E, S, X) :-
    (   parts(E, Use, Es, _, _),
        Use \== own
    ->  all_final(Es, S, X)
    ;   ends(E, S, X)
    ).

all_final([], _, _).
all_final([E|Es], S, X) :-
    is_final(E, S, X),
    all_final(Es, S, X).

%   ends(+Program, +Situation, +Context) is nondet: Final of the constructs
%   with a rule of their own

ends([], _, _).
ends(ndet(A, B), S, X) :-
    (   is_final(A, S, X)
    ;   is_final(B, S, X)
    ).
ends(rndet(A, B), S, X) :-
    ends(ndet(A, B), S, X).
ends(if(P, A, B), S, X) :-
    (   holds(P, S, X)
    *-> is_final(A, S, X)
    ;   is_final(B, S, X)
    ).
ends(while(P, E), S, X) :-
    (   \+ holds(P, S, X)
    ;   holds(P, S, X),
        is_final(E, S, X)
    ).
ends(star(_), _, _).
ends(star(_, _), _, _).
ends(pi(Vs, E0), S, X) :-
    fresh(Vs, E0, E, Choices),
    chosen(Choices, S, X),
    is_final(E, S, X).
ends(pi(V, D, E), S, X) :-
    ends(pi((V, D), E), S, X).
ends(rpi(Vs, E), S, X) :-
    ends(pi(Vs, E), S, X).
ends(rpi(V, D, E), S, X) :-
    ends(pi((V, D), E), S, X).
ends(iconc(_), _, _).
ends(interrupt(_, _), _, _).
ends(interrupt(_, _, _), _, _).
ends(gexec(C, E), S, X) :-
    (   context_option(assume, X)
    ->  is_final(E, S, X)
    ;   ends(gexec2(C, E), S, X)
    ).
ends(gexec2(C, E), S, X) :-
    (   \+ holds(C, S, X)
    ;   is_final(E, S, X)
    ).
ends(goal(Success, E, _, _), S, X) :-
    (   holds(Success, S, X)
    ;   is_final(E, S, X)
    ).
ends(A : B, S, X) :-
    is_final([A, B], S, X).
ends(#(A, B), S, X) :-
    ends(ndet(A, B), S, X).
ends(for(V, D, E), S, X) :-
    for_program(V, D, E, S, X, Es),
    is_final(Es, S, X).

% ---------------- TRANS

%!  step(+Program0, +Situation0, -Program, -Situation, +Context) is nondet.
%
%   True if Program0 can take a step in Situation0, and Program remains in
%   Situation. The history of Situation has at most one entry more.

step(E, S, E1, S1, X) :-
    (   var(E)
    ->  unbound_program(X)
    ;   construct(E)
    ->  step_construct(E, S, E1, S1, X)
    ;   context_module(X, M),
        domain_names(E, M)
    ->  step_named(E, S, E1, S1, X, M)
    ;   weak_construct(E)
    ->  step_construct(E, S, E1, S1, X)
    ;   unknown_program(E, X)
    ).

%   The domain has a procedure or an action with this functor.

domain_names(E, M) :-
    (   is_kind(proc, E, M)
    ->  true
    ;   is_kind(action, E, M)
    ).

unbound_program(X) :-
    place_in(X, program, Where),
    format(atom(Text), '~wa part of a program is still a variable when it \c
                        is to run', [Where]),
    throw_error(instantiation_error, _, Text).

unknown_program(E, X) :-
    context_module(X, M),
    (   compound(E)
    ->  compound_name_arity(E, Name, Arity),    % also of go()
        What = Name/Arity
    ;   atom(E)
    ->  What = E/0
    ;   What = E
    ),
    (   What = Name/Arity
    ->  functor(Named, Name, Arity),
        Terms = [E, Named]
    ;   Terms = [E]
    ),
    located(M, in_program(Terms), Where),
    hint(E, M, Hint),
    format(atom(Text), '~wthere is no construct, procedure or action ~q~w',
           [Where, What, Hint]),
    throw_error(existence_error(golog_program, What), _, Text).

step_named(E, S, E1, S1, X, M) :-
    (   \+ is_kind(proc, E, M)
    ->  action_step(E, S, E1, S1, X, M)
    ;   \+ is_kind(action, E, M)
    ->  proc_step(E, S, E1, S1, X, M)
    ;   proc_step(E, S, E1, S1, X, M)
    ;   action_step(E, S, E1, S1, X, M)
    ).

proc_step(E, S, E1, S1, X, M) :-
    proc_body(E, Body, M),
    entered(step, E, X, X1),
    functor(E, Name, Arity),
    step_within(proc(Name/Arity), Body, S, E1, S1, X1).

%   A primitive action: the fluents in its arguments are evaluated first.

action_step(A0, S, [], S1, X, M) :-
    action_now(A0, A, S, X, M),
    (   has_step_rules(M)
    ->  step_done(A, S, S1, X)
    ;   done(A, S, S1, X)
    ).

step_done(Entry, S, S1, X) :-
    step_after(Entry, S, S1, Why, X),
    (   nonvar(Why)
    ->  blocked(Entry, Why),
        fail
    ;   true
    ).

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
    (   precondition(A, Condition, M),
        (   holds(Condition, S, X)
        *-> true
        ;   blocked(A, Condition),
            fail
        )
    *-> true
    ;   blocked(A, poss(A)),
        fail
    ).

%!  is_possible(+Action, +Situation, +Context) is semidet.
%
%   True if poss/2 allows the ground Action, whatever others do at the same
%   time.

is_possible(A, S, X) :-
    context_module(X, M),
    possible(A, S, X, M),
    !.

%!  made_possible(+Action, -Condition, +Situation, +Context) is det.
%
%   Condition is the one of poss/2 that holds for Action, else `true`.

made_possible(A, Condition, S, X) :-
    context_module(X, M),
    (   is_kind(precondition, A, M),
        located_precondition(A, Condition0, _, M),
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

%   step_construct(+Program0, +Situation0, -Program, -Situation, +Context) is
%   nondet: Trans of each construct

step_construct([E|Es], S, E1, S1, X) :-
    (   Es == []
    ->  step(E, S, E1, S1, X)
    ;   is_final(E, S, X),
        (   Es = [Last]
        ->  step(Last, S, E1, S1, X)
        ;   step(Es, S, E1, S1, X)
        )
    ;   step(E, S, E2, S1, X),
        E1 = [E2|Es]
    ).
step_construct(?(P), S, [], S1, X) :-
    (   P == wait_exog_action
    ->  marked(wait, S, S1)
    ;   P == printHistory
    ->  situation_history(S, History),
        print_message(informational, golog(history(History))),
        S1 = S
    ;   S1 = S,
        holds(P, S, X)
    ).
step_construct(ndet(A, B), S, E1, S1, X) :-
    (   step(A, S, E1, S1, X)
    ;   step(B, S, E1, S1, X)
    ).
step_construct(A : B, S, E1, S1, X) :-
    step_construct([A, B], S, E1, S1, X).
step_construct(#(A, B), S, E1, S1, X) :-
    step_construct(ndet(A, B), S, E1, S1, X).
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
step_construct(pi(Vs, E0), S, E1, S1, X) :-
    fresh(Vs, E0, E, Choices),
    chosen(Choices, S, X),
    step(E, S, E1, S1, X).
step_construct(pi(V, D, E), S, E1, S1, X) :-
    (   nonvar(V),
        V = r(V1)
    ->  step_construct(rpi((V1, D), E), S, E1, S1, X)
    ;   step_construct(pi((V, D), E), S, E1, S1, X)
    ).

% ConGolog

step_construct(conc(A, B), S, E1, S1, X) :-
    (   turn_taken(left, A, B, S, E1, S1, X)
    ;   turn_taken(right, A, B, S, E1, S1, X)
    ).
step_construct('$turn'(A, B), S, E1, S1, X) :-
    (   turn_taken(right, A, B, S, E1, S1, X)
    ;   turn_taken(left, A, B, S, E1, S1, X)
    ).
step_construct(pconc(A, B), S, pconc(A1, B1), S1, X) :-
    first_step([A, B], S, [A1, B1], S1, X).
step_construct(iconc(E), S, E1, S1, X) :-
    turn_taken(left, E, iconc(E), S, E1, S1, X).
step_construct(interrupt(P, E), S, [E1, interrupt(P, E)], S1, X) :-
    holds(P, S, X),
    step_within(interrupt(P), E, S, E1, S1, X).
step_construct(interrupt(Vs, P, E), S, [E1, interrupt(Vs, P, E)], S1, X) :-
    fresh(Vs, P-E, P1-E0, Choices),
    chosen(Choices, S, X),
    holds(P1, S, X),
    step_within(interrupt(P1), E0, S, E1, S1, X).
step_construct('$within'(Note, E), S, E1, S1, X) :-
    step_within(Note, E, S, E1, S1, X).
step_construct(prioritized_interrupts(Es), S, E1, S1, X) :-
    (   first_step(Es, S, Es1, S1, X)
    *-> E1 = prioritized_interrupts(Es1)
    ;   \+ in_atom(prioritized_interrupts(Es), S, X),
        S1 = S,
        stopped(Es, E1, X)
    ).
step_construct(prioritized_interrupts_simple(Es), S, E1, S1, X) :-
    step_construct(prioritized_interrupts(Es), S, E1, S1, X).

% IndiGolog

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
    random_permutation([A, B], Es),
    member(E, Es),
    step(E, S, E1, S1, X).
step_construct(rpi(Vs, E0), S, E1, S1, X) :-
    fresh(Vs, E0, E, Choices),
    findall(Choices, chosen(Choices, S, X), All0),
    random_permutation(All0, All),
    member(Choices, All),
    step(E, S, E1, S1, X).
step_construct(rpi(V, D, E), S, E1, S1, X) :-
    step_construct(rpi((V, D), E), S, E1, S1, X).
step_construct(rconc(A, B), S, rconc(A1, B1), S1, X) :-
    random_permutation([left, right], Sides),
    member(Side, Sides),
    side_step(Side, A, B, S, A1, B1, S1, X).
step_construct(rconc(Es0), S, rconc([E|Es]), S1, X) :-
    random_permutation(Es0, Es1),
    one_step(Es1, S, E, Es, S1, X).
step_construct(rrobin(Es0), S, rrobin(Es), S1, X) :-
    one_step(Es0, S, E, Rest, S1, X),
    append(Rest, [E], Es).
step_construct(atomic(E), S, '$atomic'(E1), S1, X) :-
    step(E, S, E1, S1, X).
step_construct('$atomic'(E), S, '$atomic'(E1), S1, X) :-
    step(E, S, E1, S1, X).
step_construct(for(V, D, E), S, E1, S1, X) :-
    for_program(V, D, E, S, X, Es),
    step(Es, S, E1, S1, X).
step_construct(??(P), S, [], S1, X) :-
    holds(P, S, X),
    marked(test(P), S, S1).
step_construct(exogint(E, P), S, exogint(E1, P), S1, X) :-
    step(E, S, E1, S1, X).

% What the domain may define otherwise

step_construct(wait, S, [], S1, _) :-
    marked(wait, S, S1).
step_construct(wait_exog, S, [], S1, _) :-
    marked(wait, S, S1).
step_construct(commit, S, [], S1, _) :-
    marked(commit, S, S1).
step_construct(branch(P), S, [], S1, _) :-
    marked(branch(P), S, S1).
step_construct(abort, S, [], S1, _) :-
    marked(abort, S, S1).
step_construct(abort(P), S, [], S1, X) :-
    done(e(P, false), S, S1, X).
step_construct(e(F0, V0), S, [], S1, X) :-
    evaluated_arguments(F0, F, S, X),
    evaluated_arguments(v(V0), v(V), S, X),
    done(e(F, V), S, S1, X).
step_construct(set(F0), S, [], S1, X) :-
    evaluated_arguments(F0, F, S, X),
    done(set(F), S, S1, X).
step_construct(unset(F0), S, [], S1, X) :-
    evaluated_arguments(F0, F, S, X),
    done(unset(F), S, S1, X).
step_construct(sim(A0), S, [], S1, X) :-
    evaluated_arguments(A0, A, S, X),
    done(sim(A), S, S1, X).
step_construct(time(E, Seconds), S, E1, S1, X) :-
    catch(call_with_time_limit(Seconds, once(step(E, S, E1, S1, X))),
          time_limit_exceeded, fail).
step_construct(ttime(E, Seconds), S, ttime(E1, Seconds), S1, X) :-
    step_construct(time(E, Seconds), S, E1, S1, X).
step_construct(sync(Es), S, sync(Es1), S1, X) :-
    same_action(Es, S, Es1, S1, _, X).
step_construct(together(As0), S, [], S1, X) :-
    must_be(list, As0),
    context_module(X, M),
    actions_now(As0, As, S, X, M),
    sort(As, Step),
    Step = [_|_],
    step_done(Step, S, S1, X).

actions_now([], [], _, _, _).
actions_now([A0|As0], [A|As], S, X, M) :-
    (   var(A0)
    ->  unbound_program(X)
    ;   is_kind(action, A0, M)
    ->  action_now(A0, A, S, X, M)
    ;   unknown_program(A0, X)
    ),
    actions_now(As0, As, S, X, M).

%   step_within(+Note, +Program0, +Situation0, -Program, -Situation, +Context)
%   is nondet: an online run knows also of the later steps what Note says. Of
%   a procedure whose last part is a procedure nothing is left but that part.

step_within(Note, E, S, E1, S1, X) :-
    noted(Note, X),
    step(E, S, E2, S1, X),
    (   is_recorded(X),
        \+ ( Note = proc(_), E2 = '$within'(proc(_), _) )
    ->  E1 = '$within'(Note, E2)
    ;   E1 = E2
    ).

for_program(V, D, E, S, X, Es) :-
    findall(Value, domain_value(Value, D, S, X), Values),
    for_each(Values, V, E, Es).

for_each([], _, _, []).
for_each([Value|Values], V, E0, [E|Es]) :-
    fresh(V, E0, E, [Value-_]),
    for_each(Values, V, E0, Es).

% Concurrency: while an atomic/1 is under way, only its program takes steps

%   side_step(+Side, +A0, +B0, +S0, -A, -B, -S, +X) is nondet: the program on
%   Side takes a step.

side_step(left, A0, B, S0, A, B, S, X) :-
    \+ in_atom(B, S0, X),
    step(A0, S0, A, S, X).
side_step(right, A, B0, S0, A, B, S, X) :-
    \+ in_atom(A, S0, X),
    step(B0, S0, B, S, X).

%   An online run takes turns: after a step of the first program the second
%   one comes first. Offline, all orders are enumerated anyway.

turn_taken(Side, A0, B0, S0, E, S, X) :-
    side_step(Side, A0, B0, S0, A, B, S, X),
    (   Side == left,
        context_option(online, X)
    ->  E = '$turn'(A, B)
    ;   E = conc(A, B)
    ).

%   one_step(+Es, +S0, -E, -Rest, -S, +X) is nondet: one of Es takes a step to
%   E, and Rest are the others.

one_step(Es, S0, E, Rest, S, X) :-
    select(E0, Es, Rest),
    \+ ( member(Other, Rest), in_atom(Other, S0, X) ),
    step(E0, S0, E, S, X).

%   first_step(+Es0, +S0, -Es, -S, +X) is nondet: the first of Es0 that can
%   take a step takes it.

first_step(Es0, S0, Es, S, X) :-
    (   select(E0, Es0, E, Es1),
        in_atom(E0, S0, X)
    ->  Es = Es1,
        step(E0, S0, E, S, X)
    ;   first_of(Es0, S0, Es, S, X)
    ).

first_of([E0|Es0], S0, [E|Es], S, X) :-
    (   step(E0, S0, E1, S1, X)
    *-> E = E1,
        Es = Es0,
        S = S1
    ;   E = E0,
        noted(above(E0), X),
        first_of(Es0, S0, Es, S, X)
    ).

%!  in_atom(+Program, +Situation, +Context) is semidet.
%
%   True if an atomic/1 in Program is under way, and Program may not end.

in_atom(E, S, X) :-
    nonvar(E),
    (   E = '$atomic'(_)
    ;   (   E = '$path'(Part, _, _, _)
        ;   parts(E, _, Parts, _, _),
            member(Part, Parts)
        ),
        in_atom(Part, S, X)
    ),
    \+ is_final(E, S, X),
    !.

%   When none of them can take a step, the interrupts stop. What one of them
%   has begun is still to be ended.

stopped([], [], _).
stopped([E0|Es0], E, X) :-
    without_interrupts(E0, E1, X),
    stopped(Es0, E2, X),
    (   E1 == []
    ->  E = E2
    ;   E2 == []
    ->  E = E1
    ;   E = pconc(E1, E2)
    ).

without_interrupts(E0, E, X) :-
    (   var(E0)
    ->  E = E0
    ;   ( E0 = interrupt(_, _) ; E0 = interrupt(_, _, _) )
    ->  E = []
    ;   E0 = [First0|Rest0]
    ->  without_interrupts(First0, First, X),
        without_interrupts(Rest0, Rest, X),
        (   First == []
        ->  E = Rest
        ;   E = [First|Rest]
        )
    ;   E0 \= prioritized_interrupts(_),
        parts(E0, Use, Es0, Es, E1),
        Use \== first,
        is_construct(E0, X)
    ->  all_without_interrupts(Es0, Es, X),
        E = E1
    ;   E = E0
    ).

all_without_interrupts([], [], _).
all_without_interrupts([E0|Es0], [E|Es], X) :-
    without_interrupts(E0, E, X),
    all_without_interrupts(Es0, Es, X).

%   Program is a construct, and not what the domain means by its name.

is_construct(E, X) :-
    (   construct(E)
    ->  true
    ;   context_module(X, M),
        \+ domain_names(E, M)
    ).

%   All programs take the same action; tests before it are each one's own.

same_action([], S, [], S, _, _).
same_action([E|Es], S, [E1|Es1], S1, A, X) :-
    to_action(E, S, E1, S2, A, X),
    (   Es == []
    ->  Es1 = [],
        S1 = S2
    ;   same_action(Es, S, Es1, S1, A, X)
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

%!  is_preempted(+Program0, +Program, +Situation, +Context) is semidet.
%
%   Program0 has taken the step to Program that Context has recorded. True if
%   in Situation a part with a higher priority than the one that took the step
%   can take a step, too. Not if the step is part of an atomic/1.

is_preempted(E0, E, S, X) :-
    \+ ( atom_in(E, Inner),
         \+ ( atom_in(E0, Inner0), Inner0 =@= Inner ) ),
    recorded_step(X, _, Notes),
    higher_can_step(Notes, S, X).

%!  higher_can_step(+Notes, +Situation, +Context) is semidet.
%
%   True if in Situation a part can take a step that has a higher priority
%   than the step of which Notes were recorded.

higher_can_step(Notes, S, X) :-
    stepping(X, X1),
    member(above(Higher), Notes),
    \+ \+ step(Higher, S, _, _, X1),
    !.

atom_in(E, Inner) :-
    nonvar(E),
    (   E = '$atomic'(Inner)
    ;   (   E = '$path'(Part, _, _, _)
        ;   parts(E, _, Parts, _, _),
            member(Part, Parts)
        ),
        atom_in(Part, Inner)
    ).

% ---------------- RUN

%!  run(+Program, +Situation0, -Situation, +Length, +Context) is nondet.
%
%   True if Program can run from Situation0 to its end in Situation. Length is
%   `any`, or at(Count, History): the history of Situation is that, so that
%   steps which lead elsewhere are given up.

run(E0, S0, S, Length, X) :-
    simplified(E0, E, X),
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

%!  simplified(+Program0, -Program, +Context) is det.
%
%   Program is Program0 without the empty programs that actions and tests have
%   left where the next step may begin. So a step of Program always makes a
%   difference to it.

simplified(E0, E, X) :-
    (   var(E0)
    ->  E = E0
    ;   E0 = (A : B)
    ->  simplified([A, B], E, X)
    ;   E0 = [First0|Rest]
    ->  simplified(First0, First, X),
        (   First \== []
        ->  E = [First|Rest]
        ;   Rest = [Last]
        ->  simplified(Last, E, X)
        ;   simplified(Rest, E, X)
        )
    ;   parts(E0, _, Es0, Es, E1),
        is_construct(E0, X)
    ->  all_simplified(Es0, Es, X),
        (   E1 = '$within'(_, [])
        ->  E = []
        ;   E = E1
        )
    ;   E0 = '$path'(Rest, [], _, _),
        simplified(Rest, [], X)
    ->  E = []
    ;   E = E0
    ).

all_simplified([], [], _).
all_simplified([E0|Es0], [E|Es], X) :-
    simplified(E0, E, X),
    all_simplified(Es0, Es, X).

%!  program_shown(+Program0, -Program) is det.
%
%   Program is Program0 as the program's author knows it: without marks of
%   the interpreter.

program_shown(E0, E) :-
    (   \+ compound(E0)
    ->  E = E0
    ;   shown(E0, E1)
    ->  program_shown(E1, E)
    ;   mapped(program_shown, E0, E)
    ).

shown('$turn'(A, B), conc(A, B)).
shown('$atomic'(E), atomic(E)).
shown('$within'(_, E), E).
shown('$path'(E, _, _, _), search(E)).
