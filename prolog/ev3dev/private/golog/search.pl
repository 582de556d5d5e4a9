:- module(ev3dev_golog_search,
          [ replanned_since/1,          % -Program
            found_path/4                % +Module, +Start, +End, -Moves
          ]).
:- use_module(library(assoc), [empty_assoc/1, list_to_assoc/2]).
:- use_module(library(lists), [append/2, append/3, member/2]).
:- use_module(context,
              [ context_effort/2, context_module/2, context_option/2,
                gave_up/2, searching/4
              ]).
:- use_module(branches, [branch_on/3, opened/4, sensed_later/4]).
:- use_module(conditions, [holds/3]).
:- use_module(progression, [done/4]).
:- use_module(situation,
              [assumed/3, marked/3, situation_count/2, situation_history/2]).
:- use_module(values, [fluents_now/3]).
:- use_module(effort, [counted/2, effort_id/2, how_far/2, polled/1]).
:- use_module(visited_states, [state_key/4, states_forgotten/1, tried/5]).
:- use_module(planning_task, [cost/4, task/7, task_plan/4]).
:- use_module(steps, [agent_of/3, step_after/5]).
:- use_module(theory,
              [ has_agents/1, has_clauses/2, has_step_rules/1, is_kind/3,
                is_sensing_action/2, located/3
              ]).
:- use_module(transitions, [in_atom/3, is_final/3, is_possible/3, step/5]).
:- use_module('../errors/errors', [domain_error/2, throw_error/3]).
:- use_module(simulated, [simulation_kept/1, tried_in_simulator/5]).

/** <module> Search: plans that are found before they are carried out

search(E) looks for a whole run of E, depth first, in the order in which the
program offers its steps, and takes the first step of it. What remains is

    '$path'(Program, Path, at(Count, Top)-Options)

A Path is a list of p(Program, Entry): the programs to come, and what each
step adds to the history, or `none`. As long as the history grows by the
plan's own steps only, the plan is followed. Otherwise, as after an exogenous
action, the search begins again, with the program that remains.

If the search goes deeper than a limit, or takes more steps than a limit, it
begins again by iterative deepening. At a limit of gives_up/1 it fails, and so
does its deepening.

Sources: De Giacomo, Levesque: An incremental interpreter for high-level
programs with sensing (1999); Sardina: Local conditional high-level robot
programs (2001) for conditional plans.
*/

ev3dev_golog_transitions:step_construct(search(E), S, E1, S1, X) :-
    search_step(E, [], S, E1, S1, X).
ev3dev_golog_transitions:step_construct(search(E, M), S, E1, S1, X) :-
    (   is_options(M)
    ->  search_step(E, M, S, E1, S1, X)
    ;   search_step(E, [message(M)], S, E1, S1, X)
    ).
ev3dev_golog_transitions:step_construct(search(E, M, Options), S,
                                        E1, S1, X) :-
    search_step(E, [message(M)|Options], S, E1, S1, X).
ev3dev_golog_transitions:step_construct(searchn(E, _), S, E1, S1, X) :-
    search_step(E, [], S, E1, S1, X).
ev3dev_golog_transitions:step_construct(searchc(E), S, Plan, S, X) :-
    conditional_plan(E, [], S, Plan, X).
ev3dev_golog_transitions:step_construct(searchc(E, M), S, Plan, S, X) :-
    (   is_options(M)
    ->  conditional_plan(E, M, S, Plan, X)
    ;   conditional_plan(E, [], S, Plan, X)
    ).
ev3dev_golog_transitions:step_construct('$path'(E, Path, At, Options), S,
                                        E1, S1, X) :-
    path_step(E, Path, At-Options, S, E1, S1, X).
ev3dev_golog_transitions:step_construct(achieve(Goal), S, E1, S1, X) :-
    achieve_step(Goal, [], achieve(Goal), S, E1, S1, X).
ev3dev_golog_transitions:step_construct(achieve(Goal, Options), S,
                                        E1, S1, X) :-
    achieve_step(Goal, Options, achieve(Goal, Options), S, E1, S1, X).

ev3dev_golog_transitions:ends('$path'(E, Path, At, _), S, X) :-
    path_is_final(E, Path, At, S, X).
ev3dev_golog_transitions:ends(achieve(Goal), S, X) :-
    is_achieved(Goal, S, X).
ev3dev_golog_transitions:ends(achieve(Goal, _), S, X) :-
    is_achieved(Goal, S, X).

