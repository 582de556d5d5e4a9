:- module(rule_laws,
          [ broken_law/3                % +Case, +Run, -Wrong
          ]).
:- use_module(library(apply)).
:- use_module(library(lists)).

/** <module> The promises of behave/1, checked by the journal

An oracle for the runs of rule_sets.pl. It knows what the sensors showed when,
and what the journal says, and nothing of how behave/1 works. It says what is
broken of the six points of library(ev3dev/rules).

The rules are looked at every 20 ms, and a look takes time. So nobody knows
the moment of a look. A condition that changes is in doubt for a while: `late`
seconds. What is wrong is what no moment of a look can explain.
*/

%   Seconds after which a change has been seen, and what an exact time may be
%   off by.
late(0.06).
exact(0.005).

% ---------------- SENSORS

%   Spans are span(From, To, State), in which the sensors show the same.

spans(Effects, Spans) :-
    changes(Effects, [], Changes),
    joined(Changes, Spans).

changes([], _, []).
changes([Time-Port-Value|Effects], State0, [Time-State|Changes]) :-
    (   selectchk(Port-_, State0, State1)
    ->  State = [Port-Value|State1]
    ;   State = [Port-Value|State0]
    ),
    changes(Effects, State, Changes).

joined([], []).
joined([Time-State], [span(Time, 1.0e9, State)]) :-
    !.
joined([Time1-State, Time2-Next|Changes], Spans) :-
    (   Time2 =< Time1
    ->  Spans = Spans1
    ;   Spans = [span(Time1, Time2, State)|Spans1]
    ),
    joined([Time2-Next|Changes], Spans1).

%   The first solution of a guard when the sensors show State.

true_in(true, _).
true_in((A, B), State) :-
    true_in(A, State),
    true_in(B, State).
true_in((A ; B), State) :-
    (   true_in(A, State)
    ;   true_in(B, State)
    ).
true_in(\+ A, State) :-
    \+ true_in(A, State).
true_in(X < Y, _) :- X < Y.
true_in(X > Y, _) :- X > Y.
true_in(wait(_), _).
true_in(us_dist_cm(Port, Value), State) :- memberchk(Port-Value, State).
true_in(col_ambient(Port, Value), State) :- memberchk(Port-Value, State).
true_in(touch(Port, Value), State) :- memberchk(Port-Value0, State), Value = Value0.

%   Truths are truth(From, To, Holds): yes(Guard) with its values, or no.

truths(Spans, Guard, Truths) :-
    maplist(truth(Guard), Spans, Truths).

truth(Guard, span(From, To, State), truth(From, To, Holds)) :-
    (   copy_term(Guard, Copy),
        true_in(Copy, State)
    ->  Holds = yes(Copy)
    ;   Holds = no
    ).

%   In all of the time from A to B, or in some of it; also just before and
%   after that.

always(Truths, A, B) :-
    \+ ( meets(Truths, A, B, no) ).

sometimes(Truths, A, B) :-
    meets(Truths, A, B, yes(_)),
    !.

meets(Truths, A, B, Holds) :-
    exact(Off),
    member(truth(From, To, Holds), Truths),
    From < B + Off,
    To > A - Off.

% ---------------- JOURNAL

%   entry(Time, Path, Act): Path are the rules that it was done for, each
%   Name-Guard, the outermost first. Act is mark(Code, Number), run(Ports),
%   move(Ports), course(Ports), end(Ports) of a course, or stop(Ports).

entries([], []).
entries([command(Time, What, Command, Causes)|Commands], Entries) :-
    (   act_of(What, Command, Act)
    ->  findall(Name-Guard, member(rule(Name, Guard), Causes), Path0),
        reverse(Path0, Path),
        Entries = [entry(Time, Path, Act)|Entries1]
    ;   Entries = Entries1
    ),
    entries(Commands, Entries1).

act_of(left, led(levels(Red, Green)), mark(Code, Number)) :-
    Code is Red mod 20,
    Number is Red // 20 * 100 + Green.
act_of(robot(Left, Right), Command, Act) :-
    (   Command = ended(_)
    ->  Act = end([Left, Right])
    ;   Command = course(legs(_, _), _)
    ->  Act = move([Left, Right])
    ;   Command = course(_, _)
    ->  Act = course([Left, Right])
    ).
act_of(Port, tacho_motor(Word, _), Act) :-
    (   memberchk(Word, ['run-forever', 'run-direct'])
    ->  Act = run([Port])
    ;   memberchk(Word, [stop, reset])
    ->  Act = stop([Port])
    ;   Act = move([Port])
    ).

