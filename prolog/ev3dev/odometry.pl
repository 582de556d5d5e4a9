:- module(ev3dev_odometry,
          [ pose/3,                 % -X, -Y, -Heading
            set_pose/3,             % +X, +Y, +Heading
            pose_uncertainty/1,     % -Covariance
            heading_wrapped/2,      % +Heading, -Wrapped
            drive_option/2          % +Name, ?Value
          ]).
:- set_prolog_flag(generate_debug_info, false).
:- use_module(private/basics/fields, [goal_expansion/2, term_expansion/2]).
:- use_module(private/checks/checks, [must_be/2]).
:- use_module(private/errors/errors, [domain_error/2]).
:- use_module(private/errors/public_clauses, [term_expansion/4]).
:- use_module(private/explain/hints).
:- use_module(driver, []).
:- use_module(private/checks/arguments,
              [number_value/2, number_value/3, speed_unit/3, word/2]).
:- use_module(private/devices/robot_state,
              [drive_default/2, robot_description/1, store_drive_default/2]).
:- use_module(private/native/native,
              [ heading_wrapped_/2, pose_/5, pose_uncertainty_/3,
                set_pose_/5 ]).

/** <module> Odometry: where the robot is

The part of library(ev3dev/drive) that knows where the robot is, and holds its
options. The pose counts from when a robot is set.
*/

%!  drive_option(+Name, ?Value) is semidet.
%
%   Ask for an option of the library, or set it if Value is bound:
%
%     - use_gyro: `true` (default) or `false`
%       Whether a gyro, if one is connected, gives the heading. While it does
%       it also teaches how much wheels and axle differ from what set_robot/4
%       says, by slipping for one; with `false` that is forgotten.
%     - speed: 40
%       In percent, or as `cm_per_s(20)`, for moves without a speed of their
%       own.
%     - acceleration: 50
%       In cm/s^2, from 1 to 1000.
%
%   @error domain_error(drive_option, Name)
%   @error domain_error(acceleration, Value), domain_error(speed, Value)

drive_option(Name0, Value) :-
    word(Name0, Name),
    (   \+ memberchk(Name, [use_gyro, speed, acceleration])
    ->  domain_error(drive_option, Name)
    ;   var(Value)
    ->  drive_default(Name, Value)
    ;   valid_option(Name, Value, Valid),
        store_drive_default(Name, Valid)
    ).

valid_option(use_gyro, Value, Value) :-
    must_be(boolean, Value).
valid_option(speed, Speed, Valid) :-
    (   nonvar(Speed),
        in_unit(Speed, Expression)
    ->  number_value(Expression, Number),
        (   Number =\= 0
        ->  functor(Speed, Unit, 1),
            Valid =.. [Unit, Number]
        ;   domain_error(speed, Speed)
        )
    ;   number_value(speed, Speed, Valid)
    ).
valid_option(acceleration, Acceleration, Number) :-
    number_value(acceleration, Acceleration, Number).

%   What moves take as a speed besides a percentage.
in_unit(cm_per_s(Expression), Expression).
in_unit(Speed, Expression) :-
    speed_unit(Speed, Expression, _).

%!  pose(-X, -Y, -Heading) is semidet.
%
%   Where the robot is, by its wheels and its gyro. Counts from 0, 0, 0 where
%   it was when set_robot/4 was called first, or from set_pose/3. May be asked
%   while it moves, by any thread. Fails if no robot is set or a motor is not
%   connected.

pose(X, Y, Heading) :-
    robot(Robot, UseGyro),
    (   pose_(Robot, UseGyro, X0, Y0, Heading0)
    ->  X = X0, Y = Y0, Heading = Heading0
    ;   motor_is_missing(Robot)
    ).

%!  set_pose(+X, +Y, +Heading) is semidet.
%
%   The robot is there now.

set_pose(X, Y, Heading) :-
    number_value(X, X1),
    number_value(Y, Y1),
    number_value(Heading, Heading1),
    robot(Robot, UseGyro),
    (   set_pose_(Robot, UseGyro, X1, Y1, Heading1)
    ->  true
    ;   motor_is_missing(Robot)
    ).

%!  pose_uncertainty(-Covariance) is semidet.
%
%   How uncertain the pose is: the covariance of x, y and heading as a list of
%   rows, `[[XX,XY,XH], [XY,YY,YH], [XH,YH,HH]]`, in cm and degrees. The
%   square root of XX is the standard deviation of x. It grows with the way,
%   from what wheels and axle are usually off, and is 0 after set_pose/3: each
%   wheel by 0.75 %, the axle by 3 % until the gyro has shown more. Wheels
%   that slip more than that are not in it; no gyro measures a distance.

pose_uncertainty(Covariance) :-
    robot(Robot, UseGyro),
    (   pose_uncertainty_(Robot, UseGyro, Rows)
    ->  Covariance = Rows
    ;   motor_is_missing(Robot)
    ).

%!  heading_wrapped(+Heading, -Wrapped) is det.
%
%   Wrapped is that heading without full turns: more than -180, at most 180.

heading_wrapped(Heading, Wrapped) :-
    number_value(Heading, Degrees),
    heading_wrapped_(Degrees, Wrapped).

%   The robot, and whether to use the gyro.
motor_is_missing(Robot) :-
    Robot = robot(left: Left, right: Right),
    fail_because(cannot([run(Left, 0), run(Right, 0)])).

robot(Robot, UseGyro) :-
    robot_description(Robot),
    drive_default(use_gyro, UseGyro).
