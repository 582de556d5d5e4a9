:- module(rooms,
          [ room/2,             % +Number, -Room
            room_map/2,         % +Room, -Map
            drive_room/4        % +Room, +Options, -Reason, -Outcome
          ]).
:- use_module(simulation).
:- use_module(library(ev3dev/drive)).
:- use_module(library(ev3dev/roadmap)).

/** <module> Rooms at random, of which the robot knows a part
*/

%!  room(+Number, -Room)
%
%   Room is room(Known, Unknown, Start, Goal): 250 by 200 cm with up to five
%   obstacles that the robot knows, and up to five that it does not know. It
%   stands free at Start, with a heading, and at Goal it could.

room(Number, room([bounds(0, 0, 250, 200)|Known], Unknown, Start, Goal)) :-
    Seed is (Number * 48271 + 11) mod 2147483647,
    draw(0, 5, Seed, Seed1, Count1),
    draw(1, 5, Seed1, Seed2, Count2),
    obstacles(Count1, Seed2, Seed3, Known),
    obstacles(Count2, Seed3, Seed4, Unknown),
    append([bounds(0, 0, 250, 200)|Known], Unknown, All),
    free_place(All, Seed4, Seed5, Start0),
    draw(0, 359, Seed5, Seed6, Heading),
    free_place(All, Seed6, _, Goal),
    Start = Start0/Heading.

draw(Low, High, Seed0, Seed, Number) :-
    Seed is (Seed0 * 48271) mod 2147483647,
    Number is Low + (Seed >> 8) mod (High - Low + 1).

obstacles(0, Seed, Seed, []) :-
    !.
obstacles(Count, Seed0, Seed, [Fact|Facts]) :-
    draw(1, 3, Seed0, Seed1, Kind),
    draw(0, 250, Seed1, Seed2, X),
    draw(0, 200, Seed2, Seed3, Y),
    draw(0, 179, Seed3, Seed4, Heading),
    draw(8, 50, Seed4, Seed5, Size),
    draw(8, 50, Seed5, Seed6, Other),
    obstacle(Kind, X, Y, Heading, Size, Other, Fact),
    Left is Count - 1,
    obstacles(Left, Seed6, Seed, Facts).

obstacle(1, X, Y, Heading, Width, Depth, box(X, Y, Width, Depth, Heading)).
obstacle(2, X, Y, _, Size, _, circle(X, Y, Radius)) :-
    Radius is Size / 3.
obstacle(3, X, Y, Heading, Size, _, wall(X, Y, X2, Y2)) :-
    X2 is X + 2 * Size * sin(Heading * pi / 180),
    Y2 is Y + 2 * Size * cos(Heading * pi / 180).

free_place(All, Seed0, Seed, Place) :-
    draw(15, 235, Seed0, Seed1, X),
    draw(15, 185, Seed1, Seed2, Y),
    (   roadmap_path(All, X-Y, X-Y, _, [margin(4)])
    ->  Place = X-Y,
        Seed = Seed2
    ;   free_place(All, Seed2, Seed, Place)
    ).

%!  room_map(+Room, -Map)
%
%   Map is all of a Room, also what the robot does not know.

room_map(room(Known, Unknown, _, _), Map) :-
    append(Known, Unknown, Map).

%!  drive_room(+Room, +Options, -Reason, -Outcome)
%
%   Drive to the goal of a Room. Outcome is outcome(Collisions, Error, Found):
%   how often the robot ran into something, how far it is from the goal, and
%   what it has found. Options are those of sim_start/2.

drive_room(Room, Options, Reason, outcome(Collisions, Error, Found)) :-
    Room = room(Known, _, (X-Y)/Heading, GoalX-GoalY),
    room_map(Room, All),
    with_sim([start(X, Y, Heading)|All],
             ( set_robot(5.6, 10.6, outB, outC),
               set_pose(X, Y, Heading),
               navigate_to(Known, GoalX-GoalY,
                           [reason(Reason), obstacles(Found)]),
               sim_pose(AtX, AtY, _),
               sim_collisions(Hits) ),
             Options),
    length(Hits, Collisions),
    Error is sqrt((AtX - GoalX)**2 + (AtY - GoalY)**2).
