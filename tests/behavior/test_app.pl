% The pack from a shell: app/ev3dev.pl, its answers and its exit status.

:- use_module('../support/child').
:- use_module(library(plunit)).
:- use_module(library(readutil)).

app(Line, Status, Output) :-
    split_string(Line, " ", "", Words),
    findall(Word,
            ( member(Text, Words), Text \== "", atom_string(Word, Text) ),
            Arguments),
    run_script('app/ev3dev.pl', Arguments, exit(Status), Output).

has(Output, Text) :-
    sub_string(Output, _, _, _, Text),
    !.

%   Loads no view and drives no motor: the command line alone is wrong.
refused("frob", "there is no command frob").
refused("run", "run needs a world or a file").
refused("run a.pl b.pl", "run does not take b.pl").
refused("run a.pl --seed", "--seed needs a value").
refused("run a.pl --seed x", "--seed needs a whole number, not x").
refused("run a.pl --for=never", "--for needs a number, not never").
refused("run a.pl --view=yes", "--view takes no value").
refused("devices --noise", "devices has no option --noise").
refused("jog --loud", "there is no option --loud").

:- begin_tests(app).

test(help_names_every_command) :-
    app("--help", 0, Output),
    forall(member(Text, ["view", "sim WORLD", "run FILE", "devices", "check",
                         "jog", "Status: 0"]),
           assertion(has(Output, Text))),
    app("", 0, Again),
    assertion(Output == Again).
test(a_wrong_command_line_ends_with_2,
     [forall(refused(Line, Why)), true(Status-Said == 2-true)]) :-
    app(Line, Status, Output),
    ( has(Output, Why) -> Said = true ; Said = Output ).
test(devices_are_those_of_the_world) :-
    app("devices --world room --robot touch", 0, Output),
    assertion(has(Output, "in4             lego-ev3-touch")).
test(a_program_runs_for_simulated_seconds) :-
    app("run examples/obstacle_avoidance.pl --world room --for 60 --seed 3",
        0, Output),
    assertion(has(Output, "60.00 s simulated")).
test(the_same_seed_runs_the_same, true(One == Two)) :-
    Line = "run examples/obstacle_avoidance.pl --world room --noise --seed 7 --for 30",
    app(Line, 0, One),
    app(Line, 0, Two).
test(a_goal_may_be_given) :-
    app("run examples/braitenberg.pl --world lights --goal vehicle(taste) --for 2",
        0, Output),
    assertion(has(Output, "2.00 s simulated")).
test(a_program_that_fails_ends_with_1) :-
    app("run examples/braitenberg.pl --world lights --goal fail", 1, Output),
    assertion(has(Output, "ev3dev: fail failed")).
test(a_program_that_throws_ends_with_1) :-
    app("run examples/braitenberg.pl --world lights --goal nothing_such", 1,
        Output),
    assertion(has(Output, "nothing_such/0")).
test(a_file_that_is_not_there_ends_with_1) :-
    app("run nothing_such.pl --world room", 1, Output),
    assertion(has(Output, "nothing_such.pl")).
test(check_reports_every_device) :-
    app("check --world room", 0, Output),
    assertion(has(Output, "lego-ev3-us")),
    assertion(has(Output, "end of report")).

:- end_tests(app).
