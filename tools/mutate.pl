% Changes the pack's clauses one at a time and runs the tests that concern them. A change
% that no test notices, a survivor, is a behavior without a test, or code that can go.
%
%   swipl -g main -t 'halt(1)' tools/mutate.pl -- [OPTION...] [FILE...]
%
%   --sample=N      only N changes, chosen by --seed=S (1)
%   --since=COMMIT  only in lines that have changed since
%   --tests=LIST    these test files, with commas between; else see tests_of/3
%   --least=P       exit with 1 if less than P percent are noticed
%   --jobs=N        N changes at once (as many as processors), each in a copy of its own
%   --self_test     check this program
%
% FILEs are all of prolog/ev3dev by default. Only a copy of the pack is written to. TREES
% in the environment names the trees of the tests.

:- use_module(library(aggregate)).
:- use_module(library(apply)).
:- use_module(library(filesex)).
:- use_module(library(lists)).
:- use_module(library(main), [argv_options/3]).
:- use_module(library(option)).
:- use_module(library(process)).
:- use_module(library(random)).
:- use_module(library(readutil)).
:- use_module(library(thread), [concurrent/3]).

main :-
    current_prolog_flag(argv, Argv),
    argv_options(Argv, Files, Options),
    (   memberchk(self_test(true), Options)
    ->  self_test
    ;   findall(Mutant, ( file(Files, Options, File), mutant(File, Options, Mutant) ), All),
        length(All, Count),
        option(sample(Most), Options, Count),
        option(seed(Seed), Options, 1),
        set_random(seed(Seed)),
        random_permutation(All, Permuted),
        Tried is min(Most, Count),
        length(Mutants, Tried),
        append(Mutants, _, Permuted),
        format("~d changes, ~d of them tried~n", [Count, Tried]),
        judged(Mutants, Options, Verdicts),
        exclude(==(survived), Verdicts, Noticed),
        length(Noticed, N),
        Percent is 100 * N / max(Tried, 1),
        format("~d of ~d were noticed, ~1f %~n", [N, Tried, Percent]),
        option(least(Least), Options, 0),
        ( Tried =:= 0 ; Percent >= Least )
    ),
    halt.

%   Words, tables of sensors, worlds and robots have no tests of their own.
file(Files0, Options, File) :-
    (   Files0 = [_|_]
    ->  Files = Files0
    ;   memberchk(since(Commit), Options)
    ->  lines_of([diff, '--name-only', '--diff-filter=d', Commit, '--', 'prolog/ev3dev'], Files)
    ;   lines_of(['ls-files', 'prolog/ev3dev'], Files)
    ),
    member(File, Files),
    tests_of(File, Options, [_|_]).

lines_of(Arguments, Lines) :-
    setup_call_cleanup(process_create(path(git), Arguments, [stdout(pipe(Out))]),
                       read_string(Out, _, String),
                       close(Out)),
    split_string(String, "\n", "", Lines).

% ---------------- CHANGES

%   mutant(File, Line, From-To, New): New replaces the characters From to To.
mutant(File, Options, mutant(File, Line, From-To, New)) :-
    read_file_to_string(File, Text, [encoding(utf8)]),
    findall(Range, range_to_change(File, Options, Range), Ranges),
    edit(Text, From-To, New),
    sub_string(Text, 0, From, _, Before),
    split_string(Before, "\n", "", Lines),
    length(Lines, Line),
    once(( member(First-Last, Ranges), between(First, Last, Line) )).

range_to_change(File, Options, First-Last) :-
    (   memberchk(since(Commit), Options)
    ->  lines_of([diff, '-U0', Commit, '--', File], Lines),
        member(Line, Lines),
        split_string(Line, " ", "+", ["@@", _, Range|_]),
        split_string(Range, ",", "", Parts),
        maplist(number_string, Numbers, Parts),
        append(Numbers, [1], [First, Count|_]),
        Last is First + Count - 1
    ;   First-Last = 1-inf
    ).

