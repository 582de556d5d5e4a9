% Ten planners on one map: which finds what, and how much does it look at?
%
%   ?- start.
%
% Twice they drive over the map below. First the robot knows all of it, and
% each plans once. Then it knows nothing, and plans again whenever it finds an
% obstacle in its way. That needs no robot; it prints a table for each, and
% draws planners_known.svg and planners_unknown.svg.

:- use_module(library(ev3dev/planners)).

map([ "............",
      "..######....",
      ".......#....",
      ".......#.##.",
      "..######..#.",
      "..#.......#.",
      "..#..######.",
      "..#.........",
      "^...####...."
    ]).

start :-
    start([neighbours(4)]).

%!  start(+Options) is det.
%
%   Compare on a map made with Options, as `[neighbours(8)]` or
%   `[turn_cost(1)]`.

start(Options) :-
    map(Rows),
    grid_map([rows(Rows)|Options], Map),
    Goal = state([10, 7], _),
    format("The map is known:~n"),
    compare_planners(Map, Goal,
                     [known(true), svg('planners_known.svg')]),
    format("~nIt is not known:~n"),
    compare_planners(Map, Goal, [svg('planners_unknown.svg')]).
