/*  The Prolog files call nothing that SWI-Prolog 7.2.3 lacks, the version of
    most bricks.

        swipl -g main -t 'halt(1)' tests/brick/old.pl

    swipl-7.2.3.txt beside this file lists what its core has: a line
    `system Name/Arity` for a built-in and `library(Name) Name/Arity` for what
    a library exports.
*/

:- asserta(user:file_search_path(library, prolog)).
:- use_module(library(ev3dev)).
:- use_module(library(ev3dev/sim)).
:- use_module(library(ev3dev/drive)).
:- use_module(library(ev3dev/grid)).
:- use_module(library(ev3dev/planners), []).
:- use_module(library(ev3dev/roadmap)).
:- use_module(library(prolog_xref)).
:- use_module(library(readutil)).

:- dynamic
    old/2.                              % Where, Name/Arity

%   Packages of that time, which Debian's swi-prolog brings.

old_package(Library) :-
    memberchk(Library, [filesex, plunit, process, readutil, socket, time]).

main :-
    ev3dev_on_demand:load_on_demand,
    read_list('tests/brick/swipl-7.2.3.txt'),
    expand_file_name('prolog/*.pl', Files0),
    expand_file_name('prolog/*/*.pl', Files1),
    expand_file_name('prolog/ev3dev/planners/*.pl', Files2),
    append([ Files0, Files1, Files2,
             [ 'examples/brick_check.pl', 'examples/remote_control.pl',
               'examples/thermometer.pl' ] ], Files),
    findall(File-Problem,
            ( member(File, Files), problem(File, Problem) ),
            Problems0),
    sort(Problems0, Problems),
    forall(member(File-Problem, Problems),
           format(user_error, '~w: not in 7.2.3: ~q~n', [File, Problem])),
    length(Files, Count),
    (   Problems == []
    ->  format('~d files call nothing newer than 7.2.3~n', [Count]),
        halt(0)
    ;   halt(1)
    ).

read_list(File) :-
    setup_call_cleanup(
        open(File, read, In),
        read_lines(In),
        close(In)).

read_lines(In) :-
    read_line_to_string(In, Line),
    (   Line == end_of_file
    ->  true
    ;   sub_string(Line, Before, _, After, " "),
        !,
        sub_string(Line, 0, Before, _, Where0),
        sub_string(Line, _, After, 0, What0),
        term_string(Where, Where0),
        term_string(What, What0),
        assertz(old(Where, What)),
        read_lines(In)
    ).

problem(File, Problem) :-
    absolute_file_name(File, Source),
    xref_source(Source, [silent(true), register_called(all)]),
    (   xref_called(Source, Goal, _),
        \+ fine(Source, Goal),
        called_name(Goal, Problem)
    ;   library_file_used(Source, Spec),
        \+ old_file(Spec),
        Problem = Spec
    ).

called_name(Module:Goal, Module:Name/Arity) :-
    !,
    functor(Goal, Name, Arity).
called_name(Goal, Name/Arity) :-
    functor(Goal, Name, Arity).

library_file_used(Source, library(Library)) :-
    prolog_xref:uses_file(library(Library), Source, _).

old_file(library(Library)) :-
    (   Library == ev3dev
    ;   Library = ev3dev/_
    ),
    !.
old_file(library(Library)) :-
    (   old(library(Library), _)
    ->  true
    ;   old_package(Library)
    ).

fine(_, Module:Goal) :-
    !,
    (   atom(Module), atom_concat(ev3dev_, _, Module)
    ->  true
    ;   functor(Goal, Name, Arity),
        old(_, Name/Arity)
    ).
fine(_, Goal) :-
    functor(Goal, Name, Arity),
    module_property(ev3dev, exports(Exports)),
    memberchk(Name/Arity, Exports),
    !.
fine(Source, Goal) :-
    xref_defined(Source, Goal, How),
    !,
    (   How = imported(From)
    ->  functor(Goal, Name, Arity),
        fine_import(From, Name/Arity)
    ;   true
    ).
fine(Source, Goal) :-
    native(Source, Goal),
    !.
fine(_, Goal) :-
    functor(Goal, Name, Arity),
    old(_, Name/Arity).

fine_import(File, _) :-
    absolute_file_name(prolog, Pack),
    sub_atom(File, 0, _, _, Pack),
    !.
fine_import(File, Predicate) :-
    file_base_name(File, Base),
    file_name_extension(Library, _, Base),
    (   old(library(Library), Predicate)
    ;   old_package(Library)
    ),
    !.

native(Source, Goal) :-
    module_property(Module, file(Source)),
    predicate_property(Module:Goal, foreign),
    \+ predicate_property(Module:Goal, imported_from(_)),
    \+ predicate_property(Module:Goal, built_in).
