:- module(ev3dev_time,
          [ ev3_time/1,                 % -Seconds
            wait/1,                     % +Seconds
            stopwatch/1,                % -Watch
            elapsed/2                   % +Watch, -Seconds
          ]).
:- set_prolog_flag(generate_debug_info, false).
:- use_module(private/checks/checks, [must_be/2]).
:- use_module(private/errors/errors, [domain_error/2]).
:- use_module(private/errors/public_clauses, [term_expansion/4]).
:- use_module(files, []).
:- use_module(private/checks/arguments, [number_value/3]).
:- use_module(private/run/waits, [waited/1]).
:- use_module(private/native/native, [now_/1, wait_/2]).

/** <module> Waiting, the clock, stopwatches

The brick has a clock, and so has the simulator. These predicates use the
clock of the devices in use. So a program means the same on the robot and in a
simulation, where time may pass much faster.

```
?- go(30), wait(0.5), stop.
?- stopwatch(Watch), go_cm(30, 100), elapsed(Watch, Seconds).
```

sleep/1, get_time/1 and statistics/2 know only the wall clock.
*/

%!  ev3_time(-Seconds) is det.
%
%   Seconds, a float, have passed since some fixed moment: the start of the
%   brick, or of the simulation.

ev3_time(Seconds) :-
    now_(Seconds).

%!  wait(+Seconds) is det.
%
%   Wait. Motors and sounds go on meanwhile. Ctrl-C and time limits end the
%   wait. Seconds may be an arithmetic expression.
%
%   @error domain_error(seconds, Seconds) if Seconds is negative

wait(Seconds0) :-
    number_value(seconds, Seconds0, Seconds),
    wait_(Seconds, Reason),
    waited(Reason),
    !.

%!  stopwatch(-Watch) is det.
%
%   Watch is a stopwatch that starts now. A program may have any number of
%   them, and may keep them in facts. None needs to be stopped.

stopwatch(stopwatch(Start)) :-
    now_(Start).

%!  elapsed(+Watch, -Seconds) is det.
%
%   Seconds, a float, have passed since the start of Watch. It is of no use
%   for a Watch that was started before the simulation.
%
%   @error domain_error(stopwatch, Watch)

elapsed(Watch, Seconds) :-
    must_be(nonvar, Watch),
    (   Watch = stopwatch(Start),
        number(Start)
    ->  now_(Now),
        Seconds is Now - Start
    ;   domain_error(stopwatch, Watch)
    ).
