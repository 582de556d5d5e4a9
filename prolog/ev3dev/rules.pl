:- module(ev3dev_rules,
          [ behave/1,                   % +Rules
            behave/2,                   % +Rules, +Options
            become/1,                   % +Rules
            state/1,                    % ?State
            set_state/1,                % +State
            received/1,                 % ?Message
            send_message/1,             % +Message
            op(1160, xfx, ::),
            op(1150, xfx, ~>)
          ]).
:- set_prolog_flag(generate_debug_info, false).
:- use_module(private/load/compiled, []).
:- use_module(private/basics/fields,
              [fields/1, goal_expansion/2, term_expansion/2]).
:- use_module(private/checks/checks, [must_be/2]).
:- use_module(private/errors/errors,
              [ domain_error/2, error_within/3, existence_error/2,
                instantiation_error/1, throw_error/3, type_error/2
              ]).
:- use_module(private/errors/error_texts,
              [clause_place/2, nearly/3, place_text/2, shown/2]).
:- use_module(private/errors/frames, [goal_of_program/1]).
:- use_module(private/errors/public_clauses, [term_expansion/4]).
:- use_module(private/checks/arguments,
              [must_be_options/3, number_value/3, option/2, option/3]).
:- use_module(private/basics/small_lists, [append_lists/3, one_of/2]).
:- use_module(private/journal/causes, [acting_for/2, begins/1]).
:- use_module(private/journal/journal_words, [without_names/2]).
:- use_module(private/devices/conditions, [condition_goal/2]).
:- use_module(private/run/waits, [in_guard/2, leave/2, listening/3]).
:- use_module(private/native/native,
              [ commands_/1, motors_leave_/2, motors_stop_/2, now_/1,
                slices_/1 ]).
:- use_module(time, [wait/1]).
:- reexport(events).

:- fields(behavior(id, rules, settings, active, state, since, next,
                   messages, warned)).
:- fields(settings(until, deadline, period, trace, on_error, first)).
:- fields(rule(index, name, guard, action, options, shared)).

:- meta_predicate
    behave(:),
    behave(:, :),
    become(:).

/** <module> Rules: reactive robots

A robot that reacts is a list of rules, the most important first:

```
:- use_module(library(ev3dev)).
:- use_module(library(ev3dev/rules)).

escape :: touch(_, 1)               ~> go_cm(30, -15), turn(30, 120).
avoid  :: us_dist_cm(_, D), D < 25  ~> turn(30).
wander :: true                      ~> go(40).

?- behave([escape, avoid, wander]).
```

A rule is `Name :: Guard ~> Action`. Options stand beside the name: `near,
while(hungry), cooldown(2) :: light(L), L > 60 ~> S is L/2, go(S)`.

Every 20 ms the first rule whose Guard holds is active, and its Action is
called. While an action has not returned, only an earlier rule overrules it:
then an exception interrupts the action at its next wait or read of a sensor.
docs/reactive.md says exactly what a rule means.

Options of a rule:

  - while(:Condition)
    The action is interrupted when Condition is no longer true. Its variables
    are its own, not those of the guard. An action that has returned goes on
    while it is true, also when the guard is not.
  - min_time(+Seconds)
    An action that has returned goes on for at least this time.
  - cooldown(+Seconds)
    The rule does not apply for this time after it was active. If its action
    has waited and ended, its guard must have been false, too.
*/

% ---------------- RULES

:- multifile user:term_expansion/2.
:- dynamic user:term_expansion/2.

user:term_expansion((Head :: Guard ~> Action), Clauses) :-
    prolog_load_context(module, Module),
    predicate_property(Module:behave(_), imported_from(ev3dev_rules)),
    ev3dev_rules:rule_clauses(Head, Guard, Action, Clauses).
user:term_expansion((Head :: Guard -> Action), _) :-
    prolog_load_context(module, Module),
    predicate_property(Module:behave(_), imported_from(ev3dev_rules)),
    ev3dev_rules:wrong_arrow((Head :: Guard -> Action)).

wrong_arrow(Rule) :-
    Rule = (Head :: _),
    (   callable(Head),
        head(Head, Name, _)
    ->  true
    ;   Name = Head
    ),
    format(atom(Text), 'rule ~p: write ~~> instead of ->', [Name]),
    throw_error(existence_error(rule, Rule), _, Text).

