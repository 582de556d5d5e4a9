:- module(ev3dev_marking_explained,
          [ explained/5                 % +Exercise, +Files, +Seed,
                                        % +Enclosed, -Lines
          ]).
:- use_module(read, [exercise_setting/3, program_terms/2]).
:- use_module(record, [run_fact/1]).
:- use_module(run, [fenced_run/6]).
:- use_module(library(lists), [append/3, last/2, member/2]).

/** <module> Why a program does not earn all points

One more run of a program, in whose process
private/explain/watched_run.pl looks for the reason.
*/

%!  explained(+Exercise, +Files, +Seed, +Enclosed, -Lines) is semidet.
%
%   Run the program Files again with that Seed; fails if that run is lost.
%   Lines say where it ended and why; else which rules never had their turn,
%   and by how much the scores were missed.

explained(Exercise, Files, Seed, Enclosed, Lines) :-
    exercise_setting(Exercise, goal(Goal), start),
    exercise_setting(Exercise, seconds(Seconds), 60),
    Soon is Seconds-0.5,                % before its time is over
    Watched = ( use_module(library(ev3dev/private/explain/watched_run), []),
                ev3dev_watched_run:watched_run(Soon, Goal) ),
    catch(fenced_run(Exercise-'', Files, Watched, Seed, Enclosed,
                     ended(_, Output, File)),
          lost_run(_), fail),
    split_string(Output, "\n", "\r", All),
    findall(Line,
            ( member(Text, All),
              string_concat("ev3dev-why\t", Line0, Text),
              without_folder(Line0, File, Line1),
              ended_as(Line1, Seconds, Line) ),
            Lines0),
    (   Lines0 == []
    ->  findall(Text-Words, missed(Exercise, Text, Words), Missed),
        findall(Line,
                (   idle_rule(Files, Line)
                ;   append(Before, [Text-Words|_], Missed),
                    \+ memberchk(_-Words, Before),
                    format(string(Line), "~w: ~w", [Text, Words])
                ),
                Lines)
    ;   Lines = Lines0
    ).

%   The folder of that run means nothing to the student.

without_folder(Line0, File, Line) :-
    file_directory_name(File, Folder0),
    atom_concat(Folder0, /, Folder),
    atomic_list_concat(Parts, Folder, Line0),
    atomic_list_concat(Parts, Line).

ended_as(Line0, Seconds, Line) :-
    (   sub_string(Line0, _, _, _, "calls itself without end: "),
        \+ sub_string(Line0, _, _, _, "the stack")
    ->  format(string(Line), "It was still under way after ~w s: ~w",
               [Seconds, Line0])
    ;   Line = Line0
    ).

% ---------------- RULES

%   In the order of behave/1, a rule comes before it that was active last.

