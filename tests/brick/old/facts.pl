:- module(old_facts,
          [ read_list/1,                % +File
            old/2,                      % ?Where, ?What
            old_export/2,               % +Library, ?Export
            old_takes/1,                % +Where
            newer_term/3                % +Where, +Term, -What
          ]).
:- use_module(terms, [indicator/2]).
:- use_module(library(lists), [member/2]).
:- use_module(library(readutil), [read_file_to_terms/3]).

/** <module> The predicates, options and flags of SWI-Prolog 7.2.3

The facts are terms `old(Where, Whats).` of two files. Version 7.2.3 itself
lists those of swipl-7.2.3.txt, by list.pl. Those of swipl-7.2.3-arguments.txt
were taken from its sources by hand. Where and each of Whats are

    system                Name/Arity    a built-in predicate
    library(Name)         Name/Arity    what it exports, or op(P,T,N)
    function              Name/Arity    a function of arithmetic
    operator              op(P,T,N)
    flag                  Name          a Prolog flag
    option(Name/Arity)    Option        is in the list in the last argument
    property(Name/Arity)  Term          can be the last argument
    key(Name/Arity)       Term          can be the first argument
    as(Name/Arity)        Other/Arity   the first takes what this takes, too
    directive             Letter        format/2 knows it
    element               Name/Arity    a compound term in a message's lines
    hook                  Name/Arity    a predicate that `prolog` calls

An Option or Term is a name, or Name(Value) if there are only some values.
*/

:- dynamic
    old/2.                              % Where, What

%!  read_list(+File) is det.
%
%   Read the terms of a File. Each of Whats becomes a fact old(Where, What).

read_list(File) :-
    read_file_to_terms(File, Terms, []),
    forall(( member(old(Where, Whats), Terms), member(What, Whats) ),
           assertz(old(Where, What))).

%!  old_export(+Library, ?Export) is nondet.
%
%   True if library(Library) exports this predicate or operator.

old_export(Library, Export) :-
    old(library(Library), Export).
old_export(Library, Export) :-
    atom(Library),
    old(library(clp/Library), Export).

%!  old_takes(+Where) is semidet.
%
%   True if it is known which options, properties or keys Where has.

old_takes(Where) :-
    place(Where, Place),
    old(Place, _),
    !.

%!  newer_term(+Where, +Term, -What) is semidet.
%
%   True if Term is not an option, property or key of Where. What is its name;
%   or Term, if only the value is newer.

newer_term(Where, Term, What) :-
    indicator(Term, Name/_),
    findall(Old,
            ( place(Where, Place),
              old(Place, Old),
              indicator(Old, Name/_)
            ),
            Olds),
    \+ known(Term, Olds),
    (   Olds == []
    ->  What = Name
    ;   What = Term
    ).

known(_, Olds) :-
    member(Old, Olds),
    atom(Old),
    !.
known(Term, [_|_]) :-
    \+ ( compound(Term),
         arg(1, Term, Value),
         atom(Value)
       ),
    !.
known(Term, Olds) :-
    memberchk(Term, Olds).

place(Where, Where).
place(Where, Place) :-
    Where =.. [Kind, Predicate],
    old(as(Predicate), Other),
    Where1 =.. [Kind, Other],
    place(Where1, Place).
