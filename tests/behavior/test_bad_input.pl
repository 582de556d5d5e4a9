:- use_module('../support/cases').
:- use_module('../support/trees').
:- use_module('../support/odd_terms').
:- use_module('../support/old_prolog').
:- use_module(library(ev3dev)).
:- use_module(library(ev3dev/journal)).
:- use_module(library(ev3dev/navigation)).
:- use_module(library(ev3dev/roadmap)).
:- use_module(library(ev3dev/sim)).
:- use_module(library(apply)).
:- use_module(library(filesex)).
:- use_module(library(lists)).
:- use_module(library(readutil)).
:- use_module(library(time)).

                /*******************************
                *          ANY TERMS           *
                *******************************/

% Each exported predicate with odd terms for each argument in turn, beside
% sensible ones. It may do whatever it likes but throw what is no ISO error,
% or not return.

:- begin_tests(any_terms).

% Sensible arguments by what they are called.
sensible(port, outB).
sensible(sensor, in1).
sensible(file, '/nowhere/file').
sensible(out, _).
sensible(number, 80).
sensible(attribute, speed_sp).
sensible(mode, 'US-DIST-CM').
sensible(index, 0).
sensible(options, []).
sensible(quick, [wait(false)]).
sensible(action, brake).
sensible(flag, stalled).
sensible(command, stop).
sensible(type, 'lego-ev3-us').
sensible(pattern, '/sys/class/*/*').
sensible(runs, [run(outB, 20)]).
sensible(moves, [move(outB, 20, 9)]).
sensible(reading, touch).
sensible(seconds, 1).
sensible(watch, Watch) :-
    stopwatch(Watch).
sensible(polarity, inversed).
sensible(pid, pid(1, 2, 3)).
sensible(dc, outD).
sensible(servo, 'in2:i2c88:sv1').
sensible(light, left).
sensible(colour, amber).
sensible(trigger, heartbeat).
sensible(key, voltage).
sensible(lego_port, outA).
sensible(button, enter).
sensible(event, pressed).
sensible(at_once, [timeout(0.01)]).

% These wait for as long as an argument says, by the wall on a mount. Their
% cousins with options are called there, too.
call_for_seconds(motor_run_timed(port, number, out)).
call_for_seconds(motor_run_to(port, number, out)).
call_for_seconds(dc_motor_run_timed(dc, number, out)).

