:- module(ev3dev_errors,
          [ must_be/2,                  % +Type, ?Term
            must_be_goal/1,             % ?Term
            evaluated/2,                % +Expression, -Number
            in_own_name/1,              % :Goal
            goal_of_program/1,          % :Goal
            type_error/2,               % +Type, +Term
            domain_error/2,             % +Domain, +Term
            existence_error/2,          % +Kind, +Name
            instantiation_error/1,      % +Term
            throw_error/3,              % +Formal, +Called, +Message
            shown/2,                    % +Term, -Shown
            called_by_program/1,        % -Called
            error_within/3,             % +Error0, +Where, -Error
            named_called/2,             % ?Called0, -Called
            in_pack/3,                  % +Predicate, -Module, -Indicator
            is_of_system/1,             % +Predicate
            is_public/2,                % ?Module, +Indicator
            is_word/1,                  % +Atom
            term_expansion/4            % +Clause0, ?Layout0, -Clause, -Layout
          ]).
:- use_module(domains, [allowed/2]).
:- use_module('../basics/small_lists', [one_of/2]).

/** <module> Errors that name what was called

This module throws every error of the pack. The context of an error names the
predicate that the program called, not one that this predicate calls. It says
in words what is wrong, and lists the allowed values of a closed set. The
predicates have the names and meanings of those in library(error). The pack
does not load that library, because loading it would take a tenth of the time
of loading the pack.

throw_error/3 finds the called predicate when it throws, so a call that
succeeds costs nothing. It walks from the frame of the error outward to the
program's own code and takes the last exported predicate of the pack. Prolog
drops a frame before the last call of a clause. So a module with public
predicates imports term_expansion/4 from here, which adds `true` after the
last call of each clause of an exported predicate. (`swipl -O` removes this
`true`; then an error names an inner predicate.)
*/

:- meta_predicate
    in_own_name(0),
    goal_of_program(0).

%!  must_be(+Type, ?Term) is det.
%
%   True if Term is of Type: `atom`, `atomic`, `boolean`, `callable`,
%   `ground`, `integer`, `list`, `list(Type)`, `nonneg`, `nonvar`, `number`,
%   `positive_integer` or `text`.
%
%   @error instantiation_error if Term is not instantiated enough
%   @error type_error(Type, Term)

must_be(Type, Term) :-
    (   is_of(Type, Term)
    ->  true
    ;   is_not(Type, Term)
    ).

is_of(nonvar, Term) :- nonvar(Term).
is_of(atom, Term) :- atom(Term).
is_of(atomic, Term) :- atomic(Term).
is_of(text, Term) :- ( atom(Term) -> true ; string(Term) ).
is_of(boolean, Term) :- ( Term == true -> true ; Term == false ).
is_of(number, Term) :- number(Term).
is_of(integer, Term) :- integer(Term).
is_of(nonneg, Term) :- integer(Term), Term >= 0.
is_of(positive_integer, Term) :- integer(Term), Term >= 1.
is_of(callable, Term) :- callable(Term).
is_of(ground, Term) :- ground(Term).
is_of(list, Term) :- is_list(Term).
is_of(list(Type), Term) :- is_list(Term), all_of(Term, Type).

all_of([], _).
all_of([Element|Elements], Type) :-
    is_of(Type, Element),
    all_of(Elements, Type).

is_not(Type, Term) :-
    (   var(Term)
    ;   Type == ground
    ;   memberchk(Type, [list, list(_)]),
        partial_list(Term)
    ),
    !,
    instantiation_error(Term).
is_not(list(Type), Term) :-
    is_list(Term),
    !,
    each_must_be(Term, Type).
is_not(list(_), Term) :-
    !,
    type_error(list, Term).
is_not(Type, Term) :-
    memberchk(Type, [nonneg, positive_integer]),
    \+ integer(Term),
    !,
    type_error(integer, Term).
is_not(boolean, Term) :-
    !,
    type_error(bool, Term).
is_not(Type, Term) :-
    type_error(Type, Term).

each_must_be([Element|Elements], Type) :-
    must_be(Type, Element),
    each_must_be(Elements, Type).

