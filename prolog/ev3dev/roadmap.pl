:- module(ev3dev_roadmap,
          [ roadmap_path/4,     % +Map, +Start, +Goal, -Points
            roadmap_path/5,     % +Map, +Start, +Goal, -Points, +Options
            roadmap_legs/5,     % +Map, +Start, +Goal, -Legs, +Options
            roadmap_svg/5       % +Map, +Start, +Goal, +File, +Options
          ]).
:- set_prolog_flag(generate_debug_info, false).
:- use_module(private/load/compiled, []).
:- use_module(library(lists), [member/2]).
:- use_module(private/errors/public_clauses, [term_expansion/4]).
:- use_module(private/files/directory, [write_file/2]).
:- use_module(private/explain/hints).
:- use_module(private/grid/compass, [direction_heading/2]).
:- use_module(private/grid/map,
              [ free_cell/2, grid_bounds/5, grid_cell/2, grid_costs/4,
                grid_neighbors/2, must_be_cell/1, must_be_state/2 ]).
:- use_module(driver, []).
:- use_module(private/checks/arguments, [option/3, take_options/4]).
:- use_module(private/checks/places, [place/2]).
:- use_module(private/maps/roadmap_arguments,
              [roadmap_facts/2, roadmap_options/2]).
:- reexport(navigation).
:- use_module(private/native/native, [roadmap_/5, roadmap_svg_/5]).

/** <module> Ways for a robot between obstacles of any shape

Plans ways, and drives them: navigate_to/2,3 are those of
library(ev3dev/navigation).

Ways are found over a map of polygons, boxes, walls and circles, in any
direction, for a robot that is round or turns within a circle:

```
?- roadmap_path([box(50, 50, 40, 40)], 0-0, 100-100, Points).
?- roadmap_path(room, 40-40, 270-220, Points, [method(prm), seed(7)]).
```

A way is looked for on a *roadmap*, straight lines that keep a distance from
all obstacles. Where it bends it becomes an arc, as wide as fits. How the
roadmap is made is the option method(Method):

  - visibility
    All corners of the obstacles that see each other are joined. This finds
    the shortest way, and if it finds none, there is no way, except where a
    bend would have to be within 2 % of the radius. The work grows with the
    square of the number of corners.
  - prm
    Probabilistic roadmap: points are drawn at random, and each is joined with
    those next to it. The work grows with the number of points.
  - rrt
    Rapidly exploring random tree: a tree grows from the start towards points
    drawn at random, until it is at the goal.
  - rrt_bidirectional
    Two such trees, from the start and from the goal, until they meet.
  - rrt_star
    RRT*: a tree that is changed where that shortens a way. It draws all
    points, and its ways come closer to the shortest with more of them.

## Maps {#roadmap-maps}

A Map is a list of facts or, as for sim_start/1, the name of a shipped world
or a file. Lengths are in centimeters, x to the right and y up. A Map may have
all facts of a world. Only those that stop a robot count: bounds/4, wall/4,5,
box/4,5,6, circle/3,4 and map/2. A list may also hold

  - polygon(Corners)
    At least three corners, which are places, in either order. It may be
    concave. No two edges may cross or touch, but at the corners.

A place is `X-Y`, or `[X, Y]` where a program gives one. The x and y of Start
and Goal may be arithmetic expressions.

## Options {#roadmap-options}

  - radius(+Cm)
    Of the circle within which the robot turns. Default is 8, the shipped
    robot's.
  - margin(+Cm)
    The additional distance from obstacles. Default is 4.
  - method(+Method)
    Default is `visibility`.
  - arc_radius(+Cm)
    The least radius of an arc. Where none fits the way has a corner, at which
    the robot turns on the spot. Default is 6: half an axle and a little.
  - samples(+Count)
    How many points are drawn at random, at most 100000. Default is 500. If
    no way was found by then, there is none; no time limits it.
  - seed(+Integer)
    The random seed, 1 by default. The same seed gives the same way.
*/

%!  roadmap_path(+Map, +Start, +Goal, -Points) is semidet.
%!  roadmap_path(+Map, +Start, +Goal, -Points, +Options) is semidet.
%
%   True if Points, each `X-Y`, is a way from Start to Goal: where its lines
%   and arcs begin and end. Options are those above, and
%
%     - length(-Cm)
%       Of the way, along its arcs.
%     - lines(-Count)
%       How many lines the roadmap has: those that were looked at, and keep
%       the distance.
%
%   Fails if no way was found, also if an obstacle is too near to Start or
%   Goal; `debug(ev3dev)` prints why.
%
%   @error existence_error(world, Map)
%   @error domain_error(roadmap_fact, Fact) if a map has no such facts
%   @error domain_error(map_row, Row) for a row of map/2
%   @error domain_error(possible_geometry, Fact) for a polygon with less than
%          three corners, or one that crosses itself, and the like
%   @error domain_error(place, Place)
%   @error domain_error(roadmap_method, Method)
%   @error domain_error(Domain, Value) for an option that makes no sense
%   @error domain_error(roadmap_option, Option) if it is not an option here

roadmap_path(Map, Start, Goal, Points) :-
    roadmap_path(Map, Start, Goal, Points, []).

