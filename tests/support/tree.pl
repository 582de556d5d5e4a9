:- module(tree,
          [ tree_kind/1,                % -Kind
            only/2,                     % +Trees, +Why
            with_tree/1,                % :Goal
            with_tree/2,                % +Devices, :Goal
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
            obeying/2,                  % +Ports, :Goal
            runs/1,                     % +Port
            stops/1,                    % +Port
            block/1,                    % +Port
            warnings/2                  % :Goal, -Warnings
          ]).
:- asserta(user:file_search_path(library, prolog)).
:- use_module(plain_tree).
:- use_module(simulated_tree).
:- use_module(tally).
:- use_module(library(ev3dev)).
:- use_module(library(error)).
:- use_module(library(lists)).

/** <module> The tree of devices that a test is about

The same tests run over three kinds of trees. EV3DEV_TEST_TREE in the
environment chooses the one of this run:

  - plain (default)
    A directory of files as the kernel shows them after plugging in. They store
    what is written, and nothing moves: later/2, meanwhile/2 and obeying/2 make a
    thread play the kernel's part.
  - simulator
    The simulator within the process, on its virtual clock.
  - mount
    The simulator's files through FUSE, in real time.

In the last two the motors move by themselves, and what is written is refused
where the kernel refuses it. What can be seen in some trees only says so by
only/2 as its condition; how many tests that leaves out is told at the end.
*/

:- meta_predicate
    with_tree(0),
    with_tree(+, 0),
    later(+, 0),
    meanwhile(0, 0),
    obeying(+, 0),
    eventually(0),
    warnings(0, -).

:- dynamic
    tree_kind/1,                        % Kind
    root/1,                             % Directory
    devices/1,                          % Devices
    plugged/2,                          % Port, Directory
    typed/2,                            % Port, Type
    numbered/2,                         % Class, Number of the next device
    warned/1.                           % Term of a message

:- (   getenv('EV3DEV_TEST_TREE', Kind)
   ->  must_be(oneof([plain, simulator, mount]), Kind)
   ;   Kind = plain
   ),
   assertz(tree_kind(Kind)).

%!  only(+Trees, +Why)
%
%   True if this run is about one of these Trees. Why is told where it is not.

only(Trees, _Why) :-
    tree_kind(Kind),
    is_among(Trees, Kind),
    !.

is_among(Kind, Kind).
is_among(files, plain).
is_among(files, mount).
is_among(behaving, simulator).
is_among(behaving, mount).

:- tally(only).

%!  with_tree(:Goal)
%!  with_tree(+Devices, :Goal)
%
%   Call Goal with a fresh tree as the tree in use; it may leave choice points.
%   Devices is a list of Port-Type, by default the paper's robot with all its
%   sensors.

with_tree(Goal) :-
    with_tree([ in1-'lego-ev3-us',
                in2-'lego-ev3-color',
                in3-'lego-ev3-color',
                in4-'lego-ev3-gyro',
                outA-'lego-ev3-m-motor',
                outB-'lego-ev3-l-motor',
                outC-'lego-ev3-l-motor',
                outD-'lego-ev3-l-motor'
              ], Goal).

with_tree(Devices, Goal) :-
    setup_call_cleanup(
        make_tree(Devices),
        Goal,
        drop_tree).

make_tree(Devices) :-
    tree_kind(Kind),
    assertz(devices(Devices)),
    make_tree(Kind, Devices).

make_tree(plain, Devices) :-
    !,
    plain_start(Root),
    assertz(root(Root)),
    forall(member(Port-Type, Devices), plug(Port, Type)),
    ev3_sysfs(Root).
make_tree(Kind, Devices) :-
    simulated_start(Kind, Devices, Root),
    assertz(root(Root)),
    % A brick finds what is plugged in while it starts in the order of ports.
    msort(Devices, Ordered),
    forall(member(Port-Type, Ordered), is_plugged(Port, Type, _)),
    forall(member(Port-Type, Ordered), is_known(Kind, Port, Type)).

