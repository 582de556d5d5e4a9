:- module(ev3dev_marking_record,
          [ run_pose/4,                 % ?Seconds, ?X, ?Y, ?Heading
            run_things/3,               % ?Seconds, ?Things, ?Held
            run_collision/1,            % ?Collision
            run_fact/1,                 % ?Fact
            with_record/4,              % :Goal, +Seed, +World, +Robot
            record_end/3,               % +Ended, +Output, +Lines
            recorded/4                  % -Film, -Ways, -Collisions,
                                        % -Seconds
          ]).
:- use_module('../../sim_time', [sim_at/2, sim_time/1]).
:- use_module('../../sim_views',
              [ sim_collisions/1, sim_held/1, sim_pose/3, sim_things/1,
                sim_trace/1 ]).
:- use_module('../files/facts', [located_facts/3]).
:- use_module(library(lists), [member/2, reverse/2]).

/** <module> The record of a run, for scores and reports

The pose is recorded ten times a second, and so are the things that robots
push, if one has moved since, or a gripper has closed or opened. The simulator
knows collisions and what the robot said at the end. What the sensors showed
at a collision is kept at that moment, because the simulator forgets it.
*/

:- meta_predicate with_record(0, +, +, +).

:- dynamic
    run_pose/4,
    run_things/3,                       % the newest first
    run_collision/1,                    % collision(Time, X, Y, Heading)
    run_fact/1.                         % ended(How), seconds(Time),
                                        % seed(Seed), world(Facts),
                                        % robot(Facts), output(Text),
                                        % said(Text), told(Time, Text),
                                        % commands(Count),
                                        % seen(Time, Port, Value)
:- volatile
    run_pose/4,
    run_things/3,
    run_collision/1,
    run_fact/1.

%!  run_pose(?Seconds, ?X, ?Y, ?Heading) is nondet.
%!  run_things(?Seconds, ?Things, ?Held) is nondet.
%!  run_collision(?Collision) is nondet.
%!  run_fact(?Fact) is nondet.
%
%   What was recorded of the run; they are dynamic. Things is as of
%   sim_things/1, and Held are the names of those that its grippers held.

%!  with_record(:Goal, +Seed, +World, +Robot) is semidet.
%
%   Call Goal, while a simulation of Robot in World runs, and record it.

with_record(Goal, Seed, World, Robot) :-
    forget,
    assertz(run_fact(seed(Seed))),
    note_facts(world, World),
    note_facts(robot, Robot),
    record,
    call(Goal).

note_facts(Kind, Source) :-
    located_facts(Kind, Source, Located),
    findall(Fact, member(Fact-_, Located), Facts),
    Noted =.. [Kind, Facts],
    assertz(run_fact(Noted)).

forget :-
    retractall(run_pose(_Seconds, _, _, _)),
    retractall(run_things(_, _, _)),
    retractall(run_collision(_)),
    retractall(run_fact(_)).

%   Also at the very end, when nothing more is planned.

record :-
    note_pose(Time),
    note_collision,
    Next is Time+0.1,
    sim_at(Next, ev3dev_marking_record:record).

note_pose(Time) :-
    sim_time(Time),
    sim_pose(X, Y, Heading),
    assertz(run_pose(Time, X, Y, Heading)),
    note_things(Time).

note_things(Time) :-
    sim_things(Things),
    findall(Name, ( Things \== [], sim_held(Name) ), Held),
    (   run_things(_, Before, HeldBefore)
    ->  true
    ;   Before-HeldBefore = []-[]
    ),
    (   Things-Held == Before-HeldBefore
    ->  true
    ;   asserta(run_things(Time, Things, Held))
    ).

note_collision :-
    (   run_fact(seen(_, _, _))
    ->  true
    ;   sim_collisions([collision(Time, _, _, _)|_])
    ->  sim_trace(Trace),
        reverse(Trace, Latest),
        note_seen(Latest, Time, [])
    ;   true
    ).

%   The last value of each sensor before that moment.

