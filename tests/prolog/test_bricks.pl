% library(ev3dev/bricks): each brick has its own robot, and a name says which is meant.

:- use_module('../support/child').
:- use_module('../support/redis').
:- use_module('../support/trees').
:- use_module(library(ev3dev/bricks)).
:- use_module(library(ev3dev/drive)).
:- use_module(library(ev3dev/sim)).
:- use_module(library(ev3dev/events), [on/2 as when_, both/2, every/3]).

% Call Goal with simulated bricks of these names, which end with it.
with_bricks(Names, Goal) :-
    setup_call_cleanup(
        maplist(open_simulated, Names),
        once(Goal),
        maplist(close_if_open, Names)).

open_simulated(Name) :-
    brick_open(Name, sim([start(0, 0, 90)], [clock(virtual)])).

close_if_open(Name) :-
    ( brick(Name) -> brick_close(Name) ; true ).

% A directory with a motor at outB and at outC, as a brick has them.
with_brick_of_files(Name, Goal) :-
    with_tree(plain, [outB-'lego-ev3-l-motor', outC-'lego-ev3-l-motor'],
              ( tree_root(Root),
                setup_call_cleanup(
                    brick_open(Name, dir(Root)),
                    once(Goal),
                    close_if_open(Name)) )).

two_wheels :-
    set_robot(5.6, 12, outB, outC).

tacho(Name, Degrees) :-
    with_brick(Name, position(outB, Degrees0)),
    Degrees is round(Degrees0 / 10) * 10.

current_name(Name) :-
    use_brick(Name).

:- begin_tests(bricks).
test(sim_stop_ends_all_robots_of_a_world, true(Names == [local])) :-
    sim_start(dohyo, [clock(virtual), robots([east-default, west-default])]),
    sim_stop,
    \+ sim_stop,
    findall(Name, brick(Name), Names).
test(but_within_one_of_them_its_simulation, true(Names == [local, east, west])) :-
    sim_start(dohyo, [clock(virtual), robots([east-default, west-default])]),
    with_brick(east, sim_stop),
    findall(Name, brick(Name), Names),
    sim_stop.
test(a_program_starts_with_local, true(Names == [local-local])) :-
    findall(Name-Where, brick(Name, Where), Names).
test(a_world_that_was_asked_for_is_not_announced, [true(Said == [])]) :-
    setup_call_cleanup(
        ( brick_open(anna, sim),
          assertz((user:message_hook(ev3dev(simulated(W)), _, _) :-
                       assertz(user:announced(W)), fail), Ref) ),
        with_brick(anna, battery(voltage, _)),
        ( erase(Ref), brick_close(anna) )),
    findall(W, retract(user:announced(W)), Said).
test(each_has_motors_of_its_own, true([A, B] == [90, 0])) :-
    with_bricks([anna, bob],
                ( with_brick(anna, motor_run(outB, 50, 90)),
                  tacho(anna, A),
                  tacho(bob, B) )).
test(each_has_a_world_and_a_time, true(A-B == (0-0-90)-yes)) :-
    with_bricks([anna, bob],
                ( with_brick(bob, ( two_wheels, go_cm(30, 10), sim_pose(X0, _, _) )),
                  with_brick(anna, ( sim_pose(X1, Y1, H1), sim_time(T1) )),
                  maplist(round_, [X1, Y1, H1], [X, Y2, H]),
                  A = X-Y2-H,
                  ( near(X0, 10, 0.2), T1 =:= 0 -> B = yes ; B = X0-T1 ) )).
test(each_has_its_robot, true(Going == [anna])) :-
    with_bricks([anna, bob],
                ( with_brick(anna, two_wheels),
                  findall(Name,
                          ( member(Name, [anna, bob]),
                            with_brick(Name, go_cm(30, 1)) ),
                          Going) )).
test(each_has_its_odometry, true(A-B == 10-5)) :-
    with_bricks([anna, bob],
                ( forall(member(Name-Cm, [anna-10, bob-5]),
                         with_brick(Name, ( two_wheels, set_pose(0, 0, 0),
                                            go_cm(30, Cm) ))),
                  with_brick(anna, pose(_, YA, _)),
                  with_brick(bob, pose(_, YB, _)),
                  maplist(round_, [YA, YB], [A, B]) )).
