:- module(ev3dev_battery,
          [ battery/2                   % ?Key, -Value
          ]).
:- set_prolog_flag(generate_debug_info, false).
:- use_module(private/errors, [domain_error/2, must_be/2, term_expansion/2]).
:- use_module(private/native, [battery_/2]).

/** <module> The battery
*/

%!  battery(?Key, -Value) is nondet.
%
%   True if Value is what the battery says for Key:
%
%     - voltage
%       In volts. It falls while motors run.
%     - current
%       What the brick draws, in amperes.
%     - percent
%       What is left, from 0 to 100, estimated by the voltage and the type.
%       A driving robot shows some 5 less than one that stands, and in the
%       middle of a discharge the voltage hardly changes: an estimate.
%     - type
%       `'Li-ion'`, LEGO's battery pack; `'NiMH'`, rechargeable AA cells; or
%       `'Unknown'`, other AA cells, which percent takes for alkaline ones.
%
%   An unbound Key enumerates. What a board does not measure fails: of those
%   that are not LEGO's most only know the voltage. Fails if the board does
%   not tell of its battery at all.
%
%   @error domain_error(battery_key, Key)

battery(Key, Value) :-
    var(Key),
    !,
    battery_key(Key),
    battery_(Key, Value).
battery(Key, Value) :-
    must_be(atom, Key),
    (   battery_key(Key)
    ->  battery_(Key, Value)
    ;   domain_error(battery_key, Key)
    ).

battery_key(voltage).
battery_key(current).
battery_key(percent).
battery_key(type).
