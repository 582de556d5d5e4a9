:- use_module('../support/trees').
:- use_module(library(ev3dev/golog)).
:- use_module(library(ev3dev/journal)).
:- use_module('../support/golog/lab').
:- use_module('../support/golog/runs').
:- use_module('../support/simulation').
:- use_module(library(ev3dev)).
:- use_module(library(ev3dev/sim)).
:- use_module(library(plunit)).

% Online runs, and why an action is not done.

exogenous(Actions) :-
    forall(member(A, Actions), assertz(golog_lab:next_exog(A))).

:- begin_tests(golog_online).
test(actions_are_executed, As == [a, b]) :-
    online([a, b], [], _),
    golog_lab:executed(As).
test(tests_are_not_executed, As == [up]) :-
    online([?(n = 0), up, ?(n = 1)], [], _),
    golog_lab:executed(As).
test(internal_actions_are_not_executed, Run-As == [set(ringing), a]-[a]) :-
    online([set(ringing), sim(quiet), commit, branch(n = 0),
            ?(ringing), a], [], Run),
    golog_lab:executed(As).
test(sensing_enters_the_history, Run == [look, e(weather, rain), a]) :-
    sensing(look, rain, [look, if(weather = rain, a, b)], Run).
test(sensing_several, Run == [look_twice, e(weather, 7), e(wind, 7)]) :-
    sensing(look_twice, 7, look_twice, Run).
test(sensing_an_outcome, Run == [feel, e(feel, 25), a]) :-
    sensing(feel, 25, [feel, if(warm, a, b)], Run).
test(a_precondition_that_does_not_hold_is_told,
     R == not_possible(down, n > 0)) :-
    online([a, down], [reason(R)], _).
test(no_step_is_told, R == no_step(?(n = 1))) :-
    online([a, ?(n = 1)], [reason(R)], _).
test(the_end_is_told, R == final) :-
    online(a, [reason(R)], _).
test(indigolog_fails_and_says_why, [Said, Text] == [true, a]) :-
    said(\+ golog_lab:indigolog([a, down]), Texts),
    (   member(Text0, Texts),
        sub_atom(Text0, _, _, _, 'the action down is not possible')
    ->  Said = true,
        Text = a
    ;   Said = false,
        Text = Texts
    ).
test(abort_stops, R-Run == stopped-[a]) :-
    online([a, abort, b], [reason(R)], Run).
test(a_limit_of_steps, R-Run == limit-[a, a, a]) :-
    online(while(true, a), [limit(3), reason(R)], Run).
test(a_timeout_ends_a_wait, R == timeout) :-
    online(wait, [timeout(0.05), reason(R)], _).
test(a_failed_action_is_in_the_history, Run == [failed(breaks), a]) :-
    online([breaks, a], [], Run).
test(a_failed_action_may_stop, R-Run == failed(breaks)-[failed(breaks)]) :-
    online([breaks, a], [on_failed(stop), reason(R)], Run).
test(a_failed_action_may_backtrack, Run == [b]) :-
    online(ndet(breaks, b), [on_failed(backtrack)], Run).
test(a_timeout_ends_a_search,
     [ forall(( member(Search, [ search(P), searchc(P), search(P, m),
                                 search([c, search(P)]),
                                 pi([(x, digit), (y, digit), (z, digit),
                                     (u, digit), (v, digit), (w, digit)],
                                    ?(x+y+z+u+v+w < 0)) ]),
                P = [star(b), ?(done(never))] )),
       true(R == timeout) ]) :-
    statistics(cputime, T0),
    online([a, Search], [timeout(0.2), reason(R)], [a]),
    statistics(cputime, T1),
    assertion(T1-T0 < 2).
test(a_timeout_ends_a_planner, R == timeout) :-
    with_domain([ prim_action(inc), poss(inc, true), prim_fluent(n),
                  initially(n, 0), causes_val(inc, n, N, N is n+1) ],
                M, golog(M:achieve(n < 0), [timeout(0.2), reason(R)])).
test(a_search_that_gave_up_is_the_reason, true(Far == Wanted)) :-
    online([a, search([star(b), ?(done(never))], [gives_up(steps(70))])], [reason(R)],
           [a]),
    R = gave_up(steps(70), [steps(Steps), depth(Depth), inferences(I),
                            seconds(S)]),
    assertion(( I > 0, S >= 0 )),
    Far = Steps-Depth,
    Wanted = 70-70.
test(an_initial_history, Run == [up, a]) :-
    online(if(n = 1, a, b), [initial([up])], Run).
test(gexec_that_assumes, Run == [e(ringing, true), a, b]) :-
    online([gexec(ringing, a), b], [gexec(assume)], Run0),
    exclude(==(none), Run0, Run).
test(gexec_that_guards, Run == [b]) :-
    online([gexec(ringing, a), b], [], Run).
test(a_trace, Events == [exog(ring), action(look), sensed(look, 1)]) :-
    nb_setval(golog_events, []),
    retractall(golog_lab:next_exog(_)),
    golog_lab:golog_exog(ring),
    asserta(golog_lab:sensed_value(look, 1)),
    golog_lab:golog(look, [trace(user:event)]),
    retractall(golog_lab:sensed_value(_, _)),
    nb_getval(golog_events, Events0),
    findall(E, ( member(E, Events0), E \= step(_) ), Events1),
    reverse(Events1, Events),
    memberchk(step([]), Events0).
test(now_has_the_history_of_the_last_run, H == [b, a]) :-
    online([a, b], [], _),
    now(H).
test(conc_is_fair, Run == [a, b, a, b]) :-
    online(conc([a, a], [b, b]), [], Run).
test(a_plan_is_followed, Run == [b, c]) :-
    online(search([ndet(a, b), ?(done(b)), c]), [], Run).
test(a_plan_goes_on_without_what_it_simulated, Run == [up, b]) :-
    online(search([search([up, sim(ring)]), if(ringing, b, c)]), [], Run).
test(a_plan_with_sensing_is_made_again, Run == [look, e(weather, sun), b]) :-
    sensing(look, sun,
            search([look, if(weather = rain, a, b)]), Run).

