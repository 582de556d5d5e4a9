:- module(ev3dev_conditions,
          [ comparison/3,               % +Condition, -Sensor, -Test
            sensor_named/3,             % +Sensor, -Reading, -Port
            condition_goal/2            % :Condition, -Goal
          ]).
:- use_module('../checks/arguments', [number_value/2]).
:- use_module('../checks/checks', [must_be/2]).
:- use_module('../errors/errors', [throw_error/3]).
:- use_module('../../sensors', [reading_of/4]).

:- meta_predicate condition_goal(:, -).

/** <module> Conditions about sensors

The same words for sensor_wait/1, until/2, on/2 and rules: a comparison, such
as `us_dist_cm(in1) < 20` or `touch(in4) = pressed`, or a goal, such as
`(us_dist_cm(_, D), D < 20)`.
*/

%!  comparison(+Condition, -Sensor, -Test) is semidet.
%
%   True if Condition compares a reading with a number, or is about a touch
%   sensor. Sensor is Reading(Port); Test is test(Operator, Number) or
%   `bumped`.

comparison(Sensor = Word, Sensor, Test) :-
    nonvar(Sensor),
    Sensor = touch(_),
    nonvar(Word),
    touch_test(Word, Test).
comparison(Comparison, Sensor, test(Operator, Number)) :-
    compared(Comparison, Operator, Sensor, Expression),
    functor(Sensor, _, 1),
    number_value(Expression, Number).

compared(Comparison, Operator, Sensor, Expression) :-
    compound(Comparison),
    compound_name_arity(Comparison, _, 2),
    Comparison =.. [Operator, Sensor, Expression],
    memberchk(Operator, [<, =<, >, >=, =:=, =\=]),
    compound(Sensor).

touch_test(pressed, test(=:=, 1)).
touch_test(released, test(=:=, 0)).
touch_test(bumped, bumped).

%!  sensor_named(+Sensor, -Reading, -Port) is det.
%
%   Sensor is Reading(Port).
%
%   @error domain_error(sensor_reading, Reading)

sensor_named(Sensor, Reading, Port) :-
    Sensor =.. [Reading, Port],
    (   reading_of(Reading, _, _, _)
    ->  must_be(text, Port)
    ;   findall(Known, reading_of(Known, _, _, _), Names0),
        sort(Names0, Names),
        throw_error(domain_error(sensor_reading, Reading), _,
                    one_of(Reading, Names))
    ).

%!  condition_goal(:Condition, -Goal) is det.
%
%   Goal is true if Condition holds. Parts of Condition that compare a sensor
%   are replaced, the others are goals.
%
%   @error domain_error(sensor_condition, Condition) if it compares two
%          dialects at once, such as `us_dist_cm(in1, D) < 20`, or asks for
%          `bumped`, which takes time

condition_goal(Module:Condition, Module:Goal) :-
    goal_of(Condition, Module, Goal).

goal_of(Condition, Module, Goal) :-
    (   var(Condition)
    ->  Goal = Condition
    ;   part(Condition, A0, B0, A, B, Goal)
    ->  goal_of(A0, Module, A),
        goal_of(B0, Module, B)
    ;   Condition = (\+ A0)
    ->  goal_of(A0, Module, A),
        Goal = (\+ A)
    ;   Condition = (Sensor = Word),
        nonvar(Sensor),
        Sensor = touch(Port),
        nonvar(Word)
    ->  (   memberchk(Word-Value, [pressed-1, released-0])
        ->  Goal = ev3dev_sensors:touch(Port, Value)
        ;   throw_error(domain_error(sensor_condition, Condition), _,
                        'here touch(Port) is pressed or released')
        )
    ;   compared(Condition, Operator, Sensor, Number),
        functor(Sensor, Reading, Arity),
        reading_of(Reading, _, _, _)
    ->  (   Arity =:= 1
        ->  arg(1, Sensor, Port),
            compares(Reading, Port, Operator, Number, Module, Goal)
        ;   two_dialects(Condition, Reading, Operator, Number)
        )
    ;   turned(Condition, Turned),
        compared(Turned, Operator, Sensor, Number),
        functor(Sensor, Reading, _),
        reading_of(Reading, _, _, _)
    ->  two_dialects(Condition, Reading, Operator, Number)
    ;   Goal = Condition
    ).

%   With the sensor on the other side

turned(A < B, B > A).
turned(A > B, B < A).
turned(A =< B, B >= A).
turned(A >= B, B =< A).
turned(A =:= B, B =:= A).
turned(A =\= B, B =\= A).

part((A0, B0), A0, B0, A, B, (A, B)).
part((A0 ; B0), A0, B0, A, B, (A ; B)).

two_dialects(Condition, Reading, Operator, Number) :-
    format(atom(Text), '~w(Port) ~w ~p, or ~w(Port, X), X ~w ~p',
           [Reading, Operator, Number, Reading, Operator, Number]),
    atom_concat('a condition is ', Text, Words),
    throw_error(domain_error(sensor_condition, Condition), _, Words).

%   As a program would write it, for library(ev3dev/journal).

compares(Reading, Port, Operator, Number, Module, (Read, Comparison)) :-
    Read0 =.. [Reading, Port, Value],
    (   predicate_property(Module:Read0, visible)
    ->  Read = Read0
    ;   Read = ev3dev_sensors:sensor_reading(Reading, Port, Value)
    ),
    Comparison =.. [Operator, Value, Number].
