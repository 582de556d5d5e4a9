:- module(dev,
          [ on_dev/2,                   % +Tree, :Goal
            with_dev/2,                 % +Files, :Goal
            dev_path/2,                 % +Name, -Path
            press/2,                    % +Tree, +Key
            release/2,                  % +Tree, +Key
            events_of/2,                % +Events, -Bytes
            put_bytes_of/3,             % +Mode, +File, +Bytes
            bytes_of/2,                 % +File, -Bytes
            picture/1,                  % -Bytes
            heard/2                     % +Tree, -Tones
          ]).
:- use_module(trees).
:- use_module(library(filesex)).
:- use_module(library(process)).

/** <module> Device files: keys, speaker and screen

Over the three trees: plain files, the simulator on its virtual clock, and the
simulator's files through FUSE.
*/

:- meta_predicate
    on_dev(+, 0),
    with_dev(+, 0),
    back_to(+, 0).

:- dynamic dev/1.                       % Directory

%!  on_dev(+Tree, :Goal)
%
%   Call Goal once with the devices of a brick in Tree.

on_dev(plain, Goal) :-
    with_dev([ 'input/by-path/platform-gpio_keys-event'-[],
               'input/by-path/platform-sound-event'-[],
               fb0-zero(91136)
             ], Goal).
on_dev(simulator, Goal) :-
    on(simulator, Goal).
on_dev(mount, Goal) :-
    with_directory(Classes,
        with_directory(Dev,
            setup_call_cleanup(
                ( sim_start(room, [clock(realtime)]),
                  sim_mount(Classes, Dev),
                  ev3_sysfs(Classes),
                  ev3_dev(Dev) ),
                once(Goal),
                ( unmounted,
                  sim_stop )))).

%!  with_dev(+Files, :Goal)
%
%   Call Goal once with these files, each Name-Bytes, as the only devices.
%   Bytes may be zero(Count), and `fifo` makes a named pipe.

with_dev(Files, Goal) :-
    ev3_dev(Before),
    tmp_file(dev, Dev),
    setup_call_cleanup(
        ( make_directory_path(Dev),
          assertz(dev(Dev)),
          forall(member(Name-Bytes, Files), make_file(Name, Bytes))
        ),
        with_tree(plain, [], back_to(Before, ( ev3_dev(Dev), once(Goal) ))),
        ( retract(dev(Dev)),
          delete_directory_and_contents(Dev)
        )).

back_to(Dev, Goal) :-
    setup_call_cleanup(true, Goal, ev3_dev(Dev)).

make_file(Name, Bytes) :-
    dev_path(Name, Path),
    file_directory_name(Path, Directory),
    make_directory_path(Directory),
    make_file_of(Bytes, Path).

make_file_of(fifo, Path) :-
    !,
    process_create(path(mkfifo), [file(Path)], []).
make_file_of(zero(Count), Path) :-
    !,
    length(Bytes, Count),
    maplist(=(0), Bytes),
    put_bytes_of(write, Path, Bytes).
make_file_of(Bytes, Path) :-
    put_bytes_of(write, Path, Bytes).

%!  dev_path(+Name, -Path)
%
%   The path of a device in the plain directory.

dev_path(Name, Path) :-
    once(dev(Dev)),
    atomic_list_concat([Dev, Name], /, Path).

%!  press(+Tree, +Key)
%!  release(+Tree, +Key)
%
%   Do something to a key, at once.

press(plain, Key) :-
    !,
    append_event(Key, 1).
press(_, Key) :-
    sim_press(Key).

release(plain, Key) :-
    !,
    append_event(Key, 0).
release(_, Key) :-
    sim_release(Key).

append_event(Key, Value) :-
    code(Key, Code),
    events_of([event(1, Code, Value), event(0, 0, 0)], Bytes),
    dev_path('input/by-path/platform-gpio_keys-event', File),
    put_bytes_of(append, File, Bytes).

code(up, 103).
code(down, 108).
code(left, 105).
code(right, 106).
code(enter, 28).
code(back, 14).

%!  events_of(+Events, -Bytes)
%
%   The bytes of struct input_event on this machine for each of the Events,
%   event(Type, Code, Value). Their time is 0.

events_of(Events, Bytes) :-
    current_prolog_flag(address_bits, Bits),
    TimeBytes is 2 * Bits // 8,
    length(Time, TimeBytes),
    maplist(=(0), Time),
    maplist(event_bytes(Time), Events, Records),
    append(Records, Bytes).

event_bytes(Time, event(Type, Code, Value), Bytes) :-
    little_endian(2, Type, B1),
    little_endian(2, Code, B2),
    little_endian(4, Value, B3),
    append([Time, B1, B2, B3], Bytes).

little_endian(0, _, []) :-
    !.
little_endian(Count, Number, [Byte|Bytes]) :-
    Byte is Number /\ 255,
    High is Number >> 8,
    Fewer is Count - 1,
    little_endian(Fewer, High, Bytes).

put_bytes_of(Mode, File, Bytes) :-
    setup_call_cleanup(
        open(File, Mode, Stream, [type(binary)]),
        maplist(put_byte(Stream), Bytes),
        close(Stream)).

bytes_of(File, Bytes) :-
    setup_call_cleanup(
        open(File, read, Stream, [type(binary)]),
        bytes(Stream, Bytes),
        close(Stream)).

%!  picture(-Bytes)
%
%   What the screen shows, as a file of PNG.

picture(Bytes) :-
    tmp_file(picture, File),
    setup_call_cleanup(screen_png(File), bytes_of(File, Bytes), delete_file(File)).

bytes(Stream, Bytes) :-
    get_byte(Stream, Byte),
    (   Byte == -1
    ->  Bytes = []
    ;   Bytes = [Byte|Rest],
        bytes(Stream, Rest)
    ).

%!  heard(+Tree, -Tones)
%
%   The frequencies that the tone generator was set to, 0 for silence.

heard(plain, Tones) :-
    !,
    dev_path('input/by-path/platform-sound-event', File),
    bytes_of(File, Bytes),
    tones_in(Bytes, Tones).
heard(_, Tones) :-
    sim_trace(Trace),
    findall(Tone, member(_-tone(Tone), Trace), Tones).

tones_in([], []).
tones_in([B|Bs], [Tone|Tones]) :-
    current_prolog_flag(address_bits, Bits),
    TimeBytes is 2 * Bits // 8,
    length(Time, TimeBytes),
    append(Time, [0x12, 0, 2, 0, V0, V1, V2, V3|Rest], [B|Bs]),
    !,
    Tone is V0 + (V1 << 8) + (V2 << 16) + (V3 << 24),
    tones_in(Rest, Tones).
