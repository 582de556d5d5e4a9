:- module(ev3dev_view_source,
          [ program_file/1,             % -File
            program_directory/1         % -Directory
          ]).
:- use_module(library(lists), [last/2]).

/** <module> Where the program's text is
*/

%!  program_file(-File) is semidet.
%
%   The program was loaded from File last: not by another file, and neither
%   from this pack nor from Prolog's own libraries.

program_file(File) :-
    findall(File0,
            ( source_file(File0),
              is_programs(File0),
              \+ included(File0) ),
            Files),
    last(Files, File).

%!  is_programs(+File) is semidet.
%
%   File is no library.

is_programs(File) :-
    \+ ( library(Folder),
         sub_atom(File, 0, _, _, Folder) ).

library(Home) :-
    current_prolog_flag(home, Home).
library(Folder) :-
    module_property(ev3dev_view_source, file(Here)),
    sub_atom(Here, Before, _, 0, '/ev3dev/private/view/source.pl'),
    sub_atom(Here, 0, Before, _, Prolog),
    (   Folder = Prolog
    ;   file_directory_name(Prolog, Pack),
        atom_concat(Pack, '/app', Folder)
    ).

included(File) :-
    source_file_property(File, load_context(_, Parent:_, _)),
    is_programs(Parent).

%!  program_directory(-Directory) is det.
%
%   Where the program is; without a program, where Prolog works.

program_directory(Directory) :-
    (   program_file(File)
    ->  file_directory_name(File, Directory)
    ;   working_directory(Directory0, Directory0),
        (   atom_concat(Directory, /, Directory0),
            Directory \== ''
        ->  true
        ;   Directory = Directory0
        )
    ).
