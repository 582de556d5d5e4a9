:- use_module('../support/cases').
:- use_module('../support/trees').
:- use_module(library(ev3dev/random_worlds)).
:- use_module(library(ev3dev/roadmap)).

%   Each is a world that the simulator takes, where nothing stands at the start.
starts(World) :-
    with_sim(World, sim_collisions([]), [clock(virtual)]).

%   How many things of that kind there are in some of 50 rooms.
counts_of(Thing, Counts) :-
    setof(Count, Seed^rooms_count(Seed, Thing, Count), Counts).

rooms_count(Seed, Thing, Count) :-
    between(1, 50, Seed),
    random_room(Seed, [], World),
    findall(x, member(Thing, World), Things),
    length(Things, Count).

:- begin_tests(random_worlds).
test(a_seed_is_a_world, true(One-Two == Again-Again2)) :-
    random_room(3, [], One), random_track(3, [], Two),
    random_room(3, [], Again), random_track(3, [], Again2).
%   The same on every machine and in every Prolog: these were written down once.
test(the_world_of_a_seed, World == [ bounds(0, 0, 300, 250), start(40, 40, 40),
                                     box(107.0, 131.5, 32.1, 41.4, 15.6),
                                     box(60.5, 190.8, 27.3, 18.6, -19.2),
                                     box(183.1, 82.9, 23.0, 17.7, 33.5),
                                     box(137.1, 200.6, 34.4, 19.1, -76.5),
                                     circle(79.7, 69.5, 8.1) ]) :-
    random_room(1, [free(200, 200, 30)], World).

test(rooms, forall(case(20, Seed))) :-
    random_room(Seed, [boxes(4-6), pillars(1), free(250, 200, 30)], World),
    findall(x, member(box(_, _, _, _, _), World), Boxes),
    length(Boxes, Count),
    assertion(between(4, 6, Count)),
    findall(x, member(circle(_, _, _), World), Pillars),
    assertion(Pillars == [x]),
    assertion(roadmap_path(World, 40-40, 250-200, _, [])),
    forall(( member(circle(X, Y, R), World) ),
           assertion((X-250)**2 + (Y-200)**2 >= (R+30)**2)),
    starts(World).
test(what_is_in_a_room, Boxes-Pillars == [3, 4, 5]-[0, 1, 2]) :-
    counts_of(box(_, _, _, _, _), Boxes),
    counts_of(circle(_, _, _), Pillars).
test(a_room_of_another_size, World == [bounds(0, 0, 200, 180), start(90, 60, 45)]) :-
    random_room(1, [size(200-180), boxes(0), pillars(0), start(90, 60, 45)], World).
test(a_room_that_is_too_full, error(resource_error(room))) :-
    random_room(1, [size(120-120), boxes(9)], _).

test(grids, forall(case(20, Seed))) :-
    random_grid(Seed, [boxes(10), free([[7, 7]])], World),
    findall(X-Y, member(box(X, Y, 14.0, 14.0), World), Boxes),
    length(Boxes, Count),
    assertion(Count == 10),
    assertion(\+ memberchk(140-140, Boxes)),
    reached(Boxes, 20, 140-140, Reached),
    length(Reached, Free),
    assertion(Free == 54),
    starts(World).

%   By depth, not by breadth as the library does.
reached(Taken, Cm, Most, Cells) :-
    reached([0-0], Taken, Cm, Most, [], Cells0),
    sort(Cells0, Cells).

reached([], _, _, _, All, All).
reached([X-Y|Cells], Taken, Cm, Right-Top, Seen, All) :-
    (   ( memberchk(X-Y, Seen) ; memberchk(X-Y, Taken)
        ; X < 0 ; Y < 0 ; X > Right ; Y > Top )
    ->  reached(Cells, Taken, Cm, Right-Top, Seen, All)
    ;   A is X-Cm, B is X+Cm, C is Y-Cm, D is Y+Cm,
        reached([A-Y, B-Y, X-C, X-D|Cells], Taken, Cm, Right-Top, [X-Y|Seen], All)
    ).

%   A robot can drive to each thing, and push it by 10 cm from each side.
test(things_in_rooms, forall(case(10, Seed))) :-
    random_room(Seed, [size(250-200), boxes(2), pillars(1), things(3-5), free(200, 150, 20)], World),
    findall(Name-X/Y, member(box(X, Y, 5, 5, _, [mass(0.05), color(_), name(Name)]), World), Things),
    length(Things, Count),
    assertion(between(3, 5, Count)),
    forall(( member(Name-X/Y, Things), member(DX-DY, [1-0, -1-0, 0-1, 0-(-1)]) ),
           ( FromX is X-16*DX, FromY is Y-16*DY,
             assertion(roadmap_path(World, 40-40, FromX-FromY, _, [])),
             Heading is atan2(DX, DY)*180/pi,
             with_sim(World, ( set_robot(5.6, 10.6, outB, outC),
                               sim_place(FromX, FromY, Heading), go_cm(30, 15),
                               sim_thing(Name, X1, Y1, _), sim_collisions([_]) ),
                      [clock(virtual)]),
             assertion(abs((X1-X)*DX + (Y1-Y)*DY - 10) < 1.5) )),
    starts(World).
