:- module(ev3dev_golog_waiting,
          [ run_watched/3,              % :Goal, :Watch, -Outcome
            run_on_bricks/4,            % +Parts, +For, :Watch, -Outcome
            causes_wanted/1,            % +Robot
            followed/1,                 % +Event
            report_again/0,
            for_causes/2,               % +Causes, :Goal
            guarded/2,                  % +Name, :Goal
            pause/4,                    % +Robot, +Queue, +Deadline,
                                        % -Message
            clock/2,                    % +Robot, -Seconds
            robot_stopped/2             % +Robot, +Cause
          ]).
:- use_module(library(lists), [member/2]).
:- use_module(queue, [queue_wait/3]).
:- use_module(theory, [located/3]).

/** <module> The waits of library(ev3dev/golog)

The only place where an agent waits. Robot is `robot` if the domain is about
the robot, else `none`; then the library of the robot is not even loaded.
*/

:- meta_predicate
    run_watched(0, 0, -),
    run_on_bricks(+, +, 0, -),
    for_causes(+, 0),
    guarded(+, 0).

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
        Ball = golog_interrupted(Id),
        flag(ev3dev_golog_watch, Id, Id+1),
        catch(watched(Goal, Watch, Ball, Outcome), Ball,
              Outcome = interrupted)
    ).

watched(Goal, Watch, Ball, Outcome) :-
    (   ev3dev_waits:listening(0.015,
                               ev3dev_golog_waiting:watch(Watch, Ball),
                               Goal)
    ->  Outcome = done
    ;   Outcome = failed
    ).

:- public watch/3.

watch(Watch, Ball, Listener) :-
    (   call(Watch)
    ->  ev3dev_waits:leave(Listener, Ball)
    ;   true
    ).

%!  run_on_bricks(+Parts, +For, :Watch, -Outcome) is det.
%
%   As run_watched/3, for the goals of several agents at the same time: each
%   of Parts is part(Agent, Action, Goal), and Goal is called with the brick
%   Agent in use. When all have succeeded, Outcome is `done`. When one has
%   failed, or thrown an error, the moves of the others end, and Outcome is
%   `failed`. The error is thrown if it says that the program is wrong, such
%   as that of an unknown procedure. For is for(Causes, Seconds); Outcome is
%   `interrupted` if it takes longer. Watch is called only while there is one
%   part: several run in threads of their own.

run_on_bricks(Parts, For, Watch, Outcome) :-
    bricks_loaded,
    length(Parts, Count),
    findall(ev3dev_golog_waiting:run_part(Part, For), member(Part, Parts),
            Goals),
    catch(run_watched(ev3dev_bricks:concurrent(Count, Goals, []), Watch,
                      Outcome),
          golog_out_of_time, Outcome = interrupted).

:- public run_part/2.

run_part(part(Agent, Action, Goal), For) :-
    catch(( bricks_do_part(Agent, For, Goal)
          ->  Done = true
          ;   Done = false
          ),
          error(Formal, Where),
          part_failed(Formal, Where, Agent, Action, Goal, Done)),
    (   Done == error
    ->  fail
    ;   retractall(reported(Agent, _)),
        Done == true
    ).

bricks_do_part(Agent, For, Goal) :-
    ev3dev_bricks:bricks_do([Agent],
                            ev3dev_golog_waiting:run_for(For, Goal)).

%   What is wrong in the program is an error of the run. Else it is reported
%   once until a part of Agent ends without an error: a program that tries
%   again and again while a brick is gone would print nothing else.

:- dynamic reported/2.                  % Agent, Formal
:- volatile reported/2.

part_failed(Formal, Where, Agent, Action, M:_, error) :-
    (   is_mistake(Formal)
    ->  throw(error(Formal, Where))
    ;   reported(Agent, Formal)
    ->  true
    ;   assertz(reported(Agent, Formal)),
        located(M, clause([robot_action(Agent, Action, _)]), Place),
        print_message(warning, golog(part_failed(Place, Agent, Action,
                                                 error(Formal, Where))))
    ).

