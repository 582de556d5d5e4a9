:- module(ev3dev_sim,
          [ sim_start/1,                % +World
            sim_start/2,                % +World, +Options
            sim_stop/0,
            sim_pose/3,                 % -X, -Y, -Heading
            sim_place/3,                % +X, +Y, +Heading
            sim_add/1,                  % +Fact
            sim_add/2,                  % +Fact, -Id
            sim_remove/1,               % +IdOrFact
            sim_plug/2,                 % +Port, +Type
            sim_unplug/1,               % +Port
            sim_jam/2,                  % +Port, +Boolean
            sim_show/3,                 % +Port, +Attribute, +Text
            sim_unshow/2,               % +Port, +Attribute
            sim_wait/1,                 % +Seconds
            sim_remote/2,               % +Channel, +Buttons
            sim_press/1,                % +Key
            sim_press/2,                % +Key, +Options
            sim_release/1,              % +Key
            sim_step/1,                 % +Seconds
            sim_time/1,                 % -Seconds
            sim_snapshot/1,             % -Snapshot
            sim_restore/1,              % +Snapshot
            sim_collisions/1,           % -Collisions
            sim_trace/1,                % -Trace
            sim_svg/1,                  % +File
            sim_mount/1,                % +Directory
            sim_mount/2,                % +Directory, +DevDirectory
            sim_unmount/0
          ]).
:- use_module(library(error), [domain_error/2, existence_error/2, must_be/2]).
:- use_module(library(lists), [append/3, member/2]).
:- use_module(library(option), [option/3]).
:- use_module(library(pairs), [pairs_keys/2]).
:- use_module(driver, []).
:- use_module(options, [must_be_options/3]).
:- use_module(fact_file,
              [fact_location/3, located_facts/3, throw_located/3]).

