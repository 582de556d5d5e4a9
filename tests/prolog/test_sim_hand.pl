:- use_module('../support/simulation').

:- begin_tests(sim_world).
test(place_moves_the_robot) :-
    with_sim([], ( sim_place(10*2, 5, 90), sim_pose(20.0, 5.0, 90.0) )).
test(place_inside_something, error(domain_error(possible_geometry, _), _)) :-
    with_sim([box(50, 50, 10, 10)], sim_place(50, 50, 0)).
test(place_outside_of_the_world, true(Pose-Text == [40, 40]-Expected)) :-
    Expected = 'is outside of the world',
    with_sim([bounds(0, 0, 300, 200), start(40, 40, 0)],
             ( catch(sim_place(500, 500, 0),
                     error(domain_error(possible_geometry, _),
                           context(_, Text)), true),
               sim_pose(X0, Y0, _) )),
    Pose = [X1, Y1],
    X1 is round(X0),
    Y1 is round(Y0).
test(add_puts_something_in_the_way) :-
    with_sim([],
             ( us_dist_cm(in1, 255.0),
               sim_add(wall(-50, 50, 50, 50)),
               sim_step(0.2),
               us_dist_cm(in1, Distance),
               near(Distance, 42.5, 0.2) )).
test(remove_by_id) :-
    with_sim([],
             ( sim_add(wall(-50, 50, 50, 50), Id),
               sim_remove(Id),
               \+ sim_remove(Id),
               us_dist_cm(in1, 255.0) )).
test(remove_by_fact) :-
    with_sim([],
             ( sim_add(wall(-50, 50, 50, 50)),
               sim_remove(wall(-50, 50, 50, 50)),
               \+ sim_remove(wall(-50, 50, 50, 50)),
               us_dist_cm(in1, 255.0) )).
test(remove_the_newest_of_a_kind) :-
    with_sim([],
             ( sim_add(circle(50, 0, 1), _),
               sim_add(circle(0, 50, 1), _),
               sim_remove(circle(_, _, _)),
               us_dist_cm(in1, 255.0),
               sim_remove(circle(X, _, _)),
               X == 50 )).
test(remove_after_a_new_start, [fail]) :-
    with_sim([], ( sim_add(circle(50, 0, 1)),
                   sim_start([], [clock(virtual)]),
                   sim_remove(circle(_, _, _)) )).
test(remove_what_was_never_there, [fail]) :-
    with_sim([], sim_remove(4711)).
test(remove_something_unbound, error(instantiation_error, _)) :-
    with_sim([], sim_remove(_)).
test(add_where_the_robot_stands,
     error(domain_error(possible_geometry, _), _)) :-
    with_sim([], sim_add(box(0, 0, 5, 5))).
test(add_something_impossible,
     error(domain_error(possible_geometry, circle(0, 50, -1)), _)) :-
    with_sim([], sim_add(circle(0, 50, -1))).
test(add_something_unheard_of, error(domain_error(_, unicorn(0, 50)), _)) :-
    with_sim([], sim_add(unicorn(0, 50))).
test(add_an_atom, error(domain_error(world_or_robot_fact, unicorn), _)) :-
    with_sim([], sim_add(unicorn)).
test(a_hull_without_size, error(domain_error(hull, circle), _)) :-
    with_sim([], true, [robot([hull(circle)])]).
test(add_no_thing, error(domain_error(world_item, start(0, 0, 0)), _)) :-
    with_sim([], sim_add(start(0, 0, 0))).
:- end_tests(sim_world).

:- begin_tests(sim_wires).
test(unplug_is_noticed) :-
    with_sim([], ( sim_unplug(in4), sim_step(2), \+ gyro_sensor(_) )).
test(unplug_takes_either_spelling) :-
    with_sim([], ( sim_unplug('ev3-ports:in4'), sim_step(2), \+ gyro_sensor(_) )).
test(unplug_nothing, [fail]) :-
    with_sim([], sim_unplug(outD)).
test(plug_is_noticed) :-
    with_sim([],
             ( sim_plug(outD, 'lego-ev3-l-motor'), sim_step(3),
               ev3_large_motor(outD),
               motor_run(outD, 50, 90) )).
test(plug_a_sensor_elsewhere) :-
    with_sim([], ( sim_unplug(in4), sim_step(2),
                   sim_plug(in4, 'lego-ev3-touch'), sim_step(3),
                   touch(in4, 0) )).
test(plug_a_sensor_into_an_output,
     error(domain_error(possible_geometry, _), _)) :-
    with_sim([], sim_plug(outD, 'lego-ev3-us')).
test(no_such_port, error(domain_error(port, outX), _)) :-
    with_sim([], sim_unplug(outX)).
