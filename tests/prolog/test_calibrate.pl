% The wheels and the axle as they are.

:- use_module('../support/robots').
:- use_module('../support/simulation').
:- use_module('../support/old_prolog').
:- use_module(library(ev3dev/drive)).

%   One wheel is 5 % larger than the other, and the axle 3 % off.
uncalibrated(Seed, Gyro, Robot) :-
    biased(Seed, Noise),
    (   Noise = bias(5, 0)
    ->  robot_of(5.74, 5.46, 10.9, Gyro, Noise, Robot)
    ;   robot_of(5.46, 5.74, 10.3, Gyro, Noise, Robot)
    ).

%   Squares of a meter both ways: how far from its start the robot ends.
umbmark(Error) :-
    square(1, E1),
    square(-1, E2),
    Error is max(E1, E2).

square(Direction, Error) :-
    sim_place(0, 0, 0),
    forall(between(1, 4, _),
           ( go_cm(30, 100, [use_gyro(false)]),
             turn(20, Direction * 90, [use_gyro(false)]) )),
    sim_pose(X, Y, _),
    Error is sqrt(X^2 + Y^2).

gets_better(Calibration) :-
    umbmark(Before),
    sim_place(0, 0, 0),
    call(Calibration),
    umbmark(After),
    near(After, 0, Before / 5).

by_gyro :-
    calibrate(wheels, [], Wheels),
    call(Wheels),
    calibrate(axle, [], Axle),
    call(Axle).

by_measuring :-
    sim_pose(X0, Y0, H0),
    calibrate(wheels, [measured(measured_way(X0, Y0, H0))], Wheels),
    call(Wheels),
    sim_pose(_, _, H1),
    calibrate(axle, [measured(measured_turn(H1))], Axle),
    call(Axle).

%   A student with a tape measure that shows millimeters and a protractor that
%   shows degrees.
measured_way(X0, Y0, H0, Ahead, Right) :-
    sim_pose(X, Y, _),
    H is H0 * pi / 180,
    Ahead is round(10 * ((X - X0) * sin(H) + (Y - Y0) * cos(H))) / 10.0,
    Right is round(10 * ((X - X0) * cos(H) - (Y - Y0) * sin(H))) / 10.0.

measured_turn(H0, Degrees) :-
    sim_pose(_, _, H),
    Degrees is (round(H - H0) mod 360).

:- begin_tests(calibration).
test(by_the_gyro_squares_get_five_times_better) :-
    each_seed([S]>>( uncalibrated(S, true, Robot),
                     drives(S, Robot, gets_better(by_gyro)) )).
test(by_what_was_measured_squares_get_five_times_better) :-
    each_seed([S]>>( uncalibrated(S, false, Robot),
                     drives(S, Robot, gets_better(by_measuring)) )).
test(knows_a_robot_that_is_right) :-
    robot_of(5.6, 5.6, 10.6, true, none, Robot),
    drives(1, Robot, ( calibrate(wheels, [], Wheels),
                       calibrate(axle, [], Axle) )),
    figures(Wheels, DL, DR, _),
    near(DL, 5.6, 0.01),
    near(DR, 5.6, 0.01),
    figures(Axle, _, _, A),
    near(A, 10.6, 0.02).
test(finds_out_the_true_length) :-
    robot_of(5.4, 5.4, 10.6, true, none, Robot),
    drives(1, Robot, ( Length is 100 * 5.4 / 5.6,
                       calibrate(wheels, [length(Length)], Wheels) )),
    figures(Wheels, DL, DR, _),
    near(DL, 5.4, 0.01),
    near(DR, 5.4, 0.01).
test(tells_all_there_is_to_write_down, true(Right-Left == 5.6-[left])) :-
    built(Robot, Options),
    drives(1, Robot, ( set_robot(5.6, 10.6, outB, outC, Options),
                       calibrate(axle, [], set_robot(_, _, outB, outC, All)) )),
    memberchk(left_diameter(Right), All),
    memberchk(inverted(Left), All).
test(tells_the_gear, true(G == 3.0)) :-
    D is 5.6 / 3,
    robot_of(D, D, 10.6, true, none, Robot),
    drives(1, Robot, ( set_robot(5.6, 10.6, outB, outC, [gear(3)]),
                       calibrate(axle, [], set_robot(5.6, Axle, outB, outC, [gear(G)])) )),
    near(Axle, 10.6, 0.02).
test(measures_the_wheels_and_not_what_the_gyro_has_taught) :-
    robot_of(5.74, 5.46, 10.9, true, none, Robot),
    drives(1, Robot, ( forall(between(1, 5, _),
                              ( go_cm(30, 50, []), turn(30, 90, []) )),
                       calibrate(wheels, [], Wheels),
                       call(Wheels),
                       forall(between(1, 5, _), turn(30, 90, [])),
                       calibrate(axle, [], Axle) )),
    figures(Wheels, DL, DR, _),
    near(DL, 5.74, 0.01),
    near(DR, 5.46, 0.01),
    figures(Axle, _, _, A),
    near(A, 10.9, 0.03).
test(fails_without_gyro_and_measure, [fail]) :-
    quiet(false, calibrate(axle, [], _)).
:- end_tests(calibration).

figures(set_robot(D, A, _, _), D, D, A).
figures(set_robot(_, A, _, _, Options), DL, DR, A) :-
    memberchk(left_diameter(DL), Options),
    memberchk(right_diameter(DR), Options).
