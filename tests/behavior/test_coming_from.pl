% docs/coming-from.md names what there is.

:- use_module('../support/simulation').
:- use_module(library(ev3dev)).
:- use_module(library(ev3dev/drive)).
:- use_module(library(ev3dev/grid)).
:- use_module(library(ev3dev/roadmap)).
:- use_module(library(ev3dev/rules)).
:- use_module(library(ev3dev/colors)).
:- use_module(library(ev3dev/console)).
:- use_module(library(ev3dev/raw)).
:- use_module(library(ev3dev/sim)).
:- use_module(library(readutil)).

% The terms in the second column of a table of two columns, below a heading.
said_here(Heading, Term) :-
    read_file_to_string('docs/coming-from.md', Text, []),
    split_string(Text, "\n", "", Lines),
    append(_, [Heading|Below], Lines),
    append(Section, Next, Below),
    ( Next == [] ; Next = [Line|_], sub_string(Line, 0, _, _, "## ") ),
    !,
    member(Row, Section),
    split_string(Row, "|", " ", ["", _, Cell, ""]),
    split_string(Cell, "`", "", Parts),
    nth0(Index, Parts, Code),
    Index mod 2 =:= 1,
    term_to_atom(Term, Code).

goal_of((A, B), Goal) :-
    !,
    ( goal_of(A, Goal) ; goal_of(B, Goal) ).
goal_of(Goal, Goal) :-
    compound(Goal),
    \+ is_list(Goal),
    functor(Goal, Name, _),
    \+ memberchk(Name, [library, rpm, rps]).

:- begin_tests(coming_from).

test(each_word_is_exported,
     [ forall(member(Heading, ["## python-ev3dev2", "## Pybricks", "## leJOS"])),
       true(Missing == []) ]) :-
    findall(Goal, ( said_here(Heading, Term), goal_of(Term, Goal) ), Goals),
    length(Goals, Count),
    Count > 15,
    findall(Goal,
            ( member(Goal, Goals), \+ predicate_property(user:Goal, visible) ),
            Missing).
test(each_word_runs_in_the_simulator,
     [ forall(member(Heading, ["## python-ev3dev2", "## Pybricks", "## leJOS"])),
       true(Errors == []) ]) :-
    findall(Goal-E,
            ( said_here(Heading, Term), goal_of(Term, Goal),
              predicate_property(user:Goal, visible),
              \+ lacks(Goal),
              with_sim(room,
                       ( set_robot(5.6, 10.6, outB, outC),
                         catch(( ignore(for_seconds(5, user:Goal)), fail ), E, true) )) ),
            Errors).

%   What the page leaves open, or the robot does not have.
lacks(go_to(_, _)).
lacks(navigate_to(_, _)).
lacks(behave(_)).
lacks(elapsed(_, _)).
lacks(play(_)).
lacks(screen_text(_, _, _)).
lacks(sensor_values(_, _, _)).
lacks(i2c_read(_, _, _, _)).
lacks(i2c_write(_, _, _)).

:- end_tests(coming_from).
