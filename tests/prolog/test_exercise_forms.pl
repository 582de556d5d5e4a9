% What is handed in, and in which form the marks come back: no program runs here.

:- use_module('../support/sixty').
:- use_module('../support/trees').
:- use_module(library(ev3dev/exercise)).
:- use_module(library(ev3dev/private/app/command_line), []).
:- use_module(library(ev3dev/private/marking/reasons), []).
:- use_module(library(ev3dev/private/marking/alike), []).
:- use_module(library(ev3dev/private/marking/participants), []).
:- use_module(library(ev3dev/private/marking/read), []).
:- use_module(library(ev3dev/private/marking/report), []).
:- use_module(library(ev3dev/private/marking/submissions), []).
:- use_module(library(filesex)).
:- use_module(library(process)).

:- meta_predicate with_folder(-, 0).

with_folder(Folder, Goal) :-
    tmp_file(forms, Folder),
    make_directory(Folder),
    setup_call_cleanup(true, Goal, process_create(path(rm), ['-rf', file(Folder)], [])).

%   Files are Base-Text; who handed in which files, and what was left out.
handed_in(Files, Found, Left) :-
    handed_in_at(Files, [''], Found, Left).

handed_in_at(Files, Below, Found, Left) :-
    with_folder(Folder,
        ( forall(member(Base-Text, Files),
                 ( atomic_list_concat([Folder, /, Base], File), written(File, utf8, Text) )),
          findall(Path, ( member(Part, Below), atom_concat(Folder, Part, Path) ), Paths),
          submitted(Paths, Found, Left0),
          findall(Base-Why,
                  ( member(left(Path, Why), Left0),
                    atom_concat(Folder, Below1, Path),
                    atom_concat(/, Base, Below1) ),
                  Left) )).

submitted(Paths, Found, Left) :-
    ev3dev_marking_submissions:submissions(Paths, start, Submissions, Left),
    findall(Name-Its,
            ( member(submission(Name, _, Files, Refused), Submissions),
              (   Refused == ''
              ->  findall(Path, member(file(Path, _, _, _), Files), Its)
              ;   Its = Refused
              ) ),
            Found).

:- begin_tests(exercise_forms).

test(each_of_sixty_has_its_row, Count/Names == 60/60) :-
    with_folder(Folder,
        ( sixty(Folder),
          findall(Path, ( member(Part, [moodle, github, gradescope, plain]),
                          atomic_list_concat([Folder, /, Part], Path) ), Paths),
          submitted(Paths, Found, Left) )),
    length(Found, Count),
    findall(Name, member(Name-_, Found), All),
    sort(All, Sorted),
    length(Sorted, Names),
    assertion(Left == []),
    assertion(\+ ( member(_-Its, Found), \+ is_list(Its) )),
    forall(member(Name, ['Anna Lee 101', 'Anna Lee 102', 'Zo\u00eb M\u00fcller', 'garage-user31',
                         'Gwen O\'Neil 43', '=cmd()', 'a\nb']),
           assertion(memberchk(Name, All))).

%   handed(Files, Who hands in what, What is not marked)
handed(['a/mine.pl'-"start.", 'b/mine.PL'-"start.", 'c/x/y/mine.pl'-"start."],
       [a-['mine.pl'], b-['mine.PL'], c-['x/y/mine.pl']], []).
handed(['a.pl'-"start.", 'a.pro'-"start.", '..pl'-"start.", 'b.txt'-"start.", 'c.zip'-"PK"],
       ['.'-['..pl'], a-['a.pl'], 'a 2'-['a.pro']],
       [ 'b.txt'-'Its name does not end in .pl.', 'c.zip'-'It is an archive: unpack it first.' ]).
handed(['a/mine.pl.txt'-"start.", 'b/mine.zip'-"PK", 'c/report.pdf'-"", 'c/x.doc'-""],
       [ a-['mine.pl.txt'], b-'It is an archive: unpack it first.',
         c-'There is no program (*.pl) in what was handed in.' ],
       [ 'c/report.pdf'-'Its name does not end in .pl.', 'c/x.doc'-'Its name does not end in .pl.' ]).
handed(['a/helper.pl'-"h. start :- h.", 'a/main.pl'-":- use_module(helper).\nstart :- h.",
        'a/old.pl'-"start."],
       [a-['main.pl', 'helper.pl']],
       ['a/old.pl'-'main.pl has start/0, too, and was run.']).
handed(['a/.git/hooks.pl'-"start.", '__MACOSX/a/._mine.pl'-"x", '.DS_Store'-"x", 'a/._mine.pl'-"x",
        'a/mine.pl'-"start."],
       [a-['mine.pl']], []).
