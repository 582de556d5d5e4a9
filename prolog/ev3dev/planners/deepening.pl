:- module(ev3dev_deepening,
          [ deepening/6                 % +Measure, +Space, +Start, +Goals,
                                        % -Way, -Expanded
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

%!  deepening(+Measure, +Space, +Start, +Goals, -Way, -Expanded) is det.
%
%   True if Way is the list of `step(Action, Cost)` that lead from Start to
%   one of Goals, or `none`, found after expanding so many states, each time
%   counted. Measure is `steps` or `cost`.
%
%   Where ways meet again, as on a grid, there are exponentially many of them.
%   So each round notes of each state how it was reached, and turns back where
%   it comes again no better; or else by how much the state was beyond the
%   limit. The next limit is the least of these measures. When there is none,
%   all that can be reached has been seen.

deepening(Measure, Space, Start, Goals, Way, Expanded) :-
    Search = search(Measure, Space, Goals),
    measure(Measure, Space, Start, Goals, 0, Limit),
    rounds(Limit, Start, Search, 0, Way, Expanded).

rounds(Limit, Start, Search, Expanded0, Way, Expanded) :-
    empty_assoc(Seen0),
    visit(Start, 0, [], Limit, Search, Result, Seen0, Seen,
          Expanded0, Expanded1),
    (   Result = found(Reversed)
    ->  reverse(Reversed, Way),
        Expanded = Expanded1
    ;   assoc_to_values(Seen, Values),
        least_beyond(Values, none, Beyond),
        Beyond \== none
    ->  rounds(Beyond, Start, Search, Expanded1, Way, Expanded)
    ;   Way = none,
        Expanded = Expanded1
    ).

least_beyond([], Least, Least).
least_beyond([Value|Values], Least0, Least) :-
    (   Value = beyond(F),
        ( Least0 == none ; F < Least0 )
    ->  least_beyond(Values, F, Least)
    ;   least_beyond(Values, Least0, Least)
    ).

visit(State, G, Way, Limit, Search, Result, Seen0, Seen,
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
    ->  Result = found(Way),
        Seen = Seen0,
        Expanded = Expanded0
    ;   put_assoc(State, Seen0, reached(G), Seen1),
        Expanded1 is Expanded0 + 1,
        space_next(Space, State, Nexts),
        visit_all(Nexts, G, Way, Limit, Search, Result, Seen1, Seen,
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

visit_all([], _, _, _, _, none, Seen, Seen, Expanded, Expanded).
visit_all([way(Action, Next, Cost)|Ways], G0, Way, Limit, Search, Result,
          Seen0, Seen, Expanded0, Expanded) :-
    Search = search(Measure, _, _),
    (   Measure == steps
    ->  G is G0 + 1
    ;   G is G0 + Cost
    ),
    visit(Next, G, [step(Action, Cost)|Way], Limit, Search, Result1,
          Seen0, Seen1, Expanded0, Expanded1),
    (   Result1 = found(_)
    ->  Result = Result1,
        Seen = Seen1,
        Expanded = Expanded1
    ;   visit_all(Ways, G0, Way, Limit, Search, Result, Seen1, Seen,
                  Expanded1, Expanded)
    ).

measure(steps, _, _, _, G, G).
measure(cost, Space, State, Goals, G, F) :-
    space_estimate(Space, State, Goals, H),
    F is G + H.
