:- module(course_mistakes,
          [ course_program/6            % ?Exercise, ?Name, ?Of, -Edits, -Points, -Why
          ]).

/** <module> Programs as students write them, and the points that a teacher would give
*/

%!  course_program(?Exercise, ?Name, ?Of, -Edits, -Points, -Why) is nondet.
%
%   In the exercise of this folder of course/, the `skeleton` or the `solution`, with Edits that
%   are Old-New, deserves Points, which are Least-Most. Why is a reason in a sentence.

course_program(E, skeleton, skeleton, [], 0-Most, "Nothing was done yet.") :-
    skeleton(E, Most).
course_program(E, solution, solution, [], 10-10, "It is the model.") :-
    skeleton(E, _).
course_program(E, Name, Of, Edits, Points, Why) :-
    program(E, Name, Of, Edits, Points, Why).

skeleton('01-first-moves', 0).
skeleton('02-sensors', 1).
skeleton('03-obstacles', 3).
skeleton('04-line', 1).
skeleton('05-planners', 0).
skeleton('06-unknown-grids', 2).
skeleton('07-golog', 0).
skeleton('08-competition', 1).
skeleton('09-parcels', 1).

program('01-first-moves', first_success, skeleton,
        [ "go_cm(30, 60)."-"go_cm(30, 60), turn(20, 90), go_cm(30, 60)." ],
        2-2, "It drives two sides.").
program('01-first-moves', another_way, skeleton,
        [ "go_cm(30, 60)."-"forall(between(1, 4, _), ( go_cm(50, 60), turn(30, 90) ))." ],
        10-10, "It drives the square.").
program('01-first-moves', counterclockwise, solution, ["turn(20, 90)"-"turn(20, -90)"],
        0-2, "It goes the wrong way around, and into a wall.").
program('01-first-moves', three_sides, solution, ["side, side, side, side"-"side, side, side"],
        5-8, "It is at each corner, but does not come back.").
program('01-first-moves', turns_too_little, solution, ["turn(20, 90)"-"turn(20, 45)"],
        0-2, "It drives an octagon.").
program('01-first-moves', does_not_wait, solution, ["go_cm(30, 60)"-"go(30)"],
        0-1, "A turn ends each side at once.").
program('01-first-moves', no_end, solution, ["side, side, side, side."-"side, side, side, side, start."],
        3-8, "It drives on.").

program('02-sensors', first_success, skeleton,
        [ "wires(Left, Right, Left, Right)."-"wires(Left, Right, Right, Left)." ],
        4-6, "It finds the lamp and does not stop.").
program('02-sensors', another_way, skeleton,
        [ "wires(Left, Right, SpeedLeft, SpeedRight),"-
          "( Left >= 98, Right >= 98 -> go_cm(30, 35), halt ; true ), wires(Left, Right, SpeedLeft, SpeedRight),",
          "wires(Left, Right, Left, Right)."-"wires(L, R, SL, SR) :- SL is 15+R/3, SR is 15+L/3." ],
        10-10, "It adds to a basic speed what the other eye sees.").
program('02-sensors', fear, skeleton,
        [ "wires(Left, Right, Left, Right)."-"wires(L, R, SL, SR) :- SL is 20+L, SR is 20+R." ],
        0-2, "The wires do not cross: it flees.").
program('02-sensors', blind, skeleton,
        [ "wires(Left, Right, Left, Right)."-"wires(_, _, 25, 25)." ],
        0-3, "It drives straight ahead into a wall.").
program('02-sensors', wrong_way_around, solution,
        [ "25 - Difference"-"25 + Difference", "SpeedRight is 25 + Diff"-"SpeedRight is 25 - Diff" ],
        0-3, "The difference steers away from the lamp.").
program('02-sensors', stops_too_early, solution, ["> 190"-"> 60", "go_cm(20, 40)"-"stop"],
        0-4, "It stops far from the lamp.").
program('02-sensors', drives_past, solution, ["> 190"-"> 300"],
        4-6, "It does not stop.").

program('03-obstacles', first_success, skeleton,
        [ "start :-"-"avoid :: us_dist_cm(in1, Cm), Cm < 30 ~> turn(20). start :-",
          "[wander]"-"[avoid, wander]" ],
        7-9.5, "It touches nothing, but it is slow.").
program('03-obstacles', another_way, solution,
        [ "< 45"-"< 40", "turn(30)"-"turn(-30)" ],
        10-10, "It turns the other way.").
program('03-obstacles', wrong_order, solution, ["[avoid, wander]"-"[wander, avoid]"],
        0-3, "The first rule always applies.").
program('03-obstacles', too_near, solution, ["< 45"-"< 12"],
        2-6, "It turns when it is too late.").
program('03-obstacles', stops, solution, ["turn(30)"-"stop"],
        0-2, "It stops at the first wall.").
program('03-obstacles', turns_around, solution, ["turn(30)"-"turn(30, 180)"],
        0-6, "It goes to and fro.").
program('03-obstacles', turns_for_ever, solution, ["< 45"-"< 400"],
        0-1, "Something is always nearer than that.").