rules(X, M) :-
    context_module(X, M),
    Rule = rule(_, _, _),
    has_clauses(M, Rule),
    \+ predicate_property(M:Rule, built_in).   % rule/3 of SWI-Prolog 9

rule_of(M, Goal, Guard, Body) :-
    Rule = rule(Goal, Guard, Body),
    M:Rule.

is_options(Options) :-
    is_list(Options),
    Options \== [],
    \+ ( member(Option, Options),
         \+ is_search_option(Option) ).

is_search_option(Option) :-
    compound(Option),
    functor(Option, Name, 1),
    memberchk(Name, [depth, steps, gives_up, timeout, simulate, message]).

%   search_step(+Program0, +Options, +Situation0, -Program, -Situation,
%   +Context) is nondet.

search_step(E, Options, S, E1, S1, X) :-
    (   memberchk(simulate(true), Options)
    ->  simulation_kept(search_committed(E, Options, S, Path, X))
    ;   search_committed(E, Options, S, Path, X)
    ),
    path_begun(E, Path, Options, S, E1, S1, X).

search_committed(E, Options, S, Path, X0) :-
    offline(X0, Options, X),
    limited(search_path(E, Options, S, Path, X),
            [search(E), search(E, _), search(E, _, _), searchn(E, _)], X).

%   limited(:Goal, +Constructs, +Context) is nondet.
%   Goal is a search with Context, for one of Constructs. It fails when it
%   gives up.

:- meta_predicate limited(0, +, +).

limited(Goal, Constructs, X) :-
    context_effort(X, Effort),
    effort_id(Effort, Id),
    catch(catch(Goal, '$golog_committed', fail),
          '$golog_gave_up'(Id, Limit),
          gives_up(Limit, Effort, Constructs, X)).

gives_up(Limit, Effort, Constructs, X) :-
    how_far(Effort, Far),
    gave_up(Limit, Far),
    context_module(X, M),
    located(M, in_program(Constructs), Where),
    print_message(informational, golog(gave_up(Where, Limit, Far))),
    fail.

%   offline(+Context0, +Options, -Context) is det.

offline(X0, Options, X) :-
    (   context_option(assume, X0)
    ->  Words0 = [assume]
    ;   Words0 = []
    ),
    (   memberchk(simulate(true), Options)
    ->  Words1 = [simulate|Words0]
    ;   Words1 = Words0
    ),
    (   ( memberchk(conditional, Options) ; context_option(conditional, X0) )
    ->  Words = [conditional|Words1]
    ;   Words = Words1
    ),
    findall(Limit, ( member(Option, Options), limit_of(Option, Limit) ),
            Limits),
    searching(Words, Limits, X0, X).

limit_of(timeout(Seconds), seconds(Seconds)) :-
    must_be_limit(Seconds, timeout(Seconds)).
limit_of(gives_up(Limit), Limit) :-
    (   nonvar(Limit),
        Limit =.. [Name, Most],
        memberchk(Name, [steps, inferences, seconds])
    ->  must_be_limit(Most, gives_up(Limit))
    ;   domain_error(golog_option, gives_up(Limit))
    ).

must_be_limit(Most, Option) :-
    (   number(Most),
        Most >= 0
    ->  true
    ;   domain_error(golog_option, Option)
    ).

path_begun(_, [p(E1, Entry)|Path], Options, S, E2, S1, X) :-
    (   dropped(Entry),
        context_option(online, X)
    ->  S1 = S
    ;   with_entry(Entry, S, S1, X)
    ),
    E2 = '$path'(E1, Path, At, Options),
    at(S1, At).

at(S, at(Count, Top)) :-
    situation_count(S, Count),
    situation_history(S, History),
    (   History = [Top|_]
    ->  true
    ;   Top = none
    ).

with_entry(none, S, S, _) :-
    !.
with_entry(Entry, S0, S, X) :-
    (   is_mark(Entry)
    ->  marked(Entry, S0, S)
    ;   done(Entry, S0, S, X)
    ).

is_mark(wait).
is_mark(abort).
is_mark(branch(_)).
is_mark(test(_)).

%!  path_step(+E0, +Path, +AtOptions, +S0, -E, -S, +Context) is nondet.

