:- module(ev3dev_help_words,
          [ words_for/2                 % ?Words, ?Names
          ]).

/** <module> Other words for what predicates do

A person who asks apropos/1 may know these words, and neither the names nor
the first sentences of the comments.
*/

%!  words_for(?Words, ?Names) is nondet.
%
%   apropos/1 is to find the predicates with these Names by each of Words, the
%   first of them first.

words_for([forward, forwards, backward, backwards, straight, ahead, reverse],
          [go_cm, go, motor_run, jog]).
words_for([drive, move, travel, walk],
          [ go_cm, go, turn, arc_cm, steer, drive_cm, go_to, stop, set_robot,
            motor_run, jog
          ]).
words_for([turn, rotate, rotation, spin, pivot],
          [turn, face, motor_run, motors_turn, arc_cm, gyro_ang]).
words_for([left, right, clockwise, counterclockwise],
          [turn, steer, arc_cm, face]).
words_for([curve, circle, bend, radius, steering],
          [arc_cm, arc, steer, drive_cm, screen_circle, screen_arc]).
words_for([stop, halt, brake, end, emergency],
          [stop, motor_stop, stop_all_motors, until, sound_stop]).
words_for([robot, setup, configure, wheel, axle, diameter, chassis, build],
          [set_robot, robot, calibrate]).
words_for([motor, engine, wheel], [motor_run, motors_run, motor_stop]).
words_for([speed, velocity, fast, slow, quick, power],
          [ go, motor_run, motor_speed, drive_option, motor_run_direct,
            max_speed, motor_ramps
          ]).
words_for([accelerate, acceleration, ramp, smooth],
          [motor_ramps, drive_option]).
words_for([encoder, tacho, tachometer, rotation, revolution, count],
          [motor_position, motor_reset, motor_run, position]).
words_for([arm, grab, gripper, claw, lift, hand],
          [grip, release, motor_run, motor_run_to, motor_run_until_stalled]).
words_for([stall, stuck, block, blocked, jam],
          [motor_run_until_stalled, motor_wait, motor_states, sim_jam]).
words_for([distance, far, near, range, proximity, obstacle, wall, sonar,
           ultrasonic, ultrasound, centimeter, cm],
          [ us_dist_cm, us_dist_inches, ir_dist_cm, ir_prox, sensor_wait,
            go_cm
          ]).
words_for([touch, bump, bumper, contact, collision, press, pressed],
          [touch, sensor_wait, touch_sensor, sim_press]).
words_for([color, red, green, blue],
          [ col_color, color_name, col_rgb_raw, col_rgb, col_hsv, led,
            ht_color
          ]).
words_for([light, bright, brightness, dark, intensity, reflect, reflection],
          [col_reflect, col_ambient, nxt_light, light_sensor]).
words_for([light, lamp, bulb, blink, flash], [led, led_blink]).
words_for([line, edge, track, black, white, follow],
          [col_reflect, light_row, line_leader, col_white]).
words_for([sound, noise, beep, music, melody, song, note, tune, speaker,
           loud],
          [ tone, tones, say, play, volume, sound_wait, sound_stop, nxt_sound
          ]).
words_for([speak, speech, talk, voice], [say]).
words_for([angle, degree, heading, direction, orientation],
          [ gyro_ang, turn, motor_run, motor_position, pose, face, compass,
            angle_deg
          ]).
words_for([gyroscope, tilt, balance], [gyro_ang, gyro_rate, tilt]).
words_for([reset, zero, calibrate], [gyro_reset, motor_reset, set_pose]).
words_for([wait, sleep, pause, delay, second],
          [ wait, sensor_wait, until, button_wait, motor_wait, drive_wait,
            sim_wait, after
          ]).
words_for([time, timer, clock, watch, measure],
          [stopwatch, elapsed, ev3_time, wait, after, every, sim_time]).
words_for([where, location, coordinate, position, odometry, localization],
          [pose, set_pose, go_to, sim_pose]).
words_for([goto, target, goal, waypoint, navigate, navigation],
          [go_to, follow, navigate_to, plan_and_go_to]).
words_for([path, way, route, maze, map, search, obstacle, shortest],
          [plan_and_go_to, set_grid, roadmap_path, navigate_to, plan]).
words_for([button, key, keyboard, arrow],
          [button, button_wait, button_events, jog]).
words_for([screen, display, lcd, print, write, text, draw, picture, image],
          [ screen_print, screen_text, screen_show, screen_clear,
            screen_image, screen_line
          ]).
words_for([battery, charge, voltage, power], [battery]).
words_for([remote, infrared, beacon], [ir_remote, ir_beacon, ir_prox]).
words_for([device, connected, plugged, port, list, find],
          [ev3_devices, port_status, tacho_motor, lego_sensor]).
words_for([sensor, read, measure, value],
          [ ev3_devices, sensor_reading, sensor_value, sensor_info,
            sensor_wait
          ]).
words_for([simulator, simulation, simulate, virtual, world, room],
          [sim_start, with_sim, sim_stop, sim_pose, sim_svg]).
words_for([browser, window, picture, look, see, show, graph, chart, plot],
          [view, view_watch, view_value, sim_svg]).
words_for([event, react, reactive, when, whenever, interrupt, callback],
          [on, until, behave, every, sensor_wait]).
words_for([parallel, concurrent, simultaneous, same, thread, task],
          [both, race, on, every, motors_run, motors_turn]).
words_for([behavior, rule, subsumption, state], [behave, set_state, become]).
words_for([policy, feedback], [grid_policy, grid_action]).
words_for([controller, layer, fluent], [control, layer, val, was]).
words_for([loop, repeat, forever, endless, periodic],
          [every, run_forever, behave]).
words_for([log, history, record, explain, debug],
          [why, journal, reasoning, view_mark, because]).
words_for([backtrack, backtracking, choice, trace, cut, think, fail, false],
          [reasoning, reasoning_text]).
words_for([undo, reset, save, load], [sim_snapshot, sim_restore]).
