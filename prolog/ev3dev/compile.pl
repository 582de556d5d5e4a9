:- module(ev3dev_compile,
          [ ev3dev_compile/0
          ]).
:- set_prolog_flag(generate_debug_info, false).
:- use_module(private/load/compiled,
              [ contents/2, index_file/1, pack_folder/1, read_index/2,
                source_time/2, this_prolog/1 ]).
:- use_module(private/load/units, [use_sources/0]).

/** <module> Compile the pack where it is installed

library(ev3dev) loads several times as fast after

```
swipl -g "use_module(library(ev3dev/compile)),ev3dev_compile" -t halt
```

The compiled files are only for the Prolog that made them. After an upgrade of
Prolog or of the pack they are not used; give the command again.
*/

:- dynamic
    compiling/0,
    source_of/2,                        % File, Unit
    needed/1,                           % unit(Unit) or source(File)
    wanted/1.                           % File
:- volatile
    compiling/0,
    source_of/2,
    needed/1,
    wanted/1.

%!  unit(?Name, ?Entries) is nondet.
%
%   A unit has what its Entries load and no unit before it has. The first is
%   what library(ev3dev) loads. A library that a program may load first is a
%   unit apart from what it loads: Prolog is reading its source already when
%   it comes to know the units.

unit(core, ['ev3dev/private/load/core']).
unit(drive_parts, ['ev3dev/private/checks/places', 'ev3dev/odometry',
                   'ev3dev/calibrate']).
unit(drive, ['ev3dev/drive']).
unit(tables, ['ev3dev/private/devices/sensor_table']).
unit(facts, ['ev3dev/private/files/facts']).
unit(planners_parts, ['ev3dev/private/grid/problem',
                      'ev3dev/private/grid/policy',
                      'ev3dev/planners/search']).
unit(grid_parts, ['ev3dev/private/grid/moves']).
unit(grid, ['ev3dev/grid']).
unit(comparison, ['ev3dev/planners/comparison']).
unit(planners, ['ev3dev/planners']).
unit(roadmap_parts, ['ev3dev/navigation']).
unit(roadmap, ['ev3dev/roadmap']).
unit(random_seed, ['ev3dev/private/simulation/random_seed']).
unit(sim_parts, ['ev3dev/private/simulation/turn_order',
                 'ev3dev/private/simulation/world_name',
                 'ev3dev/sim_time', 'ev3dev/sim_views']).
unit(sim, ['ev3dev/sim']).
unit(sim_batch, ['ev3dev/private/batch/pool', 'ev3dev/sim_batch']).
unit(grid_belief, ['ev3dev/grid_belief']).
unit(events, ['ev3dev/events']).
unit(localize, ['ev3dev/localize']).
unit(map, ['ev3dev/map']).
unit(sim_fenced, ['ev3dev/sim_fenced']).
unit(random_worlds, ['ev3dev/random_worlds']).
unit(exercise, ['ev3dev/exercise']).
unit(batch_machines, ['ev3dev/private/batch/machines']).
unit(mail, ['ev3dev/private/bricks/mail']).
unit(bricks, ['ev3dev/bricks']).
unit(far, ['ev3dev/private/bricks/far']).
unit(worker, ['ev3dev/worker']).
unit(console, ['ev3dev/console']).
unit(jog, ['ev3dev/jog']).
unit(gripper, ['ev3dev/gripper']).
unit(colors, ['ev3dev/colors']).
unit(raw, ['ev3dev/raw']).
unit(rules, ['ev3dev/rules']).
unit(layers, ['ev3dev/layers']).
unit(plnxt, ['ev3dev/plnxt']).
unit(golog, ['ev3dev/golog']).
unit(golog_classic, ['ev3dev/golog_classic']).
unit(pddl, ['ev3dev/pddl']).
unit(journal, ['ev3dev/journal']).
unit(reasoning, ['ev3dev/reasoning']).
unit(view, ['ev3dev/view']).

pack_file(Name, File) :-
    pack_folder(Pack),
    atomic_list_concat([Pack, /, prolog, /, Name], File).

in_pack(File) :-
    pack_file('', Prolog),
    sub_atom(File, 0, _, _, Prolog).

