:- module(ev3dev_view_goals,
          [ goal_line/4,                % +Word, +Rest, +Page, -Refused
            goals_end/1                 % +Page
          ]).
:- use_module(library(lists), [member/2]).
:- use_module('../native', [view_say_/2]).
:- use_module(log, [error_text/2]).
:- use_module(program, [program_state/1]).

/** <module> Goals that are typed into a page

Only with the option `goals(true)`, and only at localhost. A goal runs in a
thread of its own, as a part of the program.
*/

:- dynamic running/3.                   % Page, Number, Thread

%!  goal_line(+Word, +Rest, +Page, -Refused) is semidet.
%
%   Start a goal, ask for its next answer, or end it. Fails if that is no
%   line; Refused is bound to a text if it is not the time for it.

goal_line(goal, Rest, Page, Refused) :-
    sub_string(Rest, Before, 1, After, " "),
    !,
    sub_string(Rest, 0, Before, _, Number0),
    sub_string(Rest, _, After, 0, Text),
    number_of(Number0, Number),
    (   running(Page, _, Thread),
        catch(thread_property(Thread, status(running)), _, fail)
    ->  Refused = "Another goal is not finished."
    ;   program_state(State),
        State \== idle
    ->  Refused = "A program runs."
    ;   retractall(running(Page, _, _)),
        thread_create(ev3dev_view_goals:solve(Text, Number, Page), Thread,
                      [detached(true)]),
        assertz(running(Page, Number, Thread)),
        thread_send_message(Thread, ev3dev_view_goal(begin))
    ).
goal_line(Word, Rest, Page, _) :-
    memberchk(Word, [more, enough]),
    number_of(Rest, Number),
    (   running(Page, Number, Thread)
    ->  catch(thread_send_message(Thread, ev3dev_view_goal(Word)), _, true)
    ;   true
    ).

number_of(Text, Number) :-
    string_length(Text, Length),
    between(1, 9, Length),
    string_codes(Text, Codes),
    \+ ( member(Code, Codes),
         \+ between(0'0, 0'9, Code) ),
    number_codes(Number, Codes).

%!  goals_end(+Page) is det.
%
%   End the goals of this page.

goals_end(Page) :-
    forall(running(Page, _, Thread),
           catch(thread_signal(Thread, abort), _, true)),
    retractall(running(Page, _, _)).

solve(Text, Number, Page) :-
    thread_get_message(ev3dev_view_goal(begin)),
    catch(solve_(Text, Number, Page), Error, true),
    (   var(Error)
    ->  true
    ;   Error = error(syntax_error(What), _)
    ->  format(string(Why), "Syntax error: ~w", [What]),
        answer(Page, Number, error, Why)
    ;   Error = error(_, _)
    ->  error_text(Error, Why),
        answer(Page, Number, error, Why)
    ;   format(string(Why), "~p", [Error]),
        answer(Page, Number, stopped, Why)
    ).

solve_(Text, Number, Page) :-
    term_string_with_names(Text, Goal, Names),
    (   solution(Goal, Last),
        bindings_text(Names, Answer),
        (   Last == true
        ->  answer(Page, Number, last, Answer)
        ;   answer(Page, Number, more, Answer),
            thread_get_message(ev3dev_view_goal(Word)),
            Word == enough
        )
    ->  true
    ;   answer(Page, Number, false, "false")
    ).

solution(Goal, Last) :-
    call_cleanup(user:Goal, Deterministic = true),
    (   Deterministic == true
    ->  Last = true
    ;   Last = false
    ).

term_string_with_names(Text, Goal, Names) :-
    split_string(Text, "", " \t\r\n.", [Bare]),
    string_concat(Bare, " .", Ended),
    setup_call_cleanup(
        open_string(Ended, In),
        read_term(In, Goal, [variable_names(Names), module(user)]),
        close(In)),
    (   Goal == end_of_file
    ->  throw(error(syntax_error(end_of_file), _))
    ;   true
    ).

bindings_text(Names, Text) :-
    findall(Line,
            ( member(Name=Value, Names),
              \+ sub_atom(Name, 0, _, _, '_'),
              nonvar(Value),
              format(string(Line), "~w = ~W",
                     [ Name, Value,
                       [ quoted(true), portray(true), max_depth(30),
                         spacing(next_argument) ] ])
            ),
            Lines),
    (   Lines == []
    ->  Text = "true"
    ;   atomic_list_concat(Lines, ',\n', Text0),
        atom_string(Text0, Text)
    ).

%   After all but `more` the page may send another goal at once.
answer(Page, Number, State, Text) :-
    (   State == more
    ->  true
    ;   thread_self(Me),
        retractall(running(_, _, Me))
    ),
    atom_string(State, Word),
    view_say_(Page, json([type=answer, n=Number, state=Word, text=Text])).
