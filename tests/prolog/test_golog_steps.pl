% Several agents that act at the same time: agent/1, together/2, excludes/2,
% always/1 and derived/2, achieve/2 with concurrent(true), and steps on several
% robots.

:- use_module('../support/simulation').
:- use_module('../support/cases').
:- use_module(library(ev3dev/bricks)).
:- use_module(library(ev3dev/golog)).
:- use_module(library(ev3dev/gripper)).
:- use_module('../support/golog/payload').
:- use_module('../support/golog/runs').
:- use_module(library(plunit)).

%   planned(+Problem, +Options, -Steps, -Seconds) is semidet. Seconds are those
%   of a processor.

planned(Problem, Options, Steps, Seconds) :-
    payload(Problem, Clauses),
    goal_of(Problem, Goal),
    with_domain(Clauses, M,
                ( statistics(cputime, T0),
                  once(do(M:achieve(Goal, [concurrent(true)|Options]), H)),
                  statistics(cputime, T1) )),
    Seconds is T1-T0,
    reverse(H, Steps).

one_load(payload(5-5, [3-3], [a-(1-1), b-(4-1)],
                 [load(l, 1-4, 4-1, r, 2-4, 5-1)])).
two_loads(payload(7-6, [4-1, 4-2], [a-(1-1), b-(7-1)],
                  [ load(l, 1-3, 5-1, r, 2-3, 6-1),
                    load(m, 6-6, 1-1, n, 7-6, 2-1) ])).

%   unsolvable(?Name, -Problem): a gap of one cell, through which a load of two
%   does not go; one robot alone; a goal where one end is in a wall

unsolvable(gap, payload(5-5, [1-3, 2-3, 4-3, 5-3], [a-(1-1), b-(5-1)],
                        [load(l, 2-2, 4-5, r, 3-2, 5-5)])).
unsolvable(alone, payload(5-5, [], [a-(1-1)],
                          [load(l, 2-2, 4-5, r, 3-2, 5-5)])).
unsolvable(wall, payload(5-5, [5-5], [a-(1-1), b-(5-1)],
                         [load(l, 2-2, 4-5, r, 3-2, 5-5)])).

%   in_turn(+Steps, -Variant) is nondet: Variant has the actions of one step, of
%   which none is possible alone, one after the other.

in_turn(Steps, Variant) :-
    append(Before, [Step|After], Steps),
    Step = [_, _|_],
    \+ memberchk(move(_, _, _), Step),
    permutation(Step, Actions),
    findall([A], member(A, Actions), Singles),
    append([Before, Singles, After], Variant).

random_problem(Seed, payload(3-3, Walls, [a-A, b-B], [load(l, L, L1, r, R, R1)])) :-
    set_random(seed(Seed)),
    findall(X-Y, ( between(1, 3, X), between(1, 3, Y) ), Cells0),
    random_permutation(Cells0, [A, B, Wall|_]),
    ( Seed mod 3 =:= 0 -> Walls = [] ; Walls = [Wall] ),
    random_permutation([east, north], [Direction|_]),
    findall(C-D, ( member(C, Cells0), neighbor(Direction, C, D),
                   memberchk(D, Cells0) ), Places0),
    random_permutation(Places0, [L-R, L1-R1|_]).

neighbor(east, X-Y, X1-Y) :- X1 is X+1.
neighbor(north, X-Y, X-Y1) :- Y1 is Y+1.

:- begin_tests(golog_steps_plans).
test(a_load_with_two_ends_takes_13_steps, Length == 13) :-
    one_load(Problem),
    planned(Problem, [], Steps, Seconds),
    length(Steps, Length),
    is_plan(Problem, Steps),
    Seconds < 5.
test(two_loads_take_32_steps, Length == 32) :-
    two_loads(Problem),
    planned(Problem, [], Steps, Seconds),
    length(Steps, Length),
    is_plan(Problem, Steps),
    Seconds < 5.
test(nobody_moves_in_vain, Count == 24) :-
    % Three and five moves to the ends, six to the goal, by both
    one_load(Problem),
    planned(Problem, [], Steps, _),
    append(Steps, Actions),
    length(Actions, Count).
test(any_plan_is_one_too, [forall(member(Problem, [one_load, two_loads]))]) :-
    call(Problem, P),
    planned(P, [shortest(false)], Steps, Seconds),
    is_plan(P, Steps),
    Seconds < 5.
test(no_plan_can_be_serialized,
     [forall(member(Problem, [one_load, two_loads])), true(Wrong-Enough == []-true)]) :-
    call(Problem, P),
    planned(P, [], Steps, _),
    findall(Variant, in_turn(Steps, Variant), Variants),
    findall([A], ( member(Step, Steps), member(A, Step) ), All),
    findall(Variant, ( member(Variant, [All|Variants]), is_plan(P, Variant) ),
            Wrong),
    length(Variants, Count),
    ( Count >= 16 -> Enough = true ; Enough = Count ).
