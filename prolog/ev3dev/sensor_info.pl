:- module(ev3dev_sensor_info,
          [ sensor_info/2,              % ?Port, -Info
            sensor_mode/6,              % ?Type, ?Mode, ?Count, ?Decimals,
                                        % ?Units, ?Meaning
            sensor_type/2,              % ?Type, ?What
            sensor_command/2            % +Port, +Command
          ]).
:- set_prolog_flag(generate_debug_info, false).
:- use_module(private/checks/checks, [must_be/2]).
:- use_module(private/errors/public_clauses, [term_expansion/4]).
:- use_module(driver, [lego_sensor/2, mode/2, sensor_attribute/3]).
:- use_module(sensors, [sensor_values/3]).
:- use_module(private/devices/attributes, [attribute_words/4, device_at/3]).
:- use_module(private/basics/small_lists).

/** <module> All sensors and their modes

A table of all sensors that ev3dev has drivers for, and their modes; and a
description of each connected sensor.

```
?- sensor_info(in1, Info), member(Item, Info), print(Item), nl, fail.
type('ht-nxt-compass')
what('HiTechnic compass')
mode('COMPASS')
values([92])
units(deg)
modes([mode('COMPASS',1,0,deg,'degrees from north, clockwise, 0 to 359')])
commands(['BEGIN-CAL','END-CAL'])
```

## Adding a sensor to the table {#adding-to-the-table}

A program adds facts for a sensor that the table lacks.
[Adding a sensor](#adding-a-sensor) explains how its readings get names.

```
:- multifile ev3dev_sensor_info:known_mode/6.

ev3dev_sensor_info:known_mode('my-scale', 'WEIGHT', 1, 1, g,
                              'weight in grams, 0 to 500.0').
```
*/

:- multifile
    known_type/2,                       % Type, What
    known_mode/6.                       % Type, Mode, Count, Decimals, Units,
                                        % Meaning

%!  sensor_mode(?Type, ?Mode, ?Count, ?Decimals, ?Units, ?Meaning) is nondet.
%
%   True if sensors of Type have a Mode with Count values. Decimals is the
%   number of decimals of these values, Units is their unit, or `''`, and
%   Meaning describes them in words. Reads a table and no sensor.

sensor_mode(Type, Mode, Count, Decimals, Units, Meaning) :-
    (   known_mode(Type, Mode, Count, Decimals, Units, Meaning)
    ;   load_table,
        ev3dev_sensor_table:mode(Type, Mode, Count, Decimals, Units, Meaning)
    ).

%!  sensor_type(?Type, ?What) is nondet.
%
%   True if the driver's name Type stands for What, a sensor in words. Reads a
%   table and no sensor.

sensor_type(Type, What) :-
    (   known_type(Type, What)
    ;   load_table,
        ev3dev_sensor_table:type(Type, What)
    ).

%   The table is large, and most programs do not use it.

load_table :-
    module_property(ev3dev_sensor_info, file(Here)),
    file_directory_name(Here, Directory),
    atom_concat(Directory, '/private/devices/sensor_table', File),
    load_files(ev3dev_sensor_info:File, [if(not_loaded), imports([])]).

%!  sensor_info(?Port, -Info) is nondet.
%
%   True if Info describes the sensor at Port, as a list of
%
%     - type(Type)
%       The name of its driver.
%     - what(Text)
%       The sensor in words, if the table knows it.
%     - mode(Mode)
%     - values(Values)
%     - units(Units)
%       The present mode, the values in this mode, and their unit, or `''`.
%     - modes(Modes)
%       All its modes, as `mode(Mode, Count, Decimals, Units, Meaning)`, see
%       sensor_mode/6, or `mode(Mode)` if the table does not know them.
%     - commands(Commands)
%       The commands that sensor_command/2 accepts for this sensor.
%
%   The sensor stays in its mode. Fails if there is no sensor at Port. An
%   unbound Port enumerates the sensors.
%
%   @error existence_error(sensor, Port) if the sensor is out of contact for
%          2 s

sensor_info(Port, Info) :-
    device_at('lego-sensor', Port, _),
    lego_sensor(Port, Type),
    findall(Item, info(Port, Type, Item), Info).

info(_, Type, type(Type)).
info(_, Type, what(What)) :-
    once(sensor_type(Type, What)).
info(Port, _, Item) :-
    mode(Port, Mode),
    sensor_values(Port, Mode, Values),
    sensor_attribute(Port, units, Units),
    one_of([mode(Mode), values(Values), units(Units)], Item).
info(Port, Type, modes(Modes)) :-
    attribute_words('lego-sensor', Port, modes, Names),
    findall(Mode,
            ( one_of(Names, Name), mode_info(Type, Name, Mode) ),
            Modes).
info(Port, _, commands(Commands)) :-
    attribute_words('lego-sensor', Port, commands, Commands).

mode_info(Type, Name, Mode) :-
    sensor_mode(Type, Name, Count, Decimals, Units, Meaning),
    !,
    Mode = mode(Name, Count, Decimals, Units, Meaning).
mode_info(_, Name, mode(Name)).

%!  sensor_command(+Port, +Command) is semidet.
%
%   Send a command to a sensor, for example 'BEGIN-CAL' to a compass. Does not
%   wait. Fails if there is no sensor at Port.
%
%   @error domain_error(command, Command) if the sensor has no such command

sensor_command(Port, Command) :-
    must_be(nonvar, Command),
    must_be(nonvar, Port),
    sensor_attribute(Port, command, Command).
