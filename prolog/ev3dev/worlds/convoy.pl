% A lane for three robots, one behind the other, 40 cm apart.

bounds(-40, -30, 40, 600).
start(first, 0, 80, 0).
start(second, 0, 40, 0).
start(third, 0, 0, 0).