partial_list(Term) :-
    '$skip_list'(_, Term, Tail),
    var(Tail).

%!  evaluated(+Expression, -Number) is det.
%
%   Number is the value of an arithmetic Expression.
%
%   @error the errors of is/2

evaluated(Expression, Number) :-
    (   number(Expression)
    ->  Number = Expression
    ;   catch(Number is Expression, error(Formal, _),
              not_evaluated(Formal, Expression))
    ).

not_evaluated(instantiation_error, Expression) :-
    term_variables(Expression, [Variable|_]),
    !,
    instantiation_error(Variable).
not_evaluated(Formal, _) :-
    throw_formal(Formal).

%!  must_be_goal(?Term) is det.
%
%   True if Term is callable, with a module or without.
%
%   @error as must_be(callable, Term), without the module

must_be_goal(Term) :-
    strip_module(Term, _, Plain),
    must_be(callable, Plain).

%!  in_own_name(:Goal) is nondet.
%
%   Call a Goal of Prolog's own library. Its errors name the predicate that
%   the program called.

in_own_name(Goal) :-
    catch(Goal, error(Formal, _), throw_formal(Formal)).

%!  goal_of_program(:Goal) is nondet.
%
%   Call a Goal of the program. Its errors name the predicate that Goal
%   called, and not the one that calls Goal.

goal_of_program(Goal) :-
    call(Goal),
    true.

%!  type_error(+Type, +Term).
%!  domain_error(+Domain, +Term).
%!  existence_error(+Kind, +Name).
%!  instantiation_error(+Term).
%
%   Throw this error.

type_error(Type, Term) :-
    throw_formal(type_error(Type, Term)).

domain_error(Domain, Term) :-
    throw_formal(domain_error(Domain, Term)).

existence_error(Kind, Name) :-
    throw_formal(existence_error(Kind, Name)).

instantiation_error(Term) :-
    throw_error(instantiation_error, _, unbound(Term)).

throw_formal(Formal) :-
    throw_error(Formal, _, '').

%!  throw_error(+Formal, +Called, +Message).
%
%   Throw error(Formal, context(Name/Arity, Text)). Name/Arity is Called if no
%   frame has an exported predicate. Text is Message. If Message is empty,
%   Text explains Formal; if it is one_of(Term, Values), Text says that Term
%   is not one of Values; if it is unbound(Term), which variable has no value.
%   The foreign library also throws by this predicate.

throw_error(Formal, Called0, Message) :-
    (   called_by_program(Frame, Called)
    ->  true
    ;   Frame = none,
        Called = Called0
    ),
    (   Message = one_of(Term, Values)
    ->  not_one_of(Term, Values, Text)
    ;   Message = unbound(Term)
    ->  no_value(Term, Frame, Text)
    ;   Message \== ''
    ->  Text = Message
    ;   Formal == instantiation_error
    ->  no_value(_, Frame, Text)
    ;   in_words(Formal, Text)
    ->  true
    ;   true
    ),
    throw(error(Formal, context(Called, Text))).

%!  called_by_program(-Called) is semidet.
%
%   Called is the exported predicate, Name/Arity, that the program has called.

called_by_program(Called) :-
    called_by_program(_, Called).

called_by_program(Frame, Called) :-
    prolog_current_frame(Current),
    called(Current, none, Found),
    Found = Frame-Called.

%!  error_within(+Error0, +Where, -Error) is det.
%
%   Error is Error0, and its message also says Where it occurred: a text as
%   `in the guard of rule avoid`.

error_within(error(Formal, Context0), Where,
             error(Formal, context(Called, Text))) :-
    (   nonvar(Context0),
        Context0 = context(Called0, Text0)
    ->  named_called(Called0, Called)
    ;   true
    ),
    (   nonvar(Text0)
    ->  format(atom(Text), '~w; ~w', [Text0, Where])
    ;   Text = Where
    ).

%!  named_called(?Called0, -Called) is det.
%
%   Called is Called0, the predicate in the context of an error, but unbound
%   if it is an inner one of the pack: that means nothing to a person.

