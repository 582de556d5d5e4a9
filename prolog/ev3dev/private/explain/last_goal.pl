:- module(ev3dev_last_goal,
          [ watch_goals/1,              % +Query
            forget_goals/0,
            goals_end/0,
            spare_memory/0,
            watched/4,                  % ?Clause, ?PC, -Called, -Tail
            outcome/2,                  % :Goal, -Outcome
            report/2,                   % +Outcome, +Goal
            last_goal/3,                % -Goal, -In, -Place
            used_robot/0
          ]).
:- set_prolog_flag(generate_debug_info, false).
:- use_module(error_messages, [call_line/3, in_words//1, short/2]).
:- use_module('../basics/small_lists', [one_of/2]).
:- use_module('../errors/error_texts', [shown/2]).
:- use_module('../errors/frames', [in_pack/3, program/1]).
:- use_module('../native/native', [thought_begins_/1, thought_nothing_/2]).

/** <module> The goal of a program that was called last

A goal that has failed leaves no trace behind, and neither does the frame of a
clause that has made its last call: an error in that call knows the clause no
more. So watch_goals/1 sets a break point at each goal of the program's own
clauses, where Prolog calls a hook and goes on. The hook notes the goal with
its arguments. What was noted last is the goal that threw, or that a program
called last before it failed.

Neither listing/1 nor clause/2 sees these break points, and last calls remain
last calls. A note takes a microsecond on a PC. The debugger knows, too, but
it keeps the frames of all last calls, for which a program that runs for hours
has no room.

Newer Prologs have no break point at a last call that reuses the arguments of
its clause, its tail here. So the goal before it calls passing/2, which notes
the tail when that goal has succeeded.

The clauses of libraries are not watched, nor what threads call, nor what
cleans up after a goal.

A loop that only computes takes ten nanoseconds a round, so notes would make
it a hundred times as slow. After some thousand notes without a goal of the
pack, each break point that is met is removed, up to the next goal of the
pack; from then on fewer notes are enough. While one is missing, nobody knows
the last goal.
*/

:- meta_predicate outcome(0, -).

:- dynamic
    watched/4,
    uses_robot/2,                       % Clause, PC
    removed/2,                          % Clause, PC; of all it is `none`
    done/2.                             % File, when it was changed

%!  watch_goals(+Query) is det.
%
%   Watch all programs that are loaded now; no goal of Query has been called.
%   A debugger has its own break points, and while it traces, those here would
%   be in its way. In version 10.1 nothing is watched, except in a page.

watch_goals(Query) :-
    nb_setval(ev3dev_last_goal, []),
    nb_setval(ev3dev_used_robot, false),
    nb_setval(ev3dev_notes, 0),
    first_most(Most),
    nb_setval(ev3dev_most_notes, Most),
    retractall(removed(_, none)),
    set_again,
    (   ( current_prolog_flag(debug, true) ; debugs(Query) ; in_use ; unsafe )
    ->  last_calls(gone),
        forget_goals
    ;   last_calls(kept),
        forall(( program_file(File, Time), \+ done(File, Time) ),
               watch_file(File, Time))
    ).

%!  forget_goals is det.
%
%   Watch nothing, until watch_goals/1 is called again.

forget_goals :-
    forall(retract(watched(Clause, PC, _, _)),
           break(Clause, PC, false)),
    retractall(uses_robot(_, _)),
    retractall(removed(_, _)),
    retractall(done(_, _)).

%!  goals_end is det.
%
%   The query has ended: frames of last calls are no longer kept.

goals_end :-
    last_calls(gone).

%!  spare_memory is det.
%
%   To be called now and then while a program is watched: hooks leave garbage.
%   If it is too much, nothing is watched any more.

% ---------------- VERSION 10.1

:- if((current_prolog_flag(version, Version), Version >= 100100)).

%   There a goal loses its arguments if its hook calls another goal, collects
%   garbage, or makes a stack larger. So a hook only notes, and collects no
%   garbage; the program keeps the frames of its last calls, which have break
%   points then; and the stacks are larger before than hooks need: nothing is
%   watched any more if half of that is used. That is for a page, which lives
%   on if its Prolog crashes.

unsafe :-
    \+ current_prolog_flag(emscripten, true).

last_calls(kept) :-
    last_calls_are(false),
    forall(stack(Stack, _, Bytes),
           ( Cells is Bytes//8,
             set_prolog_stack(Stack, min_free(Cells)) )),
    garbage_collect.
last_calls(gone) :-
    last_calls_are(true).

%   Their garbage has room.
first_most(5000).

tail_at(_, _, none).

%   A library may call itself millions of times: its last calls keep nothing.
hook(Goal, Called) :-
    setup_call_cleanup(set_prolog_flag(gc, false),
                       Goal,
                       set_prolog_flag(gc, true)),
    (   retract(removed(library, none))
    ->  last_calls_are(false)
    ;   true
    ),
    (   fills(_, 2)
    ->  watch_no_more
    ;   Called = Module:Head,
        is_of_library(Module:Head)
    ->  last_calls_are(true),
        assertz(removed(library, none))
    ;   true
    ).

is_of_library(Called) :-
    (   predicate_property(Called, imported_from(Module))
    ->  \+ in_pack(Module:x/0, _, _),
        Module \== system
    ;   \+ predicate_property(Called, defined),
        strip_module(Called, In, Head),
        functor(Head, Name, Arity),
        '$find_library'(In, Name, Arity, _, _)
    ).

last_calls_are(Reused) :-
    set_prolog_flag(last_call_optimisation, Reused).

spare_memory :-
    (   current_prolog_flag(gc, true),  % so this is not within a hook
        has_garbage
    ->  garbage_collect,
        (   has_garbage
        ->  watch_no_more
        ;   true
        )
    ;   fills(local, 2)
    ->  watch_no_more
    ;   true
    ).

%   An engine has stacks of its own.
is_small :-
    engine_self(_).

has_garbage :-
    fills(global, 4).
has_garbage :-
    fills(trail, 4).

watch_no_more :-
    goals_end,
    forget_goals,
    assertz(removed(none, none)).

%   While programs are watched, Stack fills one of these parts.
fills(Stack, Parts) :-
    current_prolog_flag(last_call_optimisation, false),
    stack(Stack, Key, Bytes),
    statistics(Key, Used),
    Used > Bytes//Parts,
    !.

%   stack(Stack, Key, Bytes): they are free when nothing runs yet. A last call
%   with a break point keeps 2.4 kB.
stack(local, localused, 24000000).
stack(global, globalused, 8000000).
stack(trail, trailused, 2000000).

:- else.

unsafe :-
    fail.

last_calls(_).

first_most(20000).

tail_at(Clause, PC, Tail) :-
    (   tail_after(Clause, PC, Tail0)
    ->  Tail = Tail0
    ;   Tail = none
    ).

hook(Goal, _) :-
    call(Goal).

spare_memory.

is_small :-
    fail.

watch_no_more.

:- endif.

debugs(Query) :-
    compound(Query),
    !,
    Query =.. [Name|Arguments],
    (   is_debugger(Name)
    ->  true
    ;   one_of(Arguments, Argument),
        debugs(Argument)
    ),
    !.
debugs(Query) :-
    atom(Query),
    is_debugger(Query).

is_debugger(Name) :-
    memberchk(Name, [ trace, spy, debug, gtrace, gspy, gdebug,
                      set_breakpoint ]).

in_use :-
    predicate_property(prolog_breakpoints:known_breakpoint(_Clause, _, _, _),
                       number_of_clauses(Count)),
    Count > 0.

program_file(File, Time) :-
    program(File),
    source_file_property(File, modified(Time)).

watch_file(File, Time) :-
    retractall(done(File, _)),
    assertz(done(File, Time)),
    findall(clause(Head, Clause), clause_in(File, Head, Clause), Clauses),
    findall(Name/Arity,
            ( one_of(Clauses, clause(Head, Clause)),
              catch(clause(Head, Body, Clause), error(_, _), fail),
              cleaner(Body, Goal),
              functor(Goal, Name, Arity) ),
            Cleaners),
    forall(( one_of(Clauses, clause(_:Head, Clause)),
             functor(Head, Name, Arity),
             \+ memberchk(Name/Arity, Cleaners),
             '$break_pc'(Clause, PC, _),
             '$fetch_vm'(Clause, PC, _, Instruction) ),
           watch(Instruction, Clause, PC)).

clause_in(File, Module:Head, Clause) :-
    source_file(Module:Head, File),
    \+ in_pack(Module:x/0, _, _),
    \+ predicate_property(Module:Head, dynamic),
    nth_clause(Module:Head, _, Clause).

cleaner(Term, Goal) :-
    compound(Term),
    Term =.. [Name|Arguments],
    (   memberchk(Name, [call_cleanup, setup_call_cleanup])
    ->  append_last(Arguments, Cleaner),
        part(Cleaner, Goal)
    ;   one_of(Arguments, Argument),
        cleaner(Argument, Goal)
    ).

append_last([Last], Last) :- !.
append_last([_|Terms], Last) :-
    append_last(Terms, Last).

part(Goal, _) :-
    \+ callable(Goal),
    !,
    fail.
part(_:Goal, Part) :-
    !,
    part(Goal, Part).
part((Goal, Goals), Part) :-
    !,
    ( part(Goal, Part) ; part(Goals, Part) ).
part(Goal, Goal).

%   The other instructions are no goals.

watch(Instruction, Clause, PC) :-
    functor(Instruction, Operation, _),
    tail_at(Clause, PC, Tail),
    (   memberchk(Operation, [i_enter, i_exit, i_exitfact, i_cut, i_true])
    ->  (   Tail == none
        ->  true
        ;   set(Clause, PC, nothing, Tail)
        )
    ;   compound(Instruction),
        arg(1, Instruction, Called),
        clause_property(Clause, predicate(In:_)),
        strip_module(In:Called, Module, Name/Arity)
    ->  functor(Head, Name, Arity),
        set(Clause, PC, Module:Head, Tail)
    ;   set(Clause, PC, none, Tail)
    ).

set(Clause, PC, Called, Tail) :-
    (   break(Clause, PC, true)
    ->  assertz(watched(Clause, PC, Called, Tail)),
        (   Called = _:_,
            is_of_pack(Called)
        ->  assertz(uses_robot(Clause, PC))
        ;   true
        )
    ;   true
    ).

set_again :-
    forall(retract(removed(Clause, PC)), break(Clause, PC, true)).

break(Clause, PC, Set) :-
    catch('$break_at'(Clause, PC, Set), error(_, _), fail),
    !.
break(_, _, false).

%   What follows PC in Clause is its tail: tail(Moves, At, Called). Moves say
%   of arguments, counted from 0, which variable of the frame they are, or
%   which value; the others are at their places. At is where Called would be
%   called without reuse.

tail_after(Clause, PC, Tail) :-
    '$fetch_vm'(Clause, PC, Next, Instruction),
    \+ memberchk(Instruction, [i_exit, i_exitfact, i_depart(_)]),
    goes_on(Clause, Next, Tail).

goes_on(Clause, PC, Tail) :-
    '$fetch_vm'(Clause, PC, Next, Instruction),
    (   Instruction = l_nolco(_)
    ->  Tail = tail(Moves, At, Called),
        tail_moves(Clause, Next, Moves, At, Called)
    ;   Instruction = c_jmp(By)
    ->  Target is Next+By,
        goes_on(Clause, Target, Tail)
    ;   functor(Instruction, Name, _),
        memberchk(Name, [c_cut, c_lcut, c_fastcut]),
        goes_on(Clause, Next, Tail)
    ).

tail_moves(Clause, PC, Moves, At, Called) :-
    '$fetch_vm'(Clause, PC, Next, Instruction),
    (   move(Instruction, Move)
    ->  Moves = [Move|Moves1],
        tail_moves(Clause, Next, Moves1, At, Called)
    ;   Moves = [],
        depart(Clause, Next, At, Called)
    ).

move(l_var(To, From), To-frame(From)).
move(l_smallint(To, Value), To-value(Value)).
move(l_atom(To, Value), To-value(Value)).
move(l_nil(To), To-value([])).
move(l_void(To), To-value(_)).

depart(Clause, PC, At, Called) :-
    '$fetch_vm'(Clause, PC, Next, Instruction),
    (   Instruction = i_depart(Called)
    ->  At = PC
    ;   depart(Clause, Next, At, Called)
    ).

%!  watched(?Clause, ?PC, -Called, -Tail) is nondet.
%
%   There is a break point at PC in Clause, where it calls a predicate with
%   the head Called, or `none` if Prolog has an instruction for that goal, or
%   `nothing` if there is no goal.

:- multifile
    prolog:break_hook/6,
    noted/3.                            % Clause, PC, Goal
:- dynamic
    prolog:break_hook/6,
    noted/3.

prolog:break_hook(Clause, PC, Frame, _, Goal, Action) :-
    ev3dev_last_goal:stopped(Clause, PC, Frame, Goal, Action).
:- if((current_prolog_flag(version, Version), Version >= 80300)).

:- multifile prolog:break_hook/7.
:- dynamic prolog:break_hook/7.

prolog:break_hook(Clause, PC, Frame, _, Goal, _, Action) :-
    ev3dev_last_goal:stopped(Clause, PC, Frame, Goal, Action).

:- endif.

%   If the stack is full, the program comes to know that.

stopped(Clause, PC, Frame, Goal, Action) :-
    watched(Clause, PC, Called, Tail),
    !,
    (   is_small
    ->  watch_no_more,
        Action = continue
    ;   catch(unthought(hook(note(Clause, PC, Called, Tail, Frame, Goal,
                                  Action), Called)),
              error(resource_error(_), _), Action = continue)
    ).

note(Clause, PC, Called, Tail, Frame, Goal, Action) :-
    (   computes_long(Clause, PC)
    ->  assertz(removed(Clause, PC)),
        break(Clause, PC, false),
        last_calls(gone),
        Action = continue
    ;   take(Clause, PC, Called, Tail, Frame, Goal, Action)
    ).

computes_long(Clause, PC) :-
    most_notes(Most0),
    (   uses_robot(Clause, PC)
    ->  (   removed(_, _)
        ->  Most is max(Most0//4, 500),
            nb_setval(ev3dev_most_notes, Most),
            set_again,
            last_calls(kept)
        ;   true
        ),
        nb_setval(ev3dev_notes, 0),
        fail
    ;   ( nb_current(ev3dev_notes, Count0) -> true ; Count0 = 0 ),
        Count is Count0+1,
        nb_setval(ev3dev_notes, Count),
        Count > Most0
    ).

%   Each thread has its own.

most_notes(Most) :-
    (   nb_current(ev3dev_most_notes, Most0)
    ->  Most = Most0
    ;   first_most(Most)
    ).

%   A note takes none of the time that thinking takes, nor do the five calls
%   before it.

unthought(Goal) :-
    (   thought_begins_(Before)
    ->  call(Goal),
        thought_nothing_(Before, 5)
    ;   call(Goal)
    ).

take(Clause, PC, Called, Tail, Frame, Goal0, Action) :-
    (   Called == nothing
    ->  true
    ;   Goal0 = call(Goal),
        take(Clause, PC, Called, Goal)
    ),
    (   Tail == none
    ->  Action = continue
    ;   tail_goal(Tail, Frame, At, Head, Last),
        (   Called == nothing
        ->  take(Clause, At, Head, Last),
            Action = continue
        ;   statistics(localused, Bytes),
            Bytes > 1000000             % a deep recursion needs its room
        ->  Action = continue
        ;   clause_property(Clause, predicate(Module:_)),
            Action = call(ev3dev_last_goal:passing(Module:Goal,
                              take(Clause, At, Head, Last)))
        )
    ).

:- meta_predicate passing(0, +).

passing(Goal, Take) :-
    call(Goal),
    unthought(Take).

tail_goal(tail(Moves, At, Module:Name/Arity), Frame, At, Module:Head, Last) :-
    functor(Head, Name, Arity),
    functor(Last, Name, Arity),
    fill(0, Arity, Moves, Frame, Last).

fill(Index, Arity, Moved, Frame, Last) :-
    (   Index < Arity
    ->  Index1 is Index+1,
        (   memberchk(Index-Place, Moved)
        ->  true
        ;   Place = frame(Index)
        ),
        (   Place = frame(From)
        ->  From1 is From+1,
            prolog_frame_attribute(Frame, argument(From1), Value)
        ;   Place = value(Value)
        ),
        arg(Index1, Last, Value),
        fill(Index1, Arity, Moved, Frame, Last)
    ;   true
    ).

%   To copy a large term would take long.

take(Clause, PC, Called, Goal) :-
    (   '$term_size'(Goal, 200, _),
        term_attvars(Goal, [])
    ->  nb_setval(ev3dev_last_goal, at(Clause, PC, Goal))
    ;   functor(Goal, Name, Arity),
        nb_setval(ev3dev_last_goal, at(Clause, PC, Name/Arity))
    ),
    (   Called \== none,
        nb_current(ev3dev_used_robot, false),
        is_of_pack(Called)
    ->  nb_setval(ev3dev_used_robot, true)
    ;   true
    ),
    forall(noted(Clause, PC, Goal), true).

is_of_pack(Module:Head) :-
    (   in_pack(Module:Head, _, _)
    ->  true
    ;   predicate_property(Module:Head, imported_from(From)),
        in_pack(From:Head, _, _)
    ).

%!  used_robot is semidet.
%
%   True if a goal that was watched is one of the pack.

used_robot :-
    nb_current(ev3dev_used_robot, true).

%!  last_goal(-Goal, -In, -Place) is semidet.
%
%   Goal, a text, is the last one; it is in the predicate In, at Place, a text
%   `File:Line: `.

last_goal(Shown, In, Place) :-
    nb_current(ev3dev_last_goal, at(Clause, PC, Goal0)),
    clause_property(Clause, predicate(In0)),
    ( In0 = user:In -> true ; In = In0 ),
    ( Goal0 = _:Goal -> true ; Goal = Goal0 ),
    shown(Goal, Shown),
    place_of(Clause, PC, Path, Line),
    short(Path, File),
    format(atom(Place), '~w:~d: ', [File, Line]),
    !.

place_of(Clause, PC, Path, Line) :-
    clause_property(Clause, file(Path)),
    '$break_pc'(Clause, PC, Next),
    use_module(library(prolog_stack), []),
    call_line(Clause, Next, Line).

%!  outcome(:Goal, -Outcome) is det.
%
%   Call Goal once. Outcome is `true`, `false`, or thrown(Ball).

outcome(Goal, Outcome) :-
    watch_goals(Goal),
    (   catch(Goal, Ball, true)
    ->  (   var(Ball)
        ->  Outcome = true
        ;   Outcome = thrown(Ball)
        )
    ;   Outcome = false
    ).

%!  report(+Outcome, +Goal) is semidet.
%
%   Succeed if Outcome is `true`. Otherwise say where the program was, and
%   fail. Goal is what failed. What ends the whole program is thrown again.

report(true, _).
report(false, Goal) :-
    print_message(error, ev3dev(failed(Goal))),
    fail.
report(thrown(Ball), _) :-
    (   ( Ball == '$aborted' ; Ball = unwind(_) )
    ->  throw(Ball)
    ;   print_message(error, ev3dev(thrown(Ball)))
    ),
    fail.

:- multifile prolog:message//1.

prolog:message(ev3dev(failed(Goal))) -->
    { shown(Goal, Shown) },
    (   { \+ removed(_, _), last_goal(Last, In, Place) }
    ->  [ '~w~w failed; its last goal was ~w, in ~q'-
          [Place, Shown, Last, In] ]
    ;   [ '~w failed'-[Shown] ]
    ).
prolog:message(ev3dev(thrown(Ball))) -->
    (   { % A stack that is full filled in the loop that was noted.
          ( Ball = error(resource_error(_), _) -> true ; \+ removed(_, _) ),
          nb_current(ev3dev_last_goal, at(_, _, Goal)),
          last_goal(_, _, Place) }
    ->  [ '~w'-[Place] ],
        { blamed(Ball, Goal, Blamed) }
    ;   { Blamed = Ball }
    ),
    (   { Blamed = error(_, _) }
    ->  in_words(Blamed)
    ;   [ '~p was thrown'-[Blamed] ]
    ).

%   A context with a text names what was called, and one of the stacks what
%   fills them. Others may name what calls it.

blamed(Ball, Goal0, Blamed) :-
    (   Ball = error(Formal, Context),
        \+ ( nonvar(Formal), Formal = resource_error(_) ),
        \+ ( nonvar(Context), Context = context(_, Text), nonvar(Text) ),
        ( Goal0 = _:Goal -> true ; Goal = Goal0 ),
        ( Goal = Name/Arity, atom(Name) -> true
        ; functor(Goal, Name, Arity) )
    ->  Blamed = error(Formal, context(Name/Arity, _))
    ;   Blamed = Ball
    ).
