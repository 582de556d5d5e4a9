:- module(simulated_tree,
          [ simulated_start/3,          % +Kind, +Devices, -Root
            simulated_stop/2,           % +Kind, +Root
            simulated_plug/2,           % +Port, +Type
            simulated_unplug/1,         % +Port
            told_type/3,                % +Kind, +Port, +Type
            simulated_read/3,           % +Kind, +File, -Text
            simulated_write/3,          % +Kind, +File, +Text
            simulated_show/3,           % +Port, +Attribute, +Text
            simulated_jam/1,            % +Port
            simulated_pause/1,          % +Seconds
            mount_clock/1,              % ?Clock
            patiently/2,                % +Tree, :Goal
            last_written/2,             % +RelativeFile, -Text
            all_written/2,              % +RelativeDirectory, -Attributes
            simulating_program/3        % +Devices, +Text, -Program
          ]).
:- asserta(user:file_search_path(library, prolog)).
:- use_module(plain, [read_line_of/2]).
:- use_module(library(ev3dev)).
:- use_module(library(ev3dev/sim)).
:- use_module(library(filesex)).
:- use_module(library(lists)).

/** <module> Trees with a simulated kernel behind them

A brick with nothing but the devices of the test, on an endless empty floor:
within the process on the virtual clock (Kind is `simulator`), or as files
through FUSE in real time (`mount`).
*/

:- meta_predicate patiently(+, 0).

:- dynamic told/1.                      % Goal: a command to the simulator

simulated_start(Kind, Devices, Root) :-
    retractall(told(_)),
    robot(Devices, Robot),
    clock(Kind, Clock),
    sim_start([start(0, 0, 0)], [clock(Clock), robot(Robot)]),
    root(Kind, Root),
    forall(member(Port-'rcx-motor', Devices), port_mode(Port, 'dc-motor')).

clock(simulator, virtual).
clock(mount, Clock) :-
    mount_clock(Clock).

%!  mount_clock(?Clock) is semidet.
%
%   Clock is the clock of the next simulation that is mounted.

:- dynamic mount_clock_/1.

mount_clock(Clock) :-
    mount_clock_(Clock0),
    !,
    Clock = Clock0.
mount_clock(realtime).

%!  patiently(+Tree, :Goal)
%
%   Call Goal once. A busy machine looks and commands late on a mount: where
%   Goal fails there, the robot is slower the next time.

:- multifile user:message_hook/3.
:- dynamic user:message_hook/3.

patiently(mount, Goal) :-
    !,
    member(Clock, [realtime, scaled(0.2), scaled(0.04)]),
    setup_call_cleanup(
        ( asserta(mount_clock_(Clock), Ref),
          asserta((user:message_hook(_, error, _) :- Clock \== scaled(0.04)),
                  Hook) ),
        once(Goal),
        ( erase(Ref), erase(Hook) )),
    !.
patiently(_, Goal) :-
    once(Goal).

root(simulator, '/sys/class').
root(mount, Root) :-
    tmp_file(mount, Root),
    make_directory(Root),
    sim_mount(Root),
    ev3_sysfs(Root).

% The paper's wheels, whether or not their motors are there.
robot(Devices,
      [ left_wheel(outB, 5.6), right_wheel(outC, 5.6), axle(10.6),
        hull(circle(8)), mass(0.75)
      | Facts ]) :-
    findall(Fact, ( member(Port-Type, Devices), fact(Port, Type, Fact) ), Facts).

% Lights and the battery are the brick's own.
fact(_, Type, _) :-
    memberchk(Type, [led, battery, 'rcx-motor']),
    !,
    fail.
fact(Port, Type, motor(Port, Type)) :-
    sub_atom(Port, 0, _, _, out),
    !.
fact(Address, Type, sensor(Port, Type, 0, 7, 0)) :-
    sub_atom(Address, 0, 3, _, Port).

% A test may have ended the simulation by itself.
simulated_stop(simulator, _) :-
    ignore(sim_stop).