edit(Text, Range, New) :-
    setup_call_cleanup(open_string(Text, In), clauses(In, [], Clauses), close(In)),
    member(Clause-Position, Clauses),
    (   number_edit(Clause, Position, Range, New)
    ;   Clause = (_ :- Body),
        arg(5, Position, [_, Place]),
        goal_within(Body, Place, Goal, At),
        goal_edit(Goal, At, Text, Range, New)
    ).

%   What this Prolog would load, but messages. Ifs is what the `:- if` around have said.
clauses(In, Ifs, Clauses) :-
    read_term(In, Term, [subterm_positions(Position)]),
    (   Term == end_of_file
    ->  Clauses = []
    ;   Term = (:- Directive)
    ->  once(directive(Directive, Ifs, Next)),
        clauses(In, Next, Clauses)
    ;   ( Term = (_ --> _) ; memberchk(false, Ifs) )
    ->  clauses(In, Ifs, Clauses)
    ;   Clauses = [Term-Position|Rest],
        clauses(In, Ifs, Rest)
    ).

directive(if(Goal), Ifs, [If|Ifs]) :- ( catch(Goal, _, fail) -> If = true ; If = false ).
directive(else, [If0|Ifs], [If|Ifs]) :- memberchk(If0-If, [true-false, false-true]).
directive(endif, [_|Ifs], Ifs).
directive(module(_, Exports), Ifs, Ifs) :-
    forall(member(op(P, T, N), Exports), op(P, T, N)).
directive(_, Ifs, Ifs).

number_edit(Number, Range, Range, New) :-
    (   integer(Number)
    ->  New is Number + 1
    ;   float(Number),
        New is 0.8 * Number + 0.001
    ).
number_edit(Term, Position, Range, New) :-
    part(Term, Position, Part, Place),
    number_edit(Part, Place, Range, New).

part(Term, parentheses_term_position(_, _, Place), Term, Place).
part(Term, term_position(_, _, _, _, Places), Part, Place) :-
    nth1(I, Places, Place),
    arg(I, Term, Part).
part(List, list_position(_, _, Places, Tail), Part, Place) :-
    same_length(Places, Front),
    append(Front, Rest, List),
    nth1(I, [Tail|Places], Place),
    nth1(I, [Rest|Front], Part).

%   Goal is Body or within it, at Position.
goal_within(Body, parentheses_term_position(_, _, Place), Goal, Position) :-
    !,
    goal_within(Body, Place, Goal, Position).
goal_within(Body, Position, Body, Position) :-
    callable(Body).
goal_within(( If -> Then ; Else ), term_position(_, _, _, _, [Arrow, Last]), Goal, Position) :-
    !,
    arg(5, Arrow, [First, Middle]),
    member(Body-Place, [If-First, Then-Middle, Else-Last]),
    goal_within(Body, Place, Goal, Position).
goal_within(Body, term_position(_, _, _, _, Places), Goal, Position) :-
    callable(Body),
    Body \= _:_,
    predicate_property(Body, meta_predicate(Modes)),
    arg(I, Modes, 0),
    arg(I, Body, Part),
    nth1(I, Places, Place),
    goal_within(Part, Place, Goal, Position).

%   True and false conditions, other branches; no goal; another operator.
goal_edit(( _ -> _ ; _ ), term_position(From, To, _, _, [Arrow, Else]), Text, Range, New) :-
    arg(5, Arrow, [If, Then]),
    (   range(If, Range),
        New = fail
    ;   Range = From-To,
        maplist(text(Text), [If, Else, Then], Texts),
        format(string(New), "~w\n-> (~w\n) ; ~w", Texts)
    ).
goal_edit(( _ -> _ ), Position, Text, Range, New) :-
    arg(5, Position, [If, _]),
    negated(If, Text, Range, New).
goal_edit(\+ _, Position, Text, Range, New) :-
    negated(Position, Text, Range, New).
goal_edit(Goal, Position, _, Range, true) :-
    \+ memberchk(Goal, [(_, _), (_ ; _), (_ -> _), (_ *-> _), \+ _, true, debug(_, _, _)]),
    range(Position, Range).
goal_edit(Goal, term_position(_, _, From, To, _), _, From-To, New) :-
    swapped(Goal, New).
