% Moves with ramps on the simulator, which is as treacherous as the kernel.

:- use_module('../support/cases').
:- use_module('../support/trees').

/*  The kernel ignores a move with ramps if it measures the very speed that is set,
    and starts a timed run again that ended before its ramp. No sequence of moves
    may end in a motor that turns forever because of that.
*/

% A random sequence of steps with outA, the free motor, by its seed.
schedule(Seed, Steps) :-
    set_random(seed(Seed)),
    random_between(2, 7, Count),
    length(Steps, Count),
    maplist(random_step, Steps).

random_step(Step-Wait) :-
    random_member(Step,
                  [ forever, by, by, to, to, timed, timed, ramps, ramps, command,
                    command, stop, zero ]),
    random_member(Wait, [0, 0, 0.01, 0.1, 0.6, 1.5]).

% Speeds that are taken again and again are those that are measured, too.
random_speed(Speed) :- random_member(Speed, [20, 20, 20, -20, -20, 50, -70]).

random_angle(Angle) :- random_member(Angle, [-400, -90, -3, 0, 2, 60, 300, 720]).

random_ramp(Ramp) :- random_member(Ramp, [0, 0, 1, 60, 300, 1000, 2500]).

random_options([wait(false), stop_action(Action)|Ramps]) :-
    random_member(Action, [coast, brake, hold]),
    random_ramp(Up),
    random_ramp(Down),
    random_member(Ramps, [[], [], [ramp_up(Up)], [ramp_up(Up), ramp_down(Down)]]).

take(Step-Wait) :-
    ignore(take_(Step)),
    sim_wait(Wait).

take_(forever) :- random_speed(Speed), motor_run(outA, Speed).
take_(by) :-
    random_speed(Speed), random_angle(Angle), random_options(Options),
    motor_run(outA, Speed, Angle, Options).
take_(to) :-
    random_speed(Speed), random_angle(Angle), random_options(Options),
    motor_run_to(outA, Speed, Angle, Options).
take_(timed) :-
    random_speed(Speed), random_options(Options),
    random_member(Seconds, [0, 0.05, 0.3, 1]),
    motor_run_timed(outA, Speed, Seconds, Options).
take_(ramps) :- random_ramp(Up), random_ramp(Down), motor_ramps(outA, Up, Down).
take_(command) :-
    random_member(Word, ['run-to-abs-pos', 'run-to-rel-pos', 'run-timed']),
    random_speed(Percent), random_angle(Angle),
    Speed is Percent * 15,
    speed_sp(outA, Speed),
    position_sp(outA, Angle),
    motor_attribute(outA, time_sp, 200),
    command(outA, Word).
take_(stop) :- motor_stop(outA).
take_(zero) :- motor_position(outA, 0).

% The last step is one that ends.
ending([by, to, timed, command, stop]).

rests :-
    position(outA, P0),
    sim_wait(0.4),
    position(outA, P),
    abs(P - P0) =< 1.

is_endless(Seed) :-
    motor_reset(outA),
    schedule(Seed, Steps),
    ending(Endings),
    random_member(Last, Endings),
    maplist(take, Steps),
    take(Last-12),
    \+ ( between(1, 20, _), ( rests -> true ; sim_wait(1), fail ) ).

% The motor turns, and is sent 200 back from where it is.
goes_back(Way, N) :-
    at_speed(N),
    motor_position(outA, P0),
    motor_ramps(outA, 500, 500),
    (   Way == by
    ->  motor_run(outA, -20, 200, [wait(false)])
    ;   Target is P0 - 200,
        motor_run_to(outA, 20, Target, [wait(false)])
    ),
    sim_wait(6),
    motor_position(outA, P),
    near(P, P0 - 200, 40).

goes_on(N) :-
    at_speed(N),
    motor_position(outA, P0),
    motor_ramps(outA, 500, 500),
    motor_run(outA, 20, 400, [wait(false)]),
    sim_wait(6),
    motor_position(outA, P),
    near(P, P0 + 400, 40).

at_speed(N) :-
    motor_reset(outA),
    motor_run(outA, 20),
    Wait is 1 + N * 0.002,
    sim_wait(Wait).

:- begin_tests(motor_ramps_end).
test(no_sequence_of_moves_turns_for_ever, true(Seeds == [])) :-
    schedules(First, Last),
    with_sim([], findall(Seed, ( between(First, Last, Seed), is_endless(Seed) ), Seeds)).

test(a_move_back_at_the_speed_that_is_measured, [forall(member(Way, [by, to])), true(L == [])]) :-
    with_sim([],
             findall(N, ( between(1, 20, N), \+ goes_back(Way, N) ), L)).

test(a_move_on_at_the_speed_that_is_measured, true(L == [])) :-
    with_sim([], findall(N, ( between(1, 20, N), \+ goes_on(N) ), L)).

test(a_timed_run_ends_at_its_time,
     [ forall(member(Seconds, [0.3, 0.9, 6, 45])), true ]) :-
    with_sim([],
             ( sim_time(T0),
               motor_run_timed(outA, 30, Seconds),
               sim_time(T),
               near(T - T0, Seconds, 0.01) )).

test(a_timed_run_ends_before_its_ramp_is_done) :-
    with_sim([],
             ( motor_run_timed(outA, 90, 0.4, [ramp_up(2000), wait(false)]),
               sim_wait(0.6),
               motor_states(outA, Ss), \+ memberchk(running, Ss),
               sim_wait(1),
               rests )),
    with_sim([],
             ( sim_time(T0),
               motor_run_timed(outA, 90, 0.4, [ramp_up(2000)]),
               sim_time(T),
               near(T - T0, 0.4, 0.01),
               sim_wait(1),
               rests,
               motor_ramps(outA, 0, 0) )).

% It is not blocked, only slow for long.
test(a_ramp_of_a_minute_is_no_stall, [forall(member(Up, [20000, 60000])), true(Ws == [])]) :-
    with_sim(room,
             warnings(( motor_run_timed(outB, 90, 3, [ramp_up(Up)]),
                        motor_run(outB, 90, 20, [ramp_up(Up)])
                      ), Ws)).
test(a_motor_that_is_held_is_blocked_within_a_ramp, true(Seconds < 2)) :-
    with_sim(room,
             ( sim_jam(outB, true),
               warnings(\+ motor_run(outB, 90, 360, [ramp_up(60000)]), [_]),
               sim_time(Seconds) )).

% The motor still turns when each begins.
test(short_moves_in_a_row_are_all_over_soon, true(Late == [])) :-
    with_sim(room,
             ( motor_ramps(outB, 80, 7),
               findall(Angle-Seconds,
                       ( between(1, 40, _),
                         member(Angle, [7, -7, 1.5, 97, -0.0]),
                         sim_time(T0),
                         motor_run(outB, 80, Angle, [timeout(20)]),
                         sim_time(T),
                         Seconds is T - T0,
                         Seconds > 10 ),
                       Late) )).
:- end_tests(motor_ramps_end).
