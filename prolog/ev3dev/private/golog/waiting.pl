:- module(ev3dev_golog_waiting,
          [ run_watched/3,              % :Goal, :Watch, -Outcome
            pause/4,                    % +Robot, +Queue, +Deadline,
                                        % -Message
            clock/2,                    % +Robot, -Seconds
            robot_stopped/1             % +Robot
          ]).

:- use_module(library(lists), [member/2]).
:- use_module('../errors', [goal_of_program/1]).

/** <module> How library(ev3dev/golog) waits

The only place where an agent waits. Robot is `robot` if the domain is about
the robot, else `none`; then the library of the robot is not even loaded.
*/

:- meta_predicate run_watched(0, 0, -).

%!  run_watched(:Goal, :Watch, -Outcome) is det.
%
%   Call Goal, which may be a blocking move. Outcome is `done`, `failed`, or
%   `interrupted` if Watch succeeded before Goal ended. Watch is called before
%   Goal and whenever Goal waits for the robot, every 15 ms. An exception
%   leaves Goal then, so that the motors of its move stop.

run_watched(Goal, Watch, Outcome) :-
    (   call(Watch)
    ->  Outcome = interrupted
    ;   loaded,
        flag(ev3dev_golog_watch, Id, Id+1),
        setup_call_cleanup(
            watch_set(Id, Watch),
            catch(( goal_of_program(Goal)
                  ->  Outcome0 = done
                  ;   Outcome0 = failed
                  ),
                  golog_interrupted(Id),
                  Outcome0 = interrupted),
            watch_ended(Id))
    ->  Outcome = Outcome0
    ).

%   The watches of the actions under way in this thread, the innermost first

:- thread_local watching/2.

watch_set(Id, Watch) :-
    asserta(watching(Id, Watch)),
    next_tick.

watch_ended(Id) :-
    retractall(watching(Id, _)),
    (   watching(_, _)
    ->  next_tick
    ;   ev3dev_native:tick_never_
    ).

next_tick :-
    ev3dev_native:tick_after_(0.015).

:- multifile ev3dev_waits:served/0.

ev3dev_waits:served :-
    ev3dev_golog_waiting:watched.

%   The outermost action that has to end ends first.

:- public watched/0.

watched :-
    findall(Id-Watch, watching(Id, Watch), Watches0),
    Watches0 \== [],
    keysort(Watches0, Watches),
    ev3dev_native:tick_never_,
    (   member(Id-Watch, Watches),
        call(Watch)
    ->  next_tick,
        throw(golog_interrupted(Id))
    ;   next_tick
    ).

%!  pause(+Robot, +Queue, +Deadline, -Message) is det.
%
%   Wait until something may have happened, at most until Deadline: for a
%   message in Queue, or for 20 ms, of the clock of the devices in use if
%   there are any. Message is what was taken from Queue, or `none`.

pause(Robot, Queue, Deadline, Message) :-
    (   on_robot_time(Robot)
    ->  ev3dev_time:wait(0.02),
        Message = none
    ;   at_most(Robot, Deadline, Seconds),
        (   Seconds == infinite
        ->  thread_get_message(Queue, Message)
        ;   thread_get_message(Queue, Message0, [timeout(Seconds)])
        ->  Message = Message0
        ;   Message = none
        )
    ).

at_most(polled, _, 0.02) :-
    !.
at_most(_, infinite, infinite) :-
    !.
at_most(_, Deadline, Seconds) :-
    get_time(Now),
    Seconds is max(0, Deadline-Now).

%   A simulation or a brick: its clock counts.

on_robot_time(Robot) :-
    (   Robot == robot
    ->  loaded
    ;   predicate_property(ev3dev_native:sim_active_, defined),
        ev3dev_native:sim_active_,
        loaded
    ).

loaded :-
    module_property(ev3dev_golog_waiting, file(Here)),
    file_directory_name(Here, Directory),
    atom_concat(Directory, '/../../time', Time),
    load_files(ev3dev_golog_waiting:Time, [if(not_loaded), imports([])]).

%!  clock(+Robot, -Seconds) is det.
%
%   Seconds have passed since some fixed moment, by the clock of the devices
%   in use, or on the wall.

clock(Robot, Seconds) :-
    (   on_robot_time(Robot)
    ->  ev3dev_native:now_(Seconds)
    ;   get_time(Seconds)
    ).

%!  robot_stopped(+Robot) is det.
%
%   Stop the motors that the program has started.

robot_stopped(Robot) :-
    (   on_robot_time(Robot)
    ->  ignore(ev3dev_native:stop_started_)
    ;   true
    ).
