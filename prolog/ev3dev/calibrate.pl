:- module(ev3dev_calibrate,
          [ calibrate/3                 % +What, :Options, -SetRobot
          ]).
:- use_module(private/errors, [domain_error/2, must_be/2, term_expansion/2]).
:- use_module(library(lists), [append/3, member/2, sum_list/2]).
:- use_module(library(option), [option/2, option/3]).
:- use_module(private/arguments, [must_be_options/3]).
:- use_module(sensors, [gyro_ang/2, gyro_sensor/1]).
:- use_module(private/drive_moves, [number_value/2]).
:- use_module(drive, [go_cm/3, turn/3]).
:- use_module(private/robot_state, [robot_description/1]).
:- use_module(private/native, [drive_pause_/1]).

/** <module> Calibration: how large wheels and axle really are

What a student measures at a robot is a little off: wheels give way under its
weight, no two are the same, and nobody knows where a tyre touches the floor.
So it is found out from how the robot really moves.
*/

:- meta_predicate calibrate(+, :, -).

%!  calibrate(+What, :Options, -SetRobot) is semidet.
%
%   Find out the figures of the robot that is set, by a few moves with the
%   wheels alone. SetRobot is the call of set_robot/4 or set_robot/5 to write
%   down; it changes nothing unless it is called. What is
%
%     - wheels
%       The diameters, from a straight line, ahead and back. If the robot does
%       not go straight, one wheel is larger than the other.
%     - axle
%       The distance of the wheels, from turns on the spot in either
%       direction.
%       To be done after the wheels.
%
%   A gyro, if one is connected, measures how far the robot turns, unless
%   measured/1 is given. How long the line was in truth no sensor tells.
%   Options:
%
%     - measured(:Goal)
%       What the user measured. For the wheels, `call(Goal, Ahead, Right)` is
%       asked after the way ahead how many cm ahead of where it started and to
%       the right the middle of the axle is, along and across the direction
%       that it started in. For the axle, `call(Goal, Degrees)` is asked how
%       far the robot has turned since it started, full turns included or not;
%       once after the turns clockwise, and once after those back.
%     - length(+Cm)
%       With the gyro: how long the way ahead turned out to be, if it was
%       measured once before. Default is the distance that was asked for.
%     - distance(+Cm)
%       How far to go. Default is 100.
%     - turns(+Count)
%       How many full turns to make. Default is 5.
%     - speed(+Percent)
%       Default is 20.
%
%   Fails if no robot is set, if it does not get to the end, and if there is
%   neither a gyro nor what was measured.
%
%   @error domain_error(calibration, What)
%   @error domain_error(calibration_option, Option) for an option that is none

calibrate(What, Module:Options, SetRobot) :-
    must_be(atom, What),
    must_be_options(calibration_option,
                    [measured, length, distance, turns, speed], Options),
    robot_description(Robot),
    (   What == wheels
    ->  wheels(Robot, Module, Options, SetRobot)
    ;   What == axle
    ->  axle(Robot, Module, Options, SetRobot)
    ;   domain_error(calibration, What)
    ).

                /*******************************
                *            WHEELS            *
                *******************************/

wheels(Robot, Module, Options, SetRobot) :-
    Robot = robot(Left, Right, DL, DR, IL, IR, Axle, Offset),
    length_option(distance, Options, 100, Distance),
    option(speed(Speed), Options, 20),
    way(Distance, Speed, Axle, Module, Options, Length, Turn),
    % What each wheel rolled in truth, by what it was thought to roll.
    Half is Axle * Turn / 2,
    DL1 is DL * (Length + Half) / Distance,
    DR1 is DR * (Length - Half) / Distance,
    call_of(robot(Left, Right, DL1, DR1, IL, IR, Axle, Offset), SetRobot).

