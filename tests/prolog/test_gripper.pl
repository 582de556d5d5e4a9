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

% A box ahead of the color sensor at in3, whose front is at Y = 7.
ahead(Distance, Options, Goal) :-
    Y is 7 + Distance + 2.5,
    with_sim([floor(red), box(0, Y, 5, 5, 0, Options)], Goal,
             [robot(carrier)]).

:- begin_tests(color_ahead).
test(it_sees_the_color_of_what_stands_near,
     [ forall(member(Color-Code, [blue-2, green-3, yellow-4, red-5])),
       Code0 == Code ]) :-
    ahead(2, [mass(0.05), color(Color)], col_color(in3, Code0)).
test(far_things_have_no_color, Code-Light == 0-0) :-
    ahead(4.1, [color(blue)], ( col_color(in3, Code), col_reflect(in3, Light) )).
test(what_has_no_color_reflects_light, [Code, true] == [0, Seen]) :-
    ahead(1.2, [], ( col_color(in3, Code), col_reflect(in3, Light) )),
    ( Light > 20 -> Seen = true ; Seen = Light ).
test(near_things_reflect_more, true(Near > Far)) :-
    ahead(1.2, [color(white)], col_reflect(in3, Near)),
    ahead(3, [color(white)], col_reflect(in3, Far)).
test(it_looks_over_what_is_low, Code == 0) :-
    ahead(2, [height(3), color(blue)], col_color(in3, Code)).
test(low_things_have_no_echo, true(Near-Far == near-far)) :-
    ahead(10, [height(6)], us_dist_cm(in1, D1)),
    ahead(10, [height(4)], us_dist_cm(in1, D2)),
    ( D1 < 12 -> Near = near ; Near = D1 ),
    ( D2 > 200 -> Far = far ; Far = D2 ).
test(the_other_sensor_sees_the_floor, Code == 5) :-
    ahead(2, [color(blue)], col_color(in2, Code)).
test(bad_mounts, [ forall(member(Type-Options-Error,
        [ 'lego-ev3-color'-[looks(up)]-domain_error(sensor_option, looks(up)),
          'lego-ev3-color'-[sees(ahead)]-domain_error(sensor_option, _),
          'lego-ev3-color'-[looks(_)]-instantiation_error,
          'lego-ev3-us'-[looks(ahead)]-domain_error(possible_geometry, _) ])),
                   error(Error, _) ]) :-
    with_sim([], true, [robot([sensor(in1, Type, 0, 0, 0, Options)])]).
:- end_tests(color_ahead).
