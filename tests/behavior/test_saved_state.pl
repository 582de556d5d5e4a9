% A program that was compiled into a state (`swipl -o prog -c prog.pl`) does what
% it does as a file.

:- use_module('../support/trees').
:- use_module('../support/child').

% The program, saved and then run, ends with Status and prints Output; then outB
% has had Command.
after_state(Tree, Text, Status, Output, Command) :-
    tmp_file(state, State),
    with_tree(Tree, [outB-'lego-ev3-l-motor', in1-'lego-ev3-touch'],
              setup_call_cleanup(
                  save(Text, State, Options),
                  ( run_state(State, Options, Status, Output),
                    left(outB, command, Output, Command) ),
                  catch(delete_file(State), _, true))).

save(Text, State, Options) :-
    program_in_tree(Text, Program, Options),
    format(atom(Save), "qsave_program(~q, [goal(main), toplevel(halt)])", [State]),
    run_program(Program, [goal(Save)], Status, Said),
    assertion(Status-Said == exit(0)-"").

% A program in another process.
:- begin_tests(saved_state).
test(reads_and_runs, Status-Seen == exit(0)-"0") :-
    after_state(plain, "main :- touch(in1, T), write(T).", Status, Seen, _).
test(stops_its_motors_when_it_halts, Command == stop) :-
    after_state(plain, "main :- motor_run(outB, 20).", _, _, Command).
test(what_is_loaded_at_first_use_is_found, Caught == "led_color") :-
    after_state(plain, "main :- catch(led(left, blu), error(domain_error(_, blu), _),
                                      write(led_color)).", _, Caught, _).
:- end_tests(saved_state).
