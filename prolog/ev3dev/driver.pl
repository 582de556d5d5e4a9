:- module(ev3dev_driver,
          [ subsystem_detect/4,         % ?Port, ?Type, ?Path, +Pattern
            file_read/2,                % +File, -Value
            file_write/2,               % +File, +Value
            tacho_motor/1,              % ?Port
            tacho_motor/2,              % ?Port, ?Type
            tacho_motor/3,              % ?Port, ?Type, ?Path
            ev3_large_motor/1,          % ?Port
            ev3_medium_motor/1,         % ?Port
            nxt_motor/1,                % ?Port
            dc_motor/1,                 % ?Port
            servo_motor/1,              % ?Port
            lego_sensor/1,              % ?Port
            lego_sensor/2,              % ?Port, ?Type
            lego_sensor/3,              % ?Port, ?Type, ?Path
            motor_attribute/3,          % ?Port, +Attribute, ?Value
            sensor_attribute/3,         % ?Port, +Attribute, ?Value
            command/2,                  % +Port, +Command
            command_file/2,             % ?Port, -File
            speed/2,                    % ?Port, ?CountsPerSecond
            speed_file/2,               % ?Port, -File
            speed_sp/2,                 % ?Port, ?CountsPerSecond
            speed_sp_file/2,            % ?Port, -File
            max_speed/2,                % ?Port, ?CountsPerSecond
            max_speed_file/2,           % ?Port, -File
            position/2,                 % ?Port, ?Counts
            position_file/2,            % ?Port, -File
            position_sp/2,              % ?Port, ?Counts
            position_sp_file/2,         % ?Port, -File
            state/2,                    % ?Port, ?State
            state_file/2,               % ?Port, -File
            motor_states/2,             % ?Port, ?States
            mode/2,                     % ?Port, ?Mode
            mode_file/2,                % ?Port, -File
            value/3,                    % ?Port, +Index, ?Value
            value_file/3,               % ?Port, +Index, -File
            decimals/2,                 % ?Port, ?Decimals
            decimals_file/2,            % ?Port, -File
            ev3_sysfs/1,                % ?Directory
            ev3_devices/0
          ]).
:- use_module(library(error),
              [ domain_error/2, existence_error/2, must_be/2 ]).
:- use_module(library(lists), [member/2]).
:- use_module(library_file, [load_library/0]).

:- load_library.

/** <module> Driver framework: devices and their files

ev3dev shows each motor and sensor as a directory of attribute files. The
predicates here are the paper's first layer: they find devices by port and
read and write their attributes, one read or write each.

An attribute is read when the value is unbound. Where the kernel lets one
write it, it is written when the value is bound:

```
?- position(outB, P).           % read
?- position(outB, 0).           % write: this is the new zero
```

An unbound port enumerates the devices in the order of their ports; writing
needs a bound one.

@see http://www.ev3dev.org for each driver's attributes
*/

                /*******************************
                *            FILES             *
                *******************************/

%!  subsystem_detect(?Port, ?Type, ?Path, +Pattern) is nondet.
%
%   True if a device of Type is plugged into Port, and its directory Path
%   matches the file name Pattern, as in
%
%   ```
%   ?- subsystem_detect(Port, Type, Path, '/sys/class/tacho-motor/motor*').
%   ```
%
%   Pattern may hold `*`, `?`, `[abc]` and `**`. What is below `/sys/class`
%   is looked for in the tree in use, see ev3_sysfs/1. Each match is looked
%   at anew: for motors and sensors, tacho_motor/3 and lego_sensor/3 are much
%   faster. Directories that hold no device are passed over.
%
%   @error instantiation_error if Pattern is unbound
%   @error domain_error(file_name_pattern, Pattern)

%!  file_read(+File, -Value) is semidet.
%
%   Read an attribute file. Value is a number if the text is one, else an
%   atom. Fails if Value is bound to something else. The newline that ends
%   the text is not part of it.
%
%   @error existence_error(file, File)
%   @error permission_error(read, attribute, File)
%   @error syntax_error(attribute) if File holds no text, or more than the
%          4096 bytes that an attribute may have

%!  file_write(+File, +Value) is det.
%
%   Write an atom, string or number to an attribute file, which must exist.
%
%   @error existence_error(file, File)
%   @error permission_error(write, attribute, File)
%   @error domain_error(Attribute, Value) if the device does not accept it

                /*******************************
                *           DEVICES            *
                *******************************/

