:- module(ev3dev_reasoning_words,
          [ reasoning_lines/1,          % -Lines
            row_words/2,                % +Row, -Text
            mark/3,                     % +What, +State, -Mark
            remark/3                    % +Row, -Kind, -Text
          ]).
:- set_prolog_flag(generate_debug_info, false).
:- use_module(library(lists), [member/2]).
:- use_module('../basics/fields',
              [fields/1, goal_expansion/2, term_expansion/2]).
:- use_module('../basics/small_lists', [and_list/2]).
:- use_module('../errors/message_text', [message_text/2]).
:- use_module(outline, [episodes/1, outline/2]).
:- use_module(recorder, [lost/1, moment/4]).
:- use_module(why_false, [clause_words/2, goal_words/2, why_false/2]).

/** <module> The outline of a recorded run in words
*/

width(78).

%!  reasoning_lines(-Lines) is det.
%
%   Lines are the rows of the outline, what is missing, and why the goal is
%   false. A line has at most 78 characters.

reasoning_lines(Lines) :-
    episodes(Episodes),
    outline(Episodes, Rows),
    findall(Line, line(Rows, Episodes, Line), Lines).

line(Rows, _, Line) :-
    row_line(Rows, 0, Line).
line(_, _, Line) :-
    lost(Count),
    format(string(Line), '~D events in the middle are lost: the record was \c
                          full.', [Count]).
line(_, Episodes, Line) :-
    why_false(Episodes, Sentences),
    (   Line = ""
    ;   atomic_list_concat(Sentences, ' ', Text),
        wrapped(Text, Line)
    ).

row_line(Rows, Depth, Line) :-
    member(Row, Rows),
    Row = row(what: What, state: State, from: From, below: Below),
    (   time_words(What, From, Time),
        mark(What, State, Mark),
        row_words(Row, Text),
        findall(Remark, remark(Row, _, Remark), Remarks),
        Indent is 2*min(Depth, 20),
        format(string(Begin0), '~w ~*c~w ~w',
               [Time, Indent, 0' , Mark, Text]),
        cut_off(Begin0, Begin),
        laid_out(Begin, Remarks, Line)
    ;   What \= same(_, _),
        Depth1 is Depth+1,
        row_line(Below, Depth1, Line)
    ).

time_words(What, Moment, Text) :-
    (   What \= same(_, _),
        moment(Moment, Time, _, _)
    ->  format(string(Text), '~t~2f~7|', [Time])
    ;   Text = "       "
    ).

%!  mark(+What, +State, -Mark) is det.
%!  row_words(+Row, -Text) is det.
%!  remark(+Row, -Kind, -Text) is nondet.
%
%   What a row says: a letter for its state, its goal, and remarks. The Kind
%   of a remark is `place` (of the clause), `fault`, `effect` (of the robot,
%   which stays), or `plain`.

mark(What, State, Mark) :-
    (   What = ways(_)
    ->  Mark = ?
    ;   What = same(_, _)
    ->  Mark = ' '
    ;   What == cut
    ->  Mark = !
    ;   memberchk(State-Mark, [true-(+), open-(+), running-(*)])
    ->  true
    ;   Mark = (-)
    ).

row_words(Row, Text) :-
    Row = row(what: What, goal: Goal, clause: Clause),
    once(what(What, Goal, Clause, Text)).

what(way(Number), Goal, _, Text) :-
    goal_words(Goal, Words),
    format(string(Text), '~d. ~w', [Number, Words]).
what(no_more, Goal, _, Text) :-
    goal_words(Goal, Words),
    format(string(Text), 'no more answers of ~w', [Words]).
what(clause, _, Clause, Text) :-
    (   clause_words(Clause, Text)
    ->  true
    ;   Text = "the same clause again"
    ).
what(same(Count, Period), _, _, Text) :-
    (   Period =:= 1
    ->  format(string(Text), '... ~D more that do the same', [Count])
    ;   format(string(Text), '... ~D more rounds of these ~d rows',
               [Count, Period])
    ).
what(deep, Depth, _, Text) :-
    format(string(Text), 'deeper than ~D calls: not recorded', [Depth]).
what(cut, Goals, _, Text) :-
    (   Goals == []
    ->  Text = "the cut drops the clauses that follow"
    ;   findall(Words,
                ( member(Goal, Goals), goal_words(Goal, Words) ),
                All0),
        sort(All0, All),
        and_list(All, Listed),
        format(string(Text), 'the cut drops more answers of ~w', [Listed])
    ).
what(_, Goal, _, Text) :-
    (   Goal = ev3dev_guard(Label, Guard)
    ->  goal_words(Label, Words),
        goal_words(Guard, GuardWords),
        format(string(Text), '~w: ~w', [Words, GuardWords])
    ;   goal_words(Goal, Text)
    ).

remark(Row, Kind, Text) :-
    Row = row(what: What, state: State, clause: Clause, note: Note,
              below: Below),
    (   Kind = plain,
        way_remark(What, State, Text)
    ;   Kind = place,
        What \== clause,
        clause_words(Clause, Text)
    ;   What == goal,
        Note \= false(_),
        state_remark(State, Below, Kind, Text)
    ;   note_remark(Note, Kind, Text)
    ).

way_remark(ways(Count), State, Text) :-
    (   Count =:= 1
    ->  Ways = way,
        Given = given
    ;   Ways = ways,
        Given = 'all given'
    ),
    (   State == false
    ->  format(string(Text), '~D ~w, ~w up', [Count, Ways, Given])
    ;   format(string(Text), '~D ~w', [Count, Ways])
    ).

state_remark(false, [_|_], fault, "fails").
state_remark(error(Ball), _, fault, Text) :-
    (   Ball = error(Formal, _),
        nonvar(Formal)
    ->  message_text(Ball, Words0),
        normalize_space(string(Words), Words0),
        format(string(Text), 'throws an error: ~w', [Words])
    ;   goal_words(Ball, Words),
        format(string(Text), 'throws ~w', [Words])
    ).
state_remark(left, _, plain, "interrupted").
state_remark(running, _, plain, "runs").
state_remark(open, Below, plain, "may have more answers") :-
    \+ ( member(Row, Below), Row = row(state: open) ).

note_remark(given_up(Goal), fault, Text) :-
    goal_words(Goal, Words),
    format(string(Text), 'given up: ~w', [Words]).
note_remark(false(Goal), fault, Text) :-
    goal_words(Goal, Words),
    format(string(Text), '~w is false', [Words]).
note_remark(moved(Seconds), effect, Text) :-
    format(string(Text), 'moved ~1f s, stays done', [Seconds]).
note_remark(commanded, effect, "stays done").

cut_off(Line0, Line) :-
    width(Width),
    Length is Width-3,
    (   sub_string(Line0, 0, Length, After, Begin),
        After > 3
    ->  string_concat(Begin, "...", Line)
    ;   Line = Line0
    ).

%   The remarks are at the right, or on the next line.

laid_out(Begin, [], Line) :-
    !,
    Line = Begin.
laid_out(Begin, Remarks, Line) :-
    atomic_list_concat(Remarks, ', ', Text),
    string_length(Begin, Length1),
    string_length(Text, Length2),
    width(Width),
    (   Length1+2+Length2 =< Width
    ->  format(string(Line), '~w~t~w~*|', [Begin, Text, Width])
    ;   (   Line = Begin
        ;   Length2 =< Width
        ->  format(string(Line), '~t~w~*|', [Text, Width])
        ;   wrapped(Text, Line)
        )
    ).

wrapped(Text, Line) :-
    split_string(Text, " ", "", Words),
    filled(Words, "", Lines),
    member(Line, Lines).

filled([], Line, [Line]).
filled([Word|Words], Line0, Lines) :-
    (   Line0 == ""
    ->  filled(Words, Word, Lines)
    ;   string_concat(Line0, " ", Line1),
        string_concat(Line1, Word, Line),
        string_length(Line, Length),
        width(Width),
        (   Length =< Width
        ->  filled(Words, Line, Lines)
        ;   Lines = [Line0|Lines1],
            filled(Words, Word, Lines1)
        )
    ).
