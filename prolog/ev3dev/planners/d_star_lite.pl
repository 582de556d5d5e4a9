:- module(ev3dev_d_star_lite,
          [ d_star_lite/4,              % +Space, +Start, +Goals, -Search
            d_star_lite_replan/6        % +Start, +Changed, -Path, -Expanded,
                                        % +Search0, -Search
          ]).
:- use_module(library(assoc),
              [ empty_assoc/1, get_assoc/3, list_to_assoc/2, put_assoc/4 ]).
:- use_module(library(heaps),
              [add_to_heap/4, empty_heap/1, get_from_heap/4, min_of_heap/3]).
:- use_module(library(lists), [member/2]).
:- use_module(space).

/** <module> D* Lite

Searches from the goal to the robot's state, and keeps the results. When the
map changes after the robot has moved, it searches again only the part that
the change affects (Koenig, Likhachev: D* Lite, 2002).

Each state has a G, the cost from there to the goal as computed so far, and an
RHS, the cost computed from the G of its successors. If the two differ, the
state is in the heap, with `k(K1, K2)` as its key.
*/

%!  d_star_lite(+Space, +Start, +Goals, -Search) is det.
%
%   True if Search is the state of a search before its first plan.

d_star_lite(Space, Start, Goals0, Search) :-
    needs_way_back(Space),
    sort(Goals0, Goals),
    findall(Goal-goal, member(Goal, Goals), Pairs),
    list_to_assoc(Pairs, GoalSet),
    empty_heap(Heap0),
    empty_assoc(Values0),
    Fixed = fixed(Space, Start, GoalSet, 0),
    begin(Goals, Fixed, Heap0, Heap, Values0, Values),
    Search = d_star_lite(Fixed, Heap, Values).

begin([], _, Heap, Heap, Values, Values).
begin([Goal|Goals], Fixed, Heap0, Heap, Values0, Values) :-
    endless(Inf),
    update(Goal, Inf, 0, Fixed, Heap0, Heap1, Values0, Values1),
    begin(Goals, Fixed, Heap1, Heap, Values1, Values).

%!  d_star_lite_replan(+Start, +Changed, -Path, -Expanded,
%!                     +Search0, -Search) is det.
%
%   True if Path is the list of `step(Action, Cost)` that lead from Start to
%   the goal, or `none`. Expanded is the number of states that this call
%   expanded. The actions in the states Changed, or their costs, have changed.

d_star_lite_replan(Start, Changed, Path, Expanded,
                   d_star_lite(Fixed0, Heap0, Values0), Search) :-
    Fixed0 = fixed(Space, Last, Goals, Km0),
    (   Start == Last
    ->  Km = Km0
    ;   space_estimate(Space, Last, [Start], Moved),
        Km is Km0 + Moved
    ),
    Fixed = fixed(Space, Start, Goals, Km),
    look_again(Changed, Fixed, Heap0, Heap1, Values0, Values1),
    improve(0, Expanded, Fixed, Heap1, Heap, Values1, Values),
    Search = d_star_lite(Fixed, Heap, Values),
    value(Start, Values, _, Rhs),
    endless(Inf),
    (   Rhs < Inf
    ->  descend(Start, Fixed, Values, Path)
    ;   Path = none
    ).

look_again([], _, Heap, Heap, Values, Values).
look_again([State|States], Fixed, Heap0, Heap, Values0, Values) :-
    rate(State, Fixed, Heap0, Heap1, Values0, Values1),
    look_again(States, Fixed, Heap1, Heap, Values1, Values).

%   Compute the RHS of a state from its successors.

rate(State, Fixed, Heap0, Heap, Values0, Values) :-
    Fixed = fixed(Space, _, Goals, _),
    value(State, Values0, G, _),
    (   get_assoc(State, Goals, _)
    ->  Rhs = 0
    ;   space_ways(Space, State, Ways),
        endless(Inf),
        least(Ways, Values0, Inf, Rhs, none, _)
    ),
    update(State, G, Rhs, Fixed, Heap0, Heap, Values0, Values).

least([], _, Least, Least, Best, Best).
least([way(Action, Next, Cost)|Ways], Values, Least0, Least, Best0, Best) :-
    value(Next, Values, G, _),
    (   Cost + G < Least0
    ->  Least1 is Cost + G,
        least(Ways, Values, Least1, Least, way(Action, Next, Cost), Best)
    ;   least(Ways, Values, Least0, Least, Best0, Best)
    ).

%   A cost above all others. It is no infinity, because SWI-Prolog 7 does not
%   calculate with that. It is so large that adding a cost does not change it.

endless(1.0e300).

%   A state without values has infinite ones.

value(State, Values, G, Rhs) :-
    (   get_assoc(State, Values, value(G1, Rhs1, _))
    ->  G = G1,
        Rhs = Rhs1
    ;   endless(G),
        Rhs = G
    ).

