:- module(ev3dev_library_file,
          [ load_library/0,
            library_file/1,             % -File
            check_natives/1             % +Module
          ]).
:- use_module('../basics/small_lists').

:- dynamic loaded/0.
:- volatile loaded/0.

/** <module> Chooses the foreign library for this machine

`make` puts the library into the place where SWI-Prolog expects it,
`lib/<arch>/ev3dev.so`. A binary pack has a library for each kind of machine
below `native`. The Prolog flag `arch` does not distinguish these: two of
Debian's SWI-Prologs report `armv7l-linux`, one for the EV3 (`armel`, which
passes floats in integer registers) and one for the Raspberry Pi (`armhf`,
which passes floats in registers of a floating point unit). Before version 8,
Debian's reported `armel` and `armhf`. So this module compares the ELF header
of the running program with that of each library.

A saved state (`swipl -c`) does not repeat the directives of a module. So each
action that every process needs is a goal of `initialization(Goal, now)`,
which Prolog also calls when a state starts. A state looks for the foreign
library in the directory of the pack at the time when the state was made.
*/

%!  load_library is det.
%
%   Load the pack's foreign library for this machine, unless it is loaded. It
%   has the native predicates of all modules. Does not use library(shlib),
%   because loading that takes longer than the rest of this file.
%
%   @error existence_error(foreign_library, ev3dev) like library_file/1

load_library :-
    with_mutex(ev3dev_library_file, load_once).

load_once :-
    loaded,
    !.
load_once :-
    installer(Install),
    current_prolog_flag(access_level, Level),
    setup_call_cleanup(
        set_prolog_flag(access_level, system),  % no tracer shows them
        Install,
        set_prolog_flag(access_level, Level)),
    assertz(loaded).

%   In a page the loader has it already, beside Prolog.
installer(system:ev3dev_install) :-
    predicate_property(system:ev3dev_install, foreign),
    !.
installer(call_shared_object_function(Library, install)) :-
    library_file(File),
    open_shared_object(File, Library).

%!  library_file(-File) is det.
%
%   File is the pack's foreign library for this machine: the built library,
%   `lib/<arch>/ev3dev.so`, if it suits the running program, else the first
%   library below `native` that suits it. If the program's header cannot be
%   read (no `/proc`), File is the built library.
%
%   @error existence_error(foreign_library, ev3dev) if no library suits. The
%   message names the wanted kind and the existing files.

library_file(File) :-
    pack_folder(Pack),
    (   suitable_file(Pack, File0)
    ->  File = File0
    ;   no_suitable_file(Pack)
    ).

pack_folder(Pack) :-
    module_property(ev3dev_library_file, file(File)),
    parent(5, File, Pack).

parent(0, Path, Path) :-
    !.
parent(N, Path0, Path) :-
    N1 is N-1,
    file_directory_name(Path0, Path1),
    parent(N1, Path1, Path).

suitable_file(Pack, File) :-
    program_kind(Kind),
    !,
    (   built_file(Pack, File)
    ;   shipped_file(Pack, File)
    ),
    file_kind(File, Kind),
    !.
suitable_file(Pack, File) :-
    built_file(Pack, File).

built_file(Pack, File) :-
    current_prolog_flag(arch, Arch),
    atomic_list_concat([Pack, '/lib/', Arch], Folder),
    folder_file(Folder, File).

shipped_file(Pack, File) :-
    atom_concat(Pack, '/native', Native),
    exists_directory(Native),
    directory_files(Native, Names),
    one_of(Names, Name),
    atomic_list_concat([Native, /, Name], Folder),
    folder_file(Folder, File).

folder_file(Folder, File) :-
    current_prolog_flag(shared_object_extension, Extension),
    atomic_list_concat([Folder, '/ev3dev.', Extension], File),
    exists_file(File).

%!  file_kind(+File, -Kind) is semidet.
%
%   True if File is an ELF file for machines of this Kind, a term
%   elf(Class, Order, Machine, Float): 1 or 2 for 32 or 64 bit, 1 or 2 for
%   the little or big end first, the machine's number, and for ARM `hard` if
%   floats are passed in floating point registers; else `soft`.

file_kind(File, elf(Class, Order, Machine, Float)) :-
    setup_call_cleanup(
        open(File, read, In, [type(binary)]),
        first_bytes(52, In, Bytes),
        close(In)),
    Bytes = [0x7f,0x45,0x4c,0x46,Class,Order|_],
    half_word(Order, 18, Bytes, Machine),
    (   Machine =:= 40,
        half_word(Order, 36, Bytes, Flags),
        Flags /\ 0x400 =\= 0
    ->  Float = hard
    ;   Float = soft
    ).

