:- module(golog_lab, [executed/1]).
:- use_module(library(ev3dev/golog)).

/** <module> A domain for the tests of library(ev3dev/golog)
*/

:- dynamic
    done_action/1,
    next_exog/1,
    sensed_value/2.

prim_action(a).
prim_action(b).
prim_action(c).
prim_action(up).
prim_action(down).
prim_action(never).
prim_action(start).
prim_action(off(N)) :- number_of_light(N).
prim_action(set_to(_)).
prim_action(go(_)).
prim_action(paint(_, _)).
prim_action(all_off).
prim_action(wipe).
prim_action(look).
prim_action(look_twice).
prim_action(feel).
prim_action(lose).
prim_action(breaks).

exog_action(call(N)) :- number_of_light(N).
exog_action(ring).
exog_action(quiet).

number_of_light(N) :- between(1, 3, N).

room([hall, lab]).
direction(left).
direction(right).
digit(D) :- between(0, 9, D).

poss(a, true).
poss(b, true).
poss(c, true).
poss(up, n < 3).
poss(down, n > 0).
poss(never, false).
poss(start, true).
poss(off(N), light(N) = on).
poss(set_to(_), true).
poss(go(P), neg(at(P))).
poss(paint(_, _), true).
poss(all_off, true).
poss(wipe, true).
poss(look, true).
poss(look_twice, true).
poss(feel, true).
poss(lose, true).
poss(breaks, true).

prim_fluent(n).
prim_fluent(light(N)) :- number_of_light(N).
prim_fluent(color(_)).
prim_fluent(weather).
prim_fluent(wind).
prim_fluent(list).
rel_fluent(at(P)) :- member(P, [hall, lab, yard]).
rel_fluent(ringing).
rel_fluent(warm).
fun_fluent(last).

initially(n, 0).
initially(light(1), on).
initially(light(2), off).
initially(light(3), on).
initially(color(_), white).
initially(at(hall), true).
initially(at(lab), false).
initially(at(yard), false).
initially(ringing, false).
initially(last, none).
initially(list, [1, 2]).

causes_val(up, n, N, N is n+1).
causes_val(down, n, N, N is n-1).
causes_val(set_to(X), n, X, true).
causes_val(off(N), light(N), off, true).
causes_val(call(N), light(N), on, true).
causes_val(all_off, light(_), off, true).
causes_val(paint(What, Color), color(Thing), Color, What = Thing).
causes_val(wipe, color(Thing), clean, neg(Thing = wall)).
causes_val(go(P), last, P, true).
causes_true(go(P), at(P), true).
causes_false(go(P), at(Q), neg(P = Q)).
causes_true(ring, ringing, true).
causes_false(quiet, ringing, true).

senses(look, weather).
senses(look_twice, weather).
senses(look_twice, wind).
senses(feel, Degrees, warm, true, Degrees > 20).
senses(feel, Degrees, warm, false, Degrees =< 20).
forget(lose, weather).

proc(two, n = 2).
proc(lit(N), light(N) = on).
proc(lit(9), n = 5).
proc(both, [a, b]).
proc(either(X), X).
proc(either(_), c).
proc(shut, pi(x, [?(lit(x)), off(x)])).
proc(shut(N), pi(x, [?(x = N), go(x)])).
proc(count(N), if(n < N, [up, count(N)], [])).
proc(broken, [a, fly(1)]).
proc(outer(V), pi(hall, [?(hall = 7), set_to(V)])).

execute(A, Value) :-
    assertz(done_action(A)),
    A \== breaks,
    (   sensed_value(A, Value)
    ->  true
    ;   true
    ).

exog_occurs(A) :-
    retract(next_exog(A)),
    !.

%   The actions that were executed since this was asked last

executed(As) :-
    findall(A, retract(done_action(A)), As).
