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
            motor_run_direct/2,         % +Port, +Percent
            motor_run_until_stalled/2,  % +Port, +Speed
            motor_run_until_stalled/3   % +Port, +Speed, +Options
          ]).
:- set_prolog_flag(generate_debug_info, false).
:- use_module(private/checks/checks, [evaluated/2, must_be/2]).
:- use_module(private/errors/errors, [domain_error/2, existence_error/2]).
:- use_module(private/errors/public_clauses, [term_expansion/4]).
:- use_module(private/explain/hints).
:- use_module(driver,
              [ command/2, max_speed/2, motor_attribute/3 ]).
:- use_module(private/run/halt, []).
:- use_module(private/run/watchdog, []).
:- use_module(private/checks/arguments,
              [ must_be_options/3, number_option/4, option/2, option/3,
                speed_value/2, timeout_option/2, word/2 ]).
:- use_module(private/checks/motor_arguments,
              [motor_moves/2, motor_options/5, motor_runs/2, stop_action/3]).
:- use_module(private/run/waits, [waited/1]).
:- use_module(private/native/native,
              [ motor_reset_/1, motor_run_/2, motor_run_direct_/3,
                motor_stop_/3, motor_turn_/3, motor_wait_/3,
                motor_wait_flag_/4, motors_run_/1, run_forever_/2,
                stop_all_motors_/0
              ]).
:- use_module(private/basics/small_lists).

/** <module> Motors

Speeds are in percent of the motor's highest speed, angles in degrees of its
shaft, or of what a gear of motor_gear/2 drives. Both may be arithmetic
expressions. A speed may also be `dps(N)`, `rps(N)` or `rpm(N)`: degrees or
rotations a second, or rotations a minute. An angle may also be
`rotations(N)`. If a move has an angle, the signs of angle and speed together
give the direction. For a linear actuator an angle is a length in millimeters.

library(ev3dev/motor_settings) has the settings of motors,
library(ev3dev/dc_motors) the motors without rotation sensor, and
library(ev3dev/servo_motors) the RC servos.

When Prolog halts, or SIGINT, SIGTERM or SIGHUP ends it, the pack stops every
motor that the program started, unless the flag `ev3dev_stop_at_halt` is
`false`, and none starts from then on. After such a signal Prolog has two
seconds to end, then the process is ended. A crash stops motors, too, and so
does Ctrl-Z. After SIGKILL another process does, which the first motor starts:
not if the flag `ev3dev_stop_at_kill` was `false` then.

The motors of a thread stop when it has computed for as many seconds as the
flag `ev3dev_watchdog` says (3.0; 0 is never), and has not used the robot or
waited meanwhile.

To end a thread that waits here, throw into it with thread_signal/2. Do not
signal thread_exit/1: no cleanup runs then, and the motors run on.

All predicates fail if there is no motor at a port, or if a move is
impossible: a speed beyond 100 percent, or a speed of 0 for a move by an
angle. Nothing moves then, and a warning says why: see the
flag `ev3dev_hints` of library(ev3dev). A move by an angle of 0 is done at
once.
*/

%!  motor_run(+Port, +Speed) is semidet.
%
%   Run a motor at Speed percent until it is stopped. Does not wait.
%
%   @error type_error(evaluable, Speed)

motor_run(Port, Speed) :-
    (   number(Speed)
    ->  Value = Speed
    ;   speed_value(Speed, Value)
    ),
    (   motor_run_(Port, Value)
    ->  true
    ;   fail_because(cannot([run(Port, Value)]))
    ).

%!  motors_run(+Runs) is semidet.
%
%   Run several motors, each `run(Port, Speed)`, until they are stopped. They
%   start at the same moment, or not at all. Does not wait.
%
%   @error domain_error(distinct_ports, Port) if a port is named twice
%   @error domain_error(motor_run, Run) if an element is no `run(Port, Speed)`
%   @error type_error(evaluable, Speed)

motors_run(Runs0) :-
    motor_runs(Runs0, Runs),
    (   motors_run_(Runs)
    ->  true
    ;   fail_because(cannot(Runs))
    ).

