:- module(ev3dev_syntax_errors,
          [ syntax_advice/3             % +Kind, +Where, -Lines
          ]).
:- use_module(library(lists), [append/3, last/2, member/2]).
:- use_module(library(readutil), [read_file_to_string/3]).

/** <module> Advice about a clause that Prolog cannot read

Prolog says where it could not go on. This module looks for the beginner's
mistake that leads there.

A token is t(Kind, Text, Line, Before). Before is what is before it: `none`,
`space`, or a new line, which is `start` if the token is its first character,
else `line`.
*/

%!  syntax_advice(+Kind, +Where, -Lines) is semidet.
%
%   Lines are message lines: the place, what Prolog says, and advice. Kind and
%   Where are those of error(syntax_error(Kind), Where), of a file or a query.

syntax_advice(Kind, Where, ['~w'-[Place]|Lines]) :-
    '$messages':translate_message(error(syntax_error(Kind), _), [_|Words],
                                  []),
    Words \= [_-[Kind]],                % an error of another language
    text_of(Where, Place, Line, String),
    string_codes(String, Codes0),
    % #!/usr/bin/env swipl
    ( append(`#!`, _, Codes0) -> Codes = [0'%|Codes0] ; Codes = Codes0 ),
    tokens(Codes, 1, start, Tokens),
    once(( clause_at(Tokens, Line, Clause), advice(Clause, Advice) )),
    append(Words, [': '|Advice], Lines).

text_of(string(String, _), '', 1, String).
text_of(file(File, Line, Column, _), Place, Line, String) :-
    catch(read_file_to_string(File, String, []), error(_, _), fail),
    format(atom(Place), '~w:~w:~w: ', [File, Line, Column]).

%   clause_at(+Tokens, +Line, -Clause) is nondet: a clause that Line is part
%   of. The last one may have no end.

clause_at(Tokens, Line, Clause) :-
    (   append(Tokens0, [End|Others], Tokens),
        End = t(end, _, _, _)
    ->  append(Tokens0, [End], Clause0)
    ;   Others = [],
        Clause0 = Tokens
    ),
    Clause0 = [t(_, _, First, _)|_],
    First =< Line,
    (   last(Clause0, t(_, _, Last, _)),
        ( Last >= Line ; Others == [] ),
        Clause = Clause0
    ;   clause_at(Others, Line, Clause)
    ).

%   advice(+Clause, -Lines) is nondet, the surest first.

advice(Ts, [Format-[Operator, Library], nl,
            '  use_module(library(ev3dev/~w)).'-[Library]]) :-
    Format = '~w is one of library(ev3dev/~w), which is not loaded: first',
    member(t(symbol, Operator, _, _), Ts),
    (   Operator == (~>)
    ->  Library = rules
    ;   Operator == (<-)
    ->  Library = layers
    ;   Operator == #,
        memberchk(t(name, proc, _, _), Ts),
        Library = golog_classic
    ),
    \+ is_operator(Operator).
advice(Ts, [Advice]) :-
    member(t(wrong, What, Line, _), Ts),
    wrong(What, Line, Advice).
advice(Ts, [Format-[Word]]) :-
    append(_, [Prev, t(Kind, Word, _, _), Next|_],
           [t(punct, '', 0, none)|Ts]),
    memberchk(Kind, [name, symbol]),
    \+ is_operator(Word),
    ( Kind == symbol ; begins(Next) ; ends(Prev), Next \= t(_, '(', _, _) ),
    word_of_others(Word, Format).
advice(Ts, [Advice]) :-
    append(_, [Prev, A, B|_], [t(punct, '', 0, none)|Ts]),
    B = t(_, _, _, Before),
    ( memberchk(Before, [none, space]) -> true ; \+ begins(B) ),
    in_line(A, B, Prev, Advice).
advice(Ts, ['write >= instead of =>'-[]]) :-
    memberchk(t(symbol, :-, _, _), Ts),
    memberchk(t(symbol, =>, _, _), Ts).
advice(Ts, [Advice]) :-
    brackets(Ts, [], Advice).
advice(Ts, [Advice]) :-
    second_neck(Ts, Advice).
advice(Ts, ['~w may be missing at the end of line ~d'-[What, Line]]) :-
    append(_, [A, B|_], Ts),
    ends(A),
    begins(B),
    A = t(_, _, Line, _),
    (   B = t(_, _, _, line)
    ->  What = 'a comma'
    ;   memberchk(t(symbol, :-, _, _), Ts)
    ->  What = 'a comma or a full stop'
    ;   What = 'a full stop'
    ).
advice(Ts, ['~w is missing at the end of line ~d'-[What, Line]]) :-
    last(Ts, Last),
    Last = t(Kind, _, Line, _),
    Kind \== end,
    ( ends(Last) -> What = 'a full stop' ; What = something ).

wrong(What, Line, Advice) :-
    (   memberchk(What, ['\'', '"', '`', '/*'])
    ->  Advice = 'the ~w in line ~d has no end'-[What, Line]
    ;   member(Right-Wrong, ['"'-'\u201C\u201D\u201E\u00AB\u00BB',
                             '\''-'\u2018\u2019\u201A\u00B4',
                             (-)-'\u2013\u2014\u2212']),
        sub_atom(Wrong, _, _, _, What)
    ->  Advice = 'write ~w instead of ~w'-[Right, What]
    ).

%   in_line(+A, +B, +Before, -Advice) is semidet: a mistake of A or B, which
%   follow Before.

in_line(t(var, A, _, _), t(_, '(', _, none), _,
        'names of predicates begin with a small letter: ~w('-[A]).
in_line(t(name, A, _, _), t(_, '(', _, space), Prev,
        'write ~w( without a space'-[A]) :-
    \+ is_operator(A),
    \+ ends(Prev).
in_line(t(name, A, _, _), t(_, '[', _, none), _,
        'arguments are in round parentheses: ~w('-[A]).
in_line(t(_, ')', _, _), t(_, '(', _, none), _,
        'a name takes one pair of parentheses'-[]).
in_line(t(symbol, '.', _, _), t(number, B, _, none), Prev,
        'write 0.~w'-[B]) :-
    \+ ends(Prev).
in_line(t(punct, ',', _, _), t(end, _, _, _), _,
        'there is a comma before the full stop'-[]).
in_line(t(punct, A, _, _), t(punct, B, _, _), _,
        'something is missing between ~w and ~w'-[A, B]) :-
    memberchk(A, [',', '(', '[', '{']),
    memberchk(B, [',', ')', ']', '}']),
    ( A == ',' -> true ; B == ',' ).
in_line(A, B, _, Format-[TextA, TextB]) :-
    ends(A),
    begins(B),
    A = t(Kind, TextA, _, _),
    B = t(_, TextB, _, _),
    (   Kind == name,
        current_predicate(TextA, user:Head),
        compound(Head)
    ->  Format = 'arguments are in parentheses: ~w(~w)'
    ;   Format = 'a comma may be missing between ~w and ~w'
    ).

%   word_of_others(+Word, -Format) is semidet: other languages have it.

word_of_others(Word, Format) :-
    member(Right-Words,
           [ (',')-[and, &&], (;)-[or, else], (->)-[then],
             (\+)-[not], (=<)-[<=], (:-)-[<-], (\==)-['!=', <>] ]),
    memberchk(Word, Words),
    !,
    atomic_list_concat(['write ', Right, ' instead of ~w'], Format).
word_of_others(if, 'Prolog has no ~w: ( Condition -> Then ; Else )').
word_of_others(Word, 'Prolog has no ~w, since a variable keeps its value: \c
                      X1 is X+1') :-
    memberchk(Word, [+=, -=, ++, --]).

%   brackets(+Tokens, +Open, -Advice) is semidet: one is not closed, or not
%   opened.

brackets([], [t(_, Open, Line, _)|_],
         'the ~w in line ~d is not closed'-[Open, Line]).
brackets([T|Ts], Open0, Advice) :-
    (   T = t(punct, Text, _, _),
        memberchk(Text, ['(', '[', '{'])
    ->  brackets(Ts, [T|Open0], Advice)
    ;   T = t(punct, Text, Line, _),
        member(Begin-Text, ['('-')', '['-']', '{'-'}'])
    ->  (   Open0 = [t(_, Begin, _, _)|Open]
        ->  brackets(Ts, Open, Advice)
        ;   Open0 = [t(_, Other, Line0, _)|_]
        ->  Advice = 'the ~w in line ~d is closed by ~w in line ~d'-
                     [Other, Line0, Text, Line]
        ;   Advice = 'there is no ~w for the ~w in line ~d'-
                     [Begin, Text, Line]
        )
    ;   brackets(Ts, Open0, Advice)
    ).

%   second_neck(+Clause, -Advice) is semidet: another clause begins in a line
%   below, and has a :-, too.

second_neck(Ts, Advice) :-
    append(Ts1, [t(symbol, :-, _, _)|Ts2], Ts),
    append(Ts3, [Neck|_], Ts2),
    Neck = t(symbol, :-, _, _),
    append(Ts3, [Neck], Ts4),
    append(Ts5, [t(_, _, _, start)|Head], Ts4),
    \+ memberchk(t(_, _, _, start), Head),
    append(Ts1, [t(symbol, :-, 1, none)|Ts5], Ts6),
    last(Ts6, t(_, Text, Line, _)),
    !,
    (   Text == ','
    ->  Advice = 'a full stop, not a comma, belongs at the end of line ~d'-
                 [Line]
    ;   Advice = 'a full stop may be missing at the end of line ~d'-[Line]
    ).

%   ends(+Token): a term may end with it. begins(+Token): one may begin.

ends(t(Kind, Text, _, _)) :-
    (   Kind == punct
    ->  memberchk(Text, [')', ']', '}'])
    ;   memberchk(Kind, [number, string, var])
    ->  true
    ;   Kind == name,
        \+ is_operator(Text)
    ).

begins(t(Kind, Text, _, Before)) :-
    (   Kind == punct
    ->  Before \== none,
        memberchk(Text, ['(', '[', '{'])
    ;   memberchk(Kind, [number, string, var])
    ->  true
    ;   is_operator(Text)
    ->  \+ ( current_op(_, Type, user:Text), \+ memberchk(Type, [fx, fy]) )
    ;   Kind == name
    ).

is_operator(Text) :-
    current_op(_, _, user:Text),
    !.

%   tokens(+Codes, +Line, +Before, -Tokens) is det.

tokens([], _, _, []).
tokens([C|Cs], Line, Before, Ts) :-
    (   C == 0'\n
    ->  Line1 is Line+1,
        tokens(Cs, Line1, start, Ts)
    ;   code_type(C, space)
    ->  ( memberchk(Before, [start, line]) -> Space = line ; Space = space ),
        tokens(Cs, Line, Space, Ts)
    ;   C == 0'%
    ->  ( append(_, [0'\n|Rest], Cs) -> tokens([0'\n|Rest], Line, none, Ts)
        ; Ts = [] )
    ;   token(C, Cs, Kind, Codes, Rest),
        lines(Codes, Line, Line1),
        (   Kind == comment
        ->  tokens(Rest, Line1, Before, Ts)
        ;   atom_codes(Text, Codes),
            Ts = [t(Kind, Text, Line1, Before)|Ts1],
            tokens(Rest, Line1, none, Ts1)
        )
    ).

lines(Codes, Line0, Line) :-
    findall(x, member(0'\n, Codes), Ends),
    length(Ends, Count),
    Line is Line0+Count.

%   token(+Code, +Codes, -Kind, -Text, -Rest) is det.

token(0'/, [0'*|Cs], Kind, Text, Rest) :-
    !,
    (   append(Comment, [0'*, 0'/|Rest], Cs)
    ->  Kind = comment,
        Text = Comment
    ;   Kind = wrong,
        Text = `/*`,
        Rest = []
    ).
token(C, Cs, Kind, Text, Rest) :-
    memberchk(C-Kind0, [0'\'-name, 0'"-string, 0'`-string]),
    !,
    (   quoted(Cs, C, Quoted, Rest)
    ->  Kind = Kind0,
        Text = [C|Quoted]
    ;   Kind = wrong,
        Text = [C],
        ( append(_, [0'\n|Rest0], Cs) -> Rest = [0'\n|Rest0] ; Rest = [] )
    ).
token(0'0, [0'\'|Cs], number, [0'0, 0'\'|Text], Rest) :-
    member(Text, [[0'\\, _], [0'\', 0'\'], [_]]),
    append(Text, Rest, Cs),
    !.
token(C, Cs, number, [C|Text], Rest) :-
    code_type(C, digit),
    !,
    (   C == 0'0,
        Cs = [Base|_],
        memberchk(Base, `xob`)
    ->  span(Cs, csym, Text, Rest)
    ;   span(Cs, digit, Whole, Rest1),
        (   Rest1 = [0'., D|_],
            code_type(D, digit)
        ->  Rest1 = [_|Rest2],
            span(Rest2, digit, Part, Rest),
            append(Whole, [0'.|Part], Text)
        ;   Text = Whole,
            Rest = Rest1
        )
    ).
token(C, Cs, Kind, [C|Text], Rest) :-
    code_type(C, csymf),
    !,
    ( ( C == 0'_ ; code_type(C, upper) ) -> Kind = var ; Kind = name ),
    span(Cs, csym, Text, Rest).
token(0'!, [0'=|Rest], symbol, `!=`, Rest) :-
    !.
token(C, Cs, Kind, [C|Text], Rest) :-
    (   memberchk(C-Kind, [0'!-string, 0';-symbol])
    ;   memberchk(C, `()[]{},|`),
        Kind = punct
    ),
    !,
    Text = [],
    Rest = Cs.
token(C, Cs, Kind, [C|Text], Rest) :-
    is_symbol(C),
    !,
    span(Cs, symbol, Text, Rest),
    (   [C|Text] == `.`,
        \+ ( Rest = [Next|_], Next \== 0'%, \+ code_type(Next, space) )
    ->  Kind = end
    ;   Kind = symbol
    ).
token(C, Cs, wrong, [C], Cs).

is_symbol(C) :-
    memberchk(C, `#$&*+-./:<=>?@\\^~`).

span([C|Cs], Type, [C|Text], Rest) :-
    ( Type == symbol -> is_symbol(C) ; code_type(C, Type) ),
    !,
    span(Cs, Type, Text, Rest).
span(Cs, _, [], Cs).

quoted([C|Cs], Quote, [C|Text], Rest) :-
    (   C == 0'\\
    ->  ( Cs = [0'c, 0'\n|Cs1] -> true ; Cs = [_|Cs1] ),
        append(Escaped, Cs1, Cs),
        append(Escaped, Text1, Text),
        quoted(Cs1, Quote, Text1, Rest)
    ;   C == Quote
    ->  (   Cs = [Quote|Cs1]
        ->  Text = [Quote|Text1],
            quoted(Cs1, Quote, Text1, Rest)
        ;   Text = [],
            Rest = Cs
        )
    ;   C \== 0'\n,
        quoted(Cs, Quote, Text, Rest)
    ).