test(a_plan_that_ends_with_sensing_is_made_again,
     Run == [look, e(weather, sun), b]) :-                  % [I] followpath
    sensing(look, sun, search([look, if(weather = sun, b, [])]), Run).

sensing(Action, Value, Program, Run) :-
    setup_call_cleanup(
        asserta(golog_lab:sensed_value(Action, Value)),
        online(Program, [], Run),
        retractall(golog_lab:sensed_value(_, _))).
:- end_tests(golog_online).

user:event(E) :-
    nb_getval(golog_events, Es),
    nb_setval(golog_events, [E|Es]).

:- begin_tests(golog_exogenous).
test(they_enter_before_the_next_step, Run == [ring, b]) :-
    retractall(golog_lab:next_exog(_)),
    exogenous([ring]),
    golog_lab:golog(if(ringing, b, a), [history(H)]),
    reverse(H, Run).
test(all_are_kept_in_order, H == [a, quiet, ring, ring, call(2)]) :-
    exogenous([call(2), ring, ring, quiet]),
    golog_lab:golog(a, [history(H)]).
test(a_list_is_oldest_first, H == [a, ring, call(1)]) :-
    exogenous([[call(1), ring]]),
    golog_lab:golog(a, [history(H)]).
test(what_is_none_is_dropped, H == [a]) :-
    exogenous([nil]),
    golog_lab:golog(a, [history(H)]).
test(told_from_the_prompt, H == [a, ring, call(3)]) :-
    golog_lab:golog_exog(call(3)),
    golog_lab:golog_exog(ring),
    golog_lab:golog(a, [history(H)]).
test(told_by_another_thread, H == [a, ring]) :-
    thread_create(golog_lab:golog_exog(ring), Id, []),
    golog_lab:golog([while(neg(ringing), wait), a], [history(H)]),
    thread_join(Id, true).
test(they_are_asked_for_before_each_step_tests_included, Count == 4) :-
    nb_setval(golog_seen, []),
    with_domain([ exog_action(x), prim_action(a), poss(a, true),
                  execute(a, _),
                  (exog_occurs(_) :- user:seen_action(asked), fail) ],
                M, golog(M:[?(true), ?(true), a], [])),
    nb_getval(golog_seen, Seen),
    length(Seen, Count).
test(poss_is_not_asked, H == [a, call(2)]) :-
    exogenous([call(2)]),
    golog_lab:golog(a, [history(H)]).
test(wait_returns_at_once_if_one_came_after_the_action, H == [b, ring, a]) :-
    with_ring_after(a, [a, wait, b], H).
test(a_second_wait_waits, R == timeout) :-
    exogenous([ring]),
    golog_lab:golog([wait, wait], [timeout(0.05), reason(R)]).
test(an_idle_interrupt_waits, R-H == timeout-[b, ring]) :-
    exogenous([ring]),
    golog_lab:golog(prioritized_interrupts(
                        [ interrupt(and(ringing, neg(done(b))), b),
                          interrupt(true, ?(wait_exog_action)) ]),
                    [timeout(1), reason(R), history(H)]).
test(interrupts_that_wait_for_each_other,
     H == [off(2), call(2), off(3), off(1)]) :-
    with_domain_of_calls(2, H).
test(end_indi_ends_the_run, R == stopped) :-
    golog_lab:golog_exog(end_indi),
    golog_lab:golog(while(true, a), [limit(10), reason(R)]).
test(a_replanned_search, [H, Again] == [[b, ring, a], 1]) :-
    nb_setval(golog_events, []),
    with_ring_after(a, search([a, if(ringing, b, c)]), H),
    nb_getval(golog_events, Events),
    findall(x, member(replanned(_), Events), Xs),
    length(Xs, Again).
test(ten_thousand_are_counted, [true(Sum-N == Expected-Expected)]) :-
    Expected = 10000,
    with_domain([ exog_action(tick), prim_action(tock), poss(tock, true),
                  prim_fluent(count), initially(count, 0),
                  causes_val(tick, count, N0, N0 is count+1),
                  execute(tock, _) ],
                M,
                ( set_random(seed(7)),
                  thread_create(forall(between(1, Expected, _),
                                       M:golog_exog(tick)), Id, []),
                  golog(M:while(count < Expected, [wait, tock]),
                        [history(H)]),
                  thread_join(Id, true),
                  has_val(M:count, Sum, H),
                  findall(x, member(tick, H), Ticks),
                  length(Ticks, N) )).

test(one_that_comes_in_a_search_is_taken_in_at_once, true(Late < 0.05)) :-
    ring_in_a_search([ interrupt(ringing, b),
                       interrupt(true, search([star(a), ?(done(never))])) ],
                     H, Late),
    assertion(memberchk(b, H)).
test(a_message_to_stop_ends_a_search, true(H-R == []-stopped)) :-
    thread_create(( thread_get_message(go),
                    golog_lab:golog_exog(end_indi) ), Id, []),
    nb_setval(golog_ringer, Id),
    golog_lab:golog([?(user:go_once), search([star(a), ?(done(never))])],
                    [history(H), reason(R), timeout(300)]),
    thread_join(Id, true).
test(those_that_never_end_do_not_keep_a_search_from_its_end, H == [c]) :-
    % The plan takes longer than the pause between two.
    message_queue_create(End),
    thread_create(ringing_on(End), Id, []),
    golog_lab:golog(search(ndet([star(ndet(b, b), 12), ?(done(never))], c)),
                    [history(H0), timeout(300)]),
    thread_send_message(End, end),
    thread_join(Id, true),
    message_queue_destroy(End),
    exclude(==(ring), H0, H).

%   It rings when the search is under way; Late is how long the search goes on
%   computing until the history has the action that answers it.