simulated_stop(mount, Root) :-
    ignore(sim_unmount),
    ignore(sim_stop),
    delete_directory(Root).

%!  simulated_plug(+Port, +Type) is det.
%!  simulated_unplug(+Port) is det.
%
%   Plug in or pull, and let pass what the kernel and udev need to notice.

simulated_plug(Port, Type) :-
    sim_plug(Port, Type),
    sim_step(2).

simulated_unplug(Port) :-
    sim_unplug(Port),
    sim_step(0.2).

%!  told_type(+Kind, +Port, +Type)
%
%   Tell the port what is plugged in, as one has to for a motor that a brick
%   takes for another. It comes up again.

told_type(Kind, Port, Type) :-
    nth0(Number, [in1, in2, in3, in4, outA, outB, outC, outD], Port),
    root_of(Root),
    format(atom(File), "~w/lego-port/port~w/set_device", [Root, Number]),
    simulated_write(Kind, File, Type),
    sim_step(1).

root_of(Root) :-
    ev3_sysfs(Root).

%!  simulated_read(+Kind, +File, -Text) is det.
%!  simulated_write(+Kind, +File, +Text) is det.
%
%   As another program does. Within the process nobody but library(ev3dev) gets
%   at the files.

simulated_read(simulator, File, Text) :-
    file_read(File, Value),
    format(atom(Text), "~w", [Value]).
simulated_read(mount, File, Text) :-
    read_line_of(File, Text).

simulated_write(simulator, File, Text) :-
    file_write(File, Text).
simulated_write(mount, File, Text) :-
    setup_call_cleanup(
        open(File, update, Stream),
        format(Stream, "~w~n", [Text]),
        close(Stream)).

simulated_show(Port, Attribute, Text) :-
    note(sim_show(Port, Attribute, Text)).

simulated_jam(Port) :-
    note(sim_jam(Port, true)).

note(Goal) :-
    call(Goal),
    assertz(told(Goal)).

%!  simulated_pause(+Seconds)
%
%   Wait on the virtual clock. Nothing is left to wait for if the simulation is
%   over.

simulated_pause(Seconds) :-
    ignore(sim_wait(Seconds)).

%!  last_written(+RelativeFile, -Text)
%
%   The last command to the kernel through a file, as the simulator recorded
%   it: some files can only be written.

last_written(File, Text) :-
    sim_trace(Trace),
    findall(Text0, member(_-written(File, Text0), Trace), Texts),
    (   last(Texts, Text)
    ->  true
    ;   Text = ''
    ).

%!  all_written(+RelativeDirectory, -Attributes)
%
%   The last text that each file there was written, if it was, as a list of
%   Attribute=Text in the order of names.

all_written(Directory, Attributes) :-
    sim_trace(Trace),
    findall(Attribute-Text,
            ( member(_-written(File, Text), Trace),
              directory_file_path(Directory, Attribute, File)
            ),
            Written0),
    reverse(Written0, Written),
    sort(1, @<, Written, Last),
    findall(Attribute=Text, member(Attribute-Text, Last), Attributes).

%!  simulating_program(+Devices, +Text, -Program)
%
%   A program that starts the same simulation for itself, as it cannot get at
%   this one, and says at its end what was written. It does so twice, as it is
%   not said in which order the library's own hook comes: what counts is the
%   later.

simulating_program(Devices, Text, Program) :-
    robot(Devices, Robot),
    findall(Goal, told(Goal), Told),
    format(string(Program),
           ":- use_module(library(lists)).
            :- at_halt(tell_written).
            :- use_module(library(ev3dev/sim)).
            :- use_module(library(ev3dev)).
            :- at_halt(tell_written).
            :- sim_start([start(0, 0, 0)], [clock(virtual), robot(~q)]).
            :- forall(member(Goal, ~q), call(Goal)).
            tell_written :-
                sim_trace(Trace),
                forall(member(_-written(File, Text), Trace),
                       format(\"written ~~w ~~w~~n\", [File, Text])).
            ~s", [Robot, Told, Text]).
