:- use_module('../support/child').
:- use_module('../support/dev').
:- use_module('../support/simulation').
:- use_module('../support/trees').
:- use_module(library(ev3dev)).
:- use_module(library(ev3dev/sim)).

:- begin_tests(ev3_dev).

test(is_told, true(Dev == Expected)) :-
    with_dev([], ( ev3_dev(Dev), dev_path('', Path) )),
    atom_concat(Expected, /, Path).
test(is_the_simulators_own, true(Inside-After == '/dev'-Before)) :-
    with_dev([],
             ( ev3_dev(Before),
               with_sim(room, ( ev3_dev(Inside), sim_press(up), button(up) )),
               ev3_dev(After),
               \+ button(_) )).
test(may_be_another_than_the_simulators, fail) :-
    with_sim(room,
             ( sim_press(up),
               ev3_dev(tests),
               button(_) )).
test(starts_no_simulator_when_it_is_set, true(Status-Output == exit(0)-"none")) :-
    run_program(":- use_module(library(ev3dev)).
                 main :- ev3_dev(tests),
                         (   button(_)
                         ->  write(one)
                         ;   write(none)
                         ).",
                [goal(main), cwd('.')], Status, Output).
test(is_that_of_the_environment, true(Status-Output == exit(0)-"[up]")) :-
    events_of([event(1, 103, 1)], Bytes),
    with_dev(['input/by-path/platform-gpio_keys-event'-Bytes],
             ( ev3_dev(Dev),
               run_program(":- use_module(library(ev3dev)).
                            main :- findall(Key, button(Key), Keys), print(Keys).",
                           [goal(main), env('EV3DEV_DEV'=Dev)], Status, Output) )).
test(starts_the_simulator_where_there_is_no_other,
     true(Status-Output == exit(0)-"[] in room")) :-
    run_program(":- use_module(library(ev3dev)).
                 main :- findall(Key, button(Key), Keys),
                         print(Keys),
                         ev3dev_sim:sim_pose(_, _, _),
                         write(' in room').",
                [goal(main)], Status, Output).
test(must_be_a_directory,
     [ forall(member(Name, ['no such', '', ""])),
       error(existence_error(directory, Name), _) ]) :-
    ev3_dev(Name).
test(must_be_no_file, error(existence_error(directory, 'pack.pl'), _)) :-
    ev3_dev('pack.pl').

:- end_tests(ev3_dev).