path_step(E, Path, At-Options, S, E1, S1, X) :-
    (   on_track(At, S)
    ->  path_begun(E, Path, Options, S, E1, S1, X)
    ;   replanned(E, X),
        (   Options == achieve
        ->  step(E, S, E1, S1, X)
        ;   search_step(E, Options, S, E1, S1, X)
        )
    ).

on_track(at(Count, Top), S) :-
    at(S, at(Count, Top1)),
    Top1 == Top.

%   path_is_final(+Program, +Path, +At, +Situation, +Context) is semidet.

path_is_final(E, Path, At, S, X) :-
    (   on_track(At, S)
    ->  Path == []
    ;   is_final(E, S, X)
    ).

%!  replanned_since(-Program) is nondet.
%
%   Program is one that an online run has searched again since this was asked
%   last.

:- thread_local replanned_/1.

replanned(E, X) :-
    (   \+ context_option(online, X)
    ->  true
    ;   replanned_(E0),
        E0 =@= E
    ->  true
    ;   assertz(replanned_(E))
    ).

replanned_since(E) :-
    retract(replanned_(E)).

% ---------------- DEPTH FIRST

%   search_path(+Program, +Options, +Situation, -Path, +Context) is nondet.

search_path(E, Options, S, Path, X) :-
    told(Options, begin),
    limit(depth, Options, 2000, Depth),
    limit(steps, Options, 100000, Steps),
    context_effort(X, Effort),
    effort_id(Effort, Id),
    Budget = budget(Steps, Depth, Id, Effort),
    Found = found(no),
    (   call_cleanup(
            catch(deep(E, S, Path, 0, Budget, X), '$golog_deepen'(Id),
                  ( arg(1, Found, no),
                    deepened(8, E, S, Path, X) )),
            states_forgotten(Effort)),
        nb_setarg(1, Found, yes),
        states_forgotten(Effort),
        told(Options, found)
    ;   arg(1, Found, no),
        told(Options, none),
        fail
    ).

limit(Name, Options, Default, Limit) :-
    functor(Option, Name, 1),
    (   memberchk(Option, Options)
    ->  arg(1, Option, Limit)
    ;   Limit = Default
    ).

%   deep(+Program, +Situation, -Path, +Depth, +Budget, +Context) is nondet.
%   After a step that `commit` marks there is no way back.

deep(E, S, Path, Depth, Budget, X) :-
    (   is_final(E, S, X),
        Path = []
    ;   one_more(Depth, Budget),
        searched_step(E, S, E1, S1, Entry, X),
        Depth1 is Depth+1,
        (   Entry == commit
        ->  Path = [p(E1, none)|Path1],
            (   deep(E1, S1, Path1, Depth1, Budget, X)
            ->  true
            ;   throw('$golog_committed')
            )
        ;   Path = [p(E1, Entry)|Path1],
            (   Entry \== none,
                state_key(E1, S1, X, Key)
            ->  tried(deep(E1, S1, Path1, Depth1, Budget, X),
                      Key, inf, none, X)
            ;   deep(E1, S1, Path1, Depth1, Budget, X)
            )
        )
    ).

one_more(Depth, Budget) :-
    Budget = budget(Steps0, Deepest, Id, Effort),
    counted(Depth, Effort),
    Steps is Steps0-1,
    nb_setarg(1, Budget, Steps),
    (   Steps >= 0,
        Depth < Deepest
    ->  true
    ;   throw('$golog_deepen'(Id))
    ).

searched_step(E, S, E1, S1, Entry, X) :-
    step(E, S, E1, S2, X),
    entry_since(S, S2, Entry),
    (   Entry \== none,
        context_option(simulate, X)
    ->  tried_in_simulator(Entry, S, S2, S1, X)
    ;   S1 = S2
    ).

entry_since(S0, S, Entry) :-
    situation_count(S0, C0),
    situation_count(S, C),
    (   C =:= C0
    ->  Entry = none
    ;   situation_history(S, [Entry|_])
    ).

%   What an online run drops from the history. A search around this one keeps
%   it: the rest of the plan relies on it.

dropped(Entry) :-
    nonvar(Entry),
    ( Entry = sim(_) ; Entry = branch(_) ),
    !.

%   Iterative deepening; each limit is half as large again as the last.

deepened(Limit, E, S, Path, X) :-
    context_effort(X, Effort),
    Cut = cut(false, Limit, Effort),
    (   within(E, S, Path0, 0, Cut, X)
    ->  Path = Path0
    ;   arg(1, Cut, true),
        Limit1 is Limit + Limit // 2,
        deepened(Limit1, E, S, Path, X)
    ).

