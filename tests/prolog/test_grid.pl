% Robots on grids they do not know, in the simulator: do they get there, and do
% they say so when there is no way?

:- use_module('../support/simulation').
:- use_module('../support/cases').
:- use_module('../support/old_prolog').
:- use_module(library(ev3dev/drive)).
:- use_module(library(ev3dev/grid)).
:- use_module(library(ev3dev/planners), [planner/1]).

:- initialization(load_files(grid_navigation:example(grid_navigation), [])).

robot :-
    set_robot(5.6, 10.6, outB, outC).

%   A random world of 8 by 8 cells, up to 35 % of them obstacles, and a goal
%   somewhere in it. Between a robot in the middle of a cell and a box in the
%   next column, or the walls around, there are 5 cm.

grid(Seed, Neighbors, Cells, Goal, World) :-
    set_random(seed(Seed)),
    random_member(Neighbors, [4, 8]),
    random(R),
    Share is 0.35 * R,
    findall([X, Y],
            ( between(0, 7, X), between(0, 7, Y),
              [X, Y] \== [0, 0],
              maybe(Share)
            ),
            Cells),
    random_between(0, 7, GX),
    random_between(0, 7, GY),
    Goal = [GX, GY],
    boxes(Cells, Boxes),
    World = [bounds(-15, -15, 155, 155), start(0, 0, 0)|Boxes].

boxes(Cells, Boxes) :-
    findall(box(XCm, YCm, 14, 14),
            ( member([X, Y], Cells), XCm is 20*X, YCm is 20*Y ),
            Boxes).

%   How it should end, by who knows the map.

expected(Neighbors, Cells, Goal, Reason) :-
    grid_map([neighbors(Neighbors), obstacles(Cells)], Map),
    grid_problem(Map, state([0, 0], [0, 1]), state(Goal, _), Problem),
    (   ev3dev_planners:plan(dijkstra, Problem, _)
    ->  Reason = reached
    ;   Reason = no_way
    ).

%   The robot with errors: one motor is 5 % stronger than the other, one wheel
%   5 % larger, none of which it knows; motors, encoders, sonar and gyro are
%   noisy, and the gyro drifts.

noisy_robot(Seed,
            [ left_wheel(outB, Left), right_wheel(outC, Right), axle(10.6),
              hull(circle(8)), mass(0.75),
              motor(outB, 'lego-ev3-l-motor'),
              motor(outC, 'lego-ev3-l-motor'),
              sensor(in1, 'lego-ev3-us', 0, 7, 0),
              sensor(in4, 'lego-ev3-gyro', 0, 0, 0),
              noise(outB, 0.5, Bias), noise(outC, 0.5, 0),
              encoder_noise(outB, 0.5), encoder_noise(outC, 0.5),
              noise(in1, 0.2, 0), noise(in4, 0.3, 0.02)
            ]) :-
    (   Seed mod 2 =:= 0
    ->  Bias = 5
    ;   Bias = -5
    ),
    (   Seed mod 3 =:= 0
    ->  Left = 5.74,
        Right = 5.46
    ;   Seed mod 3 =:= 1
    ->  Left = 5.46,
        Right = 5.74
    ;   Left = 5.6,
        Right = 5.6
    ).

%   What is wrong with a run: not the end it should have, a collision, or it is
%   in another cell than it says.

wrong(Noise, Seed, Why) :-
    grid(Seed, Neighbors, Cells, Goal, World),
    expected(Neighbors, Cells, Goal, Expected),
    (   Noise == true
    ->  noisy_robot(Seed, Robot)
    ;   Robot = default
    ),
    with_sim(World,
             ( robot,
               set_grid([neighbors(Neighbors)]),
               plan_and_go_to(Goal, _, [reason(Reason)]),
               state_position([X, Y], Direction),
               findall(Cell, obstructed(Cell), Obstructed),
               sim_pose(XCm, YCm, Heading),
               sim_collisions(Collisions)
             ),
             [robot(Robot), seed(Seed)]),
    direction_heading(Direction, Meant),
    Off is max(abs(XCm - 20*X), abs(YCm - 20*Y)),
    Turned is Heading - Meant,
    heading_wrapped(Turned, Askew),
    (   Reason \== Expected
    ->  Why = Reason-Expected
    ;   Collisions \== []
    ->  Why = Collisions
    ;   Reason == reached,
        [X, Y] \== Goal
    ->  Why = in([X, Y])
    ;   subtract(Obstructed, Cells, [Wrong|_])
    ->  Why = no_obstacle(Wrong)
    ;   Off > 7
    ->  Why = off(Off)
    ;   abs(Askew) > 8
    ->  Why = askew(Askew)
    ).

