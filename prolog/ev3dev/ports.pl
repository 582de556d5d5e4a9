:- module(ev3dev_ports,
          [ lego_port/1,                % ?Port
            port_mode/2,                % ?Port, ?Mode
            port_modes/2,               % ?Port, -Modes
            port_status/2,              % ?Port, -Status
            port_device/2               % ?Port, ?Device
          ]).
:- set_prolog_flag(generate_debug_info, false).
:- use_module(private/errors/public_clauses, [term_expansion/4]).
:- use_module(private/checks/arguments, [word/2]).
:- use_module(private/explain/hints).
:- use_module(driver, []).
:- use_module(private/devices/attributes, [attribute_words/4]).
:- use_module(private/native/native,
              [ attribute_/4, device_/3, port_device_/2, port_set_device_/2,
                port_set_mode_/2 ]).

/** <module> Ports, and the devices that are plugged into them

The brick recognizes most motors and sensors. For the others, the program sets
the mode of the port or names the device:

```
?- port_mode(outA, 'dc-motor'), dc_motor_run(outA, 50).
?- port_mode(outD, led), led(outD, on).
?- port_device(outB, 'act-l12-ev3-50'), motor_run(outB, 50, 20).
?- port_mode(in1, 'nxt-analog'), port_device(in1, 'lego-nxt-light').
```

A port keeps its mode and its device until a program changes them, also after
the end of the program. The first mode of a port is `auto`.

All predicates fail if there is no such port.
*/

%!  lego_port(?Port) is nondet.
%
%   True if Port is a port of the brick: `in1` to `in4` and `outA` to `outD`.

lego_port(Port) :-
    device_('lego-port', Port, _).

%!  port_mode(?Port, ?Mode) is nondet.
%
%   Read the mode of a port, or set it. Setting it removes the device at the
%   port together with its settings. The modes `dc-motor`, `tacho-motor`,
%   `led`, `nxt-analog` and `ev3-analog` make a new device: then the call
%   waits until the program can use that device, and fails after 4 s. In other
%   modes the device depends on what is plugged in. Does nothing if the port
%   is in Mode already.
%
%   @error domain_error(mode, Mode)

port_mode(Port, Mode) :-
    var(Mode),
    !,
    attribute_('lego-port', Port, mode, Mode).
port_mode(Port, Mode0) :-
    word(Mode0, Mode),
    (   port_set_mode_(Port, Mode)
    ->  true
    ;   not_there(Port, Mode)
    ).

%!  port_modes(?Port, -Modes) is nondet.
%
%   True if Modes is the list of the modes that the port has.

port_modes(Port, Modes) :-
    attribute_words('lego-port', Port, modes, Modes).

%!  port_status(?Port, -Status) is nondet.
%
%   True if the port reports Status, for example `no-motor`, `tacho-motor`,
%   `no-sensor`, `ev3-uart` or `error`.

port_status(Port, Status) :-
    attribute_('lego-port', Port, status, Status).

%!  port_device(?Port, ?Device) is nondet.
%
%   Read the type of the motor or sensor at a port, or set it. Setting it
%   waits until the program can use the new device, and fails after 4 s. Does
%   nothing if a device of that type is there already. For most I2C sensors
%   Device also names the address: `'ht-nxt-compass 1'`.
%
%   @error domain_error(motor_type, Device) if an output port cannot have this
%          motor; the old device stays
%   @error permission_error(write, unsupported_attribute, File) if the present
%          mode of the port lets no program set the device

port_device(Port, Device) :-
    var(Device),
    !,
    port_device_(Port, Device).
port_device(Port, Device0) :-
    word(Device0, Device),
    (   port_set_device_(Port, Device)
    ->  true
    ;   not_there(Port, Device)
    ).

not_there(Port, What) :-
    (   lego_port(Port)
    ->  fail_because(nothing_came(Port, What))
    ;   fail_because(absent('lego-port', Port))
    ).
