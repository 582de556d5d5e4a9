:- use_module(child).
:- use_module(simulation).
:- use_module(tree, [with_tree/2]).
:- use_module(library(ev3dev)).
:- use_module(library(ev3dev/sim)).
:- use_module(library(filesex)).
:- use_module(library(readutil)).
:- use_module(library(sgml)).
:- use_module(library(time)).

stopped(Goal) :-
    ignore(sim_stop),
    call(Goal).

empty([start(0, 0, 0)]).

:- begin_tests(sim_start).

test(starts_each_shipped_world,
     [forall(member(World, [room, lights, line, grid, maze]))]) :-
    with_sim(World, sim_collisions([])).
test(shows_the_robot_of_the_paper) :-
    with_sim(room, findall(P-T, ( tacho_motor(P, T) ; lego_sensor(P, T) ), Devices)),
    Devices == [ outA-'lego-ev3-m-motor',
                 outB-'lego-ev3-l-motor',
                 outC-'lego-ev3-l-motor',
                 in1-'lego-ev3-us',
                 in2-'lego-ev3-color',
                 in3-'lego-ev3-color',
                 in4-'lego-ev3-gyro'
               ].
test(takes_another_robot) :-
    with_sim(room, [robot(touch)],
             ( touch_sensor(in4), touch(in4, 0), \+ gyro_sensor(_) )).
test(is_at_sys_class) :-
    with_sim(room, ev3_sysfs('/sys/class')).
test(replaces_the_one_that_runs) :-
    empty(World),
    with_sim(room, ( sim_start(World, [clock(virtual)]), sim_pose(X, Y, _) )),
    X =:= 0,
    Y =:= 0.
test(takes_a_file) :-
    with_file("start(3, 4, 90).\n", File,
              with_sim(File, sim_pose(X, Y, H))),
    X =:= 3,
    Y =:= 4,
    H =:= 90.
test(needs_no_suffix) :-
    with_file("start(3, 4, 90).\n", File,
              ( atom_concat(File, '.pl', Long),
                setup_call_cleanup(
                    copy_file(File, Long),
                    with_sim(File, sim_pose(_, _, _)),
                    delete_file(Long)) )).
test(takes_a_list_of_facts) :-
    with_sim([start(3, 4, 90)], sim_pose(3.0, 4.0, 90.0)).
test(takes_a_drawn_world) :-
    with_sim([map(20, ["#####", "#.>.#", "#####"])],
             sim_pose(50.0, 30.0, 90.0)).
test(takes_all_facts) :-
    with_sim([ bounds(-100, -100, 100, 100),
               wall(50, -50, 50, 50),
               wall(-50, -50, -50, 50, 2),
               box(0, 60, 20, 10),
               box(0, -60, 20, 10, 45),
               circle(70, 70, 5),
               floor(yellow),
               patch(blue, [[-9, -9], [9, -9], [9, 9], [-9, 9]]),
               line('#102030', 2, [[20, 20], [30, 30]]),
               lamp(10, 10, 12),
               ambient(3),
               start(0, 0, 0)
             ],
             [robot([ left_wheel(outB, 5.6, [inverted(false), slip(0.01)]),
                      right_wheel(outC, 5.6),
                      axle(10.6),
                      hull(rectangle(12, 18, 2)),
                      mass(0.75),
                      motor(outB, 'lego-ev3-l-motor'),
                      motor(outC, 'lego-ev3-l-motor'),
                      sensor(in1, 'lego-ev3-ir', 0, 7, 0),
                      sensor(in2, 'lego-ev3-color', 0, 6, 0),
                      noise(in1, 1, 0)
                    ])],
             col_color(in2, 2)).
test(fails_for_no_goal_without_a_simulation,
     [ forall(member(Goal, [ sim_stop, sim_pose(_, _, _), sim_place(0, 0, 0),
                             sim_add(circle(0, 0, 1)), sim_remove(1),
                             sim_plug(in1, 'lego-ev3-us'), sim_unplug(in1),
                             sim_jam(outA, true), sim_show(outA, state, x),
                             sim_unshow(outA, state), sim_wait(1),
                             sim_step(1), sim_time(_),
                             sim_snapshot(_), sim_collisions(_), sim_trace(_),
                             sim_svg('/dev/null'), sim_unmount
                           ])),
       fail
     ]) :-
    stopped(Goal).

