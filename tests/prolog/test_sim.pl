:- use_module('../support/simulation').
:- use_module('../support/trees', [with_tree/3]).
:- use_module(library(ev3dev/colors)).
:- use_module(library(ev3dev/drive)).
:- use_module(library(ev3dev/events)).
:- use_module(library(ev3dev/golog), []).
:- use_module(library(ev3dev/grid)).
:- use_module(library(ev3dev/plnxt), [nxt_goal/2, nxt_light/1, nxt_open/0]).
:- use_module(library(ev3dev/screen)).

stopped(Goal) :-
    ignore(sim_stop),
    call(Goal).

empty([start(0, 0, 0)]).

:- begin_tests(sim_start).
test(starts_each_shipped_world,
     [forall(member(World, [room, lights, line, grid, maze, sumo]))]) :-
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
    with_sim(room,
             ( touch_sensor(in4), touch(in4, 0), \+ gyro_sensor(_) ),
             [robot(touch)]).
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
               patch(blue, [-9-(-9), 9- -9, 9-9, [-9, 9]]),
               line('#102030', 2, [20-20, 30-30]),
               lamp(10, 10, 12),
               ambient(3),
               start(0, 0, 0)
             ],
             col_color(in2, 2),
             [robot([ left_wheel(outB, 5.6, [inverted(false), slip(0.01)]),
                      right_wheel(outC, 5.6),
                      axle(10.6),
                      hull(rectangle(12, 18, 2)),
                      mass(0.75),
                      motor(outB, 'lego-ev3-l-motor'),
                      motor(outC, 'lego-ev3-l-motor'),
                      sensor(in1, 'lego-ev3-ir', 0, 7, 0),
                      sensor(in2, 'lego-ev3-color', 0, 6, 0),
                      noise(in1, 1, 0),
                      sensor(in3, 'lego-ev3-us', 0, 7, 0),
                      echo(in3, [half_angle(20), incidence(40), miss(0.1),
                                 spurious(0.1)])
                    ])]).
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
                message_to_codes(error(Formal, Context), File, Message) )),
    assertion(\+ sub_atom(Message, _, _, _, 'expected, found')).

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
    says(Message, 'a world has: wall, box, ').
test(robots_without_a_start) :-
    complaint("bounds(0, 0, 99, 99).\nstart(anna, 50, 50, 0).\n",
              [robots([anna-default, bob-default])], Formal, Message),
    Formal = domain_error(possible_geometry, _),
    says(Message, 'FILE: FILE has no place for the robot bob: add start(bob, X, Y, Heading)').
test(fact_with_too_many_arguments) :-
    complaint("beacon(0, 0, 1, 2).\n", [], Formal, Message),
    Formal == domain_error(world_fact, beacon(0, 0, 1, 2)),
    says(Message, 'FILE:1:0: '),
    says(Message, 'beacon has 3 arguments').
test(robot_fact_in_a_world) :-
    complaint("start(1, 1, 0).\naxle(10).\n", [], Formal, Message),
    Formal == domain_error(world_fact, axle(10)),
    says(Message, 'FILE:2:0: ').
test(impossible_geometry) :-
    complaint("\nbox(30, 30, 0, 5).\n", [], Formal, Message),
    Formal == domain_error(possible_geometry, box(30, 30, 0, 5)),
    says(Message, 'FILE:2:0: '),
    says(Message, 'FILE:2:0: box(30,30,0,5) needs a width and a depth above 0').
test(bounds_that_are_too_far) :-
    complaint("bounds(0, 0, 10000000, 10).\n", [], _, Message),
    says(Message, 'has a number beyond 1000000').
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
    says(Message, 'FILE:2:0: box(0,0,10,10): robot at 0, 0 is inside box(0, 0, 10, 10, 0)').
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
    Formal == domain_error(color, mauve),
    says(Message, 'FILE:1:0: '),
    says(Message, 'mauve is not one of: black, blue').
test(unknown_character_in_a_map) :-
    complaint("map(20, [\"##\", \"#X\"]).\n", [], Formal, Message),
    Formal = domain_error(map_row, "#X"),
    says(Message, 'FILE:1:0: '),
    says(Message, 'unknown character').
