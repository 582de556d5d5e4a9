:- module(ev3dev_sim,
          [ sim_start/1,                % +World
            sim_start/2,                % +World, +Options
            sim_stop/0,
            with_sim/2,                 % +World, :Goal
            with_sim/3                  % +World, :Goal, +Options
          ]).
:- set_prolog_flag(generate_debug_info, false).
:- use_module(private/load/compiled, []).
:- use_module(private/checks/checks, [must_be/2, must_be_goal/1]).
:- use_module(private/errors/errors,
              [domain_error/2, existence_error/2, throw_error/3]).
:- use_module(private/errors/frames, [goal_of_program/1]).
:- use_module(private/errors/public_clauses, [term_expansion/4]).
:- use_module(library(lists), [member/2, nth1/3]).
:- use_module(library(pairs), [pairs_keys/2]).
:- use_module(private/checks/arguments,
              [must_be_options/3, option/2, option/3]).
:- use_module(private/run/brick,
              [ end_brick/1, in_brick/2, in_new_brick/1,
                must_be_new_names/1, name_brick/3, new_brick/1 ]).
:- use_module(private/simulation/random_seed,
              [begin_chance_of/1, end_chance/0, with_own_chance/1]).
:- use_module(private/files/facts,
              [located_facts/3, source_location/3, throw_located/3]).
:- use_module(private/simulation/time_limits,
              [clock_changes/1, forget_plans/0]).
:- use_module(private/simulation/schedule, [run_due_goals/0]).
:- use_module(private/simulation/turn_order, []).
:- use_module(private/run/waits, [event_period/2]).
:- use_module(private/simulation/world_name, [note_world/2]).
:- use_module(sim_hand, [set_added_facts/1]).
:- reexport(sim_hand, except([added_facts/1, set_added_facts/1])).
:- reexport(sim_time).
:- reexport(sim_views).
:- use_module(private/native/native,
              [sim_active_/0, sim_crowd_/4, sim_start_/4, sim_stop_/0]).

:- meta_predicate
    with_sim(+, 0),
    with_sim(+, 0, +).

