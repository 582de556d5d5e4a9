:- module(ev3dev_marking_mark,
          [ marks/4,                    % +Exercise, +Files, +Options, -Marks
            tried/3,                    % +Exercise, +File, +Options
            tried/4,                    % +Exercise, +File, +Options, -Marked
            check_solution/2            % +Exercise, +Options
          ]).
:- use_module('../basics/fields', [goal_expansion/2, term_expansion/2]).
:- use_module(explained, [own_world/3]).
:- use_module(reasons, [reason_text/2]).
:- use_module(records, []).
:- use_module('../batch/batch', [batch_runs/6, processors/1]).
:- use_module('../batch/workplace', [end_workplace/1, new_workplace/2]).
:- use_module('../../sim_fenced', [can_enclose/0]).
:- use_module('../checks/arguments', [option/2, option/3]).
:- use_module('../checks/checks', [must_be/2]).
:- use_module('../files/directory', [directory_path/2]).
:- use_module('../errors/errors',
              [domain_error/2, in_own_name/1, throw_error/3]).
:- use_module(check, [check_exercise/1, unused/3]).
:- use_module(kept, [keep_run/3, kept_run/3, with_kept_runs/4]).
:- use_module(progress,
              [ progress_begins/3, progress_ends/1, progress_line/2,
                runs_over/2 ]).
:- use_module(read,
              [ exercise_seeds/3, exercise_setting/3, exercise_world/3,
                forbidden/3, read_exercise/2, seed_list/2, wrong/2 ]).
:- use_module(forms, [form/2]).
:- use_module(participants, [read_participants/2, with_participants/4]).
:- use_module(submissions, [can_be/2, own_submission/2, submissions/4]).
:- use_module(library(filesex), [directory_file_path/3]).
:- use_module(library(lists),
              [append/3, member/2, nth1/3, numlist/3, sum_list/2]).
:- use_module(library(readutil), [read_file_to_string/3]).

/** <module> Many runs of many programs, and their points

The runs are those of a batch, whose program is a file with the exercise and
the texts of all programs in it; so it can go to another machine as it is.

A program's result is marked(Name, Mark, Results, Submission, Why): the mark
as of exercise_mark/4; result(Seed, Result) for each seed, Result as of
marked_run/4, or `not_run`; the submission as of submissions/4; and the lines
of the mark's reason, as why(Seed, Lines), Seed being that of the run which
they are about, or `all`. A program that does not earn all points is run once
more for it, with the seed of its worst run, and watched.
*/

%!  marks(+Exercise, +Files, +Options, -Marks) is det.

marks(Exercise0, Files, Options, Marks) :-
    exercise_to_mark(Exercise0, Exercise, Read),
    warn_of_unused(Exercise, Read),
    seeds(Read, all, Options, Seeds),
    option(formats(Formats), Options, all),
    must_be_formats(Formats),
    class(Files, Exercise, Read, Options, Submissions, Class),
    option(out(Directory), Options, none),
    option(resume(Resume), Options, false),
    must_be(boolean, Resume),
    option(enclosed(Enclosed), Options, true),
    must_be_possible(Enclosed),
    with_kept_runs(Directory, Resume, Kept,
                   marked_files(Exercise, Read, Submissions, Seeds, Kept,
                                [enclosed(Enclosed)|Options], Marked)),
    findall(Mark, member(marked(mark: Mark), Marked), Marks),
    (   Directory \== none
    ->  use_module(library(ev3dev/private/marking/report), []),
        ev3dev_marking_report:write_reports(Formats, Directory, Read, Class,
                                            Marked)
    ;   true
    ).

