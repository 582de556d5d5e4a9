% The journal: what was done, when, and why; and again.

:- use_module('../support/trees').
:- use_module(library(ev3dev/drive)).
:- use_module(library(ev3dev/events), [both/2]).
:- use_module(library(ev3dev/grid)).
:- use_module(library(ev3dev/journal)).
:- use_module(library(ev3dev/navigation)).
:- use_module(library(ev3dev/odometry)).

%   What why/1 prints.

said(What, Line) :-
    retractall(printed(_)),
    setup_call_cleanup(
        asserta((user:message_hook(Term, help, Lines) :-
                     test_journal_note(Term, Lines)), Ref),
        ( What = Of-Time -> why(Of, at(Time)) ; why(What) ),
        erase(Ref)),
    retract(printed(Line)),
    !.

:- multifile user:message_hook/3.
:- dynamic
    user:message_hook/3,
    printed/1.

test_journal_note(ev3dev(_), Lines) :-
    with_output_to(string(Line),
                   print_message_lines(current_output, '', Lines)),
    split_string(Line, "", "\n", [Text]),
    assertz(printed(Text)).

in_room(Goal) :-
    with_sim(room,
             ( sim_place(80, 80, 0),
               set_robot(5.6, 10.6, outB, outC),
               Goal )).

:- meta_predicate in_room(0).

:- begin_tests(because).
test(the_causes_of_a_command_are_its_innermost_first,
     [ forall(tree(Tree)), true(Causes == [inner, outer(1)]) ]) :-
    with_tree(Tree, ( because(because(motor_run(outB, 20), inner), outer(1)),
                      why(outB, why(_, _, Causes0)),
                      once(append(Causes, [called(motor_run/2)], Causes0)) )).
test(a_cause_ends_with_its_goal,
     [ forall(member(Goal, [ because(true, bad),
                             \+ because(fail, bad),
                             catch(because(throw(x), bad), x, true),
                             ( because(member(_, [1, 2]), bad), true ),
                             forall(because(member(_, [1, 2]), bad), true),
                             findall(X, because(X = 1, bad), _),
                             \+ \+ because(true, bad) ])),
       true(Causes == [called(motor_run/2)]) ]) :-
    in_room(( Goal,
              motor_run(outB, 20),
              why(outB, why(_, _, Causes)) )).
test(the_outer_cause_is_back_after_the_inner_one,
     [ forall(member(Inner, [true, fail, throw(x)])),
       true(Causes == [outer, called(motor_run/2)]) ]) :-
    in_room(( because(( catch(ignore(because(Inner, inner)), x, true),
                        motor_run(outB, 20) ), outer),
              why(outB, why(_, _, Causes)) )).
test(goals_that_go_on_at_the_same_time_keep_their_causes,
     [ condition(current_predicate(system:engine_create/3)),
       true([A, B, C] == [[first, outer, called(motor_run/2)], [second, outer, called(motor_run/2)],
                          [outer, called(motor_run/2)]]) ]) :-
    in_room(( because(( both(because(( wait(2), motor_run(outA, 20) ), first),
                             because(( wait(1), motor_run(outB, 20), wait(2) ), second)),
                        motor_run(outC, 20) ), outer),
              why(outA, why(_, _, A)), why(outB, why(_, _, B)), why(outC, why(_, _, C)) )).
test(a_goal_is_called_once, true(Xs == [1])) :-
    findall(X, because(member(X, [1, 2]), cause), Xs).
test(a_cause_keeps_what_it_was_bound_to,
     true(Cause =@= rule(avoid, (us_dist_cm(_, 18), 18 < 25)))) :-
    in_room(( D = 18,
              because(motor_run(outB, 20), rule(avoid, (us_dist_cm(_, D), D < 25))),
              why(outB, why(_, _, [Cause|_])) )).
test(a_cause_may_have_constrained_variables, true(Cause =@= f(_))) :-
    in_room(( freeze(X, true),
              because(motor_run(outB, 20), f(X)),
              why(outB, why(_, _, [Cause|_])) )).
test(each_thread_has_its_own_cause, true(Causes == [called(motor_run/2)])) :-
    in_room(( because(( thread_create(motor_run(outB, 20), Thread, []),
                        thread_join(Thread, _) ), outer),
              why(outB, why(_, _, Causes)) )).
