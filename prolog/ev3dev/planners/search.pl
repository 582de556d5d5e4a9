:- module(ev3dev_search,
          [ planner/1,                  % ?Planner
            planner_claim/2,            % ?Planner, ?Claim
            plan/3,                     % +Planner, :Problem, -Plan
            plan/4,                     % +Planner, :Problem, -Plan, -Facts
            planning/3,                 % +Planner, :Problem, -Planning
            replan/5                    % +Start, +Changed, -Result,
                                        % +Planning0, -Planning
          ]).
:- use_module('../private/checks/checks', [must_be/2]).
:- use_module('../private/errors/errors', [domain_error/2]).
:- use_module('../private/errors/public_clauses', [term_expansion/4]).
:- use_module('../private/errors/domains', [finite/1]).
:- use_module(best_first).
:- use_module(breadth_first).
:- use_module(d_star_lite).
:- use_module(deepening).
:- use_module(space).
:- use_module(two_a_star).

/** <module> Planners by their names
*/

:- meta_predicate
    plan(+, :, -),
    plan(+, :, -, -),
    planning(+, :, -).

%!  planner(?Planner) is nondet.
%
%   True if there is a planner of that name:
%
%     - breadth_first
%       Level by level: all states one step away, then those at two, ...
%     - iterative_deepening
%       Depth first to a limit that grows step by step.
%     - dijkstra
%       Expands the state with the least cost from the start next.
%     - a_star
%       Like dijkstra, but adds the heuristic's estimate of the cost to the
%       goal.
%     - weighted_a_star(Weight)
%       Like a_star, but multiplies the estimate by Weight, which is at least
%       1.
%     - greedy_best_first
%       Expands the state with the least estimate next.
%     - ida_star
%       Depth first to a limit for the cost, with the heuristic.
%     - bidirectional_breadth_first
%     - bidirectional_a_star
%       Search from both ends at once. They need the option `predecessor` and
%       a consistent heuristic.
%     - d_star_lite
%       Searches from the goal to the start. After a change, replan/5 repairs
%       its last plan. It needs the option `predecessor` and a consistent
%       heuristic.
%
%   An unbound Planner enumerates these, with the weight 2.

planner(Planner) :-
    (   var(Planner)
    ->  planner_claim(Planner, _)
    ;   known(Planner)
    ->  true
    ).

known(Planner) :-
    claim(Planner, _),
    !.
known(weighted_a_star(Weight)) :-
    number(Weight),
    Weight >= 1,
    finite(Weight).

%!  planner_claim(?Planner, ?Claim) is nondet.
%
%   True if Planner promises Claim of its plans. Claim is one of
%
%     - least_cost
%       No plan is cheaper.
%     - fewest_steps
%       No plan has fewer actions.
%     - cost_within(Factor)
%       The plan costs at most Factor times the least cost.
%     - any
%       The planner finds a plan if one exists. All planners promise this.

planner_claim(Planner, Claim) :-
    nonvar(Planner),
    Planner = weighted_a_star(Weight),
    nonvar(Weight),
    !,
    known(Planner),
    Claim = cost_within(Weight).
planner_claim(Planner, Claim) :-
    claim(Planner, Claim).

claim(breadth_first,               fewest_steps).
claim(bidirectional_breadth_first, fewest_steps).
claim(iterative_deepening,         fewest_steps).
claim(dijkstra,                    least_cost).
claim(a_star,                      least_cost).
claim(weighted_a_star(2),          cost_within(2)).
claim(ida_star,                    least_cost).
claim(bidirectional_a_star,        least_cost).
claim(d_star_lite,                 least_cost).
claim(greedy_best_first,           any).

%!  plan(+Planner, :Problem, -Plan) is semidet.
%!  plan(+Planner, :Problem, -Plan, -Facts) is semidet.
%
%   True if Plan is the list of actions by which Planner solves Problem. Fails
%   if no plan reaches the goal. Problem is `problem(Start, Goal, Options)`.
%   Start and Goal are states, which are any ground terms. The Goal
%   `any(Goals)` stands for any state of a list. Options:
%
%     - successor(:Closure)
%       Required. call(Closure, State, Action, Next, Cost) is true, on
%       backtracking for each, if Action leads from State to the state Next.
%       Cost is a number above 0.
%     - predecessor(:Closure)
%       The reverse: call(Closure, State, Action, Previous, Cost) is true if
%       Action leads from Previous to State.
%     - heuristic(:Closure)
%       call(Closure, From, To, Estimate) is true if a path from state From to
%       state To costs at least Estimate. If an estimate is too high, plans
%       may not be optimal. A heuristic is consistent if no action costs less
%       than the estimate falls by it. By default Estimate is 0.
%     - expanding(:Closure)
%       The search calls call(Closure, State) once for each expanded state.
%
%   Facts describes the plan and the search:
%
%     - cost(Cost)
%       The cost of the plan.
%     - steps(Count)
%       The number of actions.
%     - expanded(Count)
%       The number of expansions. To expand a state is to ask for its
%       successors.
%     - seconds(Seconds)
%       The time of the search.
%
%   A search ends if the number of reachable states is finite.
%
%   @error domain_error(planner, Planner)
%   @error domain_error(planning_problem, Problem)
%   @error existence_error(problem_option, Name) if the planner needs it
%   @error domain_error(problem_option, Option) if Option is not an option of
%          this predicate
%   @error domain_error(positive_number, Cost)

