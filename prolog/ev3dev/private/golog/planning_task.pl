:- module(ev3dev_golog_planning_task,
          [ task/5,                     % +Module, +Goal, +Values, +Effort,
                                        % -Task
            task_plan/4                 % +Task, +Shortest, +Effort, -Plan
          ]).
:- use_module(library(assoc), [empty_assoc/1, get_assoc/3, put_assoc/4]).
:- use_module(library(lists), [member/2]).
:- use_module(effort, [counted_natively/3, effort_id/2, polled/1]).
:- use_module(ground,
              [ ground_action/4, ground_actions/2, ground_condition/3,
                only_relations/1
              ]).
:- use_module(theory, [has_clauses/2, has_possible_values/1]).
:- use_module('../native/native', [planner_new_/6, planner_work_/4]).

/** <module> Plans for domains whose fluents are true or false

A domain that `ground.pl` can make ground becomes a task of the native planner
(`crates/planner`): its fluents and actions become numbers. A task is

    task(Actions, Facts, Initial, NativeActions, Goal)

Actions is a compound term, so that each is found by its number. The others
are the arguments of planner_new_/6.
*/

%!  task(+Module, +Goal, +Values, +Effort, -Task) is semidet.
%
%   Task is to reach the condition Goal from Values, a list of Fluent-Value.
%   Fails if the domain has other fluents, or conditions that it does not
%   decide by itself.

task(M, Goal, Values, Effort, Task) :-
    catch(ground_task(M, Goal, Values, Effort, Task), error(Formal, Where),
          ( Formal = resource_error(_), throw(error(Formal, Where)) )).

ground_task(M, Goal, Values, Effort,
            task(Actions, N, Initial, Natives, GoalOfNumbers)) :-
    only_relations(M),
    \+ has_possible_values(M),
    \+ ( member(Head, [causes_val(_, _Fluent, _, _), forget(_, _)]),
         has_clauses(M, Head) ),
    \+ ( member(_-V, Values), V \== true, V \== false ),
    ground_condition(Goal, M, GoalCondition),
    ground_actions(M, As),
    findall(ground(A, Condition, Effects),
            ( member(A, As),
              polled(Effort),
              ground_action(A, M, Condition, Effects) ),
            Grounds),
    findall(A, member(ground(A, _, _), Grounds), Names),
    compound_name_arguments(Actions, actions, Names),
    empty_assoc(None),
    numbered_actions(Grounds, Natives, 0-None, Numbers0),
    numbered(GoalCondition, GoalOfNumbers, Numbers0, N-Numbers),
    findall(Fact, ( member(F-true, Values), get_assoc(F, Numbers, Fact) ),
            Initial).

%   numbered(+Expression, -Numbered, +Numbers0, -Numbers): fluents become
%   numbers. Numbers is Count-Assoc.

numbered(E, Numbered, Numbers0, Numbers) :-
    (   memberchk(E, [true, false])
    ->  Numbered = E,
        Numbers = Numbers0
    ;   E = [Word|Es]
    ->  Numbered = [Word|Ns],
        all_numbered(Es, Ns, Numbers0, Numbers)
    ;   Numbers0 = N0-Known,
        (   get_assoc(E, Known, Numbered)
        ->  Numbers = Numbers0
        ;   Numbered = N0,
            N is N0+1,
            put_assoc(E, Known, Numbered, Known1),
            Numbers = N-Known1
        )
    ).

all_numbered([], [], Numbers, Numbers).
all_numbered([E|Es], [N|Ns], Numbers0, Numbers) :-
    numbered(E, N, Numbers0, Numbers1),
    all_numbered(Es, Ns, Numbers1, Numbers).

numbered_actions([], [], Numbers, Numbers).
numbered_actions([ground(_, Condition, Effects)|Grounds],
                 [action(ConditionOfNumbers, NativeEffects)|Natives],
                 Numbers0, Numbers) :-
    numbered(Condition, ConditionOfNumbers, Numbers0, Numbers1),
    numbered_effects(Effects, NativeEffects, Numbers1, Numbers2),
    numbered_actions(Grounds, Natives, Numbers2, Numbers).

numbered_effects([], [], Numbers, Numbers).
numbered_effects([effect(Truth, F, If)|Effects],
                 [effect(Truth, Fact, Condition)|Natives],
                 Numbers0, Numbers) :-
    all_numbered([F, If], [Fact, Condition], Numbers0, Numbers1),
    numbered_effects(Effects, Natives, Numbers1, Numbers).

%!  task_plan(+Task, +Shortest, +Effort, -Plan) is semidet.
%
%   Plan is a list of actions, a shortest one if Shortest is true.

task_plan(task(Actions, Facts, Initial, Natives, Goal), Shortest, Effort,
          Plan) :-
    planner_new_(Facts, Initial, Natives, Goal, Shortest, Planner),
    planned(Planner, 0, Effort, Numbers),
    findall(A, ( member(Number, Numbers),
                 At is Number+1,
                 arg(At, Actions, A) ),
            Plan).

%   The planner works in pieces that take a computer half a millisecond, and
%   a brick some thirty.

planned(Planner, States0, Effort, Plan) :-
    planner_work_(Planner, 50000, Progress, States),
    New is States-States0,
    counted_natively(New, 10000, Effort),
    polled(Effort),
    (   Progress == working
    ->  planned(Planner, States, Effort, Plan)
    ;   Progress = gave_up(Limit)
    ->  effort_id(Effort, Id),
        throw('$golog_gave_up'(Id, Limit))
    ;   Progress = plan(Plan)
    ).