test(an_error_names_what_the_goal_called,
     error(_, context(motor_run/2, _))) :-
    in_room(because(motor_run(outB, fast), cause)).
test(what_is_no_goal_throws, error(type_error(callable, 7), context(because/2, _))) :-
    because(7, cause).
test(an_unbound_cause_throws, error(instantiation_error, _)) :-
    because(true, _).
test(old_causes_are_forgotten, true(Count =< 4100)) :-
    forall(between(1, 10000, N), because(true, n(N))),
    predicate_property(ev3dev_causes:cause(_, _, _), number_of_clauses(Count)).
test(a_cause_is_kept_while_it_lasts,
     true(Causes == [last, long, called(motor_run/2)])) :-
    in_room(( because(( forall(between(1, 10000, N), because(true, n(N))),
                        because(motor_run(outB, 20), last) ), long),
              forall(between(1, 4000, N), because(true, n(N))),
              why(outB, why(_, _, Causes)) )).
test(no_cause_is_kept_for_ever, true(Count =< 4100)) :-
    because(forall(between(1, 5000, N), because(true, n(N))), long),
    forall(between(1, 13000, N), because(true, n(N))),
    predicate_property(ev3dev_causes:cause(_, _, _), number_of_clauses(Count)).
:- end_tests(because).

:- begin_tests(why).
test(a_motor_that_runs,
     [ forall(tree(Tree)),
       true(Command == tacho_motor('run-forever', [speed_sp(-315)])) ]) :-
    with_tree(Tree, ( motor_run(outB, -30),
                      why(outB, why(_, Command, _)) )).
test(a_port_is_spelled_in_any_way,
     [ forall(member(Port, [outB, "outB", 'ev3-ports:outB'])) ]) :-
    in_room(( motor_run(outB, -30),
              why(Port, why(_, tacho_motor(_, _), _)) )).
test(nothing_is_known_of_a_motor_without_a_command, fail) :-
    in_room(( motor_run(outB, 20), why(outC, _) )).
test(a_new_simulation_has_an_empty_journal, true(Journal == [])) :-
    in_room(motor_run(outB, 20)),
    in_room(journal(Journal)).
test(a_refused_command_is_not_recorded,
     [ forall(member(Goal, [motor_run(outB, 101), motor_run(outD, 20),
                            go_cm(101, 10)])),
       true(Journal == []) ]) :-
    in_room(( \+ Goal, journal(Journal) )).
test(what_the_words_of_the_kernel_need_is_recorded,
     [ forall(member(Goal-Command,
                     [ motor_run(outB, 50, 360)
                       -tacho_motor('run-to-rel-pos',
                                    [speed_sp(525), position_sp(360),
                                     stop_action(hold)]),
                       ( speed_sp(outB, 200), motor_attribute(outB, command, 'run-forever') )
                       -tacho_motor('run-forever', [speed_sp(200)]),
                       motor_stop(outB, coast)
                       -tacho_motor(stop, [stop_action(coast)]),
                       motor_reset(outB)-tacho_motor(reset, []) ])),
       true(Found == Command) ]) :-
    in_room(( Goal, why(outB, why(_, Found, _)) )).
test(the_motor_of_a_wheel_is_driven,
     true(Causes = [course(legs([arc(20.0, 0.0)], false), _), rule(wander, true)])) :-
    in_room(( because(go_cm(30, 20, [wait(false)]), rule(wander, true)),
              why(outB, why(_, Command, Causes)),
              assertion(Command == drive) )).
test(the_robot_follows_a_course,
     true(Why = why(_, course(wheels(_, _), _), [mine]))) :-
    in_room(( because(arc(30, 20), mine), why(robot, Why) )).
test(what_the_drive_does_between_is_not_recorded, true(Count == 2)) :-
    in_room(( go_cm(30, 20), journal(Journal), length(Journal, Count) )).
test(the_end_of_a_course_has_its_reason_and_its_cause,
     [ forall(member(What, [robot, outB])),
       true(Why = why(_, ended(reached), [course(_, _), mine])) ]) :-
    in_room(( because(go_cm(30, 20), mine), why(What, Why) )).
