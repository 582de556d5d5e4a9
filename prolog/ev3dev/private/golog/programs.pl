:- module(ev3dev_golog_programs,
          [ fresh/4,                    % +Variables, +Term0, -Term, -Choices
            renamed/2,                  % +Term0, -Term
            mapped/3,                   % :Closure, +Term0, -Term
            has_binder/1,               % +Term
            closed/1,                   % +Term
            construct/1,                % ?Program
            weak_construct/1,           % ?Program
            parts/5,                    % +Program0, ?Use, -Parts0, ?Parts,
                                        % -Program
            condition_construct/1,      % ?Condition
            in_books/2,                 % ?Condition, -Ours
            negated/2                   % +Condition, -Negated
          ]).
:- use_module(library(lists), [append/3]).

/** <module> Golog programs as terms

Constructs such as pi/2, some/2, for/3 and interrupt/3 bind variables. Such a
variable is an atom or a Prolog variable. A variable is replaced before its
scope runs. Names are kept apart: an inner construct that binds the same name
again keeps its own, and a value never becomes a variable.
*/

%!  construct(?Program) is nondet.
%
%   True if Program has the form of a construct of the language.

construct([]).
construct([_|_]).
construct(?(_)).
construct(ndet(_, _)).
construct(if(_, _, _)).
construct(while(_, _)).
construct(star(_)).
construct(star(_, _)).
construct(pi(_, _)).
construct(pi(_, _, _)).
construct(conc(_, _)).
construct('$turn'(_, _)).
construct(pconc(_, _)).
construct(iconc(_)).
construct(interrupt(_, _)).
construct(interrupt(_, _, _)).
construct(prioritized_interrupts(_)).
construct(prioritized_interrupts_simple(_)).
construct(search(_)).
construct(search(_, _)).
construct(search(_, _, _)).
construct(searchc(_)).
construct(searchc(_, _)).
construct(searchn(_, _)).
construct('$path'(_Program, _, _, _)).
construct(gexec(_, _)).
construct(gexec2(_, _)).
construct(goal(_Until, _, _, _)).
construct(wndet(_, _)).
construct(rndet(_, _)).
construct(rpi(_, _)).
construct(rpi(_, _, _)).
construct(rconc(_)).
construct(rconc(_, _)).
construct(rrobin(_)).
construct(atomic(_)).
construct('$atomic'(_)).
construct('$within'(_, _)).
construct(for(_, _, _)).
construct(??(_)).
construct(exogint(_, _)).
construct(_ : _).
construct(#(_, _)).

%!  weak_construct(?Program) is nondet.
%
%   As construct/1, but a procedure or an action of the domain that has the
%   same name and number of arguments comes first.

weak_construct(wait).
weak_construct(wait_exog).
weak_construct(sim(_)).
weak_construct(achieve(_)).
weak_construct(achieve(_, _)).
weak_construct(abort).
weak_construct(abort(_)).
weak_construct(commit).
weak_construct(branch(_)).
weak_construct(set(_)).
weak_construct(unset(_)).
weak_construct(e(_, _)).
weak_construct(time(_, _)).
weak_construct(ttime(_, _)).
weak_construct(sync(_)).
weak_construct(together(_)).

%!  parts(+Program0, ?Use, -Parts0, ?Parts, -Program) is semidet.
%
%   Parts0 are the parts of the construct Program0, a list, of which one takes
%   its next step; Program is Program0 with Parts in their place. Fails if a
%   step of Program0 need not be one of a part. Use is `all`: Program0 may end
%   when all of them may; `first`: as `all`, and none is under way, as the
%   first step leaves Program0; `own`: it has a rule of its own for its end.

parts([E0|Es], own, [E0], [E], [E|Es]).
parts(wndet(A0, B0), first, [A0, B0], [A, B], wndet(A, B)).
parts(conc(A0, B0), all, [A0, B0], [A, B], conc(A, B)).
parts('$turn'(A0, B0), all, [A0, B0], [A, B], '$turn'(A, B)).
parts(pconc(A0, B0), all, [A0, B0], [A, B], pconc(A, B)).
parts(rconc(A0, B0), all, [A0, B0], [A, B], rconc(A, B)).
parts(rconc(Es0), all, Es0, Es, rconc(Es)).
parts(rrobin(Es0), all, Es0, Es, rrobin(Es)).
parts(sync(Es0), all, Es0, Es, sync(Es)).
parts(prioritized_interrupts(Es0), own, Es0, Es, prioritized_interrupts(Es)).
parts(search(E0), first, [E0], [E], search(E)).
parts(search(E0, M), first, [E0], [E], search(E, M)).
parts(search(E0, M, Options), first, [E0], [E], search(E, M, Options)).
parts(searchn(E0, M), first, [E0], [E], searchn(E, M)).
parts(searchc(E0), first, [E0], [E], searchc(E)).
parts(searchc(E0, M), first, [E0], [E], searchc(E, M)).
parts(gexec(C, E0), own, [E0], [E], gexec(C, E)).
parts(gexec2(C, E0), own, [E0], [E], gexec2(C, E)).
parts(goal(P, E0, F, R), own, [E0], [E], goal(P, E, F, R)).
parts(atomic(E0), first, [E0], [E], atomic(E)).
parts('$atomic'(E0), all, [E0], [E], '$atomic'(E)).
parts('$within'(Note, E0), all, [E0], [E], '$within'(Note, E)).
parts(exogint(E0, P), all, [E0], [E], exogint(E, P)).
parts(time(E0, Seconds), first, [E0], [E], time(E, Seconds)).
parts(ttime(E0, Seconds), all, [E0], [E], ttime(E, Seconds)).

%!  condition_construct(?Condition) is nondet.

condition_construct(and(_, _)).
condition_construct(and(_)).
condition_construct(or(_, _)).
condition_construct(or(_)).
condition_construct(neg(_)).
condition_construct(impl(_, _)).
condition_construct(equiv(_, _)).
condition_construct(some(_, _)).
condition_construct(some(_, _, _)).
condition_construct(all(_, _)).
condition_construct(all(_, _, _)).
condition_construct(true).
condition_construct(false).
condition_construct(done(_)).
condition_construct(haveExecuted(_)).
condition_construct(know(_)).
condition_construct(kwhether(_)).
condition_construct(possibly(_)).
condition_construct((_, _)).
condition_construct((_ ; _)).
condition_construct((_ -> _)).
condition_construct(\+ _).
condition_construct(not(_)).

%!  in_books(?Condition, -Ours) is semidet.
%
%   Ours is how this library writes the Condition of Reiter's book "Knowledge
%   in Action" (2001), unless the domain gives it a meaning.

in_books(&(P, Q), and(P, Q)).
in_books(v(P, Q), or(P, Q)).
in_books(-(P), N) :-
    negated(P, N).
in_books(=>(P, Q), impl(P, Q)).
in_books(<=>(P, Q), equiv(P, Q)).

%!  negated(+Condition, -Negated) is det.
%
%   Negated holds if Condition does not. Its positive parts come first, so
%   they can bind variables. After Lloyd, Topor: Making Prolog more expressive
%   (1984).

negated(P, N) :-
    (   nonvar(P),
        opposite(P, N0)
    ->  N = N0
    ;   N = neg(P)
    ).

opposite(neg(P), P).
opposite(\+ P, P).
opposite(and(P, Q), or(M, N)) :-
    negated(P, M),
    negated(Q, N).
opposite(or(P, Q), and(M, N)) :-
    negated(P, M),
    negated(Q, N).
opposite(impl(P, Q), and(P, N)) :-
    negated(Q, N).
opposite(equiv(P, Q), or(and(P, neg(Q)), and(Q, neg(P)))).
opposite(all(V, P), some(V, N)) :-
    negated(P, N).
opposite(P, N) :-
    in_books(P, Q),
    negated(Q, N).

%   binder(+Term, -Variables, -Outside, -Scope): Term binds Variables, one or
%   a list, in the terms Scope. Outside is a domain, outside of their scope.

binder(pi(V, E), V, [], [E]).
binder(rpi(V, E), V, [], [E]).
binder(some(V, P), V, [], [P]).
binder(all(V, P), V, [], [P]).
binder(pi(V, D, E), V, [D], [E]).
binder(rpi(V, D, E), V, [D], [E]).
binder(for(V, D, E), V, [D], [E]).
binder(some(V, D, P), V, [D], [P]).
binder(all(V, D, P), V, [D], [P]).
binder(interrupt(V, C, E), V, [], [C, E]).

bound_by(Term, Vs, Outside, Scope) :-
    binder(Term, Vs, Outside, Scope),
    is_variables(Vs).

is_variables(Vs) :-
    (   var(Vs)
    ->  true
    ;   Vs = (V, _)
    ->  is_name(V)
    ;   Vs = [_|_]
    ->  all_variables(Vs)
    ;   Vs = r(V)
    ->  is_name(V)
    ;   atom(Vs)
    ).

all_variables(Vs) :-
    (   var(Vs)
    ->  fail
    ;   Vs = [V|Rest]
    ->  \+ is_list(V),
        is_variables(V),
        all_variables(Rest)
    ;   Vs == []
    ).

is_name(V) :-
    ( var(V) ; atom(V) ),
    !.

%   name_in(+Variables, -Name, -Domain): on backtracking each. Domain is `any`
%   or in(D).

names(Vs, Names) :-
    (   var(Vs)
    ->  Names = [Vs-any]
    ;   Vs == []
    ->  Names = []
    ;   Vs = [V|Rest]
    ->  names(V, Names1),
        names(Rest, Names2),
        append(Names1, Names2, Names)
    ;   Vs = (V, D)
    ->  Names = [V-in(D)]
    ;   Vs = r(V)
    ->  Names = [V-any]
    ;   Names = [Vs-any]
    ).

%!  fresh(+Variables, +Term0, -Term, -Choices) is det.
%
%   Term is Term0 with each of Variables replaced by a new Prolog variable.
%   Choices is a list of Value-any or Value-in(Domain), one for each.

fresh(Vs, Term0, Term, Choices) :-
    names(Vs, Names),
    renamed(Term0, Term1),
    fresh_names(Names, Term1, Term, Choices).

fresh_names([], Term, Term, []).
fresh_names([V-D|Names], Term0, Term, [New-D|Choices]) :-
    substituted(V, New, Term0, Term1),
    fresh_names(Names, Term1, Term, Choices).

%!  substituted(+Variable, +Value, +Term0, -Term) is det.
%
%   Term is Term0 with the free occurrences of Variable replaced by Value.

substituted(V, X, T0, T) :-
    (   T0 == V
    ->  T = X
    ;   compound(T0)
    ->  (   bound_by(T0, Vs, _, _),
            names(Vs, Names),
            binds(Names, V)
        ->  outside_substituted(T0, V, X, T)
        ;   mapped(substituted(V, X), T0, T)
        )
    ;   T = T0
    ).

binds([Name-_|Names], V) :-
    (   Name == V
    ->  true
    ;   binds(Names, V)
    ).

%   Term0 binds V itself: only the domains belong to the outer V.

outside_substituted(T0, V, X, T) :-
    T0 =.. [Name, Vs0|Arguments0],
    domains_substituted(Vs0, V, X, Vs),
    (   bound_by(T0, _, [D0], _)
    ->  Arguments0 = [_|Rest],
        substituted(V, X, D0, D),
        T =.. [Name, Vs, D|Rest]
    ;   T =.. [Name, Vs|Arguments0]
    ).

domains_substituted(Vs0, V, X, Vs) :-
    (   nonvar(Vs0),
        Vs0 = (Name, D0)
    ->  substituted(V, X, D0, D),
        Vs = (Name, D)
    ;   nonvar(Vs0),
        Vs0 = [First0|Rest0]
    ->  domains_substituted(First0, V, X, First),
        domains_substituted(Rest0, V, X, Rest),
        Vs = [First|Rest]
    ;   Vs = Vs0
    ).

%!  renamed(+Term0, -Term) is det.
%
%   Term is Term0 with a new Prolog variable for each variable that a
%   construct within binds.

renamed(T0, T) :-
    (   \+ compound(T0)
    ->  T = T0
    ;   bound_by(T0, Vs0, Outside0, Scope0)
    ->  names(Vs0, Names),
        new_names(Names, Vs0-Scope0, Vs-Scope1),
        all_renamed(Scope1, Scope),
        all_renamed(Outside0, Outside),
        functor(T0, Name, _),
        append(Outside, Scope, Arguments),
        T =.. [Name, Vs|Arguments]
    ;   mapped(renamed, T0, T)
    ).

all_renamed([], []).
all_renamed([T0|Ts0], [T|Ts]) :-
    renamed(T0, T),
    all_renamed(Ts0, Ts).

new_names([], Pair, Pair).
new_names([V-_|Names], Vs0-Scope0, Vs-Scope) :-
    replaced_name(Vs0, V, New, Vs1),
    substituted(V, New, Scope0, Scope1),
    new_names(Names, Vs1-Scope1, Vs-Scope).

replaced_name(Vs0, V, New, Vs) :-
    (   Vs0 == V
    ->  Vs = New
    ;   nonvar(Vs0),
        Vs0 = (Name, D)
    ->  (   Name == V
        ->  Vs = (New, D)
        ;   Vs = Vs0
        )
    ;   nonvar(Vs0),
        Vs0 = r(Name),
        Name == V
    ->  Vs = r(New)
    ;   nonvar(Vs0),
        Vs0 = [First0|Rest0]
    ->  replaced_name(First0, V, New, First),
        replaced_name(Rest0, V, New, Rest),
        Vs = [First|Rest]
    ;   Vs = Vs0
    ).

%!  mapped(:Closure, +Term0, -Term) is det.
%
%   Term is the compound Term0 with each argument A0 replaced by the A of
%   call(Closure, A0, A).

:- meta_predicate mapped(2, +, -).

mapped(Closure, T0, T) :-
    compound_name_arity(T0, Name, Arity),
    compound_name_arity(T, Name, Arity),
    arguments_mapped(Arity, Closure, T0, T).

arguments_mapped(0, _, _, _) :-
    !.
arguments_mapped(I, Closure, T0, T) :-
    arg(I, T0, A0),
    call(Closure, A0, A),
    arg(I, T, A),
    I1 is I-1,
    arguments_mapped(I1, Closure, T0, T).

%!  has_binder(+Term) is semidet.
%
%   True if a construct in Term binds a variable.

has_binder(T) :-
    compound(T),
    (   bound_by(T, _, _, _)
    ->  true
    ;   compound_name_arity(T, _, Arity),
        argument_has_binder(Arity, T)
    ).

argument_has_binder(I, T) :-
    I > 0,
    arg(I, T, A),
    (   has_binder(A)
    ->  true
    ;   I1 is I-1,
        argument_has_binder(I1, T)
    ).

%!  closed(+Term) is semidet.
%
%   True if all Prolog variables in Term are bound by a construct in Term.

closed(T) :-
    (   ground(T)
    ->  true
    ;   closed(T, [])
    ).

closed(T, Bound) :-
    (   var(T)
    ->  same_member(T, Bound)
    ;   ground(T)
    ->  true
    ;   bound_by(T, Vs, Outside, Scope)
    ->  names(Vs, Names),
        closed_domains(Names, Bound),
        all_closed(Outside, Bound),
        with_names(Names, Bound, Bound1),
        all_closed(Scope, Bound1)
    ;   compound_name_arity(T, _, Arity),
        arguments_closed(Arity, T, Bound)
    ).

arguments_closed(0, _, _) :-
    !.
arguments_closed(I, T, Bound) :-
    arg(I, T, A),
    closed(A, Bound),
    I1 is I-1,
    arguments_closed(I1, T, Bound).

all_closed([], _).
all_closed([T|Ts], Bound) :-
    closed(T, Bound),
    all_closed(Ts, Bound).

closed_domains([], _).
closed_domains([_-D|Names], Bound) :-
    closed(D, Bound),
    closed_domains(Names, Bound).

with_names([], Bound, Bound).
with_names([V-_|Names], Bound0, Bound) :-
    with_names(Names, [V|Bound0], Bound).

same_member(X, [Y|Ys]) :-
    (   X == Y
    ->  true
    ;   same_member(X, Ys)
    ).
