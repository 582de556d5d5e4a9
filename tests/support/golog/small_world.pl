:- module(golog_small_world, []).
:- use_module(library(ev3dev/golog)).

/** <module> A domain in which every program comes to an end

No history has more than four actions.
*/

prim_action(a).
prim_action(b).
prim_action(c).
prim_action(put(X)) :- number_of(X).

number_of(X) :- member(X, [1, 2, 3]).

prim_fluent(n).
prim_fluent(x).
prim_fluent(light(K)) :- number_of(K).
rel_fluent(odd).

initially(n, 0).
initially(x, 1).
initially(light(_), off).
initially(odd, false).

poss(a, n < 4).
poss(b, and(n < 4, x > 1)).
poss(c, and(n < 4, neg(light(2) = on))).
poss(put(X), and(n < 4, neg(x = X))).

causes_val(_, n, N, N is n+1).
causes_val(put(X), x, X, true).
causes_val(a, light(K), on, and(x = K, light(K) = off)).
causes_val(a, light(K), off, and(x = K, light(K) = on)).
causes_val(b, x, V, V is x-1).
causes_true(c, odd, neg(odd)).
causes_false(c, odd, odd).

proc(ab, [a, b]).
proc(down(N), if(x > N, b, put(3))).
proc(again(N), ndet(?(n >= N), [ndet(a, c), again(N)])).
proc(lit, or(x = 1, light(1) = on)).