test(a_motor_that_was_commanded_on_the_way, true(Causes == [called(motor_run/2)])) :-
    in_room(( arc(30, 20), wait(0.5), motor_run(outB, 20), wait(0.5),
              why(outB, why(_, _, Causes)) )).
test(at_a_time, true(Text == "outB runs at 20 %, since 0.00 s: first")) :-
    with_sim(room, ( because(motor_run(outB, 20), first), wait(2),
                     because(motor_run(outB, 40), second),
                     said(outB-1.0, Text) )).
test(the_robot_s_motor, true(Why = why(_, wheel(outC, tacho_motor(_, _)), _))) :-
    in_room(( go(20), why(robot, Why) )).
test(the_last_stop,
     true(Why = why(_, stop(outC, tacho_motor(stop, [stop_action(brake)])), [mine|_]))) :-
    in_room(( go(20), because(stop, mine), motor_run(outA, 20), why(stop, Why) )).
test(why_the_robot_stopped_on_its_way,
     true(Why = why(_, stop(robot(outB, outC), ended(stalled)), _))) :-
    in_room(( sim_jam(outB, true), go_cm(30, 20, [reason(_)]), why(stop, Why) )).
test(what_leaves_a_move_stops_its_motor_for_the_same_cause,
     true(Causes = [mine|_])) :-
    in_room(( catch(because(( sim_time(Now), At is Now + 0.5,
                              sim_at(At, throw(x)),
                              motor_run(outB, 20, 3600) ), mine), x, true),
              why(stop, why(_, stop(outB, _), Causes)) )).
test(the_time_is_that_of_the_tree, true(Time =:= Before)) :-
    in_room(( wait(2), ev3_time(Before), motor_run(outB, 20),
              why(outB, why(Time0, _, _)),
              ( near(Time0, Before, 0.01) -> Time = Before ; Time = Time0 ) )).
test(a_light, true(Commands == [led(red), led(levels(10, 20)),
                                led_trigger(heartbeat), led_blink(100, 200)])) :-
    in_room(( led(left, red), led(left, levels(10, 20)),
              led_trigger(left, heartbeat), led_blink(left, 100, 200),
              journal(Journal),
              findall(C, member(command(_, left, C, _), Journal), Commands) )).
test(a_sound, true(Sounds == [tones([tone(440, 100)]), say(hello)])) :-
    in_room(( tone(440, 100), say(hello),
              journal(Journal),
              findall(S, member(command(_, sound, S, _), Journal), Sounds) )).
test(a_servo_and_a_motor_without_rotation_sensor,
     true(Commands == [ outB-dc_motor('run-forever', [duty_cycle_sp(50)]),
                        'in1:i2c88:sv1'-servo_motor(run, [position_sp(30)]) ])) :-
    with_tree(plain, [outB-'rcx-motor', 'in1:i2c88:sv1'-'ms-8ch-servo'],
              ( dc_motor_run(outB, 50),
                servo_motor_position('in1:i2c88:sv1', 30),
                journal(Journal),
                findall(What-C, member(command(_, What, C, _), Journal), Commands) )).
test(what_is_no_name_throws, error(type_error(atom, 7), context(why/2, _))) :-
    why(7, _).
:- end_tests(why).

:- begin_tests(words).
test(a_command_in_words, [ forall(sentence(Goal, What, Text)), true(Line == Text) ]) :-
    in_room(( wait(2), Goal, said(What, Line) )).

sentence(because(motor_run(outB, -30),
                 rule(avoid, (us_dist_cm(_, 18.4), 18.4 < 25))), outB,
         "outB runs at -30 %, since 2.01 s: rule avoid, us_dist_cm 18.4 < 25").
sentence(motor_run(outB, 30), outB,
         "outB runs at 30 %, since 2.01 s: motor_run/2 was called").
sentence(true, outB, "outB: no command is recorded").
sentence(because(motor_run(outB, 50, 360), event(e1, touch(in4, 1))), outB,
         "outB was turned by 360 degrees at 50 % at 2.01 s: event e1, touch in4 1").
