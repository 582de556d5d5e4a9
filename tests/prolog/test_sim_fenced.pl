:- use_module('../support/child').
:- use_module('../support/old_prolog').
:- use_module('../support/probes').
:- use_module('../support/trees').
:- use_module(library(ev3dev/sim_fenced)).
:- use_module(library(socket), []).

has_unix_sockets :-
    predicate_property(socket:unix_domain_socket(_), defined).

%   A file with these lines, for Goal; or with those of a program for the robot.
with_program(Lines, File, Goal) :-
    with_lines([":- use_module(library(ev3dev))."|Lines], File, Goal).

with_lines(Lines, File, Goal) :-
    setup_call_cleanup(
        ( tmp_file(fenced, Base),
          atom_concat(Base, '.pl', File),
          setup_call_cleanup(open(File, write, Out),
                             forall(member(Line, Lines), ( write(Out, Line), nl(Out) )),
                             close(Out)) ),
        once(Goal),
        catch(delete_file(File), _, true)).

:- meta_predicate
    with_lines(+, ?, 0),
    with_program(+, ?, 0),
    in_room(0).

in_room(Goal) :-
    with_sim(room, Goal, [clock(virtual), noise(true), seed(4)]).

%   How a program of these lines ended, what it printed, and when and where that was.
fenced(Lines, Ended, Text, at(Seconds, Pose), Options) :-
    with_program(Lines, File,
                 in_room(( sim_fenced(File, Ended, [output(Text)|Options]),
                           sim_time(Seconds),
                           sim_pose(X, Y, Heading),
                           Pose = [X, Y, Heading] ))).

%   Loops that compute beside Goal.
:- meta_predicate beside(+, 0).

beside(Count, Goal) :-
    length(Loops, Count),
    setup_call_cleanup(
        maplist(starts_loop, Loops),
        once(Goal),
        forall(member(Loop, Loops), ( process_kill(Loop, kill), process_wait(Loop, _) ))).

starts_loop(Pid) :-
    process_create(path(sh), ['-c', 'while :; do :; done'], [detached(true), process(Pid)]).

%   What a program draws, also in two threads and beside another goal; and what it would draw
%   here.
drawn(Seed, Options, Text) :-
    with_program(["main :- thread_create(shown, Id, []), thread_join(Id, true),",
                  "    thread_create(shown, Id2, []), thread_join(Id2, true), shown,",
                  "    ( current_predicate(engine_create/3) -> race([shown, wait(9)], _) ; shown ).",
                  ":- use_module(library(ev3dev/events)).",
                  "shown :- X is random(1000000), random_between(1, 1000, Y), print(X-Y), nl."],
                 File,
                 with_sim(room, sim_fenced(File, exit(0), [output(Text)|Options]),
                          [clock(virtual), seed(Seed)])).

draws(Text) :-
    X is random(1000000),
    random_between(1, 1000, Y),
    format(string(Text), "~q~n", [X-Y]).

:- begin_tests(sim_fenced, [condition(starts_itself)]).
drives(["main :- drives.",
        "drives :- set_robot(5.6, 10.6, outB, outC), go_cm(20, 30),",
        "    forall(between(1, 100, _), us_dist_cm(in1, _)), us_dist_cm(in1, Cm),",
        "    concurrent(2, [motor_run(outB, 40, 180), motor_run(outC, 20, 90)], []),",
        "    col_ambient(_, Light), position(outB, Degrees), gyro_ang(_, Turned),",
        "    say('Hello', [wait(true)]), print([Cm, Light, Degrees, Turned]), nl."]).

test(as_in_one_process, Ended-Text-Pose == exit(0)-Printed-[X, Y, Heading]) :-
    drives(Lines),
    fenced(Lines, Ended, Text, at(_, Pose), []),
    with_program(Lines, File,
                 in_room(( load_files(fenced_here:File, [silent(true)]),
                           with_output_to(string(Printed), fenced_here:drives),
                           sim_pose(X, Y, Heading) ))).
