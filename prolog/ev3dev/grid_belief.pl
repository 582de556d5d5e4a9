:- module(ev3dev_grid_belief,
          [ grid_belief/2,              % +Map, -Belief
            grid_sense/3,               % +Free, +Belief0, -Belief
            grid_motion/3,              % +Action, +Belief0, -Belief
            grid_belief_best/3,         % +Belief, -State, -Probability
            grid_belief_cell/3,         % +Belief, ?Cell, -Probability
            grid_belief_entropy/2,      % +Belief, -Bits
            grid_belief_svg/2,          % +Belief, +File
            grid_localize/2,            % +Map, -State
            grid_localize/3             % +Map, -State, :Options
          ]).
:- set_prolog_flag(generate_debug_info, false).
:- use_module(private/load/compiled, []).
:- use_module(private/basics/fields, [goal_expansion/2, term_expansion/2]).
:- use_module(private/checks/arguments, [must_be_options/3, number_option/4]).
:- use_module(private/run/brick, [brick/1, of_brick/1]).
:- use_module(private/checks/checks, [must_be/2]).
:- use_module(private/errors/errors, [domain_error/2]).
:- use_module(private/errors/public_clauses, [term_expansion/4]).
:- use_module(private/grid/map).
:- use_module(private/grid/moves, [go_to_cell/5]).
:- use_module(private/grid/place, [grid_metric/2, set_pose_in/3]).
:- use_module(private/maps/gray_squares, [write_shades/4]).
:- use_module(drive, [go_cm/3, set_pose/3]).
:- use_module(sensors, [us_dist_cm/2]).
:- use_module(library(apply), [foldl/4, maplist/3]).
:- use_module(library(lists), [max_member/2, member/2, sum_list/2]).
:- use_module(library(option), [meta_options/3, option/3]).
:- use_module(library(pairs), [pairs_values/2, transpose_pairs/2]).

:- meta_predicate grid_localize(+, -, :).

/** <module> Where on the grid am I?

A robot that knows the map, but not its cell, believes in each of its states
with some probability. What it sees and does changes that: this is the
histogram filter, or Markov localization on a grid.

```
?- grid_map([rows(["..#", "...", "#.."])], Map),
   grid_belief(Map, B0),
   grid_sense(2, B0, B1),           % two cells ahead are free, or more
   grid_motion(move, B1, B2),
   grid_belief_best(B2, State, Probability).
```

A belief is `belief(Map, Pairs)`: Pairs has State-Probability for each state
that is possible, in the standard order of states, and the probabilities sum
up to 1. A state is `state(Cell, Direction)`, as in grid_map/2.

grid_localize/3 has a robot find out. Source: Thrun, Burgard, Fox:
Probabilistic Robotics (2005), chapters 2 and 8.
*/

:- dynamic believed/3.                  % Brick, CellCm, Belief
:- volatile believed/3.
:- of_brick([believed/3]).

%   The most free cells ahead that are distinguished. Farther on the cone of
%   the sonar meets what stands beside the way.
farthest(2).

%!  grid_belief(+Map, -Belief) is det.
%
%   Each state in a free cell of Map is as probable as any other.

grid_belief(Map, belief(Map, Pairs)) :-
    findall(state(Cell, Direction)-1,
            ( free_cell(Map, Cell), grid_direction(Map, Direction) ),
            Pairs0),
    msort(Pairs0, Pairs1),
    normalized(Pairs1, Pairs).

%!  grid_sense(+Free, +Belief0, -Belief) is det.
%
%   The robot sees Free cells ahead before the first that is not: 0, 1, or 2
%   if there are two or more. Bayes' rule: each state becomes as much more
%   probable as it makes that more likely.
%
%   @error type_error(nonneg, Free)

grid_sense(Free, belief(Map, Pairs0), belief(Map, Pairs)) :-
    must_be(nonneg, Free),
    farthest(Most),
    Seen is min(Free, Most),
    maplist(weighted(Seen, Map), Pairs0, Pairs1),
    normalized(Pairs1, Pairs).

weighted(Seen, Map, State-P0, State-P) :-
    free_ahead(Map, State, Expected),
    likelihood(Seen, Expected, Likelihood),
    P is P0 * Likelihood.

