:- module(ev3dev_golog,
          [ golog/2,                    % :Program, +Options
            indigolog/1,                % :Program
            indigolog/0,
            golog_exog/1,               % :Action
            do/2,                       % :Program, -History
            do/3,                       % :Program, +History0, -History
            trans/4,                    % :Program0, +History0, -Program,
                                        % -History
            final/2,                    % :Program, +History
            holds/2,                    % :Condition, +History
            has_val/3,                  % :Fluent, ?Value, +History
            eval/3,                     % :Condition, +History, -Truth
            now/1,                      % -History
            why_not/1,                  % :Action
            why_not/2,                  % :Action, -Why
            domain/2,                   % ?Value, :Sort
            rdomain/2,                  % ?Value, :Sort
            getdomain/2,                % :Sort, -Values
            sensing_action/2,           % :Action, ?Fluent
            shuffle/2,                  % +List, -Shuffled
            ask_execute/2,              % :Action, -Value
            ask_exog_occurs/1,          % :Action
            report_message/2,           % +Kind, +Message
            get_integer/3,              % +Low, ?Integer, +High
            pathfind/3,                 % :Start, +End, -Moves
            set_option/2,               % +Option, +Value
            initializeRcx/0,
            finalizeRcx/0,
            initializeExog/0,
            finalizeExog/0,
            sendRcxActionNumber/2,      % :Number, -Result
            receiveRcxActionNumber/1,   % -Numbers
            checkOtherExog/1            % -Actions
          ]).
:- set_prolog_flag(generate_debug_info, false).
:- use_module(private/load/compiled, []).
:- use_module(library(lists), [member/2]).
:- use_module(library(random), [random_permutation/2]).
:- use_module(private/checks/arguments,
              [ must_be_options/3, option/2, option/3,
                timeout_option/2
              ]).
:- use_module(private/checks/checks, [must_be/2]).
:- use_module(private/errors/errors, [domain_error/2, existence_error/2]).
:- use_module(private/errors/public_clauses, [term_expansion/4]).
:- use_module(private/golog/context, [context/3, in_mode/3]).
:- use_module(private/golog/conditions, [holds/3]).
:- use_module(private/golog/progression, [situation/3]).
:- use_module(private/golog/situation, [situation_history/2]).
:- use_module(private/golog/values, [fluent_value/4]).
:- use_module(private/golog/messages, []).
:- use_module(private/golog/run,
              [ reason_place/3, recorded_history/1, run_online/5,
                situation_of_run/4, state_of_run/3
              ]).
:- use_module(private/golog/search, [found_path/4]).
:- use_module(private/golog/name_checks, []).
:- use_module(private/golog/step_checks, []).
:- use_module(private/golog/steps, [sorted_steps/2]).
:- use_module(private/golog/theory,
              [ declare_domain/1, domain_list/3, has_clauses/2,
                has_situations/1, prepare/1, program_in/4, vocabulary/1
              ]).
:- use_module(private/golog/transitions,
              [is_final/3, program_shown/2, run/5, step/5]).
:- use_module(private/golog/no_plan, [no_plan/5]).
:- use_module(private/golog/why_not,
              [fluent_why/5, hindrance/5, more_words/4, undeclared_words/4]).
:- use_module(private/golog/world,
              [ ask/2, code_of_number/3, run_directly/4, send_exogenous/2 ]).

/** <module> Golog: plan, act, sense, react

Programs of Golog, ConGolog, IndiGolog and Legolog run on the robot, in the
simulator and without either. The module of the program says what the world is
like: its actions, fluents and their initial values, and how to execute the
actions. An example:

```
:- use_module(library(ev3dev/golog)).

prim_action(step).              prim_fluent(at).
poss(step, at < 3).             initially(at, 0).
causes_val(step, at, N, N is at+1).

proc(walk, while(at < 3, step)).
```

```
?- do(walk, History).
History = [step, step, step].
?- indigolog(walk).
```

do/2 finds out what a program would do. indigolog/1 and golog/2 do it: step by
step, with what has happened meanwhile. The robot's actions are facts, too:

```
robot_action(step, go_cm(30, 10)).
robot_sense(look, D, us_dist_cm(_, D)).
robot_exog(bump, touch(_, 1)).
```

Several robots may act at the same time. Then a step is a list of actions, and
robot_action(R, Action, Goal) is what the robot R does:

```
agent(anna).  agent(bob).
together(lift(anna), lift(bob)).        % each only with the other one
together(lift(bob), lift(anna)).
robot_action(_, lift(_), grip).
```

```
?- do(achieve(lifted, [concurrent(true)]), History).
History = [[lift(anna), lift(bob)]].
```

docs/cognitive-robotics.md explains all of it, and where the constructs come
from.

An import of this library declares the predicates of a domain dynamic and
multifile in the importing module, and discontiguous those that it defines. So
a domain may leave out what it does not need, and write its clauses in any
order and in several files.
*/

