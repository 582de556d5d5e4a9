:- use_module('../support/child').
:- use_module('../support/simulation').
:- use_module(library(ev3dev/jog)).

%   Call Goal while these are the codes that come from the terminal.
with_keys(Codes, Goal) :-
    stream_property(Before, alias(user_input)),
    tmp_file(keys, File),
    setup_call_cleanup(
        ( open(File, write, Out), format(Out, "~s", [Codes]), close(Out),
          open(File, read, In), set_stream(In, alias(user_input)) ),
        once(Goal),
        ( set_stream(Before, alias(user_input)), close(In), delete_file(File) )).

%   Speeds are those of left and right wheel at each start, in counts a second.
driven(Codes, Goal, Speeds) :-
    with_sim([], ( set_robot(5.6, 10.6, outB, outC),
                   with_keys(Codes, Goal),
                   at_rest,
                   sim_trace(Trace),
                   findall(Speed,
                           ( member(_-written(Path, Speed0), Trace),
                             sub_atom(Path, _, _, 0, speed_sp),
                             atom_number(Speed0, Speed) ),
                           Speeds) )).

:- begin_tests(jog).
test(arrow_keys_drive_and_space_stops,
     true(Speeds == [315, 315, -315, -315, -315, 315, 315, -315])) :-
    driven(`\e[A\e[B\e[D \eOCq`, jog, Speeds).
test(the_speed_may_be_another, true(Speeds == [105, 105])) :-
    driven(`\e[A`, jog([speed(5+5)]), Speeds).
test(the_speed_may_have_a_unit, true(Speeds == [360, 360])) :-
    driven(`\e[A`, jog([speed(rps(1))]), Speeds).
test(other_keys_do_nothing, true(Speeds == [])) :-
    driven(`xy\e[Z\exq\e[A`, jog, Speeds).
test(the_end_of_the_input_ends_it, true(Speeds == [])) :-
    driven(``, jog, Speeds).
test(control_d_ends_it, true(Speeds == [])) :-
    driven([4, 27, 0'[, 0'A], jog, Speeds).
test(needs_a_robot, true(Status-Output == exit(0)-"no")) :-
    run_program(":- use_module(library(ev3dev)).
                 :- use_module(library(ev3dev/jog)).
                 main :- ( jog -> write(yes) ; write(no) ).",
                [goal(main)], Status, Output).
test(fails_if_a_motor_is_missing, fail) :-
    with_sim([], ( set_robot(5.6, 10.6, outB, outC), sim_unplug(outB), sim_wait(1),
                   with_keys(`\e[A`, jog) )).
test(options_are_checked,
     [ forall(member(Option-Error, [ speed(0)-domain_error(speed_ahead, 0),
                                     speed(101)-domain_error(speed_ahead, 101),
                                     sped(1)-domain_error(jog_option, _) ])),
       error(Error, context(jog/1, _)) ]) :-
    with_sim([], jog([Option])).
:- end_tests(jog).
