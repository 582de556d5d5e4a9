:- use_module('../support/child').
:- use_module('../support/dev').
:- use_module('../support/things/crowd').
:- use_module('../support/trees').
:- use_module(library(sgml)).

:- begin_tests(sim_trace).
test(collisions_tell_when_and_where) :-
    with_sim([wall(-50, 30, 50, 30)],
             ( set_robot(5.6, 10.6, outB, outC),
               go(30),
               sim_step(3),
               sim_collisions([collision(Time, X, Y, Heading)|_]) )),
    near(Time, 1.5, 1),
    near(X, 0, 1),
    near(Y, 21.5, 0.5),
    near(Heading, 0, 2).
test(trace_is_in_the_order_of_time) :-
    with_sim([],
             ( set_robot(5.6, 10.6, outB, outC),
               go_cm(30, 20),
               us_dist_cm(in1, _),
               sim_trace(Trace) )),
    findall(T, member(T-_, Trace), Times),
    length(Trace, Length),
    length(Times, Length),
    msort(Times, Times),
    once(( member(_-written(Command, _), Trace),
           sub_atom(Command, _, _, 0, '/command') )),
    memberchk(_-read(Value, '2550'), Trace),
    sub_atom(Value, _, _, 0, '/value0'),
    memberchk(_-pose(_, _, _), Trace).
:- end_tests(sim_trace).

:- begin_tests(sim_svg).
test(svg_draws_it) :-
    with_file("", File,
              ( with_sim(room, sim_svg(File)),
                load_structure(File, [element(svg, _, [_|_])],
                               [dialect(xml), space(remove)]) )).
test(svg_in_no_directory, error(existence_error(_, _), _)) :-
    with_sim(room, sim_svg('/nowhere/demo.svg')).
:- end_tests(sim_svg).

:- begin_tests(sim_mount).
test(mount_shows_the_files, [condition(can_mount)]) :-
    with_sim([],
             with_directory(Directory,
                 ( sim_mount(Directory),
                   atom_concat(Directory, '/tacho-motor/motor0/address', File),
                   exists_file(File),
                   sim_unmount,
                   \+ exists_file(File),
                   \+ sim_unmount ))).
test(a_program_that_ends_unmounts, [condition(can_mount)]) :-
    with_directory(Directory,
        ( format(atom(Goal), "sim_start(room), sim_mount(~q)", [Directory]),
          run_program(":- use_module(library(ev3dev/sim)).\n", [goal(Goal)],
                      Status, Output),
          Status-Output == exit(0)-"",
          directory_files(Directory, Files),
          msort(Files, ['.', '..']) )).
test(no_such_directory, error(existence_error(_, _), _)) :-
    with_sim([], sim_mount('/no/such/directory')).