/** <module> A simulated robot in a simulated world

An ev3dev brick with motors and sensors, on two wheels, in a flat world. A
program cannot tell it from a real one: while a simulation runs, all of
library(ev3dev) works on it.

```
?- sim_start(room).
?- set_robot(5.6, 10.6, outB, outC).
?- go_cm(30, 20), us_dist_cm(_, Distance).
Distance = 96.9.
?- sim_pose(X, Y, Heading).
X = 52.9, Y = 55.4, Heading = 40.0.
```

Lengths are in centimetres and angles in degrees. X goes to the right and y
up; heading 0 looks along y, and clockwise is positive, as in turn/2.

All predicates but sim_start/1,2 fail if no simulation runs.

## Worlds {#sim-worlds}

A world is a file of facts, which is read and not run; it may hold any number
of

  - bounds(X1, Y1, X2, Y2)
    Walls around everything, from the lower left to the upper right corner.
  - wall(X1, Y1, X2, Y2)
  - wall(X1, Y1, X2, Y2, Thickness)
    A wall from a point to another, 1 cm thick by default.
  - box(X, Y, Width, Depth)
  - box(X, Y, Width, Depth, Heading)
    A box by its middle. The depth is along its heading, by default 0.
  - circle(X, Y, Radius)
    Something round, as a pillar.
  - floor(Colour)
    The floor, by default white: one of `black`, `blue`, `green`, `yellow`,
    `red`, `white` and `brown`, or `'#rrggbb'`.
  - patch(Colour, Corners)
    A coloured piece of floor with at least three Corners, each `[X, Y]`.
    Patches and lines cover those before them.
  - line(Colour, Width, Points)
    A line on the floor through at least two Points, each `[X, Y]`.
  - lamp(X, Y, Intensity)
  - lamp(X, Y, Intensity, Port)
    A lamp, 30 cm above the floor. One with a Port is lit by that output port
    in the mode `dc-motor` or `led`, see port_mode/2. Intensity is the
    percentage that col_ambient/2 shows when the sensor looks at it from 100
    cm. The light falls with the square of the distance; what stands between
    throws shadows.
  - beacon(X, Y, Channel)
    An infrared beacon on a channel from 1 to 4, see ir_beacon/4. It is seen
    from up to 200 cm, if nothing stands between.
  - ambient(Percent)
    Light from everywhere, by default 2.
  - temperature(Celsius)
    How warm it is, by default 21.5.
  - loudness(Percent)
    How loud it is, by default 0: see nxt_sound/2.
  - start(X, Y, Heading)
    Where the robot starts, by default at 0, 0 with heading 0.
  - map(CellSize, Rows)
    A world that is drawn: strings or atoms, a character for each cell, the
    lower left corner of the last row at 0, 0. `#` is a wall, `O` a pillar,
    `.` or a space floor, `L` a lamp, `^`, `>`, `v` or `<` the start and its
    heading; `k`, `b`, `g`, `y`, `r`, `w` and `n` are black, blue, green,
    yellow, red, white and brown floor.

Shipped are `room` with walls and boxes, `lights` with a lamp, `line` with a
track, `grid` with boxes in cells of 20 cm, and `maze`.

## Robots {#sim-robots}

A robot is a file of facts, too:

  - left_wheel(Port, Diameter)
  - left_wheel(Port, Diameter, Options)
  - right_wheel(Port, Diameter)
  - right_wheel(Port, Diameter, Options)
    The wheels by the ports of their motors. Options are `inverted(true)` for
    a motor that is mounted the other way round, and `slip(Share)` for the
    part of its way that the wheel loses, from 0 to less than 1.
  - axle(Length)
    The distance between the wheels.
  - hull(circle(Radius))
  - hull(rectangle(Width, Length, Offset))
    The outline, around the middle of the axle; the middle of a rectangle is
    Offset ahead of it.
  - mass(Kilograms)
  - motor(Port, Type)
    A motor: `'lego-ev3-l-motor'`, `'lego-ev3-m-motor'`, `'lego-nxt-motor'`,
    or one of the linear actuators `'act-l12-ev3-50'` and `'act-l12-ev3-100'`.
    The wheels' have to be among them.
  - sensor(Port, Type, X, Y, Heading)
    A sensor, X to the right and Y ahead of the middle of the axle, of any
    type that ev3dev knows, see [below](#sim-sensors).
  - noise(Port, Sigma, Bias)
    The errors of a device that stands before: a random one, with that
    standard deviation, and a constant one, in units of the sensor's value.
    For a motor they are in percent; Bias makes it stronger than others. For
    a gyro Bias is a drift in degrees per second.
  - encoder_noise(Port, Sigma)
    How inexact the encoder of a motor is that stands before: the standard
    deviation in degrees by which each tooth of its disc is off, by default
    0. So `position` is, always by the same where the motor stands the same.

Shipped are `default`, the robot of set_robot(5.6, 10.6, outB, outC) with an
ultrasonic sensor at in1, colour sensors on its left at in2 and on its right
at in3, and a gyro at in4; and `touch`, with a bumper at in4.

## Sensors {#sim-sensors}

Of the EV3's own sensors, a colour sensor sees the floor below it and the
lamps ahead of it; a touch sensor is a bumper, 8 cm wide; and the infrared one
sees beacons up to 60 degrees aside, which it calls 25, and hears remote
controls, see sim_remote/2.

LEGO's sensors for the NXT do the same, and tell the temperature and how loud
it is. A compass takes the y axis for north. `HiTechnic's` infrared seeker
looks for beacons, too; an angle sensor sits on the axle of the left wheel, an
accelerometer lies flat and feels gravity alone, and a proximity detector sees
what is within 25 cm.

For the others of sensor_mode/6 there is nothing in this world. They exist,
with all their modes, and show the same always: the air has 1013 mbar, boxes
for motors and servos have 6 V, a camera sees nothing.

What is an NXT sensor with nothing but a voltage comes up as `nxt-analog`, as
on a brick, except for the light sensor. The port has to be told what it is:
write the type to the file `set_device` of its `lego-port`.

## Time {#sim-time}

With the clock `realtime`, simulated time passes like that on the wall, with
`scaled(Factor)` so many times faster.

With the clock `virtual` the program's own computing takes no time at all.
Time jumps when a predicate of library(ev3dev) waits, as go_cm/2 does, to the
end of the wait; so a minute's drive takes milliseconds. Each read of a file
takes 0.5 ms and each write 0.1 ms, so that time passes for a program, too,
that only polls a sensor in a loop. sleep/1 does not count: to let time pass
otherwise, use sim_wait/1. Who waits for a key that nobody is known to press
lets time pass, too, at most 20 times as fast as on the wall. Several threads
may wait at once; time goes on when each waits or does something else than to
use devices. The same program with the same seed does the same each time.
*/

:- dynamic added/2.                     % Fact, Id

