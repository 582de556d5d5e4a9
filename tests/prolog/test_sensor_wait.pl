:- use_module('../support/trees').

:- begin_tests(sensor_wait).
test(a_condition_that_holds_is_over_at_once,
     [ forall(( tree(Tree),
                member(Condition, [ us_dist_cm(in1) < 85, us_dist_cm(in1) =< 84.3,
                                    us_dist_cm(in1) > 80+4, us_dist_cm(in1) >= 84,
                                    us_dist_cm(in1) =:= 84.3, us_dist_cm(in1) =\= 0,
                                    us_dist_cm("in1") > 84 ]) )) ]) :-
    with_tree(Tree, ( put_attribute(in1, value0, 843),
                      put_attribute(in1, decimals, 1),
                      sensor_wait(Condition, [timeout(0)]) )).
test(the_time_limit_is_that_of_the_tree) :-
    with_sim([], ( \+ sensor_wait(us_dist_cm(in1) < 25, [timeout(5)]), sim_time(T) )),
    near(T, 5, 0.05).
test(the_reason_is_told, true(Reason == timeout)) :-
    with_sim([], sensor_wait(us_dist_cm(in1) < 25, [timeout(1), reason(Reason)])).
test(the_robot_goes_on_meanwhile) :-
    with_sim([wall(-50, 100, 50, 100)],
             ( set_robot(5.6, 10.6, outB, outC),
               go(30), sensor_wait(us_dist_cm(in1) < 25), stop,
               us_dist_cm(in1, D) )),
    near(D, 25, 1).
test(a_touch_sensor_is_pressed_released_and_bumped,
     [ forall(member(Word-Expected, [pressed-1, released-0, bumped-1.5])) ]) :-
    with_sim([], ( sim_press(in4, [after(1), for(0.5)]),
                   sensor_wait(touch(in4) = Word), sim_time(T) ),
             [robot(touch)]),
    near(T, Expected, 0.05).
test(an_unplugged_sensor_ends_it, true(Reason == unplugged)) :-
    with_sim([], ( sim_at(1, sim_unplug(in1)),
                   sensor_wait(us_dist_cm(in1) < 25, [reason(Reason)]) )).
test(an_unplugged_sensor_throws_if_nobody_asks_for_the_reason,
     error(existence_error(sensor, in1), context(_, _))) :-
    with_sim([], ( sim_at(1, sim_unplug(in1)), sensor_wait(us_dist_cm(in1) < 25) )).
test(another_value_of_a_mode_is_compared) :-
    with_sim([], ( set_robot(5.6, 10.6, outB, outC),
                   turn(30), sensor_wait(gyro_rate(in4) > 20, [timeout(2)]), stop )).
test(fails_without_such_a_sensor,
     [ forall(( tree(Tree),
                member(Condition, [us_dist_cm(in9) < 25, us_dist_cm(in2) < 25, touch(in1) = pressed]) )),
       fail ]) :-
    with_tree(Tree, sensor_wait(Condition, [timeout(0)])).
test(a_time_limit_gets_through, true(Ball == time_limit_exceeded)) :-
    with_sim([], catch(call_with_time_limit(0.05, sensor_wait(us_dist_cm(in1) < 25)), Ball, true),
             [clock(realtime)]).
test(what_is_no_condition_throws,
     [ forall(( tree(Tree),
                member(Condition-Error,
                       [ _-instantiation_error,
                         near-domain_error(sensor_condition, _),
                         (us_dist_cm(in1) = 5)-domain_error(sensor_condition, _),
                         (touch(in1) = squeezed)-domain_error(sensor_condition, _),
                         (touch(in1) = _)-domain_error(sensor_condition, _),
                         (25 > us_dist_cm(in1))-domain_error(sensor_condition, _),
                         (smell(in1) < 5)-domain_error(sensor_reading, smell),
                         (us_dist_cm(_) < 5)-instantiation_error,
                         (us_dist_cm(1) < 5)-type_error(_, 1),
                         (us_dist_cm(in1) < far)-type_error(evaluable, far/0),
                         (us_dist_cm(in1) < _)-instantiation_error ]) )),
       error(Error, context(sensor_wait/1, _)) ]) :-
    with_tree(Tree, sensor_wait(Condition)).
test(the_readings_that_there_are, true(sub_atom(Text, _, _, _, 'touch, us_dist_cm'))) :-
    catch(sensor_wait(smell(in1) < 5), error(_, context(_, Text)), true).
test(a_goal_is_waited_for_too,
     [ forall(member(Condition, [ ( us_dist_cm(_, D), D < 25 ),
                                  ( us_dist_cm(in1) < 25 ; touch(_) = pressed ),
                                  \+ us_dist_cm(in1) >= 25 ])),
       true(near(Distance, 24, 2)) ]) :-
    with_sim([bounds(0, 0, 200, 200), start(100, 50, 0)],
             ( set_robot(5.6, 10.6, outB, outC), go(30),
               sensor_wait(Condition), stop, us_dist_cm(in1, Distance) )).
test(a_goal_has_a_time_limit, true(Reason-Time == timeout-2)) :-
    with_sim([], ( sensor_wait(( us_dist_cm(_, D), D < 5 ),
                               [timeout(2), reason(Reason)]),
                   sim_time(Time0), Time is round(Time0) )).
test(a_goal_must_not_move, error(permission_error(wait, guard, sensor_wait), _)) :-
    with_sim([], sensor_wait(( motor_run(outB, 20), fail ))).
test(options_are_checked,
     [ forall(member(Option-Error, [ timeout(-1)-domain_error(timeout, -1),
                                     patience(1)-domain_error(sensor_option, _) ])),
       error(Error, context(sensor_wait/2, _)) ]) :-
    with_tree(simulator, sensor_wait(us_dist_cm(in1) < 5, [Option])).
:- end_tests(sensor_wait).