test(things_in_grids, forall(case(10, Seed))) :-
    random_grid(Seed, [size(5-4), boxes(2), things(6), cell(40), free([[4, 3]])], World),
    findall(Name-Color/Cell,
            ( member(box(X, Y, 5, 5, 0, [mass(0.05), color(Color), name(Name)]), World),
              Column is X/40, Row is Y/40, Cell = [Column, Row] ),
            Things),
    findall(Name-Color, member(Name-Color/_, Things), Names),
    assertion(Names == [ thing1-red, thing2-yellow, thing3-green, thing4-blue, thing5-red,
                         thing6-yellow ]),
    findall(Cell, member(_/Cell, Things), Cells),
    assertion(\+ ( member(Cell, [[0, 0], [4, 3]]), memberchk(Cell, Cells) )),
    findall(X-Y, ( member(Fact, World), place_of(Fact, X, Y) ), Taken),
    sort(Taken, Different),
    assertion(length(Different, 8)),
    %  The others hang together, and each thing is beside one of them.
    reached(Taken, 40, 160-120, Reached),
    assertion(length(Reached, 12)),
    forall(member([Column, Row], Cells),
           ( X is 40*Column, Y is 40*Row,
             assertion(( member(RX-RY, Reached), 40 =:= abs(RX-X)+abs(RY-Y) )) )),
    starts(World).
test(a_grid_of_things, Facts == 4) :-
    random_grid(2, [size(5-3), boxes(0), things(4), cell(40),
                    free([[1, 0], [2, 0], [3, 0], [4, 0], [0, 1], [1, 1], [2, 1], [3, 1], [4, 1]])],
                World),
    findall(X, member(box(X, 80, 5, 5, 0, _), World), Row),
    length(Row, Facts).
%   A thing is asked for, but no number is drawn for none.
test(no_things_change_nothing, One-Two == Again-Again2) :-
    random_room(9, [boxes(4), pillars(2), size(190-190)], One),
    random_room(9, [boxes(4), pillars(2), size(190-190), things(0)], Again),
    random_grid(9, [], Two),
    random_grid(9, [things(0-0)], Again2).
test(a_grid_with_too_many_things, error(resource_error(grid))) :-
    random_grid(1, [size(3-3), boxes(0), things(9)], _).
%   The thing in the corner would be behind the two others.
test(a_thing_that_cannot_be_reached, error(resource_error(grid))) :-
    random_grid(1, [size(2-2), boxes(0), things(3)], _).
test(a_room_with_too_many_things, error(resource_error(room))) :-
    random_room(1, [size(120-120), boxes(0), pillars(0), things(20)], _).

place_of(box(X, Y, _, _), X, Y).
place_of(box(X, Y, _, _, _, _), X, Y).

test(a_grid_that_is_too_full, error(resource_error(grid))) :-
    random_grid(1, [size(3-3), boxes(8), free([[2, 2]])], _).
test(mazes, forall(case(10, Seed))) :-
    random_maze(Seed, [size(6-4), cell(25)], [map(25, Rows)]),
    length(Rows, 9),
    findall(C, ( member(Row, Rows), atom_chars(Row, Chars), member(C, Chars), C \== '#' ), Cells),
    length(Cells, Count),
    assertion(Count == 47),                 % 24 rooms, and a door less
    sort(Cells, Kinds),
    assertion(Kinds == ['.', ^, r]),
    starts([map(25, Rows)]).
test(tracks, forall(case(10, Seed))) :-
    random_track(Seed, [radius(60)], World),
    memberchk(line(black, 2, [First|Points]), World),
    last(Points, Last),
    assertion(First == Last),
    starts(World).
test(a_circle, true(abs(R-50) < 0.2)) :-
    random_track(1, [radius(50), wave(0)], World),
    memberchk(line(_, _, Points), World),
    nth1(30, Points, X-Y),
    R is sqrt(X*X + Y*Y).
test(a_track_that_is_too_small, error(resource_error(track))) :-
    random_track(1, [radius(15)], _).

test(wrong_option, error(domain_error(random_room_option, box(3)))) :-
    random_room(1, [box(3)], _).
test(wrong_count, error(domain_error(count, 5-3))) :-
    random_room(1, [boxes(5-3)], _).
test(wrong_seed, error(type_error(integer, one))) :-
    random_maze(one, [], _).
test(wrong_size, error(domain_error(grid_size, 1-5))) :-
    random_maze(1, [size(1-5)], _).
:- end_tests(random_worlds).