%   A world with a way to the opposite corner, whose walls are the edges of the
%   outer cells: the robot sees those behind its goal, and must not take them
%   for something in it.

narrow(Seed, Cells, World) :-
    Chance is 1000*Seed,
    narrow_from(Chance, Cells, World).

narrow_from(Chance, Cells, World) :-
    set_random(seed(Chance)),
    findall([X, Y],
            ( between(0, 7, X), between(0, 7, Y),
              \+ memberchk([X, Y], [[0, 0], [7, 7]]),
              maybe(0.25)
            ),
            Cells0),
    (   expected(4, Cells0, [7, 7], reached)
    ->  Cells = Cells0,
        boxes(Cells, Boxes),
        World = [bounds(-10, -10, 150, 150), start(0, 0, 0)|Boxes]
    ;   Next is Chance + 1,
        narrow_from(Next, Cells, World)
    ).

wrong_in_narrow(Seed, Reason-Wrong) :-
    narrow(Seed, Cells, World),
    with_sim(World,
             ( robot,
               set_grid([]),
               plan_and_go_to([7, 7], _, [reason(Reason)]),
               findall(Cell, obstructed(Cell), Obstructed)
             ),
             [noise(true), seed(Seed)]),
    subtract(Obstructed, Cells, Wrong),
    Reason-Wrong \== reached-[].

:- begin_tests(worlds).
test(the_walls_behind_a_cell_are_not_in_it, true(Wrong == [])) :-
    findall(Seed-Why,
            ( case(100, Seed), wrong_in_narrow(Seed, Why) ),
            Wrong).

test(reaches_what_can_be_reached_in_200_worlds, true(Wrong == [])) :-
    findall(Seed-Why,
            ( case(200, Seed), wrong(false, Seed, Why) ),
            Wrong).
test(does_so_with_noise_and_unequal_wheels, true(Wrong == [])) :-
    findall(Seed-Why,
            ( case(200, Seed), wrong(true, Seed, Why) ),
            Wrong).
test(the_worlds_are_a_fair_lot) :-
    findall(Reason-Neighbors,
            ( between(1, 200, Seed),
              grid(Seed, Neighbors, Cells, Goal, _),
              expected(Neighbors, Cells, Goal, Reason)
            ),
            Kinds),
    forall(member(Kind, [ reached-4, reached-8, no_way-4, no_way-8 ]),
           ( aggregate_all(count, member(Kind, Kinds), Count),
             Count >= 20
           )).
test(any_planner_will_do, [forall(planner(Planner))]) :-
    forall(case(5, Seed),
           ( grid(Seed, Neighbors, Cells, Goal, World),
             expected(Neighbors, Cells, Goal, Expected),
             with_sim(World,
                      ( robot,
                        set_grid([neighbors(Neighbors)]),
                        plan_and_go_to(Goal, [0, 1],
                                       [ planner(Planner), reason(Reason) ])
                      )),
             Reason == Expected
           )).
test(cells_may_be_wider_and_the_origin_elsewhere) :-
    with_sim(maze,
             ( robot,
               set_grid([ bounds(0, 0, 10, 10), start([1, 1], [0, 1]),
                          cell_cm(30), origin(15, 15) ]),
               plan_and_go_to([1, 9], _),
               col_color(in2, Color),
               sim_collisions(Collisions) )),
    Color == 5,
    Collisions == [].
:- end_tests(worlds).

:- begin_tests(on_the_way).
%   The robot and a grid without walls; then Goal.
:- meta_predicate in_open(+, +, 0).

in_open(Items, Options, Goal) :-
    with_sim(Items, ( robot, set_grid([bounds(-1, -1, 3, 3)|Options]), call(Goal) )).

%   Boxes in some cells of an otherwise empty room; then Goal.

