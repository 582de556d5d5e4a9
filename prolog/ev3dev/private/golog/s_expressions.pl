:- module(ev3dev_golog_s_expressions,
          [ expression/3,               % +Stream, +Path, -Expression
            wrong/3,                    % +Path, +Place, +Why
            wrong/4,                    % +Path, +Place, +Why, +Formal
            place_text/4                % +Path, +Place, +Why, -Text
          ]).
:- use_module('../errors/errors', [throw_error/3]).

/** <module> Lists in round brackets, as PDDL is written

An expression is e(Line:Column, Item), where Item is an atom in small letters
or a list of expressions. A column is that of an editor in which a tab goes on
to the next multiple of 8.
*/

%!  expression(+Stream, +Path, -Expression) is det.
%
%   Expression is the only one in Stream. From a semicolon on a line is a
%   comment. A `?` begins a new word, and `-` before a letter is one.
%
%   @error syntax_error(pddl), with Path, line and column

expression(Stream, Path, Expression) :-
    skip_blank(Stream, C),
    (   C =:= -1
    ->  wrong(Path, 1:1, 'the file is empty'-[])
    ;   item(C, Stream, Path, open(1:1, 0), Expression)
    ),
    skip_blank(Stream, Next),
    (   Next =:= -1
    ->  true
    ;   place(Stream, Place),
        wrong(Path, Place, 'there is text after the last bracket'-[])
    ).

%   item(+Code, +Stream, +Path, +Around, -Expression) is det. Around is
%   open(Place, Depth) of the list in which it is.

item(C, Stream, Path, Around, e(Place, Item)) :-
    place(Stream, Place),
    (   C =:= 0'(
    ->  get_code(Stream, _),
        Around = open(_, Depth0),
        Depth is Depth0+1,
        skip_blank(Stream, First),
        (   First =:= 0':,
            Depth > 2
        ->  not_closed(Around, ' before the next section', Path)
        ;   items(First, Stream, Path, open(Place, Depth), First, Item)
        )
    ;   C =:= 0')
    ->  wrong(Path, Place, 'a bracket is closed that was not opened'-[])
    ;   get_code(Stream, _),
        peek_code(Stream, Next),
        (   C =:= 0'-,
            code_type(Next, alpha)
        ->  Item = (-)
        ;   word(Stream, Codes),
            atom_codes(Atom, [C|Codes]),
            downcase_atom(Atom, Item)
        )
    ).

%   items(+Code, +Stream, +Path, +Open, +First, -Items) is det. A keyword
%   such as :effect is in no list that does not begin with one.

items(C, Stream, Path, Open, First, Items) :-
    (   C =:= 0')
    ->  get_code(Stream, _),
        Items = []
    ;   C =:= -1
    ->  not_closed(Open, '', Path)
    ;   C =:= 0':,
        First =\= 0':
    ->  not_closed(Open, ' before the next keyword', Path)
    ;   Items = [Item|Items1],
        item(C, Stream, Path, Open, Item),
        skip_blank(Stream, Next),
        items(Next, Stream, Path, Open, First, Items1)
    ).

not_closed(open(Place, _), Before, Path) :-
    wrong(Path, Place, 'this bracket is not closed~w'-[Before]).

word(Stream, Codes) :-
    peek_code(Stream, C),
    (   ( memberchk(C, [-1, 0'(, 0'), 0';, 0'?]) ; code_type(C, space) )
    ->  Codes = []
    ;   get_code(Stream, _),
        Codes = [C|Rest],
        word(Stream, Rest)
    ).

%   skip_blank(+Stream, -Code) is det: Code comes after blanks and comments.

skip_blank(Stream, Code) :-
    peek_code(Stream, C),
    (   C =:= 0';
    ->  skip(Stream, 0'\n),
        skip_blank(Stream, Code)
    ;   code_type(C, space)
    ->  get_code(Stream, _),
        skip_blank(Stream, Code)
    ;   Code = C
    ).

place(Stream, Line:Column) :-
    line_count(Stream, Line),
    line_position(Stream, Before),
    Column is Before+1.

%!  wrong(+Path, +Place, +Why).
%!  wrong(+Path, +Place, +Why, +Formal).
%
%   @error Formal, else syntax_error(pddl), with Path, line, column and Why,
%          which is Format-Arguments

wrong(Path, Place, Why) :-
    wrong(Path, Place, Why, syntax_error(pddl)).

wrong(Path, Place, Why, Formal) :-
    place_text(Path, Place, Why, Text),
    throw_error(Formal, _, Text).

%!  place_text(+Path, +Place, +Why, -Text) is det.
%
%   Why is Format-Arguments.

place_text(Path, Line:Column, Format-Arguments, Text) :-
    format(atom(Why), Format, Arguments),
    format(atom(Text), '~w:~d:~d: ~w', [Path, Line, Column, Why]).
