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
range(jaw_angle, Number) :-
    Number > 0.
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

allowed(acceleration,       'an acceleration must be from 1 to 1000 cm/s^2').
allowed(area,
        'an area must be a list of three corners or more, or \c
         circle(X, Y, Radius)').
allowed(battery_key,        [voltage, current, percent, type]).
allowed(button,             [up, down, left, right, enter, back]).
allowed(button_event,       [pressed, released]).
allowed(calibration,        [wheels, axle]).
allowed(clock,              [realtime, scaled('Factor'), virtual]).
allowed(color,
        [black, blue, green, yellow, red, white, brown, '#rrggbb']).
allowed(count,              'a count must be a whole number, or From-To').
allowed(direction,          'a direction must be from -100 to 100').
allowed(distinct_ports,     'the two ports must be different').
allowed(drive_option,       [use_gyro, speed, acceleration]).
allowed(duty_limit,
        'a share of the voltage must be above 0 and at most 100 percent').
allowed(eopd_range,         [long, short]).
allowed(finite_number,      'the number must be finite').
allowed(font,               [tiny, small, medium, large]).
allowed(frequency,          'a tone must have from 100 to 10000 Hz').
allowed(hull,
        [circle('Radius'), rectangle('Width', 'Length', 'Offset')]).
allowed(i2c_count,
        'the count must be from 1 to 32 bytes, up to register 254').
allowed(i2c_sensor,         'the sensor must be on the I2C bus').
allowed(ir_button,          [ red_up, red_down, blue_up, blue_down, beacon ]).
allowed(ir_channel,         'a channel must be a number from 1 to 4').
allowed(ir_light,           [pulsed, steady]).
allowed(key,
        [ up, down, left, right, enter, back,
          'the port of a touch sensor' ]).
allowed(led_color,
        [ off, on, red, green, blue, amber, orange, yellow, 'Percent',
          levels('Red', 'Green'), levels('Red', 'Green', 'Blue') ]).
allowed(milliseconds,       'a time in milliseconds must be 0 or more').
allowed(motor_move,
        [ move('Port', 'Speed', 'Angle'), to('Port', 'Speed', 'Angle'),
          for('Port', 'Speed', 'Seconds') ]).
allowed(motor_port,         'a motor port must be one of outA to outD').
allowed(motor_run,          'run(Port, Speed) is expected').
allowed(motor_state,        [ running, ramping, holding, overloaded,
                              stalled ]).
allowed(neighbors,         [4, 8]).
allowed(policy_method,     [value_iteration, navigation_function]).
allowed(nonnegative_number, 'the number must be 0 or more').
allowed(note,               'a note must have a name such as c4 or fs5').
allowed(note_length,        [whole, half, quarter, eighth, sixteenth]).
allowed(nxt_force,          [force]).
allowed(nxt_lamp,           [activate, deactivate]).
allowed(nxt_motor,          ['A', 'B', 'C', 'D']).
allowed(nxt_sensor,         ['S1', 'S2', 'S3', 'S4']).
allowed(on_error,           [throw, continue]).
allowed(pid,                'the constants must be a term pid(P, I, D)').
allowed(pixels,             'the number must be from -10000 to 10000').
allowed(place,              'a place must be X-Y').
allowed(polarity,           [normal, inversed]).
allowed(port,
        'a port must be one of in1 to in4 and outA to outD').
allowed(positive_number,    'the number must be above 0').
allowed(roadmap_method,
        [visibility, prm, rrt, rrt_bidirectional, rrt_star]).
allowed(screen_bits,        [1, 32]).
allowed(screen_color,       [black, dark_gray, light_gray, white]).
allowed(seconds,            'a time in seconds must be 0 or more').
allowed(sensor_condition,
        [ 'Reading(Port) < Number', '=<', '>', '>=', '=:=', '=\\=',
          'touch(Port) = pressed', released, bumped ]).
allowed(sensor_value_index,
        'the index of a value must be an integer from 0 to 7').
allowed(seeds,
        'seeds must be a whole number, a list of them, or From-To with \c
         From not above To').
allowed(side,               [left, right]).
allowed(simulator_snapshot, 'a snapshot must come from sim_snapshot/1').
allowed(stopwatch,          'a stopwatch must come from stopwatch/1').
allowed(speed,
        'a speed must be from -100 to 100 percent and must not be 0').
allowed(speed_ahead,
        'a speed must be above 0 and at most 100 percent').
allowed(stop_action,        [coast, brake, hold]).
allowed(tempo,              'a tempo, in quarters a minute, must be above 0').
allowed(text_align,         [left, center, right]).
allowed(timeout,
        'a timeout must be 0 or more seconds, or infinite').
allowed(tone,
        [ tone('Hertz', 'Milliseconds'), note('Note', 'Length'),
          rest('Length') ]).
allowed(volume,             'a volume must be from 0 to 100').
allowed(echo_option,
        [ half_angle('Degrees'), incidence('Degrees'), miss('Share'),
          spurious('Share') ]).
allowed(localize_start,
        [ unknown, pose('X', 'Y', 'Heading'),
          pose('X', 'Y', 'Heading', 'Sigma') ]).
allowed(mounting_option,    [stops('Min', 'Max')]).
allowed(jaws_option,
        [ closes('Direction'), turn('Degrees'), force('Percent') ]).
allowed(jaw_angle,          'an angle of jaws must be above 0 degrees').
allowed(jaw_direction,      [positive, negative]).
allowed(gripper_option,
        [ opening('Cm'), force('Newton'), torque('NewtonMeter'),
          pivot('Boolean'), lifts('Boolean') ]).
allowed(sensor_option,      [looks(ahead), looks(down)]).
allowed(thing_option,
        [ mass('Kg'), friction('Share'), height('Cm'), rolls('Boolean'),
          bounces('Share'), color('Color'), name('Name') ]).
allowed(wheel_option,       [inverted('Boolean'), slip('Share')]).
