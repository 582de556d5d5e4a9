% Random programs with random faults, on the virtual clock: whatever happens, a call
% ends, its error is one of ISO's, and the motors stop. Random worlds: they are built
% or refused. And what is left behind: nothing.

:- use_module('../support/simulation').
:- use_module('../support/cases').
:- use_module(library(ev3dev/bricks)).
:- use_module(library(ev3dev/drive)).

% ---------------- SCHEDULES

% A program by its seed, and what somebody does to the robot meanwhile.
schedule(Seed, Steps, Faults) :-
    set_random(seed(Seed)),
    some(1, 6, step, Steps),
    some(0, 4, fault, Faults).

some(Least, Most, Kind, Terms) :-
    random_between(Least, Most, Count),
    length(Terms, Count),
    maplist(one_of(Kind), Terms).

one_of(Kind, Term) :-
    findall(Template, template(Kind, Template), Templates),
    random_member(Template, Templates),
    filled(Template, Term).

% The arguments that are names of values stand for one of them.
filled(Template, Term) :-
    Template =.. [Name|Arguments0],
    maplist(argument, Arguments0, Arguments),
    Term =.. [Name|Arguments].

argument(Kind, Value) :-
    findall(V, value_of(Kind, V), [First|Rest]),
    !,
    random_member(Value, [First|Rest]).
argument(Value, Value).

value_of(percent, V) :- member(V, [-100, -30, -5, 5, 20, 50, 100, 0.4]).
value_of(cm, V)      :- member(V, [-60, -7, -0.2, 0.3, 5, 40]).
value_of(degrees, V) :- member(V, [-720, -90, -1, 0.5, 10, 90, 400]).
value_of(counts, V)  :- member(V, [-500, -1, 0, 3, 90, 1000]).
value_of(seconds, V) :- member(V, [0, 0.02, 0.4, 2]).
value_of(motor, V)   :- member(V, [outA, outB, outC, outD]).
value_of(wheel, V)   :- member(V, [outB, outC]).
value_of(sensor, V)  :- member(V, [in1, in2, in3, in4]).
value_of(boolean, V) :- member(V, [true, false]).
value_of(x, V)       :- member(V, [12, 60, 150, 260]).
value_of(y, V)       :- member(V, [12, 80, 200]).
value_of(options, V) :-
    member(V, [ [], [], [timeout(1)], [wait(false)], [stop_action(coast)],
                [stop_action(brake)], [timeout(0.05), stop_action(hold)] ]).

template(step, go(percent)).
template(step, go_cm(percent, cm)).
template(step, go_cm(percent, cm, options)).
template(step, turn(percent, degrees)).
template(step, turn(percent, degrees, options)).
template(step, arc_cm(percent, cm, degrees, options)).
template(step, arc(percent, cm)).
template(step, steer(percent, percent)).
template(step, drive_cm(cm, degrees)).
template(step, go_to(x, y)).
template(step, go_to(x, y, degrees)).
template(step, face(degrees)).
template(step, motor_run(motor, percent)).
template(step, motor_run(motor, percent, counts)).
template(step, motor_run(motor, percent, counts, options)).
template(step, motor_run_timed(motor, percent, seconds)).
template(step, motor_run_to(motor, percent, counts, options)).
template(step, motor_run_direct(motor, percent)).
template(step, motor_reset(motor)).
template(step, motor_stop(motor)).
template(step, stop).
template(step, sim_wait(seconds)).
template(step, gyro_reset(in4)).
template(step, us_dist_cm(sensor, _)).
template(step, gyro_rate(sensor, _)).
template(step, col_color(sensor, _)).
template(step, pose(_, _, _)).
template(step, drive_wait([timeout(1)], _)).

template(fault, sim_unplug(motor)).
template(fault, sim_unplug(sensor)).
template(fault, sim_plug(wheel, 'lego-ev3-l-motor')).
template(fault, sim_plug(in4, 'lego-ev3-gyro')).
template(fault, sim_jam(wheel, boolean)).
template(fault, sim_place(x, y, degrees)).
template(fault, sim_add(box(60, 80, 10, 10))).
template(fault, sim_show(in4, value0, '32767')).
template(fault, sim_unshow(in4, value0)).

