:- use_module('../support/cases').
:- use_module('../support/trees').
:- use_module(library(ev3dev/bricks), [brick/1, brick_close/1, brick_open/2, use_brick/1, with_brick/2]).
:- use_module(library(ev3dev/events), [race/2]).

:- begin_tests(sim_time).
test(starts_at_0) :-
    with_sim([], ( sim_time(T), near(T, 0, 0.001) )).
test(step_passes) :-
    with_sim([], ( sim_step(1+1), sim_time(T), near(T, 2, 0.001) )).
test(step_back, error(domain_error(seconds, -1), _)) :-
    with_sim([], sim_step(-1)).
test(a_long_step_can_be_interrupted, true(E == time_limit_exceeded)) :-
    with_sim([], catch(call_with_time_limit(0.1, sim_step(1.0e9)), E, true)).
test(step_of_no_number, error(type_error(evaluable, _), _)) :-
    with_sim([], sim_step(long)).
test(virtual_time_stands_while_the_program_thinks) :-
    with_sim([], ( sim_time(T0), sleep(0.05), sim_time(T), T =:= T0 )).
test(virtual_time_passes_for_a_program_that_polls) :-
    with_sim([], ( motor_run(outA, 50),
                   polled_until(outA, 360),
                   sim_time(T) )),
    near(T, 1, 0.7).
test(several_threads_wait_at_once) :-
    with_sim([],
             ( thread_create(motor_run(outA, 50, 360), Id, []),
               motor_run(outB, 50, 360),
               thread_join(Id, Status),
               sim_time(T) )),
    Status == true,
    near(T, 1, 0.7).
% On a busy machine it falls behind.
test(real_time_passes_by_itself) :-
    get_time(Before),
    with_sim([],
             ( eventually(( sim_time(T), T > 0.1 )), get_time(After) ),
             [clock(realtime)]),
    T < After - Before.
test(scaled_time_is_faster) :-
    get_time(Before),
    with_sim([],
             eventually(( sim_time(T), get_time(Now), T > Now - Before )),
             [clock(scaled(50))]).

polled_until(Port, Position) :-
    position(Port, P),
    (   P >= Position
    ->  true
    ;   polled_until(Port, Position)
    ).

test(a_call_beside_a_thread_that_computes_can_be_interrupted,
     [ forall(member(Goal, [sim_wait(1), us_dist_cm(_, _)])),
       true(Balls == [time_limit_exceeded])
     ]) :-
    with_sim(room,
             setup_call_cleanup(
                 thread_create(compute, Id, []),
                 setof(Ball, interrupted(Goal, Ball), Balls),
                 ( thread_signal(Id, throw(over)), thread_join(Id, _) ))).
test(steps_can_be_interrupted, true(E == time_limit_exceeded)) :-
    with_sim(room, catch(call_with_time_limit(0.2, sim_step(1.0e8)), E, true)).

%   The limit ends at any moment, also while the simulator asks what this thread is about.

interrupted(Goal, Ball) :-
    case(200, Seed),
    Seconds is 0.0002 + 0.004 * (89 * Seed mod 200) / 200,
    catch(call_with_time_limit(Seconds, Goal), Ball, true).

compute :-
    repeat,
    fail.
:- end_tests(sim_time).

:- begin_tests(sim_wait).
test(lets_time_pass_on_the_virtual_clock) :-
    with_sim([], ( sim_time(T0), sim_wait(60 * 60), sim_time(T) )),
    T - T0 >= 3600,
    T - T0 < 3601.
test(takes_its_time_on_another,
     [forall(member(Clock, [realtime, scaled(4)]))]) :-
    with_sim([], ( sim_time(T0), sim_wait(0.2), sim_time(T) ), [clock(Clock)]),
    T - T0 >= 0.2.
test(several_threads_wait_at_once) :-
    with_sim([], ( findall(Id, ( member(S, [0.3, 0.1, 0.2]),
                                 thread_self(Me),
                                 thread_create(( sim_wait(S),
                                                 thread_send_message(Me, after(S)) ),
                                               Id, []) ), Ids),
                   findall(S, ( member(_, Ids), thread_get_message(after(S)) ), Ss),
                   forall(member(Id, Ids), thread_join(Id, true)) )),
    msort(Ss, [0.1, 0.2, 0.3]).
