:- module(trees,
          [ tree/1,                     % ?Tree
            behaving/1,                 % ?Tree
            of_files/1,                 % ?Tree
            current_tree/1,             % ?Tree
            on/2,                       % +Tree, :Goal
            on_slow_mount/2,            % +World, :Goal
            patiently/2,                % +Tree, :Goal
            with_tree/2,                % +Tree, :Goal
            with_tree/3,                % +Tree, +Devices, :Goal
            with_sensor/4,              % +Tree, +Type, +World, :Goal
            sensor_bus/2,               % ?Type, ?Address
            equip/2,                    % +Tree, +Devices
            settle/1,                   % +Tree
            took/4,                     % +Tree, +Since, +Seconds, +Tolerance
            plug/2,                     % +Port, +Type
            unplug/1,                   % +Port
            attribute_path/3,           % +Port, +Attribute, -Path
            put_attribute/3,            % +Port, +Attribute, +Text
            show_attribute/3,           % +Port, +Attribute, +Text
            get_attribute/3,            % +Port, +Attribute, -Text
            written/2,                  % +Port, -Attributes
            written/1,                  % -Attributes
            tree_root/1,                % -Directory
            use_tree_again/0,
            program_in_tree/3,          % +Text, -Program, -Options
            left/4,                     % +Port, +Attribute, +Output, -Text
            later/2,                    % +Seconds, :Goal
            meanwhile/2,                % :Other, :Goal
            eventually/1,               % :Goal
            unmounted/0,
            obeying/2,                  % +Ports, :Goal
            runs/1,                     % +Port
            stops/1,                    % +Port
            rests/2,                    % +Thread, +Port
            block/1,                    % +Port
            warnings/2                  % :Goal, -Warnings
          ]).
:- reexport(simulation).
:- use_module(trees/plain).
:- use_module(trees/simulated).
:- use_module(library(error)).
:- use_module(library(lists)).
:- use_module(library(readutil)).

/** <module> The same test over three trees of devices

A test says which trees it is about, so that plunit names the one in which it
fails:

    test(runs_on, [forall(tree(Tree)), true(C == 'run-forever')]) :-
        with_tree(Tree, ( motor_run(outB, 20),
                          get_attribute(outB, command, C) )).

  - plain
    A directory of files as the kernel shows them after plugging in. They store
    what is written, and nothing moves: later/2, meanwhile/2 and obeying/2 make a
    thread play the kernel's part.
  - simulator
    The simulator within the process, on its virtual clock.
  - mount
    The simulator's files through FUSE, in real time.

In the last two the motors move by themselves, and what is written is refused
where the kernel refuses it.
*/

:- meta_predicate
    on(+, 0),
    in_tree(+, 0),
    with_tree(+, 0),
    with_tree(+, +, 0),
    with_sensor(+, +, +, 0),
    on_mount(+, +, 0),
    on_slow_mount(+, 0),
    later(+, 0),
    meanwhile(0, 0),
    obeying(+, 0),
    eventually(0),
    warnings(0, -).

:- dynamic
    known_bus/2,                        % Type, Address
    entered/1,                          % Tree
    root/1,                             % Directory
    devices/1,                          % Devices
    plugged/2,                          % Port, Directory
    typed/2,                            % Port, Type
    numbered/2,                         % Class, Number of the next device
    warned/1.                           % Term of a message

%!  tree(?Tree) is nondet.
%
%   A tree that can be had on this machine. TREES in the environment leaves out
%   those that it does not name.

tree(Tree) :-
    chosen(Tree),
    (   Tree == mount
    ->  can_mount
    ;   true
    ).

chosen(Tree) :-
    (   getenv('TREES', Text)
    ->  atomic_list_concat(Trees, ' ', Text),
        must_be(list(oneof([plain, simulator, mount])), Trees)
    ;   Trees = [plain, simulator, mount]
    ),
    member(Tree, Trees).

:- (   chosen(mount),
       \+ can_mount
   ->  format("skipped: the tests through FUSE, which cannot be had here~n")
   ;   true
   ).

%!  behaving(?Tree) is nondet.
%
%   A tree in which motors move, and that refuses what the kernel refuses.

behaving(Tree) :-
    member(Tree, [simulator, mount]),
    tree(Tree).

%!  of_files(?Tree) is nondet.
%
%   A tree of files that any program sees.

of_files(Tree) :-
    member(Tree, [plain, mount]),
    tree(Tree).

%!  current_tree(?Tree) is semidet.
%
%   The tree that is in use, within on/2, with_tree/2 and the like.

