:- module(ev3dev_hints,
          [ fail_because/1,             % +Cause
            advise/1,                   % +Cause
            warn_once/1,                % +Message
            tell_again/0,
            explain/2                   % +Format, +Arguments
          ]).
:- use_module('../run/brick', [is_simulated/0]).
:- use_module('../errors/errors', [throw_error/3]).
:- use_module('../errors/frames', [called_by_program/2]).
:- use_module('../native/native',
              [ attribute_/4, device_/3, led_/3, motor_gear_/2,
                sim_detecting_/1, sysfs_/1
              ]).
:- use_module('../basics/small_lists').

:- initialization(
       create_prolog_flag(ev3dev_hints, once, [keep(true), type(atom)]),
       now).

/** <module> Why a call fails

A call that fails because a device is missing, or because a move is
impossible, gives its cause to fail_because/1. The foreign library does so,
too. The flag `ev3dev_hints` says what follows:

  - once
    A warning, the first time that a predicate fails for this cause; at the
    prompt, the first time in each query.
  - off
    Nothing.
  - error
    An error with the same text.

`debug(ev3dev)` prints each cause each time, also if the flag is `off`.

library(debug) is not loaded for it: that takes a brick as long as the pack
itself. A program that asks for messages has loaded it.
*/

:- multifile reading_types/2.           % Reading, Types

:- dynamic told/1.                      % Key
:- volatile told/1.

%!  fail_because(+Cause) is failure.
%
%   Fail, and explain why. Cause is one of
%
%     - absent(Kind, Port)
%       There is no such device at Port; if Port is unbound, at no port. Kind
%       is a class of devices, `light`, `reading(Reading)`, `mode(Mode)` or a
%       list of types of sensors.
%     - cannot(Runs)
%       A motor is not there, or one of Runs is impossible: terms with port,
%       percent and perhaps a way.
%     - cannot_move(Left, Right, Percent, Course)
%       The same of a robot with the motors Left and Right.
%     - too_fast(Port, Percent)
%     - unable(Who, Verb, What)
%       A device, or the robot, cannot do this.
%     - unlike(Left, Right)
%       The motors of a robot have different types, or are the same.
%     - no_number(Reading, Value)
%       A sensor gives a number, and the program compares it with Value.
%     - nothing_at(Port)
%       Nothing is plugged in there.
%     - nothing_came(Port, What)
%       No device appeared after a port was set.
%     - lacking(What)
%       The brick has no `buttons`, `screen`, `speaker` or `battery`.
%     - no_robot
%     - no_grid
%     - no_localizer
%     - no_map
%     - no_reading(Reading)
%     - no_simulation

fail_because(Cause0) :-
    current_prolog_flag(ev3dev_hints, Hints),
    (   Hints == error
    ->  cause(Cause0, Cause),
        because(Cause, Formal, Text),
        throw_error(Formal, _, Text)
    ;   told(Hints, Cause0)
    ),
    fail.

%!  advise(+Cause) is det.
%
%   Explain what a call that succeeds, or fails for another reason, may have
%   been meant for. It is printed as by fail_because/1, but is not an error.
%   Cause is one of those, or one of
%
%     - not_cm(Wheel, Axle)
%       The lengths of a robot are such as nobody has in cm.
%     - not_milliseconds(Predicate, Time)
%     - not_seconds(Predicate, Time)
%       A time so short, or so long, that it has another unit.
%     - interrupted(Who)
%       A move ended early, as another command came.

advise(Cause) :-
    current_prolog_flag(ev3dev_hints, Hints),
    (   told(Hints, Cause)
    ->  true
    ;   true
    ).

%!  warn_once(+Message) is det.
%
%   Print a warning that is no hint, as often as one: a loop goes on after it.

warn_once(Message) :-
    (   is_new(Message)
    ->  print_message(warning, Message)
    ;   true
    ).

