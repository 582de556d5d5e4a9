:- module(axioms, [histories/3]).
:- use_module(library(lists)).

/** <module> Trans and Final, as they are published

A second interpreter, for comparison with library(ev3dev/golog): nothing is
shared, nothing is fast. It has no situations but histories, regresses each
condition to the beginning, and takes the axioms of De Giacomo, Lesperance,
Levesque (ConGolog, 2000) and of De Giacomo, Lesperance, Levesque, Sardina
(IndiGolog, 2009) literally. The variables of its programs are atoms.
*/

%!  histories(+Program, +Module, -Histories) is det.
%
%   Histories are those to which Program leads in the domain of Module.

histories(E, M, Hs) :-
    findall(H, do(E, [], H, M), Hs0),
    sort(Hs0, Hs).

do(E, H, H, M) :-
    final(E, H, M).
do(E, H0, H, M) :-
    trans(E, H0, E1, H1, M),
    do(E1, H1, H, M).

% ---------------- FINAL

final([], _, _).
final([E|Es], H, M) :- final(E, H, M), final(Es, H, M).
final(ndet(A, B), H, M) :- ( final(A, H, M) ; final(B, H, M) ).
final(wndet(A, B), H, M) :- final(A, H, M), final(B, H, M).
final(if(P, A, B), H, M) :-
    ( holds(P, H, M) -> final(A, H, M) ; final(B, H, M) ).
final(while(P, E), H, M) :- ( \+ holds(P, H, M) ; final(E, H, M) ).
final(star(_), _, _).
final(pi(V, Vs, E0), H, M) :-
    member(X, Vs),
    put_for(V, X, E0, E),
    final(E, H, M).
final(for(V, Vs, E), H, M) :- for_each(Vs, V, E, Es), final(Es, H, M).
final(conc(A, B), H, M) :- final(A, H, M), final(B, H, M).
final(pconc(A, B), H, M) :- final(A, H, M), final(B, H, M).
final(iconc(_), _, _).
final(interrupt(_, _), _, _).
final(search(E), H, M) :- final(E, H, M).
final(atomic(E), H, M) :- final(E, H, M).
final(begun(E), H, M) :- final(E, H, M).
final(E, H, M) :- body(E, Body, M), final(Body, H, M).

% ---------------- TRANS

trans(A, H, [], [A|H], M) :-
    \+ A = [_|_],
    A \== [],
    M:prim_action(A),
    M:poss(A, P),
    holds(P, H, M).
trans(?(P), H, [], H, M) :- holds(P, H, M).
trans([E|Es], H, [E1|Es], H1, M) :- trans(E, H, E1, H1, M).
trans([E|Es], H, E1, H1, M) :- final(E, H, M), trans(Es, H, E1, H1, M).
trans(ndet(A, B), H, E1, H1, M) :-
    ( trans(A, H, E1, H1, M) ; trans(B, H, E1, H1, M) ).
trans(wndet(A, B), H, E1, H1, M) :-
    (   can_step(A, H, M)
    ->  trans(A, H, E1, H1, M)
    ;   trans(B, H, E1, H1, M)
    ).
trans(if(P, A, B), H, E1, H1, M) :-
    ( holds(P, H, M) -> trans(A, H, E1, H1, M) ; trans(B, H, E1, H1, M) ).
trans(while(P, E), H, [E1, while(P, E)], H1, M) :-
    holds(P, H, M),
    trans(E, H, E1, H1, M).
trans(star(E), H, [E1, star(E)], H1, M) :- trans(E, H, E1, H1, M).
trans(pi(V, Vs, E0), H, E1, H1, M) :-
    member(X, Vs),
    put_for(V, X, E0, E),
    trans(E, H, E1, H1, M).
trans(for(V, Vs, E), H, E1, H1, M) :-
    for_each(Vs, V, E, Es),
    trans(Es, H, E1, H1, M).
trans(conc(A, B), H, conc(A1, B), H1, M) :-
    \+ in_atom(B, H, M),
    trans(A, H, A1, H1, M).
trans(conc(A, B), H, conc(A, B1), H1, M) :-
    \+ in_atom(A, H, M),
    trans(B, H, B1, H1, M).
trans(pconc(A, B), H, E1, H1, M) :-
    (   can_step(A, H, M),
        \+ in_atom(B, H, M)
    ->  trans(A, H, A1, H1, M),
        E1 = pconc(A1, B)
    ;   \+ in_atom(A, H, M),
        trans(B, H, B1, H1, M),
        E1 = pconc(A, B1)
    ).
trans(iconc(E), H, conc(E1, iconc(E)), H1, M) :- trans(E, H, E1, H1, M).
trans(interrupt(P, E), H, [E1, interrupt(P, E)], H1, M) :-
    holds(P, H, M),
    trans(E, H, E1, H1, M).
