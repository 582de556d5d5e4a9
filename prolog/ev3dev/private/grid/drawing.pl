:- module(ev3dev_grid_drawing,
          [ grid_drawn/4                % +Rows, -Obstacles, -Start, -Bounds
          ]).
:- use_module(library(apply), [maplist/2]).
:- use_module('../errors', [domain_error/2, must_be/2]).
:- use_module(library(lists),
              [max_list/2, member/2, nth0/3, reverse/2]).

/** <module> Maps that are drawn
*/

%!  grid_drawn(+Rows, -Obstacles, -Start, -Bounds) is det.
%
%   True if Rows, strings or atoms with a character for each cell, show these
%   obstacles and this start, a state or `none`. Without rows there are 8 by 8
%   cells.
%
%   @error domain_error(map_row, Row) for an unknown character or a second
%          start

grid_drawn(Rows, Obstacles, Start, Bounds) :-
    must_be(list, Rows),
    maplist(must_be_row, Rows),
    drawn(Rows, Obstacles, Start, Bounds).

drawn([], [], none, bounds(0, 0, 7, 7)) :-
    !.
drawn(Rows0, Obstacles, Start, bounds(0, 0, X2, Y2)) :-
    reverse(Rows0, Rows),
    findall(Character-[X, Y],
            ( nth0(Y, Rows, Row),
              atom_chars(Row, Characters),
              nth0(X, Characters, Character)
            ),
            Drawn),
    findall(Cell,
            ( member(Character-Cell, Drawn),
              memberchk(Character, [#, 'O'])
            ),
            Obstacles),
    findall(state(Cell, Direction),
            ( member(Character-Cell, Drawn),
              start(Character, Direction)
            ),
            Starts),
    only_start(Starts, Rows, Start),
    length(Rows, Count),
    Y2 is Count - 1,
    findall(X, member(_-[X, _], Drawn), Xs),
    max_list([0|Xs], X2).

%   Starts and Rows are from below; the second start from above is one too
%   many.
only_start([], _, none) :-
    !.
only_start([Start], _, Start) :-
    !.
only_start(Starts, Rows, _) :-
    reverse(Starts, [_, state([_, Y], _)|_]),
    nth0(Y, Rows, Row),
    domain_error(map_row, Row).

must_be_row(Row) :-
    must_be(nonvar, Row),
    (   atomic(Row),
        atom_chars(Row, Characters),
        \+ ( member(Character, Characters),
             \+ character(Character)
           )
    ->  true
    ;   domain_error(map_row, Row)
    ).

%   Those of the simulator: the rest are free cells.
character(Character) :-
    memberchk(Character,
              [ #, 'O', '.', ' ', 'L', 'S', ^, >, v, <,
                k, b, g, y, r, w, n ]).

start('S', [0, 1]).
start(^, [0, 1]).
start(>, [1, 0]).
start(v, [0, -1]).
start(<, [-1, 0]).
