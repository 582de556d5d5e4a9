:- module(ev3dev_outline,
          [ episodes/1,                 % -Episodes
            outline/2,                  % +Items, -Rows
            groups/2,                   % +Items, -Groups
            failed_last/2,              % +Items, -Episode
            is_test/1                   % +Goal
          ]).
:- set_prolog_flag(generate_debug_info, false).
:- use_module(library(assoc), [empty_assoc/1, get_assoc/3, put_assoc/4]).
:- use_module(library(lists),
              [append/3, last/2, member/2, reverse/2]).
:- use_module('../basics/fields',
              [fields/1, goal_expansion/2, term_expansion/2]).
:- use_module(events, [events/1]).
:- use_module(recorder, [event/5, moment/4]).

/** <module> What was recorded as an outline

A tree of calls does not show backtracking. So here the goals after a choice
point are below the answer that they depend on: each answer of a goal that is
tried again has a numbered row, with what its proof did and with the goals of
the same clause that followed.

An episode is what happens between a call of a node, or a new attempt, and its
next exit, failure or exception. Its items are the episodes inside it, and
terms mark(Port, Data, Moment).
*/

:- fields(episode(node, start, goal, number, outcome, answer, items, from,
                  to)).
:- fields(row(what, goal, state, clause, note, from, to, below)).

%!  episodes(-Episodes) is det.
%
%   Episodes are the outermost ones. The outcome is `exit`, `more` (it can be
%   tried again), `fail`, exception(Ball) or `running`. Number counts the
%   answers of a node.

episodes(Episodes) :-
    events(Events),
    empty_assoc(Numbers),
    items(Events, [], Episodes, _, Numbers, _).

%   items(+Events, +Before, -Items, -Rest, +Numbers0, -Numbers): Before are
%   the items before, the latest first.

items([], _, [], [], Numbers, Numbers).
items([Event|Events], Before, Items, Rest, Numbers0, Numbers) :-
    Event = e(Port, Node, Data, From),
    (   memberchk(Port, [exit, more, fail, exception])
    ->  Items = [],
        Rest = [Event|Events],
        Numbers = Numbers0
    ;   memberchk(Port, [call, redo])
    ->  Items = [Episode|Items1],
        goal_of(Port, Node, Data, Goal),
        Episode = episode(node: Node, start: Port, goal: Goal,
                          number: Number, outcome: Outcome, answer: Answer,
                          items: Inner, from: From, to: To),
        items(Events, [], Inner, Events1, Numbers0, Numbers1),
        ends(Events1, Node, Goal, Outcome, Answer, To, Events2),
        counted(Outcome, Node, Number, Numbers1, Numbers2),
        items(Events2, [Episode|Before], Items1, Rest, Numbers2, Numbers)
    ;   (   Port == cut
        ->  findall(Goal, dropped(Before, Data, Goal), Data1)
        ;   Data1 = Data
        ),
        Items = [mark(Port, Data1, From)|Items1],
        items(Events, Before, Items1, Rest, Numbers0, Numbers)
    ).

%   What a cut drops since an event: no more answers of Goal.

dropped(Items, Since, Goal) :-
    member(episode(node: Node, goal: Goal, outcome: more), Items),
    Node >= Since.

goal_of(call, _, _-Goal, Goal) :- !.
goal_of(redo, Node, _, Goal) :-
    (   event(Node, call, _, Goal, _)
    ->  true
    ;   Goal = ...                      % forgotten
    ).

ends([e(Port, Node, Data, To)|Events], Node, Goal, Outcome, Answer, To,
     Events) :-
    !,
    (   memberchk(Port, [exit, more])
    ->  Outcome = Port,
        Answer = Data
    ;   Port == exception
    ->  Outcome = exception(Data),
        Answer = Goal
    ;   Outcome = fail,
        Answer = Goal
    ).
ends(Events, _, Goal, running, Goal, To, Events) :-
    (   predicate_property(ev3dev_recorder:moment(_, _, _Pose, _),
                           number_of_clauses(To))
    ->  true
    ;   To = 0
    ).

counted(Outcome, Node, Number, Numbers0, Numbers) :-
    (   memberchk(Outcome, [exit, more])
    ->  (   get_assoc(Node, Numbers0, Number0)
        ->  Number is Number0+1
        ;   Number = 1
        ),
        put_assoc(Node, Numbers0, Number, Numbers)
    ;   Number = 0,
        Numbers = Numbers0
    ).

