:- module(ev3dev_grid_place,
          [ set_grid/1,                 % +Options
            grid/2,                     % -Map, -Metric
            on_grid/3,                  % ?Brick, -Map, -Metric
            grid_place/2,               % +Cell, +Direction
            state_position/2,           % ?Cell, ?Direction
            set_state/2,                % +Cell, +Direction
            cell_place/4,               % +Metric, +Cell, -X, -Y
            grid_metric/2,              % +Options, -Metric
            set_pose_in/3               % +Metric, +Cell, +Direction
          ]).
:- use_module('../basics/fields',
              [fields/1, goal_expansion/2, term_expansion/2]).
:- use_module('../run/brick', [brick/1, of_brick/1]).
:- use_module('../errors/public_clauses', [term_expansion/4]).
:- use_module('../explain/hints', [fail_because/1]).
:- use_module('../../drive', [set_pose/3]).
:- use_module(compass).
:- use_module(knowledge).
:- use_module(map).
:- use_module('../checks/arguments',
              [ number_option/4, number_value/2, number_value/3, option/2,
                option/3, take_options/4
              ]).

:- fields(metric(cm, x, y, eye, speed)).

/** <module> A robot on a grid

The grid of the brick in use, and where the robot is on it.
*/

:- dynamic
    stands/3,                           % Brick, Cell, Direction
    on_grid/3.                          % Brick, Map, Metric
:- of_brick([stands/3, on_grid/3]).

%!  on_grid(?Brick, -Map, -Metric) is nondet.
%
%   As grid/2, which it serves, for any brick and without a hint.

%!  set_grid(+Options) is semidet.
%
%   Begin with an unknown grid and the robot in the middle of a cell. Fails if
%   no robot is set, or a motor is not connected. Options are those of
%   grid_map/2, where `rows` and `obstacles` are what is known from the start,
%   and
%
%     - start(+Cell, +Direction)
%       The robot's cell, by default as drawn in `rows`, or in [0,0] with
%       direction [0,1].
%     - cell_cm(+Cm)
%       How wide a cell is, by default 20.
%     - origin(+X, +Y)
%       The middle of the cell [0,0] for pose/3, by default 0, 0.
%     - eye(+Cm)
%       How far the ultrasonic sensor is ahead of the middle of the axle, by
%       default 7.
%     - speed(+Percent)
%       Of all moves, by default 20.
%     - fade(+Seconds)
%       After so long an obstacle that was found is forgotten, and longer each
%       time it is found again. By default `never`.
%
%   Numbers may be arithmetic expressions.
%
%   @error domain_error(positive_number, Number) for `cell_cm` and `fade`
%   @error domain_error(speed_ahead, Percent) if it is not above 0, or above
%          100
%   @error domain_error(grid_option, Option) if Option is not an option here

set_grid(Options) :-
    take_options([start/2, cell_cm, origin/2, eye, speed, fade], Options,
                 Own, MapOptions),
    grid_map(MapOptions, Map0),
    findall(Cell,
            ( grid_cell(Map0, Cell), \+ free_cell(Map0, Cell) ),
            Obstructed),
    grid_unknown(Map0, ev3dev_grid_knowledge:unblocked, Map),
    start(Own, Map0, Cell, Direction),
    grid_metric(Own, Metric),
    fade(Own, Fade),
    set_pose_in(Metric, Cell, Direction),
    forget_all(Fade, Obstructed),
    brick(Brick),
    retractall(on_grid(Brick, _, _)),
    assertz(on_grid(Brick, Map, Metric)),
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

%!  grid_metric(+Options, -Metric) is det.
%
%   Metric, as of grid/2, holds the options of set_grid/1.

grid_metric(Options, metric(Cm, X, Y, Eye, Speed)) :-
    number_option(cell_cm(Cm), positive_number, Options, 20),
    (   option(origin(X0, Y0), Options)
    ->  number_value(X0, X),
        number_value(Y0, Y)
    ;   X = 0,
        Y = 0
    ),
    number_option(eye(Eye), finite_number, Options, 7),
    number_option(speed(Speed), speed_ahead, Options, 20).

fade(Options, Fade) :-
    option(fade(Expression), Options, never),
    (   Expression == never
    ->  Fade = never
    ;   number_value(positive_number, Expression, Fade)
    ).

%!  grid_place(+Cell, +Direction) is semidet.
%
%   The robot was put into the middle of Cell. It keeps what it knows. Fails
%   if there is no grid.
%
%   @error domain_error(grid_state, State)

grid_place(Cell, Direction) :-
    grid(Map, Metric),
    must_be_state(Map, state(Cell, Direction)),
    set_pose_in(Metric, Cell, Direction),
    set_state(Cell, Direction).

%!  set_pose_in(+Metric, +Cell, +Direction) is semidet.
%
%   The robot is in the middle of Cell: set pose/3 to that.

set_pose_in(Metric, Cell, Direction) :-
    cell_place(Metric, Cell, X, Y),
    direction_heading(Direction, Heading),
    set_pose(X, Y, Heading).

%!  cell_place(+Metric, +Cell, -X, -Y) is det.
%
%   Where the middle of Cell is for pose/3.

cell_place(metric(Cm, X0, Y0, _, _), [CX, CY], X, Y) :-
    X is X0 + Cm*CX,
    Y is Y0 + Cm*CY.

%!  set_state(+Cell, +Direction) is det.
%
%   The robot is in Cell now and looks in Direction.

set_state(Cell, Direction) :-
    brick(Brick),
    retractall(stands(Brick, _, _)),
    assertz(stands(Brick, Cell, Direction)).

%!  state_position(?Cell, ?Direction) is semidet.
%
%   True if the robot is in Cell and looks in Direction. If a move ended early
%   it is still in the cell from which it started, as far as one can know.

state_position(Cell, Direction) :-
    brick(Brick),
    (   stands(Brick, Cell0, Direction0)
    ->  Cell = Cell0,
        Direction = Direction0
    ;   fail_because(no_grid)
    ).

%!  grid(-Map, -Metric) is semidet.
%
%   True if Map is that of the grid that was set. Metric is
%   `metric(Cm, X, Y, Eye, Speed)`: how wide its cells are, where [0,0] is,
%   and what set_grid/1 knows of the robot's sensor and its moves.

grid(Map, Metric) :-
    brick(Brick),
    (   on_grid(Brick, Map, Metric)
    ->  true
    ;   fail_because(no_grid)
    ).