test(each_has_its_screen, true(Same == [no, yes])) :-
    with_bricks([anna, bob],
                ( with_brick(anna, ( screen_circle(50, 50, 20), picture(A) )),
                  with_brick(bob, picture(B)),
                  picture(C),
                  maplist(same, [A, C], [B, B], Same) )).
test(the_former_is_in_use_between_solutions_and_after,
     true(Seen == [local-1, local-2, local-3])) :-
    with_bricks([anna],
                ( findall(Name-N,
                          ( with_brick(anna, ( member(N, [1, 2, 3]), use_brick(anna) )),
                            current_name(Name) ),
                          Seen0),
                  current_name(After),
                  ( After == local -> Seen = Seen0 ; Seen = After ) )).
test(the_former_is_in_use_after_failure_and_errors, true(A-B == local-local)) :-
    with_bricks([anna],
                ( \+ with_brick(anna, fail),
                  current_name(A),
                  catch(with_brick(anna, throw(oops)), oops, true),
                  current_name(B) )).
test(they_nest, true(Seen == [anna, bob, anna])) :-
    with_bricks([anna, bob],
                with_brick(anna,
                           ( current_name(A),
                             with_brick(bob, current_name(B)),
                             current_name(C) ))),
    Seen = [A, B, C].
test(one_that_is_chosen_inside_is_left_with_the_goal, true(Name == local)) :-
    with_bricks([anna, bob],
                ( with_brick(anna, use_brick(bob)), current_name(Name) )).
test(a_thread_begins_with_that_of_its_maker, true(Seen == [bob, anna, bob])) :-
    with_bricks([anna, bob],
                setup_call_cleanup(
                    use_brick(bob),
                    ( thread_self(Me),
                      thread_create(( current_name(A), use_brick(anna), current_name(B),
                                      thread_send_message(Me, names(A, B)) ), Id, []),
                      thread_join(Id, true),
                      thread_get_message(names(A1, B1)),
                      current_name(C) ),
                    use_brick(local))),
    Seen = [A1, B1, C].
test(an_engine_acts_for_the_thread_that_asks_it,
     [condition(current_predicate(engine_create/3)), true(Names == [anna, bob])]) :-
    with_bricks([anna, bob],
                ( engine_create(Name, ( repeat, current_name(Name) ), Engine),
                  with_brick(anna, engine_next(Engine, A)),
                  with_brick(bob, engine_next(Engine, B)),
                  engine_destroy(Engine) )),
    Names = [A, B].
test(all_act_at_the_same_time, true(Positions == [100, 100])) :-
    with_bricks([anna, bob],
                ( bricks_do(motor_run(outB, 50, 100)),
                  maplist(tacho, [anna, bob], Positions) )).
test(those_of_a_list_act, true(Positions == [0, 100])) :-
    with_bricks([anna, bob],
                ( bricks_do([bob], motor_run(outB, 50, 100)),
                  maplist(tacho, [anna, bob], Positions) )).
test(nobody_has_nothing_to_do) :-
    bricks_do([], fail).
test(a_copy_of_the_goal_binds_nothing, true(var(X))) :-
    with_bricks([anna, bob], bricks_do(X = 1)).
test(where_one_fails_the_others_leave_their_moves, true(Running == [])) :-
    with_bricks([anna, bob],
                ( \+ bricks_do(moves_unless(bob)),
                  findall(Name,
                          ( member(Name, [anna, bob]),
                            with_brick(Name, ( motor_states(outB, States),
                                               memberchk(running, States) )) ),
                          Running) )).
test(an_error_of_one_is_thrown, throws(oops)) :-
    with_bricks([anna, bob], bricks_do(throw(oops))).
test(files_elsewhere_are_a_brick, true(B-Command == Root-'run-forever')) :-
    with_brick_of_files(file,
                        ( with_brick(file, motor_run(outB, 20)),
                          get_attribute(outB, command, Command),
                          brick(file, dir(B)),
                          tree_root(Root) )).
test(to_close_one_stops_its_motors, true(Command == stop)) :-
    with_brick_of_files(file,
                        ( with_brick(file, motor_run(outB, 20)),
                          brick_close(file),
                          get_attribute(outB, command, Command) )).
test(to_close_the_one_in_use_goes_back_to_local, true(Name-Names == local-[local])) :-
    with_bricks([anna],
                ( use_brick(anna),
                  brick_close(anna),
                  current_name(Name),
                  findall(N, brick(N), Names) )).
test(a_closed_one_forgets, true(Position == 0)) :-
    with_bricks([anna], with_brick(anna, motor_run(outB, 50, 90))),
    with_bricks([anna], tacho(anna, Position)).