%!  sim_start(+World) is det.
%!  sim_start(+World, +Options) is det.
%
%   Start a simulation, in place of the one that runs, and use it as the tree
%   of devices. World is the name of a shipped one, a file, or a list of
%   facts. Options:
%
%     - clock(+Clock)
%       `realtime` (default), `scaled(Factor)` or `virtual`.
%     - robot(+Robot)
%       The robot, given like World. Default is `default`.
%     - noise(+Boolean)
%       If `true`, sensors and motors have the errors that real ones have,
%       encoders one of half a degree. Default is `false`.
%     - seed(+Integer)
%       Where chance starts from. Default is 1.
%     - screen(+Bits)
%       Bits that the screen has for a pixel: 32 (default) or 1, as with older
%       versions of ev3dev.
%
%   If it cannot be started, nothing changes. What is wrong with a file is
%   thrown as `error(Formal, fact(Location, Message))`, which is printed with
%   file and line; Location is `file(File, Line, LinePosition, CharNo)`.
%
%   @error existence_error(world, World)
%   @error existence_error(robot, Robot)
%   @error domain_error(world_fact, Fact) if a world has no such facts
%   @error domain_error(robot_fact, Fact) if a robot has no such facts
%   @error domain_error(possible_geometry, Item)
%   @error domain_error(clock, Clock)
%   @error domain_error(sim_option, Option) for an option that is none
%   @error domain_error(screen_bits, Bits)
%   @error existence_error(feature, sim) if the pack was built without

sim_start(World) :-
    sim_start(World, []).

sim_start(World, Options) :-
    must_be_built,
    must_be_options(sim_option, [clock, robot, noise, screen, seed], Options),
    option(clock(Clock), Options, realtime),
    option(seed(Seed), Options, 1),
    option(noise(Noise), Options, false),
    option(robot(Robot), Options, default),
    option(screen(Bits), Options, 32),
    must_be_clock(Clock),
    must_be(integer, Seed),
    must_be(boolean, Noise),
    must_be_screen(Bits),
    located_facts(world, World, LocatedWorld),
    located_facts(robot, Robot, LocatedRobot),
    pairs_keys(LocatedWorld, WorldFacts),
    pairs_keys(LocatedRobot, RobotFacts),
    append(LocatedWorld, LocatedRobot, Located),
    catch(sim_start_(WorldFacts, RobotFacts, Clock, Seed, Noise, Bits),
          error(domain_error(possible_geometry, Item), context(_, Why)),
          throw_impossible(Item, Why, Located)),
    retractall(added(_, _)).

must_be_built :-
    (   predicate_property(ev3dev_sim:sim_active_, foreign)
    ->  true
    ;   existence_error(feature, sim)
    ).

must_be_clock(Clock) :-
    must_be(nonvar, Clock),
    (   clock(Clock)
    ->  true
    ;   domain_error(clock, Clock)
    ).

clock(realtime).
clock(virtual).
clock(scaled(Factor)) :-
    number(Factor),
    Factor > 0.

must_be_screen(Bits) :-
    must_be(integer, Bits),
    (   memberchk(Bits, [1, 32])
    ->  true
    ;   domain_error(screen_bits, Bits)
    ).

throw_impossible(Item, Why, Located) :-
    fact_location(Item, Located, Location),
    throw_located(domain_error(possible_geometry, Item), Location, Why).

%!  sim_stop is semidet.
%
%   End the simulation. The tree of devices is the brick's again, if this
%   machine is one.

sim_stop :-
    sim_stop_,
    retractall(added(_, _)).

%!  sim_pose(-X, -Y, -Heading) is semidet.
%
%   True if that is where the robot is and where it looks, really. Heading is
%   how far it has turned in all, and not reduced to a full circle.

sim_pose(X, Y, Heading) :-
    sim_pose_(X, Y, Heading).

%!  sim_place(+X, +Y, +Heading) is semidet.
%
%   Lift the robot to another place, where it stands still. All three may be
%   arithmetic expressions.
%
%   @error domain_error(possible_geometry, Item) if something stands there

sim_place(X0, Y0, Heading0) :-
    X is X0,
    Y is Y0,
    Heading is Heading0,
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
%   @error domain_error(world_item, Fact) if it is none of these

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

%!  sim_wait(+Seconds) is semidet.
%
%   Wait until so much simulated time has passed, as a program does with
%   sleep/1 on a brick. With the virtual clock this takes no longer than the
%   program's other threads let it. Seconds may be an arithmetic expression.
%
%   @error domain_error(seconds, Seconds) if it is negative

sim_wait(Seconds0) :-
    Seconds is Seconds0,
    sim_wait_(Seconds).

%   sim_hold_ and sim_release_ are for tests of several threads: in between,
%   no time passes on the virtual clock unless this thread waits.

:- public sim_hold_/0, sim_release_/0.
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

