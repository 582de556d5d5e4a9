% docs/coming-from.md names what there is.

:- use_module('../support/simulation').
:- use_module(library(ev3dev/drive)).
:- use_module(library(ev3dev/grid)).
:- use_module(library(ev3dev/gripper)).
:- use_module(library(ev3dev/roadmap)).
:- use_module(library(ev3dev/rules)).
:- use_module(library(ev3dev/colors)).
:- use_module(library(ev3dev/console)).
:- use_module(library(ev3dev/raw)).
:- ensure_loaded('../support/ported').

% The terms in the second column of a table of two columns, below a heading.
said_here(Heading, Term) :-
    read_file_to_string('docs/coming-from.md', Text, []),
    split_string(Text, "\n", "", Lines),
    append(_, [Heading|Below], Lines),
    append(Section, Next, Below),
    ( Next == [] ; Next = [Line|_], sub_string(Line, 0, _, _, "## ") ),
    !,
    member(Row, Section),
    split_string(Row, "|", " ", ["", _, Cell, ""]),
    split_string(Cell, "`", "", Parts),
    nth0(Index, Parts, Code),
    Index mod 2 =:= 1,
    term_to_atom(Term, Code).

goal_of((A, B), Goal) :-
    !,
    ( goal_of(A, Goal) ; goal_of(B, Goal) ).
goal_of(Goal, Goal) :-
    compound(Goal),
    \+ is_list(Goal),
    functor(Goal, Name, _),
    \+ memberchk(Name, [library, rpm, rps, (-)]).

:- begin_tests(coming_from).
test(each_word_is_exported,
     [ forall(member(Heading, ["## python-ev3dev2", "## Pybricks", "## leJOS"])),
       true(Missing == []) ]) :-
    findall(Goal, ( said_here(Heading, Term), goal_of(Term, Goal) ), Goals),
    length(Goals, Count),
    Count > 15,
    findall(Goal,
            ( member(Goal, Goals), \+ predicate_property(user:Goal, visible) ),
            Missing).
test(each_word_runs_in_the_simulator,
     [ forall(member(Heading, ["## python-ev3dev2", "## Pybricks", "## leJOS"])),
       true(Errors == []) ]) :-
    findall(Goal-E,
            ( said_here(Heading, Term), goal_of(Term, Goal),
              predicate_property(user:Goal, visible),
              \+ lacks(Goal),
              with_sim(room,
                       ( set_robot(5.6, 10.6, outB, outC),
                         catch(( ignore(for_seconds(5, user:Goal)), fail ), E, true) )),
              % Old versions have no engines, for both/2 and race/2
              E \= error(existence_error(feature, engines), _) ),
            Errors),
    ignore(event_cancel(_)).

%   What the page leaves open, or the robot does not have.
lacks(Goal) :-
    member(Goal,
           [ go_to(_, _), navigate_to(_, _), behave(_), elapsed(_, _),
             play(_), screen_text(_, _, _), sensor_values(_, _, _),
             i2c_read(_, _, _, _), i2c_write(_, _, _), screen_image(_, _, _),
             open(_, _, _), format(_, _, _), close(_) ]).
% Each row of what the paper cites names examples, and each of these is there.
test(each_work_has_its_examples, true(Missing == [])) :-
    read_file_to_string('docs/coming-from.md', Text, []),
    split_string(Text, "\n", "", Lines),
    append(_, ["## What the paper of 2019 cites"|Below], Lines),
    !,
    findall(Cited-Examples,
            ( member(Row, Below),
              string_concat("| [", _, Row),
              split_string(Row, "|", " ", ["", Cited, _, Cell, ""]),
              split_string(Cell, "`", ", ", Parts),
              exclude(==(""), Parts, Examples) ),
            Rows),
    length(Rows, Count),
    assertion(Count >= 12),
    findall(Cited-Example,
            ( member(Cited-Examples, Rows),
              (   Examples == [], Example = none
              ;   member(Example, Examples),
                  format(string(File), "examples/~w.pl", [Example]),
                  \+ exists_file(File) ) ),
            Missing).
:- end_tests(coming_from).

:- begin_tests(ported).
% A robot of these devices beside its wheels, which have this diameter.
robot(Diameter, Devices, [ left_wheel(outB, Diameter), right_wheel(outC, Diameter), axle(10.6),
                           hull(circle(8)), mass(0.75), motor(outB, 'lego-ev3-l-motor'),
                           motor(outC, 'lego-ev3-l-motor') | Devices ]).

:- meta_predicate run(+, +, 0), at_once(+, 0), runs(+, -).

run(World, Goal) :-
    run(World, 5.6, Goal).

run(World, Diameter, Goal) :-
    robot(Diameter, [ motor(outA, 'lego-ev3-m-motor'), sensor(in4, 'lego-ev3-ir', 0, 8, 0) ],
          Robot),
    with_sim(World, call_cleanup(Goal, ignore(event_cancel(_))), [robot(Robot)]).

keys(Seconds, Keys) :-
    sim_at(Seconds, sim_remote(1, Keys)).

% Where a motor turns to, at a moment.
note_turns(Seconds, Port) :-
    sim_at(Seconds, user:note_turn(Port)).

:- dynamic user:turned/1.

user:note_turn(Port) :-
    speed(Port, Speed),
    Sign is sign(round(Speed / 50)),
    assertz(user:turned(Sign)).

turns(Turns) :-
    findall(Turn, retract(user:turned(Turn)), Turns).

