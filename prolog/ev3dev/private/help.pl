:- module(ev3dev_help, []).

/** <module> apropos/1 finds the pack's predicates

help/1 finds the comments of loaded libraries. apropos/1 reads only the index
of the manual. Prolog loads that index at the first call of help/1 or
apropos/1; then this module adds the pack's predicates (see `help_index.pl`).
So loading the pack costs no more than this file.

In versions before 9, help/1 finds only the manual. Versions before 8.2, such
as the brick's 7.2.3, have another apropos/1.
*/

:- if((current_prolog_flag(version, Version), Version >= 80200)).

:- multifile user:prolog_load_file/2.
:- dynamic user:prolog_load_file/2.

user:prolog_load_file(Module:File, Options) :-
    ev3dev_help:is_index(File),
    ev3dev_help:is_first_load,
    load_files(Module:File, Options),
    ev3dev_help:extend_index.

is_index(pldoc(man_index)).
is_index(library(pldoc/man_index)).
is_index(File) :-
    atom(File),
    sub_atom(File, _, _, _, 'pldoc/man_index').

:- dynamic started/0.

%   Loading the index calls the hook again.

is_first_load :-
    \+ started,
    assertz(started).

extend_index :-
    module_property(ev3dev_help, file(This)),
    file_directory_name(This, Directory),
    atom_concat(Directory, '/help_index', File),
    use_module(File, []).

:- if(current_module(prolog_manual_index)).
:- initialization(extend_index).
:- endif.

:- endif.