current_tree(Tree) :-
    entered(Current),
    !,
    Tree = Current.

in_tree(Tree, Goal) :-
    setup_call_cleanup(
        asserta(entered(Tree)),
        Goal,
        retract(entered(Tree))).

%!  on(+Tree, :Goal)
%
%   Call Goal once with the default robot in Tree, which stands in a room.

on(plain, Goal) :-
    default_robot(Devices),
    with_tree(plain, Devices, once(Goal)).
on(simulator, Goal) :-
    in_tree(simulator, with_sim(room, Goal)).
on(mount, Goal) :-
    in_tree(mount, on_slow_mount(room, Goal)).

%!  on_slow_mount(+World, :Goal)
%
%   Call Goal once with the files of a simulation through FUSE, patiently/2.

on_slow_mount(World, Goal) :-
    patiently(mount, ( mount_clock(Clock),
                       on_mount(World, [clock(Clock)], Goal) )).

on_mount(World, Options, Goal) :-
    with_directory(Directory,
        setup_call_cleanup(
            ( sim_start(World, Options),
              sim_mount(Directory),
              ev3_sysfs(Directory) ),
            once(Goal),
            ( unmounted,
              sim_stop ))).

%!  unmounted is det.
%
%   Unmount the simulated files. A process that has just been killed may hold
%   one of them for another moment.

unmounted :-
    eventually(catch(( sim_unmount -> true ; true ), error(_, _), fail)).

default_robot([ in1-'lego-ev3-us',
                in2-'lego-ev3-color',
                in3-'lego-ev3-color',
                in4-'lego-ev3-gyro',
                outA-'lego-ev3-m-motor',
                outB-'lego-ev3-l-motor',
                outC-'lego-ev3-l-motor'
              ]).

%!  with_tree(+Tree, :Goal) is det.
%!  with_tree(+Tree, +Devices, :Goal) is det.
%
%   Call Goal with nothing but these devices in Tree, on an endless empty floor;
%   it may leave choice points. Devices is a list of Port-Type, by default those
%   of the default robot and a third large motor.

with_tree(Tree, Goal) :-
    default_robot(Devices),
    append(Devices, [outD-'lego-ev3-l-motor'], All),
    with_tree(Tree, All, Goal).

with_tree(Tree, Devices, Goal) :-
    must_be(oneof([plain, simulator, mount]), Tree),
    in_tree(Tree,
            setup_call_cleanup(
                make_tree(Tree, Devices),
                Goal,
                drop_tree(Tree))).

make_tree(plain, Devices) :-
    plain_start(Root),
    entered_with(Root, Devices),
    forall(member(Port-Type, Devices), plug(Port, Type)),
    ev3_sysfs(Root).
make_tree(simulator, Devices) :-
    make_simulated_tree(simulator, Devices).
make_tree(mount, Devices) :-
    make_simulated_tree(mount, Devices).

make_simulated_tree(Tree, Devices) :-
    simulated_start(Tree, Devices, Root),
    entered_with(Root, Devices),
    % A brick finds what is plugged in while it starts in the order of ports.
    msort(Devices, Ordered),
    forall(member(Port-Type, Ordered), is_plugged(Port, Type, _)),
    forall(member(Port-Type, Ordered), is_known(Tree, Port, Type)).

entered_with(Root, Devices) :-
    asserta(root(Root)),
    asserta(devices(Devices)).

drop_tree(Tree) :-
    retract(root(Root)),
    !,
    retract(devices(_)),
    !,
    retractall(plugged(_, _)),
    retractall(typed(_, _)),
    retractall(numbered(_, _)),
    (   Tree == plain
    ->  plain_stop(Root)
    ;   simulated_stop(Tree, Root)
    ).

%!  with_sensor(+Tree, +Type, +World, :Goal)
%
%   Call Goal once with a sensor of Type at in1 in Tree, which looks ahead from
%   the middle of the axle; and with two motors. World is a list of facts.

with_sensor(plain, Type, _, Goal) :-
    (   sensor_bus(Type, Address)
    ->  atomic_list_concat([in1, Address], ':', Port)
    ;   Port = in1
    ),
    with_tree(plain,
              [Port-Type, outB-'lego-ev3-l-motor', outC-'lego-ev3-l-motor'],
              once(Goal)).
with_sensor(simulator, Type, World, Goal) :-
    robot_with(Type, Robot),
    in_tree(simulator,
            with_sim(World,
                     ( tell_port(simulator, Type), Goal ),
                     [robot(Robot)])).
