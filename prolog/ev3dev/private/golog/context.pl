:- module(ev3dev_golog_context,
          [ context/3,                  % +Module, +Options, -Context
            context_module/2,           % +Context, -Module
            context_option/2,           % ?Option, +Context
            with_option/3,              % +Option, +Context0, -Context
            context_mode/2,             % +Context, -Mode
            in_mode/3,                  % ?Mode, +Context0, -Context
            dual/2,                     % +Context0, -Context
            entered/4,                  % +Kind, +Call, +Context0, -Context
            place_in/3,                 % +Context, +Kind, -Text
            call_of/3,                  % +Condition, +Goal, +Context
            stepping/2,                 % +Context0, -Context
            recording/4,                % +Number, :Watch, +Context0, -Context
            searching/4,                % +Options, +Limits, +Context0,
                                        % -Context
            context_effort/2,           % +Context, -Effort
            noted/2,                    % +Note, +Context
            is_recorded/1,              % +Context
            recorded_step/3,            % +Context, -Number, -Notes
            recorded_notes/2,           % +Record, -Notes
            print_once/3,               % +Module, +Kind, +Message
            print_again/1,              % +Module
            blocked/2,                  % +Action, +Condition
            unblock/0,
            was_blocked/2,              % -Action, -Condition
            gave_up/2,                  % +Limit, +Far
            was_given_up/2              % -Limit, -Far
          ]).
:- use_module('../basics/fields',
              [fields/1, goal_expansion/2, term_expansion/2]).
:- use_module(effort, [effort/4, watched_effort/3]).
:- use_module(hints, [hint/3]).
:- use_module(theory, [has_possible_values/1, located/3]).
:- use_module('../checks/checks', [must_be/2]).
:- use_module('../errors/errors', [throw_error/3]).
:- use_module('../errors/frames', [goal_of_program/1]).

:- fields(context(module, options, calls, record, effort, mode)).

/** <module> The context of the interpreter

A context is `context(Module, Options, Calls, Record, Effort, Mode)`. Module
holds the domain. Options are words of this run: `online`, `assume` (what
gexec/2 means), `simulate`, `conditional` for a plan with branches. Calls are
the procedures entered since the step began. Record is `none`, or
record(Number, Notes) of the step that an online run takes: Notes is a partial
list, of what noted/2 says of the step, the outermost first. Effort is what
effort.pl counts, or `none`. Mode is what it means that a condition holds:
`plain`; `conditional`, in a plan with branches; or in a domain with possible
values `known`, for all of them, or `possible`, for some. In the mode `stored`
the value of a fluent is the set of these.
*/

%!  context(+Module, +Options, -Context) is det.
%!  context_module(+Context, -Module) is det.
%!  context_option(?Option, +Context) is semidet.
%!  with_option(+Option, +Context0, -Context) is det.

context(Module, Options, context(Module, Options, [], none, none, Mode)) :-
    mode(Options, Module, Mode).

context_module(Context, Module) :-
    Context = context(module: Module).

context_option(Option, Context) :-
    Context = context(options: Options),
    memberchk(Option, Options).

with_option(Option, context(M, Options, Calls, Record, Effort, Mode),
            context(M, [Option|Options], Calls, Record, Effort, Mode)).