test(a_thread_that_has_a_closed_one_is_told, true(Name-Error == '#'-brick)) :-
    with_bricks([anna],
                ( thread_self(Me),
                  with_brick(anna, thread_create(uses_after(Me, go), Id, [])),
                  thread_get_message(ready),
                  brick_close(anna),
                  thread_send_message(Id, go),
                  thread_join(Id, true),
                  thread_get_message(was(Caught)),
                  ( Caught = error(existence_error(Error, N), _),
                    integer(N)
                  -> Name = '#' ; Name = Caught ) )).
test(stop_all_bricks_stops_all, true(Running == [])) :-
    with_bricks([anna, bob],
                ( forall(member(N, [anna, bob]), with_brick(N, motor_run(outB, 50))),
                  stop_all_bricks,
                  findall(N, ( member(N, [anna, bob]),
                               with_brick(N, ( motor_states(outB, States),
                                               memberchk(running, States) )) ),
                          Running) )).
test(an_event_is_about_the_brick_where_it_was_asked_for,
     true(Happened == [anna])) :-
    with_bricks([anna, bob],
                ( nb_setval(happened, []),
                  with_brick(anna, when_(( position(outB, P), P > 45 ), note_event)),
                  with_brick(bob, motor_run(outB, 50, 90)),
                  with_brick(anna, motor_run(outB, 50, 90)),
                  with_brick(bob, motor_run(outB, 50, 90)),
                  nb_getval(happened, Happened) )).
test(branches_keep_their_bricks,
     [condition(current_predicate(engine_create/3)), true(Positions == [90, 40])]) :-
    with_bricks([anna, bob],
                ( both(with_brick(anna, motor_run(outB, 50, 90)),
                       with_brick(bob, motor_run(outB, 50, 40))),
                  maplist(tacho, [anna, bob], Positions) )).
test(a_simulation_of_its_own_leaves_the_running_one, true(near(A, 90, 2))) :-
    with_bricks([anna],
                with_brick(anna,
                           ( motor_run(outB, 50, 90),
                             with_sim(room, motor_run(outB, 50, 20)),
                             position(outB, A) ))).
test(the_first_use_starts_the_simulation, true(Cm > 0)) :-
    setup_call_cleanup(
        brick_open(anna, sim),
        with_brick(anna, us_dist_cm(in1, Cm)),
        brick_close(anna)).
test(local_has_other_names, true(Name == local)) :-
    setup_call_cleanup(
        brick_open(here, local),
        with_brick(here, current_name(Name)),
        brick_close(here)).
:- end_tests(bricks).

round_(Number, Integer) :-
    Integer is round(Number).

same(A, B, Same) :-
    ( A == B -> Same = yes ; Same = no ).

picture(Bytes) :-
    tmp_file(picture, File0),
    atom_concat(File0, '.png', File),
    screen_show,
    screen_png(File),
    read_file_to_codes(File, Bytes, [type(binary)]),
    delete_file(File).

moves_unless(Name) :-
    current_name(Name),
    !,
    fail.
moves_unless(_) :-
    motor_run(outB, 50),
    wait_s(60).

uses_after(Me, Message) :-
    thread_send_message(Me, ready),
    thread_get_message(Message),
    catch(motor_run(outB, 50), Error, true),
    thread_send_message(Me, was(Error)).

note_event :-
    nb_getval(happened, Names),
    current_name(Name),
    append(Names, [Name], Now),
    nb_setval(happened, Now).

:- begin_tests(bricks_bad_input).
test(a_name_has_letters, error(domain_error(brick_name, ''), _)) :-
    brick_open('', sim).
test(wrong, [ forall(member(Goal-Error,
                            [ brick_open(_, sim)-instantiation_error,
                              brick_open(7, sim)-type_error(atom, 7),
                              brick_open(anna, _)-instantiation_error,
                              brick_open(anna, mars)-domain_error(brick_place, mars),
                              brick_open(anna, dir('/nowhere'))
                              -existence_error(directory, '/nowhere'),
                              brick_open(anna, sim(nowhere))-existence_error(world, nowhere),
                              brick_open(anna, sim(room, [colour(red)]))
                              -domain_error(sim_option, colour(red)),
                              brick_open(local, sim)-permission_error(open, brick, local),
                              brick_close(_)-instantiation_error,
                              brick_close(anna)-existence_error(brick, anna),
                              brick_close(local)-permission_error(close, brick, local),
                              with_brick(_, true)-instantiation_error,
                              with_brick(anna, true)-existence_error(brick, anna),
                              use_brick(anna)-existence_error(brick, anna),
                              use_brick(7)-type_error(atom, 7),
                              bricks_do([anna], true)-existence_error(brick, anna),
                              bricks_do(anna, true)-type_error(list, anna) ])),
              true(Formal-Names == Error-[local]) ]) :-
    catch(Goal, error(Formal, _), true),
    findall(Name, brick(Name), Names).
