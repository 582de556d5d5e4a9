:- module(ev3dev_attributes,
          [ attribute/4,                % +Class, ?Port, +Attribute, ?Value
            attribute_words/4,          % +Class, ?Port, +Attribute, -Words
            value_attribute/2,          % +Index, -Attribute
            device_at/3                 % +Class, ?Port, -Path
          ]).
:- use_module(errors, [domain_error/2, must_be/2]).
:- use_module(explain, [fail_because/1]).
:- use_module(native, [attribute_/4, attribute_write_/4, device_/4]).

/** <module> Attributes of devices of any class
*/

%!  attribute(+Class, ?Port, +Attribute, ?Value) is nondet.
%
%   Read an attribute, or write it if Value is bound.

attribute(Class, Port, Attribute, Value) :-
    (   var(Value)
    ->  attribute_(Class, Port, Attribute, Value)
    ;   attribute_write_(Class, Port, Attribute, Value)
    ).

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