test(a_time_limit_gets_through, true(Ball == time_limit_exceeded)) :-
    with_sim([],
             catch(call_with_time_limit(0.05, sim_wait(3600)), Ball, true),
             [clock(realtime)]).
test(a_time_that_is_none_throws,
     [ forall(member(Goal-Error, [ sim_wait(-1)-domain_error(seconds, -1),
                                   sim_wait(_)-instantiation_error,
                                   sim_wait(soon)-type_error(evaluable, _) ])),
       error(Error, _) ]) :-
    with_sim([], Goal).
:- end_tests(sim_wait).

:- begin_tests(sim_snapshot).
polls(Count) :-
    motor_run(outB, 20),
    motor_run(outC, -20),
    forall(between(1, Count, _),
           ( speed_sp(outB, 200),
             us_dist_cm(in1, _) )).

snapshots(Count, Snapshots) :-
    findall(Snapshot,
            ( between(1, Count, _), sim_snapshot(Snapshot) ),
            Snapshots).

%   The memory of this process in kB.
resident(KiloBytes) :-
    read_file_to_codes('/proc/self/status', Codes, []),
    atom_codes(Text, Codes),
    atomic_list_concat([_, Line|_], 'VmRSS:', Text),
    atomic_list_concat([Number|_], kB, Line),
    normalize_space(atom(Word), Number),
    atom_number(Word, KiloBytes).

test(restore_puts_everything_back) :-
    with_sim([],
             ( set_robot(5.6, 10.6, outB, outC),
               sim_snapshot(S),
               sim_time(T0),
               sim_pose(X0, Y0, H0),
               go_cm(30, 20),
               turn(20, 45),
               sim_pose(X, Y, _),
               X-Y \== X0-Y0,
               sim_restore(S),
               sim_pose(X0, Y0, H0),
               sim_time(T0),
               position(outB, 0) )).
test(may_be_restored_again_and_again) :-
    with_sim([],
             ( set_robot(5.6, 10.6, outB, outC),
               sim_snapshot(S),
               findall(Y, ( member(D, [10, 20, 30]),
                            sim_restore(S),
                            go_cm(30, D),
                            sim_pose(_, Y, _)
                          ),
                       [Y1, Y2, Y3]) )),
    near(Y1, 10, 0.5),
    near(Y2, 20, 0.5),
    near(Y3, 30, 0.5).
test(what_was_added_can_be_removed_after_a_restore) :-
    with_sim([],
             ( sim_snapshot(Empty),
               sim_add(circle(0, 50, 1)),
               sim_snapshot(A),
               sim_restore(Empty),
               sim_add(circle(50, 0, 1)),
               \+ sim_remove(circle(0, 50, 1)),
               sim_restore(A),
               \+ sim_remove(circle(50, 0, 1)),
               sim_remove(circle(0, 50, 1)) )).
test(what_is_plugged_in_after_a_restore_is_another_device,
     true(Type-Speed == 'lego-ev3-m-motor'-1560)) :-
    with_sim([],
             ( sim_snapshot(S),
               sim_plug(outD, 'lego-ev3-l-motor'),
               sim_step(2),
               max_speed(outD, 1050),
               sim_restore(S),
               sim_plug(outD, 'lego-ev3-m-motor'),
               sim_step(2),
               tacho_motor(outD, Type),
               max_speed(outD, Speed) )).
test(is_small_however_far_the_robot_has_driven,
     [ condition(exists_file('/proc/self/status')),
       true(Size < 40)
     ]) :-
    with_sim(room,
             ( polls(5000),
               snapshots(100, _),
               resident(Before),
               snapshots(500, Snapshots),
               resident(After),
               is_list(Snapshots) )),
    Size is (After - Before) / 500.
test(garbage_is_collected) :-
    with_sim(room,
             forall(between(1, 3000, _), sim_snapshot(_))),
    ev3dev_native:sim_snapshots_(Count),
    Count =< 2500.
test(restores_no_other_things, error(domain_error(simulator_snapshot, 1), _)) :-
    with_sim([], sim_restore(1)).
test(restores_nothing_unbound, error(instantiation_error, _)) :-
    with_sim([], sim_restore(_)).
