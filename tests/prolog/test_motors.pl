:- use_module('../support/trees').
:- use_module('../support/old_prolog').
:- use_module(library(ev3dev/events), [every/2, event_cancel/1]).

:- begin_tests(each_predicate).
test(fails_without_a_motor,
     [ forall(( tree(Tree),
                member(Goal, [ motor_run(outB, 50), motor_run(outB, 50, 90),
                               motor_start(outB), run_forever(outB, 300),
                               speed_adjust(50, outB, _), motor_stop(outB),
                               motor_reset(outB) ]) )),
       fail ]) :-
    with_tree(Tree, [], Goal).
test(throws_for_what_is_unbound,
     [ forall(( tree(Tree),
                member(Goal, [ motor_run(_, 50), motor_run(outB, _),
                               motor_start(_), speed_adjust(_, outB, _),
                               motor_stop(_), motor_reset(_) ]) )),
       error(instantiation_error, _) ]) :-
    with_tree(Tree, Goal).
:- end_tests(each_predicate).

% ---------------- SPEED

:- begin_tests(motor_run_2).
test(sets_speed_in_percent_then_commands,
     [forall(tree(Tree)), true(W == [command='run-forever', speed_sp='525'])]) :-
    with_tree(Tree, ( motor_run(outB, 50),
                      written(outB, W) )).
test(rounds_down,
     [ forall(( tree(Tree),
                member(Percent-Counts, [25-'262', -25-'-263', 33.3-'349', 0-'0',
                                        100-'1050', -100-'-1050', -0.0-'0']) )),
       true(S == Counts) ]) :-
    with_tree(Tree, ( motor_run(outB, Percent),
                      get_attribute(outB, speed_sp, S) )).
test(takes_either_spelling_of_a_port, [forall(tree(Tree))]) :-
    with_tree(Tree, ( motor_run('ev3-ports:outB', 50),
                      get_attribute(outB, speed_sp, '525') )).
test(takes_an_expression_for_speed, [forall(tree(Tree))]) :-
    with_tree(Tree, ( motor_run(outB, min(50, 100 / 4)),
                      get_attribute(outB, speed_sp, '262') )).
test(fails_at_an_impossible_speed_and_writes_nothing,
     [ forall(( tree(Tree),
                member(Speed0, [101, -101, 1.0e308, -1.0e308, inf, nan, 10**400]),
                evaluated(Speed0, Speed) )),
       true(W == []) ]) :-
    with_tree(Tree, ( \+ motor_run(outB, Speed),
                      written(W) )).
test(throws_for_a_speed_that_is_no_number,
     [ forall(( tree(Tree), member(Speed, [fast, f(x), 1 + fast]) )),
       error(type_error(evaluable, _), _) ]) :-
    with_tree(Tree, motor_run(outB, Speed)).
:- end_tests(motor_run_2).

:- begin_tests(motors_run).
test(runs_each_at_its_speed,
     [forall(tree(Tree)), true([B, C, D] == ['525', '-105', '0'])]) :-
    with_tree(Tree, ( motors_run([run(outB, 50), run(outC, -10)]),
                      get_attribute(outB, speed_sp, B),
                      get_attribute(outC, speed_sp, C),
                      get_attribute(outD, speed_sp, D) )).
test(runs_none_unless_all_can, [ forall(( tree(Tree),
                                          member(Run, [run(outC, 101), run(outE, 5)]) )),
                                 true(W == []) ]) :-
    with_tree(Tree, ( \+ motors_run([run(outB, 50), Run]),
                      written(W) )).
test(a_partial_list_throws_and_runs_none,
     [forall(tree(Tree)), true(W == [])]) :-
    with_tree(Tree, ( catch(motors_run([run(outB, 50)|_]), error(instantiation_error, _), true),
                      written(W) )).
test(speeds_may_be_expressions,
     [forall(tree(Tree)), true([B, C] == ['210', '-105'])]) :-
    with_tree(Tree, ( motors_run([run(outB, 10+10), run(outC, -max(5, 10))]),
                      get_attribute(outB, speed_sp, B),
                      get_attribute(outC, speed_sp, C) )).
test(what_is_no_run_throws_and_runs_none,
     [ forall(( tree(Tree),
                member(Runs-Error,
                       [ foo-type_error(list, _),
                         [foo]-domain_error(motor_run, foo),
                         [run(outB)]-domain_error(motor_run, run(outB)),
                         [go(outB, 20)]-domain_error(motor_run, go(outB, 20)),
                         [move(outB, 5, 9)]
                         -domain_error(motor_run, move(outB, 5, 9)),
                         [_]-instantiation_error,
                         [run(outB, _)]-instantiation_error,
                         [run(_, 5)]-instantiation_error,
                         [run(outB, fast)]-type_error(evaluable, fast/0),
                         [run(1, 5)]-type_error(_, _) ]) )),
       true(E-W == caught-[]) ]) :-
    with_tree(Tree, ( catch(motors_run([run(outC, 5)|Runs]), error(Error, _),
                            E = caught),
                      written(W) )).
