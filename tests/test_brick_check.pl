:- use_module(tree).
:- use_module(child).
:- use_module(library(plunit)).

% The report of examples/brick_check.pl on a tree of these devices.
report(Devices, Prepare, Report) :-
    with_tree(Devices,
              ( call(Prepare),
                tree_root(Root),
                run_program(Root, Report),
                findall(Port-Command,
                        ( member(Port-Type, Devices),
                          sub_atom(Type, _, _, _, motor),
                          get_attribute(Port, command, Command) ),
                        Commands),
                assertion(forall(member(_-C, Commands), C == stop)),
                forall(member(Port-'lego-ev3-us', Devices),
                       assertion(get_attribute(Port, mode, 'US-DIST-CM'))) )).

run_program(Root, Report) :-
    run_program(":- use_module(library(ev3dev)).
                 :- module_property(ev3dev, file(F)),
                    file_directory_name(F, D),
                    atom_concat(D, '/../examples/brick_check.pl', Script),
                    user:use_module(Script).",
                [env('EV3DEV_SYSFS'=Root), goal(main)], Status, Report),
    assertion(Status == exit(0)),
    assertion(has(Report, "end of report")).

has(Report, Text) :-
    sub_string(Report, _, _, _, Text),
    !.

:- begin_tests(brick_check).

test(names_the_versions_and_the_library) :-
    report([], true, Report),
    forall(member(Text, ["prolog ", "arch ", "pack      0.", "ev3dev.so",
                         "Linux version", "no motor and no sensor"]),
           assertion(has(Report, Text))).
test(reads_each_mode_and_restores_the_own_one) :-
    report([in1-'lego-ev3-us'], true, Report),
    forall(member(Text, ["US-DIST-CM: [84.3]", "US-DIST-IN: [84.3]",
                         "US-LISTEN: [", "1000 reads"]),
           assertion(has(Report, Text))).
test(does_not_calibrate) :-
    report([in4-'lego-ev3-gyro'], true, Report),
    assertion(has(Report, "GYRO-CAL: left out")).
test(says_that_a_motor_does_not_turn_and_leaves_it_stopped) :-
    report([outA-'lego-ev3-l-motor'], true, Report),
    assertion(has(Report, "turn by 90 degrees: FAILED, 0 of")),
    assertion(has(Report, "turn by -90 degrees: FAILED, 0 of")).
test(an_error_does_not_end_the_report) :-
    report([in1-'lego-ev3-touch', in2-'lego-ev3-us'],
           put_attribute(in1, value0, nonsense), Report),
    assertion(has(Report, "ERROR in")),
    assertion(has(Report, "US-DIST-CM: [84.3]")).

:- end_tests(brick_check).
