:- module(ev3dev_error_messages,
          [ in_words//1,                % +Message
            call_line/3,                % +Clause, +PC, -Line
            short/2                     % +Path, -File
          ]).
:- use_module('../errors/errors', [named_called/2]).
:- use_module('../basics/small_lists', [one_of/2]).
:- use_module('../errors/error_texts',
              [is_word/1, item_said/3, nth/2, shown/2]).
:- use_module('../errors/frames', [in_pack/3, is_of_system/1, is_public/2]).
:- use_module(unknown_procedures,
              [form_of/2, known_mistake/1, unqualified/2]).

/** <module> Error messages

The message of an error of the pack is one line: what was called, and what is
wrong with it. If nobody catches an error of the pack, or one that passes
through it, the lines after that show where in the program it happened:

```
ERROR: led/2: purple is not one of: off, on, red, green, ...
ERROR:   in start/0 at square.pl:12
```

They are in the place of a backtrace, whose frames would be those of the pack,
and which up to SWI-Prolog 9.2 cannot be printed for clauses whose layout an
expansion has not kept. Prolog gives up frames of the program for their last
calls; a line that is missing is such a call.

No tracer opens, as Prolog's own would after an error in a goal with choice
points or clean-ups, and in 9.2 after any second error. After `debug.`, or
with the flag `access_level` set to `system`, all is as Prolog has it.
*/

:- multifile prolog:message//1.

%   Set while the flag `debug_on_error` is false by this library's doing.

:- thread_local quiet/0.

prolog:message(unhandled_exception(Error)) -->
    { is_located(Error, _, _) },
    prolog:message(Error).
% As Prolog words it where a tracer may open
prolog:message(unhandled_exception(Error)) -->
    { quiet },
    in_words(Error).
prolog:message(Error) -->
    { is_located(Error, Plain, Places) },
    in_words(Plain),
    places(Places).
prolog:message(error(Formal, Context)) -->
    { nonvar(Context),
      Context = context(Called, Text),
      atom(Text),
      is_ours(Called)
    },
    lead(Formal, Called, Text, Said0),
    { about(Formal, Said0, Said) },
    [ '~w'-[Said] ].

about(Formal, Text, Said) :-
    (   nonvar(Formal),
        Formal = domain_error(possible_geometry, Item)
    ->  item_said(Item, Text, Said)
    ;   Said = Text
    ).

%   What was called, with the names of its arguments if one of them is to
%   blame, or may be in another place than a student believes. Said is Text,
%   in which the argument has its name.

lead(permission_error(wait, guard, Name), Called, Text, Text) -->
    !,
    [ 'the condition of ~p calls ~q: '-[Name, Called] ].
lead(Formal, Called, Text, Said) -->
    { nonvar(Formal),
      (   nth_argument(Text, Place, Rest)
      ->  true
      ;   is_of_order(Formal),
          Called = _/Arity,
          Arity > 1
      ),
      form_of(Called, Form)
    },
    !,
    [ '~w: '-[Form] ],
    { (   integer(Place),
          argument_name(Form, Place, Argument)
      ->  atomic_list_concat([Argument, ' ', Rest], Said)
      ;   Said = Text
      ) }.
lead(_, Called, Text, Text) -->
    [ '~q: '-[Called] ].

nth_argument(Text, Place, Rest) :-
    atom_concat('the ', Text1, Text),
    sub_atom(Text1, Before, _, After, ' argument '),
    !,
    sub_atom(Text1, 0, Before, _, Nth),
    sub_atom(Text1, _, After, 0, Rest),
    between(1, 8, Place),
    nth(Place, Nth),
    !.

argument_name(Form, Place, Argument) :-
    sub_atom(Form, Before, 1, After, '('),
    !,
    Start is Before + 1,
    Length is After - 1,
    sub_atom(Form, Start, Length, 1, Listed),
    atomic_list_concat(Names, ', ', Listed),
    nth_of(Names, Place, Argument).

nth_of([Name|Names], Place, Found) :-
    (   Place =:= 1
    ->  Found = Name
    ;   Place1 is Place - 1,
        nth_of(Names, Place1, Found)
    ).

is_of_order(type_error(Type, _)) :-
    memberchk(Type, [evaluable, number, integer, atom, text, [], character]).
is_of_order(domain_error(_, Term)) :-
    atom(Term),
    is_word(Term).

%!  in_words(+Message, -Lines, ?Rest) is det.
%
%   Lines, up to Rest, are those of a Message, as print_message/2 words it.
%   All versions have this, though none documents it.

