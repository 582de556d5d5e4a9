:- use_module('../support/child').
:- use_module('../support/old_prolog').
:- use_module('../support/simulation').
:- use_module(library(ev3dev/drive)).
:- use_module(library(ev3dev/events)).

% What the test makes true, and what happens.
:- dynamic up/1, done/2, printed/1.

raise(Signal) :- assertz(up(Signal)).
lower(Signal) :- retractall(up(Signal)).

note(What) :-
    ev3_time(Time),
    assertz(done(Time, What)).

:- meta_predicate noted(+, 0, -).

% Goal with a robot on an endless floor, and what it noted.
noted(Plan, Goal, Notes) :-
    with_sim([],
             ( set_robot(5.6, 10.6, outB, outC),
               forget,
               forall(member(Seconds-Planned, Plan), sim_at(Seconds, user:Planned)),
               call_cleanup(once(Goal),
                            ( findall(T-What, retract(done(T, What)), Notes0), forget ))
             )),
    Notes = Notes0.

forget :-
    retractall(up(_)),
    retractall(done(_, _)),
    ignore(event_cancel(_)).

times(Notes, What, Times) :-
    findall(T, member(T-What, Notes), Times).

near_all([], []).
near_all([Time|Times], [Expected|Rest]) :-
    near(Time, Expected, 0.025),
    near_all(Times, Rest).

:- meta_predicate messages(0, -).

% The kinds and terms of the messages of events that Goal prints.
messages(Goal, Messages) :-
    setup_call_cleanup(
        asserta((user:message_hook(Term, Kind, _) :-
                     memberchk(Kind, [error, warning]),
                     assertz(printed(Kind-Term))), Ref),
        once(Goal),
        erase(Ref)),
    findall(M, retract(printed(M)), Messages).

:- multifile user:message_hook/3.
:- dynamic user:message_hook/3.

:- begin_tests(on).
test(it_happens_each_time_that_the_condition_becomes_true) :-
    noted([ 1-raise(a), 2-lower(a), 3-raise(a) ],
          ( on(up(a), note(up)), wait(5) ), Notes),
    times(Notes, up, Times),
    near_all(Times, [1, 3]).
test(bindings_reach_the_action, true(Whats == [b])) :-
    noted([1-raise(b)], ( on(up(X), note(X)), wait(2) ), Notes),
    findall(W, member(_-W, Notes), Whats).
test(it_is_served_in_every_kind_of_wait_and_read,
     [ forall(member(Goal, [ wait(2), go_cm(20, 40), motor_run(outA, 20, 400),
                             button_wait(_, _, [timeout(2)]),
                             tone(440, 2000), sim_wait(2), polls(2),
                             ( go(20), until(fail, wait(2)) ) ])) ]) :-
    noted([0.5-raise(a)], ( on(up(a), note(up)), ignore(Goal) ), Notes),
    times(Notes, up, Times),
    near_all(Times, [0.5]).
test(nothing_is_served_without_a_wait, true(Notes == [])) :-
    noted([], ( on(true, note(now)), numlist(1, 1000, Ns), sum_list(Ns, _) ), Notes).
% Each has happened and been rearmed another number of times before.
test(those_of_one_moment_happen_in_the_order_in_which_they_were_added,
     true(Whats == [b, c, b, a, b, c])) :-
    noted([ 1-raise(b), 1.5-raise(c), 2-lower(b), 3-raise(b), 4-lower(c), 5-lower(b),
            6-( raise(a), raise(b), raise(c) ) ],
          ( forall(member(Up, [a, b, c]), on(up(Up), note(Up))), wait(7) ), Notes),
    findall(W, member(_-W, Notes), Whats).
test(it_ends_after_its_count) :-
    noted([ 1-raise(a), 2-lower(a), 3-raise(a), 4-lower(a), 5-raise(a) ],
          ( on(up(a), note(up), [count(2), id(x)]), wait(6), \+ event(x, _) ), Notes),
    times(Notes, up, Times),
    near_all(Times, [1, 3]).
test(stable_ignores_what_is_short) :-
    noted([ 1-raise(a), 1.3-lower(a), 2-raise(a) ],
          ( on(up(a), note(up), [stable(0.5)]), wait(4) ), Notes),
    times(Notes, up, Times),
    near_all(Times, [2.5]).
