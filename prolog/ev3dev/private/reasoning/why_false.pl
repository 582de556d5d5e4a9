:- module(ev3dev_why_false,
          [ why_false/2,                % +Episodes, -Sentences
            goal_words/2,               % +Term, -Text
            clause_words/2              % +Clause, -Text
          ]).
:- set_prolog_flag(generate_debug_info, false).
:- use_module(library(lists), [append/3, last/2, member/2, reverse/2]).
:- use_module('../basics/fields',
              [fields/1, goal_expansion/2, term_expansion/2]).
:- use_module('../errors/error_texts', [shown/2]).
:- use_module(instrument, [clause_of/2, named_body/3]).
:- use_module(outline, [failed_last/2, groups/2, is_test/1]).
:- use_module(recorder, [moment/4]).

/** <module> Why a goal is false

The branch that got furthest says it best: the one with the most goals done in
the outermost clause, then in the clause of the goal that failed there, and so
on; of several the last one. The failure that is deepest in the calls is often
the first test of something that was tried in vain.
*/

%!  why_false(+Episodes, -Sentences) is semidet.
%
%   Sentences are texts. Fails if the outermost goal has not failed.

why_false(Episodes, [Text|More]) :-
    failed_last(Episodes, _),
    findall(Key-Point, point(Episodes, none, Key, Point), Points),
    furthest(Points, point(Failed, Clause, Path)),
    failure_words(Failed, False),
    where(Clause, Where),
    (   way(Path, Way)
    ->  goal_words(Way, WayWords),
        format(string(Text), 'Why false? ~w went furthest: there ~w~w.',
               [WayWords, False, Where])
    ;   format(string(Text), 'Why false? ~w~w.', [False, Where])
    ),
    findall(Advice, advice(Failed, Clause, Path, Advice), More).

%   point(+Items, +Clause, -Key, -Point): a goal that failed, after the goals
%   in Path had succeeded, the latest first. Key is the list of places in the
%   clauses from the outermost one.

point(Items, Clause, Key, Point) :-
    point(Items, Clause, [], Key, Point).

point([Item|Items], Clause, Path0, Key, Point) :-
    (   Item = episode(node: Node, start: Start, outcome: Outcome)
    ->  (   Start == redo,
            append(_, [episode(node: Node)|Path1], Path0)
        ->  Path = Path1
        ;   Path = Path0
        ),
        (   Outcome == fail,
            length(Path, Place),
            inner_point(Item, Clause, Path, Key0, Point),
            Key = [Place|Key0]
        ;   memberchk(Outcome, [exit, more]),
            point(Items, Clause, [Item|Path], Key, Point)
        ;   Outcome == fail,
            point(Items, Clause, Path, Key, Point)
        )
    ;   point(Items, Clause, Path0, Key, Point)
    ).

inner_point(Item, Clause, Path, Key, Point) :-
    Item = episode(goal: Goal, items: Items, start: Start),
    groups(Items, Groups),
    findall(Key1-Point1,
            ( \+ Goal = (\+ _),
              member(group(Clause0, Inner), Groups),
              (   Clause0 == none
              ->  Clause1 = Clause
              ;   Clause1 = Clause0
              ),
              point(Inner, Clause1, Key1, Point1) ),
            Points),
    (   Points = [_|_]
    ->  furthest(Points, Key, Point0),
        Point0 = point(Failed, In, Path0),
        (   way(Path0, _)
        ->  Path1 = Path0
        ;   append(Path0, Path, Path1)
        ),
        Point = point(Failed, In, Path1)
    ;   Start == call,
        Key = [],
        Point = point(Item, Clause, Path)
    ).

furthest(Points, Point) :-
    furthest(Points, _, Point).

furthest([Key0-Point0|Points], Key, Point) :-
    furthest(Points, Key0, Point0, Key, Point).

furthest([], Key, Point, Key, Point).
furthest([Key1-Point1|Points], Key0, Point0, Key, Point) :-
    (   Key1 @>= Key0
    ->  furthest(Points, Key1, Point1, Key, Point)
    ;   furthest(Points, Key0, Point0, Key, Point)
    ).

%   The last answer on the way of a goal that had several.

way(Path, Goal) :-
    member(Episode, Path),
    Episode = episode(number: Number, outcome: Outcome, answer: Goal),
    (   Outcome == more
    ->  true
    ;   Number > 1
    ),
    !.

failure_words(Failed, Text) :-
    Failed = episode(goal: Goal),
    goal_words(Goal, Words),
    (   is_test(Goal)
    ->  format(string(Text), '~w is false', [Words])
    ;   functor(Goal, Name, Arity),
        clause_of(_, place(_:Name/Arity, _, _Of, _, _))
    ->  format(string(Text), 'no clause of ~w matches', [Words])
    ;   format(string(Text), '~w fails', [Words])
    ).

