/*  The least that must work in every SWI-Prolog, without plunit or any
    package: every export of every public library can be called, and a motor
    and a sensor do what they should.

        swipl -g main -t 'halt(1)' tests/brick/smoke.pl

    EV3DEV_PACK names the pack's folder; else it is the installed one.
*/

:- (   getenv('EV3DEV_PACK', Pack)
   ->  atom_concat(Pack, '/prolog', Folder),
       asserta(user:file_search_path(library, Folder))
   ;   true
   ).
:- use_module(library(ev3dev)).

main :-
    set_prolog_flag(ev3dev_hints, off),
    tree(Root),
    ev3_sysfs(Root),
    ev3_dev(Root),
    check_devices(Root),
    load_libraries,
    findall(Module:PI, export(Module, PI), Exports),
    sort(Exports, Sorted),
    findall(Problem,
            ( member(Export, Sorted), problem(Export, Problem) ),
            Problems),
    length(Sorted, Count),
    current_prolog_flag(version, Version),
    current_prolog_flag(arch, Arch),
    library_used(File),
    format('~w on ~w: ~d exports, ~w~n', [Version, Arch, Count, File]),
    forall(member(Problem, Problems), format('    ~q~n', [Problem])),
    (   Problems == [],
        Count > 500
    ->  halt(0)
    ;   halt(1)
    ).

%   What a program sees and does with one motor and one sensor.

check_devices(Root) :-
    must(findall(Motor, tacho_motor(Motor), [outA])),
    must(findall(Sensor-Type, lego_sensor(Sensor, Type),
                 [in1-'lego-ev3-touch'])),
    must(max_speed(outA, 1050)),
    must(touch(in1, 1)),
    must(motor_run(outA, 50)),
    must(holds(Root, 'tacho-motor/motor0/speed_sp', '525')),
    must(holds(Root, 'tacho-motor/motor0/command', 'run-forever')),
    must(motor_stop(outA)),
    must(holds(Root, 'tacho-motor/motor0/command', stop)),
    must(\+ tacho_motor(outB)),
    must(led(left, red)),
    must(holds(Root, 'leds/led0:red:brick-status/brightness', '255')),
    must(led(left, red)),
    must(findall(Key-Value, battery(Key, Value), [voltage-7.5])),
    must(dc_motor_run(outD, -40)),
    must(holds(Root, 'dc-motor/motor0/duty_cycle_sp', '-40')),
    must(dc_motor_stop(outD)),
    must(port_mode(outD, 'dc-motor')),
    must(catch(motor_run(_, 50), error(instantiation_error, _), true)).

must(Goal) :-
    (   catch(Goal, E, true)
    ->  (   var(E)
        ->  true
        ;   throw(unexpected(Goal, E))
        )
    ;   throw(failed(Goal))
    ).

%   Each file beside `ev3dev/drive.pl` is a library. Their names are not put
%   into the user's module.

load_libraries :-
    forall(library_file(File), load_files(File, [if(not_loaded), imports([])])).

library_file(File) :-
    module_property(ev3dev, file(Main)),
    file_name_extension(Folder, _, Main),
    directory_files(Folder, Names),
    member(Name, Names),
    file_name_extension(_, pl, Name),
    atomic_list_concat([Folder, /, Name], File).

export(Module, Name/Arity) :-
    (   Module = ev3dev
    ;   library_file(File),
        module_property(Module, file(File))
    ),
    module_property(Module, exports(Exports)),
    member(Name/Arity, Exports).

%   Called with variables, a predicate may succeed, fail, or refuse them; it
%   may not be missing, nor fall over. What has no arguments and is of another
%   library than library(ev3dev) begins or ends something: it has to be there.

problem(Module:Name/Arity, Name/Arity-E) :-
    functor(Head, Name, Arity),
    (   \+ predicate_property(Module:Head, visible)
    ->  E = missing
    ;   Arity =:= 0,
        Module \== ev3dev
    ->  fail
    ;   catch(( call_with_inference_limit(Module:Head, 1000000, _)
              ->  true
              ;   true
              ), E, true),
        nonvar(E),
        \+ refusal(E)
    ).

