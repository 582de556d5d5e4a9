:- module(ev3dev_golog_relaxed,
          [ task/5,                     % +Module, +Goal, +Values, +Effort,
                                        % -Task
            task_plan/4                 % +Task, +Shortest, +Effort, -Plan
          ]).
:- use_module('../basics/fields',
              [fields/1, goal_expansion/2, term_expansion/2]).
:- use_module(library(assoc),
              [empty_assoc/1, get_assoc/3, list_to_assoc/2, put_assoc/4]).
:- use_module(library(heaps),
              [add_to_heap/4, empty_heap/1, get_from_heap/4]).
:- use_module(library(lists), [append/3, member/2, reverse/2]).
:- use_module(effort, [counted/2, polled/1]).
:- use_module(ground,
              [ ground_action/4, ground_actions/2, ground_condition/3,
                only_relations/1
              ]).
:- use_module(theory, [has_clauses/2, has_possible_values/1]).
:- use_module('../errors/errors', [throw_error/3]).

:- fields(task(known, ops, rules, counters, uses, free)).
:- fields(known(count, denied, goal, state)).
:- fields(op(action, mask, add, delete, changes)).

/** <module> Plans for domains whose fluents are true or false

A state is an integer, a bit for each fluent that a condition asks for. Fact I
is that fluent I holds, I+N that it does not; the latter only if a condition
asks for that. A condition is a mask of facts, after the disjunctive normal
form. An action is an

    op(Action, Mask, Add, Delete, Changes)

for each conjunction of its precondition, with a change(Mask, Add, Delete) for
each conditional effect.

How far it is to the goal is estimated by a relaxed plan: one that does not
delete anything. It consists of rule(Op, Facts, NewFacts). Those of the
actions come first, so that rule I is of operator I; those of the goal last.

Source: Hoffmann, Nebel: The FF Planning System (2001): relaxed plans and
helpful actions. Helmert: The Fast Downward Planning System (2006): a state is
estimated when it is expanded. Keyder, Geffner: Heuristics for Planning with
Action Costs Revisited (2008): the reasons by their cost.
*/

%!  task(+Module, +Goal, +Values, +Effort, -Task) is semidet.
%
%   Task is to reach the condition Goal from Values, a list of Fluent-Value.
%   Fails if the domain has other fluents, or conditions that it does not
%   decide by itself.

task(M, Goal, Values, Effort, Task) :-
    catch(ground_task(M, Goal, Values, Effort, Task), error(Formal, Where),
          ( Formal = resource_error(_), throw(error(Formal, Where)) )).

ground_task(M, Goal, Values, Effort, Task) :-
    only_relations(M),
    \+ has_possible_values(M),
    \+ ( member(Head, [causes_val(_, _Fluent, _, _), forget(_, _)]),
         has_clauses(M, Head) ),
    \+ ( member(_-V, Values), V \== true, V \== false ),
    ground_condition(Goal, M, GoalCondition),
    conjunctions(GoalCondition, Goals),
    ground_actions(M, Actions),
    findall(ground(A, Conjunctions, Changes),
            ( member(A, Actions),
              polled(Effort),
              ground_action(A, M, Condition, Effects),
              conjunctions(Condition, Conjunctions),
              changes(Effects, Changes) ),
            Grounds),
    numbered(Grounds, Goals, Numbers, N, Denied),
    findall(Op, ( member(Ground, Grounds), operator(Ground, Numbers, Op) ),
            Ops0),
    findall(Mask, ( member(Literals, Goals), mask(Literals, Numbers, Mask) ),
            GoalMasks),
    findall(F, member(F-true, Values), True),
    bits_of(True, Numbers, State),
    Known = known(N, Denied, GoalMasks, State),
    with_rules(Ops0, Known, Task0),
    reachable(Task0, Ops0, Ops),
    with_rules(Ops, Known, Task).

%   conjunctions(+Expression, -Conjunctions): each a sorted list of F and
%   not(F).
%
%   @error domain_error(pddl_condition, Expression) if they are more than 500