:- end_tests(motors_run).

:- begin_tests(motor_start).
test(runs_at_the_speed_set_before,
     [forall(tree(Tree)), true(W == [command='run-forever', speed_sp='300'])]) :-
    with_tree(Tree, ( speed_sp(outB, 300),
                      motor_start(outB),
                      written(outB, W) )).
:- end_tests(motor_start).

:- begin_tests(run_forever).
test(takes_counts_a_second,
     [forall(tree(Tree)), true(W == [command='run-forever', speed_sp='-300'])]) :-
    with_tree(Tree, ( run_forever(outB, -600 / 2),
                      written(outB, W) )).
test(rounds, [forall(tree(Tree)), true(S == '301')]) :-
    with_tree(Tree, ( run_forever(outB, 300.6),
                      get_attribute(outB, speed_sp, S) )).
test(fails_beyond_max_speed_and_writes_nothing,
     [ forall(( tree(Tree),
                member(Speed0, [1051, -1051, 10**400, inf, nan]),
                evaluated(Speed0, Speed) )),
       true(W == []) ]) :-
    with_tree(Tree, ( \+ run_forever(outB, Speed),
                      written(W) )).
test(throws_for_what_is_no_number,
     [ forall(( tree(Tree),
                member(Speed-Error, [ _-instantiation_error,
                                      fast-type_error(evaluable, _) ]) )),
       error(Error, _) ]) :-
    with_tree(Tree, run_forever(outB, Speed)).
:- end_tests(run_forever).

:- begin_tests(speed_adjust).
test(is_the_papers_formula,
     [ forall(( tree(Tree),
                member(Percent-Counts, [50-525, 33-346, -33-(-347), 0-0, 10*5-525]) )),
       true(S == Counts) ]) :-
    with_tree(Tree, speed_adjust(Percent, outB, S)).
test(an_unbound_port_enumerates,
     [forall(tree(Tree)), all(P-S == [outA-780, outB-525, outC-525, outD-525])]) :-
    with_tree(Tree, speed_adjust(50, P, S)).
:- end_tests(speed_adjust).

% ---------------- STOP

:- begin_tests(stop).
test(brakes,
     [forall(tree(Tree)), true(W == [command=stop, stop_action=brake])]) :-
    with_tree(Tree, ( motor_stop(outB),
                      written(outB, W) )).
test(stops_as_asked, [ forall(( tree(Tree),
                                member(Action, [coast, brake, hold]) )),
                       true(A-C == Action-stop) ]) :-
    with_tree(Tree, ( motor_stop('ev3-ports:outB', Action),
                      get_attribute(outB, stop_action, A),
                      get_attribute(outB, command, C) )).
test(refuses_another_action,
     [ forall(( tree(Tree),
                member(Action-Error, [ _-instantiation_error,
                                       jump-domain_error(stop_action, jump),
                                       7-type_error(_, 7) ]) )),
       true(W == []) ]) :-
    with_tree(Tree, ( catch(motor_stop(outB, Action), error(Error, _), true),
                      written(W) )).
test(all_motors_are_stopped_whoever_started_them,
     [forall(tree(Tree)), true(Cs == [outA-stop, outB-stop, outC-stop, outD-stop])]) :-
    with_tree(Tree, ( put_attribute(outD, command, 'run-forever'),
                      stop_all_motors,
                      findall(P-C, ( tacho_motor(P), get_attribute(P, command, C) ), Cs) )).
test(one_that_was_just_plugged_in_is_waited_for,
     [forall(member(S, [0.4, 0.5, 0.8])), true(States-Found == []-true)]) :-
    with_sim([], ( motor_run(outB, 50),
                   sim_plug(outD, 'lego-ev3-l-motor'),
                   sim_wait(S),
                   stop_all_motors,
                   motor_states(outB, States),
                   ( tacho_motor(outD) -> Found = true ; Found = false ) )).
test(to_stop_no_motor_is_no_failure, [forall(tree(Tree))]) :-
    with_tree(Tree, [], stop_all_motors).
test(reset_is_left_to_the_motor,
     [forall(tree(Tree)), true(W == [command=reset])]) :-
    with_tree(Tree, ( motor_reset(outB),
                      written(outB, W) )).
