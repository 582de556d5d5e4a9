:- module(ev3dev_ports,
          [ lego_port/1,                % ?Port
            port_mode/2,                % ?Port, ?Mode
            port_modes/2,               % ?Port, -Modes
            port_status/2,              % ?Port, -Status
            port_device/2               % ?Port, ?Device
          ]).
:- use_module(library(debug), [debug/3]).
:- use_module(private/errors, [must_be/2, term_expansion/2]).
:- use_module(driver, []).
:- use_module(private/attributes, [attribute_words/4]).
:- use_module(private/native,
              [ attribute_/4, device_/3, port_device_/2, port_set_device_/2,
                port_set_mode_/2 ]).

/** <module> Ports, and what is plugged into them

Most motors and sensors are recognised when they are plugged in. What is not
has to be announced, by the mode of its port or by its name:

```
?- port_mode(outA, 'dc-motor'), dc_motor_run(outA, 50).
?- port_mode(outD, led), led(outD, on).
?- port_device(outB, 'act-l12-ev3-50'), motor_run(outB, 50, 20).
?- port_mode(in1, 'nxt-analog'), port_device(in1, 'lego-nxt-light').
```

A port stays what it was told until it is told something else, also after the
program. The mode `auto` is the one it has at first.

All predicates fail if there is no such port.
*/

%!  lego_port(?Port) is nondet.
%
%   True if Port is one of the brick's: `in1` to `in4` and `outA` to `outD`.

lego_port(Port) :-
    device_('lego-port', Port, _).

%!  port_mode(?Port, ?Mode) is nondet.
%
%   Read the mode of a port, or put it into another one: then what was there
%   is gone, with all that it was set to, and where the Mode makes a device,
%   waits until that is there and can be used. That is so for the modes
%   `dc-motor`, `tacho-motor`, `led`, `nxt-analog` and `ev3-analog`; in others
%   it depends on what is plugged in. Does nothing if the port is in that
%   mode. Waits for 4 s at most, and fails then.
%
%   @error domain_error(mode, Mode)

port_mode(Port, Mode) :-
    var(Mode),
    !,
    attribute_('lego-port', Port, mode, Mode).
port_mode(Port, Mode) :-
    must_be(atom, Mode),
    (   port_set_mode_(Port, Mode)
    ->  true
    ;   not_there(Port, Mode)
    ).

%!  port_modes(?Port, -Modes) is nondet.
%
%   True if Modes is the list of the modes that the port can be put into.

port_modes(Port, Modes) :-
    attribute_words('lego-port', Port, modes, Modes).

%!  port_status(?Port, -Status) is nondet.
%
%   True if Status is what the port says is plugged in, such as `no-motor`,
%   `tacho-motor`, `no-sensor`, `ev3-uart` or `error`.

port_status(Port, Status) :-
    attribute_('lego-port', Port, status, Status).

%!  port_device(?Port, ?Device) is nondet.
%
%   Read the type of the motor or sensor at a port, or tell the port that one
%   of another type is plugged in, and wait until that is there and can be
%   used. Does nothing if it is there already. Waits for 4 s at most, and
%   fails then. With most I2C sensors the address follows, as in
%   `'ht-nxt-compass 1'`.
%
%   @error domain_error(motor_type, Device) if it is no motor that an output
%          port can have; what is there stays
%   @error permission_error(write, unsupported_attribute, File) if the port
%          cannot be told so in its present mode

port_device(Port, Device) :-
    var(Device),
    !,
    port_device_(Port, Device).
port_device(Port, Device) :-
    must_be(atom, Device),
    (   port_set_device_(Port, Device)
    ->  true
    ;   not_there(Port, Device)
    ).

not_there(Port, What) :-
    (   lego_port(Port)
    ->  debug(ev3dev, "nothing came of ~w at ~w", [What, Port])
    ;   debug(ev3dev, "there is no port ~w", [Port])
    ),
    fail.
