% Drives a robot by LEGO's infrared remote control.
%
%   ?- drive.
%
% The red buttons are for the left wheel at outB, the blue ones for the right
% wheel at outC: the upper ones run it forwards, the lower ones backwards. The
% beacon's button ends the program. It needs an infrared sensor, at whichever
% port, and a remote control that is set to channel 1.

:- use_module(library(ev3dev)).

%!  drive is semidet.
%!  drive(+Channel) is semidet.
%
%   Do as the remote control says until its beacon is switched on. Fails if
%   there is no infrared sensor, or no motor. However it ends, the wheels
%   stop.

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

% The wheels go on by themselves while the same buttons are held.
run(Buttons, Buttons) :-
    !.
run(_, Buttons) :-
    wheel(Buttons, red_up, red_down, Left),
    wheel(Buttons, blue_up, blue_down, Right),
    motors_run([run(outB, Left), run(outC, Right)]).

%!  wheel(+Buttons, +Up, +Down, -Speed) is det.
%
%   Both buttons of a wheel at once, or none, leave it standing.

wheel(Buttons, Up, Down, Speed) :-
    (   memberchk(Up, Buttons),
        \+ memberchk(Down, Buttons)
    ->  Speed = 40
    ;   memberchk(Down, Buttons),
        \+ memberchk(Up, Buttons)
    ->  Speed = -40
    ;   Speed = 0
    ).
