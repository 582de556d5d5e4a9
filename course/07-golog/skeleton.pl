% A waiter in Golog. The buttons up, right and left call it to the tables.

:- use_module(library(ev3dev)).
:- use_module(library(ev3dev/drive)).
:- use_module(library(ev3dev/golog)).

start :-
    set_robot(5.6, 10.6, outB, outC),
    set_pose(100, 100, 0),
    golog(waiter, []).

% The domain: three tables, and a robot that is at one of them or at home.

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

initially(at, home).
initially(waits(_), false).

% What actions need, and what they change. serve/1 is missing.

poss(go(_), true).

causes_val(go(P), at, P, true).
causes_true(call(T), waits(T), true).

% The program. What must come before the robot waits?

proc(waiter,
     prioritized_interrupts(
         [ interrupt(true, wait) ])).

% The robot: how it does it.

robot_action(go(P), go_to(Place)) :-
    place(P, Place).
robot_action(serve(T), say(T, [wait(true)])).

robot_exog(call(T), button(T)) :-
    domain(T, table).