:- end_tests(sim_snapshot).

:- begin_tests(planned).
test(a_goal_runs_at_its_time) :-
    with_sim([], ( sim_at(1+1, note_time), sim_wait(3), noted(T) )),
    near(T, 2, 0.03).
test(goals_run_in_the_order_of_their_times, true(Words == [a, b, c])) :-
    with_sim([], ( nb_setval(said, []),
                   sim_at(3, say_word(c)), sim_at(1, say_word(a)), sim_at(2, say_word(b)),
                   sim_wait(4),
                   nb_getval(said, Said), reverse(Said, Words) )).
test(a_goal_runs_during_a_move, true(Reason == unplugged)) :-
    with_sim([], ( sim_at(1, sim_unplug(outB)),
                   motor_run(outB, 20, 3600, [wait(false)]),
                   motor_wait(outB, [], Reason) )).
test(a_goal_runs_for_a_program_that_polls, true(D < 30)) :-
    with_sim([], ( us_dist_cm(in1, 255.0),
                   sim_at(0.2, sim_add(wall(-50, 30, 50, 30))),
                   repeat, us_dist_cm(in1, D), D < 255, ! )).
test(an_exception_of_a_goal_ends_the_wait_and_stops_the_motors) :-
    with_sim([], ( sim_at(1, throw(enough)),
                   catch(motor_run(outB, 20, 3600), enough, true),
                   sim_time(T), near(T, 1, 0.05),
                   at_rest )).
test(a_plan_of_the_past_runs_at_once) :-
    with_sim([], ( sim_step(5), sim_at(1, note_time), sim_wait(1), noted(T) )),
    near(T, 5, 0.05).
test(a_plan_ends_with_the_simulation, true(Noted == none)) :-
    nb_setval(noted, none),
    with_sim([], sim_at(1, note_time)),
    with_sim([], sim_wait(2)),
    nb_getval(noted, Noted).
test(a_plan_waits_for_its_time_after_a_restore) :-
    with_sim([], ( sim_snapshot(Start), sim_wait(2),
                   sim_at(3, note_time), sim_restore(Start),
                   sim_wait(4), noted(T) )),
    near(T, 3, 0.05).
test(only_the_thread_that_planned_runs_it, true(Ran == Me)) :-
    thread_self(Me),
    with_sim([], ( sim_at(1, ( thread_self(Here), nb_setval(ran, Here) )),
                   thread_create(sim_wait(2), Id, []),
                   thread_join(Id, _),
                   sim_wait(1),
                   nb_getval(ran, Ran) )).
test(is_refused_if_it_is_no_plan,
     [ forall(member(Goal-Error, [ sim_at(-1, true)-domain_error(seconds, -1),
                                   sim_at(soon, true)-type_error(evaluable, _),
                                   sim_at(1, _)-instantiation_error,
                                   sim_at(1, 7)-type_error(_, _) ])),
       error(Error, context(sim_at/2, _)) ]) :-
    with_sim([], Goal).
test(fails_without_a_simulation, fail) :-
    ignore(sim_stop),
    sim_at(1, true).

note_time :-
    sim_time(T),
    nb_setval(noted, T).

noted(T) :-
    nb_getval(noted, T).

say_word(Word) :-
    nb_getval(said, Said),
    nb_setval(said, [Word|Said]).
:- end_tests(planned).

:- begin_tests(for_seconds).
test(leaves_a_program_that_does_not_end) :-
    with_sim([], ( for_seconds(5, ever), sim_time(T) )),
    near(T, 5, 0.05).
test(leaves_a_program_that_polls) :-
    with_sim([], ( for_seconds(2, ( repeat, us_dist_cm(in1, D), D < 0 )),
                   sim_time(T) )),
    near(T, 2, 0.05).
test(ends_with_a_goal_that_ends) :-
    with_sim([], ( for_seconds(5, sim_wait(1)), sim_wait(10), sim_time(T) )),
    near(T, 11, 0.05).
test(waits_after_a_goal_that_has_only_started_motors, true(Ports == [])) :-
    with_sim([], ( set_robot(5.6, 10.6, outB, outC),
                   for_seconds(3, go(10)), sim_time(T), sim_pose(X0, _, _),
                   sim_wait(1), sim_pose(X, _, _), ev3dev_native:running_(Ports) )),
    near(T, 3, 0.1), near(X, X0, 1).