:- meta_predicate in_room(+, +, 0).

in_room(Cells, Options, Goal) :-
    boxes(Cells, Boxes),
    with_sim([bounds(-15, -15, 75, 75)|Boxes],
             ( robot,
               set_grid([bounds(0, 0, 3, 3)|Options]),
               call(Goal)
             )).

:- dynamic told/1.

tell(Event) :-
    assertz(told(Event)).

all_told(Events) :-
    findall(Event, retract(told(Event)), Events).

test(starts_in_0_0, Cell-Direction == [0,0]-[0,1]) :-
    in_room([], [], state_position(Cell, Direction)).
test(tells_what_happens,
     Events == [ plan(state([0,0], [0,1]), [move, move, move]),
                 at([0,1], [0,1]),
                 obstacle([0,2]),
                 plan(state([0,1], [0,1]), [right, move, left, move, move,
                                            left, move]),
                 at([1,1], [1,0]), at([1,2], [0,1]), at([1,3], [0,1]),
                 at([0,3], [-1,0])
               ]) :-
    all_told(_),
    in_room([[0,2]], [], plan_and_go_to([0,3], _, [tell(tell)])),
    all_told(Events).

test(the_direction_reached_is_told, D-Heading == [1,0]-90) :-
    in_room([], [],
            ( plan_and_go_to([2,0], D),
              pose(_, _, H)
            )),
    Heading is 5 * round(H / 5).
test(looks_in_the_direction_asked_for, D == [0,-1]) :-
    in_room([], [],
            ( plan_and_go_to([1,1], [0,-1]),
              state_position([1,1], D),
              sim_pose(_, _, Heading)
            )),
    near(Heading, 180, 2).
test(stays_where_it_is) :-
    in_room([], [],
            ( plan_and_go_to([0,0], [0,1], [tell(tell)]), sim_time(Time) )),
    Time < 0.1,
    all_told([plan(_, [])]).
test(goes_on_from_where_it_is) :-
    in_room([[1,0]], [],
            ( plan_and_go_to([2,0], _),
              obstructed([1,0]),
              plan_and_go_to([0,0], [0,1]),
              obstructed([1,0]),
              sim_pose(X, Y, _)
            )),
    near(X, 0, 2),
    near(Y, 0, 2).
test(obstacles_known_from_the_start_are_gone_around, Events == []) :-
    all_told(_),
    in_room([[0,1], [1,1]], [obstacles([[0,1], [1,1]])],
            ( plan_and_go_to([0,2], _, [tell(tell)]),
              obstructed([0,1])
            )),
    all_told(All),
    include([obstacle(_)]>>true, All, Events).
test(a_drawn_map_is_known, Cell-Obstructed == [1,2]-[[1,1]]) :-
    with_sim([ bounds(-15, -15, 75, 75), box(20, 20, 14, 14),
               start(20, 0, 0) ],
             ( robot,
               set_grid([rows(["....", "....", ".#..", ".^.."])]),
               plan_and_go_to([1,2], _),
               state_position(Cell, _),
               findall(C, obstructed(C), Obstructed)
             )).
test(added_obstacles_are_gone_around_and_removed_ones_not,
     Found == [[1,2]]) :-
    in_room([[1,2]], [],
            ( obstacle_add([0,1]),
              obstacle_add([1,1]),
              obstacle_remove([1,1]),
              plan_and_go_to([0,2], _),
              findall(C, ( obstructed(C), C \== [0,1] ), Found)
            )).
test(what_is_not_known_cannot_be_removed, fail) :-
    in_room([], [], obstacle_remove([1,1])).
test(set_grid_forgets, fail) :-
    in_room([], [], ( obstacle_add([1,1]), set_grid([]), obstructed(_) )).
