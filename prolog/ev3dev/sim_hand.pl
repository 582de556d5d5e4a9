:- module(ev3dev_sim_hand,
          [ sim_place/3,                % +X, +Y, +Heading
            sim_add/1,                  % +Fact
            sim_add/2,                  % +Fact, -Id
            sim_remove/1,               % +IdOrFact
            sim_plug/2,                 % +Port, +Type
            sim_unplug/1,               % +Port
            sim_jam/2,                  % +Port, +Boolean
            sim_show/3,                 % +Port, +Attribute, +Text
            sim_unshow/2,               % +Port, +Attribute
            sim_remote/2,               % +Channel, +Buttons
            sim_press/1,                % +Key
            sim_press/2,                % +Key, +Options
            sim_release/1,              % +Key
            added_facts/1,              % -Added
            set_added_facts/1           % +Added
          ]).
:- set_prolog_flag(generate_debug_info, false).
:- use_module(private/run/brick, [brick/1, of_brick/1]).
:- use_module(private/checks/checks, [must_be/2]).
:- use_module(private/errors/public_clauses, [term_expansion/4]).
:- use_module(private/explain/hints, [fail_because/1]).
:- use_module(library(lists), [member/2]).
:- use_module(private/checks/arguments,
              [ must_be_options/3, number_option/4, number_value/2,
                number_value/3, option/3
              ]).
:- use_module(private/native/native,
              [ sim_active_/0, sim_add_/2, sim_jam_/2, sim_key_/2,
                sim_place_/3, sim_plan_key_/3, sim_plug_/2, sim_remote_/2,
                sim_remove_/1, sim_show_/3, sim_unplug_/1, sim_unshow_/2
              ]).

/** <module> A hand in the simulated world

The part of library(ev3dev/sim) that moves the robot, changes the world and
presses buttons. All predicates fail if no simulation runs.
*/

:- dynamic added/3.                     % Brick, Fact, Id
:- of_brick([added/3]).

%!  sim_place(+X, +Y, +Heading) is semidet.
%
%   Lift the robot to another place, where it stands still. All three
%   arguments may be arithmetic expressions.
%
%   @error domain_error(possible_geometry, Item) if an obstacle stands there,
%          or the world ends before

sim_place(X0, Y0, Heading0) :-
    number_value(X0, X),
    number_value(Y0, Y),
    number_value(Heading0, Heading),
    sim_place_(X, Y, Heading).

%!  sim_add(+Fact) is semidet.
%!  sim_add(+Fact, -Id) is semidet.
%
%   Add a thing to the world, such as a box or a lamp, by a Fact of world
%   files. Id is a number by which sim_remove/1 removes it.
%
%   @error domain_error(possible_geometry, Item) if the item is impossible, or
%          if the robot stands there
%   @error domain_error(world_item, Fact) if Fact is another fact of worlds or
%          robots
%   @error domain_error(world_or_robot_fact, Fact) if Fact is not a fact of
%          worlds or robots

sim_add(Fact) :-
    sim_add(Fact, _).

sim_add(Fact, Id) :-
    must_be(nonvar, Fact),
    sim_add_(Fact, Id),
    brick(Brick),
    retractall(added(Brick, _, Id)),
    asserta(added(Brick, Fact, Id)).

%!  sim_remove(+IdOrFact) is semidet.
%
%   Remove an item from the world that sim_add/1,2 added: by its Id, or by its
%   Fact, which may contain variables. If several items match Fact, removes
%   the newest. Fails if no item matches.

sim_remove(Id) :-
    integer(Id),
    !,
    sim_remove_(Id).
sim_remove(Fact) :-
    must_be(callable, Fact),
    brick(Brick),
    added(Brick, Fact, Id),
    sim_remove_(Id),
    !.

%!  sim_plug(+Port, +Type) is semidet.
%
%   Plug a motor or a sensor into a port, after unplugging the old one. As on
%   a brick, its device appears later: after 0.4 s for a motor, 1.3 s for most
%   sensors. Until then calls fail, and a warning says so. The robot's facts
%   for that port give the place and heading of the sensor. `'ms-8ch-servo'`
%   is a controller with eight servos.
%
%   @error domain_error(possible_geometry, Item) if it does not fit that port

sim_plug(Port, Type) :-
    sim_plug_(Port, Type).

%!  sim_unplug(+Port) is semidet.
%
%   Pull the wire out of a port. Fails if nothing is plugged in.

sim_unplug(Port) :-
    (   sim_unplug_(Port)
    ->  true
    ;   sim_active_,
        fail_because(nothing_at(Port))
    ).

