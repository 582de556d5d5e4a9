:- module(rule_sets,
          [ rule_set/2,                 % +Seed, -Case
            run_of_case/3,              % +Seed, +Case, -Run
            act/2,                      % +Code, +Steps
            behaves/2                   % +Rules, +Options
          ]).
:- use_module(simulation).
:- use_module(library(ev3dev/drive)).
:- use_module(library(ev3dev/journal)).
:- use_module(library(ev3dev/rules), except([on/2])).
:- use_module(library(ev3dev/sim_hand)).
:- use_module(library(apply)).
:- use_module(library(lists)).
:- use_module(library(random)).

/** <module> Random sets of rules, and what they do

A case is case(Rules, Options, Trace): random rules for three sensors of a
robot on an endless floor, and when these sensors show what. A rule is
rule(Name, Guard, Options, Body), where Guard and Options are as in a program,
and Body is one of

  - do(Steps)
    Steps are goals, one after the other.
  - seq(Parts)
    Steps:Seconds, and the last one may be Steps: a list as an action.
  - inner(Rules, Options)
    An action that is a behave/2.

Each action writes two marks into the journal, as colors of a light: when it
begins and when it is over, with its number. So the journal tells all that
rule_laws.pl has to know.
*/

% ---------------- CASES

%!  rule_set(+Seed, -Case)

rule_set(Seed, case(Rules, Options, [0-in1-First, 0-in2-Second, 0-in4-0|Trace])) :-
    set_random(seed(Seed)),
    rules(2, 6, 0, r, Rules),
    random_member(Options,
                  [[], [], [], [], [until(( col_ambient(in2, U), U > 85 ))]]),
    shown(in1, First),
    shown(in2, Second),
    random_between(4, 14, Count),
    trace(Count, 0.2, Trace).

%   Changes are so far from each other that there are moments between at which
%   there is no doubt.

trace(Count, Time0, Trace) :-
    random(Share),
    random_member(Gap, [0.15, 0.3, 0.8]),
    Time is Time0 + 0.15 + Share*Gap,
    (   Count > 0,
        Time < 4.8
    ->  random_member(Port, [in1, in1, in2, in4]),
        shown(Port, Value),
        Trace = [Time-Port-Value|Rest],
        Less is Count - 1,
        trace(Less, Time, Rest)
    ;   Trace = []
    ).

%   Of the ultrasonic sensor it is the distance in centimeters.
shown(in1, Value) :- random_member(Value, [10.0, 20.0, 30.0, 45.0, 80.0]).
shown(in2, Value) :- random_member(Value, [5, 20, 40, 60, 90]).
shown(in4, Value) :- random_member(Value, [0, 1, 1]).

rules(Least, Most, Depth, Prefix, Rules) :-
    random_between(Least, Most, Count),
    numlist(1, Count, Numbers),
    maplist(rule(Count, Depth, Prefix), Numbers, Rules).

rule(Count, Depth, Prefix, Number, rule(Name, Guard, Options, Body)) :-
    atomic_list_concat([Prefix, Number], Name),
    random(Share),
    (   Number == Count,
        Share < 0.6
    ->  Guard = true,
        Variable = none
    ;   Share < 0.03
    ->  guard(Guard0, Variable),
        Guard = (Guard0, wait(0.1))
    ;   guard(Guard, Variable)
    ),
    options(Options),
    random(Kind),
    (   Depth < 1,
        Kind < 0.12
    ->  Deeper is Depth + 1,
        atom_concat(Name, '_', Inner),
        rules(1, 3, Deeper, Inner, Rules),
        random_member(InnerOptions, [[], [], [timeout(0.7)], [timeout(1.5)]]),
        Body = inner(Rules, InnerOptions)
    ;   Kind < 0.2
    ->  random_between(1, 3, Length),
        parts(Length, Variable, Parts),
        Body = seq(Parts)
    ;   body(Variable, Steps),
        Body = do(Steps)
    ).

