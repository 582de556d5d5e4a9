:- module(ev3dev_sim_batch,
          [ sim_batch/4,                % +File, +Test, +Seeds, -Scores
            sim_batch/5                 % ..., +Options
          ]).
:- set_prolog_flag(generate_debug_info, false).
:- use_module(private/compiled, []).
:- use_module(private/arguments,
              [ must_be_options/3, number_option/4, number_value/3, option/3,
                take_options/4 ]).
:- use_module(private/errors,
              [in_own_name/1, must_be/2, term_expansion/4, throw_error/3]).
:- use_module(library(apply), [foldl/4, maplist/2]).
:- use_module(library(lists), [last/2, member/2, nth1/3]).
:- use_module(library(process),
              [ process_create/3, process_group_kill/2, process_kill/2,
                process_wait/2 ]).
:- use_module(library(readutil),
              [read_file_to_string/3, read_line_to_string/2]).

/** <module> The same program in many simulations

How well does a program do, and not only once? sim_batch/5 runs it with many
seeds, on all processors, and collects a score from each run.

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
none knows anything of another one, and the scores are the same with one
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
%     - limit(wall)
%     - limit(cpu)
%       It took too long.
%
%   Options are those of sim_start/2 but `seed`, and
%
%     - world(World)
%       Default is `room`.
%     - workers(Number)
%       How many runs there are at once. By default one for each processor.
%     - wall(Seconds)
%       How long a run may take. Default is 60.
%     - cpu(Seconds)
%       How much time of a processor a run may use, or `infinite`: the
%       default. This and `wall` are looked at five times a second.
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
%   @error existence_error(library, unix) where there is no fork/1

sim_batch(File, Test, Seeds, Scores) :-
    sim_batch(File, Test, Seeds, Scores, []).

sim_batch(File, Test, Seeds, Scores, Options) :-
    must_be(callable, Test),
    must_be(list(integer), Seeds),
    must_be_options(sim_batch_option,
                    [ world, workers, wall, cpu, progress,
                      clock, robot, noise, screen ], Options),
    take_options([world, workers, wall, cpu, progress], Options, Own, Sim),
    option(world(World), Own, room),
    own_options(Own, Workers, Wall, Cpu, Progress),
    in_own_name(absolute_file_name(File, Path,
                                   [file_type(prolog), access(read)])),
    length(Seeds, All),
    numbered(Seeds, 1, Todos),
    Number is max(1, min(Workers, All)),
    setup_call_cleanup(
        start_workers(Number, Pool),
        ( all_ready(Pool, begin(Path, Test, World, Sim)),
          batch(Todos, Pool, [], limits(Wall, Cpu, Progress-All), [], Done) ),
        end_workers(Pool)),
    msort(Done, Sorted),
    findall(Seed-Score, member(done(_, Seed, Score), Sorted), Scores).

own_options(Options, Workers, Wall, Cpu, Progress) :-
    (   current_prolog_flag(cpu_count, Processors)
    ->  true
    ;   Processors = 1
    ),
    option(workers(Workers), Options, Processors),
    must_be(positive_integer, Workers),
    number_option(wall(Wall), seconds, Options, 60),
    option(cpu(Cpu0), Options, infinite),
    (   Cpu0 == infinite
    ->  Cpu = infinite
    ;   number_value(seconds, Cpu0, Cpu)
    ),
    (   stream_property(user_error, tty(true))
    ->  Terminal = true
    ;   Terminal = false
    ),
    option(progress(Progress), Options, Terminal),
    must_be(boolean, Progress).

                /*******************************
                *           WORKERS            *
                *******************************/

%   A worker is a Prolog that has loaded the program, and makes a copy of
%   itself for each run: worker(Pid, In, Out).

start_workers(Number, Pool) :-
    (   Number =:= 0
    ->  Pool = []
    ;   start_worker(Worker),
        Pool = [Worker|Pool1],
        Number1 is Number-1,
        catch(start_workers(Number1, Pool1), Error,
              ( end_workers([Worker]),
                throw(Error) ))
    ).

start_worker(worker(Pid, In, Out)) :-
    current_prolog_flag(executable, Prolog),
    module_property(ev3dev_sim_batch, file(This)),
    file_directory_name(This, Folder),
    atom_concat(Folder, '/private/batch_worker.pl', Program),
    process_create(Prolog,
                   [ '-q', '-f', none, '-s', file(Program),
                     '-g', 'ev3dev_batch_worker:work', '-t', halt ],
                   [ stdin(pipe(In)), stdout(pipe(Out)), process(Pid),
                     detached(true) ]),
    maplist(set_utf8, [In, Out]).

set_utf8(Stream) :-
    set_stream(Stream, encoding(utf8)).

%   The first one alone prints what is wrong with the program.

all_ready([Worker|Workers], Begin) :-
    tell(Worker, loud(Begin)),
    must_be_ready(Worker),
    forall(member(Other, Workers), tell(Other, quiet(Begin))),
    maplist(must_be_ready, Workers).

must_be_ready(Worker) :-
    hear(Worker, Answer),
    (   Answer == ready
    ->  true
    ;   Answer = refused(error(Formal, Context))
    ->  (   nonvar(Context),
            Context = context(_, Message)
        ->  throw_error(Formal, _, Message)
        ;   throw(error(Formal, Context))
        )
    ;   has_died
    ).

has_died :-
    throw(error(system_error('the processes of the runs have died'), _)).

