% library(ev3dev/exercise): what is earned, that it is the same each time, and that no program
% gets more than its due.

:- use_module('../support/cases').
:- use_module('../support/cheats').
:- use_module('../support/child').
:- use_module('../support/old_prolog').
:- use_module('../support/redis').
:- use_module('../support/trees').
:- use_module(library(ev3dev/exercise)).
:- use_module(library(ev3dev/sim_fenced), [can_enclose/0]).

exercise_lines([ ":- use_module(library(ev3dev/exercise)).",
                 "exercise(hundred, [seconds(8), seeds(1-3), cpu(1), sleep(5), memory(1000)]).",
                 "world(Seed, [bounds(0, 0, Width, 200), start(30, 30, 90)]) :-",
                 "    Width is 180+Seed.",
                 "score(4, 'drives') :- path_length(Cm), Cm > 100.",
                 "score(partial(2), 'drives far', Share) :- path_length(Cm), Share is Cm/100.",
                 "score(4, 'touches <nothing>') :- collisions(0), path_length(Cm), Cm > 40.",
                 "forbid(secret/1)." ]).

:- dynamic folder/1.

%   A folder with the exercise; file/2 writes programs into it.
with_folder(Goal) :-
    tmp_file(exercise, Folder),
    make_directory(Folder),
    setup_call_cleanup(
        asserta(folder(Folder)),
        ( exercise_lines(Lines), file(exercise, Lines, _), call(Goal) ),
        ( retract(folder(Folder)), delete_directory_and_contents(Folder) )).

file(Name, Lines, File) :-
    folder(Folder),
    atomic_list_concat([Folder, /, Name, '.pl'], File),
    setup_call_cleanup(open(File, write, Out, [encoding(utf8)]),
                       forall(member(Line, Lines), ( write(Out, Line), nl(Out) )),
                       close(Out)).

:- meta_predicate with_folder(0).

program(Name, File) :-
    honest(Honest),
    (   Name == honest
    ->  Lines = Honest
    ;   cheat(Name, Own),
        Honest = [Loads|_],
        Lines = [Loads|Own]
    ),
    file(Name, Lines, File).

%   The marks of these programs, with what they said on the way.
marked(Names, Options, Marks) :-
    with_folder(( findall(File, ( member(Name, Names), program(Name, File) ), Files),
                  mark_files(Files, Options, Marks) )).

marked_lines(Lines, Options, Mark) :-
    with_folder(( file(mine, Lines, File), mark_files([File], Options, [Mark]) )).

%   By another exercise.
marked_by(Exercise, Lines, Mark) :-
    with_folder(( file(exercise, [":- use_module(library(ev3dev/exercise))."|Exercise], _),
                  file(mine, Lines, File),
                  mark_files([File], [], [Mark]) )).

mark_files(Files, Options, Marks) :-
    folder(Folder),
    atom_concat(Folder, '/exercise', Exercise),
    ( can_enclose -> Fence = [] ; Fence = [enclosed(false)] ),
    append(Options, Fence, All),
    quietly(exercise_mark(Exercise, Files, All, Marks)).

:- meta_predicate quietly(0).

quietly(Goal) :-
    setup_call_cleanup(
        asserta((user:message_hook(ev3dev(Message), _, _) :-
                     memberchk(Message, [not_enclosed, not_marked(_, _)]), !), Clause),
        once(Goal),
        erase(Clause)).

:- dynamic user:message_hook/3.
:- multifile user:message_hook/3.

%   Its points are not those of a file that loads nothing.
earns(Lines, Points, Reason) :-
    marked_lines(Lines, [seeds(1-2)], mark(mine, Points, 10, _, _, Reason)).

reason(Names, Reasons) :-
    marked(Names, [seeds(1-2)], Marks),
    findall(Reason, member(mark(_, _, _, _, _, Reason), Marks), Reasons).

:- begin_tests(exercise, [condition(starts_itself)]).
test(honest, Marks == [ mark(honest, 10, 10,
                             [ score(drives, 4, 4, 0), score('drives far', 2, 2, 0),
                               score('touches <nothing>', 4, 4, 0) ],
                             [run(1, 10, exit(0), T), run(2, 10, exit(0), T)], '') ]) :-
    marked([honest], [seeds(1-2)], Marks),
    Marks = [mark(_, _, _, _, [run(_, _, _, T)|_], _)].
test(a_part_of_the_points, true(between(5, 6, Points))) :-
    earns([ ":- use_module(library(ev3dev)).",
            "start :- set_robot(5.6, 10.6, outB, outC), go_cm(60, 50)." ], Points, _).
