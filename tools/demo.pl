% Lets an example drive a make-believe robot: a plain tree whose files a thread
% animates. The wheels turn as they are told; a wall stands before the robot
% and is behind it once it has turned.

:- use_module('../tests/tree').
:- use_module(library(ev3dev)).

:- dynamic pose/3.                      % X, Y in cm, Heading in degrees

wheel_diameter(5.6).
axle_length(10.6).
period(0.02).

%!  demo(+Example, +Seconds)
%
%   Run the example's start/0, or the vehicle of braitenberg.pl that fears
%   light, for some seconds.

demo(Example, Seconds) :-
    atomic_list_concat(['examples/', Example], File),
    load_files(user:File, []),
    with_tree(( retractall(pose(_, _, _)),
                assertz(pose(0, 0, 0)),
                thread_create(animate, Id),
                call_cleanup(drive(Example, Seconds), stop_animation(Id)) )),
    format("The robot has driven.~n"),
    halt(0).

drive(Example, Seconds) :-
    program(Example, Goal),
    format("~w: ~w for ~w s~n", [Example, Goal, Seconds]),
    catch(call_with_time_limit(Seconds, ignore(user:Goal)),
          time_limit_exceeded,
          stop_all_motors).

program(braitenberg, vehicle(fear)) :-
    !.
program(_, start).

stop_animation(Id) :-
    thread_send_message(Id, stop),
    thread_join(Id, _).

                /*******************************
                *         MAKE-BELIEVE         *
                *******************************/

animate :-
    animate(0).

animate(Ticks) :-
    period(Period),
    thread_self(Me),
    (   thread_get_message(Me, stop, [timeout(Period)])
    ->  true
    ;   wheel(outB, Left),
        wheel(outC, Right),
        roll(Left, Right),
        look,
        (   Ticks mod 50 =:= 0
        ->  tell
        ;   true
        ),
        Next is Ticks + 1,
        animate(Next)
    ).

%   Turns a wheel for one period; Degrees is by how much.
wheel(Port, Degrees) :-
    number_in(Port, position, Position0),
    number_in(Port, speed_sp, Speed),
    number_in(Port, position_sp, Distance),
    get_attribute(Port, command, Command),
    period(Period),
    step(Command, Port, Speed * Period, Position0, Distance, Degrees),
    Position is Position0 + Degrees,
    put_attribute(Port, position, Position).

:- dynamic target/2.                    % Port, Position

step('run-forever', _, Step, _, _, Degrees) :-
    !,
    Degrees is round(Step).
step('run-to-rel-pos', Port, Step, Position, Distance, Degrees) :-
    !,
    (   target(Port, Target)
    ->  true
    ;   Target is Position + Distance,
        assertz(target(Port, Target)),
        put_attribute(Port, state, running)
    ),
    Left is Target - Position,
    Degrees is sign(Left) * min(abs(Left), round(abs(Step))),
    (   Degrees =:= Left
    ->  retractall(target(Port, _)),
        put_attribute(Port, command, ''),
        put_attribute(Port, state, holding)
    ;   true
    ).
step(_, Port, _, _, _, 0) :-
    retractall(target(Port, _)).

number_in(Port, Attribute, Number) :-
    get_attribute(Port, Attribute, Text),
    atom_number(Text, Number).

roll(Left, Right) :-
    wheel_diameter(Wheel),
    axle_length(Axle),
    retract(pose(X0, Y0, Heading0)),
    Heading is Heading0 + (Left - Right) / 2 * Wheel / Axle,
    Way is (Left + Right) / 2 * pi * Wheel / 360,
    X is X0 + Way * sin(Heading * pi / 180),
    Y is Y0 + Way * cos(Heading * pi / 180),
    assertz(pose(X, Y, Heading)).

%   A square room, 2 m wide, with the robot's start in its middle.
look :-
    pose(X, Y, Heading),
    Sin is sin(Heading * pi / 180),
    Cos is cos(Heading * pi / 180),
    to_wall(X, Sin, AlongX),
    to_wall(Y, Cos, AlongY),
    Distance is min(2550, round(10 * min(AlongX, AlongY))),
    put_attribute(in1, value0, Distance),
    Angle is round(Heading),
    put_attribute(in4, value0, Angle),
    Light is max(0, min(100, round(50 + X / 2))),
    put_attribute(in2, value0, Light),
    put_attribute(in3, value0, Light).

to_wall(Coordinate, Part, Distance) :-
    (   abs(Part) < 0.001
    ->  Distance = 1000
    ;   Distance is max(0, (100 - sign(Part) * Coordinate) / abs(Part))
    ).

tell :-
    pose(X, Y, Heading),
    number_in(in1, value0, Distance),
    Cm is Distance / 10,
    format("x ~1f cm, y ~1f cm, heading ~0f degrees; ~1f cm to the wall~n",
           [X, Y, Heading, Cm]).
