:- module(ev3dev_scripts, []).

/** <module> Programs as scripts, in old versions, too

A program that starts by `:- initialization(main, main).` calls main/0 when
it is loaded, and then ends: with status 1 if main/0 failed or 2 if it threw.
Versions before 7.5.8, such as the brick's 7.2.3, refuse that directive; here
they learn it. As in later versions, nothing is called if the program is
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

%   By `swipl -c`: the state calls main/0 when it starts.

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
