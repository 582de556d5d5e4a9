:- module(ev3dev_dc_motors,
          [ dc_motor_run/2,             % +Port, +Percent
            dc_motor_run_timed/3,       % +Port, +Percent, +Seconds
            dc_motor_run_timed/4,       % +Port, +Percent, +Seconds, +Options
            dc_motor_run_direct/2,      % +Port, +Percent
            dc_motor_stop/1,            % +Port
            dc_motor_stop/2,            % +Port, +StopAction
            dc_motor_duty/2,            % ?Port, -Percent
            dc_motor_states/2,          % ?Port, -States
            dc_motor_polarity/2,        % ?Port, ?Polarity
            dc_motor_ramps/3,           % ?Port, ?Up, ?Down
            dc_motor_attribute/3        % ?Port, +Attribute, ?Value
          ]).
:- set_prolog_flag(generate_debug_info, false).
:- use_module(private/checks/checks, [evaluated/2]).
:- use_module(private/errors/errors, [domain_error/2]).
:- use_module(private/errors/public_clauses, [term_expansion/4]).
:- use_module(private/explain/hints).
:- use_module(driver, [dc_motor/1]).
:- use_module(private/run/halt, []).
:- use_module(private/run/watchdog, []).
:- use_module(motors, []).
:- use_module(private/checks/arguments, [word/2]).
:- use_module(private/checks/motor_arguments, [motor_options/5]).
:- use_module(private/devices/attributes,
              [ attribute/4, attribute_words/4, class_polarity/3,
                class_settings/3
              ]).
:- use_module(private/run/waits, [waited/1]).
:- use_module(private/native/native,
              [ attribute_/4, dc_motor_run_/2, dc_motor_run_timed_/5,
                motor_run_direct_/3, motor_stop_/3 ]).

/** <module> Motors without rotation sensor, and lamps

Such a motor gets a part of the battery's voltage, in percent from -100 to
100. Nothing measures its speed. The brick does not recognize such a motor:
set the mode of its port first, for example:

```
?- port_mode(outA, 'dc-motor').
?- dc_motor_run_timed(outA, 60, 2).
```

Percentages and seconds may be arithmetic expressions; percentages are
rounded. All predicates fail if there is no such motor at a port, or if a
percentage is beyond 100; nothing moves then. After a command a motor may take
up to 0.1 s to carry out the next one.

When the program ends, the pack stops every motor that the program started.
*/

%!  dc_motor_run(+Port, +Percent) is semidet.
%
%   Run a motor until it is stopped. Does not wait.

dc_motor_run(Port, Percent0) :-
    evaluated(Percent0, Percent),
    (   dc_motor_run_(Port, Percent)
    ->  true
    ;   cannot(Port, Percent)
    ).

%!  dc_motor_run_timed(+Port, +Percent, +Seconds) is semidet.
%!  dc_motor_run_timed(+Port, +Percent, +Seconds, +Options) is semidet.
%
%   Run a motor for Seconds, at most 60, and wait until the time is over.
%   Fails if somebody else stops the motor before. Options:
%
%     - stop_action(+Action)
%       The motor's action at the end: `brake` (default) or `coast`.
%     - wait(+Boolean)
%       If `false`, return as soon as the motor runs.
%     - timeout(+Seconds)
%       Stop the motor and fail if the call takes longer.
%     - ramp_up(+Milliseconds)
%     - ramp_down(+Milliseconds)
%       Speed up and slow down in steps. Milliseconds is the time from 0 to
%       100 percent, from 0 to 10000. A rising percentage uses `ramp_up`, a
%       falling one `ramp_down`; so a start backward uses `ramp_down`.
%
%   If an exception ends the call, the motor is stopped first.
%
%   @error existence_error(motor, Port) if somebody changes the mode of the
%          port while the motor runs
%   @error domain_error(seconds, Seconds) if Seconds is negative
%   @error domain_error(stop_action, Action)
%   @error domain_error(ramp_up_sp, Milliseconds)
%   @error domain_error(motor_option, Option) if Option is not an option of
%          this predicate

