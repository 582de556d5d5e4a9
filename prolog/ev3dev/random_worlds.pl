:- module(ev3dev_random_worlds,
          [ random_room/3,              % +Seed, +Options, -World
            random_grid/3,              % +Seed, +Options, -World
            random_maze/3,              % +Seed, +Options, -World
            random_track/3              % +Seed, +Options, -World
          ]).
:- set_prolog_flag(generate_debug_info, false).
:- use_module(private/load/compiled, []).
:- use_module(private/checks/arguments,
              [ must_be_options/3, number_option/4, option/3 ]).
:- use_module(private/checks/checks, [must_be/2]).
:- use_module(private/errors/errors,
              [domain_error/2, in_own_name/1, throw_error/3]).
:- use_module(private/errors/public_clauses, [term_expansion/4]).
:- use_module(roadmap, [roadmap_path/5]).
:- use_module(library(lists),
              [ append/3, max_list/2, member/2, min_list/2,
                nth0/3, reverse/2, subtract/3, sum_list/2 ]).

/** <module> Random worlds

For a program that should work in any room, and not only in one that its
writer knows. Each predicate answers a list of facts for sim_start/2:

```
?- random_room(7, [boxes(3-5)], World), sim_start(World).
```

The same Seed, an integer, gives the same world on each machine and in each
Prolog. Each world can be solved: a room has ways between the places that are
to be free, all free cells of a grid hang together, a maze has a way to its
exit, and a track has no bend too narrow for a robot.

A Number is an integer, or `From-To`: then one of these is drawn.

Rooms and grids may have things that robots push, see docs/worlds.md: cubes of
5 cm and 50 g, with the names `thing1`, `thing2` and so on, and the colors
red, yellow, green and blue in turn. A robot can drive to each of them without
moving another.
*/

%!  random_room(+Seed, +Options, -World) is det.
%
%   A room with boxes and pillars. Options:
%
%     - size(Width-Depth)
%       In cm. Default is 300-250.
%     - boxes(Number)
%       Default is 3-5.
%     - pillars(Number)
%       Default is 0-2.
%     - things(Number)
%       Default is 0. A robot can push a thing from each side.
%     - start(X, Y, Heading)
%       Default is start(40, 40, 40).
%     - free(X, Y, Radius)
%       A circle in which nothing stands, and which a robot can reach from the
%       start. There may be several. That around the start has a radius of 25
%       cm in any case.
%
%   @error resource_error(room) if so much was not placed in a thousand rooms
%   @error domain_error(random_room_option, Option)

random_room(Seed, Options, World) :-
    must_be(list, Options),
    (   memberchk(start(X0, Y0, Heading), Options)
    ->  true
    ;   [X0, Y0, Heading] = [40, 40, 40]
    ),
    findall(free(X, Y, Radius), member(free(X, Y, Radius), Options), Frees),
    subtract(Options, [start(_, _, _)|Frees], Others),
    must_be_options(random_room_option,
                    [size, boxes, pillars, things, start, free], Others),
    option(size(Width-Depth), Others, 300-250),
    must_be(positive_integer, Width),
    must_be(positive_integer, Depth),
    counts([boxes(3-5), pillars(0-2), things(0)], Others,
           [Boxes, Pillars, Cubes]),
    chance(Seed, Chance),
    between(1, 1000, _),
    chosen(Boxes, Chance, BoxCount),
    chosen(Pillars, Chance, PillarCount),
    placed(BoxCount, box, Chance, Width-Depth, [free(X0, Y0, 25)|Frees], [],
           Taken),
    placed(PillarCount, pillar, Chance, Width-Depth,
           [free(X0, Y0, 25)|Frees], Taken, Standing),
    chosen_things(Cubes, Chance, CubeCount),
    placed(CubeCount, cube, Chance, Width-Depth,
           [free(X0, Y0, 25)|Frees], Standing, All),
    findall(Fact, member(Fact-_, All), Facts0),
    reverse(Facts0, Facts1),
    named_things(Facts1, 1, Facts),
    World = [ bounds(0, 0, Width, Depth), start(X0, Y0, Heading) | Facts ],
    \+ ( member(free(X, Y, _), Frees),
         \+ roadmap_path(World, X0-Y0, X-Y, _, []) ),
    \+ ( member(thing(X, Y, _), Facts1),
         \+ ( beside([X, Y], _, DX-DY),
              X1 is X+16*DX,
              Y1 is Y+16*DY,
              roadmap_path(World, X0-Y0, X1-Y1, _, []) ) ),
    !.
