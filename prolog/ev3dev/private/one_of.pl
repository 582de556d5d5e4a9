:- module(ev3dev_one_of,
          [ one_of/2                    % +List, ?Element
          ]).

/** <module> member/2 without library(lists)

To load that library takes a brick a fifth of a second, and in its SWI-Prolog
nothing else that the pack loads needs it.
*/

%!  one_of(+List, ?Element) is nondet.
%
%   True if Element is one of List. The last one leaves no choice.

one_of([Element0|Elements], Element) :-
    one_of(Elements, Element0, Element).

one_of(_, Element, Element).
one_of([Element1|Elements], _, Element) :-
    one_of(Elements, Element1, Element).
