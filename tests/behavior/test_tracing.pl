% The tracer shows what a program calls, and not what the pack does for it.

:- use_module('../support/trees').
:- use_module('../support/child').
:- use_module(library(ev3dev/drive)).
:- use_module(library(ev3dev/grid)).
:- use_module(library(ev3dev/planners)).
:- use_module(library(ev3dev/roadmap)).

:- begin_tests(tracing).
test(shows_no_port_of_an_inner_predicate,
     [ forall(member(Goal-Called,
                     [ "motor_run(outB, 50, 360, [])"-"motor_run",
                       "us_dist_cm(in1, _)"-"us_dist_cm",
                       "go_cm(10, 10)"-"go_cm",
                       "led(nowhere, red)"-"led",
                       "arc_cm(10, 10, 90)"-"arc_cm",
                       "set_robot(5.6, 10.6, outB, outC)"-"set_robot",
                       "until(us_dist_cm(in1) < 300, go(10))"-"until us_dist_cm",
                       "until(near, go(10))"-"near until",
                       "every(0.5, beep), wait(1)"-"beep every wait",
                       "with_sim(room, go_cm(10, 10))"-"with_sim" ])),
       true(Status-Seen == exit(0)-Called) ]) :-
    format(string(Program),
           ":- use_module(library(ev3dev)).
            :- use_module(library(ev3dev/drive)).
            :- use_module(library(ev3dev/events)).
            :- use_module(library(ev3dev/sim)).
            :- dynamic seen/1.
            near.
            beep.
            user:prolog_trace_interception(Port, Frame, _, continue) :-
                prolog_frame_attribute(Frame, predicate_indicator, PI),
                ( PI = _:N/_ -> true ; PI = N/_ ),
                (   Port == call,
                    \\+ memberchk(N, [true, notrace, (','), exception])
                ->  assertz(seen(N))
                ;   true
                ).
            main :- ev3_sysfs('/'),
                ( catch(( trace, ~s ), _, true) -> true ; true ), notrace, nodebug,
                setof(N, seen(N), Ns), atomic_list_concat(Ns, ' ', Text),
                write(Text).", [Goal]),
    run_program(Program, [goal(main)], Status, Seen).
test(is_kept_out_of_each_module, Shown == []) :-
    findall(Module:Name/Arity, shown(Module, Name, Arity), Shown).
:- end_tests(tracing).

% A predicate that the tracer would go into
shown(Module, Name, Arity) :-
    current_module(Module),
    sub_atom(Module, 0, _, _, ev3dev),
    current_predicate(Module:Name/Arity),
    functor(Head, Name, Arity),
    \+ predicate_property(Module:Head, imported_from(_)),
    \+ predicate_property(Module:Head, dynamic),
    \+ predicate_property(Module:Head, nodebug).
