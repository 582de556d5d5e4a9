:- module(paper, []).

/** <module> The paper's way, in plain Prolog

Our own rendering of what the paper's implementation does, for comparison:
each access looks through the class directory, and opens, reads and closes the
address and the driver name of each device in it; sensors are put into their
mode at each reading; a wait spins; two wheels are two threads.
*/

root(Root) :-
    getenv('EV3DEV_SYSFS', Root).

detect(Class, Port, Type, Path) :-
    root(Root),
    atomic_list_concat([Root, /, Class, '/*'], Pattern),
    expand_file_name(Pattern, Paths),
    member(Path, Paths),
    attribute(Path, address, Address),
    atom_concat('ev3-ports:', Port, Address),
    attribute(Path, driver_name, Type).

attribute(Path, Attribute, Value) :-
    atomic_list_concat([Path, /, Attribute], File),
    file_read(File, Value).

file_read(File, Value) :-
    setup_call_cleanup(
        open(File, read, Stream),
        read_string(Stream, "\n", "\n", _, String),
        close(Stream)),
    (   number_string(Number, String)
    ->  Value = Number
    ;   atom_string(Value, String)
    ).

file_write(File, Value) :-
    setup_call_cleanup(
        open(File, write, Stream),
        write(Stream, Value),
        close(Stream)).

motor_file(Port, Attribute, File) :-
    detect('tacho-motor', Port, _, Path),
    atomic_list_concat([Path, /, Attribute], File).

sensor_file(Port, Attribute, File) :-
    detect('lego-sensor', Port, _, Path),
    atomic_list_concat([Path, /, Attribute], File).

sensor_value(Port, Type, Mode, Value) :-
    detect('lego-sensor', Port, Type, _),
    sensor_file(Port, mode, ModeFile),
    file_write(ModeFile, Mode),
    sensor_file(Port, value0, ValueFile),
    file_read(ValueFile, Value).

us_dist_cm(Port, Centimetres) :-
    sensor_value(Port, 'lego-ev3-us', 'US-DIST-CM', Value),
    sensor_file(Port, decimals, File),
    file_read(File, Decimals),
    Centimetres is Value / 10.0 ** Decimals.

col_ambient(Port, Percent) :-
    sensor_value(Port, 'lego-ev3-color', 'COL-AMBIENT', Percent).

gyro_ang(Port, Degrees) :-
    sensor_value(Port, 'lego-ev3-gyro', 'GYRO-ANG', Degrees).

position(Port, Counts) :-
    motor_file(Port, position, File),
    file_read(File, Counts).

state(Port, State) :-
    motor_file(Port, state, File),
    file_read(File, State).

motor_run(Port, Percent) :-
    motor_file(Port, max_speed, MaxFile),
    file_read(MaxFile, Max),
    Speed is floor(Percent / 100.0 * Max),
    motor_file(Port, speed_sp, SpeedFile),
    file_write(SpeedFile, Speed),
    motor_file(Port, command, CommandFile),
    file_write(CommandFile, 'run-forever').

%!  spin(+Port, +Seconds)
%
%   What a wait for a motor does, here for some seconds only.

spin(Port, Seconds) :-
    get_time(Start),
    repeat,
    state(Port, State),
    (   State \== running
    ;   get_time(Now),
        Now - Start >= Seconds
    ),
    !.

%!  gap(-Seconds)
%
%   Between the moments at which two threads write the commands of two wheels.

gap(Seconds) :-
    thread_create(start_wheel(outB), Id1),
    thread_create(start_wheel(outC), Id2),
    thread_join(Id1, exited(Time1)),
    thread_join(Id2, exited(Time2)),
    Seconds is abs(Time1 - Time2).

start_wheel(Port) :-
    motor_file(Port, speed_sp, SpeedFile),
    file_write(SpeedFile, 210),
    motor_file(Port, command, CommandFile),
    get_time(Now),
    file_write(CommandFile, 'run-forever'),
    thread_exit(Now).
