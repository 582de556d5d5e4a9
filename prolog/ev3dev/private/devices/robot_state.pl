:- module(ev3dev_robot_state,
          [ robot/4,                    % ?WheelDiameter, ?Axle, ?Left, ?Right
            robot_set/4,                % -WheelDiameter, -Axle, -Left, -Right
            robot_description/1,        % -Robot
            store_robot/2,              % +Robot, +Built
            drive_default/2,            % ?Name, ?Value
            store_drive_default/2       % +Name, +Value
          ]).
:- use_module('../basics/fields',
              [fields/1, goal_expansion/2, term_expansion/2]).
:- use_module('../run/brick', [brick/1, of_brick/1]).
:- use_module('../explain/hints', [fail_because/1]).

:- fields(robot(left, right, left_diameter, right_diameter, left_inverted,
                right_inverted, axle, offset)).

/** <module> The robot of set_robot/4
*/

:- dynamic
    described/3,                        % Brick, Robot, Built
    default/3.                          % Brick, Name, Value
:- of_brick([described/3, default/3]).

%!  drive_default(?Name, ?Value) is nondet.
%
%   True if moves that are not given the option Name have this Value of it.

drive_default(Name, Value) :-
    brick(Brick),
    usual(Name, Usual),
    (   default(Brick, Name, Stored)
    ->  Value = Stored
    ;   Value = Usual
    ).

usual(use_gyro, true).
usual(speed, 40).
usual(acceleration, 50).

%!  store_drive_default(+Name, +Value) is det.

store_drive_default(Name, Value) :-
    brick(Brick),
    with_mutex(ev3dev_robot,
               ( retractall(default(Brick, Name, _)),
                 assertz(default(Brick, Name, Value)) )).

%!  robot(?WheelDiameter, ?AxleLength, ?Left, ?Right) is semidet.
%
%   True if that is the robot that was set by set_robot/4.

robot(WheelDiameter, AxleLength, Left, Right) :-
    brick(Brick),
    described(Brick, robot(WheelDiameter, AxleLength, Left, Right), _).

:- multifile ev3dev_watchdog:rolled/2.

ev3dev_watchdog:rolled(Degrees, Cm) :-
    ev3dev_robot_state:robot(WheelDiameter, _, _, _),
    Cm is Degrees/360*pi*WheelDiameter.

%!  robot_set(-WheelDiameter, -AxleLength, -Left, -Right) is semidet.
%
%   Like robot/4, but explains why it fails.

robot_set(WheelDiameter, AxleLength, Left, Right) :-
    robot_set(robot(WheelDiameter, AxleLength, Left, Right), _).

robot_set(Robot, Built) :-
    brick(Brick),
    (   described(Brick, Robot, Built)
    ->  true
    ;   fail_because(no_robot)
    ).

%!  robot_description(-Robot) is semidet.
%
%   The robot as the foreign library takes it: a term robot(Left, Right,
%   LeftDiameter, RightDiameter, LeftInverted, RightInverted, AxleLength,
%   AxleOffset). Fails like robot_set/4.

robot_description(robot(Left, Right, DL, DR, IL, IR, AxleLength, Offset)) :-
    robot_set(robot(_, AxleLength, Left, Right), built(DL-DR, IL-IR, Offset)).

%!  store_robot(+Robot, +Built) is det.
%
%   Replace the robot by a term robot/4, and what else is known of it by
%   built(LeftDiameter-RightDiameter, LeftInverted-RightInverted, AxleOffset).

store_robot(Robot, Built) :-
    brick(Brick),
    with_mutex(ev3dev_robot,
               ( retractall(described(Brick, _, _)),
                 asserta(described(Brick, Robot, Built)) )).