%   What runs after some entries: Port-run, Port-move or Port-course.

running(Entries, Running) :-
    foldl(runs, Entries, [], Running).

runs(entry(_, _, Act), Running0, Running) :-
    (   Act = mark(_, _)
    ->  Running = Running0
    ;   Act =.. [Kind, Ports],
        foldl(runs_as(Kind), Ports, Running0, Running)
    ).

runs_as(Kind, Port, Running0, Running) :-
    (   Kind == end,
        \+ memberchk(Port-course, Running0),
        \+ memberchk(Port-move, Running0)
    ->  Running = Running0
    ;   (   selectchk(Port-_, Running0, Running1)
        ->  true
        ;   Running1 = Running0
        ),
        (   memberchk(Kind, [stop, end])
        ->  Running = Running1
        ;   Running = [Port-Kind|Running1]
        )
    ).

%   Items are, in their order, call(Name, Guard, Part, From, To, End, Within),
%   with End one of exit, fail, left or none, and idle(Entry), which was done
%   for no rule of this level. An entry that is neither is stray(Entry).

items([], []).
items([Entry|Entries], Items) :-
    Entry = entry(Time, Path, Act),
    (   Act = end(_)                    % of a course that went on by itself
    ->  items(Entries, Items)
    ;   Path == []
    ->  Items = [idle(Entry)|Items1],
        items(Entries, Items1)
    ;   Path = [Name-Guard],
        Act = mark(Code, Number),
        begins(Code, Part)
    ->  until_end(Entries, Number, Name, Within, To, End, Rest, Time),
        Items = [call(Name, Guard, Part, Time, To, End, Within)|Items1],
        items(Rest, Items1)
    ;   Items = [stray(Entry)|Items1],
        items(Entries, Items1)
    ).

begins(1, 0).
begins(Code, Part) :-
    Code > 10,
    Part is Code - 10.

until_end([], _, _, [], To, none, [], To).
until_end([Entry|Entries], Number, Name, Within, To, End, Rest, Last) :-
    Entry = entry(Time, _, Act),
    (   Act = mark(Code, Number),
        nth1(Code, [_, exit, fail, left], End0)
    ->  Within = [],
        To = Time,
        End = End0,
        Rest = Entries
    ;   Within = [Entry|Within1],
        until_end(Entries, Number, Name, Within1, To, End, Rest, Last)
    ).

%   What was done within a call for its rule, and what for a rule of that.
inner_entry(entry(Time, Path0, Act), entry(Time, Path, Act)) :-
    (   Path0 = [_|Path]
    ->  true
    ;   Path = []
    ).

%   The parts of a list are one call. Then Part is a list of From-To; it is []
%   if the action is not a list. If the last part was left when its time was
%   over, End is `either`: left or exit.

merged([], _, []).
merged([Item|Items0], Rules, [Merged|Items]) :-
    (   Item = call(Name, Guard, 1, From, _, _, _)
    ->  parts([Item|Items0], Name, 1, Parts, Within, End0, Rest),
        last(Parts, LastFrom-To),
        (   End0 == left,
            memberchk(rule(Name, _, _, seq(Bodies)), Rules),
            length(Bodies, Count),
            length(Parts, Count),
            last(Bodies, _:Seconds),
            late(Late),
            abs(To - LastFrom - Seconds) < Late
        ->  End = either
        ;   End = End0
        ),
        Merged = call(Name, Guard, Parts, From, To, End, Within)
    ;   Item = call(Name, Guard, 0, From, To, End, Within)
    ->  Merged = call(Name, Guard, [], From, To, End, Within),
        Rest = Items0
    ;   Merged = Item,
        Rest = Items0
    ),
    merged(Rest, Rules, Items).

parts([call(Name, _, Part, From, To, End0, Within0)|Items], Name, Part,
      [From-To|Parts], Within, End, Rest) :-
    !,
    Next is Part + 1,
    parts_after(Items, Name, Next, Parts, Within1, End0, End, Rest),
    append(Within0, Within1, Within).

parts_after([stray(Entry)|Items], Name, Next, Parts, [Entry|Within], End0, End, Rest) :-
    Entry = entry(_, [Name-_], _),
    !,
    parts_after(Items, Name, Next, Parts, Within, End0, End, Rest).
parts_after(Items, Name, Next, Parts, Within, End0, End, Rest) :-
    (   Items = [call(Name, _, Next, _, _, _, _)|_]
    ->  parts(Items, Name, Next, Parts, Within, End, Rest)
    ;   Parts = [],
        Within = [],
        End = End0,
        Rest = Items
    ).

