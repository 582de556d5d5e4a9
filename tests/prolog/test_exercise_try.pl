% exercise_try/3 says why a program does not earn all points: where it ended, what it lacks, or by
% how much it missed a score.

:- use_module('../support/cases').
:- use_module('../support/trees').
:- use_module('../support/same_reasons').
:- use_module(library(ev3dev/exercise)).
:- use_module(library(filesex), [delete_directory_and_contents/1]).

%   says(What, Lines, Said): a program with these Lines after the first two; each of Said, where `*`
%   is any text, is a line of the answer.
says(a_goal_that_fails_is_named_with_its_values,
     [ "start :- robot, us_dist_cm(in1, Cm), near(Cm).",
       "near(Cm) :- Cm < 3." ],
     "It ended at * s: mine.pl:4: start failed; its last goal was *<3, in near/1").
says(a_number_that_is_not_computed,
     [ "start :- robot, square(4).",
       "square(N) :- go_cm(30, 30), turn(30, 90), square(N-1).",
       "square(0)." ],
     "It was still under way after 20 s: square/1 calls itself without end: square(4), then square(4-1), *").
says(a_count_that_goes_past_its_end,
     [ "start :- robot, side(3).",
       "side(0).",
       "side(N) :- turn(30, 90), N1 is N-2, back(N1).",
       "back(N) :- turn(30, -90), side(N)." ],
     "It was still under way after 20 s: * calls itself without end: *(1), then *").
says(time_that_is_not_the_robots,
     [ "start :- robot, go(20), sleep(0.1), stop." ],
     "mine.pl:3: sleep/1 does not follow the robot's time: use wait/1").
says(a_world_of_its_own,
     [ ":- use_module(library(ev3dev/sim)).",
       "start :- with_sim(room, go(20))." ],
     "mine.pl:4: take with_sim/2 out: the exercise has its own world").
says(a_rule_that_never_has_its_turn,
     [ "wander :: true ~> turn(20).",
       "avoid :: us_dist_cm(in1, Cm), Cm < 30 ~> go(-20).",
       "start :- robot, behave([wander, avoid])." ],
     "Rule avoid never had its turn: wander comes before it in behave, and always applies").
says(a_score_that_is_missed_by_far,
     [ "start :- robot, turn(20, 90)." ],
     "visits: it was in 1 square of 30 cm; at least 4 would count").
says(a_score_by_a_predicate_of_the_exercise,
     [ "start :- robot, turn(20, 90)." ],
     "is quick: it was 0.0; more than 15 would count").
says(a_recursion_without_end,
     [ "e(a, b). e(b, a).",
       "plan(G, G, []).",
       "plan(S, G, [N|P]) :- e(S, N), plan(N, G, P).",
       "start :- robot, plan(a, c, P), print(P)." ],
     "It ended at * s: mine.pl:5: plan/3 calls itself without end: the stack of * MB is full*").
says(a_list_without_end,
     [ "start :- robot, length(L, 300000000), print(L)." ],
     "It ended at * s: mine.pl:3: start/0 needs too much memory: the stack of * MB is full").
says(a_misspelt_predicate_in_a_rule,
     [ "start :- robot, behave([avoid]).",
       "avoid :: us_dist_cm(in1, Cm), Cm > 3 ~> tun(20)." ],
     "It ended at * s: there is no tun/1, in the action of rule avoid (mine.pl:4). Did you mean: turn(Speed)*").
says(a_space_before_a_parenthesis,
     [ "start :- robot,",
       "    go_cm (20, 20)." ],
     "Line 4, column 9: Operator expected: write go_cm( without a space.").
says(another_name_for_start,
     [ "main :- robot, side.",
       "side :- go_cm(20, 20)." ],
     "It ended at * s: there is no start/0: your file has main/0, so call that start").
says(a_port_with_another_sensor,
     [ "start :- robot, us_dist_cm(in2, Cm), go_cm(20, Cm)." ],
     "in2 has lego-ev3-color, no ultrasonic sensor; *").
says(a_port_without_a_motor,
     [ "start :- robot, motor_run(outD, 20)." ],
     "there is no motor at outD; *").
says(a_world_that_is_started,
     [ ":- use_module(library(ev3dev/sim)).",
       "start :- robot, sim_start(room), go(20)." ],
     "mine.pl:4: take sim_start/1 out: the exercise has its own world").
says(a_long_sleep,
     [ "start :- robot, go(20), sleep(40)." ],
     "Stopped after 30 s of waiting (robot time *").
says(a_sensor_that_was_not_read,
     [ "start :- robot, go(40), touching.",
       "touching :- touch(in4, 1), wait(0.2), touching.",
       "touching :- wait(0.2), touching." ],
     "*it ran into *in4 showed *The program had not read in1.").