conjunctions(E, Conjunctions) :-
    Count = count(0),
    findall(Literals,
            ( literals(E, true, [], Literals0),
              arg(1, Count, N0),
              N is N0+1,
              nb_setarg(1, Count, N),
              (   N > 500
              ->  throw_error(domain_error(pddl_condition, E), _, '')
              ;   true
              ),
              sort(Literals0, Literals),
              \+ ( member(not(F), Literals), memberchk(F, Literals) ) ),
            Conjunctions0),
    sort(Conjunctions0, Conjunctions).

literals(E, Truth, Ls0, Ls) :-
    (   memberchk(E, [true, false])
    ->  E == Truth,
        Ls = Ls0
    ;   E = [not, E1]
    ->  ( Truth == true -> Other = false ; Other = true ),
        literals(E1, Other, Ls0, Ls)
    ;   E = [Word|Es]
    ->  (   memberchk(Word-Truth, [and-true, or-false])
        ->  all_literals(Es, Truth, Ls0, Ls)
        ;   member(E1, Es),
            literals(E1, Truth, Ls0, Ls)
        )
    ;   Truth == true
    ->  Ls = [E|Ls0]
    ;   Ls = [not(E)|Ls0]
    ).

all_literals([], _, Ls, Ls).
all_literals([E|Es], Truth, Ls0, Ls) :-
    literals(E, Truth, Ls0, Ls1),
    all_literals(Es, Truth, Ls1, Ls).

%   changes(+Effects, -Changes): each is Literals-Truth-Fluent.

changes(Effects, Changes) :-
    findall(Literals-Truth-F,
            ( member(effect(Truth, F, E), Effects),
              conjunctions(E, Conjunctions),
              member(Literals, Conjunctions) ),
            Changes).

%   Denied has the bits of those fluents whose absence is a fact.

numbered(Grounds, Goals, Numbers, N, Denied) :-
    findall(Literal,
            ( (   member(Literals, Goals)
              ;   member(ground(_, Conjunctions, Changes), Grounds),
                  (   member(Literals, Conjunctions)
                  ;   member(Literals-_-_, Changes)
                  )
              ),
              member(Literal, Literals) ),
            Literals0),
    sort(Literals0, AllLiterals),
    findall(F, ( member(L, AllLiterals), ( L = not(F) -> true ; L = F ) ),
            Fs0),
    sort(Fs0, Fs),
    length(Fs, N),
    findall(F-I, nth(Fs, 0, F, I), Pairs),
    list_to_assoc(Pairs, Indices),
    Numbers = numbers(N, Indices),
    findall(F, member(not(F), AllLiterals), Negated),
    bits_of(Negated, Numbers, Denied).

nth([X|_], I, X, I).
nth([_|Xs], I0, X, I) :-
    I1 is I0+1,
    nth(Xs, I1, X, I).

mask([], _, 0).
mask([L|Ls], Numbers, Mask) :-
    mask(Ls, Numbers, Mask0),
    Numbers = numbers(N, Indices),
    (   L = not(F)
    ->  get_assoc(F, Indices, I),
        Mask is Mask0 \/ 1<<(I+N)
    ;   get_assoc(L, Indices, I),
        Mask is Mask0 \/ 1<<I
    ).

bits_of([], _, 0).
bits_of([F|Fs], Numbers, Bits) :-
    bits_of(Fs, Numbers, Bits0),
    Numbers = numbers(_, Indices),
    (   get_assoc(F, Indices, I)
    ->  Bits is Bits0 \/ 1<<I
    ;   Bits = Bits0
    ).

operator(ground(A, Conjunctions, Changes), Numbers,
         op(A, Mask, Add, Delete, Conditional)) :-
    findall(Literals, ( member(Literals-_-_, Changes), Literals \== [] ),
            Conditions0),
    sort(Conditions0, Conditions),
    change([], Changes, Numbers, change(_, Add, Delete)),
    findall(Change,
            ( member(Literals, Conditions),
              change(Literals, Changes, Numbers, Change),
              Change \= change(_, 0, 0) ),
            Conditional),
    \+ ( Add =:= 0, Delete =:= 0, Conditional == [] ),
    member(Conjunction, Conjunctions),
    mask(Conjunction, Numbers, Mask).