:- meta_predicate
    golog_exog(:),
    holds(:, +),
    has_val(:, ?, +),
    eval(:, +, ?),
    why_not(:),
    why_not(:, -),
    domain(?, :),
    rdomain(?, :),
    getdomain(:, ?),
    sensing_action(:, ?),
    ask_execute(:, -),
    ask_exog_occurs(:),
    pathfind(:, +, -),
    sendRcxActionNumber(:, -).

%   In A : B the action A would be taken for a module.

:- module_transparent
    golog/2,
    indigolog/1,
    indigolog/0,
    do/2,
    do/3,
    trans/4,
    final/2.

%!  golog(:Program, +Options) is semidet.
%
%   Run Program online: find the next step, execute its action, take in what
%   it senses and what has happened by itself, and so on, until Program may
%   end. Prints why and fails if it does not come to its end. The motors are
%   stopped then, and after an exception. Before the run initialize/0 of the
%   domain is called, after it, however it ends, finalize/0.
%
%   Options:
%
%     - reason(-Reason)
%       Do not fail, and do not throw an error of an action, but report why
%       the run ended: `final`, not_possible(Action, Condition) if only
%       actions were left whose precondition does not hold (in the place of
%       Condition may be a Rule for steps, see why_not/2), gave_up(Limit,
%       Far) if a search gave up at its Limit and nothing else was left,
%       no_step(Program) if nothing at all was, `stopped` by abort/0,
%       `timeout`, `limit`, failed(Action), or exception(Error). Far says how
%       far the search came: [steps(N), depth(D), inferences(I), seconds(S)];
%       it had tried N steps, at most D in a row, and computed for S seconds.
%     - history(-History)
%       The history, newest first: actions, sensing results e(Fluent, Value)
%       or e(Action, Outcome), failed(Action) and interrupted(Action). A step
%       of several agents is a sorted list of actions.
%     - trace(:Closure)
%       Called with action(A) before an action, exog(A), sensed(A, Value),
%       step(Program) with the program that remains, and replanned(Program).
%     - limit(+Steps)
%       End after that number of steps. Default is `infinite`.
%     - timeout(+Seconds)
%       End after that time, also in the middle of a wait or a search. Default
%       is `infinite`. The time is that of the robot or the simulation, if
%       there is one. On a virtual clock no time passes during a search; then
%       one step may compute for that long.
%     - initial(+History)
%       The actions that have happened before. Default is [].
%     - on_failed(+What)
%       The reaction to an action that fails: `continue` (default) with
%       failed(Action) in the history, `stop`, or `backtrack` to another step.
%     - gexec(+Meaning)
%       `guard` (default): gexec(P, E) runs E as long as P holds. `assume`: P
%       is made true first.
%     - device(:Closure)
%       Runs the codes of how_to_execute/3, by
%       call(Closure, Device, Code, Value). Without it, a code is called as a
%       goal.
%
%   @error domain_error(golog_option, Option)
%   @error existence_error(golog_program, Name/Arity) if a part of Program is
%          no construct, procedure or action
%   @error existence_error(golog_precondition, Name/Arity) if there is no
%          poss/2 for an action
%   @error existence_error(golog_condition, Name/Arity), also of the predicate
%          of a sort
%   @error existence_error(golog_agent, Agent) if a clause is about an agent
%          that agent/1 does not declare, or existence_error(golog_action,
%          Name/Arity) if together/2, excludes/2, agent_of/2 or
%          robot_action/3 is about no action
%   @error domain_error(golog_derived, Name/Arity) if a derived fluent is also
%          changed by an action, or depends on its own absence
%   @error domain_error(golog_procedure, Call) if a procedure calls itself
%          without a step in between
%   @error permission_error(search, golog_domain, Module) if searchc is to
%          plan in a domain with possible values
%   @error domain_error(golog_sensing, Entry) if no possible value of a fluent
%          is left

