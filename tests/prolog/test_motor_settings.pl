:- use_module('../support/trees').
:- use_module('../support/old_prolog').

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

:- begin_tests(motor_gear).
test(is_none_at_first, [forall(tree(Tree)), true(Gs == [outA-1.0, outB-1.0, outC-1.0])]) :-
    on(Tree, findall(P-G, motor_gear(P, G), Gs)).
test(is_of_its_port_alone_in_either_spelling,
     [forall(tree(Tree)), true([B, L, C] == [3.0, 3.0, 1.0])]) :-
    on(Tree, ( motor_gear('ev3-ports:outB', 36/12), motor_gear(outB, B),
               motor_gear('ev3-ports:outB', L), motor_gear(outC, C) )).
test(writes_no_file, true(W == [])) :-
    plain(( motor_gear(outB, 3), written(W) )).
test(angles_and_speeds_are_those_of_what_is_driven,
     [ forall(member(Goal-Attribute-Text,
                     [ motor_run(outB, 50, 90, [wait(false)])-position_sp-'270',
                       motor_run(outB, 50, rotations(1), [wait(false)])-position_sp-'1080',
                       motor_run_to(outB, 50, -90, [wait(false)])-position_sp-'-270',
                       motor_run(outB, dps(100))-speed_sp-'300',
                       motor_run(outB, 50)-speed_sp-'525',
                       run_forever(outB, 100)-speed_sp-'100',
                       motor_position(outB, 30)-position-'90' ])),
       true(T == Text) ]) :-
    plain(( motor_gear(outB, 3), Goal, get_attribute(outB, Attribute, T) )).
test(readings_agree_with_it, true([P, S, Counts] == [30.0, 20.0, 90])) :-
    plain(( motor_gear(outB, 3), put_attribute(outB, position, 90),
            put_attribute(outB, speed, 60), motor_position(outB, P), motor_speed(outB, S),
            position(outB, Counts) )).
test(a_motor_turns_as_far_and_as_fast_as_it_is_told, [forall(behaving(Tree))]) :-
    on(Tree, ( motor_gear(outA, 2), motor_run(outA, dps(200), 90), settle(Tree),
               motor_position(outA, P), near(P, 90, 1), position(outA, C), near(C, 180, 2),
               motor_run(outA, dps(200)), wait(0.5), motor_speed(outA, S), near(S, 200, 10) )).
test(a_speed_that_only_a_motor_without_it_has_fails, [forall(tree(Tree)), fail]) :-
    on(Tree, ( motor_gear(outB, 3), motor_run(outB, dps(400)) )).
test(stays_after_a_reset_and_with_another_motor, true(G1-G2 == 3.0-3.0)) :-
    with_sim([], ( motor_gear(outB, 3), motor_reset(outB), motor_gear(outB, G1),
                   sim_unplug(outB), sim_wait(1), sim_plug(outB, 'lego-ev3-m-motor'), sim_wait(2),
                   motor_gear(outB, G2) )).
test(another_simulation_has_none, true(G == 1.0)) :-
    with_sim([], motor_gear(outB, 3)),
    with_sim([], motor_gear(outB, G)).
test(a_wrong_ratio_throws_and_changes_nothing,
     [ forall(member(Goal-Error, [ motor_gear(outB, 0)-domain_error(positive_number, 0),
                                   motor_gear(outB, -3)-domain_error(positive_number, -3),
                                   motor_gear(outB, [12, 36])-type_error(_, _),
                                   motor_gear(outB, far)-type_error(evaluable, _),
                                   motor_gear(_, 3)-instantiation_error,
                                   motor_gear(7, _)-type_error(_, 7) ])),
       true(E-G == caught-1.0) ]) :-
    plain(( catch(Goal, error(Error, _), E = caught), motor_gear(outB, G) )).
:- end_tests(motor_gear).

:- begin_tests(motor_speed).
test(is_read_in_degrees_a_second, [forall(tree(Tree)), true(Ss == [outA-0, outB-0, outC-0])]) :-
    on(Tree, findall(P-S, motor_speed(P, S), Ss)).
test(counts_that_are_no_degrees, true(S == 45.0)) :-
    plain(( put_attribute(outB, count_per_rot, 720), put_attribute(outB, speed, 90),
            motor_speed(outB, S) )).
:- end_tests(motor_speed).

:- begin_tests(motor_settings).
test(absent, [ forall(( tree(Tree),
                        member(Goal, [ motor_position(outD, _), motor_position(outD, 0),
                                       motor_speed(outD, _), motor_gear(outD, _),
                                       motor_gear(outD, 3),
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
