:- module(ev3dev_batch_machines,
          [ redis_batch/5,              % +Address, +Program, +Seeds,
                                        % :Report, -Done
            redis_work/2                % +Address, +Workers
          ]).
:- use_module('../basics/fields',
              [fields/1, goal_expansion/2, term_expansion/2]).
:- use_module(workplace, [end_workplace/1, new_workplace/2]).
:- use_module(pool,
              [ batch_step/3, end_workers/1, start_workers/2,
                workers_ready/2 ]).
:- use_module('../checks/checks', [must_be/2]).
:- use_module('../processes/redis', [ask/3, connection_lost/1, with_redis/3]).
:- use_module(library(filesex), [directory_file_path/3]).
:- use_module(library(lists), [append/3, member/2]).
:- use_module(library(readutil), [read_file_to_string/3]).
:- use_module(library(socket), [gethostname/1]).

:- fields(program(batch, pool, begin, limits, folder)).

:- meta_predicate
    redis_batch(+, +, +, 2, -),
    there_again(+, -, 0).

/** <module> Runs of sim_batch/5 on several machines

A Redis server hands them out. It has

| `ev3dev:runs`         | stream of batch, number, seed; group `workers`   |
| `ev3dev:batches`      | counts the batches                               |
| `ev3dev:batch:BATCH`  | program(File, Text, Test, World, Options, Limits)|
| `ev3dev:scores:BATCH` | list of done(Number, Seed, Score), refused(Error)|
| `ev3dev:worker:NAME`  | while this worker lives                          |

A run belongs to the worker that has read it from the stream. Every second
that worker claims its runs again; what nobody has claimed for five seconds is
of a worker that has died, and goes to another one. So a run may be made
twice, with the same score. xlisten_group/5 of library(redis_streams) does not
renew claims while a run lasts, so a long run would go to a second worker.
*/

%   Seconds, seconds, and the milliseconds of a claim.

kept(86400).
alive(5).
abandoned(5000).

%!  redis_batch(+Address, +Program, +Seeds, :Report, -Done) is det.
%
%   Have the workers at Address, Host:Port, make these runs. Program is
%   program(File, Test, World, Options, Limits). Done is a list of
%   done(Number, Seed, Score), as of batch_step/3; call(Report, Before, After)
%   is called when there are more of them.
%
%   @error existence_error(redis_server, Address)
%   @error what the first worker cannot begin with

redis_batch(Address, program(File, Test, World, Options, Limits), Seeds,
            Report, Done) :-
    read_file_to_string(File, Text, [encoding(utf8)]),
    with_redis(Address, Redis, new_batch(Redis, Batch)),
    made(Batch, Address, program(File, Text, Test, World, Options, Limits),
         Seeds, Report, [], Done).

new_batch(Redis, Batch) :-
    ask(Redis, incr('ev3dev:batches'), Batch).

%   Done0 is what is done already. If the server goes away, the next batch
%   has the rest: a server may come back with what it had, or empty.

made(Batch, Address, Program, Seeds, Report, Done0, Done) :-
    batch_key(batch, Batch, Key),
    batch_key(scores, Batch, Scores),
    length(Seeds, Count),
    call_cleanup(
        ( catch(with_redis(Address, Redis,
                    ( keep(Redis, Key, Program),
                      handed_out(Seeds, 1, Done0, Redis, Batch),
                      get_time(Now),
                      collected(Redis, Scores, Count, Report,
                                no_worker(Now), Done0, Done1) )),
                Error,
                ( must_be_lost(Error),
                  Done1 = Done0 )),
          (   length(Done1, Count)
          ->  Next = none
          ;   there_again(Address, Again, new_batch(Again, Next))
          ) ),
        forgotten(Address, [Key, Scores])),
    (   Next == none
    ->  Done = Done1
    ;   made(Next, Address, Program, Seeds, Report, Done1, Done)
    ).

must_be_lost(Error) :-
    (   connection_lost(Error)
    ->  true
    ;   throw(Error)
    ).