%   A multifile predicate, so that rules may be in several files.
rule_clauses(Head, Guard0, Action,
             [ (:- multifile '$ev3dev rule'/4),
               (:- discontiguous '$ev3dev rule'/4),
               '$ev3dev rule'(Name, Options, Guard, Action)
             ]) :-
    head(Head, Name, Options),
    must_be(callable, Guard0),
    prolog_load_context(module, Module),
    condition_goal(Module:Guard0, _:Guard),
    must_be_action(Action).

%   A list is a whole action. As a part of one it would load files.

must_be_action(Action) :-
    must_be(callable, Action),
    (   has_list(Action, List)
    ->  throw_error(type_error(callable, List), _,
                    'a list of steps cannot be a part of an action')
    ;   true
    ).

has_list((A, B), List) :-
    (   part_list(A, List)
    ->  true
    ;   part_list(B, List)
    ).

part_list(Part, List) :-
    (   is_list(Part)
    ->  List = Part
    ;   nonvar(Part),
        has_list(Part, List)
    ).

head(Head, _, _) :-
    var(Head),
    !,
    instantiation_error(Head).
head((Name0, Options0), Name, Options) :-
    !,
    head(Name0, Name, Options1),
    conjuncts(Options0, Options2),
    append_lists(Options1, Options2, Options),
    must_be_options(rule_option, [while, min_time, cooldown], Options).
head(Name, Name, []) :-
    must_be(callable, Name).

conjuncts(Term, _) :-
    var(Term),
    !,
    instantiation_error(Term).
conjuncts((A, B), Conjuncts) :-
    !,
    conjuncts(A, As),
    conjuncts(B, Bs),
    append_lists(As, Bs, Conjuncts).
conjuncts(Term, [Term]).

%   rule(Index, Name, Guard, Action, Options, Shared): Shared are the
%   variables of the guard that the action has, too.

rules(Module:Terms, Rules) :-
    must_be(list, Terms),
    rules(Terms, 1, Module, List),
    Rules =.. [rules|List].

rules([], _, _, []).
rules([Term|Terms], Index, Module0, [Rule|Rules]) :-
    strip_module(Module0:Term, Module, Plain),
    rule(Plain, Module, Name, Options0, Guard, Action),
    % A variable of while(Condition) is its own.
    copy_term(Options0, Options),
    term_variables(Guard, Variables0),
    term_variables(Action, Variables1),
    shared(Variables0, Variables1, Shared0),
    Shared =.. [shared|Shared0],
    Rule = rule(Index, Name, Module:Guard, Module:Action, Module:Options,
                Shared),
    Next is Index + 1,
    rules(Terms, Next, Module0, Rules).

rule(Term, _Module, _Name, _Options, _Guard, _Action) :-
    var(Term),
    !,
    instantiation_error(Term).
rule((Head :: Guard0 ~> Action), Module, Name, Options, Guard, Action) :-
    !,
    head(Head, Name, Options),
    must_be(callable, Guard0),
    condition_goal(Module:Guard0, _:Guard),
    must_be_action(Action).
rule(Rule, _Module, _Name, _Options, _Guard, _Action) :-
    Rule = (_ :: _ -> _),
    !,
    wrong_arrow(Rule).
rule(Name, Module, Name, Options, Guard, Action) :-
    (   \+ callable(Name)
    ->  type_error(rule, Name)
    ;   rule_of(Module, Name, Options, Guard, Action)
    ->  true
    ;   atom(Name)
    ->  findall(Other, rule_of(Module, Other, _, _, _), Others),
        (   nearly(Name, Others, Near)
        ->  format(atom(Text), 'there is no rule ~w. Did you mean ~w?',
                   [Name, Near]),
            throw_error(existence_error(rule, Name), _, Text)
        ;   existence_error(rule, Name)
        )
    ;   shown(Name, Shown),
        format(atom(Text),
               'a rule is written Name :: Guard ~~> Action, not ~w', [Shown]),
        throw_error(existence_error(rule, Name), _, Text)
    ).

rule_of(Module, Name, Options, Guard, Action) :-
    catch(Module:'$ev3dev rule'(Name, Options, Guard, Action),
          error(existence_error(procedure, _), _), fail).