program_kind(Kind) :-
    catch(file_kind('/proc/self/exe', Kind), error(_, _), fail).

first_bytes(0, _, []) :-
    !.
first_bytes(N, In, [Byte|Bytes]) :-
    get_byte(In, Byte),
    N1 is N-1,
    first_bytes(N1, In, Bytes).

%   The low half of the word at Offset of a 32 bit header, or a half word.

half_word(Order, Offset, Bytes, Value) :-
    low_bytes(Order, Offset, Low, High),
    Header =.. [header|Bytes],
    arg(Low, Header, L),
    arg(High, Header, H),
    Value is H<<8 \/ L.

low_bytes(1, Offset, Low, High) :-
    Low is Offset+1,
    High is Offset+2.
low_bytes(2, Offset, Low, High) :-
    High is Offset+1,
    Low is Offset+2.

no_suitable_file(Pack) :-
    current_prolog_flag(arch, Arch),
    (   program_kind(Kind)
    ->  kind_text(Kind, Text)
    ;   Text = 'of unknown kind'
    ),
    findall(File,
            ( built_file(Pack, File) ; shipped_file(Pack, File) ),
            Files),
    (   Files == []
    ->  Found = 'none'
    ;   atomic_list_concat(Files, ', ', Found)
    ),
    format(atom(Message),
           '~w has no native library for this machine (~w, ~w); there is ~w',
           [Pack, Arch, Text, Found]),
    throw(error(existence_error(foreign_library, ev3dev),
                context(ev3dev_library_file:library_file/1, Message))).

kind_text(elf(Class, _, Machine, Float), Text) :-
    Bits is 32*Class,
    (   machine_text(Machine, Float, Name)
    ->  true
    ;   Name = machine(Machine)
    ),
    format(atom(Text), '~w, ~d bit', [Name, Bits]).

machine_text(3, _, 'x86').
machine_text(40, soft, 'ARM with soft floats').
machine_text(40, hard, 'ARM with hard floats').
machine_text(62, _, 'x86-64').
machine_text(183, _, 'AArch64').
machine_text(243, _, 'RISC-V').

%   Without a library nothing of the pack works: one message says so, and not
%   each file that needs it.

load_or_say :-
    catch(load_library, error(Formal, Context), true),
    (   var(Formal)
    ->  true
    ;   why(Formal, Context, Error),
        without_library(Error)
    ).

without_library(Error) :-
    module_property(ev3dev_library_file, file(This)),
    file_directory_name(This, Room),
    file_directory_name(Room, Private),
    atom_concat(Private, '/load/no_library', File),
    load_files(File, [if(not_loaded), imports([])]),
    ev3dev_no_library:without_library(Error).

%!  check_natives(+Module) is det.
%
%   Without one of the predicates that Module exports, the library is
%   older than the Prolog files: nothing of the pack works then, as without a
%   library. native.pl calls this when it is loaded.

check_natives(Module) :-
    loaded,
    predicate_property(Module:sim_active_, foreign),  % built with it
    module_property(Module, exports(Exports)),
    one_of(Exports, Name/Arity),
    functor(Head, Name, Arity),
    \+ predicate_property(Module:Head, foreign),
    !,
    pack_folder(Pack),
    format(atom(Text),
           'its native library is older than its Prolog files, and does not \c
            define ~q. Run "make" in ~w', [Name/Arity, Pack]),
    without_library(error(existence_error(foreign_library, ev3dev),
                          context(_, Text))).
check_natives(_).

%   A library that needs a newer C library does not suit this machine, either.

why(Formal, Context, error(existence_error(foreign_library, ev3dev),
                           context(_, Text))) :-
    (   Formal = shared_object(_, Text0)
    ->  true
    ;   Context = context(_, Text0),
        atom(Text0)
    ->  true
    ;   format(atom(Text0), '~p', [Formal])
    ),
    pack_folder(Pack),
    format(atom(Text),
           '~w. Install Rust from https://rustup.rs and run "make" in ~w, \c
            or install the binary pack, which "make dist" makes on a PC \c
            that has Rust (docs/brick.md)', [Text0, Pack]).

% This directive stands last because it needs all predicates above.
:- initialization(load_or_say, now).
