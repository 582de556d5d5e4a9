:- module(papers,
          [ untrue/1                    % -Complaint
          ]).
:- use_module(libraries).
:- use_module(library(apply)).
:- use_module(library(lists)).
:- use_module(library(readutil)).
:- use_module(library(ev3dev)).
:- use_module(library(ev3dev/planners)).
:- use_module(library(ev3dev/private/golog/programs)).
:- use_module(library(ev3dev/private/help/libraries)).

/** <module> A check that papers list what the pack has

Each table of a paper that repeats what the pack can tell is compared with the
pack itself.
*/

%!  untrue(-Complaint) is nondet.
%
%   Complaint is lacks(Paper, What) or has_no(Paper, What): the Paper does not
%   name what there is, or names what there is not.

untrue(Complaint) :-
    compared(Paper, Named, There),
    findall(What, call(Named, What), Named0),
    findall(What, call(There, What), There0),
    sort(Named0, Names),
    sort(There0, Things),
    (   member(What, Things),
        \+ memberchk(What, Names),
        Complaint = lacks(Paper, What)
    ;   member(What, Names),
        \+ memberchk(What, Things),
        Complaint = has_no(Paper, What)
    ).

compared('docs/predicates.md', listed_predicate, some_export).
compared('docs/predicates.md, Libraries', listed_library, library_to_load).
compared('docs/predicates.md, planners', listed_planner, some_planner).
compared('docs/cognitive-robotics.md, constructs', listed_construct,
         some_construct).

listed_predicate(PI) :-
    quoted('docs/predicates.md', predicate, Text),
    indicator(Text, PI).

some_export(PI) :-
    public_export(_, PI).

listed_library(Library) :-
    quoted('docs/predicates.md', library, Text),
    atom_string(Library, Text).

library_to_load(ev3dev).
library_to_load(Library) :-
    in_library(Name, _),
    atom_concat('ev3dev/', Name, Library).

listed_planner(Name) :-
    quoted('docs/predicates.md', planner, Text),
    indicator(Text, Name/_).

some_planner(Name) :-
    planner(Planner),
    functor(Planner, Name, _).

%   Those that the library makes itself begin with a dollar sign; those that
%   Prolog has need no line of their own.

some_construct(Name) :-
    (   construct(Program)
    ;   weak_construct(Program)
    ;   condition_construct(Program),
        \+ predicate_property(system:Program, defined),
        Program \= not(_)
    ),
    functor(Program, Name, _),
    \+ is_list(Program),
    Program \= [_|_],
    \+ sub_atom(Name, 0, _, _, $).

%   The table also names what is not a construct: procedures, the robot.

listed_construct(Name) :-
    quoted('docs/cognitive-robotics.md', construct, Text),
    indicator(Text, Name/_),
    some_construct(Name).

%   The predicates that a text in back quotes names: `go/1,2`, `go(Speed)`.

indicator(Text, Name/Arity) :-
    (   split_string(Text, "/", "", [Before, After]),
        \+ sub_string(Before, _, _, _, "(")
    ->  atom_string(Name, Before),
        split_string(After, ",", " ", Arities),
        member(Digits, Arities),
        number_string(Arity, Digits)
    ;   catch(term_string(Term, Text), error(_, _), fail),
        callable(Term),
        functor(Term, Name, Arity)
    ).

%!  quoted(+Paper, +Title, -Text) is nondet.
%
%   Text stands in back quotes in the first column of a table of Paper whose
%   first column has this Title.

quoted(Paper, Title, Text) :-
    read_file_to_string(Paper, All, [encoding(utf8)]),
    split_string(All, "\n", "", Lines),
    format(string(Head), "| ~w |", [Title]),
    append(_, [Line|Rest], Lines),
    string_concat(Head, _, Line),
    rows(Rest, Rows),
    member(Row, Rows),
    split_string(Row, "|", "", [_, Cell|_]),
    split_string(Cell, "`", "", Parts),
    nth0(Index, Parts, Text),
    Index mod 2 =:= 1.

rows([Line|Lines], Rows) :-
    sub_string(Line, 0, _, _, "|"),
    !,
    Rows = [Line|Rows1],
    rows(Lines, Rows1).
rows(_, []).