test(rearm_is_another_condition) :-
    noted([ 1-raise(a), 1.5-lower(a), 2-raise(a), 3-raise(b), 3.015-lower(b) ],
          ( on(up(a), note(up), [rearm(up(b))]), wait(5) ), Notes),
    times(Notes, up, [First, Second]),
    near(First, 1, 0.03),
    near(Second, 3.02, 0.05).
test(one_that_is_not_armed_does_not_count_what_is_true_from_the_start) :-
    noted([ 1-lower(a), 2-raise(a) ],
          ( raise(a), on(up(a), note(up), [armed(false)]), wait(3) ), Notes),
    times(Notes, up, Times),
    near_all(Times, [2]).
test(one_that_is_armed_does) :-
    noted([ 1-lower(a), 2-raise(a) ],
          ( raise(a), on(up(a), note(up)), wait(3) ), Notes),
    times(Notes, up, Times),
    near_all(Times, [0.02, 2]).
% Two keys run one motor, as of R3PTAR. The release of the other key, which was never
% pressed, stopped it.
test(a_key_that_is_held_from_the_start_runs_the_motor, true(Whats == [run])) :-
    noted([],
          ( raise(forward),
            forall(member(Key, [forward, back]),
                   ( on(up(Key), note(run)), on(\+ up(Key), note(stop), [armed(false)]) )),
            wait(1) ),
          Notes),
    findall(W, member(_-W, Notes), Whats).
test(an_id_replaces, true(Whats == [second])) :-
    noted([1-raise(a)],
          ( on(up(a), note(first), [id(x)]), on(up(a), note(second), [id(x)]), wait(2) ),
          Notes),
    findall(W, member(_-W, Notes), Whats).
test(one_that_is_replaced_at_a_moment_does_not_happen_then, true(Whats == [second])) :-
    noted([1-raise(a)],
          ( on(up(a), on(up(a), note(second), [id(x)])), on(up(a), note(first), [id(x)]),
            wait(2) ), Notes),
    findall(W, member(_-W, Notes), Whats).
test(it_happens_only_once_at_a_time) :-
    noted([ 1-raise(a), 1.2-lower(a), 1.4-raise(a) ],
          ( on(up(a), ( note(in), wait(1), note(out) )), wait(4) ), Notes),
    findall(W, member(_-W, Notes), [in, out|_]).
test(an_action_may_cancel_its_event, true(Whats == [up])) :-
    noted([ 1-raise(a), 2-lower(a), 3-raise(a) ],
          ( on(up(a), ( note(up), event_cancel(x) ), [id(x)]), wait(5) ), Notes),
    findall(W, member(_-W, Notes), Whats).
test(one_that_fails_warns_and_stays, true(Messages == [warning-ev3dev(event_failed(x, on))])) :-
    noted([1-raise(a)], messages(( on(up(a), fail, [id(x)]), wait(2), event(x, on) ),
                                 Messages), _).
test(one_that_throws_is_printed_and_stays) :-
    noted([1-raise(a)], messages(( on(up(a), atom_length(_, _), [id(x)]), wait(2),
                                   event(x, on) ), Messages), _),
    Messages = [error-error(instantiation_error, context(_, Text))],
    Text == 'in event x (on)'.
test(a_condition_that_throws_is_printed_and_ends) :-
    noted([], messages(( on(atom_length(_, _), true, [id(x)]), wait(2),
                         \+ event(x, on) ), Messages), _),
    Messages = [error-error(instantiation_error, context(_, Text))],
    Text == 'in event x (on)'.
test(what_is_no_error_ends_the_wait, throws(enough)) :-
    noted([1-raise(a)], ( on(up(a), throw(enough)), wait(2) ), _).
test(a_condition_must_not_wait, error(permission_error(wait, guard, x), _)) :-
    noted([], ( on(wait(1), true, [id(x)]), wait(2) ), _).
test(nothing_of_them_is_left_when_their_simulation_ends, true(Counts == [0, 0, 0])) :-
    with_sim([], ( on(up(a), true), every(1, true, [id(x)]) )),
    findall(Count, ( member(Fact, [event_(_, _, _, _), state_(_, _, _), next(_, _)]),
                     aggregate_all(count, ev3dev_events:Fact, Count) ), Counts).
