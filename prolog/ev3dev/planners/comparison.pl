:- module(ev3dev_comparison,
          [ compare_planners/3          % +Map, +Goal, +Options
          ]).
:- use_module(library(apply), [maplist/3]).
:- use_module('../private/checks/checks', [must_be/2]).
:- use_module(library(lists), [append/3, member/2, reverse/2]).
:- use_module(library(option), [option/2, option/3]).
:- use_module('../private/grid/compass').
:- use_module('../private/grid/map').
:- use_module('../private/grid/problem').
:- use_module('../private/checks/arguments', [must_be_options/3]).
:- use_module(picture).
:- use_module(search).

/** <module> Comparison of planners
*/

%!  compare_planners(+Map, +Goal, +Options) is det.
%
%   Let planners drive over Map to the state Goal, one after the other and
%   without a robot, and print a table with these columns:
%
%     - replans
%       How often the planner planned again because of an obstacle.
%     - expanded
%       The number of states that it expanded in all its plans together.
%     - ms
%       The time of all its searches, in milliseconds.
%     - steps, cost
%       The number of actions to the goal, and their total cost. Both are
%       missing if no path leads to the goal.
%
%   At first the simulated driver knows no obstacle. Before each move it looks
%   into the next cell, and before a diagonal move also into the two cells
%   beside it. Options:
%
%     - start(+State)
%       The first state. Default is the start drawn in the map's rows, else
%       `state([0,0], [0,1])`.
%     - planners(+Planners)
%       The planners to compare. Default is all of planner/1. One may also be
%       roadmap(Method), a method of library(ev3dev/roadmap), which must be
%       loaded: it goes in any direction, between cells of 20 cm, and knows
%       the whole map. Then `expanded` are the lines of the roadmap, `steps`
%       those of the way, and `cost` is that of its length and turns.
%     - known(+Boolean)
%       If `true`, the driver knows the whole map from the start. Default is
%       `false`.
%     - svg(+File)
%       Draw for each planner its path, and how often it expanded the states
%       of each cell.
%     - runs(-Runs)
%       Runs is the list of the results, `run(Planner, Facts)`. Facts contains
%       replans(Count), expanded(Count), seconds(Seconds), steps(Count) and
%       cost(Cost).
%
%   @error domain_error(planner, Planner)
%   @error domain_error(grid_state, State)
%   @error domain_error(planner_option, Option) if Option is not an option of
%          this predicate

compare_planners(Map, Goal, Options) :-
    must_be_options(planner_option, [start, planners, known, svg, runs],
                    Options),
    start(Options, Map, Start),
    option(known(Known), Options, false),
    must_be(boolean, Known),
    findall(Planner, planner(Planner), All),
    option(planners(Planners), Options, All),
    must_be(list, Planners),
    maplist(planner_run(task(Map, Known, Start, Goal)), Planners, Runs),
    option(runs(Runs0), Options, Runs),
    Runs0 = Runs,
    print_table(Runs),
    (   option(svg(File), Options)
    ->  maplist(planner_panel(task(Map, Known, Start, Goal)), Runs, Panels),
        draw_panels(File, Map, Start, Goal, Panels)
    ;   true
    ).

start(Options, Map, Start) :-
    (   option(start(Start), Options)
    ->  true
    ;   grid_start(Map, Start)
    ->  true
    ;   Start = state([0, 0], [0, 1])
    ).

planner_run(Task, Planner, run(Planner, Facts)) :-
    ran(Task, Planner, [], Facts, _).

%!  roadmap_run(+Method, +Map, +Start, +Goal, -Facts, -Path) is semidet.
%
%   What library(ev3dev/roadmap), which adds the clause, does in the place of
%   drive/5. Path is a list of places, in cells.

:- multifile roadmap_run/6.

ran(Task, Planner, Watch, Facts, Path) :-
    (   nonvar(Planner),
        Planner = roadmap(Method),
        Task = task(Map, _, Start, Goal),
        roadmap_run(Method, Map, Start, Goal, Facts0, Path0)
    ->  Facts = Facts0,
        Path = Path0
    ;   drive(Task, Planner, Watch, Facts, Path)
    ).

%   Counting takes time, so a second drive over the same path counts the
%   cells.

:- thread_local
    known_obstacle/1,                   % Cell
    expanded/1.                         % Cell

planner_panel(Task, run(Planner, Facts),
              panel(Planner, Facts, Path, Cells)) :-
    retractall(expanded(_)),
    ran(Task, Planner, [expanding(ev3dev_comparison:note)], _, Path),
    findall(Cell, retract(expanded(Cell)), Noted),
    msort(Noted, Cells).

