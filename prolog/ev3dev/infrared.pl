:- module(ev3dev_infrared,
          [ ir_remote/3,                % ?Port, ?Channel, -Buttons
            ir_beacon/4,                % ?Port, ?Channel, -Heading, -Percent
            ir_dist_cm/2,               % ?Port, -Centimeters
            ir_seeker/2,                % ?Port, -Degrees
            ir_seeker/4                 % ?Port, +Light, -Direction,
                                        % -Strengths
          ]).
:- set_prolog_flag(generate_debug_info, false).
:- use_module(private/checks/arguments, [must_be_within/4, word/2]).
:- use_module(private/errors/errors, [domain_error/2]).
:- use_module(private/errors/public_clauses, [term_expansion/4]).
:- use_module(sensors, [ir_prox/2]).
:- use_module(private/native/native, [sensor_values_/5]).
:- use_module(private/basics/small_lists).

/** <module> Infrared sensors

The EV3's infrared sensor finds the beacon of LEGO's remote control, and
reports which buttons of the remote control are pressed. The sensor is in one
mode at a time and takes 1.1 s to change it, so a program that reads both
waits 1.1 s each time.

All predicates here fail if there is no such sensor. An unbound port is the
first port that has one; on backtracking, the next.
*/

%!  ir_remote(?Port, ?Channel, -Buttons) is nondet.
%
%   True if Buttons is the list of the pressed buttons of a remote control on
%   Channel: `red_up`, `red_down`, `blue_up`, `blue_down` and `beacon`, in
%   that order; `[]` if no button is pressed. The sensor reports one button,
%   or two of the first four. The beacon counts as pressed from one press of
%   its button to the next. An unbound Channel enumerates 1 to 4.
%
%   @error domain_error(ir_channel, Channel)

ir_remote(Port, Channel, Buttons) :-
    must_be_channel(Channel),
    sensor_values_(Port, ['lego-ev3-ir'], 'IR-REMOTE', 4,
                                  Codes),
    of_channel(Codes, Channel, Code),
    buttons(Code, Held),
    Buttons = Held.

buttons(0,  []).
buttons(1,  [red_up]).
buttons(2,  [red_down]).
buttons(3,  [blue_up]).
buttons(4,  [blue_down]).
buttons(5,  [red_up, blue_up]).
buttons(6,  [red_up, blue_down]).
buttons(7,  [red_down, blue_up]).
buttons(8,  [red_down, blue_down]).
buttons(9,  [beacon]).
buttons(10, [red_up, red_down]).
buttons(11, [blue_up, blue_down]).

%!  ir_beacon(?Port, ?Channel, -Heading, -Percent) is nondet.
%
%   True if the sensor sees the beacon of a remote control on Channel. Heading
%   is from -25, far to the left, to 25, far to the right; it is not an angle.
%   Percent is from 0, near, to 100, about 2 m. Fails if the sensor sees no
%   beacon. An unbound Channel enumerates the channels with a beacon.
%
%   @error domain_error(ir_channel, Channel)

ir_beacon(Port, Channel, Heading, Percent) :-
    must_be_channel(Channel),
    sensor_values_(Port, ['lego-ev3-ir'], 'IR-SEEK', 8,
                                  Values),
    findall(beacon(Channel, Seen, Far),
            ( in_pairs(Values, Pairs),
              of_channel(Pairs, Channel, Seen-Far),
              Far =\= -128
            ),
            Beacons),
    one_of(Beacons, beacon(Channel, Heading, Percent)).

in_pairs([], []).
in_pairs([Heading, Percent|Values], [Heading-Percent|Pairs]) :-
    in_pairs(Values, Pairs).

of_channel(Elements, Channel, Element) :-
    Channels =.. [channels|Elements],
    arg(Channel, Channels, Element).

must_be_channel(Channel) :-
    (   var(Channel)
    ->  true
    ;   must_be_within(1, 4, ir_channel, Channel)
    ).

%!  ir_dist_cm(?Port, -Centimeters) is nondet.
%
%   True if the EV3's infrared sensor sees something at about Centimeters,
%   from 0 to 70. It measures how much of its light comes back, so dark things
%   seem farther away. It also reports 70 cm when it sees nothing.

ir_dist_cm(Port, Centimeters) :-
    ir_prox(Port, Percent),
    Centimeters is Percent * 0.7.

%!  ir_seeker(?Port, -Degrees) is nondet.
%
%   True if HiTechnic's seeker sees pulsed infrared light, for example of
%   HiTechnic's ball, in the direction Degrees: -120 to 120 in steps of 30,
%   clockwise, 0 is ahead. Fails if the seeker sees no such light.
%
%   @see http://www.hitechnic.com/blog/ir-seeker for degrees and directions

ir_seeker(Port, Degrees) :-
    sensor_values_(Port, ['ht-nxt-ir-seek-v2'], 'AC', 1,
                                  [Direction]),
    Direction > 0,
    Degrees is (Direction - 5) * 30.

%!  ir_seeker(?Port, +Light, -Direction, -Strengths) is nondet.
%
%   True if HiTechnic's seeker sees infrared Light, `pulsed` or `steady`, in
%   Direction, from 1 (far left) over 5 (ahead) to 9 (far right). Strengths is
%   the list of the strengths that its five eyes measure, from left to right,
%   each from 0 to 255. Fails if the seeker sees no such light.
%
%   @error domain_error(ir_light, Light)

ir_seeker(Port, Light0, Direction, Strengths) :-
    word(Light0, Light),
    (   light_mode(Light, Mode)
    ->  true
    ;   domain_error(ir_light, Light)
    ),
    sensor_values_(Port, ['ht-nxt-ir-seek-v2'], Mode, 6,
                                  [Direction0|Seen]),
    Direction0 > 0,
    Direction = Direction0,
    Strengths = Seen.

light_mode(pulsed, 'AC-ALL').
light_mode(steady, 'DC-ALL').
