% There is no author/2, home/1 or download/1 yet: no public address would be
% true, and SWI-Prolog 7.2.3 refuses an author without one. The authors are
% the ev3dev pack contributors (LICENSE). There is no requires/1: older
% versions would take SWI-Prolog's own name for that of a pack.
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
