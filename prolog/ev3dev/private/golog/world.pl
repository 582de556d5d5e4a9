:- module(ev3dev_golog_world,
          [ robot_kind/2,               % +Module, -Robot
            queue_of/2,                 % +Module, -Queue
            send_exogenous/2,           % +Module, +Code
            agent_begins/1,             % +Module
            agent_ends/1,               % +Module
            watch_begins/1,             % +Module
            exogenous_noticed/3,        % +Agent, -New, -All
            exogenous_seen/2,           % +Agent, -Actions
            stops_run/1,                % +Code
            message_seen/2,             % +Message, +Agent
            executed/7,                 % +Action, +History, :Watch, +For,
                                        % +Agent, -Outcome, -Value
            sensing_entries/4,          % +Action, +Value, +Module, -Entries
            run_directly/4,             % +Action, +Module, -Outcome, -Value
            ask/2,                      % +Action, -Value
            code_of_number/3            % +Number, +Module, -Action
          ]).
:- use_module(library(lists), [append/3, member/2]).
:- use_module(theory,
              [ has_clauses/2, has_possible_values/1, is_sensing_action/2,
                located/3, rules_out/2
              ]).
:- use_module(queue,
              [queue_end/1, queue_new/1, queue_put/2, queue_take/2]).
:- use_module(steps, [agent_of/3]).
:- use_module(waiting,
              [for_causes/2, guarded/2, run_on_bricks/4, run_watched/3]).
:- use_module('../run/brick', [brick/1, of_brick/1]).
:- use_module('../errors/errors', [throw_error/3]).
:- use_module('../errors/frames', [goal_of_program/1]).

/** <module> The world: how actions are executed, and what happens by itself

An Agent is agent(Module, Robot, Queue, Device): where its domain is, whether
the domain is about the robot, the queue of its exogenous actions, and the
closure of the option `device`.
*/

% ---------------- QUEUES

:- dynamic
    queue/3,                            % Brick, Module, Queue
    running/2.                          % Brick, Module
:- of_brick([running/2]).
:- multifile ev3dev_brick:forget/1.

ev3dev_brick:forget(Brick) :-
    forall(retract(queue(Brick, _, Queue)), queue_end(Queue)).

%!  robot_kind(+Module, -Robot) is det.
%
%   Robot is `robot` if the domain names goals of the robot, `polled` if it
%   has to be asked for exogenous actions, else `none`.

robot_kind(Module, Robot) :-
    (   member(Head, [ robot_action(_, _), robot_action(_, _, _),
                       robot_sense(_, _, _), robot_exog(_, _) ]),
        has_clauses(Module, Head)
    ->  Robot = robot
    ;   has_clauses(Module, exog_occurs(_))
    ->  Robot = polled
    ;   Robot = none
    ).

%!  queue_of(+Module, -Queue) is det.

queue_of(Module, Queue) :-
    brick(Brick),
    with_mutex(ev3dev_golog,
               (   queue(Brick, Module, Queue0)
               ->  true
               ;   queue_new(Queue0),
                   assertz(queue(Brick, Module, Queue0))
               )),
    Queue = Queue0.

%!  send_exogenous(+Module, +Code) is det.
%
%   Put Code into the queue of the agent in Module. If Module has no domain,
%   into those of all agents that run on this brick.
%
%   @error existence_error(exogenous_action, Code) if it is one for none of
%          these

send_exogenous(Module, Code) :-
    brick(Brick),
    (   \+ running(Brick, Module),
        \+ has_clauses(Module, exog_action(_)),
        findall(M, running(Brick, M), Modules0),
        sort(Modules0, Modules),
        Modules \== []
    ->  true
    ;   Modules = [Module]
    ),
    (   member(M, Modules),
        exogenous_of(Code, M, _)
    ->  true
    ;   throw_error(existence_error(exogenous_action, Code), _,
                    'no exog_action/1 of the domain declares it')
    ),
    forall(member(M, Modules),
           ( queue_of(M, Queue),
             queue_put(Queue, exogenous(Code)) )).

%!  agent_begins(+Module) is det.
%!  agent_ends(+Module) is det.
%
%   An agent with its domain in Module runs from now on, or no longer.

agent_begins(Module) :-
    brick(Brick),
    assertz(running(Brick, Module)).

agent_ends(Module) :-
    (   brick(Brick),
        retract(running(Brick, Module))
    ->  true
    ;   true
    ).

% ---------------- EXOGENOUS ACTIONS

