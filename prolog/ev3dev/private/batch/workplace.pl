:- module(ev3dev_workplace,
          [ new_workplace/2,            % +Base, -Directory
            end_workplace/1             % +Directory
          ]).
:- use_module('../files/directory', [new_directory/2, write_file/2]).
:- use_module(library(filesex), [directory_file_path/3]).
:- use_module(library(lists), [append/3, member/2, nth0/3]).
:- use_module(library(process), [process_create/3, process_wait/2]).
:- use_module(library(readutil),
              [read_file_to_string/3, read_file_to_terms/3]).

/** <module> Directories that nobody else reads, and that do not stay

The programs of students cannot keep such a directory from being removed, by a
tree of any depth, by rights that are taken away, or by links to other places:
the system's rm removes it, which follows no links.
*/

:- dynamic place/1.
:- volatile place/1.

:- initialization(at_halt(ev3dev_workplace:end_all), now).

%!  new_workplace(+Base, -Directory) is det.
%
%   Make a directory for this process, as tmp_file/2 names it. What another
%   process left under that name when it was killed is removed.

new_workplace(Base, Directory) :-
    forall(left_behind(Base, Left), removed(Left)),
    new_directory(Base, Directory),
    assertz(place(Directory)),
    run([chmod, '700', file(Directory)]),   % chmod/2 is not in 7.2.3
    current_prolog_flag(pid, Pid),
    directory_file_path(Directory, owner, File),
    (   process_name(Pid, Name)
    ->  write_file(File, ev3dev_workplace:owned(Name))
    ;   true
    ).

owned(Name, Out) :-
    format(Out, '~q.~n', [Name]).

%!  end_workplace(+Directory) is det.
%
%   Remove it. If that is interrupted, it is removed when Prolog halts.

end_workplace(Directory) :-
    removed(Directory),
    retractall(place(Directory)).

end_all :-
    forall(retract(place(Directory)), removed(Directory)).

%   A process, by its number, when it began, and where that number holds.

process_name(Pid, process(Pid, Began, Space)) :-
    read_link('/proc/self/ns/pid', Space, _),
    atomic_list_concat(['/proc/', Pid, '/stat'], File),
    catch(read_file_to_string(File, Text, [encoding(octet)]),
          error(_, _), fail),
    split_string(Text, ")", "", Parts),
    append(_, [Last], Parts),
    split_string(Last, " ", "", Fields),
    nth0(20, Fields, Began).

left_behind(Base, Directory) :-
    Flag = tmp_dir,                         % 7.2.3 has no such flag
    current_prolog_flag(Flag, Folder),
    atomic_list_concat([swipl_, Base, '_'], Prefix),
    catch(directory_files(Folder, Names), error(_, _), fail),
    member(Name, Names),
    sub_atom(Name, 0, _, _, Prefix),
    directory_file_path(Folder, Name, Directory),
    \+ place(Directory),
    directory_file_path(Directory, owner, File),
    catch(read_file_to_terms(File, [Owner], []), error(_, _), fail),
    Owner = process(Pid, _, Space),
    read_link('/proc/self/ns/pid', Space, _),
    \+ process_name(Pid, Owner).

removed(Directory) :-
    Script = 'rm -rf -- "$1" || { chmod -R u+rwX -- "$1"; rm -rf -- "$1"; }',
    catch(run([sh, '-c', Script, sh, file(Directory)]), error(_, _), true),
    (   exists_directory(Directory)
    ->  print_message(warning, ev3dev(not_removed(Directory)))
    ;   true
    ).

run([Program|Arguments]) :-
    process_create(path(Program), Arguments,
                   [ stdin(null), stdout(null), stderr(null),
                     process(Pid) ]),
    process_wait(Pid, _).

:- multifile prolog:message//1.

prolog:message(ev3dev(not_removed(Directory))) -->
    [ 'The directory ~w could not be removed.'-[Directory] ].