golog(Program, Options) :-
    context_module(M),
    ev3dev_golog:golog_in(M, Program, Options).

golog_in(M0, Program0, Options) :-
    program_in(M0, Program0, M, Program),
    settings(Options, M, Settings),
    retractall(input_ended),
    (   option(reason(Reason), Options)
    ->  catch(run_online(M, Program, Settings, Reason0, History), Error,
              ended_by(Error, Reason0, History)),
        Result = given
    ;   run_online(M, Program, Settings, Reason0, History),
        Reason = Reason0,
        Result = asked
    ),
    (   option(history(History0), Options)
    ->  History0 = History
    ;   true
    ),
    ended(Result, Reason0, Reason, M).

ended(given, Reason, Reason, _).
ended(asked, Reason0, _, M) :-
    (   Reason0 == final
    ->  true
    ;   reason_place(Reason0, M, Where),
        print_message(help, golog(not_ended(Where, Reason0))),
        fail
    ).

%   What others wait for is passed on.

ended_by(Error, Reason, History) :-
    (   for_others(Error)
    ->  throw(Error)
    ;   Reason = exception(Error),
        recorded_history(History)
    ).

for_others(Error) :-
    (   var(Error)
    ->  true
    ;   Error = '$aborted'
    ;   Error = unwind(_)
    ;   Error = time_limit_exceeded
    ;   Error = time_limit_exceeded(_)
    ;   \+ Error = error(_, _),
        compound(Error),
        functor(Error, Name, _),
        sub_atom(Name, 0, _, _, ev3dev)
    ),
    !.

settings(Options, M,
         run_settings(Words, Trace, OnFailed, Device, Limit, Timeout, Initial,
                      Keep)) :-
    must_be_options(golog_option,
                    [ reason, history, trace, limit, timeout, initial,
                      on_failed, gexec, device ], Options),
    timeout_option(Options, Timeout),
    option(limit(Limit), Options, infinite),
    (   Limit == infinite
    ->  true
    ;   must_be(nonneg, Limit)
    ),
    option(initial(Initial0), Options, []),
    must_be(list, Initial0),
    sorted_steps(Initial0, Initial),
    one_of(on_failed(OnFailed), [continue, stop, backtrack], Options),
    one_of(gexec(Gexec), [guard, assume], Options),
    (   Gexec == assume
    ->  Words = [assume]
    ;   Words = []
    ),
    closure(trace(Trace), trace, M, Options),
    closure(device(Device), device, M, Options),
    (   option(history(_), Options)
    ->  Keep = all
    ;   Keep = some
    ).

one_of(Option, [Default|Others], Options) :-
    functor(Option, Name, 1),
    functor(Given, Name, 1),
    option(Given, Options, Default),
    arg(1, Given, Value0),
    value_or(Value0, Given, Default, Value),
    must_be(atom, Value),
    (   member(Value, [Default|Others])
    ->  arg(1, Option, Value)
    ;   domain_error(golog_option, Given)
    ).

value_or(Value, _, _, Value).

closure(Option, Name, M, Options) :-
    functor(Given, Name, 1),
    (   option(Given, Options)
    ->  arg(1, Given, Closure0),
        must_be(callable, Closure0),
        strip_module(M:Closure0, M1, Closure),
        Value =.. [Name, M1:Closure],
        arg(1, Option, Value)
    ;   arg(1, Option, none)
    ).

%!  indigolog(:Program) is semidet.
%!  indigolog is semidet.
%
%   Run Program online, as golog(Program, []). Without one, the procedure
%   `main`; or if there is none, that which a fact controller/1 of the domain
%   names, or mainControl(N) for a number N there. Fails, and prints why, if
%   Program does not come to its end.

