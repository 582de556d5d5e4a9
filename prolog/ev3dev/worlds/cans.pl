% The black ring of sumo, with five empty cans in it.

bounds(-150, -150, 150, 150).
patch(black,
      [   77-0,    71-29.5,   54.4-54.4,   29.5-71,
           0-77, -29.5-71,  -54.4-54.4,   -71-29.5,
         -77-0,  -71-(-29.5), -54.4-(-54.4), -29.5-(-71),
           0-(-77), 29.5-(-71), 54.4-(-54.4), 71-(-29.5)
      ]).
start(0, 0, 0).

circle(0, 45, 3.3, [mass(0.03), color(red), name(can1)]).
circle(43, 14, 3.3, [mass(0.03), color(red), name(can2)]).
circle(26, -36, 3.3, [mass(0.03), color(red), name(can3)]).
circle(-26, -36, 3.3, [mass(0.03), color(red), name(can4)]).
circle(-43, 14, 3.3, [mass(0.03), color(red), name(can5)]).
