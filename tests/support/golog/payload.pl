:- module(golog_payload,
          [ payload/2,                  % +Problem, -Clauses
            goal_of/2,                  % +Problem, -Goal
            is_plan/2,                  % +Problem, +Steps
            fewest_steps/2              % +Problem, -Count
          ]).
:- use_module(library(apply)).
:- use_module(library(lists)).
:- use_module(library(ordsets)).
:- use_module(library(pairs)).

/** <module> Loads that two robots carry over a grid

A Problem is payload(Width-Height, Walls, Robots, Loads). Walls is a list of
cells X-Y. Robots is a list of Robot-Cell. A load has two ends, which must be
picked up, carried and dropped at the same time, and are dropped at their
goals only: Loads is a list of load(End1, Cell1, Goal1, End2, Cell2, Goal2).

payload/2 writes it for library(ev3dev/golog), after Caldiran, Haspalamutgil,
Ok, Palaz, Erdem, Patoglu: Bridging the Gap between High-Level Reasoning and
Low-Level Control (2009). is_plan/2 knows nothing of the library, and of these
clauses.
*/

payload(payload(Width-Height, Walls, Robots, Loads), Clauses) :-
    findall(Clause,
            ( member(R-Cell, Robots),
              member(Clause, [agent(R), initially(at(R), Cell)])
            ; member(load(E, C, G, F, D, H), Loads),
              member(Clause, [ end_of_load(E), initially(place(E), C),
                               end_of_load(F), initially(place(F), D),
                               belongs(E, G), belongs(F, H),
                               other_end(E, F), other_end(F, E) ])
            ; between(1, Width, X), between(1, Height, Y),
              \+ memberchk(X-Y, Walls),
              Clause = cell(X-Y)
            ),
            Facts),
    append(Facts,
           [ direction(north, 0, 1), direction(east, 1, 0),
             direction(south, 0, -1), direction(west, -1, 0),
             ( next(X1-Y1, Direction, X2-Y2) :-
                   direction(Direction, DX, DY),
                   cell(X1-Y1),
                   X2 is X1+DX,
                   Y2 is Y1+DY,
                   cell(X2-Y2) ),

             ( prim_action(move(R, C, D)) :- agent(R), next(C, _, D) ),
             ( prim_action(pick(R, E)) :- agent(R), end_of_load(E) ),
             ( prim_action(drop(R, E)) :- agent(R), end_of_load(E) ),
             ( prim_action(carry(R, E, Dir)) :-
                   agent(R), end_of_load(E), direction(Dir, _, _) ),

             ( prim_fluent(at(R)) :- agent(R) ),
             ( prim_fluent(place(E)) :- end_of_load(E) ),
             ( rel_fluent(holds(R, E)) :- agent(R), end_of_load(E) ),
             initially(holds(_, _), false),
             ( derived(busy(R), some(e, end_of_load, holds(R, e))) :-
                   agent(R) ),

             poss(move(R, C, _), and(at(R) = C, neg(busy(R)))),
             poss(pick(R, E), and(at(R) = place(E), neg(busy(R)))),
             poss(drop(R, E), and(holds(R, E), belongs(E, place(E)))),
             poss(carry(R, E, Dir), and(holds(R, E), next(at(R), Dir, _))),

             causes_val(move(R, _, D), at(R), D, true),
             causes_true(pick(R, E), holds(R, E), true),
             causes_false(drop(R, E), holds(R, E), true),
             causes_val(carry(R, _, Dir), at(R), D, next(at(R), Dir, D)),
             causes_val(carry(R, E, Dir), place(E), D, next(at(R), Dir, D)),

             ( together(pick(_, E), pick(_, F)) :- other_end(E, F) ),
             ( together(drop(_, E), drop(_, F)) :- other_end(E, F) ),
             ( together(carry(_, E, Dir), carry(_, F, Dir)) :-
                   other_end(E, F) ),
             excludes(move(_, C, D), move(_, D, C)),
             ( always(neg(at(R) = at(Q))) :- agent(R), agent(Q), R @< Q )
           ], Clauses).

goal_of(payload(_, _, Robots, Loads), and(Conditions)) :-
    findall(Condition,
            ( member(load(E, _, C, F, _, D), Loads),
              member(Condition, [place(E) = C, place(F) = D])
            ; member(R-_, Robots),
              Condition = neg(busy(R)) ),
            Conditions).

%!  is_plan(+Problem, +Steps) is semidet.
%
%   True if Steps, lists of actions in their order, are a plan for Problem. A
%   state is s(Robots, Ends, Held): lists of Robot-Cell and End-Cell, and of
%   Robot-End.

is_plan(Problem, Steps) :-
    Problem = payload(_, _, Robots, Loads),
    findall(E-C, ( member(load(E1, C1, _, E2, C2, _), Loads),
                   member(E-C, [E1-C1, E2-C2]) ), Ends),
    foldl(after(Problem), Steps, s(Robots, Ends, []), s(_, Ends1, [])),
    forall(member(load(E1, _, G1, E2, _, G2), Loads),
           ( memberchk(E1-G1, Ends1), memberchk(E2-G2, Ends1) )),
    !.

