:- module(ev3dev_grid_problem,
          [ grid_problem/4,             % +Map, +Start, +Goal, -Problem
            grid_changed/3              % +Map, +Cells, -States
          ]).
:- use_module(library(apply), [maplist/2]).
:- use_module('../checks/checks', [must_be/2]).
:- use_module('../errors/public_clauses', [term_expansion/4]).
:- use_module(library(lists), [member/2, nth0/3]).
:- use_module(compass).
:- use_module(map).

/** <module> Planning problems on grids

The problem that a map of private/grid/map.pl poses to a planner of
library(ev3dev/planners).

```
?- grid_map([rows([ "....",
                    ".##.",
                    "^#.."])], Map),
   grid_problem(Map, state([0,0], [0,1]), state([2,0], _), Problem),
   plan(a_star, Problem, Plan).
Plan = [move, move, right, move, move, move, right, move, move, right|...].
```
*/

%!  grid_problem(+Map, +Start, +Goal, -Problem) is det.
%
%   True if Problem, for plan/3, is to get from the state Start to the state
%   Goal. An unbound direction of Goal stands for any.
%
%   @error domain_error(grid_state, State)

grid_problem(Map, Start, Goal0, problem(Start, Goal, Options)) :-
    must_be_state(Map, Start),
    must_be(nonvar, Goal0),
    (   Goal0 = state(Cell, Direction),
        var(Direction)
    ->  must_be_cell(Cell),
        findall(state(Cell, Direction), grid_direction(Map, Direction),
                Goals),
        Goal = any(Goals)
    ;   must_be_state(Map, Goal0),
        Goal = Goal0
    ),
    Options = [ successor(ev3dev_grid_problem:next(Map)),
                predecessor(ev3dev_grid_problem:previous(Map)),
                heuristic(ev3dev_grid_problem:estimate(Map))
              ].

next(Map, state(Cell, Direction), move, state(Next, Direction), Cost) :-
    grid_ahead(Cell, Direction, Next),
    way(Map, Cell, Next, Direction, Cost).
next(Map, state(Cell, Direction), Turn, state(Cell, Next), Cost) :-
    grid_turn(Map, Turn, Direction, Next),
    grid_cost(Map, state(Cell, Direction), Turn, Cost).

previous(Map, state(Cell, Direction), move, state(Before, Direction),
         Cost) :-
    behind(Cell, Direction, Before),
    way(Map, Before, Cell, Direction, Cost).
previous(Map, state(Cell, Direction), Turn, state(Cell, Before), Cost) :-
    opposite(Turn, Back),
    grid_turn(Map, Back, Direction, Before),
    grid_cost(Map, state(Cell, Before), Turn, Cost).

opposite(left, right).
opposite(right, left).

behind([X0, Y0], [DX, DY], [X, Y]) :-
    X is X0 - DX,
    Y is Y0 - DY.

way(Map, From, To, Direction, Cost) :-
    free_cell(Map, From),
    free_cell(Map, To),
    (   grid_beside(From, Direction, Left, Right)
    ->  free_cell(Map, Left),
        free_cell(Map, Right)
    ;   true
    ),
    grid_cost(Map, state(From, Direction), move, Cost).

%   What it costs on an empty grid: the moves, and the fewest turns with which
%   the robot at some time looks each way that it has to go.

estimate(Map, state([X1, Y1], Direction1), state([X2, Y2], Direction2),
         Estimate) :-
    grid_neighbors(Map, Neighbors),
    grid_costs(Map, Straight, Diagonal, Turn),
    DX is abs(X2 - X1),
    DY is abs(Y2 - Y1),
    SX is sign(X2 - X1),
    SY is sign(Y2 - Y1),
    fewest_turns(Map, Direction1, [SX, SY], Direction2, Turns),
    (   Neighbors =:= 4
    ->  Estimate is Straight * (DX+DY) + Turn * Turns
    ;   Both is min(DX, DY),
        Estimate is min(Diagonal, 2*Straight) * Both
                    + min(Straight, Diagonal) * (max(DX, DY) - Both)
                    + Turn * Turns
    ).

:- dynamic known_turns/2.               % Key, Turns

fewest_turns(Map, Direction1, Way, Direction2, Turns) :-
    grid_neighbors(Map, Neighbors),
    code(Direction1, Code1),
    code(Way, Code2),
    code(Direction2, Code3),
    Key is ((Neighbors * 9 + Code1) * 9 + Code2) * 9 + Code3,
    (   known_turns(Key, Known)
    ->  Turns = Known
    ;   count_turns(Map, Direction1, Way, Direction2, Turns),
        assertz(known_turns(Key, Turns))
    ).

code([DX, DY], Code) :-
    Code is DX*3 + DY + 4.

count_turns(Map, Direction1, [SX, SY], Direction2, Turns) :-
    findall(Direction, grid_direction(Map, Direction), All),
    length(All, Neighbors),
    nth0(From, All, Direction1),
    nth0(To, All, Direction2),
    findall(Count,
            ( nth0(A, All, [DXA, _]),
              ( SX =:= 0 -> true ; DXA =:= SX ),
              nth0(B, All, [_, DYB]),
              ( SY =:= 0 -> true ; DYB =:= SY ),
              (   turns([From, A, B, To], Neighbors, 0, Count)
              ;   turns([From, B, A, To], Neighbors, 0, Count)
              )
            ),
            Counts),
    sort(Counts, [Turns|_]),
    !.

turns([_], _, Count, Count) :-
    !.
turns([A, B|Rest], Neighbors, Count0, Count) :-
    Right is (B - A) mod Neighbors,
    Count1 is Count0 + min(Right, Neighbors - Right),
    turns([B|Rest], Neighbors, Count1, Count).

%!  grid_changed(+Map, +Cells, -States) is det.
%
%   True if States are those from which ways have changed, for replan/5, when
%   the map's Goal `free` has come to another opinion about Cells.

grid_changed(Map, Cells, States) :-
    must_be(list, Cells),
    maplist(must_be_cell, Cells),
    findall(state(From, Direction),
            ( member(Cell, Cells),
              grid_direction(Map, Direction),
              touches(Direction, Cell, From),
              grid_cell(Map, From)
            ),
            States0),
    sort(States0, States).

touches(_, Cell, Cell).
touches(Direction, Cell, From) :-
    behind(Cell, Direction, From).
touches([DX, DY], [X, Y], From) :-
    DX =\= 0,
    DY =\= 0,
    (   X1 is X - DX,
        From = [X1, Y]
    ;   Y1 is Y - DY,
        From = [X, Y1]
    ).
