:- module(ev3dev_servo_motors,
          [ servo_motor_position/2,     % ?Port, ?Percent
            servo_motor_angle/2,        % ?Port, ?Degrees
            servo_motor_float/1,        % +Port
            servo_motor_polarity/2,     % ?Port, ?Polarity
            servo_motor_rate/2,         % ?Port, ?Milliseconds
            servo_motor_pulses/4,       % ?Port, ?Min, ?Mid, ?Max
            servo_motor_attribute/3     % ?Port, +Attribute, ?Value
          ]).
:- set_prolog_flag(generate_debug_info, false).
:- use_module(private/checks/checks, [evaluated/2]).
:- use_module(private/errors/public_clauses, [term_expansion/4]).
:- use_module(private/explain/hints).
:- use_module(driver, [servo_motor/1]).
:- use_module(private/run/halt, []).
:- use_module(private/run/watchdog, []).
:- use_module(private/devices/attributes,
              [attribute/4, class_polarity/3, class_settings/3]).
:- use_module(private/native/native,
              [ servo_motor_float_/1, servo_position_/2, servo_set_position_/2
              ]).

/** <module> RC servos

Servos of model aircraft and the like, on a controller that is plugged into
an input port, for example the 8-channel controller by mindsensors. Their
ports have the controller's name in them: `'in1:i2c88:sv1'` to `sv8`.

A servo holds its position until the program lets it float. It does not report
when it arrives. A predicate reads an unbound value and writes a bound one.
All predicates fail if there is no servo at a port.

When the program ends, the pack lets every servo float that the program moved.
*/

%!  servo_motor_position(?Port, ?Percent) is nondet.
%
%   Send a servo to a position from -100 to 100 percent of its range, where 0
%   is the middle, or read the position that it was sent to. Percent may be an
%   arithmetic expression and is rounded. Does not wait. Fails, and moves
%   nothing, if Percent is beyond 100; reading fails while the servo floats.

servo_motor_position(Port, Percent) :-
    var(Percent),
    !,
    servo_position_(Port, Percent).
servo_motor_position(Port, Percent0) :-
    evaluated(Percent0, Percent),
    (   servo_set_position_(Port, Percent)
    ->  true
    ;   cannot(Port, Percent)
    ).

%!  servo_motor_angle(?Port, ?Degrees) is nondet.
%
%   Like servo_motor_position/2, in degrees from the middle, -90 to 90. The
%   pack assumes that the servo turns by 180 degrees between the shortest and
%   the longest pulse. For another servo, set with servo_motor_pulses/4 the
%   pulses that it needs for -90, 0 and 90 degrees.

servo_motor_angle(Port, Degrees) :-
    var(Degrees),
    !,
    servo_position_(Port, Percent),
    Degrees is Percent * 0.9.
servo_motor_angle(Port, Degrees0) :-
    evaluated(Degrees0, Degrees),
    (   abs(Degrees) =< 90
    ->  servo_motor_position(Port, Degrees / 0.9)
    ;   cannot(Port, Degrees)
    ).

cannot(Port, Position) :-
    (   servo_motor(Port)
    ->  fail_because(unable(Port, 'go to', Position))
    ;   fail_because(absent('servo-motor', Port))
    ).

%!  servo_motor_float(+Port) is semidet.
%
%   Let a servo float: a hand can turn it.

servo_motor_float(Port) :-
    servo_motor_float_(Port).

%!  servo_motor_polarity(?Port, ?Polarity) is nondet.
%
%   Read or write a servo's polarity: `normal`, or `inversed` to turn the
%   other way. A servo that does not float goes to the opposite at once.
%
%   @error domain_error(polarity, Polarity)

servo_motor_polarity(Port, Polarity) :-
    class_polarity('servo-motor', Port, Polarity).

%!  servo_motor_rate(?Port, ?Milliseconds) is nondet.
%
%   Read or write how slowly a servo moves: the Milliseconds that it takes for
%   100 percent. 0 means as fast as the servo can. The controller may round
%   the number.
%
%   @error domain_error(rate_sp, Milliseconds) if Milliseconds is negative
%   @error permission_error(write, unsupported_attribute, File) if the
%          controller has one speed only

servo_motor_rate(Port, Milliseconds) :-
    class_settings('servo-motor', Port,
                   [setting(rate_sp, 0, 2147483647, Milliseconds)]).

%!  servo_motor_pulses(?Port, ?Min, ?Mid, ?Max) is nondet.
%
%   Read or write the lengths of the pulses, in microseconds, that send a
%   servo to -100, 0 and 100 percent: 0 to 1000, 1000 to 2000 and 2000 to
%   3000. They take effect when a position is written.
%
%   @error domain_error(min_pulse_sp, Min)
%   @error domain_error(mid_pulse_sp, Mid)
%   @error domain_error(max_pulse_sp, Max)

servo_motor_pulses(Port, Min, Mid, Max) :-
    class_settings('servo-motor', Port,
                   [ setting(min_pulse_sp, 0, 1000, Min),
                     setting(mid_pulse_sp, 1000, 2000, Mid),
                     setting(max_pulse_sp, 2000, 3000, Max)
                   ]).

%!  servo_motor_attribute(?Port, +Attribute, ?Value) is nondet.
%
%   Read or write any attribute of a servo, like motor_attribute/3.

servo_motor_attribute(Port, Attribute, Value) :-
    attribute('servo-motor', Port, Attribute, Value).
