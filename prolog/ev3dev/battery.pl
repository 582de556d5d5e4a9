:- module(ev3dev_battery,
          [ battery/2                   % ?Key, -Value
          ]).
:- set_prolog_flag(generate_debug_info, false).
:- use_module(private/errors/errors, [domain_error/2]).
:- use_module(private/errors/public_clauses, [term_expansion/4]).
:- use_module(private/checks/arguments, [word/2]).
:- use_module(private/native/native, [battery_/2]).

/** <module> The battery
*/

%!  battery(?Key, -Value) is nondet.
%
%   True if Value is the battery's reading for Key:
%
%     - voltage
%       In volts. It falls while motors run.
%     - current
%       The current that the brick draws, in amperes.
%     - percent
%       The charge that is left, from 0 to 100, estimated from the voltage and
%       the type. The estimate is rough: it is about 5 lower while the robot
%       drives, and in the middle of a discharge the voltage hardly changes.
%     - type
%       `'Li-ion'`, LEGO's battery pack; `'NiMH'`, rechargeable AA cells; or
%       `'Unknown'`, other AA cells; percent then assumes alkaline cells.
%
%   An unbound Key enumerates. Fails if the board does not measure Key: most
%   boards that are not LEGO's measure only the voltage. Fails if the board
%   reports nothing about its battery.
%
%   @error domain_error(battery_key, Key)

battery(Key, Value) :-
    var(Key),
    !,
    battery_key(Key),
    battery_(Key, Value).
battery(Key0, Value) :-
    word(Key0, Key),
    (   battery_key(Key)
    ->  battery_(Key, Value)
    ;   domain_error(battery_key, Key)
    ).

battery_key(voltage).
battery_key(current).
battery_key(percent).
battery_key(type).
