:- module(ev3dev_golog_run,
          [ run_online/5,               % +Module, +Program, +Settings,
                                        % -Reason, -History
            recorded_history/1,         % -History
            situation_of_run/4,         % +History, +Module, -Situation,
                                        % +Context
            state_of_run/3,             % +Module, -Program, -Situation
            reason_place/3              % +Reason, +Module, -Text
          ]).
:- use_module('../basics/fields',
              [fields/1, goal_expansion/2, term_expansion/2]).
:- use_module(library(lists), [append/3, member/2, reverse/2]).
:- use_module(context,
              [ context/3, context_module/2, print_again/1, recorded_notes/2,
                recorded_step/3, recording/4, unblock/0, was_blocked/2,
                was_given_up/2
              ]).
:- use_module(progression, [done/4, entries_done/4, situation/3]).
:- use_module(situation,
              [history_shortened/3, situation_count/2, situation_history/2]).
:- use_module(effort, [how_far/2, in_trial/1]).
:- use_module(queue, [queue_put/2]).
:- use_module(programs, [parts/5]).
:- use_module(search, [replanned_since/1]).
:- use_module(theory,
              [has_clauses/2, is_kind/3, located/3, prepare/1, proc_place/4]).
:- use_module(transitions,
              [ higher_can_step/3, is_final/3, is_preempted/4,
                made_possible/4, program_shown/2, simplified/3, step/5
              ]).
:- use_module(waiting,
              [ causes_wanted/1, clock/2, followed/1, pause/4,
                robot_stopped/2, report_again/0
              ]).
:- use_module(world,
              [ agent_begins/1, agent_ends/1, executed/7, exogenous_seen/2,
                exogenous_noticed/3, message_seen/2, queue_of/2, robot_kind/2,
                sensing_entries/4, stops_run/1, watch_begins/1
              ]).

:- fields(now(module, situation, program)).
:- fields(began(cpu, clock)).
:- fields(cycle(context, agent, settings, deadline, again)).
:- fields(run_settings(words, trace, on_failed, device, limit, timeout,
                       initial, keep)).

/** <module> The online run of a program

The cycle: what has happened by itself enters the history; if the program may
end, the run ends; else the first step that the program offers is taken, and
its action executed. Settings are
run_settings(Words, Trace, OnFailed, Device, Limit, Timeout, Initial, Keep).
*/

%!  run_online(+Module, +Program, +Settings, -Reason, -History) is det.
%
%   Run Program. Reason says why the run ended. Exceptions are passed on, the
%   motors stopped and finalize/0 called.

run_online(M, E, Settings, Reason, History) :-
    Settings = run_settings(words: Words, device: Device, timeout: Timeout,
                            initial: Initial, keep: Keep),
    prepare(M),
    print_again(M),
    context(M, [online|Words], X),
    robot_kind(M, Robot),
    queue_of(M, Queue),
    Agent = agent(M, Robot, Queue, Device),
    situation(Initial, S, X),
    simplified(E, E1, X),
    Ended = ended(none),
    situation_noted(Outer),
    setup_call_catcher_cleanup(
        begun(M, Initial, Keep),
        ( b_setval(ev3dev_golog_now, now(M, S, E1)),
          initialized(M),
          deadline(Timeout, Robot, Deadline),
          cycle(at(E1, S, quiet), 0,
                cycle(X, Agent, Settings, Deadline, again(0)), Reason),
          nb_setarg(1, Ended, Reason) ),
        Catcher,
        finished(M, Robot, Ended, Catcher)),
    b_setval(ev3dev_golog_now, Outer),
    recorded_history(History).

begun(M, Initial, Keep) :-
    agent_begins(M),
    watch_begins(M),
    report_again,
    retractall(failed(_)),
    retractall(entry_record(_, _)),
    retractall(keeps(_)),
    assertz(keeps(Keep)),
    reverse(Initial, Entries),
    record_all(Entries, 0).

initialized(M) :-
    ignore_if_defined(M, initialize).

finished(M, Robot, ended(Reason0), Catcher) :-
    agent_ends(M),
    (   nb_current(ev3dev_golog_now, now(M, S, E))
    ->  nb_setval(ev3dev_golog_last, last(M, S, E))
    ;   true
    ),
    (   Reason0 == final
    ->  true
    ;   ( Reason0 == none -> Reason = Catcher ; Reason = Reason0 ),
        robot_stopped(Robot, golog(ended(Reason)))
    ),
    ignore_if_defined(M, finalize).

