:- module(ev3dev_reasoning_page,
          [ record_size/2,              % -Record, -Events
            record_part/1               % -Pairs
          ]).
:- set_prolog_flag(generate_debug_info, false).
:- use_module(library(lists), [append/3, member/2]).
:- use_module('../basics/fields',
              [fields/1, goal_expansion/2, term_expansion/2]).
:- use_module(instrument, [clause_of/2]).
:- use_module(outline, [episodes/1, is_test/1, outline/2]).
:- use_module(reasoning_words, [mark/3, remark/3, row_words/2]).
:- use_module(recorder,
              [event/5, lost/1, moment/4, recorded_goal/1]).
:- use_module(why_false, [goal_words/2, why_false/2]).

/** <module> What was recorded, for a page

The outline, its moments and the files of the program, in parts that a page
gets one after the other.
*/

:- thread_local text/2.                 % Text, Number

%   The rows and the moments of a part, and the longest file, in bytes.
most(4000).
longest(200000).

%!  record_size(-Record, -Events) is det.
%
%   Record is the number of the latest record, with all its Events.

record_size(Record, Events) :-
    flag(ev3dev_reasoning_record, Record, Record),
    predicate_property(ev3dev_recorder:event(_, _, _Node, _, _),
                       number_of_clauses(Kept)),
    ( lost(Lost) -> true ; Lost = 0 ),
    Events is Kept+Lost.

%!  record_part(-Pairs) is nondet.
%
%   Pairs are a part of what a page is to know, as docs/view-protocol.md has
%   it. The first one says what was recorded, the last one has `end`. Fails if
%   nothing is recorded.

record_part(Pairs) :-
    record_size(Record, Events),
    recorded_goal(_:Goal),
    episodes(Episodes),
    outline(Episodes, Rows),
    goal_words(Goal, Text0),
    atom_string(Text0, Text),
    ( why_false(Episodes, Why) -> true ; Why = [] ),
    ( lost(Lost) -> true ; Lost = 0 ),
    findall(File, file_text(File), Files),
    findall(Moment, moment_list(Moment), Moments),
    retractall(text(_, _)),
    nb_setval(ev3dev_reasoning_texts, 0),
    findall(List, row_list(Rows, 0, List), Lists),
    findall(Said, ( text(Words, _), atom_string(Words, Said) ), Texts),
    (   Pairs = [ record=Record, events=Events, goal=Text, why=Why,
                  lost=Lost, files=Files ]
    ;   part(texts-Texts, Pairs)
    ;   part(moments-Moments, Pairs)
    ;   part(rows-Lists, Pairs)
    ;   Pairs = [end=true]
    ).

part(Name-List, Pairs) :-
    List \== [],
    most(Most),
    (   length(Part, Most),
        append(Part, Rest, List)
    ->  (   Pairs = [Name=Part]
        ;   part(Name-Rest, Pairs)
        )
    ;   Pairs = [Name=List]
    ).

%   Files of the program whose clauses were called.

file_text(json([name=Name, text=Text])) :-
    findall(File, clause_of(_, place(_, _, _Of, File, _)), Files0),
    sort(Files0, Files),
    member(File, Files),
    longest(Longest),
    catch(( size_file(File, Size), Size =< Longest,
            setup_call_cleanup(open(File, read, In, [encoding(utf8)]),
                               read_string(In, _, Text),
                               close(In)) ),
          error(_, _), fail),
    file_base_name(File, Base),
    atom_string(Base, Name).

moment_list([Time, X, Y, Heading]) :-
    moment(_, Time, Pose, _),
    (   Pose = pose(X, Y, Heading)
    ->  true
    ;   X = null,
        Y = null,
        Heading = null
    ).

%   Depth, mark, text, plain remark, place, fault, effect, from, to, and 1 for
%   the guard of a rule, which is folded. A text is the place of it among the
%   texts.

row_list(Rows, Depth, List) :-
    member(Row, Rows),
    Row = row(what: What, goal: Goal, state: State, from: From, to: To,
              below: Below),
    (   mark(What, State, Mark),
        row_words(Row, Text),
        findall(Number,
                ( member(Kind, [plain, place, fault, effect]),
                  remarks(Kind, Row, Words),
                  text_number(Words, Number) ),
                Numbers),
        text_number(Mark, MarkNumber),
        text_number(Text, TextNumber),
        ( Goal = ev3dev_guard(_, _) -> Folded = [1] ; Folded = [] ),
        append([Depth, MarkNumber, TextNumber|Numbers], [From, To|Folded],
               List)
    ;   Depth1 is Depth+1,
        row_list(Below, Depth1, List)
    ).

remarks(Kind, Row, Words) :-
    findall(Remark, remark(Row, Kind, Remark), Remarks0),
    (   Kind == fault,
        Remarks0 == [],
        Row = row(what: goal, goal: Goal, state: false)
    ->  (   is_test(Goal)
        ->  Words = 'is false'
        ;   Words = fails
        )
    ;   atomic_list_concat(Remarks0, ', ', Words)
    ).

%   Prolog finds an atom by its index, but not a string.

text_number(Text0, Number) :-
    atom_string(Text, Text0),
    (   text(Text, Number0)
    ->  Number = Number0
    ;   nb_getval(ev3dev_reasoning_texts, Number),
        Next is Number+1,
        nb_setval(ev3dev_reasoning_texts, Next),
        assertz(text(Text, Number))
    ).
