% Checks over the pack's Prolog files; run by `make lint`.

:- use_module(trees).
:- use_module(library(ev3dev)).
:- use_module(library(ev3dev/sim)).
:- use_module(library(ev3dev/private/sensor_table/lego)).
:- use_module(library(ev3dev/private/sensor_table/other)).
:- use_module(library(ev3dev/drive)).
:- use_module(library(ev3dev/grid)).
:- use_module(library(ev3dev/planners)).
:- use_module(library(ev3dev/roadmap)).
:- use_module(library(check)).
:- use_module(library(prolog_xref)).
:- use_module(library(pldoc)).
:- use_module(library(pldoc/doc_process)).
:- doc_collect(true).

:- dynamic complaint/0.

main :-
    load_again,
    check,
    forall(undocumented(Module, PI), complain(undocumented(Module:PI))),
    forall(( source(File), bad_line(File, Line, Why) ), complain(line(File, Line, Why))),
    forall(without_partner(File), complain(no_test_or_no_module(File))),
    (   complaint
    ->  halt(1)
    ;   halt(0)
    ).

% Documentation is kept only of what is loaded after doc_collect/1.
load_again :-
    forall(library_module(Module),
           ( module_property(Module, file(File)),
             load_files(File, [if(true), imports([])])
           )).

complain(What) :-
    assertz(complaint),
    print_message(error, format("~p", [What])).

% Warnings of check/0 count, too.
user:message_hook(_, Kind, _) :-
    memberchk(Kind, [warning, error]),
    assertz(complaint),
    fail.

library_module(Module) :-
    current_module(Module),
    sub_atom(Module, 0, _, _, ev3dev),
    module_property(Module, file(_)).

%!  undocumented(-Module, -PI) is nondet.
%
%   An export without a PlDoc comment in the module that defines it.

undocumented(Module, Name/Arity) :-
    library_module(Module),
    module_property(Module, exports(Exports)),
    member(Name/Arity, Exports),
    functor(Head, Name, Arity),
    \+ predicate_property(Module:Head, imported_from(_)),
    \+ doc_comment(Module:Name/Arity, _, _, _).

%!  without_partner(-File) is nondet.
%
%   A public module has a test file of its name, and the other way round: what
%   is about no single module is in tests/behavior.

without_partner(File) :-
    named('prolog/ev3dev/*.pl', '', Name, File),
    \+ named('tests/prolog/*.pl', test_, Name, _).
without_partner(File) :-
    named('tests/prolog/*.pl', test_, Name, File),
    \+ named('prolog/ev3dev/*.pl', '', Name, _).

named(Pattern, Prefix, Name, File) :-
    expand_file_name(Pattern, Files),
    member(File, Files),
    file_base_name(File, Base),
    file_name_extension(Stem, _, Base),
    atom_concat(Prefix, Name, Stem).

source(File) :-
    member(Pattern, ['pack.pl', 'prolog/*.pl', 'prolog/*/*.pl',
                     'prolog/*/*/*.pl', 'examples/*.pl']),
    expand_file_name(Pattern, Files),
    member(File, Files).

bad_line(File, Number, Why) :-
    setup_call_cleanup(
        open(File, read, Stream),
        ( repeat,
          read_line_to_string(Stream, Line),
          line_count(Stream, Number),
          (   Line == end_of_file
          ->  !, fail
          ;   bad(Line, Why)
          )
        ),
        close(Stream)).

bad(Line, tab) :-
    sub_string(Line, _, _, _, "\t").
bad(Line, trailing_space) :-
    sub_string(Line, _, 1, 0, " ").
bad(Line, too_long) :-
    string_length(Line, Length),
    Length > 78.