% ---------------- THE RUN

% The seconds after which the longest of the moves above is over.
longest(6000).

% What is wrong with a run; it fails if nothing is.
wrong(Seed, Wrong) :-
    schedule(Seed, Steps, Faults),
    with_sim(room, run_of(Steps, Faults, Wrongs), [seed(Seed)]),
    member(Wrong, Wrongs).

run_of(Steps, Faults, Wrongs) :-
    ignore(set_robot(5.6, 10.6, outB, outC)),
    forall(nth1(N, Faults, Fault), ( At is N * 0.3, sim_at(At, hand(Fault)) )),
    findall(Wrong, ( member(Step, Steps), step_wrong(Step, Wrong) ), Wrongs0),
    findall(Wrong, end_wrong(Wrong), Wrongs1),
    append(Wrongs0, Wrongs1, Wrongs).

hand(Fault) :-
    catch(ignore(Fault), error(_, _), true).

step_wrong(Step, Step-Wrong) :-
    sim_time(Start),
    catch(( call(Step) -> Result = true ; Result = false ), Result, true),
    sim_time(End),
    (   odd(Result)
    ->  Wrong = Result
    ;   longest(Most),
        End - Start > Most
    ->  Seconds is End - Start,
        Wrong = seconds(Seconds)
    ;   fail
    ).

% What a program need not expect.
odd(Result) :-
    \+ memberchk(Result, [true, false]),
    \+ ( Result = error(Formal, Context),
         nonvar(Formal),
         nonvar(Context),
         expected(Formal) ).

expected(instantiation_error).
expected(existence_error(_, _)).
expected(domain_error(_, _)).
expected(type_error(_, _)).
expected(permission_error(_, _, _)).
expected(resource_error(_)).

end_wrong(Wrong) :-
    catch(( stop_all_motors -> fail ; Wrong = stop_all_motors ), Error,
          Wrong = stop_all_motors(Error)).
end_wrong(turns(Port, Speed)) :-
    sim_wait(3),
    tacho_motor(Port),
    speed(Port, Speed),
    Speed =\= 0.
end_wrong(runs(Port)) :-
    motor_states(Port, States),
    memberchk(running, States).
end_wrong(pose(X, Y, Heading)) :-
    sim_pose(X, Y, Heading),
    \+ ( member(Number, [X, Y, Heading]),
         Number =:= Number,
         abs(Number) < 1.0e9 ).

waiting_move(Move) :-
    random_member(Template,
                  [ go_cm(percent, cm), turn(percent, degrees), go_to(x, y),
                    motor_run(motor, percent, counts),
                    motor_run_timed(motor, percent, seconds),
                    arc_cm(percent, cm, degrees, []), face(degrees) ]),
    filled(Template, Move).

% A program whose last call is a move that waits: then its wheels rest, if nobody
% pulled a wire, and the motors need not be stopped.
pushes(Seed, Move-Ports) :-
    set_random(seed(Seed)),
    filled(sim_place(x, y, degrees), Place),
    waiting_move(Move),
    filled(sim_jam(wheel, boolean), Jam),
    with_sim(room,
             ( catch(ignore(Place), error(_, _), true),
               set_robot(5.6, 10.6, outB, outC),
               Jam,
               ignore(Move),
               sim_wait(5),
               findall(Port,
                       ( motor_states(Port, States),
                         memberchk(running, States)
                       ),
                       Ports) ),
             [seed(Seed)]),
    Ports \== [].

% A move that is left by a signal: its motors stop.
after_signal(Seed, Move) :-
    set_random(seed(Seed)),
    waiting_move(Move),
    random(Share),
    with_sim(room,
             ( set_robot(5.6, 10.6, outB, outC),
               thread_self(Me),
               thread_create(( sim_wait(Share), thread_signal(Me, throw(storm)) ), Id, []),
               catch(( ignore(Move), sim_wait(2) ), Error, true),
               thread_join(Id, _),
               (   Error == storm
               ->  \+ at_rest
               ;   true
               ) )).

