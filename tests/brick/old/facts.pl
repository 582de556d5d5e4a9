:- module(old_facts,
          [ read_list/1,                % +File
            old/2,                      % ?Where, ?What
            old_export/2,               % +Library, ?Export
            old_takes/1,                % +Where
            newer_term/3                % +Where, +Term, -What
          ]).
:- use_module(terms, [indicator/2]).
:- use_module(library(lists), [member/2]).
:- use_module(library(readutil), [read_file_to_string/3]).

/** <module> What SWI-Prolog 7.2.3 has

The facts are lines of two files. Version 7.2.3 itself lists those of
swipl-7.2.3.txt, by list.pl. Those of swipl-7.2.3-arguments.txt were taken
from its sources by hand. A line `% ...` is a comment. The others are

    system Name/Arity           a built-in predicate
    library(Name) Name/Arity    what a library exports, or op(P,T,N)
    function Name/Arity         a function of arithmetic
    operator op(P,T,N)
    flag Name                   a Prolog flag
    option Name/Arity Option    what is in the list that is the last argument
    property Name/Arity Term    what the last argument is
    key Name/Arity Term         what the first argument is
    as Name/Arity Other/Arity   the first takes what the other takes, too
    directive Letter            what format/2 knows
    element Name/Arity          a compound term among the lines of a message
    hook Name/Arity             a predicate of module `prolog` that is called

An Option or Term is a name, or Name(Value) if there are only some values.
*/

:- dynamic
    old/2.                              % Where, What

%!  read_list(+File) is det.
%
%   Read the facts of a File. Its lines `Kind Name/Arity What` become facts
%   old(Kind(Name/Arity), What), the others old(Where, What).

read_list(File) :-
    read_file_to_string(File, Text, []),
    split_string(Text, "\n", "", Lines),
    forall(( member(Line, Lines), fact(Line, Fact) ), assertz(Fact)).

fact(Line, old(Where, What)) :-
    \+ sub_string(Line, 0, _, _, "%"),
    first_word(Line, Where0, Rest),
    (   memberchk(Where0, ["option", "property", "key", "as"])
    ->  first_word(Rest, Of, What0),
        term_string(Predicate, Of),
        atom_string(Kind, Where0),
        Where =.. [Kind, Predicate]
    ;   term_string(Where, Where0),
        What0 = Rest
    ),
    term_string(What, What0).

first_word(Text, Word, Rest) :-
    sub_string(Text, Before, _, After, " "),
    !,
    sub_string(Text, 0, Before, _, Word),
    sub_string(Text, _, After, 0, Rest).

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
%   True if Term is no option, property or key of Where. What is its name; or
%   Term, if only the value is newer.

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
