% The post: a robot on a track with four way stations takes letters from one
% to another, as in Legolog's delivery example.
%
%   ?- sim_start(delivery).
%   ?- start.
%
% The keys left, up, right and down are the bells of the stations 1 to 4:
% there is a letter for the station opposite. At a station the robot signals,
% and waits until somebody has put the letters in or taken them out, and
% presses enter. Another thread, or a page in a browser, may ask for any
% letter by golog_exog(letter(From, To)).
%
% The left eye (in2) follows the left edge of the black tape. The right eye
% (in3) sees the colors of the stations. A robot that has lost the tape looks
% for it; a robot that was put down somewhere knows its place at the next
% station.

:- use_module(library(ev3dev)).
:- use_module(library(ev3dev/drive)).
:- use_module(library(ev3dev/odometry)).
:- use_module(library(ev3dev/golog)).

start :-
    start([]).

%   Options are those of golog/2.
start(Options) :-
    set_robot(5.6, 10.6, outB, outC),
    golog(post, Options).

% The domain: what there is

station([1, 2, 3, 4]).

prim_action(go_on).             % follow the tape to the next station
prim_action(find_tape).
prim_action(signal).            % ask somebody to come

exog_action(arrive(S)) :- domain(S, station).
exog_action(lose_tape).
exog_action(see_tape).
exog_action(press_go).          % letters are put in and taken out
exog_action(letter(_, _)).      % a letter waits at a station for another
exog_action(cancel(_, _)).

prim_fluent(at).                % a station, or `track`
prim_fluent(tape).              % `seen` or `lost`
prim_fluent(waits(S)) :-        % where the letter that waits there goes
    domain(S, station).
rel_fluent(carries(S)) :-       % a letter for a station is on board
    domain(S, station).
rel_fluent(signaled).

initially(at, track).
initially(tape, seen).
initially(waits(_), none).
initially(carries(_), false).
initially(signaled, false).

poss(go_on, tape = seen).
poss(find_tape, tape = lost).
poss(signal, neg(at = track)).

causes_val(go_on, at, track, true).
causes_val(arrive(S), at, S, true).
causes_val(lose_tape, tape, lost, true).
causes_val(see_tape, tape, seen, true).
causes_val(letter(From, To), waits(From), To, true).
causes_val(cancel(From, _), waits(From), none, true).
causes_val(press_go, waits(S), none, at = S).
causes_true(press_go, carries(To), and(waits(at) = To, neg(To = none))).
causes_false(press_go, carries(S), at = S).
causes_true(signal, signaled, true).
causes_false(press_go, signaled, true).
causes_false(go_on, signaled, true).

% The program: what to do

proc(stop_here, and(neg(at = track), or(neg(waits(at) = none),
                                        carries(at)))).
proc(work, some((s, station), or(neg(waits(s) = none), carries(s)))).

proc(post,
     prioritized_interrupts(
         [ interrupt(tape = lost, find_tape),
           interrupt(and(stop_here, neg(signaled)), signal),
           interrupt(stop_here, wait),
           interrupt(work, go_on),
           interrupt(true, wait) ])).

% The robot: how to do it

robot_action(go_on, follow_tape).
robot_action(find_tape, look_for_tape).
robot_action(signal, tone(880, 200)).

robot_exog(letter(1, 3), button(left)).
robot_exog(letter(2, 4), button(up)).
robot_exog(letter(3, 1), button(right)).
robot_exog(letter(4, 2), button(down)).
robot_exog(press_go, button(enter)).

%   Follow the left edge of the tape until a station comes or the tape is
%   lost: too bright or too dark for a third of a second.
follow_tape :-
    setup_call_cleanup(
        true,
        ( leave_station,
          following(0) ),
        ignore(stop)).

%   The right eye still sees the color of the last station.
leave_station :-
    (   station_below(_)
    ->  control,
        leave_station
    ;   true
    ).

following(Lost) :-
    (   station_below(Station)
    ->  golog_exog(arrive(Station))
    ;   Lost > 15
    ->  golog_exog(lose_tape)
    ;   control(Deviation),
        (   abs(Deviation) > 35
        ->  Lost1 is Lost+1
        ;   Lost1 = 0
        ),
        following(Lost1)
    ).

control :-
    control(_).

%   The deviation is positive if it is too bright: the tape is on the right.
control(Deviation) :-
    col_reflect(in2, Light),
    Deviation is Light-50,
    Rate is 1.5*Deviation,
    drive_cm(12, Rate, [acceleration(100)]),
    ignore(drive_wait([timeout(0.02)], timeout)).

station_below(Station) :-
    col_color(in3, Color),
    station_color(Station, Color).

station_color(1, 5).
station_color(2, 4).
station_color(3, 3).
station_color(4, 2).

%   Turn to both sides, but not so far that the robot would drive back. Then
%   try it further ahead. When the eye sees the tape, the robot goes on to it,
%   and turns left until the eye has passed over it to its left edge.
look_for_tape :-
    setup_call_cleanup(
        true,
        (   member(Angle, [-60, 120, -60]),
            turned_until(dark, Angle)
        ->  go_cm(15, 6),
            ignore(turned_until(dark, -100)),
            ignore(turned_until(bright, -60)),
            golog_exog(see_tape)
        ;   go_cm(15, 5),
            look_for_tape
        ),
        ignore(stop)).

%   Turn by Angle, or until the floor below the left eye is dark or bright.
turned_until(What, Angle) :-
    pose(_, _, Start),
    Speed is 15*sign(Angle),
    turn(Speed),
    turning(What, Start, Angle).

turning(What, Start, Angle) :-
    col_reflect(in2, Light),
    (   is_seen(What, Light)
    ->  true
    ;   pose(_, _, Heading),
        abs(Heading-Start) < abs(Angle),
        wait(0.02),
        turning(What, Start, Angle)
    ).

is_seen(dark, Light) :-
    Light < 40.
is_seen(bright, Light) :-
    Light > 60.