% Bricks that share a program know nothing of each other's grids.
test(another_brick_has_a_grid_of_its_own, Seen-State == [[1,1]]-[0,0]) :-
    all_told(_),
    setup_call_cleanup(
        ( assertz(ev3dev_grid_knowledge:obstacle(other, [0,1], ever, never)),
          assertz(ev3dev_grid_knowledge:free(other, [1,1], ever)),
          assertz(ev3dev_grid_place:stands(other, [3,3], [0,1])) ),
        in_room([], [],
                ( obstacle_add([1,1]),
                  findall(C, obstructed(C), Seen),
                  plan_and_go_to([0,2], [0,1], [tell(tell)]),
                  all_told([plan(state(State, _), [move, move])|_]) )),
        ( retract(ev3dev_grid_knowledge:obstacle(other, [0,1], ever, never)),
          retract(ev3dev_grid_knowledge:free(other, [1,1], ever)),
          retract(ev3dev_grid_place:stands(other, [3,3], [0,1])) )).
test(the_robot_may_be_put_elsewhere, X-Y == 40-60) :-
    in_room([], [],
            ( sim_place(40, 40, 90),
              grid_place([2,2], [1,0]),
              plan_and_go_to([2,3], _),
              sim_pose(XCm, YCm, _)
            )),
    X is round(XCm),
    Y is round(YCm).

% Right of the corner stands a box; the robot may not cut it.
test(no_corner_is_cut, Collisions == []) :-
    in_room([[1,0]], [neighbors(8)],
            ( plan_and_go_to([1,1], _),
              obstructed([1,0]),
              sim_collisions(Collisions)
            )).
% It gets stuck between two pillars that its sonar does not see, goes back, and
% around.
test(what_stops_it_is_an_obstacle) :-
    with_sim([bounds(-35, -15, 75, 75), circle(9, 20, 2), circle(-9, 20, 2)],
             ( robot,
               set_grid([bounds(-1, 0, 3, 3)]),
               plan_and_go_to([0,2], _),
               obstructed([0,1]),
               sim_collisions([_|_]),
               sim_pose(X, Y, _)
             )),
    near(X, 0, 2),
    near(Y, 40, 2).
test(it_goes_back_backward, Seen-Cell == [[0,1]]-[0,0]) :-
    in_open([circle(9, 20, 2), circle(-9, 20, 2)], [],
            ( \+ execute_plan([move]),
              findall(C, obstructed(C), Seen),
              state_position(Cell, _),
              motor_position(outB, Left),
              motor_position(outC, Right),
              sim_pose(X, Y, _)
            )),
    near(X, 0, 2),
    near(Y, 0, 2),
    near(Left, 0, 30),
    near(Right, 0, 30).
% The middle of the next cell is 28 cm ahead.
test(what_is_behind_the_middle_of_a_diagonal_cell_is_in_it,
     [ forall(member(At-Found, [22.6-[[1,1]], 28-[]])), true(Seen-Collisions == Found-[]) ]) :-
    in_open([circle(At, At, 2)], [neighbors(8)],
            ( ignore(execute_plan([right, move])),
              findall(C, obstructed(C), Seen),
              sim_collisions(Collisions) )).
:- end_tests(on_the_way).

:- begin_tests(no_way).
:- dynamic said/1.

:- multifile user:message_hook/3.

user:message_hook(ev3dev(grid(_, _)), warning, Lines) :-
    message_to_codes_(Lines, Text),
    assertz(plunit_no_way:said(Text)).

message_to_codes_(Lines, Text) :-
    with_output_to(string(Text),
                   print_message_lines(current_output, '', Lines)).

walled([[0,1], [1,0], [1,1]]).

in_room(Options, Goal) :-
    walled(Cells),
    boxes(Cells, Boxes),
    with_sim([bounds(-15, -15, 75, 75)|Boxes],
             ( robot, set_grid([bounds(0, 0, 3, 3)|Options]), call(Goal) )).

test(fails_and_says_why) :-
    retractall(said(_)),
    in_room([], \+ plan_and_go_to([3,3], [0,1])),
    retract(said(Text)),
    forall(member(Part, ["[3,3]", "no way", "[0,1]", "[1,0]"]),
           once(sub_string(Text, _, _, _, Part))).
test(an_own_planner_that_fails_is_said_to_have_failed) :-
    retractall(said(_)),
    in_room([], \+ plan_and_go_to([3,3], _, [planner(no_plan(1))])),
    retract(said(Text)),
    once(sub_string(Text, _, _, _, "no_plan(1,state([0,0],[0,1]),state([3,3],_),Plan) failed")),
    \+ sub_string(Text, _, _, _, "no way").
no_plan(_, _, _, _) :-
    fail.

