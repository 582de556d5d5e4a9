:- module(ev3dev_space,
          [ search_space/4,             % :Problem, -Start, -Goals, -Space
            needs_way_back/1,           % +Space
            space_next/3,               % +Space, +State, -Nexts
            space_previous/3,           % +Space, +State, -Previous
            space_ways/3,               % +Space, +State, -Nexts
            space_estimate/4            % +Space, +From, +Goals, -Estimate
          ]).
:- use_module('../private/checks/checks', [must_be/2]).
:- use_module('../private/errors/errors',
              [domain_error/2, existence_error/2, instantiation_error/1]).
:- use_module(library(option), [meta_options/3, option/3]).
:- use_module('../private/checks/arguments', [must_be_options/3]).
:- use_module('../private/errors/domains', [finite/1]).

/** <module> The space that a planner searches

Planners ask a problem for the successors of a state, its predecessors, and
the estimated cost to the goal. This module checks each answer of the
problem's closures, for all planners.
*/

:- meta_predicate search_space(:, -, -, -).

%!  search_space(:Problem, -Start, -Goals, -Space) is det.
%
%   True if Problem, as plan/3 describes it, asks for a path from Start to one
%   of the list Goals through Space.
%
%   @error domain_error(planning_problem, Problem)
%   @error existence_error(problem_option, successor)
%   @error domain_error(problem_option, Option) if Option is not an option of
%          this predicate

search_space(Module:Problem, Start, Goals, Space) :-
    must_be(nonvar, Problem),
    (   Problem = problem(Start, Goal, Options0)
    ->  true
    ;   domain_error(planning_problem, Problem)
    ),
    must_be(ground, Start),
    must_be(ground, Goal),
    must_be_options(problem_option,
                    [successor, predecessor, heuristic, expanding],
                    Options0),
    goals(Goal, Goals),
    meta_options(closure, Module:Options0, Options),
    option(successor(Successor), Options, none),
    option(predecessor(Predecessor), Options, none),
    option(heuristic(Heuristic), Options, none),
    option(expanding(Watcher), Options, none),
    (   Successor == none
    ->  existence_error(problem_option, successor)
    ;   Space = space(Successor, Predecessor, Heuristic, Watcher)
    ).

closure(successor).
closure(predecessor).
closure(heuristic).
closure(expanding).

goals(any(Goals), Goals) :-
    !,
    must_be(list, Goals).
goals(Goal, [Goal]).

%!  needs_way_back(+Space)
%
%   Throw unless Space can return the predecessors of a state.
%
%   @error existence_error(problem_option, predecessor)

needs_way_back(space(_, none, _, _)) :-
    !,
    existence_error(problem_option, predecessor).
needs_way_back(_).

%!  space_next(+Space, +State, -Nexts) is det.
%!  space_previous(+Space, +State, -Previous) is det.
%
%   Expand a state: true if Nexts is the list of `way(Action, Next, Cost)`
%   that lead from State to Next, or from Previous to State. Calls the option
%   `expanding` of the problem.

space_next(Space, State, Nexts) :-
    watched(Space, State),
    space_ways(Space, State, Nexts).

space_previous(Space, State, Previous) :-
    watched(Space, State),
    Space = space(_, Predecessor, _, _),
    ways(Predecessor, State, Previous).

watched(space(_, _, _, none), _) :-
    !.
watched(space(_, _, _, Watcher), State) :-
    ignore(call(Watcher, State)).

%!  space_ways(+Space, +State, -Nexts) is det.
%
%   Like space_next/3, but without calling the option `expanding`.

space_ways(space(Successor, _, _, _), State, Nexts) :-
    ways(Successor, State, Nexts).

ways(Closure, State, Ways) :-
    findall(way(Action, Next, Cost),
            ( call(Closure, State, Action, Next, Cost),
              check_way(Next, Cost)
            ),
            Ways).

check_way(Next, Cost) :-
    number(Cost),
    Cost > 0,
    finite(Cost),
    ground(Next),
    !.
check_way(Next, Cost) :-
    must_be(number, Cost),
    (   ground(Next)
    ->  domain_error(positive_number, Cost)
    ;   instantiation_error(Next)
    ).

%!  space_estimate(+Space, +From, +Goals, -Estimate) is det.
%
%   True if a path from the state From to any of Goals costs at least Estimate
%   by the problem's heuristic.

space_estimate(space(_, _, none, _), _, _, 0) :-
    !.
space_estimate(_, _, [], 0) :-
    !.
space_estimate(space(_, _, Heuristic, _), From, Goals, Estimate) :-
    Goals = [Goal|Others],
    estimate(Goal, Heuristic, From, Estimate0),
    estimates(Others, Heuristic, From, Estimate0, Estimate).

estimates([], _, _, Estimate, Estimate).
estimates([Goal|Goals], Heuristic, From, Estimate0, Estimate) :-
    estimate(Goal, Heuristic, From, Estimate1),
    (   Estimate1 < Estimate0
    ->  estimates(Goals, Heuristic, From, Estimate1, Estimate)
    ;   estimates(Goals, Heuristic, From, Estimate0, Estimate)
    ).

estimate(Goal, Heuristic, From, Estimate) :-
    call(Heuristic, From, Goal, Estimate0),
    !,
    (   number(Estimate0)
    ->  Estimate = Estimate0
    ;   must_be(number, Estimate0)
    ).
estimate(Goal, Heuristic, From, _) :-
    domain_error(heuristic(From, Goal), Heuristic).