test(the_library_refuses_what_the_checker_refuses, Wrong == []) :-
    one_load(P),
    planned(P, [], Steps, _),
    payload(P, Clauses),
    with_domain(Clauses, M,
                findall(Variant,
                        ( in_turn(Steps, Variant),
                          findall(together(Step), member(Step, Variant), Program),
                          once(do(M:Program, _)) ),
                        Wrong)),
    findall(together(Step), member(Step, Steps), Program),
    once(do(M:Program, _)).
test(without_a_plan_it_ends, [forall(unsolvable(_, Problem)), true(Plans == [])]) :-
    findall(Steps, planned(Problem, [], Steps, _), Plans).
test(without_a_plan_it_ends_in_time,
     [forall(unsolvable(_, Problem)), true(Seconds < 5)]) :-
    statistics(cputime, T0),
    \+ planned(Problem, [shortest(false)], _, _),
    statistics(cputime, T1),
    Seconds is T1-T0.
test(the_reason_why_there_is_no_plan,
     [ forall(unsolvable(Name, Problem)),
       true(Name-Texts == Name-['There is no plan for place(r)=5-5']) ]) :-
    payload(Problem, Clauses),
    goal_of(Problem, Goal),
    with_domain(Clauses, M,
                texts(why_not(M:achieve(Goal, [concurrent(true)])), Texts)).
%   Blind search through all states knows as many steps.
test(a_plan_has_the_fewest_steps,
     [forall(case(40, Seed)), true(Found == Fewest)]) :-
    random_problem(Seed, Problem),
    ( fewest_steps(Problem, Fewest) -> true ; Fewest = none ),
    (   planned(Problem, [], Steps, _)
    ->  is_plan(Problem, Steps),
        length(Steps, Found)
    ;   Found = none
    ).
%   A clause of forget/2 keeps the native planner away.
test(the_interpreter_knows_as_many_steps,
     [forall(case(6, Seed)), true(Found == Fewest)]) :-
    random_problem(Seed, Problem),
    ( fewest_steps(Problem, Fewest) -> true ; Fewest = none ),
    payload(Problem, Clauses),
    goal_of(Problem, Goal),
    (   with_domain([(forget(_, _) :- fail)|Clauses], M,
                    once(do(M:achieve(Goal, [concurrent(true)]), H)))
    ->  reverse(H, Steps),
        is_plan(Problem, Steps),
        length(Steps, Found)
    ;   Found = none
    ).
test(where_values_have_no_end_steps_are_searched_by_the_interpreter,
     Steps == [[climb(a)], [climb(a), rest(b)]]) :-
    with_domain([ agent(a), agent(b), prim_action(climb(a)), prim_action(rest(b)),
                  prim_fluent(height), initially(height, 0), rel_fluent(rested),
                  initially(rested, false), poss(climb(a), true),
                  poss(rest(b), height > 0), causes_true(rest(b), rested, true),
                  causes_val(climb(a), height, H, H is height+1)
                ], M,
                once(do(M:achieve(and(height = 2, rested), [concurrent(true)]),
                        History))),
    reverse(History, Steps).
test(a_derived_fluent_and_rules_without_agents_count_for_single_actions, H == [right]) :-
    with_domain([ prim_action(left), prim_action(right), poss(_, true),
                  prim_fluent(at), initially(at, 0), causes_val(left, at, -1, true),
                  causes_val(right, at, 1, true), derived(away, neg(at = 0)),
                  always(at >= 0) ], M,
                ( once(do(M:achieve(away), H)),
                  \+ do(M:left, _) )).
test(a_derived_fluent_asks_for_the_values_of_others, Actions == [[step(a)], [step(a)]]) :-
    with_domain([ agent(a), agent(b), prim_action(step(a)), prim_action(step(b)),
                  prim_fluent(at(a)), prim_fluent(at(b)), initially(at(a), 1),
                  initially(at(b), 3), poss(step(R), at(R) < 4),
                  causes_val(step(R), at(R), N, N is at(R)+1),
                  (derived(top(N), neg(low(N))) :- between(1, 4, N)),
                  (derived(low(N), at(_) > N) :- between(1, 4, N)),
                  always(at(b) = 3) ], M,
                ( holds(M:top(at(b)), []), \+ holds(M:top(at(a)), []),
                  once(do(M:achieve(top(at(a)), [concurrent(true)]), H)) )),
    reverse(H, Actions).
