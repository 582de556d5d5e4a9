:- use_module(tree).
:- use_module(library(ev3dev)).

:- begin_tests(motor_run).

test(sets_speed_in_percent_then_commands) :-
    with_tree(( motor_run(outB, 50),
                get_attribute(outB, speed_sp, '525'),
                get_attribute(outB, command, 'run-forever') )).
test(takes_either_spelling_of_a_port) :-
    with_tree(( motor_run('ev3-ports:outB', 50),
                get_attribute(outB, speed_sp, '525') )).
test(takes_an_expression_for_speed) :-
    with_tree(( motor_run(outB, min(50, 100 / 4)),
                get_attribute(outB, speed_sp, '262') )).
test(runs_backwards_at_negative_speed) :-
    with_tree(( motor_run(outB, -50),
                get_attribute(outB, speed_sp, '-525') )).
test(fails_without_a_motor, [fail]) :-
    with_tree([], motor_run(outB, 50)).
test(fails_beyond_max_speed_and_writes_nothing) :-
    with_tree(( \+ motor_run(outB, 101),
                written(outB, []) )).
test(throws_for_an_unbound_port, error(instantiation_error, _)) :-
    with_tree(motor_run(_, 50)).

:- end_tests(motor_run).