change(Literals, Changes, Numbers, change(Mask, Add, Delete)) :-
    mask(Literals, Numbers, Mask),
    findall(F, member(Literals-true-F, Changes), Adds),
    findall(F, member(Literals-false-F, Changes), Deletes),
    bits_of(Adds, Numbers, Add),
    bits_of(Deletes, Numbers, Delete).

% ---------------- RELAXED PLANS

%   with_rules(+Ops, +Known, -Task): Task is
%
%       task(Known, Ops, Rules, Counters, Uses, Free)
%
%   Ops and Rules are compound terms. Counters has the number of conditions of
%   each rule, Uses the rules that need a fact, which is an argument I+1. Free
%   are the rules that need none.

with_rules(Ops, Known, task(Known, OpsOf, RulesOf, Counters, Uses, Free)) :-
    Known = known(N, Denied, GoalMasks, _),
    GoalFact is 2*N,
    findall(rule(I, Facts, New),
            ( nth(Ops, 1, op(_, Mask, Add, Delete, _), I),
              rule_facts(Mask, 0, Add, Delete, N, Denied, Facts, New) ),
            Rules1),
    findall(rule(I, Facts, New),
            ( nth(Ops, 1, op(mask: Mask, changes: Changes), I),
              member(change(If, Add, Delete), Changes),
              rule_facts(Mask, If, Add, Delete, N, Denied, Facts, New) ),
            Rules2),
    findall(rule(goal, Facts, [GoalFact]),
            ( member(Mask, GoalMasks), facts(Mask, Facts) ),
            Rules3),
    append(Rules2, Rules3, Rules4),
    append(Rules1, Rules4, Rules),
    compound_name_arguments(OpsOf, ops, Ops),
    compound_name_arguments(RulesOf, rules, Rules),
    findall(Count, ( member(rule(_, Facts, _), Rules),
                     length(Facts, Count) ), Counts),
    compound_name_arguments(Counters, counters, Counts),
    findall(I, nth(Counts, 1, 0, I), Free),
    findall(Fact-I, ( nth(Rules, 1, rule(_, Facts, _), I),
                      member(Fact, Facts) ), Pairs0),
    keysort(Pairs0, Pairs),
    uses(0, GoalFact, Pairs, AllUses),
    compound_name_arguments(Uses, uses, AllUses).

rule_facts(Mask, If, Add, Delete, N, Denied, Facts, New) :-
    All is Mask \/ If,
    facts(All, Facts),
    NewMask is Add \/ (Delete /\ Denied)<<N,
    facts(NewMask, New).

uses(Fact, Last, Pairs, AllUses) :-
    (   Fact > Last
    ->  AllUses = []
    ;   AllUses = [Rules|AllUses1],
        of_fact(Pairs, Fact, Rules, Pairs1),
        Fact1 is Fact+1,
        uses(Fact1, Last, Pairs1, AllUses1)
    ).

of_fact(Pairs, Fact, Rules, Rest) :-
    (   Pairs = [Fact-I|Pairs1]
    ->  Rules = [I|Rules1],
        of_fact(Pairs1, Fact, Rules1, Rest)
    ;   Rules = [],
        Rest = Pairs
    ).

%   facts(+Mask, -Facts): the numbers of its bits

facts(Mask, Facts) :-
    (   Mask =:= 0
    ->  Facts = []
    ;   I is msb(Mask),
        Facts = [I|Facts1],
        Mask1 is Mask xor (1<<I),
        facts(Mask1, Facts1)
    ).

%   with_denied(+State, +Task, -Full): Full has all facts of State.

with_denied(State, Task, Full) :-
    Task = task(known: known(N, Denied, _, _)),
    (   Denied =:= 0
    ->  Full = State
    ;   Full is State \/ (\State /\ Denied)<<N
    ).

%   estimated(+Full, +Task, -Estimate, -Applicable, -Helpful) is semidet:
%   Applicable are the numbers of the operators that can be applied; argument
%   I of Helpful is bound if operator I is in the relaxed plan.
%   Fails if not even that reaches the goal.

