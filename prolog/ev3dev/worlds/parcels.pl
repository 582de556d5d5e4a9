% Four parcels wait in a row, and four stations are below them: red, yellow,
% green and blue. For the robot `carrier`.

bounds(0, 0, 200, 150).
start(25, 75, 0).

box(40, 125, 5, 5, 0, [mass(0.05), color(green), name(green_parcel)]).
box(80, 125, 5, 5, 0, [mass(0.05), color(red), name(red_parcel)]).
box(120, 125, 5, 5, 0, [mass(0.05), color(blue), name(blue_parcel)]).
box(160, 125, 5, 5, 0, [mass(0.05), color(yellow), name(yellow_parcel)]).

patch(red,    [25-10, 55-10, 55-40, 25-40]).
patch(yellow, [65-10, 95-10, 95-40, 65-40]).
patch(green,  [105-10, 135-10, 135-40, 105-40]).
patch(blue,   [145-10, 175-10, 175-40, 145-40]).
