:- module(ev3dev_navigation,
          [ navigate_to/2,      % +Map, +Goal
            navigate_to/3       % +Map, +Goal, +Options
          ]).
:- set_prolog_flag(generate_debug_info, false).
:- use_module(private/basics/fields,
              [fields/1, goal_expansion/2, term_expansion/2]).
:- use_module(private/checks/checks, [must_be/2]).
:- use_module(private/errors/public_clauses, [term_expansion/4]).
:- use_module(private/explain/hints).
:- use_module(driver, []).
:- use_module(drive, [drive_cm/2, drive_wait/2, face/2, pose/3]).
:- use_module(private/journal/causes, [acting_for/2]).
:- use_module(private/devices/drive_moves, [move/3]).
:- use_module(private/checks/arguments,
              [number_option/4, option/2, option/3, take_options/4]).
:- use_module(private/checks/places, [place/2]).
:- use_module(private/maps/roadmap_arguments,
              [roadmap_facts/2, roadmap_options/2, sensor_option/2]).
:- use_module(robot, [stop/0]).
:- use_module(sensors, [us_dist_cm/2]).
:- use_module(private/native/native,
              [ steer_/5, views_block_/2, views_forget_/1, views_look_/5,
                views_new_/2, views_obstacles_/3, views_step_/5 ]).

:- fields(drive(views, facts, goal, margin, native, sensor, speed,
                tolerance)).

/** <module> Driving through a room that is only partly known

The robot has a map, as for library(ev3dev/roadmap), and its place on it, by
pose/3. What the map lacks it sees with its ultrasonic sensor on the way:

```
?- sim_start(room), set_robot(5.6, 10.6, outB, outC).
?- sim_pose(X, Y, Heading), set_pose(X, Y, Heading).
?- navigate_to([bounds(0, 0, 300, 250)], 260-210, [obstacles(New)]).
```

It goes only where it has looked. At first, and whenever its way leads to a
place that it has not seen, it turns once around on the spot. An echo tells
how far something is, but not where in the sensor's cone of 30 degrees; what
other looks show to be free is taken away, and the rest becomes polygons. With
them it plans the way again.
*/

%!  navigate_to(+Map, +Goal) is semidet.
%!  navigate_to(+Map, +Goal, +Options) is semidet.
%
%   Drive to Goal, `X-Y` in cm, around what Map knows and what is seen on the
%   way. Waits. Options are those of library(ev3dev/roadmap), which apply to
%   the way, and
%
%     - speed(+CmPerSecond)
%       Default is 15.
%     - sensor(+X, +Y, +Heading)
%       The place of the ultrasonic sensor, to the right and ahead of the
%       middle of the axle, and its direction. Default is sensor(0, 7, 0), the
%       shipped robot's.
%     - tolerance(+Cm)
%       How near to Goal is there. Default is 2.
%     - reason(-Reason)
%       Do not fail if Goal is not reached, but report why: `reached`;
%       `unreachable`, as there is no way with what is known and seen;
%       `exhausted`, if it has planned its way so often as steps(Count) says;
%       `stalled`, if something holds the robot; `astray`, if the gyro
%       contradicts the wheels; `unplugged`, if its sensor or a motor is;
%       `stopped`, if another thread stopped it while it moved. A stop while
%       it stands and plans has no effect.
%     - steps(+Count)
%       Default is 200.
%     - obstacles(-Polygons)
%       Facts, as a map has, of things that were seen and Map lacks.
%
%   Fails unless Goal is reached, unless asked for the reason; `debug(ev3dev)`
%   reports it. Nothing moves if there is no path on Map as it is. Fails also
%   if no robot is set or it has no ultrasonic sensor. The robot stands when
%   it ends, also by an exception.
%
%   If something moves into a place that was seen free, the robot stops as
%   soon as the sensor shows it, forgets what it had seen there, and plans
%   again.
%
%   @error as roadmap_path/5

navigate_to(Map, Goal) :-
    navigate_to(Map, Goal, []).

