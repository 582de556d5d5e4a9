% Lets an example drive in the simulator, says where it is going, and leaves a
% picture of its way, demo.svg.

:- asserta(user:file_search_path(library, prolog)).
:- use_module(library(ev3dev)).
:- use_module(library(ev3dev/sim)).

%!  show(+Example, +Seconds, +View)
%
%   Run an example for at most Seconds by the wall: as fast as in reality with
%   the view in a browser, if View is true; six times as fast without.

show(Part, Seconds, View) :-
    part_of(Part, Example),
    !,
    show(Example, Seconds, View).
show(Example, Seconds, View) :-
    (   demo(Example, World, Goal)
    ->  true
    ;   World = room,
        Goal = start
    ),
    load_files(user:examples/Example, []),
    (   robot(Example, Robot)
    ->  true
    ;   Robot = default
    ),
    (   View == true,
        sim_start(World, [clock(realtime), robot(Robot)]),
        start_view
    ->  Pace = 'in a browser'
    ;   sim_start(World, [clock(scaled(6)), robot(Robot)]),
        Pace = 'six times as fast as real'
    ),
    format("~w of ~w, ~w:~n", [Goal, Example, Pace]),
    thread_create(tell, Teller, []),
    prepare(Example),
    catch(call_with_time_limit(Seconds, ignore(user:Goal)),
          time_limit_exceeded,
          stop_all_motors),
    thread_send_message(Teller, stop),
    thread_join(Teller, _),
    sim_collisions(Collisions),
    length(Collisions, Count),
    ( Count =:= 1 -> Plural = '' ; Plural = s ),
    format("It ran into something ~D time~w. Its way is in demo.svg.~n",
           [Count, Plural]),
    sim_svg('demo.svg'),
    halt(0).

%   Prints its address. Without a server the demo goes on.

start_view :-
    catch(( use_module(library(ev3dev/view)),
            View = ev3dev_view:view,
            call(View) ),
          Error,
          ( print_message(warning, Error), fail )).

demo(obstacle_avoidance, room, start).
demo(grid_navigation, grid, start).
demo(backtracking, room, \+ start).           % it shows how it fails
demo(braitenberg, lights, vehicle(taste)).
demo(braitenberg_selection, lights, start).
demo(line_following, line, start).
demo(square, [start(0, 0, 0)], start).
demo(slalom, Poles, start) :-
    findall(circle(0, Y, 3), member(Y, [30, 90, 150, 210]), Poles).
demo(remote_control, [start(0, 0, 0)], drive).
demo(thermometer, room, thermometer).
demo(compare_planners, grid, start).
demo(pushed, grid, start).
demo(lost, room, start).
demo(grid_lost, grid, start).
demo(explore_room, room, start).
demo(traffic_light, room, start).
demo(golog_elevator, room, start(smart)).
demo(golog_classic, room, start).
demo(golog_delivery, delivery, start).
demo(golog_rescue, grid, start).
demo(golog_wumpus, [bounds(-15, -15, 105, 105)], start).
demo(brick_check, room, brick_check:report).
demo(rules_light_seeker, lights, start).
demo(rules_line_follower, line, start).
demo(rules_sumo, sumo, start).
demo(clear_the_ring, cans, start).
demo(sort_parcels, parcels, start).
demo(goal, soccer, start).
demo(three_places, [ bounds(0, 0, 220, 200), start(30, 30, 0),
                     box(120, 70, 30, 20) ],
     start).
demo(rules_traffic_light, [ambient(20)], start).
demo(plnxt_program, [ bounds(0, 0, 150, 150), start(40, 40, 30),
                      patch(black, [100-0, 150-0, 150-150, 100-150]) ],
     start).
demo(rules_processes, [wall(-50, 150, 50, 150)], start).

robot(rules_wander, touch).
robot(sort_parcels, carrier).
robot(goal, carrier).

%   Files that do nothing by themselves, and a program that uses them.

part_of(plnxt, plnxt_program).
part_of(grid_planner, grid_navigation).

%   What somebody has to do beside the robot.

prepare(traffic_light) :-
    !,
    sim_press(enter, [after(10)]),
    sim_press(down, [after(60)]).
prepare(golog_elevator) :-
    !,
    sim_press(up, [after(5)]),
    sim_press(left, [after(10)]),
    sim_press(right, [after(12)]).
prepare(golog_delivery) :-
    !,
    sim_press(left, [after(2)]),
    forall(member(Time, [15, 40, 60, 80]), sim_press(enter, [after(Time)])),
    sim_press(up, [after(20)]).
prepare(golog_rescue) :-
    !,
    sim_add(patch(red, [48-28, 72-28, 72-52, 48-52])).
prepare(golog_wumpus) :-
    !,
    user:cave(0-2, [2-0, 2-2], 1-2, [_, _|Patches]),
    forall(member(Patch, Patches), sim_add(Patch)).
prepare(pushed) :-
    !,
    sim_at(6, sim_place(60, 140, 180)).
prepare(rules_line_follower) :-
    !,
    sim_add(circle(150, 40, 4)),
    sim_at(10, sim_remove(circle(150, 40, 4))).
prepare(rules_processes) :-
    !,
    sim_press(enter, [after(2)]),
    sim_press(up, [after(15)]),
    sim_press(enter, [after(30)]),
    sim_press(down, [after(33)]).
prepare(remote_control) :-
    !,
    sim_unplug(in4),
    sim_plug(in4, 'lego-ev3-ir'),
    sim_step(2),
    sim_remote(1, [red_up, blue_up]).
prepare(thermometer) :-
    !,
    sim_unplug(in1),
    sim_plug(in1, 'lego-nxt-temp'),
    sim_step(2).
prepare(_).

tell :-
    sim_time(Time),
    sim_pose(X, Y, Heading),
    Degrees is round(Heading),
    format("~t~1f~6| s: x ~t~1f~16|, y ~t~1f~26| cm, heading ~t~d~42|~n",
           [Time, X, Y, Degrees]),
    flush_output,
    thread_self(Me),
    (   thread_get_message(Me, stop, [timeout(1)])
    ->  true
    ;   tell
    ).
