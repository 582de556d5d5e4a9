% Worker of benches/run.py: how quick rules are, in real time, over a plain tree. Reads
% terms, answers each with a line of numbers:
%
%   reaction(Rules, Count)    seconds from a sensor's change to the first write of the
%                             action that is for it: the median of Count changes, and
%                             the worst
%   rules(Rules, Seconds)     the share of a core that so many rules take at 50 Hz
%   wait(idle, Seconds)       and a wait

:- use_module(library(ev3dev)).
:- use_module(library(ev3dev/rules)).
:- use_module(library(lists)).
:- use_module(library(random)).
:- use_module(answers).

:- initialization(main, main).

main :-
    answer_terms(answer).

answer(wait(idle, Seconds), [Share]) :-
    cpu_share(wait(Seconds), Share).
answer(rules(Count, Seconds), [Share]) :-
    rules(Count, (last :: us_dist_cm(_, _) ~> motor_run(outA, 50)), Rules),
    cpu_share(behave(Rules, [timeout(Seconds)]), Share).
answer(reaction(Count, Changes), [Median, Worst]) :-
    thread_self(Me),
    rules(Count,
          (last :: us_dist_cm(_, D) ~> motor_run(outA, 50), reacted(Changer, D)),
          Rules),
    thread_create(changes(Changes, Me), Changer, []),
    behave(Rules, [until(thread_peek_message(over(_)))]),
    thread_get_message(over(Times)),
    thread_join(Changer, _),
    median(Times, Median),
    max_list(Times, Worst).

%   Count rules, of which only Last ever applies: all guards are looked at.
rules(Count, Last, Rules) :-
    Before is Count - 1,
    findall((r(I) :: us_dist_cm(_, D), D < 0 ~> stop), between(1, Before, I), Rules0),
    append(Rules0, [Last], Rules).

%   The motor's command has just been written.
reacted(Changer, Distance) :-
    get_time(Time),
    thread_send_message(Changer, reacted(Distance, Time)).

%   Another thread changes what the sensor shows, at no certain time of a period.
changes(Count, Main) :-
    getenv('EV3DEV_SYSFS', Root),
    atom_concat(Root, '/lego-sensor/sensor0/value0', File),
    setup_call_cleanup(
        open(File, update, Stream, [buffer(full)]),
        ( change(Stream, 100, _),
          sleep(0.1),
          findall(Seconds,
                  ( between(1, Count, I),
                    random(Share),
                    Pause is 0.03 + 0.04*Share,
                    sleep(Pause),
                    Value is 200 + I mod 700,
                    change(Stream, Value, Time0),
                    Distance is Value / 10,
                    reaction(Distance, Time),
                    Seconds is Time - Time0
                  ),
                  Times) ),
        close(Stream)),
    thread_send_message(Main, over(Times)).

%   In one write: a read sees one value or the other.
change(Stream, Value, Time) :-
    seek(Stream, 0, bof, _),
    format(Stream, "~d~n", [Value]),
    get_time(Time),
    flush_output(Stream).

reaction(Distance, Time) :-
    repeat,
    thread_get_message(reacted(Distance0, Time)),
    Distance0 =:= Distance,
    !.