in_words(Message, Lines, Rest) :-
    Translation =.. [translate_message, Message, Lines, Rest],
    call('$messages':Translation).

places([]) -->
    [].
places([place(Predicate, File, Line)|Places]) -->
    [ nl, '  in ~q at ~w:~w'-[Predicate, File, Line] ],
    places(Places).

is_located(Error, error(Formal, context(Called, Text)), Places) :-
    nonvar(Error),
    Error = error(Formal, Context),
    nonvar(Context),
    Context = context(Called, At),
    nonvar(At),
    At = ev3dev_at(Text, Places).

is_ours(Called) :-
    nonvar(Called),
    Called = Name/Arity,
    atom(Name),
    integer(Arity),
    is_public(_, Called).

% ---------------- BEGINNERS' MISTAKES IN A FILE

:- multifile prolog:error_message//1.

prolog:error_message(evaluation_error(zero_divisor)) -->
    [ 'a number is divided by 0' ].
prolog:error_message(permission_error(modify, static_procedure, Called)) -->
    { nonvar(Called),
      strip_module(Called, _, Name/Arity),
      functor(Head, Name, Arity),
      predicate_property(system:Head, built_in)
    },
    (   { memberchk(Name/Arity, [(->)/2, (',')/2, (;)/2]) }
    ->  [ 'this clause has no head: begin it with a name and :-, such as \c
           start :- go_cm(20, 30).' ]
    ;   [ '~q is one of Prolog\'s own predicates, and no clause changes it: \c
           begin the clause with another name'-[Name/Arity] ]
    ).
prolog:message(ignored_weak_import(user, From:Called)) -->
    { in_pack(From:Called, _, _) },
    [ '~q is a predicate of the pack, and this clause begins another one. \c
       To call it, write it into a rule, such as start :- go_cm(20, 30).'-
      [Called] ].

% ---------------- THE STACK IS FULL

%   Since 7.7.14 the context of such an error says what filled the stack.

prolog:message(error(resource_error(_), Overflow)) -->
    { nonvar(Overflow),
      is_dict(Overflow, stack_overflow),
      get_dict(stack_limit, Overflow, Kilobytes),
      Megabytes is ceiling(Kilobytes/1024),
      (   fills(Overflow, Call, Does)
      ->  functor(Call, Name, Arity),
          format(atom(Who), '~q', [Name/Arity])
      ;   Who = 'the program',
          Call = none,
          Does = 'needs too much memory'
      )
    },
    [ '~w ~w: the stack of ~d MB is full'-[Who, Does, Megabytes] ],
    last_call(Call).

%   Parts of large arguments are left out there.

last_call(Call) -->
    { Call =.. [_|Arguments],
      Arguments \== [],
      \+ ( one_of(Arguments, Argument), \+ atomic(Argument) ),
      shown(Call, Shown)
    },
    !,
    [ '. Its last call was ~w'-[Shown] ].
last_call(_) -->
    [].

fills(Overflow, Call, Does) :-
    one_of([cycle, non_terminating, stack], Key),
    get_dict(Key, Overflow, Frames),
    (   Key == stack,
        get_dict(depth, Overflow, Depth),
        Depth =< 1000
    ->  Does = 'needs too much memory'
    ;   Does = 'calls itself without end'
    ),
    one_of(Frames, frame(_, Module:Call, _)),
    \+ in_pack(Module:Call, _, _),
    \+ is_of_system(Module:Call),
    !.

% ---------------- THE EXCEPTION

%   The hook changes the context of an error that nobody catches, as
%   library(prolog_stack) does, whose clause comes after this one.

located(error(Formal, Context), error(Formal, Located), Frame, Catcher) :-
    tracer_may_open,
    uncaught(Catcher, Frame),
    \+ current_prolog_flag(access_level, system),
    \+ current_prolog_flag(debug, true),
    no_tracer_opens(Catcher),
    words(Context, Called, Text),
    (   prolog_frame_attribute(Frame, pc, PC)
    ->  true
    ;   PC = none
    ),
    walk(Frame, PC, 200, 3, Passed, Places),
    (   Passed == true
    ->  true
    ;   is_forgotten(Formal)
    ),
    Located = context(Called, ev3dev_at(Text, Places)).

is_forgotten(existence_error(procedure, Predicate0)) :-
    unqualified(Predicate0, Predicate),
    known_mistake(Predicate).

%   The flag is looked at when this hook has succeeded or failed, and is set
%   back when the next error comes. Each thread has its own.

no_tracer_opens(Catcher) :-
    (   Catcher == none,
        current_prolog_flag(debug_on_error, true)
    ->  set_prolog_flag(debug_on_error, false),
        assertz(quiet)
    ;   true
    ).

tracer_may_open :-
    (   retract(quiet)
    ->  set_prolog_flag(debug_on_error, true)
    ;   true
    ).

uncaught(none, Frame) :-
    \+ caught_outside(Frame).
uncaught(Catcher, _) :-
    integer(Catcher),
    prolog_frame_attribute(Catcher, predicate_indicator,
                           system:catch_with_backtrace/3).

%   Before 7.6 the hook does not know of a catch/3 around native code that
%   calls Prolog.

:- if((current_prolog_flag(version, Version), Version < 70600)).

caught_outside(Frame) :-
    outside(Frame, Outside),
    caught(Outside).

outside(Frame, Outside) :-
    prolog_frame_attribute(Frame, parent, Parent),
    (   prolog_frame_attribute(Frame, top, true)
    ->  Outside = Parent
    ;   outside(Parent, Outside)
    ).

caught(Frame) :-
    prolog_frame_attribute(Frame, predicate_indicator, Predicate),
    memberchk(Predicate, [system:catch/3, catch/3]),
    !.
caught(Frame) :-
    prolog_frame_attribute(Frame, parent, Parent),
    caught(Parent).

:- else.

caught_outside(_) :-
    fail.

:- endif.

words(Context, Called, Text) :-
    (   var(Context)
    ->  true
    ;   Context = context(Called0, Text),
        \+ ( nonvar(Called0), Called0 = prolog_stack(_) ),
        \+ ( nonvar(Text), Text = ev3dev_at(_, _) ),
        named_called(Called0, Called)
    ).

%   Passed is true if a frame is the pack's; Places are the innermost ones of
%   the program, at most Most, in the Deep frames from Frame outwards. PC is
%   where the clause of Frame's parent goes on.

walk(Frame, PC, Deep, Most, Passed, Places) :-
    (   Deep > 0,
        Most > 0,
        prolog_frame_attribute(Frame, parent, Parent)
    ->  prolog_frame_attribute(Parent, predicate_indicator, Predicate),
        (   in_pack(Predicate, _, _)
        ->  Passed = true,
            Places = Places1,
            Most1 = Most
        ;   \+ is_of_system(Predicate),
            place(Parent, PC, Predicate, Place)
        ->  Places = [Place|Places1],
            Most1 is Most - 1
        ;   Places = Places1,
            Most1 = Most
        ),
        Deep1 is Deep - 1,
        (   prolog_frame_attribute(Parent, pc, PC1)
        ->  true
        ;   PC1 = none
        ),
        walk(Parent, PC1, Deep1, Most1, Passed, Places1)
    ;   Places = []
    ).

place(Frame, PC, Predicate, place(Shown, File, Line)) :-
    prolog_frame_attribute(Frame, clause, Clause),
    clause_property(Clause, file(Path)),
    call_line(Clause, PC, Line),
    (   Predicate = user:Shown
    ->  true
    ;   Shown = Predicate
    ),
    short(Path, File).

%!  call_line(+Clause, +PC, -Line) is semidet.
%
%   Line is that of the call after which Clause goes on at PC, if Prolog can
%   say so; else of the clause.

call_line(Clause, PC, Line) :-
    integer(PC),
    current_module(prolog_stack),
    Where = prolog_stack:prolog_stack_frame_property(
                             frame(0, clause(Clause, PC), 0),
                             location(_:Line)),
    catch(Where, error(_, _), fail),
    !.
call_line(Clause, _, Line) :-
    clause_property(Clause, line_count(Line)).

%!  short(+Path, -File) is det.
%
%   File is Path, but relative to the working directory.

short(Path, File) :-
    working_directory(Directory, Directory),
    (   atom_concat(Directory, File, Path)
    ->  true
    ;   File = Path
    ).

%   It stands before that of library(prolog_stack), which may be loaded
%   already.

:- if((current_prolog_flag(version, Version), Version >= 90107)).

:- multifile prolog:prolog_exception_hook/5.
:- dynamic prolog:prolog_exception_hook/5.
:- initialization(
       asserta((prolog:prolog_exception_hook(Error0, Error, Frame, Catcher,
                                             _) :-
                    ev3dev_error_messages:located(Error0, Error, Frame,
                                                   Catcher))),
       now).

:- else.

:- multifile user:prolog_exception_hook/4.
:- dynamic user:prolog_exception_hook/4.
:- initialization(
       asserta((user:prolog_exception_hook(Error0, Error, Frame, Catcher) :-
                    ev3dev_error_messages:located(Error0, Error, Frame,
                                                   Catcher))),
       now).

:- endif.