%!  report_again is det.
%
%   A run begins: what does not work is reported once again.

report_again :-
    retractall(reported(_, _)).

is_mistake(instantiation_error).
is_mistake(type_error(_, _)).
is_mistake(domain_error(_, _)).
is_mistake(existence_error(procedure, _)).

:- public run_for/2, over/2.

run_for(for(Causes, Seconds), Goal) :-
    (   Seconds == infinite
    ->  for_causes(Causes, Goal)
    ;   ev3dev_time:ev3_time(Now),
        End is Now+Seconds,
        ev3dev_waits:listening(0.015, ev3dev_golog_waiting:over(End),
                               ev3dev_golog_waiting:for_causes(Causes, Goal))
    ).

over(End, Listener) :-
    ev3dev_time:ev3_time(Now),
    (   Now >= End
    ->  ev3dev_waits:leave(Listener, golog_out_of_time)
    ;   true
    ).

bricks_loaded :-
    loaded,
    (   current_predicate(ev3dev_bricks:bricks_do/2)
    ->  true
    ;   module_property(ev3dev_golog_waiting, file(Here)),
        file_directory_name(Here, Directory),
        atom_concat(Directory, '/../../bricks', Bricks),
        load_files(ev3dev_golog_waiting:Bricks,
                   [if(not_loaded), imports([])])
    ).

%!  causes_wanted(+Robot) is semidet.
%!  for_causes(+Causes, :Goal) is semidet.
%
%   Call Goal once. What it commands is done for Causes, the innermost first,
%   see library(ev3dev/journal). Not wanted if nothing can be commanded.

causes_wanted(Robot) :-
    (   Robot == robot
    ->  loaded
    ;   current_predicate(ev3dev_causes:acting_for/2)
    ).

for_causes([], Goal) :-
    once(Goal).
for_causes([Cause|Causes], Goal) :-
    for_causes(Causes, ev3dev_causes:acting_for(Goal, Cause)).

%!  followed(+Event) is det.
%
%   The history goes on: library(ev3dev/view) hears of it, if it is there.

followed(Event) :-
    (   current_predicate(ev3dev_causes:begins/1)
    ->  ev3dev_causes:begins(golog(Event))
    ;   true
    ).

%!  guarded(+Name, :Goal) is semidet.
%
%   Call Goal once, a condition about the robot. It must not wait.

guarded(Name, Goal) :-
    loaded,
    ev3dev_waits:in_guard(Name, Goal).

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
        (   queue_wait(Queue, Seconds, Message0)
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
    ;   current_predicate(ev3dev_native:sim_active_/0),
        ev3dev_native:sim_active_,
        loaded
    ).

loaded :-
    (   current_predicate(ev3dev_time:wait/1),
        current_predicate(ev3dev_causes:acting_for/2)
    ->  true
    ;   module_property(ev3dev_golog_waiting, file(Here)),
        file_directory_name(Here, Directory),
        atom_concat(Directory, '/../../time', Time),
        atom_concat(Directory, '/../journal/causes', Causes),
        load_files(ev3dev_golog_waiting:[Time, Causes],
                   [if(not_loaded), imports([])])
    ).

%!  clock(+Robot, -Seconds) is det.
%
%   Seconds have passed since some fixed moment, by the clock of the devices
%   in use, or on the wall.

clock(Robot, Seconds) :-
    (   on_robot_time(Robot)
    ->  ev3dev_time:ev3_time(Seconds)
    ;   get_time(Seconds)
    ).

%!  robot_stopped(+Robot, +Cause) is det.
%
%   Stop the motors that the program has started, for Cause.

robot_stopped(Robot, Cause) :-
    (   on_robot_time(Robot)
    ->  ignore(for_causes([Cause], ev3dev_native:stop_started_))
    ;   true
    ).