% Calls that return at once on a tree where nothing moves.
call_of(subsystem_detect(port, type, out, pattern)).
call_of(file_read(file, out)).
call_of(file_write(file, number)).
call_of(tacho_motor(port)).
call_of(tacho_motor(port, out)).
call_of(tacho_motor(port, out, out)).
call_of(ev3_large_motor(port)).
call_of(ev3_medium_motor(port)).
call_of(nxt_motor(port)).
call_of(servo_motor(port)).
call_of(lego_sensor(sensor)).
call_of(lego_sensor(sensor, out)).
call_of(lego_sensor(sensor, out, out)).
call_of(motor_attribute(port, attribute, number)).
call_of(sensor_attribute(sensor, attribute, out)).
call_of(command(port, command)).
call_of(command_file(port, out)).
call_of(speed(port, out)).
call_of(speed_file(port, out)).
call_of(speed_sp(port, number)).
call_of(speed_sp_file(port, out)).
call_of(max_speed(port, out)).
call_of(max_speed_file(port, out)).
call_of(position(port, number)).
call_of(position_file(port, out)).
call_of(position_sp(port, number)).
call_of(position_sp_file(port, out)).
call_of(state(port, out)).
call_of(state_file(port, out)).
call_of(motor_states(port, out)).
call_of(mode(sensor, mode)).
call_of(mode_file(sensor, out)).
call_of(value(sensor, index, out)).
call_of(value_file(sensor, index, out)).
call_of(decimals(sensor, out)).
call_of(decimals_file(sensor, out)).
call_of(light_sensor(sensor)).
call_of(ultrasonic_sensor(sensor)).
call_of(gyro_sensor(sensor)).
call_of(touch_sensor(sensor)).
call_of(infrared_sensor(sensor)).
call_of(col_ambient(sensor, out)).
call_of(col_reflect(sensor, out)).
call_of(col_color(sensor, out)).
call_of(col_rgb_raw(sensor, out)).
call_of(col_rgb_raw(sensor, out, out, out)).
call_of(us_dist_cm(sensor, out)).
call_of(us_dist_inches(sensor, out)).
call_of(us_listen(sensor, out)).
call_of(gyro_ang(sensor, out)).
call_of(gyro_rate(sensor, out)).
call_of(gyro_ang_rate(sensor, out, out)).
call_of(gyro_reset(sensor)).
call_of(touch(sensor, out)).
call_of(ir_prox(sensor, out)).
call_of(sensor_reading(reading, sensor, out)).
call_of(sensor_value(sensor, mode, index, out)).
call_of(sensor_values(sensor, mode, out)).
call_of(ir_remote(sensor, index, out)).
call_of(ir_beacon(sensor, index, out, out)).
call_of(ir_dist_cm(sensor, out)).
call_of(ir_seeker(sensor, out)).
call_of(ir_seeker(sensor, mode, out, out)).
call_of(nxt_light(sensor, out)).
call_of(nxt_ambient(sensor, out)).
call_of(nxt_sound(sensor, out)).
call_of(temperature(sensor, out)).
call_of(target_temperature(sensor, out)).
call_of(pressure(sensor, out)).
call_of(compass(sensor, out)).
call_of(ht_color(sensor, out)).
call_of(ht_color_rgb(sensor, out)).
call_of(ht_gyro_rate(sensor, out)).
call_of(angle_deg(sensor, out)).
call_of(angle_total(sensor, out)).
call_of(angle_rpm(sensor, out)).
call_of(light_row(sensor, out)).
call_of(sensor_info(sensor, out)).
call_of(ht_eopd(sensor, mode, out)).
call_of(acceleration(sensor, out, out, out)).
call_of(rotation_rate(sensor, out, out, out)).
call_of(tilt(sensor, out, out, out)).
call_of(magnetic_field(sensor, out, out, out)).
call_of(line_leader(sensor, out, out)).
call_of(energy_meter(sensor, out, out, out)).
call_of(sensor_mode(out, mode, out, out, out, out)).
call_of(sensor_type(out, out)).
call_of(sensor_command(sensor, mode)).
call_of(adjust_val(sensor, index, out)).
call_of(motor_run(port, number)).
call_of(motor_run(port, number, number, quick)).
call_of(motors_run(runs)).
call_of(motors_turn(moves, quick)).
call_of(motor_start(port)).
call_of(motor_stop(port)).
call_of(motor_stop(port, action)).
call_of(motor_reset(port)).
call_of(run_forever(port, number)).
call_of(speed_adjust(number, port, out)).
call_of(motor_wait_while(port, flag)).
call_of(motor_wait(port, options, out)).
call_of(motor_run_timed(port, number, seconds, quick)).
call_of(motor_run_to(port, number, number, quick)).
call_of(motor_run_direct(port, number)).
call_of(linear_actuator(port)).
call_of(motor_position(port, number)).
call_of(motor_speed(port, out)).
call_of(motor_gear(port, number)).
call_of(motor_duty(port, out)).
call_of(motor_polarity(port, polarity)).
call_of(motor_ramps(port, number, number)).
call_of(motor_speed_pid(port, pid)).
call_of(motor_hold_pid(port, pid)).
call_of(dc_motor(dc)).
call_of(dc_motor_run(dc, number)).
call_of(dc_motor_run_timed(dc, number, seconds, quick)).
call_of(dc_motor_run_direct(dc, number)).
call_of(dc_motor_stop(dc)).
call_of(dc_motor_stop(dc, action)).
call_of(dc_motor_duty(dc, out)).
call_of(dc_motor_states(dc, out)).
call_of(dc_motor_polarity(dc, polarity)).
call_of(dc_motor_ramps(dc, number, number)).
call_of(dc_motor_attribute(dc, attribute, number)).
call_of(servo_motor_position(servo, number)).
call_of(servo_motor_angle(servo, number)).
call_of(servo_motor_float(servo)).
call_of(servo_motor_polarity(servo, polarity)).
call_of(servo_motor_rate(servo, number)).
call_of(servo_motor_pulses(servo, number, number, number)).
call_of(servo_motor_attribute(servo, attribute, number)).
call_of(ev3_time(out)).
call_of(stopwatch(out)).
call_of(elapsed(watch, out)).
call_of(led(light)).
call_of(led(light, colour)).
call_of(led_trigger(light, trigger)).
call_of(led_triggers(light, out)).
call_of(led_blink(light, number, number)).
call_of(battery(key, out)).
call_of(lego_port(lego_port)).
call_of(port_mode(lego_port, mode)).
call_of(port_modes(lego_port, out)).
call_of(port_status(lego_port, out)).
call_of(port_device(lego_port, type)).
call_of(ev3_dev(file)).
call_of(button(button)).
call_of(button_wait(button, event, at_once)).
call_of(play(file)).
call_of(play(file, options)).
call_of(sound_wait).
call_of(volume(number)).
call_of(sound_stop).
call_of(screen_clear).
call_of(screen_show).
call_of(screen_point(number, number)).
call_of(screen_point(number, number, options)).
call_of(screen_line(number, number, number, number)).
call_of(screen_line(number, number, number, number, options)).
call_of(screen_rectangle(number, number, number, number)).
call_of(screen_rectangle(number, number, number, number, options)).
call_of(screen_circle(number, number, number)).
call_of(screen_circle(number, number, number, options)).
call_of(screen_arc(number, number, number, number, number)).
call_of(screen_arc(number, number, number, number, number, options)).
call_of(screen_text(number, number, trigger)).
call_of(screen_text(number, number, trigger, options)).
call_of(screen_image(number, number, file)).
call_of(set_robot(number, number, port, port)).
call_of(set_robot(number, number, port, port, options)).
call_of(go(number)).
call_of(turn(number)).
call_of(ev3_sysfs(file)).

