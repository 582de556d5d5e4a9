:- module(ev3dev_error_texts,
          [ in_words/3,                 % +Formal, +Frame, -Text
            not_one_of/3,               % +Term, +Values, -Text
            nearly/3,                   % +Term, +Values, -Value
            no_value/3,                 % ?Variable, +Frame, -Text
            shown/2,                    % +Term, -Shown
            clause_place/2,             % +Clause, -Place
            place_text/2,               % +Place, -Text
            place_first/2,              % +Place, -Text
            item_said/3,                % +Item, +Text, -Said
            is_word/1,                  % +Atom
            nth/2                       % +Place, -Nth
          ]).
:- use_module(domains, [allowed/2]).
:- use_module('../basics/small_lists', [one_of/2]).

/** <module> Errors in words

What is wrong with a term, and which values are allowed.
*/

%!  in_words(+Formal, +Frame, -Text) is semidet.
%
%   Text explains the ISO term Formal. Of an argument of the call in Frame it
%   says which one it is.

in_words(type_error(evaluable, Name/0), Frame, Text) :-
    !,
    must_be_words('a number', Name, Frame, Text).
in_words(type_error(evaluable, Function), _, Text) :-
    !,
    format(atom(Text), 'there is no arithmetic function ~q', [Function]).
in_words(type_error(Type, Term), Frame, Text) :-
    memberchk(Type, [[], character]),   % of is/2, for a string or a list
    !,
    must_be_words('a number', Term, Frame, Text).
in_words(type_error(Type, Term), Frame, Text) :-
    !,
    kind(Type, Wanted),
    must_be_words(Wanted, Term, Frame, Text0),
    (   Type == list,
        callable(Term),
        Term \= [_|_]
    ->  shown(Term, Shown),
        format(atom(Text), '~w. Did you mean [~w]?', [Text0, Shown])
    ;   Text = Text0
    ).
in_words(domain_error(Domain, Term), _, Text) :-
    allowed(Domain, What),
    !,
    (   is_list(What)
    ->  not_one_of(Term, What, Text)
    ;   shown(Term, Shown),
        format(atom(Text), '~w, not ~w', [What, Shown])
    ).
in_words(domain_error(Domain, Term), _, Text) :-
    words_of(Domain, Words),
    shown(Term, Shown),
    format(atom(Text), '~w cannot be a ~w', [Shown, Words]).
in_words(existence_error(source_sink, File), _, Text) :-
    !,
    shown(File, Shown),
    format(atom(Text), 'there is no file ~w, or no folder for it', [Shown]).
in_words(existence_error(Kind, Name), _, Text) :-
    words_of(Kind, Words),
    shown(Name, Shown),
    format(atom(Text), 'there is no ~w ~w', [Words, Shown]).
in_words(evaluation_error(What), _, Text) :-
    words_of(What, Text).
in_words(representation_error(int64_t), _, Text) :-
    !,
    Text = 'an integer of at most 64 bits is expected'.
in_words(representation_error(What), _, Text) :-
    words_of(What, Words),
    format(atom(Text), 'beyond the ~w', [Words]).

must_be_words(Wanted, Term, Frame, Text) :-
    shown(Term, Shown),
    (   Frame \== none,
        arguments(Frame, Arguments),
        place(Arguments, Term, 1, Place)
    ->  nth(Place, Nth),
        format(atom(Text), 'the ~w argument must be ~w, not ~w',
               [Nth, Wanted, Shown])
    ;   format(atom(Text), '~w is expected, not ~w', [Wanted, Shown])
    ).

kind(atom, 'an atom or a string') :- !.
kind(text, 'an atom or a string') :- !.
kind(callable, 'a goal') :- !.
kind(bool, 'true or false') :- !.
kind(list, 'a list') :- !.
kind(integer, 'an integer') :- !.
kind(nonneg, 'an integer of at least 0') :- !.
kind(positive_integer, 'an integer of at least 1') :- !.
kind(Type, Text) :-
    words_of(Type, Words),
    format(atom(Text), 'a ~w', [Words]).

words_of(Name, Words) :-
    (   atom(Name)
    ->  atomic_list_concat(Parts, '_', Name),
        atomic_list_concat(Parts, ' ', Words)
    ;   format(atom(Words), '~p', [Name])
    ).

%!  not_one_of(+Term, +Values, -Text) is det.
%
%   Text says that Term is not one of Values.

not_one_of(Term, Values, Text) :-
    quoted(Values, Atoms),
    atomic_list_concat(Atoms, ', ', Listed),
    shown(Term, Shown),
    (   nearly(Term, Values, Value)
    ->  format(atom(Text), '~w is not one of: ~w. Did you mean ~w?',
               [Shown, Listed, Value])
    ;   format(atom(Text), '~w is not one of: ~w', [Shown, Listed])
    ).

%!  nearly(+Term, +Values, -Value) is semidet.
%
%   Value is the only one of Values that is spelt nearly as Term, or begins
%   so. Of an option the name counts.

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

%!  item_said(+Item, +Text, -Said) is det.
%
%   What the simulator says of an Item: Text begins with a verb, or has a
%   subject of its own.

item_said(Item, Text, Said) :-
    (   one_of([ is, has, have, needs, must, stands, lies, does, cannot ],
               Verb),
        atom_concat(Verb, ' ', Begin),
        sub_atom(Text, 0, _, _, Begin)
    ->  Between = ' '
    ;   Between = ': '
    ),
    format(atom(Said), '~w~w~w', [Item, Between, Text]).

%!  clause_place(+Clause, -Place) is det.
%!  place_text(+Place, -Text) is det.
%!  place_first(+Place, -Text) is det.
%
%   Place is the File:Line of a Clause, or `none`. Text names it after what is
%   there, or before it, without the folder, or is empty. A library that makes
%   clauses of what it reads says by written_at/2 where that is.

:- multifile written_at/2.              % +Clause, -Place

clause_place(Clause, Place) :-
    (   written_at(Clause, Place0)
    ->  Place = Place0
    ;   clause_property(Clause, file(File)),
        clause_property(Clause, line_count(Line))
    ->  Place = File:Line
    ;   Place = none
    ).

place_text(none, '').
place_text(File:Line, Text) :-
    file_base_name(File, Base),
    format(atom(Text), ' (~w:~w)', [Base, Line]).

place_first(none, '').
place_first(File:Line, Text) :-
    file_base_name(File, Base),
    format(atom(Text), '~w:~w: ', [Base, Line]).

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

% ---------------- VARIABLES, NO VALUES

%!  no_value(?Variable, +Frame, -Text) is det.
%
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

%!  nth(+Place, -Nth) is det.
%
%   Nth is the word for a Place: `first` for 1.

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
