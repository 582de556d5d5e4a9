:- module(ev3dev_best_first,
          [ best_first/6                % +Rule, +Space, +Start, +Goals,
                                        % -Path, -Expanded
          ]).
:- use_module(library(assoc), [get_assoc/3, list_to_assoc/2, put_assoc/4]).
:- use_module(library(heaps),
              [add_to_heap/4, get_from_heap/4, singleton_heap/3]).
:- use_module(space).

/** <module> Best-first search

One search for four planners. It expands the state with the least `P*G + Q*H`
next, where G is the cost of the path to the state and H the estimated least
cost from there. Dijkstra's algorithm is the rule P, Q = 1, 0, A* is 1, 1,
weighted A* 1, W, and greedy search 0, 1.
*/

%!  best_first(+Rule, +Space, +Start, +Goals, -Path, -Expanded) is det.
%
%   True if Path is the list of `step(Action, Cost)` that lead from Start to
%   one of Goals, or `none`. Expanded is the number of expanded states. Rule
%   is `rule(P, Q)`.
%
%   The search keeps the best path to each state. If it finds a better path to
%   a state, it puts the state into the heap again, and later ignores the
%   older entry. So A* does not need a consistent heuristic.

best_first(Rule, Space, Start, Goals, Path, Expanded) :-
    Search = search(Rule, Space, Goals),
    list_to_assoc([Start-reached(0, none)], Reached),
    singleton_heap(Heap, 0, Start-0),
    search(Heap, Reached, 0, Search, Path, Expanded).

search(Heap0, Reached0, Expanded0, Search, Path, Expanded) :-
    get_from_heap(Heap0, _, State-G, Heap1),
    !,
    get_assoc(State, Reached0, reached(Best, _)),
    Search = search(_, Space, Goals),
    (   G > Best
    ->  search(Heap1, Reached0, Expanded0, Search, Path, Expanded)
    ;   memberchk(State, Goals)
    ->  way(State, Reached0, [], Path),
        Expanded = Expanded0
    ;   Expanded1 is Expanded0 + 1,
        space_next(Space, State, Nexts),
        reach(Nexts, State, G, Search, Heap1, Heap, Reached0, Reached),
        search(Heap, Reached, Expanded1, Search, Path, Expanded)
    ).
search(_, _, Expanded, _, none, Expanded).

reach([], _, _, _, Heap, Heap, Reached, Reached).
reach([way(Action, Next, Cost)|Ways], State, G0, Search,
      Heap0, Heap, Reached0, Reached) :-
    G is G0 + Cost,
    Search = search(Rule, Space, Goals),
    (   better(Rule, Next, G, Reached0)
    ->  put_assoc(Next, Reached0, reached(G, from(State, Action, Cost)),
                  Reached1),
        priority(Rule, Space, Next, Goals, G, Priority),
        add_to_heap(Heap0, Priority, Next-G, Heap1),
        reach(Ways, State, G0, Search, Heap1, Heap, Reached1, Reached)
    ;   reach(Ways, State, G0, Search, Heap0, Heap, Reached0, Reached)
    ).

%   A greedy search keeps the first path to a state.

better(rule(P, _), Next, G, Reached) :-
    (   get_assoc(Next, Reached, reached(Best, _))
    ->  P > 0,
        G < Best
    ;   true
    ).

%   Among states with equal keys the one with the larger G comes first.

priority(rule(P, Q), Space, State, Goals, G, F-Last) :-
    (   Q =:= 0
    ->  F is P*G
    ;   space_estimate(Space, State, Goals, H),
        F is P*G + Q*H
    ),
    Last is -G.

way(State, Reached, Path0, Path) :-
    get_assoc(State, Reached, reached(_, From)),
    (   From = from(Before, Action, Cost)
    ->  way(Before, Reached, [step(Action, Cost)|Path0], Path)
    ;   Path = Path0
    ).