%   How likely it is to see Seen where Expected are free. Nothing is
%   quite impossible, so that one false echo does not mislead forever.
likelihood(Seen, Expected, Likelihood) :-
    (   Seen =:= Expected
    ->  Likelihood = 0.9
    ;   Likelihood = 0.05
    ).

free_ahead(Map, State, Count) :-
    farthest(Most),
    free_ahead(Most, Map, State, Count).

free_ahead(Most, Map, State0, Count) :-
    (   Most > 0,
        next_free(Map, State0, State)
    ->  Most1 is Most-1,
        free_ahead(Most1, Map, State, Count1),
        Count is Count1+1
    ;   Count = 0
    ).

next_free(Map, State0, State) :-
    grid_step(Map, move, State0, State),
    State = state(Cell, _),
    free_cell(Map, Cell).

%!  grid_motion(+Action, +Belief0, -Belief) is det.
%
%   The robot has done Action: `move`, `left` or `right`. A move succeeds in
%   95 of 100 cases, where the cell is free; else the robot stays where it is.
%   A turn always succeeds.
%
%   @error domain_error(grid_action, Action)

grid_motion(Action, belief(Map, Pairs0), belief(Map, Pairs)) :-
    must_be_action(Action),
    findall(Next-P,
            ( member(State-P0, Pairs0),
              moved(Action, Map, State, Next, Share),
              P is P0 * Share ),
            Pairs1),
    keysort(Pairs1, Pairs2),
    summed(Pairs2, Pairs).

must_be_action(Action) :-
    must_be(nonvar, Action),
    (   memberchk(Action, [move, left, right])
    ->  true
    ;   domain_error(grid_action, Action)
    ).

moved(move, Map, State, Next, Share) :-
    !,
    (   next_free(Map, State, Free)
    ->  ( Next = Free, Share = 0.95 ; Next = State, Share = 0.05 )
    ;   Next = State,
        Share = 1
    ).
moved(Turn, Map, State, Next, 1) :-
    grid_step(Map, Turn, State, Next).

summed([], []).
summed([State-P0|Pairs0], Pairs) :-
    (   Pairs0 = [State-P1|Rest]
    ->  P is P0+P1,
        summed([State-P|Rest], Pairs)
    ;   Pairs = [State-P0|Pairs1],
        summed(Pairs0, Pairs1)
    ).

normalized(Pairs0, Pairs) :-
    pairs_values(Pairs0, Values),
    sum_list(Values, Sum),
    maplist(divided(Sum), Pairs0, Pairs).

divided(Sum, State-P0, State-P) :-
    P is P0 / float(Sum).

%!  grid_belief_best(+Belief, -State, -Probability) is semidet.
%
%   State is the most probable one; of several, the last in the standard
%   order. Fails if the map has no free cell.

grid_belief_best(belief(_, Pairs), State, Probability) :-
    transpose_pairs(Pairs, ByProbability),
    max_member(Probability-State, ByProbability).

%!  grid_belief_cell(+Belief, ?Cell, -Probability) is nondet.
%
%   Probability is that of Cell, whichever way the robot looks.

grid_belief_cell(belief(Map, Pairs), Cell, Probability) :-
    free_cell(Map, Cell),
    findall(P, member(state(Cell, _)-P, Pairs), Ps),
    sum_list(Ps, Probability).

%!  grid_belief_entropy(+Belief, -Bits) is det.
%
%   How uncertain the belief is: 0 if one state is certain, and a bit more
%   each time twice as many are equally probable.

grid_belief_entropy(belief(_, Pairs), Bits) :-
    foldl(information, Pairs, 0, Bits).

information(_-P, Bits0, Bits) :-
    (   P > 0
    ->  Bits is Bits0 - P * log(P) / log(2)
    ;   Bits = Bits0
    ).

%!  grid_belief_svg(+Belief, +File) is det.
%
%   Draw the belief: the darker a cell, the more probable; the most probable
%   is black. What is obstructed has the color of the margin.