%   Variable is one that an action may share with it.
guard(Guard, Variable) :-
    random_member(Guard-Variable,
                  [ (us_dist_cm(in1, D), D < 25)-D,
                    (us_dist_cm(in1, D), D < 40)-D,
                    (us_dist_cm(in1, D), D > 15)-D,
                    us_dist_cm(in1, D)-D,
                    (col_ambient(in2, L), L > 30)-L,
                    (col_ambient(in2, L), L < 50)-L,
                    touch(in4, 1)-none,
                    touch(in4, 1)-none,
                    (\+ touch(in4, 1))-none,
                    (touch(in4, 1), us_dist_cm(in1, D))-D,
                    (touch(in4, 0), col_ambient(in2, L))-L,
                    (touch(in4, 1) ; us_dist_cm(in1, D), D < 25)-none,
                    (us_dist_cm(in1, D), D < 60, col_ambient(in2, L), L > 10)-L
                  ]).

options(Options) :-
    findall(Option,
            ( member(Kind, [while, min_time, cooldown]),
              random(Share),
              Share < 0.2,
              option_of(Kind, Option)
            ),
            Options).

option_of(while, while(Guard)) :-
    guard(Guard, _).
option_of(min_time, min_time(Seconds)) :-
    random_member(Seconds, [0.3, 0.8, 1.5]).
option_of(cooldown, cooldown(Seconds)) :-
    random_member(Seconds, [0.2, 0.7, 1.5]).

parts(1, Variable, [Last]) :-
    !,
    part(Variable, Steps, Seconds),
    (   maybe
    ->  Last = Steps
    ;   Last = Steps:Seconds
    ).
parts(Length, Variable, [Steps:Seconds|Parts]) :-
    part(Variable, Steps, Seconds),
    Less is Length - 1,
    parts(Less, Variable, Parts).

%   Each is left when its time is over.
part(Variable, [Step, wait(9)], Seconds) :-
    effect(Variable, Step),
    random_member(Seconds, [0.3, 0.5, 1.0]).

body(Variable, Steps) :-
    random_member(Shape,
                  [ [effect], [effect], [effect], [effect, effect], [move], [move], [wait],
                    [effect, move], [move, effect], [effect, wait], [wait, move],
                    [move, move], [effect, wait, effect], [keep, keep, wait],
                    [effect, fail], [move, fail], [stop, wait] ]),
    maplist(step(Variable), Shape, Steps).

step(_, fail, fail).
step(_, wait, wait(Seconds)) :-
    random_member(Seconds, [0.1, 0.3, 1, 3]).
step(_, stop, motor_stop(Port)) :-
    random_member(Port, [outA, outD]).
step(Variable, effect, Step) :-
    effect(Variable, Step).
step(_, move, Step) :-
    move(Step).
step(_, keep, catch(Step, _, true)) :-
    move(Step).

effect(Variable, Step) :-
    var(Variable),
    maybe,
    !,
    random_member(Step, [go(Variable), motor_run(outA, Variable)]).
effect(_, Step) :-
    random_member(Step,
                  [ go(30), go(-20), turn(20), steer(30, 20), motor_run(outA, 30),
                    motor_run(outD, 50), motor_run(outA, -60) ]).

move(Step) :-
    random_member(Step,
                  [ go_cm(30, 10), go_cm(20, -30), turn(30, 90), wait(0.4),
                    motor_run(outA, 50, 200), motor_run(outD, 30, 720) ]).

% ---------------- RUNS

:- dynamic
    effect_of/3,                        % Time, Port, Value
    warned/1.                           % Name

%!  run_of_case(+Seed, +Case, -Run)
%
%   Let the rules behave for five seconds on the virtual clock. Run is
%   run(Start, End, Outcome, Effects, Warned, Journal, Rest): Outcome is a
%   reason or an exception, Effects are Time-Port-Value, Warned the rules with
%   warnings, and Rest is `rests` or `moves`.