test(it_reads_and_does_nothing, Points-Reason == 0-'It started no motor.') :-
    earns([":- use_module(library(ev3dev)).", "start :- us_dist_cm(_, _), start."], Points, Reason).
%   One is the library's, which stops the other motor at the end.
test(commands, Points == 2) :-
    marked_by([ "exercise(four, [seeds(1)]).", "score(2, four) :- commands(4)." ],
              [ ":- use_module(library(ev3dev)).",
                "start :- motor_run(outB, 100), motor_run(outC, 100), wait(1),",
                "    col_color(in3, _), motor_stop(outB)." ], mark(mine, Points, _, _, _, _)).
test(where_it_ended, Points == 3) :-
    marked_by([ "exercise(ends, [seeds(1)]).", "world(_, [start(50, 50, 90)]).",
                "score(1, there) :- ended_at(X-Y, _), abs(X-70) < 2, abs(Y-50) < 2.",
                "score(2, 'looks west') :- ended_at(_, Heading), abs(Heading-270) < 5." ],
              [ ":- use_module(library(ev3dev)).",
                "start :- set_robot(5.6, 10.6, outB, outC), go_cm(30, 20), turn(20, -180)." ],
              mark(mine, Points, _, _, _, _)).
%   By a quarter to the right, and back over north.
test(how_far_it_turned, true(abs(Points-1.9) < 0.1)) :-
    marked_by([ "exercise(turns, [seeds(1)]).", "world(_, [start(50, 50, 40)]).",
                "score(partial(10), turns, Share) :- path_turns(Degrees), Share is Degrees/1000." ],
              [ ":- use_module(library(ev3dev)).",
                "start :- set_robot(5.6, 10.6, outB, outC), turn(30, 90), turn(30, -100)." ],
              mark(mine, Points, _, _, _, _)).
%   11 of 21 marks.
test(half_a_lap, Points == 5.24) :-
    marked_by([ "exercise(lap, [seeds(1)]).",
                "world(_, [start(0, 0, 90), line(black, 2, [0-0, 100-0])]).",
                "score(partial(10), lap, Share) :- lap_fraction(5, Share)." ],
              [ ":- use_module(library(ev3dev)).",
                "start :- set_robot(5.6, 10.6, outB, outC), go_cm(30, 47)." ],
              mark(mine, Points, _, _, _, _)).
test(it_runs_into_something, Points-Missed == 6-2) :-
    marked_lines([ ":- use_module(library(ev3dev)).",
                   "start :- set_robot(5.6, 10.6, outB, outC), go(60), wait(10)." ],
                 [seeds(1-2)], mark(_, Points, _, [_, _, score(_, _, _, Missed)], _, _)).
test(one_that_goes_wrong_on_its_way, Points == 10) :-
    earns([ ":- use_module(library(ev3dev)).",
            "start :- set_robot(5.6, 10.6, outB, outC), go_cm(60, 110), nothing." ],
          Points, Reason),
    assertion(sub_atom(Reason, 0, _, _, 'It ended at ')),
    assertion(sub_atom(Reason, _, _, _, 'nothing/0')).
test(why_it_has_no_points, true(Reasons = [ 'It did not use the robot.',
                                            'Stopped after 1 s of processor time (robot time 0.0 s).',
                                            'Line 2, column 11: Operator expected: a comma may be missing between a and b.' ])) :-
    reason([halts_at_once, does_not_end, does_not_parse], Reasons).
test(what_is_forbidden, Points-Reason == 0-'Line 2: secret/1 may not be used here.') :-
    earns([ ":- use_module(library(ev3dev)).",
            "start :- wait(1), call((true, secret(1)))." ], Points, Reason).
test(no_such_file, Points-Reason == 0-'It cannot be read.') :-
    with_folder(( folder(Folder), atom_concat(Folder, '/nowhere.pl', File),
                  mark_files([File], [seeds(1)], [mark(nowhere, Points, _, _, _, Reason)]) )).
test(two_runs_that_do_not_end_are_enough, Ends == [limit(cpu), limit(cpu), not_run]) :-
    cheat(does_not_end, Lines),
    marked_by([ "exercise(three, [seconds(8), seeds(1-3), cpu(1)]).",
                "score(1, none) :- fail." ],
              [":- use_module(library(ev3dev))."|Lines], mark(mine, 0, _, _, Runs, _)),
    findall(End, member(run(_, _, End, _), Runs), Ends).
test(its_random_numbers_follow_the_seed, Points == Again) :-
    draws(Points),
    draws(Again),
    assertion(( Points > 0, Points < 10 )).

