:- module(ev3dev_view_jog,
          [ jog_line/3,                 % +Left, +Right, -Answer
            jog_round/2,                % +Before, -After
            jog_end/0
          ]).
:- use_module('../native/native',
              [ motor_stop_/3, motors_run_/1, view_stands_/0, view_step_/2 ]).
:- use_module('../devices/robot_state', [robot/4]).
:- use_module(program, [program_state/1, view_thread/0]).

/** <module> Driving by the keys of a page

A person drives while no program runs. The page says again and again how fast;
when it no longer does, the robot stops. On the virtual clock, time meanwhile
passes as fast as real time; else it would stand still.
*/

:- dynamic
    until/1,                            % when the robot stops
    wheels/2,                           % Left, Right
    jogger/1.                           % Thread

%   How long, in seconds, a command holds, and how often this looks.
holds(0.5).
period(0.02).

%!  jog_line(+Left, +Right, -Answer) is det.
%
%   Turn the left and the right wheel at these percentages from now on.

jog_line(_, _, refused("A program runs.")) :-
    \+ program_state(idle),
    !.
jog_line(_, _, Answer) :-
    \+ robot(_Diameter, _, _, _),
    !,
    Answer = refused("No robot is set: set_robot(5.6, 10.6, outB, outC).").
jog_line(Left, Right, none) :-
    with_mutex(ev3dev_view_jog, jog(Left, Right)).

jog(Left, Right) :-
    robot(_, _, LeftPort, RightPort),
    (   Left =:= 0,
        Right =:= 0
    ->  retractall(until(_)),
        stop(LeftPort, RightPort)
    ;   get_time(Now),
        holds(Holds),
        Until is Now + Holds,
        retractall(until(_)),
        assertz(until(Until)),
        retractall(wheels(_, _)),
        assertz(wheels(LeftPort, RightPort)),
        (   catch(motors_run_([run(LeftPort, Left), run(RightPort, Right)]),
                  error(_, _), fail)
        ->  true
        ;   true
        ),
        ensure_jogger
    ).

stop(LeftPort, RightPort) :-
    catch(ignore(motor_stop_('tacho-motor', LeftPort, brake)),
          error(_, _), true),
    catch(ignore(motor_stop_('tacho-motor', RightPort, brake)),
          error(_, _), true).

ensure_jogger :-
    (   jogger(Thread),
        catch(thread_property(Thread, status(running)), _, fail)
    ->  true
    ;   retractall(jogger(_)),
        current_prolog_flag(threads, true)
    ->  thread_create(( view_thread, get_time(Now), jogs(Now-none) ), Thread,
                      [detached(true)]),
        assertz(jogger(Thread))
    ;   true
    ).

jogs(Round0) :-
    period(Period),
    sleep(Period),
    (   jog_round(Round0, Round)
    ->  jogs(Round)
    ;   true
    ).

%!  jog_round(+Before, -After) is semidet.
%
%   Let time pass while somebody drives. Before is the moment of the round
%   before this one and, when the robot has stopped, the moment until which
%   time passes so that it rolls out, else `none`: a pair; so is After. Fails
%   if nobody drives.

jog_round(Before-Rest0, Now-Rest) :-
    program_state(idle),
    wheels(_, _),
    get_time(Now),
    Passed is min(0.1, Now - Before),
    pass(Passed),
    rest(Now, Rest0, Rest),
    (   number(Rest),
        Now > Rest
    ->  retractall(wheels(_, _)),
        fail
    ;   true
    ).

pass(Seconds) :-
    (   catch(view_stands_, _, fail)
    ->  ignore(view_step_(Seconds, true))
    ;   true
    ).

rest(Now, Rest0, Rest) :-
    with_mutex(ev3dev_view_jog, rest_(Now, Rest0, Rest)).

rest_(Now, _, none) :-
    until(Until),
    Now =< Until,
    !.
rest_(Now, none, Rest) :-
    !,
    retractall(until(_)),
    (   wheels(Left, Right)
    ->  stop(Left, Right)
    ;   true
    ),
    Rest is Now + 0.5.
rest_(_, Rest, Rest).

%!  jog_end is det.
%
%   Let nobody drive any more.

jog_end :-
    retractall(until(_)).
