:- module(ev3dev_robot,
          [ set_robot/4,        % +WheelDiameter, +AxleLength, +Left, +Right
            set_robot/5,        % ... , +Options
            stop/0,
            go/1,               % +Speed
            go/2,               % +Speed, +Angle
            go_cm/2,            % +Speed, +Distance
            turn/1,             % +Speed
            turn/2              % +Speed, +Angle
          ]).
:- set_prolog_flag(generate_debug_info, false).
:- use_module(private/basics/fields, [goal_expansion/2, term_expansion/2]).
:- use_module(private/checks/checks, [evaluated/2, must_be/2]).
:- use_module(private/errors/errors, [domain_error/2]).
:- use_module(private/errors/public_clauses, [term_expansion/4]).
:- use_module(private/explain/hints).
:- use_module(driver, [tacho_motor/3]).
:- use_module(motors, [motor_stop/1, motors_run/1, stop_all_motors/0]).
:- use_module(motor_settings, [motor_gear/2]).
:- use_module(private/checks/arguments,
              [ angle_value/2, must_be_options/3, number_option/4,
                number_value/3, option/2, option/3, word/2
              ]).
:- use_module(private/errors/domains, [finite/1]).
:- use_module(private/devices/drive_moves,
              [move_straight/3, move_turn/3, robot_speed/2]).
:- use_module(private/devices/robot_state,
              [ robot_description/1, robot_set/4, store_robot/2 ]).
:- reexport(private/devices/robot_state, [robot/4]).
:- use_module(private/native/native, [odometry_/1]).

/** <module> A robot with two wheels

A robot that steers by the speeds of its two wheels, like the vehicles of most
building instructions. A program describes it once:

```
?- set_robot(5.6, 10.6, outB, outC).
```

Speeds are in percent of the motors' highest speed, distances in centimeters,
angles in degrees; they may be any arithmetic expression. A speed may also be
`cm_per_s(N)`, or `dps(N)`, `rps(N)` or `rpm(N)` of the wheels. The sign of
a speed and that of a distance or angle together make the direction; clockwise
is positive.

All predicates fail if no robot is set, if a motor is not connected, and if a
move is impossible: a speed beyond 100 percent, or a speed of 0 for a move
that has an end. Nothing moves then, and a warning says why:
see the flag `ev3dev_hints` of library(ev3dev). A distance or an angle of 0 is
done at once.

go/2, go_cm/2 and turn/2 wait. A native loop keeps the robot on its course
meanwhile, by the rotation sensors of its wheels and by a gyro, if one is
connected; library(ev3dev/drive) has more moves of that kind, with options.
They start and stop gently, and hold the robot where it is at the end. An
interrupt, for example Ctrl-C, stops the robot first. They fail, and the robot
stands, if they end early:

  - A wheel is blocked. That prints a warning.
  - The gyro contradicts the wheels: it is mounted upside down, a motor is
    mounted backwards, left and right motor are swapped, or the wheels spin on
    the spot. That prints a warning.
  - Another thread stops a motor, or gives it another command.
*/

%!  set_robot(+WheelDiameter, +AxleLength, +Left, +Right) is semidet.
%!  set_robot(+WheelDiameter, +AxleLength, +Left, +Right, +Options)
%   is semidet.
%
%   Describe the robot: the diameter of its wheels and the distance between
%   the middles of their treads, both in cm, and the ports of its motors.
%   Replaces the robot set before. Fails, and changes nothing, unless two
%   motors of the same type are connected there. Options:
%
%     - left_diameter(+Cm)
%     - right_diameter(+Cm)
%       The diameter of that wheel alone. Default is WheelDiameter.
%     - inverted(+Sides)
%       A list of `left` and `right`: the wheels whose motor is mounted the
%       other way round, so that it drives backwards.
%     - gear(+Ratio)
%       The gear between the motors and the wheels: motor_gear/2 of both
%       motors. By default they keep theirs, which is 1 at first.
%     - axle_offset(+Cm)
%       How far the axle is ahead of the point that pose/3 of
%       library(ev3dev/drive) reports, and turns around it. Default is 0.
%
%   calibrate/3 of library(ev3dev/drive) finds the figures out.
%
%   @error domain_error(positive_number, Length)
%   @error domain_error(side, Side)
%   @error domain_error(robot_option, Option) if Option is not an option here

set_robot(WheelDiameter, AxleLength, Left, Right) :-
    set_robot(WheelDiameter, AxleLength, Left, Right, []).

set_robot(WheelDiameter0, AxleLength0, Left0, Right0, Options) :-
    number_value(positive_number, WheelDiameter0, WheelDiameter),
    number_value(positive_number, AxleLength0, AxleLength),
    word(Left0, Left),
    word(Right0, Right),
    build(WheelDiameter, Options, Diameters, Inverted, Offset, Gear),
    (   tacho_motor(Left, Type, LeftPath),
        tacho_motor(Right, Type, RightPath),
        LeftPath \== RightPath
    ->  true
    ;   fail_because(unlike(Left, Right))
    ),
    (   ( WheelDiameter >= 20 ; WheelDiameter < 1 ; AxleLength >= 60
        ; WheelDiameter > 1.5 * AxleLength )
    ->  advise(not_cm(WheelDiameter, AxleLength))
    ;   true
    ),
    (   nonvar(Gear)
    ->  motor_gear(Left, Gear),
        motor_gear(Right, Gear)
    ;   true
    ),
    store_robot(robot(WheelDiameter, AxleLength, Left, Right),
                built(Diameters, Inverted, Offset)),
    robot_description(Robot),
    % From now on it is known how far the wheels have rolled.
    ignore(odometry_(Robot)).