:- thread_local
    seen/2,                             % Module, Action
    noticed/2,                          % Module, Action
    held/3.                             % Module, Clause, Action

%!  watch_begins(+Module) is det.
%
%   Nothing has been seen yet. A condition of robot_exog/2 that holds already
%   is seen as one that begins to hold.

watch_begins(Module) :-
    retractall(held(Module, _, _)),
    retractall(seen(Module, _)),
    retractall(noticed(Module, _)).

%!  exogenous_seen(+Agent, -Actions) is det.
%
%   Actions are the exogenous actions that have happened since this was asked
%   last, in the order of their arrival: new(Action), or noticed(Action) if
%   exogenous_noticed/3 has answered it.

exogenous_seen(Agent, Actions) :-
    look_around(Agent),
    asked_domain(Agent),
    Agent = agent(Module, _, _, _),
    findall(noticed(Action), retract(noticed(Module, Action)), Actions0),
    findall(new(Action), retract(seen(Module, Action)), Actions1),
    append(Actions0, Actions1, Actions).

%!  exogenous_noticed(+Agent, -New, -All) is det.
%
%   While an action is under way: New are the exogenous actions that were not
%   seen before, All are those that are not in the history yet.

exogenous_noticed(Agent, New, All) :-
    look_around(Agent),
    Agent = agent(Module, _, _, _),
    findall(Action, retract(seen(Module, Action)), New),
    forall(member(Action, New), assertz(noticed(Module, Action))),
    findall(Action, noticed(Module, Action), All).

%   look_around(+Agent) is det.
%   Take what the queue has, and see which conditions of robot_exog/2 have
%   begun to hold.

look_around(Agent) :-
    Agent = agent(Module, Robot, Queue, _),
    take_messages(Queue, Module),
    (   Robot == robot,
        has_clauses(Module, robot_exog(_, _))
    ->  look_at_robot(Module)
    ;   true
    ).

take_messages(Queue, Module) :-
    (   queue_take(Queue, exogenous(Code))
    ->  seen_code(Code, Module),
        take_messages(Queue, Module)
    ;   true
    ).

%!  message_seen(+Message, +Agent) is det.
%
%   Message was taken from the queue; `none` if there was none.

message_seen(Message, agent(Module, _, _, _)) :-
    (   Message = exogenous(Code)
    ->  seen_code(Code, Module)
    ;   true
    ).

look_at_robot(Module) :-
    forall(clause(Module:robot_exog(Action, Condition), Body, Ref),
           look_at(Ref, Action, Condition, Body, Module)).

look_at(Ref, Action, Condition, Body, Module) :-
    guarded(robot_exog(Action),
            findall(Action,
                    ( call(Module:Body),
                      goal_of_program(Module:Condition) ),
                    Actions0)),
    sort(Actions0, Actions),
    forall(( held(Module, Ref, Old), \+ memberchk(Old, Actions) ),
           retract(held(Module, Ref, Old))),
    forall(( member(New, Actions), \+ held(Module, Ref, New) ),
           ( assertz(held(Module, Ref, New)),
             seen_code(New, Module) )).

%   The domain's own exog_occurs/1: a list is all there is; after a single
%   action it is asked again.

asked_domain(agent(Module, _, _, _)) :-
    (   has_clauses(Module, exog_occurs(_))
    ->  ask_domain(Module)
    ;   true
    ).

ask_domain(Module) :-
    (   Module:exog_occurs(Answer)
    ->  (   is_list(Answer)
        ->  forall(member(Code, Answer), seen_code(Code, Module))
        ;   seen_code(Answer, Module, Known),
            Known == true
        ->  ask_domain(Module)
        ;   true
        )
    ;   true
    ).

seen_code(Code, Module) :-
    seen_code(Code, Module, Known),
    (   Known == true
    ->  true
    ;   memberchk(Code, [true, nil])
    ->  true
    ;   print_message(informational, golog(no_exogenous(Code)))
    ).

seen_code(Code, Module, Known) :-
    (   exogenous_of(Code, Module, Action)
    ->  assertz(seen(Module, Action)),
        Known = true
    ;   Known = false
    ).

exogenous_of(Code, Module, Action) :-
    (   is_declared(Code, Module)
    ->  Action = Code
    ;   stops_run(Code)
    ->  Action = Code
    ;   translated(Code, Module, Action),
        is_declared(Action, Module)
    ).

%   Another thread may ask, which has no notes on Module.

is_declared(Action, Module) :-
    nonvar(Action),
    has_clauses(Module, exog_action(_)),
    \+ \+ Module:exog_action(Action).

