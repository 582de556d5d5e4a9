:- module(ev3dev_golog_branches,
          [ sensed_later/4,             % +Action, +Situation0, -Situation,
                                        % +Context
            fluent_in/4,                % +Condition, -Fluent, +Situation,
                                        % +Context
            opened/4,                   % +Condition, +Situation0, -Situation,
                                        % +Context
            holds_if_assumed/4,         % +Condition, +Fluent, +Situation,
                                        % +Context
            branch_on/3                 % +Fluent, +Condition, +Context
          ]).
:- use_module(library(lists), [member/2]).
:- use_module(context, [context_module/2, entered/4]).
:- use_module(programs, [condition_construct/1]).
:- use_module(situation, [all_open/3, is_assumed/3, marked/3]).
:- use_module(theory,
              [ derived_rule/4, domain_list/3, has_clauses/2, is_fluent/2,
                is_kind/3,
                is_sensing_action/2, located/3, proc_body/3
              ]).
:- use_module(values, [known_or_declared/3, value/5]).
:- use_module('../errors/errors', [throw_error/3]).

/** <module> Branches for what will be sensed

A conditional plan is made before its actions have sensed anything. After a
sensing action the value of its fluent is '$sensed'. A condition that depends
on it cannot be decided, but its cases can be assumed one by one:
'$golog_branch'(Cases) is thrown, and the planner goes on in each. So a plan
never relies on a value that it does not test. A case is Test-Assumption; the
Test of the last may be `else`.
*/

%!  sensed_later(+Action, +Situation0, -Situation, +Context) is det.
%
%   Action has been done in Situation0, and what it senses is open. If it
%   senses anything, the history gets a mark, so that no plan goes on.

sensed_later(A, S0, S, Context) :-
    context_module(Context, M),
    findall(F, sensed_fluent(A, F, M), Fs),
    (   Fs == []
    ->  S = S0
    ;   marked('$sensed', S0, S1),
        all_open(Fs, S1, S)
    ).

sensed_fluent(A, F, M) :-
    is_sensing_action(A, M),
    (   M:senses(A, F)
    ;   M:senses(A, _, F, _, _)
    ),
    ( ground(F) -> true ; is_fluent(F, M) ).

%!  opened(+Condition, +Situation0, -Situation, +Context) is det.
%
%   The values of the fluents in Condition are open, whatever they are in
%   Situation0.

opened(P, S0, S, Context) :-
    (   ground(P),
        \+ quantified(P)
    ->  findall(F, fluent_in(P, F, S0, Context), Fs),
        all_open(Fs, S0, S)
    ;   no_branch(P, 'it has variables', Context)
    ).

quantified(P) :-
    compound(P),
    (   functor(P, Name, Arity),
        memberchk(Name/Arity, [some/2, some/3, all/2, all/3])
    ->  true
    ;   arg(_, P, Q),
        quantified(Q)
    ).

%!  fluent_in(+Condition, -Fluent, +Situation, +Context) is nondet.
%
%   Condition asks for the value of Fluent.

fluent_in(P, F, S, Context) :-
    callable(P),
    context_module(Context, M),
    (   \+ condition_construct(P),
        is_kind(proc, P, M)
    ->  proc_body(P, Body, M),
        entered(condition, P, Context, Context1),
        fluent_in(Body, F, S, Context1)
    ;   \+ condition_construct(P),
        is_kind(derived, P, M)
    ->  catch(entered(derived, P, Context, Context1),
              error(domain_error(golog_procedure, _), _), fail),
        derived_rule(_, P, Body, M),
        fluent_in(Body, F, S, Context1)
    ;   is_kind(fluent, P, M),
        arguments_known(P, F, S, Context, M),
        known_or_declared(F, S, M)
    ;   compound(P),
        arg(_, P, Q),
        fluent_in(Q, F, S, Context)
    ).

%!  holds_if_assumed(+Condition, +Fluent, +Situation, +Context) is semidet.
%
%   The value of Fluent is open. True if Condition is assumed to hold.

holds_if_assumed(P0, F, S, Context) :-
    context_module(Context, M),
    (   P0 == F
    ->  P = F
    ;   arguments_known(P0, P1, S, Context, M),
        value_last(P1, P)
    ),
    (   is_assumed(P, S, Truth)
    ->  Truth == true
    ;   branch_on(F, P, Context)
    ).

value_last(P0, P) :-
    (   nonvar(P0),
        ( P0 = (Value = F) ; P0 = (Value == F) ),
        atomic(Value),
        compound(F)
    ->  P = (F = Value)
    ;   P = P0
    ).

%!  branch_on(+Fluent, +Condition, +Context)
%
%   Throw the cases in which Condition is to be planned for, as the value of
%   Fluent is open: its values if the domain names them, else that Condition
%   holds, and that it does not. Condition is `none` if Fluent is needed for
%   something else, such as the argument of an action.
%
%   @error domain_error(golog_branch, Condition) if it has variables, or
%          Fluent

branch_on(F, P, Context) :-
    (   cases(F, P, Context, Cases)
    ->  throw('$golog_branch'(Cases))
    ;   P == none
    ->  no_branch(F, 'an action or an effect needs its value', Context)
    ;   no_branch(P, 'it has variables', Context)
    ).

cases(F, _, Context, Cases) :-
    context_module(Context, M),
    (   is_kind(relational, F, M)
    ->  Cases = [F-is(F, true), else-is(F, false)]
    ;   has_clauses(M, sensed_values(_, _)),
        M:sensed_values(F, Sort)
    ->  domain_list(Sort, M, Values),
        findall((F = V)-is(F, V), member(V, Values), Cases)
    ).
cases(F, P, _, [P-Case, else-holds(P, false)]) :-
    P \== none,
    ground(P),
    (   P == F
    ->  Case = is(F, true)
    ;   ( P = (Of = Value) ; P = (Of == Value) ),
        Of == F,
        atomic(Value)
    ->  Case = is(F, Value)
    ;   Case = holds(P, true)
    ).

%   Fluents with a known value are replaced by it.

with_known(T0, T, S, Context, M) :-
    arguments_known(T0, T1, S, Context, M),
    (   callable(T1),
        ground(T1),
        is_kind(fluent, T1, M),
        known_or_declared(T1, S, M)
    ->  catch(value(T1, T, S, Context, M), '$golog_unknown'(_), T = T1)
    ;   T = T1
    ).

arguments_known(T0, T, S, Context, M) :-
    (   compound(T0)
    ->  T0 =.. [Name|As0],
        all_known(As0, As, S, Context, M),
        T =.. [Name|As]
    ;   T = T0
    ).

all_known([], [], _, _, _).
all_known([A0|As0], [A|As], S, Context, M) :-
    with_known(A0, A, S, Context, M),
    all_known(As0, As, S, Context, M).

no_branch(P, Why, Context) :-
    context_module(Context, M),
    located(M, in_program([P]), Where),
    format(atom(Text), '~wno plan can branch on ~p, which is still to be \c
                        sensed: ~w. A sensed_values/2 for the fluent would \c
                        help', [Where, P, Why]),
    throw_error(domain_error(golog_branch, P), _, Text).
