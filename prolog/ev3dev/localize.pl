:- module(ev3dev_localize,
          [ localize_start/1,           % +Map
            localize_start/2,           % +Map, +Options
            localize_stop/0,
            localize_reset/0,
            localize_scan/0,
            localize_scan/1,            % +Options
            localize_step/2,            % -Centimeters, -Step
            localized_pose/4,           % -X, -Y, -Heading, -Covariance
            localized/1,                % -Confidence
            localized_clusters/1,       % -Clusters
            particles/1                 % -Particles
          ]).
:- set_prolog_flag(generate_debug_info, false).
:- use_module(private/load/compiled, []).
:- use_module(private/checks/checks, [must_be/2]).
:- use_module(private/errors/errors, [domain_error/2]).
:- use_module(private/errors/public_clauses, [term_expansion/4]).
:- use_module(private/explain/hints).
:- use_module(driver, []).
:- use_module(private/checks/arguments,
              [ must_be_options/3, must_be_within/4, number_option/4,
                number_value/2, number_value/3, option/2, option/3
              ]).
:- use_module(private/run/brick, [brick/1, of_brick/1]).
:- use_module(private/maps/roadmap_arguments,
              [roadmap_facts/2, sensor_option/2]).
:- use_module(private/devices/robot_state,
              [drive_default/2, robot_description/1]).
:- use_module(private/native/native,
              [ localize_at_/3, localize_best_/5, localize_clusters_/2,
                localize_correct_/3, localize_new_/3, localize_particles_/2,
                localize_reset_/1, localize_step_/6, localize_sure_/4
              ]).
:- use_module(drive, [drive_cm/2, drive_wait/2]).
:- use_module(events, [event_cancel/1, every/3]).
:- use_module(robot, [stop/0]).
:- use_module(sensors, [gyro_sensor/1, us_dist_cm/2]).

/** <module> Where am I?

A robot that has a map of its room finds out where it is by its ultrasonic
sensor, and follows that while it drives. This is Monte Carlo localization:
many poses, the particles, of which those become more probable that explain
what the sensor measures.

```
?- sim_start(room), set_robot(5.6, 10.6, outB, outC).
?- localize_start(room).                % the world is the map, too
?- localize_scan.                       % turns once around, looking
?- localized_pose(X, Y, Heading, _), localized(Confidence).
?- go_cm(30, 40), localized_pose(X, Y, Heading, _).
```

A robot that may be anywhere has no pose until it has looked around. The
measurements of this turn are compared with the whole map. From there a
particle filter follows the robot, in the thread that called localize_start/1
and while that thread waits, as events do (library(ev3dev/events)). If the
measurements no longer fit any pose, somebody has carried the robot away:
localized/1 drops, and the next look around begins a new search.

Sources: Thrun, Burgard, Fox: Probabilistic Robotics (2005), chapters 6 and 8.
*/

%   localizer(Brick, Localizer, Correct)
:- dynamic localizer/3.
:- volatile localizer/3.
:- of_brick([localizer/3]).

