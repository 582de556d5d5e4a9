% A room of 3 m by 2.5 m with two boxes and a pillar.

bounds(0, 0, 300, 250).
box(90, 165, 40, 25, 20).
box(200, 90, 30, 45, -15).
circle(150, 125, 8).
start(40, 40, 40).