test(no_such_world, error(existence_error(world, rome), _)) :-
    sim_start(rome).
test(no_such_robot, error(existence_error(robot, marvin), _)) :-
    sim_start(room, [robot(marvin)]).
test(unbound_world, error(instantiation_error, _)) :-
    sim_start(_).
test(no_such_clock, error(domain_error(clock, sand), _)) :-
    sim_start(room, [clock(sand)]).
test(clock_that_stands, error(domain_error(clock, scaled(0)), _)) :-
    sim_start(room, [clock(scaled(0))]).
test(seed_that_is_no_number, error(type_error(integer, corn), _)) :-
    sim_start(room, [seed(corn)]).
test(noise_that_is_no_boolean, error(type_error(_, loud), _)) :-
    sim_start(room, [noise(loud)]).
test(options_that_are_no_list, error(type_error(list, _), _)) :-
    sim_start(room, virtual).
test(a_refused_world_leaves_the_old_one) :-
    with_sim([start(3, 4, 0)],
             ( catch(sim_start([wal(0, 0, 1, 1)]), error(_, _), true),
               sim_pose(3.0, 4.0, _) )).

:- end_tests(sim_start).

:- begin_tests(sim_files).

%   The message that is printed for what is wrong in a file.
complaint(Text, Options, Formal, Message) :-
    with_file(Text, File,
              ( catch(sim_start(File, Options), error(Formal, Context), true),
                message_to_codes(error(Formal, Context), File, Message) )).

message_to_codes(Term, File, Message) :-
    message_to_lines(Term, Lines),
    with_output_to(string(Message0),
                   print_message_lines(current_output, '', Lines)),
    atomic_list_concat(Parts, File, Message0),
    atomic_list_concat(Parts, 'FILE', Message).

message_to_lines(Term, Lines) :-
    phrase('$messages':translate_message(Term), Lines).

says(Message, Part) :-
    (   sub_atom(Message, _, _, _, Part)
    ->  true
    ;   format(user_error, "~w~n", [Message]),
        fail
    ).

test(unknown_fact_with_file_and_line) :-
    complaint("start(1, 1, 0).\n\n  wal(0, 0, 1, 1).\n", [],
              Formal, Message),
    Formal == domain_error(world_fact, wal(0, 0, 1, 1)),
    says(Message, 'FILE:3:2: '),
    says(Message, 'a world has: bounds, wall, ').
test(fact_with_too_many_arguments) :-
    complaint("circle(0, 0, 1, 2).\n", [], Formal, Message),
    Formal == domain_error(world_fact, circle(0, 0, 1, 2)),
    says(Message, 'FILE:1:0: ').
test(robot_fact_in_a_world) :-
    complaint("start(1, 1, 0).\naxle(10).\n", [], Formal, Message),
    Formal == domain_error(world_fact, axle(10)),
    says(Message, 'FILE:2:0: ').
test(impossible_geometry) :-
    complaint("\nbox(30, 30, 0, 5).\n", [], Formal, Message),
    Formal == domain_error(possible_geometry, box(30, 30, 0, 5)),
    says(Message, 'FILE:2:0: '),
    says(Message, 'needs a width and a depth above 0').
test(start_inside_something) :-
    complaint("box(30, 30, 10, 10).\nstart(30, 30, 0).\n", [],
              Formal, Message),
    Formal = domain_error(possible_geometry, _),
    says(Message, 'FILE:2:0: '),
    says(Message, 'is inside ').
test(a_box_where_the_robot_starts_by_default) :-
    complaint("floor(red).\nbox(0, 0, 10, 10).\n", [], Formal, Message),
    Formal == domain_error(possible_geometry, box(0, 0, 10, 10)),
    says(Message, 'FILE:2:0: '),
    says(Message, 'robot at 0, 0 is inside box(0, 0, 10, 10, 0)').
