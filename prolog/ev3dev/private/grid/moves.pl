:- module(ev3dev_grid_moves,
          [ carry_out/3,                % +Plan, :Tell_1, -Outcome
            go_to_cell/5,               % +Cell, +Direction, +Metric,
                                        % +Speed, -Reason
            planned/2                   % ?Brick, -Cells
          ]).
:- use_module('../basics/fields', [goal_expansion/2, term_expansion/2]).
:- use_module(library(lists), [member/2]).
:- use_module('../../drive', [face/2, go_to/4]).
:- use_module('../run/brick', [brick/1]).
:- use_module('../journal/causes', [acting_for/2]).
:- use_module(compass).
:- use_module(knowledge).
:- use_module(map).
:- use_module(place).
:- use_module('../../odometry', [pose/3, pose_uncertainty/1]).
:- use_module('../../sensors', [us_dist_cm/2]).

/** <module> Moves from cell to cell

How a robot moves on its grid, and how it looks before it does.
*/

:- meta_predicate carry_out(+, 1, -).

:- dynamic planned/2.                   % Brick, Cells

%!  planned(?Brick, -Cells) is nondet.
%
%   While a plan is carried out: the cells of its way, the first one included.
%   library(ev3dev/view) draws them.

%!  carry_out(+Plan, :Tell_1, -Outcome) is det.
%
%   Carry out the actions of a plan; turns that follow each other are one.
%   Outcome is
%
%     - done
%     - found(Cells)
%       There are obstacles in Cells: noted, and the plan was broken off.
%     - ended(Reason)
%       The robot cannot go on: `no_sensor`, `no_robot`, `off_map`, or the
%       reason of a move.
%
%   @error domain_error(grid_action, Action)

carry_out(Plan, Tell, Outcome) :-
    (   grid(Map, Metric)
    ->  brick(Brick),
        state_position(Cell, Direction),
        way(Plan, Map, state(Cell, Direction), Cells),
        setup_call_cleanup(
            assertz(planned(Brick, [Cell|Cells])),
            once(carry_out(Plan, Map, Metric, Tell, Outcome)),
            retractall(planned(Brick, _)))
    ;   Outcome = ended(no_grid)
    ).

way([], _, _, []).
way([Action|Plan], Map, State, Cells) :-
    grid_step(Map, Action, State, Next),
    (   Action == move
    ->  Next = state(Cell, _),
        Cells = [Cell|Cells1]
    ;   Cells = Cells1
    ),
    way(Plan, Map, Next, Cells1).

carry_out([], _, _, _, done).
carry_out([Action|Plan], Map, Metric, Tell, Outcome) :-
    state_position(_, Direction0),
    turns([Action|Plan], Map, Direction0, Direction, Rest0),
    (   Rest0 = [move|Rest]
    ->  move(Direction, Map, Metric, Outcome1)
    ;   Rest = [],
        state_position(Cell0, _),
        acting_for(turn_to(Direction, Metric, Outcome1), plan(turn, Cell0))
    ),
    (   Outcome1 == done
    ->  state_position(Cell1, Direction1),
        ignore(call(Tell, at(Cell1, Direction1))),
        carry_out(Rest, Map, Metric, Tell, Outcome)
    ;   Outcome = Outcome1
    ).

turns([Action|Plan], Map, Direction0, Direction, Rest) :-
    Action \== move,
    !,
    grid_step(Map, Action, state([0, 0], Direction0), state(_, Direction1)),
    turns(Plan, Map, Direction1, Direction, Rest).
turns(Rest, _, Direction, Direction, Rest).

%   Turn on the spot.

turn_to(Direction, _, Outcome) :-
    state_position(_, Direction),
    !,
    Outcome = done.
turn_to(Direction, Metric, Outcome) :-
    Metric = metric(speed: Speed),
    direction_heading(Direction, Heading),
    (   face(Heading, [speed(Speed), reason(Reason)])
    ->  true
    ;   Reason = no_robot
    ),
    (   Reason == reached
    ->  state_position(Cell, _),
        set_state(Cell, Direction),
        Outcome = done
    ;   Outcome = ended(Reason)
    ).

%   Turn, and go to the next cell, if there is nothing in it nor beside the
%   way. Beside is first: from a cell the sonar also sees corners of those.

move(Direction, Map, Metric, Outcome) :-
    state_position(Cell, _),
    grid_step(Map, move, state(Cell, Direction), state(Next, _)),
    (   \+ grid_cell(Map, Next)
    ->  Outcome = ended(off_map)
    ;   acting_for(move(Cell, Next, Direction, Metric, Outcome),
                   plan(move, Next))
    ).

