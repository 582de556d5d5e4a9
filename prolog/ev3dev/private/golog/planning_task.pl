:- module(ev3dev_golog_planning_task,
          [ task/7,                     % +Module, +Goal, +Values, +Costs,
                                        % +Agents, +Effort, -Task
            cost/4,                     % +Costs, +Action, +Module, -Cost
            ground_problem/5,           % +Module, +Goal, +Values, +Effort,
                                        % -Problem
            task_plan/4                 % +Task, +Shortest, +Effort, -Plan
          ]).
:- use_module(library(assoc),
              [ empty_assoc/1, gen_assoc/3, get_assoc/3, list_to_assoc/2,
                put_assoc/4
              ]).
:- use_module(library(apply), [maplist/3]).
:- use_module(library(lists), [append/3, member/2, nth0/3]).
:- use_module(library(pairs), [group_pairs_by_key/2]).
:- use_module(effort, [counted_natively/3, effort_id/2, polled/1]).
:- use_module(ground,
              [ asked_for/2, exclude/2, ground_action/4, ground_actions/2,
                ground_condition/3, ground_rules/2, is_relation/2,
                possible_value/2, value_added/3, with_values_of/2
              ]).
:- use_module(steps, [agent_of/3, always/3, needed/3]).
:- use_module(theory,
              [ has_agents/1, has_clauses/2, has_possible_values/1,
                has_step_rules/1, located/3
              ]).
:- use_module('../errors/errors', [throw_error/3]).
:- use_module('../native/native',
              [planner_end_/1, planner_new_/3, planner_work_/4]).
:- use_module('../run/waits', [let_page_in/0]).

/** <module> Plans for domains that can be made ground

A domain that `ground.pl` can make ground becomes a task of the native planner
(`crates/planner`): its facts and actions become numbers. A fact is a relation
that is true, or `Fluent = Value`. A task is

    task(Actions, Native)

Actions is a compound term, so that each is found by its number. Native is the
task of planner_new_/3.

Agents is `at_once` if a plan is to have steps of several actions, else
`by_turns`.
*/

%!  task(+Module, +Goal, +Values, +Costs, +Agents, +Effort,
%!       -Task) is semidet.
%
%   Task is to reach the condition Goal from Values, a list of Fluent-Value.
%   If Costs is true, actions have the costs of action_cost/2, else each
%   costs 1. Fails if the domain has conditions that it does not decide by
%   itself, or if too many values are possible.

task(M, Goal, Values, Costs, Agents, Effort,
     task(Actions, task(N, Initial, Natives, Rules, NumberedGoal,
                        Concurrent))) :-
    ground_problem(M, Goal, Values, Effort,
                   problem(Facts, Grounds, GroundRules, Condition, Always)),
    findall(A, member(ground(A, _, _), Grounds), Names),
    compound_name_arguments(Actions, actions, Names),
    empty_assoc(None),
    numbered_actions(Grounds, Costs, M, Natives, 0-None, Numbers0),
    numbered_rules(GroundRules, Rules, Numbers0, Numbers1),
    numbered(Condition, NumberedGoal, Numbers1, Numbers2),
    numbered(Always, NumberedAlways, Numbers2, N-Numbers),
    concurrent(Agents, Names, M, NumberedAlways, Concurrent),
    findall(Number,
            ( member(Fact, Facts), get_assoc(Fact, Numbers, Number) ),
            Initial).

%!  ground_problem(+Module, +Goal, +Values, +Effort, -Problem) is semidet.
%
%   As task/7, before facts become numbers: Problem is problem(Facts, Grounds,
%   Rules, Condition, Always). Facts are those of Values. Grounds is a list of
%   ground(Action, If, Effects), and an effect is effect(Truth, Fact, If).
%   Always is what holds after each step.

ground_problem(M, Goal, Values, Effort,
               problem(Facts, Grounds, Rules, Condition, Always)) :-
    \+ has_possible_values(M),
    \+ has_clauses(M, forget(_, _)),
    values_facts(Values, M, Pairs, Facts),
    catch(with_values_of(Pairs, ground_domain(M, Goal, Effort, Grounds, Rules,
                                              Condition, Always)),
          error(Formal, Where),
          ( Formal = resource_error(_), throw(error(Formal, Where)) )).

%   values_facts(+Values, +Module, -Pairs, -Facts) is semidet: Pairs are the
%   values of fluents that are no relations.

