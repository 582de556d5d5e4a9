:- module(ev3dev_recorder,
          [ record/2,                   % :Goal, +Bytes
            recorded_goal/1,            % ?Goal
            event/5,                    % ?Number, ?Port, ?Node, ?Data, ..
            moment/4,                   % ?Moment, ?Time, ?Pose, ..
            lost/1,                     % ?Count
            goal/4,                     % +Parent, :Goal, :Exec, -Node
            unified/2,                  % +Node, +Clause
            local/2,                    % +Node, -Inner
            cut/1,                      % +Node
            leaf/3,                     % +How, +Node, :Goal
            recovered/3,                % +Node, +Ball, :Goal
            recorded/2,                 % +Node, :Goal
            recorded/3,
            recorded/4,
            recorded/5,
            recorded/6,
            recorded/7,
            recorded/8
          ]).
:- set_prolog_flag(generate_debug_info, false).
:- use_module(instrument, [instrument/0, translate/4]).
:- use_module('../errors/errors', [throw_error/3]).
:- use_module('../errors/frames', [in_pack/3]).
:- use_module('../native/native',
              [commands_/1, sim_active_/0, sim_pose_/3, sim_time_/1]).

/** <module> The recorder of what Prolog does

instrument.pl makes twins of the program's clauses. Their goals call goal/4
here, which notes: the goal is called, it has succeeded, it is tried again,
it has failed. A node is one call; its number is that of its first event. An
exception is noted where it is caught: who reads the events infers that the
goals between have been left, as they have neither succeeded nor failed.

A node that Prolog can try again has a choice point. So goal/4 compares the
topmost choice point before and after the goal: this is all that is needed to
know whether an exit is the last one, and whether a cut drops anything.

The backtrackable global variable `ev3dev_reasoning` is the node of the pack
in which the thread is, or [] if nothing is recorded, or `off`. A predicate of
the pack that calls a goal of the program, through goal_of_program/1, so calls
it here. Other threads do not have the variable, so they are not recorded.
*/

:- meta_predicate
    record(0, +),
    recorded(+, 0),
    leaf(+, 0),
    leaf(+, +, 0),
    recovered(+, +, 0),
    switched(+, +, 0).

:- dynamic
    event/5,
    moment/4,
    recorded_goal/1,
    lost/1,
    records/1.                          % Thread
:- volatile
    event/5,
    moment/4,
    recorded_goal/1,
    lost/1,
    records/1.

%   No node is deeper: a program that calls itself without end needs its
%   memory. What is below runs, and is not recorded.
deepest(30000).

%!  record(:Goal, +Bytes) is nondet.
%!  recorded_goal(?Goal) is semidet.
%!  event(?Number, ?Port, ?Node, ?Data, ?Moment) is nondet.
%!  moment(?Moment, ?Time, ?Pose, ?Commands) is nondet.
%!  lost(?Count) is semidet.
%
%   Call Goal, and note what happens in about that many Bytes. The
%   others are the record: events.pl explains them. Of a call Node is the
%   parent. Count events have been forgotten.
%
%   @error permission_error(record, goal, Goal) while another thread records

record(Goal, Bytes) :-
    with_mutex(ev3dev_reasoning, begin(Thread)),
    (   thread_self(Thread)
    ->  true
    ;   format(atom(Why), 'thread ~w records already: one goal at a time',
               [Thread]),
        throw_error(permission_error(record, goal, Goal), reasoning/1, Why)
    ),
    instrument,
    retractall(event(_, _, _Node, _, _)),
    retractall(moment(_, _Time, _, _)),
    retractall(recorded_goal(_)),
    retractall(lost(_)),
    copy_term_nat(Goal, Copy),
    assertz(recorded_goal(Copy)),
    flag(ev3dev_reasoning_record, Record, Record+1),
    nb_setval(ev3dev_reasoning_room, Bytes),
    nb_setval(ev3dev_reasoning_next, 1),
    nb_setval(ev3dev_reasoning_oldest, 0),
    (   predicate_property(sim_active_, foreign)
    ->  nb_setval(ev3dev_reasoning_time, none)
    ;   nb_setval(ev3dev_reasoning_time, never)
    ),
    nb_setval(ev3dev_reasoning_moment, 0),
    Node = node(0, 0, 0, 0),
    setup_call_catcher_cleanup(
        true,
        switched(Node, [], recorded(Node, Goal)),
        How,
        ended(How)).

%   Thread records from now on: this one, unless another one does.

begin(Thread) :-
    (   records(Thread),
        catch(thread_property(Thread, status(running)), error(_, _), fail)
    ->  true
    ;   retractall(records(_)),
        thread_self(Thread),
        assertz(records(Thread))
    ).

ended(How) :-
    retractall(records(_)),
    (   memberchk(How, [exception(Ball), external_exception(Ball)])
    ->  note(caught, 0, Ball)
    ;   true
    ).

%   Inside Goal the variable is In, and outside Out.

switched(In, Out, Goal) :-
    b_setval(ev3dev_reasoning, In),
    call(Goal),
    b_setval(ev3dev_reasoning, Out).

