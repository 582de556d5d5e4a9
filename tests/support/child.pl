:- module(child,
          [ run_program/4,              % +Text, +Options, -Status, -Output
            start_program/3,            % +Text, +Options, -Child
            run_state/4,                % +File, +Options, -Status, -Output
            run_script/4,               % +File, +Arguments, -Status, -Output
            end_program/3,              % +Child, -Status, -Output
            end_output/2                % +Child, -Output
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
    close(Stream),
    option(goal(Goal), Options, true),
    status_options(StatusOptions),
    start([ '-q', '-f', none, '-l', file(File), '-g', Goal, '-t', halt
          | StatusOptions ], Options, Pid, Out).

start(Arguments, Options, Pid, Out) :-
    option(cwd(Directory), Options, '.'),
    (   option(env(Variable=Value), Options)
    ->  format(atom(Assignment), "~w=~w", [Variable, Value])
    ;   Assignment = 'EV3DEV_TEST=1'
    ),
    swipl(Swipl),
    process_create(path(env), [Assignment, Swipl | Arguments],
                   [ process(Pid), cwd(Directory), stdin(null),
                     stdout(pipe(Out)), stderr(pipe(Out)) ]).

%!  run_state(+File, +Options, -Status, -Output)
%
%   As run_program/4, but of a saved state.

run_state(File, Options, Status, Output) :-
    start(['-x', file(File)], Options, Pid, Out),
    read_to_end(Out, Output),
    process_wait(Pid, Status).

%!  run_script(+File, +Arguments, -Status, -Output)
%
%   As run_program/4, but of a file, which gets Arguments.

run_script(File, Arguments, Status, Output) :-
    start(['-q', '-f', none, File | Arguments], [], Pid, Out),
    read_to_end(Out, Output),
    process_wait(Pid, Status).

%   SWIPL in the environment counts, as this one may not start by itself: an
%   emulated one does not.

swipl(Swipl) :-
    getenv('SWIPL', Swipl),
    !.
swipl(Swipl) :-
    current_prolog_flag(executable, Swipl).

status_options(Options) :-
    current_prolog_flag(version, Version),
    (   Version >= 90000
    ->  Options = ['--on-error=status', '--on-warning=status']
    ;   Options = []
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

read_to_end(Out, Output) :-
    read_stream_to_codes(Out, Codes),
    close(Out),
    string_codes(Output, Codes).
