:- module(ev3dev_unknown_procedures,
          [ known_mistake/1,            % +Predicate
            form_of/2,                  % +Predicate, -Form
            unqualified/2               % ?Predicate0, -Predicate
          ]).
:- use_module('../errors/frames', [in_pack/3, is_public/2]).

/** <module> Unknown procedures

A query that calls a predicate of a library of the pack that is not loaded
says which one to load. One that calls a predicate of the pack with another
number of arguments says what the arguments are. One that calls a predicate
that is called otherwise in the pack says so. An error in a program does the
same. Prolog would offer `ev3dev_sim:sim_start(room)` or another predicate as
a correction, or say that the procedure is unknown, and list modules. Syntax
errors come with the advice of `help/syntax_errors.pl`.

Prolog's own offer to correct a name that is misspelt stays.

What a person asks about the last run, why/1, and the page, view/0, are loaded
at their first call: at once they would take a brick a second more. Prolog
looks at a whole query before it calls a part of it, so what a query loads by
use_module/1 is loaded before it looks.
*/

:- multifile
    user:exception/3,
    user:expand_query/4,
    prolog:message//1.
:- dynamic
    user:exception/3,
    user:expand_query/4.

user:exception(undefined_predicate, Called, retry) :-
    ev3dev_unknown_procedures:loaded(Called).

%   A query of the toplevel is looked at before Prolog corrects it, and before
%   other clauses that expand it.

:- initialization(
       asserta((user:expand_query(Query, _, _, _) :-
                    ev3dev_unknown_procedures:forgotten(Query, Predicate),
                    throw(error(existence_error(procedure, Predicate), _)))),
       now).

forgotten(Query, Predicate) :-
    callable(Query),
    Query \== end_of_file,             % Ctrl-D
    unknown_goal(Query, Goal0),
    (   compound(Goal0),
        compound_name_arity(Goal0, Goal, 0)     % foo()
    ->  true
    ;   Goal = Goal0
    ),
    functor(Goal, Name, Arity),
    Predicate = Name/Arity,
    % Some Prologs come without library(help): the user gets the pack's.
    (   memberchk(Predicate, [help/1, apropos/1])
    ->  help_file(own_help, File),
        user:use_module(File),
        fail
    ;   loaded(Predicate)
    ->  fail
    ;   loads(Query, Library),
        load(user, Library),
        predicate_property(user:Goal, visible)
    ->  fail
    ;   not_loaded(Name, _, _)
    ->  true
    ;   is_known(Predicate)
    ->  true
    ;   \+ is_corrected(Goal),
        ( meant(Predicate, _) ; misspelt(Goal, _) )
    ),
    !.

%   Its library is loaded at the first call of these.

loaded(Called) :-
    strip_module(user:Called, Module, Name/Arity),
    memberchk(Name, [why, view]),
    module_property(Module, class(user)),
    library_of(Name/Arity, Library),
    load(Module, Library).

%   Names that Module uses for its own stay.

load(Module, Library) :-
    catch(use_module(library(ev3dev/Library), []), error(_, _), fail),
    atom_concat(ev3dev_, Library, From),
    module_property(From, exports(Exports)),
    forall(( '$member'(Name/Arity, Exports),
             functor(Head, Name, Arity),
             \+ current_predicate(_, Module:Head) ),
           Module:import(From:Name/Arity)).

loads(Query, Library) :-
    (   Query = (Query1, Query2)
    ->  ( loads(Query1, Library) ; loads(Query2, Library) )
    ;   nonvar(Query),
        Query = use_module(File),
        nonvar(File),
        File = library(Path),
        nonvar(Path),
        Path = ev3dev/Library,
        atom(Library)
    ).

%   True if Prolog offers another predicate that the user sees.

is_corrected(Goal) :-
    dwim_predicate(user:Goal, Other0),
    strip_module(Other0, Module, Other),
    \+ ( in_pack(Module:x/0, _, _),
         functor(Other, Name, Arity),
         \+ is_public(Module, Name/Arity) ),
    functor(Goal, _, Arity1),
    functor(Other, _, Arity1),
    !.

%!  known_mistake(+Predicate) is semidet.
%
%   True if Predicate is one of a library that is not loaded, or is one of the
%   pack but for its spelling or the number of its arguments.

known_mistake(Name/Arity) :-
    (   is_known(Name/Arity)
    ->  true
    ;   functor(Goal, Name, Arity),
        misspelt(Goal, _)
    ->  true
    ).

is_known(Predicate) :-
    library_of(Predicate, _),
    !.
is_known(Name/_) :-
    ask(signatures, arities(Name, _)).

%!  form_of(+Predicate, -Form) is semidet.
%
%   Form is Predicate with the names of its arguments, as in
%   `motor_run(Port, Speed)`.

form_of(Predicate, Form) :-
    ask(signatures, form(Predicate, Form)).