with_sensor(mount, Type, World, Goal) :-
    robot_with(Type, Robot),
    in_tree(mount,
            on_mount(World, [clock(realtime), robot(Robot)], ( tell_port(mount, Type), Goal ))).

robot_with(Type, [ left_wheel(outB, 5.6), right_wheel(outC, 5.6),
                   axle(10.6), hull(circle(8)), mass(0.75),
                   motor(outB, 'lego-ev3-l-motor'),
                   motor(outC, 'lego-ev3-l-motor'),
                   sensor(in1, Type, 0, 0, 0) ]).

% An unrecognized sensor comes up as `nxt-analog`.
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
%   Those that are on the I2C bus, and where, by the paper about the kernel.

sensor_bus(Type, Address) :-
    (   known_bus(_, _)
    ->  true
    ;   read_file_to_string('docs/ev3dev-sysfs.md', Text, []),
        split_string(Text, "\n", "", Rows),
        forall(( member(Row, Rows), string_concat("| `", Cells, Row),
                 split_string(Cells, "`", "", [Name|_]),
                 split_string(Name, ":", "", [Of, At]) ),
               ( atom_string(Known, Of), atom_string(Bus, At),
                 assertz(known_bus(Known, Bus)) ))
    ),
    known_bus(Type, Address).

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

%!  settle(+Tree)
%
%   Let a motor that holds come to rest. It swings about its target when a move is
%   over: by how much it is off is a matter of when somebody looks, which in real
%   time depends on what else this machine does.

settle(plain).
settle(simulator) :-
    sim_step(0.3).
settle(mount) :-
    sim_wait(0.3).

%!  took(+Tree, +Since, +Seconds, +Tolerance)
%
%   True if that many seconds of the simulation have passed since that time of it.
%   In real time it may be more, as this machine may be busy.

took(Tree, Since, Seconds, Tolerance) :-
    sim_time(Now),
    (   Tree == mount
    ->  Now - Since >= Seconds - Tolerance
    ;   near(Now - Since, Seconds, Tolerance)
    ).

%!  tree_root(-Directory)
%
%   Directory of the tree in use, as with_tree/1 made it.

tree_root(Directory) :-
    root(Directory).

%!  use_tree_again
%
%   Come back to the tree, whatever the program set since, with motors at rest.

use_tree_again :-
    current_tree(simulator),
    !,
    (   sim_is_over
    ->  devices(Devices),
        simulated_start(simulator, Devices, _)
    ;   stop_all_motors
    ).
use_tree_again :-
    root(Root),
    ev3_sysfs(Root).

sim_is_over :-
    \+ ev3dev_sim:sim_time(_).

%!  plug(+Port, +Type)
%
%   Plug a device in: a new directory with the next number of its class. The
%   Port of a port itself is port(Port). A `led` or a `battery` has no port, but
%   a name.

plug(Port, Type) :-
    current_tree(Tree),
    (   Tree == plain
    ->  is_plugged(Port, Type, Directory),
        plain_plug(Port, Type, Directory)
    ;   simulated_plug(Port, Type),
        is_plugged(Port, Type, _),
        is_known(Tree, Port, Type)
    ).

is_plugged(Port, Type, Directory) :-
    once(class(Type, Class, Prefix)),
    root(Root),
    directory_name(Prefix, Class, Port, Name),
    atomic_list_concat([Root, Class, Name], /, Directory),
    retractall(plugged(Port, _)),
    retractall(typed(Port, _)),
    assertz(plugged(Port, Directory)),
    assertz(typed(Port, Type)).

directory_name(named, _, Name, Name) :-
    !.
directory_name(Prefix, Class, _, Name) :-
    next_number(Class, Number),
    atom_concat(Prefix, Number, Name).

next_number(Class, Number) :-
    (   retract(numbered(Class, Number))
    ->  true
    ;   Number = 0
    ),
    Next is Number + 1,
    assertz(numbered(Class, Next)).

% A brick takes the NXT's motors for large ones, until a program sets their
% type.
is_known(Tree, Port, 'lego-nxt-motor') :-
    !,
    told_type(Tree, Port, 'lego-nxt-motor'),
    is_plugged(Port, 'lego-nxt-motor', _).
is_known(_, _, _).

%!  unplug(+Port)
%
%   Pull the wire: the directory vanishes.

unplug(Port) :-
    retract(plugged(Port, Directory)),
    retract(typed(Port, _)),
    (   current_tree(plain)
    ->  plain_unplug(Directory)
    ;   simulated_unplug(Port)
    ).

