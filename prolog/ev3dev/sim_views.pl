:- module(ev3dev_sim_views,
          [ sim_pose/3,                 % -X, -Y, -Heading
            sim_where/0,
            sim_collisions/1,           % -Collisions
            sim_thing/4,                % ?Name, -X, -Y, -Heading
            sim_things/1,               % -Things
            sim_held/1,                 % ?Name
            sim_trace/1,                % -Trace
            sim_svg/1,                  % +File
            sim_mount/1,                % +Directory
            sim_mount/2,                % +Directory, +DevDirectory
            sim_unmount/0
          ]).
:- set_prolog_flag(generate_debug_info, false).
:- use_module(private/checks/checks, [must_be/2]).
:- use_module(private/errors/public_clauses, [term_expansion/4]).
:- use_module(library(lists), [member/2]).
:- use_module(private/files/directory, [directory_path/2, write_file/2]).
:- use_module(private/native/native,
              [ sim_collisions_/1, sim_held_/1, sim_mount_/2, sim_pose_/3,
                sim_svg_/1, sim_things_/1, sim_trace_/1, sim_unmount_/0 ]).

/** <module> Views of the simulation

The part of library(ev3dev/sim) that reports events in the world, and shows
the simulated files to other programs. All predicates fail if no simulation
runs.
*/

%!  sim_pose(-X, -Y, -Heading) is semidet.
%
%   True if the robot's true position is X, Y and its true heading is Heading.
%   Heading is the angle that the robot has turned in all; it is not reduced
%   to a full circle.

sim_pose(X, Y, Heading) :-
    sim_pose_(X, Y, Heading).

%!  sim_where is semidet.
%
%   Print the robot's true position in cm and its heading in degrees, rounded.

sim_where :-
    sim_pose_(X, Y, Heading),
    format("The robot is at ~1f, ~1f cm; its heading is ~1f degrees.~n",
           [X, Y, Heading]).

%!  sim_collisions(-Collisions) is semidet.
%
%   True if Collisions is the list of `collision(Time, X, Y, Heading)`, one
%   for each time that the robot ran into an obstacle, oldest first. The
%   simulator keeps the latest 256.

sim_collisions(Collisions) :-
    sim_collisions_(Collisions).

%!  sim_thing(?Name, -X, -Y, -Heading) is nondet.
%!  sim_things(-Things) is semidet.
%
%   True if the thing called Name, which robots can push, is at X, Y, with its
%   Heading; Things is the list of `thing(Name, X, Y, Heading)` of all of
%   them. A thing is a box or circle with a mass, see docs/worlds.md. A thing
%   without a name has the number that sim_add/2 answers. Fails if there is no
%   such thing.

sim_thing(Name, X, Y, Heading) :-
    sim_things_(Things),
    member(thing(Name, X, Y, Heading), Things).

sim_things(Things) :-
    sim_things_(Things).

%!  sim_held(?Name) is nondet.
%
%   True if a gripper of the robot holds the thing called Name, as
%   sim_thing/4 names it.

sim_held(Name) :-
    sim_held_(Names),
    member(Name, Names).

%!  sim_trace(-Trace) is semidet.
%
%   True if Trace is the list of events as pairs Time-Event, in the order of
%   time. Event is one of
%
%     - pose(X, Y, Heading)
%       The pose of the robot. On long runs these are farther apart.
%     - written(File, Text)
%     - read(File, Text)
%       The program wrote a file, or read a value of a sensor.
%     - tone(Hertz)
%       The speaker started a tone; 0 is the end of a tone.
%     - said(Text)
%     - played(File)
%     - silenced
%       The program spoke, played a recording, or ended one.
%     - pressed(Key)
%     - released(Key)
%       Somebody pressed a button, or released it.
%
%   The simulator keeps the latest 4096 events `read`, the latest 4096
%   `written`, and the latest 4096 of all others.

sim_trace(Trace) :-
    sim_trace_(Trace0),
    findall(Time-Event, member(at(Time, Event), Trace0), Trace).

%!  sim_svg(+File) is semidet.
%
%   Write a picture of the world, the robot and its path to an SVG file.

sim_svg(File) :-
    must_be(text, File),
    sim_svg_(Text),
    write_file(File, written(Text)).

written(Text, Stream) :-
    write(Stream, Text).

%!  sim_mount(+Directory) is semidet.
%!  sim_mount(+Directory, +DevDirectory) is semidet.
%
%   Show the simulated files in a directory, through FUSE, until sim_unmount/0
%   or until Prolog halts. Programs in any language can use these files.
%   Directory corresponds to `/sys/class` on a brick, and DevDirectory to
%   `/dev`, with the screen `fb0` and the event devices:
%
%   ```
%   input/by-path/platform-gpio_keys-event
%   input/by-path/platform-sound-event
%   ```
%
%   They are regular files that answer poll(2) and the ioctls that ask about
%   an event device. Because they are not devices, a program cannot map the
%   screen into memory, and a program that looks for device nodes finds none.
%
%   @error existence_error(directory, Directory); the message says so if a
%          program that was killed left its files mounted there
%   @error existence_error(device, '/dev/fuse') if this machine has no FUSE
%   @error existence_error(feature, fuse) if the pack was built without FUSE

sim_mount(Directory) :-
    directory_path(Directory, Path),
    sim_mount_(Path, _).

sim_mount(Directory, DevDirectory) :-
    directory_path(Directory, Path),
    directory_path(DevDirectory, DevPath),
    sim_mount_(Path, DevPath).

%!  sim_unmount is semidet.
%
%   Unmount the files of sim_mount/1,2. Fails if nothing is mounted.

sim_unmount :-
    sim_unmount_.

:- initialization(at_halt(unmount_at_halt), now).

unmount_at_halt :-
    (   predicate_property(sim_unmount_, foreign)
    ->  ignore(sim_unmount_)
    ;   true
    ).
