:- use_module('../support/simulation').
:- use_module(library(ev3dev/pddl)).
:- use_module('../support/cases').
:- use_module('../support/pddl_validator').

% Ten domains of planning competitions and textbooks, written for these tests
% in tests/support/pddl. What is found for their problems is checked by another
% reader of PDDL, which takes its meaning literally.

:- prolog_load_context(directory, Here),
   atom_concat(Here, '/../support/pddl/', Directory),
   assertz(pddl_directory(Directory)).

files(Name, Domain, Problem) :-
    pddl_directory(Directory),
    atomic_list_concat([Directory, Name, '.pddl'], Domain),
    atomic_list_concat([Directory, Name, '-problem.pddl'], Problem).

read_files(Name, Domain, Problem) :-
    files(Name, Domain, Problem),
    pddl_domain(pddl_test:Domain),
    pddl_problem(pddl_test:Problem).

%   published(Name, Least, Best, Any): the problem needs at least Least steps. The search
%   for a shortest plan looks at Best states, that for any plan at Any: what makes an
%   estimate worse shows here.

published(gripper, 9, 68, 51).
published(blocks, 6, 12, 31).
published(logistics, 9, 31, 32).
published(miconic, 6, 10, 25).
published(ferry, 7, 16, 23).
published(hanoi, 7, 16, 25).
published(rovers, 8, 22, 36).
published(tyreworld, 10, 21, 33).
published(visitall, 3, 7, 7).
published(briefcase, 6, 31, 35).
published(doors, 9, 19, 28).
published(roads, 3, 5, 9).

published(Name, Least) :-
    published(Name, Least, _, _).

%   Kind-Text of each message of Goal about File

:- dynamic user:said/1, user:message_hook/3.
:- multifile user:message_hook/3.

noted(File, Goal, Messages) :-
    retractall(user:said(_)),
    atom_concat(File, ':', Begin),
    setup_call_cleanup(
        asserta((user:message_hook(format(_, [Text]), Kind, _) :-
                     atom_concat(Begin, Rest, Text),
                     assertz(said(Kind-Rest))), Ref),
        Goal,
        erase(Ref)),
    findall(Message, user:said(Message), Messages).

:- begin_tests(pddl).
test(a_shortest_plan_is_found_and_valid,
     [forall(published(Name, Least)), true(Verdict-Length == solved-Least)]) :-
    read_files(Name, Domain, Problem),
    once(do(pddl_test:achieve(pddl_goal), H)),
    reverse(H, Plan),
    length(Plan, Length),
    verdict(Domain, Problem, Plan, Verdict).
test(random_walks_are_possible_in_both,
     [forall(published(Name, _)), true(Wrong == [])]) :-
    read_files(Name, Domain, Problem),
    set_random(seed(5)),
    findall(Plan-Verdict,
            ( between(1, 10, _),
              walk(8, [], H),
              reverse(H, Plan),
              verdict(Domain, Problem, Plan, Verdict),
              (   holds(pddl_test:pddl_goal, H)
              ->  Verdict \== solved
              ;   Verdict \== unsolved
              ) ),
            Wrong).
test(what_is_possible_is_so_in_both,
     [forall(published(Name, _)), true(Here == There)]) :-
    read_files(Name, Domain, Problem),
    set_random(seed(7)),
    walk(5, [], H),
    reverse(H, Plan),
    findall(A, pddl_test:prim_action(A), As0),
    sort(As0, As),
    findall(A, ( member(A, As), trans(pddl_test:A, H, [], _) ), Here),
    findall(A, ( member(A, As),
                 append(Plan, [A], Longer),
                 verdict(Domain, Problem, Longer, Verdict),
                 Verdict \= impossible(_) ), There).

walk(N, H0, H) :-
    findall(A, ( pddl_test:prim_action(A),
                 trans(pddl_test:A, H0, [], _) ), As),
    (   N > 0,
        As \== []
    ->  random_member(A, As),
        N1 is N-1,
        walk(N1, [A|H0], H)
    ;   H = H0
    ).

%   What cannot be made ground is planned for breadth first, by the
%   interpreter itself.

interpreted(Goal, and(Goal, (true -> true ; true))).

test(what_the_domain_does_not_decide_is_not_made_ground, fail) :-
    read_files(blocks, _, _),
    interpreted(pddl_goal, Goal),
    ev3dev_golog_planning_task:task(pddl_test, Goal, [], false, by_turns, none, _).
test(a_plan_that_need_not_be_shortest_is_valid,
     [forall(published(Name, Least)), true(Verdict-Long == solved-enough)]) :-
    read_files(Name, Domain, Problem),
    once(do(pddl_test:achieve(pddl_goal, [shortest(false)]), H)),
    reverse(H, Plan),
    length(Plan, Length),
    ( between(Least, 30, Length) -> Long = enough ; Long = Length ),
    verdict(Domain, Problem, Plan, Verdict).
