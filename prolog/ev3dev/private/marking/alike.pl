:- module(ev3dev_marking_alike,
          [ alike/4,                    % +Programs, +Earlier, +Given, -Pairs
            alike_lines/3               % +Terms, +Shared, -Lines
          ]).
:- use_module(library(lists), [append/3, member/2, min_member/2]).
:- use_module(library(ordsets),
              [ ord_intersection/3, ord_memberchk/2, ord_subtract/3,
                ord_union/2, ord_union/3 ]).

/** <module> Similar programs

A hint for the teacher. A clause becomes a list of tokens, in which all
variables are the same, and so are all names of the program's own predicates
and data, and all numbers. From each list winnowing takes fingerprints:
hashes of some of its pieces of K tokens, so that each piece of W+K-1 tokens
that two programs have leaves one that both have. (S. Schleimer, D. Wilkerson,
A. Aiken: Winnowing, SIGMOD 2003; that is what MOSS does. JPlag and MOSS
themselves know no Prolog.) The order of clauses does not count.

Short programs for a task often have the same tokens, though nobody copied.
If a program has few fingerprints of its own, numbers and atoms count, too,
and all pieces are compared.
*/

piece(5).                               % K
window(4).                              % W
share_from(min, 0.6).
share_from(max, 0.8).                  % short ones
long_from(8).                           % fingerprints

%!  alike(+Programs, +Earlier, +Given, -Pairs) is det.
%
%   Programs and Earlier are lists of Name-Terms, with Terms as of
%   program_terms/2. Pairs is a list of alike(A, B, Share, Shared), most alike
%   first: A is a Name of Programs, B this(Name) or earlier(Name), Share how
%   much of the smaller one the other has, at least 60 %; of short ones, how
%   much of the larger one, at least 80 %. What the terms Given have, as of a
%   skeleton, and what more than half of at least four Programs have, does
%   not count.

alike(Programs, Earlier, Given, Pairs) :-
    prints(Given, loose, Loose),
    prints(Given, exact, Exact),
    findall(this(Name)-Terms, member(Name-Terms, Programs), These),
    findall(earlier(Name)-Terms, member(Name-Terms, Earlier), Others),
    append(These, Others, All),
    printed(All, loose, Loose, LooseOnes),
    printed(All, exact, Exact, ExactOnes),
    findall(Minus-alike(A, B, Share, Shared),
            ( pair(LooseOnes, A-As, B-Bs),
              (   is_long(As),
                  is_long(Bs)
              ->  shared(As, Bs, min, Share, Shared)
              ;   memberchk(this(A)-As1, ExactOnes),
                  memberchk(B-Bs1, ExactOnes),
                  shared(As1, Bs1, max, Share, Shared)
              ),
              Minus is -Share ),
            Found0),
    keysort(Found0, Found),
    findall(Pair, member(_-Pair, Found), Pairs).

pair(Ones, A-As, B) :-
    append(_, [this(A)-As|Others], Ones),
    member(B, Others).

is_long(Prints) :-
    length(Prints, Count),
    long_from(Long),
    Count >= Long.

shared(As, Bs, Of, Share, Shared) :-
    ord_intersection(As, Bs, Shared),
    Shared \== [],
    length(Shared, Count),
    length(As, A),
    length(Bs, B),
    All =.. [Of, A, B],
    Share is Count/float(All),
    share_from(Of, From),
    Share >= From.

%   Without what is given, or common.

printed(All, How, Given, Ones) :-
    findall(Id-Prints, ( member(Id-Terms, All), prints(Terms, How, Prints) ),
            Whole),
    findall(Prints, member(this(_)-Prints, Whole), Sets),
    common(Sets, Common),
    ord_union(Given, Common, Nobodys),
    findall(Id-Own,
            ( member(Id-Prints, Whole),
              ord_subtract(Prints, Nobodys, Own) ),
            Ones).

common(Sets, Common) :-
    length(Sets, Count),
    (   Count < 4
    ->  Common = []
    ;   findall(Print-x, ( member(Set, Sets), member(Print, Set) ), All0),
        keysort(All0, All),
        Most is Count//2,
        findall(Print,
                ( repeated(All, Print, Times), Times > Most ), Common)
    ).

repeated([Print0-_|All], Print, Times) :-
    run(All, Print0, 1, Times0, Rest),
    (   Print = Print0,
        Times = Times0
    ;   repeated(Rest, Print, Times)
    ).

