:- module(ev3dev_public_clauses,
          [ term_expansion/4            % +Clause0, ?Layout0, -Clause, -Layout
          ]).
:- use_module('../basics/fields', [is_named/2]).

/** <module> The clauses of public predicates keep their frames and arguments

Prolog drops a frame before the last call of a clause, and its garbage
collector forgets arguments that a clause does not use any more. Then an error
could not name the predicate that the program called, or the wrong argument.
So a module with public predicates imports term_expansion/4 from here.
(`swipl -O` removes the `true` that it adds; then an error names an inner
predicate.)
*/

:- dynamic
    exported/3,                         % Name, Arity, Module
    known/1.                            % Module

is_exported(Name, Arity, Module) :-
    (   known(Module)
    ->  true
    ;   module_property(Module, exports(Exports)),
        note_exports(Exports, Module),
        assertz(known(Module))
    ),
    exported(Name, Arity, Module),
    !.

note_exports([], _).
note_exports([Name/Arity|Exports], Module) :-
    assertz(exported(Name, Arity, Module)),
    note_exports(Exports, Module).

%!  term_expansion(+Clause0, ?Layout0, -Clause, -Layout) is semidet.
%
%   Keep the frames of exported predicates by a goal after the last call. It
%   tests one argument and could use the others, so the collector keeps them.
%   Without its layout, a clause would break the backtraces of
%   library(prolog_stack) up to SWI-Prolog 9.2.

term_expansion((Head :- Body), Layout0, (Head :- Body, Kept), Layout) :-
    prolog_load_context(module, Module),
    callable(Head),
    functor(Head, Name, Arity),
    is_exported(Name, Arity, Module),
    \+ is_named(Head, _),               % fields.pl refuses it
    Head =.. [_|Arguments],
    kept(Arguments, Kept),
    layout(Layout0, Kept, Layout).

kept([], true).
kept([Argument|Arguments], Kept) :-
    (   var(Argument)
    ->  Kept = ( nonvar(Argument) -> true ; Used ),
        used([Argument|Arguments], Used)
    ;   kept(Arguments, Kept)
    ).

used([], true).
used([Argument|Arguments], ( Argument == Argument, Used )) :-
    used(Arguments, Used).

layout(Layout0, Kept, Layout) :-
    (   nonvar(Layout0),
        Layout0 = term_position(From, To, NeckFrom, NeckTo, [Head, Body]),
        compound(Body)
    ->  Body =.. [_, Begin, End|_],
        place(Kept, End, Place),
        Layout = term_position(From, To, NeckFrom, NeckTo,
                               [ Head,
                                 term_position(Begin, End, End, End,
                                               [Body, Place])
                               ])
    ;   Layout = Layout0
    ).

place(Term, End, Place) :-
    (   compound(Term)
    ->  Place = term_position(End, End, End, End, Places),
        Term =.. [_|Parts],
        places(Parts, End, Places)
    ;   Place = End-End
    ).

places([], _, []).
places([Part|Parts], End, [Place|Places]) :-
    place(Part, End, Place),
    places(Parts, End, Places).
