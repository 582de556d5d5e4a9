:- module(ev3dev_golog_why_not,
          [ hindrance/5,                % +Action, +Program, -Why, +Situation,
                                        % +Context
            more_words/4,               % +Why, +Action, +Module, -Text
            undeclared_words/4,         % +Kind, +Term, +Module, -Text
            fluent_why/5                % +Fluent, +History, -Why, +Situation,
                                        % +Context
          ]).
:- use_module(library(lists), [append/3, member/2]).
:- use_module(context,
              [context_module/2, in_mode/3, recorded_step/3, recording/4]).
:- use_module(branches, [fluent_in/4]).
:- use_module(conditions, [holds/3]).
:- use_module(ground, [conjunction/3]).
:- use_module(progression, [done/4, situation/3]).
:- use_module(situation, [set_by/3, situation_count/2, situation_history/2]).
:- use_module(values, [evaluated_arguments/4, fluent_value/4, value/5]).
:- use_module(programs, [fresh/4, in_books/2, parts/5]).
:- use_module(theory,
              [ has_clauses/2, has_situations/1, has_step_rules/1,
                is_exogenous/2, is_fluent/2, is_kind/3,
                located_precondition/4, precondition/3, proc_body/3,
                restored/3
              ]).
:- use_module(steps, [step_after/5]).
:- use_module(transitions, [step/5]).
:- use_module(hints, [meant_words/4]).
:- use_module('../errors/error_texts', [clause_place/2, place_text/2]).

/** <module> Why an action is not done, and why a fluent has its value
*/

%!  hindrance(+Action, +Program, -Why, +Situation, +Context) is semidet.
%
%   Why is the first that keeps Program from doing Action next in Situation; a
%   sorted list of actions is a step. Fails if nothing does. What Why is,
%   library(ev3dev/golog) says, why_not/2.

hindrance(A, E, Why, S, X) :-
    context_module(X, M),
    (   A = [_|_],
        is_list(A)
    ->  (   member(Part, A),
            not_possible(Part, Why0, S, X, M)
        ->  Why = part(Part, Why0)
        ;   not_a_step(A, Why0, S, X)
        ->  Why = Why0
        ;   hindered(A, E, Why, S, X)
        )
    ;   not_possible(A, Why0, S, X, M)
    ->  Why = Why0
    ;   has_step_rules(M),
        not_a_step(A, Why0, S, X)
    ->  Why = Why0
    ;   hindered(A, E, Why, S, X)
    ).

not_possible(A, Why, S, X, M) :-
    (   \+ is_declared(action, A, M)
    ->  (   static_failure(A, Failure, M)
        ->  Why = not_possible([Failure])
        ;   Why = no_action
        )
    ;   \+ possible(A, S, X, M),
        findall(Failure, failure(A, Failure, S, X, M), Failures),
        Why = not_possible(Failures)
    ).

%   The rules of steps forbid it.

not_a_step(A, not_a_step(Rule, Values), S, X) :-
    step_after(A, S, _, Rule0, X),
    nonvar(Rule0),
    (   Rule0 = always(P)
    ->  done(A, S, S1, X),
        false_part(P, Part, S1, X),
        values_in(Part, Values, S1, X),
        Rule = always(Part)
    ;   Rule = Rule0,
        Values = []
    ).

possible(A, S, X, M) :-
    M:prim_action(A),
    precondition(A, Condition, M),
    holds(Condition, S, X).

is_declared(Kind, Term, M) :-
    is_kind(Kind, Term, M),
    (   declaration(Kind, Term, Head),
        has_clauses(M, Head),
        call(M:Head)
    ->  true
    ).

declaration(action, A, prim_action(A)).
declaration(fluent, F, prim_fluent(F)).
declaration(fluent, F, rel_fluent(F)).
declaration(fluent, F, fun_fluent(F)).

%   Each clause of poss/2 for the action, and what is false in it: a goal of
%   its body, or a part of its condition.

failure(A, failure(Part, Values, Place), S, X, M) :-
    (   has_situations(M)
    ->  located_precondition(A, Condition, Place, M),
        Body = true
    ;   has_clauses(M, poss(_, _)),
        clause(M:poss(A, Condition), Body, Ref),
        clause_place(Ref, Place)
    ),
    (   \+ call(M:Body)
    ->  false_goal(Body, M, Part),
        Values = []
    ;   call(M:Body),
        false_part(Condition, Part, S, X),
        values_in(Part, Values, S, X)
    ).

%   What does not change of a precondition in PDDL is a part of the
%   declaration.

