:- module(ev3dev_units,
          [ use_sources/0
          ]).
:- use_module(compiled,
              [contents/2, indexed/1, source_time/2, used/1]).

/** <module> Loads the units of the index

compiled.pl loads this file, compiled, if there is an index.
*/

:- dynamic usable/4.                    % Unit, Sum, Needed, Sources
:- volatile usable/4.
:- thread_local
    loading/1.                          % Unit

%   From now on load the units of the index, unless a source has changed.

use_units :-
    retract(indexed(Units)),
    catch(unchanged(Units), error(_, _), fail),
    !,
    offer(Units).
use_units.

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
    retractall(usable(_Unit, _, _, _)).

% ---------------- LOADING

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

:- use_units.

%   Last: another thread may call it as soon as it is there.

:- multifile user:prolog_load_file/2.
:- dynamic user:prolog_load_file/2.

user:prolog_load_file(_:Spec, _) :-
    ev3dev_units:load_unit_of(Spec),
    fail.
