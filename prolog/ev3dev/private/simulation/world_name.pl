:- module(ev3dev_world_name,
          [ note_world/2,               % +World, +Options
            noted_world/2,              % -World, -Options
            world_name/1,               % -Name
            name_world/1                % +Name
          ]).
:- use_module('../run/brick', [brick/1, of_brick/1]).

/** <module> The world and the robot with which a simulation began

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
    noted/3,                            % Brick, World, Options
    name/2.                             % Brick, Name
:- volatile
    noted/3,
    name/2.
:- of_brick([noted/3, name/2]).

noted_world(World, Options) :-
    brick(Brick),
    noted(Brick, World, Options).

world_name(Name) :-
    brick(Brick),
    name(Brick, Name).

%!  note_world(+World, +Options) is det.
%
%   A simulation of World has started: the name of a world, a file, or a list
%   of facts, which has no name.

note_world(World, Options) :-
    brick(Brick),
    forall(ev3dev_brick:other_world(Brick), true),
    retractall(noted(Brick, _, _)),
    assertz(noted(Brick, World, Options)),
    retractall(name(Brick, _)),
    (   ( atom(World) ; string(World) )
    ->  file_base_name(World, File),
        file_name_extension(Name, _, File),
        assertz(name(Brick, Name))
    ;   true
    ).

%!  name_world(+Name) is det.
%
%   The world that is simulated is called Name, though it is a list of facts.

name_world(Name) :-
    brick(Brick),
    retractall(name(Brick, _)),
    assertz(name(Brick, Name)).
