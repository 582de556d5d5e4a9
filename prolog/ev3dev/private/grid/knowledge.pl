:- module(ev3dev_grid_knowledge,
          [ forget_all/2,               % +Seconds, +Obstructed
            obstructed/1,               % ?Cell
            obstacle_add/1,             % +Cell
            obstacle_remove/1,          % +Cell
            obstacles_fade/1,           % -Cells
            unblocked/1,                % +Cell
            saw_free/1,                 % +Cell
            known_free/1                % ?Cell
          ]).
:- use_module('../run/brick', [brick/1, of_brick/1]).
:- use_module('../errors/public_clauses', [term_expansion/4]).
:- use_module(library(lists), [member/2]).
:- use_module('../../driver', []).
:- use_module(map, [must_be_cell/1]).
:- use_module('../native/native', [now_/1]).

/** <module> A robot's knowledge of its grid

The cells that it found obstructed or free, and when. An obstacle that moves
about is forgotten after some time. Each time that it is still there when the
robot comes again, that time doubles. So an obstacle that stays is at last
remembered for longer than any way takes, and a robot does not go to and fro
between two obstacles without end.
*/

:- dynamic
    obstacle/4,                         % Brick, Cell, State, Seconds
    free/3,                             % Brick, Cell, State
    fading/2.                           % Brick, Seconds or `never`
:- of_brick([obstacle/4, free/3, fading/2]).

%   State is `until(Time)`, `ever`, or `faded`, after which it is only known
%   how long the obstacle was remembered.

%!  forget_all(+Seconds, +Obstructed) is det.
%
%   Know nothing but that the cells Obstructed always are. What is found from
%   now on fades after Seconds, or `never`.

forget_all(Seconds, Obstructed) :-
    brick(Brick),
    retractall(obstacle(Brick, _, _, _)),
    retractall(free(Brick, _, _)),
    retractall(fading(Brick, _)),
    assertz(fading(Brick, Seconds)),
    forall(member(Cell, Obstructed),
           assertz(obstacle(Brick, Cell, ever, never))).

%!  obstructed(?Cell) is nondet.
%
%   True if an obstacle is known in Cell that has not faded. As in the paper,
%   but obstacle_add/1 and obstacle_remove/1 change what is known.

obstructed(Cell) :-
    ground(Cell),
    !,
    brick(Brick),
    obstacle(Brick, Cell, State, _),
    !,
    lasts(State).
obstructed(Cell) :-
    brick(Brick),
    obstacle(Brick, Cell, State, _),
    lasts(State).

lasts(ever).
lasts(until(Time)) :-
    now_(Now),
    Now < Time.

%!  obstacle_add(+Cell) is det.
%
%   Note an obstacle in Cell, which fades like those that the robot finds.
%
%   @error domain_error(grid_cell, Cell)

obstacle_add(Cell) :-
    must_be_cell(Cell),
    brick(Brick),
    (   obstacle(Brick, Cell, State0, Seconds0)
    ->  longer(State0, Seconds0, Seconds)
    ;   fades_after(Brick, Seconds)
    ),
    for_long(Seconds, State),
    retractall(free(Brick, Cell, _)),
    retractall(obstacle(Brick, Cell, _, _)),
    assertz(obstacle(Brick, Cell, State, Seconds)).

fades_after(Brick, Seconds) :-
    (   fading(Brick, Seconds0)
    ->  Seconds = Seconds0
    ;   Seconds = never
    ).

longer(State, Seconds0, Seconds) :-
    (   lasts(State)
    ->  Seconds = Seconds0
    ;   Seconds is 2 * Seconds0
    ).

for_long(never, ever) :-
    !.
for_long(Seconds, until(Time)) :-
    now_(Now),
    Time is Now + Seconds.

%!  obstacle_remove(+Cell) is semidet.
%
%   Forget the obstacle in Cell. Fails if none is known there.
%
%   @error domain_error(grid_cell, Cell)

obstacle_remove(Cell) :-
    must_be_cell(Cell),
    obstructed(Cell),
    brick(Brick),
    retractall(obstacle(Brick, Cell, _, _)).

%!  obstacles_fade(-Cells) is det.
%
%   Let what is to fade by now be gone for unblocked/1, too: true if Cells are
%   where that changed something.

obstacles_fade(Cells) :-
    brick(Brick),
    findall(Cell-Seconds,
            ( obstacle(Brick, Cell, State, Seconds),
              State \== faded,
              \+ lasts(State)
            ),
            Faded),
    findall(Cell,
            ( member(Cell-Seconds, Faded),
              retractall(obstacle(Brick, Cell, _, _)),
              assertz(obstacle(Brick, Cell, faded, Seconds))
            ),
            Cells).

%!  unblocked(+Cell) is semidet.
%
%   True if no obstacle in Cell was known when obstacles_fade/1 was last
%   called, or has been found since. A planner asks this, for which the map
%   may not change while it searches.

unblocked(Cell) :-
    brick(Brick),
    \+ ( obstacle(Brick, Cell, State, _),
         State \== faded
       ).

%!  saw_free(+Cell) is det.
%!  known_free(?Cell) is nondet.
%
%   Note that there is nothing in Cell; true if that was noted and has not
%   faded.

saw_free(Cell) :-
    brick(Brick),
    fades_after(Brick, Seconds),
    for_long(Seconds, State),
    retractall(obstacle(Brick, Cell, _, _)),
    retractall(free(Brick, Cell, _)),
    assertz(free(Brick, Cell, State)).

known_free(Cell) :-
    ground(Cell),
    !,
    brick(Brick),
    free(Brick, Cell, State),
    !,
    lasts(State).
known_free(Cell) :-
    brick(Brick),
    free(Brick, Cell, State),
    lasts(State).
