:- module(ev3dev_golog_messages, []).
:- use_module(library(lists), [member/2]).
:- use_module(library(readutil), [read_file_to_string/3]).
:- use_module('../errors/message_text', [message_text/2]).

/** <module> The messages of library(ev3dev/golog)
*/

:- multifile prolog:message//1.

prolog:message(golog(Message)) -->
    words(Message).

%   Operators of library(ev3dev/golog_classic)

prolog:message(error(syntax_error(operator_expected),
                     file(File, Line, Column, Offset))) -->
    { \+ current_op(_, xfy, user:(#)),
      catch(read_file_to_string(File, Text, []), error(_, _), fail),
      sub_string(Text, Offset, 3, _, Near),
      member(Operator, [#, &, ' v ']),
      sub_string(Near, _, _, _, Operator)
    },
    [ '~w:~w:~w: Operator expected: ~w is one of '-
      [File, Line, Column, Operator],
      'library(ev3dev/golog_classic), which is not loaded: first'-[], nl,
      '  use_module(library(ev3dev/~w)).'-[golog_classic]
    ].

words(no_initial_value(Where, Fluent)) -->
    { functor(Fluent, Name, Arity) },
    [ '~wthe fluent ~q has no initial value: '-[Where, Name/Arity],
      'there is no initially/2 for it, so a condition about it is false, \c
       and its negation true'-[]
    ].
words(not_sensed_yet(Where, Fluent)) -->
    { functor(Fluent, Name, Arity) },
    [ '~wthe fluent ~q has no value before it is sensed: '-
      [Where, Name/Arity],
      'until then a condition about it is false, and its negation true. \c
       know/1 asks for that, and initially/2 gives a value'-[]
    ].
words(undeclared(Text)) -->
    [ '~w'-[Text] ].
words(history(History)) -->
    [ 'History: ~p'-[History] ].
words(search(What, Message)) -->
    [ 'Search: ' ],
    message_words(Message),
    outcome(What).
words(gave_up(Where, Limit, Far)) -->
    whence(Where),
    reason(gave_up(Limit, Far)).
words(out_of_time(Far)) -->
    [ 'Golog: the time was over during a search for a step; ' ],
    far(Far).
words(placed(Where, Message)) -->
    whence(Where),
    said(Message).
words(ended(Count)) -->
    [ 'Golog: the program ended, ~D entries in the history'-[Count] ].
words(not_ended(Where, Reason)) -->
    whence(Where),
    reason(Reason).
words(failed_action(Where, Action)) -->
    { in_words(Action, Words) },
    whence(Where),
    [ '~w failed'-[Words] ].
words(part_failed(Where, Agent, Action, Error)) -->
    { message_text(Error, Text) },
    whence(Where),
    [ '~p of ~p failed: ~w'-[Action, Agent, Text] ].
words(no_exogenous(Action)) -->
    [ 'Golog: ~p is not an exogenous action of the domain; it is ignored'-
      [Action] ].
words(asked(Action)) -->
    [ 'Golog: what does ~p sense?'-[Action] ].
words(executing(Action)) -->
    [ 'Executing ~p'-[Action] ].
words(which_exogenous(Actions)) -->
    [ 'What has happened? One of ~p, or nil.'-[Actions] ].
words(why_not(Action, Why, More)) -->
    hindrance(Why, Action),
    [ '~w'-[More] ].
words(why(Fluent, fluent(Value, By))) -->
    [ '~p is ~p'-[Fluent, Value] ],
    set_by(By).
words(report(_, Message)) -->
    message_words(Message).

%   A message begins with the place of its clause.

whence(Where) -->
    (   { Where == '' }
    ->  [ 'Golog: ' ]
    ;   [ '~w'-[Where] ]
    ).

said(dry(Action)) -->
    [ 'nothing says how to execute ~p'-[Action] ].
said(dry(Action, Device, Code)) -->
    [ '~p: nothing runs ~p of the device ~p'-[Action, Code, Device] ].

outcome(begin) -->
    [].
outcome(found) -->
    [ ': found a plan' ].
outcome(none) -->
    [ ': there is no plan' ].

message_words(Message) -->
    (   { is_list(Message) }
    ->  each_word(Message)
    ;   [ '~w'-[Message] ]
    ).

each_word([]) -->
    [].
each_word([Word|Words]) -->
    [ '~w'-[Word] ],
    each_word(Words).

reason(not_possible(Action, Rule)) -->
    { is_rule(Rule) },
    !,
    { in_words(Action, Words) },
    [ '~w is not possible: '-[Words] ],
    rule(Rule, []).
reason(not_possible(Action, Condition)) -->
    [ 'the action ~p is not possible: ~p does not hold'-
      [Action, Condition] ].
reason(no_step(Program)) -->
    [ 'no step is possible, and the program may not end: ~p'-[Program] ].
reason(stopped) -->
    [ 'the program was stopped' ].
reason(timeout) -->
    [ 'the time is over' ].
reason(limit) -->
    [ 'the limit of steps is reached' ].
reason(gave_up(Limit, Far)) -->
    { Limit =.. [Name, Most] },
    [ 'a search gave up at its limit of ~w ~w; '-[Most, Name] ],
    far(Far).
reason(failed(Action)) -->
    { in_words(Action, Words) },
    [ '~w failed'-[Words] ].
reason(exception(Error)) -->
    [ 'an exception: ~p'-[Error] ].

far(Far) -->
    { memberchk(steps(Steps), Far),
      memberchk(depth(Depth), Far),
      memberchk(seconds(Seconds), Far)
    },
    [ 'it had tried ~D steps, at most ~D in a row, in ~2f s'-
      [Steps, Depth, Seconds] ].

hindrance(Why, achieve(Goal, _)) -->
    !,
    hindrance(Why, achieve(Goal)).
hindrance(no_action, Action) -->
    [ '~p is no action of the domain'-[Action] ].
hindrance(not_possible([]), Action) -->
    [ '~p is not possible: there is no poss/2 for it'-[Action] ].
hindrance(not_possible([Failure|Failures]), Action) -->
    [ '~p is not possible: '-[Action] ],
    failures([Failure|Failures]).
hindrance(part(Part, no_action), _) -->
    hindrance(no_action, Part).
hindrance(part(Part, not_possible(Failures)), _) -->
    hindrance(not_possible(Failures), Part).
hindrance(not_a_step(Rule, Values), Action) -->
    { in_words(Action, Words) },
    [ '~w is not possible: '-[Words] ],
    rule(Rule, Values).
hindrance(priority(Other, Interrupts), Action) -->
    [ '~p has to wait: ~p has a higher priority'-[Action, Other] ],
    around(Interrupts).
hindrance(before(Other, Interrupts), Action) -->
    [ '~p has to wait: ~p comes first'-[Action, Other] ],
    around(Interrupts).
hindrance(interrupt(Part, Values), Action) -->
    [ '~p belongs to an interrupt: '-[Action] ],
    false_part(Part, Values).
hindrance(not_offered, Action) -->
    [ '~p is possible, but the program does not go on with it'-[Action] ].
hindrance(no_plan(Conditions, Missing), _) -->
    [ 'There is no plan for ~p'-[First] ],
    { Conditions = [First|Others] },
    and(Others),
    (   { Others == [] }
    ->  []
    ;   [ ' together; without one of them there is one'-[] ]
    ),
    missing(Missing).
hindrance(gave_up(Limit), achieve(Goal)) -->
    { Limit =.. [Name, Most] },
    [ 'There may be a plan for ~p: the planner gave up after ~D ~w'-
      [Goal, Most, Name] ].
hindrance(nothing, achieve(Goal)) -->
    !,
    [ 'There is a plan for ~p'-[Goal] ].
hindrance(nothing, Action) -->
    [ '~p comes next: nothing stands in its way'-[Action] ].

%   rule(+Rule, +Values)//: why actions are no step

is_rule(together(_, _)).
is_rule(excludes(_, _)).
is_rule(one_at_a_time(_, _, _)).
is_rule(one_value(_, _, _)).
is_rule(agent_of(_)).
is_rule(senses(_)).
is_rule(always(_)).

rule(together(Part, Other0), _) -->
    { copy_term(Other0, Other), numbervars(Other, 0, _) },
    [ '~p needs ~p in the same step'-[Part, Other] ].
rule(excludes(Part, Other), _) -->
    [ '~p excludes ~p'-[Part, Other] ].
rule(one_at_a_time(Agent, Part, Other), _) -->
    [ '~p and ~p are both actions of ~p, which does one at a time'-
      [Part, Other, Agent] ].
rule(one_value(Fluent, Part, Other), _) -->
    [ '~p and ~p would give ~p two values'-[Part, Other, Fluent] ].
rule(agent_of(Part), _) -->
    [ '~p belongs to no agent, so it is a step by itself'-[Part] ].
rule(senses(Part), _) -->
    [ '~p senses, so it is a step by itself'-[Part] ].
rule(always(Condition), Values) -->
    [ '~p, which always/1 asks for, would not hold after it'-[Condition] ],
    (   { Values == [] }
    ->  []
    ;   [ ', as '-[] ],
        values(Values)
    ).

in_words(Action, Words) :-
    (   is_list(Action)
    ->  format(atom(Words), 'the step ~p', [Action])
    ;   format(atom(Words), 'the action ~p', [Action])
    ).

set_by(initially(Place)) -->
    [ ' as at the beginning'-[] ],
    at_place('', Place).
set_by(entry(Number, Entry, Place)) -->
    { Entry = e(_, _) -> Event = 'it was sensed' ; Event = Entry },
    [ ' since ~p, entry ~D of the history'-[Event, Number] ],
    at_place('', Place).

at_place(What, Place) -->
    (   { Place = File:Line }
    ->  { file_base_name(File, Base) },
        [ ' (~w~w:~d)'-[What, Base, Line] ]
    ;   []
    ).

and([]) -->
    [].
and([Condition|Conditions]) -->
    [ ' and ~p'-[Condition] ],
    and(Conditions).

missing([]) -->
    [].
missing([missing(Fact, Action)|Missing]) -->
    [ '; no action makes ~p true'-[Fact] ],
    (   { Action == goal }
    ->  []
    ;   [ ', which ~p needs'-[Action] ]
    ),
    missing(Missing).

failures([failure(Part, Values, Place)|Failures]) -->
    false_part(Part, Values),
    at_place('poss/2, ', Place),
    (   { Failures == [] }
    ->  []
    ;   [ '; '-[] ],
        failures(Failures)
    ).

false_part(Part, Values) -->
    [ '~p does not hold'-[Part] ],
    (   { Values == [] ; Values = [Part = _] }
    ->  []
    ;   [ ', as '-[] ],
        values(Values)
    ).

values([Value]) -->
    [ '~p'-[Value] ].
values([Value, Next|Values]) -->
    [ '~p and '-[Value] ],
    values([Next|Values]).

around([]) -->
    [].
around([Condition|_]) -->
    [ ', by the interrupt ~p'-[Condition] ].
