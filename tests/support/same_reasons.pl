:- module(same_reasons,
          [ said_by_try/4,              % +Exercise, +File, +Options, -Text
            marked_reasons/4,           % +Exercise, +Files, +Options, -Reasons
            tried_reason/2              % +Text, -Reason
          ]).
:- use_module(library(ev3dev/exercise)).

/** <module> The reasons that `try` and `mark` give for the points of a program
*/

said_by_try(Exercise, File, Options, Text) :-
    with_output_to(string(Text), ignore(exercise_try(Exercise, File, Options))).

marked_reasons(Exercise, Files, Options, Reasons) :-
    exercise_mark(Exercise, Files, Options, Marks),
    findall(Reason, member(mark(_, _, _, _, _, Reason), Marks), Reasons).

%!  tried_reason(+Text, -Reason) is det.
%
%   What `try` says after the points, in the form of a mark's reason. What other runs ran into is
%   on the page of a mark.

tried_reason(Text, Reason) :-
    split_string(Text, "\n", "", Lines0),
    findall(Line,
            ( member(Line0, Lines0),
              Line0 \== "",
              \+ wildcard_match("With the seed * it ran into *", Line0),
              split_string(Line0, "", " ", [Line]) ),
            Lines1),
    (   append(_, [Points|Lines2], Lines1),
        sub_string(Points, 0, _, _, "Together: ")
    ->  true
    ;   Lines2 = Lines1
    ),
    ( Lines2 = [Seed|Lines], wildcard_match("With the seed *:", Seed) -> true ; Lines = Lines2 ),
    joined(Lines, Reason).

joined([], '').
joined([First|Others], Reason) :-
    (   Others == []
    ->  atom_string(Reason, First)
    ;   atomic_list_concat(Others, '; ', Listed),
        ( sub_string(First, _, 1, 0, ".") -> End = "" ; End = "." ),
        format(atom(Reason), '~w~w Also: ~w', [First, End, Listed])
    ).