program('04-line', first_success, skeleton,
        [ "rate(_, 0)."-"rate(Error, Rate) :- Rate is 1.0*Error." ],
        7-8, "It follows the line, but it is slow.").
program('04-line', another_way, skeleton,
        [ "drive_cm(10,"-"drive_cm(18,",
          "rate(_, 0)."-"rate(Error, Rate) :- Rate is max(-70, min(70, 2*Error))." ],
        10-10, "It follows the line fast, by P alone.").
program('04-line', wrong_sign, skeleton,
        [ "rate(_, 0)."-"rate(Error, Rate) :- Rate is -1.5*Error." ],
        0-2, "It turns away from the edge, and follows the other one.").
program('04-line', bang_bang, skeleton,
        [ "rate(_, 0)."-"rate(Error, 40) :- Error > 0. rate(Error, -40) :- Error =< 0." ],
        4-7, "It gets around, but shakes.").
program('04-line', fast_bang_bang, skeleton,
        [ "drive_cm(10,"-"drive_cm(16,",
          "rate(_, 0)."-"rate(Error, 90) :- Error > 0. rate(Error, -90) :- Error =< 0." ],
        4-7, "It gets around, but shakes.").
program('04-line', too_weak, skeleton,
        [ "rate(_, 0)."-"rate(Error, Rate) :- Rate is 0.1*Error." ],
        0-4, "It loses the line in a bend.").
program('04-line', no_middle, skeleton,
        [ "Light-50"-"Light", "rate(_, 0)."-"rate(Error, Rate) :- Rate is 1.0*Error." ],
        0-2, "Its error is never negative: it turns right only.").

program('05-planners', another_way, skeleton,
        [ "plan(Goal, Goal, [])."-"plan(State, Goal, Plan) :- length(Plan, _), path(State, Goal, Plan). path(Goal, Goal, []).",
          "plan(State, Goal, [Action|Plan]) :-"-"path(State, Goal, [Action|Plan]) :- State = state([X, Y], _), Goal = state([X1, Y1], _), length(Plan, N), abs(X1-X) + abs(Y1-Y) =< N+1,",
          "plan(Next, Goal, Plan)."-"path(Next, Goal, Plan)." ],
        10-10, "It is iterative deepening.").
program('05-planners', not_shortest, solution,
        [ "append(Queue0, Nexts, Queue)"-"append(Nexts, Queue0, Queue)" ],
        7-7, "It is depth-first search: the path is not a shortest one.").
program('05-planners', no_reverse, solution, ["reverse(Reversed, Plan)"-"Plan = Reversed"],
        0-1, "The plan begins with its last action.").
program('05-planners', by_hand, skeleton,
        [ "plan(Goal, Goal, [])."-
          "plan(_, _, Plan) :- !, findall(move, between(1, 7, _), Moves), append(Moves, [right|Moves], Plan)." ],
        0-1, "Nobody looked where the boxes are.").
program('05-planners', no_boxes, solution, ["    between(0, 7, Y),\n    \\+ box_in(X, Y)."-"    between(0, 7, Y)."],
        0-1, "It plans through boxes.").
program('05-planners', left_is_right, solution,
        [ "step(right,"-"step(middle,", "step(left,"-"step(right,", "step(middle,"-"step(left," ],
        0-1, "It turns the wrong way.").

program('06-unknown-grids', another_way, skeleton,
        [ "planner(plan)"-"planner(d_star_lite)" ],
        10-10, "A planner of the library is allowed.").
program('06-unknown-grids', x_for_y, solution, ["obstructed([X, Y])"-"obstructed([Y, X])"],
        0-3, "It looks for obstacles in other cells.").
program('06-unknown-grids', forgets_obstacles, solution, ["\\+ obstructed([X, Y])"-"true"],
        0-2, "It plans through what it has seen.").
program('06-unknown-grids', afraid, solution, ["\\+ obstructed([X, Y])"-"obstructed([X, Y])"],
        0-1, "It takes what is occupied for free, so it has no plan.").
program('06-unknown-grids', goal_is_a_cell, solution,
        [ "search([Goal-Plan|_], _, Goal, Plan) :-"-"search([state(Goal, _)-Plan|_], _, Goal, Plan) :-" ],
        0-1, "The goal is a state, no cell.").
program('06-unknown-grids', long_ways, solution,
        [ "append(Queue0, Nexts, Queue)"-"append(Nexts, Queue0, Queue)" ],
        6-9, "Its ways are too long.").

program('07-golog', one_table, skeleton,
        [ "[ interrupt(true, wait) ]"-
          "[ interrupt(and(waits(up), neg(at = up)), go(up)), interrupt(and(at = up, waits(up)), serve(up)), interrupt(true, wait) ]",
          "poss(go(_), true)."-"poss(go(_), true). poss(serve(T), and(at = T, waits(T))). causes_false(serve(T), waits(T), true)." ],
        0-2, "It serves one table.").
program('07-golog', another_way, solution,
        [ "[?(is_next(t)), go(t)]"-"[?(and(waits(t), neg(some((u, table), and(waits(u), call_of(u) < call_of(t)))))), go(t)]" ],
        10-10, "The same in other words.").
