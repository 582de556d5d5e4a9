:- use_module('../support/trees').
:- use_module('../support/simulation').
:- use_module('../support/old_prolog').
:- use_module(library(ev3dev)).

plain(Goal) :-
    with_tree(plain, [outB-'lego-ev3-l-motor'], once(Goal)).

:- begin_tests(motor_position).

test(is_read_in_degrees, [forall(tree(Tree)), true(Ps == [outA-0, outB-77, outC-0])]) :-
    on(Tree, ( motor_position(outB, 77), findall(P-D, motor_position(P, D), Ps) )).
test(is_written_by_an_expression, true(P == '-90')) :-
    plain(( motor_position(outB, -180/2), get_attribute(outB, position, P) )).
test(counts_that_are_no_degrees, true(Text-P == '180'-90.0)) :-
    plain(( put_attribute(outB, count_per_rot, 720), motor_position(outB, 90),
            get_attribute(outB, position, Text), motor_position(outB, P) )).
test(beyond_what_is_counted_it_fails, [ forall(( member(P0, [1.0e10, inf, nan]), evaluated(P0, P) )),
                                        true(W == []) ]) :-
    plain(( \+ motor_position(outB, P), written(W) )).
test(what_is_none_throws,
     [ forall(member(Goal-Error, [ motor_position(outB, far)-type_error(evaluable, _),
                                   motor_position(_, 5)-instantiation_error,
                                   motor_position(7, _)-type_error(_, 7) ])),
       error(Error, _) ]) :-
    plain(Goal).

:- end_tests(motor_position).

:- begin_tests(motor_settings).

test(absent, [ forall(( tree(Tree),
                        member(Goal, [ motor_position(outD, _), motor_position(outD, 0),
                                       motor_duty(outD, _), motor_polarity(outD, _),
                                       motor_polarity(outD, normal),
                                       motor_ramps(outD, _, _), motor_ramps(outD, 1, 1),
                                       motor_speed_pid(outD, _),
                                       motor_hold_pid(outD, pid(1, 1, 1)),
                                       linear_actuator(outD) ]) )),
               fail ]) :-
    on(Tree, Goal).
test(duty, [forall(tree(Tree)), true(Ds == [outA-0, outB-0, outC-0])]) :-
    on(Tree, findall(P-D, motor_duty(P, D), Ds)).
test(polarity, [forall(tree(Tree)), true([P1, P2] == [normal, inversed])]) :-
    on(Tree, ( motor_polarity(outA, P1), motor_polarity('ev3-ports:outA', inversed),
               motor_polarity(outA, P2) )).
test(polarity_turns_it_round, [forall(behaving(Tree))]) :-
    on(Tree, ( motor_polarity(outA, inversed), motor_run(outA, 50, 90), settle(Tree),
               position(outA, P), near(P, 90, 2),
               motor_polarity(outA, normal), position(outA, N), near(N, -90, 2) )).
test(ramps, [forall(tree(Tree)), true(U-D == 300-400)]) :-
    on(Tree, ( motor_ramps(outA, 300, 400), motor_ramps(outA, U, D) )).
test(constants_of_the_regulation,
     [forall(tree(Tree)), true([S1, S2, H] == [pid(1000, 60, 0), pid(900, 50, 1),
                                               pid(7, 8, 9)])]) :-
    on(Tree, ( motor_speed_pid(outB, S1), motor_speed_pid(outB, pid(900, 50, 1)),
               motor_speed_pid(outB, S2),
               motor_hold_pid(outB, pid(7, 8, 9)), motor_hold_pid(outB, H) )).
test(two_that_are_the_same_are_asked_for_and_not_written,
     [forall(tree(Tree)), fail]) :-
    on(Tree, ( motor_ramps(outA, 300, 400), motor_ramps(outA, X, X) )).
test(a_reset_puts_them_back, [forall(behaving(Tree)), true(S-R-P == pid(1000, 60, 0)-0-normal)]) :-
    on(Tree, ( motor_speed_pid(outB, pid(1, 1, 1)), motor_ramps(outB, 5, 5),
               motor_polarity(outB, inversed), motor_reset(outB),
               motor_speed_pid(outB, S), motor_ramps(outB, R, _),
               motor_polarity(outB, P) )).
test(what_cannot_be_throws_and_writes_nothing,
     [ forall(member(Goal-Error,
                     [ motor_polarity(outB, up)-domain_error(polarity, up),
                       motor_polarity(outB, 7)-type_error(atom, 7),
                       motor_polarity(_, normal)-instantiation_error,
                       motor_ramps(outB, 60001, 0)-domain_error(ramp_up_sp, 60001),
                       motor_ramps(outB, 0, -1)-domain_error(ramp_down_sp, -1),
                       motor_ramps(outB, _, 0)-instantiation_error,
                       motor_ramps(_, 0, 0)-instantiation_error,
                       motor_speed_pid(outB, pid(1, 2, -3))-domain_error(pid_constant, -3),
                       motor_speed_pid(outB, pid(1, 2, x))-type_error(integer, x),
                       motor_speed_pid(outB, pid(1, 2, _))-instantiation_error,
                       motor_hold_pid(outB, [1, 2, 3])-domain_error(pid, [1, 2, 3]),
                       motor_hold_pid(_, pid(1, 2, 3))-instantiation_error ])),
       true(E-W == caught-[]) ]) :-
    plain(( catch(Goal, error(Error, _), E = caught), written(W) )).

:- end_tests(motor_settings).
