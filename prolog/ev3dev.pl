:- module(ev3dev, []).

/** <module> LEGO EV3 robots from Prolog

The one module a program loads. It offers all predicates of

  - library(ev3dev/robot): a robot with two wheels that goes and turns
  - library(ev3dev/motors) and library(ev3dev/sensors): single motors and
    sensors; library(ev3dev/infrared), library(ev3dev/more_sensors) and
    library(ev3dev/sensor_info): more of them
  - library(ev3dev/motor_moves) and library(ev3dev/motor_settings): all else
    that a motor can do
  - library(ev3dev/dc_motors) and library(ev3dev/servo_motors): motors without
    rotation sensor and RC servos
  - library(ev3dev/lights), library(ev3dev/battery), library(ev3dev/ports)
  - library(ev3dev/keys), library(ev3dev/sound) and library(ev3dev/screen):
    the brick's own keys, speaker and screen
  - library(ev3dev/driver) and library(ev3dev/dev): devices and the files
    that ev3dev shows of them

A machine that is no EV3 gets a simulated one at the first use of a device,
unless ev3_sysfs/1 or the environment variable EV3DEV_SYSFS names a directory.
Its predicates are in library(ev3dev/sim), which is loaded apart.

Names and argument order are those of the paper "ev3dev-prolog - Prolog API
for LEGO EV3" (Schwarz, Wenzel 2019).

```
?- set_robot(5.6, 10.6, outB, outC).
?- go_cm(30, 100), turn(20, 90).
?- us_dist_cm(_, Distance).
```

Three rules hold everywhere. A port is an atom, `outB` or
`'ev3-ports:outB'`. What is asked of a device that is not there fails, and so
does a move that is impossible; `debug(ev3dev)` tells what is missing, or why
a motor does not run. What is no sensible argument throws.
*/

:- use_module(ev3dev/scripts, []).
:- reexport(ev3dev/driver).
:- reexport(ev3dev/motors).
:- reexport(ev3dev/sensors).
:- reexport(ev3dev/robot).

% The rest is loaded when it is first used.
:- use_module(ev3dev/on_demand, [on_demand/2]).

:- on_demand(library(ev3dev/motor_moves),
             [ motor_run_timed/3, motor_run_timed/4, motor_run_to/3,
               motor_run_to/4, motor_run_direct/2 ]).
:- on_demand(library(ev3dev/motor_settings),
             [ linear_actuator/1, motor_position/2, motor_duty/2,
               motor_polarity/2, motor_ramps/3, motor_speed_pid/2,
               motor_hold_pid/2 ]).
:- on_demand(library(ev3dev/dc_motors),
             [ dc_motor_run/2, dc_motor_run_timed/3, dc_motor_run_timed/4,
               dc_motor_run_direct/2, dc_motor_stop/1, dc_motor_stop/2,
               dc_motor_duty/2, dc_motor_states/2, dc_motor_polarity/2,
               dc_motor_ramps/3, dc_motor_attribute/3 ]).
:- on_demand(library(ev3dev/servo_motors),
             [ servo_motor_position/2, servo_motor_angle/2,
               servo_motor_float/1, servo_motor_polarity/2,
               servo_motor_rate/2, servo_motor_pulses/4,
               servo_motor_attribute/3 ]).
:- on_demand(library(ev3dev/infrared),
             [ ir_remote/3, ir_beacon/4, ir_dist_cm/2, ir_seeker/2,
               ir_seeker/4 ]).
:- on_demand(library(ev3dev/more_sensors),
             [ nxt_light/2, nxt_ambient/2, nxt_sound/2, temperature/2,
               target_temperature/2, pressure/2, compass/2, ht_color/2,
               ht_color_rgb/2, ht_gyro_rate/2, ht_eopd/3, acceleration/4,
               rotation_rate/4, tilt/4, magnetic_field/4, angle_deg/2,
               angle_total/2, angle_rpm/2, light_row/2, line_leader/3,
               energy_meter/4 ]).
:- on_demand(library(ev3dev/sensor_info),
             [ sensor_info/2, sensor_mode/6, sensor_type/2,
               sensor_command/2 ]).
:- on_demand(library(ev3dev/lights),
             [ led/1, led/2, led_trigger/2, led_triggers/2, led_blink/3 ]).
:- on_demand(library(ev3dev/battery),
             [ battery/2 ]).
:- on_demand(library(ev3dev/ports),
             [ lego_port/1, port_mode/2, port_modes/2, port_status/2,
               port_device/2 ]).
:- on_demand(library(ev3dev/dev),
             [ ev3_dev/1 ]).
:- on_demand(library(ev3dev/keys),
             [ button/1, button_wait/2, button_wait/3, button_events/1 ]).
:- on_demand(library(ev3dev/sound),
             [ tone/2, tones/1, tones/2, say/1, play/1, volume/1,
               sound_stop/0 ]).
:- on_demand(library(ev3dev/screen),
             [ screen_clear/0, screen_point/2, screen_point/3,
               screen_line/4, screen_line/5, screen_rectangle/4,
               screen_rectangle/5, screen_circle/3, screen_circle/4,
               screen_arc/5, screen_arc/6, screen_text/3, screen_text/4,
               screen_image/3, screen_show/0, screen_png/1 ]).
