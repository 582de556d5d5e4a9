:- use_module('../support/trees').
:- use_module(library(ev3dev/golog)).
:- use_module('../support/golog/runs').
:- use_module('../support/golog/wholes').
:- use_module('../support/simulation').
:- use_module(library(ev3dev)).
:- use_module(library(ev3dev/journal)).
:- use_module(library(ev3dev/sim)).
:- use_module(library(plunit)).

% Long runs, and runs with a robot.

:- begin_tests(golog_long).
%   A domain of an endless delivery

delivery([ prim_action(go(P)), prim_action(take(P)), prim_action(give(P)),
           poss(go(_), true), poss(take(_), true), poss(give(_), true),
           prim_fluent(at), prim_fluent(carries(_)), initially(at, 1),
           initially(carries(_), no),
           causes_val(go(P), at, P, true),
           causes_val(take(P), carries(P), yes, true),
           causes_val(give(P), carries(P), no, true),
           proc(round, pi(p, [1, 2, 3, 4],
                          [ ?(p is 1 + at mod 4), go(p),
                            if(carries(p) = yes, give(p), take(p)) ])),
           execute(_, _) ]).

test(the_cost_of_an_action_is_flat, true(Most =< 1.2*Least)) :-
    delivery(Clauses),
    with_domain(Clauses, M,
                ( nb_setval(golog_costs, []),
                  nb_setval(golog_count, 0),
                  golog(M:while(true, round),
                        [limit(15000), reason(R), trace(user:cost)]) )),
    R == limit,
    nb_getval(golog_costs, Costs0),
    differences(Costs0, Costs),
    length(Costs, N),
    assertion(N >= 9),
    max_list(Costs, Most),
    min_list(Costs, Least).
test(the_memory_is_flat, true(Grown =< 100000)) :-
    delivery(Clauses),
    with_domain(Clauses, M,
                ( golog(M:while(true, round), [limit(3000), reason(_)]),
                  garbage_collect,
                  statistics(globalused, Used0),
                  golog(M:while(true, round), [limit(6000), reason(_)]),
                  garbage_collect,
                  statistics(globalused, Used) )),
    Grown is Used-Used0.
test(fifty_fluents_of_a_thousand_instances, true(V == Count)) :-
    findall(Clause, many_clause(Clause), Clauses),
    with_domain(Clauses, M,
                ( nb_setval(golog_costs, []),
                  nb_setval(golog_count, 0),
                  golog(M:while(true, some_step),
                        [ limit(8000), reason(_), history(H),
                          trace(user:cost) ]),
                  H = [inc(Name, N)|_],
                  F =.. [Name, N],
                  has_val(M:F, V, H) )),
    findall(x, member(inc(Name, N), H), Xs),
    length(Xs, Count),
    nb_getval(golog_costs, Costs0),
    differences(Costs0, Costs),
    max_list(Costs, Most),
    assertion(Most / 500 =< 3000).

many_clause(prim_fluent(F)) :-
    many_fluent(F).
many_clause(initially(F, 0)) :-
    many_fluent(F).
many_clause((causes_val(inc(Name, N), F, V, V is F+1) :- F =.. [Name, N])).
many_clause(prim_action(inc(_, _))).
many_clause(poss(inc(_, _), true)).
many_clause(execute(_, _)).
many_clause((chance(inc(Name, N)) :- random_between(1, 50, I),
                                     random_between(1, 1000, N),
                                     atom_concat(f, I, Name))).
many_clause(proc(some_step, pi(x, [?(chance(x)), x]))).

many_fluent(F) :-
    between(1, 50, I),
    atom_concat(f, I, Name),
    between(1, 1000, N),
    F =.. [Name, N].

differences([A|As], Ds) :-
    differences(As, A, Ds).

differences([], _, []).
differences([B|Bs], A, [D|Ds]) :-
    D is A-B,
    differences(Bs, B, Ds).

