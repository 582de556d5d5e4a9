% A sumo ring: black, 77 cm in radius, with a white floor around it. The
% other robot is a round thing that stands still, behind our robot and to the
% left. It cannot be pushed, see docs/worlds.md.

bounds(-150, -150, 150, 150).
patch(black,
      [   77-0,    71-29.5,   54.4-54.4,   29.5-71,
           0-77, -29.5-71,  -54.4-54.4,   -71-29.5,
         -77-0,  -71-(-29.5), -54.4-(-54.4), -29.5-(-71),
           0-(-77), 29.5-(-71), 54.4-(-54.4), 71-(-29.5)
      ]).
circle(-25, -35, 8).
start(20, 0, 0).
