:- use_module('../support/trees').
:- use_module(library(ev3dev/drive)).
:- use_module(library(ev3dev/journal)).
:- use_module(library(ev3dev/rules),
              except([on/2])).

% ---------------- SUPPORT

% Guards that the test makes true, and what happens.
:- dynamic up/1, value/1, done/2.

raise(Signal) :- assertz(up(Signal)).
lower(Signal) :- retractall(up(Signal)).

note(What) :-
    ev3_time(Time),
    assertz(done(Time, What)).

% Goal with a robot on an endless floor, and what it noted. Plan is a list of
% Seconds-Goal.
:- meta_predicate noted(+, 0, -).

noted(Plan, Goal, Notes) :-
    with_sim([],
             ( set_robot(5.6, 10.6, outB, outC),
               forget,
               forall(member(Seconds-Planned, Plan), sim_at(Seconds, Planned)),
               call_cleanup(once(Goal),
                            findall(Time-What, retract(done(Time, What)), Notes0)),
               forget
             )),
    Notes = Notes0.

forget :-
    retractall(up(_)),
    retractall(value(_)),
    retractall(done(_, _)).

whats(Notes, Whats) :-
    findall(What, member(_-What, Notes), Whats).

changes(Notes, Changes) :-
    findall(What, ( member(_-What, Notes), What \= called(_) ), Changes).

at_time(What, Notes, Time) :-
    memberchk(Time-What, Notes).

:- meta_predicate with_messages(+, 0, -).

% The messages of a kind that Goal prints.
with_messages(Kind, Goal, Messages) :-
    setup_call_cleanup(
        asserta((user:message_hook(ev3dev(Term), Kind, _) :-
                     assertz(printed(Term))), Ref0),
        setup_call_cleanup(
            asserta((user:message_hook(error(Formal, Context), Kind, _) :-
                         assertz(printed(error(Formal, Context)))), Ref1),
            once(Goal),
            erase(Ref1)),
        erase(Ref0)),
    findall(M, retract(printed(M)), Messages).

:- dynamic printed/1.
:- multifile user:message_hook/3.
:- dynamic user:message_hook/3.

move_a  :: up(a) ~> note(called(a)), go_cm(30, 20).
go_a    :: up(a) ~> note(called(a)), go(30).
turn_b  :: up(b) ~> note(called(b)), turn(20, 360).
wander  :: true  ~> note(called(wander)), go(40).
far     :: true  ~> note(called(far)), go_cm(20, 100).
follow  :: value(S) ~> note(called(S)), go(S).
lift    :: up(a) ~> motor_run(outA, 20), wait(1).

behave_for(Seconds, Rules) :-
    behave_for(Seconds, Rules, []).

behave_for(Seconds, Rules, Options) :-
    behave(Rules, [timeout(Seconds), trace(user:note)|Options]).

% ---------------- CHOICE

:- begin_tests(choice).
test(the_first_rule_that_holds_is_active,
     true(Whats == [rule(go_a), called(a)])) :-
    noted([0-raise(a), 0-raise(b)], behave_for(1, [go_a, turn_b, wander]), Notes),
    whats(Notes, Whats).
test(an_earlier_rule_suppresses_within_a_period,
     true(Changes == [rule(far), suppressed(far), rule(go_a)])) :-
    noted([1-raise(a)], behave_for(2, [go_a, far]), Notes),
    changes(Notes, Changes),
    at_time(rule(go_a), Notes, Time),
    near(Time, 1.0, 0.021).
test(a_later_rule_does_not, true(Whats == [rule(far), called(far)])) :-
    noted([1-raise(a)], behave_for(2, [far, go_a]), Notes),
    whats(Notes, Whats).
test(the_guard_of_an_action_that_waits_is_not_looked_at,
     true(Whats == [rule(turn_b), called(b)])) :-
    noted([0-raise(b), 0.5-lower(b)], behave_for(2, [turn_b]), Notes),
    whats(Notes, Whats).
test(an_until_around_it_looks_every_20_ms_whatever_its_period, true(Which == condition)) :-
    noted([], ( until(( ev3_time(Now), Now > 1.1 ),
                      behave([(r :: true ~> wait(9))], [period(0.5)]), Which),
                ev3_time(T) ), _),
    near(T, 1.1, 0.03).
