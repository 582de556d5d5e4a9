% The pack from a shell: app/ev3dev.pl, its answers and its exit status.

:- use_module('../support/child').

app(Line, Status, Output) :-
    app(Line, "", Status, Output).

%   With Typed at its prompt.

app(Line, Typed, Status, Output) :-
    split_string(Line, " ", "", Words),
    findall(Word,
            ( member(Text, Words), Text \== "", atom_string(Word, Text) ),
            Arguments),
    run_script('app/ev3dev.pl', Arguments, Typed, exit(Status), Output).

has(Output, Text) :-
    sub_string(Output, _, _, _, Text),
    !.

said(Output, Texts) :-
    forall(member(Text, Texts), assertion(has(Output, Text))).

%   The command line, in which `~w` is a file of these lines, and what is said
%   then; there the file is FILE.

app_of(Lines, Format, Status, Output) :-
    with_program(Lines, File,
                 ( format(string(Line), Format, [File]),
                   app(Line, Status, Output0) )),
    split_at(Output0, File, Parts),
    atomic_list_concat(Parts, 'FILE', Output1),
    atom_string(Output1, Output).

split_at(Text, File, Parts) :-
    atom_string(Atom, Text),
    atomic_list_concat(Parts, File, Atom).

:- meta_predicate with_program(+, -, 0).

with_program(Lines, File, Goal) :-
    tmp_file(program, Base),
    atom_concat(Base, '.pl', File),
    setup_call_cleanup(
        open(File, write, Out),
        forall(member(Line, [":- use_module(library(ev3dev))."|Lines]),
               format(Out, "~w~n", [Line])),
        close(Out)),
    call_cleanup(once(Goal), delete_file(File)).

%   Loads no view and drives no motor: the command line alone is wrong.
refused("frob", "there is no command frob; there are: view, sim, run, ").
refused("run", "run needs a program: ").
refused("try line", "try needs a PROGRAM").
refused("sim", "sim needs a world: bar, cans, convoy, ").
refused("run a.pl b.pl", "run does not take b.pl").
refused("devices a.pl", "devices does not take a.pl").
refused("run a.pl --world", "--world needs a world").
refused("run a.pl --world room --seed", "--seed needs a whole number").
refused("run a.pl --world room --seed x", "--seed needs a whole number, not x").
refused("run a.pl --for=never", "--for needs a number, not never").
refused("run a.pl --view=yes", "--view takes no value").
refused("devices --noise", "devices has no option --noise").
refused("jog --loud", "jog has no option --loud").
% What is not there is named, with what there is
refused("run nothing_such.pl --world room",
        "there is no program nothing_such.pl; there are: backtracking, braitenberg, ").
refused("run square --world moon",
        "there is no world moon; there are: bar, cans, ").
refused("run square --world room --robot tuch",
        "there is no robot tuch; there are: carrier, default, touch").
refused("run square --world room --clock fast",
        "--clock needs virtual, realtime, or a factor, not fast").
refused("run square --world room --goal square(", "--goal needs a goal, not square(").
refused("run square --world room --goal 3", "--goal needs a goal, not 3").
refused("jog --world room --speed 500",
        "--speed needs a number above 0, at most 100, not 500").
refused("jog --world room --wheel 0", "--wheel needs a number above 0, not 0").
refused("sim room --port 99999 --no-open", "--port needs a whole number below 65536").
refused("view --address me", "--address needs any, not me").
% What would say nothing
refused("devices --robot touch", "--robot needs --world").
refused("run square --seed 3", "--seed needs --world").
refused("run square --world room --no-open", "--no-open needs --view").

%   What is said of a program. Its lines begin in line 2 of its file.
ends([ "start :-",
       "    blink(foo).",
       "blink(Color) :-",
       "    led(left, Color)."
     ], "", ["ERROR: FILE:5: led/2: foo is not one of: off"]).
ends([ "start :-",
       "    step(foo).",
       "step(N) :-",
       "    (   N == 1",
       "    ->  true",
       "    ;   X is N+1,",
       "        print(X)",
       "    )."
     ], "", ["ERROR: FILE:7: is/2: Arithmetic", "foo/0"]).
ends([ "start :-",
       "    \\+ \\+ ( true,",
       "             gocm(20) ),",
       "    true."
     ], "--for 3", ["ERROR: FILE:4: there is no gocm/1", "go_cm(Speed"]).