test(tells_the_reason, [forall(member(N, [4, 8])), Reason == no_way]) :-
    retractall(said(_)),
    in_room([neighbors(N)],
            ( plan_and_go_to([3,3], _, [reason(Reason)]),
              state_position([0,0], _)
            )),
    \+ said(_).
test(a_goal_off_the_map, Reason == no_way) :-
    in_room([], plan_and_go_to([9,9], _, [reason(Reason)])).
test(a_goal_in_an_obstacle, Reason == no_way) :-
    in_room([], plan_and_go_to([0,1], _, [reason(Reason)])).
test(without_eyes, Reason == no_sensor) :-
    in_room([],
            ( sim_unplug(in1),
              sim_step(2),
              plan_and_go_to([3,3], _, [reason(Reason)]),
              state_position([0,0], [0,1]),
              sim_pose(_, Y, _)
            )),
    near(Y, 0, 0.5).
test(a_robot_that_is_stopped_by_another_thread, Reason == stopped) :-
    with_sim([],
             ( robot,
               set_grid([]),
               setup_call_cleanup(
                   thread_create(stop_when_moving, Id, []),
                   plan_and_go_to([0,7], _, [reason(Reason)]),
                   thread_join(Id, _))
             ),
             [clock(realtime)]).

%   Stopped while it is between two cells.
stop_when_moving :-
    sim_pose(_, Y, _),
    sim_time(Time),
    Time < 30,
    (   Y > 3
    ->  stop
    ;   sleep(0.005),
        stop_when_moving
    ).

test(without_a_motor, Reason == no_robot) :-
    in_room([],
            ( sim_unplug(outB),
              sim_step(2),
              plan_and_go_to([3,0], _, [reason(Reason)])
            )).
test(jammed_wheels, Reason == stalled) :-
    with_sim([],
             ( robot,
               set_grid([]),
               sim_jam(outB, true),
               sim_jam(outC, true),
               plan_and_go_to([0,2], _, [reason(Reason)])
             )).
test(without_a_grid, fail) :-
    with_sim([], ( retractall(ev3dev_grid_place:on_grid(_, _, _)),
                   plan_and_go_to([1,1], _) )).
test(a_plan_without_a_grid, fail) :-
    with_sim([], ( retractall(ev3dev_grid_place:on_grid(_, _, _)),
                   execute_plan([left]) )).
test(no_grid_without_a_robot, fail) :-
    with_sim([], ( robot, sim_unplug(outB), sim_step(2), set_grid([]) )).
:- end_tests(no_way).

:- begin_tests(own_planners).
:- use_module(example(grid_planner)).

cell([X, Y]) :-
    between(0, 3, X),
    between(0, 3, Y),
    \+ obstructed([X, Y]).

in_room(Cells, Goal) :-
    boxes(Cells, Boxes),
    with_sim([bounds(-15, -15, 75, 75)|Boxes],
             ( robot, set_grid([bounds(0, 0, 3, 3)]), call(Goal) )).

stubborn(_, _, [move, move]).
lost(_, _, [left]).
runaway(_, _, [left, move]).
at_a_loss(_, _, _) :-
    fail.
jumpy(_, _, [jump]).
vague(_, _, _).

test(it_finds_the_way, Cell == [0,2]) :-
    in_room([[0,1]],
            ( plan_and_go_to([0,2], _, [planner(own_plan(cell))]),
              state_position(Cell, _)
            )).
test(it_finds_none, Reason == no_way) :-
    in_room([[0,1], [1,0]],
            plan_and_go_to([0,2], _,
                           [ planner(own_plan(cell)), reason(Reason) ])).
test(a_planner_that_gives_up, Reason == no_way) :-
    in_room([], plan_and_go_to([0,2], _,
                               [ planner(at_a_loss), reason(Reason) ])).
test(a_planner_that_learns_nothing, Reason-Cell == bad_plan-[0,0]) :-
    in_room([[0,1]],
            ( plan_and_go_to([0,2], _,
                             [ planner(stubborn), reason(Reason) ]),
              state_position(Cell, _)
            )).
test(a_planner_that_leads_elsewhere,
     [ forall(member(Planner, [lost, runaway])), Reason == bad_plan ]) :-
    in_room([], plan_and_go_to([0,2], _,
                               [ planner(Planner), reason(Reason) ])).