goal_edit(Goal, Position, _, Range, New) :-
    ( Goal = (_ is _) ; swapped(Goal, _) ),
    sum_edit(Goal, Position, Range, New).

negated(Position, Text, Range, New) :-
    range(Position, Range),
    text(Text, Position, Goal),
    format(string(New), "\\+ (~w\n)", [Goal]).

swapped(Goal, New) :-
    Goal =.. [Operator, _, _],
    memberchk(Operator-New, [ (<)-(=<), (=<)-(<), (>)-(>=), (>=)-(>), (=:=)-(=\=),
                              (=\=)-(=:=), (==)-(\==), (\==)-(==) ]).

sum_edit(Term, term_position(_, _, From, To, _), From-To, New) :-
    memberchk(Term/New, [(_ + _)/(-), (_ - _)/(+)]).
sum_edit(Term, Position, Range, New) :-
    part(Term, Position, Part, Place),
    nonvar(Part),
    sum_edit(Part, Place, Range, New).

range(Position, From-To) :-
    arg(1, Position, From),
    arg(2, Position, To).

text(Text, Position, Part) :-
    range(Position, From-To),
    Length is To - From,
    sub_string(Text, From, Length, _, Part).

% ---------------- TESTS

%   tests(Files, Tests): of what has no test file of its name, or other tests, too.
tests([arguments, checks, domains, errors, error_texts, frames, public_clauses],
                                          [errors, bad_input, motors, robot]).
tests([attributes],                       [motor_settings, dc_motors, driver, ports]).
tests([pool, machines, descriptors],           [sim_batch]).
tests([fenced_seed, fenced_log],          [sim_fenced]).
tests([worker],                           [worker, sim_batch]).
tests([brick, facts, world_name],         [sim, bricks, view, planners]).
tests([bricks],                           [bricks, worker]).
tests([causes],                           [journal, events]).
tests([random_seed, turn_order],          [sim, events, grid]).
tests([command_line, scripts, last_goal], [app, halt]).
tests([compiled, units],                  [compile]).
tests([conditions, small_lists],          [sensor_wait, events, rules]).
tests([directory],                        [files, sim_fenced, sound, app]).
tests([drive_moves, robot_state],         [drive, robot, plnxt, jog]).
tests([events],                           [events, rules, journal]).
tests([hints, error_messages],            [hints, errors, halt]).
tests([far, far_frames],                  [worker]).
tests([files],                            [files, sim_fenced, sim_default, bricks]).
tests([unknown_procedures, signatures, libraries, own_help, help_index],
      [help, errors]).
tests([schedule, time_limits],            [sim_time, sim]).
tests([ports],                            [ports, hints]).
tests([policy],                           [grid_policy]).
tests([prompt],                           [events]).
tests([planning_task, ground, pddl_grammar, pddl_text, s_expressions], [pddl]).
tests([roadmap_arguments],                [roadmap, navigation]).
tests([robot],                            [robot, hints]).
tests([sensor_type],                      [sensors, calibrate, raw]).
tests([usage],                            [sim_fenced, sim_batch]).
tests([waits],                            [events, rules, sim_time, threads]).

tests_of(_, Options, Tests) :-
    memberchk(tests(List), Options),
    !,
    atomic_list_concat(Tests, ',', List).
tests_of(File, _, Tests) :-
    file_base_name(File, Base),
    file_name_extension(Name, pl, Base),
    (   tests(Files, Names),
        memberchk(Name, Files)
    ->  true
    ;   member(One, [Name, golog, grid, view, planners]),
        sub_string(File, _, _, _, One),
        test_file(One, _)
    ->  Names = [One]
    ),
    findall(Test, ( member(One, Names), test_file(One, Test) ), Tests).

test_file(Name, Test) :-
    member(Folder, [prolog, behavior]),
    member(Part, ['', '_plans', '_online', '_robot']),
    format(atom(Test), "tests/~w/test_~w~w.pl", [Folder, Name, Part]),
    exists_file(Test).

