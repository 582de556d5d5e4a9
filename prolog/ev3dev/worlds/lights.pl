% A dim hall with a lamp, for Braitenberg's vehicles. The lamp is ahead of the
% robot and a little to its right.

bounds(0, 0, 300, 300).
ambient(5).
lamp(150, 190, 25).
start(130, 100, 0).
