:- module(ev3dev_compiled,
          [ index_file/1,               % -File
            pack_folder/1,              % -Folder
            this_prolog/1,              % -Prolog
            source_time/2,              % +File, -Milliseconds
            contents/2,                 % +File, -Sum
            read_index/2,               % +File, -Index
            use_sources/0
          ]).

/** <module> The libraries as ev3dev_compile/0 has compiled them

To read its sources takes a brick a second; what was compiled loads in a tenth
of that. It comes in units of several files: when one of them is to be loaded,
its unit is, and then Prolog finds that the file is there. Where there is no
unit, Prolog reads the source.

An index names the units. It holds for the Prolog, the folder and the sources
that they were made by: if a source has another time now, or if another Prolog
runs, nothing of it is used. A unit is used only if its file has the contents
that the index says.

This file, and library(ev3dev), are always read. It loads nothing itself.
*/

:- dynamic
    usable/4,                           % Unit, Sum, Needed, Sources
    used/1.                             % Unit
:- volatile
    usable/4,
    used/1.
:- thread_local
    loading/1.                          % Unit

%!  pack_folder(-Folder) is det.

pack_folder(Pack) :-
    module_property(ev3dev_compiled, file(File)),
    file_directory_name(File, Private),
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

                /*******************************
                *          THE INDEX           *
                *******************************/

%   Comments are collected from sources alone (library(pldoc)).

use_compiled :-
    \+ current_prolog_flag(pldoc_collecting, true),
    index_file(File),
    exists_file(File),
    catch(read_index(File, Index), error(_, _), fail),
    this_prolog(Prolog),
    pack_folder(Pack),
    Index = index(Prolog, Pack, Units),
    catch(unchanged(Units), error(_, _), fail),
    !,
    offer(Units).
use_compiled.

%!  read_index(+File, -Index) is semidet.

read_index(File, Index) :-
    setup_call_cleanup(
        open(File, read, In, [encoding(utf8)]),
        read_term(In, Index, []),
        close(In)).

unchanged([]).
unchanged([unit(_, _, _, Sources)|Units]) :-
    sources_unchanged(Sources),
    unchanged(Units).

sources_unchanged([]).
sources_unchanged([source(_, Source, Time)|Sources]) :-
    source_time(Source, Time),
    sources_unchanged(Sources).

%   What was read from its source stays.

offer([]).
offer([unit(Unit, Sum, Needed, Sources)|Units]) :-
    (   one_loaded(Sources)
    ->  true
    ;   assertz(usable(Unit, Sum, Needed, Sources))
    ),
    offer(Units).

one_loaded([source(_, Source, _)|Sources]) :-
    (   source_file(Source)
    ->  true
    ;   one_loaded(Sources)
    ).

%!  use_sources is det.
%
%   Load nothing compiled from now on.

use_sources :-
    retractall(usable(_, _, _, _)).

                /*******************************
                *           LOADING            *
                *******************************/

load_unit_of(Spec) :-
    name_of(Spec, Name),
    unit_with(Name, _, _),
    absolute_file_name(Spec, File,
                       [file_type(prolog), access(read), file_errors(fail)]),
    unit_with(Name, File, Unit),
    load_unit(Unit).

name_of(Spec, Name) :-
    atom(Spec),
    !,
    file_base_name(Spec, Base),
    file_name_extension(Name, _, Base).
name_of(_/Spec, Name) :-
    !,
    name_of(Spec, Name).
name_of(Alias, Name) :-
    compound(Alias),
    arg(1, Alias, Spec),
    name_of(Spec, Name).

unit_with(Name, File, Unit) :-
    usable(Unit, _, _, Sources),
    memberchk(source(Name, File, _), Sources),
    !.

%   If another thread is loading it, load_files/2 waits for the end.

load_unit(Unit) :-
    used(Unit),
    !.
load_unit(Unit) :-
    \+ loading(Unit),
    usable(Unit, Sum, Needed, _),
    setup_call_cleanup(
        asserta(loading(Unit), Ref),
        (   load_needed(Needed),
            catch(contents(Unit, Sum), error(_, _), fail)
        ->  catch(load_files(user:Unit, [if(not_loaded), imports([])]),
                  error(Formal, Context),
                  print_message(warning, error(Formal, Context))),
            assertz(used(Unit))
        ;   true
        ),
        erase(Ref)),
    retractall(usable(Unit, _, _, _)),
    used(Unit).

load_needed([]).
load_needed([Needed|More]) :-
    (   Needed = unit(Unit)
    ->  load_unit(Unit)
    ;   Needed = source(File),
        load_files(user:File, [if(not_loaded), imports([])])
    ),
    load_needed(More).

:- use_compiled.

%   Last: another thread may call it as soon as it is there.

:- multifile user:prolog_load_file/2.
:- dynamic user:prolog_load_file/2.

user:prolog_load_file(_:Spec, _) :-
    ev3dev_compiled:load_unit_of(Spec),
    fail.