%   judged(Mutants, Options, Verdicts): each is killed, survived or late.
judged(Mutants, Options, Verdicts) :-
    findall(Test, ( member(Mutant, Mutants), arg(1, Mutant, File), tests_of(File, Options, Tests),
                    member(Test, Tests) ), All0),
    sort(All0, All),
    current_prolog_flag(cpu_count, Processors),
    option(jobs(Jobs), Options, Processors),
    setup_call_cleanup(
        ( findall(Copy, ( between(1, Jobs, _), copied(Copy) ), Copies),
          message_queue_create(Free),
          maplist(thread_send_message(Free), Copies) ),
        ( findall(in_copy(Free, limit, Test, _), member(Test, All), Goals0),
          maplist(result, Goals0, Limits),
          concurrent(Jobs, Goals0, []),
          findall(in_copy(Free, judged(Limits, Options), Mutant, _), member(Mutant, Mutants), Goals),
          maplist(result, Goals, Verdicts),
          concurrent(Jobs, Goals, []) ),
        maplist(delete_directory_and_contents, Copies)).

result(Goal, Result) :-
    arg(4, Goal, Result).

in_copy(Free, Goal, In, Result) :-
    setup_call_cleanup(thread_get_message(Free, Copy),
                       call(Goal, Copy, In, Result),
                       thread_send_message(Free, Copy)).

%   Without what ev3dev_compile/0 has made: it would be loaded in place of a changed file.
copied(Copy) :-
    tmp_file(mutants, Copy),
    make_directory(Copy),
    format(atom(Command),
           "git ls-files -coz --exclude-standard | xargs -0 cp --parents -t ~w; cp -r lib ~w",
           [Copy, Copy]),
    process_create(path(bash), ['-c', Command], []).

%   How many seconds a test may compute, and how long it may be asleep, by what it does
%   without a change. What it waits for the processor does not count.
limit(Copy, Test, Test-limit(Cpu, Asleep)) :-
    tested(Copy, Test, limit(1200, 1200), Verdict, Cpu0, Asleep0),
    (   Verdict == survived
    ->  Cpu is ceiling(4 * Cpu0 + 10),
        Asleep is 4 * Asleep0 + 10
    ;   throw(format("~w fails without a change", [Test]))
    ).

judged(Limits, Options, Copy, mutant(File, Line, From-To, New), Verdict) :-
    read_file_to_string(File, Text, [encoding(utf8)]),
    sub_string(Text, 0, From, _, Before),
    sub_string(Text, To, _, 0, After),
    directory_file_path(Copy, File, Changed),
    tests_of(File, Options, Tests),
    setup_call_cleanup(write_file(Changed, [Before, ' ', New, ' ', After]),
                       (   member(Test, Tests),
                           memberchk(Test-Limit, Limits),
                           tested(Copy, Test, Limit, Verdict, _, _),
                           Verdict \== survived
                       ->  true
                       ;   Verdict = survived
                       ),
                       write_file(Changed, [Text])),
    text(Text, From-To, Old),
    (   Verdict == killed
    ->  true
    ;   format("~w:~d: ~w~n    - ~w~n    + ~w~n", [File, Line, Verdict, Old, New])
    ),
    flush_output.

write_file(File, Texts) :-
    setup_call_cleanup(open(File, write, Out, [encoding(utf8)]),
                       maplist(write(Out), Texts),
                       close(Out)).

%   The first error or warning that the test file does not expect ends it, but not one of
%   style: a change may leave a variable that occurs once. Nor a text, as a test prints one.
tested(Copy, Test, limit(MostCpu, MostAsleep), Verdict, Cpu, Asleep) :-
    format(atom(Goal),
           "Hook = (user:message_hook(T, K, _) :- memberchk(K, [error, warning]), \c
                    functor(T, N, _), \\+ memberchk(N, [singletons, multitons, \c
                    compiler_warnings, discontiguous, format]), halt(1)), \c
            assertz(Hook, Ref), load_files(user:'~w', []), erase(Ref), assertz(Hook), \c
            set_prolog_flag(ev3dev_hints, off), run_tests", [Test]),
    current_prolog_flag(executable, Swipl),
    process_create(path(setsid), [Swipl, '-g', Goal, '-t', halt],
                   [cwd(Copy), stdin(null), stdout(null), stderr(null), process(Pid)]),
    watched(Pid, MostCpu, MostAsleep, 0, Asleep, 0, Cpu, Status),
    (   Status == exit(0)
    ->  Verdict = survived
    ;   Status == late
    ->  Verdict = late
    ;   Verdict = killed
    ).

