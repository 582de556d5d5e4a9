:- module(ev3dev_sensor_type,
          [ sensor_of/3,                % ?Port, +Types, -Type
            sensor_to_read/3            % ?Port, +Types, -Type
          ]).
:- use_module('../../driver', [lego_sensor/2]).
:- use_module('../explain/hints', [fail_because/1]).
:- use_module('../basics/small_lists').

/** <module> Sensors of one of several types
*/

%!  sensor_of(?Port, +Types, -Type) is nondet.
%
%   True if a sensor of Type, one of Types, is plugged into Port. The last
%   solution leaves no choice point.

sensor_of(Port, Types, Type) :-
    nonvar(Port),
    !,
    lego_sensor(Port, Type0),
    memberchk(Type0, Types),
    Type = Type0.
sensor_of(Port, Types, Type) :-
    findall(P-T,
            ( lego_sensor(P, T), memberchk(T, Types) ),
            Sensors),
    one_of(Sensors, Port-Type).

%!  sensor_to_read(?Port, +Types, -Type) is nondet.
%
%   Like sensor_of/3, but explains why it fails.

sensor_to_read(Port, Types, Type) :-
    (   sensor_of(Port, Types, Found)
    *-> Type = Found
    ;   fail_because(absent(Types, Port))
    ).