:- end_tests(stop).

% ---------------- MOVES

:- begin_tests(motor_run_3).
test(writes_what_the_command_depends_on,
     [forall(tree(Tree)), true(W == ['run-to-rel-pos', '360', '525', hold])]) :-
    with_tree(Tree, obeying([outB],
                            ( motor_run(outB, 50, 360),
                              maplist(get_attribute(outB),
                                      [command, position_sp, speed_sp, stop_action],
                                      W) ))).
test(writes_nothing_else,
     [ forall(tree(Tree)),
       true(W == [ command='run-to-rel-pos', position_sp='3600',
                   speed_sp='525', stop_action=hold ]) ]) :-
    with_tree(Tree, ( motor_run(outB, 50, 3600, [wait(false)]),
                      written(outB, W) )).
test(sign_of_speed_times_sign_of_angle_is_the_direction,
     [ forall(( tree(Tree),
                member(Speed-Angle-Distance,
                       [ 50-90-'90', -50-90-'-90', 50-(-90)-'-90', -50-(-90)-'90' ]) )),
       true(D-S == Distance-'525') ]) :-
    with_tree(Tree, ( motor_run(outB, Speed, Angle, [wait(false)]),
                      get_attribute(outB, position_sp, D),
                      get_attribute(outB, speed_sp, S) )).
test(degrees_become_counts, [forall(tree(Tree)), true(D == '180')]) :-
    with_tree(Tree, ( put_attribute(outB, count_per_rot, 720),
                      motor_run(outB, 50, 90, [wait(false)]),
                      get_attribute(outB, position_sp, D) )).
test(speed_and_angle_are_expressions,
     [forall(tree(Tree)), true(D-S == '45'-'262')]) :-
    with_tree(Tree, ( motor_run(outB, 100 / 4, 90 / 2, [wait(false)]),
                      get_attribute(outB, position_sp, D),
                      get_attribute(outB, speed_sp, S) )).
test(waits_until_the_motor_is_there, [forall(tree(Tree))]) :-
    with_tree(Tree, obeying([outB],
                            ( motor_run(outB, 50, 360),
                              settle(Tree),
                              get_attribute(outB, position, P) ))),
    atom_number(P, Position),
    near(Position, 360, 10).
test(an_impossible_move_fails_and_writes_nothing,
     [ forall(( tree(Tree),
                member(Speed0-Angle0,
                       [ 0-90, 101-90, -101-90, inf-90, nan-90, 10**400-90,
                         50-1.0e308, 50-inf, 50-nan, 50-10**400, 50-(-10**400),
                         0.01-90 ]),
                evaluated(Speed0, Speed), evaluated(Angle0, Angle) )),
       true(W == []) ]) :-
    with_tree(Tree, ( \+ motor_run(outB, Speed, Angle),
                      written(W) )).
test(what_is_no_number_throws,
     [ forall(( tree(Tree),
                member(Speed-Angle-Error,
                       [ _-90-instantiation_error, 50-_-instantiation_error,
                         fast-90-type_error(evaluable, _),
                         50-far-type_error(evaluable, _) ]) )),
       true(W == []) ]) :-
    with_tree(Tree, ( catch(motor_run(outB, Speed, Angle), error(Error, _), true),
                      written(W) )).
test(a_motor_that_stops_short_of_its_end_fails,
     [forall(tree(Tree)), true(Ended-Ws == fails-[])]) :-
    with_tree(Tree, ( runs(outB),
                      later(0.05, stops(outB)),
                      warnings(( motor_run(outB, 50, 36000)
                               -> Ended = succeeds ; Ended = fails ), Ws) )).
test(a_slow_motor_is_not_taken_for_a_blocked_one,
     [forall(tree(Tree)), true(Ws == [])]) :-
    with_tree(Tree, ( obeying([outB], warnings(motor_run(outB, 1, 20), Ws)),
                      get_attribute(outB, position, P) )),
    atom_number(P, Position),
    near(Position, 20, 10).
% Nothing moves.
test(where_nothing_ever_moves_a_move_is_done,
     [true(P == '360')]) :-
    with_tree(plain, ( motor_run(outB, 50, 360),
                       get_attribute(outB, position_sp, P) )).
test(moves_count_from_where_the_motor_is,
     [forall(tree(Tree)), true(P == '90')]) :-
    with_tree(Tree, ( put_attribute(outB, position, 1000),
                      motor_run(outB, 50, 90),
                      get_attribute(outB, position_sp, P) )).