test(two_starts_in_a_map) :-
    complaint("map(20, [\"\", \"S#\", \"v.\", \"^.\"]).\n", [], Formal, Message),
    Formal == domain_error(map_row, "v."),
    says(Message, 'FILE:1:0: '),
    says(Message, 'second start').
test(wrong_type) :-
    complaint("wall(0, 0, ten, 1).\n", [], Formal, Message),
    Formal == type_error(number, ten),
    says(Message, 'FILE:1:0: ').
test(no_such_colour) :-
    complaint("floor(mauve).\n", [], Formal, Message),
    Formal = domain_error(_, mauve),
    says(Message, 'FILE:1:0: ').
test(unknown_character_in_a_map) :-
    complaint("map(20, [\"##\", \"#X\"]).\n", [], Formal, Message),
    Formal = domain_error(map_row, "#X"),
    says(Message, 'FILE:1:0: '),
    says(Message, 'unknown character').
test(variable) :-
    complaint("wall(0, 0, X, 1).\n", [], Formal, Message),
    nonvar(Formal),
    says(Message, 'FILE:1:0: ').
test(a_directive_is_not_run) :-
    nb_setval(ran, no),
    complaint(":- nb_setval(ran, yes).\n", [], Formal, _),
    Formal = domain_error(world_fact, (:- _)),
    nb_getval(ran, no).
test(syntax_error) :-
    complaint("start(1, 1, 0).\nwall(0, 0.\n", [], Formal, Message),
    Formal = syntax_error(_),
    says(Message, 'FILE:2:').
test(a_world_must_be_text, error(domain_error(world_fact, 17), _)) :-
    sim_start([17]).

robot_complaint(Text, Formal, Message) :-
    with_file(Text, File,
              complaint("start(1, 1, 0).\n", [robot(File)], Formal, Message0, File)),
    Message = Message0.

complaint(World, Options, Formal, Message, File) :-
    with_file(World, WorldFile,
              ( catch(sim_start(WorldFile, Options), error(Formal, Context), true),
                message_to_codes(error(Formal, Context), File, Message) )).

test(unknown_robot_fact) :-
    robot_complaint("axle(10).\nwings(2).\n", Formal, Message),
    Formal == domain_error(robot_fact, wings(2)),
    says(Message, 'FILE:2:0: ').
test(axle_without_length) :-
    robot_complaint("mass(1).\naxle(-1).\n", Formal, Message),
    Formal = domain_error(possible_geometry, _),
    says(Message, 'FILE:2:0: ').
test(a_robot_without_parts, error(domain_error(possible_geometry, []), context(_, Why))) :-
    catch(sim_start([], [robot([])]), error(Formal, context(Where, Why)), true),
    says(Why, 'robot has no left_wheel, no right_wheel, no axle'),
    throw(error(Formal, context(Where, Why))).
test(a_robot_file_without_a_hull) :-
    robot_complaint("left_wheel(outB, 5).\nright_wheel(outC, 5).\naxle(9).\nmass(1).\n",
                    Formal, Message),
    Formal = domain_error(possible_geometry, _),
    says(Message, 'FILE: '),
    says(Message, 'robot has no hull').
test(unknown_motor) :-
    robot_complaint("mass(1).\nmotor(outA, steam).\n", Formal, Message),
    Formal = domain_error(possible_geometry, _),
    says(Message, 'FILE:2:0: ').
test(an_encoder_that_is_more_than_exact) :-
    robot_complaint("motor(outB, 'lego-ev3-l-motor').\nencoder_noise(outA, 1).\nencoder_noise(outB, -1).\n",
                    Formal, Message),
    Formal = domain_error(possible_geometry, _),
    says(Message, 'FILE:3:0: '),
    says(Message, 'must not be below 0').
