:- module(tree,
          [ with_tree/1,                % :Goal
            with_tree/2,                % +Devices, :Goal
            plug/2,                     % +Port, +Type
            unplug/1,                   % +Port
            attribute_path/3,           % +Port, +Attribute, -Path
            put_attribute/3,            % +Port, +Attribute, +Text
            get_attribute/3,            % +Port, +Attribute, -Text
            written/2,                  % +Port, -Attributes
            written/1,                  % -Attributes
            tree_root/1,                % -Directory
            later/2,                    % +Seconds, :Goal
            meanwhile/2,                % :Other, :Goal
            eventually/1,               % :Goal
            obey/1,                     % +Port
            warnings/2                  % :Goal, -Warnings
          ]).
:- asserta(user:file_search_path(library, prolog)).
:- use_module(library(ev3dev)).
:- use_module(library(filesex)).
:- use_module(library(readutil)).

/** <module> Plain directory trees shaped like ev3dev's

A tree holds files as the kernel shows them after plugging in, and stores what
is written. Nothing in it moves; later/2 and meanwhile/2 make a thread play the
kernel's part.
*/

:- meta_predicate
    with_tree(0),
    with_tree(+, 0),
    later(+, 0),
    meanwhile(0, 0),
    eventually(0),
    warnings(0, -).

:- dynamic
    root/1,                             % Directory
    plugged/2,                          % Port, Directory
    numbered/2,                         % Class, Number of the next device
    warned/1.                           % Term of a message

% In memory where one can, as it is a hundred files for each test.
:- initialization(
       (   getenv('TMPDIR', _)
       ->  true
       ;   catch(access_file('/dev/shm', write), _, fail)
       ->  set_prolog_flag(tmp_dir, '/dev/shm')
       ;   true
       )).

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
    tmp_file(ev3dev, Root),
    make_directory_path(Root),
    assertz(root(Root)),
    forall(member(Port-Type, Devices), plug(Port, Type)),
    ev3_sysfs(Root).

drop_tree :-
    retract(root(Root)),
    retractall(plugged(_, _)),
    retractall(numbered(_, _)),
    delete_directory_and_contents(Root).

%!  tree_root(-Directory)
%
%   Directory of the tree in use, as with_tree/1 made it.

tree_root(Directory) :-
    root(Directory).

%!  plug(+Port, +Type)
%
%   Plug a device in: a new directory with the next number of its class.

plug(Port, Type) :-
    once(class(Type, Class, Prefix)),
    root(Root),
    next_number(Class, Number),
    format(atom(Directory), "~w/~w/~w~w", [Root, Class, Prefix, Number]),
    make_directory_path(Directory),
    format(atom(Address), "ev3-ports:~w", [Port]),
    forall(attribute(Class, Type, Attribute, Text),
           write_text(Directory, Attribute, Text)),
    write_text(Directory, driver_name, Type),
    % Last: until it has an address it is no device.
    write_text(Directory, address, Address),
    assertz(plugged(Port, Directory)).

next_number(Class, Number) :-
    (   retract(numbered(Class, Number))
    ->  true
    ;   Number = 0
    ),
    Next is Number + 1,
    assertz(numbered(Class, Next)).

%!  unplug(+Port)
%
%   Pull the wire: the directory vanishes.

unplug(Port) :-
    retract(plugged(Port, Directory)),
    delete_directory_and_contents(Directory).

attribute_path(Port, Attribute, Path) :-
    plugged(Port, Directory),
    atomic_list_concat([Directory, Attribute], /, Path).

%!  put_attribute(+Port, +Attribute, +Text)
%
%   What the kernel shows from now on.

put_attribute(Port, Attribute, Text) :-
    plugged(Port, Directory),
    write_text(Directory, Attribute, Text).

%!  get_attribute(+Port, +Attribute, -Text)
%
%   Text is an atom: the first line, as a longer text may be cut only a moment
%   after the new one was written.

get_attribute(Port, Attribute, Text) :-
    attribute_path(Port, Attribute, Path),
    setup_call_cleanup(
        open(Path, read, Stream),
        read_line_to_string(Stream, Line),
        close(Stream)),
    (   Line == end_of_file
    ->  Text = ''
    ;   atom_string(Text, Line)
    ).

%!  written(+Port, -Attributes)
%
%   Attributes of a device that differ from what they are after plugging in,
%   as a list of Attribute=Text.

written(Port, Attributes) :-
    get_attribute(Port, driver_name, Type),
    once(class(Type, Class, _)),
    findall(Attribute=Text,
            ( attribute(Class, Type, Attribute, Text0),
              get_attribute(Port, Attribute, Text),
              \+ format(atom(Text), "~w", [Text0])
            ),
            Attributes).

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

% A text that is there already is cut afterwards, so that nobody who reads in
% between finds an empty file.
write_text(Directory, Attribute, Text) :-
    atomic_list_concat([Directory, Attribute], /, Path),
    setup_call_cleanup(
        open(Path, update, Stream),
        ( format(Stream, "~w~n", [Text]),
          flush_output(Stream),
          set_end_of_stream(Stream)
        ),
        close(Stream)).

                /*******************************
                *           THREADS            *
                *******************************/