test(costs_are_not_counted_at_the_same_time,
     error(domain_error(golog_option, [concurrent(true), cheapest(true)]))) :-
    with_domain([ agent(a), prim_action(nod(a)), poss(nod(a), true),
                  rel_fluent(nodded), initially(nodded, false) ], M,
                do(M:achieve(nodded, [concurrent(true), cheapest(true)]), _)).
test(who_acts_must_be_known, error(domain_error(golog_option, concurrent(true)))) :-
    with_domain([ prim_action(nod), poss(nod, true), rel_fluent(nodded),
                  initially(nodded, false) ], M,
                do(M:achieve(nodded, [concurrent(true)]), _)).
test(a_word_that_is_none, error(domain_error(golog_option, [concurrent(maybe)]))) :-
    with_domain([ agent(a), prim_action(nod(a)), poss(nod(a), true),
                  rel_fluent(nodded), initially(nodded, false) ], M,
                do(M:achieve(nodded, [concurrent(maybe)]), _)).
:- end_tests(golog_steps_plans).

%   Two agents lift a table; a third one may sing.
table([ agent(a), agent(b), agent(c),
        prim_action(lift(a)), prim_action(lift(b)), prim_action(lower(b)),
        prim_action(count(a)), prim_action(count(b)), prim_action(sing(c)),
        prim_action(shout(c)), prim_action(bell), prim_action(look(c)),
        agent_of(shout(c), b),
        rel_fluent(up(a)), rel_fluent(up(b)), rel_fluent(seen), prim_fluent(n),
        initially(up(_), false), initially(n, 0),
        poss(lift(R), neg(up(R))), poss(lower(R), up(R)), poss(count(_), true),
        poss(sing(_), true), poss(shout(_), true), poss(bell, true),
        poss(look(_), true), senses(look(c), seen),
        causes_true(lift(R), up(R), true), causes_false(lower(R), up(R), true),
        causes_val(count(a), n, 1, true), causes_val(count(b), n, 2, true),
        together(lift(a), lift(b)), together(lift(b), lift(_)),
        excludes(lift(_), sing(_)),
        derived(level, equiv(up(a), up(b))),
        derived(aslant, neg(level)),
        always(neg(aslant)) ]).

with_table(M, Goal) :-
    table(Clauses),
    with_domain(Clauses, M, once(Goal)).

%   What Golog says, without the end of the line

texts(Goal, Texts) :-
    said(Goal, Texts0),
    findall(Text,
            ( member(Text0, Texts0),
              split_string(Text0, "", "\n", [Text1]),
              atom_string(Text, Text1) ),
            Texts).

:- meta_predicate texts(0, -).

:- begin_tests(golog_steps).
test(a_step_is_a_list_in_the_history, H == [[lift(a), lift(b)]]) :-
    with_table(M, once(do(M:together([lift(b), lift(a)]), H))).
test(the_same_action_twice_is_one, H == [[sing(c)]]) :-
    with_table(M, once(do(M:together([sing(c), sing(c)]), H))).
test(nothing_is_no_step) :-
    with_table(M, \+ do(M:together([]), _)).
test(a_given_step_has_any_order) :-
    with_table(M, ( do(M:together([lift(a), lift(b)]), [[lift(b), lift(a)]]),
                    holds(M:and(up(a), up(b)), [[lift(b), lift(a)]]) )).
test(each_action_of_a_step_is_done) :-
    with_table(M, ( holds(M:done(lift(a)), [[lift(b), lift(a)]]),
                    holds(M:done([lift(a), lift(b)]), [[lift(b), lift(a)]]),
                    \+ holds(M:done(sing(c)), [[lift(b), lift(a)]]) )).
test(effects_are_those_before_the_step, X-Y == 1-2) :-
    with_domain([ agent(a), agent(b), prim_action(copy(a)), prim_action(copy(b)),
                  prim_fluent(x), prim_fluent(y), initially(x, 2), initially(y, 1),
                  poss(copy(_), true), causes_val(copy(a), x, V, V = y),
                  causes_val(copy(b), y, V, V = x) ], M,
                ( once(do(M:together([copy(a), copy(b)]), H)),
                  has_val(M:x, X, H), has_val(M:y, Y, H) )).
test(what_is_known_of_possible_values, Values-Others == [2, 3]-[1]) :-
    with_domain([ agent(a), agent(b), prim_action(go(a)), prim_action(go(b)),
                  prim_fluent(x), prim_fluent(y), initially(x, 1), initially(x, 2),
                  initially(y, 2), poss(go(_), true),
                  causes(go(a), x, V, V is x+1), causes_val(go(b), y, 1, true) ], M,
                ( once(do(M:together([go(a), go(b)]), H)),
                  findall(V, has_val(M:x, V, H), Values),
                  findall(V, has_val(M:y, V, H), Others) )).