note_seen([], _, _).
note_seen([Then-Event|Events], Time, Seen) :-
    (   Event = read(File, Text),
        Then =< Time,
        sub_atom(File, _, _, 0, '/value0'),
        \+ memberchk(File, Seen)
    ->  assertz(run_fact(seen(Then, File, Text))),
        note_seen(Events, Time, [File|Seen])
    ;   note_seen(Events, Time, Seen)
    ).

%!  record_end(+Ended, +Output, +Lines) is det.
%
%   The run has ended so, as of sim_fenced/3.

record_end(Ended, Output, Lines) :-
    note_pose(Time),
    note_collision,
    sim_collisions(Collisions),
    forall(member(Collision, Collisions), assertz(run_collision(Collision))),
    assertz(run_fact(ended(Ended))),
    assertz(run_fact(seconds(Time))),
    assertz(run_fact(output(Output))),
    forall(member(Then-Text, Lines), assertz(run_fact(told(Then, Text)))),
    sim_trace(Trace),
    forall(member(_-said(Text), Trace), assertz(run_fact(said(Text)))),
    findall(File,
            ( member(_-written(File, _), Trace),
              sub_atom(File, _, _, 0, '/command') ),
            Written),
    length(Written, Commands),
    assertz(run_fact(commands(Commands))).

%!  recorded(-Film, -Ways, -Collisions, -Seconds) is det.
%
%   Film is a list of [X, Y, Heading], five to a second, in tenths of a cm and
%   degrees. Ways has Name-Way for each thing that robots push: Way is a list
%   of [Place, X, Y, Heading], in the same units, with the places in Film,
%   from 0, at which the thing has come there.

recorded(Film, Ways, Collisions, Seconds) :-
    findall(Time-[X, Y, H],
            ( run_pose(Time, X0, Y0, H0),
              in_film(X0, Y0, H0, X, Y, H) ),
            All),
    every_other(All, Frames),
    findall(Pose, member(_-Pose, Frames), Film),
    findall(Time-Things, run_things(Time, Things, _), Newest),
    reverse(Newest, Moments),
    seen_things(Frames, 0, Moments, Seen),
    findall(Name,
            ( member(_-Things, Seen), member(thing(Name, _, _, _), Things) ),
            Names0),
    sort(Names0, Names),
    findall(Name-Way, ( member(Name, Names), way_of(Seen, Name, Way) ),
            Ways),
    findall(Collision, run_collision(Collision), Collisions),
    run_fact(seconds(Seconds)),
    !.

in_film(X0, Y0, H0, X, Y, H) :-
    X is round(10*X0),
    Y is round(10*Y0),
    H is round(H0).

every_other([], []).
every_other([One|Others], [One|Film]) :-
    (   Others = [_|Rest]
    ->  every_other(Rest, Film)
    ;   Film = []
    ).

%   Place-Things for each place of the film at which there is news of things.

seen_things([], _Place, _Moments, []).
seen_things([Time-_|Frames], Place, Moments0, Seen) :-
    news(Moments0, Time, none, News, Moments),
    (   News == none
    ->  Seen = Later
    ;   Seen = [Place-News|Later]
    ),
    Next is Place+1,
    seen_things(Frames, Next, Moments, Later).

news([Then-Things|Moments0], Time, _, News, Moments) :-
    Then =< Time,
    !,
    news(Moments0, Time, Things, News, Moments).
news(Moments, _, News, News, Moments).

way_of(Seen, Name, Way) :-
    findall([Place, X, Y, H],
            ( member(Place-Things, Seen),
              memberchk(thing(Name, X0, Y0, H0), Things),
              in_film(X0, Y0, H0, X, Y, H) ),
            All),
    without_rests(All, Way).

without_rests([[Place|Pose]|Places], [[Place|Pose]|Way]) :-
    moved_from(Places, Pose, Rest),
    (   Rest == []
    ->  Way = []
    ;   without_rests(Rest, Way)
    ).

moved_from([[_|Pose]|Places], Pose, Rest) :-
    !,
    moved_from(Places, Pose, Rest).
moved_from(Rest, _, Rest).