%!  later(+Seconds, :Goal)
%
%   Call Goal in another thread after some time.

later(Seconds, Goal) :-
    thread_create(( sleep(Seconds), Goal ), _, [detached(true)]).

%!  meanwhile(:Other, :Goal)
%
%   Call Goal once while Other runs in another thread. Other is ended with
%   Goal. If Other fails or throws before that, so does this.

meanwhile(Other, Goal) :-
    setup_call_cleanup(
        thread_create(Other, Thread),
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
%   @error assertion_failed(eventually(Goal)) if it does not within 5 s

eventually(Goal) :-
    get_time(Now),
    Deadline is Now + 5,
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

%!  obey(+Port)
%
%   Play the motor at Port through one position move: wait for its command,
%   run, go half-way, be at the end and rest.

obey(Port) :-
    eventually(get_attribute(Port, command, 'run-to-rel-pos')),
    put_attribute(Port, state, running),
    get_number(Port, position, From),
    get_number(Port, position_sp, End),
    Half is (From + End) // 2,
    sleep(0.02),
    put_attribute(Port, position, Half),
    sleep(0.02),
    put_attribute(Port, position, End),
    put_attribute(Port, state, '').

get_number(Port, Attribute, Number) :-
    get_attribute(Port, Attribute, Text),
    atom_number(Text, Number).

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

                /*******************************
                *           DEVICES            *
                *******************************/

class(Type, 'tacho-motor', motor) :-
    motor(Type, _).
class(Type, 'lego-sensor', sensor) :-
    sensor(Type, _, _, _).

motor('lego-ev3-l-motor', 1050).
motor('lego-ev3-m-motor', 1560).
motor('lego-nxt-motor',   1020).

sensor('lego-ev3-color', 'COL-REFLECT COL-AMBIENT COL-COLOR REF-RAW RGB-RAW COL-CAL', 0, 42).
sensor('lego-ev3-us',    'US-DIST-CM US-DIST-IN US-LISTEN US-SI-CM US-SI-IN',         1, 843).
sensor('lego-ev3-gyro',  'GYRO-ANG GYRO-RATE GYRO-FAS GYRO-G&A GYRO-CAL',             0, 0).
sensor('lego-ev3-touch', 'TOUCH',                                                     0, 0).
sensor('lego-ev3-ir',    'IR-PROX IR-SEEK IR-REMOTE IR-REM-A IR-S-ALT IR-CAL',        0, 35).
sensor('lego-nxt-temp',  'NXT-TEMP-C NXT-TEMP-F',                                     1, 215).
sensor(Type, Modes, Decimals, 0) :-
    ev3dev_sensor_info:sensor_type(Type, _),
    \+ sub_atom(Type, 0, _, _, 'lego-ev3'),
    Type \== 'lego-nxt-temp',
    findall(Mode, sensor_mode(Type, Mode, _, _, _, _), Names),
    atomic_list_concat(Names, ' ', Modes),
    once(sensor_mode(Type, _, _, Decimals, _, _)).

attribute('tacho-motor', Type, max_speed, Speed) :-
    motor(Type, Speed).
attribute('tacho-motor', _, Attribute, Text) :-
    motor_attribute_text(Attribute, Text).
attribute('lego-sensor', Type, Attribute, Text) :-
    sensor(Type, Modes, Decimals, Value),
    sensor_attribute_text(Attribute, Modes, Decimals, Value, Text).

motor_attribute_text(command, '').
motor_attribute_text(commands,
    'run-forever run-to-abs-pos run-to-rel-pos run-timed run-direct stop reset').
motor_attribute_text(count_per_rot, 360).
motor_attribute_text(duty_cycle, 0).
motor_attribute_text(duty_cycle_sp, 0).
motor_attribute_text(polarity, normal).
motor_attribute_text(position, 0).
motor_attribute_text(position_sp, 0).
motor_attribute_text(ramp_down_sp, 0).
motor_attribute_text(ramp_up_sp, 0).
motor_attribute_text(speed, 0).
motor_attribute_text(speed_sp, 0).
motor_attribute_text(state, '').
motor_attribute_text(stop_action, coast).
motor_attribute_text(stop_actions, 'coast brake hold').
motor_attribute_text(time_sp, 0).

sensor_attribute_text(command, _, _, _, '').
sensor_attribute_text(commands, _, _, _, '').
sensor_attribute_text(decimals, _, Decimals, _, Decimals).
sensor_attribute_text(mode, Modes, _, _, Mode) :-
    atomic_list_concat([Mode|_], ' ', Modes).
sensor_attribute_text(modes, Modes, _, _, Modes).
sensor_attribute_text(num_values, _, _, _, 1).
sensor_attribute_text(units, _, _, _, '').
sensor_attribute_text(value0, _, _, Value, Value).
sensor_attribute_text(Attribute, _, _, _, 0) :-
    member(Attribute, [ value1, value2, value3, value4, value5, value6,
                        value7 ]).
