:- module(ev3dev_directory,
          [ file_path/2,                % +File, -Path
            readable_file/3,            % +File, +Extension, -Path
            directory_path/2,           % +Directory, -Path
            environment_directory/2,    % +Variable, -Directory
            new_directory/2,            % +Base, -Directory
            write_file/2                % +File, :Closure
          ]).
:- use_module('../checks/checks', [must_be/2]).
:- use_module('../errors/errors',
              [existence_error/2, in_own_name/1, throw_error/3]).
:- use_module('../native/native', [stale_mount_/1]).

:- meta_predicate write_file(+, 1).

/** <module> Directories that a program or its environment names
*/

%!  file_path(+File, -Path) is det.
%
%   Path is the absolute name of File, as absolute_file_name/2 has it.

file_path(File, Path) :-
    must_be(ground, File),
    in_own_name(absolute_file_name(File, Path)).

%!  readable_file(+File, +Extension, -Path) is semidet.
%
%   Path is the absolute name of a file that exists and can be read: File,
%   with the Extension or without.

readable_file(File, Extension, Path) :-
    Options = [extensions([Extension, '']), access(read), file_errors(fail)],
    in_own_name(absolute_file_name(File, Path, Options)),
    exists_file(Path).

%!  write_file(+File, :Closure) is det.
%
%   Write a text to File: call(Closure, Stream) writes it.
%
%   @error as open/4

write_file(File, Closure) :-
    must_be(text, File),
    in_own_name(open(File, write, Stream, [encoding(utf8)])),
    setup_call_cleanup(
        true,
        call(Closure, Stream),
        close(Stream)).

%!  directory_path(+Directory, -Path) is det.
%
%   True if Path is the absolute name of a Directory that exists. Directory is
%   relative to the working directory, also while a file is being loaded:
%   absolute_file_name/3 alone would then look beside that file first.
%
%   @error existence_error(directory, Directory)

directory_path(Directory, Path) :-
    must_be(ground, Directory),
    working_directory(Here, Here),
    (   \+ memberchk(Directory, ['', ""]),
        in_own_name(absolute_file_name(Directory, Path0,
                                       [ file_type(directory),
                                         file_errors(fail),
                                         relative_to(Here)
                                       ]))
    ->  Path = Path0
    ;   no_directory(Directory)
    ).

no_directory(Directory) :-
    stale_mount_(Directory),
    !,
    format(atom(Text),
           'a program that has ended left its files mounted there: \c
            "fusermount -u ~w" unmounts them', [Directory]),
    throw_error(existence_error(directory, Directory), _, Text).
no_directory(Directory) :-
    existence_error(directory, Directory).

%!  environment_directory(+Variable, -Directory) is semidet.
%
%   True if the environment variable Variable is set to Directory, and not to
%   the empty text.

environment_directory(Variable, Directory) :-
    getenv(Variable, Directory),
    Directory \== ''.

%!  new_directory(+Base, -Directory) is det.
%
%   Make a directory for what is not kept, as tmp_file/2 names it. One of that
%   name may be left of a process that was killed and had the same number.

new_directory(Base, Directory) :-
    tmp_file(Base, Named),
    catch(make_directory(Named), Error, true),
    (   var(Error)
    ->  Directory = Named
    ;   exists_directory(Named)
    ->  new_directory(Base, Directory)
    ;   throw(Error)
    ).