attribute_path(Port, Attribute, Path) :-
    plugged(Port, Directory),
    atomic_list_concat([Directory, Attribute], /, Path).

%!  put_attribute(+Port, +Attribute, +Text)
%
%   What an attribute holds from now on: another program writes it, or where
%   none can, the kernel shows it.

put_attribute(Port, Attribute, Text) :-
    attribute_path(Port, Attribute, Path),
    current_tree(Tree),
    (   Tree == plain
    ->  write_line_to(Path, Text)
    ;   is_writable(Attribute)
    ->  simulated_write(Tree, Path, Text)
    ;   simulated_show(Port, Attribute, Text)
    ).

is_writable(Attribute) :-
    memberchk(Attribute,
              [ command, duty_cycle_sp, mode, polarity, position, position_sp,
                ramp_down_sp, ramp_up_sp, speed_sp, stop_action, time_sp ]).

%!  show_attribute(+Port, +Attribute, +Text)
%
%   What the kernel shows from now on, even if nobody could write it.

show_attribute(Port, Attribute, Text) :-
    (   current_tree(plain)
    ->  put_attribute(Port, Attribute, Text)
    ;   simulated_show(Port, Attribute, Text)
    ).

%!  get_attribute(+Port, +Attribute, -Text)
%
%   Text is an atom. What can only be written, such as `command`, is what was
%   written last.

get_attribute(Port, Attribute, Text) :-
    attribute_path(Port, Attribute, Path),
    current_tree(Tree),
    (   Tree == plain
    ->  read_line_of(Path, Text)
    ;   Attribute == command
    ->  relative(Path, File),
        last_written(File, Text)
    ;   simulated_read(Tree, Path, Text)
    ).

relative(Path, File) :-
    root(Root),
    atom_concat(Root, '/', Prefix),
    atom_concat(Prefix, File, Path),
    !.

%!  written(+Port, -Attributes)
%
%   What was written to the attributes of a device, as a list of
%   Attribute=Text in the order of names.

written(Port, Attributes) :-
    plugged(Port, Directory),
    (   current_tree(plain)
    ->  typed(Port, Type),
        plain_written(Directory, Type, Attributes)
    ;   relative(Directory, Relative),
        all_written(Relative, Attributes)
    ).

%!  written(-Attributes)
%
%   What was written to any device, as a list of Port-Attribute=Text.

written(Attributes) :-
    findall(Port-Attribute,
            ( plugged(Port, _),
              written(Port, Written),
              member(Attribute, Written)
            ),
            Attributes).

%!  program_in_tree(+Text, -Program, -Options)
%
%   A program that uses library(ev3dev) on this tree, or on one like it, with
%   options for run_program/4.

program_in_tree(Text, Program, Options) :-
    current_tree(Tree),
    (   Tree == simulator
    ->  devices(Devices),
        simulating_program(Devices, Text, Program),
        Options = []
    ;   string_concat(":- use_module(library(ev3dev)).\n", Text, Program),
        root(Root),
        Options = [env('EV3DEV_SYSFS'=Root)]
    ).

%!  left(+Port, +Attribute, +Output, -Text)
%
%   What was written to an attribute last when a program with that Output was
%   over.

left(Port, Attribute, Output, Text) :-
    current_tree(simulator),
    !,
    attribute_path(Port, Attribute, Path),
    relative(Path, File),
    format(string(Start), "written ~w ", [File]),
    split_string(Output, "\n", "", Lines),
    findall(Last, ( member(Line, Lines), string_concat(Start, Last, Line) ), Texts),
    (   last(Texts, Last)
    ->  atom_string(Text, Last)
    ;   Text = ''
    ).
left(Port, Attribute, _, Text) :-
    get_attribute(Port, Attribute, Text).

% ---------------- THREADS

%!  later(+Seconds, :Goal)
%
%   Call Goal in another thread after some time by the tree's clock. In real time
%   it comes once this thread is within a call of the library, where it waits, or
%   if it waits elsewhere: then it was asked 400 times, or hears nothing.

later(Seconds, Goal) :-
    (   current_tree(simulator)
    ->  thread_create(( simulated_pause(Seconds), Goal ), _, [detached(true)])
    ;   thread_self(Me),
        thread_create(later_in_real_time(Me, Seconds, Goal), _, [detached(true)])
    ).

later_in_real_time(Main, Seconds, Goal) :-
    sleep(Seconds),
    waits(Main, 400),
    call(Goal).