navigate_to(Map, Goal0, Options) :-
    roadmap_facts(Map, Facts),
    place(Goal0, Goal),
    take_options([speed, sensor/3, tolerance, reason, steps, obstacles],
                 Options, Own, OfWay),
    roadmap_options(OfWay, Native),
    number_option(radius(Radius), positive_number, OfWay, 8),
    number_option(margin(Margin), nonnegative_number, OfWay, 4),
    number_option(speed(Speed), positive_number, Own, 15),
    number_option(tolerance(Tolerance), positive_number, Own, 2),
    option(steps(Steps), Own, 200),
    must_be(nonneg, Steps),
    sensor_option(Own, Sensor),
    once(us_dist_cm(Port, _)),
    views_new_(Radius, Views),
    Drive = drive(Views, Facts, Goal, Margin, Native,
                  Port-Sensor, Speed, Tolerance),
    setup_call_cleanup(
        true,
        navigate(Drive, Steps, Reason0),
        ignore(stop)),
    explain("way to ~p: ~w", [Goal, Reason0]),
    views_obstacles_(Views, Facts, Obstacles0),
    option(obstacles(Obstacles), Own, _),
    option(reason(Reason), Own, reached),
    Obstacles = Obstacles0,
    Reason = Reason0.

%   Plans with the map alone first: if that leaves no way, nothing moves.

navigate(Drive, Steps, Reason) :-
    next_step(Drive, Step),
    (   Step = no_way(_)
    ->  Reason = unreachable
    ;   advance(Step, no, 1, Steps, Drive, Reason)
    ).

next_step(Drive, Step) :-
    Drive = drive(views: Views, facts: Facts, goal: Goal, margin: Margin,
                  native: Native),
    pose(X, Y, _),
    views_step_(Views, Facts, way(X-Y, Goal, Margin), Native, Step).

%!  advance(+Step, +Looked, +Forgets, +Steps, +Drive, -Reason) is semidet.
%
%   Looked is `yes` if the robot has looked around since it moved, else `no`.
%   A place that it still has not seen then counts as an obstacle. If the
%   obstacles leave no path, the echoes may be wrong: the robot forgets them
%   and looks again, at most Forgets times.

advance(Step, _, _, _, Drive, reached) :-
    is_there(Step, Drive),
    !.
advance(_, _, _, 0, _, exhausted) :-
    !.
advance(Step, Looked, Forgets, Steps, Drive, Reason) :-
    decided(Step, Looked, Forgets, Decision),
    part(Decision, Part),
    acting_for(carry_out(Decision, Drive, Done), leg(Part)),
    (   Done = ended(Reason0)
    ->  Reason = Reason0
    ;   Done = looked(Looked1),
        forgets(Decision, Forgets, Forgets1),
        Left is Steps - 1,
        next_step(Drive, Next),
        advance(Next, Looked1, Forgets1, Left, Drive, Reason)
    ).

is_there(step(_, Length, _, _, Rest, _), Drive) :-
    Drive = drive(tolerance: Tolerance),
    Length + Rest =< Tolerance.

decided(step(Heading, Length, Safe, Unseen, _, Way), _, _, Decision) :-
    until(Length, Safe, Unseen, Until),
    !,
    Decision = go(Heading, Way, Until).
decided(_, no, _, Decision) :-
    !,
    Decision = look.
decided(step(_, _, _, Unseen, _, _), yes, _, Decision) :-
    !,
    Decision = block(Unseen).
decided(no_way(_), yes, Forgets, Decision) :-
    (   Forgets > 0
    ->  Decision = forget
    ;   Decision = give_up
    ).

forgets(Decision, Forgets0, Forgets) :-
    (   Decision == forget
    ->  Forgets is Forgets0 - 1
    ;   Forgets = Forgets0
    ).

%   What the journal calls it.

part(go(Heading, _, Until), Part) :-
    !,
    Part = go(Heading, Until).
part(block(Place), Part) :-
    !,
    Part = avoid(Place).
part(Part, Part).

carry_out(go(Heading, Way, Until), Drive, Done) :-
    face(Heading, [reason(Reason)]),
    (   Reason == reached
    ->  follow(Way, Until, Drive, Done)
    ;   Done = ended(Reason)
    ).