test(an_action_that_is_none, error(domain_error(grid_action, jump), _)) :-
    in_room([], plan_and_go_to([0,2], _, [planner(jumpy)])).
test(a_plan_that_is_none, error(instantiation_error, _)) :-
    in_room([], plan_and_go_to([0,2], _, [planner(vague)])).
test(a_planner_that_is_none, error(domain_error(planner, dowsing), _)) :-
    in_room([], plan_and_go_to([0,2], _, [planner(dowsing)])).
test(a_planner_that_is_a_number, error(domain_error(planner, 7), _)) :-
    in_room([], plan_and_go_to([0,2], _, [planner(7)])).
:- end_tests(own_planners).

:- begin_tests(fading).
%   A corridor with a box in it.
corridor(Options, Goal) :-
    with_sim([bounds(-15, -15, 15, 75)],
             ( robot,
               set_grid([bounds(0, 0, 0, 3)|Options]),
               sim_add(box(0, 40, 14, 14), Id),
               nb_setval(box, Id),
               call(Goal)
             )).

go(Reason) :-
    plan_and_go_to([0,3], _, [reason(Reason)]).

move_box :-
    nb_getval(box, Id),
    sim_remove(Id).

test(a_static_obstacle_stays, [R1, R2] == [no_way, no_way]) :-
    corridor([], ( go(R1), move_box, sim_step(1000), go(R2) )).
test(a_dynamic_one_is_forgotten,
     [R1, R2, R3] == [no_way, no_way, reached]) :-
    corridor([fade(10)],
             ( go(R1), move_box, sim_step(5), go(R2),
               sim_step(6), \+ obstructed(_), go(R3) )).
test(one_that_is_still_there_is_remembered_longer,
     [R1, R2, R3] == [no_way, no_way, no_way]) :-
    corridor([fade(10)],
             ( go(R1), sim_step(11), go(R2), move_box,
               sim_step(11), obstructed([0,2]), go(R3),
               sim_step(10), \+ obstructed(_) )).
% In a ring with two boxes the robot would go to and fro forever, if it forgot
% one box on the way to the other.
test(to_and_fro_comes_to_an_end, Reason == no_way) :-
    World = [bounds(-15, -15, 95, 95), box(40, 40, 46, 46), box(0, 80, 14, 14),
             box(80, 60, 14, 14)],
    with_sim(World,
             ( robot,
               set_grid([ bounds(0, 0, 4, 4), fade(3),
                          obstacles([ [1,1], [1,2], [1,3], [2,1], [2,2],
                                      [2,3], [3,1], [3,2], [3,3] ]) ]),
               plan_and_go_to([4,4], _, [reason(Reason)]) )).
test(time_is_that_of_the_tree, Passed =:= 7) :-
    corridor([fade(10)], ( ev3dev_native:now_(T0), sim_step(7), ev3dev_native:now_(T1) )),
    Passed is round(T1 - T0).
test(what_is_known_from_the_start_does_not_fade) :-
    corridor([fade(1), obstacles([[0,1]])],
             ( sim_step(10), obstructed([0,1]) )).
:- end_tests(fading).

:- begin_tests(execute_plan).
in_room(Cells, Goal) :-
    boxes(Cells, Boxes),
    with_sim([bounds(-15, -15, 75, 75)|Boxes],
             ( robot, set_grid([bounds(0, 0, 3, 3)]), call(Goal) )).

test(carries_it_out, Cell-Direction == [1,1]-[1,0]) :-
    in_room([],
            ( execute_plan([move, right, move]),
              state_position(Cell, Direction),
              sim_pose(X, Y, Heading)
            )),
    near(X, 20, 1),
    near(Y, 20, 1),
    near(Heading, 90, 2).
test(carries_out_plans_of_the_paper, Cell-Direction == [1,1]-[0,1]) :-
    in_room([], ( execute_plan([ move_if_free, turn_right, move_if_free,
                                 turn_left, fin ]),
                  state_position(Cell, Direction) )).
test(fin_is_the_end, error(domain_error(grid_action, fin), _)) :-
    in_room([], execute_plan([fin, move])).