end_workers(Pool) :-
    forall(member(worker(Pid, In, Out), Pool),
           ( catch(process_group_kill(Pid, kill), _, true),
             maplist(close_quietly, [In, Out]),
             catch(process_wait(Pid, _), _, true) )).

close_quietly(Stream) :-
    catch(close(Stream, [force(true)]), _, true).

tell(worker(_, In, _), Term) :-
    format(In, '~k.~n', [Term]),
    flush_output(In).

hear(worker(_, _, Out), Answer) :-
    read_line_to_string(Out, Line),
    (   Line == end_of_file
    ->  Answer = over(died)
    ;   term_string(Answer, Line)
    ).

                /*******************************
                *             RUNS             *
                *******************************/

%   todo(Number, Seed, Tries): a run that is still to be made. Tries is how
%   often it may be tried again when its process dies.

numbered([], _, []).
numbered([Seed|Seeds], Number, [todo(Number, Seed, 1)|Todos]) :-
    Next is Number+1,
    numbered(Seeds, Next, Todos).

%   batch(+Todos, +Idle, +Busy, +Limits, +Done0, -Done): Done is a list of
%   done(Number, Seed, Score).

batch([], _, [], _, Done, Done) :-
    !.
batch([Todo|Todos], [Worker|Idle], Busy, Limits, Done0, Done) :-
    !,
    Todo = todo(_, Seed, _),
    catch(tell(Worker, Seed), error(_, _), true),       % a dead one is heard
    Limits = limits(Wall, _, _),
    in_seconds(Wall, Deadline),
    batch(Todos, Idle, [busy(Worker, Todo, none, none, Deadline)|Busy],
          Limits, Done0, Done).
batch(_, _, [], _, _, _) :-
    has_died.
batch(Todos, Idle, Busy, Limits, Done0, Done) :-
    findall(Out, member(busy(worker(_, _, Out), _, _, _, _), Busy), Outs),
    wait_for_input(Outs, Ready, 0.2),
    Limits = limits(_, Cpu, Report),
    foldl(progress(Ready, Cpu), Busy, now(Todos, Idle, [], Done0),
          now(Todos1, Idle1, Busy1, Done1)),
    report(Report, Done0, Done1),
    batch(Todos1, Idle1, Busy1, Limits, Done1, Done).

in_seconds(Seconds, Time) :-
    get_time(Now),
    Time is Now+Seconds.

%   busy(Worker, Todo, Process, Score, Deadline): Process is that of the run
%   and Score score(Score), also when the run was ended here. As long as it is
%   not known: `none`.

progress(Ready, Cpu, Busy, Now0, Now) :-
    Busy = busy(Worker, Todo, Process, Score, Deadline),
    Worker = worker(_, _, Out),
    (   memberchk(Out, Ready)
    ->  hear(Worker, Answer),
        heard(Answer, Busy, Now0, Now)
    ;   integer(Process),
        beyond(Process, Deadline, Cpu, Limit)
    ->  process_kill(Process, kill),
        (   Score == none
        ->  Ended = score(limit(Limit))
        ;   Ended = Score
        ),
        still(busy(Worker, Todo, none, Ended, Deadline), Now0, Now)
    ;   still(Busy, Now0, Now)
    ).

beyond(_, Deadline, _, wall) :-
    get_time(Now),
    Now > Deadline,
    !.
beyond(Process, _, Cpu, cpu) :-
    Cpu \== infinite,
    process_cpu(Process, Used),
    Used > Cpu.

%   The time of a processor that it has used: proc_pid_stat(5), in hundredths
%   of a second. The second field is in parentheses, and may have spaces.

process_cpu(Process, Seconds) :-
    atomic_list_concat(['/proc/', Process, '/stat'], File),
    catch(read_file_to_string(File, Text, []), error(_, _), fail),
    split_string(Text, ")", " ", Parts),
    last(Parts, Fields),
    split_string(Fields, " ", "", List),
    nth1(12, List, User),
    nth1(13, List, System),
    number_string(UserTicks, User),
    number_string(SystemTicks, System),
    Seconds is (UserTicks+SystemTicks)/100.

still(Busy, now(Todos, Idle, Busys, Done),
      now(Todos, Idle, [Busy|Busys], Done)).

%   A process that has a score may hang when it halts.

heard(process(Process), busy(Worker, Todo, _, Score, Deadline), Now0, Now) :-
    still(busy(Worker, Todo, Process, Score, Deadline), Now0, Now).
heard(score(Score), busy(Worker, Todo, Process, _, _), Now0, Now) :-
    in_seconds(2, Deadline),
    still(busy(Worker, Todo, Process, score(Score), Deadline), Now0, Now).
heard(over(Status), busy(Worker, Todo, _, Score, _),
      now(Todos, Idle0, Busys, Done), now(Todos1, Idle, Busys, Done1)) :-
    Todo = todo(Number, Seed, Tries),
    (   Status == died
    ->  Idle = Idle0
    ;   Idle = [Worker|Idle0]
    ),
    (   run_score(Score, Status, Tries, Value)
    ->  Todos1 = Todos,
        Done1 = [done(Number, Seed, Value)|Done]
    ;   Todos1 = [todo(Number, Seed, 0)|Todos],
        Done1 = Done
    ).

%   Fails if it is to be tried again.

run_score(score(Score), _, _, Score) :-
    !.
run_score(none, _, 0, error(died)).

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
