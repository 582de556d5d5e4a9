% Mounts a simulated brick until the standard input ends.

:- use_module(library(ev3dev)).
:- use_module(library(ev3dev/sim)).

serve(Directory) :-
    serve(Directory, default).

serve(Directory, Robot) :-
    sim_start(room, [clock(realtime), robot(Robot)]),
    sim_mount(Directory),
    read_term(_, []),
    sim_unmount,
    sim_stop,
    halt(0).