%!  localize_start(+Map) is semidet.
%!  localize_start(+Map, +Options) is semidet.
%
%   Begin to look where the robot is. Map is a world: a name, a file, or a
%   list of facts, which also has polygons as for roadmap_path/5. Only its
%   bounds and obstacles count. Fails if no robot is set. Options:
%
%     - start(+Start)
%       `unknown` (default), `pose(X, Y, Heading)`, or
%       `pose(X, Y, Heading, Sigma)`: Sigma is the standard deviation in cm,
%       2 by default, and half of it in degrees.
%     - correct_odometry(+Boolean)
%       If `true`, pose/3 follows: go_to/2, the grid and navigate_to/3 keep to
%       the map. Default is `false`. A move under way is not corrected by more
%       than 20 cm or 20 degrees at once.
%     - every(+Seconds)
%       How often it measures while this thread waits. Default is 0.1; with 0
%       only localize_step/2 and localize_scan/0 measure.
%     - particles(+Count)
%       From 1 to 100000. By default as many as the uncertainty asks for, from
%       500 to 5000.
%     - update(+Cm, +Degrees)
%       The way or turn after which a measurement counts. Default is
%       update(2, 4).
%     - model(+List)
%       The model of the sensor: half_angle(Degrees) of its cone, 15;
%       sigma(Cm, Share), its standard deviation, 2 cm and 0.02 of the
%       distance; the shares hit(H), 0.75, short(S), of things that the map
%       lacks, 0.10, missing(M), of echoes not heard, 0.08, and random(R),
%       0.07; and exponent(E), 0.6, to which a likelihood is raised, as
%       measurements near to one another err in the same way.
%     - wander(+Way, +Turn, +Drift)
%       The standard deviations of a move: in cm after 1 cm, and in degrees
%       after a turn by 1 degree and after 1 cm; they grow with the square
%       root of the way. Default is wander(0.1, 0.12, 0.2) with a gyro, and
%       wander(0.1, 0.2, 0.5) without.
%     - sensor(+X, +Y, +Heading)
%       The place of the ultrasonic sensor, as for navigate_to/3.
%     - radius(+Cm)
%       The radius of the robot's hull. Default is 8.
%     - seed(+Integer)
%       Of the random numbers. Default is 1.
%     - table(+Boolean)
%       Whether to calculate beforehand what is measured where, in steps of 5
%       cm and 5 degrees. `true` by default on the EV3, whose processor
%       calculates slowly.
%     - search(+Boolean)
%       If `false`, particles are spread over the map at once, and weighed by
%       one measurement after the other, as textbooks have it. Soon they are
%       sure of some place, often a wrong one. Default is `true`.
%
%   @error existence_error(world, Map)
%   @error domain_error(possible_geometry, Facts) if it has nothing, or no
%          place that is wide enough
%   @error domain_error(localize_option, Option)
%   @error domain_error(localize_start, Start)

localize_start(Map) :-
    localize_start(Map, []).

localize_start(Map, Options) :-
    must_be_options(localize_option,
                    [ start, correct_odometry, every, particles, update/2,
                      model, wander/3, sensor/3, radius, seed, table, search
                    ], Options),
    roadmap_facts(Map, Facts),
    option(start(Start0), Options, unknown),
    start_meant(Start0, Start),
    option(correct_odometry(Correct), Options, false),
    must_be(boolean, Correct),
    number_option(every(Seconds), seconds, Options, 0.1),
    number_option(radius(Radius), positive_number, Options, 8),
    sensor_option(Options, Sensor),
    option(model(Model0), Options, []),
    model(Model0, Model),
    wander(Options, Wander),
    particle_count(Options, Count),
    update(Options, Update),
    option(seed(Seed), Options, 1),
    must_be(integer, Seed),
    option(search(Search), Options, true),
    must_be(boolean, Search),
    option(table(Table), Options, auto),
    (   Table == auto
    ->  true
    ;   must_be(boolean, Table)
    ),
    robot_description(_),
    localize_new_(Facts,
                  options(Radius, Sensor, Model, Wander, Count, Update, Seed,
                          Search, Table),
                  Localizer),
    start_at(Start, Localizer),
    brick(Brick),
    with_mutex(ev3dev_localize,
               ( retractall(localizer(Brick, _, _)),
                 assertz(localizer(Brick, Localizer, Correct)) )),
    (   Seconds > 0
    ->  every(Seconds, ev3dev_localize:watch, [id(localize)])
    ;   true
    ).

start_meant(Start0, Start) :-
    must_be(nonvar, Start0),
    (   Start0 == unknown
    ->  Start = unknown
    ;   Start0 = pose(X, Y, Heading)
    ->  start_meant(pose(X, Y, Heading, 2), Start)
    ;   Start0 = pose(X0, Y0, Heading0, Sigma0)
    ->  number_value(X0, X),
        number_value(Y0, Y),
        number_value(Heading0, Heading),
        number_value(nonnegative_number, Sigma0, Sigma),
        Start = pose(X, Y, Heading, Sigma)
    ;   domain_error(localize_start, Start0)
    ).

