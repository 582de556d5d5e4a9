:- module(ev3dev_directory,
          [ directory_path/2,           % +Directory, -Path
            environment_directory/2     % +Variable, -Directory
          ]).
:- use_module(library(error), [existence_error/2]).

/** <module> Directories that a program or its environment names

Where the trees of devices and of device files are.
*/

%!  directory_path(+Directory, -Path) is det.
%
%   True if Path is the absolute name of a Directory that exists. It is
%   relative to the working directory, also while a file is being loaded,
%   where absolute_file_name/3 would look beside that file first.
%
%   @error existence_error(directory, Directory)

directory_path(Directory, Path) :-
    working_directory(Here, Here),
    (   \+ memberchk(Directory, ['', ""]),
        absolute_file_name(Directory, Path0,
                           [ file_type(directory), file_errors(fail),
                             relative_to(Here)
                           ])
    ->  Path = Path0
    ;   existence_error(directory, Directory)
    ).

%!  environment_directory(+Variable, -Directory) is semidet.
%
%   True if Variable is set in the environment, and not to nothing.

environment_directory(Variable, Directory) :-
    getenv(Variable, Directory),
    Directory \== ''.
