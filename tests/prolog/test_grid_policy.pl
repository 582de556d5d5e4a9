% Policies on grids lead from each state to the goal at the least cost, and a robot that has
% one goes on from wherever it was put.

:- use_module('../support/cases').
:- use_module('../support/simulation').
:- use_module(library(ev3dev/drive)).
:- use_module(library(ev3dev/grid)).

:- initialization(load_files(pushed:example(pushed), [])).

% ---------------- SUPPORT

%   A random map with a goal that may be obstructed.

random_map(Seed, Neighbors, Map, Obstacles, Goal) :-
    set_random(seed(Seed)),
    random_between(2, 9, Width),
    random_between(2, 9, Height),
    random_member(Neighbors, [4, 8]),
    random(Share0),
    Share is 0.45 * Share0,
    X2 is Width - 1,
    Y2 is Height - 1,
    findall([X, Y], ( between(0, X2, X), between(0, Y2, Y), maybe(Share) ),
            Obstacles),
    random_between(0, X2, GX),
    random_between(0, Y2, GY),
    Goal = [GX, GY],
    grid_map([bounds(0, 0, X2, Y2), obstacles(Obstacles), neighbors(Neighbors)], Map).

%   least(+Next, +Starts, -Costs): from each of Starts, Node-Cost, by closures
%   call(Next, Node, Another, Cost). A search of the test's own: it goes on
%   until no cost becomes less.

:- dynamic least_cost/2.

least(Next, Starts) :-
    retractall(least_cost(_, _)),
    forall(member(Node, Starts), assertz(least_cost(Node, 0))),
    relaxed(Starts, Next).

relaxed([], _).
relaxed([Node|Nodes], Next) :-
    least_cost(Node, Cost0),
    findall(Other,
            ( call(Next, Node, Other, More),
              Cost is Cost0 + More,
              \+ ( least_cost(Other, Before), Before =< Cost ),
              retractall(least_cost(Other, _)),
              assertz(least_cost(Other, Cost)) ),
            Others),
    append(Nodes, Others, Nodes1),
    relaxed(Nodes1, Next).

%   Backwards: a cell is free, and a diagonal has free cells beside.

cell_before(Neighbors, Obstacles, Map, To, From, Cost) :-
    beside_cell(Neighbors, [DX, DY], Cost),
    To = [X, Y],
    X0 is X - DX,
    Y0 is Y - DY,
    From = [X0, Y0],
    grid_bounds(Map, X1, Y1, X2, Y2),
    X0 >= X1, X0 =< X2, Y0 >= Y1, Y0 =< Y2,
    \+ ( member(Cell, [[X0, Y0], [X, Y], [X0, Y], [X, Y0]]),
         memberchk(Cell, Obstacles) ).

beside_cell(Neighbors, [DX, DY], Cost) :-
    member([DX, DY], [ [0, 1], [1, 0], [0, -1], [-1, 0],
                       [1, 1], [1, -1], [-1, -1], [-1, 1] ]),
    (   DX * DY =:= 0
    ->  Cost = 20
    ;   Neighbors == 8,
        Cost = 28
    ).

state_before(N, Obstacles, Map, state(To, D), state(From, D), Cost) :-
    cell_before(N, Obstacles, Map, To, From, Cost),
    ahead(From, D, To).
state_before(N, _, _, state(Cell, D), state(Cell, D0), Cost) :-
    Cost is 40 // N,
    Angle is 360 // N,
    direction_heading(D, Heading),
    member(Turn, [Angle, -Angle]),
    Heading0 is (Heading + Turn) mod 360,
    direction_heading(D0, Heading0).

ahead([X0, Y0], [DX, DY], [X, Y]) :-
    X is X0 + DX,
    Y is Y0 + DY.

%   What the policy costs from a state, `none` if it does not lead to the goal.
%   Counted are turns for `value_iteration` only.

followed(Policy, Map, Method, State, Cost) :-
    (   grid_action(Policy, State, _, Left)
    ->  led(State, Policy, Map, Method, 400, 0, Cost),
        assertion(Left =:= Cost)
    ;   Cost = none
    ).

