:- module(ev3dev_map,
          [ map_start/0,
            map_start/1,                % +Options
            map_stop/0,
            map_occupancy/3,            % +X, +Y, -Probability
            map_cells/2,                % -Side, -Cells
            map_facts/1,                % -Facts
            map_save/1,                 % +File
            map_svg/1,                  % +File
            explore/0,
            explore/1                   % +Options
          ]).
:- set_prolog_flag(generate_debug_info, false).
:- use_module(private/load/compiled, []).
:- use_module(private/basics/fields,
              [fields/1, goal_expansion/2, term_expansion/2]).
:- use_module(private/checks/checks, [must_be/2]).
:- use_module(private/errors/public_clauses, [term_expansion/4]).
:- use_module(private/explain/hints).
:- use_module(driver, []).
:- use_module(private/checks/arguments,
              [ must_be_options/3, must_be_within/4, number_option/4,
                number_value/2, option/3
              ]).
:- use_module(private/run/brick, [brick/1, of_brick/1]).
:- use_module(private/files/directory, [write_file/2]).
:- use_module(private/basics/small_lists, [one_of/2]).
:- use_module(private/maps/roadmap_arguments, [sensor_option/2]).
:- use_module(private/maps/gray_squares, [write_shades/4]).
:- use_module(private/native/native,
              [ map_cells_/3, map_frontier_/5, map_look_/3, map_new_/2,
                map_occupancy_/4, map_walls_/3
              ]).
:- use_module(drive, [drive_cm/2, drive_wait/2, pose/3]).
:- use_module(events, [event_cancel/1, every/3]).
:- use_module(navigation, [navigate_to/3]).
:- use_module(robot, [stop/0]).
:- use_module(sensors, [us_dist_cm/2]).

:- fields(mapper(brick, mapper, x, y, heading)).

/** <module> A first map

A robot that knows nothing of its room makes a map of it by its ultrasonic
sensor, in the frame of pose/3.

```
?- set_robot(5.6, 10.6, outB, outC).
?- map_start, explore, map_facts(Facts), map_svg('room.svg').
```

The map is a grid of cells of 5 cm. An echo comes from somewhere on an arc; it
is shared among the cells there, so that all echoes and all that was seen free
agree best. map_facts/1 makes a world of it, in which the room can be
simulated, and that is a map for navigate_to/2, roadmap_path/5 and
localize_start/1.

A turn in the odometry becomes a bend in the map: there is no loop closing. So
it is for one room, and for a robot with a gyro. Where a map is known,
localize_start/2 with `correct_odometry(true)` keeps pose/3 right.

Source: Thrun: Learning occupancy grid maps with forward sensor models (2003).
*/

%   mapper(Brick, Mapper, StartX, StartY, StartHeading)
:- dynamic mapper/5.
:- volatile mapper/5.
:- of_brick([mapper/5]).

%   Another world begins, which has another map.
:- multifile ev3dev_brick:other_world/1.

ev3dev_brick:other_world(Brick) :-
    ev3dev_map:forget_map(Brick).

forget_map(Brick) :-
    retractall(mapper(brick: Brick)).

%!  map_start is semidet.
%!  map_start(+Options) is semidet.
%
%   Begin a map. From now on what the sensor measures is noted, ten times a
%   second while this thread waits, as an event. Fails if no robot is set.
%   Options:
%
%     - every(+Seconds)
%       Default is 0.1.
%     - sensor(+X, +Y, +Heading)
%       The place of the ultrasonic sensor, as for navigate_to/3.
%
%   @error domain_error(map_option, Option)

map_start :-
    map_start([]).

map_start(Options) :-
    must_be_options(map_option, [every, sensor/3], Options),
    number_option(every(Seconds), positive_number, Options, 0.1),
    sensor_option(Options, Sensor),
    pose(X, Y, Heading),
    map_new_(Sensor, Mapper),
    brick(Brick),
    with_mutex(ev3dev_map,
               ( retractall(mapper(brick: Brick)),
                 assertz(mapper(Brick, Mapper, X, Y, Heading)) )),
    every(Seconds, ev3dev_map:watch, [id(map)]).

%!  map_stop is semidet.
%
%   Add no more to the map. It stays, until the next one is begun. Fails if
%   there is none.

map_stop :-
    mapper_now(_),
    ignore(event_cancel(map)).

mapper_now(Mapper) :-
    brick(Brick),
    (   mapper(brick: Brick, mapper: Mapper)
    ->  true
    ;   fail_because(no_map)
    ).

watch :-
    brick(Brick),
    (   mapper(brick: Brick, mapper: Mapper)
    ->  ignore(looked(Mapper))
    ;   ignore(event_cancel(map))
    ).

looked(Mapper) :-
    once(us_dist_cm(_, Centimeters)),
    pose(X, Y, Heading),
    map_look_(Mapper, pose(X, Y, Heading), Centimeters).

%!  map_occupancy(+X, +Y, -Probability) is semidet.
%
%   How probable it is that something stands there: 0.5 where nothing is
%   known. Fails if there is no map.

