:- module(old_guards,
          [ verdict/2,                  % ?Goal, -Truth
            branch/4                    % +Directive, +Open0, -Open, -Goal
          ]).
:- use_module(facts, [old/2]).
:- use_module(scope, [elsewhere/2, newer/2]).
:- use_module(terms, [indicator/2]).

/** <module> The answers of SWI-Prolog 7.2.3 to tests of its version

Such as `current_prolog_flag(version, V), V >= 70508`, current_predicate/1 or
exists_source/1.
*/

%!  verdict(?Goal, -Truth) is det.
%
%   Truth is `true` or `false` if it is known how Goal ends in 7.2.3; else
%   `unknown`. A variable is bound if 7.2.3 would bind it to its version.

verdict(Goal, Truth) :-
    (   nonvar(Goal),
        decided(Goal, Truth0)
    ->  Truth = Truth0
    ;   Truth = unknown
    ).

decided(true, true).
decided(fail, false).
decided(false, false).
decided((A, B), Truth) :-
    verdict(A, TruthA),
    (   TruthA == false
    ->  Truth = false
    ;   verdict(B, TruthB),
        both(TruthA, TruthB, Truth)
    ).
decided((A ; B), Truth) :-
    \+ A = (_ -> _),
    \+ A = (_ *-> _),
    verdict(\+ ( \+ A, \+ B ), Truth).
decided(\+ Goal, Truth) :-
    verdict(Goal, Truth0),
    opposite(Truth0, Truth).
decided(catch(Goal, _, _), Truth) :-
    verdict(Goal, Truth).
decided(current_prolog_flag(Flag, Value), Truth) :-
    atom(Flag),
    (   Flag == version
    ->  (   Value = 70203
        ->  Truth = true
        ;   Truth = false
        )
    ;   newer(flag-Flag, _),
        Truth = false
    ).
decided(A < B, Truth)   :- compared(A < B, Truth).
decided(A > B, Truth)   :- compared(A > B, Truth).
decided(A =< B, Truth)  :- compared(A =< B, Truth).
decided(A >= B, Truth)  :- compared(A >= B, Truth).
decided(A =:= B, Truth) :- compared(A =:= B, Truth).
decided(A =\= B, Truth) :- compared(A =\= B, Truth).
decided(current_predicate(Predicate0), false) :-
    strip_module(Predicate0, Module, Predicate),
    nonvar(Predicate),
    Predicate = Name/Arity,
    atom(Name),
    integer(Arity),
    functor(Head, Name, Arity),
    unknown_head(Module:Head).
decided(current_predicate(_, Head), false) :-
    unknown_head(Head).
decided(predicate_property(Head, _), false) :-
    unknown_head(Head).
decided(exists_source(Spec), false) :-
    nonvar(Spec),
    Spec = library(Library),
    newer(library-Library, _).
decided(current_arithmetic_function(Head), Truth) :-
    callable(Head),
    indicator(Head, Function),
    (   old(function, Function)
    ->  Truth = true
    ;   Truth = false
    ).
decided(current_op(Priority, Type, Name), false) :-
    atom(Name),
    \+ old(operator, op(Priority, Type, Name)).

both(true, true, true) :-
    !.
both(A, B, false) :-
    memberchk(false, [A, B]),
    !.
both(_, _, unknown).

opposite(true, false).
opposite(false, true).
opposite(unknown, unknown).

compared(Comparison, Truth) :-
    Comparison =.. [_, A, B],
    integer(A),
    integer(B),
    (   call(Comparison)
    ->  Truth = true
    ;   Truth = false
    ).

unknown_head(Head0) :-
    strip_module(Head0, Module, Head),
    callable(Head),
    Head \= _:_,
    \+ elsewhere(Module, Head),
    indicator(Head, Predicate),
    newer(predicate-Predicate, _).

%!  branch(+Directive, +Branches0, -Branches, -Condition) is semidet.
%
%   True if Directive is one of conditional compilation. Branches are those
%   that are open after it, the innermost first: a branch(Taken, Before) says
%   whether 7.2.3 takes it (`true`, `false` or `unknown`), and whether it took
%   an earlier one. Condition is the goal that 7.2.3 calls, or `true`.

branch(if(Goal), Branches, [branch(Taken, false)|Branches], Condition) :-
    (   memberchk(branch(false, _), Branches)
    ->  Taken = false,
        Condition = true
    ;   verdict(Goal, Taken),
        Condition = Goal
    ).
branch(elif(Goal), [Branch|Branches], [branch(Taken, Before)|Branches],
       Condition) :-
    before(Branch, Before),
    (   ( Before == true ; memberchk(branch(false, _), Branches) )
    ->  Taken = false,
        Condition = true
    ;   verdict(Goal, Taken),
        Condition = Goal
    ).
branch(else, [Branch|Branches], [branch(Taken, Before)|Branches], true) :-
    before(Branch, Before),
    (   Before == true
    ->  Taken = false
    ;   Taken = unknown
    ).
branch(endif, [_|Branches], Branches, true).

before(branch(Taken, Before), Earlier) :-
    (   memberchk(true, [Taken, Before])
    ->  Earlier = true
    ;   Earlier = false
    ).