test(turns_in_one_go, Direction == [0,-1]) :-
    in_room([], ( execute_plan([left, left, right, left]),
                  state_position(_, Direction) )).
test(nothing_is_soon_done) :-
    in_room([], execute_plan([])).
test(breaks_off_at_an_obstacle, Cell-Direction-Seen == [0,1]-[1,0]-[[1,1]]) :-
    in_room([[1,1]],
            ( \+ execute_plan([move, right, move, move]),
              state_position(Cell, Direction),
              findall(C, obstructed(C), Seen)
            )).
test(breaks_off_at_the_edge, Cell == [0,0]) :-
    in_room([], ( \+ execute_plan([left, move]),
                  state_position(Cell, _) )).
test(finds_that_an_obstacle_is_gone, Seen == []) :-
    in_room([], ( obstacle_add([0,1]), execute_plan([move]),
                  findall(C, obstructed(C), Seen) )).
test(no_action, error(domain_error(grid_action, hop), _)) :-
    in_room([], execute_plan([hop])).
test(unbound_action, error(instantiation_error, _)) :-
    in_room([], execute_plan([_])).
test(no_list, error(type_error(list, move), _)) :-
    in_room([], execute_plan(move)).
:- end_tests(execute_plan).

:- begin_tests(bad_input).
%   What is refused leaves everything as it is.

refused(Options, Error) :-
    with_sim([],
             ( robot,
               set_grid([start([2,2], [1,0])]),
               catch(set_grid([start([1,1], [0,1])|Options]),
                     error(Error, _), true),
               state_position([2,2], [1,0]),
               pose(X, Y, _)
             )),
    near(X, 40, 0.1),
    near(Y, 40, 0.1).

test(options, [forall(bad(Options, Expected)), Error =@= Expected]) :-
    refused(Options, Error).

bad([cell_cm(0)],               domain_error(positive_number, 0)).
bad([cell_cm(wide)],            type_error(evaluable, wide/0)).
bad([eye(near)],                type_error(evaluable, near/0)).
bad([origin(a, 0)],             type_error(evaluable, a/0)).
bad([speed(0)],                 domain_error(speed_ahead, 0)).
bad([speed(101)],               domain_error(speed_ahead, 101)).
bad([fade(-1)],                 domain_error(positive_number, -1)).
bad([fade(soon)],               type_error(evaluable, soon/0)).
bad([neighbors(5)],            domain_error(neighbors, 5)).
bad([bounds(0, 0, -1, 0)],      domain_error(bounds, bounds(0, 0, -1, 0))).
bad([obstacles([here])],        domain_error(grid_cell, here)).
bad([rows([1.5])],              type_error(atom, 1.5)).
bad([move_cost(-1)],            type_error(positive_integer, -1)).
bad([cell(20)],                 domain_error(grid_option, cell(20))).
bad([start([0, 0])],            domain_error(grid_option, start([0, 0]))).

test(options_are_a_list, error(type_error(list, x), _)) :-
    set_grid(x).
test(start_in_no_direction, error(domain_error(grid_state, _), _)) :-
    set_grid([start([0,0], [2,1])]).
test(place_in_no_direction, error(domain_error(grid_state, _), _)) :-
    with_sim([], ( robot, set_grid([]), grid_place([0,0], [1,1]) )).
test(goal_is_no_cell, error(domain_error(grid_cell, there), _)) :-
    with_sim([], ( robot, set_grid([]), plan_and_go_to(there, _) )).
test(goal_is_unbound, error(instantiation_error, _)) :-
    with_sim([], ( robot, set_grid([]), plan_and_go_to(_, _) )).
test(goal_has_no_direction, error(domain_error(grid_state, _), _)) :-
    with_sim([], ( robot, set_grid([]), plan_and_go_to([1,1], north) )).
test(go_options_are_a_list, error(type_error(list, x), _)) :-
    with_sim([], ( robot, set_grid([]), plan_and_go_to([1,1], _, x) )).
test(go_options_are_its_own, error(domain_error(grid_option, eye(7)), _)) :-
    with_sim([], ( robot, set_grid([]), plan_and_go_to([1,1], _, [eye(7)]) )).
