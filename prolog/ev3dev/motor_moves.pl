:- module(ev3dev_motor_moves,
          [ motor_run_timed/3,          % +Port, +Speed, +Seconds
            motor_run_timed/4,          % +Port, +Speed, +Seconds, +Options
            motor_run_to/3,             % +Port, +Speed, +Angle
            motor_run_to/4,             % +Port, +Speed, +Angle, +Options
            motor_run_direct/2          % +Port, +Percent
          ]).
:- use_module(library(debug), [debug/3]).
:- use_module(library(error), [must_be/2]).
:- use_module(library(lists), [append/3]).
:- use_module(driver, [tacho_motor/1]).
:- use_module(motors, [motors_turn/2]).
:- use_module(on_demand, [on_demand_loaded/0]).

/** <module> More ways to run a motor

For a time, to a position, and without regulation. What library(ev3dev/motors)
says of speeds, angles, failure, and the end of the program holds here, too.
*/

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
    Percent is Speed,
    Seconds is Seconds0,
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
    Percent is Speed,
    Degrees is Angle,
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
    Percent is Percent0,
    (   motor_run_direct_('tacho-motor', Port, Percent)
    ->  true
    ;   tacho_motor(Port)
    ->  debug(ev3dev, "~w cannot run at ~w % of the voltage",
              [Port, Percent]),
        fail
    ;   debug(ev3dev, "there is no motor at ~w", [Port]),
        fail
    ).

:- on_demand_loaded.