ends([ "start :-",
       "    step(3).",
       "step(N) :-",
       "    N > 2,",
       "    motor_run(outB, 500),",
       "    print(N)."
     ], "",
     [ "highest speed is 100 %",
       "ERROR: FILE:6: start failed; its last goal was motor_run(outB,500), in step/1" ]).
% No clause of step/1 is for 4. What cleans up is not to blame.
ends([ "start :-",
       "    setup_call_cleanup(",
       "        true,",
       "        step(3),",
       "        finish).",
       "step(3) :-",
       "    step(4).",
       "finish :-",
       "    stop_all_motors,",
       "    fail."
     ], "--for 3",
     [ "ERROR: FILE:8: start failed; its last goal was step(4), in step/1" ]).
ends([ "start(_) :- true." ], "--goal start(X),fail",
     [ "start(_", "failed" ]).
ends([ ":- use_module(library(lists)).",
       "start :-",
       "    max_list([], _)." ], "",
     [ "ERROR: FILE:4: start failed; its last goal was max_list([],_), in start/0" ]).
ends([ "start :-",
       "    throw(oops(1))." ], "",
     [ "ERROR: FILE:3: oops(1) was thrown" ]).
% It is thrown again, by its catcher.
ends([ "start :-",
       "    catch(led(left, foo), E, again(E)).",
       "again(E) :-",
       "    throw(E)." ], "",
     [ "ERROR: FILE:5: led/2: foo is not one of: off" ]).

:- begin_tests(app).
test(help_names_every_command) :-
    app("--help", 0, Output),
    said(Output, ["view [FILE]", "sim WORLD", "run FILE", "devices", "check",
                  "jog", "Status: 0", "delivery", "sumo"]),
    app("", 0, Again),
    assertion(Output == Again).
test(help_of_a_command_has_its_options_alone,
     [forall(member(Line, ["run --help", "run square -h", "help run"]))]) :-
    app(Line, 0, Output),
    said(Output, ["run FILE", "--for S", "--goal GOAL", "sumo", "touch",
                  "obstacle_avoidance"]),
    assertion(\+ has(Output, "--axle")),
    assertion(\+ has(Output, "Status")).
test(it_says_its_version) :-
    pack_version(Version),
    app("--version", 0, Output),
    string_concat("ev3dev ", Version, Said),
    said(Output, [Said, "SWI-Prolog "]).
test(a_wrong_command_line_ends_with_2,
     [forall(refused(Line, Why)), true(Status-Said == 2-true)]) :-
    app(Line, Status, Output),
    ( has(Output, Why) -> Said = true ; Said = Output ).
test(a_program_without_start_is_told_of_goal) :-
    app_of(["begin :- true."], "run ~w --world room", 2, Output),
    said(Output, ["has neither start/0 nor main/0", "--goal"]).
test(devices_are_those_of_the_world) :-
    app("devices --world room --robot touch", 0, Output),
    assertion(has(Output, "in4             lego-ev3-touch")).
test(a_program_runs_for_simulated_seconds) :-
    app("run examples/obstacle_avoidance.pl --world room --for 60 --seed 3",
        0, Output),
    assertion(has(Output, "60.00 s simulated")),
    assertion(has(Output, "it ran into nothing.")).
test(an_example_has_no_path, true(One == Two)) :-
    app("run slalom --world line --for 3", _, One),
    app("run examples/slalom.pl --world line --for 3", _, Two).
test(the_same_seed_runs_the_same, true(One == Two)) :-
    Line = "run examples/obstacle_avoidance.pl --world room --noise --seed 7 --for 30",
    app(Line, 0, One),
    app(Line, 0, Two).
test(a_goal_may_be_given) :-
    app("run examples/braitenberg.pl --world lights --goal vehicle(taste) --for 2",
        0, Output),
    assertion(has(Output, "2.00 s simulated")).
test(what_prolog_tried_is_printed) :-
    app("run backtracking --world room --reasoning", 1, Output),
    said(Output, ["6.46 s simulated", "1. way(left)", "given up: 38.1 > 60",
                  "Why false? way(right) went furthest", "start failed"]).
test(a_program_that_fails_ends_with_1) :-
    app("run examples/braitenberg.pl --world lights --goal fail", 1, Output),
    assertion(has(Output, "fail failed")).
