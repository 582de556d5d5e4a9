% Programs that a recorder gets wrong easily, one for each pitfall.

% Tests inside findall/3, forall/2 and catch/3 are seen.
inner(L) :- findall(X, (member(X, [1, 2, 3]), X > 1), L).
all_small :- forall(member(X, [1, 9]), X < 5).
caught :- catch(( X = 3, X > 5 ), _, true).

% The compiler moves the first unification into the head, and drops others.
same(X) :- X = f(Y), Y == 1.
minus(N, M) :- M is N-1.
turned(A) :- A == 1.
fresh(X) :- member(X, [1]), _ = X.

% A frame is used again for the next goal of a clause.
many :- one, one, one.
one.

% A cut drops what is left of way/1, or the other clauses.
first(W) :- way(W), !.
only(1) :- !.
only(_).
once_inside(W) :- ( way(W) -> true ; fail ).

% No more answers: an open choice point that is never tried again.
open_end(W) :- way(W).

% What leaves a goal is not a failure.
thrower :- deeper, true.
deeper :- throw(my_ball).
catcher :- catch(thrower, my_ball, true).

% Without end; with a large term; deep; with a new thread.
endless :- again, endless.
again :- X = 1, X > 0.
endless_catch :- catch(endless, nothing, true).
long(N, L) :- numlist(1, N, L), len(L, _).
len([], 0).
len([_|L], N) :- len(L, M), N is M+1.
clear :- us_dist_cm(in1, D), 10 < D.
down(0) :- !.
down(N) :- N1 is N-1, down(N1).
other_thread :- thread_create(down(100), Id, []), thread_join(Id, true).

% Predicates that are changed while they run; DCG; goals of other modules.
:- dynamic seen/1.
note(X) :- assertz(seen(X)), seen(Y), Y == X, retract(seen(X)).
greeting --> [hello], name.
name --> [world].
name --> [prolog].
greets :- phrase(greeting, [hello, prolog]).
twice(G) :- call(G), lists:append([1], [2], [1, 2]), G.
:- meta_predicate wrapped(0).
wrapped(G) :- call(G).
wraps :- wrapped(one).

% Attributed variables and cyclic terms cannot be stored as they are.
odd :- put_attr(X, odd_attribute, 1), X = X, C = f(C), nonvar(C), fail.

% The first clause fails, the second one helps.
helps(X) :- X > 5.
helps(X) :- X < 5.
none(up).
no_clause :- none(down).
