% Errors of the libraries beside library(ev3dev) name what was called, and say
% what would be right. (Those of library(ev3dev) itself: test_bad_input.pl.)

:- use_module('../support/libraries').
:- use_module('../support/simulation').
:- use_module(library(ev3dev/private/help/help_index), []).
:- use_module(library(ev3dev/console)).
:- use_module(library(ev3dev/drive)).
:- use_module(library(ev3dev/golog)).
:- use_module(library(ev3dev/pddl)).
:- use_module(library(ev3dev/grid)).
:- use_module(library(ev3dev/gripper)).
:- use_module(library(ev3dev/jog)).
:- use_module(library(ev3dev/journal)).
:- use_module(library(ev3dev/reasoning)).
:- use_module(library(ev3dev/plnxt)).
:- use_module(library(ev3dev/raw)).
:- use_module(library(ev3dev/planners)).
:- use_module(library(ev3dev/roadmap)).
:- use_module(library(ev3dev/bricks)).
:- use_module(library(ev3dev/sim_batch)).
:- use_module(library(ev3dev/sim_fenced)).
:- use_module(library(ev3dev/random_worlds)).
:- use_module(library(ev3dev/exercise)).
:- use_module(library(ev3dev/grid_belief)).
:- use_module(library(ev3dev/localize)).
:- use_module(library(ev3dev/map)).
:- use_module(library(ev3dev/layers)).
:- use_module(library(ev3dev/rules)).
:- use_module(library(ev3dev/view)).

% A call, and its wrong, unbound and impossible arguments: each is tried alone.
bad(go_cm(30, 10, []), [foo-1, _-1, 101-none, foo-2, _-3, [sped(5)]-3, [wait(1)]-3]).
bad(turn(30, 90, []), [foo-1, _-2, a-3, [radius(1)]-3]).
bad(arc_cm(30, 10, 90), [foo-1, _-2, far-3]).
bad(arc_cm(30, 10, 90, []), [foo-1, _-2, far-3, x-4]).
bad(arc(30, 10), [foo-1, _-2]).
bad(arc(30, 10, []), [foo-1, _-2, [x]-3]).
bad(steer(30, 10), [foo-1, _-2, 101-2]).
bad(steer(30, 10, []), [foo-1, 101-2, [x]-3]).
bad(drive_cm(10, 0), [foo-1, _-2]).
bad(drive_cm(10, 0, []), [foo-1, _-2, [wait]-3]).
bad(go_to(10-10), [far-1, _-1, point(1, 2)-1]).
bad(go_to(10, 10), [far-1, _-2]).
bad(go_to(10, 10, []), [far-1, _-2, north-3, [x(1)]-3]).
bad(go_to(10, 10, 0, []), [far-1, _-2, north-3, [x(1)]-4]).
bad(face(0), [north-1, _-1]).
bad(face(0, []), [north-1, _-1, [sped(5)]-2]).
bad(follow([]), [a-1, _-1, [a]-1]).
bad(follow([], []), [a-1, _-1, [radius(-1)]-2, [raduis(1)]-2]).
bad(set_pose(0, 0, 0), [a-1, _-2, a-3]).
bad(heading_wrapped(0, _), [a-1, _-1]).
bad(drive_option(speed, 30), [color-1, _-1, 0-2]).
bad(drive_wait([], _), [a-1, [wait(true)]-1, [timeout(-1)]-1]).
bad(jog([]), [[sped(5)]-1, [speed(0)]-1, [speed(fast)]-1]).
bad(set_gripper(outA, []), [5-1, [closes(up)]-2, [turn(0)]-2, [speed(3)]-2]).
bad(i2c_read(in1, 0, 8, _), [7-1, _-1, a-2, _-2, 255-2, -1-2, 0-3, 33-3, a-3, _-3]).
bad(i2c_write(in1, 0, [1]), [7-1, _-1, a-2, _-2, 255-2, []-3, a-3, _-3, [a]-3, [_]-3, [256]-3, [-1]-3]).
bad(analog_voltage(in1, _), [7-1]).
bad(because(true, why), [7-1, _-1, _-2]).
bad(why(outB), [7-1, _-1]).
bad(why(outB, _), [7-1, _-1]).
bad(journal(_), [7-1, f(x)-1]).
bad(reasoning(true), [7-1, _-1]).
bad(reasoning(true, []), [7-1, _-1, [megabyte(1)]-2, [megabytes(0)]-2]).
bad(reasoning_text(_), [7-1, f(x)-1]).
bad(journal_replay(nowhere), [7-1, _-1, nowhere-1]).
bad(screen_format("~w", [a]), [_-1]).
bad(calibrate(axle, [], _), [all-1, _-1, [turn(5)]-2, [turns(0)]-2]).
bad(set_grid([]), [a-1, [neighbors(5)]-1, [colour(red)]-1]).
bad(golog([], []), [_-1, fly-1, [limt(3)]-2, [limit(-1)]-2, [gexec(x)]-2]).
bad(golog_exog(x), [_-1]).
bad(pddl_domain(x), [_-1, nix-1, 7-1]).
bad(pddl_problem(x), [_-1, nix-1, 7-1]).
bad(pddl_write(x), [_-1]).
bad(why_not(x), [_-1, off(_)-1]).
bad(why_not(x, _), [_-1]).
bad(do([], _), [_-1, fly-1]).
bad(do([], [], _), [_-1, fly-1, a-2, [_]-2]).
bad(trans([], [], _, _), [_-1, fly-1, a-2]).
bad(final([], []), [_-1, a-2]).
bad(holds(true, []), [_-1, 7-1, wet(1)-1, a-2]).
bad(has_val(f, _, []), [_-1, a-3]).
bad(eval(true, [], _), [_-1, a-2]).
bad(get_integer(1, _, 3), [a-1, _-1, a-2, a-3, _-3]).
bad(pathfind(a, b, _), [_-1, _-2]).
bad(domain(_, [1]), [_-2, 1-2]).
bad(rdomain(_, [1]), [_-2, 1-2]).
bad(getdomain([1], _), [_-1, 1-1]).
bad(shuffle([], _), [a-1, _-1]).
bad(ask_execute(a, _), [_-1]).
bad(sendRcxActionNumber(1, _), [_-1]).
bad(roadmap_path([], 0-0, 10-10, _), [a-1, foo-2, foo-3, _-3]).
bad(roadmap_path([], 0-0, 10-10, _, []), [a-1, foo-2, foo-3, [speed(1)]-5, [method(x)]-5]).
bad(view([]), [a-1, _-1, [port(0)]-1, [port(x)]-1, [address(all)]-1, [token(short)]-1,
               [token('not a token')]-1, [open(maybe)]-1, [rate(0)]-1, [rate(fast)]-1,
               [goals(1)]-1, [goals(true), address(any)]-1, [colour(red)]-1]).
