:- module(trees,
          [ tree/1,                     % ?Tree
            behaving/1,                 % ?Tree
            on/2,                       % +Tree, :Goal
            equip/2,                    % +Tree, +Devices
            moving/3,                   % +Tree, +Ports, :Goal
            settle/1                    % +Tree
          ]).
:- use_module(tree).
:- use_module(simulation).
:- use_module(library(ev3dev)).
:- use_module(library(ev3dev/sim)).

/** <module> One test over three trees

Plain files, the simulator within the process on its virtual clock, and the
simulator's files through FUSE.
*/

:- meta_predicate
    on(+, 0),
    on_mount(0),
    moving(+, +, 0).

%!  tree(?Tree) is nondet.
%
%   A tree that can be had on this machine.

tree(plain).
tree(Tree) :-
    behaving(Tree).

%!  behaving(?Tree) is nondet.
%
%   A tree with something behind it, that refuses what the kernel refuses.

behaving(simulator).
behaving(mount) :-
    can_mount.

:- (   can_mount
   ->  true
   ;   format("skipped: the tests through FUSE, which cannot be had here~n")
   ).

%!  on(+Tree, :Goal)
%
%   Call Goal once with the paper's robot in Tree.

on(plain, Goal) :-
    with_tree([ in1-'lego-ev3-us',
                in2-'lego-ev3-color',
                in3-'lego-ev3-color',
                in4-'lego-ev3-gyro',
                outA-'lego-ev3-m-motor',
                outB-'lego-ev3-l-motor',
                outC-'lego-ev3-l-motor'
              ], once(Goal)).
on(simulator, Goal) :-
    with_sim(room, Goal).
on(mount, Goal) :-
    on_mount(Goal).

on_mount(Goal) :-
    tmp_file(mount, Directory),
    setup_call_cleanup(
        make_directory(Directory),
        setup_call_cleanup(
            ( sim_start(room, [clock(realtime)]),
              sim_mount(Directory),
              ev3_sysfs(Directory) ),
            once(Goal),
            ( sim_unmount,
              sim_stop )),
        delete_directory(Directory)).

%!  equip(+Tree, +Devices)
%
%   Give the robot more, by a list of Port-Type. To be called first of all. In
%   a plain tree the devices are just there, a port itself as port(Port); the
%   brick's own lights, ports and battery are always there in the others.

equip(plain, Devices) :-
    forall(member(Port-Type, Devices), plug(Port, Type)).
equip(simulator, Devices) :-
    forall(member(Device, Devices), announce(Device)).
equip(mount, Devices) :-
    forall(member(Device, Devices), announce(Device)).

announce(Port-'rcx-motor') :-
    !,
    port_mode(Port, 'dc-motor').
announce(Servo-'ms-8ch-servo') :-
    !,
    sub_atom(Servo, 0, 3, _, Port),
    sim_plug(Port, 'ms-8ch-servo'),
    sim_step(3).
announce(Port-Type) :-
    sub_atom(Type, 0, _, _, 'act-'),
    !,
    sim_plug(Port, Type),
    sim_step(1),
    port_device(Port, Type).
announce(_).

%!  moving(+Tree, +Ports, :Goal)
%
%   Call Goal, which makes one move of the motors at Ports. In a plain tree
%   threads move them.

moving(plain, [], Goal) :-
    !,
    call(Goal).
moving(plain, [Port|Ports], Goal) :-
    !,
    meanwhile(obey(Port), moving(plain, Ports, Goal)).
moving(_, _, Goal) :-
    call(Goal).

%!  settle(+Tree)
%
%   Let a motor that holds come to rest.

settle(simulator) :-
    sim_step(0.3).
settle(mount) :-
    sleep(0.3).