%!  stops_run(+Code) is semidet.
%
%   True if IndiGolog takes Code for a message to itself: end the run.

stops_run(Code) :-
    nonvar(Code),
    memberchk(Code, [end_indi, halt_indi, halt_exec, abort_exec]).

translated(Code, Module, Action) :-
    has_clauses(Module, translate_exog(_, _)),
    Module:translate_exog(Code, Action),
    !.
translated(Code, Module, Action) :-
    has_clauses(Module, translateExogAction(_, _)),
    Module:translateExogAction(Code, Action),
    !.
translated(Code, Module, Action) :-
    code_of_number(Code, Module, Action).

%!  code_of_number(+Number, +Module, -Action) is semidet.

code_of_number(Number, Module, Action) :-
    has_clauses(Module, actionNum(_, _)),
    Module:actionNum(Action, Number),
    !.

% ---------------- EXECUTION

%!  executed(+Action, +History, :Watch, +For, +Agent, -Outcome,
%!           -Value) is det.
%
%   Execute Action in the world. Outcome is `done`, `failed` or `interrupted`.
%   Value is what the action sensed, or unbound. Action may also be a step, a
%   list of actions. For is for(Causes, Seconds): its causes in the journal,
%   and the time that is left, or `infinite`.

:- meta_predicate executed(+, +, 0, +, +, -, -).

executed(A, H, Watch, For, Agent, Outcome, Value) :-
    Agent = agent(M, _, _, _),
    (   on_bricks(A, M, Parts)
    ->  run_on_bricks(Parts, For, Watch, Outcome)
    ;   A = [_|_],
        is_list(A)
    ->  each_executed(A, H, Watch, For, Agent, Outcome)
    ;   For = for(Causes, _),
        for_causes(Causes,
                   ev3dev_golog_world:executed_here(A, H, Watch, Agent,
                                                    Outcome, Value))
    ).

%   on_bricks(+Action, +Module, -Parts) is semidet: Parts is a list of
%   part(Agent, Action, Goal), one for each action of a step.

on_bricks(A, M, Parts) :-
    has_clauses(M, robot_action(_, _, _)),
    (   is_list(A)
    ->  parts(A, M, Parts),
        Parts = [_|_]
    ;   parts([A], M, Parts)
    ).

parts([], _, []).
parts([A|As], M, [part(R, A, M:Goal)|Parts]) :-
    agent_of(A, R, M),
    M:robot_action(R, A, Goal),
    !,
    parts(As, M, Parts).

%   Nothing says how they are done at the same time: one after the other.

each_executed([], _H, _Watch, _For, _Agent, done).
each_executed([A|As], H, Watch, For, Agent, Outcome) :-
    executed(A, H, Watch, For, Agent, Outcome0, _),
    (   Outcome0 == done
    ->  each_executed(As, H, Watch, For, Agent, Outcome)
    ;   Outcome = Outcome0
    ).

:- public executed_here/6.

executed_here(A, H, Watch, Agent, Outcome, Value) :-
    Agent = agent(M, _, _, _),
    (   has_clauses(M, robot_sense(_, _, _)),
        M:robot_sense(A, Value0, Goal)
    ->  run_watched(M:Goal, Watch, Outcome),
        Value = Value0
    ;   has_clauses(M, robot_action(_, _)),
        M:robot_action(A, Goal)
    ->  run_watched(M:Goal, Watch, Outcome)
    ;   has_clauses(M, how_to_execute(_, _, _))
    ->  (   M:how_to_execute(A, Device, Code)
        ->  code_run(A, Device, Code, Agent, Outcome0, Value0),
            (   Value0 == failed
            ->  Outcome = failed
            ;   Outcome = Outcome0,
                value_translated(A, Value0, M, Value)
            )
        ;   unmapped_run(A, Agent, Outcome, Value)
        )
    ;   has_clauses(M, execute(_, _, _))
    ->  outcome(M:execute(A, H, Value0), Outcome),
        Value = Value0
    ;   has_clauses(M, execute(_, _))
    ->  outcome(M:execute(A, Value0), Outcome),
        Value = Value0
    ;   has_clauses(M, actionNum(_, _)),
        M:actionNum(A, Number),
        has_clauses(M, sendRcxActionNumber(_, _))
    ->  outcome(M:sendRcxActionNumber(Number, Value0), Outcome),
        value_translated(A, Value0, M, Value)
    ;   dry(A, M, Outcome, Value)
    ).

outcome(Goal, Outcome) :-
    (   goal_of_program(Goal)
    ->  Outcome = done
    ;   Outcome = failed
    ).

