:- module(ev3dev_golog_conditions,
          [ holds/3,                    % +Condition, +Situation, +Context
            holds_once/3,               % +Condition, +Situation, +Context
            all_hold/3,                 % +Conditions, +Situation, +Context
            chosen/3,                   % +Choices, +Situation, +Context
            domain_value/4              % -Value, +Domain, +Situation,
                                        % +Context
          ]).
:- use_module(library(lists), [member/2]).
:- use_module(branches, [holds_if_assumed/4]).
:- use_module(context,
              [ call_of/3, context_effort/2, context_mode/2, context_module/2,
                context_option/2, dual/2, entered/4, in_mode/3, place_in/3,
                with_option/3
              ]).
:- use_module(effort, [asks_history/1, polled/1]).
:- use_module(programs,
              [ closed/1, condition_construct/1, fresh/4, in_books/2,
                negated/2
              ]).
:- use_module(situation, [was_done/2]).
:- use_module(theory,
              [ derived_rule/4, domain_list/3, is_fluent/2, is_kind/3,
                names_fluent/2, proc_body/3
              ]).
:- use_module(values,
              [ asks_unknown/3, evaluated_arguments/4, fluent_value/4,
                known_or_declared/3, known_value/4
              ]).
:- use_module('../errors/errors', [throw_error/3]).

/** <module> Conditions

In a domain with possible values a fluent may have '$possible'(Set), two
values or more. A condition is known if it holds for each value, possible
if for some. Each simple condition in it takes the values by itself, so
`known` and `possible` change places under a negation only, and what is
known is true; but or(p, neg(p)) is not known if neither of its parts is.
This is how the evaluator of IndiGolog does it, after Vassos: A
feasible approach to disjunctive knowledge in situation calculus (2005),
and Sardina, Vassos: The Wumpus World in IndiGolog (2005).
*/

:- multifile ev3dev_golog_values:decided/3.

ev3dev_golog_values:decided(Condition, S, Context) :-
    holds_once(Condition, S, Context).

%!  holds(+Condition, +Situation, +Context) is nondet.
%
%   True if Condition holds. A Condition without free variables succeeds once.

