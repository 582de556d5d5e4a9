:- use_module('../support/trees').
:- use_module('../support/child').
:- use_module('../support/old_prolog').

% A motor without sensor at outA of Tree.
in_tree(Tree, Goal) :-
    on(Tree, ( ( Tree == plain -> unplug(outA) ; true ),
               equip(Tree, [outA-'rcx-motor']),
               Goal )).

plain(Goal) :-
    with_tree(plain, [outA-'rcx-motor'], once(Goal)).

:- begin_tests(dc_motor).
test(is_found, [forall(tree(Tree)), true(Ports == [outA])]) :-
    in_tree(Tree, ( findall(P, dc_motor(P), Ports), dc_motor('ev3-ports:outA') )).
test(is_in_the_table_of_devices, [forall(tree(Tree))]) :-
    in_tree(Tree, with_output_to(string(Table), ev3_devices)),
    split_string(Table, "\n", "", Lines),
    member(Line, Lines),
    sub_string(Line, _, _, _, "outA"),
    !,
    sub_string(Line, _, _, _, "rcx-motor"),
    sub_string(Line, _, _, _, "duty 0"),
    !.
test(is_no_other_motor, [forall(tree(Tree)), fail]) :-
    in_tree(Tree, ( tacho_motor(outA) ; dc_motor(outB) )).
:- end_tests(dc_motor).

:- begin_tests(dc_motor_run).
test(runs_until_it_is_stopped, [forall(behaving(Tree)), true(Ss-D == []-0)]) :-
    in_tree(Tree, ( dc_motor_run(outA, 60), sim_step(0.15),
                    dc_motor_states(outA, [running]), dc_motor_duty(outA, 60),
                    dc_motor_stop(outA), sim_step(0.15),
                    dc_motor_states(outA, Ss), dc_motor_duty(outA, D) )).
test(sets_the_duty_then_commands,
     [ forall(( tree(plain),
                member(Percent-Text, [50-'50', -33.4-'-33', 99.5-'100', 100/3-'33']) )),
       true(W == [command='run-forever', duty_cycle_sp=Text]) ]) :-
    plain(( dc_motor_run(outA, Percent), written(outA, W) )).
test(direct, [forall(tree(Tree)), true(D == -20)]) :-
    in_tree(Tree, ( dc_motor_run_direct('ev3-ports:outA', -20),
                    dc_motor_attribute(outA, duty_cycle_sp, D) )).
test(direct_changes_at_once, [forall(behaving(Tree)), true(D == 70)]) :-
    in_tree(Tree, ( dc_motor_run_direct(outA, -20), sim_step(0.15),
                    dc_motor_run_direct(outA, 70), sim_step(0.15),
                    dc_motor_duty(outA, D) )).
test(beyond_100_percent_it_fails_and_writes_nothing,
     [ forall(( member(Percent0, [101, -101, 100.6, inf, nan, 10**400]),
                evaluated(Percent0, Percent),
                member(Goal, [ dc_motor_run(outA, Percent),
                               dc_motor_run_direct(outA, Percent),
                               dc_motor_run_timed(outA, Percent, 1) ]) )),
       true(W == []) ]) :-
    plain(( \+ Goal, written(outA, W) )).
test(fails_without_a_motor,
     [ forall(member(Goal, [ dc_motor_run(outB, 5), dc_motor_run_direct(outB, 5),
                             dc_motor_run_timed(outB, 5, 1), dc_motor_stop(outB),
                             dc_motor_duty(outB, _), dc_motor_states(outB, _),
                             dc_motor_polarity(outB, normal),
                             dc_motor_ramps(outB, 1, 1),
                             dc_motor_attribute(outB, state, _) ])),
       fail ]) :-
    plain(Goal).
test(what_is_no_number_throws,
     [ forall(member(Goal-Error,
                     [ dc_motor_run(outA, _)-instantiation_error,
                       dc_motor_run(outA, fast)-type_error(evaluable, _),
                       dc_motor_run(_, 5)-instantiation_error,
                       dc_motor_run(7, 5)-type_error(_, 7),
                       dc_motor_run_direct(outA, _)-instantiation_error ])),
       true(E-W == caught-[]) ]) :-
    plain(( catch(Goal, error(Error, _), E = caught), written(outA, W) )).
