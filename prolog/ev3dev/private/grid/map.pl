:- module(ev3dev_grid_map,
          [ grid_map/2,                 % :Options, -Map
            grid_start/2,               % +Map, -State
            grid_cell/2,                % +Map, ?Cell
            free_cell/2,                % +Map, ?Cell
            grid_direction/2,           % +Map, ?Direction
            grid_step/4,                % +Map, +Action, +State, -Next
            grid_turn/4,                % +Map, ?Turn, +Direction, -Next
            grid_cost/4,                % +Map, +State, +Action, -Cost
            grid_costs/4,               % +Map, -Straight, -Diagonal, -Turn
            grid_neighbors/2,           % +Map, -Count
            grid_bounds/5,              % +Map, -X1, -Y1, -X2, -Y2
            grid_unknown/3,             % +Map0, :Free_1, -Map
            must_be_cell/1,             % +Cell
            must_be_state/2             % +Map, +State
          ]).
:- use_module('../basics/fields',
              [fields/1, goal_expansion/2, term_expansion/2]).
:- use_module(library(apply), [maplist/2]).
:- use_module(library(assoc), [empty_assoc/1, get_assoc/3, list_to_assoc/2]).
:- use_module('../checks/checks', [must_be/2]).
:- use_module('../errors/errors', [domain_error/2]).
:- use_module('../errors/public_clauses', [term_expansion/4]).
:- use_module(library(lists), [member/2]).
:- use_module(library(option), [meta_options/3, option/2, option/3]).
:- use_module(compass).
:- use_module('../checks/arguments', [must_be_options/3]).
:- use_module('../native/native', [grid_drawn_/2]).

:- fields(map(bounds, neighbors, costs, obstacles, free, start)).

/** <module> Maps of grids

A map of square cells, some of them obstructed, for a robot that goes from
cell to cell and turns on the spot.

A cell is `[X, Y]`, two integers. A direction is `[DX, DY]`, the way to the
next cell: `[0,1]` up, `[1,0]` to the right, and with eight neighbors also
`[1,1]` and the like. A state is `state(Cell, Direction)`.

The actions are `move`, to the next cell ahead, and `left` and `right`, to the
next direction: by a right angle with four neighbors, by half of one with
eight. A diagonal move also needs the two cells beside its way.
*/

:- meta_predicate
    grid_map(:, -),
    grid_unknown(+, 1, -).

%!  grid_map(:Options, -Map) is det.
%
%   Make a map. Options:
%
%     - bounds(+X1, +Y1, +X2, +Y2)
%       Its lower left and its upper right cell, by default those of Rows, or
%       0, 0, 7, 7.
%     - rows(+Rows)
%       Draw it as the fact map/2 of a world: strings or atoms, a character
%       for each cell, the first of the last row for the cell [0,0]. What is
%       `#` or `O` is obstructed; `^`, `>`, `v`, `<` or `S` is the start.
%     - obstacles(+Cells)
%       These cells are obstructed.
%     - free(:Goal)
%       A cell is free only if call(Goal, Cell) is true. It is called each
%       time, so that the map may change.
%     - neighbors(+Count)
%       4 (default) or 8.
%     - move_cost(+Cost)
%     - diagonal_cost(+Cost)
%     - turn_cost(+Cost)
%       The costs of a move, straight or diagonal, and a turn to the next
%       direction: positive integers. By default 20, 28, and 10 or, with eight
%       neighbors, 5: tenths of a second, about, for cells of 20 cm.
%
%   @error domain_error(map_row, Row) for an unknown character or a second
%          start
%   @error domain_error(neighbors, Count)
%   @error domain_error(bounds, Bounds) if they hold no cell
%   @error domain_error(grid_option, Option) if Option is not an option here

grid_map(Module:Options0, Map) :-
    must_be_options(grid_option,
                    [ bounds/4, rows, obstacles, free, neighbors, move_cost,
                      diagonal_cost, turn_cost ],
                    Options0),
    meta_options(closure, Module:Options0, Options),
    option(rows(Rows), Options, []),
    drawn(Rows, Drawn, Start, Bounds0),
    option(obstacles(Cells), Options, []),
    must_be_cells(Cells),
    findall(Cell-true, ( member(Cell, Cells) ; member(Cell, Drawn) ), Pairs0),
    sort(Pairs0, Pairs),
    list_to_assoc(Pairs, Obstacles),
    (   option(bounds(X1, Y1, X2, Y2), Options)
    ->  Bounds = bounds(X1, Y1, X2, Y2)
    ;   Bounds = Bounds0
    ),
    must_be_bounds(Bounds),
    option(free(Free), Options, any),
    option(neighbors(Neighbors), Options, 4),
    costs(Neighbors, Options, Costs),
    Map = map(Bounds, Neighbors, Costs, Obstacles, Free, Start).

closure(free).

%   Without rows there are 8 by 8 cells.

drawn(Rows, Obstacles, Start, Bounds) :-
    must_be(list, Rows),
    grid_drawn_(Rows, drawn(Width, Height, Obstacles, Start0)),
    (   Rows == []
    ->  Bounds = bounds(0, 0, 7, 7)
    ;   X2 is max(0, Width - 1),
        Y2 is Height - 1,
        Bounds = bounds(0, 0, X2, Y2)
    ),
    (   Start0 = start(Cell, Heading)
    ->  direction_heading(Direction, Heading),
        Start = state(Cell, Direction)
    ;   Start = none
    ).

must_be_cells(Cells) :-
    must_be(list, Cells),
    maplist(must_be_cell, Cells).