sentence(( motor_gear(outB, 3), motor_run(outB, 50, 120) ), outB,
         "outB was turned by 120 degrees at 50 % at 2.02 s: motor_run/4 was called").
sentence(because(arc(30, 20), golog(go(kitchen))), robot,
         "the robot runs its wheels at 30 % and 17 %, since 2.02 s: golog: go(kitchen)").
sentence(because(motor_run(outB, 30), golog(12, drive(3), at(robot) = 2)),
         outB,
         "outB runs at 30 %, since 2.01 s: golog: step 12, drive(3): poss at(robot)=2").
sentence(because(because(motor_run(outB, 30), golog(1, drive(3), true)),
                 interrupt(calls > 0)), outB,
         "outB runs at 30 %, since 2.01 s: golog: step 1, drive(3); interrupt calls>0").
sentence(because(turn(30, 90, [wait(false)]), rule(x, true)), outB,
         "outB drives the robot, since 2.02 s: move \"turn by 90 degrees at 30 %\"; rule x").
sentence(because(motor_run(outB, 30), rule(r, (\+ touch(in4, 1), (light(9) ; a)))), outB,
         "outB runs at 30 %, since 2.01 s: rule r, not touch in4 1, light 9 or a").
sentence(go_to(10, 20, [wait(false)]), robot,
         "the robot goes to (10, 20) at 40 %, since 2.02 s").
sentence(go_to(0, 20.123, 0, [wait(false), speed(30)]), robot,
         "the robot goes to (0, 20.12), turns to heading 0 at 30 %, since 2.02 s").
sentence(face(887.4567, [wait(false), speed(30)]), robot,
         "the robot turns to heading 167.46 at 30 %, since 2.02 s").
sentence(motor_stop(outB, hold), stop,
         "outB was stopped (hold) at 2.01 s: motor_stop/2 was called").
sentence(( go(20), wait(1), because(stop, halt) ), stop,
         "outB and outC were stopped (brake) at 3.01 s: halt").
sentence(( motor_run(outA, 20), go(20), wait(1), stop_all_motors ), stop,
         "outA, outB and outC were stopped (brake) at 3.01 s: stop_all_motors/0 was called").
sentence(( motor_run(outA, 20), go(20), wait(1), stop_all_motors ), robot,
         "outB and outC were stopped (brake) at 3.01 s: stop_all_motors/0 was called").
sentence(( go(20), motor_stop(outB, hold), motor_stop(outC, hold) ), outC,
         "outC was stopped (hold) at 2.01 s: motor_stop/2 was called").
sentence(( go(20), motor_stop(outB, hold), motor_stop(outC, brake) ), stop,
         "outC was stopped (brake) at 2.01 s: motor_stop/2 was called").
sentence(( go(20), motor_stop(outB, hold), because(motor_stop(outC, hold), x) ), stop,
         "outC was stopped (hold) at 2.01 s: x").
sentence(( go(20), motor_stop(outB, hold), wait(0.1), motor_stop(outC, hold) ), stop,
         "outC was stopped (hold) at 2.11 s: motor_stop/2 was called").
sentence(( motor_reset(outB), motor_reset(outC) ), stop,
         "outB and outC were reset at 2.02 s: motor_reset/1 was called").
sentence(because(motor_run(outB, 20), rule(r, (us_dist_cm(_, D), D < 9))), outB,
         "outB runs at 20 %, since 2.01 s: rule r, us_dist_cm, _ < 9").
sentence(because(motor_run(outB, 20), rule(r, (near(in1, 7, force), 7 < 9, x))), outB,
         "outB runs at 20 %, since 2.01 s: rule r, near 7 < 9, x").
sentence(because(motor_run(outB, 20), f(_, g(_))), outB,
         "outB runs at 20 %, since 2.01 s: f(_,g(_))").
sentence(because(motor_run(outB, 20), rule(r, G)), outB,
         "outB runs at 20 %, since 2.01 s: rule r, _") :-
    member(G, [_, _:_]).
sentence(led(left, green), left,
         "the light left is green, since 2.01 s: led/2 was called").
sentence(led_blink(left, 100, 200), left,
         "the light left blinks (100 ms on, 200 off), since 2.51 s: led_blink/3 was called").
