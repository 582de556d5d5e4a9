:- module(libraries,
          [ public_library/1,           % ?Library
            public_export/2             % ?Library, ?PI
          ]).
:- use_module(child).
:- use_module(library(lists)).

/** <module> The exports of the public libraries

A Prolog of its own loads them all, as a program does, and reports what their
modules export. The test that asks has loaded none of them by that.
*/

:- dynamic exports/2.

%!  public_library(?Library) is nondet.
%
%   Library is `ev3dev`, or `drive` for library(ev3dev/drive), and so on: each
%   file beside `prolog/ev3dev/drive.pl` is one.

public_library(Library) :-
    known,
    exports(Library, _).

%!  public_export(?Library, ?PI) is nondet.
%
%   A program that loads Library can call PI by that. This leaves out what a
%   file exports to other files of the pack alone: the library that a program
%   loads takes all else from the file, as library(ev3dev) does from
%   library(ev3dev/sensors).

public_export(Library, PI) :-
    known,
    exports(Library, PIs),
    member(PI, PIs).

known :-
    exports(_, _),
    !.
known :-
    asked(Output),
    !,
    open_string(Output, In),
    repeat,
    read(In, Term),
    (   Term == end_of_file
    ->  !
    ;   assertz(Term),
        fail
    ).
known :-
    throw(error(system_error('the libraries could not be asked'), _)).

asked(Output) :-
    run_program(":- use_module(library(ev3dev)).

        file(ev3dev, File) :-
            module_property(ev3dev, file(File)).
        file(Name, File) :-
            module_property(ev3dev, file(Main)),
            file_name_extension(Base, _, Main),
            atom_concat(Base, '/*.pl', Pattern),
            expand_file_name(Pattern, Files),
            '$member'(File, Files),
            file_base_name(File, Part),
            file_name_extension(Name, _, Part).

        offers(Name, PI, From) :-
            file(Name, File),
            module_property(Module, file(File)),
            module_property(Module, exports(PIs)),
            '$member'(PI, PIs),
            PI = F/A,
            functor(Head, F, A),
            (   predicate_property(Module:Head, imported_from(From))
            ->  true
            ;   From = Module
            ).

        % Others take from its module, and nobody this one.
        for_the_pack(Name, PI) :-
            offers(Name, PI, Module),
            \\+ ( offers(Other, PI, Module), Other \\== Name ),
            offers(Taker, _, Module), Taker \\== Name,
            !.

        main :-
            forall(file(_, File), use_module(File, [])),
            forall(file(Name, _),
                   ( findall(PI, ( offers(Name, PI, _),
                                   \\+ for_the_pack(Name, PI) ), PIs),
                     format('~q.~n', [exports(Name, PIs)]) )).",
                [goal(main)], Status, Output),
    must_be_exit(Status, Output).

must_be_exit(exit(0), _) :-
    !.
must_be_exit(Status, Output) :-
    throw(error(system_error(Status), context(_, Output))).
