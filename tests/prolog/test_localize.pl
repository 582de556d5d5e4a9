% Tests for library(ev3dev/localize).
:- use_module('../support/trees').
:- use_module(library(ev3dev/drive)).
:- use_module(library(ev3dev/events), [event/2]).
:- use_module(library(ev3dev/localize)).

:- meta_predicate in_room(0), in_world(+, 0).

in_room(Goal) :-
    in_world(room, Goal).

in_world(World, Goal) :-
    with_sim(World, ( set_robot(5.6, 10.6, outB, outC), Goal ),
             [clock(virtual), noise(true)]).

%   How far off it is, in cm and degrees.
off(Cm, Degrees) :-
    localized_pose(X, Y, Heading, _),
    off(X, Y, Heading, Cm, Degrees).

off(X, Y, Heading, Cm, Degrees) :-
    sim_pose(X1, Y1, Heading1),
    Cm is sqrt((X-X1)**2 + (Y-Y1)**2),
    Off is Heading-Heading1,
    heading_wrapped(Off, Wrapped),
    Degrees is abs(Wrapped).

is_right :-
    off(Cm, Degrees),
    Cm < 5,
    Degrees < 5.

:- begin_tests(localize).
%   With the EV3's table, too.
test(one_look_around_is_enough, [forall(( member(Table, [false, true]),
                                          member(Place, [100-60, 250-200, 40-210]) ))]) :-
    in_room(( Place = X-Y, sim_place(X, Y, 77),
              localize_start(room, [table(Table)]),
              \+ localized_pose(_, _, _, _),
              localize_scan,
              is_right,
              localized(C), C > 0.8 )).
test(it_follows_while_it_drives, true) :-
    in_room(( localize_start(room, [start(pose(40, 40, 40))]),
              go_cm(30, 60), turn(30, 90, []), go_cm(30, 40),
              is_right )).
test(it_measures_as_an_event, Kind-Left == every-[]) :-
    in_room(( localize_start(room), event(localize, Kind), localize_stop,
              findall(Id, event(Id, _), Left) )).
test(a_step_is_for_lectures, Steps == [nothing, tracked]) :-
    in_room(( localize_start(room, [start(pose(40, 40, 40)), every(0), update(1, 1)]),
              localize_step(_, _),
              findall(Step, ( member(Cm, [0.2, 10]), go_cm(20, Cm), localize_step(_, Step) ),
                      Steps) )).
test(carried_away_it_says_so_and_finds_itself_again, true) :-
    in_room(( localize_start(room, [start(pose(40, 40, 40))]),
              sim_place(250, 200, 10),
              localize_scan([turns(3)]), ignore(localize_scan),
              is_right )).
test(reset_forgets, Known == false) :-
    in_room(( localize_start(room, [start(pose(40, 40, 40))]),
              localized_pose(_, _, _, _),
              localize_reset,
              ( localized_pose(_, _, _, _) -> Known = true ; Known = false ) )).
test(the_odometry_is_corrected_if_asked_for, true((Cm < 5, Degrees < 5))) :-
    in_room(( sim_place(100, 60, 77),
              localize_start(room, [correct_odometry(true)]),
              localize_scan, go_cm(30, 20),
              pose(X, Y, Heading), off(X, Y, Heading, Cm, Degrees) )).
test(else_it_is_not, true(Cm > 50)) :-
    in_room(( sim_place(100, 60, 77), localize_start(room), localize_scan,
              pose(X, Y, Heading), off(X, Y, Heading, Cm, _) )).
test(set_pose_does_not_disturb_it, true) :-
    in_room(( localize_start(room, [start(pose(40, 40, 40))]),
              go_cm(30, 20), set_pose(-500, 70, 200), go_cm(30, 20),
              is_right )).
test(particles_and_clusters_sum_up, true((abs(P-1) < 1.0e-9, abs(C-1) < 1.0e-9, N == 500))) :-
    in_room(( localize_start(room, [start(pose(40, 40, 40)), particles(500)]),
              particles(Particles), length(Particles, N),
              aggregate_all(sum(W), member(particle(W, _, _, _), Particles), P),
              localized_clusters(Clusters),
              aggregate_all(sum(W), member(cluster(W, _, _, _, _), Clusters), C) )).
test(two_places_that_look_alike_are_both_told, Count-Sure == 2-false) :-
    World = [bounds(0, 0, 300, 200), start(80, 60, 20)],
    in_world(World,
             ( localize_start(World), localize_scan,
               localized_clusters(Clusters),
               aggregate_all(count,
                             ( member(cluster(W, _, _, _, _), Clusters), W > 0.2 ), Count),
               ( localized(C), C > 0.7 -> Sure = true ; Sure = false ) )).
test(the_same_seed_gives_the_same, P1 == P2) :-
    maplist(same_seed, [P1, P2]).
test(a_table_is_about_as_good, true) :-
    in_room(( localize_start(room, [table(true)]), localize_scan, is_right )).
test(it_stops_where_the_sensor_is_unplugged, Reason == unplugged) :-
    in_room(( localize_start(room), sim_unplug(in1), localize_scan([reason(Reason)]) )).
test(nothing_without_a_start,
     [forall(member(Goal, [ localize_stop, localize_reset, localize_scan,
                            localize_step(_, _), localized(_), localized_clusters(_),
                            particles(_), localized_pose(_, _, _, _) ])),
      fail]) :-
    in_room(Goal).
test(wrong_options,
     [ forall(member(Option-Error,
                     [ start(here)-domain_error(localize_start, here),
                       start(pose(a, 1, 2))-type_error(evaluable, a/0),
                       particles(0)-_, every(-1)-domain_error(seconds, -1),
                       model([hits(1)])-domain_error(localize_model, hits(1)),
                       correct_odometry(1)-type_error(bool, 1),
                       wrong(1)-domain_error(localize_option, wrong(1)) ])),
       error(Error, _) ]) :-
    in_room(localize_start(room, [Option])).
test(a_map_of_nothing, error(domain_error(possible_geometry, [start(0, 0, 0)]), _)) :-
    in_room(localize_start([start(0, 0, 0)])).

same_seed(X-Y-H) :-
    in_room(( localize_start(room, [seed(7)]), localize_scan, localized_pose(X, Y, H, _) )).
:- end_tests(localize).
