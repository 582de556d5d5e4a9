:- module(ev3dev_robot,
          [ set_robot/4,        % +WheelDiameter, +AxleLength, +Left, +Right
            robot/4,            % ?WheelDiameter, ?AxleLength, ?Left, ?Right
            stop/0,
            go/1,               % +Speed
            go/2,               % +Speed, +Angle
            go_cm/2,            % +Speed, +Distance
            turn/1,             % +Speed
            turn/2              % +Speed, +Angle
          ]).
:- use_module(library(debug), [debug/3]).
:- use_module(library(error), [domain_error/2, must_be/2]).
:- use_module(driver, [tacho_motor/3]).
:- use_module(motors, [motor_stop/1, motors_run/1, motors_turn/2]).
:- use_module(sensors, [gyro_sensor/1]).

/** <module> A robot with two wheels

A robot that is steered by the speeds of its two wheels, such as the vehicles
of most building instructions. It is described once:

```
?- set_robot(5.6, 10.6, outB, outC).
```

Speeds are in percent of the motors' highest speed, distances in centimetres,
angles in degrees, all of them any arithmetic expression. The sign of a speed
and that of a distance or angle together make the direction; clockwise is
positive.

All predicates fail if no robot is set, if a motor is not connected, and if a
move is impossible: a speed beyond 100 percent, or going with a speed or an
angle of 0. Nothing moves then.
Those that wait can be interrupted, as by Ctrl-C; they stop the robot first.
*/

:- dynamic robot/4.

%!  set_robot(+WheelDiameter, +AxleLength, +Left, +Right) is semidet.
%
%   Describe the robot: the diameter of its wheels and the distance between
%   the middles of their treads, both in cm, and the ports of its motors.
%   Replaces the robot set before. Fails, and changes nothing, unless two
%   motors of the same type are connected there.
%
%   @error domain_error(positive_number, Length)

set_robot(WheelDiameter, AxleLength, Left, Right) :-
    must_be_length(WheelDiameter),
    must_be_length(AxleLength),
    must_be(atom, Left),
    must_be(atom, Right),
    tacho_motor(Left, Type, LeftPath),
    tacho_motor(Right, Type, RightPath),
    LeftPath \== RightPath,
    with_mutex(ev3dev_robot,
               ( retractall(robot(_, _, _, _)),
                 asserta(robot(WheelDiameter, AxleLength, Left, Right)) )).

must_be_length(Length) :-
    must_be(number, Length),
    (   Length > 0,
        Length < inf
    ->  true
    ;   domain_error(positive_number, Length)
    ).

%!  robot(?WheelDiameter, ?AxleLength, ?Left, ?Right) is semidet.
%
%   True if that is the robot that was set by set_robot/4.

%!  stop is semidet.
%
%   Stop both motors of the robot, with `brake`. Does not wait until they
%   stand. May be called from another thread while the robot moves. If one is
%   not connected, stops the other one and fails.

stop :-
    robot(_, _, Left, Right),
    (   motor_stop(Left)
    ->  motor_stop(Right)
    ;   motor_stop(Right),
        fail
    ).

%!  go(+Speed) is semidet.
%
%   Go straight on, until stopped; backwards if Speed is negative.

go(Speed) :-
    robot(_, _, Left, Right),
    Percent is Speed,
    moves(Percent),
    motors_run([run(Left, Percent), run(Right, Percent)]).

%!  go(+Speed, +Angle) is semidet.
%
%   Go straight on until each wheel has turned by Angle degrees. Waits.
%
%   @error existence_error(motor, Port) if a motor is unplugged under way

go(Speed, Angle) :-
    robot(_, _, Left, Right),
    Percent is Speed,
    Degrees is Angle,
    moves(Percent),
    moves(Degrees),
    motors_turn([ move(Left, Percent, Degrees),
                  move(Right, Percent, Degrees)
                ], []).

%!  go_cm(+Speed, +Distance) is semidet.
%
%   Go straight on for Distance cm. Waits.
%
%   @error existence_error(motor, Port) if a motor is unplugged under way

go_cm(Speed, Distance) :-
    robot(WheelDiameter, _, _, _),
    go(Speed, round(Distance * 360 / (pi * WheelDiameter))).

%!  turn(+Speed) is semidet.
%
%   Turn on the spot, clockwise, until stopped.

turn(Speed) :-
    robot(_, _, Left, Right),
    Percent is Speed,
    Reverse is -Percent,
    motors_run([run(Left, Percent), run(Right, Reverse)]).

%!  turn(+Speed, +Angle) is semidet.
%
%   Turn on the spot by Angle degrees, clockwise positive. Waits. With a gyro,
%   the first of those connected, it ends within a degree; if that cannot be
%   had, it prints why and fails. Without one it goes by the wheels.
%
%   @error existence_error(Kind, Port) if a motor or the gyro is unplugged
%          under way

turn(Speed, Angle) :-
    robot(WheelDiameter, AxleLength, Left, Right),
    Percent is Speed,
    Degrees is Angle,
    moves(Percent),
    (   gyro_sensor(Gyro)
    ->  Gearing is AxleLength / float(WheelDiameter),
        Signed is Degrees * sign(Percent),
        Wheels = wheels(Left, Right, Gearing),
        turn_by_gyro_(Gyro, Wheels, Percent, Signed, Ended),
        turn_ended(Ended, Degrees)
    ;   WheelAngle is round(AxleLength / WheelDiameter * Degrees),
        Opposite is -WheelAngle,
        motors_turn([ move(Left, Percent, WheelAngle),
                      move(Right, Percent, Opposite)
                    ], [])
    ).

turn_ended(reached, _) :-
    !.
turn_ended(Ended, Degrees) :-
    print_message(warning, ev3dev(turn(Ended, Degrees))),
    fail.

moves(Number) :-
    (   Number =\= 0
    ->  true
    ;   debug(ev3dev, "a speed or an angle of 0 moves nothing", []),
        fail
    ).

:- multifile prolog:message//1.

prolog:message(ev3dev(turn(Ended, Degrees))) -->
    [ 'Turn by ~w degrees not completed: '-[Degrees] ],
    turn_message(Ended).

turn_message(stalled) -->
    [ 'the gyro shows no movement. Are the wheels free?' ].
turn_message(astray) -->
    [ 'the gyro counts the other way. Is it mounted upside down, '-[],
      'or are left and right motor swapped?'-[]
    ].
turn_message(missed) -->
    [ 'not within a degree after several corrections.' ].