draws(Points) :-
    marked_by([ "exercise(random, [seeds(1-4)]).",
                "score(partial(10), far, Share) :- path_length(Cm), Share is Cm/200." ],
              [ ":- use_module(library(ev3dev)).",
                "start :- set_robot(5.6, 10.6, outB, outC), D is 60+random(100), go_cm(20, D)." ],
              mark(mine, Points, _, _, _, _)).

%   Its machine is too busy for the first run, or for all.
test(a_run_that_is_lost_is_made_again,
     [ forall(member(Until-Points/Reason,
                     [ 1-10/'', 9-0/'It was not marked, because the machine was too busy: mark it again.' ])),
       Points0/Reason0 == Points/Reason ]) :-
    tmp_file(lost, Count),
    format(string(Happens), "happens(_) :- lost_until(~w, ~q).", [Until, Count]),
    call_cleanup(
        marked_by([ "exercise(lost, [seeds(1)]).", "score(10, drives) :- path_length(Cm), Cm > 5.",
                    Happens,
                    "lost_until(Until, File) :-",
                    "    ( exists_file(File) -> number_in(File, N) ; N = 0 ), M is N+1,",
                    "    setup_call_cleanup(open(File, write, S), format(S, '~w.', [M]), close(S)),",
                    "    ( N < Until -> retractall(ev3dev_usage:most_still(_)),",
                    "        assertz(ev3dev_usage:most_still(-1)) ; true ).",
                    "number_in(File, N) :-",
                    "    setup_call_cleanup(open(File, read, S), read(S, N), close(S))." ],
                  [ ":- use_module(library(ev3dev)).",
                    "start :- set_robot(5.6, 10.6, outB, outC), go_cm(20, 10)." ],
                  mark(mine, Points0, _, _, _, Reason0)),
        delete_file(Count)).
test(the_same_with_any_number_of_jobs, Two == One) :-
    Names = [honest, says_its_marks, does_not_parse],
    marked(Names, [jobs(1)], One),
    marked(Names, [jobs(2)], Two).
test(the_same_by_redis, [condition(can_use_redis), There == Here]) :-
    Names = [honest, does_not_parse],
    marked(Names, [seeds(1-2)], Here),
    current_prolog_flag(executable, Swipl),
    with_redis_server(Port,
        ( format(atom(Address), 'localhost:~w', [Port]),
          setup_call_cleanup(
              process_create(Swipl, ['-q', 'app/ev3dev.pl', work, '--redis', Address, '--workers', 1],
                             [stdin(null), stdout(null), stderr(null), process(Pid)]),
              marked(Names, [seeds(1-2), redis(localhost:Port)], There),
              ( process_kill(Pid, int), process_wait(Pid, _) )) )).
test(the_red_team, true(Over == [])) :-
    findall(Name, cheat(Name, _), All),
    length(All, Count),
    assertion(Count >= 40),
    (   all_cases,
        can_enclose                     % some would take the machine with them
    ->  Names = All
    ;   length(Names, 10),
        append(Names, _, All)
    ),
    append(Names, [honest], Tried),
    marked(Tried, [seeds(1)], Marks),
    findall(Name, member(mark(Name, _, _, _, _, _), Marks), Found),
    assertion(Found == Tried),
    last(Marks, mark(honest, Best, _, _, _, _)),
    assertion(Best == 10),
    findall(Name-Points,
            ( member(mark(Name, Points, _, _, _, _), Marks),
              Name \== honest,
              Points > 0 ),
            Over).
test(nobody_of_them_lives) :-
    marked([leaves_a_process], [seeds(1), enclosed(false)], _),
    \+ descendant("sleep\u00001000").

test(reports, true) :-
    with_folder(( folder(Folder),
                  atom_concat(Folder, '/marks', Out),
                  program(honest, Honest),
                  honest(Lines),
                  file('<b>&"x', Lines, Odd),
                  program(does_not_parse, Broken),
                  mark_files([Honest, Odd, Broken], [out(Out)], _),
                  read_report(Out, 'index.html', Index),
                  read_report(Out, 'pages/honest.html', Page),
                  read_report(Out, 'marks.csv', Csv),
                  read_report(Out, 'junit.xml', Junit),
                  read_report(Out, 'results.json', Json),
                  read_report(Out, 'gradescope/honest.json', Gradescope) )),
    assertion(\+ sub_string(Index, _, _, _, "<b>&")),
    assertion(sub_string(Index, _, _, _, "Line 2, column 11: Operator expected: a comma may be missing between a and b.")),
    assertion(sub_string(Index, _, _, _, "3 programs, 6.67 points in the mean")),
    assertion(sub_string(Page, _, _, _, "touches &lt;nothing&gt;")),
    assertion(sub_string(Page, _, _, _, "<svg ")),
    assertion(sub_string(Page, _, _, _, "const film = [[300,300,90],")),
    assertion(sub_string(Csv, 0, _, _, "name,points,of,drives,drives far,touches <nothing>,remark\r\nhonest,10,10,4,2,4,")),
    assertion(sub_string(Junit, _, _, _, "failures=\"3\"")),
    assertion(sub_string(Json, _, _, _, "\"points\":10")),
    assertion(sub_string(Gradescope, _, _, _, "\"max_score\":4")).