map_occupancy(X0, Y0, Probability) :-
    number_value(X0, X),
    number_value(Y0, Y),
    mapper_now(Mapper),
    map_occupancy_(Mapper, X, Y, Probability).

%!  map_cells(-Side, -Cells) is semidet.
%
%   All that is known: a list of `cell(X, Y, Probability)` with the middles of
%   cells that are Side cm wide.

map_cells(Side, Cells) :-
    mapper_now(Mapper),
    map_cells_(Mapper, Side, Cells).

%!  map_facts(-Facts) is semidet.
%
%   The map as facts of a world: bounds, walls of 4 cm where something stands,
%   and a start where the map began. Fails if there is no map, or nothing is
%   known yet.

map_facts([Bounds, start(X, Y, Heading)|Walls]) :-
    brick(Brick),
    mapper_now(Mapper),
    mapper(Brick, Mapper, X, Y, Heading),
    map_walls_(Mapper, bounds(X1, Y1, X2, Y2), Walls0),
    % A wall on the edge keeps its thickness.
    Left is X1-5, Low is Y1-5, Right is X2+5, High is Y2+5,
    Bounds = bounds(Left, Low, Right, High),
    findall(wall(A, B, C, D, 4), one_of(Walls0, wall(A, B, C, D)), Walls).

%!  map_save(+File) is semidet.
%
%   Write map_facts/1 into a file, which is a world.

map_save(File) :-
    map_facts(Facts),
    write_file(File, written(Facts)).

written(Facts, Stream) :-
    forall(one_of(Facts, Fact), format(Stream, '~q.~n', [Fact])).

%!  map_svg(+File) is semidet.
%
%   Draw the map: the darker a cell, the more probable it is that something
%   stands there; what is not known has no color.

map_svg(File) :-
    map_cells(Side, Cells),
    map_facts([Bounds|_]),
    write_shades(File, Side, Bounds, Cells).

%!  explore is semidet.
%!  explore(+Options) is semidet.
%
%   Drive to where the map ends, until there is no such place that the robot
%   can reach. Waits. Begins a map if there is none. Turns around on the spot
%   at each place. Fails if no robot is set, if it has no ultrasonic sensor,
%   or if the robot cannot go on. Options:
%
%     - places(+Count)
%       The most places. Default is 50.
%     - radius(+Cm)
%       The radius of the robot's hull. Default is 8.
%     - speed(+CmPerSecond)
%       Default is 15.
%     - reason(-Reason)
%       Do not fail, but report why it ended: `explored`; `exhausted`, after
%       that many places; or as for navigate_to/3.
%
%   @error domain_error(explore_option, Option)

explore :-
    explore([]).

explore(Options) :-
    must_be_options(explore_option, [places, radius, speed, reason], Options),
    option(places(Most), Options, 50),
    must_be_within(1, 10000, places, Most),
    number_option(radius(Radius), positive_number, Options, 8),
    number_option(speed(Speed), positive_number, Options, 15),
    brick(Brick),
    (   mapper(brick: Brick, mapper: Mapper)
    ->  true
    ;   map_start,
        mapper(brick: Brick, mapper: Mapper)
    ),
    setup_call_cleanup(
        true,
        ( look_around(Mapper, Why),
          (   Why == looked
          ->  explored(Most, Mapper, Radius, Speed, Ended)
          ;   Ended = Why
          ) ),
        ignore(stop)),
    explain("explore: ~w", [Ended]),
    option(reason(Reason), Options, explored),
    Reason = Ended.

%   navigate_to/3 looks around at the place where it starts.
explored(Left, Mapper, Radius, Speed, Ended) :-
    next_place(Mapper, Radius, Next),
    (   Next = ended(Ended)
    ->  true
    ;   Left =:= 0
    ->  Ended = exhausted
    ;   Next = to(Place),
        navigate_to([], Place, [ reason(Reason), radius(Radius), speed(Speed),
                                 steps(20) ]),
        (   memberchk(Reason, [reached, unreachable, exhausted])
        ->  Left1 is Left-1,
            explored(Left1, Mapper, Radius, Speed, Ended)
        ;   Ended = Reason
        )
    ).

%   Where nothing is left to see it looks once more.
next_place(Mapper, Radius, Next) :-
    (   place(Mapper, Radius, Place)
    ->  Next = to(Place)
    ;   look_around(Mapper, Why),
        (   Why \== looked
        ->  Next = ended(Why)
        ;   place(Mapper, Radius, Place)
        ->  Next = to(Place)
        ;   Next = ended(explored)
        )
    ).

place(Mapper, Radius, Place) :-
    pose(X, Y, _),
    map_frontier_(Mapper, X, Y, Radius, Place).

look_around(Mapper, Why) :-
    pose(_, _, From),
    drive_cm(0, 40),
    look_around(From, Mapper, Why),
    stop.

look_around(From, Mapper, Why) :-
    (   looked(Mapper)
    ->  drive_wait([timeout(0.05)], Reason),
        pose(_, _, Heading),
        (   Reason \== timeout
        ->  Why = Reason
        ;   Heading - From >= 360
        ->  Why = looked
        ;   look_around(From, Mapper, Why)
        )
    ;   Why = unplugged
    ).
