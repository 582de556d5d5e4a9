:- module(ev3dev_robot_state,
          [ robot/4,                    % ?WheelDiameter, ?Axle, ?Left, ?Right
            robot_set/4,                % -WheelDiameter, -Axle, -Left, -Right
            robot_description/1,        % -Robot
            store_robot/2,              % +Robot, +Built
            drive_default/2,            % ?Name, ?Value
            store_drive_default/2       % +Name, +Value
          ]).
:- use_module(explain, [fail_because/1]).

/** <module> The robot that is set
*/

:- dynamic
    robot/4,
    built/3,                            % Diameters, Inverted, Offset
    drive_default/2.                    % Name, Value

%!  drive_default(?Name, ?Value) is nondet.
%
%   True if moves that are not given the option Name have this Value of it.

drive_default(use_gyro, true).
drive_default(speed, 40).
drive_default(acceleration, 50).

%!  store_drive_default(+Name, +Value) is det.

store_drive_default(Name, Value) :-
    with_mutex(ev3dev_robot,
               ( retractall(drive_default(Name, _)),
                 assertz(drive_default(Name, Value)) )).

%!  robot(?WheelDiameter, ?AxleLength, ?Left, ?Right) is semidet.
%
%   True if that is the robot that was set by set_robot/4.

%!  robot_set(-WheelDiameter, -AxleLength, -Left, -Right) is semidet.
%
%   Like robot/4, but explains why it fails.

robot_set(WheelDiameter, AxleLength, Left, Right) :-
    (   robot(WheelDiameter, AxleLength, Left, Right)
    ->  true
    ;   fail_because(no_robot)
    ).

%!  robot_description(-Robot) is semidet.
%
%   The robot as the foreign library takes it: a term robot(Left, Right,
%   LeftDiameter, RightDiameter, LeftInverted, RightInverted, AxleLength,
%   AxleOffset). Fails like robot_set/4.

robot_description(Robot) :-
    robot_set(WheelDiameter, AxleLength, Left, Right),
    (   built(DL-DR, IL-IR, Offset)
    ->  true
    ;   % a program's own robot/4
        DL-DR = WheelDiameter-WheelDiameter,
        IL-IR = false-false,
        Offset = 0
    ),
    Robot = robot(Left, Right, DL, DR, IL, IR, AxleLength, Offset).

%!  store_robot(+Robot, +Built) is det.
%
%   Replace the robot by a term robot/4, and what else is known of it by
%   built(LeftDiameter-RightDiameter, LeftInverted-RightInverted, AxleOffset).

store_robot(Robot, Built) :-
    with_mutex(ev3dev_robot,
               ( retractall(robot(_, _, _, _)),
                 retractall(built(_, _, _)),
                 assertz(Built),
                 asserta(Robot) )).
