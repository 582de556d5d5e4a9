% For benches/run.py, which counts the instructions of a call.

:- use_module(library(ev3dev)).

%!  calls(+Count, :Goal) is det.
%
%   Call Goal Count times, in a loop as a program has it: a recursive predicate, made
%   here and compiled, that calls it directly.

calls(Count, Goal) :-
    asserta(( loop(0) :- ! )),
    assertz(( loop(N) :- Goal, !, M is N - 1, loop(M) )),
    loop(Count).