% ---------------- LEVELS

%!  broken_law(+Case, +Run, -Wrong) is nondet.
%
%   Wrong is what Run breaks of the meaning of the rules of Case.

broken_law(case(Rules, Options, _), Run, Wrong) :-
    Run = run(Start, End, Outcome, Effects, Warned, Journal, Rest),
    spans(Effects, Spans),
    entries(Journal, Entries),
    level(Rules, Entries, Start, End, Level),
    (   Rest \== rests,
        Wrong = moves_at_the_end
    ;   wrong_end(Outcome, Options, Spans, Start, End, Level, Wrong)
    ;   wrong_level(Level, Spans, Wrong)
    ;   wrong_warnings(Warned, Level, Wrong)
    ).

%   level(Rules, Items, Entries, From, To)

level(Rules, Entries, From, To, level(Rules, Items, Entries, From, To)) :-
    items(Entries, Items0),
    merged(Items0, Rules, Items).

%   The levels in a level, and itself.
level_in(Level, Level).
level_in(Level, Inner) :-
    Level = level(Rules, Items, _, _, _),
    member(call(Name, _, _, From, To, _, Within), Items),
    memberchk(rule(Name, _, _, inner(InnerRules, _)), Rules),
    maplist(inner_entry, Within, Entries),
    level(InnerRules, Entries, From, To, Level1),
    level_in(Level1, Inner).

wrong_end(timeout, _, _, Start, End, Level, ends_at(End)) :-
    slack(Level, Slack),
    \+ ( End >= Start + 5, End =< Start + 5 + Slack ).
wrong_end(until, Options, Spans, _, End, Level, until_was_false) :-
    slack(Level, Slack),
    Before is End - Slack,
    \+ ( memberchk(until(Goal), Options),
         truths(Spans, Goal, Truths),
         sometimes(Truths, Before, End) ).
wrong_end(Outcome, _, Spans, _, End, Level, Wrong) :-
    \+ memberchk(Outcome, [timeout, until]),
    (   Outcome = error(permission_error(wait, guard, Name), _)
    ->  late(Late),
        Before is End - Late,
        \+ ( level_in(Level, level(Rules, _, _, _, _)),
             memberchk(rule(Name, Guard, _, _), Rules),
             is_waiting(Guard),
             truths(Spans, Guard, Truths),
             sometimes(Truths, Before, End) ),
        Wrong = its_guard_does_not_wait(Name)
    ;   Wrong = Outcome
    ).
wrong_end(_, Options, Spans, Start, End, Level, until_was_true(From, To)) :-
    memberchk(until(Goal), Options),
    truths(Spans, Goal, Truths),
    slack(Level, Slack),
    member(truth(From0, To0, yes(_)), Truths),
    From is max(From0, Start),
    To is min(To0, End),
    To - From > Slack.

is_waiting((_, wait(_))).

%   A rule warns once in each behave/2 in which its action fails.
wrong_warnings(Warned, Level, warnings(Warned, Failed)) :-
    findall(Name,
            ( level_in(Level, level(_, Items, _, _, _)),
              findall(N, member(call(N, _, _, _, _, fail, _), Items), Names0),
              sort(Names0, Names),
              member(Name, Names)
            ),
            Failed),
    msort(Warned, Sorted),
    \+ msort(Failed, Sorted).

%   An action that catches what leaves it takes longer to leave.
slack(level(Rules, _, _, _, _), Slack) :-
    late(Late),
    (   catches(Rules)
    ->  Slack is Late + 0.1
    ;   Slack = Late
    ).

catches(Rules) :-
    member(rule(_, _, _, Body), Rules),
    (   Body = do(Steps),
        memberchk(catch(_, _, _), Steps)
    ;   Body = inner(Inner, _),
        catches(Inner)
    ),
    !.

wrong_level(Level0, Spans, Wrong) :-
    level_in(Level0, level(Rules, Items, Entries, From, To)),
    Level = level(Rules, Items, Entries, From, To),
    maplist(known(Spans), Rules, Known),
    findall(Call, ( member(Call, Items), Call = call(_, _, _, _, _, _, _) ), Calls),
    slack(Level, Slack),
    Context = context(Known, Calls, Spans, Slack, From, To, Entries),
    wrong(Items, Context, Wrong).

