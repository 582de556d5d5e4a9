:- use_module('../support/dev').
:- use_module('../support/simulation').
:- use_module('../support/trees').
:- use_module(library(ev3dev)).
:- use_module(library(ev3dev/sim)).
:- use_module(library(filesex)).
:- use_module(library(process)).

:- begin_tests(sim_press).

test(is_seen_and_traced, true(Keys-Events == [up]-[pressed(up), pressed(down), released(down)])) :-
    with_sim(room,
             ( sim_press(up), sim_press(up), sim_press(down), sim_release(down),
               sim_release(left),
               findall(Key, button(Key), Keys),
               events(Events) )).
test(comes_when_it_is_planned, true(Seen == [false, true, true, false])) :-
    with_sim(room,
             ( sim_press(enter, [after(1), for(2)]),
               findall(Down,
                       ( member(Step, [0.9, 0.2, 1.8, 0.2]),
                         sim_step(Step),
                         down(enter, Down)
                       ),
                       Seen) )).
test(is_short_unless_it_is_told, true(Events == [pressed(up), released(up)])) :-
    with_sim(room,
             ( sim_press(up, []), sim_step(0.3), events(Events) )).
test(may_last_until_it_is_released, true(A-B == true-false)) :-
    with_sim(room,
             ( sim_press(up, [for(infinite)]), sim_step(1000), down(up, A),
               sim_release(up), down(up, B) )).
test(is_put_back_with_a_snapshot, true(A-B == true-false)) :-
    with_sim(room,
             ( sim_snapshot(Snapshot),
               sim_press(up), down(up, A),
               sim_restore(Snapshot), down(up, B) )).
test(no_such_key,
     [ forall(member(Goal, [sim_press(go), sim_press(go, []), sim_release(go)])),
       error(domain_error(button, go), _)
     ]) :-
    with_sim(room, Goal).
test(unbound_key,
     [ forall(member(Goal, [sim_press(_), sim_press(_, []), sim_release(_)])),
       error(instantiation_error, _)
     ]) :-
    with_sim(room, Goal).
test(negative_time,
     [ forall(member(Option, [after(-1), for(-1)])),
       error(domain_error(seconds, -1), _)
     ]) :-
    with_sim(room, sim_press(up, [Option])).
test(no_such_option, error(domain_error(sim_option, until(3)), _)) :-
    with_sim(room, sim_press(up, [until(3)])).
test(time_that_is_no_number,
     [ forall(member(Option, [after(soon), for(long)])),
       error(type_error(number, _), _)
     ]) :-
    with_sim(room, sim_press(up, [Option])).
test(needs_a_simulation,
     [ forall(member(Goal, [ sim_press(up), sim_press(up, []), sim_release(up),
                             sim_mount(tests, tests) ])),
       fail
     ]) :-
    ignore(sim_stop),
    call(Goal).

down(Key, Down) :-
    (   button(Key)
    ->  Down = true
    ;   Down = false
    ).

events(Events) :-
    sim_trace(Trace),
    findall(Event,
            ( member(_-Event, Trace),
              ( Event = pressed(_) ; Event = released(_) )
            ),
            Events).

:- end_tests(sim_press).

:- begin_tests(sim_screen).

test(no_such_depth, error(domain_error(screen_bits, 16), _)) :-
    sim_start(room, [screen(16)]).
test(depth_that_is_no_number, error(type_error(integer, deep), _)) :-
    sim_start(room, [screen(deep)]).
test(its_layout_is_told_beside_the_motors,
     [ forall(member(Bits-Stride, [32-712, 1-24])),
       true(Read == ['178,128', Bits, Stride])
     ]) :-
    with_sim(room, [screen(Bits)],
             findall(Value,
                     ( member(Name, [virtual_size, bits_per_pixel, stride]),
                       atom_concat('/sys/class/graphics/fb0/', Name, File),
                       file_read(File, Value)
                     ),
                     Read)).

:- end_tests(sim_screen).

:- begin_tests(sim_mount, [condition(can_mount)]).

test(shows_the_devices, true(Seen == [91136, [fb0, input], [event0, event1]])) :-
    on_dev(mount,
           ( ev3_dev(Dev),
             directory_file_path(Dev, fb0, Screen),
             directory_file_path(Dev, input, Input),
             size_file(Screen, Size),
             files(Dev, Names),
             files(Input, InputNames0),
             subtract(InputNames0, ['by-path'], InputNames),
             Seen = [Size, Names, InputNames] )).
test(its_devices_are_those_of_the_process, true(Keys == [left])) :-
    on_dev(mount,
           ( sim_press(left),
             findall(Key, button(Key), Keys) )).
test(ends_with_both, true(Files == [])) :-
    tmp_file(mount, A),
    tmp_file(mount, B),
    with_sim(room,
             ( maplist(make_directory, [A, B]),
               sim_mount(A, B),
               sim_unmount,
               findall(File, ( member(D, [A, B]), files(D, Fs), member(File, Fs) ),
                       Files),
               maplist(delete_directory, [A, B]) )).
test(leaves_nothing_mounted_if_one_cannot_be,
     [ true(Formal-Files == existence_error(directory, '/no/such')-[]) ]) :-
    tmp_file(mount, A),
    with_sim(room,
             ( make_directory(A),
               catch(sim_mount(A, '/no/such'), error(Formal, _), true),
               files(A, Files),
               delete_directory(A) )).
test(a_reader_of_events_can_be_interrupted_and_goes_on, true(Size == 24)) :-
    on_dev(mount,
           ( ev3_dev(Dev),
             directory_file_path(Dev, 'input/event1', File),
             later(0.3, sim_press(up)),
             process_create(path(head), ['-c', 24, file(File)],
                            [stdout(pipe(Out))]),
             set_stream(Out, type(binary)),
             read_bytes(Out, Bytes),
             close(Out),
             length(Bytes, Size) )).

files(Directory, Names) :-
    directory_files(Directory, Names0),
    subtract(Names0, ['.', '..'], Names1),
    msort(Names1, Names).

read_bytes(Stream, Bytes) :-
    get_byte(Stream, Byte),
    (   Byte == -1
    ->  Bytes = []
    ;   Bytes = [Byte|Rest],
        read_bytes(Stream, Rest)
    ).

:- end_tests(sim_mount).