indigolog(Program) :-
    context_module(M),
    ev3dev_golog:indigolog_in(M, Program).

indigolog :-
    context_module(M),
    ev3dev_golog:indigolog_in(M, _).

indigolog_in(M0, Program0) :-
    program_in(M0, Program0, M, Program),
    (   var(Program)
    ->  main_program(M, Program)
    ;   true
    ),
    golog_in(M, Program, []).

main_program(M, Main) :-
    (   \+ ( has_clauses(M, proc(_, _)),
             M:proc(main, _) ),
        has_clauses(M, controller(_)),
        M:controller(Controller)
    ->  (   number(Controller)
        ->  Main = mainControl(Controller)
        ;   Main = Controller
        )
    ;   Main = main
    ).

%!  golog_exog(:Action) is det.
%
%   The exogenous Action happens now. May be called from anywhere: the
%   prompt, a web page, another thread. The agent whose domain is in the
%   module that calls this takes it in before its next step; if that module
%   has no domain, all agents that run. If none runs, the next run does. None
%   is lost, and their order is kept. Action may be a code that
%   translate_exog/2 or actionNum/2 of the domain translate.
%
%   @error instantiation_error if Action is unbound
%   @error existence_error(exogenous_action, Action) if no exog_action/1 of
%          these domains declares it

golog_exog(M:Action) :-
    must_be(nonvar, Action),
    send_exogenous(M, Action).

% ---------------- OFFLINE

%!  do(:Program, ?History) is nondet.
%!  do(:Program, +History0, ?History) is nondet.
%
%   True if Program can run to its end, and lead from History0, by default
%   the empty history, to History. Nothing is executed. On backtracking each
%   way.

do(Program, History) :-
    context_module(M),
    ev3dev_golog:do_in(M, Program, [], History).

do(Program, History0, History) :-
    context_module(M),
    ev3dev_golog:do_in(M, Program, History0, History).

do_in(M0, Program0, History0, History1) :-
    program_in(M0, Program0, M, Program),
    situation_now(M, History0, S0, X),
    (   is_list(History1)
    ->  sorted_steps(History1, History),
        length(History, Count),
        On = at(Count, h(History))
    ;   On = any,
        History = History1
    ),
    run(Program, S0, S, On, X),
    reached(History0, S, X, M, History).

%!  trans(:Program0, +History0, ?Program, ?History) is nondet.
%
%   True if Program0 can take a step after History0 such that Program is what
%   remains of it, after History. It is Trans of the literature.

trans(Program0, History0, Program, History) :-
    context_module(M),
    ev3dev_golog:trans_in(M, Program0, History0, Program, History).

trans_in(M0, Program0, History0, Program, History) :-
    program_in(M0, Program0, M, E),
    situation_now(M, History0, S0, X),
    step(E, S0, Program1, S, X),
    program_shown(Program1, Program),
    reached(History0, S, X, M, History).

%!  final(:Program, +History) is semidet.
%
%   True if Program may end after History. It is Final of the literature.

final(Program, History) :-
    context_module(M),
    ev3dev_golog:final_in(M, Program, History).

final_in(M0, Program0, History) :-
    program_in(M0, Program0, M, Program),
    situation_now(M, History, S, X),
    is_final(Program, S, X).

%!  holds(:Condition, +History) is nondet.
%
%   True if Condition holds after History. Variables in Condition are bound to
%   each solution. In a domain with possible values, Condition is known then:
%   it holds for each of them; possibly(Condition) holds for some.

holds(M:Condition, History) :-
    situation_now(M, History, S, X),
    holds(Condition, S, X).

%!  has_val(:Fluent, ?Value, +History) is nondet.
%
%   True if Fluent has Value after History; on backtracking each possible
%   value.

has_val(M:Fluent, Value, History) :-
    must_be(nonvar, Fluent),
    situation_now(M, History, S, X0),
    in_mode(possible, X0, X),
    fluent_value(Fluent, Value, S, X).

%!  eval(:Condition, +History, -Truth) is nondet.
%
%   Truth is `true` if Condition holds after History, `false` if its negation
%   does; else, in a domain with possible values, `unknown`.