% A signal is handled where the thread waits.
waits(Main, Left) :-
    sleep(0.002),
    thread_self(Me),
    thread_signal(Main, trees:tell_whether_within(Me)),
    (   thread_get_message(Me, within(Within), [timeout(0.5)])
    ->  Asked = 1
    ;   Asked = 100
    ),
    Next is Left - Asked,
    (   ( Within == true ; Next =< 0 )
    ->  true
    ;   waits(Main, Next)
    ).

tell_whether_within(Thread) :-
    prolog_current_frame(Frame),
    (   is_within(Frame)
    ->  Within = true
    ;   Within = false
    ),
    catch(thread_send_message(Thread, within(Within)), _, true).

is_within(Frame) :-
    prolog_frame_attribute(Frame, predicate_indicator, ev3dev_native:_),
    !.
is_within(Frame) :-
    prolog_frame_attribute(Frame, parent, Parent),
    is_within(Parent).

%!  meanwhile(:Other, :Goal)
%
%   Call Goal once while Other runs in another thread. Other is ended with
%   Goal. If Other fails or throws before that, so does this.

meanwhile(Other, Goal) :-
    setup_call_cleanup(
        thread_create(Other, Thread, []),
        once(Goal),
        ( catch(thread_signal(Thread, throw(over)), _, true),
          thread_join(Thread, Status)
        )),
    (   Status = exception(Error),
        Error \== over
    ->  throw(Error)
    ;   Status \== false
    ).

%!  eventually(:Goal)
%
%   Wait until Goal succeeds, and commit to that.
%
%   @error assertion_failed(eventually(Goal)) if it does not within five minutes,
%          or the machine is much too busy

eventually(Goal) :-
    get_time(Now),
    Deadline is Now + 300,
    repeat,
    (   call(Goal)
    ->  true
    ;   get_time(Then),
        Then > Deadline
    ->  throw(assertion_failed(eventually(Goal)))
    ;   sleep(0.002),
        fail
    ),
    !.

%!  obeying(+Ports, :Goal)
%
%   Call Goal once, which makes one position move of each motor at Ports. Where
%   they do not move by themselves, another thread plays them: it waits for the
%   commands, and lets the motors go half-way, be at their ends and rest.
%
%   They run from the beginning, lest they are taken for motors that do not
%   run at all where that thread comes late.

obeying(_, Goal) :-
    \+ current_tree(plain),
    !,
    once(Goal).
obeying(Ports, Goal) :-
    forall(member(Port, Ports), runs(Port)),
    meanwhile(forall(member(Port, Ports), obey(Port)), Goal).

obey(Port) :-
    eventually(get_attribute(Port, command, 'run-to-rel-pos')),
    get_number(Port, position, From),
    get_number(Port, position_sp, Way),
    Half is From + Way // 2,
    End is From + Way,
    sleep(0.02),
    put_attribute(Port, position, Half),
    sleep(0.02),
    put_attribute(Port, position, End),
    put_attribute(Port, state, '').

get_number(Port, Attribute, Number) :-
    get_attribute(Port, Attribute, Text),
    atom_number(Text, Number).

%!  runs(+Port)
%
%   Play a motor that runs at once, and does not get there.

runs(Port) :-
    (   current_tree(plain)
    ->  put_attribute(Port, state, running)
    ;   true
    ).

%!  stops(+Port)
%
%   Another program stops the motor at Port.

stops(Port) :-
    put_attribute(Port, command, stop),
    (   current_tree(plain)
    ->  put_attribute(Port, state, '')
    ;   true
    ).

%!  rests(+Thread, +Port)
%
%   Where motors do not move by themselves, the one at Port, which Thread has
%   commanded to run and waits for, rests. Thread itself sees to that, between
%   two looks at it: else it might come before the first, and the motor be
%   taken for one that does not run at all.

rests(Thread, Port) :-
    (   current_tree(plain)
    ->  thread_signal(Thread, put_attribute(Port, state, ''))
    ;   true
    ).

%!  block(+Port)
%
%   Hold the motor at Port fast.

block(Port) :-
    (   current_tree(plain)
    ->  put_attribute(Port, state, 'running stalled')
    ;   simulated_jam(Port)
    ).

%!  warnings(:Goal, -Warnings)
%
%   Call Goal once, succeed whether it does or not, and instead of printing
%   its warnings return them as a list of message terms.

warnings(Goal, Warnings) :-
    retractall(warned(_)),
    setup_call_cleanup(
        asserta((user:message_hook(Term, warning, _) :-
                     assertz(trees:warned(Term))),
                Clause),
        ignore(Goal),
        erase(Clause)),
    findall(Term, retract(warned(Term)), Warnings).