carry_out(look, Drive, Done) :-
    look_around(Drive, Done).
carry_out(block(Place), Drive, looked(yes)) :-
    Drive = drive(views: Views),
    views_block_(Views, Place).
carry_out(forget, Drive, Done) :-
    forget(Drive),
    look_around(Drive, Done).
carry_out(give_up, _, ended(unreachable)).

%   Up to where to go: to the end, or well before what was not seen.

until(Length, _, Unseen, Length) :-
    var(Unseen),
    !.
until(_, Safe, _, Until) :-
    Until is Safe - 1,
    Until >= 4.

forget(Drive) :-
    Drive = drive(views: Views),
    views_forget_(Views).

%!  observe(+Drive, -Moved) is semidet.
%
%   Notes what the sensor shows. Moved is true if that cannot be, unless
%   something has moved.

observe(Drive, Moved) :-
    Drive = drive(views: Views, sensor: (Port-Sensor)),
    pose(X, Y, Heading),
    us_dist_cm(Port, Distance),
    !,
    views_look_(Views, pose(X, Y, Heading), Sensor, Distance, Moved).

%!  look_around(+Drive, -Done) is semidet.
%
%   Turn once around on the spot, looking. Done is looked(yes), or
%   ended(Reason).

look_around(Drive, Done) :-
    pose(_, _, From),
    drive_cm(0, 50),
    look_around(From, 0, 0, Drive, Done),
    stop.

look_around(From, Before, Still, Drive, Done) :-
    observe(Drive, _),
    !,
    pose(_, _, Heading),
    Gone is Heading - From,
    (   Gone >= 360
    ->  Done = looked(yes)
    ;   tick(Gone, Before, Still, Still1, Why),
        (   Why == timeout
        ->  look_around(From, Gone, Still1, Drive, Done)
        ;   Done = ended(Why)
        )
    ).
look_around(_From, _Before, _Still, _Drive, ended(unplugged)).

%!  follow(+Way, +Until, +Drive, -Done) is semidet.
%
%   Keep to Way up to Until, in cm, looking. Done is looked(no), or
%   ended(Reason). Ends early if something has moved.

follow(Way, Until, Drive, Done) :-
    drive_cm(0, 0),
    follow(Way, Until, 0, 0, Drive, Done),
    stop.

follow(Way, Until, Before, Still, Drive, Done) :-
    observe(Drive, Moved),
    !,
    pose(X, Y, Heading),
    steer_(Way, pose(X, Y, Heading), Before, Gone, Turn),
    Left is Until - Gone,
    (   Left < 0.5
    ->  Done = looked(no)
    ;   Moved == true
    ->  Done = looked(no)
    ;   steer(Left, Turn, Drive),
        tick(Gone, Before, Still, Still1, Why),
        (   Why == timeout
        ->  follow(Way, Until, Gone, Still1, Drive, Done)
        ;   Done = ended(Why)
        )
    ).
follow(_Way, _Until, _Before, _Still, _Drive, ended(unplugged)).

%   Slower before the end, and where the way bends: by at most 60 degrees a
%   second. What somebody has stopped stays so.

steer(Left, Turn, Drive) :-
    Drive = drive(speed: Speed),
    CmPerSecond is min(Speed, min(max(2, sqrt(30 * Left)),
                                  60 / max(abs(Turn), 1))),
    DegreesPerSecond is CmPerSecond * Turn,
    move(100, change(CmPerSecond, DegreesPerSecond), []).

%!  tick(+Gone, +Before, +Still0, -Still, -Why) is det.
%
%   Let a moment pass. Why is `timeout` if the move goes on, else why it
%   ended: `stalled` also if there is no getting on for three seconds.

tick(Gone, Before, Still0, Still, Why) :-
    drive_wait([timeout(0.03)], Why0),
    (   Gone > Before
    ->  Still = 0
    ;   Still is Still0 + 1
    ),
    (   Still > 100
    ->  Why = stalled
    ;   Why = Why0
    ).
