:- module(test_library_file, []).
:- asserta(user:file_search_path(library, prolog)).
:- use_module(library(ev3dev/private/native/library_file)).
:- use_module('../support/child', [swipl/1]).
:- use_module('../support/libraries', [public_library/1]).

/** <module> Tests: the library that suits, among some that do not

The packs here hold nothing but ELF headers.
*/

:- begin_tests(library_file, [cleanup(delete_packs)]).
test(finds_a_library_that_the_program_can_load) :-
    library_file(File),
    exists_file(File).
test(takes_what_make_built, Found == built) :-
    own_kind(Own),
    choice([built-Own, amd64-Own], Found).
test(passes_over_a_folder_of_the_right_name_and_the_wrong_kind,
     Found == brick) :-
    own_kind(Own),
    other_kind(Own, Other),
    choice([built-Other, aaa-Other, brick-Own], Found).
test(tells_armel_from_armhf) :-
    pack([armel-elf(1,1,40,soft), armhf-elf(1,1,40,hard)], Pack),
    forall(member(Name-Float, [armel-soft, armhf-hard]),
           ( native_file(Pack, Name, File),
             ev3dev_library_file:file_kind(File, elf(1,1,40,Float))
           )).
test(reads_headers_of_either_byte_order) :-
    pack([big-elf(2,2,22,soft)], Pack),
    native_file(Pack, big, File),
    ev3dev_library_file:file_kind(File, elf(2,2,22,soft)).
test(takes_no_text_for_a_library, Found == none) :-
    pack([], Pack),
    native_file(Pack, text, File),
    put_file(File, [0'h, 0'i]),
    found(Pack, Found).
test(throws_if_none_suits,
     error(existence_error(foreign_library, ev3dev))) :-
    own_kind(Own),
    other_kind(Own, Other),
    pack([other-Other], Pack),
    ev3dev_library_file:no_suitable_file(Pack).
test(names_what_there_is_if_none_suits) :-
    own_kind(Own),
    other_kind(Own, Other),
    pack([other-Other], Pack),
    native_file(Pack, other, File),
    catch(ev3dev_library_file:no_suitable_file(Pack),
          error(_, context(_, Message)), true),
    sub_atom(Message, _, _, _, File),
    !.
:- end_tests(library_file).

% As after a pack_install that found no Rust
:- begin_tests(no_library, [setup(make_copy), cleanup(delete_copy)]).
test(each_public_library_says_so_once,
     [ forall(public_library(Library)), true(Wrong == []) ]) :-
    load_goal(Library, Goal),
    run(Goal, Output),
    findall(Line, ( member(Line, Output), \+ says_so(Line) ), Wrong0),
    (   length(Output, Count), Count =< 2
    ->  Wrong = Wrong0
    ;   Wrong = Output
    ).
test(it_says_what_to_do, true(Missing == [])) :-
    load_goal(ev3dev, Goal),
    run(Goal, Output),
    atomic_list_concat(Output, Text),
    findall(Word,
            ( member(Word, ['https://rustup.rs', make, 'binary pack',
                            'docs/brick.md']),
              \+ sub_atom(Text, _, _, _, Word) ),
            Missing).
