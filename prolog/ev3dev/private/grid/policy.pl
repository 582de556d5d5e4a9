:- module(ev3dev_grid_policy,
          [ grid_policy/2,              % :Options, -Policy
            grid_action/4               % +Policy, +State, -Action, -Cost
          ]).
:- use_module('../basics/fields',
              [fields/1, goal_expansion/2, term_expansion/2]).
:- use_module(library(assoc), [empty_assoc/1, get_assoc/3, put_assoc/4]).
:- use_module(library(heaps),
              [add_to_heap/4, get_from_heap/4, list_to_heap/2]).
:- use_module(library(lists), [member/2, nth0/3]).
:- use_module('../checks/arguments', [option/2, option/3, take_options/4]).
:- use_module('../checks/checks', [must_be/2]).
:- use_module('../errors/errors', [domain_error/2, throw_error/3]).
:- use_module('../errors/public_clauses', [term_expansion/4]).
:- use_module(compass).
:- use_module(map).
:- use_module(problem).

:- fields(policy(method, map, goal, costs)).

/** <module> Policies: what to do in each state of a grid

A plan is a sequence of actions, and of no use once the robot has left its
way. A policy, or feedback plan, says what to do in each state: a robot that
was pushed into another cell asks it again.

```
?- grid_policy([ rows([ "....",
                        ".##.",
                        "^#.." ]), goal([2,0]) ], Policy),
   grid_action(Policy, state([3,2], [0,1]), Action, Cost).
Action = right,
Cost = 90.
```

After Steven M. LaValle, Planning Algorithms, 2006, chapter 8.
*/

:- meta_predicate grid_policy(:, -).

%!  grid_policy(:Options, -Policy) is det.
%
%   Policy says for each state of a map how the robot gets to a goal from
%   there. Options are those of grid_map/2, and
%
%     - map(+Map)
%       Of grid_map/2, instead of its options.
%     - goal(+Goal)
%       A cell, or state(Cell, Direction). It must be given.
%     - method(+Method)
%
%         - value_iteration
%           The default. The cost to the goal of each state: of the moves and
%           of the turns. From each state the policy leads there at the least
%           cost.
%         - navigation_function
%           The cost of the moves alone, a number for each cell. It needs a
%           quarter of the memory, and of the time. From each cell the policy
%           leads there with the least cost of moves, and of such ways it
%           takes the first one that needs the fewest turns now.
%
%   What is free is asked when the policy is made.
%
%   @error existence_error(option, goal)
%   @error domain_error(grid_cell, Cell), domain_error(grid_state, State)
%   @error domain_error(policy_method, Method)
%   @error domain_error(grid_option, Option) for an option of neither
%   @error as grid_map/2

grid_policy(Module:Options, Policy) :-
    take_options([map, goal, method], Options, Own, MapOptions),
    (   option(map(Map), Own)
    ->  must_be(nonvar, Map),
        (   MapOptions = [Other|_]
        ->  domain_error(grid_option, Other)
        ;   true
        )
    ;   grid_map(Module:MapOptions, Map)
    ),
    option(method(Method), Own, value_iteration),
    (   option(goal(Goal0), Own)
    ->  goal_state(Goal0, Map, Goal)
    ;   throw_error(existence_error(option, goal), _,
                    'the option goal(Cell) is missing')
    ),
    costs_to(Method, Map, Goal, Costs),
    Policy = policy(Method, Map, Goal, Costs).

goal_state(Goal, Map, State) :-
    must_be(nonvar, Goal),
    (   Goal = state(Cell, Direction)
    ->  (   var(Direction)
        ->  must_be_cell(Cell)
        ;   must_be_state(Map, Goal)
        ),
        State = Goal
    ;   must_be_cell(Goal),
        State = state(Goal, _)
    ).

costs_to(Method, Map, Goal, Costs) :-
    must_be(atom, Method),
    Goal = state(Cell, _),
    (   \+ memberchk(Method, [value_iteration, navigation_function])
    ->  domain_error(policy_method, Method)
    ;   \+ free_cell(Map, Cell)
    ->  empty_assoc(Costs)
    ;   Method == value_iteration
    ->  findall(0-State, goal_of(Map, Goal, State), Ends),
        spread(Ends, before(Map), Costs)
    ;   spread([0-Cell], beside(Map), Costs)
    ).

goal_of(Map, state(Cell, Direction), state(Cell, Direction)) :-
    grid_direction(Map, Direction).

%   before(+Map, +State, -Before, -Cost) and beside(+Map, +Cell, -Before,
%   -Cost): from where one step leads there.

before(Map, State, Before, Cost) :-
    grid_problem(Map, State, State, problem(_, _, Options)),
    memberchk(predecessor(Previous), Options),
    call(Previous, State, _, Before, Cost).

