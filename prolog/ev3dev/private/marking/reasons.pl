:- module(ev3dev_marking_reasons,
          [ reasons/6,                  % +Ended, +Output, +File, +Limits,
                                        % +Seconds, -Reasons
            reason_text/2               % +Lines, -Text
          ]).
:- use_module(library(lists), [append/3, list_to_set/2, member/2, select/3]).

/** <module> Why a program ended, in sentences

What a program prints may be forged; it makes these sentences, and no mark.
*/

%!  reasons(+Ended, +Output, +File, +Limits, +Seconds, -Reasons) is det.
%
%   Why a program ended so, as of sim_fenced/3, at Seconds of the robot's
%   time. Reasons is reasons(Ends, Whys, Hints), lists of lines: what ended
%   it, at most one; what private/explain/watched_run.pl found out, if the
%   program was watched; and other errors and warnings, at most two. Limits is
%   limits(Cpu, Sleep).

reasons(Ended, Output, File, Limits, Seconds,
        reasons(Ends, Whys, Hints)) :-
    (   by_itself(Ended),
        load_error(Output, File, Fault)
    ->  Ends = [Fault],
        Whys = [],
        Hints = []
    ;   said(Output, File, Said),
        ends(Ended, Said, Limits, Seconds, Ends, Others),
        findall(Text, member(why-Text, Others), Whys0),
        at_most(4, Whys0, Whys),
        findall(Text, member(hint-Text, Others), Hints0),
        at_most(2, Hints0, Hints)
    ).

by_itself(over).
by_itself(exit(_)).

ends(Ended, Said, Limits, Seconds, Ends, Others) :-
    (   by_itself(Ended),
        select(Kind-First, Said, Others0),
        (   Kind == end
        ;   Kind == hint,
            Ended = exit(Status),
            Status \== 0
        )
    ->  format(atom(End), 'It ended at ~1f s: ~w', [Seconds, First]),
        Ends = [End],
        Others = Others0
    ;   memberchk(Ended, [over, exit(0)])
    ->  Ends = [],
        Others = Said
    ;   ended(Ended, Limits, Seconds, End),
        Ends = [End],
        findall(why-Text, member(why-Text, Said), Others)
    ).

at_most(Count, List0, List) :-
    (   length(List, Count),
        append(List, [_|_], List0)
    ->  true
    ;   List = List0
    ).

%!  reason_text(+Lines, -Text) is det.
%
%   Text has all these Lines of reasons; it is '' for none.

reason_text([], '').
reason_text([First|Others], Text) :-
    (   Others == []
    ->  Text = First
    ;   atomic_list_concat(Others, '; ', Listed),
        ( sub_atom(First, _, _, 0, '.') -> End = '' ; End = '.' ),
        format(atom(Text), '~w~w Also: ~w', [First, End, Listed])
    ).

ended(exit(Status), _, Seconds, Reason) :-
    format(atom(Reason), 'It ended at ~1f s with the exit status ~w.',
           [Seconds, Status]).
ended(killed(Signal), _, Seconds, Reason) :-
    format(atom(Reason), 'It crashed at ~1f s (signal ~w).',
           [Seconds, Signal]).
ended(limit(cpu), limits(Cpu, _), Seconds, Reason) :-
    Used is Cpu + Seconds,
    format(atom(Reason),
           'Stopped after ~0f s of processor time (robot time ~1f s).',
           [Used, Seconds]).
ended(limit(sleep), limits(_, Sleep), Seconds, Reason) :-
    format(atom(Reason),
           'Stopped after ~w s of waiting (robot time ~1f s). Only \c
            wait/1 and devices let that time pass; sleep/1 does not.',
           [Sleep, Seconds]).
ended(limit(inferences(Most)), _, Seconds, Reason) :-
    Millions is Most // 1000000,
    format(atom(Reason),
           'Stopped: it computes without end, or for too long: more than ~d \c
            million steps of Prolog (robot time ~1f s).',
           [Millions, Seconds]).
ended(lost, _, _,
       'It was not marked, because the machine was too busy: mark it again.').
ended(limit(output), _, Seconds, Reason) :-
    format(atom(Reason), 'Stopped after 1 MB of output (robot time ~1f s).',
           [Seconds]).
ended(limit(memory), _, Seconds, Reason) :-
    format(atom(Reason),
           'Stopped: it used too much memory (robot time ~1f s).',
           [Seconds]).
ended(limit(processes), _, Seconds, Reason) :-
    format(atom(Reason),
           'Stopped: it started too many processes (robot time ~1f s).',
           [Seconds]).
ended(refused(Why), _, Seconds, Reason) :-
    format(atom(Reason),
           'Stopped at ~1f s: no program may ask the robot that: ~w.',
           [Seconds, Why]).

%   A syntax error comes before all that the program may print itself.

load_error(Output, File, Reason) :-
    messages(Output, File, Messages),
    member(message(_, Where, Text), Messages),
    Where \== '',
    (   atom_concat(Before, Fault, Text),
        atom_concat(_, 'Syntax error: ', Before)
    ;   sub_atom(Text, 0, _, _, 'Operator expected: '), % with advice
        Fault = Text
    ),
    !,
    format(atom(Reason), '~w: ~w.', [Where, Fault]).

%   Kind-Text for each message, the worst first: what ended the program, what
%   was found out, errors in its file, other errors, warnings.

said(Output, File, Said) :-
    messages(Output, File, Messages),
    findall(Rank-(Kind-Text),
            ( member(message(Mark, Where, Text0), Messages),
              rank(Mark, Where, Text0, Rank, Kind),
              worded(Where, Text0, Text) ),
            Ranked0),
    keysort(Ranked0, Ranked),
    findall(Each, member(_-Each, Ranked), Said0),
    list_to_set(Said0, Said).