ring_in_a_search(Interrupts, H, Late) :-
    nb_setval(golog_events, []),
    thread_self(Me),
    thread_create(( thread_get_message(go), golog_lab:golog_exog(ring),
                    thread_statistics(Me, cputime, T0), thread_exit(T0) ), Id, []),
    nb_setval(golog_ringer, Id),
    golog_lab:golog(pconc(?(user:go_once), prioritized_interrupts(Interrupts)),
                    [ history(H), reason(_), timeout(300),
                      trace(user:stop_after(b)) ]),
    nb_getval(golog_events, [T1|_]),
    thread_join(Id, exited(T0)),
    Late is T1-T0.

ringing_on(End) :-
    (   thread_get_message(End, end, [timeout(0.005)])
    ->  true
    ;   golog_lab:golog_exog(ring),
        ringing_on(End)
    ).

with_ring_after(A, Program, H) :-
    nb_setval(golog_events, []),
    golog_lab:golog(Program,
                    [ history(H), trace(user:ring_after(A)) ]).

with_domain_of_calls(N, H) :-
    golog_lab:golog(prioritized_interrupts(
                        [ interrupt(x, light(x) = on, off(x)),
                          interrupt(neg(done(call(N))), wait) ]),
                    [ history(H),
                      trace(user:call_after(off(3), call(N))) ]).
:- end_tests(golog_exogenous).

user:go_once :-
    nb_getval(golog_ringer, Id),
    thread_send_message(Id, go).

user:stop_after(A, E) :-
    (   E == action(A)
    ->  statistics(cputime, T),
        nb_setval(golog_events, [T]),
        golog_lab:golog_exog(end_indi)
    ;   true
    ).

user:ring_after(A, E) :-
    event(E),
    (   E == action(A)
    ->  golog_lab:golog_exog(ring)
    ;   true
    ).

user:call_after(A, Exog, E) :-
    (   E == action(A)
    ->  golog_lab:golog_exog(Exog)
    ;   true
    ).

:- begin_tests(golog_world).
test(execute_3_has_the_history, Seen == [b-[a], a-[]]) :-
    nb_setval(golog_seen, []),
    with_domain([ prim_action(a), prim_action(b), poss(_, true),
                  (execute(A, H, 0) :- user:seen_action(A-H)) ],
                M, indigolog(M:[a, b])),
    nb_getval(golog_seen, Seen).
test(how_to_execute_calls_the_code, Seen == [turn(2), go(1)]) :-
    nb_setval(golog_seen, []),
    with_domain([ prim_action(forward), prim_action(left), poss(_, true),
                  how_to_execute(forward, wheels, go(1)),
                  how_to_execute(left, wheels, turn(2)),
                  (go(N) :- user:seen_action(go(N))),
                  (turn(N) :- user:seen_action(turn(N))),
                  (execute(_, _, _) :- user:seen_action(wrong)) ],
                M, indigolog(M:[forward, left])),
    nb_getval(golog_seen, Seen).
test(a_device_runs_the_code, [Seen, H] == [[wheels-go(1), eye-peep],
                                           [forward, e(light, 5), look]]) :-
    nb_setval(golog_seen, []),
    with_domain([ prim_action(forward), prim_action(look), poss(_, true),
                  prim_fluent(light), senses(look, light),
                  how_to_execute(forward, wheels, go(1)),
                  how_to_execute(look, eye, peep),
                  translate_sensing(look, raw(X), X) ],
                M, golog(M:[look, forward],
                         [device(user:device), history(H)])),
    nb_getval(golog_seen, Seen).
test(an_action_without_code_is_for_the_simulator,
     [Seen, H] == [[simulator-halt, wheels-go(1)], [halt, forward]]) :-
    nb_setval(golog_seen, []),
    with_domain([ prim_action(forward), prim_action(halt), poss(_, true),
                  how_to_execute(forward, wheels, go(1)) ],
                M, golog(M:[forward, halt],
                         [device(user:any_device), history(H)])),
    nb_getval(golog_seen, Seen).
test(an_action_without_code_and_simulator_is_in_the_history,
     H == [halt, forward]) :-
    with_domain([ prim_action(forward), prim_action(halt), poss(_, true),
                  how_to_execute(forward, wheels, true) ],
                M, golog(M:[forward, halt], [history(H)])).
test(nothing_to_read_is_no_sensing_result, H == [failed(look)]) :-
    with_domain([ prim_action(look), poss(_, true), prim_fluent(f),
                  senses(look, f) ], M,
                with_input("", golog(M:look, [history(H)]))).
test(codes_of_exogenous_actions_are_translated, H == [bell, horn, bell]) :-
    with_domain([ exog_action(bell), exog_action(horn),
                  actionNum(bell, 5),
                  translate_exog(toot, horn) ],
                M, ( M:golog_exog(5), M:golog_exog(toot), M:golog_exog(bell),
                     golog(M:[], [history(H)]) )).
test(an_exogenous_action_of_no_domain_is_refused,
     [ forall(member(Action, [foo, 6, bell(1)])),
       error(existence_error(exogenous_action, Action)) ]) :-
    with_domain([exog_action(bell), actionNum(bell, 5)], M,
                M:golog_exog(Action)).
test(it_is_refused_without_a_domain,
     error(existence_error(exogenous_action, bell))) :-
    with_domain([], M, M:golog_exog(bell)).
test(a_code_of_the_world_that_is_none_is_dropped, H == [bell]) :-
    with_domain([ exog_action(bell), exog_occurs([6, bell]) ],
                M, golog(M:[], [history(H)])).
test(legologs_boundary, [Seen, H] == [[1], [go, bell]]) :-
    nb_setval(golog_seen, []),
    with_domain([ prim_action(go), exog_action(bell), poss(_, true),
                  actionNum(go, 1), actionNum(bell, 2),
                  (initialize :- initializeRcx, initializeExog),
                  (finalize :- finalizeRcx, finalizeExog),
                  (execute(A, _, R) :- actionNum(A, N),
                                       sendRcxActionNumber(N, R)),
                  (exog_occurs(L) :- checkOtherExog(L)),
                  robot_exog(bell, fail),
                  (sendRcxActionNumber(N, 0) :- user:seen_action(N)) ],
                M, ( M:golog_exog(2), golog(M:go, [history(H)]) )),
    nb_getval(golog_seen, Seen).
