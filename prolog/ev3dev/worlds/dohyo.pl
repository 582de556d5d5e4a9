% The ring of robot sumo, for two robots: black, 154 cm across, as for those
% of 3 kg; what is around it is white. They start at its two lines, 40 cm
% apart by their axles, and look at each other.

bounds(-150, -150, 150, 150).
patch(black,
      [   77-0,    71-29.5,   54.4-54.4,   29.5-71,
           0-77, -29.5-71,  -54.4-54.4,   -71-29.5,
         -77-0,  -71-(-29.5), -54.4-(-54.4), -29.5-(-71),
           0-(-77), 29.5-(-71), 54.4-(-54.4), 71-(-29.5)
      ]).
start(east, 20, 0, 270).
start(west, -20, 0, 90).