test(a_call_says_so_too, true(Output == ["go_cm/2", "pose/3"])) :-
    run("use_module(library(ev3dev)), use_module(library(ev3dev/drive)),
         forall(member(G, [go_cm(30, 20), pose(_, _, _)]),
                catch(G, error(existence_error(foreign_library, ev3dev), _),
                      ( functor(G, N, A), format('~q~n', [N/A]) )))", Output0),
    findall(Line, ( member(Line, Output0), \+ says_so(Line) ), Output).
test(an_error_that_nobody_catches_says_so_without_a_backtrace, true(Others == [])) :-
    run("use_module(library(ev3dev)), go(30)", Output),
    exclude(says_so, Output, Others).
% As after "git pull" without "make"
test(an_older_library_says_so_once, [ cleanup(make_new), true(Output == [true]) ]) :-
    make_old,
    run("use_module(library(ev3dev)), use_module(library(ev3dev/drive))", Lines),
    (   Lines = [_, Line],
        split_string(Line, " ", "", Words),
        subset(["older", "come_later_/3.", "\"make\""], Words)
    ->  Output = [true]
    ;   Output = Lines
    ).
test(the_app_ends, [condition(exists_file('app/ev3dev.pl')), true(Wrong == [])]) :-
    copy(Copy),
    atom_concat(Copy, '/app/ev3dev.pl', File),
    run([File, view], Output),
    findall(Line, ( member(Line, Output), \+ says_so(Line) ), Wrong).
% A hundred lines said that files could not be opened.
test(too_few_files_may_be_open, true(Wrong == [])) :-
    run('ulimit -n 9; exec "$0" "$@"', "use_module(library(ev3dev))", Output),
    Output = [_|_],
    findall(Line, ( member(Line, Output), \+ sub_string(Line, _, _, _, "ulimit -n 64") ), Wrong).
:- end_tests(no_library).

:- dynamic copy/1.

make_old :-
    copy(Copy),
    copy_folders([lib], Copy),
    atom_concat(Copy, '/prolog/ev3dev/private/native/native.pl', File),
    read_file_to_string(File, Text, []),
    sub_string(Text, Before, 1, After, "["),
    !,
    sub_string(Text, 0, Before, _, Head),
    sub_string(Text, _, After, 0, Exports),
    setup_call_cleanup(
        open(File, write, Out),
        format(Out, "~s[ come_later_/3,~s", [Head, Exports]),
        close(Out)).

make_new :-
    delete_copy,
    make_copy.

make_copy :-
    tmp_file(no_library, Copy),
    make_directory(Copy),
    copy_folders([prolog, app], Copy),
    assertz(copy(Copy)).

copy_folders(Folders, To) :-
    findall(file(Folder),
            ( member(Folder, Folders), exists_directory(Folder) ),
            Files),
    append([['-R'], Files, [file(To)]], Arguments),
    process_create(path(cp), Arguments, [process(Pid)]),
    process_wait(Pid, exit(0)).

delete_copy :-
    retract(copy(Copy)),
    delete_directory_and_contents(Copy).

load_goal(ev3dev, "use_module(library(ev3dev))") :-
    !.
load_goal(Library, Goal) :-
    format(string(Goal), "use_module(library(ev3dev/~w))", [Library]).

%   Two lines of one message; SWI-Prolog 7.2.3 has one of its own before

says_so(Line) :-
    member(Part, ["library_file.pl:", "cannot be used", "Prolog initialisation failed:"]),
    sub_string(Line, _, _, _, Part),
    !.

run(What, Lines) :-
    run('exec "$0" "$@"', What, Lines).

run(Shell, What, Lines) :-
    copy(Copy),
    swipl(Program),
    (   is_list(What)
    ->  Arguments = What
    ;   Arguments = ['-g', What, '-t', halt]
    ),
    atom_concat(Copy, '/prolog', Library),
    atom_concat('library=', Library, Path),
    process_create(path(sh), ['-c', Shell, Program, '-q', '-f', none, '-p', Path|Arguments],
                   [ process(Pid), stdin(null), stdout(pipe(Out)),
                     stderr(pipe(Error)) ]),
    read_string(Error, _, Errors),
    read_string(Out, _, Printed),
    close(Error),
    close(Out),
    process_wait(Pid, _),
    string_concat(Errors, Printed, Text),
    split_string(Text, "\n", " \t", Lines0),
    exclude(==(""), Lines0, Lines).

own_kind(Kind) :-
    ev3dev_library_file:program_kind(Kind),
    !.

other_kind(elf(Class, Order, _, _), elf(Class, Order, 8, soft)).

choice(Files, Found) :-
    pack(Files, Pack),
    found(Pack, Found).

found(Pack, Found) :-
    (   ev3dev_library_file:suitable_file(Pack, File)
    ->  file_directory_name(File, Folder),
        file_directory_name(Folder, Parent),
        (   file_base_name(Parent, lib)
        ->  Found = built
        ;   file_base_name(Folder, Found)
        )
    ;   Found = none
    ).

%   A pack of these files: `built` is that below lib, others are below native.

:- dynamic made/1.                      % Pack

pack(Files, Pack) :-
    tmp_file(pack, Pack),
    make_directory(Pack),
    assertz(made(Pack)),
    forall(member(Name-Kind, Files),
           ( library_of(Pack, Name, File),
             header(Kind, Bytes),
             put_file(File, Bytes)
           )).

delete_packs :-
    forall(retract(made(Pack)), delete_directory_and_contents(Pack)).

library_of(Pack, built, File) :-
    !,
    current_prolog_flag(arch, Arch),
    file_of([Pack, lib, Arch], File).
library_of(Pack, Name, File) :-
    native_file(Pack, Name, File).

native_file(Pack, Name, File) :-
    file_of([Pack, native, Name], File).

file_of(Parts, File) :-
    current_prolog_flag(shared_object_extension, Extension),
    atomic_list_concat(Parts, /, Folder),
    atomic_list_concat([Folder, '/ev3dev.', Extension], File).

put_file(File, Bytes) :-
    file_directory_name(File, Folder),
    make_directory_path(Folder),
    setup_call_cleanup(
        open(File, write, Out, [type(binary)]),
        forall(member(Byte, Bytes), put_byte(Out, Byte)),
        close(Out)).

header(elf(Class, Order, Machine, Float), Bytes) :-
    (   Float == hard
    ->  Flags = 4
    ;   Flags = 2
    ),
    half(Order, Machine, M),
    half(Order, Flags<<8, F),
    zeros(12, Z12),
    zeros(16, Z16),
    zeros(14, Z14),
    append([[0x7f,0x45,0x4c,0x46,Class,Order], Z12, M, Z16, F, Z14], Bytes).

half(1, Value, [Low,High]) :-
    Low is Value /\ 0xff,
    High is (Value>>8) /\ 0xff.
half(2, Value, [High,Low]) :-
    half(1, Value, [Low,High]).

zeros(N, Zeros) :-
    length(Zeros, N),
    maplist(=(0), Zeros).
