:- module(ev3dev_deepening,
          [ deepening/6                 % +Measure, +Space, +Start, +Goals,
                                        % -Path, -Expanded
          ]).
:- use_module(library(assoc),
              [ assoc_to_values/2, empty_assoc/1, get_assoc/3, put_assoc/4 ]).
:- use_module(library(lists), [reverse/2]).
:- use_module(space).

/** <module> Iterative deepening

Depth first, but no farther than a limit; if the goal is not found, again with
a larger one. Measured in steps this is depth-first iterative deepening;
measured by the cost so far and the least that is still to come, it is IDA*.
*/

%!  deepening(+Measure, +Space, +Start, +Goals, -Path, -Expanded) is det.
%
%   True if Path is the list of `step(Action, Cost)` that lead from Start to
%   one of Goals, or `none`. Expanded is the number of expansions; a state
%   that is expanded again counts again. Measure is `steps` or `cost`.
%
%   On a grid, paths meet again, so their number grows exponentially. So each
%   round stores the measure at which it reached each state, and turns back if
%   it reaches the state again with a measure that is no better. For a state
%   beyond the limit it stores the measure of that state. The next limit is
%   the least of these measures. If no state was beyond the limit, the search
%   has seen all reachable states.

deepening(Measure, Space, Start, Goals, Path, Expanded) :-
    Search = search(Measure, Space, Goals),
    measure(Measure, Space, Start, Goals, 0, Limit),
    rounds(Limit, Start, Search, 0, Path, Expanded).

rounds(Limit, Start, Search, Expanded0, Path, Expanded) :-
    empty_assoc(Seen0),
    visit(Start, 0, [], Limit, Search, Result, Seen0, Seen,
          Expanded0, Expanded1),
    (   Result = found(Reversed)
    ->  reverse(Reversed, Path),
        Expanded = Expanded1
    ;   assoc_to_values(Seen, Values),
        least_beyond(Values, none, Beyond),
        Beyond \== none
    ->  rounds(Beyond, Start, Search, Expanded1, Path, Expanded)
    ;   Path = none,
        Expanded = Expanded1
    ).

least_beyond([], Least, Least).
least_beyond([Value|Values], Least0, Least) :-
    (   Value = beyond(F),
        ( Least0 == none ; F < Least0 )
    ->  least_beyond(Values, F, Least)
    ;   least_beyond(Values, Least0, Least)
    ).

visit(State, G, Path, Limit, Search, Result, Seen0, Seen,
      Expanded0, Expanded) :-
    Search = search(Measure, Space, Goals),
    (   get_assoc(State, Seen0, Value)
    ->  true
    ;   Value = new
    ),
    (   Value = reached(Best),
        G >= Best
    ->  Result = none,
        Seen = Seen0,
        Expanded = Expanded0
    ;   measure(Measure, Space, State, Goals, G, F),
        F > Limit
    ->  Result = none,
        beyond(Value, State, F, Seen0, Seen),
        Expanded = Expanded0
    ;   memberchk(State, Goals)
    ->  Result = found(Path),
        Seen = Seen0,
        Expanded = Expanded0
    ;   put_assoc(State, Seen0, reached(G), Seen1),
        Expanded1 is Expanded0 + 1,
        space_next(Space, State, Nexts),
        visit_all(Nexts, G, Path, Limit, Search, Result, Seen1, Seen,
                  Expanded1, Expanded)
    ).

beyond(new, State, F, Seen0, Seen) :-
    put_assoc(State, Seen0, beyond(F), Seen).
beyond(reached(_), _, _, Seen, Seen).
beyond(beyond(F0), State, F, Seen0, Seen) :-
    (   F < F0
    ->  put_assoc(State, Seen0, beyond(F), Seen)
    ;   Seen = Seen0
    ).

visit_all([], _G, _Path, _Limit, _Search, none, Seen, Seen, Expanded,
          Expanded).
visit_all([way(Action, Next, Cost)|Ways], G0, Path, Limit, Search, Result,
          Seen0, Seen, Expanded0, Expanded) :-
    Search = search(Measure, _, _),
    (   Measure == steps
    ->  G is G0 + 1
    ;   G is G0 + Cost
    ),
    visit(Next, G, [step(Action, Cost)|Path], Limit, Search, Result1,
          Seen0, Seen1, Expanded0, Expanded1),
    (   Result1 = found(_)
    ->  Result = Result1,
        Seen = Seen1,
        Expanded = Expanded1
    ;   visit_all(Ways, G0, Path, Limit, Search, Result, Seen1, Seen,
                  Expanded1, Expanded)
    ).

measure(steps, _, _, _, G, G).
measure(cost, Space, State, Goals, G, F) :-
    space_estimate(Space, State, Goals, H),
    F is G + H.