roadmap_path(Map, Start, Goal, Points, Options) :-
    way(Map, Start, Goal, Options, Points0, _),
    Points = Points0.

%!  roadmap_legs(+Map, +Start, +Goal, -Legs, +Options) is semidet.
%
%   As roadmap_path/5, but with the way as a list of
%
%     - line(From, To)
%     - arc(From, To, Radius, Angle)
%       As arc_cm/3 takes them: Radius is positive if the center is on the
%       right, negative if on the left, and Angle is positive, in degrees.

roadmap_legs(Map, Start, Goal, Legs, Options) :-
    way(Map, Start, Goal, Options, _, Legs0),
    Legs = Legs0.

way(Map, Start0, Goal0, Options, Points, Legs) :-
    roadmap_facts(Map, Facts),
    place(Start0, Start),
    place(Goal0, Goal),
    take_options([length, lines], Options, Own, Rest),
    roadmap_options(Rest, Native),
    roadmap_(Facts, Start, Goal, Native, Found),
    (   Found = no_way(Why)
    ->  explain("no way from ~p to ~p: ~w", [Start, Goal, Why]),
        fail
    ;   Found = way(Length0, Points, Legs, Lines0)
    ),
    option(length(Length), Own, _),
    Length = Length0,
    option(lines(Lines), Own, _),
    Lines = Lines0.

%!  roadmap_svg(+Map, +Start, +Goal, +File, +Options) is semidet.
%
%   Write a picture to a file, as SVG: the obstacles with what is kept free
%   around them, the lines of the roadmap that were looked at, and the way.
%   Fails, and writes nothing, if roadmap_path/5 does.
%
%   @error as roadmap_path/5, and as open/3

roadmap_svg(Map, Start0, Goal0, File, Options) :-
    roadmap_facts(Map, Facts),
    place(Start0, Start),
    place(Goal0, Goal),
    roadmap_options(Options, Native),
    roadmap_svg_(Facts, Start, Goal, Native, Text),
    write_file(File, written(Text)).

written(Text, Stream) :-
    write(Stream, Text).

% ---------------- BESIDE THE PLANNERS OF GRIDS

%   roadmap(Method) of compare_planners/3. A corridor is one cell wide, and
%   the robot a little narrower. The middle of the cell [0,0] is at 0, 0.

:- multifile ev3dev_comparison:roadmap_run/6.

ev3dev_comparison:roadmap_run(Method, Map, Start, Goal, Facts, Path) :-
    must_be_state(Map, Start),
    Start = state([SX, SY], Direction),
    Goal = state([GX, GY], _),
    must_be_cell([GX, GY]),
    grid_bounds(Map, X1, Y1, X2, Y2),
    Left is 20*X1 - 10,
    Low is 20*Y1 - 10,
    Right is 20*X2 + 10,
    High is 20*Y2 + 10,
    findall(box(X, Y, 20, 20),
            ( grid_cell(Map, Cell),
              \+ free_cell(Map, Cell),
              Cell = [CX, CY],
              X is 20*CX,
              Y is 20*CY ),
            Boxes),
    FromX is 20*SX,
    FromY is 20*SY,
    ToX is 20*GX,
    ToY is 20*GY,
    statistics(cputime, Seconds0),
    (   way([bounds(Left, Low, Right, High)|Boxes], FromX-FromY, ToX-ToY,
            [ method(Method), radius(8), margin(1), samples(5000),
              length(Length), lines(Lines) ], Points, Legs)
    ->  statistics(cputime, Seconds1),
        length(Legs, Steps),
        direction_heading(Direction, Heading),
        turned(Legs, Heading, 0, Degrees),
        grid_costs(Map, Move, _, Turn),
        grid_neighbors(Map, Neighbors),
        Cost is round(Length * Move / 20 + Degrees * Neighbors * Turn / 360),
        Rest = [steps(Steps), cost(Cost)],
        findall([PX, PY],
                ( member(X-Y, Points), PX is X / 20, PY is Y / 20 ),
                Path)
    ;   statistics(cputime, Seconds1),
        Lines = 0,
        Rest = [],
        Path = [[SX, SY]]
    ),
    Seconds is Seconds1 - Seconds0,
    Facts = [replans(0), expanded(Lines), seconds(Seconds)|Rest].

%   The degrees that the robot turns on the spot: before and between lines.

turned([], _, Degrees, Degrees).
turned([Leg|Legs], Heading0, Degrees0, Degrees) :-
    ends(Leg, Begins, Ends),
    Turn0 is Begins - Heading0,
    Turn is abs(Turn0 - 360*round(Turn0/360)),
    Degrees1 is Degrees0 + Turn,
    turned(Legs, Ends, Degrees1, Degrees).

ends(line(From, To), Heading, Heading) :-
    along(From, To, Heading).
ends(arc(From, To, Radius, Angle), Begins, Ends) :-
    along(From, To, Chord),
    Begins is Chord - sign(Radius) * Angle / 2,
    Ends is Chord + sign(Radius) * Angle / 2.

along(X1-Y1, X2-Y2, Heading) :-
    Heading is atan2(X2 - X1, Y2 - Y1) * 180 / pi.
