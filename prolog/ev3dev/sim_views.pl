:- module(ev3dev_sim_views,
          [ sim_pose/3,                 % -X, -Y, -Heading
            sim_collisions/1,           % -Collisions
            sim_trace/1,                % -Trace
            sim_svg/1,                  % +File
            sim_mount/1,                % +Directory
            sim_mount/2,                % +Directory, +DevDirectory
            sim_unmount/0
          ]).
:- set_prolog_flag(generate_debug_info, false).
:- use_module(private/errors, [term_expansion/2]).
:- use_module(library(lists), [member/2]).
:- use_module(driver, []).
:- use_module(private/directory, [file_path/2]).
:- use_module(private/native,
              [ sim_collisions_/1, sim_mount_/2, sim_pose_/3, sim_svg_/1,
                sim_trace_/1, sim_unmount_/0 ]).

/** <module> What a simulation shows

The part of library(ev3dev/sim) that tells what happens in the world, and
shows the simulated files to other programs. All fail if no simulation runs.
*/

%!  sim_pose(-X, -Y, -Heading) is semidet.
%
%   True if that is where the robot is and where it looks, really. Heading is
%   how far it has turned in all, and not reduced to a full circle.

sim_pose(X, Y, Heading) :-
    sim_pose_(X, Y, Heading).

%!  sim_collisions(-Collisions) is semidet.
%
%   True if Collisions is the list of `collision(Time, X, Y, Heading)` for
%   each time the robot ran into something, oldest first; the latest 256.

sim_collisions(Collisions) :-
    sim_collisions_(Collisions).

%!  sim_trace(-Trace) is semidet.
%
%   True if Trace is what happened, as a list of Time-Event in the order of
%   time. Event is one of
%
%     - pose(X, Y, Heading)
%       The robot was there. On long runs these are farther apart.
%     - written(File, Text)
%     - read(File, Text)
%       The program wrote a file, or read a value of a sensor.
%     - tone(Hertz)
%       The speaker made a tone; 0 is the end of it.
%     - said(Text)
%     - played(File)
%     - silenced
%       The program said something, played a recording, or ended one.
%     - pressed(Key)
%     - released(Key)
%       Somebody pressed a key, or let go of it.
%
%   The latest 4096 are kept of what was read, and of all the others.

sim_trace(Trace) :-
    sim_trace_(Trace0),
    findall(Time-Event, member(at(Time, Event), Trace0), Trace).

%!  sim_svg(+File) is semidet.
%
%   Write a picture of the world, the robot and its way to a file, as SVG.

sim_svg(File) :-
    sim_svg_(Text),
    setup_call_cleanup(
        open(File, write, Stream, [encoding(utf8)]),
        write(Stream, Text),
        close(Stream)).

%!  sim_mount(+Directory) is semidet.
%!  sim_mount(+Directory, +DevDirectory) is semidet.
%
%   Show the simulated files in a directory, through FUSE, so that programs in
%   any language can use them; until sim_unmount/0, or until Prolog halts.
%   Directory becomes what `/sys/class` is on a brick, and DevDirectory what
%   `/dev` is, with the screen `fb0` and the event devices:
%
%   ```
%   input/by-path/platform-gpio_keys-event
%   input/by-path/platform-sound-event
%   ```
%
%   They are regular files, which answer poll(2) and the ioctls that ask about
%   an event device. That they are no devices means that the screen cannot be
%   mapped into memory, and that who looks for devices only finds none.
%
%   @error existence_error(directory, Directory)
%   @error existence_error(device, '/dev/fuse') if this machine has no FUSE
%   @error existence_error(feature, fuse) if the pack was built without

sim_mount(Directory) :-
    file_path(Directory, Path),
    sim_mount_(Path, _).

sim_mount(Directory, DevDirectory) :-
    file_path(Directory, Path),
    file_path(DevDirectory, DevPath),
    sim_mount_(Path, DevPath).

%!  sim_unmount is semidet.
%
%   End what sim_mount/1 began. Fails if nothing is mounted.

sim_unmount :-
    sim_unmount_.

:- initialization(at_halt(unmount_at_halt), now).

unmount_at_halt :-
    (   predicate_property(sim_unmount_, foreign)
    ->  ignore(sim_unmount_)
    ;   true
    ).