rank("ev3dev-end\t", _, _, 1, end) :-
    !.
rank("ev3dev-why\t", _, _, 2, why) :-
    !.
rank(_, _, Text, 1, end) :-
    string_concat("-g ", _, Text),
    !.
rank(_, _, Text, _, _) :-
    (   atom_length(Text, 0)
    ;   member(Begin, [ "Prolog initialisation failed:", % 7.2.3's
                        "Goal (directive) failed",       % the error is said
                        "Use the --stack_limit",
                        "?- set_prolog_flag(stack_limit" ]),
        string_concat(Begin, _, Text)
    ),
    !,
    fail.
rank("ERROR: ", Where, _, Rank, hint) :-
    !,
    ( Where == '' -> Rank = 4 ; Rank = 3 ).
rank(_, _, _, 5, hint).

worded(Where, Text0, Text) :-
    without_call(Text0, Text1),
    without_stack(Text1, Text2),
    (   Where == ''
    ->  atom_string(Text, Text2)
    ;   format(atom(Text), '~w: ~w', [Where, Text2])
    ).

%   -g start: catch/3: What was wrong

without_call(Text0, Text) :-
    (   sub_string(Text0, 0, _, _, "-g "),
        sub_string(Text0, Before, 2, _, ": ")
    ->  After is Before+2,
        sub_string(Text0, After, _, 0, Text1)
    ;   Text1 = Text0
    ),
    (   member(By, ["catch/3: ", "'$run_init_goal'/1: "]),
        string_concat(By, Text2, Text1)
    ->  Text = Text2
    ;   Text = Text1
    ).

%   Of a stack that is full only what called itself.

without_stack(Text0, Text) :-
    (   sub_string(Text0, 0, _, _, "Stack limit "),
        sub_string(Text0, Before, _, _, " exceeded"),
        sub_string(Text0, 0, Before, _, Limit)
    ->  (   sub_string(Text0, _, _, From, "] user:"),
            sub_string(Text0, _, From, 0, Goal),
            sub_string(Goal, Length, 1, _, "("),
            sub_string(Goal, 0, Length, _, Name),
            \+ sub_string(Name, _, _, _, " ")
        ->  format(string(Text),
                   "~w exceeded: ~w calls itself without end", [Limit, Name])
        ;   string_concat(Limit, " exceeded", Text)
        )
    ;   Text = Text0
    ).

%   Lines that Prolog marks as errors or warnings: message(Mark, Where, Text).
%   What follows, and is indented, belongs to the first. Where is a line of
%   File, or ''.

messages(Output, File, Messages) :-
    split_string(Output, "\n", "\r", Lines),
    found(Lines, File, Messages).

found([], _, []).
found([Line|Lines], File, Messages) :-
    (   marked(Line, Mark, Text0)
    ->  continued(Lines, Text0, Text1, Rest),
        (   sub_string(Mark, 0, _, _, "ev3dev-")
        ->  Where = '',
            without_path(Text1, File, Text)
        ;   placed(Text1, File, Where, Text)
        ),
        Messages = [message(Mark, Where, Text)|Messages1],
        found(Rest, File, Messages1)
    ;   found(Lines, File, Messages)
    ).

%   Prolog 10 says which thread it is.
marked(Line, Mark, Text) :-
    member(Mark, [ "ERROR: ", "Warning: ", "ev3dev-end\t", "ev3dev-why\t" ]),
    string_concat(Mark, Text0, Line),
    !,
    (   string_concat("[Thread main] ", Text1, Text0)
    ->  Text = Text1
    ;   Text = Text0
    ).

continued([Line|Lines], Text0, Text, Rest) :-
    marked(Line, _, More0),
    (   string_concat("  ", _, More0)
    ;   sub_string(Text0, _, _, 0, "raised exception:")
    ),
    !,
    split_string(More0, "", " ", [More]),
    string_concat(Text0, " ", Text1),
    string_concat(Text1, More, Text2),
    continued(Lines, Text2, Text, Rest).
continued(Lines, Text, Text, Lines).

placed(Text0, File, Where, Text) :-
    (   atom_string(File, Path),
        string_concat(Path, ":", Head),
        string_concat(Head, Rest, Text0)
    ->  numbers(Rest, Numbers, Text1),
        where(Numbers, Where)
    ;   Where = '',
        Text1 = Text0
    ),
    split_string(Text1, "", " ", [Text2]),
    without_path(Text2, File, Text).

%   12:34: or 12:

numbers(Text, Numbers, Rest) :-
    (   sub_string(Text, Before, 1, _, ":"),
        sub_string(Text, 0, Before, _, First),
        catch(number_string(Number, First), _, fail),
        integer(Number)
    ->  Numbers = [Number|Numbers1],
        After is Before+1,
        sub_string(Text, After, _, 0, Text1),
        numbers(Text1, Numbers1, Rest)
    ;   Numbers = [],
        Rest = Text
    ).

where([], '').
where([Line|More], Where) :-
    (   More = [Column|_]
    ->  format(atom(Where), 'Line ~d, column ~d', [Line, Column])
    ;   format(atom(Where), 'Line ~d', [Line])
    ).

%   Nobody needs to know where the marker has put the files.

without_path(Text0, File, Text) :-
    file_directory_name(File, Folder0),
    atom_concat(Folder0, /, Folder),
    atom_string(Text1, Text0),
    atomic_list_concat(Parts, Folder, Text1),
    atomic_list_concat(Parts, Text).
