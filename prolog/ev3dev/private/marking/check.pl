:- module(ev3dev_marking_check,
          [ check_exercise/1,           % +Exercise
            unused/3                    % +Exercise, -Names, -Text
          ]).
:- use_module('../errors/error_texts', [nearly/3]).
:- use_module(read, [exercise_fact/2, wrong/2]).
:- use_module(library(lists), [list_to_set/2, member/2]).
:- use_module(library(prolog_codewalk), [prolog_walk_code/1]).

/** <module> What is wrong in an exercise, found before any run
*/

:- dynamic missing/2.                   % Called, Clause
:- dynamic called/1.

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

%!  unused(+Exercise, -Names, -Text) is semidet.
%
%   Text names the predicates of an exercise that nothing calls and whose
%   names are nearly those of its facts; Names are these. Fails if there are
%   none.

unused(exercise(Module, _, _, _), Names, Text) :-
    retractall(called(_)),
    prolog_walk_code([ module(Module), undefined(ignore), source(false),
                       trace_reference(_),
                       on_trace(ev3dev_marking_check:note_called) ]),
    findall(Line-(Name/Arity-Meant),
            ( own(Module, Name/Arity, Line),
              \+ exercise_fact(Name, Arity),
              \+ called(Name/Arity),
              findall(Known, exercise_fact(Known, _), Facts0),
              sort(Facts0, Facts),
              nearly(Name, Facts, Meant) ),
            Found0),
    retractall(called(_)),
    sort(Found0, Found),
    findall(Name, member(_-(Name-_), Found), Names),
    Names = [_|_],
    findall(Each,
            ( member(Line-(Name-Meant), Found),
              once(exercise_fact(Meant, Arity)),
              format(atom(Each),
                     'line ~d: nothing uses ~w (did you mean ~w/~w?)',
                     [Line, Name, Meant, Arity]) ),
            Texts),
    atomic_list_concat(Texts, '; ', Text).

own(Module, Name/Arity, Line) :-
    current_predicate(Module:Name/Arity),
    functor(Head, Name, Arity),
    \+ predicate_property(Module:Head, imported_from(_)),
    once(( nth_clause(Module:Head, 1, Clause),
           clause_property(Clause, line_count(Line)) )).

%!  note_called(+Callee, +Caller, +Location) is det.
%
%   For prolog_walk_code/1.

note_called(_:Goal, _, _) :-
    functor(Goal, Name, Arity),
    (   called(Name/Arity)
    ->  true
    ;   assertz(called(Name/Arity))
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
