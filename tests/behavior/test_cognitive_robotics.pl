% The examples of docs/cognitive-robotics.md do what it says. Its queries are played
% by tests/sessions/play.py.

:- use_module('../support/cases').
:- use_module('../support/caves').
:- use_module('../support/simulation').
:- use_module(library(ev3dev/golog)).

:- initialization(load_files(chapter_elevator:example(golog_elevator), [])).
:- initialization(load_files(chapter_post:example(golog_delivery), [])).
:- initialization(load_files(chapter_rescue:example(golog_rescue), [])).
:- initialization(load_files(chapter_wumpus:example(golog_wumpus), [])).

:- begin_tests(cognitive_robotics).
test(the_elevator_serves_all_calls,
     [forall(member(How, [simple, smart, planned])), true(Opened-Left == 4-[])]) :-
    with_sim(room,
             ( sim_press(up, [after(1)]), sim_press(left, [after(1.5)]),
               sim_press(down, [after(3)]), sim_press(right, [after(4)]),
               chapter_elevator:start(How, [ timeout(30), reason(timeout),
                                             history(H) ]) )),
    findall(x, member(open, H), Opens),
    length(Opens, Opened),
    findall(N, chapter_elevator:holds(called(N), H), Left).
test(an_elevator_that_plans_goes_no_further,
     [forall(member(How, [smart, planned])), true(Planned =< Simple)]) :-
    floors(simple, Simple),
    floors(How, Planned).
test(the_cabin_stands_where_the_history_says, true(near(Angle, 0, 5))) :-
    with_sim(room,
             ( sim_press(up, [after(1)]),
               chapter_elevator:start(simple, [timeout(20), reason(_)]),
               motor_position(outA, Angle) )).
test(the_post_brings_the_letters, true(Stations == [1, 2, 3, 4])) :-
    with_sim(delivery,
             ( sim_press(left, [after(1)]),      % from 1 to 3
               sim_press(enter, [after(9)]),
               sim_press(up, [after(12)]),       % from 2 to 4
               sim_press(enter, [after(24)]),
               sim_press(enter, [after(38)]),
               sim_press(enter, [after(52)]),
               chapter_post:start([ timeout(60), reason(timeout),
                                    history(H) ]) )),
    \+ chapter_post:holds(work, H),
    findall(S, member(arrive(S), H), Newest),
    reverse(Newest, Stations).
test(the_post_finds_the_tape_again, true(Stations == [1, 2, 3])) :-
    with_sim(delivery,
             ( sim_press(left, [after(0.5)]),
               sim_press(enter, [after(5)]),
               sim_at(8, sim_place(190, 66, 45)),
               chapter_post:start([ timeout(40), reason(timeout),
                                    history(H) ]) )),
    memberchk(lose_tape, H),
    memberchk(see_tape, H),
    findall(S, member(arrive(S), H), Newest),
    reverse(Newest, Stations).
test(the_rescuer_finds_and_comes_home, true(near(Way, 0, 4))) :-
    with_sim(grid,
             ( sim_add(patch(red, [48-28, 72-28, 72-52, 48-52])),
               chapter_rescue:start([history(H)]),
               sim_pose(X, Y, _), sim_collisions(Collisions) )),
    assertion(Collisions == []),
    assertion(H = [report|_]),
    assertion(memberchk(e(check, 5), H)),
    Way is sqrt(X*X + Y*Y).

test(the_hunter_of_gold_knows_and_does_not_guess,
     [forall(case(50, Seed)), true(Wrong == [])]) :-
    random_cave(Seed, Cave),
    hunt(Cave, H, Crossed),
    reverse(H, Done),
    findall(C, member(go(C), Done), Ways),
    findall(Which,
            ( guess([0-0], Ways, Cave, Which)
            ; member(C, Crossed), \+ memberchk(C, [0-0|Ways]),
              Which = crossed(C)
            ; member(C, Crossed), is_deadly(C, Cave), Which = dead(C)
            ; \+ H = [leave|_], Which = not_home
            ; amiss(Cave, Ways, H, Which)
            ),
            Wrong).
test(in_caves_of_the_test_knowledge_mostly_does_not_suffice,
     [condition(all_cases), true(Found-Not == yes-yes)]) :-
    findall(x, ( case(50, Seed), random_cave(Seed, Cave),
                 Cave = cave(_, _, Gold), explored(Cave, Cells),
                 memberchk(Gold, Cells) ), Xs),
    length(Xs, N),
    ( N >= 15 -> Found = yes ; Found = N ),
    ( N =< 45 -> Not = yes ; Not = N ).

%   Crossed are the cells where the robot of the simulator has been.

hunt(Cave, H, Crossed) :-
    Cave = cave(Wumpus, Pits, Gold),
    chapter_wumpus:cave(Wumpus, Pits, Gold, World),
    with_sim(World,
             ( chapter_wumpus:start([history(H)]),
               sim_trace(Trace) )),
    findall(CX-CY,
            ( member(_-pose(X, Y, _), Trace),
              CX is round(X/30),
              CY is round(Y/30) ),
            Cells),
    sort(Cells, Crossed).

%   It went where it could not know that it is safe.

guess(Visited, [C|Cs], Cave, Which) :-
    safe_beside(Visited, Cave, Safe),
    (   ( memberchk(C, Visited) ; memberchk(C, Safe) )
    ->  guess([C|Visited], Cs, Cave, Which)
    ;   Which = guessed(C)
    ).

%   It has the gold if that can be, else it has been wherever it could be.

amiss(Cave, Ways, H, Which) :-
    Cave = cave(_, _, Gold),
    explored(Cave, Cells),
    (   memberchk(Gold, Cells)
    ->  \+ memberchk(take, H),
        Which = no_gold
    ;   sort([0-0|Ways], Visited),
        Visited \== Cells,
        Which = visited(Visited, Cells)
    ).

floors(How, Floors) :-
    with_sim(room,
             ( sim_press(up, [after(0.1)]), sim_press(left, [after(0.2)]),
               sim_press(right, [after(0.3)]),
               chapter_elevator:start(How, [ timeout(30), reason(timeout),
                                             history(H) ]) )),
    findall(x, ( member(A, H), memberchk(A, [up, down]) ), Moves),
    length(Moves, Floors).
:- end_tests(cognitive_robotics).