/** <module> A simulated robot in a simulated world

An ev3dev brick with motors and sensors, and wheels or not, in a flat world.
It behaves like a real brick: while a simulation runs, all predicates of
library(ev3dev) work on it.

```
?- sim_start(room).
?- set_robot(5.6, 10.6, outB, outC).
?- go_cm(30, 20), us_dist_cm(_, Distance).
Distance = 96.9.
?- sim_pose(X, Y, Heading).
X = 52.9, Y = 55.4, Heading = 40.0.
```

Lengths are in centimeters and angles in degrees. X goes to the right and y
up; heading 0 looks along y, and clockwise is positive, as in turn/2.

All predicates but sim_start/1,2 and with_sim/2,3 fail if no simulation runs.

## Worlds {#sim-worlds}

A world is a file of facts. The simulator reads the file and does not run it.
It may contain any number of

  - bounds(X1, Y1, X2, Y2)
    Walls around everything, from the lower left to the upper right corner.
  - wall(X1, Y1, X2, Y2)
  - wall(X1, Y1, X2, Y2, Thickness)
    A wall from a point to another, 1 cm thick by default.
  - box(X, Y, Width, Depth)
  - box(X, Y, Width, Depth, Heading)
    A box by its middle. The depth is along its heading, by default 0.
  - circle(X, Y, Radius)
    A round obstacle, for example a pillar.
  - floor(Color)
    The floor, by default white: one of `black`, `blue`, `green`, `yellow`,
    `red`, `white` and `brown`, or `'#rrggbb'`.
  - patch(Color, Corners)
    A colored piece of floor with at least three Corners, each a place
    `X-Y`. Patches and lines cover those before them.
  - line(Color, Width, Places)
    A line on the floor through at least two Places, each `X-Y`.
  - lamp(X, Y, Intensity)
  - lamp(X, Y, Intensity, Port)
    A lamp, 30 cm above the floor. An output port in the mode `dc-motor` or
    `led` switches a lamp with a Port, see port_mode/2. Intensity is the
    percentage that col_ambient/2 shows when the sensor looks at the lamp from
    100 cm. The light decreases with the square of the distance; obstacles
    cast shadows.
  - beacon(X, Y, Channel)
    An infrared beacon on a channel from 1 to 4, see ir_beacon/4. A sensor
    sees it from up to 200 cm, if nothing stands between.
  - ambient(Percent)
    Light from everywhere, by default 2.
  - temperature(Celsius)
    The temperature of the air, by default 21.5.
  - loudness(Percent)
    The loudness, by default 0: see nxt_sound/2.
  - start(X, Y, Heading)
    The robot's start, by default at 0, 0 with heading 0.
  - start(Name, X, Y, Heading)
    The start of the robot Name, if there are several.
  - map(CellSize, Rows)
    A drawn world. Rows are strings or atoms, with a character for each cell;
    the lower left corner of the last row is at 0, 0. `#` is a wall, `O` a
    pillar, `.` or a space floor, `L` a lamp, `^`, `>`, `v` or `<` the start
    and its heading, `S` a start with heading 0; `k`, `b`, `g`, `y`, `r`, `w`
    and `n` are black, blue, green, yellow, red, white and brown floor.

The pack has the worlds `room` with walls and boxes, `lights` with a lamp,
`line` with a track, `grid` with boxes in cells of 20 cm, `maze`, and `sumo`,
a ring; for several robots `dohyo`, another ring, and `convoy`, a lane.

## Robots {#sim-robots}

A robot is a file of facts, too:

  - left_wheel(Port, Diameter)
  - left_wheel(Port, Diameter, Options)
  - right_wheel(Port, Diameter)
  - right_wheel(Port, Diameter, Options)
    The wheels by the ports of their motors. Options are `inverted(true)` for
    a motor that is mounted the other way round, and `slip(Share)` for the
    part of its distance that the wheel loses, from 0 to less than 1.
  - axle(Length)
    The distance between the wheels.
  - hull(circle(Radius))
  - hull(rectangle(Width, Length, Offset))
    The outline, around the middle of the axle; the middle of a rectangle is
    Offset ahead of it.
  - mass(Kilograms)
    The mass. A robot that drives needs two wheels, an axle, a hull and a
    mass. One without wheels and axle needs a motor or a sensor, and stays at
    its start; its hull is by default that of a brick.
  - motor(Port, Type)
  - motor(Port, Type, Options)
    A motor: `'lego-ev3-l-motor'`, `'lego-ev3-m-motor'`, `'lego-nxt-motor'`,
    or one of the linear actuators `'act-l12-ev3-50'` and `'act-l12-ev3-100'`.
    The robot must have a motor at the port of each wheel. The option
    `stops(Min, Max)` is for motors that turn no wheel: the angles in degrees,
    from where the shaft is at the start, at which it stalls, and from which
    it only turns back.
  - sensor(Port, Type, X, Y, Heading)
    A sensor, X to the right and Y ahead of the middle of the axle, of any
    type that ev3dev knows, see [below](#sim-sensors).
  - noise(Port, Sigma, Bias)
    The errors of a device that an earlier fact names: a random error with the
    standard deviation Sigma, and the constant error Bias, in units of the
    sensor's value. For a motor both are in percent; Bias makes the motor
    stronger than others. For a gyro, Bias is a drift in degrees per second.
  - encoder_noise(Port, Sigma)
    The error of the encoder of a motor that an earlier fact names: the
    standard deviation, in degrees, of the error of each tooth of its disc, by
    default 0. The error of `position` is the same whenever the shaft is at
    the same angle.
  - echo(Port, Options)
    What the ultrasonic sensor hears that an earlier fact names: how far its
    cone goes to each side, half_angle(Degrees), 15 by default; from which
    incidence(Degrees) on a slanted surface sends no echo, 90 by default,
    which is never; and which share of its samples misses all echoes,
    miss(Share), or hears something nearer where nothing is, spurious(Share),
    both 0 by default.

The pack has two robots: `default`, the robot of
set_robot(5.6, 10.6, outB, outC), with an ultrasonic sensor at in1, color
sensors on its left at in2 and on its right at in3, and a gyro at in4; and
`touch`, with a bumper at in4.

## Sensors {#sim-sensors}

Of the EV3's own sensors, a color sensor sees the floor below it and the lamps
ahead of it; a touch sensor is a bumper, 8 cm wide; and the infrared sensor
sees beacons up to 60 degrees aside, where it shows the heading 25, and
receives remote controls, see sim_remote/2.

LEGO's sensors for the NXT do the same, and measure temperature and loudness.
For a compass the y axis points north. HiTechnic's infrared seeker looks for
beacons, too; an angle sensor sits on the axle of the left wheel, an
accelerometer lies flat and measures gravity alone, and a proximity detector
sees things within 25 cm.

The world is flat: no robot falls over, and a gyro measures only turns around
the upright axis. So a program that balances cannot be tested here.

The other types of sensor_mode/6 have nothing to measure in this world. They
exist, with all their modes, and always show the same: the air has 1013 mbar,
boxes for motors and servos have 6 V, a camera sees nothing.

An NXT sensor that is only a voltage appears as `nxt-analog`, as on a brick,
except for the light sensor. The program names its type by port_device/2.

## Time {#sim-time}

With the clock `realtime`, simulated time passes as fast as real time, with
`scaled(Factor)` Factor times as fast.

With the clock `virtual`, the program's own computing takes no time at all.
When a predicate of library(ev3dev) waits, for example go_cm/2, time jumps to
the end of the wait; so a minute's drive takes milliseconds. Each read of a
file takes 0.5 ms and each write 0.1 ms, so time also passes for a program
that polls a sensor in a loop. sleep/1 lets no simulated time pass;
wait/1 does. While a program waits for a button that no sim_press/2 will
press, time passes at most 20 times as fast as real time.

If there are several threads, one runs at a time, in the order of simulated
time. The others wait at their next call. The turn passes on when a thread
waits, ends, or sleeps elsewhere: in thread_join/2, for a message, at the
terminal. While a thread computes, time stands, so a thread must not loop
until another one changes a fact: it should wait by wait/1, or for a message.
The same program with the same seed does the same each time, unless it sleeps
by real time (sleep/1, timeouts) or waits for a person.
*/