test(bindings_of_the_guard_reach_the_action, true(Whats == [rule(r), 7])) :-
    noted([], behave_for(0.5, [(r :: member(X, [7, 8]) ~> note(X))]), Notes),
    whats(Notes, Whats).
test(rules_stand_in_the_list_with_options, true(Whats == [rule(r(1)), 1])) :-
    noted([], behave_for(0.5, [(r(1), cooldown(1) :: true ~> note(1))]), Notes),
    whats(Notes, Whats).
test(the_journal_has_the_values_of_the_guard,
     [ forall(member(Action, [wait(5), go(20)])), true(Guard == (value(7), 7 < 9)) ]) :-
    with_sim([], ( set_robot(5.6, 10.6, outB, outC), forget,
                   sim_at(0.5, assertz(value(7))),
                   behave([ (see  :: value(X), X < 9 ~> led(left, red)),
                            (wait :: true ~> Action) ], [timeout(1)]),
                   why(left, why(_, _, [rule(see, Guard0)|_])),
                   Guard = Guard0, forget )).
test(from_a_change_to_the_first_write_it_is_a_period_at_most,
     [ forall(member(Action, [wait(60), go(20)])), true(Late == []) ]) :-
    % The rest of the read that was too early, a period, the read that sees the
    % change, and the write. A read is that of two files.
    Most is 0.001 + 0.020 + 0.001 + 0.0001,
    findall(Seconds,
            ( between(0, 10, Step), reaction(Action, Step, Seconds),
              Seconds > Most + 1.0e-6 ),
            Late).
test(the_journal_has_the_values_of_a_guard_whose_rule_suppresses,
     true(Cause == rule(near, ( value(7), 7 > 5 )))) :-
    noted([1-note(7), 1-assertz(value(7))],
          ( behave_for(2, [ (near :: value(V), V > 5 ~> go_cm(20, -50)), wander ]),
            why(robot, why(_, _, [_, Cause|_])) ),
          _).
test(the_journal_says_why_the_robot_rests,
     [ forall(member(Seconds-Cause, [3-rules(none), 0.5-rules(ended)])),
       true(Causes = [Cause|_]) ]) :-
    noted([0-raise(a), 1-lower(a)],
          ( behave_for(Seconds, [go_a]), why(stop, why(_, _, Causes)) ),
          _).
test(without_a_rule_the_robot_rests,
     true(Changes == [rule(go_a), rest, rule(go_a)])) :-
    noted([ 0-raise(a), 1-lower(a), 1.5-note(speed), 3-raise(a) ],
          behave_for(4, [go_a]), Notes0),
    findall(N, ( member(N, Notes0), N \= _-speed ), Notes),
    changes(Notes, Changes).
test(at_the_end_it_rests, true(Reason == timeout)) :-
    with_sim([], ( set_robot(5.6, 10.6, outB, outC),
                   behave([wander], [timeout(1), reason(Reason)]),
                   at_rest, forget )).
test(an_action_that_catches_everything_is_left,
     true(Changes == [rule(stubborn), suppressed(stubborn), rule(go_a)])) :-
    noted([1-raise(a)],
          behave_for(2, [ go_a,
                          (stubborn :: true ~> catch(go_cm(20, 90), _, true),
                                               catch(wait(90), _, true), wait(90))
                        ]), Notes),
    changes(Notes, Changes),
    at_time(rule(go_a), Notes, Time),
    near(Time, 1.0, 0.07).
test(an_action_that_only_reads_sensors_is_left,
     true(Changes == [rule(reads), suppressed(reads), rule(go_a)])) :-
    noted([1-raise(a)],
          behave_for(2, [ go_a, (reads :: true ~> repeat, us_dist_cm(in1, _), fail) ]),
          Notes),
    changes(Notes, Changes),
    at_time(rule(go_a), Notes, Time),
    near(Time, 1.0, 0.025).