dc_motor_run_timed(Port, Percent, Seconds) :-
    dc_motor_run_timed(Port, Percent, Seconds, []).

dc_motor_run_timed(Port, Percent0, Seconds0, Options) :-
    evaluated(Percent0, Percent),
    evaluated(Seconds0, Seconds),
    motor_options(Options, brake, [coast, brake], 10000, Native),
    (   dc_motor_run_timed_(Port, Percent, Seconds, Native, Reason),
        waited(Reason)
    ->  run_ended(Reason, Port)
    ;   cannot(Port, Percent)
    ).

run_ended(reached, _) :-
    !.
run_ended(Reason, Port) :-
    explain("the run of ~w ended early: ~w", [Port, Reason]),
    fail.

%!  dc_motor_run_direct(+Port, +Percent) is semidet.
%
%   Like dc_motor_run/2. While the motor runs in this way, a value that the
%   program writes to `duty_cycle_sp` takes effect at once.

dc_motor_run_direct(Port, Percent0) :-
    evaluated(Percent0, Percent),
    (   motor_run_direct_('dc-motor', Port, Percent)
    ->  true
    ;   cannot(Port, Percent)
    ).

cannot(Port, Percent) :-
    (   dc_motor(Port)
    ->  fail_because(too_fast(Port, Percent))
    ;   fail_because(absent('dc-motor', Port))
    ).

%!  dc_motor_stop(+Port) is semidet.
%!  dc_motor_stop(+Port, +StopAction) is semidet.
%
%   Stop a motor: `brake` it (default) or let it `coast`.
%
%   @error domain_error(stop_action, StopAction)

dc_motor_stop(Port) :-
    dc_motor_stop(Port, brake).

dc_motor_stop(Port, StopAction0) :-
    word(StopAction0, StopAction),
    (   memberchk(StopAction, [coast, brake])
    ->  motor_stop_('dc-motor', Port, StopAction)
    ;   domain_error(stop_action, StopAction)
    ).

%!  dc_motor_duty(?Port, -Percent) is nondet.
%
%   True if the motor now gets Percent of the battery's voltage.

dc_motor_duty(Port, Percent) :-
    attribute_('dc-motor', Port, duty_cycle, Percent).

%!  dc_motor_states(?Port, -States) is nondet.
%
%   True if States is the list of the motor's flags: `running`, and `ramping`
%   while its next step is due.

dc_motor_states(Port, States) :-
    attribute_words('dc-motor', Port, state, States).

%!  dc_motor_polarity(?Port, ?Polarity) is nondet.
%
%   Read or write a motor's polarity: `normal` or `inversed`. It takes effect
%   at the next command.
%
%   @error domain_error(polarity, Polarity)

dc_motor_polarity(Port, Polarity) :-
    class_polarity('dc-motor', Port, Polarity).

%!  dc_motor_ramps(?Port, ?Up, ?Down) is nondet.
%
%   Read or write the ramps from the next command on: the milliseconds from 0
%   to 100 percent when the percentage rises (Up) or falls (Down), from 0 to
%   10000.
%
%   @error domain_error(ramp_up_sp, Up)
%   @error domain_error(ramp_down_sp, Down)

dc_motor_ramps(Port, Up, Down) :-
    class_settings('dc-motor', Port,
                   [ setting(ramp_up_sp, 0, 10000, Up),
                     setting(ramp_down_sp, 0, 10000, Down)
                   ]).

%!  dc_motor_attribute(?Port, +Attribute, ?Value) is nondet.
%
%   Read or write any attribute of a motor without rotation sensor, like
%   motor_attribute/3.

dc_motor_attribute(Port, Attribute, Value) :-
    attribute('dc-motor', Port, Attribute, Value).