test(an_action_that_needs_another_is_not_possible_alone, Why == together(lift(a), lift(b))) :-
    with_table(M, golog(M:lift(a), [reason(not_possible(lift(a), Why))])).
test(each_needs_another,
     [ forall(member(Program, [ lift(a), lift(b), together([lift(a)]),
                                conc(lift(a), lift(b)), together([lift(b), bell]),
                                search(conc(lift(a), lift(b))) ])),
       fail ]) :-
    with_table(M, do(M:Program, _)).
test(variables_of_a_program_stand_in_its_steps, Rs == [b]) :-
    with_table(M, findall(R, do(M:pi(r, together([lift(a), lift(r)])),
                                [[lift(a), lift(R)]]), Rs)).
test(a_domain_may_have_an_action_of_that_name, H == [together([x])]) :-
    with_domain([prim_action(together(_)), poss(_, true)], M,
                once(do(M:together([x]), H))).
test(no_plan_of_single_actions, fail) :-
    with_table(M, do(M:achieve(up(a)), _)).
test(a_plan_of_steps, H == [[lift(a), lift(b)]]) :-
    with_table(M, once(do(M:achieve(up(a), [concurrent(true)]), H))).

why(Step, Why) :-
    with_table(M, why_not(M:Step, Why)).

test(why_not_together, Why == not_a_step(together(lift(a), lift(b)), [])) :-
    why([lift(a)], Why).
test(why_not_one_at_a_time,
     Why == not_a_step(one_at_a_time(b, lift(b), shout(c)), [])) :-
    why([shout(c), lift(a), lift(b)], Why).
test(why_not_excluded, Why == not_a_step(excludes(lift(a), sing(c)), [])) :-
    why([lift(a), lift(b), sing(c)], Why).
test(why_not_without_an_agent, Why == not_a_step(agent_of(bell), [])) :-
    why([bell, sing(c)], Why).
test(why_not_sensing, Why == not_a_step(senses(look(c)), [])) :-
    why([look(c), count(a)], Why).
test(why_not_two_values, Why == not_a_step(one_value(n, count(a), count(b)), [])) :-
    why([count(a), count(b)], Why).
test(why_not_a_part, Why == part(lower(b), not_possible([failure(up(b), [up(b) = false], none)]))) :-
    why([count(a), lower(b)], Why).
test(why_not_an_action_that_is_none, Why == part(fly(a), no_action)) :-
    why([fly(a), sing(c)], Why).
test(why_not_always, Condition-Values == neg(aslant)-[up(a) = true, up(b) = false]) :-
    table(Clauses0),
    exclude(==(together(lift(a), lift(b))), Clauses0, Clauses),
    with_domain(Clauses, M, once(
                ( why_not(M:lift(a), not_a_step(always(Condition), Values)),
                  why_not(M:[lift(a)], not_a_step(always(Condition), Values)) ))).
test(nothing_stands_in_its_way, fail) :-
    why([lift(a), lift(b)], _).
test(the_reasons_in_words, [forall(words(Step, Text)), true(Texts == [Text])]) :-
    with_table(M, texts(why_not(M:Step), Texts)).

words(lift(a), 'the action lift(a) is not possible: lift(a) needs lift(b) in the same step').
words([lift(b)], 'the step [lift(b)] is not possible: lift(b) needs lift(A) in the same step').
words([shout(c), count(b)], 'the step [shout(c),count(b)] is not possible: count(b) and shout(c) are both actions of b, which does one at a time').
words([lift(a), lift(b), sing(c)], 'the step [lift(a),lift(b),sing(c)] is not possible: lift(a) excludes sing(c)').
words([bell, sing(c)], 'the step [bell,sing(c)] is not possible: bell belongs to no agent, so it is a step by itself').
words([look(c), count(a)], 'the step [look(c),count(a)] is not possible: look(c) senses, so it is a step by itself').
words([count(a), count(b)], 'the step [count(a),count(b)] is not possible: count(a) and count(b) would give n two values').
words([lower(b), sing(c)], 'lower(b) is not possible: up(b) does not hold').
words([fly(a), sing(c)], 'fly(a) is no action of the domain. There are: bell/0, count/1, lift/1, look/1, lower/1, shout/1, sing/1').
words([lift(a), lift(b)], '[lift(a),lift(b)] comes next: nothing stands in its way').

test(a_run_says_it_in_words,
     Texts == ['prim_action(count/1): the step [count(a),count(b)] is not possible: count(a) and count(b) would give n two values']) :-
    with_table(M, texts(\+ golog(M:together([count(a), count(b)]), []), Texts)).
