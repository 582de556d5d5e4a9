% library(ev3dev/worker), and the side of library(ev3dev/bricks) that speaks with it: a far
% brick's motors stop, whatever ends.

:- use_module('../support/trees').
:- use_module('../support/cases').
:- use_module('../support/child').
:- use_module('../support/far_bricks').
:- use_module('../support/undisturbed').
:- use_module(library(ev3dev/bricks)).
:- use_module(library(ev3dev/events), [on/2 as when_, race/2]).

:- initialization(load_files(far_grid:example(far_grid), [])).

with_motor_at_outB(Goal) :-
    with_tree(plain, [outB-'lego-ev3-l-motor'], Goal).

% A motor at outB, whose files are here, is one of the far brick.
with_motor(Name, Goal) :-
    with_motor_at_outB(( tree_root(Root), far(Name, ev3_sysfs(Root)), call(Goal) )).

with_far_motor(Name, Goal) :-
    with_far(Name, with_motor(Name, Goal)).

runs_on(Name) :-
    put_attribute(outB, command, ''),
    far(Name, motor_run(outB, 50)),
    get_attribute(outB, command, 'run-forever').

is_stopped :-
    get_attribute(outB, command, stop).

send_cycle(Name) :-
    X = f(X),
    catch(far(Name, atom(X)), error(type_error(acyclic_term, _), Context),
          throw(error(type_error(acyclic_term, x), Context))).

process_of(Name, Process) :-
    far(Name, current_prolog_flag(pid, Process)).

is_over(Process) :-
    catch(( process_kill(Process, 0), fail ), error(_, _), true).

within(Seconds, Goal, Took) :-
    undisturbed(catch(call_with_time_limit(300, Goal), Error, true), Took0),
    ( var(Error) -> true ; Error == time_limit_exceeded -> true ; throw(Error) ),
    ( Took0 < Seconds -> Took = soon ; Took = Took0 ).

% A simulated robot drives; the map is the one that its own program would make.
drives_over_the_grid(Name) :-
    far(Name, ( use_module(library(ev3dev/sim)), sim_start(grid, [clock(virtual)]) )),
    with_output_to(string(Text), far_grid:drive(Name, [7, 7])),
    split_string(Text, "\n", "\n", [First|Lines]),
    sub_string(First, 0, _, _, "at [0,0], obstacles []: [move,"),
    last(Lines, "arrived at [7,7]"),
    far(Name, ( state_position(Cell, _), sim_pose(X, Y, _) )),
    Cell == [7, 7],
    abs(X-140) < 5,
    abs(Y-140) < 5.

% One that says this, and no more until it must end.
fake(Text, command(sh, ['-c', Command])) :-
    format(atom(Command), "printf '~s'; grep -q end", [Text]).

:- begin_tests(worker, [setup(( far_place(Where), brick_open(anna, Where) )), cleanup(brick_close(anna))]).
test(what_aborts_its_goal_is_an_error_here,
     [ forall(member(Ball, ['$aborted', unwind(abort), unwind(halt(7))])),
       true(memberchk(Formal, [system_error(aborted), existence_error(connection, bob)])) ]) :-
    catch(with_far(bob, far(bob, throw(Ball))), error(Formal, _), true).
test(a_solution_a_failure_an_error, X-No-E == 3-failed-error(type_error(evaluable, a/0))) :-
    far(anna, X is 1+2),
    ( far(anna, fail) -> No = succeeded ; No = failed ),
    catch(far(anna, _ is a), error(Formal, _), E = error(Formal)).
test(an_error_says_on_which_brick, Called-End == motor_run/2-'; on the brick anna') :-
    with_motor(anna, catch(far(anna, motor_run(outB, fast)), error(_, context(Called, Text)), true)),
    sub_atom(Text, Before, _, 0, '; on the brick anna'),
    sub_atom(Text, Before, _, 0, End).
test(a_ball_comes_as_it_was, Ball == f('a b\nc', "x")) :-
    catch(far(anna, throw(f('a b\nc', "x"))), Ball, true).
test(one_solution, Xs == [1]) :-
    findall(X, far(anna, member(X, [1, 2])), Xs).
