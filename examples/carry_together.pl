% Two robots with grippers carry a bar of 60 cm through a door. Neither does
% it alone: they grip, carry and release in the same step.
%
%   ?- start.
%
% The planner finds who goes to which end, and when. While they carry,
% somebody stops anna by the middle button of her brick. Then bob stops, too:
% the step has failed, and they plan again. To watch it:
%
%   ?- use_module(library(ev3dev/view)), view, start([clock(realtime)]).

:- use_module(library(ev3dev)).
:- use_module(library(ev3dev/bricks)).
:- use_module(library(ev3dev/drive)).
:- use_module(library(ev3dev/events)).
:- use_module(library(ev3dev/golog)).
:- use_module(library(ev3dev/gripper)).
:- use_module(library(ev3dev/odometry)).
:- use_module(library(ev3dev/sim)).

world([ bounds(-80, -80, 80, 250), floor(white),
        box(-47.5, 75, 65, 4), box(47.5, 75, 65, 4),    % a wall with a door
        patch(red, [-40-120, 40-120, 40-200, -40-200]),
        box(0, 0, 4, 60, 0, [mass(0.2), color(blue), name(bar)]),
        start(anna, -45, -45, 0), start(bob, 45, -45, 0) ]).

% The robot `carrier`, with jaws in which the bar can turn
robot([ left_wheel(outB, 5.6), right_wheel(outC, 5.6), axle(10.6),
        hull(circle(8)), mass(0.85),
        motor(outA, 'lego-ev3-m-motor', [stops(0, 90)]),
        motor(outB, 'lego-ev3-l-motor'), motor(outC, 'lego-ev3-l-motor'),
        gripper(outA, 0, 11, [opening(9), lifts(true), pivot(true)]),
        sensor(in3, 'lego-ev3-color', 0, 7, 0, [looks(ahead)]),
        sensor(in4, 'lego-ev3-gyro', 0, 0, 0) ]).

% ---------------- What there is

agent(anna).
agent(bob).

other(anna, bob).
other(bob, anna).

% Places around the bar. At an end a robot looks along it.
place(west).
place(east).
place(south).
place(north).

way(west, south).
way(south, east).
way(east, north).
way(north, west).

beside(P, Q) :- way(P, Q).
beside(P, Q) :- way(Q, P).

end(south, 0).                          % its heading there
end(north, 180).

% Where the middle of the bar may lie: before the door, in it, and behind it.
mark(1, 0).
mark(2, 40).
mark(3, 80).
mark(4, 120).
mark(5, 160).

next(M, N) :-
    mark(M, _),
    mark(N, _),
    abs(M-N) =:= 1.

% ---------------- What changes

prim_fluent(at(R)) :- agent(R).
prim_fluent(bar).                       % the mark where it lies
rel_fluent(holds(R)) :- agent(R).

initially(at(anna), west).
initially(at(bob), east).
initially(bar, 1).
initially(holds(_), false).

derived(carried, and(holds(anna), holds(bob))).
derived(delivered, and(bar = 5, neg(carried))).

% ---------------- What they can do

prim_action(go(R, P, Q)) :- agent(R), beside(P, Q).
prim_action(grip(R)) :- agent(R).
prim_action(carry(R, M, N)) :- agent(R), next(M, N).
prim_action(release(R)) :- agent(R).

poss(go(R, P, _), and(at(R) = P, neg(holds(R)))).
poss(grip(R), and(end(at(R), _), neg(holds(R)))).
poss(carry(R, M, _), and(holds(R), bar = M)).
poss(release(R), holds(R)).

causes_val(go(R, _, Q), at(R), Q, true).
causes_val(carry(_, _, N), bar, N, true).
causes_true(grip(R), holds(R), true).
causes_false(release(R), holds(R), true).

% Both, or none
together(grip(R), grip(Q)) :- other(R, Q).
together(carry(R, M, N), carry(Q, M, N)) :- other(R, Q).
together(release(R), release(Q)) :- other(R, Q).

% Nobody drives into the other one, nor through it.
always(neg(at(anna) = at(bob))).
excludes(go(_, P, Q), go(_, Q, P)).

% ---------------- How they do it

