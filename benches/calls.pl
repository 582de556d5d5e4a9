% For benches/run.py, which counts the instructions of a call.

:- use_module(library(ev3dev)).

%!  count(+Times, +Count, +Goals) is det.
%
%   For each Goal, Times times: call it Count times; then Times times: twice as often. It
%   is called in a loop as a program has it, which is a recursive predicate that is made
%   here and compiled, and calls it directly.
%   Callgrind counts from a call of unsetenv(3), before each loop, to one of getenv(3), after it.

count(Times, Count, Goals) :-
    findall(Loop-Goal,
            ( nth1(Number, Goals, Goal), atom_concat(loop, Number, Loop) ),
            Loops),
    maplist(make, Loops),
    forall(member(Loop-_, Loops), call(Loop, 100)),
    forall(( member(Loop-_, Loops), member(Factor, [1, 2]), between(1, Times, _) ),
           ( N is Factor * Count,
             call(Loop, 1),
             unsetenv('EV3DEV_BENCH_MARK'),
             call(Loop, N),
             \+ getenv('EV3DEV_BENCH_MARK', _) )).

make(Loop-Goal) :-
    End =.. [Loop, 0],
    Head =.. [Loop, N],
    Next =.. [Loop, M],
    assertz(( End :- ! )),
    assertz(( Head :- Goal, !, M is N - 1, Next )).
