% Search and rescue on a grid: the robot explores cells of 20 cm until it
% finds somebody, a red floor, and comes home to report.
%
%   ?- sim_start(grid), sim_add(patch(red, [48-28, 72-28, 72-52, 48-52])).
%   ?- start.
%
% It knows nothing about obstacles at first. It plans the shortest path to a
% cell that it has not visited, as if unknown cells were free. Before it
% enters an unknown cell it looks; if the cell is blocked, it plans again.

:- use_module(library(ev3dev)).
:- use_module(library(ev3dev/drive)).
:- use_module(library(ev3dev/odometry)).
:- use_module(library(ev3dev/golog)).

start :-
    start([]).

%   Options are those of golog/2. The robot stands in the cell 0-0 and looks
%   north.
start(Options) :-
    set_robot(5.6, 10.6, outB, outC),
    set_pose(0, 0, 0),
    golog(rescue, Options).

% The domain: a part of the grid

direction([north, east, south, west]).

next(X-Y0, north, X-Y) :- Y is Y0+1, Y =< 3.
next(X0-Y, east, X-Y) :-  X is X0+1, X =< 4.
next(X-Y0, south, X-Y) :- Y is Y0-1, Y >= 0.
next(X0-Y, west, X-Y) :-  X is X0-1, X >= 0.

prim_action(go(D)) :-
    domain(D, direction).
prim_action(look(D)) :-         % is the next cell blocked?
    domain(D, direction).
prim_action(check).             % is somebody here?
prim_action(report).

prim_fluent(at).
rel_fluent(visited(_)).
rel_fluent(blocked(_)).         % not known before a look
rel_fluent(found).
rel_fluent(surprise).           % the plan is wrong

initially(at, 0-0).
initially(visited(C), V) :-
    (   C == 0-0
    ->  V = true
    ;   V = false
    ).
initially(found, false).
initially(surprise, false).

poss(go(D), some(c, and(next(at, D, c), neg(blocked(c))))).
poss(look(D), some(c, next(at, D, c))).
poss(check, true).
poss(report, true).

causes_val(go(D), at, C, next(at, D, C)).
causes_true(check, visited(C), at = C).

%   What the outcome of looking, a distance in cm, says
senses(look(D), Cm, blocked(C), true, and(next(at, D, C), Cm < 18)).
senses(look(D), Cm, blocked(C), false, and(next(at, D, C), Cm >= 18)).
senses(look(_), Cm, surprise, true, Cm < 18).
senses(check, Color, found, true, Color = 5).

% The program

proc(rescue,
     [ while(neg(found), [trip(explore), if(surprise, [], check)]),
       while(neg(at = 0-0), trip(home)),
       report ]).

proc(trip(How),
     [ unset(surprise),
       gexec(neg(surprise), search(way(How, 1))) ]).

% The shortest path: one of at most Cells, else a longer one

proc(way(How, Cells),
     ndet(steps(How, Cells),
          [ ?(Cells < 15),
            pi(more, [?(more is Cells+1), way(How, more)]) ])).

proc(steps(How, Cells),
     if(there(How), [],
        [ ?(Cells > 0),
          pi((d, direction),
             [ step(d),
               pi(left, [?(left is Cells-1), steps(How, left)]) ]) ])).

proc(there(explore), neg(visited(at))).
proc(there(home), at = 0-0).

proc(step(D),
     pi(c, [ ?(next(at, D, c)),
             if(kwhether(blocked(c)), ?(neg(blocked(c))),
                if(visited(c), ?(true), look(D))),
             go(D) ])).

% The robot

robot_action(go(D), enter_cell(D)).
robot_action(report, tones([tone(440, 200), tone(880, 400)])).
robot_sense(look(D), Cm, ( heading(D, H), face(H), us_dist_cm(_, Cm) )).
robot_sense(check, Color, col_color(in2, Color)).

heading(north, 0).
heading(east, 90).
heading(south, 180).
heading(west, 270).

enter_cell(D) :-
    pose(X0, Y0, _),
    Column0 is round(X0/20),
    Row0 is round(Y0/20),
    next(Column0-Row0, D, Column-Row),
    heading(D, H),
    face(H),
    X is 20*Column,
    Y is 20*Row,
    go_to(X, Y).