led(State, Policy, Map, Method, Steps, Cost0, Cost) :-
    Steps > 0,
    grid_action(Policy, State, Action, _),
    (   Action == fin
    ->  Cost = Cost0
    ;   grid_step(Map, Action, State, Next),
        Next = state(Cell, _),
        assertion(free_cell(Map, Cell)),
        (   Action \== move,
            Method == navigation_function
        ->  More = 0
        ;   grid_cost(Map, State, Action, More)
        ),
        Cost1 is Cost0 + More,
        Fewer is Steps - 1,
        led(Next, Policy, Map, Method, Fewer, Cost1, Cost)
    ).

%   The states from which a policy does not do what it should.

wrong(Seed, Method, State-Cost-Expected) :-
    random_map(Seed, Neighbors, Map, Obstacles, Goal),
    grid_policy([map(Map), goal(Goal), method(Method)], Policy),
    (   free_cell(Map, Goal)
    ->  Ends = [Goal]
    ;   Ends = []
    ),
    (   Method == value_iteration
    ->  findall(state(Cell, D), ( member(Cell, Ends), grid_direction(Map, D) ), States),
        least(state_before(Neighbors, Obstacles, Map), States)
    ;   least(cell_before(Neighbors, Obstacles, Map), Ends)
    ),
    free_cell(Map, Cell),
    grid_direction(Map, Direction),
    State = state(Cell, Direction),
    ( Method == value_iteration -> Node = State ; Node = Cell ),
    (   least_cost(Node, Expected)
    ->  true
    ;   Expected = none
    ),
    followed(Policy, Map, Method, State, Cost),
    Cost \== Expected.

:- begin_tests(grid_policy).
test(leads_from_each_cell_to_the_goal_by_a_shortest_way,
     [ forall(member(Method, [value_iteration, navigation_function])), true(Wrong == []) ]) :-
    cases(200, Count),
    findall(Seed-What, ( between(1, Count, Seed), once(wrong(Seed, Method, What)) ), Wrong).
test(the_goal_may_have_a_direction,
     [ forall(( member(Method, [value_iteration, navigation_function]), member(N, [4, 8]),
                grid_map([neighbors(N)], Map), grid_direction(Map, D), grid_direction(Map, D0) )),
       true(End == state([3, 3], D)) ]) :-
    grid_policy([map(Map), goal(state([3, 3], D)), method(Method)], Policy),
    last_state(Policy, Map, state([1, 2], D0), End).
test(the_goal_may_have_any_direction, true(Cost == 0)) :-
    grid_policy([goal(state([3, 3], _))], Policy),
    grid_action(Policy, state([3, 3], [0, -1]), fin, Cost).
test(of_a_wall_of_obstacles_nothing_is_known_beyond, fail) :-
    grid_policy([rows(["..#.", "..#."]), goal([0, 0])], Policy),
    grid_action(Policy, state([3, 0], [0, 1]), _, _).
test(a_goal_in_an_obstacle_has_no_way, fail) :-
    grid_policy([rows(["#.."]), goal([0, 0])], Policy),
    grid_action(Policy, state([1, 0], [0, 1]), _, _).
test(the_free_cells_are_those_of_a_goal, true(Action == right)) :-
    grid_policy([goal([0, 2]), bounds(0, 0, 1, 2), free(no_middle)], Policy),
    grid_action(Policy, state([0, 0], [0, 1]), Action, _).
test(the_turns_are_the_fewest, true(Actions == [left, right, right])) :-
    grid_policy([goal([0, 0]), bounds(-3, -3, 3, 3), neighbors(8), method(navigation_function)], P),
    findall(Action,
            ( member(State, [ state([3, 0], [0, 1]), state([-3, 0], [0, 1]), state([0, 3], [0, 1]) ]),
              grid_action(P, State, Action, _) ),
            Actions).
test(a_policy_asks_the_map_once, true(More == [])) :-
    nb_setval(asked, 0),
    grid_policy([goal([7, 7]), free(counted)], Policy),
    nb_getval(asked, Before),
    grid_action(Policy, state([0, 0], [0, 1]), _, _),
    nb_getval(asked, After),
    % As the last steps are looked at, a few cells beside are asked.
    ( After - Before < 10 -> More = [] ; More = [Before, After] ).