random_room(_, _, _) :-
    throw_error(resource_error(room), _,
                'it is too full: less boxes or things, or less of it free').

%   Each has room around it for a robot: 28 cm. A place that does not fit is
%   drawn again, two hundred times.

placed(0, _Kind, _Chance, _Size, _Frees, Things, Things) :-
    !.
placed(Count, Kind, Chance, Size, Frees, Things0, Things) :-
    between(1, 200, _),
    thing(Kind, Chance, Size, Fact, circle(X, Y, Radius)),
    \+ ( member(free(FreeX, FreeY, FreeRadius), Frees),
         nearer(X-Y, FreeX-FreeY, Radius+FreeRadius) ),
    \+ ( member(_-circle(OtherX, OtherY, OtherRadius), Things0),
         nearer(X-Y, OtherX-OtherY, Radius+OtherRadius+28) ),
    !,
    Left is Count-1,
    placed(Left, Kind, Chance, Size, Frees,
           [Fact-circle(X, Y, Radius)|Things0], Things).

thing(box, Chance, Size, box(X, Y, Width, Depth, Heading),
      circle(X, Y, Radius)) :-
    uniform(Chance, 15, 45, Width),
    uniform(Chance, 15, 45, Depth),
    Radius is sqrt(Width*Width + Depth*Depth)/2,
    middle(Chance, Size, Radius, X-Y),
    uniform(Chance, -90, 90, Heading).
thing(pillar, Chance, Size, circle(X, Y, Radius), circle(X, Y, Radius)) :-
    uniform(Chance, 5, 12, Radius),
    middle(Chance, Size, Radius, X-Y).

thing(cube, Chance, Size, thing(X, Y, Heading), circle(X, Y, Radius)) :-
    Radius = 3.6,
    middle(Chance, Size, Radius, X-Y),
    uniform(Chance, -45, 45, Heading).

%   thing(X, Y, Heading) becomes a fact of the world.

named_things([], _, []).
named_things([thing(X, Y, Heading)|Facts], Number, [Fact|Named]) :-
    !,
    Index is (Number-1) mod 4,
    nth0(Index, [red, yellow, green, blue], Color),
    atom_concat(thing, Number, Name),
    Fact = box(X, Y, 5, 5, Heading, [mass(0.05), color(Color), name(Name)]),
    Next is Number+1,
    named_things(Facts, Next, Named).
named_things([Fact|Facts], Number, [Fact|Named]) :-
    named_things(Facts, Number, Named).

middle(Chance, Width-Depth, Radius, X-Y) :-
    uniform(Chance, Radius+28, Width-Radius-28, X),
    uniform(Chance, Radius+28, Depth-Radius-28, Y).

nearer(X-Y, X1-Y1, Distance) :-
    (X-X1)**2 + (Y-Y1)**2 < Distance**2.

