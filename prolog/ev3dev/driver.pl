:- module(ev3dev_driver,
          [ tacho_motor/1,              % ?Port
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
            speed/2,                    % ?Port, ?CountsPerSecond
            speed_sp/2,                 % ?Port, ?CountsPerSecond
            max_speed/2,                % ?Port, ?CountsPerSecond
            position/2,                 % ?Port, ?Counts
            position_sp/2,              % ?Port, ?Counts
            state/2,                    % ?Port, ?State
            motor_states/2,             % ?Port, ?States
            mode/2,                     % ?Port, ?Mode
            value/3,                    % ?Port, +Index, ?Value
            decimals/2,                 % ?Port, ?Decimals
            command_file/2,             % ?Port, -File
            speed_file/2,               % ?Port, -File
            speed_sp_file/2,            % ?Port, -File
            max_speed_file/2,           % ?Port, -File
            position_file/2,            % ?Port, -File
            position_sp_file/2,         % ?Port, -File
            state_file/2,               % ?Port, -File
            mode_file/2,                % ?Port, -File
            value_file/3,               % ?Port, +Index, -File
            decimals_file/2             % ?Port, -File
          ]).
:- set_prolog_flag(generate_debug_info, false).
:- use_module(private/checks/checks, [must_be/2]).
:- use_module(private/errors/public_clauses, [term_expansion/4]).
:- use_module(private/devices/attributes,
              [ attribute/4, attribute_words/4, device_at/3,
                goal_expansion/2, value_attribute/2
              ]).
:- use_module(private/native/native,
              [attribute_/4, attribute_write_/4, device_/3, device_/4]).
:- reexport(files).

/** <module> Driver framework: devices and their files

ev3dev shows each motor and sensor as a directory of attribute files. The
predicates here are the paper's first layer: they find devices by port and
read and write their attributes, one read or write each.

A predicate reads the attribute if the value is unbound. If the value is bound
and the attribute is writable, it writes the attribute:

```
?- position(outB, P).           % read
?- position(outB, 0).           % write: this is the new zero
```

An unbound port enumerates the devices in the order of their ports; writing
needs a bound one.

This library also exports the predicates of library(ev3dev/files), which read
and write any file. library(ev3dev/device_table) prints all devices.

@see http://www.ev3dev.org for each driver's attributes
*/

% ---------------- DEVICES

%!  tacho_motor(?Port) is nondet.
%!  tacho_motor(?Port, ?Type) is nondet.
%!  tacho_motor(?Port, ?Type, ?Path) is nondet.
%
%   True if a motor with rotation sensor of Type, e.g. `lego-ev3-l-motor`, is
%   plugged into Port. Path is its directory.

tacho_motor(Port) :-
    device_('tacho-motor', Port, _).

tacho_motor(Port, Type) :-
    device_('tacho-motor', Port, Type).

tacho_motor(Port, Type, Path) :-
    device_('tacho-motor', Port, Type, Path).

%!  ev3_large_motor(?Port) is nondet.
%!  ev3_medium_motor(?Port) is nondet.
%!  nxt_motor(?Port) is nondet.
%
%   True if a motor of this kind is plugged into Port. An EV3 detects an NXT
%   motor as a large motor, unless port_device/2 names it.

ev3_large_motor(Port) :-
    tacho_motor(Port, 'lego-ev3-l-motor').

ev3_medium_motor(Port) :-
    tacho_motor(Port, 'lego-ev3-m-motor').

nxt_motor(Port) :-
    tacho_motor(Port, 'lego-nxt-motor').

%!  dc_motor(?Port) is nondet.
%
%   True if Port is in the mode for motors without rotation sensor, which
%   port_mode(Port, 'dc-motor') sets. See library(ev3dev/dc_motors).

dc_motor(Port) :-
    device_('dc-motor', Port, _).

%!  servo_motor(?Port) is nondet.
%
%   True if an RC servo is connected to Port, through a servo controller. See
%   library(ev3dev/servo_motors).

servo_motor(Port) :-
    device_('servo-motor', Port, _).

%!  lego_sensor(?Port) is nondet.
%!  lego_sensor(?Port, ?Type) is nondet.
%!  lego_sensor(?Port, ?Type, ?Path) is nondet.
%
%   True if a sensor of Type, e.g. `lego-ev3-us`, is plugged into Port. Path
%   is its directory.

