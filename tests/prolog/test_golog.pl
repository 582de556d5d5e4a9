:- use_module('../support/trees').
:- use_module(library(ev3dev/golog)).
:- use_module('../support/cases').
:- use_module('../support/golog/axioms').
:- use_module('../support/golog/lab').
:- use_module('../support/golog/random_programs').
:- use_module('../support/golog/sensing').
:- use_module('../support/golog/small_world', []).
:- use_module('../support/golog/switches', []).
:- use_module('../support/golog/uncertain').
:- use_module('../support/simulation').
:- use_module(library(ev3dev)).
:- use_module(library(ev3dev/sim)).
:- use_module(library(ev3dev/journal)).
:- use_module(library(plunit)).

% What each construct means is that of its definition: [G] Levesque, Reiter,
% Lesperance, Lin, Scherl: GOLOG (1997); [C] De Giacomo, Lesperance, Levesque:
% ConGolog (2000); [I] De Giacomo, Lesperance, Levesque, Sardina: IndiGolog
% (2009).

%   Every History to which Program runs offline, oldest action first.

runs(Program, Runs) :-
    runs(Program, [], Runs).

runs(Program, H0, Runs) :-
    findall(Run,
            ( golog_lab:do(Program, H0, H), reverse(H, Run) ),
            Runs).

%   Every step that Program can take.

steps(Program, Steps) :-
    steps(Program, [], Steps).

steps(Program, H0, Steps) :-
    findall(E-H, golog_lab:trans(Program, H0, E, H), Steps).

lab_final(Program) :-
    golog_lab:final(Program, []).

%   All instances of Template for which Condition holds after History.

answers(Template, Condition, H, Answers) :-
    findall(Template, golog_lab:holds(Condition, H), Answers).

true_in(Condition, H) :-
    golog_lab:holds(Condition, H).

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

                /*******************************
                *           EACH ONE           *
                *******************************/

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

                /*******************************
                *        LAWS FOR EACH         *
                *******************************/

%   whole(+Part, -Program): Program begins with a step of Part. Each construct
%   has one, in each place where it may be, but those of without_part/1.

whole(P, [P]).
whole(P, [[], P]).
whole(P, [P, I]) :- idle(I).
whole(P, ndet(P, never)).
whole(P, ndet(never, P)).
whole(P, rndet(P, never)).
whole(P, wndet(P, never)).
whole(P, wndet(never, P)).
whole(P, if(true, P, never)).
whole(P, if(false, never, P)).
whole(P, while(neg(done(a)), P)).
whole(P, star(P)).
whole(P, star(P, 2)).
whole(P, pi(x, [1], P)).
whole(P, pi((x, [1]), P)).
whole(P, rpi(x, [1], P)).
whole(P, rpi((x, [1]), P)).
whole(P, for(x, [1], P)).
whole(P, conc(P, I)) :- idle(I).
whole(P, conc(I, P)) :- idle(I).
whole(P, '$turn'(P, I)) :- idle(I).
whole(P, '$turn'(I, P)) :- idle(I).
whole(P, pconc(P, I)) :- idle(I).
whole(P, pconc(I, P)) :- idle(I).
whole(P, rconc(P, I)) :- idle(I).
whole(P, rconc(I, P)) :- idle(I).
whole(P, rconc([I, P, I])) :- idle(I).
whole(P, rrobin([I, P, I])) :- idle(I).
whole(P, iconc(P)).
whole(P, interrupt(true, P)).
whole(P, interrupt(x, x = 1, P)).
whole(P, prioritized_interrupts([I, P, I])) :- idle(I).
whole(P, prioritized_interrupts_simple([interrupt(true, P)])).
whole(P, search(P)).
whole(P, search(P, m)).
whole(P, search(P, m, [depth(99)])).
whole(P, searchn(P, [])).
whole(P, searchc(P)).
whole(P, searchc(P, [])).
whole(P, '$path'(P, [none], at(99, none), [])).
whole(P, gexec(true, P)).
whole(P, gexec2(true, P)).
whole(P, goal(false, P, false, never)).
whole(P, goal(false, never, true, P)).
whole(P, atomic(P)).
whole(P, '$atomic'(P)).
whole(P, '$within'(interrupt(true), P)).
whole(P, exogint(P, true)).
whole(P, time(P, 99)).
whole(P, ttime(P, 99)).
whole(P, sync([P])).
whole(P, sync([P, P])).

%   It may end, and takes no step.

idle(star(never)).

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

                /*******************************
                *   AGAINST THE AXIOMS         *
                *******************************/

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

:- begin_tests(golog_search).

test(search_takes_the_way_that_ends, H == [b]) :-       % [I] Sigma
    golog_lab:trans(search([ndet(a, b), ?(done(b)), c]), [], _, H),
    !.
test(search_blocks_if_there_is_none, Steps == []) :-
    steps(search([a, never]), Steps).
test(search_follows_its_plan, Runs == [[b, c]]) :-
    runs(search([ndet(a, b), ?(done(b)), c]), Runs).
test(search_is_final_if_its_program_is) :-
    lab_final(search(star(a))).
test(search_has_all_plans, Runs == [[a], [b]]) :-
    runs(search(ndet(a, b)), Runs).