test(waits_for_nothing_else, true(T < 0.1)) :-
    with_sim([], ( motor_run(outA, 20),
                   for_seconds(3, X = 1), X == 1, sim_time(T) )).
test(stops_what_it_leaves, [forall(member(Goal, [wait(5), ever])), true(Ports == [])]) :-
    with_sim([], ( for_seconds(1, ( motor_run(outB, 20), Goal )), ev3dev_native:running_(Ports) )).
test(leaves_motors_of_before_alone, true(Ports == [outA])) :-
    with_sim([], ( motor_run(outA, 20), for_seconds(1, motor_run(outB, 20)),
                   ev3dev_native:running_(Ports) )).
test(fails_with_a_goal_that_fails, fail) :-
    with_sim([], for_seconds(5, ( sim_wait(1), fail ))).
test(passes_an_exception_on, throws(oops)) :-
    with_sim([], for_seconds(5, throw(oops))).
test(one_may_contain_another, true(Outer-Inner == over-over)) :-
    with_sim([], ( for_seconds(4, ( for_seconds(2, ever), Inner = over, sim_time(T0),
                                    nb_setval(inner, T0), ever )),
                   Outer = over,
                   nb_getval(inner, T1), near(T1, 2, 0.05),
                   sim_time(T), near(T, 4, 0.05) )),
    Inner = over.
test(counts_on_in_a_simulation_that_the_program_starts) :-
    with_sim([], ( for_seconds(5, ( sim_wait(2), sim_start([], [clock(virtual)]), ever )),
                   sim_time(T) )),
    near(T, 3, 0.05).
test(counts_on_after_two_more) :-
    with_sim([], ( for_seconds(5, ( sim_wait(1), sim_start([], [clock(virtual)]),
                                    sim_wait(1), sim_start([], [clock(virtual)]), ever )),
                   sim_time(T) )),
    near(T, 3, 0.05).
test(counts_on_after_a_simulation_has_ended) :-
    with_sim([], ( for_seconds(5, ( sim_wait(2), sim_stop,
                                    sim_start([], [clock(virtual)]), ever )),
                   sim_time(T) )),
    near(T, 3, 0.05).
test(counts_on_after_a_world_that_is_none) :-
    with_sim([], ( for_seconds(5, ( sim_wait(2), catch(sim_start(rome), _, true), ever )),
                   sim_time(T) )),
    near(T, 5, 0.05).
test(counts_on_after_a_restore) :-
    with_sim([], ( for_seconds(5, ( sim_snapshot(S), sim_wait(2), sim_restore(S), ever )),
                   sim_time(T) )),
    near(T, 3, 0.05).
test(a_way_to_try_moves_for_ever_ends) :-
    with_sim([], ( for_seconds(5, ( sim_snapshot(S), repeat, sim_wait(1), sim_restore(S), fail )),
                   sim_time(T) )),
    near(T, 0.5, 0.55).
test(each_of_two_counts_on) :-
    with_sim([], ( for_seconds(4, ( for_seconds(2, ( sim_wait(1), sim_start([], [clock(virtual)]),
                                                     ever )),
                                    sim_time(T0), nb_setval(inner, T0), ever )),
                   sim_time(T) )),
    nb_getval(inner, T1),
    near(T1, 1, 0.05),
    near(T, 3, 0.05).
test(what_has_ended_does_not_count_on) :-
    with_sim([], ( for_seconds(5, sim_wait(1)), sim_start([], [clock(virtual)]), sim_wait(20),
                   sim_time(T) )),
    near(T, 20, 0.05).
test(leaves_a_long_step) :-
    with_sim([], ( for_seconds(2, sim_step(1000)), sim_time(T) )),
    near(T, 2, 0.15).
test(works_on_a_clock_that_follows_the_wall) :-
    with_sim([], ( for_seconds(0.2, ever), sim_time(T), T >= 0.2 ),
             [clock(scaled(4))]).
test(is_refused_if_the_time_is_none,
     [ forall(member(S-E, [ -1-domain_error(seconds, -1), _-instantiation_error ])),
       error(E, context(for_seconds/2, _)) ]) :-
    with_sim([], for_seconds(S, true)).

