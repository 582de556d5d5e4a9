/*  What tools/check-brick-prolog.sh tries in brick-prolog, a goal each:

        swipl -g <goal> -t 'halt(1)' check-brick-prolog.pl [argument ...]
*/

:- use_module(library(filesex)).
:- use_module(library(process)).
:- use_module(library(readutil)).

%   The flags name the command, not the loader or the program behind it.

flags :-
    current_prolog_flag(argv, [Folder]),
    current_prolog_flag(version, 90004),
    current_prolog_flag(encoding, utf8),
    directory_file_path(Folder, 'bin/swipl', Command),
    must_be_flag(executable, Command),
    directory_file_path(Folder, 'lib/swi-prolog', Home),
    must_be_flag(home, Home),
    halt(0).

must_be_flag(Flag, Expected) :-
    current_prolog_flag(Flag, Value),
    (   Value == Expected
    ->  true
    ;   format(user_error, '~w: ~w instead of ~w~n', [Flag, Value, Expected]),
        fail
    ).

%   Text that is not ASCII, in source, arguments, letters and files.

unicode :-
    current_prolog_flag(argv, [Argument]),
    Argument == 'größe€',
    upcase_atom(Argument, 'GRÖßE€'),
    char_type(ö, alpha),
    format('~w~n', [Argument]),
    open('ä€.txt', write, Out),
    write(Out, Argument),
    close(Out),
    read_file_to_string('ä€.txt', Text, []),
    atom_string(Argument, Text),
    directory_files(., Files),
    memberchk('ä€.txt', Files),
    halt(0).

%   Every foreign library finds the libraries that it needs.

foreign_libraries :-
    current_prolog_flag(home, Home),
    atom_concat(Home, '/lib/*/*.so', Pattern),
    expand_file_name(Pattern, Files),
    length(Files, Count),
    Count > 30,
    forall(member(File, Files), loads(File)),
    halt(0).

loads(File) :-
    catch(open_shared_object(File, _), E,
          ( print_message(error, E), fail )).

%   A program of the system sees none of our settings.

environment :-
    output(path(env), [], Text),
    split_string(Text, "\n", "", Lines),
    forall(( member(Line, Lines),
             member(Name, ["LOCPATH", "LC_ALL", "LD_", "SWI_", "BRICK_"]),
             string_concat(Name, _, Line) ),
           (   Line == "LC_ALL=POSIX"
           ->  true
           ;   format(user_error, '~w~n', [Line]),
               fail
           )),
    memberchk("LC_ALL=POSIX", Lines),
    halt(0).

%   Another SWI-Prolog is started, by its name and by the flag.

children :-
    current_prolog_flag(executable, Executable),
    forall(member(Program, [path(swipl), Executable]),
           ( output(Program, ['-g', 'X is 6*7, print(X)', '-t', halt], "42")
           ->  true
           ;   format(user_error, 'no answer of ~w~n', [Program]),
               fail
           )),
    halt(0).

output(Program, Arguments, Text) :-
    setup_call_cleanup(
        process_create(Program, Arguments,
                       [stdin(null), stdout(pipe(Out)), process(Pid)]),
        read_string(Out, _, Text),
        close(Out)),
    process_wait(Pid, exit(0)).

%   A saved state starts the command that saved it.

save_state :-
    qsave_program('state', [goal(saved), toplevel(halt)]),
    halt(0).

saved :-
    format('saved~n').

%   A page served to ourselves, by the address that is ours alone.

http :-
    use_module(library(http/thread_httpd)),
    use_module(library(http/http_dispatch)),
    use_module(library(http/http_open)),
    http_server(page, [port('127.0.0.1':Port), workers(1)]),
    format(atom(URL), 'http://127.0.0.1:~w/', [Port]),
    setup_call_cleanup(
        http_open(URL, In, []),
        ( set_stream(In, encoding(utf8)),
          read_string(In, _, Text) ),
        close(In)),
    http_stop_server('127.0.0.1':Port, []),
    Text == "grüße",
    halt(0).

page(_) :-
    format('Content-type: text/plain; charset=utf-8~n~ngrüße').

%   A test is run.

plunit :-
    use_module(library(plunit)),
    Text = ":- begin_tests(sums).\n\c
            test(sum, X == 3) :- X is 1+2, nb_setval(ran, true).\n\c
            :- end_tests(sums).\n",
    setup_call_cleanup(
        open_string(Text, In),
        load_files(sums, [stream(In)]),
        close(In)),
    nb_setval(ran, false),
    run_tests(sums),
    nb_getval(ran, true),
    halt(0).

%   The pack's library is the one for the brick.

pack_library :-
    use_module(library(ev3dev)),
    ev3dev_library_file:library_file(File),
    sub_atom(File, _, _, 0, '/pack/ev3dev/native/armel/ev3dev.so'),
    halt(0).
