:- module(caves,
          [ random_cave/2,              % +Seed, -Cave
            is_deadly/2,                % ?Cell, +Cave
            safe_beside/3,              % +Visited, +Cave, -Cells
            explored/2                  % +Cave, -Cells
          ]).
:- use_module(library(lists)).
:- use_module(library(random)).

/** <module> Caves of the wumpus, and what can be known in them

A cave is cave(Wumpus, Pits, Gold), of cells X-Y from 0 to 3. What is safe is
found from all caves that look the same from the cells that were visited: no
library(ev3dev/golog), no possible values of fluents one by one.
*/

cell(X-Y) :-
    between(0, 3, X),
    between(0, 3, Y).

beside(X-Y, X1-Y1) :-
    cell(X1-Y1),
    1 =:= abs(X-X1) + abs(Y-Y1).

%!  random_cave(+Seed, -Cave) is det.
%
%   The robot starts in 0-0, so neither the wumpus nor a pit is there.

random_cave(Seed, cave(Wumpus, Pits, Gold)) :-
    set_random(seed(Seed)),
    findall(C, ( cell(C), C \== 0-0 ), Cells),
    random_member(Wumpus, Cells),
    random_member(Gold, Cells),
    findall(C, ( member(C, Cells), random_between(1, 6, 1) ), Pits).

%!  is_deadly(?Cell, +Cave) is nondet.

is_deadly(Wumpus, cave(Wumpus, _, _)).
is_deadly(Pit, cave(_, Pits, _)) :-
    member(Pit, Pits).

%!  safe_beside(+Visited, +Cave, -Cells) is det.
%
%   Cells are all those beside the Visited ones, in standard order, that have
%   neither a pit nor the wumpus in any cave that smells in the same cells of
%   Visited, and has a draft in the same.

safe_beside(Visited, cave(Wumpus, Pits, _), Cells) :-
    setof(C, V^( member(V, Visited), beside(V, C), \+ memberchk(C, Visited) ),
          Border),
    !,
    include(beside(Wumpus), Visited, Smelling),
    include(beside_one(Pits), Visited, Drafty),
    findall(W,
            ( cell(W), \+ memberchk(W, Visited),
              include(beside(W), Visited, Smelling) ),
            Wumpuses),
    findall(Ps,
            ( part_of(Border, Ps),
              include(beside_one(Ps), Visited, Drafty) ),
            Pitfalls),
    append([Wumpuses|Pitfalls], Deadly),
    subtract(Border, Deadly, Cells).
safe_beside(_, _, []).

beside_one(Cells, C) :-
    member(D, Cells),
    beside(D, C),
    !.

part_of([], []).
part_of([X|Xs], Part) :-
    part_of(Xs, Part0),
    ( Part = Part0 ; Part = [X|Part0] ).

%!  explored(+Cave, -Cells) is det.
%
%   Cells are all that a robot can come to, from 0-0, and enters knowing that
%   they are safe.

explored(Cave, Cells) :-
    explored([0-0], Cave, Cells).

explored(Visited, Cave, Cells) :-
    safe_beside(Visited, Cave, More),
    (   More == []
    ->  sort(Visited, Cells)
    ;   append(More, Visited, Visited1),
        explored(Visited1, Cave, Cells)
    ).
