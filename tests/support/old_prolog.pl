:- module(old_prolog,
          [ evaluated/2                 % +Expression, -Number
          ]).

/** <module> Predicates that SWI-Prolog 7.2.3, the brick's, lacks

Lambda expressions, library(yall), came with 7.3.2. Where they are missing this
module has the part that the tests use: `[X1, ...]>>Goal`, called with as many
arguments, of which each call sees its own copy.
*/

%!  evaluated(+Expression, -Number) is semidet.
%
%   True if this Prolog evaluates Expression to Number. The functions `inf` and
%   `nan` came with 7.3.15: before, a program has no such numbers.

evaluated(Expression, Number) :-
    catch(Number is Expression,
          error(type_error(evaluable, Function/0), _),
          ( memberchk(Function, [inf, nan]), fail )).

:- if(exists_source(library(yall))).

:- reexport(library(yall), [ (>>)/2, (>>)/3, (>>)/4, (>>)/5, (>>)/6 ]).

:- else.

:- export(( (>>)/3, (>>)/4, (>>)/5, (>>)/6 )).

:- meta_predicate
    >>(?, 0, ?),
    >>(?, 0, ?, ?),
    >>(?, 0, ?, ?, ?),
    >>(?, 0, ?, ?, ?, ?).

>>(Parameters, Goal, A) :-
    called_with(Parameters, Goal, [A]).
>>(Parameters, Goal, A, B) :-
    called_with(Parameters, Goal, [A, B]).
>>(Parameters, Goal, A, B, C) :-
    called_with(Parameters, Goal, [A, B, C]).
>>(Parameters, Goal, A, B, C, D) :-
    called_with(Parameters, Goal, [A, B, C, D]).

called_with(Parameters, Goal, Arguments) :-
    copy_term_nat(Parameters-Goal, Arguments-Call),
    call(Call).

:- endif.