read_report(Out, Name, Text) :-
    atomic_list_concat([Out, /, Name], File),
    read_file_to_string(File, Text, [encoding(utf8)]).

test(a_program_of_two_files, Name-Points-Text == alice-10-'') :-
    with_folder(( folder(Folder), atom_concat(Folder, '/class', Class),
                  atom_concat(Class, '/alice/lib', Lib), make_directory_path(Lib),
                  honest([Loads, Start]),
                  file('class/alice/mine', [":- use_module(lib/way).", Loads, "start :- way."], _),
                  sub_string(Start, 9, _, 0, Way0), string_concat("way :- ", Way0, Way),
                  file('class/alice/lib/way', [":- module(way, [way/0]).", Loads, Way], _),
                  file('class/alice/old', ["start."], _),
                  mark_files([Class], [seeds(1)], [mark(Name, Points, _, _, _, Text)]) )).
test(a_forbidden_word_in_utf8, Reason == 'Line 1: secret/1 may not be used here.') :-
    marked_lines(["start :- secret('\u00e9'), \u00e9."], [], mark(mine, _, _, _, _, Reason)).
test(one_format, Names == ['marks.csv']) :-
    with_folder(( folder(Folder), atom_concat(Folder, '/marks', Out),
                  program(honest, File),
                  mark_files([File], [seeds(1), out(Out), formats([csv])], _),
                  directory_files(Out, Found) )),
    subtract(Found, ['.', '..', 'runs.pl'], Names).

%   The program leaves a mark where it is run, if the fence is open.
test(only_what_has_changed_is_run_again, Runs-Again == [4, 4, 6, 7, 8]-Marks) :-
    with_folder(( folder(Folder), atom_concat(Folder, '/marks', Out),
                  honest([Loads|Honest]),
                  atom_concat(Folder, '/runs', Count),
                  format(string(Notes), ":- open(~q, append, S), write(S, x), close(S).", [Count]),
                  file(one, [Loads, Notes|Honest], One),
                  file(two, [Loads, Notes|Honest], Two),
                  Options = [out(Out), formats([json]), enclosed(false), jobs(1), resume(true)],
                  counted(Count, [One, Two], [seeds(1-2)|Options], First, Marks),
                  counted(Count, [One, Two], [seeds(1-2)|Options], Second, Again),
                  counted(Count, [One, Two], [seeds([1, 2, 7])|Options], Third, _),
                  cut_off(Out),
                  counted(Count, [One, Two], [seeds([1, 2, 7])|Options], Fourth, _),
                  file(two, [Loads, Notes, "% changed"|Honest], Two),
                  counted(Count, [One, Two], [seeds(1)|Options], Fifth, _) )),
    Runs = [First, Second, Third, Fourth, Fifth].

%   A file that the exercise loads, and one that has the facts of a world, are changed and left.
test(what_an_exercise_loads_has_changed, Runs == [1, 1, 2, 2, 3]) :-
    with_folder(( folder(Folder),
                  atom_concat(Folder, '/runs', Count),
                  atom_concat(Folder, '/place.pl', Place),
                  honest([Loads|Honest]),
                  format(string(Notes), ":- open(~q, append, S), write(S, x), close(S).", [Count]),
                  file(one, [Loads, Notes|Honest], _),
                  file(exercise, [ ":- use_module(library(ev3dev/exercise)), use_module(helper).",
                                   "exercise(hundred, [seconds(8)]).",
                                   "world(_, World) :- its_world(World).",
                                   "score(4, 'drives') :- path_length(Cm), Cm > 100." ], _),
                  format(string(Its), "its_world(~q).", [Place]),
                  findall(Runs0,
                          ( member(Text-Width, [""-200, ""-200, "% 2"-200, "% 2"-200, "% 2"-210]),
                            format(string(Bounds), "bounds(0, 0, ~d, 200).", [Width]),
                            file(place, [Bounds, "start(30, 30, 90)."], _),
                            file(helper, [":- module(helper, [its_world/1]).", Its, Text], _),
                            command([ mark, exercise, 'one.pl', '--seeds', '1', '--resume',
                                      '--no-fence' ]),
                            size_file(Count, Runs0) ),
                          Runs) )).