sentence(because(tones([tone(440, 100), tone(880, 100)]), song), sound,
         "the brick played 440 Hz 880 Hz at 2.01 s: song").
sentence(because(say(hello), greeting), sound, "the brick said hello at 2.01 s: greeting").
sentence(because(sound_stop, quiet), sound, "the brick was silenced at 2.01 s: quiet").
:- end_tests(words).

:- begin_tests(libraries).
test(the_grid_says_its_plan, true(Steps == [plan(move, [0, 1]), plan(move, [0, 2])])) :-
    with_sim(grid,
             ( set_robot(5.6, 10.6, outB, outC), set_grid([]),
               plan_and_go_to([0, 2], _),
               journal(Journal),
               findall(Step,
                       ( member(command(_, robot(_, _), course(_, _), Causes), Journal),
                         member(Step, Causes), Step = plan(_, _) ),
                       Steps0),
               distinct(Steps0, Steps) )).
test(the_navigation_says_its_leg, true(Legs == [look, go])) :-
    with_sim(room,
             ( set_robot(5.6, 10.6, outB, outC),
               sim_pose(X, Y, H), set_pose(X, Y, H),
               Y1 is Y + 20,
               navigate_to([bounds(0, 0, 300, 250)], X-Y1, [reason(_)]),
               journal(Journal),
               findall(Name,
                       ( member(command(_, robot(_, _), course(_, _), Causes), Journal),
                         member(leg(Leg), Causes),
                         functor(Leg, Name, _) ),
                       Legs0),
               sort(0, @>, Legs0, Legs) )).

distinct([], []).
distinct([X|Xs0], [X|Xs]) :-
    exclude(==(X), Xs0, Xs1),
    distinct(Xs1, Xs).
:- end_tests(libraries).

:- begin_tests(replay).
:- meta_predicate replayed(0, -, -).

almost(A, B) :-
    near(A, B, 0.5).

%   The pose after Goal, and after its replay from the same place.

replayed(Goal, Pose1, Pose2) :-
    with_journal(File,
        ( in_room(( Goal, sim_pose(X1, Y1, H1), journal(File) )),
          in_room(( journal_replay(File), sim_pose(X2, Y2, H2),
                    assertion(at_rest) )) )),
    Turned is H2 - H1,
    heading_wrapped(Turned, Wrapped),
    Pose1 = [X1, Y1, 0],
    Pose2 = [X2, Y2, Wrapped].

:- meta_predicate with_journal(-, 0).

with_journal(File, Goal) :-
    with_file("", File, Goal).

test(does_the_same_again,
     [ forall(member(Goal,
                     [ ( motor_run(outB, 30), wait(1), motor_run(outC, 30),
                         wait(1), stop ),
                       ( go(30), wait(1) ),
                       motor_run(outB, 50, 360),
                       ( motor_run(outB, 50, 360), motor_run(outC, 50, -360) ),
                       ( go_cm(40, 30), turn(30, 90), go_cm(40, 20) ),
                       ( set_pose(0, 0, 0), go_to(10, 20), go_to(0, 0, 90, []) ),
                       ( arc(30, 20), wait(1), stop ),
                       follow([0-10, 10-20, 20-20]),
                       ( drive_cm(10, 20), wait(1), drive_cm(20, -20), wait(1),
                         stop ) ])),
       true ]) :-
    replayed(Goal, Pose1, Pose2),
    maplist(almost, Pose1, Pose2).
test(what_was_left_early_is_left_again) :-
    replayed(go_cm(20, 100, [timeout(1), reason(_)]), Pose1, Pose2),
    maplist(almost, Pose1, Pose2).
test(a_replay_gives_the_same_commands_and_stops,
     [ forall(member(Goal,
                     [ ( led(left, red), led(right, levels(1, 2)), led_trigger(left, heartbeat),
                         led_blink(left, 100, 200) ),
                       ( tone(440, 100), say(hello), nb_getval(wav, Wav), play(Wav), sound_stop ),
                       ( motor_run(outB, 30), wait(1), motor_reset(outB) ),
                       ( set_pose(1, 2, 3), go_cm(20, 5) ) ])),
       true(append(Commands, _, Again)) ]) :-
    with_wav(with_journal(File,
        ( in_room(( Goal, journal(File), commands(Commands) )),
          in_room(( journal_replay(File), commands(Again) )) ))).

