:- module(ev3dev_domains,
          [ allowed/2                   % ?Domain, ?What
          ]).

/** <module> The allowed values of each domain

For the messages of errors, in one table.
*/

%!  allowed(?Domain, ?What) is nondet.
%
%   What describes the allowed values of domain_error(Domain, _): a list of
%   all values, or a text.

allowed(battery_key,        [voltage, current, percent, type]).
allowed(button,             [up, down, left, right, enter, back]).
allowed(button_event,       [pressed, released]).
allowed(calibration,        [wheels, axle]).
allowed(clock,              [realtime, scaled('Factor'), virtual]).
allowed(direction,          'a direction is a number from -100 to 100').
allowed(distinct_ports,     'two different ports are expected').
allowed(drive_option,       [use_gyro, speed, acceleration]).
allowed(eopd_range,         [long, short]).
allowed(finite_number,      'a finite number is expected').
allowed(font,               [tiny, small, medium, large]).
allowed(frequency,          'a tone has from 100 to 10000 Hz').
allowed(ir_channel,         'a channel is a number from 1 to 4').
allowed(ir_light,           [pulsed, steady]).
allowed(led_color,
        [ off, on, red, green, blue, amber, orange, yellow, 'Percent',
          levels('Red', 'Green'), levels('Red', 'Green', 'Blue') ]).
allowed(milliseconds,       'a time in milliseconds is a number from 0 on').
allowed(motor_state,        [ running, ramping, holding, overloaded,
                              stalled ]).
allowed(neighbours,         [4, 8]).
allowed(note,               'a note is named like c4 or fs5').
allowed(note_length,        [whole, half, quarter, eighth, sixteenth]).
allowed(pid,                'a term pid(P, I, D) is expected').
allowed(pixels,             'a number from -10000 to 10000 is expected').
allowed(polarity,           [normal, inversed]).
allowed(positive_number,    'a number above 0 is expected').
allowed(radius,             'a radius is a number above 0').
allowed(roadmap_method,     [visibility, prm, rrt_star]).
allowed(screen_bits,        [1, 32]).
allowed(screen_color,       [black, dark_gray, light_gray, white]).
allowed(seconds,            'a time in seconds is a number from 0 on').
allowed(sensor_value_index, 'the index of a value is an integer from 0 to 7').
allowed(side,               [left, right]).
allowed(speed,              'a speed in percent from -100 to 100, not 0').
allowed(stop_action,        [coast, brake, hold]).
allowed(tempo,              'a tempo, in quarters a minute, is above 0').
allowed(text_align,         [left, center, right]).
allowed(timeout,            'a number of seconds from 0 on, or infinite').
allowed(tone,
        [ tone('Hertz', 'Milliseconds'), note('Note', 'Length'),
          rest('Length') ]).
allowed(volume,             'a volume is a number from 0 to 100').
