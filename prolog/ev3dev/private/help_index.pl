:- module(ev3dev_help_index, []).

:- if((current_prolog_flag(version, Version), Version >= 80200)).

:- use_module(library(lists), [member/2]).
:- use_module(library(prolog_xref),
              [ xref_source/2, xref_module/2, xref_exported/2 ]).
:- use_module(library(pldoc), []).      % first, or doc_process does not load
:- use_module(library(pldoc/doc_process), [doc_comment/4]).

/** <module> The pack's predicates in the index of the manual

Loading this file adds them to the index, for apropos/1. It reads the comments
from the files of the libraries, and does not load these.
*/

%   extend_manual_index
%
%   Add each documented predicate of the pack. Does nothing in a version of
%   Prolog that stores its index in another way.

extend_manual_index :-
    (   predicate_property(prolog_manual_index:man_index(_, _, _, _, _),
                           dynamic)
    ->  ignore(prolog_manual_index:current_man_object(_)),
        forall(documented(File, Object, Summary),
               assertz(prolog_manual_index:man_index(Object, Summary, File,
                                                     ev3dev, 0)))
    ;   true
    ).

:- initialization(extend_manual_index).

%   documented(-File, -Object, -Summary)
%
%   True if the comment of a predicate in File, a public library, starts with
%   Summary. Object is `ev3dev:PI` if library(ev3dev) exports the predicate,
%   else for example `'ev3dev/drive':PI`. Object does not name the module that
%   defines the predicate: help/1 would take File for a page of the manual.

documented(File, Where:PI, Summary) :-
    public_file(Library, File),
    xref_source(File, [comments(store)]),
    xref_module(File, Module),
    xref_exported(File, Head),
    functor(Head, Name, Arity),
    PI = Name/Arity,
    once(summary(Module, Head, PI, Summary)),
    (   module_property(ev3dev, exports(Exports)),
        memberchk(PI, Exports)
    ->  Where = ev3dev
    ;   Where = Library
    ).

summary(Module, _, PI, Summary) :-
    doc_comment(Module:PI, _, Summary, _).
summary(Module, Head, PI, Summary) :-
    predicate_property(Module:Head, imported_from(Private)),
    module_property(Private, file(File)),
    xref_source(File, [comments(store)]),
    doc_comment(Private:PI, _, Summary, _).

public_file(Library, File) :-
    module_property(ev3dev_help_index, file(This)),
    file_directory_name(This, Private),
    file_directory_name(Private, Ev3dev),
    file_directory_name(Ev3dev, Directory),
    member(Folder, ['ev3dev/', 'ev3dev/planners/']),
    atomic_list_concat([Directory, /, Folder, '*.pl'], Pattern),
    expand_file_name(Pattern, Files),
    member(File, Files),
    file_base_name(File, Base),
    file_name_extension(Name, _, Base),
    atom_concat(Folder, Name, Library).

:- endif.
