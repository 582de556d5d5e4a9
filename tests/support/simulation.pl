:- module(simulation,
          [ with_sim/2,                 % +World, :Goal
            with_sim/3,                 % +World, +Options, :Goal
            for_seconds/2,              % +Seconds, :Goal
            at_rest/0,
            with_file/3,                % +Text, -File, :Goal
            with_directory/2,           % -Directory, :Goal
            can_mount/0,
            near/3                      % +Value, +Expected, +Tolerance
          ]).
:- asserta(user:file_search_path(library, prolog)).
:- asserta(user:file_search_path(example, examples)).
:- use_module(library(ev3dev)).
:- use_module(library(ev3dev/sim)).

/** <module> Runs in the simulator
*/

:- meta_predicate
    with_sim(+, 0),
    with_sim(+, +, 0),
    for_seconds(+, 0),
    with_file(+, -, 0),
    with_directory(-, 0).

%!  with_sim(+World, :Goal)
%!  with_sim(+World, +Options, :Goal)
%
%   Call Goal once in a simulation, on the virtual clock unless Options say
%   otherwise.

with_sim(World, Goal) :-
    with_sim(World, [], Goal).

with_sim(World, Options, Goal) :-
    append(Options, [clock(virtual)], All),
    setup_call_cleanup(
        sim_start(World, All),
        once(Goal),
        ignore(sim_stop)).

%!  for_seconds(+Seconds, :Goal)
%
%   Call a Goal that does not end for so many simulated seconds, or a little
%   longer.

for_seconds(Seconds, Goal) :-
    sim_time(Start),
    End is Start + Seconds,
    thread_self(Me),
    catch(setup_call_cleanup(
              thread_create(interrupt_at(End, Me), Id, []),
              Goal,
              ( thread_send_message(Id, stop),
                thread_join(Id, _)
              )),
          time_is_up,
          true).

interrupt_at(End, Thread) :-
    (   thread_get_message_within(0.002)
    ->  true
    ;   sim_time(Now),
        Now < End
    ->  interrupt_at(End, Thread)
    ;   thread_signal(Thread, throw(time_is_up))
    ).

thread_get_message_within(Seconds) :-
    thread_self(Me),
    thread_get_message(Me, stop, [timeout(Seconds)]).

%!  at_rest
%
%   True if no motor runs, nor turns a second later.

at_rest :-
    \+ ( motor_states(_, States), memberchk(running, States) ),
    sim_step(1),
    \+ ( speed(_, Speed), Speed =\= 0 ).

%!  with_file(+Text, -File, :Goal)
%
%   Call Goal once with a File of that Text.

with_file(Text, File, Goal) :-
    setup_call_cleanup(
        write_file(Text, File),
        once(Goal),
        delete_file(File)).

write_file(Text, File) :-
    tmp_file(world, File),
    setup_call_cleanup(
        open(File, write, Stream),
        write(Stream, Text),
        close(Stream)).

%!  with_directory(-Directory, :Goal)
%
%   Call Goal once with a new Directory, in which it leaves nothing.

with_directory(Directory, Goal) :-
    tmp_file(mount, Directory),
    setup_call_cleanup(
        make_directory(Directory),
        once(Goal),
        delete_directory(Directory)).

%!  can_mount
%
%   True if this machine has FUSE, and the library was built with it. It is tried
%   once.

can_mount :-
    (   mountable(_)
    ->  true
    ;   mounts_here
    ->  assertz(mountable(true))
    ;   assertz(mountable(false))
    ),
    mountable(true).

:- dynamic mountable/1.                 % Boolean

mounts_here :-
    access_file('/dev/fuse', exist),
    with_directory(Directory, with_sim(room, mounts(Directory))).

mounts(Directory) :-
    catch(sim_mount(Directory), error(existence_error(feature, _), _), fail),
    sim_unmount.

%!  near(+Value, +Expected, +Tolerance)

near(Value, Expected, Tolerance) :-
    (   abs(Value - Expected) =< Tolerance
    ->  true
    ;   print_message(error, format("~w is not within ~w of ~w",
                                    [Value, Tolerance, Expected])),
        fail
    ).
