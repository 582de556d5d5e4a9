:- module(ev3dev_sensor_wait,
          [ sensor_wait/1,              % +Condition
            sensor_wait/2               % +Condition, +Options
          ]).
:- set_prolog_flag(generate_debug_info, false).
:- use_module(private/errors,
              [ domain_error/2, existence_error/2, must_be/2,
                term_expansion/4, throw_error/3
              ]).
:- use_module(private/explain).
:- use_module(sensors, [reading_of/4]).
:- use_module(private/arguments,
              [ must_be_options/3, number_value/2, option/2,
                timeout_option/2
              ]).
:- use_module(private/waits, [waited/1]).
:- use_module(private/native, [sensor_wait_/5]).

/** <module> Waiting for a sensor

```
?- go(20), sensor_wait(us_dist_cm(in1) < 25), stop.
?- sensor_wait(touch(in4) = bumped, [timeout(10)]).
```

A program need not look at the sensor again and again: the wait does so a
hundred times a second, by the clock of the brick or of the simulation, and
takes little of the processor's time. Motors go on meanwhile.
*/

%!  sensor_wait(+Condition) is semidet.
%!  sensor_wait(+Condition, +Options) is semidet.
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

sensor_wait(Condition, Options) :-
    must_be(nonvar, Condition),
    (   condition(Condition, Sensor, Test)
    ->  true
    ;   domain_error(sensor_condition, Condition)
    ),
    must_be_options(sensor_option, [timeout, reason], Options),
    timeout_option(Options, Timeout),
    port(Sensor, Reading, Port),
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

condition(Sensor = Word, Sensor, Test) :-
    nonvar(Sensor),
    Sensor = touch(_),
    nonvar(Word),
    touch_test(Word, Test).
condition(Comparison, Sensor, test(Operator, Number)) :-
    compound(Comparison),
    Comparison =.. [Operator, Sensor, Expression],
    memberchk(Operator, [<, =<, >, >=, =:=, =\=]),
    compound(Sensor),
    functor(Sensor, _, 1),
    number_value(Expression, Number).

touch_test(pressed, test(=:=, 1)).
touch_test(released, test(=:=, 0)).
touch_test(bumped, bumped).

port(Sensor, Reading, Port) :-
    Sensor =.. [Reading, Port],
    (   reading_of(Reading, _, _, _)
    ->  must_be(text, Port)
    ;   findall(Known, reading_of(Known, _, _, _), Names0),
        sort(Names0, Names),
        throw_error(domain_error(sensor_reading, Reading), _,
                    one_of(Reading, Names))
    ).

ended(reached, _).
ended(timeout, _) :-
    fail.
ended(unplugged, Port) :-
    existence_error(sensor, Port).