%!  must_be_cell(+Cell)
%
%   Throw unless Cell is `[X, Y]`.
%
%   @error domain_error(grid_cell, Cell)

must_be_cell(Cell) :-
    must_be(ground, Cell),
    (   Cell = [X, Y],
        integer(X),
        integer(Y)
    ->  true
    ;   domain_error(grid_cell, Cell)
    ).

must_be_bounds(Bounds) :-
    Bounds = bounds(X1, Y1, X2, Y2),
    maplist(must_be(integer), [X1, Y1, X2, Y2]),
    (   X1 =< X2,
        Y1 =< Y2
    ->  true
    ;   domain_error(bounds, Bounds)
    ).

costs(Neighbors, Options, costs(Move, Diagonal, Turn)) :-
    must_be(nonvar, Neighbors),
    (   turn_default(Neighbors, Turn0)
    ->  true
    ;   domain_error(neighbors, Neighbors)
    ),
    option(move_cost(Move), Options, 20),
    must_be(positive_integer, Move),
    Diagonal0 is round(Move * sqrt(2)),
    option(diagonal_cost(Diagonal), Options, Diagonal0),
    option(turn_cost(Turn), Options, Turn0),
    must_be(positive_integer, Diagonal),
    must_be(positive_integer, Turn).

turn_default(4, 10).
turn_default(8, 5).

%!  grid_unknown(+Map0, :Free_1, -Map) is det.
%
%   True if Map is like Map0, but only call(Free_1, Cell) decides which of its
%   cells are free.

grid_unknown(map(Bounds, Neighbors, Costs, _, _, Start), Free,
             map(Bounds, Neighbors, Costs, None, Free, Start)) :-
    empty_assoc(None).

%!  grid_start(+Map, -State) is semidet.
%
%   True if State is the start drawn in the map's rows.

grid_start(Map, State) :-
    Map = map(start: Start),
    Start \== none,
    State = Start.

%!  grid_cell(+Map, ?Cell) is nondet.
%
%   True if Cell is on the map.

grid_cell(Map, [X, Y]) :-
    Map = map(bounds: bounds(X1, Y1, X2, Y2)),
    between(Y1, Y2, Y),
    between(X1, X2, X).

%!  grid_neighbors(+Map, -Count) is det.
%
%   True if each cell of Map has 4 or 8 neighbors.

grid_neighbors(Map, Neighbors) :-
    Map = map(neighbors: Neighbors).

%!  grid_bounds(+Map, -X1, -Y1, -X2, -Y2) is det.
%
%   True if the lower left cell of Map is `[X1, Y1]`, and the upper right one
%   `[X2, Y2]`.

grid_bounds(Map, X1, Y1, X2, Y2) :-
    Map = map(bounds: bounds(X1, Y1, X2, Y2)).

%!  free_cell(+Map, ?Cell) is nondet.
%
%   True if Cell is on the map, and not obstructed.

free_cell(Map, Cell) :-
    grid_cell(Map, Cell),
    Map = map(obstacles: Obstacles, free: Free),
    \+ get_assoc(Cell, Obstacles, _),
    (   Free == any
    ->  true
    ;   \+ \+ call(Free, Cell)
    ).

%!  grid_direction(+Map, ?Direction) is nondet.
%
%   True if Direction is one of the map's, clockwise from `[0,1]` on.

grid_direction(Map, Direction) :-
    Map = map(neighbors: Neighbors),
    grid_directions(Neighbors, Directions),
    (   ground(Direction)
    ->  memberchk(Direction, Directions)
    ;   member(Direction, Directions)
    ).

%!  grid_step(+Map, +Action, +State, -Next) is det.
%
%   True if Action leads from State to Next, were nothing in the way.
%
%   @error domain_error(grid_action, Action)

grid_step(Map, Action, state(Cell, Direction), Next) :-
    must_be(nonvar, Action),
    (   Action == move
    ->  grid_ahead(Cell, Direction, Cell1),
        Next = state(Cell1, Direction)
    ;   grid_turn(Map, Action, Direction, Direction1)
    ->  Next = state(Cell, Direction1)
    ;   domain_error(grid_action, Action)
    ).

%!  grid_turn(+Map, ?Turn, +Direction, -Next) is nondet.
%
%   True if Turn, `left` or `right`, leads from one direction to the next.

grid_turn(Map, Turn, Direction, Next) :-
    Map = map(neighbors: Neighbors),
    direction_turned(Turn, Neighbors, Direction, Next).

%!  grid_costs(+Map, -Straight, -Diagonal, -Turn) is det.
%
%   True if these are the costs of a straight and a diagonal move, and of a
%   turn to the next direction.

grid_costs(Map,
           Straight, Diagonal, Turn) :-
    Map = map(costs: costs(Straight, Diagonal, Turn)).

%!  grid_cost(+Map, +State, +Action, -Cost) is det.
%
%   True if Action costs that much in State.

grid_cost(Map,
          state(_, [DX, DY]), Action, Cost) :-
    Map = map(costs: costs(Straight, Diagonal, Turn)),
    (   Action \== move
    ->  Cost = Turn
    ;   DX * DY =:= 0
    ->  Cost = Straight
    ;   Cost = Diagonal
    ).

%!  must_be_state(+Map, +State)
%
%   Throw unless State is `state(Cell, Direction)` with a direction of Map.
%
%   @error domain_error(grid_state, State)

must_be_state(Map, State) :-
    must_be(ground, State),
    (   State = state(Cell, Direction)
    ->  must_be_cell(Cell),
        grid_direction(Map, Direction)
    ),
    !.
must_be_state(_, State) :-
    domain_error(grid_state, State).
