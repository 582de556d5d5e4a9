% help/1 and apropos/1 answer for every predicate of every public library in a
% session that has loaded library(ev3dev) and nothing else.

:- asserta(user:file_search_path(library, prolog)).
:- use_module(library(ev3dev)).

:- dynamic costs_a_session/1.

:- findall(Module,
           ( member(Module, [ev3dev_help_index, ev3dev_help_words,
                             ev3dev_libraries]),
             module_property(Module, file(_)) ),
           Loaded),
   assertz(costs_a_session(Loaded)).

:- use_module(library(ev3dev/private/help/help_index), []).
:- use_module(library(ev3dev/private/help/help_words), [words_for/2]).
:- use_module(library(ev3dev/private/help/libraries), [in_library/2]).
:- use_module('../support/child').
:- use_module('../support/libraries').

%   Prolog as Debian and others package it may come without it. Versions before
%   8.2 have another one, which calls a hook if its manual is installed.

has_help :-
    current_prolog_flag(version, Version),
    Version >= 80200,
    exists_source(library(help)).

:- begin_tests(help).
test(costs_nothing_before_it_is_asked, true(Loaded == [])) :-
    costs_a_session(Loaded).
test(answers_for_each_export, true(Without == [])) :-
    findall(PI,
            ( some_export(PI),
              \+ ( help_text(PI, Text),
                   shows(Text, PI),
                   public_export(Name, PI),
                   library_name(Name, Library),
                   from(Text, Library) ) ),
            Without).
test(answers_for_a_name_alone, true(Shown == true)) :-
    help_text(led, Text),
    (   shows(Text, led/1), shows(Text, led/2)
    ->  Shown = true
    ;   Shown = Text
    ).
test(answers_for_what_is_not_loaded) :-
    help_text(view, _),
    forall(member(Module, [ev3dev_drive, ev3dev_view]),
           \+ module_property(Module, file(_))),
    help_text(arc_cm/3, Text),
    sub_string(Text, 0, _, _, "library(ev3dev/drive), which is not loaded: "),
    shows(Text, arc_cm/3).
test(says_what_is_loaded) :-
    help_text(go_cm/2, Text),
    sub_string(Text, 0, _, _, "library(ev3dev)\n").
test(shows_a_comment_of_two_predicates_once, true(Count == 1)) :-
    help_text(set_robot, Text),
    findall(Before, sub_string(Text, Before, _, _, "Describe the robot"),
            Befores),
    length(Befores, Count).
test(takes_a_library_as_apropos_prints_it) :-
    help_text(ev3dev/drive:go_cm/3, Text),
    from(Text, 'ev3dev/drive').
test(shows_what_a_library_takes_from_a_private_file) :-
    help_text(grid_map/2, Text),
    from(Text, 'ev3dev/grid').
test(shows_only_that_of_a_library) :-
    help_text('ev3dev/drive':go_cm, Text),
    shows(Text, go_cm/3),
    \+ shows(Text, go_cm/2).
test(has_no_answer_for_others, fail) :-
    help_text(no_such_thing, _).
test(has_no_answer_for_no_name, fail) :-
    help_text(_, _).

test(apropos_finds_each_export, true(Without == [])) :-
    findall(Name/Arity,
            ( some_export(Name/Arity),
              \+ ( found(Name, Found),
                   public_export(File, Name/Arity),
                   library_name(File, Library),
                   member(Line, Found),
                   lists(Line, Library:Name/Arity) ) ),
            Without).
test(a_call_says_which_library_to_load, true(Without == [])) :-
    findall(PI,
            ( some_export(PI),
              \+ public_export(ev3dev, PI),
              \+ ( hint(PI, Text),
                   public_export(Library, PI),
                   atomic_list_concat(['library(ev3dev/', Library,
                                       '), which is not loaded'], Words),
                   sub_string(Text, _, _, _, Words) ) ),
            Without).
