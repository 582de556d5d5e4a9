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
                must_be_new_names/1, name_brick/3, named_brick/3,
                new_brick/1, unname_brick/1 ]).
:- use_module(private/simulation/random_seed,
              [begin_chance_of/1, end_chance/0, with_own_chance/1]).
:- use_module(private/files/facts,
              [located_facts/3, source_location/3, throw_located/3]).
:- use_module(private/simulation/time_limits,
              [clock_changes/1, forget_plans/0]).
:- use_module(private/simulation/schedule, [run_due_goals/0]).
:- use_module(private/simulation/thinking_rate, [thinking_rate/2]).
:- use_module(private/simulation/turn_order, []).
:- use_module(private/explain/hints, [tell_again/0]).
:- use_module(private/run/waits, [event_period/2]).
:- use_module(private/simulation/world_name, [note_world/2]).
:- use_module(sim_hand, [set_added_facts/1]).
:- reexport(sim_hand, except([added_facts/1, set_added_facts/1])).
:- reexport(sim_time).
:- reexport(sim_views).
:- use_module(private/native/native,
              [ sim_active_/0, sim_crowd_/4, sim_start_/4, sim_stop_/0,
                sim_unseen_/0 ]).

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

Worlds and robots are files of facts. docs/worlds.md lists the facts, the
worlds and robots of the pack, and what sensors measure. It also explains the
clocks, and how several threads share the virtual one.
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
%     - thinking(+Thinking)
%       What it costs to compute on the virtual clock: `free` (default), a
%       number of inferences that take a second, or `brick`, 100000. At its
%       next use of the robot the time passes that a thread has computed
%       since the last one. So a program that searches while its robot drives
%       does what it does on a brick, and the same each time in one version of
%       Prolog. The flag `ev3dev_watchdog` holds for this time.
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
%   @error domain_error(thinking, Thinking)
%   @error permission_error(think, clock, Clock) if that is not virtual
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
                    [ clock, robot, robots, noise, screen, seed, thinking ],
                    Options),
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
    thinking_rate(Options, Rate),
    must_think(Rate, Clock),
    located_facts(world, World, LocatedWorld),
    pairs_keys(LocatedWorld, WorldFacts),
    Native = options(Clock, Seed, Noise, Bits, Rate),
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
    ),
    tell_again.

%   The robots that sim_start/2 has made bricks, unless they were closed.
:- dynamic robot_of_crowd/1.            % Brick
:- volatile robot_of_crowd/1.

%   Each robot gets a brick. Nothing is left of them if one cannot start.

crowd_started(Robots, World, LocatedWorld, WorldFacts, Native, Options) :-
    must_be(list, Robots),
    findall(Name-robot(Robot, Located),
            ( member(Item, Robots), robot_named(Item, Name, Robot, Located) ),
            Pairs),
    pairs_keys(Pairs, Names),
    must_be_new_names(Names),
    must_have_starts(World, WorldFacts, Names),
    setup_call_cleanup(
        findall(robot(Brick, Name, Facts),
                ( member(Name-robot(_, Located), Pairs),
                  pairs_keys(Located, Facts), new_brick(Brick) ),
                Natives),
        ( forall(member(robot(Brick, _, _), Natives),
                 in_brick(Brick, ( set_added_facts([]),
                                   note_world(World, Options) ))),
          % Pages show the first one from now on.
          sim_crowd_(WorldFacts, Natives, Native, Fault),
          must_be_faultless_crowd(Fault, world(World, LocatedWorld), Pairs),
          forall(member(robot(Brick, Name, _), Natives),
                 ( name_brick(Name, Brick, sim(World)),
                   assertz(robot_of_crowd(Brick)) )),
          until_seen(500),
          Started = true ),
        (   Started == true
        ->  true
        ;   forall(member(robot(Brick, _, _), Natives), end_brick(Brick))
        )).

%   If a page looks, no time passes until it shows the robots.
until_seen(Looks) :-
    (   Looks > 0,
        sim_unseen_
    ->  sleep(0.02),
        Looks1 is Looks - 1,
        until_seen(Looks1)
    ;   true
    ).

robot_named(Item, Name, Robot, Located) :-
    must_be(nonvar, Item),
    (   Item = Name-Robot
    ->  must_be(atom, Name),
        located_facts(robot, Robot, Located)
    ;   throw_error(type_error(pair, Item), _,
                    'a robot is Name-Robot, as bob-default')
    ).

must_have_starts(World, WorldFacts, Names) :-
    (   member(Name, Names),
        \+ memberchk(start(Name, _, _, _), WorldFacts)
    ->  format(atom(Why),
               'has no place for the robot ~q: add start(~q, X, Y, Heading)',
               [Name, Name]),
        source_location(world, World, Location),
        throw_located(domain_error(possible_geometry, World), Location, Why)
    ;   true
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

must_think(Rate, Clock) :-
    (   Rate =\= 0,
        Clock \== virtual
    ->  throw_error(permission_error(think, clock, Clock), _,
                    'by the clock of the wall thinking takes its own time: \c
                     add clock(virtual)')
    ;   true
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
%   End the simulation. Fails if none runs. After sim_start/2 with robots(_)
%   all robots are closed, unless the brick in use is one of them. The tree
%   that ev3_sysfs/1 or the environment had set before is in use again. If
%   none was set, the next use of a device chooses one, as the first use of
%   the program does: on a computer that is not an EV3 it starts a new
%   simulation of the world `room`.

sim_stop :-
    \+ sim_active_,
    robot_of_crowd(Brick),
    named_brick(_, Brick, _),
    !,
    forall(( retract(robot_of_crowd(Robot)), named_brick(Name, Robot, _) ),
           ( unname_brick(Name), end_brick(Robot) )).
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
