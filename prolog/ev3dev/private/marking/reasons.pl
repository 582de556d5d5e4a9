:- module(ev3dev_marking_reasons,
          [ reason/6                    % +Ended, +Output, +File, +Limits,
                                        % +Seconds, -Reason
          ]).
:- use_module(library(lists), [list_to_set/2, member/2]).

/** <module> Why a program ended, in a sentence

What a program prints may be forged; it makes this sentence, and no mark.
*/

%!  reason(+Ended, +Output, +File, +Limits, +Seconds, -Reason) is det.
%
%   Reason is '' if nothing is wrong with a program that ended so, as of
%   sim_fenced/3, at Seconds of the robot's time. Limits is
%   limits(Cpu, Sleep).

reason(over, Output, File, _, _, Reason) :-
    load_error(Output, File, Reason),
    !.
reason(over, _Output, _File, _, _Seconds, '') :-
    !.
reason(exit(Status), Output, File, _, Seconds, Reason) :-
    !,
    (   load_error(Output, File, Reason)
    ->  true
    ;   Status == 0
    ->  Reason = ''
    ;   ranked(Output, File, [First|Rest])
    ->  also(Rest, Also),
        format(atom(Reason), 'It ended at ~1f s: ~w~w',
               [Seconds, First, Also])
    ;   format(atom(Reason), 'It ended at ~1f s with the exit status ~w.',
               [Seconds, Status])
    ).
reason(killed(Signal), _, _, _, Seconds, Reason) :-
    format(atom(Reason), 'It crashed at ~1f s (signal ~w).',
           [Seconds, Signal]).
reason(limit(cpu), _, _, limits(Cpu, _), Seconds, Reason) :-
    Used is Cpu + Seconds,
    format(atom(Reason),
           'Stopped after ~0f s of processor time (robot time ~1f s).',
           [Used, Seconds]).
reason(limit(sleep), _, _, limits(_, Sleep), Seconds, Reason) :-
    format(atom(Reason),
           'Stopped after ~w s of waiting (robot time ~1f s). Only \c
            wait/1 and devices let that time pass; sleep/1 does not.',
           [Sleep, Seconds]).
reason(limit(inferences(Most)), _, _, _, Seconds, Reason) :-
    Millions is Most // 1000000,
    format(atom(Reason),
           'Stopped: it computes without end, or for too long: more than ~d \c
            million steps of Prolog (robot time ~1f s).',
           [Millions, Seconds]).
reason(lost, _Output, _, _, _,
       'It was not marked, because the machine was too busy: mark it again.').
reason(limit(output), _, _, _, Seconds, Reason) :-
    format(atom(Reason), 'Stopped after 1 MB of output (robot time ~1f s).',
           [Seconds]).
reason(limit(memory), _, _, _, Seconds, Reason) :-
    format(atom(Reason),
           'Stopped: it used too much memory (robot time ~1f s).',
           [Seconds]).
reason(limit(processes), _, _, _, Seconds, Reason) :-
    format(atom(Reason),
           'Stopped: it started too many processes (robot time ~1f s).',
           [Seconds]).
reason(refused(Why), _, _, _, Seconds, Reason) :-
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

%   What is wrong, the worst first: what ended the program, errors in its
%   file, other errors, warnings.

ranked(Output, File, Texts) :-
    messages(Output, File, Messages),
    findall(Rank-Text,
            ( member(message(Mark, Where, Text0), Messages),
              rank(Mark, Where, Text0, Rank),
              worded(Where, Text0, Text) ),
            Ranked0),
    keysort(Ranked0, Ranked),
    findall(Text, member(_-Text, Ranked), Texts0),
    list_to_set(Texts0, Texts).

rank(_, _, Text, 1) :-
    string_concat("-g ", _, Text),
    !.
rank(_, _, Text, _) :-
    (   atom_length(Text, 0)
    ;   member(Begin, [ "Prolog initialisation failed:", % 7.2.3's
                        "Goal (directive) failed",       % the error is said
                        "Use the --stack_limit",
                        "?- set_prolog_flag(stack_limit" ]),
        string_concat(Begin, _, Text)
    ),
    !,
    fail.
rank("ERROR: ", Where, _, Rank) :-
    !,
    ( Where == '' -> Rank = 3 ; Rank = 2 ).
rank(_, _, _, 4).

worded(Where, Text0, Text) :-
    without_call(Text0, Text1),
    without_stack(Text1, Text2),
    (   Where == ''
    ->  Text = Text2
    ;   format(atom(Text), '~w: ~w', [Where, Text2])
    ).

%   At most two.

also([], '').
also([First|Rest], Also) :-
    (   Rest = [Second|_]
    ->  format(atom(Also), '. Also: ~w; ~w', [First, Second])
    ;   format(atom(Also), '. Also: ~w', [First])
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
        placed(Text1, File, Where, Text),
        Messages = [message(Mark, Where, Text)|Messages1],
        found(Rest, File, Messages1)
    ;   found(Lines, File, Messages)
    ).

%   Prolog 10 says which thread it is.
marked(Line, Mark, Text) :-
    member(Mark, ["ERROR: ", "Warning: "]),
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
where([Line], Where) :-
    format(atom(Where), 'Line ~d', [Line]).
where([Line, Column|_], Where) :-
    format(atom(Where), 'Line ~d, column ~d', [Line, Column]).

%   Nobody needs to know where the marker has put the file.

without_path(Text0, File, Text) :-
    file_base_name(File, Name),
    atom_string(Text1, Text0),
    atomic_list_concat(Parts, File, Text1),
    atomic_list_concat(Parts, Name, Text).