ignore_if_defined(M, Goal) :-
    (   has_clauses(M, Goal)
    ->  ignore(M:Goal)
    ;   true
    ).

deadline(Timeout, Robot, Deadline) :-
    (   Timeout == infinite
    ->  Deadline = infinite
    ;   clock(Robot, Now),
        Deadline is Now+Timeout
    ).

is_over(Cycle) :-
    Cycle = cycle(agent: agent(_, Robot, _, _), deadline: Deadline),
    Deadline \== infinite,
    clock(Robot, Now),
    Now >= Deadline.

time_left(Cycle, Left) :-
    Cycle = cycle(agent: agent(_, Robot, _, _), deadline: Deadline),
    (   Deadline == infinite
    ->  Left = infinite
    ;   clock(Robot, Now),
        Left is max(0, Deadline-Now)
    ).

% ---------------- RECORD

:- thread_local
    entry_record/2,                    % Count, Entry
    keeps/1.

record_all([], _).
record_all([Entry|Entries], C0) :-
    C is C0+1,
    record(C, Entry),
    record_all(Entries, C).

%   The newest thousand entries, unless all are wanted

record(C, Entry) :-
    assertz(entry_record(C, Entry)),
    (   keeps(all)
    ->  true
    ;   Old is C-1000,
        retractall(entry_record(Old, _))
    ).

%!  recorded_history(-History) is det.
%
%   History is that of the run that is under way in this thread, or that was
%   the last; only its newest thousand entries, unless all were wanted.

recorded_history(History) :-
    findall(Entry, entry_record(_, Entry), Entries),
    reverse(Entries, History).

%!  situation_of_run(+History, +Module, -Situation, +Context) is semidet.
%
%   While a program of Module runs: Situation is that after History, if this
%   is what recorded_history/1 answers, or more after it. Nothing is computed
%   again, and what the record has forgotten still counts.

situation_of_run(History, Module, S, X) :-
    nb_current(ev3dev_golog_now, now(Module, S0, _)),
    situation_count(S0, C),
    entry_record(C, Newest),
    C1 is C+1,
    \+ entry_record(C1, _),
    append(More, [Entry|Before], History),
    Entry == Newest,
    recorded_history(Now),
    [Entry|Before] == Now,
    !,
    reverse(More, Entries),
    entries_done(Entries, S0, S, X).

%   The situation of the cycle is linked, not copied, into one term for the
%   whole run. A global variable that is set at each step would keep all
%   situations.

note_state(E, S) :-
    b_getval(ev3dev_golog_now, Now),
    link_field(Now, now(situation: S)),
    link_field(Now, now(program: E)).

%!  state_of_run(+Module, -Program, -Situation) is semidet.
%
%   Program and Situation are those of the run of Module in this thread, or of
%   the last one.

state_of_run(Module, E, S) :-
    (   nb_current(ev3dev_golog_now, now(Module, S0, E0))
    ->  true
    ;   nb_current(ev3dev_golog_last, last(Module, S0, E0))
    ),
    S = S0,
    E = E0.

%!  reason_place(+Reason, +Module, -Text) is det.
%
%   Text is `File:Line: Clause: ` of what made the last run end for Reason, or
%   empty: the precondition, or the procedure that cannot go on.

reason_place(Reason, M, Text) :-
    (   place_of(Reason, M, What)
    ->  located(M, What, Text)
    ;   Text = ''
    ).

place_of(not_possible(A, Condition), _, precondition(A, Condition)).
place_of(failed(A), _, executes(A)).
place_of(no_step(_), M, What) :-
    stuck(M, What).
place_of(gave_up(_, _), M, What) :-
    stuck(M, What).

stuck(M, proc(Call)) :-
    state_of_run(M, E, _),
    innermost(E, M, Call).

%   innermost(+Program, +Module, -Call) is semidet: Call is the procedure, or
%   has its functor, that Program is in or begins with.

innermost(E, M, Call) :-
    nonvar(E),
    (   parts(E, _, Parts, _, _),
        member(Part, Parts),
        innermost(Part, M, Call0)
    ->  Call = Call0
    ;   E = '$within'(proc(Name/Arity), _)
    ->  functor(Call, Name, Arity)
    ;   is_kind(proc, E, M)
    ->  Call = E
    ).

situation_noted(Now) :-
    (   nb_current(ev3dev_golog_now, Now0)
    ->  Now = Now0
    ;   Now = none
    ).

