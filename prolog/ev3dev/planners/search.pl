:- module(ev3dev_search,
          [ planner/1,                  % ?Planner
            planner_claim/2,            % ?Planner, ?Claim
            plan/3,                     % +Planner, :Problem, -Plan
            plan/4,                     % +Planner, :Problem, -Plan, -Facts
            planning/3,                 % +Planner, :Problem, -Planning
            replan/5                    % +Start, +Changed, -Result,
                                        % +Planning0, -Planning
          ]).
:- use_module('../private/errors',
              [domain_error/2, must_be/2]).
:- use_module('../private/domains', [finite/1]).
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
%       The cheapest state next.
%     - a_star
%       The same with what is still to come, as the heuristic estimates it.
%     - weighted_a_star(Weight)
%       A* that trusts the heuristic Weight times as much, at least once.
%     - greedy_best_first
%       Always what seems nearest to the goal.
%     - ida_star
%       Depth first to a limit for the cost, with the heuristic.
%     - bidirectional_breadth_first
%     - bidirectional_a_star
%       From both ends at once. They need the option `predecessor`; and the
%       heuristic has to be consistent.
%     - d_star_lite
%       From the goal to the start; when ways change it repairs its last plan
%       with replan/5. It needs the option `predecessor` and a consistent
%       heuristic.
%
%   An unbound Planner is each of these in turn, with 2 for the weight.

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
%   True if that is what a planner promises of its plans. Claim is one of
%
%     - least_cost
%       There is no cheaper one.
%     - fewest_steps
%       There is none of fewer actions.
%     - cost_within(Factor)
%       None is cheaper than by that factor.
%     - any
%       Only that there is one, if there is one at all. This is promised by
%       all.

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
%   if the goal cannot be reached. Problem is `problem(Start, Goal, Options)`:
%   two states, which are any ground terms, or for one goal of several
%   `any(Goals)`. Options:
%
%     - successor(:Closure)
%       Required. call(Closure, State, Action, Next, Cost) is true, on
%       backtracking for each, if Action leads from State to the state Next.
%       Cost is a number above 0.
%     - predecessor(:Closure)
%       The way back: call(Closure, State, Action, Previous, Cost) is true if
%       Action leads from Previous to State.
%     - heuristic(:Closure)
%       call(Closure, From, To, Estimate) is true if it costs at least
%       Estimate to get from one state to another. More than that makes plans
%       that are no longer optimal; it is consistent if no way costs less than
%       the estimate falls along it. By default 0.
%     - expanding(:Closure)
%       call(Closure, State) is called, once, for each state that is expanded.
%
%   Facts tells about the plan and the search:
%
%     - cost(Cost)
%       What the plan costs.
%     - steps(Count)
%       How many actions it has.
%     - expanded(Count)
%       How often a state was expanded, that is, asked for those next to it.
%     - seconds(Seconds)
%       How long it took.
%
%   A search ends if finitely many states can be reached.
%
%   @error domain_error(planner, Planner)
%   @error domain_error(planning_problem, Problem)
%   @error existence_error(problem_option, Name) if the planner needs it
%   @error domain_error(problem_option, Option) for an option that is none
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
%   Solve Problem again and again while the robot goes on and learns. Planning
%   is what Planner knows before its first search; replan/5 searches for a
%   plan from Start, after ways from the states Changed have come, gone, or
%   got other costs, which the problem's closures already tell. Result is
%   `plan(Plan, Facts)` as in plan/4, or `no_plan(Facts)` with only `expanded`
%   and `seconds`. A later Planning replaces the one before.
%
%   The planner d_star_lite uses what it found before. All others start again.
%   So Changed may be more than what has really changed, and has no meaning in
%   a first search.

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
    search(Planner, Space, Start, Goals, Changed, Way, Expanded,
           State0, State),
    get_time(After),
    Seconds is After - Before,
    Planning = planning(Planner, Start, Goals, Space, State),
    result(Way, [expanded(Expanded), seconds(Seconds)], Result).

search(d_star_lite, _, Start, _, Changed, Way, Expanded, State0, State) :-
    !,
    d_star_lite_replan(Start, Changed, Way, Expanded, State0, State).
search(Planner, Space, Start, Goals, _, Way, Expanded, State, State) :-
    search(Planner, Space, Start, Goals, Way, Expanded).

search(breadth_first, Space, Start, Goals, Way, Expanded) :-
    breadth_first(Space, Start, Goals, Way, Expanded).
search(bidirectional_breadth_first, Space, Start, Goals, Way, Expanded) :-
    two_breadth_first(Space, Start, Goals, Way, Expanded).
search(iterative_deepening, Space, Start, Goals, Way, Expanded) :-
    deepening(steps, Space, Start, Goals, Way, Expanded).
search(ida_star, Space, Start, Goals, Way, Expanded) :-
    deepening(cost, Space, Start, Goals, Way, Expanded).
search(bidirectional_a_star, Space, Start, Goals, Way, Expanded) :-
    two_a_star(Space, Start, Goals, Way, Expanded).
search(dijkstra, Space, Start, Goals, Way, Expanded) :-
    best_first(rule(1, 0), Space, Start, Goals, Way, Expanded).
search(a_star, Space, Start, Goals, Way, Expanded) :-
    best_first(rule(1, 1), Space, Start, Goals, Way, Expanded).
search(weighted_a_star(Weight), Space, Start, Goals, Way, Expanded) :-
    best_first(rule(1, Weight), Space, Start, Goals, Way, Expanded).
search(greedy_best_first, Space, Start, Goals, Way, Expanded) :-
    best_first(rule(0, 1), Space, Start, Goals, Way, Expanded).

result(none, Facts, no_plan(Facts)) :-
    !.
result(Way, Facts, plan(Plan, [cost(Cost), steps(Count)|Facts])) :-
    actions(Way, Plan, 0, Cost),
    length(Plan, Count).

actions([], [], Cost, Cost).
actions([step(Action, Cost1)|Steps], [Action|Actions], Cost0, Cost) :-
    Cost2 is Cost0 + Cost1,
    actions(Steps, Actions, Cost2, Cost).
