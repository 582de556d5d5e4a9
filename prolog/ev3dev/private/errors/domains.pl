:- module(ev3dev_domains,
          [ in_range/2,                 % +Domain, +Number
            finite/1,                   % +Number
            allowed/2                   % ?Domain, ?What
          ]).

/** <module> The allowed values of each domain

The ranges of numbers, and for the messages of errors what is allowed.
*/

%!  in_range(+Domain, +Number) is semidet.
%
%   True if Number is one of the numbers that Domain stands for. Only a
%   timeout may be infinite.

in_range(timeout, Number) :-
    !,
    Number >= 0.
in_range(Domain, Number) :-
    finite(Number),
    range(Domain, Number).

range(finite_number, _).
range(positive_number, Number) :-
    Number > 0.
range(nonnegative_number, Number) :-
    Number >= 0.
range(acceleration, Number) :-
    Number >= 1,
    Number =< 1000.
range(direction, Number) :-
    abs(Number) =< 100.
range(duty_limit, Number) :-
    range(speed_ahead, Number).
range(seconds, Number) :-
    Number >= 0.
range(speed, Number) :-
    Number =\= 0,
    abs(Number) =< 100.
range(speed_ahead, Number) :-
    Number > 0,
    Number =< 100.

%!  finite(+Number) is semidet.
%
%   True if Number is neither infinite nor undefined. (The functions `inf` and
%   `nan` came with SWI-Prolog 7.3.15.)

finite(Number) :-
    abs(Number) =< 1.7976931348623157e308.

%!  allowed(?Domain, ?What) is nondet.
%
%   What describes the allowed values of domain_error(Domain, _): a list of
%   all values, or a text.

allowed(acceleration,       'an acceleration in cm/s^2 is from 1 to 1000').
allowed(battery_key,        [voltage, current, percent, type]).
allowed(button,             [up, down, left, right, enter, back]).
allowed(button_event,       [pressed, released]).
allowed(calibration,        [wheels, axle]).
allowed(clock,              [realtime, scaled('Factor'), virtual]).
allowed(color,
        [black, blue, green, yellow, red, white, brown, '#rrggbb']).
allowed(count,              'a count is a whole number, or From-To').
allowed(direction,          'a direction is a number from -100 to 100').
allowed(distinct_ports,     'two different ports are expected').
allowed(drive_option,       [use_gyro, speed, acceleration]).
allowed(duty_limit,
        'a share of the voltage from above 0 to 100 percent is expected').
allowed(eopd_range,         [long, short]).
allowed(finite_number,      'a finite number is expected').
allowed(font,               [tiny, small, medium, large]).
allowed(frequency,          'a tone has from 100 to 10000 Hz').
allowed(hull,
        [circle('Radius'), rectangle('Width', 'Length', 'Offset')]).
allowed(i2c_count,
        'from 1 to 32 bytes are expected, up to register 254').
allowed(i2c_sensor,         'a sensor on the I2C bus is expected').
allowed(ir_button,          [ red_up, red_down, blue_up, blue_down, beacon ]).
allowed(ir_channel,         'a channel is a number from 1 to 4').
allowed(ir_light,           [pulsed, steady]).
allowed(key,
        [ up, down, left, right, enter, back,
          'the port of a touch sensor' ]).
allowed(led_color,
        [ off, on, red, green, blue, amber, orange, yellow, 'Percent',
          levels('Red', 'Green'), levels('Red', 'Green', 'Blue') ]).
allowed(milliseconds,       'a time in milliseconds is a number from 0 on').
allowed(motor_move,
        [ move('Port', 'Speed', 'Angle'), to('Port', 'Speed', 'Angle'),
          for('Port', 'Speed', 'Seconds') ]).
allowed(motor_port,         'a port of motors is one of outA to outD').
allowed(motor_run,          'run(Port, Speed) is expected').
allowed(motor_state,        [ running, ramping, holding, overloaded,
                              stalled ]).
allowed(neighbors,         [4, 8]).
allowed(nonnegative_number, 'a number from 0 on is expected').
allowed(note,               'a note is named like c4 or fs5').
allowed(note_length,        [whole, half, quarter, eighth, sixteenth]).
allowed(nxt_force,          [force]).
allowed(nxt_lamp,           [activate, deactivate]).
allowed(nxt_motor,          ['A', 'B', 'C', 'D']).
allowed(nxt_sensor,         ['S1', 'S2', 'S3', 'S4']).
allowed(on_error,           [throw, continue]).
allowed(pid,                'a term pid(P, I, D) is expected').
allowed(pixels,             'a number from -10000 to 10000 is expected').
allowed(place,              'a place X-Y is expected').
allowed(polarity,           [normal, inversed]).
allowed(port,               'a port is one of in1 to in4 and outA to outD').
allowed(positive_number,    'a number above 0 is expected').
allowed(roadmap_method,     [visibility, prm, rrt_star]).
allowed(screen_bits,        [1, 32]).
allowed(screen_color,       [black, dark_gray, light_gray, white]).
allowed(seconds,            'a time in seconds is a number from 0 on').
allowed(sensor_condition,
        [ 'Reading(Port) < Number', '=<', '>', '>=', '=:=', '=\\=',
          'touch(Port) = pressed', released, bumped ]).
allowed(sensor_value_index, 'the index of a value is an integer from 0 to 7').
allowed(side,               [left, right]).
allowed(simulator_snapshot, 'what sim_snapshot/1 gave is expected').
allowed(stopwatch,          'a stopwatch of stopwatch/1 is expected').
allowed(speed,
        'a speed from -100 to 100 percent other than 0 is expected').
allowed(speed_ahead,
        'a speed from above 0 to 100 percent is expected').
allowed(stop_action,        [coast, brake, hold]).
allowed(tempo,              'a tempo, in quarters a minute, is above 0').
allowed(text_align,         [left, center, right]).
allowed(timeout,
        'a number of seconds from 0 on, or infinite, is expected').
allowed(tone,
        [ tone('Hertz', 'Milliseconds'), note('Note', 'Length'),
          rest('Length') ]).
allowed(volume,             'a volume is a number from 0 to 100').
allowed(echo_option,
        [ half_angle('Degrees'), incidence('Degrees'), miss('Share'),
          spurious('Share') ]).
allowed(localize_start,
        [ unknown, pose('X', 'Y', 'Heading'),
          pose('X', 'Y', 'Heading', 'Sigma') ]).
allowed(mounting_option,    [stops('Min', 'Max')]).
allowed(wheel_option,       [inverted('Boolean'), slip('Share')]).
allowed(world_item,         Items) :-
    allowed(world_or_robot_fact, Items).
allowed(world_or_robot_fact,
        [ wall('X1', 'Y1', 'X2', 'Y2'), box('X', 'Y', 'Width', 'Length'),
          circle('X', 'Y', 'Radius'), patch, line, lamp, beacon ]).