%   Nobody says how: the action happens in the history only.

dry(A, M, Outcome, Value) :-
    dry(A, dry(A), M, Outcome, Value).

dry(A, Message, M, done, Value) :-
    (   is_sensing_action(A, M)
    ->  ask(A, Value)
    ;   located(M, action(A), Where),
        print_message(informational, golog(placed(Where, Message)))
    ).

%!  run_directly(+Action, +Module, -Outcome, -Value) is det.
%
%   Execute Action by the robot's table, else not at all.

run_directly(A, M, Outcome, Value) :-
    (   on_bricks(A, M, Parts)
    ->  run_on_bricks(Parts, for([], infinite), fail, Outcome)
    ;   has_clauses(M, robot_sense(_, _, _)),
        M:robot_sense(A, Value, Goal)
    ->  outcome(M:Goal, Outcome)
    ;   has_clauses(M, robot_action(_, _)),
        M:robot_action(A, Goal)
    ->  outcome(M:Goal, Outcome)
    ;   dry(A, M, Outcome, Value)
    ).

%!  ask(+Action, -Value) is det.
%
%   Ask the user what Action senses. Value stays unbound at the end of the
%   input.

ask(A, Value) :-
    print_message(help, golog(asked(A))),
    read(Value0),
    (   Value0 == end_of_file
    ->  true
    ;   Value = Value0
    ).

code_run(A, Device, Code, agent(M, _, _, Closure), Outcome, Value) :-
    (   Closure = device(Goal)
    ->  device_call(Goal, Device, Code, Value, Called),
        outcome(Called, Outcome)
    ;   is_sensing_action(A, M),
        callable(Code),
        extended(Code, [Value], Called),
        is_defined(M:Called)
    ->  outcome(M:Called, Outcome)
    ;   callable(Code),
        is_defined(M:Code)
    ->  outcome(M:Code, Outcome)
    ;   dry(A, dry(A, Device, Code), M, Outcome, Value)
    ).

%   An action without how_to_execute/3 is for the device `simulator`, as in
%   full IndiGolog. It is not called as a goal: its name may be that of
%   anything.

unmapped_run(A, Agent, Outcome, Value) :-
    Agent = agent(M, _, _, Closure),
    (   Closure = device(_)
    ->  code_run(A, simulator, A, Agent, Outcome, Value0),
        value_translated(A, Value0, M, Value)
    ;   dry(A, M, Outcome, Value)
    ).

%   The closure has three more arguments: device, code and value; or two: code
%   and value; or one: the code.

device_call(Module:Closure, Device, Code, Value, Module:Goal) :-
    (   member(More, [[Device, Code, Value], [Code, Value], [Code]]),
        extended(Closure, More, Goal),
        is_defined(Module:Goal)
    ->  true
    ;   extended(Closure, [Device, Code, Value], Goal)
    ).

extended(Goal0, More, Goal) :-
    Goal0 =.. List0,
    append(List0, More, List),
    Goal =.. List.

is_defined(Module:Goal) :-
    functor(Goal, Name, Arity),
    functor(Head, Name, Arity),
    (   predicate_property(Module:Head, number_of_clauses(_))
    ;   predicate_property(Module:Head, foreign)
    ;   predicate_property(Module:Head, built_in)
    ),
    !.

value_translated(A, Value0, M, Value) :-
    (   nonvar(Value0),
        has_clauses(M, translate_sensing(_, _, _)),
        M:translate_sensing(A, Value0, Value1)
    ->  Value = Value1
    ;   nonvar(Value0),
        has_clauses(M, translateSensing(_, _, _)),
        M:translateSensing(A, Value0, Value1)
    ->  Value = Value1
    ;   Value = Value0
    ).

%!  sensing_entries(+Action, +Value, +Module, -Entries) is det.
%
%   Entries are what the history gets for Value: e(Action, Value) if senses/5,
%   settles/5 or rejects/5 says what follows from it, else e(Fluent, Value)
%   for each Fluent of senses/2.

sensing_entries(A, Value, M, Entries) :-
    (   has_clauses(M, senses(_, _, _Fluent, _, _)),
        \+ \+ M:senses(A, _, _Of, _, _)
    ->  Entries = [e(A, Value)]
    ;   has_possible_values(M),
        rules_out(A, M)
    ->  Entries = [e(A, Value)]
    ;   has_clauses(M, senses(_, _))
    ->  findall(e(F, Value), M:senses(A, F), Entries)
    ;   Entries = []
    ).