test(search_with_a_message, Runs == [[a]]) :-
    runs(search(a, ["a plan", 1]), Runs).
test(search_with_options, Runs == [[a]]) :-
    runs(search(a, plan, [depth(5)]), Runs).
test(searchn_is_search, Runs == [[a]]) :-
    runs(searchn(a, []), Runs).
test(commit_cuts, Runs == []) :-
    runs(search([ndet(a, b), commit, ?(done(b))]), Runs).
test(a_limit_turns_to_deepening, Run == [up, up]) :-
    once(golog_lab:do(search([star(ndet([?(true), ?(true)], up)),
                              ?(n = 2)], [depth(30)]), H)),
    reverse(H, Run).
test(a_search_through_few_states_ends, Texts-Runs == []-[]) :-
    said(findall(H, golog_switches:do(search([star(any), ?(and(on(1), neg(on(1))))],
                                             [gives_up(steps(20000))]), H), Runs), Texts).
test(a_search_through_few_states_finds_its_plan,
     [forall(member(Depth, [2000, 20])), true(Texts == [])]) :-
    Goal = and([on(1), on(2), on(3), on(4), on(5), on(6)]),
    said(once(golog_switches:do(search(long([star(any), ?(Goal)]),
                                       [depth(Depth), gives_up(steps(20000))]), H)), Texts),
    holds(golog_switches:Goal, H).
test(a_state_is_not_all_where_a_condition_asks_what_was_done,
     [forall(member(Depth, [2000, 20])), true(H == [c, a])]) :-
    once(golog_switches:do(search(long([ndet(b, a), c, ?(done(a))]), [depth(Depth)]), H)).
test(a_search_gives_up_and_others_go_on,
     [ forall(member(Limit, [ steps(50), inferences(20000), seconds(0),
                              seconds(0.01) ])),
       true(Runs-Far == [[a]]-true) ]) :-
    Endless = [star(up), ?(n = 1), star(b), ?(done(never))],
    said(runs(wndet(search(Endless, [gives_up(Limit)]), a), Runs), Texts),
    (   Texts = [Text|_],
        Limit =.. [Name, Most],
        format(atom(Said), 'gave up at its limit of ~w ~w', [Most, Name]),
        sub_atom(Text, _, _, _, Said)
    ->  Far = true
    ;   Far = Texts
    ).
test(its_deepening_gives_up_too, Runs == [[a]]) :-
    runs(wndet(search([star(b), ?(done(never))], [steps(9), gives_up(steps(60))]), a),
         Runs).
test(a_timeout_of_a_search_is_a_limit_too, Runs == [[a]]) :-
    runs(wndet(search([star(b), ?(done(never))], [timeout(0.01)]), a), Runs).
test(a_timeout_of_a_search_counts_what_it_computes, Runs == [[a]]) :-
    runs(search([?(user:nap), ?(user:nap), a], [timeout(0.1)]), Runs).
test(the_limit_around_a_search_ends_it, Runs == [[a]]) :-
    runs(wndet(search(ndet(search([star(b), ?(done(never))]), c),
                      [gives_up(steps(40))]), a), Runs).
test(the_limit_of_a_search_does_not_end_that_around_it, Runs == [[c]]) :-
    runs(search(ndet(search([star(b), ?(done(never))], [gives_up(steps(40))]), c)),
         Runs).
test(a_conditional_plan_gives_up, Runs == [[a]]) :-
    runs(wndet(searchc([star(b), ?(done(never))], [gives_up(steps(40))]), a), Runs).
test(a_limit_must_be_one, [ forall(member(Option, [ gives_up(5), gives_up(_),
                                                    gives_up(steps(-1)),
                                                    gives_up(seconds(a)),
                                                    timeout(soon) ])),
                            error(domain_error(golog_option, Option)) ]) :-
    golog_lab:do(search(a, [Option]), _).
test(deepening_ends_if_all_was_seen, Runs == []) :-
    runs(search([star(a, 4), never], [steps(3)]), Runs).
test(a_plan_broken_by_another_is_made_again, Run == [up, b]) :-
    golog_lab:trans(search([up, if(ringing, b, a)]), [], E, [up]),
    !,
    once(golog_lab:do(E, [ring, up], H)),
    reverse(H, [up, ring|Rest]),
    Run = [up|Rest].
test(a_conditional_plan, Plan == [up, if(ringing, [b], [c])]) :- % [I] searchc
    golog_lab:trans(searchc([up, branch(ringing), if(ringing, b, c)]),
                    [], Plan, []),
    !.
test(a_conditional_plan_keeps_what_it_simulates,
     Plan == [up, sim(ring), b]) :-
    golog_lab:trans(searchc([up, sim(ring), if(ringing, b, c)]), [], Plan,
                    []),
    !.
test(a_search_in_a_search_keeps_what_it_simulates,
     Runs == [[up, sim(ring), b]]) :-
    runs(search([search([up, sim(ring)]), if(ringing, b, c)]), Runs).
test(a_conditional_plan_in_a_search_relies_on_what_it_simulates,
     Runs == [[up, sim(ring), look, a]]) :-
    % As in the delivery of full IndiGolog: search(searchc(..))
    runs(search(searchc([ up, sim(ring), look, branch(at(lab)),
                          if(ringing, a, never) ])), Runs).