%   known(Rule, Guard's truths, while's truths or none, ShortestTime, Cooldown)
known(Spans, Rule, known(Rule, Truths, While, MinTime, Cooldown)) :-
    Rule = rule(_, Guard, Options, _),
    truths(Spans, Guard, Truths),
    (   memberchk(while(Condition), Options)
    ->  truths(Spans, Condition, While)
    ;   While = none
    ),
    (   memberchk(min_time(MinTime0), Options)
    ->  MinTime = MinTime0
    ;   MinTime = none
    ),
    (   memberchk(cooldown(Cooldown0), Options)
    ->  Cooldown = Cooldown0
    ;   Cooldown = none
    ).

known_of(Name, context(Known, _, _, _, _, _, _), Index, Of) :-
    nth1(Index, Known, Of),
    Of = known(rule(Name, _, _, _), _, _, _, _),
    !.

% ---------------- WHEN IT APPLIES

%   Whether a rule applies for sure in all of the time from A to B, or perhaps
%   in some of it. Its own last call is over then.

applies(Known, Context, A0, B) :-
    Known = known(rule(Name, Guard, _, _), Truths, _, _, _),
    (   last_call(Name, Context, B, Call)
    ->  Call = call(_, _, _, _, Over, _, _),
        Over =< B,
        A is max(A0, Over),
        \+ ( Guard \== true,
             has_ended(Known, Call, _),
             \+ was_false(Truths, Over, A, Context) ),
        \+ may_cool(Known, Call, Context, A)
    ;   A = A0
    ),
    always(Truths, A, B).

may_apply(Known, Context, A0, B) :-
    Known = known(rule(Name, Guard, _, _), Truths, _, _, _),
    (   last_call(Name, Context, B, Call)
    ->  Call = call(_, _, _, _, Over, _, _),
        A is max(A0, min(B, Over)),
        \+ ( Guard \== true,
             has_ended(Known, Call, sure),
             always(Truths, Over, B) ),
        \+ cools(Known, Call, Context, A, B)
    ;   A = A0
    ),
    sometimes(Truths, A, B).

last_call(Name, context(_, Calls, _, _, _, _, _), Before, Call) :-
    findall(C, ( member(C, Calls), C = call(Name, _, _, From, _, _, _), From < Before ), Cs),
    last(Cs, Call).

%   The action has waited and ended, or failed.
has_ended(Known, call(_, _, _, _, _, End, _), Sure) :-
    (   End == either
    ->  Sure = doubtful
    ;   End == fail
    ->  Sure = sure
    ;   End == exit,
        Known = known(rule(_, _, _, Body), _, _, _, _),
        waits(Body),
        Sure = sure
    ).

waits(seq(_)).
waits(inner(_, _)).
waits(do(Steps)) :-
    member(Step, Steps),
    step_waits(Step),
    !.

step_waits(wait(_)).
step_waits(go_cm(_, _)).
step_waits(turn(_, _)).
step_waits(motor_run(_, _, _)).
step_waits(catch(_, _, _)).

%   The guard has been false for so long that this was seen.
was_false(Truths, Over, A, context(_, _, _, Slack, _, _, _)) :-
    member(truth(From, To, no), Truths),
    min(To, A) - max(From, Over) > Slack,
    !.

%   After it was active, a rule cools down. It is not known when one that has
%   returned was no longer active.
cooling(known(rule(Name, Guard, _, Body), Truths, While, MinTime, Cooldown), Call, Context,
        First, Last, Cooldown) :-
    number(Cooldown),
    Call = call(Name, _, _, _, First, End, _),
    Context = context(_, Calls, _, Slack, _, _, _),
    (   End == exit,
        \+ waits(Body)
    ->  (   append(_, [Call|After], Calls),
            After = [call(Other, _, _, From, _, _, _)|_],
            Other \== Name
        ->  Last = From
        ;   Guard \== true,
            While == none,
            MinTime == none,
            member(truth(From0, To0, no), Truths),
            From1 is max(From0, First),
            To0 - From1 > Slack
        ->  Last is From1 + Slack
        ;   Last = 1.0e9
        )
    ;   Last = First
    ).

may_cool(Known, Call, Context, A) :-
    cooling(Known, Call, Context, _, Last, Seconds),
    late(Late),
    A < Last + Seconds + Late.

cools(Known, Call, Context, A, B) :-
    cooling(Known, Call, Context, First, Last, Seconds),
    A >= Last,
    B < First + Seconds.

%   Whether a rule goes on whose action has returned, in its call and those
%   before.