meant(Predicate, Predicates) :-
    ask(signatures, meant(Predicate, Predicates)).

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
      unqualified(Predicate0, Name/Arity),
      not_loaded(Name, File, Line)
    },
    [ 'there is no ~q: the clause at ~w:~d was not loaded, as it has a \c
       syntax error'-[Name/Arity, File, Line] ].
prolog:message(error(existence_error(procedure, Predicate0), Context)) -->
    { is_plain(Context),
      unqualified(Predicate0, Predicate),
      library_of(Predicate, Library)
    },
    [ '~q is in library(ev3dev/~w), which is not loaded: first'-
      [Predicate, Library], nl,
      '  use_module(library(ev3dev/~w)).'-[Library]
    ].
prolog:message(error(existence_error(procedure, Predicate0), Context)) -->
    { is_plain(Context),
      unqualified(Predicate0, Predicate),
      not_in_program(Predicate)
    },
    [ '~q is in library(ev3dev), which your file does not load: begin it \c
       with :- use_module(~w).'-[Predicate, library(ev3dev)] ].
prolog:message(error(existence_error(procedure, Predicate0), Context)) -->
    { is_plain(Context),
      unqualified(Predicate0, Predicate),
      instead(Predicate, Said, Predicates),
      where(Context, Where)
    },
    [ 'there is no ~q~w. ~w:'-[Predicate, Where, Said] ],
    forms(Predicates).

prolog:message(error(syntax_error(Kind), Where)) -->
    { nonvar(Where),
      ask(syntax_errors, syntax_advice(Kind, Where, Lines))
    },
    Lines.
prolog:message(error(instantiation_error, Context)) -->
    { nonvar(Context),
      Context = context(Called, _),
      nonvar(Called),                   % it is not, with a stack
      Called = system:'$record_clause'/_
    },
    [ 'a clause begins with a variable: names of predicates begin with a \c
       small letter'-[] ].

%   Prolog found an error of syntax in File at Line when it was loaded.

:- dynamic broken/2.
:- volatile broken/2.
:- multifile user:message_hook/3.
:- dynamic user:message_hook/3.

user:message_hook(Message, _, _) :-
    nonvar(Message),
    ev3dev_unknown_procedures:noted(Message),
    fail.

noted(load_file(start(_, file(_, File)))) :-
    retractall(broken(File, _)).
noted(error(syntax_error(_), file(File, Line, _, _))) :-
    assertz(broken(File, Line)).

%   A clause for Name begins at Line of File, and no clause ends between it
%   and the error: Prolog left out all that it took for one clause.

not_loaded(Name, File, Line) :-
    broken(Path, At),
    catch(read_file_to_string(Path, Text, []), error(_, _), fail),
    split_string(Text, "\n", "", Lines),
    nth1(Line, Lines, Begin),
    string_concat(Name, Rest, Begin),
    \+ ( sub_string(Rest, 0, 1, _, Next), char_type(Next, csym) ),
    From is min(Line, At),
    To is max(Line, At)-1,
    \+ ( between(From, To, Between),
         nth1(Between, Lines, Other),
         ends(Other) ),
    file_base_name(Path, File),
    !.

ends(Text) :-
    split_string(Text, "%", " \t\r", [Code|_]),
    sub_string(Code, _, 1, 0, ".").

%   The predicates of the same name, else those that may be meant.

instead(Name/Arity, Said, Predicates) :-
    (   ask(signatures, arities(Name, Predicates))
    ->  (   Predicates = [_]
        ->  Said = 'There is'
        ;   Said = 'There are'
        )
    ;   functor(Goal, Name, Arity),
        \+ is_corrected(Goal),
        ask(signatures, meant(Name/Arity, Predicates))
    ->  Said = 'Did you mean'
    ;   functor(Goal, Name, Arity),
        setof(Predicate, misspelt(Goal, Predicate), Predicates)
    ->  Said = 'Did you mean'
    ).

%   Predicate is one of the pack, which the user sees.

misspelt(Goal, Name/Arity) :-
    dwim_predicate(user:Goal, Other0),
    strip_module(Other0, _, Other),
    functor(Other, Name, Arity),
    is_public(_, Name/Arity).

where(Context, Where) :-
    (   nonvar(Context),
        Context = context(_, Text),
        atom(Text)
    ->  format(atom(Where), ', ~w', [Text])
    ;   Where = ''
    ).

forms([]) -->
    [].
forms([Predicate0|Predicates]) -->
    { (   Predicate0 = Library-Predicate
      ->  format(atom(Shown), '~q of library(ev3dev/~w)',
                 [Predicate, Library])
      ;   form_of(Predicate0, Shown)
      ->  true
      ;   format(atom(Shown), '~q', [Predicate0])
      )
    },
    [ nl, '  ~w'-[Shown] ],
    forms(Predicates).

is_plain(Context) :-
    (   var(Context)
    ->  true
    ;   Context = context(Where, _),
        \+ ( nonvar(Where), Where = prolog_stack(_) )
    ).

%!  unqualified(?Predicate0, -Predicate) is semidet.
%
%   Predicate is Name/Arity; Predicate0 is that, or has a module before it.

unqualified(Predicate0, Predicate) :-
    (   nonvar(Predicate0),
        Predicate0 = _:Predicate
    ->  true
    ;   Predicate = Predicate0
    ),
    ground(Predicate),
    Predicate = _/_.

%   True if library(ev3dev/Library) is the one to load for Predicate.

library_of(Predicate, Library) :-
    ask(libraries, in_library(Library, Predicates)),
    memberchk(Predicate, Predicates),
    !.

%   The library is there, but not for the program.

not_in_program(Name/Arity) :-
    module_property(ev3dev, exports(Exports)),
    memberchk(Name/Arity, Exports),
    functor(Head, Name, Arity),
    \+ current_predicate(_, user:Head).

%   Call Goal of a file that is loaded when it is needed for the first time.

ask(Name, Goal) :-
    atom_concat(ev3dev_, Name, Module),
    (   module_property(Module, file(_))
    ->  true
    ;   help_file(Name, File),
        % In a saved program there may be no file.
        catch(use_module(File, []), error(_, _), fail)
    ),
    call(Module:Goal).

help_file(Name, File) :-
    module_property(ev3dev_unknown_procedures, file(This)),
    file_directory_name(This, Room),
    file_directory_name(Room, Private),
    atomic_list_concat([Private, '/help/', Name], File).
