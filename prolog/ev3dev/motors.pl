:- module(ev3dev_motors,
          [ motor_run/2,                % +Port, +Speed
            motor_run/3,                % +Port, +Speed, +Angle
            motor_run/4,                % +Port, +Speed, +Angle, +Options
            motors_run/1,               % +Runs
            motors_turn/2,              % +Moves, +Options
            motor_start/1,              % +Port
            motor_stop/1,               % +Port
            motor_stop/2,               % +Port, +StopAction
            stop_all_motors/0,
            motor_reset/1,              % +Port
            run_forever/2,              % +Port, +CountsPerSecond
            speed_adjust/3,             % +Percent, ?Port, -CountsPerSecond
            motor_wait_while/2,         % +Port, +Flag
            motor_wait_until/2,         % +Port, +Flag
            motor_wait/3,               % +Ports, +Options, -Reason
            motor_run_timed/3,          % +Port, +Speed, +Seconds
            motor_run_timed/4,          % +Port, +Speed, +Seconds, +Options
            motor_run_to/3,             % +Port, +Speed, +Angle
            motor_run_to/4,             % +Port, +Speed, +Angle, +Options
            motor_run_direct/2          % +Port, +Percent
          ]).
:- use_module(library(debug), [debug/3]).
:- use_module(private/errors,
              [ domain_error/2, evaluated/2, must_be/2, term_expansion/2
              ]).
:- use_module(driver,
              [ command/2, max_speed/2, motor_attribute/3, tacho_motor/1 ]).
:- use_module(private/halt, []).
:- use_module(private/arguments,
              [ motor_moves/2, motor_options/5, motor_runs/2,
                must_be_options/3, must_be_timeout/1
              ]).
:- use_module(private/native,
              [ motor_reset_/1, motor_run_/2, motor_run_direct_/3,
                motor_stop_/3, motor_turn_/3, motor_wait_/3,
                motor_wait_flag_/3, motors_run_/1, run_forever_/2,
                stop_all_motors_/0
              ]).

/** <module> Motors

Speeds are in percent of the motor's highest speed, angles in degrees of its
shaft, both any arithmetic expression. Where there is an angle, its sign and
that of the speed together make the direction. Of a linear actuator what is
called an angle here is a length, in millimetres.

What can be set is in library(ev3dev/motor_settings), motors without rotation
sensor are in library(ev3dev/dc_motors), and RC servos in
library(ev3dev/servo_motors).

Every motor that the program has started is stopped when Prolog halts, or is
ended by SIGINT, SIGTERM or SIGHUP, unless the flag `ev3dev_stop_at_halt` is
`false`.

All predicates fail if there is no motor at a port, and if a move is
impossible: a speed beyond 100 percent, or a speed of 0 for a move by an
angle. Nothing moves then. `debug(ev3dev)` tells why.
*/

%!  motor_run(+Port, +Speed) is semidet.
%
%   Run a motor at Speed percent until it is stopped. Does not wait.
%
%   @error type_error(evaluable, Speed)

motor_run(Port, Speed) :-
    (   number(Speed)
    ->  Percent = Speed
    ;   evaluated(Speed, Percent)
    ),
    (   motor_run_(Port, Percent)
    ->  true
    ;   why_not([run(Port, Percent)])
    ).

%!  motors_run(+Runs) is semidet.
%
%   Run several motors, each `run(Port, Speed)`, until they are stopped. They
%   start at the same moment, or not at all. Does not wait.
%
%   @error domain_error(distinct_ports, Port) if a port is named twice
%   @error domain_error(motor_run, Run) if one of Runs is none
%   @error type_error(evaluable, Speed)

motors_run(Runs0) :-
    motor_runs(Runs0, Runs),
    (   motors_run_(Runs)
    ->  true
    ;   why_not(Runs)
    ).

%!  motor_run(+Port, +Speed, +Angle) is semidet.
%!  motor_run(+Port, +Speed, +Angle, +Options) is semidet.
%
%   Turn a motor by Angle degrees at Speed percent, and wait until it is
%   there. A motor that does not get there, because it is blocked or somebody
%   else stops it, is stopped and makes the call fail. Options:
%
%     - stop_action(+Action)
%       What the motor does at the end: `hold` its position (default), `brake`
%       or `coast`; with these two it overshoots.
%     - wait(+Boolean)
%       If `false`, return as soon as it runs. See motor_wait/3.
%     - timeout(+Seconds)
%       Stop the motor and fail if it takes longer.
%     - ramp_up(+Milliseconds)
%     - ramp_down(+Milliseconds)
%       Speed up and slow down evenly; the time is that between rest and the
%       highest speed, from 0 to 60000. For this move only.
%
%   A call that is left by an exception, as that of call_with_time_limit/2 or
%   Ctrl-C, stops the motor first.
%
%   @error existence_error(motor, Port) if the motor is unplugged under way
%   @error domain_error(stop_action, Action)
%   @error domain_error(ramp_up_sp, Milliseconds)
%   @error domain_error(motor_option, Option) for an option that is none

