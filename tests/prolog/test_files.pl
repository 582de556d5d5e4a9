:- use_module('../support/child').
:- use_module('../support/dev').
:- use_module('../support/trees').

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

:- begin_tests(ev3_sysfs).
test(tells_the_tree_in_use, [forall(tree(Tree)), true(Same == true)]) :-
    with_tree(Tree, ( tree_root(Root),
                      ev3_sysfs(Directory),
                      ( same_file(Root, Directory) -> Same = true ; Same = false ) )).
test(takes_a_string, [forall(tree(Tree)), true(Same == true)]) :-
    with_tree(Tree, ( tree_root(Root),
                      atom_string(Root, String),
                      ev3_sysfs(String),
                      ev3_sysfs(Directory),
                      ( same_file(Root, Directory) -> Same = true ; Same = false ) )).
test(what_is_no_directory_throws,
     [ forall(member(Path, ['/nowhere', '/dev/null', ''])),
       error(existence_error(directory, Path), _) ]) :-
    ev3_sysfs(Path).
test(a_refused_directory_changes_nothing,
     [forall(tree(Tree)), true(Before == After)]) :-
    with_tree(Tree, ( ev3_sysfs(Before),
                      catch(ev3_sysfs('/nowhere'), error(_, _), true),
                      ev3_sysfs(After) )).
% Another tree ends the simulation.
test(another_tree_stops_the_motors_of_the_one_before,
     [ forall(of_files(Tree)), true(C-D == stop-'') ]) :-
    with_tree(Tree, ( motor_run(outB, 50),
                      ev3_sysfs('/'),
                      get_attribute(outB, command, C),
                      get_attribute(outC, command, D) )).
:- end_tests(ev3_sysfs).

:- begin_tests(subsystem_detect).
test(finds_what_matches,
     [forall(tree(Tree)), all(P == [outA, outB, outC, outD])]) :-
    with_tree(Tree, ( pattern('tacho-motor/motor*', Pattern),
                      subsystem_detect(P, _, _, Pattern) )).
test(takes_the_papers_pattern_with_a_slash_at_the_end, 
     [forall(tree(Tree)), all(P-T == [outA-'lego-ev3-m-motor'])]) :-
    with_tree(Tree, [outA-'lego-ev3-m-motor'],
              subsystem_detect(P, T, _, '/sys/class/tacho-motor/motor*/')).
test(looks_in_the_tree_in_use_for_sys_class,
     [forall(tree(Tree)), true(Path == Expected)]) :-
    with_tree(Tree, ( attribute_directory(outA, Expected),
                      subsystem_detect(outA, _, Path, '/sys/class/tacho-motor/*') )).
test(takes_any_pattern, [forall(tree(Tree)), true(Ps == [in1, in3])]) :-
    with_tree(Tree, ( pattern('*-sensor/sensor[02]', Pattern),
                      findall(P, subsystem_detect(P, _, _, Pattern), Ps) )).
test(leaves_no_choice_point_at_a_bound_port,
     [forall(tree(Tree)), true(T == 'lego-ev3-l-motor')]) :-
    with_tree(Tree, ( pattern('tacho-motor/motor*', Pattern),
                      subsystem_detect('ev3-ports:outB', T, _, Pattern) )).
test(passes_over_directories_that_are_no_device,
     [forall(tree(Tree)), fail]) :-
    with_tree(Tree, ( tree_root(Root),
                      subsystem_detect(_, _, _, Root) )).
test(fails_where_nothing_matches, [forall(tree(Tree)), fail]) :-
    with_tree(Tree, subsystem_detect(_, _, _, '/nowhere/*')).
test(fails_for_another_type, [forall(tree(Tree)), fail]) :-
    with_tree(Tree, ( pattern('tacho-motor/motor*', Pattern),
                      subsystem_detect(_, 'lego-nxt-motor', _, Pattern) )).