%!  motor_run(+Port, +Speed, +Angle) is semidet.
%!  motor_run(+Port, +Speed, +Angle, +Options) is semidet.
%
%   Turn a motor by Angle degrees at Speed percent, and wait until it arrives.
%   Stops the motor and fails if it does not arrive, because it is blocked or
%   somebody else stops it. Options:
%
%     - stop_action(+Action)
%       The motor's action at the end: `hold` its position (default), `brake`
%       or `coast`; with these two it overshoots.
%     - wait(+Boolean)
%       If `false`, return as soon as the motor runs. See motor_wait/3.
%     - timeout(+Seconds)
%       Stop the motor and fail if the move takes longer.
%     - ramp_up(+Milliseconds)
%     - ramp_down(+Milliseconds)
%       Speed up and slow down evenly. Milliseconds is the time between rest
%       and the highest speed, from 0 to 60000. For this move only.
%
%   If an exception ends the call, for example call_with_time_limit/2 or
%   Ctrl-C, the motor is stopped first.
%
%   @error existence_error(motor, Port) if the motor is unplugged during the
%          move
%   @error domain_error(stop_action, Action)
%   @error domain_error(ramp_up_sp, Milliseconds)
%   @error domain_error(motor_option, Option) if Option is not an option of
%          this predicate

motor_run(Port, Speed, Angle) :-
    motor_run(Port, Speed, Angle, []).

motor_run(Port, Speed, Angle, Options) :-
    motors_turn([move(Port, Speed, Angle)], Options).

%!  motors_turn(+Moves, +Options) is semidet.
%
%   Turn several motors and wait until all arrive. They start at the same
%   moment, or not at all. Options, failure and errors are those of
%   motor_run/4. Each of Moves is one of
%
%     - move(Port, Speed, Angle)
%       Like motor_run/4.
%     - to(Port, Speed, Angle)
%       Like motor_run_to/4.
%     - for(Port, Speed, Seconds)
%       Like motor_run_timed/4.
%
%   @error domain_error(distinct_ports, Port) if a port is named twice
%   @error domain_error(motor_move, Move) if Move is not one of these

motors_turn(Moves0, Options) :-
    must_be(list, Moves0),
    motor_options(Options, hold, [coast, brake, hold], 60000, Native),
    motor_moves(Moves0, Moves),
    (   motor_turn_(Moves, Native, Reason),
        waited(Reason)
    ->  turn_ended(Reason, Moves)
    ;   fail_because(cannot(Moves))
    ).

turn_ended(reached, _) :-
    !.
turn_ended(stalled, Moves) :-
    !,
    findall(Port, ( one_of(Moves, Move), arg(1, Move, Port) ), Ports),
    warn_once(ev3dev(stalled(Ports))),
    fail.
turn_ended(Reason, Moves) :-
    explain("~p ended early: ~w", [Moves, Reason]),
    (   Reason == stopped
    ->  findall(Port, ( one_of(Moves, Move), arg(1, Move, Port) ), Ports),
        atomic_list_concat(Ports, ', ', Listed),
        advise(interrupted(Listed))
    ;   true
    ),
    fail.

%!  motor_start(+Port) is semidet.
%
%   Run a motor at the speed of speed_sp/2 until it is stopped. Does not wait.

motor_start(Port) :-
    command(Port, 'run-forever').

%!  motor_stop(+Port) is semidet.
%!  motor_stop(+Port, +StopAction) is semidet.
%
%   Stop a motor: let it `coast`, `brake` it (default), or `hold` its
%   position. Does not wait until the motor rests.
%
%   @error domain_error(stop_action, StopAction)

motor_stop(Port) :-
    motor_stop(Port, brake).

motor_stop(Port, StopAction) :-
    motor_stop_('tacho-motor', Port, StopAction).

%!  stop_all_motors is det.
%
%   Stop all connected motors, with or without rotation sensor, by `brake`,
%   also motors that another program started. Servos keep their positions.
%   Waits up to a second for a motor that was just plugged in, with all others
%   stopped.
%
%   @error resource_error(max_files) if this process cannot open any more
%          files; those motors that it has used are stopped then

stop_all_motors :-
    stop_all_motors_.