test(initialize_and_finalize, Seen == [end, begin]) :-
    nb_setval(golog_seen, []),
    with_domain([ (initialize :- user:seen_action(begin)),
                  (finalize :- user:seen_action(end)) ],
                M, indigolog(M:[])),
    nb_getval(golog_seen, Seen).
test(finalize_after_an_exception, [Seen, H] == [[end], [a]]) :-
    nb_setval(golog_seen, []),
    with_domain([ prim_action(a), prim_action(b), poss(_, true),
                  (finalize :- user:seen_action(end)),
                  execute(a, _),
                  (execute(b, _) :- throw(error(oops, _))) ],
                M, golog(M:[a, b], [history(H), reason(R)])),
    nb_getval(golog_seen, Seen),
    R = exception(error(oops, _)).
test(exceptions_are_passed_on, [throws(oops)]) :-
    with_domain([ prim_action(b), poss(_, true),
                  (execute(b, _) :- throw(oops)) ],
                M, indigolog(M:b)).
test(two_agents_live_in_one_process, [H1, H2] == [[a], [b]]) :-
    with_domain([prim_action(a), poss(a, true), proc(main, a),
                 execute(_, _)], M1,
                with_domain([prim_action(b), poss(b, true), proc(main, b),
                             execute(_, _)], M2,
                            ( golog(M1:main, [history(H1)]),
                              golog(M2:main, [history(H2)]) ))).
test(a_program_may_define_what_the_library_exports, Said == []) :-
    with_file(":- module(golog_test_own, []).\n\c
               :- use_module(library(ev3dev/golog)).\n\c
               prim_action(a). poss(a, true). prim_action(b).\n\c
               poss(b, true).\n\c
               sendRcxActionNumber(N, N). checkOtherExog([ring]).\n\c
               domain(1, 2).\n",
              File,
              said_of_all(load_files(File, []), Said)),
    golog_test_own:sendRcxActionNumber(4, 4),
    golog_test_own:domain(1, 2).
test(indigolog_0_runs_main, H == [a]) :-
    with_domain([prim_action(a), poss(a, true), proc(main, a),
                 execute(_, _)], M, M:indigolog),
    now(H).

test(an_action_may_have_the_name_of_a_construct, Seen-H ==
         [set(1), wait]-[set(1), wait]) :-
    nb_setval(golog_seen, []),
    with_domain([ prim_action(wait), prim_action(set(_)), poss(_, true),
                  prim_fluent(f), initially(f, 0),
                  causes_val(set(X), f, X, true),
                  (execute(A, _) :- user:seen_action(A)) ],
                M, golog(M:[wait, set(1), ?(f = 1)], [history(H)])),
    nb_getval(golog_seen, Seen).
test(a_controller_is_run, H == [b]) :-
    with_domain([prim_action(b), poss(b, true), proc(mainControl(2), b),
                 controller(2), execute(_, _)], M, indigolog(M:_)),
    now(H).
:- end_tests(golog_world).

user:seen_action(A) :-
    nb_getval(golog_seen, As),
    nb_setval(golog_seen, [A|As]).

user:any_device(Device, Code, _) :-
    seen_action(Device-Code).

user:with_input(Text, Goal) :-
    setup_call_cleanup(
        ( open_string(Text, Stream),
          current_input(Old),
          set_input(Stream) ),
        call(Goal),
        ( set_input(Old),
          close(Stream) )).

user:device(wheels, Code, _) :-
    seen_action(wheels-Code).
user:device(eye, Code, raw(5)) :-
    seen_action(eye-Code).

:- begin_tests(golog_why_not).
%   After one step of Program, at its place Limit; the answer for each Action

why_not_after(Program, Limit, Action, Why) :-
    online(Program, [limit(Limit), reason(_)], _),
    golog_lab:why_not(Action, Why).

test(an_action_that_is_none, Why == no_action) :-
    why_not_after([a, b], 1, fly, Why).
test(the_next_action_has_no_hindrance, fail) :-
    why_not_after([a, ?(true), b], 1, b, _).
test(the_part_of_a_precondition, Found == [(n > 0)-[n = 0]]) :-
    golog_lab:why_not(down, not_possible(Failures)),
    findall(Part-Values, member(failure(Part, Values, _), Failures), Found).
test(the_clause_of_a_precondition, Base == 'lab.pl') :-
    golog_lab:why_not(down, not_possible([failure(_, _, File:Line)])),
    integer(Line),
    file_base_name(File, Base).
test(the_first_false_part_of_each_clause,
     Found == [ (x > 3)-[x = 2], (y = 1)-[y = 5],
                (light(x) = on)-[x = 2, light(2) = off] ]) :-
    with_domain([ prim_action(a), prim_fluent(x), prim_fluent(y),
                  (prim_fluent(light(N)) :- between(1, 2, N)),
                  initially(x, 2), initially(y, 5), initially(light(_), off),
                  poss(a, and(y > 0, and(x > 3, y = 1))),
                  poss(a, and([x = 2, y = 1, x = 9])),
                  poss(a, bright),
                  proc(bright, light(x) = on) ],
                M, why_not(M:a, not_possible(Failures))),
    findall(Part-Values, member(failure(Part, Values, none), Failures), Found).
test(a_false_goal_in_the_body_of_a_precondition,
     Whys == [ not_possible([failure(R \== hall, [], none)]),
               not_possible([failure(room(attic), [], none)]),
               not_possible([]), no_action ]) :-
    R = hall,
    with_domain([ (prim_action(go(Place)) :- atom(Place)), prim_action(call(_)),
                  (poss(go(Room), true) :- room(Room), Room \== hall),
                  poss(call(anna), true), room(hall), room(lab) ],
                M, findall(Why,
                           ( member(A, [go(hall), go(attic), call(bob), go(7)]),
                             why_not(M:A, Why) ),
                           Whys)).