%   The true length of a way, in cm, and by how many radians the robot turned.
way(Distance, Speed, _, Module, Options, Length, Turn) :-
    option(measured(Goal), Options),
    !,
    move(go_cm(Speed, Distance)),
    call(Module:Goal, Ahead0, Right0),
    number_value(Ahead0, Ahead),
    number_value(Right0, Right),
    Half is atan2(Right, Ahead),
    Turn is 2 * Half,
    Chord is sqrt(Ahead**2 + Right**2),
    arc_length(Chord, Half, Length).
way(Distance, Speed, _, _, Options, Length, Turn) :-
    gyro_sensor(Gyro),
    !,
    length_option(length, Options, Distance, Length),
    rest_angle(Gyro, A0),
    move(go_cm(Speed, Distance)),
    rest_angle(Gyro, A1),
    move(go_cm(Speed, -Distance)),
    rest_angle(Gyro, A2),
    % Both take the same time: what the gyro drifts cancels out.
    Turn is ((A1 - A0) - (A2 - A1)) / 2 * pi / 180.

arc_length(Chord, Half, Length) :-
    (   abs(Half) < 1.0e-9
    ->  Length = Chord
    ;   Length is Chord * Half / sin(Half)
    ).

                /*******************************
                *             AXLE             *
                *******************************/

axle(Robot, Module, Options, SetRobot) :-
    Robot = robot(Left, Right, DL, DR, IL, IR, Axle, Offset),
    option(turns(Turns), Options, 5),
    must_be(positive_integer, Turns),
    option(speed(Speed), Options, 20),
    Angle is 360 * Turns,
    turned(Angle, Speed, Module, Options, Turned),
    Axle1 is Axle * Angle / Turned,
    call_of(robot(Left, Right, DL, DR, IL, IR, Axle1, Offset), SetRobot).

%   By how many degrees the robot turned in truth.
turned(Angle, Speed, Module, Options, Turned) :-
    option(measured(Goal), Options),
    !,
    move(turn(Speed, Angle)),
    call(Module:Goal, There0),
    move(turn(Speed, -Angle)),
    call(Module:Goal, Back0),
    number_value(There0, There),
    number_value(Back0, Back),
    % Nobody counts the full turns.
    nearest_turn(Angle, There, A1),
    nearest_turn(0, Back, A2),
    Turned is A1 - A2 / 2.
turned(Angle, Speed, _, _, Turned) :-
    gyro_sensor(Gyro),
    rest_angle(Gyro, A0),
    move(turn(Speed, Angle)),
    rest_angle(Gyro, A1),
    move(turn(Speed, -Angle)),
    rest_angle(Gyro, A2),
    Turned is ((A1 - A0) - (A2 - A1)) / 2.

nearest_turn(Expected, Degrees, Angle) :-
    Angle is Degrees + 360 * round((Expected - Degrees) / 360.0).

                /*******************************
                *            MOVES             *
                *******************************/

%   With the wheels alone.
move(go_cm(Speed, Distance)) :-
    go_cm(Speed, Distance, [use_gyro(false)]).
move(turn(Speed, Angle)) :-
    turn(Speed, Angle, [use_gyro(false)]).

%   The gyro's angle while the robot rests: it tells whole degrees, and the
%   mean of many readings tells a little more.
rest_angle(Gyro, Angle) :-
    findall(A, ( between(1, 50, _), once(pause_ang(Gyro, A)) ), Angles),
    sum_list(Angles, Sum),
    Angle is Sum / 50.0.

pause_ang(Gyro, Angle) :-
    drive_pause_(0.01),
    gyro_ang(Gyro, Angle).

length_option(Name, Options, Default, Length) :-
    Option =.. [Name, Value],
    option(Option, Options, Default),
    number_value(Value, Length),
    (   Length > 0
    ->  true
    ;   domain_error(positive_number, Length)
    ).

%   The call that describes a robot, to a hundredth of a millimetre.
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
    append(Inverted, Aside, More),
    append(Unequal, More, Options),
    (   Options == []
    ->  SetRobot = set_robot(Diameter, Axle, Left, Right)
    ;   SetRobot = set_robot(Diameter, Axle, Left, Right, Options)
    ).

rounded(Cm, Rounded) :-
    Rounded is round(Cm * 1000) / 1000.0.