% ---------------- ROWS

%!  outline(+Items, -Rows) is det.
%
%   Rows are those of the Items. Of rounds of up to 8 rows that do the same
%   the first and the last are there, and same(Count, Rows) between them, with
%   the others below it.

outline(Items, Rows) :-
    rows(Items, Rows0),
    folded(Rows0, Rows).

rows([], []).
rows([Item|Items], Rows) :-
    (   Item = episode(node: Node, start: Start),
        (   Start == redo
        ;   tried_again(Items, Node)
        )
    ->  ways([Item|Items], Node, Ways, Rest),
        (   Start == redo
        ->  append(Ways, Rows1, Rows)
        ;   ways_row(Item, Ways, Row),
            Rows = [Row|Rows1]
        ),
        rows(Rest, Rows1)
    ;   Item = episode(node: _)
    ->  goal_rows(Item, Items, GoalRows),
        rows(Items, Rows1),
        (   Rows1 == []
        ->  Rows = GoalRows
        ;   append(GoalRows, Rows1, Rows)
        )
    ;   mark_row(Item, Row)
    ->  Rows = [Row|Rows1],
        rows(Items, Rows1)
    ;   rows(Items, Rows)
    ).

tried_again(Items, Node) :-
    Again = episode(node: Node, start: redo),
    memberchk(Again, Items).

%   The answers of Node, each with what follows it. After the last attempt,
%   which has failed, the clause goes on only if it is another clause.

ways([Item|Items], Node, Ways, Rest) :-
    (   Item = episode(node: Node, goal: Goal, number: Number,
                       outcome: Outcome, answer: Answer, items: Inner,
                       from: From, to: To)
    ->  (   memberchk(Outcome, [exit, more])
        ->  until_again(Items, Node, After, Rest0),
            proof(Inner, Clause, Proof),
            outline(After, Followed),
            append(Proof, Followed, Below),
            last_moment(After, To, End),
            (   Rest0 == [],
                \+ failed_last(After, _)
            ->  State = true,
                Note = none
            ;   State = false,
                given_up(After, Note)
            ),
            Way = row(what: way(Number), goal: Answer, state: State,
                      clause: Clause, note: Note, from: From, to: End,
                      below: Below),
            Ways = [Way|Ways1],
            (   Rest0 == []
            ->  Ways1 = [],
                Rest = []
            ;   ways(Rest0, Node, Ways1, Rest)
            )
        ;   Inner == []
        ->  Ways = [],
            Rest = Items
        ;   state_of(Outcome, State),
            proof(Inner, Clause, Below),
            Ways = [row(what: no_more, goal: Goal, state: State,
                        clause: Clause, note: none, from: From, to: To,
                        below: Below)],
            Rest = Items
        )
    ).

until_again([], _, [], []).
until_again([Item|Items], Node, After, Rest) :-
    (   Item = episode(node: Node)
    ->  After = [],
        Rest = [Item|Items]
    ;   After = [Item|After1],
        until_again(Items, Node, After1, Rest)
    ).

last_moment(Items, To0, To) :-
    (   last(Items, episode(to: To1))
    ->  To = To1
    ;   To = To0
    ).

given_up(Items, Note) :-
    (   failed_last(Items, Failed)
    ->  Failed = episode(goal: Goal),
        Note = given_up(Goal)
    ;   Note = none
    ).

%!  failed_last(+Items, -Episode) is semidet.
%
%   If the last one of Items has failed, Episode is the innermost goal that
%   failed at its call, and not only when it was tried again.

failed_last(Items, Failed) :-
    reverse(Items, Latest),
    Last = episode(node: _),
    memberchk(Last, Latest),
    Last = episode(outcome: fail),
    (   Called = episode(start: call, outcome: fail),
        memberchk(Called, Latest)
    ->  Episode = Called
    ;   Episode = Last
    ),
    Episode = episode(items: Inner),
    (   failed_last(Inner, Failed0)
    ->  Failed = Failed0
    ;   Failed = Episode
    ).

ways_row(Item, Ways, Row) :-
    Item = episode(goal: Goal, from: From),
    last(Ways, row(state: State, to: To)),
    findall(_, member(row(what: way(_)), Ways), Counted),
    length(Counted, Count),
    folded(Ways, Below),
    Row = row(what: ways(Count), goal: Goal, state: State, clause: none,
              note: none, from: From, to: To, below: Below).