%   In a process of its own, which is in the folder.
command(Arguments) :-
    current_prolog_flag(executable, Prolog),
    folder(Folder),
    absolute_file_name('app/ev3dev.pl', App),
    process_create(Prolog, ['-q', App|Arguments],
                   [stdin(null), stdout(null), stderr(null), cwd(Folder), process(Pid)]),
    process_wait(Pid, exit(0)).

test(a_file_of_the_pack_has_changed, [true(( First == Same, Same \== Other ))]) :-
    with_folder(( folder(Folder), atom_concat(Folder, '/prolog', Own), make_directory(Own),
                  sources("a.", First), sources("a.", Same), sources("b.", Other) )).

sources(Text, Hash) :-
    file('prolog/a', [Text], _),
    folder(Folder),
    ev3dev_marking_kept:sources(Folder, Hash).

counted(File, Programs, Options, Count, Marks) :-
    mark_files(Programs, Options, Marks),
    size_file(File, Count).

%   The last line, as if the marker had been killed in it.
cut_off(Out) :-
    atom_concat(Out, '/runs.pl', File),
    read_file_to_string(File, Text, []),
    sub_string(Text, 0, _, 3, Short),
    setup_call_cleanup(open(File, write, S), write(S, Short), close(S)).

%   Ctrl-C ends the marking while a program drives, and another marking goes on where it was. The
%   program that earns nothing is watched in one more run.
test(an_interrupted_marking_goes_on, [condition(can_enclose), Left-Lines == []-3]) :-
    current_prolog_flag(executable, Prolog),
    with_folder(( folder(Folder), program(honest, One),
                  atom_concat(Folder, '/exercise.pl', Exercise),
                  atom_concat(Folder, '/out', Out), atom_concat(Out, '/runs.pl', File),
                  atom_concat('TMP=', Folder, TMP),
                  file(slow, [":- use_module(library(ev3dev)).", "start :- col_ambient(_, _), start."],
                       Slow),
                  Command = ['-q', 'app/ev3dev.pl', mark, Exercise, One, Slow, '--seeds', '1',
                             '--jobs', '1', '--out', Out],
                  process_create(path(env), [TMP, Prolog|Command],
                                 [ stdin(null), stdout(null), stderr(pipe(Err)), process(Pid) ]),
                  until(lines(File, 1)),
                  process_kill(Pid, int),
                  read_string(Err, _, Said),
                  close(Err),
                  process_wait(Pid, exit(1)),
                  assertion(sub_string(Said, _, _, _, "with --resume goes on")),
                  directory_files(Folder, Names),
                  include([Name]>>sub_atom(Name, 0, _, _, swipl_), Names, Left),
                  append(Command, ['--resume'], Again),
                  file(slow, [":- use_module(library(ev3dev)).", "start :- col_ambient(_, _)."], _),
                  process_create(Prolog, Again,
                                 [stdin(null), stdout(null), stderr(null), process(Pid2)]),
                  process_wait(Pid2, exit(0)),
                  lines(File, Lines) )).

lines(File, Count) :-
    exists_file(File),
    read_file_to_string(File, Text, []),
    split_string(Text, "\n", "", Lines),
    length(Lines, Count0),
    Count is Count0-1.

:- meta_predicate until(0).

until(Goal) :-
    between(1, 60000, _),
    ( call(Goal) -> true ; sleep(0.01), fail ),
    !.

test(a_full_disk_names_the_file, error(io_error(write, '/dev/full'))) :-
    ev3dev_marking_report:to_file('/dev/full', write(marks)).
test(no_folder_for_its_reports, error(_)) :-
    with_folder(( folder(Folder), atom_concat(Folder, '/file', File), program(honest, Honest),
                  setup_call_cleanup(open(File, write, S), true, close(S)),
                  mark_files([Honest], [out(File)], _) )).
%   Whatever a program breaks, the others get their marks. Without an enclosure `../..` is a
%   folder of the marking, but /tmp where Prolog heeds no tmp_dir, as 7.2.3: nothing is removed there.
test(what_one_breaks_is_its_own_loss,
     [ forall(( member(Enclosed-All, [true-"rm -rf ../../*",
                                      false-"[ ! -e ../../batch.pl ] || rm -rf ../../*"]),
                member(Command, ["rm -rf ../output ../own", "rm ../output; mkfifo ../output",
                                 All, "chmod 000 . ..", "kill -9 -1"]) )),
       condition(( Enclosed == true -> can_enclose ; Command \== "kill -9 -1" )),
       Points == 10 ]) :-
    atom_string(Shell, Command),
    format(string(Breaks), ":- shell(~q, _).", [Shell]),
    honest([Loads|Honest]),
    with_folder(( file(breaks, [Loads, Breaks|Honest], File), program(honest, Good),
                  mark_files([File, Good], [seeds(1), jobs(1), enclosed(Enclosed)],
                             [_, mark(_, Points, _, _, _, _)]) )).