% Those that wait, where nothing moves: with the first argument odd only.
call_of(motor_run(port, number, out)).
call_of(motor_wait_until(port, out)).
call_of(go(number, out)).
call_of(go_cm(number, out)).
call_of(turn(number, out)).

call_of(Call) :-
    \+ current_tree(mount),
    call_for_seconds(Call).

% Without arguments, or that hold what was said before.
call_of(stop_all_motors).
call_of(stop).
call_of(ev3_devices).
call_of(robot(out, out, out, out)).

% Goal is a call with one argument odd.
odd_call(Goal) :-
    call_of(Call),
    Call =.. [Name|Kinds],
    (   nth0(I, Kinds, _, _),
        odd(Odd),
        findall(Argument,
                ( nth0(J, Kinds, Kind), J \== I, sensible(Kind, Argument) ),
                Others),
        nth0(I, Arguments, Odd, Others),
        Goal =.. [Name|Arguments]
    ;   Kinds == [],
        Goal = Name
    ).

test(every_exported_predicate_is_called, true(Missing-Gone == []-[])) :-
    module_property(ev3dev, exports(Exports)),
    findall(PI, called(PI), Called),
    subtract(Exports, Called, Missing),
    subtract(Called, Exports, Gone).
test(what_is_called_elsewhere_is_not_called_here, true(Here == [])) :-
    findall(Name/Arity,
            ( called_elsewhere(Name/Arity),
              call_of(Call), functor(Call, Name, Arity) ),
            Here).

called(PI) :-
    called_elsewhere(PI).
