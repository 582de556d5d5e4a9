:- module(ev3dev_planners, []).
:- set_prolog_flag(generate_debug_info, false).
:- use_module(private/load/compiled, []).
:- use_module(private/errors/public_clauses, [term_expansion/4]).

/** <module> Planners to compare

Planners for one kind of problem: a robot on a grid, or any puzzle whose
states are Prolog terms. library(ev3dev/planners) offers

  - planners by their names, to solve a problem and to solve it again after a
    change: planner/1, planner_claim/2, plan/3, plan/4, planning/3 and
    replan/5
  - maps of grids and their planning problems: grid_map/2, grid_problem/4
  - policies, which say what to do in each state of a grid: grid_policy/2,
    grid_action/4
  - compare_planners/3, which lets the planners drive over a map and prints a
    table

```
?- plan(breadth_first, problem(1, 10, [successor(step)]), Plan).
Plan = [double, double, add_one, double].
```

with

```
step(N, double, Next, 1) :- Next is 2*N, Next =< 10.
step(N, add_one, Next, 1) :- Next is N+1, Next =< 10.
```
*/

:- reexport(planners/search).
:- reexport(planners/comparison).
:- reexport(private/grid/compass, [direction_heading/2, grid_beside/4]).
:- reexport(private/grid/map,
            except([ grid_unknown/3, must_be_cell/1, must_be_state/2 ])).
:- reexport(private/grid/policy).
:- reexport(private/grid/problem).
