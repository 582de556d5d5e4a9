:- module(ev3dev_watched_run,
          [ watched_run/2               % +Seconds, :Goal
          ]).
:- set_prolog_flag(generate_debug_info, false).
:- use_module(last_goal, [outcome/2, watched/4]).
:- use_module('../basics/small_lists', [append_lists/3, one_of/2]).
:- use_module('../errors/error_texts',
              [clause_place/2, place_first/2, shown/2]).
:- use_module('../errors/frames', [program/1]).
:- use_module('../errors/message_text', [message_text/2]).
:- use_module('../native/native', [now_/1]).
:- use_module('../run/waits', [leave/2, listening/3]).

/** <module> A run of a program that is to be explained

`try` and `mark` make one more run of a program that has not earned all
points. In its process, this module prints what it finds out, each in a line
that begins with `ev3dev-why` and a tab, and what ended the program in one
that begins with `ev3dev-end`.
*/

:- meta_predicate watched_run(+, 0).

:- dynamic recurs/1.                    % Name/Arity

%!  watched_run(+Seconds, :Goal) is det.
%
%   Call Goal for Seconds of the robot's time, and print why it may not have
%   done what was asked.

watched_run(Seconds, _:Goal) :-
    outcome(true, _),                   % watches from now on
    functor(Goal, Name, Arity),
    (   current_predicate(user:Name/Arity)
    ->  runs(Seconds, Goal)
    ;   findall(Other, other_goal(Other), Others),
        instead(Others, Name, Instead),
        line(end, 'there is no ~q/~d~w', [Name, Arity, Instead])
    ).

runs(Seconds, Goal) :-
    now_(Now),
    Until is Now+Seconds,
    watch(Goal),
    bound_stack,
    timeless(Goal),
    outcome(listening(0.1, ev3dev_watched_run:tick(Until), user:Goal),
            Outcome),
    said(Outcome, Goal),
    forall(thought(Thought, Cm, At), said_thought(Thought, Cm, At)).

%   The longest thought of the run, if the robot drove meanwhile.

:- dynamic thought/3.                   % Seconds, Cm, Place
:- multifile ev3dev_watchdog:heard_thought/3.

ev3dev_watchdog:heard_thought(Seconds, Cm, Place) :-
    Cm >= 1,
    (   ev3dev_watched_run:thought(Longest, _, _),
        Longest >= Seconds
    ->  true
    ;   retractall(ev3dev_watched_run:thought(_, _, _)),
        assertz(ev3dev_watched_run:thought(Seconds, Cm, Place))
    ).

