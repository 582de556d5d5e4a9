:- module(ev3dev_usage,
          [ usage_begins/1,             % -Used
            usage_goes_on/5,            % +Process, +Slice, :Silent,
                                        % +Used0, -Used
            usage_heard/2,              % +Used0, -Used
            usage_age/2,                % +Used, -Seconds
            usage_beyond/3,             % +Used, +Limits, -Limit
            usage_crowded/3             % +Used, +Megabytes, -Limit
          ]).
:- use_module('../basics/fields',
              [fields/1, goal_expansion/2, term_expansion/2]).
:- use_module('../native/native', [process_usage_/5]).

:- fields(used(began, alive, looked, cpu, slept, rest, threads, bytes)).

:- meta_predicate usage_goes_on(+, +, 0, +, -).

/** <module> Processor time and sleep of a process and its children

Seconds in which a process sleeps are counted, and seconds of a processor, but
not those in which it waits for a processor. So no other process can make this
one come to its limits.

used(Began, Alive, Looked, Cpu, Slept, Rest, Threads, Bytes) has times of the
wall: when this began, when there was the last sign of life, and when the
process was last looked at. Cpu and Slept are seconds. Rest says how often
its threads had left a processor by then, if all of them were asleep, else it
is `awake`. Threads and Bytes are how many they had.
*/

%   How long there may be no sign of life, and how long a run may take, in
%   seconds. Only a machine that is very busy, or ill, comes to that.
:- dynamic most_still/1.

most_still(600).
most(1800).

%   A clock may be set, and a computer be shut for a night.
most_between(1).

%!  usage_begins(-Used) is det.

usage_begins(used(Now, Now, Now, 0, 0, awake, 0, 0)) :-
    get_time(Now).

%!  usage_goes_on(+Process, +Slice, :Silent, +Used0, -Used) is det.
%
%   Look at Process and all its children. If they are asleep, and Silent is
%   true, then they have slept since the last look if none of them ran in
%   between, else for Slice seconds.

usage_goes_on(Process, Slice, Silent,
              used(Began, Alive0, Looked, Cpu0, Slept0, Rest0, _, _),
              used(Began, Alive, Now, Cpu, Slept, Rest, Threads, Bytes)) :-
    get_time(Now),
    (   process_usage_(Process, Cpu1, Rest1, Threads, Bytes)
    ->  Cpu is max(Cpu0, Cpu1)
    ;   Cpu = Cpu0,
        Rest1 = awake,
        Threads = 0,
        Bytes = 0
    ),
    (   Cpu > Cpu0
    ->  Alive = Now
    ;   Alive = Alive0
    ),
    (   Rest1 \== awake,
        call(Silent)
    ->  Rest = Rest1,
        (   Rest1 == Rest0
        ->  most_between(Most)
        ;   Most = Slice
        ),
        Slept is Slept0 + max(0, min(Most, Now-Looked))
    ;   Rest = awake,
        Slept = Slept0
    ).

%!  usage_heard(+Used0, -Used) is det.
%
%   The process gave a sign of life.

usage_heard(Used0, Used) :-
    get_time(Now),
    Used0 = used(Began, _, Looked, Cpu, Slept, Rest, Threads, Bytes),
    Used = used(Began, Now, Looked, Cpu, Slept, Rest, Threads, Bytes).

%!  usage_age(+Used, -Seconds) is det.
%
%   How long ago the last look was.

usage_age(Used, Seconds) :-
    Used = used(looked: Looked),
    get_time(Now),
    Seconds is Now-Looked.

%!  usage_beyond(+Used, +Limits, -Limit) is semidet.
%
%   Limits is limits(Sleep, Cpu), in seconds, or `infinite`. Limit is
%   limit(sleep), limit(cpu), or `lost` if nothing can be said.

usage_beyond(Used, limits(Sleep, _), limit(sleep)) :-
    Used = used(slept: Slept),
    Sleep \== infinite,
    Slept > Sleep,
    !.
usage_beyond(Used, limits(_, Cpu), limit(cpu)) :-
    Used = used(cpu: Time),
    Cpu \== infinite,
    Time > Cpu,
    !.
usage_beyond(Used, limits(_, Cpu), lost) :-
    Used = used(began: Began, alive: Alive, looked: Looked),
    most_still(Still),
    most(Most),
    (   Looked > Alive + Still
    ->  true
    ;   Cpu \== infinite,
        Looked > Began + max(Most, 10*Cpu)
    ).

%!  usage_crowded(+Used, +Megabytes, -Limit) is semidet.
%
%   Limit is limit(processes) if there are more threads than a program of a
%   robot needs, or limit(memory) if they have more than Megabytes together,
%   which may be `unlimited`.

most_threads(200).

usage_crowded(Used, _, limit(processes)) :-
    Used = used(threads: Threads),
    most_threads(Most),
    Threads > Most,
    !.
usage_crowded(Used, Megabytes, limit(memory)) :-
    Used = used(bytes: Bytes),
    Megabytes \== unlimited,
    Bytes > Megabytes << 20.