within(E, S, Path, Depth, Cut, X) :-
    (   is_final(E, S, X),
        Path = []
    ;   Cut = cut(_, Limit, Effort),
        counted(Depth, Effort),
        (   Depth < Limit
        ->  true
        ;   nb_setarg(1, Cut, true),
            fail
        ),
        searched_step(E, S, E1, S1, Entry, X),
        Depth1 is Depth+1,
        (   Entry == commit
        ->  Path = [p(E1, none)|Path1],
            (   within(E1, S1, Path1, Depth1, Cut, X)
            ->  true
            ;   arg(1, Cut, true)
            ->  fail
            ;   throw('$golog_committed')
            )
        ;   Path = [p(E1, Entry)|Path1],
            (   Entry \== none,
                state_key(E1, S1, X, Key)
            ->  Left is Limit-Depth1,
                tried(within(E1, S1, Path1, Depth1, Cut, X),
                      Key, Left, Cut, X)
            ;   within(E1, S1, Path1, Depth1, Cut, X)
            )
        )
    ).

told(Options, What) :-
    (   memberchk(message(Message), Options)
    ->  print_message(informational, golog(search(What, Message)))
    ;   true
    ).

% ---------------- CONDITIONAL PLANS

%   conditional_plan(+Program, +Options, +Situation, -Plan, +Context) is
%   nondet.
%
%   Plan is a program of actions, tests and if/3 that runs Program to its end
%   from Situation, whatever its actions sense, and whatever the conditions of
%   its branch/1 turn out to be. It keeps each sim/1, so that a search around
%   it can follow it, and holds together what an atomic/1 does.

conditional_plan(E, Options, S, Plan, X0) :-
    offline(X0, [conditional|Options], X),
    limited(planned(E, S, 0, Plan, X), [searchc(E), searchc(E, _)], X).

planned(E, S, Depth, Plan, X) :-
    context_effort(X, Effort),
    counted(Depth, Effort),
    decided(next(E, S, Next, X), Next, X),
    Depth1 is Depth+1,
    (   Next == final
    ->  Plan = []
    ;   Next = branch(Cases)
    ->  all_planned(Cases, E, S, Depth1, Plans, X),
        same_or_branches(Plans, Plan)
    ;   Next = step(E1, S1),
        entry_since(S, S1, Entry),
        planned_after(Entry, E1, S, S1, Depth1, Plan, X)
    ).

next(E, S, final, X) :-
    is_final(E, S, X).
next(E, S, step(E1, S1), X) :-
    step(E, S, E1, S1, X).

%   decided(:Goal, ?Next, +Context) is nondet: as Goal. If it depends on what
%   is still to be sensed, Next is branch(Cases).

:- meta_predicate decided(0, -, +).

decided(Goal, Next, X) :-
    catch(catch(Goal, '$golog_unknown'(F), branch_on(F, none, X)),
          '$golog_branch'(Cases), Next = branch(Cases)).

all_planned([], _, _, _, [], _).
all_planned([Test-Case|Cases], E, S0, Depth, [Test-Plan|Plans], X) :-
    assumed(Case, S0, S),
    planned(E, S, Depth, Plan, X),
    all_planned(Cases, E, S0, Depth, Plans, X).

same_or_branches(Plans, Plan) :-
    (   Plans = [_-Plan0|Rest],
        \+ ( member(_-Other, Rest), Other \== Plan0 )
    ->  Plan = Plan0
    ;   branches(Plans, Plan)
    ).

%   The last of several values is tested, too, in case the world has another.

branches([Test-Plan0|Plans], Plan) :-
    (   Plans == []
    ->  Plan = [?(Test)|Plan0]
    ;   Plans = [else-Else]
    ->  Plan = [if(Test, Plan0, Else)]
    ;   branches(Plans, Else),
        Plan = [if(Test, Plan0, Else)]
    ).

planned_after(none, E, _, S, Depth, Plan, X) :-
    !,
    planned(E, S, Depth, Plan, X).
planned_after(branch(P), E, S0, _, Depth, Plan, X) :-
    !,
    opened(P, S0, S, X),
    planned_branch(P, E, S, Depth, Plan, X).
planned_after(commit, E, S, _, Depth, Plan, X) :-
    !,
    (   planned(E, S, Depth, Plan, X)
    ->  true
    ;   throw('$golog_committed')
    ).