goes_on(Known, Call, Context, A, B) :-
    Known = known(_, Truths, While, MinTime, _),
    (   always(Truths, A, B)
    ->  true
    ;   While \== none,
        maplist(either, Truths, While, One),
        always(One, A, B),
        \+ changes_between(Truths, While, A, B)
    ->  true
    ;   number(MinTime),
        Call = call(_, _, _, From, _, _, _),
        first_in_row(Call, Context, First),
        First =< From,
        exact(Off),
        B < First + MinTime - Off
    ).

%   The guard was looked at before a change, and `while` after it.
changes_between([truth(_, Time, no)|Truths], [_|While], A, B) :-
    While = [truth(_, _, no)|_],
    exact(Off),
    Time > A - Off,
    Time < B + Off,
    Truths = [_|_].
changes_between([_|Truths], [_|While], A, B) :-
    changes_between(Truths, While, A, B).

either(truth(From, To, no), Truth, Truth) :-
    Truth = truth(From, To, _),
    !.
either(Truth, _, Truth).

may_go_on(Known, Call, A, B) :-
    Known = known(_, Truths, While, MinTime, _),
    late(Late),
    (   sometimes(Truths, A, B)
    ->  true
    ;   While \== none,
        sometimes(While, A, B)
    ->  true
    ;   number(MinTime),
        Call = call(_, _, _, From, _, _, _),
        A < From + MinTime + Late
    ).

first_in_row(Call, context(_, Calls, _, _, _, _, _), First) :-
    Call = call(Name, _, _, From, _, _, _),
    append(Before, [Call|_], Calls),
    !,
    reverse(Before, Back),
    first_in_row(Back, Name, From, First).

first_in_row([call(Name, _, _, From, _, exit, _)|Calls], Name, _, First) :-
    !,
    first_in_row(Calls, Name, From, First).
first_in_row(_, _, First, First).

%   The call whose action has returned without having waited, if it was one.
going(call(Name, _, _, _, _, exit, _), Context, Index, Known) :-
    known_of(Name, Context, Index, Known),
    Known = known(rule(_, _, _, Body), _, _, _, _),
    \+ waits(Body).

% ---------------- LAWS

%   Nothing is done for a rule that is not active, and every action ends.
wrong(Items, _, not_active(Time, Path, Act)) :-
    member(stray(entry(Time, Path, Act)), Items).
wrong(_, context(_, Calls, _, _, _, _, _), Wrong) :-
    member(call(Name, _, _, From, _, End, Within), Calls),
    (   End == none,
        Wrong = never_over(Name, From)
    ;   member(entry(Time, Path, Act), Within),
        \+ Path = [Name-_|_],
        Act \= end(_),                  % of a course that it ends
        Wrong = mixed(Time, Name, Path, Act)
    ).
wrong(Items, Context, Wrong) :-
    Context = context(_, Calls, _, _, _, _, _),
    member(Call, Calls),
    (   append(_, [Before, Call|_], Calls)
    ->  true
    ;   Before = none
    ),
    Call = call(Name, _, _, From, _, _, _),
    (   wrong_choice(Call, Before, Context, Wrong0)
    ;   wrong_leave(Call, Context, Wrong0)
    ;   wrong_wait(Call, Context, Wrong0)
    ;   wrong_motors(Call, Before, Items, Context, Wrong0)
    ;   wrong_steps(Call, Context, Wrong0)
    ),
    Wrong = Name/From/Wrong0.
wrong(Items, Context, Wrong) :-
    Context = context(_, Calls, _, _, Start, End, _),
    pause(Calls, Start, End, Before, From, To),
    wrong_pause(Before, From, To, Items, Context, Wrong).
wrong(_, context(_, _, _, _, _, _, Entries), runs_at_the_end(Port)) :-
    running(Entries, Running),
    member(Port-Kind, Running),
    memberchk(Kind, [run, course]).

pause([], Start, End, none, Start, End).
pause([call(_, _, _, To, _, _, _)|_], Start, _, none, Start, To).
pause(Calls, _, End, Call, From, To) :-
    append(_, [Call|After], Calls),
    Call = call(_, _, _, _, From, _, _),
    (   After = [call(_, _, _, To, _, _, _)|_]
    ->  true
    ;   After = [],
        To = End
    ).

%   1, 3: the first rule that applies is chosen, with the values of its guard.