test(a_mount_whose_program_was_killed_is_told_with_a_cure,
     [condition(can_mount)]) :-
    with_directory(Directory,
        ( format(atom(Goal),
                 "sim_start(room), sim_mount(~q), current_prolog_flag(pid, Pid), \c
                  process_kill(Pid, kill)", [Directory]),
          run_program(":- use_module(library(ev3dev/sim)).\n\c
                       :- use_module(library(process)).\n", [goal(Goal)],
                      killed(_), _),
          call_cleanup(
              forall(member(Call, [ev3_sysfs(Directory), ev3_dev(Directory)]),
                     is_told_stale(Call, Directory)),
              with_sim([], is_told_stale(sim_mount(Directory), Directory))),
          unmount(Directory) )).
test(ends_with_the_simulation_while_its_files_are_in_use,
     [ condition(can_mount),
       forall(member(End, [sim_stop, sim_start(room, [clock(virtual)])])) ]) :-
    with_directory(Directory,
        with_sim([],
                 ( sim_mount(Directory),
                   ev3_sysfs(Directory),
                   max_speed(outA, 1560),
                   End,
                   directory_files(Directory, Files),
                   msort(Files, ['.', '..']),
                   % For with_sim/2
                   sim_start(room) ))).
test(a_mode_can_be_written_though_time_stands_still,
     [condition(can_mount), true(Mode == "COL-COLOR\n")]) :-
    with_directory(Directory,
        with_sim([],
                 ( sim_mount(Directory),
                   atom_concat(Directory, '/lego-sensor/sensor1/mode', File),
                   setup_call_cleanup(open(File, write, Stream),
                                      write(Stream, 'COL-COLOR'),
                                      close(Stream)),
                   sim_step(0.1),
                   read_file_to_string(File, Mode, []),
                   sim_unmount ))).
:- end_tests(sim_mount).

is_told_stale(Call, Directory) :-
    functor(Call, Name, Arity),
    catch(Call, error(Formal, context(Called, Message)), true),
    assertion(Formal == existence_error(directory, Directory)),
    assertion(Called == Name/Arity),
    format(atom(Cure), '"fusermount -u ~w"', [Directory]),
    assertion(sub_atom(Message, _, _, _, Cure)).

unmount(Directory) :-
    (   member(Program-Arguments, [fusermount3-['-u'], fusermount-['-u'], umount-[]]),
        append(Arguments, [file(Directory)], All),
        catch(( process_create(path(Program), All, [process(Pid), stderr(null)]),
                process_wait(Pid, exit(0)) ), _, fail)
    ->  true
    ).

:- begin_tests(sim_mount_dev, [condition(can_mount)]).
test(shows_the_devices, true(Seen == [91136, [fb0, input], [event0, event1]])) :-
    on_dev(mount,
           ( ev3_dev(Dev),
             directory_file_path(Dev, fb0, Screen),
             directory_file_path(Dev, input, Input),
             size_file(Screen, Size),
             files(Dev, Names),
             files(Input, InputNames0),
             subtract(InputNames0, ['by-path'], InputNames),
             Seen = [Size, Names, InputNames] )).
test(its_devices_are_those_of_the_process, true(Keys == [left])) :-
    on_dev(mount,
           ( sim_press(left),
             findall(Key, button(Key), Keys) )).
test(ends_with_both, true(Files == [])) :-
    tmp_file(mount, A),
    tmp_file(mount, B),
    with_sim(room,
             ( maplist(make_directory, [A, B]),
               sim_mount(A, B),
               sim_unmount,
               findall(File, ( member(D, [A, B]), files(D, Fs), member(File, Fs) ),
                       Files),
               maplist(delete_directory, [A, B]) )).
test(leaves_nothing_mounted_if_one_cannot_be,
     [ true(Formal-Files == existence_error(directory, '/no/such')-[]) ]) :-
    tmp_file(mount, A),
    with_sim(room,
             ( make_directory(A),
               catch(sim_mount(A, '/no/such'), error(Formal, _), true),
               files(A, Files),
               delete_directory(A) )).
test(a_reader_of_events_can_be_interrupted_and_goes_on, true(Size == 24)) :-
    on_dev(mount,
           ( ev3_dev(Dev),
             directory_file_path(Dev, 'input/event1', File),
             later(0.3, sim_press(up)),
             process_create(path(head), ['-c', 24, file(File)],
                            [stdout(pipe(Out))]),
             set_stream(Out, type(binary)),
             read_bytes(Out, Bytes),
             close(Out),
             length(Bytes, Size) )).

files(Directory, Names) :-
    directory_files(Directory, Names0),
    subtract(Names0, ['.', '..'], Names1),
    msort(Names1, Names).

read_bytes(Stream, Bytes) :-
    get_byte(Stream, Byte),
    (   Byte == -1
    ->  Bytes = []
    ;   Bytes = [Byte|Rest],
        read_bytes(Stream, Rest)
    ).
:- end_tests(sim_mount_dev).

:- begin_tests(sim_things).
test(a_robot_pushes_a_thing) :-
    with_sim([box(0, 40, 6, 6, 0, [mass(0.05), name(cargo)])],
             ( set_robot(5.6, 10.6, outB, outC),
               sim_thing(cargo, 0.0, 40.0, 0.0),
               go_cm(30, 50),
               sim_pose(_, Y, _),
               sim_thing(cargo, X, ThingY, _) )),
    near(X, 0, 0.01),
    near(ThingY, Y+11, 1).
test(things_without_a_name_have_their_number,
     [X, Y]-Things == [50.0, 20.0]-[]) :-
    with_sim([],
             ( sim_add(circle(50, 20, 4, [mass(1), rolls(true)]), Id),
               sim_things([thing(Id, X, Y, _)]),
               sim_remove(Id),
               sim_things(Things) )).
test(what_stands_fast_is_no_thing, Things == []) :-
    with_sim([box(50, 50, 6, 6, 0, [name(post), color(red)])],
             sim_things(Things)).
test(a_crowd_is_pushed_to_the_last_bit, true(Digest == Expected)) :-
    crowd_digest(Digest, Expected).
test(options_are_checked, error(domain_error(thing_option, weight(1)), _)) :-
    with_sim([box(50, 50, 6, 6, 0, [weight(1)])], true).
test(too_light, error(domain_error(possible_geometry, _), _)) :-
    with_sim([], sim_add(box(50, 50, 6, 6, 0, [mass(0.001)]))).
test(fails_without_simulation, fail) :-
    sim_things(_).
:- end_tests(sim_things).
