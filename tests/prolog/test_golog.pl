:- use_module('../support/trees').
:- use_module(library(ev3dev/golog)).
:- use_module('../support/cases').
:- use_module('../support/golog/axioms').
:- use_module('../support/golog/lab').
:- use_module('../support/golog/random_programs').
:- use_module('../support/golog/runs').
:- use_module('../support/golog/wholes').
:- use_module('../support/golog/small_world', []).
:- use_module(library(plunit)).

% The language: which steps a program can take.
%
% What each construct means is that of its definition: [G] Levesque, Reiter,
% Lesperance, Lin, Scherl: GOLOG (1997); [C] De Giacomo, Lesperance, Levesque:
% ConGolog (2000); [I] De Giacomo, Lesperance, Levesque, Sardina: IndiGolog
% (2009).
:- begin_tests(golog_programs).
test(nothing_is_final_and_takes_no_step, Steps == []) :- % [C] nil
    lab_final([]),
    steps([], Steps).
test(an_action_takes_one_step, Steps == [[]-[a]]) :-    % [C] a
    \+ lab_final(a),
    steps(a, Steps).
test(an_impossible_action_takes_none, Steps == []) :-
    steps(never, Steps).
test(fluents_in_arguments_are_evaluated, Runs == [[up, set_to(1)]]) :-
    runs([up, set_to(n)], Runs).
test(an_open_action_takes_all_values, Steps == [[]-[off(1)], []-[off(3)]]) :-
    steps(off(_), Steps).
test(a_test_is_a_step, Steps == [[]-[]]) :-             % [C] phi?
    \+ lab_final(?(n = 0)),
    steps(?(n = 0), Steps).
test(a_false_test_blocks, Steps == []) :-
    steps(?(n = 1), Steps).
test(a_test_binds_each_solution, Ns == [1, 3]) :-
    findall(N, golog_lab:trans(?(light(N) = on), [], [], []), Ns).
test(a_sequence_steps_in_its_first, Steps == [[[], b]-[a]]) :- % [C] d1;d2
    steps([a, b], Steps).
test(a_sequence_may_end_its_first,
     Steps == [[]-[b], [[[], star(a)], b]-[a]]) :-
    steps([star(a), b], Steps).
test(a_sequence_ends_when_all_may) :-
    lab_final([star(a), []]),
    \+ lab_final([star(a), b]).
test(ndet_has_both, Steps == [[]-[a], []-[b]]) :-       % [C] d1|d2
    steps(ndet(a, b), Steps).
test(ndet_is_final_if_one_is) :-
    lab_final(ndet(a, [])),
    lab_final(ndet([], a)),
    \+ lab_final(ndet(a, b)).
test(if_is_one_step_with_its_body, Steps == [[]-[a]]) :- % [C] if
    steps(if(n = 0, a, b), Steps).
test(if_else, Steps == [[]-[b]]) :-
    steps(if(n = 1, a, b), Steps).
test(if_is_final_by_its_branch) :-
    lab_final(if(n = 0, [], a)),
    \+ lab_final(if(n = 1, [], a)).
test(while_is_one_step_with_its_body,                   % [C] while
     Steps == [[[], while(n < 2, up)]-[up]]) :-
    steps(while(n < 2, up), Steps).
test(while_ends_when_its_condition_is_false, Runs == [[up, up]]) :-
    runs(while(n < 2, up), Runs).
test(while_is_final_if_its_body_is) :-
    lab_final(while(n = 0, star(a))),
    \+ lab_final(while(n = 0, a)).
test(star_is_final, Steps == [[[], star(a)]-[a]]) :-    % [C] d*
    lab_final(star(a)),
    steps(star(a), Steps).
test(star_n_runs_at_most_n_times, Runs == [[], [a], [a, a]]) :-
    runs(star(a, 2), Runs).
test(star_finds_a_given_history, true) :-
    once(golog_lab:do(star(ndet(a, b)), [b, a, b])),
    \+ golog_lab:do([star(a), b], [a]).
test(pi_over_all, Runs == [[off(1)], [off(3)]]) :-      % [C] pi v.d
    runs(pi(x, [?(light(x) = on), off(x)]), Runs).
test(pi_with_a_prolog_variable, Runs == [[off(1)], [off(3)]]) :-
    runs(pi(X, [?(light(X) = on), off(X)]), Runs).