% ---------------- CYCLE

%   cycle(+State, +Steps, +Run, -Reason). A state is at(Program, Situation,
%   News). News is `news` if an exogenous action has come since the last
%   primitive action and since the last wait, else `quiet`. A run is
%   cycle(Context, Agent, Settings, Deadline, Again): again(N) counts how
%   often in a row a step was given up for news, in place.

cycle(State0, Steps0, R0, Reason) :-
    R0 = cycle(agent: Agent, settings: Settings),
    exogenous_seen(Agent, Actions),
    happened(Actions, State0, at(E, S1, News), R0, Stop),
    note_state(E, S1),
    Steps is Steps0+1,
    watching(Steps, S1, R0, R),
    Settings = run_settings(limit: Limit),
    (   Stop == stop
    ->  Reason = stopped
    ;   may_end(E, S1, R, Left)
    ->  ending(Left, at(E, S1, News), Steps0, R0, Reason)
    ;   Limit \== infinite,
        Steps0 >= Limit
    ->  Reason = limit
    ;   is_over(R)
    ->  Reason = timeout
    ;   shortened(Steps, S1, S),
        taken(at(E, S, News), R, State, Next),
        (   Next == on
        ->  cycle(State, Steps, R0, Reason)
        ;   Reason = Next
        )
    ).

%   watching(+Number, +Situation, +Run0, -Run): Run has the context of the
%   step Number, during which watched/5 is called.

watching(Number, S, R0, R) :-
    R0 = cycle(X0, Agent, Settings, Deadline, Again),
    statistics(cputime, Now),
    Watch = watched(S, R0, began(Now, none)),
    recording(Number, ev3dev_golog_run:Watch, X0, X),
    R = cycle(X, Agent, Settings, Deadline, Again).

%   Left is unbound, or why the question was given up.

may_end(E, S, Cycle, Left) :-
    Cycle = cycle(context: X),
    catch(is_final(E, S, X), '$golog_left'(Left), true).

ending(Left, State, Steps, R, Reason) :-
    (   var(Left)
    ->  Reason = final
    ;   Left == on
    ->  cycle(State, Steps, R, Reason)
    ;   Reason = Left
    ).

shortened(Steps, S0, S) :-
    (   Steps mod 500 =:= 0
    ->  history_shortened(200, S0, S)
    ;   S = S0
    ).

%   Exogenous actions enter the history.

happened([], State, State, _, go).
happened([Seen|As], State0, State, R, Stop) :-
    arg(1, Seen, A),
    (   stops_run(A)
    ->  State = State0,
        Stop = stop
    ;   (   Seen = new(_)
        ->  traced(exog(A), R)
        ;   true
        ),
        State0 = at(E, S0, _),
        entered(A, S0, S, R),
        happened(As, at(E, S, news), State, R, Stop)
    ).

entered(Entry, S0, S, R) :-
    R = cycle(context: X),
    done(Entry, S0, S, X),
    situation_count(S, C),
    record(C, Entry).

entered_all([], S, S, _).
entered_all([Entry|Entries], S0, S, R) :-
    entered(Entry, S0, S1, R),
    entered_all(Entries, S1, S, R).

traced(Event, R) :-
    R = cycle(settings: Settings),
    Settings = run_settings(trace: Trace),
    (   Trace = trace(Closure)
    ->  ignore(call(Closure, Event))
    ;   true
    ),
    (   Event = step(_)
    ->  true
    ;   followed(Event)
    ).

%   taken(+State0, +Run, -State, -Next): the first step. Next is `on` or the
%   reason why the run ends.

taken(State0, R, State, Next) :-
    R = cycle(context: X),
    State0 = at(E0, S0, _),
    unblock,
    (   catch(step(E0, S0, E1, S1, X), '$golog_left'(Why),
              (   Left = Why,
                  E1 = E0,
                  S1 = S0 )),
        performed_or_left(Left, E1, S1, State0, R, at(E2, S, News), Next0)
    ->  simplified(E2, E, X),
        State = at(E, S, News),
        Next = Next0,
        traced_step(E, R)
    ;   was_given_up(Limit, Far)
    ->  Next = gave_up(Limit, Far)
    ;   was_blocked(A, Condition)
    ->  Next = not_possible(A, Condition)
    ;   program_shown(E0, E),
        Next = no_step(E)
    ).