test(a_stop_from_another_thread_ends_the_move_and_fails,
     [forall(tree(Tree)), true(Ended-Ws == fails-[])]) :-
    with_tree(Tree, ( runs(outB),
                      thread_self(Me),
                      meanwhile(( eventually(get_attribute(outB, command, 'run-to-rel-pos')),
                                  motor_stop(outB),
                                  rests(Me, outB) ),
                                warnings(( motor_run(outB, 5, 3600000)
                                         -> Ended = succeeds ; Ended = fails ), Ws)) )).
test(a_blocked_motor_is_stopped_and_fails_with_a_warning,
     [forall(tree(Tree)), true(C-Ws == stop-[ev3dev(stalled([outB]))])]) :-
    with_tree(Tree, ( block(outB),
                      warnings(motor_run(outB, 50, 360), Ws),
                      get_attribute(outB, command, C) )).
test(a_loop_says_once_that_a_motor_is_blocked,
     true(Ws == [ev3dev(stalled([outB]))])) :-
    with_tree(simulator, ( block(outB),
                           warnings(( between(1, 3, _), motor_run(outB, 50, 360) ), Ws) )).
test(another_tree_has_its_own_warning,
     [forall(member(Tree, [simulator, plain])), true(Ws = [_, _])]) :-
    warnings(forall(member(_, [1, 2]),
                    with_tree(Tree, ( block(outB), ignore(motor_run(outB, 50, 360)) ))), Ws).
:- end_tests(motor_run_3).

:- begin_tests(motor_run_4).
test(the_stop_action_is_written_before,
     [ forall(( tree(Tree),
                member(Action, [coast, brake, hold]) )), true(A == Action) ]) :-
    with_tree(Tree, ( motor_run(outB, 50, 90, [stop_action(Action), wait(false)]),
                      get_attribute(outB, stop_action, A) )).
test(without_waiting_it_runs_on,
     [forall(tree(Tree)), true(C == 'run-to-rel-pos')]) :-
    with_tree(Tree, ( runs(outB),
                      motor_run(outB, 50, 90, [wait(false)]),
                      get_attribute(outB, command, C) )).
test(ramps_are_put_back_after_the_start,
     [forall(tree(Tree)), true(Up-Down == '11'-'22')]) :-
    with_tree(Tree, ( put_attribute(outB, ramp_up_sp, 11),
                      put_attribute(outB, ramp_down_sp, 22),
                      motor_run(outB, 50, 90, [ramp_up(300), ramp_down(400), wait(false)]),
                      get_attribute(outB, ramp_up_sp, Up),
                      get_attribute(outB, ramp_down_sp, Down) )).
test(a_time_that_is_up_stops_the_motor_and_fails,
     [forall(tree(Tree)), true(C == stop)]) :-
    with_tree(Tree, ( runs(outB),
                      \+ motor_run(outB, 50, 3600, [timeout(0.05)]),
                      get_attribute(outB, command, C) )).
test(a_time_long_enough_changes_nothing, [forall(tree(Tree))]) :-
    with_tree(Tree, obeying([outB], motor_run(outB, 50, 360, [timeout(60)]))).
test(a_wrong_option_throws_and_writes_nothing,
     [ forall(( tree(Tree),
                member(Options-Error,
                       [ _-instantiation_error,
                         foo-type_error(list, foo),
                         [wait(maybe)]-type_error(_, maybe),
                         [wait(_)]-instantiation_error,
                         [stop_action(jump)]-domain_error(stop_action, jump),
                         [stop_action(_)]-instantiation_error,
                         [stop_action(1)]-type_error(_, 1),
                         [ramp_up(-1)]-domain_error(ramp_up_sp, -1),
                         [ramp_up(60001)]-domain_error(ramp_up_sp, 60001),
                         [ramp_down(-1)]-domain_error(ramp_down_sp, -1),
                         [ramp_down(slow)]-type_error(integer, slow),
                         [ramp_up(_)]-instantiation_error,
                         [timeout(-1)]-domain_error(timeout, -1),
                         [timeout(soon)]-type_error(evaluable, soon/0),
                         [timeout(_)]-instantiation_error ]) )),
       true(Caught-W == caught-[]) ]) :-
    with_tree(Tree, ( catch(motor_run(outB, 50, 90, Options), error(Error, _), Caught = caught),
                      written(W) )).
:- end_tests(motor_run_4).

:- begin_tests(motors_turn).
test(each_motor_makes_its_move,
     [forall(tree(Tree)), true([B, C] == ['90', '-45'])]) :-
    with_tree(Tree, ( motors_turn([move(outB, 50, 90), move(outC, 20, -45)], [wait(false)]),
                      get_attribute(outB, position_sp, B),
                      get_attribute(outC, position_sp, C) )).