eval(M:Condition, History, Truth) :-
    (   Truth = true,
        holds(M:Condition, History)
    ;   Truth = false,
        holds(M:neg(Condition), History)
    ;   Truth = unknown,
        \+ holds(M:Condition, History),
        \+ holds(M:neg(Condition), History)
    ).

situation_now(M, History, S, X) :-
    prepare(M),
    context(M, [], X),
    (   is_term(History, M)
    ->  situation([e('$VAR'('S'), History)], S, X)
    ;   must_be(list(nonvar), History),
        sorted_steps(History, Sorted),
        (   situation_of_run(Sorted, M, S0, X)
        ->  S = S0
        ;   situation(Sorted, S, X)
        )
    ).

reached(History0, S, X, M, History) :-
    (   is_term(History0, M)
    ->  fluent_value('$VAR'('S'), History, S, X)
    ;   situation_history(S, History)
    ).

%   In a domain of library(ev3dev/golog_classic), also s0, do(Action, Before)

is_term(Situation, M) :-
    \+ is_list(Situation),
    has_situations(M).

%!  now(-History) is det.
%
%   History is that of the run of this thread, or of its last run, also if an
%   exception has ended it. It has the newest thousand entries, newest first;
%   all, if the run was asked for its history.

now(History) :-
    recorded_history(History).

%!  why_not(:Action) is det.
%!  why_not(:Action, -Why) is semidet.
%
%   Print, or answer, why the run of this thread does not do Action next; if
%   none runs, why the last one did not go on with it. Without any run, only
%   whether Action is possible at the beginning. Why is one of
%
%     - no_action
%       The domain has no such action, or not with these arguments.
%     - not_possible(Failures)
%       For each clause of poss/2 for Action a failure(Part, Values, Place):
%       the goal of the clause's body, or else the part of the condition, that
%       does not hold; the possible values of the fluents in it as Fluent =
%       Value; and File:Line of the clause, or `none`.
%     - priority(Other, Interrupts)
%       A part of the program with a higher priority does Other. Interrupts
%       are the conditions of the interrupts around it, the innermost first.
%     - before(Other, Interrupts)
%       The program may do Action, but does Other first.
%     - interrupt(Part, Values)
%       An interrupt would do it; Part of its condition does not hold.
%     - not_offered
%       The program that remains does not begin with it.
%
%   Action may also be a list of actions that several agents do in one step.
%   Then, and if the domain has rules for steps, Why may also be
%
%     - part(Part, Reason)
%       One of the actions is not possible; Reason is no_action or
%       not_possible(Failures).
%     - not_a_step(Rule, Values)
%       Each action is possible, but not as this step. Rule is
%       together(Part, Other), if Part needs another action that unifies with
%       Other; excludes(Part1, Part2); one_at_a_time(Agent, Part1, Part2), if
%       both belong to Agent; agent_of(Part), if it belongs to no agent;
%       senses(Part); one_value(Fluent, Part1, Part2), if they would give
%       Fluent two values; or always(Condition), which would not hold after
%       the step, with the values that the fluents in it would have.
%
%   Fails if nothing stands in its way. Action may also be achieve(Goal) or
%   achieve(Goal, Options): why is there no plan? Then Why is
%
%     - no_plan(Conditions, Missing)
%       There is none for Conditions, parts of Goal, and one without each of
%       them. Missing is a list of missing(Fact, Action): no action makes Fact
%       true, which Action, or `goal`, needs.
%     - gave_up(Limit)
%       The planner found none within Limit.
%
%   @error instantiation_error if Action has variables

why_not(M:Action) :-
    (   why_not(M:Action, Why)
    ->  more_words(Why, Action, M, More),
        print_message(help, golog(why_not(Action, Why, More)))
    ;   print_message(help, golog(why_not(Action, nothing, '')))
    ).

why_not(M:Action0, Why) :-
    must_be(ground, Action0),
    prepare(M),
    context(M, [], X),
    sorted_steps([Action0], [Action]),
    (   state_of_run(M, E, S)
    ->  true
    ;   ( Action = [_|_] -> E = together(Action) ; E = [Action] ),
        situation([], S, X)
    ),
    (   Action = achieve(Goal)
    ->  no_plan(Goal, [], Why, S, X)
    ;   Action = achieve(Goal, Options),
        is_list(Options)
    ->  no_plan(Goal, Options, Why, S, X)
    ;   hindrance(Action, E, Why, S, X)
    ).