must_be_possible(Enclosed) :-
    must_be(boolean, Enclosed),
    (   Enclosed == true,
        \+ can_enclose
    ->  throw_error(existence_error(program, bwrap), _,
                    'bubblewrap is not installed, or may not be used: \c
                     install it, or let programs read files and use the \c
                     network by --no-fence or enclosed(false)')
    ;   true
    ).

must_be_formats(all) :-
    !.
must_be_formats(Formats) :-
    must_be(list, Formats),
    findall(Form, form(Form, _), Forms),
    Known = [html, gradescope|Forms],
    forall(member(Format, Formats),
           (   memberchk(Format, Known)
           ->  true
           ;   throw_error(domain_error(marks_format, Format), _,
                           one_of(Format, Known))
           )).

%   Submissions are those of Files, and a refused one for each participant who
%   handed in nothing.

class(Files, Exercise, Read, Options, Submissions,
      class(Participants, Left, Earlier, Given)) :-
    (   option(participants(List), Options)
    ->  read_participants(List, Participants)
    ;   Participants = participants([], [])
    ),
    handed_in(Files, Read, Submissions0, Left),
    forall(member(left(File, Why), Left),
           print_message(warning, ev3dev(not_marked(File, Why)))),
    (   Participants = participants([], [])
    ->  Submissions = Submissions0
    ;   with_participants(Participants, Submissions0, Submissions, Strangers),
        forall(member(Name, Strangers),
               print_message(warning, ev3dev(stranger(Name, List))))
    ),
    (   option(earlier(Folder), Options)
    ->  directory_path(Folder, Path),
        handed_in([Path], Read, Earlier, _)
    ;   Earlier = []
    ),
    file_directory_name(Exercise, Here),
    directory_file_path(Here, 'skeleton.pl', Skeleton),
    (   exists_file(Skeleton),
        handed_in([Skeleton], Read, [submission(_, _, [First|_], _)], _)
    ->  First = file(_, _, _, Given)
    ;   Given = []
    ).

handed_in(Files, Read, Submissions, Left) :-
    exercise_setting(Read, goal(Goal), start),
    submissions(Files, Goal, Submissions, Left).

exercise_to_mark(Exercise0, Exercise, Read) :-
    prolog_file(Exercise0, Exercise),
    read_exercise(Exercise, Read),
    check_exercise(Read).

%   A helper may have such a name, so this stops the author alone.

warn_of_unused(Exercise, Read) :-
    (   unused(Read, _, Text)
    ->  print_message(warning, ev3dev(unused(Exercise, Text)))
    ;   true
    ).

prolog_file(File, Path) :-
    in_own_name(absolute_file_name(File, Path,
                                   [file_type(prolog), access(read)])).

seeds(Read, Which, Options, Seeds) :-
    (   option(seeds(Given), Options)
    ->  (   seed_list(Given, Seeds)
        ->  true
        ;   domain_error(seeds, Given)
        )
    ;   exercise_seeds(Read, Which, Seeds)
    ).

%!  tried(+Exercise, +File, +Options) is semidet.

tried(Exercise, File, Options) :-
    tried(Exercise, File, Options, Marked),
    earned_all(Marked).

%!  tried(+Exercise, +File, +Options, -Marked) is semidet.
%
%   The same, and Marked is the program with its mark. Fails only if the
%   program has a world of its own.

tried(Exercise0, File, Options, Marked) :-
    exercise_to_mark(Exercise0, Exercise, Read),
    warn_of_unused(Exercise, Read),
    \+ has_own_world(Read, File),
    printed(Exercise, Read, open, File, Options, Marked),
    print_why(Marked),
    (   option(page(Page), Options)
    ->  use_module(library(ev3dev/private/marking/report), []),
        ev3dev_marking_report:write_page(Page, Read, all, Marked),
        format("The picture: ~w~n", [Page])
    ;   true
    ).

%   A simulation of its own is another one, in which a run takes a minute.

has_own_world(Read, File) :-
    own_submission(File, Submission),
    program(Submission, 1, Read, program(_, _, Files, _, '')),
    world_of_its_own(Read, Files, Line),
    !,
    format("~w~n", [Line]).

world_of_its_own(Read, Files, Line) :-
    exercise_setting(Read, goal(Goal), start),
    own_world(Files, Goal, Line).

%!  check_solution(+Exercise, +Options) is semidet.

check_solution(Exercise0, Options) :-
    exercise_to_mark(Exercise0, Exercise, Read),
    (   unused(Read, Names, Text)
    ->  wrong(Names, Text)
    ;   true
    ),
    exercise_setting(Read, solution(Solution), 'solution.pl'),
    file_directory_name(Exercise, Folder),
    directory_file_path(Folder, Solution, File),
    printed(Exercise, Read, all, File, Options, Marked),
    Marked = marked(mark: mark(runs: Runs, reason: Reason)),
    ( Reason == '' -> true ; format("~w~n", [Reason]) ),
    findall(Earned-Seed, member(run(Seed, Earned, _, _), Runs), Pairs),
    keysort(Pairs, [Least-LeastSeed|_]),
    findall(Earned, member(Earned-_, Pairs), All),
    sort(All, Spread),
    format("The least of a run is ~w, with the seed ~w; all: ~w~n",
           [Least, LeastSeed, Spread]),
    Marked = marked(results: Results),
    forall(missing(Read, Results, Text, Missed),
           format("The solution misses: ~w, with ~w~n", [Text, Missed])),
    earned_all(Marked).

%   A score that some run did not earn whole.

missing(exercise(_, _, _, Scores), Results, Text, Missed) :-
    nth1(Index, Scores, score(_, Text, _, _)),
    findall(Seed,
            ( member(result(Seed, Result), Results),
              share(Result, Index, Share),
              Share < 1 ),
            Seeds),
    (   length(Results, All),
        length(Seeds, All)
    ->  Missed = 'every seed'
    ;   Seeds = [_|_],
        atomic_list_concat(Seeds, ', ', Listed),
        ( Seeds = [_] -> Word = seed ; Word = seeds ),
        format(atom(Missed), 'the ~w ~w', [Word, Listed])
    ).

earned_all(Marked) :-
    Marked = marked(mark: Mark),
    Mark = mark(points: Points, of: Of),
    Points =:= Of.

%   Run the program on the seeds that Which or Options say, and print what it
%   earns, and why not more.

printed(Exercise, Read, Which, File, Options0, Marked) :-
    Options = [progress(terminal)|Options0],
    seeds(Read, Which, Options, Seeds),
    own_submission(File, Submission),
    marked_files(Exercise, Read, [Submission], Seeds, none, Options,
                 [Marked]),
    Marked = marked(mark: mark(_, Points, Of, Scores, Runs, _)),
    length(Runs, Count),
    forall(member(Score, Scores), print_score(Score, Count)),
    format("Together: ~w of ~w points, in ~d runs.~n", [Points, Of, Count]).

print_why(Marked) :-
    Marked = marked(results: Results, why: why(Which, Lines)),
    (   Which == all
    ->  forall(member(Line, Lines), format("~w~n", [Line]))
    ;   format("With the seed ~w:~n", [Which]),
        forall(member(Line, Lines), format("  ~w~n", [Line]))
    ),
    forall(( member(result(Seed, result(collision: Hit)), Results),
             Seed \== Which,
             Hit \== '' ),
           format("With the seed ~w: ~w~n", [Seed, Hit])).

print_score(score(Text, Points, Of, Missed), Count) :-
    format("  ~w~t~8|of ~w~t~16|~w", [Points, Of, Text]),
    (   Missed =:= 0
    ->  nl
    ;   format(": not in ~d of ~d runs~n", [Missed, Count])
    ).

% ---------------- RUNS

most_text(1000000).

%   A program that had to be ended with the first two seeds is not run with
%   the others; so the jobs come in two parts, whatever their number.

marked_files(Exercise, Read, Submissions, Seeds, Kept, Options, Marked) :-
    enclosed(Options, Enclosed),
    findall(Program,
            ( nth1(Number, Submissions, Submission),
              program(Submission, Number, Read, Program) ),
            Programs),
    (   append([First, Second], Others, Seeds)
    ->  FirstSeeds = [First, Second]
    ;   FirstSeeds = Seeds,
        Others = []
    ),
    findall(Number-Seed,
            ( member(program(Number, _, _, _, ''), Programs),
              member(Seed, FirstSeeds) ),
            Jobs1),
    read_file_to_string(Exercise, Text, [encoding(utf8)]),
    length(Seeds, SeedCount),
    length(FirstSeeds, FirstCount),
    length(Jobs1, Count),
    All is SeedCount*Count//FirstCount,
    progress_begins(All, SeedCount, Options),
    Batch = batch(Exercise-Text, Read, Programs, Enclosed, Kept, Options),
    results(Jobs1, Batch, Results1),
    findall(Number-Seed,
            ( member(program(Number, _, _, _, ''), Programs),
              \+ hopeless(Number, FirstSeeds, Results1),
              member(Seed, Others) ),
            Jobs2),
    length(Jobs2, Others2),
    Skipped is All-Count-Others2,
    runs_over(Skipped, Options),
    results(Jobs2, Batch, Results2),
    append(Results1, Results2, Results),
    findall(Number-watched(Worst),
            ( member(Program, Programs),
              arg(1, Program, Number),
              lacking(Program, Read, Seeds, Results, Worst) ),
            Jobs3),
    watching_now(Jobs3, Options),
    findall(Option, ( member(Option, Options), Option \= progress(_) ),
            Silent),
    results(Jobs3, batch(Exercise-Text, Read, Programs, Enclosed, Kept,
                         Silent), Results3),
    progress_ends(Options),
    findall(One,
            ( member(Program, Programs),
              marked(Program, Read, Seeds, Results, Results3, One) ),
            Marked).

%   A program that does not earn all points, and does not say by itself why.

lacking(Program, Read, Seeds, Results, Worst) :-
    Program = program(Number, _, Files, _, ''),
    \+ world_of_its_own(Read, Files, _),
    its_results(Number, Seeds, Results, Its),
    \+ ( member(result(_, result(reason: Reason)), Its),
         sub_atom(Reason, 0, _, _, 'Line ') ),  % of a syntax error
    Read = exercise(_, _, _, ScoreFacts),
    findall(Earned-Seed,
            ( member(result(Seed, Result), Its),
              run_points(Result, ScoreFacts, Earned) ),
            Pairs),
    keysort(Pairs, [Least-Worst|_]),
    full_points(ScoreFacts, Of),
    Least < Of.

watching_now(Jobs, Options) :-
    (   Jobs = [_-watched(Seed)]
    ->  progress_line('Watching the run with the seed ~w again.'-[Seed],
                      Options)
    ;   length(Jobs, Count),
        Count > 0
    ->  progress_line('Watching ~d runs again.'-[Count], Options)
    ;   true
    ).

hopeless(Number, Seeds, Results) :-
    \+ ( member(Seed, Seeds),
         \+ ( member(job(Number, Seed, result(ended: Ended)),
                     Results),
              memberchk(Ended, [limit(_), killed(_)]) ) ).

enclosed(Options, Enclosed) :-
    (   option(enclosed(Enclosed), Options)
    ->  must_be(boolean, Enclosed)
    ;   can_enclose
    ->  Enclosed = true
    ;   Enclosed = false,
        print_message(warning, ev3dev(not_enclosed))
    ).

:- multifile prolog:message//1.

prolog:message(ev3dev(not_enclosed)) -->
    [ 'bubblewrap (bwrap) is not installed here, or may not be used:'-[], nl,
      'programs can read files and use the network'-[] ].

prolog:message(ev3dev(not_marked(File, Why))) -->
    [ 'Not marked: ~w: ~w'-[File, Why] ].
prolog:message(ev3dev(unused(Exercise, Text))) -->
    { file_base_name(Exercise, Base) },
    [ '~w: ~w'-[Base, Text] ].
prolog:message(ev3dev(stranger(Name, List))) -->
    [ '~w is marked, but has no row in ~w'-[Name, List] ].

%   program(Number, Name, Files, Submission, Reason): Reason is '' if it may
%   run. Files are Path-Bytes, of which the first begins.

program(Submission, Number, Read,
        program(Number, Name, Files, Submission, Reason)) :-
    Submission = submission(Name, _, Its, Refused),
    findall(Path-Bytes,
            ( member(file(Path0, Bytes, _, _), Its), can_be(Path0, Path) ),
            Files),
    (   Refused \== ''
    ->  Reason = Refused
    ;   member(file(Path, _, _, Terms), Its),
        forbidden(Read, Terms, Reason0)
    ->  (   Its = [_]
        ->  Reason = Reason0
        ;   format(atom(Reason), '~w: ~w', [Path, Reason0])
        )
    ;   Reason = ''
    ).

%   A run that says nothing, as the machine was too busy, is made again. Where
%   many are lost, more would be.

most_lost(10).

results(Jobs, Batch, Results) :-
    results(2, Jobs, Batch, Results).

results(Again0, Jobs, Batch, Results) :-
    batch_results(Jobs, Batch, Results0),
    findall(Program-Seed,
            member(job(Program, Seed, result(ended: lost)),
                   Results0),
            Lost),
    length(Lost, Count),
    most_lost(Most),
    (   Count > 0,
        Count =< Most,
        Again0 > 0
    ->  Again is Again0-1,
        results(Again, Lost, Batch, Results1),
        findall(job(Program, Seed, Result),
                ( member(job(Program, Seed, Result0), Results0),
                  (   memberchk(job(Program, Seed, Result1), Results1)
                  ->  Result = Result1
                  ;   Result = Result0
                  ) ),
                Results)
    ;   Results = Results0
    ).

%   Those that are kept need not be made.

batch_results(Jobs, Batch, Results) :-
    Batch = batch(kept: Kept, options: Options),
    findall(job(Program, Seed, Result),
            ( member(Program-Seed, Jobs),
              Kept \== none,
              run_of(Batch, Program-Seed, Run),
              kept_run(Kept, Run, Result) ),
            Known),
    findall(Job,
            ( member(Job, Jobs),
              Job = Program-Seed,
              \+ memberchk(job(Program, Seed, _), Known) ),
            Others),
    length(Known, Count),
    runs_over(Count, Options),
    made_results(Others, Batch, Made),
    findall(job(Program, Seed, Result),
            ( member(Program-Seed, Jobs),
              (   memberchk(job(Program, Seed, Result0), Known)
              ->  Result = Result0
              ;   memberchk(job(Program, Seed, Result), Made)
              ) ),
            Results).

run_of(batch(_-Text, Read, Programs, Enclosed, _, _), Program-Which,
       run([Text, Enclosed, Files, Which], World, Robot)) :-
    ( Which = watched(Seed) -> true ; Seed = Which ),
    memberchk(program(Program, _, Files, _, _), Programs),
    exercise_world(Read, Seed, World),
    exercise_setting(Read, robot(Robot), default).

%   Where there are no processes, somebody else makes the runs:
%   runs_here(+Jobs, +Exercise, +Programs, -Results).

:- multifile runs_here/4.

made_results([], _, []) :-
    !.
made_results(Jobs, batch(Exercise, _, Programs, _, _, _), Results) :-
    runs_here(Jobs, Exercise, Programs, Results),
    !.
made_results(Jobs, Batch, Results) :-
    Batch = batch(Exercise, Read, Programs, Enclosed, _, Options),
    exercise_setting(Read, cpu(Cpu), 10),
    exercise_setting(Read, seconds(Seconds), 60),
    exercise_setting(Read, sleep(Sleep), 30),
    MostCpu is 2*(Cpu+Seconds) + 600,
    MostSleep is Sleep + 600,
    processors(Processors),
    option(jobs(Workers), Options, Processors),
    must_be(positive_integer, Workers),
    option(redis(Server), Options, none),
    length(Jobs, Count),
    numlist(1, Count, Numbers),
    setup_call_cleanup(
        new_workplace(ev3dev_marks, Place),
        ( directory_file_path(Place, 'batch.pl', File),
          write_batch(File, Jobs, Exercise, Programs, Enclosed),
          batch_runs(program(File, marked, none, [],
                             limits(MostSleep, MostCpu)),
                     Numbers, Workers, Server,
                     ev3dev_marking_mark:results_come(Jobs, Batch), Done) ),
        end_workplace(Place)),
    findall(job(Program, Seed, Result),
            ( member(done(_, N, Score), Done),
              nth1(N, Jobs, Program-Seed),
              result_of(Score, Result) ),
            Results).

:- public results_come/4.

results_come(Jobs, Batch, Done0, Done) :-
    Batch = batch(kept: Kept, options: Options),
    once(append(New, Done0, Done)),
    forall(( member(done(_, N, Score), New),
             result_of(Score, Result),
             nth1(N, Jobs, Job) ),
           (   ( Kept == none ; Result = result(ended: lost) )
           ->  true
           ;   run_of(Batch, Job, Run),
               keep_run(Kept, Run, Result)
           )),
    length(New, Count),
    runs_over(Count, Options).

%   What is wrong here is wrong with the exercise, or the machine.

result_of(Score, Result) :-
    (   Score = result(ended: _)
    ->  Result = Score
    ;   Score = wrong(What, context(_, Text))
    ->  wrong(What, Text)
    ;   Score = error(Message),
        Message \== died
    ->  throw_error(system_error(Message), _, Message)
    ;   Result = result(lost, 0, none,
                        'This run was lost: its process has ended.', '', [],
                        [], [])
    ).

write_batch(File, Jobs, Exercise-Text, Programs, Enclosed) :-
    setup_call_cleanup(
        open(File, write, Out, [encoding(utf8)]),
        ( write_term_line(Out,
              (:- use_module(library(ev3dev/private/marking/run)))),
          write_term_line(Out, (:- marking_place)),
          write_term_line(Out,
              (:- initialization(marking_exercise(Exercise, Text)))),
          forall(( member(program(Number, _, Its, _, ''), Programs),
                   memberchk(Number-_, Jobs) ),
                 write_term_line(Out, program(Number, Its))),
          forall(nth1(N, Jobs, Program-Seed),
                 write_term_line(Out, job(N, Program, Seed))),
          write_term_line(Out,
              ( marked(Job, Result) :-
                    job(Job, Program0, Seed0),
                    program(Program0, Files),
                    catch(marked_run(Files, Seed0, Enclosed, Result),
                          error(domain_error(exercise, What), Context),
                          Result = wrong(What, Context)) )) ),
        close(Out)).

write_term_line(Out, Term) :-
    \+ \+ ( numbervars(Term, 0, _),
            write_term(Out, Term, [ quoted(true), ignore_ops(true),
                                    numbervars(true) ]),
            write(Out, ' .\n') ).

% ---------------- MARKS

marked(Program, Read, Seeds, Results, Watched,
       marked(Name, mark(Name, Points, Of, Scores, Runs, Reason), Its,
              Submission, Why)) :-
    Program = program(Number, Name, _, Submission, _),
    Read = exercise(_, _, _, ScoreFacts),
    length(Seeds, SeedCount),
    its_results(Number, Seeds, Results, Its),
    findall(score(Text, Earned, Full, Missed),
            ( nth1(Index, ScoreFacts, score(Full, Text, _, _)),
              findall(Share,
                      ( member(result(_, Result), Its),
                        share(Result, Index, Share) ),
                      Shares),
              sum_list(Shares, Sum),
              in_hundredths(Full*Sum/SeedCount, Earned),
              findall(x, ( member(Share, Shares), Share < 1 ), Misses),
              length(Misses, Missed) ),
            Scores),
    findall(P, member(score(_, P, _, _), Scores), Ps),
    sum_list(Ps, Points0),
    in_hundredths(Points0, Points),
    full_points(ScoreFacts, Of),
    findall(run(Seed, Earned, Ended, Seconds),
            ( member(result(Seed, Result), Its),
              run_points(Result, ScoreFacts, Earned),
              run_end(Result, Ended, Seconds) ),
            Runs),
    ( Points < Of -> Lacks = true ; Lacks = false ),
    why(Program, Lacks, Read, Its, Watched, Why),
    Why = why(_, Lines),
    reason_text(Lines, Reason).

its_results(Number, Seeds, Results, Its) :-
    findall(result(Seed, Result),
            ( member(Seed, Seeds),
              (   member(job(Number, Seed, Result), Results)
              ->  true
              ;   Result = not_run
              ) ),
            Its).

full_points(ScoreFacts, Of) :-
    findall(P, member(score(P, _, _, _), ScoreFacts), Fulls),
    sum_list(Fulls, Of).

share(Result, Index, Share) :-
    Result = result(shares: Shares),
    is_list(Shares),
    !,
    nth1(Index, Shares, Share).
share(_, _, 0).

run_points(Result, ScoreFacts, Points) :-
    Result = result(shares: Shares),
    is_list(Shares),
    !,
    findall(P,
            ( nth1(Index, ScoreFacts, score(Full, _, _, _)),
              nth1(Index, Shares, Share),
              P is Full*Share ),
            Ps),
    sum_list(Ps, Sum),
    in_hundredths(Sum, Points).
run_points(_, _, 0).

run_end(Result, Ended, Rounded) :-
    Result = result(ended: Ended, seconds: Seconds),
    !,
    Rounded is round(Seconds*10)/10.0.
run_end(not_run, not_run, 0).

%   A whole number where it is one.

in_hundredths(Exact, Number) :-
    Hundredths is round(Exact*100),
    (   Hundredths mod 100 =:= 0
    ->  Number is Hundredths//100
    ;   Number is Hundredths/100.0
    ).

%   The lines of the reason, and the run that they are about.

why(Program, Lacks, Read, Its, Watched, why(Which, Lines)) :-
    Program = program(Number, _, Files, _, Refused),
    (   Refused \== ''
    ->  Which = all,
        Lines = [Refused]
    ;   Lacks == true,
        world_of_its_own(Read, Files, Line)
    ->  Which = all,
        Lines = [Line]
    ;   member(job(Number, watched(Seed), Result), Watched),
        found_out(Result, Seed, Its, Found)
    ->  Which = Seed,
        Lines = Found
    ;   Which = all,
        findall(Line,
                ( most_often(Its, Reason), in_runs(Its, Reason, Line) ),
                Lines)
    ).

found_out(Result, Seed, Its, Lines) :-
    Result = result(ended: Ended, reason: Lines0),
    Ended \== lost,
    memberchk(result(Seed, result(reason: Own, collision: Hit)), Its),
    (   Own \== '',
        Lines0 = [First0|Lines1]
    ->  in_runs(Its, First0, First),
        Lines2 = [First|Lines1]
    ;   Lines2 = Lines0
    ),
    ( Hit == '' -> Lines = Lines2 ; append(Lines2, [Hit], Lines) ),
    Lines \== [].

%   The reason that most runs have; of several, the first.

most_often(Results, Reason) :-
    reasons_of(Results, Whys),
    findall(Minus-Index,
            ( nth1(Index, Whys, Why),
              findall(x, member(Why, Whys), Same),
              length(Same, Count),
              Minus is -Count ),
            Counted),
    msort(Counted, [_-First|_]),
    nth1(First, Whys, Reason).

reasons_of(Results, Whys) :-
    findall(Why,
            ( member(result(_, result(reason: Why)), Results),
              Why \== '' ),
            Whys).

%   Some runs may have none.

in_runs(Results, Reason0, Reason) :-
    reasons_of(Results, Whys),
    length(Whys, Bad),
    findall(x, member(result(_, result(seconds: _)), Results), Made),
    length(Made, All),
    (   Bad =:= All
    ->  Reason = Reason0
    ;   format(atom(Reason), '~w (in ~d of ~d runs)', [Reason0, Bad, All])
    ).
