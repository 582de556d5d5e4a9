:- module(child,
          [ run_program/4,              % +Text, +Options, -Status, -Output
            start_program/3,            % +Text, +Options, -Child
            run_state/4,                % +File, +Options, -Status, -Output
            run_script/4,               % +File, +Arguments, -Status, -Output
            run_script/5,               % +File, +Arguments, +Typed, -Status, -Output
            can_open_terminal/0,
            at_toplevel/3,              % +Kind, +Text, :Closure
            type/2,                     % +Toplevel, +Text
            printed_line/2,             % +Toplevel, -Line
            end_program/3,              % +Child, -Status, -Output
            end_output/2,               % +Child, -Output
            kill_program/1,             % +Child
            descendant/1,               % +Text
            pack_version/1,             % -Version
            swipl/1,                    % -Program
            starts_itself/0
          ]).
:- use_module(library(filesex)).
:- use_module(library(option)).
:- use_module(library(process)).
:- use_module(library(readutil)).

/** <module> Prolog programs in processes of their own

For what is only seen from outside: how a program loads, ends, and what it
leaves behind. Such a program finds library(ev3dev) of this working copy.
*/

:- prolog_load_context(directory, Tests),
   atom_concat(Home, '/tests/support', Tests),
   atom_concat(Home, '/prolog', Library),
   assertz(library_directory_under_test(Library)).

:- dynamic library_directory_under_test/1.

%!  run_program(+Text, +Options, -Status, -Output)
%
%   Load a program from a file, run it, and wait for its end. Status is
%   exit(Code) or killed(Signal), Output what it printed and complained of.
%   Options:
%
%     - goal(+Goal)
%       Call it after loading.
%     - cwd(+Directory)
%     - env(+Variable=Value)
%     - hints(+Value)
%       Of the flag `ev3dev_hints`: by default `off`. Not set if `default`.

run_program(Text, Options, Status, Output) :-
    start_program(Text, Options, Child),
    end_program(Child, Status, Output).

%!  start_program(+Text, +Options, -Child)
%
%   As run_program/4, and do not wait. Child is child(Pid, Stream, File).

start_program(Text, Options, child(Pid, Out, File)) :-
    program_file(Text, Options, File),
    option(goal(Goal), Options, true),
    status_options(StatusOptions),
    start([ '-q', '-f', none, '-l', file(File), '-g', Goal, '-t', halt
          | StatusOptions ], Options, Pid, Out).

program_file(Text, Options, File) :-
    tmp_file_stream(text, File, Stream),
    library_directory_under_test(Library),
    format(Stream, ":- asserta(user:file_search_path(library, ~q)).~n",
           [Library]),
    option(hints(Hints), Options, off),
    (   Hints == default
    ->  true
    ;   format(Stream, ":- set_prolog_flag(ev3dev_hints, ~q).~n", [Hints])
    ),
    format(Stream, "~s~n", [Text]),
    close(Stream).

start(Arguments, Options, Pid, Out) :-
    option(cwd(Directory), Options, '.'),
    (   option(env(Variable=Value), Options)
    ->  format(atom(Assignment), "~w=~w", [Variable, Value])
    ;   Assignment = 'EV3DEV_TEST=1'
    ),
    option(stdin(In), Options, null),
    swipl(Swipl),
    process_create(path(env), [Assignment, Swipl | Arguments],
                   [ process(Pid), cwd(Directory), stdin(In),
                     stdout(pipe(Out)), stderr(pipe(Out)) ]).

%!  run_state(+File, +Options, -Status, -Output)
%
%   As run_program/4, but of a saved state.

run_state(File, Options, Status, Output) :-
    start(['-x', file(File)], Options, Pid, Out),
    read_to_end(Out, Output),
    process_wait(Pid, Status).

%!  run_script(+File, +Arguments, -Status, -Output) is det.
%!  run_script(+File, +Arguments, +Typed, -Status, -Output) is det.
%
%   As run_program/4, but of a file, which gets Arguments, and the text Typed
%   as its input.

run_script(File, Arguments, Status, Output) :-
    run_script(File, Arguments, "", Status, Output).

run_script(File, Arguments, Typed, Status, Output) :-
    start(['-q', '-f', none, File | Arguments], [stdin(pipe(In))], Pid, Out),
    write(In, Typed),
    close(In),
    read_to_end(Out, Output),
    process_wait(Pid, Status).

%!  descendant(+Text) is semidet.
%
%   A process lives that has Text in its command line, and this one, or a child of a
%   child of it, has started: other tests may run at the same time.

:- current_prolog_flag(pid, Pid),
   setenv('EV3DEV_TEST_PROCESS', Pid).

descendant(Text) :-
    current_prolog_flag(pid, Pid),
    format(string(Mark), 'EV3DEV_TEST_PROCESS=~d\u0000', [Pid]),
    expand_file_name('/proc/[0-9]*', Processes),
    member(Process, Processes),
    atom_concat('/proc/', Other, Process),
    \+ atom_number(Other, Pid),
    process_file_has(Process, cmdline, Text),
    process_file_has(Process, environ, Mark),
    !.

