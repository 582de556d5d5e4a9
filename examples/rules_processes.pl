% A courier as processes: guarded rules over a state and messages.
%
%   ?- start.
%
% The button `enter` orders the robot to drive up to the wall ahead. There it
% waits for `up`, which says that it is unloaded, and comes back. `down` calls
% it back at any time. It needs two large motors and an ultrasonic sensor that
% points ahead. Stop it with Ctrl-C.
%
% After the processes of "Programming Autonomous Robots in Curry" by Michael
% Hanus and Klaus Hoeppner.

:- use_module(library(ev3dev)).
:- use_module(library(ev3dev/drive)).
:- use_module(library(ev3dev/rules)).

% Recall comes first, so it interrupts the others. state(start) is at home.
recall :: received(recall), state(S), away(S) ~> set_state(back).
order  :: state(start), received(order)       ~> set_state(out).
drive  :: state(out)   ~> until(wall_ahead, go(30)), set_state(there).
unload :: state(there), received(unloaded)    ~> set_state(back).
return :: state(back)  ~> go_to(0-0), face(0), set_state(start).

away(out).
away(there).

wall_ahead :-
    us_dist_cm(_, Distance),
    Distance < 30.

%   The buttons send messages, also while the robot acts, because conditions
%   are checked every 20 ms in the same thread.
message(enter, order).
message(up,    unloaded).
message(down,  recall).

start :-
    set_robot(5.6, 10.6, outB, outC),
    set_pose(0, 0, 0),
    setup_call_cleanup(
        forall(message(Button, Message),
               on(button(Button), send_message(Message), [id(Button)])),
        behave([recall, order, drive, unload, return]),
        forall(message(Button, _), ignore(event_cancel(Button)))).
