:- module(ev3dev_library_file,
          [ library_file/1              % -File
          ]).
:- use_module(library(lists), [member/2, nth0/3]).

/** <module> Which of the shipped foreign libraries is for this machine

A binary pack holds an `ev3dev.so` for each kind of machine, in folders below
`lib`. The Prolog flag `arch` names such a folder but need not tell the kinds
apart: of Debian's SWI-Prologs that answer `armv7l-linux`, one is for the EV3
(`armel`: floats are passed in integer registers) and another for the
Raspberry Pi (`armhf`: in those of a floating point unit). The ELF headers
do: that of the running program is compared with that of each library.

Use:

    :- library_file(File), use_foreign_library(File).
*/

%!  library_file(-File) is det.
%
%   File is the pack's foreign library for this machine: that of the folder
%   `lib/<arch>` if it suits the running program, else the first below `lib`
%   that does. Where the program cannot be looked at (no `/proc`), the folder
%   alone decides.
%
%   @error existence_error(foreign_library, ev3dev) if there is none. The
%   message tells what was looked for, and which files are there.

library_file(File) :-
    lib_folder(Lib),
    (   suitable_file(Lib, File0)
    ->  File = File0
    ;   no_suitable_file(Lib)
    ).

lib_folder(Lib) :-
    module_property(ev3dev_library_file, file(File)),
    file_directory_name(File, Folder),
    file_directory_name(Folder, Prolog),
    file_directory_name(Prolog, Pack),
    atom_concat(Pack, '/lib', Lib).

suitable_file(Lib, File) :-
    program_kind(Kind),
    !,
    shipped_file(Lib, File),
    file_kind(File, Kind),
    !.
suitable_file(Lib, File) :-
    current_prolog_flag(arch, Arch),
    folder_file(Lib, Arch, File).

%   The libraries below Lib, that of the flag's folder first.

shipped_file(Lib, File) :-
    current_prolog_flag(arch, Arch),
    (   Folder = Arch
    ;   exists_directory(Lib),
        directory_files(Lib, Folders),
        msort(Folders, Sorted),
        member(Folder, Sorted),
        Folder \== Arch
    ),
    folder_file(Lib, Folder, File).

folder_file(Lib, Folder, File) :-
    current_prolog_flag(shared_object_extension, Extension),
    atomic_list_concat([Lib, /, Folder, '/ev3dev.', Extension], File),
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
    nth0(Low, Bytes, L),
    nth0(High, Bytes, H),
    Value is H<<8 \/ L.

low_bytes(1, Offset, Offset, High) :-
    High is Offset+1.
low_bytes(2, Offset, Low, Offset) :-
    Low is Offset+1.

no_suitable_file(Lib) :-
    current_prolog_flag(arch, Arch),
    (   program_kind(Kind)
    ->  kind_text(Kind, Text)
    ;   Text = 'unknown'
    ),
    findall(File, shipped_file(Lib, File), Files),
    (   Files == []
    ->  Found = 'none: run "make", or install the binary pack'
    ;   atomic_list_concat(Files, ', ', Found)
    ),
    format(atom(Message),
           'no ev3dev library for this machine (~w, ~w); there is ~w',
           [Arch, Text, Found]),
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
