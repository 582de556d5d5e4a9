:- module(ev3dev_plnxt,
          [ nxt_open/0,
            nxt_close/0,
            nxt_robot/2,                % +Alias, :Goal
            nxt_goal/2,                 % +Alias, :Goal
            nxt_goal/3,                 % +Alias, :Goal, ?Options
            nxt_threads/0,
            nxt_go/1,                   % +Speed
            nxt_go_cm/2,                % +Speed, +Distance
            nxt_go_sec/2,               % +Speed, +Seconds
            nxt_turn/2,                 % +Speed, +Angle
            nxt_rotate/2,               % +Speed, +Angle
            nxt_stop/0,
            nxt_light/1,                % -Percent
            nxt_ultrasonic/1,           % -Centimeters
            nxt_ultrasonic/2,           % -Centimeters, +Force
            nxt_sound/1,                % -Percent
            nxt_touch/1,                % -Pressed
            nxt_touch/2,                % -Pressed, +Force
            nxt_light_LED/1,            % +Action
            nxt_light_LED/2,            % +Action, +Force
            nxt_play_tone/2,            % +Hertz, +Milliseconds
            trigger_create/3,           % ?Id, :Condition, :Action
            trigger_create/4,           % ?Id, :Condition, :Action, +Count
            trigger_kill/1,             % ?Id
            trigger_killall/0,
            timer_create/3,             % ?Id, +Seconds, :Action
            timer_create/4,             % ?Id, +Seconds, :Action, +Count
            timer_kill/1,               % ?Id
            timer_killall/0
          ]).
:- set_prolog_flag(generate_debug_info, false).
:- use_module(private/load/compiled, []).
:- use_module(private/checks/checks, [must_be/2]).
:- use_module(private/errors/errors,
              [domain_error/2, existence_error/2, instantiation_error/1]).
:- use_module(private/errors/frames, [goal_of_program/1]).
:- use_module(private/errors/public_clauses, [term_expansion/4]).
:- use_module(private/checks/arguments, [number_value/2, number_value/3]).
:- use_module(private/run/brick, [brick/1, of_brick/1]).
:- use_module(private/basics/small_lists, [append_lists/3, one_of/2]).
:- use_module(private/devices/robot_state, [robot/4]).
:- use_module(private/devices/sensor_type, [sensor_of/3, sensor_to_read/3]).
:- use_module(drive, [arc_cm/4, go_cm/3, turn/3]).
:- use_module(events,
              [event/2, event_cancel/1, every/3, on/3]).
:- use_module(motors, [stop_all_motors/0]).
:- reexport(nxt_sensors, [nxt_light/2, nxt_sound/2]).
:- use_module(robot, [go/1, set_robot/5, stop/0]).
:- use_module(sensors, [sensor_reading/3]).
:- use_module(sound, [tone/3]).
:- use_module(time, [wait/1]).

:- meta_predicate
    nxt_robot(+, 0),
    nxt_goal(+, 0),
    nxt_goal(+, 0, ?),
    trigger_create(?, :, :),
    trigger_create(?, :, :, +),
    timer_create(?, +, :),
    timer_create(?, +, :, +).
:- module_transparent nxt_open/0.

/** <module> The words of PLNXT

PLNXT of Grzegorz J. Nalepa's group controlled an NXT from Prolog on a PC.
With this library a program of that time drives an EV3, or the simulated
robot:

```
?- nxt_open.
?- trigger_create(_, ( nxt_ultrasonic(D, force), D < 25 ), nxt_stop).
?- nxt_go(400), wait(20).
?- nxt_close.
```

A program that begins with `:- consult('plnxt.pl').` finds the file of that
name in `examples/`, if it is put beside the program.

No source of PLNXT is public. docs/reactive.md says which of its words are
proven by programs and reports of its students, and which are guessed.

Triggers are events of library(ev3dev/events) here. They happen in the thread
that has created them, while it waits or reads a sensor, so they need no
threads, cannot block the console, and do not make threads without end if a
trigger's action creates triggers. A trigger happens when its condition
becomes true, not again and again while it is. An error in it is printed with
its Id. In programs that load this library `sleep(S)` means wait(S), so that
triggers happen and simulated time passes.

Speeds are in degrees of the wheels per second. Distances are in centimeters,
angles of the robot in degrees. A move that a trigger has stopped succeeds.
One that ends early for another reason, such as a blocked wheel, fails. An
exception stops it.
*/

