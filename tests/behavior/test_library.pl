:- use_module('../support/trees').
:- use_module('../support/child').
:- use_module(library(lists)).
:- use_module(library(ev3dev)).
:- use_module(library(readutil)).

                /*******************************
                *           EXPORTS            *
                *******************************/

:- begin_tests(exports).

exported(driver,
         [ subsystem_detect/4, file_read/2, file_write/2,
           tacho_motor/1, tacho_motor/2, tacho_motor/3,
           ev3_large_motor/1, ev3_medium_motor/1, nxt_motor/1,
           dc_motor/1, servo_motor/1,
           lego_sensor/1, lego_sensor/2, lego_sensor/3,
           motor_attribute/3, sensor_attribute/3,
           command/2, command_file/2, speed/2, speed_file/2,
           speed_sp/2, speed_sp_file/2, max_speed/2, max_speed_file/2,
           position/2, position_file/2, position_sp/2, position_sp_file/2,
           state/2, state_file/2, motor_states/2,
           mode/2, mode_file/2, value/3, value_file/3,
           decimals/2, decimals_file/2, ev3_sysfs/1, ev3_dev/1 ]).
exported(device_table, [ ev3_devices/0 ]).
exported(sensors,
         [ light_sensor/1, ultrasonic_sensor/1, gyro_sensor/1, touch_sensor/1,
           infrared_sensor/1, col_ambient/2, col_reflect/2, col_color/2,
           col_rgb_raw/2, col_rgb_raw/4, us_dist_cm/2, us_dist_inches/2,
           us_listen/2, gyro_ang/2, gyro_rate/2, gyro_ang_rate/3, gyro_reset/1, touch/2,
           ir_prox/2, sensor_reading/3, sensor_value/4, sensor_values/3,
           adjust_val/3 ]).
exported(sensor_wait, [ sensor_wait/1, sensor_wait/2 ]).
exported(infrared,
         [ ir_remote/3, ir_beacon/4, ir_dist_cm/2, ir_seeker/2,
           ir_seeker/4 ]).
exported(nxt_sensors,
         [ nxt_light/2, nxt_ambient/2, nxt_sound/2, temperature/2,
           target_temperature/2, pressure/2, compass/2, ht_color/2,
           ht_color_rgb/2, ht_gyro_rate/2, ht_eopd/3, acceleration/4,
           rotation_rate/4, tilt/4, magnetic_field/4, angle_deg/2,
           angle_total/2, angle_rpm/2, light_row/2, line_leader/3,
           energy_meter/4 ]).
exported(sensor_info,
         [ sensor_info/2, sensor_mode/6, sensor_type/2, sensor_command/2 ]).
exported(motors,
         [ motor_run/2, motor_run/3, motor_run/4, motors_run/1,
           motors_turn/2, motor_start/1, motor_stop/1, motor_stop/2,
           stop_all_motors/0, motor_reset/1, run_forever/2, speed_adjust/3,
           motor_wait_while/2, motor_wait_until/2, motor_wait/3,
           motor_run_timed/3, motor_run_timed/4, motor_run_to/3,
           motor_run_to/4, motor_run_direct/2, motor_run_until_stalled/2,
           motor_run_until_stalled/3 ]).
exported(motor_settings,
         [ linear_actuator/1, motor_position/2, motor_speed/2,
           motor_gear/2, motor_duty/2,
           motor_polarity/2, motor_ramps/3, motor_speed_pid/2,
           motor_hold_pid/2 ]).
exported(dc_motors,
         [ dc_motor_run/2, dc_motor_run_timed/3, dc_motor_run_timed/4,
           dc_motor_run_direct/2, dc_motor_stop/1, dc_motor_stop/2,
           dc_motor_duty/2, dc_motor_states/2, dc_motor_polarity/2,
           dc_motor_ramps/3, dc_motor_attribute/3 ]).