%   What proved an answer: nothing for a fact.

proof(Items, Clause, Rows) :-
    groups(Items, Groups),
    (   Groups = [group(Clause, Inner)]
    ->  outline(Inner, Rows)
    ;   last(Groups, group(Clause, _)),
        clause_rows(Groups, Rows)
    ).

%!  groups(+Items, -Groups) is det.
%
%   Groups are terms group(Clause, Items): the clauses that were tried, in
%   order. What belongs to no clause, or to one of an earlier episode, has
%   `none`.

groups(Items, Groups) :-
    (   Items = [mark(unify, Clause, _)|Items1]
    ->  true
    ;   Clause = none,
        Items1 = Items
    ),
    until_unify(Items1, Inner, Rest),
    (   Rest == []
    ->  Groups = [group(Clause, Inner)]
    ;   Clause == none,
        Inner == []
    ->  groups(Rest, Groups)
    ;   Groups = [group(Clause, Inner)|Groups1],
        groups(Rest, Groups1)
    ).

until_unify([], [], []).
until_unify([Item|Items], Inner, Rest) :-
    (   Item = mark(unify, _, _)
    ->  Inner = [],
        Rest = [Item|Items]
    ;   Inner = [Item|Inner1],
        until_unify(Items, Inner1, Rest)
    ).

%   One clause after the other: each has a row, unless it is a fact.

clause_rows([], []).
clause_rows([group(Clause, Items)|Groups], Rows) :-
    (   Items == []
    ->  Rows = Rows1
    ;   outline(Items, Below),
        Below = [row(from: From)|_],
        last(Below, row(to: To)),
        (   failed_last(Items, _)
        ->  State = false
        ;   State = true
        ),
        Rows = [row(what: clause, goal: none, state: State, clause: Clause,
                    note: none, from: From, to: To, below: Below)|Rows1]
    ),
    clause_rows(Groups, Rows1).

%   A goal, and after it, at the same depth, the rounds of a loop: the last
%   goal of its clause calls the same predicate.

goal_rows(Item, After, [Row|Rounds]) :-
    Item = episode(goal: Goal, outcome: Outcome, answer: Answer,
                   items: Items, from: From, to: To),
    state_of(Outcome, State0),
    (   State0 == true,
        Outcome == more,
        After == []
    ->  State = open
    ;   State = State0
    ),
    groups(Items, Groups),
    (   Groups = [group(Clause, Inner)]
    ->  (   calls_itself(Inner, Goal, Before, Again)
        ->  goal_rows(Again, [], Rounds),
            outline(Before, Below)
        ;   Rounds = [],
            outline(Inner, Below)
        )
    ;   Rounds = [],
        last(Groups, group(Clause, _)),
        clause_rows(Groups, Below)
    ),
    (   Below == []
    ->  effect(From, To, Note)
    ;   Goal = ev3dev_guard(_, _),
        failed_last(Inner, Failed)
    ->  Failed = episode(goal: Test),
        Note = false(Test)
    ;   Note = none
    ),
    Row = row(what: goal, goal: Answer, state: State, clause: Clause,
              note: Note, from: From, to: To, below: Below).

calls_itself(Items, Goal, Before, Again) :-
    append(Before, [Again], Items),
    !,
    Again = episode(goal: Goal1),
    functor(Goal, Name, Arity),
    functor(Goal1, Name, Arity),
    \+ is_test(Goal),
    Redo = episode(start: redo),
    \+ memberchk(Redo, Before).

state_of(exit, true).
state_of(more, true).
state_of(fail, false).
state_of(running, running).
state_of(exception(Left), State) :-
    (   Left = ball(Ball),
        Ball \== '$aborted',
        Ball \= unwind(_)
    ->  State = error(Ball)
    ;   State = left
    ).

%   A robot has moved, or a motor has got a command: Prolog takes bindings
%   back, but not that.