% ---------------- WORLDS

% The facts of a shipped world and robot, one of them spoilt.
spoilt_world(Seed, World, Robot) :-
    set_random(seed(Seed)),
    random_member(World0, [room, grid, line, lights, maze]),
    random_member(Robot0, [default, touch]),
    facts_of(worlds, World0, WorldFacts),
    facts_of(robots, Robot0, RobotFacts),
    (   maybe
    ->  spoil(WorldFacts, World),
        Robot = RobotFacts
    ;   World = WorldFacts,
        spoil(RobotFacts, Robot)
    ).

facts_of(Folder, Name, Facts) :-
    atomic_list_concat(['prolog/ev3dev/', Folder, /, Name, '.pl'], File),
    read_file_to_terms(File, Facts, []).

spoil(Facts0, Facts) :-
    changed(Facts0, Fact0, Fact, Facts),
    Fact0 =.. [Name|Arguments0],
    random_member(Way, [other, other, more, less]),
    spoil(Way, Arguments0, Arguments),
    Fact =.. [Name|Arguments].

spoil(other, Arguments0, Arguments) :-
    Arguments0 = [_|_],
    !,
    changed(Arguments0, _, Value, Arguments),
    odd_value(Value).
spoil(less, [_|Arguments], Arguments) :-
    !.
spoil(_, Arguments, [Value|Arguments]) :-
    odd_value(Value).

% A random one of a list, and the list with another one in its place.
changed(List0, Old, New, List) :-
    length(List0, Count),
    random(0, Count, Index),
    length(Before, Index),
    append(Before, [Old|After], List0),
    append(Before, [New|After], List).

odd_value(Value) :-
    random_member(Value,
                  [ 0, -1, 1, 0.001, -5.5, 1.0e300, -1.0e300, 1.0e-300, 1000000,
                    100000000000000000000, a, [], "text", f(x), [1, 2], 1-2,
                    [1, 2|_], 'outZ', red, _ ]).

world_wrong(Seed, Wrong) :-
    spoilt_world(Seed, World, Robot),
    catch(with_sim(World, drives_there(Wrongs), [robot(Robot)]),
          Error,
          ( odd(Error) -> Wrongs = [Error] ; Wrongs = [] )),
    member(Wrong, Wrongs).

drives_there(Wrongs) :-
    set_robot(5.6, 10.6, outB, outC),
    !,
    ignore(go_cm(50, 20, [timeout(3)])),
    forall(lego_sensor(Port), ignore(value(Port, 0, _))),
    findall(Wrong, end_wrong(Wrong), Wrongs).
drives_there([]).

% The text of a shipped world with some bytes spoilt. It is read, or refused with the
% place in the file.
world_text_wrong(Seed, Error) :-
    set_random(seed(Seed)),
    random_member(World, [room, grid, line, lights, maze, delivery, sumo]),
    atomic_list_concat(['prolog/ev3dev/worlds/', World, '.pl'], Shipped),
    read_file_to_codes(Shipped, Codes0, []),
    random_between(1, 6, Count),
    spoilt_text(Count, Codes0, Codes),
    string_codes(Text, Codes),
    with_file(Text, File,
              catch(with_sim(File, ignore(us_dist_cm(_, _))), Error, true)),
    nonvar(Error),
    \+ is_of_file(Error).

is_of_file(error(syntax_error(_), file(_, _, _, _))).
is_of_file(error(Formal, fact(file(_, _, _, _), Why))) :-
    nonvar(Formal),
    atom(Why).
is_of_file(error(Formal, context(with_sim/2, Why))) :-
    nonvar(Formal),
    atom(Why).

spoilt_text(0, Codes, Codes) :-
    !.
spoilt_text(Count, Codes0, Codes) :-
    length(Codes0, Length),
    random(0, Length, Index),
    length(Before, Index),
    append(Before, [Code|After], Codes0),
    random_member(New,
                  [ [], [Code, Code], [0'(], [0')], [0',], [0'.], [0''], [0'"], [0'[],
                    [0'-], [0'9, 0'9], [0'_], [10], [1], [255], [0x1f916] ]),
    append([Before, New, After], Codes1),
    Next is Count - 1,
    spoilt_text(Next, Codes1, Codes).

