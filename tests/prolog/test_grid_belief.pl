% library(ev3dev/grid_belief): probabilities by hand on small maps, and a robot that finds out
% where it is.

:- use_module('../support/trees').
:- use_module(library(ev3dev/drive)).
:- use_module(library(ev3dev/grid)).
:- use_module(library(ev3dev/grid_belief)).

%   Three cells in a row: the states that look along it see 0, 1 or 2 free cells.
row(Map) :-
    grid_map([rows(["..."])], Map).

near(X, Y) :-
    near(X, Y, 1.0e-9).

probability(belief(_, Pairs), State, P) :-
    memberchk(State-P, Pairs).

:- begin_tests(grid_belief).
test(is_a_picture, true(Count-Blacks-Whites == 4-1-1)) :-
    % The margin, and three free cells: most probable, half so, impossible
    row(Map),
    B = belief(Map, [state([0, 0], [0, 1])-0.5, state([1, 0], [0, 1])-0.25, state([1, 0], [1, 0])-0.0]),
    tmp_file(belief, File),
    grid_belief_svg(B, File),
    read_file_to_string(File, Text, []),
    delete_file(File),
    aggregate_all(count, sub_string(Text, _, _, _, "<rect"), Count),
    aggregate_all(count, sub_string(Text, _, _, _, "fill=\"rgb(0,0,0)\""), Blacks),
    aggregate_all(count, sub_string(Text, _, _, _, "fill=\"rgb(255,255,255)\""), Whites).

test(all_states_alike, true(Length-Different == 12-1)) :-
    row(Map),
    grid_belief(Map, belief(Map, Pairs)),
    length(Pairs, Length),
    findall(P, member(_-P, Pairs), Ps),
    sort(Ps, Distinct),
    length(Distinct, Different),
    sum_list(Ps, Sum),
    near(Sum, 1).
test(obstructed_cells_are_none, all(Cell == [[0, 0], [2, 0]])) :-
    grid_map([rows([".#."])], Map),
    grid_belief(Map, Belief),
    grid_belief_cell(Belief, Cell, P),
    near(P, 0.5).
% Two of twelve states see two free cells, ten others see less: 0.9 to 0.05 each.
test(bayes) :-
    row(Map),
    grid_belief(Map, B0),
    grid_sense(2, B0, B),
    P is 0.9 / (2*0.9 + 10*0.05),
    Q is 0.05 / (2*0.9 + 10*0.05),
    probability(B, state([0, 0], [1, 0]), P1),
    probability(B, state([0, 0], [0, 1]), Q1),
    near(P1, P),
    near(Q1, Q).
test(more_free_cells_are_two) :-
    row(Map),
    grid_belief(Map, B0),
    grid_sense(2, B0, B),
    grid_sense(7, B0, B).
test(a_move_may_fail) :-
    row(Map),
    B0 = belief(Map, [state([0, 0], [1, 0])-1.0]),
    grid_motion(move, B0, B),
    probability(B, state([1, 0], [1, 0]), P),
    probability(B, state([0, 0], [1, 0]), Q),
    near(P, 0.95),
    near(Q, 0.05).
test(nothing_goes_through_a_wall, B == B0) :-
    row(Map),
    B0 = belief(Map, [state([2, 0], [1, 0])-1]),
    grid_motion(move, B0, B).
test(two_ways_into_a_state_add_up) :-
    row(Map),
    B0 = belief(Map, [state([1, 0], [1, 0])-0.5, state([2, 0], [1, 0])-0.5]),
    grid_motion(move, B0, B),
    probability(B, state([2, 0], [1, 0]), P),
    near(P, 0.975).
test(a_turn_is_certain, B == belief(Map, [state([0, 0], [0, 1])-1])) :-
    row(Map),
    grid_motion(left, belief(Map, [state([0, 0], [1, 0])-1]), B).
test(best, State-P == state([1, 0], [0, 1])-0.7) :-
    row(Map),
    B = belief(Map, [state([0, 0], [0, 1])-0.3, state([1, 0], [0, 1])-0.7]),
    grid_belief_best(B, State, P).
test(best_of_nothing, fail) :-
    grid_map([rows(["#"])], Map),
    grid_belief(Map, Belief),
    grid_belief_best(Belief, _, _).
test(entropy) :-
    row(Map),
    findall(state([X, 0], [0, 1])-0.25, between(0, 3, X), Pairs),
    grid_belief_entropy(belief(Map, Pairs), Bits),
    near(Bits, 2),
    grid_belief_entropy(belief(Map, [a-1]), Certain),
    near(Certain, 0).
