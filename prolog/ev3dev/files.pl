:- module(ev3dev_files,
          [ subsystem_detect/4,         % ?Port, ?Type, ?Path, +Pattern
            file_read/2,                % +File, -Value
            file_write/2,               % +File, +Value
            ev3_sysfs/1,                % ?Directory
            ev3_dev/1                   % ?Directory
          ]).
:- set_prolog_flag(generate_debug_info, false).
:- use_module(private/run/brick, [brick/1, is_apart/1, named_brick/3]).
:- use_module(private/errors/errors, [throw_error/3]).
:- use_module(private/errors/public_clauses, [term_expansion/4]).
:- use_module(private/explain/hints, [tell_again/0]).
:- use_module(private/files/directory,
              [directory_path/2, environment_directory/2]).
:- use_module(private/native/native,
              [ dev_/1, dev_use_/1, file_read_/2, file_write_/2,
                sim_active_/0, sim_fence_join_/1, subsystem_detect_/4,
                sysfs_/1, sysfs_use_/1 ]).

/** <module> Files of devices

Reads and writes any file by its name, and selects the tree of files in use:
that of the brick, another directory of the same shape, or that of the
simulator.
*/

%!  subsystem_detect(?Port, ?Type, ?Path, +Pattern) is nondet.
%
%   True if a device of Type is plugged into Port, and its directory Path
%   matches the file name Pattern, as in
%
%   ```
%   ?- subsystem_detect(Port, Type, Path, '/sys/class/tacho-motor/motor*').
%   ```
%
%   Pattern may contain `*`, `?`, `[abc]` and `**`. A path below `/sys/class`
%   stands for the same path in the tree in use, see ev3_sysfs/1. Each call
%   reads the directories again: for motors and sensors, tacho_motor/3 and
%   lego_sensor/3 are much faster. Skips directories without a device.
%
%   @error instantiation_error if Pattern is unbound
%   @error domain_error(file_name_pattern, Pattern)

subsystem_detect(Port, Type, Path, Pattern) :-
    subsystem_detect_(Port, Type, Path, Pattern).

%!  file_read(+File, -Value) is semidet.
%
%   Read an attribute file. Value is a number if the text is a number, else an
%   atom, without the newline at the end. Fails if Value is bound to something
%   else.
%
%   @error existence_error(file, File)
%   @error permission_error(read, attribute, File)
%   @error syntax_error(attribute) if File holds no text, or more than the
%          4096 bytes that an attribute may have

file_read(File, Value) :-
    file_read_(File, Value).

%!  file_write(+File, +Value) is det.
%
%   Write an atom, string or number to an attribute file, which must exist.
%
%   @error existence_error(file, File)
%   @error permission_error(write, attribute, File)
%   @error domain_error(Attribute, Value) if the device does not accept Value

file_write(File, Value) :-
    file_write_(File, Value).

%!  ev3_sysfs(?Directory) is det.
%
%   Query or set the directory that holds the classes of devices. The initial
%   value is that of the environment variable EV3DEV_SYSFS, if it is set and
%   not empty, else `/sys/class`. A relative directory is relative to the
%   working directory.
%
%   Setting the directory stops the motors that the program has started, and
%   ends a simulation, unless sim_mount/1 has mounted it.
%
%   If the machine has no such devices and no directory was set, the first use
%   of a device starts the simulator with sim_start(room). After sim_stop/0 it
%   does so again.
%
%   @error existence_error(directory, Directory)

ev3_sysfs(Directory) :-
    var(Directory),
    !,
    sysfs_(Directory).
ev3_sysfs(Directory) :-
    directory_path(Directory, Path),
    sysfs_use_(Path),
    tell_again.

%   A program of sim_fenced/3 has its robot by a socket, and its own processes
%   have none.
use_environment :-
    (   getenv('EV3DEV_FENCE', Socket)
    ->  unsetenv('EV3DEV_FENCE'),
        use_module(library(ev3dev/private/simulation/turn_order), []),
        sim_fence_join_(Socket),
        use_told
    ;   environment_directory('EV3DEV_SYSFS', Directory)
    ->  ev3_sysfs(Directory)
    ;   true
    ).

use_told :-
    (   getenv('EV3DEV_TOLD', File)
    ->  unsetenv('EV3DEV_TOLD'),
        use_module(library(ev3dev/private/journal/fenced_log), []),
        ev3dev_fenced_log:tell_to(File)
    ;   true
    ).

:- initialization(use_environment, now).

%!  choose_tree is det.
%
%   The foreign library calls this at the first use of a device if no tree was
%   set. Chooses the kernel's tree if it has devices, else a simulated tree if
%   the library contains the simulator.

:- public choose_tree/0.

choose_tree :-
    brick(Brick),
    (   named_brick(_, Brick, sim)
    ->  Is = simulated
    ;   ( Brick == 0 ; is_apart(Brick) )
    ->  Is = this_machine
    ;   throw_error(existence_error(brick, Brick), _,
                    'the brick that this thread has in use was closed')
    ),
    with_mutex(ev3dev_tree, choose_tree(Is)).

choose_tree(this_machine) :-
    is_ev3,
    !.
choose_tree(_) :-
    (   simulator_needless
    ->  true
    ;   simulate
    ).

is_ev3 :-
    ( Class = 'tacho-motor' ; Class = 'lego-sensor' ),
    atom_concat('/sys/class/', Class, Directory),
    exists_directory(Directory),
    !.

simulator_needless :-
    \+ predicate_property(sim_active_, foreign),
    !.
simulator_needless :-
    sim_active_.

simulate :-
    module_property(ev3dev_files, file(Here)),
    file_directory_name(Here, Directory),
    atom_concat(Directory, '/sim', Simulator),
    load_files(ev3dev_files:Simulator, [if(not_loaded), imports([])]),
    ev3dev_sim:sim_start(room),
    (   brick(0)
    ->  print_message(informational, ev3dev(simulated(room)))
    ;   true                            % brick_open/2 asked for it
    ).

:- multifile prolog:message//1.

prolog:message(ev3dev(simulated(World))) -->
    [ 'This computer is not an EV3: simulating one in the world `~w`. '-
      [World],
      'See library(ev3dev/sim).'-[]
    ].

%!  ev3_dev(?Directory) is det.
%
%   Query or set the directory that holds the device files: `fb0`, the screen,
%   and in `input/by-path` the buttons and the speaker. The initial value is
%   that of the environment variable EV3DEV_DEV, if it is set and not empty,
%   else `/dev`. A relative directory is relative to the working directory.
%   sim_start/1 selects the simulator's own device files.
%
%   The directory may hold a regular file or a named pipe in place of a
%   device. A file for the buttons contains past events; an event happens when
%   it is appended to the file. The length of a file for the screen gives its
%   layout: 3072 bytes for one bit per pixel, 91136 for four bytes per pixel.
%
%   @error existence_error(directory, Directory)
%   @see ev3_sysfs/1 for the files below `/sys/class`

ev3_dev(Directory) :-
    var(Directory),
    !,
    dev_(Directory).
ev3_dev(Directory) :-
    directory_path(Directory, Path),
    dev_use_(Path).

use_dev_environment :-
    (   environment_directory('EV3DEV_DEV', Directory)
    ->  ev3_dev(Directory)
    ;   true
    ).

:- initialization(use_dev_environment, now).