in_prolog(File) :-
    current_prolog_flag(home, Home),
    atom_concat(Home, /, Prefix),
    sub_atom(File, 0, _, _, Prefix).

%!  ev3dev_compile is det.
%
%   Compile the libraries for this Prolog, into the pack's own folder. Waits,
%   a few seconds on a brick. Nothing of the pack may be loaded before.
%
%   @error permission_error(compile, library, ev3dev) if library(ev3dev) is
%          loaded
%   @error permission_error(create, directory, Folder) or the like if the
%          pack's folder cannot be written

ev3dev_compile :-
    must_be_unloaded,
    use_sources,
    index_file(Index),
    file_directory_name(Index, Folder),
    new_folder(Folder, New),
    catch(compile_into(New, Index), Error,
          ( catch(delete_folder(New), error(_, _), true),
            throw(Error)
          )).

compile_into(New, Index) :-
    setup_call_cleanup(
        assertz(compiling),
        units_compiled(New, Units),
        ( retractall(compiling), retractall(source_of(_, _)) )),
    this_prolog(Prolog),
    pack_folder(Pack),
    replace_index(Index, New, index(Prolog, Pack, Units)).

must_be_unloaded :-
    (   current_module(ev3dev_errors)
    ->  throw(error(permission_error(compile, library, ev3dev),
                    context(ev3dev_compile/0,
                            'library(ev3dev) is loaded: start swipl again')))
    ;   true
    ).

new_folder(Folder, New) :-
    current_prolog_flag(pid, Pid),
    get_time(Now),
    Stamp is truncate(Now*1000),
    atomic_list_concat([Folder, /, Stamp, -, Pid], New),
    file_directory_name(Folder, Compiled),
    ensure_folder(Compiled),
    ensure_folder(Folder),
    make_directory(New).

%   Another process may make it at the same time.

ensure_folder(Folder) :-
    (   exists_directory(Folder)
    ->  true
    ;   catch(make_directory(Folder), Error, true),
        (   exists_directory(Folder)
        ->  true
        ;   throw(Error)
        )
    ).

%   The index is replaced at once; what the old one names is of no use then.

replace_index(Index, New, Term) :-
    (   catch(old_folder(Index, Old), error(_, _), fail)
    ->  true
    ;   Old = none
    ),
    atom_concat(New, '/index', Written),
    setup_call_cleanup(
        open(Written, write, Out, [encoding(utf8)]),
        format(Out, '~q.~n', [Term]),
        close(Out)),
    rename_file(Written, Index),
    (   Old \== none
    ->  catch(delete_folder(Old), error(_, _), true)
    ;   true
    ).

old_folder(Index, Old) :-
    exists_file(Index),
    read_index(Index, index(_, _, [unit(Unit, _, _, _)|_])),
    file_directory_name(Unit, Old),
    file_directory_name(Index, Folder),
    file_directory_name(Old, Folder).

delete_folder(Folder) :-
    directory_files(Folder, Names),
    forall(( '$member'(Name, Names), \+ '$member'(Name, ['.', '..']) ),
           ( atomic_list_concat([Folder, /, Name], File),
             delete_file(File)
           )),
    delete_directory(Folder).

% ---------------- THE UNITS

units_compiled(Folder, [Loader|Units]) :-
    forall(( source_file(File), in_pack(File) ),
           assertz(source_of(File, none))),
    findall(Name-Files,
            ( unit(Name, Entries), entry_files(Entries, Files) ),
            Plan),
    compile_loader(Folder, Loader),
    compile_units(Plan, Folder, Units, Libraries),
    compile_libraries([], Folder, Libraries).

entry_files([], []).
entry_files([Entry|Entries], [File|Files]) :-
    pack_file(Entry, File),
    entry_files(Entries, Files).

%   The first of them loads the others. Its file is loaded here already.

compile_loader(Folder, Unit) :-
    pack_file('ev3dev/private/load/units', Base),
    atom_concat(Base, '.pl', File),
    retractall(needed(_)),
    compile(units, [File], true, Folder, Qlf),
    unit_term(Qlf, [File], Unit).