idle_rule([_-Text|_], Line) :-
    program_terms(Text, Terms),
    findall(Rule,
            ( member(term(Term, _), Terms),
              ( Term = ::(Rule, _) ; Term = (::(Rule, _) :- _) ),
              atom(Rule) ),
            Named),
    Named = [_|_],
    member(term(Term, _), Terms),
    listed(Term, Order),
    findall(Active,
            ( run_fact(told(_, Told)), member(Active, Named),
              told_rule(Told, Active) ),
            Actives),
    last(Actives, Ruling),
    append(_, [Ruling|Later], Order),
    findall(Rule, ( member(Rule, Later), \+ memberchk(Rule, Actives) ),
            [Idle|_]),
    !,
    format(string(Line),
           "Rule ~q never had its turn: ~q comes before it in behave, and \c
            always applies", [Idle, Ruling]).

told_rule(Told, Rule) :-
    atom_string(Rule, Name),
    string_concat("rule ", Name, Begin),
    string_concat(Begin, Rest, Told),
    \+ ( sub_string(Rest, 0, 1, _, Next), char_type(Next, csym) ).

listed(Term, Order) :-
    compound(Term),
    Term =.. [Name|Arguments],
    (   Name == behave,
        Arguments = [Order|_],
        is_list(Order)
    ->  true
    ;   member(Argument, Arguments),
        listed(Argument, Order)
    ).

% ---------------- SCORES

%   The first goal of a score that is not true of the run, in words: what was
%   measured before it, and what it asks for. Words are said once.

missed(exercise(Module, _, _, Scores), Text, Words) :-
    member(score(_, Text, Module:Head, Share), Scores),
    copy_term(Head-Share, Score-Part),
    clause(Module:Score, Body),
    failing(Body, Module, [], Known, Failed),
    (   Failed == none
    ->  number(Part),
        Part < 1,
        once(( member(Measure, Known), measured(Measure, Words) ))
    ;   wanted(Failed, Known, Words)
    ).

failing((Goal, Goals), Module, Known0, Known, Failed) :-
    !,
    failing(Goal, Module, Known0, Known1, Failed0),
    (   Failed0 == none
    ->  failing(Goals, Module, Known1, Known, Failed)
    ;   Known = Known1,
        Failed = Failed0
    ).
failing(ended(_), _, Known, Known, none) :-
    !.                                  % this run is ended early
failing(Goal, Module, Known0, Known, Failed) :-
    (   catch(Module:Goal, error(_, _), fail)
    ->  Failed = none,
        Known = [Goal|Known0]
    ;   predicate_property(Module:Goal, number_of_clauses(1)),
        \+ predicate_property(Module:Goal, imported_from(_)),
        clause(Module:Goal, Body)       % one of the exercise
    ->  failing(Body, Module, Known0, Known, Failed)
    ;   Failed = Goal,
        Known = Known0
    ).

wanted(time_to(Place, _), _, Words) :-
    !,
    format(string(Words), "it was never near ~w", [Place]).
wanted(time_to(Place, Radius, _), _, Words) :-
    !,
    format(string(Words), "it was never within ~w cm of ~w",
           [Radius, Place]).
wanted(thing_in(Name, _), _, Words) :-
    !,
    (   var(Name)
    ->  Words = "nothing lay there at the end"
    ;   format(string(Words), "~w did not lie there at the end", [Name])
    ).
wanted(Comparison, Known, Words) :-
    Comparison =.. [Operator, Value, Limit],
    needed(Operator, Needed),
    number(Limit),
    member(Measure, Known),
    Measure =.. [_|Arguments],
    last(Arguments, Last),
    Last == Value,
    measured(Measure, Measured),
    !,
    ( functor(Measure, lap_fraction, 2) -> Percent is round(100*Limit),
      format(string(Asked), "~d %", [Percent]) ; Asked = Limit ),
    format(string(Words), "~w; ~w ~w would count",
           [Measured, Needed, Asked]).
wanted(Comparison, _, Words) :-
    Comparison =.. [Operator, Value, Limit],
    needed(Operator, Needed),
    compound(Value),
    Number is Value,
    format(string(Words), "it was ~1f; ~w ~w would count",
           [Number, Needed, Limit]).

needed(>=, "at least").
needed(>, "more than").
needed(=<, "at most").
needed(<, "less than").

measured(cells_visited(Size, Count), Words) :-
    ( Count =:= 1 -> Squares = square ; Squares = squares ),
    format(string(Words), "it was in ~w ~w of ~w cm",
           [Count, Squares, Size]).
measured(path_length(Cm), Words) :-
    format(string(Words), "it drove ~0f cm", [Cm]).
measured(path_turns(Degrees), Words) :-
    format(string(Words), "it turned by ~0f degrees", [Degrees]).
measured(ended_near(Place, Cm), Words) :-
    format(string(Words), "it ended ~0f cm from ~w", [Cm, Place]).
measured(pushed(Name, Cm), Words) :-
    format(string(Words), "~w was pushed ~0f cm", [Name, Cm]).
measured(carried(Name, Cm), Words) :-
    format(string(Words), "~w was carried ~0f cm", [Name, Cm]).
measured(duration(Seconds), Words) :-
    format(string(Words), "it took ~1f s", [Seconds]).
measured(commands(Count), Words) :-
    format(string(Words), "it gave ~w commands to motors", [Count]).
measured(lap_fraction(_, Share), Words) :-
    Percent is 100*Share,
    format(string(Words), "it followed ~0f % of the line", [Percent]).
