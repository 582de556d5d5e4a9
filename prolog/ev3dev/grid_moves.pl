:- module(ev3dev_grid_moves,
          [ set_grid/1,                 % +Options
            grid/1,                     % -Map
            grid_place/2,               % +Cell, +Direction
            state_position/2,           % ?Cell, ?Direction
            carry_out/3                 % +Plan, :Tell_1, -Outcome
          ]).
:- use_module(library(apply), [maplist/2]).
:- use_module(library(error), [domain_error/2, must_be/2]).
:- use_module(library(lists), [member/2]).
:- use_module(library(option), [option/2, option/3]).
:- use_module(drive, [face/2, go_to/4, set_pose/3]).
:- use_module(grid_compass).
:- use_module(grid_knowledge).
:- use_module(grid_map).
:- use_module(options, [take_options/4]).
:- use_module(sensors, [us_dist_cm/2]).

/** <module> A robot that goes from cell to cell

Where it is on its grid, how it moves there, and how it looks before it does.
*/

:- meta_predicate carry_out(+, 1, -).

:- dynamic
    state_position/2,                   % Cell, Direction
    grid_is/2.                          % Map, Metric

%!  set_grid(+Options) is semidet.
%
%   Begin anew on a grid of which nothing is known, the robot in the middle of
%   a cell. Fails if no robot is set, or a motor is not connected. Options are
%   those of grid_map/2, where `rows` and `obstacles` are what is known from
%   the start, and
%
%     - start(+Cell, +Direction)
%       Where the robot is, by default as drawn in `rows`, or in [0,0] with
%       direction [0,1].
%     - cell_cm(+Cm)
%       How wide a cell is, by default 20.
%     - origin(+X, +Y)
%       Where the middle of the cell [0,0] is for pose/3, by default 0, 0.
%     - eye(+Cm)
%       How far the ultrasonic sensor is ahead of the middle of the axle, by
%       default 7.
%     - speed(+Percent)
%       Of all moves, by default 20.
%     - fade(+Seconds)
%       After so long an obstacle that was found is forgotten, and longer each
%       time it is found again. By default `never`.
%
%   @error domain_error(Option, Value)
%   @error domain_error(grid_option, Option) for an option that is none

set_grid(Options) :-
    take_options([start/2, cell_cm, origin/2, eye, speed, fade], Options,
                 Own, MapOptions),
    grid_map(MapOptions, Map0),
    findall(Cell,
            ( grid_cell(Map0, Cell), \+ free_cell(Map0, Cell) ),
            Obstructed),
    grid_unknown(Map0, ev3dev_grid_knowledge:unblocked, Map),
    start(Own, Map0, Cell, Direction),
    metric(Own, Metric),
    option(fade(Fade), Own, never),
    (   Fade == never
    ->  true
    ;   must_be_positive(fade, Fade)
    ),
    set_pose_in(Metric, Cell, Direction),
    forget_all(Fade, Obstructed),
    retractall(grid_is(_, _)),
    assertz(grid_is(Map, Metric)),
    set_state(Cell, Direction).

start(Options, Map, Cell, Direction) :-
    (   option(start(Cell, Direction), Options)
    ->  true
    ;   grid_start(Map, state(Cell, Direction))
    ->  true
    ;   Cell = [0, 0],
        Direction = [0, 1]
    ),
    must_be_state(Map, state(Cell, Direction)).

metric(Options, metric(Cm, X, Y, Eye, Speed)) :-
    option(cell_cm(Cm), Options, 20),
    must_be_positive(cell_cm, Cm),
    (   option(origin(X, Y), Options)
    ->  true
    ;   X = 0,
        Y = 0
    ),
    maplist(must_be(number), [X, Y]),
    option(eye(Eye), Options, 7),
    must_be(number, Eye),
    option(speed(Speed), Options, 20),
    must_be_positive(speed, Speed),
    (   Speed =< 100
    ->  true
    ;   domain_error(speed, Speed)
    ).

must_be_positive(Option, Number) :-
    must_be(number, Number),
    (   Number > 0,
        Number < inf
    ->  true
    ;   domain_error(Option, Number)
    ).

%!  grid_place(+Cell, +Direction) is semidet.
%
%   The robot was put into the middle of Cell. It keeps what it knows. Fails
%   if there is no grid.
%
%   @error domain_error(grid_state, State)

grid_place(Cell, Direction) :-
    grid_is(Map, Metric),
    must_be_state(Map, state(Cell, Direction)),
    set_pose_in(Metric, Cell, Direction),
    set_state(Cell, Direction).

set_pose_in(Metric, Cell, Direction) :-
    place(Metric, Cell, X, Y),
    direction_heading(Direction, Heading),
    set_pose(X, Y, Heading).

place(metric(Cm, X0, Y0, _, _), [CX, CY], X, Y) :-
    X is X0 + Cm*CX,
    Y is Y0 + Cm*CY.

set_state(Cell, Direction) :-
    retractall(state_position(_, _)),
    assertz(state_position(Cell, Direction)).

%!  state_position(?Cell, ?Direction) is semidet.
%
%   True if the robot is in Cell and looks in Direction. If a move ended early
%   it is still in the cell from which it started, as far as one can tell.

%!  grid(-Map) is semidet.
%
%   True if Map is that of the grid that was set.

grid(Map) :-
    grid_is(Map, _).

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
    (   grid_is(Map, Metric)
    ->  carry_out(Plan, Map, Metric, Tell, Outcome)
    ;   Outcome = ended(no_grid)
    ).

carry_out([], _, _, _, done).
carry_out([Action|Plan], Map, Metric, Tell, Outcome) :-
    state_position(_, Direction0),
    turns([Action|Plan], Map, Direction0, Direction, Rest0),
    (   Rest0 = [move|Rest]
    ->  move(Direction, Map, Metric, Outcome1)
    ;   Rest = [],
        turn_to(Direction, Metric, Outcome1)
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
turn_to(Direction, metric(_, _, _, _, Speed), Outcome) :-
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
    ;   beside(Cell, Direction, Beside),
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

%   Look into the Cell ahead. What is farther away stands in another one: a
%   diagonal look comes past the corner of the cell at 1.7 widths.

look(Cell, Direction, metric(Cm, _, _, Eye, _), Outcome) :-
    (   us_dist_cm(_, Distance)
    ->  (   reach(Direction, Widths),
            Eye + Distance =< Widths * Cm
        ->  obstacle_add(Cell),
            Outcome = found([Cell])
        ;   saw_free(Cell),
            Outcome = done
        )
    ;   Outcome = ended(no_sensor)
    ).

reach([DX, DY], Widths) :-
    (   DX * DY =:= 0
    ->  Widths = 1.35
    ;   Widths = 1.6
    ).

%   What stops the robot and was not seen is an obstacle, too: then back.

go(Cell, Next, Direction, Metric, Outcome) :-
    Metric = metric(_, _, _, _, Speed),
    go_to_cell(Next, Direction, Metric, Speed, Reason),
    (   Reason == reached
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

go_to_cell(Cell, Direction, Metric, Speed, Reason) :-
    place(Metric, Cell, X, Y),
    direction_heading(Direction, Heading),
    (   go_to(X, Y, Heading, [speed(Speed), reason(Reason0)])
    ->  Reason = Reason0
    ;   Reason = no_robot
    ).
