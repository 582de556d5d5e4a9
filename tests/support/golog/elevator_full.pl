% An elevator in the dialect of full IndiGolog: relational and functional
% fluents, sorts, devices, codes that are translated, sensing. No interpreter is
% loaded here.

:- dynamic executed/2, controller/1.

cache(_) :- fail.

story([1, 2, 3, 4, 5, 6]).

fun_fluent(cabin).
causes_val(up, cabin, N, N is cabin+1).
causes_val(down, cabin, N, N is cabin-1).

rel_fluent(open).
causes_true(open_door, open, true).
causes_false(shut_door, open, true).

rel_fluent(called(_)).
causes_true(press(N), called(N), true).
causes_false(serve(N), called(N), true).

rel_fluent(new_call).
causes_true(press(N), new_call, neg(called(N))).

fun_fluent(load).
senses(weigh, load).
forget(open_door, load).

rel_fluent(smoke).
causes_true(fire, smoke, true).
causes_false(clear, smoke, true).

prim_action(up).
prim_action(down).
prim_action(open_door).
prim_action(shut_door).
prim_action(serve(N)) :- domain(N, story).
prim_action(weigh).
prim_action(ring).

poss(up, and(neg(open), cabin < 6)).
poss(down, and(neg(open), cabin > 1)).
poss(open_door, neg(open)).
poss(shut_door, open).
poss(serve(N), and(cabin = N, called(N))).
poss(weigh, true).
poss(ring, true).

exog_action(press(N)) :- domain(N, story).
exog_action(fire).
exog_action(clear).
prim_action(A) :- exog_action(A).
poss(A, true) :- exog_action(A).

initially(cabin, 2).
initially(open, false).
initially(called(N), true) :- member(N, [1, 5]).
initially(called(N), false) :- domain(N, story), \+ member(N, [1, 5]).
initially(new_call, false).
initially(smoke, false).

proc(go_to(N), [ if(open, shut_door, []),
                 while(neg(cabin = N), if(cabin < N, up, down)) ]).
proc(stop_at(N), [go_to(N), open_door, serve(N), shut_door]).
proc(any_call, some(n, called(n))).
proc(within(Left),
     ndet(?(neg(any_call)),
          pi((n, story),
             [ ?(and(called(n), Left >= abs(cabin-n))),
               pi(m, [ ?(m is Left - abs(cabin-n)), stop_at(n),
                       within(m) ]) ]))).
proc(from(Left), ndet(within(Left), pi(m, [?(m is Left+1), from(m)]))).

proc(main, mainControl(N)) :- controller(N), !.
proc(main, mainControl(1)).

proc(mainControl(1), [while(any_call, pi(n, [?(called(n)), stop_at(n)])),
                      go_to(1)]).
proc(mainControl(2), search(from(0), ["from ", cabin])).
proc(mainControl(3),
     prioritized_interrupts(
         [ interrupt(smoke, [ring, wait]),
           interrupt(any_call,
                     [ unset(new_call),
                       gexec(neg(new_call), search(from(0))) ]),
           interrupt(cabin > 1, down),
           interrupt(neg(know(load)), weigh),
           interrupt(load > 100, ring) ])).

how_to_execute(weigh, scales, sample) :- !.
how_to_execute(Action, cabin, do(Action)).
translate_exog(button(N), press(N)) :- integer(N).
translate_exog(smoke_sensor(1), fire).
translate_exog(smoke_sensor(0), clear).
translate_sensing(weigh, grams(G), Kilos) :- Kilos is G // 1000.

do(Action) :-
    assertz(executed(cabin, Action)).

sample(grams(64000)) :-
    assertz(executed(scales, sample)).

load_devices([cabin, scales]).
em_address(localhost, 8000).
:- set_option(log_level, 2).
:- set_option(wait_step, 0).
