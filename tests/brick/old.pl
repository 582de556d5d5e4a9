/*  The Prolog files use nothing that SWI-Prolog 7.2.3 lacks, the version of
    most bricks: no predicate, export, function, flag, option or syntax.

        swipl -g main -t 'halt(1)' tests/brick/old.pl

    The files are not run, and 7.2.3 is not needed: what it has is listed in
    swipl-7.2.3.txt and swipl-7.2.3-arguments.txt beside this file. First, the
    samples in old/samples.pl show that what is newer is found. They have 83
    problems. An undefined predicate or a missing library, as library(prolog_xref)
    finds them, are 26 of these; the others are functions, flags, options, keys,
    formats and syntax, and show in a 7.2.3 only where a test runs them.
*/

:- asserta(user:file_search_path(library, prolog)).
:- use_module(old/facts, [read_list/1]).
:- use_module(old/samples, [wrong_sample/3]).
:- use_module(old/terms, [declared_exports/2]).
:- use_module(old/uses, [file_problem/3]).

main :-
    load_pack,
    read_list('tests/brick/swipl-7.2.3.txt'),
    read_list('tests/brick/swipl-7.2.3-arguments.txt'),
    forall(( for_new(File), \+ exists_file(File) ),
           throw(error(existence_error(file, File), context(for_new/1, _)))),
    findall(Sample, wrong(Sample), Samples),
    findall(File, source(File), Files),
    findall(Found,
            ( member(File, Files), found(File, Found) ),
            Problems),
    length(Files, Count),
    (   Samples == [],
        Problems == []
    ->  format('~d files use nothing newer than 7.2.3~n', [Count]),
        halt(0)
    ;   halt(1)
    ).

%   What is native, and which arguments are goals, is asked of the modules.

load_pack :-
    forall(( pack_file(File), declared_exports(File, _) ),
           load_files(File, [if(not_loaded), imports([])])).

source(File) :-
    pack_file(File).
source(File) :-
    member(Pattern, ['examples/*.pl', 'app/*.pl', 'tools/*.pl']),
    expand_file_name(Pattern, Files),
    member(File, Files),
    \+ for_new(File).
source('tests/brick/smoke.pl').
source('tests/brick/example.pl').

%   The site of pages needs pldoc of version 9, and the other one tries that
%   version on the brick.

for_new('tools/doc.pl').
for_new('tools/mutate.pl').
for_new('tools/check-brick-prolog.pl').

pack_file(File) :-
    directory_member(prolog, File, [extensions([pl]), recursive(true)]).

wrong(Text) :-
    wrong_sample(Text, Expected, Found),
    format(user_error, 'expected ~q, but found ~q in~n~s~n',
           [Expected, Found, Text]).

found(File, Problem) :-
    file_problem(File, Line, Problem),
    problem_text(Problem, Text),
    format(user_error, '~w:~d: not in 7.2.3: ~w~n', [File, Line, Text]).

%   As in the list of what there is

problem_text(Where-What, Text) :-
    (   Where =.. [Kind, Predicate],
        Kind \== library
    ->  format(string(Text), '~w ~q ~q', [Kind, Predicate, What])
    ;   format(string(Text), '~q ~q', [Where, What])
    ).