effect(From, To, Effect) :-
    (   moment(To, Time1, Pose1, Commands1)
    ->  (   moment(From, Time0, Pose0, Commands0)
        ->  true
        ;   Time0 = 0.0,
            Pose0 = none,
            Commands0 = 0
        ),
        Seconds is Time1-Time0,
        (   Seconds > 0.05,             % longer than a sensor takes
            Pose0 = pose(X0, Y0, H0),
            Pose1 = pose(X1, Y1, H1),
            abs(X1-X0)+abs(Y1-Y0)+abs(H1-H0) > 0.05
        ->  Effect = moved(Seconds)
        ;   Commands1 > Commands0
        ->  Effect = commanded
        ;   Effect = none
        )
    ;   Effect = none
    ).

mark_row(mark(cut, Dropped, At), Row) :-
    Row = row(what: cut, goal: Dropped, state: true, clause: none, note: none,
              from: At, to: At, below: []).
mark_row(mark(deep, Depth, At), Row) :-
    Row = row(what: deep, goal: Depth, state: true, clause: none, note: none,
              from: At, to: At, below: []).

%!  is_test(+Goal) is semidet.
%
%   Goal compares two terms.

is_test(Goal) :-
    functor(Goal, Name, 2),
    memberchk(Name, [<, >, =<, >=, =:=, =\=, ==, \==, =, \=, @<, @>, @=<,
                     @>=, is]).

% ---------------- FOLDS

%   Rows of one shape that follow each other.

folded(Rows, Folded) :-
    shaped(Rows, Shaped),
    runs(Shaped, Folded).

shaped([], []).
shaped([Row|Rows], [Shape-Row|Shaped]) :-
    shape(Row, Shape),
    shaped(Rows, Shaped).

%   A round of a loop may have several rows.

runs([], []).
runs([Shape-Row|Shaped2], Rows) :-
    Shaped = [Shape-Row|Shaped2],
    (   between(1, 8, Period),
        length(Round, Period),
        append(Round, Shaped1, Shaped),
        rounds(Shaped1, Round, 0, Count, none, Latest, Rest),
        Count > 2
    ->  Between is Count-1,
        Length is Between*Period,
        length(Middle, Length),
        append(Middle, _, Shaped1),
        Middle = [_-row(from: From)|_],
        last(Middle, _-row(to: To)),
        without_shapes(Middle, [], Below),
        Same = row(what: same(Between, Period), goal: none, state: true,
                   clause: none, note: none, from: From, to: To,
                   below: Below),
        without_shapes(Round, [Same|Rows1], Rows),
        without_shapes(Latest, Rows2, Rows1),
        runs(Rest, Rows2)
    ;   Rows = [Row|Rows1],
        runs(Shaped2, Rows1)
    ).

rounds(Shaped, Round, Count0, Count, Latest0, Latest, Rest) :-
    (   again(Round, Shaped, Latest1, Shaped1)
    ->  Count1 is Count0+1,
        rounds(Shaped1, Round, Count1, Count, Latest1, Latest, Rest)
    ;   Count = Count0,
        Latest = Latest0,
        Rest = Shaped
    ).

again([], Shaped, [], Shaped).
again([Shape-_|Round], [Shape1-Row|Shaped], [Shape1-Row|Latest], Rest) :-
    Shape == Shape1,
    again(Round, Shaped, Latest, Rest).

without_shapes([], Rows, Rows).
without_shapes([_-Row|Shaped], Rows0, [Row|Rows]) :-
    without_shapes(Shaped, Rows0, Rows).

shape(Row, Shape) :-
    Row = row(what: What, goal: Goal, state: State, clause: Clause,
              below: Below),
    kind(What, Kind),
    (   Goal = ev3dev_guard(Label, _)
    ->  Name/Arity = guard/Label
    ;   functor(Goal, Name, Arity)
    ),
    ( State = error(_) -> State1 = error ; State1 = State ),
    findall(Shape1,
            ( member(Row1, Below), \+ is_same(Row1),
              shape(Row1, Shape1) ),
            Shapes0),
    without_repetition(Shapes0, Shapes),
    term_hash(f(Kind, Name/Arity, State1, Clause, Shapes), Shape).

kind(What, Kind) :-
    functor(What, Kind, _).

is_same(Row) :-
    Row = row(what: same(_, _)).

without_repetition([], []).
without_repetition([A|As], [A|Bs]) :-
    same_removed(As, A, Rest),
    without_repetition(Rest, Bs).

same_removed([A|As], B, Rest) :-
    A == B,
    !,
    same_removed(As, B, Rest).
same_removed(As, _, As).