%   unlike(What, Lines): what a program has from its first line on.
unlike(no_library,
       [ "start :- set_robot(5.6, 10.6, outB, outC), go_cm(20, 100)." ],
       "It ended at 0.0 s: mine.pl:1: set_robot/4 is in library(ev3dev), which your file does not load: begin it with :- use_module(library(ev3dev)).").
unlike(a_world_in_a_directive,
       [ ":- use_module(library(ev3dev)).",
         ":- use_module(library(ev3dev/sim)).",
         ":- initialization(main).",
         "main :- sim_start(room), start.",
         "start :- set_robot(5.6, 10.6, outB, outC), go(20), wait(1), stop." ],
       "mine.pl:4: take sim_start/1 out: the exercise has its own world").
unlike(nothing_done,
       [ ":- use_module(library(ev3dev)).", "start." ],
       "It did not use the robot.").
unlike(a_robot_that_is_not_set,
       [ ":- use_module(library(ev3dev)).", ":- go(20).", "start :- wait(1)." ],
       "Line 2: no robot is set: see set_robot/4").
unlike(a_world_that_nothing_calls,
       [ ":- use_module(library(ev3dev)).", ":- use_module(library(ev3dev/sim)).",
         "home :- sim_start(room), start.",
         "start :- set_robot(5.6, 10.6, outB, outC), turn(20, 90)." ],
       "visits: it was in 1 square of 30 cm; at least 4 would count").

tries(Lines, Text) :-
    tries(free, Lines, Text).

tries(Thinking, Lines, Text) :-
    judged(Thinking, [ ":- use_module(library(ev3dev)), use_module(library(ev3dev/rules)).",
                       "robot :- set_robot(5.6, 10.6, outB, outC)."
                     | Lines ], Text, _).

%   Text is what try says, and Reason that of mark.
judged(Thinking, Lines, Text, Reason) :-
    format(string(Exercise0), "exercise(e, [seconds(20), seeds(1), thinking(~w)]).", [Thinking]),
    tmp_file(exercise, Folder),
    make_directory(Folder),
    atom_concat(Folder, '/exercise.pl', Exercise),
    atom_concat(Folder, '/mine.pl', Mine),
    setup_call_cleanup(
        ( write_lines(Exercise,
                      [ ":- use_module(library(ev3dev/exercise)).",
                        Exercise0,
                        "score(5, visits) :- cells_visited(30, N), N >= 4, collisions(0).",
                        "score(1, 'is quick') :- is_quick.",
                        "is_quick :- path_length(Cm), duration(S), Cm/S > 15.",
                        "score(5, rests) :- ended(exit(0)), cells_visited(30, N), N >= 4." ]),
          write_lines(Mine, Lines) ),
        ( said_by_try(Exercise, Mine, [enclosed(false)], Text),
          marked_reasons(Exercise, [Mine], [enclosed(false)], [Reason]) ),
        delete_directory_and_contents(Folder)),
    tried_reason(Text, Tried),
    assertion(Tried == Reason).

write_lines(File, Lines) :-
    setup_call_cleanup(open(File, write, Out),
                       forall(member(Line, Lines), format(Out, "~s~n", [Line])),
                       close(Out)).

like(Text, Pattern) :-
    split_string(Text, "\n", " ", Lines),
    member(Line, Lines),
    wildcard_match(Pattern, Line),
    !.

:- begin_tests(exercise_try).
test(it_says, [forall(( says(What, Lines, Said), can_be_said(What) ))]) :-
    tries(Lines, Text),
    ( like(Text, Said) -> true ; throw(What-Text) ).
test(it_says_of_a_file, [forall(unlike(What, Lines, Said))]) :-
    judged(free, Lines, Text, _),
    ( like(Text, Said) -> true ; throw(What-Text) ).

% 7.2.3 says neither the values of a goal that failed nor the goals on a full
% stack.
can_be_said(_) :-
    current_prolog_flag(version, Version),
    Version >= 80000,
    !.
can_be_said(What) :-
    \+ memberchk(What, [ a_goal_that_fails_is_named_with_its_values,
                         a_number_that_is_not_computed,
                         a_count_that_goes_past_its_end,
                         time_that_is_not_the_robots,
                         a_recursion_without_end,
                         a_list_without_end,
                         another_name_for_start ]).
test(a_program_that_thinks_while_it_drives,
     true(like(Text, "mine.pl:4: on the brick your program thought for 2.* s in start/0, and the robot drove * cm meanwhile"))) :-
    tries(brick, [ "count(0) :- !. count(N) :- M is N-1, count(M).",
                   "start :- robot, go(20), count(200000), stop, wait(0.1)." ], Text).
:- end_tests(exercise_try).