wrong_choice(Call, Before, Context, Wrong) :-
    Call = call(Name, Values, _, From, _, _, _),
    Context = context(Known, _, _, Slack, Start, _, _),
    known_of(Name, Context, Index, Of),
    Of = known(_, Truths, _, _, _),
    (   Before = call(_, _, _, _, Over, End0, _),
        End0 \== left
    ->  Earliest is max(Start, max(Over, From - Slack))
    ;   Earliest is max(Start, From - Slack)
    ),
    (   \+ may_apply(Of, Context, Earliest, From),
        Wrong = does_not_apply
    ;   \+ ( meets(Truths, Earliest, From, yes(Values0)),
             Values0 =@= Values ),
        Wrong = has_other_values(Values)
    ;   nth1(Earlier, Known, Other),
        Earlier < Index,
        applies(Other, Context, Earliest, From),
        Other = known(rule(Passed, _, _, _), _, _, _, _),
        Wrong = passed_over(Passed)
    ;   Before \== none,
        going(Before, Context, Going, GoesOn),
        Before = call(_, Values1, _, _, To, _, _),
        (   Going < Index,
            goes_on(GoesOn, Before, Context, To, From),
            Wrong = suppresses_an_earlier_one
        ;   Going =:= Index,
            goes_on(GoesOn, Before, Context, To, From),
            shared(Of, Values1, Same),
            shared(Of, Values, Same2),
            Same =@= Same2,
            Wrong = called_again
        )
    ).

%   The values of the variables that guard and action share.
shared(known(rule(_, Guard, _, Body), _, _, _, _), Values, Shared) :-
    term_variables(Guard, Variables),
    term_variables(Body, Others),
    findall(Variables1-Guard, include(among(Others), Variables, Variables1), [Shared-Values]).

among(Variables, Variable) :-
    member(Other, Variables),
    Other == Variable,
    !.

%   1, 2: an action is left for an earlier rule, or because `while` is false.

wrong_leave(call(Name, _, _, _, Over, left, _), Context, is_left) :-
    Context = context(_, Calls, _, Slack, _, End, _),
    known_of(Name, Context, Index, known(_, _, While, _, _)),
    \+ Over + Slack >= End,
    \+ ( member(call(Next, _, _, From, _, _, _), Calls),
         From >= Over,
         From - Over < Slack,
         known_of(Next, Context, Earlier, _),
         Earlier < Index ),
    Before is Over - Slack,
    \+ ( While \== none,
         meets(While, Before, Over, no) ).

%   1: an earlier rule that applies suppresses an action.

wrong_wait(call(Name, _, _, From, Over, _, _), Context, Wrong) :-
    Context = context(Known, _, _, Slack, _, _, _),
    Over - From > Slack,
    known_of(Name, Context, Index, known(_, _, While, _, _)),
    (   nth1(Earlier, Known, Other),
        Earlier < Index,
        longest(rule_laws:applies(Other, Context), From, Over, Context, Since, Until),
        Other = known(rule(Waits, _, _, _), _, _, _, _),
        Wrong = not_suppressed_by(Waits, Since, Until)
    ;   While \== none,
        longest(rule_laws:is_false(While), From, Over, Context, Since, Until),
        Wrong = while_is_false(Since, Until)
    ).

is_false(Truths, A, B) :-
    \+ sometimes(Truths, A, B).

%   A time from Since to Until, longer than the slack, in which Goal_2 holds all
%   the time.

:- meta_predicate longest(2, +, +, +, -, -).

longest(Goal, From, To, Context, Since, Until) :-
    Context = context(_, _, _, Slack, _, _, _),
    To - From > Slack,
    moments(From, To, Context, Moments),
    exact(Off),
    stretches(Moments, Off, Goal, Stretches),
    member(Since-Until, Stretches),
    Until - Since > Slack,
    !.

stretches([_], _, _, []) :-
    !.
stretches([A, B|Moments], Off, Goal, Stretches) :-
    A1 is A + 2*Off,
    B1 is B - 2*Off,
    stretches([B|Moments], Off, Goal, Stretches1),
    (   (   A1 >= B1
        ->  Stretches1 = [B-_|_]
        ;   call(Goal, A1, B1)
        )
    ->  (   Stretches1 = [B-C|More]
        ->  Stretches = [A-C|More]
        ;   Stretches = [A-B|Stretches1]
        )
    ;   Stretches = Stretches1
    ).

%   When something may change: a sensor, what cools, what was false.
moments(From, To, context(Known, Calls, Spans, Slack, _, _, _), Moments) :-
    findall(Time,
            ( member(span(Change, _, _), Spans),
              ( Time = Change ; Time is Change + Slack )
            ),
            Changes),
    findall(Time,
            ( member(known(rule(Name, _, _, _), _, _, MinTime, Cooldown), Known),
              member(call(Name, _, _, Begun, Over, _, _), Calls),
              (   number(Cooldown), member(call(_, _, _, Other, _, _, _), Calls),
                  ( Time is Over + Cooldown + 0.06 ; Time is Other + Cooldown + 0.06 )
              ;   number(MinTime), Time is Begun + MinTime + 0.06
              )
            ),
            Ends),
    append(Changes, Ends, Times0),
    include(between_times(From, To), Times0, Times1),
    sort([From, To|Times1], Moments).