performed_or_left(Left, E, S, State0, R, State, Next) :-
    (   var(Left)
    ->  performed(E, S, State0, R, State, Next),
        R = cycle(again: Again),
        nb_setarg(1, Again, 0)
    ;   State = State0,
        Next = Left
    ).

%   watched(+Situation, +Run, +Began, +Record, +Effort): the step that is
%   looked for in Situation is given up if the time of the run is up, or if
%   something has happened meanwhile. It is called every 15 ms, see effort.pl.
%   Began is began(Cpu, Seconds): what it had computed, and the robot's clock
%   when this was called last, in place.
%
%   On a virtual clock no time passes while a program computes, so that of the
%   wall counts for the limit, and the robot need not be asked. The step is
%   looked for again after what has happened, but at most three times in a
%   row, unless a part with a higher priority can take one now.

:- public watched/5.

watched(S0, R, Began, Record, Effort) :-
    (   is_over(R, Began, Effort)
    ->  how_far(Effort, Far),
        print_message(informational, golog(out_of_time(Far))),
        left(timeout)
    ;   R = cycle(agent: Agent0),
        seen_meanwhile(Agent0, Began, Effort, New, All),
        forall(member(A, New), traced(exog(A), R)),
        New = [_|_],
        is_for_news(New, All, S0, R, Record)
    ->  left(on)
    ;   true
    ).

left(Why) :-
    throw('$golog_left'(Why)).

is_over(R, _, Effort) :-
    \+ in_trial(Effort),
    is_over(R),
    !.
is_over(Cycle, began(Cpu0, _), _) :-
    Cycle = cycle(settings: Settings),
    Settings = run_settings(timeout: Timeout),
    Timeout \== infinite,
    statistics(cputime, Cpu),
    Cpu-Cpu0 >= Timeout.

seen_meanwhile(agent(M, Robot0, Queue, Device), Began, Effort, New, All) :-
    (   Robot0 == robot,
        stands_still(Began, Effort)
    ->  Robot = none
    ;   Robot = Robot0
    ),
    exogenous_noticed(agent(M, Robot, Queue, Device), New, All).

stands_still(Began, Effort) :-
    (   in_trial(Effort)
    ->  true
    ;   Began = began(_, Before),
        clock(robot, Now),
        set_field(Began, began(clock: Now)),
        ( Before == none ; Now =:= Before )
    ),
    !.

is_for_news(New, All, S0, Cycle, Record) :-
    Cycle = cycle(context: X, again: Again),
    (   member(A, New),
        stops_run(A)
    ->  true
    ;   arg(1, Again, Times),
        Times < 3
    ->  Times1 is Times+1,
        nb_setarg(1, Again, Times1)
    ;   entries_done(All, S0, S, X),
        recorded_notes(Record, Notes),
        higher_can_step(Notes, S, X)
    ).

traced_step(E0, R) :-
    R = cycle(settings: Settings),
    (   Settings = run_settings(trace: none)
    ->  true
    ;   forall(replanned_since(Again), traced(replanned(Again), R)),
        program_shown(E0, E),
        traced(step(E), R)
    ).

%   performed(+Program, +Situation, +State0, +Run, -State, -Next) is semidet:
%   carry out what the step from State0 to Program and Situation added to the
%   history. Fails if another step is to be tried.

performed(E, S, State0, R, State, Next) :-
    State0 = at(_, S0, News),
    situation_count(S0, C0),
    situation_count(S, C),
    (   C =:= C0
    ->  State = at(E, S0, News),
        Next = on
    ;   More is C-C0,
        newest(More, S, [Entry|Before]),
        record_before(Before, C),
        (   mark(Entry, Use),
            R = cycle(context: X),
            context_module(X, M),
            \+ is_kind(action, Entry, M)
        ->  (   Use == wait
            ->  waited(E, State0, R, State),
                Next = on
            ;   Use == kept
            ->  record(C, Entry),
                State = at(E, S, News),
                Next = on
            ;   State = at(E, S0, News),
                Next = Use
            )
        ;   acted(Entry, E, S, State0, R, State, Next)
        )
    ).

%   mark(?Entry, ?Use): Entry is not executed, unless it is an action of the
%   domain. Without `kept` and `wait` it does not enter the history, and Use
%   is what follows.

mark(wait, wait).
mark(commit, on).
mark(branch(_), on).
mark(sim(_), on).
mark(abort, stopped).
mark(set(_), kept).
mark(unset(_), kept).
mark(test(_), kept).
mark(e(_, _), kept).