process_file_has(Process, Name, Text) :-
    directory_file_path(Process, Name, File),
    catch(read_file_to_string(File, Content, [encoding(octet)]), error(_, _), fail),
    once(sub_string(Content, _, _, _, Text)).

%!  pack_version(-Version)
%
%   What pack.pl of this working copy says, an atom.

pack_version(Version) :-
    library_directory_under_test(Library),
    file_directory_name(Library, Home),
    directory_file_path(Home, 'pack.pl', File),
    read_file_to_terms(File, Terms, []),
    memberchk(version(Version), Terms).

%!  swipl(-Program)
%
%   What starts a Prolog. SWIPL in the environment counts, as this one may not start by
%   itself: an emulated one does not.

swipl(Swipl) :-
    getenv('SWIPL', Swipl),
    !.
swipl(Swipl) :-
    current_prolog_flag(executable, Swipl).

%!  starts_itself
%
%   True if a program can start its own Prolog again. One that is emulated cannot.

starts_itself :-
    current_prolog_flag(executable, Prolog),
    process_create(Prolog, ['-f', none, '-g', true, '-t', halt],
                   [stdin(null), stdout(null), stderr(null), process(Pid)]),
    process_wait(Pid, exit(0)).

status_options(Options) :-
    current_prolog_flag(version, Version),
    (   Version >= 90000
    ->  Options = ['--on-error=status', '--on-warning=status']
    ;   Options = []
    ).

%!  at_toplevel(+Kind, +Text, :Closure)
%
%   Load a program from a file, wait for queries, and call(Closure, Toplevel)
%   once meanwhile. Kind is `pipe` or `terminal`.

:- meta_predicate at_toplevel(+, +, 1).

at_toplevel(Kind, Text, Closure) :-
    program_file(Text, [], File),
    setup_call_cleanup(
        open_toplevel(Kind, File, Toplevel),
        once(call(Closure, Toplevel)),
        ( close_toplevel(Toplevel),
          delete_file(File) )).

open_toplevel(Kind, File, toplevel(Pid, In, Out)) :-
    swipl(Swipl),
    toplevel_command(Kind, Swipl, File, Program, Arguments),
    process_create(path(Program), Arguments,
                   [ process(Pid), stdin(pipe(In)),
                     stdout(pipe(Out)), stderr(pipe(Out)) ]),
    % Much longer than a machine that is busy with other things takes.
    set_stream(Out, timeout(300)).

toplevel_command(pipe, Swipl, File, env,
                 [Swipl, '-q', '-f', none, '-l', file(File)]).
toplevel_command(terminal, Swipl, File, script,
                 ['-qfc', Command, '/dev/null']) :-
    format(atom(Command), 'TERM=xterm "~w" -q -f none -l "~w"',
           [Swipl, File]).

%!  can_open_terminal
%
%   True if this machine has script(1), which makes terminals.

can_open_terminal :-
    absolute_file_name(path(script), _,
                       [access(execute), file_errors(fail)]).

%   It ends at the end of its input.
close_toplevel(toplevel(Pid, In, Out)) :-
    catch(close(In), _, true),
    process_wait(Pid, Status, [timeout(300)]),
    (   Status == timeout
    ->  process_kill(Pid, kill),
        process_wait(Pid, _)
    ;   true
    ),
    close(Out).

%!  type(+Toplevel, +Text)

type(toplevel(_, In, _), Text) :-
    write(In, Text),
    flush_output(In).

%!  printed_line(+Toplevel, -Line)
%
%   The next line that a toplevel prints, without prompts.

printed_line(toplevel(_, _, Out), Line) :-
    read_line_to_string(Out, Line0),
    (   Line0 == end_of_file
    ->  throw(error(toplevel_has_ended, _))
    ;   without_prompts(Line0, Line)
    ).

without_prompts(Line0, Line) :-
    split_string(Line0, "", "\r ", [Line1]),
    (   sub_string(Line1, Before, _, After, "?- ")
    ->  Start is Before + 3,
        sub_string(Line1, Start, After, 0, Line2),
        without_prompts(Line2, Line)
    ;   string_concat("|: ", Line2, Line1)
    ->  without_prompts(Line2, Line)
    ;   Line = Line1
    ).

%!  end_program(+Child, -Status, -Output)

end_program(child(Pid, Out, File), Status, Output) :-
    end_output(child(Pid, Out, File), Output),
    process_wait(Pid, Status).

%!  end_output(+Child, -Output)
%
%   The rest of what a program printed that is known to be over.

end_output(child(_, Out, File), Output) :-
    read_to_end(Out, Output),
    delete_file(File).

%!  kill_program(+Child)
%
%   End a program that does not end by itself.

kill_program(child(Pid, Out, File)) :-
    process_kill(Pid, kill),
    process_wait(Pid, _),
    close(Out),
    delete_file(File).

read_to_end(Out, Output) :-
    read_stream_to_codes(Out, Codes),
    close(Out),
    string_codes(Output, Codes).
