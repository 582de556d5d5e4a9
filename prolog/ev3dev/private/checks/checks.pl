:- module(ev3dev_checks,
          [ must_be/2,                  % +Type, ?Term
            must_be_goal/1,             % ?Term
            evaluated/2                 % +Expression, -Number
          ]).
:- use_module('../errors/errors',
              [instantiation_error/1, throw_error/3, type_error/2]).

/** <module> Checks of types, and arithmetic

must_be/2 has the name and the meaning of that in library(error). The pack
does not load that library, because loading it would take a tenth of the time
of loading the pack.
*/

%!  must_be(+Type, ?Term) is det.
%
%   True if Term is of Type: `atom`, `atomic`, `boolean`, `callable`,
%   `ground`, `integer`, `list`, `list(Type)`, `nonneg`, `nonvar`, `number`,
%   `positive_integer` or `text`.
%
%   @error instantiation_error if Term is not instantiated enough
%   @error type_error(Type, Term)

must_be(Type, Term) :-
    (   is_of(Type, Term)
    ->  true
    ;   is_not(Type, Term)
    ).

is_of(nonvar, Term) :- nonvar(Term).
is_of(atom, Term) :- atom(Term).
is_of(atomic, Term) :- atomic(Term).
is_of(text, Term) :- ( atom(Term) -> true ; string(Term) ).
is_of(boolean, Term) :- ( Term == true -> true ; Term == false ).
is_of(number, Term) :- number(Term).
is_of(integer, Term) :- integer(Term).
is_of(nonneg, Term) :- integer(Term), Term >= 0.
is_of(positive_integer, Term) :- integer(Term), Term >= 1.
is_of(callable, Term) :- callable(Term).
is_of(ground, Term) :- ground(Term).
is_of(list, Term) :- is_list(Term).
is_of(list(Type), Term) :- is_list(Term), all_of(Term, Type).

all_of([], _).
all_of([Element|Elements], Type) :-
    is_of(Type, Element),
    all_of(Elements, Type).

is_not(Type, Term) :-
    (   var(Term)
    ;   Type == ground
    ;   memberchk(Type, [list, list(_)]),
        partial_list(Term)
    ),
    !,
    instantiation_error(Term).
is_not(list(Type), Term) :-
    is_list(Term),
    !,
    each_must_be(Term, Type).
is_not(list(_), Term) :-
    !,
    type_error(list, Term).
is_not(Type, Term) :-
    memberchk(Type, [nonneg, positive_integer]),
    \+ integer(Term),
    !,
    type_error(integer, Term).
is_not(boolean, Term) :-
    !,
    type_error(bool, Term).
is_not(Type, Term) :-
    type_error(Type, Term).

each_must_be([Element|Elements], Type) :-
    must_be(Type, Element),
    each_must_be(Elements, Type).

partial_list(Term) :-
    '$skip_list'(_, Term, Tail),
    var(Tail).

%!  evaluated(+Expression, -Number) is det.
%
%   Number is the value of an arithmetic Expression.
%
%   @error the errors of is/2

evaluated(Expression, Number) :-
    (   number(Expression)
    ->  Number = Expression
    ;   catch(Number is Expression, error(Formal, _),
              not_evaluated(Formal, Expression))
    ).

not_evaluated(instantiation_error, Expression) :-
    term_variables(Expression, [Variable|_]),
    !,
    instantiation_error(Variable).
not_evaluated(Formal, _) :-
    throw_error(Formal, _, '').

%!  must_be_goal(?Term) is det.
%
%   True if Term is callable, with a module or without.
%
%   @error as must_be(callable, Term), without the module

must_be_goal(Term) :-
    strip_module(Term, _, Plain),
    must_be(callable, Plain).