grid_belief_svg(Belief, File) :-
    shares(Belief, bounds(X1, Y1, X2, Y2), Shares),
    Left is 20*X1 - 10,
    Low is 20*Y1 - 10,
    Right is 20*X2 + 10,
    High is 20*Y2 + 10,
    findall(cell(X, Y, Share),
            ( member([CX, CY]-Share, Shares),
              X is 20*CX,
              Y is 20*CY ),
            Drawn),
    write_shades(File, 20, bounds(Left, Low, Right, High), Drawn).

%   Bounds of the map, and the probability of each free cell as a share of
%   that of the most probable one.
shares(Belief, bounds(X1, Y1, X2, Y2), Shares) :-
    Belief = belief(Map, _),
    grid_bounds(Map, X1, Y1, X2, Y2),
    findall(Cell-P, grid_belief_cell(Belief, Cell, P), Pairs),
    pairs_values(Pairs, Ps),
    max_member(Most, Ps),
    findall(Cell-Share,
            ( member(Cell-P, Pairs), Share is P/Most ),
            Shares).

%!  grid_localize(+Map, -State) is semidet.
%!  grid_localize(+Map, -State, :Options) is semidet.
%
%   Find out where on Map the robot is, by looking and moving, and set pose/3
%   to it. Waits. It stands in the middle of an unknown cell, and looks in a
%   direction of the grid. Fails if it is not sure in time, or cannot go on.
%   Options:
%
%     - sure(+Probability)
%       Default is 0.95.
%     - actions(+Count)
%       The most moves and turns. Default is 60.
%     - policy(:Policy)
%       The next action: call(Policy, Free, Done, Belief, Action), where Done
%       are the actions so far, the last one first. `entropy`, the default:
%       after which one more look may be expected to show most, and after 15
%       actions as `ahead`: ahead while a cell is free there, else a turn to
%       the side where the way is more probably free.
%     - tell(:Closure)
%       call(Closure, Free, Belief) is called after each look.
%     - cell_cm(+Cm)
%     - eye(+Cm)
%     - speed(+Percent)
%       As for set_grid/1: 20, 7 and 20 by default.
%
%   @error domain_error(grid_belief_option, Option)

grid_localize(Map, State) :-
    grid_localize(Map, State, ev3dev_grid_belief:[]).

grid_localize(Map, State, Module:Options0) :-
    must_be_options(grid_belief_option,
                    [sure, actions, policy, tell, cell_cm, eye, speed],
                    Options0),
    meta_options(closure, Module:Options0, Options),
    number_option(sure(Sure), positive_number, Options, 0.95),
    option(actions(Most), Options, 60),
    must_be(nonneg, Most),
    option(policy(Policy0), Options, Module:entropy),
    policy_meant(Policy0, Policy),
    option(tell(Tell), Options, ev3dev_grid_belief:nobody),
    grid_metric(Options, Metric),
    grid_belief(Map, Belief),
    Here = state([0, 0], [0, 1]),
    set_pose(0, 0, 0),
    brick(Brick),
    setup_call_cleanup(
        true,
        seek(Most, trip(Map, Sure, Policy, Tell, Metric), Here, [], Belief,
             State),
        retractall(believed(Brick, _, _))),
    !,
    State = state(Cell, Direction),
    set_pose_in(Metric, Cell, Direction).

closure(policy).
closure(tell).

nobody(_, _).

policy_meant(_:Name, ev3dev_grid_belief:Name) :-
    memberchk(Name, [ahead, entropy]),
    !.
policy_meant(Policy, Policy).

%   Here is the state in the robot's own frame, where it began in [0, 0].
seek(Left, Trip, Here, Done, Belief0, State) :-
    Trip = trip(Map, Sure, Policy, Tell, Metric),
    free_seen(Metric, Free),
    grid_sense(Free, Belief0, Belief1),
    shown(Metric, Belief1),
    ignore(call(Tell, Free, Belief1)),
    grid_belief_best(Belief1, Best, Probability),
    (   Probability >= Sure
    ->  State = Best
    ;   Left > 0,
        once(call(Policy, Free, Done, Belief1, Action)),
        act(Action, Map, Metric, Here, There),
        (   There == Here               % there was something, unseen
        ->  grid_sense(0, Belief1, Belief)
        ;   grid_motion(Action, Belief1, Belief)
        ),
        Left1 is Left-1,
        seek(Left1, Trip, There, [Action|Done], Belief, State)
    ).

