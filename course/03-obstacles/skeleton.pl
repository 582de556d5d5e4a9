% A robot that wanders about by rules, the most important first.

:- use_module(library(ev3dev)).
:- use_module(library(ev3dev/rules)).

%   A rule is Name :: Condition ~> Action. This one always applies.
wander :: true ~> go(20).

%   Think: which rule must come before it? us_dist_cm(in1, Cm) measures the
%   distance ahead; turn(20) turns right as long as the rule applies.

start :-
    set_robot(5.6, 10.6, outB, outC),
    behave([wander]).