%!  sim_start(+World) is det.
%!  sim_start(+World, +Options) is det.
%
%   Start a simulation in place of the running one, and use its tree of
%   devices. World is the name of a world of the pack, a file, or a list of
%   facts. Options:
%
%     - clock(+Clock)
%       `realtime` (default), `scaled(Factor)` or `virtual`.
%     - robot(+Robot)
%       The robot, given like World. Default is `default`.
%     - robots(+Robots)
%       Several robots: a list of Name-Robot, each Robot given like World.
%       Each becomes a brick Name of library(ev3dev/bricks), with a processor
%       of its own; the brick in use stays what it is. The world has a fact
%       `start(Name, X, Y, Heading)` for each. They have one time, and see and
%       push each other. sim_snapshot/1 is not for them. When one is closed,
%       it stays where it is.
%     - noise(+Boolean)
%       If `true`, sensors and motors have errors like real ones, and encoders
%       an error of half a degree, unless the robot has facts about its own.
%       Default is `false`.
%     - seed(+Integer)
%       The random seed of the noise, and of the numbers that this thread
%       draws with random/1, random_between/3 and so on, also in race/2, until
%       the simulation ends. Then the thread goes on with its numbers of
%       before. Default is 1; but without the option only the virtual clock
%       seeds the numbers of the thread. Other threads call set_random/1
%       themselves.
%     - screen(+Bits)
%       The bits per pixel of the screen: 32 (default) or 1, as with older
%       versions of ev3dev.
%
%   If the simulation cannot start, nothing changes. An error in a file is
%   thrown as `error(Formal, fact(Location, Message))`, and is printed with
%   file and line. Location is `file(File, Line, LinePosition, CharNo)`, or
%   `file(File)` if a fact is missing.
%
%   @error existence_error(world, World)
%   @error existence_error(robot, Robot)
%   @error domain_error(world_fact, Fact) if a world has no such facts
%   @error domain_error(robot_fact, Fact) if a robot has no such facts
%   @error domain_error(possible_geometry, Fact)
%   @error domain_error(possible_geometry, Robot) if the robot lacks a part
%   @error domain_error(map_row, Row) for an unknown character or a second
%          start
%   @error domain_error(clock, Clock)
%   @error domain_error(sim_option, Option) if Option is not an option of this
%          predicate
%   @error domain_error(screen_bits, Bits)
%   @error permission_error(open, brick, Name) if there is one of that name
%   @error existence_error(feature, sim) if the pack was built without the
%          simulator

