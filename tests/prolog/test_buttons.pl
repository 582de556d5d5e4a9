:- use_module('../support/dev').
:- use_module('../support/trees').

with_keys(Events, Goal) :-
    events_of(Events, Bytes),
    with_dev(['input/by-path/platform-gpio_keys-event'-Bytes], Goal).

down(Keys) :-
    findall(Key, button(Key), Keys).

:- begin_tests(button).
test(is_true_of_keys_that_are_down,
     [ forall(tree(Tree)),
       true(Seen == [[], [up, enter], [enter], []])
     ]) :-
    on_dev(Tree,
           ( down(None),
             press(Tree, enter), press(Tree, up), down(Two),
             release(Tree, up), down(One),
             release(Tree, enter), down(Again) )),
    Seen = [None, Two, One, Again].
test(knows_each_key, [forall(tree(Tree)), true(Keys == [up, down, left, right, enter, back])]) :-
    on_dev(Tree,
           ( forall(member(Key, [back, enter, right, left, down, up]),
                    press(Tree, Key)),
             down(Keys) )).
test(of_a_bound_key_is_det, forall(tree(Tree))) :-
    on_dev(Tree,
           ( press(Tree, up), press(Tree, down),
             button(down),
             \+ button(left) )).
test(leaves_no_choice_point_after_the_last) :-
    with_keys([event(1, 103, 1)], button(up)).
test(fails_without_keys, fail) :-
    with_dev([], button(_)).
test(knows_the_boards,
     [ forall(member(Name, ['platform-gpio_keys-event',
                            'platform-gpio-keys.0-event',
                            'platform-evb-buttons-event',
                            'platform-3f804000.i2c-event'])),
       true(Keys == [enter])
     ]) :-
    events_of([event(1, 28, 1)], Bytes),
    atom_concat('input/by-path/', Name, File),
    with_dev([File-Bytes], down(Keys)).
test(passes_over_what_is_no_press, true(Keys == [left])) :-
    % repeated, another key's, another type's, half a record
    events_of([ event(1, 105, 1), event(1, 105, 2), event(1, 30, 1),
                event(3, 103, 1), event(0, 0, 0)
              ], Bytes0),
    append(Bytes0, [1, 2, 3], Bytes),
    with_dev(['input/by-path/platform-gpio_keys-event'-Bytes], down(Keys)).
test(no_such_key, [forall(tree(Tree)), error(domain_error(button, fire), _)]) :-
    on_dev(Tree, button(fire)).
test(a_key_that_is_no_atom, error(type_error(atom, 1), _)) :-
    with_keys([], button(1)).
:- end_tests(button).

:- begin_tests(button_wait).
%   What is waited for while Other happens in another thread, some time after
%   the wait began. The last that Other does is what is waited for: after that
%   there may be no keys any more.
waited(Tree, Other, Wait) :-
    on_dev(Tree, ( later(0.05, Other), Wait )).

test(waits_for_a_press, forall(tree(Tree))) :-
    waited(Tree, press(Tree, enter), button_wait(enter, pressed)).
test(waits_for_a_release, forall(tree(Tree))) :-
    waited(Tree, ( press(Tree, left), release(Tree, left) ),
           button_wait(left, released)).
test(tells_which_key, [forall(tree(Tree)), true(Key-Event == right-pressed)]) :-
    waited(Tree, press(Tree, right), button_wait(Key, Event)).
test(passes_over_other_keys, forall(tree(Tree))) :-
    waited(Tree,
           ( forall(member(Key, [up, down]),
                    ( press(Tree, Key), release(Tree, Key) )),
             press(Tree, back) ),
           button_wait(back, pressed)).
test(does_not_count_what_was_before, [forall(tree(Tree)), true(Key == down)]) :-
    on_dev(Tree,
           ( press(Tree, up),
             later(0.05, press(Tree, down)),
             button_wait(Key, pressed) )).
test(is_over_after_its_timeout, [forall(tree(Tree)), fail]) :-
    on_dev(Tree, button_wait(_, _, [timeout(0.05)])).
test(does_not_wait_for_a_timeout_of_0, [forall(tree(Tree)), fail]) :-
    on_dev(Tree, ( press(Tree, up), button_wait(_, _, [timeout(0)]) )).
test(comes_before_its_timeout, forall(tree(Tree))) :-
    waited(Tree, press(Tree, up), button_wait(up, pressed, [timeout(100)])).
test(can_be_interrupted, [forall(tree(Tree)), true(E == time_limit_exceeded)]) :-
    on_dev(Tree, catch(call_with_time_limit(0.05, button_wait(_, _)), E, true)).
