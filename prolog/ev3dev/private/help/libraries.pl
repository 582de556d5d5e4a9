:- module(ev3dev_libraries,
          [ in_library/2,               % ?Library, ?Predicates
            pack_file/2                 % ?Folder, -File
          ]).
:- set_prolog_flag(generate_debug_info, false).
:- use_module('../basics/small_lists', [append_lists/3, one_of/2]).

/** <module> The libraries of predicates

For help/1, apropos/1, and messages about predicates of libraries that are not
loaded. Nothing loads this file before one is needed. At the first question it
reads the directives at the beginning of the libraries' files, and keeps what
they say: a file names what it exports, and what it takes from others.
*/

%   library_(Library, Predicates)
%   head_(File, Exports, Taken, Apart): Taken is a list of File-Import, as in
%   reexport/2. Apart is true if a program may load File by itself.
:- dynamic
    library_/2,
    head_/4.
:- volatile
    library_/2,
    head_/4.

%!  in_library(?Library, ?Predicates) is nondet.
%
%   library(ev3dev/Library) is the one to load for Predicates, a list of
%   Name/Arity. Those of library(ev3dev) are not here. If several libraries
%   offer a predicate, it is in one of them: the one that others take it from,
%   else the first by its name.

in_library(Library, Predicates) :-
    with_mutex(ev3dev_libraries, read_libraries),
    library_(Library, Predicates).

read_libraries :-
    library_(_, _),
    !.
read_libraries :-
    pack_folder(Folder),
    atom_concat(Folder, '/private/load/core.pl', Core),
    offers(Core, Common),
    findall(File, ( pack_file('', File), is_apart(File) ), Files),
    add_libraries(Files, Common),
    retractall(head_(_File, _, _, _)).

add_libraries([], _).
add_libraries([File|Files], Others0) :-
    offers(File, Offered0),
    without(Offered0, Others0, Offered),
    file_base_name(File, Base),
    file_name_extension(Library, _, Base),
    assertz(library_(Library, Offered)),
    append_lists(Offered, Others0, Others),
    add_libraries(Files, Others).

%!  pack_file(?Folder, -File) is nondet.
%
%   File is a Prolog file of the pack in Folder, which is '' for the folder of
%   the public libraries, or `private` or the like below it. Files of worlds
%   and robots are there, too.

pack_file(Below, File) :-
    pack_folder(Top),
    file_below('', Top, Below, File).

file_below(Below, Folder, Below, File) :-
    entry(Folder, Name),
    file_name_extension(_, pl, Name),
    atomic_list_concat([Folder, /, Name], File).
file_below(Here, Folder, Below, File) :-
    entry(Folder, Name),
    \+ sub_atom(Name, _, _, _, '.'),
    atomic_list_concat([Folder, /, Name], Inner),
    exists_directory(Inner),
    (   Here == ''
    ->  There = Name
    ;   atomic_list_concat([Here, /, Name], There)
    ),
    file_below(There, Inner, Below, File).

%   In a saved program there may be no folder.

entry(Folder, Name) :-
    exists_directory(Folder),
    directory_files(Folder, Names0),
    msort(Names0, Names),
    one_of(Names, Name).

pack_folder(Folder) :-
    module_property(ev3dev_libraries, file(This)),
    file_directory_name(This, Room),
    file_directory_name(Room, Private),
    file_directory_name(Private, Folder).

% ---------------- HEADS

%   offers(+File, -Predicates)
%
%   Predicates are those that File exports, but what it takes from a file that
%   a program may load by itself.

offers(File, Predicates) :-
    head(File, Exports, Taken, _),
    findall(Name/Arity,
            ( one_of(Exports, Name/Arity)
            ; one_of(Taken, From-Import),
              \+ is_apart(From),
              offers(From, All),
              imported(Import, All, Name/Arity)
            ),
            Predicates).

imported(all, All, Predicate) :-
    one_of(All, Predicate).
imported(except(Others), All, Predicate) :-
    without(All, Others, Some),
    one_of(Some, Predicate).
imported([Import|Imports], _, Predicate) :-
    one_of([Import|Imports], Predicate).

is_apart(File) :-
    head(File, _, _, true).

head(File, Exports, Taken, Apart) :-
    (   head_(File, _, _, _)
    ->  true
    ;   setup_call_cleanup(
            open(File, read, In, [encoding(utf8)]),
            directives(In, Directives),
            close(In)),
        Directives = [module(_, Exports0)|_],
        file_directory_name(File, Folder),
        findall(From-Import, taken(Directives, Folder, From, Import), Taken0),
        (   one_of(Directives, use_module(private/load/compiled, _))
        ->  Apart0 = true
        ;   Apart0 = false
        ),
        assertz(head_(File, Exports0, Taken0, Apart0))
    ),
    head_(File, Exports, Taken, Apart).

%   As far as the first clause, or the first term that Prolog cannot read here

directives(In, Directives) :-
    catch(read(In, Term), error(_, _), fail),
    nonvar(Term),
    Term = (:- Directive),
    !,
    Directives = [Directive|Directives1],
    directives(In, Directives1).
directives(_, []).

%   Each library loads `private/load/compiled` first if a program may load it.

taken(Directives, Folder, File, Import) :-
    one_of(Directives, Directive),
    (   Directive = reexport(Spec),
        Import = all
    ;   Directive = reexport(Spec, Import)
    ),
    format(atom(Name), '~w/~w.pl', [Folder, Spec]),
    absolute_file_name(Name, File).

without([], _, []).
without([X|Xs], Others, Rest) :-
    (   memberchk(X, Others)
    ->  Rest = Rest1
    ;   Rest = [X|Rest1]
    ),
    without(Xs, Others, Rest1).