called(Name/Arity) :-
    ( call_of(Call) ; call_for_seconds(Call) ),
    functor(Call, Name, Arity).

% These wait for as long as one likes, or write files of any name: see
% test_buttons.pl, test_sound.pl, test_screen.pl, test_time.pl, test_motors.pl
% and test_sensor_wait.pl.
called_elsewhere(button_events/1).
called_elsewhere(button_wait/2).
called_elsewhere(motor_run_until_stalled/2).
called_elsewhere(motor_run_until_stalled/3).
called_elsewhere(tone/2).
called_elsewhere(tone/3).
called_elsewhere(say/2).
called_elsewhere(sensor_wait/1).
called_elsewhere(sensor_wait/2).
called_elsewhere(wait/1).
called_elsewhere(tones/1).
called_elsewhere(tones/2).
called_elsewhere(say/1).
called_elsewhere(screen_png/1).

test(whatever_is_thrown_is_an_iso_error_that_names_what_was_called,
     [forall(tree(Tree)), true(Bad == [])]) :-
    with_tree(Tree, [ in1-'lego-ev3-us', outA-'lego-ev3-m-motor',
                      outB-'lego-ev3-l-motor', outC-'lego-ev3-l-motor',
                      outD-'rcx-motor', 'in2:i2c88:sv1'-'ms-8ch-servo',
                      'led0:red:brick-status'-led, 'led0:green:brick-status'-led,
                      'lego-ev3-battery'-battery ],
              ( set_robot(5.6, 10.6, outB, outC),
                findall(Goal-How,
                        ( some(odd_call(Goal)), ends_badly(Goal, How) ),
                        Bad) )),
    !.

% A port, and any other name, may be an atom or a string.

names(Kind) :-
    memberchk(Kind, [ port, sensor, dc, servo, light, lego_port, button, polarity,
                      key, action, flag, command, colour, event, trigger, mode
                    ]).

%   Two calls that differ in one name, which is an atom in the first and a
%   string in the second.
either(Goal, Other) :-
    call_of(Call),
    Call =.. [Name|Kinds],
    Name \== sensor_mode,              % a table of atoms
    nth0(I, Kinds, Kind, Others),
    names(Kind),
    sensible(Kind, Atom),
    maplist(sensible, Others, Rest0),
    copy_term(Rest0, Rest1),
    nth0(I, Arguments0, Atom, Rest0),
    atom_string(Atom, String),
    nth0(I, Arguments1, String, Rest1),
    Goal =.. [Name|Arguments0],
    Other =.. [Name|Arguments1].

test(a_name_may_be_an_atom_or_a_string, true(Different == [])) :-
    with_tree(plain, [ in1-'lego-ev3-us', outB-'lego-ev3-l-motor',
                       outA-'lego-ev3-l-motor', outD-'rcx-motor',
                       'in2:i2c88:sv1'-'ms-8ch-servo',
                       'led0:red:brick-status'-led, 'led0:green:brick-status'-led,
                       'lego-ev3-battery'-battery ],
              findall(Goal-How/Other-How1,
                      ( either(Goal, Other),
                        ends(Goal, How),
                        ends(Other, How1),
                        How \== How1 ),
                      Different)).

ends(Goal, How) :-
    warnings(catch(call_with_time_limit(
                       300,
                       ( with_output_to(string(_), Goal) -> End = yes ; End = no )),
                   error(Formal, _), End = Formal),
             _),
    term_to_atom(End, How).

ends_badly(Goal, How) :-
    use_tree_again,
    % A motor with nonsense as its command may be reported as blocked. 97
    % seconds, which is what [a] is, take a while in an emulated simulator.
    warnings(catch(call_with_time_limit(
                       300,
                       ( with_output_to(string(_), ignore(user:Goal)),
                         Error = none )),
                   Error, true),
             _),
    \+ is_fine(Error, Goal),
    How = Error.