test(pi_of_a_list_of_variables, Runs == [[off(1), set_to(on)],
                                         [off(3), set_to(on)]]) :-
    runs(pi([x, y], [?(light(x) = y), off(x), set_to(y)]), Runs).
test(pi_over_a_sort_that_is_a_list, Runs == [[set_to(hall)],
                                             [set_to(lab)]]) :-
    runs(pi(r, room, set_to(r)), Runs).
test(pi_over_a_sort_that_enumerates, Runs == [[set_to(left)],
                                              [set_to(right)]]) :-
    runs(pi((d, direction), set_to(d)), Runs).
test(pi_over_a_list, Runs == [[set_to(4)], [set_to(5)]]) :-
    runs(pi((d, [4, 5]), set_to(d)), Runs).
test(pi_is_final_if_it_is_for_one) :-
    lab_final(pi(x, [4, 5], if(x = 5, [], a))).
test(an_inner_pi_has_its_own_variable,
     Runs == [[set_to(1), set_to(2)]]) :-
    runs(pi(x, [?(x = 1), set_to(x), pi(x, [?(x = 2), set_to(x)])]), Runs).
test(a_value_is_no_variable, Runs == [[set_to(y), set_to(2)]]) :-
    runs(pi(x, [?(member(x, [y])), set_to(x),
                pi(y, [?(y = 2), ?(x \= 2), set_to(y)])]), Runs).
test(an_argument_is_no_variable, Runs == [[set_to(hall)]]) :-
    runs(outer(hall), Runs).
test(a_fluent_as_a_value_in_pi, Runs == [[set_to(0)]]) :-
    runs(pi(x, [?(x = n), set_to(x)]), Runs).
test(a_procedure, Runs == [[a, b]]) :-                  % [C] procedures
    runs(both, Runs).
test(a_procedure_has_all_its_clauses, Runs == [[a], [c]]) :-
    runs(either(a), Runs).
test(a_procedure_may_call_itself, Runs == [[up, up]]) :-
    runs(count(2), Runs).
test(a_procedure_with_pi, Runs == [[go(lab)]]) :-
    runs(shut(lab), Runs).
test(for_takes_each_in_turn, Runs == [[set_to(hall), set_to(lab)]]) :- % [I]
    runs(for(r, room, set_to(r)), Runs).
test(for_over_nothing_is_final) :-
    lab_final(for(r, [], set_to(r))).
test(for_over_the_value_of_a_fluent, Runs == [[set_to(1), set_to(2)]]) :-
    runs(for(r, list, set_to(r)), Runs).
:- end_tests(golog_programs).

:- begin_tests(golog_concurrent).
test(conc_interleaves, Steps == [conc([], b)-[a], conc(a, [])-[b]]) :- % [C]
    steps(conc(a, b), Steps).
test(conc_runs, Runs == [[a, b, c], [a, c, b], [c, a, b]]) :-
    runs(conc([a, b], c), Runs).
test(conc_is_final_if_both_are) :-
    lab_final(conc(star(a), [])),
    \+ lab_final(conc(a, [])).
test(pconc_prefers_the_first, Steps == [pconc([], b)-[a]]) :- % [C] >>
    steps(pconc(a, b), Steps).
test(pconc_takes_the_second_if_the_first_is_blocked,
     Steps == [pconc(never, [])-[b]]) :-
    steps(pconc(never, b), Steps).
test(pconc_tries_all_of_its_first, Runs == [[b, c]]) :-
    runs(pconc([ndet(a, b), ?(done(b)), c], []), Runs).
test(pconc_goes_back_to_its_first, Runs == [[up, a, b]]) :-
    runs(pconc([?(n = 1), a], [up, b]), Runs).
test(iconc, Steps == [conc([], iconc(a))-[a]]) :-       % [C] d||
    lab_final(iconc(a)),
    steps(iconc(a), Steps).
test(interrupt_tests_and_steps_at_once,                 % [C] <phi -> d>
     Steps == [[[], interrupt(n = 0, up)]-[up]]) :-
    steps(interrupt(n = 0, up), Steps).
test(interrupt_with_a_variable_takes_all,
     Hs == [[off(1)], [off(3)]]) :-
    findall(H, golog_lab:trans(interrupt(x, light(x) = on, off(x)), [], _, H), Hs).