%   Store G and RHS of a state. The search ignores older entries of the state
%   in the heap: only the entry with the key stored here counts.

update(State, G, Rhs, Fixed, Heap0, Heap, Values0, Values) :-
    (   G =:= Rhs
    ->  put_assoc(State, Values0, value(G, Rhs, none), Values),
        Heap = Heap0
    ;   key(State, G, Rhs, Fixed, Key),
        put_assoc(State, Values0, value(G, Rhs, Key), Values),
        (   get_assoc(State, Values0, value(_, _, Key0)),
            Key0 == Key
        ->  Heap = Heap0
        ;   add_to_heap(Heap0, Key, State, Heap)
        )
    ).

key(State, G, Rhs, fixed(Space, Start, _, Km), k(K1, K2)) :-
    space_estimate(Space, Start, [State], H),
    K2 is min(G, Rhs),
    K1 is K2 + H + Km.

%   Expand until no state in the heap can improve the path from the start.

improve(Expanded0, Expanded, Fixed, Heap0, Heap, Values0, Values) :-
    top(Heap0, Values0, Key, State, Heap1),
    Fixed = fixed(_, Start, _, _),
    value(Start, Values0, StartG, StartRhs),
    key(Start, StartG, StartRhs, Fixed, StartKey),
    (   Key @< StartKey
    ->  true
    ;   StartRhs > StartG
    ),
    !,
    get_from_heap(Heap1, _, _, Heap2),
    value(State, Values0, G, Rhs),
    key(State, G, Rhs, Fixed, NewKey),
    (   Key @< NewKey
    ->  put_assoc(State, Values0, value(G, Rhs, NewKey), Values1),
        add_to_heap(Heap2, NewKey, State, Heap3),
        Expanded1 = Expanded0
    ;   Expanded1 is Expanded0 + 1,
        expand(State, G, Rhs, Fixed, Heap2, Heap3, Values0, Values1)
    ),
    improve(Expanded1, Expanded, Fixed, Heap3, Heap, Values1, Values).
improve(Expanded, Expanded, _, Heap, Heap, Values, Values).

%   The first entry that counts, and the heap after it.

top(Heap0, Values, Key, State, Heap) :-
    min_of_heap(Heap0, Key0, State0),
    (   get_assoc(State0, Values, value(_, _, Key1)),
        Key1 == Key0
    ->  Key = Key0,
        State = State0,
        Heap = Heap0
    ;   get_from_heap(Heap0, _, _, Heap1),
        top(Heap1, Values, Key, State, Heap)
    ).

%   Update a state whose cost to the goal fell or rose.

expand(State, G, Rhs, Fixed, Heap0, Heap, Values0, Values) :-
    Fixed = fixed(Space, _, _, _),
    space_previous(Space, State, Previous),
    (   G > Rhs
    ->  put_assoc(State, Values0, value(Rhs, Rhs, none), Values1),
        lower(Previous, Rhs, Fixed, Heap0, Heap, Values1, Values)
    ;   endless(Inf),
        put_assoc(State, Values0, value(Inf, Rhs, none), Values1),
        rate(State, Fixed, Heap0, Heap1, Values1, Values2),
        raise(Previous, G, Fixed, Heap1, Heap, Values2, Values)
    ).

lower([], _, _, Heap, Heap, Values, Values).
lower([way(_, State, Cost)|Ways], G, Fixed, Heap0, Heap, Values0, Values) :-
    value(State, Values0, StateG, Rhs0),
    (   Cost + G < Rhs0
    ->  Rhs is Cost + G,
        update(State, StateG, Rhs, Fixed, Heap0, Heap1, Values0, Values1)
    ;   Heap1 = Heap0,
        Values1 = Values0
    ),
    lower(Ways, G, Fixed, Heap1, Heap, Values1, Values).

%   Only states whose best action led here need another one.

raise([], _, _, Heap, Heap, Values, Values).
raise([way(_, State, Cost)|Ways], G, Fixed, Heap0, Heap, Values0, Values) :-
    value(State, Values0, _, Rhs),
    (   Rhs =:= Cost + G
    ->  rate(State, Fixed, Heap0, Heap1, Values0, Values1)
    ;   Heap1 = Heap0,
        Values1 = Values0
    ),
    raise(Ways, G, Fixed, Heap1, Heap, Values1, Values).

descend(State, fixed(_, _, Goals, _), _, []) :-
    get_assoc(State, Goals, _),
    !.
descend(State, Fixed, Values, [step(Action, Cost)|Path]) :-
    Fixed = fixed(Space, _, _, _),
    space_ways(Space, State, Ways),
    endless(Inf),
    least(Ways, Values, Inf, _, none, way(Action, Next, Cost)),
    descend(Next, Fixed, Values, Path).
