/*  An example of the installed pack drives in the installed simulator.

        swipl -g main -t 'halt(1)' tests/brick/example.pl

    EV3DEV_PACK names the pack's folder, as for smoke.pl.
*/

:- (   getenv('EV3DEV_PACK', Pack)
   ->  atom_concat(Pack, '/prolog', Folder),
       asserta(user:file_search_path(library, Folder))
   ;   true
   ).
:- use_module(library(ev3dev)).
:- use_module(library(ev3dev/sim)).
:- module_property(ev3dev, file(File)),
   file_directory_name(File, Prolog),
   file_directory_name(Prolog, Pack),
   atom_concat(Pack, '/examples/obstacle_avoidance.pl', Example),
   user:load_files(Example, []).

main :-
    sim_start(room, [clock(virtual)]),
    % It never ends by itself.
    call_with_inference_limit(user:start, 2000000, Ended),
    Ended == inference_limit_exceeded,
    stop,
    sim_time(Seconds),
    sim_pose(X, Y, Heading),
    sim_collisions(Collisions),
    format('after ~1f s at ~0f, ~0f cm, heading ~0f~n',
           [Seconds, X, Y, Heading]),
    % It has met a wall, and turned aside.
    abs(Heading) > 80,
    Collisions == [],
    sim_stop,
    halt(0).
