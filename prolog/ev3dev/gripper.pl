:- module(ev3dev_gripper,
          [ set_gripper/2,              % +Port, +Options
            grip/0,
            release/0,
            gripping/0
          ]).
:- set_prolog_flag(generate_debug_info, false).
:- use_module(private/load/compiled, []).
:- use_module(private/checks/checks, [must_be/2]).
:- use_module(private/errors/errors, [domain_error/2, throw_error/3]).
:- use_module(private/errors/public_clauses, [term_expansion/4]).
:- use_module(private/explain/hints, [explain/2]).
:- use_module(private/checks/arguments,
              [must_be_options/3, number_option/4, option/3, word/2]).
:- use_module(library(lists), [nth1/3]).
:- use_module(private/run/brick, [brick/1, of_brick/1]).
:- use_module(motors, [motor_run_until_stalled/3]).
:- use_module(motor_settings, [motor_position/2]).

/** <module> A gripper

Commands to open and close a gripper, by the motor that moves its jaws. They
need no sensor: a motor that closes on a thing stops earlier than one that
closes on nothing. The same calls move a real gripper and one of the
simulator; see docs/worlds.md for its facts.

```
?- set_gripper(outA, []).
?- release, go_cm(20, 15), grip, go_cm(-20, 30), release.
```
*/

%   The motor of the gripper, its position when the jaws are open, and whether
%   they hold something. Closing is 1 or -1.
:- dynamic
    set/4,                      % Brick, Port, Closing, [Turn, Force]
    opened/2,                   % Brick, Position
    holds/1.                    % Brick
:- of_brick([set/4, opened/2, holds/1]).

%!  set_gripper(+Port, +Options) is det.
%
%   The motor at Port moves the jaws of the gripper. Options:
%
%     - closes(+Direction)
%       The direction in which the motor closes the jaws: `positive`
%       (default) or `negative`.
%     - turn(+Degrees)
%       How far the motor turns from open to closed jaws, above 0. Default is
%       90, as on the robot `carrier`.
%     - force(+Percent)
%       The share of the battery's voltage with which the motor pushes, above
%       0 to 100. Default is 40. A motor that pushes on with all of it gets
%       hot.
%
%   @error domain_error(jaw_direction, Direction)
%   @error domain_error(jaws_option, Option) if Option is not an option of
%          this predicate

set_gripper(Port0, Options) :-
    word(Port0, Port),
    must_be_options(jaws_option, [closes, turn, force],
                    Options),
    option(closes(Direction), Options, positive),
    must_be(nonvar, Direction),
    (   nth1(Place, [positive, negative], Direction)
    ->  nth1(Place, [1, -1], Closing)
    ;   domain_error(jaw_direction, Direction)
    ),
    number_option(turn(Turn), jaw_angle, Options, 90),
    number_option(force(Force), duty_limit, Options, 40),
    brick(Brick),
    retractall(set(Brick, _, _, _)),
    forget(Brick),
    assertz(set(Brick, Port, Closing, [Turn, Force])).

forget(Brick) :-
    retractall(opened(Brick, _)),
    retractall(holds(Brick)).

%!  grip is semidet.
%
%   Close the jaws until something stops them. Waits. The motor holds them
%   there. The first grip/0 opens them before. Fails if the jaws close on
%   nothing, if there is no motor, or if somebody stops it.
%
%   @error existence_error(gripper, Brick) if set_gripper/2 was not called

grip :-
    gripper(Brick, Port, Closing, [Turn, Force]),
    (   opened(Brick, _)
    ->  true
    ;   release
    ),
    retractall(holds(Brick)),
    push(Port, Closing, Force, hold),
    opened(Brick, Open),
    motor_position(Port, Closed),
    (   abs(Closed - Open) < 0.9*Turn
    ->  assertz(holds(Brick))
    ;   explain("The gripper at ~w closed on nothing", [Port]),
        fail
    ).

%!  release is semidet.
%
%   Open the jaws as far as they go. Waits. Fails if there is no motor, or if
%   somebody stops it.
%
%   @error existence_error(gripper, Brick) if set_gripper/2 was not called

release :-
    gripper(Brick, Port, Closing, [_, Force]),
    forget(Brick),
    push(Port, -Closing, Force, coast),
    motor_position(Port, Open),
    assertz(opened(Brick, Open)).

%!  gripping is semidet.
%
%   True if the last grip/0 closed on something, and release/0 has not been
%   called since. No sensor shows that a thing has been lost.
%
%   @error existence_error(gripper, Brick) if set_gripper/2 was not called

gripping :-
    gripper(Brick, _, _, _),
    holds(Brick).

gripper(Brick, Port, Closing, Options) :-
    brick(Brick),
    (   set(Brick, Port0, Closing0, Options0)
    ->  [Port, Closing, Options] = [Port0, Closing0, Options0]
    ;   throw_error(existence_error(gripper, Brick), _,
                    'no gripper is set: call set_gripper/2 first')
    ).

%   With the least voltage that turns the motor, the jaws need some seconds.
push(Port, Direction, Force, Action) :-
    motor_run_until_stalled(Port, Direction,
                            [ duty_limit(Force), stop_action(Action),
                              timeout(10) ]).