said_thought(Seconds, Cm, Place) :-
    (   Place = at(Predicate, File, Line)
    ->  format(atom(Where), '~w:~d: ', [File, Line]),
        format(atom(In), ' in ~w', [Predicate])
    ;   Where = '',
        In = ''
    ),
    why('~won the brick your program thought for ~1f s~w, and the robot \c
         drove ~0f cm meanwhile', [Where, Seconds, In, Cm]).

%   So it is full before the time of its processor is over.

:- if((current_prolog_flag(version, Version), Version >= 70714)).

bound_stack :-
    set_prolog_flag(stack_limit, 100000000).

:- else.

bound_stack.

:- endif.

tick(Until, Listener) :-
    now_(Now),
    (   Now < Until
    ->  true
    ;   leave(Listener, ev3dev_time_is_over)
    ).

why(Format, Arguments) :-
    line(why, Format, Arguments).

line(Kind, Format, Arguments) :-
    format(user_error, 'ev3dev-~w\t', [Kind]),
    format(user_error, Format, Arguments),
    nl(user_error).

%   A page ends a run by balls of its own.

:- multifile ends_run/1.
:- dynamic ends_run/1.

said(true, _).
said(false, Goal) :-
    said_by(ev3dev(failed(Goal))).
said(thrown(Ball), _) :-
    (   ends_run(Ball)
    ->  throw(Ball)
    ;   Ball == ev3dev_time_is_over
    ->  forall(endless(Text), why('~w', [Text]))
    ;   (   of_rule(Ball)
        ->  nb_setval(ev3dev_last_goal, [])
        ;   true
        ),
        said_by(ev3dev(thrown(Ball)))
    ).

%   The message names the rule whose guard or action is to blame.

of_rule(error(_, Context)) :-
    nonvar(Context),
    Context = context(_, Text),
    atom(Text),
    sub_atom(Text, _, _, _, ' of rule '),
    !.

said_by(Message) :-
    message_text(Message, Text),
    normalize_space(atom(Line), Text),
    line(end, '~w', [Line]).

% ---------------- NO SUCH GOAL

%   A predicate without arguments that no clause of the program calls.

other_goal(Name) :-
    program(File),
    source_file(user:Head, File),
    functor(Head, Name, 0),
    \+ calls(_, user:Name).

instead([], _, '').
instead([Other|Others], Name, Instead) :-
    (   one_of([Other|Others], Near),
        dwim_match(Name, Near)
    ->  true
    ;   Others == [],
        Near = Other
    ),
    !,
    format(atom(Instead), ': your file has ~q/0, so call that ~q',
           [Near, Name]).
instead(_, _, '').

% ---------------- WHAT CALLS WHAT

calls(Caller, Called) :-
    watched(Clause, _, Head, Tail),
    clause_property(Clause, predicate(Caller0)),
    Caller0 = Module:Name/Arity,
    functor(Plain, Name, Arity),
    Caller = Module:Plain,
    (   Head = _:_,
        Called = Head
    ;   Tail = tail(_, _, Of:Name1/Arity1),
        functor(Plain1, Name1, Arity1),
        Called = Of:Plain1
    ).

reachable(Goal, Called) :-
    functor(Goal, Name, Arity),
    functor(Head, Name, Arity),
    reached([user:Head], [], All),
    one_of(All, Called).

reached([], All, All).
reached([Head|Heads], Seen, All) :-
    (   one_of(Seen, Before),
        Before =@= Head
    ->  reached(Heads, Seen, All)
    ;   findall(Called, ( calls(Caller, Called), Caller =@= Head ), Calls),
        append_lists(Calls, Heads, Heads1),
        reached(Heads1, [Head|Seen], All)
    ).

place_of(Called, Place) :-
    watched(Clause, _, Head, Tail),
    (   Head = _:_,
        Head =@= Called
    ->  true
    ;   Tail = tail(_, _, _:Name/Arity),
        Called = _:Plain,
        functor(Plain, Name, Arity)
    ),
    clause_place(Clause, Where),
    !,
    place_first(Where, Place).
place_of(_, '').

%   What looks at another clock than the robot's.

timeless(Goal) :-
    findall(Advice,
            ( reachable(Goal, _:Called),
              functor(Called, Name, Arity),
              of_wall(Name/Arity, Instead),
              place_of(user:Called, Place),
              format(atom(Advice), '~w~q does not follow the robot\'s \c
                     time: use ~w', [Place, Name/Arity, Instead]) ),
            Advices),
    forall(one_of(Advices, Advice), why('~w', [Advice])).

of_wall(sleep/1, 'wait/1').
of_wall(get_time/1, 'ev3_time/1').
of_wall(thread_get_message/3, 'wait/1').
of_wall(call_with_time_limit/2, 'library(ev3dev/events)').
of_wall(alarm/3, 'library(ev3dev/events)').
of_wall(alarm/4, 'library(ev3dev/events)').

% ---------------- CALLS ITSELF WITHOUT END

watch(Goal) :-
    forall(( reachable(Goal, Module:Head),
             \+ predicate_property(Module:Head, imported_from(_)),
             reachable(Head, Module:Again),
             calls(Module:Again, Module:Head0),
             Head0 =@= Head ),
           ( functor(Head, Name, Arity), note_recursion(Name/Arity) )).

note_recursion(Predicate) :-
    (   recurs(Predicate)
    ->  true
    ;   assertz(recurs(Predicate)),
        key(Predicate, Key),
        nb_setval(Key, [])
    ).

key(Name/Arity, Key) :-
    atomic_list_concat([ev3dev_recurs, Name, Arity], ' ', Key).

%   The first two calls, the last one, and their number.

:- multifile ev3dev_last_goal:noted/3.

ev3dev_last_goal:noted(_, _, Goal) :-
    ev3dev_watched_run:counted(Goal).

counted(Goal0) :-
    ( Goal0 = _:Goal -> true ; Goal = Goal0 ),
    callable(Goal),
    functor(Goal, Name, Arity),
    recurs(Name/Arity),
    '$term_size'(Goal, 100, _),
    key(Name/Arity, Key),
    nb_getval(Key, Calls0),
    (   Calls0 = calls(Count0, First, Second, _)
    ->  Count is Count0+1,
        nb_setval(Key, calls(Count, First, Second, Goal))
    ;   Calls0 = [First]
    ->  nb_setval(Key, calls(2, First, Goal, Goal))
    ;   nb_setval(Key, [Goal])
    ).

endless(Text) :-
    recurs(Name/Arity),
    key(Name/Arity, Key),
    nb_getval(Key, calls(Count, First, Second, Last)),
    Count > 3,
    (   Arity =:= 0
    ->  fail
    ;   arg(Index, First, A1),
        arg(Index, Second, A2),
        arg(Index, Last, A3),
        away(A1, A2, A3, Count, Advice)
    ),
    !,
    shown(First, Shown1),
    shown(Second, Shown2),
    format(atom(Text), '~q calls itself without end: ~w, then ~w, and so \c
           on~w', [Name/Arity, Shown1, Shown2, Advice]).

%   An argument that grows, as nothing computes it; or one that counts.

away(A1, A2, _, _, Advice) :-
    compound(A2),
    A2 =.. [Operator|Parts],
    memberchk(Operator, [+, -, *, /, //]),
    one_of(Parts, Part),
    Part == A1,
    !,
    format(atom(Advice), '. A number such as ~w is computed by is/2 alone',
           [A2]).
away(A1, A2, A3, Count, '') :-
    integer(A1),
    integer(A2),
    integer(A3),
    Step is A2-A1,
    Step =\= 0,
    A3 =:= A1 + (Count-1)*Step.
