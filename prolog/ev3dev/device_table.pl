:- module(ev3dev_device_table,
          [ ev3_devices/0
          ]).
:- set_prolog_flag(generate_debug_info, false).
:- use_module(private/errors/public_clauses, [term_expansion/4]).
:- use_module(driver,
              [ decimals/2, lego_sensor/2, mode/2, position/2,
                sensor_attribute/3, state/2, tacho_motor/2, value/3
              ]).
:- use_module(files, [ev3_sysfs/1]).
:- use_module(private/native/native, [attribute_/4, device_/3]).
:- use_module(private/basics/small_lists).

/** <module> A table of the connected devices
*/

%!  ev3_devices is det.
%
%   Print a table of the connected devices: port, type, and the present
%   reading of the motor or sensor.

ev3_devices :-
    findall(Row, device_row(Row), Rows),
    (   Rows == []
    ->  ev3_sysfs(Root),
        format("Nothing is connected (looking in ~w).~n", [Root])
    ;   format("~w~t~16|~w~t~38|~w~n", ['Port', 'Type', 'Reads']),
        forall(one_of(Rows, row(Port, Type, Reads)),
               format("~w~t~16|~w~t~38|~w~n", [Port, Type, Reads]))
    ).

device_row(row(Port, Type, Reads)) :-
    lego_sensor(Port, Type),
    reading(sensor_reading(Port), Reads).
device_row(row(Port, Type, Reads)) :-
    tacho_motor(Port, Type),
    reading(motor_reading(Port), Reads).
device_row(row(Port, Type, Reads)) :-
    device_('dc-motor', Port, Type),
    reading(dc_motor_reading(Port), Reads).
device_row(row(Port, Type, '')) :-
    device_('servo-motor', Port, Type).

% The row of a device that cannot be read shows the error.
reading(Goal_1, Reads) :-
    catch(call(Goal_1, Reads), Error, unreadable(Error, Reads)),
    !.
reading(_, '-').

unreadable(error(Formal, _), Reads) :-
    format(atom(Reads), "~p", [Formal]).

motor_reading(Port, Reads) :-
    position(Port, Position),
    state(Port, State),
    format(atom(Text), "position ~w ~w", [Position, State]),
    normalize_space(atom(Reads), Text).

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