exported(servo_motors,
         [ servo_motor_position/2, servo_motor_angle/2, servo_motor_float/1,
           servo_motor_polarity/2, servo_motor_rate/2, servo_motor_pulses/4,
           servo_motor_attribute/3 ]).
exported(lights,
         [ led/1, led/2, led_trigger/2, led_triggers/2, led_blink/3 ]).
exported(battery, [ battery/2 ]).
exported(ports,
         [ lego_port/1, port_mode/2, port_modes/2, port_status/2,
           port_device/2 ]).
exported(time, [ ev3_time/1, wait/1, stopwatch/1, elapsed/2 ]).
exported(buttons,
         [ button/1, button_wait/2, button_wait/3, button_events/1 ]).
exported(sound,
         [ tone/2, tone/3, tones/1, tones/2, say/1, say/2, play/1, play/2,
           volume/1, sound_wait/0, sound_stop/0 ]).
exported(screen,
         [ screen_clear/0, screen_point/2, screen_point/3, screen_line/4,
           screen_line/5, screen_rectangle/4, screen_rectangle/5,
           screen_circle/3, screen_circle/4, screen_arc/5, screen_arc/6,
           screen_text/3, screen_text/4, screen_image/3, screen_show/0,
           screen_png/1 ]).
exported(robot,
         [ set_robot/4, set_robot/5, robot/4, stop/0, go/1, go/2, go_cm/2, turn/1,
           turn/2 ]).

test(are_these_and_no_others, true(Missing-More == []-[])) :-
    findall(P, ( exported(_, Ps), member(P, Ps) ), Expected),
    findall(P, exports(ev3dev, P), Found),
    subtract(Expected, Found, Missing),
    subtract(Found, Expected, More).
test(are_those_of_the_modules,
     [ forall(exported(Name, Ps)), true(Missing-More == []-[]) ]) :-
    use_module(library(ev3dev/Name), []),
    atom_concat(ev3dev_, Name, Module),
    findall(P, ( exports(Module, P), P \== reading_of/4 ), Found),
    subtract(Ps, Found, Missing),
    subtract(Found, Ps, More).
test(each_is_defined,
     [ forall(( exported(_, Ps), member(Name/Arity, Ps) )) ]) :-
    functor(Head, Name, Arity),
    once(predicate_property(Head, visible)).

exports(Module, P) :-
    module_property(Module, exports(Ps)),
    member(P, Ps).

:- end_tests(exports).

                /*******************************
                *           LOADING            *
                *******************************/

:- begin_tests(loading).

test(prints_nothing, true(Status-Output == exit(0)-"")) :-
    run_program(":- use_module(library(ev3dev)).", [], Status, Output).
test(works_from_any_folder, true(Status-Output == exit(0)-"ok")) :-
    run_program(":- use_module(library(ev3dev)).
                 main :- ( tacho_motor(nothing) -> true ; write(ok) ).",
                [goal(main), cwd('/')], Status, Output).
test(each_layer_loads_alone,
     [ forall(member(Layer, [driver, motors, sensors, robot, files, buttons, sound, screen])),
       true(Status-Output == exit(0)-"") ]) :-
    format(string(Program), ":- use_module(library(ev3dev/~w)).", [Layer]),
    run_program(Program, [], Status, Output).
% The simulator is no directory.
test(takes_the_tree_from_the_environment,
     [ forall(of_files(Tree)), true(Status-Output == exit(0)-"[outA,outB,outC,outD]") ]) :-
    with_tree(Tree, ( tree_root(Root),
                      run_program(":- use_module(library(ev3dev)).
                                   main :- findall(P, tacho_motor(P), Ps), print(Ps).",
                                  [goal(main), env('EV3DEV_SYSFS'=Root)],
                                  Status, Output) )).
test(an_empty_environment_is_none,
     [ forall(member(Variable-Query-Default,
                     [ 'EV3DEV_SYSFS'-ev3_sysfs-"/sys/class",
                       'EV3DEV_DEV'-ev3_dev-"/dev" ])),
       true(Status-Output == exit(0)-Default) ]) :-
    tells_directory(Query, Program),
    run_program(Program, [goal(main), env(Variable='')], Status, Output).