test(the_clean_up_of_a_suppressed_action_runs,
     true(Whats == [rule(clean), cleaned, suppressed(clean), rule(go_a), called(a)])) :-
    noted([1-raise(a)],
          behave_for(2, [ go_a,
                          (clean :: true ~> setup_call_cleanup(true, wait(5), note(cleaned)))
                        ]), Notes),
    whats(Notes, Whats).

% Another thread changes what the sensor shows.
reaction(Action, Step, Seconds) :-
    with_sim([],
             ( set_robot(5.6, 10.6, outB, outC),
               us_dist_cm(in1, _), motor_run(outA, 10), motor_stop(outA),
               sim_time(Now),
               After is 0.2 + Step*0.0021,
               Change is Now + After,
               thread_create(( sim_wait(After), sim_show(in1, value0, 100) ), Id, []),
               behave([ (near :: us_dist_cm(in1, D), D < 30 ~> motor_run(outA, 50)),
                        (before :: true ~> Action) ], [timeout(0.3)]),
               thread_join(Id, _),
               sim_trace(Events),
               once(( member(Time-written('tacho-motor/motor0/speed_sp', _), Events),
                      Time >= Change )),
               Seconds is Time - Change )).
:- end_tests(choice).

% ---------------- ACTIONS

:- begin_tests(actions).
test(an_action_is_called_once, true(Whats == [rule(wander), called(wander)])) :-
    noted([], behave_for(3, [wander]), Notes),
    whats(Notes, Whats).
test(it_is_called_again_for_other_values,
     true(Whats == [rule(follow), called(10), called(20)])) :-
    noted([ 0-assertz(value(10)),
            1-( retractall(value(_)), assertz(value(20)) ) ],
          behave_for(2, [follow]), Notes),
    whats(Notes, Whats).
test(without_a_rule_after_one_that_has_ended_it_rests,
     true(Changes == [rule(left_on), ended(left_on), rest])) :-
    noted([ 0-raise(a), 1-( \+ ( motor_states(_, States), memberchk(running, States) ) ) ],
          behave_for(2, [ (left_on :: up(a) ~> wait(0.5), motor_run(outA, 20)) ]), Notes),
    changes(Notes, Changes).
test(commanding_the_same_costs_no_speed) :-
    findall(T-( speed(outB, S), note(speed(S)) ), ( between(1, 12, I), T is 0.9 + I*0.02 ),
            Looks),
    noted([ 0-raise(a), 1-lower(a) | Looks ],
          behave_for(2, [(one :: up(a) ~> go(40)), (other :: true ~> go(40))]), Notes),
    length(Looks, Count),
    findall(S, member(_-speed(S), Notes), Speeds),
    length(Speeds, Count),
    forall(member(S, Speeds), S > 350).
test(what_the_new_action_has_not_commanded_stops_at_its_first_wait,
     true(Notes == [running, []])) :-
    with_sim([], ( set_robot(5.6, 10.6, outB, outC), forget, raise(a),
                   sim_at(0.5, lower(a)),
                   behave([ (arm  :: up(a) ~> motor_run(outA, 20)),
                            (none :: true ~> motor_states(outA, S0), note(S0), wait(0.1),
                                             motor_states(outA, S), note(S), wait(5)) ],
                          [timeout(1)]),
                   findall(N, retract(user:done(_, N)), [[running|_], S1]) )),
    Notes = [running, S1].
test(what_runs_stops_at_the_first_wait_of_rules_within_rules,
     [ forall(member(Inner, [ (in :: true ~> go(20)), (in :: up(c) ~> true),
                              (in :: true ~> wait(5)) ])),
       true(Notes == [running, []]) ]) :-
    with_sim([], ( set_robot(5.6, 10.6, outB, outC), forget, raise(a),
                   sim_at(0.5, ( motor_states(outA, S0), note(S0), lower(a) )),
                   sim_at(0.6, ( motor_states(outA, S), note(S) )),
                   behave([ (arm :: up(a) ~> motor_run(outA, 20)),
                            (set :: true ~> behave([Inner])) ],
                          [timeout(1)]),
                   findall(N, retract(user:done(_, N)), [[running|_], S1]) )),
    Notes = [running, S1].
