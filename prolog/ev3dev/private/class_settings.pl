:- module(ev3dev_class_settings,
          [ class_settings/3,           % +Class, ?Port, +Settings
            class_polarity/3            % +Class, ?Port, ?Polarity
          ]).
:- use_module(library(apply), [maplist/2]).
:- use_module(errors, [domain_error/2, must_be/2]).
:- use_module('../driver', []).
:- use_module(arguments, [must_be_within/4]).
:- use_module(attributes, [attribute/4]).
:- use_module(native, [attribute_/4, attribute_write_/4, device_/3]).

/** <module> What motors of any class are set to
*/

%!  class_settings(+Class, ?Port, +Settings) is nondet.
%
%   Read attributes of a device if all their values are unbound, else write
%   them, after all values were looked at. Settings is a list of
%   setting(Attribute, Lowest, Highest, Value), where Value is an integer.
%
%   @error domain_error(Attribute, Value) if a Value is out of its range

class_settings(Class, Port, Settings) :-
    maplist(is_unbound, Settings),
    !,
    device_(Class, Port, _),
    maplist(setting_read(Class, Port), Settings).
class_settings(Class, Port, Settings) :-
    maplist(must_be_setting, Settings),
    maplist(setting_write(Class, Port), Settings).

is_unbound(setting(_, _, _, Value)) :-
    var(Value).

must_be_setting(setting(Attribute, Lowest, Highest, Value)) :-
    must_be_within(Lowest, Highest, Attribute, Value).

setting_read(Class, Port, setting(Attribute, _, _, Value)) :-
    attribute_(Class, Port, Attribute, Value).

setting_write(Class, Port, setting(Attribute, _, _, Value)) :-
    attribute_write_(Class, Port, Attribute, Value).

%!  class_polarity(+Class, ?Port, ?Polarity) is nondet.
%
%   Read or write a motor's polarity: `normal` or `inversed`.
%
%   @error domain_error(polarity, Polarity)

class_polarity(Class, Port, Polarity) :-
    (   var(Polarity)
    ->  true
    ;   must_be(atom, Polarity),
        memberchk(Polarity, [normal, inversed])
    ->  true
    ;   domain_error(polarity, Polarity)
    ),
    attribute(Class, Port, polarity, Polarity).
