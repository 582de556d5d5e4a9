:- module(ev3dev_world_name,
          [ note_world/1,               % +World
            world_name/1                % -Name
          ]).

/** <module> What the world of the simulation is called

Only the pages of library(ev3dev/view) ask.
*/

%!  world_name(-Name) is semidet.
%
%   The world that was last simulated is called Name, an atom.

:- dynamic world_name/1.
:- volatile world_name/1.

%!  note_world(+World) is det.
%
%   A simulation of World has started: the name of a world, a file, or a list
%   of facts, which has no name.

note_world(World) :-
    retractall(world_name(_)),
    (   ( atom(World) ; string(World) )
    ->  file_base_name(World, File),
        file_name_extension(Name, _, File),
        assertz(world_name(Name))
    ;   true
    ).