between_times(From, To, Time) :-
    From < Time,
    Time < To.

%   5, 3: in the pauses: who applies is called, and if nobody does, the robot rests.

wrong_pause(Before, From, To, _, Context, Wrong) :-
    Context = context(Known, _, _, _, _, _, Entries),
    (   nth1(Index, Known, Other),
        longest(rule_laws:is_to_begin(Index, Other, Before, Context), From, To, Context,
                Since, Until),
        Other = known(rule(Name, _, _, _), _, _, _, _),
        Wrong = does_not_begin(Name, Since, Until)
    ;   longest(rule_laws:nobody(Before, Context), From, To, Context, Since, Until),
        exclude(after_time(Until), Entries, Earlier),
        running(Earlier, Running),
        member(Port-Kind, Running),
        memberchk(Kind, [run, course]),
        Wrong = does_not_rest(Port, Since, Until)
    ).
wrong_pause(Before, From, To, Items, Context, stopped(Ports, Time)) :-
    Before = call(_, _, _, _, _, _, Within),
    going(Before, Context, _, Known),
    member(idle(entry(Time, _, stop(Ports))), Items),
    Time >= From,
    Time =< To,
    late(Late),
    Context = context(_, _, _, _, _, End, _),
    Time + Late < End,
    (   Time - From < 0.02
    ->  member(entry(_, _, run(Ports)), Within)
    ;   goes_on(Known, Before, Context, From, Time)
    ).

after_time(Time, entry(Time0, _, _)) :-
    Time0 > Time.

is_to_begin(Index, Known, Before, Context, A, B) :-
    (   Before \== none,
        going(Before, Context, Going, GoesOn)
    ->  Before = call(_, Values, _, _, Over, _, _),
        (   Index < Going
        ->  applies(Known, Context, A, B)
        ;   Index > Going
        ->  applies(Known, Context, A, B),
            \+ may_go_on(GoesOn, Before, A, B)
        ;   Known = known(_, Truths, _, _, none),
            always(Truths, A, B),
            (   meets(Truths, A, B, yes(Now)),
                shared(Known, Now, Shared),
                shared(Known, Values, Shared0),
                \+ Shared =@= Shared0
            ->  true
            ;   Known = known(_, _, none, none, _),
                was_false(Truths, Over, A, Context)
            )
        )
    ;   applies(Known, Context, A, B)
    ).

nobody(Before, Context, A, B) :-
    Context = context(Known, _, _, _, _, _, _),
    \+ ( Before \== none,
         going(Before, Context, _, GoesOn),
         may_go_on(GoesOn, Before, A, B) ),
    \+ ( member(Other, Known),
         may_apply(Other, Context, A, B) ).

%   4: what runs goes on until the new action has commanded it, or waits.

wrong_motors(Call, Before, Items, Context, Wrong) :-
    Call = call(Name, _, _, From, _, _, _),
    Context = context(_, _, _, _, Start, _, Entries),
    \+ ( Before = call(Name, _, _, _, _, exit, _),
         going(Before, Context, _, _) ),
    (   Before = call(_, _, _, _, Over, _, _)
    ->  true
    ;   Over = Start
    ),
    exclude(from_time(From), Entries, Earlier),
    running(Earlier, Running),
    first_commands(Call, Context, Ports, Limit),
    (   member(Port-Kind, Running),
        memberchk(Kind, [run, course]),
        about(Port, Entries, From, First),
        (   memberchk(Port, Ports)
        ->  First = entry(_, _, Act),
            Act = stop(_),
            \+ commands_first(Call, Context, motor_stop(Port)),
            Wrong = stops_first(Port)
        ;   First = entry(Time, _, Act),
            (   Act \= stop(_)
            ->  Wrong = goes_on(Port)
            ;   Time > Limit
            ->  Wrong = stops_late(Port, Time)
            ;   fail
            )
        )
    ;   member(idle(entry(Time, _, stop(Port))), Items),
        Time > Over,
        Time < From,
        From - Time < 0.015,
        Wrong = stops_before(Port, Time)
    ).

from_time(Time, entry(Time0, _, _)) :-
    Time0 >= Time.