test(a_step_without_robots_is_executed_in_turn, Done-H == [lift(a), lift(b)]-[[lift(a), lift(b)]]) :-
    table(Clauses),
    retractall(executed(_)),
    with_domain([(execute(A, _) :- plunit_golog_steps:assertz(executed(A)))|Clauses], M,
                once(golog(M:achieve(up(a), [concurrent(true)]), [history(H)]))),
    findall(A, retract(executed(A)), Done).
:- dynamic executed/1.
test(a_step_that_fails_enters_the_history_and_it_plans_again,
     H == [[lift(a), lift(b)], failed([lift(a), lift(b)])]) :-
    table(Clauses),
    retractall(executed(_)),
    with_domain([( execute(A, _) :- plunit_golog_steps:once_failed(A) )|Clauses], M,
                once(golog(M:achieve(up(a), [concurrent(true)]), [history(H)]))).

once_failed(A) :-
    (   executed(A)
    ->  true
    ;   assertz(executed(A)),
        A \== lift(a)
    ).

test(an_interrupted_step_has_effects_too) :-
    table(Clauses),
    with_domain([ rel_fluent(lost), initially(lost, false),
                  causes_true(interrupted([A, _]), lost, A == lift(a))|Clauses ], M,
                once(holds(M:lost, [interrupted([lift(b), lift(a)])]))).
test(a_failed_step_has_effects, H == [[lift(a), lift(b)], failed([lift(a), lift(b)])]) :-
    table(Clauses),
    with_domain([ rel_fluent(lost), initially(lost, false),
                  causes_true(failed(Step), lost, member(lift(_), Step))|Clauses ], M,
                once(( holds(M:lost, [failed([lift(b), lift(a)])]),
                       do(M:together([lift(b), lift(a)]), [failed([lift(b), lift(a)])], H) ))).
:- end_tests(golog_steps).

wrong(Clauses, Formal, Text) :-
    catch(with_domain([rel_fluent(up), prim_action(nod(a)), prim_fluent(at(a))|Clauses],
                      M, holds(M:true, [])),
          error(Formal, Context), true),
    nonvar(Formal),
    message_to_codes(Formal, Context, Text).

message_to_codes(Formal, Context, Text) :-
    '$messages':translate_message(error(Formal, Context), Lines, []),
    with_output_to(string(Text0), print_message_lines(current_output, '', Lines)),
    split_string(Text0, "", " \n", [Text]).

mistake([agent(_)], instantiation_error, "agent/1: an agent is an atom").
mistake([agent(3)], type_error(atom, 3), "agent/1: an agent is an atom").
mistake([(agent(X) :- member(X, [a, r(1)]))], type_error(atom, r(1)), "an agent is an atom").
mistake([together(nod(a), nod(b))], existence_error(golog_agent, _), "together/2: the domain has no agents: agent(Name) declares one").
mistake([excludes(nod(a), nod(b))], existence_error(golog_agent, _), "excludes/2: the domain has no agents").
mistake([robot_action(a, nod(a), true)], existence_error(golog_agent, _), "robot_action/3: the domain has no agents").
mistake([agent_of(nod(a), a)], existence_error(golog_agent, _), "agent_of/2: the domain has no agents").
mistake([agent(a), agent_of(nod(a), b)], existence_error(golog_agent, b), "agent_of/2: there is no agent b").
mistake([agent(a), agent_of(sing, a)], existence_error(golog_action, sing/0), "agent_of/2: there is no action sing/0; prim_action/1 declares one").
mistake([agent(a), robot_action(b, nod(_), true)], existence_error(golog_agent, b), "robot_action/3: there is no agent b").
mistake([agent(a), robot_action(_, nodd(_), true)], existence_error(golog_action, nodd/1), "robot_action/3: there is no action nodd/1").
mistake([agent(a), together(nod(a), fly(a))], existence_error(golog_action, fly/1), "together/2: there is no action fly/1").
mistake([agent(a), together(7, nod(a))], type_error(callable, 7), "together/2: 7 is no action").
mistake([agent(a), excludes(fly(a), nod(a))], existence_error(golog_action, fly/1), "excludes/2: there is no action fly/1").
mistake([agent(a), prim_action(sit(a)), together(nod(a), sit(a))], domain_error(golog_step, [nod(a), sit(a)]), "together/2: both are actions of a, and an agent does one action in a step").
mistake([always(_)], instantiation_error, "always/1: the condition is still a variable").
mistake([always(7)], type_error(callable, 7), "always/1: the condition is still a variable, or a number").
mistake([always(neg(att(a) = 3))], domain_error(golog_condition, neg(att(a) = 3)), "always/1: the condition names no fluent, so no step changes it").
mistake([derived(_, up)], instantiation_error, "derived/2: the first argument is a fluent").
mistake([derived(7, up)], type_error(callable, 7), "derived/2: the first argument is a fluent").
mistake([derived(down, _)], instantiation_error, "derived/2: the condition is still a variable").
mistake([derived(nod(a), up)], domain_error(golog_derived, nod/1), "derived/2: nod/1 is an action").
mistake([derived(up, at(a) = 1), causes_true(nod(a), up, true)], domain_error(golog_derived, up/0), "derived/2: up/0 is derived, so causes_true/3 says nothing about it").
mistake([derived(up, at(a) = 1), initially(up, true)], domain_error(golog_derived, up/0), "derived/2: up/0 is derived, so initially/2 says nothing about it").
mistake([derived(down, neg(down))], domain_error(golog_derived, down/0), "it depends on its own absence").
mistake([derived(x, neg(y)), derived(y, z), proc(z, x)], domain_error(golog_derived, _), "it depends on its own absence").
mistake([derived(down, up), initially(at(a), 1), initially(at(a), 2)], permission_error(derive, golog_domain, _), "derived/2: in a domain with possible values nothing is derived").