values_facts([], _, [], []).
values_facts([F-V|Values], M, Pairs, Facts) :-
    (   is_relation(F, M)
    ->  memberchk(V, [true, false]),
        Pairs = Pairs1,
        ( V == true -> Facts = [F|Facts1] ; Facts = Facts1 )
    ;   Pairs = [F-V|Pairs1],
        Facts = [F = V|Facts1]
    ),
    values_facts(Values, M, Pairs1, Facts1).

ground_domain(M, Goal, Effort, Grounds, Rules, Condition, Always) :-
    ground_actions(M, As),
    findall(action(A, [], none), member(A, As), Actions0),
    grounded(1, all, Actions0, M, Effort, Actions),
    findall(ground(A, If, Effects),
            member(action(A, _, ground(If, Effects)), Actions),
            Grounds0),
    maplist(with_facts(M), Grounds0, Grounds),
    ground_rules(M, Rules),
    ground_condition(Goal, M, Condition),
    findall(P, always(P, _, M), Ps),
    ground_condition(and(Ps), M, Always).

%   grounded(+Round, +Changed, +Actions0, +Module, +Effort, -Actions) is
%   semidet.
%
%   An action is made ground again as long as fluents that it asks for come to
%   have more values. It fails if a fluent seems to count up for ever.

most_rounds(100).
most_values(2000).

grounded(Round, Changed, Actions0, M, Effort, Actions) :-
    round(Actions0, Changed, Actions1, More, M, Effort),
    (   More == []
    ->  Actions = Actions1
    ;   most_rounds(MostRounds),
        Round < MostRounds,
        findall(x, possible_value(_, _), Values),
        length(Values, Count),
        most_values(MostValues),
        Count =< MostValues,
        Round1 is Round+1,
        grounded(Round1, More, Actions1, M, Effort, Actions)
    ).

round([], _, [], [], _, _).
round([Action0|Actions0], Changed, [Action|Actions], More, M, Effort) :-
    Action0 = action(A, Asked0, _),
    (   Changed \== all,
        \+ ( member(Functor, Asked0), memberchk(Functor, Changed) )
    ->  Action = Action0,
        More = More1
    ;   polled(Effort),
        asked_for(grounded_action(A, M, Ground), Asked),
        Action = action(A, Asked, Ground),
        findall(Name/Arity,
                ( Ground = ground(_, Effects),
                  member(effect(V, F, _), Effects),
                  value_added(F, V, M),
                  functor(F, Name, Arity) ),
                New),
        append(New, More1, More)
    ),
    round(Actions0, Changed, Actions, More1, M, Effort).

grounded_action(A, M, Ground) :-
    (   ground_action(A, M, If, Effects)
    ->  Ground = ground(If, Effects)
    ;   Ground = none
    ).

%   with_facts(+Module, +Ground0, -Ground) is semidet: effects on fluents
%   become effects on facts. A value that becomes true makes others false.
%   Fails if a fluent would have two values.

with_facts(M, ground(A, If, Effects), ground(A, If, Facts)) :-
    \+ ( append(_, [effect(V1, F, E1)|Others], Effects),
         \+ is_relation(F, M),
         member(effect(V2, F, E2), Others),
         V1 \== V2,
         \+ exclude(E1, E2) ),
    findall(effect(Truth, Fact, E),
            ( member(effect(V, F, E), Effects),
              (   is_relation(F, M)
              ->  Truth = V,
                  Fact = F
              ;   possible_value(F, V0),
                  Fact = (F = V0),
                  (   V0 == V
                  ->  Truth = true
                  ;   Truth = false,
                      (   has_agents(M)
                      ->  true          % Another one may make it true.
                      ;   \+ exclude(Fact, E),
                          \+ exclude(Fact, If)
                      )
                  )
              ) ),
            Facts).

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

numbered_actions([], _, _, [], Numbers, Numbers).
numbered_actions([ground(A, Condition, Effects)|Grounds], Costs, M,
                 [action(ConditionOfNumbers, NativeEffects, Cost)|Natives],
                 Numbers0, Numbers) :-
    cost(Costs, A, M, Cost),
    numbered(Condition, ConditionOfNumbers, Numbers0, Numbers1),
    numbered_effects(Effects, NativeEffects, Numbers1, Numbers2),
    numbered_actions(Grounds, Costs, M, Natives, Numbers2, Numbers).

numbered_rules([], [], Numbers, Numbers).
numbered_rules([rule(F, Condition)|Rules0], [rule(Fact, NativeIf)|Rules],
               Numbers0, Numbers) :-
    all_numbered([F, Condition], [Fact, NativeIf], Numbers0, Numbers1),
    numbered_rules(Rules0, Rules, Numbers1, Numbers).

