% What scores and reports know of things that robots push: where they went, which of them a
% gripper carried, and what a robot ran into.

:- use_module('../support/child', [starts_itself/0]).
:- use_module('../support/simulation').
:- use_module(library(ev3dev/exercise)).
:- use_module(library(ev3dev/gripper)).
:- use_module(library(ev3dev/private/marking/explained), []).
:- use_module(library(ev3dev/private/marking/film), [film/3]).
:- use_module(library(ev3dev/private/marking/record)).
:- use_module(library(ev3dev/private/marking/why), [collision_reason/1]).
:- use_module(library(filesex), [delete_directory_and_contents/1]).

%   Goal has been recorded in World, whose robot is `carrier`.
recorded(World, Goal) :-
    with_sim(World,
             ( ev3dev_marking_record:with_record(( set_robot(5.6, 10.6, outB, outC),
                                                   set_gripper(outA, []),
                                                   user:Goal ),
                                                 1, World, carrier),
               record_end(exit(0), "", []) ),
             [clock(virtual), robot(carrier)]).

cube(Y, box(0, Y, 5, 5, 0, [mass(0.05), name(cube)])).

about(Value, Expected) :-
    abs(Value-Expected) < 0.6.

:- begin_tests(exercise_things).
test(a_push, true(( about(Pushed, 29), Carried =:= 0 ))) :-
    recorded([box(20, 40, 6, 6, 0, [mass(0.05), name(cargo)])],
             ( turn(20, 90), go_cm(20, 20), turn(20, -90), go_cm(30, 58) )),
    findall(P-C, ( pushed(cargo, P), carried(cargo, C) ), [Pushed-Carried]).
test(what_is_gripped_is_carried, true(( Pushed < 0.5, Carried > 40 ))) :-
    cube(11, Cube),
    recorded([Cube],
             ( grip, go_cm(30, 30), turn(30, 90), release, go_cm(-30, 10) )),
    pushed(cube, Pushed),
    carried(cube, Carried).
test(a_thing_that_rests, P-C == 0-0) :-
    cube(60, Cube),
    recorded([Cube], go_cm(30, 10)),
    pushed(cube, P),
    carried(cube, C).
test(all_of_them, Names == [ball, cube]) :-
    cube(60, Cube),
    recorded([Cube, circle(40, 0, 3, [mass(0.05), rolls(true), name(ball)])], wait(0.5)),
    findall(Name, pushed(Name, _), Names).
test(one_that_comes_later, P =@= 0) :-
    recorded([], ( sim_add(box(0, 60, 5, 5, 0, [mass(0.05), name(late)])), wait(0.5) )),
    pushed(late, P).
test(no_such_thing, [forall(member(Goal, [pushed(ball, _), carried(ball, _), thing_in(ball, circle(0, 0, 900))])),
                     fail]) :-
    cube(60, Cube),
    recorded([Cube], wait(0.5)),
    call(Goal).
test(a_world_without_things,
     [forall(member(Goal, [pushed(_, _), carried(_, _), thing_in(_, circle(0, 0, 900)), run_things(_, _, _)])),
      fail]) :-
    recorded([box(0, 60, 5, 5)], go_cm(30, 10)),
    call(Goal).
test(where_it_lies, [ forall(member(Area-Is, [ circle(0, 55, 6)-true, circle(3+4, 60, 7.0)-true,
                                               circle(0, 55, 4.9)-false, circle(0, 65, 4.9)-false,
                                               circle(8, 60, 7.9)-false,
                                               [10-50, 20-50, 20-70]-false,
                                               [-10-50, 30-50, [30, 90], 10-80, -10-90]-true,
                                               [-10-50, 30-50, 30-90, 0-55, -10-90]-false,
                                               %  a corner at its height
                                               [-10-60, 0-70, 10-60, 0-50]-true,
                                               [0-50, 10-60, 0-70, -10-60]-true,
                                               [5-60, 15-70, 15-50]-false,
                                               [15-50, 15-70, 5-60]-false ])),
                      Is0 == Is ]) :-
    cube(60, Cube),
    recorded([Cube], wait(0.5)),
    ( thing_in(cube, Area) -> Is0 = true ; Is0 = false ).