test(an_elevator_of_eight_floors_and_six_calls_is_searched_in_time,
     [F-Length, Soon] == [8-16, true]) :-
    % Less than a second on a PC, and no clock is asked.
    elevator(Clauses),
    with_domain(Clauses, M,
                ( statistics(inferences, I0),
                  once(do(M:search(from(0)), H)),
                  statistics(inferences, I1),
                  has_val(M:floor, F, H),
                  length(H, Length) )),
    (   I1-I0 < 6000000
    ->  Soon = true
    ;   Soon is I1-I0
    ).
test(achieve_plans_the_least_steps, Run == [all_off]) :-
    once(golog_lab:do(achieve(neg(some(x, light(x) = on))), H)),
    msort(H, Run).

:- end_tests(golog_search).

:- begin_tests(golog_conditional).

plan_of(Program, Plan) :-
    golog_sensing:trans(searchc(Program), [], Plan, []),
    !.

test(a_plan_branches_where_it_depends_on_what_is_sensed,
     Plan == [look, if(light = red, [a], [if(light = green, [b],
                                             [?(light = off), b])])]) :-
    plan_of([look, if(light = red, a, b)], Plan).
test(a_relational_fluent_has_two_cases, Plan == [feel, if(door, [], [push])]) :-
    plan_of([feel, if(door, [], push)], Plan).
test(without_the_values_it_branches_on_the_condition,
     Plan == [measure, if(distance < 10, [feel], [measure])]) :-
    plan_of([measure, if(distance < 10, feel, measure)], Plan).
test(what_was_assumed_is_not_tested_again,
     Plan == [measure, if(distance < 10, [feel, feel], [])]) :-
    plan_of([ measure, if(distance < 10, feel, []),
              if(distance < 10, feel, []) ], Plan).
test(what_is_sensed_again_is_tested_again,
     Plan == [measure, if(distance < 10, [feel|Rest], Rest)]) :-
    Rest = [measure, if(distance < 10, [feel], [])],
    plan_of([ measure, if(distance < 10, feel, []),
              measure, if(distance < 10, feel, []) ], Plan).
test(no_branch_where_it_makes_no_difference, Plan == [look, go]) :-
    plan_of([look, if(light = red, go, go)], Plan).
test(a_precondition_decides, Plan == [feel, if(door, [feel], [push])]) :-
    plan_of([feel, ndet(push, feel)], Plan).
test(an_effect_decides,
     Plan == [ go, look, measure,
               if(light = red,
                  [if(distance > 20, [a, look], [a, feel])],
                  [if(light = green, [feel], [?(light = off), feel])]) ]) :-
    plan_of([ go, look, measure, if(light = red, a, []),
              if(n = 0, look, feel) ], Plan).
test(branch_takes_a_condition,
     Plan == [look, if(light = red, [a], [if(light = green, [b],
                                             [?(light = off), b])])]) :-
    plan_of([look, branch(light = red), if(light = red, a, b)], Plan).
test(branch_takes_a_condition_about_what_may_change,
     Plan == [if(n = 0, [go], [feel])]) :-
    plan_of([branch(n = 0), if(n = 0, go, feel)], Plan).
test(branch_on_a_conjunction,
     Plan == [if(door, [if(n = 1, [go], [feel])], [feel])]) :-
    plan_of([branch(and(door, n = 1)), if(and(door, n = 1), go, feel)], Plan).
test(a_search_within_it_knows_no_more,
     Plan == [feel, if(door, [], [push])]) :-
    plan_of(search([feel, if(door, [], push)]), Plan).
test(no_plan_if_there_is_none_for_one_answer, fail) :-
    plan_of([look, a], _).
test(what_it_cannot_branch_on_is_refused,
     [ forall(member(P, [ [measure, pi(x, [?(distance = x), go])],
                          [measure, ?(_ is distance+1)] ])),
       error(domain_error(golog_branch, _)) ]) :-
    plan_of(P, _).
test(branch_on_something_quantified_is_refused,
     error(domain_error(golog_branch, some(_, _)))) :-
    plan_of([branch(some(x, n = x)), go], _).
test(branch_on_a_variable_is_refused,
     error(domain_error(golog_branch, n = _))) :-
    plan_of([branch(n = _), go], _).
test(the_refusal_names_the_value_and_the_cure, true(Said == true)) :-
    catch(plan_of([measure, ?(_ is distance+1)], _),
          error(_, context(_, Message)), true),
    (   sub_atom(Message, _, _, _, 'still to be sensed'),
        sub_atom(Message, _, _, _, 'sensed_values/2')
    ->  Said = true
    ;   Said = Message
    ).
test(a_plan_comes_to_its_end_in_each_world,
     [ setup(set_prolog_flag(verbose, silent)),
       cleanup(set_prolog_flag(verbose, normal)),
       true(Wrong-Enough == []-true) ]) :-
    findall(Program-Plan,
            ( case(150, 5000, Seed),
              sensing_program(Seed, Program),
              catch(plan_of([look, Program], Plan),
                    error(domain_error(golog_branch, _), _), fail) ),
            Plans),
    findall(Program-Plan-World-Run-R,
            ( member(Program-Plan, Plans),
              world(World),
              in_world(World, golog_sensing:golog(Plan, [ reason(R),
                                                          history(H) ])),
              reverse(H, Run),
              \+ ( R == final,
                   follows([look, Program], [], Run) ) ),
            Wrong),
    findall(x, ( member(_-Plan, Plans), member(if(_, _, _), Plan) ), Branch),
    length(Branch, Count),
    (   ( Count >= 5 ; \+ all_cases )
    ->  Enough = true
    ;   Enough = Count
    ).