test(unbound_port, error(instantiation_error, _)) :-
    with_sim([], sim_plug(_, 'lego-ev3-us')).
test(jam_holds_and_lets_go) :-
    with_sim([],
             ( sim_jam(outA, true),
               motor_run(outA, 50),
               sim_step(1),
               position(outA, P0),
               near(P0, 0, 5),
               sim_jam(outA, false),
               sim_step(1),
               position(outA, P1),
               P1 > 300 )).
test(jam_needs_a_boolean, error(type_error(_, perhaps), _)) :-
    with_sim([], sim_jam(outA, perhaps)).
:- end_tests(sim_wires).

:- begin_tests(sim_show).
test(a_value_is_what_it_is_told_to_be) :-
    with_sim([], ( us_dist_cm(in1, Own),
                   sim_show(in1, value0, 123), us_dist_cm(in1, 12.3),
                   sim_show('ev3-ports:in1', "value0", '456'), us_dist_cm(in1, 45.6),
                   sim_unshow(in1, value0), us_dist_cm(in1, Own) )).
test(text_is_an_atom_or_a_string_or_a_number,
     [ forall(member(Shown-Seen, [hold-hold, "hold"-hold, -3-(-3), 1.5-1.5])),
       true(Read == Seen) ]) :-
    with_sim([], ( sim_show(outB, stop_action, Shown),
                   motor_attribute(outB, stop_action, Read) )).
test(a_motor_goes_on_behind_what_it_shows) :-
    with_sim([], ( sim_show(outA, position, 7),
                   motor_run(outA, 50), sim_wait(1), motor_stop(outA),
                   position(outA, Shown), Shown =:= 7,
                   sim_unshow(outA, position),
                   position(outA, There), There > 100 )).
test(a_motor_may_seem_to_be_blocked) :-
    with_sim([], ( sim_show(outA, state, 'running stalled'),
                   motor_run(outA, 5, 3600, [wait(false)]),
                   motor_wait(outA, [], stalled) )).
test(a_wait_sees_what_another_thread_shows) :-
    with_sim([], ( motor_run(outA, 20),
                   thread_create(( sim_wait(0.5), sim_show(outA, state, holding) ), Id, []),
                   motor_wait_until(outA, holding),
                   thread_join(Id, true) )).
test(unplugging_ends_it) :-
    with_sim([], ( sim_show(in1, value0, 123),
                   sim_unplug(in1), sim_step(1),
                   sim_plug(in1, 'lego-ev3-us'), sim_step(2),
                   us_dist_cm(in1, D), D =\= 12.3 )).
test(a_snapshot_has_it) :-
    with_sim([], ( sim_show(in1, value0, 123), sim_snapshot(S),
                   sim_unshow(in1, value0), sim_restore(S),
                   us_dist_cm(in1, 12.3) )).
test(the_trace_has_what_was_shown) :-
    with_sim([], ( sim_show(in1, value0, 123), us_dist_cm(in1, _), sim_trace(Trace) )),
    once(member(_-read('lego-sensor/sensor0/value0', '123'), Trace)).
test(the_mount_shows_it, [condition(can_mount)]) :-
    with_sim([],
             with_directory(Directory,
                 ( sim_mount(Directory),
                   sim_show(in1, value0, 123),
                   atom_concat(Directory, '/lego-sensor/sensor0/value0', File),
                   read_file_to_string(File, "123\n", []),
                   sim_unmount ))).
test(where_nothing_is_it_fails,
     [forall(member(Goal, [ sim_show(outD, state, running), sim_unshow(outD, state),
                            sim_unshow(in1, value0) ])), fail]) :-
    with_sim([], Goal).
test(a_wrong_argument_throws,
     [ forall(member(Goal-Error,
                     [ sim_show(outB, colour, red)-existence_error(attribute, colour),
                       sim_unshow(outB, colour)-existence_error(attribute, colour),
                       sim_show(outB, command, stop)-
                           domain_error(readable_attribute, command),
                       sim_show(nowhere, state, '')-domain_error(port, nowhere),
                       sim_show(_, state, '')-instantiation_error,
                       sim_show(outB, _, '')-instantiation_error,
                       sim_show(outB, state, _)-instantiation_error,
                       sim_show(outB, state, f(x))-type_error(_, f(x)),
                       sim_unshow(outB, 7)-type_error(_, 7) ])),
       error(Error, _) ]) :-
    with_sim([], Goal).