run([Print-_|All], Print, Times0, Times, Rest) :-
    !,
    Times1 is Times0+1,
    run(All, Print, Times1, Times, Rest).
run(Rest, _, Times, Times, Rest).

%!  alike_lines(+Terms, +Shared, -Lines) is det.
%
%   At which Lines of a program those of its Terms begin of which half of the
%   fingerprints are Shared.

alike_lines(Terms, Shared, Lines) :-
    own(Terms, Own),
    findall(Line,
            ( member(term(Term, Line), Terms),
              member(How, [loose, exact]),
              clause_prints(Term, Own, How, Prints),
              Prints \== [],
              ord_intersection(Prints, Shared, Both),
              length(Prints, Count),
              length(Both, Found),
              2*Found >= Count ),
            Lines).

% ---------------- FINGERPRINTS

prints(Terms, How, Prints) :-
    own(Terms, Own),
    findall(Its,
            ( member(term(Term, _), Terms),
              clause_prints(Term, Own, How, Its) ),
            Sets),
    ord_union(Sets, Prints).

%   The predicates that a program defines

own(Terms, Own) :-
    findall(Name/Arity,
            ( member(term(Term, _), Terms),
              head(Term, Head, More),
              callable(Head),
              functor(Head, Name, Arity0),
              Arity is Arity0+More ),
            Own0),
    sort(Own0, Own).

head((Head :- _), Head, 0) :- !.
head((Head --> _), Head, 2) :- !.
head((:- _), _, _) :- !, fail.
head(Head, Head, 0).

clause_prints(Term, Own, How, Prints) :-
    Term \= (:- _),
    phrase(goal(Term, how(How, Own)), Tokens),
    pieces(Tokens, Hashes),
    ( How == exact -> Prints0 = Hashes ; winnowed(Hashes, Prints0) ),
    sort(Prints0, Prints).

pieces(Tokens, Hashes) :-
    piece(K),
    length(Piece, K),
    findall(Hash,
            ( append(_, Rest, Tokens),
              append(Piece, _, Rest),
              term_hash(Piece, Hash) ),
            Hashes0),
    (   Hashes0 == []
    ->  term_hash(Tokens, Hash),
        Hashes = [Hash]
    ;   Hashes = Hashes0
    ).

%   The least of each window

winnowed(Hashes, Prints) :-
    window(W),
    length(Window, W),
    findall(Least,
            ( append(_, Rest, Hashes),
              append(Window, _, Rest),
              min_member(Least, Window) ),
            Prints0),
    (   Prints0 == []
    ->  min_member(Least, Hashes),
        Prints = [Least]
    ;   Prints = Prints0
    ).

%   A goal keeps its name, unless the program defines it.

goal(Term, _) -->
    { var(Term) },
    !,
    [v].
goal(Term, how(How, Own)) -->
    { connects(Term), !, Term =.. [Name|Parts] },
    [Name],
    goals(Parts, how(How, Own)).
goal(Term, how(How, Own)) -->
    { callable(Term),
      !,
      functor(Term, Name, Arity),
      ( ord_memberchk(Name/Arity, Own) -> Token = own ; Token = Name ),
      Term =.. [_|Arguments] },
    [Token/Arity],
    arguments(Arguments, How).
goal(Term, how(How, _)) -->
    argument(Term, How).

connects((_ :- _)).
connects((_ --> _)).
connects((_, _)).
connects((_ ; _)).
connects((_ -> _)).
connects(\+ _).
connects(Rule) :-
    functor(Rule, Name, 2),
    memberchk(Name, [::, ~>]).

goals([], _) -->
    [].
goals([Goal|Goals], How) -->
    goal(Goal, How),
    goals(Goals, How).

arguments([], _) -->
    [].
arguments([Argument|Arguments], How) -->
    argument(Argument, How),
    arguments(Arguments, How).

argument(Term, _) -->
    { var(Term) },
    !,
    [v].
argument(Term, How) -->
    { compound(Term), !, functor(Term, _, Arity), Term =.. [_|Arguments] },
    [f/Arity],
    arguments(Arguments, How).
argument(Term, exact) -->
    !,
    [Term].
argument(Term, loose) -->
    ( { number(Term) } -> [n] ; [a] ).