test(the_program_may_ask_about_a_long_history_itself, R == limit) :-
    % now/1 has the newest thousand entries; what went before still counts.
    with_domain([ prim_action(inc), poss(inc, true), execute(inc, _),
                  prim_fluent(n), initially(n, 0),
                  causes_val(inc, n, N, N is n+1) ],
                M, ( assertz((M:said(N1) :- now(H), has_val(M:n, N1, H))),
                     assertz((M:next(N2) :- now(H), has_val(M:n, V, [inc|H]),
                                             V =:= N2)),
                     golog(M:while(true, [inc, ?(said(n)), ?(next(n+1))]),
                           [limit(4000), reason(R)]) )).

test(effects_that_nothing_enumerates_take_no_more_memory,
     true(Grown =< 100000)) :-
    with_domain([ prim_action(paint), prim_action(wipe), prim_action(move),
                  poss(_, true), prim_fluent(color(_)), prim_fluent(at),
                  initially(color(_), white), initially(at, 0),
                  causes_val(paint, color(door), red, true),
                  causes_val(wipe, color(X), clean, neg(X = at)),
                  causes_val(move, at, V, V is (at+1) mod 5),
                  execute(_, _),
                  proc(turn, [ wipe, move, paint, ?(color(door) = red),
                               ?(color(4) \= red) ]) ],
                M,
                ( golog(M:while(true, turn), [limit(2000), reason(R1)]),
                  garbage_collect,
                  statistics(globalused, Used0),
                  golog(M:while(true, turn), [limit(6000), reason(R2)]),
                  garbage_collect,
                  statistics(globalused, Used) )),
    assertion([R1, R2] == [limit, limit]),
    Grown is Used-Used0.
:- end_tests(golog_long).

%   Note the inferences used so far at every five hundredth action.

user:cost(E) :-
    (   E = action(_)
    ->  nb_getval(golog_count, N0),
        N is N0+1,
        nb_setval(golog_count, N),
        (   N mod 500 =:= 0
        ->  statistics(inferences, I),
            nb_getval(golog_costs, Costs),
            nb_setval(golog_costs, [I|Costs])
        ;   true
        )
    ;   true
    ).

% ---------------- THE ROBOT

%   A robot that goes, is interrupted by a key, and looks

rover([ prim_action(ahead), prim_action(look), prim_action(beep),
        prim_action(roll), prim_action(halt),
        poss(_, true),
        exog_action(key), exog_action(near), exog_action(far),
        prim_fluent(distance), prim_fluent(keys), prim_fluent(beeps),
        initially(keys, 0), initially(beeps, 0),
        senses(look, distance),
        causes_val(key, keys, N, N is keys+1),
        causes_val(beep, beeps, N, N is beeps+1),
        robot_action(ahead, go_cm(30, 40)),
        robot_action(roll, go(30)),
        robot_action(halt, stop),
        robot_action(beep, user:note_time(beep)),
        robot_sense(look, D, us_dist_cm(_, D)),
        robot_exog(key, button(enter)),
        robot_exog(near, ( us_dist_cm(_, D), D < 40 )),
        proc(reactive,
             prioritized_interrupts(
                 [ interrupt(beeps < keys, beep),
                   interrupt(neg(done(ahead)), ahead) ])) ]).

with_rover(Goal) :-
    with_rover(_, Goal).

with_rover(M, Goal) :-
    rover(Clauses),
    nb_setval(golog_times, []),
    with_sim(room,
             ( set_robot(5.6, 10.6, outB, outC),
               with_domain(Clauses, M, Goal) )).

%   Some more exogenous actions, up to ten thousand, happen now.

user:some_arrive(M) :-
    M:arrive(K0),
    random_between(0, 40, Some),
    K is min(10000, K0+Some),
    retract(M:arrive(K0)),
    assertz(M:arrive(K)),
    K1 is K0+1,
    forall(between(K1, K, I), M:golog_exog(tick(I))).

user:note_time(What) :-
    sim_time(T),
    nb_getval(golog_times, Times),
    nb_setval(golog_times, [What-T|Times]).

user:note_exog(E) :-
    (   E = exog(A)
    ->  note_time(A)
    ;   true
    ).