sim_start(World) :-
    sim_start(World, []).

sim_start(World, Options) :-
    must_be_built,
    must_be_options(sim_option,
                    [clock, robot, robots, noise, screen, seed], Options),
    option(clock(Clock0), Options, realtime),
    option(seed(Seed), Options, 1),
    option(noise(Noise), Options, false),
    option(robot(Robot), Options, default),
    option(screen(Bits), Options, 32),
    must_be_clock(Clock0),
    clock_here(Clock0, Clock),
    must_be(integer, Seed),
    must_be(boolean, Noise),
    must_be_screen(Bits),
    located_facts(world, World, LocatedWorld),
    pairs_keys(LocatedWorld, WorldFacts),
    Native = options(Clock, Seed, Noise, Bits),
    (   option(robots(Robots), Options)
    ->  crowd_started(Robots, World, LocatedWorld, WorldFacts, Native,
                      Options)
    ;   located_facts(robot, Robot, LocatedRobot),
        pairs_keys(LocatedRobot, RobotFacts),
        clock_changes(( sim_start_(WorldFacts, RobotFacts, Native, Fault),
                        forget_plans_if(Fault)
                      )),
        must_be_faultless(Fault, world(World, LocatedWorld),
                          robot(Robot, LocatedRobot)),
        set_added_facts([]),
        begin_chance_of(Options),
        note_world(World, Options)
    ).

%   Each robot gets a brick. Nothing is left of them if one cannot start.

crowd_started(Robots, World, LocatedWorld, WorldFacts, Native, Options) :-
    must_be(list, Robots),
    findall(Name-robot(Robot, Located),
            ( member(Item, Robots), robot_named(Item, Name, Robot, Located) ),
            Pairs),
    pairs_keys(Pairs, Names),
    must_be_new_names(Names),
    setup_call_cleanup(
        findall(robot(Brick, Name, Facts),
                ( member(Name-robot(_, Located), Pairs),
                  pairs_keys(Located, Facts), new_brick(Brick) ),
                Natives),
        ( sim_crowd_(WorldFacts, Natives, Native, Fault),
          must_be_faultless_crowd(Fault, world(World, LocatedWorld), Pairs),
          forall(member(robot(Brick, Name, _), Natives),
                 ( in_brick(Brick, ( set_added_facts([]),
                                     note_world(World, Options) )),
                   name_brick(Name, Brick, sim(World)) )),
          Started = true ),
        (   Started == true
        ->  true
        ;   forall(member(robot(Brick, _, _), Natives), end_brick(Brick))
        )).

robot_named(Item, Name, Robot, Located) :-
    must_be(nonvar, Item),
    (   Item = Name-Robot
    ->  must_be(atom, Name),
        located_facts(robot, Robot, Located)
    ;   throw_error(type_error(pair, Item), _,
                    'a robot is Name-Robot, as bob-default')
    ).

