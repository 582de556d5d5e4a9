:- module(meta_interpreter,
          [ read_program/1,             % +File
            meta_events/2               % +Goal, -Events
          ]).

/** <module> A meta-interpreter that logs what happens, for source terms

What the recorder of library(ev3dev/reasoning) must say, too. It knows nothing
of compiled clauses: it reads the text of the program.
*/

:- dynamic source/3.                    % Head, N, Body
:- thread_local event/1.

%!  read_program(+File) is det.

read_program(File) :-
    retractall(source(_, _, _)),
    setup_call_cleanup(open(File, read, In), read_clauses(In), close(In)).

read_clauses(In) :-
    read(In, Term),
    (   Term == end_of_file
    ->  true
    ;   (   Term = (:- _)
        ->  true
        ;   ( Term = (Head :- Body0) -> true ; Head = Term, Body0 = true ),
            goals(Body0, Body),
            functor(Head, Name, Arity),
            functor(Any, Name, Arity),
            aggregate_all(count, source(Any, _, _), Count),
            N is Count+1,
            assertz(source(Head, N, Body))
        ),
        read_clauses(In)
    ).

%   A variable is called by call/1, also when it is bound by then.

goals(Goal, call(Goal)) :- var(Goal), !.
goals(Goal0, Goal) :-
    Goal0 =.. [Name, A0, B0],
    memberchk(Name, [',', ;, ->, *->]),
    !,
    goals(A0, A),
    goals(B0, B),
    Goal =.. [Name, A, B].
goals(Goal, Goal).

%!  meta_events(+Goal, -Events) is det.
%
%   Events of all answers of Goal: call(I, Parent, Goal), unify(I, N),
%   exit(I, Goal), redo(I), fail(I), exception(I, Ball). Throws `too_long`, also for cyclic terms.

meta_events(Goal, Events) :-
    retractall(event(_)),
    nb_setval(mi_last, 0),
    nb_setval(mi_events, 0),
    catch(forall(local(Goal, 0), true), Ball, true),
    nb_getval(mi_events, Count),
    ( ( Ball == too_long ; Count >= 3000 ) -> throw(too_long) ; true ),
    findall(Event, event(Event), Events).

log(Event) :-
    nb_getval(mi_events, N0),
    N is N0+1,
    nb_setval(mi_events, N),
    (   ( N > 3000 ; cyclic_term(Event) )
    ->  nb_setval(mi_events, 3000),     % the program may catch it
        throw(too_long)
    ;   assertz(event(Event))
    ).

%   A body that is no goal is refused before any of it is called.

local(Goal0, Parent) :-
    must_be_body(Goal0),
    goals(Goal0, Goal),
    prolog_current_choice(Choice),
    solve(Goal, Parent, Choice).

must_be_body(Goal) :-
    (   is_body(Goal)
    ->  true
    ;   call(Goal)
    ).

is_body(Goal) :- var(Goal), !.
is_body(Goal) :-
    callable(Goal),
    (   Goal =.. [Name, A, B],
        memberchk(Name, [',', ;, ->, *->])
    ->  is_body(A),
        is_body(B)
    ;   true
    ).

solve(Goal, P, _) :- var(Goal), !, node(call(Goal), P).
solve(true, _, _) :- !.
solve(!, _, Choice) :- !, prolog_cut_to(Choice).
solve((A, B), P, Choice) :- !, solve(A, P, Choice), solve(B, P, Choice).
solve((If -> Then ; Else), P, Choice) :-
    !,
    (   local(If, P)
    ->  solve(Then, P, Choice)
    ;   solve(Else, P, Choice)
    ).
solve((If *-> Then ; Else), P, Choice) :-
    !,
    (   local(If, P)
    *-> solve(Then, P, Choice)
    ;   solve(Else, P, Choice)
    ).
solve((A ; B), P, Choice) :-
    !,
    ( solve(A, P, Choice) ; solve(B, P, Choice) ).
solve((If -> Then), P, Choice) :-
    !,
    ( local(If, P) -> solve(Then, P, Choice) ).
solve((If *-> Then), P, Choice) :-
    !,
    local(If, P),
    solve(Then, P, Choice).
solve(Goal, P, _) :-
    node(Goal, P).

node(Goal, P) :-
    nb_getval(mi_last, I0),
    I is I0+1,
    nb_setval(mi_last, I),
    log(call(I, P, Goal)),
    (   catch(run(Goal, I), Ball, left(I, Ball)),
        (   log(exit(I, Goal))
        ;   log(redo(I)),
            fail
        )
    ;   log(fail(I)),
        fail
    ).

left(I, Ball) :-
    log(exception(I, Ball)),
    throw(Ball).

run(Goal, I) :-
    functor(Goal, Name, Arity),
    functor(Any, Name, Arity),
    \+ \+ source(Any, _, _),
    \+ predicate_property(user:Any, dynamic),
    !,
    prolog_current_choice(Choice),
    source(Goal, N, Body),
    log(unify(I, N)),
    solve(Body, I, Choice).
run(findall(X, Goal, L), I) :- !, findall(X, local(Goal, I), L).
run(forall(A, B), I) :- !, forall(local(A, I), local(B, I)).
run(once(A), I) :- !, once(local(A, I)).
run(ignore(A), I) :- !, ignore(local(A, I)).
run(\+ A, I) :- !, \+ local(A, I).
run(catch(A, Ball, R), I) :- !, catch(local(A, I), Ball, local(R, I)).
run(Call, I) :-
    Call =.. [call, Goal|More],
    !,
    (   More == []
    ->  local(Goal, I)
    ;   Goal =.. Parts0,
        append(Parts0, More, Parts),
        Goal1 =.. Parts,
        local(Goal1, I)
    ).
run(Goal, _) :-
    call(user:Goal).