:- multifile ev3dev_causes:explained/3.

ev3dev_causes:explained(F, Why, golog(why(F, Why))) :-
    state_of_run(M, _, S),
    callable(F),
    ground(F),
    context(M, [], X),
    recorded_history(History),
    fluent_why(F, History, Why, S, X),
    !.

:- multifile ev3dev_causes:misspelt/2.

ev3dev_causes:misspelt(F, Text) :-
    state_of_run(M, _, _),
    callable(F),
    undeclared_words(fluent, F, M, More),
    (   compound(F)
    ->  true
    ;   sub_atom(More, 0, _, _, '. Did you')
    ),
    format(atom(Text), 'there is no fluent ~p~w', [F, More]).

% ---------------- FOR DOMAINS

%!  domain(?Value, :Sort) is nondet.
%!  rdomain(?Value, :Sort) is nondet.
%!  getdomain(:Sort, -Values) is det.
%
%   True if Value is one of Sort; rdomain/2 answers them in random order.
%   Values are all of them. Sort is a list, or the name of a predicate with
%   one argument that answers a list, or each value.

domain(Value, Sort) :-
    getdomain(Sort, Values),
    member(Value, Values).

rdomain(Value, Sort) :-
    getdomain(Sort, Values0),
    random_permutation(Values0, Values),
    member(Value, Values).

getdomain(M:Sort, Values) :-
    must_be(nonvar, Sort),
    domain_list(Sort, M, Values).

%!  sensing_action(:Action, ?Fluent) is nondet.
%
%   True if Action senses Fluent.

sensing_action(M:Action, Fluent) :-
    (   has_clauses(M, senses(_, _)),
        M:senses(Action, Fluent)
    ;   has_clauses(M, senses(_, _, _Fluent, _, _)),
        M:senses(Action, _, Fluent, _, _)
    ;   has_clauses(M, settles(_, _, _Fluent, _, _)),
        M:settles(Action, _, Fluent, _, _)
    ;   has_clauses(M, rejects(_, _, _Fluent, _, _)),
        M:rejects(Action, _, Fluent, _, _)
    ).

%!  shuffle(+List, -Shuffled) is det.
%
%   Shuffled has the elements of List in random order.

shuffle(List, Shuffled) :-
    must_be(list, List),
    random_permutation(List, Shuffled).

%!  ask_execute(:Action, -Value) is det.
%
%   For execute/2 of a domain without a robot: print Action, and if it is a
%   sensing action, ask the user for the Value.

ask_execute(M:Action, Value) :-
    must_be(nonvar, Action),
    (   \+ \+ sensing_action(M:Action, _)
    ->  ask(Action, Value)
    ;   print_message(help, golog(executing(Action)))
    ).

%!  ask_exog_occurs(:Action) is semidet.
%
%   For exog_occurs/1 of a domain without a robot: ask the user for an
%   exogenous action. Fails at the end of the input, and then does not ask
%   again in this run.

:- thread_local input_ended/0.

ask_exog_occurs(M:Action) :-
    \+ input_ended,
    findall(A, ( has_clauses(M, exog_action(_)), M:exog_action(A) ), Actions),
    print_message(help, golog(which_exogenous(Actions))),
    read(Answer),
    (   Answer == end_of_file
    ->  assertz(input_ended),
        fail
    ;   Action = Answer
    ).

%!  report_message(+Kind, +Message) is det.
%
%   Print a message of a program, a term or a list of terms.

report_message(Kind, Message) :-
    print_message(informational, golog(report(Kind, Message))).

%!  get_integer(+Low, ?Integer, +High) is nondet.
%
%   As between(Low, High, Integer).

get_integer(Low, Integer, High) :-
    must_be(integer, Low),
    must_be(integer, High),
    ( var(Integer) -> true ; must_be(integer, Integer) ),
    between(Low, High, Integer).

