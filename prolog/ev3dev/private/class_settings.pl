:- module(ev3dev_class_settings,
          [ class_settings/3,           % +Class, ?Port, +Settings
            class_polarity/3            % +Class, ?Port, ?Polarity
          ]).
:- use_module(errors, [domain_error/2]).
:- use_module('../driver', []).
:- use_module(arguments, [must_be_within/4, word/2]).
:- use_module(attributes, [attribute/4, device_at/3]).
:- use_module(native, [attribute_/4, attribute_write_/4]).
:- use_module(one_of).

/** <module> Settings of motors of any class
*/

%!  class_settings(+Class, ?Port, +Settings) is nondet.
%
%   Read attributes of a device if all values are unbound. Else check all
%   values, then write them. Settings is a list of
%   setting(Attribute, Lowest, Highest, Value), where Value is an integer.
%
%   @error domain_error(Attribute, Value) if Value is not between Lowest and
%          Highest

class_settings(Class, Port, Settings) :-
    forall(one_of(Settings, Setting), is_unbound(Setting)),
    !,
    device_at(Class, Port, _),
    settings_read(Settings, Class, Port).
class_settings(Class, Port, Settings) :-
    forall(one_of(Settings, Setting), must_be_setting(Setting)),
    forall(one_of(Settings, Setting), setting_write(Class, Port, Setting)).

is_unbound(setting(_, _, _, Value)) :-
    var(Value).

must_be_setting(setting(Attribute, Lowest, Highest, Value)) :-
    must_be_within(Lowest, Highest, Attribute, Value).

settings_read([], _, _).
settings_read([setting(Attribute, _, _, Value)|Settings], Class, Port) :-
    attribute_(Class, Port, Attribute, Value),
    settings_read(Settings, Class, Port).

setting_write(Class, Port, setting(Attribute, _, _, Value)) :-
    attribute_write_(Class, Port, Attribute, Value).

%!  class_polarity(+Class, ?Port, ?Polarity) is nondet.
%
%   Read or write a motor's polarity: `normal` or `inversed`.
%
%   @error domain_error(polarity, Polarity)

class_polarity(Class, Port, Polarity) :-
    var(Polarity),
    !,
    attribute(Class, Port, polarity, Polarity).
class_polarity(Class, Port, Polarity0) :-
    word(Polarity0, Polarity),
    (   memberchk(Polarity, [normal, inversed])
    ->  attribute(Class, Port, polarity, Polarity)
    ;   domain_error(polarity, Polarity)
    ).
