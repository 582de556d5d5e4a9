name(ev3dev).
version('1.0.0').
title('Control LEGO EV3 robots running ev3dev').
keywords([robot, lego, ev3, ev3dev, mindstorms, simulator, golog]).
description([
    'The predicates of the paper "ev3dev-prolog - Prolog API for',
    'LEGO EV3", with native code underneath; a simulated robot where',
    'there is none; rules that say why, Golog, localization, many',
    'robots, a live view, a course with marks.'
]).