%!  tacho_motor(?Port) is nondet.
%!  tacho_motor(?Port, ?Type) is nondet.
%!  tacho_motor(?Port, ?Type, ?Path) is nondet.
%
%   True if a motor with rotation sensor of Type, e.g. `lego-ev3-l-motor`, is
%   plugged into Port. Path is its directory. Fails if there is none.

tacho_motor(Port) :-
    device_('tacho-motor', Port, _, _).

tacho_motor(Port, Type) :-
    device_('tacho-motor', Port, Type, _).

tacho_motor(Port, Type, Path) :-
    device_('tacho-motor', Port, Type, Path).

%!  ev3_large_motor(?Port) is nondet.
%!  ev3_medium_motor(?Port) is nondet.
%!  nxt_motor(?Port) is nondet.
%
%   True if a motor of that kind is plugged into Port. An EV3 takes NXT motors
%   for large motors unless it is told otherwise.

ev3_large_motor(Port) :-
    tacho_motor(Port, 'lego-ev3-l-motor').

ev3_medium_motor(Port) :-
    tacho_motor(Port, 'lego-ev3-m-motor').

nxt_motor(Port) :-
    tacho_motor(Port, 'lego-nxt-motor').

%!  dc_motor(?Port) is nondet.
%
%   True if Port is one for a motor without rotation sensor, as
%   port_mode(Port, 'dc-motor') makes it. See library(ev3dev/dc_motors).

dc_motor(Port) :-
    device_('dc-motor', Port, _, _).

%!  servo_motor(?Port) is nondet.
%
%   True if an RC servo is connected to Port, through a servo controller. See
%   library(ev3dev/servo_motors).

servo_motor(Port) :-
    device_('servo-motor', Port, _, _).

%!  lego_sensor(?Port) is nondet.
%!  lego_sensor(?Port, ?Type) is nondet.
%!  lego_sensor(?Port, ?Type, ?Path) is nondet.
%
%   True if a sensor of Type, e.g. `lego-ev3-us`, is plugged into Port. Path
%   is its directory. Fails if there is none.

lego_sensor(Port) :-
    device_('lego-sensor', Port, _, _).

lego_sensor(Port, Type) :-
    device_('lego-sensor', Port, Type, _).

lego_sensor(Port, Type, Path) :-
    device_('lego-sensor', Port, Type, Path).

                /*******************************
                *          ATTRIBUTES          *
                *******************************/

%!  motor_attribute(?Port, +Attribute, ?Value) is nondet.
%!  sensor_attribute(?Port, +Attribute, ?Value) is nondet.
%
%   Read any attribute of a motor or sensor if Value is unbound, else write
%   it. Attribute is a file name, as in `stop_action`, `'speed_pid/Kp'`,
%   `num_values`. Value is a number if the text is one, else an atom. Writing
%   a sensor's `mode` that it is in already does nothing.
%
%   Fails if there is no device at Port. On backtracking, reads at the next
%   port if Port is unbound.
%
%   @error existence_error(file, File) if the device has no such attribute
%   @error permission_error(Access, attribute, File) if it cannot be read, or
%          not be written
%   @error domain_error(Attribute, Value) if the device does not accept it
%   @error instantiation_error if Attribute is unbound, or Port and Value is
%          to be written

motor_attribute(Port, Attribute, Value) :-
    attribute('tacho-motor', Port, Attribute, Value).

sensor_attribute(Port, Attribute, Value) :-
    attribute('lego-sensor', Port, Attribute, Value).

attribute(Class, Port, Attribute, Value) :-
    var(Value),
    !,
    attribute_(Class, Port, Attribute, Value).
attribute(Class, Port, Attribute, Value) :-
    attribute_write_(Class, Port, Attribute, Value).

attribute_file(Class, Port, Attribute, File) :-
    device_(Class, Port, _, Path),
    atomic_list_concat([Path, Attribute], /, File).

%!  command(+Port, +Command) is semidet.
%
%   Give a motor one of its commands: `run-forever`, `run-to-abs-pos`,
%   `run-to-rel-pos`, `run-timed`, `run-direct`, `stop`, `reset`. Does not
%   wait. Fails if there is no motor at Port.
%
%   @error domain_error(command, Command)

command(Port, Command) :-
    must_be(nonvar, Command),
    attribute_write_('tacho-motor', Port, command, Command).

%!  speed(?Port, ?CountsPerSecond) is nondet.
%
%   True if the motor turns at that speed now. A motor that stops shows 0
%   only some 200 ms later.

speed(Port, CountsPerSecond) :-
    attribute_('tacho-motor', Port, speed, CountsPerSecond).