% ---------------- ROBOT

:- dynamic
    opened/3,                           % Brick, Alias, Ports
    lamp_is_off/1,                      % Brick
    read_last/3.                        % Brick, Kind, Value
:- of_brick([opened/3, lamp_is_off/1, read_last/3]).

%!  nxt_open is semidet.
%
%   Begin. A fact of the program describes the robot:
%
%   ```
%   nxt_robot_definition(nxt, '/dev/rfcomm0', bt, on, 17.5, 11,
%                        'C', 'B', 'A', false, 'S1', 'S2', 'S3', 'S4').
%   ```
%
%   Its last ten arguments are the circumference of the wheels and the length
%   of the axle, in cm; the left, the right and the extra motor; whether the
%   motors drive backward; the ports of the sensors for touch, sound, light
%   and ultrasonic. Without such a fact the robot is that of set_robot/4, or
%   else that of `set_robot(5.6, 10.6, outB, outC)`. Fails if a motor is not
%   connected.
%
%   A sensor that is not at its port is looked for at the others.
%
%   @error domain_error(nxt_motor, Letter)
%   @error domain_error(nxt_sensor, Port)

nxt_open :-
    context_module(Module),
    ev3dev_plnxt:opened_by(Module).

opened_by(Module) :-
    (   definition(Module, Alias, Robot)
    ->  described(Robot, Ports)
    ;   Alias = nxt,
        Ports = [],
        (   robot(_Diameter, _, _, _)
        ->  true
        ;   set_robot(5.6, 10.6, outB, outC, [])
        )
    ),
    brick(Brick),
    retractall(opened(Brick, _, _)),
    retractall(read_last(Brick, _, _)),
    retractall(lamp_is_off(Brick)),
    assertz(opened(Brick, Alias, Ports)).

definition(Module0, Alias, Robot) :-
    one_of([Module0, user], Module),
    one_of([14, 13], Arity),
    current_predicate(Module:nxt_robot_definition/Arity),
    functor(Head, nxt_robot_definition, Arity),
    call(Module:Head),
    !,
    Head =.. [_, Alias|Arguments],
    last_ten(Arguments, Robot).

last_ten(Arguments, Last) :-
    length(Last, 10),
    append_lists(_, Last, Arguments),
    !.

described([ Circumference0, Axle, Left0, Right0, _, Reversed,
            Touch0, Sound0, Light0, Ultrasonic0 ], Ports) :-
    number_value(positive_number, Circumference0, Circumference),
    motor_port(Left0, Left),
    motor_port(Right0, Right),
    sensor_port(Touch0, Touch),
    sensor_port(Sound0, Sound),
    sensor_port(Light0, Light),
    sensor_port(Ultrasonic0, Ultrasonic),
    (   Reversed == true
    ->  Options = [inverted([left, right])]
    ;   Options = []
    ),
    Diameter is Circumference / pi,
    set_robot(Diameter, Axle, Left, Right, Options),
    Ports = [ touch-Touch, sound-Sound, light-Light, ultrasonic-Ultrasonic ].

motor_port(Letter, Port) :-
    must_be(nonvar, Letter),
    (   one_of(['A'-outA, 'B'-outB, 'C'-outC, 'D'-outD], Letter-Port)
    ->  true
    ;   domain_error(nxt_motor, Letter)
    ).

sensor_port(Name, Port) :-
    must_be(nonvar, Name),
    (   one_of(['S1'-in1, 'S2'-in2, 'S3'-in3, 'S4'-in4], Name-Port)
    ->  true
    ;   domain_error(nxt_sensor, Name)
    ).

%!  nxt_close is det.
%
%   Stop all motors, and end all triggers and timers of this thread.

nxt_close :-
    trigger_killall,
    timer_killall,
    stop_all_motors,
    brick(Brick),
    retractall(opened(Brick, _, _)).