test(a_search_looks_at_few_states,
     [ forall(( published(Name, _, Best, Any),
                member(Shortest-Count, [true-Best, false-Any]) )),
       true(Fewer-Enough == none-plan) ]) :-
    read_files(Name, _, _),
    Less is Count-1,
    plan_within(Less, Shortest, Fewer),
    plan_within(Count, Shortest, Enough).

plan_within(Steps, Shortest, Found) :-
    (   do(pddl_test:achieve(pddl_goal, [gives_up(steps(Steps)), shortest(Shortest)]), _)
    ->  Found = plan
    ;   Found = none
    ).

test(random_goals_are_reached_as_by_the_interpreter,
     [forall(published(Name, _)), true(Wrong == [])]) :-
    read_files(Name, Domain, Problem),
    set_random(seed(11)),
    cases(12, Count),
    findall(Goal-Found,
            ( between(1, Count, _),
              random_goal(Goal),
              \+ holds(pddl_test:Goal, []),
              interpreted(Goal, Interpreted),
              reached(Interpreted, [gives_up(steps(300))], Plan1),
              reached(Goal, [gives_up(steps(3000))], Plan2),
              reached(Goal, [gives_up(steps(3000)), shortest(false)], Plan3),
              Found = [Plan1, Plan2, Plan3],
              \+ agreed(Found, Domain, Problem, Goal) ),
            Wrong).

%   Half of the goals hold after a random walk.

random_goal(Goal) :-
    findall(F, ( pddl_test:rel_fluent(F), ground(F) ), Fs),
    walk(9, [], H),
    random_member(Value, [random, H]),
    random_literal(Fs, Value, P),
    random_literal(Fs, Value, Q),
    random_literal(Fs, Value, R),
    random_member(Goal, [ P, and(P, Q), and([P, Q, R]), or(P, and(Q, R)),
                          neg(or(P, Q)), and(impl(P, Q), R),
                          some(x, [1, 2], or(and(x = 1, P),
                                             and(x = 2, Q))) ]).

random_literal(Fs, Value, L) :-
    random_member(F, Fs),
    (   Value == random
    ->  random_member(L, [F, F, F, neg(F)])
    ;   holds(pddl_test:F, Value)
    ->  L = F
    ;   L = neg(F)
    ).

reached(Goal, Options, Plan) :-
    (   do(pddl_test:achieve(Goal, Options), H)
    ->  reverse(H, Plan)
    ;   Plan = none
    ).

%   A plan that was found is possible and reaches the goal. What the
%   interpreter finds is found, and in as few steps.

agreed(Found, Domain, Problem, Goal) :-
    \+ ( member(Plan, Found),
         Plan \== none,
         \+ ( reverse(Plan, H),
              holds(pddl_test:Goal, H),
              verdict(Domain, Problem, Plan, Verdict),
              Verdict \= impossible(_) ) ),
    Found = [Plan1, Plan2, Plan3],
    (   Plan1 == none
    ->  true
    ;   length(Plan1, Length),
        length(Plan2, Length),
        Plan3 \== none
    ).

test(a_plan_is_made_again_after_an_exogenous_action,
     true(R-Left == final-[])) :-
    read_files(gripper, _, _),
    pddl_test:initially(at(Ball, Room), true),
    !,
    Clauses = [ (execute(pick(_, _, _), _) :-
                     (   test_pddl_pushed
                     ->  true
                     ;   assertz(test_pddl_pushed),
                         golog_exog(pddl_test:push)
                     )),
                (execute(A, _) :- A \= pick(_, _, _)),
                exog_action(push), poss(push, true),
                causes_true(push, at(Ball, Room), true) ],
    pddl_test:dynamic(test_pddl_pushed/0),
    setup_call_cleanup(
        findall(Ref, ( member(C, Clauses), assertz(pddl_test:C, Ref) ), Refs),
        golog(pddl_test:achieve(pddl_goal, [shortest(false)]),
              [reason(R), history(H)]),
        ( forall(member(Ref, Refs), erase(Ref)),
          retractall(pddl_test:test_pddl_pushed) )),
    memberchk(push, H),
    findall(pddl_goal, \+ holds(pddl_test:pddl_goal, H), Left).
test(a_search_that_is_given_up_finds_nothing,
     [ forall(( member(Limit, [ gives_up(steps(2)), gives_up(seconds(0)),
                                gives_up(inferences(100)), timeout(0) ]),
                member(Shortest, [true, false]) )),
       fail ]) :-
    read_files(hanoi, _, _),
    do(pddl_test:achieve(pddl_goal, [Limit, shortest(Shortest)]), _).
