:- module(ev3dev_fenced_log,
          [ tell_to/1                   % +File
          ]).
:- use_module(causes, [follow/1]).
:- use_module(journal_words, [cause_words//1]).
:- use_module('../native/native', [now_/1]).

/** <module> The log of a program of sim_fenced/3

One line for each rule that becomes active, each event and each action of
Golog: the time in seconds, a tab, and words.
*/

%!  tell_to(+File) is det.
%
%   Write what begins from now on to File.

tell_to(File) :-
    open(File, write, Out, [encoding(utf8), buffer(line)]),
    follow(ev3dev_fenced_log:told(counted(0), Out)).

most(4000).

told(Counted, Out, Cause) :-
    arg(1, Counted, Count),
    most(Most),
    Count < Most,
    Next is Count+1,
    nb_setarg(1, Counted, Next),
    now_(Now),
    copy_term(Cause, Copy),
    numbervars(Copy, 0, _),
    phrase(cause_words(Copy), Words),
    with_output_to(string(Text),
                   print_message_lines(current_output, '', Words)),
    split_string(Text, "", " \n", [Trimmed]),
    split_string(Trimmed, "\n", " ", Lines),
    atomic_list_concat(Lines, ' ', Line),
    format(Out, '~3f\t~w~n', [Now, Line]).
