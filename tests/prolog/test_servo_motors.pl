:- use_module('../support/trees').
:- use_module('../support/child').
:- use_module('../support/old_prolog').

sv1('in1:i2c88:sv1').

% A servo of a controller at in1 of Tree.
in_tree(Tree, Goal) :-
    sv1(Servo),
    on(Tree, ( equip(Tree, [Servo-'ms-8ch-servo']), Goal )).

plain(Goal) :-
    sv1(Servo),
    with_tree(plain, [Servo-'ms-8ch-servo'], once(Goal)).

:- begin_tests(servo_motor).
test(is_found, [forall(tree(Tree)), true(P == 'in1:i2c88:sv1')]) :-
    in_tree(Tree, ( servo_motor(P0) -> P = P0 )),
    in_tree(Tree, servo_motor('ev3-ports:in1:i2c88:sv1')).
test(eight_of_them, [forall(behaving(Tree)), true(Count == 8)]) :-
    in_tree(Tree, aggregate_all(count, servo_motor(_), Count)).
:- end_tests(servo_motor).

:- begin_tests(servo_motor_position).
test(goes_there_and_stays,
     [ forall(( behaving(Tree), member(Percent-Read, [40-40, -100-(-100), 0-0,
                                                      33.4-33, 100/3-33]) )),
       true(P-State == Read-running) ]) :-
    in_tree(Tree, ( sv1(S), servo_motor_position(S, Percent),
                    servo_motor_position(S, P),
                    servo_motor_attribute(S, state, State) )).
test(writes_the_position_then_runs, true(W == [command=run, position_sp='40'])) :-
    plain(( sv1(S), servo_motor_position(S, 40), written(S, W) )).
test(an_angle_is_90_degrees_to_either_side,
     [ forall(( behaving(Tree), member(Degrees-Percent-Read,
                                       [90-100-90.0, -45-(-50)-(-45.0), 30-33-29.7]) )),
       true(P-A == Percent-Read) ]) :-
    in_tree(Tree, ( sv1(S), servo_motor_angle(S, Degrees),
                    servo_motor_position(S, P), servo_motor_angle(S, A) )).
test(the_sign_does_not_depend_on_the_polarity, [forall(behaving(Tree)), true(P == 30)]) :-
    in_tree(Tree, ( sv1(S), servo_motor_polarity(S, inversed),
                    servo_motor_position(S, 30), servo_motor_position(S, P) )).
test(a_servo_that_floats_is_nowhere, [forall(tree(Tree)), fail]) :-
    in_tree(Tree, ( sv1(S), servo_motor_position(S, 30), servo_motor_float(S),
                    ( servo_motor_position(S, _) ; servo_motor_angle(_, _) ) )).
test(beyond_its_way_it_fails_and_writes_nothing,
     [ forall(( member(P0, [101, -101, inf, nan, 10**400]), evaluated(P0, P),
                member(Goal, [servo_motor_position(S, P), servo_motor_angle(S, P)]) )),
       true(W == []) ]) :-
    sv1(S),
    plain(( \+ Goal, written(S, W) )).
test(fails_without_a_servo,
     [ forall(member(Goal, [ servo_motor_position(outA, 5), servo_motor_position(outA, _),
                             servo_motor_angle(outA, 5), servo_motor_float(outA),
                             servo_motor_rate(outA, 5), servo_motor_polarity(outA, normal),
                             servo_motor_pulses(outA, _, _, _),
                             servo_motor_attribute(outA, state, _) ])),
       fail ]) :-
    plain(Goal).
test(what_is_no_position_throws_and_writes_nothing,
     [ forall(( sv1(S),
                member(Goal-Error,
                       [ servo_motor_position(S, left)-type_error(evaluable, _),
                         servo_motor_position(_, 5)-instantiation_error,
                         servo_motor_angle(_, 5)-instantiation_error,
                         servo_motor_float(_)-instantiation_error ]) )),
       true(E-W == caught-[]) ]) :-
    plain(( catch(Goal, error(Error, _), E = caught), written(S, W) )).
:- end_tests(servo_motor_position).

:- begin_tests(servo_motor_settings).
test(floats, [forall(behaving(Tree)), true(State == '')]) :-
    in_tree(Tree, ( sv1(S), servo_motor_position(S, 10), servo_motor_float(S),
                    servo_motor_attribute(S, state, State) )).
test(polarity, [forall(tree(Tree)), true([P1, P2] == [normal, inversed])]) :-
    in_tree(Tree, ( sv1(S), servo_motor_polarity(S, P1),
                    servo_motor_polarity(S, inversed), servo_motor_polarity(S, P2) )).
test(rate, [forall(tree(Tree)), true(R == 500)]) :-
    in_tree(Tree, ( sv1(S), servo_motor_rate(S, 500), servo_motor_rate(S, R) )).
test(pulses, [forall(tree(Tree)), true([Ps, Qs] == [[500, 1500, 2500], [600, 1400, 2400]])]) :-
    in_tree(Tree, ( sv1(S), servo_motor_pulses(S, A, B, C), Ps = [A, B, C],
                    servo_motor_pulses(S, 600, 1400, 2400),
                    servo_motor_pulses(S, D, E, F), Qs = [D, E, F] )).
test(what_cannot_be_throws_and_writes_nothing,
     [ forall(( sv1(S),
                member(Goal-Error,
                       [ servo_motor_polarity(S, up)-domain_error(polarity, up),
                         servo_motor_polarity(S, 7)-type_error(atom, 7),
                         servo_motor_rate(S, -1)-domain_error(rate_sp, -1),
                         servo_motor_rate(S, slow)-type_error(integer, slow),
                         servo_motor_pulses(S, 1001, 1500, 2500)
                         -domain_error(min_pulse_sp, 1001),
                         servo_motor_pulses(S, 500, 999, 2500)
                         -domain_error(mid_pulse_sp, 999),
                         servo_motor_pulses(S, 500, 1500, 3001)
                         -domain_error(max_pulse_sp, 3001),
                         servo_motor_pulses(S, 500, 1500, _)-instantiation_error ]) )),
       true(E-W == caught-[]) ]) :-
    plain(( catch(Goal, error(Error, _), E = caught), written(S, W) )).
test(floats_at_the_end_of_the_program, true(C == float)) :-
    plain(( tree_root(Root), sv1(S),
            run_program(":- use_module(library(ev3dev)).
                         main :- servo_motor_position('in1:i2c88:sv1', 20).",
                        [env('EV3DEV_SYSFS'=Root), goal(main)], exit(0), _),
            get_attribute(S, command, C) )).
:- end_tests(servo_motor_settings).