start_at(unknown, _).
start_at(pose(X, Y, Heading, Sigma), Localizer) :-
    localize_at_(Localizer, pose(X, Y, Heading), Sigma).

model(Options, model(HalfAngle, Sigma, Share, Hit, Short, Missing, Random,
                     Exponent)) :-
    must_be_options(localize_model,
                    [ half_angle, sigma/2, hit, short, missing, random,
                      exponent ], Options),
    number_option(half_angle(HalfAngle), positive_number, Options, 15),
    (   option(sigma(Sigma0, Share0), Options)
    ->  number_value(positive_number, Sigma0, Sigma),
        number_value(nonnegative_number, Share0, Share)
    ;   Sigma = 2,
        Share = 0.02
    ),
    number_option(hit(Hit), positive_number, Options, 0.75),
    number_option(short(Short), nonnegative_number, Options, 0.10),
    number_option(missing(Missing), positive_number, Options, 0.08),
    number_option(random(Random), positive_number, Options, 0.07),
    number_option(exponent(Exponent), positive_number, Options, 0.6).

wander(Options, wander(Way, Turn, Drift)) :-
    (   option(wander(Way0, Turn0, Drift0), Options)
    ->  number_value(nonnegative_number, Way0, Way),
        number_value(nonnegative_number, Turn0, Turn),
        number_value(nonnegative_number, Drift0, Drift)
    ;   drive_default(use_gyro, true),
        gyro_sensor(_)
    ->  Way = 0.1, Turn = 0.12, Drift = 0.2
    ;   Way = 0.1, Turn = 0.2, Drift = 0.5
    ).

particle_count(Options, Count) :-
    (   option(particles(Count), Options)
    ->  must_be_within(1, 100000, particles, Count)
    ;   Count = 500-5000
    ).

update(Options, update(Way, Turn)) :-
    (   option(update(Way0, Turn0), Options)
    ->  number_value(nonnegative_number, Way0, Way),
        number_value(nonnegative_number, Turn0, Turn)
    ;   Way = 2,
        Turn = 4
    ).

localizer_now(Localizer, Correct) :-
    brick(Brick),
    (   localizer(Brick, Localizer, Correct)
    ->  true
    ;   fail_because(no_localizer)
    ).

%!  localize_stop is semidet.
%
%   Look no longer where the robot is. Fails if it does not.

localize_stop :-
    brick(Brick),
    with_mutex(ev3dev_localize, retract(localizer(Brick, _, _))),
    !,
    ignore(event_cancel(localize)).

%!  localize_reset is semidet.
%
%   The robot may be anywhere: somebody has carried it away.

localize_reset :-
    localizer_now(Localizer, _),
    localize_reset_(Localizer).

%   It goes on without a sensor, until one is plugged in again.
watch :-
    brick(Brick),
    (   localizer(Brick, Localizer, Correct)
    ->  ignore(measured(Localizer, Correct, _, _, _))
    ;   ignore(event_cancel(localize))
    ).

measured(Localizer, Correct, Centimeters, Step, Turned) :-
    robot_description(Robot),
    drive_default(use_gyro, UseGyro),
    once(us_dist_cm(_, Centimeters)),
    localize_step_(Localizer, Robot, UseGyro, Centimeters, Step, Turned),
    (   Correct == true,
        Step \== nothing
    ->  ignore(localize_correct_(Localizer, Robot, UseGyro))
    ;   true
    ).

%!  localize_step(-Centimeters, -Step) is semidet.
%
%   Measure once, and learn from it. Step is
%
%     - nothing
%       The robot has hardly moved, or has not looked around yet.
%     - tracked
%       The poses that are possible have been weighed.
%     - found
%       A whole turn has been searched for on the map.
%     - lost
%       What is measured fits no pose any more.
%
%   Fails without a localization, a robot or an ultrasonic sensor.

localize_step(Centimeters, Step) :-
    localizer_now(Localizer, Correct),
    measured(Localizer, Correct, Centimeters, Step, _).

