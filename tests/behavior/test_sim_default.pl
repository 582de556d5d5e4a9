% If there is no brick: the simulator comes by itself, at the first use.

:- use_module('../support/child').

no_brick :-
    \+ getenv('EV3DEV_SYSFS', _),
    \+ exists_directory('/sys/class/tacho-motor'),
    \+ exists_directory('/sys/class/lego-sensor').

%   What a program prints that is not quiet.
prints(Goal, Options, Output) :-
    format(atom(Loud), "set_prolog_flag(verbose, normal), ~q", [Goal]),
    run_program(":- use_module(library(ev3dev)).\n",
                [goal(Loud)|Options], exit(0), Output).

told(Output) :-
    sub_string(Output, _, _, _, "simulating"),
    !.

:- begin_tests(default, [condition(no_brick)]).
test(loading_starts_nothing) :-
    prints(true, [], Output),
    \+ told(Output).
test(the_first_use_starts_the_room_and_tells_once) :-
    % It turns a little if its wheels do not start at the same time.
    prints(( set_robot(5.6, 10.6, outB, outC),
             ev3dev_sim:sim_pose(_, _, H0), H0 =:= 40,
             go_cm(30, 5),
             us_dist_cm(in1, _),
             ev3dev_sim:sim_pose(_, _, H), abs(H - 40) < 3
           ), [], Output),
    told(Output),
    findall(At, sub_string(Output, At, _, _, "simulating"), [_]).
test(several_threads_start_one) :-
    prints(concurrent(3, [us_dist_cm(in1, _), gyro_ang(in4, _), position(outB, _)],
                      []),
           [], Output),
    findall(At, sub_string(Output, At, _, _, "simulating"), [_]).
test(a_directory_in_the_environment_is_used_instead) :-
    prints(\+ tacho_motor(_), [env('EV3DEV_SYSFS'='/tmp')], Output),
    \+ told(Output).
test(a_directory_set_by_the_program_is_used_instead) :-
    prints(( ev3_sysfs('/tmp'), \+ tacho_motor(_) ), [], Output),
    \+ told(Output).
test(a_simulation_of_the_program_is_used_instead) :-
    prints(( use_module(library(ev3dev/sim)), sim_start(grid),
             us_dist_cm(in1, D), D < 100 ), [], Output),
    \+ told(Output).
test(after_its_end_the_next_use_starts_it_again) :-
    prints(( us_dist_cm(in1, _), ev3dev_sim:sim_stop, \+ ev3dev_sim:sim_stop,
             tacho_motor(outB), \+ button(_) ), [], Output),
    findall(At, sub_string(Output, At, _, _, "simulating"), [_, _]).
test(after_the_programs_own_ended_it_starts_too) :-
    prints(( use_module(library(ev3dev/sim)), sim_start(grid), sim_stop,
             \+ sim_pose(_, _, _), us_dist_cm(in1, _),
             sim_pose(_, _, H), H =:= 40 ), [], Output),
    told(Output).
test(after_its_end_a_directory_of_the_program_is_used_again) :-
    prints(( use_module(library(ev3dev/sim)), ev3_sysfs('/tmp'), sim_start(grid),
             sim_start(room), tacho_motor(outB), sim_stop, ev3_sysfs('/tmp'),
             ev3_sysfs(D), D == '/tmp', \+ tacho_motor(_) ), [], Output),
    \+ told(Output).
test(after_its_end_the_device_files_of_the_program_are_used_again) :-
    prints(( use_module(library(ev3dev/sim)), ev3_dev('/tmp'), sim_start(grid),
             sim_stop, ev3_dev(D), D == '/tmp' ), [], Output),
    \+ told(Output).
test(several_threads_start_one_again) :-
    prints(( us_dist_cm(in1, _), ev3dev_sim:sim_stop,
             concurrent(3, [us_dist_cm(in1, _), gyro_ang(in4, _), position(outB, _)],
                        []) ), [], Output),
    findall(At, sub_string(Output, At, _, _, "simulating"), [_, _]).
:- end_tests(default).
