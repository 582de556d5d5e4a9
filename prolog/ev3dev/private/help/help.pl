:- module(ev3dev_help, []).

/** <module> help/1 and apropos/1 know the pack

Prolog loads library(help) at the first call of help/1 or apropos/1. Then
`help_index.pl` is loaded, too, and puts the pack's answers before those of
Prolog. So loading the pack costs no more than this file.

Versions before 8.2, such as the brick's 7.2.3, call a hook if their manual is
installed. Where Prolog comes without library(help), `unknown_procedures.pl`
makes both predicates known to the prompt.
*/

:- if((current_prolog_flag(version, Version), Version >= 80200)).

:- multifile user:prolog_load_file/2.
:- dynamic user:prolog_load_file/2.

user:prolog_load_file(Module:File, Options) :-
    ev3dev_help:is_library_help(File),
    ev3dev_help:index(load_help, [Module:File, Options]).

is_library_help(File) :-
    (   atom(File)
    ->  sub_atom(File, _, _, 0, '/library/help')
    ;   File == library(help)
    ).

:- initialization((   current_module(prolog_help)
                  ->  index(answer_first, [])
                  ;   true
                  )).

:- else.

:- multifile prolog:help_hook/1.

prolog:help_hook(Question) :-
    ev3dev_help:index(asked, [Question]).

:- endif.

%   Call a predicate of `help_index.pl`.

index(Name, Arguments) :-
    module_property(ev3dev_help, file(This)),
    file_directory_name(This, Room),
    atom_concat(Room, '/help_index', File),
    use_module(File, []),
    Goal =.. [Name|Arguments],
    ev3dev_help_index:Goal.
