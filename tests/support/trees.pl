:- module(trees,
          [ tree/1,                     % ?Tree
            behaving/1,                 % ?Tree
            on/2,                       % +Tree, :Goal
            equip/2,                    % +Tree, +Devices
            with_sensor/4,              % +Tree, +Type, +World, :Goal
            sensor_bus/2,               % ?Type, ?Address
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
    on_mount(+, +, 0),
    with_sensor(+, +, +, 0),
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
    on_mount(room, [], Goal).

on_mount(World, Options, Goal) :-
    tmp_file(mount, Directory),
    setup_call_cleanup(
        make_directory(Directory),
        setup_call_cleanup(
            ( sim_start(World, [clock(realtime)|Options]),
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
%!  with_sensor(+Tree, +Type, +World, :Goal)
%
%   Call Goal once with a sensor of Type at in1 in Tree, which looks ahead from
%   the middle of the axle; and with two motors. World is a list of facts.

with_sensor(plain, Type, _, Goal) :-
    (   sensor_bus(Type, Address)
    ->  atomic_list_concat([in1, Address], ':', Port)
    ;   Port = in1
    ),
    with_tree([Port-Type, outB-'lego-ev3-l-motor', outC-'lego-ev3-l-motor'],
              once(Goal)).
with_sensor(simulator, Type, World, Goal) :-
    robot_with(Type, Robot),
    with_sim(World, [robot(Robot)], ( tell_port(simulator, Type), Goal )).
with_sensor(mount, Type, World, Goal) :-
    robot_with(Type, Robot),
    on_mount(World, [robot(Robot)], ( tell_port(mount, Type), Goal )).

robot_with(Type, [ left_wheel(outB, 5.6), right_wheel(outC, 5.6),
                   axle(10.6), hull(circle(8)), mass(0.75),
                   motor(outB, 'lego-ev3-l-motor'),
                   motor(outC, 'lego-ev3-l-motor'),
                   sensor(in1, Type, 0, 0, 0) ]).

% What the brick does not recognise comes up as `nxt-analog`.
tell_port(Tree, Type) :-
    (   lego_sensor(in1, 'nxt-analog'),
        Type \== 'nxt-analog'
    ->  ev3_sysfs(Root),
        atom_concat(Root, '/lego-port/port0/set_device', File),
        file_write(File, Type),
        settle(Tree)
    ;   true
    ).

%!  sensor_bus(?Type, ?Address) is nondet.
%
%   Some that are on the I2C bus, and where.

sensor_bus('lego-nxt-us',        i2c1).
sensor_bus('lego-nxt-temp',      i2c76).
sensor_bus('lego-power-storage', i2c2).
sensor_bus('ht-nxt-compass',     i2c1).
sensor_bus('ht-nxt-color',       i2c1).
sensor_bus('ht-nxt-color-v2',    i2c1).
sensor_bus('ht-nxt-ir-seek-v2',  i2c8).
sensor_bus('ht-nxt-accel',       i2c1).
sensor_bus('ms-absolute-imu',    i2c17).

%!  moving(+Tree, +Ports, :Goal)
%
%   Call Goal, which makes one move of the motors at Ports. In a plain tree
%   a thread moves them.

moving(plain, Ports, Goal) :-
    !,
    obeying(Ports, Goal).
moving(_, _, Goal) :-
    call(Goal).

%!  settle(+Tree)
%
%   Let a motor that holds come to rest.

settle(simulator) :-
    sim_step(0.3).
settle(mount) :-
    sleep(0.3).
