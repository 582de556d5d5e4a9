% Tests for library(ev3dev/map).
:- use_module('../support/trees').
:- use_module(library(ev3dev/drive)).
:- use_module(library(ev3dev/localize)).
:- use_module(library(ev3dev/map)).
:- use_module(library(sgml)).

:- meta_predicate in_room(0), in_world(+, 0).

in_room(Goal) :-
    in_world(room, Goal).

in_world(World, Goal) :-
    with_sim(World, ( set_robot(5.6, 10.6, outB, outC), Goal ),
             [clock(virtual), noise(true)]).

:- begin_tests(map).
test(it_explores_the_room_and_makes_a_world_of_it, Reason-Collisions == explored-[]) :-
    in_room(( sim_pose(X, Y, Heading), set_pose(X, Y, Heading),
              explore([reason(Reason)]), sim_collisions(Collisions),
              free_share(Share), Share > 0.9,
              forall(member(P-Q, [90-165, 200-90, 150-125]), is_near_thing(P, Q)),
              map_facts(Facts), map_cells(_, Cells) )),
    memberchk(bounds(Left, Low, Right, High), Facts),
    forall(member(cell(X0, Y0, _), Cells),
           assertion(( X0 > Left, X0 < Right, Y0 > Low, Y0 < High ))),
    memberchk(start(_, _, _), Facts),
    length(Facts, Count), Count < 100,
    % It is a world, and a map of it.
    in_world(Facts, ( localize_start(Facts), localize_scan,
                     localized_pose(X1, Y1, _, _), sim_pose(X2, Y2, _) )),
    (X1-X2)**2 + (Y1-Y2)**2 < 25.
test(another_world_has_no_map_yet) :-
    in_room(( map_start, turn(30, 360, []), map_facts(_), sim_start(room, [clock(virtual)]), \+ map_facts(_) )).
test(the_map_is_a_file_and_a_picture, true(Elements > 100)) :-
    in_room(( map_start, turn(30, 360, []),
              with_temporary('.pl', File,
                             ( map_save(File), map_facts(Facts),
                               with_sim(File, sim_pose(_, _, _)) )),
              with_temporary('.svg', Svg,
                             ( map_svg(Svg), load_structure(Svg, [element(svg, _, Content)],
                                                            [dialect(xml)]) )) )),
    memberchk(bounds(_, _, _, _), Facts),
    aggregate_all(count, member(element(rect, _, _), Content), Elements).
test(what_was_not_seen_is_unknown, P == 0.5) :-
    in_room(( map_start, map_occupancy(5000, 0, P) )).
test(it_stops, Before == After) :-
    in_room(( map_start, turn(30, 90, []), map_stop, map_cells(_, Before),
              turn(30, 90, []), map_cells(_, After) )).
test(nothing_without_a_map,
     [forall(member(Goal, [ map_stop, map_occupancy(0, 0, _), map_cells(_, _),
                            map_facts(_), map_svg('/dev/null') ])),
      fail]) :-
    in_room(Goal).
test(wrong_options,
     [ forall(member(Goal-Error,
                     [ map_start([often(1)])-domain_error(map_option, often(1)),
                       explore([places(0)])-_,
                       explore([far(1)])-domain_error(explore_option, far(1)) ])),
       error(Error, _) ]) :-
    in_room(Goal).

%   Of the places in the room at which nothing stands, the share that is seen to be free.
free_share(Share) :-
    findall(Free,
            ( between(1, 14, I), between(1, 11, J), X is I*20, Y is J*20,
              \+ ( member(A-B, [90-165, 200-90, 150-125]),
                   (A-X)**2 + (B-Y)**2 < 40**2 ),
              map_occupancy(X, Y, P),
              ( P < 0.5 -> Free = 1 ; Free = 0 ) ),
            All),
    sum_list(All, Sum),
    length(All, Count),
    Share is Sum/Count.

is_near_thing(X0, Y0) :-
    between(-5, 5, I), between(-5, 5, J),
    X is X0+5*I, Y is Y0+5*J,
    map_occupancy(X, Y, P),
    P > 0.5,
    !.

with_temporary(Extension, File, Goal) :-
    tmp_file(map, Base),
    atom_concat(Base, Extension, File),
    call_cleanup(Goal, catch(delete_file(File), _, true)).
:- end_tests(map).
