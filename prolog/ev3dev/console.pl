:- module(ev3dev_console,
          [ screen_print/1,             % +Term
            screen_format/2,            % +Format, +Arguments
            screen_forget/0
          ]).
:- set_prolog_flag(generate_debug_info, false).
:- use_module(private/load/compiled, []).
:- use_module(private/checks/checks, [must_be/2]).
:- use_module(private/errors/errors, [in_own_name/1]).
:- use_module(private/errors/public_clauses, [term_expansion/4]).
:- use_module(private/run/brick).
:- use_module(screen, [screen_clear/0, screen_show/0, screen_text/4]).

/** <module> Lines of text on the screen

The screen as a console: each text becomes a new line at the bottom, and the
lines above move up. There are 12 lines of 29 letters; longer texts take
several lines. Loaded apart from library(ev3dev):

```
?- use_module(library(ev3dev/console)).
?- us_dist_cm(_, Distance), screen_format('~1f cm', [Distance]).
```

The lines take the whole screen: what was drawn before disappears.
*/

:- dynamic lines/2.                     % Brick, Lines
:- of_brick([lines/2]).

%!  screen_print(+Term) is semidet.
%
%   Write Term, as write/1 does, and show it. Fails if there
%   is no screen.

screen_print(Term) :-
    screen_format("~w", [Term]).

%!  screen_format(+Format, +Arguments) is semidet.
%
%   Write Arguments by Format, as format/2 does, and show the text. A newline
%   starts another line. Fails if there is no screen.
%
%   @error format(Message) as format/2

screen_format(Format, Arguments) :-
    must_be(nonvar, Format),
    in_own_name(format(string(Text), Format, Arguments)),
    with_mutex(ev3dev_console, add_lines(Text, Lines)),
    screen_clear,
    show_lines(Lines, 2),
    screen_show.

%!  screen_forget is det.
%
%   Forget all lines, and make the sheet white.

screen_forget :-
    brick(Brick),
    retractall(lines(Brick, _)),
    screen_clear.

add_lines(Text, Lines) :-
    brick(Brick),
    (   retract(lines(Brick, Before))
    ->  true
    ;   Before = []
    ),
    split_string(Text, "\n", "", Rows),
    folded_all(Rows, New),
    joined(Before, New, All),
    last_of(All, 12, Lines),
    assertz(lines(Brick, Lines)).

folded_all([], []).
folded_all([Row|Rows], Lines) :-
    folded(Row, First),
    folded_all(Rows, Rest),
    joined(First, Rest, Lines).

folded(Row, [Row]) :-
    string_length(Row, Length),
    Length =< 29,
    !.
folded(Row, [Line|Lines]) :-
    sub_string(Row, 0, 29, After, Line),
    sub_string(Row, 29, After, 0, Rest),
    folded(Rest, Lines).

%   Not by library(lists): it takes a brick long to load.
joined([], Lines, Lines).
joined([Line|Before], Lines, [Line|All]) :-
    joined(Before, Lines, All).

last_of(Lines, Most, Last) :-
    length(Lines, Count),
    (   Count =< Most
    ->  Last = Lines
    ;   Lines = [_|Rest],
        last_of(Rest, Most, Last)
    ).

show_lines([], _).
show_lines([Line|Lines], Y) :-
    screen_text(2, Y, Line, [font(small)]),
    Below is Y + 10,
    show_lines(Lines, Below).