test(waits_for_all, [forall(tree(Tree))]) :-
    with_tree(Tree, obeying([outB, outC],
                            motors_turn([move(outB, 50, 90), move(outC, 50, 90)], []))).
test(moves_none_unless_all_can,
     [ forall(( tree(Tree),
                member(Move, [move(outC, 101, 9), move(outE, 50, 9), move(outC, 0, 9)]) )),
       true(W == []) ]) :-
    with_tree(Tree, ( \+ motors_turn([move(outB, 50, 90), Move], []),
                      written(W) )).
test(what_they_are_told_may_be_expressions,
     [forall(tree(Tree)), true([A, B, C, D] == ['210', '60', '-45', '1500'])]) :-
    with_tree(Tree, ( motors_turn([ move(outB, 10+10, 120/2), to(outC, 20, -(45)),
                                    for(outD, 4*5, 3/2)
                                  ], [wait(false)]),
                      get_attribute(outB, speed_sp, A),
                      get_attribute(outB, position_sp, B),
                      get_attribute(outC, position_sp, C),
                      get_attribute(outD, time_sp, D) )).
test(what_is_no_list_of_moves_throws,
     [ forall(( tree(Tree),
                member(Moves-Error,
                       [ _-instantiation_error,
                         [_|_]-instantiation_error,
                         [_]-instantiation_error,
                         foo-type_error(_, _),
                         [foo]-domain_error(motor_move, foo),
                         [move(outB, 5)]
                         -domain_error(motor_move, move(outB, 5)),
                         [run(outB, 5)]-domain_error(motor_move, run(outB, 5)),
                         [by(outB, 5, 9)]
                         -domain_error(motor_move, by(outB, 5, 9)),
                         [move(outB, _, 9)]-instantiation_error,
                         [to(outB, 5, _)]-instantiation_error,
                         [for(outB, 5, long)]-type_error(evaluable, long/0),
                         [for(outB, 5, -1)]-domain_error(seconds, _),
                         [move(1, 5, 9)]-type_error(_, _) ]) )),
       error(Error, _) ]) :-
    with_tree(Tree, motors_turn(Moves, [])).
:- end_tests(motors_turn).

% ---------------- WAITS

:- begin_tests(motor_wait).
test(reached, [forall(tree(Tree))]) :-
    with_tree(Tree, obeying([outB],
                            ( motor_run(outB, 50, 90, [wait(false)]),
                              motor_wait(outB, [], R),
                              assertion(R == reached) ))).
test(stalled, [forall(tree(Tree)), true(R-C == stalled-'run-to-rel-pos')]) :-
    with_tree(Tree, ( block(outB),
                      motor_run(outB, 50, 90, [wait(false)]),
                      motor_wait(outB, [], R),
                      get_attribute(outB, command, C) )).
test(timeout, [forall(tree(Tree)), true(R == timeout)]) :-
    with_tree(Tree, ( runs(outB),
                      motor_run(outB, 50, 3600, [wait(false)]),
                      motor_wait(outB, [timeout(0.05)], R) )).
test(unplugged, [forall(tree(Tree)), true(R == unplugged)]) :-
    with_tree(Tree, ( runs(outB),
                      motor_run(outB, 50, 36000, [wait(false)]),
                      later(0.05, unplug(outB)),
                      motor_wait(outB, [], R) )).
test(stopped, [forall(tree(Tree)), true(R == stopped)]) :-
    with_tree(Tree, ( runs(outB),
                      motor_run(outB, 50, 36000, [wait(false)]),
                      later(0.05, stops(outB)),
                      motor_wait(outB, [], R) )).
test(a_motor_that_runs_for_ever_can_only_be_stopped,
     [forall(tree(Tree)), true(R == stopped)]) :-
    with_tree(Tree, ( runs(outB),
                      motor_run(outB, 50),
                      later(0.05, stops(outB)),
                      motor_wait(outB, [], R) )).
test(several_motors_are_waited_for_together,
     [forall(tree(Tree)), true(R == reached)]) :-
    with_tree(Tree, obeying([outB, outC],
                            ( motor_run(outB, 50, 90, [wait(false)]),
                              motor_run(outC, 50, 90, [wait(false)]),
                              motor_wait([outB, 'ev3-ports:outC'], [], R) ))).
test(one_that_is_unplugged_ends_the_wait_for_all,
     [forall(tree(Tree)), true(R == unplugged)]) :-
    with_tree(Tree, ( runs(outB),
                      runs(outC),
                      motors_run([run(outB, 20), run(outC, 20)]),
                      later(0.05, unplug(outC)),
                      motor_wait([outB, outC], [], R) )).
