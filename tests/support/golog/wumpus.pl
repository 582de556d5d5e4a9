% The cave of the wumpus in the vocabulary of full IndiGolog, with one initial
% situation: the agent keeps what it has inferred in fluents of its own. A cave
% is a list of facts of the world, which only the device asks. No interpreter is
% loaded here.

:- dynamic in_cave/1, executed/1, stands/1, controller/1.

cache(_) :- fail.

gridsize(4).
gridindex(V) :- gridsize(S), get_integer(1, V, S).
location(loc(X, Y)) :- gridindex(X), gridindex(Y).
direction([up, right, down, left]).

adjacent(loc(X, Y), loc(X, Y1), up) :- Y1 is Y+1, location(loc(X, Y1)).
adjacent(loc(X, Y), loc(X1, Y), right) :- X1 is X+1, location(loc(X1, Y)).
adjacent(loc(X, Y), loc(X, Y1), down) :- Y1 is Y-1, location(loc(X, Y1)).
adjacent(loc(X, Y), loc(X1, Y), left) :- X1 is X-1, location(loc(X1, Y)).
adjacent(A, B) :- adjacent(A, B, _).

clockwise(up, right).
clockwise(right, down).
clockwise(down, left).
clockwise(left, up).

% What is done and when

prim_action(turn).
prim_action(forward).
prim_action(smell).
prim_action(feel_draft).
prim_action(look).
prim_action(take).
prim_action(shoot).
prim_action(climb).
exog_action(scream).

poss(turn, inside).
poss(forward, and(inside, some(l, adjacent(at, l, facing)))).
poss(smell, inside).
poss(feel_draft, inside).
poss(look, inside).
poss(take, and(inside, gold(at))).
poss(shoot, arrows > 0).
poss(climb, and(inside, at = loc(1, 1))).

fun_fluent(at).
causes_val(forward, at, L, adjacent(at, L, facing)).
fun_fluent(facing).
causes_val(turn, facing, D, clockwise(facing, D)).
fun_fluent(arrows).
causes_val(shoot, arrows, N, N is arrows-1).
fun_fluent(nuggets).
causes_val(take, nuggets, N, N is nuggets+1).
rel_fluent(inside).
causes_false(climb, inside, true).
rel_fluent(alive).
causes_false(scream, alive, true).
rel_fluent(visited(L)) :- location(L).
causes_true(forward, visited(L), adjacent(at, L, facing)).
rel_fluent(gold(L)) :- location(L).
senses(look, 1, gold(L), true, L = at).
senses(look, 0, gold(L), false, L = at).
causes_false(take, gold(L), L = at).

% What an agent that is careful takes for granted

rel_fluent(no_pit(L)) :- location(L).
senses(feel_draft, 0, no_pit(L), true, or(L = at, adjacent(at, L))).
rel_fluent(no_wumpus(L)) :- location(L).
senses(smell, 0, no_wumpus(L), true, or(L = at, adjacent(at, L))).
senses(smell, 1, no_wumpus(L), true, L = at).
senses(smell, 1, no_wumpus(L), true,
       and(location(L), and(neg(L = at), neg(adjacent(at, L))))).
causes_true(scream, no_wumpus(L), location(L)).

proc(safe(L), and(no_pit(L), no_wumpus(L))).
proc(suspect(L), and(location(L), and(alive, neg(no_wumpus(L))))).
proc(known_wumpus(L), and(suspect(L),
                          neg(some(m, and(suspect(m), neg(m = L)))))).

initially(at, loc(1, 1)).
initially(facing, right).
initially(arrows, 1).
initially(nuggets, 0).
initially(inside, true).
initially(alive, true).
initially(visited(L), V) :- location(L), ( L = loc(1, 1) -> V = true
                                         ; V = false ).
initially(gold(L), false) :- location(L).
initially(no_pit(L), V) :- location(L), ( L = loc(1, 1) -> V = true
                                        ; V = false ).
initially(no_wumpus(L), V) :- location(L), ( L = loc(1, 1) -> V = true
                                           ; V = false ).

% The agent

proc(main, mainControl(N)) :- controller(N), !.
proc(main, mainControl(1)).

proc(mainControl(1),
     prioritized_interrupts(
         [ interrupt(gold(at), take),
           interrupt([dir, w], and(arrows > 0, and(known_wumpus(w),
                                       in_line(at, dir, w))),
                     [face(dir), shoot]),
           interrupt(inside,
                     if(nuggets > 0, leave,
                        [ smell, feel_draft, look,
                          if(gold(at), [], wndet(explore, leave)) ])) ])).

proc(face(D), search([star(turn, 4), ?(facing = D)])).
proc(step(D), [face(D), forward]).
proc(leave, [go_to(loc(1, 1)), climb]).
proc(go_to(L), search([?(pathfind(at, L, Way)), Way], ["to ", L])).

% The nearest safe place that is new
proc(explore, search(pi((n, gridindex0), explore_at(n)), "explore")).
proc(explore_at(N),
     pi((l, location),
        [ ?(and(visited(l), distance(at, l, N))),
          pi((m, location),
             [ ?(and(adjacent(l, m), and(neg(visited(m)), safe(m)))),
               ?(pathfind(at, l, Way)), Way,
               pi((d, direction), [?(adjacent(l, m, d)), step(d)]) ]) ])).

gridindex0(N) :- gridsize(S), Max is 2*S, get_integer(0, N, Max).
distance(loc(X, Y), loc(X1, Y1), N) :- N =:= abs(X-X1) + abs(Y-Y1).
in_line(A, D, B) :- adjacent(A, C, D), ( B = C ; in_line(C, D, B) ).

pathfind_move(From, To, step(D)) :-
    adjacent(From, To, D),
    now(H),
    holds(visited(To), H).
pathfind_heuristic(loc(X, Y), loc(X1, Y1), N) :-
    N is abs(X-X1) + abs(Y-Y1).

% The device: a cave with pit(L), wumpus(L), gold(L)

how_to_execute(Action, cave, Action).
actionNum(X, X).

cave(smell, Value) :-
    !,
    assertz(executed(smell)),
    now(H), has_val(at, L, H),
    (   in_cave(wumpus(W)), ( W = L ; adjacent(L, W) )
    ->  Value = 1
    ;   Value = 0
    ).
cave(feel_draft, Value) :-
    !,
    assertz(executed(feel_draft)),
    now(H), has_val(at, L, H),
    (   in_cave(pit(P)), adjacent(L, P)
    ->  Value = 1
    ;   Value = 0
    ).
cave(look, Value) :-
    !,
    assertz(executed(look)),
    now(H), has_val(at, L, H),
    (   in_cave(gold(L))
    ->  Value = 1
    ;   Value = 0
    ).
cave(shoot, _) :-
    !,
    assertz(executed(shoot)),
    now(H), has_val(at, L, H), has_val(facing, D, H),
    (   in_cave(wumpus(W)), in_line(L, D, W)
    ->  golog_exog(scream)
    ;   true
    ).
cave(Action, _) :-
    assertz(executed(Action)).
