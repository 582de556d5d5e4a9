:- module(ev3dev_lights,
          [ led/1,                      % ?Light
            led/2,                      % ?Light, ?Color
            led_trigger/2,              % ?Light, ?Trigger
            led_triggers/2,             % ?Light, -Triggers
            led_blink/3                 % ?Light, ?On, ?Off
          ]).
:- set_prolog_flag(generate_debug_info, false).
:- use_module(private/checks/checks, [evaluated/2]).
:- use_module(private/errors/errors, [domain_error/2]).
:- use_module(private/errors/public_clauses, [term_expansion/4]).
:- use_module(private/explain/hints).
:- use_module(private/checks/arguments, [must_be_within/4, word/2]).
:- use_module(private/native/native,
              [ led_/3, led_set_color_/2, led_set_delays_/3,
                led_set_trigger_/2 ]).

/** <module> Lights

The brick has two lights around its buttons, one on the `left` and one on the
`right`:

```
?- led(left, red).
?- led(Light, Color).
Light = left,
Color = red ;
Light = right,
Color = green.
?- led_blink(left, 200, 800).
```

A lamp on an output port in the mode `led` is a light, too; its name is the
port. See port_mode/2.

All predicates fail if the board has no such light. A predicate reads an
unbound value and writes a bound one. A program may spell a port as `outA` or
as `'ev3-ports:outA'`.
*/

%!  led(?Light) is nondet.
%
%   True if Light is one of the lights: `left`, `right`, or a port.

led(Light) :-
    led_(Light, name, _).

%!  led(?Light, ?Color) is nondet.
%
%   Read the color of a light, or set it. Setting the color ends blinking and
%   any other trigger of the light. Color is one of
%
%     - off
%     - red
%     - green
%     - amber
%     - orange
%     - yellow
%       A mix of red and green.
%     - levels(Red, Green)
%       Two arithmetic expressions, each from 0 to 100.
%     - on
%     - Percent
%       From 0 to 100. Only for lights of one color.
%
%   Other boards have other lights: the BrickPi has `blue` ones, the BrickPi3
%   has a single `amber` one with the name `left`, and the PiStorms has red,
%   green and blue ones, with `levels(Red, Green, Blue)`. Fails if the light
%   cannot show Color.
%
%   @error domain_error(led_color, Color)
%   @error instantiation_error if Color is bound and Light is unbound

led(Light, Color) :-
    var(Color),
    !,
    led_read(Light, color, Color).
led(Light, Color0) :-
    color(Color0, Color),
    (   led_set_color_(Light, Color)
    ->  true
    ;   led(Light)
    ->  fail_because(unable(Light, show, Color))
    ;   fail_because(absent(light, Light))
    ).

led_read(Light, What, Value) :-
    (   led_(Light, What, Read)
    *-> Value = Read
    ;   \+ led(Light),
        fail_because(absent(light, Light))
    ).

color(Color0, Color) :-
    ( atom(Color0) ; string(Color0) ),
    !,
    word(Color0, Color).
color(levels(Red0, Green0), levels(Red, Green)) :-
    !,
    percent(Red0, Red),
    percent(Green0, Green).
color(levels(Red0, Green0, Blue0), levels(Red, Green, Blue)) :-
    !,
    percent(Red0, Red),
    percent(Green0, Green),
    percent(Blue0, Blue).
color(Color0, Color) :-
    number(Color0),
    !,
    percent(Color0, Color).
color(Color, _) :-
    domain_error(led_color, Color).

percent(Expression, Percent) :-
    evaluated(Expression, Value),
    (   Value >= 0,
        Value =< 100
    ->  evaluated(round(Value), Percent)
    ;   domain_error(led_color, Value)
    ).

%!  led_trigger(?Light, ?Trigger) is nondet.
%
%   Read or set the trigger that switches a light: `none`, or one of
%   led_triggers/2, such as `heartbeat`, `timer` or `default-on`. The light
%   keeps its color. If it was off, it shines in all its colors. `none`
%   switches it off.
%
%   @error domain_error(trigger, Trigger)

led_trigger(Light, Trigger) :-
    var(Trigger),
    !,
    led_read(Light, trigger, Trigger).
led_trigger(Light, Trigger0) :-
    word(Trigger0, Trigger),
    (   led_set_trigger_(Light, Trigger)
    ->  true
    ;   fail_because(absent(light, Light))
    ).

%!  led_triggers(?Light, -Triggers) is nondet.
%
%   True if Triggers is the list of triggers that may switch the light.

led_triggers(Light, Triggers) :-
    led_read(Light, triggers, Triggers).

%!  led_blink(?Light, ?On, ?Off) is nondet.
%
%   Let a light blink in its color: on for On milliseconds, then off for Off
%   milliseconds, until a program sets its color or the board is switched off.
%   Does not wait. If both times are unbound, reads them; fails if the light
%   does not blink.
%
%   @error domain_error(milliseconds, Time) if Time is not above 0

led_blink(Light, On, Off) :-
    var(On),
    var(Off),
    !,
    led_read(Light, delays, delays(On, Off)).
led_blink(Light, On, Off) :-
    must_be_milliseconds(On),
    must_be_milliseconds(Off),
    (   led_set_delays_(Light, On, Off)
    ->  true
    ;   fail_because(absent(light, Light))
    ),
    (   On < 10,
        Off < 10
    ->  advise(not_milliseconds(led_blink/3, On))
    ;   true
    ).

must_be_milliseconds(Time) :-
    must_be_within(1, 2147483647, milliseconds, Time).