test(each_thread_has_its_own, true(Kinds-Notes == []-[])) :-
    noted([1-raise(a)],
          ( thread_create(( on(up(a), note(other)), findall(K, event(_, K), [on]) ), Id, []),
            thread_join(Id, true),
            findall(K, event(_, K), Kinds), wait(2) ), Notes).

polls(Seconds) :-
    repeat,
    us_dist_cm(in1, _),
    ev3_time(Time),
    Time >= Seconds,
    !.
:- end_tests(on).

:- begin_tests(times).
test(every_keeps_its_rhythm) :-
    noted([], ( every(1, note(tick)), wait(3.5) ), Notes),
    times(Notes, tick, Times),
    near_all(Times, [1, 2, 3]).
test(every_ends_after_its_count) :-
    noted([], ( every(1, note(tick), [count(2)]), wait(3.5) ), Notes),
    times(Notes, tick, Times),
    near_all(Times, [1, 2]).
test(every_does_not_run_within_itself_nor_make_up,
     [ forall(member(Wait-Expected, [ 0.5-[1, 2, 3, 4, 5, 6, 7], 1.5-[1, 3, 5, 7],
                                      2.5-[1, 4, 7] ])) ]) :-
    noted([], ( every(1, ( note(in), wait(Wait), note(out) )), wait(7.4) ), Notes),
    times(Notes, in, Times),
    near_all(Times, Expected),
    \+ ( nextto(_-in, _-in, Notes) ; nextto(_-out, _-out, Notes) ).
test(every_happens_once_for_the_times_at_which_nothing_was_served) :-
    noted([], ( every(1, note(tick)), sim_step(3.5), wait(2) ), Notes),
    times(Notes, tick, Times),
    near_all(Times, [3.5, 4, 5]).
test(after_is_once) :-
    noted([], ( after(1, note(now)), wait(3), \+ event(_, _) ), Notes),
    times(Notes, now, Times),
    near_all(Times, [1]).
test(cancel_ends_one_or_all, true(Left == [])) :-
    noted([], ( every(1, true, [id(a)]), after(9, true, [id(b)]), on(up(a), true, [id(c)]),
                event_cancel(b), \+ event(b, _), event(a, every),
                event_cancel(_), findall(I, event(I, _), Left), \+ event_cancel(_) ), _).
test(a_move_that_an_action_interrupts_goes_on) :-
    noted([], ( every(1, tone(440, 300)), go_cm(20, 40), sim_pose(X, Y, _) ), _),
    near(sqrt(X*X + Y*Y), 40, 1.0).
:- end_tests(times).

:- begin_tests(until).
test(a_move_is_left, true(Which == condition)) :-
    noted([1-raise(a)], ( until(up(a), go_cm(20, 500), Which), at_rest, ev3_time(T) ), _),
    near(T, 2, 0.1).
test(what_goes_on_by_itself_is_waited_for, true(Which == condition)) :-
    noted([1-raise(a)], ( until(up(a), go(20), Which), ev3_time(T), at_rest ), _),
    near(T, 1, 0.03).
test(the_goal_may_end_before, true(Which == goal)) :-
    noted([9-raise(a)], until(up(a), go_cm(20, 5), Which), _).
test(the_goal_may_fail, fail) :-
    noted([9-raise(a)], until(up(a), ( wait(1), fail )), _).
test(a_condition_that_holds_calls_nothing, true(Whats == [])) :-
    noted([], until(true, note(called)), Whats).
test(a_loop_that_only_reads_is_left) :-
    noted([1-raise(a)], ( until(up(a), ( repeat, us_dist_cm(in1, _), fail )), ev3_time(T) ), _),
    near(T, 1, 0.03).
test(an_event_whose_action_is_left_happens_again) :-
    noted([ 0.5-raise(a), 2-raise(b), 2.5-lower(b), 3-raise(b) ],
          ( on(up(b), ( note(in), wait(1) )), every(0.5, note(tick), [id(t)]),
            until(( ev3_time(T), T > 2.2 ), wait(9)), wait(3) ), Notes),
    times(Notes, in, Times),
    near_all(Times, [2, 3]).
