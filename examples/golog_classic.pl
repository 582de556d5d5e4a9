% An elevator in the syntax of Reiter's book "Knowledge in Action": the motor
% at outA lifts the cabin, a quarter of a turn for each floor.
%
%   ?- start.             % finds a whole run first, then drives
%   ?- do(control, s0, S).

:- use_module(library(ev3dev)).
:- use_module(library(ev3dev/golog_classic)).

start :-
    motor_reset(outA),
    motor_run_to(outA, 40, 360),
    golog(search(control), []).

primitive_action(up(_)).
primitive_action(down(_)).
primitive_action(off(_)).
primitive_action(open).

poss(up(N), S) :- floor(M, S), M < N.
poss(down(N), S) :- floor(M, S), M > N.
poss(off(N), S) :- waits(N, S), floor(N, S).
poss(open, _).

% Where the cabin is, and on which floors somebody waits

floor(4, s0).
floor(N, do(A, S)) :-
    A = up(N) ; A = down(N) ; not A = up(_), not A = down(_), floor(N, S).
waits(3, s0).
waits(5, s0).
waits(N, do(A, S)) :- waits(N, S), not A = off(N).

restoreSitArg(floor(N), S, floor(N, S)).
restoreSitArg(waits(N), S, waits(N, S)).

proc(go(N), ?(floor(N)) # up(N) # down(N)).
proc(serve, pi(n, ?(waits(n)) : go(n) : off(n) : open)).
proc(park, if(floor(0), open, down(0) : open)).
proc(control, while(some(n, waits(n)), serve) : park).

% The robot

robot_action(up(N), to(N)).
robot_action(down(N), to(N)).
robot_action(off(_), led(left, green)).
robot_action(open, tone(660, 200)).

to(N) :-
    Angle is 90*N,
    motor_run_to(outA, 40, Angle).