%!  motor_reset(+Port) is semidet.
%
%   Stop a motor and put its settings back to the values after plugging in:
%   position 0, speed 0, no ramps, normal polarity.

motor_reset(Port) :-
    motor_reset_(Port).

%!  run_forever(+Port, +CountsPerSecond) is semidet.
%
%   Run a motor at CountsPerSecond tacho counts per second until it is
%   stopped. Does not wait.

run_forever(Port, Speed) :-
    evaluated(round(Speed), CountsPerSecond),
    (   abs(CountsPerSecond) < 2 ** 31,
        run_forever_(Port, CountsPerSecond)
    ->  true
    ;   max_speed(Port, _),
        fail_because(unable(Port, 'run at a speed_sp of', CountsPerSecond))
    ).

%!  speed_adjust(+Percent, ?Port, -CountsPerSecond) is nondet.
%
%   True if Percent of the highest speed of the motor at Port is
%   CountsPerSecond tacho counts per second, rounded down.

speed_adjust(Percent, Port, CountsPerSecond) :-
    max_speed(Port, MaxSpeed),
    evaluated(floor(Percent / 100.0 * MaxSpeed), CountsPerSecond).

%!  motor_wait_while(+Port, +Flag) is semidet.
%!  motor_wait_until(+Port, +Flag) is semidet.
%
%   Wait while, or until, Flag is among the motor's states: `running`,
%   `ramping`, `holding`, `overloaded` or `stalled`. The wait uses hardly any
%   processor time. Prolog handles signals within 20 ms.
%
%   @error existence_error(motor, Port) if the motor is unplugged during the
%          wait
%   @error domain_error(motor_state, Flag)

motor_wait_while(Port, Flag0) :-
    motor_flag(Flag0, Flag),
    motor_wait_flag_(Port, Flag, false, Reason),
    waited(Reason),
    !.

motor_wait_until(Port, Flag0) :-
    motor_flag(Flag0, Flag),
    motor_wait_flag_(Port, Flag, true, Reason),
    waited(Reason),
    !.

motor_flag(Flag0, Flag) :-
    word(Flag0, Flag),
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
%   nothing. Reason says why the wait ended:
%
%     - reached
%       The motors arrived at their targets.
%     - stalled
%       A motor is blocked; it is still pushing.
%     - timeout
%       The time is up.
%     - unplugged
%       A motor is no longer connected.
%     - stopped
%       Somebody stopped a motor before it arrived.
%
%   Options:
%
%     - timeout(+Seconds)
%       Wait at most Seconds. Default is `infinite`.

motor_wait(Ports, Options, Reason) :-
    must_be_options(motor_option, [timeout], Options),
    timeout_option(Options, Timeout),
    (   is_list(Ports)
    ->  All = Ports
    ;   All = [Ports]
    ),
    (   motor_wait_(All, Timeout, Ended),
        waited(Ended)
    ->  Reason = Ended
    ;   findall(run(Port, 0), one_of(All, Port), Runs),
        fail_because(cannot(Runs))
    ).

:- multifile prolog:message//1.

prolog:message(ev3dev(stalled(Ports))) -->
    { atomic_list_concat(Ports, ', ', Text) },
    [ 'Motor blocked and stopped: ~w'-[Text] ].

%!  motor_run_timed(+Port, +Speed, +Seconds) is semidet.
%!  motor_run_timed(+Port, +Speed, +Seconds, +Options) is semidet.
%
%   Run a motor at Speed percent for Seconds, and wait until the time is over.
%   Seconds may be an arithmetic expression. Options are those of motor_run/4,
%   but the default `stop_action` is `brake`. With `ramp_down` the motor slows
%   down after Seconds, so the call takes longer.
%
%   @error domain_error(seconds, Seconds) if Seconds is negative
%   @error existence_error(motor, Port) if the motor is unplugged during the
%          run

motor_run_timed(Port, Speed, Seconds) :-
    motor_run_timed(Port, Speed, Seconds, []).