test(a_wrong_option,
     [ forall(member(Options, [ [shortest(_)], [shortest(maybe)], [depth(3)],
                                [gives_up(3)], [timeout(-1)], quick ])),
       error(domain_error(golog_option, _)) ]) :-
    read_files(blocks, _, _),
    do(pddl_test:achieve(pddl_goal, Options), _).

test(a_domain_takes_the_place_of_the_last, Actions == [move]) :-
    files(gripper, First, FirstProblem),
    files(visitall, Domain, Problem),
    pddl_domain(pddl_test:First),
    pddl_problem(pddl_test:FirstProblem),
    pddl_domain(pddl_test:Domain),
    pddl_problem(pddl_test:Problem),
    findall(Name, ( pddl_test:prim_action(A), functor(A, Name, _) ), Names),
    sort(Names, Actions).
test(a_problem_takes_the_place_of_the_last, Length == 6) :-
    files(blocks, Domain, Problem),
    pddl_domain(pddl_test:Domain),
    with_text("(define (problem p) (:domain blocks) (:objects a b)
                 (:init (ontable a) (ontable b) (clear a) (clear b)
                        (handempty))
                 (:goal (on a b)))",
              File, ( pddl_problem(pddl_test:File),
                      once(do(pddl_test:achieve(pddl_goal), [_, _])) )),
    pddl_problem(pddl_test:Problem),
    once(do(pddl_test:achieve(pddl_goal), H)),
    length(H, Length).
test(other_clauses_of_the_module_stay) :-
    assertz(pddl_test_more:prim_action(wave)),
    files(blocks, Domain, _),
    pddl_domain(pddl_test_more:Domain),
    pddl_domain(pddl_test_more:Domain),
    once(pddl_test_more:prim_action(wave)).
test(a_run_online, R-N == final-6) :-
    read_files(blocks, _, _),
    setup_call_cleanup(
        assertz(pddl_test:execute(_, _), Ref),
        golog(pddl_test:achieve(pddl_goal), [reason(R), history(H)]),
        erase(Ref)),
    length(H, N).

with_text(Text, File, Goal) :-
    tmp_file(pddl, File),
    setup_call_cleanup(
        ( open(File, write, Stream),
          write(Stream, Text),
          close(Stream) ),
        Goal,
        delete_file(File)).

%   Goal, with the files of a domain that is written from Module.

written(Module, Domain, Problem, Goal) :-
    tmp_file(pddl, Base),
    atom_concat(Base, '.pddl', Domain),
    atom_concat(Base, '-problem.pddl', Problem),
    setup_call_cleanup(
        pddl_write(Module:Domain),
        Goal,
        ( delete_file(Domain), delete_file(Problem) )).

test(what_was_read_and_written_has_the_same_plans,
     [forall(published(Name, Least)), true(Verdict-Length == solved-Least)]) :-
    files(Name, Domain0, Problem0),
    pddl_domain(pddl_test:Domain0),
    pddl_problem(pddl_test:Problem0),
    written(pddl_test, Domain, Problem,
            ( pddl_domain(pddl_test_again:Domain),
              pddl_problem(pddl_test_again:Problem),
              once(do(pddl_test_again:achieve(pddl_goal), H)),
              reverse(H, Plan),
              length(Plan, Length),
              verdict(Domain, Problem, Plan, Verdict) )).

%   Rooms in a row, by rules of Prolog

rooms([ (prim_action(go(N)) :- between(1, 4, N)),
        prim_action(look), prim_action('Switch'),
        (poss(go(N), some(m, [1, 2, 3, 4],
                          and(at(m), 1 =:= abs(m-N)))) :- true),
        poss('Switch', (at(4), \+ lit)),
        poss(look, true), senses(look, lit),
        (rel_fluent(at(N)) :- between(1, 4, N)), rel_fluent(lit),
        initially(at(2), true), initially(lit, false),
        (initially(at(N), false) :- N \== 2),
        causes_true(go(N), at(N), true),
        causes_false(go(N), at(M), neg(M = N)),
        causes_true('Switch', lit, near),
        proc(near, or(at(3), at(4))),
        proc(pddl_goal, and(lit, impl(at(4), neg(at(3))))) ]).

with_rooms(Change, Goal) :-
    rooms(Clauses0),
    call(Change, Clauses0, Clauses),
    setup_call_cleanup(
        forall(member(C, Clauses), assertz(pddl_rooms:C, _)),
        Goal,
        forall(( member(C, Clauses), ( C = (H :- _) -> true ; H = C ) ),
               ( functor(H, N, A), functor(G, N, A),
                 retractall(pddl_rooms:G) ))).

