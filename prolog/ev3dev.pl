:- module(ev3dev, []).

/** <module> LEGO EV3 robots from Prolog

A program loads this module. It offers all predicates of

  - library(ev3dev/robot): a robot with two wheels that goes and turns
  - library(ev3dev/motors) and library(ev3dev/motor_settings): single motors
  - library(ev3dev/sensors), library(ev3dev/sensor_wait),
    library(ev3dev/infrared), library(ev3dev/nxt_sensors) and
    library(ev3dev/sensor_info): sensors
  - library(ev3dev/dc_motors) and library(ev3dev/servo_motors): motors without
    rotation sensor and RC servos
  - library(ev3dev/lights), library(ev3dev/battery), library(ev3dev/ports)
  - library(ev3dev/buttons), library(ev3dev/sound) and library(ev3dev/screen):
    the brick's own buttons, speaker and screen
  - library(ev3dev/time): waiting, the clock, stopwatches
  - library(ev3dev/driver), library(ev3dev/device_table) and
    library(ev3dev/files): devices and the files that ev3dev shows of them

On a machine that is not an EV3, the first use of a device starts a simulated
one, unless ev3_sysfs/1 or the environment variable EV3DEV_SYSFS names a
directory. A program loads library(ev3dev/sim) to control the simulator.

Names and argument order are those of the paper "ev3dev-prolog - Prolog API
for LEGO EV3" (Schwarz, Wenzel 2019).

```
?- set_robot(5.6, 10.6, outB, outC).
?- go_cm(30, 100), turn(20, 90).
?- us_dist_cm(_, Distance).
```

Three rules hold everywhere. A port is an atom or a string, `outB` or
`'ev3-ports:outB'`. A call fails if its device is not there or its move is
impossible. A call throws if an argument makes no sense.

## When a call fails {#hints}

If no device can answer a call, or no motor can carry it out, a warning says
why and what is connected: at the prompt in each query, in a program the first
time that a predicate fails for this cause. The flag `ev3dev_hints` is `once`,
`off`, or `error`: then such a call throws an error with the same text, such
as existence_error(motor, Port) or domain_error(speed, Percent).
`debug(ev3dev)` prints each cause, and how moves ended. Predicates that ask
whether a device is there, such as tacho_motor/1, print nothing, and neither
does a sensor whose value is not the one that the call asks for.
*/

:- set_prolog_flag(generate_debug_info, false).
:- use_module(ev3dev/private/load/compiled, []).
:- reexport(ev3dev/private/load/core).