refusal(error(instantiation_error, _)).
refusal(error(type_error(_, _), _)).
refusal(error(domain_error(_, _), _)).
refusal(error(permission_error(_, _, _), _)).
refusal(error(existence_error(Kind, _), _)) :-
    Kind \== procedure.

library_used(File) :-
    (   current_predicate(ev3dev_library_file:library_file/1)
    ->  ev3dev_library_file:library_file(File)
    ;   File = '-'
    ).

%   A tree like the kernel's.

tree(Root) :-
    tmp_file(ev3dev, Root),
    atom_concat(Root, '/tacho-motor', Motors),
    atom_concat(Root, '/lego-sensor', Sensors),
    atom_concat(Motors, '/motor0', Motor),
    atom_concat(Sensors, '/sensor0', Sensor),
    forall(member(Dir, [Root, Motors, Sensors, Motor, Sensor]),
           make_directory(Dir)),
    forall(motor(Name, Text), write_file(Motor, Name, Text)),
    forall(sensor(Name, Text), write_file(Sensor, Name, Text)),
    forall(more(Class, Device, Files),
           ( atomic_list_concat([Root, /, Class], ClassDir),
             atomic_list_concat([ClassDir, /, Device], Dir),
             make_directory(ClassDir),
             make_directory(Dir),
             forall(member(Name-Text, Files), write_file(Dir, Name, Text)) )).

more(leds, 'led0:red:brick-status',
     [brightness-0, max_brightness-255, trigger-none]).
more(power_supply, 'evb-battery', [voltage_now-7500000]).
more('dc-motor', motor0,
     [ address-'ev3-ports:outD', driver_name-'rcx-motor', command-'',
       duty_cycle-0, duty_cycle_sp-0, state-'', stop_action-'' ]).
more('lego-port', port7,
     [ address-'ev3-ports:outD', driver_name-'ev3-output-port',
       mode-'dc-motor', set_device-'' ]).

motor(address, 'ev3-ports:outA').
motor(driver_name, 'lego-ev3-l-motor').
motor(commands, Text) :-
    atomic_list_concat(['run-forever', 'run-to-abs-pos', 'run-to-rel-pos',
                        'run-timed', 'run-direct', stop, reset], ' ', Text).
motor(command, '').
motor(count_per_rot, 360).
motor(max_speed, 1050).
motor(polarity, normal).
motor(position, 0).
motor(position_sp, 0).
motor(speed, 0).
motor(speed_sp, 0).
motor(state, '').
motor(stop_action, coast).
motor(stop_actions, 'coast brake hold').
motor(duty_cycle, 0).
motor(duty_cycle_sp, 0).
motor(ramp_up_sp, 0).
motor(ramp_down_sp, 0).
motor(time_sp, 0).

sensor(address, 'ev3-ports:in1').
sensor(driver_name, 'lego-ev3-touch').
sensor(mode, 'TOUCH').
sensor(modes, 'TOUCH').
sensor(num_values, 1).
sensor(decimals, 0).
sensor(units, '').
sensor(value0, 1).

write_file(Dir, Name, Text) :-
    atomic_list_concat([Dir, /, Name], File),
    setup_call_cleanup(
        open(File, write, Out),
        format(Out, '~w~n', [Text]),
        close(Out)).

holds(Root, Name, Expected) :-
    atomic_list_concat([Root, /, Name], File),
    setup_call_cleanup(
        open(File, read, In),
        line(In, Chars),
        close(In)),
    atom_chars(Expected, Chars).

line(In, Chars) :-
    get_char(In, Char),
    (   memberchk(Char, [end_of_file, '\n'])
    ->  Chars = []
    ;   Chars = [Char|Chars1],
        line(In, Chars1)
    ).
