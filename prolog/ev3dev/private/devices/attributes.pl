:- module(ev3dev_attributes,
          [ attribute/4,                % +Class, ?Port, +Attribute, ?Value
            goal_expansion/2,           % +Goal, -Body
            attribute_words/4,          % +Class, ?Port, +Attribute, -Words
            value_attribute/2,          % +Index, -Attribute
            device_at/3,                % +Class, ?Port, -Path
            class_settings/3,           % +Class, ?Port, +Settings
            class_polarity/3            % +Class, ?Port, ?Polarity
          ]).
:- use_module('../checks/arguments', [must_be_within/4, word/2]).
:- use_module('../checks/checks', [must_be/2]).
:- use_module('../errors/errors', [domain_error/2]).
:- use_module('../explain/hints', [fail_because/1]).
:- use_module('../native/native',
              [attribute_/4, attribute_write_/4, device_/4]).
:- use_module('../basics/small_lists', [one_of/2]).

/** <module> Attributes of devices of any class
*/

%!  goal_expansion(+Goal, -Body) is semidet.
%
%   A module that imports this has the body of attribute/4 in the place of its
%   calls, and so has attribute/4. A call takes as long as reading a file.

goal_expansion(attribute(Class, Port, Attribute, Value),
               (   var(Value)
               ->  attribute_(Class, Port, Attribute, Value)
               ;   attribute_write_(Class, Port, Attribute, Value)
               )).

%!  attribute(+Class, ?Port, +Attribute, ?Value) is nondet.
%
%   Read an attribute, or write it if Value is bound.

attribute(Class, Port, Attribute, Value) :-
    attribute(Class, Port, Attribute, Value).

%!  attribute_words(+Class, ?Port, +Attribute, -Words) is nondet.
%
%   True if Words is the list of the words of an attribute's text. Spaces
%   separate them. A single number, for example a mode with the name 50, is a
%   word, too.

attribute_words(Class, Port, Attribute, Words) :-
    attribute_(Class, Port, Attribute, Text),
    (   Text == ''
    ->  Words = []
    ;   atomic_list_concat(Words0, ' ', Text),
        Words = Words0
    ).

%!  value_attribute(+Index, -Attribute) is det.
%
%   Attribute is the name of the file of a sensor's value number Index.

value_attribute(Index, Attribute) :-
    must_be(nonneg, Index),
    (   Index < 8
    ->  atom_concat(value, Index, Attribute)
    ;   domain_error(sensor_value_index, Index)
    ).

%!  device_at(+Class, ?Port, -Path) is nondet.
%
%   True if Path is the directory of the device at Port. Explains why it
%   fails.

device_at(Class, Port, Path) :-
    (   device_(Class, Port, _, Path)
    *-> true
    ;   fail_because(absent(Class, Port))
    ).

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
