:- module(ev3dev_grid,
          [ plan_and_go_to/2,           % +Cell, ?Direction
            plan_and_go_to/3,           % +Cell, ?Direction, :Options
            execute_plan/1              % +Plan
          ]).
:- set_prolog_flag(generate_debug_info, false).
:- use_module(private/load/compiled, []).
:- use_module(private/checks/checks, [must_be/2]).
:- use_module(private/errors/error_texts, [shown/2]).
:- use_module(private/errors/errors, [domain_error/2]).
:- use_module(private/errors/public_clauses, [term_expansion/4]).
:- use_module(private/explain/hints).
:- use_module(library(lists), [append/3, member/2]).
:- use_module(library(option), [meta_options/3, option/2, option/3]).
:- use_module(private/grid/knowledge).
:- use_module(private/grid/map).
:- use_module(private/grid/moves).
:- use_module(private/grid/place).
:- use_module(private/grid/problem).
:- use_module(private/checks/arguments, [must_be_options/3]).
:- use_module(planners/search).
:- reexport(private/grid/knowledge,
            [obstructed/1, obstacle_add/1, obstacle_remove/1]).
:- reexport(private/grid/compass, [direction_heading/2, grid_beside/4]).
:- reexport(private/grid/map,
            except([ grid_unknown/3, must_be_cell/1, must_be_state/2 ])).
:- reexport(private/grid/problem).
:- reexport(private/grid/policy).
:- reexport(private/grid/place, [set_grid/1, grid_place/2, state_position/2]).

/** <module> Finding a way over an unknown grid

The robot of the paper's section 6. It knows the cell in which it is and the
one to which it should go, plans a way, takes it, and looks before each move.
Where its ultrasonic sensor sees something in the next cell it notes an
obstacle, and plans again from where it stands.

```
?- use_module(library(ev3dev)), use_module(library(ev3dev/grid)).
?- set_robot(5.6, 10.6, outB, outC).
?- set_grid([]).
?- plan_and_go_to([3, 3], [0, 1]).
```

Cells, directions and the actions of plans are those of grid_map/2: `[X, Y]`,
`[DX, DY]`, and `move`, `left` and `right`. An option chooses the planner.

The middle of the cell `[X, Y]` is at `20*X, 20*Y` for pose/3, if cells are
20 cm wide. Each move goes to such a place, so that errors do not add up. With
eight neighbors the robot also looks into the two cells beside a diagonal
move, unless it knows already that they are free.
*/

:- meta_predicate plan_and_go_to(+, ?, :).

%!  plan_and_go_to(+Cell, ?Direction) is semidet.
%!  plan_and_go_to(+Cell, ?Direction, :Options) is semidet.
%
%   Go to a cell and look in a direction there, in any if it is unbound.
%   Waits. Fails, and prints why, if what is known by then leaves no way, or
%   if the robot cannot go on. Fails if there is no grid. Options:
%
%     - planner(:Planner)
%       One of planner/1, by default `d_star_lite`, or any other closure:
%       call(Planner, Start, Goal, Plan) shall be true, at least once, if Plan
%       leads from Start to Goal, both `state(Cell, Direction)`. It asks
%       obstructed/1.
%     - reason(-Reason)
%       Do not fail, nor print, but report how it ended:
%
%         - reached
%         - no_way
%           The goal cannot be reached, as far as is known, or an own planner
           fails.
%         - no_sensor
%           No ultrasonic sensor is connected.
%         - bad_plan
%           The plan of an own planner leads to another state, off the map, or
%           into a cell that is known to be obstructed.
%         - no_robot
%           No robot is set, or a motor is not connected.
%         - stalled, timeout, stopped, unplugged, astray
%           A move ended so, as with the moves of library(ev3dev/drive). Where
%           the robot is stalled by what its sensor did not see, it takes that
%           for an obstacle and goes back; this is reported only if it cannot.
%           Where it may be in the middle of the cell by then, as far as
%           pose_uncertainty/1 says, it has reached the cell.
%
%     - tell(:Closure)
%       call(Closure, Event) is called when something happens:
%       `plan(Start, Plan)`, `obstacle(Cell)`, `at(Cell, Direction)`.
%
%   An obstacle that fades while the robot is under way is thought of only
%   when it has to plan again.
%
%   @error domain_error(planner, Planner)
%   @error domain_error(grid_state, State)
%   @error domain_error(grid_action, Action)
%   @error domain_error(grid_option, Option) if Option is not an option here

plan_and_go_to(Cell, Direction) :-
    plan_and_go_to(Cell, Direction, []).

plan_and_go_to(Cell, Direction, Module:Options0) :-
    must_be_options(grid_option, [planner, reason, tell], Options0),
    meta_options(closure, Module:Options0, Options),
    option(planner(Planner0), Options, Module:d_star_lite),
    option(tell(Tell), Options, ev3dev_grid:nobody),
    planner_meant(Planner0, Planner),
    grid(Map, _),
    Goal = state(Cell, Direction),
    state_position(Cell0, Direction0),
    grid_problem(Map, state(Cell0, Direction0), Goal, Problem),
    saw_free(Cell0),
    planning_of(Planner, Problem, Goal, Planning),
    go_on(Planning, [], trip(Map, Goal, Tell), Reason),
    ended(Reason, Options, Goal).

closure(planner).
closure(tell).

nobody(_).

%   A planner of the library by its name, or a closure.