must_be_faultless_crowd(Fault, World, Pairs) :-
    (   Fault = fault(robot(Number), Index, Why)
    ->  nth1(Number, Pairs, _-Robot),
        must_be_faultless(fault(robot, Index, Why), World, Robot)
    ;   must_be_faultless(Fault, World, none)
    ).

forget_plans_if(Fault) :-
    (   Fault == none
    ->  forget_plans
    ;   true
    ).

must_be_built :-
    (   predicate_property(sim_active_, foreign)
    ->  true
    ;   existence_error(feature, sim)
    ).

must_be_clock(Clock) :-
    must_be(nonvar, Clock),
    (   clock(Clock)
    ->  true
    ;   domain_error(clock, Clock)
    ).

%   If there are no threads, a page lets time pass, and has its own pace.
clock_here(Clock0, Clock) :-
    (   current_prolog_flag(threads, false)
    ->  Clock = virtual
    ;   Clock = Clock0
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

%   A fault names a fact by its place in the list, or 0 if a fact is missing.
must_be_faultless(none, _, _) :-
    !.
must_be_faultless(fault(world, Index, Why), world(World, Located), _) :-
    throw_fault(world, World, Located, Index, Why).
must_be_faultless(fault(robot, Index, Why), _, robot(Robot, Located)) :-
    throw_fault(robot, Robot, Located, Index, Why).

throw_fault(_, _, Located, Index, Why) :-
    nth1(Index, Located, Fact-Location),
    !,
    throw_located(domain_error(possible_geometry, Fact), Location, Why).
throw_fault(Kind, Source, _, _, Why) :-
    source_location(Kind, Source, Location),
    throw_located(domain_error(possible_geometry, Source), Location, Why).

%!  sim_stop is semidet.
%
%   End the simulation. Fails if none runs. The tree that ev3_sysfs/1 or the
%   environment had set before is in use again. If none was set, the next use
%   of a device chooses one, as the first use of the program does: on a
%   computer that is not an EV3 it starts a new simulation of the world
%   `room`.

sim_stop :-
    clock_changes(( sim_stop_, forget_plans )),
    set_added_facts([]),
    end_chance.

%!  with_sim(+World, :Goal) is semidet.
%!  with_sim(+World, :Goal, +Options) is semidet.
%
%   Call Goal once in its own simulation, which ends with it. So a test starts
%   from the same state each time. A simulation that runs already is the same
%   after Goal; on the virtual clock its time stands still meanwhile. Goal
%   begins without what the program knows of its robot: set_robot/4 and
%   drive_option/2, the grid with its obstacles, the events of this thread,
%   the drawing on the screen, the white of col_white/1, exogenous actions
%   that wait. After Goal the program knows all this again, and nothing of
%   what Goal did. Only rules and other clauses of the program are the same in
%   Goal.
%
%   ```
%   :- use_module(library(ev3dev)).
%   :- use_module(library(ev3dev/sim)).
%
%   :- begin_tests(robot).
%
%   test(square, true(Collisions == [])) :-
%       with_sim(room, ( square, sim_collisions(Collisions) )).
%
%   :- end_tests(robot).
%   ```
%
%   Options are those of sim_start/2, but the default clock is `virtual`.
%
%   @error as sim_start/2

with_sim(World, Goal) :-
    with_sim(World, Goal, []).

with_sim(World, Goal, Options) :-
    must_be_goal(Goal),
    must_be(list, Options),
    (   option(clock(_), Options)
    ->  WithClock = Options
    ;   WithClock = [clock(virtual)|Options]
    ),
    setup_call_cleanup(
        event_period(Period, []),
        with_own_chance(
            in_new_brick(in_sim(World, WithClock, Goal))),
        event_period(_, Period)).

in_sim(World, Options, Goal) :-
    sim_start(World, Options),
    once(goal_of_program(Goal)).
