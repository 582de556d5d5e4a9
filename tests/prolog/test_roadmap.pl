% Ways between obstacles.

:- use_module('../support/rooms').
:- use_module('../support/simulation').
:- use_module('../support/old_prolog').
:- use_module(library(ev3dev/drive)).
:- use_module(library(ev3dev/roadmap)).
:- use_module(library(sgml)).

:- begin_tests(roadmap).
%   A fact of each kind that a world may have, away from the way.
world_fact(Fact) :-
    member(Fact,
           [ bounds(-500, -500, 500, 500), wall(200, 0, 200, 50),
             wall(200, 0, 200, 50, 2), box(50, 50, 10, 10),
             box(50, 50, 10, 10, 45), circle(200, 200, 5), floor(yellow),
             patch(blue, [0-0, 9-0, [9, 9]]),
             line('#102030', 2, [0-0, [100, 100]]), lamp(1, 1, 12),
             lamp(1, 1, 12, outD), beacon(1, 1, 1), ambient(3),
             temperature(20), loudness(3), start(0, 0, 0), map(20, ["#.S.L"]) ]).

test(each_fact_of_the_simulators_vocabulary_is_accepted,
     [ forall(world_fact(Fact)) ]) :-
    roadmap_path([Fact], 0-150, 100-150, Points),
    Points = [_, _|_].
test(what_stops_no_robot_changes_no_path) :-
    Box = box(50, 50, 10, 10),
    roadmap_path([Box], 0-0, 100-100, Points),
    forall(member(Fact, [ beacon(1, 1, 1), temperature(20), loudness(3),
                          lamp(1, 1, 12, outD) ]),
           ( roadmap_path([Fact, Box], 0-0, 100-100, Points1),
             same_way(Points, Points1) )).

square([polygon([40-40, 60-40, 60-60, 40-60])]).

same_way([], []).
same_way([X1-Y1|Way1], [X2-Y2|Way2]) :-
    near(X1, X2, 0.001),
    near(Y1, Y2, 0.001),
    same_way(Way1, Way2).

test(nothing_in_the_way) :-
    roadmap_path([], 0-0, 30-40, Points, [length(Length)]),
    same_way(Points, [0-0, 30-40]),
    near(Length, 50, 0.001).
test(around_a_corner_by_arcs) :-
    square(Map),
    roadmap_legs(Map, 20-40, 60-80, Legs, [length(Length)]),
    Legs = [line(_, _)|_],
    last(Legs, line(_, _)),
    % Tangents to a circle of 11 cm around the corner, and its arc
    Direct is sqrt(20^2 + 20^2),
    Tangent is sqrt(Direct^2 - 12^2),
    Shortest is 2 * Tangent + 12 * (pi - 2 * acos(12 / Direct)),
    Length >= Shortest - 0.001,
    Length =< 1.01 * Shortest.
test(an_arc_turns_as_arc_cm_does, [forall(member(From-To-Sign,
     [(20-40)-(60-80)-1, (60-80)-(20-40)-(-1)]))]) :-
    square(Map),
    roadmap_legs(Map, From, To, Legs, []),
    findall(Radius-Angle, member(arc(_, _, Radius, Angle), Legs), Arcs),
    Arcs = [_|_],
    forall(member(Radius-Angle, Arcs),
           ( Radius * Sign >= 6, Angle > 0 )).
test(corners_stay_where_no_arc_fits) :-
    square(Map),
    roadmap_legs(Map, 20-40, 60-80, Legs, [arc_radius(500)]),
    Legs = [line(_, _), line(_, _)|_],
    \+ memberchk(arc(_, _, _, _), Legs).
test(corners_may_be_lists_and_clockwise, [forall(member(Polygon,
     [ [[40, 40], [60, 40], [60, 60], [40, 60]],
       [40-60, 60-60, 60-40, 40-40] ]))]) :-
    square(Map),
    roadmap_path(Map, 0-50, 100-50, Points),
    roadmap_path([polygon(Polygon)], [0, 50], [100, 50], Points1),
    same_way(Points, Points1).