told(Hints, Cause0) :-
    (   is_explained
    ->  cause(Cause0, Cause),
        because(Cause, _, Text),
        prolog_debug:debug(ev3dev, '~w', [Text])
    ;   Hints \== off,
        Hints \== false,               % how 10.1 keeps an `off` of before
        cause(Cause0, Cause),
        is_new(Cause)
    ->  because(Cause, _, Text),
        print_message(warning, ev3dev(hint(Text)))
    ).

:- multifile prolog:message//1.

prolog:message(ev3dev(hint(Text))) -->
    [ '~w'-[Text] ].

%   A cause is not reported again. There are at most 100 causes, so that a
%   program that runs for days does not fill the memory.

is_new(Cause) :-
    (   called_by_program(_, Called)
    ->  true
    ;   Called = none
    ),
    key(Cause, Key0),
    Key = Called-Key0,
    \+ told(Key),
    with_mutex(ev3dev_hints, \+ \+ note(Key)).

note(Key) :-
    \+ told(Key),
    predicate_property(told(_), number_of_clauses(Count)),
    Count < 100,
    assertz(told(Key)).

key(too_fast(Who, _), Key) :-
    !,
    Key = too_fast(Who).
key(unable(Who, Verb, _), Key) :-
    !,
    Key = unable(Who, Verb).
key(Cause, Key) :-
    ground(Cause),
    !,
    Key = Cause.
key(Cause, Key) :-
    copy_term(Cause, Key),
    numbervars(Key, 0, _).

%!  tell_again is det.
%
%   A query of the toplevel or of a page begins, or a simulation, or another
%   tree is used: anything is reported again.

tell_again :-
    retractall(told(_)).

:- multifile user:expand_query/4.
:- dynamic user:expand_query/4.
:- initialization(
       asserta((user:expand_query(_Query, _, _, _) :-
                    ev3dev_hints:tell_again,
                    fail)),
       now).

%!  explain(+Format, +Arguments) is det.
%
%   Print what happened, as format/2, if the topic `ev3dev` is being debugged.

explain(Format, Arguments) :-
    (   is_explained
    ->  prolog_debug:debug(ev3dev, Format, Arguments)
    ;   true
    ).

is_explained :-
    current_module(prolog_debug),
    prolog_debug:debugging(ev3dev).

%   debug/1 says that nobody uses a topic that no loaded file names for
%   library(debug).

:- multifile user:message_hook/3.
:- dynamic user:message_hook/3.

user:message_hook(debug_no_topic(ev3dev), warning, _).

% ---------------- CAUSES

%   Cause names the motor that is to blame.

cause(cannot(Runs), Cause) :-
    !,
    (   one_of(Runs, Run),
        arg(1, Run, Port),
        \+ device_('tacho-motor', Port, _)
    ->  Cause = absent('tacho-motor', Port)
    ;   (   one_of(Runs, Run),
            is_to_blame(Run)
        ->  true
        ;   Runs = [Run|_]
        ),
        arg(1, Run, Port),
        percent(Run, Percent),
        impossible(Port, Percent, Run, Cause)
    ).
cause(cannot_move(Left, Right, Percent, Course), Cause) :-
    !,
    (   one_of([Left, Right], Port),
        \+ device_('tacho-motor', Port, _)
    ->  Cause = absent('tacho-motor', Port)
    ;   impossible('the robot', Percent, Course, Cause)
    ).
cause(unlike(Left, Right), Cause) :-
    one_of([Left, Right], Port),
    \+ device_('tacho-motor', Port, _),
    !,
    Cause = absent('tacho-motor', Port).
cause(Cause, Cause).

%   A speed in degrees a second is a percentage of what the motor can, too.

percent(Run, Percent) :-
    Run =.. [_, Port, Speed|_],
    (   Speed = dps(Degrees)
    ->  attribute_('tacho-motor', Port, max_speed, Max),
        attribute_('tacho-motor', Port, count_per_rot, Counts),
        motor_gear_(Port, Gear),
        Percent is round(Degrees * Gear * Counts / 3.6 / Max)
    ;   Percent = Speed
    ).