same(Clauses, Clauses).
with(Clause, Clauses, [Clause|Clauses]).
without(Clause, Clauses0, Clauses) :-
    exclude(=(Clause), Clauses0, Clauses).

test(a_domain_with_rules_is_written,
     true(Verdict-Plan == solved-['go-n3', 'go-n4', switch])) :-
    with_rooms(same,
        written(pddl_rooms, Domain, Problem,
            ( pddl_domain(pddl_test_again:Domain),
              pddl_problem(pddl_test_again:Problem),
              once(do(pddl_test_again:achieve(pddl_goal), H)),
              reverse(H, Plan),
              verdict(Domain, Problem, Plan, Verdict) ))).
test(a_plan_in_a_domain_with_rules,
     [ forall(member(Options, [[], [shortest(false)]])),
       true(Plan == [go(3), go(4), 'Switch']) ]) :-
    with_rooms(same,
        ( once(do(pddl_rooms:achieve(pddl_goal, Options), H)),
          reverse(H, Plan) )).
test(a_fluent_with_another_value_leaves_the_planning_to_the_interpreter,
     Length == 3) :-
    with_rooms(with(prim_fluent(n)),
        ( once(do(pddl_rooms:achieve(pddl_goal, [shortest(false)]), H)),
          length(H, Length) )).
test(what_pddl_cannot_say_is_refused,
     [ forall(member(Change-Error,
                     [ with(prim_fluent(n))-domain_error(pddl_fluent, n),
                       with(prim_action(switch))-domain_error(pddl_name, _),
                       with(poss(go(2), at(3) = true))-
                           domain_error(pddl_condition, _ = true),
                       without(proc(pddl_goal, _))-
                           existence_error(pddl_goal, pddl_rooms) ])),
       true(Thrown = Error) ]) :-
    catch(with_rooms(Change, pddl_write(pddl_rooms:'/nonexistent/x.pddl')),
          error(Thrown, _), true).
test(a_name_has_letters_digits_and_dashes,
     [ forall(member(Action-Name,
                     [ 'Box 1'-box1, '1st'-n1st, '_x'-n_x, ''-n, 'x-y'-'x-y', 'x#y'-x_y,
                       f(g(a, 'B c'))-'f-ga-bc', '\u00fcber'-n_ber ])),
       true(Names == [Name]) ]) :-
    with_rooms(append([prim_action(Action), poss(Action, true), causes_true(Action, lit, true)]),
        written(pddl_rooms, Domain, _, read_file_to_string(Domain, Text, []))),
    findall(Word, ( sub_string(Text, _, 9, After, "(:action "),
                    sub_string(Text, _, After, 0, Rest),
                    split_string(Rest, " \n", "", [Word0|_]),
                    atom_string(Word, Word0),
                    \+ sub_atom(Word, 0, _, _, 'go-n'),
                    Word \== switch ), Names).
test(an_unbound_file_is_not_written, error(instantiation_error)) :-
    pddl_write(_).

test(the_cheapest_plan_need_not_be_the_shortest,
     [ forall(member(Options-Cost, [ []-13, [cheapest(false)]-13, [cheapest(true)]-12,
                                     [cheapest(true), shortest(false)]-12 ])),
       true(Costs == [Cost, Cost]) ]) :-
    read_files(roads, Domain, Problem),
    interpreted(pddl_goal, Interpreted),
    findall(Found,
            ( member(Goal, [pddl_goal, Interpreted]),
              once(do(pddl_test:achieve(Goal, Options), H)),
              reverse(H, Plan),
              plan_cost(Domain, Problem, Plan, Found) ),
            Costs).
test(a_cost_of_actions_in_a_domain_of_golog, Plan == [go(3), go(4), 'Switch']) :-
    with_rooms(append([(action_cost(go(N), N) :- true), action_cost('Switch', 2.0)]),
        ( once(do(pddl_rooms:achieve(pddl_goal, [cheapest(true)]), H)),
          reverse(H, Plan) )).
test(a_cost_that_is_none,
     [ forall(member(Cost, [-1, 0.5, two, _, 3000000000])),
       error(domain_error(action_cost, _)) ]) :-
    with_rooms(append([action_cost(go(_), 1), action_cost('Switch', Cost)]),
        do(pddl_rooms:achieve(pddl_goal, [cheapest(true)]), _)).
test(what_is_derived_is_so_in_both,
     true(Here-There == [reached(r1), reached(r2), reached(r3)]-[['cut-off', r4], ['cut-off', r5]])) :-
    read_files(doors, _, _),
    findall(reached(R), holds(pddl_test:reached(R), []), Here),
    findall(['cut-off', R], ( pddl_test:pddl_is(R, room),
                              holds(pddl_test:'cut-off'(R), []) ), There).

