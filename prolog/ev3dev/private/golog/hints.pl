:- module(ev3dev_golog_hints,
          [ hint/3                      % +Term, +Module, -Text
          ]).
:- use_module(theory, [has_clauses/2, has_situations/1]).

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
