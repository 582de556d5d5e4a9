:- module(ev3dev_golog_situation,
          [ initial_situation/1,        % -Situation
            situation_history/2,        % +Situation, -History
            situation_count/2,          % +Situation, -Count
            situation_state/2,          % +Situation, -State
            history_shortened/3,        % +Length, +Situation0, -Situation
            marked/3,                   % +Entry, +Situation0, -Situation
            was_done/2,                 % ?Action, +Situation
            all_open/3,                 % +Fluents, +Situation0, -Situation
            assumed/3,                  % +Case, +Situation0, -Situation
            set_by/3,                   % +Fluent, +Situation, -Count
            is_assumed/3                % +Condition, +Situation, -Truth
          ]).
:- use_module('../basics/fields',
              [fields/1, goal_expansion/2, term_expansion/2]).
:- use_module('../basics/small_lists', [first_of/3]).
:- use_module(library(assoc),
              [ assoc_to_keys/2, assoc_to_list/2, empty_assoc/1, get_assoc/3,
                put_assoc/4
              ]).
:- use_module(library(lists), [member/2]).

:- fields(situation(history, count, values, open, done)).

/** <module> Situations

A situation is what a history makes of the initial one:

    situation(History, Count, Values, Open, Done)

History is a list, newest first, of actions and sensing results, perhaps only
the newest of them; Count counts all. Values is an AVL tree with the value of
each ground fluent that an entry has set. So the database is progressed with
each action, a look-up does not depend on the length of the history, and
backtracking to an earlier situation costs nothing. Open has the effects that
are still to be decided, see progression.pl. Done is the set of all entries.

Sources: Levesque, Reiter, Lesperance, Lin, Scherl: GOLOG (1997); De Giacomo,
Lesperance, Levesque: ConGolog (2000), De Giacomo, Levesque: An incremental
interpreter for high-level programs with sensing (1999).
*/

%!  initial_situation(-Situation) is det.
%
%   Situation is the one in which nothing has happened.

initial_situation(situation([], 0, Empty, [], Empty)) :-
    empty_assoc(Empty).

%!  situation_history(+Situation, -History) is det.
%!  situation_count(+Situation, -Count) is det.
%
%   History has the entries of Situation, or the newest of them; Count is how
%   many there are in all.

situation_history(Situation, History) :-
    Situation = situation(history: History).

situation_count(Situation, Count) :-
    Situation = situation(count: Count).

%!  situation_state(+Situation, -State) is semidet.
%
%   Situations of the same State, a list of Fluent-Value, have the same
%   future, but for conditions that ask what was done. Fails if there are
%   effects that are still to be decided.

situation_state(Situation, State) :-
    Situation = situation(values: Values, open: []),
    assoc_to_list(Values, Pairs),
    untimed(Pairs, State).

untimed([], []).
untimed([F-v(_, V)|Pairs], [F-V|State]) :-
    untimed(Pairs, State).

%!  history_shortened(+Length, +Situation0, -Situation) is det.
%
%   Situation has only the newest Length entries of the history in its list.

history_shortened(Length, situation(H0, C, V, O, D),
                  situation(H, C, V, O, D)) :-
    first_of(Length, H0, H).

%!  marked(+Entry, +Situation0, -Situation) is det.
%
%   Situation has Entry in its history; no fluent changes.

marked(Entry, situation(H, C0, V, O, D), situation([Entry|H], C, V, O, D)) :-
    C is C0+1.

%!  was_done(?Entry, +Situation) is nondet.

was_done(Entry, Situation) :-
    Situation = situation(done: Done),
    (   ground(Entry)
    ->  get_assoc(Entry, Done, _)
    ;   assoc_to_keys(Done, Entries),
        member(Entry, Entries)
    ).

%!  all_open(+Fluents, +Situation0, -Situation) is det.
%
%   The values of Fluents are still to be sensed.

all_open(Fs, situation(H, C, Values0, Open, Done),
         situation(H, C, Values, Open, Done)) :-
    open_values(Fs, v(C, '$sensed'), Values0, Values).

open_values([], _, Values, Values).
open_values([F|Fs], Value, Values0, Values) :-
    put_assoc(F, Values0, Value, Values1),
    open_values(Fs, Value, Values1, Values).

%!  assumed(+Case, +Situation0, -Situation) is det.
%
%   Case is is(Fluent, Value), or holds(Condition, Truth).

assumed(Case, situation(H, C, Values0, Open, Done),
        situation(H, C, Values, Open, Done)) :-
    (   Case = is(F, V)
    ->  put_assoc(F, Values0, v(C, V), Values)
    ;   Case = holds(P, Truth),
        put_assoc('$assumed'(P), Values0, v(C, Truth), Values)
    ).

%!  set_by(+Fluent, +Situation, -Count) is semidet.
%
%   The Entry with the number Count of the history was the last to set Fluent.

set_by(F, Situation, C) :-
    Situation = situation(values: Values),
    get_assoc(F, Values, v(C, _)).

%!  is_assumed(+Condition, +Situation, -Truth) is semidet.
%
%   The Truth of Condition has been assumed since the last of its open fluents
%   was sensed.

is_assumed(P, Situation, Truth) :-
    Situation = situation(values: Values),
    ground(P),
    get_assoc('$assumed'(P), Values, v(C, Truth)),
    \+ ( open_since(P, Values, C1),
         C1 > C ).

open_since(P, Values, C) :-
    callable(P),
    (   get_assoc(P, Values, v(C, '$sensed'))
    ;   compound(P),
        arg(_, P, Q),
        open_since(Q, Values, C)
    ).