test(an_unbound_pattern_throws,
     [forall(tree(Tree)), error(instantiation_error, _)]) :-
    with_tree(Tree, subsystem_detect(_, _, _, _)).
test(a_malformed_pattern_throws,
     [ forall(( tree(Tree), member(Pattern, ['[a', '***']) )),
       error(domain_error(file_name_pattern, Pattern), _) ]) :-
    with_tree(Tree, subsystem_detect(_, _, _, Pattern)).
:- end_tests(subsystem_detect).

attribute_directory(Port, Directory) :-
    attribute_path(Port, address, File),
    file_directory_name(File, Directory).

pattern(Pattern0, Pattern) :-
    tree_root(Root),
    atomic_list_concat([Root, Pattern0], /, Pattern).

:- begin_tests(files).
test(file_read_gives_the_value,
     [ forall(( tree(Tree),
                member(Text-Value,
                       [ '42'-42, '-7'-(-7), '0'-0, '7.5'-7.5,
                         'run-forever'-'run-forever', ''-'', '0x10'-'0x10',
                         '1e5'-'1e5', nan-nan, 'a b'-'a b',
                         '9223372036854775807'-9223372036854775807,
                         '9223372036854775808'-'9223372036854775808' ]) )),
       true(Read == Value) ]) :-
    with_tree(Tree, ( show_attribute(outB, stop_action, Text),
                      attribute_path(outB, stop_action, File),
                      file_read(File, Read) )).
test(file_read_takes_a_string_for_the_file,
     [forall(tree(Tree)), true(Value == 1050)]) :-
    with_tree(Tree, ( attribute_path(outB, max_speed, File),
                      atom_string(File, String),
                      file_read(String, Value) )).
test(file_read_fails_for_another_value, [forall(tree(Tree)), fail]) :-
    with_tree(Tree, ( attribute_path(outB, max_speed, File),
                      file_read(File, 1) )).
test(file_read_of_a_missing_file_throws,
     error(existence_error(file, '/nowhere/address'), _)) :-
    file_read('/nowhere/address', _).
test(file_write_writes_a_line,
     [ forall(( tree(Tree),
                member(Attribute-Value-Text,
                       [ speed_sp-42-'42', speed_sp-(-7)-'-7', speed_sp-"12"-'12',
                         stop_action-hold-hold, stop_action-"brake"-brake ]) )),
       true(Written == Text) ]) :-
    with_tree(Tree, ( attribute_path(outB, Attribute, File),
                      file_write(File, Value),
                      get_attribute(outB, Attribute, Written) )).
% A kernel refuses the text.
test(file_write_writes_any_line,
     [ forall(member(Value-Text, [7.5-'7.5', ''-''])),
       true(Written == Text) ]) :-
    with_tree(plain, ( attribute_path(outB, stop_action, File),
                       file_write(File, Value),
                       get_attribute(outB, stop_action, Written) )).
% A kernel has no text that is too long.
test(file_write_replaces_a_longer_text,
     [ true(Written == "stop\n") ]) :-
    with_tree(plain, ( put_attribute(outB, command, 'run-forever'),
                       attribute_path(outB, command, File),
                       file_write(File, stop),
                       read_file_to_string(File, Written, []) )).
test(file_write_makes_no_new_file,
     [forall(tree(Tree)), error(existence_error(file, File), _)]) :-
    with_tree(Tree, ( attribute_path(outB, new, File),
                      file_write(File, 1) )).
test(an_unbound_argument_throws,
     [ forall(member(Goal, [ file_read(_, _), file_write(_, 1),
                             file_write('/nowhere', _) ])),
       error(instantiation_error, _) ]) :-
    call(Goal).
test(a_file_that_is_no_name_throws,
     [ forall(member(File, [1, f(x), [a], []])),
       error(type_error(atom, File), context(file_read/2, _)) ]) :-
    file_read(File, _).
:- end_tests(files).
