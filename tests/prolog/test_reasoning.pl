% The recorder of what Prolog does, its outline, and why a goal is false.

:- use_module('../support/simulation').
:- use_module('../support/reasoning/compared').
:- ensure_loaded('../support/reasoning/lecture').
:- ensure_loaded('../support/reasoning/pitfalls').
:- use_module(library(ev3dev/reasoning)).
:- use_module(library(ev3dev/rules)).
:- use_module(library(time)).

:- use_module('../../prolog/ev3dev/private/reasoning/events').
:- use_module('../../prolog/ev3dev/private/reasoning/outline').
:- use_module('../../prolog/ev3dev/private/reasoning/recorder').

:- meta_predicate shows(0, -), ports(0, -), alike(0), in_room(0).

in_room(Goal) :-
    with_sim(room, Goal, [clock(virtual)]).

%   Lines are those of the record of Goal, without times and spaces.

shows(Goal, Lines) :-
    ignore(catch(reasoning(Goal), _, true)),
    reasoning_text(Text),
    split_string(Text, "\n", "", Lines0),
    findall(Line,
            ( member(Line0, Lines0),
              Line0 \== "",
              split_string(Line0, " ", " ", Words0),
              exclude(==(""), Words0, Words),
              atomic_list_concat(Words, ' ', Line) ),
            Lines).

shown(Goal, Part) :-
    shows(Goal, Lines),
    (   member(Line, Lines),
        sub_atom(Line, _, _, _, Part)
    ->  true
    ;   print_message_lines(user_error, 'shown: ', [ '~w'-[Lines], nl ]),
        fail
    ).

:- meta_predicate shown(0, +).

%   The names of what was called, each with its ports.

ports(Goal, Ports) :-
    ignore(catch(reasoning(Goal), _, true)),
    events(Events),
    findall(Port-Name,
            ( member(e(Port0, Node, _, _), Events),
              port(Port0, Port),
              event(Node, call, _, Called, _),
              functor(Called, Name, _) ),
            Ports).

port(Port, Port) :- memberchk(Port, [call, exit, redo, fail, exception]).
port(more, exit).

:- begin_tests(recorder).
test(events_are_those_of_a_meta_interpreter_of_the_source,
     true(Differ-Enough == []-true)) :-
    findall(Count-Differs,
            ( between(1, 1300, Seed),
              compared_events(Seed, Recorded, Interpreted),
              length(Recorded, Count),
              ( Recorded == Interpreted -> Differs = no ; Differs = Seed ) ),
            Pairs),
    findall(Seed, ( member(_-Seed, Pairs), Seed \== no ), Differ),
    findall(Count, member(Count-_, Pairs), Counts),
    sum_list(Counts, Sum),
    length(Pairs, Programs),
    (   Sum >= 50000,
        Programs >= 1000
    ->  Enough = true
    ;   Enough = Sum/Programs
    ).
test(tests_inside_findall_and_forall_and_catch_are_seen, true(Lines == 3)) :-
    shown(inner(_), '- 1 > 1'),
    shown(all_small, '- 9 < 5'),
    shown(caught, '- 3 > 5'),
    Lines = 3.
test(goals_are_as_the_source_has_them) :-
    shown(same(f(2)), '+ f(2) = f(2)'),
    shown(minus(3, _), '+ 2 is 3-1'),
    shown(turned(2), '- 2 == 1'),
    shown(fresh(_), '+ 1 = 1').
test(each_goal_of_a_clause_is_a_node,
     true(Ports == [call-many, call-one, exit-one, call-one, exit-one,
                    call-one, exit-one, exit-many])) :-
    ports(many, Ports).
test(a_cut_shows_what_it_drops) :-
    shown(first(_), '! the cut drops more answers of way(_)'),
    shown(only(_), '! the cut drops the clauses that follow'),
    shown(once_inside(_), '! the cut drops more answers of way(_)'),
    shows(only(1), Lines),
    \+ ( member(Line, Lines), sub_atom(Line, _, _, _, 'more answers') ).
test(an_open_choice_point_is_shown) :-
    shown(open_end(_), 'clause 1 of 3, may have more answers').
test(an_exception_leaves_each_goal_between,
     true(Left == [throw, deeper, thrower])) :-
    ports(catcher, Ports),
    findall(Name, member(exception-Name, Ports), Left),
    shown(catcher, '- thrower').
test(an_uncaught_ball_is_that_of_the_goal, throws(my_ball)) :-
    reasoning(thrower).
test(errors_name_what_the_program_called,
     error(type_error(_, _), context(motor_run/2, _))) :-
    in_room(reasoning(motor_run(outB, fast))).
