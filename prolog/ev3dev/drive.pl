:- module(ev3dev_drive,
          [ go_cm/3,            % +Speed, +Distance, +Options
            turn/3,             % +Speed, +Angle, +Options
            arc_cm/3,           % +Speed, +Radius, +Angle
            arc_cm/4,           % +Speed, +Radius, +Angle, +Options
            arc/2,              % +Speed, +Radius
            arc/3,              % +Speed, +Radius, +Options
            steer/2,            % +Speed, +Direction
            steer/3,            % +Speed, +Direction, +Options
            drive_cm/2,         % +CmPerSecond, +DegreesPerSecond
            drive_cm/3,         % +CmPerSecond, +DegreesPerSecond, +Options
            go_to/1,            % +Place
            go_to/2,            % +X, +Y
            go_to/3,            % +X, +Y, +HeadingOrOptions
            go_to/4,            % +X, +Y, +Heading, +Options
            face/1,             % +Heading
            face/2,             % +Heading, +Options
            follow/1,           % +Places
            follow/2,           % +Places, +Options
            drive_wait/2        % +Options, -Reason
          ]).
:- set_prolog_flag(generate_debug_info, false).
:- use_module(private/load/compiled, []).
:- use_module(private/basics/fields, [goal_expansion/2, term_expansion/2]).
:- use_module(private/checks/checks, [evaluated/2, must_be/2]).
:- use_module(private/errors/public_clauses, [term_expansion/4]).
:- use_module(private/checks/arguments,
              [ must_be_options/3, number_option/4, number_value/2,
                number_value/3, take_options/4, timeout_option/2
              ]).
:- use_module(private/checks/places, [place/2, places/2]).
:- use_module(private/devices/drive_moves,
              [ backwards/2, move/3, move_straight/3, move_turn/3,
                must_be_move_options/1, robot_speed/2, speed_option/4
              ]).
:- reexport(odometry).
:- reexport(calibrate).
:- use_module(private/devices/robot_state, [robot_description/1]).
:- use_module(private/run/waits, [waited/1]).
:- use_module(private/native/native, [drive_wait_/3]).

/** <module> Driving: curves, odometry, going to places

A robot that was described by set_robot/4 knows where it is, and drives to
places. Load this library in addition to library(ev3dev):

```
?- use_module(library(ev3dev/drive)).
?- set_robot(5.6, 10.6, outB, outC).
?- go_to(30, 40), face(0).
?- pose(X, Y, Heading).
X = 30.0, Y = 40.0, Heading = 0.1.
```

Lengths are in centimeters, angles in degrees, both any arithmetic expression.
X goes to the right and y ahead of where the robot started; heading 0 looks
along y, clockwise is positive, and full turns count. A place is `X-Y`, or
`[X, Y]` where a program gives one. Speeds are in percent of what the motors
can, and are those of the faster wheel; also `cm_per_s(N)`, and `dps(N)`,
`rps(N)` or `rpm(N)` of the wheel.

While the robot moves, a native loop reads wheels and gyro every 20 ms, keeps
the pose, and keeps the robot on its course; Prolog may do something else
meanwhile. The loop serves all moves, also those of library(ev3dev/robot), and
ends when the motors rest.

The gyro, if one is connected, gives the heading, unless
`drive_option(use_gyro, false)`. Its drift is measured while the robot rests.
A move puts it into the mode GYRO-ANG, unless it is in GYRO-G&A; while another
mode is read, it does not count.

## Options of moves {#drive-options}

  - speed(+Percent)
    Of the faster wheel, for moves without a speed of their own. Default is
    that of drive_option/2. Negative is backwards.
  - acceleration(+CmPerSquareSecond)
    How fast the robot gains and loses speed, from 1 to 1000. Default is that
    of drive_option/2.
  - use_gyro(+Boolean)
    Whether the gyro gives the heading. Default is that of drive_option/2.
  - stop_action(+Action)
    What the motors do at the end: `hold` (default), `brake` or `coast`.
  - wait(+Boolean)
    If `false`, return as soon as the robot moves. See drive_wait/2. Moves
    without end never wait.
  - timeout(+Seconds)
    Stop the robot if it takes longer.
  - reason(-Reason)
    Do not fail if the move ends early, but report why: one of `reached`,
    `stalled`, `timeout`, `stopped`, `unplugged` and `astray`.

All moves fail if no robot is set, if a motor is not connected, and if the
move is impossible: a speed of 0 or beyond 100 percent. Nothing moves then. A
move by a distance or an angle of 0 is `reached` at once. They also fail,
unless asked for the reason, when they end early: a wheel is blocked, the time
is up, another thread stops a motor or commands something else, or the gyro
contradicts the wheels (`astray`): it is mounted upside down, a motor is
mounted backwards, left and right motor are swapped, or the wheels spin on the
spot. The robot stands then.

An interrupt, for example Ctrl-C, stops the robot first. A new move replaces
one that still runs.

@error existence_error(Kind, Port) if a motor or the gyro is unplugged under
       way
@error domain_error(Domain, Value) for a value that makes no sense
@error domain_error(drive_option, Option) if Option is not an option here
*/