motor_run(Port, Speed, Angle) :-
    motor_run(Port, Speed, Angle, []).

motor_run(Port, Speed, Angle, Options) :-
    evaluated(Speed, Percent),
    evaluated(Angle, Degrees),
    motors_turn([move(Port, Percent, Degrees)], Options).

%!  motors_turn(+Moves, +Options) is semidet.
%
%   Turn several motors and wait until all are there. They start at the same
%   moment, or not at all. Options, failure and errors are those of
%   motor_run/4. Each of Moves is one of
%
%     - move(Port, Speed, Angle)
%       As motor_run/4.
%     - to(Port, Speed, Angle)
%       As motor_run_to/4.
%     - for(Port, Speed, Seconds)
%       As motor_run_timed/4.
%
%   @error domain_error(distinct_ports, Port) if a port is named twice
%   @error domain_error(motor_move, Move) if it is none of these

motors_turn(Moves0, Options) :-
    must_be(list, Moves0),
    motor_options(Options, hold, [coast, brake, hold], 60000, Native),
    motor_moves(Moves0, Moves),
    (   motor_turn_(Moves, Native, Reason)
    ->  turn_ended(Reason, Moves)
    ;   why_not(Moves)
    ).

turn_ended(reached, _) :-
    !.
turn_ended(stalled, Moves) :-
    !,
    findall(Port, ( member(Move, Moves), arg(1, Move, Port) ), Ports),
    print_message(warning, ev3dev(stalled(Ports))),
    fail.
turn_ended(Reason, Moves) :-
    debug(ev3dev, "~p ended early: ~w", [Moves, Reason]),
    fail.

%!  why_not(+Runs) is failure.
%
%   Tell why motors could not be started, if that is being debugged: those
%   that are missing, or else what they were to do.

why_not(Runs) :-
    debugging(ev3dev),
    findall(Port,
            ( member(Run, Runs), arg(1, Run, Port), \+ tacho_motor(Port) ),
            Missing),
    (   member(Port, Missing),
        debug(ev3dev, "there is no motor at ~w", [Port])
    ;   Missing == [],
        member(Run, Runs),
        arg(1, Run, Port),
        arg(2, Run, Percent),
        max_speed(Port, Max),
        debug(ev3dev, "~w cannot run at ~w % of its ~w counts/s as ~p asks",
              [Port, Percent, Max, Run])
    ),
    fail.

%!  motor_start(+Port) is semidet.
%
%   Run a motor at the speed that was written to speed_sp/2 until it is
%   stopped. Does not wait.

motor_start(Port) :-
    command(Port, 'run-forever').

%!  motor_stop(+Port) is semidet.
%!  motor_stop(+Port, +StopAction) is semidet.
%
%   Stop a motor: let it `coast`, `brake` it (default), or `hold` its
%   position. Does not wait until it stands.
%
%   @error domain_error(stop_action, StopAction)

motor_stop(Port) :-
    motor_stop(Port, brake).

motor_stop(Port, StopAction) :-
    (   motor_stop_('tacho-motor', Port, StopAction)
    ->  true
    ;   why_not([run(Port, 0)])
    ).

%!  stop_all_motors is det.
%
%   Stop every motor that is connected, with or without rotation sensor,
%   whoever started it, with `brake`. Servos keep their positions.

stop_all_motors :-
    stop_all_motors_.

%!  motor_reset(+Port) is semidet.
%
%   Stop a motor and put all it was told back to what it is after plugging in:
%   position 0, speed 0, no ramps, normal polarity.

motor_reset(Port) :-
    motor_reset_(Port).

%!  run_forever(+Port, +CountsPerSecond) is semidet.
%
%   Run a motor at a speed in tacho counts a second until it is stopped. Does
%   not wait.

run_forever(Port, Speed) :-
    evaluated(round(Speed), CountsPerSecond),
    (   abs(CountsPerSecond) < 2 ** 31,
        run_forever_(Port, CountsPerSecond)
    ->  true
    ;   debug(ev3dev, "~w cannot run at ~w counts/s",
              [Port, CountsPerSecond]),
        fail
    ).

%!  speed_adjust(+Percent, ?Port, -CountsPerSecond) is nondet.
%
%   True if Percent of the highest speed of the motor at Port is that many
%   tacho counts a second, rounded down.

speed_adjust(Percent, Port, CountsPerSecond) :-
    max_speed(Port, MaxSpeed),
    evaluated(floor(Percent / 100.0 * MaxSpeed), CountsPerSecond).

