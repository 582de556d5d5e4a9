:- use_module('../support/simulation').
:- use_module('../support/trees').
:- use_module(library(ev3dev)).
:- use_module(library(ev3dev/sim)).
:- use_module(library(time)).

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
    with_sim([], [clock(realtime)],
             ( eventually(( sim_time(T), T > 0.1 )), get_time(After) )),
    T < After - Before.
test(scaled_time_is_faster) :-
    get_time(Before),
    with_sim([], [clock(scaled(50))],
             eventually(( sim_time(T), get_time(Now), T > 5 * (Now - Before) ))).

polled_until(Port, Position) :-
    position(Port, P),
    (   P >= Position
    ->  true
    ;   polled_until(Port, Position)
    ).

test(a_wait_beside_a_thread_that_computes_can_be_interrupted,
     true(E == time_limit_exceeded)) :-
    with_sim(room,
             setup_call_cleanup(
                 thread_create(compute, Id, []),
                 catch(call_with_time_limit(0.2, sim_wait(1)), E, true),
                 ( thread_signal(Id, throw(over)), thread_join(Id, _) ))).
test(a_call_beside_a_thread_that_computes_can_be_interrupted,
     true(E == time_limit_exceeded)) :-
    with_sim(room,
             setup_call_cleanup(
                 thread_create(compute, Id, []),
                 catch(call_with_time_limit(0.2, us_dist_cm(_, _)), E, true),
                 ( thread_signal(Id, throw(over)), thread_join(Id, _) ))).
test(steps_can_be_interrupted, true(E == time_limit_exceeded)) :-
    with_sim(room, catch(call_with_time_limit(0.2, sim_step(1.0e8)), E, true)).

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
    with_sim([], [clock(Clock)], ( sim_time(T0), sim_wait(0.2), sim_time(T) )),
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
    with_sim([], [clock(realtime)],
             catch(call_with_time_limit(0.05, sim_wait(3600)), Ball, true)).
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
