% Worker of benches/run.py: reads terms measure(Implementation, Case, Count),
% answers each with the seconds one call took.

:- use_module(library(ev3dev)).
:- use_module(answers).
:- use_module(paper).

:- initialization(main, main).

main :-
    answer_terms(answer).

answer(measure(paper, gap, Count), [Seconds]) :-
    !,
    findall(Gap, ( between(1, Count, _), paper:gap(Gap) ), Gaps),
    median(Gaps, Seconds).
answer(measure(Implementation, wait, Seconds), [Share]) :-
    !,
    cpu_share(wait(Implementation, Seconds), Share).
answer(measure(Implementation, Case, Count), [Seconds]) :-
    goal(Implementation, Case, Goal),
    \+ \+ once(Goal),
    get_time(Time0),
    repeat_goal(Count, Goal),
    get_time(Time1),
    repeat_goal(Count, true),
    get_time(Time2),
    Seconds is ((Time1 - Time0) - (Time2 - Time1)) / Count.

repeat_goal(Count, Goal) :-
    (   between(1, Count, _),
        once(Goal),
        fail
    ;   true
    ).

wait(pack, Seconds) :-
    motor_wait(outA, [timeout(Seconds)], timeout).
wait(paper, Seconds) :-
    paper:spin(outA, Seconds).

goal(pack, us_dist_cm, us_dist_cm(_, _)).
goal(pack, col_ambient, col_ambient(in2, _)).
goal(pack, gyro_ang, gyro_ang(_, _)).
goal(pack, position, position(outB, _)).
goal(pack, state, state(outB, _)).
goal(pack, motor_run, motor_run(outD, 50)).
goal(pack, enumerate, findall(Port, tacho_motor(Port), _)).
goal(pack, vehicle2,
     ( col_ambient(in2, Left), motor_run(outB, Left),
       col_ambient(in3, Right), motor_run(outC, Right) )).
goal(paper, us_dist_cm, paper:us_dist_cm(_, _)).
goal(paper, col_ambient, paper:col_ambient(in2, _)).
goal(paper, gyro_ang, paper:gyro_ang(_, _)).
goal(paper, position, paper:position(outB, _)).
goal(paper, state, paper:state(outB, _)).
goal(paper, motor_run, paper:motor_run(outD, 50)).
goal(paper, enumerate,
     findall(Port, paper:detect('tacho-motor', Port, _, _), _)).
goal(paper, vehicle2,
     ( paper:col_ambient(in2, Left), paper:motor_run(outB, Left),
       paper:col_ambient(in3, Right), paper:motor_run(outC, Right) )).