shared([], _, []).
shared([V|Vs], Others, Shared) :-
    (   one_of(Others, Other),
        Other == V
    ->  Shared = [V|Shared1]
    ;   Shared = Shared1
    ),
    shared(Vs, Others, Shared1).

% ---------------- BEHAVE

%!  behave(+Rules) is det.
%!  behave(+Rules, +Options) is det.
%
%   Let rules control the robot; see above for what they mean. Rules is a list
%   of names of rules of this module, or of rules in parentheses: `(stop ::
%   us_dist_cm(_, D), D < 9 ~> stop)`. Runs until an option or an exception
%   ends it, and then the robot is at rest: the motors that actions have
%   started are stopped. Options:
%
%     - until(:Goal)
%       End as soon as Goal is true.
%     - timeout(+Seconds)
%       End after that time.
%     - reason(-Reason)
%       `until` or `timeout`.
%     - period(+Seconds)
%       The time between two ticks. Default is 0.02.
%     - trace(:Closure)
%       call(Closure, Event) at each change: Event is rule(Name),
%       suppressed(Name), ended(Name), failed(Name), thrown(Name) or rest.
%     - on_error(+Action)
%       `throw`, the default, or `continue`: print errors of guards and
%       actions, and count the rule as not applicable, or ended.
%     - state(+State)
%       The state/1 at the beginning. Default is `start`.
%
%   @error existence_error(rule, Name)
%   @error type_error(rule, Term)
%   @error permission_error(wait, guard, Name) if a guard waits or starts a
%          motor
%   @error domain_error(behave_option, Option)

behave(Rules) :-
    behave(Rules, []).

behave(Rules0, Module:Options) :-
    rules(Rules0, Rules),
    must_be_options(behave_option,
                    [until, timeout, reason, period, trace, on_error, state],
                    Options),
    option(period(Period0), Options, 0.02),
    number_value(seconds, Period0, Period),
    end_options(Options, Module, Until, Trace, OnError),
    deadline(Options, Deadline),
    option(state(State), Options, start),
    commands_(First),
    functor(Rules, _, Count),
    functor(Since, since, Count),
    Settings = settings(Until, Deadline, Period, Trace, OnError, First),
    flag(ev3dev_behave, Id, Id + 1),
    Behavior = behavior(Id, Rules, Settings, rest, State, Since, [], [],
                        []),
    inner(Behavior, Outer),
    setup_call_cleanup(true,
                       run(Behavior, Reason0),
                       ( nb_setval(ev3dev_last_behavior, Behavior),
                         rest(Behavior, ended) )),
    b_setval(ev3dev_behavior, Outer),
    option(reason(Reason), Options, _),
    Reason = Reason0.

inner(Behavior, Outer) :-
    (   nb_current(ev3dev_behavior, Outer)
    ->  true
    ;   Outer = []
    ),
    b_setval(ev3dev_behavior, Behavior).

end_options(Options, Module, Until, Trace, OnError) :-
    (   option(until(Until0), Options)
    ->  must_be(callable, Until0),
        condition_goal(Module:Until0, Until)
    ;   Until = none
    ),
    (   option(trace(Trace0), Options)
    ->  must_be(callable, Trace0),
        Trace = Module:Trace0
    ;   Trace = none
    ),
    option(on_error(OnError), Options, throw),
    (   one_of([throw, continue], OnError)
    ->  true
    ;   domain_error(on_error, OnError)
    ).

deadline(Options, Deadline) :-
    (   option(timeout(Seconds0), Options)
    ->  number_value(seconds, Seconds0, Seconds),
        now_(Now),
        Deadline is Now + Seconds
    ;   Deadline = inf
    ).

%   behavior(Id, Rules, Settings, Active, State, Since, Next, Messages,
%   Warned), changed by nb_setarg/3, as a tick undoes bindings:
%
%     - Active
%       active(Index, Time, Mode), none, or `rest`, when the motors rest:
%       Mode is `waits` for an action that has not returned, or
%       going(Values) with the values of the shared variables.
%     - Since
%       for each rule, unbound, ended(Time) until its guard has been false,
%       and then the Time from which on it applies; 0 without a cooldown
%     - Next
%       what the suppressed action makes room for: [] or next(Index, Held),
%       its guard and shared variables with their values, over(Reason) or
%       become(Rules)
%     - Messages
%       what was received since the last tick
%     - Warned
%       the rules whose actions have failed