%!  speed_sp(?Port, ?CountsPerSecond) is nondet.
%
%   Read or write the speed for the next command, from -max_speed to
%   max_speed.
%
%   @error domain_error(speed_sp, CountsPerSecond)

speed_sp(Port, CountsPerSecond) :-
    motor_attribute(Port, speed_sp, CountsPerSecond).

%!  max_speed(?Port, ?CountsPerSecond) is nondet.
%
%   True if that is the highest speed that the motor accepts.

max_speed(Port, CountsPerSecond) :-
    attribute_('tacho-motor', Port, max_speed, CountsPerSecond).

%!  position(?Port, ?Counts) is nondet.
%
%   Read the motor's position, or write what its present position is called
%   from now on. LEGO's motors have one count a degree.

position(Port, Counts) :-
    motor_attribute(Port, position, Counts).

%!  position_sp(?Port, ?Counts) is nondet.
%
%   Read or write the position, or distance, for the next command.

position_sp(Port, Counts) :-
    motor_attribute(Port, position_sp, Counts).

%!  state(?Port, ?State) is nondet.
%
%   True if State is the text of the motor's state: the atom of its flags with
%   spaces between, `''` if it rests.

state(Port, State) :-
    attribute_('tacho-motor', Port, state, State).

%!  motor_states(?Port, ?States) is nondet.
%
%   True if States is the list of the motor's flags, in this order: `running`,
%   `ramping`, `holding`, `overloaded`, `stalled`.

motor_states(Port, States) :-
    state(Port, State),
    (   State == ''
    ->  States = []
    ;   atomic_list_concat(States0, ' ', State),
        States = States0
    ).

%!  mode(?Port, ?Mode) is nondet.
%
%   Read a sensor's mode, or put it into another one and wait until its values
%   are settled: 10 ms, with the infrared sensor 1.1 s. Does nothing if the
%   sensor is in that mode.
%
%   @error domain_error(mode, Mode)

mode(Port, Mode) :-
    sensor_attribute(Port, mode, Mode).

%!  value(?Port, +Index, ?Value) is nondet.
%
%   True if the sensor's file `value<Index>` holds Value: an integer, to be
%   divided by 10 to the power of decimals/2.
%
%   @error domain_error(sensor_value_index, Index) if the present mode has no
%          such value

value(Port, Index, Value) :-
    value_attribute(Index, Attribute),
    attribute_('lego-sensor', Port, Attribute, Value).

value_attribute(Index, Attribute) :-
    must_be(nonneg, Index),
    (   Index < 8
    ->  atom_concat(value, Index, Attribute)
    ;   domain_error(sensor_value_index, Index)
    ).

%!  decimals(?Port, ?Decimals) is nondet.
%
%   True if the sensor's values in its present mode have that many decimals.

decimals(Port, Decimals) :-
    attribute_('lego-sensor', Port, decimals, Decimals).

%!  command_file(?Port, -File) is nondet.
%!  speed_file(?Port, -File) is nondet.
%!  speed_sp_file(?Port, -File) is nondet.
%!  max_speed_file(?Port, -File) is nondet.
%!  position_file(?Port, -File) is nondet.
%!  position_sp_file(?Port, -File) is nondet.
%!  state_file(?Port, -File) is nondet.
%!  mode_file(?Port, -File) is nondet.
%!  value_file(?Port, +Index, -File) is nondet.
%!  decimals_file(?Port, -File) is nondet.
%
%   True if File is the attribute's file of the motor or sensor at Port.

command_file(Port, File) :-
    attribute_file('tacho-motor', Port, command, File).

speed_file(Port, File) :-
    attribute_file('tacho-motor', Port, speed, File).

speed_sp_file(Port, File) :-
    attribute_file('tacho-motor', Port, speed_sp, File).

max_speed_file(Port, File) :-
    attribute_file('tacho-motor', Port, max_speed, File).

position_file(Port, File) :-
    attribute_file('tacho-motor', Port, position, File).

position_sp_file(Port, File) :-
    attribute_file('tacho-motor', Port, position_sp, File).

state_file(Port, File) :-
    attribute_file('tacho-motor', Port, state, File).

mode_file(Port, File) :-
    attribute_file('lego-sensor', Port, mode, File).

value_file(Port, Index, File) :-
    value_attribute(Index, Attribute),
    attribute_file('lego-sensor', Port, Attribute, File).

decimals_file(Port, File) :-
    attribute_file('lego-sensor', Port, decimals, File).

                /*******************************
                *           THE TREE           *
                *******************************/

