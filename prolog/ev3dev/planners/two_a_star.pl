:- module(ev3dev_two_a_star,
          [ two_a_star/5                % +Space, +Start, +Goals, -Path,
                                        % -Expanded
          ]).
:- use_module(library(assoc),
              [ empty_assoc/1, get_assoc/3, list_to_assoc/2, put_assoc/4 ]).
:- use_module(library(heaps),
              [ add_to_heap/4, empty_heap/1, get_from_heap/4, heap_size/2 ]).
:- use_module(library(lists), [append/3, member/2, reverse/2]).
:- use_module(space).

/** <module> A* from both ends

The first path on which both searches meet need not be the best one. This is
the algorithm NBA* (Pijls, Post: Yet another bidirectional algorithm for
finding the shortest path, 2009): only one side expands a state, and no side
expands it if no path through it can be cheaper than the best known path. When
one side has no state left to expand, the best known path is optimal. The
heuristic must be consistent.
*/

%!  two_a_star(+Space, +Start, +Goals, -Path, -Expanded) is det.
%
%   True if Path is the list of `step(Action, Cost)` that lead from Start to
%   one of Goals, or `none`. Expanded is the number of expanded states.

two_a_star(Space, Start, Goals, Path, Expanded) :-
    needs_way_back(Space),
    Search = search(Space, Start, Goals),
    new_side(ahead, [Start], Search, Ahead),
    new_side(back, Goals, Search, Back),
    empty_assoc(Closed),
    (   member(Start, Goals)
    ->  Best = best(0, Start)
    ;   Best = best(none, none)
    ),
    search(Ahead, Back, Closed, Best, Search, 0, Path, Expanded).

%   A side: its direction, its heap, how it reached states, and the least F in
%   its heap.

new_side(Direction, Ends0, Search, side(Direction, Heap, Reached, F)) :-
    sort(Ends0, Ends),
    findall(End-reached(0, none), member(End, Ends), Pairs),
    list_to_assoc(Pairs, Reached),
    empty_heap(Heap0),
    push_ends(Ends, Direction, Search, Heap0, Heap),
    (   get_from_heap(Heap, F-_, _, _)
    ->  true
    ;   F = 0
    ).

push_ends([], _, _, Heap, Heap).
push_ends([End|Ends], Direction, Search, Heap0, Heap) :-
    push(End, 0, Direction, Search, Heap0, Heap1),
    push_ends(Ends, Direction, Search, Heap1, Heap).

push(State, G, Direction, Search, Heap0, Heap) :-
    to_go(Direction, Search, State, H),
    F is G + H,
    Last is -G,
    add_to_heap(Heap0, F-Last, State-G, Heap).

%   The estimated cost from a state to the other end, for each side.

to_go(ahead, search(Space, _, Goals), State, H) :-
    space_estimate(Space, State, Goals, H).
to_go(back, search(Space, Start, _), State, H) :-
    space_estimate(Space, Start, [State], H).

search(Ahead, Back, Closed, Best, Search, Expanded0, Path, Expanded) :-
    Ahead = side(_, HeapA, _, _),
    Back = side(_, HeapB, _, _),
    heap_size(HeapA, SizeA),
    heap_size(HeapB, SizeB),
    (   SizeA =< SizeB
    ->  next(Ahead, Back, Closed, Best, Search, Expanded0, Path, Expanded)
    ;   next(Back, Ahead, Closed, Best, Search, Expanded0, Path, Expanded)
    ).

next(Side0, Other, Closed0, Best0, Search, Expanded0, Path, Expanded) :-
    Side0 = side(Direction, Heap0, Reached0, _),
    Best0 = best(Least, _),
    (   next_open(Heap0, Closed0, Reached0, F, State, G, Heap1),
        cheaper(F, Least)
    ->  put_assoc(State, Closed0, closed, Closed),
        (   hopeless(State, G, Other, Search, Least)
        ->  search_on(side(Direction, Heap1, Reached0, F), Other, Closed,
                      Best0, Search, Expanded0, Path, Expanded)
        ;   Expanded1 is Expanded0 + 1,
            Search = search(Space, _, _),
            expand(Direction, Space, State, Ways),
            reach(Ways, State, G, Direction, Other, Closed, Search,
                  Heap1, Heap, Reached0, Reached, Best0, Best),
            search_on(side(Direction, Heap, Reached, F), Other, Closed, Best,
                      Search, Expanded1, Path, Expanded)
        )
    ;   finish(Best0, Side0, Other, Path),
        Expanded = Expanded0
    ).

