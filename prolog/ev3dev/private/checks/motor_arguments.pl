:- module(ev3dev_motor_arguments,
          [ motor_options/5,            % +Options, +Stop, +Stops, +Ramp, -O
            stop_action/3,              % +Stops, +Word, -Action
            motor_runs/2,               % +Runs, -Evaluated
            motor_moves/2               % +Moves, -Evaluated
          ]).
:- use_module(arguments,
              [ angle_value/2, must_be_options/3, must_be_within/4, option/3,
                speed_value/2, timeout_option/2, word/2 ]).
:- use_module(checks, [evaluated/2, must_be/2]).
:- use_module('../errors/errors', [domain_error/2, throw_error/3]).

/** <module> Options, runs and moves of motors
*/

%!  motor_options(+Options, +Stop, +Stops, +Ramp, -Term) is det.
%
%   Term is what native predicates take for the options of a move: motor_run/4
%   explains them. Stop is the default stop action, Stops are all there are,
%   Ramp is the longest ramp.

motor_options(Options, Stop, Stops, Ramp,
              options(Action, RampUp, RampDown, Wait, Timeout)) :-
    must_be_options(motor_option,
                    [stop_action, ramp_up, ramp_down, wait, timeout],
                    Options),
    option(stop_action(Action0), Options, Stop),
    option(ramp_up(RampUp), Options, default),
    option(ramp_down(RampDown), Options, default),
    option(wait(Wait), Options, true),
    timeout_option(Options, Timeout),
    stop_action(Stops, Action0, Action),
    must_be(boolean, Wait),
    must_be_ramp(ramp_up_sp, Ramp, RampUp),
    must_be_ramp(ramp_down_sp, Ramp, RampDown).

%!  stop_action(+Stops, +Word, -Action) is det.
%
%   Action is the one of Stops that Word names, an atom or a string.
%
%   @error domain_error(stop_action, Action)

stop_action(Stops, Action0, Action) :-
    word(Action0, Action),
    (   memberchk(Action, Stops)
    ->  true
    ;   throw_error(domain_error(stop_action, Action), _,
                    one_of(Action, Stops))
    ).

must_be_ramp(_, _, Milliseconds) :-
    Milliseconds == default,
    !.
must_be_ramp(Attribute, Longest, Milliseconds) :-
    must_be_within(0, Longest, Attribute, Milliseconds).

%!  motor_runs(+Runs, -Evaluated) is det.
%
%   Evaluated is a list of `run(Port, Value)` with values of speed_value/2,
%   for Runs as those of motors_run/1.
%
%   @error domain_error(motor_run, Run) if Run has another form

motor_runs(Runs, Evaluated) :-
    (   is_list(Runs)
    ->  runs(Runs, Evaluated)
    ;   must_be(list, Runs)
    ).

runs([], []).
runs([Run|Runs], [run(Port, Percent)|Evaluated]) :-
    (   nonvar(Run),
        Run = run(Port, Speed)
    ->  speed_value(Speed, Percent)
    ;   none_of(motor_run, Run)
    ),
    runs(Runs, Evaluated).

%!  motor_moves(+Moves, -Evaluated) is det.
%
%   Evaluated is a list of Moves as those of motors_turn/2, with numbers, and
%   values of speed_value/2.
%
%   @error domain_error(motor_move, Move) if Move has another form

motor_moves([], []).
motor_moves([Move|Moves], [Evaluated|Rest]) :-
    (   nonvar(Move),
        move(Move, Speed, Way, Evaluated, Value, Number)
    ->  speed_value(Speed, Value),
        way_value(Way, Number)
    ;   none_of(motor_move, Move)
    ),
    motor_moves(Moves, Rest).

move(move(Port, S, Angle), S, angle(Angle), move(Port, V, N), V, N).
move(to(Port, S, Angle), S, angle(Angle), to(Port, V, N), V, N).
move(for(Port, S, Time), S, time(Time), for(Port, V, N), V, N).

way_value(angle(Angle), Degrees) :-
    angle_value(Angle, Degrees).
way_value(time(Time), Seconds) :-
    evaluated(Time, Seconds).

none_of(Domain, Term) :-
    must_be(nonvar, Term),
    domain_error(Domain, Term).