test(what_is_written_in_many_ways_is_read, Plan == [press(main, l1)]) :-
    with_text("(DEFINE (DOMAIN D) ; (a comment
                 (:REQUIREMENTS :Typing :fluents) (:types lamp Switch - thing object - entity)
                 (:constants MAIN -switch) (:functions (power ?x -lamp) - number)
                 (:predicates (on?x - (either lamp switch)) (done ?x - entity)
                              (near ?s - switch?l - lamp))
                 (:action press :effect (and (on?l) (when () (DONE ?l)) ())
                  :precondition (and (near ?s?l)) :parameters (?s - switch?l - lamp)))",
              Domain, pddl_domain(pddl_test:Domain)),
    with_text("(define (problem p) (:domain d) (:objects l1 l2 - lamp main - switch)
                 (:init (near main l1) (not (on l1)) (= (power l1) -2.5))
                 (:goal (and (on l1) (not (= l1 main)) (done l1)))
                 (:metric minimize (total-time)))",
              Problem, pddl_problem(pddl_test:Problem)),
    once(do(pddl_test:achieve(pddl_goal), H)),
    reverse(H, Plan).
test(a_predicate_for_more_types_than_it_is_declared_for_is_a_warning,
     Messages-Plan == [warning-'4:88: ?x has the type object, but p is for a',
                       warning-'2:12: o has the type b, but q is for c']-[go(o)]) :-
    with_text("(define (domain d) (:types a b - object c - b)
                 (:predicates (p ?x - a) (q ?x - c) (r ?x))
                 (:action stay :parameters (?x - c) :effect (not (q ?x)))
                 (:action go :parameters (?x - object) :precondition (r ?x) :effect (p ?x)))",
              Domain, noted(Domain, pddl_domain(pddl_test:Domain), Messages1)),
    with_text("(define (problem p) (:objects o - b)\n (:init (q o) (r o)) (:goal (and (q o) (p o))))",
              Problem, noted(Problem, pddl_problem(pddl_test:Problem), Messages2)),
    append(Messages1, Messages2, Messages),
    once(do(pddl_test:achieve(pddl_goal), H)),
    reverse(H, Plan).

%   Prolog keeps the texts that a native call gets, a million at most.
test(a_task_may_have_a_million_words, Plan == [step(60)]) :-
    numlist(1, 1000, Ns),
    findall(at(N), member(N, Ns), Fluents),
    setup_call_cleanup(
        ( forall(member(at(N), Fluents), ( assertz(pddl_big:rel_fluent(at(N))),
                                           assertz(pddl_big:initially(at(N), true)) )),
          assertz((pddl_big:prim_action(step(N)) :- between(1, 600, N))),
          assertz(pddl_big:rel_fluent(end)), assertz(pddl_big:initially(end, false)),
          assertz(pddl_big:poss(step(_), true)),
          assertz((pddl_big:causes_false(step(N), at(M), true) :- member(M, Ns), M \== N)),
          assertz(pddl_big:causes_true(step(60), end, true)) ),
        ( once(do(pddl_big:achieve(and(end, at(60)), [shortest(false)]), H)), reverse(H, Plan) ),
        forall(member(Head, [ rel_fluent(_), initially(_, _), prim_action(_), poss(_, _),
                              causes_true(_, _, _), causes_false(_, _, _) ]),
               retractall(pddl_big:Head))).

