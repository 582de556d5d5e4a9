:- module(random_programs,
          [ random_program/4            % +Seed, +Depth, +Words, -Program
          ]).
:- use_module(library(random)).

/** <module> Random programs of Golog

Words are words(Actions, Conditions, Constructs): what the programs are made
of. Each of Constructs is a term that stands for itself, with these arguments
in the place of parts: program, action, condition, variable(Program), a
program in which the name `v` stands for one of the numbers 1 to 3.
*/

%!  random_program(+Seed, +Depth, +Words, -Program) is det.
%
%   Program is the same for each Seed, and Depth constructs deep.

random_program(Seed, Depth, Words, Program) :-
    set_random(seed(Seed)),
    part(program, Depth, Words, Program).

part(Kind, Depth, Words, Part) :-
    Words = words(Actions, Conditions, Constructs),
    (   Kind == action
    ->  random_member(Part, Actions)
    ;   Kind == condition
    ->  condition(1, Conditions, Part)
    ;   Kind == program
    ->  (   Depth =:= 0
        ->  leaf(Words, Part)
        ;   Depth1 is Depth-1,
            random_member(Construct, Constructs),
            filled(Construct, Depth1, Words, Part)
        )
    ;   Part = Kind
    ).

leaf(Words, Part) :-
    random_between(0, 3, Which),
    (   Which =:= 0
    ->  part(condition, 0, Words, Condition),
        Part = ?(Condition)
    ;   part(action, 0, Words, Part)
    ).

filled(Construct, Depth, Words, Part) :-
    (   compound(Construct)
    ->  Construct =.. [Name|Kinds],
        all_filled(Kinds, Depth, Words, Parts),
        Part =.. [Name|Parts]
    ;   part(Construct, Depth, Words, Part)
    ).

all_filled([], _, _, []).
all_filled([Kind|Kinds], Depth, Words, [Part|Parts]) :-
    filled(Kind, Depth, Words, Part),
    all_filled(Kinds, Depth, Words, Parts).

condition(Depth, Conditions, Condition) :-
    random_between(0, 4, Which),
    (   Depth > 0,
        Which < 3
    ->  Depth1 is Depth-1,
        condition(Depth1, Conditions, A),
        (   Which =:= 0
        ->  Condition = neg(A)
        ;   condition(Depth1, Conditions, B),
            ( Which =:= 1 -> Condition = and(A, B) ; Condition = or(A, B) )
        )
    ;   random_member(Condition, Conditions)
    ).