test(terms_travel_as_they_are, Sent =@= Came) :-
    Sent = [ a, 'A b', '', [], "text\n\u20ac", 'caf\u00e9 \u4e2d', -1, - 1, -(1), 1.0e10, 0.1,
             {x, y}, (a :- b, \+ c), '$VAR'(1), f(X, Y, X), [Y|_], -(-(1)), 1 - -1,
             'it''s', '\u0001', 123456789012345678901234567890 ],
    far(anna, Came = Sent).
test(an_attribute_does_not_travel, X-Y == 1-1) :-
    freeze(X, throw(far)),
    far(anna, ( var(X), Y = 1 )),
    catch(X = 1, far, ( frozen(_, _), del_attrs(X), X = 1 )).
test(operators_of_the_program_do_not_matter, X == Term) :-
    Term =.. [to_the, a, b],
    setup_call_cleanup(op(700, xfx, user:to_the), far(anna, X = Term),
                       op(0, xfx, user:to_the)).
test(a_program_travels, A-B == 1-2) :-
    setup_call_cleanup(
        tmp_file_stream(text, File, Out),
        ( format(Out, "answer(1).~n", []), close(Out),
          far_load(anna, File), far(anna, answer(A)),
          open(File, write, Again), format(Again, "answer(2).~n", []), close(Again),
          far_load(anna, File), far(anna, findall(X, answer(X), [B])) ),
        delete_file(File)).
test(what_cannot_travel,
     [ forall(member(Goal-Formal,
                     [ send_cycle(anna)-type_error(acyclic_term, x),
                       far(anna, open('/dev/null', read, _))-type_error(sendable, _),
                       ( numlist(1, 300000, L), far(anna, atom(L)) )-resource_error(frame),
                       far(anna, numlist(1, 300000, _))-resource_error(frame) ])),
       true(Found-X1 = Formal-1) ]) :-
    catch(Goal, error(Found, _), true),
    far(anna, X1 = 1).
test(bad_arguments,
     [ forall(member(Goal-Formal,
                     [ far(anna, _)-instantiation_error,
                       far(anna, 1)-type_error(callable, 1),
                       far(nobody, true)-existence_error(brick, nobody),
                       far(local, true)-domain_error(far_brick, local),
                       far(_, true)-instantiation_error,
                       far_load(anna, nofile)-existence_error(source_sink, nofile),
                       far_load(anna, _)-instantiation_error,
                       far_load(local, nofile)-domain_error(far_brick, local),
                       with_brick(anna, true)-permission_error(use, far_brick, anna),
                       use_brick(anna)-permission_error(use, far_brick, anna),
                       brick_open(anna, sim)-permission_error(open, brick, anna) ])),
       error(Formal) ]) :-
    Goal.
test(bricks_do_reaches_it, Names == [anna, bob]) :-
    with_motor(anna,
        with_far(bob,
            ( tree_root(Root), far(bob, ev3_sysfs(Root)),
              bricks_do([anna, bob], assertz(was_here)),
              findall(Name, ( member(Name, [anna, bob]), far(Name, user:was_here) ), Names) ))).
test(events_are_served_meanwhile, [condition(current_predicate(engine_create/3)), true(Is == served)]) :-
    race([( far(anna, sleep(10)), Is = waited ), ( wait(0.1), Is = served )], _).
test(a_goal_that_is_left_ends_and_its_motors_stop, Took-X == soon-1) :-
    with_motor(anna,
        ( runs_on(anna),
          within(5, call_with_time_limit(0.2, far(anna, ( repeat, sleep(0.01), fail ))), Took),
          eventually(is_stopped),
          far(anna, X = 1) )).
test(stop_all_bricks_reaches_it_while_a_goal_runs) :-
    with_motor(anna,
        meanwhile(catch(far(anna, ( motor_run(outB, 50), sleep(1) )), _, true),
                  ( eventually(get_attribute(outB, command, 'run-forever')),
                    stop_all_bricks,
                    eventually(is_stopped) ))).
:- end_tests(worker).

:- begin_tests(worker_ends).
test(what_it_prints_is_printed_here, Lines == ["anna: a", "anna: b", "anna: c", "anna: d", "end"]) :-
    far_place(Where),
    format(string(Text),
           ":- use_module(library(ev3dev/bricks)).
            :- initialization(( brick_open(anna, ~q), far(anna, ( writeln(a), write(b) )),
                                far(anna, shell('echo c; echo d >&2')), writeln(end) )).",
           [Where]),
    run_program(Text, [], exit(0), Output),
    split_string(Output, "\n", "\n", Lines).
