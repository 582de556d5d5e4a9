% The examples of docs/cognitive-robotics.md do what it says. Its queries are played
% by tests/sessions/play.py.

:- use_module('../support/simulation').
:- use_module(library(ev3dev)).
:- use_module(library(ev3dev/golog)).
:- use_module(library(ev3dev/sim)).

:- initialization(load_files(chapter_elevator:example(golog_elevator), [])).
:- initialization(load_files(chapter_post:example(golog_delivery), [])).
:- initialization(load_files(chapter_rescue:example(golog_rescue), [])).

:- begin_tests(cognitive_robotics).

test(the_elevator_serves_all_calls,
     [forall(member(How, [simple, smart])), true(Opened-Left == 4-[])]) :-
    with_sim(room,
             ( sim_press(up, [after(1)]), sim_press(left, [after(1.5)]),
               sim_press(down, [after(3)]), sim_press(right, [after(4)]),
               chapter_elevator:start(How, [ timeout(30), reason(timeout),
                                             history(H) ]) )),
    findall(x, member(open, H), Opens),
    length(Opens, Opened),
    findall(N, chapter_elevator:holds(called(N), H), Left).
test(the_smart_elevator_goes_no_further, true(Smart =< Simple)) :-
    floors(simple, Simple),
    floors(smart, Smart).
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

floors(How, Floors) :-
    with_sim(room,
             ( sim_press(up, [after(0.1)]), sim_press(left, [after(0.2)]),
               sim_press(right, [after(0.3)]),
               chapter_elevator:start(How, [ timeout(30), reason(timeout),
                                             history(H) ]) )),
    findall(x, ( member(A, H), memberchk(A, [up, down]) ), Moves),
    length(Moves, Floors).

:- end_tests(cognitive_robotics).
