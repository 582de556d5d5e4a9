% An elevator in the dialect of IndiGolog's plain interpreter. No interpreter is
% loaded here: the file that loads this one does that. The world is that of a
% test: what was executed, and what happens after n actions.

:- dynamic executed/1, happens/2.

execute(Action, _) :-
    assertz(executed(Action)).

exog_occurs(Action) :-
    findall(x, executed(_), Xs),
    length(Xs, Count),
    retract(happens(Count, Action)),
    !.

floor(N) :- between(1, 5, N).

prim_action(move(up)).
prim_action(move(down)).
prim_action(serve(N)) :- floor(N).

exog_action(press(N)) :- floor(N).

prim_fluent(cabin).
prim_fluent(wanted(N)) :- floor(N).

poss(move(up), cabin < 5).
poss(move(down), cabin > 1).
poss(serve(N), and(cabin = N, wanted(N) = yes)).

causes_val(move(up), cabin, N, N is cabin+1).
causes_val(move(down), cabin, N, N is cabin-1).
causes_val(serve(N), wanted(N), no, true).
causes_val(press(N), wanted(N), yes, true).

initially(cabin, 3).
initially(wanted(N), yes) :- member(N, [1, 4]).
initially(wanted(N), no) :- floor(N), \+ member(N, [1, 4]).

proc(go_to(N), while(neg(cabin = N), if(cabin < N, move(up), move(down)))).
proc(all_done, neg(some(n, wanted(n) = yes))).
proc(serve_one, pi(n, [?(wanted(n) = yes), go_to(n), serve(n)])).
proc(control(simple), [while(neg(all_done), serve_one), go_to(1)]).

% At most Left moves; the search finds the first number that is enough.
proc(within(Left),
     ndet([?(all_done), go_to(1)],
          pi([n, m],
             [ ?(wanted(n) = yes), ?(m is Left - abs(cabin-n)), ?(m >= 0),
               go_to(n), serve(n), within(m) ]))).
proc(from(Left), ndet(within(Left), pi(m, [?(m is Left+1), from(m)]))).
proc(control(short), search(from(0), "a short way")).
proc(control(reckless), from(0)).

proc(control(reactive),
     prioritized_interrupts(
         [ interrupt(n, wanted(n) = yes, [go_to(n), serve(n)]),
           interrupt(cabin > 1, move(down)) ])).