:- end_tests(dc_motor_run).

:- begin_tests(dc_motor_run_timed).
test(waits_and_stops, [forall(behaving(Tree)), true(Ss == [])]) :-
    in_tree(Tree, ( sim_time(T0), dc_motor_run_timed(outA, 50, 1/2),
                    took(Tree, T0, 0.5, 0.15),
                    dc_motor_states(outA, Ss) )).
test(writes_what_the_command_depends_on,
     true(W == [ command='run-timed', duty_cycle_sp='50', stop_action=coast,
                 time_sp='1500' ])) :-
    plain(( dc_motor_run_timed(outA, 50, 1.5, [wait(false), stop_action(coast)]),
            written(outA, W) )).
test(ramps_are_for_this_run_only, [forall(tree(Tree)), true(U-D == 0-0)]) :-
    in_tree(Tree, ( dc_motor_run_timed(outA, 50, 1, [ramp_up(500), wait(false)]),
                    dc_motor_ramps(outA, U, D) )).
test(a_ramp_is_followed, [forall(behaving(Tree)), true]) :-
    in_tree(Tree, ( sim_time(T0),
                    dc_motor_run_timed(outA, 50, 5, [ramp_up(2000), wait(false)]),
                    sim_step(0.25), dc_motor_duty(outA, Duty), sim_time(T),
                    Duty > 5, Duty < (T - T0) * 50 + 5 )).
test(without_waiting_it_runs_on, [forall(behaving(Tree))]) :-
    in_tree(Tree, ( dc_motor_run_timed(outA, 50, 30, [wait(false)]),
                    dc_motor_states(outA, [running|_]) )).
test(a_timeout_stops_it_and_fails, [forall(behaving(Tree)), true(Ss == [])]) :-
    in_tree(Tree, ( \+ dc_motor_run_timed(outA, 50, 30, [timeout(0.3)]),
                    sim_step(0.15), dc_motor_states(outA, Ss) )).
test(an_exception_stops_it, [forall(behaving(Tree)), true(Ss == [])]) :-
    in_tree(Tree, ( catch(call_with_time_limit(0.1,
                              ( repeat, dc_motor_run_timed(outA, 50, 60), fail )),
                          time_limit_exceeded, true),
                    sim_step(0.15), dc_motor_states(outA, Ss) )).
test(who_stops_it_makes_it_fail, [fail]) :-
    plain(( runs(outA),
            thread_self(Me),
            meanwhile(( eventually(get_attribute(outA, command, 'run-timed')),
                        rests(Me, outA) ),
                      dc_motor_run_timed(outA, 50, 30)) )).
test(a_port_that_is_put_into_another_mode_throws,
     error(existence_error(motor, outA), _)) :-
    plain(( put_attribute(outA, state, running),
            later(0.05, unplug(outA)),
            dc_motor_run_timed(outA, 50, 30) )).
test(longer_than_a_minute_fails_and_writes_nothing, true(W == [])) :-
    plain(( \+ dc_motor_run_timed(outA, 50, 60.1), written(outA, W) )).
test(a_wrong_argument_throws_and_writes_nothing,
     [ forall(member(Seconds-Options-Error,
                     [ -1-[]-domain_error(seconds, -1),
                       _-[]-instantiation_error,
                       soon-[]-type_error(evaluable, _),
                       1-[stop_action(hold)]-domain_error(stop_action, hold),
                       1-[ramp_up(10001)]-domain_error(ramp_up_sp, 10001),
                       1-[ramp_down(-1)]-domain_error(ramp_down_sp, -1),
                       1-[wait(maybe)]-type_error(_, maybe),
                       1-[speed(3)]-domain_error(motor_option, speed(3)),
                       1-_-instantiation_error ])),
       true(E-W == caught-[]) ]) :-
    plain(( catch(dc_motor_run_timed(outA, 50, Seconds, Options), error(Error, _),
                  E = caught),
            written(outA, W) )).
:- end_tests(dc_motor_run_timed).

