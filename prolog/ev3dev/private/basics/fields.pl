:- module(ev3dev_fields,
          [ fields/1,                   % +Record
            is_named/2,                 % +Term, -Record
            term_expansion/2,           % +Clause, -Expanded
            goal_expansion/2            % +Goal0, -Goal
          ]).
:- set_prolog_flag(generate_debug_info, false).
:- use_module(small_lists, [one_of/2]).

/** <module> Records whose fields have names

A module that imports fields/1 and the two expansions declares a record, such
as

    :- fields(wheel(port, diameter, inverted)).

Then wheel(diameter: D) in a goal means wheel(_, D, _), and the goal
set_field(Wheel, wheel(diameter: D)) means nb_setarg/3 of the second argument;
link_field/2 is the same for nb_linkarg/3. All are replaced when the file is
compiled, so they cost nothing when they are called; library(record) would
cost a call for each access. The head of a clause has no names: Prolog keeps
the layout of a clause, by which it finds calls, only if its head stays.
*/

:- dynamic record/2.                    % Name, Fields

%!  fields(+Record) is det.
%
%   The arguments of Record are the names of its fields. The name of a record
%   means the same in all modules.

fields(Record) :-
    Record =.. [Name|Fields],
    retractall(record(Name, _)),
    assertz(record(Name, Fields)).

positional(Term0, Term) :-
    (   nonvar(Term0),
        changes(Term0, Named, I, Value, Term)
    ->  compound_name_arguments(Named, Name, [Field:Value]),
        record(Name, Fields),
        place(Fields, Field, 1, I)
    ;   compound(Term0)
    ->  compound_name_arguments(Term0, Name, Args0),
        (   record(Name, Fields),
            are_named(Args0)
        ->  values(Fields, Values0),
            placed(Args0, Fields, Values0)
        ;   Values0 = Args0
        ),
        all_positional(Values0, Values),
        compound_name_arguments(Term, Name, Values)
    ;   Term = Term0
    ).

changes(set_field(Record, Named), Named, I, Value,
        nb_setarg(I, Record, Value)).
changes(link_field(Record, Named), Named, I, Value,
        nb_linkarg(I, Record, Value)).

all_positional([], []).
all_positional([Term0|Terms0], [Term|Terms]) :-
    positional(Term0, Term),
    all_positional(Terms0, Terms).

are_named([Arg|Args]) :-
    nonvar(Arg),
    Arg = Field:_,
    atom(Field),
    (   Args == []
    ->  true
    ;   are_named(Args)
    ).

values([], []).
values([_|Fields], [_|Values]) :-
    values(Fields, Values).

placed([], _, _).
placed([Field:Value|Args], Fields, Values) :-
    (   place(Fields, Field, 1, I)
    ->  true
    ;   throw(error(existence_error(field, Field), _))
    ),
    nth(I, Values, Value),
    placed(Args, Fields, Values).

place([Field|_], Field, I, I) :- !.
place([_|Fields], Field, I0, I) :-
    I1 is I0+1,
    place(Fields, Field, I1, I).

nth(1, [Value|_], Value) :- !.
nth(I, [_|Values], Value) :-
    I1 is I-1,
    nth(I1, Values, Value).

%!  is_named(+Term, -Record) is semidet.
%
%   Record is the name of the first record in Term whose fields have names.

is_named(Term, Record) :-
    compound(Term),
    compound_name_arguments(Term, Name, Args),
    (   record(Name, _),
        are_named(Args)
    ->  Record = Name
    ;   one_of(Args, Arg),
        is_named(Arg, Record)
    ->  true
    ).

%!  term_expansion(+Clause, -Expanded) is semidet.
%
%   Fails.
%
%   @error permission_error(name_fields, head, Record)

term_expansion(Clause, _) :-
    (   ( Clause = (Head :- _) ; Clause = (Head --> _) )
    ->  true
    ;   Head = Clause
    ),
    is_named(Head, Record),
    throw(error(permission_error(name_fields, head, Record), _)).

%!  goal_expansion(+Goal0, -Goal) is semidet.
%
%   It stands last, as Prolog calls it also for the clauses of this file.

goal_expansion(Goal0, Goal) :-
    positional(Goal0, Goal),
    Goal0 \== Goal.