test(a_program_that_throws_ends_with_1) :-
    app("run examples/braitenberg.pl --world lights --goal nothing_such", 1,
        Output),
    assertion(has(Output, "nothing_such/0")).
test(it_says_where_a_program_ended,
     [forall(ends(Lines, Options, Texts))]) :-
    atom_concat('run ~w --world room ', Options, Format),
    app_of(Lines, Format, 1, Output),
    said(Output, [" s simulated" | Texts]).
% Its cleanups are in its module.
test(an_example_that_is_a_module_runs) :-
    app("run brick_check --world room", 0, Output),
    assertion(has(Output, "end of report")),
    assertion(\+ has(Output, "ERROR")).
test(a_collision_is_counted) :-
    app("run square --world room", 1, Output),
    assertion(has(Output, "it ran into something once.")).
test(check_reports_every_device) :-
    app("check --world room", 0, Output),
    said(Output, ["lego-ev3-us", "end of report"]),
    assertion(\+ has(Output, "ERROR")).
test(check_takes_the_time_of_the_simulated_robot) :-
    app("check --world room", 0, Output),
    assertion(has(Output, "1000 reads: 5")),
    assertion(\+ has(Output, "in 0.00 s")).
:- end_tests(app).

:- begin_tests(app_prompt).
test(the_prompt_has_the_libraries,
     forall(member(Line, ["sim room --no-open", "view --no-open"]))) :-
    app(Line,
        "set_robot(5.6, 10.6, outB, outC), go(30), stop, sim_pose(_, _, _).\n\c
         set_pose(1, 2, 3), pose(X, Y, _), writeln(at(X, Y)).\n\c
         view_url(_), writeln(seen).\n",
        0, Output),
    said(Output, ["at(1.0,2.0)", "seen"]),
    assertion(\+ has(Output, "Correct")),
    assertion(\+ has(Output, "Warning")).
test(a_program_keeps_its_own_names) :-
    with_program([ ":- use_module(library(ev3dev/grid)).",
                   "pose(mine, 1, 1)." ], File,
                 ( format(string(Line), "view ~w --no-open", [File]),
                   app(Line, "pose(Whose, _, _), writeln(Whose).\n\c
                              tacho_motor(outB), sim_pose(_, _, _), writeln(seen).\n",
                       0, Output) )),
    said(Output, ["mine", "seen"]),
    assertion(\+ has(Output, "Warning")),
    assertion(\+ has(Output, "ERROR")).
test(the_prompt_blames_what_was_called) :-
    app("sim room --no-open", "led(left, foo).\n", 0, Output),
    said(Output, ["led/2", "foo is not one of: off"]),
    assertion(\+ has(Output, "main/1")).
:- end_tests(app_prompt).

%   What the papers say to type, and the examples in it.

:- begin_tests(app_in_papers).
%   Lines of a paper that call the app, as typed in the repository.

typed(File, Typed) :-
    ( File = 'README.md' ; expand_file_name('docs/*.md', Files), member(File, Files) ),
    read_file_to_string(File, Text, []),
    split_string(Text, "\n", "", Lines),
    member(Line, Lines),
    member(Prefix, ["    swipl ev3dev ", "    swipl app/ev3dev.pl "]),
    string_concat(Prefix, Rest, Line),
    % It serves until it is interrupted.
    \+ sub_string(Rest, 0, _, _, "playground"),
    split_string(Rest, "#", " ", [Typed|_]).

test(there_are_some) :-
    once(typed('docs/view.md', _)).
test(they_work, [forall(typed(File, Typed)), true(Status-Warned == 0-false)]) :-
    assertion(atom(File)),
    (   sub_string(Typed, _, _, _, "run ")
    ->  without_view(Typed, Line)
    ;   string_concat(Typed, " --no-open", Line)
    ),
    app(Line, Status, Output),
    (   ( has(Output, "Warning") ; has(Output, "ERROR") )
    ->  Warned = Output
    ;   Warned = false
    ).

%   With the view it would take as long as it says. The virtual clock does the
%   same.

without_view(Typed, Line) :-
    (   sub_string(Typed, Before, _, After, " --view")
    ->  sub_string(Typed, 0, Before, _, Front),
        sub_string(Typed, _, After, 0, Back),
        string_concat(Front, Back, Line)
    ;   Line = Typed
    ).
:- end_tests(app_in_papers).

%   An installed pack has no Makefile.