program('07-golog', in_the_order_of_the_list, solution,
        [ "[?(is_next(t)), go(t)]"-"[?(waits(t)), go(t)]" ],
        8-9.1, "It serves the first table of the list, and not the one that has waited longest.").
program('07-golog', serves_again_and_again, solution, ["causes_false(serve(T), waits(T), true)."-""],
        0-3, "A table that was served still waits.").
program('07-golog', stays_there, solution, ["interrupt(neg(at = home), go(home)),"-""],
        7-8, "It does not come back.").
program('07-golog', serves_from_afar, solution,
        [ "poss(serve(T), and(at = T, waits(T)))."-"poss(serve(T), waits(T)).",
          "and(at = t, waits(t))),"-"waits(t)),", "[?(at = t), serve(t)]"-"[?(waits(t)), serve(t)]" ],
        0-2, "It says the names and does not move.").
program('07-golog', home_comes_first, solution,
        [ "[ interrupt(some((t, table), and(at = t, waits(t))),"-
          "[ interrupt(neg(at = home), go(home)), interrupt(some((t, table), and(at = t, waits(t)))," ],
        0-4, "It goes home before it has served.").

program('08-competition', another_way, skeleton,
        [ "drive(none)"-"nb_setval(left, 8), catch(drive(none), over, stop)",
          "say(Station)"-"( say(Station), nb_getval(left, N), M is N-1, nb_setval(left, M), ( M =:= 0 -> throw(over) ; true ) )",
          "col_color(in3, 5)."-"col_color(in3, 5). station(yellow) :- col_color(in3, 4). station(green) :- col_color(in3, 3). station(blue) :- col_color(in3, 2).",
          "drive_cm(10,"-"drive_cm(22," ],
        10-10, "It counts the stations in another way.").
program('08-competition', says_it_again, solution, ["Next = Station"-"Next = none"],
        0-1, "It says a station as long as it sees it.").
program('08-competition', one_round, solution, ["drive(none, 8)"-"drive(none, 4)"],
        4-6, "It stops after one round.").
program('08-competition', wrong_color, solution, ["station(3, green)"-"station(3, blue)"],
        1-4, "It takes green for blue.").
program('08-competition', slow, solution, ["drive_cm(22,"-"drive_cm(7,"],
        7-8, "It is slow.").
program('08-competition', no_end, solution, ["drive(_, 0) :-"-"drive(_, -100) :-"],
        7-9, "It does not stop after two rounds.").
program('08-competition', too_fast, solution, ["drive_cm(22,"-"drive_cm(50,"],
        0-4, "It loses the line.").

program('09-parcels', first_success, skeleton,
        [ "deliver(40, 25). "-"col_color(in3, Color), station(Color, X, Y), deliver(X, Y). " ],
        0-2, "It brings one parcel, if that does not lie beside its place.").
program('09-parcels', all_places, skeleton,
        [ "    fetch(40, 125),\n"-"",
          "deliver(40, 25). "-"forall(place(X, Y), ignore(( fetch(X, Y), col_color(in3, C), station(C, X1, Y1), deliver(X1, Y1) ))). " ],
        4-4, "It brings two parcels, and does not find those beside their places.").
program('09-parcels', another_way, solution,
        [ "place(40, 125).\n"-"", "place(160, 125).\n"-"place(160, 125).\nplace(40, 125).\n",
          "between(-8, 8, Step)"-"between(-15, 15, Step)", "5*Step"-"3*Step" ],
        10-10, "It begins at another place, and looks more closely.").
program('09-parcels', wrong_color, solution, ["station(3, 120"-"station(2, 120", "station(2, 160"-"station(3, 160"],
        4-4, "It takes green for blue, and blue for green.").
program('09-parcels', all_are_red, solution, ["    station(Color, StationX"-"    Color > 0, station(5, StationX"],
        0-2, "It brings all to one station.").
program('09-parcels', does_not_grip, solution, ["    grip."-"    true."],
        0-0, "It drives to and fro with open jaws.").
program('09-parcels', does_not_release, solution, ["    go_cm(20, 24),\n    release,\n"-"    go_cm(20, 24),\n"],
        0-2, "It puts a parcel down when it wants to grip the next.").
program('09-parcels', looks_too_far, solution, ["Cm < 28."-"Cm < 60."],
        0-6, "It takes other parcels and the wall for the one that it looks for.").
program('09-parcels', no_middle, solution, ["Heading is (First+Last)/2"-"Last =:= Last, Heading = First"],
        0-4, "It drives to the first echo, and not to the middle of them.").
program('09-parcels', slow, solution,
        [ "go_cm(20, 24)"-"go_cm(4, 24)", "go_cm(-20, 24)"-"go_cm(-4, 24)", "go_cm(20, Cm"-"go_cm(4, Cm" ],
        8-8, "It is slow.").
program('09-parcels', moves_by_hand, skeleton,
        [ "library(ev3dev/gripper))."-"library(ev3dev/gripper)).\n:- use_module(library(ev3dev/sim)).",
          "    fetch(40, 125),\n"-"    sim_place(40, 109, 0), fetch(40, 125)," ],
        0-0, "A program has no commands of the simulator.").