%!  random_grid(+Seed, +Options, -World) is det.
%
%   Cells for library(ev3dev/grid), with boxes in some of them. The middle of
%   the cell [X, Y] is at 20*X, 20*Y if cells are 20 cm wide; the robot starts
%   in [0, 0] and looks along y. Options:
%
%     - size(Columns-Rows)
%       Default is 8-8.
%     - boxes(Number)
%       Default is 8-12.
%     - things(Number)
%       Default is 0. Each stands in the middle of a cell of its own.
%     - cell(Cm)
%       Default is 20.
%     - free(Cells)
%       Cells, each [X, Y], in which there is no box and no thing. The robot's
%       is free.
%
%   @error resource_error(grid) if that many boxes and things leave no way
%          between all other cells
%   @error domain_error(random_grid_option, Option)

random_grid(Seed, Options, World) :-
    must_be_options(random_grid_option, [size, boxes, things, cell, free],
                    Options),
    size(Options, 8-8, Columns, Rows),
    counts([boxes(8-12), things(0)], Options, [Boxes, Cubes]),
    number_option(cell(Cm), positive_number, Options, 20),
    option(free(Free), Options, []),
    chance(Seed, Chance),
    cells(Columns, Rows, Cells),
    subtract(Cells, [[0, 0]|Free], Places),
    between(1, 1000, _),
    chosen(Boxes, Chance, Count),
    shuffled(Places, Chance, Shuffled),
    length(Boxed, Count),
    append(Boxed, Rest, Shuffled),
    chosen_things(Cubes, Chance, CubeCount),
    length(Cubed, CubeCount),
    append(Cubed, _, Rest),
    subtract(Cells, Boxed, Unboxed),
    subtract(Unboxed, Cubed, Others),
    hang_together([[0, 0]], Others),
    \+ ( member(Cell, Cubed),
         \+ ( beside(Cell, Beside, _), memberchk(Beside, Others) ) ),
    !,
    Right is Cm*Columns - Cm/2,
    Top is Cm*Rows - Cm/2,
    Low is -Cm/2,
    Side is 0.7*Cm,
    msort(Boxed, Sorted),
    findall(box(X, Y, Side, Side),
            ( member([Column, Row], Sorted),
              X is Cm*Column,
              Y is Cm*Row ),
            Facts0),
    findall(thing(X, Y, 0),
            ( member([Column, Row], Cubed),
              X is Cm*Column,
              Y is Cm*Row ),
            Things0),
    named_things(Things0, 1, Things),
    append(Facts0, Things, Facts),
    World = [bounds(Low, Low, Right, Top), start(0, 0, 0)|Facts].
random_grid(_, _, _) :-
    throw_error(resource_error(grid), _,
                'it is too full: less boxes, or less things').

cells(Columns, Rows, Cells) :-
    findall([X, Y],
            ( Right is Columns-1,
              Top is Rows-1,
              between(0, Right, X),
              between(0, Top, Y) ),
            Cells).

%   Whether all cells of the second list can be reached from the first.

hang_together([], []).
hang_together([Cell|Cells], Others0) :-
    subtract(Others0, [Cell|Cells], Others),
    findall(Next, ( beside(Cell, Next, _), memberchk(Next, Others) ), Nexts),
    append(Cells, Nexts, Cells1),
    hang_together(Cells1, Others).

beside([X, Y], [X1, Y1], DX-DY) :-
    member(DX-DY, [0-1, 1-0, 0-(-1), -1-0]),
    X1 is X+DX,
    Y1 is Y+DY.

%!  random_maze(+Seed, +Options, -World) is det.
%
%   A maze with one way between any two of its rooms. The robot starts in the
%   lower left corner; the floor of the exit, in the upper right one, is red.
%   Options:
%
%     - size(Columns-Rows)
%       Rooms. Default is 5-5.
%     - cell(Cm)
%       The width of corridors. Default is 30.
%
%   @error domain_error(random_maze_option, Option)

