% A dim hall with a lamp in it, for Braitenberg's vehicles. The robot sees the
% lamp ahead and a little to its right.

bounds(0, 0, 300, 300).
ambient(5).
lamp(150, 190, 25).
start(130, 100, 0).