test(one_that_has_waited_and_ended_waits_for_its_guard,
     true(Changes == [ rule(move_a), ended(move_a), rule(wander),
                       rule(move_a), ended(move_a), rule(wander) ])) :-
    noted([ 0-raise(a), 4-lower(a), 5-raise(a) ],
          behave_for(9, [move_a, wander]), Notes),
    changes(Notes, Changes).
test(one_with_the_guard_true_is_called_again, true(Changes == Expected)) :-
    noted([], behave_for(2.5, [(w :: true ~> wait(1))]), Notes),
    changes(Notes, Changes),
    Expected = [rule(w), ended(w), rule(w), ended(w), rule(w)].
test(one_that_fails_warns_and_has_ended,
     true(Changes == [rule(fails), failed(fails), rule(go_a)])) :-
    noted([0-raise(a)],
          with_messages(warning, behave_for(1, [(fails :: up(a) ~> fail), go_a]), Warnings), Notes),
    changes(Notes, Changes),
    Warnings == [rule_failed(fails)].
test(while_leaves_it, true(Changes == [rule(w), suppressed(w), rule(wander)])) :-
    noted([ 0-raise(a), 1-lower(a) ],
          behave_for(2, [ (w, while(up(a)) :: up(a) ~> wait(9)), wander ]), Notes),
    changes(Notes, Changes),
    at_time(rule(wander), Notes, Time),
    near(Time, 1, 0.03).
test(while_keeps_one_that_has_returned, true(Changes == [rule(w), rule(wander)])) :-
    noted([ 0-raise(a), 0-raise(b), 1-lower(a), 2-lower(b) ],
          behave_for(3, [ (w, while(up(b)) :: up(a) ~> go(20)), wander ]), Notes),
    changes(Notes, Changes),
    at_time(rule(wander), Notes, Time),
    near(Time, 2, 0.03).
test(the_variables_of_while_are_its_own, true(Whats == [rule(w), 20])) :-
    noted([ 0-raise(a), 0-assertz(value(20)), 1-lower(a), 1-( retractall(value(_)),
                                                              assertz(value(30)) ) ],
          behave_for(2, [ (w, while(value(S)) :: up(a), value(S) ~> note(S), go(S)) ]), Notes),
    whats(Notes, Whats).
test(one_that_ended_may_apply_again_though_its_guard_was_false_while_another_acted,
     true(Whats == [rule(late), late, ended(late), rule(early), ended(early),
                    rule(late), late, ended(late)])) :-
    noted([ 0-raise(b), 1-raise(a), 1.5-lower(b), 2-raise(b) ],
          behave_for(4, [ (early :: up(a) ~> wait(2)), (late :: up(b) ~> note(late), wait(0.1)) ]),
          Notes),
    findall(What, ( member(_-What, Notes), What \== rest ), Whats).
test(min_time_keeps_it, true(Changes == [rule(w), rule(wander)])) :-
    noted([ 0-raise(a), 0.5-lower(a) ],
          behave_for(3, [ (w, min_time(2) :: up(a) ~> go(20)), wander ]), Notes),
    changes(Notes, Changes),
    at_time(rule(wander), Notes, Time),
    near(Time, 2, 0.06).
test(cooldown_keeps_it_away, true(Changes == [ rule(w), ended(w), rule(wander), rule(w),
                                               ended(w), rule(wander) ])) :-
    noted([ 0-raise(a), 0.7-lower(a), 0.8-raise(a) ],
          behave_for(4, [ (w, cooldown(2) :: up(a) ~> wait(0.5)), wander ]), Notes),
    changes(Notes, Changes),
    findall(T, member(T-rule(w), Notes), [_, Second]),
    near(Second, 2.5, 0.06).
test(one_that_cools_down_waits_for_its_guard_too, true(Changes == [rule(w), ended(w), rule(far)])) :-
    noted([ 0-raise(a) ],
          behave_for(4, [ (w, cooldown(1) :: up(a) ~> wait(0.5)), far ]), Notes),
    changes(Notes, Changes).