test(no_motors_are_there_at_once,
     [forall(tree(Tree)), true(R == reached)]) :-
    with_tree(Tree, motor_wait([], [], R)).
test(an_absent_motor_fails, [forall(( tree(Tree),
                                      member(Ports, [outE, [outB, outE]]) )), fail]) :-
    with_tree(Tree, motor_wait(Ports, [], _)).
test(fails_for_another_reason, [forall(tree(Tree)), fail]) :-
    with_tree(Tree, motor_wait(outB, [], elsewhere)).
test(a_wrong_argument_throws,
     [ forall(( tree(Tree),
                member(Ports-Options-Error,
                       [ _-[]-instantiation_error,
                         [outB, _]-[]-instantiation_error,
                         7-[]-type_error(_, 7),
                         [outB|_]-[]-_,
                         outB-_-instantiation_error,
                         outB-foo-type_error(list, foo),
                         outB-[timeout(-1)]-domain_error(timeout, -1),
                         outB-[timeout(x)]-type_error(evaluable, x/0) ]) )),
       error(Error, _) ]) :-
    with_tree(Tree, motor_wait(Ports, Options, _)).
:- end_tests(motor_wait).

:- begin_tests(motor_wait_flag).
test(while_it_runs, [forall(tree(Tree))]) :-
    with_tree(Tree, ( put_attribute(outB, state, 'running ramping'),
                      later(0.05, put_attribute(outB, state, holding)),
                      motor_wait_while(outB, running),
                      get_attribute(outB, state, holding) )).
test(until_it_holds, [forall(tree(Tree))]) :-
    with_tree(Tree, ( put_attribute(outB, state, running),
                      later(0.05, put_attribute(outB, state, holding)),
                      motor_wait_until(outB, holding),
                      get_attribute(outB, state, holding) )).
test(at_once_if_it_is_so_already,
     [ forall(( tree(Tree),
                member(Goal, [ motor_wait_until(outB, stalled),
                               motor_wait_until('ev3-ports:outB', running),
                               motor_wait_while(outB, holding) ]) )) ]) :-
    with_tree(Tree, ( put_attribute(outB, state, 'running stalled'),
                      Goal )).
test(each_flag_is_known,
     [ forall(( tree(Tree),
                member(F, [running, ramping, holding, overloaded, stalled]) )) ]) :-
    with_tree(Tree, motor_wait_while(outB, F)).
test(part_of_a_word_is_no_flag,
     [forall(tree(Tree)), error(domain_error(motor_state, run), _)]) :-
    with_tree(Tree, motor_wait_until(outB, run)).
test(an_absent_motor_fails,
     [ forall(( tree(Tree),
                member(Goal, [ motor_wait_while(outE, running),
                               motor_wait_until(outE, running) ]) )), fail ]) :-
    with_tree(Tree, Goal).
test(unplugged_meanwhile_throws,
     [forall(tree(Tree)), error(existence_error(motor, outB), _)]) :-
    with_tree(Tree, ( runs(outB),
                      motor_run(outB, 20),
                      later(0.05, unplug(outB)),
                      motor_wait_while(outB, running) )).
test(a_wrong_argument_throws,
     [ forall(( tree(Tree),
                member(Goal-Error,
                       [ motor_wait_while(_, running)-instantiation_error,
                         motor_wait_while(outB, _)-instantiation_error,
                         motor_wait_until(outB, 7)-type_error(atom, 7),
                         motor_wait_until(7, running)-type_error(_, 7) ]) )),
       error(Error, _) ]) :-
    with_tree(Tree, Goal).
% plunit of 9.2.9 takes a time limit that gets out for its own.
test(a_time_limit_gets_through,
     [forall(tree(Tree)), true(Ball == time_limit_exceeded)]) :-
    with_tree(Tree, ( runs(outB),
                      motor_run(outB, 20),
                      catch(call_with_time_limit(0.05,
                                                 motor_wait_while(outB, running)),
                            Ball, true) )).
test(a_signal_that_does_not_throw_goes_on_waiting, [forall(tree(Tree))]) :-
    with_tree(Tree, ( runs(outB),
                      motor_run(outB, 20),
                      thread_self(Me),
                      later(0.05, thread_signal(Me, stops(outB))),
                      motor_wait_while(outB, running) )).
:- end_tests(motor_wait_flag).

% ---------------- INTERRUPTED

