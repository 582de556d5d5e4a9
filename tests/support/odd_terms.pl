:- module(odd_terms,
          [ odd/1,                      % -Term
            large/1                     % -Term
          ]).
:- use_module(old_prolog, [evaluated/2]).
:- use_module(library(lists)).

/** <module> Terms that nobody expects as an argument
*/

%!  odd(-Term) is nondet.
%
%   Term is of each kind that Prolog has, also of those that only a newer one has, or
%   wrong in a way that is easy to overlook.

odd(_).
odd(7).
odd(-7).
odd(1.5).
odd("text").
odd('').
odd([]).
odd('[]').
odd([a]).
odd([_|_]).
odd(f(x)).
odd(f(_)).
odd(outZ).
odd('ev3-ports:').
odd('../..').
odd('a\u0000b').
odd("a\u0000b").
odd('\u4e2d\U0001f916').
odd('a\nb').
odd(X) :- half_a_pair(X).
odd(X) :- half_a_pair(Name), X =.. [Name, 1].
odd(X) :- X is 10**400.
odd(X) :- X is -(10**400).
odd(X) :- catch(X is 1 rdiv 3, _, fail).
odd(1.0e308).
odd(-0.0).
odd(X) :- evaluated(inf, X).
odd(X) :- evaluated(nan, X).
odd(9223372036854775807).
odd(-9223372036854775808).
odd(X) :- length(Codes, 5000), maplist(=(0'a), Codes), atom_codes(X, Codes).
odd(X) :- catch(compound_name_arguments(X, wall, []), _, fail).
odd(X) :- catch(dict_pairs(X, t, [a-1]), _, fail).
odd(X) :- X = f(X).
odd(X) :- X = [a|X].
odd(X) :- freeze(X, true).
odd(X) :- stream_property(X, alias(user_error)).
odd(X) :- clause(half_a_pair(_), _, X).
odd(X) :- mutex(X).
odd(nowhere:no_such_thing).

%!  large(-Term) is nondet.
%
%   Term is odd, too: a long list, a deep term, a wide one, and one with 65536 copies of
%   a part that Prolog has once.

large(X) :- numlist(1, 100000, X).
large(X) :- nested(100000, X).
large(X) :- shared(16, X).
large(X) :- functor(X, f, 100000).

half_a_pair(X) :-
    catch(atom_codes(X, [0xd800]), error(_, _), fail).

nested(0, X) :-
    !,
    X = a.
nested(Count, f(X)) :-
    Less is Count - 1,
    nested(Less, X).

shared(0, X) :-
    !,
    X = a.
shared(Count, f(X, X)) :-
    Less is Count - 1,
    shared(Less, X).

:- dynamic its_mutex/1.

mutex(X) :-
    (   its_mutex(X)
    ->  true
    ;   mutex_create(X),
        assertz(its_mutex(X))
    ).
