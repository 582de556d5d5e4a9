:- use_module('../support/trees').
:- use_module('../support/child').
:- use_module('../support/far_bricks').
:- use_module(library(ev3dev/bricks)).
:- use_module(library(ev3dev/sim)).

% A program computes, and its motors run on: the flag ev3dev_watchdog; and, on the virtual clock,
% the option thinking(T) of sim_start/2.

% What a program prints that computes for Seconds of a processor after Start, with the flag, and
% then says how outB is. On a brick in another process, or simulated here.
said_after(Where, Flag, Start, Compute, Lines) :-
    begun(Where, Begin),
    !,
    format(string(Text), "
:- use_module(library(ev3dev/sim)).
:- use_module(library(ev3dev/drive)).
:- use_module(library(ev3dev/journal)).
compute(S) :- statistics(cputime, T0), repeat, statistics(cputime, T), T-T0 > S, !.
main :- ~s, set_prolog_flag(ev3dev_watchdog, ~w), ~s, ~s, state(outB, S),
        format('outB: ~~w~~n', [S]), why(outB).", [Begin, Flag, Start, Compute]),
    call_in(Where, Text, Output),
    split_string(Output, "\n", "\n", Lines).

begun(mount, "true").
begun(Clock, Text) :-
    member(Clock, [realtime, virtual]),
    format(string(Text), "sim_start(room, [clock(~w)]), set_robot(5.6, 10.6, outB, outC)",
           [Clock]).

call_in(mount, Text, Output) :-
    !,
    with_tree(mount, [outB-'lego-ev3-l-motor', outC-'lego-ev3-l-motor'],
              ( program_in_tree(Text, Program, Options),
                run_program(Program, [goal(main)|Options], _, Output) )).
call_in(_, Text, Output) :-
    run_program(":- use_module(library(ev3dev)).\n", Text, Output).

run_program(Head, Text, Output) :-
    string_concat(Head, Text, Program),
    run_program(Program, [goal(main)], _, Output).

real(Where) :-
    member(Where, [realtime, mount]),
    ( Where == mount -> tree(mount) ; true ).

warned(Lines) :-
    member(Line, Lines),
    sub_string(Line, _, _, _, "stopped. The program computed for 0.3 s").

was_stopped([_, _, State|Why]) :-
    State \== "outB: running",
    member(Line, Why),
    sub_string(Line, _, _, 0, ": the program computed for too long").

:- begin_tests(watchdog).
test(motors_stop_when_the_program_computes,
     [ forall(( real(Where),
                member(Start, ["motor_run(outB, 30)", "motor_run(outB, 30, 36000, [wait(false)])"]) )),
       true(once(( warned(Lines), was_stopped(Lines) ))) ]) :-
    said_after(Where, 0.3, Start, "compute(1)", Lines),
    Lines = [Warning|_],
    assertion(sub_string(Warning, _, _, _, "in compute/1 (")),
    assertion(sub_string(Warning, _, _, _, "outB was stopped.")).
test(so_do_those_of_a_robot, true(once(( warned(Lines), was_stopped(Lines) )))) :-
    said_after(realtime, 0.3, "go(30)", "compute(1)", Lines),
    Lines = [Warning|_],
    assertion(sub_string(Warning, _, _, _, "outB and outC were stopped.")).
test(within_one_long_call_that_prolog_cannot_leave, true(once(( warned(Lines), was_stopped(Lines) )))) :-
    said_after(realtime, 0.3, "motor_run(outB, 30)",
               "numlist(1, 3000000, L), forall(between(1, 3, _), sort(0, @>=, L, _))", Lines).
test(not_if_it_uses_the_robot_or_waits_meanwhile,
     [ forall(( real(Where),
                member(Look, ["motor_position(outB, _)", "state(outB, _)", "wait(0.001)",
                              "motor_run(outB, 30)", "sleep(0.001)"]) )),
       true(First == "outB: running") ]) :-
    format(string(Compute), "forall(between(1, 12, _), ( compute(0.1), ~s ))", [Look]),
    said_after(Where, 0.3, "motor_run(outB, 30)", Compute, [First|_]).
test(not_on_the_virtual_clock_nor_without_the_flag,
     [ forall(member(Clock-Flag, [virtual-0.3, realtime-0])),
       true(First == "outB: running") ]) :-
    said_after(Clock, Flag, "motor_run(outB, 30)", "compute(1)", [First|_]).
test(another_thread_may_compute, true(First == "outB: running")) :-
    said_after(realtime, 0.3, "motor_run(outB, 30)",
               "thread_create(compute(1), T, []), thread_join(T, _)", [First|_]).
test(the_motors_of_a_thread_are_its_own, true(once(( warned(Lines), was_stopped(Lines) )))) :-
    said_after(realtime, 0.3, "motor_run(outC, 30)",
               "thread_create(( motor_run(outB, 30), compute(1) ), T, []), thread_join(T, _),
                ( state(outC, running) -> true ; writeln(outC_rests) )", Lines).
test(the_flag_is_a_number_of_seconds, error(type_error(float, x), _)) :-
    set_prolog_flag(ev3dev_watchdog, x).
test(that_is_not_below_0,
     [ setup(current_prolog_flag(ev3dev_watchdog, Before)),
       cleanup(set_prolog_flag(ev3dev_watchdog, Before)),
       error(domain_error(seconds, -1.0), _) ]) :-
    set_prolog_flag(ev3dev_watchdog, -1),
    with_tree(simulator, [outB-'lego-ev3-l-motor'], motor_run(outB, 20)).
test(motors_of_a_far_brick_stop_too, condition(starts_itself)) :-
    run_far("0.3", Output),
    assertion(sub_string(Output, _, _, _, "outB was stopped.")),
    assertion(sub_string(Output, _, _, _, "in compute/1 (")),
    assertion(sub_string(Output, _, _, _, "rests\n")).
:- end_tests(watchdog).

run_far(Flag, Output) :-
    far_place(Where),
    format(string(Text), "
:- use_module(library(ev3dev)).
:- use_module(library(ev3dev/bricks)).
compute(S) :- statistics(cputime, T0), repeat, statistics(cputime, T), T-T0 > S, !.
main :- set_prolog_flag(ev3dev_watchdog, ~w), brick_open(anna, ~q),
        far(anna, ( use_module(library(ev3dev/sim)), sim_start(room), motor_run(outB, 30) )),
        compute(1),
        far(anna, state(outB, S)), ( S == running -> writeln(S) ; writeln(rests) ).",
           [Flag, Where]),
    run_program(Text, [goal(main)], _, Output).

% Thinking takes time: the option thinking(T) of sim_start/2.

% Where the robot is after it has counted while it drives. In a process of its
% own each time: the first call of a library's predicate loads it.
driven(Options, Goals, Output) :-
    format(string(Text), "
:- use_module(library(ev3dev)).
:- use_module(library(ev3dev/sim)).
:- use_module(library(ev3dev/drive)).
:- use_module(library(ev3dev/events)).
:- use_module(library(ev3dev/journal)).
count(0) :- !.
count(N) :- M is N-1, count(M).
main :- set_prolog_flag(ev3dev_watchdog, 0),
        sim_start([bounds(0, 0, 1000, 300), start(20, 150, 90)], [clock(virtual), ~q]),
        set_robot(5.6, 10.6, outB, outC),
        ~s, sim_pose(X, Y, H), sim_time(Time), print([X, Y, H, Time]), nl.", [Options, Goals]),
    run_program(Text, [goal(main)], _, Output).

place(Options, Goals, Place) :-
    driven(Options, Goals, Output),
    place_in(Output, Place).

place_in(Output, Place) :-
    split_string(Output, "\n", "", Lines),
    member(Line, Lines),
    string_concat("[", _, Line),
    !,
    term_string(Place, Line).

limits_cost_nothing :-
    current_prolog_flag(version, Version),
    Version >= 80000.

:- begin_tests(thinking).
test(what_a_program_infers_passes_as_time, true(( abs(T-2.0) < 0.1, abs(X-50) < 3 ))) :-
    place(thinking(100000), "go(30), count(200000)", [X, _, _, T]).
test(without_it_nothing_passes, true(T < 0.1)) :-
    place(thinking(free), "go(30), count(200000)", [_, _, _, T]).
test(it_is_the_same_each_time,
     [ forall(( member(Goals, [ "go(30), count(123456)",
                              "go(30), for_seconds(20, ( count(3000000), us_dist_cm(in1, _), count(3000000) ))",
                              "both(( go(30), count(20000), wait(0.5) ),
                                    ( wait(0.1), us_dist_cm(in1, _), count(30000),
                                      motor_position(outB, _) ))",
                              "go(30), thread_create(( us_dist_cm(in1, _), count(50000),
                                                       us_dist_cm(in1, _) ), T, []),
                               wait(0.3), count(20000), thread_join(T, _)" ]),
                % both/2 needs engines
                ( sub_string(Goals, 0, _, _, "both") -> current_predicate(engine_create/3) ; true ),
                ( sub_string(Goals, _, _, _, "for_seconds") -> limits_cost_nothing ; true ) )),
       true(One-All = One-[_]) ]) :-
    findall(Place, ( between(1, 3, _), place(thinking(brick), Goals, Place) ), Places),
    sort(Places, All).
% In 7.2.3 one that has looked has an inference less.
test(it_is_the_same_however_often_a_limit_looks,
     [condition(limits_cost_nothing), true(One-All == One-[One])]) :-
    findall(Place,
            ( member(Every, [1000, 0.05, 0.01, 0.002]),
              format(string(Goals),
                     "retractall(ev3dev_time_limits:look_every(_)),
                      assertz(ev3dev_time_limits:look_every(~w)),
                      go(30), for_seconds(200, ( us_dist_cm(in1, _), count(3000000) ))", [Every]),
              place(thinking(brick), Goals, Place) ),
            Places),
    sort(Places, All),
    All = [One|_].
test(the_watchdog_follows_it, true(abs(X-36) < 1)) :-
    driven(thinking(100000),
           "set_prolog_flag(ev3dev_watchdog, 1), go(30), count(200000), why(outB)", Output),
    assertion(sub_string(Output, _, _, _, "outB and outC were stopped. The program computed for 1 s in main/0 (")),
    assertion(sub_string(Output, _, _, _, "outB was stopped (brake) at 1.0")),
    assertion(sub_string(Output, _, _, _, ": the program computed for too long")),
    place_in(Output, [X|_]).
test(it_needs_the_virtual_clock, error(permission_error(think, clock, realtime), _)) :-
    sim_start(room, [thinking(brick)]).
test(bad_rates,
     [forall(member(T, [0, -1, 0.5, fast, x(1)])), error(domain_error(thinking, T), _)]) :-
    sim_start(room, [clock(virtual), thinking(T)]).
test(an_unbound_rate, error(instantiation_error, _)) :-
    sim_start(room, [clock(virtual), thinking(_)]).
:- end_tests(thinking).
