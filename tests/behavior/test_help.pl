% help/1 and apropos/1 answer for every exported predicate in a session that
% has loaded library(ev3dev) and nothing else.

:- asserta(user:file_search_path(library, prolog)).
:- use_module(library(ev3dev)).
:- use_module(library(lists)).
:- use_module(library(plunit)).

%   Prolog as Debian and others package it may come without these libraries.

can_help :-
    current_prolog_flag(version, Version),
    Version >= 80200,
    exists_source(library(help)),
    exists_source(library(pldoc)),
    exists_source(library(sgml)).

:- if(can_help).

:- set_prolog_flag(help_pager, false).

:- begin_tests(help, [setup(use_module(library(pldoc/man_index), []))]).

test(answers_for_each_export,
     [condition(helps_with_programs), true(Without == [])]) :-
    findall(PI,
            ( exported(PI),
              \+ ( help_text(PI, Text),
                   shows(Text, PI) ) ),
            Without).
test(answers_for_a_name_alone,
     [condition(helps_with_programs), true(Shown == true)]) :-
    help_text(led, Text),
    (   shows(Text, led/1), shows(Text, led/2)
    ->  Shown = true
    ;   Shown = Text
    ).
test(apropos_finds_each_export, true(Without == [])) :-
    findall(Where:PI-Summary,
            ( prolog_manual_index:man_object_property(Where:PI,
                                                      summary(Summary)),
              Summary \== '' ),
            Found),
    findall(PI,
            ( exported(PI), \+ memberchk(ev3dev:PI-_, Found) ),
            Without).
test(apropos_finds_what_is_not_loaded) :-
    \+ module_property(ev3dev_drive, file(_)),
    once(prolog_manual_index:man_object_property('ev3dev/drive':arc_cm/3,
                                                 summary(_))).
test(apropos_prints_them, true(Printed == true)) :-
    setup_call_cleanup(
        asserta((user:message_hook(help(apropos_matches(Matches, _)), _, _) :-
                     nb_setval(test_help, Matches)), Hook),
        apropos(gyro),
        erase(Hook)),
    nb_getval(test_help, Printed0),
    (   memberchk((ev3dev:gyro_ang/2)-_, Printed0)
    ->  Printed = true
    ;   Printed = Printed0
    ).

%   Before version 9, help/1 knows the manual alone.

helps_with_programs :-
    current_prolog_flag(version, Version),
    Version >= 90000.

exported(PI) :-
    module_property(ev3dev, exports(Exports)),
    member(PI, Exports).

help_text(What, Text) :-
    with_output_to(string(Text), help(What)).

%   The head as the comment gives it, which may take several lines.

shows(Text, Name/Arity) :-
    split_string(Text, "\n", " \u00A0", Lines),
    append(_, [Line|More], Lines),
    sub_string(Line, 0, _, _, Name),
    atomic_list_concat([Line|More], ' ', Rest),
    once(sub_atom(Rest, Before, _, _, ' is ')),
    sub_atom(Rest, 0, Before, _, Head0),
    % modes other than + and - are no operators
    split_string(Head0, "?:@", "", Parts),
    atomics_to_string(Parts, Head),
    catch(term_string(Term, Head), _, fail),
    functor(Term, Name, Arity),
    !.

:- end_tests(help).

:- else.

:- begin_tests(help).

test(is_installed, [blocked('library(help), pldoc or sgml is not installed')]) :-
    true.

:- end_tests(help).

:- endif.
