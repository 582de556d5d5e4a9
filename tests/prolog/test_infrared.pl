% Beacons, remote controls and what sees them, over three trees.

:- use_module('../support/trees').

%!  with_ir(+Tree, +Values, +World, :Goal)
%
%   Call Goal with the EV3's infrared sensor at in1, which shows Values in a
%   plain tree, and stands in World else. In a plain tree it is in the mode
%   with that number of values already: to change it takes 1.1 s.

:- meta_predicate with_ir(+, +, +, 0).

with_ir(Tree, Values, World, Goal) :-
    with_sensor(Tree, 'lego-ev3-ir', World,
                ( forall(( Tree == plain, nth0(I, Values, V) ),
                         ( atom_concat(value, I, A),
                           put_attribute(in1, A, V) )),
                  forall(( Tree == plain, length(Values, Count),
                           mode_of(Count, Mode) ),
                         put_attribute(in1, mode, Mode)),
                  Goal )).

mode_of(4, 'IR-REMOTE').
mode_of(8, 'IR-SEEK').

beacons([beacon(0, 100, 1), beacon(50, 50, 3)],
        [0, 50, 0, -128, 19, 35, 0, -128]).

:- begin_tests(ir_beacon).
test(tells_heading_and_distance, [forall(tree(Tree)), true(H-D == 19-35)]) :-
    beacons(World, Values),
    with_ir(Tree, Values, World, ir_beacon(in1, 3, H, D)).
test(fails_without_one, [forall(tree(Tree)), fail]) :-
    beacons(World, Values),
    with_ir(Tree, Values, World, ir_beacon(in1, 2, _, _)).
test(each_channel_that_has_one,
     [forall(tree(Tree)), true(Seen == [in1/1/0/50, in1/3/19/35])]) :-
    beacons(World, Values),
    with_ir(Tree, Values, World,
            findall(P/C/H/D, ir_beacon(P, C, H, D), Seen)).
test(a_channel_that_is_bound_leaves_no_choice) :-
    beacons(World, Values),
    with_ir(plain, Values, World,
            ( call_cleanup(ir_beacon(in1, 1, _, _), Det = true), Det == true )).
test(the_last_leaves_no_choice, all(C == [1, 3])) :-
    beacons(World, Values),
    with_ir(plain, Values, World, findall(C0, ir_beacon(_, C0, _, _), Cs)),
    member(C, Cs).
test(of_another_sensor_fails, [fail]) :-
    with_tree(plain, ir_beacon(in1, 1, _, _)).
test(a_wrong_channel_throws_and_writes_nothing,
     [ forall(member(Channel-Error, [ 0-domain_error(ir_channel, 0),
                                      5-domain_error(ir_channel, 5),
                                      a-type_error(integer, a),
                                      1.0-type_error(integer, 1.0) ])),
       true(Caught-W == Error-[]) ]) :-
    with_ir(plain, [], [],
            ( catch(ir_beacon(in1, Channel, _, _), error(Caught, _), true),
              written(W) )).
:- end_tests(ir_beacon).

:- begin_tests(ir_remote).
held(0,  []).
held(1,  [red_up]).
held(2,  [red_down]).
held(3,  [blue_up]).
held(4,  [blue_down]).
held(5,  [red_up, blue_up]).
held(6,  [red_up, blue_down]).
held(7,  [red_down, blue_up]).
held(8,  [red_down, blue_down]).
held(9,  [beacon]).
held(10, [red_up, red_down]).
held(11, [blue_up, blue_down]).

test(each_code_is_a_list_of_buttons, [forall(held(Code, Buttons)), true(Held == Buttons)]) :-
    with_ir(plain, [0, Code, 0, 0], [], ir_remote(in1, 2, Held)).
test(what_is_pressed_is_seen,
     [ forall(( held(_, Buttons), Buttons \== [] )), true(Held-Other == Buttons-[]) ]) :-
    with_ir(simulator, [], [],
            ( reverse(Buttons, Reversed),
              sim_remote(4, Reversed),
              ir_remote(in1, 4, Held),
              ir_remote(in1, 1, Other) )).
test(through_the_files, [forall(behaving(Tree)), true(A-B == [red_up]-[])]) :-
    with_ir(Tree, [], [],
            ( sim_remote(1, [red_up]),
              ir_remote(in1, 1, A),
              sim_remote(1, []),
              settle(Tree),
              ir_remote('ev3-ports:in1', 1, B) )).
test(each_channel, [forall(tree(Tree)),
                    true(All == [1-[], 2-[beacon], 3-[], 4-[]])]) :-
    with_ir(Tree, [0, 9, 0, 0], [beacon(0, 50, 2)],
            findall(C-B, ir_remote(in1, C, B), All)).
test(a_channel_by_its_buttons, [true(C == 3)]) :-
    with_ir(plain, [0, 0, 7, 0], [], ir_remote(_, C, [red_down, blue_up])).
test(leaves_no_choice) :-
    with_ir(plain, [0, 0, 7, 0], [],
            ( call_cleanup(ir_remote(in1, 1, _), Det = true), Det == true )).
test(a_code_that_is_none_fails, [fail]) :-
    with_ir(plain, [77, 0, 0, 0], [], ir_remote(in1, 1, _)).