about(Port, Entries, From, First) :-
    member(First, Entries),
    First = entry(Time, _, Act),
    Time >= From,
    Act =.. [Kind, Ports|_],
    \+ memberchk(Kind, [mark, end]),
    memberchk(Port, Ports),
    !.
about(_, _, _, entry(1.0e9, [], none)).

%   The motors that a call commands before its first wait, and when that must
%   have begun.
first_commands(Call, Context, Ports, Limit) :-
    Call = call(Name, _, _, From, To, _, Within),
    known_of(Name, Context, _, known(rule(_, _, _, Body), _, _, _, _)),
    first_steps(Body, From, Within, Steps, Waits),
    maplist(ports_of, Steps, Lists),
    append(Lists, Ports),
    (   Waits == true
    ->  Limit is From + 0.06
    ;   Limit is max(To, From) + 0.02
    ).

first_steps(do(Steps0), _, _, Steps, Waits) :-
    before_wait(Steps0, Steps, Waits).
first_steps(seq([Part|_]), _, _, Steps, true) :-
    (   Part = Steps0:_
    ->  true
    ;   Steps0 = Part
    ),
    before_wait(Steps0, Steps, _).
first_steps(inner(Rules, _), From, Within, Steps, true) :-
    (   Within = [entry(Time, [_, Name-_|_], mark(_, _))|_],
        Time - From < 0.02
    ->  memberchk(rule(Name, _, _, Body), Rules),
        first_steps(Body, 0, [], Steps, _)
    ;   Steps = []
    ).

before_wait([], [], false).
before_wait([Step|Steps0], [Step|Steps], Waits) :-
    (   Step == fail
    ->  Steps = [],
        Waits = false
    ;   step_waits(Step)
    ->  Steps = [],
        Waits = true
    ;   before_wait(Steps0, Steps, Waits)
    ).

commands_first(call(Name, _, _, From, _, _, Within), Context, Step) :-
    known_of(Name, Context, _, known(rule(_, _, _, Body), _, _, _, _)),
    first_steps(Body, From, Within, Steps, _),
    memberchk(Step, Steps).

ports_of(Step, Ports) :-
    (   commanded(Step, Ports)
    ->  true
    ;   Step = motor_stop(Port)
    ->  Ports = [Port]
    ;   Ports = []
    ).

commanded(go(_), [outB, outC]).
commanded(turn(_), [outB, outC]).
commanded(steer(_, _), [outB, outC]).
commanded(go_cm(_, _), [outB, outC]).
commanded(turn(_, _), [outB, outC]).
commanded(motor_run(Port, _), [Port]).
commanded(motor_run(Port, _, _), [Port]).
commanded(catch(Step, _, _), Ports) :-
    commanded(Step, Ports).

%   2, 3: an action's steps are done once, in their order; one that is left
%   stops its move.

wrong_steps(call(Name, _, Parts, _, _, End, Within), Context, Wrong) :-
    known_of(Name, Context, _, known(rule(_, _, _, Body), _, _, _, _)),
    (   Body = do(Steps),
        findall(Port, ( commanded_in(Steps, Ports), member(Port, Ports) ), Expected),
        findall(Port,
                ( member(entry(_, _, Act), Within),
                  Act =.. [Kind, Ports],
                  memberchk(Kind, [run, move, course]),
                  member(Port, Ports)
                ),
                Done),
        (   End == left
        ->  \+ append(Done, _, Expected)
        ;   Done \== Expected
        ),
        Wrong = steps(Done, Expected)
    ;   End == left,
        Body = do([_|_]),
        member(entry(Time, _, move([Port])), Within),
        \+ ( member(entry(Later, _, Act), Within),
             Later > Time,
             Act \= mark(_, _) ),
        Body = do(Steps),
        last(Steps, motor_run(Port, _, _)),
        Wrong = move_goes_on(Port)
    ;   End == left,
        Body = do(_),
        running(Within, Running),
        member(Port-move, Running),
        memberchk(Port, [outB, outC]),
        Wrong = course_goes_on(Port)
    ;   Body = seq(Bodies),
        nth1(Part, Parts, From-To),
        nth1(Part, Bodies, _:Seconds),
        late(Late),
        (   To - From > Seconds + Late
        ;   Next is Part + 1,
            nth1(Next, Parts, _),
            To - From < Seconds - Late
        ),
        Wrong = part_lasts(Part, From, To)
    ).

commanded_in([Step|Steps], Ports) :-
    Step \== fail,
    (   commanded(Step, Ports)
    ;   commanded_in(Steps, Ports)
    ).