handed(['An X_1_assignsubmission_file/m.pl'-"start.",
        'An X_1_assignsubmission_onlinetext/onlinetext.html'-"hello",
        'Bo_2_assignsubmission_file_m.pl'-"start."],
       ['An X'-['m.pl'], 'Bo'-['Bo_2_assignsubmission_file_m.pl']],
       [ 'An X_1_assignsubmission_onlinetext/onlinetext.html'-'Its name does not end in .pl.' ]).

test(who_hands_in_what, [forall(handed(Files, Found0, Left0)), Found-Left == Found0-Left0]) :-
    handed_in(Files, Found, Left).
test(a_folder_for_each_student_or_for_each_group,
     Found == [alice-['mine.pl'], x-['x.pl'], y-['y.pl']]) :-
    handed_in_at(['alice/mine.pl'-"start.", 'group/x.pl'-"start.", 'group/y.pl'-"start."],
                 ['/alice/', '/group'], Found, _).
test(what_a_program_loads_beside_it, Bases == ['mine.pl', 'way.pl', 'far.pl']) :-
    with_folder(Folder,
        ( forall(member(Base-Text, [ 'mine.pl'-":- use_module(library(lists)).\n:- use_module(way).\nstart.",
                                     'way.pl'-":- ['far.pl'], ensure_loaded('/etc/passwd').", 'far.pl'-"x.",
                                     'other.pl'-"start." ]),
                 ( atomic_list_concat([Folder, /, Base], File), written(File, utf8, Text) )),
          atom_concat(Folder, '/mine.pl', Mine),
          ev3dev_marking_submissions:own_submission(Mine, submission(mine, [], Files, '')) )),
    findall(Base, member(file(Base, _, _, _), Files), Bases).
test(several_programs_at_the_shell, Files == [e, 'a.pl', 'b.pl']) :-
    ev3dev_command_line:command_line([mark, e, 'a.pl', 'b.pl'], mark, Files, []).
test(all_that_a_shell_finds_in_a_class,
     Found-Left == ['An X'-['m.pl'], 'Bo 3'-['m.pl'], 'Bo 4'-['x/m.pl'], zoe-['x/y/m.pl'], plain-['plain.pl']]-
                   ['list.csv'-'Its name does not end in .pl.',
                    'An X_1_assignsubmission_onlinetext_/o.html'-'Its name does not end in .pl.']) :-
    Files = [ 'An X_1_assignsubmission_file_/m.pl'-"start.", 'An X_1_assignsubmission_onlinetext_/o.html'-"",
              'Bo_3_assignsubmission_file_/m.pl'-"start.", 'Bo_4_assignsubmission_file_/x/m.pl'-"start.",
              'zoe/x/y/m.pl'-"start.", 'list.csv'-"a", 'plain.pl'-"start." ],
    handed_in_at(Files, [ '/list.csv', '/An X_1_assignsubmission_file_', '/An X_1_assignsubmission_onlinetext_',
                          '/Bo_3_assignsubmission_file_/', '/Bo_4_assignsubmission_file_', '/zoe',
                          '/plain.pl' ], Found, Left).
test(files_of_the_same_name_have_a_number, Found == [mine-['mine.pl'], 'mine 2'-['mine.pl']]) :-
    handed_in_at(['a/mine.pl'-"start.", 'b/mine.pl'-"start."], ['/a/mine.pl', '/b/mine.pl'], Found, _).

%   What a shell makes: links, a pipe, a folder that nobody may read, names that are no UTF-8.
made(Script, Found, Left) :-
    with_folder(Folder,
        ( process_create(path(sh), ['-c', Script], [cwd(Folder)]),
          submitted([Folder], Found, Left0),
          findall(Why, member(left(_, Why), Left0), Left) )).

test(no_link_is_followed, Left == ['It is a link, which is not followed.']) :-
    made("mkdir a; ln -s /etc/passwd a/mine.pl; ln -s .. loop", Found, Left),
    assertion(Found == [a-'It is a link, which is not followed.']).
test(a_pipe_is_not_read, Found == [a-'It cannot be read.']) :-
    made("mkdir a; mkfifo a/mine.pl", Found, _).
test(a_name_that_is_no_utf_8, Found == ['caf\u00e9'-['x.pl'], na-['na\u00efve.pl']]) :-
    made("d=$(printf 'caf\\351'); mkdir na \"$d\"; echo start. >\"$d/x.pl\"
          echo start. >\"na/$(printf 'na\\357ve').pl\"", Found0, _),
    msort(Found0, Found).