test(interrupt_with_variables_and_sorts,
     Hs == [[set_to(1-left)], [set_to(3-left)], [set_to(1-right)],
            [set_to(3-right)]]) :-
    findall(H,
            golog_lab:trans(interrupt([x, (d, direction)], light(x) = on,
                                      set_to(x-d)), [], _, H),
            Hs).
test(the_first_interrupt_is_the_highest, Runs == [[up, up, off(1), off(3)]]) :-
    once(golog_lab:do(prioritized_interrupts(
                          [ interrupt(n < 2, up),
                            interrupt(x, lit(x), off(x)) ]), H)),
    reverse(H, Run),
    Runs = [Run].
test(interrupts_end_when_none_can_step, Runs == [[b]]) :-
    runs([prioritized_interrupts([interrupt(n > 5, a)]), b], Runs).
test(what_an_interrupt_has_begun_is_ended, Runs == [[up, a, b]]) :-
    runs([prioritized_interrupts([interrupt(n = 0, [up, a])]), b], Runs).
test(interrupts_can_be_repeated, Runs == [[up, down, up, down]]) :-
    P = prioritized_interrupts([interrupt(n = 0, [up])]),
    runs([P, down, P, down], Runs).
test(nested_interrupts_end_alone,
     Runs == [[off(1), up, down, off(3), up, down]]) :-
    once(golog_lab:do(
             prioritized_interrupts(
                 [ interrupt(x, lit(x),
                             [ off(x),
                               prioritized_interrupts(
                                   [interrupt(n = 0, up)]),
                               down ]) ]), H)),
    reverse(H, Run),
    Runs = [Run].
test(interrupts_beside_others, Runs == [[up, a]]) :-
    runs(pconc(prioritized_interrupts([interrupt(n = 0, up)]), a), Runs).
test(atomic_is_not_interleaved, Runs == [[a, b, c], [c, a, b]]) :- % [I]
    runs(conc(atomic([a, b]), c), Runs).
test(rrobin, Runs == [[a, b, a, b]]) :-
    once(golog_lab:do(rrobin([[a, a], [b, b]]), H)),
    reverse(H, Run),
    Runs = [Run].
test(rconc_has_all_orders, Sorted == [[a, b], [b, a]]) :-
    runs(rconc(a, b), Runs),
    sort(Runs, Sorted).
test(rconc_of_a_list_has_all_orders, Count == 6) :-
    runs(rconc([a, b, c]), Runs),
    sort(Runs, Sorted),
    length(Sorted, Count).
test(sync_takes_the_same_action, Runs == [[a, b]]) :-
    runs(sync([[a, ndet(b, c)], [?(true), a, b]]), Runs).
:- end_tests(golog_concurrent).

:- begin_tests(golog_more).
test(wndet_takes_the_first, Runs == [[a]]) :-           % [I]
    runs(wndet(a, b), Runs).
test(wndet_takes_the_second_if_it_must, Runs == [[b]]) :-
    runs(wndet(never, b), Runs).
test(rndet_has_both, Sorted == [[a], [b]]) :-           % [I]
    runs(rndet(a, b), Runs),
    sort(Runs, Sorted).
test(rpi_has_all, Sorted == [[set_to(hall)], [set_to(lab)]]) :- % [I]
    runs(rpi(r, room, set_to(r)), Runs),
    sort(Runs, Sorted).
test(pi_of_chance, Sorted == [[set_to(hall)], [set_to(lab)]]) :-
    runs(pi(r(x), room, set_to(x)), Runs),
    sort(Runs, Sorted).
test(gexec_runs_as_long_as_its_guard_holds, Runs == [[up, b]]) :- % [I]
    runs([gexec(n = 0, [up, a]), b], Runs).
test(gexec_ends_with_its_program, Runs == [[a, b]]) :-
    runs([gexec(n = 0, a), b], Runs).
test(goal_ends_when_reached, Runs == [[up, c]]) :-
    runs([goal(n = 1, [up, a], false, b), c], Runs).
test(goal_recovers, Runs == [[up, b, c]]) :-
    runs([goal(n = 5, [up, a], n = 1, b), c], Runs).
test(set_and_unset, Runs == [[set(ringing), a, unset(ringing), b]]) :-
    runs([set(ringing), if(ringing, a, b), unset(ringing),
          if(ringing, a, b)], Runs).
test(sim_changes_fluents, Runs == [[sim(ring), a]]) :-
    runs([sim(ring), if(ringing, a, b)], Runs).