bad(view_mark(a), [_-1]).
bad(view_watch(a, outA), [_-1, _-2, outE-2, outA-value0-2, 7-2]).
bad(view_value(a, 1), [_-1, _-2, high-2]).
bad(brick_open(anna, sim), [_-1, 7-1, local-1, _-2, mars-2, dir('/nowhere')-2, sim(nowhere)-2, sim(room, [colour(red)])-2]).
bad(brick_close(anna), [_-1, 7-1, anna-1, local-1]).
bad(with_brick(local, true), [_-1, 7-1, anna-1, 7-2, _-2]).
bad(use_brick(local), [7-1, anna-1]).
bad(bricks_do(true), [_-1, 7-1]).
bad(robots_join(redis(localhost)), [_-1, 7-1, redis(1)-1]).
bad(robot_send(local, x), [_-1, 7-1, anna-1]).
bad(robot_receive(_, _, [timeout(0)]), [[timeout(-1)]-3, [until(1)]-3, a-3]).
bad(bricks_do([local], true), [_-1, anna-1, [anna]-1, [_]-1, _-2, 7-2]).
bad(sim_batch(nofile, a, [1], _), [_-1, _-2, 7-2, a-3, [a]-3, _-3]).
bad(grid_sense(0, belief(none, []), _), [_-1, a-1, -1-1]).
bad(grid_motion(move, belief(none, []), _), [_-1, jump-1]).
bad(grid_localize(map(bounds(0, 0, 0, 0), 4, none, t, any, none), _, []),
    [_-3, [sure(a)]-3, [actions(-1)]-3, [cell_cm(0)]-3, [speed(0)]-3, [soon(1)]-3]).