where(Clause, Text) :-
    (   clause_of(Clause, Of),
        Of = place(_:Predicate, _, _, File, Line)
    ->  place_words(File, Line, Place),
        format(string(Text), ' (~q, ~w)', [Predicate, Place])
    ;   Text = ""
    ).

%   The name of the file only if the program has several.

place_words(File, Line, Place) :-
    (   clause_of(_, place(_, _, _Of, Other, _)),
        Other \== File
    ->  file_base_name(File, Name),
        format(string(Place), '~w:~d', [Name, Line])
    ;   format(string(Place), 'line ~d', [Line])
    ).

%   advice(+Failed, +Clause, +Path, -Sentence): what would have made a
%   comparison true, and where its value is from.

advice(Failed, Clause, Path, Sentence) :-
    Failed = episode(goal: Test),
    as_in_clause(Test, Clause, Written, Names),
    Test =.. [Operator, A, B],
    Written =.. [_, A0, B0],
    (   compared(Operator, Words),
        name_of(A0, Names, Name)
    ->  Value = A,
        Other = B,
        Variable = A0
    ;   turned(Operator, Operator1),
        compared(Operator1, Words),
        name_of(B0, Names, Name)
    ->  Value = B,
        Other = A,
        Variable = B0
    ),
    goal_words(Other, OtherWords),
    (   value_of(Path, Value, Variable, Names, From)
    ->  true
    ;   goal_words(Value, ValueWords),
        format(string(From), '~w is ~w', [Name, ValueWords])
    ),
    format(string(Sentence), 'It would be true with ~w ~w ~w; ~w.',
           [Name, Words, OtherWords, From]).

compared(<, below).
compared(>, above).
compared(=<, 'of at most').
compared(>=, 'of at least').
compared(=:=, 'equal to').

turned(<, >).
turned(>, <).
turned(=<, >=).
turned(>=, =<).
turned(=:=, =:=).

as_in_clause(Test, Clause, Written, Names) :-
    named_body(Clause, Body, Names),
    part(Body, Written),
    nonvar(Written),
    \+ Written \= Test,
    !.

part(Body, Goal) :-
    nonvar(Body),
    Body =.. [Name, A, B],
    memberchk(Name, [',', ;, ->, *->]),
    !,
    ( part(A, Goal) ; part(B, Goal) ).
part(Goal, Goal).

name_of(Variable, Names, Name) :-
    var(Variable),
    member(Name=Variable1, Names),
    Variable1 == Variable,
    !.

value_of(Path, Value, Variable, Names, Text) :-
    name_of(Variable, Names, Name),
    member(Episode, Path),
    Episode = episode(goal: Goal, answer: Answer, to: To),
    Goal =.. [Predicate|Arguments],
    Answer =.. [_|Values],
    appended(Arguments, Values, Value, Name, Written),
    !,
    Shown =.. [Predicate|Written],
    goal_words(Shown, Words),
    goal_words(Value, ValueWords),
    (   moment(To, Time, _, _)
    ->  format(string(When), ' at ~2f s', [Time])
    ;   When = ""
    ),
    format(string(Text), '~w gave ~w~w', [Words, ValueWords, When]).

%   The arguments of an answer, with the name of the variable in the place of
%   the Value that it got.

appended([Argument|Arguments], [Value|Values], Value0, Name,
         ['$VAR'(Name)|Values]) :-
    var(Argument),
    Value == Value0,
    !,
    Arguments = _.
appended([_|Arguments], [Value|Values], Value0, Name, [Value|Written]) :-
    appended(Arguments, Values, Value0, Name, Written).

% ---------------- TERMS

%!  clause_words(+Clause, -Text) is semidet.
%
%   Text says where the clause with the key Clause is.

clause_words(Clause, Text) :-
    clause_of(Clause, place(_, Nth, Of, File, Line)),
    place_words(File, Line, Place),
    (   Of > 1
    ->  format(string(Text), '~w, clause ~d of ~d', [Place, Nth, Of])
    ;   Text = Place
    ).

%!  goal_words(+Term, -Text) is det.
%
%   Text is a Term as a program has it; numbers are rounded to three decimals.

goal_words(Term0, Text) :-
    rounded(Term0, Term),
    (   is_test(Term),
        Term =.. [Operator, A, B]
    ->  shown(A, Left),
        shown(B, Right),
        format(string(Text), '~w ~w ~w', [Left, Operator, Right])
    ;   shown(Term, Text)
    ).

rounded(Term0, Term) :-
    (   float(Term0),
        abs(Term0) < 1.0e12
    ->  Term is round(Term0*1000)/1000.0
    ;   compound(Term0)
    ->  compound_name_arguments(Term0, Name, Arguments0),
        all_rounded(Arguments0, Arguments),
        compound_name_arguments(Term, Name, Arguments)
    ;   Term = Term0
    ).

all_rounded([], []).
all_rounded([Term0|Terms0], [Term|Terms]) :-
    rounded(Term0, Term),
    all_rounded(Terms0, Terms).
