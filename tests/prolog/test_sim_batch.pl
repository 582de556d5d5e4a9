% library(ev3dev/sim_batch): a process for each run, the same scores with any number of
% workers, and limits that no program escapes.

:- use_module('../support/cases').
:- use_module('../support/child').
:- use_module('../support/redis').
:- use_module('../support/trees').
:- use_module(library(ev3dev/sim_batch)).

:- dynamic folder/1.

with_program(File, Goal) :-
    tmp_file(batch, Folder),
    make_directory(Folder),
    directory_file_path(Folder, 'robot.pl', File),
    setup_call_cleanup(
        ( asserta(folder(Folder)),
          setup_call_cleanup(open(File, write, Out), program(Out), close(Out)) ),
        call(Goal),
        ( retract(folder(Folder)),
          delete_directory_and_contents(Folder) )).

program(Out) :-
    forall(member(Line,
                  [ ":- use_module(library(ev3dev)).",
                    ":- use_module(library(ev3dev/sim)).",
                    ":- dynamic before/1.",
                    "drawn(N) :- random_between(1, 1000, N).",
                    "drawn(_, N) :- random_between(1, 1000000000, N).",
                    "driven(X-Y) :- for_seconds(5, (repeat, motors_run([run(outB, 40), run(outC, 30)]), wait(1), fail)), sim_pose(X, Y, _).",
                    ":- use_module(library(ev3dev/gripper)).",
                    "carried([X, Y]) :- set_robot(5.6, 10.6, outB, outC), set_gripper(outA, []), release, go_cm(20, 9), grip, sim_held(cargo), go_cm(20, 20), release, go_cm(30, -20), turn(30, 40), go_cm(30, 60), sim_thing(cargo, X, Y, _).",
                    "again(Ns) :- sim_time(T), assertz(before(T)), flag(n, N, N+1), nb_getval_0(V), findall(M, before(M), Ms), length(Ms, L), Ns = [N, V, L].",
                    "nb_getval_0(V) :- ( nb_current(here, V) -> true ; V = none ), nb_setval(here, seen).",
                    "fails(_) :- fail.",
                    "two(1). two(2).",
                    "open(_).",
                    "throws(_) :- atom_length(_, _).",
                    "prints(ok) :- writeln('score(wrong)'), format(user_error, 'Oh~n', []), read(user_input, end_of_file).",
                    "ends(_) :- halt.",
                    "dies(_) :- current_prolog_flag(pid, Pid), Pid \\== 0, process_kill(Pid, kill), sleep(9).",
                    "dies_once(File, ok) :- ( exists_file(File) -> true ; open(File, write, S), close(S), dies(_) ).",
                    "waits(_) :- repeat, catch(sleep(1), _, true), fail.",
                    "computes(_) :- repeat, catch(fail, _, true), fail.",
                    "long(A) :- length(L, 50000), maplist(=(x), L), atomic_list_concat(L, A).",
                    "odd(t('a b\nc', \"\\u20ac\", [f(0.1)])).",
                    ":- use_module(library(process))." ]),
           ( write(Out, Line), nl(Out) )).

scores(File, Test, Seeds, Scores) :-
    scores(File, Test, Seeds, [], Scores).

scores(File, Test, Seeds, Options, Scores) :-
    sim_batch(File, Test, Seeds, Scores, Options).

%   Copies that were killed may take a moment.

no_worker_is_left :-
    eventually(\+ descendant('batch/worker.pl')).

call_soon(Goal) :-
    thread_self(Me),
    setup_call_cleanup(
        thread_create(( sleep(1), thread_signal(Me, throw(over)) ), Id, []),
        Goal,
        thread_join(Id, _)).

:- begin_tests(sim_batch, [condition(starts_itself)]).
test(a_score_for_each_seed_in_their_order, Seeds == [5, 3, 5, 4]) :-
    with_program(File, scores(File, drawn, [5, 3, 5, 4], Scores)),
    Scores = [_-A, _-B, _-A, _-C],
    sort([A, B, C], [_, _, _]),
    findall(Seed, member(Seed-_, Scores), Seeds).
test(random_numbers_follow_the_seed_without_a_simulation, true(A =\= B)) :-
    with_program(File, ( scores(File, drawn, [5, 6, 5], [world(none)], Scores),
                         scores(File, drawn, [6], [world(none)], [6-B]) )),
    Scores = [5-A, 6-B, 5-A].
test(the_same_with_any_number_of_workers) :-
    numlist(1, 6, Seeds),
    with_program(File, ( scores(File, driven, Seeds, [workers(1), noise(true)], One),
                           scores(File, driven, Seeds, [workers(4), noise(true)], Four) )),
    One == Four,
    findall(Place, member(_-Place, One), Places),
    sort(Places, [_, _|_]).