:- begin_tests(interrupted).
% On a busy machine the limit may come before the motor has started.
test(a_time_limit_stops_the_motor,
     [ forall(tree(Tree)),
       true(( E == time_limit_exceeded, memberchk(C, [stop, '']) )) ]) :-
    with_tree(Tree, ( runs(outB),
                      catch(call_with_time_limit(0.05, motor_run(outB, 5, 3600000)), E, true),
                      get_attribute(outB, command, C) )).
test(a_signal_stops_the_motor,
     [forall(tree(Tree)), true(E-C == enough-stop)]) :-
    with_tree(Tree, ( runs(outB),
                      thread_self(Me),
                      later(0.05, thread_signal(Me, throw(enough))),
                      catch(motor_run(outB, 50, 36000), E, true),
                      get_attribute(outB, command, C) )).
test(unplugged_on_the_way_stops_the_others,
     [forall(tree(Tree)), true(F-C == existence_error(motor, outB)-stop)]) :-
    with_tree(Tree, ( runs(outB),
                      runs(outC),
                      later(0.05, unplug(outB)),
                      catch(motors_turn([move(outB, 50, 36000), move(outC, 50, 36000)], []),
                            error(F, context(_/_, _)), true),
                      get_attribute(outC, command, C) )).
:- end_tests(interrupted).

% ---------------- TIMES AND PLACES

plain(Goal) :-
    with_tree(plain, [outA-'lego-ev3-m-motor', outB-'lego-ev3-l-motor'], once(Goal)).

% A linear actuator at outD of Tree, drawn in.
linear(Tree, Goal) :-
    on(Tree, ( equip(Tree, [outD-'act-l12-ev3-50']),
               motor_position(outD, 0),
               Goal )).

