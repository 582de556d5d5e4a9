% Runs an example for some simulated seconds, and prints what it printed, where it ran into
% something, and the whole trace: natively and in WebAssembly the same, byte for byte.

:- use_module(library(ev3dev)).
:- use_module(library(ev3dev/sim)).
:- use_module(library(lists)).

%!  played(+Example, +Seconds)
%
%   Worlds, goals, robots and hands are those of tools/demo.pl, which is module demo_script; `crowd`
%   is a robot among things that it pushes.

%
%   Or the random programs up to a seed: the recorder sees what a meta-interpreter sees.

played(random_programs, Last) :-
    !,
    load_files('tests/support/reasoning/compared.pl', []),
    findall(Seed-Same,
            ( between(1, Last, Seed),
              compared_events(Seed, Recorded, Interpreted),
              ( Recorded == Interpreted -> Same = true ; Same = false ) ),
            Pairs),
    findall(Seed, member(Seed-false, Pairs), Differ),
    length(Pairs, Count),
    ( Count >= 200 -> Enough = true ; Enough = Count ),
    % A seed makes other programs in another build of Prolog.
    format("200 programs: ~w, differ: ~w~n", [Enough, Differ]),
    ( Enough-Differ == true-[] -> true ; throw(differ(Differ)) ).
played(crowd, _) :-
    !,
    load_files('tests/support/things/crowd.pl', []),
    crowd_digest(Digest, Expected),
    format("~d of ~d~n", [Digest, Expected]).
played(Example, Seconds) :-
    (   demo_script:demo(Example, World, Goal) -> true ; World = room, Goal = start ),
    (   demo_script:robot(Example, Robot) -> true ; Robot = default ),
    atomic_list_concat(['examples/', Example, '.pl'], File),
    load_files(user:File, []),
    sim_start(World, [clock(virtual), robot(Robot), noise(true), seed(3)]),
    demo_script:prepare(Example),
    (   catch(for_seconds(Seconds, ignore(user:Goal)), E, true) -> true ; true ),
    (   var(E) -> true ; print_thrown(E) ),
    sim_collisions(Collisions),
    format("collisions: ~q~n", [Collisions]),
    sim_trace(Trace),
    % Zero bytes are not printed everywhere.
    forall(( member(Event, Trace), \+ Event = _-read('lego-sensor/sensor4/bin_data', _) ),
           format("~q~n", [Event])).

print_thrown(E) :-
    E = error(Formal, _),
    !,
    format("error: ~q~n", [Formal]).
print_thrown(E) :-
    format("thrown: ~q~n", [E]).
