:- use_module('../support/trees').
:- use_module(library(ev3dev/gripper)).

% The robot `carrier` stands at 0, 0; a cube of 5 cm lies between its jaws.
carrying(Goal) :-
    with_sim([box(0, 11, 5, 5, 0, [mass(0.05), name(cube)])],
             ( set_robot(5.6, 10.6, outB, outC),
               set_gripper(outA, []),
               Goal ),
             [robot(carrier)]).

:- begin_tests(gripper).
test(a_cube_is_carried, X-Y =@= Y0-X0) :-
    carrying(( \+ sim_held(_), grip, gripping, sim_held(cube),
               go_cm(-30, 20), turn(30, 90), release,
               \+ gripping, \+ sim_held(_),
               sim_thing(cube, X1, Y1, _) )),
    X is round(X1), Y is round(Y1),
    X0 = -20, Y0 = 11.
test(jaws_that_close_on_nothing_fail, fail) :-
    with_sim([], ( set_gripper(outA, []), grip ), [robot(carrier)]).
test(what_lies_beside_is_not_gripped, true) :-
    with_sim([box(20, 11, 5, 5, 0, [mass(0.05)])],
             ( set_gripper(outA, []), \+ grip, \+ gripping ),
             [robot(carrier)]).
test(a_gripper_may_close_the_other_way, X == 0.0) :-
    with_sim([box(0, 11, 5, 5, 0, [mass(0.05), name(cube)])],
             ( motor_polarity(outA, inversed),
               set_gripper(outA, [closes(negative)]),
               grip, gripping, sim_thing(cube, X, _, _) ),
             [robot(carrier)]).
test(no_gripper, [forall(member(Goal, [grip, release, gripping])),
                  error(existence_error(gripper, _), _)]) :-
    with_sim([], Goal, [robot(carrier)]).
test(no_motor, fail) :-
    with_sim([], ( set_gripper(outD, []), grip ), [robot(carrier)]).
test(bad_options, [forall(member(Options-Error,
                                 [ [closes(up)]-domain_error(jaw_direction, up),
                                   [closes(_)]-instantiation_error,
                                   [turn(0)]-domain_error(jaw_angle, 0),
                                   [force(101)]-domain_error(duty_limit, 101),
                                   [speed(3)]-domain_error(jaws_option, speed(3)) ])),
                   error(Error, _)]) :-
    with_sim([], set_gripper(outA, Options), [robot(carrier)]).
test(a_robot_file_is_checked, error(domain_error(gripper_option, width(3)), _)) :-
    with_sim([], true, [robot([ motor(outA, 'lego-ev3-m-motor', [stops(0, 90)]),
                                gripper(outA, 0, 11, [width(3)]) ])]).
:- end_tests(gripper).
