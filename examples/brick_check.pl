#!/usr/bin/env swipl
% Tests a robot's motors and sensors, and prints a report.
%
%   ./brick_check.pl | tee report.txt
%
% Lift the robot off the ground: the program turns each motor by a quarter and
% back. It reads each sensor in each of its modes, except the modes that
% calibrate it or measure only once, and restores its mode. It reports errors
% and goes on. Send the report with a bug report.

:- module(brick_check, [main/0]).
:- use_module(library(ev3dev)).
:- use_module(library(ev3dev/private/native/library_file)).
:- use_module(library(lists), [member/2]).

:- initialization(main, main).

main :-
    call_cleanup(report, stop_all_motors),
    halt.

report :-
    attempt(machine),
    attempt(devices),
    forall(tacho_motor(Port, Type), check(Port, Type, motor)),
    forall(lego_sensor(Port, Type), check(Port, Type, sensor)),
    format("end of report~n").

check(Port, Type, Kind) :-
    format("~n~w ~w~n", [Port, Type]),
    Check =.. [Kind, Port],
    attempt(Check),
    attempt(reading_time(Kind, Port)).

%   Run a part of the report, and print if it fails or throws. Ctrl-C ends the
%   report.

attempt(Goal) :-
    catch(outcome(Goal), error(Formal, Context),
          format("ERROR in ~w: ~p~n", [Goal, error(Formal, Context)])).

outcome(Goal) :-
    (   call(Goal)
    ->  true
    ;   format("FAILED: ~w~n", [Goal])
    ).

                /*******************************
                *           MACHINE            *
                *******************************/

machine :-
    forall(member(What, [prolog, arch, pack, library, tree, kernel, battery]),
           attempt(line(What))).

line(What) :-
    (   fact(What, Text)
    ->  true
    ;   Text = unknown
    ),
    format("~w~t~10|~w~n", [What, Text]).

fact(prolog, Version) :-
    current_prolog_flag(version, Version).
fact(arch, Arch) :-
    current_prolog_flag(arch, Arch).
fact(pack, Version) :-
    module_property(ev3dev, file(File)),
    file_directory_name(File, Prolog),
    file_directory_name(Prolog, Pack),
    atom_concat(Pack, '/pack.pl', Facts),
    setup_call_cleanup(
        open(Facts, read, In),
        read_version(In, Version),
        close(In)).
fact(library, File) :-
    library_file(File).
fact(tree, Directory) :-
    ev3_sysfs(Directory).
fact(kernel, Text) :-
    file_read('/proc/version', Text).
fact(battery, Text) :-
    ev3_sysfs(Directory),
    atom_concat(Directory, '/power_supply/*/voltage_now', Pattern),
    expand_file_name(Pattern, Files),
    member(File, Files),
    exists_file(File),
    file_read(File, Microvolts),
    number(Microvolts),
    !,
    Volts is Microvolts/1000000.0,
    format(atom(Text), "~2f V", [Volts]).

read_version(In, Version) :-
    repeat,
    read(In, Term),
    (   Term = version(Version)
    ;   Term == end_of_file
    ),
    !,
    nonvar(Version).

devices :-
    format("~n"),
    ev3_devices,
    (   \+ tacho_motor(_),
        \+ lego_sensor(_)
    ->  format("no motor and no sensor is connected~n")
    ;   true
    ).

                /*******************************
                *     MOTORS AND SENSORS       *
                *******************************/

motor(Port) :-
    call_cleanup(
        forall(member(Angle, [90, -90]), attempt(turn_by(Port, Angle))),
        motor_stop(Port, coast)).

turn_by(Port, Angle) :-
    motor_attribute(Port, count_per_rot, Rotation),
    position(Port, From),
    ev3_time(Start),
    (   motor_run(Port, 20, Angle, [timeout(3)])
    ->  Ended = ended
    ;   Ended = failed
    ),
    ev3_time(End),
    position(Port, To),
    Expected is Angle*Rotation//360,
    Counts is To-From,
    (   Ended == ended,
        abs(Counts-Expected) < 20
    ->  Verdict = ok
    ;   Verdict = 'FAILED'
    ),
    Seconds is End-Start,
    format("    turn by ~d degrees: ~w, ~d of ~d counts in ~2f s~n",
           [Angle, Verdict, Counts, Expected, Seconds]).

sensor(Port) :-
    mode(Port, Own),
    sensor_attribute(Port, modes, Text),
    atomic_list_concat(Modes, ' ', Text),
    call_cleanup(
        forall(member(Mode, Modes), attempt(read_mode(Port, Mode))),
        mode(Port, Own)).

read_mode(_, Mode) :-
    left_out(Mode),
    !,
    format("    ~w: left out~n", [Mode]).
read_mode(Port, Mode) :-
    mode(Port, Mode),
    sensor_attribute(Port, num_values, Count),
    Last is Count-1,
    findall(Value,
            ( between(0, Last, Index),
              sensor_value(Port, Mode, Index, Value)
            ),
            Values),
    format("    ~w: ~w~n", [Mode, Values]).

%   Modes for calibration, and modes for single measurements, which lock the
%   sensor up if they are less than 250 ms apart.

left_out(Mode) :-
    atom_concat(_, '-CAL', Mode),
    !.
left_out(Mode) :-
    atom_concat('US-SI-', _, Mode).

reading_time(Kind, Port) :-
    ev3_time(Start),
    forall(between(1, 1000, _), read_once(Kind, Port)),
    ev3_time(End),
    Milliseconds is (End-Start)*1000,
    format("    1000 reads: ~0f ms~n", [Milliseconds]).

read_once(motor, Port) :-
    position(Port, _).
read_once(sensor, Port) :-
    value(Port, 0, _).