trans(prioritized_interrupts(Es), H, E1, H1, M) :-
    (   append(Before, [E|After], Es),
        can_step(E, H, M)
    ->  trans(E, H, E2, H1, M),
        append(Before, [E2|After], Es1),
        E1 = prioritized_interrupts(Es1)
    ;   % stop_interrupts: the loop of each ends, but not what it has begun.
        H1 = H,
        stopped(Es, E1)
    ).
trans(search(E), H, search(E1), H1, M) :-
    trans(E, H, E1, H1, M),
    \+ \+ do(E1, H1, _, M).
trans(atomic(E), H, begun(E1), H1, M) :- trans(E, H, E1, H1, M).
trans(begun(E), H, begun(E1), H1, M) :- trans(E, H, E1, H1, M).
trans(E, H, E1, H1, M) :- body(E, Body, M), trans(Body, H, E1, H1, M).

can_step(E, H, M) :-
    \+ \+ trans(E, H, _, _, M).

body(E, Body, M) :-
    \+ E = [_|_],
    E \== [],
    M:proc(E, Body).

stopped([], []).
stopped([E0|Es0], pconc(E, Es)) :-
    without_loop(E0, E),
    stopped(Es0, Es).

without_loop(interrupt(_, _), []) :-
    !.
without_loop([E0|Es0], [E|Es]) :-
    !,
    without_loop(E0, E),
    without_loop(Es0, Es).
without_loop(E, E).

%   An atomic program is under way, and may not end yet.

in_atom(E, H, M) :-
    \+ final(E, H, M),
    (   E = begun(_)
    ->  true
    ;   ( E = [P|_] ; E = search(P) )
    ->  in_atom(P, H, M)
    ;   ( E = conc(A, B) ; E = pconc(A, B) ),
        ( in_atom(A, H, M) ; in_atom(B, H, M) )
    ->  true
    ).

for_each([], _, _, []).
for_each([X|Xs], V, E0, [E|Es]) :-
    put_for(V, X, E0, E),
    for_each(Xs, V, E0, Es).

% ---------------- CONDITIONS

holds(and(P, Q), H, M) :- !, holds(P, H, M), holds(Q, H, M).
holds(or(P, Q), H, M) :- !, ( holds(P, H, M) -> true ; holds(Q, H, M) ).
holds(neg(P), H, M) :- !, \+ holds(P, H, M).
holds(some(V, Vs, P0), H, M) :-
    !,
    member(X, Vs),
    put_for(V, X, P0, P),
    holds(P, H, M),
    !.
holds(true, _, _) :- !.
holds(P, H, M) :-
    M:proc(P, Body),
    !,
    holds(Body, H, M).
holds(F, H, M) :-
    is_fluent(F, M),
    !,
    value(F, H, V, M),
    V == true.
holds(P0, H, M) :-
    P0 =.. [Name|As0],
    values(As0, H, As, M),
    P =.. [Name|As],
    call(M:P).

is_fluent(F, M) :-
    nonvar(F),
    ( M:prim_fluent(F) ; M:rel_fluent(F) ),
    !.

values([], _, [], _).
values([A0|As0], H, [A|As], M) :-
    (   is_fluent(A0, M)
    ->  value(A0, H, A, M)
    ;   compound(A0)
    ->  A0 =.. [Name|Bs0],
        values(Bs0, H, Bs, M),
        A1 =.. [Name|Bs],
        (   is_fluent(A1, M)
        ->  value(A1, H, A, M)
        ;   A = A1
        )
    ;   A = A0
    ),
    values(As0, H, As, M).

%   value(+Fluent, +History, -Value, +Module): by the last action that sets it

value(F, [], V, M) :-
    once(M:initially(F, V)).
value(F, [A|H], V, M) :-
    (   causes(A, F, V1, P, M),
        holds(P, H, M)
    ->  V = V1
    ;   value(F, H, V, M)
    ).

causes(A, F, V, P, M) :- M:causes_val(A, F, V, P).
causes(A, F, true, P, M) :- M:causes_true(A, F, P).
causes(A, F, false, P, M) :- M:causes_false(A, F, P).

% ---------------- VARIABLES

%   put_for(+Variable, +Value, +Term0, -Term): an inner pi/3 of the same name
%   keeps its own.

put_for(V, X, T0, T) :-
    (   T0 == V
    ->  T = X
    ;   compound(T0),
        \+ binds(T0, V)
    ->  T0 =.. [Name|As0],
        all_put_for(As0, V, X, As),
        T =.. [Name|As]
    ;   T = T0
    ).

binds(pi(V, _, _), V).
binds(for(V, _, _), V).
binds(some(V, _, _), V).

all_put_for([], _, _, []).
all_put_for([T0|Ts0], V, X, [T|Ts]) :-
    put_for(V, X, T0, T),
    all_put_for(Ts0, V, X, Ts).
