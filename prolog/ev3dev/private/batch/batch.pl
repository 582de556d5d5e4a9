:- module(ev3dev_batch,
          [ batch_runs/6,               % +Program, +Seeds, +Workers, +Server,
                                        % :Report, -Done
            processors/1                % -Number
          ]).
:- use_module(pool,
              [ batch_step/3, end_workers/1, start_workers/2,
                workers_ready/2 ]).
:- use_module('../processes/redis', [redis_address/2]).

:- meta_predicate batch_runs(+, +, +, +, 2, -).

/** <module> The runs of a batch, here or on other machines
*/

%!  batch_runs(+Program, +Seeds, +Workers, +Server, :Report, -Done) is det.
%
%   Program is program(File, Test, World, Options, Limits), as of sim_batch/5.
%   Run it with each of Seeds, in as many processes as Workers says, or by the
%   workers of a Redis Server, if that is not `none`. Done is a list of
%   done(Number, Seed, Score), Number counting the Seeds. Whenever runs are
%   over, call(Report, Done0, Done1) is called: what is new in Done1 comes
%   first.
%
%   @error as sim_batch/5

batch_runs(Program, Seeds, _, Server, Report, Done) :-
    Server \== none,
    !,
    redis_address(Server, Address),
    use_module(library(ev3dev/private/batch/machines), []),
    ev3dev_batch_machines:redis_batch(Address, Program, Seeds, Report, Done).
batch_runs(Program, Seeds, Workers, _, Report, Done) :-
    length(Seeds, All),
    numbered(Seeds, 1, Todos),
    Number is max(1, min(Workers, All)),
    Program = program(File, Test, World, Options, Limits),
    runs(now(Todos, [], [], []), Number-begin(File, Test, World, Options),
         Limits, Report, Done).

numbered([], _, []).
numbered([Seed|Seeds], Number, [todo(Number, Seed, 1)|Todos]) :-
    Next is Number+1,
    numbered(Seeds, Next, Todos).

%   If all workers have died, there are others.

runs(now([], _, _, Done), _, _, _, Done) :-
    !.
runs(now(Todos, _, _, Done0), Number-Begin, Limits, Report, Done) :-
    setup_call_cleanup(
        start_workers(Number, Pool),
        ( workers_ready(Pool, Begin),
          steps(now(Todos, Pool, [], Done0), Limits, Report, Now) ),
        end_workers(Pool)),
    runs(Now, Number-Begin, Limits, Report, Done).

steps(Now0, Limits, Report, Now) :-
    Now0 = now(Todos, Idle, Busy, Done0),
    (   Busy == [],
        ( Todos == [] ; Idle == [] )
    ->  Now = Now0
    ;   batch_step(Limits, Now0, Now1),
        Now1 = now(_, _, _, Done1),
        (   Done1 == Done0
        ->  true
        ;   call(Report, Done0, Done1)
        ),
        steps(Now1, Limits, Report, Now)
    ).

%!  processors(-Number) is det.

processors(Number) :-
    (   current_prolog_flag(cpu_count, Number)
    ->  true
    ;   Number = 1
    ).
