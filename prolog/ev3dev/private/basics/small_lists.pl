:- module(ev3dev_small_lists,
          [ one_of/2,                   % +List, ?Element
            append_lists/3,             % ?List1, ?List2, ?List
            and_list/2,                 % +Names, -Text
            first_of/3                  % +Count, +List, -First
          ]).

/** <module> member/2 and append/3 without library(lists)

Loading that library takes a fifth of a second on a brick, and in its
SWI-Prolog no other file of the pack needs it.
*/

%!  one_of(+List, ?Element) is nondet.
%
%   True if Element is an element of List. The last element leaves no choice
%   point.

one_of([Element0|Elements], Element) :-
    one_of(Elements, Element0, Element).

one_of(_, Element, Element).
one_of([Element1|Elements], _, Element) :-
    one_of(Elements, Element1, Element).

%!  append_lists(?List1, ?List2, ?List) is nondet.
%
%   True if List has the elements of List1, then those of List2.

append_lists([], List, List).
append_lists([X|Xs], Ys, [X|Zs]) :-
    append_lists(Xs, Ys, Zs).

%!  and_list(+Names, -Text) is det.
%
%   Text is an atom such as `outA, outB and outC`. Names has at least one.

and_list([Name], Name) :-
    !.
and_list([First, Last], Text) :-
    !,
    atomic_list_concat([First, ' and ', Last], Text).
and_list([Name|Names], Text) :-
    and_list(Names, Text0),
    atomic_list_concat([Name, ', ', Text0], Text).

%!  first_of(+Count, +List, -First) is det.
%
%   First has the first Count elements of List, or all if there are fewer.

first_of(Count, List, First) :-
    (   Count > 0,
        List = [X|Xs]
    ->  First = [X|First1],
        Count1 is Count - 1,
        first_of(Count1, Xs, First1)
    ;   First = []
    ).
