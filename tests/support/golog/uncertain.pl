:- module(golog_uncertain,
          [ possible_world/1,           % ?World
            world_after/3,              % +Entry, +World0, -World
            outcome/3,                  % +Action, +World, -Outcome
            is_so/2                     % +Condition, +World
          ]).
:- use_module(library(ev3dev/golog)).

/** <module> A domain with possible values, and the worlds that it is about

Three boxes may be full, and a counter may be at three places. A world says
which is so; it knows nothing of library(ev3dev/golog).
*/

prim_action(peek(B)) :- box(B).
prim_action(listen).
prim_action(step).
prim_action(sweep).
prim_action(fill(B)) :- box(B).
prim_action(turn).

box(B) :- member(B, [a, b, c]).

poss(peek(_), true).
poss(listen, true).
poss(step, true).
poss(sweep, true).
poss(fill(B), neg(full(B))).
poss(turn, true).

prim_fluent(place).
rel_fluent(full(B)) :- box(B).
rel_fluent(up).

initially(place, P) :- member(P, [1, 2, 3]).
initially(full(B), V) :- box(B), member(V, [true, false]).
initially(up, false).

settles(peek(B), 1, full(B), true, true).
settles(peek(B), 0, full(B), false, true).
rejects(listen, low, place, P, P > 2).
rejects(listen, high, place, P, P =< 2).

causes(step, place, P, P is place+1).
causes_false(sweep, full(B), near(place, B)).
causes_true(fill(B), full(B), true).
causes_true(turn, up, neg(up)).
causes_false(turn, up, up).

near(1, a).
near(2, b).
near(3, c).

proc(sure(B), or(full(B), up)).

robot_sense(peek(B), V, reality(peek(B), V)).
robot_sense(listen, V, reality(listen, V)).
robot_action(_, true).

:- dynamic real/1.

reality(A, V) :-
    real(World),
    outcome(A, World, V).

%   World is w(Place, Full, Up).

possible_world(w(Place, Full, false)) :-
    member(Place, [1, 2, 3]),
    member(Full, [[], [a], [b], [c], [a, b], [a, c], [b, c], [a, b, c]]).

world_after(step, w(P0, Full, Up), w(P, Full, Up)) :-
    P is P0+1.
world_after(sweep, w(P, Full0, Up), w(P, Full, Up)) :-
    (   near(P, B)
    ->  subtract(Full0, [B], Full)
    ;   Full = Full0
    ).
world_after(fill(B), w(P, Full, Up), w(P, [B|Full], Up)).
world_after(turn, w(P, Full, Up0), w(P, Full, Up)) :-
    ( Up0 == true -> Up = false ; Up = true ).
world_after(peek(_), World, World).
world_after(listen, World, World).

outcome(peek(B), w(_, Full, _), Value) :-
    ( memberchk(B, Full) -> Value = 1 ; Value = 0 ).
outcome(listen, w(P, _, _), Value) :-
    ( P > 2 -> Value = high ; Value = low ).

is_so(and(P, Q), W) :- is_so(P, W), is_so(Q, W).
is_so(or(P, Q), W) :- ( is_so(P, W) -> true ; is_so(Q, W) ).
is_so(neg(P), W) :- \+ is_so(P, W).
is_so(impl(P, Q), W) :- ( \+ is_so(P, W) -> true ; is_so(Q, W) ).
is_so(equiv(P, Q), W) :-
    is_so(impl(P, Q), W),
    is_so(impl(Q, P), W).
is_so((P -> Q ; R), W) :-
    ( is_so(P, W) -> is_so(Q, W) ; is_so(R, W) ).
is_so(some(_, _, full(_)), w(_, Full, _)) :- Full = [_|_].
is_so(all(_, _, full(_)), w(_, Full, _)) :-
    subtract([a, b, c], Full, []).
is_so(full(B), w(_, Full, _)) :- memberchk(B, Full).
is_so(full(B) = true, W) :- is_so(full(B), W).
is_so(full(B) = false, W) :- \+ is_so(full(B), W).
is_so(up, w(_, _, true)).
is_so(sure(B), W) :- is_so(or(full(B), up), W).
is_so(place = P, w(P, _, _)).
is_so(place < P, w(P0, _, _)) :- P0 < P.
is_so(near(place, B), w(P, _, _)) :- near(P, B).