sensing_program(Seed, Program) :-
    random_program(Seed, 3,
                   words([look, feel, measure, a, b, push, go],
                         [ light = red, light = off, door, distance > 20,
                           distance < 10, n > 0, felt, green = light ],
                         [ [program, program], [program, program, program],
                           if(condition, program, program),
                           if(condition, program, []),
                           ndet(program, program), star(program, 2),
                           conc(program, action), atomic([program, action]),
                           search(program),
                           pi(v, [red, off], [?(light = v), program]) ]),
                   Program).

%   Program can run through Run, what it sensed included, to its end.

follows(Program, H, Run) :-
    (   Run == []
    ->  golog_sensing:final(Program, H)
    ;   Run = [e(F, V)|Run1],
        follows(Program, [e(F, V)|H], Run1)
    ;   golog_sensing:trans(Program, H, Program1, H1),
        (   H1 == H
        ->  follows(Program1, H, Run)
        ;   Run = [A|Run1],
            H1 = [A|H],
            follows(Program1, H1, Run1)
        )
    ),
    !.
follows(Program, H, []) :-
    golog_sensing:trans(Program, H, Program1, H),
    follows(Program1, H, []).

:- end_tests(golog_conditional).

:- begin_tests(golog_conditions).

test(and) :-
    true_in(and(n = 0, light(1) = on), []),
    true_in(and([n = 0, light(1) = on, true]), []),
    \+ true_in(and(n = 0, light(2) = on), []).
test(or) :-
    true_in(or(n = 1, light(1) = on), []),
    true_in(or([n = 1, n = 2, n = 0]), []),
    \+ true_in(or([]), []).
test(neg) :-
    true_in(neg(n = 1), []),
    \+ true_in(neg(n = 0), []).
test(impl_and_equiv) :-
    true_in(impl(n = 1, false), []),
    true_in(impl(n = 0, true), []),
    \+ true_in(impl(n = 0, false), []),
    true_in(equiv(n = 1, light(2) = on), []),
    \+ true_in(equiv(n = 0, light(2) = on), []).
test(some) :-
    true_in(some(x, light(x) = off), []),
    true_in(some([x, y], and(light(x) = y, x = 3)), []),
    true_in(some((x, [2, 3]), light(x) = on), []),
    true_in(some(x, [2, 3], light(x) = on), []),
    \+ true_in(some((x, [2]), light(x) = on), []).
test(all) :-
    true_in(all((x, [1, 3]), light(x) = on), []),
    true_in(all(x, [1, 3], light(x) = on), []),
    \+ true_in(all((x, number_of_light), light(x) = on), []).
test(a_closed_condition_holds_once, Answers == [yes]) :-
    answers(yes, some(x, light(x) = on), [], Answers).
test(an_open_condition_has_each_solution, Answers == [1, 3]) :-
    answers(X, light(X) = on, [], Answers).
test(done) :-
    true_in(done(a), [b, a]),
    \+ true_in(done(c), [b, a]),
    true_in(haveExecuted(a), [a]),
    answers(X, done(off(X)), [off(3), off(1)], [1, 3]).
test(know) :-
    true_in(know(n), []),
    \+ true_in(know(weather), []),
    \+ true_in(kwhether(weather), []),
    true_in(kwhether(weather), [e(weather, rain), look]).
test(both_sides_are_evaluated) :-
    true_in(last = last, []),
    true_in(n = n, [up]),
    \+ true_in(last = n, []).
test(comparisons) :-
    true_in(n < 1, []),
    true_in(n+1 =:= 2, [up]),
    true_in(n \= 1, []),
    answers(X, X is n*2+1, [up], [3]).
test(any_goal) :-
    true_in(memberchk(1, list), []),
    answers(X, member(X, list), [], [1, 2]).
test(fluents_in_fluents) :-
    true_in(light(n) = on, [up]),
    \+ true_in(light(n) = on, [up, up]).
test(relational_fluents) :-
    true_in(at(hall), []),
    \+ true_in(at(lab), []),
    true_in(neg(ringing), []),
    answers(P, at(P), [], [hall]).
test(a_condition_of_the_program) :-
    true_in(two, [up, up]),
    \+ true_in(two, [up]),
    answers(X, lit(X), [], [1, 3]).
test(prologs_own_connectives) :-
    true_in((n = 0, \+ n = 1), []),
    true_in((n = 1 ; n = 0), []),
    true_in((n = 0 -> true ; false), []).

:- end_tests(golog_conditions).

:- begin_tests(golog_domain).

test(causes_val, V == 2) :-
    golog_lab:has_val(n, V, [up, down, up, up]).