% ---------------- LEAKS

% A call of each kind: one that reads, runs, waits, fails, throws.
hot(us_dist_cm(_, _)).
hot(sensor_value(in4, 'GYRO-ANG', 0, _)).
hot(motor_run(outB, 20)).
hot(motor_states(outB, _)).
hot(tacho_motor(_)).
hot(led(left, red)).
hot(pose(_, _, _)).
hot(touch(in5, 1)).
hot(catch(motor_run(_, 20), _, true)).
hot(wait(0.001)).
hot(sim_snapshot(_)).
hot(with_sim(room, true)).
hot(( brick_open(guest, sim), with_brick(guest, volume(_)), brick_close(guest) )).

% More than 10 bytes a call are left behind, beyond 200 kB that Prolog takes for itself. What
% leaks does so each time; the collector of atoms may be late once.
grows(Goal, Bytes) :-
    hot(Goal),
    Count = 10000,
    with_sim([],
             ( set_robot(5.6, 10.6, outB, outC),
               repeated(Count, Goal),
               resident(Before),
               grows_each_time(3, Goal, Count, Before, Bytes) )).

grows_each_time(Times, Goal, Count, Before, Bytes) :-
    repeated(Count, Goal),
    resident(After),
    Bytes1 is (After - Before - 200000) / Count,
    Bytes1 > 10,
    (   Times > 1
    ->  Times1 is Times - 1,
        grows_each_time(Times1, Goal, Count, After, Bytes)
    ;   Bytes = Bytes1
    ).

repeated(Count, Goal) :-
    forall(between(1, Count, _), ignore(Goal)).

resident(Bytes) :-
    garbage_collect,
    garbage_collect_atoms,
    trim_stacks,
    read_file_to_string('/proc/self/statm', Text, []),
    split_string(Text, " ", "", [_, Pages|_]),
    number_string(Count, Pages),
    Bytes is Count * 4096.

% ---------------- TESTS

all_wrong(Wrong_2, Wrongs) :-
    schedules(First, Last),
    findall(Seed:Wrong,
            ( between(First, Last, Seed), call(Wrong_2, Seed, Wrong) ),
            Wrongs).

:- begin_tests(torture, [ setup(silent(true)), cleanup(silent(false)) ]).
% Moves that end early warn: not here.
silent(true) :-
    asserta((user:message_hook(_, warning, _) :- !)).
silent(false) :-
    retract((user:message_hook(_, warning, _) :- !)).

test(random_programs_with_random_faults, true(Wrongs == [])) :-
    all_wrong(wrong, Wrongs).
test(no_move_ends_with_a_motor_that_runs, true(Wrongs == [])) :-
    all_wrong(pushes, Wrongs).
test(a_move_that_a_signal_ends_stops_its_motors, true(Wrongs == [])) :-
    all_wrong(after_signal, Wrongs).
test(worlds_are_built_or_refused, true(Wrongs == [])) :-
    all_wrong(world_wrong, Wrongs).

test(world_files_are_read_or_refused, true(Wrongs == [])) :-
    all_wrong(world_text_wrong, Wrongs).
% An emulator, on which a fiftieth of the cases is tried, grows by itself.
test(calls_leave_no_memory_behind,
     [condition(( cases(100, Used), Used >= 10 )), true(Growing == [])]) :-
    findall(Goal-Bytes, grows(Goal, Bytes), Growing).

test(simulations_leave_nothing_open, true(After =< Before)) :-
    forall(between(1, 20, _), a_simulation),
    open_files(Before),
    forall(( cases(300, Count), between(1, Count, _) ), a_simulation),
    open_files(After).

a_simulation :-
    with_sim(room, ( motor_run(outB, 50), us_dist_cm(_, _), led(left, red), tone(440, 10) )).

open_files(Count) :-
    directory_files('/proc/self/fd', Files),
    length(Files, Count).
:- end_tests(torture).
