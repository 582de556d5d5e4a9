% A way through a grid that is known, by breadth-first search.

:- use_module(library(ev3dev)).
:- use_module(library(ev3dev/grid)).

%   8 by 8 cells, and the boxes in them.
box_in(1, 0). box_in(1, 1). box_in(1, 2). box_in(3, 1). box_in(3, 2).
box_in(3, 3). box_in(2, 4). box_in(3, 4). box_in(5, 2). box_in(5, 3).
box_in(5, 5). box_in(5, 6). box_in(6, 5). box_in(1, 6). box_in(0, 5).
box_in(7, 4).

free([X, Y]) :-
    between(0, 7, X),
    between(0, 7, Y),
    \+ box_in(X, Y).

%   One step of a plan: from a state to the next one.
step(move, state([X0, Y0], [DX, DY]), state([X, Y], [DX, DY])) :-
    X is X0+DX,
    Y is Y0+DY,
    free([X, Y]).
step(right, state(Cell, [DX, DY]), state(Cell, [DY, Left])) :-
    Left is -DX.
step(left, state(Cell, [DX, DY]), state(Cell, [Left, DX])) :-
    Left is -DY.

start :-
    set_robot(5.6, 10.6, outB, outC),
    set_grid([]),
    plan(state([0, 0], [0, 1]), state([7, 7], _), Plan),
    execute_plan(Plan).

%   plan(+Start, +Goal, -Plan): the first state that is reached is on a way
%   with the fewest steps.
plan(Start, Goal, Plan) :-
    search([Start-[]], [Start], Goal, Reversed),
    reverse(Reversed, Plan).

search([Goal-Plan|_], _, Goal, Plan) :-
    !.
search([State-Plan|Queue0], Seen0, Goal, Found) :-
    findall(Next-[Action|Plan],
            ( step(Action, State, Next),
              \+ memberchk(Next, Seen0) ),
            Nexts),
    findall(Next, member(Next-_, Nexts), States),
    append(Seen0, States, Seen),
    append(Queue0, Nexts, Queue),
    search(Queue, Seen, Goal, Found).
