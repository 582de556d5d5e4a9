:- module(ev3dev_errors,
          [ in_own_name/1,              % :Goal
            type_error/2,               % +Type, +Term
            domain_error/2,             % +Domain, +Term
            existence_error/2,          % +Kind, +Name
            instantiation_error/1,      % +Term
            throw_error/3,              % +Formal, +Called, +Message
            error_within/3,             % +Error0, +Where, -Error
            named_called/2              % ?Called0, -Called
          ]).
:- use_module(error_texts, [in_words/3, no_value/3, not_one_of/3]).
:- use_module(frames, [called_by_program/2, in_pack/3, is_public/2]).

/** <module> Errors that name what was called

This module throws every error of the pack. The context of an error names the
predicate that the program called, not one that this predicate calls. It says
in words what is wrong, and lists the allowed values of a closed set. The
predicates have the names and meanings of those in library(error).
*/

:- meta_predicate in_own_name(0).

%!  in_own_name(:Goal) is nondet.
%
%   Call a Goal of Prolog's own library. Its errors name the predicate that
%   the program called.

in_own_name(Goal) :-
    catch(Goal, error(Formal, _), throw_formal(Formal)).

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
    ;   in_words(Formal, Frame, Text)
    ->  true
    ;   true
    ),
    throw(error(Formal, context(Called, Text))).

%!  error_within(+Error0, +Where, -Error) is det.
%
%   Error is Error0, and its message also says Where it occurred: a text as
%   `in the guard of rule avoid`.

error_within(error(resource_error(What), Context), _,
             error(resource_error(What), Context)) :-
    !.                                  % it says what filled the stack
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
