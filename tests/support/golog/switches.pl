:- module(golog_switches, []).
:- use_module(library(ev3dev/golog)).

/** <module> A domain of few states and endless histories

Six switches. Actions `a`, `b` and `c` change nothing.
*/

switch([1, 2, 3, 4, 5, 6]).


prim_action(flip(K)) :- switch(Ks), member(K, Ks).
prim_action(a).
prim_action(b).
prim_action(c).

rel_fluent(on(K)) :- switch(Ks), member(K, Ks).

initially(on(K), false) :- switch(Ks), member(K, Ks).

poss(_, true).

causes_true(flip(K), on(K), neg(on(K))).
causes_false(flip(K), on(K), on(K)).

proc(any, pi((k, switch), flip(k))).

%   No end, in more steps than a search takes before it looks for states it knows.

proc(long(E), ndet([?(between(1, 600, _)), ?(false)], E)).
