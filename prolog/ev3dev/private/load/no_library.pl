:- module(ev3dev_no_library,
          [ without_library/1           % +Error
          ]).
:- set_prolog_flag(generate_debug_info, false).

/** <module> The pack where it cannot be loaded

Its foreign library is missing, for example after a pack_install that found no
Rust to build it, or too few files may be open. One message says so. The files
of the pack are then read for their exports alone: each exported
predicate throws the same error. Nothing loads this file on a machine that has
the library.
*/

:- multifile
    prolog:message//1,
    user:term_expansion/2.
:- dynamic
    missing/1,                          % Error
    told/1,                             % File
    user:term_expansion/2.
:- volatile
    missing/1.

%!  without_library(+Error) is det.
%
%   Print Error, which says that there is no library for this machine. All
%   files of the pack that are being loaded or will be have but predicates
%   that throw Error.

without_library(Error) :-
    assertz(missing(Error)),
    print_message(error, Error).

%   At the prompt, too, with no backtrace after it.

prolog:message(error(Formal, context(_, Text))) -->
    { missing(error(Formal0, _)), Formal == Formal0 },
    [ 'library(ev3dev) cannot be used: ~w'-[Text] ].

%   Libraries that offer what others export go on doing so.

user:term_expansion(Term, Terms) :-
    ev3dev_no_library:missing(Error),
    prolog_load_context(source, File),
    ev3dev_no_library:in_pack(File),
    ev3dev_no_library:reduced(Term, File, Error, Terms).

%   What comes before the module is left: it may be `begin_of_file`.

reduced(Term, File, Error, Terms) :-
    prolog_load_context(module, Module),
    module_property(Module, file(File)),
    clauses(File, Module, Error, Clauses),
    (   Term == end_of_file
    ->  Clauses \== [],
        followed_by(Clauses, Term, Terms)
    ;   reexports(Term),
        can_load(Error)
    ->  Terms = [Term|Clauses]
    ;   Terms = Clauses
    ).

%   Fails if no other file may be open.

can_load(error(Formal, _)) :-
    (   Formal = resource_error(_)
    ->  module_property(ev3dev_no_library, file(This)),
        catch(setup_call_cleanup(open(This, read, In), true, close(In)),
              error(resource_error(_), _), fail)
    ;   true
    ).

reexports((:- reexport(_))).
reexports((:- reexport(_, _))).

in_pack(File) :-
    module_property(ev3dev_no_library, file(This)),
    file_directory_name(This, Room),
    file_directory_name(Room, Private),
    file_directory_name(Private, Ev3dev),
    sub_atom(File, 0, _, _, Ev3dev).

%   The clauses of all predicates that File exports; once.

clauses(File, Module, Error, Clauses) :-
    (   told(File)
    ->  Clauses = []
    ;   assertz(told(File)),
        module_property(Module, exports(Exports)),
        findall((Head :- throw(Error)), lacking(Module, Exports, Head),
                Clauses)
    ).

followed_by([], Last, [Last]).
followed_by([X|Xs], Last, [X|Ys]) :-
    followed_by(Xs, Last, Ys).

lacking(Module, Exports, Head) :-
    '$member'(Name/Arity, Exports),
    functor(Head, Name, Arity),
    \+ current_predicate(Module:Name/Arity).