% There is a directory of that name beside the library's own files, too.
test(the_environment_is_relative_to_the_working_directory,
     [ forall(member(Variable-Query, [ 'EV3DEV_SYSFS'-ev3_sysfs,
                                       'EV3DEV_DEV'-ev3_dev ])),
       true(Status-Output == exit(0)-Expected) ]) :-
    tmp_file(home, Home),
    atom_concat(Home, '/worlds', Directory),
    atom_string(Directory, Expected),
    tells_directory(Query, Program),
    setup_call_cleanup(
        make_directory_path(Directory),
        run_program(Program, [goal(main), cwd(Home), env(Variable=worlds)],
                    Status, Output),
        delete_directory_and_contents(Home)).
test(an_environment_that_names_no_directory_is_an_error, true(Named == true)) :-
    run_program(":- use_module(library(ev3dev)).",
                [env('EV3DEV_SYSFS'='/nowhere/at/all')], Status, Output),
    % Before version 9, an error while loading leaves the status alone.
    (   current_prolog_flag(version, Version), Version < 90000
    ->  true
    ;   assertion(Status \== exit(0))
    ),
    ( sub_string(Output, _, _, _, "/nowhere/at/all") -> Named = true ; Named = Output ).

tells_directory(Query, Program) :-
    format(string(Program),
           ":- use_module(library(ev3dev)).
            main :- ~q(Directory), write(Directory).", [Query]).

:- end_tests(loading).

                /*******************************
                *      NATIVE PREDICATES       *
                *******************************/

:- begin_tests(natives).

test(private_native_exports_what_the_library_registers, true(Registered == Exports)) :-
    findall(Name/Arity,
            ( predicate_property(ev3dev_native:Head, foreign),
              \+ predicate_property(ev3dev_native:Head, imported_from(_)),
              functor(Head, Name, Arity) ),
            Registered0),
    sort(Registered0, Registered),
    exports(Exports).
test(and_its_comments_name_them, true(Named == Exports)) :-
    findall(Name/Arity, native_comment(Name, Arity, _), Named0),
    sort(Named0, Named),
    exports(Exports).
test(and_say_which_have_several_solutions,
     [ condition(exists_directory(src)), true(Named == Declared) ]) :-
    setof(Name, Arity^native_comment(Name, Arity, nondet), Named),
    setof(Name, declared_nondet(Name), Declared).

exports(Exports) :-
    module_property(ev3dev_native, exports(Exports0)),
    sort(Exports0, Exports).

native_comment(Name, Arity, Determinism) :-
    module_property(ev3dev_native, file(File)),
    line_of(File, Line),
    string_concat("%!  ", Rest, Line),
    split_string(Rest, "+-?:", ".", Parts),     % without the modes
    atomic_list_concat(Parts, Text),
    term_to_atom(Head is Determinism, Text),
    functor(Head, Name, Arity).

declared_nondet(Name) :-
    member(Pattern, ['src/*.rs', 'src/*/*.rs']),
    expand_file_name(Pattern, Files),
    member(File, Files),
    line_of(File, Line),
    split_string(Line, "\"", " ", ["nondet fn", Name0|_]),
    atom_string(Name, Name0).

line_of(File, Line) :-
    read_file_to_string(File, Text, []),
    split_string(Text, "\n", "", Lines),
    member(Line, Lines).

:- end_tests(natives).

                /*******************************
                *          THE BINARY          *
                *******************************/

% A dynamic library names those that it needs in its string table.
:- begin_tests(binary).

test(needs_no_libswipl, true(Needs == none)) :-
    ev3dev_library_file:library_file(File),
    read_file_to_string(File, Bytes, [encoding(octet)]),
    (   sub_string(Bytes, _, _, _, "libswipl.so")
    ->  Needs = libswipl
    ;   Needs = none
    ).

:- end_tests(binary).