estimated(Full, Task, Estimate, Applicable, Helpful) :-
    Task = task(known: Known, ops: Ops, rules: Rules),
    Known = known(count: N),
    started(Full, Task, Counters, Reasons, Fired),
    functor(Ops, _, OpCount),
    operators(Fired, OpCount, Applicable),
    GoalAt is 2*N+1,
    layers(Fired, Task, Counters, Reasons, GoalAt),
    functor(Rules, _, RuleCount),
    functor(Used, used, RuleCount),
    functor(Helpful, helpful, OpCount),
    arg(GoalAt, Reasons, _-Reason),
    arg(Reason, Rules, rule(_, Facts, _)),
    reasons(Facts, Rules, Reasons, Used, Helpful, 0, Estimate).

started(Full, task(Known, _, _, Counters0, Uses, Free),
        Counters, Reasons, Fired) :-
    Known = known(count: N),
    duplicate_term(Counters0, Counters),
    Last is 2*N+1,
    functor(Reasons, reasons, Last),
    facts(Full, Facts),
    given(Facts, Reasons),
    fired(Facts, Uses, Counters, Free, Fired).

given([], _).
given([Fact|Facts], Reasons) :-
    At is Fact+1,
    arg(At, Reasons, 0-0),
    given(Facts, Reasons).

%   A layer has the facts that the rules of the last layer add. The reason for
%   a fact is Cost-Rule: of the rules in the layer before it the one whose
%   facts cost least together. What holds already has the reason 0-0.

layers(Fired, Task, Counters, Reasons, GoalAt) :-
    Fired = [_|_],
    Task = task(rules: Rules, uses: Uses),
    costs(Fired, Rules, Reasons, Costs0),
    keysort(Costs0, Costs),
    added(Costs, Rules, Reasons, [], Facts),
    (   arg(GoalAt, Reasons, Reason),
        nonvar(Reason)
    ->  true
    ;   fired(Facts, Uses, Counters, [], Fired1),
        layers(Fired1, Task, Counters, Reasons, GoalAt)
    ).

fired([], _, _, Fired, Fired).
fired([Fact|Facts], Uses, Counters, Fired0, Fired) :-
    At is Fact+1,
    arg(At, Uses, Rules),
    counted_down(Rules, Counters, Fired0, Fired1),
    fired(Facts, Uses, Counters, Fired1, Fired).

counted_down([], _, Fired, Fired).
counted_down([Rule|Rules], Counters, Fired0, Fired) :-
    arg(Rule, Counters, Count0),
    Count is Count0-1,
    nb_setarg(Rule, Counters, Count),
    (   Count =:= 0
    ->  Fired1 = [Rule|Fired0]
    ;   Fired1 = Fired0
    ),
    counted_down(Rules, Counters, Fired1, Fired).

costs([], _, _, []).
costs([Rule|Fired], Rules, Reasons, [Cost-Rule|Costs]) :-
    arg(Rule, Rules, rule(_, Facts, _)),
    cost(Facts, Reasons, 1, Cost),
    costs(Fired, Rules, Reasons, Costs).

cost([], _, Cost, Cost).
cost([Fact|Facts], Reasons, Cost0, Cost) :-
    At is Fact+1,
    arg(At, Reasons, Cost1-_),
    Cost2 is Cost0+Cost1,
    cost(Facts, Reasons, Cost2, Cost).

added([], _, _, Facts, Facts).
added([Reason|Costs], Rules, Reasons, Facts0, Facts) :-
    Reason = _-Rule,
    arg(Rule, Rules, rule(_, _, New)),
    because(New, Reason, Reasons, Facts0, Facts1),
    added(Costs, Rules, Reasons, Facts1, Facts).

because([], _, _, Facts, Facts).
because([Fact|New], Reason, Reasons, Facts0, Facts) :-
    At is Fact+1,
    arg(At, Reasons, Reason0),
    (   var(Reason0)
    ->  Reason0 = Reason,
        Facts1 = [Fact|Facts0]
    ;   Facts1 = Facts0
    ),
    because(New, Reason, Reasons, Facts1, Facts).

operators([], _, []).
operators([Rule|Fired], OpCount, Ops) :-
    (   Rule =< OpCount
    ->  Ops = [Rule|Ops1]
    ;   Ops = Ops1
    ),
    operators(Fired, OpCount, Ops1).

