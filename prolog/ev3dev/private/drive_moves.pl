:- module(ev3dev_drive_moves,
          [ move/3,                     % +Percent, +Course, +Options
            drive_wait/2,               % +Options, -Reason
            must_be_move_options/1,     % +Options
            speed_option/2,             % +Options, -Percent
            backwards/2,                % +Direction, -Backwards
            not_nothing/1               % +Number
          ]).
:- use_module(errors, [evaluated/2, must_be/2, term_expansion/2]).
:- use_module(explain).
:- use_module(arguments,
              [ must_be_options/3, number_option/4, option/2, option/3,
                timeout_option/2
              ]).
:- use_module('../odometry', [drive_option/2]).
:- use_module(robot_state, [robot/4, robot_description/1]).
:- use_module(native, [drive_/4, drive_wait_/3]).

/** <module> How a move is carried out

What all moves of library(ev3dev/drive) have in common.
*/

%!  move(+Percent, +Course, +Options) is semidet.
%
%   Make a move with the options of library(ev3dev/drive). Percent tells the
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
%   @error as library(ev3dev/drive) tells

move(Percent, Course, Options) :-
    move_options(Percent, Course, Options, Native),
    option(reason(Reason), Options, _),
    robot_description(Robot),
    (   catch(drive_(Robot, Course, Native, Ended), E, true)
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
    ;   explain("the robot cannot move by ~p at ~w %",
                [Course, Percent]),
        fail
    ).

move_options(Percent, Course, Options,
             options(Speed, Acceleration, Action, UseGyro, Wait, Timeout)) :-
    must_be_move_options(Options),
    evaluated(abs(Percent), Speed),
    drive_option(acceleration, Default),
    number_option(acceleration(Acceleration), positive_number, Options,
                  Default),
    option(stop_action(Action), Options, hold),
    drive_option(use_gyro, Default1),
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
    print_message(warning, ev3dev(stalled([Left, Right]))),
    fail.
ended(Reason, Course) :-
    explain("~p ended early: ~w", [Course, Reason]),
    fail.

%!  drive_wait(+Options, -Reason) is semidet.
%
%   Wait until the move under way ends, as one that was started with
%   `wait(false)`, and tell why it did, as the option `reason(Reason)` does.
%   Stops nothing. At once `reached` if there is none. Options:
%
%     - timeout(+Seconds)
%       Wait for so long at most.

drive_wait(Options, Reason) :-
    must_be_options(drive_option, [timeout], Options),
    timeout_option(Options, Timeout),
    robot_description(Robot),
    catch(drive_wait_(Robot, Timeout, Reason),
          error(existence_error(_, _), _),
          Reason = unplugged).

%!  must_be_move_options(+Options) is det.
%
%   @error domain_error(drive_option, Option) for an option that moves do not
%          have

must_be_move_options(Options) :-
    must_be_options(drive_option,
                    [ speed, acceleration, use_gyro, stop_action, wait,
                      timeout, reason ],
                    Options).

%!  speed_option(+Options, -Percent) is det.
%
%   The speed of a move that is not told one.

speed_option(Options, Percent) :-
    must_be(list, Options),
    drive_option(speed, Default),
    number_option(speed(Percent), finite_number, Options, Default).

%!  backwards(+Direction, -Backwards) is det.
%
%   Backwards is `true` if Direction is negative, else `false`.

backwards(Direction, Backwards) :-
    (   Direction < 0
    ->  Backwards = true
    ;   Backwards = false
    ).

%!  not_nothing(+Number) is semidet.
%
%   Fails, and says so, if a distance or an angle is 0.

not_nothing(Number) :-
    (   Number =\= 0
    ->  true
    ;   explain("a distance or an angle of 0 moves nothing", []),
        fail
    ).
