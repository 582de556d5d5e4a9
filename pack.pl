name(ev3dev).
version('0.1.0').
title('Control LEGO EV3 robots running ev3dev').
keywords([robot, lego, ev3, ev3dev, mindstorms]).