%   What was planned goes on until its action is done.

follows_plan(Whole) :-
    functor(Whole, Name, _),
    memberchk(Name, [search, searchn, searchc, '$path']).

:- begin_tests(golog_robot).
test(an_action_moves_the_robot, true(near(Way, 40, 1))) :-
    with_rover(M, ( sim_pose(X0, Y0, _), indigolog(M:ahead),
                    sim_pose(X1, Y1, _) )),
    Way is sqrt((X1-X0)**2 + (Y1-Y0)**2).
test(a_sensor_is_a_sensing_action, H == [e(distance, D), look]) :-
    with_rover(M, ( us_dist_cm(_, D), golog(M:look, [history(H)]) )).
test(an_exogenous_action_is_seen_in_a_move, true(Late =< 0.02)) :-
    with_rover(M, ( sim_time(T0),
                    sim_press(enter, [after(0.5)]),
                    golog(M:ahead, [trace(user:note_exog)]) )),
    nb_getval(golog_times, [key-T]),
    Late is T-T0-0.5,
    assertion(Late >= 0).
test(ten_thousand_at_random_times_are_counted_in_moves,
     [Seen, Sum, Ordered] == [10000, 10000, true]) :-
    with_rover(M, ( assertz(M:exog_action(tick(_))),
                    assertz(M:prim_fluent(ticks)),
                    assertz(M:initially(ticks, 0)),
                    assertz(M:causes_val(tick(_), ticks, N, N is ticks+1)),
                    assertz(M:prim_action(rest)),
                    assertz(M:robot_action(rest, wait(0.2))),
                    set_random(seed(3)),
                    assertz(M:arrive(0)),
                    % Between two of 15 ms: none, one, or many at once
                    assertz((M:robot_exog(tick(_), fail) :-
                                 user:some_arrive(M))),
                    golog(M:while(ticks < 10000, rest), [history(H)]),
                    has_val(M:ticks, Sum, H) )),
    findall(K, member(tick(K), H), Newest),
    length(Newest, Seen),
    reverse(Newest, Ks),
    (   numlist(1, 10000, Ks)
    ->  Ordered = true
    ;   Ordered = false
    ).
test(what_was_seen_is_not_looked_at_again, true(Inferences < 6000000)) :-
    % 300 of them at the beginning of an action of 20 s
    with_rover(M, ( assertz(M:prim_action(rest)),
                    assertz(M:robot_action(rest, wait(20))),
                    sim_at(0.5, forall(between(1, 300, _),
                                       M:golog_exog(far))),
                    statistics(inferences, I0),
                    golog(M:prioritized_interrupts(
                                [ interrupt(beeps < keys, beep),
                                  interrupt(neg(done(rest)), rest) ]),
                          [history(H)]),
                    statistics(inferences, I1) )),
    once(append(Far, [rest], H)),
    length(Far, Count),
    assertion(Count == 300),
    Inferences is I1-I0.
test(a_higher_interrupt_ends_a_move,
     H == [ahead, beep, key, interrupted(ahead)]) :-
    with_rover(M, ( sim_press(enter, [after(0.5)]),
                    golog(M:reactive, [history(H)]) )).
test(it_stops_the_motors_at_once, true(Late =< 0.03)) :-
    with_rover(M, ( sim_time(T0),
                    sim_press(enter, [after(0.5)]),
                    indigolog(M:reactive) )),
    nb_getval(golog_times, [beep-T]),
    Late is T-T0-0.5.
test(a_lower_one_does_not, H == [beep, key, ahead]) :-
    with_rover(M, ( sim_press(enter, [after(0.5)]),
                    golog(M:prioritized_interrupts(
                              [ interrupt(neg(done(ahead)), ahead),
                                interrupt(beeps < keys, beep) ]),
                          [history(H)]) )).
test(an_atomic_program_is_not_interrupted, H == [beep, key, ahead]) :-
    with_rover(M, ( sim_press(enter, [after(0.5)]),
                    golog(M:prioritized_interrupts(
                              [ interrupt(beeps < keys, beep),
                                interrupt(neg(done(ahead)),
                                          atomic([ahead, ?(true)])) ]),
                          [history(H)]) )).
