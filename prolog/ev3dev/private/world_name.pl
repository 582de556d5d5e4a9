:- module(ev3dev_world_name,
          [ note_world/2,               % +World, +Options
            noted_world/2,              % -World, -Options
            world_name/1,               % -Name
            name_world/1                % +Name
          ]).

/** <module> What the simulation began with

Only the pages of library(ev3dev/view) ask: for the name of the world, and to
begin it again.
*/

%!  noted_world(-World, -Options) is semidet.
%
%   The last simulation was started by sim_start(World, Options).

%!  world_name(-Name) is semidet.
%
%   The world that was last simulated is called Name, an atom.

:- dynamic
    noted_world/2,
    world_name/1.
:- volatile
    noted_world/2,
    world_name/1.

%!  note_world(+World, +Options) is det.
%
%   A simulation of World has started: the name of a world, a file, or a list
%   of facts, which has no name.

note_world(World, Options) :-
    retractall(noted_world(_, _)),
    assertz(noted_world(World, Options)),
    retractall(world_name(_)),
    (   ( atom(World) ; string(World) )
    ->  file_base_name(World, File),
        file_name_extension(Name, _, File),
        assertz(world_name(Name))
    ;   true
    ).

%!  name_world(+Name) is det.
%
%   The world that is simulated is called Name, though it is a list of facts.

name_world(Name) :-
    retractall(world_name(_)),
    assertz(world_name(Name)).