bad(localize_start(room), [_-1, nowhere-1]).
bad(localize_start(room, []), [_-1, _-2, [seeds(1)]-2]).
bad(localize_scan([]), [_-1, [turn(1)]-1]).
bad(map_start([]), [_-1, [x(1)]-1]).
bad(map_occupancy(0, 0, _), [_-1, far-2]).
bad(explore([]), [_-1, [x(1)]-1]).
bad(sim_fenced(nofile, _), [_-1]).
bad(sim_fenced(nofile, _, []), [_-1, [seed(1)]-3, [sleep(a)]-3, [seconds(-1)]-3, [cpu(a)]-3, [goal(1)]-3]).
bad(random_room(1, [], _), [_-1, a-1, _-2, [size(3)]-2, [boxes(2-1)]-2, [things(a)]-2, [box(1)]-2]).
bad(random_grid(1, [], _), [_-1, a-1, [size(3)]-2, [boxes(a)]-2, [things(-1)]-2, [cell(0)]-2]).
bad(random_maze(1, [], _), [_-1, a-1, [size(3)]-2, [cell(-1)]-2, [x(1)]-2]).
bad(random_track(1, [], _), [_-1, a-1, [radius(0)]-2, [wave(a)]-2, [x(1)]-2]).
bad(exercise_mark(nofile, [], [], _), [_-1, a-2, [seed(1)]-3]).
bad(exercise_try(nofile, nofile, []), [_-1, [out(1)]-3]).
bad(exercise_check(nofile), [_-1]).
bad(exercise_check(nofile, []), [_-1, [out(1)]-2]).
bad(time_to(0-0, _), [_-1, far-1]).
bad(time_to(0-0, 10, _), [_-1, far-1, _-2, 0-2]).
bad(ended_near(0-0, _), [_-1, far-1]).
bad(cells_visited(30, _), [_-1, 0-1, a-1]).
bad(lap_fraction(5, _), [_-1, 0-1]).
bad(thing_in(cube, [0-0, 1-0, 0-1]), [_-2, far-2, [0-0, 1-0]-2, circle(0, 0, 0)-2]).
bad(printed(a), [_-1, f(x)-1]).
bad(sim_batch_work(localhost, 1), [_-1, 7-1, _-2, a-2, 0-2]).
bad(sim_batch(nofile, a, [1], _, []), [_-1, [redis(1)]-5, [workers(0)]-5, [wall(-1)]-5, [cpu(a)]-5, [seed(1)]-5, [progress(1)]-5]).
bad(sim_start(room, []), [nowhere-1, _-1, [clock(slow)]-2, [colour(red)]-2]).
bad(sim_place(0, 0, 0), [a-1, _-2, a-3]).
bad(sim_plug(in1, 'lego-ev3-us'), [1-1, in1-2, _-2]).
bad(sim_jam(outA, true), [1-1, in1-1, 7-2]).
bad(sim_wait(0.1), [a-1, _-1, -1-1]).
bad(with_sim([], true), [nowhere-1, 7-2, _-2]).
bad(with_sim([], true, []), [nowhere-1, 7-2, x-3, [colour(red)]-3]).
bad(sim_at(1, true), [a-1, _-1, -1-1, 7-2, _-2]).
bad(for_seconds(1, true), [a-1, _-1, -1-1, 7-2, _-2]).
bad(sim_press(in4, []), [outA-1, [soon]-2]).
bad(sim_step(0.1), [a-1, _-1, -1-1]).
bad(sim_press(enter), [space-1, _-1]).
bad(sim_press(enter, []), [space-1, [soon]-2]).
bad(sim_remote(1, []), [5-1, a-2, [green]-2]).
bad(sim_restore(_), [a-1, _-1]).
bad(behave([]), [a-1, _-1, [_]-1, [7]-1, [nowhere]-1, [(7 :: true ~> true)]-1]).
bad(behave([]), [[(_ :: true ~> true)]-1, [(a :: _ ~> true)]-1, [(a :: true ~> 7)]-1]).
bad(behave([]), [[(a, sped(5) :: true ~> true)]-1]).
bad(behave([], []), [a-1, [nowhere]-1, _-2, [sped(5)]-2, [timeout(-1)]-2, [timeout(a)]-2]).
bad(behave([], []), [[period(-1)]-2, [on_error(stop)]-2, [until(7)]-2, [trace(7)]-2]).
bad(control([]), [a-1, _-1, []-1, [sped(5)]-1, [timeout(a)]-1, [period(-1)]-1, [trace(7)]-1, [layers(a)]-1, [until(_)]-1]).
bad(sense(time, _), [time-1]).
bad(val(a, _), [a-1]).
bad(was(_, _, _), [a-1]).
bad(layer(a), [_-1, 7-1, a-1]).
bad(become([]), [a-1, _-1, [nowhere]-1, []-1]).
bad(state(_), [start-1]).
bad(set_state(start), [_-1, start-1]).
bad(send_message(hello), [_-1, hello-1]).
bad(received(_), [hello-1]).
bad(on(true, true), [7-1, _-1, 7-2, _-2]).
bad(on(true, true, []), [7-1, _-2, a-3, [sped(5)]-3, [id(_)]-3, [count(0)]-3, [count(a)]-3]).
bad(on(true, true, []), [[stable(-1)]-3, [stable(a)]-3, [rearm(7)]-3, [armed(maybe)]-3]).
bad(every(1, true), [a-1, _-1, -1-1, 7-2, _-2]).
bad(every(1, true, []), [a-1, 7-2, [stable(1)]-3, [count(0)]-3]).
bad(after(1, true), [a-1, _-1, -1-1, 7-2, _-2]).
bad(after(1, true, []), [a-1, 7-2, [count(2)]-3]).
bad(both(true, true), [7-1, _-1, 7-2, _-2]).
bad(race([true], _), [a-1, _-1, [7]-1, [_]-1]).
bad(until(true, true), [7-1, _-1, 7-2, _-2]).
bad(until(true, true, _), [7-1, _-1, 7-2, _-2]).
bad(nxt_robot(nxt, true), [_-1, wheel-1]).
bad(nxt_goal(nxt, true), [_-1, wheel-1]).
bad(nxt_goal(nxt, true, []), [_-1, wheel-1]).
bad(nxt_go(400), [a-1, _-1]).
bad(nxt_go_cm(400, 15), [a-1, _-1, far-2, _-2]).
bad(nxt_go_sec(400, 1), [a-1, _-2, -1-2]).
bad(nxt_turn(400, 15), [a-1, _-1, far-2, _-2]).
bad(nxt_rotate(400, 15), [a-1, _-1, far-2, _-2]).
bad(nxt_ultrasonic(_, force), [_-2, now-2]).
bad(nxt_touch(_, force), [_-2, now-2]).
bad(nxt_light_LED(activate), [_-1, on-1]).
bad(nxt_light_LED(activate, force), [_-1, on-1, now-2]).
bad(nxt_play_tone(440, 10), [a-1, _-2]).
bad(trigger_create(a, true, true), [f(_)-1, 7-2, _-2, 7-3, _-3, [7]-3]).
bad(trigger_create(a, true, true, 1), [7-2, _-3, 0-4, a-4, _-4]).
bad(timer_create(a, 1, true), [f(_)-1, a-2, -1-2, _-2, 7-3, _-3]).
bad(timer_create(a, 1, true, 1), [-1-2, 7-3, 0-4, a-4, _-4]).
bad(far(anna, true), [_-1, 7-1, anna-1, _-2, 7-2]).
bad(far_load(anna, nofile), [_-1, 7-1, anna-1, _-2]).
bad(navigate_to([], 9-9), [a-1, _-2, far-2]).
bad(navigate_to([], 9-9, []), [a-1, far-2, [x(1)]-3]).
bad(execute_plan([]), [_-1, a-1]).
bad(obstacle_add([1, 1]), [_-1, a-1, 1-2-1]).
bad(obstacle_remove([1, 1]), [_-1, a-1]).
bad(plan(a_star, problem(0, 1, []), _), [_-1, nix-1, _-2, 7-2]).
bad(plan(a_star, problem(0, 1, []), _, _), [_-1, nix-1, _-2, 7-2]).
bad(planning(a_star, problem(0, 1, []), _), [_-1, nix-1, _-2, 7-2]).
bad(replan(0, [], _, a, _), [_-4, a-4]).
bad(grid_map([], _), [a-1, [colour(red)]-1, [neighbors(5)]-1]).
bad(grid_policy([goal([1, 1])], _), [a-1, _-1, []-1, [goal(a)]-1, [goal(_)]-1, [goal([1, 1]), method(up)]-1, [goal([1, 1]), colour(red)]-1]).
bad(grid_action(policy(value_iteration, map(bounds(0, 0, 0, 0), 4, costs(1, 1, 1), t, any, none), state([0, 0], _), t), state([0, 0], [0, 1]), _, _), [a-1, _-1, a-2, _-2]).
bad(indigolog([]), [_-1, fly-1]).
bad(roadmap_svg([], 0-0, 9-9, 'roadmap.svg', []), [a-1, foo-2, foo-3, _-4, [x(1)]-5]).
bad(roadmap_legs([], 0-0, 9-9, _, []), [a-1, foo-2, foo-3, [x(1)]-5]).
bad(sim_add(box(1, 1, 1, 1)), [_-1, a-1, 7-1]).
bad(sim_add(box(1, 1, 1, 1), _), [_-1, a-1, 7-1]).
bad(sim_mount('/nowhere'), [_-1, '/nowhere/at/all'-1]).
bad(sim_mount('/nowhere', '/nowhere'), [_-1, '/nowhere/at/all'-1]).
bad(sim_release(enter), [space-1, _-1]).
bad(sim_show(in1, value0, 5), [7-1, _-1, in9-1, _-2, _-3]).
bad(sim_unshow(in1, value0), [7-1, _-1, in9-1, _-2]).
bad(sim_start(room), [nowhere-1, _-1]).
bad(sim_svg('/nowhere/x.svg'), [_-1, '/nowhere/y.svg'-1]).
bad(sim_unplug(outA), [1-1, in9-1, _-1]).

