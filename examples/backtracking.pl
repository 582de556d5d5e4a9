% A lecture on backtracking: Prolog tries ways, and the robot drives them.
% Prolog takes a way back when it fails, but the robot stays where it is.
%
%   ?- reasoning(start).
%   ?- reasoning_text.

:- use_module(library(ev3dev)).
:- use_module(library(ev3dev/reasoning)).

way(left).
way(ahead).
way(right).

free(Way) :- look(Way), us_dist_cm(in1, D), D > 60.

look(left)  :- turn(30, -90).
look(ahead) :- turn(30, 90).
look(right) :- turn(30, 90).

start :-
    set_robot(5.6, 10.6, outB, outC),
    way(Way),
    free(Way),
    go_cm(30, 20),
    us_dist_cm(in1, D), D > 100.