test(causes_true_and_false) :-
    true_in(at(lab), [go(lab)]),
    \+ true_in(at(hall), [go(lab)]),
    true_in(at(yard), [go(yard), go(lab)]),
    \+ true_in(at(lab), [go(yard), go(lab)]).
test(an_effect_on_all_instances, Answers == []) :-
    answers(X, light(X) = on, [all_off], Answers).
test(an_effect_by_an_equation, [V, W] == [red, white]) :-
    golog_lab:has_val(color(door), V, [paint(door, red)]),
    golog_lab:has_val(color(wall), W, [paint(door, red)]).
test(an_effect_that_nothing_enumerates, [V, W, U] == [clean, red, blue]) :-
    golog_lab:has_val(color(door), V, [wipe, paint(door, red)]),
    golog_lab:has_val(color(wall), W, [wipe, paint(wall, red)]),
    golog_lab:has_val(color(door), U, [paint(door, blue), wipe]).
test(an_effect_under_a_condition_that_changes, Colors == Wanted) :-
    % The condition is that of the moment of the action.
    with_domain([ prim_fluent(color(_)), prim_fluent(at),
                  initially(color(_), white), initially(at, 1),
                  causes_val(wipe, color(X), clean, neg(X = at)),
                  causes_val(soil, color(X), dirty, or(X = 7, neg(X = at))),
                  causes_val(move, at, V, V is at+1) ],
                M,
                findall(H-Cs,
                        ( member(H, [ [wipe], [move, wipe], [wipe, move],
                                      [wipe, move, wipe],
                                      [soil, move, wipe], [wipe, soil],
                                      [wipe, move, soil, wipe] ]),
                          findall(C, ( member(X, [1, 2, 3]),
                                       has_val(M:color(X), C, H) ), Cs) ),
                        Colors)),
    Wanted = [ [wipe]-[white, clean, clean],
               [move, wipe]-[white, clean, clean],
               [wipe, move]-[clean, white, clean],
               [wipe, move, wipe]-[clean, clean, clean],
               [soil, move, wipe]-[dirty, clean, dirty],
               [wipe, soil]-[white, clean, clean],
               [wipe, move, soil, wipe]-[clean, dirty, clean] ].
test(sensing_of_a_fluent, V == rain) :-
    golog_lab:has_val(weather, V, [a, e(weather, rain), look]).
test(sensing_by_the_action, V == rain) :-
    golog_lab:has_val(weather, V, [e(look, rain), look]).
test(sensing_of_several, V-W == rain-rain) :-
    golog_lab:has_val(weather, V, [e(look_twice, rain)]),
    golog_lab:has_val(wind, W, [e(look_twice, rain)]).
test(sensing_by_an_outcome) :-
    true_in(warm, [e(feel, 25), feel]),
    \+ true_in(warm, [e(feel, 15), feel]).
test(forgetting, fail) :-
    golog_lab:has_val(weather, _, [lose, e(weather, rain), look]).
test(a_history_may_be_long, V == 1) :-
    numlist(1, 2000, Numbers),
    findall(A, ( member(N, Numbers), ( N mod 2 =:= 0 -> A = up ; A = down ) ),
            As),
    golog_lab:has_val(n, V0, [up|As]),
    V is V0.
test(eval, Truths == [false]) :-
    findall(T, golog_lab:eval(n = 1, [], T), Truths).
test(sorts, [A, B, C] == [[hall, lab], [left, right], [1]]) :-
    findall(X, golog_lab:domain(X, room), A),
    golog_lab:getdomain(direction, B),
    golog_lab:getdomain([1], C).
test(random_sorts, Sorted == [left, right]) :-
    findall(X, golog_lab:rdomain(X, direction), Xs),
    sort(Xs, Sorted).
test(shuffle, Sorted == [1, 2, 3]) :-
    shuffle([3, 1, 2], Shuffled),
    sort(Shuffled, Sorted).
test(pathfind, Moves == [right, right, up]) :-
    with_domain([ (pathfind_move(X-Y, X1-Y, right) :- X < 3, X1 is X+1),
                  (pathfind_move(X-Y, X-Y1, up) :- X >= 3, Y < 3,
                                                   Y1 is Y+1),
                  (pathfind_heuristic(X-Y, X1-Y1, H) :-
                       H is abs(X1-X)+abs(Y1-Y)) ],
                M, pathfind(M:(1-1), 3-2, Moves)).
test(pathfind_fails_without_a_way, fail) :-
    with_domain([ pathfind_move(1, 2, on), pathfind_heuristic(_, _, 0) ],
                M, pathfind(M:2, 1, _)).
test(pathfind_needs_its_predicates,
     error(existence_error(golog_condition, pathfind_move/3))) :-
    with_domain([], M, pathfind(M:1, 2, _)).
test(get_integer, Ns == [1, 2, 3]) :-
    findall(N, get_integer(1, N, 3), Ns).
test(sensing_action, Fs == [weather, wind]) :-
    findall(F, golog_lab:sensing_action(look_twice, F), Fs).
test(sensing_action_by_outcome, [true(F == warm), nondet]) :-
    golog_lab:sensing_action(feel, F).

:- end_tests(golog_domain).

% What is possible and what is known: Vassos: A feasible approach to disjunctive
% knowledge in situation calculus (2005); Sardina, Vassos: The Wumpus World in
% IndiGolog (2005)

