% A waiter: the buttons call it to the tables, and it takes no order twice.
% Table up is at 100, 160, right at 160, 100, and left at 40, 100; the robot
% starts in the middle.

:- use_module(library(ev3dev/exercise)).
:- use_module(library(ev3dev/sim)).

exercise(golog, [seconds(90), noise(true), seeds(1-6), cpu(30)]).

world(_, [bounds(0, 0, 200, 200), start(100, 100, 0)]).

%   Two tables call in each run, the second while the robot drives.
happens(Seed) :-
    calls(Seed, First, Second),
    sim_press(First, [after(2), for(0.3)]),
    sim_press(Second, [after(5), for(0.3)]).

calls(Seed, First, Second) :-
    Case is Seed mod 6,
    nth0(Case, [up-right, right-up, left-right, up-left, right-left, left-up],
         First-Second).

table(up, 100-160).
table(right, 160-100).
table(left, 40-100).

score(3, 'goes to the table that called first') :-
    run_seed(Seed),
    calls(Seed, First, _),
    table(First, Place),
    time_to(Place, 12, _).
score(3, 'and then to the other one') :-
    run_seed(Seed),
    calls(Seed, First, Second),
    table(First, Place1),
    table(Second, Place2),
    time_to(Place1, 12, Time1),
    time_to(Place2, 12, Time2),
    Time1 < Time2.
score(2, 'says the name of each table, once') :-
    run_seed(Seed),
    calls(Seed, First, Second),
    findall(Text, said(Text), [First, Second]).
score(2, 'goes to no other table, and comes back') :-
    run_seed(Seed),
    calls(Seed, First, Second),
    table(Second, Place),
    time_to(Place, 12, _),
    forall(( table(Other, There), Other \== First, Other \== Second ),
           \+ time_to(There, 12, _)),
    ended_near(100-100, Cm),
    Cm < 12.
