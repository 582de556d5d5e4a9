:- use_module('../support/trees').

:- begin_tests(time).
test(the_clock_is_that_of_the_simulation) :-
    with_sim([], ( sim_step(7), ev3_time(T), sim_time(S), near(T, S, 0.001) )).
test(the_clock_runs_on_files_too, [forall(tree(Tree)), true(T1 >= T0)]) :-
    with_tree(Tree, ( ev3_time(T0), wait(0.001), ev3_time(T1) )).
test(a_wait_lets_virtual_time_pass) :-
    with_sim([], ( ev3_time(T0), wait(60 * 60), ev3_time(T) )),
    near(T - T0, 3600, 0.1).
test(the_robot_goes_on_while_the_program_waits) :-
    with_sim([start(0, 0, 0)],
             ( set_robot(5.6, 10.6, outB, outC),
               go(30), wait(1), stop,
               sim_pose(_, Y, _) )),
    near(Y, 15, 4).
test(no_wait_is_over_at_once) :-
    with_sim([], ( ev3_time(T0), wait(0), ev3_time(T) )),
    near(T, T0, 0.001).
test(a_time_limit_ends_a_wait, true(Ball == time_limit_exceeded)) :-
    with_sim([],
             catch(call_with_time_limit(0.05, wait(3600)), Ball, true),
             [clock(realtime)]).
test(a_time_that_is_none_throws,
     [ forall(( tree(Tree),
                member(Seconds-Error, [ -1-domain_error(seconds, -1),
                                        _-instantiation_error,
                                        soon-type_error(evaluable, _) ]) )),
       error(Error, context(wait/1, _)) ]) :-
    with_tree(Tree, wait(Seconds)).
:- end_tests(time).

:- begin_tests(stopwatch).
test(tells_the_time_since_its_start) :-
    with_sim([], ( stopwatch(Watch), wait(2), elapsed(Watch, T1),
                   wait(1), elapsed(Watch, T2) )),
    ground(Watch),
    near(T1, 2, 0.01),
    near(T2, 3, 0.01).
test(there_may_be_several) :-
    with_sim([], ( stopwatch(A), wait(2), stopwatch(B), wait(1),
                   elapsed(A, TA), elapsed(B, TB) )),
    near(TA - TB, 2, 0.01).
test(is_one_of_stopwatch_1,
     [ forall(member(Watch-Error,
                     [ _-instantiation_error,
                       stopwatch(_)-domain_error(stopwatch, _),
                       noon-domain_error(stopwatch, noon),
                       7-domain_error(stopwatch, 7) ])),
       error(Error, context(elapsed/2, _)) ]) :-
    with_sim([], elapsed(Watch, _)).
:- end_tests(stopwatch).