% What is not refused, and why: `map` is a term that grid_map/2 or another
% predicate made, which planners hand over thousands of times a second; `any`
% takes any term; `fails` asks a question, and the answer is no.
accepts(map,
        [ grid_changed/3, free_cell/2, grid_belief/2, grid_belief_best/3,
          grid_belief_cell/3, grid_belief_entropy/2, grid_belief_svg/2,
          grid_beside/4, grid_bounds/5, grid_cell/2, grid_cost/4,
          grid_costs/4, grid_direction/2, grid_localize/2, grid_neighbors/2,
          grid_problem/4, grid_start/2, grid_step/4, grid_turn/4,
          compare_planners/3 ]).
accepts(any,
        [ screen_print/1, ask_exog_occurs/1, report_message/2, set_option/2
        ]).
accepts(fails,
        [ direction_heading/2, sensing_action/2, grid_place/2,
          plan_and_go_to/2, plan_and_go_to/3, sim_remove/1, map_save/1,
          map_svg/1 ]).

:- begin_tests(errors).
test(each_export_that_takes_something_is_here, true(Missing-Gone == []-[])) :-
    findall(PI, ( public_export(_, PI), \+ public_export(ev3dev, PI),
                  takes_something(PI) ), PIs0),
    sort(PIs0, PIs),
    findall(PI, tried(PI), Tried0),
    sort(Tried0, Tried),
    subtract(PIs, Tried, Missing),
    findall(PI, ( member(PI, Tried), \+ public_export(_, PI) ), Gone).