:- begin_tests(motor_run_timed).
test(runs_for_its_time_and_brakes, [forall(behaving(Tree)), true(Ss-R == []-stopped)]) :-
    on(Tree, ( sim_time(T0), motor_run_timed(outA, 50, 0.5),
               took(Tree, T0, 0.5, 0.15), motor_states(outA, Ss),
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
    plain(( runs(outB),
            thread_self(Me),
            meanwhile(( eventually(get_attribute(outB, command, 'run-timed')),
                        rests(Me, outB) ),
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
    on(Tree, ( motor_run_to(outA, 50, 90), settle(Tree),
               motor_run(outA, 50, 90), settle(Tree),
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

:- begin_tests(motor_run_until_stalled).
% outA is held fast a second later.
arm(Goal) :-
    with_sim([], ( sim_at(1, sim_jam(outA, true)), Goal )).

test(stops_where_it_is_blocked, [true(Ss-D == []-0)]) :-
    arm(( motor_run_until_stalled(outA, dps(90)), ev3_time(T), near(T, 1.5, 0.3),
          position(outA, P), near(P, 90, 10), motor_states(outA, Ss), motor_duty(outA, D) )).
test(the_sign_of_the_speed_is_the_direction,
     [ forall(member(Options, [[], [duty_limit(20)]])) ]) :-
    arm(( motor_run_until_stalled(outA, -20, Options), position(outA, P), P < -90 )).
test(pushes_no_harder_than_its_limit,
     [ forall(member(Options-Hardest, [[duty_limit(30)]-30, []-100])), true(D == Hardest) ]) :-
    arm(( nb_setval(duty, 0),
          every(0.02, ( motor_duty(outA, D0), nb_getval(duty, D1), D2 is max(D0, D1),
                        nb_setval(duty, D2) )),
          motor_run_until_stalled(outA, dps(300), Options), event_cancel(_),
          nb_getval(duty, D) )).
test(the_stop_action_can_be_chosen, [true(Ss == [holding])]) :-
    arm(( motor_run_until_stalled(outA, 20, [stop_action(hold)]), motor_states(outA, Ss) )).
test(one_that_nothing_blocks_fails_after_its_timeout, [true(Ss == [])]) :-
    with_sim([], ( \+ motor_run_until_stalled(outA, 20, [timeout(2)]),
                   motor_states(outA, Ss), ev3_time(T), near(T, 2, 0.1) )).
test(who_leaves_it_stops_the_motor, [true(Ss == [])]) :-
    with_sim([], ( for_seconds(1, motor_run_until_stalled(outA, 20)),
                   motor_states(outA, Ss) )).
test(who_stops_the_motor_makes_it_fail, [fail]) :-
    with_sim([], ( sim_at(1, motor_stop(outA)), motor_run_until_stalled(outA, 20) )).
test(an_unplugged_motor_throws, error(existence_error(motor, outA), _)) :-
    with_sim([], ( sim_at(1, sim_unplug(outA)), motor_run_until_stalled(outA, 20) )).
test(an_impossible_run_fails_and_writes_nothing,
     [ forall(member(Port-Speed-Options,
                     [ outB-0-[], outB-dps(0)-[duty_limit(30)], outB-101-[], outC-5-[],
                       outC-5-[duty_limit(30)] ])),
       true(W == []) ]) :-
    plain(( \+ motor_run_until_stalled(Port, Speed, Options), written(W) )).
test(a_wrong_argument_throws_and_writes_nothing,
     [ forall(member(Goal-Error,
                     [ motor_run_until_stalled(_, 5)-instantiation_error,
                       motor_run_until_stalled(outB, _)-instantiation_error,
                       motor_run_until_stalled(outB, x)-type_error(evaluable, _),
                       motor_run_until_stalled(outB, 5, [duty_limit(0)])-domain_error(duty_limit, 0),
                       motor_run_until_stalled(outB, 5, [duty_limit(101)])
                       -domain_error(duty_limit, 101),
                       motor_run_until_stalled(outB, 5, [duty_limit(x)])-type_error(evaluable, _),
                       motor_run_until_stalled(outB, 5, [stop_action(jump)])
                       -domain_error(stop_action, jump),
                       motor_run_until_stalled(outB, 5, [timeout(-1)])-domain_error(timeout, -1),
                       motor_run_until_stalled(outB, 5, [ramp_up(9)])
                       -domain_error(motor_option, ramp_up(9)) ])),
       true(E-W == caught-[]) ]) :-
    plain(( catch(Goal, error(Error, _), E = caught), written(W) )).
:- end_tests(motor_run_until_stalled).

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

:- begin_tests(units).
test(a_speed_may_have_a_unit,
     [ forall(( tree(Tree),
                member(Speed-Counts, [ dps(90)-90, rps(1/2)-180, rpm(20+10)-180,
                                       dps(-90)-(-90), dps(33.4)-33 ]) )),
       true(Written == Counts) ]) :-
    with_tree(Tree, ( motor_run(outB, Speed), motor_attribute(outB, speed_sp, Written) )).
test(an_angle_may_be_in_rotations,
     [ forall(tree(Tree)), true([A, B, V] == [720, -180, 360]) ]) :-
    with_tree(Tree, ( motor_run(outB, 20, rotations(1+1), [wait(false)]),
                      motor_attribute(outB, position_sp, A),
                      motor_run_to(outC, rps(1), rotations(-0.5), [wait(false)]),
                      motor_attribute(outC, position_sp, B),
                      motor_attribute(outC, speed_sp, V) )).
test(each_of_several_may_have_its_own,
     [ forall(tree(Tree)), true([A, B] == [180, 525]) ]) :-
    with_tree(Tree, ( motors_run([run(outB, rpm(30)), run(outC, 50)]),
                      motor_attribute(outB, speed_sp, A),
                      motor_attribute(outC, speed_sp, B) )).
test(a_timed_run_has_one, [ forall(tree(Tree)), true(A == 180) ]) :-
    with_tree(Tree, ( motor_run_timed(outB, rpm(30), 0.1, [wait(false)]),
                      motor_attribute(outB, speed_sp, A) )).
test(beyond_what_the_motor_can_nothing_moves,
     [ forall(( tree(Tree), member(Speed, [dps(1051), rps(-3), rpm(176)]) )),
       true(W == []) ]) :-
    with_tree(Tree, ( \+ motor_run(outB, Speed), \+ motor_run(outB, Speed, 90),
                      written(W) )).
test(the_hint_names_the_percentage, error(domain_error(speed, 200), _)) :-
    current_prolog_flag(ev3dev_hints, Before),
    setup_call_cleanup(
        set_prolog_flag(ev3dev_hints, error),
        with_tree(simulator, motor_run(outB, dps(2100))),
        set_prolog_flag(ev3dev_hints, Before)).
test(what_is_no_number_throws,
     [ forall(( tree(Tree),
                member(Goal-Error,
                       [ motor_run(outB, rpm(fast))-type_error(evaluable, fast/0),
                         motor_run(outB, rpm(_))-instantiation_error,
                         motor_run(outB, mph(1))-type_error(evaluable, mph/1),
                         motor_run(outB, cm_per_s(1))-type_error(evaluable, cm_per_s/1),
                         motor_run(outB, 20, rotations(a))-type_error(evaluable, a/0),
                         motors_turn([for(outB, 20, rotations(1))], [])
                             -type_error(evaluable, rotations/1) ]) )),
       error(Error, _) ]) :-
    with_tree(Tree, Goal).
:- end_tests(units).