named_called(Called0, Called) :-
    (   ground(Called0),
        in_pack(Called0, Module, Predicate),
        \+ is_public(Module, Predicate)
    ->  true
    ;   Called = Called0
    ).

%   The last exported predicate of the pack between Frame and the program.

called(Frame, Called0, Called) :-
    prolog_frame_attribute(Frame, predicate_indicator, Indicator),
    (   Indicator == goal_of_program/1  % of this module
    ->  Called = Called0
    ;   in_pack(Indicator, Module, Predicate)
    ->  (   is_public(Module, Predicate)
        ->  Called1 = Frame-Predicate
        ;   Called1 = Called0
        ),
        outwards(Frame, Called1, Called)
    ;   is_of_system(Indicator)
    ->  outwards(Frame, Called0, Called)
    ;   Called = Called0
    ).

outwards(Frame, Called0, Called) :-
    (   prolog_frame_attribute(Frame, parent, Parent)
    ->  called(Parent, Called0, Called)
    ;   Called = Called0
    ).

%!  in_pack(+Indicator, -Module, -Predicate) is semidet.
%
%   True if Indicator, that of a frame, is Module:Predicate of the pack.

in_pack(Module:Predicate, Module, Predicate) :-
    sub_atom(Module, 0, _, _, ev3dev).

%!  is_public(?Module, +Predicate) is semidet.
%
%   True if a public library exports the Predicate of Module, Name/Arity. The
%   library may import it from a private module.

is_public(Module, Name/Arity) :-
    functor(Head, Name, Arity),
    predicate_property(Module:Head, exported),
    current_module(Library),
    sub_atom(Library, 0, _, _, ev3dev),
    module_property(Library, file(File)),
    \+ sub_atom(File, _, _, _, '/private/'),
    module_property(Library, exports(Exports)),
    memberchk(Name/Arity, Exports),
    (   Library == Module
    ->  true
    ;   predicate_property(Library:Head, imported_from(Module))
    ),
    !.

%!  is_of_system(+Indicator) is semidet.
%
%   True if Indicator, that of a frame, is one of Prolog's own predicates.

is_of_system(_/_).
is_of_system(Module:_) :-
    module_property(Module, class(Class)),
    memberchk(Class, [system, library]).

                /*******************************
                *            WORDS             *
                *******************************/

in_words(type_error(evaluable, Name/0), Text) :-
    !,
    format(atom(Text), 'a number is expected, not ~q', [Name]).
in_words(type_error(evaluable, Function), Text) :-
    !,
    format(atom(Text), 'there is no arithmetic function ~q', [Function]).
in_words(type_error(Type, Term), Text) :-
    memberchk(Type, [[], character]),   % of is/2, for a string or a list
    !,
    in_words(type_error(number, Term), Text).
in_words(type_error(list, Term), Text) :-
    callable(Term),
    Term \= [_|_],
    !,
    shown(Term, Shown),
    format(atom(Text), 'a list is expected, not ~w. Did you mean [~w]?',
           [Shown, Shown]).
in_words(type_error(Type, Term), Text) :-
    kind(Type, Wanted),
    shown(Term, Shown),
    format(atom(Text), '~w is expected, not ~w', [Wanted, Shown]).
in_words(domain_error(Domain, Term), Text) :-
    allowed(Domain, What),
    !,
    (   is_list(What)
    ->  not_one_of(Term, What, Text)
    ;   shown(Term, Shown),
        format(atom(Text), '~w, not ~w', [What, Shown])
    ).
in_words(domain_error(Domain, Term), Text) :-
    words_of(Domain, Words),
    shown(Term, Shown),
    format(atom(Text), '~w cannot be a ~w', [Shown, Words]).
in_words(existence_error(source_sink, File), Text) :-
    !,
    shown(File, Shown),
    format(atom(Text), 'there is no file ~w, or no folder for it', [Shown]).
in_words(existence_error(Kind, Name), Text) :-
    words_of(Kind, Words),
    shown(Name, Shown),
    format(atom(Text), 'there is no ~w ~w', [Words, Shown]).
