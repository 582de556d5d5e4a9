:- module(ev3dev_library_file, [load_library/0]).

%!  load_library is det.
%
%   Load the foreign library into the calling module.

load_library :-
    module_property(ev3dev_library_file, file(File)),
    file_directory_name(File, Here),
    current_prolog_flag(arch, Arch),
    atomic_list_concat([Here, '/../../lib/', Arch, '/ev3dev.so'], Library),
    load_foreign_library(Library).