%!  motor_wait_while(+Port, +Flag) is semidet.
%!  motor_wait_until(+Port, +Flag) is semidet.
%
%   Wait while, or until, Flag is among the motor's states: `running`,
%   `ramping`, `holding`, `overloaded` or `stalled`. Uses no processor time
%   worth mentioning. Signals are handled within 20 ms.
%
%   @error existence_error(motor, Port) if the motor is unplugged meanwhile
%   @error domain_error(motor_state, Flag)

motor_wait_while(Port, Flag) :-
    must_be_flag(Flag),
    motor_wait_flag_(Port, Flag, false).

motor_wait_until(Port, Flag) :-
    must_be_flag(Flag),
    motor_wait_flag_(Port, Flag, true).

must_be_flag(Flag) :-
    must_be(atom, Flag),
    (   flag(Flag)
    ->  true
    ;   domain_error(motor_state, Flag)
    ).

flag(running).
flag(ramping).
flag(holding).
flag(overloaded).
flag(stalled).

%!  motor_wait(+Ports, +Options, -Reason) is semidet.
%
%   Wait until a motor, or each of a list of motors, no longer runs. Stops
%   nothing. Reason tells why the wait ended:
%
%     - reached
%       The motors are where they were to go.
%     - stalled
%       A motor is blocked; it is still pushing.
%     - timeout
%       The time is up.
%     - unplugged
%       A motor is no longer connected.
%     - stopped
%       A motor was stopped before it got there.
%
%   Options:
%
%     - timeout(+Seconds)
%       Wait for so long at most. Default is to wait for ever.

motor_wait(Ports, Options, Reason) :-
    must_be_options(motor_option, [timeout], Options),
    option(timeout(Timeout), Options, infinite),
    must_be_timeout(Timeout),
    (   is_list(Ports)
    ->  motor_wait_(Ports, Timeout, Reason)
    ;   motor_wait_([Ports], Timeout, Reason)
    ).

:- multifile prolog:message//1.

prolog:message(ev3dev(stalled(Ports))) -->
    { atomic_list_concat(Ports, ', ', Text) },
    [ 'Motor blocked, stopped: ~w'-[Text] ].

%!  motor_run_timed(+Port, +Speed, +Seconds) is semidet.
%!  motor_run_timed(+Port, +Speed, +Seconds, +Options) is semidet.
%
%   Run a motor at Speed percent for so many Seconds, and wait until they are
%   over. Seconds may be an arithmetic expression. Options are those of
%   motor_run/4, but that `stop_action` is `brake` by default. Slowing down
%   with a `ramp_down` comes on top of the time.
%
%   @error domain_error(seconds, Seconds) if they are negative
%   @error existence_error(motor, Port) if the motor is unplugged under way

motor_run_timed(Port, Speed, Seconds) :-
    motor_run_timed(Port, Speed, Seconds, []).

motor_run_timed(Port, Speed, Seconds0, Options0) :-
    evaluated(Speed, Percent),
    evaluated(Seconds0, Seconds),
    must_be(list, Options0),
    append(Options0, [stop_action(brake)], Options),
    motors_turn([for(Port, Percent, Seconds)], Options).

%!  motor_run_to(+Port, +Speed, +Angle) is semidet.
%!  motor_run_to(+Port, +Speed, +Angle, +Options) is semidet.
%
%   Turn a motor to Angle degrees at Speed percent, and wait until it is
%   there. Angle is that of motor_position/2: 0 is where the motor was when it
%   was plugged in or reset, or where the program says. The sign of Speed does
%   not matter. Options, failure and errors are those of motor_run/4.

motor_run_to(Port, Speed, Angle) :-
    motor_run_to(Port, Speed, Angle, []).

motor_run_to(Port, Speed, Angle, Options) :-
    evaluated(Speed, Percent),
    evaluated(Angle, Degrees),
    motors_turn([to(Port, Percent, Degrees)], Options).

%!  motor_run_direct(+Port, +Percent) is semidet.
%
%   Give a motor that much of the battery's voltage, from -100 to 100, until
%   it is stopped: nothing keeps its speed when it has to push. Does not wait.
%   When the motor runs so already, it gets that much from now on.
%
%   @error domain_error(command, 'run-direct') if the motor cannot run so, as
%          those of some other boards

motor_run_direct(Port, Percent0) :-
    evaluated(Percent0, Percent),
    (   motor_run_direct_('tacho-motor', Port, Percent)
    ->  true
    ;   tacho_motor(Port)
    ->  debug(ev3dev, "~w cannot run at ~w % of the voltage",
              [Port, Percent]),
        fail
    ;   debug(ev3dev, "there is no motor at ~w", [Port]),
        fail
    ).