test(a_place_that_is_none,
     [ forall(( fake('\\001hello 0 99\\n', Other),
                member(Where-Formal,
                       [ ssh('-oProxyCommand=x')-domain_error(ssh_destination, '-oProxyCommand=x'),
                         ssh(_)-instantiation_error,
                         command(true, [])-existence_error(connection, anna),
                         command(true, no)-type_error(list, no),
                         Other-permission_error(open, brick, anna) ]) )),
       true(Found-Left == Formal-[local]) ]) :-
    catch(brick_open(anna, Where), error(Found, _), true),
    findall(Name, brick(Name), Left).
test(closing_stops_its_motors_and_ends_it) :-
    with_far_motor(anna,
        ( process_of(anna, Process), runs_on(anna), brick_close(anna), is_stopped,
          is_over(Process) )).
test(a_goal_that_catches_everything_is_closed, Took == soon) :-
    with_far_motor(anna,
        ( runs_on(anna),
          catch(call_with_time_limit(0.1,
                    far(anna, ( repeat, catch(sleep(5), _, true), fail ))), _, true),
          within(6, brick_close(anna), Took),
          is_stopped )).
test(a_goal_that_halts_is_lost_and_it_opens_again, E-X == existence_error(connection, anna)-1) :-
    far_place(Where),
    with_far(anna,
        ( catch(far(anna, halt), error(E, _), true),
          catch(far(anna, true), error(E, _), true),
          brick_open(anna, Where),
          far(anna, X = 1) )).
test(one_that_falls_silent_is_lost, E-Took == existence_error(connection, anna)-soon) :-
    fake('\\001hello 0 1\\n', Silent),
    with_far(anna, Silent, within(5, catch(far(anna, true), error(E, _), true), Took)).
test(a_long_goal_does_not_hang_on_a_silent_one, E == existence_error(connection, anna)) :-
    Stopped = command(sh, ['-c', "printf '\\001hello 0 1\\n'; kill -STOP $$"]),
    numlist(1, 100000, L),
    with_far(anna, Stopped, catch(far(anna, atom(L)), error(E, _), true)).
test(what_comes_before_its_first_word_is_printed, Lines == ["anna: Welcome", "end"]) :-
    fake('Welcome\\n\\001hello 0 1\\n', Polite),
    format(string(Text),
           ":- use_module(library(ev3dev/bricks)).
            :- initialization(( brick_open(anna, ~q), writeln(end) )).", [Polite]),
    run_program(Text, [], exit(0), Output),
    split_string(Output, "\n", "\n", Lines).

% Killed, cut, silent or without a program at a random moment of a move.
test(its_motors_stop_whatever_ends,
     forall(( case(3, 20, Seed), far_end(How) ))) :-
    set_random(seed(Seed)),
    random(0.0, 0.2, Wait),
    with_motor_at_outB(stops_when(pipe, How, Wait, _)).
test(the_grid_of_the_paper_with_the_map_on_this_side) :-
    with_far(anna, drives_over_the_grid(anna)).
:- end_tests(worker_ends).

% Through a server of OpenSSH, if there is one.
:- begin_tests(worker_ssh, [condition(can_log_in)]).
test(a_goal_and_its_output, X-Lines == 3-["eva: hi", "3"]) :-
    with_login(
        ( with_far(eva, ssh(eva), far(eva, X is 1+2)),
          run_program(":- use_module(library(ev3dev/bricks)).
                       :- initialization(( brick_open(eva, ssh(eva)),
                                           far(eva, ( writeln(hi), X = 3 )), writeln(X) )).",
                      [], exit(0), Output) )),
    split_string(Output, "\n", "\n", Lines).
test(its_motors_stop_whatever_ends, forall(( far_end(How), How \== program_killed ))) :-
    with_login(with_motor_at_outB(stops_when(ssh, How, 0.1, _))).
test(the_grid_of_the_paper_with_the_map_on_this_side) :-
    with_login(with_far(eva, ssh(eva), drives_over_the_grid(eva))).
test(a_login_that_is_refused, Formal == existence_error(connection, nobody)) :-
    with_login(catch(brick_open(nobody, ssh('nobody@eva')), error(Formal, _), true)).
:- end_tests(worker_ssh).