test(abort_of_a_process, Runs == [[set(ringing), e(ringing, false)]]) :-
    runs([set(ringing), gexec(ringing, [abort(ringing), a])], Runs).
test(a_test_with_a_mark, Runs == [[test(n = 0)]]) :-
    runs(??(n = 0), Runs).
test(achieve_by_rules, Runs == [[up, up]]) :-
    setup_call_cleanup(
        assertz(golog_lab:rule(level(N), n < N, count(N))),
        runs(achieve(level(2)), Runs),
        retractall(golog_lab:rule(_, _, _))).
test(wait_is_a_mark_offline, Runs == [[wait]]) :-
    runs(wait, Runs).
test(exogint_is_its_program, Runs == [[a]]) :-
    runs(exogint(a, true), Runs).
test(time_is_its_program, Runs == [[a, b]]) :-
    runs([time(a, 10), ttime(b, 10)], Runs).
test(printing_the_history_is_a_step, Steps == [[]-[a]]) :-
    steps(?(printHistory), [a], Steps).
:- end_tests(golog_more).

% ---------------- EACH ONE

%   trans_of(Program, Final, Steps): all steps that Program can take in the lab
%   at the beginning, as Program1-History, and whether it may end there. [G],
%   [C], [I] as above; [M] the manual and the source of full IndiGolog, which
%   is where these words are defined; [L] Levesque, Pagnucco: Legolog (2000).

trans_of([], yes, []).                                          % [C] nil
trans_of([a, b], no, [[[], b]-[a]]).                            % [C]
trans_of(?(light(_) = on), no, [[]-[], []-[]]).                 % [C] phi?
trans_of(ndet(a, b), no, [[]-[a], []-[b]]).                     % [C]
trans_of(if(n = 0, ndet(a, b), c), no, [[]-[a], []-[b]]).       % [C]
trans_of(if(n = 1, c, ndet(a, b)), no, [[]-[a], []-[b]]).
trans_of(while(n < 2, ndet(up, a)), no,                         % [C]
         [ [[], while(n < 2, ndet(up, a))]-[up],
           [[], while(n < 2, ndet(up, a))]-[a] ]).
