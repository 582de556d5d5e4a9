:- module(ev3dev_golog_context,
          [ context/3,                  % +Module, +Options, -Context
            context_module/2,           % +Context, -Module
            context_option/2,           % ?Option, +Context
            entered/4,                  % +Kind, +Call, +Context0, -Context
            call_of/3,                  % +Condition, +Goal, +Context
            stepping/2,                 % +Context0, -Context
            recording/3,                % +Number, +Context0, -Context
            triggered/3,                % +Condition, +Context0, -Context
            recorded_step/3,            % +Context, -Number, -Triggers
            print_once/3,               % +Module, +Kind, +Message
            print_again/1,              % +Module
            blocked/2,                  % +Action, +Condition
            unblock/0,
            was_blocked/2               % -Action, -Condition
          ]).
:- use_module(theory, [located/3]).
:- use_module('../errors', [goal_of_program/1, throw_error/3]).

/** <module> What the interpreter carries along

A context is `x(Module, Options, Calls, Record)`. Module holds the domain.
Options are words of this run: `online`, `assume` (what gexec/2 means),
`simulate`. Calls are the procedures entered since the step began. Record is
`none`, or record(Number, Triggers, Tail) of the step that an online run
takes: Triggers is a partial list that ends in Tail, of the conditions of the
interrupts in which the step is found, the outermost first.
*/

%!  context(+Module, +Options, -Context) is det.
%!  context_module(+Context, -Module) is det.
%!  context_option(?Option, +Context) is semidet.

context(Module, Options, x(Module, Options, [], none)).

context_module(x(Module, _, _, _), Module).

context_option(Option, x(_, Options, _, _)) :-
    memberchk(Option, Options).

%!  stepping(+Context0, -Context) is det.
%
%   A new step begins: no procedure has been entered, nothing is recorded.

stepping(x(M, O, _, _), x(M, O, [], none)).

%!  recording(+Number, +Context0, -Context) is det.
%!  triggered(+Condition, +Context0, -Context) is det.
%!  recorded_step(+Context, -Number, -Triggers) is det.
%
%   For the explanation of an action: a step Number begins; it is found within
%   an interrupt whose Condition holds; Triggers are these conditions, the
%   innermost first. Backtracking undoes what was recorded.

recording(Number, x(M, O, _, _), x(M, O, [], record(Number, Ts, Ts))).

triggered(Condition, x(M, O, Calls, Record0), x(M, O, Calls, Record)) :-
    (   Record0 = record(Number, Triggers, [Condition|Tail])
    ->  Record = record(Number, Triggers, Tail)
    ;   Record = Record0
    ).

recorded_step(x(_, _, _, record(Number, Partial, _)), Number, Triggers) :-
    reversed(Partial, [], Triggers).

reversed(Partial, Triggers0, Triggers) :-
    (   var(Partial)
    ->  Triggers = Triggers0
    ;   Partial = [Trigger|Rest],
        reversed(Rest, [Trigger|Triggers0], Triggers)
    ).

%!  entered(+Kind, +Call, +Context0, -Context) is det.
%
%   The step enters the procedure Call.
%
%   @error domain_error(golog_procedure, Call) if it has entered the same call
%          already: there is nothing that would end this

entered(Kind, Call, x(M, O, Calls, Record),
        x(M, O, [c(Kind, Call)|Calls], Record)) :-
    (   again(Calls, Kind, Call, 0)
    ->  located(M, proc(Call), Where),
        format(atom(Text), '~wcyclic: ~q comes to itself again without a \c
                            step or a test in between', [Where, Call]),
        throw_error(domain_error(golog_procedure, Call), _, Text)
    ;   true
    ).

again([c(Kind0, Call0)|Calls], Kind, Call, N) :-
    (   Kind0 == Kind,
        Call0 =@= Call
    ->  true
    ;   N < 2000
    ->  N1 is N+1,
        again(Calls, Kind, Call, N1)
    ;   true
    ).

%!  call_of(+Condition, :Goal, +Context) is nondet.
%
%   Call the Prolog Goal that Condition is, with fluents replaced.
%
%   @error existence_error(golog_condition, Name/Arity)

call_of(Condition, Goal, x(M, _, _, _)) :-
    catch(goal_of_program(M:Goal),
          error(existence_error(procedure, PI), Where),
          no_predicate(PI, Where, Condition, Goal, M)).

no_predicate(PI, Where0, Condition, Goal, M) :-
    strip_module(PI, _, Name/Arity),
    (   functor(Goal, Name, Arity)
    ->  located(M, in_program(Condition), Where),
        format(atom(Text), '~wthere is no fluent, condition or predicate \c
                            ~q', [Where, Name/Arity]),
        throw_error(existence_error(golog_condition, Name/Arity), _, Text)
    ;   throw(error(existence_error(procedure, PI), Where0))
    ).

%!  print_once(+Module, +Kind, +Message) is det.
%!  print_again(+Module) is det.
%
%   Print golog(Message), unless this was done with the same text since
%   print_again(Module).

:- thread_local printed/2.

print_once(Module, Kind, Message) :-
    arg(1, Message, Text),
    (   printed(Module, Text)
    ->  true
    ;   assertz(printed(Module, Text)),
        print_message(Kind, golog(Message))
    ).

print_again(Module) :-
    retractall(printed(Module, _)).

%!  blocked(+Action, +Condition) is det.
%!  was_blocked(-Action, -Condition) is semidet.
%!  unblock is det.
%
%   Remember the first Action of a step that was not possible, and its
%   precondition. Backtracking does not undo it.

:- thread_local blocked_/2.

blocked(Action, Condition) :-
    (   blocked_(_, _)
    ->  true
    ;   assertz(blocked_(Action, Condition))
    ).

unblock :-
    retractall(blocked_(_, _)).

was_blocked(Action, Condition) :-
    blocked_(Action, Condition),
    !.
