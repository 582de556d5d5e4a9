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

published(Name, Least) :-
    published(Name, Least, _, _).

:- begin_tests(pddl).
test(a_shortest_plan_is_found_and_valid,
     [forall(published(Name, Least)), true(Verdict-Length == solved-Least)]) :-
    files(Name, Domain, Problem),
    pddl_domain(pddl_test:Domain),
    pddl_problem(pddl_test:Problem),
    once(do(pddl_test:achieve(pddl_goal), H)),
    reverse(H, Plan),
    length(Plan, Length),
    verdict(Domain, Problem, Plan, Verdict).
test(random_walks_are_possible_in_both,
     [forall(published(Name, _)), true(Wrong == [])]) :-
    files(Name, Domain, Problem),
    pddl_domain(pddl_test:Domain),
    pddl_problem(pddl_test:Problem),
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
    files(Name, Domain, Problem),
    pddl_domain(pddl_test:Domain),
    pddl_problem(pddl_test:Problem),
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
    files(blocks, Domain, Problem),
    pddl_domain(pddl_test:Domain),
    pddl_problem(pddl_test:Problem),
    interpreted(pddl_goal, Goal),
    ev3dev_golog_planning_task:task(pddl_test, Goal, [], none, _).
test(a_plan_that_need_not_be_shortest_is_valid,
     [forall(published(Name, Least)), true(Verdict-Long == solved-enough)]) :-
    files(Name, Domain, Problem),
    pddl_domain(pddl_test:Domain),
    pddl_problem(pddl_test:Problem),
    once(do(pddl_test:achieve(pddl_goal, [shortest(false)]), H)),
    reverse(H, Plan),
    length(Plan, Length),
    ( between(Least, 30, Length) -> Long = enough ; Long = Length ),
    verdict(Domain, Problem, Plan, Verdict).
test(a_search_looks_at_few_states,
     [ forall(( published(Name, _, Best, Any),
                member(Shortest-Count, [true-Best, false-Any]) )),
       true(Fewer-Enough == none-plan) ]) :-
    files(Name, Domain, Problem),
    pddl_domain(pddl_test:Domain),
    pddl_problem(pddl_test:Problem),
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
    files(Name, Domain, Problem),
    pddl_domain(pddl_test:Domain),
    pddl_problem(pddl_test:Problem),
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
    files(gripper, Domain, Problem),
    pddl_domain(pddl_test:Domain),
    pddl_problem(pddl_test:Problem),
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
    files(hanoi, Domain, Problem),
    pddl_domain(pddl_test:Domain),
    pddl_problem(pddl_test:Problem),
    do(pddl_test:achieve(pddl_goal, [Limit, shortest(Shortest)]), _).
test(a_wrong_option,
     [ forall(member(Options, [ [shortest(_)], [shortest(maybe)], [depth(3)],
                                [gives_up(3)], [timeout(-1)], quick ])),
       error(domain_error(golog_option, _)) ]) :-
    files(blocks, Domain, Problem),
    pddl_domain(pddl_test:Domain),
    pddl_problem(pddl_test:Problem),
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
    files(blocks, Domain, Problem),
    pddl_domain(pddl_test:Domain),
    pddl_problem(pddl_test:Problem),
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

%   wrong(Text, Error, Part of the message)

wrong("(define (domain d)\n (:predicates (p)\n", syntax_error(pddl),
      ':2: this bracket is not closed').
wrong("(define (domain d)))", syntax_error(pddl),
      ':1: something stands after').
wrong(")", syntax_error(pddl), 'was not opened').
wrong("; nothing\n", syntax_error(pddl), 'is empty').
wrong("(domain d)", syntax_error(pddl), '(define (domain').
wrong("(define (domain d) (:requirements :fluents))",
      domain_error(pddl_requirement, ':fluents'), 'only STRIPS and ADL').
wrong("(define (domain d) (:predicates (p))
        (:action a :parameters () :precondition (q) :effect (p)))",
      existence_error(pddl_predicate, q), 'no predicate q with 0').
wrong("(define (domain d) (:predicates (p ?x))
        (:action a :parameters (?x) :precondition (p ?y) :effect (p ?x)))",
      syntax_error(pddl), 'the variable ?y is no parameter').
wrong("(define (domain d) (:types a -))", syntax_error(pddl),
      'a type is missing').

test(a_wrong_domain_is_refused_and_changes_nothing,
     [forall(wrong(Text, Error, Part)), true(Found-Same == true-true)]) :-
    files(blocks, Domain, _),
    pddl_domain(pddl_test:Domain),
    clauses(Before),
    with_text(Text, File,
              catch(pddl_domain(pddl_test:File),
                    error(Formal, context(_, Message)), true)),
    clauses(After),
    (   nonvar(Formal),
        Formal = Error,
        sub_atom(Message, _, _, _, Part)
    ->  Found = true
    ;   Found = Formal-Message
    ),
    ( Before =@= After -> Same = true ; Same = false ).

clauses(Clauses) :-
    findall(H-B, ( member(H, [ prim_action(_), poss(_, _), rel_fluent(_),
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
test(a_file_that_is_not_there,
     [ forall(member(Goal, [ pddl_domain(nix), pddl_problem(nix) ])),
       error(existence_error(source_sink, nix)) ]) :-
    call(Goal).
test(an_unbound_file,
     [ forall(member(Goal, [ pddl_domain(_), pddl_problem(_) ])),
       error(instantiation_error) ]) :-
    call(Goal).
:- end_tests(pddl).