test(things_are_pushed_and_held_as_in_one_process, true(Y-There == 40-Here)) :-
    Lines = [":- use_module(library(ev3dev/gripper)).",
             "main :- carries.",
             "carries :- set_robot(5.6, 10.6, outB, outC), set_gripper(outA, []),",
             "    release, go_cm(20, 9), grip, gripping, go_cm(20, 20), release."],
    World = [ box(0, 20, 6, 6, 0, [mass(0.05), name(cargo)]) ],
    Options = [clock(virtual), robot(carrier), noise(true), seed(4)],
    Cargo = sim_thing(cargo, X1, Y1, Heading1),
    There = [X1, Y1, Heading1],
    with_program(Lines, File,
                 ( with_sim(World, ( sim_fenced(File, exit(0), []), Cargo ), Options),
                   with_sim(World, ( load_files(fenced_things:File, [silent(true)]),
                                     fenced_things:carries,
                                     sim_thing(cargo, X2, Y2, Heading2) ), Options) )),
    Here = [X2, Y2, Heading2],
    Y is round(Y1).
test(both_clocks_go_on_together, Text-Seconds == "[12.5,20.0]\n"-20.0) :-
    with_program(["main :- ev3_time(A), wait(7.5), ev3_time(B), print([A, B]), nl."],
                 File,
                 in_room(( sim_step(12.5), sim_fenced(File, exit(0), [output(Text)]),
                           sim_time(Seconds) ))).
test(buttons_and_screen, Text == "shown\nenter at 3 s\n[up]\n") :-
    with_program(["main :- screen_text(0, 0, hello), screen_show, writeln(shown),",
                  "    button_wait(Button, pressed), ev3_time(T),",
                  "    format(\"~w at ~0f s~n\", [Button, T]),",
                  "    wait(2), findall(B, button(B), Bs), print(Bs), nl."],
                 File,
                 in_room(( sim_press(enter, [after(3), for(1)]),
                           sim_at(4, sim_press(up)),
                           sim_fenced(File, exit(0), [output(Text)]) ))).
test(what_its_rules_did, Rules == [first, second]) :-
    fenced([":- use_module(library(ev3dev/rules)).",
            "first :: ev3_time(T), T < 1 ~> wait(0.1).",
            "second :: true ~> wait(0.1).",
            "main :- behave([first, second])."],
           over, _, _, [seconds(3), told(Lines)]),
    findall(Rule, ( member(_-Text, Lines), member(Rule, [first, second]),
                    atom_concat('rule ', Rule, Words),
                    sub_string(Text, 0, _, _, Words) ), Found),
    sort(Found, Rules).
test(the_world_is_not_seen, Text == "existence_error\n") :-
    fenced(["main :- catch(sim_pose(_, _, _), error(E, _), true), functor(E, Name, _),",
            "    print(Name), nl."], exit(0), Text, _, []).
test(a_simulation_of_its_own_is_another_one, Pose == [40.0, 40.0, 40.0]) :-
    fenced([":- use_module(library(ev3dev/sim)).",
            "main :- sim_start([], [clock(virtual)]), motor_run(outB, 50), wait(3)."],
           exit(0), _, at(_, Pose), []).
test(its_time_is_over, Ended-Seconds == over-2.0) :-
    fenced(["main :- motor_run(outB, 50), repeat, wait(0.3), fail."],
           Ended, _, at(Seconds, _), [seconds(2)]).
test(it_computes_for_ever,
     [ forall(member(Goal, [ "repeat, fail", "repeat, catch((repeat, fail), _, true), fail",
                             "shell('while :; do :; done')" ])),
       Ended == limit(cpu) ]) :-
    format(string(Main), "main :- ~w.", [Goal]),
    fenced([Main], Ended, _, _, [cpu(1), sleep(infinite)]).
test(it_sleeps,
     [ forall(member(Goal, [ "sleep(1000)", "repeat, catch(sleep(0.1), _, true), fail",
                             "repeat, us_dist_cm(in1, _), sleep(0.01), fail",
                             "shell('sleep 1000')", "shell('kill -STOP $$')" ])),
       Ended == limit(sleep) ]) :-
    format(string(Main), "main :- ~w.", [Goal]),
    fenced([Main], Ended, _, _, [sleep(0.5), cpu(infinite)]).
%   Each of the others has a session, as some schedulers share by session.
test(what_others_compute_is_not_its_fault, Ended == over) :-
    beside(4, fenced(["main :- repeat, us_dist_cm(in1, D), D < 0."], Ended, _, _,
                     [seconds(10), sleep(0.5)])).