active(Behavior, Active) :-
    Behavior = behavior(active: Active).

%   File and line of the active rule, if it is in a file.

:- multifile ev3dev_causes:active_clause/1.

ev3dev_causes:active_clause(Clause) :-
    nb_current(ev3dev_behavior, Behavior),
    Behavior \== [],
    active(Behavior, active(Index, _, _)),
    rule_at(Index, Behavior, Rule),
    rule_clause(Rule, Clause).

rule_clause(Rule, Clause) :-
    Rule = rule(name: Name, guard: (Module:_)),
    catch(clause(Module:'$ev3dev rule'(Name, _, _, _), true, Clause),
          error(_, _), fail),
    !.

run(Behavior, Reason) :-
    repeat,
    step(Behavior, Step),
    Step = over(Reason),
    !.

step(Behavior, Step) :-
    Behavior = behavior(next: Next),
    set_field(Behavior, behavior(next: [])),
    look_again(Behavior),
    (   Next = over(_)
    ->  Step = Next
    ;   Next = become(Rules)
    ->  replace(Behavior, Rules),
        Step = goes_on
    ;   is_over(Behavior, Reason)
    ->  Step = over(Reason)
    ;   choice(Next, Behavior, Rule)
    ->  set_field(Behavior, behavior(messages: [])),
        take(Rule, Behavior),
        Step = goes_on
    ;   set_field(Behavior, behavior(messages: [])),
        none(Behavior),
        pass(Behavior),
        Step = goes_on
    ).

is_over(Behavior, Reason) :-
    Behavior = behavior(settings: settings(until: Until, deadline: Deadline)),
    (   Deadline \== inf,
        now_(Now),
        Now >= Deadline
    ->  Reason = timeout
    ;   Until \== none,
        in_guard(until, Until)
    ->  Reason = until
    ).

pass(Behavior) :-
    Behavior = behavior(settings: settings(period: Period)),
    wait(Period).

replace(Behavior, Rules) :-
    functor(Rules, _, Count),
    functor(Since, since, Count),
    set_field(Behavior, behavior(rules: Rules)),
    set_field(Behavior, behavior(active: none)),
    set_field(Behavior, behavior(since: Since)).

%   The first rule that applies, with its guard's bindings.
choice(next(Index, Held), Behavior, Rule) :-
    rule_at(Index, Behavior, Rule),
    held(Rule, Held).
choice([], Behavior, Rule) :-
    Behavior = behavior(rules: Rules),
    functor(Rules, _, Count),
    applies_within(Behavior, Rules, 1, Count, Rule).

held(Rule, held(Guard, Shared)) :-
    Rule = rule(guard: Guard, shared: Shared).

applies_within(Behavior, Rules, Index, Last, Rule) :-
    Index =< Last,
    arg(Index, Rules, Rule0),
    (   applies(Rule0, Behavior)
    ->  Rule = Rule0
    ;   Next is Index + 1,
        applies_within(Behavior, Rules, Next, Last, Rule)
    ).

applies(Rule, Behavior) :-
    Rule = rule(index: Index),
    Behavior = behavior(since: Since),
    arg(Index, Since, From),
    (   number(From)
    ->  now_(Now),
        Now >= From,
        holds(Rule, Behavior)
    ;   nonvar(From)                    % ended
    ->  fail
    ;   holds(Rule, Behavior)
    ).

%   Has the guard of a rule that has ended been false? Also while an earlier
%   rule is active.
look_again(Behavior) :-
    Behavior = behavior(since: Since),
    (   Since =.. [_|List],
        \+ ( one_of(List, From), compound(From) )
    ->  true
    ;   Behavior = behavior(rules: Rules),
        forall(( arg(Index, Since, From), compound(From) ),
               ( arg(Index, Rules, Rule),
                 (   holds(Rule, Behavior)
                 ->  true
                 ;   From = ended(Time),
                     nb_setarg(Index, Since, Time)
                 ) ))
    ).

holds(rule(Index, Name, Guard, _, Options, Shared), Behavior) :-
    (   guard(Name, Guard, Behavior)
    ->  true
    ;   active(Behavior, active(Index, Start, going(Values))),
        goes_on(Options, Name, Start, Behavior),
        Shared = Values
    ).