last_state(Policy, Map, State, End) :-
    grid_action(Policy, State, Action, _),
    (   Action == fin
    ->  End = State
    ;   grid_step(Map, Action, State, Next),
        last_state(Policy, Map, Next, End)
    ).

no_middle([0, 1]) :- !, fail.
no_middle(_).

counted(_) :-
    nb_getval(asked, Count0),
    Count is Count0 + 1,
    nb_setval(asked, Count).

% Options, and the error.
refused([], existence_error(option, goal)).
refused([goal(_)], instantiation_error).
refused([goal(a)], domain_error(grid_cell, a)).
refused([goal([1])], domain_error(grid_cell, [1])).
refused([goal(state([1, 1], [2, 2]))], domain_error(grid_state, state([1, 1], [2, 2]))).
refused([goal(state([1, 1], [1, 1]))], domain_error(grid_state, state([1, 1], [1, 1]))).
refused([goal([1, 1]), method(astar)], domain_error(policy_method, astar)).
refused([goal([1, 1]), method(_)], instantiation_error).
refused([goal([1, 1]), neighbors(5)], domain_error(neighbors, 5)).
refused([goal([1, 1]), turns(5)], domain_error(grid_option, turns(5))).
refused([goal([1, 1]), map(_)], instantiation_error).
refused([goal([1, 1]), map(m), rows([])], domain_error(grid_option, rows([]))).

test(options, [forall(refused(Options, Formal)), error(Formal, context(grid_policy/2, _))]) :-
    grid_policy(Options, _).
test(what_is_no_policy, error(type_error(policy, a), context(grid_action/4, _))) :-
    grid_action(a, state([0, 0], [0, 1]), _, _).
test(what_is_no_state,
     [ forall(member(State, [state([0, 0], [1, 1]), state(a, [0, 1]), a])),
       error(domain_error(_, _), context(grid_action/4, _)) ]) :-
    grid_policy([goal([1, 1])], Policy),
    grid_action(Policy, State, _, _).
:- end_tests(grid_policy).

:- begin_tests(pushed).
%   A free place of the world `grid`, some centimeters off the middle of a cell.
place(Seed, X, Y, Heading) :-
    set_random(seed(Seed)),
    findall([CX, CY],
            ( between(0, 7, CX), between(0, 7, CY),
              \+ memberchk([CX, CY], [ [1, 1], [0, 3], [2, 2], [2, 3], [4, 3], [3, 5], [5, 1],
                                       [6, 4], [1, 6], [5, 6] ]) ),
            Cells),
    random_member([PX, PY], Cells),
    random_between(-1, 1, DX),
    random_between(-1, 1, DY),
    random_between(0, 359, Heading),
    X is 20*PX + DX,
    Y is 20*PY + DY.

% The policy is made once, before the robot moves.
test(a_pushed_robot_arrives_without_planning_again,
     [ forall(case(10, Seed)), true(Cell-Collisions == [7, 5]-[]) ]) :-
    place(Seed, X1, Y1, H1),
    Other is Seed + 1000,
    place(Other, X2, Y2, H2),
    grid_policy([ obstacles([ [1, 1], [0, 3], [2, 2], [2, 3], [4, 3], [3, 5], [5, 1], [6, 4],
                              [1, 6], [5, 6] ]), goal([7, 5]) ], Policy),
    with_sim(grid,
             ( set_robot(5.6, 10.6, outB, outC),
               sim_at(5, put(X1, Y1, H1)),
               sim_at(11, put(X2, Y2, H2)),
               with_output_to(string(_), pushed:go_by(Policy)),
               sim_pose(X, Y, _),
               sim_collisions(Collisions),
               assertion(at_rest) )),
    Cell = [CX, CY],
    CX is round(X / 20),
    CY is round(Y / 20).
test(the_example_drives, true(Cell == [140, 100])) :-
    with_sim(grid,
             ( sim_at(6, sim_place(60, 140, 180)),
               with_output_to(string(_), pushed:start),
               sim_pose(X, Y, _) )),
    Cell = [CX, CY],
    CX is round(X / 20) * 20,
    CY is round(Y / 20) * 20.
:- end_tests(pushed).

%   The robot is put there, and its move goes on until it stops.
put(X, Y, Heading) :-
    sim_place(X, Y, Heading),
    stop.