test(variable) :-
    complaint("wall(0, 0, X, 1).\n", [], Formal, Message),
    nonvar(Formal),
    says(Message, 'FILE:1:0: ').
test(options_in_the_place_of_a_number,
     [ forall(member(Fact-Words,
                     [ "box(9, 9, 2, 2, [mass(1)])"-
                       'Heading must be a number, not a list: \
box(X, Y, Width, Depth, Heading, Options)',
                       "circle(9, 9, [mass(1)])"-
                       'Radius must be a number, not a list: \
circle(X, Y, Radius, Options)',
                       "wall(0, 9, 5, 9, [color(red)])"-
                       'Thickness must be a number, not a list: \
wall(X1, Y1, X2, Y2, Thickness)' ])) ]) :-
    string_concat(Fact, ".\n", Text),
    complaint(Text, [], Formal, Message),
    Formal = type_error(number, [_|_]),
    says(Message, Words).
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
test(each_wrong_robot_fact_is_explained,
     [ forall(member(Fact-Words,
                     [ "left_wheel(outB, 5, [inverted(maybe)])"-'true or false',
                       "left_wheel(outB, 5, [inverted(_)])"-'a variable without a value',
                       "left_wheel(outB, 5, [grip(1)])"-'inverted(Boolean), slip(Share)',
                       "left_wheel(outB)"-'left_wheel has 2 or 3 arguments',
                       "hull(box(1))"-'circle(Radius), rectangle(Width',
                       "mass(x)"-'a number is expected, not x',
                       "motor(outB, steam)"-'is of no known type',
                       "motor(outB, steam)"-'; there are: lego-ev3-l-motor, ',
                       "sensor(in1, 'lego-ev3-uss', 0, 0, 0)"-': lego-ev3-us' ])) ]) :-
    atomics_to_string(["mass(1).\n\n", Fact, ".\n"], Text),
    robot_complaint(Text, _, Message),
    says(Message, 'FILE:3:0: '),
    says(Message, Words),
    \+ sub_atom(Message, _, _, _, ' { ').
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
atomics_to_string(Atomics, Text) :-
    atomic_list_concat(Atomics, Atom),
    atom_string(Atom, Text).

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
test(an_impossible_echo,
     [ forall(member(Option, [ half_angle(61), incidence(0), miss(-1),
                               spurious(1.1) ])),
       throws(error(domain_error(possible_geometry,
                                 echo(in1, [Option])), _)) ]) :-
    with_sim([], true,
             [robot([sensor(in1, 'lego-ev3-us', 0, 0, 0),
                     echo(in1, [Option])])]).
test(an_unknown_echo_option,
     throws(error(domain_error(echo_option, louder(2)), _))) :-
    with_sim([], true,
             [robot([sensor(in1, 'lego-ev3-us', 0, 0, 0),
                     echo(in1, [louder(2)])])]).
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

:- begin_tests(stationary).
%   A gripper on an arm, with a color sensor, in a place of the world.
arm([ motor(outA, 'lego-ev3-m-motor', [stops(-30, 90)]),
      motor(outB, 'lego-ev3-l-motor', [stops(0, 720.5)]),
      motor(outD, 'lego-ev3-l-motor'),
      sensor(in1, 'lego-ev3-us', 0, 7, 0),
      sensor(in2, 'lego-ev3-color', 0, 0, 0),
      sensor(in3, 'ht-nxt-angle', 0, 0, 0),
      sensor(in4, 'lego-ev3-gyro', 0, 0, 0)
    ]).

:- meta_predicate with_arm(0).

with_arm(Goal) :-
    arm(Arm),
    with_sim([ start(30, 20, 90), floor(red), circle(60, 20, 3) ], Goal, [robot(Arm)]).

test(a_robot_without_wheels_has_its_devices, true(Ports == Expected)) :-
    Expected = [outA, outB, outD, in1, in2, 'in3:i2c1', in4],
    with_arm(findall(P, ( tacho_motor(P) ; lego_sensor(P) ), Ports)).