test(they_nest, true(Which == condition)) :-
    noted([1-raise(a)],
          ( until(up(a), ( until(up(b), wait(9)), note(inner) ), Which) ), []).
test(the_inner_one_may_end_first, true(Which == goal)) :-
    noted([ 1-raise(b), 2-raise(a) ],
          until(up(a), ( until(up(b), wait(9), condition), wait(0.1) ), Which), _).
test(motors_that_ran_before_go_on, true(States == [running])) :-
    noted([1-raise(a)],
          ( motor_run(outA, 20), until(up(a), go(20)), motor_states(outA, States) ), _).
test(a_condition_may_compare_a_sensor, true(near(D, 60, 3))) :-
    with_sim([bounds(0, 0, 200, 200), start(100, 50, 0)],
             ( set_robot(5.6, 10.6, outB, outC),
               until(( us_dist_cm(in1) < 60, \+ touch(_) = pressed ), go(30)),
               us_dist_cm(in1, D) )).
test(a_condition_is_of_one_language, error(domain_error(sensor_condition, _), _)) :-
    noted([], until(us_dist_cm(in1, _) < 60, go(20)), _).
test(bumped_takes_time, error(domain_error(sensor_condition, _), _)) :-
    noted([], until(touch(in4) = bumped, go(20)), _).
test(which_is_not_a_goal, error(domain_error(until_which, go(20)), _)) :-
    noted([], until(us_dist_cm(_, D), D < 60, go(20)), _).
test(a_condition_must_not_wait, error(permission_error(wait, guard, until), _)) :-
    noted([], until(wait(1), go(20)), _).
test(an_error_of_the_goal_goes_through, error(type_error(_, _), _)) :-
    noted([], until(up(a), atom_length(f(x), _)), _).
:- end_tests(until).

:- begin_tests(branches, [condition(current_predicate(system:engine_create/3))]).
test(both_go_on_at_the_same_time) :-
    noted([], ( both(( wait(1), note(a), wait(2), note(b) ), ( wait(2), note(c) )),
                ev3_time(T) ), Notes),
    findall(W, member(_-W, Notes), [a, c, b]),
    near(T, 3, 0.05).
test(moves_at_the_same_time) :-
    noted([], ( both(go_cm(20, 40), ( motor_run(outA, 30, 90), motor_run(outA, 30, -90) )),
                sim_pose(X, Y, _), position(outA, P) ), _),
    near(sqrt(X*X + Y*Y), 40, 1.0),
    near(P, 0, 5).
test(bindings_come_back, true(X-Y == 1-2)) :-
    noted([], both(( wait(1), X = 1 ), Y = 2), _).
test(one_that_fails_ends_the_other, true(Whats == [])) :-
    noted([], ( \+ both(( wait(1), fail ), ( wait(2), note(late) )), ev3_time(T) ), Notes),
    near(T, 1, 0.05),
    findall(W, member(_-W, Notes), Whats).
test(an_error_of_one_leaves_the_other, throws(oh)) :-
    noted([], both(( wait(1), throw(oh) ), go_cm(20, 900)), _).
test(the_first_wins_and_the_others_are_left, true(Winner-States == 2-[])) :-
    noted([], ( race([go_cm(20, 500), wait(1), ( motor_run(outA, 20), wait(9) )], Winner),
                ev3_time(T), motor_states(outA, States), at_rest ), _),
    near(T, 1, 0.05).
test(the_clean_up_of_the_others_runs, true(Whats == [cleaned])) :-
    noted([], race([wait(1), setup_call_cleanup(true, wait(9), note(cleaned))], 1), Notes),
    findall(W, member(_-W, Notes), Whats).
test(one_that_catches_everything_is_left, true(Winner == 2)) :-
    noted([], race([( repeat, catch(wait(9), _, true), fail ), wait(1)], Winner), _).
test(the_earliest_of_several_wins, true(Winner == 1)) :-
    noted([], race([wait(1), wait(1)], Winner), _).
test(a_race_of_failures_fails, [forall(member(Gs, [[], [fail], [fail, ( wait(1), fail )]])), fail]) :-
    noted([], race(Gs, _), _).
