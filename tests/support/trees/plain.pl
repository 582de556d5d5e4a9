:- module(plain_tree,
          [ plain_start/1,              % -Root
            plain_stop/1,               % +Root
            plain_plug/3,               % +Port, +Type, +Directory
            plain_unplug/1,             % +Directory
            plain_written/3,            % +Directory, +Type, -Attributes
            class/3,                    % +Type, -Class, -Prefix
            read_line_of/2,             % +File, -Text
            write_line_to/2             % +File, +Text
          ]).
:- asserta(user:file_search_path(library, prolog)).
:- use_module(library(ev3dev)).
:- use_module(library(filesex)).
:- use_module(library(lists)).
:- use_module(library(readutil)).

/** <module> Plain directory trees shaped like ev3dev's

A tree holds files as the kernel shows them after plugging in, and stores what
is written. Nothing in it moves.
*/

% In memory where one can, as it is a hundred files for each test.
:- initialization(
       (   getenv('TMPDIR', _)
       ->  true
       ;   catch(access_file('/dev/shm', write), _, fail)
       ->  set_prolog_flag(tmp_dir, '/dev/shm')
       ;   true
       )).

plain_start(Root) :-
    tmp_file(ev3dev, Root),
    make_directory_path(Root).

plain_stop(Root) :-
    delete_tree(100, Root).

%   The process that stays after a crash may write a file once more, while the
%   others are deleted.

delete_tree(Tries, Root) :-
    catch(delete_directory_and_contents(Root), Error, true),
    (   var(Error)
    ->  true
    ;   Tries > 1,
        exists_directory(Root)
    ->  sleep(0.05),
        Tries1 is Tries - 1,
        delete_tree(Tries1, Root)
    ;   throw(Error)
    ).

%!  plain_plug(+Port, +Type, +Directory)
%
%   Plug a device in: its directory appears. The Port of a port itself is
%   port(Port). A `led` or a `battery` has no port, but a name.

plain_plug(Port, Type, Directory) :-
    once(class(Type, Class, Prefix)),
    make_directory_path(Directory),
    forall(attribute(Class, Type, Attribute, Text),
           write_text(Directory, Attribute, Text)),
    (   Prefix == named
    ->  true
    ;   write_text(Directory, driver_name, Type),
        ( Port = port(Short) -> true ; Short = Port ),
        format(atom(Address), "ev3-ports:~w", [Short]),
        % Last: until it has an address it is not a device.
        write_text(Directory, address, Address)
    ).

plain_unplug(Directory) :-
    delete_directory_and_contents(Directory).

%!  plain_written(+Directory, +Type, -Attributes)
%
%   Attributes of a device that differ from what they are after plugging in.

plain_written(Directory, Type, Attributes) :-
    once(class(Type, Class, _)),
    findall(Attribute=Text,
            ( attribute(Class, Type, Attribute, Text0),
              read_text(Directory, Attribute, Text),
              \+ format(atom(Text), "~w", [Text0])
            ),
            Attributes).

read_text(Directory, Attribute, Text) :-
    atomic_list_concat([Directory, Attribute], /, Path),
    read_line_of(Path, Text).

write_text(Directory, Attribute, Text) :-
    atomic_list_concat([Directory, Attribute], /, Path),
    file_directory_name(Path, Group),
    make_directory_path(Group),
    write_line_to(Path, Text).

%!  read_line_of(+File, -Text)
%
%   Text is an atom: the first line, as a longer text may be cut only a moment
%   after the new one was written.

read_line_of(Path, Text) :-
    setup_call_cleanup(
        open(Path, read, Stream),
        read_line_to_string(Stream, Line),
        close(Stream)),
    (   Line == end_of_file
    ->  Text = ''
    ;   atom_string(Text, Line)
    ).

%!  write_line_to(+File, +Text)
%
%   A text that is there already is cut afterwards, so that nobody who reads in
%   between finds an empty file.

