:- module(ev3dev_drive_to,
          [ go_to/2,            % +X, +Y
            go_to/3,            % +X, +Y, +HeadingOrOptions
            go_to/4,            % +X, +Y, +Heading, +Options
            face/1,             % +Heading
            face/2,             % +Heading, +Options
            follow/1,           % +Points
            follow/2            % +Points, +Options
          ]).
:- use_module(library(error),
              [ domain_error/2, instantiation_error/1, must_be/2,
                type_error/2
              ]).
:- use_module(library(option), [option/3]).
:- use_module(drive_moves,
              [backwards/2, move/3, must_be_move_options/1, speed_option/2]).
:- use_module(odometry, [number_value/2, robot_driven/1]).
:- use_module(options, [take_options/4]).

/** <module> Driving to places

The part of library(ev3dev/drive) that goes to places and headings. What it
says of moves and their options holds here.
*/

%!  go_to(+X, +Y) is semidet.
%!  go_to(+X, +Y, +HeadingOrOptions) is semidet.
%!  go_to(+X, +Y, +Heading, +Options) is semidet.
%
%   Turn towards a place, go there, and turn to a heading if one is given.
%   With a negative speed, back into it.

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
        (   robot_driven(Robot)
        ->  arg(8, Robot, Offset)
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

%!  follow(+Points) is semidet.
%!  follow(+Points, +Options) is semidet.
%
%   Go through all of a list of points, each `[X, Y]`, `X-Y` or `point(X, Y)`,
%   on straight lines, and turn on the spot at each. No points are `reached`
%   at once. Another option:
%
%     - radius(+Cm)
%       Round the corners with that radius, or with less where the lines are
%       too short for it, and do not stop there.

follow(Points) :-
    follow(Points, []).

follow(Points, Options) :-
    must_be(list, Points),
    take_options([radius], Options, Own, Rest),
    must_be_move_options(Rest),
    points(Points, Places),
    option(radius(Radius), Own, 0),
    number_value(Radius, R),
    (   R >= 0
    ->  true
    ;   domain_error(radius, R)
    ),
    (   Places == []
    ->  % This, too, takes the place of a move under way.
        Leg = turn(0)
    ;   Leg = through(Places, R)
    ),
    travel([Leg], Rest).

points([], []).
points([Point|Points], [[X, Y]|Places]) :-
    (   var(Point)
    ->  instantiation_error(Point)
    ;   point(Point, X0, Y0)
    ->  number_value(X0, X),
        number_value(Y0, Y)
    ;   type_error(point, Point)
    ),
    points(Points, Places).

point([X, Y], X, Y).
point(X-Y, X, Y).
point(point(X, Y), X, Y).