test(there_is_more_processor_time_while_it_drives, Ended-Seconds == over-40.0) :-
    fenced(["main :- repeat, numlist(1, 1000, L), msort(L, _), wait(0.01), fail."], Ended, _,
           at(Seconds, _), [seconds(40), cpu(0.2)]).
test(a_machine_that_is_too_busy, Ended == lost) :-
    setup_call_cleanup(
        ( retract(ev3dev_usage:most_still(Most)), assertz(ev3dev_usage:most_still(-1)) ),
        fenced(["main :- repeat, fail."], Ended, _, _, []),
        ( retract(ev3dev_usage:most_still(_)), assertz(ev3dev_usage:most_still(Most)) )).
test(it_prints_without_end, Ended-Length == limit(output)-1048576) :-
    fenced(["main :- repeat, write('so it goes'), nl, fail."], Ended, Text, _, []),
    string_length(Text, Length).
%   As of a process that was killed and had this number.
test(a_directory_that_was_left, Made == true) :-
    tmp_file(left, Last),
    atomic_list_concat(Parts, '_', Last),
    once(append(Before, [Number0], Parts)),
    atom_number(Number0, Number),
    Next is Number + 1,
    append(Before, [Next], Parts1),
    atomic_list_concat(Parts1, '_', Left),
    make_directory(Left),
    call_cleanup(ev3dev_directory:new_directory(left, Directory), delete_directory(Left)),
    ( exists_directory(Directory) -> Made = true ; Made = false ),
    delete_directory(Directory).
test(a_directory_that_cannot_be_made, error(existence_error(directory, _))) :-
    ev3dev_directory:new_directory('no/such', _).
test(it_halts, Ended == exit(3)) :-
    fenced(["main :- halt(3)."], Ended, _, _, []).
test(it_fails, Ended == exit(1)) :-
    fenced(["main :- us_dist_cm(in1, 0)."], Ended, _, _, []).
test(it_is_killed, Ended == killed(9)) :-
    fenced(["main :- current_prolog_flag(pid, Pid), format(atom(Kill), 'kill -9 ~w', [Pid]),",
            "    shell(Kill)."], Ended, _, _, []).
test(it_does_not_use_the_robot, Ended-Text-Seconds == exit(0)-"hello\n"-0.0) :-
    fenced(["main :- write(hello), nl."], Ended, Text, at(Seconds, _), []).
test(it_does_not_parse, true(sub_string(Text, _, _, _, "Operator expected"))) :-
    fenced(["main :- a b."], _, Text, _, []).
test(it_is_called_by_another_goal, Text == "[a,'B']\n") :-
    fenced(["shows(X) :- print(X), nl."], exit(0), Text, _, [goal(shows([a, 'B']))]).
test(its_random_numbers_follow_the_seed, Again == One) :-
    drawn(4, [], One),
    drawn(4, [salt('')], Again).
test(with_another_seed_or_salt_they_are_others) :-
    drawn(4, [], One),
    drawn(5, [], Other),
    drawn(4, [salt(secret)], Salted),
    atomic_list_concat([One, Other, Salted], Lines),
    split_string(Lines, "\n", "", Draws),
    sort(Draws, Different),
    length(Different, 13).              % with the empty one at the end
test(they_are_not_those_of_its_world) :-
    drawn(4, [], There),
    with_sim(room, draws(Here), [clock(virtual), seed(4)]),
    \+ sub_string(There, _, _, _, Here).
test(its_processes_have_no_robot, Text == "none none\n") :-
    fenced(["main :- shell('echo ${EV3DEV_FENCE-none} ${EV3DEV_TOLD-none}')."], exit(0), Text, _,
           [told(_)]).

test(after_one_comes_the_next, Texts == ["1\n", "1\n"]) :-
    with_program(["main :- us_dist_cm(in1, _), write(1), nl."], File,
                 in_room(findall(Text,
                                 ( between(1, 2, _),
                                   sim_fenced(File, exit(0), [output(Text)]) ),
                                 Texts))).