after(Problem, Step, S0, S) :-
    Problem = payload(_, _, _, Loads),
    Step = [_|_],
    % Nobody does two things at a time.
    findall(R, ( member(A, Step), arg(1, A, R) ), Rs),
    sort(Rs, Set),
    same_length(Rs, Set),
    forall(member(A, Step), can(A, Problem, S0)),
    % Each end of a load is treated as the other one.
    forall(( member(A, Step), A \= move(_, _, _) ),
           ( A =.. [Name, _, E|More],
             other(E, F, Loads),
             member(B, Step),
             B =.. [Name, _, F|More] )),
    % They do not pass through each other.
    \+ ( member(move(_, C, D), Step), member(move(_, D, C), Step) ),
    foldl(done, Step, S0, S),
    S = s(Robots, _, _),
    pairs_values(Robots, Cells),
    sort(Cells, CellSet),
    same_length(Cells, CellSet).

other(E, F, Loads) :-
    member(Load, Loads),
    ( Load = load(E, _, _, F, _, _) ; Load = load(F, _, _, E, _, _) ),
    !.

can(move(R, C, D), Problem, s(Robots, _, Held)) :-
    memberchk(R-C, Robots),
    \+ memberchk(R-_, Held),
    beside(C, D),
    is_free(D, Problem).
can(pick(R, E), _, s(Robots, Ends, Held)) :-
    memberchk(R-C, Robots),
    memberchk(E-C, Ends),
    \+ memberchk(R-_, Held).
can(drop(R, E), payload(_, _, _, Loads), s(_, Ends, Held)) :-
    memberchk(R-E, Held),
    memberchk(E-C, Ends),
    member(Load, Loads),
    ( Load = load(E, _, C, _, _, _) ; Load = load(_, _, _, E, _, C) ),
    !.
can(carry(R, E, Direction), Problem, s(Robots, _, Held)) :-
    memberchk(R-E, Held),
    memberchk(R-C, Robots),
    moved(Direction, C, D),
    is_free(D, Problem).

beside(C, D) :-
    moved(_, C, D).

moved(north, X-Y0, X-Y) :- Y is Y0+1.
moved(east, X0-Y, X-Y) :- X is X0+1.
moved(south, X-Y0, X-Y) :- Y is Y0-1.
moved(west, X0-Y, X-Y) :- X is X0-1.

is_free(X-Y, payload(Width-Height, Walls, _, _)) :-
    between(1, Width, X),
    between(1, Height, Y),
    \+ memberchk(X-Y, Walls).

done(move(R, C, D), s(Robots0, Ends, Held), s(Robots, Ends, Held)) :-
    selectchk(R-C, Robots0, R-D, Robots).
done(pick(R, E), s(Robots, Ends, Held), s(Robots, Ends, [R-E|Held])).
done(drop(R, E), s(Robots, Ends, Held0), s(Robots, Ends, Held)) :-
    selectchk(R-E, Held0, Held).
done(carry(R, E, Direction), s(Robots0, Ends0, Held),
     s(Robots, Ends, Held)) :-
    selectchk(R-C, Robots0, R-D, Robots),
    selectchk(E-C, Ends0, E-D, Ends),
    moved(Direction, C, D).

%!  fewest_steps(+Problem, -Count) is semidet.
%
%   Count is how many steps a plan has at least. Fails if there is no plan. All
%   states are tried, breadth first.

fewest_steps(Problem, Count) :-
    Problem = payload(_, _, Robots, Loads),
    findall(E-C, ( member(load(E1, C1, _, E2, C2, _), Loads),
                   member(E-C, [E1-C1, E2-C2]) ), Ends),
    breadth_first([s(Robots, Ends, [])], [], Problem, 0, Count).

breadth_first(States, Seen, Problem, Count0, Count) :-
    States = [_|_],
    (   member(State, States),
        is_goal(State, Problem)
    ->  Count = Count0
    ;   ord_union(Seen, States, Seen1),
        findall(State,
                ( member(State0, States),
                  any_step(State0, Problem, Step),
                  after(Problem, Step, State0, State1),
                  sorted(State1, State) ),
                Next0),
        sort(Next0, Next1),
        ord_subtract(Next1, Seen1, Next),
        Count1 is Count0+1,
        breadth_first(Next, Seen1, Problem, Count1, Count)
    ).

is_goal(s(_, Ends, []), payload(_, _, _, Loads)) :-
    forall(member(load(E1, _, G1, E2, _, G2), Loads),
           ( memberchk(E1-G1, Ends), memberchk(E2-G2, Ends) )).

sorted(s(Robots0, Ends0, Held0), s(Robots, Ends, Held)) :-
    maplist(msort, [Robots0, Ends0, Held0], [Robots, Ends, Held]).

any_step(State, Problem, Step) :-
    Problem = payload(_, _, Robots, _),
    foldl(one_more(State, Problem), Robots, [], Step).

one_more(_, _, _, Step, Step).
one_more(State, Problem, R-_, Step, [A|Step]) :-
    State = s(Robots, Ends, _),
    memberchk(R-C, Robots),
    (   beside(C, D),
        A = move(R, C, D)
    ;   member(E-_, Ends),
        (   A = pick(R, E)
        ;   A = drop(R, E)
        ;   moved(Direction, C, _),
            A = carry(R, E, Direction)
        )
    ),
    can(A, Problem, State).