% ---------------- WHAT THE TWINS CALL

%!  goal(+Parent, :Goal, :Exec, -Node) is nondet.
%
%   Exec runs Goal, a goal in the clause of Parent, as a new Node.

goal(node(Parent, _, _, Depth), Goal, _, _) :-
    deepest(Deepest),
    Depth >= Deepest,
    !,
    (   Depth =:= Deepest
    ->  note(deep, Parent, Deepest)
    ;   true
    ),
    leaf(silent, Goal).
goal(node(Parent, _, _, Depth0), Goal, Exec, Node) :-
    Depth is Depth0+1,
    Goal = _:Plain,
    note(call, Id, Parent, Plain),
    (   prolog_current_choice(Choice),
        Node = node(Id, Choice, Id, Depth),
        call(Exec),
        prolog_current_choice(Now),
        (   Now == Choice
        ->  !,
            note(exit, Id, Plain)
        ;   (   note(more, Id, Plain)
            ;   note(redo, Id, []),
                fail
            )
        )
    ;   note(fail, Id, []),
        fail
    ).

%!  unified(+Node, +Clause) is det.

unified(node(Id, _, _, _), Clause) :-
    note(unify, Id, Clause).

%!  local(+Node, -Inner) is det.
%
%   Inner is Node in a condition or a call/1, where a cut is local.

local(node(Id, _, _, Depth), node(Id, Choice, Next, Depth)) :-
    nb_getval(ev3dev_reasoning_next, Next),
    prolog_current_choice(Choice).

%!  cut(+Node) is det.
%
%   The next goal drops the choice points since that of Node.

cut(node(Id, Choice, Since, _)) :-
    prolog_current_choice(Now),
    (   Now == Choice
    ->  true
    ;   note(cut, Id, Since)
    ).

%!  leaf(+How, +Node, :Goal) is nondet.
%
%   Call Goal of the pack. What it calls of the program is below Node.

leaf(silent, _, Goal) :-
    leaf(off, Goal).
leaf(recorded, Node, Goal) :-
    leaf(Node, Goal).

leaf(Node, Goal) :-
    nb_getval(ev3dev_reasoning, Before),
    switched(Node, Before, Goal).

%!  recorded(+Node, :Goal) is nondet.
%!  recorded(+Node, :Goal, ?Argument1) is nondet.
%!  recorded(+Node, :Goal, ?Argument1, ?Argument2) is nondet.
%!  recorded(+Node, :Goal, ?Argument1, ?Argument2, ?Argument3) is nondet.
%!  recorded(+N, :G, ?A1, ?A2, ?A3, ?A4) is nondet.
%!  recorded(+N, :G, ?A1, ?A2, ?A3, ?A4, ?A5) is nondet.
%!  recorded(+N, :G, ?A1, ?A2, ?A3, ?A4, ?A5, ?A6) is nondet.
%
%   Call Goal in Node, which calls its argument. More arguments may follow. A
%   goal of the pack's own has no node.

recorded(Node, Goal) :-
    (   nb_current(ev3dev_reasoning, Current),
        Current \== [],
        Current \== off,
        strip_module(Goal, Module, Plain),
        callable(Plain),
        \+ in_pack(Module:x/0, _, _),
        translate(Plain, Module, Inner, Recorded)
    ->  local(Node, Inner),
        call(Recorded)
    ;   call(Goal)
    ).

recorded(N, G, A) :-
    with(G, [A], Goal),
    recorded(N, Goal).
recorded(N, G, A, B) :-
    with(G, [A, B], Goal),
    recorded(N, Goal).
recorded(N, G, A, B, C) :-
    with(G, [A, B, C], Goal),
    recorded(N, Goal).
recorded(N, G, A, B, C, D) :-
    with(G, [A, B, C, D], Goal),
    recorded(N, Goal).
recorded(N, G, A, B, C, D, E) :-
    with(G, [A, B, C, D, E], Goal),
    recorded(N, Goal).
recorded(N, G, A, B, C, D, E, F) :-
    with(G, [A, B, C, D, E, F], Goal),
    recorded(N, Goal).

with(Goal0, More, Module:Goal) :-
    strip_module(Goal0, Module, Plain),
    (   callable(Plain)
    ->  Plain =.. Parts0,
        '$append'(Parts0, More, Parts),
        Goal =.. Parts
    ;   Goal =.. [call, Plain|More]
    ).

:- multifile
    ev3dev_frames:calls_program/1,
    ev3dev_frames:labelled/3,
    ev3dev_frames:recorded/2.
:- dynamic
    ev3dev_frames:labelled/3,
    ev3dev_frames:recorded/2.

ev3dev_frames:calls_program(ev3dev_recorder:goal/4).

ev3dev_frames:recorded(Node, Goal) :-
    ev3dev_recorder:recorded(Node, Goal).

ev3dev_frames:labelled(Node, Label, Goal) :-
    ev3dev_recorder:labelled(Node, Label, Goal).

