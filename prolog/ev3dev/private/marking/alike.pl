:- module(ev3dev_marking_alike,
          [ alike/2,                    % +Programs, -Pairs
            clause_lines/3              % +Terms, +Clauses, -Lines
          ]).
:- use_module(library(lists), [member/2]).
:- use_module(library(ordsets),
              [ord_intersection/3, ord_memberchk/2, ord_subtract/3]).

/** <module> Similar programs

A hint for the teacher. Clauses are compared whole, whatever the names of
variables; what most programs have, as from a skeleton, does not count.
*/

share_from(0.6).
least_clauses(3).

%!  alike(+Programs, -Pairs) is det.
%
%   Programs is a list of Name-Terms, with Terms as of program_terms/2. Pairs
%   is a list of alike(A, B, Share, Clauses), of pairs that share at least
%   60 % of their own clauses, and three of them; most alike first. Clauses
%   are those that both have, for clause_lines/3.

alike(Programs, Pairs) :-
    findall(Name-Shapes,
            ( member(Name-Terms, Programs), shapes(Terms, Shapes) ),
            Shaped0),
    common(Shaped0, Common),
    findall(Name-Own,
            ( member(Name-Shapes, Shaped0),
              ord_subtract(Shapes, Common, Own) ),
            Shaped),
    findall(Minus-alike(A, B, Share, Both),
            ( member(A-Of, Shaped),
              member(B-Other, Shaped),
              A @< B,
              shared(Of, Other, Share, Both),
              Minus is -Share ),
            Found0),
    msort(Found0, Found),
    findall(Pair, member(_-Pair, Found), Pairs).

shapes(Terms, Shapes) :-
    findall(Shape,
            ( member(term(Term, _), Terms), shape(Term, Shape) ),
            Shapes0),
    sort(Shapes0, Shapes).

shape(Term, Shape) :-
    Term \= (:- _),
    copy_term(Term, Shape),
    numbervars(Shape, 0, _).

%!  clause_lines(+Terms, +Clauses, -Lines) is det.
%
%   At which Lines of a program those of its Terms begin that are Clauses of
%   alike/2.

clause_lines(Terms, Clauses, Lines) :-
    findall(Line,
            ( member(term(Term, Line), Terms),
              shape(Term, Shape),
              ord_memberchk(Shape, Clauses) ),
            Lines).

%   What more than half of at least four programs have.

common(Shaped, Common) :-
    length(Shaped, Count),
    (   Count < 4
    ->  Common = []
    ;   findall(Shape, ( member(_-Shapes, Shaped), member(Shape, Shapes) ),
                All0),
        msort(All0, All),
        Most is Count//2,
        repeated(All, Most, Common)
    ).

repeated([], _, []).
repeated([Shape|Shapes], Most, Common) :-
    same(Shapes, Shape, 1, Count, Others),
    (   Count > Most
    ->  Common = [Shape|Common1]
    ;   Common = Common1
    ),
    repeated(Others, Most, Common1).

same([Shape0|Shapes], Shape, Count0, Count, Others) :-
    Shape0 == Shape,
    !,
    Count1 is Count0+1,
    same(Shapes, Shape, Count1, Count, Others).
same(Others, _, Count, Count, Others).

shared(Of, Other, Share, Both) :-
    ord_intersection(Of, Other, Both),
    length(Both, Count),
    least_clauses(Least),
    Count >= Least,
    length(Of, A),
    length(Other, B),
    Share is Count/float(min(A, B)),
    share_from(From),
    Share >= From.