test(encoder_noise_without_a_number) :-
    robot_complaint("mass(1).\nencoder_noise(outB).\n", Formal, Message),
    Formal == domain_error(robot_fact, encoder_noise(outB)),
    says(Message, 'FILE:2:0: '),
    says(Message, 'encoder_noise').
test(two_sensors_at_a_port) :-
    robot_complaint("sensor(in1, 'lego-ev3-us', 0, 7, 0).\nsensor(in1, 'lego-ev3-us', 0, 7, 90).\n",
                    Formal, Message),
    Formal = domain_error(possible_geometry, _),
    says(Message, 'FILE:2:0: ').

:- end_tests(sim_files).

:- begin_tests(sim_world).

test(place_moves_the_robot) :-
    with_sim([], ( sim_place(10*2, 5, 90), sim_pose(20.0, 5.0, 90.0) )).
test(place_inside_something, error(domain_error(possible_geometry, _), _)) :-
    with_sim([box(50, 50, 10, 10)], sim_place(50, 50, 0)).
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
test(a_hull_without_size, error(domain_error(robot_fact, hull(circle)), _)) :-
    with_sim([], [robot([hull(circle)])], true).
test(add_no_thing, error(domain_error(world_item, start(0, 0, 0)), _)) :-
    with_sim([], sim_add(start(0, 0, 0))).
test(svg_draws_it) :-
    with_file("", File,
              ( with_sim(room, sim_svg(File)),
                load_structure(File, [element(svg, _, [_|_])],
                               [dialect(xml), space(remove)]) )).
test(svg_in_no_directory, error(existence_error(_, _), _)) :-
    with_sim(room, sim_svg('/nowhere/demo.svg')).

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

:- begin_tests(sim_wait).

test(lets_time_pass_on_the_virtual_clock) :-
    with_sim([], ( sim_time(T0), sim_wait(60 * 60), sim_time(T) )),
    T - T0 >= 3600,
    T - T0 < 3601.
test(takes_its_time_on_another,
     [forall(member(Clock, [realtime, scaled(4)]))]) :-
    with_sim([], [clock(Clock)], ( sim_time(T0), sim_wait(0.2), sim_time(T) )),
    T - T0 >= 0.2.
test(several_threads_wait_at_once) :-
    with_sim([], ( findall(Id, ( member(S, [0.3, 0.1, 0.2]),
                                 thread_self(Me),
                                 thread_create(( sim_wait(S),
                                                 thread_send_message(Me, after(S)) ),
                                               Id, []) ), Ids),
                   findall(S, ( member(_, Ids), thread_get_message(after(S)) ), Ss),
                   forall(member(Id, Ids), thread_join(Id, true)) )),
    msort(Ss, [0.1, 0.2, 0.3]).
test(a_time_limit_gets_through, true(Ball == time_limit_exceeded)) :-
    with_sim([], [clock(realtime)],
             catch(call_with_time_limit(0.05, sim_wait(3600)), Ball, true)).
test(a_time_that_is_none_throws,
     [ forall(member(Goal-Error, [ sim_wait(-1)-domain_error(seconds, -1),
                                   sim_wait(_)-instantiation_error,
                                   sim_wait(soon)-type_error(evaluable, _) ])),
       error(Error, _) ]) :-
    with_sim([], Goal).

:- end_tests(sim_wait).

:- begin_tests(sim_time).

test(starts_at_0) :-
    with_sim([], ( sim_time(T), near(T, 0, 0.001) )).
test(step_passes) :-
    with_sim([], ( sim_step(1+1), sim_time(T), near(T, 2, 0.001) )).
test(step_back, error(domain_error(seconds, -1), _)) :-
    with_sim([], sim_step(-1)).
test(a_long_step_can_be_interrupted, true(E == time_limit_exceeded)) :-
    with_sim([], catch(call_with_time_limit(0.1, sim_step(1.0e9)), E, true)).
test(step_of_no_number, error(type_error(evaluable, _), _)) :-
    with_sim([], sim_step(long)).
test(virtual_time_stands_while_the_program_thinks) :-
    with_sim([], ( sim_time(T0), sleep(0.05), sim_time(T), T =:= T0 )).
