:- module(grid_planner, [own_plan/4]).
:- use_module(library(lists), [append/3, reverse/2]).

/** <module> A planner for grid_navigation.pl

Breadth-first search: it finds the shortest plan and counts moves and turns
alike. Any other planner may take its place: the program that carries out
plans does not depend on the planner.
*/

:- meta_predicate own_plan(:, +, +, -).

%!  own_plan(:Free_1, +Start, +Goal, -Plan) is semidet.
%
%   True if Plan is a list of `move`, `left` and `right` that leads from Start
%   to Goal, both `state(Cell, Direction)`, through cells for which
%   call(Free_1, Cell) is true. A cell is `[X, Y]`, a direction one of
%   `[0,1]`, `[1,0]`, `[0,-1]`, `[-1,0]`. Fails if there is no plan.

own_plan(Free_1, Start, Goal, Plan) :-
    search([Start-[]], [Start], Free_1, Goal, Reversed),
    reverse(Reversed, Plan).

search([State-Plan|_], _, _, State, Plan) :-
    !.
search([State-Plan|Rest], Seen0, Free_1, Goal, Solution) :-
    findall(Next-[Action|Plan],
            ( successor(Action, State, Next),
              Next = state(Cell, _),
              call(Free_1, Cell),
              \+ memberchk(Next, Seen0)
            ),
            Nexts),
    findall(Next, member(Next-_, Nexts), Found),
    append(Found, Seen0, Seen),
    append(Rest, Nexts, Queue),
    search(Queue, Seen, Free_1, Goal, Solution).

successor(move, state([X0, Y0], [DX, DY]), state([X, Y], [DX, DY])) :-
    X is X0 + DX,
    Y is Y0 + DY.
successor(right, state(Cell, [DX, DY]), state(Cell, [DY, Left])) :-
    Left is -DX.
successor(left, state(Cell, [DX, DY]), state(Cell, [Left, DX])) :-
    Left is -DY.