test(why_not_names_what_is_meant, [ forall(hint(Action, Text)), Lines == [Text, ''] ]) :-
    with_domain([ (prim_action(go(R)) :- room(R), R \== yard),
                  prim_action(look), prim_action(call(anna)),
                  prim_action(open), room(hall), room(yard),
                  (poss(go(R), true) :- R \== hall), poss(look, true),
                  (poss(call(P), true) :- P = bob), exog_action(ring),
                  poss(call(bob), true) ],
                M, said(why_not(M:Action), [Line])),
    atomic_list_concat(Lines, '\n', Line).
test(why_not_names_the_line_of_a_declaration, true(Found == true)) :-
    said(golog_lab:why_not(off(9)), [Text]),
    (   sub_atom(Text, 0, _, _, 'off(9) is no action of the domain: \c
                                 number_of_light(9) does not hold (lab.pl:')
    ->  Found = true
    ;   Found = Text
    ).
test(a_higher_priority, Why == priority(up, [n < 2])) :-
    why_not_after(prioritized_interrupts([ interrupt(n < 2, up),
                                           interrupt(neg(done(a)), a) ]),
                  1, a, Why).
test(a_higher_priority_of_pconc, Why == priority(b, [])) :-
    why_not_after(pconc([b, b], a), 1, a, Why).
test(another_that_comes_first, Why == before(b, [])) :-
    why_not_after([a, ndet(b, c)], 1, c, Why).
test(the_condition_of_an_interrupt, Why == interrupt(n > 1, [n = 1])) :-
    why_not_after(prioritized_interrupts([ interrupt(and(true, n > 1), b),
                                           interrupt(n < 3, up) ]),
                  1, b, Why).
test(the_condition_of_an_interrupt_with_a_variable,
     true(Why = interrupt(light(_) = red, _))) :-
    why_not_after(prioritized_interrupts([ interrupt(x, light(x) = red, b),
                                           interrupt(n < 3, up) ]),
                  1, b, Why).
test(what_the_program_does_not_offer, Why == not_offered) :-
    why_not_after([a, b, c], 1, c, Why).
test(it_is_asked_during_a_run, Why == before(a, [])) :-
    retractall(golog_lab:next_exog(_)),
    nb_setval(golog_seen, none),
    golog_lab:golog([ndet(a, b)], [trace(user:asks_why_not(b))]),
    nb_getval(golog_seen, Why).
test(an_open_action_is_refused, error(instantiation_error)) :-
    golog_lab:why_not(off(_), _).
test(it_is_said_in_words,
     [ forall(member(Action-Text,
                     [ fly-'fly is no action of the domain',
                       up-'up comes next',
                       down-'down is not possible: n>0 does not hold, \c
                             as n=0 (poss/2, lab.pl:',
                       a-'a has to wait: up has a higher priority, \c
                          by the interrupt n<2' ])),
       true(Said == true) ]) :-
    online(prioritized_interrupts([ interrupt(n < 2, up),
                                    interrupt(neg(done(a)), a) ]),
           [limit(0), reason(_)], _),
    said(golog_lab:why_not(Action), [Line]),
    (   sub_atom(Line, 0, _, _, Text)
    ->  Said = true
    ;   Said = Line
    ).
test(why_there_is_no_plan,
     [ forall(member(Goal-Wanted,
                     [ and(lamp(1), open)-no_plan([open],
                                                  [missing(key, unlock)]),
                       neg(dark)-no_plan([neg(dark)], []),
                       both-no_plan([lamp(1), lamp(2)], []),
                       in-no_plan([in], [ missing(broken, enter),
                                          missing(key, unlock) ]),
                       red-no_plan([red], [missing(key, paint)]),
                       egg-no_plan([egg], []),
                       and(lamp(1), n = 3)-no_plan([n = 3],
                                                   [missing(key, count)]),
                       past-no_plan([past], [missing(key, pass)]),
                       lamp(2)-none ])),
       true(Found == Wanted) ]) :-
    with_domain([ rel_fluent(open), rel_fluent(key), rel_fluent(dark),
                  (rel_fluent(lamp(N)) :- between(1, 2, N)),
                  initially(dark, true), initially(n, 2),
                  (initially(F, false) :- \+ memberchk(F, [n, gate])),
                  prim_fluent(gate), initially(gate, true),
                  rel_fluent(past), prim_action(pass),
                  poss(pass, and(gate = true, key)),
                  causes_true(pass, past, true),
                  prim_action(unlock), poss(unlock, key),
                  causes_true(unlock, open, true),
                  (prim_action(light(N)) :- between(1, 2, N)),
                  poss(light(_), true), causes_true(light(N), lamp(N), true),
                  causes_false(light(1), lamp(2), true),
                  causes_false(light(2), lamp(1), true),
                  proc(both, and([dark, lamp(1), lamp(2)])),
                  rel_fluent(in), rel_fluent(broken), prim_action(enter),
                  poss(enter, and(dark, and(lamp(1), or(open, broken)))),
                  causes_true(enter, in, true),
                  rel_fluent(red), prim_action(paint), poss(paint, neg(in)),
                  causes_true(paint, red, and(dark, key)),
                  rel_fluent(egg), rel_fluent(hen), prim_action(lay),
                  poss(lay, hen), causes_true(lay, egg, true),
                  prim_action(hatch), poss(hatch, egg),
                  causes_true(hatch, hen, true),
                  prim_fluent(n), prim_action(count), poss(count, n < 3),
                  causes_val(count, n, N, and(key, N is n+1)) ],
                M, ( why_not(M:achieve(Goal), Found) -> true
                   ; Found = none )).
test(a_plan_may_be_too_far, Why = gave_up(inferences(_))) :-
    with_domain([ prim_action(a), poss(a, true), prim_fluent(n),
                  initially(n, 0), causes_val(a, n, N, N is n+1) ],
                M, why_not(M:achieve(n < 0), Why)).
test(why_a_fluent_names_the_line,
     [ forall(member(F-Text, [ n-"causes_val(up, n,", light(3)-"initially(",
                               at(lab)-"causes_true(go(P)",
                               at(yard)-"causes_false(go(P)" ])),
       true(sub_string(Line, 0, _, _, Text)) ]) :-
    online([up, go(yard), up, go(lab)], [], _),
    why(F, fluent(_, By)),
    arg(_, By, File:Number),
    !,
    read_file_to_string(File, All, []),
    split_string(All, "\n", "", Lines),
    nth1(Number, Lines, Line).
test(why_a_fluent_has_its_value,
     Whys == [ fluent(2, entry(2, b, none)), fluent(true, initially(none)),
               fluent(false, entry(3, a, none)), fluent(7, entry(4, e(s, 7),
                                                                none)) ]) :-
    with_domain([ prim_action(a), prim_action(b), poss(_, true),
                  prim_fluent(n), initially(n, 0), prim_fluent(s),
                  rel_fluent(p), initially(p, true), rel_fluent(q),
                  initially(q, true), causes_val(b, n, N, N is n+1),
                  causes_false(a, q, n > 1), senses(a, s), execute(_, 7) ],
                M, golog(M:[b, b, a], [history(_)])),
    findall(Why, ( member(F, [n, p, q, s]), why(F, Why) ), Whys).
test(why_of_what_is_no_fluent,
     [ forall(member(What-Wanted,
                     [ lihgt(1)-'there is no fluent lihgt(1). Did you mean light/1?',
                       wether-'there is no fluent wether. Did you mean weather/0?',
                       at(moon)-'there is no fluent at(moon): \c
                                 member(moon,[hall,lab,yard]) does not hold (lab.pl:' ])),
       true(Found == true) ]) :-
    online([up], [], _),
    catch(why(What, _), error(existence_error(fluent, What), context(_, Text)), true),
    (   sub_atom(Text, 0, _, _, Wanted)
    ->  Found = true
    ;   Found = Text
    ).
test(why_of_what_is_no_fluent_is_said, Text == 'there is no fluent wether. Did you mean weather/0?\n') :-
    online([up], [], _),
    with_hook(Text, why(wether)).
test(why_of_a_device_is_not_about_a_fluent, [forall(member(Port, [outB, robot, stop, zzz])), fail]) :-
    with_domain([ prim_action(a), poss(a, true), prim_fluent('outBB'),
                  initially('outBB', 1), prim_fluent(robots), prim_fluent(stops) ],
                M, golog(M:a, [])),
    why(Port, _).
:- end_tests(golog_why_not).

hint(go(hall), 'go(hall) is not possible: hall\\==hall does not hold').
hint(go(yard), 'go(yard) is no action of the domain: yard\\==yard does not hold').
hint(go(moon), 'go(moon) is no action of the domain: room(moon) does not hold').
hint(call(bob), 'call(bob) is no action of the domain, only with other arguments').
hint(call(anna), 'call(anna) is not possible: anna=bob does not hold').
hint(open, 'open is not possible: there is no poss/2 for it').
hint(loook, 'loook is no action of the domain. Did you mean look/0?').
hint(go(a, b), 'go(a,b) is no action of the domain. Did you mean go/1?').
hint(ring, 'ring is no action of the domain: it is an exogenous one, which happens by itself').

%   with_hook(-Text, :Goal): the only message of Goal, in words

:- meta_predicate with_hook(-, 0).

with_hook(Text, Goal) :-
    nb_setval(golog_seen, none),
    setup_call_cleanup(
        asserta((user:thread_message_hook(Term, _, Lines) :-
                     user:keep_lines(Term, Lines)), Ref),
        call(Goal),
        erase(Ref)),
    nb_getval(golog_seen, Text).

user:keep_lines(ev3dev(_), Lines) :-
    with_output_to(atom(Text), print_message_lines(current_output, '', Lines)),
    nb_setval(golog_seen, Text).

user:asks_why_not(A, E) :-
    (   E == action(a)
    ->  golog_lab:why_not(A, Why),
        nb_setval(golog_seen, Why)
    ;   true
    ).


:- begin_tests(golog_wrong).
test(no_poss_for_an_action,
     [error(existence_error(golog_precondition, a/1),
            context(do/2, 'prim_action(a/1): the action a/1 has no precondition: there is no \c
                           poss/2 for it'))]) :-
    with_domain([prim_action(a(1))], M, do(M:a(1), _)).
test(no_initial_value, Said == true) :-
    with_domain([prim_fluent(f)], M,
                said(\+ do(M:(?(f = 1)), _), [Text])),
    (   sub_atom(Text, _, _, _, 'the fluent f/0 has no initial value')
    ->  Said = true
    ;   Said = Text
    ).
test(a_relational_fluent_without_initial_value_is_false) :-
    with_domain([rel_fluent(f)], M, holds(M:neg(f), [])).
test(without_a_value_a_condition_is_false_and_its_negation_true,
     Truths-Said == [false, true, false, true, false, false]-true) :-
    with_domain([ prim_action(look), prim_fluent(f), senses(look, f),
                  rel_fluent(door), senses(look, door) ], M,
                said(findall(T, ( member(P, [ f = 1, neg(f = 1), door, neg(door),
                                              know(f), know(door) ]),
                                  eval(M:P, [], T) ), Truths), _)),
    with_domain([prim_fluent(f)], M1, said(ignore(holds(M1:(f = 1), [])), [Text])),
    (   sub_atom(Text, _, _, _, 'so a condition about it is false, and its negation true')
    ->  Said = true
    ;   Said = Text
    ).
test(a_fluent_that_is_asked_before_it_is_sensed, Said-H == true-[c, a]) :-
    with_domain([ prim_action(look), prim_action(a), prim_action(c),
                  poss(_, true), prim_fluent(f), senses(look, f),
                  execute(_, _) ], M,
                said(golog(M:[a, if(f = 1, a, c)], [history(H)]), Texts)),
    (   Texts = [Text],
        sub_atom(Text, _, _, _,
                 'the fluent f/0 has no value before it is sensed')
    ->  Said = true
    ;   Said = Texts
    ).
test(a_plan_may_ask_before_it_looks, Texts == []) :-
    with_domain([ prim_action(look), prim_action(a), prim_action(c),
                  poss(_, true), prim_fluent(f), senses(look, f),
                  execute(_, 1) ], M,
                said(golog(M:search([look, if(f = 1, a, c)]), []), Texts)).
test(to_know_needs_no_value, Texts == []) :-
    with_domain([ prim_action(look), prim_action(c), poss(_, true),
                  prim_fluent(f), senses(look, f), execute(_, _) ], M,
                said(golog(M:if(know(f), look, c), []), Texts)).
test(what_books_write_has_a_hint,
     [ forall(member(Program-Hint,
                     [ (a | b)-'ndet(P, Q) for P|Q',
                       a()-'Write a, without ()',
                       [a, (a ; b)]-'[P, Q] for P;Q',
                       if(n = 0, b)-'if(C, P, [])',
                       ?(~(n = 1))-'neg(P) for ~P' ])),
       true(Found == true) ]) :-
    catch(golog_lab:do(Program, _), error(_, context(_, Message)), true),
    (   sub_atom(Message, _, _, _, Hint)
    ->  Found = true
    ;   Found = Message
    ).
test(an_infinite_timeout_is_none, condition(catch(_ is inf, _, fail))) :- % not in 7.2.3
    golog([], [timeout(inf)]).
test(a_primitive_action_has_a_hint, true(Found == true)) :-
    with_domain([primitive_action(a), poss(a, true)], M,
                catch(do(M:a, _), error(_, context(_, Message)), true)),
    (   sub_atom(Message, _, _, _,
                 'has primitive_action/1; here it is prim_action/1')
    ->  Found = true
    ;   Found = Message
    ).
test(a_precondition_of_a_situation_has_a_hint,
     [ forall(member(Clauses, [ [(poss(a, _) :- true)], [poss(_, _)],
                                [ (poss(a, S) :- f(a), g(b, S)),
                                  g(b, do(_, _)) ] ])),
       true(Found == true) ]) :-
    with_domain([prim_action(a), prim_action(b)|Clauses], M,
                catch(do(M:b, _),
                      error(instantiation_error, context(_, Message)), true)),
    (   sub_atom(Message, _, _, _, 'not a situation')
    ->  Found = true
    ;   Found = Message
    ).
test(a_sequence_begins_with_an_action, H == [b, a]) :-
    golog_lab:do(a : b, H).
test(what_is_neither_action_nor_module,
     [error(existence_error(golog_program, golog_test_none/0))]) :-
    golog_lab:do(golog_test_none : b, _).
test(an_unknown_construct, [error(existence_error(golog_program, fly/1))]) :-
    golog_lab:do([a, fly(1)], _).
test(a_cyclic_procedure, [error(domain_error(golog_procedure, p))]) :-
    with_domain([proc(p, ndet(?(false), [p, p]))], M, do(M:p, _)).
test(a_cyclic_condition, [error(domain_error(golog_procedure, p))]) :-
    with_domain([proc(p, neg(p))], M, holds(M:p, [])).
test(an_unknown_condition, [error(existence_error(golog_condition, wet/1))]) :-
    golog_lab:holds(wet(1), []).
test(the_message_names_clause_and_line, true(Found == true)) :-
    catch(golog_lab:do(broken, _), error(_, context(_, Message)), true),
    (   sub_atom(Message, 0, _, _, 'lab.pl:'),
        sub_atom(Message, _, _, _, ': proc(broken): ')
    ->  Found = true
    ;   Found = Message
    ).

test(each_message_begins_with_file_line_and_clause, Otherwise == []) :-
    wrong_file(Text),
    with_file(Text, File,
              ( load_files(File, []),
                findall(Message,
                        ( wrong(Program, Line, Clause),
                          message_of(Program, Message),
                          \+ begins(Message, File, Line, Clause) ),
                        Otherwise) )).

message_of(Program, Message) :-
    (   Program = online(P)
    ->  Goal = golog(golog_wrong_file:P, [timeout(2)])
    ;   Goal = do(golog_wrong_file:Program, _)
    ),
    said(catch(ignore(Goal), E, true), Said),
    (   nonvar(E)
    ->  E = error(_, context(_, Message))
    ;   Said = [Message|_]
    ).

begins(Message, File, Line, Clause) :-
    file_base_name(File, Base),
    format(atom(Place), '~w:~w: ~w: ', [Base, Line, Clause]),
    sub_atom(Message, _, _, _, Place).

wrong_file(":- module(golog_wrong_file, []).
:- use_module(library(ev3dev/golog)).
prim_action(a(_)).
prim_fluent(f).
prim_action(b).
poss(b, true).
proc(round, ndet(?(false), [round, b])).
proc(go_on, [b, fly(1)]).
proc(wait_for_rain, [b, ?(wet(1))]).
proc(wait_for_snow, pi((x, [1]), ?(snow(x)))).
prim_action(c).  poss(c, height > 1).  prim_fluent(height).
initially(height, 0).  causes_val(b, height, 1, true).
proc(stuck, [b, inner]).
proc(inner, [b, ?(height = 3), b]).
proc(deep, [b, search([star(b), ?(height = 3)], [gives_up(steps(9))])]).
proc(open_condition, [b, ?(_)]).
proc(open_program, [b, _]).
proc(somewhere, pi(p, plaice, b)).
prim_action(d).
poss(d, foggy).
prim_action(e).  poss(e, true).
robot_action(e, fail).
proc(cheap, achieve(height = 1, [cheapest(true)])).
action_cost(_, low).
proc(together, [b, achieve(height = 1, [concurrent(true)])]).
prim_action(h).  poss(h, true).
execute(_, _).
proc(sorted, for(x, 7, b)).
").

wrong([b, a(1)], 3, 'prim_action(a/1)').
wrong(?(f = 1), 4, 'prim_fluent(f)').
wrong(round, 7, 'proc(round)').
wrong(go_on, 8, 'proc(go_on)').
wrong(wait_for_rain, 9, 'proc(wait_for_rain)').
wrong(wait_for_snow, 10, 'proc(wait_for_snow)').
wrong(online(c), 11, 'poss(c)').
wrong(online(stuck), 14, 'proc(inner)').
wrong(deep, 15, 'proc(deep)').
wrong(online(deep), 15, 'proc(deep)').
wrong(open_condition, 16, 'proc(open_condition)').
wrong(online(open_condition), 16, 'proc(open_condition)').
wrong(open_program, 17, 'proc(open_program)').
wrong(somewhere, 18, 'proc(somewhere)').
wrong([b, d], 20, 'poss(d)').
wrong(online([e]), 22, 'robot_action(e)').
wrong(cheap, 24, 'action_cost(b)').
wrong(together, 25, 'proc(together)').
wrong(sorted, 28, 'proc(sorted)').
test(a_clause_about_what_is_not_declared_is_told,
     [ forall(undeclared(Clause, Wanted)), true(Lines == [Wanted, '']) ]) :-
    small_domain([Clause], M, said(ignore(holds(M:true, [])), [Text])),
    atomic_list_concat(Lines, '\n', Text).
test(a_clause_about_what_is_declared_is_not_told,
     [ forall(declared(Clause)), true(Texts == []) ]) :-
    small_domain([Clause], M, said(ignore(holds(M:true, [])), Texts)).
test(it_is_told_once, Times == 1) :-
    small_domain([senses(go, load)], M,
                 said(( holds(M:true, []),
                        thread_create(holds(M:true, []), Id, []),
                        thread_join(Id, true),
                        assertz(M:prim_action(turn)),
                        holds(M:true, []) ),
                      Texts)),
    length(Texts, Times).
test(it_is_told_with_its_place_and_again_after_a_change,
     Lines == [3, 4]) :-
    tmp_file_stream(text, File, Stream),
    close(Stream),
    findall(Line,
            ( member(More-Line, ["a"-3, "b).\nprim_fluent(a"-4]),
              setup_call_cleanup(
                  open(File, write, Out),
                  format(Out, ":- use_module(library(ev3dev/golog)).~n\c
                               prim_fluent(~w).~ninitially(att, 1).~n",
                         [More]),
                  close(Out)),
              load_files(golog_undeclared:File, [if(true)]),
              said(golog_undeclared:holds(true, []), [Text]),
              file_base_name(File, Base),
              format(atom(Begin), '~w:~w: initially/2: there is no fluent \c
                                   att/0', [Base, Line]),
              sub_atom(Text, 0, _, _, Begin) ),
            Lines),
    delete_file(File).

%   small_domain(+More, -Module, :Goal)

:- meta_predicate small_domain(+, -, 0).

small_domain(More, M, Goal) :-
    append([ prim_action(go(_)), poss(go(_), true), exog_action(bump),
             prim_fluent(at), rel_fluent(seen(_)), fun_fluent(load),
             derived(here, at = 1), initially(at, 1) ],
           More, Clauses),
    with_domain(Clauses, M, Goal).

undeclared(causes_val(go(_), lode, 1, true),
           'causes_val/4: there is no fluent lode/0; prim_fluent/1 declares \c
            one. Did you mean load/0?').
undeclared(causes_val(go(_), weight, 1, true),
           'causes_val/4: there is no fluent weight/0; prim_fluent/1 \c
            declares one. There are: at/0, here/0, load/0, seen/1').
undeclared(causes_true(go(_), sen(_), true),
           'causes_true/3: there is no fluent sen/1; prim_fluent/1 declares \c
            one. Did you mean seen/1?').
undeclared((causes_false(A, seem(1), true) :- A = go(1)),
           'causes_false/3: there is no fluent seem/1; prim_fluent/1 \c
            declares one. Did you mean seen/1?').
undeclared(causes_val(go, at, 1, true),
           'causes_val/4: there is no action go/0; prim_action/1 declares \c
            one. Did you mean go/1?').
undeclared(causes_true(failed(fly), seen(1), true),
           'causes_true/3: there is no action fly/0; prim_action/1 declares \c
            one. There are: bump/0, go/1').
undeclared(causes_true(interrupted([go(1), fly]), seen(1), true),
           'causes_true/3: there is no action fly/0; prim_action/1 declares \c
            one. There are: bump/0, go/1').
undeclared(senses(fly, at),
           'senses/2: there is no action fly/0; prim_action/1 declares one. \c
            There are: bump/0, go/1').
undeclared(senses(go(_), _, laod, _, _),
           'senses/5: there is no fluent laod/0; prim_fluent/1 declares one. \c
            Did you mean load/0?').
undeclared(poss(bumps, true),
           'poss/2: there is no action bumps/0; prim_action/1 declares one. \c
            Did you mean bump/0?').
undeclared(initially(seen, true),
           'initially/2: there is no fluent seen/0; prim_fluent/1 declares \c
            one. Did you mean seen/1?').
undeclared(forget(go(_), lod),
           'forget/2: there is no fluent lod/0; prim_fluent/1 declares one. \c
            Did you mean load/0?').
undeclared(robot_action(goo(_), true),
           'robot_action/2: there is no action goo/1; prim_action/1 declares \c
            one. There are: bump/0, go/1').
undeclared(robot_exog(bmup, true),
           'robot_exog/2: there is no exogenous action bmup/0; exog_action/1 \c
            declares one. Did you mean bump/0?').
undeclared(sensed_values(sean(_), []),
           'sensed_values/2: there is no fluent sean/1; prim_fluent/1 \c
            declares one. Did you mean seen/1?').
undeclared(action_cost(og(_), 1),
           'action_cost/2: there is no action og/1; prim_action/1 declares \c
            one. There are: bump/0, go/1').

declared(causes_true(bump, seen(1), true)).
declared(causes_true(failed(go(_)), seen(1), true)).
declared(causes_true(failed([go(1)]), seen(1), true)).
declared(causes_true(set(_), seen(1), true)).
declared(causes_true(_, seen(1), true)).
declared((forget(go, ta) :- fail)).
declared((prim_action(A) :- member(A, [fly, swim]))).
declared(prim_fluent(never_used)).
declared(initially(load, 1)).
:- end_tests(golog_wrong).