drop_tree :-
    retract(root(Root)),
    retractall(devices(_)),
    retractall(plugged(_, _)),
    retractall(typed(_, _)),
    retractall(numbered(_, _)),
    tree_kind(Kind),
    (   Kind == plain
    ->  plain_stop(Root)
    ;   simulated_stop(Kind, Root)
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
    tree_kind(simulator),
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
    tree_kind(Kind),
    (   Kind == plain
    ->  is_plugged(Port, Type, Directory),
        plain_plug(Port, Type, Directory)
    ;   simulated_plug(Port, Type),
        is_plugged(Port, Type, _),
        is_known(Kind, Port, Type)
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

% A brick takes the NXT's motors for large ones, until it is told.
is_known(Kind, Port, 'lego-nxt-motor') :-
    !,
    told_type(Kind, Port, 'lego-nxt-motor'),
    is_plugged(Port, 'lego-nxt-motor', _).
is_known(_, _, _).

%!  unplug(+Port)
%
%   Pull the wire: the directory vanishes.

unplug(Port) :-
    retract(plugged(Port, Directory)),
    retract(typed(Port, _)),
    (   tree_kind(plain)
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
    tree_kind(Kind),
    (   Kind == plain
    ->  write_line_to(Path, Text)
    ;   is_writable(Attribute)
    ->  simulated_write(Kind, Path, Text)
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
    (   tree_kind(plain)
    ->  put_attribute(Port, Attribute, Text)
    ;   simulated_show(Port, Attribute, Text)
    ).

%!  get_attribute(+Port, +Attribute, -Text)
%
%   Text is an atom. What can only be written, as `command`, is what was
%   written last.

get_attribute(Port, Attribute, Text) :-
    attribute_path(Port, Attribute, Path),
    tree_kind(Kind),
    (   Kind == plain
    ->  read_line_of(Path, Text)
    ;   Attribute == command
    ->  relative(Path, File),
        last_written(File, Text)
    ;   simulated_read(Kind, Path, Text)
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
    (   tree_kind(plain)
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
    tree_kind(Kind),
    (   Kind == simulator
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
    tree_kind(simulator),
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

                /*******************************
                *           THREADS            *
                *******************************/

%!  later(+Seconds, :Goal)
%
%   Call Goal in another thread after some time by the tree's clock.

later(Seconds, Goal) :-
    (   tree_kind(simulator)
    ->  thread_self(Me),
        hold_clock,
        thread_create(later_by_clock(Me, Seconds, Goal), _, [detached(true)]),
        thread_get_message(is_up)
    ;   thread_create(( sleep(Seconds), Goal ), _, [detached(true)])
    ).

% From here on time passes only while both threads wait, so that Goal comes
% when it should however busy this machine is.
later_by_clock(Main, Seconds, Goal) :-
    hold_clock,
    thread_send_message(Main, is_up),
    call_cleanup(( simulated_pause(Seconds), Goal ), release_clock).

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
%   @error assertion_failed(eventually(Goal)) if it does not within 20 s

eventually(Goal) :-
    get_time(Now),
    Deadline is Now + 20,
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
    \+ tree_kind(plain),
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
%   Play a motor that runs as soon as it is told to, and does not get there.

runs(Port) :-
    (   tree_kind(plain)
    ->  put_attribute(Port, state, running)
    ;   true
    ).

%!  stops(+Port)
%
%   Another program stops the motor at Port.

stops(Port) :-
    put_attribute(Port, command, stop),
    (   tree_kind(plain)
    ->  put_attribute(Port, state, '')
    ;   true
    ).

%!  block(+Port)
%
%   Hold the motor at Port fast.

block(Port) :-
    (   tree_kind(plain)
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
                     assertz(tree:warned(Term))),
                Clause),
        ignore(Goal),
        erase(Clause)),
    findall(Term, retract(warned(Term)), Warnings).