mode(Options, Module, Mode) :-
    (   \+ memberchk(conditional, Options)
    ->  (   has_possible_values(Module)
        ->  Mode = known
        ;   Mode = plain
        )
    ;   has_possible_values(Module)
    ->  located(Module, in_program([searchc(_), searchc(_, _)]), Where),
        format(atom(Text), '~wsearchc plans for what senses/2 and senses/5 \c
                            may answer; in a domain with possible values, \c
                            use search', [Where]),
        throw_error(permission_error(search, golog_domain, Module), _, Text)
    ;   Mode = conditional
    ).

%!  context_mode(+Context, -Mode) is det.
%!  in_mode(?Mode, +Context0, -Context) is det.
%!  dual(+Context0, -Context) is det.
%
%   Context is Context0 with Mode; with the other one of `known` and
%   `possible`. Without possible values it is Context0.

context_mode(Context, Mode) :-
    Context = context(mode: Mode).

in_mode(Mode, X0, X) :-
    X0 = context(M, O, C, R, E, Mode0),
    (   ( Mode0 == known ; Mode0 == possible )
    ->  X = context(M, O, C, R, E, Mode)
    ;   X = X0
    ).

dual(X0, X) :-
    X0 = context(M, O, C, R, E, Mode),
    (   Mode == known
    ->  X = context(M, O, C, R, E, possible)
    ;   Mode == possible
    ->  X = context(M, O, C, R, E, known)
    ;   X = X0
    ).

%!  context_effort(+Context, -Effort) is det.

context_effort(Context, Effort) :-
    Context = context(effort: Effort).

%!  searching(+Options, +Limits, +Context0, -Context) is det.
%
%   A search begins, with words of its own; it gives up at Limits, and at
%   those of the searches around it.

searching(Options, Limits, Context,
          context(M, Options, [], none, Effort, Mode)) :-
    Context = context(module: M, effort: Outer),
    mode(Options, M, Mode),
    effort(Limits, Options, Outer, Effort).

%!  stepping(+Context0, -Context) is det.
%
%   A new step begins: no procedure has been entered, nothing is recorded,
%   and nobody watches.

stepping(Context, context(M, O, [], none, none, Mode)) :-
    Context = context(module: M, options: O, mode: Mode).

%!  recording(+Number, :Watch, +Context0, -Context) is det.
%!  noted(+Note, +Context) is det.
%!  recorded_step(+Context, -Number, -Notes) is det.
%
%   A step Number begins, during which Watch is called, see effort.pl. Note is
%   interrupt(Condition) if the step is found within an interrupt whose
%   Condition holds, above(Program) if Program has a higher priority than what
%   takes the step. Notes are these, the innermost first. Backtracking undoes
%   what was noted.

recording(Number, Watch, Context,
          context(M, O, [], Record, Effort, Mode)) :-
    Context = context(module: M, options: O, mode: Mode),
    Record = record(Number, _),
    watched_effort(Watch, Record, Effort).

noted(Note, Context) :-
    Context = context(record: Record),
    (   Record = record(_, Notes)
    ->  ends_in(Notes, Note)
    ;   true
    ).

ends_in(Partial, Note) :-
    (   var(Partial)
    ->  Partial = [Note|_]
    ;   Partial = [_|Rest],
        ends_in(Rest, Note)
    ).

%!  is_recorded(+Context) is semidet.
%
%   True if noted/2 is remembered.

is_recorded(Context) :-
    Context = context(record: record(_, _)).

recorded_step(Context, Number, Notes) :-
    Context = context(record: Record),
    Record = record(Number, _),
    recorded_notes(Record, Notes).

%!  recorded_notes(+Record, -Notes) is det.

recorded_notes(record(_, Partial), Notes) :-
    reversed(Partial, [], Notes).
recorded_notes(none, []).

reversed(Partial, Notes0, Notes) :-
    (   var(Partial)
    ->  Notes = Notes0
    ;   Partial = [Note|Rest],
        reversed(Rest, [Note|Notes0], Notes)
    ).

%!  entered(+Kind, +Call, +Context0, -Context) is det.
%
%   The step enters the procedure Call.
%
%   @error domain_error(golog_procedure, Call) if it has entered the same call
%          already: there is nothing that would end this

entered(Kind, Call, context(M, O, Calls, Record, Effort, Mode),
        context(M, O, [c(Kind, Call)|Calls], Record, Effort, Mode)) :-
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

%!  place_in(+Context, +Kind, -Text) is det.
%
%   Text is `File:Line: Clause: ` of the procedure that the step is in; else
%   of the one that has a variable in the place of a Kind, `program` or
%   `condition`; or empty.

place_in(context(M, _, Calls, Record, _, _), Kind, Text) :-
    (   Calls = [c(_, Call)|_]
    ->  true
    ;   recorded_notes(Record, Notes),
        memberchk(proc(Name/Arity), Notes)
    ->  functor(Call, Name, Arity)
    ;   true
    ),
    (   nonvar(Call)
    ->  located(M, proc(Call), Text)
    ;   located(M, open(Kind), Text)
    ).

%!  call_of(+Condition, :Goal, +Context) is nondet.
%
%   Call the Prolog Goal that Condition is, with fluents replaced.
%
%   @error existence_error(golog_condition, Name/Arity)
%   @error type_error(callable, Goal)

call_of(Condition, Goal, Context) :-
    Context = context(module: M),
    (   callable(Goal)
    ->  true
    ;   must_be(callable, Goal)
    ),
    catch(goal_of_program(M:Goal),
          error(existence_error(procedure, PI), Where),
          no_predicate(PI, Where, Condition, Goal, M)).

no_predicate(PI, Where0, Condition, Goal, M) :-
    strip_module(PI, _, Name/Arity),
    (   functor(Goal, Name, Arity)
    ->  functor(Named, Name, Arity),
        located(M, in_program([Condition, Named]), Where),
        hint(Goal, M, Hint),
        format(atom(Text), '~wthere is no fluent, condition or predicate \c
                            ~q~w', [Where, Name/Arity, Hint]),
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

:- thread_local
    blocked_/2,
    gave_up_/2.

blocked(Action, Condition) :-
    (   blocked_(_, _)
    ->  true
    ;   assertz(blocked_(Action, Condition))
    ).

unblock :-
    retractall(blocked_(_, _)),
    retractall(gave_up_(_, _)).

was_blocked(Action, Condition) :-
    blocked_(Action, Condition),
    !.

%!  gave_up(+Limit, +Far) is det.
%!  was_given_up(-Limit, -Far) is semidet.
%
%   Remember the first search of a step that gave up at its Limit, and how Far
%   it came. unblock/0 forgets it.

gave_up(Limit, Far) :-
    assertz(gave_up_(Limit, Far)).

was_given_up(Limit, Far) :-
    gave_up_(Limit, Far),
    !.