test(it_stands_at_its_start_whatever_turns) :-
    with_arm(( motor_run(outD, 50, 720), sim_pose(X, Y, H), sim_collisions(Hits),
               gyro_ang(in4, Angle) )),
    X-Y-H =:= 30-20-90,
    Hits == [],
    Angle =:= 0.
test(sensors_measure_from_there, true(Color-Distance == 5-20.0)) :-
    with_arm(( col_color(in2, Color), us_dist_cm(in1, Distance) )).
test(a_hand_can_move_it) :-
    with_arm(( sim_place(0, 0, 0), sim_pose(X, Y, H), motor_run(outD, 50, 90) )),
    X-Y-H =:= 0-0-0.
test(it_can_be_drawn) :-
    with_arm(( tmp_file(arm, File), sim_svg(File), exists_file(File), delete_file(File) )).
test(it_can_be_saved_and_restored) :-
    with_arm(( sim_snapshot(S), motor_run(outD, 50, 90), sim_restore(S), position(outD, P) )),
    P =:= 0.
test(a_motor_stalls_at_its_stop_in_that_direction_only, true(Reason == stalled)) :-
    with_arm(( motor_run(outA, 30, 200, [wait(false)]),
               motor_wait([outA], [timeout(10)], Reason), position(outA, Max),
               motor_stop(outA),
               motor_run(outA, 30, -60), position(outA, Less),
               motor_run(outA, -30), motor_wait(outA, [timeout(10)], _),
               position(outA, Min) )),
    near(Max, 90, 1),
    near(Less, 30, 3),
    near(Min, -30, 1).
test(a_stop_at_the_start_blocks_at_once, true(Reason == stalled)) :-
    with_arm(( motor_run(outB, -20), motor_wait(outB, [timeout(10)], Reason), position(outB, P) )),
    near(P, 0, 1).
test(a_move_that_ends_before_a_stop_is_as_without, true(A-B == C-D)) :-
    with_arm(( motor_run(outB, 40, 360), position(outB, A), sim_time(B) )),
    with_arm(( motor_run(outD, 40, 360), position(outD, C), sim_time(D) )).
test(a_robot_that_drives_may_have_an_arm, true(Reason == stalled)) :-
    with_sim([], ( motor_run(outA, 30), motor_wait(outA, [timeout(10)], Reason),
                   set_robot(5.6, 10.6, outB, outC), go_cm(30, 20), sim_pose(_, Y, _) ),
             [robot([ left_wheel(outB, 5.6), right_wheel(outC, 5.6), axle(10.6),
                      hull(circle(8)), mass(0.75),
                      motor(outA, 'lego-ev3-m-motor', [stops(-5, 90)]),
                      motor(outB, 'lego-ev3-l-motor'), motor(outC, 'lego-ev3-l-motor', []) ])]),
    near(Y, 20, 1).
test(its_hull_is_one_it_is_given, error(domain_error(possible_geometry, _), _)) :-
    with_sim([start(0, 0, 0), circle(0, 30, 3)], true,
             [robot([motor(outA, 'lego-ev3-l-motor'), hull(circle(40))])]).
test(what_is_no_stop_is_explained,
     [ forall(member(Options-Words,
                     [ [stops(10, 90)]-'stops(Min, Max) with Min =< 0 =< Max',
                       [stops(0, 0)]-'stops(Min, Max) with Min =< 0 =< Max',
                       [stops(a, 90)]-'a number is expected, not a',
                       [stop(0, 90)]-'is not one of: stops(Min,Max)',
                       [stops(0, _)]-'variable',
                       x-'a list is expected' ])) ]) :-
    catch(sim_start([], [robot([motor(outA, 'lego-ev3-l-motor', Options)])]),
          error(Formal, Context), true),
    message_to_lines(error(Formal, Context), Lines),
    with_output_to(string(Message), print_message_lines(current_output, '', Lines)),
    once(sub_string(Message, _, _, _, Words)).
