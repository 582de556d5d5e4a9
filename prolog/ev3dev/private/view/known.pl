:- module(ev3dev_view_known,
          [ renew_kept/0,
            watch_add/2,                % +Name, +Column
            watches_end/0
          ]).
:- use_module('../native',
              [ view_json_/2, view_keep_/2, view_to_world_/5 ]).
:- use_module(library(lists), [member/2]).
:- use_module('../brick', [brick/1]).
:- use_module('../world_name', [world_name/1]).

/** <module> What seldom changes on a page

What the program knows of its grid, the name of the world, and what it wants
to be plotted. A page is sent what has changed.
*/

:- dynamic
    watch/3,                            % Number, Name, Column
    renewed/1.                          % Time

%   So often, in seconds, the grid is looked at.
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
        keep_name
    ).

keep_name :-
    (   world_name(Name)
    ->  view_json_(Name, Json)
    ;   Json = null
    ),
    view_keep_(name, Json).

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
    findall(Text,
            ( ev3dev_grid_knowledge:obstructed(Cell),
              cell(Cell, X1, Y1, Text)
            ),
            Blocked0),
    findall(Text,
            ( ev3dev_grid_knowledge:known_free(Cell),
              cell(Cell, X1, Y1, Text)
            ),
            Free0),
    sort(Blocked0, Blocked),
    sort(Free0, Free),
    atomic_list_concat(Blocked, ',', BlockedText),
    atomic_list_concat(Free, ',', FreeText),
    findall(Text,
            ( planned(Brick, Cell),
              cell(Cell, X1, Y1, Text)
            ),
            Plan),
    atomic_list_concat(Plan, ',', PlanText),
    format(string(Json),
           "{\"cell\":~w,\"origin\":[~2f,~2f],\"h\":~2f,\"cols\":~w,\c
            \"rows\":~w,\"blocked\":[~w],\"free\":[~w],\"plan\":[~w]}",
           [ Cm, X, Y, Turn, Columns, Rows, BlockedText, FreeText,
             PlanText ]).

%   The cells of the plan under way, in order.

planned(Brick, Cell) :-
    catch(ev3dev_grid_moves:planned(Brick, Cells), _, fail),
    !,
    member(Cell, Cells).

cell([CX, CY], X1, Y1, Text) :-
    X is CX - X1,
    Y is CY - Y1,
    format(atom(Text), '[~w,~w]', [X, Y]).

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
    findall(Text,
            ( watch(_, Name, Column),
              view_json_(Name, NameJson),
              unit(Column, Unit),
              format(string(Text),
                     "{\"name\":~w,\"column\":\"~w\",\"unit\":\"~w\"}",
                     [NameJson, Column, Unit])
            ),
            Texts),
    atomic_list_concat(Texts, ',', Joined),
    format(string(Json), "[~w]", [Joined]),
    view_keep_(watches, Json).

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
