% Mounts a simulated brick until the standard input ends. Each term in it is
% a goal to be called.

:- use_module(library(ev3dev)).
:- use_module(library(ev3dev/sim)).

serve(Directory) :-
    serve(Directory, default).

serve(Directory, Robot) :-
    sim_start(room, [clock(realtime), robot(Robot)]),
    atom_concat(Directory, '.dev', Dev),
    sim_mount(Directory, Dev),
    obey,
    sim_unmount,
    sim_stop,
    halt(0).

obey :-
    read_term(Goal, []),
    (   Goal == end_of_file
    ->  true
    ;   call(Goal),
        obey
    ).
