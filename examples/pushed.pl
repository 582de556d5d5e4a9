% A robot that is pushed off its way, and goes on without planning again: it
% has a policy, which says what to do in each state, and not a plan.
%
%   ?- start.
%
% In the simulator this is the world `grid`. Drag the robot to another cell
% while it drives; in a program, sim_place/3 does so. The policy needs to know
% where the robot is: here by a camera above the floor, which is sim_pose/3.
% On a real floor, library(ev3dev/localize) says so.

:- use_module(library(ev3dev)).
:- use_module(library(ev3dev/drive)).
:- use_module(library(ev3dev/grid)).
:- use_module(library(ev3dev/sim)).

start :-
    set_robot(5.6, 10.6, outB, outC),
    grid_policy([ rows([ "........",
                         ".#...#..",
                         "...#....",
                         "......#.",
                         "#.#.#...",
                         "..#.....",
                         ".#...#..",
                         "........" ]), goal([7, 5]) ], Policy),
    go_by(Policy).

%!  go_by(+Policy) is semidet.
%
%   Do what Policy says, one action after the other, until the robot is at the
%   goal. Fails if there is no way to it from where the robot is.

go_by(Policy) :-
    where(State, X, Y, Heading),
    grid_action(Policy, State, Action, Cost),
    format("~p: ~w, ~w to go~n", [State, Action, Cost]),
    (   Action == fin
    ->  true
    ;   set_pose(X, Y, Heading),
        act(Action, State),
        go_by(Policy)
    ).

%   The cells are 20 cm wide, and [0, 0] is at 0, 0.

where(state([CX, CY], Direction), X, Y, Heading) :-
    sim_pose(X, Y, Heading),
    CX is round(X / 20),
    CY is round(Y / 20),
    Quarter is round(Heading / 90) mod 4 * 90,
    direction_heading(Direction, Quarter).

%   However the move ends, the policy goes on from there.

act(move, state([CX, CY], [DX, DY])) :-
    X is 20 * (CX + DX),
    Y is 20 * (CY + DY),
    go_to(X, Y, [reason(_)]).
act(left, state(_, Direction)) :-
    turn_to(Direction, -90).
act(right, state(_, Direction)) :-
    turn_to(Direction, 90).

turn_to(Direction, Angle) :-
    direction_heading(Direction, Heading),
    face(Heading + Angle, [reason(_)]).