:- begin_tests(golog_steps_mistakes).
test(a_wrong_declaration_is_an_error_at_once,
     [forall(mistake(Clauses, Formal, Part)), true(Found == true)]) :-
    wrong(Clauses, Formal0, Text),
    (   Formal0 = Formal,
        sub_string(Text, _, _, _, Part)
    ->  Found = true
    ;   Found = Formal0-Text
    ).
test(an_error_has_its_place, true(sub_atom(Text, _, _, _, ':3: together/2: there is no action'))) :-
    with_file(":- use_module(library(ev3dev/golog)).\nagent(a). prim_action(nod(a)).\ntogether(nod(a), fly(_)).\n",
              File,
              ( load_files(golog_steps_place:File, []),
                catch(golog_steps_place:holds(true, []), error(Formal, Context), true),
                message_to_codes(Formal, Context, Text) )).
test(a_part_of_a_step_that_is_no_action, error(existence_error(golog_program, fly/1))) :-
    with_table(M, do(M:together([fly(a)]), _)).
test(a_step_that_is_no_list, error(type_error(list, lift(a)))) :-
    with_table(M, do(M:together(lift(a)), _)).
test(a_step_with_a_variable, error(instantiation_error)) :-
    with_table(M, do(M:together([_]), _)).
test(pddl_cannot_say_it, error(domain_error(pddl_condition, together(_, _)))) :-
    use_module(library(ev3dev/pddl), []),
    with_domain([ agent(a), agent(b), prim_action(nod(_)), poss(nod(_), true),
                  rel_fluent(up), together(nod(a), nod(b)), proc(pddl_goal, up) ], M,
                ev3dev_pddl:pddl_write(M:'nowhere.pddl')).
:- end_tests(golog_steps_mistakes).

%   Two robots carry a bar, or push a load that is too heavy for one.

carriers([ agent(back), agent(front),
           prim_action(near(R)), prim_action(grip(R)), prim_action(carry(R)),
           prim_action(free(R)),
           rel_fluent(near(back)), rel_fluent(near(front)), rel_fluent(holds(back)),
           rel_fluent(holds(front)), prim_fluent(moved),
           initially(near(_), false), initially(holds(_), false), initially(moved, 0),
           poss(near(R), neg(near(R))), poss(grip(R), and(near(R), neg(holds(R)))),
           poss(carry(R), and(holds(R), moved < 2)), poss(free(R), holds(R)),
           together(grip(_), grip(_)), together(carry(_), carry(_)),
           together(free(_), free(_)),
           causes_true(near(R), near(R), true), causes_true(grip(R), holds(R), true),
           causes_false(free(R), holds(R), true),
           causes_val(carry(_), moved, N, N is moved+1),
           robot_action(_, near(_), go_cm(20, 21)), robot_action(_, grip(_), grip),
           robot_action(back, carry(_), go_cm(20, 50)),
           robot_action(front, carry(_), go_cm(-20, 50)),
           robot_action(_, free(_), release) ]).

%   carried(+Options, +Meanwhile, -Reason, -History): Meanwhile is called in
%   another thread, with the brick `back` in use.