test(name_what_was_called, [forall(bad_call(Goal))]) :-
    functor(Goal, Name, Arity),
    with_sim(room,
             ( set_robot(5.6, 10.6, outB, outC),
               catch(( ignore(Goal), E = none ), E, true) )),
    assertion(( E == none ; subsumes_term(error(_, context(_, _)), E) )),
    (   E = error(_, context(Called, Message))
    ->  assertion(Called == Name/Arity),
        assertion(atom(Message)),
        assertion(\+ sub_atom(Message, _, _, _, ' { '))
    ;   true
    ).
test(refuse_what_is_wrong, true(Accepted == [])) :-
    findall(Goal,
            ( bad_call(Goal),
              \+ wrongly(Goal) ),
            Accepted).
test(a_measure_may_be_an_expression, [ forall(measure(2*3, Goal)) ]) :-
    with_sim(room,
             ( set_robot(5.6, 10.6, outB, outC), ignore(Goal) )).
test(what_is_no_measure_is_the_same_error_everywhere,
     [ forall(measure(a, Goal)), true(Formal == type_error(evaluable, a/0)),
       nondet ]) :-
    with_sim(room,
             ( set_robot(5.6, 10.6, outB, outC),
               catch(Goal, error(Formal, context(_, Text)), true) )),
    (   Text == 'a number is expected, not a'
    ;   sub_atom(Text, 0, _, _, 'the '),
        sub_atom(Text, _, _, 0, ' argument must be a number, not a')
    ).
