% One run of benches/planning.py: plan for a problem in PDDL
%
%     swipl -p library=prolog benches/planning.pl Domain Problem Options
%
% The time is that of reading the files and planning, without Prolog's start.
% The plan is checked by tests/support/pddl_validator.pl.

:- use_module(library(ev3dev/pddl)).
:- use_module('../tests/support/pddl_validator').

:- initialization main.

main :-
    current_prolog_flag(argv, Argv),
    (   append(_, [Domain, Problem, Text], Argv)
    ->  term_to_atom(Options, Text)
    ;   true
    ),
    catch(measured(Domain, Problem, Options), E,
          ( print_message(error, E), halt(1) )),
    halt.

measured(Domain, Problem, Options) :-
    statistics(inferences, I0),
    get_time(T0),
    pddl_domain(Domain),
    pddl_problem(Problem),
    once(do(achieve(pddl_goal, Options), History)),
    get_time(T),
    statistics(inferences, I),
    reverse(History, Plan),
    verdict(Domain, Problem, Plan, solved),
    length(Plan, Length),
    Seconds is T-T0,
    Inferences is I-I0,
    format('~3f ~d ~d~n', [Seconds, Inferences, Length]).
