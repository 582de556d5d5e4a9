:- use_module('../support/cases').
:- use_module('../support/trees').
:- use_module('../support/odd_terms').
:- use_module('../support/old_prolog').
:- use_module(library(ev3dev/journal)).
:- use_module(library(ev3dev/navigation)).
:- use_module(library(ev3dev/roadmap)).

% ---------------- ANY TERMS

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

call_of(Call) :-
    calls(Calls),
    member(Call, Calls).
call_of(Call) :-
    \+ current_tree(mount),
    call_for_seconds(Call).

% Calls that return at once on a tree where nothing moves.
calls([
    subsystem_detect(port, type, out, pattern), file_read(file, out),
    file_write(file, number), tacho_motor(port), tacho_motor(port, out),
    tacho_motor(port, out, out), ev3_large_motor(port),
    ev3_medium_motor(port), nxt_motor(port), servo_motor(port),
    lego_sensor(sensor), lego_sensor(sensor, out),
    lego_sensor(sensor, out, out), motor_attribute(port, attribute, number),
    sensor_attribute(sensor, attribute, out), command(port, command),
    command_file(port, out), speed(port, out), speed_file(port, out),
    speed_sp(port, number), speed_sp_file(port, out), max_speed(port, out),
    max_speed_file(port, out), position(port, number),
    position_file(port, out), position_sp(port, number),
    position_sp_file(port, out), state(port, out), state_file(port, out),
    motor_states(port, out), mode(sensor, mode), mode_file(sensor, out),
    value(sensor, index, out), value_file(sensor, index, out),
    decimals(sensor, out), decimals_file(sensor, out), light_sensor(sensor),
    ultrasonic_sensor(sensor), gyro_sensor(sensor), touch_sensor(sensor),
    infrared_sensor(sensor), col_ambient(sensor, out),
    col_reflect(sensor, out), col_color(sensor, out),
    col_rgb_raw(sensor, out), col_rgb_raw(sensor, out, out, out),
    us_dist_cm(sensor, out), us_dist_inches(sensor, out),
    us_listen(sensor, out), gyro_ang(sensor, out), gyro_rate(sensor, out),
    gyro_ang_rate(sensor, out, out), gyro_reset(sensor), touch(sensor, out),
    ir_prox(sensor, out), sensor_reading(reading, sensor, out),
    sensor_value(sensor, mode, index, out), sensor_values(sensor, mode, out),
    ir_remote(sensor, index, out), ir_beacon(sensor, index, out, out),
    ir_dist_cm(sensor, out), ir_seeker(sensor, out),
    ir_seeker(sensor, mode, out, out), nxt_light(sensor, out),
    nxt_ambient(sensor, out), nxt_sound(sensor, out),
    temperature(sensor, out), target_temperature(sensor, out),
    pressure(sensor, out), compass(sensor, out), ht_color(sensor, out),
    ht_color_rgb(sensor, out), ht_gyro_rate(sensor, out),
    angle_deg(sensor, out), angle_total(sensor, out), angle_rpm(sensor, out),
    light_row(sensor, out), sensor_info(sensor, out),
    ht_eopd(sensor, mode, out), acceleration(sensor, out, out, out),
    rotation_rate(sensor, out, out, out), tilt(sensor, out, out, out),
    magnetic_field(sensor, out, out, out), line_leader(sensor, out, out),
    energy_meter(sensor, out, out, out),
    sensor_mode(out, mode, out, out, out, out), sensor_type(out, out),
    sensor_command(sensor, mode), adjust_val(sensor, index, out),
    motor_run(port, number), motor_run(port, number, number, quick),
    motors_run(runs), motors_turn(moves, quick), motor_start(port),
    motor_stop(port), motor_stop(port, action), motor_reset(port),
    run_forever(port, number), speed_adjust(number, port, out),
    motor_wait_while(port, flag), motor_wait(port, options, out),
    motor_run_timed(port, number, seconds, quick),
    motor_run_to(port, number, number, quick), motor_run_direct(port, number),
    linear_actuator(port), motor_position(port, number),
    motor_speed(port, out), motor_gear(port, number), motor_duty(port, out),
    motor_polarity(port, polarity), motor_ramps(port, number, number),
    motor_speed_pid(port, pid), motor_hold_pid(port, pid), dc_motor(dc),
    dc_motor_run(dc, number), dc_motor_run_timed(dc, number, seconds, quick),
    dc_motor_run_direct(dc, number), dc_motor_stop(dc),
    dc_motor_stop(dc, action), dc_motor_duty(dc, out),
    dc_motor_states(dc, out), dc_motor_polarity(dc, polarity),
    dc_motor_ramps(dc, number, number),
    dc_motor_attribute(dc, attribute, number),
    servo_motor_position(servo, number), servo_motor_angle(servo, number),
    servo_motor_float(servo), servo_motor_polarity(servo, polarity),
    servo_motor_rate(servo, number),
    servo_motor_pulses(servo, number, number, number),
    servo_motor_attribute(servo, attribute, number), ev3_time(out),
    stopwatch(out), elapsed(watch, out), led(light), led(light, colour),
    led_trigger(light, trigger), led_triggers(light, out),
    led_blink(light, number, number), battery(key, out), lego_port(lego_port),
    port_mode(lego_port, mode), port_modes(lego_port, out),
    port_status(lego_port, out), port_device(lego_port, type), ev3_dev(file),
    button(button), button_wait(button, event, at_once), play(file),
    play(file, options), sound_wait, volume(number), sound_stop, screen_clear,
    screen_show, screen_point(number, number),
    screen_point(number, number, options),
    screen_line(number, number, number, number),
    screen_line(number, number, number, number, options),
    screen_rectangle(number, number, number, number),
    screen_rectangle(number, number, number, number, options),
    screen_circle(number, number, number),
    screen_circle(number, number, number, options),
    screen_arc(number, number, number, number, number),
    screen_arc(number, number, number, number, number, options),
    screen_text(number, number, trigger),
    screen_text(number, number, trigger, options),
    screen_image(number, number, file), set_robot(number, number, port, port),
    set_robot(number, number, port, port, options), go(number), turn(number),
    ev3_sysfs(file) ]).

% Those that wait, where nothing moves: with the first argument odd only.
calls([ motor_run(port, number, out), motor_wait_until(port, out),
        go(number, out), go_cm(number, out), turn(number, out) ]).

% Without arguments, or that hold what was said before.
calls([ stop_all_motors, stop, ev3_devices, robot(out, out, out, out) ]).

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
called_elsewhere(PI) :-
    member(PI,
           [ button_events/1, button_wait/2, motor_run_until_stalled/2,
             motor_run_until_stalled/3, tone/2, tone/3, say/2,
             sensor_wait/1, sensor_wait/2, wait/1, tones/1, tones/2,
             say/1, screen_png/1 ]).

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

% ---------------- ANY TEXTS

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

% ---------------- ANY FILES

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

% ---------------- FILES OF A PROGRAM

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

% ---------------- TORN VALUES

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
