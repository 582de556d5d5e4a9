:- module(ev3dev_forgotten,
          [ library_of/2                % +Predicate, -Library
          ]).

/** <module> A predicate whose library is not loaded

A query that calls a predicate of a library of the pack that is not loaded
says which one to load. So does an error in a program. Prolog would offer
`ev3dev_sim:sim_start(room)` as a correction if the library is in memory, or
say that the procedure is unknown.
*/

:- multifile
    user:expand_query/4,
    prolog:message//1.
:- dynamic user:expand_query/4.

%   A query of the toplevel is looked at before Prolog corrects it, and before
%   other clauses that expand it.

:- initialization(
       asserta((user:expand_query(Query, _, _, _) :-
                    ev3dev_forgotten:forgotten(Query, Predicate),
                    throw(error(existence_error(procedure, Predicate), _)))),
       now).

forgotten(Query, Predicate) :-
    callable(Query),
    unknown_goal(Query, Goal),
    functor(Goal, Name, Arity),
    Predicate = Name/Arity,
    library_of(Predicate, _),
    !.

%   Goal is a call in Query of what the user has not defined or imported.

unknown_goal(Goal, _) :-
    \+ callable(Goal),
    !,
    fail.
unknown_goal(_:_, _) :-
    !,
    fail.
unknown_goal(Goal, Unknown) :-
    predicate_property(user:Goal, visible),
    !,
    predicate_property(user:Goal, meta_predicate(Modes)),
    arg(Index, Modes, 0),
    arg(Index, Goal, Part),
    unknown_goal(Part, Unknown).
unknown_goal(Goal, Goal).

prolog:message(error(existence_error(procedure, Predicate0), Context)) -->
    { is_plain(Context),
      unqualified(Predicate0, Predicate),
      library_of(Predicate, Library)
    },
    [ '~q is in library(ev3dev/~w), which is not loaded: first'-
      [Predicate, Library], nl,
      '  use_module(library(ev3dev/~w)).'-[Library]
    ].

prolog:message(error(syntax_error(operator_expected), Where)) -->
    { nonvar(Where),
      text_of(Where, Text, Place),
      \+ current_op(_, xfx, user:(~>)),
      sub_string(Text, _, _, _, "~>")
    },
    [ '~wOperator expected: ~~> is one of library(ev3dev/rules), '-[Place],
      'which is not loaded: first'-[], nl,
      '  use_module(library(ev3dev/~w)).'-[rules]
    ].

text_of(string(Text, _), Text, '').
text_of(file(File, Line, Column, _), Text, Place) :-
    catch(setup_call_cleanup(open(File, read, In),
                             nth_line(Line, In, Text),
                             close(In)),
          error(_, _), fail),
    format(atom(Place), '~w:~w:~w: ', [File, Line, Column]).

%   The term that is wrong may go on for some lines.

nth_line(Line, In, Text) :-
    forall(between(2, Line, _), skip(In, 0'\n)),
    read_pending(10, In, Lines),
    atomic_list_concat(Lines, '\n', Text).

read_pending(Count, In, Lines) :-
    (   Count > 0,
        \+ at_end_of_stream(In)
    ->  read_line_to_codes(In, Codes),
        atom_codes(Line, Codes),
        Lines = [Line|Lines1],
        Count1 is Count - 1,
        read_pending(Count1, In, Lines1)
    ;   Lines = []
    ).

is_plain(Context) :-
    (   var(Context)
    ->  true
    ;   Context = context(Where, _),
        \+ ( nonvar(Where), Where = prolog_stack(_) )
    ).

unqualified(Predicate0, Predicate) :-
    (   nonvar(Predicate0),
        Predicate0 = _:Predicate
    ->  true
    ;   Predicate = Predicate0
    ),
    ground(Predicate),
    Predicate = _/_.

%!  library_of(+Predicate, -Library) is semidet.
%
%   True if library(ev3dev/Library) is the one to load for Predicate. The
%   table is loaded when it is needed for the first time.

library_of(Predicate, Library) :-
    (   module_property(ev3dev_libraries, file(_))
    ->  true
    ;   module_property(ev3dev_forgotten, file(This)),
        file_directory_name(This, Private),
        atom_concat(Private, '/libraries', File),
        use_module(File, [])
    ),
    Table =.. [in_library, Library, Predicates],
    call(ev3dev_libraries:Table),
    memberchk(Predicate, Predicates),
    !.