test(an_overflow_is_of_what_was_called,
     error(evaluation_error(_), context(arc_cm/3, _))) :-
    with_sim(room,
             ( set_robot(5.6, 10.6, outB, outC), arc_cm(30, 1.0e308, 90) )).
% What a program prints itself.
test(an_error_of_prolog_prints_as_ever, true(Printed == true)) :-
    catch(atom_length(_, _), Error, true),
    message_to_codes(Error, Codes),
    atom_codes(Text, Codes),
    (   sub_atom(Text, _, _, _, 'not sufficiently instantiated')
    ->  Printed = true
    ;   Printed = Text
    ).
test(say_which_variable_has_no_value,
     [ forall(member(Goal-Words,
                     [ motor_run(_, 50)-'the first argument is a variable without a value',
                       motor_run(outB, _)-'the second argument is a variable without a value',
                       motor_run(outB, 50+_)-'a part of an argument is a variable',
                       motor_wait(_, [], _)-'the first argument is',
                       set_robot(5.6, 10.6, outB, _)-'the fourth argument is',
                       until(_, true)-'an argument is',
                       sim_svg(_)-'the first argument is' ])) ]) :-
    with_sim(room, catch(Goal, error(instantiation_error, context(_, Message)), true)),
    assertion(sub_atom(Message, _, _, _, Words)).
test(say_what_is_meant,
     [ forall(member(Goal-Words,
                     [ motors_run([outB])-"run(Port, Speed) is expected, not outB",
                       motors_run(run(outB, 50))-"Did you mean [run(outB,50)]?",
                       motors_turn([move(outB, 5)], [])-": move(Port,Speed,Angle), to(",
                       motor_ramps(outB, 1, -1)-"the integer must be from 0 to 60000, not -1",
                       drive_option(speed, 200)-"from -100 to 100 percent and must not be 0, not 200",
                       go_to([1, 2], 3)-"must be a number, not [1,2]",
                       go_to(1-2, [speed(3)])-"a number is expected, not ",
                       sensor_wait(us_dist_cm(in1, _))-"us_dist_cm(in1,_) is not one of",
                       sim_unplug(in9)-"in1 to in4 and outA to outD, not in9",
                       sim_remote(1, [up])-"red_up, red_down",
                       sim_restore(x)-"sim_snapshot/1",
                       sim_add(box)-"box(X, Y, Width, Depth)",
                       sim_svg('no/such/folder.svg')-"there is no file 'no/such/folder.svg'",
                       screen_circle(50, 50, -3)-"the number must be from 0 to 10000, not -3",
                       on(us_dist_cm(in1, D) < 20, D)-"us_dist_cm(Port) < 20, or us_dist_cm(Port, X), X < 20",
                       until(us_dist_cm(in1, D) < 20, true)-"us_dist_cm(Port) < 20, or us_dist_cm(Port, X), X < 20",
                       until(20 > us_dist_cm(_, 5), true)-"us_dist_cm(Port) < 20, or us_dist_cm(Port, X), X < 20",
                       until(true, true, go(30))-"put parentheses around",
                       behave([(a :: us_dist_cm(_, D) < 9 ~> true)])-"us_dist_cm(Port) < 9, or us_dist_cm(Port, X), X < 9",
                       behave([(a : true ~> true)])-"a rule is written Name :: Guard ~> Action",
                       motor_run(outB, 5, 5, [wait])-"with a value: wait(Value)",
                       motor_run(outB, 5, 5, [time(3)])-". Did you mean timeout?",
                       motor_wait_while(outB, runing)-". Did you mean running?",
                       button_wait(enter, press)-". Did you mean pressed?",
                       sim_start(room, [clock(virtuel)])-". Did you mean virtual?",
                       behave(avoid)-"Did you mean [avoid]?" ])) ]) :-
    with_sim(room,
             ( set_robot(5.6, 10.6, outB, outC),
               garbage_collect,         % later it may forget an argument
               catch(Goal, error(_, context(_, Message)), true) )),
    assertion(sub_atom(Message, _, _, _, Words)).