%!  ev3_sysfs(?Directory) is det.
%
%   Query or set the directory that holds the classes of devices. At first it
%   is the value of the environment variable EV3DEV_SYSFS, else `/sys/class`.
%   Setting it stops the motors that the program has started so far, and ends
%   a simulation, unless that is mounted by sim_mount/1.
%
%   On a machine that has no such devices, and where no directory was set, the
%   first use of a device starts the simulator, sim_start/1, with `room`.
%
%   @error existence_error(directory, Directory)

ev3_sysfs(Directory) :-
    var(Directory),
    !,
    sysfs_(Directory).
ev3_sysfs(Directory) :-
    (   absolute_file_name(Directory, Path,
                           [file_type(directory), file_errors(fail)])
    ->  sysfs_use_(Path)
    ;   existence_error(directory, Directory)
    ).

use_environment :-
    (   getenv('EV3DEV_SYSFS', Directory)
    ->  ev3_sysfs(Directory)
    ;   true
    ).

:- use_environment.

%!  choose_tree is det.
%
%   Called by the foreign library at the first use of a device, if no tree was
%   set: the kernel's if it has devices, else a simulated one, if the library
%   has the simulator in it.

:- public choose_tree/0.

choose_tree :-
    with_mutex(ev3dev_tree,
               (   simulator_needless
               ->  true
               ;   simulate
               )).

simulator_needless :-
    member(Class, ['tacho-motor', 'lego-sensor']),
    atom_concat('/sys/class/', Class, Directory),
    exists_directory(Directory),
    !.
simulator_needless :-
    \+ predicate_property(ev3dev_sim:sim_active_, foreign),
    !.
simulator_needless :-
    ev3dev_sim:sim_active_.

simulate :-
    module_property(ev3dev_driver, file(Here)),
    file_directory_name(Here, Directory),
    atom_concat(Directory, '/sim', Simulator),
    load_files(ev3dev_driver:Simulator, [if(not_loaded), imports([])]),
    ev3dev_sim:sim_start(room),
    print_message(informational, ev3dev(simulated(room))).

:- multifile prolog:message//1.

prolog:message(ev3dev(simulated(World))) -->
    [ 'This machine is no EV3: simulating one in the world `~w`. '-[World],
      'See library(ev3dev/sim).'-[]
    ].

%!  ev3_devices is det.
%
%   Print a table of what is connected: port, type, and what a motor or sensor
%   reads at present.

ev3_devices :-
    findall(Row, device_row(Row), Rows),
    (   Rows == []
    ->  sysfs_(Root),
        format("Nothing is connected (looking in ~w).~n", [Root])
    ;   format("~w~t~16|~w~t~38|~w~n", ['Port', 'Type', 'Reads']),
        forall(member(row(Port, Type, Reads), Rows),
               format("~w~t~16|~w~t~38|~w~n", [Port, Type, Reads]))
    ).

device_row(row(Port, Type, Reads)) :-
    lego_sensor(Port, Type),
    reading(sensor_reading(Port), Reads).
device_row(row(Port, Type, Reads)) :-
    tacho_motor(Port, Type),
    reading(motor_reading(Port), Reads).
device_row(row(Port, Type, Reads)) :-
    device_('dc-motor', Port, Type, _),
    reading(dc_motor_reading(Port), Reads).
device_row(row(Port, Type, '')) :-
    device_('servo-motor', Port, Type, _).

% A device that cannot be read now is listed all the same, and says why.
reading(Goal_1, Reads) :-
    catch(call(Goal_1, Reads), Error, unreadable(Error, Reads)),
    !.
reading(_, '-').

unreadable(error(Formal, _), Reads) :-
    format(atom(Reads), "~p", [Formal]).

motor_reading(Port, Reads) :-
    position(Port, Position),
    state(Port, State),
    format(atom(Reads), "position ~w ~w", [Position, State]).

dc_motor_reading(Port, Reads) :-
    attribute_('dc-motor', Port, duty_cycle, Duty),
    attribute_('dc-motor', Port, state, State),
    format(atom(Reads), "duty ~w ~w", [Duty, State]).

sensor_reading(Port, Reads) :-
    mode(Port, Mode),
    sensor_attribute(Port, num_values, Count),
    Last is Count - 1,
    findall(Value,
            ( between(0, Last, Index), scaled_value(Port, Index, Value) ),
            Values),
    atomic_list_concat(Values, ' ', Text),
    format(atom(Reads), "~w ~w", [Mode, Text]).

scaled_value(Port, Index, Value) :-
    value(Port, Index, Raw),
    decimals(Port, Decimals),
    (   Decimals =:= 0
    ->  Value = Raw
    ;   Value is Raw / 10.0 ** Decimals
    ).
