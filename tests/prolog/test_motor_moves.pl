:- use_module('../support/trees').
:- use_module('../support/simulation').
:- use_module('../support/old_prolog').
:- use_module(library(ev3dev)).
:- use_module(library(ev3dev/sim)).
:- use_module(library(time)).

plain(Goal) :-
    with_tree(plain, [outA-'lego-ev3-m-motor', outB-'lego-ev3-l-motor'], once(Goal)).

% A linear actuator at outD of Tree, drawn in.
linear(Tree, Goal) :-
    on(Tree, ( equip(Tree, [outD-'act-l12-ev3-50']),
               motor_position(outD, 0),
               Goal )).

:- begin_tests(motor_run_timed).

test(runs_for_its_time_and_brakes, [forall(behaving(Tree)), true(Ss-R == []-stopped)]) :-
    on(Tree, ( sim_time(T0), motor_run_timed(outA, 50, 0.5), sim_time(T),
               near(T - T0, 0.5, 0.15), motor_states(outA, Ss),
               position(outA, There), near(There, 390, 150), R = stopped )).
test(writes_what_the_command_depends_on,
     true(W == [ command='run-timed', speed_sp='-525', stop_action=brake,
                 time_sp='1500' ])) :-
    plain(( motor_run_timed(outB, -50, 3/2, [wait(false)]), written(outB, W) )).
test(the_stop_action_can_be_chosen, [forall(behaving(Tree)), true(Ss == [holding])]) :-
    on(Tree, ( motor_run_timed(outA, 50, 0.3, [stop_action(hold)]),
               motor_states(outA, Ss0), Ss0 = [H|_], Ss = [H] )).
test(a_time_limit_stops_it, [forall(behaving(Tree)), true(Ss == [])]) :-
    on(Tree, ( catch(call_with_time_limit(0.1,
                         ( repeat, motor_run_timed(outA, 5, 60), fail )),
                     time_limit_exceeded, true),
               motor_states(outA, Ss) )).
test(who_stops_it_makes_it_fail, [fail]) :-
    plain(( put_attribute(outB, state, running),
            meanwhile(( eventually(get_attribute(outB, command, 'run-timed')),
                        put_attribute(outB, state, '') ),
                      motor_run_timed(outB, 50, 30)) )).
test(an_unplugged_motor_throws, error(existence_error(motor, outB), _)) :-
    plain(( put_attribute(outB, state, running),
            later(0.05, unplug(outB)),
            motor_run_timed(outB, 50, 30) )).
test(an_impossible_run_fails_and_writes_nothing,
     [ forall(member(Port-Speed-Seconds,
                     [ outB-0-1, outB-101-1, outB-50-3000000, outC-50-1 ])),
       true(W == []) ]) :-
    plain(( \+ motor_run_timed(Port, Speed, Seconds), written(W) )).
test(a_wrong_argument_throws_and_writes_nothing,
     [ forall(member(Speed-Seconds-Options-Error,
                     [ 50-(-1)-[]-domain_error(seconds, -1),
                       50-_-[]-instantiation_error,
                       _-1-[]-instantiation_error,
                       50-soon-[]-type_error(evaluable, _),
                       50-1-[stop_action(jump)]-domain_error(stop_action, jump),
                       50-1-[time(3)]-domain_error(motor_option, time(3)),
                       50-1-foo-type_error(list, foo),
                       50-1-_-instantiation_error ])),
       true(E-W == caught-[]) ]) :-
    plain(( catch(motor_run_timed(outB, Speed, Seconds, Options), error(Error, _),
                  E = caught),
            written(W) )).

:- end_tests(motor_run_timed).

:- begin_tests(motor_run_to).

test(goes_to_a_position_whatever_the_sign_of_the_speed,
     [forall(( behaving(Tree), member(Speed, [50, -50]) ))]) :-
    on(Tree, ( motor_run_to(outA, Speed, 180), settle(Tree),
               position(outA, P1), near(P1, 180, 2),
               motor_run_to(outA, Speed, -90), settle(Tree),
               position(outA, P2), near(P2, -90, 2) )).
test(is_there_already, [forall(behaving(Tree))]) :-
    on(Tree, ( motor_run_to(outA, 50, 90), settle(Tree),
               motor_run_to(outA, 50, 90), settle(Tree),
               position(outA, P), near(P, 90, 2) )).
test(a_new_zero_counts, [forall(behaving(Tree))]) :-
    on(Tree, ( motor_run_to(outA, 50, 90), motor_stop(outA), motor_position(outA, 0),
               motor_run_to(outA, 50, 90), settle(Tree),
               position(outA, P), near(P, 90, 3) )).
test(a_relative_move_after_it_counts_from_there, [forall(behaving(Tree))]) :-
    on(Tree, ( motor_run_to(outA, 50, 90), motor_run(outA, 50, 90), settle(Tree),
               position(outA, P), near(P, 180, 2) )).
test(writes_what_the_command_depends_on,
     true(W == [ command='run-to-abs-pos', position_sp='-180', speed_sp='525',
                 stop_action=hold ])) :-
    plain(( put_attribute(outB, count_per_rot, 720),
            motor_run_to(outB, -50, -90, [wait(false)]),
            put_attribute(outB, count_per_rot, 360),
            written(outB, W) )).
test(several_at_once, true([A, B] == ['run-to-abs-pos', 'run-timed'])) :-
    plain(( motors_turn([to(outA, 50, 90), for(outB, 20, 3)], [wait(false)]),
            get_attribute(outA, command, A), get_attribute(outB, command, B) )).