%!  nxt_robot(+Alias, :Goal) is semidet.
%!  nxt_goal(+Alias, :Goal) is semidet.
%!  nxt_goal(+Alias, :Goal, ?Options) is semidet.
%
%   Call Goal once for the robot Alias, which is that of
%   nxt_robot_definition, or `nxt`. There is one robot. Options are ignored.
%   Their meaning is guessed.
%
%   @error existence_error(nxt_robot, Alias)

nxt_robot(Alias, Goal) :-
    must_be_robot(Alias),
    goal_of_program(Goal),
    !.

nxt_goal(Alias, Goal) :-
    nxt_robot(Alias, Goal).

nxt_goal(Alias, Goal, _) :-
    nxt_robot(Alias, Goal).

must_be_robot(Alias) :-
    must_be(nonvar, Alias),
    (   brick(Brick),
        opened(Brick, Alias, _)
    ->  true
    ;   existence_error(nxt_robot, Alias)
    ).

%!  nxt_threads is det.
%
%   Print which triggers and timers there are, in this thread. Guessed.

nxt_threads :-
    findall(Id, ( event(Id, _), plnxt_event(Id) ), Ids),
    print_message(information, ev3dev(plnxt_events(Ids))).

plnxt_event(nxt_trigger(_)).
plnxt_event(nxt_timer(_)).

:- multifile prolog:message//1.

prolog:message(ev3dev(plnxt_events(Ids))) -->
    [ 'Triggers and timers: ~p'-[Ids] ].

% ---------------- MOVES

%!  nxt_go(+Speed) is semidet.
%!  nxt_stop is semidet.
%
%   Go straight on until stopped; backward if Speed is negative. Stop. They do
%   not wait.

nxt_go(Speed) :-
    degrees_per_second(Speed, S),
    go(S).

nxt_stop :-
    stop.

degrees_per_second(Speed0, dps(Speed)) :-
    number_value(Speed0, Speed).

%!  nxt_go_cm(+Speed, +Distance) is semidet.
%!  nxt_go_sec(+Speed, +Seconds) is semidet.
%
%   Go straight on for Distance cm, or for a time. They wait, and the robot
%   stands at the end. Backward if Speed or Distance is negative.

nxt_go_cm(Speed, Distance) :-
    degrees_per_second(Speed, S),
    go_cm(S, Distance, [reason(Reason)]),
    moved(Reason).

%   A trigger may have stopped it.
moved(Reason) :-
    one_of([reached, stopped], Reason),
    !.

nxt_go_sec(Speed, Seconds0) :-
    degrees_per_second(Speed, S),
    number_value(seconds, Seconds0, Seconds),
    setup_call_cleanup(go(S), wait(Seconds), ignore(stop)).

%!  nxt_turn(+Speed, +Angle) is semidet.
%!  nxt_rotate(+Speed, +Angle) is semidet.
%
%   Turn by Angle degrees, to the right if it is positive: nxt_turn/2 around
%   the inner wheel, which stands, nxt_rotate/2 on the spot. They wait.

nxt_turn(Speed, Angle0) :-
    degrees_per_second(Speed, S),
    number_value(Angle0, Angle),
    robot(_, Axle, _, _),
    (   Angle >= 0
    ->  Radius is Axle / 2
    ;   Radius is -Axle / 2
    ),
    Degrees is abs(Angle),
    arc_cm(S, Radius, Degrees, [reason(Reason)]),
    moved(Reason).

nxt_rotate(Speed, Angle) :-
    degrees_per_second(Speed, S),
    turn(S, Angle, [reason(Reason)]),
    moved(Reason).

% ---------------- SENSORS, SOUNDS

