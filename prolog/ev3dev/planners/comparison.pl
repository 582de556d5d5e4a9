:- module(ev3dev_comparison,
          [ compare_planners/3          % +Map, +Goal, +Options
          ]).
:- use_module(library(apply), [maplist/3]).
:- use_module('../private/errors', [existence_error/2, must_be/2]).
:- use_module(library(lists), [append/3, member/2, reverse/2]).
:- use_module(library(option), [option/2, option/3]).
:- use_module('../private/grid/compass').
:- use_module('../private/grid/map').
:- use_module('../private/grid/problem').
:- use_module('../private/arguments', [must_be_options/3]).
:- use_module(picture).
:- use_module(search).

/** <module> Planners side by side
*/

%!  compare_planners(+Map, +Goal, +Options) is det.
%
%   Let planners drive over Map, one after the other and without a robot, to
%   the state Goal, and print a table of what each needed:
%
%     - replans
%       How often it planned again, since an obstacle was in its way.
%     - expanded
%       How many states it expanded, in all its plans together.
%     - ms
%       How many milliseconds that took.
%     - steps, cost
%       How many actions it took to get there, and what they cost together.
%       Both are missing if there is no way.
%
%   At first the robot knows of no obstacle. Before each move it looks into
%   the next cell, and into those beside a diagonal one. Options:
%
%     - start(+State)
%       Where it starts: by default as drawn in the map's rows, else
%       `state([0,0], [0,1])`.
%     - planners(+Planners)
%       Which are compared: by default all of planner/1.
%     - known(+Boolean)
%       If `true`, the robot knows the whole map from the start. Default is
%       `false`.
%     - svg(+File)
%       Draw for each planner its way, and how often it expanded the states of
%       each cell.
%     - runs(-Runs)
%       True if Runs is a list of what is printed, `run(Planner, Facts)` with
%       replans(Count), expanded(Count), seconds(Seconds), steps(Count) and
%       cost(Cost).
%
%   @error domain_error(planner, Planner)
%   @error domain_error(grid_state, State)
%   @error domain_error(planner_option, Option) for an option that is none

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
    drive(Task, Planner, [], Facts, _).

%   Counting takes time of its own: so the cells are counted in another drive,
%   which goes the same way.

:- thread_local
    known_obstacle/1,                   % Cell
    expanded/1.                         % Cell

planner_panel(Task, run(Planner, Facts), panel(Planner, Facts, Way, Cells)) :-
    retractall(expanded(_)),
    drive(Task, Planner, [expanding(ev3dev_comparison:note)], _, Way),
    findall(Cell, retract(expanded(Cell)), Noted),
    msort(Noted, Cells).

note(state(Cell, _)) :-
    assertz(expanded(Cell)).

%   From Start to Goal over a Map that the planner does not see.

drive(task(Map, Known, Start, Goal), Planner, Watch, Facts, Way) :-
    retractall(known_obstacle(_)),
    (   Known == true
    ->  Seen = Map
    ;   grid_unknown(Map, ev3dev_comparison:not_known, Seen)
    ),
    grid_problem(Seen, Start, Goal, problem(Start, Goals, Options0)),
    append(Watch, Options0, Options),
    planning(Planner, problem(Start, Goals, Options), Planning),
    Start = state(Cell, _),
    drive_on(Planning, [], Start, Map, Seen, [Cell], Way,
             facts(-1, 0, 0, 0, 0), Facts),
    retractall(known_obstacle(_)).

not_known(Cell) :-
    \+ known_obstacle(Cell).

drive_on(Planning0, Found, State, Map, Seen, Way0, Way, Facts0, Facts) :-
    grid_changed(Map, Found, Changed),
    replan(State, Changed, Result, Planning0, Planning),
    planned(Result, Facts0, Facts1),
    (   Result = plan(Plan, _)
    ->  follow(Plan, State, End, Map, Seen, Found1, Way0, Way1,
               Facts1, Facts2),
        (   Found1 == []
        ->  reverse(Way1, Way),
            Facts2 = facts(Replans, Expanded, Seconds, Steps, Cost),
            Facts = [ replans(Replans), expanded(Expanded),
                      seconds(Seconds), steps(Steps), cost(Cost)
                    ]
        ;   drive_on(Planning, Found1, End, Map, Seen, Way1, Way,
                     Facts2, Facts)
        )
    ;   reverse(Way0, Way),
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

follow([], State, State, _, _, [], Way, Way, Facts, Facts).
follow([Action|Plan], State0, State, Map, Seen, Found, Way0, Way,
       Facts0, Facts) :-
    obstacles(Action, State0, Map, Found0),
    (   Found0 == []
    ->  grid_step(Map, Action, State0, State1),
        State1 = state(Cell, _),
        grid_cost(Map, State0, Action, Cost1),
        Facts0 = facts(Plans, Expanded, Seconds, Steps0, Cost0),
        Steps is Steps0 + 1,
        Cost is Cost0 + Cost1,
        follow(Plan, State1, State, Map, Seen, Found, [Cell|Way0], Way,
               facts(Plans, Expanded, Seconds, Steps, Cost), Facts)
    ;   forall(member(Cell, Found0), assertz(known_obstacle(Cell))),
        Found = Found0,
        State = State0,
        Way = Way0,
        Facts = Facts0
    ).

%   What the robot sees before it acts.

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
