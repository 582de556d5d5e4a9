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
:- use_module(private/errors, [must_be/2, term_expansion/2]).
:- use_module(library(lists), [member/2]).
:- use_module(driver, []).
:- use_module(private/arguments,
              [ must_be_options/3, number_option/4, number_value/2,
                number_value/3, option/3
              ]).
:- use_module(private/native,
              [ sim_add_/2, sim_jam_/2, sim_key_/2, sim_place_/3,
                sim_plan_key_/3, sim_plug_/2, sim_remote_/2, sim_remove_/1,
                sim_show_/3, sim_unplug_/1, sim_unshow_/2 ]).

/** <module> A hand in the simulated world

The part of library(ev3dev/sim) that does what people do to a robot and to
what is around it. All fail if no simulation runs.
*/

:- dynamic added/2.                     % Fact, Id

%!  sim_place(+X, +Y, +Heading) is semidet.
%
%   Lift the robot to another place, where it stands still. All three may be
%   arithmetic expressions.
%
%   @error domain_error(possible_geometry, Item) if something stands there

sim_place(X0, Y0, Heading0) :-
    number_value(X0, X),
    number_value(Y0, Y),
    number_value(Heading0, Heading),
    sim_place_(X, Y, Heading).

%!  sim_add(+Fact) is semidet.
%!  sim_add(+Fact, -Id) is semidet.
%
%   Put something into the world: a wall, box, circle, patch, line, lamp or
%   beacon, by a fact as a world file has. Id is a number by which to remove
%   it.
%
%   @error domain_error(possible_geometry, Item) if it cannot be, or the robot
%          stands there
%   @error domain_error(world_item, Fact) if it is another fact of a file
%   @error domain_error(world_or_robot_fact, Fact) if it is none

sim_add(Fact) :-
    sim_add(Fact, _).

sim_add(Fact, Id) :-
    sim_add_(Fact, Id),
    retractall(added(_, Id)),
    asserta(added(Fact, Id)).

%!  sim_remove(+IdOrFact) is semidet.
%
%   Take something out of the world that sim_add/1,2 put there: by its Id, or
%   by its Fact, in which variables stand for anything; of several such the
%   newest. Fails if there is no such thing.

sim_remove(Id) :-
    integer(Id),
    !,
    sim_remove_(Id).
sim_remove(Fact) :-
    must_be(callable, Fact),
    added(Fact, Id),
    sim_remove_(Id),
    !.

%!  sim_plug(+Port, +Type) is semidet.
%
%   Plug a motor or a sensor in, after pulling what is there. As on a brick it
%   is some time before it is noticed: 0.4 s for a motor, 1.3 s for most
%   sensors. A sensor sits and looks as the robot's file says for that port.
%   `'ms-8ch-servo'` is a controller with eight servos behind it.
%
%   @error domain_error(possible_geometry, Item) if it does not fit that port

sim_plug(Port, Type) :-
    sim_plug_(Port, Type).

%!  sim_unplug(+Port) is semidet.
%
%   Pull the wire out of a port. Fails if there is none.

sim_unplug(Port) :-
    sim_unplug_(Port).

%!  sim_jam(+Port, +Boolean) is semidet.
%
%   Hold the shaft of a motor fast, or let go of it.

sim_jam(Port, Boolean) :-
    must_be(boolean, Boolean),
    sim_jam_(Port, Boolean).

%!  sim_show(+Port, +Attribute, +Text) is semidet.
%!  sim_unshow(+Port, +Attribute) is semidet.
%
%   Make an attribute of the motor or sensor at a port show a text, an atom,
%   string or number, whatever happens in the world, to try a program with it;
%   and show what is true again. The device itself does not change, and takes
%   what is written to the attribute as ever. When it is unplugged, this ends.
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
%   @error domain_error(readable_attribute, Attribute) if it can only be
%          written, as `command`
%   @error domain_error(attribute_text, Text) if it is longer than a page

sim_show(Port, Attribute, Text) :-
    sim_show_(Port, Attribute, Text).

sim_unshow(Port, Attribute) :-
    sim_unshow_(Port, Attribute).

%!  sim_remote(+Channel, +Buttons) is semidet.
%
%   Hold down these buttons of an infrared remote control on a channel from 1
%   to 4, and let go of all others, until the next call. Buttons is a list of
%   `red_up`, `red_down`, `blue_up`, `blue_down` and `beacon`: none, one, or
%   two of the first four. The robot hears it wherever it is.
%
%   @error domain_error(ir_channel, Channel)
%   @error domain_error(ir_button, Button) if there is no such button
%   @error domain_error(ir_buttons, Buttons) if no sensor could tell these
%          from others

sim_remote(Channel, Buttons) :-
    must_be(list, Buttons),
    sim_remote_(Channel, Buttons).

%!  sim_press(+Key) is semidet.
%!  sim_release(+Key) is semidet.
%
%   Press a key of the brick and hold it, or let go of it: `up`, `down`,
%   `left`, `right`, `enter` or `back`. Does nothing if it is so already.
%
%   @error domain_error(button, Key)

sim_press(Key) :-
    sim_key_(Key, true).

sim_release(Key) :-
    sim_key_(Key, false).

%!  sim_press(+Key, +Options) is semidet.
%
%   Press a key at some time to come. Does not wait. So a program that waits
%   for a key can be tried by itself:
%
%   ```
%   ?- sim_press(enter, [after(2)]), button_wait(enter, pressed).
%   ```
%
%   Options, in simulated seconds:
%
%     - after(+Seconds)
%       When it is pressed, from now. Default is 0.
%     - for(+Seconds)
%       How long it is held. Default is 0.2; `infinite` until sim_release/1.
%
%   @error domain_error(button, Key)
%   @error domain_error(seconds, Seconds)
%   @error domain_error(sim_option, Option) for an option that is none

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
%   Added is a list of Fact-Id: what sim_add/1,2 put into the world.

added_facts(Added) :-
    findall(Fact-Id, added(Fact, Id), Added).

set_added_facts(Added) :-
    retractall(added(_, _)),
    forall(member(Fact-Id, Added), assertz(added(Fact, Id))).
