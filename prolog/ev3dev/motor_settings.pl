:- module(ev3dev_motor_settings,
          [ linear_actuator/1,          % ?Port
            motor_position/2,           % ?Port, ?Position
            motor_speed/2,              % ?Port, -Speed
            motor_gear/2,               % ?Port, ?Ratio
            motor_duty/2,               % ?Port, -Percent
            motor_polarity/2,           % ?Port, ?Polarity
            motor_ramps/3,              % ?Port, ?Up, ?Down
            motor_speed_pid/2,          % ?Port, ?PID
            motor_hold_pid/2            % ?Port, ?PID
          ]).
:- set_prolog_flag(generate_debug_info, false).
:- use_module(private/checks/checks, [evaluated/2]).
:- use_module(private/errors/errors, [domain_error/2]).
:- use_module(private/errors/public_clauses, [term_expansion/4]).
:- use_module(driver, [motor_attribute/3, tacho_motor/2]).
:- use_module(private/checks/arguments, [must_be_within/4, number_value/3]).
:- use_module(private/devices/attributes,
              [class_polarity/3, class_settings/3, device_at/3]).
:- use_module(private/native/native,
              [ attribute_/4, motor_gear_/2, motor_position_/2,
                motor_set_gear_/2, motor_set_position_/2, motor_speed_/2 ]).
:- use_module(private/basics/small_lists).

/** <module> Settings of motors

As with the attributes of library(ev3dev/driver), a predicate reads an unbound
value and writes a bound one. An unbound port enumerates; writing needs a
bound one. All predicates fail if there is no motor at a port. motor_reset/1
puts all settings but motor_gear/2 back to their values after plugging in.
*/

%!  linear_actuator(?Port) is nondet.
%
%   True if a linear actuator, an L12 by Actuonix, is plugged into Port. It is
%   a motor with positions and distances in millimeters. The brick does not
%   recognize a linear actuator: see port_device/2.

linear_actuator(Port) :-
    tacho_motor(Port, Type),
    linear(Type).

linear('act-l12-ev3-50').
linear('act-l12-ev3-100').

%!  motor_position(?Port, ?Position) is nondet.
%
%   Read a motor's position in degrees, or millimeters of a linear actuator,
%   or give its present position a new number. Writing moves nothing. Position
%   is an integer if the motor counts in degrees, as LEGO's do, else a float.
%   A Position to write may be an arithmetic expression. Fails if Position is
%   beyond the range of the motor's counter.

motor_position(Port, Position) :-
    var(Position),
    !,
    motor_position_(Port, Position).
motor_position(Port, Position0) :-
    evaluated(Position0, Position),
    motor_set_position_(Port, Position).

%!  motor_speed(?Port, -Speed) is nondet.
%
%   True if the motor now turns at Speed degrees a second, or millimeters of a
%   linear actuator: an integer or a float as in motor_position/2.

motor_speed(Port, Speed) :-
    motor_speed_(Port, Speed).

%!  motor_gear(?Port, ?Ratio) is nondet.
%
%   Read or set the gear between a motor and what it drives. Ratio is how many
%   times the motor turns while that turns once, the teeth of the driven gear
%   by those of the motor's, as in `motor_gear(outB, 36/12)`: a float, 1.0 at
%   first. From then on the angles, positions, `dps(N)`, `rps(N)` and `rpm(N)`
%   of this motor, in all predicates, are those of what it drives, and so are
%   those of a robot with this motor; percentages and tacho counts remain the
%   motor's. It belongs to the port, so it stays when the motor is reset or
%   plugged in again. Gears that reverse the direction: motor_polarity/2.
%
%   @error domain_error(positive_number, Ratio)

motor_gear(Port, Ratio) :-
    var(Ratio),
    !,
    motor_gear_(Port, Ratio).
motor_gear(Port, Ratio0) :-
    number_value(positive_number, Ratio0, Ratio),
    motor_set_gear_(Port, Ratio).

%!  motor_duty(?Port, -Percent) is nondet.
%
%   True if the motor now gets Percent of the battery's voltage, from -100 to
%   100.

motor_duty(Port, Percent) :-
    attribute_('tacho-motor', Port, duty_cycle, Percent).

%!  motor_polarity(?Port, ?Polarity) is nondet.
%
%   Read or write a motor's polarity: `normal`, or `inversed` for a motor that
%   is mounted the other way round. `inversed` reverses the sign of its speeds
%   and positions. Set the polarity first: it also reverses the values that
%   were set before.
%
%   @error domain_error(polarity, Polarity)

motor_polarity(Port, Polarity) :-
    class_polarity('tacho-motor', Port, Polarity).

%!  motor_ramps(?Port, ?Up, ?Down) is nondet.
%
%   Read or write how a motor speeds up and slows down from the next command
%   on. It changes its speed evenly. Up and Down are the milliseconds between
%   rest and its highest speed, from 0 to 60000.
%
%   @error domain_error(ramp_up_sp, Up)
%   @error domain_error(ramp_down_sp, Down)

motor_ramps(Port, Up, Down) :-
    class_settings('tacho-motor', Port,
                   [ setting(ramp_up_sp, 0, 60000, Up),
                     setting(ramp_down_sp, 0, 60000, Down)
                   ]).

%!  motor_speed_pid(?Port, ?PID) is nondet.
%!  motor_hold_pid(?Port, ?PID) is nondet.
%
%   Read or write the constants of the regulator that keeps the speed of a
%   motor, or holds its position. PID is `pid(P, I, D)`, three integers from 0
%   on. They take effect at once.
%
%   @error domain_error(pid_constant, Constant) if Constant is negative

motor_speed_pid(Port, PID) :-
    motor_pid(Port, speed_pid, PID).

motor_hold_pid(Port, PID) :-
    motor_pid(Port, hold_pid, PID).

motor_pid(Port, Directory, PID) :-
    atom_concat(Directory, '/Kp', KP),
    atom_concat(Directory, '/Ki', KI),
    atom_concat(Directory, '/Kd', KD),
    (   var(PID)
    ->  device_at('tacho-motor', Port, _),
        motor_attribute(Port, KP, P),
        motor_attribute(Port, KI, I),
        motor_attribute(Port, KD, D),
        PID = pid(P, I, D)
    ;   must_be_pid(PID),
        PID = pid(P, I, D),
        motor_attribute(Port, KP, P),
        motor_attribute(Port, KI, I),
        motor_attribute(Port, KD, D)
    ).

must_be_pid(PID) :-
    (   PID = pid(P, I, D)
    ->  forall(one_of([P, I, D], Constant),
               must_be_within(0, 2147483647, pid_constant, Constant))
    ;   domain_error(pid, PID)
    ).