there_again(Address, Redis, Goal) :-
    print_message(warning, ev3dev(redis_lost(Address))),
    repeat,
    sleep(2),
    catch(with_redis(Address, Redis, Goal), error(_, _), fail),
    !.

keep(Redis, Key, Term) :-
    kept(Seconds),
    format(string(Text), '~k', [Term]),
    ask(Redis, set(Key, Text, ex, Seconds), _).

handed_out([], _Number, _Done, _Redis, _Batch).
handed_out([Seed|Seeds], Number, Done, Redis, Batch) :-
    (   memberchk(done(Number, _, _), Done)
    ->  true
    ;   ask(Redis, xadd('ev3dev:runs', *, batch, Batch, number, Number,
                        seed, Seed), _)
    ),
    Next is Number+1,
    handed_out(Seeds, Next, Done, Redis, Batch).

%   Workers drop the runs of a batch that is forgotten. An interrupt may have
%   left an answer half read, so this takes a connection of its own.

forgotten(Address, Keys) :-
    catch(with_redis(Address, Redis,
                     forall(member(Key, Keys), ask(Redis, del(Key), _))),
          error(_, _), true).

%   Ends when all is done, or the server has gone.

collected(Redis, Scores, Count, Report, Wait0, Done0, Done) :-
    (   length(Done0, Count)
    ->  Done = Done0
    ;   catch(looked(Redis, Scores, Wait0, Wait, Answer), Error, true),
        (   nonvar(Error)
        ->  must_be_lost(Error),
            Done = Done0
        ;   added(Answer, Done0, Done1),
            (   Done1 == Done0
            ->  true
            ;   call(Report, Done0, Done1)
            ),
            collected(Redis, Scores, Count, Report, Wait, Done1, Done)
        )
    ).

%   A blocking command would be deaf to signals.

looked(Redis, Scores, Wait0, Wait, Answer) :-
    (   ask(Redis, lpop(Scores), Text)
    ->  term_to_atom(Answer, Text),
        Wait = none
    ;   sleep(0.05),
        nobody_works(Wait0, Redis, Wait),
        Answer = none
    ).

added(none, Done, Done).
added(done(Number, Seed, Score), Done0, Done) :-
    (   memberchk(done(Number, _, _), Done0)
    ->  Done = Done0
    ;   Done = [done(Number, Seed, Score)|Done0]
    ).
added(refused(error(Formal, Context)), _, _) :-
    throw(error(Formal, Context)).

nobody_works(no_worker(Since), Redis, Wait) :-
    get_time(Now),
    Now > Since+3,
    !,
    (   ask(Redis, keys('ev3dev:worker:*'), [_|_])
    ->  true
    ;   print_message(help, ev3dev(no_batch_worker))
    ),
    Wait = none.
nobody_works(Wait, _, Wait).

%!  redis_work(+Address, +Workers) is det.
%
%   Make runs, Workers at a time, until a signal comes. Where the server goes
%   away, try to reach it every two seconds.
%
%   @error existence_error(redis_server, Address) if it is not there at first

redis_work(Address, Workers) :-
    must_be(positive_integer, Workers),
    gethostname(Host),
    current_prolog_flag(pid, Pid),
    atomic_list_concat([Host, -, Pid], Me),
    with_redis(Address, _, true),
    redis_work_(Address, work(Me, Workers)).

redis_work_(Address, Work) :-
    repeat,
    catch(with_redis(Address, Redis, works(Redis, Work)), Error, true),
    (   connection_lost(Error)
    ->  there_again(Address, _, true),
        redis_work_(Address, Work)
    ;   !,
        throw(Error)
    ).

works(Redis, work(Me, Number)) :-
    catch(ask(Redis, xgroup(create, 'ev3dev:runs', workers, '0', mkstream),
              _),
          error(redis_error(busygroup, _), _), true),
    atom_concat('ev3dev:worker:', Me, Key),
    print_message(informational, ev3dev(batch_worker(Number))),
    call_cleanup(
        go_on(Redis, Me, Number, Key, 0, none, []),
        ( stopped_program,
          catch(ask(Redis, del(Key), _), error(_, _), true) )).