random_maze(Seed, Options, [map(Cm, Rows)]) :-
    must_be_options(random_maze_option, [size, cell], Options),
    size(Options, 5-5, Columns, Lines),
    number_option(cell(Cm), positive_number, Options, 30),
    chance(Seed, Chance),
    carved([[0, 0]], Columns-Lines, Chance, [[0, 0]], [], Doors),
    Right is 2*Columns,
    Top is 2*Lines,
    findall(Row,
            ( between(0, Top, Down),
              Y is Top-Down,
              findall(Char,
                      ( between(0, Right, X),
                        drawn(X, Y, Right, Top, Doors, Char) ),
                      Chars),
              atom_chars(Row, Chars) ),
            Rows).

%   Depth first, from the room at the end of the way so far.

carved([], _, _, _, Doors, Doors).
carved([Room|Way], Size, Chance, Seen, Doors0, Doors) :-
    Size = Columns-Lines,
    findall(Next-Step,
            ( beside(Room, Next, Step),
              Next = [X, Y],
              X >= 0, X < Columns,
              Y >= 0, Y < Lines,
              \+ memberchk(Next, Seen) ),
            Nexts),
    (   Nexts == []
    ->  carved(Way, Size, Chance, Seen, Doors0, Doors)
    ;   one_of(Nexts, Chance, Next-(DX-DY)),
        Room = [X0, Y0],
        DoorX is 2*X0+1+DX,
        DoorY is 2*Y0+1+DY,
        carved([Next, Room|Way], Size, Chance, [Next|Seen],
               [DoorX-DoorY|Doors0], Doors)
    ).

drawn(1, 1, _, _, _, ^) :-
    !.
drawn(X, Y, Right, Top, _, r) :-
    X =:= Right-1,
    Y =:= Top-1,
    !.
drawn(X, Y, _, _, Doors, Char) :-
    (   ( X mod 2 =:= 1, Y mod 2 =:= 1
        ; memberchk(X-Y, Doors) )
    ->  Char = '.'
    ;   Char = #
    ).

%!  random_track(+Seed, +Options, -World) is det.
%
%   A closed black line, 2 cm wide, on a white floor. The robot starts on it,
%   with the line between its color sensors. Options:
%
%     - radius(Cm)
%       How far it is from its middle, about. Default is 80.
%     - wave(Share)
%       How far it departs from a circle, as a share of the radius. Default is
%       0.2.
%
%   No bend has a radius below 20 cm.
%
%   @error resource_error(track) if a track like that has narrower bends
%   @error domain_error(random_track_option, Option)

random_track(Seed, Options, World) :-
    must_be_options(random_track_option, [radius, wave], Options),
    number_option(radius(Radius), positive_number, Options, 80),
    number_option(wave(Wave), nonnegative_number, Options, 0.2),
    chance(Seed, Chance),
    between(1, 1000, _),
    findall(wave(N, Share, Phase),
            ( member(N, [2, 3, 4]),
              uniform(Chance, -Wave/N, Wave/N, 1000, Share),
              uniform(Chance, 0, 360, Phase) ),
            Waves),
    findall(X-Y,
            ( between(0, 95, Step),
              track_point(Step, Radius, Waves, X-Y) ),
            Points),
    \+ narrow(Points),
    !,
    Points = [First, Second|_],
    append(Points, [First], Closed),
    First = StartX-StartY,
    Second = NextX-NextY,
    Heading0 is atan2(NextX-StartX, NextY-StartY)*180/pi,
    rounded(Heading0, 10, Heading),
    findall(X, member(X-_, Points), Xs),
    findall(Y, member(_-Y, Points), Ys),
    min_list(Xs, Left0), max_list(Xs, Right0),
    min_list(Ys, Low0), max_list(Ys, High0),
    Left is floor(Left0)-30, Right is ceiling(Right0)+30,
    Low is floor(Low0)-30, High is ceiling(High0)+30,
    World = [ bounds(Left, Low, Right, High),
              start(StartX, StartY, Heading),
              line(black, 2, Closed) ].

random_track(_, _, _) :-
    throw_error(resource_error(track), _,
                'its bends are too narrow: more radius, or less of a wave').