test(that_is_the_library_which_a_program_loads,
     [ forall(home(PI, Library)), true(Libraries == [Library]) ]) :-
    findall(Found,
            ( in_library(Found, PIs), memberchk(PI, PIs) ),
            Libraries).
test(apropos_knows_words_of_a_student,
     [forall(first_for(Word, Expected)), true(First == Expected)]) :-
    found(Word, [Line|_]),
    sub_atom(Line, Before, _, _, ' '),
    !,
    sub_atom(Line, 0, Before, _, First).
test(apropos_needs_all_words, true(Lines \== [])) :-
    found('gyro angle', Lines),
    forall(member(Line, Lines), sub_atom(Line, _, _, _, gyro)).
test(apropos_knows_forms_of_a_word, true(Plural == Singular)) :-
    found(color, Singular),
    atom_concat(colo, urs, British),
    found(British, Plural).
test(apropos_takes_a_type) :-
    found(predicate:gyro, [_|_]),
    \+ found(section:gyro, _).
test(apropos_finds_nothing, fail) :-
    found(no_such_thing, _).
test(apropos_finds_nothing_in_no_words, fail) :-
    found('', _).
test(words_are_those_of_predicates, true(Unknown == [])) :-
    findall(Name,
            ( words_for(_, Names),
              member(Name, Names),
              \+ public_export(_, Name/_) ),
            Unknown).

test(is_asked_by_help,
     [condition(has_help), true(Status-Text == exit(0)-Expected)]) :-
    help_text(until/2, Expected),
    run_program(":- use_module(library(ev3dev)).\n",
                [goal('help(until/2)')], Status, Output),
    format(string(Text), "~s", [Output]).
test(is_asked_by_help_that_was_loaded_before,
     [condition(has_help), true(Status == exit(0))]) :-
    run_program(":- use_module(library(help)).\n\c
                 :- use_module(library(ev3dev)).\n",
                [goal('help(until/2),apropos(forward)')], Status, Output),
    once(sub_string(Output, _, _, _, "library(ev3dev/events)")),
    once(sub_string(Output, _, _, _, "ev3dev:go_cm/2")),
    \+ sub_string(Output, _, _, _, "No matches").
test(leaves_others_to_prolog, [condition(has_help)]) :-
    run_program(":- use_module(library(ev3dev)).\n",
                [goal('apropos(no_such_thing)')], _, Output),
    once(sub_string(Output, _, _, _, "No matches for no_such_thing")).
test(is_asked_by_the_hook_of_older_versions,
     [condition(is_old), true(Text == Expected)]) :-
    help_text(led/1, Expected),
    with_output_to(string(Text), prolog:help_hook(help(led/1))).

is_old :-
    current_prolog_flag(version, Version),
    Version < 80200.

some_export(PI) :-
    setof(Library, public_export(Library, PI), _).

library_name(ev3dev, ev3dev) :-
    !.
library_name(Name, Library) :-
    atom_concat('ev3dev/', Name, Library).

%   Several libraries have these, or a part of a library has.

home(until/2, events).
home(golog/2, golog).
home(random_room/3, random_worlds).
home(sim_place/3, sim).
home(sim_wait/1, sim).
home(pose/3, drive).
home(calibrate/3, drive).
home(navigate_to/2, roadmap).
home(grid_map/2, grid).
home(plan/3, planners).
home(nxt_sound/1, plnxt).

hint(PI, Text) :-
    Error = error(existence_error(procedure, PI), _),
    '$messages':translate_message(Error, Lines, []),
    with_output_to(string(Text),
                   print_message_lines(current_output, '', Lines)).

help_text(What, Text) :-
    with_output_to(string(Text), ev3dev_help_index:asked(help(What))).

from(Text, Library) :-
    format(string(Line), "library(~w)", [Library]),
    once(sub_string(Text, _, _, _, Line)).

%   The head as the comment gives it, which may take several lines.