test(an_error_is_in_words) :-
    catch(in_room(reasoning(motor_run(outB, fast))), _, true),
    reasoning_text(Text),
    sub_string(Text, _, _, _, "throws an error: motor_run(Port, Speed): Speed must be a number, not fast"),
    !,
    \+ sub_string(Text, _, _, _, "error(").
test(an_error_has_lines_of_78_characters, true(Wide == [])) :-
    catch(in_room(reasoning(motor_run(outB, as_fast_as_the_motor_can_turn_on_this_floor))), _, true),
    reasoning_text(Text),
    split_string(Text, "\n", "", Lines),
    findall(Line, ( member(Line, Lines), string_length(Line, Length), Length > 78 ), Wide).
test(an_unknown_procedure_is_that_of_the_program,
     error(existence_error(procedure, nowhere/0), _)) :-
    reasoning(user:call(nowhere)).
test(answers_are_those_of_the_goal, true(Ways == [left, ahead, right])) :-
    findall(Way, reasoning(way(Way)), Ways).
test(nothing_is_recorded_after_an_answer, true(Count == Again)) :-
    reasoning(way(_)),
    aggregate_all(count, event(_, _, _, _, _), Count),
    because_of_nothing,
    aggregate_all(count, event(_, _, _, _, _), Again),
    !.

because_of_nothing :-
    ev3dev_frames:goal_of_program(user:many).

test(a_recording_inside_another_one_is_part_of_it,
     true(Names == [reasoning, one])) :-
    ports(reasoning(one), Ports),
    findall(Name, member(call-Name, Ports), Names).
test(dynamic_predicates_grammars_and_modules_do_what_they_do) :-
    reasoning(note(a)),
    \+ seen(_),
    reasoning(greets),
    shown(greets, 'name([prolog],[])'),
    reasoning(twice(true)),
    reasoning(wraps),
    \+ reasoning(odd).
test(two_threads_do_not_record_at_once,
     error(permission_error(record, goal, _), _)) :-
    thread_self(Me),
    setup_call_cleanup(
        thread_create(reasoning(user:( thread_send_message(Me, begun),
                                       thread_get_message(end) )),
                      Thread, []),
        ( thread_get_message(begun),
          reasoning(one) ),
        ( thread_send_message(Thread, end),
          thread_join(Thread, Status) )),
    Status == true.
test(the_next_thread_may_record_when_one_has_ended, true(Status == true)) :-
    thread_create(reasoning(one), Thread, []),
    thread_join(Thread, Status),
    reasoning(one).
test(a_large_term_keeps_its_beginning, true(Bytes < 3000000)) :-
    reasoning(long(800, _)),
    aggregate_all(sum(Size),
                  ( event(_, _, _, Data, _), '$term_size'(Data, _, Size) ),
                  Cells),
    Bytes is 8*Cells.
test(a_full_record_keeps_its_begin_and_its_end, true(Last == true)) :-
    reasoning(down(5000), [megabytes(1)]),
    lost(Lost),
    Lost > 1000,
    event(1, call, 0, down(5000), _),
    aggregate_all(max(N), event(N, _, _, _, _), Max),
    event(Max, exit, 1, _, _),
    reasoning_text(Text),
    ( sub_string(Text, _, _, _, "the record was full") -> Last = true
    ; Last = false ).
test(what_is_too_deep_runs_and_is_not_recorded) :-
    reasoning(down(100000)),
    reasoning_text(Text),
    once(sub_string(Text, _, _, _, "deeper than 30,000 calls")).
test(another_thread_is_not_recorded, true(Output-Names == ""-Expected)) :-
    Expected = [other_thread, thread_create, thread_join],
    with_output_to(string(Output), ports(other_thread, Ports)),
    findall(Name, member(call-Name, Ports), Names).
:- end_tests(recorder).

:- begin_tests(recorder_ends).
%   What is set before a run is so after it.
state([Debug, Tracing, Access, Depth]) :-
    current_prolog_flag(debug, Debug),
    ( tracing -> Tracing = true ; Tracing = false ),
    current_prolog_flag(access_level, Access),
    ( nb_current(ev3dev_reasoning, Node) -> Depth = Node ; Depth = [] ).

test(flags_and_debugger_are_as_before,
     [ forall(member(Goal, [ true, fail, thrower, way(_),
                             call_with_time_limit(0.05, endless) ])),
       true(After == Before) ]) :-
    state(Before),
    catch(ignore(once(reasoning(user:Goal))), _, true),
    state(After).

test(flags_and_debugger_are_as_before_after_an_abort, true(After == Before)) :-
    state(Before),
    thread_create(reasoning(user:( one, abort )), Thread, []),
    thread_join(Thread, _),
    state(After).

test(a_time_limit_ends_it,
     [forall(between(1, 50, _)), true(Name == time_limit_exceeded)]) :-
    catch(call_with_time_limit(0.02, reasoning(endless)), Ball, true),
    functor(Ball, Name, _).