track_point(Step, Radius, Waves, X-Y) :-
    Angle is Step*2*pi/96,
    findall(Part,
            ( member(wave(N, Share, Phase), Waves),
              Part is Share*cos(N*Angle + Phase*pi/180) ),
            Parts),
    sum_list(Parts, Sum),
    Factor is 1+Sum,
    X0 is Radius*Factor*cos(Angle),
    Y0 is Radius*Factor*sin(Angle),
    rounded(X0, 10, X),
    rounded(Y0, 10, Y).

%   The circle through a point and those six before and behind it, which are
%   far enough that rounding does not matter.

narrow(Points) :-
    append(Points, Points, Round),
    append(_, [A, _, _, B, _, _, C|_], Round),
    circle_radius(A, B, C, Radius),
    Radius < 20.

circle_radius(AX-AY, BX-BY, CX-CY, Radius) :-
    Area is abs((BX-AX)*(CY-AY) - (CX-AX)*(BY-AY))/2,
    Area > 0,
    Radius is sqrt((BX-AX)**2 + (BY-AY)**2)
              * sqrt((CX-BX)**2 + (CY-BY)**2)
              * sqrt((AX-CX)**2 + (AY-CY)**2) / (4*Area).

% ---------------- CHANCE

%   Prolog's own generator draws other numbers in another version. This is the
%   one of Lehmer, Park and Miller, as minstd_rand of C++.

chance(Seed, chance(State)) :-
    must_be(integer, Seed),
    State0 is (Seed*2654435761 + 1013904223) mod 2147483647,
    State is max(1, State0).

next(Chance, Number) :-
    arg(1, Chance, State0),
    Number is State0*48271 mod 2147483647,
    nb_setarg(1, Chance, Number).

%   One of From, From+1, ... To.
whole(Chance, From, To, Number) :-
    next(Chance, Next),
    Number is From + Next mod (To-From+1).

%   In steps of a tenth, or of another part of one.
uniform(Chance, From, To, Number) :-
    uniform(Chance, From, To, 10, Number).

uniform(Chance, From, To, Steps, Number) :-
    next(Chance, Next),
    Exact is From + (To-From)*Next/2147483647.0,
    rounded(Exact, Steps, Number).

rounded(Exact, Steps, Number) :-
    Number is round(Exact*Steps)/float(Steps).

one_of(List, Chance, Member) :-
    length(List, Length),
    Last is Length-1,
    whole(Chance, 0, Last, Index),
    nth0(Index, List, Member).

shuffled([], _, []) :-
    !.
shuffled(List, Chance, [Member|Shuffled]) :-
    one_of(List, Chance, Member),
    subtract(List, [Member], Others),
    shuffled(Others, Chance, Shuffled).

chosen(From-To, Chance, Number) :-
    whole(Chance, From, To, Number).

%   Nothing is drawn if there are none, so that a world without things stays
%   as it was before worlds had things.

chosen_things(0-0, _, 0) :-
    !.
chosen_things(Range, Chance, Number) :-
    chosen(Range, Chance, Number).

% ---------------- ARGUMENTS

counts([], _, []).
counts([Default|Defaults], Options, [From-To|Counts]) :-
    functor(Default, Name, 1),
    arg(1, Default, Else),
    Option =.. [Name, Number],
    option(Option, Options, Else),
    (   ( integer(Number)
        ->  From = Number,
            To = Number
        ;   Number = From-To,
            integer(From),
            integer(To)
        ),
        0 =< From,
        From =< To
    ->  true
    ;   domain_error(count, Number)
    ),
    counts(Defaults, Options, Counts).

size(Options, Default, Columns, Rows) :-
    option(size(Size), Options, Default),
    (   Size = Columns-Rows,
        integer(Columns),
        integer(Rows),
        between(2, 20, Columns),
        between(2, 20, Rows)
    ->  true
    ;   domain_error(grid_size, Size)
    ).