test(things_live_in_each_run, true(One-Kinds == Four-6)) :-
    numlist(1, 6, Seeds),
    Options = [ robot(carrier), noise(true),
                world([box(0, 20, 6, 6, 0, [mass(0.05), name(cargo)]),
                       circle(12, 60, 3, [mass(0.05), rolls(true)])]) ],
    with_program(File, ( scores(File, carried, Seeds, [workers(1)|Options], One),
                         scores(File, carried, Seeds, [workers(4)|Options], Four) )),
    findall(Y, ( member(_-[_, Y], One), Y > 25 ), Places),
    sort(Places, Different),
    length(Different, Kinds).
test(the_same_as_in_a_simulation_here, Score == Here) :-
    with_program(File, ( scores(File, driven, [7], [world(lights), noise(true)], [7-Score]),
                           load_files(batch_here:File, []) )),
    with_sim(lights, batch_here:driven(Here), [seed(7), noise(true)]).
test(no_run_knows_of_another_one, Scores == [1-[0, none, 1], 2-[0, none, 1], 3-[0, none, 1]]) :-
    with_program(File, scores(File, again, [1, 2, 3], [workers(1)], Scores)).
test(a_simulation_of_the_caller_goes_on, X-Y == 40.0-30.0) :-
    with_sim(room, ( sim_place(40, 30, 0),
                     with_program(File, scores(File, fails, [1], _)),
                     sim_pose(X, Y, _) )).
test(what_is_no_score,
     [ forall(member(Test-Score, [ fails-failed, two-1, ends-error(died), dies-error(died),
                                   prints-ok,
                                   odd-t('a b\nc', "\u20ac", [f(0.1)]) ])),
       true(Found == Score) ]) :-
    with_program(File, scores(File, Test, [1], [1-Found])).
test(a_score_may_be_a_variable) :-
    with_program(File, scores(File, open, [1], [1-Score])),
    var(Score).
test(a_score_may_be_long, Length == 50000) :-
    with_program(File, scores(File, long, [1, 2], [_-Score, _-Score])),
    atom_length(Score, Length).
test(an_error_is_what_prolog_would_print) :-
    with_program(File, scores(File, throws, [1], [1-error(Message)])),
    once(sub_atom(Message, _, _, _, 'not sufficiently instantiated')).
test(a_run_that_dies_once_is_made_again, Score == ok) :-
    with_program(File, ( folder(Folder), directory_file_path(Folder, died, Died),
                           scores(File, dies_once(Died), [1], [1-Score]) )).
test(limits_that_no_program_escapes,
     [ forall(member(Test-Option-Score, [ waits-sleep(0.3)-limit(sleep),
                                          computes-cpu(0.3)-limit(cpu) ])),
       true(Scores-Left == [1-Score, 2-Score]-true) ]) :-
    with_program(File, scores(File, Test, [1, 2], [Option], Scores)),
    ( no_worker_is_left -> Left = true ; Left = false ).
test(no_seeds_no_scores, Scores == []) :-
    with_program(File, scores(File, drawn, [], Scores)).
test(an_error_leaves_nothing_behind, throws(over)) :-
    with_program(File, catch(call_soon(scores(File, waits, [1, 2], _)), over,
                               ( no_worker_is_left, throw(over) ))).
test(what_is_wrong_with_the_call,
     [ forall(member(Goal-Formal,
                     [ sim_batch(File, drawn, [a], _)-type_error(integer, a),
                       sim_batch(File, drawn, 1, _)-type_error(list, 1),
                       sim_batch(File, _, [1], _)-instantiation_error,
                       sim_batch(File, nothing, [1], _)-existence_error(procedure, nothing/1),
                       sim_batch(nofile, drawn, [1], _)-existence_error(source_sink, nofile),
                       sim_batch(File, drawn, [1], _, [seed(1)])
                       -domain_error(sim_batch_option, seed(1)),
                       sim_batch(File, drawn, [1], _, [world(mars)])
                       -existence_error(world, mars),
                       sim_batch(File, drawn, [1], _, [colour(red)])
                       -domain_error(sim_batch_option, colour(red)),
                       sim_batch(File, drawn, [1], _, [workers(0)])
                       -type_error(positive_integer, 0),
                       sim_batch(File, drawn, [1], _, [sleep(-1)])-domain_error(seconds, -1),
                       sim_batch(File, drawn, [1], _, [cpu(-1)])-domain_error(seconds, -1) ])),
       error(Formal) ]) :-
    with_program(File, Goal).
:- end_tests(sim_batch).

% Workers of other machines are processes of this one.
with_workers(Port, Count, Workers, Goal) :-
    length(Workers, Count),
    setup_call_cleanup(
        maplist(start_worker(Port), Workers),
        once(Goal),
        maplist(end_worker, Workers)).

start_worker(Port, Worker) :-
    swipl(Swipl),
    atom_concat('localhost:', Port, Address),
    process_create(path(env),
                   [Swipl, '-q', 'app/ev3dev.pl', work, '--redis', Address, '--workers', 1],
                   [stdin(null), stdout(null), stderr(null), process(Worker)]).

end_worker(Worker) :-
    catch(( process_kill(Worker, int), process_wait(Worker, _) ), error(_, _), true).

killed_while_it_works(Port, Worker) :-
    with_client(Port, Redis, eventually(has_run(Redis, Worker))),
    process_kill(Worker, kill).