test(only_the_virtual_clock, error(permission_error(fence, clock, realtime))) :-
    with_program(["main."], File,
                 with_sim(room, sim_fenced(File, _), [clock(realtime)])).
test(no_simulation, fail) :-
    with_program(["main."], File, sim_fenced(File, _)).
test(no_file, error(existence_error(source_sink, nowhere))) :-
    in_room(sim_fenced(nowhere, _)).
test(wrong_option, error(domain_error(sim_fenced_option, seed(1)))) :-
    in_room(sim_fenced(nowhere, _, [seed(1)])).
:- end_tests(sim_fenced).

%   A directory with the file `secret`, which no program may read or harm.
:- meta_predicate with_kept(-, 0).

with_kept(Kept, Goal) :-
    setup_call_cleanup(
        ( tmp_file(kept, Kept), make_directory(Kept), atom_concat(Kept, '/secret', File),
          setup_call_cleanup(open(File, write, Out), write(Out, secret), close(Out)) ),
        once(Goal),
        ( catch(delete_file(File), _, true), delete_directory(Kept) )).

%   The fences of this process.
fences(Fences) :-
    current_prolog_flag(tmp_dir, Folder),
    current_prolog_flag(pid, Pid),
    atomic_list_concat([swipl_ev3dev_fence_, Pid, '_'], Begin),
    directory_files(Folder, Names),
    include([Name]>>sub_atom(Name, 0, _, _, Begin), Names, Fences).

%   Prolog names temporary files below the folder of this flag. 7.2.3 does not.
heeds_tmp_dir :-
    current_prolog_flag(version, Version),
    Version >= 80000.

:- meta_predicate in_deep_folder(0).

in_deep_folder(Goal) :-
    current_prolog_flag(tmp_dir, Was),
    tmp_file('it\'s deep', Base),
    findall(x, between(1, 120, _), Xs),
    atomic_list_concat([Base, /|Xs], Deep),
    setup_call_cleanup(
        ( make_directory_path(Deep), set_prolog_flag(tmp_dir, Deep) ),
        once(Goal),
        ( set_prolog_flag(tmp_dir, Was), delete_directory_and_contents(Base) )).

:- begin_tests(sim_fenced_walls, [condition(starts_itself)]).
test(a_deep_folder_for_temporary_files,
     [ forall(member(Enclosed, [false, true])),
       condition(( heeds_tmp_dir, ( Enclosed == false ; can_enclose ) )),
       Ended-Text == exit(0)-"here" ]) :-
    in_deep_folder(fenced(["main :- us_dist_cm(in1, _), write(here)."], Ended, Text, _,
                          [enclosed(Enclosed)])).
test(no_probe_succeeds, [condition(can_enclose), Succeed == []]) :-
    setup_call_cleanup(
        setenv('EV3DEV_TEST_SECRET', token),
        with_kept(Kept, ( probing(Kept, Lines),
                          fenced(Lines, Ended, Text, _, [enclosed(true), told(_), seconds(600)]) )),
        unsetenv('EV3DEV_TEST_SECRET')),
    split_string(Text, "\n", "", Names),
    findall(Name, ( probe(Name, _), atom_string(Name, Text1), memberchk(Text1, Names) ), Succeed),
    assertion(Ended == exit(0)).
test(its_rights_do_not_matter,
     [ forall(( member(Enclosed, [false, true]),
                member(Command, [ "chmod 000 .", "ln -s $KEPT link; ln -s $KEPT ../link",
                                  "for n in $(seq 1500); do mkdir ddddddddddddddd && cd ddddddddddddddd; done",
                                  "rm -rf ../output ../own", "rm ../output; mkdir -p ../output/x",
                                  "touch \"$(printf '\\\\377\\\\n')\"" ]) )),
       condition(( Enclosed == false ; can_enclose )),
       Fences-Secret == []-true ]) :-
    with_kept(Kept, ( atom_string(Shell, Command),
                      format(string(Main), "main :- us_dist_cm(in1, _), setenv('KEPT', ~q), shell(~q, _).",
                             [Kept, Shell]),
                      catch(fenced([Main], _, _, _, [enclosed(Enclosed)]), error(_, _), true),
                      atom_concat(Kept, '/secret', File),
                      ( exists_file(File) -> Secret = true ; Secret = false ) )),
    fences(Fences).