run_of_case(Seed, case(Rules, Options, Trace), Run) :-
    retractall(effect_of(_, _, _)),
    retractall(warned(_)),
    flag(rule_sets_call, _, 1),
    with_sim([],
             ( set_robot(5.6, 10.6, outB, outC),
               sim_unplug(in4),
               sim_plug(in4, 'lego-ev3-touch'),
               sim_plug(outD, 'lego-ev3-l-motor'),
               sim_wait(3),
               us_dist_cm(in1, _), col_ambient(in2, _), touch(in4, _),
               ev3_time(Now),
               forall(member(Time-Port-Value, Trace),
                      planned(Now, Time, Port, Value)),
               ev3_time(Start),
               noting_warnings(catch(( behaves(Rules, [ timeout(5), reason(Outcome)
                                                      | Options ])
                                       -> true
                                       ; Outcome = failed
                                       ),
                                     Outcome, true)),
               ev3_time(End),
               journal(Journal),
               ( at_rest -> Rest = rests ; Rest = moves ),
               findall(T-P-V, effect_of(T, P, V), Effects),
               findall(Name, warned(Name), Warned)
             ),
             [seed(Seed)]),
    Run = run(Start, End, Outcome, Effects, Warned, Journal, Rest).

planned(_, 0, Port, Value) :-
    !,
    show(Port, Value).
planned(Now, Time, Port, Value) :-
    At is Now + Time,
    sim_at(At, rule_sets:show(Port, Value)).

show(Port, Value) :-
    show_(Port, Value),
    ev3_time(Time),
    assertz(effect_of(Time, Port, Value)).

show_(in1, Value) :-
    Millimeters is round(10*Value),
    sim_show(in1, value0, Millimeters).
show_(in2, Value) :-
    sim_show(in2, value0, Value).
show_(in4, Value) :-
    (   Value =:= 1
    ->  sim_press(in4)
    ;   sim_release(in4)
    ).

:- meta_predicate noting_warnings(0).
:- multifile user:message_hook/3.
:- dynamic user:message_hook/3.

noting_warnings(Goal) :-
    setup_call_cleanup(
        asserta((user:message_hook(ev3dev(rule_failed(Name)), warning, _) :-
                     assertz(rule_sets:warned(Name))), Reference),
        Goal,
        erase(Reference)).

%!  behaves(+Rules, +Options)
%
%   behave/2 with such rules.

behaves(Rules, Options) :-
    maplist(in_a_program, Rules, Programs),
    behave(Programs, Options).

in_a_program(rule(Name, Guard, Options, Body),
             (Head :: Guard ~> Action)) :-
    head(Options, Name, Head),
    action(Body, Action).

head([], Name, Name).
head([Option|Options], Name, Head) :-
    head(Options, (Name, Option), Head).

action(do(Steps), act(1, Steps)).
action(inner(Rules, Options), act(1, [behaves(Rules, Options)])).
action(seq(Parts0), Parts) :-
    parts_of(Parts0, 1, Parts).

parts_of([], _, []).
parts_of([Part0|Parts0], Number, [Part|Parts]) :-
    Code is 10 + Number,
    (   Part0 = Steps:Seconds
    ->  Part = act(Code, Steps):Seconds
    ;   Part = act(Code, Part0)
    ),
    Next is Number + 1,
    parts_of(Parts0, Next, Parts).

%!  act(+Code, +Steps)
%
%   Do Steps between two marks, of which Code is the first.

act(Code, Steps) :-
    flag(rule_sets_call, Number, Number + 1),
    setup_call_catcher_cleanup(
        mark(Code, Number),
        once(maplist(rule_sets:do, Steps)),
        Catcher,
        over(Catcher, Number)).

do(Step) :-
    once(Step).

over(Catcher, Number) :-
    (   Catcher == exit
    ->  mark(2, Number)
    ;   Catcher == fail
    ->  mark(3, Number)
    ;   mark(4, Number)
    ).

%   Levels are percent.
mark(Code, Number) :-
    Red is Code + 20*(Number // 100),
    Green is Number mod 100,
    (   led(left, levels(Red, Green))
    ->  true
    ;   throw(no_mark(Code, Number))
    ).