%   The open state with the least F.

next_open(Heap0, Closed, Reached, F, State, G, Heap) :-
    get_from_heap(Heap0, F1-_, State1-G1, Heap1),
    (   get_assoc(State1, Reached, reached(Best, _)),
        G1 =:= Best,
        \+ get_assoc(State1, Closed, _)
    ->  F = F1,
        State = State1,
        G = G1,
        Heap = Heap1
    ;   next_open(Heap1, Closed, Reached, F, State, G, Heap)
    ).

%   No path through this state and the open states of the other side is
%   cheaper than the best known path.

hopeless(State, G, side(Other, _, _, FOther), Search, Least) :-
    to_go(Other, Search, State, HOther),
    Least \== none,
    G + FOther - HOther >= Least.

search_on(Side, Other, Closed, Best, Search, Expanded0, Path, Expanded) :-
    Side = side(ahead, _, _, _),
    !,
    search(Side, Other, Closed, Best, Search, Expanded0, Path, Expanded).
search_on(Side, Other, Closed, Best, Search, Expanded0, Path, Expanded) :-
    search(Other, Side, Closed, Best, Search, Expanded0, Path, Expanded).

expand(ahead, Space, State, Ways) :-
    space_next(Space, State, Ways).
expand(back, Space, State, Ways) :-
    space_previous(Space, State, Ways).

reach([], _From, _G, _Direction, _Other, _Closed, _Search, Heap, Heap,
      Reached, Reached, Best, Best).
reach([way(Action, State, Cost)|Ways], From, G0, Direction, Other, Closed,
      Search, Heap0, Heap, Reached0, Reached, Best0, Best) :-
    G is G0 + Cost,
    (   get_assoc(State, Closed, _)
    ->  reach(Ways, From, G0, Direction, Other, Closed, Search,
              Heap0, Heap, Reached0, Reached, Best0, Best)
    ;   get_assoc(State, Reached0, reached(Known, _)),
        Known =< G
    ->  reach(Ways, From, G0, Direction, Other, Closed, Search,
              Heap0, Heap, Reached0, Reached, Best0, Best)
    ;   put_assoc(State, Reached0, reached(G, from(From, Action, Cost)),
                  Reached1),
        push(State, G, Direction, Search, Heap0, Heap1),
        meet(State, G, Other, Best0, Best1),
        reach(Ways, From, G0, Direction, Other, Closed, Search,
              Heap1, Heap, Reached1, Reached, Best1, Best)
    ).

meet(State, G, side(_, _, Reached, _), best(Least, Met), Best) :-
    (   get_assoc(State, Reached, reached(GOther, _)),
        Sum is G + GOther,
        cheaper(Sum, Least)
    ->  Best = best(Sum, State)
    ;   Best = best(Least, Met)
    ).

%   Least is `none` until the search knows a path.

cheaper(_, none) :-
    !.
cheaper(Cost, Least) :-
    Cost < Least.

finish(best(none, _), _, _, none) :-
    !.
finish(best(_, State), SideA, SideB, Path) :-
    (   SideA = side(ahead, _, ReachedA, _)
    ->  SideB = side(_, _, ReachedB, _)
    ;   SideA = side(_, _, ReachedB, _),
        SideB = side(_, _, ReachedA, _)
    ),
    way(State, ReachedA, [], Ahead),
    way(State, ReachedB, [], Back),
    reverse(Back, Rest),
    append(Ahead, Rest, Path).

way(State, Reached, Path0, Path) :-
    get_assoc(State, Reached, reached(_, From)),
    (   From = from(Before, Action, Cost)
    ->  way(Before, Reached, [step(Action, Cost)|Path0], Path)
    ;   Path = Path0
    ).