guard(Name, Guard, Behavior) :-
    catch(in_guard(Name, Guard), E, true),
    (   nonvar(E)
    ->  failed(E, Name, guard, Behavior)
    ;   true
    ).

goes_on(Module:Options, Name, Start, Behavior) :-
    (   option(while(Condition), Options),
        guard(Name, Module:Condition, Behavior)
    ->  true
    ;   option(min_time(Seconds0), Options),
        number_value(seconds, Seconds0, Seconds),
        now_(Now),
        Now < Start + Seconds
    ).

%   An error names the rule.
failed(E, Name, Where, Behavior) :-
    (   E = error(Formal, _)
    ->  Behavior = behavior(settings: settings(on_error: OnError)),
        rule_place(Name, Behavior, Place),
        place_text(Place, At),
        format(atom(Text), 'in the ~w of rule ~p~w', [Where, Name, At]),
        (   Formal = permission_error(wait, guard, _),
            Place == none
        ->  Named = E                   % which names the rule
        ;   error_within(E, Text, Named)
        ),
        (   ( OnError == throw ; Formal = permission_error(wait, guard, _) )
        ->  throw(Named)
        ;   print_message(error, Named),
            fail
        )
    ;   throw(E)
    ).

rule_place(Name, Behavior, Place) :-
    Behavior = behavior(rules: Rules),
    (   arg(_, Rules, Rule),
        Rule = rule(name: Name),
        rule_clause(Rule, Clause)
    ->  clause_place(Clause, Place)
    ;   Place = none
    ).

:- multifile prolog:message//1.

prolog:message(ev3dev(rule_failed(Name))) -->
    [ 'The action of rule ~p failed'-[Name] ].

% ---------------- ACTIONS

%   No rule applies.
none(Behavior) :-
    active(Behavior, Active),
    (   Active == rest
    ->  true
    ;   left(Behavior),
        rest(Behavior, none),
        set_field(Behavior, behavior(active: rest)),
        traced(Behavior, rest)
    ).

rest(Behavior, Why) :-
    Behavior = behavior(settings: settings(first: First)),
    commands_(Before),
    acting_for(motors_stop_(First, Before), rules(Why)).

%   The active rule is no longer active.
left(Behavior) :-
    active(Behavior, Active),
    (   Active = active(Index, _, _)
    ->  cool_down(Index, Behavior),
        set_field(Behavior, behavior(active: none))
    ;   true
    ).

cool_down(Index, Behavior) :-
    rule_at(Index, Behavior, rule(options: (_:Options))),
    (   option(cooldown(Seconds0), Options)
    ->  number_value(seconds, Seconds0, Seconds),
        now_(Now),
        From is Now + Seconds,
        Behavior = behavior(since: Since),
        nb_setarg(Index, Since, From)
    ;   true
    ).

rule_at(Index, Behavior, Rule) :-
    Behavior = behavior(rules: Rules),
    arg(Index, Rules, Rule).

take(Rule, Behavior) :-
    Rule = rule(index: Index, shared: Shared),
    (   active(Behavior, active(Index, Start, going(Values)))
    ->  (   Values =@= Shared
        ->  true
        ;   act(Rule, Start, Behavior)
        ),
        pass_if_going(Index, Behavior)
    ;   left(Behavior),
        Behavior = behavior(settings: settings(first: First)),
        commands_(Before),
        motors_leave_(First, Before),
        now_(Now),
        Rule = rule(name: Name, guard: (_:Guard)),
        traced(Behavior, rule(Name)),
        begins(rule(Name, Guard)),
        act(Rule, Now, Behavior),
        motors_left(First, Before),
        pass_if_going(Index, Behavior)
    ).

%   Called when an action returns that has not waited.
motors_left(First, Before) :-
    motors_stop_(First, Before),
    motors_leave_(First, First).

%   Another rule is chosen at once after an action that has waited.
pass_if_going(Index, Behavior) :-
    (   active(Behavior, active(Index, _, going(_)))
    ->  pass(Behavior)
    ;   true
    ).

