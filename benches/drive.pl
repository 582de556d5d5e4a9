% What the loop that keeps a robot on its course costs: by how much the share of a core
% that the process takes is larger for a drive in the simulator, in real time, than for
% nothing but running motors. Ten times, as one comes out as large as the other.

:- use_module(library(ev3dev)).
:- use_module(library(ev3dev/drive)).
:- use_module(library(ev3dev/sim)).

:- initialization(main, main).

main :-
    forall(between(1, 10, _),
           ( share(steer(30, 20), With),
             share(true, Without),
             More is With - Without,
             format("~6f ", [More]) )),
    nl.

share(Drive, Share) :-
    sim_start([], [clock(realtime)]),
    (   Drive = true
    ->  motors_run([run(outB, 36), run(outC, 24)])
    ;   set_robot(5.6, 10.6, outB, outC),
        call(Drive)
    ),
    statistics(process_cputime, Cpu0),
    get_time(Time0),
    sleep(4),
    get_time(Time1),
    statistics(process_cputime, Cpu1),
    stop_all_motors,
    sim_stop,
    Share is (Cpu1 - Cpu0) / (Time1 - Time0).
