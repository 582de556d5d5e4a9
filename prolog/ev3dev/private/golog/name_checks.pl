:- module(ev3dev_golog_name_checks, []).
:- use_module(library(lists), [member/2]).
:- use_module(hints, [declared_hint/4]).
:- use_module(theory, [has_clauses/2, is_kind/3]).
:- use_module('../errors/error_texts', [clause_place/2, place_first/2]).

/** <module> What a domain says is about its own actions and fluents

An effect, a precondition or an initial value of what is not declared changes
nothing: the name is most likely misspelt. Each such clause is a warning
before the first step, with its place, and again when its file has changed.
*/

:- multifile ev3dev_golog_theory:checked/1.

ev3dev_golog_theory:checked(M) :-
    about(Head, Named),
    has_clauses(M, Head),
    \+ predicate_property(M:Head, imported_from(ev3dev_golog)),
    catch(clause(M:Head, Body, Ref), _, fail),
    Body \== fail,
    member(Name, Named),
    undeclared(Name, M, Kind, Term),
    clause_place(Ref, Place),
    place_first(Place, Where),
    declared_hint(Kind, Term, M, What),
    functor(Head, Predicate, Arity),
    format(atom(Text), '~w~w/~w: ~w', [Where, Predicate, Arity, What]),
    warned_once(M, Text, Place),
    fail.

%   about(?Head, ?Named): a clause with Head is about what Named has.

about(poss(A, _), [action(A)]).
about(initially(F, _), [fluent(F)]).
about(causes_val(A, F, _, _), [entry(A), fluent(F)]).
about(causes_true(A, F, _), [entry(A), fluent(F)]).
about(causes_false(A, F, _), [entry(A), fluent(F)]).
about(causes(A, F, _, _), [entry(A), fluent(F)]).
about(forget(A, F), [entry(A), fluent(F)]).
about(senses(A), [action(A)]).
about(senses(A, F), [action(A), fluent(F)]).
about(senses(A, _, F, _, _), [action(A), fluent(F)]).
about(settles(A, _, F, _, _), [action(A), fluent(F)]).
about(rejects(A, _, F, _, _), [action(A), fluent(F)]).
about(sensed_values(F, _), [fluent(F)]).
about(action_cost(A, _), [action(A)]).
about(robot_action(A, _), [action(A)]).
about(robot_sense(A, _, _), [action(A)]).
about(robot_exog(A, _), [exogenous(A)]).

%   undeclared(+Named, +Module, -Kind, -Term) is semidet: Term, which a clause
%   names, is no Kind of the domain.

undeclared(entry(Entry), M, Kind, Term) :-
    nonvar(Entry),
    \+ is_declared(action, Entry, M),
    (   what_became(Entry, A)
    ->  (   is_list(A)
        ->  member(Part, A),
            undeclared(action(Part), M, Kind, Term)
        ;   undeclared(action(A), M, Kind, Term)
        )
    ;   \+ memberchk(Entry, [sim(_), set(_), unset(_), e(_, _)]),
        has_any(action, M),
        Kind = action,
        Term = Entry
    ),
    !.
undeclared(Named, M, Kind, Term) :-
    Named =.. [Kind, Term],
    Kind \== entry,
    nonvar(Term),
    has_any(Kind, M),
    \+ is_declared(Kind, Term, M).

%   A domain that declares none is one in a notation of its own, or is asked
%   only what holds.

has_any(action, M) :-
    has_clauses(M, prim_action(_)),
    !.
has_any(fluent, M) :-
    member(Head, [prim_fluent(_), rel_fluent(_), fun_fluent(_)]),
    has_clauses(M, Head),
    !.
has_any(exogenous, _).

what_became(failed(A), A).
what_became(interrupted(A), A).

is_declared(action, A, M) :-
    (   is_kind_now(action, A, M)
    ->  true
    ;   is_kind_now(exogenous, A, M)
    ).
is_declared(exogenous, A, M) :-
    is_kind_now(exogenous, A, M).
is_declared(fluent, F, M) :-
    (   is_kind_now(fluent, F, M)
    ->  true
    ;   is_kind_now(derived, F, M)
    ).

%   A declaration may be a rule that is not complete yet.

is_kind_now(Kind, Term, M) :-
    catch(is_kind(Kind, Term, M), error(_, _), true).

%   Each thread has notes of its own on a domain.

:- dynamic warned/3.                    % Module, Text, Stamp
:- volatile warned/3.

warned_once(M, Text, Place) :-
    (   Place = File:_,
        source_file_property(File, modified(Stamp0))
    ->  Stamp = Stamp0
    ;   Stamp = none
    ),
    (   warned(M, Text, Stamp)
    ->  true
    ;   retractall(warned(M, Text, _)),
        assertz(warned(M, Text, Stamp)),
        print_message(warning, golog(undeclared(Text)))
    ).