%   What a file says is read, or refused with its place: wrong(In, Text, Formal,
%   Message), where Message comes after the file. Unless In is `text`, Text is in the
%   second line, after (define (In d).

wrong(text, "(define (domain d)\n (:predicates (p)\n", syntax, '2:2: this bracket is not closed').
wrong(text, "(define (domain d)))", syntax, '1:20: there is text after the last bracket').
wrong(text, ")", syntax, '1:1: a bracket is closed that was not opened').
wrong(text, "; nothing\n", syntax, '1:1: the file is empty').
wrong(text, "(domain d)", syntax, '1:1: it does not begin with (define (domain NAME)').
wrong(text, "(define (domain d) (:action a :parameters (?x :effect (and)))", syntax,
      '1:43: this bracket is not closed before the next keyword').
wrong(text, "(define (domain d) (:predicates (p) (:action a)))", syntax,
      '1:20: this bracket is not closed before the next section').
wrong(domain, "(:predicates (p)) (and )", syntax,
      '2:19: a part such as (:init ..) is expected, not (and)').
wrong(domain, "(:acton a)", domain_error(pddl_keyword, ':acton'),
      '2:1: :acton is not known here. Did you mean :action?').
wrong(domain, "(:requirements :strips :negative-precondition)",
      domain_error(pddl_requirement, ':negative-precondition'),
      '2:24: :negative-precondition is not known here. Did you mean :negative-preconditions?').
wrong(domain, "(:requirements :contingent)", domain_error(pddl_requirement, ':contingent'),
      '2:16: :contingent is not known here').
wrong(domain, "(:durative-action a)", domain_error(pddl_keyword, ':durative-action'),
      '2:1: actions that take time (:durative-action) are not read, only STRIPS, ADL, :derived and :action-costs').
wrong(domain, "(:predicates (p)) (:predicates (q))", syntax,
      '2:19: :predicates comes a second time').
wrong(domain, "(:predicates p)", syntax, '2:14: a list such as (at ?x) is expected, not p').
wrong(domain, "(:predicates (p ?x - thing))", existence_error(pddl_type, thing),
      '2:17: the type thing is not declared').
wrong(domain, "(:types a -)", syntax, '2:11: before - stands a name, after it a type').
wrong(domain, "(:types a - b b - a)", syntax, '2:9: the type a is one of itself').
wrong(domain, "(:types room) (:constants hall - rom)", existence_error(pddl_type, rom),
      '2:27: the type rom is not declared. Did you mean room?').
wrong(domain, "(:constants a b a)", syntax, '2:17: the object a is there already, in line 2').
wrong(domain, "(:predicates (p x))", syntax, '2:17: a variable such as ?x is expected, not x').
wrong(domain, "(:predicates (p ?x) (p ?y))", syntax,
      '2:21: the predicate p/1 is there already, in line 2').
wrong(domain, "(:functions (f) - object)", syntax, '2:13: only numbers are read as values').
wrong(domain, "(:action)", syntax, '2:1: an action begins with its name').
wrong(domain, "(:action a :parameters () :preconditions ())",
      domain_error(pddl_keyword, ':preconditions'),
      '2:27: :preconditions is not known here. Did you mean :precondition?').
wrong(domain, "(:action a :effect)", syntax, '2:12: nothing stands after :effect').
wrong(domain, "(:action a :effect :precondition)", syntax, '2:12: nothing stands after :effect').
wrong(domain, "(:action a (:effect ()))", syntax,
      '2:1: this bracket is not closed before the next section').
wrong(domain, "(:action a) (:action a)", syntax, '2:22: the action a is there already, in line 2').
wrong(domain, "(:action a :effect () :effect ())", syntax, '2:23: :effect comes a second time').
wrong(domain, "(:action a :parameters ?x)", syntax,
      '2:24: a list such as (?x ?y) is expected, not ?x').
wrong(domain, "(:action a :parameters (?x ?x))", syntax,
      '2:28: the variable ?x is there already, in line 2').
wrong(domain, "(:predicates (on)) (:action a :precondition (of))",
      existence_error(pddl_predicate, of),
      '2:45: the predicate of is not declared').
wrong(domain, "(:predicates (p ?x)) (:action a :precondition (p))",
      existence_error(pddl_predicate, p),
      '2:47: the number of arguments of p is 1, not 0').
wrong(domain, "(:predicates (p ?x)) (:action a :parameters (?x) :precondition (p ?y))", syntax,
      '2:67: the variable ?y is no parameter').
wrong(domain, "(:predicates (p ?x)) (:action a :parameters (?x) :effect (p y))",
      existence_error(pddl_object, y),
      '2:61: the object y is not declared').
wrong(domain, "(:predicates (p ?x)) (:action a :precondition (p (p)))", syntax,
      '2:50: an object is expected, not (p)').
wrong(domain, "(:predicates (p)) (:action a :precondition (not (p) (p)))", syntax,
      '2:44: the number of parts of (not ..) is 1, not 2').
wrong(domain, "(:predicates (p)) (:action a :precondition p)", syntax,
      '2:44: a fact such as (at ?x) is expected, not p').
wrong(domain, "(:predicates (p)) (:action a :effect (not (and (p))))", syntax,
      '2:43: a fact such as (at ?x) is expected, not (and (p))').
wrong(domain, "(:functions (f)) (:action a :precondition (> (f) 3))", domain_error(pddl_keyword, >),
      '2:43: numbers other than costs (>) are not read, only STRIPS, ADL, :derived and :action-costs').
wrong(domain, "(:functions (f)) (:action a :precondition (= (f) 3))", domain_error(pddl_keyword, =),
      '2:46: numbers other than costs (=) are not read, only STRIPS, ADL, :derived and :action-costs').
wrong(domain, "(:functions (f)) (:action a :effect (increase (f) 3))",
      domain_error(pddl_keyword, increase),
      '2:47: numbers other than costs (increase) are not read, only STRIPS, ADL, :derived and :action-costs').
wrong(domain, "(:action a :effect (increase (total-cost) 3))",
      existence_error(pddl_function, 'total-cost'),
      '2:30: the function total-cost is not declared').
wrong(domain, "(:functions (total-cost) (f ?x)) (:action a :effect (increase (total-cost) (f)))",
      existence_error(pddl_function, f),
      '2:76: the number of arguments of f is 1, not 0').
wrong(domain, "(:functions (total-cost)) (:action a :effect (increase (total-cost) (+ 1 2)))",
      syntax,
      '2:69: a cost is a number or a function, not (+ 1 2)').
wrong(domain, "(:functions (total-cost)) (:predicates (p)) (:action a :effect (when (p) (increase (total-cost) 1)))",
      syntax,
      '2:84: a cost under a condition is not read').
wrong(domain, "(:predicates (p)) (:derived (p))", syntax,
      '2:19: a rule is (:derived (at ?x) CONDITION)').
wrong(domain, "(:predicates (p)) (:derived (q) (p))", existence_error(pddl_predicate, q),
      '2:29: the predicate q is not declared').
wrong(domain, "(:predicates (p) (q)) (:derived (p) (not (q))) (:derived (q) (p))", syntax,
      '2:23: p depends on its own absence').
wrong(domain, "(:predicates (p)) (:derived (p) (and)) (:action a :effect (p))", syntax,
      '2:59: (p) is derived, so no action changes it').
wrong(problem, "(:domain e) (:goal (lit))", syntax,
      '2:1: the problem is of the domain e, not of d, which was read').
wrong(problem, "(:init)", syntax, '1:1: there is no :goal').
wrong(problem, "(:goal (lit) (lit))", syntax, '2:1: :goal has one condition, such as (and ..)').
wrong(problem, "(:goal (lit)) (:goal (lit))", syntax, '2:15: :goal comes a second time').
wrong(problem, "(:int) (:goal (lit))", domain_error(pddl_keyword, ':int'),
      '2:1: :int is not known here. Did you mean :init?').
wrong(problem, "(:objects r - robt) (:goal (lit))", existence_error(pddl_type, robt),
      '2:11: the type robt is not declared. Did you mean robot?').
wrong(problem, "(:objects r r - robot) (:goal (lit))", syntax,
      '2:13: the object r is there already, in line 2').
wrong(problem, "(:objects hall - robot) (:goal (lit))", syntax,
      '2:11: hall is a constant of the domain already, and of another type').
wrong(problem, "(:objects lit) (:goal (lit))", syntax,
      '2:11: lit is an object, and a predicate that changes').
wrong(problem, "(:objects a - robot) (:init (at a hal)) (:goal (lit))",
      existence_error(pddl_object, hal),
      '2:35: the object hal is not declared. Did you mean hall?').
wrong(problem, "(:goal (at r hall))", existence_error(pddl_object, r),
      '2:12: the object r is not declared').
wrong(problem, "(:init (light)) (:goal (lit))", existence_error(pddl_predicate, light),
      '2:8: the predicate light is not declared').
wrong(problem, "(:init lit) (:goal (lit))", syntax,
      '2:8: a fact such as (at ?x) is expected, not lit').
wrong(problem, "(:init (dark)) (:goal (lit))", syntax,
      '2:8: (dark) is derived: only :derived makes it true').
wrong(problem, "(:init (lit) (not (lit))) (:goal (lit))", syntax,
      '2:14: this is true in :init, and false, too').
wrong(problem, "(:init (at 5 (lit))) (:goal (lit))", syntax,
      '2:8: facts that come later are not read').
wrong(problem, "(:init (= (price) 3)) (:goal (lit))", existence_error(pddl_function, price),
      '2:11: the function price is not declared').
wrong(problem, "(:init (= (total-cost) x)) (:goal (lit))", syntax,
      '2:8: a number is the value of total-cost').
wrong(problem, "(:goal (lit)) (:metric maximize (total-cost))", syntax,
      '2:15: only (:metric minimize (total-cost)) is read').
wrong(problem, "(:goal (preference p (lit)))", domain_error(pddl_keyword, preference),
      '2:8: preferences (preference) are not read, only STRIPS, ADL, :derived and :action-costs').
wrong(problem, "(:init (and (lit))) (:goal (lit))", syntax,
      '2:8: a fact such as (at ?x) is expected, not (and (lit))').
wrong(problem, "(:constraints (and)) (:goal (lit))", domain_error(pddl_keyword, ':constraints'),
      '2:1: constraints (:constraints) are not read, only STRIPS, ADL, :derived and :action-costs').

with_wrong(text, Text, File, Goal) :-
    with_text(Text, File, Goal).
with_wrong(domain, Text, File, Goal) :-
    format(string(Whole), "(define (domain d)~n~s)", [Text]),
    with_text(Whole, File, Goal).
with_wrong(problem, Text, File, Goal) :-
    with_text("(define (domain d) (:types robot room) (:constants hall - room)
                 (:predicates (at ?r - robot ?x - room) (lit) (dark))
                 (:functions (total-cost))
                 (:derived (dark) (not (lit)))
                 (:action switch :effect (and (lit) (increase (total-cost) 1)))
                 (:action go :parameters (?r - robot ?x - room) :effect (at ?r ?x)))",
              Domain, pddl_domain(pddl_test:Domain)),
    format(string(Whole), "(define (problem p)~n~s)", [Text]),
    with_text(Whole, File, Goal).

