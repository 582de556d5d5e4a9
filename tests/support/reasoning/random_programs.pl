:- module(random_programs,
          [ random_program/2            % +Seed, -Clauses
          ]).
:- use_module(library(random)).

/** <module> Random programs, for the recorder of library(ev3dev/reasoning)

Facts, conjunction, disjunction, if-then-else, soft cut, negation, cut,
recursion over lists, findall/3, forall/2, catch/3, throw/1, structures, and
clauses that are added and removed. rp0(X) is the goal. A predicate rpN calls
those of higher numbers, so each program ends.
*/

random_program(Seed, Clauses) :-
    set_random(seed(Seed)),
    findall(Clause, clause_of(Clause), Random),
    append([ (:- dynamic(rp_d/1)),
             rp_d(a), rp_d(1),
             rp_app([], L, L),
             (rp_app([X|L1], L2, [X|L3]) :- rp_app(L1, L2, L3)),
             rp_len([], 0),
             (rp_len([_|L4], N) :- rp_len(L4, N0), N is N0+1),
             rp_down(0),
             (rp_down(M) :- M > 0, M1 is M-1, rp_down(M1))
           ], Random, Clauses).

clause_of(Clause) :-
    between(0, 6, I),
    random_between(1, 4, Count),
    between(1, Count, _),
    Vars = [_, _, _],
    argument(Vars, A),
    Head =.. [rp, A],
    named(Head, I, Head1),
    (   ( I >= 5 ; maybe(0.25) )
    ->  ( maybe(0.8) -> Clause = Head1
        ; body(6, 1, Vars, Body), Clause = (Head1 :- Body) )
    ;   body(I, 3, Vars, Body),
        Clause = (Head1 :- Body)
    ).

named(rp(A), I, Head) :-
    atom_concat(rp, I, Name),
    Head =.. [Name, A].

argument(Vars, A) :-
    random_between(0, 9, R),
    (   R < 6 -> random_member(A, Vars)
    ;   R < 8 -> random_member(A, [a, b, c, 0, 1, 2])
    ;   R < 9 -> argument(Vars, B), A = f(B)
    ;   argument(Vars, B), argument(Vars, C), A = [B, C]
    ).

body(I, Depth, Vars, Body) :-
    random_between(1, 3, N),
    length(Goals, N),
    maplist(goal(I, Depth, Vars), Goals),
    conjunction(Goals, Body).

conjunction([Goal], Goal) :- !.
conjunction([Goal|Goals], (Goal, Body)) :-
    conjunction(Goals, Body).

goal(I, Depth, Vars, Goal) :-
    Depth1 is Depth-1,
    random_between(0, 99, R),
    (   Depth > 0,
        R < 40
    ->  compound_goal(I, Depth1, Vars, Goal)
    ;   R < 75,
        I < 6
    ->  From is I+1,
        random_between(From, 6, J),
        argument(Vars, A),
        named(rp(A), J, Goal)
    ;   simple(Vars, Goal)
    ).

compound_goal(I, Depth, Vars, Goal) :-
    body(I, Depth, Vars, A),
    body(I, Depth, Vars, B),
    body(I, Depth, Vars, C),
    random_member(V, Vars),
    random_member(W, Vars),
    random_member(Goal,
                  [ (A ; B), (A -> B ; C), (A -> B ; C), (A *-> B ; C),
                    (A -> B), \+ A, \+ A, findall(V, A, W), forall(A, B),
                    catch(A, _, B), catch(A, t(_), B), once(A), ignore(A),
                    call(A), call((A, !)), (V = rp6(W), V),
                    (V = f(W), call(rp_app, [V], W)), (A ; B ; C) ]).

simple(Vars, Goal) :-
    random_member(V, Vars),
    argument(Vars, A),
    argument(Vars, B),
    random_member(Goal,
                  [ !, !, V = A, V = A, V == A, V \== A, A @< B, var(V),
                    nonvar(V), V is 1+2, V < 2, V = B, fail, true,
                    throw(t(A)), throw(b), rp_d(V), rp_d(V),
                    assertz(rp_d(A)), retract(rp_d(A)), rp_app(V, _, [a, 1]),
                    rp_app(_, V, [b, c]), rp_len([A, B], V), rp_down(2),
                    member(V, [A, B, c]), between(0, 2, V), functor(A, V, _),
                    atom_length(A, V), A = f(V), V = [A|B], undefined_here(V)
                  ]).
