:- module(ev3dev_marking_progress,
          [ progress_begins/3,          % +All, +Seeds, +Options
            runs_over/2,                % +Count, +Options
            progress_line/2,            % +Text, +Options
            progress_ends/1             % +Options
          ]).
:- use_module('../basics/fields', [fields/1, goal_expansion/2]).
:- use_module('../checks/arguments', [option/2]).

/** <module> How far a marking is

On a terminal one line says it, which is written again each time. In a file
there is a line for every ten programs, or none. The remaining time is
estimated from the runs that are over.
*/

:- fields(progress(all, seeds, began, over)).

:- dynamic progress/4.
:- volatile progress/4.

%!  progress_begins(+All, +Seeds, +Options) is det.
%
%   There are All runs, one of each program for each of Seeds seeds. Options
%   may have progress(true), or progress(terminal) for a terminal alone; else
%   nothing is said.

progress_begins(All, Seeds, Options) :-
    retractall(progress(all: _)),
    get_time(Now),
    assertz(progress(All, Seeds, Now, 0)),
    progress_line('~d of ~d runs.'-[0, All], Options).

%!  progress_line(+Text, +Options) is det.
%
%   Replace the line on a terminal by Text, as of print_message_lines/3.

progress_line(Text, Options) :-
    (   on_terminal(Options)
    ->  print_message(help, ev3dev(marking_now(Text)))
    ;   true
    ).

on_terminal(Options) :-
    option(progress(_), Options),
    \+ option(progress(false), Options),
    stream_property(user_error, tty(true)).

%!  runs_over(+Count, +Options) is det.

runs_over(Count, Options) :-
    retract(progress(All, Seeds, Began, Over0)),
    Over is Over0+Count,
    assertz(progress(All, Seeds, Began, Over)),
    (   Count > 0
    ->  get_time(Now),
        Left is (Now-Began) * (All-Over) / Over,
        time_left(Left, Text),
        Programs0 is Over0//Seeds,
        Programs is Over//Seeds,
        AllPrograms is All//Seeds,
        progress_line('~d of ~d runs~w.'-[Over, All, Text], Options),
        (   option(progress(true), Options),
            \+ on_terminal(Options),
            Programs//10 > Programs0//10
        ->  print_message(help,
                          ev3dev(marking(Programs, AllPrograms, Text)))
        ;   true
        )
    ;   true
    ).

time_left(Seconds, Text) :-
    (   Seconds =< 0
    ->  Text = ''                       % all are over
    ;   Seconds < 60
    ->  format(atom(Text), '; about ~0f s left', [max(1, Seconds)])
    ;   Minutes is Seconds/60,
        format(atom(Text), '; about ~0f min left', [Minutes])
    ).

%!  progress_ends(+Options) is det.

progress_ends(Options) :-
    retractall(progress(all: _)),
    progress_line(''-[], Options).

:- multifile prolog:message//1.

prolog:message(ev3dev(marking_now(Format-Values))) -->
    [ at_same_line, '\r~t~60|\r'-[], Format-Values, flush ].
prolog:message(ev3dev(marking(Over, All, Left))) -->
    [ '~d of ~d programs~w.'-[Over, All, Left] ].
