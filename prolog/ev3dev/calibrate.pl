:- module(ev3dev_calibrate,
          [ calibrate/3                 % +What, :Options, -SetRobot
          ]).
:- set_prolog_flag(generate_debug_info, false).
:- use_module(private/checks/checks, [must_be/2]).
:- use_module(private/errors/errors, [domain_error/2]).
:- use_module(private/errors/public_clauses, [term_expansion/4]).
:- use_module(library(lists), [append/3, member/2, sum_list/2]).
:- use_module(private/checks/arguments,
              [ must_be_options/3, number_option/4, number_value/2,
                option/2, option/3, word/2
              ]).
:- use_module(motor_settings, [motor_gear/2]).
:- use_module(sensors, [gyro_ang/2]).
:- use_module(private/devices/drive_moves,
              [move_straight/3, move_turn/3, speed_option/4]).
:- use_module(private/devices/sensor_type, [sensor_to_read/3]).
:- use_module(private/devices/robot_state, [robot_description/1]).
:- use_module(time, [wait/1]).

/** <module> Calibration: the true size of wheels and axle

A ruler measures wheels and axle inexactly: wheels give way under the weight
of the robot, no two are the same, and the point where a tire touches the
floor is uncertain. calibrate/3 computes the sizes from moves of the robot.
*/

:- meta_predicate calibrate(+, :, -).

%!  calibrate(+What, :Options, -SetRobot) is semidet.
%
%   Measure the wheels or the axle of the robot by a few moves without the
%   help of a gyro. SetRobot is the call of set_robot/4 or set_robot/5 that
%   describes the result; calibrate/3 does not call it. What is
%
%     - wheels
%       The diameters, from a straight line, ahead and back. If the robot does
%       not go straight, one wheel is larger than the other.
%     - axle
%       The distance between the wheels, from turns on the spot in both
%       directions. Calibrate the wheels first.
%
%   If a gyro is connected and measured/1 is not given, the gyro measures the
%   angles. No sensor measures the length of the line. Options:
%
%     - measured(:Goal)
%       Get the user's measurements by Goal. For the wheels, calibrate/3 calls
%       `call(Goal, Ahead, Right)` after the line ahead: the middle of the
%       axle is Ahead cm ahead of its start and Right cm to the right of it,
%       along and across the robot's first direction. For the axle, it calls
%       `call(Goal, Degrees)` after the turns clockwise, and again after the
%       turns back: the robot has turned by Degrees since its start. Degrees
%       may include full turns or not.
%     - length(+Cm)
%       With the gyro: the true length of the line, measured in an earlier
%       run. Default is the value of `distance`.
%     - distance(+Cm)
%       The length of the line that the robot drives. Default is 100.
%     - turns(+Count)
%       The number of full turns. Default is 5.
%     - speed(+Speed)
%       In percent, or as `cm_per_s(20)`. Default is 20.
%
%   Fails if no robot is set, if the robot does not complete a move, or if
%   there is neither a gyro nor the option `measured`.
%
%   @error domain_error(calibration, What)
%   @error domain_error(calibration_option, Option) if Option is not an option
%          of this predicate

calibrate(What0, Module:Options, SetRobot) :-
    word(What0, What),
    must_be_options(calibration_option,
                    [measured, length, distance, turns, speed], Options),
    (   What == wheels
    ->  robot_description(Robot),
        wheels(Robot, Module, Options, SetRobot)
    ;   What == axle
    ->  robot_description(Robot),
        axle(Robot, Module, Options, SetRobot)
    ;   domain_error(calibration, What)
    ).

% ---------------- WHEELS

wheels(Robot, Module, Options, SetRobot) :-
    Robot = robot(Left, Right, DL, DR, IL, IR, Axle, Offset),
    number_option(distance(Distance), positive_number, Options, 100),
    speed_option(Options, speed, 20, Speed),
    way(Distance, Speed, Axle, Module, Options, Length, Turn),
    % The true distance of each wheel, divided by the assumed distance.
    Half is Axle * Turn / 2,
    DL1 is DL * (Length + Half) / Distance,
    DR1 is DR * (Length - Half) / Distance,
    call_of(robot(Left, Right, DL1, DR1, IL, IR, Axle, Offset), SetRobot).

%   Length is the true length of the line, in cm. Turn is the angle by which
%   the robot turned, in radians.
way(Distance, Speed, _, Module, Options, Length, Turn) :-
    option(measured(Goal), Options),
    !,
    straight(Speed, Distance),
    call(Module:Goal, Ahead0, Right0),
    number_value(Ahead0, Ahead),
    number_value(Right0, Right),
    Half is atan2(Right, Ahead),
    Turn is 2 * Half,
    Chord is sqrt(Ahead**2 + Right**2),
    arc_length(Chord, Half, Length).
