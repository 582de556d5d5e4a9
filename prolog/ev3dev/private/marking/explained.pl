:- module(ev3dev_marking_explained,
          [ watching/3,                 % +Seconds, +Goal, -Watched
            lacks/3,                    % +Exercise, +Files, -Lines
            own_world/3                 % +Files, +Goal, -Line
          ]).
:- use_module(read, [program_terms/2]).
:- use_module(record, [run_fact/1]).
:- use_module(library(lists), [append/3, last/2, member/2]).

/** <module> Why a program does not earn all points

In one more run of a program private/explain/watched_run.pl looks for the
reason. What it cannot see is found here.
*/

%!  watching(+Seconds, +Goal, -Watched) is det.
%
%   Watched is a goal that calls Goal, and says why it may not have done what
%   was asked, before the Seconds of a run are over.

watching(Seconds, Goal, Watched) :-
    Soon is Seconds-0.5,
    Library = ev3dev,                   % in the process of the program
    Watched = ( use_module(library(Library), []),
                use_module(library(ev3dev/private/explain/watched_run), []),
                ev3dev_watched_run:watched_run(Soon, Goal) ).

%!  lacks(+Exercise, +Files, -Lines) is det.
%
%   Of the run that is recorded: which rules never had their turn, and by how
%   much scores were missed.

lacks(Exercise, Files, Lines) :-
    findall(Text-Words, missed(Exercise, Text, Words), Missed),
    findall(Line,
            (   idle_rule(Files, Line)
            ;   append(Before, [Text-Words|_], Missed),
                \+ memberchk(_-Words, Before),
                format(atom(Line), '~w: ~w', [Text, Words])
            ),
            Lines).

% ---------------- A SIMULATION OF ITS OWN

%!  own_world(+Files, +Goal, -Line) is semidet.
%
%   The program Files starts a simulation of its own in what Goal or a
%   directive calls, and Line says so.

own_world(Files, Goal, Line) :-
    member(_-Text, Files),
    member(Word, ["sim_start", "with_sim"]),
    sub_string(Text, _, _, _, Word),    % as a rule there is none
    !,
    findall(Name-Term,
            ( member(Name-Its, Files),
              program_terms(Its, Terms),
              member(Term, Terms) ),
            All),
    functor(Goal, Start, _),
    reached([Start], All, Reached),
    member(Name-term(Term, At), Reached),
    named(Term, Predicate),
    starts_simulation(Predicate),
    !,
    format(atom(Line),
           '~w:~d: take ~q out: the exercise has its own world',
           [Name, At, Predicate]).

%   Directives, and clauses for all Names in what is reached.

reached(Names0, All, Reached) :-
    findall(Name-term(Term, Line),
            ( member(Name-term(Term, Line), All),
              ( head_name(Term, Head) -> memberchk(Head, Names0) ; true ) ),
            Reached0),
    findall(Name,
            ( member(_-term(Term, _), Reached0), named(Term, Name/_) ),
            More),
    append(Names0, More, Names1),
    sort(Names1, Names),
    (   Names == Names0
    ->  Reached = Reached0
    ;   reached(Names, All, Reached)
    ).

head_name(Term, Name) :-
    Term \= (:- _),
    Term \= ::(_, _),
    (   Term = (Head :- _)
    ->  true
    ;   Term = (Head --> _)
    ->  true
    ;   Head = Term
    ),
    callable(Head),
    functor(Head, Name, _).

named(Term, Name/Arity) :-
    callable(Term),
    functor(Term, Name0, Arity0),
    (   Name = Name0,
        Arity = Arity0
    ;   compound(Term),
        arg(_, Term, Part),
        named(Part, Name/Arity)
    ).

starts_simulation(sim_start/1).
starts_simulation(sim_start/2).
starts_simulation(with_sim/2).
starts_simulation(with_sim/3).

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
measured(ended_at(_, Heading), Words) :-
    format(string(Words), "it looked to ~0f degrees at the end", [Heading]).
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