holds(P, S, Context) :-
    (   var(P)
    ->  place_in(Context, condition, Where),
        format(atom(Text), '~wa condition is still a variable when it is \c
                            tested', [Where]),
        throw_error(instantiation_error, _, Text)
    ;   closed(P)
    ->  holds_(P, S, Context),
        !
    ;   holds_(P, S, Context)
    ).

holds_(P, S, Context) :-
    (   condition_construct(P)
    ->  holds_construct(P, S, Context)
    ;   in_books(P, Q),
        \+ ( context_module(Context, M),
             (   is_kind(fluent, P, M)
             ;   is_kind(proc, P, M)
             ;   current_predicate(_, M:P)
             ) )
    ->  holds_(Q, S, Context)
    ;   context_mode(Context, Mode),
        (   Mode == plain
        ->  holds_atom(P, S, Context)
        ;   Mode == possible
        ->  (   holds_atom(P, S, Context)
            *-> true
            ;   asks_unknown(P, S, Context)
            )
        ;   Mode == known
        ->  known_atom(P, S, Context)
        ;   catch(holds_atom(P, S, Context), '$golog_unknown'(F),
                  holds_if_assumed(P, F, S, Context))
        )
    ).

holds_atom(P, S, Context) :-
    (   P = _:_
    ->  call_of(P, P, Context)
    ;   context_module(Context, M),
        is_kind(proc, P, M)
    ->  proc_body(P, Body, M),
        entered(condition, P, Context, Context1),
        holds(Body, S, Context1)
    ;   context_module(Context, M),
        is_kind(derived, P, M)
    ->  (   compound(P),
            arg(_, P, Argument),
            names_fluent(Argument, M)
        ->  evaluated_arguments(P, P1, S, Context)
        ;   P1 = P
        ),
        derived_atom(P1, Stratum, M),
        is_derived(P1, Stratum, S, Context)
    ;   context_module(Context, M),
        is_kind(fluent, P, M)
    ->  evaluated_arguments(P, F, S, Context),
        (   known_or_declared(F, S, M)
        ->  fluent_value(F, V, S, Context),
            V == true
        ;   call_of(P, F, Context)
        )
    ;   evaluated_arguments(P, Goal, S, Context),
        call_of(P, Goal, Context)
    ).

%   The derived fluents are the least that their rules make true. They
%   are found by rounds. In one each atom is asked for once, with what is
%   derived so far; it is the last if it derives nothing new. The absence of
%   an atom is asked for in higher strata only, when its own is complete.

:- thread_local
    derived/3,                          % Hash, Id, Atom
    asked/4.                            % Hash, Id, Stratum, Atom

derived_atom(P, Stratum, M) :-
    findall(Stratum-P, derived_rule(Stratum, P, _, M), Atoms0),
    sort(Atoms0, Atoms),
    member(Stratum-P, Atoms).

is_derived(P, Stratum, S, X0) :-
    (   context_option(deriving(Id, Around, S0), X0),
        same_term(S0, S)
    ->  (   Around =:= Stratum
        ->  derived(P, Stratum, Id, S, X0)
        ;   with_option(deriving(Id, Stratum, S), X0, X),
            derived_in_rounds(P, Stratum, Id, S, X)
        )
    ;   flag(ev3dev_golog_derived, Id, Id+1),
        with_option(deriving(Id, Stratum, S), X0, X),
        call_cleanup(once(derived_in_rounds(P, Stratum, Id, S, X)),
                     ( retractall(derived(_, Id, _)),
                       retractall(asked(_, Id, _, _)) ))
    ).

derived_in_rounds(P, Stratum, Id, S, X) :-
    flag(ev3dev_golog_derived_now, Now0, Now0),
    (   derived(P, Stratum, Id, S, X)
    ->  retractall(asked(_, Id, Stratum, _))
    ;   flag(ev3dev_golog_derived_now, Now, Now),
        Now > Now0,
        retractall(asked(_, Id, Stratum, _)),
        derived_in_rounds(P, Stratum, Id, S, X)
    ).

derived(P, Stratum, Id, S, X) :-
    term_hash(P, Hash),
    (   derived(Hash, Id, P)
    ->  true
    ;   \+ asked(Hash, Id, Stratum, P),
        assertz(asked(Hash, Id, Stratum, P)),
        context_module(X, M),
        derived_rule(_, P, Condition, M),
        holds(Condition, S, X)
    ->  assertz(derived(Hash, Id, P)),
        flag(ev3dev_golog_derived_now, Now, Now+1)
    ).

%!  all_hold(+Conditions, +Situation, +Context) is nondet.
%!  holds_once(+Condition, +Situation, +Context) is semidet.

all_hold([], _, _).
all_hold([P|Ps], S, Context) :-
    holds(P, S, Context),
    all_hold(Ps, S, Context).

holds_once(Condition, S, Context) :-
    (   Condition == true
    ->  true
    ;   holds(Condition, S, Context)
    ->  true
    ).

holds_construct(true, _, _).
holds_construct(and(P, Q), S, X) :-
    holds(P, S, X),
    holds(Q, S, X).
holds_construct(and(Ps), S, X) :-
    all_hold(Ps, S, X).
holds_construct(or(P, Q), S, X) :-
    (   holds(P, S, X)
    ;   holds(Q, S, X)
    ).
holds_construct(or(Ps), S, X) :-
    member(P, Ps),
    holds(P, S, X).
holds_construct(neg(P), S, X0) :-
    dual(X0, X),
    \+ holds(P, S, X).
holds_construct(\+ P, S, X) :-
    holds_construct(neg(P), S, X).
holds_construct(not(P), S, X) :-
    holds_construct(neg(P), S, X).
holds_construct((P, Q), S, X) :-
    holds(P, S, X),
    holds(Q, S, X).
holds_construct((P ; Q), S, X) :-
    (   nonvar(P),
        P = (If -> Then)
    ->  holds_if(If, Then, Q, S, X)
    ;   (   holds(P, S, X)
        ;   holds(Q, S, X)
        )
    ).
holds_construct((P -> Q), S, X) :-
    holds_if(P, Q, false, S, X).
holds_construct(impl(P, Q), S, X) :-
    (   holds_construct(neg(P), S, X)
    ;   holds(Q, S, X)
    ).
holds_construct(equiv(P, Q), S, X) :-
    holds_if(P, Q, neg(Q), S, X).
holds_construct(some(Vs, P0), S, X) :-
    fresh(Vs, P0, P, Choices),
    chosen(Choices, S, X),
    holds(P, S, X).
holds_construct(some(V, D, P), S, X) :-
    holds_construct(some((V, D), P), S, X).
holds_construct(all(Vs, P0), S, X0) :-
    fresh(Vs, P0, P, Choices),
    negated(P, N),
    dual(X0, X),
    \+ ( chosen(Choices, S, X0),
         holds(N, S, X) ).
holds_construct(all(V, D, P), S, X) :-
    holds_construct(all((V, D), P), S, X).
holds_construct(done(A0), S, X) :-
    context_effort(X, Effort),
    asks_history(Effort),
    evaluated_arguments(A0, A, S, X),
    was_done(A, S).
holds_construct(haveExecuted(A), S, X) :-
    holds_construct(done(A), S, X).
holds_construct(know(F), S, X0) :-
    in_mode(known, X0, X),
    is_known(F, S, X).
holds_construct(kwhether(F), S, X) :-
    holds_construct(know(F), S, X).
holds_construct(possibly(P), S, X0) :-
    in_mode(possible, X0, X),
    holds(P, S, X).

holds_if(P, Q, R, S, X) :-
    context_mode(X, Mode),
    (   ( Mode == known ; Mode == possible )
    ->  (   holds(and(P, Q), S, X)
        ;   holds(and(neg(P), R), S, X)
        )
    ;   holds(P, S, X)
    ->  holds(Q, S, X)
    ;   holds(R, S, X)
    ).

is_known(F0, S, X) :-
    context_module(X, M),
    evaluated_arguments(F0, F, S, X),
    (   is_kind(fluent, F, M)
    ->  ( ground(F) -> true ; is_fluent(F, M) ),
        known_value(F, _, S, X)
    ;   holds(F0, S, X)
    ->  true
    ;   holds(neg(F0), S, X)
    ).

%   known_atom(+Condition, +Situation, +Context) is nondet. True if Condition,
%   without constructs, holds whichever possible values its fluents have.

known_atom(P, S, Context) :-
    context_module(Context, M),
    (   P \= _:_,
        is_kind(proc, P, M)
    ->  holds_atom(P, S, Context)
    ;   dual(Context, Any),
        findall(P-Case, case(P, S, Any, M, Case), Cases0),
        sort(Cases0, Cases),
        (   Cases = [P-Case]
        ->  is_satisfied(Case, P, Context)
        ;   findall(P,
                    ( member(P-Case, Cases),
                      is_satisfied(Case, P, Context) ),
                    Ps0),
            sort(Ps0, Ps),
            member(P, Ps),
            \+ ( member(P-Case, Cases),
                 \+ is_satisfied(Case, P, Context) )
        )
    ).

%   case(+Condition, +Situation, +Context, +Module, -Case) is nondet: Case is
%   what Condition comes to for some possible values.

case(P, S, X, M, Case) :-
    (   P = _:_
    ->  Case = call(P)
    ;   evaluated_arguments(P, P1, S, X),
        (   is_kind(fluent, P, M),
            known_or_declared(P1, S, M)
        ->  fluent_value(P1, V, S, X),
            Case = is(V)
        ;   Case = call(P1)
        )
    ).

is_satisfied(is(V), _, _) :-
    V == true.
is_satisfied(call(Goal), P, X) :-
    call_of(P, Goal, X).

%!  chosen(?Choices, +Situation, +Context) is nondet.
%
%   Gives each variable of Choices with a domain a value of it, on
%   backtracking each.

chosen([], _, _).
chosen([V-D|Choices], S, Context) :-
    (   D = in(Domain)
    ->  domain_value(V, Domain, S, Context)
    ;   true
    ),
    context_effort(Context, Effort),
    polled(Effort),
    chosen(Choices, S, Context).

%!  domain_value(-Value, +Domain, +Situation, +Context) is nondet.
%
%   Domain is a list, a sort, or a fluent whose value is one of these.

domain_value(Value, Domain0, S, Context) :-
    context_module(Context, M),
    (   is_list(Domain0)
    ->  Domain = Domain0
    ;   callable(Domain0),
        is_kind(fluent, Domain0, M)
    ->  fluent_value(Domain0, Domain, S, Context)
    ;   Domain = Domain0
    ),
    domain_list(Domain, M, Values),
    member(Value, Values).