:- begin_tests(app_playground, [condition(exists_source(library(http/http_open)))]).
:- use_module(library(http/http_open)).
:- use_module(library(socket)).

test(a_folder_without_one) :-
    app("playground tests", 2, Output),
    said(Output, ["tests has no playground: make playground, "]).
test(its_files_are_served_and_no_other,
     Type-Index-Found == 'text/html'-"<p>Here."-[]) :-
    tmp_file(playground, Folder),
    setup_call_cleanup(
        ( make_directory(Folder),
          length(Parts, 1000000),
          maplist(=(0'p), Parts),
          string_codes(All, Parts),
          written(Folder, 'parts.bin', All),
          written(Folder, '.hidden', ""),
          directory_file_path(Folder, view, View),
          make_directory(View),
          written(View, 'index.html', "<p>There."),
          written(Folder, 'index.html', "<p>Here.") ),
        with_playground(Folder, Url,
            ( got(Url, '', 200, Type, Index),
              got(Url, 'view/', 200, Type, "<p>There."),
              got(Url, 'parts.bin', 200, 'application/octet-stream', All),
              findall(Path, ( member(Path, ['none.js', '../secret', 'none/', view,
                                            '.hidden', '/etc/passwd', 'view/../index.html',
                                            stop, ws, 'samples.csv']),
                              got(Url, Path, Code, _, _),
                              Code < 400 ), Found) )),
        delete_directory_and_contents(Folder)).
% Four connections that said nothing, such as a browser makes, kept a page waiting for a minute.
test(silent_connections_hold_nobody_up) :-
    tmp_file(playground, Folder),
    setup_call_cleanup(
        ( make_directory(Folder), written(Folder, 'index.html', "") ),
        with_playground(Folder, Url,
            ( parse_url(Url, Parts),
              memberchk(port(Port), Parts),
              findall(S, ( between(1, 8, _), tcp_connect(localhost:Port, S, []) ), Silent),
              tcp_connect(localhost:Port, Page, []),
              format(Page, "GET / HTTP/1.0\r\n\r\n", []),
              flush_output(Page),
              wait_for_input([Page|Silent], First, 600),
              maplist(close, [Page|Silent]),
              memberchk(Page, First) )),
        delete_directory_and_contents(Folder)).

written(Folder, Name, Text) :-
    directory_file_path(Folder, Name, File),
    setup_call_cleanup(open(File, write, Out), write(Out, Text), close(Out)).

:- meta_predicate with_playground(+, -, 0).

with_playground(Folder, Url, Goal) :-
    format(string(Text),
           ":- use_module(library(ev3dev/private/app/playground_server)).~n\c
            go :- serve(~q, localhost, 0, false).~n", [Folder]),
    setup_call_cleanup(
        start_program(Text, [goal(go)], Child),
        ( Child = child(_, Out, _),
          read_line_to_string(Out, Line),
          string_concat("The playground is at ", Url, Line),
          once(Goal) ),
        kill_program(Child)).

got(Url, Path, Code, Type, Text) :-
    string_concat(Url, Path, Address),
    setup_call_cleanup(
        http_open(Address, In, [ status_code(Code),
                                 header(content_type, Type0) ]),
        read_string(In, _, Text),
        close(In)),
    split_string(Type0, ";", "", [Type1|_]),
    atom_string(Type, Type1).
:- end_tests(app_playground).

:- begin_tests(install, [condition(exists_file('Makefile'))]).
%   What `make check` would do, in the environment of pack_install or not.

checks(Environment, Output) :-
    append([Environment, ['MAKEFLAGS=', make, '-n', check]], Arguments),
    process_create(path(env), Arguments,
                   [stdout(pipe(Out)), stderr(null), process(Pid)]),
    read_string(Out, _, Output),
    close(Out),
    process_wait(Pid, exit(0)).

test(a_shell_checks_all) :-
    checks([], Output),
    said(Output, ["check-rust", "tests/run.sh"]).
test(pack_install_checks_the_least,
     [forall(member(Name, ['SWIHOME', 'SWIPL_HOME_DIR']))]) :-
    atom_concat(Name, '=/usr/lib/swi-prolog', Assignment),
    checks([Assignment], Output),
    said(Output, ["tests/brick/smoke.pl", "tests/brick/example.pl"]),
    assertion(\+ has(Output, "tests/run.sh")),
    assertion(\+ has(Output, "check-rust")).
:- end_tests(install).
