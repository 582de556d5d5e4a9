:- module(ev3dev_batch_pool,
          [ start_workers/2,            % +Number, -Pool
            workers_ready/2,            % +Pool, +Begin
            end_workers/1,              % +Pool
            batch_step/3                % +Limits, +State0, -State
          ]).
:- use_module('../basics/fields',
              [fields/1, goal_expansion/2, term_expansion/2]).
:- use_module('../errors/errors', [throw_error/3]).
:- use_module('../processes/usage',
              [ usage_begins/1, usage_beyond/3, usage_goes_on/5 ]).
:- use_module(library(apply), [foldl/4, maplist/2]).
:- use_module(library(lists), [member/2]).
:- use_module(library(process),
              [ process_create/3, process_group_kill/2, process_kill/2,
                process_wait/2 ]).
:- use_module(library(readutil),
              [read_line_to_string/2]).

:- fields(busy(worker, todo, process, score, used)).

/** <module> Processes that run a program with many seeds

A state of a batch is now(Todos, Idle, Busy, Done): what is still to be run,
todo(Number, Seed, Tries), Tries being how often it may be tried again when
its process dies; the workers that have nothing to do; the runs under way; and
the results, done(Number, Seed, Score).
*/

% ---------------- WORKERS

%!  start_workers(+Number, -Pool) is det.
%
%   Each worker is a Prolog that loads the program, and makes a copy of itself
%   for each run: worker(Pid, In, Out).

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

%   Workers that live on as the program halts are ended.

:- dynamic worker_process/1.
:- volatile worker_process/1.

:- initialization(at_halt(ev3dev_batch_pool:end_left), now).

end_left :-
    forall(retract(worker_process(Pid)), end_worker(Pid)).

%   One that has just begun has no group yet.

end_worker(Pid) :-
    catch(process_group_kill(Pid, kill), _, true),
    catch(process_kill(Pid, kill), _, true).

start_worker(worker(Pid, In, Out)) :-
    current_prolog_flag(executable, Prolog),
    module_property(ev3dev_batch_pool, file(This)),
    file_directory_name(This, Folder),
    atom_concat(Folder, '/worker.pl', Program),
    process_create(Prolog,
                   [ '-q', '-f', none, '-s', file(Program),
                     '-g', 'ev3dev_batch_worker:work', '-t', halt ],
                   [ stdin(pipe(In)), stdout(pipe(Out)), process(Pid),
                     detached(true) ]),
    assertz(worker_process(Pid)),
    maplist(set_utf8, [In, Out]).

set_utf8(Stream) :-
    set_stream(Stream, encoding(utf8)).

%!  workers_ready(+Pool, +Begin) is det.
%
%   The workers load the program: begin(File, Test, World, Options). The first
%   one alone prints what is wrong with it.
%
%   @error what it cannot begin with

workers_ready([Worker|Workers], Begin) :-
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

%!  end_workers(+Pool) is det.

end_workers(Pool) :-
    forall(member(worker(Pid, In, Out), Pool),
           ( retractall(worker_process(Pid)),
             end_worker(Pid),
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

% ---------------- RUNS

%!  batch_step(+Limits, +State0, -State) is det.
%
%   Give work to the idle workers, and hear the others, which takes at most a
%   fifth of a second. Limits is limits(Sleep, Cpu), in seconds.
%
%   @error system_error(Message) if all workers have died

batch_step(Limits, now(Todos0, Idle0, Busy0, Done0), Now) :-
    given(Todos0, Idle0, Busy0, Todos, Idle, Busy),
    (   Busy == [],
        Todos \== []
    ->  has_died
    ;   findall(Out, member(busy(worker: worker(_, _, Out)), Busy),
                Outs),
        ready_soon(Outs, Ready),
        foldl(progress(Ready, Limits), Busy, now(Todos, Idle, [], Done0), Now)
    ).

%   9.2.9 crashes some time after wait_for_input/3 was left by Ctrl-C or a
%   signal, so it does not wait. By 0 it would wait forever in 7.2.3.

look_every(0.2).

ready_soon(Outs, Ready) :-
    look_every(Slice),
    between(1, 20, Look),
    wait_for_input(Outs, Ready, 0.000001),
    (   Ready == [],
        Look < 20
    ->  Seconds is Slice/20,
        sleep(Seconds),
        fail
    ;   true
    ),
    !.

given([Todo|Todos0], [Worker|Idle0], Busy0, Todos, Idle, Busy) :-
    !,
    Todo = todo(_, Seed, _),
    catch(tell(Worker, Seed), error(_, _), true),       % a dead one is heard
    usage_begins(Used),
    given(Todos0, Idle0, [busy(Worker, Todo, none, none, Used)|Busy0],
          Todos, Idle, Busy).
given(Todos, Idle, Busy, Todos, Idle, Busy).

%   busy(Worker, Todo, Process, Score, Used): Process is that of the run and
%   Score score(Score), also when the run was ended here. As long as it is
%   not known: `none`. Used is as in library(ev3dev/private/processes/usage).

progress(Ready, Limits, Busy, Now0, Now) :-
    Busy = busy(Worker, Todo, Process, Score, Used0),
    Worker = worker(_, _, Out),
    (   memberchk(Out, Ready)
    ->  hear(Worker, Answer),
        heard(Answer, Busy, Now0, Now)
    ;   integer(Process)
    ->  look_every(Slice),
        usage_goes_on(Process, Slice, true, Used0, Used),
        (   has_to_end(Score, Used, Limits, Ended)
        ->  process_kill(Process, kill),
            Busy1 = busy(Worker, Todo, none, Ended, Used)
        ;   Busy1 = busy(Worker, Todo, Process, Score, Used)
        ),
        still(Busy1, Now0, Now)
    ;   still(Busy, Now0, Now)
    ).

%   A process that has a score may hang when it halts. One that is lost is
%   made again, as if it had died.

has_to_end(score(Score), Used, limits(_, Cpu), score(Score)) :-
    usage_beyond(Used, limits(2, Cpu), _).
has_to_end(none, Used, Limits, Ended) :-
    usage_beyond(Used, Limits, Limit),
    ( Limit == lost -> Ended = none ; Ended = score(Limit) ).

still(Busy, now(Todos, Idle, Busys, Done),
      now(Todos, Idle, [Busy|Busys], Done)).

heard(process(Process), busy(Worker, Todo, _, Score, Used), Now0, Now) :-
    still(busy(Worker, Todo, Process, Score, Used), Now0, Now).
heard(score(Score), busy(Worker, Todo, Process, _, _), Now0, Now) :-
    usage_begins(Used),
    still(busy(Worker, Todo, Process, score(Score), Used), Now0, Now).
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
