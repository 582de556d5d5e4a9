:- module(ev3dev_attribute_files,
          [ command_file/2,             % ?Port, -File
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
:- use_module(driver, []).
:- use_module(on_demand, [on_demand_loaded/0]).

/** <module> The files of attributes

What library(ev3dev/driver) reads and writes, by name: for file_read/2,
file_write/2 and other programs.
*/

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
    ev3dev_driver:value_attribute(Index, Attribute),
    attribute_file('lego-sensor', Port, Attribute, File).

decimals_file(Port, File) :-
    attribute_file('lego-sensor', Port, decimals, File).

attribute_file(Class, Port, Attribute, File) :-
    ev3dev_driver:device_(Class, Port, _, Path),
    atomic_list_concat([Path, Attribute], /, File).

:- on_demand_loaded.