:- dynamic
    program/5.                          % Batch, Pool, Begin, Limits, Folder
:- volatile
    program/5.

:- initialization(at_halt(ev3dev_batch_machines:stopped_program), now).

%   go_on(+Redis, +Me, +Number, +Key, +Beat, +Now, +Runs): the time Beat is
%   when the runs were last claimed. Now is the state of the program under
%   way, as of batch_step/3, or `none`; Runs are those of other programs, each
%   run(Id, Batch, Number, Seed).

go_on(Redis, Me, Number, Key, Beat0, Now0, Runs0) :-
    under_way(Now0, Ids),
    beat(Redis, Me, Key, Ids, Runs0, Beat0, Beat),
    length(Ids, Mine),
    length(Runs0, Others),
    Free is Number-Mine-Others,
    (   Free > 0
    ->  taken(Redis, Me, Free, Beat0-Beat, Taken0),
        findall(Run, ( member(Run, Taken0), Run = run(Id, _, _, _),
                       \+ memberchk(Id, Ids),
                       \+ memberchk(run(Id, _, _, _), Runs0) ), Taken),
        append(Runs0, Taken, Runs1)
    ;   Runs1 = Runs0
    ),
    turned(Redis, Number, Now0, Runs1, Now1, Runs),
    stepped(Redis, Number, Now1, Now),
    go_on(Redis, Me, Number, Key, Beat, Now, Runs).

under_way(none, []).
under_way(now(Todos, _, Busy, _), Ids) :-
    findall(Id, ( member(todo(Id-_, _, _), Todos)
                ; member(busy(_, todo(Id-_, _, _), _, _, _), Busy) ), Ids).

beat(Redis, Me, Key, Ids, Runs, Beat0, Beat) :-
    get_time(Now),
    (   Now < Beat0+1
    ->  Beat = Beat0
    ;   Beat = Now,
        alive(Seconds),
        ask(Redis, set(Key, '1', ex, Seconds), _),
        forall(( member(Id, Ids) ; member(run(Id, _, _, _), Runs) ),
               ask(Redis, xclaim('ev3dev:runs', workers, Me, 0, Id, justid),
                   _))
    ).

%   New ones; when the own ones were just claimed, also those of the dead.

taken(Redis, Me, Free, Beat0-Beat, Runs) :-
    (   ask(Redis, xreadgroup(group, workers, Me, count, Free,
                              streams, 'ev3dev:runs', >), [[_, Entries]])
    ->  true
    ;   Beat > Beat0,
        abandoned(Milliseconds),
        ask(Redis, xautoclaim('ev3dev:runs', workers, Me, Milliseconds,
                              '0-0', count, Free), [_, Entries|_])
    ->  true
    ;   Entries = []
    ),
    findall(run(Id, Batch, Number, Seed),
            member([Id, [batch, Batch, number, Number, seed, Seed]],
                   Entries),
            Runs).

%   The runs of the program under way are its own; when it has none, the next
%   one gets its turn.

turned(Redis, Number, Now0, Runs0, Now, Runs) :-
    (   Runs0 = [run(_, Next, _, _)|_],
        \+ program(batch: Next),
        ( Now0 == none ; Now0 = now([], _, [], _) )
    ->  stopped_program,
        (   begun(Redis, Number, Next)
        ->  program(batch: Next, pool: Pool),
            turned(Redis, Number, now([], Pool, [], []), Runs0, Now, Runs)
        ;   of_batch(Next, Runs0, Its, Others),
            forall(member(run(Id, _, _, _), Its), over(Redis, Id)),
            turned(Redis, Number, none, Others, Now, Runs)
        )
    ;   program(batch: Batch),
        Now0 = now(Todos0, Idle, Busy, Done)
    ->  of_batch(Batch, Runs0, Its, Runs),
        findall(todo(Id-N, Seed, 1), member(run(Id, _, N, Seed), Its), More),
        append(Todos0, More, Todos),
        Now = now(Todos, Idle, Busy, Done)
    ;   Now = Now0,
        Runs = Runs0
    ).

