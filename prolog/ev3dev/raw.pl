:- module(ev3dev_raw,
          [ i2c_read/4,                 % +Port, +Register, +Count, -Bytes
            i2c_write/3,                % +Port, +Register, +Bytes
            analog_voltage/2            % ?Port, -Volts
          ]).
:- set_prolog_flag(generate_debug_info, false).
:- use_module(private/load/compiled, []).
:- use_module(private/checks/checks, [must_be/2]).
:- use_module(private/errors/errors, [domain_error/2]).
:- use_module(private/errors/public_clauses, [term_expansion/4]).
:- use_module(private/checks/arguments, [must_be_within/4]).
:- use_module(private/native/native, [i2c_read_/4, i2c_write_/3]).
:- use_module(private/basics/small_lists).
:- use_module(private/devices/sensor_type, [sensor_to_read/3]).
:- use_module(sensors, [reading_of/4, sensor_reading/3]).

/** <module> Registers and voltages of sensors

What a sensor says without a driver in between: the bytes of a sensor on the
I2C bus, and the voltage of one that is only a voltage. With these a program
uses what ev3dev has no mode or command for, and sensors that somebody has
built. Loaded apart from library(ev3dev):

```
?- use_module(library(ev3dev/raw)).
?- i2c_read(in1, 0x08, 8, Bytes), atom_codes(Maker, Bytes).
Maker = 'HITECHNC'.
?- port_mode(in2, 'nxt-analog'), analog_voltage(in2, Volts).
Volts = 2.504.
```

## Sensors on the I2C bus {#i2c-sensors}

Most sensors of other makers, and the ultrasonic sensor of the NXT, are a row
of registers of a byte each, with numbers from 0. Sensors for the NXT have
three texts of 8 characters: the version from register 0 on, the maker from 8
on, the name from 16 on. Register 65, or 0x41, is for commands, and the
measurements mostly begin at 66. Manuals list the others.

Some registers hold settings that outlast power: a wrong byte there, such as a
wrong address, can make a sensor useless.

The kernel must know the sensor: lego_sensor/1 enumerates it. If it does not,
put the port into the mode `other-i2c`, and load any driver for the address in
a shell. The bus of `in1` has the number 3, that of `in4` the number 6:

```
sudo sh -c 'echo ht-nxt-compass 0x39 > /sys/bus/i2c/devices/i2c-3/new_device'
```

In the simulator, what is written into a register is read there again, and
does nothing else. What a sensor says of itself and what it measures cannot be
written.

@see https://www.ev3dev.org/docs/sensors/using-i2c-sensors/

## Voltages {#voltages}

The brick gives the voltage of a sensor that it does not know, or whose port
is in the mode `nxt-analog` or `ev3-analog`. The port keeps that mode. In the
mode `auto` again, it looks for known sensors:

```
?- port_mode(in2, auto).
```
*/

%!  i2c_read(+Port, +Register, +Count, -Bytes) is semidet.
%
%   True if the sensor on the I2C bus at Port has the list Bytes in Count
%   registers from Register on: integers from 0 to 255. Count is from 1 to 32,
%   and Register from 0 to 254, as the last register is 254. Takes about a
%   millisecond for each byte. Fails if there is no sensor at Port. A sensor
%   that does not answer is tried for 2 s.
%
%   @error domain_error(i2c_register, Register)
%   @error domain_error(i2c_count, Count) if it is not from 1 to 32, or
%          leads beyond the last register
%   @error domain_error(i2c_sensor, Port) if the sensor is not on the I2C bus
%   @error existence_error(sensor, Port) if the sensor does not answer
%   @error system_error(_) for other errors of the bus

i2c_read(Port, Register, Count, Bytes) :-
    must_be_register(Register),
    must_be_count(Register, Count, Count),
    i2c_read_(Port, Register, Count, Bytes).

%!  i2c_write(+Port, +Register, +Bytes) is semidet.
%
%   Write Bytes, a list of 1 to 32 integers from 0 to 255, into the registers
%   of the sensor on the I2C bus at Port, from Register on. Writes once, and
%   does not wait for what the sensor does. Fails if there is no sensor at
%   Port.
%
%   A motor that is started by a register of its controller is not known to
%   stop/0, and not stopped at the end of the program.
%
%   @error domain_error(i2c_register, Register)
%   @error domain_error(i2c_count, Bytes) if there are not 1 to 32 of them, or
%          if they lead beyond the last register
%   @error domain_error(byte, Byte) if one of Bytes is not a byte
%   @error domain_error(i2c_sensor, Port) if the sensor is not on the I2C bus
%   @error existence_error(sensor, Port) if the sensor does not answer
%   @error system_error(_) for other errors of the bus

i2c_write(Port, Register, Bytes) :-
    must_be_register(Register),
    must_be(list, Bytes),
    must_be_bytes(Bytes),
    length(Bytes, Count),
    must_be_count(Register, Count, Bytes),
    i2c_write_(Port, Register, Bytes).

% The kernel's file of the registers ends before the 256th.
must_be_register(Register) :-
    must_be_within(0, 254, i2c_register, Register).

must_be_bytes([]).
must_be_bytes([Byte|Bytes]) :-
    must_be_within(0, 255, byte, Byte),
    must_be_bytes(Bytes).

must_be_count(Register, Count, Culprit) :-
    must_be(integer, Count),
    (   between(1, 32, Count),
        Register + Count =< 255
    ->  true
    ;   domain_error(i2c_count, Culprit)
    ).

%!  analog_voltage(?Port, -Volts) is nondet.
%
%   True if the sensor at Port gives Volts, from 0.0 to 5.0: a sensor of the
%   NXT on pin 1, in the mode `nxt-analog` of its port or if it is unknown; a
%   sensor of the EV3 on pin 6, in the mode `ev3-analog` or if it is unknown.
%   The brick measures a hundred times a second. An unbound Port enumerates
%   the ports that have such a sensor.
%
%   A sensor of the NXT has its lamp off. `sensor_value(Port, 'ANALOG-1', 0,
%   Volts)` measures with the lamp on, or what else pin 5 switches.
%   `sensor_wait(analog_voltage(in2) > 2.5)` waits for a voltage.

analog_voltage(Port, Volts) :-
    findall(Type, analog_type(Type), Types),
    sensor_to_read(Port, Types, _),
    sensor_reading(analog_voltage, Port, Volts).

analog_type(Type) :-
    reading_of(analog_voltage, Types, _, _),
    one_of(Types, Type).