test(no_stops_for, [ forall(member(Robot,
                            [ [motor(outA, 'act-l12-ev3-50', [stops(0, 90)])],
                              [ left_wheel(outB, 5.6), right_wheel(outC, 5.6), axle(10.6),
                                hull(circle(8)), mass(0.75),
                                motor(outB, 'lego-ev3-l-motor', [stops(0, 90)]),
                                motor(outC, 'lego-ev3-l-motor') ] ])),
                     error(domain_error(possible_geometry, motor(_, _, _)), _) ]) :-
    sim_start([], [robot(Robot)]).
test(half_a_chassis_is_none, true(Words == 'robot has no right_wheel, no axle, no hull, no mass')) :-
    catch(sim_start([], [robot([ left_wheel(outB, 5.6), motor(outB, 'lego-ev3-l-motor') ])]),
          error(_, context(_, Words)), true).

message_to_lines(Term, Lines) :-
    phrase('$messages':translate_message(Term), Lines).
:- end_tests(stationary).

:- begin_tests(with_sim_starts_from_nothing).
%   What a program leaves behind, and what shows it.
left(set_robot(5.6, 10.6, outB, outC), robot(_, _, _, _)).
left(drive_option(speed, 70), ( drive_option(speed, Speed), Speed =:= 70 )).
left(( robot, set_grid([cell_cm(30)]) ), state_position(_, _)).
left(( robot, set_grid([]), obstacle_add([1,1]) ), obstructed(_)).
left(ev3dev_grid_knowledge:saw_free([1,1]), ev3dev_grid_knowledge:known_free(_)).
left(every(1, true), event(_, _)).
left(every(1, true), ( every(1, true), event(1, every) )).
left(( gray, col_white(in2) ), ( gray, col_rgb(in2, rgb(100, 100, 100)) )).
left(screen_rectangle(0, 0, 178, 128, [fill(true)]),
     ( screen_show, screen_file(Black), screen_clear, screen_show, screen_file(White),
       Black \== White )).
left(( nxt_open, nxt_light(V, force) ), ( sim_show(in2, value0, 55), nxt_light(V) )).
left(nxt_open, catch(nxt_goal(nxt, true), error(existence_error(_, _), _), fail)).
left(( assertz(user:exog_action(1)), ev3dev_golog_world:send_exogenous(user, 1),
       retract(user:exog_action(1)) ),
     ( ev3dev_golog_world:queue_of(user, Queue), message_queue_property(Queue, size(1)) )).

robot :-
    set_robot(5.6, 10.6, outB, outC).

gray :-
    forall(member(Value, [value0, value1, value2]), sim_show(in2, Value, 200)).

screen_file(Bytes) :-
    tmp_file(screen, File),
    setup_call_cleanup(
        screen_png(File),
        setup_call_cleanup(open(File, read, In, [type(binary)]),
                           read_stream_to_codes(In, Bytes),
                           close(In)),
        delete_file(File)).

test(what_it_knows_is_known, forall(left(Leave, Shows))) :-
    with_sim(room, ( Leave, once(Shows) )).
test(what_a_test_knew_is_not_known_to_the_next, [forall(left(Leave, Shows)), fail]) :-
    with_sim(room, Leave),
    with_sim(room, Shows).
test(what_was_known_before_is_known_again,
     [ forall(left(Leave, Shows)), true(In-After == false-true) ]) :-
    with_sim(room,
             ( Leave,
               with_sim(room, holds(Shows, In)),
               sim_start(room, [clock(virtual)]),
               holds(Shows, After) )).
test(also_after_an_error, true(Robot == 5.6)) :-
    with_sim(room,
             ( robot,
               catch(with_sim(room, ( set_robot(3, 9, outB, outC), throw(oops) )),
                     oops, true),
               catch(with_sim([wal(1)], true), error(_, _), true),
               robot(Robot, _, _, _) )).
test(an_event_of_before_does_not_happen, true(Count-Again == 0-true)) :-
    nb_setval(happened, 0),
    with_sim(room,
             ( every(1, ( nb_getval(happened, N0), N is N0 + 1, nb_setval(happened, N) ),
                     [id(old)]),
               with_sim(room, wait(5)),
               nb_getval(happened, Count),
               sim_start(room, [clock(virtual)]),
               wait(5),
               nb_getval(happened, After),
               holds(After > 0, Again),
               event_cancel(old) )).
