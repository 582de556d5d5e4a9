% What a call has found the next ones have at once, until it is not so any more.

:- use_module('../support/trees').
:- use_module(library(thread)).

:- begin_tests(known).
test(each_answer_is_that_of_the_file_now,
     true(Seen == [7-running, 8-'', -9-'running ramping'])) :-
    with_tree(plain, [outB-'lego-ev3-l-motor'],
              findall(Position-State,
                      ( member(Number-Word, ["7"-"running", "8"-"", "-9"-"running ramping"]),
                        put_attribute(outB, position, Number),
                        put_attribute(outB, state, Word),
                        again(position(outB, Position)),
                        again(state(outB, State)) ),
                      Seen)).
test(a_value_that_is_bound_is_compared_or_written, true(Written-Is == "5"-no)) :-
    with_tree(plain, [outB-'lego-ev3-l-motor'],
              ( put_attribute(outB, position, "4"),
                again(position(outB, 4)),
                position(outB, 5),
                get_attribute(outB, position, Written0),
                atom_string(Written0, Written),
                ( state(outB, nonsense) -> Is = yes ; Is = no ) )).
test(another_tree_is_asked_at_once, true(A-B == 1-2)) :-
    with_tree(plain, [outB-'lego-ev3-l-motor'],
              ( put_attribute(outB, position, "1"),
                again(position(outB, A)),
                with_tree(plain, [outB-'lego-ev3-l-motor'],
                          ( put_attribute(outB, position, "2"),
                            position(outB, B) )) )).
test(an_empty_port_has_no_position_nor_reading, true(Left == [])) :-
    with_tree(plain, [outB-'lego-ev3-l-motor', in1-'lego-ev3-us'],
              ( again(position(outB, _)),
                again(us_dist_cm(in1, _)),
                again(us_dist_cm(_, _)),
                unplug(outB),
                unplug(in1),
                sleep(0.11),
                findall(Goal,
                        ( member(Goal, [ position(outB, _), us_dist_cm(in1, _),
                                         us_dist_cm(_, _), motor_run(outB, 50) ]),
                          once(Goal) ),
                        Left) )).
test(two_sensors_answer_where_there_was_one, true(Ports-Both == [in1]-[in1, in2])) :-
    with_tree(plain, [in1-'lego-ev3-us'],
              ( again(us_dist_cm(_, _)),
                findall(Port, us_dist_cm(Port, _), Ports),
                plug(in2, 'lego-ev3-us'),
                sleep(0.11),
                findall(Port, us_dist_cm(Port, _), Both) )).
test(a_row_that_a_program_adds_is_asked, [ true(Ports == [in1, in2]),
                                           cleanup(retractall(user:added(_))) ]) :-
    with_tree(plain, [in1-'lego-ev3-us', in2-'lego-ev3-color'],
              ( again(us_dist_cm(_, _)),
                put_attribute(in2, modes, "US-DIST-CM"),
                put_attribute(in2, mode, "US-DIST-CM"),
                assertz(user:added('lego-ev3-color')),
                sleep(0.11),
                findall(Port, us_dist_cm(Port, _), Ports) )).
test(a_reading_compared_with_no_number_fails) :-
    with_tree(plain, [in1-'lego-ev3-us'],
              ( again(us_dist_cm(in1, Distance)),
                us_dist_cm(in1, Distance),
                \+ us_dist_cm(in1, near),
                Other is Distance + 1,
                \+ us_dist_cm(in1, Other) )).
test(a_motor_runs_at_each_speed, true(Speeds == ['525', '-105', '0'])) :-
    with_tree(plain, [outB-'lego-ev3-l-motor'],
              ( again(motor_run(outB, 50)),
                findall(Speed,
                        ( member(Percent, [50, -10, 0.0]),
                          motor_run(outB, Percent),
                          get_attribute(outB, command, 'run-forever'),
                          put_attribute(outB, command, "stop"),
                          get_attribute(outB, speed_sp, Speed) ),
                        Speeds) )).
test(a_motor_that_cannot_be_so_fast_stays, true(Command == stop)) :-
    with_tree(plain, [outB-'lego-ev3-l-motor'],
              ( again(motor_run(outB, 50)),
                put_attribute(outB, command, "stop"),
                \+ motor_run(outB, 101),
                \+ motor_run(outB, 1.0e300),
                get_attribute(outB, command, Command) )).
test(threads_have_each_their_own, true(Positions == [3, 3, 3])) :-
    with_tree(plain, [outB-'lego-ev3-l-motor'],
              ( put_attribute(outB, position, "2"),
                again(position(outB, _)),
                put_attribute(outB, position, "3"),
                findall(position(outB, _), between(1, 3, _), Goals),
                concurrent(3, Goals, []),
                findall(P, member(position(outB, P), Goals), Positions) )).
:- end_tests(known).

:- multifile ev3dev_sensors:reading/4.
:- dynamic added/1.

ev3dev_sensors:reading(us_dist_cm, [Type], 'US-DIST-CM', 0) :-
    added(Type).

% The second time it is known.
again(Goal) :-
    \+ \+ once(Goal),
    once(Goal).