act(rule(Index, Name, Guard, Action, _, Shared), Start, Behavior) :-
    set_field(Behavior, behavior(active: active(Index, Start, waits))),
    Behavior = behavior(id: Id, settings: settings(period: Period)),
    slices_(Slices0),
    catch(( listening(Period, ev3dev_rules:tick(Behavior),
                      ev3dev_rules:carry_out(Action, Name, Guard))
          ->  Outcome = ended
          ;   Outcome = failed
          ),
          E,
          outcome(E, Id, Name, Behavior, Outcome)),
    slices_(Slices),
    (   Outcome == ended,
        Slices =:= Slices0
    ->  Active = active(Index, Start, going(Shared)),
        set_field(Behavior, behavior(active: Active))
    ;   over(Outcome, Index, Name, Guard, Behavior),
        (   Outcome \== suppressed,
            Slices =:= Slices0
        ->  pass(Behavior)
        ;   true
        )
    ).

outcome(ev3dev_leave(Id), Id, _, _, Outcome) :-
    !,
    Outcome = suppressed.
outcome(E, _, Name, Behavior, Outcome) :-
    \+ failed(E, Name, action, Behavior),
    Outcome = thrown.

over(Outcome, Index, Name, Guard, Behavior) :-
    left(Behavior),
    (   Outcome == suppressed
    ->  true
    ;   Guard = _:true
    ->  true
    ;   Behavior = behavior(since: Since),
        arg(Index, Since, From),
        (   number(From)                % cools down, too
        ->  nb_setarg(Index, Since, ended(From))
        ;   nb_setarg(Index, Since, ended(0))
        )
    ),
    (   Outcome == failed
    ->  warn_once(Name, Behavior)
    ;   true
    ),
    (   Behavior = behavior(next: over(_))
    ->  true
    ;   Event =.. [Outcome, Name],
        traced(Behavior, Event)
    ).

warn_once(Name, Behavior) :-
    Behavior = behavior(warned: Warned),
    (   one_of(Warned, Name)
    ->  true
    ;   set_field(Behavior, behavior(warned: [Name|Warned])),
        print_message(warning, ev3dev(rule_failed(Name)))
    ).

traced(Behavior, Event) :-
    Behavior = behavior(settings: settings(trace: Trace)),
    (   Trace == none
    ->  true
    ;   \+ goal_of_program(call(Trace, Event))
    ->  true
    ;   true
    ).

%   The journal gets the guard with its values.
carry_out(Action, Name, _:Guard) :-
    copy_term_nat(Guard, Values),
    acting_for(ev3dev_rules:carry_out(Action), rule(Name, Values)).

carry_out(Module:Action) :-
    (   is_list(Action)
    ->  one_after_the_other(Action, Module)
    ;   goal_of_program(Module:Action)
    ).

one_after_the_other([], _).
one_after_the_other([Step|Steps], Module) :-
    (   nonvar(Step),
        Step = Goal:Seconds0
    ->  number_value(seconds, Seconds0, Seconds),
        now_(Now),
        End is Now + Seconds,
        until(ev3dev_rules:is_late(End), Module:Goal, Which),
        (   Which == goal
        ->  until(ev3dev_rules:is_late(End), true)
        ;   true
        ),
        one_after_the_other(Steps, Module)
    ;   Steps == []
    ->  goal_of_program(Module:Step),
        repeat,
        wait(3600),
        fail
    ;   goal_of_program(Module:Step),
        one_after_the_other(Steps, Module)
    ).

is_late(End) :-
    now_(Now),
    Now >= End.

% While an action waits: is it time to interrupt it?
tick(Behavior, Listener) :-
    Behavior = behavior(id: Id),
    look_again(Behavior),
    (   next(Behavior, Next)
    ->  set_field(Behavior, behavior(next: Next)),
        leave(Listener, ev3dev_leave(Id))
    ;   true
    ).

next(Behavior, over(Reason)) :-
    is_over(Behavior, Reason),
    !.
next(Behavior, Next) :-
    active(Behavior, active(Index, _, _)),
    rule_at(Index, Behavior, rule(name: Name, options: (Module:Options))),
    Behavior = behavior(rules: Rules),
    Last is Index - 1,
    (   applies_within(Behavior, Rules, 1, Last, Rule)
    ->  Rule = rule(index: Earlier),
        held(Rule, Held),
        Next = next(Earlier, Held)
    ;   option(while(Condition), Options),
        \+ guard(Name, Module:Condition, Behavior)
    ->  Next = []
    ).

% ---------------- WHY

%   why(rule(Name)) of library(ev3dev/journal), about the behave/1 that runs,
%   or the last one