test(one_name_for_one_brick,
     throws(error(permission_error(open, brick, anna), _))) :-
    with_bricks([anna], brick_open(anna, sim)).
:- end_tests(bricks_bad_input).

% Two robots that look at each other, 60 cm apart.
duel([start(anna, 0, 0, 0), start(bob, 0, 60, 180)]).

with_duel(Goal) :-
    with_robots([anna-default, bob-default], Goal).

with_robots(Robots, Goal) :-
    duel(World),
    setup_call_cleanup(
        sim_start(World, [clock(virtual), robots(Robots)]),
        once(Goal),
        forall(member(Name-_, Robots), close_if_open(Name))).

duel_ends(Poses) :-
    with_duel(( bricks_do([anna, bob], ( two_wheels, us_dist_cm(in1, D), Cm is D/2,
                                         go_cm(30, Cm), turn(40, 70), go_cm(50, 30) )),
                findall(X-Y-H, ( member(Name, [anna, bob]),
                                 with_brick(Name, sim_pose(X, Y, H)) ), Poses) )).

place(Name, X-Y) :-
    with_brick(Name, sim_pose(X0, Y0, _)),
    maplist(round_, [X0, Y0], [X, Y]).

:- begin_tests(robots).
test(each_is_a_brick_at_its_place, true([A, B, Here] == [0-0, 0-60, local])) :-
    with_duel(( place(anna, A), place(bob, B), current_name(Here) )).
test(they_see_each_other, true(D-E == 45-45)) :-
    with_duel(( with_brick(anna, us_dist_cm(in1, D0)), with_brick(bob, us_dist_cm(in1, E0)) )),
    maplist(round_, [D0, E0], [D, E]).
test(each_has_motors_and_a_drive, true([A, B] == [0-20, 0-40])) :-
    with_duel(( bricks_do([anna, bob], ( two_wheels, go_cm(30, 20) )),
                place(anna, A), place(bob, B) )).
test(they_have_one_time, true(A == B)) :-
    with_duel(( with_brick(anna, sim_wait(3)), with_brick(bob, sim_time(B)),
                with_brick(anna, sim_time(A)) )).
test(each_has_a_processor_of_its_own, true(Took =< 0.051)) :-
    with_duel(( bricks_do([anna, bob], ( position(outB, _), sim_time(_) )),
                with_brick(anna, sim_time(T0)),
                bricks_do([anna, bob], forall(between(1, 100, _), position(outB, _))),
                with_brick(anna, ( sim_time(T1) )) )),
    Took is round((T1-T0)*1000)/1000.
test(one_pushes_the_other, true(Pushed > 80)) :-
    with_duel(( with_brick(anna, ( two_wheels, go(60), sim_wait(6), stop )),
                with_brick(bob, ( sim_pose(_, Pushed, _), sim_collisions(Cs) )),
                Cs = [_] )).
test(what_a_hand_puts_there_is_there_for_both, true(D == 45)) :-
    with_duel(( with_brick(bob, ( sim_place(200, 200, 0), sim_add(circle(0, 60, 8)) )),
                with_brick(anna, ( sim_wait(1), us_dist_cm(in1, D0) )) )),
    round_(D0, D).
test(one_that_is_closed_stays_where_it_is, true(D == 45)) :-
    with_duel(( brick_close(bob), with_brick(anna, ( sim_wait(1), us_dist_cm(in1, D0) )) )),
    round_(D0, D).
test(the_same_in_each_run, true(A == B)) :-
    findall(Poses, ( member(_, [1, 2]), duel_ends(Poses) ), [A, B]).