test(a_higher_program_ends_a_move_in_each_construct,
     [ forall(( whole(pconc([?(keys > 0), beep], ahead), Whole),
                \+ follows_plan(Whole),
                Whole \= atomic(_),
                Whole \= '$atomic'(_) )),
       true(Interrupted == true) ]) :-
    with_rover(M, ( assertz((M:proc(never, ?(false)))),
                    sim_press(enter, [after(0.5)]),
                    golog(M:[Whole, ?(beeps > 0)],
                          [limit(8), reason(_), history(H)]) )),
    (   memberchk(interrupted(ahead), H)
    ->  Interrupted = true
    ;   Interrupted = H
    ).
test(a_condition_is_one_event, Count == 1) :-
    with_rover(M, ( sim_press(enter, [for(0.5)]),
                    golog(M:[ahead], [history(H)]) )),
    findall(x, member(key, H), Keys),
    length(Keys, Count).
test(a_wait_ends_by_a_key, true(near(T, 2, 0.03))) :-
    with_rover(M, ( sim_time(T0),
                    sim_press(enter, [after(2)]),
                    indigolog(M:[while(keys = 0, wait)]),
                    sim_time(T1) )),
    T is T1-T0.
test(a_timeout_ends_a_move, [R, Late] == [timeout, true]) :-
    with_rover(M, ( sim_time(T0),
                    golog(M:ahead, [timeout(0.5), reason(R)]),
                    sim_time(T1), assertion(at_rest) )),
    (   T1-T0 < 0.53
    ->  Late = true
    ;   Late = T1-T0
    ).
test(the_motors_stop_if_the_program_fails, R == not_possible(gone, false)) :-
    with_rover(M, ( assertz(M:prim_action(gone)),
                    asserta((M:poss(gone, false))),
                    retractall(M:poss(_, true)),
                    assertz(M:poss(roll, true)),
                    golog(M:[roll, gone], [reason(R)]),
                    assertion(at_rest) )).
test(the_motors_stop_after_an_exception) :-
    with_rover(M, ( assertz(M:prim_action(bad)),
                    assertz(M:robot_action(bad, throw(oops))),
                    catch(indigolog(M:[roll, bad]), oops, true),
                    assertion(at_rest),
                    now([roll]) )).
test(a_time_limit_is_passed_on, true(E == passed)) :-
    with_rover(M, ( assertz(M:prim_action(long)),
                    assertz(M:robot_action(long, throw(time_limit_exceeded))),
                    catch(golog(M:[roll, long], [reason(_)]),
                          time_limit_exceeded, E = passed),
                    assertion(at_rest) )).
test(a_search_may_try_in_the_simulator, H-Y == [long]-true) :-
    % A wall stands 60 cm ahead.
    nb_setval(golog_times, []),
    with_sim([bounds(-100, -100, 100, 60), start(0, 0, 0)],
             ( set_robot(5.6, 10.6, outB, outC),
               with_domain([ prim_action(long), prim_action(longer),
                             poss(_, true),
                             robot_action(long, go_cm(30, 20)),
                             robot_action(longer,
                                          ( go_cm(30, 40),
                                            us_dist_cm(_, D), D > 20 )) ],
                           M, golog(M:search(ndet(longer, long),
                                             [simulate(true)]),
                                    [history(H)])),
               sim_pose(_, Y0, _) )),
    (   near(Y0, 20, 1)
    ->  Y = true
    ;   Y = Y0
    ).
test(a_timeout_ends_a_search_in_the_simulator, R-Way == timeout-0.0) :-
    with_rover(M, ( sim_pose(X0, Y0, _),
                    golog(M:search([ star(ahead, 1), star(halt), ?(keys > 9) ],
                                   [simulate(true)]),
                          [timeout(0.3), reason(R)]),
                    sim_pose(X1, Y1, _) )),
    Way is sqrt((X1-X0)**2 + (Y1-Y0)**2).