reasons([], _Rules, _Reasons, _Used, _Helpful, Count, Count).
reasons([Fact|Facts], Rules, Reasons, Used, Helpful, Count0, Count) :-
    At is Fact+1,
    arg(At, Reasons, _-Rule),
    (   Rule =:= 0
    ->  Count2 = Count0
    ;   arg(Rule, Used, Mark),
        Mark == used
    ->  Count2 = Count0
    ;   arg(Rule, Used, used),
        arg(Rule, Rules, rule(Op, Facts1, _)),
        arg(Op, Helpful, Helps),
        (   var(Helps)
        ->  Helps = helps,
            Count1 is Count0+1
        ;   Count1 = Count0
        ),
        reasons(Facts1, Rules, Reasons, Used, Helpful, Count1, Count2)
    ),
    reasons(Facts, Rules, Reasons, Used, Helpful, Count2, Count).

%   reachable(+Task, +Ops0, -Ops): those that a relaxed plan can reach

reachable(Task, Ops0, Ops) :-
    Task = task(known: known(state: State)),
    with_denied(State, Task, Full),
    started(Full, Task, Counters, Reasons, Fired),
    \+ layers(Fired, Task, Counters, Reasons, 0),
    findall(Op, ( nth(Ops0, 1, Op, I), arg(I, Counters, 0) ), Ops).

% ---------------- SEARCH

%!  task_plan(+Task, +Shortest, +Effort, -Plan) is semidet.
%
%   Plan is a list of actions, a shortest one if Shortest is true.

task_plan(Task, Shortest, Effort, Plan) :-
    Task = task(known: known(state: State), ops: Ops),
    with_denied(State, Task, Full),
    estimated(Full, Task, Estimate, _, _),
    (   Shortest == true
    ->  by_fact(Task, ByFact),
        shortest([State-[]], [State], 0, Task, ByFact, Effort, Reversed)
    ;   empty_heap(Heap0),
        empty_assoc(Seen),
        add_to_heap(Heap0, Estimate, node(0, State, none, []), Heap),
        best_first(Heap, Seen, Task, Effort, Reversed)
    ),
    reverse(Reversed, Numbers),
    actions(Numbers, Ops, Plan).

actions([], _, []).
actions([I|Is], Ops, [A|As]) :-
    arg(I, Ops, op(action: A)),
    actions(Is, Ops, As).

reaches_goal(State, Task) :-
    with_denied(State, Task, Full),
    Task = task(known: known(goal: Masks)),
    member(Mask, Masks),
    Full /\ Mask =:= Mask,
    !.

applied(I, State, Full, Ops, State1) :-
    arg(I, Ops, op(_, _, Add0, Delete0, Changes)),
    changed(Changes, Full, Add0, Delete0, Add, Delete),
    State1 is State /\ \Delete \/ Add.

changed([], _, Add, Delete, Add, Delete).
changed([change(Mask, Add1, Delete1)|Changes], Full, Add0, Delete0,
        Add, Delete) :-
    (   Full /\ Mask =:= Mask
    ->  Add2 is Add0 \/ Add1,
        Delete2 is Delete0 \/ Delete1
    ;   Add2 = Add0,
        Delete2 = Delete0
    ),
    changed(Changes, Full, Add2, Delete2, Add, Delete).

%   by_fact(+Task, -ByFact): argument I+1 of ByFact has the operators whose
%   condition has fact I as its last, the last argument those that have none.

by_fact(Task, ByFact) :-
    Task = task(known: known(count: N), ops: Ops),
    findall(Fact-(I-Mask),
            ( arg(I, Ops, op(mask: Mask)),
              ( Mask =:= 0 -> Fact is 2*N ; Fact is msb(Mask) ) ),
            Pairs0),
    keysort(Pairs0, Pairs),
    Last is 2*N,
    uses(0, Last, Pairs, Lists),
    compound_name_arguments(ByFact, by_fact, Lists).

%   Breadth first, a layer of states at a time: State-Path, sorted, as are the
%   states Seen so far.

shortest(Layer, Seen, Depth, Task, ByFact, Effort, Path) :-
    Layer = [_|_],
    (   member(State-Path0, Layer),
        reaches_goal(State, Task)
    ->  Path = Path0
    ;   all_next(Layer, Depth, Task, ByFact, Effort, [], Next0),
        sort(1, @<, Next0, Next),
        unseen(Next, Seen, Layer1, Seen1),
        Depth1 is Depth+1,
        shortest(Layer1, Seen1, Depth1, Task, ByFact, Effort, Path)
    ).