test(what_is_wrong_with_them,
     [ forall(member(Robots-Formal,
                     [ [bob-default, bob-default]-permission_error(open, brick, bob),
                       [local-default]-permission_error(open, brick, local),
                       [anna]-type_error(pair, anna), [_]-instantiation_error,
                       [7-default]-type_error(atom, 7), anna-type_error(list, anna),
                       [anna-mars]-existence_error(robot, mars),
                       [anna-default, bob-[mass(1)]]
                       -domain_error(possible_geometry, [mass(1)]) ])),
       true(Found-Left == Formal-[local]) ]) :-
    duel(World),
    catch(sim_start(World, [robots(Robots)]), error(Found, _), true),
    findall(Name, brick(Name), Left).
test(a_world_needs_a_start_for_each, true(Text-Left == 'has no place for the robot eva: add start(eva, X, Y, Heading)'-[local])) :-
    duel(World),
    catch(sim_start(World, [robots([eva-default])]), error(_, context(_, Text)), true),
    findall(Name, brick(Name), Left).
test(robots_do_not_start_in_each_other, true(Left == [local])) :-
    catch(sim_start([start(anna, 0, 0, 0), start(bob, 0, 10, 0)],
                    [robots([anna-default, bob-default])]),
          error(domain_error(possible_geometry, _), _), true),
    findall(Name, brick(Name), Left).
test(time_does_not_go_back_for_one, error(existence_error(feature, _))) :-
    with_duel(with_brick(anna, sim_snapshot(_))).

test(a_message_arrives_later, true(Late-From-Took == none-anna-0.01)) :-
    with_duel(( with_brick(anna, ( sim_time(T0), robot_send(bob, hi(_)) )),
                with_brick(bob, ( ( robot_receive(_, _, [timeout(0)]) -> Late = found ; Late = none ),
                                  robot_receive(From, hi(_), []), sim_time(T1) )) )),
    Took is round((T1-T0)*1000)/1000.
test(messages_come_in_their_order, true(Ms == [anna-1, bob-2, anna-3, bob-4])) :-
    with_duel(( with_brick(bob, robot_send(bob, 2)), with_brick(anna, robot_send(bob, 1)),
                with_brick(anna, ( wait(1), robot_send(bob, 3) )),
                with_brick(bob, ( robot_send(bob, 4),
                                  findall(F-M, ( between(1, 4, _), robot_receive(F, M, []) ),
                                          Ms) )) )).
test(others_stay_for_later, true(A-B == 2-1)) :-
    with_duel(( with_brick(anna, forall(member(M, [first(1), second(2)]), robot_send(bob, M))),
                with_brick(bob, ( robot_receive(anna, second(A), []),
                                  robot_receive(anna, first(B), []) )) )).
test(nobody_sends, true(Took == 0.5)) :-
    with_duel(with_brick(bob, ( sim_time(T0), \+ robot_receive(_, _, [timeout(0.5)]),
                                sim_time(T1) ))),
    Took is round((T1-T0)*1000)/1000.
test(listeners_go_on_while_one_waits, true(N == 4)) :-
    nb_setval(counted, 0),
    with_duel(with_brick(bob, ( every(0.1, ( nb_getval(counted, C0), C is C0+1,
                                             nb_setval(counted, C) ), [count(4)]),
                                \+ robot_receive(_, _, [timeout(1)]) ))),
    nb_getval(counted, N).
test(a_message_to_this_brick_needs_no_simulation, true(From-M == local-f(x))) :-
    robot_send(local, f(x)),
    robot_receive(From, M, [timeout(1)]).
test(messages_end_with_the_brick, fail) :-
    with_duel(with_brick(anna, robot_send(bob, hi))),
    with_duel(with_brick(bob, robot_receive(_, _, [timeout(1)]))).
test(an_attribute_is_not_sent, true(Attributed == no)) :-
    with_duel(( freeze(X, true), with_brick(anna, robot_send(bob, f(X))),
                with_brick(bob, robot_receive(_, f(Y), [])) )),
    ( attvar(Y) -> Attributed = yes ; Attributed = no ).
test(wrong_messages,
     [ forall(member(Goal-Formal,
                     [ robot_send(nobody, x)-existence_error(brick, nobody),
                       robot_send(_, x)-instantiation_error,
                       robot_receive(_, _, [timeout(-1)])-domain_error(timeout, -1),
                       robot_receive(_, _, [until(1)])-domain_error(receive_option, until(1)) ])),
       error(Formal) ]) :-
    Goal.
:- end_tests(robots).

