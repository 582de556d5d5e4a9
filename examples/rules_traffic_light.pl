% A traffic light, a machine with states: by day red, red and amber, green,
% amber; by night, when it is dark, it blinks.
%
%   ?- start.
%
% The brick's two lights are its lamps. A color sensor looks around. Stop it
% with Ctrl-C.

:- use_module(library(ev3dev)).
:- use_module(library(ev3dev/rules)).

% Each rule is again a machine with its own rules. At night the machine of the
% day ends, in any state; later it begins with red again. A machine never
% returns, so while(dark) is needed to end the machine of the night.
night, while(dark) :: dark ~> behave([blink]).
day               :: true ~> behave([red, red_amber, green, amber]).

% A state begins with state(start).
red       :: state(start)     ~> lamps(red, red),     next(4, ready).
red_amber :: state(ready)     ~> lamps(red, amber),   next(1, free).
green     :: state(free)      ~> lamps(green, green), next(5, attention).
amber     :: state(attention) ~> lamps(amber, amber), next(2, start).

blink :: true ~> [lamps(amber, amber):0.5, lamps(off, off):0.5].

next(Seconds, State) :-
    wait(Seconds),
    set_state(State).

lamps(Left, Right) :-
    led(left, Left),
    led(right, Right).

dark :-
    light_sensor(Eye),
    !,
    col_ambient(Eye, Light),
    Light < 3.

start :-
    call_cleanup(behave([night, day]), lamps(off, off)).
