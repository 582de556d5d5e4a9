% Where am I? How often, how soon and how exactly library(ev3dev/localize) knows, and how
% often it is sure of a wrong place.
%
%   swipl -p library=prolog -g main -t 'halt(1)' benches/localize.pl -- [SEEDS [MINUTES [CASE ...]]]
%
% By default 20 seeds, and drives of 20 minutes. Prints a line for each case: how many of the
% seeds reached what the line says. A place is right within 10 cm and 10 degrees. A claim is a
% look at localized/1 after a scan, or each second of a drive, that is above 0.9; it is wrong
% if the place is.

:- use_module(library(ev3dev)).
:- use_module(library(ev3dev/drive)).
:- use_module(library(ev3dev/events)).
:- use_module(library(ev3dev/localize)).
:- use_module(library(ev3dev/roadmap)).
:- use_module(library(ev3dev/sim)).
:- use_module(library(aggregate)).

main :-
    current_prolog_flag(argv, Argv0),
    (   append(_, ['--'|Argv], Argv0) -> true ; Argv = Argv0 ),
    numbers(Argv, Numbers, Cases0),
    append(Numbers, Defaults, Given),
    (   append(_, Defaults, [20, 20]), Given = [Count, Minutes] -> true ),
    nb_setval(duration, Minutes),
    (   Cases0 == [] -> findall(Case, case(Case, _, _), Cases) ; Cases = Cases0 ),
    format("~w~t~40|~w~t~12+~w~t~10+~w~t~16+~w~n",
           [case, reached, claims, wrong, 'error: median, p95, p99, most in cm']),
    forall(( member(Case, Cases), case(Case, Kind, Setting) ),
           run(Case, Kind, Setting, Count)),
    halt.

numbers([Atom|Atoms], [Number|Numbers], Rest) :-
    atom_number(Atom, Number),
    !,
    numbers(Atoms, Numbers, Rest).
numbers(Rest, [], Rest).

% case(Name, Kind, setting(World, Map, Robot, Options of the simulation, of the localizer))

case(room, scans(3), setting(room, room, [], [noise(true)], [])).
case(room_by_table, scans(3), setting(room, room, [], [noise(true)], [table(true)])).
case(noise_doubled, scans(12), setting(room, room, Noise, [noise(true)], [])) :-
    doubled(Noise).
case(three_rooms_wide, scans(3), setting(World, World, [], [noise(true)], [])) :-
    three_rooms(World).
case(real_sonar, scans(3), setting(room, room, Facts, [noise(true)], [])) :-
    real_sonar(Facts).
case(cone_25_believed_15, scans(3), setting(room, room, Facts, [noise(true)], [])) :-
    Facts = [echo(in1, [half_angle(25)])].
case(moved_box, scans(6), setting(Moved, room, [], [noise(true)], [])) :-
    moved_box(Moved).
case(somebody_walks, walks(6), setting(room, room, [], [noise(true)], [])).
case(kidnapped, kidnapped(2), setting(room, room, [], [noise(true)], [])).
case(two_alike, alike, setting(World, World, [], [noise(true)], [])) :-
    two_alike(World).
case(drive, drive(2.5, 5), setting(room, room, [], [noise(true)], [])).
case(drive_by_table, drive(2.5, 5), setting(room, room, [], [noise(true)], [table(true)])).
case(drive_bad_odometry, drive(4, 10), setting(room, room, Facts, [noise(true)], [])) :-
    bad_odometry(Facts).
case(drive_no_gyro, drive(5, 15), setting(room, room, Facts, [noise(true)], [])) :-
    no_gyro(Facts).
case(drive_real_sonar, drive(8, 20), setting(room, room, Facts, [noise(true)], [])) :-
    real_sonar(Facts).
case(textbook, scans(3),
     setting(room, room, [], [noise(true)],
             [search(false), particles(1000), model([exponent(1)])])).
% leJOS's MCL: 200 particles spread over the map, each weighed by a bell curve of the
% difference, whose double variance is 250 cm^2, along a ray.
case(lejos, scans(3),
     setting(room, room, [], [noise(true)],
             [ search(false), particles(200),
               model([ half_angle(0.5), sigma(11.2, 0), hit(1), short(0), missing(0.001),
                       random(0.001), exponent(1) ]) ])).

three_rooms([ bounds(0, 0, 500, 300), wall(200, 0, 200, 200), wall(350, 100, 350, 300),
              box(60, 80, 40, 30, 10), box(270, 240, 50, 20, -30), circle(430, 80, 15),
              box(440, 250, 30, 30), start(40, 40, 0) ]).

moved_box([ bounds(0, 0, 300, 250), box(90, 165, 40, 25, 20), box(230, 45, 30, 45, -15),
            circle(150, 125, 8), start(40, 40, 40) ]).

two_alike([ bounds(0, 0, 400, 200), wall(200, 0, 200, 200, 2), box(50, 60, 30, 20),
            box(251, 60, 30, 20), circle(150, 150, 10), circle(351, 150, 10),
            start(40, 120, 0) ]).

