% 8 by 8 cells of 20 cm. The middle of the cell [X, Y] is at 20*X, 20*Y; the
% robot starts in [0, 0] and looks along y. Boxes stand in some of the cells.

bounds(-10, -10, 150, 150).
start(0, 0, 0).

box(20, 20, 14, 14).
box(0, 60, 14, 14).
box(40, 40, 14, 14).
box(40, 60, 14, 14).
box(80, 60, 14, 14).
box(60, 100, 14, 14).
box(100, 20, 14, 14).
box(120, 80, 14, 14).
box(20, 120, 14, 14).
box(100, 120, 14, 14).