test(what_is_held_does_not_lie, Lies == [false, true]) :-
    findall(Is,
            ( member(Last, [grip, (grip, release)]),
              cube(11, Cube),
              recorded([Cube], Last),
              ( thing_in(cube, circle(0, 11, 5)) -> Is = true ; Is = false ) ),
            Lies).
test(which_lie_there, Names == [a, b]) :-
    findall(box(X, 50, 5, 5, 0, [mass(0.05), name(Name)]), member(X-Name, [0-a, 20-b, 90-c]), World),
    recorded(World, wait(0.5)),
    findall(Name, thing_in(Name, [-30-40, 30-40, 30-60, -30-60]), Names).
test(wrong_area, [forall(member(Area-Error, [ a-domain_error(area, a),
                                              [0-0, 1-1]-domain_error(area, [0-0, 1-1]),
                                              _-instantiation_error,
                                              [0-0, 1-1, b]-domain_error(place, b),
                                              circle(0, 0, 0)-domain_error(positive_number, 0) ])),
                  error(Error)]) :-
    thing_in(cube, Area).
test(it_ran_into_a_thing, true(( sub_atom(Text, _, _, 0, 'it ran into cargo.') ;
                                 sub_atom(Text, _, _, _, 'it ran into cargo. ') ))) :-
    recorded([ bounds(-100, -100, 100, 100), box(20, 60, 10, 10), box(60, 60, 4, 4, 0, [name(post)]),
               box(-60, 60, 6, 6, 0, [mass(0.05), name(other)]),
               box(0, 40, 6, 6, 0, [mass(0.05), name(cargo)]) ],
             go_cm(30, 50)),
    once(collision_reason(Text)).

%   The robot has carried it there, and comes back with its rear ahead.
test(it_ran_into_a_thing_that_was_moved, true(sub_atom(Text, _, _, _, 'it ran into the box at 0, 41'))) :-
    recorded([ box(30, 31, 20, 4), box(0, 11, 5, 5, 0, [mass(0.05)]) ],
             ( grip, go_cm(30, 30), release, go_cm(-30, 20), turn(20, 180), go_cm(-30, 30) )),
    once(collision_reason(Text)).
test(words_for_scores, Words == ["it lies there: cube did not lie there at the end",
                                 "some: nothing lay there at the end",
                                 "is pushed: cube was pushed 0 cm; more than 5 would count",
                                 "is carried: cube was carried 0 cm; at least 30 would count"]) :-
    cube(60, Cube),
    with_file(":- use_module(library(ev3dev/exercise)).
               exercise(x, []).
               score(1, 'it lies there') :- thing_in(cube, circle(0, 0, 5)).
               score(1, some) :- thing_in(_, circle(0, 0, 5)).
               score(1, 'is pushed') :- pushed(cube, Cm), Cm > 5.
               score(1, 'is carried') :- carried(cube, Cm), Cm >= 30.",
              File,
              ( ev3dev_marking_read:read_exercise(File, Exercise),
                recorded([Cube], wait(0.5)) )),
    findall(Line,
            ( ev3dev_marking_explained:missed(Exercise, Text, Said),
              format(string(Line), "~w: ~w", [Text, Said]) ),
            Words).

