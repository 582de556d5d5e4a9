% Ten planners on one map: which plan does each find, and how many states does
% it expand?
%
%   ?- start.
%
% The planners drive over the map below twice. First they know the whole map,
% and each plans once. Then they know nothing, and plan again at each obstacle
% on the path. The program needs no robot. It prints a table for each drive,
% and draws planners_known.svg and planners_unknown.svg.

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
    start([neighbors(4)]).

%!  start(+Options) is det.
%
%   Compare the planners on a map with Options, for example
%   `[neighbors(8)]` or `[turn_cost(1)]`.

start(Options) :-
    map(Rows),
    grid_map([rows(Rows)|Options], Map),
    Goal = state([10, 7], _),
    format("The map is known:~n"),
    compare_planners(Map, Goal,
                     [known(true), svg('planners_known.svg')]),
    format("~nIt is not known:~n"),
    compare_planners(Map, Goal, [svg('planners_unknown.svg')]).