lego_sensor(Port) :-
    device_('lego-sensor', Port, _).

lego_sensor(Port, Type) :-
    device_('lego-sensor', Port, Type).

lego_sensor(Port, Type, Path) :-
    device_('lego-sensor', Port, Type, Path).

% ---------------- ATTRIBUTES

%!  motor_attribute(?Port, +Attribute, ?Value) is nondet.
%!  sensor_attribute(?Port, +Attribute, ?Value) is nondet.
%
%   Read any attribute of a motor or sensor if Value is unbound, else write
%   it. Attribute is a file name such as `stop_action`, `'speed_pid/Kp'` or
%   `num_values`. Value is a number if the text of the file is a number, else
%   an atom. Writing a sensor's present mode to `mode` does nothing.
%
%   Fails if there is no device at Port. If Port is unbound, reads at the next
%   port on backtracking.
%
%   @error existence_error(file, File) if the device has no such attribute
%   @error permission_error(Access, attribute, File) if the attribute cannot
%          be read, or cannot be written
%   @error domain_error(Attribute, Value) if the device does not accept Value
%   @error instantiation_error if Attribute is unbound, or if Value is bound
%          and Port is unbound

motor_attribute(Port, Attribute, Value) :-
    attribute('tacho-motor', Port, Attribute, Value).

sensor_attribute(Port, Attribute, Value) :-
    attribute('lego-sensor', Port, Attribute, Value).

%!  command(+Port, +Command) is semidet.
%
%   Send a command to a motor: `run-forever`, `run-to-abs-pos`,
%   `run-to-rel-pos`, `run-timed`, `run-direct`, `stop` or `reset`. Does not
%   wait. Fails if there is no motor at Port.
%
%   @error domain_error(command, Command)

command(Port, Command) :-
    must_be(nonvar, Command),
    attribute_write_('tacho-motor', Port, command, Command).

%!  speed(?Port, ?CountsPerSecond) is nondet.
%
%   True if the motor now turns at CountsPerSecond. After a stop the speed
%   reads 0 only about 200 ms later.

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
%   True if CountsPerSecond is the highest speed that the motor accepts.

max_speed(Port, CountsPerSecond) :-
    attribute_('tacho-motor', Port, max_speed, CountsPerSecond).

%!  position(?Port, ?Counts) is nondet.
%
%   Read the motor's position, or give its present position a new number.
%   LEGO's motors have one count per degree.

position(Port, Counts) :-
    attribute('tacho-motor', Port, position, Counts).

%!  position_sp(?Port, ?Counts) is nondet.
%
%   Read or write the position, or distance, for the next command.

position_sp(Port, Counts) :-
    motor_attribute(Port, position_sp, Counts).

%!  state(?Port, ?State) is nondet.
%
%   True if State is the text of the motor's state: an atom with its flags,
%   separated by spaces; `''` if the motor rests.

state(Port, State) :-
    attribute_('tacho-motor', Port, state, State).

%!  motor_states(?Port, ?States) is nondet.
%
%   True if States is the list of the motor's flags, in this order: `running`,
%   `ramping`, `holding`, `overloaded`, `stalled`.

motor_states(Port, States) :-
    attribute_words('tacho-motor', Port, state, States).

%!  mode(?Port, ?Mode) is nondet.
%
%   Read a sensor's mode, or set it and wait until its values have settled:
%   10 ms, for the infrared sensor 1.1 s. Does nothing if the sensor is in
%   Mode already.
%
%   @error domain_error(mode, Mode)

mode(Port, Mode) :-
    sensor_attribute(Port, mode, Mode).

%!  value(?Port, +Index, ?Value) is nondet.
%
%   True if the sensor's file `value<Index>` holds the integer Value. Divide
%   it by 10 to the power of decimals/2.
%
%   @error domain_error(sensor_value_index, Index) if the present mode has no
%          such value

value(Port, Index, Value) :-
    value_attribute(Index, Attribute),
    attribute_('lego-sensor', Port, Attribute, Value).

%!  decimals(?Port, ?Decimals) is nondet.
%
%   True if Decimals is the number of decimals of the sensor's values in its
%   present mode.

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
%   True if File is the file of this attribute of the motor or sensor at Port.

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

attribute_file(Class, Port, Attribute, File) :-
    device_at(Class, Port, Path),
    atomic_list_concat([Path, Attribute], /, File).