note(state(Cell, _)) :-
    assertz(expanded(Cell)).

%   Drive from Start to Goal over a Map that the planner does not know.

drive(task(Map, Known, Start, Goal), Planner, Watch, Facts, Path) :-
    retractall(known_obstacle(_)),
    (   Known == true
    ->  Seen = Map
    ;   grid_unknown(Map, ev3dev_comparison:not_known, Seen)
    ),
    grid_problem(Seen, Start, Goal, problem(Start, Goals, Options0)),
    append(Watch, Options0, Options),
    planning(Planner, problem(Start, Goals, Options), Planning),
    Start = state(Cell, _),
    drive_on(Planning, [], Start, Map, Seen, [Cell], Path,
             facts(-1, 0, 0, 0, 0), Facts),
    retractall(known_obstacle(_)).

not_known(Cell) :-
    \+ known_obstacle(Cell).

drive_on(Planning0, Found, State, Map, Seen, Path0, Path, Facts0, Facts) :-
    grid_changed(Map, Found, Changed),
    replan(State, Changed, Result, Planning0, Planning),
    planned(Result, Facts0, Facts1),
    (   Result = plan(Plan, _)
    ->  follow(Plan, State, End, Map, Seen, Found1, Path0, Path1,
               Facts1, Facts2),
        (   Found1 == []
        ->  reverse(Path1, Path),
            Facts2 = facts(Replans, Expanded, Seconds, Steps, Cost),
            Facts = [ replans(Replans), expanded(Expanded),
                      seconds(Seconds), steps(Steps), cost(Cost)
                    ]
        ;   drive_on(Planning, Found1, End, Map, Seen, Path1, Path,
                     Facts2, Facts)
        )
    ;   reverse(Path0, Path),
        Facts1 = facts(Replans, Expanded, Seconds, _, _),
        Facts = [ replans(Replans), expanded(Expanded), seconds(Seconds) ]
    ).

planned(Result, facts(Plans0, Expanded0, Seconds0, Steps, Cost),
        facts(Plans, Expanded, Seconds, Steps, Cost)) :-
    (   Result = plan(_, Facts)
    ->  true
    ;   Result = no_plan(Facts)
    ),
    option(expanded(Expanded1), Facts),
    option(seconds(Seconds1), Facts),
    Plans is Plans0 + 1,
    Expanded is Expanded0 + Expanded1,
    Seconds is Seconds0 + Seconds1.

follow([], State, State, _, _, [], Path, Path, Facts, Facts).
follow([Action|Plan], State0, State, Map, Seen, Found, Path0, Path,
       Facts0, Facts) :-
    obstacles(Action, State0, Map, Found0),
    (   Found0 == []
    ->  grid_step(Map, Action, State0, State1),
        State1 = state(Cell, _),
        grid_cost(Map, State0, Action, Cost1),
        Facts0 = facts(Plans, Expanded, Seconds, Steps0, Cost0),
        Steps is Steps0 + 1,
        Cost is Cost0 + Cost1,
        follow(Plan, State1, State, Map, Seen, Found, [Cell|Path0], Path,
               facts(Plans, Expanded, Seconds, Steps, Cost), Facts)
    ;   forall(member(Cell, Found0), assertz(known_obstacle(Cell))),
        Found = Found0,
        State = State0,
        Path = Path0,
        Facts = Facts0
    ).

%   The obstacles that the driver sees before it acts.

obstacles(move, state(Cell, Direction), Map, Found) :-
    !,
    grid_step(Map, move, state(Cell, Direction), state(Next, _)),
    (   grid_beside(Cell, Direction, Left, Right)
    ->  Looked = [Left, Right, Next]
    ;   Looked = [Next]
    ),
    findall(Seen, ( member(Seen, Looked), \+ free_cell(Map, Seen) ), Found).
obstacles(_, _, _, []).

print_table(Runs) :-
    format("~w~t~30|~t~w~10+~t~w~10+~t~w~10+~t~w~8+~t~w~8+~n",
           [planner, replans, expanded, ms, steps, cost]),
    forall(member(run(Planner, Facts), Runs),
           ( option(replans(Replans), Facts),
             option(expanded(Expanded), Facts),
             option(seconds(Seconds), Facts),
             option(steps(Steps), Facts, -),
             option(cost(Cost), Facts, -),
             Ms is Seconds * 1000,
             format("~w~t~30|~t~w~10+~t~w~10+~t~1f~10+~t~w~8+~t~w~8+~n",
                    [Planner, Replans, Expanded, Ms, Steps, Cost])
           )).