%   watched(Pid, MostCpu, MostAsleep, Asleep0, Asleep, Cpu0, Cpu, Status): what it computed,
%   and how long nothing of its session could run or waited for the processor, until its end.
watched(Pid, MostCpu, MostAsleep, Asleep0, Asleep, Cpu0, Cpu, Status) :-
    sleep(0.2),
    findall(State-Ticks, task(Pid, State, Ticks), Tasks),
    aggregate_all(sum(Ticks), member(_-Ticks, Tasks), Sum),
    Cpu1 is max(Cpu0, Sum / 100),
    (   member(State-_, Tasks),
        memberchk(State, ["R", "D"])
    ->  Asleep1 = Asleep0
    ;   Asleep1 is Asleep0 + 0.2
    ),
    process_wait(Pid, Status0, [timeout(0)]),
    (   Status0 \== timeout
    ->  Asleep = Asleep1,
        Cpu = Cpu1,
        Status = Status0
    ;   ( Cpu1 > MostCpu ; Asleep1 > MostAsleep )
    ->  format(atom(Session), "-~d", [Pid]),
        process_create(path(kill), ['-KILL', '--', Session], []),
        process_wait(Pid, _),
        Asleep = Asleep1,
        Cpu = Cpu1,
        Status = late
    ;   watched(Pid, MostCpu, MostAsleep, Asleep1, Asleep, Cpu1, Cpu, Status)
    ).

%   task(Session, State, Ticks): a thread of it, and for how many hundredths of a second it ran.
task(Session, State, Ticks) :-
    directory_files('/proc', Names),
    member(Name, Names),
    atom_number(Name, Process),
    stat([Process], [_, _, _, Session|_]),
    format(atom(Threads), "/proc/~d/task", [Process]),
    catch(directory_files(Threads, Ids), _, fail),
    member(Id, Ids),
    atom_number(Id, Thread),
    stat([Process, task, Thread], [State, _, _, _, _, _, _, _, _, _, _, User, System|_]),
    Ticks is User + System.

%   The fields behind the name of the program, numbers as such.
stat(Path, Fields) :-
    atomic_list_concat(Path, /, Inner),
    format(atom(File), "/proc/~w/stat", [Inner]),
    catch(read_file_to_string(File, Text, []), _, fail),
    split_string(Text, ")", " \n", Parts),
    last(Parts, Last),
    split_string(Last, " ", "", [State|Words]),
    maplist(number_string, Numbers, Words),
    Fields = [State|Numbers].

self_test :-
    Text = "p(1) :- ( X < 2.0 -> q, ! ; X is Y - 3, \\+ r ).",
    findall(Old-New, ( edit(Text, Range, New), text(Text, Range, Old) ), Edits),
    length(Edits, 13),
    forall(member(Edit, [ "1"-2, "2.0"-1.601, "X < 2.0"-fail, "X < 2.0"-true, "<"-(=<), "!"-true,
                          "-"-(+), "\\+ r"-"\\+ (\\+ r\n)",
                          "X < 2.0 -> q, ! ; X is Y - 3, \\+ r"
                          -"X < 2.0\n-> (X is Y - 3, \\+ r\n) ; q, !" ]),
           memberchk(Edit, Edits)),
    File = 'prolog/ev3dev/time.pl',
    read_file_to_string(File, Library, []),
    sub_string(Library, From, Length, _, "wait_(Seconds, Reason)"),
    To is From + Length,
    findall(mutant(File, 0, From-To, New), member(New, [fail, 'wait_(Seconds,Reason)']), Mutants),
    judged(Mutants, [], [killed, survived]),
    % It waits, or computes, without an end
    forall(member(Endless, ["thread_get_message(never)", "repeat, fail"]),
           judged([mutant(File, 0, From-To, Endless)], [], [late])).