plan(Planner, Problem, Plan) :-
    plan(Planner, Problem, Plan, _).

plan(Planner, Problem, Plan, Facts) :-
    planning(Planner, Problem, Planning),
    start(Planning, Start),
    replan(Start, [], plan(Plan, Facts), Planning, _).

%!  planning(+Planner, :Problem, -Planning) is det.
%!  replan(+Start, +Changed, -Result, +Planning0, -Planning) is det.
%
%   Solve Problem again and again while the robot moves and learns. Planning
%   is the state of Planner before its first search. replan/5 searches for a
%   plan from Start. Changed is the list of states whose actions appeared,
%   disappeared or changed their costs; the closures of the problem already
%   return the new actions. Result is `plan(Plan, Facts)` as in plan/4, or
%   `no_plan(Facts)` with only `expanded` and `seconds`. Each Planning
%   replaces the one before.
%
%   The planner d_star_lite uses its earlier results. All others start again.
%   Changed may also contain states that have not changed. In the first search
%   it has no meaning.

planning(Planner, Problem, planning(Planner, Start, Goals, Space, State)) :-
    must_be_planner(Planner),
    search_space(Problem, Start, Goals, Space),
    (   Planner == d_star_lite
    ->  d_star_lite(Space, Start, Goals, State)
    ;   State = none
    ).

must_be_planner(Planner) :-
    must_be(ground, Planner),
    (   known(Planner)
    ->  true
    ;   domain_error(planner, Planner)
    ).

start(planning(_, Start, _, _, _), Start).

replan(Start, Changed, Result, Planning0, Planning) :-
    must_be(ground, Start),
    must_be(list, Changed),
    must_be(nonvar, Planning0),
    (   Planning0 = planning(Planner, _, Goals, Space, State0)
    ->  true
    ;   domain_error(planning, Planning0)
    ),
    get_time(Before),
    search(Planner, Space, Start, Goals, Changed, Path, Expanded,
           State0, State),
    get_time(After),
    Seconds is After - Before,
    Planning = planning(Planner, Start, Goals, Space, State),
    result(Path, [expanded(Expanded), seconds(Seconds)], Result).

search(d_star_lite, _, Start, _, Changed, Path, Expanded, State0, State) :-
    !,
    d_star_lite_replan(Start, Changed, Path, Expanded, State0, State).
search(Planner, Space, Start, Goals, _, Path, Expanded, State, State) :-
    search(Planner, Space, Start, Goals, Path, Expanded).

search(breadth_first, Space, Start, Goals, Path, Expanded) :-
    breadth_first(Space, Start, Goals, Path, Expanded).
search(bidirectional_breadth_first, Space, Start, Goals, Path, Expanded) :-
    two_breadth_first(Space, Start, Goals, Path, Expanded).
search(iterative_deepening, Space, Start, Goals, Path, Expanded) :-
    deepening(steps, Space, Start, Goals, Path, Expanded).
search(ida_star, Space, Start, Goals, Path, Expanded) :-
    deepening(cost, Space, Start, Goals, Path, Expanded).
search(bidirectional_a_star, Space, Start, Goals, Path, Expanded) :-
    two_a_star(Space, Start, Goals, Path, Expanded).
search(dijkstra, Space, Start, Goals, Path, Expanded) :-
    best_first(rule(1, 0), Space, Start, Goals, Path, Expanded).
search(a_star, Space, Start, Goals, Path, Expanded) :-
    best_first(rule(1, 1), Space, Start, Goals, Path, Expanded).
search(weighted_a_star(Weight), Space, Start, Goals, Path, Expanded) :-
    best_first(rule(1, Weight), Space, Start, Goals, Path, Expanded).
search(greedy_best_first, Space, Start, Goals, Path, Expanded) :-
    best_first(rule(0, 1), Space, Start, Goals, Path, Expanded).

result(none, Facts, no_plan(Facts)) :-
    !.
result(Path, Facts, plan(Plan, [cost(Cost), steps(Count)|Facts])) :-
    actions(Path, Plan, 0, Cost),
    length(Plan, Count).

actions([], [], Cost, Cost).
actions([step(Action, Cost1)|Steps], [Action|Actions], Cost0, Cost) :-
    Cost2 is Cost0 + Cost1,
    actions(Steps, Actions, Cost2, Cost).