static_failure(A, failure(Part, [], Place), M) :-
    is_kind(action, A, M),
    clause(M:prim_action(A), Body, _),
    false_goal(Body, M, Part),
    Part = pddl_fact(_),
    clause(M:poss(A, _), _, Ref),
    clause_place(Ref, Place),
    !.

%   false_goal(+Body, +Module, -Part) is semidet: Part is the first goal of
%   Body that fails.

false_goal(Body, M, Part) :-
    (   Body = (A, B)
    ->  (   call(M:A)
        ->  false_goal(B, M, Part)
        ;   false_goal(A, M, Part)
        )
    ;   \+ call(M:Body),
        Part = Body
    ).

%!  more_words(+Why, +Action, +Module, -Text) is det.
%!  undeclared_words(+Kind, +Term, +Module, -Text) is det.
%
%   Text goes on where the message of Why for Action ends: why the domain has
%   no such action, or has no precondition for it. The second one says so of a
%   Term that is no Kind, `action` or `fluent`.

more_words(Why, A, M, Text) :-
    (   Why = part(Part, Why1)
    ->  more_words(Why1, Part, M, Text)
    ;   Why == no_action
    ->  undeclared_words(action, A, M, Text)
    ;   Why == not_possible([]),
        functor(A, Name, Arity),
        functor(General, Name, Arity),
        has_clauses(M, poss(_, _)),
        clause(M:poss(General, _), _, Ref)
    ->  clause_place(Ref, Place),
        place_text(Place, Where),
        format(atom(Text), ', only for other arguments~w', [Where])
    ;   Text = ''
    ).

undeclared_words(Kind, Term, M, Text) :-
    (   is_kind(Kind, Term, M),
        functor(Term, Name, Arity),
        functor(General, Name, Arity),
        declaration(Kind, General, Head),
        has_clauses(M, Head),
        clause(M:Head, _, Ref)
    ->  clause_place(Ref, Place),
        place_text(Place, Where),
        (   declaration(Kind, Term, Head1),
            has_clauses(M, Head1),
            clause(M:Head1, Body, Ref1),
            false_goal(Body, M, Part)
        ->  clause_place(Ref1, Place1),
            place_text(Place1, Where1),
            format(atom(Text), ': ~p does not hold~w', [Part, Where1])
        ;   format(atom(Text), ', only with other arguments~w', [Where])
        )
    ;   Kind == action,
        is_exogenous(Term, M)
    ->  Text = ': it is an exogenous one, which happens by itself'
    ;   meant_words(Kind, Term, M, Text)
    ).

%   false_part(+Condition, -Part, +Situation, +Context) is semidet: Part is
%   that of a conjunction which is false, if those before it hold.

false_part(P, Part, S, X) :-
    (   nonvar(P),
        conjunction(P, Q, R)
    ->  (   \+ holds(Q, S, X)
        ->  false_part(Q, Part, S, X)
        ;   \+ ( holds(Q, S, X), holds(R, S, X) ),
            once(holds(Q, S, X)),
            false_part(R, Part, S, X)
        )
    ;   nonvar(P),
        in_books(P, Q)
    ->  false_part(Q, Part, S, X)
    ;   context_module(X, M),
        nonvar(P),
        is_kind(proc, P, M),
        \+ is_kind(fluent, P, M),
        findall(Body, proc_body(P, Body, M), [Body])
    ->  false_part(Body, Part, S, X)
    ;   \+ holds(P, S, X),
        Part = P
    ).

values_in(P, Values, S, X0) :-
    in_mode(possible, X0, X),
    findall(F = V,
            ( fluent_in(P, F, S, X), ground(F), F \= '$VAR'(_),
              fluent_value(F, V, S, X) ),
            Values0),
    sort(Values0, Values).

%   The action is possible. What does the program do instead?

hindered(A, E, Why, S, X0) :-
    recording(0, ev3dev_golog_why_not:true, X0, X),
    (   next_entry(E, S, X, Next, Interrupts)
    ->  (   Next = A
        ->  fail
        ;   can_do(A, E, S, X0)
        ->  Why = before(Next, Interrupts)
        ;   lower(E, Part),
            can_do(A, Part, S, X0)
        ->  Why = priority(Next, Interrupts)
        ;   not_begun(A, E, Why0, S, X0)
        ->  Why = Why0
        ;   Why = not_offered
        )
    ;   not_begun(A, E, Why0, S, X0)
    ->  Why = Why0
    ;   Why = not_offered
    ).

:- public true/2.

true(_, _).

%   The next entry of the history, if the program goes on by its first steps

