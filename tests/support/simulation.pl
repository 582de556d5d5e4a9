:- module(simulation,
          [ at_rest/0,
            with_file/3,                % +Text, -File, :Goal
            with_directory/2,           % -Directory, :Goal
            can_mount/0,
            near/3                      % +Value, +Expected, +Tolerance
          ]).
:- asserta(user:file_search_path(library, prolog)).
:- asserta(user:file_search_path(example, examples)).
:- reexport(library(ev3dev)).
:- reexport(library(ev3dev/sim)).

/** <module> Runs in the simulator

A test that loads this file, or trees.pl, has library(ev3dev) and
library(ev3dev/sim), too.
*/

:- meta_predicate
    with_file(+, -, 0),
    with_directory(-, 0).

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
%   True if this machine has FUSE, with the helper that a user needs who is not root, and
%   the library was built with it. It is tried once.

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
    catch(sim_mount(Directory), error(Formal, _), cannot_be_had(Formal)),
    sim_unmount.

cannot_be_had(existence_error(feature, _)) :-
    !,
    fail.
cannot_be_had(domain_error(mountable_directory, _)) :-
    \+ absolute_file_name(path(fusermount3), _, [access(execute), file_errors(fail)]),
    !,
    fail.
cannot_be_had(Formal) :-
    throw(error(Formal, _)).

%!  near(+Value, +Expected, +Tolerance)

near(Value, Expected, Tolerance) :-
    (   abs(Value - Expected) =< Tolerance
    ->  true
    ;   print_message(error, format("~w is not within ~w of ~w",
                                    [Value, Tolerance, Expected])),
        fail
    ).