:- begin_tests(golog_possible_values).

known(P, H) :-
    golog_uncertain:holds(P, H).

test(a_fluent_has_each_possible_value, Vs == [1, 2, 3]) :-
    findall(V, golog_uncertain:has_val(place, V, []), Vs).
test(what_holds_for_all_values_is_known) :-
    known(place < 4, []),
    known(neg(place = 7), []),
    known(some(p, [1, 2, 3, 4], place < p), []).
test(what_holds_for_some_values_is_possible, Truths == [unknown, unknown]) :-
    \+ known(place = 1, []),
    \+ known(neg(place = 1), []),
    known(possibly(place = 1), []),
    known(possibly(neg(place = 1)), []),
    \+ known(possibly(place = 7), []),
    findall(T, ( member(P, [place = 1, full(a)]),
                 golog_uncertain:eval(P, [], T) ), Truths).
test(what_is_known_or_known_not_has_a_truth, Truths == [true, false]) :-
    findall(T, ( member(P, [place < 4, place = 7]),
                 golog_uncertain:eval(P, [], T) ), Truths).
test(sensing_settles_a_value) :-
    known(full(b), [e(peek(b), 1), peek(b)]),
    known(neg(full(b)), [e(peek(b), 0), peek(b)]),
    \+ known(full(a), [e(peek(b), 1), peek(b)]).
test(sensing_rejects_values, Vs-Ws == [1, 2]-[3]) :-
    findall(V, golog_uncertain:has_val(place, V, [e(listen, low), listen]), Vs),
    findall(V, golog_uncertain:has_val(place, V, [e(listen, high), listen]),
            Ws),
    known(place = 3, [e(listen, high), listen]).
test(an_effect_of_all_values_moves_them, Vs == [2, 3, 4]) :-
    findall(V, golog_uncertain:has_val(place, V, [step]), Vs).
test(an_effect_that_is_only_possible_keeps_the_value, Truths ==
     [unknown, false]) :-
    H = [sweep, e(peek(a), 1), peek(a)],
    findall(T, ( member(H1, [H, [sweep, e(peek(a), 0), peek(a)]]),
                 golog_uncertain:eval(full(a), H1, T) ), Truths).
test(a_known_effect_sets_the_value) :-
    known(neg(full(c)), [sweep, e(listen, high), listen]).
test(what_is_set_is_known) :-
    known(full(a), [set(full(a))]),
    known(neg(full(a)), [unset(full(a))]).
test(what_is_simulated_has_the_effects_of_the_action, Vs == [2, 3, 4]) :-
    findall(V, golog_uncertain:has_val(place, V, [sim(step)]), Vs).
test(what_is_settled_is_not_rejected, Vs == [2]) :-
    with_domain([ prim_action(a), poss(a, true), prim_fluent(f),
                  initially(f, 1), initially(f, 2), initially(f, 3),
                  settles(a, 1, f, 2, true), rejects(a, 1, f, 1, true) ], M,
                findall(V, has_val(M:f, V, [e(a, 1), a]), Vs)).
test(know_is_about_one_value) :-
    \+ known(know(place), []),
    known(neg(know(place)), []),
    known(know(place), [e(listen, high), listen]),
    known(know(full(a)), [e(peek(a), 0), peek(a)]),
    \+ known(kwhether(place = 1), []),
    known(kwhether(place = 1), [e(listen, high), listen]).
test(variables_get_what_is_known, Bs == [b]) :-
    findall(B, known(full(B), [e(peek(b), 1), peek(b)]), Bs).
test(variables_get_what_is_possible, Bs == [a, b, c]) :-
    findall(B, known(possibly(full(B)), [e(peek(b), 1), peek(b)]), Bs0),
    sort(Bs0, Bs).
test(an_action_needs_a_known_precondition, Hs == [[fill(c)|H]]) :-
    H = [e(peek(c), 0), peek(c)],
    findall(H1, golog_uncertain:do(ndet(fill(a), fill(c)), H, H1), Hs).
test(an_argument_of_an_action_must_be_known, H == [fill(a)|H0]) :-
    H0 = [e(peek(a), 0), peek(a)],
    with_domain([ prim_action(go(X)), poss(go(X), true), prim_fluent(at),
                  initially(at, 1), initially(at, 2) ], M,
                \+ do(M:go(at), _)),
    golog_uncertain:do(fill(a), H0, H).
test(a_program_does_the_else_of_what_it_does_not_know, H == [turn]) :-
    golog_uncertain:do(if(full(a), fill(a), turn), H).
test(a_run_senses_and_knows,
     H == [fill(b), e(peek(b), 0), peek(b), e(peek(a), 1), peek(a)]) :-
    setup_call_cleanup(
        assertz(golog_uncertain:real(w(1, [a, c], false)), Ref),
        golog_uncertain:golog(for(x, [a, b],
                                  [peek(x), if(neg(full(x)), fill(x), [])]),
                              [history(H)]),
        erase(Ref)).
test(a_contradiction_is_told,
     [error(domain_error(golog_sensing, e(listen, low)))]) :-
    known(up, [e(listen, low), listen, e(listen, high), listen]).