shows(Text, Name/Arity) :-
    split_string(Text, "\n", " ", Lines),
    append(_, [Line|More], Lines),
    sub_string(Line, 0, _, _, Name),
    atomic_list_concat([Line|More], ' ', Rest),
    member(End, [' is ', '.']),
    once(sub_atom(Rest, Before, _, _, End)),
    sub_atom(Rest, 0, Before, _, Head0),
    % modes other than + and - are no operators
    split_string(Head0, "?:@", "", Parts),
    atomics_to_string(Parts, Head),
    catch(term_string(Term, Head), _, fail),
    functor(Term, Name, Arity),
    !.

%   found(+Query, -Lines): what apropos/1 prints

found(Query, Lines) :-
    nb_setval(test_help, []),
    setup_call_cleanup(
        asserta((user:message_hook(ev3dev(matches(_)), _, Printed) :-
                     nb_setval(test_help, Printed)), Hook),
        ev3dev_help_index:asked(apropos(Query)),
        erase(Hook)),
    nb_getval(test_help, Parts),
    findall(Line,
            ( member(Format-Arguments, Parts),
              format(atom(Line), Format, Arguments) ),
            Lines).

lists(Line, Library:Name/Arity) :-
    atomic_list_concat([Library, :, Name, /], Start),
    atom_concat(Start, Rest, Line),
    sub_atom(Rest, Before, _, _, ' '),
    !,
    sub_atom(Rest, 0, Before, _, ArityList),
    atomic_list_concat(Arities, ',', ArityList),
    atom_number(Text, Arity),
    memberchk(Text, Arities).

first_for(forward, 'ev3dev:go_cm/2').
first_for(backwards, 'ev3dev:go_cm/2').
first_for(straight, 'ev3dev:go_cm/2').
first_for(drive, 'ev3dev:go_cm/2').
first_for(rotate, 'ev3dev:turn/1').
first_for(turn, 'ev3dev:turn/1').
first_for(curve, 'ev3dev/drive:arc_cm/3,4').
first_for(stop, 'ev3dev:stop/0').
first_for(distance, 'ev3dev:us_dist_cm/2').
first_for(touch, 'ev3dev:touch/2').
first_for(bumper, 'ev3dev:touch/2').
first_for(color, 'ev3dev:col_color/2').
first_for(light, 'ev3dev:led/1').
first_for(brightness, 'ev3dev:col_reflect/2').
first_for(line, 'ev3dev:col_reflect/2').
first_for(sound, 'ev3dev:tone/2,3').
first_for(speak, 'ev3dev:say/1,2').
first_for(angle, 'ev3dev:gyro_ang/2').
first_for(wait, 'ev3dev:wait/1').
first_for(timer, 'ev3dev:stopwatch/1').
first_for(speed, 'ev3dev:speed/2').
first_for(position, 'ev3dev:position/2').
first_for(where, 'ev3dev/drive:pose/3').
first_for(maze, 'ev3dev/grid:plan_and_go_to/2,3').
first_for(display, 'ev3dev/console:screen_print/1').
first_for(simulator, 'ev3dev/sim:sim_start/1,2').
first_for(rules, 'ev3dev/rules:behave/1,2').
first_for(controller, 'ev3dev/layers:control/1').
first_for(event, 'ev3dev/events:event/2').
first_for(battery, 'ev3dev:battery/2').
:- end_tests(help).

% Loads more of the pack than the tests before may see.
:- begin_tests(help_of_facts, [setup(use_module(library(ev3dev/private/marking/read), []))]).
test(knows_the_facts_of_an_exercise,
     [ forall(ev3dev_marking_read:exercise_fact(Name, Arity)) ]) :-
    with_output_to(string(Text), ev3dev_help_index:asked(help(Name/Arity))),
    sub_string(Text, 0, _, _, "library(ev3dev/exercise), in a file of your own\n").
:- end_tests(help_of_facts).