test(leaves_a_goal_that_catches_everything,
     [ forall(member(Goal-Late, [ catches_all(us_dist_cm(_, _))-0, catches_all(wait(0.1))-0,
                                  catches_all(sim_time(_))-none,
                                  retries(us_dist_cm(_, _))-1, retries(wait(0.1))-1,
                                  retries(true)-none, cleans_up_for_ever-1 ])) ]) :-
    with_most(300000, 100,
              with_sim([], ( catch(for_seconds(2, Goal), error(Formal, _), true), sim_time(T) ))),
    (   Late == none
    ->  Formal == resource_error(inferences),
        T < 0.1
    ;   var(Formal),
        near(T, 2 + Late, 0.05)
    ).
test(leaves_a_goal_that_computes,
     [ forall(member(Goal, [ ( repeat, fail ), ( repeat, sim_pose(_, _, _), fail ),
                             ( sim_stop, repeat, fail ) ])),
       error(resource_error(inferences), context(for_seconds/2, _)) ]) :-
    with_most(300000, 100, with_sim([], for_seconds(5, Goal))).
test(leaves_a_goal_that_sleeps, error(resource_error(seconds), context(for_seconds/2, _))) :-
    with_most(100000000, 0.3, with_sim([], for_seconds(5, ( repeat, sleep(0.05), fail )))).
test(computing_counts_a_tenth_of_sleeping) :-
    get_time(Start),
    ev3dev_time_limits:used_so_far(_, _, Idle0),
    statistics(cputime, Computed0),
    repeat,
    statistics(cputime, Computed),
    Computed > Computed0 + 0.5,
    !,
    ev3dev_time_limits:used_so_far(_, _, Idle),
    get_time(End),
    Idle - Idle0 < End - Start - 0.9*(Computed-Computed0) + 0.001,
    Idle > Idle0.
test(computing_is_allowed_while_time_passes) :-
    with_most(1000000, 100,
              with_sim([], ( for_seconds(20, ( repeat, computes(500000), wait(1), fail )),
                             sim_time(T) ))),
    near(T, 20, 0.1).
test(leaves_a_goal_that_computes_on_a_clock_that_follows_the_wall) :-
    with_sim([], ( for_seconds(0.5, ( repeat, fail )), sim_time(T) ), [clock(realtime)]),
    T >= 0.5.
test(clean_ups_run_and_may_wait, true(Cleaned == yes)) :-
    nb_setval(cleaned, no),
    with_sim([], ( for_seconds(2, setup_call_cleanup(true, ever,
                                                     ( wait(0.5), nb_setval(cleaned, yes) ))),
                   sim_time(T) )),
    near(T, 2.5, 0.05),
    nb_getval(cleaned, Cleaned).
test(a_move_is_stopped_whatever_catches) :-
    with_sim([], ( for_seconds(1, catches_all(motor_run(outA, 20, 3600))), at_rest )).
test(what_was_written_stays, true(Text == "hello")) :-
    with_output_to(string(Text), with_sim([], for_seconds(1, ( write(hello), ever )))).
test(an_outer_one_leaves_the_inner_one_too, [forall(member(Inner, [5, 1]))]) :-
    with_sim([], ( for_seconds(1, ( repeat, for_seconds(Inner, catches_all(wait(0.1))), fail )),
                   sim_time(T) )),
    near(T, 1, 1.05).
test(an_abort_of_others_goes_through, true(Status == Aborted)) :-
    thread_create(abort, Id0, []),
    thread_join(Id0, Aborted),
    thread_create(with_sim([], for_seconds(5, ( wait(1), abort ))), Id, []),
    thread_join(Id, Status).
test(goals_side_by_side_are_left,
     [ condition(current_predicate(engine_create/3)),
       forall(member(Goal, [ catches_all(us_dist_cm(_, _)), ever ])) ]) :-
    with_sim([], ( for_seconds(1, race([Goal, wait(5)], _)), sim_time(T),
                   motor_run(outA, 20, 360), sim_time(T1), T1 > T + 1 )),
    near(T, 1, 0.1).
