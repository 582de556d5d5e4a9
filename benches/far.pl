% A far brick as a process of this machine: what a call costs, and how soon a motor is
% stopped when the worker is killed, the connection is cut or silent, or the program is
% killed, each at 20 random moments.
%
%   swipl -g main -t 'halt(1)' benches/far.pl
%
% Prints seconds, median and worst: to open one, of a call, and of each end.

:- use_module('../tests/support/far_bricks').
:- use_module('../tests/support/trees').
:- use_module(answers).
:- use_module(library(ev3dev/bricks)).
:- use_module(library(lists)).
:- use_module(library(random)).

main :-
    set_random(seed(1)),
    far_place(Where),
    times(10, opened(Where), Opening),
    print_times(open, Opening),
    with_far(anna, times(1000, called, Calling)),
    print_times(call, Calling),
    forall(far_end(How),
           ( times(20, ended(How), Ending), print_times(How, Ending) )),
    halt.

times(Count, Goal, Times) :-
    findall(Time, ( between(1, Count, _), call(Goal, Time) ), Times).

print_times(What, Times) :-
    median(Times, Median),
    max_list(Times, Worst),
    length(Times, Count),
    format("~w ~d ~5f ~5f~n", [What, Count, Median, Worst]).

opened(Where, Time) :-
    time_of(brick_open(anna, Where), Time),
    brick_close(anna).

called(Time) :-
    time_of(far(anna, true), Time).

ended(How, Late) :-
    random(0.0, 1.0, Wait),
    with_tree(plain, [outB-'lego-ev3-l-motor'], stops_when(pipe, How, Wait, Late)).

time_of(Goal, Time) :-
    get_time(Before),
    call(Goal),
    get_time(After),
    Time is After-Before.
