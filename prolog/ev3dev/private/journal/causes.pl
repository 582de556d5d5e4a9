:- module(ev3dev_causes,
          [ acting_for/2,               % :Goal, +Cause
            begins/1,                   % +Cause
            follow/1,                   % +Closure
            follow_no_more/0,
            causes/2,                   % +Number, -Causes
            active_clause/1,            % -Clause
            explained/3,                % +What, -Why, -Message
            misspelt/2                  % +What, -Text
          ]).
:- use_module('../errors/errors', [in_own_name/1]).
:- use_module('../native/native', [cause_/2, cause_active_/1]).

/** <module> Why a program does what it does

A cause is a term. The native code knows the number of the cause that a thread
acts for, and writes it into the journal with each command; the terms are
here. Those of 4096 causes are kept, and those that somebody still acts for.
*/

:- meta_predicate acting_for(0, +).

:- dynamic
    cause/3,                            % Number, Former, Cause
    follower/1,                         % Closure, of library(ev3dev/view)
    kept/3.                             % Number, Due, State

%!  acting_for(:Goal, +Cause) is semidet.
%
%   Call Goal once. What it commands is done for Cause, and that for what this
%   thread acted for before. An exception, too, ends it.

acting_for(Goal, Cause) :-
    cause_(Number, Former),
    note(Number, Former, Cause),
    (   call(Goal)
    ->  !
    ;   !,
        fail
    ).

%!  follow(+Closure) is det.
%!  follow_no_more is det.
%
%   Call call(Closure, Cause) from now on whenever something begins.

follow(Closure) :-
    follow_no_more,
    assertz(follower(Closure)).

follow_no_more :-
    retractall(follower(_)).

%!  begins(+Cause) is det.
%
%   A rule becomes active, an event happens, an action of Golog is done: the
%   follower hears of it, also if the robot gets no command.

begins(Cause) :-
    (   follower(Closure)
    ->  ignore(call(Closure, Cause))
    ;   true
    ).

%!  active_clause(-Clause) is nondet.
%
%   This thread acts for Clause of the program now, though it is in none of
%   its frames. A library that knows adds a clause.

:- multifile active_clause/1.

%!  explained(+What, -Why, -Message) is semidet.
%
%   Why is what why/2 answers about What, which is no device; Message says it
%   in words. A library that knows adds a clause.

:- multifile explained/3.

%!  misspelt(+What, -Text) is semidet.
%
%   What is no fluent, or no such thing, of a library, which says in Text what
%   may be meant. The library adds a clause.

:- multifile misspelt/2.

note(Number, Former, Cause) :-
    in_own_name(assertz(cause(Number, Former, Cause))),  % none that is cyclic
    forget_before(Number).

%!  causes(+Number, -Causes) is det.
%
%   Causes are the terms of a cause and of those around it, the innermost
%   first.

causes(Number, Causes) :-
    (   cause(Number, Former, Cause)
    ->  Causes = [Cause|Causes1],
        causes(Former, Causes1)
    ;   Causes = []
    ).

% ---------------- OLD CAUSES

room(4096).

%   One is kept while somebody acts for it, and while those are kept that
%   began meanwhile.

forget_before(Number) :-
    room(Room),
    Old is Number - Room,
    (   cause(Old, _, _)
    ->  forget(Old, ended, Number)
    ;   true
    ),
    (   kept(_, _, _)
    ->  forall(( kept(Kept, Due, State),
                 Due =< Number,
                 retract(kept(Kept, Due, State))
               ),
               forget(Kept, State, Number))
    ;   true
    ).

forget(Old, State, Number) :-
    (   cause_active_(Old)
    ->  keep(Old, active, Number)
    ;   State == active
    ->  keep(Old, ended, Number)
    ;   retractall(cause(Old, _, _))
    ).

keep(Old, State, Number) :-
    room(Room),
    Due is Number + Room,
    assertz(kept(Old, Due, State)).
