:- module(ev3dev_last_call,
          [ load_noting/1,              % :File
            outcome/2,                  % :Goal, -Outcome
            report/2,                   % +Outcome, +Goal
            keeping/1                   % :Goal
          ]).
:- use_module(library(lists), [same_length/2]).
:- use_module('../explain/error_messages', [in_words//1]).

/** <module> The goal of a program that was called last

A goal that has failed leaves no trace behind, and neither does the frame of a
clause that has made its last call: an error in that call knows the clause no
more. So load_noting/1 puts a note before each goal of the program's own
clauses: nb_setval/2 of a number. What was noted last is the goal that threw,
or that a program called last before it failed. Last calls remain last calls;
a note takes 0.03 to 0.1 microseconds on a PC.

The debugger knows, too, but it keeps the frames of all last calls, for which
a program that runs for hours has no room, and it makes all code slow.

The clauses of libraries have no notes. What threads call is not seen.
*/

:- meta_predicate
    load_noting(:),
    outcome(0, -),
    keeping(0).

:- dynamic
    noting/0,
    goal/5.                             % Number, Called, Clause, File, Offset

%!  load_noting(:File) is det.
%
%   Load File, with notes in it and in the files of the program that it loads.

load_noting(File) :-
    nb_setval(ev3dev_last_call, 0),
    setup_call_cleanup(
        assertz(noting),
        load_files(File, []),
        retractall(noting)).

%!  outcome(:Goal, -Outcome) is det.
%
%   Call Goal once. Outcome is `true`, `false`, or thrown(Ball).

outcome(Goal, Outcome) :-
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
    (   { last_goal(Name/Arity, Clause, Place) }
    ->  place(Place),
        [ '~q failed; its last goal was ~w/~w, in ~w'-
          [Goal, Name, Arity, Clause] ]
    ;   [ '~q failed'-[Goal] ]
    ).
prolog:message(ev3dev(thrown(Ball))) -->
    (   { last_goal(Called, _, Place) }
    ->  place(Place),
        { blamed(Ball, Called, Blamed) }
    ;   { Blamed = Ball }
    ),
    (   { Blamed = error(_, _) }
    ->  in_words(Blamed)
    ;   [ '~p was thrown'-[Blamed] ]
    ).

%   A context with a text names what was called. Others may name what calls
%   it.

blamed(Ball, Called, Blamed) :-
    (   Ball = error(Formal, Context),
        \+ ( nonvar(Context), Context = context(_, Text), nonvar(Text) )
    ->  Blamed = error(Formal, context(Called, _))
    ;   Blamed = Ball
    ).

place(Path:Line) -->
    { working_directory(Directory, Directory),
      (   atom_concat(Directory, File, Path)
      ->  true
      ;   File = Path
      ) },
    [ '~w:~d: '-[File, Line] ].

%   last_goal(-Called, -Clause, -File:Line) is semidet.

last_goal(Called, Clause, File:Line) :-
    nb_getval(ev3dev_last_call, Number),
    goal(Number, Called, Clause, File, Offset),
    setup_call_cleanup(
        open(File, read, In),
        ( forall(between(1, Offset, _), get_char(In, _)),
          line_count(In, Line) ),
        close(In)).

%!  keeping(:Goal) is semidet.
%
%   Call Goal once, which cleans up. What it calls is not noted.

keeping(Goal) :-
    nb_getval(ev3dev_last_call, Number),
    setup_call_cleanup(
        true,
        once(Goal),
        nb_setval(ev3dev_last_call, Number)).

% ---------------- NOTES

%   In the module system, which comes after the expansions of the program.

:- multifile system:term_expansion/4.
:- dynamic system:term_expansion/4.

system:term_expansion(Clause0, Layout, Clause, _) :-
    ev3dev_last_call:noting,
    ev3dev_last_call:noted_clause(Clause0, Layout, Clause).

noted_clause(Clause0, Layout, Clause) :-
    Clause0 =.. [Neck, Head, Body0],
    memberchk(Neck, [(:-), (=>)]),
    \+ memberchk(Body0, [true, fail]),  % library(ev3dev/golog) asks for these
    prolog_load_context(source, Source),
    \+ of_library(Source),
    prolog_load_context(file, File),
    prolog_load_context(term_position, Start),
    stream_position_data(char_count, Start, Offset),
    indicator(Head, Name),
    layouts(Layout, [Head, Body0], [_, BodyLayout]),
    noted(Body0, BodyLayout, in(Name, File, Offset), Body),
    Clause =.. [Neck, Head, Body].

of_library(File) :-
    (   current_prolog_flag(home, Directory)
    ;   module_property(ev3dev, file(Ev3dev)),
        file_directory_name(Ev3dev, Directory)
    ),
    sub_atom(File, 0, _, _, Directory),
    !.

noted(Goal0, Layout, In, Goal) :-
    (   ( Goal0 == ! ; Goal0 == true )
    ->  Goal = Goal0
    ;   parts(Goal0, Parts)
    ->  Goal0 =.. [Name|Args0],
        layouts(Layout, Args0, Layouts),
        noted_parts(Parts, Args0, Layouts, In, Args),
        Goal1 =.. [Name|Args],
        (   is_control(Name)
        ->  Goal = Goal1
        ;   with_note(Goal0, Goal1, Layout, In, Goal)
        )
    ;   with_note(Goal0, Goal0, Layout, In, Goal)
    ).

with_note(Called, Goal, Layout, in(Clause, File, Offset0),
          ( nb_setval(ev3dev_last_call, Number), Goal )) :-
    indicator(Called, Name),
    (   nonvar(Layout),
        arg(1, Layout, Offset)
    ->  true
    ;   Offset = Offset0
    ),
    flag(ev3dev_goals, Before, Before+1),
    Number is Before+1,
    assertz(goal(Number, Name, Clause, File, Offset)).

%   A goal within another one has a note of its own if it is several.

noted_parts([], [], [], _, []).
noted_parts([Part|Parts], [Arg0|Args0], [Layout|Layouts], In, [Arg|Args]) :-
    (   Part == c
    ->  prolog_load_context(module, Module),
        Arg = ev3dev_last_call:keeping(Module:Arg0)
    ;   ( Part == g ; Part == 0, nonvar(Arg0), parts(Arg0, _) )
    ->  noted(Arg0, Layout, In, Arg)
    ;   Arg = Arg0
    ),
    noted_parts(Parts, Args0, Layouts, In, Args).

%   The arguments that are goals: `g` is a goal of the clause, `0` one of its
%   own, `c` one that cleans up.

parts(Goal, Parts) :-
    nonvar(Goal),
    control(Template, Parts),
    Goal = Template,
    !.

control((_, _), [g, g]).
control((_ ; _), [g, g]).
control((_ -> _), [g, g]).
control((_ *-> _), [g, g]).
control(\+ _, [0]).
control(once(_), [0]).
control(ignore(_), [0]).
control(forall(_, _), [0, 0]).
control(findall(_, _, _), [?, 0, ?]).
control(catch(_, _, _), [0, ?, 0]).
control(call_cleanup(_, _), [0, c]).
control(setup_call_cleanup(_, _, _), [0, 0, c]).

is_control(Name) :-
    memberchk(Name, [(','), (;), (->), (*->)]).

indicator(Goal, Name/Arity) :-
    (   nonvar(Goal),
        Goal = _:Plain
    ->  indicator(Plain, Name/Arity)
    ;   callable(Goal)
    ->  functor(Goal, Name, Arity)
    ;   Name = call,
        Arity = 1
    ).

%   The positions of the arguments, unbound if they are not known.

layouts(Layout, Args, Layouts) :-
    (   nonvar(Layout),
        Layout = parentheses_term_position(_, _, Inner)
    ->  layouts(Inner, Args, Layouts)
    ;   nonvar(Layout),
        Layout = term_position(_From, _To, _, _, Layouts0),
        same_length(Layouts0, Args)
    ->  Layouts = Layouts0
    ;   length(Args, Count),
        length(Layouts, Count)
    ).