next_entry(E, S, X, Next, Interrupts) :-
    next_entry(E, S, X, 20, Next, Interrupts).

next_entry(E, S, X, Most, Next, Interrupts) :-
    once(step(E, S, E1, S1, X)),
    situation_count(S, C),
    situation_count(S1, C1),
    (   C1 =:= C
    ->  Most > 0,
        Less is Most-1,
        next_entry(E1, S1, X, Less, Next, Interrupts)
    ;   situation_history(S1, [Next|_]),
        recorded_step(X, _, Notes),
        findall(P, member(interrupt(P), Notes), Interrupts)
    ).

can_do(A, E, S, X) :-
    situation_count(S, C0),
    step(E, S, _, S1, X),
    situation_count(S1, C1),
    C1 > C0,
    situation_history(S1, [A|_]),
    !.

%   A part of the program that another part comes before

lower(E, Part) :-
    nonvar(E),
    (   (   E = prioritized_interrupts([_|Lower])
        ;   E = pconc(_, Last),
            Lower = [Last]
        ),
        member(Part, Lower)
    ;   parts(E, _, Parts, _, _),
        member(Inner, Parts),
        lower(Inner, Part)
    ).

%   An interrupt would do it, but its condition does not hold.

not_begun(A, E, interrupt(Part, Values), S, X) :-
    interrupt_in(E, Vs, P, Body0),
    fresh(Vs, P-Body0, Condition-Body, _),
    \+ holds(Condition, S, X),
    can_do(A, Body, S, X),
    !,
    false_part(Condition, Part, S, X),
    values_in(Part, Values, S, X).

interrupt_in(E, Vs, P, Body) :-
    nonvar(E),
    (   E = interrupt(P, Body),
        Vs = []
    ;   E = interrupt(Vs, P, Body)
    ;   parts(E, _, Parts, _, _),
        member(Part, Parts),
        interrupt_in(Part, Vs, P, Body)
    ).

%!  fluent_why(+Fluent, +History, -Why, +Situation, +Context) is semidet.
%
%   Why is as why/2 of library(ev3dev/journal) says. History has the newest
%   entries of Situation. In a domain with situations, Fluent is a condition.

fluent_why(F, History, fluent(V, By), S, X0) :-
    in_mode(stored, X0, X),
    context_module(X, M),
    situation_count(S, Count),
    (   is_kind(fluent, F, M)
    ->  is_fluent(F, M),
        value(F, V, S, X, M),
        (   set_by(F, S, C)
        ->  true
        ;   C = 0
        )
    ;   \+ \+ restored(F, _, M),
        truth(F, V, S, X),
        changed(F, V, History, Count, C, X)
    ),
    (   C =:= 0
    ->  By = initially(Place),
        ( is_said(initially(F, V), M, Place) -> true ; Place = none )
    ;   Skip is Count-C,
        length(Newer, Skip),
        append(Newer, [Entry|Before], History)
    ->  By = entry(C, Entry, Place),
        (   by_clause(Entry, F, V, Before, X, M, Place)
        ->  true
        ;   Place = none
        )
    ;   By = entry(C, unknown, none)
    ).

truth(P, Truth, S, X) :-
    ( holds(P, S, X) -> Truth = true ; Truth = false ).

%   The last entry after which the truth of P was another one than before

changed(P, V, History, Count, C, X) :-
    (   History = [_|Before],
        situation(Before, S, X),
        truth(P, V, S, X)
    ->  Count1 is Count-1,
        changed(P, V, Before, Count1, C, X)
    ;   History == []
    ->  C = 0
    ;   C = Count
    ).

by_clause(Entry, F, V, Before, X, M, Place) :-
    (   V == true,
        Head = causes_true(Entry, F, P)
    ;   V == false,
        Head = causes_false(Entry, F, P)
    ;   Head = causes_val(Entry, F, V, P)
    ;   Head = causes(Entry, F, V, P)
    ;   Entry = e(A, Outcome),
        Head = senses(A, Outcome, F, V, P)
    ),
    situation(Before, S, X),
    is_said(Head, M, Place),
    \+ \+ holds(P, S, X),
    !.
by_clause(Entry, F, true, Before, X, M, Place) :-
    restored(F, Body, M),
    situation([Entry|Before], S, X),
    evaluated_arguments(Body, Goal, S, X),
    is_said(Goal, M, Place).

is_said(Head, M, Place) :-
    has_clauses(M, Head),
    clause(M:Head, Body, Ref),
    \+ \+ call(M:Body),
    clause_place(Ref, Place).