planned_after(test(P), E, S, _, Depth, Plan, X) :-
    !,
    planned_after(?(P), E, S, S, Depth, Plan, X).
planned_after(A, E, _, S0, Depth, Plan, X) :-
    sensed_later(A, S0, S, X),
    planned(E, S, Depth, Plan1, X),
    (   Plan1 = [B|Bs],
        decided(in_atom(E, S, X), _, X)
    ->  Plan = [atomic([A, B])|Bs]
    ;   Plan = [A|Plan1]
    ).

%   Branch on each part of the condition P that decides it.

planned_branch(P, E, S, Depth, Plan, X) :-
    decided(( holds(P, S, X) -> true ; true ), Next, X),
    (   nonvar(Next)
    ->  Next = branch(Cases),
        branches_planned(Cases, P, E, S, Depth, Plans, X),
        branches(Plans, Plan)
    ;   planned(E, S, Depth, Plan, X)
    ).

branches_planned([], _P, _E, _S, _Depth, [], _X).
branches_planned([Test-Case|Cases], P, E, S0, Depth, [Test-Plan|Plans], X) :-
    assumed(Case, S0, S),
    planned_branch(P, E, S, Depth, Plan, X),
    branches_planned(Cases, P, E, S0, Depth, Plans, X).

% ---------------- ACHIEVE

%   achieve_step(+Goal, +Options, +Program0, +Situation0, -Program,
%   -Situation, +Context) is nondet.
%
%   Take the first step of a plan of primitive actions after which the
%   condition Goal holds, or as the rules of the domain say. The native
%   planner finds the plan, or, if the domain is not for that,
%   library(ev3dev/planners).

achieve_step(Goal, Options, E, S, E1, S1, X) :-
    must_be_achieve_options(Options),
    (   rules(X, M)
    ->  rule_of(M, Goal, Guard, Body),
        holds(Guard, S, X),
        step(Body, S, E1, S1, X)
    ;   \+ holds(Goal, S, X),
        offline(X, Options, X1),
        limited(achieving_plan(Goal, Options, S, Plan, X1),
                [achieve(Goal), achieve(Goal, _)], X1),
        achieving(Plan, E, Path),
        path_begun(E, Path, achieve, S, E1, S1, X)
    ).

must_be_achieve_options(Options) :-
    (   is_list(Options),
        \+ ( member(Option, Options), \+ is_achieve_option(Option) ),
        \+ ( memberchk(concurrent(true), Options),
             memberchk(cheapest(true), Options) )
    ->  true
    ;   domain_error(golog_option, Options)
    ).

is_achieve_option(Option) :-
    compound(Option),
    (   ( Option = shortest(Truth) ; Option = cheapest(Truth)
        ; Option = concurrent(Truth) )
    ->  nonvar(Truth),
        memberchk(Truth, [true, false])
    ;   functor(Option, Name, 1),
        memberchk(Name, [gives_up, timeout])
    ).

is_achieved(Goal, S, X) :-
    (   rules(X, M)
    ->  rule_of(M, Goal, Guard, Body),
        holds(Guard, S, X),
        is_final(Body, S, X)
    ;   holds(Goal, S, X)
    ).

achieving_plan(Goal, Options, S, Plan, X) :-
    context_effort(X, Effort),
    context_module(X, M),
    fluents_now(S, X, Values),
    (   memberchk(cheapest(true), Options)
    ->  Costs = true,
        Method0 = dijkstra
    ;   Costs = false,
        Method0 = breadth_first
    ),
    (   memberchk(concurrent(true), Options)
    ->  must_have_agents(M),
        Agents = at_once,
        Method = dijkstra
    ;   Agents = by_turns,
        Method = Method0
    ),
    (   \+ ( Costs == true, has_step_rules(M) ),
        task(M, Goal, Values, Costs, Agents, Effort, Task)
    ->  (   Costs == false,
            memberchk(shortest(false), Options)
        ->  Shortest = false
        ;   Shortest = true
        ),
        task_plan(Task, Shortest, Effort, Plan0),
        plan_of(Agents, Plan0, Plan)
    ;   planner_loaded,
        Problem = problem(state(Values), goal,
                          [ successor(ev3dev_golog_search:
                                          successor(Goal, Costs, Agents,
                                                    X)) ]),
        ev3dev_search:plan(Method, Problem, Plan0),
        append(Plan, [end], Plan0)
    ),
    Plan = [_|_].