test(each_method_finds_a_way,
     [forall(member(Method, [visibility, prm, rrt, rrt_bidirectional, rrt_star]))]) :-
    roadmap_path(room, 40-40, 270-220, Points,
                 [method(Method), length(Length)]),
    Points = [40.0-40.0|_],
    last(Points, 270.0-220.0),
    Length < 320.
test(trees_count_their_lines, true(One-Both == true-true)) :-
    Horseshoe = polygon([ 0-0, 40-0, 40-5, 5-5, 5-95, 95-95, 95-5, 55-5,
                          55-0, 100-0, 100-100, 0-100 ]),
    findall(Method-Count,
            ( member(Method, [rrt, rrt_bidirectional, rrt_star]),
              roadmap_path([Horseshoe], 20-80, 50-(-50), _,
                           [method(Method), radius(5), margin(0), samples(3000), lines(Count)]) ),
            [rrt-N1, rrt_bidirectional-N2, rrt_star-N3]),
    ( N2 < N1 -> Both = true ; Both = N2-N1 ),
    ( N1 < N3 -> One = true ; One = N1-N3 ).
test(no_way_in_so_many_samples, [fail, forall(member(Method, [rrt, rrt_bidirectional, rrt_star]))]) :-
    roadmap_path([bounds(0, 0, 100, 100), wall(50, 0, 50, 100)], 20-20, 80-80, _,
                 [method(Method), samples(3000)]).
test(the_same_seed_gives_the_same_way,
     [forall(member(Method, [prm, rrt, rrt_bidirectional, rrt_star]))]) :-
    Options = [method(Method), margin(20)],
    roadmap_path(room, 40-40, 270-220, Points1, [seed(7)|Options]),
    roadmap_path(room, 40-40, 270-220, Points2, [seed(7)|Options]),
    roadmap_path(room, 40-40, 270-220, Points3, [seed(8)|Options]),
    Points1 == Points2,
    Points1 \== Points3.
test(a_map_that_is_drawn) :-
    roadmap_path(maze, 45-45, 45-255, _, [margin(1)]).
test(a_concave_polygon_holds_one_fast, [fail]) :-
    Horseshoe = polygon([ 0-0, 40-0, 40-5, 5-5, 5-95, 95-95, 95-5, 55-5,
                          55-0, 100-0, 100-100, 0-100 ]),
    roadmap_path([Horseshoe], 50-50, 50-(-50), _).
test(no_way_through_a_wall, [fail]) :-
    roadmap_path([bounds(0, 0, 100, 100), wall(50, 0, 50, 100)],
                 20-20, 80-80, _).
test(the_way_is_as_wide_as_the_robot) :-
    Map = [bounds(0, 0, 100, 100), wall(50, 0, 50, 40), wall(50, 60, 50, 100)],
    roadmap_path(Map, 20-20, 80-80, _, [radius(9), margin(0.9)]),
    \+ roadmap_path(Map, 20-20, 80-80, _, [radius(9), margin(1.1)]).
test(too_near_to_the_goal, [fail]) :-
    square(Map),
    roadmap_path(Map, 0-0, 50-50, _).
test(too_near_to_the_start, [fail]) :-
    square(Map),
    roadmap_path(Map, 50-65, 0-0, _).
test(places_may_be_expressions) :-
    X = 10,
    roadmap_path([], (X + 1)-(2 * X), [X / 4, 0], Points),
    same_way(Points, [11-20, 2.5-0]).
test(points_that_are_given_are_compared, [fail]) :-
    roadmap_path([], 0-0, 30-40, []).
test(a_picture) :-
    tmp_file(roadmap, File),
    setup_call_cleanup(
        true,
        ( roadmap_svg(room, 40-40, 270-220, File, []),
          load_xml(File, [element(svg, _, _)|_], []) ),
        delete_file(File)).
test(no_picture_where_there_is_no_way, [true(\+ exists_file(File))]) :-
    square(Map),
    tmp_file(roadmap, File),
    \+ roadmap_svg(Map, 0-0, 50-50, File, []).
:- end_tests(roadmap).

