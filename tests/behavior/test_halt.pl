:- use_module('../support/trees').
:- use_module('../support/child').

% The last commands to the motors, once a program is over.

% Since 9.3 halt/0 unwinds the stack, and does not come back if it is canceled; and
% thread_exit/1 does not end the main thread.
halt_returns :-
    current_prolog_flag(version, Version),
    Version < 90300.

% The program, run on a tree of its own, ends with Status; then outB has had
% the command B and outC the command C.
after_program(Tree, Text, Options, Status, B-C) :-
    with_tree(Tree, [outB-'lego-ev3-l-motor', outC-'lego-ev3-l-motor'],
              ( program_in_tree(Text, Program, TreeOptions),
                append(TreeOptions, Options, AllOptions),
                run_program(Program, AllOptions, Status, Output),
                left(outB, command, Output, B),
                left(outC, command, Output, C) )).

:- begin_tests(halt).
test(motors_that_were_started_are_stopped,
     [ forall(( tree(Tree),
                member(Start, [ "motor_run(outB, 20)",
                                "motor_run(outB, 20, 360, [wait(false)])",
                                "run_forever(outB, 200)",
                                "(speed_sp(outB, 200), motor_start(outB))",
                                "command(outB, 'run-direct')" ]) )),
       true(Status-C == exit(0)-(stop-'')) ]) :-
    format(string(Text), "main :- ~s.", [Start]),
    after_program(Tree, Text, [goal(main)], Status, C).
test(motors_that_were_stopped_are_left_alone,
     [forall(tree(Tree)), true(C == 'run-timed'-'')]) :-
    % As another program's doing
    after_program(Tree, "main :- motor_run(outB, 20), motor_stop(outB),
                                 command_file(outB, F), file_write(F, 'run-timed').",
                  [goal(main)], exit(0), C).
test(the_flag_leaves_them_running,
     [forall(tree(Tree)), true(C == 'run-forever'-'')]) :-
    after_program(Tree, "main :- set_prolog_flag(ev3dev_stop_at_halt, false),
                                 motor_run(outB, 20).",
                  [goal(main)], exit(0), C).
test(the_flag_may_be_set_before_loading,
     [forall(tree(Tree)), true(C == 'run-forever')]) :-
    with_tree(Tree, [outB-'lego-ev3-l-motor'],
              ( program_in_tree("main :- motor_run(outB, 20).", Program, Options),
                string_concat(":- create_prolog_flag(ev3dev_stop_at_halt, false, []).\n",
                              Program, Before),
                run_program(Before, [goal(main)|Options], _, Output),
                left(outB, command, Output, C) )).
test(an_uncaught_error_stops_them,
     [forall(tree(Tree)), true(Failed-C == failed-(stop-''))]) :-
    after_program(Tree, "main :- motor_run(outB, 20), atom_length(_, _).",
                  [goal(main)], Status, C),
    ( Status == exit(0) -> Failed = Status ; Failed = failed ).
test(one_that_has_no_descriptors_left_stops_them,
     [forall(tree(Tree)), true(C == stop-'')]) :-
    after_program(Tree, ":- use_module(library(rlimit)).
                         main :- motor_run(outB, 20), rlimit(nofile, _, 40),
                                 sleep(0.2), leak.
                         leak :- open('/dev/null', read, _), leak.",
                  [goal(main)], _, C).
test(without_descriptors_a_motor_can_be_stopped,
     [forall(tree(Tree)), true(Status-C == exit(0)-(stop-''))]) :-
    after_program(Tree, ":- use_module(library(rlimit)).
                         main :- motor_run(outB, 20), rlimit(nofile, _, 40),
                                 catch(leak, error(resource_error(_), _), true),
                                 sleep(0.2), motor_stop(outB),
                                 set_prolog_flag(ev3dev_stop_at_halt, false).
                         leak :- open('/dev/null', read, _), leak.",
                  [goal(main)], Status, C).
test(a_failed_goal_stops_them, [forall(tree(Tree)), true(C == stop-'')]) :-
    after_program(Tree, "main :- motor_run(outB, 20), fail.", [goal(main)], _, C).
test(halt_within_the_program_stops_them,
     [forall(tree(Tree)), true(Status-C == exit(3)-(stop-''))]) :-
    after_program(Tree, "main :- motor_run(outB, 20), halt(3).", [goal(main)], Status, C).
