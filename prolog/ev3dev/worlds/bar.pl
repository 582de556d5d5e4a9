% A bar of 60 cm, too long for one robot. Two robots `carrier` look at its
% ends. They grip it, and carry it onto the red floor: one drives ahead, the
% other one back.

bounds(-60, -100, 60, 200).
patch(red, [-40-80, 40-80, 40-160, -40-160]).

box(0, 0, 4, 60, 0, [mass(0.2), color(blue), name(bar)]).
start(0, -60, 0).                        % of a robot alone
start(back, 0, -60, 0).
start(front, 0, 60, 180).