test(a_list_is_done_one_after_the_other, true(Whats == [rule(w), 1, 2, 3])) :-
    noted([], behave_for(5, [ (w :: true ~> [note(1):1.5, (note(2), wait(9)):2, note(3)]) ]),
          Notes),
    whats(Notes, Whats),
    forall(member(W-T, [1-0, 2-1.5, 3-3.5]),
           ( at_time(W, Notes, T0), near(T0, T, 0.06) )).
test(an_error_names_the_rule,
     [ forall(member(Rule-Where, [ (bad :: true ~> atom_length(_, _))-action,
                                   (bad :: atom_length(_, _) ~> true)-guard ])),
       true(Found == Where), cleanup(forget) ]) :-
    catch(with_sim([], behave([Rule], [timeout(1)])),
          error(instantiation_error, context(_, Text)), true),
    format(atom(In), 'in the ~w of rule bad', [Where]),
    (   sub_atom(Text, _, _, 0, In)
    ->  Found = Where
    ;   Found = Text
    ).
test(errors_can_be_printed, true(Changes == Expected)) :-
    noted([], with_messages(error, behave_for(0.3, [ (bad :: up(_), fail ~> true),
                                              (worse :: true ~> throw(error(oh, _))) ],
                                       [on_error(continue)]), Ws), Notes),
    changes(Notes, Changes0),
    Ws = [error(oh, context(_, 'in the action of rule worse'))|_],
    Changes0 = [First, Second|_],
    Changes = [First, Second],
    Expected = [rule(worse), thrown(worse)].
test(an_exception_that_is_no_error_goes_through, [throws(over), cleanup(forget)]) :-
    with_sim([], behave([(r :: true ~> throw(over))])).
test(a_guard_must_not_move,
     [ forall(member(Guard, [ go(30), motor_run(outB, 20), motors_run([run(outB, 20)]),
                              motor_run_direct(outB, 20), motor_run_timed(outB, 20, 1) ])),
       true(Caught-States == permission_error(wait, guard, r)-[]) ]) :-
    with_sim([], ( set_robot(5.6, 10.6, outB, outC),
                   catch(behave([(r :: Guard ~> true)], [timeout(1)]),
                         error(Caught, _), true),
                   motor_states(outB, States) )).
test(a_guard_may_stop_or_light, true(Reason == timeout)) :-
    with_sim([], ( set_robot(5.6, 10.6, outB, outC),
                   behave([(r :: ( stop, led(left, red) ) ~> go(20))],
                          [timeout(0.2), reason(Reason)]) )).
test(a_guard_must_not_wait,
     [ forall(member(Guard, [ wait(1), go_cm(20, 5), button_wait(_, _) ])),
       error(permission_error(wait, guard, r), context(_, _)) ]) :-
    with_sim([], ( set_robot(5.6, 10.6, outB, outC),
                   behave([(r :: Guard ~> true)], [timeout(1)]) )).
:- end_tests(actions).

% ---------------- NESTING, MESSAGES

:- begin_tests(nested).
test(an_inner_behave_is_left_for_an_outer_rule,
     true(Changes == [ rule(inner), rule(go_a), suppressed(inner), rule(turn_b) ])) :-
    noted([ 0-raise(a), 1-raise(b) ],
          behave_for(2, [ turn_b,
                          (inner :: true ~> behave([go_a, far], [trace(user:note)])) ]), Notes),
    changes(Notes, Changes).
test(an_inner_one_lets_its_own_rules_change,
     true(Changes == [ rule(inner), rule(far), suppressed(far), rule(go_a) ])) :-
    noted([1-raise(a)],
          behave_for(2, [ (inner :: true ~> behave([go_a, far], [trace(user:note)])) ]), Notes),
    changes(Notes, Changes).
test(become_replaces_the_rules, true(Changes == [rule(w), suppressed(w), rule(wander)])) :-
    noted([], behave_for(2, [ (w :: true ~> wait(1), become([wander])) ]), Notes),
    changes(Notes, Changes).
test(a_state_is_read_and_set, true(Whats == [rule(a), start, rule(b), end(1)])) :-
    noted([], behave_for(1, [ (a :: state(start) ~> state(S), note(S), set_state(end(1))),
                              (b :: state(end(X)) ~> note(end(X))) ]), Notes),
    whats(Notes, Whats).