test(halt_in_a_thread_while_another_waits_stops_them,
     [forall(tree(Tree)), true(C == stop-'')]) :-
    after_program(Tree, "main :- shows_running,
                                 thread_create(motor_run(outB, 20, 360000), _, []),
                                 wait, halt.
                         % A plain file needs a command.
                         shows_running :- state_file(outB, F),
                                 catch(file_write(F, running),
                                       error(permission_error(_, _, _), _), true).
                         wait :- repeat, is_told, !.
                         is_told :- command_file(outB, F),
                                 catch(file_read(F, 'run-to-rel-pos'),
                                       error(permission_error(_, _, _), _),
                                       motor_states(outB, [running|_])).",
                  [goal(main)], _, C).
test(a_robot_that_is_driven_is_stopped,
     [ forall(( tree(Tree),
                member(Goal, [ "steer(30, 20)", "go_to(0, 50, [wait(false)])" ]) )),
       true(Status-C == exit(0)-(stop-stop)) ]) :-
    format(string(Text),
           ":- use_module(library(ev3dev/drive)).
            main :- set_robot(5.6, 10.6, outB, outC), ~s.", [Goal]),
    after_program(Tree, Text, [goal(main)], Status, C).

% From the end on no thread starts a motor.
test(what_goes_on_while_prolog_halts_starts_no_motor,
     [ forall(( tree(Tree),
                Tree \== simulator,
                member(Main, [ "thread_create(motor_run(outB, 20), _, [])",
                               "thread_create(control, _, [detached(true)]), sleep(0.2)",
                               "thread_create(setup_call_cleanup(true, wait(1000),
                                                                 motor_run(outB, -20)),
                                              _, []),
                                sleep(0.2)",
                               "thread_create(( thread_at_exit(motor_run(outB, 20)),
                                                wait(1000) ), _, []),
                                sleep(0.2)",
                               "at_halt(motor_run(outB, 20))" ]) )),
       true(memberchk(B, ['', stop])) ]) :-
    format(string(Text), "main :- ~s.
                          control :- repeat, motor_run(outB, 20), fail.", [Main]),
    after_program(Tree, Text, [goal(main)], _, B-_).
test(after_an_end_that_is_canceled_they_start_and_stop_as_ever,
     [condition(halt_returns), forall(tree(Tree)), true(Status-C == exit(0)-(stop-stop))]) :-
    after_program(Tree, ":- dynamic cancels/0.
                         cancels.
                         main :- at_halt(( retract(cancels) -> cancel_halt(not_yet) ; true )),
                                 motor_run(outB, 20), \\+ halt, motor_run(outC, 20).",
                  [goal(main)], Status, C).
:- end_tests(halt).

:- begin_tests(signals).
test(a_program_that_is_told_to_end_stops_its_motors,
     [ forall(( tree(Tree),
                member(Signal, [term, int, hup]),
                \+ says_nothing_at_its_end(Tree, Signal),
                member(Wait, [ "repeat, sleep(0.01), fail",
                               "motor_wait([outB, outC], [], _)",
                               "use_module(library(ev3dev/drive)),
                                set_robot(5.6, 10.6, outB, outC),
                                ev3dev_drive:go_to(0, 50)" ]) )),
       true(B-C == stop-stop) ]) :-
    with_tree(Tree, [outB-'lego-ev3-l-motor', outC-'lego-ev3-l-motor'],
              ( runs(outB),
                runs(outC),
                format(string(Text),
                       "main :- motors_run([run(outB, 20), run(outC, 20)]),
                                format(\"started~~n\"), flush_output, ~s.",
                       [Wait]),
                program_in_tree(Text, Program, Options),
                start_program(Program, [goal(main)|Options], Child),
                started(Child),
                ended_by(Signal, Child, _),
                end_output(Child, Output),
                left(outB, command, Output, B),
                left(outC, command, Output, C) )).

% 7.2.3 ends by Ctrl-C without its hooks, which say in the simulator what a motor had.
says_nothing_at_its_end(simulator, int) :-
    current_prolog_flag(version, Version),
    Version < 80000.

test(a_move_that_a_signal_stops_does_not_end,
     [ forall(( tree(Tree), Tree \== simulator, member(Round, [1, 2, 3, 4, 5, 6]) )),
       true(Went-Ends == no-true) ]) :-
    with_tree(Tree, [outB-'lego-ev3-l-motor', outC-'lego-ev3-l-motor'],
              ( runs(outB),
                runs(outC),
                program_in_tree("main :- set_robot(5.6, 10.6, outB, outC),
                                     writeln(started), flush_output,
                                     ( go_cm(20, 100) -> writeln(on) ; writeln(on) ),
                                     halt(5).",
                                Program, Options),
                start_program(Program, [goal(main)|Options], Child),
                started(Child),
                Child = child(Pid, _, _),
                PauseS is 0.05 * Round,
                sleep(PauseS),
                process_kill(Pid, term),
                end_program(Child, Status, Output) )),
    % Killed by the watchdog, if a busy machine has not let Prolog end within
    % 2 s.
    ( memberchk(Status, [exit(143), killed(15)]) -> Ends = true ; Ends = Status ),
    ( sub_string(Output, _, _, _, "on") -> Went = on ; Went = no ).

started(child(_, Out, _)) :-
    repeat,
    read_line_to_string(Out, Line),
    Line == "started",
    !.

ended_by(Signal, child(Pid, _, _), Status) :-
    process_kill(Pid, Signal),
    process_wait(Pid, Status, [timeout(300)]),
    catch(process_kill(Pid, kill), _, true),
    Status \== timeout.

after_a_while(Goal) :-
    sleep(0.2),
    call(Goal).

% Where Prolog handles no signal, and in crashes
test(one_signal_suffices_where_prolog_handles_none,
     [ forall(( tree(Tree),
                Tree \== simulator,
                member(Signal-Text,
                       [ term-":- initialization(main).",
                         hup-":- initialization(main).",
                         term-":- initialization(main).
                               again :- motor_run(outC, 30), sleep(0.05), again.
                               wait :- again.",
                         term-":- initialization(main, now).",
                         term-"wait :- shell('exec sleep 9 >/dev/null 2>&1').
                               :- initialization(main)." ]) )),
       true(B-C == stop-stop) ]) :-
    signalled(Tree, Signal, Text, [], B, C).
% Crashes, and other signals that end a process: SIGUSR1 and SIGPWR
test(a_crash_stops_the_motors,
     [ forall(( tree(Tree),
                Tree \== simulator,
                member(Signal, [6, 11, 10, 30]) )) ]) :-
    % The process that stays writes again, and empties a plain file for that.
    signalled(Tree, Signal, "", [goal(main)], _, eventually, stop, stop).
% In 7.2.3 Prolog's handler only notes the signal, and returns.
test(a_crash_whose_handler_hangs_ends_the_process,
     [ condition(( current_prolog_flag(version, Version), Version >= 80000 )),
       forall(( tree(Tree), Tree \== simulator )),
       true(Status == killed(11)) ]) :-
    % Here, too, the process that stays writes again.
    signalled(Tree, 11, ":- on_signal(segv, _, hangs).
                         hangs(_) :- repeat, fail.",
              [goal(main)], Status, eventually, stop, stop).
test(a_limit_stops_the_motors_of_a_program_that_goes_on,
     [ forall(( tree(Tree), Tree \== simulator, member(Signal, [24, 25]) )),
       true(Status-B-C == exit(0)-stop-stop) ]) :-
    % Nothing else does.
    signalled(Tree, Signal, ":- set_prolog_flag(ev3dev_stop_at_halt, false).
                             wait :- catch(wait(3), _, true).
                             % It may still be saying that it has begun.
                             limited :- catch(main, _, true).",
              [goal(limited)], Status, B, C).
% 7.2.3 ends by an assertion of its own when such a handler throws.
test(one_that_goes_on_after_a_crash_drives_again,
     [condition(( current_prolog_flag(version, Version), Version >= 80000 )),
      forall(( tree(Tree), Tree \== simulator )), true(Status == exit(5))]) :-
    signalled(Tree, 8, ":- on_signal(fpe, _, survived).
                        survived(_) :- throw(survived).
                        again :- catch(main, survived, true),
                                 repeat,
                                 sleep(0.01),
                                 catch(motor_run(outB, 20), _, fail),
                                 halt(5).",
              [goal(again)], Status, eventually, stop, stop).
test(a_process_that_is_killed_has_one_that_stops_its_motors,
     [ forall(( tree(Tree), Tree \== simulator )),
       true(Status == killed(9)) ]) :-
    signalled(Tree, kill, "", [goal(main)], Status, eventually, stop, stop).
test(one_that_runs_with_the_last_descriptors_is_stopped_as_well,
     [ forall(( tree(Tree), Tree \== simulator )), true(Status-C == killed(9)-stop) ]) :-
    with_tree(Tree, [outB-'lego-ev3-l-motor'],
              ( program_in_tree(":- use_module([library(process), library(rlimit)]).
                                 main :- rlimit(nofile, _, 40), leaked(Ss), started(Ss).
                                 leaked([S|Ss]) :-
                                     catch(open('/dev/null', read, S), _, fail), !,
                                     leaked(Ss).
                                 leaked([]).
                                 started([]) :-
                                     motor_run(outB, 20),
                                     current_prolog_flag(pid, Pid),
                                     process_kill(Pid, kill),
                                     sleep(9).
                                 started(Ss) :-
                                     catch(started([]),
                                           error(resource_error(max_files), _), fail)
                                     ;   Ss = [S|Ss1], close(S), started(Ss1).",
                                Program, Options),
                run_program(Program, [goal(main)|Options], Status, Output),
                eventually(( left(outB, command, Output, C),
                             \+ memberchk(C, ['', 'run-forever']) )) )).
test(a_copy_without_descriptors_does_not_keep_them_from_being_stopped,
     [ condition(catch(( use_module(library(unix)), predicate_property(fork(_), defined) ),
                       _, fail)),
       forall(( tree(Tree), Tree \== simulator )), true(Status-C == killed(9)-stop) ]) :-
    with_tree(Tree, [outB-'lego-ev3-l-motor'],
              ( program_in_tree(":- use_module([library(process), library(rlimit), library(unix)]).
                                 main :- motor_run(outB, 20), rlimit(nofile, _, 40), leaked,
                                     fork(Copy),
                                     (   Copy == child
                                     ->  exec(true)
                                     ;   wait(Copy, _),
                                         current_prolog_flag(pid, Pid),
                                         process_kill(Pid, kill),
                                         sleep(9)
                                     ).
                                 leaked :-
                                     catch(open('/dev/null', read, _), _, fail), !,
                                     leaked.
                                 leaked.",
                                Program, Options),
                run_program(Program, [goal(main)|Options], Status, Output),
                eventually(( left(outB, command, Output, C),
                             \+ memberchk(C, ['', 'run-forever']) )) )).
test(without_that_process_they_run_on,
     [ forall(( tree(Tree), Tree \== simulator )),
       true(B-C == 'run-forever'-'run-forever') ]) :-
    signalled(Tree, kill, ":- set_prolog_flag(ev3dev_stop_at_kill, false).",
              [goal(main)], _, after_a_while, B, C).
% An emulator has a thread of its own, which goes on.
test(they_stop_when_the_main_thread_has_ended_and_no_other_goes_on,
     [ condition(( halt_returns, starts_itself )), forall(( tree(Tree), Tree \== simulator )),
       true(Status-B-C == exit(0)-stop-stop) ]) :-
    after_program(Tree, "main :- motors_run([run(outB, 20), run(outC, 20)]),
                                    thread_exit(over).",
                  [goal(main)], Status, B-C).
test(a_handler_of_the_program_decides,
     [forall(( tree(Tree), Tree \== simulator )), true(Status-B-C == exit(7)-stop-stop)]) :-
    signalled(Tree, term,
              ":- on_signal(term, _, later).
               later(_) :- thread_create(( sleep(2.5), halt(7) ), _, []).",
              [goal(main)], Status, B, C).
test(a_handler_of_a_module_decides,
     [forall(( tree(Tree), Tree \== simulator )), true(Status-B-C == exit(7)-stop-stop)]) :-
    signalled(Tree, term,
              ":- on_signal(term, _:_, other:later).
               other:later(_) :- thread_create(halt(7), _, []).",
              [goal(main)], Status, B, C).
test(a_handler_set_before_loading_stays,
     [forall(tree(Tree)), true(Status-Output == exit(0)-"user:mine")]) :-
    with_tree(Tree, [outB-'lego-ev3-l-motor'],
              ( program_in_tree("main :- on_signal(term, M:H, M:H),
                                         format(\"~w\", [M:H]).",
                                Program, Options),
                string_concat(":- on_signal(term, _, mine).\nmine(_).\n",
                              Program, Before),
                run_program(Before, [goal(main)|Options], Status, Output) )).

signalled(Tree, Signal, Text, Options, B, C) :-
    signalled(Tree, Signal, Text, Options, _, B, C).

signalled(Tree, Signal, Text, Options, Status, B, C) :-
    signalled(Tree, Signal, Text, Options, Status, call, B, C).

%   When, a closure, asks for the commands to the motors.
signalled(Tree, Signal, Text, Options0, Status, When, B, C) :-
    with_tree(Tree, [outB-'lego-ev3-l-motor', outC-'lego-ev3-l-motor'],
              ( string_concat(
                    ":- dynamic wait/0.
                     main :- motors_run([run(outB, 20), run(outC, 20)]),
                             format(\"started~n\"), flush_output,
                             ( wait ; repeat, sleep(0.01), fail ).
                     ", Text, Both),
                program_in_tree(Both, Program, Options1),
                append(Options0, Options1, Options),
                start_program(Program, Options, Child),
                started(Child),
                ended_by(Signal, Child, Status),
                end_output(Child, _),
                call(When, ( left(outB, command, "", B),
                             left(outC, command, "", C) )) )).
:- end_tests(signals).