test(events_are_served_meanwhile) :-
    noted([0.5-raise(a)], ( on(up(a), note(up)), both(wait(1), wait(1)) ), Notes),
    times(Notes, up, Times),
    near_all(Times, [0.5]).
test(until_leaves_a_branch, true(Which == condition)) :-
    noted([0.5-raise(a)], both(until(up(a), wait(9), Which), wait(1)), _).
test(they_nest, true(Winner == 1)) :-
    noted([], race([both(wait(1), wait(0.5)), wait(2)], Winner), _).
test(what_goes_on_within_one_lets_the_others_go_on, true(Winner == 2)) :-
    noted([], ( race([both(wait(3), wait(3)), wait(1)], Winner), ev3_time(T) ), _),
    near(T, 1, 0.03).
test(what_goes_on_within_two_adds_nothing) :-
    noted([], ( both(both(wait(1), ( wait(2), note(a) )),
                     race([( wait(1), note(b) ), both(wait(3), wait(3))], _)),
                ev3_time(T) ), Notes),
    near(T, 2, 0.03),
    times(Notes, a, As), near_all(As, [2]),
    times(Notes, b, Bs), near_all(Bs, [1]).
test(an_error_within_one_leaves_all, true(Error-Motors == oh-[])) :-
    noted([], ( catch(both(go_cm(20, 900), both(wait(9), ( wait(1), throw(oh) ))), Error, true),
                wait(1), ev3_time(T), motor_states(outB, Motors) ), _),
    near(T, 2, 0.03).
test(one_that_only_reads_lets_the_others_go_on,
     [ forall(member(Read, [ us_dist_cm(in1, D), us_dist_cm(_, D),
                             sensor_value(in1, 'US-DIST-CM', 0, D),
                             sensor_values(in1, 'US-DIST-CM', [D]) ])),
       true(Winner == 2) ]) :-
    noted([], ( race([( repeat, Read, D < 0, ! ), wait(1)], Winner), ev3_time(T) ), _),
    near(T, 1, 0.05).
test(several_that_only_read_all_go_on, true(Winner == 3)) :-
    noted([1-raise(a), 2-raise(b)],
          ( race([both(( repeat, us_dist_cm(in1, _), up(a), !, note(a), wait(9) ),
                       ( repeat, us_dist_cm(in1, _), up(b), !, note(b), wait(9) )),
                  ( repeat, us_dist_cm(in1, _), fail ),
                  wait(3)], Winner),
            ev3_time(T) ), Notes),
    near(T, 3, 0.1),
    times(Notes, a, [A]), near(A, 1, 0.1),
    times(Notes, b, [B]), near(B, 2, 0.1).
test(a_read_that_fails_is_one_too, true(Winner == 2)) :-
    with_sim([], ( race([( repeat, touch(in4, 1), ! ), wait(1)], Winner), ev3_time(T) ),
             [robot(touch)]),
    near(T, 1, 0.05).
test(a_read_has_its_value_and_its_other_sensors, true(Ports-Winner == [in1]-1)) :-
    noted([], race([( repeat, findall(P, us_dist_cm(P, _), Ports), ev3_time(T), T > 0.5, ! ),
                    wait(1)], Winner), _).
test(a_read_where_no_other_can_go_on_reads, true(Winner-Text == 1-"ok")) :-
    noted([], race([with_output_to(string(Text),
                                   ( repeat, us_dist_cm(in1, _), ev3_time(T), T > 0.5, !, write(ok) )),
                    wait(1)], Winner), _).
test(events_are_served_while_all_only_read, true(Winner == 1)) :-
    noted([0.5-raise(a)],
          ( on(up(a), ( note(up), raise(b) )),
            race([( repeat, us_dist_cm(in1, _), up(b), ! ),
                  ( repeat, us_dist_cm(in1, _), fail )], Winner) ), Notes),
    times(Notes, up, Times),
    near_all(Times, [0.5]).
test(until_leaves_a_branch_that_only_reads, true(Winner-Which == 1-condition)) :-
    noted([0.5-raise(a)],
          ( race([until(up(a), ( repeat, us_dist_cm(in1, D), D < 0, ! ), Which), wait(2)], Winner),
            ev3_time(T) ), _),
    near(T, 0.5, 0.06).