test(programs_that_are_alike, true(sub_string(Index, _, _, _, "a and b: 100 %"))) :-
    Lines = ["one(X) :- two(X, _).", "two(A, B) :- three(A), three(B).", "three(_).", "start."],
    Others = ["one(Y) :- two(Y, _).", "two(C, D) :- three(C), three(D).", "three(_).", "start."],
    alike(Lines, Others, Index).
test(they_are_side_by_side, Marked-Plain == 9-1) :-
    Lines = ["one(X) :- two(X).", "two(A) :- three(A),", "    three(A).", "three(_).",
             "own(\u00e9).", "start."],
    Others = ["three(_).", "start.", "one(Y) :- two(Y).", "", "% A remark.",
              "two(C) :- three(C), three(C)."],
    alike(Lines, Others, Index),
    occurrences("<mark>", Index, Marked),
    occurrences("\nown(\u00e9).\n", Index, Plain).

alike(Lines, Others, Index) :-
    with_folder(( folder(Folder), atom_concat(Folder, '/marks', Out),
                  file(a, Lines, A), file(b, Others, B),
                  mark_files([A, B], [seeds(1), out(Out), formats([html])], _),
                  read_report(Out, 'index.html', Index) )).

occurrences(Part, Text, Count) :-
    findall(x, sub_string(Text, _, _, _, Part), All),
    length(All, Count).

test(try, true(sub_string(Text, _, _, _, "Together: 10 of 10 points, in 3 runs."))) :-
    with_folder(( folder(Folder), atom_concat(Folder, '/exercise', Exercise),
                  program(honest, File),
                  with_output_to(string(Text), quietly(exercise_try(Exercise, File, []))) )).
test(how_far_it_is_on_a_terminal,
     Lines == [ "0 of 3 runs.", "1 of 3 runs; ", "2 of 3 runs; ", "3 of 3 runs.", "" ]) :-
    with_progress(true, honest, Lines).
test(no_line_that_renews_itself_in_a_log, Lines == []) :-
    with_progress(false, honest, Lines).
test(the_run_that_is_watched_has_its_line, Lines == ["Watching the run with the seed 1 again.", ""]) :-
    with_progress(true, is_empty, All),
    append([_, _, _, _], Lines, All).

:- dynamic user:progress_text/1.

%   What try prints on a terminal or not, up to the time that is left.
with_progress(Terminal, Name, Lines) :-
    stream_property(Error, alias(user_error)),
    ( stream_property(Error, tty(true)) -> Was = true ; Was = false ),
    with_folder(( folder(Folder), atom_concat(Folder, '/exercise', Exercise),
                  program(Name, File),
                  setup_call_cleanup(
                      ( set_stream(Error, tty(Terminal)),
                        asserta((user:message_hook(ev3dev(marking_now(Form-Values)), _, _) :-
                                     format(string(Text), Form, Values),
                                     assertz(user:progress_text(Text))), Clause) ),
                      with_output_to(string(_),
                                     ignore(quietly(exercise_try(Exercise, File, [jobs(1)])))),
                      ( erase(Clause), set_stream(Error, tty(Was)) )) )),
    findall(Line, ( retract(user:progress_text(Text0)), up_to_time(Text0, Line) ), Lines).

up_to_time(Text, Line) :-
    (   sub_string(Text, Before, _, _, "about")
    ->  sub_string(Text, 0, Before, _, Line)
    ;   Line = Text
    ).