test(a_plan_with_branches_is_refused,
     [error(permission_error(search, golog_domain, _))]) :-
    golog_uncertain:trans(searchc(turn), [], _, _).
test(why_not_shows_the_possible_values, Why ==
     not_possible([failure(neg(full(c)), [full(c) = false, full(c) = true])])) :-
    golog_uncertain:why_not(fill(c), not_possible([failure(P, Values, _)])),
    Why = not_possible([failure(P, Values)]).
test(it_tells_which_fluents_are_sensed, Fs == [full(a), place]) :-
    findall(F, ( member(A, [peek(a), listen]),
                 once(golog_uncertain:sensing_action(A, F)) ), Fs).
test(a_search_relies_on_what_is_known, Hs == [[fill(c)|H]]) :-
    H = [e(peek(c), 0), peek(c)],
    findall(H1, golog_uncertain:do(search([ ndet(fill(a), fill(c)),
                                            ?(full(c)) ]), H, H1), Hs).
test(an_action_that_forgets_makes_all_values_possible, Truths ==
     [true, unknown]) :-
    with_domain([ prim_action(a), poss(a, true), rel_fluent(f(1)),
                  initially(f(1), true), initially(f(1), false),
                  settles(a, 1, f(_), true, true), forget(a, f(_)) ], M,
                findall(T, ( member(H, [[e(a, 1), a], [a, e(a, 1), a]]),
                             eval(M:f(1), H, T) ), Truths)).
test(what_is_settled_must_be_declared, [error(instantiation_error)]) :-
    with_domain([ prim_action(a), poss(a, true), rel_fluent(f(_)),
                  settles(a, 1, f(_), true, true) ], M,
                holds(M:f(1), [e(a, 1), a])).
test(achieve_plans_with_what_is_known, H == [fill(c)|H0]) :-
    H0 = [e(peek(c), 0), peek(c)],
    once(golog_uncertain:do(achieve(full(c)), H0, H)).
test(which_fluents_change_must_be_declared, [error(instantiation_error)]) :-
    with_domain([ prim_action(a), poss(a, true), rel_fluent(f(_)),
                  initially(f(1), true), initially(f(1), false),
                  causes_true(a, f(_), true) ], M, do(M:a, _)).

%   No condition has a fluent twice: then the answer is that of all worlds.

test(conditions_hold_as_in_all_worlds,
     [ forall(member(P, [ and(full(a), place < 3), or(full(a), neg(up)),
                          neg(or(full(a), place = 2)),
                          impl(full(a), place < 4), impl(place = 9, up),
                          equiv(full(b), full(c)), neg(equiv(up, place = 9)),
                          equiv(up, place = 9), (up -> full(a) ; place < 4),
                          (full(a) -> up ; place = 1), sure(a), neg(sure(b)),
                          some(x, [a, b, c], full(x)), near(place, b),
                          all(x, [a, b, c], full(x)), full(c) = false ])),
       true(Found == Wanted) ]) :-
    findall(T, ( possible_world(W), ( is_so(P, W) -> T = true ; T = false ) ), Ts0),
    sort(Ts0, Ts),
    (   Ts = [Wanted]
    ->  true
    ;   Wanted = unknown
    ),
    once(golog_uncertain:eval(P, [], Found)).

%   What is known is so, and what is so is possible, in random worlds.

test(nothing_false_is_ever_known, Wrong == []) :-
    findall(wrong(Seed, P, H, W),
            ( case(300, 5000, Seed),
              random_run(Seed, H, W),
              between(1, 4, I),
              Seed1 is 10*Seed+I,
              uncertain_condition(Seed1, P),
              wrongly_known(P, H, W) ),
            Wrong).

wrongly_known(P, H, W) :-
    (   is_so(P, W)
    ->  \+ known(possibly(P), H)
    ;   known(P, H)
    ).

random_run(Seed, H, W) :-
    set_random(seed(Seed)),
    findall(World, possible_world(World), Worlds),
    random_member(W0, Worlds),
    random_between(0, 6, Length),
    length(Places, Length),
    acted(Places, [], H, W0, W).

acted([], H, H, W, W).
acted([_|Places], H0, H, W0, W) :-
    random_member(A, [ step, sweep, turn, listen, peek(a), peek(b), peek(c),
                       fill(a), fill(b) ]),
    world_after(A, W0, W1),
    (   outcome(A, W0, Value)
    ->  H1 = [e(A, Value), A|H0]
    ;   H1 = [A|H0]
    ),
    acted(Places, H1, H, W1, W).

uncertain_condition(Seed, P) :-
    random_program(Seed, 1,
                   words([turn],
                         [ full(a), full(b), full(c), up, place = 1, place = 2,
                           place < 3, place < 5, near(place, b), sure(a),
                           full(c) = false, some(x, [a, b, c], full(x)),
                           all(x, [a, b, c], full(x)), impl(full(a), up),
                           equiv(full(b), full(c)),
                           (full(a) -> up ; place < 2) ],
                         [?(condition)]),
                   ?(P)).

:- end_tests(golog_possible_values).

%   From floor 4 to calls on six of eight floors, by depth first search with a
%   growing number of moves