sim_press(Key, Options) :-
    must_be(list, Options),
    option(after(After), Options, 0),
    option(for(For), Options, 0.2),
    (   For == infinite
    ->  true
    ;   must_be(number, For)
    ),
    sim_plan_key_(Key, After, For).

%!  sim_step(+Seconds) is semidet.
%
%   Let so much simulated time pass at once, whatever the clock. Seconds may
%   be an arithmetic expression.
%
%   @error domain_error(seconds, Seconds) if it is negative

sim_step(Seconds0) :-
    Seconds is Seconds0,
    sim_step_(Seconds).

%!  sim_time(-Seconds) is semidet.
%
%   True if so much simulated time has passed since the start.

sim_time(Seconds) :-
    sim_time_(Seconds).

%!  sim_snapshot(-Snapshot) is semidet.
%!  sim_restore(+Snapshot) is semidet.
%
%   Keep everything as it is now, and put it back as it was: the robot, its
%   motors and sensors, the world and the time. So a program can try what
%   would happen. A Snapshot may be restored any number of times.

sim_snapshot(snapshot(State, Added)) :-
    sim_snapshot_(State),
    findall(Fact-Id, added(Fact, Id), Added).

sim_restore(Snapshot) :-
    must_be(nonvar, Snapshot),
    (   Snapshot = snapshot(State, Added)
    ->  true
    ;   domain_error(simulator_snapshot, Snapshot)
    ),
    sim_restore_(State),
    retractall(added(_, _)),
    forall(member(Fact-Id, Added), assertz(added(Fact, Id))).

%!  sim_collisions(-Collisions) is semidet.
%
%   True if Collisions is the list of `collision(Time, X, Y, Heading)` for
%   each time the robot ran into something, oldest first; the latest 256.

sim_collisions(Collisions) :-
    sim_collisions_(Collisions).

%!  sim_trace(-Trace) is semidet.
%
%   True if Trace is what happened, as a list of Time-Event in the order of
%   time. Event is one of
%
%     - pose(X, Y, Heading)
%       The robot was there. On long runs these are farther apart.
%     - written(File, Text)
%     - read(File, Text)
%       The program wrote a file, or read a value of a sensor.
%     - tone(Hertz)
%       The speaker made a tone; 0 is the end of it.
%     - said(Text)
%     - played(File)
%     - silenced
%       The program said something, played a recording, or ended one.
%     - pressed(Key)
%     - released(Key)
%       Somebody pressed a key, or let go of it.
%
%   The latest 4096 are kept of what was read, and of all the others.

sim_trace(Trace) :-
    sim_trace_(Trace0),
    findall(Time-Event, member(at(Time, Event), Trace0), Trace).

%!  sim_svg(+File) is semidet.
%
%   Write a picture of the world, the robot and its way to a file, as SVG.

sim_svg(File) :-
    sim_svg_(Text),
    setup_call_cleanup(
        open(File, write, Stream, [encoding(utf8)]),
        write(Stream, Text),
        close(Stream)).

%!  sim_mount(+Directory) is semidet.
%!  sim_mount(+Directory, +DevDirectory) is semidet.
%
%   Show the simulated files in a directory, through FUSE, so that programs in
%   any language can use them; until sim_unmount/0, or until Prolog halts.
%   Directory becomes what `/sys/class` is on a brick, and DevDirectory what
%   `/dev` is, with the screen `fb0` and the event devices:
%
%   ```
%   input/by-path/platform-gpio_keys-event
%   input/by-path/platform-sound-event
%   ```
%
%   They are regular files, which answer poll(2) and the ioctls that ask about
%   an event device. That they are no devices means that the screen cannot be
%   mapped into memory, and that who looks for devices only finds none.
%
%   @error existence_error(directory, Directory)
%   @error existence_error(device, '/dev/fuse') if this machine has no FUSE
%   @error existence_error(feature, fuse) if the pack was built without

sim_mount(Directory) :-
    absolute_file_name(Directory, Path),
    sim_mount_(Path, _).

sim_mount(Directory, DevDirectory) :-
    absolute_file_name(Directory, Path),
    absolute_file_name(DevDirectory, DevPath),
    sim_mount_(Path, DevPath).

%!  sim_unmount is semidet.
%
%   End what sim_mount/1 began. Fails if nothing is mounted.

sim_unmount :-
    sim_unmount_.

:- at_halt(unmount_at_halt).

unmount_at_halt :-
    (   predicate_property(ev3dev_sim:sim_unmount_, foreign)
    ->  ignore(sim_unmount_)
    ;   true
    ).
