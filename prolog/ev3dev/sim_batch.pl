:- module(ev3dev_sim_batch,
          [ sim_batch/4,                % +File, +Test, +Seeds, -Scores
            sim_batch/5,                % ..., +Options
            sim_batch_work/2            % +Address, +Workers
          ]).
:- set_prolog_flag(generate_debug_info, false).
:- use_module(private/load/compiled, []).
:- use_module(private/checks/arguments,
              [ limit_option/3, must_be_options/3, option/3,
                take_options/4 ]).
:- use_module(private/checks/checks, [must_be/2]).
:- use_module(private/errors/errors, [in_own_name/1]).
:- use_module(private/errors/public_clauses, [term_expansion/4]).
:- use_module(private/batch/batch, [batch_runs/6, processors/1]).
:- use_module(private/processes/redis, [redis_address/2]).
:- use_module(library(lists), [member/2]).

/** <module> The same program in many simulations

One run says little about a program. sim_batch/5 runs it with many seeds, on
all processors, and collects a score from each run.

```
score(Cm) :-                            % in explorer.pl
    for_seconds(60, explore),
    sim_pose(X, Y, _),
    Cm is sqrt((X-200)**2 + (Y-150)**2).
```

```
?- numlist(1, 200, Seeds),
   sim_batch('explorer.pl', score, Seeds, Scores, [world(maze), noise(true)]).
Scores = [1-12.5, 2-31.0, 3-error(...), ...].
```

Each run is a process of its own, which begins right after File was loaded. So
no run knows anything of another one, and the scores are the same with one
processor as with many.
*/

%!  sim_batch(+File, +Test, +Seeds, -Scores) is det.
%!  sim_batch(+File, +Test, +Seeds, -Scores, +Options) is det.
%
%   Load the program File, and for each seed, an integer of the list Seeds,
%   call Test with one more argument, a Score, in a simulation as of
%   with_sim/3 with that seed. Test is an atom or a term, called in the module
%   of File, or in `user`. Scores is a list of Seed-Score in the order of
%   Seeds. Score is what Test answers first, or
%
%     - failed
%       Test failed.
%     - error(Message)
%       It threw an error. Message is an atom, what Prolog would print.
%     - error(died)
%       Its process ended without a score, twice: by a crash, or by halt/0.
%     - limit(sleep)
%     - limit(cpu)
%       It slept or computed for too long.
%
%   Options are those of sim_start/2 but `seed`, and
%
%     - world(World)
%       Default is `room`. With `none` no simulation is started: Test gets the
%       seed, too, before its score, and may start its own. Random numbers
%       follow the seed in any case.
%     - workers(Number)
%       How many runs there are at once. By default one for each processor.
%     - sleep(Seconds)
%       How long a run may sleep, in all its processes at once, as in sleep/1
%       or a read, or `infinite`. Default is 60.
%     - cpu(Seconds)
%       How much time of a processor a run and its processes may use, or
%       `infinite`. Default is 60. No other program can make a run come to
%       these limits. They are looked at five times a second.
%     - redis(Address)
%       Have the workers of a Redis server make the runs, Host or Host:Port:
%       on each machine that takes part `swipl ev3dev work --redis Host:Port`
%       runs, with the same version of this pack. They get the text of File;
%       what it loads must be at the same places there. Each has its own
%       `workers`. If a machine dies, others make its runs. Who can write to
%       that server can run programs on these machines.
%     - progress(Boolean)
%       Whether to print how many runs are over. By default `true` if there is
%       a terminal.
%
%   What the runs print is dropped; for_seconds/2 of library(ev3dev/sim) ends
%   one after a simulated time. A simulation of the caller goes on.
%
%   @error existence_error(source_sink, File)
%   @error existence_error(procedure, Name/Arity) if File has no such Test
%   @error type_error(integer, Seed)
%   @error domain_error(sim_batch_option, Option)
%   @error the errors of sim_start/2 for its options
%   @error existence_error(library, unix) if there is no fork/1
%   @error existence_error(redis_server, Address) if it is not there at first
%   @error existence_error(library, redis) in a Prolog without it
%
%   If that server goes away, this waits until it is there again, and then has
%   the runs made that are not over.

sim_batch(File, Test, Seeds, Scores) :-
    sim_batch(File, Test, Seeds, Scores, []).

sim_batch(File, Test, Seeds, Scores, Options) :-
    must_be(callable, Test),
    must_be(list(integer), Seeds),
    must_be_options(sim_batch_option,
                    [ world, workers, sleep, cpu, progress, redis,
                      clock, robot, noise, screen, thinking ], Options),
    take_options([world, workers, sleep, cpu, progress, redis], Options,
                 Own, Sim),
    option(world(World), Own, room),
    own_options(Own, Workers, Limits, Progress),
    option(redis(Address), Own, none),
    in_own_name(absolute_file_name(File, Path,
                                   [file_type(prolog), access(read)])),
    length(Seeds, All),
    batch_runs(program(Path, Test, World, Sim, Limits), Seeds, Workers,
               Address, ev3dev_sim_batch:report(Progress-All), Done),
    msort(Done, Sorted),
    findall(Seed-Score, member(done(_, Seed, Score), Sorted), Scores).

%!  sim_batch_work(+Address, +Workers) is det.
%
%   Make the runs that sim_batch/5 asks for by the Redis server at Address,
%   Workers at a time, until it is interrupted: what `swipl ev3dev work` does.
%   If the server goes away, it is looked for every two seconds.
%
%   @error existence_error(redis_server, Address) if it is not there at first
%   @error existence_error(library, redis) in a Prolog without it

sim_batch_work(Address, Workers) :-
    must_be(nonvar, Address),
    must_be(positive_integer, Workers),
    redis_address(Address, HostPort),
    use_module(library(ev3dev/private/batch/machines), []),
    ev3dev_batch_machines:redis_work(HostPort, Workers).

own_options(Options, Workers, limits(Sleep, Cpu), Progress) :-
    processors(Processors),
    option(workers(Workers), Options, Processors),
    must_be(positive_integer, Workers),
    limit_option(sleep(Sleep), Options, 60),
    limit_option(cpu(Cpu), Options, 60),
    (   stream_property(user_error, tty(true))
    ->  Terminal = true
    ;   Terminal = false
    ),
    option(progress(Progress), Options, Terminal),
    must_be(boolean, Progress).

%   Ten times in all.

report(true-All, Before, Done) :-
    tenths(Before, All, Tenths0),
    tenths(Done, All, Tenths),
    Tenths > Tenths0,
    !,
    length(Done, Over),
    print_message(informational, ev3dev(runs_over(Over, All))).
report(_, _, _).

tenths(Done, All, Tenths) :-
    length(Done, Over),
    Tenths is Over*10//All.

:- multifile prolog:message//1.

prolog:message(ev3dev(runs_over(Over, All))) -->
    [ '~d of ~d runs are over'-[Over, All] ].
