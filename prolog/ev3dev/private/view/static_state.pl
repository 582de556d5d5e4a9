:- module(ev3dev_view_static_state,
          [ renew_kept/0,
            brick_show/1,               % +Text
            watch_add/2,                % +Name, +Column
            watches_end/0
          ]).
:- use_module('../native/native',
              [ localize_show_/1, map_show_/1, view_has_robot_/1,
                view_keep_/2, view_show_/1, view_to_world_/5 ]).
:- use_module(library(lists), [member/2]).
:- use_module(record, [keep_record/0]).
:- use_module('../run/brick', [brick/1, named_brick/3]).
:- use_module('../simulation/world_name', [world_name/1]).

/** <module> The part of a page that rarely changes

What the program knows of its grid, the name of the world, the bricks, and
what it wants to be plotted. A page is sent what has changed.
*/

:- dynamic
    watch/3,                            % Number, Name, Column
    renewed/1.                          % Time

%   The seconds between two looks at the grid.
every(0.25).

%!  renew_kept is det.

renew_kept :-
    get_time(Now),
    every(Every),
    (   renewed(Last),
        abs(Now - Last) < Every
    ->  true
    ;   retractall(renewed(_)),
        assertz(renewed(Now)),
        catch(keep_grid, _, true),
        keep_places,
        keep_name,
        keep_record
    ),
    keep_bricks.

%!  brick_show(+Text) is semidet.
%
%   Pages show the brick of that name from now on. Fails if there is none.

brick_show(Text) :-
    robot(Name, Brick),
    atom_string(Name, Text),
    view_show_(Brick),
    keep_bricks.

%   Nothing to choose from is not a list. Of those that are no robot yet, only
%   the one that is shown is in it.
keep_bricks :-
    brick(Shown),
    findall(Name-Brick,
            ( robot(Name, Brick),
              ( Brick == Shown -> true ; view_has_robot_(Brick) ) ),
            Robots),
    (   Robots = [_, _|_]
    ->  findall(Text,
                ( member(Name-_, Robots), atom_string(Name, Text) ),
                Names),
        (   member(Name-Shown, Robots)
        ->  atom_string(Name, Now)
        ;   Now = null
        ),
        view_keep_(bricks, json([names=Names, shown=Now]))
    ;   view_keep_(bricks, null)
    ).

%   A far brick has no number.
robot(local, 0).
robot(Name, Brick) :-
    named_brick(Name, Brick, _),
    integer(Brick).

keep_name :-
    (   world_name(Name)
    ->  atom_string(Name, Text)
    ;   Text = null
    ),
    view_keep_(name, Text).

keep_grid :-
    brick(Brick),
    (   catch(ev3dev_grid_place:on_grid(Brick, Map, Metric), _, fail)
    ->  grid_json(Brick, Map, Metric, Json)
    ;   Json = null
    ),
    view_keep_(grid, Json).

grid_json(Brick, Map, metric(Cm, X0, Y0, _, _), Json) :-
    ev3dev_grid_map:grid_bounds(Map, X1, Y1, X2, Y2),
    Left is X0 + Cm*X1 - Cm/2,
    Low is Y0 + Cm*Y1 - Cm/2,
    view_to_world_(Left, Low, X, Y, Turn),
    Columns is X2 - X1 + 1,
    Rows is Y2 - Y1 + 1,
    findall(Place,
            ( ev3dev_grid_knowledge:obstructed(Cell),
              place(Cell, X1, Y1, Place)
            ),
            Blocked0),
    findall(Place,
            ( ev3dev_grid_knowledge:known_free(Cell),
              place(Cell, X1, Y1, Place)
            ),
            Free0),
    sort(Blocked0, Blocked),
    sort(Free0, Free),
    findall(Place,
            ( planned(Brick, Cell),
              place(Cell, X1, Y1, Place)
            ),
            Plan),
    Json = json([ cell=Cm, origin=[X, Y], h=Turn, cols=Columns, rows=Rows,
                  blocked=Blocked, free=Free, plan=Plan ]).

%   The cells of the plan under way, in order.

planned(Brick, Cell) :-
    catch(ev3dev_grid_moves:planned(Brick, Cells), _, fail),
    !,
    member(Cell, Cells).

%   Where the robot may be by localize_start/1 and grid_localize/2, and the
%   map that it makes.

keep_places :-
    brick(Brick),
    (   catch(ev3dev_localize:localizer(Brick, Localizer, _), _, fail)
    ->  localize_show_(Localizer)
    ;   view_keep_(localized, null)
    ),
    (   catch(ev3dev_map:mapper(Brick, Mapper, _, _, _), _, fail)
    ->  map_show_(Mapper)
    ;   view_keep_(map, null)
    ),
    (   catch(ev3dev_grid_belief:believed(Brick, Cm, Belief), _, fail)
    ->  belief_json(Cm, Belief, Json)
    ;   Json = null
    ),
    view_keep_(belief, Json).

%   Its map is taken for the world.
belief_json(Cm, Belief, Json) :-
    ev3dev_grid_belief:shares(Belief, bounds(X1, Y1, _, _), Shares),
    X is Cm*X1 - Cm/2,
    Y is Cm*Y1 - Cm/2,
    findall([Column, Row, Share],
            ( member([CX, CY]-Share, Shares),
              place([CX, CY], X1, Y1, [Column, Row]) ),
            Cells),
    Json = json([cell=Cm, origin=[X, Y], h=0, cells=Cells]).

place([CX, CY], X1, Y1, [X, Y]) :-
    X is CX - X1,
    Y is CY - Y1.

%!  watch_add(+Name, +Column) is det.
%
%   Plot a column of the samples under a name.

watch_add(Name, Column) :-
    with_mutex(ev3dev_view_watches,
               ( retractall(watch(_, Name, _)),
                 flag(ev3dev_view_watch, Number, Number + 1),
                 assertz(watch(Number, Name, Column)),
                 keep_watches )).

keep_watches :-
    findall(json([name=Name, column=Column, unit=Unit]),
            ( watch(_, Name, Column), unit(Column, Unit) ),
            Watches),
    view_keep_(watches, Watches).

unit(Column, Unit) :-
    (   ending(Ending, Unit0),
        sub_atom(Column, _, _, 0, Ending)
    ->  Unit = Unit0
    ;   Unit = ''
    ).

ending('.position', deg).
ending('.speed', 'deg/s').
ending('.duty', '%').

%!  watches_end is det.

watches_end :-
    retractall(watch(_, _, _)),
    retractall(renewed(_)),
    keep_watches.
