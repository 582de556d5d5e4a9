% How fast the simulator is: a program that polls its sensors drives an hour
% round and round in `room` on the virtual clock. Prints the simulated seconds a second, and the
% resident kilobytes after a tenth of the time and at the end.

:- use_module(library(ev3dev)).
:- use_module(library(ev3dev/sim)).
:- use_module(library(readutil)).

:- initialization(main, main).

main :-
    sim_start(room, [clock(virtual)]),
    set_robot(5.6, 10.6, outB, outC),
    get_time(Start),
    drive_until(360),
    resident(Early),
    drive_until(3600),
    get_time(End),
    resident(Late),
    Speed is 3600 / (End - Start),
    format("~0f ~w ~w~n", [Speed, Early, Late]).

drive_until(Time) :-
    repeat,
    us_dist_cm(_, _),
    gyro_ang(_, _),
    motors_run([run(outB, 20), run(outC, 10)]),
    sim_time(Now),
    Now >= Time,
    !.

resident(Kilobytes) :-
    read_file_to_string('/proc/self/status', Status, []),
    split_string(Status, "\n", "", Lines),
    member(Line, Lines),
    string_concat("VmRSS:", Rest, Line),
    !,
    split_string(Rest, " \t", " \t", Words),
    once(( member(Word, Words), number_string(Kilobytes, Word) )).
