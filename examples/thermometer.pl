% A thermometer: shows the temperature and whether it rises or falls.
%
%   ?- thermometer.
%
% It needs, at any port, a sensor that temperature/2 reads, for example LEGO's
% for the NXT. Stop it with Ctrl-C.

:- use_module(library(ev3dev)).

%!  thermometer is failure.
%!  thermometer(+Count) is semidet.
%
%   Print the temperature once per second: forever, or Count times. Fails if
%   there is no sensor.

thermometer :-
    thermometer(0).

thermometer(Count) :-
    temperature(_, Celsius),
    !,
    thermometer(Count, Celsius).

thermometer(Count, Before) :-
    temperature(_, Celsius),
    !,
    trend(Before, Celsius, Trend),
    bar(Celsius, Bar),
    format("~t~1f~6| C ~w ~w~n", [Celsius, Trend, Bar]),
    (   Count == 1                      % never true from 0 down: forever
    ->  true
    ;   wait(1),
        Left is Count - 1,
        thermometer(Left, Celsius)
    ).

%!  trend(+Before, +Now, -Sign) is det.
%
%   The sensor measures tenths of a degree. A change by one tenth may be
%   noise.

trend(Before, Now, Sign) :-
    (   Now > Before + 0.15
    ->  Sign = (+)
    ;   Now < Before - 0.15
    ->  Sign = (-)
    ;   Sign = (=)
    ).

%!  bar(+Celsius, -Bar) is det.
%
%   A bar with a star for each degree.

bar(Celsius, Bar) :-
    Length is max(0, min(50, round(Celsius))),
    length(Stars, Length),
    maplist(=(*), Stars),
    atomic_list_concat(Stars, Bar).
