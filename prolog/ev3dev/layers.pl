:- module(ev3dev_layers,
          [ control/1,                  % +Options
            sense/2,                    % +Sense, ?Value
            val/2,                      % +Fluent, ?Value
            was/3,                      % ?Fluent, ?Value, ?Since
            layer/1,                    % +Name
            op(1150, xfx, <-)
          ]).
:- set_prolog_flag(generate_debug_info, false).
:- use_module(private/load/compiled, []).
:- use_module(library(lists),
              [ append/3, last/2, list_to_set/2, member/2, reverse/2 ]).
:- use_module(private/basics/fields,
              [fields/1, goal_expansion/2, term_expansion/2]).
:- use_module(private/checks/checks, [must_be/2]).
:- use_module(private/checks/arguments,
              [ must_be_options/3, number_value/3, option/2, option/3,
                speed_value/2, timeout_option/2 ]).
:- use_module(private/errors/errors,
              [ error_within/3, instantiation_error/1, throw_error/3 ]).
:- use_module(private/errors/error_texts,
              [clause_place/2, nearly/3, place_text/2, shown/2]).
:- use_module(private/errors/frames, [goal_of_program/1]).
:- use_module(private/errors/public_clauses, [term_expansion/4]).
:- use_module(private/journal/causes, [acting_for/2]).
:- use_module(private/journal/journal_words, [step_words//1]).
:- use_module(private/native/native,
              [ commands_/1, device_/3, motors_stop_/2, now_/1 ]).
:- use_module(private/run/waits, [in_guard/2]).
:- use_module(motors, [motor_run/2]).
:- use_module(odometry, [pose/3]).
:- use_module(sensors, [reading_of/4, sensor_reading/3]).
:- use_module(time, [wait/1]).

:- fields(run(id, module, layers, start, time, clause)).
:- fields(fluent(run, fluent, value, since, clause)).

:- meta_predicate control(:).

/** <module> Layers: a controller as a logic program over time

A controller is a set of rules `Head <- Body` that hold at each time. What
they say together is what the motors do:

```
:- use_module(library(ev3dev)).
:- use_module(library(ev3dev/layers)).

:- layer(places).
assign(to_do, [80-40, 170-90]) <- \+ was(to_do, _, _).
assign(to_do, Places)          <- was(to_do, [_|Places], _), arrived.

:- layer(wheels).
set(outB, 30) <- sense(us_dist_cm, D), D > 20.
```

The time is not written down: it is now. Every 50 ms all rules are looked at,
and a Head holds if its Body does. Heads are

  - assign(Fluent, Value)
    From now on Fluent has Value, until it is assigned another one.
  - set(Port, Speed)
    The motor at Port runs at Speed, as in motor_run/2, until it is set
    again.
  - sense(Sense, Value)
    A sense of the program's own: its first answer is that of this time.
  - any other goal, a relation, which other rules may ask.

A Body asks relations, sense/2, val/2, was/3, and predicates of Prolog, which
may only look. Its parts are joined by `,`, `;`, `->` and `\+`. A variable of
`\+` that also occurs elsewhere in the rule must have a value there.

Only the last value of a fluent is kept, and its time: so a controller needs
the same memory after a minute and after a day. docs/layers.md shows how to
write one.

After David Poole, Logic Programming for Robot Control, 1995.
*/

% ---------------- RULES

:- multifile user:term_expansion/2.
:- dynamic user:term_expansion/2.

user:term_expansion((Head <- Body), Clauses) :-
    ev3dev_layers:is_controller,
    ev3dev_layers:rule_clauses(Head, Body, Clauses).
user:term_expansion(assign(Fluent, Value), _) :-
    ev3dev_layers:must_have_arrow(assign(Fluent, Value)).
user:term_expansion(set(Port, Speed), _) :-
    ev3dev_layers:must_have_arrow(set(Port, Speed)).
user:term_expansion((assign(Fluent, Value) :- _), _) :-
    ev3dev_layers:must_have_arrow(assign(Fluent, Value)).
user:term_expansion((set(Port, Speed) :- _), _) :-
    ev3dev_layers:must_have_arrow(set(Port, Speed)).

is_controller :-
    prolog_load_context(module, Module),
    predicate_property(Module:control(_), imported_from(ev3dev_layers)).

%   Other modules see what `user` imports, and may have predicates of these
%   names. So a module that has no rule yet is not meant.

must_have_arrow(Head) :-
    is_controller,
    prolog_load_context(module, Module),
    (   Module == user
    ->  true
    ;   Rule = '$ev3dev layer'(_, _, _),
        predicate_property(Module:Rule, number_of_clauses(_)),
        \+ predicate_property(Module:Rule, imported_from(_))
    ),
    no_arrow(Head).

no_arrow(Head) :-
    shown(Head, Shown),
    format(atom(Text), 'write ~w <- Body', [Shown]),
    throw_error(permission_error(define, predicate, Head), _, Text).

%   A multifile predicate, so that layers may be in several files.

rule_clauses(Head, Body0,
             [ (:- multifile '$ev3dev layer'/3),
               (:- discontiguous '$ev3dev layer'/3),
               '$ev3dev layer'(Head, Body, Layer)
             ]) :-
    must_be_head(Head),
    translated(Body0, Head, Body),
    layer_of_source(Layer).

must_be_head(Head) :-
    must_be(callable, Head),
    functor(Head, Name, Arity),
    (   Head = set(Port, _)
    ->  (   var(Port)
        ->  true
        ;   must_be(atom, Port)
        )
    ;   memberchk(Name/Arity, [assign/2, sense/2])
    ->  true
    ;   memberchk(Name/Arity, [val/2, was/3])
    ->  throw_error(permission_error(define, relation, Name/Arity), _,
                    'write assign(Fluent, Value) <- Body')
    ;   (   predicate_property(system:Head, built_in)
        ;   memberchk(Name/Arity, [(<-)/2, (\+)/1])
        )
    ->  format(atom(Text), '~q is a predicate of Prolog', [Name/Arity]),
        throw_error(permission_error(define, relation, Name/Arity), _, Text)
    ;   true
    ).

%   translated(+Body0, +Outside, -Body): a negation becomes
%   '$not'(Shared, Goal) with its variables that are Outside, too, and a goal
%   of Prolog's own '$prolog'(Goal).

translated(Body, _, _) :-
    var(Body),
    !,
    instantiation_error(Body).
translated((A0, B0), Outside, (A, B)) :-
    !,
    translated(A0, Outside-B0, A),
    translated(B0, Outside-A0, B).
translated((If0 -> Then0 ; Else0), Outside, (If -> Then ; Else)) :-
    !,
    translated((If0 -> Then0), Outside, (If -> Then)),
    translated(Else0, Outside, Else).
translated((If0 -> Then0), Outside, (If -> Then)) :-
    !,
    translated(If0, Outside-Then0, If),
    translated(Then0, Outside-If0, Then).
translated((A0 ; B0), Outside, (A ; B)) :-
    !,
    translated(A0, Outside, A),
    translated(B0, Outside, B).
translated(\+ A0, Outside, '$not'(Shared, A)) :-
    !,
    translated(A0, Outside, A),
    term_variables(A0, Inner),
    term_variables(Outside, Outer),
    findall(I,
            ( nth_of(Inner, 1, I, V), \+ \+ ( member(O, Outer), O == V ) ),
            Places),
    at_places(Places, Inner, Shared).
translated(!, _, _) :-
    !,
    throw_error(domain_error(layer_goal, !), _,
                'rules of layers have no cut, as all of them hold at once').
translated(Goal, _, Translated) :-
    must_be(callable, Goal),
    (   predicate_property(system:Goal, built_in)
    ->  Translated = '$prolog'(Goal)    % which is no relation
    ;   Translated = Goal
    ).

nth_of([V|_], I, I, V).
nth_of([_|Vs], I0, I, V) :-
    I1 is I0 + 1,
    nth_of(Vs, I1, I, V).

at_places([], _, []).
at_places([I|Is], Variables, [V|Vs]) :-
    once(nth_of(Variables, 1, I, V)),
    at_places(Is, Variables, Vs).

% ---------------- LAYERS

:- dynamic layer_begun/4.               % Source, Stream, Line, Name

%!  layer(+Name) is det.
%
%   A directive: the rules that follow in this file are of the layer Name, an
%   atom. Rules before the first one are of a layer with the name of the file.
%
%   @error type_error(atom, Name)
%   @error permission_error(begin, layer, Name) if no file is being loaded

layer(Name) :-
    must_be(atom, Name),
    (   loading(Source, Stream, Line)
    ->  retractall(layer_begun(Source, _, _, _)),
        assertz(layer_begun(Source, Stream, Line, Name))
    ;   throw_error(permission_error(begin, layer, Name), _,
                    'it is a directive of a file')
    ).

%   A file that is loaded again has another stream. Up to 7.2.3 one that is
%   loaded from a stream has none.

loading(Source, Stream, Line) :-
    source_location(_, Line),
    prolog_load_context(source, Source),
    (   prolog_load_context(stream, Stream)
    ->  true
    ;   Stream = none
    ).

layer_of_source(Layer) :-
    (   loading(Source, Stream, Line)
    ->  (   layer_begun(Source, Stream, Begin, Layer0),
            Begin =< Line
        ->  Layer = Layer0
        ;   file_base_name(Source, Base),
            file_name_extension(Layer, _, Base)
        )
    ;   Layer = user
    ).

%   layer_rule(+Run, ?Head, -Body, -Clause)

layer_rule(Run, Head, Body, Clause) :-
    Run = run(module: Module, layers: Layers),
    any_rule(Module, Head, Body, Layer, Clause),
    (   Layers == all
    ->  true
    ;   memberchk(Layer, Layers)
    ).

any_rule(Module, Head, Body, Layer, Clause) :-
    clause(Module:'$ev3dev layer'(Head, Body, Layer), true, Clause).

% ---------------- CONTROL

%!  control(+Options) is semidet.
%
%   Let the layers of this module control the robot, until an option or an
%   exception ends it, and then the motors that they have set are stopped.
%   Fails if a motor cannot carry out what is set. Options:
%
%     - until(Body)
%       End as soon as Body is true: what a rule may ask, such as a relation.
%     - timeout(+Seconds)
%       End after that time.
%     - reason(-Reason)
%       `until` or `timeout`.
%     - period(+Seconds)
%       The time between two looks at the rules. Default is 0.05.
%     - layers(+Names)
%       Only rules of these layers hold.
%     - trace(:Closure)
%       call(Closure, Event) at each change: Event is assign(Fluent, Value),
%       or set(Port, Speed).
%
%   @error existence_error(layer, Name) if no rule belongs to a layer of the
%          option, or there are no rules
%   @error existence_error(relation, Name/Arity) if a rule asks what neither
%          the layers nor Prolog define
%   @error existence_error(fluent, Fluent) if nothing assigns it
%   @error existence_error(sense, Sense)
%   @error existence_error(motor, Port)
%   @error permission_error(assign, fluent, Fluent) if two rules assign it
%          different values at one time
%   @error permission_error(set, motor, Port) if two rules set different
%          speeds at one time
%   @error domain_error(acyclic_relation, Goal) if Goal depends on itself at
%          one time
%   @error instantiation_error if a value is unbound that must be known
%   @error permission_error(wait, guard, layers) if a rule waits or starts a
%          motor
%   @error domain_error(control_option, Option)

control(Module:Options) :-
    must_be_options(control_option,
                    [until, timeout, reason, period, layers, trace],
                    Options),
    option(period(Period0), Options, 0.05),
    number_value(positive_number, Period0, Period),
    timeout_option(Options, Timeout),
    option(until(Until0), Options, fail),
    translated(Until0, [], Until),
    trace_option(Options, Module, Trace),
    option(layers(Layers), Options, all),
    flag(ev3dev_layers, Id, Id + 1),
    now_(Start),
    Run = run(Id, Module, Layers, Start, 0.0, none),
    must_have_rules(Run, Until),
    commands_(First),
    outer(Run, Outer),
    setup_call_cleanup(
        forget_last(Id),
        run(Run, Until, Timeout, Period, Trace, Reason0),
        ( commands_(Before),
          acting_for(motors_stop_(First, Before), layers(ended)),
          forget_time(Id) )),
    b_setval(ev3dev_layers, Outer),
    option(reason(Reason), Options, _),
    Reason = Reason0.

trace_option(Options, Module, Trace) :-
    (   option(trace(Closure), Options)
    ->  must_be(callable, Closure),
        Trace = Module:Closure
    ;   Trace = none
    ).

outer(Run, Outer) :-
    (   nb_current(ev3dev_layers, Outer)
    ->  true
    ;   Outer = []
    ),
    b_setval(ev3dev_layers, Run).

run(Run, Until, Timeout, Period, Trace, Reason) :-
    repeat,
    step(Run, Until, Timeout, Trace, Step),
    (   Step == goes_on
    ->  wait(Period),
        fail
    ;   !,
        Step = over(Reason)
    ).

%   Step is goes_on, over(Reason), or `failed`.

step(Run, Until, Timeout, Trace, Step) :-
    now_(Now),
    Run = run(id: Id, start: Start),
    Time is Now - Start,
    set_field(Run, run(time: Time)),
    forget_time(Id),
    (   number(Timeout),
        Time >= Timeout
    ->  Step = over(timeout)
    ;   in_guard(layers, ev3dev_layers:look(Run, Until, Seen)),
        changes(Trace, Id, Changes),
        remember(Id, Time),
        traced(Changes, Trace),
        (   Seen == until
        ->  Step = over(until)
        ;   Seen = sets(Sets),
            \+ ( member(Set, Sets), \+ command(Set, Run, Trace) )
        ->  Step = goes_on
        ;   Step = failed
        )
    ).

look(Run, Until, Seen) :-
    forall(layer_rule(Run, assign(Fluent, _), Body, Clause),
           assigned_by(Fluent, Body, Clause, Run)),
    (   prove(Until, at(Run, until, []), _, _)
    ->  Seen = until
    ;   sets(Run, Sets),
        Seen = sets(Sets)
    ).

% ---------------- WHAT IS REMEMBERED

:- thread_local
    fluent/5,               % Id, Fluent, Value, Since, Clause
    last_run/2,             % Id, Module
    motor/4,                % Id, Port, Speed, Clauses
    now_assigned/3,         % Id, Fluent, Result
    now_sensed/3.           % Id, Sense, Result

%   The fluents of the last run stay for why/1.

forget_last(Id) :-
    forall(retract(last_run(Last, _)),
           ( retractall(fluent(run: Last)),
             retractall(motor(Last, _, _, _)) )),
    nb_current(ev3dev_layers, Run),
    Run = run(module: Module),
    assertz(last_run(Id, Module)).

forget_time(Id) :-
    retractall(now_assigned(Id, _, _)),
    retractall(now_sensed(Id, _, _)).

remember(Id, Time) :-
    forall(now_assigned(Id, Fluent, value(Value, Clause)),
           ( retractall(fluent(run: Id, fluent: Fluent)),
             assertz(fluent(Id, Fluent, Value, Time, Clause)) )).

changes(Trace, Id, Changes) :-
    (   Trace == none
    ->  Changes = []
    ;   findall(assign(Fluent, Value),
                ( now_assigned(Id, Fluent, value(Value, _)),
                  \+ ( fluent(run: Id, fluent: Fluent, value: Value0),
                     Value0 == Value ) ),
                Changes)
    ).

traced([], _).
traced([Event|Events], Trace) :-
    (   Trace == none
    ->  true
    ;   ignore(goal_of_program(call(Trace, Event)))
    ),
    traced(Events, Trace).

% ---------------- MOTORS

sets(Run, Sets) :-
    findall(set(Port, Speed, Clause, Proof),
            set_by(Run, Port, Speed, Clause, Proof),
            All),
    each_once(All, [], Sets).

set_by(Run, Port, Speed, Clause, [by(set(Port, Speed), Clause)|Proof]) :-
    layer_rule(Run, set(Port, Speed0), Body, Clause),
    At = at(Run, Clause, [set(Port, Speed0)]),
    prove(Body, At, Proof, []),
    must_be_known(set(Port, Speed0), Clause),
    in_clause(( must_be(atom, Port), speed_value(Speed0, Speed) ), Clause).

each_once([], Sets0, Sets) :-
    reverse(Sets0, Sets).
each_once([Set|Sets1], Sets0, Sets) :-
    Set = set(Port, Speed, Clause, _),
    (   member(set(Port, Other, Before, _), Sets0)
    ->  (   same(Speed, Other)
        ->  each_once(Sets1, Sets0, Sets)
        ;   contradiction(permission_error(set, motor, Port),
                          Other, Before, Speed, Clause)
        )
    ;   each_once(Sets1, [Set|Sets0], Sets)
    ).

same(A, B) :-
    (   A == B
    ->  true
    ;   number(A),
        number(B),
        A =:= B
    ).

contradiction(Formal, Value1, Clause1, Value2, Clause2) :-
    said(Value1, Clause1, Said1),
    said(Value2, Clause2, Said2),
    Formal =.. [_, Verb, _, What],
    shown(What, Shown),
    participle(Verb, Done),
    format(atom(Text), '~w is ~w ~w, and at the same time ~w',
           [Shown, Done, Said1, Said2]),
    throw_error(Formal, control/1, Text).

participle(assign, assigned).
participle(set, 'set to').

said(Value, Clause, Said) :-
    shown(Value, Shown),
    clause_text(Clause, Text),
    format(atom(Said), '~w by ~w', [Shown, Text]).

%   A motor gets a command if its speed changes, or the rules that set it.

command(set(Port, Speed, Clause, Proof), Run, Trace) :-
    Run = run(id: Id),
    findall(By, member(by(_, By), Proof), Clauses),
    (   motor(Id, Port, Before, ClausesBefore),
        same(Before, Speed)
    ->  Changes = []
    ;   Changes = [set(Port, Speed)]
    ),
    (   Changes == [],
        ClausesBefore == Clauses
    ->  true
    ;   set_field(Run, run(clause: Clause)),
        steps(Proof, Steps),
        acting_for(motor_run(Port, Speed), layers(Steps)),
        retractall(motor(Id, Port, _, _)),
        assertz(motor(Id, Port, Speed, Clauses)),
        traced(Changes, Trace)
    ).

%   The rule that sets a motor now, for the view.

:- multifile ev3dev_causes:active_clause/1.

ev3dev_causes:active_clause(Clause) :-
    nb_current(ev3dev_layers, Run),
    Run = run(clause: Clause),
    Clause \== none.

% ---------------- PROOFS

%   prove(+Body, +At, -Proof, ?Rest) is nondet: Body holds. Proof, up to Rest,
%   is the list of what it is true by: by(Head, Clause), or sense(Sense,
%   Value). At is at(Run, Clause, Path): the rule that asks, and the goals
%   that are being proved.

prove(true, _, Proof, Proof) :- !.
prove((A, B), At, Proof, Rest) :-
    !,
    prove(A, At, Proof, Middle),
    prove(B, At, Middle, Rest).
prove((If -> Then ; Else), At, Proof, Rest) :-
    !,
    (   prove(If, At, Proof, Middle)
    ->  prove(Then, At, Middle, Rest)
    ;   prove(Else, At, Proof, Rest)
    ).
prove((If -> Then), At, Proof, Rest) :-
    !,
    (   prove(If, At, Proof, Middle)
    ->  prove(Then, At, Middle, Rest)
    ).
prove((A ; B), At, Proof, Rest) :-
    !,
    (   prove(A, At, Proof, Rest)
    ;   prove(B, At, Proof, Rest)
    ).
prove('$not'(Shared, A), At, Proof, Rest) :-
    !,
    Proof = Rest,
    At = at(_, Clause, _),
    (   ground(Shared)
    ->  \+ prove(A, At, _, _)
    ;   floundered(\+ A, Clause)
    ).
prove(sense(Sense, Value), At, [sense(Sense, Value)|Rest], Rest) :-
    !,
    sensed(Sense, At, Value).
prove(val(Fluent, Value), At, [by(assign(Fluent, Value), Clause)|Rest],
      Rest) :-
    !,
    value(Fluent, At, Value, Clause).
prove(was(Fluent, Value, Since), at(Run, _, _),
      [by(assign(Fluent, Value), Clause)|Rest], Rest) :-
    !,
    Run = run(id: Id),
    fluent(Id, Fluent, Value, Since, Clause).
prove('$prolog'(Goal), at(Run, Clause, _), Rest, Rest) :-
    !,
    Run = run(module: Module),
    in_clause(goal_of_program(Module:Goal), Clause).
prove(Goal, At, Proof, Rest) :-
    At = at(Run, Clause, Path),
    (   is_relation(Run, Goal)
    ->  must_be_new(Goal, Path),
        Proof = [by(Goal, By)|Proof1],
        layer_rule(Run, Goal, Body, By),
        prove(Body, at(Run, By, [Goal|Path]), Proof1, Rest)
    ;   Proof = Rest,
        Run = run(module: Module),
        in_clause(goal_of_program(Module:Goal), Clause)
    ).

%   Also if the layer that defines it has been left out.

is_relation(Run, Goal) :-
    Run = run(module: Module),
    functor(Goal, Name, Arity),
    functor(General, Name, Arity),
    \+ \+ any_rule(Module, General, _, _, _).

must_be_new(Goal, Path) :-
    (   member(Before, Path),
        Before =@= Goal
    ->  cyclic(Goal, Path)
    ;   true
    ).

cyclic(Goal, Path0) :-
    once(( append(Since, [Before|_], Path0), Before =@= Goal )),
    reverse([Goal|Since], Between),
    all_shown([Goal|Between], Shown),
    atomic_list_concat(Shown, ', ', Listed),
    shown(Goal, First),
    format(atom(Text), '~w depends on itself at the same time: ~w',
           [First, Listed]),
    throw_error(domain_error(acyclic_relation, Goal), control/1, Text).

all_shown([], []).
all_shown([Goal|Goals], [Shown|Showns]) :-
    shown(Goal, Shown),
    all_shown(Goals, Showns).

must_be_known(Head, Clause) :-
    (   ground(Head)
    ->  true
    ;   floundered(Head, Clause)
    ).

floundered(Goal, Clause) :-
    shown_goal(Goal, Shown),
    clause_text(Clause, Where),
    format(atom(Text), 'a variable of ~w has no value, in ~w',
           [Shown, Where]),
    throw_error(instantiation_error, control/1, Text).

shown_goal(Goal, Shown) :-
    (   Goal = (\+ Body)
    ->  without_shared(Body, Plain),
        shown(\+ Plain, Shown)
    ;   shown(Goal, Shown)
    ).

without_shared(Body, Plain) :-
    (   var(Body)
    ->  Plain = Body
    ;   Body = '$not'(_, A)
    ->  without_shared(A, B),
        Plain = (\+ B)
    ;   Body = '$prolog'(Plain0)
    ->  Plain = Plain0
    ;   Body =.. [Operator, A, B],
        memberchk(Operator, [(','), (;), (->)])
    ->  without_shared(A, A1),
        without_shared(B, B1),
        Plain =.. [Operator, A1, B1]
    ;   Plain = Body
    ).

%   An error of what a rule calls says which rule it is.

:- meta_predicate in_clause(0, +).

in_clause(Goal, Clause) :-
    catch(Goal, Error, throw_in_clause(Error, Clause)).

throw_in_clause(Error, Clause) :-
    (   Error = error(Formal, _),
        \+ memberchk(Clause, [none, until]),
        Formal \= domain_error(acyclic_relation, _)
    ->  clause_text(Clause, Where),
        atom_concat('in ', Where, Text),
        error_within(Error, Text, Named),
        throw(Named)
    ;   throw(Error)
    ).

clause_text(none, 'a predicate that rules call') :- !.
clause_text(until, 'the option until') :- !.
clause_text(Clause, Text) :-
    layer_and_place(Clause, Layer, Place),
    place_text(Place, At),
    format(atom(Text), 'layer ~w~w', [Layer, At]).

%   A rule that is gone, as its file was loaded again, has no place.

layer_and_place(Clause, Layer, Place) :-
    (   catch(clause(Rule, true, Clause), error(_, _), fail),
        strip_module(Rule, _, '$ev3dev layer'(_, _, Layer))
    ->  true
    ;   Layer = none
    ),
    clause_place(Clause, Place).

% ---------------- FLUENTS

%   assigned_by(+Fluent, +Body, +Clause, +Run): the fluents that a rule
%   assigns have their values of this time.

assigned_by(Fluent, Body, Clause, Run) :-
    (   ground(Fluent)
    ->  assigned(Fluent, at(Run, Clause, []), _)
    ;   findall(Fluent, prove(Body, at(Run, Clause, []), _, _), Fluents0),
        sort(Fluents0, Fluents),
        forall(member(Each, Fluents),
               ( (   ground(Each)
                 ->  true
                 ;   floundered(assign(Each, _), Clause)
                 ),
                 assigned(Each, at(Run, Clause, []), _) ))
    ).

value(Fluent, At, Value, Clause) :-
    At = at(Run, Asks, _),
    (   ground(Fluent)
    ->  true
    ;   floundered(val(Fluent, Value), Asks)
    ),
    assigned(Fluent, At, Result),
    (   Result = value(Value0, Clause)
    ->  Value = Value0
    ;   Run = run(id: Id),
        fluent(Id, Fluent, Value0, _, Clause),
        !,
        Value = Value0
    ).

%   Result is value(Value, Clause), or `none`, if nothing assigns Fluent now.

assigned(Fluent, At, Result) :-
    At = at(Run, _, Path),
    Run = run(id: Id),
    (   now_assigned(Id, Fluent, Result0)
    ->  (   Result0 == asked
        ->  path_to(Fluent, Path, Goal),
            cyclic(Goal, Path)
        ;   Result = Result0
        )
    ;   assertz(now_assigned(Id, Fluent, asked)),
        findall(Value-Clause,
                assigned_now(Fluent, Run, Path, Value, Clause),
                Values),
        the_value(Values, Fluent, Result),
        retract(now_assigned(Id, Fluent, asked)),
        !,
        assertz(now_assigned(Id, Fluent, Result))
    ).

%   A predicate of Prolog may have asked in between.

path_to(Fluent, Path, Goal) :-
    Goal = assign(Fluent, _),
    (   member(Before, Path),
        Before =@= Goal
    ->  true
    ;   cyclic_through_prolog(Fluent)
    ).

cyclic_through_prolog(Fluent) :-
    shown(val(Fluent, _), Shown),
    format(atom(Text), '~w depends on itself at the same time', [Shown]),
    throw_error(domain_error(acyclic_relation, val(Fluent, _)), control/1,
                Text).

assigned_now(Fluent, Run, Path, Value, Clause) :-
    layer_rule(Run, assign(Fluent, Value), Body, Clause),
    prove(Body, at(Run, Clause, [assign(Fluent, _)|Path]), _, _),
    must_be_known(assign(Fluent, Value), Clause).

the_value([], _, none).
the_value([Value-Clause|Others], Fluent, value(Value, Clause)) :-
    (   member(Other-Second, Others),
        Other \== Value
    ->  contradiction(permission_error(assign, fluent, Fluent),
                      Value, Clause, Other, Second)
    ;   true
    ).

% ---------------- SENSES

sensed(Sense, At, Value) :-
    At = at(Run, Clause, _),
    Run = run(id: Id),
    (   ground(Sense)
    ->  true
    ;   floundered(sense(Sense, Value), Clause)
    ),
    (   now_sensed(Id, Sense, Result0)
    ->  Result = Result0
    ;   (   sensed_now(Sense, At, Value0)
        ->  Result = value(Value0)
        ;   Result = none
        ),
        assertz(now_sensed(Id, Sense, Result))
    ),
    Result = value(Value).

sensed_now(Sense, at(Run, _, Path), Value) :-
    is_relation_of(Run, sense(Sense, _)),
    !,
    must_be_new(sense(Sense, _), Path),
    layer_rule(Run, sense(Sense, Value), Body, Clause),
    prove(Body, at(Run, Clause, [sense(Sense, _)|Path]), _, _),
    must_be_known(sense(Sense, Value), Clause).
sensed_now(Sense, at(Run, Clause, _), Value) :-
    (   Sense == time
    ->  Run = run(time: Value)
    ;   Sense == pose
    ->  in_clause(pose(X, Y, Heading), Clause),
        Value = pose(X, Y, Heading)
    ;   reading_at(Sense, Reading, Port)
    ->  in_clause(sensor_reading(Reading, Port, Value), Clause)
    ;   must_be_sense(Sense, Run, Clause)
    ).

is_relation_of(Run, Head) :-
    Run = run(module: Module),
    \+ \+ any_rule(Module, Head, _, _, _).

reading_at(Sense, Reading, Port) :-
    (   atom(Sense)
    ->  Reading = Sense
    ;   compound(Sense),
        Sense =.. [Reading, Port]
    ),
    \+ \+ reading_of(Reading, _, _, _).

% ---------------- WHAT A PREDICATE OF PROLOG MAY ASK

%!  sense(+Sense, ?Value) is semidet.
%
%   What the robot perceives now. It is read once at each time, so all rules
%   see the same Value. Sense is a reading of sensor_reading/3, such as
%   `us_dist_cm` or `touch(in4)`; `pose`, where Value is pose(X, Y, Heading)
%   of pose/3; `time`, the seconds since control/1 was called; or what a rule
%   of the program defines. Fails if there is no such sensor.
%
%   In a program, a predicate that rules call may ask it, too, and val/2 and
%   was/3.
%
%   @error permission_error(ask, layers, none) outside of control/1
%   @error existence_error(sense, Sense)

sense(Sense, Value) :-
    current_run(Run),
    sensed(Sense, at(Run, none, []), Value).

%!  val(+Fluent, ?Value) is semidet.
%
%   The Value of Fluent at this time: what is assigned now, else was/3. Fails
%   if it has none yet.
%
%   @error permission_error(ask, layers, none) outside of control/1
%   @error instantiation_error if Fluent has an unbound variable

val(Fluent, Value) :-
    current_run(Run),
    value(Fluent, at(Run, none, []), Value, _).

%!  was(?Fluent, ?Value, ?Since) is nondet.
%
%   The Value of Fluent just before this time, which it was assigned last at
%   the time Since, in seconds since control/1 was called. Fails if it had
%   none.
%
%   @error permission_error(ask, layers, none) outside of control/1

was(Fluent, Value, Since) :-
    current_run(Run),
    Run = run(id: Id),
    fluent(Id, Fluent, Value, Since, _).

current_run(Run) :-
    (   nb_current(ev3dev_layers, Run),
        Run \== []
    ->  true
    ;   throw_error(permission_error(ask, layers, none), _,
                    'no control/1 is running')
    ).

% ---------------- BEFORE IT BEGINS

%   What the rules ask must be defined, in one of the layers or in Prolog, and
%   the motors must be there: a mistake is found before anything moves.

must_have_rules(Run, Until) :-
    Run = run(module: Module, layers: Layers),
    (   Layers == all
    ->  true
    ;   must_be(list(atom), Layers)
    ),
    findall(Layer, any_rule(Module, _, _, Layer, _), Layers0),
    list_to_set(Layers0, All),
    (   All == []
    ->  throw_error(existence_error(layer, Module), _,
                    'there are no rules: write Head <- Body')
    ;   Layers \== all,
        member(Name, Layers),
        \+ memberchk(Name, All)
    ->  atomic_list_concat(All, ', ', Listed),
        near_text(Name, All, Near),
        format(atom(Text), 'there is no layer ~w; there are: ~w~w',
               [Name, Listed, Near]),
        throw_error(existence_error(layer, Name), _, Text)
    ;   true
    ),
    forall(layer_rule(Run, Head, Body, Clause),
           ( must_be_defined(Body, Run, Clause),
             must_have_motor(Head, Clause) )),
    must_be_defined(Until, Run, until).

must_have_motor(Head, Clause) :-
    (   Head = set(Port, _),
        atom(Port),
        \+ ( member(Class, ['tacho-motor', 'dc-motor']),
             device_(Class, Port, _) )
    ->  clause_text(Clause, Where),
        findall(Other, device_('tacho-motor', Other, _), Ports),
        atomic_list_concat(Ports, ', ', Listed),
        near_text(Port, Ports, Near),
        format(atom(Text), 'there is no motor at ~w; there are: ~w; in ~w~w',
               [Port, Listed, Where, Near]),
        throw_error(existence_error(motor, Port), _, Text)
    ;   true
    ).

near_text(Name, Names, Near) :-
    (   nearly(Name, Names, Other)
    ->  format(atom(Near), '. Did you mean ~w?', [Other])
    ;   Near = ''
    ).

must_be_defined(_:_, _, _) :- !.
must_be_defined('$prolog'(_), _, _) :- !.
must_be_defined('$not'(_, A), Run, Clause) :-
    !,
    must_be_defined(A, Run, Clause).
must_be_defined(Body, Run, Clause) :-
    compound(Body),
    Body =.. [Operator, A, B],
    memberchk(Operator, [(','), (;), (->)]),
    !,
    must_be_defined(A, Run, Clause),
    must_be_defined(B, Run, Clause).
must_be_defined(sense(Sense, _), Run, Clause) :-
    !,
    (   var(Sense)
    ->  true
    ;   must_be_sense(Sense, Run, Clause)
    ).
must_be_defined(val(Fluent, _), Run, Clause) :-
    !,
    must_be_fluent(Fluent, Run, Clause).
must_be_defined(was(Fluent, _, _), Run, Clause) :-
    !,
    must_be_fluent(Fluent, Run, Clause).
must_be_defined(Goal, Run, Clause) :-
    Run = run(module: Module),
    functor(Goal, Name, Arity),
    functor(General, Name, Arity),
    (   is_relation(Run, Goal)
    ->  true
    ;   predicate_property(Module:General, visible)
    ->  true
    ;   findall(Other,
                ( any_rule(Module, Head, _, _, _), functor(Head, Other, _) ),
                Others0),
        sort(Others0, Others),
        undefined(relation, Name/Arity, Name, Others, Clause)
    ).

must_be_sense(Sense, Run, Clause) :-
    (   memberchk(Sense, [time, pose])
    ->  true
    ;   is_relation_of(Run, sense(Sense, _))
    ->  true
    ;   reading_at(Sense, _, _)
    ->  true
    ;   Run = run(module: Module),
        findall(Other,
                (   member(Other, [time, pose])
                ;   any_rule(Module, sense(Other, _), _, _, _),
                    atom(Other)
                ;   reading_of(Other, _, _, _)
                ),
                Others0),
        sort(Others0, Others),
        functor(Sense, Name, _),
        undefined(sense, Sense, Name, Others, Clause)
    ).

must_be_fluent(Fluent, Run, Clause) :-
    Run = run(module: Module),
    (   any_rule(Module, assign(Fluent, _), _, _, _)
    ->  true
    ;   findall(Other,
                ( any_rule(Module, assign(Head, _), _, _, _),
                  nonvar(Head),
                  functor(Head, Other, _) ),
                Others0),
        sort(Others0, Others),
        functor(Fluent, Name, _),
        undefined(fluent, Fluent, Name, Others, Clause)
    ).

undefined(Kind, What, Name, Others, Clause) :-
    near_text(Name, Others, Near),
    clause_text(Clause, Where),
    shown(What, Shown),
    format(atom(Text), 'there is no ~w ~w, in ~w~w',
           [Kind, Shown, Where, Near]),
    throw_error(existence_error(Kind, What), control/1, Text).

% ---------------- WHY

%   The journal gets a proof without references to clauses.

steps(Proof, Steps) :-
    steps_(Proof, Steps0),
    list_to_set(Steps0, Steps).

steps_([], []).
steps_([by(Head, Clause)|Proof], [by(Head, Layer, Place)|Steps]) :-
    !,
    layer_and_place(Clause, Layer, Place),
    steps_(Proof, Steps).
steps_([Step|Proof], [Step|Steps]) :-
    steps_(Proof, Steps).

%   why(Fluent) of library(ev3dev/journal), about the run of this thread, or
%   the last one

:- multifile ev3dev_causes:explained/3, prolog:message//1.

ev3dev_causes:explained(Fluent, fluent(Value, Since, Place),
                        ev3dev(why_fluent(Fluent, Value, Since, Layer,
                                          Place))) :-
    ground(Fluent),
    last_run(Id, _),
    fluent(Id, Fluent, Value, Since, Clause),
    !,
    layer_and_place(Clause, Layer, Place).

prolog:message(ev3dev(why_fluent(Fluent, Value, Since, Layer, Place))) -->
    [ '~p is ~p, since ~2f s: '-[Fluent, Value, Since] ],
    step_words(by(assign(Fluent, Value), Layer, Place)).