test(an_impossible_move_fails_and_writes_nothing,
     [ forall(( member(Port-Speed0-Angle0,
                       [ outB-0-90, outB-101-90, outB-50-1.0e308, outB-50-inf,
                         outB-50-nan, outC-50-90 ]),
                evaluated(Speed0, Speed), evaluated(Angle0, Angle) )),
       true(W == []) ]) :-
    plain(( \+ motor_run_to(Port, Speed, Angle), written(W) )).
test(a_wrong_argument_throws_and_writes_nothing,
     [ forall(member(Goal-Error,
                     [ motor_run_to(_, 50, 90)-instantiation_error,
                       motor_run_to(outB, _, 90)-instantiation_error,
                       motor_run_to(outB, 50, far)-type_error(evaluable, _),
                       motor_run_to(outB, 50, 90, [x(1)])-domain_error(motor_option, x(1)),
                       motors_turn([by(outB, 50, 90)], [])
                       -domain_error(motor_move, by(outB, 50, 90)) ])),
       true(E-W == caught-[]) ]) :-
    plain(( catch(Goal, error(Error, _), E = caught), written(W) )).

:- end_tests(motor_run_to).

:- begin_tests(motor_run_direct).

test(runs_and_can_be_changed, [forall(behaving(Tree)), true(Ds == [40, -30])]) :-
    on(Tree, ( motor_run_direct(outA, 40), motor_duty(outA, D1),
               motor_run_direct(outA, -30), motor_duty(outA, D2),
               motor_stop(outA), Ds = [D1, D2] )).
test(sets_the_duty_then_commands, true(W == [command='run-direct', duty_cycle_sp='33'])) :-
    plain(( motor_run_direct(outB, 100/3), written(outB, W) )).
test(beyond_100_percent_or_absent_it_fails_and_writes_nothing,
     [ forall(( member(Port-P0, [outB-101, outB-(-101), outB-inf, outB-nan, outC-5]),
                evaluated(P0, P) )),
       true(W == []) ]) :-
    plain(( \+ motor_run_direct(Port, P), written(W) )).
test(what_is_no_number_throws,
     [ forall(member(Goal-Error, [ motor_run_direct(outB, _)-instantiation_error,
                                   motor_run_direct(_, 5)-instantiation_error,
                                   motor_run_direct(outB, x)-type_error(evaluable, _) ])),
       error(Error, _) ]) :-
    plain(Goal).

:- end_tests(motor_run_direct).

:- begin_tests(named_twice).

test(throws_and_moves_nothing,
     [ forall(( member(Port, [outA, 'ev3-ports:outA']),
                member(Goal, [ motors_run([run(outA, 5), run(outB, 5), run(Port, 6)]),
                               motors_turn([move(outA, 5, 9), move(Port, 5, 9)], []),
                               motors_turn([to(outB, 5, 9), to(outA, 5, 9),
                                            for(Port, 5, 9)], []) ]) )),
       true(P-W == outA-[]) ]) :-
    plain(( catch(Goal, error(domain_error(distinct_ports, P), _), true),
            written(W) )).

:- end_tests(named_twice).

:- begin_tests(options).

test(what_is_no_option_throws_and_moves_nothing,
     [ forall(member(Options-Error,
                     [ [tmeout(3)]-domain_error(motor_option, tmeout(3)),
                       [wait]-domain_error(motor_option, wait),
                       [colour=red]-domain_error(motor_option, colour=red),
                       [timeout(1, 2)]-domain_error(motor_option, timeout(1, 2)),
                       [wait(false), 7]-domain_error(motor_option, 7),
                       [_=3]-domain_error(motor_option, _=3),
                       [wait(false)|_]-instantiation_error,
                       [_]-instantiation_error ])),
       true(E-W == caught-[]) ]) :-
    plain(( catch(motor_run(outB, 50, 90, Options), error(Error, _), E = caught),
            written(W) )).
test(options_may_be_given_by_name_and_value, true(A == coast)) :-
    plain(( motor_run(outB, 50, 90, [stop_action=coast, wait=false]),
            get_attribute(outB, stop_action, A) )).
test(of_a_wait, error(domain_error(motor_option, wait(false)), _)) :-
    plain(motor_wait(outB, [wait(false)], _)).
test(of_a_simulation_and_nothing_is_started,
     true(E-After == caught-Before)) :-
    with_tree(plain, ( ev3_sysfs(Before),
                       catch(sim_start(room, [klock(virtual)]),
                             error(domain_error(sim_option, klock(virtual)), _), E = caught),
                       ev3_sysfs(After) )).

:- end_tests(options).

:- begin_tests(linear_actuator).

test(is_found, [forall(tree(Tree)), true(Ps == [outD])]) :-
    linear(Tree, findall(P, linear_actuator(P), Ps)).
test(moves_by_millimetres) :-
    linear(simulator, ( motor_run(outD, 80, 20), motor_position(outD, P1), near(P1, 20.0, 1),
                   motor_run(outD, 80, -10), motor_position(outD, P2), near(P2, 10.0, 1),
                   motor_run_to(outD, 100, 3), motor_position(outD, P3), near(P3, 3.0, 1) )).
test(is_stopped_at_its_end_with_a_warning,
     true(Ws == [ev3dev(stalled([outD]))])) :-
    linear(simulator, warnings(\+ motor_run(outD, 100, -30), Ws)).
test(millimetres_become_counts, true(D-P == '40'-10.0)) :-
    linear(plain, ( motor_run(outD, 50, 20, [wait(false)]),
                    get_attribute(outD, position_sp, D),
                    put_attribute(outD, position, 20), motor_position(outD, P) )).

:- end_tests(linear_actuator).
