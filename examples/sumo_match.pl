% Two sumo robots with the same rules, in one ring.
%
%   ?- match(Winner).
%
% A robot loses when its middle leaves the ring. The robot in the east is
% heavier, and its motors are stronger.

:- use_module(library(ev3dev)).
:- use_module(library(ev3dev/bricks)).
:- use_module(library(ev3dev/rules)).
:- use_module(library(ev3dev/sim)).

% Staying in the ring comes first. Then it pushes what it sees.
edge_left  :: white(in2) ~> go_cm(50, -15), turn(50, 110).
edge_right :: white(in3) ~> go_cm(50, -15), turn(50, -110).
push       :: us_dist_cm(_, D), D < 120 ~> go(100).
find       :: true ~> turn(40).

white(Port) :-
    col_reflect(Port, Light),
    Light > 40.

start :-
    match(Winner),
    format("~w wins~n", [Winner]).

match(Winner) :-
    match(Winner, []).

%   Options are those of sim_start/2. After two minutes nobody wins.

match(Winner, Options) :-
    sumo_robot(1.6, 15, Heavy),
    sumo_robot(0.8, 0, Light),
    setup_call_cleanup(
        sim_start(dohyo, [ clock(virtual), robots([east-Heavy, west-Light])
                         | Options ]),
        ( bricks_do([east, west], fight),
          (   is_out(east)
          ->  Winner = west
          ;   is_out(west)
          ->  Winner = east
          ;   Winner = nobody
          ) ),
        ( brick_close(east), brick_close(west) )).

fight :-
    set_robot(5.6, 10.6, outB, outC),
    behave([edge_left, edge_right, push, find],
           [until(( is_out(east) ; is_out(west) )), timeout(120)]).

is_out(Name) :-
    with_brick(Name, sim_pose(X, Y, _)),
    X*X + Y*Y > 77*77.

%   A mass in kg, and how much stronger than others its motors are, in
%   percent.

sumo_robot(Mass, Stronger,
           [ left_wheel(outB, 5.6), right_wheel(outC, 5.6), axle(10.6),
             hull(circle(8)), mass(Mass),
             motor(outB, 'lego-ev3-l-motor'),
             motor(outC, 'lego-ev3-l-motor'),
             sensor(in1, 'lego-ev3-us', 0, 6, 0),
             sensor(in2, 'lego-ev3-color', -6, 7, 0),
             sensor(in3, 'lego-ev3-color', 6, 7, 0),
             noise(outB, 0, Stronger), noise(outC, 0, Stronger) ]).