compile_units([], _, Units, Units).
compile_units([Name-Files|Plan], Folder, [Unit|Units], Rest) :-
    retractall(needed(_)),
    compile(Name, Files, not_loaded, Folder, Qlf),
    findall(File,
            ( source_file(File), in_pack(File),
              \+ source_of(File, _)
            ),
            Sources),
    forall('$member'(File, Sources), assertz(source_of(File, Qlf))),
    unit_term(Qlf, Sources, Unit),
    compile_units(Plan, Folder, Units, Rest).

%   Each library of Prolog's own that the pack loads is a unit by itself. It
%   may be loaded here already.

compile_libraries(Done, Folder, Units) :-
    (   wanted(File),
        \+ memberchk(File, Done)
    ->  retractall(needed(_)),
        length(Done, N),
        atom_concat(library, N, Name),
        compile(Name, [File], true, Folder, Qlf),
        unit_term(Qlf, [File], Unit),
        Units = [Unit|Rest],
        compile_libraries([File|Done], Folder, Rest)
    ;   Units = []
    ).

unit_term(Qlf, Files, unit(Qlf, Sum, Needed, Sources)) :-
    contents(Qlf, Sum),
    findall(Need, needed(Need), Needed),
    findall(source(Name, File, Time),
            ( '$member'(File, Files),
              file_base_name(File, Base),
              file_name_extension(Name, _, Base),
              source_time(File, Time)
            ),
            Sources).

%   By way of a file that loads all of the unit's. Its module has another name
%   each time: the loader of the last time may be loaded.

compile(Name, Files, If, Folder, Qlf) :-
    atomic_list_concat([Folder, /, Name], Base),
    atom_concat(Base, '.pl', Source),
    atom_concat(Base, '.qlf', Qlf),
    file_base_name(Folder, Time),
    atomic_list_concat([ev3dev_unit_, Name, '_', Time], Module),
    setup_call_cleanup(
        open(Source, write, Out, [encoding(utf8)]),
        ( format(Out, ':- module(~q, []).~n', [Module]),
          format(Out, ':- set_prolog_flag(~q, ~q).~n',
                 [generate_debug_info, false]),
          forall('$member'(File, Files),
                 format(Out, ':- load_files(~q, ~q).~n',
                        [File, [qcompile(part), if(If), imports([])]]))
        ),
        close(Out)),
    qcompile(Source).

%   What the files of a unit load becomes part of it, too. What is loaded
%   already is needed by it, and the unit has only the imports.

:- multifile user:term_expansion/2.
:- dynamic user:term_expansion/2.

user:term_expansion((:- Directive), (:- load_files(Spec, Options))) :-
    ev3dev_compile:part_of_unit(Directive, Spec, Options).

part_of_unit(Directive, Spec, [qcompile(part)|Options]) :-
    compiling,
    load_directive(Directive, Spec, Options),
    resolved(Spec, File),
    (   in_pack(File)
    ->  (   source_of(File, Unit),
            Unit \== none
        ->  note_needed(unit(Unit))
        ;   true
        )
    ;   in_prolog(File),
        source_file(File),
        note_needed(source(File))
    ).

note_needed(Needed) :-
    (   needed(Needed)
    ->  true
    ;   assertz(needed(Needed))
    ).

load_directive(use_module(Spec), Spec,
               [if(not_loaded), must_be_module(true)]).
load_directive(use_module(Spec, Imports), Spec,
               [if(not_loaded), must_be_module(true), imports(Imports)]).
load_directive(reexport(Spec), Spec,
               [if(not_loaded), must_be_module(true), reexport(true)]).
load_directive(reexport(Spec, Imports), Spec,
               [ if(not_loaded), must_be_module(true), imports(Imports),
                 reexport(true) ]).

resolved(Spec, File) :-
    absolute_file_name(Spec, File,
                       [file_type(prolog), access(read), file_errors(fail)]).

:- multifile user:prolog_load_file/2.
:- dynamic user:prolog_load_file/2.

user:prolog_load_file(_:Spec, _) :-
    ev3dev_compile:want_library(Spec),
    fail.

want_library(Spec) :-
    compiling,
    resolved(Spec, File),
    in_prolog(File),
    \+ wanted(File),
    assertz(wanted(File)).
