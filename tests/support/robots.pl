:- module(robots,
          [ robot_of/6,         % +Left, +Right, +Axle, +Gyro, +Noise, -Robot
            robot_of/7,         % +Left, +Right, +Axle, +Slip, +Gyro, +Noise, -Robot
            exact_encoders/2,   % +Robot0, -Robot
            built/2,            % -Robot, -Options
            biased/2,           % +Seed, -Noise
            a_slip/1,           % ?Slip
            drives/3,           % +Seed, +Robot, :Goal
            noisy/3,            % +Seed, +Gyro, :Goal
            slipping/4,         % +Seed, +Slip, +Gyro, :Goal
            quiet/2,            % +Gyro, :Goal
            each_seed/1,        % :Goal
            pose_is_right/0,
            pose_is_right/2     % +Cm, +Degrees
          ]).
:- use_module(cases).
:- use_module(old_prolog).
:- use_module(simulation).
:- use_module(library(ev3dev/drive)).
:- use_module(library(apply)).

/** <module> Simulated robots that are not quite what the program believes
*/

:- meta_predicate
    drives(+, +, 0),
    noisy(+, +, 0),
    slipping(+, +, +, 0),
    quiet(+, 0),
    each_seed(:).       % `1` would compile lambda expressions without what is bound

%!  robot_of(+Left, +Right, +Axle, +Gyro, +Noise, -Robot)
%
%   A simulated robot with wheels of these diameters. Gyro is a boolean; noise
%   is `none` or `bias(Left, Right)`, how much stronger each motor is than it
%   should be, in percent; motors and gyro then tremble, their encoders err, and
%   the gyro drifts.

robot_of(DL, DR, Axle, Gyro, Noise, Robot) :-
    robot_of(DL, DR, Axle, slip(0, 0), Gyro, Noise, Robot).

%   The same with a share of its way that each wheel loses by slipping.

robot_of(DL, DR, Axle, slip(SL, SR), Gyro, Noise, Robot) :-
    Robot = [ left_wheel(outB, DL, [slip(SL)]),
              right_wheel(outC, DR, [slip(SR)]), axle(Axle),
               hull(circle(8)), mass(0.75),
               motor(outA, 'lego-ev3-m-motor'),
               motor(outB, 'lego-ev3-l-motor'),
               motor(outC, 'lego-ev3-l-motor'),
               sensor(in1, 'lego-ev3-us', 0, 7, 0)
            | Robot1 ],
    gyro_of(Gyro, Noise, Robot1, Robot2),
    noise_of(Noise, Robot2).

gyro_of(false, _, Robot, Robot) :-
    !.
gyro_of(true, none, [sensor(in4, 'lego-ev3-gyro', 0, 0, 0)|Robot], Robot) :-
    !.
gyro_of(true, bias(_, _),
        [sensor(in4, 'lego-ev3-gyro', 0, 0, 0), noise(in4, 0.3, 0.02)|Robot],
        Robot).

noise_of(none, []).
noise_of(bias(L, R), [ noise(outB, 0.5, L), noise(outC, 0.5, R),
                       encoder_noise(outB, 0.5), encoder_noise(outC, 0.5) ]).

exact_encoders(Robot0, Robot) :-
    exclude([encoder_noise(_, _)]>>true, Robot0, Robot).

%   A motor that is 5 % stronger than the other one: on the left, on the right.
biased(Seed, Bias) :-
    (   Seed mod 2 =:= 0
    ->  Bias = bias(5, 0)
    ;   Bias = bias(0, 5)
    ).

%!  drives(+Seed, +Robot, :Goal)
%
%   Call Goal with that robot, believed to be that of the paper, at 0, 0, 0.

drives(Seed, Robot, Goal) :-
    set_random(seed(Seed)),
    with_sim([],
             ( set_robot(5.6, 10.6, outB, outC),
               Goal ),
             [seed(Seed), robot(Robot)]).

noisy(Seed, Gyro, Goal) :-
    biased(Seed, Noise),
    robot_of(5.6, 5.6, 10.6, Gyro, Noise, Robot),
    drives(Seed, Robot, Goal).

%   One whose wheels lose a share of their way, and nobody knows.
slipping(Seed, Slip, Gyro, Goal) :-
    biased(Seed, Noise),
    robot_of(5.6, 5.6, 10.6, Slip, Gyro, Noise, Robot),
    drives(Seed, Robot, Goal).

a_slip(slip(0.05, 0.05)).
a_slip(slip(0.05, 0)).
a_slip(slip(0, 0.03)).

quiet(Gyro, Goal) :-
    robot_of(5.6, 5.6, 10.6, Gyro, none, Robot),
    drives(1, Robot, Goal).

%   All that seeds answer, or complain of the first that does not.
each_seed(Goal) :-
    forall(case(20, Seed),
           (   call(Goal, Seed)
           ->  true
           ;   format(user_error, "seed ~w~n", [Seed]),
               fail
           )).

%!  true_error(-Distance, -Degrees)
%
%   How far the pose is off.

true_error(Distance, Degrees) :-
    pose(X, Y, H),
    sim_pose(X0, Y0, H0),
    Distance is sqrt((X - X0)^2 + (Y - Y0)^2),
    heading_wrapped(H - H0, D),
    Degrees is abs(D).

pose_is_right :-
    pose_is_right(0.3, 0.5).

pose_is_right(Cm, Degrees) :-
    true_error(D, H),
    near(D, 0, Cm),
    near(H, 0, Degrees).

%   A robot that is not quite that of the paper.
built(Robot, Options) :-
    robot_of(5.6, 5.5, 10.6, true, none, [_, _|Rest]),
    Robot = [ left_wheel(outB, 5.6, [inverted(true)]), right_wheel(outC, 5.5)
            | Rest ],
    Options = [right_diameter(5.5), inverted([left])].