doubled([ noise(in1, 0.4, 0), noise(in4, 0.6, 0.04), noise(outB, 1, 0), noise(outC, 1, 0),
          encoder_noise(outB, 1), encoder_noise(outC, 1) ]).

real_sonar([ echo(in1, [half_angle(15), incidence(40), miss(0.05), spurious(0.02)]),
             noise(in1, 1, 0) ]).

% The program believes 5.6 and 10.6.
bad_odometry([ left_wheel(outB, 5.6, [slip(0.02)]), right_wheel(outC, 5.544, [slip(0.02)]),
               axle(10.812), noise(in4, 0.3, 0.06) ]).

no_gyro(Facts) :-
    bad_odometry(Facts0),
    append(Facts0, [no_gyro], Facts).

run(Case, Kind, Setting, Count) :-
    findall(Result, ( between(1, Count, Seed), once(result(Kind, Setting, Seed, Result)) ),
            Results),
    aggregate_all(count, member(result(true, _, _), Results), Reached),
    findall(Claim, ( member(result(_, Claims, _), Results), member(Claim, Claims) ), Claims),
    length(Claims, Claimed),
    aggregate_all(count, member(false, Claims), Wrong),
    findall(Error, ( member(result(_, _, Errors), Results), member(Error, Errors) ), Errors0),
    msort(Errors0, Errors),
    format("~w~t~40|~w of ~w~t~12+~d~t~10+~d~t~16+", [Case, Reached, Count, Claimed, Wrong]),
    (   Errors == []
    ->  nl
    ;   quantile(0.5, Errors, Median), quantile(0.95, Errors, P95),
        quantile(0.99, Errors, P99), last(Errors, Most),
        format("~1f ~1f ~1f ~1f~n", [Median, P95, P99, Most])
    ).

quantile(Share, Sorted, Value) :-
    length(Sorted, Count),
    Index is min(Count-1, truncate(Share*Count)),
    nth0(Index, Sorted, Value).

result(Kind, setting(World, Map, Facts, Sim, Localize), Seed, Result) :-
    set_random(seed(Seed)),
    robot_with(Facts, Robot),
    with_sim(World,
             ( use_gyro(Facts),
               set_robot(5.6, 10.6, outB, outC),
               done(Kind, World, Map, [seed(Seed)|Localize], Result) ),
             [robot(Robot), seed(Seed)|Sim]).

use_gyro(Facts) :-
    (   memberchk(no_gyro, Facts)
    ->  drive_option(use_gyro, false)
    ;   drive_option(use_gyro, true)
    ).

robot_with(Facts, Robot) :-
    module_property(ev3dev_sim, file(File)),
    file_directory_name(File, Directory),
    directory_file_path(Directory, 'robots/default.pl', Default),
    read_file_to_terms(Default, Terms, []),
    exclude(==(no_gyro), Facts, More),
    append(Terms, More, Robot).

% At a random place that is free.
anywhere(World) :-
    world_size(World, Width, Height),
    repeat,
    X is 10 + random_float * (Width-20),
    Y is 10 + random_float * (Height-20),
    Heading is random_float * 360,
    catch(sim_place(X, Y, Heading), error(_, _), fail),
    !.

world_size(room, 300, 250) :-
    !.
world_size(Facts, Width, Height) :-
    memberchk(bounds(0, 0, Width, Height), Facts).

% done(Kind, World, Map, Options, Result): Result is result(Reached, Claims, Errors).

done(scans(Most), World, Map, Options, result(Reached, Claims, [])) :-
    anywhere(World),
    localize_start(Map, Options),
    scans(Most, Claims),
    is_right(Reached).
done(walks(Most), World, Map, Options, result(Reached, Claims, [])) :-
    anywhere(World),
    localize_start(Map, Options),
    nb_setval(walker, none),
    every(0.5, walk, [id(walker)]),
    scans(Most, Claims),
    is_right(Reached).
done(kidnapped(Most), World, Map, Options, result(Reached, Claims, [])) :-
    anywhere(World),
    sim_pose(X, Y, Heading),
    localize_start(Map, [start(pose(X, Y, Heading))|Options]),
    scan(_),
    repeat,
    anywhere(World),
    sim_pose(X1, Y1, _),
    (X1-X)**2 + (Y1-Y)**2 > 50**2,
    !,
    % The first look around notices it, and two more find out.
    findall(Claim, ( between(0, Most, _), scan(Claim) ), Claims0),
    append(Claims0, Claims),
    is_right(Reached).
done(alike, World, Map, Options, result(Reached, Claims, [])) :-
    anywhere(World),
    localize_start(Map, Options),
    findall(Claim-Alike,
            ( between(1, 3, _), scan(Claim), alike(Alike), wander(3) ),
            Pairs),
    pairs_keys_values(Pairs, Claims0, Alikes),
    append(Claims0, Claims),
    (   memberchk(false, Alikes) -> Reached = false ; Reached = true ).