has_run(Redis, Worker) :-
    catch(redis(Redis, xpending('ev3dev:runs', workers), [_, _, _, Consumers]),
          error(redis_error(_, _), _), fail),
    atom_concat(-, Worker, End),
    once(( member([Name, _], Consumers), sub_atom(Name, _, _, 0, End) )).

%   A worker drops them, or makes them to the end.
no_run_is_left(Port) :-
    with_client(Port, Redis,
        eventually(( redis(Redis, xlen('ev3dev:runs'), 0),
                     \+ redis(Redis, keys('ev3dev:batch:*'), [_|_]) ))).

% The test is the worker: it reads the batch of the only key, and says a score.
scored(Redis, Runs, Number) :-
    eventually(( redis(Redis, keys('ev3dev:batch:*'), [Key]),
                 redis(Redis, xlen('ev3dev:runs'), Runs) )),
    atomic_list_concat([_, _, Batch], :, Key),
    atomic_list_concat([ev3dev, scores, Batch], :, Scores),
    format(string(Done), 'done(~d,~d,ok)', [Number, Number]),
    redis(Redis, rpush(Scores, Done), _),
    eventually(redis(Redis, llen(Scores), 0)).

as_here(File, Port, Test, Same) :-
    scores(File, Test, [1, 2, 3], Here),
    scores(File, Test, [1, 2, 3], [redis(localhost:Port)], There),
    ( Here == There -> Same = same ; Same = There ).

:- ( exists_source(library(redis)) -> use_module(library(redis), [redis/3]) ; true ).

:- begin_tests(sim_batch_redis, [condition(( can_use_redis, starts_itself ))]).
test(the_same_scores_though_a_worker_is_killed, There == Here) :-
    cases(200, Count),
    numlist(1, Count, Seeds),
    with_program(File,
        ( scores(File, driven, Seeds, [noise(true)], Here),
          with_redis_server(Port,
            with_workers(Port, 2, [First|_],
              ( thread_create(killed_while_it_works(Port, First), Killer, []),
                scores(File, driven, Seeds, [noise(true), redis(localhost:Port)], There),
                thread_join(Killer, Status),
                assertion(Status == true),
                no_run_is_left(Port) ))) )).
test(two_programs_take_turns, Both == [same, same]) :-
    with_program(File,
        with_redis_server(Port,
          with_workers(Port, 2, _,
            concurrent_maplist(as_here(File, Port), [drawn, driven], Both) ))).
test(a_program_that_cannot_begin, error(existence_error(procedure, nothing/1))) :-
    with_program(File,
        with_redis_server(Port,
          with_workers(Port, 1, _, scores(File, nothing, [1, 2], [redis(localhost:Port)], _)))).
test(other_machines_get_the_text, Scores == [1-ok, 2-ok]) :-
    thread_self(Me),
    with_redis_server(Port,
        ( with_program(File,
              ( thread_create(( scores(File, prints, [1, 2], [redis(localhost:Port)], Found),
                                thread_send_message(Me, scores(Found)) ), Thread, []),
                with_client(Port, Redis,
                    eventually(redis(Redis, keys('ev3dev:batch:*'), [_]))) )),
          with_workers(Port, 1, _,
              ( thread_join(Thread, _), thread_get_message(Me, scores(Scores), [timeout(0)]) )) )).
test(a_server_that_is_none, error(existence_error(redis_server, localhost:1))) :-
    with_program(File, scores(File, drawn, [1], [redis('localhost:1')], _)).
test(a_worker_without_a_server, Status == exit(1)) :-
    start_worker(1, Worker),
    process_wait(Worker, Status).
test(a_worker_waits_for_a_server_that_went_away, Score == ok) :-
    with_program(File,
        with_redis_server(Port,
          with_workers(Port, 1, _,
            ( scores(File, prints, [1], [redis(localhost:Port)], [1-ok]),
              with_server_again(Port, scores(File, prints, [1], [redis(localhost:Port)],
                                             [1-Score])) )))).
test(a_batch_goes_on_when_the_server_came_back,
     [ setup(asserta((user:message_hook(ev3dev(redis_lost(_)), _, _)), Told)),
       cleanup(erase(Told)), true(Scores == [1-ok, 2-ok]) ]) :-
    with_program(File,
        with_redis_server(Port,
            ( thread_create(( scores(File, prints, [1, 2], [redis(localhost:Port)], Found),
                              thread_exit(Found) ), Thread, []),
              with_client(Port, Redis, scored(Redis, 2, 1)),
              with_server_again(Port,
                  ( with_client(Port, Again, scored(Again, 1, 2)),
                    thread_join(Thread, exited(Scores)) )) ))).
test(what_is_left_before_its_end_is_dropped) :-
    with_program(File,
        with_redis_server(Port,
          with_workers(Port, 1, _,
            ( catch(call_soon(scores(File, waits, [1, 2], [redis(localhost:Port), sleep(2)], _)),
                    over, true),
              no_run_is_left(Port) )))).
:- end_tests(sim_batch_redis).