is_fine(none, _).
is_fine(error(Formal, context(Called, Message)), Goal) :-
    nonvar(Formal),
    iso(Formal),
    functor(Goal, Name, Arity),
    Called == Name/Arity,
    in_words(Message).

% Words for a person, not what a debugger shows of Rust values.
in_words(Message) :-
    atom(Message),
    Message \== '',
    forall(member(Debug, ['Some(', 'None', 'Err(', ' { ']),
           \+ sub_atom(Message, _, _, _, Debug)).

iso(instantiation_error).
iso(uninstantiation_error(_)).
iso(type_error(_, _)).
iso(domain_error(_, _)).
iso(existence_error(_, _)).
iso(permission_error(_, _, _)).
iso(representation_error(_)).
iso(evaluation_error(_)).
iso(resource_error(_)).
iso(syntax_error(_)).
iso(system_error(_)).

:- end_tests(any_terms).

                /*******************************
                *          ANY TEXTS           *
                *******************************/

% A driver that has gone mad, in any tree.

outcome(Goal, Value, Outcome) :-
    (   catch(Goal, Error, true)
    ->  ( nonvar(Error) -> Outcome = Error ; Outcome = value(Value) )
    ;   Outcome = fails
    ).

iso_file_error(syntax_error(attribute)).
iso_file_error(existence_error(_, _)).
iso_file_error(permission_error(_, attribute, _)).
iso_file_error(system_error(_)).

:- begin_tests(any_texts).