%   acted(+Action, +Program, +Situation, +State0, +Run, -State, -Next) is
%   semidet: execute Action.

acted(A, E, S1, State0, R, State, Next) :-
    State0 = at(E0, S0, News),
    R = cycle(X, Agent, Settings, _, _),
    Agent = agent(M, Robot, _, _),
    situation_history(S0, History),
    traced(action(A), R),
    (   causes_wanted(Robot)
    ->  causes(A, S0, X, Causes)
    ;   Causes = []
    ),
    time_left(R, Left),
    executed(A, History, ev3dev_golog_run:is_to_end(E0, E, S0, R),
             for(Causes, Left), Agent, Outcome, Value),
    (   Outcome == done,
        sensing_entries(A, Value, M, Entries),
        ( Entries == [] ; nonvar(Value) )
    ->  retractall(failed(A)),
        situation_count(S1, C),
        record(C, A),
        entered_all(Entries, S1, S, R),
        (   Entries == []
        ->  true
        ;   traced(sensed(A, Value), R)
        ),
        State = at(E, S, quiet),
        Next = on
    ;   Outcome == interrupted
    ->  entered(interrupted(A), S0, S, R),
        State = at(E0, S, News),
        Next = on
    ;   Settings = run_settings(on_failed: OnFailed),
        OnFailed \== backtrack,
        entered(failed(A), S0, S, R),
        State = at(E, S, News),
        (   OnFailed == stop
        ->  Next = failed(A)
        ;   failure_reported(A, M),
            Next = on
        )
    ).

%   The failure of an action is reported once, until the action is done.

:- thread_local failed/1.               % Action

failure_reported(A, M) :-
    (   failed(A)
    ->  true
    ;   assertz(failed(A)),
        located(M, executes(A), Where),
        print_message(informational, golog(failed_action(Where, A)))
    ).

%   The causes in library(ev3dev/journal) for the commands of an action: its
%   step, what made it possible, where it stands in the program, and the
%   interrupts that it belongs to.

causes(A, S, X, [golog(Number, A, Condition)|Causes]) :-
    recorded_step(X, Number, Notes),
    made_possible(A, Condition, S, X),
    (   memberchk(proc(Proc), Notes)
    ->  context_module(X, M),
        proc_place(Proc, A, M, Place),
        Causes = [proc(Proc, Place)|Interrupts]
    ;   Causes = Interrupts
    ),
    Interrupt = interrupt(_),
    findall(Interrupt, member(Interrupt, Notes), Interrupts).

%   The newest entries of a situation, and the record of all but the last

newest(N, S, Newest) :-
    situation_history(S, History),
    length(Newest, N),
    append(Newest, _, History),
    !.

record_before([], _).
record_before([Entry|Entries], C1) :-
    C is C1-1,
    record_before(Entries, C),
    record(C, Entry).

%   True if the action that is being executed has to end: something new has
%   happened, and a part of the program with a higher priority can take a step
%   after all that has happened meanwhile; or the time is up.

:- public is_to_end/4.

is_to_end(E0, E, S0, R) :-
    R = cycle(context: X, agent: Agent),
    exogenous_noticed(Agent, New, All),
    forall(member(A, New), traced(exog(A), R)),
    (   is_over(R)
    ->  true
    ;   member(A, All),
        stops_run(A)
    ->  true
    ;   New = [_|_],
        entries_done(All, S0, S, X),
        is_preempted(E0, E, S, X)
    ->  true
    ).

%   waited(+Program, +State0, +Run, -State): Program is what remains after the
%   wait. It returns at once if there is news, else it blocks. State is State0
%   if the time of the run was up before something came.

waited(E, State0, R, State) :-
    State0 = at(_, S0, News),
    R = cycle(agent: Agent, deadline: Deadline),
    Agent = agent(_, Robot, Queue, _),
    (   News == news
    ->  State = at(E, S0, quiet)
    ;   exogenous_seen(Agent, Actions),
        Actions \== []
    ->  happened(Actions, at(E, S0, quiet), at(_, S, _), R, Stop),
        State = at(E, S, quiet),
        (   Stop == stop
        ->  % It is seen by the next cycle.
            queue_put(Queue, exogenous(end_indi))
        ;   true
        )
    ;   is_over(R)
    ->  State = State0
    ;   pause(Robot, Queue, Deadline, Message),
        message_seen(Message, Agent),
        waited(E, State0, R, State)
    ).