build(WheelDiameter, Options, LeftDiameter-RightDiameter, Inverted, Offset,
      Gear) :-
    must_be_options(robot_option,
                    [ left_diameter, right_diameter, inverted, gear,
                      axle_offset
                    ],
                    Options),
    (   option(gear(_), Options)
    ->  number_option(gear(Gear), positive_number, Options, 1)
    ;   true
    ),
    option(inverted(Sides), Options, []),
    number_option(left_diameter(LeftDiameter), positive_number, Options,
                  WheelDiameter),
    number_option(right_diameter(RightDiameter), positive_number, Options,
                  WheelDiameter),
    number_option(axle_offset(Offset), finite_number, Options, 0),
    must_be(list(atom), Sides),
    inverted(Sides, Inverted).

inverted(Sides, Left-Right) :-
    must_be_sides(Sides),
    inverted(left, Sides, Left),
    inverted(right, Sides, Right).

must_be_sides([]).
must_be_sides([Side|Sides]) :-
    (   memberchk(Side, [left, right])
    ->  must_be_sides(Sides)
    ;   domain_error(side, Side)
    ).

inverted(Side, Sides, Inverted) :-
    (   memberchk(Side, Sides)
    ->  Inverted = true
    ;   Inverted = false
    ).

%   Forwards is 1, or -1 where the motor is mounted the other way round.
forwards(LeftSign, RightSign) :-
    robot_description(robot(left_inverted: IL, right_inverted: IR)),
    sign_of(IL, LeftSign),
    sign_of(IR, RightSign).

sign_of(true, -1).
sign_of(false, 1).

directed(1, Number, Number).
directed(-1, Number, Opposite) :-
    Opposite is -Number.

%!  stop is semidet.
%
%   Stop both motors of the robot, with `brake`. If no robot is set, stop all
%   motors, as stop_all_motors/0 does. Does not wait until they stand still.
%   May be called from another thread while the robot moves. If one is not
%   connected, stops the other one and fails.

stop :-
    robot(_, _, Left, Right),
    !,
    (   catch(motor_stop(Left), Error, true)
    ->  motor_stop(Right),
        (   var(Error)
        ->  true
        ;   throw(Error)
        )
    ;   motor_stop(Right),
        fail
    ).
stop :-
    stop_all_motors.

%!  go(+Speed) is semidet.
%
%   Go straight on, until stopped; backwards if Speed is negative. At a Speed
%   of 0 the robot stands.

go(Speed) :-
    robot_set(_, _, Left, Right),
    robot_speed(Speed, Percent),
    wheels_run(Left, Percent, Right, Percent).

%   Run the wheels at these percentages of the motors' highest speed.
wheels_run(Left, LeftPercent0, Right, RightPercent0) :-
    forwards(LS, RS),
    directed(LS, LeftPercent0, LeftPercent),
    directed(RS, RightPercent0, RightPercent),
    motors_run([run(Left, LeftPercent), run(Right, RightPercent)]).

%!  go(+Speed, +Angle) is semidet.
%
%   Go straight on until each wheel has turned by Angle degrees. Waits. An
%   Angle of 0 is done at once.
%
%   @error existence_error(motor, Port) if a motor is unplugged under way

go(Speed, Angle) :-
    robot_set(WheelDiameter, _, _, _),
    robot_speed(Speed, Percent),
    angle_value(Angle, Degrees),
    possible(Degrees),
    Distance is Degrees * (pi * WheelDiameter / 360),
    move_straight(Percent, Distance, []).

%!  go_cm(+Speed, +Distance) is semidet.
%
%   Go straight on for Distance cm. Waits. A Distance of 0 is done at once.
%
%   @error existence_error(motor, Port) if a motor is unplugged under way

go_cm(Speed, Distance) :-
    robot_set(_, _, _Left, _Right),
    robot_speed(Speed, Percent),
    evaluated(Distance, Cm),
    possible(Cm),
    move_straight(Percent, Cm, []).

%!  turn(+Speed) is semidet.
%
%   Turn on the spot, clockwise, until stopped.

turn(Speed) :-
    robot_set(_, _, Left, Right),
    robot_speed(Speed, Percent),
    Reverse is -Percent,
    wheels_run(Left, Percent, Right, Reverse).

%!  turn(+Speed, +Angle) is semidet.
%
%   Turn on the spot by Angle degrees, clockwise positive. Waits. With a gyro,
%   the first of those connected, it ends within a degree. Without one it goes
%   by the wheels, and is as exact as AxleLength. A turn by 0 is done at once.
%
%   A gyro counts to 32767 degrees. Once it has passed 16384 either way, the
%   next move restarts it if the robot stands: gyro_ang/2 is 0 again.
%
%   @error existence_error(Kind, Port) if a motor or the gyro is unplugged
%          under way

turn(Speed, Angle) :-
    robot_set(_, _, _Left, _Right),
    robot_speed(Speed, Percent),
    evaluated(Angle, Degrees),
    possible(Degrees),
    move_turn(Percent, Degrees, []).

possible(Number) :-
    (   finite(Number)
    ->  true
    ;   fail_because(unable('the robot', 'move by', Number))
    ).