done(drive(Limit, Farthest), World, Map, Options, result(Reached, Claims, Errors)) :-
    anywhere(World),
    sim_pose(X, Y, Heading),
    set_pose(X, Y, Heading),
    localize_start(Map, [start(pose(X, Y, Heading)), correct_odometry(true)|Options]),
    nb_setval(drive, []),
    every(1, noted, [id(noted)]),
    drive_about(World),
    nb_getval(drive, Pairs),
    pairs_keys_values(Pairs, Errors, Claims0),
    append(Claims0, Claims),
    msort(Errors, Sorted),
    quantile(0.95, Sorted, P95),
    last(Sorted, Most),
    (   P95 < Limit, Most < Farthest -> Reached = true ; Reached = false ).

noted :-
    off(Error, _),
    claim(Claim),
    nb_getval(drive, Pairs),
    nb_setval(drive, [Error-Claim|Pairs]).

% Looks around until it is sure, and goes elsewhere between.
scans(Most, Claims) :-
    scan(Claims0),
    Left is Most-1,
    (   ( Left =:= 0 ; localized(Confidence), Confidence > 0.8 )
    ->  Claims = Claims0
    ;   wander(3),
        scans(Left, Claims1),
        append(Claims0, Claims1, Claims)
    ).

scan(Claims) :-
    localize_scan([reason(_)]),
    claim(Claims).

% [Right], if it is sure.
claim(Claims) :-
    (   localized(Confidence), Confidence > 0.9
    ->  is_right(Right), Claims = [Right]
    ;   Claims = []
    ).

is_right(Right) :-
    (   off(Cm, Degrees), Cm < 10, Degrees < 10 -> Right = true ; Right = false ).

off(Cm, Degrees) :-
    localized_pose(X, Y, Heading, _),
    sim_pose(X1, Y1, Heading1),
    Cm is sqrt((X-X1)**2 + (Y-Y1)**2),
    Off is Heading-Heading1,
    heading_wrapped(Off, Wrapped),
    Degrees is abs(Wrapped).

% Two clusters, of which none is believed.
alike(Alike) :-
    localized(Confidence),
    localized_clusters(Clusters),
    aggregate_all(count, ( member(cluster(W, _, _, _, _), Clusters), W > 0.2 ), Count),
    (   Count =:= 2, Confidence =< 0.7 -> Alike = true ; Alike = false ).

% Drives about for a time, and turns away from what it sees or touches.
wander(Seconds) :-
    sim_time(Now),
    End is Now+Seconds,
    wander_until(End),
    stop.

wander_until(End) :-
    sim_time(Now),
    (   Now >= End
    ->  true
    ;   us_dist_cm(_, Distance), Distance < 22
    ->  turn_away,
        wander_until(End)
    ;   drive_cm(18, 0),
        drive_wait([timeout(0.2)], Why),
        (   memberchk(Why, [timeout, reached])
        ->  true
        ;   go_cm(30, -8, [reason(_), timeout(3)]),
            turn_away
        ),
        wander_until(End)
    ).

turn_away :-
    Angle is 60 + random(120),
    turn(30, Angle, [reason(_), timeout(4)]).

% Drives from place to place by the map, from where it believes to be. Once it is lost it looks
% around, as docs/localization.md says.
drive_about(World) :-
    sim_time(Now),
    nb_getval(duration, Minutes),
    End is Now + 60*Minutes,
    drive_until(End, World).

drive_until(End, _) :-
    sim_time(Now),
    Now >= End,
    !.
drive_until(End, World) :-
    world_size(World, Width, Height),
    X is random_float*Width,
    Y is random_float*Height,
    pose(X0, Y0, _),
    (   catch(roadmap_path(World, X0-Y0, X-Y, [_|Points], [margin(6)]), error(_, _), fail)
    ->  legs(Points)
    ;   roadmap_path(World, X0-Y0, X-Y, [_|Points], [margin(0.5)])
    ->  legs(Points)
    ;   wait(0.2),
        ignore(go_cm(20, -3, [reason(_), timeout(2)]))
    ),
    drive_until(End, World).

legs([]).
legs([X-Y|Points]) :-
    go_to(X, Y, [speed(cm_per_s(18)), reason(Why), timeout(20)]),
    (   localized(Confidence), Confidence < 0.35
    ->  localize_scan([reason(_)])
    ;   Why == reached
    ->  legs(Points)
    ;   go_cm(20, -5, [reason(_), timeout(2)])
    ).

% Somebody with a leg of 12 cm, who walks up and down between the boxes.
walk :-
    sim_time(Time),
    Y is 125 + 90*sin(Time/4),
    nb_getval(walker, Before),
    (   Before == none -> true ; sim_remove(Before) ),
    (   catch(sim_add(circle(60, Y, 6), Id), error(_, _), fail) -> true ; Id = none ),
    nb_setval(walker, Id).