mad('').
mad('\n\n').
mad('  7  ').
mad('7 8').
mad(seven).
mad('-').
mad('0x7').
mad('7.0').
mad('99999999999999999999').
mad('\u4e2d\U0001f916').
mad(Text) :-
    length(Codes, 4095),
    maplist(=(0'7), Codes),
    atom_codes(Text, Codes).

test(no_number_is_refused,
     [forall(( tree(Tree),
               mad(Text) )), error(syntax_error(attribute), context(_/_, _))]) :-
    with_tree(Tree, ( show_attribute(outB, position, Text),
                      position(outB, _) )).
test(texts_are_read_as_they_are,
     [ forall(( tree(Tree),
                mad(Text), \+ atom_number(Text, _) )), true(Read == Text) ]) :-
    with_tree(Tree, ( show_attribute(outB, stop_action, Text),
                      motor_attribute(outB, stop_action, Read) )).
test(moves_throw_or_fail_where_a_motor_reads_badly,
     [ forall(( tree(Tree),
                member(Attribute, [max_speed, count_per_rot, position]),
                mad(Text) )),
       error(syntax_error(attribute), context(motor_run/4, _)) ]) :-
    with_tree(Tree, ( show_attribute(outB, Attribute, Text),
                      motor_run(outB, 50, 90, [timeout(1)]) )).
test(a_motor_whose_state_is_none_is_left_at_rest,
     [ forall(( tree(Tree),
                mad(Text), atom_length(Text, Length), Length < 60 )),
       true(C-W == stop-true) ]) :-
    with_tree(Tree, ( show_attribute(outB, state, Text),
                      put_attribute(outB, command, 'run-forever'),
                      motor_states(outB, States),
                      ( is_list(States) -> W = true ; W = States ),
                      motor_stop(outB),
                      get_attribute(outB, command, C) )).
test(sensors_throw_where_they_read_badly,
     [ forall(( tree(Tree),
                member(Attribute, [value0, decimals]), mad(Text) )),
       error(syntax_error(attribute), context(_/_, _)) ]) :-
    with_tree(Tree, [in1-'lego-ev3-us'],
              ( show_attribute(in1, Attribute, Text),
                us_dist_cm(in1, _) )).
test(a_device_without_an_address_is_passed_over,
     [forall(tree(Tree)), true(Ps == [outC])]) :-
    with_tree(Tree, [outB-'lego-ev3-l-motor', outC-'lego-ev3-l-motor'],
              ( show_attribute(outB, address, ''),
                findall(P, tacho_motor(P), Ps) )).
test(a_table_of_mad_devices_is_printed, [forall(( tree(Tree), mad(Text) ))]) :-
    with_tree(Tree, [outB-'lego-ev3-l-motor', in1-'lego-ev3-us'],
              ( show_attribute(outB, position, Text),
                show_attribute(in1, value0, Text),
                with_output_to(string(_), ev3_devices) )).
test(a_full_disk_throws, [ condition(exists_file('/dev/full')),
                           error(system_error(_), context(file_write/2, _)) ]) :-
    file_write('/dev/full', 5).

:- end_tests(any_texts).

                /*******************************
                *          ANY FILES           *
                *******************************/

% What no kernel shows, in the place of an attribute.

replace(Port, Attribute, Goal_1) :-
    attribute_path(Port, Attribute, File),
    (   exists_file(File)
    ->  delete_file(File)
    ;   true
    ),
    call(Goal_1, File).

bytes(Bytes, File) :-
    setup_call_cleanup(open(File, write, Out, [type(binary)]),
                       maplist(put_byte(Out), Bytes),
                       close(Out)).

repeated(Count, Byte, File) :-
    length(Bytes, Count),
    maplist(=(Byte), Bytes),
    bytes(Bytes, File).

every_byte(File) :-
    numlist(0, 255, Bytes),
    bytes(Bytes, File).

pipe(File) :-
    format(atom(Command), "mkfifo '~w'", [File]),
    shell(Command, 0).

unreadable(File) :-
    bytes(`7\n`, File),
    format(atom(Command), "chmod a-rw '~w'", [File]),
    shell(Command, 0).

root_reads_all :-
    tmp_file(ev3dev, File),
    unreadable(File),
    catch(( open(File, read, In), close(In) ), _, fail).

% strange(Name, Goal_1): Goal_1 makes such a file.
strange(empty, bytes([])).
strange(binary, every_byte).
strange(half_a_character, bytes([0'7, 0xc3])).
strange(page, repeated(4096, 0'7)).
strange(more_than_a_page, repeated(5000, 0'7)).
strange(newlines, bytes(`\n\n\n`)).
strange(no_newline, bytes([0'7])).
strange(spaces, bytes(`  7  \n`)).
strange(nuls, bytes([0, 0, 0])).
strange(directory, make_directory).
strange(pipe, pipe).
strange(missing, [_]>>true).
strange(unreadable, unreadable).

% A file that no kernel has.
:- begin_tests(any_files).

test(numbers_are_read_or_refused,
     [ forall(( strange(Name, Make_1), Name \== no_newline,
                \+ ( Name == unreadable, root_reads_all ) )),
       true(Fine == true) ]) :-
    with_tree(plain, ( replace(outB, position, Make_1),
                       outcome(position(outB, V), V, Outcome) )),
    (   Outcome = error(F, context(_/_, _)), iso_file_error(F)
    ->  Fine = true
    ;   Fine = Outcome
    ).
test(a_number_without_a_newline_is_one, true(V == 7)) :-
    with_tree(plain, ( replace(outB, position, bytes([0'7])),
                       position(outB, V) )).
test(texts_are_read_whole_or_refused,
     [ forall(( strange(Name, Make_1), \+ ( Name == unreadable, root_reads_all ) )),
       true(Fine == true) ]) :-
    with_tree(plain, ( replace(outB, stop_action, Make_1),
                       outcome(motor_attribute(outB, stop_action, V), V, Outcome) )),
    (   memberchk(Name-Outcome,
                  [ empty-value(''), no_newline-value(7), spaces-value('  7  '),
                    newlines-value('\n\n'), nuls-value('\u0000\u0000\u0000') ])
    ->  Fine = true
    ;   Name == page, Outcome = value(Text), atom_length(Text, 4096)
    ->  Fine = true
    ;   Outcome = error(F, context(_/_, _)), iso_file_error(F)
    ->  Fine = true
    ;   Fine = Outcome
    ).
test(file_read_reads_a_text_whole_or_refuses_it,
     [ forall(( strange(Name, Make_1), \+ ( Name == unreadable, root_reads_all ) )),
       true(Fine == true) ]) :-
    with_tree(plain, ( replace(outB, stop_action, Make_1),
                       attribute_path(outB, stop_action, File),
                       outcome(file_read(File, V), V, Outcome) )),
    (   Outcome = value(_)
    ->  ( memberchk(Name, [empty, no_newline, spaces, newlines, nuls, page])
        -> Fine = true ; Fine = Outcome )
    ;   Outcome = error(F, context(file_read/2, _)), iso_file_error(F)
    ->  Fine = true
    ;   Fine = Outcome
    ).
test(moves_throw_or_fail_where_a_motor_reads_badly,
     [ forall(( member(Attribute, [max_speed, count_per_rot, position, state]),
                strange(Name, Make_1),
                \+ memberchk(Name, [no_newline, unreadable]),
                % A state without flags is one: the motor does not run.
                \+ ( Attribute == state,
                     memberchk(Name, [empty, newlines, spaces, nuls]) ) )),
       true(Fine == true) ]) :-
    with_tree(plain, ( replace(outB, Attribute, Make_1),
                       outcome(call_with_time_limit(300, motor_run(outB, 50, 90, [timeout(1)])),
                               done, Outcome) )),
    (   Outcome == fails
    ->  Fine = true
    ;   Outcome = error(F, context(_/_, _)), iso_file_error(F)
    ->  Fine = true
    ;   Fine = Outcome
    ).
test(sensors_throw_or_fail_where_they_read_badly,
     [ forall(( member(Attribute, [mode, value0, decimals]),
                strange(Name, Make_1),
                \+ memberchk(Name, [no_newline, unreadable]),
                % each 2 s of patience with a sensor without contact
                \+ ( Name == pipe, Attribute == mode ) )),
       true(Fine == true) ]) :-
    with_tree(plain, [in1-'lego-ev3-us'],
              ( replace(in1, Attribute, Make_1),
                outcome(call_with_time_limit(300, us_dist_cm(in1, V)), V, Outcome) )),
    (   Outcome == fails
    ->  Fine = true
    ;   Attribute == mode, Outcome == value(84.3)
    ->  Fine = true
    ;   Outcome = error(F, context(_/_, _)), iso_file_error(F)
    ->  Fine = true
    ;   Fine = Outcome
    ).
test(what_is_no_device_is_passed_over,
     [ forall(( member(Attribute, [address, driver_name]),
                member(Name, [binary, more_than_a_page, directory, pipe, missing]),
                strange(Name, Make_1) )),
       true(Ps == [outC]) ]) :-
    with_tree(plain, [outB-'lego-ev3-l-motor', outC-'lego-ev3-l-motor'],
              ( replace(outB, Attribute, Make_1),
                findall(P, tacho_motor(P), Ps) )).
test(a_class_that_is_a_file_throws, error(system_error(_), context(_/_, _))) :-
    with_tree(plain, [],
              ( tree_root(Root),
                directory_file_path(Root, 'tacho-motor', File),
                bytes([], File),
                tacho_motor(_) )).
test(a_table_of_strange_devices_is_printed,
     [ forall(( strange(Name, Make_1), Name \== unreadable )) ]) :-
    with_tree(plain, [outB-'lego-ev3-l-motor', in1-'lego-ev3-us'],
              ( replace(outB, position, Make_1),
                replace(in1, value0, Make_1),
                with_output_to(string(_), ev3_devices) )).
test(writing_to_what_cannot_be_written_throws,
     [ forall(member(Make_1, [make_directory, pipe, [_]>>true])),
       error(_, context(_/_, _)) ]) :-
    with_tree(plain, ( replace(outB, speed_sp, Make_1),
                       speed_sp(outB, 5) )).
test(a_text_of_a_page_is_written_whole, true(Length == 4096)) :-
    length(Codes, 4096),
    maplist(=(0'a), Codes),
    atom_codes(Text, Codes),
    with_tree(plain, ( motor_attribute(outB, stop_action, Text),
                       get_attribute(outB, stop_action, Written),
                       atom_length(Written, Length) )).

:- end_tests(any_files).

                /*******************************
                *       FILES OF A PROGRAM     *
                *******************************/

% What a program names as a file that is read or written.
:- begin_tests(files_of_a_program).

names_file(File, Goal) :-
    member(Goal,
           [ sim_start(File, []), sim_start([], [robot(File)]), play(File),
             screen_image(0, 0, File), journal_replay(File), file_read(File, _),
             roadmap_path(File, 0-0, 9-9, _), navigate_to(File, 9-9) ]).

writes_file(File, Goal) :-
    member(Goal,
           [ file_write(File, 1), screen_png(File), sim_svg(File), sim_mount(File),
             ev3_sysfs(File), ev3_dev(File) ]).

no_file(Name, File) :-
    strange(Name, Make_1),
    tmp_file(strange, File),
    call(Make_1, File).
no_file(links, File) :-
    tmp_file(strange, File),
    link_file(File, File, symbolic).
no_file(device, '/dev/zero').
no_file(below_a_file, '/dev/null/x').
no_file(picture, File) :-
    tmp_file(strange, File),
    bytes([0x89, 0'P, 0'N, 0'G, 13, 10, 26, 10, 0, 0], File).
no_file(sound, File) :-
    tmp_file(strange, File),
    bytes(`RIFF....WAVEfmt `, File).
no_file(fact, File) :-
    tmp_file(strange, File),
    bytes(`wall(0,0,9,9).\nwall(`, File).

%   Named by the file, too, where the syntax is wrong.
is_refused(error(Formal, Context), Goal) :-
    nonvar(Formal),
    iso_of_file(Formal),
    functor(Goal, Name, Arity),
    (   Context = context(Name/Arity, Message)
    ->  atom(Message)
    ;   memberchk(Context, [file(_, _, _, _), fact(_, _)])
    ).

iso_of_file(Formal) :-
    iso_file_error(Formal).
iso_of_file(syntax_error(_)).
iso_of_file(domain_error(_, _)).
iso_of_file(permission_error(_, _, _)).

test(each_is_read_or_refused_with_the_reason, true(Wrong == [])) :-
    findall(Name-Goal-Outcome,
            ( no_file(Name, File),
              names_file(File, Goal),
              warnings(outcome(with_sim([], call_with_time_limit(300, Goal)), done, Outcome),
                       _),
              \+ Outcome == fails,
              \+ Outcome = value(_),
              \+ is_refused(Outcome, Goal) ),
            Wrong).
test(no_file_has_a_name_with_a_nul, true(Wrong == [])) :-
    findall(Goal-Outcome,
            ( member(File, ['a\u0000b', "a\u0000b"]),
              ( names_file(File, Goal) ; writes_file(File, Goal) ),
              functor(Goal, Name, Arity),
              outcome(with_sim([], Goal), done, Outcome),
              \+ Outcome = error(domain_error(file_name, _), context(Name/Arity, _)) ),
            Wrong).

:- end_tests(files_of_a_program).

                /*******************************
                *        TORN VALUES           *
                *******************************/

:- begin_tests(torn_values).

test(a_reader_sees_either_text_and_nothing_between,
     [forall(tree(Tree)), true(Others == [])]) :-
    with_tree(Tree, ( position(outB, 1),
                      meanwhile(alternate,
                                ( sees(1000000),
                                  findall(V, ( case(20000, _), position(outB, V) ), Vs),
                                  sees(1) )),
                      subtract(Vs, [1, 1000000], Others) )).

sees(Value) :-
    eventually(( position(outB, V), V == Value )).

alternate :-
    position(outB, 1000000),
    position(outB, 1),
    alternate.

:- end_tests(torn_values).
