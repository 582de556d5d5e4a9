% Each example loads without a word, each in a program of its own.

:- use_module(library(plunit)).
:- use_module(library(process)).
:- use_module(library(readutil)).

:- begin_tests(examples).

test(loads_without_a_word, [forall(example(File)), true(Said-End == ""-exit(0))]) :-
    (   getenv('SWIPL', Swipl)
    ->  true
    ;   current_prolog_flag(executable, Swipl)
    ),
    process_create(path(env),
                   [ Swipl, '-q', '-p', 'library=prolog', '-l', file(File),
                     '-g', true, '-t', halt ],
                   [stdin(null), stderr(pipe(Out)), process(Id)]),
    read_string(Out, _, Said),
    close(Out),
    process_wait(Id, End).

example(File) :-
    expand_file_name('examples/*.pl', Files),
    member(File, Files).

:- end_tests(examples).