test(the_page_of_a_name_of_255_bytes, true(Pages = [_])) :-
    with_folder(( folder(Folder), honest(Honest),
                  length(Codes, 252), maplist(=(0'x), Codes), atom_codes(Name, Codes),
                  file(Name, Honest, File),
                  file_base_name(File, Base),
                  command([try, exercise, Base, '--seeds', '1']),
                  atom_concat(Folder, '/x*.html', Pattern),
                  expand_file_name(Pattern, Pages) )).
test(try_fails, fail) :-
    with_folder(( folder(Folder), atom_concat(Folder, '/exercise', Exercise),
                  program(is_empty, File),
                  with_output_to(string(_), quietly(exercise_try(Exercise, File, []))) )).

wrong_exercise(Lines, What) :-
    with_folder(( file(wrong, Lines, File),
                  catch(exercise_mark(File, [], [], _), error(domain_error(exercise, What), _),
                        true) )).

test(no_exercise, true(nonvar(What))) :-
    wrong_exercise(["score(1, x)."], What).
test(no_scores, true(nonvar(What))) :-
    wrong_exercise(["exercise(x, [])."], What).
test(a_warning_is_printed_once, [forall(member(Command, [try, mark]))]) :-
    with_folder(( exercise_lines(Lines),
                  append(Lines, ["score(1, lonely) :- cells_visited(30, Count)."], All),
                  file(exercise, All, _), program(honest, _), said_by(Command, Said) )),
    assertion(occurrences("Singleton", Said, 1)).
test(wrong_setting, What == [secs(3)]) :-
    wrong_exercise(["exercise(x, [secs(3)]).", "score(1, x)."], What).
test(a_setting_of_old, What == wall(3)) :-
    wrong_exercise(["exercise(x, [wall(3)]).", "score(1, x)."], What).
test(wrong_points, What == score(lots, x)) :-
    wrong_exercise(["exercise(x, []).", "score(lots, x)."], What).
test(a_misspelt_predicate_of_a_score, What-Text == [path_lenght/1, xyzzy/0]-Says) :-
    Says = 'line 3: there is no path_lenght/1 (did you mean path_length/1?); line 4: there is no xyzzy/0',
    with_folder(( file(wrong, [ ":- use_module(library(ev3dev/exercise)).", "exercise(x, []).",
                                "score(1, far) :- path_lenght(Cm), Cm > 1.",
                                "score(partial(1), x, S) :- findall(x, xyzzy, L), length(L, S)." ], File),
                  catch(exercise_mark(File, [], [], _),
                        error(domain_error(exercise, What), context(_, Text)), true) )).
%   Nothing is marked in another world, or without a score.
test(an_exercise_that_does_not_load,
     [ forall(( member(Broken, [ "world(_, [start(0, 0, 90).", "score(1, 'far) :- fail.",
                                 ":- use_module(nowhere)." ]),
                member(Command, [try, mark, check]) )),
       Told == 1 ]) :-
    with_folder(( exercise_lines(Lines), append(Lines, [Broken], All), file(exercise, All, _),
                  program(honest, _), said_by(Command, Said) )),
    split_string(Said, "\n", "", Printed),
    findall(Line, ( member(Line, Printed), wildcard_match("ERROR:*exercise.pl:9:*", Line) ), Errors),
    length(Errors, Told),
    assertion(occurrences("exercise.pl does not load without errors", Said, 1)),
    assertion(\+ sub_string(Said, _, _, _, "points")).

test(an_error_in_a_rule_has_its_line,
     [ forall(member(Line-Says,
           [ "world(_, [bound(0, 0, 200, 260)])."-"bound(0,0,200,260): a world has: *",
             "world(_, X) :- X > 1."-"*sufficiently instantiated",
             "happens(_) :- X > X."-"*sufficiently instantiated",
             "score(1, x) :- collisions(_), M < M."-"*sufficiently instantiated",
             "score(partial(1), x, _)."-"*sufficiently instantiated",
             "score(1, x) :- ended_near(corner, D), D < 1."-"ended_near/2: a place must be X-Y, not corner" ])),
       true(wildcard_match(Pattern, Text)) ]) :-
    atom_concat('exercise.pl:3: ', Says, Pattern),
    with_folder(( file(exercise, [ ":- use_module(library(ev3dev/exercise)).",
                                   "exercise(x, [seeds(1), seconds(5)]).", Line,
                                   "score(1, drives) :- path_length(Cm), Cm > 10." ], _),
                  program(honest, File),
                  catch(mark_files([File], [], _), error(_, context(_, Text)), true) )).
test(a_wrong_option_is_named,
     [ forall(member(Option-Says, [ "second(90)"-"second(90) is not one of: goal, seconds, *Did you mean seconds?",
                                    "seeds(4-1)"-"the value of the option seeds(4-1) makes no sense",
                                    "x"-"x is not one of: goal, *", "_"-"_ is not one of: goal, *" ])),
       true(wildcard_match(Says, Text)) ]) :-
    format(string(Line), "exercise(x, [noise(true), ~w]).", [Option]),
    with_folder(( file(wrong, [Line, "score(1, x)."], File),
                  catch(exercise_mark(File, [], [], _), error(_, context(_, Text)), true) )).
test(wrong_seeds, true(wildcard_match("seeds must be *", Text))) :-
    catch(mark_wrongly(seeds(5-3)), error(domain_error(seeds, 5-3), context(_, Text)), true).
test(wrong_format, true(wildcard_match("pdf is not one of: html, *csv*", Text))) :-
    catch(mark_wrongly(formats([pdf])), error(domain_error(marks_format, pdf), context(_, Text)), true).

mark_wrongly(Option) :-
    with_folder(mark_files([], [Option], _)).

%   Each of these is used by nothing, or by a rule of the exercise.
test(a_misspelt_fact_of_an_exercise,
     [ forall(member(Line-Meant, [ "wrold(_, [start(0, 0, 90)])."-"wrold/2 (did you mean world/2?)",
                                   "world(_)."-"world/1 (did you mean world/2?)",
                                   "scor(1, far) :- fail."-"scor/2 (did you mean score/2?)",
                                   "hapens(_)."-"hapens/1 (did you mean happens/1?)",
                                   "forbidden(x/1)."-"forbidden/1 (did you mean forbid/1?)" ])),
       What-Text == [Name/Arity]-Says ]) :-
    split_string(Meant, "/ ", "", [Name0, Arity0|_]),
    atom_string(Name, Name0),
    number_string(Arity, Arity0),
    atom_concat('line 9: nothing uses ', Meant, Says),
    with_folder(( exercise_lines(Lines), append(Lines, [Line], All), file(exercise, All, File),
                  catch(exercise_check(File), error(domain_error(exercise, What), context(_, Text)),
                        true),
                  program(honest, _), said_by(try, Said) )),
    string_concat("Warning: exercise.pl: ", Says, Warning),
    assertion(occurrences(Warning, Said, 1)),
    assertion(sub_string(Said, _, _, _, "Together: 10 of 10 points")).
test(a_helper_with_such_a_name_is_used, Found == []) :-
    with_folder(( exercise_lines(Lines),
                  append(Lines, [ "score(1, x) :- findall(C, scores(C), _).", "scores(C) :- member(C, [1]).",
                                  "other(_)." ], All),
                  file(exercise, All, File),
                  ev3dev_marking_read:read_exercise(File, Read),
                  findall(Names, ev3dev_marking_check:unused(Read, Names, _), Found) )).

%   What a process of its own, in the folder, prints.
said_by(Command, Said) :-
    folder(Folder),
    current_prolog_flag(executable, Prolog),
    absolute_file_name('app/ev3dev.pl', App),
    (   Command == check
    ->  absolute_file_name(prolog, Library),
        format(atom(Load), 'library=~w', [Library]),
        Arguments = [ '-q', '-p', Load, '-g', 'use_module(library(ev3dev/exercise)),exercise_check(exercise)',
                      '-t', halt ]
    ;   Arguments = ['-q', App, Command, 'exercise.pl', 'honest.pl', '--seeds', '1']
    ),
    process_create(Prolog, Arguments,
                   [ stdin(null), stdout(pipe(Out)), stderr(pipe(Err)), cwd(Folder), process(Pid) ]),
    read_string(Out, _, Printed),
    read_string(Err, _, Warned),
    process_wait(Pid, _),
    string_concat(Printed, Warned, Said).

test(what_the_solution_misses, Found == ["far, with the seed 2", "never, with every seed"]) :-
    with_folder(( file(exercise, [ ":- use_module(library(ev3dev/exercise)).",
                                   "exercise(x, [seeds(1-2), seconds(5)]).",
                                   "score(1, far) :- run_seed(1).",
                                   "score(1, drives) :- commands(N), N > 0.",
                                   "score(1, never) :- collisions(7)." ], Exercise),
                  program(honest, Honest), atom_concat(Stem, 'honest.pl', Honest),
                  atom_concat(Stem, 'solution.pl', Solution), rename_file(Honest, Solution),
                  with_output_to(string(Text), ( quietly(exercise_check(Exercise)) -> true ; true )) )),
    split_string(Text, "\n", "", Lines),
    findall(Part, ( member(Line, Lines), string_concat("The solution misses: ", Part, Line) ), Found).
test(secret_seeds_are_not_shown, Shown-Secret == 1-2) :-
    with_folder(( folder(Folder), atom_concat(Folder, '/marks', Out),
                  file(mine, [ ":- use_module(library(ev3dev)).",
                               "start :- set_robot(5.6, 10.6, outB, outC), go(60), wait(9)." ], File),
                  mark_files([File], [seeds([1, 7654, 7655]), out(Out), formats([html])], _),
                  read_report(Out, 'pages/mine.html', Page) )),
    assertion(\+ sub_string(Page, _, _, _, "765")),
    assertion(sub_string(Page, _, _, _, "it ran into the wall")),
    occurrences(">secret<", Page, Secret),
    occurrences("<tr><td class=\"n\">1<td class=\"n\">1<", Page, Shown).
test(wrong_option, error(domain_error(exercise_option, seed(1)))) :-
    exercise_mark(nowhere, [], [seed(1)], _).
test(no_exercise_file, error(existence_error(source_sink, nowhere))) :-
    exercise_mark(nowhere, [], [], _).
:- end_tests(exercise).