%!  go_cm(+Speed, +Distance, +Options) is semidet.
%
%   Go straight on for Distance cm. The signs of speed and distance make the
%   direction. A Distance of 0 is `reached` at once.

go_cm(Speed, Distance, Options) :-
    speed(Speed, Percent),
    number_value(Distance, Way),
    move_straight(Percent, Way, Options).

%!  turn(+Speed, +Angle, +Options) is semidet.
%
%   Turn on the spot by Angle degrees. The signs of speed and angle make the
%   direction, clockwise positive. A turn by 0 is `reached` at once.

turn(Speed, Angle, Options) :-
    speed(Speed, Percent),
    number_value(Angle, Degrees),
    move_turn(Percent, Degrees, Options).

%!  arc_cm(+Speed, +Radius, +Angle) is semidet.
%!  arc_cm(+Speed, +Radius, +Angle, +Options) is semidet.
%
%   Go along an arc of a circle. Its center is on the right if the radius is
%   positive, and on the left if it is negative. The signs of speed and angle
%   make the direction, ahead or backwards. An Angle of 0 is `reached` at
%   once.

arc_cm(Speed, Radius, Angle) :-
    arc_cm(Speed, Radius, Angle, []).

arc_cm(Speed, Radius, Angle, Options) :-
    speed(Speed, Percent),
    number_value(Radius, R),
    number_value(Angle, Degrees),
    backwards(Percent * Degrees, Backwards),
    Signed is Degrees * sign(Percent),
    (   R =:= 0
    ->  move(Percent, legs([turn(Signed)], false), Options)
    ;   evaluated(abs(R * Degrees) * pi / 180, Length),
        evaluated(sign(Signed) * sign(float(R)) / abs(R), Curvature),
        move(Percent, legs([arc(Length, Curvature)], Backwards), Options)
    ).

%!  arc(+Speed, +Radius) is semidet.
%!  arc(+Speed, +Radius, +Options) is semidet.
%
%   Go along a circle until stopped. Does not wait. See arc_cm/3.

arc(Speed, Radius) :-
    arc(Speed, Radius, []).

arc(Speed, Radius, Options) :-
    speed(Speed, Percent),
    number_value(Radius, R),
    robot_description(Robot),
    Robot = robot(axle: Axle),
    Inner is (abs(R) - Axle / 2.0) / (abs(R) + Axle / 2.0),
    (   R >= 0
    ->  wheels(Percent, 1, Inner, Options)
    ;   wheels(Percent, Inner, 1, Options)
    ).

%!  steer(+Speed, +Direction) is semidet.
%!  steer(+Speed, +Direction, +Options) is semidet.
%
%   Go on until stopped, straight for Direction 0, to the right up to 100 and
%   to the left down to -100: at 50 the inner wheel stands, at 100 the robot
%   spins. Does not wait.
%
%   @error domain_error(direction, Direction)

steer(Speed, Direction) :-
    steer(Speed, Direction, []).

steer(Speed, Direction, Options) :-
    speed(Speed, Percent),
    number_value(direction, Direction, D),
    Inner is 1 - abs(D) / 50.0,
    (   D >= 0
    ->  wheels(Percent, 1, Inner, Options)
    ;   wheels(Percent, Inner, 1, Options)
    ).

wheels(Percent, Left0, Right0, Options) :-
    Left is sign(Percent) * Left0,
    Right is sign(Percent) * Right0,
    move(Percent, wheels(Left, Right), Options).

%!  drive_cm(+CmPerSecond, +DegreesPerSecond) is semidet.
%!  drive_cm(+CmPerSecond, +DegreesPerSecond, +Options) is semidet.
%
%   Go on at a speed and turn at a rate, clockwise positive, until stopped.
%   Does not wait. Called again, it changes both smoothly: a program that
%   controls the robot itself may call it many times a second. Fails if that
%   is too fast for a wheel.