is_to_blame(Run) :-
    percent(Run, Percent),
    (   abs(Percent) > 100
    ->  true
    ;   Run =.. [_, _, _, Way],
        (   Percent =:= 0
        ->  true
        ;   abs(Way) > 1.0e9           % a motor counts to 2^31
        )
    ).

impossible(Who, Percent, What, Cause) :-
    (   abs(Percent) > 100
    ->  Cause = too_fast(Who, Percent)
    ;   Percent =:= 0
    ->  Cause = unable(Who, move, 'at a speed of 0')
    ;   act(What, Verb, Words)
    ->  Cause = unable(Who, Verb, Words)
    ;   Cause = unable(Who, do, What)
    ).

%   A command to a motor or the robot, in words.

act(move(_, Percent, Angle), Verb, Words) :-
    !,
    turn(by, Angle, Percent, Verb, Words).
act(to(_, Percent, Angle), Verb, Words) :-
    !,
    turn(to, Angle, Percent, Verb, Words).
act(for(_, Percent, Seconds), run, Words) :-
    !,
    format(atom(Words), 'for ~w s at ~w %', [Seconds, Percent]).
act(cruise(Speed, Turn), go, Words) :-
    !,
    format(atom(Words), 'at ~w cm/s and turn by ~w degrees/s', [Speed, Turn]).
act(legs(_, _), make, 'a move that is so long or so slow').

turn(Way, Angle, Percent, turn, Words) :-
    format(atom(Words), '~w ~w degrees at ~w %', [Way, Angle, Percent]).

%   because(+Cause, -Formal, -Text): the term of the error, and the words.

because(absent(Kind, Port), existence_error(Class, Name), Text) :-
    wanted(Kind, Class),
    ( var(Port) -> Name = any ; Name = Port ),
    words(Kind, Words),
    missing(Kind, Words, Port, Missing),
    there_are(Class, Devices),
    listed(Class, Devices, Listed),
    suggested(Class, Port, Devices, Suggestion),
    atomic_list_concat([Missing, '; ', Listed, Suggestion], Text).
because(too_fast(Who, Percent), domain_error(speed, Percent), Text) :-
    (   abs(Percent) < 1.0e9,
        abs(Percent) >= 101
    ->  Tenths is round(Percent*10),
        (   Tenths mod 10 =:= 0
        ->  Shown is Tenths//10
        ;   Shown is Tenths/10.0
        )
    ;   Shown = Percent
    ),
    format(atom(Text), '~w cannot run at ~w %: its highest speed is 100 %',
           [Who, Shown]).
because(unable(Who, Verb, What), domain_error(possible_act, What), Text) :-
    format(atom(Text), '~w cannot ~w ~w', [Who, Verb, What]).
because(unlike(Left, Right), domain_error(robot, Left-Right), Text) :-
    device_('tacho-motor', Left, LeftType),
    device_('tacho-motor', Right, RightType),
    (   LeftType == RightType
    ->  format(atom(Text),
               '~w is one motor, and a robot needs two: left and right',
               [Left])
    ;   format(atom(Text),
               '~w (~w) and ~w (~w) are motors of different types: use two \c
                of the same',
               [Left, LeftType, Right, RightType])
    ),
    !.
because(no_number(Reading, Value), type_error(number, Value), Text) :-
    instead(Reading, Value, Instead),
    format(atom(Text), '~w/2 gives a number, not ~q~w',
           [Reading, Value, Instead]).
because(nothing_at(Port), existence_error(device, Port), Text) :-
    format(atom(Text), 'nothing is plugged into ~w', [Port]).
