% Random rules and random sensors, on the virtual clock: what the journal says keeps to
% the six points of library(ev3dev/rules). A seed that does not can be looked at again:
%
%   swipl -g "seed(7)" -t halt tests/behavior/test_rule_laws.pl

:- use_module('../support/cases').
:- use_module('../support/child').
:- use_module('../support/rule_laws').
:- use_module('../support/rule_sets').

% A law that a seed breaks, the first one.
broken(Seed, Wrong) :-
    rule_set(Seed, Case),
    run_of_case(Seed, Case, Run),
    once(broken_law(Case, Run, Wrong)).

% The rules of a seed, what the sensors showed, what was done, and what is wrong.
seed(Seed) :-
    rule_set(Seed, case(Rules, Options, Trace)),
    run_of_case(Seed, case(Rules, Options, Trace),
                Run),
    Run = run(Start, End, Outcome, Effects, Warned, Journal, Rest),
    append([ Rules, [options(Options), run(Start, End, Outcome, Rest), warned(Warned)],
             Effects, Journal ],
           Terms),
    forall(( member(Term, Terms) ; broken_law(case(Rules, Options, Trace), Run, Term) ),
           ( print(Term), nl )).

:- begin_tests(rule_laws).
test(random_rules_keep_to_the_laws, true(Wrongs == [])) :-
    schedules(First, Last),
    findall(Seed:Wrong, ( between(First, Last, Seed), broken(Seed, Wrong) ), Wrongs).
test(the_same_seed_is_the_same_run, [forall(case(30, Seed)), true(Again == Run)]) :-
    rule_set(Seed, Case),
    run_text(Seed, Case, Run),
    run_text(Seed, Case, Again).

% Variables have other names each time.
run_text(Seed, Case, Text) :-
    run_of_case(Seed, Case, Run),
    numbervars(Run, 0, _),
    format(string(Text), "~q", [Run]).
:- end_tests(rule_laws).

:- begin_tests(same_journal).
% With noise in sensors and motors, in processes of their own, while others take the
% processors away from them.
test(the_same_seed_writes_the_same_journal, true(Different == [First])) :-
    cases(20, Count),
    findall(loop, between(1, 3, _), Loops),
    setup_call_cleanup(
        maplist(busy, Loops, Busy),
        journals(Count, [First|Journals]),
        maplist(kill_program, Busy)),
    sort([First|Journals], Different),
    forall(member(Cause, ["rule(escape,", "rule(avoid,", "rule(follow,", "event("]),
           assertion(sub_string(First, _, _, _, Cause))).

% It ends by itself, should nobody end it.
busy(loop, Child) :-
    start_program("busy :- get_time(Now), End is Now + 100,
                           repeat, get_time(Time), Time > End, !.",
                  [goal(busy)], Child).

journals(Count, Journals) :-
    findall(Child, ( between(1, Count, _), run_started(Child) ), Children),
    maplist(journal_of, Children, Journals).

run_started(Child) :-
    start_program(
        ":- use_module(library(ev3dev)).
         :- use_module(library(ev3dev/drive)).
         :- use_module(library(ev3dev/journal)).
         :- use_module(library(ev3dev/rules)).
         :- use_module(library(ev3dev/sim)).

         escape :: us_dist_cm(_, D), D < 15 ~> go_cm(30, -15), turn(30, 120).
         avoid, min_time(0.3) :: us_dist_cm(_, D), D < 40 ~> [turn(30):0.5, go(20):0.3].
         follow, cooldown(0.5) :: us_dist_cm(_, D), D < 90 ~> S is 20 + D/3, go(S).
         wander :: true ~> behave([(look, cooldown(3) :: true ~> turn(40, 40)),
                                   (on :: true ~> arc(40, 60))]).

         main :-
             sim_start(room, [clock(virtual), noise(true), seed(7)]),
             set_robot(5.6, 10.6, outB, outC),
             every(2, ( led(left, red), wait(0.05), led(left, green) )),
             behave([escape, avoid, follow, wander], [timeout(40)]),
             journal('/dev/stdout').",
        [goal(main)], Child).

journal_of(Child, Journal) :-
    end_program(Child, exit(0), Journal).
:- end_tests(same_journal).