test(names_in_a_locale_without_letters, Text == "ok") :-
    current_prolog_flag(executable, Swipl),
    with_folder(Folder,
        ( sixty(Folder),
          atom_concat(Folder, '/plain', Plain),
          format(atom(Goal), "ev3dev_marking_submissions:submissions([~q],start,S,_),length(S,8),write(ok)",
                 [Plain]),
          absolute_file_name(library(ev3dev/private/marking/submissions), File, [file_type(prolog)]),
          process_create(path(env), ['LC_ALL=C', file(Swipl), '-q', '-f', none, '-g', Goal, '-t', halt, '-s', file(File)],
                         [stdout(pipe(Out))]),
          read_string(Out, _, Text),
          close(Out) )).

%   says(Output, Reason)
says("Warning: /a/mine.pl:2:\nWarning:    Singleton variables: [B]\n\c
      ERROR: -g start: is/2: Arithmetic: `foo/0' is not a function",
     'It ended at 3.0 s: is/2: Arithmetic: `foo/0\' is not a function. \c
      Also: Line 2: Singleton variables: [B]').
says("ERROR: /a/mine.pl:1:\nERROR:    source_sink `library(nonesuch)' does not exist\n\c
      Warning: /a/mine.pl:1:\nWarning:    Goal (directive) failed: user:use_module(library(nonesuch))\n\c
      Warning: Motor blocked\nERROR: -g start: catch/3: Unknown procedure: bar/0",
     'It ended at 3.0 s: Unknown procedure: bar/0. \c
      Also: Line 1: source_sink `library(nonesuch)\' does not exist; Motor blocked').
says("ERROR: -g start: Stack limit (1.0Gb) exceeded\nERROR:   Stack sizes: local: 1.0Gb\n\c
      ERROR:   Possible non-terminating recursion:\nERROR:     [13,420,840] user:deep(13420830)\n\c
      ERROR:     [13,420,839] user:deep(13420829)",
     'It ended at 3.0 s: Stack limit (1.0Gb) exceeded: deep calls itself without end').
says("ERROR: -g start: Stack limit (1.0Gb) exceeded\nERROR:   Stack depth: 11\nERROR:   In:\n\c
      ERROR:     [11] system:'$length'(_132, 300000000)\nERROR:     [9] user:start\n\c
      ERROR:     [8] system:catch(<compound (:)/2>, _168, <compound (:)/2>)\nERROR: \n\c
      ERROR: Use the --stack_limit=size[KMG] command line option or\n\c
      ERROR: ?- set_prolog_flag(stack_limit, 2_147_483_648). to double the limit.",
     'It ended at 3.0 s: Stack limit (1.0Gb) exceeded').
says("ERROR: /a/mine.pl:1: Initialization goal raised exception:\n\c
      ERROR: '$run_init_goal'/1: Unknown procedure: nothing/1",
     'It ended at 3.0 s: Line 1: Initialization goal raised exception: \c
      \'$run_init_goal\'/1: Unknown procedure: nothing/1').
says("ERROR: [Thread main] -g start: my_ball\nWarning: /a/mine.pl:9:\nWarning:    Later",
     'It ended at 3.0 s: my_ball. Also: Line 9: Later').
says("Nothing is wrong", 'It ended at 3.0 s with the exit status 2.').

test(the_error_comes_first, [forall(says(Output, Reason0)), Reason == Reason0]) :-
    ev3dev_marking_reasons:reasons(exit(2), Output, '/a/mine.pl', limits(1, 2), 3.0, reasons(Ends, [], Hints)),
    append(Ends, Hints, Lines),
    ev3dev_marking_reasons:reason_text(Lines, Reason).

% ---------------- LIKENESS

rules("avoid :: us_dist_cm(in1, Cm), Cm < 40 ~> turn(20).\nwander :: true ~> go(25).\n\c
       start :- set_robot(5.6, 10.6, outB, outC), look(3, at(1, 2)), behave([avoid, wander]).\n\c
       look(0, _) :- !.\nlook(N, at(X, Y)) :- M is N-1, turn(20, 90), Z is X+Y, look(M, at(Z, Y)).").
%   The same with other names, numbers and order.
renamed("schau(0, _) :- !.\nschau(K, pos(A,B)) :- L is K-1, turn(20,90), C is A+B, schau(L, pos(C,B)).\n\c
         start :- set_robot(5.6,10.6,outB,outC), schau(4, pos(1,5)), behave([weg,los]).\n\c
         los :: true ~> go(30).\nweg :: us_dist_cm(in1, D), D < 30 ~> turn(30).\n").
other("start :- set_robot(5.6, 10.6, outB, outC), repeat, us_dist_cm(in1, D),\n\c
           ( D > 22 -> go(20), fail ; stop ), !, say(done, [wait(true)]).").
short(Cm, Text) :-
    format(string(Text), "start :- set_robot(5.6, 10.6, outB, outC), go_cm(20, ~d).", [Cm]).

alike(Programs, Earlier, Given, Found) :-
    maplist(named_terms, Programs, Ones),
    maplist(named_terms, Earlier, Others),
    named_terms(x-Given, x-Terms),
    ev3dev_marking_alike:alike(Ones, Others, Terms, Pairs),
    findall(A-B, member(alike(A, B, _, _), Pairs), Found).

named_terms(Name-Text, Name-Terms) :-
    ev3dev_marking_read:program_terms(Text, Terms).

test(a_copy_with_other_names_is_found, Found == [a-this(b)]) :-
    rules(A), renamed(B), other(C),
    alike([a-A, b-B, c-C], [], "", Found).
test(a_copy_of_last_year_is_found, Found == [a-earlier(b)]) :-
    rules(A), renamed(B), other(C),
    alike([a-A, c-C], [b-B], "", Found).
test(the_same_name_is_no_reason_to_be_silent, Found == [mine-this(mine)]) :-
    rules(A), renamed(B),
    alike([mine-A, mine-B], [], "", Found).
test(what_is_given_is_nobodys, Found == []) :-
    rules(A), renamed(B),
    alike([a-A, b-B], [], A, Found).
test(short_programs_need_the_same_numbers, Found == [a-this(c)]) :-
    short(108, A), short(99, B),
    other(D), rules(E),
    alike([a-A, b-B, c-A, d-D, e-E], [], "start :- set_robot(5.6, 10.6, outB, outC).", Found).

% ---------------- PARTICIPANTS, AND THE FORMS OF MARKS

%   A class of made-up marks: Name-Keys-Points, each of 4, in two runs.
report(Students, List, Formats, Names, Texts) :-
    with_folder(Folder,
        ( findall(submission(Name, Keys, [], ''), member(Name-Keys-_, Students), Subs0),
          (   List == none
          ->  Participants = participants([], []), Subs = Subs0
          ;   atom_concat(Folder, '/list.csv', File),
              written(File, utf8, List),
              ev3dev_marking_participants:read_participants(File, Participants),
              ev3dev_marking_participants:with_participants(Participants, Subs0, Subs, _)
          ),
          findall(marked(Name, mark(Name, P, 4, [score('a <b>', P, 4, 1)],
                                    [run(1, P, over, 5.0), run(7654, P, over, 5.0)], Why),
                         [result(1, not_run), result(7654, not_run)], Sub, why(all, [])),
                  ( member(Sub, Subs), Sub = submission(Name, _, _, Why),
                    ( member(Name-_-P, Students) -> true ; P = 0 ) ),
                  Marked),
          atom_concat(Folder, '/out', Out),
          ev3dev_marking_report:write_reports(
              Formats, Out, exercise(user, maze, [seeds(1-3)], [score(4, 'a <b>', x, 1)]),
              class(Participants, [], [], []), Marked),
          findall(Text, ( member(Name, Names), atomic_list_concat([Out, /, Name], Path),
                          ( exists_file(Path) -> read_file_to_string(Path, Text, [encoding(utf8)])
                          ; Text = none ) ), Texts) )).

test(a_worksheet_of_moodle_is_filled_in, Text == Expected) :-
    Head = "Identifier,Full name,Email address,Status,Grade,Maximum grade,Last modified (grade),Feedback comments\r\n",
    string_concat(Head, "Participant 12,Anna Lee,a@x.org,,,100.00,\"Monday, 1 June 2026\",\r\n\c
                         Participant 112,Bo Li,b@x.org,,,100.00,-,\r\n", List),
    report(['Anna Lee'-[id('12')]-3], List, [moodle], ['moodle.csv'], [Text]),
    string_concat(Head,
        "Participant 12,Anna Lee,a@x.org,,75,100.00,\"Monday, 1 June 2026\",\c
         3 of 4: a &lt;b&gt; (not in 1 of 2 runs)<br>\r\n\c
         Participant 112,Bo Li,b@x.org,,0,100.00,-,\c
         0 of 4: a &lt;b&gt; (not in 1 of 2 runs)<br>Nothing was handed in.\r\n", Expected).
test(who_is_absent_in_a_worksheet_has_a_name, true(sub_string(Text, _, _, _, "Bo Li,0,4,0,Nothing"))) :-
    report(['Annie'-[id('12')]-3],
           "Identifier,Full name,Grade,Maximum grade,Feedback comments\nParticipant 12,Anna Lee,,4,\n\c
            Participant 13,Bo Li,,4,\n", [csv], ['marks.csv'], [Text]).
test(a_worksheet_in_german, true(sub_string(Text, _, _, _, ",75,\"100,00\",,3 of 4"))) :-
    report(['Anna Lee'-[id('12')]-3],
           "\uFEFFID,Vollst\u00e4ndiger Name,Bewertung,Bestwertung,Zuletzt,Feedback\r\n\c
            Teilnehmer/in12,Anna Lee,,\"100,00\",,\r\nTeilnehmer/in13,Bo Li,,\"100,00\",,\r\n",
           [moodle], ['moodle.csv'], [Text]).
test(without_a_worksheet_it_is_made, Text == Expected) :-
    report(['=cmd'-[id('12')]-3, b-[]-1], none, all, ['moodle.csv'], [Text]),
    Expected = "Identifier,Full name,Grade,Last modified (grade),Feedback comments\r\n\c
                Participant 12,'=cmd,3,,3 of 4: a &lt;b&gt; (not in 1 of 2 runs)<br>\r\n".
test(a_roster_of_github_classroom, Texts == [Expected, none]) :-
    report(['maze-anna'-[]-3, 'maze-bo'-[]-1],
           "\"identifier\",\"github_username\",\"github_id\",\"name\"\n\c
            \"a@x.org\",\"anna\",\"1\",\"\"\n\"b@x.org\",\"bo\",\"2\",\"\"\n\"c@x.org\",\"zoe\",\"3\",\"\"\n",
           all, ['classroom.csv', 'moodle.csv'], Texts),
    Expected = "assignment_name,github_username,roster_identifier,student_repository_name,points_awarded,points_available\r\n\c
                maze,anna,a@x.org,maze-anna,3,4\r\nmaze,bo,b@x.org,maze-bo,1,4\r\nmaze,zoe,c@x.org,c@x.org,0,4\r\n".
test(who_handed_in_nothing_has_a_row, true(sub_string(Text, _, _, _, "Li Bo,0,4,0,Nothing was handed in."))) :-
    report(['Lee Anna'-[]-3], "first;last\nAnna;Lee\nBo;Li\n", [csv], ['marks.csv'], [Text]).
test(gradescope_shows_secret_runs_when_it_is_published, true) :-
    report([a-[]-3], none, [gradescope], ['gradescope/a.json'], [Text]),
    assertion(sub_string(Text, _, _, _, "\"visibility\":\"after_published\"")),
    assertion(sub_string(Text, _, _, _, "\"stdout_visibility\":\"hidden\"")).
test(no_list, error(domain_error(participants, _))) :-
    report([a-[]-3], "name\n", [csv], [], _).

test(any_name_has_a_page_and_a_row, Count/Low == 60/60) :-
    with_folder(Folder,
        ( sixty(Folder),
          findall(Path, ( member(Part, [moodle, github, gradescope, plain]),
                          atomic_list_concat([Folder, /, Part], Path) ), Paths),
          ev3dev_marking_submissions:submissions(Paths, start, Subs, _) )),
    findall(Name, member(submission(Name, _, _, _), Subs), Names),
    ev3dev_marking_report:page_names(Names, [], Pages),
    findall(Page, ( member(_-Page0, Pages), downcase_atom(Page0, Page) ), All0),
    sort(All0, All),
    length(Pages, Count),
    length(All, Low),
    assertion(memberchk('a\nb'-a_b, Pages)),
    assertion(\+ ( member(_-Page, Pages), ( atom_length(Page, L), L > 70 ; sub_atom(Page, _, _, _, /) ) )).
test(the_page_of_the_class, true) :-
    report([a-[]-3, b-[]-1, c-[]-2, d-[]-2], none, all, ['index.html', 'results.json'], [Text, Json]),
    assertion(sub_string(Text, _, _, _, "4 programs, 2.00 points in the mean, 2 in the middle.")),
    assertion(sub_string(Text, _, _, _, "Hardest: a &lt;b&gt;, with 50 % of its points")),
    assertion(sub_string(Text, _, _, _, "<svg class=\"histogram\"")),
    assertion(\+ sub_string(Text, _, _, _, "<link")),
    assertion(sub_string(Json, _, _, _, "\"not_marked\"")).

:- end_tests(exercise_forms).