of_batch(Batch, Runs, Its, Others) :-
    findall(Run, ( member(Run, Runs), Run = run(_, Batch, _, _) ), Its),
    findall(Run, ( member(Run, Runs), Run \= run(_, Batch, _, _) ), Others).

over(Redis, Id) :-
    ask(Redis, xack('ev3dev:runs', workers, Id), _),
    ask(Redis, xdel('ev3dev:runs', Id), _).

%   Fails if nobody wants it any more, or it cannot begin.

begun(Redis, Number, Batch) :-
    batch_key(batch, Batch, Key),
    ask(Redis, get(Key), Text),
    term_to_atom(program(File, Program, Test, World, Options, Limits), Text),
    here(File, Program, Here, Folder),
    catch(begin(Number, Batch, begin(Here, Test, World, Options), Limits,
                Folder),
          error(Formal, Context), Error = error(Formal, Context)),
    (   var(Error)
    ->  true
    ;   stopped_program,
        tell(Redis, Batch, refused(Error)),
        fail
    ).

begin(Number, Batch, Begin, Limits, Folder) :-
    start_workers(Number, Pool),
    assertz(program(Batch, Pool, Begin, Limits, Folder)),
    workers_ready(Pool, Begin).

stopped_program :-
    forall(retract(program(pool: Pool, folder: Folder)),
           ( end_workers(Pool),
             (   Folder == none
             ->  true
             ;   end_workplace(Folder)
             ) )).

%   The same file here may have others beside it.

here(File, Program, Here, Folder) :-
    (   catch(read_file_to_string(File, Program, [encoding(utf8)]),
              error(_, _), fail)
    ->  Here = File,
        Folder = none
    ;   new_workplace(ev3dev_batch, Folder),
        file_base_name(File, Name),
        directory_file_path(Folder, Name, Here),
        setup_call_cleanup(
            open(Here, write, Stream, [encoding(utf8)]),
            write(Stream, Program),
            close(Stream))
    ).

tell(Redis, Batch, Answer) :-
    batch_key(scores, Batch, Key),
    format(string(Text), '~k', [Answer]),
    ask(Redis, rpush(Key, Text), _),
    kept(Seconds),
    ask(Redis, expire(Key, Seconds), _).

stepped(Redis, Number, Now0, Now) :-
    (   Now0 = now(Todos, Idle0, Busy, []),
        \+ ( Todos == [], Busy == [] )
    ->  program(batch: Batch, limits: Limits),
        (   Idle0 == [],
            Busy == []
        ->  retract(program(Batch, Dead, Begin, _, Folder)),
            end_workers(Dead),
            begin(Number, Batch, Begin, Limits, Folder),
            program(batch: Batch, pool: Idle)
        ;   Idle = Idle0
        ),
        batch_step(Limits, now(Todos, Idle, Busy, []),
                   now(Todos1, Idle1, Busy1, Done)),
        forall(member(done(Id-N, Seed, Score), Done),
               ( tell(Redis, Batch, done(N, Seed, Score)),
                 over(Redis, Id) )),
        Now = now(Todos1, Idle1, Busy1, [])
    ;   sleep(0.1),
        Now = Now0
    ).

% ---------------- REDIS

batch_key(Kind, Batch, Key) :-
    atomic_list_concat([ev3dev, Kind, Batch], :, Key).

:- multifile prolog:message//1.

prolog:message(ev3dev(no_batch_worker)) -->
    [ 'No worker makes these runs yet; one begins by: swipl ev3dev work \c
       --redis ADDRESS'-[] ].
prolog:message(ev3dev(batch_worker(Number))) -->
    [ 'Waiting for runs, ~d at a time; Ctrl-C ends this.'-[Number] ].
prolog:message(ev3dev(redis_lost(Address))) -->
    [ 'The Redis server ~w is not there any more; trying again.'-[Address] ].