elevator([ prim_action(up), prim_action(down), prim_action(serve(_)),
           poss(up, floor < 8), poss(down, floor > 1),
           poss(serve(N), and(floor = N, called(N) = yes)),
           prim_fluent(floor),
           (prim_fluent(called(F)) :- between(1, 8, F)),
           initially(floor, 4),
           (initially(called(C), yes) :- member(C, [1, 2, 3, 5, 6, 8])),
           initially(called(_), no),
           causes_val(up, floor, A, A is floor+1),
           causes_val(down, floor, B, B is floor-1),
           causes_val(serve(D), called(D), no, true),
           proc(go_to(G), while(neg(floor = G), if(floor < G, up, down))),
           proc(within(Max),
                ndet(?(neg(some(n, called(n) = yes))),
                     pi([n, m], [ ?(called(n) = yes),
                                  ?(m is Max-abs(floor-n)), ?(m >= 0),
                                  go_to(n), serve(n), within(m) ]))),
           proc(from(Least), ndet(within(Least),
                                  pi(k, [?(k is Least+1), from(k)]))) ]).

                /*******************************
                *            ONLINE            *
                *******************************/

%   A module with the domain Text, a list of clauses as terms; it is gone
%   after Goal.

:- dynamic used/1.

with_domain(Clauses, Module, Goal) :-
    flag(golog_test, N, N+1),
    atom_concat(golog_test_, N, Module),
    add_import_module(Module, user, start),
    forall(member(Clause, Clauses), assertz(Module:Clause)),
    call(Goal).

%   Run Program of the lab; H is its history, oldest first.

online(Program, Options, Run) :-
    golog_lab:executed(_),
    retractall(golog_lab:next_exog(_)),
    golog_lab:golog(Program, [history(H)|Options]),
    reverse(H, Run).

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

%   Call Goal; Texts are what it prints by print_message/2.

:- dynamic said_text/1.

said(Goal, Texts) :-
    retractall(said_text(_)),
    setup_call_cleanup(
        asserta((user:thread_message_hook(Term, _, Lines) :-
                     plunit_keep(Term, Lines)), Ref),
        call(Goal),
        erase(Ref)),
    findall(Text, retract(said_text(Text)), Texts).

said_of_all(Goal, Kinds) :-
    retractall(said_text(_)),
    setup_call_cleanup(
        asserta((user:message_hook(_, Kind, _) :-
                     memberchk(Kind, [warning, error]),
                     assertz(said_text(Kind))), Ref),
        call(Goal),
        erase(Ref)),
    findall(Kind, retract(said_text(Kind)), Kinds).

user:plunit_keep(golog(_), Lines) :-
    keep_lines(Lines).

user:keep_lines(Lines) :-
    with_output_to(atom(Text), print_message_lines(current_output, '', Lines)),
    assertz(said_text(Text)).

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
                    [timeout(0.1), reason(R), history(H)]).
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

user:nap :-
    sleep(0.2).

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

:- end_tests(golog_why_not).

user:asks_why_not(A, E) :-
    (   E == action(a)
    ->  golog_lab:why_not(A, Why),
        nb_setval(golog_seen, Why)
    ;   true
    ).

:- op(500, xfy, #).
:- op(700, xfy, &).

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
                     [ (a # b)-'ndet(P, Q) for P#Q',
                       a()-'one writes a, without ()',
                       [a, (a : b)]-'[P, Q] for P:Q',
                       ?((n = 0) & (n = 0))-'and(P, Q) for P & Q',
                       if(n = 0, b)-'if(C, P, [])',
                       ?(-(n = 1))-'neg(P) for -P',
                       ?(v(n = 0, n = 1))-'or(P, Q) for P v Q' ])),
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
     true(Found == true)) :-
    with_domain([prim_action(a), (poss(a, _) :- true)], M,
                catch(do(M:a, _),
                      error(instantiation_error, context(_, Message)), true)),
    (   sub_atom(Message, _, _, _, 'not a situation')
    ->  Found = true
    ;   Found = Message
    ).
test(a_sequence_with_a_colon_has_a_hint, true(Found == true)) :-
    catch(do(golog_test_none:b, _), error(_, context(_, Message)), true),
    (   sub_atom(Message, _, _, _, '[P, Q], not P:Q')
    ->  Found = true
    ;   Found = Message
    ).
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
    module_property(golog_lab, file(File)),
    (   sub_atom(Message, 0, _, _, File),
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
    said(catch(ignore(do(golog_wrong_file:Program, _)), E, true), Said),
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
").

wrong([b, a(1)], 3, 'prim_action(a/1)').
wrong(?(f = 1), 4, 'prim_fluent(f)').
wrong(round, 7, 'proc(round)').
wrong(go_on, 8, 'proc(go_on)').
wrong(wait_for_rain, 9, 'proc(wait_for_rain)').

:- end_tests(golog_wrong).

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

                /*******************************
                *           THE ROBOT          *
                *******************************/

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
                    assertz((M:robot_exog(none, fail) :-
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
                                   [history(H), timeout(9)]) )) ),
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
    retractall(user:said_text(_)),
    setup_call_cleanup(
        asserta((user:thread_message_hook(_, help, Lines) :-
                     user:keep_lines(Lines)), Ref),
        why(What),
        erase(Ref)),
    retract(user:said_text(Text)),
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
