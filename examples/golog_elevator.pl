% An elevator with five floors: the motor at outA lifts the cabin, a quarter
% of a turn for each floor, and the keys of the brick are the call buttons:
% down, left, enter, right, up, from the ground floor on.
%
%   ?- start.             % serves one call after the other
%   ?- start(smart).      % plans the shortest path at each call
%   ?- start(planned).    % the same, without a program for the plan
%
% The program never ends: stop it with Ctrl-C. The motor stops then.

:- use_module(library(ev3dev)).
:- use_module(library(ev3dev/golog)).

start :-
    start(simple).

start(How) :-
    start(How, []).

%   Options are those of golog/2.
start(How, Options) :-
    motor_reset(outA),
    golog(serve(How), Options).

% The domain

floor_number(N) :-
    between(1, 5, N).

prim_action(up).
prim_action(down).
prim_action(open).              % open the door, and close it again
exog_action(call(N)) :-
    floor_number(N).

prim_fluent(floor).
rel_fluent(called(N)) :-
    floor_number(N).
rel_fluent(news).               % a call has come since the last plan

initially(floor, 1).
initially(called(_), false).
initially(news, false).

poss(up, floor < 5).
poss(down, floor > 1).
poss(open, called(floor)).

causes_val(up, floor, N, N is floor+1).
causes_val(down, floor, N, N is floor-1).
causes_true(call(N), called(N), true).
causes_true(call(N), news, neg(called(N))).
causes_false(open, called(N), floor = N).

proc(some_call, some(n, called(n))).
proc(go_to(N), while(neg(floor = N), if(floor < N, up, down))).
proc(serve_floor(N), [go_to(N), open]).

% Serve any call, and rest on the ground floor.

proc(serve(simple),
     prioritized_interrupts(
         [ interrupt(n, called(n), serve_floor(n)),
           interrupt(floor > 1, down),
           interrupt(true, wait) ])).

% Find the plan with the fewest floors, and follow it until a call comes.

proc(serve(smart),
     prioritized_interrupts(
         [ interrupt(some_call,
                     [ unset(news),
                       gexec(neg(news), search(within(0), 'a short way')) ]),
           interrupt(floor > 1, down),
           interrupt(true, wait) ])).

proc(within(Floors),
     ndet(all_served(Floors),
          pi(more, [?(more is Floors+1), within(more)]))).

proc(all_served(Floors),
     ndet(?(neg(some_call)),
          pi([n, left],
             [ ?(and(called(n), left is Floors-abs(floor-n))),
               ?(left >= 0),
               serve_floor(n),
               all_served(left) ]))).

% Find the shortest plan for what is to be true, and follow it as long.

proc(serve(planned),
     prioritized_interrupts(
         [ interrupt(some_call,
                     [ unset(news),
                       gexec(neg(news), achieve(neg(some_call))) ]),
           interrupt(floor > 1, down),
           interrupt(true, wait) ])).

% The robot

robot_action(up, motor_run(outA, 40, 90)).
robot_action(down, motor_run(outA, 40, -90)).
robot_action(open, door).

robot_exog(call(1), button(down)).
robot_exog(call(2), button(left)).
robot_exog(call(3), button(enter)).
robot_exog(call(4), button(right)).
robot_exog(call(5), button(up)).

door :-
    led(left, red), led(right, red),
    tone(660, 200),
    wait(1.5),
    led(left, green), led(right, green).
