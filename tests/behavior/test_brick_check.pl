:- use_module('../support/trees').
:- use_module('../support/child').

% The report of examples/brick_check.pl on a tree of these devices. A motor is
% left stopped, a sensor in the mode it was in.
report(Tree, Devices, Prepare, Report) :-
    with_tree(Tree, Devices,
              ( call(Prepare),
                run_check(Report),
                findall(Port-Command,
                        ( member(Port-Type, Devices),
                          sub_atom(Type, _, _, _, motor),
                          left(Port, command, Report, Command) ),
                        Commands),
                assertion(forall(member(_-C, Commands), C == stop)),
                forall(member(Port-'lego-ev3-us', Devices),
                       assertion(left(Port, mode, Report, 'US-DIST-CM'))) )).

run_check(Report) :-
    program_in_tree(":- module_property(ev3dev, file(F)),
                        file_directory_name(F, D),
                        atom_concat(D, '/../examples/brick_check.pl', Script),
                        user:use_module(Script).",
                    Program, Options),
    run_program(Program, [goal(main)|Options], Status, Report),
    assertion(( Status == exit(0) ; is_warned(Report, Status) )),
    assertion(has(Report, "end of report")).

% Of a motor that is blocked there is a warning, which counts in the status
% here.
is_warned(Report, exit(1)) :-
    has(Report, "Motor blocked").

has(Report, Text) :-
    sub_string(Report, _, _, _, Text),
    !.

:- begin_tests(brick_check).
test(names_the_versions_and_the_library, [forall(tree(Tree))]) :-
    report(Tree, [], true, Report),
    pack_version(Version),
    string_concat("pack      ", Version, Pack),
    forall(member(Text, ["prolog ", "arch ", Pack, "ev3dev.so",
                         "Linux version", "no motor and no sensor"]),
           assertion(has(Report, Text))).
test(reads_each_mode_and_restores_the_own_one, [forall(tree(Tree))]) :-
    report(Tree, [in1-'lego-ev3-us'], put_attribute(in1, value0, 843), Report),
    forall(member(Text, ["US-DIST-CM: [84.3]", "US-DIST-IN: [84.3]",
                         "US-LISTEN: [", "1000 reads"]),
           assertion(has(Report, Text))).
test(does_not_calibrate, [forall(tree(Tree))]) :-
    report(Tree, [in4-'lego-ev3-gyro'], true, Report),
    assertion(has(Report, "GYRO-CAL: left out")).
test(says_that_a_motor_does_not_turn_and_leaves_it_stopped, [forall(tree(Tree))]) :-
    report(Tree, [outA-'lego-ev3-l-motor'], block(outA), Report),
    assertion(has(Report, "turn by 90 degrees: FAILED, 0 of")),
    assertion(has(Report, "turn by -90 degrees: FAILED, 0 of")).
% A motor turns.
test(says_that_a_motor_turns, [forall(behaving(Tree))]) :-
    report(Tree, [outA-'lego-ev3-l-motor'], true, Report),
    assertion(has(Report, "turn by 90 degrees: ok")),
    assertion(has(Report, "turn by -90 degrees: ok")).
test(does_not_lock_the_ultrasonic_sensor_up, [forall(tree(Tree))]) :-
    report(Tree, [in1-'lego-ev3-us'], put_attribute(in1, value0, 843), Report),
    assertion(has(Report, "US-SI-CM: left out")),
    assertion(has(Report, "US-SI-IN: left out")),
    assertion(\+ has(Report, "ERROR")).
test(an_error_does_not_end_the_report, [forall(tree(Tree))]) :-
    report(Tree, [in1-'lego-ev3-touch', in2-'lego-ev3-us'],
           ( put_attribute(in1, value0, nonsense),
             put_attribute(in2, value0, 843) ), Report),
    assertion(has(Report, "ERROR in")),
    assertion(has(Report, "US-DIST-CM: [84.3]")).
:- end_tests(brick_check).