carried(Options, Meanwhile, Reason, History) :-
    carriers(Clauses0),
    findall(Clause,
            ( member(Clause0, Clauses0), ground_agents(Clause0, Clause) ),
            Clauses),
    setup_call_cleanup(
        ( sim_start(bar, [clock(virtual), robots([back-carrier, front-carrier])]),
          bricks_do([back, front],
                    ( set_robot(5.6, 10.6, outB, outC), set_gripper(outA, []) )) ),
        with_domain(Clauses, M,
                    ( Goal = and(moved = 2, neg(holds(back))),
                      concurrent(2,
                                 [ plunit_golog_steps_robots:
                                       carry(M, Goal, Options, Reason, History),
                                   with_brick(back, Meanwhile) ], []) )),
        forall(( member(Brick, [back, front]), brick(Brick) ), brick_close(Brick))).

:- meta_predicate carried(+, 0, -, -).

%   An action is declared for both agents.

ground_agents(prim_action(A), (prim_action(A) :- member(R, [back, front]))) :-
    !,
    arg(1, A, R).
ground_agents(Clause, Clause).

%   A goal that throws that a brick is gone, fails, or succeeds, by turns

user:nods :-
    retract(user:bar_lies([Now|Times])),
    assertz(user:bar_lies(Times)),
    (   Now == g
    ->  throw(error(existence_error(brick, back), _))
    ;   Now == '.'
    ).

:- begin_tests(golog_steps_robots).

carry(M, Goal, Options, Reason, History) :-
    with_brick(back,
               golog(M:achieve(Goal, [concurrent(true)]),
                     [reason(Reason), history(History)|Options])).

test(two_robots_carry_a_bar, [true(Reason-Length-Near == final-5-true)]) :-
    retractall(user:bar_lies(_)),
    carried([], plunit_golog_steps_robots:bar_after(25), Reason, History),
    length(History, Length),
    retract(user:bar_lies(Y)),
    ( abs(Y-100) < 5 -> Near = true ; Near = Y ).

bar_after(Seconds) :-
    wait(Seconds),
    sim_thing(bar, _, Y, _),
    assertz(user:bar_lies(Y)).

:- dynamic(user:bar_lies/1).

%   Somebody kills the other one in mid-carry: its brick is closed, or a motor
%   is pulled.
test(when_one_is_killed_the_other_one_stands_within_a_second,
     [forall(member(How, [brick_close(front), with_brick(front, sim_unplug(outB))])),
      true(Reason-Moved == failed([carry(back), carry(front)])-true)]) :-
    retractall(user:bar_lies(_)),
    setup_call_cleanup(
        asserta(user:message_hook(golog(part_failed(_, front, _, _)), _, _), Hook),
        carried([on_failed(stop)], plunit_golog_steps_robots:killed(How), Reason, History),
        erase(Hook)),
    History = [failed([carry(back), carry(front)])|_],
    findall(Y, retract(user:bar_lies(Y)), [Y0, Y1, Y2]),
    ( abs(Y2-Y1) < 0.1, Y1 > Y0 -> Moved = true ; Moved = [Y0, Y1, Y2] ).

killed(How) :-
    wait(9),
    sim_pose(_, Y0, _),
    assertz(user:bar_lies(Y0)),
    call(How),
    wait(1),
    sim_pose(_, Y1, _),
    assertz(user:bar_lies(Y1)),
    wait(2),
    sim_pose(_, Y2, _),
    assertz(user:bar_lies(Y2)).

test(a_step_that_fails_is_planned_again, Reason-Lists == final-[failed(S), S, S]) :-
    S = [carry(back), carry(front)],
    carried([], plunit_golog_steps_robots:held, Reason, History),
    findall(Entry, ( member(Entry, History), memberchk(Entry, [S, failed(S)]) ), Lists0),
    msort(Lists0, Lists).

%   Somebody stops one robot for a moment.
held :-
    wait(9),
    with_brick(front, stop).

test(a_step_ends_when_the_time_is_over,
     Reason-Entry == timeout-interrupted([carry(back), carry(front)])) :-
    carried([timeout(8)], true, Reason, [Entry|_]).
test(the_journal_knows_the_step, Step == [free(back), free(front)]) :-
    carried([], plunit_golog_steps_robots:asked_why, final, _),
    retract(user:bar_lies(Step)).

asked_why :-
    wait(30),
    use_module(library(ev3dev/journal), []),
    ev3dev_journal:why(outA, why(_, _, Causes)),
    memberchk(golog(_, Step, _), Causes),
    assertz(user:bar_lies(Step)).

test(a_mistake_in_a_goal_is_an_error_of_the_run,
     Reason = exception(error(existence_error(procedure, _), _))) :-
    setup_call_cleanup(
        sim_start(bar, [clock(virtual), robots([back-carrier, front-carrier])]),
        with_domain([ agent(back), agent(front), prim_action(nod(back)),
                      prim_action(nod(front)), poss(nod(_), true),
                      robot_action(_, nod(_), nodd) ], M,
                    golog(M:together([nod(back), nod(front)]), [reason(Reason)])),
        forall(member(Brick, [back, front]), brick_close(Brick))).
