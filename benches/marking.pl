% How long marks take; the figures of docs/performance.md.
%
%   swipl -g main -t 'halt(1)' benches/marking.pl [drive | class]
%
% drive: a minute of a program that polls, in one process and by sim_fenced/3, in turn, five
% times: medians. class: thirty programs, half of them broken, in ten runs each, with one job
% and with two.

:- asserta(user:file_search_path(library, prolog)).
:- use_module(library(ev3dev)).
:- use_module(library(ev3dev/exercise)).
:- use_module(library(ev3dev/sim)).
:- use_module(library(ev3dev/sim_fenced)).
:- use_module('../tests/support/cheats').
:- use_module(library(filesex)).

main :-
    current_prolog_flag(argv, Asked),
    forall(( member(What, [drive, class]), ( Asked == [] -> true ; memberchk(What, Asked) ) ),
           figure(What)),
    halt(0).

timed(Goal, Seconds) :-
    get_time(Before),
    ( call(Goal) -> true ; throw(failed(Goal)) ),
    get_time(After),
    Seconds is After-Before.

write_file(File, Lines) :-
    setup_call_cleanup(open(File, write, Out),
                       forall(member(Line, Lines), ( write(Out, Line), nl(Out) )),
                       close(Out)).

median(Values, Median) :-
    msort(Values, Sorted),
    length(Sorted, Count),
    Middle is Count//2,
    nth0(Middle, Sorted, Median).

polls([ ":- use_module(library(ev3dev)).",
        "start :- set_robot(5.6, 10.6, outB, outC), repeat, step, fail.",
        "step :- us_dist_cm(in1, Cm), ( Cm < 25 -> turn(60) ; go(30) )." ]).

figure(drive) :-
    polls(Lines),
    tmp_file(polls, Base),
    atom_concat(Base, '.pl', File),
    write_file(File, Lines),
    load_files(polls:File, [silent(true)]),
    Options = [clock(virtual), noise(true), seed(4)],
    findall(Within-Fenced,
            ( between(1, 5, _),
              timed(with_sim(room, for_seconds(60, polls:start), Options), Within),
              timed(with_sim(room, sim_fenced(File, over, [goal(start), seconds(60)]), Options),
                    Fenced) ),
            Pairs),
    delete_file(File),
    findall(Within, member(Within-_, Pairs), Withins),
    findall(Fenced, member(_-Fenced, Pairs), Fenceds),
    median(Withins, A),
    median(Fenceds, B),
    Ratio is B/A,
    format("a minute of polling: ~2f s in one process, ~2f s fenced with its start: ~1f times~n",
           [A, B, Ratio]).
figure(class) :-
    tmp_file(class, Folder),
    make_directory(Folder),
    findall(File, submission(Folder, File), Files),
    findall(Time-Marks,
            ( member(Jobs, [1, 2]),
              timed(exercise_mark('course/03-obstacles/exercise', Files, [jobs(Jobs)], Marks),
                    Time) ),
            [One-Marks1, Two-Marks2]),
    delete_directory_and_contents(Folder),
    ( Marks1 == Marks2 -> Same = "the same marks" ; Same = "OTHER MARKS" ),
    Ratio is One/Two,
    format("30 programs in ten runs: ~0f s with one job, ~0f s with two: ~1f times as fast, ~s~n",
           [One, Two, Ratio, Same]).

%   Fifteen broken ones, and fifteen that avoid boxes more or less.
submission(Folder, File) :-
    findall(Name-Lines, cheat(Name, Lines), All),
    length(Broken, 15),
    append(Broken, _, All),
    (   member(Name-Lines, Broken),
        Text = [":- use_module(library(ev3dev))."|Lines]
    ;   between(1, 15, N),
        Near is 25+2*N,
        Speed is 15+N,
        atom_concat(avoids, N, Name),
        format(string(Avoid), "avoid :: us_dist_cm(in1, Cm), Cm < ~w ~~> turn(20).", [Near]),
        format(string(Wander), "wander :: true ~~> go(~w).", [Speed]),
        Text = [ ":- use_module(library(ev3dev)).", ":- use_module(library(ev3dev/rules)).",
                 Avoid, Wander,
                 "start :- set_robot(5.6, 10.6, outB, outC), behave([avoid, wander])." ]
    ),
    atomic_list_concat([Folder, /, Name, '.pl'], File),
    write_file(File, Text).
