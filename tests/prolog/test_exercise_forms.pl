% What is handed in, and in which form the marks come back: no program runs here.

:- use_module('../support/sixty').
:- use_module('../support/trees').
:- use_module(library(ev3dev/exercise)).
:- use_module(library(ev3dev/private/app/command_line), []).
:- use_module(library(ev3dev/private/marking/reasons), []).
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
test(several_programs_at_the_shell, Files == [e, 'a.pl', 'b.pl']) :-
    ev3dev_command_line:command_line([mark, e, 'a.pl', 'b.pl'], mark, Files, []).
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
          process_create(Swipl, ['-q', '-f', none, '-g', Goal, '-t', halt, '-s', file(File)],
                         [environment(['LC_ALL'='C']), stdout(pipe(Out))]),
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
says("ERROR: /a/mine.pl:1: Initialization goal raised exception:\n\c
      ERROR: '$run_init_goal'/1: Unknown procedure: nothing/1",
     'It ended at 3.0 s: Line 1: Initialization goal raised exception: \c
      \'$run_init_goal\'/1: Unknown procedure: nothing/1').
says("ERROR: [Thread main] -g start: my_ball\nWarning: /a/mine.pl:9:\nWarning:    Later",
     'It ended at 3.0 s: my_ball. Also: Line 9: Later').
says("Nothing is wrong", 'It ended at 3.0 s with the exit status 2.').

test(the_error_comes_first, [forall(says(Output, Reason0)), Reason == Reason0]) :-
    ev3dev_marking_reasons:reason(exit(2), Output, '/a/mine.pl', limits(1, 2), 3.0, Reason).

:- end_tests(exercise_forms).
