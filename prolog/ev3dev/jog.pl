:- module(ev3dev_jog,
          [ jog/0,
            jog/1                       % +Options
          ]).
:- set_prolog_flag(generate_debug_info, false).
:- use_module(private/load/compiled, []).
:- use_module(private/errors/public_clauses, [term_expansion/4]).
:- use_module(private/checks/arguments, [must_be_options/3]).
:- use_module(private/devices/drive_moves, [speed_option/4]).
:- use_module(private/devices/robot_state, [robot_set/4]).
:- use_module(robot, [go/1, stop/0, turn/1]).

/** <module> Driving the robot with the keyboard

Loaded apart from library(ev3dev):

```
?- use_module(library(ev3dev/jog)).
?- set_robot(5.6, 10.6, outB, outC).
?- jog.
```
*/

%!  jog is semidet.
%!  jog(+Options) is semidet.
%
%   Drive the robot with the arrow keys of the terminal, until `q` or Ctrl-D:
%   up and down go ahead and back, left and right turn on the spot, and the
%   space bar stops. The robot goes on until the next key. It is stopped at
%   the end, however that comes. Fails if no robot is set, or a motor is not
%   connected. No simulated time passes on a `virtual` clock while this waits
%   for a key. Options:
%
%     - speed(+Speed)
%       In percent, or as `cm_per_s(20)`. Default is 30.
%
%   @error domain_error(speed_ahead, Percent)
%   @error domain_error(jog_option, Option) if Option is not an option of this
%          predicate

jog :-
    jog([]).

jog(Options) :-
    must_be_options(jog_option, [speed], Options),
    speed_option(Options, speed_ahead, 30, Speed),
    robot_set(_, _, _Left, _Right),
    print_message(informational, ev3dev(jog)),
    call_cleanup(jog_on(Speed), ignore(stop)).

:- multifile prolog:message//1.

prolog:message(ev3dev(jog)) -->
    [ 'Arrow keys drive, space stops, q ends.'-[] ].

jog_on(Speed) :-
    key(Key),
    (   Key == end
    ->  true
    ;   act(Key, Speed),
        jog_on(Speed)
    ).

act(up, Speed) :-
    go(Speed).
act(down, Speed) :-
    Back is -Speed,
    go(Back).
act(right, Speed) :-
    turn(Speed).
act(left, Speed) :-
    Left is -Speed,
    turn(Left).
act(space, _) :-
    stop.
act(other, _).

%   An arrow key sends three characters: escape, `[` or `O`, and a letter.
key(Key) :-
    code(Code),
    (   Code =:= 27
    ->  code(Second),
        (   memberchk(Second, `[O`)
        ->  code(Third),
            arrow_key(Third, Key)
        ;   key_of(Second, Key)
        )
    ;   key_of(Code, Key)
    ).

arrow_key(Code, Key) :-
    (   arrow(Code, Key0)
    ->  Key = Key0
    ;   key_of(Code, end)
    ->  Key = end
    ;   Key = other
    ).

arrow(0'A, up).
arrow(0'B, down).
arrow(0'C, right).
arrow(0'D, left).

key_of(Code, Key) :-
    (   memberchk(Code, [-1, 4, 0'q])
    ->  Key = end
    ;   Code =:= 0'\s
    ->  Key = space
    ;   Key = other
    ).

code(Code) :-
    (   stream_property(user_input, tty(true))
    ->  get_single_char(Code)
    ;   get_code(user_input, Code)
    ).
