:- module(ev3dev_public_clauses,
          [ term_expansion/4            % +Clause0, ?Layout0, -Clause, -Layout
          ]).

/** <module> The clauses of public predicates keep their frames

Prolog drops a frame before the last call of a clause. Then an error could not
name the predicate that the program called. So a module with public predicates
imports term_expansion/4 from here. (`swipl -O` removes the `true` that it
adds; then an error names an inner predicate.)
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
%   Keep the frames of exported predicates by `true` after the last call.
%   Without its layout, a clause would break the backtraces of
%   library(prolog_stack) up to SWI-Prolog 9.2.

term_expansion((Head :- Body), Layout0, (Head :- Body, true), Layout) :-
    prolog_load_context(module, Module),
    callable(Head),
    functor(Head, Name, Arity),
    is_exported(Name, Arity, Module),
    layout(Layout0, Layout).

layout(Layout0, Layout) :-
    (   nonvar(Layout0),
        Layout0 = term_position(From, To, NeckFrom, NeckTo, [Head, Body]),
        compound(Body)
    ->  Body =.. [_, Begin, End|_],
        Layout = term_position(From, To, NeckFrom, NeckTo,
                               [ Head,
                                 term_position(Begin, End, End, End,
                                               [Body, End-End])
                               ])
    ;   Layout = Layout0
    ).