all_next([], _Depth, _Task, _ByFact, _Effort, Next, Next).
all_next([State-Path|Layer], Depth, Task, ByFact, Effort, Next0, Next) :-
    counted(Depth, Effort),
    with_denied(State, Task, Full),
    Task = task(known: known(count: N), ops: Ops),
    Always is 2*N,
    facts(Full, Facts),
    of_facts([Always|Facts], ByFact, Ops, State, Full, Path, Next0, Next1),
    all_next(Layer, Depth, Task, ByFact, Effort, Next1, Next).

of_facts([], _ByFact, _Ops, _State, _Full, _Path, Next, Next).
of_facts([Fact|Facts], ByFact, Ops, State, Full, Path, Next0, Next) :-
    At is Fact+1,
    arg(At, ByFact, Candidates),
    next(Candidates, Ops, State, Full, Path, Next0, Next1),
    of_facts(Facts, ByFact, Ops, State, Full, Path, Next1, Next).

next([], _Ops, _State, _Full, _Path, Next, Next).
next([I-Mask|Candidates], Ops, State, Full, Path, Next0, Next) :-
    (   Full /\ Mask =:= Mask
    ->  applied(I, State, Full, Ops, State1),
        Next1 = [State1-[I|Path]|Next0]
    ;   Next1 = Next0
    ),
    next(Candidates, Ops, State, Full, Path, Next1, Next).

unseen([], Seen, [], Seen).
unseen([State-Path|Next], Seen0, Layer, Seen) :-
    unseen(Seen0, State, Path, Next, Layer, Seen).

unseen([], State, Path, Next, [State-Path|Layer], [State|Seen]) :-
    unseen(Next, [], Layer, Seen).
unseen([Old|Olds], State, Path, Next, Layer, Seen) :-
    (   Old < State
    ->  Seen = [Old|Seen1],
        unseen(Olds, State, Path, Next, Layer, Seen1)
    ;   Old =:= State
    ->  unseen(Next, [Old|Olds], Layer, Seen)
    ;   Layer = [State-Path|Layer1],
        Seen = [State|Seen1],
        unseen(Next, [Old|Olds], Layer1, Seen1)
    ).

%   First comes the state with the least sum of its depth and three times the
%   estimate of the state before it; an action that is not helpful counts as a
%   step more to go. A node(Depth, State, Operator, Path) is that of the state
%   after Operator.

best_first(Heap0, Seen0, Task, Effort, Path) :-
    get_from_heap(Heap0, _, node(Depth, State0, I, Path0), Heap1),
    Task = task(ops: Ops),
    (   I == none
    ->  State = State0,
        Path1 = Path0
    ;   with_denied(State0, Task, Full0),
        applied(I, State0, Full0, Ops, State),
        Path1 = [I|Path0]
    ),
    (   get_assoc(State, Seen0, _)
    ->  best_first(Heap1, Seen0, Task, Effort, Path)
    ;   reaches_goal(State, Task)
    ->  Path = Path1
    ;   counted(Depth, Effort),
        with_denied(State, Task, Full),
        put_assoc(State, Seen0, true, Seen),
        Depth1 is Depth+1,
        (   estimated(Full, Task, Estimate, Applicable, Helpful)
        ->  nodes(Applicable, Helpful, Estimate, Depth1, State, Path1,
                  Heap1, Heap)
        ;   Heap = Heap1
        ),
        best_first(Heap, Seen, Task, Effort, Path)
    ).

nodes([], _Helpful, _Estimate, _Depth, _State, _Path, Heap, Heap).
nodes([I|Is], Helpful, Estimate, Depth, State, Path, Heap0, Heap) :-
    arg(I, Helpful, Helps),
    (   nonvar(Helps)
    ->  Key is Depth+3*Estimate
    ;   Key is Depth+3*Estimate+3
    ),
    add_to_heap(Heap0, Key, node(Depth, State, I, Path), Heap1),
    nodes(Is, Helpful, Estimate, Depth, State, Path, Heap1, Heap).