:- begin_tests(roadmap_bad_input).
impossible(polygon([0-0, 10-0])).
impossible(polygon([0-0, 10-10, 10-0, 0-10])).
impossible(polygon([0-0, 10-0, 20-0])).
impossible(box(0, 0, 0, 10)).
impossible(wall(5, 5, 5, 5)).
impossible(circle(0, 0, -1)).
impossible(bounds(10, 0, 0, 10)).
impossible(circle(1.0e20, 0, 1)).
impossible(circle(X, 0, 1)) :- evaluated(inf, X).

test(impossible, [ forall(impossible(Fact)),
                   error(domain_error(possible_geometry, _)) ]) :-
    roadmap_path([Fact], 100-100, 200-200, _).

far(1.0e20-0, place).
far(0-(-2000000), place).
far(X-0, finite_number) :- evaluated(nan, X).
far(X-0, finite_number) :- evaluated(inf, X).

test(a_start_beyond_10_km, [ forall(far(Place, Domain)), error(domain_error(Domain, _)) ]) :-
    roadmap_path([], Place, 200-200, _).
test(a_goal_beyond_10_km, [ forall(far(Place, Domain)), error(domain_error(Domain, _)) ]) :-
    roadmap_path([], 200-200, Place, _).
test(a_drawing_with_an_unknown_character, error(domain_error(map_row, "#?#"))) :-
    roadmap_path([map(20, ["#?#"])], 100-100, 200-200, _).
test(a_drawing_with_two_starts, error(domain_error(map_row, "^.S"))) :-
    roadmap_path([map(20, ["^.S"])], 100-100, 200-200, _).
test(a_fact_without_arguments, error(domain_error(roadmap_fact, room))) :-
    roadmap_path([room], 0-0, 10-10, _).
test(unknown_fact, error(domain_error(roadmap_fact, pond(1, 2)))) :-
    roadmap_path([pond(1, 2)], 0-0, 1-1, _).
test(too_many_arguments, error(domain_error(roadmap_fact, _))) :-
    roadmap_path([beacon(1, 2, 3, 4)], 0-0, 1-1, _).
test(fact_of_words, error(type_error(number, a))) :-
    roadmap_path([circle(a, 2, 3)], 0-0, 1-1, _).
test(unbound_fact, error(_)) :-
    roadmap_path([_], 0-0, 1-1, _).
test(corner_that_is_none, error(domain_error(place, a+b))) :-
    roadmap_path([polygon([0-0, 1-1, a+b])], 0-0, 1-1, _).
test(no_such_world, error(existence_error(world, nowhere))) :-
    roadmap_path(nowhere, 0-0, 1-1, _).
test(unbound_map, error(instantiation_error)) :-
    roadmap_path(_, 0-0, 1-1, _).
test(unbound_start, error(instantiation_error)) :-
    roadmap_path([], _, 1-1, _).
test(unbound_goal, error(instantiation_error)) :-
    roadmap_path([], 0-0, _-1, _).
test(no_place, error(domain_error(place, here))) :-
    roadmap_path([], 0-0, here, _).
test(bad_option, [ forall(bad(Option, Formal)), error(Formal) ]) :-
    roadmap_path([], 0-0, 1-1, _, [Option]).

bad(radius(0), domain_error(positive_number, 0)).
bad(radius(a), type_error(evaluable, a/0)).
bad(margin(-1), domain_error(nonnegative_number, -1)).
bad(arc_radius(0), domain_error(positive_number, 0)).
bad(method(guess), domain_error(roadmap_method, guess)).
bad(method(_), instantiation_error).
bad(samples(-1), domain_error(samples, -1)).
bad(samples(1000000), domain_error(samples, 1000000)).
bad(seed(x), type_error(integer, x)).
bad(steps(5), domain_error(roadmap_option, steps(5))).
bad(raduis(5), domain_error(roadmap_option, raduis(5))).

test(options_that_are_no_list, error(type_error(list, x))) :-
    roadmap_path([], 0-0, 1-1, _, x).
:- end_tests(roadmap_bad_input).
