:- module(ev3dev_bricks,
          [ brick_open/2,               % +Name, +Where
            brick_close/1,              % +Name
            brick/1,                    % ?Name
            brick/2,                    % ?Name, ?Where
            with_brick/2,               % +Name, :Goal
            use_brick/1,                % ?Name
            bricks_do/1,                % :Goal
            bricks_do/2,                % +Names, :Goal
            far/2,                      % +Name, +Goal
            far_load/2,                 % +Name, +File
            robot_send/2,               % +To, +Term
            robot_receive/3,            % -From, ?Term, +Options
            robots_join/1,              % +Redis
            robots_leave/0,
            stop_all_bricks/0
          ]).
:- set_prolog_flag(generate_debug_info, false).
:- use_module(private/load/compiled, []).
:- use_module(private/run/brick,
              [ end_brick/1, in_brick/2, is_simulated/0, must_be_new_names/1,
                name_brick/3, named_brick/3, new_brick/1, switch_brick/1,
                unname_brick/1 ]).
:- use_module(private/checks/arguments,
              [must_be_options/3, timeout_option/2]).
:- use_module(private/files/directory, [directory_path/2]).
:- use_module(private/checks/checks, [must_be/2, must_be_goal/1]).
:- use_module(private/errors/errors, [throw_error/3]).
:- use_module(private/errors/frames, [goal_of_program/1]).
:- use_module(private/errors/public_clauses, [term_expansion/4]).
:- use_module(private/bricks/messages, [next_message/4, send_message/3]).
:- use_module(private/native/native, [brick_/1, stop_all_bricks_/0]).
:- use_module(private/basics/small_lists, [one_of/2]).
:- use_module(private/processes/redis, [redis_address/2]).
:- use_module(private/simulation/world_name, [noted_world/2]).
:- use_module(files, [ev3_sysfs/1]).
:- use_module(time, [ev3_time/1]).
:- use_module(library(thread), [concurrent/3]).

:- meta_predicate
    with_brick(+, 0),
    bricks_do(0),
    bricks_do(+, 0).

/** <module> Several bricks

A program starts with one brick, `local`: this machine, or a simulated robot.
This library opens others. Each predicate of the pack is about the brick in
use, and ports keep their names:

```
?- brick_open(anna, sim(room)), brick_open(bob, sim(maze)).
?- with_brick(anna, us_dist_cm(in1, D)).
?- bricks_do([anna, bob], go_cm(30, 50)).       % both, at the same time
```

A brick has its own robot (set_robot/4), odometry, grid, events, screen and
simulation. A thread begins with the brick of the thread that made it.
*/

%!  brick_open(+Name, +Where) is det.
%
%   Name, an atom, is a brick from now on. with_brick/2 or use_brick/1 puts it
%   into use. Where is
%
%     - local
%       The one with which a program starts: another name for it.
%     - dir(Directory)
%       One whose attribute files are below a directory of the shape of
%       `/sys/class`, such as that of sim_mount/1.
%     - sim
%       A simulated one. sim_start/1,2 chooses its world, with that brick in
%       use; else its first use starts it in the world `room`.
%     - sim(World)
%     - sim(World, Options)
%       The same with sim_start(World, Options).
%     - ssh(Destination)
%       A brick on the network with this pack, where ssh logs in: Host or
%       User@Host, such as `robot@ev3dev.local`. far/2 sends it goals. Its
%       motors stop, and its process ends, when this program ends or closes
%       it, or the connection is silent for a second.
%     - command(Program, Arguments)
%       The same with another program, behind which library(ev3dev/worker)
%       speaks: as `command(swipl, ['-q', '-g',
%       'use_module(library(ev3dev/worker)),work', '-t', halt])`.
%
%   @error permission_error(open, brick, Name) if that name is taken
%   @error domain_error(brick_name, '')
%   @error domain_error(brick_place, Where)
%   @error existence_error(directory, Directory)
%   @error existence_error(connection, Name) if no worker answers in a minute
%   @error what sim_start/2 and process_create/3 throw

