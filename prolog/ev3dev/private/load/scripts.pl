:- module(ev3dev_scripts, []).

/** <module> initialization(main, main) for old versions of Prolog

A program with `:- initialization(main, main).` calls main/0 after loading,
and then ends: with status 1 if main/0 failed or 2 if it threw. Versions
before 7.5.8, such as the brick's 7.2.3, refuse that directive; this module
adds it. As in later versions, Prolog does not call main/0 if the program is
loaded into a session, or with a toplevel of its own (`swipl -t`).
*/

:- if((current_prolog_flag(version, Version), Version < 70508)).

:- multifile user:term_expansion/2.
:- dynamic user:term_expansion/2.

user:term_expansion((:- initialization(Main, When)),
                    (:- initialization(Start))) :-
    When == main,
    Start = ev3dev_scripts:script(Module:Main),
    prolog_load_context(module, Module).

script(Main) :-
    (   is_program
    ->  run(Main)
    ;   true
    ).

is_program :-
    \+ current_prolog_flag(break_level, _),
    '$cmd_option_val'(toplevel, prolog),
    \+ is_compiled.

%   True while `swipl -c` compiles: the state calls main/0 when it starts.

is_compiled :-
    prolog_current_frame(Frame),
    prolog_frame_attribute(Frame, parent_goal, system:'$compile_wic').

run(Main) :-
    (   catch(Main, E, true)
    ->  (   var(E)
        ->  halt(0)
        ;   print_message(error, E),
            halt(2)
        )
    ;   print_message(error, format("~q failed", [Main])),
        halt(1)
    ).

:- endif.