% Another program, with the brick bob, does this.
with_other(Port, Text, Goal) :-
    format(string(Program),
           ":- use_module(library(ev3dev)).
            :- use_module(library(ev3dev/bricks)).
            go :- brick_open(bob, local), robots_join(redis(localhost:~d)), ~s.",
           [Port, Text]),
    start_program(Program, [goal(go)], Child),
    call_cleanup(once(Goal), catch(kill_program(Child), error(_, _), true)).

joined(Port, Goal) :-
    setup_call_cleanup(
        ( brick_open(anna, local), robots_join(redis(localhost:Port)) ),
        once(Goal),
        ( robots_leave, read_all, brick_close(anna) )).

read_all :-
    repeat,
    \+ robot_receive(_, _, [timeout(0)]),
    !.

% Sends until the other program, which may still start, has answered.
answer(Term, From, Answer) :-
    between(1, 200, _),
    robot_send(bob, Term),
    robot_receive(From, Answer, [timeout(0.1)]),
    !.

answered_at_last(Term, Answer) :-
    eventually(catch(answer(Term, _, Answer), error(_, _), fail)).

:- ( exists_source(library(redis)) -> use_module(library(redis), [redis/3]) ; true ).

:- begin_tests(robots_joined, [condition(can_use_redis)]).
test(a_message_goes_and_one_comes, From-X =@= bob-f("a b", 'C', [_])) :-
    with_redis_server(Port,
      with_other(Port, "robot_receive(F, ping(X), []), robot_send(F, pong(X))",
        joined(Port, answer(ping(f("a b", 'C', [_])), From, pong(X))))).
test(a_server_that_went_away_is_found_again,
     [ setup(asserta((user:message_hook(ev3dev(mail_lost(_)), _, _)), Told)),
       cleanup(erase(Told)) ]) :-
    with_redis_server(Port,
      with_other(Port, "repeat, robot_receive(F, ping(X), []),
                        catch(robot_send(F, pong(X)), _, true), fail",
        joined(Port,
          ( answer(ping(1), _, pong(1)),
            % Of the first pings several may have been answered.
            with_server_again(Port, answered_at_last(ping(2), pong(2))) )))).
test(what_comes_twice_is_dropped, Terms == [a, b]) :-
    with_redis_server(Port,
      joined(Port,
        ( with_client(Port, Redis,
              forall(member(Number-Term, [1-a, 1-a, 2-b, 1-a]),
                     redis(Redis, xadd('ev3dev:mail', *, to, anna, from, bob, program, p,
                                       number, Number, term, Term), _))),
          robot_receive(bob, A, [timeout(5)]), robot_receive(bob, B, [timeout(5)]),
          ( robot_receive(_, C, [timeout(0.5)]) -> Terms = [A, B, C] ; Terms = [A, B] ) ))).
test(what_cannot_be_read_is_dropped, Term == b) :-
    with_redis_server(Port,
      joined(Port,
        ( with_client(Port, Redis,
              forall(member(Number-Text, [foo-"a", foo-"a", 1-"f(", f(x)-"a", 2-"b"]),
                     redis(Redis, xadd('ev3dev:mail', *, to, anna, from, bob, program, p,
                                       number, Number, term, Text), _))),
          robot_receive(bob, Term, [timeout(5)]) ))).
test(own_bricks_are_reached_without_the_server, Got == here-none) :-
    with_redis_server(Port,
      joined(Port,
        ( robot_send(anna, here), robot_receive(anna, A, [timeout(1)]),
          ( robot_receive(_, B, [timeout(0.5)]) -> true ; B = none ) ))),
    Got = A-B.
test(after_leaving_others_are_unknown, error(existence_error(brick, bob))) :-
    with_redis_server(Port, joined(Port, true)),
    robot_send(bob, x).
test(who_cannot_join,
     [ forall(member(Goal-Formal,
                     [ robots_join(redis('localhost:1'))
                       -existence_error(redis_server, localhost:1),
                       robots_join(_)-instantiation_error,
                       robots_join(redis(_))-instantiation_error,
                       robots_join(redis(1))-domain_error(redis_address, 1),
                       robots_join(here)-domain_error(redis_address, here),
                       with_sim(room, robots_join(redis(localhost)), [clock(virtual)])
                       -permission_error(join, clock, virtual) ])),
       error(Formal) ]) :-
    Goal.
test(one_joins_once, error(permission_error(join, redis, _))) :-
    with_redis_server(Port, joined(Port, robots_join(redis(localhost:Port)))).
:- end_tests(robots_joined).