test(one_of_goals_side_by_side_is_left,
     [ condition(current_predicate(engine_create/3)), true(Winner == 1) ]) :-
    with_sim([], ( race([for_seconds(1, ever), wait(3)], Winner), sim_time(T) )),
    near(T, 1, 0.05).
test(binds_what_its_goal_binds, true(D == 255.0)) :-
    with_sim([], for_seconds(1, us_dist_cm(in1, D))).
test(an_error_names_what_was_called, error(_, context(motor_run/2, _))) :-
    with_sim([], for_seconds(1, motor_run(outA, fast))).

catches_all(Goal) :-
    catch(( repeat, Goal, fail ), _, true),
    catches_all(Goal).

retries(Goal) :-
    catch(( repeat, Goal, fail ), _, retries(Goal)).

cleans_up_for_ever :-
    setup_call_cleanup(true, ever, ever).

computes(N) :-
    (   between(1, N, _),
        fail
    ;   true
    ).

%   With other bounds for what computes or sleeps.
:- meta_predicate with_most(+, +, 0).

with_most(Inferences, Seconds, Goal) :-
    setup_call_cleanup(
        ( retract(ev3dev_time_limits:most(I0, S0)),
          assertz(ev3dev_time_limits:most(Inferences, Seconds)) ),
        Goal,
        ( retractall(ev3dev_time_limits:most(_, _)), assertz(ev3dev_time_limits:most(I0, S0)) )).

ever :-
    repeat,
    sim_wait(0.3),
    fail.
:- end_tests(for_seconds).

% What Prolog prints around the menu of Ctrl-C, and in place of what follows it.
:- begin_tests(interrupt_menu).
test(simulated_time_stands, [forall(member(End, [interrupt(end), '$aborted', format("", [])]))]) :-
    with_sim([], ( interrupted(Stood), Stood =:= 0,
                   print_message(silent, End), goes_on ), [clock(realtime)]).
test(time_that_the_page_has_stopped_stays_so) :-
    with_sim([], setup_call_cleanup(ev3dev_native:view_pause_(true),
                                    ( interrupted(_), print_message(silent, interrupt(end)),
                                      ev3dev_native:view_held_ ),
                                    ev3dev_native:view_pause_(false)), [clock(realtime)]).
% An abort has left with_brick/2 when it is printed, and another brick is in use.
test(the_time_of_another_brick_goes_on, [forall(member(Way, [apart, crowd]))]) :-
    with_anna(Way, ( with_brick(anna, ( interrupted(Stood), ev3dev_native:view_held_ )),
                     Stood =:= 0,
                     print_message(silent, '$aborted'),
                     use_brick(local),
                     with_brick(anna, ( \+ ev3dev_native:view_held_, goes_on )) )).
test(the_brick_may_be_closed_meanwhile) :-
    with_anna(apart, ( with_brick(anna, interrupted(_)),
                       brick_close(anna),
                       print_message(silent, '$aborted'),
                       \+ ev3dev_queries:stands(_) )).
% Clean-ups do so before the abort is printed.
test(a_wait_goes_on) :-
    with_sim([], ( interrupted(_), ev3dev_native:view_held_,
                   \+ ev3dev_waits:waited(pause),
                   \+ ev3dev_native:view_held_ ), [clock(realtime)]).
test(without_a_simulation) :-
    ( sim_stop -> true ; true ),
    print_message(silent, interrupt(begin)),
    print_message(silent, interrupt(end)).

:- meta_predicate with_anna(+, 0).

with_anna(Way, Goal) :-
    setup_call_cleanup(
        anna_begins(Way),
        once(Goal),
        forall(( member(Name, [anna, bob]), brick(Name) ), brick_close(Name))).

anna_begins(apart) :-
    brick_open(anna, sim([], [clock(realtime)])).
anna_begins(crowd) :-
    sim_start([start(anna, 0, 0, 0), start(bob, 0, 60, 180)],
              [clock(realtime), robots([anna-default, bob-default])]).

interrupted(Passed) :-
    print_message(silent, interrupt(begin)),
    sim_time(T0),
    sleep(0.05),
    sim_time(T),
    Passed is T - T0.

goes_on :-
    sim_time(T0),
    repeat,
    sim_time(T),
    T > T0,
    !.
:- end_tests(interrupt_menu).
