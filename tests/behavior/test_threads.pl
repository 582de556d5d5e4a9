% Many threads at once: nothing is torn, nobody waits forever, and on the virtual
% clock each run is the same.

:- use_module('../support/cases').
:- use_module('../support/child').
:- use_module('../support/trees').

:- begin_tests(threads).
%   How long to go on, in seconds.
lasts(Seconds) :-
    cases(10, Seconds).

test(eight_threads_call_everything_at_once,
     [forall(tree(Tree)), true(Ends == Fine)]) :-
    findall(true, between(1, 8, _), Fine),
    with_tree(Tree, ( put_attribute(in2, value0, 42),
                      lasts(Seconds),
                      get_time(Now),
                      End is Now + Seconds,
                      findall(Id, ( worker(Goal_1),
                                    thread_create(work(Goal_1, End), Id, []) ), Ids),
                      maplist(thread_join, Ids, Ends),
                      stop_all_motors )).

worker(writes(111)).
worker(writes(2222222)).
worker(reads_position).
worker(reads_light('COL-AMBIENT')).
worker(reads_light('COL-REFLECT')).
worker(drives).
worker(enumerates).
worker(replugs).

work(Goal_1, End) :-
    repeat,
    call(Goal_1, sane),
    get_time(Now),
    Now >= End,
    !.

writes(Value, sane) :-
    position_sp(outA, Value),
    speed_sp(outA, 100).

reads_position(sane) :-
    position_sp(outA, Value),
    must_be(oneof([0, 111, 2222222]), Value),
    speed_sp(outA, Speed),
    must_be(oneof([0, 100]), Speed).

%   Two threads want the same sensor in two modes.
reads_light(Mode, sane) :-
    sensor_value(in2, Mode, 0, 42).

drives(sane) :-
    motors_run([run(outB, 20), run(outC, -20)]),
    motor_states(outB, States),
    (   current_tree(plain)
    ->  States == []
    ;   must_be(list(oneof([running, overloaded, stalled])), States)
    ),
    speed_sp(outB, 210),
    motor_stop(outB),
    motor_run(outC, 50, 10, [wait(false)]).

enumerates(sane) :-
    findall(Port, tacho_motor(Port), [outA, outB, outC|_]),
    forall(lego_sensor(Port), must_be(atom, Port)).

%   Comes and goes under another number each time.
replugs(sane) :-
    unplug(outD),
    \+ motor_run(outD, 10),
    plug(outD, 'lego-nxt-motor'),
    max_speed(outD, 1020),
    motor_run(outD, 10),
    get_attribute(outD, speed_sp, '102').
:- end_tests(threads).

:- begin_tests(thread_ends).
% Prolog leaves the thread without any cleanup, so its motor may run on. A motor has run
% before: the first one asks Prolog for leave, and thread_exit/1 within such a question
% breaks Prolog itself.
test(thread_exit_in_a_wait_ends_that_thread_only,
     [ condition(( current_prolog_flag(arch, 'x86_64-linux'),
                   current_prolog_flag(version, Version), Version >= 90000 )),
       forall(member(Wait, [ "motor_run(outB, 10, 100000)", "wait(1000)",
                             "button_wait(enter, pressed)" ])),
       true(Status-Output == exit(0)-"exited") ]) :-
    format(string(Program),
           ":- use_module(library(ev3dev)).
            :- use_module(library(ev3dev/sim)).
            main :- sim_start(room, [clock(realtime)]), motor_run(outC, 10), thread_self(Me),
                    thread_create(( thread_send_message(Me, ready), ~s ), Id, []),
                    thread_get_message(ready), thread_signal(Id, thread_exit(bye)),
                    thread_join(Id, Status), us_dist_cm(_, _),
                    ( Status = exited(bye) -> write(exited) ; print(Status) ).", [Wait]),
    run_program(Program, [goal(main)], Status, Output).
:- end_tests(thread_ends).

:- begin_tests(same_runs).
% Threads on the virtual clock: a process that runs the program prints all that
% happened, with the times.

program("a thread a wheel",
        "wheels(Speed, Degrees) :-
             thread_create(motor_run(outB, Speed, Degrees), Left, []),
             thread_create(motor_run(outC, Speed, Degrees), Right, []),
             thread_join(Left, true),
             thread_join(Right, true).
         run :- wheels(40, 720), wheels(60, -90).").
program("goals of concurrent/3",
        "run :-
             concurrent(2, [motor_run(outB, 40, 90), motor_run(outC, 40, 360)], []),
             concurrent(3, [motor_run(outC, 50, 90), us_dist_cm(_, _),
                            motor_run(outB, 50, -90), gyro_ang(_, _)], []).").
program("threads that share a database",
        "wish(Who, What) :- with_mutex(wishes, ( retractall(wishes(Who, _)),
                                                 assertz(wishes(Who, What)) )).
         :- dynamic wishes/2.
         wander :- repeat, wish(wander, 30-30), sim_wait(0.7),
                   wish(wander, 30-10), sim_wait(0.3), fail.
         avoid :- repeat, us_dist_cm(_, D),
                  ( D < 60 -> wish(avoid, 25-(-25)), sim_wait(0.5)
                  ; wish(avoid, none) ),
                  sim_wait(0.05), fail.
         decide :- sim_time(T), T > 5, !.
         decide :- ( member(Who, [avoid, wander]), wishes(Who, L-R)
                   -> motors_run([run(outB, L), run(outC, R)])
                   ;  true ),
                   sim_wait(0.05), decide.
         run :- thread_create(wander, W, []), thread_create(avoid, A, []), decide,
                forall(member(T, [W, A]),
                       ( thread_signal(T, throw(over)), thread_join(T, _) )).").
program("threads that send messages, and compute",
        "computes(0) :- !.
         computes(N) :- M is N - 1, computes(M).
         eye(Main) :- us_dist_cm(_, D), computes(20000),
                      thread_send_message(Main, far(D)), thread_get_message(ok),
                      sim_wait(0.1), eye(Main).
         listen(0) :- !.
         listen(N) :- thread_get_message(far(_)), speed(outB, _), computes(5000),
                      thread_send_message(eye, ok), us_dist_cm(_, _),
                      M is N - 1, listen(M).
         run :- thread_self(Me), thread_create(eye(Me), _, [alias(eye)]),
                motors_run([run(outB, 40), run(outC, 38)]), listen(10),
                thread_signal(eye, throw(over)), thread_join(eye, _).").

test(all_are_the_same, [forall(program(_, Text)), true(Different == [First])]) :-
    findall(Output, ( between(1, 4, _), printed(Text, Output) ), [First|Outputs]),
    once(sub_string(First, _, _, _, "written")),
    sort([First|Outputs], Different).

printed(Text, Output) :-
    format(string(Program),
           ":- use_module(library(ev3dev)).
            :- use_module(library(ev3dev/sim)).
            ~s
            main :- sim_start(room, [clock(virtual)]), run, sim_trace(Trace),
                    forall(member(Event, Trace), ( print(Event), nl )),
                    sim_pose(X, Y, H), print(X/Y/H), nl.", [Text]),
    run_program(Program, [goal(main)], exit(0), Output).
:- end_tests(same_runs).