test(a_goal_that_is_planned_runs_while_branches_read, true(Winner == 1)) :-
    noted([], ( sim_at(0.5, raise(a)),
                race([( repeat, us_dist_cm(in1, _), up(a), ! ), wait(2)], Winner) ), _).
test(events_go_on_after_branches) :-
    noted([2-raise(a)],
          ( on(up(a), note(up)),
            race([both(race([wait(9), wait(0.5)], _), wait(9)), wait(1)], _),
            wait(2) ), Notes),
    times(Notes, up, Times),
    near_all(Times, [2]).
test(one_that_catches_everything_and_reads_is_left, true(Winner == 2)) :-
    noted([], race([( repeat, catch(( us_dist_cm(in1, _), fail ), _, fail)
                    ; repeat, us_dist_cm(in1, _), fail ), wait(1)], Winner), _).
test(a_clean_up_may_wait) :-
    noted([], race([setup_call_cleanup(true, wait(9), ( wait(1), note(cleaned) )), wait(1)], 2),
          Notes),
    times(Notes, cleaned, Times),
    near_all(Times, [2.01]).
test(a_clean_up_waits_on_while_events_are_due) :-
    noted([], ( every(0.3, note(every)),
                race([setup_call_cleanup(true, wait(9), ( wait(1), note(cleaned) )), wait(1)], 2),
                wait(0.5) ), Notes),
    times(Notes, cleaned, Times),
    near_all(Times, [2.01]),
    times(Notes, every, Every),
    near_all(Every, [0.31, 0.61, 0.91, 2.01, 2.11, 2.41]).
test(a_clean_up_within_a_branch_may_wait) :-
    noted([], race([( race([setup_call_cleanup(true, wait(9), ( wait(1), note(cleaned) )),
                            wait(1)], 2), wait(9) ), wait(3)], 2), Notes),
    times(Notes, cleaned, Times),
    near_all(Times, [2.01]).
test(until_leaves_a_wait_of_a_clean_up) :-
    noted([], race([setup_call_cleanup(true, wait(9),
                                       ( until(( ev3_time(T), T > 1.5 ), wait(9), Which),
                                         note(Which) )),
                    wait(1)], 2), Notes),
    times(Notes, condition, Times),
    near_all(Times, [1.5]).
test(waits_do_not_add_up) :-
    noted([], ( both(go_cm(20, 40), forall(between(1, 10, _), wait(0.1))), ev3_time(T) ), _),
    noted([], ( go_cm(20, 40), ev3_time(Alone) ), _),
    near(T, Alone, 0.05).
:- end_tests(branches).

% ---------------- PROMPT

:- begin_tests(prompt).
%   A toplevel that has loaded this.
program(Tree, Text) :-
    format(string(Text),
           ":- use_module(library(ev3dev)).
            :- use_module(library(ev3dev/events)).
            :- use_module(library(ev3dev/sim)).
            :- ~q.
            tell(What) :- writeln(What), flush_output.
            tell_often :- every(0.05, tell(served)).
            :- dynamic todo/1.
            next :- retract(todo(Goal)), !, call(Goal).
            next :- tell(over).
            do(Goals) :-
                forall(lists:member(Goal, Goals), assertz(todo(Goal))),
                every(0.05, next).
            pass_time(S) :-
                ev3_time(T0), repeat, motor_stop(outA), ev3_time(T), T >= T0 + S, !.~n",
           [Tree]).

tree(sim_start(room, [clock(realtime)])).
tree(sim_start(room, [clock(scaled(5))])).
tree(ev3_sysfs('/nonexistent')).

kind(pipe).
kind(terminal) :-
    can_open_terminal.

at_prompt(Kind, Tree, Closure) :-
    program(Tree, Text),
    at_toplevel(Kind, Text, Closure).

%   What is typed on a terminal may stand before it.
shows(Toplevel, Text) :-
    repeat,
    printed_line(Toplevel, Line),
    sub_string(Line, _, _, 0, Text),
    !.

%   Its next lines up to Last.
lines_to(Toplevel, Last, Lines) :-
    printed_line(Toplevel, Line),
    (   Line == Last
    ->  Lines = []
    ;   Lines = [Line|Lines1],
        lines_to(Toplevel, Last, Lines1)
    ).