test(takes_simulated_time, true(abs(Time - 2) < 0.1)) :-
    on_dev(simulator,
           ( sim_press(enter, [after(2)]),
             button_wait(enter, pressed),
             sim_time(Time) )).
test(lets_motors_run_meanwhile) :-
    on_dev(simulator,
           ( position(outB, P0),
             motor_run(outB, 20),
             sim_press(up, [after(1)]),
             button_wait(up, pressed),
             position(outB, P) )),
    P - P0 > 150.
test(fails_without_keys, fail) :-
    with_dev([], button_wait(_, _)).
test(reads_a_pipe, true(Key == left)) :-
    Name = 'input/by-path/platform-gpio_keys-event',
    events_of([event(1, 105, 1)], Bytes),
    with_dev([Name-fifo],
             ( dev_path(Name, Pipe),
               later(0.05, put_bytes_of(write, Pipe, Bytes)),
               button_wait(Key, pressed) )).
test(stays_with_a_pipe_whose_writer_left, true(Key == up)) :-
    Name = 'input/by-path/platform-gpio_keys-event',
    events_of([event(1, 105, 0)], Bytes1),
    events_of([event(1, 103, 1)], Bytes2),
    with_dev([Name-fifo],
             ( dev_path(Name, Pipe),
               later(0.05, ( put_bytes_of(write, Pipe, Bytes1), sleep(0.05),
                             put_bytes_of(write, Pipe, Bytes2) )),
               button_wait(Key, pressed) )).
test(no_such_key, error(domain_error(button, start), _)) :-
    with_keys([], button_wait(start, pressed)).
test(no_such_event, error(domain_error(button_event, held), _)) :-
    with_keys([], button_wait(up, held)).
test(negative_timeout, error(domain_error(timeout, -1), _)) :-
    with_keys([], button_wait(up, pressed, [timeout(-1)])).
test(timeout_that_is_no_number, error(type_error(evaluable, soon/0), _)) :-
    with_keys([], button_wait(up, pressed, [timeout(soon)])).
test(options_that_are_no_list, error(type_error(list, 5), _)) :-
    with_keys([], button_wait(up, pressed, 5)).
test(an_option_that_is_none, error(domain_error(button_option, tmeout(0)), _)) :-
    with_keys([], button_wait(up, pressed, [tmeout(0)])).
:- end_tests(button_wait).

:- begin_tests(button_events).
play(Tree, Keys) :-
    forall(member(Key, Keys), ( press(Tree, Key), release(Tree, Key) )).

test(is_the_list_of_what_happens,
     [ forall(tree(Tree)),
       true([A, B, C] == [up-pressed, up-released, left-pressed])
     ]) :-
    on_dev(Tree,
           ( press(Tree, down),
             button_events(Events),
             play(Tree, [up, left]),
             Events = [A, B, C|_] )).
test(waits_for_who_looks_at_it, [forall(tree(Tree)), true(Key == right)]) :-
    on_dev(Tree,
           ( button_events(Events),
             later(0.05, play(Tree, [right])),
             member(Key-released, Events) )).
test(is_the_same_after_backtracking,
     [forall(tree(Tree)), true(Seen == [[up, left], [up, left]])]) :-
    on_dev(Tree,
           ( button_events(Events),
             play(Tree, [up, left]),
             findall([A, B],
                     ( member(_, [1, 2]),
                       Events = [A-_, _, B-_|_] ),
                     Seen) )).
test(can_be_had_by_several, [forall(tree(Tree)), true(A-B == up-up)]) :-
    on_dev(Tree,
           ( button_events(Events1),
             button_events(Events2),
             play(Tree, [up]),
             Events1 = [A-_|_],
             Events2 = [B-_|_] )).
test(does_not_wait_by_itself, forall(tree(Tree))) :-
    on_dev(Tree, ( button_events(Events), var(Events) )).
test(has_no_end, [forall(tree(Tree)), fail]) :-
    on_dev(Tree, ( button_events(Events), Events = [] )).
test(compares_what_happens_with_what_is_expected, [forall(tree(Tree)), fail]) :-
    on_dev(Tree,
           ( button_events(Events),
             play(Tree, [up]),
             Events = [down-_|_] )).
test(can_be_interrupted, [forall(tree(Tree)), true(E == time_limit_exceeded)]) :-
    on_dev(Tree,
           ( button_events(Events),
             catch(call_with_time_limit(0.05, Events = [_|_]), E, true) )).
test(fails_without_keys, fail) :-
    with_dev([], button_events(_)).
:- end_tests(button_events).
