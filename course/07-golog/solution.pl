% A waiter in Golog. The buttons up, right and left call it to the tables.

:- use_module(library(ev3dev)).
:- use_module(library(ev3dev/drive)).
:- use_module(library(ev3dev/golog)).

start :-
    set_robot(5.6, 10.6, outB, outC),
    set_pose(100, 100, 0),
    golog(waiter, []).

% What there is: three tables, and a robot that is at one of them or at home.

place(up, 100-160).
place(right, 160-100).
place(left, 40-100).
place(home, 100-100).

table([up, right, left]).

prim_action(go(P)) :-
    place(P, _).
prim_action(serve(T)) :-
    domain(T, table).
exog_action(call(T)) :-
    domain(T, table).

prim_fluent(at).
rel_fluent(waits(T)) :-
    domain(T, table).

prim_fluent(calls).
prim_fluent(call_of(T)) :-
    domain(T, table).

initially(at, home).
initially(waits(_), false).
initially(calls, 0).
initially(call_of(_), 0).

% What actions need, and what they change.

poss(go(P), neg(at = P)).
poss(serve(T), and(at = T, waits(T))).

causes_val(go(P), at, P, true).
causes_true(call(T), waits(T), true).
causes_val(call(_), calls, N, N is calls+1).
causes_val(call(T), call_of(T), N, N is calls+1).
causes_false(serve(T), waits(T), true).

% The program: serve where somebody waits, then go where somebody has waited
% longest, and home when nobody waits.

proc(waiter,
     prioritized_interrupts(
         [ interrupt(some((t, table), and(at = t, waits(t))),
                     serve_here),
           interrupt(some((t, table), waits(t)), serve_next),
           interrupt(neg(at = home), go(home)),
           interrupt(true, wait) ])).

proc(serve_here, pi((t, table), [?(at = t), serve(t)])).
proc(serve_next, pi((t, table), [?(is_next(t)), go(t)])).

proc(is_next(T), and(waits(T),
                     all((u, table),
                         impl(waits(u), call_of(T) =< call_of(u))))).

% The robot: how it does it.

robot_action(go(P), go_to(Place)) :-
    place(P, Place).
robot_action(serve(T), say(T, [wait(true)])).

robot_exog(call(T), button(T)) :-
    domain(T, table).
