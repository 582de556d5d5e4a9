:- module(ev3dev_golog_visited_states,
          [ state_key/4,                % +Program, +Situation, +Context, -Key
            tried/5,                    % :Goal, +Key, +Left, +Cut, +Context
            states_forgotten/1          % +Effort
          ]).
:- use_module('../basics/fields', [goal_expansion/2, term_expansion/2]).
:- use_module(context, [context_effort/2]).
:- use_module(situation, [situation_state/2]).
:- use_module(effort, [asked_history/1, effort_id/2, in_trial/1]).

/** <module> States that a search knows

A search need not go on from a program and a state from which it has found no
end, or is looking for one. That pays only in a long search, and is not sound
where a condition asks what was done before, or where the simulator tries the
actions.

Source: Reinefeld, Marsland: Enhanced iterative-deepening search (1994), for
how deep the search was there.
*/

:- meta_predicate tried(0, +, +, +, +).

:- thread_local known/3.                % Key, Effort's number, Steps

%   Of a search, before it looks for these states; kept at once.

short(500).
most(100000).

%!  state_key(+Program, +Situation, +Context, -Key) is semidet.
%
%   Key stands for what Program may still do in Situation. Fails if that is
%   not to be looked for.

state_key(E, S, X, Key) :-
    context_effort(X, Effort),
    Effort = effort(steps: Steps),
    short(Short),
    Steps > Short,
    \+ asked_history(Effort),
    \+ in_trial(Effort),
    situation_state(S, State),
    \+ attributed(E-State),
    variant_sha1(E-State, Key).

attributed(Term) :-
    term_attvars(Term, [_|_]).

%!  tried(:Goal, +Key, +Left, +Cut, +Context) is nondet.
%
%   As Goal, which searches on from Key for at most Left steps, or `inf`. It
%   fails at once where that has found nothing before, and where it is under
%   way: what is found by going in a circle is found without. Cut is
%   cut(Truth, ...): whether something may have been found with more steps; or
%   `none`.

tried(Goal, Key, Left, Cut, X) :-
    context_effort(X, Effort),
    effort_id(Effort, Id),
    \+ is_known(Key, Id, Left, Cut),
    most(Most),
    predicate_property(known(_, _, _), number_of_clauses(Count)),
    (   Count >= Most
    ->  call(Goal)
    ;   tried_here(Goal, Key, Id, Left, Cut, Effort)
    ).

tried_here(Goal, Key, Id, Left, Cut, Effort) :-
    assertz(known(Key, Id, under_way), Reference),
    (   Cut == none
    ->  Before = none
    ;   arg(1, Cut, Before),
        nb_setarg(1, Cut, false)
    ),
    (   call(Goal)
    ;   (   erased(Reference),
            \+ asked_history(Effort)
        ->  complete(Cut, Before, Left, Steps),
            assertz(known(Key, Id, Steps))
        ;   true
        ),
        fail
    ).

%   It is not there any more if something has been found meanwhile.

erased(Reference) :-
    catch(erase(Reference), error(existence_error(_, _), _), fail).

is_known(Key, Id, Left, Cut) :-
    known(Key, Id, Steps),
    (   memberchk(Steps, [inf, under_way])
    ->  true
    ;   Left =< Steps,
        nb_setarg(1, Cut, true)
    ),
    !.

complete(Cut, Before, Left, Steps) :-
    (   Cut == none
    ->  Steps = inf
    ;   arg(1, Cut, true)
    ->  Steps = Left
    ;   Steps = inf,
        nb_setarg(1, Cut, Before)
    ).

%!  states_forgotten(+Effort) is det.
%
%   Something is found, or the search is over. If it goes on, that is for all
%   other ways.

states_forgotten(Effort) :-
    effort_id(Effort, Id),
    set_field(Effort, effort(asked: true)),
    retractall(known(_, Id, _)).