%!  pathfind(:Start, +End, -Moves) is semidet.
%
%   Moves is a shortest list of moves from the state Start to End, by A*. The
%   domain has pathfind_move/3 (State, Next, Move), and pathfind_heuristic/3
%   (State, Goal, Estimate), which is never too high. Fails if there is no
%   way.
%
%   @error existence_error(golog_condition, Name/Arity) if it has not

pathfind(M:Start, End, Moves) :-
    must_be(nonvar, Start),
    must_be(nonvar, End),
    must_have(M, pathfind_move(_, _, _)),
    must_have(M, pathfind_heuristic(_, _, _)),
    found_path(M, Start, End, Moves).

must_have(M, Head) :-
    (   has_clauses(M, Head)
    ->  true
    ;   functor(Head, Name, Arity),
        existence_error(golog_condition, Name/Arity)
    ).

%!  set_option(+Option, +Value) is det.
%
%   Does nothing: for programs that set options of IndiGolog.

set_option(_, _).

% ---------------- LEGOLOG

%!  initializeRcx is det.
%!  finalizeRcx is det.
%!  initializeExog is det.
%!  finalizeExog is det.
%
%   What a domain of Legolog calls before and after a run. Nothing is to be
%   done.

initializeRcx.

finalizeRcx.

initializeExog.

finalizeExog.

%!  sendRcxActionNumber(:Number, -Result) is semidet.
%
%   Execute the action of the domain that actionNum/2 gives Number, by its
%   robot_sense/3 or robot_action/2. Result is what it sensed, else 0.

sendRcxActionNumber(M:Number, Result) :-
    must_be(nonvar, Number),
    (   code_of_number(Number, M, Action)
    ->  true
    ;   Action = Number
    ),
    run_directly(Action, M, done, Value),
    (   var(Value)
    ->  Result = 0
    ;   Result = Value
    ).

%!  receiveRcxActionNumber(-Numbers) is det.
%!  checkOtherExog(-Actions) is det.
%
%   Numbers and Actions are []: what happens on the robot, and what
%   golog_exog/1 reports, is in the history without them.

receiveRcxActionNumber([]).

checkOtherExog([]).

% ---------------- IMPORTING IT

%   The modules that import this library: when it is loaded, the one that
%   loads it; later ones when a clause of a domain is read in them.

:- thread_local declared/2.

importer(Module) :-
    module_property(ev3dev_golog, file(File)),
    source_file_property(File, load_context(Module, _, _)),
    \+ sub_atom(Module, 0, _, _, ev3dev).

:- initialization(forall(importer(Module), declare_domain(Module)), now).

:- public of_domain/1.

of_domain(Term) :-
    nonvar(Term),
    (   Term = (Head :- _)
    ->  callable(Head)
    ;   Head = Term
    ),
    functor(Head, Name, Arity),
    (   vocabulary(Name/Arity)
    ->  in_importer(Module),
        \+ declared(Module, Name/Arity),
        assertz(declared(Module, Name/Arity)),
        (   declared(Module, all)
        ->  true
        ;   assertz(declared(Module, all)),
            declare_domain(Module)
        ),
        catch(discontiguous(Module:Name/Arity),
              error(permission_error(_, _, _), _), true)
    ;   own_export(Name/Arity)
    ->  % The program's own definition replaces this library's, in silence.
        in_importer(Module),
        functor(General, Name, Arity),
        predicate_property(Module:General, imported_from(ev3dev_golog)),
        redefine_system_predicate(Module:General)
    ;   Arity > 0,
        arg(Arity, Head, Last),
        nonvar(Last),
        memberchk(Last, [s0, do(_, _)])
    ->  % A fluent with a situation: its axiom, and how it begins
        in_importer(Module),
        catch(( discontiguous(Module:Name/Arity),
                multifile(Module:Name/Arity) ),
              error(permission_error(_, _, _), _), true)
    ).

in_importer(Module) :-
    prolog_load_context(module, Module),
    predicate_property(Module:golog(_, _), imported_from(ev3dev_golog)).

own_export(Name/Arity) :-
    module_property(ev3dev_golog, exports(Exports)),
    memberchk(Name/Arity, Exports).

:- multifile system:term_expansion/2.
:- dynamic system:term_expansion/2.

system:term_expansion(Term, _) :-
    ev3dev_golog:of_domain(Term),
    fail.
