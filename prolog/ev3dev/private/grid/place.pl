:- module(ev3dev_grid_place,
          [ set_grid/1,                 % +Options
            grid/2,                     % -Map, -Metric
            grid_place/2,               % +Cell, +Direction
            state_position/2,           % ?Cell, ?Direction
            set_state/2,                % +Cell, +Direction
            cell_place/4                % +Metric, +Cell, -X, -Y
          ]).
:- use_module(library(apply), [maplist/2]).
:- use_module('../errors', [domain_error/2, must_be/2, term_expansion/2]).
:- use_module(library(option), [option/2, option/3]).
:- use_module('../../drive', [set_pose/3]).
:- use_module(compass).
:- use_module(knowledge).
:- use_module(map).
:- use_module('../arguments', [finite/1, take_options/4]).

/** <module> A robot on a grid

Which grid it is on, and where on it the robot is.
*/

:- dynamic
    state_position/2,                   % Cell, Direction
    grid/2.                             % Map, Metric

%!  set_grid(+Options) is semidet.
%
%   Begin with an unknown grid and the robot in the middle of a cell. Fails if
%   no robot is set, or a motor is not connected. Options are those of
%   grid_map/2, where `rows` and `obstacles` are what is known from the start,
%   and
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
    metric(Own, Metric),
    option(fade(Fade), Own, never),
    (   Fade == never
    ->  true
    ;   must_be_positive(fade, Fade)
    ),
    set_pose_in(Metric, Cell, Direction),
    forget_all(Fade, Obstructed),
    retractall(grid(_, _)),
    assertz(grid(Map, Metric)),
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
        finite(Number)
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
    grid(Map, Metric),
    must_be_state(Map, state(Cell, Direction)),
    set_pose_in(Metric, Cell, Direction),
    set_state(Cell, Direction).

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
    retractall(state_position(_, _)),
    assertz(state_position(Cell, Direction)).

%!  state_position(?Cell, ?Direction) is semidet.
%
%   True if the robot is in Cell and looks in Direction. If a move ended early
%   it is still in the cell from which it started, as far as one can tell.

%!  grid(-Map, -Metric) is semidet.
%
%   True if Map is that of the grid that was set. Metric is `metric(Cm, X, Y,
%   Eye, Speed)`: how wide its cells are, where [0,0] is, and what set_grid/1
%   was told of the robot's sensor and its moves.