test(say_what_the_arguments_are,
     [ forall(member(Goal-Words,
                     [ motor_run(50, outB)-"motor_run(Port, Speed): Speed must be a number, not outB",
                       motor_run(1, 50)-"motor_run(Port, Speed): Port must be an atom or a string, not 1",
                       led(red, left)-"led(Light, Color): left is not one of",
                       set_robot(outB, outC, 5.6, 10.6)
                           -"set_robot(WheelDiameter, AxleLength, Left, Right)",
                       for_seconds(go(20), 3)-"for_seconds(Seconds, Goal): there is no arithmetic function go/1",
                       sim_place(0, 0, 0)-"sim_place/3: robot at 0, 0 is inside" ])) ]) :-
    with_sim(room, catch(( Goal, E = none ), E, true)),
    text_of(E, Text),
    assertion(sub_string(Text, _, _, _, Words)).
test(there_is_no_such_predicate,
     [ forall(member(Predicate-Words,
                     [ (motor_run/1)-"there is no motor_run/1. There are:",
                       (motor_run/1)-"motor_run(Port, Speed, Angle, Options)",
                       (stop/1)-"There is:",
                       (user:set_robot/6)-"set_robot(WheelDiameter, AxleLength, Left, Right)",
                       (until/1)-"until(Condition, Goal)",
                       (gyro/2)-"Did you mean:",
                       (forward/1)-"go_cm(Speed, Distance)",
                       (us_distance/2)-"us_dist_cm(Port, Centimeters)" ])) ]) :-
    text_of(error(existence_error(procedure, Predicate), _), Text),
    assertion(sub_string(Text, _, _, _, Words)).
test(what_prolog_does_not_know_is_said_by_prolog,
     [ forall(member(Predicate, [foo/1, x/0, atom_length/9])) ]) :-
    text_of(error(existence_error(procedure, Predicate), _), Text),
    assertion(\+ sub_string(Text, _, _, _, "there is no")).
test(list_what_is_allowed,
     [ forall(member(Goal-Words,
                     [ led(left, blu)-"off, on, red",
                       motor_run(outB, 5, 5, [stop_action(jump)])
                           -"coast, brake, hold",
                       motor_run(outB, 5, 5, [spot_action(hold)])
                           -"stop_action, ramp_up",
                       command(outB, jump)-"; there are: run-forever, run-to-abs",
                       mode(in1, jump)-"; there are: US-DIST-CM, US-DIST-IN",
                       motor_attribute(outB, stop_action, jump)
                           -"Invalid argument; there are: coast, brake, hold",
                       sim_plug(outA, 'lego-ev3-x-motor')
                           -"; there are: lego-ev3-l-motor, lego-ev3-m-motor",
                       sim_plug(in1, us)-"; there are: lego-ev3-color, lego-ev3",
                       battery(volts, _)-"voltage, current",
                       button_wait(space, _)-"up, down, left",
                       motor_polarity(outB, upside)-"normal, inversed",
                       calibrate(all, [], _)-"wheels, axle",
                       behave([], [on_error(stop)])-"throw, continue",
                       behave([], [sped(5)])-"until, timeout",
                       on(true, true, [sped(5)])-"id, count",
                       sim_start(room, [clock(slow)])-"realtime" ])) ]) :-
    with_sim(room,
             ( set_robot(5.6, 10.6, outB, outC),
               catch(Goal, error(_, context(_, Message)), true) )),
    assertion(sub_atom(Message, _, _, _, Words)).
:- end_tests(errors).

text_of(Error, Text) :-
    Translation =.. [translate_message, Error, Lines, []],
    call('$messages':Translation),
    with_output_to(string(Text), print_message_lines(current_output, '', Lines)).

%   Goal has X for a length, an angle, a speed or a time.