% Ticks let a wait look more often, and each look takes time.
test(takes_as_long_as_without_an_event_of_before, true(Time == Time0)) :-
    with_sim(room, drive_time(Time0)),
    with_sim(room,
             ( every(1, true, [id(old)]),
               with_sim(room, drive_time(Time)),
               event_cancel(old) )).

drive_time(Time) :-
    robot,
    go_cm(30, 20),
    sim_time(Time).

holds(Goal, Holds) :-
    (   \+ \+ Goal
    ->  Holds = true
    ;   Holds = false
    ).
:- end_tests(with_sim_starts_from_nothing).

:- begin_tests(sim_chance).
readings(Seed, Noise, Readings) :-
    with_sim(room,
             findall(D, ( between(1, 20, _), sim_step(0.1), us_dist_cm(in1, D) ),
                     Readings),
             [seed(Seed), noise(Noise)]).

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
test(a_robot_keeps_its_own_errors, Readings == [10.0]) :-
    heard([circle(0, 20, 10)], [noise(in1, 0, 0)], [noise(true)], Readings).
test(a_slanted_wall_sends_no_echo_beyond_its_incidence,
     At40-At50 == [255.0]-Always) :-
    maplist(slanted, [40, 50, 90], [At40, At50, Always]).
test(what_a_slanted_wall_hides_is_not_heard, Readings == [255.0]) :-
    heard([wall(-50, -30, 50, 70), wall(-50, 40, 50, 40)],
          [echo(in1, [half_angle(0), incidence(40)])], [], Readings).
test(a_wider_cone_hears_what_is_aside, Narrow-Wide == [255.0]-true) :-
    heard([circle(20, 40, 3)], [], [], Narrow),
    heard([circle(20, 40, 3)], [echo(in1, [half_angle(30)])], [], [D]),
    (   D < 45
    ->  Wide = true
    ;   Wide = D
    ).
test(echoes_are_missed_and_made_up, Counts == true) :-
    heard([wall(-50, 100, 50, 100)],
          [echo(in1, [miss(0.2), spurious(0.3)])], [], 300, Readings),
    aggregate_all(count, member(255.0, Readings), Missed),
    aggregate_all(count, ( member(D, Readings), D < 99 ), Nearer),
    aggregate_all(count, ( member(D, Readings), D < 20 ), Near),
    (   abs(Missed-60) < 25,
        abs(Nearer-90) < 30,
        Near > 5
    ->  Counts = true
    ;   Counts = [Missed, Nearer, Near]
    ).
test(encoders_err_if_asked_for, true(Wrong \== Right)) :-
    positions([], Right),
    positions([encoder_noise(outA, 2)], Wrong).
test(the_same_seed_makes_the_same_errors_of_encoders, true(A == B)) :-
    positions([encoder_noise(outA, 2)], A),
    positions([encoder_noise(outA, 2)], B).

%   The wall is met at 45 degrees.
slanted(Incidence, Readings) :-
    heard([wall(-50, -30, 50, 70)],
          [echo(in1, [half_angle(0), incidence(Incidence)])], [], Readings).

%   What a sonar at 0, 0 hears ahead, a list without doubles, or of Count
%   readings.
heard(World, Facts, Options, Readings) :-
    heard(World, Facts, Options, 20, Readings0),
    sort(Readings0, Readings).

heard(World, Facts, Options, Count, Readings) :-
    with_sim([start(0, 0, 0)|World],
             findall(D,
                     ( between(1, Count, _), sim_step(0.1),
                       us_dist_cm(in1, D) ),
                     Readings),
             [robot([sensor(in1, 'lego-ev3-us', 0, 0, 0)|Facts])|Options]).

