% A robot that finds its way over a grid that it does not know. Its planner
% takes the cells of which nothing is known as free.

:- use_module(library(ev3dev)).
:- use_module(library(ev3dev/grid)).

start :-
    set_robot(5.6, 10.6, outB, outC),
    set_grid([]),
    plan_and_go_to([7, 7], _, [planner(plan)]).

free([X, Y]) :-
    between(0, 7, X),
    between(0, 7, Y),
    \+ obstructed([X, Y]).

step(move, state([X0, Y0], [DX, DY]), state([X, Y], [DX, DY])) :-
    X is X0+DX,
    Y is Y0+DY,
    free([X, Y]).
step(right, state(Cell, [DX, DY]), state(Cell, [DY, Left])) :-
    Left is -DX.
step(left, state(Cell, [DX, DY]), state(Cell, [Left, DX])) :-
    Left is -DY.

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
