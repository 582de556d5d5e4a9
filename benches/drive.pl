% What the loop that keeps a robot on its course costs: the share of a core that
% the process takes for ten seconds of a drive in the simulator, in real time,
% and for the same with nothing but running motors.

:- use_module(library(ev3dev)).
:- use_module(library(ev3dev/drive)).
:- use_module(library(ev3dev/sim)).

:- initialization(main, main).

main :-
    share(steer(30, 20), With),
    share(true, Without),
    format("~6f ~6f~n", [With, Without]).

share(Drive, Share) :-
    sim_start([], [clock(realtime)]),
    (   Drive = true
    ->  motors_run([run(outB, 36), run(outC, 24)])
    ;   set_robot(5.6, 10.6, outB, outC),
        call(Drive)
    ),
    statistics(process_cputime, Cpu0),
    get_time(Time0),
    sleep(10),
    get_time(Time1),
    statistics(process_cputime, Cpu1),
    stop_all_motors,
    sim_stop,
    Share is (Cpu1 - Cpu0) / (Time1 - Time0).