beside(Map, Cell, Before, Cost) :-
    grid_direction(Map, Direction),
    before(Map, state(Cell, Direction), state(Before, Direction), Cost).

%   Value iteration in the order of the values: so each is computed once. (It
%   is Dijkstra's algorithm, from the goal backwards.)

spread(Ends, Before, Costs) :-
    list_to_heap(Ends, Heap),
    empty_assoc(Costs0),
    spread(Heap, Before, Costs0, Costs).

spread(Heap0, Before, Costs0, Costs) :-
    (   get_from_heap(Heap0, Cost, Node, Heap1)
    ->  (   get_assoc(Node, Costs0, _)
        ->  Heap2 = Heap1,
            Costs1 = Costs0
        ;   put_assoc(Node, Costs0, Cost, Costs1),
            findall(Through-From,
                    ( call(Before, Node, From, More),
                      \+ get_assoc(From, Costs1, _),
                      Through is Cost + More ),
                    Next),
            added(Next, Heap1, Heap2)
        ),
        spread(Heap2, Before, Costs1, Costs)
    ;   Costs = Costs0
    ).

added([], Heap, Heap).
added([Cost-Node|Rest], Heap0, Heap) :-
    add_to_heap(Heap0, Cost, Node, Heap1),
    added(Rest, Heap1, Heap).

%!  grid_action(+Policy, +State, -Action, -Cost) is semidet.
%
%   Action is what a Policy of grid_policy/2 says for State, `move`, `left` or
%   `right`, or `fin` if State is the goal. Cost is what is left from there:
%   of moves and turns for `value_iteration`, of moves alone for
%   `navigation_function`. Fails if there is no way from there.
%
%   @error type_error(policy, Policy)
%   @error domain_error(grid_state, State)

grid_action(Policy, State, Action, Cost) :-
    must_be_policy(Policy),
    Policy = policy(method: Method, map: Map, goal: Goal, costs: Costs),
    must_be_state(Map, State),
    cost(Method, State, Costs, Cost),
    (   \+ State \= Goal
    ->  Action = fin
    ;   Method == value_iteration
    ->  best_step(Map, State, Costs, Action)
    ;   State = state(Cell, Direction),
        downhill(Map, Cell, Goal, Direction, Cost, Costs, Turns),
        first_action(Turns, Action)
    ).

must_be_policy(Policy) :-
    must_be(nonvar, Policy),
    (   functor(Policy, policy, 4)
    ->  true
    ;   throw_error(type_error(policy, Policy), _,
                    'a policy of grid_policy/2 is expected')
    ).

cost(value_iteration, State, Costs, Cost) :-
    get_assoc(State, Costs, Cost).
cost(navigation_function, state(Cell, _), Costs, Cost) :-
    get_assoc(Cell, Costs, Cost).

%   The step after which the least cost is left, with its own.

best_step(Map, State, Costs, Action) :-
    grid_problem(Map, State, State, problem(_, _, Options)),
    memberchk(successor(Successor), Options),
    findall(Through-Place-Step,
            ( call(Successor, State, Step, Next, More),
              get_assoc(Next, Costs, Left),
              nth0(Place, [move, right, left], Step),
              Through is Left + More ),
            Ways0),
    sort(Ways0, [_-_-Action|_]).

%   Turns is how many directions the robot has to turn, to the right if it is
%   positive, before it moves to a cell with the least cost.

downhill(Map, Cell, Goal, Direction, Cost, Costs, Turns) :-
    (   Cost =:= 0
    ->  Goal = state(_, Wanted),        % it is there, and looks elsewhere
        turns(Map, Direction, Wanted, Turns)
    ;   findall(Count-Right,
                ( grid_direction(Map, Way),
                  grid_ahead(Cell, Way, Next),
                  get_assoc(Next, Costs, Left),
                  before(Map, state(Next, Way), state(Cell, Way), More),
                  Cost =:= Left + More,
                  turns(Map, Direction, Way, Right),
                  Count is abs(Right) ),
                Ways0),
        sort(Ways0, Ways),
        Ways = [Count-_|_],
        last_of(Ways, Count, Turns)
    ).

%   As near, to the right.
last_of(Ways, Count, Turns) :-
    (   member(Count-Turns, Ways),
        Turns >= 0
    ->  true
    ;   memberchk(Count-Turns, Ways)
    ).

turns(Map, From, To, Turns) :-
    grid_neighbors(Map, Neighbors),
    grid_directions(Neighbors, Directions),
    nth0(I, Directions, From),
    nth0(J, Directions, To),
    !,
    Turns is (J - I + Neighbors//2 - 1) mod Neighbors - Neighbors//2 + 1.

first_action(Turns, Action) :-
    (   Turns =:= 0
    ->  Action = move
    ;   Turns > 0
    ->  Action = right
    ;   Action = left
    ).
