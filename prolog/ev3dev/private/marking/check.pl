:- module(ev3dev_marking_check,
          [ check_exercise/1            % +Exercise
          ]).
:- use_module(read, [wrong/2]).
:- use_module(library(lists), [list_to_set/2, member/2]).
:- use_module(library(prolog_codewalk), [prolog_walk_code/1]).

/** <module> What is wrong in an exercise, found before any run
*/

:- dynamic missing/2.                   % Called, Clause

%!  check_exercise(+Exercise) is det.
%
%   @error domain_error(exercise, Called) if a clause of it calls a predicate
%   that does not exist, a list of Name/Arity

check_exercise(exercise(Module, _, _, _)) :-
    retractall(missing(_, _)),
    prolog_walk_code([ module(Module), undefined(trace), source(false),
                       on_trace(ev3dev_marking_check:note_missing) ]),
    findall(Line-(Name/Arity),
            ( retract(missing(Name/Arity, Clause)),
              ( clause_property(Clause, line_count(Line)) -> true
              ; Line = 0 ) ),
            Found0),
    sort(Found0, Found),
    (   Found == []
    ->  true
    ;   findall(Text,
                ( member(Line-Called, Found),
                  said(Module, Line, Called, Text) ),
                Texts),
        atomic_list_concat(Texts, '; ', Message),
        findall(Called, member(_-Called, Found), All0),
        list_to_set(All0, All),
        wrong(All, Message)
    ).

%!  note_missing(+Callee, +Caller, +Location) is det.
%
%   For prolog_walk_code/1.

note_missing(_:Goal, _, Location) :-
    functor(Goal, Name, Arity),
    ( Location = clause(Clause) -> true
    ; Location = clause_term_position(Clause, _) ),
    !,
    assertz(missing(Name/Arity, Clause)).
note_missing(_, _, _).

said(Module, Line, Name/Arity, Text) :-
    functor(Goal, Name, Arity),
    (   dwim_predicate(Module:Goal, Meant0),
        strip_module(Meant0, _, Meant),
        functor(Meant, Other, OtherArity),
        Other \== Name
    ->  format(atom(Text),
               'line ~d: there is no ~w/~w (did you mean ~w/~w?)',
               [Line, Name, Arity, Other, OtherArity])
    ;   format(atom(Text), 'line ~d: there is no ~w/~w',
               [Line, Name, Arity])
    ).