%   The film has five poses a second; the cube is pushed at the end, in the second half.
test(the_film_has_the_way_of_each_thing, true(( First == [0, 400, 0, 0], Last = [_, 0, Y, 0], Y > 450,
                                                Half > 3 ))) :-
    recorded([ box(40, 0, 6, 6, 0, [mass(0.05), name(rests)]),
               box(0, 40, 6, 6, 0, [mass(0.05), name(moves)]) ],
             ( wait(2), go_cm(30, 40) )),
    ev3dev_marking_record:recorded(Film, [moves-Way, rests-[First]], _, _),
    length(Film, Count),
    last(Way, Last),
    Way = [[0|_], [Half|_]|_],
    assertion(( Last = [At|_], At =< Count )),
    findall(P, member([P|_], Way), Places),
    assertion(sort(Places, Places)).
test(a_page_moves_things, true) :-
    with_file(":- use_module(library(ev3dev/exercise)).
               exercise(x, [robot(carrier)]).
               world(_, [ box(0, 40, 6, 6, 0, [mass(0.05), name('<i>')]),
                          circle(40, 0, 3, [mass(0.05)]) ]).
               score(1, x).",
              File,
              ( ev3dev_marking_read:read_exercise(File, Exercise),
                ev3dev_marking_read:exercise_world(Exercise, 1, World),
                recorded(World, go_cm(30, 50)),
                ev3dev_marking_record:recorded(Film, Ways, Collisions, Seconds),
                with_output_to(string(Page),
                               film(Exercise, 1, result(over, Seconds, [1], '', '', Film, Ways,
                                                        Collisions))) )),
    assertion(\+ sub_string(Page, _, _, _, "<i>")),
    findall(x, sub_string(Page, _, _, _, "class=\"thing\""), Drawn),
    assertion(Drawn == [x, x]),
    once(( sub_string(Page, _, _, After, "const ways = ["),
           sub_string(Page, _, After, 0, Rest),
           sub_string(Rest, Before, _, _, "]\n"),
           sub_string(Rest, 0, Before, _, Numbers) )),
    assertion(sub_string(Numbers, 0, _, _, "[[0,0,400,0],[")),
    findall(Way,
            ( sub_string(Page, _, _, Before1, "<polyline points=\""),
              sub_string(Page, _, Before1, 0, Rest1),
              once(sub_string(Rest1, Length, _, _, "\"")),
              sub_string(Rest1, 0, Length, _, Way),
              once(( sub_string(Rest1, Line, _, _, "\n"),
                     sub_string(Rest1, 0, Line, _, Drawing) )),
              sub_string(Drawing, _, _, _, "dasharray") ),
            Ways1),
    assertion(( Ways1 = [Way1], sub_string(Way1, 0, _, _, "0.0,40.0 0.0,") )),
    assertion(sub_string(Numbers, _, _, 0, ",[[0,400,0,0],],")).

%   In processes, whose results are read as text.
test(a_program_is_marked, [condition(starts_itself), Points-Ways == 10-1]) :-
    tmp_file(things, Folder),
    make_directory(Folder),
    atom_concat(Folder, '/exercise.pl', Exercise),
    atom_concat(Folder, '/mine.pl', Mine),
    atom_concat(Folder, '/pages/mine.html', Html),
    call_cleanup(
        ( text_in(":- use_module(library(ev3dev/exercise)).
                   exercise(x, [seeds(1), seconds(5)]).
                   world(_, [box(0, 30, 6, 6, 0, [mass(0.05), name('it''s \\'')])]).
                   score(10, 'is pushed') :- pushed(_, Cm), Cm > 5.", Exercise),
          text_in(":- use_module(library(ev3dev)).
                   start :- set_robot(5.6, 10.6, outB, outC), go_cm(30, 30).", Mine),
          exercise_mark(Exercise, [Mine], [enclosed(false), out(Folder)],
                        [mark(mine, Points, _, _, _, '')]),
          read_file_to_string(Html, Page, []) ),
        delete_directory_and_contents(Folder)),
    findall(x, sub_string(Page, _, _, _, "const ways = [[[0,0,300,0],["), Found),
    length(Found, Ways).

text_in(Text, File) :-
    setup_call_cleanup(open(File, write, Out), write(Out, Text), close(Out)).
:- end_tests(exercise_things).