%   Goal is below a node of its own, ev3dev_guard(Label, Goal). The guard
%   `true` has none.

labelled(Node, Label, Module:Goal) :-
    (   nb_current(ev3dev_reasoning, Current),
        Current \== [],
        Current \== off,
        Goal \== true
    ->  local(Node, Outer),
        goal(Outer, Module:ev3dev_guard(Label, Goal),
             ev3dev_recorder:recorded(Inner, Module:Goal), Inner)
    ;   recorded(Node, Module:Goal)
    ).

%!  recovered(+Node, +Ball, :Goal) is nondet.
%
%   Node, a catch/3, has caught Ball and calls Goal.

recovered(Node, Ball, Goal) :-
    (   nb_current(ev3dev_reasoning, Current),
        Current \== []
    ->  Node = node(Id, _, _, _),
        note(caught, Id, Ball)
    ;   true
    ),
    recorded(Node, Goal).

% ---------------- NOTES

note(Port, Id, Data) :-
    note(Port, Id, Id, Data).

%   A new call: its number is that of the event.

note(Port, Id0, Parent, Data) :-
    nb_getval(ev3dev_reasoning_next, Number),
    Next is Number+1,
    nb_setval(ev3dev_reasoning_next, Next),
    (   Port == call
    ->  Id0 = Number
    ;   true
    ),
    bounded(Data, Bounded, Size),
    moment_now(Moment),
    assertz(event(Number, Port, Parent, Bounded, Moment)),
    nb_getval(ev3dev_reasoning_room, Room0),
    Room is Room0-Size,
    nb_setval(ev3dev_reasoning_room, Room),
    (   Room < 0
    ->  forget
    ;   true
    ).

%   A large term keeps its beginning. A cell has 8 bytes; an event without
%   its term has about 120.

bounded(Term, Bounded, Size) :-
    (   atomic(Term)
    ->  Bounded = Term,
        Size = 120
    ;   '$term_size'(Term, 100, Cells),
        acyclic_term(Term)
    ->  (   term_attvars(Term, [])
        ->  Bounded = Term
        ;   copy_term_nat(Term, Bounded)
        ),
        Size is 120+8*Cells
    ;   shortened(Term, 6, Bounded),
        '$term_size'(Bounded, _, Cells),
        Size is 120+8*Cells
    ).

shortened(Term, Depth, Short) :-
    (   compound(Term)
    ->  (   Depth =:= 0
        ->  Short = ...
        ;   Depth1 is Depth-1,
            compound_name_arguments(Term, Name, Arguments0),
            shortened_all(Arguments0, 8, Depth1, Arguments),
            compound_name_arguments(Short, Name, Arguments)
        )
    ;   attvar(Term)
    ->  true
    ;   Short = Term
    ).

shortened_all([], _, _, []).
shortened_all([Term|Terms], Left, Depth, Shorts) :-
    (   Left =:= 0
    ->  Shorts = [...]
    ;   Shorts = [Short|Shorts1],
        Left1 is Left-1,
        shortened(Term, Depth, Short),
        shortened_all(Terms, Left1, Depth, Shorts1)
    ).

%   Three quarters of the room are for the latest events, the first quarter is
%   for the earliest.

forget :-
    nb_getval(ev3dev_reasoning_oldest, Oldest0),
    nb_getval(ev3dev_reasoning_next, Next),
    (   Oldest0 =:= 0
    ->  Oldest is Next//4
    ;   Oldest = Oldest0
    ),
    forget(Oldest).

forget(Number) :-
    Next is Number+1,
    nb_setval(ev3dev_reasoning_oldest, Next),
    (   retract(event(Number, _, _, Data, _))
    ->  '$term_size'(Data, _, Cells),
        nb_getval(ev3dev_reasoning_room, Room0),
        Room is Room0+120+8*Cells,
        nb_setval(ev3dev_reasoning_room, Room),
        ( retract(lost(Count0)) -> true ; Count0 = 0 ),
        Count is Count0+1,
        assertz(lost(Count))
    ;   true
    ).

%   A moment is new if simulated time has moved, or a motor got a command.

moment_now(Moment) :-
    nb_getval(ev3dev_reasoning_moment, Moment0),
    nb_getval(ev3dev_reasoning_time, Last),
    (   Last \== never,
        sim_active_
    ->  sim_time_(Time),
        commands_(Commands),
        (   Last == Time/Commands
        ->  Moment = Moment0
        ;   Moment is Moment0+1,
            nb_setval(ev3dev_reasoning_time, Time/Commands),
            nb_setval(ev3dev_reasoning_moment, Moment),
            (   sim_pose_(X, Y, Heading)
            ->  Pose = pose(X, Y, Heading)
            ;   Pose = none
            ),
            assertz(moment(Moment, Time, Pose, Commands))
        )
    ;   Moment = Moment0
    ).

%   The twins call what is exported here.

:- initialization(
       ( module_property(ev3dev_recorder, exports(Predicates)),
         forall('$member'(Predicate, Predicates),
                ev3dev_recorded:import(ev3dev_recorder:Predicate)) ),
       now).
