% A delivery robot in the dialect of Legolog: actions have numbers, and the world
% is reached by the predicates of its lower boundary. No interpreter is loaded
% here.

:- dynamic told/1.

prim_action(turn_back).
prim_action(leave).
prim_action(honk).

exog_action(reached).
exog_action(lost).
exog_action(loaded).
exog_action(order(_, _)).
exog_action(cancel(_, _)).

station(N) :- N = 1 ; N = 2 ; N = 3 ; N = 4.

prim_fluent(place).
prim_fluent(heading).
prim_fluent(state).
prim_fluent(ordered(N)) :- station(N).
prim_fluent(carries(N)) :- station(N).

senses(_, _) :- fail.

causes_val(turn_back, heading, D, D is (-1)*heading).
causes_val(leave, state, moves, true).
causes_val(reached, state, rests, true).
causes_val(lost, state, astray, true).
causes_val(reached, place, N, N is place + heading).
causes_val(order(N, M), ordered(N), M, true).
causes_val(cancel(N, _), ordered(N), 0, true).
causes_val(loaded, carries(N), 0, place = N).
causes_val(loaded, carries(M), 1, ordered(place) = M).
causes_val(loaded, ordered(N), 0, place = N).

poss(turn_back, state = rests).
poss(honk, true).
poss(leave, and(state = rests,
                or(and(heading = 1, place < 4),
                   and(heading = (-1), place > 1)))).

initially(place, 2).
initially(heading, 1).
initially(state, rests).
initially(ordered(_), 0).
initially(carries(_), 0).

proc(has_work(N), or(some(m, and(ordered(N) = m, station(m))), carries(N) = 1)).
proc(towards(D), if(heading = D, leave, turn_back)).
proc(find_way, ?(put_back(place, heading))).

proc(control,
     prioritized_interrupts(
         [ interrupt(state = astray, [find_way, leave]),
           interrupt(state = moves, wait),
           interrupt(has_work(place), [honk, wait]),
           interrupt(n, has_work(n),
                     if(place < n, towards(1), towards(-1))),
           interrupt(place > 1, towards(-1)),
           interrupt(true, wait) ])).

put_back(Place, Heading) :-
    assertz(told(put_back(Place, Heading))),
    golog_exog(reached).

initialize :- initializeRcx, initializeExog.
finalize :- finalizeRcx, finalizeExog.

execute(Action, _, Value) :-
    actionNum(Action, Number),
    sendRcxActionNumber(Number, Value).
execute(Action, History, Value) :-
    \+ actionNum(Action, _),
    has_val(place, Value, History).

exog_occurs(Actions) :-
    from_rcx(Actions1),
    checkOtherExog(Actions2),
    append(Actions1, Actions2, Actions).

from_rcx([Action]) :-
    receiveRcxActionNumber([Number]),
    actionNum(Action, Number),
    !.
from_rcx([]).

actionNum(turn_back, 0).
actionNum(honk, 1).
actionNum(leave, 2).
actionNum(reached, 3).
actionNum(lost, 4).
actionNum(loaded, 5).