test(no_such_action, error(domain_error(grid_action, jump))) :-
    row(Map),
    grid_belief(Map, Belief),
    grid_motion(jump, Belief, _).
test(no_such_view, error(type_error(nonneg, -1))) :-
    row(Map),
    grid_belief(Map, Belief),
    grid_sense(-1, Belief, _).
:- end_tests(grid_belief).

:- begin_tests(grid_localize).
boxes([[1,1], [0,3], [2,2], [2,3], [4,3], [3,5], [5,1], [6,4], [1,6], [5,6]]).

lost(Seed, Cell, Direction, Goal) :-
    direction_heading(Direction, Heading),
    Cell = [CX, CY],
    X is 20*CX,
    Y is 20*CY,
    with_sim(grid,
             ( sim_place(X, Y, Heading),
               set_robot(5.6, 10.6, outB, outC),
               once(Goal) ),
             [clock(virtual), noise(true), seed(Seed)]).

:- meta_predicate lost(+, +, +, 0).

%   The robot has gone on, so the simulator says where it is.
right(state([CX, CY], Direction)) :-
    sim_pose(X, Y, Heading),
    abs(X - 20*CX) < 6,
    abs(Y - 20*CY) < 6,
    direction_heading(Direction, Wanted),
    Off is abs(Heading - Wanted) / 360,
    abs(Off - round(Off)) * 360 < 10.

test(finds_out, [forall(member(Policy, [ahead, entropy])), true(Wrong == [])]) :-
    boxes(Boxes),
    grid_map([obstacles(Boxes)], Map),
    Starts = [[4,4]-[1,0], [7,0]-[0,1], [3,3]-[0,-1], [6,6]-[-1,0], [5,4]-[0,1], [0,7]-[1,0]],
    findall(Cell,
            ( nth1(Seed, Starts, Cell-Direction),
              \+ lost(Seed, Cell, Direction,
                      ( grid_localize(Map, State, [policy(Policy)]), right(State) )) ),
            Wrong).
test(then_the_pose_is_that_of_the_grid) :-
    boxes(Boxes),
    grid_map([obstacles(Boxes)], Map),
    lost(3, [6, 6], [-1, 0],
         ( grid_localize(Map, state([CX, CY], Direction)),
           pose(X, Y, Heading),
           near(X, 20*CX),
           near(Y, 20*CY),
           direction_heading(Direction, Heading0),
           near(Heading, Heading0),
           set_grid([obstacles(Boxes), start([CX, CY], Direction)]),
           plan_and_go_to([0, 0], [0, 1]),
           right(state([0, 0], [0, 1])) )).
test(each_look_is_told, true(First-Sum == 2-true)) :-
    boxes(Boxes),
    grid_map([obstacles(Boxes)], Map),
    nb_setval(looks, []),
    lost(3, [0, 0], [1, 0],
         grid_localize(Map, _, [tell(note)])),
    nb_getval(looks, Looks),
    last(Looks, First-Belief),
    ( total(Belief, Total), near(Total, 1) -> Sum = true ; Sum = false ).
test(not_sure_in_time, fail) :-
    boxes(Boxes),
    grid_map([obstacles(Boxes)], Map),
    lost(1, [4, 4], [1, 0], grid_localize(Map, _, [actions(2)])).
test(an_own_policy, Actions == [left, left, left]) :-
    boxes(Boxes),
    grid_map([obstacles(Boxes)], Map),
    nb_setval(done, []),
    lost(1, [4, 4], [1, 0], \+ grid_localize(Map, _, [actions(3), policy(around)])),
    nb_getval(done, Actions).
test(a_wheel_is_held, fail) :-
    boxes(Boxes),
    grid_map([obstacles(Boxes)], Map),
    lost(1, [4, 4], [1, 0], ( sim_jam(outB, true), grid_localize(Map, _) )).
test(no_robot_moves_for_a_wrong_option, error(domain_error(grid_belief_option, soon(1)))) :-
    row(Map),
    grid_localize(Map, _, [soon(1)]).

note(Free, Belief) :-
    nb_getval(looks, Looks),
    nb_setval(looks, [Free-Belief|Looks]).

total(belief(_, Pairs), Total) :-
    findall(P, member(_-P, Pairs), Ps),
    sum_list(Ps, Total).

around(_, Done, _, left) :-
    nb_setval(done, [left|Done]).
:- end_tests(grid_localize).
