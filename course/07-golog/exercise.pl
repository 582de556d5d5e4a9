% A waiter: the buttons call it to the tables, and it takes no order twice.
% Table up is at 100, 160, right at 160, 100, and left at 40, 100; the robot
% starts in the middle.

:- use_module(library(ev3dev/exercise)).
:- use_module(library(ev3dev/sim)).

exercise(golog, [seconds(90), noise(true), seeds(1-6), cpu(30)]).

world(_, [bounds(0, 0, 200, 200), start(100, 100, 0)]).

%   All tables call in each run, two of them while the robot drives to the
%   first.
happens(Seed) :-
    calls(Seed, Calls),
    forall(nth1(N, Calls, Table),
           ( Time is N+1, sim_press(Table, [after(Time), for(0.3)]) )).

calls(Seed, Calls) :-
    Case is Seed mod 6,
    findall(All, permutation([up, right, left], All), Orders),
    nth0(Case, Orders, Calls).

table(up, 100-160).
table(right, 160-100).
table(left, 40-100).

reached(Table, Time) :-
    table(Table, Place),
    time_to(Place, 12, Time).

served_all :-
    findall(Text, said(Text), Said),
    msort(Said, [left, right, up]),
    forall(table(Table, _), reached(Table, _)).

score(2, 'goes to the table that called first') :-
    run_seed(Seed),
    calls(Seed, [First|Others]),
    reached(First, Time),
    \+ ( member(Other, Others), reached(Other, Earlier), Earlier < Time ).
score(4, 'goes to all three and says the name of each, once') :-
    served_all.
score(2, 'and comes back') :-
    served_all,
    ended_near(100-100, Cm),
    Cm < 12.
score(2, 'serves them in the order of their calls') :-
    served_all,
    run_seed(Seed),
    calls(Seed, Calls),
    findall(Text, said(Text), Calls).
