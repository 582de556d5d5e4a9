% Drives a robot by LEGO's infrared remote control.
%
%   ?- drive.
%
% The red buttons are for the left wheel at outB, the blue ones for the right
% wheel at outC: the upper ones run it forward, the lower ones backward. The
% beacon's button ends the program. The program needs an infrared sensor at
% any port, and a remote control on channel 1.

:- use_module(library(ev3dev)).

%!  drive is semidet.
%!  drive(+Channel) is semidet.
%
%   Drive by the remote control until its beacon is switched on. Fails if
%   there is no infrared sensor, or no motor. The wheels stop at the end, also
%   after an error or Ctrl-C.

drive :-
    drive(1).

drive(Channel) :-
    infrared_sensor(Port),
    !,
    setup_call_cleanup(
        true,
        obey(Port, Channel, nothing),
        ( motor_stop(outB), motor_stop(outC) )).

obey(Port, Channel, Before) :-
    ir_remote(Port, Channel, Buttons),
    (   Buttons == [beacon]
    ->  true
    ;   run(Before, Buttons),
        obey(Port, Channel, Buttons)
    ).

% The wheels keep running while the same buttons are pressed.
run(Buttons, Buttons) :-
    !.
run(_, Buttons) :-
    wheel(Buttons, red_up, red_down, Left),
    wheel(Buttons, blue_up, blue_down, Right),
    motors_run([run(outB, Left), run(outC, Right)]).

%!  wheel(+Buttons, +Up, +Down, -Speed) is det.
%
%   If both buttons of a wheel are pressed, or none, it stands still.

wheel(Buttons, Up, Down, Speed) :-
    (   memberchk(Up, Buttons),
        \+ memberchk(Down, Buttons)
    ->  Speed = 40
    ;   memberchk(Down, Buttons),
        \+ memberchk(Up, Buttons)
    ->  Speed = -40
    ;   Speed = 0
    ).
