:- module(ev3dev_sensor_info,
          [ sensor_info/2,              % ?Port, -Info
            sensor_mode/6,              % ?Type, ?Mode, ?Count, ?Decimals,
                                        % ?Units, ?Meaning
            sensor_type/2,              % ?Type, ?What
            sensor_command/2            % +Port, +Command
          ]).
:- set_prolog_flag(generate_debug_info, false).
:- use_module(private/errors, [must_be/2, term_expansion/2]).
:- use_module(driver, [lego_sensor/2, mode/2, sensor_attribute/3]).
:- use_module(sensors, [sensor_values/3]).
:- use_module(private/attributes, [attribute_words/4]).
:- use_module(private/one_of).

/** <module> What sensors there are, and what they can do

A table of all sensors that ev3dev has drivers for, and their modes; and what
a sensor that is plugged in says of itself.

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

A program that knows of another sensor adds facts of its own; how to give its
readings names is told in [Adding a sensor](#adding-a-sensor):

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

:- dynamic
    tables_loaded/0.

%!  sensor_mode(?Type, ?Mode, ?Count, ?Decimals, ?Units, ?Meaning) is nondet.
%
%   True if sensors of Type have a Mode with Count values, which have that
%   many Decimals and these Units, `''` if none, and have that Meaning, in
%   words. A table: no sensor is asked.

sensor_mode(Type, Mode, Count, Decimals, Units, Meaning) :-
    load_tables,
    (   known_mode(Type, Mode, Count, Decimals, Units, Meaning)
    ;   table(Table, _),
        Table:mode(Type, Mode, Count, Decimals, Units, Meaning)
    ).

%!  sensor_type(?Type, ?What) is nondet.
%
%   True if the driver's name Type stands for What, a sensor in words. A
%   table: no sensor is asked.

sensor_type(Type, What) :-
    load_tables,
    (   known_type(Type, What)
    ;   table(Table, _),
        Table:type(Type, What)
    ).

% The tables are large, and most programs never ask for them.
table(ev3dev_lego_sensors, lego).
table(ev3dev_other_sensors, other).

load_tables :-
    tables_loaded,
    !.
load_tables :-
    with_mutex(ev3dev_sensor_tables, load_tables_once).

load_tables_once :-
    tables_loaded,
    !.
load_tables_once :-
    module_property(ev3dev_sensor_info, file(Here)),
    file_directory_name(Here, Directory),
    forall(table(_, Name), load_table(Directory, Name)),
    assertz(tables_loaded).

load_table(Directory, Name) :-
    atomic_list_concat([Directory, '/private/sensor_table/', Name], File),
    load_files(ev3dev_sensor_info:File, [if(not_loaded), imports([])]).

%!  sensor_info(?Port, -Info) is nondet.
%
%   True if Info is what is known of the sensor at Port, as a list of
%
%     - type(Type)
%       The name of its driver.
%     - what(Text)
%       What it is in words, if the table knows it.
%     - mode(Mode)
%     - values(Values)
%     - units(Units)
%       The mode it is in, the values it shows there, and their units, `''` if
%       it has none.
%     - modes(Modes)
%       All its modes, as `mode(Mode, Count, Decimals, Units, Meaning)`, see
%       sensor_mode/6, or `mode(Mode)` if the table does not know them.
%     - commands(Commands)
%       What sensor_command/2 takes.
%
%   The sensor stays in its mode. Fails if there is no sensor at Port. On
%   backtracking, tells of the next if Port is unbound.
%
%   @error existence_error(sensor, Port) if it is out of contact for 2 s

sensor_info(Port, Info) :-
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
%   Give a sensor one of its commands, as 'BEGIN-CAL' for a compass. Does not
%   wait. Fails if there is no sensor at Port.
%
%   @error domain_error(command, Command) if it has no such command

sensor_command(Port, Command) :-
    must_be(nonvar, Command),
    must_be(nonvar, Port),
    sensor_attribute(Port, command, Command).