planner_meant(Module:Planner, Meant) :-
    must_be(nonvar, Planner),
    (   planner(Planner)
    ->  Meant = Planner
    ;   callable(Planner),
        Planner =.. [Name|Arguments],
        length(Arguments, Count),
        Arity is Count + 3,
        functor(Head, Name, Arity),
        predicate_property(Module:Head, visible)
    ->  Meant = own(Module:Planner)
    ;   domain_error(planner, Planner)
    ).

planning_of(own(Closure), _, Goal, own(Closure, Goal)) :-
    !.
planning_of(Planner, Problem, _, Planning) :-
    planning(Planner, Problem, Planning).

%   Plan, go, and again if something is found. Changed are the cells of which
%   the robot knows better since the last plan.

go_on(Planning0, Changed0, Trip, Reason) :-
    Trip = trip(Map, _, Tell),
    obstacles_fade(Faded),
    append(Faded, Changed0, Cells),
    grid_changed(Map, Cells, Changed),
    state_position(Cell, Direction),
    Start = state(Cell, Direction),
    next_plan(Planning0, Map, Start, Changed, Result, Planning),
    (   Result = plan(Plan)
    ->  ignore(call(Tell, plan(Start, Plan))),
        carry_out(Plan, Tell, Outcome),
        after(Outcome, Planning, Trip, Reason)
    ;   Reason = Result
    ).

after(done, _, trip(_, Goal, _), reached) :-
    state_position(Cell, Direction),
    Goal = state(Cell, Direction).
after(found(Cells), Planning, Trip, Reason) :-
    Trip = trip(_, _, Tell),
    forall(member(Cell, Cells), ignore(call(Tell, obstacle(Cell)))),
    go_on(Planning, Cells, Trip, Reason).
after(ended(Reason), _, _, Reason).

next_plan(own(Closure, Goal), Map, Start, _, Result, own(Closure, Goal)) :-
    !,
    copy_term(Goal, End),
    (   call(Closure, Start, End, Plan)
    ->  must_be(list, Plan),
        (   leads(Plan, Map, Start, Goal)
        ->  Result = plan(Plan)
        ;   Result = bad_plan
        )
    ;   Result = failed(Closure, Start, End)
    ).
next_plan(Planning0, _, Start, Changed, Result, Planning) :-
    replan(Start, Changed, Result0, Planning0, Planning),
    (   Result0 = plan(Plan, _)
    ->  Result = plan(Plan)
    ;   Result = no_way
    ).

leads([], _, State, Goal) :-
    \+ State \= Goal.
leads([Action|Plan], Map, State0, Goal) :-
    grid_step(Map, Action, State0, State),
    State = state(Cell, _),
    (   Action == move
    ->  free_cell(Map, Cell)
    ;   true
    ),
    leads(Plan, Map, State, Goal).

ended(Reason, Options, Goal) :-
    (   option(reason(Told), Options)
    ->  (   Reason = failed(_, _, _)
        ->  Told = no_way
        ;   Told = Reason
        )
    ;   Reason == reached
    ->  true
    ;   print_message(warning, ev3dev(grid(Reason, Goal))),
        fail
    ).

%!  execute_plan(+Plan) is semidet.
%
%   Carry out the actions of a plan, `move`, `left` and `right`, from where
%   the robot is. Plans of the paper do, too: `move_if_free`, `turn_left`,
%   `turn_right`, and `fin` at the end. Waits. Fails at the first that is not
%   possible: there is an obstacle, which is noted, or the edge of the map, or
%   any other reason of plan_and_go_to/3; state_position/2 says how far the
%   robot has come.
%
%   @error domain_error(grid_action, Action)

execute_plan(Plan) :-
    must_be(list, Plan),
    plan_actions(Plan, Actions),
    carry_out(Actions, nobody, Outcome),
    (   Outcome == done
    ->  true
    ;   explain("the plan was broken off: ~w", [Outcome]),
        fail
    ).

plan_actions([], []).
plan_actions([Last], []) :-
    Last == fin,
    !.
plan_actions([Action0|Plan], [Action|Actions]) :-
    (   nonvar(Action0),
        paper_action(Action0, Action)
    ->  true
    ;   Action = Action0
    ),
    plan_actions(Plan, Actions).

paper_action(move_if_free, move).
paper_action(turn_left, left).
paper_action(turn_right, right).

obstructed_cells(Cells) :-
    findall(Cell, obstructed(Cell), Cells).

:- multifile prolog:message//1.

prolog:message(ev3dev(grid(Reason, state(Cell, _)))) -->
    [ 'The robot does not get to ~w: '-[Cell] ],
    grid_message(Reason).

grid_message(no_way) -->
    { obstructed_cells(Cells) },
    [ 'there is no way, with obstacles in ~w.'-[Cells] ].
grid_message(failed(_:Planner, Start, End)) -->
    { Planner =.. List0,
      append(List0, [Start, End, '$VAR'('Plan')], List),
      Call0 =.. List,
      shown(Call0, Call),
      obstructed_cells(Cells) },
    [ 'the planner found no plan:'-[], nl,
      '  ~w failed, with obstacles in ~w.'-[Call, Cells] ].
grid_message(no_sensor) -->
    [ 'no ultrasonic sensor is connected.' ].
grid_message(no_robot) -->
    [ 'no robot is set, or a motor is not connected.' ].
grid_message(bad_plan) -->
    [ 'the planner\'s plan does not lead there over free cells.' ].
grid_message(Reason) -->
    [ 'the move ended early (~w).'-[Reason] ].
