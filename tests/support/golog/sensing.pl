:- module(golog_sensing, [world/1, in_world/2]).
:- use_module(library(ev3dev/golog)).

/** <module> A domain with sensing, for the tests of conditional plans

A world is what the sensing actions will find.
*/

:- dynamic current_world/1.

world(world(Light, Door, Distance)) :-
    member(Light, [red, green, off]),
    member(Door, [true, false]),
    member(Distance, [5, 15, 25]).

%   Call Goal, with a world to sense.

:- meta_predicate in_world(+, 0).

in_world(World, Goal) :-
    setup_call_cleanup(
        assertz(current_world(World)),
        call(Goal),
        retractall(current_world(_))).

prim_action(look).
prim_action(feel).
prim_action(measure).
prim_action(a).
prim_action(b).
prim_action(push).
prim_action(go).

poss(look, true).
poss(feel, true).
poss(measure, true).
poss(a, light = red).
poss(b, neg(light = red)).
poss(push, and(felt, neg(door))).
poss(go, or(door, n < 2)).

prim_fluent(light).
prim_fluent(distance).
prim_fluent(n).
rel_fluent(door).
rel_fluent(felt).

initially(n, 0).
initially(distance, 0).
initially(felt, false).

senses(look, light).
senses(feel, door).
senses(measure, distance).

%   No sensed_values/2 for the distance
sensed_values(light, [red, green, off]).

causes_val(go, n, N, N is n+1).
causes_val(a, n, 0, distance > 20).
causes_true(push, door, true).
causes_true(feel, felt, true).

execute(look, Light) :- current_world(world(Light, _, _)), !.
execute(feel, Door) :- current_world(world(_, Door, _)), !.
execute(measure, Distance) :- current_world(world(_, _, Distance)), !.
execute(_, _).