test(obstacle_is_no_cell, error(domain_error(grid_cell, x), _)) :-
    obstacle_add(x).
test(obstacle_is_unbound, error(instantiation_error, _)) :-
    obstacle_remove(_).
:- end_tests(bad_input).

:- begin_tests(drawn).
%   A drawing is the same as a world and as a grid with cells as wide: the robot
%   starts in the same place.

drawing(["#.#", "#S#", "###"]).
drawing([">."]).
drawing(["..", ".v", "##"]).
drawing(["..", "<", "", " "]).
drawing(['#', '^#n']).

test(starts_alike, [ forall(drawing(Rows)), true(Pose == Placed) ]) :-
    with_sim([map(20, Rows)],
             ( sim_pose(X, Y, Heading),
               robot,
               set_grid([rows(Rows), origin(10, 10)]),
               pose(X1, Y1, Heading1) )),
    Pose0 = [X, Y, Heading],
    Placed0 = [X1, Y1, Heading1],
    maplist([A, B]>>(B is round(A)), Pose0, Pose),
    maplist([A, B]>>(B is round(A)), Placed0, Placed).
test(is_refused_alike,
     [ forall(member(Rows, [ ["S.", "..", ".^"], ["#?"], ["..", "#\t"], ["#\n#"],
                             [".", 7], [f(x)], [_], ["."|_], rows ])),
       true(ByWorld =@= ByGrid) ]) :-
    refusal(sim_start([map(20, Rows)], [clock(virtual)]), ByWorld),
    refusal(grid_map([rows(Rows)], _), ByGrid),
    ByGrid \== none.
test(says_what_is_wrong_with_file_and_line, true(Where-Why == 2-Words)) :-
    Words = 'map row 2 column 2 is a second start',
    with_file("floor(red).\nmap(20, [\"S.\", \".^\"]).\n", File,
              catch(sim_start(File), error(domain_error(map_row, ".^"), Context), true)),
    Context = fact(file(_, Where, _, _), Why).
test(without_a_start_leaves_that_of_the_world, true(X-Y == 50.0-10.0)) :-
    with_sim([start(50, 10, 0), map(20, ["#..", "..."])], sim_pose(X, Y, _)).

refusal(Goal, Refusal) :-
    (   catch(Goal, error(Formal, context(_, Words)), true)
    ->  (   var(Formal)
        ->  Refusal = none
        ;   Refusal = Formal-Words
        )
    ;   Refusal = fails
    ).
:- end_tests(drawn).

:- begin_tests(grid_navigation).
navigate(World, [X, Y], Output, Result) :-
    with_sim(World,
             ( with_output_to(string(Output),
                              (   grid_navigation:start([X, Y])
                              ->  Result = arrived
                              ;   Result = no_way
                              )),
               sim_pose(XCm, YCm, _),
               sim_collisions(Collisions) )),
    Collisions == [],
    (   Result == arrived
    ->  near(XCm, 20*X, 5),
        near(YCm, 20*Y, 5)
    ;   true
    ).

test(finds_its_way_in_the_shipped_grid) :-
    navigate(grid, [3, 3], Output, arrived),
    forall(member(Line, [ "obstacle in [0,3]\n", "arrived at [3,3]\n" ]),
           once(sub_string(Output, _, _, _, Line))).
test(says_that_there_is_no_way, Result == no_way) :-
    navigate([ bounds(-10, -10, 150, 150), start(0, 0, 0),
               box(120, 140, 14, 14), box(140, 120, 14, 14)
             ], [7, 7], Output, Result),
    once(sub_string(Output, _, _, _, "there is no way to [7,7]")).
test(says_what_else_is_wrong) :-
    with_sim(grid,
             ( sim_unplug(in1),
               sim_step(2),
               with_output_to(string(Output),
                              \+ grid_navigation:start([3, 3])) )),
    once(sub_string(Output, _, _, _, "cannot go on to [3,3]: no_sensor")).
test(takes_any_planner,
     [forall(member(Planner, [a_star, own_plan(free_cell)]))]) :-
    with_sim(grid,
             ( with_output_to(string(_),
                              grid_navigation:start([3, 3], Planner)),
               state_position(Cell, _)
             )),
    Cell == [3, 3].
:- end_tests(grid_navigation).