motor_run_timed(Port, Speed, Seconds0, Options0) :-
    speed_value(Speed, Value),
    evaluated(Seconds0, Seconds),
    must_be(list, Options0),
    (   option(stop_action(_), Options0)
    ->  Options = Options0
    ;   Options = [stop_action(brake)|Options0]
    ),
    (   Seconds >= 500
    ->  advise(not_seconds(motor_run_timed/3, Seconds))
    ;   true
    ),
    motors_turn([for(Port, Value, Seconds)], Options).

%!  motor_run_to(+Port, +Speed, +Angle) is semidet.
%!  motor_run_to(+Port, +Speed, +Angle, +Options) is semidet.
%
%   Turn a motor to Angle degrees at Speed percent, and wait until it arrives.
%   Angle is a position as in motor_position/2: 0 is the position of the motor
%   when it was plugged in or reset, unless the program sets another. The sign
%   of Speed does not matter. Options, failure and errors are those of
%   motor_run/4.

motor_run_to(Port, Speed, Angle) :-
    motor_run_to(Port, Speed, Angle, []).

motor_run_to(Port, Speed, Angle, Options) :-
    motors_turn([to(Port, Speed, Angle)], Options).

%!  motor_run_direct(+Port, +Percent) is semidet.
%
%   Give a motor Percent of the battery's voltage, from -100 to 100, until it
%   is stopped. Nothing regulates the speed: under load the motor slows down.
%   Does not wait. If the motor runs in this way already, its percentage
%   changes.
%
%   @error domain_error(command, 'run-direct') if the motor does not have this
%          command, as motors on some other boards

motor_run_direct(Port, Percent0) :-
    evaluated(Percent0, Percent),
    (   motor_run_direct_('tacho-motor', Port, Percent)
    ->  true
    ;   fail_because(cannot([run(Port, Percent)]))
    ).

%!  motor_run_until_stalled(+Port, +Speed) is semidet.
%!  motor_run_until_stalled(+Port, +Speed, +Options) is semidet.
%
%   Run a motor at Speed percent until something blocks it, as an arm against
%   its end stop, and stop it there. Waits. Fails, and stops the motor, if
%   somebody else stops it; fails if Speed is 0. Options:
%
%     - duty_limit(+Percent)
%       Push with so much of the battery's voltage, above 0 to 100, as
%       motor_run_direct/2 does: nothing regulates the speed, and the sign of
%       Speed is the direction. Without it the motor pushes harder and harder.
%     - stop_action(+Action)
%       `brake` (default), `hold` or `coast`.
%     - timeout(+Seconds)
%       Stop the motor and fail if nothing blocks it so long. A BrickPi3 never
%       reports that a motor is blocked.
%
%   If an exception ends the call, the motor is stopped first.
%
%   @error domain_error(duty_limit, Percent)
%   @error domain_error(stop_action, Action)
%   @error existence_error(motor, Port) if the motor is unplugged meanwhile

motor_run_until_stalled(Port, Speed) :-
    motor_run_until_stalled(Port, Speed, []).

motor_run_until_stalled(Port, Speed, Options) :-
    must_be_options(motor_option, [duty_limit, stop_action, timeout],
                    Options),
    speed_value(Speed, Value),
    option(stop_action(Action0), Options, brake),
    stop_action([coast, brake, hold], Action0, Action),
    timeout_option(Options, Timeout),
    number_option(duty_limit(Limit), duty_limit, Options, 100),
    word(Port, _),
    setup_call_cleanup(
        push(Options, Port, Value, Limit),
        motor_wait(Port, [timeout(Timeout)], Reason),
        pushed(Reason, Port, Action)),
    (   Reason == stalled
    ->  true
    ;   Reason == unplugged
    ->  existence_error(motor, Port)
    ;   explain("~w was not blocked: ~w", [Port, Reason]),
        fail
    ).

push(Options, Port, Value, Limit) :-
    (   Value = dps(Number)
    ->  true
    ;   Number = Value
    ),
    (   Number =:= 0
    ->  fail_because(cannot([run(Port, Value)]))
    ;   option(duty_limit(_), Options)
    ->  motor_run_direct(Port, sign(Number) * Limit)
    ;   motor_run(Port, Value)
    ).

pushed(Reason, Port, Action) :-
    (   Reason == unplugged
    ->  true
    ;   motor_stop(Port, Action)
    ).