robot_action(_, go(_, P, Q), drive(P, Q)).
robot_action(R, grip(R), grip_end).
robot_action(_, carry(_, _, N), carry_to(N)).
robot_action(_, release(_), let_go).

% The bar may lie at any mark: places are seen from its middle, which each
% robot remembers.
:- dynamic middle/2.

spot(west, -45, -45).
spot(east, 45, -45).
spot(south, 0, -55).
spot(north, 0, 55).

drive(P, Q) :-
    use_brick(R),
    middle(R, Y),
    forall(corner(P, Q, X, DY),
           ( Y1 is Y+DY, go_to(X, Y1) )),
    (   end(Q, Heading)
    ->  face(Heading)
    ;   true
    ).

% Around the north end a robot keeps clear of the bar.
corner(east, north, 45, 55).
corner(west, north, -45, 55).
corner(north, east, 45, 55).
corner(north, west, -45, 55).
corner(_, Q, X, Y) :-
    spot(Q, X, Y).

% The color sensor looks into the open jaws: drive on until the bar is there.
grip_end :-
    release,
    go_cm(15, -12),
    line_up,
    until(bar_ahead, go_cm(6, 40)),
    bar_ahead,
    go_cm(6, 2.5),
    grip,
    aim.

bar_ahead :-
    col_color(in3, 2).                  % blue

line_up :-
    pose(X, Y, _),
    looks(Heading),
    (   abs(X) > 1
    ->  go_to(0, Y)
    ;   true
    ),
    face(Heading).

% Both begin to drive at the same moment, so they aim before: back to the line
% from the bar to where it belongs.
aim :-
    pose(X, _, _),
    looks(Heading),
    face(Heading - atan(X/40)*180/pi).

looks(Heading) :-
    pose(_, _, Heading0),
    (   cos(Heading0*pi/180) > 0
    ->  Heading = 0
    ;   Heading = 180
    ).

% The robot whose axle is 39 cm from the middle holds the end of the bar.
carry_to(Mark) :-
    mark(Mark, Middle),
    pose(_, Y0, _),
    looks(Heading),
    (   Heading =:= 0
    ->  Cm is Middle-39-Y0              % ahead
    ;   Cm is Y0-39-Middle              % back
    ),
    wait(0.5),
    until(button(enter), go_cm(15, Cm)),
    pose(_, Y, _),
    abs(abs(Middle-Y)-39) < 1,
    bar_ahead,
    aim,
    use_brick(R),
    retractall(middle(R, _)),
    assertz(middle(R, Middle)).

let_go :-
    release,
    go_cm(15, -15).

% ---------------- The run

start :-
    start([stop(true)]).

%   Options: stop(false) if nobody stops anna; the others are those of
%   sim_start/2.

start(Options0) :-
    (   select(stop(Stop), Options0, Options)
    ->  true
    ;   Stop = true,
        Options = Options0
    ),
    (   memberchk(clock(_), Options)
    ->  Clocked = Options
    ;   Clocked = [clock(virtual)|Options]
    ),
    world(World),
    robot(Robot),
    setup_call_cleanup(
        sim_start(World, [robots([anna-Robot, bob-Robot])|Clocked]),
        carry_together(Stop),
        forall(member(R, [anna, bob]), brick_close(R))).

carry_together(Stop) :-
    assertz(waits),
    bricks_do([anna, bob], ready),
    with_brick(anna,
               ( golog(achieve(delivered, [concurrent(true)]),
                       [ trace(told(Stop)), history(History),
                         timeout(300) ]),
                 sim_thing(bar, X, Y, _) )),
    length(History, Count),
    format("~d steps; the bar lies at ~1f, ~1f cm.~n", [Count, X, Y]).

ready :-
    set_robot(5.6, 10.6, outB, outC),
    set_gripper(outA, []),
    sim_pose(X, Y, Heading),
    set_pose(X, Y, Heading),
    use_brick(R),
    retractall(middle(R, _)),
    assertz(middle(R, 0)).

% Somebody presses the button of anna while the bar is in the door.
told(Stop, action(Step)) :-
    format("~w~n", [Step]),
    (   Stop == true,
        memberchk(carry(_, 2, 3), Step),
        retract(waits)
    ->  with_brick(anna, sim_press(enter, [after(2)]))
    ;   true
    ).

:- dynamic waits/0.