in_words(evaluation_error(What), Text) :-
    words_of(What, Text).
in_words(representation_error(int64_t), Text) :-
    !,
    Text = 'an integer of at most 64 bits is expected'.
in_words(representation_error(What), Text) :-
    words_of(What, Words),
    format(atom(Text), 'beyond the ~w', [Words]).

kind(atom, 'an atom or a string') :- !.
kind(callable, 'a goal') :- !.
kind(bool, 'true or false') :- !.
kind(list, 'a list') :- !.
kind(integer, 'an integer') :- !.
kind(nonneg, 'an integer from 0 on') :- !.
kind(positive_integer, 'an integer from 1 on') :- !.
kind(Type, Text) :-
    words_of(Type, Words),
    format(atom(Text), 'a ~w', [Words]).

words_of(Name, Words) :-
    (   atom(Name)
    ->  atomic_list_concat(Parts, '_', Name),
        atomic_list_concat(Parts, ' ', Words)
    ;   format(atom(Words), '~p', [Name])
    ).

not_one_of(Term, Values, Text) :-
    quoted(Values, Atoms),
    atomic_list_concat(Atoms, ', ', Listed),
    shown(Term, Shown),
    (   nearly(Term, Values, Value)
    ->  format(atom(Text), '~w is not one of: ~w. Did you mean ~w?',
               [Shown, Listed, Value])
    ;   format(atom(Text), '~w is not one of: ~w', [Shown, Listed])
    ).

%   The only one of Values that is spelt nearly as Term, or begins so. Of an
%   option the name counts.

nearly(Term, Values, Value) :-
    (   atom(Term)
    ->  Name = Term
    ;   compound(Term),
        compound_name_arity(Term, Name, 1)
    ),
    is_latin(Name),
    downcase_atom(Name, Low),
    (   findall(Near, ( one_of(Values, Near), spelt(Low, Near) ), [Value])
    ->  true
    ;   atom_length(Low, Length),
        Length > 2,
        findall(Longer, ( one_of(Values, Longer), starts(Low, Longer) ),
                [Value])
    ).

%   downcase_atom/2 throws for other characters, as half of a surrogate pair.

is_latin(Name) :-
    atom(Name),
    \+ ( sub_atom(Name, _, 1, _, Character),
         Character @> '\xFF\'
       ).

spelt(Low, Value) :-
    atom(Value),
    (   Value == Low
    ->  true
    ;   dwim_match(Low, Value)
    ).

starts(Low, Value) :-
    atom(Value),
    (   atom_concat(Low, _, Value)
    ->  true
    ;   atom_concat(Value, _, Low),
        atom_length(Value, Length),
        Length > 2
    ).

quoted([], []).
quoted([Value|Values], [Atom|Atoms]) :-
    format(atom(Atom), '~w', [Value]),
    quoted(Values, Atoms).

%!  shown(+Term, -Shown) is det.
%
%   Shown is a Term as a program has it, with `_` for each variable. Of a long
%   or deep one it is the beginning.

shown(Term, Shown) :-
    copy_term(Term, Copy, _),
    term_variables(Copy, Variables),
    all_same(Variables, '$VAR'('_')),
    format(atom(Whole), '~W',
           [ Copy,
             [ quoted(true), numbervars(true), portray(true), max_depth(20) ]
           ]),
    (   sub_atom(Whole, 0, 500, After, Begin),
        After > 3
    ->  atom_concat(Begin, ..., Shown)
    ;   Shown = Whole
    ).

all_same([], _).
all_same([Term|Terms], Term) :-
    all_same(Terms, Term).

                /*******************************
                *     VARIABLES, NO VALUES     *
                *******************************/

%   Text says which variable has no value in the call of Frame: Variable, or
%   the first one in its arguments. In a query of the toplevel it has a name.
%   (The garbage collector forgets the arguments of a frame that are not used
%   any more. Then it is the first variable of the query.)

