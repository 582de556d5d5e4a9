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
    findall(Cell, reached(Boxes, Cell), Reached0),
    sort(Reached0, Reached),
    length(Reached, Free),
    assertion(Free == 54),
    starts(World).

%   By depth, not by breadth as the library does.
reached(Boxes, Cell) :-
    reached([0-0], Boxes, [], All),
    member(Cell, All).

reached([], _, All, All).
reached([X-Y|Cells], Boxes, Seen, All) :-
    (   ( memberchk(X-Y, Seen) ; memberchk(X-Y, Boxes)
        ; X < 0 ; Y < 0 ; X > 140 ; Y > 140 )
    ->  reached(Cells, Boxes, Seen, All)
    ;   A is X-20, B is X+20, C is Y-20, D is Y+20,
        reached([A-Y, B-Y, X-C, X-D|Cells], Boxes, [X-Y|Seen], All)
    ).

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