:- begin_tests(dc_motor_stop).
test(stops_as_asked,
     [ forall(( tree(Tree), member(Action, [coast, brake]) )) ]) :-
    in_tree(Tree, ( dc_motor_run(outA, 50), dc_motor_stop(outA, Action),
                    ( Tree == plain
                    ->  get_attribute(outA, stop_action, Action),
                        get_attribute(outA, command, stop)
                    ;   sim_step(0.15), dc_motor_states(outA, [])
                    ) )).
test(brakes_by_default, true(W == [command=stop, stop_action=brake])) :-
    plain(( dc_motor_stop(outA), written(outA, W) )).
test(cannot_hold, [ forall(member(Action-Error, [ hold-domain_error(stop_action, hold),
                                                  _-instantiation_error,
                                                  7-type_error(atom, 7) ])),
                    true(E-W == caught-[]) ]) :-
    plain(( catch(dc_motor_stop(outA, Action), error(Error, _), E = caught),
            written(outA, W) )).
test(all_motors_are_stopped, [forall(behaving(Tree)), true(A-B == []-[])]) :-
    in_tree(Tree, ( dc_motor_run(outA, 50), motor_run(outB, 10), sim_step(0.2),
                    stop_all_motors, sim_step(0.2),
                    dc_motor_states(outA, A), motor_states(outB, B) )).
test(at_the_end_of_the_program,
     [ forall(member(Start, [ "dc_motor_run(outA, 20)",
                              "dc_motor_run_direct(outA, 20)",
                              "dc_motor_run_timed(outA, 20, 9, [wait(false)])",
                              "dc_motor_attribute(outA, command, 'run-forever')" ])),
       true(C == stop) ]) :-
    format(string(Text), ":- use_module(library(ev3dev)).~nmain :- ~s.", [Start]),
    plain(( tree_root(Root),
            run_program(Text, [env('EV3DEV_SYSFS'=Root), goal(main)], exit(0), _),
            get_attribute(outA, command, C) )).
:- end_tests(dc_motor_stop).

:- begin_tests(dc_motor_settings).
test(polarity, [forall(tree(Tree)), true([P1, P2] == [normal, inversed])]) :-
    in_tree(Tree, ( dc_motor_polarity(outA, P1), dc_motor_polarity(outA, inversed),
                    dc_motor_polarity(_, P2) )).
test(polarity_shows_the_sign_of_the_program, [forall(behaving(Tree)), true(D == 50)]) :-
    in_tree(Tree, ( dc_motor_polarity(outA, inversed), dc_motor_run(outA, 50),
                    dc_motor_duty(outA, D) )).
test(ramps, [forall(tree(Tree)), true(Rs == [outA-300-400])]) :-
    in_tree(Tree, ( dc_motor_ramps(outA, 300, 400),
                    findall(P-U-D, dc_motor_ramps(P, U, D), Rs) )).
test(two_that_are_the_same_are_asked_for_and_not_written, fail) :-
    plain(( dc_motor_ramps(outA, 300, 400), dc_motor_ramps(outA, X, X) )).
test(what_cannot_be_throws_and_writes_nothing,
     [ forall(member(Goal-Error,
                     [ dc_motor_polarity(outA, backwards)-domain_error(polarity, backwards),
                       dc_motor_polarity(outA, 7)-type_error(atom, 7),
                       dc_motor_polarity(_, normal)-instantiation_error,
                       dc_motor_ramps(outA, 10001, 0)-domain_error(ramp_up_sp, 10001),
                       dc_motor_ramps(outA, 0, -1)-domain_error(ramp_down_sp, -1),
                       dc_motor_ramps(outA, 0, _)-instantiation_error,
                       dc_motor_ramps(_, 0, 0)-instantiation_error ])),
       true(E-W == caught-[]) ]) :-
    plain(( catch(Goal, error(Error, _), E = caught), written(outA, W) )).
test(the_stop_action_cannot_be_read,
     [ forall(behaving(Tree)),
       error(permission_error(read, attribute, _), _) ]) :-
    in_tree(Tree, dc_motor_attribute(outA, stop_action, _)).
:- end_tests(dc_motor_settings).