%!  nxt_light(-Percent) is semidet.
%!  nxt_ultrasonic(-Centimeters) is semidet.
%!  nxt_ultrasonic(-Centimeters, +Force) is semidet.
%!  nxt_sound(-Percent) is semidet.
%!  nxt_touch(-Pressed) is semidet.
%!  nxt_touch(-Pressed, +Force) is semidet.
%
%   True if the sensor of that kind measures this value. Force is `force`.
%   Without it, the value is that which was read last, in any thread; the
%   first time it is read. The sensors may be those of the EV3 or of the NXT;
%   for sound the EV3 has none. Fails if no such sensor is connected.
%
%   `nxt_light(Percent, force)` and `nxt_sound(Percent, force)` do the same.
%   These two are those of library(ev3dev), which read the sensor at a port if
%   their second argument is not `force`: `nxt_light(in3, Percent)`.
%
%   @error domain_error(nxt_force, Force)

nxt_light(Percent) :-
    last_value(light, Percent).

nxt_ultrasonic(Centimeters) :-
    last_value(ultrasonic, Centimeters).

nxt_ultrasonic(Centimeters, Force) :-
    must_be_force(Force),
    new_value(ultrasonic, Centimeters).

nxt_sound(Percent) :-
    last_value(sound, Percent).

nxt_touch(Pressed) :-
    last_value(touch, Pressed).

nxt_touch(Pressed, Force) :-
    must_be_force(Force),
    new_value(touch, Pressed).

:- multifile ev3dev_nxt_sensors:forced/2.

ev3dev_nxt_sensors:forced(Kind, Value) :-
    ev3dev_plnxt:new_value(Kind, Value).

must_be_force(Force) :-
    must_be(nonvar, Force),
    (   Force == force
    ->  true
    ;   domain_error(nxt_force, Force)
    ).

last_value(Kind, Value) :-
    (   brick(Brick),
        read_last(Brick, Kind, Value0)
    ->  Value = Value0
    ;   new_value(Kind, Value)
    ).

new_value(Kind, Value) :-
    types(Kind, Types),
    brick(Brick),
    (   opened(Brick, _, Ports),
        one_of(Ports, Kind-Port),
        sensor_of(Port, Types, Type)
    ->  true
    ;   sensor_to_read(Port, Types, Type)
    ->  true
    ),
    reading_now(Type, Port, Value0),
    !,
    retractall(read_last(Brick, Kind, _)),
    assertz(read_last(Brick, Kind, Value0)),
    Value = Value0.

types(touch,      ['lego-ev3-touch', 'lego-nxt-touch']).
types(ultrasonic, ['lego-ev3-us', 'lego-nxt-us']).
types(light,      ['lego-nxt-light', 'lego-ev3-color']).
types(sound,      ['lego-nxt-sound']).

reading_now('lego-nxt-sound', Port, Value) :-
    nxt_sound(Port, Value).
reading_now(Type, Port, Value) :-
    reading_of(Type, On, Off),
    (   brick(Brick),
        lamp_is_off(Brick)
    ->  Reading = Off
    ;   Reading = On
    ),
    sensor_reading(Reading, Port, Value).

%   With the lamp on, and off.
reading_of('lego-nxt-light', nxt_light,   nxt_ambient).
reading_of('lego-ev3-color', col_reflect, col_ambient).
reading_of('lego-ev3-touch', touch,       touch).
reading_of('lego-nxt-touch', touch,       touch).
reading_of('lego-ev3-us',    us_dist_cm,  us_dist_cm).
reading_of('lego-nxt-us',    us_dist_cm,  us_dist_cm).

%!  nxt_light_LED(+Action) is semidet.
%!  nxt_light_LED(+Action, +Force) is semidet.
%
%   Switch the lamp of the light sensor: Action is `activate` or `deactivate`.
%   With the lamp on, as at first, nxt_light/1,2 measures how much of its
%   light comes back; with the lamp off, the light around the robot. Fails if
%   there is no such sensor.
%
%   @error domain_error(nxt_lamp, Action)
%   @error domain_error(nxt_force, Force)

nxt_light_LED(Action) :-
    switch_lamp(Action).

nxt_light_LED(Action, Force) :-
    must_be_force(Force),
    switch_lamp(Action).

switch_lamp(Action) :-
    must_be(nonvar, Action),
    brick(Brick),
    (   Action == activate
    ->  retractall(lamp_is_off(Brick))
    ;   Action == deactivate
    ->  retractall(lamp_is_off(Brick)),
        assertz(lamp_is_off(Brick))
    ;   domain_error(nxt_lamp, Action)
    ),
    new_value(light, _).

