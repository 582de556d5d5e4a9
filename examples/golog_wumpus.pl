% The cave of the wumpus, 4 by 4 cells of 30 cm: one cell has the wumpus, some
% have a pit, and both destroy a robot. There is a smell in the cells beside
% the wumpus, and a draft in the cells beside a pit; the gold glitters in its
% own cell.
%
%   ?- cave(0-2, [2-0, 2-2], 1-2, Cave), sim_start(Cave), start.
%
% The robot does not guess. It enters a cell only if it knows that it is safe:
% neither the wumpus nor a pit is there in any cave that agrees with what it
% has sensed. It brings the gold home, or comes home when no cell is left that
% it knows to be safe.

:- use_module(library(ev3dev)).
:- use_module(library(ev3dev/colors)).
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
    golog(hunt, Options).

% The domain: what is possible at first, and what sensing says about it

cell(X-Y) :-
    between(0, 3, X),
    between(0, 3, Y).

beside(X-Y0, X-Y) :- Y is Y0+1, Y =< 3.
beside(X0-Y, X-Y) :- X is X0+1, X =< 3.
beside(X-Y0, X-Y) :- Y is Y0-1, Y >= 0.
beside(X0-Y, X-Y) :- X is X0-1, X >= 0.

prim_action(go(C)) :-           % to the next cell
    cell(C).
prim_action(smell).
prim_action(feel).              % is there a draft?
prim_action(look).              % for the gold
prim_action(take).
prim_action(leave).

prim_fluent(at).
prim_fluent(wumpus).            % its cell
rel_fluent(pit(C)) :- cell(C).
rel_fluent(gold(C)) :- cell(C).
rel_fluent(visited(C)) :- cell(C).
rel_fluent(has_gold).

initially(at, 0-0).
initially(wumpus, C) :- cell(C), C \== 0-0.
initially(pit(C), true) :- C \== 0-0.
initially(pit(_), false).
initially(gold(_), true).
initially(gold(_), false).
initially(visited(C), V) :- ( C == 0-0 -> V = true ; V = false ).
initially(has_gold, false).

rejects(smell, 1, wumpus, C, neg(beside(at, C))).
rejects(smell, 0, wumpus, C, beside(at, C)).
settles(feel, 0, pit(C), false, beside(at, C)).
settles(feel, 1, pit(C), true,  % no other cell beside may have the pit
        and(beside(at, C), all(d, cell, impl(and(beside(at, d), neg(d = C)),
                                             neg(pit(d)))))).
settles(look, 1, gold(C), true, at = C).
settles(look, 0, gold(C), false, at = C).

causes_val(go(C), at, C, true).
causes_true(go(C), visited(C), true).
causes_true(take, has_gold, true).

poss(go(C), and(beside(at, C), safe(C))).
poss(smell, true).
poss(feel, true).
poss(look, true).
poss(take, gold(at)).
poss(leave, at = 0-0).

% The program

proc(safe(C), and(neg(pit(C)), neg(wumpus = C))).
proc(new(C), and(neg(visited(C)), safe(C))).

proc(hunt,
     [ sense,
       while(and(neg(gold(at)), some(c, cell, new(c))),
             [trip(new), sense]),
       if(gold(at), take, []),
       trip(home),
       leave ]).

proc(sense, [smell, feel, look]).
proc(trip(Where), pi(way, [?(shortest(at, Where, way)), follow(way)])).
proc(follow(Way), for(c, Way, go(c))).
proc(there(new, C), new(C)).
proc(there(home, C), C = 0-0).

%   Way is a shortest path from At over safe cells. The cells are tried in the
%   order of their distance.
shortest(At, Where, Way) :-
    now(History),
    found([[At]], [At], Where, History, Back),
    reverse(Back, [At|Way]).

found([[C|Back]|Ways], Seen, Where, History, Found) :-
    (   holds(there(Where, C), History)
    ->  Found = [C|Back]
    ;   findall(D, ( beside(C, D), \+ memberchk(D, Seen),
                     holds(safe(D), History) ), Ds),
        findall([D, C|Back], member(D, Ds), More),
        append(Ways, More, Ways1),
        append(Ds, Seen, Seen1),
        found(Ways1, Seen1, Where, History, Found)
    ).

% The robot. A cell has a green patch in the north-west if it smells, a blue
% one in the north-east if there is a draft, a yellow one in the south for the
% gold.

robot_action(go(X-Y), go_to(X1, Y1)) :-
    X1 is 30*X,
    Y1 is 30*Y.
robot_action(take, tone(880, 200)).
robot_action(leave, tones([tone(440, 200), tone(880, 400)])).
robot_sense(smell, S, sees(0, in2, green, S)).
robot_sense(feel, S, sees(0, in3, blue, S)).
robot_sense(look, S, sees(180, in2, yellow, S)).

sees(Heading, Port, Name, S) :-
    face(Heading),
    col_color(Port, Color),
    (   color_name(Color, Name)
    ->  S = 1
    ;   S = 0
    ).

% The cave, for the simulator. The clauses above never look at it.

cave(Wumpus, Pits, Gold, [ bounds(-15, -15, 105, 105), start(0, 0, 0)
                         | Patches ]) :-
    findall(patch(Color, [L-B, R-B, R-T, L-T]),
            ( marked(Color, X-Y, Wumpus, Pits, Gold),
              area(Color, West, South, East, North),
              L is 30*X+West,
              R is 30*X+East,
              B is 30*Y+South,
              T is 30*Y+North ),
            Patches).

marked(black, C, _, Pits, _) :- member(C, Pits).
marked(red, Wumpus, Wumpus, _, _).
marked(green, C, Wumpus, _, _) :- beside(Wumpus, C).
marked(blue, C, _, Pits, _) :- member(Pit, Pits), beside(Pit, C).
marked(yellow, Gold, _, _, Gold).

area(black, -13, -13, 13, 13).
area(red, -13, -13, 13, 13).
area(green, -9, 2, -1, 11).
area(blue, 1, 2, 9, 11).
area(yellow, -9, -11, 9, -2).