commands(Commands) :-
    journal(Journal),
    findall(What-Command, member(command(_, What, Command, _), Journal), Commands).

%   With the name of a sound without samples in the global variable wav.
with_wav(Goal) :-
    atom_codes('RIFF----WAVEfmt ', Riff),
    append([ Riff, [16, 0, 0, 0, 1, 0, 1, 0, 64, 31, 0, 0, 64, 31, 0, 0, 1, 0, 8, 0],
             `data`, [0, 0, 0, 0] ], Codes),
    string_codes(Wav, Codes),
    with_file(Wav, File, ( nb_setval(wav, File), Goal )).

test(its_commands_say_that_they_are_a_replay, true(Causes = [replay(_)|_])) :-
    with_journal(File,
        ( in_room(( motor_run(outB, 30), journal(File) )),
          in_room(( journal_replay(File), why(stop, _),
                    journal([command(_, outB, _, Causes)|_]) )) )).
test(the_same_run_has_the_same_journal, true(Text1 == Text2)) :-
    journal_of_run(Text1),
    journal_of_run(Text2).

journal_of_run(Text) :-
    with_journal(File,
        ( in_room(( because(go_cm(40, 30), rule(a, us_dist_cm(_, _))),
                    because(motor_run(outB, 20, 30), f(user_error, X, X, [])),
                    journal(File) )),
          read_file_to_string(File, Text, []) )).

test(a_file_can_be_read_with_other_operators) :-
    with_journal(File,
        ( in_room(( setup_call_cleanup(
                        op(700, xfx, user:(~~>)),
                        ( X =.. [~~>, a, b],
                          current_output(Stream),
                          because(motor_run(outB, 20), [X, Stream, 'A b', "s", Y-Y]),
                          journal(File) ),
                        op(0, xfx, user:(~~>))) )),
          in_room(journal_replay(File)) )).
test(a_replay_that_is_left_ends_at_rest) :-
    with_journal(File,
        ( in_room(( go(30), wait(10), journal(File) )),
          in_room(( for_seconds(1, journal_replay(File)), at_rest )) )).
test(an_empty_journal_is_replayed) :-
    with_journal(File,
        in_room(( journal(File), journal_replay(File) ))).
test(a_missing_motor_fails_and_moves_nothing) :-
    with_file("command(0, outB, tacho_motor('run-forever', [speed_sp(100)]), []).
command(1, outD, tacho_motor('run-forever', [speed_sp(100)]), []).", File,
              in_room(( \+ journal_replay(File), journal(Journal) ))),
    assertion(Journal == []).
test(a_missing_file_throws,
     error(existence_error(source_sink, nowhere), context(journal_replay/1, _))) :-
    in_room(journal_replay(nowhere)).
test(what_is_no_fact_of_a_journal_throws_with_its_line,
     [ forall(bad_fact(Fact)), true(Line == 2) ]) :-
    format(string(Text),
           "command(0, outB, tacho_motor(stop, []), []).~n~w.~n", [Fact]),
    with_file(Text, File,
              in_room(catch(journal_replay(File),
                            error(domain_error(journal_fact, _),
                                  fact(file(_, Line, _, _), _)), true))).
test(the_message_has_file_and_line) :-
    with_file("foo.", File,
              ( catch(in_room(journal_replay(File)), E, true),
                message_to_codes_of(E, Text),
                format(string(Place), "~w:1:0: ", [File]) )),
    assertion(sub_string(Text, _, _, _, Place)).
test(a_syntax_error_has_its_line,
     error(syntax_error(_), file(_, 2, _, _))) :-
    with_file("command(0, outB, tacho_motor(stop, []), []).\ncommand(.\n", File,
              in_room(journal_replay(File))).

