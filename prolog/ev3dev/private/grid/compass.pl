:- module(ev3dev_grid_compass,
          [ grid_directions/2,          % +Neighbors, -Directions
            direction_heading/2,        % ?Direction, ?Heading
            direction_turned/4,         % ?Turn, +Neighbors, +Direction,
                                        % -Next
            grid_ahead/3,               % +Cell, +Direction, -Ahead
            grid_beside/4               % +Cell, +Direction, -Left, -Right
          ]).
:- use_module('../errors/public_clauses', [term_expansion/4]).
:- use_module(library(lists), [nth0/3]).

/** <module> Directions on a grid
*/

%!  grid_directions(+Neighbors, -Directions) is det.
%
%   True if Directions, clockwise from `[0,1]` on, are those of a grid whose
%   cells have 4 or 8 neighbors.

grid_directions(4, [[0,1], [1,0], [0,-1], [-1,0]]).
grid_directions(8, [ [0,1], [1,1], [1,0], [1,-1], [0,-1], [-1,-1], [-1,0],
             [-1,1]
           ]).

%!  direction_heading(+Direction, -Heading) is semidet.
%!  direction_heading(-Direction, +Heading) is semidet.
%
%   True if Heading is that angle clockwise from up, from 0 to 315 degrees.

direction_heading(Direction, Heading) :-
    grid_directions(8, Directions),
    nth0(Eighth, Directions, Direction),
    Angle is Eighth * 45,
    Heading = Angle,
    !.

%!  direction_turned(?Turn, +Neighbors, +Direction, -Next) is nondet.
%
%   True if Turn, `left` or `right`, leads from one direction to the next.

direction_turned(right, 4, [DX, DY], [DY, Left]) :-
    Left is -DX.
direction_turned(left, 4, [DX, DY], [Left, DX]) :-
    Left is -DY.
direction_turned(right, 8, [DX0, DY0], [DX, DY]) :-
    DX is sign(DX0 + DY0),
    DY is sign(DY0 - DX0).
direction_turned(left, 8, [DX0, DY0], [DX, DY]) :-
    DX is sign(DX0 - DY0),
    DY is sign(DX0 + DY0).

%!  grid_ahead(+Cell, +Direction, -Ahead) is det.
%
%   True if Ahead is next to Cell in that direction.

grid_ahead([X0, Y0], [DX, DY], [X, Y]) :-
    X is X0 + DX,
    Y is Y0 + DY.

%!  grid_beside(+Cell, +Direction, -Left, -Right) is semidet.
%
%   True if a diagonal move from Cell passes between the cells Left and Right.
%   Each is next to Cell. Fails if Direction is not diagonal.

grid_beside([X0, Y0], [DX, DY], Left, Right) :-
    DX =\= 0,
    DY =\= 0,
    X is X0 + DX,
    Y is Y0 + DY,
    (   DX =:= DY
    ->  Left = [X0, Y],
        Right = [X, Y0]
    ;   Left = [X, Y0],
        Right = [X0, Y]
    ).