way(Distance, Speed, _, _, Options, Length, Turn) :-
    sensor_to_read(Gyro, ['lego-ev3-gyro'], _),
    !,
    number_option(length(Length), positive_number, Options, Distance),
    rest_angle(Gyro, A0),
    straight(Speed, Distance),
    rest_angle(Gyro, A1),
    straight(Speed, -Distance),
    rest_angle(Gyro, A2),
    % Both moves take the same time, so the drift of the gyro cancels out.
    Turn is ((A1 - A0) - (A2 - A1)) / 2 * pi / 180.

arc_length(Chord, Half, Length) :-
    (   abs(Half) < 1.0e-9
    ->  Length = Chord
    ;   Length is Chord * Half / sin(Half)
    ).

% ---------------- AXLE

axle(Robot, Module, Options, SetRobot) :-
    Robot = robot(Left, Right, DL, DR, IL, IR, Axle, Offset),
    option(turns(Turns), Options, 5),
    must_be(positive_integer, Turns),
    speed_option(Options, speed, 20, Speed),
    Angle is 360 * Turns,
    turned(Angle, Speed, Module, Options, Turned),
    Axle1 is Axle * Angle / Turned,
    call_of(robot(Left, Right, DL, DR, IL, IR, Axle1, Offset), SetRobot).

%   Turned is the true angle of the turns, in degrees.
turned(Angle, Speed, Module, Options, Turned) :-
    option(measured(Goal), Options),
    !,
    spin(Speed, Angle),
    call(Module:Goal, There0),
    spin(Speed, -Angle),
    call(Module:Goal, Back0),
    number_value(There0, There),
    number_value(Back0, Back),
    % The user need not count the full turns.
    nearest_turn(Angle, There, A1),
    nearest_turn(0, Back, A2),
    Turned is A1 - A2 / 2.
turned(Angle, Speed, _, _, Turned) :-
    sensor_to_read(Gyro, ['lego-ev3-gyro'], _),
    rest_angle(Gyro, A0),
    spin(Speed, Angle),
    rest_angle(Gyro, A1),
    spin(Speed, -Angle),
    rest_angle(Gyro, A2),
    Turned is ((A1 - A0) - (A2 - A1)) / 2.

nearest_turn(Expected, Degrees, Angle) :-
    Angle is Degrees + 360 * round((Expected - Degrees) / 360.0).

% ---------------- MOVES

%   Moves without the gyro.
straight(Speed, Distance) :-
    move_straight(Speed, Distance, [use_gyro(false)]).

spin(Speed, Angle) :-
    move_turn(Speed, Angle, [use_gyro(false)]).

%   The gyro's angle while the robot rests. The gyro reports whole degrees;
%   the mean of many samples is a little more exact.
rest_angle(Gyro, Angle) :-
    findall(A, ( between(1, 50, _), once(pause_ang(Gyro, A)) ), Angles),
    sum_list(Angles, Sum),
    Angle is Sum / 50.0.

pause_ang(Gyro, Angle) :-
    wait(0.01),
    gyro_ang(Gyro, Angle).

%   The call that describes a robot, to a hundredth of a millimeter.
call_of(robot(Left, Right, DL0, DR0, IL, IR, Axle0, Offset), SetRobot) :-
    rounded(DL0, DL),
    rounded(DR0, DR),
    rounded(Axle0, Axle),
    (   DL =:= DR
    ->  Diameter = DL,
        Unequal = []
    ;   rounded((DL + DR) / 2, Diameter),
        Unequal = [left_diameter(DL), right_diameter(DR)]
    ),
    findall(Side, member(Side-true, [left-IL, right-IR]), Sides),
    (   Sides == []
    ->  Inverted = []
    ;   Inverted = [inverted(Sides)]
    ),
    (   Offset =:= 0
    ->  Aside = []
    ;   Aside = [axle_offset(Offset)]
    ),
    (   motor_gear(Left, Gear),
        Gear =\= 1
    ->  Geared = [gear(Gear)|Aside]
    ;   Geared = Aside
    ),
    append(Inverted, Geared, More),
    append(Unequal, More, Options),
    (   Options == []
    ->  SetRobot = set_robot(Diameter, Axle, Left, Right)
    ;   SetRobot = set_robot(Diameter, Axle, Left, Right, Options)
    ).

rounded(Cm, Rounded) :-
    Rounded is round(Cm * 1000) / 1000.0.