test(a_text_longer_than_a_page_throws, error(domain_error(attribute_text, _), _)) :-
    length(Codes, 4096),
    maplist(=(0'x), Codes),
    atom_codes(Text, Codes),
    with_sim([], sim_show(outB, state, Text)).
:- end_tests(sim_show).

:- begin_tests(sim_press).
test(is_seen_and_traced, true(Keys-Events == [up]-[pressed(up), pressed(down), released(down)])) :-
    with_sim(room,
             ( sim_press(up), sim_press(up), sim_press(down), sim_release(down),
               sim_release(left),
               findall(Key, button(Key), Keys),
               events(Events) )).
test(comes_when_it_is_planned, true(Seen == [false, true, true, false])) :-
    with_sim(room,
             ( sim_press(enter, [after(1), for(2)]),
               findall(Down,
                       ( member(Step, [0.9, 0.2, 1.8, 0.2]),
                         sim_step(Step),
                         down(enter, Down)
                       ),
                       Seen) )).
test(is_short_unless_it_is_told, true(Events == [pressed(up), released(up)])) :-
    with_sim(room,
             ( sim_press(up, []), sim_step(0.3), events(Events) )).
test(may_last_until_it_is_released, true(A-B == true-false)) :-
    with_sim(room,
             ( sim_press(up, [for(infinite)]), sim_step(1000), down(up, A),
               sim_release(up), down(up, B) )).
test(is_put_back_with_a_snapshot, true(A-B == true-false)) :-
    with_sim(room,
             ( sim_snapshot(Snapshot),
               sim_press(up), down(up, A),
               sim_restore(Snapshot), down(up, B) )).
test(no_such_key,
     [ forall(member(Goal, [sim_press(go), sim_press(go, []), sim_release(go)])),
       error(domain_error(key, go), _)
     ]) :-
    with_sim(room, Goal).
test(unbound_key,
     [ forall(member(Goal, [sim_press(_), sim_press(_, []), sim_release(_)])),
       error(instantiation_error, _)
     ]) :-
    with_sim(room, Goal).
test(negative_time,
     [ forall(member(Option, [after(-1), for(-1)])),
       error(domain_error(seconds, -1), _)
     ]) :-
    with_sim(room, sim_press(up, [Option])).
test(no_such_option, error(domain_error(sim_option, until(3)), _)) :-
    with_sim(room, sim_press(up, [until(3)])).
test(time_that_is_no_number,
     [ forall(member(Option, [after(soon), for(long)])),
       error(type_error(evaluable, _), _)
     ]) :-
    with_sim(room, sim_press(up, [Option])).
test(needs_a_simulation,
     [ forall(member(Goal, [ sim_press(up), sim_press(up, []), sim_release(up),
                             sim_mount(tests, tests) ])),
       fail
     ]) :-
    ignore(sim_stop),
    call(Goal).

down(Key, Down) :-
    (   button(Key)
    ->  Down = true
    ;   Down = false
    ).

events(Events) :-
    sim_trace(Trace),
    findall(Event,
            ( member(_-Event, Trace),
              ( Event = pressed(_) ; Event = released(_) )
            ),
            Events).
:- end_tests(sim_press).

:- begin_tests(touched).
test(a_touch_sensor_is_pressed_and_let_go, true(Seen == [0, 1, 0])) :-
    with_sim([],
             ( touch(in4, A), sim_press(in4), sim_wait(0.05), touch(in4, B),
               sim_release('ev3-ports:in4'), sim_wait(0.05), touch(in4, C) ),
             [robot(touch)]),
    Seen = [A, B, C].
test(a_press_may_be_planned, true(Seen == [0, 1, 0])) :-
    with_sim([],
             ( sim_press(in4, [after(1), for(0.5)]),
               sim_wait(0.9), touch(in4, A),
               sim_wait(0.2), touch(in4, B),
               sim_wait(0.5), touch(in4, C) ),
             [robot(touch)]),
    Seen = [A, B, C].
test(a_press_is_in_the_trace, true(Events == [pressed(in4), released(in4)])) :-
    with_sim([],
             ( sim_press(in4), sim_press(in4), sim_release(in4), sim_trace(Trace),
               findall(E, ( member(_-E, Trace),
                            memberchk(E, [pressed(_), released(_)]) ), Events) ),
             [robot(touch)]).
test(unplugging_lets_go, true(Pressed == 0)) :-
    with_sim([],
             ( sim_press(in4), sim_unplug(in4), sim_wait(1),
               sim_plug(in4, 'lego-ev3-touch'), sim_wait(2), touch(in4, Pressed) ),
             [robot(touch)]).
test(there_must_be_a_touch_sensor, [ forall(member(Port, [in1, in4])), fail ]) :-
    with_sim([], sim_press(Port)).
test(other_keys_are_refused,
     [ forall(member(Key, [outA, space, in5])), error(domain_error(key, Key), _) ]) :-
    with_sim([], sim_press(Key)).
:- end_tests(touched).