write_line_to(Path, Text) :-
    setup_call_cleanup(
        open(Path, update, Stream),
        ( format(Stream, "~w~n", [Text]),
          flush_output(Stream),
          set_end_of_stream(Stream)
        ),
        close(Stream)).

% ---------------- DEVICES

class(Type, 'tacho-motor', linear) :-
    linear(Type, _).
class(Type, 'tacho-motor', motor) :-
    motor(Type, _).
class('rcx-motor', 'dc-motor', motor).
class('ms-8ch-servo', 'servo-motor', motor).
class('ev3-input-port', 'lego-port', port).
class('ev3-output-port', 'lego-port', port).
class(led, leds, named).
class(battery, power_supply, named).
class(Type, 'lego-sensor', sensor) :-
    sensor(Type, _, _, _).

motor('lego-ev3-l-motor', 1050).
motor('lego-ev3-m-motor', 1560).
motor('lego-nxt-motor',   1020).
motor(Type,               24) :-
    linear(Type, _).

linear('act-l12-ev3-50',  100).
linear('act-l12-ev3-100', 200).

sensor('lego-ev3-color', 'COL-REFLECT COL-AMBIENT COL-COLOR REF-RAW RGB-RAW COL-CAL', 0, 42).
sensor('lego-ev3-us',    'US-DIST-CM US-DIST-IN US-LISTEN US-SI-CM US-SI-IN',         1, 843).
sensor('lego-ev3-gyro',  'GYRO-ANG GYRO-RATE GYRO-FAS GYRO-G&A GYRO-CAL',             0, 0).
sensor('lego-ev3-touch', 'TOUCH',                                                     0, 0).
sensor('lego-ev3-ir',    'IR-PROX IR-SEEK IR-REMOTE IR-REM-A IR-S-ALT IR-CAL',        0, 35).
sensor('ev3-analog-01',  'ANALOG',                                                    3, 0).
sensor('lego-nxt-temp',  'NXT-TEMP-C NXT-TEMP-F',                                     1, 215).
sensor(Type, Modes, Decimals, 0) :-
    ev3dev:sensor_type(Type, _),
    \+ sub_atom(Type, 0, _, _, 'lego-ev3'),
    \+ memberchk(Type, ['lego-nxt-temp', 'ev3-analog-01']),
    findall(Mode, sensor_mode(Type, Mode, _, _, _, _), Names),
    atomic_list_concat(Names, ' ', Modes),
    once(sensor_mode(Type, _, _, Decimals, _, _)).

attribute('tacho-motor', Type, max_speed, Speed) :-
    motor(Type, Speed).
attribute('tacho-motor', Type, count_per_m, 2000) :-
    linear(Type, _).
attribute('tacho-motor', Type, full_travel_count, Count) :-
    linear(Type, Count).
attribute('tacho-motor', Type, count_per_rot, 360) :-
    \+ linear(Type, _).
attribute('tacho-motor', _, Attribute, Text) :-
    motor_attribute_text(Attribute, Text).
attribute('dc-motor', _, Attribute, Text) :-
    dc_motor_attribute_text(Attribute, Text).
attribute('servo-motor', _, Attribute, Text) :-
    servo_motor_attribute_text(Attribute, Text).
attribute('lego-port', Type, Attribute, Text) :-
    port_attribute_text(Attribute, Type, Text).
attribute(leds, _, Attribute, Text) :-
    led_attribute_text(Attribute, Text).
attribute(power_supply, _, Attribute, Text) :-
    battery_attribute_text(Attribute, Text).
attribute('lego-sensor', Type, Attribute, Text) :-
    sensor(Type, Modes, Decimals, Value),
    sensor_attribute_text(Attribute, Modes, Decimals, Value, Text).

motor_attribute_text(command, '').
motor_attribute_text(commands,
    'run-forever run-to-abs-pos run-to-rel-pos run-timed run-direct stop reset').