test(a_message_is_there_for_one_tick, true(Whats == [rule(m), got(hello), rule(wander)])) :-
    noted([1-send_message(hello)],
          behave_for(2, [ (m, cooldown(9) :: received(X) ~> note(got(X))),
                          (wander :: up(never) ~> true),
                          (wander :: up(_) ; true ~> true) ]), Notes0),
    drop_before(1, Notes0, Notes),
    whats(Notes, Whats).
test(until_ends_it, true(Reason-Near == until-true)) :-
    with_sim([], ( forget, sim_at(1, raise(a)),
                   behave([], [until(up(a)), reason(Reason), timeout(5)]), ev3_time(T) )),
    forget,
    ( near(T, 1, 0.03) -> Near = true ; Near = T ).
test(outside_of_a_behave_there_is_none,
     [ forall(member(Goal, [state(_), set_state(1), received(_), send_message(1), become([])])),
       error(permission_error(_, behavior, none), context(_, _)) ]) :-
    call(Goal).

drop_before(T0, Notes0, Notes) :-
    findall(T-What, ( member(T-What, Notes0), T >= T0 ), Notes).
:- end_tests(nested).

:- begin_tests(wrong).
test(an_unknown_rule, error(existence_error(rule, nobody), context(behave/1, _))) :-
    behave([nobody]).
test(a_misspelt_rule, Text == 'there is no rule wonder. Did you mean wander?') :-
    load_text(misspelt, "wander :: true ~> go(20). avoid :: us_dist_cm(_, D), D < 9 ~> stop."),
    catch(misspelt:behave([wonder]), error(existence_error(rule, wonder), context(_, Text)), true).
test(an_error_names_file_and_line,
     [ forall(member(Guard, ["atom_length(_, _)", "motor_run(outB, 20)"])),
       true(sub_atom(Text, _, _, 0, 'in the guard of rule a (placed:1)')) ]) :-
    format(string(Rule), "a :: ~s ~~> true.", [Guard]),
    load_text(placed, Rule),
    catch(with_sim([], placed:behave([a], [timeout(1)])), error(_, context(_, Text)), true).
test(what_is_no_rule, [forall(member(R, [7, "x"])), error(type_error(rule, R), _)]) :-
    behave([R]).
load_text(Module, Text) :-
    setup_call_cleanup(
        open_string(Text, In),
        ( Module:use_module(library(ev3dev)), Module:use_module(library(ev3dev/rules)),
          load_files(Module:Module, [stream(In)]) ),
        close(In)).

test(what_is_unbound, error(instantiation_error, _)) :-
    behave([_]).
test(a_list_of_steps_as_a_part_of_an_action,
     [ forall(member(Goal, [expand_term(Rule, _), behave([Rule])])),
       error(type_error(callable, [b]), _) ]) :-
    Rule = (r :: true ~> wait(1), [b]),
    call(Goal).
test(an_unknown_option_of_a_rule, error(domain_error(rule_option, hurry(1)), _)) :-
    behave([(r, hurry(1) :: true ~> true)]).
test(an_unknown_option, error(domain_error(behave_option, hurry(1)), _)) :-
    behave([], [hurry(1)]).

test(why_of_nothing, error(instantiation_error, context(why/1, _))) :-
    behave([(r :: true ~> true)], [timeout(0.1)]),
    why(_).
test(why_a_rule_does_not_apply, Whys == [ false(3 > 4), cooldown, active, above(c), ended,
                                          false(fail) ]) :-
    with_sim([], ( catch(behave([ (a :: X = 3, X > 4 ~> true), (e :: X = 3 ~> wait(0.1)),
                                  ((b, cooldown(9)) :: true ~> wait(0.1)),
                                  (c :: true ~> true), (d :: true ~> true),
                                  (f :: fail, true ~> true) ], [timeout(1)]), _, true),
                   findall(Why, ( member(R, [a, b, c, d, e, f]),
                                  why(rule(R), rule(Why0, none)),
                                  ( Why0 = cooldown(_) -> Why = cooldown ; Why = Why0 ) ),
                           Whys) )).
:- end_tests(wrong).