test(a_time_limit_inside_ends_it,
     [forall(between(1, 50, _)), true(Name == time_limit_exceeded)]) :-
    catch(reasoning(call_with_time_limit(0.02, endless)), Ball, true),
    functor(Ball, Name, _).
test(a_signal_ends_it, [forall(between(1, 50, _)), throws(stop_it)]) :-
    thread_self(Me),
    setup_call_cleanup(
        thread_create(signals(Me), Thread, []),
        reasoning(endless_catch),
        thread_join(Thread, _)).

%   It comes when the program is in the middle of its run.
signals(Main) :-
    repeat,
    aggregate_all(count, event(_, _, _, _, _), Count),
    Count > 20,
    !,
    thread_signal(Main, throw(stop_it)).

test(for_seconds_ends_it, forall(between(1, 50, _))) :-
    in_room(reasoning(for_seconds(1, round_and_round))).

user:round_and_round :- wait(0.1), user:round_and_round.
:- end_tests(recorder_ends).

:- begin_tests(outline).
lecture(Lines) :-
    in_room(shows(start, Lines)).

count(Lines, Part, Count) :-
    aggregate_all(count,
                  ( member(Line, Lines), once(sub_atom(Line, _, _, _, Part)) ),
                  Count).

test(the_lecture_has_three_branches_each_with_its_test) :-
    lecture(Lines),
    count(Lines, '3 ways, all given up', 1),
    forall(member(Part, [ '1. way(left) lecture.pl:3, clause 1 of 3, given up: 38.1 > 60',
                          '2. way(ahead) lecture.pl:4, clause 2 of 3, given up: 97.0 > 100',
                          '3. way(right) lecture.pl:5, clause 3 of 3, given up: 46.6 > 100' ]),
           count(Lines, Part, 1)).
test(moves_stay_done, true(Count == 5)) :-
    lecture(Lines),
    count(Lines, 'stays done', Count).
test(each_row_has_a_time_and_a_pose) :-
    lecture(_),
    episodes(Episodes),
    outline(Episodes, Rows),
    forall(in_rows(Rows, At), moment(At, _, pose(_, _, _), _)).

in_rows(Rows, At) :-
    member(Row, Rows),
    arg(6, Row, From),
    arg(8, Row, Below),
    ( At = From ; in_rows(Below, At) ).

test(a_line_has_at_most_78_characters, true(Longest =< 78)) :-
    reasoning(long(100, _)),
    reasoning_text(Text),
    split_string(Text, "\n", "", Lines),
    aggregate_all(max(Length),
                  ( member(Line, Lines), string_length(Line, Length) ),
                  Longest).
test(rounds_of_a_loop_are_counted) :-
    shows(down(50), Lines),
    count(Lines, '... 48 more that do the same', 1).
test(rounds_of_several_rows_are_counted) :-
    in_room(shows(for_seconds(5, behave([ near :: ( us_dist_cm(in1, D), D < 1 )
                                                  ~> stop,
                                          never :: fail ~> stop ])),
                  Lines)),
    count(Lines, 'more rounds of these 2 rows', 1),
    once(( member(Line, Lines), sub_atom(Line, _, _, _, ' - near: ') )),
    sub_atom(Line, _, _, 0, ' < 1 is false'),
    count(Lines, '- never: fail', 2).
test(the_rows_of_a_guard_are_below_its_rule, true(Depths == [0, 1, 2, 0])) :-
    in_room(( reasoning(for_seconds(1, behave([ far :: clear ~> stop ]))),
              reasoning_text(Text) )),
    findall(At,
            ( member(Part, ["+ far: clear", "+ clear", "+ 10 < ", "+ stop"]),
              split_string(Text, "\n", "", Lines),
              once(( member(Line, Lines),
                     sub_string(Line, At, _, _, Part) )) ),
            [First|Places]),
    findall(Depth,
            ( member(At, [First|Places]), Depth is (At-First)//2 ),
            Depths).
test(why_false_names_the_branch_that_got_furthest) :-
    lecture(Lines),
    atomic_list_concat(Lines, ' ', Text),
    forall(member(Part, [ 'Why false? way(right) went furthest: there 46.6 > 100 is false',
                          'It would be true with D above 100; us_dist_cm(in1,D) gave 46.6 at 6.46 s.' ]),
           once(sub_atom(Text, _, _, _, Part))).
test(why_false_names_a_goal_without_a_clause) :-
    shown(no_clause, 'Why false? no clause of none(down) matches').
test(why_false_of_a_negation_is_the_negation) :-
    shown(user:( X = 1, \+ X = 1 ), 'Why false? \\+1=1 fails').
:- end_tests(outline).
