:- use_module('../support/simulation').
:- use_module('../support/dev', [picture/1]).
:- use_module(library(ev3dev/console)).

%   What the console shows is what these lines look like.
looks_like(Lines) :-
    picture(Shown),
    screen_clear,
    forall(nth0(N, Lines, Line),
           ( Y is 2 + 10 * N, screen_text(2, Y, Line, [font(small)]) )),
    screen_show,
    picture(Drawn),
    Shown == Drawn.

:- begin_tests(console, [setup(screen_forget), cleanup(screen_forget)]).
test(texts_are_lines_one_below_the_other) :-
    with_sim(room, ( screen_forget, screen_print('Hello'), screen_print(f(1, 'B')),
                     screen_format("~1f cm", [84.26]),
                     looks_like(['Hello', 'f(1,B)', '84.3 cm']) )).
test(a_newline_starts_another_line) :-
    with_sim(room, ( screen_forget, screen_print('one\ntwo'), looks_like([one, two]) )).
test(a_long_text_takes_several_lines) :-
    with_sim(room, ( screen_forget,
                     screen_print(abcdefghijklmnopqrstuvwxyzABCDEF),
                     looks_like([abcdefghijklmnopqrstuvwxyzABC, 'DEF']) )).
test(the_oldest_lines_scroll_away) :-
    numlist(1, 15, Numbers),
    numlist(4, 15, Last),
    with_sim(room, ( screen_forget, forall(member(N, Numbers), screen_print(N)),
                     looks_like(Last) )).
test(what_was_forgotten_does_not_come_back) :-
    with_sim(room, ( screen_print(old), screen_forget, screen_print(new), looks_like([new]) )).
test(fails_without_a_screen, [setup(( ev3_dev(tests), ev3_sysfs(tests) )), fail]) :-
    screen_print(hello).
test(a_wrong_format_throws, error(_, context(screen_format/2, _))) :-
    with_sim(room, screen_format("~d", [a])).
test(an_unbound_format_throws, error(instantiation_error, context(screen_format/2, _))) :-
    with_sim(room, screen_format(_, [])).
:- end_tests(console).