:- multifile ev3dev_causes:explained/3.

ev3dev_causes:explained(rule(Name), rule(Why, Place),
                        ev3dev(why_rule(Name, Why, Place))) :-
    (   ( nb_current(ev3dev_behavior, Behavior)
        ; nb_current(ev3dev_last_behavior, Behavior) ),
        Behavior = behavior(rules: Rules),
        arg(Index, Rules, Rule),
        Rule = rule(name: Name)
    ->  true
    ;   existence_error(rule, Name)
    ),
    rule_place(Name, Behavior, Place),
    Behavior = behavior(since: Since),
    arg(Index, Since, From),
    now_(Now),
    (   active(Behavior, active(Index, _, _))
    ->  Why = active
    ;   number(From),
        From > Now
    ->  Left is From-Now,
        Why = cooldown(Left)
    ;   Rule = rule(guard: Guard),
        false_part(Guard, Name, Part)
    ->  Why = false(Part)
    ;   nonvar(From),
        From = ended(_)
    ->  Why = ended
    ;   Last is Index-1,
        applies_within(Behavior, Rules, 1, Last, Above)
    ->  Above = rule(name: Other),
        Why = above(Other)
    ;   Why = applies
    ).

false_part(M:Guard, Name, Part) :-
    \+ in_guard(Name, M:Guard),
    (   Guard = (A, B)
    ->  (   in_guard(Name, M:A)
        ->  false_part(M:B, Name, Part)
        ;   false_part(M:A, Name, Part)
        )
    ;   Part = Guard
    ).

prolog:message(ev3dev(why_rule(Name, Why0, Place))) -->
    { place_text(Place, At),
      without_names(Why0, Why)
    },
    [ 'Rule ~p~w '-[Name, At] ],
    rule_words(Why).

rule_words(active) -->
    [ 'is active'-[] ].
rule_words(cooldown(Left)) -->
    [ 'does not apply for ~2f s more: its cooldown'-[Left] ].
rule_words(false(Part)) -->
    [ 'does not apply: ~p is false'-[Part] ].
rule_words(ended) -->
    [ 'has done its action, and its guard has not been false since'-[] ].
rule_words(above(Other)) -->
    [ 'waits for rule ~p, which is above it and applies'-[Other] ].
rule_words(applies) -->
    [ 'applies'-[] ].

% ---------------- STATE, MESSAGES

%!  become(+Rules).
%
%   Replace the rules of the innermost behave/1 that runs, and end the action
%   that calls this. Does not return.
%
%   @error permission_error(become, behavior, none) outside of an action

become(Rules0) :-
    rules(Rules0, Rules),
    behavior(Behavior, become),
    Behavior = behavior(id: Id),
    set_field(Behavior, behavior(next: become(Rules))),
    throw(ev3dev_leave(Id)).

%!  state(?State) is semidet.
%!  set_state(+State) is det.
%
%   The state of the innermost behave/1 that runs: any term, `start` at the
%   beginning. Guards read it, actions set it.
%
%   @error permission_error(read, behavior, none) outside of behave/1
%   @error permission_error(set, behavior, none)

state(State) :-
    behavior(Behavior, read),
    Behavior = behavior(state: State0),
    State = State0.

set_state(State) :-
    must_be(nonvar, State),
    behavior(Behavior, set),
    set_field(Behavior, behavior(state: State)).

behavior(Behavior, Action) :-
    (   nb_current(ev3dev_behavior, Behavior),
        Behavior \== []
    ->  true
    ;   throw_error(permission_error(Action, behavior, none), _,
                    'no behave/1 is running')
    ).

%!  send_message(+Message) is det.
%!  received(?Message) is nondet.
%
%   Send a Message to the innermost behave/1 that runs, and, in a guard, ask
%   whether it was sent. A message exists for one tick: the rules see it when
%   they are tried next.
%
%   @error permission_error(send, behavior, none) outside of behave/1

send_message(Message) :-
    must_be(nonvar, Message),
    behavior(Behavior, send),
    Behavior = behavior(messages: Messages),
    append_lists(Messages, [Message], More),
    set_field(Behavior, behavior(messages: More)).

received(Message) :-
    behavior(Behavior, read),
    Behavior = behavior(messages: Messages),
    one_of(Messages, Message).