test(an_exogenous_action_of_the_robot_is_seen_in_a_search,
     true(H == [beep, key])) :-
    % In real time, as on a brick: the key is pressed while it searches.
    nb_setval(golog_times, []),
    rover(Clauses),
    with_sim(room,
             ( set_robot(5.6, 10.6, outB, outC),
               with_domain(Clauses, M,
                           ( sim_press(enter, [after(0.2)]),
                             golog(M:prioritized_interrupts(
                                        [ interrupt(beeps < keys, beep),
                                          interrupt(beeps = 0,
                                                    search([star(halt),
                                                            ?(done(drive(9)))])) ]),
                                   [history(H), timeout(120)]) )) ),
             [clock(realtime)]).
test(the_journal_knows_step_and_action, Cause == golog(1, ahead, true)) :-
    with_rover(M, ( indigolog(M:ahead),
                    why(robot, why(_, _, Causes)) )),
    memberchk(golog(Step, Action, Condition), Causes),
    Cause = golog(Step, Action, Condition).
test(the_journal_knows_what_made_it_possible,
     true(Told == [golog(3, drive(3), at(robot) = 2)])) :-
    told_causes([?(true), halt, drive(3)], Told).
test(the_journal_knows_the_interrupt,
     true(Told == [golog(1, drive(3), at(robot) = 2), interrupt(keys = 0),
                   interrupt(at(robot) < 5)])) :-
    told_causes(prioritized_interrupts(
                    [ interrupt(keys > 0, beep),
                      interrupt(p, and(p = 5, at(robot) < p),
                                [ prioritized_interrupts(
                                      [interrupt(keys = 0, drive(3))]) ]) ]),
                Told0),
    maplist(without_choice, Told0, Told).
test(the_journal_knows_a_step_of_a_plan,
     true(Told == [golog(2, drive(3), at(robot) = 2)])) :-
    told_causes(search([interrupt(keys > 0, beep), halt, drive(3)]), Told).
test(the_journal_knows_the_interrupt_of_each_action_of_its_body,
     [ forall(member(Body, [ [halt, drive(3)], [halt, search(drive(3))],
                             [halt, gexec(true, search([drive(3)]))],
                             [?(true), [halt, conc(drive(3), [])]],
                             [halt, ndet(drive(3), beep)] ])),
       true(Told == [interrupt(keys = 0)]) ]) :-
    told_causes(prioritized_interrupts([interrupt(keys = 0, Body)]), Told0),
    include(=(interrupt(_)), Told0, Told).
test(an_endless_procedure_has_one_mark, true(Depth < 20)) :-
    with_domain([ prim_action(inc), poss(inc, true), execute(inc, _),
                  proc(on, [inc, on]) ], M,
                golog(M:on, [limit(300), reason(_)])),
    ev3dev_golog_run:state_of_run(M, E, _),
    depth_of(E, Depth).

depth_of(T, Depth) :-
    (   compound(T)
    ->  findall(D, ( arg(_, T, A), depth_of(A, D) ), Ds),
        max_list(Ds, Most),
        Depth is Most+1
    ;   Depth = 0
    ).