%   Rules of steps hold for single actions, too: these are steps of one.

plan_of(Agents, Plan0, Plan) :-
    (   Agents == by_turns,
        Plan0 = [[_|_]|_]
    ->  append(Plan0, Plan)
    ;   Plan = Plan0
    ).

must_have_agents(M) :-
    (   has_agents(M)
    ->  true
    ;   located(M, in_program([achieve(_, _)]), Where),
        format(atom(Text), '~wthe domain has no agent/1: it does not say \c
                            who acts', [Where]),
        throw_error(domain_error(golog_option, concurrent(true)), _, Text)
    ).

%!  found_path(+Module, +Start, +End, -Moves) is semidet.
%
%   Moves is a shortest list of moves from state Start to End, by A*.
%   pathfind_move/3 (State, Next, Move) and pathfind_heuristic/3 (State, Goal,
%   Estimate) of Module say what leads where, and how far it is at least.

found_path(Module, Start, End, Moves) :-
    planner_loaded,
    ev3dev_search:plan(a_star,
                       problem(Start, End,
                               [ successor(ev3dev_golog_search:
                                               move_of(Module)),
                                 heuristic(Module:pathfind_heuristic) ]),
                       Moves).

:- public move_of/5.

move_of(Module, State, Move, Next, 1) :-
    call(Module:pathfind_move(State, Next, Move)).

planner_loaded :-
    module_property(ev3dev_golog_search, file(Here)),
    file_directory_name(Here, Directory),
    atom_concat(Directory, '/../../planners/search', Planners),
    load_files(ev3dev_golog_search:Planners,
               [if(not_loaded), imports([])]).

achieving([], _, []).
achieving([A|As], E, [p(E, A)|Path]) :-
    achieving(As, E, Path).

state_of(S, X, state(Pairs)) :-
    fluents_now(S, X, Pairs).

situation_of(state(Pairs), situation([], 0, Values, [], Done)) :-
    valued(Pairs, Valued),
    list_to_assoc(Valued, Values),
    empty_assoc(Done).

valued([], []).
valued([F-V|Pairs], [F-v(0, V)|Valued]) :-
    valued(Pairs, Valued).

:- public successor/8.

successor(Goal, Costs, Agents, X, State0, Action, State, Cost) :-
    State0 = state(_),
    situation_of(State0, S0),
    (   holds(Goal, S0, X)
    ->  Action = end,
        State = goal,
        Cost = 1
    ;   context_effort(X, Effort),
        counted(0, Effort),
        context_module(X, M),
        (   Agents == at_once
        ->  possible_step(Action, S0, S, X, M),
            length(Action, Count),
            Cost is 1000000+Count       % fewest steps, then fewest actions
        ;   planned_action(Action, M, Effort),
            step(Action, S0, [], S, X),
            cost(Costs, Action, M, Cost0),
            Cost is Cost0*1000000+1     % a planner knows no cost of 0
        ),
        state_of(S, X, State)
    ).

planned_action(Action, M, Effort) :-
    call(M:prim_action(Action)),
    ground(Action),
    polled(Effort),
    is_kind(precondition, Action, M),
    \+ is_sensing_action(Action, M).

%   possible_step(-Step, +Situation0, -Situation, +Context, +Module) is
%   nondet: for each agent an action that is possible, or none; or an action
%   of no agent.

possible_step(Step, S0, S, X, M) :-
    context_effort(X, Effort),
    findall(R-A,
            ( planned_action(A, M, Effort),
              is_possible(A, S0, X),
              ( agent_of(A, R0, M) -> R = by(R0) ; R = nobody ) ),
            Pairs0),
    sort(Pairs0, Pairs),
    findall(A, member(nobody-A, Pairs), Alone),
    findall(R, member(by(R)-_, Pairs), Rs0),
    sort(Rs0, Rs),
    (   member(A, Alone),
        Step0 = [A]
    ;   one_of_each(Rs, Pairs, Step0)
    ),
    polled(Effort),
    Step0 = [_|_],
    sort(Step0, Step),
    step_after(Step, S0, S, Why, X),
    var(Why).

one_of_each([], _, []).
one_of_each([R|Rs], Pairs, Step) :-
    (   member(by(R)-A, Pairs),
        Step = [A|Step1]
    ;   Step = Step1
    ),
    one_of_each(Rs, Pairs, Step1).