motor_attribute_text(duty_cycle, 0).
motor_attribute_text(duty_cycle_sp, 0).
motor_attribute_text(polarity, normal).
motor_attribute_text('hold_pid/Kp', 80000).
motor_attribute_text('hold_pid/Ki', 0).
motor_attribute_text('hold_pid/Kd', 0).
motor_attribute_text('speed_pid/Kp', 1000).
motor_attribute_text('speed_pid/Ki', 60).
motor_attribute_text('speed_pid/Kd', 0).
motor_attribute_text(position, 0).
motor_attribute_text(position_sp, 0).
motor_attribute_text(ramp_down_sp, 0).
motor_attribute_text(ramp_up_sp, 0).
motor_attribute_text(speed, 0).
motor_attribute_text(speed_sp, 0).
motor_attribute_text(state, '').
motor_attribute_text(stop_action, coast).
motor_attribute_text(stop_actions, 'coast brake hold').
motor_attribute_text(time_sp, 0).

dc_motor_attribute_text(command, '').
dc_motor_attribute_text(commands, 'run-forever run-timed run-direct stop').
dc_motor_attribute_text(duty_cycle, 0).
dc_motor_attribute_text(duty_cycle_sp, 0).
dc_motor_attribute_text(polarity, normal).
dc_motor_attribute_text(ramp_down_sp, 0).
dc_motor_attribute_text(ramp_up_sp, 0).
dc_motor_attribute_text(state, '').
dc_motor_attribute_text(stop_action, '').
dc_motor_attribute_text(stop_actions, 'coast brake').
dc_motor_attribute_text(time_sp, 0).

servo_motor_attribute_text(command, '').
servo_motor_attribute_text(max_pulse_sp, 2500).
servo_motor_attribute_text(mid_pulse_sp, 1500).
servo_motor_attribute_text(min_pulse_sp, 500).
servo_motor_attribute_text(polarity, normal).
servo_motor_attribute_text(position_sp, 0).
servo_motor_attribute_text(rate_sp, 0).
servo_motor_attribute_text(state, '').

port_attribute_text(mode, _, auto).
port_attribute_text(modes, 'ev3-input-port',
    'auto nxt-analog nxt-color nxt-i2c other-i2c ev3-analog ev3-uart other-uart raw').
port_attribute_text(modes, 'ev3-output-port', 'auto tacho-motor dc-motor led raw').
port_attribute_text(set_device, _, '').
port_attribute_text(status, 'ev3-input-port', 'no-sensor').
port_attribute_text(status, 'ev3-output-port', 'no-motor').

led_attribute_text(brightness, 0).
led_attribute_text(max_brightness, 255).
led_attribute_text(trigger, '[none] mmc0 timer heartbeat default-on transient rfkill0').

battery_attribute_text(current_now, 180000).
battery_attribute_text(scope, 'System').
battery_attribute_text(technology, 'Li-ion').
battery_attribute_text(type, 'Battery').
battery_attribute_text(voltage_max_design, 84000000).
battery_attribute_text(voltage_min_design, 60000000).
battery_attribute_text(voltage_now, 7600000).

sensor_attribute_text(command, _, _, _, '').
sensor_attribute_text(commands, _, _, _, '').
sensor_attribute_text(decimals, _, Decimals, _, Decimals).
sensor_attribute_text(mode, Modes, _, _, Mode) :-
    atomic_list_concat([Mode|_], ' ', Modes).
sensor_attribute_text(modes, Modes, _, _, Modes).
sensor_attribute_text(num_values, _, _, _, 1).
sensor_attribute_text(units, _, _, _, '').
sensor_attribute_text(value0, _, _, Value, Value).
sensor_attribute_text(Attribute, _, _, _, 0) :-
    member(Attribute, [ value1, value2, value3, value4, value5, value6,
                        value7 ]).