test(the_journal_knows_the_clause_of_the_procedure,
     true(Places == ['golog_why.pl':6, 'golog_why.pl':7])) :-
    tmp_file(golog_why, Directory),
    make_directory(Directory),
    atom_concat(Directory, '/golog_why.pl', File),
    setup_call_cleanup(
        open(File, write, Stream),
        write(Stream, ":- module(golog_why, []).
:- use_module(library(ev3dev/golog)).
prim_action(go(_)). poss(go(_), true).
robot_action(go(N), go_cm(30, N)).
proc(other, go(7)).
proc(way, [go(3), proceed]).
proc(proceed, [?(true), go(4)]).
"),     close(Stream)),
    with_sim(room, ( set_robot(5.6, 10.6, outB, outC),
                     load_files(File, []),
                     golog(golog_why:way, [reason(_)]),
                     journal(Journal) )),
    delete_file(File),
    delete_directory(Directory),
    findall(Base:Line,
            ( member(command(_, robot(_, _), course(_, _), Causes), Journal),
              memberchk(proc(_, Path:Line), Causes),
              file_base_name(Path, Base) ),
            Places).
test(why_knows_the_end_of_the_run,
     [ forall(member(Program-Reason,
                     [ while(true, wait)-timeout, ?(keys > 9)-no_step(_),
                       abort-stopped ])),
       true(( Ended = Reason,
              sub_string(Line, _, _, 0, Text) )) ]) :-
    with_driver(M, ( golog(M:[roll, beep, Program],
                           [timeout(1), reason(Ended)]),
                     why(outB, why(_, _, Causes)),
                     said_why(stop, Line) )),
    assertion(Causes = [golog(ended(Ended))|_]),
    format(string(Text), "golog: the run ended: ~p", [Ended]).
test(why_knows_an_exception_of_the_run,
     true(Causes = [golog(ended(exception(oops)))|_])) :-
    with_rover(M, ( assertz(M:prim_action(bad)),
                    assertz(M:robot_action(bad, throw(oops))),
                    catch(indigolog(M:[roll, bad]), oops, true),
                    why(outB, why(_, _, Causes)) )).
test(why_says_it_in_words,
     true(Text == "golog: step 2, drive(3): poss at(robot)=2")) :-
    with_driver(M, ( indigolog(M:[halt, drive(3)]),
                     said_why(robot, Line) )),
    once(sub_string(Line, Before, _, _, "golog:")),
    sub_string(Line, Before, _, 0, Text).
test(the_journal_knows_what_execute_2_is_for,
     true(memberchk(golog(2, run, f = 1), Causes))) :-
    with_sim(room,
             with_domain([ prim_action(run), prim_action(up),
                           poss(up, true), poss(run, f = 1),
                           prim_fluent(f), initially(f, 0),
                           causes_val(up, f, 1, true),
                           execute(up, _),
                           (execute(run, _) :- motor_run(outB, 30)) ],
                         M, ( indigolog(M:[up, run]),
                              why(outB, why(_, _, Causes)) ))).

without_choice(Cause0, Cause) :-
    (   Cause0 = interrupt(and(5 = 5, Condition))
    ->  Cause = interrupt(Condition)
    ;   Cause = Cause0
    ).

with_driver(M, Goal) :-
    with_rover(M, ( forall(member(Clause,
                                  [ prim_action(drive(_)), prim_fluent(at(_)),
                                    initially(at(robot), 2),
                                    causes_val(drive(N), at(robot), N, true),
                                    robot_action(drive(_), go_cm(30, 10)) ]),
                           assertz(M:Clause)),
                    asserta((M:poss(drive(_), at(robot) = 2))),
                    retractall(M:poss(_, true)),
                    assertz((M:poss(A, true) :- A \= drive(_))),
                    Goal )).

told_causes(Program, Told) :-
    with_driver(M, ( golog(M:Program, [limit(4), reason(_)]),
                     journal(Journal) )),
    once(( member(command(_, robot(_, _), course(_, _), Causes), Journal) )),
    exclude(is_called, Causes, Told).

is_called(called(_)).

user:said_why(What, Line) :-
    setup_call_cleanup(
        asserta((user:thread_message_hook(_, help, Lines) :-
                     nb_setval(golog_said, Lines)), Ref),
        why(What),
        erase(Ref)),
    nb_getval(golog_said, Said),
    with_output_to(string(Text), print_message_lines(current_output, '', Said)),
    once(split_string(Text, "\n", "", [Line|_])).

test(the_same_seed_the_same_run, H1 == H2) :-
    runs_of_rover(H1),
    runs_of_rover(H2).

runs_of_rover(H-T) :-
    with_rover(M, ( sim_press(enter, [after(0.7)]),
                    sim_press(enter, [after(1.3)]),
                    golog(M:[reactive, look], [history(H)]),
                    sim_time(T) )).
:- end_tests(golog_robot).