%!  nxt_play_tone(+Hertz, +Milliseconds) is semidet.
%
%   Play a tone. Does not wait.

nxt_play_tone(Hertz, Milliseconds) :-
    tone(Hertz, Milliseconds, [wait(false)]).

% ---------------- TRIGGERS, TIMERS

%!  trigger_create(?Id, :Condition, :Action) is det.
%!  trigger_create(?Id, :Condition, :Action, +Count) is det.
%
%   Call Action when Condition becomes true: once, or Count times, or, if
%   Count is `inf`, each time. Condition and Action are goals, or lists of
%   goals. Does not wait. Condition is looked at every 20 ms while this thread
%   waits or reads sensors; its variables reach Action. An unbound Id is bound
%   to a new one. A trigger with the same Id is replaced.
%
%   @error permission_error(wait, guard, nxt_trigger(Id)) if Condition waits

trigger_create(Id, Condition, Action) :-
    trigger_create(Id, Condition, Action, 1).

trigger_create(Id, Condition0, Action0, Count) :-
    goal_of(Condition0, Condition),
    goal_of(Action0, Action),
    named(Id, Id1),
    on(Condition, Action, [id(nxt_trigger(Id1)), count(Count)]),
    Id = Id1.

%!  trigger_kill(?Id) is det.
%!  trigger_killall is det.
%
%   End a trigger of this thread, or all. Succeeds also if there is none.

trigger_kill(Id) :-
    end_events(nxt_trigger(Id)).

trigger_killall :-
    end_events(nxt_trigger(_)).

%!  timer_create(?Id, +Seconds, :Action) is det.
%!  timer_create(?Id, +Seconds, :Action, +Count) is det.
%
%   Call Action, a goal or a list of goals, after Seconds: once, or Count
%   times, each time that Seconds have passed, or, if Count is `inf`, without
%   end. Does not wait. Guessed.
%
%   @error domain_error(seconds, Seconds)

timer_create(Id, Seconds, Action) :-
    timer_create(Id, Seconds, Action, 1).

timer_create(Id, Seconds0, Action0, Count) :-
    number_value(seconds, Seconds0, Seconds),
    goal_of(Action0, Action),
    named(Id, Id1),
    every(Seconds, Action, [id(nxt_timer(Id1)), count(Count)]),
    Id = Id1.

%!  timer_kill(?Id) is det.
%!  timer_killall is det.
%
%   End a timer of this thread, or all. Succeeds also if there is none.
%   Guessed.

timer_kill(Id) :-
    end_events(nxt_timer(Id)).

timer_killall :-
    end_events(nxt_timer(_)).

end_events(Id) :-
    forall(event(Id, _), ignore(event_cancel(Id))).

named(Id, Named) :-
    (   var(Id)
    ->  flag(ev3dev_plnxt, Named, Named + 1)
    ;   must_be(ground, Id),
        Named = Id
    ).

goal_of(Module:Term, Module:Goal) :-
    (   is_list(Term)
    ->  conjunction(Term, Goal0)
    ;   Goal0 = Term
    ),
    must_be(callable, Goal0),
    waiting(Goal0, Goal).

conjunction([], true).
conjunction([Goal|Goals], Conjunction) :-
    (   Goals == []
    ->  Conjunction = Goal
    ;   Conjunction = (Goal, Conjunction1),
        conjunction(Goals, Conjunction1)
    ).

waiting(Goal, Waiting) :-
    (   nonvar(Goal),
        Goal = (A, B)
    ->  Waiting = (A1, B1),
        waiting(A, A1),
        waiting(B, B1)
    ;   nonvar(Goal),
        Goal = sleep(Seconds)
    ->  Waiting = ev3dev_time:wait(Seconds)
    ;   Waiting = Goal
    ).

:- multifile user:goal_expansion/2.
:- dynamic user:goal_expansion/2.

user:goal_expansion(sleep(Seconds), ev3dev_time:wait(Seconds)) :-
    prolog_load_context(module, Module),
    predicate_property(Module:nxt_open, imported_from(ev3dev_plnxt)).
