% A lecture on backtracking: the program tries ways, and the robot drives them.

way(left).
way(ahead).
way(right).

free(W) :- look(W), us_dist_cm(in1, D), D > 60.

look(left)  :- turn(30, -90).
look(ahead) :- turn(30, 90).
look(right) :- turn(30, 90).

start :-
    set_robot(5.6, 10.6, outB, outC),
    way(W),
    free(W),
    go_cm(30, 20),
    us_dist_cm(in1, D), D > 100.
