% Many threads at once: nothing is torn, nobody waits for ever.

:- use_module('../support/trees').
:- use_module(library(ev3dev)).

:- begin_tests(threads).

%   How long to go on, in seconds.
lasts(10).

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