drive_cm(Speed, Rate) :-
    drive_cm(Speed, Rate, []).

drive_cm(Speed, Rate, Options) :-
    number_value(Speed, CmPerSecond),
    number_value(Rate, DegreesPerSecond),
    move(100, cruise(CmPerSecond, DegreesPerSecond), Options).

%!  go_to(+Place) is semidet.
%!  go_to(+X, +Y) is semidet.
%!  go_to(+X, +Y, +HeadingOrOptions) is semidet.
%!  go_to(+X, +Y, +Heading, +Options) is semidet.
%
%   Turn towards a place, go there, and turn to a heading if one is given.
%   With a negative speed it drives there backwards.
%
%   @error domain_error(place, Place)

go_to(Place) :-
    place(Place, X-Y),
    go_to(X, Y).

go_to(X, Y) :-
    go_to(X, Y, []).

go_to(X, Y, Options) :-
    is_list(Options),
    !,
    place_legs(X, Y, none, Legs),
    travel(Legs, Options).
go_to(X, Y, Heading) :-
    go_to(X, Y, Heading, []).

go_to(X, Y, Heading, Options) :-
    number_value(Heading, Degrees),
    place_legs(X, Y, Degrees, Legs),
    travel(Legs, Options).

place_legs(X, Y, Heading, Legs) :-
    number_value(X, X1),
    number_value(Y, Y1),
    (   Heading == none
    ->  Legs = [towards(X1, Y1), reach(X1, Y1)]
    ;   % Where the axle is when the robot is there with that heading.
        (   robot_description(Robot)
        ->  Robot = robot(offset: Offset)
        ;   Offset = 0
        ),
        X2 is X1 + Offset * sin(Heading * pi / 180),
        Y2 is Y1 + Offset * cos(Heading * pi / 180),
        Legs = [towards(X2, Y2), to(X2, Y2), face(Heading)]
    ).

travel(Legs, Options) :-
    speed_option(Options, Percent),
    backwards(Percent, Backwards),
    move(Percent, legs(Legs, Backwards), Options).

%   The speed of a move without a speed of its own.
speed_option(Options, Percent) :-
    must_be(list, Options),
    drive_option(speed, Default),
    speed_option(Options, finite_number, Default, Percent).

speed(Speed, Percent) :-
    robot_speed(Speed, Value),
    number_value(Value, Percent).

%!  face(+Heading) is semidet.
%!  face(+Heading, +Options) is semidet.
%
%   Turn on the spot to a heading, the shorter way round.

face(Heading) :-
    face(Heading, []).

face(Heading, Options) :-
    number_value(Heading, Degrees),
    speed_option(Options, Percent),
    move(Percent, legs([face(Degrees)], false), Options).

%!  follow(+Places) is semidet.
%!  follow(+Places, +Options) is semidet.
%
%   Go through all of a list of places on straight lines, and turn on the spot
%   at each. No places are `reached` at once. Another option:
%
%     - radius(+Cm)
%       Round the corners with that radius, or with less where the lines are
%       too short for it, and do not stop there.
%
%   @error domain_error(place, Place)

follow(Places) :-
    follow(Places, []).

follow(Places0, Options) :-
    must_be(list, Places0),
    take_options([radius], Options, Own, Rest),
    must_be_move_options(Rest),
    places(Places0, Places),
    number_option(radius(R), nonnegative_number, Own, 0),
    (   Places == []
    ->  % This, too, takes the place of a move under way.
        Leg = turn(0)
    ;   Leg = through(Places, R)
    ),
    travel([Leg], Rest).

%!  drive_wait(+Options, -Reason) is semidet.
%
%   Wait until a move ends that was started with `wait(false)`, and report why
%   it did, as the option `reason(Reason)` does. Stops nothing. At once
%   `reached` if there is none. Options:
%
%     - timeout(+Seconds)
%       Wait at most for this time.

drive_wait(Options, Reason) :-
    must_be_options(drive_option, [timeout], Options),
    timeout_option(Options, Timeout),
    robot_description(Robot),
    catch(drive_waited(Robot, Timeout, Ended),
          error(existence_error(_, _), _),
          Ended = unplugged),
    Reason = Ended.

drive_waited(Robot, Timeout, Ended) :-
    drive_wait_(Robot, Timeout, Ended),
    waited(Ended),
    !.