%   What a motor shows that turns by a fixed duty.
positions(Errors, Positions) :-
    Robot = [ left_wheel(outB, 5.6), right_wheel(outC, 5.6), axle(10.6),
              hull(circle(8)), mass(0.75), motor(outA, 'lego-ev3-m-motor'),
              motor(outB, 'lego-ev3-l-motor'), motor(outC, 'lego-ev3-l-motor')
            | Errors ],
    with_sim([],
             ( motor_attribute(outA, duty_cycle_sp, 20),
               command(outA, 'run-direct'),
               findall(Position,
                       ( between(1, 50, _), sim_step(0.02),
                         position(outA, Position) ),
                       Positions) ),
             [robot(Robot)]).

%   What the program itself draws.
drawn(Options, Numbers) :-
    with_sim([], numbers(Numbers), Options).

numbers([X, Y, Z]) :-
    random(X),
    random_between(1, 1000000, Y),
    Z is random(1000000).

test(the_same_seed_draws_the_same_numbers, true(A == B)) :-
    drawn([seed(7)], A),
    drawn([seed(7)], B).
test(another_seed_draws_other_numbers, true(A \== B)) :-
    drawn([seed(7)], A),
    drawn([seed(8)], B).
test(a_negative_seed_is_one_too, true(A == B)) :-
    drawn([seed(-7)], A),
    drawn([seed(-7)], B).
test(without_a_seed_it_is_1, true(A == B)) :-
    drawn([], A),
    drawn([seed(1)], B).
test(afterwards_numbers_go_on_as_before, true(After == Numbers)) :-
    set_random(seed(5)),
    numbers(Numbers),
    set_random(seed(5)),
    with_sim([], ( numbers(_), with_sim([], numbers(_), [seed(9)]) )),
    numbers(After).
test(also_if_the_program_has_left_the_simulation, true(After == Numbers)) :-
    set_random(seed(5)),
    numbers(Numbers),
    set_random(seed(5)),
    with_sim([], with_tree(plain, [], numbers(_))),
    numbers(After).
test(a_wall_clock_leaves_them_alone, true(After == Numbers)) :-
    set_random(seed(5)),
    numbers(Numbers),
    set_random(seed(5)),
    with_sim([], numbers(After), [clock(realtime)]).
test(a_wall_clock_with_a_seed_does_not, true(A == B)) :-
    drawn([clock(realtime), seed(7)], A),
    drawn([seed(7)], B).
test(goals_side_by_side_draw_the_same_numbers,
     [ condition(current_predicate(engine_create/3)), true(A == B) ]) :-
    side_by_side(A),
    side_by_side(B).

side_by_side([A, B]) :-
    with_sim([], both(( wait(0.1), numbers(A) ), numbers(B)), [seed(7)]).
:- end_tests(sim_chance).

:- begin_tests(sim_screen).
test(no_such_depth, error(domain_error(screen_bits, 16), _)) :-
    sim_start(room, [screen(16)]).
test(depth_that_is_no_number, error(type_error(integer, deep), _)) :-
    sim_start(room, [screen(deep)]).
test(its_layout_is_told_beside_the_motors,
     [ forall(member(Bits-Stride, [32-712, 1-24])),
       true(Read == ['178,128', Bits, Stride])
     ]) :-
    with_sim(room,
             findall(Value,
                     ( member(Name, [virtual_size, bits_per_pixel, stride]),
                       atom_concat('/sys/class/graphics/fb0/', Name, File),
                       file_read(File, Value)
                     ),
                     Read),
             [screen(Bits)]).
:- end_tests(sim_screen).

:- begin_tests(sim_stop).
test(stop_is_the_end) :-
    sim_start(room, [clock(virtual)]),
    sim_stop,
    \+ sim_pose(_, _, _),
    \+ sim_stop.

test(another_directory_is_the_end) :-
    with_sim([], ( motor_run(outA, 20),
                   with_tree(plain, [outA-'lego-ev3-l-motor'],
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
                   with_tree(plain, [], ( \+ tacho_motor(_), sim_pose(_, _, _) )),
                   ev3_sysfs(Directory),
                   max_speed(outA, 1560),
                   sim_unmount ))).
test(stop_goes_back_to_the_directory_in_use_before) :-
    with_tree(plain, [],
              ( ev3_sysfs(Directory),
                with_sim(room, ev3_sysfs('/sys/class')),
                ev3_sysfs(Directory) )).
:- end_tests(sim_stop).
