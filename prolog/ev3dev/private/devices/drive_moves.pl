:- module(ev3dev_drive_moves,
          [ move/3,                     % +Percent, +Course, +Options
            move_straight/3,            % +Percent, +Distance, +Options
            move_turn/3,                % +Percent, +Angle, +Options
            robot_speed/2,              % +Speed, -Percent
            speed_option/4,             % +Options, +Domain, +Default,
                                        % -Percent
            must_be_move_options/1,     % +Options
            backwards/2                 % +Direction, -Backwards
          ]).
:- use_module('../basics/fields', [goal_expansion/2, term_expansion/2]).
:- use_module('../checks/checks', [evaluated/2, must_be/2]).
:- use_module('../errors/public_clauses', [term_expansion/4]).
:- use_module('../explain/hints').
:- use_module('../checks/arguments',
              [ must_be_options/3, number_option/4, number_value/3, option/2,
                option/3, speed_value/2, timeout_option/2
              ]).
:- use_module(robot_state,
              [drive_default/2, robot/4, robot_description/1, robot_set/4]).
:- use_module('../run/waits', [waited/1]).
:- use_module('../native/native', [attribute_/4, drive_/4, motor_gear_/2]).

/** <module> Moves of the drive

What the moves of library(ev3dev/robot) and of library(ev3dev/drive) have in
common.
*/

%!  move_straight(+Percent, +Distance, +Options) is semidet.
%
%   Go straight on for Distance cm. The signs of both make the direction.

move_straight(Percent, Distance, Options) :-
    backwards(sign(Percent) * sign(Distance), Backwards),
    Length is abs(Distance),
    move(Percent, legs([arc(Length, 0)], Backwards), Options).

%!  move_turn(+Percent, +Angle, +Options) is semidet.
%
%   Turn on the spot by Angle degrees. The signs of both make the direction.

move_turn(Percent, Angle, Options) :-
    Turn is Angle * sign(Percent),
    move(Percent, legs([turn(Turn)], false), Options).

%!  move(+Percent, +Course, +Options) is semidet.
%
%   Make a move with the options of library(ev3dev/drive). Percent is the
%   speed; its sign is in Course, which is
%
%     - legs(Legs, Backwards)
%       A list of arc(Length, Curvature), turn(Angle), towards(X, Y),
%       reach(X, Y), to(X, Y), face(Heading) and through(Places, Radius).
%     - wheels(Left, Right)
%       Without end, the speeds of the wheels as shares of Percent.
%     - cruise(CmPerSecond, DegreesPerSecond)
%       Without end.
%
%   @error those of library(ev3dev/drive)

move(Percent, Course, Options) :-
    move_options(Percent, Course, Options, Native),
    option(reason(Reason), Options, _),
    robot_description(Robot),
    (   catch(drive_to_end(Robot, Course, Native, Ended), E, true)
    ->  (   var(E)
        ->  true
        ;   E = error(existence_error(_, _), _),
            option(reason(_), Options)
        ->  Ended = unplugged
        ;   throw(E)
        ),
        (   option(reason(_), Options)
        ->  Reason = Ended
        ;   ended(Ended, Course)
        )
    ;   Robot = robot(left: Left, right: Right),
        fail_because(cannot_move(Left, Right, Percent, Course))
    ).

drive_to_end(Robot, Course, Native, Ended) :-
    drive_(Robot, Course, Native, Ended),
    waited(Ended),
    !.

move_options(Percent, Course, Options,
             options(Speed, Acceleration, Action, UseGyro, Wait, Timeout)) :-
    must_be_move_options(Options),
    evaluated(abs(Percent), Speed),
    drive_default(acceleration, Default),
    number_option(acceleration(Acceleration), acceleration, Options, Default),
    option(stop_action(Action), Options, hold),
    drive_default(use_gyro, Default1),
    option(use_gyro(UseGyro), Options, Default1),
    must_be(boolean, UseGyro),
    option(wait(Wait0), Options, true),
    must_be(boolean, Wait0),
    timeout_option(Options, Timeout),
    (   Course = legs(_, _)
    ->  Wait = Wait0
    ;   Wait = false
    ).

ended(reached, _) :-
    !.
ended(stalled, _) :-
    !,
    robot(_, _, Left, Right),
    warn_once(ev3dev(stalled([Left, Right]))),
    fail.
ended(astray, _) :-
    !,
    robot(_, _, Left, Right),
    warn_once(ev3dev(astray([Left, Right]))),
    fail.
ended(Reason, Course) :-
    explain("~p ended early: ~w", [Course, Reason]),
    (   Reason == stopped
    ->  advise(interrupted('the robot'))
    ;   true
    ),
    fail.

:- multifile prolog:message//1.

prolog:message(ev3dev(astray([Left, Right]))) -->
    [ 'the gyro does not follow the wheels at ~w and ~w. '-[Left, Right],
      'Possible causes:'-[], nl,
      '  - a motor is mounted backwards: add the option '-[],
      'inverted([left]) or inverted([right]) to set_robot'-[], nl,
      '  - the left and the right motor are swapped: '-[],
      'exchange their ports in set_robot/4'-[], nl,
      '  - the gyro is upside down: drive_option(use_gyro, false)'-[], nl,
      '  - the wheels spin on the spot'-[]
    ].

%!  robot_speed(+Speed, -Percent) is semidet.
%
%   Percent is the speed of the faster wheel in percent of what its motor can.
%   Speed is an expression of it, or dps(N), rps(N) or rpm(N) of the wheel, or
%   cm_per_s(N). Fails for these if no robot is set or its left motor is not
%   connected.

robot_speed(Speed, Percent) :-
    wheel_speed(Speed, Value),
    (   Value = dps(Degrees)
    ->  robot_set(_, _, Left, _),
        attribute_('tacho-motor', Left, max_speed, Max),
        attribute_('tacho-motor', Left, count_per_rot, Counts),
        motor_gear_(Left, Gear),
        Percent is Degrees * Gear * Counts / 3.6 / Max
    ;   Percent = Value
    ).

wheel_speed(Speed, Value) :-
    (   nonvar(Speed),
        Speed = cm_per_s(Expression)
    ->  evaluated(Expression, Cm),
        robot_set(WheelDiameter, _, _, _),
        Degrees is Cm * 360 / (pi * WheelDiameter),
        Value = dps(Degrees)
    ;   speed_value(Speed, Value)
    ).

%!  speed_option(+Options, +Domain, +Default, -Percent) is semidet.
%
%   Percent is the value of the option `speed` in Options, by default Default,
%   as of robot_speed/2. It is in the range of Domain.
%
%   @error domain_error(Domain, Percent)

speed_option(Options, Domain, Default, Percent) :-
    option(speed(Speed), Options, Default),
    robot_speed(Speed, Value),
    number_value(Domain, Value, Percent).

%!  must_be_move_options(+Options) is det.
%
%   @error domain_error(drive_option, Option) for an option that moves do not
%          have

must_be_move_options(Options) :-
    must_be_options(drive_option,
                    [ speed, acceleration, use_gyro, stop_action, wait,
                      timeout, reason ],
                    Options).

%!  backwards(+Direction, -Backwards) is det.
%
%   Backwards is `true` if Direction is negative, else `false`.

backwards(Direction, Backwards) :-
    (   Direction < 0
    ->  Backwards = true
    ;   Backwards = false
    ).
