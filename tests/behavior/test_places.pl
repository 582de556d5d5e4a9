% Places are X-Y, and [X, Y] is accepted wherever a program gives one. What is
% no place is the same error everywhere.

:- use_module('../support/simulation').
:- use_module(library(ev3dev/drive)).
:- use_module(library(ev3dev/roadmap)).

%   A call for each place that a program gives.

with_place(Place, roadmap_path([], Place, 50-60, _)).
with_place(Place, roadmap_path([], 50-60, Place, _, [])).
with_place(Place, roadmap_legs([], 50-60, Place, _, [])).
with_place(Place, roadmap_svg([], 50-60, Place, '/dev/null', [])).
with_place(Place, roadmap_path([polygon([Place, 120-0, 120-9])], 0-99, 9-99, _)).
with_place(Place, navigate_to([], Place)).
with_place(Place, go_to(Place)).
with_place(Place, follow([Place])).
with_place(Place, follow([0-5, Place], [radius(2)])).
with_place(Place, sim_add(patch(red, [Place, 1-0, 1-1]))).
with_place(Place, sim_add(line(red, 1, [Place, 50-60]))).
with_place(Place, sim_start([patch(red, [Place, 1-0, 1-1])], [clock(virtual)])).
with_place(Place, sim_start([line(red, 1, [50-60, Place])], [clock(virtual)])).

in_a_world(Goal) :-
    with_sim([],
             ( set_robot(5.6, 10.6, outB, outC),
               set_pose(0, 0, 0),
               call(Goal) )).

:- begin_tests(places).
test(are_written_as_pairs, [ forall(with_place(15-20, Goal)) ]) :-
    in_a_world(Goal).
test(may_be_lists, [ forall(with_place([15, 20], Goal)) ]) :-
    in_a_world(Goal).
test(what_is_none_is_the_same_error_everywhere,
     [ forall(( member(No, [point(15, 20), here, 7, 15+20, "15-20", [], [15],
                            [15, 20, 0]]),
                with_place(No, Goal) )),
       true(Words == Expected) ]) :-
    catch(in_a_world(Goal), error(domain_error(place, No), context(_, Words)), true),
    format(atom(Expected), "a place must be X-Y, not ~p", [No]).
test(what_has_no_coordinates_is_the_same_error_everywhere,
     [ forall(( member(No, [a-20, [15, a]]), with_place(No, Goal) )),
       true(Words == 'a number is expected, not a') ]) :-
    catch(in_a_world(Goal), error(type_error(_, _), context(_, Words)), true).
test(what_is_unbound_is_the_same_error_everywhere,
     [ forall(( member(No, [_, _-20, [15, _]]), with_place(No, Goal) )),
       error(instantiation_error, _) ]) :-
    in_a_world(Goal).
test(a_partial_list_of_places_is_unbound,
     [ forall(member(Goal, [ follow([1-1|_]), sim_add(line(red, 1, [0-0, 1-1|_])),
                             sim_start([patch(red, [0-0, 9-0, 9-9|_])]),
                             roadmap_path([polygon([0-0, 9-0, 9-9|_])], 50-0, 60-0, _) ])),
       error(instantiation_error, _) ]) :-
    in_a_world(Goal).
test(go_to_takes_one, true(X/Y == 15/20)) :-
    in_a_world(( go_to(15-(2 * 10)), pose(X0, Y0, _) )),
    X is round(X0),
    Y is round(Y0).
test(answers_are_pairs) :-
    with_sim([box(0, 60, 10, 10)],
             ( set_robot(5.6, 10.6, outB, outC),
               roadmap_path([], [0, 0], [15, 20], Points),
               navigate_to([], 0-100, [obstacles(Found)]) )),
    Points = [_-_, _-_],
    Found = [polygon([_-_, _-_, _-_|_])|_].
:- end_tests(places).