test(virtual_time_passes_for_a_program_that_polls) :-
    with_sim([], ( motor_run(outA, 50),
                   polled_until(outA, 360),
                   sim_time(T) )),
    near(T, 1, 0.7).
test(several_threads_wait_at_once) :-
    with_sim([],
             ( thread_create(motor_run(outA, 50, 360), Id, []),
               motor_run(outB, 50, 360),
               thread_join(Id, Status),
               sim_time(T) )),
    Status == true,
    near(T, 1, 0.7).
test(real_time_passes_by_itself) :-
    with_sim([], [clock(realtime)],
             ( get_time(Before), sim_time(T0), sleep(0.1), sim_time(T), get_time(After) )),
    T - T0 > 0.09,
    T - T0 < After - Before + 0.01.
test(scaled_time_is_faster) :-
    with_sim([], [clock(scaled(50))],
             ( sim_time(T0), sleep(0.1), sim_time(T) )),
    T - T0 > 1.

polled_until(Port, Position) :-
    position(Port, P),
    (   P >= Position
    ->  true
    ;   polled_until(Port, Position)
    ).

test(a_wait_beside_a_thread_that_holds_the_clock_can_be_interrupted,
     throws(time_limit_exceeded)) :-
    with_sim(room,
             setup_call_cleanup(
                 ( thread_self(Me), thread_create(hold(Me), Id, []),
                   thread_get_message(holding)
                 ),
                 call_with_time_limit(0.2, sim_wait(1)),
                 ( thread_send_message(Id, done), thread_join(Id, _) ))).
test(steps_can_be_interrupted, throws(time_limit_exceeded)) :-
    with_sim(room, call_with_time_limit(0.2, sim_step(1.0e8))).

hold(Other) :-
    ev3dev_native:sim_hold_,
    thread_send_message(Other, holding),
    thread_get_message(done).

:- end_tests(sim_time).

:- begin_tests(sim_snapshot).

polls(Count) :-
    motor_run(outB, 20),
    motor_run(outC, -20),
    forall(between(1, Count, _),
           ( speed_sp(outB, 200),
             us_dist_cm(in1, _) )).

snapshots(Count, Snapshots) :-
    findall(Snapshot,
            ( between(1, Count, _), sim_snapshot(Snapshot) ),
            Snapshots).

%   The memory of this process in kB.
resident(KiloBytes) :-
    read_file_to_codes('/proc/self/status', Codes, []),
    atom_codes(Text, Codes),
    atomic_list_concat([_, Line|_], 'VmRSS:', Text),
    atomic_list_concat([Number|_], kB, Line),
    normalize_space(atom(Word), Number),
    atom_number(Word, KiloBytes).

test(restore_puts_everything_back) :-
    with_sim([],
             ( set_robot(5.6, 10.6, outB, outC),
               sim_snapshot(S),
               sim_time(T0),
               sim_pose(X0, Y0, H0),
               go_cm(30, 20),
               turn(20, 45),
               sim_pose(X, Y, _),
               X-Y \== X0-Y0,
               sim_restore(S),
               sim_pose(X0, Y0, H0),
               sim_time(T0),
               position(outB, 0) )).
test(may_be_restored_again_and_again) :-
    with_sim([],
             ( set_robot(5.6, 10.6, outB, outC),
               sim_snapshot(S),
               findall(Y, ( member(D, [10, 20, 30]),
                            sim_restore(S),
                            go_cm(30, D),
                            sim_pose(_, Y, _)
                          ),
                       [Y1, Y2, Y3]) )),
    near(Y1, 10, 0.5),
    near(Y2, 20, 0.5),
    near(Y3, 30, 0.5).
test(what_was_added_can_be_removed_after_a_restore) :-
    with_sim([],
             ( sim_snapshot(Empty),
               sim_add(circle(0, 50, 1)),
               sim_snapshot(A),
               sim_restore(Empty),
               sim_add(circle(50, 0, 1)),
               \+ sim_remove(circle(0, 50, 1)),
               sim_restore(A),
               \+ sim_remove(circle(50, 0, 1)),
               sim_remove(circle(0, 50, 1)) )).