%!  sim_jam(+Port, +Boolean) is semidet.
%
%   Hold the shaft of a motor fast, or let go of it.
%
%   @error domain_error(motor_port, Port) if Port is one of a sensor

sim_jam(Port, Boolean) :-
    must_be(boolean, Boolean),
    sim_jam_(Port, Boolean).

%!  sim_show(+Port, +Attribute, +Text) is semidet.
%!  sim_unshow(+Port, +Attribute) is semidet.
%
%   Make an attribute of the motor or sensor at a port show Text, to test a
%   program with it; sim_unshow/2 shows the true text again. Text is an atom,
%   string or number. The device itself does not change, and accepts writes to
%   the attribute as usual. Unplugging the device also ends sim_show/3.
%
%   ```
%   ?- sim_show(in1, value0, 123), us_dist_cm(in1, Distance).
%   Distance = 12.3.
%   ```
%
%   Both fail if nothing is at that port, and sim_unshow/2 if the attribute
%   shows its own text already.
%
%   @error existence_error(attribute, Attribute)
%   @error domain_error(readable_attribute, Attribute) if Attribute can only
%          be written, such as `command`
%   @error domain_error(attribute_text, Text) if Text is longer than a page

sim_show(Port, Attribute, Text) :-
    sim_show_(Port, Attribute, Text).

sim_unshow(Port, Attribute) :-
    sim_unshow_(Port, Attribute).

%!  sim_remote(+Channel, +Buttons) is semidet.
%
%   Hold down Buttons of an infrared remote control on a channel from 1 to 4,
%   and release all others, until the next call. Buttons is a list of
%   `red_up`, `red_down`, `blue_up`, `blue_down` and `beacon`: none, one, or
%   two of the first four. The robot receives the signal at every place.
%
%   @error domain_error(ir_channel, Channel)
%   @error domain_error(ir_button, Button) if there is no such button
%   @error domain_error(ir_buttons, Buttons) if a sensor cannot report this
%          combination

sim_remote(Channel, Buttons) :-
    must_be(list, Buttons),
    sim_remote_(Channel, Buttons).

%!  sim_press(+Key) is semidet.
%!  sim_release(+Key) is semidet.
%
%   Press a button of the brick and hold it, or release it: `up`, `down`,
%   `left`, `right`, `enter` or `back`. Key may also be the port of a touch
%   sensor; a bumper that touches a wall is pressed anyway. Does nothing if
%   the key is pressed, or released, already. Fails if there is no touch
%   sensor at the port.
%
%   @error domain_error(key, Key)

sim_press(Key) :-
    (   sim_key_(Key, true)
    ->  true
    ;   no_key(Key)
    ).

sim_release(Key) :-
    (   sim_key_(Key, false)
    ->  true
    ;   no_key(Key)
    ).

no_key(Port) :-
    sim_active_,
    fail_because(absent(['lego-ev3-touch'], Port)).

%!  sim_press(+Key, +Options) is semidet.
%
%   Press a button or a touch sensor at a later time. Does not wait. So a
%   test can run a program that waits for a button:
%
%   ```
%   ?- sim_press(enter, [after(2)]), button_wait(enter, pressed).
%   ```
%
%   Options, in simulated seconds:
%
%     - after(+Seconds)
%       The time from now to the press. Default is 0.
%     - for(+Seconds)
%       The time from press to release. Default is 0.2. With `infinite`,
%       sim_release/1 releases the button.
%
%   @error domain_error(key, Key)
%   @error domain_error(seconds, Seconds)
%   @error domain_error(sim_option, Option) if Option is not an option of this
%          predicate

sim_press(Key, Options) :-
    must_be_options(sim_option, [after, for], Options),
    number_option(after(After), seconds, Options, 0),
    option(for(For0), Options, 0.2),
    (   For0 == infinite
    ->  For = infinite
    ;   number_value(seconds, For0, For)
    ),
    sim_plan_key_(Key, After, For).

%!  added_facts(-Added) is det.
%!  set_added_facts(+Added) is det.
%
%   Added is a list of Fact-Id, the items that sim_add/1,2 added to the world.

added_facts(Added) :-
    brick(Brick),
    findall(Fact-Id, added(Brick, Fact, Id), Added).

set_added_facts(Added) :-
    must_be(list, Added),
    brick(Brick),
    retractall(added(Brick, _, _)),
    forall(member(Fact-Id, Added), assertz(added(Brick, Fact, Id))).
