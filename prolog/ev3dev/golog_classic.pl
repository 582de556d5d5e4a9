:- module(ev3dev_golog_classic,
          [ situation_history/2,        % ?Situation, ?History
            op(800, xfy, &),
            op(850, xfy, v),
            op(870, xfy, =>),
            op(880, xfy, <=>),
            op(900, fy, not),
            op(960, xfy, #)
          ]).
:- set_prolog_flag(generate_debug_info, false).
:- use_module(private/load/compiled, []).
:- use_module(private/errors/public_clauses, [term_expansion/4]).
:- reexport(golog).

/** <module> Golog with situations, as in the first papers

Programs in the syntax of Levesque, Reiter, Lesperance, Lin, Scherl: GOLOG: A
Logic Programming Language for Dynamic Domains (1997), and of Reiter's book
"Knowledge in Action" (2001), run as they are. An import of this library
replaces the line that loads an interpreter:

```
:- use_module(library(ev3dev/golog_classic)).

primitive_action(up(_)).
poss(up(N), S) :- floor(M, S), M < N.
floor(N, do(A, S)) :- A = up(N) ; \+ A = up(_), floor(N, S).
floor(1, s0).
restoreSitArg(floor(N), S, floor(N, S)).
proc(go(N), ?(floor(N)) # up(N)).
```

```
?- do(go(2) : go(3), s0, S).
S = do(up(3), do(up(2), s0)).
?- golog(go(3), []).
```

A condition has `&`, `v`, `-`, `=>`, `<=>`, `some(v, P)` and `all(v, P)`.
restoreSitArg/3 says which of its atoms have a situation as their last
argument; the others are goals of Prolog. A domain may also have its own
holds(Fluent, S).

The predicates are those of library(ev3dev/golog). do/3, trans/4, final/2,
holds/2 and has_val/3 take a situation in the place of a history. golog/2
executes a program on the robot, by robot_action/2.
*/

%!  situation_history(?Situation, ?History) is nondet.
%
%   True if the actions of History, a list, newest first, lead from `s0` to
%   Situation.

situation_history(s0, []).
situation_history(do(Action, Situation), [Action|History]) :-
    situation_history(Situation, History).
