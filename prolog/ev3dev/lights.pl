:- module(ev3dev_lights,
          [ led/1,                      % ?Light
            led/2,                      % ?Light, ?Colour
            led_trigger/2,              % ?Light, ?Trigger
            led_triggers/2,             % ?Light, -Triggers
            led_blink/3                 % ?Light, ?On, ?Off
          ]).
:- set_prolog_flag(generate_debug_info, false).
:- use_module(private/errors,
              [ domain_error/2, evaluated/2, must_be/2, term_expansion/2
              ]).
:- use_module(private/explain).
:- use_module(private/arguments, [must_be_within/4]).
:- use_module(private/native,
              [ led_/3, led_set_colour_/2, led_set_delays_/3,
                led_set_trigger_/2 ]).

/** <module> Lights

The brick's lights are around its keys, one on the `left` and one on the
`right`:

```
?- led(left, red).
?- led(Light, Colour).
Light = left,
Colour = red ;
Light = right,
Colour = green.
?- led_blink(left, 200, 800).
```

A lamp on an output port in the mode `led` is a light, too, called by its
port; see port_mode/2.

All predicates fail if the board has no such light. What is unbound is read,
what is bound is written. A bound port may be spelled either way.
*/

%!  led(?Light) is nondet.
%
%   True if Light is one of the lights: `left`, `right`, or a port.

led(Light) :-
    led_(Light, name, _).

%!  led(?Light, ?Colour) is nondet.
%
%   Read the colour of a light, or set it; a light that something else
%   switches, as one that blinks, is this program's then. Colour is one of
%
%     - off
%     - red
%     - green
%     - amber
%     - orange
%     - yellow
%       Mixed of red and green.
%     - levels(Red, Green)
%       Each from 0 to 100; two expressions.
%     - on
%     - Percent
%       From 0 to 100. For lights of one colour only.
%
%   Other boards have other lights: the BrickPi `blue`, the BrickPi3 a single
%   one in `amber`, which is called `left`, and the PiStorms red, green and
%   blue, with `levels(Red, Green, Blue)`. Fails if the light cannot show that
%   colour.
%
%   @error domain_error(led_color, Colour)
%   @error instantiation_error if a Colour is to be set and Light is unbound

led(Light, Colour) :-
    var(Colour),
    !,
    led_(Light, colour, Colour).
led(Light, Colour0) :-
    colour(Colour0, Colour),
    (   led_set_colour_(Light, Colour)
    ->  true
    ;   led(Light)
    ->  explain("the light ~w cannot show ~w", [Light, Colour]),
        fail
    ;   no_light(Light)
    ).

colour(Colour, Colour) :-
    atom(Colour),
    !.
colour(levels(Red0, Green0), levels(Red, Green)) :-
    !,
    percent(Red0, Red),
    percent(Green0, Green).
colour(levels(Red0, Green0, Blue0), levels(Red, Green, Blue)) :-
    !,
    percent(Red0, Red),
    percent(Green0, Green),
    percent(Blue0, Blue).
colour(Colour0, Colour) :-
    number(Colour0),
    !,
    percent(Colour0, Colour).
colour(Colour, _) :-
    domain_error(led_color, Colour).

percent(Expression, Percent) :-
    evaluated(Expression, Value),
    (   Value >= 0,
        Value =< 100
    ->  evaluated(round(Value), Percent)
    ;   domain_error(led_color, Value)
    ).

no_light(Light) :-
    explain("there is no light ~w", [Light]),
    fail.

%!  led_trigger(?Light, ?Trigger) is nondet.
%
%   Read or set what switches a light: `none`, or one of led_triggers/2, such
%   as `heartbeat`, `timer` or `default-on`. The light keeps its colour; one
%   that is off shines in all it has. With `none` it goes out.
%
%   @error domain_error(trigger, Trigger)

led_trigger(Light, Trigger) :-
    var(Trigger),
    !,
    led_(Light, trigger, Trigger).
led_trigger(Light, Trigger) :-
    must_be(atom, Trigger),
    (   led_set_trigger_(Light, Trigger)
    ->  true
    ;   no_light(Light)
    ).

%!  led_triggers(?Light, -Triggers) is nondet.
%
%   True if Triggers is the list of what may switch the light.

led_triggers(Light, Triggers) :-
    led_(Light, triggers, Triggers).

%!  led_blink(?Light, ?On, ?Off) is nondet.
%
%   Let a light blink in its colour, On and Off for so many milliseconds in
%   turns, until its colour is set or the board is switched off; or read these
%   times of a light that blinks, and fail for one that does not. Does not
%   wait for it.
%
%   @error domain_error(milliseconds, Time) if it is not above 0

led_blink(Light, On, Off) :-
    var(On),
    var(Off),
    !,
    led_(Light, delays, delays(On, Off)).
led_blink(Light, On, Off) :-
    must_be_milliseconds(On),
    must_be_milliseconds(Off),
    (   led_set_delays_(Light, On, Off)
    ->  true
    ;   no_light(Light)
    ).

must_be_milliseconds(Time) :-
    must_be_within(1, 2147483647, milliseconds, Time).