shown(Metric, Belief) :-
    Metric = metric(cm: Cm),
    brick(Brick),
    retractall(believed(Brick, _, _)),
    assertz(believed(Brick, Cm, Belief)).

%   What is seen of a wall or a box stands 10 to 13 cm from the middle of a
%   cell of 20 cm, or one or two cells farther on.
free_seen(Metric, Free) :-
    Metric = metric(cm: Cm, eye: Eye),
    us_dist_cm(_, Distance),
    Free is max(0, round((Distance + Eye) / Cm - 0.575)).

act(Action, Map, Metric, Here, There) :-
    Metric = metric(speed: Speed),
    grid_step(Map, Action, Here, Next),
    go_to_state(Next, Metric, Speed, Reason),
    (   Reason == reached
    ->  There = Next
    ;   Reason == stalled,
        loosened(Speed),
        go_to_state(Next, Metric, Speed, reached)
    ->  There = Next
    ;   Reason == stalled,
        Action == move,
        Reverse is -Speed,
        go_to_state(Here, Metric, Reverse, reached),
        There = Here
    ).

go_to_state(state(Cell, Direction), Metric, Speed, Reason) :-
    go_to_cell(Cell, Direction, Metric, Speed, Reason).

%   It touches something, and cannot turn: a little back or ahead.
loosened(Speed) :-
    member(Cm, [-3, 3]),
    go_cm(Speed, Cm, [reason(reached)]),
    !.

%   The policies: call(Policy, +Free, +Done, +Belief, -Action)

%   It rather turns to the other side than the last time: always to the same,
%   it might circle forever.
ahead(Free, Done, belief(Map, Pairs), Action) :-
    (   Free > 0
    ->  Action = move
    ;   Done = [move|_],
        member(Last, Done),
        other(Last, Other)
    ->  more_open(Other, Last, 0.3, Map, Pairs, Action)
    ;   more_open(left, right, 1, Map, Pairs, Action)
    ).

%   Turn is One where that way is free with more than Share of the probability
%   of the way to the side of Two, and else Two.
more_open(One, Two, Share, Map, Pairs, Turn) :-
    side_open(One, Map, Pairs, P1),
    side_open(Two, Map, Pairs, P2),
    (   P1 > Share * P2
    ->  Turn = One
    ;   Turn = Two
    ).

%   How probable it is that the cell at that side is free.
side_open(Turn, Map, Pairs, Probability) :-
    findall(P,
            ( member(State-P, Pairs),
              grid_step(Map, Turn, State, Turned),
              next_free(Map, Turned, _) ),
            Ps),
    sum_list(Ps, Probability).

%   A second look at the same cells adds little, though the filter takes each
%   look for a new one: so it does not turn back, nor all around. It may go
%   round in circles all the same, where only a longer way would help.
entropy(Free, Done, Belief, Action) :-
    length(Done, Count),
    Count >= 15,
    !,
    ahead(Free, Done, Belief, Action).
entropy(Free, Done, Belief, Action) :-
    findall(Bits-Possible,
            ( possible(Free, Done, Possible),
              expected(Possible, Belief, Bits) ),
            Expected),
    msort(Expected, [_-Action|_]).

possible(Free, _, move) :-
    Free > 0.
possible(Free, Done, Turn) :-
    other(Turn, Other),
    (   Done = [Other|_]
    ->  fail
    ;   Done = [Turn, Turn|_]
    ->  Free =:= 0
    ;   true
    ).

other(left, right).
other(right, left).

%   The entropy that is to be expected after Action and one more look.
expected(Action, Belief0, Bits) :-
    grid_motion(Action, Belief0, Belief),
    farthest(Most),
    findall(Share,
            ( between(0, Most, Free),
              seen_with(Free, Belief, Probability),
              grid_sense(Free, Belief, After),
              grid_belief_entropy(After, Bits1),
              Share is Probability * Bits1 ),
            Shares),
    sum_list(Shares, Bits).

seen_with(Free, belief(Map, Pairs), Probability) :-
    findall(P,
            ( member(Pair, Pairs), weighted(Free, Map, Pair, _-P) ),
            Ps),
    sum_list(Ps, Probability).