test(a_wrong_file_is_refused_and_changes_nothing,
     [forall(wrong(In, Text, Formal, Message)), true(Found-Change == Formal-Message-none)]) :-
    read_files(blocks, _, _),
    ( In == problem -> Goal = pddl_problem(pddl_test:File) ; Goal = pddl_domain(pddl_test:File) ),
    with_wrong(In, Text, File,
               ( atom_concat(File, ':', Begin),
                 clauses(Before),
                 catch(Goal, error(Error, context(_, Where)), true),
                 clauses(After) )),
    ( Error == syntax_error(pddl) -> Found0 = syntax ; Found0 = Error ),
    atom_concat(Begin, Found1, Where),
    Found = Found0-Found1,
    ( Before =@= After -> Change = none ; Change = some ).

clauses(Clauses) :-
    findall(H-B, ( member(H, [ prim_action(_), poss(_, _), rel_fluent(_), initially(_, _),
                               causes_true(_, _, _) ]),
                   clause(pddl_test:H, B) ), Clauses).

test(a_problem_without_a_goal, error(syntax_error(pddl))) :-
    files(blocks, Domain, _),
    pddl_domain(pddl_test:Domain),
    with_text("(define (problem p) (:init))", File,
              pddl_problem(pddl_test:File)).
test(a_problem_without_a_domain,
     error(existence_error(pddl_domain, pddl_test_none))) :-
    files(blocks, _, Problem),
    pddl_problem(pddl_test_none:Problem).
