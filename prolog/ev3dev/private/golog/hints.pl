:- module(ev3dev_golog_hints,
          [ hint/3,                     % +Term, +Module, -Text
            declared_hint/4,            % +Kind, +Term, +Module, -Text
            meant_words/4               % +Kind, +Term, +Module, -Text
          ]).
:- use_module(library(lists), [member/2]).
:- use_module(theory, [has_clauses/2, has_situations/1, names_of/3]).
:- use_module('../errors/error_texts', [nearly/3]).

/** <module> Hints for the notation of books and other systems
*/

%!  hint(+Term, +Module, -Text) is det.
%
%   Term is not a construct, and stands for nothing in the domain of Module.
%   Text is what may follow in the message: how this library writes it, or
%   empty.

hint(Term, Module, Text) :-
    (   compound(Term),
        compound_name_arity(Term, Name, 0)
    ->  format(atom(Text), '. Write ~q, without ()', [Name])
    ;   callable(Term),
        functor(Term, Name, Arity),
        written(Name/Arity, Here)
    ->  format(atom(Text), '. Write ~w', [Here])
    ;   has_situations(Module),
        functor(Term, Name, Arity0),
        Arity is Arity0+1,
        current_predicate(Module:Name/Arity)
    ->  format(atom(Text), '. There is ~q with a situation: restoreSitArg/3 \c
                            must name it', [Name/Arity])
    ;   other_name(Theirs, Head, Ours),
        has_clauses(Module, Theirs),
        \+ has_clauses(Module, Head)
    ->  functor(Theirs, TheirName, TheirArity),
        format(atom(Text), '. The module ~q has ~q; here it is ~w',
               [Module, TheirName/TheirArity, Ours])
    ;   \+ has_clauses(Module, prim_action(_))
    ->  format(atom(Text), '. The module ~q has no prim_action/1', [Module])
    ;   Text = ''
    ).

written((;)/2, '[P, Q] for P;Q in a program').
written((',')/2, '[P, Q] for P, Q in a program').
written(('|')/2, 'ndet(P, Q) for P|Q').
written(or/2, 'ndet(P, Q) in a program').
written(~ /1, 'neg(P) for ~P').
written(exists/2, 'some(x, P) for exists').
written(forall/2, 'all(x, P)').
written(if/2, 'if(C, P, []) for an `if` without `else`').
written((par)/2, 'conc(P, Q)').
written((conc)/1, 'conc(P, Q)').

other_name(primitive_action(_), prim_action(_),
           'prim_action/1, or use library(ev3dev/golog_classic)').
other_name(primitive_fluent(_), prim_fluent(_), prim_fluent/1).
other_name(exogenous_action(_), exog_action(_), exog_action/1).

%!  declared_hint(+Kind, +Term, +Module, -Text) is det.
%
%   Text says that Term is no Kind of the domain: `action`, `exogenous` or
%   `fluent`, and which one may be meant.

declared_hint(Kind, Term, Module, Text) :-
    indicator(Term, PI),
    declaration(Kind, Words, Declaration),
    meant_words(Kind, Term, Module, Meant),
    format(atom(Text), 'there is no ~w ~q; ~w declares one~w',
           [Words, PI, Declaration, Meant]).

declaration(action, action, prim_action/1).
declaration(exogenous, 'exogenous action', exog_action/1).
declaration(fluent, fluent, prim_fluent/1).

indicator(Term, PI) :-
    (   compound(Term)
    ->  compound_name_arity(Term, Name, Arity), % also of go()
        PI = Name/Arity
    ;   PI = Term/0
    ).

%!  meant_words(+Kind, +Term, +Module, -Text) is det.
%
%   Text is `. Did you mean ..?` with the Kind whose name is nearly that of
%   Term; else `. There are: ..` with all, if these are few; else empty.

meant_words(Kind, Term, Module, Text) :-
    indicator(Term, Name/_),
    kinds(Kind, Kinds),
    findall(PI, ( member(Kind1, Kinds), names_of(Kind1, Module, PI) ), PIs0),
    sort(PIs0, PIs),
    findall(Known, member(Known/_, PIs), Names0),
    sort(Names0, Names),
    (   near(Name, Names, Near)
    ->  findall(Near/Arity, member(Near/Arity, PIs), Meant),
        listed(Meant, ' or ', Listed),
        format(atom(Text), '. Did you mean ~w?', [Listed])
    ;   length(PIs, Count),
        between(1, 8, Count)
    ->  listed(PIs, ', ', Listed),
        format(atom(Text), '. There are: ~w', [Listed])
    ;   Text = ''
    ).

%   As nearly/3 says, or with two letters that are others.

near(Name, Names, Near) :-
    (   nearly(Name, Names, Near0)
    ->  Near = Near0
    ;   atom_length(Name, Length),
        Length > 3,
        atom_codes(Name, Codes),
        findall(Other,
                ( member(Other, Names),
                  atom_codes(Other, OtherCodes),
                  are_edits(Codes, OtherCodes, 2) ),
                [Near])
    ).

%   are_edits(+Codes1, +Codes2, +Most) is semidet: at most that many codes are
%   to be put in, left out, or replaced.

are_edits([], Ys, Most) :-
    length(Ys, Edits),
    Edits =< Most.
are_edits([X|Xs], Ys, Most) :-
    (   Ys = [X|Ys1]
    ->  are_edits(Xs, Ys1, Most)
    ;   Most > 0,
        Less is Most-1,
        (   are_edits(Xs, Ys, Less)
        ;   Ys = [_|Ys1],
            (   are_edits(Xs, Ys1, Less)
            ;   are_edits([X|Xs], Ys1, Less)
            )
        )
    ->  true
    ).

listed(PIs, Between, Text) :-
    findall(Atom, ( member(PI, PIs), format(atom(Atom), '~q', [PI]) ), Atoms),
    atomic_list_concat(Atoms, Between, Text).

kinds(action, [action, exogenous]).
kinds(exogenous, [exogenous]).
kinds(fluent, [fluent, derived]).
