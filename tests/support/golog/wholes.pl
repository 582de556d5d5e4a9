:- module(golog_wholes,
          [ whole/2                     % +Part, -Program
          ]).

/** <module> Programs around a part
*/

%!  whole(+Part, -Program) is nondet.
%
%   Program begins with a step of Part. Each construct has one, in each place
%   where Part may be.

whole(P, [P]).
whole(P, [[], P]).
whole(P, [P, I]) :- idle(I).
whole(P, P : I) :- idle(I).
whole(P, [] : P).
whole(P, #(P, never)).
whole(P, #(never, P)).
whole(P, ndet(P, never)).
whole(P, ndet(never, P)).
whole(P, rndet(P, never)).
whole(P, wndet(P, never)).
whole(P, wndet(never, P)).
whole(P, if(true, P, never)).
whole(P, if(false, never, P)).
whole(P, while(neg(done(a)), P)).
whole(P, star(P)).
whole(P, star(P, 2)).
whole(P, pi(x, [1], P)).
whole(P, pi((x, [1]), P)).
whole(P, rpi(x, [1], P)).
whole(P, rpi((x, [1]), P)).
whole(P, for(x, [1], P)).
whole(P, conc(P, I)) :- idle(I).
whole(P, conc(I, P)) :- idle(I).
whole(P, '$turn'(P, I)) :- idle(I).
whole(P, '$turn'(I, P)) :- idle(I).
whole(P, pconc(P, I)) :- idle(I).
whole(P, pconc(I, P)) :- idle(I).
whole(P, rconc(P, I)) :- idle(I).
whole(P, rconc(I, P)) :- idle(I).
whole(P, rconc([I, P, I])) :- idle(I).
whole(P, rrobin([I, P, I])) :- idle(I).
whole(P, iconc(P)).
whole(P, interrupt(true, P)).
whole(P, interrupt(x, x = 1, P)).
whole(P, prioritized_interrupts([I, P, I])) :- idle(I).
whole(P, prioritized_interrupts_simple([interrupt(true, P)])).
whole(P, search(P)).
whole(P, search(P, m)).
whole(P, search(P, m, [depth(99)])).
whole(P, searchn(P, [])).
whole(P, searchc(P)).
whole(P, searchc(P, [])).
whole(P, '$path'(P, [none], at(99, none), [])).
whole(P, gexec(true, P)).
whole(P, gexec2(true, P)).
whole(P, goal(false, P, false, never)).
whole(P, goal(false, never, true, P)).
whole(P, atomic(P)).
whole(P, '$atomic'(P)).
whole(P, '$within'(interrupt(true), P)).
whole(P, exogint(P, true)).
whole(P, time(P, 99)).
whole(P, ttime(P, 99)).
whole(P, sync([P])).
whole(P, sync([P, P])).

%   It may end, and takes no step.

idle(star(never)).