% The sensor takes 1.1 s to change its mode.
test(a_key_that_is_held_from_the_start_drives, [true(Turns == [1, 0])]) :-
    run([], ( keys(0, [red_up]), note_turns(3, outB), keys(4, []), note_turns(6, outB),
              for_seconds(7, snake) )),
    turns(Turns).
test(each_key_drives_or_steers_and_its_release_stops,
     [ forall(member(Key-Port-Sign, [ red_up-outB-1, red_down-outB-(-1), blue_up-outC-1,
                                      blue_down-outC-(-1) ])),
       true(Turns == [0, Sign, 0]) ]) :-
    run([], ( note_turns(2, Port), keys(2.1, [Key]), note_turns(3, Port), keys(3.1, []),
              note_turns(4, Port), for_seconds(5, snake) )),
    turns(Turns).
test(one_key_right_after_another,
     [ forall(member(A-B-Turn, [ red_up-red_down-(-1), red_down-red_up-1 ])),
       true(Turns == [Turn]) ]) :-
    run([], ( keys(2, [A]), keys(3, [B]), note_turns(4, outB), for_seconds(5, snake) )),
    turns(Turns).
test(the_key_of_the_beacon_strikes, [true(Turns == [1, -1])]) :-
    run([], ( keys(2, [beacon]), note_turns(2.15, outA), note_turns(2.38, outA),
              for_seconds(4, snake) )),
    turns(Turns).
test(it_bites_what_comes_near, [true(Turns == [0, 1])]) :-
    run([], ( sim_at(3, sim_add(wall(-50, 25, 50, 25), _)), note_turns(2.9, outA),
              note_turns(3.2, outA), bite, ev3_time(Time) )),
    near(Time, 3.4, 0.1),
    turns(Turns).
test(the_robot_finds_the_beacon, [forall(member(X-Y, [60-80, -60-80, 50-(-60)]))]) :-
    run([beacon(X, Y, 1)], ( for_seconds(30, follow_beacon), sim_pose(AtX, AtY, _), at_rest )),
    Distance is sqrt((X - AtX) ** 2 + (Y - AtY) ** 2),
    near(Distance, 38, 10).
test(a_log_has_a_line_for_each_look, [true(Header-Count == "time,angle,speed"-10)]) :-
    setup_call_cleanup(
        tmp_file(log, File),
        ( run([], log_motor(File)), read_file_to_string(File, Text, []) ),
        delete_file(File)),
    split_string(Text, "\n", "\n", [Header|Lines]),
    length(Lines, Count),
    last(Lines, Last),
    split_string(Last, ",", "", Fields),
    maplist(number_string, [Time, Angle, Speed], Fields),
    near(Time, 1, 0.05),
    near(Angle, 300, 15),
    near(Speed, 300, 15).
test(both_tasks_go_on, [condition(current_predicate(system:engine_create/3)), true(Light == off)]) :-
    run([], ( square_and_blink, ev3_time(Time), sim_pose(X, Y, _), led(left, Light) )),
    near(X, 0, 2), near(Y, 0, 2),
    for_one(square, Alone),
    near(Time, Alone, 1).
test(the_first_task_ends_the_other,
     [condition(current_predicate(system:engine_create/3)), true(Winner == 2)]) :-
    run([], ( square_until_blinked(Winner), ev3_time(Time), at_rest )),
    near(Time, 3, 0.1).
test(a_picture_is_shown_and_a_sound_played, [true(Played == [Wav])]) :-
    setup_call_cleanup(
        silence(Wav),
        run([], ( screen_clear, screen_image(0, 0, 'tests/pictures/sample.png'), screen_show,
                  shown(Expected), screen_clear, screen_show,
                  greet('tests/pictures/sample.png', Wav), shown(Expected), ev3_time(Time),
                  sim_trace(Trace) )),
        delete_file(Wav)),
    Time > 1,
    findall(File, member(_-played(File), Trace), Played).
test(an_arm_finds_its_end_stop_and_goes_to_its_angle) :-
    run([], ( sim_at(1, sim_jam(outA, true)), sim_at(1.5, sim_jam(outA, false)),
              arm(Steps), motor_position(outA, Angle), position(outA, Counts) )),
    near(Angle, 90, 1),
    near(Counts, 270, 3),
    near(Steps, 36, 12).
test(a_geared_robot_drives_in_centimeters) :-
    Diameter is 5.6 / 3,
    run([], Diameter, ( geared_square, sim_pose(X, Y, Heading), pose(X1, Y1, _) )),
    near(X, 0, 1), near(Y, 0, 1), near(Heading, 360, 3), near(X1, X, 1), near(Y1, Y, 1).

for_one(Goal, Seconds) :-
    run([], ( Goal, ev3_time(Seconds) )).

%   What the screen shows, as a PNG file.
shown(Text) :-
    tmp_file(png, File),
    screen_png(File),
    read_file_to_codes(File, Codes, [type(binary)]),
    delete_file(File),
    atom_codes(Text, Codes).

%   A WAV file of a second of silence: 8000 bytes of one channel.
silence(File) :-
    tmp_file(wav, File),
    length(Samples, 8000),
    maplist(=(128), Samples),
    atom_codes('RIFF----WAVEfmt ', Riff),
    append([ Riff, [16, 0, 0, 0, 1, 0, 1, 0, 0x40, 0x1f, 0, 0, 0x40, 0x1f, 0, 0, 1, 0, 8, 0],
             `data----`, Samples ], Bytes),
    setup_call_cleanup(open(File, write, Stream, [type(binary)]),
                       forall(member(Byte, Bytes), put_byte(Stream, Byte)),
                       close(Stream)).
:- end_tests(ported).
