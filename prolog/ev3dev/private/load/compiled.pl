:- module(ev3dev_compiled,
          [ indexed/1,                  % -Units
            used/1,                     % ?Unit
            index_file/1,               % -File
            pack_folder/1,              % -Folder
            this_prolog/1,              % -Prolog
            source_time/2,              % +File, -Milliseconds
            contents/2,                 % +File, -Sum
            read_index/2                % +File, -Index
          ]).

/** <module> Compiled libraries

A brick needs a second to read the sources of the pack, and a tenth of that
for what was compiled. A unit is several files in one: when one of them is
needed, its unit is loaded, and then Prolog finds that the file is there.
Where there is no unit, Prolog reads the source.

An index names the units. It holds for the Prolog, the folder and the sources
that made them: if a source has another time now, or if another Prolog runs,
no unit is used. A unit is used only if its file has the contents that the
index says.

This file is always read, so it is short: units.pl does the work with the
index. It is compiled, too, and is not loaded without an index. This file
loads nothing else.
*/

%!  indexed(-Units) is semidet.
%
%   The units of the index; units.pl takes it away when it looks at
%   them.

%!  used(?Unit) is nondet.
%
%   What has been loaded compiled; units.pl adds to it.

:- dynamic
    indexed/1,
    used/1.
:- volatile
    indexed/1,
    used/1.

%!  pack_folder(-Folder) is det.

pack_folder(Pack) :-
    module_property(ev3dev_compiled, file(File)),
    file_directory_name(File, Room),
    file_directory_name(Room, Private),
    file_directory_name(Private, Ev3dev),
    file_directory_name(Ev3dev, Prolog),
    file_directory_name(Prolog, Pack).

%!  index_file(-File) is det.
%
%   File is where the index for this Prolog is or would be. Several Prologs
%   can share a pack.

index_file(File) :-
    pack_folder(Pack),
    current_prolog_flag(version, Version),
    current_prolog_flag(arch, Arch),
    atomic_list_concat([Pack, '/compiled/', Version, -, Arch, '/index'],
                       File).

%!  this_prolog(-Prolog) is det.
%
%   Prolog is a term that is another one for any other Prolog: of the same
%   version, too, if it was built at another time, and of the same build as
%   `swipl --traditional`.

this_prolog(prolog(Version, Built, Home, Traditional)) :-
    current_prolog_flag(version, Version),
    current_prolog_flag(compiled_at, Built),
    current_prolog_flag(home, Home),
    (   current_prolog_flag(traditional, Traditional)
    ->  true
    ;   Traditional = false
    ).

%!  source_time(+File, -Milliseconds) is det.

source_time(File, Milliseconds) :-
    time_file(File, Seconds),
    Milliseconds is truncate(Seconds*1000).

%!  contents(+File, -Sum) is det.
%
%   Sum is the same for the same contents. To look at a whole file takes an
%   eighth of the time that it takes to read it.

contents(File, Length-Hash) :-
    size_file(File, Length),
    setup_call_cleanup(
        open(File, read, In, [encoding(octet)]),
        peek_string(In, Length, Text),
        close(In)),
    string_length(Text, Length),
    term_hash(Text, Hash).

% ---------------- THE INDEX

%   Comments are collected from sources alone (library(pldoc)).

use_compiled :-
    \+ current_prolog_flag(pldoc_collecting, true),
    index_file(File),
    exists_file(File),
    catch(read_index(File, Index), error(_, _), fail),
    this_prolog(Prolog),
    pack_folder(Pack),
    has_library(Pack),
    Index = index(Prolog, Pack, Units),
    Units = [unit(Loader, Sum, _, [source(units, Source, Time)])|_],
    catch(( source_time(Source, Time), contents(Loader, Sum) ),
          error(_, _), fail),
    !,
    assertz(indexed(Units)),
    load_files(user:Loader, [if(not_loaded), imports([])]).
use_compiled.

%   Without a foreign library the sources say so (no_library.pl).

has_library(Pack) :-
    (   Name = lib
    ;   Name = native
    ),
    atomic_list_concat([Pack, /, Name], Folder),
    exists_directory(Folder),
    !.

%!  read_index(+File, -Index) is semidet.

read_index(File, Index) :-
    setup_call_cleanup(
        open(File, read, In, [encoding(utf8)]),
        read_term(In, Index, []),
        close(In)).

% ---------------- DESCRIPTORS

%   While a file is loaded, up to five others are open within it.

can_load(0) :-
    !.
can_load(Files) :-
    module_property(ev3dev_compiled, file(This)),
    catch(setup_call_cleanup(open(This, read, In),
                             ( Rest is Files-1, can_load(Rest) ),
                             close(In)),
          error(resource_error(_), _), fail).

too_few_files :-
    module_property(ev3dev_compiled, file(This)),
    file_directory_name(This, Room),
    atom_concat(Room, '/no_library', File),
    load_files(File, [if(not_loaded), imports([])]),
    ev3dev_no_library:without_library(
        error(resource_error(max_files),
              context(_, 'it loads where a program may open 64 files or \c
                          more: ulimit -n 64'))).

:- ( can_load(5) -> use_compiled ; too_few_files ).