test(an_agent_without_a_brick_fails, Reason-Told == failed([nod(back), nod(ghost)])-[ghost]) :-
    setup_call_cleanup(
        ( sim_start(bar, [clock(virtual), robots([back-carrier, front-carrier])]),
          retractall(user:bar_lies(_)),
          asserta((user:message_hook(golog(part_failed(_, R, _, _)), _, _) :-
                       assertz(user:bar_lies(R))), Hook) ),
        with_domain([ agent(back), agent(ghost), prim_action(nod(back)),
                      prim_action(nod(ghost)), poss(nod(_), true),
                      robot_action(_, nod(_), true) ], M,
                    golog(M:together([nod(back), nod(ghost)]),
                          [reason(Reason), on_failed(stop)])),
        ( erase(Hook),
          forall(member(Brick, [back, front]), brick_close(Brick)) )),
    findall(R, retract(user:bar_lies(R)), Told).
test(what_is_missing_is_told_once_until_it_is_there_again,
     [ forall(member(Gone-Told, [ "ggggg"-[part, action], "gg.gg"-[part, action, part, action],
                                  "gfg"-[part, action, part] ])),
       Texts == Told ]) :-
    setup_call_cleanup(
        sim_start(bar, [clock(virtual), robots([back-carrier, front-carrier])]),
        with_domain([ agent(back), agent(front), prim_action(nod(back)), poss(nod(_), true),
                      robot_action(_, nod(_), user:nods) ], M,
                    ( string_chars(Gone, Times),
                      length(Times, Limit),
                      retractall(user:bar_lies(_)),
                      assertz(user:bar_lies(Times)),
                      said(golog(M:while(true, nod(back)), [limit(Limit), reason(_)]), Texts0) )),
        forall(member(Brick, [back, front]), brick_close(Brick))),
    findall(What,
            ( member(Text, Texts0),
              ( sub_atom(Text, _, _, _, 'of back failed') -> What = part
              ; sub_atom(Text, _, _, _, 'nod(back) failed') -> What = action ) ),
            Texts).
test(an_action_by_itself_is_done_by_its_agent, Y1-Y2 == moved-still) :-
    setup_call_cleanup(
        ( sim_start(bar, [clock(virtual), robots([back-carrier, front-carrier])]),
          bricks_do([back, front], set_robot(5.6, 10.6, outB, outC)) ),
        with_domain([ agent(back), agent(front), prim_action(go(back)), poss(go(_), true),
                      robot_action(_, go(_), go_cm(20, 10)) ], M,
                    ( golog(M:go(back), []),
                      with_brick(back, sim_pose(_, Back, _)),
                      with_brick(front, sim_pose(_, Front, _)) )),
        forall(member(Brick, [back, front]), brick_close(Brick))),
    ( near(Back, -50, 1) -> Y1 = moved ; Y1 = Back ),
    ( near(Front, 60, 0.1) -> Y2 = still ; Y2 = Front ).

%   A load of 1.6 kg: friction on the floor holds it against one robot.
pushed(Starts, Rs, Y) :-
    findall(R, member(start(R, _, _, _), Starts), Names),
    findall(R-default, member(R, Names), Robots),
    findall(Clause,
            ( member(R, Rs),
              member(Clause, [agent(R), prim_action(push(R))]) ), Agents),
    setup_call_cleanup(
        ( sim_start([ bounds(0, 0, 200, 250),
                      box(100, 60, 40, 10, 0, [mass(1.6), name(load)])|Starts ],
                    [clock(virtual), robots(Robots)]),
          bricks_do(( set_robot(5.6, 10.6, outB, outC), go_cm(20, 16) )) ),
        with_domain([ poss(push(_), true),
                      robot_action(_, push(_), ( go(30), wait(2), stop ))|Agents ], M,
                    ( findall(push(R), member(R, Rs), Step),
                      golog(M:[together(Step), together(Step)], []),
                      with_brick(a, sim_thing(load, _, Y, _)) )),
        forall(member(R, Names), brick_close(R))).

test(two_push_what_is_too_heavy_for_one, Y-Alone == there-here) :-
    pushed([start(a, 88, 30, 0), start(b, 112, 30, 0)], [a, b], Y0),
    pushed([start(a, 100, 30, 0)], [a], Alone0),
    ( near(Y0, 120, 5) -> Y = there ; Y = Y0 ),
    ( near(Alone0, 60, 1) -> Alone = here ; Alone = Alone0 ).
:- end_tests(golog_steps_robots).