%!  localize_scan is semidet.
%!  localize_scan(+Options) is semidet.
%
%   Turn once around on the spot and measure. Waits, 10 s by default. Fails if
%   it has not found where it is. Options:
%
%     - rate(+DegreesPerSecond)
%       Default is 36. Where it turns more than 5 degrees between two
%       measurements, one turn may not be enough.
%     - turns(+Count)
%       The most turns, if one is not enough. Default is 1.
%     - reason(-Reason)
%       Do not fail, but report why: `reached`; `unsure`; or, as the move
%       ended so, `stalled`, `stopped`, `astray` or `unplugged`.
%
%   @error domain_error(localize_scan_option, Option)

localize_scan :-
    localize_scan([]).

localize_scan(Options) :-
    must_be_options(localize_scan_option, [rate, turns, reason], Options),
    number_option(rate(Rate), positive_number, Options, 36),
    option(turns(Turns), Options, 1),
    must_be_within(1, 100, turns, Turns),
    localizer_now(Localizer, Correct),
    robot_description(Robot),
    drive_default(use_gyro, UseGyro),
    setup_call_cleanup(
        drive_cm(0, Rate),
        scanned(Localizer, Turns, Ended),
        ignore(stop)),
    (   Correct == true
    ->  % The motion ends when the drive notices the stop.
        ignore(drive_wait([timeout(0.5)], _)),
        ignore(localize_correct_(Localizer, Robot, UseGyro))
    ;   true
    ),
    localize_sure_(Localizer, _, _, MustLook),
    (   Ended \== reached
    ->  Why = Ended
    ;   MustLook == true
    ->  Why = unsure
    ;   Why = reached
    ),
    explain("look around: ~w", [Why]),
    option(reason(Reason), Options, reached),
    Reason = Why.

scanned(Localizer, Turns, Ended) :-
    (   measured(Localizer, false, _, _, From)
    ->  scanned(From, Turns, Localizer, Ended)
    ;   Ended = unplugged
    ).

scanned(From, Turns, Localizer, Ended) :-
    drive_wait([timeout(0.05)], Why),
    (   Why \== timeout
    ->  Ended = Why
    ;   measured(Localizer, false, _, _, Turned)
    ->  Gone is abs(Turned - From),
        (   Gone < 365
        ->  scanned(From, Turns, Localizer, Ended)
        ;   Turns > 1,
            localize_sure_(Localizer, _, _, true)
        ->  Left is Turns - 1,
            scanned(Turned, Left, Localizer, Ended)
        ;   Ended = reached
        )
    ;   Ended = unplugged
    ).

%!  localized_pose(-X, -Y, -Heading, -Covariance) is semidet.
%
%   The middle of the most probable cluster of poses, on the map, moved on by
%   odometry since the last measurement. Heading is from -180 to 180.
%   Covariance is as for pose_uncertainty/1. Fails as long as nothing is
%   known; localized/1 says how sure it is.

localized_pose(X, Y, Heading, Covariance) :-
    localizer_now(Localizer, _),
    robot_description(Robot),
    drive_default(use_gyro, UseGyro),
    localize_best_(Localizer, Robot, UseGyro, pose(X, Y, Heading),
                   Covariance).

%!  localized(-Confidence) is semidet.
%
%   How sure it is of localized_pose/4, from 0 to 1: the share of the
%   probability that this cluster has, times how well the measurements of late
%   fit. Below 0.35 it is lost. Where two places look alike neither gets
%   more than about a half.

localized(Confidence) :-
    localizer_now(Localizer, _),
    localize_sure_(Localizer, Confidence, _, _).

%!  localized_clusters(-Clusters) is semidet.
%
%   All places where it may be, the most probable one first: a list of
%   `cluster(Weight, X, Y, Heading, Deviation)`. The weights sum up to 1;
%   Deviation is the standard deviation of the place, in cm.

localized_clusters(Clusters) :-
    localizer_now(Localizer, _),
    localize_clusters_(Localizer, Clusters).

%!  particles(-Particles) is semidet.
%
%   All particles, a list of `particle(Weight, X, Y, Heading)`.

particles(Particles) :-
    localizer_now(Localizer, _),
    localize_particles_(Localizer, Particles).