test(what_is_plugged_in_after_a_restore_is_another_device,
     true(Type-Speed == 'lego-ev3-m-motor'-1560)) :-
    with_sim([],
             ( sim_snapshot(S),
               sim_plug(outD, 'lego-ev3-l-motor'),
               sim_step(2),
               max_speed(outD, 1050),
               sim_restore(S),
               sim_plug(outD, 'lego-ev3-m-motor'),
               sim_step(2),
               tacho_motor(outD, Type),
               max_speed(outD, Speed) )).
test(is_small_however_far_the_robot_has_driven,
     [ condition(exists_file('/proc/self/status')),
       true(Size < 40)
     ]) :-
    with_sim(room,
             ( polls(5000),
               snapshots(100, _),
               resident(Before),
               snapshots(500, Snapshots),
               resident(After),
               is_list(Snapshots) )),
    Size is (After - Before) / 500.
test(garbage_is_collected) :-
    with_sim(room,
             forall(between(1, 3000, _), sim_snapshot(_))),
    ev3dev_native:sim_snapshots_(Count),
    Count =< 2500.
test(restores_no_other_things, error(domain_error(simulator_snapshot, 1), _)) :-
    with_sim([], sim_restore(1)).
test(restores_nothing_unbound, error(instantiation_error, _)) :-
    with_sim([], sim_restore(_)).

:- end_tests(sim_snapshot).

:- begin_tests(sim_trace).

test(collisions_tell_when_and_where) :-
    with_sim([wall(-50, 30, 50, 30)],
             ( set_robot(5.6, 10.6, outB, outC),
               go(30),
               sim_step(3),
               sim_collisions([collision(Time, X, Y, Heading)|_]) )),
    near(Time, 1.5, 1),
    near(X, 0, 1),
    near(Y, 21.5, 0.5),
    near(Heading, 0, 2).
test(trace_is_in_the_order_of_time) :-
    with_sim([],
             ( set_robot(5.6, 10.6, outB, outC),
               go_cm(30, 20),
               us_dist_cm(in1, _),
               sim_trace(Trace) )),
    findall(T, member(T-_, Trace), Times),
    length(Trace, Length),
    length(Times, Length),
    msort(Times, Times),
    once(( member(_-written(Command, _), Trace),
           sub_atom(Command, _, _, 0, '/command') )),
    memberchk(_-read(Value, '2550'), Trace),
    sub_atom(Value, _, _, 0, '/value0'),
    memberchk(_-pose(_, _, _), Trace).

:- end_tests(sim_trace).

:- begin_tests(sim_chance).

readings(Seed, Noise, Readings) :-
    with_sim(room, [seed(Seed), noise(Noise)],
             findall(D, ( between(1, 20, _), sim_step(0.1), us_dist_cm(in1, D) ),
                     Readings)).

test(no_noise_by_default) :-
    readings(1, false, Readings),
    sort(Readings, [_]).
test(noise_differs_from_reading_to_reading) :-
    readings(1, true, Readings),
    sort(Readings, [_, _|_]).
test(the_same_seed_makes_the_same_noise) :-
    readings(7, true, Readings),
    readings(7, true, Readings).
test(another_seed_makes_other_noise) :-
    readings(7, true, Readings7),
    readings(8, true, Readings8),
    Readings7 \== Readings8.
test(encoders_err_if_asked_for, true(Wrong \== Right)) :-
    positions([], Right),
    positions([encoder_noise(outA, 2)], Wrong).
test(the_same_seed_makes_the_same_errors_of_encoders, true(A == B)) :-
    positions([encoder_noise(outA, 2)], A),
    positions([encoder_noise(outA, 2)], B).

