:- use_module('../support/trees').
:- use_module(library(ev3dev/colors)).

shows(Port, R, G, B) :-
    put_attribute(Port, mode, 'RGB-RAW'),
    put_attribute(Port, value0, R),
    put_attribute(Port, value1, G),
    put_attribute(Port, value2, B).

:- begin_tests(color_name).
test(names_each_color_that_the_sensor_tells,
     all(N-Name == [0-none, 1-black, 2-blue, 3-green, 4-yellow, 5-red, 6-white, 7-brown])) :-
    color_name(N, Name).
test(knows_the_number_of_a_name, all(N == [3])) :-
    color_name(N, green).
test(there_is_no_eighth, fail) :-
    color_name(8, _).
:- end_tests(color_name).

:- begin_tests(rgb, [cleanup(retractall(ev3dev_colors:white(_, _, _, _, _)))]).
test(percentages_are_of_the_calibrated_white,
     true(RGB == rgb(50, 100, 25))) :-
    with_tree(plain, ( shows(in2, 200, 300, 160),
                      col_white(in2),
                      shows(in2, 100, 330, 40),
                      once(col_rgb(in2, RGB)) )).
test(each_port_has_its_own_white, [forall(tree(Tree)), true(RGB == rgb(25, 50, 75))]) :-
    with_tree(Tree, ( shows(in2, 200, 300, 160),
                      col_white(in2),
                      shows(in3, 100, 200, 300),
                      once(col_rgb(in3, RGB)) )).
test(what_sees_nothing_is_not_white, [forall(tree(Tree)), fail]) :-
    with_tree(Tree, ( shows(in2, 0, 0, 0), col_white(in2) )).
test(fails_without_a_sensor, [forall(member(Goal, [col_white(in1), col_rgb(in1, _), col_hsv(in1, _)])), fail]) :-
    with_tree(simulator, Goal).
test(the_color_as_hue_saturation_and_value,
     [ forall(member(R-G-B-HSV, [ 400-0-0-hsv(0, 100, 100), 0-400-0-hsv(120, 100, 100),
                                  0-0-200-hsv(240, 100, 50), 400-400-0-hsv(60, 100, 100),
                                  400-0-200-hsv(330, 100, 100), 100-100-100-hsv(0, 0, 25),
                                  0-0-0-hsv(0, 0, 0) ])),
       true(Seen == HSV) ]) :-
    with_tree(plain, ( shows(in3, R, G, B), once(col_hsv(in3, Seen)) )).
test(the_simulated_floor_is_white_once_it_is_calibrated, true(Seen == rgb(100, 100, 100))) :-
    with_sim([], ( col_white(in2), once(col_rgb(in2, Seen)) )).
:- end_tests(rgb).