test(of_another_sensor_fails, [fail]) :-
    with_tree(plain, ir_remote(_, 1, _)).
test(a_wrong_channel_throws,
     [ forall(member(Channel-Error, [ 5-domain_error(ir_channel, 5),
                                      a-type_error(integer, a) ])),
       error(Error, _) ]) :-
    with_ir(plain, [], [], ir_remote(in1, Channel, _)).
:- end_tests(ir_remote).

:- begin_tests(ir_dist_cm).
test(is_seventy_times_the_proximity,
     [ forall(tree(Tree)), true(abs(D - 35.0) < 0.5) ]) :-
    with_ir(Tree, [50], [wall(-50, 35.5, 50, 35.5)], ir_dist_cm(in1, D)).
test(of_another_sensor_fails, [fail]) :-
    with_tree(plain, ir_dist_cm(in1, _)).
:- end_tests(ir_dist_cm).

:- begin_tests(ir_seeker).
:- meta_predicate with_seeker(+, +, +, 0).

with_seeker(Tree, Values, World, Goal) :-
    with_sensor(Tree, 'ht-nxt-ir-seek-v2', World,
                ( forall(( Tree == plain, nth0(I, Values, V) ),
                         ( atom_concat(value, I, A),
                           put_attribute('in1:i2c8', A, V) )),
                  Goal )).

test(tells_degrees, [forall(tree(Tree)), true(Degrees == 90)]) :-
    with_seeker(Tree, [8], [beacon(80, 0, 1)], ir_seeker(_, Degrees)).
test(fails_where_it_sees_nothing, [forall(tree(Tree)), fail]) :-
    with_seeker(Tree, [0], [], ir_seeker(in1, _)).
test(tells_direction_and_strengths,
     [ forall(( tree(Tree), member(Light, [pulsed, steady]) )),
       true(Direction == 5) ]) :-
    with_seeker(Tree, [5, 0, 40, 200, 40, 0, 56], [beacon(0, 80, 1)],
                ir_seeker(in1, Light, Direction, Strengths)),
    Strengths = [Left, NearLeft, Ahead, NearRight, Right],
    Left == Right, NearLeft == NearRight, Ahead > NearLeft.
test(fails_where_its_eyes_see_nothing, [forall(tree(Tree)), fail]) :-
    with_seeker(Tree, [0], [], ir_seeker(in1, pulsed, _, _)).
test(of_another_sensor_fails, [forall(member(Goal, [ ir_seeker(in1, _),
                                                     ir_seeker(in1, pulsed, _, _) ])),
                               fail]) :-
    with_tree(plain, Goal).
test(a_wrong_light_throws,
     [ forall(member(Light-Error, [ _-instantiation_error,
                                    red-domain_error(ir_light, red) ])),
       error(Error, _) ]) :-
    with_seeker(plain, [], [], ir_seeker(in1, Light, _, _)).
:- end_tests(ir_seeker).

:- begin_tests(sim_remote).
test(a_wrong_argument_throws,
     [ forall(member(Channel-Buttons-Error,
                     [ 0-[]-domain_error(ir_channel, 0),
                       a-[]-type_error(integer, a),
                       _-[]-instantiation_error,
                       1-_-instantiation_error,
                       1-red_up-type_error(list, red_up),
                       1-[green]-domain_error(ir_button, green),
                       1-[7]-type_error(_, 7),
                       1-[_]-instantiation_error,
                       1-[red_up, red_up]-domain_error(ir_buttons, _),
                       1-[red_up, beacon]-domain_error(ir_buttons, _),
                       1-[red_up, blue_up, blue_down]-domain_error(ir_buttons, _)
                     ])),
       true(Held == [blue_up]) ]) :-
    with_ir(simulator, [], [],
            ( sim_remote(1, [blue_up]),
              catch(sim_remote(Channel, Buttons), error(Caught, _), true),
              subsumes_term(Error, Caught),
              ir_remote(in1, 1, Held) )).
test(fails_without_a_simulation, [fail]) :-
    ignore(sim_stop),
    sim_remote(1, []).
test(is_put_back_with_a_snapshot, [true(Held == [red_down])]) :-
    with_ir(simulator, [], [],
            ( sim_remote(1, [red_down]),
              sim_snapshot(Snapshot),
              sim_remote(1, []),
              sim_restore(Snapshot),
              ir_remote(in1, 1, Held) )).
test(a_beacon_comes_and_goes, [true(Before-After == [1]-[])]) :-
    with_ir(simulator, [], [],
            ( sim_add(beacon(0, 60, 1), Id),
              findall(C, ir_beacon(in1, C, _, _), Before),
              sim_remove(Id),
              findall(C, ir_beacon(in1, C, _, _), After) )).
test(an_impossible_world_throws,
     [ forall(member(Fact-Error,
                     [ beacon(0, 0, 5)-domain_error(ir_channel, 5),
                       beacon(0, 0, a)-type_error(integer, a),
                       beacon(b, 0, 1)-type_error(number, b),
                       temperature(cold)-type_error(number, cold),
                       temperature(-300)-domain_error(possible_geometry, _),
                       loudness(200)-domain_error(possible_geometry, _) ])),
       error(Error, _) ]) :-
    with_sim([Fact], true).
:- end_tests(sim_remote).