numbered_effects([], [], Numbers, Numbers).
numbered_effects([effect(Truth, F, If)|Effects],
                 [effect(Truth, Fact, Condition)|Natives],
                 Numbers0, Numbers) :-
    all_numbered([F, If], [Fact, Condition], Numbers0, Numbers1),
    numbered_effects(Effects, Natives, Numbers1, Numbers).

%   concurrent(+Agents, +Names, +Module, +Always, -Concurrent) is det:
%   Concurrent is that of planner_new_/3. Names are the actions, in the order
%   of their numbers.

concurrent(Agents, Names, M, Always, Concurrent) :-
    (   Agents == by_turns,
        \+ has_step_rules(M)
    ->  Concurrent = none
    ;   Concurrent = concurrent(Numbers, Needs, Excludes, Always),
        findall(R, M:agent(R), Rs0),
        sort(Rs0, Rs),
        findall(Number,
                ( member(A, Names), agent_number(Agents, A, Rs, M, Number) ),
                Numbers),
        by_functor(Names, Index),
        findall(I-Others,
                ( named(A, I, Index),
                  needed(A, Other, M),
                  findall(J, ( named(Other, J, Index), Other \== A ),
                          Others) ),
                Needs),
        findall(I-J,
                ( Agents == at_once,
                  clause(M:excludes(A, B), Body),
                  named(A, I, Index),
                  named(B, J, Index),
                  I \== J,
                  \+ \+ call(M:Body) ),
                Excludes)
    ).

agent_number(Agents, A, Rs, M, Number) :-
    (   Agents == at_once,
        agent_of(A, R, M),
        nth0(Number0, Rs, R)
    ->  Number = Number0
    ;   Number = none
    ).

%   by_functor(+Names, -Index), named(?Action, -Number, +Index): as nth0/3,
%   but only actions of the same functor are compared.

by_functor(Names, Index) :-
    findall(Functor-(Number-A),
            ( nth0(Number, Names, A), functor_of(A, Functor) ),
            Pairs0),
    keysort(Pairs0, Pairs),
    group_pairs_by_key(Pairs, Groups),
    list_to_assoc(Groups, Index).

named(A, Number, Index) :-
    (   var(A)
    ->  gen_assoc(_, Index, Group)
    ;   functor_of(A, Functor),
        get_assoc(Functor, Index, Group)
    ),
    member(Number-A, Group).

functor_of(A, Name/Arity) :-
    functor(A, Name, Arity).

%!  cost(+Costs, +Action, +Module, -Cost) is det.
%
%   @error domain_error(action_cost, Action) if action_cost/2 has no whole
%          number for it

cost(Costs, A, M, Cost) :-
    (   Costs == true,
        has_clauses(M, action_cost(_, _))
    ->  (   M:action_cost(A, Cost0),
            number(Cost0),
            Cost is truncate(Cost0),
            Cost =:= Cost0,
            between(0, 1000000000, Cost)
        ->  true
        ;   located(M, clause([action_cost(A, _), prim_action(A)]), Where),
            format(atom(Text), '~waction_cost/2 has no whole number from 0 \c
                                on for it', [Where]),
            throw_error(domain_error(action_cost, A), _, Text)
        )
    ;   Cost = 1
    ).

%!  task_plan(+Task, +Shortest, +Effort, -Plan) is semidet.
%
%   Plan is a list of actions, or of steps of several actions; a cheapest one
%   if Shortest is true.

task_plan(task(Actions, Native), Shortest, Effort, Plan) :-
    setup_call_cleanup(planner_new_(Native, Shortest, Planner),
                       planned(Planner, 0, Effort, Numbers),
                       planner_end_(Planner)),
    maplist(named_step(Actions), Numbers, Plan).

named_step(Actions, Numbers, Step) :-
    (   is_list(Numbers)
    ->  maplist(named_step(Actions), Numbers, Step0),
        sort(Step0, Step)
    ;   At is Numbers+1,
        arg(At, Actions, Step)
    ).

%   The planner works in pieces that take a computer half a millisecond, and
%   a brick some thirty.

planned(Planner, States0, Effort, Plan) :-
    planner_work_(Planner, 50000, Progress, States),
    let_page_in,
    New is States-States0,
    counted_natively(New, 10000, Effort),
    polled(Effort),
    (   Progress == working
    ->  planned(Planner, States, Effort, Plan)
    ;   Progress = gave_up(Limit)
    ->  effort_id(Effort, Id),
        throw('$golog_gave_up'(Id, Limit))
    ;   Progress = plan(Plan)
    ->  true
    ;   Progress = steps(Plan)
    ).