no_value(Variable, Frame, Text) :-
    (   Frame \== none,
        var(Variable),
        names_in_query(Frame, Names),
        name_of(Names, Variable, Name)
    ->  named(Name, Text)
    ;   Frame \== none,
        arguments(Frame, Arguments)
    ->  (   \+ place(Arguments, '<garbage_collected>', 1, _),
            missing(Arguments, Variable, Missing)
        ->  (   names_in_query(Frame, Names),
                name_of(Names, Missing, Name)
            ->  named(Name, Text)
            ;   place(Arguments, Missing, 1, Place)
            ->  nth(Place, Nth),
                format(atom(Text),
                       'the ~w argument is a variable without a value',
                       [Nth])
            ;   Text = 'a part of an argument is a variable without a value'
            )
        ;   names_in_query(Frame, Names),
            first_variable(Names, Name)
        ->  named(Name, Text)
        ;   Text = 'an argument is a variable without a value'
        )
    ;   Text = 'an argument is a variable without a value'
    ).

arguments(Frame, Arguments) :-
    prolog_frame_attribute(Frame, goal, Goal0),
    (   Goal0 = _:Goal
    ->  true
    ;   Goal = Goal0
    ),
    Goal =.. [_|Arguments].

missing(Arguments, Variable, Missing) :-
    term_variables(Arguments, Variables),
    (   var(Variable),
        place(Variables, Variable, 1, _)
    ->  Missing = Variable
    ;   Variables = [Missing|_]         % outputs are the last arguments
    ).

place([Term|Terms], Wanted, Place0, Place) :-
    (   Term == Wanted
    ->  Place = Place0
    ;   Place1 is Place0 + 1,
        place(Terms, Wanted, Place1, Place)
    ).

nth(Place, Nth) :-
    (   arg(Place, nth(first, second, third, fourth), Nth)
    ->  true
    ;   format(atom(Nth), '~dth', [Place])
    ).

%   The toplevel keeps the names of a query as a list of Name=Value.

names_in_query(Frame, Names) :-
    prolog_frame_attribute(Frame, parent, Parent),
    (   prolog_frame_attribute(Parent, predicate_indicator, Indicator),
        (   Indicator = _:'$execute_goal2'/_
        ;   Indicator = '$execute_goal2'/_
        )
    ->  prolog_frame_attribute(Parent, argument(2), Names)
    ;   names_in_query(Parent, Names)
    ).

name_of([Name0=Value|Names], Variable, Name) :-
    (   Value == Variable
    ->  Name = Name0
    ;   name_of(Names, Variable, Name)
    ).

first_variable([Name0=Value|Names], Name) :-
    (   var(Value)
    ->  Name = Name0
    ;   first_variable(Names, Name)
    ).

%   A port or another word of the pack was meant, as by `OutB`.

named(Name, Text) :-
    (   sub_atom(Name, 0, 1, _, Upper),
        sub_atom(Name, 1, _, 0, Rest),
        downcase_atom(Upper, Lower),
        atom_concat(Lower, Rest, Word),
        is_word(Word)
    ->  format(atom(Text),
               '~w begins with an upper-case letter, so it is a variable, \c
                and has no value. Did you mean ~w?', [Name, Word])
    ;   format(atom(Text), '~w is a variable without a value', [Name])
    ).

%!  is_word(+Atom) is semidet.
%
%   True if Atom is a port, or an allowed value of a domain.

is_word(Word) :-
    (   atom_concat(out, Letter, Word),
        memberchk(Letter, ['A', 'B', 'C', 'D'])
    ;   atom_concat(in, Digit, Word),
        memberchk(Digit, ['1', '2', '3', '4'])
    ;   allowed(Domain, Words),
        \+ sub_atom(Domain, _, _, 0, option),
        is_list(Words),
        memberchk(Word, Words)
    ),
    !.

                /*******************************
                *      FRAMES ARE KEPT         *
                *******************************/

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
    ->  arg(1, Body, Begin),
        arg(2, Body, End),
        Layout = term_position(From, To, NeckFrom, NeckTo,
                               [ Head,
                                 term_position(Begin, End, End, End,
                                               [Body, End-End])
                               ])
    ;   Layout = Layout0
    ).