because(not_cm(Wheel, Axle), domain_error(robot, Wheel-Axle), Text) :-
    (   Wheel > Axle,
        Wheel < 20,
        Wheel >= 1
    ->  format(atom(Text),
               'the wheels, ~w cm, are larger than the axle, ~w cm: \c
                write set_robot(WheelDiameter, AxleLength, Left, Right)',
               [Wheel, Axle])
    ;   format(atom(Text),
               'these are wheels of ~w cm and an axle of ~w cm: set_robot/4 \c
                expects cm, such as 5.6 and 10.6', [Wheel, Axle])
    ).
because(not_milliseconds(Predicate, Time), domain_error(milliseconds, Time),
        Text) :-
    format(atom(Text),
           'that is ~w ms: ~q expects milliseconds, 500 for half a second',
           [Time, Predicate]).
because(not_seconds(Predicate, Time), domain_error(seconds, Time), Text) :-
    Minutes is round(Time / 60),
    format(atom(Text), 'that takes ~d minutes: ~q expects seconds',
           [Minutes, Predicate]).
because(interrupted(Who), permission_error(move, robot, Who), Text) :-
    format(atom(Text),
           '~w did not arrive: another command or a stop came first',
           [Who]).
because(nothing_came(Port, What), existence_error(device, Port), Text) :-
    format(atom(Text), 'nothing came of ~w at ~w', [What, Port]).
because(lacking(What), existence_error(What, brick), Text) :-
    format(atom(Text), 'there is no ~w; ev3_dev/1 says where it should be',
           [What]).
because(no_robot, existence_error(robot, any),
        'no robot is set: see set_robot/4').
because(no_localizer, existence_error(localizer, any),
        'the robot does not localize: see localize_start/1').
because(no_map, existence_error(map, any),
        'there is no map: see map_start/0').
because(no_grid, existence_error(grid, any),
        'there is no grid: see set_grid/1').
because(no_reading(Reading), existence_error(reading, Reading), Text) :-
    format(atom(Text), 'no sensor has a reading ~w', [Reading]).
because(no_simulation, existence_error(simulation, any),
        'no simulation runs: see sim_start/1').

%   What the program may mean by a Value that is not a number.

instead(Reading, Value, Instead) :-
    (   memberchk(Reading, [col_color, ht_color]),
        text(Value, Name),
        nth_color(Name, Number)
    ->  format(atom(Instead), ': ~w is ~d', [Name, Number])
    ;   Reading == touch
    ->  Instead = ': 1 while it is pressed, else 0'
    ;   compound(Value),
        functor(Value, Operator, 2),
        memberchk(Operator, [<, >, =<, >=, =:=, =\=])
    ->  format(atom(Instead),
               '. Compare it after the call: ~w(Port, X), X ~w 20',
               [Reading, Operator])
    ;   text(Value, Port),
        one_of([motor, sensor], Class),
        there_is(Class, Port, _)
    ->  Instead = ': the port is the first argument'
    ;   Instead = ''
    ).

text(Value, Atom) :-
    (   atom(Value)
    ->  Atom = Value
    ;   string(Value),
        atom_string(Atom, Value)
    ).

nth_color(Name, Number) :-
    arg(Place, color(none, black, blue, green, yellow, red, white, brown),
        Name),
    !,
    Number is Place - 1.

% ---------------- ABSENT DEVICES

class_of('tacho-motor', motor).
class_of('dc-motor', motor).
class_of('servo-motor', motor).
class_of('lego-sensor', sensor).
class_of('lego-port', port).

wanted(light, light) :- !.
wanted(Kind, Class) :-
    class_of(Kind, Class),
    !.
wanted(_, sensor).

words('tacho-motor', 'motor').
words('dc-motor', 'motor without rotation sensor').
words('servo-motor', 'servo').
words('lego-sensor', 'sensor').
words('lego-port', 'port').
words(light, 'light').
words(mode(Mode), Words) :-
    atom_concat('sensor with the mode ', Mode, Words).
words(reading(Reading), Words) :-
    findall(Type,
            ( reading_types(Reading, Types), one_of(Types, Type) ),
            All),
    words(All, Words).
words([Type|Types], Words) :-
    (   sensor(Type, Words)
    ->  true
    ;   atomic_list_concat([Type|Types], ' or ', Words)
    ).

sensor('lego-ev3-color', 'color sensor').
sensor('lego-ev3-us', 'ultrasonic sensor').
sensor('lego-ev3-gyro', 'gyro').
sensor('lego-ev3-touch', 'touch sensor').
sensor('lego-ev3-ir', 'infrared sensor').
sensor('nxt-analog', 'analog sensor').

missing(_, Words, Port, Missing) :-
    var(Port),
    !,
    format(atom(Missing), 'no ~w is connected', [Words]).
missing(Kind, Words, Port, Missing) :-
    memberchk(Kind, [light, 'lego-port']),
    !,
    format(atom(Missing), 'there is no ~w ~w', [Words, Port]).
missing(_, Words, Port, Missing) :-
    one_of([motor, sensor], Class),
    there_is(Class, Port, Type),
    !,
    yet(Port, Yet),
    format(atom(Missing), '~w has ~w, no ~w~w', [Port, Type, Words, Yet]).
missing(_, Words, Port, Missing) :-
    yet(Port, Yet),
    format(atom(Missing), 'there is no ~w at ~w~w', [Words, Port, Yet]).

%   The brick takes a while to find out what was plugged in: a sensor 1.3 s.

yet(Port, Yet) :-
    (   device_('lego-port', Port, _),
        is_detecting(Port)
    ->  Yet = ' yet (what was just plugged in takes up to 2 s)'
    ;   Yet = ''
    ).

is_detecting(Port) :-
    is_simulated,
    !,
    sim_detecting_(Port).
is_detecting(Port) :-
    attribute_('lego-port', Port, status, Status),
    \+ memberchk(Status, ['no-motor', 'no-sensor']),
    \+ ( one_of([motor, sensor], Class), there_is(Class, Port, _) ).

%   What there is in place of it: of the same class, else of any.

there_are(Class, Devices) :-
    findall(Class-Port-Type, there_is(Class, Port, Type), Same),
    (   Same == []
    ->  findall(Other-Port-Type,
                ( one_of([motor, sensor], Other),
                  there_is(Other, Port, Type) ),
                Devices)
    ;   Devices = Same
    ).

there_is(light, Light, light) :-
    led_(Light, name, _).
there_is(Class, Port, Type) :-
    class_of(Kind, Class),
    device_(Kind, Port, Type).

listed(_, [], Listed) :-
    !,
    sysfs_(Directory),
    format(atom(Listed), 'nothing is connected in ~w', [Directory]).
listed(Class, Devices, Listed) :-
    findall(Text,
            ( one_of(Devices, _-Port-Type),
              (   memberchk(Class, [light, port])
              ->  Text = Port
              ;   format(atom(Text), '~w (~w)', [Port, Type])
              ) ),
            Texts),
    atomic_list_concat(Texts, ', ', All),
    atom_concat('there are: ', All, Listed).

%   A name that differs in the case of letters, or whose last letter it is, as
%   `b`, or `motor_b`, or the only one that differs by a letter. A port of the
%   brick was meant as it is written.

suggested(Class, Port, Devices, Suggestion) :-
    nonvar(Port),
    \+ device_('lego-port', Port, _),
    findall(Name, one_of(Devices, Class-Name-_), Names),
    \+ memberchk(Port, Names),
    meant(Port, Names, Meant),
    !,
    format(atom(Suggestion), '. Did you mean ~w?', [Meant]).
suggested(_, _, _, '').

meant(Port, Names, Name) :-
    downcase_atom(Port, Low),
    (   one_of(Names, Name),
        downcase_atom(Name, LowName),
        (   LowName == Low
        ;   is_end(Low, LowName)
        )
    ->  true
    ;   findall(Near,
                ( one_of(Names, Near), dwim_match(Low, Near) ),
                [Name])
    ).

is_end(Text, Name) :-
    sub_atom(Name, _, 1, 0, End),
    (   Text == End
    ->  true
    ;   one_of([motor, port, s, sensor, m], Start),
        one_of(['', '_', ' '], Gap),
        atomic_list_concat([Start, Gap, End], Text)
    ).