trans_of(a : ndet(b, c), no, [[[], ndet(b, c)]-[a]]).            % [G]
trans_of(#(a, star(b)), yes, [[]-[a], [[], star(b)]-[b]]).      % [G]
trans_of(star(ndet(a, b)), yes,                                 % [C]
         [[[], star(ndet(a, b))]-[a], [[], star(ndet(a, b))]-[b]]).
trans_of(star(ndet(a, b), 2), yes,                              % [M]
         [[[], star(ndet(a, b), 1)]-[a], [[], star(ndet(a, b), 1)]-[b]]).
trans_of(pi(x, off(x)), no, [[]-[off(1)], []-[off(3)]]).        % [C]
trans_of(pi(x, [4, 5], set_to(x)), no,                          % [M]
         [[]-[set_to(4)], []-[set_to(5)]]).
trans_of(conc(a, b), no, [conc([], b)-[a], conc(a, [])-[b]]).   % [C]
trans_of(pconc(ndet(a, b), c), no, [pconc([], c)-[a], pconc([], c)-[b]]).
trans_of(pconc(never, ndet(a, b)), no,                          % [C]
         [pconc(never, [])-[a], pconc(never, [])-[b]]).
trans_of(iconc(ndet(a, b)), yes,                                % [C]
         [ conc([], iconc(ndet(a, b)))-[a],
           conc([], iconc(ndet(a, b)))-[b] ]).
trans_of(interrupt(n = 0, ndet(a, b)), yes,                     % [C]
         [ [[], interrupt(n = 0, ndet(a, b))]-[a],
           [[], interrupt(n = 0, ndet(a, b))]-[b] ]).
trans_of(interrupt(n = 1, a), yes, []).
trans_of(interrupt(x, lit(x), off(x)), yes,                     % [C]
         [ [[], interrupt(x, lit(x), off(x))]-[off(1)],
           [[], interrupt(x, lit(x), off(x))]-[off(3)] ]).
trans_of(prioritized_interrupts([ interrupt(n = 1, a),          % [C]
                                  interrupt(n = 0, ndet(b, c)),
                                  interrupt(true, a) ]), no,
         [ prioritized_interrupts([ interrupt(n = 1, a),
                                    [[], interrupt(n = 0, ndet(b, c))],
                                    interrupt(true, a) ])-[b],
           prioritized_interrupts([ interrupt(n = 1, a),
                                    [[], interrupt(n = 0, ndet(b, c))],
                                    interrupt(true, a) ])-[c] ]).
trans_of(prioritized_interrupts([interrupt(n = 1, a)]), no, [[]-[]]).
trans_of(prioritized_interrupts_simple([interrupt(n = 0, a)]), no,  % [M]
         [prioritized_interrupts([[[], interrupt(n = 0, a)]])-[a]]).
trans_of(search(ndet([a, never], ndet([b, c], c))), no,         % [I]
         [search([[], c])-[b], search([])-[c]]).
trans_of(search(ndet(a, b), m), no, [search([])-[a], search([])-[b]]).
trans_of(search(ndet(a, b), m, [depth(9)]), no,                 % [M], ours
         [search([])-[a], search([])-[b]]).
trans_of(searchn(ndet(a, b), []), no,                           % [M]
         [search([])-[a], search([])-[b]]).
trans_of(searchc([ndet(a, b), branch(ringing)]), no,            % [M]
         [[a, if(ringing, [], [])]-[], [b, if(ringing, [], [])]-[]]).
trans_of(searchc(ndet(a, b), m), no, [[a]-[], [b]-[]]).
trans_of(gexec(n = 0, ndet(a, b)), no,                          % [M]
         [gexec(n = 0, [])-[a], gexec(n = 0, [])-[b]]).
trans_of(gexec(n = 1, a), yes, []).
trans_of(gexec2(n = 0, ndet(a, b)), no,                         % [M]
         [gexec2(n = 0, [])-[a], gexec2(n = 0, [])-[b]]).
trans_of(gexec2(n = 1, a), yes, []).
trans_of(goal(n = 1, ndet(a, b), false, c), no,                 % [M]
         [goal(n = 1, [], false, c)-[a], goal(n = 1, [], false, c)-[b]]).
trans_of(goal(n = 1, a, n = 0, ndet(b, c)), no, [[]-[b], []-[c]]).
trans_of(goal(n = 0, a, false, b), yes, []).
trans_of(wndet(ndet(a, b), c), no, [[]-[a], []-[b]]).           % [M]
trans_of(wndet(never, ndet(a, b)), no, [[]-[a], []-[b]]).
trans_of(wndet([], a), no, [[]-[a]]).
trans_of(wndet([], []), yes, []).
trans_of(rndet(a, b), no, [[]-[a], []-[b]]).                    % [M]
trans_of(rpi((x, [4, 5]), set_to(x)), no,                       % [M]
         [[]-[set_to(4)], []-[set_to(5)]]).
trans_of(rpi(x, [4, 5], set_to(x)), no,
         [[]-[set_to(4)], []-[set_to(5)]]).
trans_of(rconc(a, b), no, [rconc([], b)-[a], rconc(a, [])-[b]]).    % [M]
trans_of(rconc([a, b]), no, [rconc([[], a])-[b], rconc([[], b])-[a]]).
trans_of(rrobin([a, b, c]), no,                                 % [M]
         [ rrobin([b, c, []])-[a], rrobin([a, c, []])-[b],
           rrobin([a, b, []])-[c] ]).
trans_of(atomic([ndet(a, b), c]), no,                           % [M]
         [atomic([[], c])-[a], atomic([[], c])-[b]]).
trans_of(for(x, [4, 5], set_to(x)), no,                         % [M]
         [[[], set_to(5)]-[set_to(4)]]).
trans_of(??(light(_) = on), no,                                 % [M]
         [[]-[test(light(1) = on)], []-[test(light(3) = on)]]).
trans_of(??(n = 1), no, []).
trans_of(exogint(ndet(a, b), true), no,                         % [M]
         [exogint([], true)-[a], exogint([], true)-[b]]).
trans_of(wait, no, [[]-[wait]]).                                % [L], [M]
trans_of(wait_exog, no, [[]-[wait]]).                           % [M]
trans_of(?(wait_exog_action), no, [[]-[wait]]).                 % [M]
trans_of(sim(ring), no, [[]-[sim(ring)]]).                      % [M]
trans_of(achieve(n = 2), no, [search(achieve(n = 2))-[up]]).    % ours
trans_of(achieve(n = 2, [shortest(false)]), no,                 % ours
         [search(achieve(n = 2, [shortest(false)]))-[up]]).
trans_of(abort, no, [[]-[abort]]).                              % [M]
trans_of(abort(ringing), no, [[]-[e(ringing, false)]]).         % [M]
trans_of(commit, no, [[]-[commit]]).                            % [M]
trans_of(branch(ringing), no, [[]-[branch(ringing)]]).          % [M]
trans_of(set(ringing), no, [[]-[set(ringing)]]).                % [M]
trans_of(unset(ringing), no, [[]-[unset(ringing)]]).            % [M]
trans_of(e(light(n), n), no, [[]-[e(light(0), 0)]]).            % [I]
trans_of(e(n, 2), no, [[]-[e(n, 2)]]).
%   The first step that is found in time
trans_of(time(ndet(a, b), 9), no, [[]-[a]]).                    % [M]
trans_of(ttime([ndet(a, b), c], 9), no, [ttime([[], c], 9)-[a]]).   % [M]
trans_of(sync([ndet(a, b), ndet(b, c)]), no, [sync([[], []])-[b]]). % [M]
trans_of(together([a]), no, [[]-[[a]]]).                         % ours
trans_of(either(a), no, [[]-[a], []-[c]]).                      % [C] procedures
trans_of(off(_), no, [[]-[off(1)], []-[off(3)]]).               % [C] action

:- begin_tests(golog_each).
test(all_solutions_of_trans, [ forall(trans_of(Program, _, Steps)),
                               true(Found =@= Wanted) ]) :-
    steps(Program, Found0),
    msort(Found0, Found),
    msort(Steps, Wanted).
test(final, [ forall(trans_of(Program, Final, _)), true(Found == Final) ]) :-
    (   lab_final(Program)
    ->  Found = yes
    ;   Found = no
    ).
test(each_construct_is_there, Missing == []) :-
    findall(Name/Arity,
            ( ( ev3dev_golog_programs:construct(E)
              ; ev3dev_golog_programs:weak_construct(E)
              ),
              E \== [],
              functor(E, Name, Arity),
              \+ sub_atom(Name, 0, _, _, $),
              functor(Program, Name, Arity),
              \+ trans_of(Program, _, _) ),
            Missing).
:- end_tests(golog_each).

% ---------------- LAWS FOR EACH

without_part([]).
without_part(?(_)).
without_part(??(_)).
without_part(wait).
without_part(wait_exog).
without_part(sim(_)).
without_part(achieve(_)).
without_part(achieve(_, _)).
without_part(abort).
without_part(abort(_)).
without_part(commit).
without_part(branch(_)).
without_part(set(_)).
without_part(unset(_)).
without_part(e(_, _)).
without_part(together(_)).

whole_in_whole(P, E) :-
    whole(P, E).
whole_in_whole(P, E) :-
    whole(P, E1),
    \+ prints(E1),
    whole(E1, E),
    \+ prints(E).

prints(search(_, m)).
prints(search(_, m, _)).

%   begun(+Program0, -Program, -Situation, +Context): the first action has
%   been done, and Program remains.

begun(E0, E, S, X) :-
    ev3dev_golog_progression:situation([], S0, X),
    once(first_action(E0, S0, E, S, X)).

first_action(E0, S0, E, S, X) :-
    ev3dev_golog_transitions:step(E0, S0, E1, S1, X),
    (   done_first(S1, _)
    ->  E = E1,
        S = S1
    ;   first_action(E1, S1, E, S, X)
    ).

done_first(S, A) :-
    ev3dev_golog_situation:situation_history(S, [A|_]).

lab_context(Words, X) :-
    ev3dev_golog_theory:prepare(golog_lab),
    ev3dev_golog_context:context(golog_lab, Words, X).

%   What Program may do next in Situation; `none` is a step without an action.

next_actions(E, S, X, As) :-
    ev3dev_golog_situation:situation_history(S, H),
    findall(A,
            ( ev3dev_golog_transitions:step(E, S, _, S1, X),
              ev3dev_golog_situation:situation_history(S1, H1),
              (   H1 = [A|H]
              ->  true
              ;   A = none
              ) ),
            As0),
    sort(As0, As).

beside(E, C, conc(E, C)).
beside(E, C, conc(C, E)).
beside(E, C, '$turn'(E, C)).
beside(E, C, '$turn'(C, E)).
beside(E, C, pconc(E, C)).
beside(E, C, pconc(C, E)).
beside(E, C, rconc(E, C)).
beside(E, C, rconc(C, E)).
beside(E, C, rconc([never, E, C])).
beside(E, C, rconc([C, never, E])).
beside(E, C, rrobin([never, E, C])).
beside(E, C, rrobin([C, never, E])).
beside(E, C, prioritized_interrupts([never, E, C])).
beside(E, C, prioritized_interrupts([C, never, E])).

:- begin_tests(golog_laws,
               [cleanup(retractall(ev3dev_golog_search:replanned_(_)))]).
test(each_construct_has_a_whole, Missing == []) :-
    findall(E,
            ( ( ev3dev_golog_programs:construct(E)
              ; ev3dev_golog_programs:weak_construct(E) ),
              \+ whole(a, E),
              \+ without_part(E) ),
            Missing).
test(nothing_comes_between_the_actions_of_an_atomic, Wrong == []) :-
    lab_context([], X),
    findall(Whole-Two-As,
            ( whole_in_whole(atomic([up, a]), Whole),
              begun(Whole, E, S, X),
              beside(E, c, Two),
              next_actions(Two, S, X, As),
              As \== [a] ),
            Wrong).
test(after_an_atomic_others_go_on, Wrong == []) :-
    lab_context([], X),
    findall(Whole-As,
            ( whole(atomic([up, a]), Whole),
              begun(Whole, E0, S0, X),
              ev3dev_golog_transitions:step(E0, S0, E, S, X),
              next_actions(conc(E, c), S, X, As),
              \+ memberchk(c, As) ),
            Wrong).
test(an_atomic_that_is_given_up_holds_nobody_up,
     [ forall(member(Whole, [ gexec(n = 0, P), gexec2(n = 0, P),
                              goal(n = 1, P, false, never) ])),
       true(Runs == [[c, up, b], [up, b, c], [up, c, b]]) ]) :-
    P = atomic([up, a]),
    runs(conc([Whole, b], c), Runs0),
    sort(Runs0, Runs).
test(a_simplified_program_is_the_same, Wrong == []) :-
    lab_context([], X),
    findall(Steps-Steps0,
            ( whole_in_whole([[up, a], c], Whole),
              begun(Whole, E0, S, X),
              simple(E0, E, X),
              steps_and_end(E0, S, X, Steps0),
              steps_and_end(E, S, X, Steps),
              Steps \=@= Steps0 ),
            Wrong).
test(a_simplified_program_has_no_empty_one, Wrong == []) :-
    lab_context([], X),
    findall(E,
            ( whole_in_whole([[up, a], c], Whole),
              begun(Whole, E0, _, X),
              simple(E0, E, X),
              part_of(E, Part),
              Part == [[[], a], c] ),
            Wrong).
test(a_simplified_action_keeps_its_arguments,
     Runs == [[sync([[[], 1]])], [ttime([[], 1], 2)]]) :-
    with_domain([ prim_action(sync(_)), prim_action(ttime(_, _)),
                  poss(_, true) ],
                M,
                findall(Run,
                        do(M:ndet([sync([[[], 1]])], [ttime([[], 1], 2)]),
                           Run),
                        Runs)).
test(no_mark_of_the_interpreter_is_shown, Wrong == []) :-
    lab_context([online], X),
    findall(E,
            ( whole_in_whole(atomic([conc([up, a], [up, b]), c]), Whole),
              begun(Whole, E0, _, X),
              ev3dev_golog_transitions:program_shown(E0, E),
              part_of(E, Part),
              compound(Part),
              functor(Part, Name, _),
              sub_atom(Name, 0, 1, _, $) ),
            Wrong).
test(interrupts_that_stop_end_what_they_have_begun,
     [ forall(( whole([?(ringing), a, interrupt(true, b)], Whole),
                keeps_interrupts(Whole) )),
       true(Left-As == []-[a]) ]) :-
    % None can take a step before it rings.
    lab_context([], X),
    ev3dev_golog_progression:situation([], S0, X),
    once(ev3dev_golog_transitions:step(prioritized_interrupts([Whole]), S0,
                                       E, S1, X)),
    findall(I, ( part_of(E, I), I = interrupt(_, _) ), Left),
    ev3dev_golog_progression:done(ring, S1, S2, X),
    % The test, in sync/1 together with the action
    (   ev3dev_golog_transitions:step(E, S2, E1, S2, X)
    ->  true
    ;   E1 = E
    ),
    next_actions(E1, S2, X, As).

%   Constructs that keep a part that has not taken a step yet

keeps_interrupts(Whole) :-
    functor(Whole, Name, _),
    memberchk(Name, [ '[|]', conc, '$turn', pconc, rconc, rrobin, gexec,
                      gexec2, goal, exogint, ttime, sync ]),
    Whole \= goal(_, never, _, _).

simple(E0, E, X) :-
    ev3dev_golog_transitions:simplified(E0, E, X).

%   Each step of Program, as what it does and what remains, and whether it may
%   end

steps_and_end(E, S, X, Steps-End) :-
    findall(H-Next,
            ( ev3dev_golog_transitions:step(E, S, Next0, S1, X),
              simple(Next0, Next, X),
              ev3dev_golog_situation:situation_history(S1, H) ),
            Steps0),
    msort(Steps0, Steps),
    (   ev3dev_golog_transitions:is_final(E, S, X)
    ->  End = yes
    ;   End = no
    ).

%   Not in what a plan has found: it is followed as it is.

part_of(E, E).
part_of(E, Part) :-
    compound(E),
    E \= '$path'(_, _, _, _),
    arg(_, E, A),
    part_of(A, Part).
:- end_tests(golog_laws).

% ---------------- AGAINST THE AXIOMS

:- begin_tests(golog_axioms).
test(random_programs_have_the_histories_of_the_axioms,
     [Different, Enough, Rich] == [[], true, true]) :-
    findall(Same,
            ( case(500, 10000, Seed),
              against_axioms(Seed, Same) ),
            Results),
    findall(D, ( member(D, Results), D = different(_, _, _) ), Different),
    exclude(==(too_large), Results, Compared),
    length(Results, All),
    length(Compared, Count),
    (   Count * 10 >= All * 9
    ->  Enough = true
    ;   Enough = Count-All
    ),
    findall(N, ( member(N, Compared), integer(N), N > 1 ), Ns),
    length(Ns, Several),
    (   Several * 4 >= Count
    ->  Rich = true
    ;   Rich = Several
    ).

%   Programs whose histories take too long to find are left out.

against_axioms(Seed, Result) :-
    small_program(Seed, Program),
    call_with_inference_limit(histories(Program, golog_small_world, Wanted),
                              3000000, Limit),
    (   Limit == inference_limit_exceeded
    ->  Result = too_large
    ;   findall(H, golog_small_world:do(Program, H), Hs0),
        sort(Hs0, Hs),
        (   Hs == Wanted
        ->  length(Hs, Result)
        ;   Result = different(Program, Wanted, Hs)
        )
    ).

%   The first run of a search is that of its program, also where it looks for states that it
%   knows.

test(a_search_is_as_its_program, Wrong == []) :-
    findall(Program-Run-Found,
            ( case(200, 3000, Seed),
              small_program(Seed, Program),
              first_run(Program, Run),
              first_run(search(ndet([?(between(1, 600, _)), ?(false)], Program)), Found),
              Run \== Found,
              Run \== too_large ),
            Wrong).

first_run(Program, Run) :-
    (   call_with_inference_limit(golog_small_world:do(Program, H), 3000000, Limit)
    ->  ( Limit == inference_limit_exceeded -> Run = too_large ; Run = H )
    ;   Run = none
    ).

small_program(Seed, Program) :-
    random_program(Seed, 3,
                   words([a, b, c, put(1), put(2), put(3)],
                         [ x > 1, x = 1, light(1) = on, light(2) = off,
                           n < 3, odd, lit, light(x) = on,
                           some(k, [1, 2, 3], light(k) = on) ],
                         [ [program, program], [program, program, program],
                           ndet(program, program), wndet(program, program),
                           if(condition, program, program),
                           while(condition, [action, program]),
                           star([action, program]),
                           pi(v, [1, 2, 3], [put(v), program]),
                           pi(v, [1, 2], [?(light(v) = off), program]),
                           for(v, [3, 1], wndet(put(v), program)),
                           conc(program, program), pconc(program, program),
                           conc(program, atomic(program)),
                           iconc([action, ?(condition)]),
                           prioritized_interrupts(
                               [ interrupt(condition, [action, program]),
                                 interrupt(condition, [action, action]) ]),
                           search(program), ab, down(1), again(2) ]),
                   Program).
:- end_tests(golog_axioms).