brick_open(Name, Where) :-
    must_be(atom, Name),
    (   Name == ''
    ->  throw_error(domain_error(brick_name, Name), _,
                    'the name of a brick has at least one letter')
    ;   true
    ),
    must_be(nonvar, Where),
    (   named_brick(Name, far(Far), _),
        ev3dev_far:is_lost(Far)
    ->  brick_close(Name)
    ;   true
    ),
    must_be_new_names([Name]),
    (   opened(Where, Name, Brick)
    ->  name_brick(Name, Brick, Where)
    ;   throw_error(domain_error(brick_place, Where), _,
                    'a place is local, dir(Directory), sim, sim(World), \c
                     sim(World, Options), ssh(Destination) or \c
                     command(Program, Arguments)')
    ).

opened(ssh(Destination), Name, Brick) :-
    !,
    opened_far(Name, ssh(Destination), Brick).
opened(command(Program, Arguments), Name, Brick) :-
    !,
    opened_far(Name, command(Program, Arguments), Brick).
opened(Where, _, Brick) :-
    opened(Where, Brick).

opened_far(Name, Where, far(Far)) :-
    use_module(library(ev3dev/private/bricks/far), []),
    ev3dev_far:far_open(Name, Where, Far).

opened(local, 0).
opened(dir(Directory), Brick) :-
    directory_path(Directory, Path),
    begun(ev3_sysfs(Path), Brick).
opened(sim, Brick) :-
    new_brick(Brick).
opened(sim(World), Brick) :-
    opened(sim(World, []), Brick).
opened(sim(World, Options), Brick) :-
    begun(ev3dev_bricks:simulated(World, Options), Brick).

:- public simulated/2.

simulated(World, Options) :-
    use_module(library(ev3dev/sim), []),
    ev3dev_sim:sim_start(World, Options).

%   Nothing is left of one that cannot begin.
begun(Goal, Brick) :-
    new_brick(Brick),
    catch(in_brick(Brick, Goal), E, true),
    (   var(E)
    ->  true
    ;   end_brick(Brick),
        throw(E)
    ).

%!  brick_close(+Name) is det.
%
%   Close the brick Name. Its motors stop, its simulation ends, and what was
%   known of it is forgotten. A thread that has it in use gets errors from now
%   on; this one has `local` in use instead.
%
%   @error existence_error(brick, Name)
%   @error permission_error(close, brick, local)

brick_close(Name) :-
    number_of(Name, Brick),
    (   Name == local
    ->  throw_error(permission_error(close, brick, local), _,
                    'this brick is always there')
    ;   true
    ),
    unname_brick(Name),
    (   Brick == 0
    ->  true
    ;   Brick = far(Far)
    ->  ev3dev_far:far_close(Far)
    ;   (   brick_(Brick)
        ->  switch_brick(0)
        ;   true
        ),
        end_brick(Brick)
    ).

%!  brick(?Name) is nondet.
%!  brick(?Name, ?Where) is nondet.
%
%   True if there is a brick Name, at that place: `local`, and those of
%   brick_open/2 in their order.

brick(Name) :-
    brick(Name, _).

brick(local, local).
brick(Name, Where) :-
    named_brick(Name, _, Where).

%   Of a far brick, Brick is far(Far).

number_of(Name, Brick) :-
    must_be(atom, Name),
    (   numbered(Name, Brick)
    ->  true
    ;   throw_error(existence_error(brick, Name), _,
                    'there is no brick of that name; brick_open/2 opens one')
    ).

near(Name, Brick) :-
    number_of(Name, Brick),
    (   Brick = far(_)
    ->  throw_error(permission_error(use, far_brick, Name), _,
                    'each access would travel; far/2 sends it a goal')
    ;   true
    ).

numbered(local, 0).
numbered(Name, Brick) :-
    named_brick(Name, Brick, _).

%!  with_brick(+Name, :Goal) is nondet.
%
%   Call Goal, in which all predicates are about the brick Name. Before,
%   after, and between its solutions they are about the one that was in use.
%   Events and rules that were begun with another brick in use go on
%   meanwhile, and are about that one.
%
%   @error existence_error(brick, Name)
%   @error permission_error(use, far_brick, Name)
%   @error type_error(callable, Goal)

with_brick(Name, Goal) :-
    near(Name, Brick),
    must_be_goal(Goal),
    in_brick(Brick, goal_of_program(Goal)).

%!  use_brick(?Name) is det.
%
%   From now on predicates are about the brick Name, in this thread and in
%   those that it makes. If Name is unbound, it is the name of the one in use.
%
%   @error existence_error(brick, Name)
%   @error permission_error(use, far_brick, Name)

use_brick(Name) :-
    var(Name),
    !,
    brick_(Brick),
    (   numbered(Name, Brick)
    ->  true
    ;   throw_error(existence_error(brick, Brick), _,
                    'the brick that this thread has in use has no name')
    ).
use_brick(Name) :-
    near(Name, Brick),
    switch_brick(Brick).

%!  bricks_do(:Goal) is semidet.
%!  bricks_do(+Names, :Goal) is semidet.
%
%   Call Goal once with each brick in use, at the same time, each in a thread
%   of its own: the bricks of the list Names, or all that brick_open/2 has
%   opened, or `local` if it has opened none. Waits for all. Binds nothing:
%   each has a copy of Goal. Fails if Goal fails with one of them; then, and
%   after an error, the others are interrupted, and their moves stop. A far
%   brick gets Goal by far/2.
%
%   @error existence_error(brick, Name)
%   @error type_error(callable, Goal)

bricks_do(Goal) :-
    must_be_goal(Goal),
    findall(Name, named_brick(Name, _, _), Names),
    (   Names == []
    ->  bricks_do([local], Goal)
    ;   bricks_do(Names, Goal)
    ).

bricks_do(Names, Goal) :-
    must_be(list, Names),
    must_be_goal(Goal),
    findall(ev3dev_bricks:on_brick(Brick, Goal),
            ( one_of(Names, Name), number_of(Name, Brick) ),
            Goals),
    length(Goals, Count),
    (   Count == 0
    ->  true
    ;   concurrent(Count, Goals, [])
    ).

:- public on_brick/2.

on_brick(far(Far), Goal) :-
    !,
    strip_module(Goal, _, Plain),
    ev3dev_far:far_call(Far, Plain).
on_brick(Brick, Goal) :-
    in_brick(Brick, goal_of_program(Goal)).

%!  far(+Name, +Goal) is semidet.
%
%   Call Goal once on the far brick Name, in its module `user`: one message
%   there, one back. Its solution, failure or error is that of far/2. What it
%   prints is printed here, after the brick's name. Goals come one after the
%   other. If this call is interrupted, for example by Ctrl-C, the goal there
%   ends, and all motors of that brick stop; so they do if it hears nothing
%   for a second.
%
%   Meanwhile this thread serves its events. Branches of both/2 go on slowly;
%   bricks_do/2 has a thread for each brick.
%
%   @error existence_error(brick, Name)
%   @error domain_error(far_brick, Name) if it is not a far one
%   @error existence_error(connection, Name) if it has not been heard of for
%          two seconds, or has ended; brick_open/2 opens it again
%   @error type_error(acyclic_term, Goal)
%   @error resource_error(frame) if Goal has more than a million characters
%   @error what Goal throws

far(Name, Goal) :-
    far_of(Name, Far),
    must_be_goal(Goal),
    ev3dev_far:far_call(Far, Goal).

%!  far_load(+Name, +File) is det.
%
%   Load the program File, one of this machine, on the far brick Name. Loading
%   it again replaces it.
%
%   @error existence_error(source_sink, File)
%   @error the other errors of far/2

far_load(Name, File) :-
    far_of(Name, Far),
    must_be(nonvar, File),
    ev3dev_far:far_file(Far, File).

far_of(Name, Far) :-
    number_of(Name, Brick),
    (   Brick = far(Far)
    ->  true
    ;   throw_error(domain_error(far_brick, Name), _,
                    'that brick is not far: with_brick/2 is for it')
    ).

%!  robot_send(+To, +Term) is det.
%
%   Send a copy of Term to the brick To, whose program takes it by
%   robot_receive/3. In a simulation it arrives 10 ms later. Does not wait.
%   After robots_join/1, To may be a brick of another program. Nobody checks
%   whether there is one; a message that no program takes is lost.
%
%   @error existence_error(brick, To)
%   @error permission_error(use, far_brick, To)

robot_send(To, Term) :-
    must_be(atom, To),
    brick_(Me),
    (   named_brick(Name, Me, _)
    ->  true
    ;   numbered(Name, Me)
    ->  true
    ;   Name = Me
    ),
    (   \+ numbered(To, _),
        current_predicate(ev3dev_mail:send_mail/3),
        ev3dev_mail:send_mail(To, Name, Term)
    ->  true
    ;   near(To, Brick),
        send_message(Brick, Name, Term)
    ).

%!  robots_join(+Redis) is det.
%!  robots_leave is det.
%
%   From now on robot_send/2 and robot_receive/3 are also for the bricks of
%   other programs that have joined, on this machine and on others, by a Redis
%   server: redis(Host) or redis(Host:Port). Each brick needs a name of its
%   own: `brick_open(anna, local)` gives one to this machine. Time is that of
%   the wall clock. Everybody who can write to that server can send messages.
%   If it goes away, the program tries to reach it again each second.
%
%   @error domain_error(redis_address, Address)
%   @error permission_error(join, redis, HostPort) if it has joined already
%   @error permission_error(join, clock, virtual) where the brick in use is
%          simulated on the virtual clock
%   @error existence_error(redis_server, HostPort)
%   @error existence_error(library, redis) in a Prolog without it

robots_join(Redis) :-
    must_be(nonvar, Redis),
    (   Redis = redis(Address)
    ->  must_be(nonvar, Address),
        redis_address(Address, HostPort)
    ;   throw_error(domain_error(redis_address, Redis), _,
                    'robots join by redis(Host) or redis(Host:Port)')
    ),
    (   is_simulated,
        noted_world(_, Options),
        memberchk(clock(virtual), Options)
    ->  throw_error(permission_error(join, clock, virtual), _,
                    'other programs do not wait for this clock')
    ;   true
    ),
    use_module(library(ev3dev/private/bricks/mail), []),
    ev3dev_mail:join_mail(HostPort).

robots_leave :-
    (   current_predicate(ev3dev_mail:leave_mail/0)
    ->  ev3dev_mail:leave_mail
    ;   true
    ).

%!  robot_receive(-From, ?Term, +Options) is semidet.
%
%   Take the first message to the brick in use that unifies with From, the
%   name of its sender, and Term; the others stay for later. Waits for one,
%   and fails after a time. Listeners and time limits do their work meanwhile.
%   Options:
%
%     - timeout(+Seconds)
%       How long to wait; 0 takes what has arrived already. By default there
%       is no end.
%
%   @error domain_error(receive_option, Option)

robot_receive(From, Term, Options) :-
    must_be_options(receive_option, [timeout], Options),
    timeout_option(Options, Timeout),
    (   Timeout == infinite
    ->  Until = inf
    ;   ev3_time(Now),
        Until is Now+Timeout
    ),
    next_message(Until, Late, From, Term),
    Late == false.

%!  stop_all_bricks is det.
%
%   Stop all motors of all bricks, as stop_all_motors/0 does of one.

stop_all_bricks :-
    stop_all_bricks_,
    forall(named_brick(_, far(Far), _), ev3dev_far:far_stop(Far)).