test(nobody_else_reads_what_it_has, Mode == "700\n") :-
    fenced(["main :- us_dist_cm(in1, _), shell('stat -c %a ..')."], _, Mode, _, []).
test(too_many_processes, Ended == limit(processes)) :-
    fenced(["main :- us_dist_cm(in1, _),",
            "    shell('for n in $(seq 300); do sleep 1000 & done; wait')."], Ended, _, _, []).
test(too_much_memory_together, Ended == limit(memory)) :-
    fenced(["main :- us_dist_cm(in1, _), shell('for n in $(seq 16); do",
            " { x=$(head -c 30000000 /dev/zero | tr \"\\\\0\" x); sleep 1000; } & done; wait')."],
           Ended, _, _, [memory(200)]).
test(what_a_killed_process_has_left,
     [ condition(heeds_tmp_dir), Found-Still == []-[] ]) :-
    current_prolog_flag(executable, Prolog),
    current_prolog_flag(tmp_dir, Folder),
    format(atom(Goal), "use_module(library(ev3dev/private/batch/workplace)), \c
                        set_prolog_flag(tmp_dir, ~q), new_workplace(left_here, D), \c
                        writeln(D), flush_output, read(_)", [Folder]),
    process_create(Prolog, ['-q', '-p', 'library=prolog', '-g', Goal, '-t', halt],
                   [stdin(pipe(In)), stdout(pipe(Out)), process(Pid)]),
    read_line_to_string(Out, Line),
    process_kill(Pid, kill),
    process_wait(Pid, _),
    forall(member(Stream, [In, Out]), close(Stream, [force(true)])),
    atom_string(Left, Line),
    assertion(exists_directory(Left)),
    ev3dev_workplace:new_workplace(left_here, Mine),
    ( exists_directory(Left) -> Found = [Left] ; Found = [] ),
    ev3dev_workplace:end_workplace(Mine),
    ( exists_directory(Mine) -> Still = [Mine] ; Still = [] ).
:- end_tests(sim_fenced_walls).

:- begin_tests(sim_fenced_wire, [condition(( starts_itself, has_unix_sockets ))]).
%   A program may know the socket, and speak for itself. An answer that is an error is as
%   long as the greeting, which comes before.
speaks(Questions, Ended) :-
    format(string(Asks), "    forall(member(Bytes, ~w),", [Questions]),
    with_lines([":- use_module(library(socket)).",
                "main :- getenv('EV3DEV_FENCE', Path), unix_domain_socket(Socket),",
                "    tcp_connect(Socket, Path), tcp_open_socket(Socket, In, Out),",
                "    forall(member(Stream, [In, Out]), set_stream(Stream, encoding(octet))),",
                Asks,
                "           ( forall(member(B, Bytes), put_byte(Out, B)), flush_output(Out),",
                "             forall(between(1, 16, _), get_byte(In, _)) )),",
                "    sleep(10)."], File,
               in_room(sim_fenced(File, Ended))).

%   Kind, whether it is free, and time in nanoseconds.
question([Kind, Free, Time], Bytes) :-
    findall(Byte, ( between(0, 7, N), Byte is Time >> (8*N) /\ 255 ), At),
    length(Rest, 16),
    maplist(=(0), Rest),
    append([[0, 0, 0, 0, Kind, Free, 0, 0], At, Rest], Bytes).

test(it_sends_garbage, Ended == refused("that was no question")) :-
    findall(255, between(1, 64, _), Bytes),
    speaks([Bytes], Ended).
test(it_turns_time_back,
     Ended == refused("its time went back")) :-
    question([0, 0, 1000000], First),
    question([0, 0, 999999], Second),
    speaks([First, Second], Ended).
test(it_reads_faster_than_the_brick_can,
     Ended == refused("its time went back")) :-
    question([4, 0, 500000], First),
    question([4, 0, 999999], Second),
    speaks([First, Second], Ended).
test(it_pretends_that_reads_take_no_time,
     Ended == refused("too many accesses took no time")) :-
    question([4, 1, 0], Question),
    findall(Question, between(1, 2001, _), Questions),
    speaks(Questions, Ended).
:- end_tests(sim_fenced_wire).
