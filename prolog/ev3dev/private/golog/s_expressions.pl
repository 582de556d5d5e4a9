:- module(ev3dev_golog_s_expressions,
          [ expression/3                % +Stream, +Path, -Expression
          ]).
:- use_module(library(readutil), [read_stream_to_codes/2]).
:- use_module('../errors/errors', [throw_error/3]).

/** <module> Lists in round brackets, as PDDL is written
*/

%!  expression(+Stream, +Path, -Expression) is det.
%
%   Expression is the only one in Stream: a list, whose elements are lists and
%   atoms in small letters. From a semicolon on a line is a comment.
%
%   @error syntax_error(pddl), with Path and line

expression(Stream, Path, Expression) :-
    read_stream_to_codes(Stream, Codes),
    (   skipped(Codes, 1, Codes1, Line1),
        item(Codes1, Line1, Path, Expression, Codes2, Line2),
        skipped(Codes2, Line2, Codes3, Line3)
    ->  (   Codes3 == []
        ->  true
        ;   wrong(Path, Line3, 'something stands after the last bracket')
        )
    ;   wrong(Path, 1, 'the file is empty')
    ).

item([0'(|Codes], Line, Path, Items, Rest, Line1) :-
    !,
    items(Codes, Line, Path, Line, Items, Rest, Line1).
item([0')|_], Line, Path, _, _, _) :-
    !,
    wrong(Path, Line, 'a bracket is closed that was not opened').
item(Codes, Line, _, Atom, Rest, Line) :-
    word(Codes, Word, Rest),
    Word \== [],
    atom_codes(Atom0, Word),
    downcase_atom(Atom0, Atom).

items(Codes0, Line0, Path, Opened, Items, Rest, Line) :-
    skipped(Codes0, Line0, Codes, Line1),
    (   Codes == []
    ->  wrong(Path, Opened, 'this bracket is not closed')
    ;   Codes = [0')|Rest0]
    ->  Items = [],
        Rest = Rest0,
        Line = Line1
    ;   item(Codes, Line1, Path, Item, Codes1, Line2),
        Items = [Item|Items1],
        items(Codes1, Line2, Path, Opened, Items1, Rest, Line)
    ).

word([C|Codes], [C|Word], Rest) :-
    \+ code_type(C, space),
    \+ memberchk(C, [0'(, 0'), 0';]),
    !,
    word(Codes, Word, Rest).
word(Rest, [], Rest).

%   Blanks and comments; the lines are counted.

skipped([C|Codes], Line0, Rest, Line) :-
    code_type(C, space),
    !,
    (   C =:= 0'\n
    ->  Line1 is Line0+1
    ;   Line1 = Line0
    ),
    skipped(Codes, Line1, Rest, Line).
skipped([0';|Codes0], Line0, Rest, Line) :-
    !,
    comment(Codes0, Codes),
    skipped(Codes, Line0, Rest, Line).
skipped(Rest, Line, Rest, Line).

comment([], []).
comment([C|Codes0], Codes) :-
    (   C =:= 0'\n
    ->  Codes = [C|Codes0]
    ;   comment(Codes0, Codes)
    ).

wrong(Path, Line, Why) :-
    format(atom(Text), '~w:~d: ~w', [Path, Line, Why]),
    throw_error(syntax_error(pddl), _, Text).
