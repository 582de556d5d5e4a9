% A track of black tape, 2 cm wide, for the post. It is driven
% counterclockwise along its left edge. Four way stations are on the right of
% the track, each a piece of colored floor: 1 is red, 2 yellow, 3 green and
% 4 blue.

bounds(0, 0, 240, 200).
start(80, 38, 90).

line(black, 2,
     [ 60-40, 180-40, 187.8-41, 195-44, 201.2-48.8, 206-55, 209-62.2,
       210-70, 210-130, 209-137.8, 206-145, 201.2-151.2, 195-156,
       187.8-159, 180-160, 60-160, 52.2-159, 45-156, 38.8-151.2, 34-145,
       31-137.8, 30-130, 30-70, 31-62.2, 34-55, 38.8-48.8, 45-44, 52.2-41,
       60-40
     ]).

patch(red,    [114-31, 126-31, 126-38, 114-38]).
patch(yellow, [212-94, 219-94, 219-106, 212-106]).
patch(green,  [114-162, 126-162, 126-169, 114-169]).
patch(blue,   [21-94, 28-94, 28-106, 21-106]).