move(Cell, Next, Direction, Metric, Outcome) :-
    (   beside(Cell, Direction, Beside),
        look_into(Beside, Cell, Metric, Seen),
        Seen \== done
    ->  Outcome = Seen
    ;   turn_to(Direction, Metric, Turned),
        Turned \== done
    ->  Outcome = Turned
    ;   look(Next, Direction, Metric, Seen),
        Seen \== done
    ->  Outcome = Seen
    ;   go(Cell, Next, Direction, Metric, Outcome)
    ).

%   The cells beside the way into which the robot has to look.

beside(Cell, Direction, Beside) :-
    (   grid_beside(Cell, Direction, Left, Right)
    ->  findall(Unknown,
                ( member(Unknown, [Left, Right]),
                  \+ known_free(Unknown)
                ),
                Beside)
    ;   Beside = []
    ).

look_into([], _, _, done).
look_into([Beside|Rest], Cell, Metric, Outcome) :-
    Cell = [X0, Y0],
    Beside = [X, Y],
    DX is X - X0,
    DY is Y - Y0,
    turn_to([DX, DY], Metric, Turned),
    (   Turned == done
    ->  look(Beside, [DX, DY], Metric, Seen)
    ;   Seen = Turned
    ),
    (   Seen == done
    ->  look_into(Rest, Cell, Metric, Outcome)
    ;   Outcome = Seen
    ).

%   Look into the Cell ahead. What is farther away stands in another one.

look(Cell, Direction, Metric, Outcome) :-
    Metric = metric(cm: Cm, eye: Eye),
    (   us_dist_cm(_, Distance)
    ->  (   reach(Direction, Cm, Reach),
            Eye + Distance =< Reach
        ->  obstacle_add(Cell),
            Outcome = found([Cell])
        ;   saw_free(Cell),
            Outcome = done
        )
    ;   Outcome = ended(no_sensor)
    ).

%   How far ahead of the robot something surely is in the next cell. That ends
%   after 1.5 widths; a diagonal look comes past its corner at 1.7. The robot
%   may be farther on than it knows, rarely by more than two standard
%   deviations. But what is about as near as the middle of the cell is in it.

reach(Direction, Cm, Reach) :-
    Direction = [DX, DY],
    (   DX * DY =:= 0
    ->  End = 1.5, Most = 1.35, Least = 1.1
    ;   End = 1.7, Most = 1.6, Least = 1.3
    ),
    uncertainty(Direction, Deviation),
    Reach is max(Least * Cm, min(Most * Cm, End * Cm - 2 * Deviation)).

%   The standard deviation of the robot's place in that direction, in cm.
uncertainty([DX, DY], Deviation) :-
    (   pose_uncertainty([[XX, XY, _], [_, YY, _], _])
    ->  Deviation is sqrt(max(0, DX*DX*XX + 2*DX*DY*XY + DY*DY*YY)
                          / (DX*DX + DY*DY))
    ;   Deviation = 0
    ).

%   An unseen thing that stops the robot is an obstacle, too: then back. But
%   where it may be in the middle of the cell already, it ran into what is
%   behind.

go(Cell, Next, Direction, Metric, Outcome) :-
    Metric = metric(speed: Speed),
    go_to_cell(Next, Direction, Metric, Speed, Reason),
    (   Reason == reached
    ->  set_state(Next, Direction),
        Outcome = done
    ;   Reason == stalled,
        may_be_in(Next, Direction, Metric)
    ->  set_state(Next, Direction),
        Outcome = done
    ;   Reason == stalled
    ->  obstacle_add(Next),
        Reverse is -Speed,
        go_to_cell(Cell, Direction, Metric, Reverse, Back),
        (   Back == reached
        ->  Outcome = found([Next])
        ;   Outcome = ended(stalled)
        )
    ;   Outcome = ended(Reason)
    ).

may_be_in(Cell, Direction, Metric) :-
    Metric = metric(cm: Cm),
    Direction = [DX, DY],
    cell_place(Metric, Cell, X, Y),
    pose(AtX, AtY, _),
    uncertainty(Direction, Deviation),
    Left is ((X - AtX)*DX + (Y - AtY)*DY) / sqrt(DX*DX + DY*DY),
    Left =< min(Cm / 4, 2 * Deviation).

%!  go_to_cell(+Cell, +Direction, +Metric, +Speed, -Reason) is det.
%
%   Go to the middle of Cell, and turn to Direction there. Reason is that of
%   go_to/4, or `no_robot`.

go_to_cell(Cell, Direction, Metric, Speed, Reason) :-
    cell_place(Metric, Cell, X, Y),
    direction_heading(Direction, Heading),
    (   go_to(X, Y, Heading, [speed(Speed), reason(Reason0)])
    ->  Reason = Reason0
    ;   Reason = no_robot
    ).