measure(X, set_robot(X, 10.6, outB, outC)).
measure(X, set_robot(5.6, X, outB, outC)).
measure(X, set_robot(5.6, 10.6, outB, outC, [Option])) :-
    member(Name, [left_diameter, right_diameter, axle_offset]),
    Option =.. [Name, X].
measure(X, go(20, X)).
measure(X, go_cm(20, X)).
measure(X, go_cm(X, 1, [])).
measure(X, go_cm(20, 1, [Option])) :-
    member(Name, [acceleration, timeout]),
    Option =.. [Name, X].
measure(X, go_to(X, 1, [])).
measure(X, go_to(1, X, 0, [])).
measure(X, go_to(X-1)).
measure(X, face(1, [speed(X)])).
measure(X, follow([1-X])).
measure(X, follow([], [radius(X)])).
measure(X, set_pose(0, 0, X)).
measure(X, drive_option(speed, X)).
measure(X, drive_option(acceleration, X)).
measure(X, drive_wait([timeout(X)], _)).
measure(X, calibrate(wheels, [distance(X), measured(none)], _)).
measure(X, motor_run(outA, 50, X, [wait(false)])).
measure(X, motor_run(outA, 50, 9, [timeout(X)])).
measure(X, motor_wait(outA, [timeout(X)], _)).
measure(X, button_wait(up, pressed, [timeout(X)])).
measure(X, set_grid([Option])) :-
    member(Name, [cell_cm, eye, speed, fade]),
    Option =.. [Name, X].
measure(X, set_grid([origin(0, X)])).
measure(X, roadmap_path([], X-0, 9-9, _)).
measure(X, roadmap_path([], 0-0, 9-9, _, [Option])) :-
    member(Name, [radius, margin, arc_radius]),
    Option =.. [Name, X].
measure(X, navigate_to([], 1-1, [Option])) :-
    member(Name, [speed, tolerance, radius]),
    Option =.. [Name, X].
measure(X, navigate_to([], 1-1, [sensor(0, 7, X)])).
measure(X, sim_place(40, 40, X)).
measure(X, sim_wait(X)).
measure(X, wait(X)).
measure(X, behave([], [timeout(X)])).
measure(X, behave([], [timeout(1), period(X)])).
measure(X, on(fail, true, [stable(X), id(measure)])).
measure(X, every(X, true, [count(1), id(measure)])).
measure(X, after(X, true, [id(measure)])).
measure(X, sim_at(X, true)).
measure(X, for_seconds(X, true)).
measure(X, sim_press(up, [after(X)])).
measure(X, sim_press(up, [for(X)])).

tried(Name/Arity) :-
    bad(Call, _),
    functor(Call, Name, Arity).
tried(PI) :-
    accepts(_, PIs),
    member(PI, PIs).

%   Its comment has an argument that must have a value.

takes_something(Name/Arity) :-
    ev3dev_help_index:read_comments,
    ev3dev_help_index:predicate_(Name, Arity, Id),
    ev3dev_help_index:comment_(Id, _, Heads, _),
    atomic_list_concat(Heads, ' ', Text),
    atom_concat(Name, '(', Start),
    sub_atom(Text, Before, _, _, Start),
    sub_atom(Text, Before, _, 0, From),
    once(sub_atom(From, End, _, _, ' is ')),
    sub_atom(From, 0, End, _, Head),
    ev3dev_help_index:head_indicator(Head, Name/Arity),
    ( sub_atom(Head, _, _, _, '+') ; sub_atom(Head, _, _, _, ':') ),
    !.

none(_, _) :-
    fail.

message_to_codes(Error, Codes) :-
    '$messages':translate_message(Error, Lines, []),
    with_output_to(codes(Codes),
                   print_message_lines(current_output, '', Lines)).

bad_call(Goal) :-
    bad(Call, Wrongs),
    member(Wrong-Position, Wrongs),
    Position \== none,
    Call =.. [Name|Arguments0],
    nth1(Position, Arguments0, _, Rest),
    nth1(Position, Arguments, Wrong, Rest),
    Goal =.. [Name|Arguments].

wrongly(Goal) :-
    with_sim(room,
             ( set_robot(5.6, 10.6, outB, outC),
               catch(( ignore(Goal), fail ), error(_, _), true) )).