%   What a motor shows that turns by a fixed duty.
positions(Errors, Positions) :-
    Robot = [ left_wheel(outB, 5.6), right_wheel(outC, 5.6), axle(10.6),
              hull(circle(8)), mass(0.75), motor(outA, 'lego-ev3-m-motor'),
              motor(outB, 'lego-ev3-l-motor'), motor(outC, 'lego-ev3-l-motor')
            | Errors ],
    with_sim([], [robot(Robot)],
             ( motor_attribute(outA, duty_cycle_sp, 20),
               command(outA, 'run-direct'),
               findall(Position,
                       ( between(1, 50, _), sim_step(0.02),
                         position(outA, Position) ),
                       Positions) )).

:- end_tests(sim_chance).

:- begin_tests(sim_mount).

test(mount_shows_the_files, [condition(can_mount)]) :-
    with_sim([],
             with_directory(Directory,
                 ( sim_mount(Directory),
                   atom_concat(Directory, '/tacho-motor/motor0/address', File),
                   exists_file(File),
                   sim_unmount,
                   \+ exists_file(File),
                   \+ sim_unmount ))).
test(a_program_that_ends_unmounts, [condition(can_mount)]) :-
    with_directory(Directory,
        ( format(atom(Goal), "sim_start(room), sim_mount(~q)", [Directory]),
          run_program(":- use_module(library(ev3dev/sim)).\n", [goal(Goal)],
                      Status, Output),
          Status-Output == exit(0)-"",
          directory_files(Directory, Files),
          msort(Files, ['.', '..']) )).
test(no_such_directory, error(existence_error(_, _), _)) :-
    with_sim([], sim_mount('/no/such/directory')).
test(ends_with_the_simulation_while_its_files_are_in_use,
     [ condition(can_mount),
       forall(member(End, [sim_stop, sim_start(room, [clock(virtual)])])) ]) :-
    with_directory(Directory,
        with_sim([],
                 ( sim_mount(Directory),
                   ev3_sysfs(Directory),
                   max_speed(outA, 1560),
                   End,
                   directory_files(Directory, Files),
                   msort(Files, ['.', '..']),
                   % For with_sim/2
                   sim_start(room) ))).
test(a_mode_can_be_written_though_time_stands_still,
     [condition(can_mount), true(Mode == "COL-COLOR\n")]) :-
    with_directory(Directory,
        with_sim([],
                 ( sim_mount(Directory),
                   atom_concat(Directory, '/lego-sensor/sensor1/mode', File),
                   setup_call_cleanup(open(File, write, Stream),
                                      write(Stream, 'COL-COLOR'),
                                      close(Stream)),
                   sim_step(0.1),
                   read_file_to_string(File, Mode, []),
                   sim_unmount ))).

:- end_tests(sim_mount).

:- begin_tests(sim_stop).

test(stop_is_the_end) :-
    sim_start(room, [clock(virtual)]),
    sim_stop,
    \+ sim_pose(_, _, _),
    \+ sim_stop.

test(another_directory_is_the_end) :-
    with_sim([], ( motor_run(outA, 20),
                   with_tree([outA-'lego-ev3-l-motor'],
                             ( \+ sim_pose(_, _, _),
                               \+ sim_stop,
                               tacho_motor(outA, 'lego-ev3-l-motor') )) )).
test(a_refused_directory_is_not) :-
    with_sim([], ( catch(ev3_sysfs('/nowhere'), error(existence_error(_, _), _), true),
                   sim_pose(_, _, _),
                   tacho_motor(outA) )).
test(a_mounted_one_goes_on_in_another_directory, [condition(can_mount)]) :-
    with_sim([],
             with_directory(Directory,
                 ( sim_mount(Directory),
                   ev3_sysfs(Directory),
                   max_speed(outA, 1560),
                   with_tree([], ( \+ tacho_motor(_), sim_pose(_, _, _) )),
                   ev3_sysfs(Directory),
                   max_speed(outA, 1560),
                   sim_unmount ))).
test(stop_goes_back_to_the_directory_in_use_before) :-
    with_tree([],
              ( ev3_sysfs(Directory),
                with_sim(room, ev3_sysfs('/sys/class')),
                ev3_sysfs(Directory) )).

:- end_tests(sim_stop).