test(an_object_with_the_name_of_a_fluent, error(syntax_error(pddl))) :-
    files(blocks, Domain, _),
    pddl_domain(pddl_test:Domain),
    with_text("(define (problem p) (:objects handempty)
                 (:init) (:goal (handempty)))", File,
              pddl_problem(pddl_test:File)).
test(why_not_names_the_false_part_and_its_line,
     Whys == [ not_possible([fuel-[fuel = false]-3]), not_possible([pddl_fact(road(x, z))-[]-3]),
               not_possible([neg(fuel)-[fuel = true]-7]), no_action, not_offered ]) :-
    with_text("(define (domain d) (:types town) (:predicates (road ?a ?b - town) (at ?a - town) (fuel) (c ?a))
                 (:action drive :parameters (?a ?b - town)
                   :precondition (and (at ?a)
                     (road ?a ?b) (fuel))
                   :effect (and (not (at ?a)) (at ?b)))
                 (:action fill
                   :precondition (not (fuel)) :effect (fuel)))",
              Domain, pddl_domain(pddl_why:Domain)),
    with_text("(define (problem p) (:objects x y z - town c)
                 (:init (at x) (road x y)) (:goal (at y)))",
              Problem, pddl_problem(pddl_why:Problem)),
    findall(Why,
            ( member(History-A, [ []-drive(x, y), []-drive(x, z), [fill]-fill, []-drive(x, c),
                                  [fill]-drive(x, y) ]),
              pddl_why:golog([], [initial(History)]),
              (   pddl_why:why_not(A, Why0)
              ->  in_lines(Why0, Domain, Why)
              ;   Why = none
              ) ),
            Whys).

in_lines(Why0, File, Why) :-
    (   Why0 = not_possible(Failures0)
    ->  findall(Part-Values-Line, member(failure(Part, Values, File:Line), Failures0), Failures),
        Why = not_possible(Failures)
    ;   Why = Why0
    ).

test(a_file_that_is_not_there,
     [ forall(member(Goal, [ pddl_domain(nix), pddl_problem(nix) ])),
       error(existence_error(source_sink, nix)) ]) :-
    call(Goal).
test(an_unbound_file,
     [ forall(member(Goal, [ pddl_domain(_), pddl_problem(_) ])),
       error(instantiation_error) ]) :-
    call(Goal).
:- end_tests(pddl).