test(events_are_served, [forall(( kind(Kind), tree(Tree) ))]) :-
    at_prompt(Kind, Tree, served).

served(Toplevel) :-
    type(Toplevel, "tell_often.\n"),
    forall(between(1, 3, _), shows(Toplevel, "served")).

test(with_half_a_line_typed, [condition(can_open_terminal)]) :-
    at_prompt(terminal, sim_start(room, [clock(realtime)]), served_within_a_line).

served_within_a_line(Toplevel) :-
    served(Toplevel),
    type(Toplevel, "tell(ha"),
    forall(between(1, 3, _), shows(Toplevel, "served")),
    type(Toplevel, "lf).\n"),
    shows(Toplevel, "half").

test(no_error_or_interrupt_ends_the_toplevel_or_the_event) :-
    at_prompt(pipe, sim_start(room, [clock(realtime)]), bears(Lines)),
    forall(member(Part, ["nobody", "oops"]),
           assertion(( member(Line, Lines), sub_string(Line, _, _, _, Part) ))).

bears(Lines, Toplevel) :-
    type(Toplevel, "do([nobody, throw(oops), abort, fail, tell(there)]).\n"),
    lines_to(Toplevel, "there", Lines),
    shows(Toplevel, "over"),
    type(Toplevel, "event(_, Kind).\n"),
    shows(Toplevel, "Kind = every.").

test(an_action_may_move_the_robot_and_wait) :-
    at_prompt(pipe, sim_start(room, [clock(scaled(5))]), moves).

moves(Toplevel) :-
    type(Toplevel, "set_robot(5.6, 10.6, outB, outC).\n"),
    type(Toplevel, "after(0.05, ( go_cm(30, 10), tell(arrived) )).\n"),
    shows(Toplevel, "arrived").

test(an_action_that_reads_reads_the_terminal) :-
    at_prompt(pipe, sim_start(room, [clock(realtime)]), asks).

asks(Toplevel) :-
    type(Toplevel, "after(0.05, ( tell(what), read(X), tell(it_is(X)) )).\n"),
    shows(Toplevel, "what"),
    type(Toplevel, "this.\n"),
    shows(Toplevel, "it_is(this)").

%   Between two lines there are waits for input, in which nothing happens.
test(nothing_happens_on_a_virtual_clock, true(Served == [])) :-
    at_prompt(pipe, sim_start(room, [clock(virtual)]),
              quiet("tell_often, pass_time(0.2).\n", "tell(true).\n", Served)).
% The events that are gone leave a tick, which is not a use of a device.
test(no_simulation_starts_after_sim_stop, true(Ended-Said == exit(0)-["rests"])) :-
    run_program(":- use_module(library(ev3dev)).
:- use_module(library(ev3dev/events)).
:- use_module(library(ev3dev/sim)).
main :-
    sim_start(room, [clock(virtual)]),
    every(1, true),
    event_cancel(_),
    sim_stop,
    ev3dev_native:tick_after_(0.02),
    ( sim_time(_) -> writeln(runs) ; writeln(rests) ).
", [goal(main)], Ended, Output),
    split_string(Output, "\n", "", Lines),
    include([Line]>>memberchk(Line, ["runs", "rests"]), Lines, Said).
test(nothing_happens_while_a_program_reads, true(Served == [])) :-
    at_prompt(pipe, sim_start(room, [clock(realtime)]),
              quiet("tell_often, repeat, read(X), tell(X), X == end_of_file, !.\n", "true.\n", Served)).

quiet(Query, Input, Served, Toplevel) :-
    type(Toplevel, Query),
    findall(Line,
            ( between(1, 20, _),
              type(Toplevel, Input),
              lines_to(Toplevel, "true", Lines0),
              member(Line, Lines0),
              Line == "served" ),
            Served).

test(the_stop_of_the_view_interrupts_an_action) :-
    at_prompt(pipe, sim_start(room, [clock(realtime)]), is_stopped).

is_stopped(Toplevel) :-
    type(Toplevel, "use_module(library(ev3dev/private/view/program)).\n"),
    type(Toplevel, "do([( tell(waits), thread_create(stop_program, _, []), wait(900), tell(no) )]).\n"),
    shows(Toplevel, "waits"),
    shows(Toplevel, "over").
:- end_tests(prompt).
