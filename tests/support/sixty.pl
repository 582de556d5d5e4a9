:- module(sixty,
          [ sixty/1,                    % +Folder
            written/3                   % +Path, +Encoding, +Text
          ]).
:- use_module(library(filesex)).
:- use_module(library(lists)).

/** <module> What a class of sixty hands in

Good, middling and broken programs in the forms of learning platforms, with the names and encodings
that students have.
*/

%!  sixty(+Folder) is det.
%
%   Write them into Folder: `moodle` has 30, `github` 12, `gradescope` 10, and `plain` 8.

sixty(Folder) :-
    forall(between(1, 60, N),
           ( nth0_cyclic(N, Kind),
             program(Kind, N, Encoding, Ending, Text),
             place(N, Ending, Base),
             atomic_list_concat([Folder, /, Base], File),
             written(File, Encoding, Text) )),
    atom_concat(Folder, '/gradescope/submission_metadata.yml', Metadata),
    with_output_to(string(Text),
        forall(between(43, 52, N),
               format("submission_~d:~n  :submitters:~n  - :name: Gwen O'Neil ~d~n    :sid: '~d'~n\c
                           :email: g~d@example.org~n  :created_at: 2026-11-29 10:00:00.0 Z~n",
                      [N, N, N, N]))),
    written(Metadata, utf8, Text).

nth0_cyclic(N, Kind) :-
    findall(K, clause(program(K, _, _, _, _), _), Kinds),
    length(Kinds, Count),
    Index is N mod Count,
    nth0(Index, Kinds, Kind).

place(N, Ending, Base) :-
    N =< 30,
    !,
    nth1_name(N, Name),
    ( N mod 2 =:= 0 -> Last = '_' ; Last = '' ),
    Id is 100+N,
    format(atom(Base), 'moodle/~w_~d_assignsubmission_file~w/mine~w', [Name, Id, Last, Ending]).
place(N, Ending, Base) :-
    N =< 42,
    !,
    format(atom(Base), 'github/garage-user~d/src/mine~w', [N, Ending]).
place(N, Ending, Base) :-
    N =< 52,
    !,
    format(atom(Base), 'gradescope/submission_~d/mine~w', [N, Ending]).
place(N, Ending, Base) :-
    nth1(_, [53-'=cmd()', 54-'<script>alert(1)<', 55-'a, "b"', 56-'[x]{y}', 57-'\u00e9\u00df \u65e5\u672c',
             58-'a\nb', 59-Long, 60-'-rf'], N-Name),
    !,
    length(Codes, 200),
    maplist(=(0'x), Codes),
    atom_codes(Long, Codes),
    format(atom(Base), 'plain/~w~w', [Name, Ending]).

%   Two are called Anna Lee.
nth1_name(N, Name) :-
    (   memberchk(N-Name, [1-'Anna Lee', 2-'Anna Lee', 3-'Zo\u00eb M\u00fcller', 4-'D\'Arcy X'])
    ->  true
    ;   format(atom(Name), 'Student ~d', [N])
    ).

loads(":- use_module(library(ev3dev)).\n").

%   program(Kind, Number, Encoding, Ending, Text)
program(good, _, utf8, '.pl', Text) :-
    text("start :- set_robot(5.6, 10.6, outB, outC), approach, say(done, [wait(true)]).\n\c
          approach :- repeat, us_dist_cm(in1, D), ( D > 22 -> go(20), fail ; stop ), !.\n", Text).
program(middling, N, utf8, '.pl', Text) :-
    Cm is 60+N,
    format(string(Own), "start :- set_robot(5.6, 10.6, outB, outC), go_cm(20, ~d).~n", [Cm]),
    text(Own, Text).
program(blind, N, utf8, '.pl', Text) :-
    Speed is 20+N,
    format(string(Own), "start :- set_robot(5.6, 10.6, outB, outC), go(~d), wait(20).~n", [Speed]),
    text(Own, Text).
program(no_syntax, _, utf8, '.pl', Text) :-
    text("start :- go(20) go(30).\n", Text).
program(dies, _, utf8, '.PL', Text) :-
    text("start :- set_robot(5.6, 10.6, outB, outC), go_cm(20, 50), X is foo+1, go(X).\n\c
          unused(A, B) :- write(A).\n", Text).
program(latin_1, _, iso_latin_1, '.pl', Text) :-
    text("% F\u00e4hrt los\nstart :- set_robot(5.6, 10.6, outB, outC), go_cm(20, 80).\n", Text).
program(utf_16, _, unicode_le, '.pl', Text) :-
    text("% F\u00e4hrt los\nstart :- set_robot(5.6, 10.6, outB, outC), go_cm(20, 90).\n", Text0),
    string_concat("\uFEFF", Text0, Text).
program(windows, _, utf8, '.pro', Text) :-
    string_concat("\uFEFF:- use_module(library(ev3dev)).\r\n",
                  "start :- set_robot(5.6, 10.6, outB, outC),\r\n    go_cm(20, 100).\r\n", Text).
program(empty, _, utf8, '.pl', "").
program(notepad, _, utf8, '.pl.txt', Text) :-
    text("start :- set_robot(5.6, 10.6, outB, outC), go_cm(20, 70).\n", Text).
program(forever, _, utf8, '.pl', Text) :-
    text("start :- repeat, fail.\n", Text).

text(Own, Text) :-
    loads(Loads),
    string_concat(Loads, Own, Text).

%!  written(+Path, +Encoding, +Text) is det.
%
%   Write a file, and the folders that it needs.

written(Path, Encoding, Text) :-
    file_directory_name(Path, Folder),
    make_directory_path(Folder),
    setup_call_cleanup(open(Path, write, Out, [encoding(Encoding), newline(posix)]),
                       write(Out, Text),
                       close(Out)).
