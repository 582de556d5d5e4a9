% Two robots map a room: each looks around, drives on, and looks around again.
% The scout sends what it sees to the other one, which draws one map.
%
%   ?- start.
%
% A cell of the map is 10 cm wide, and `#` is where something was seen.

:- use_module(library(ev3dev)).
:- use_module(library(ev3dev/bricks)).
:- use_module(library(ev3dev/drive)).
:- use_module(library(ev3dev/odometry)).
:- use_module(library(ev3dev/sim)).

:- dynamic seen/2.

world([ bounds(0, 0, 300, 200), box(90, 150, 30, 20), circle(150, 60, 12),
        box(220, 110, 20, 50, 30),
        start(mapper, 40, 40, 0), start(scout, 260, 40, 0) ]).

start :-
    start([]).

%   Options are those of sim_start/2.

start(Options) :-
    world(World),
    retractall(seen(_, _)),
    setup_call_cleanup(
        sim_start(World, [ clock(virtual),
                           robots([mapper-default, scout-default])
                         | Options ]),
        bricks_do(explore),
        forall(member(Name, [mapper, scout]), brick_close(Name))),
    draw.

explore :-
    set_robot(5.6, 10.6, outB, outC),
    use_brick(Name),
    sim_pose(X, Y, Heading),
    set_pose(X, Y, Heading),
    forall(between(1, 3, _), ( look_around(Name), go_cm(30, 40) )),
    (   Name == scout
    ->  robot_send(mapper, over)
    ;   take_notes
    ).

%   The sensor is 7 cm ahead of the axle. Far echoes say little.

look_around(Name) :-
    forall(between(1, 24, _),
           ( turn(25, 15),
             us_dist_cm(in1, Distance),
             (   Distance < 100
             ->  pose(X0, Y0, Heading),
                 Way is Distance+7,
                 X is X0 + Way*sin(Heading*pi/180),
                 Y is Y0 + Way*cos(Heading*pi/180),
                 note(Name, X, Y)
             ;   true
             ) )).

note(mapper, X, Y) :-
    assertz(seen(X, Y)).
note(scout, X, Y) :-
    robot_send(mapper, seen(X, Y)).

take_notes :-
    robot_receive(scout, Message, []),
    (   Message = seen(X, Y)
    ->  note(mapper, X, Y),
        take_notes
    ;   true
    ).

draw :-
    findall(Column-Row,
            ( seen(X, Y), Column is floor(X/10), Row is floor(Y/10) ),
            Cells),
    forall(between(0, 19, Down),
           ( Row is 19-Down,
             forall(between(0, 29, Column),
                    (   memberchk(Column-Row, Cells)
                    ->  write(#)
                    ;   write('.')
                    )),
             nl )).