bad_fact('foo').
bad_fact('X').
bad_fact('command(a, outB, tacho_motor(stop, []), [])').
bad_fact('command(0, outB, tacho_motor(stop, [x]), [])').
bad_fact('command(0, outB, tacho_motor(stop, [speed_sp(a)]), [])').
bad_fact('command(0, outB, fly, [])').
bad_fact('command(0, outB, X, [])').
bad_fact('command(0, X, tacho_motor(stop, []), [])').
bad_fact('command(0, sound, X, [])').
bad_fact('command(0, robot(outB, outC), course(legs([fly(1)], false), options(1, 1, hold, true)), [])').
bad_fact('command(0, robot(outB, outC), course(cruise(1, a), options(1, 1, hold, true)), [])').
bad_fact('command(0, robot(outB, outC), course(X, options(1, 1, hold, true)), [])').
bad_fact('command(0, robot(outB, outC), course(wheels(1, 1), options(1, 1, jump, true)), [])').
bad_fact('command(0, sound, tones([a]), [])').
bad_fact('command(0, left, led(f(x)), [])').
bad_fact('command(0, outB, tacho_motor(7, []), [])').
bad_fact('command(0, outB, tacho_motor(stop, x), [])').
bad_fact('command(0, outB, tacho_motor(stop, [fly(1)]), [])').
bad_fact('command(0, outB, tacho_motor(stop, []), x)').
bad_fact('command(0, robot(outB, 7), ended(reached), [])').
bad_fact('command(0, robot(outB, outC), ended(7), [])').
bad_fact('command(0, robot(outB, outC), pose(1, a, 1), [])').
bad_fact('command(0, robot(outB, outC), course(wheels(1, 1), options(1, a, hold, true)), [])').
bad_fact('command(0, robot(outB, outC), course(wheels(1, 1), options(1, 1, hold, 7)), [])').
bad_fact('command(0, robot(outB, outC), course(fly(1, 1), options(1, 1, hold, true)), [])').
bad_fact(Fact) :-
    member(Legs, ['x, false', '[], 7', '[turn(a)], false', '[to(1)], false', '[through([1], 5)], false',
                  '[through([1-a], 5)], false', '[through([1-2], a)], false', '[through(x, 5)], false']),
    format(atom(Fact), 'command(0, robot(outB, outC), course(legs(~w), \c
                        options(1, 1, hold, true)), [])', [Legs]).
bad_fact(Fact) :-
    member(Sound, [say(7), play(7), tones(x), 'tones([tone(1, a)])', 'tones([tone(1, -1)])', fly]),
    format(atom(Fact), 'command(0, sound, ~w, [])', [Sound]).
bad_fact(Fact) :-
    member(Light, ['led(levels(1, a))', 'led(levels(1, 2, -1))', 'led(-1)', 'led_trigger(7)',
                   'led_blink(1, a)']),
    format(atom(Fact), 'command(0, left, ~w, [])', [Light]).
bad_fact('end(x)').
bad_fact('robot(outB, outC, 1, 1, 2, false, 10, 0)').
bad_fact('robot(outB, 7, 1, 1, true, false, 10, 0)').
bad_fact('robot(outB, outC, 1, a, true, false, 10, 0)').
bad_fact(':- halt').

message_to_codes_of(E, Text) :-
    message_to_lines(E, Lines),
    with_output_to(string(Text),
                   print_message_lines(current_output, '', Lines)).

message_to_lines(E, Lines) :-
    phrase('$messages':translate_message(E), Lines).
:- end_tests(replay).

:- begin_tests(journal).
test(it_is_in_order, true(Times == Sorted)) :-
    in_room(( forall(between(1, 20, _), ( motor_run(outB, 20), motor_stop(outB, brake) )),
              journal(Journal),
              findall(T, member(command(T, _, _, _), Journal), Times),
              length(Times, Count),
              assertion(Count == 40),
              msort(Times, Sorted) )).
test(old_commands_are_forgotten, true(Count == 8192)) :-
    in_room(( forall(between(1, 8300, _), motor_run(outB, 20)),
              journal(Journal),
              length(Journal, Count) )).
test(a_file_that_cannot_be_written_throws,
     error(existence_error(_, _), context(journal/1, _))) :-
    in_room(journal('/nowhere/at/all')).
test(what_is_no_file_throws, error(type_error(atom, 7), context(journal/1, _))) :-
    journal(7).
:- end_tests(journal).
