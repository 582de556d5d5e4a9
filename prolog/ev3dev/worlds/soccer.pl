% A small soccer field with a ball and two goals: yellow behind y = 100, blue
% behind y = -100. The robot starts in the middle of its half.

bounds(-70, -115, 70, 115).
floor(green).
start(0, -60, 0).

patch(yellow, [-30-100, 30-100, 30-115, -30-115]).
patch(blue,   [-30-(-115), 30-(-115), 30-(-100), -30-(-100)]).
wall(-70, 100.5, -30.5, 100.5).
wall(30.5, 100.5, 70, 100.5).
wall(-70, -100.5, -30.5, -100.5).
wall(30.5, -100.5, 70, -100.5).

circle(0, 0, 3, [mass(0.06), rolls(true), color(red), name(ball)]).
