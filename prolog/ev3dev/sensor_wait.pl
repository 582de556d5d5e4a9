:- module(ev3dev_sensor_wait,
          [ sensor_wait/1,              % :Condition
            sensor_wait/2               % :Condition, +Options
          ]).
:- set_prolog_flag(generate_debug_info, false).
:- use_module(private/checks/checks, [must_be/2]).
:- use_module(private/errors/errors,
              [domain_error/2, existence_error/2, throw_error/3]).
:- use_module(private/errors/public_clauses, [term_expansion/4]).
:- use_module(private/explain/hints).
:- use_module(sensors, [reading_of/4]).
:- use_module(private/checks/arguments,
              [must_be_options/3, option/2, timeout_option/2]).
:- use_module(private/devices/conditions,
              [comparison/3, condition_goal/2, sensor_named/3]).
:- use_module(private/run/waits, [in_guard/2, waited/1]).
:- use_module(private/native/native, [guards_/0, now_/1, sensor_wait_/5]).
:- use_module(time, [wait/1]).

:- meta_predicate
    sensor_wait(:),
    sensor_wait(:, +).

/** <module> Waiting for a sensor

```
?- go(20), sensor_wait(us_dist_cm(in1) < 25), stop.
?- sensor_wait(touch(in4) = bumped, [timeout(10)]).
```

A program need not look at the sensor again and again: the wait does so a
hundred times a second, by the clock of the brick or of the simulation, and
takes little of the processor's time. Motors go on meanwhile.
*/

%!  sensor_wait(:Condition) is semidet.
%!  sensor_wait(:Condition, +Options) is semidet.
%
%   Wait until Condition holds; not at all if it holds already. Fails if there
%   is no such sensor at the port, or if the time is up. Condition compares a
%   reading with a number, or is about a touch sensor:
%
%     - Reading(Port) < Number
%     - Reading(Port) =< Number
%     - Reading(Port) > Number
%     - Reading(Port) >= Number
%     - Reading(Port) =:= Number
%     - Reading(Port) =\= Number
%       Reading is the name of a predicate that reads one number of a sensor
%       at a port, as `us_dist_cm`, `col_reflect` or `gyro_ang`, or another
%       reading of sensor_reading/3. Number may be an expression.
%     - touch(Port) = pressed
%     - touch(Port) = released
%     - touch(Port) = bumped
%       `bumped` is pressed and released again.
%
%   or is a goal, as for until/2 of library(ev3dev/events):
%   `(us_dist_cm(_, D), D < 20)`, or comparisons joined by `,` and `;`. It is
%   looked at every 20 ms and must not wait or start a motor.
%
%   Options:
%
%     - timeout(+Seconds)
%       Wait at most Seconds. Default is `infinite`.
%     - reason(-Reason)
%       Do not fail or throw if the wait ends early. Reason is `reached`,
%       `timeout` or `unplugged`.
%
%   @error domain_error(sensor_condition, Condition)
%   @error domain_error(sensor_reading, Reading)
%   @error existence_error(sensor, Port) if the sensor is unplugged during the
%          wait
%   @error domain_error(sensor_option, Option) if Option is not an option of
%          this predicate

sensor_wait(Condition) :-
    sensor_wait(Condition, []).

sensor_wait(Module:Condition, Options) :-
    must_be(nonvar, Condition),
    must_not_be_goal(Options),
    must_be_options(sensor_option, [timeout, reason], Options),
    timeout_option(Options, Timeout),
    (   comparison(Condition, Sensor, Test)
    ->  wait_for(Sensor, Test, Timeout, Options)
    ;   is_goal(Condition, Module)
    ->  condition_goal(Module:Condition, Goal),
        holding(Goal, Timeout, Ended),
        (   option(reason(Reason), Options)
        ->  Reason = Ended
        ;   ended(Ended, _)
        )
    ;   domain_error(sensor_condition, Condition)
    ).

must_not_be_goal(Options) :-
    (   compound(Options),
        Options \= [_|_]
    ->  throw_error(type_error(list, Options), _,
                    'put parentheses around a condition of several goals, \c
                     as in sensor_wait((Goal1, Goal2))')
    ;   true
    ).

%   What compares a sensor and is not a comparison/3, or only reads it, is a
%   mistake, not a goal.

is_goal((_, _), _).
is_goal((_ ; _), _).
is_goal(\+ _, _).
is_goal(Condition, Module) :-
    callable(Condition),
    \+ functor(Condition, =, 2),
    functor(Condition, Name, _),
    \+ reading_of(Name, _, _, _),
    \+ ( Condition =.. [Operator, _, _],
         memberchk(Operator, [<, =<, >, >=, =:=, =\=]) ),
    predicate_property(Module:Condition, visible).

holding(Goal, Timeout, Ended) :-
    guards_,
    now_(Start),
    repeat,
    (   in_guard(sensor_wait, Goal)
    ->  Ended = reached
    ;   number(Timeout),
        now_(Now),
        Now - Start >= Timeout
    ->  Ended = timeout
    ;   wait(0.02),
        fail
    ),
    !.

wait_for(Sensor, Test, Timeout, Options) :-
    sensor_named(Sensor, Reading, Port),
    (   reading_of(Reading, Types, Mode, Index),
        sensor_wait_(Port, reading(Types, Mode, Index), Test, Timeout,
                     Ended),
        waited(Ended)
    ->  (   option(reason(Reason), Options)
        ->  Reason = Ended
        ;   ended(Ended, Port)
        )
    ;   fail_because(absent(reading(Reading), Port))
    ).

ended(reached, _).
ended(timeout, _) :-
    fail.
ended(unplugged, Port) :-
    existence_error(sensor, Port).
