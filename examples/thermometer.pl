% A thermometer: shows how warm it is, and how that changes.
%
%   ?- thermometer.
%
% It needs any sensor that temperature/2 takes, as LEGO's for the NXT, at
% whichever port. Stop it by Ctrl-C.

:- use_module(library(ev3dev)).

%!  thermometer is failure.
%!  thermometer(+Count) is semidet.
%
%   Print the temperature once a second: for ever, or Count times. Fails as
%   soon as there is no sensor.

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
    (   Count == 1
    ->  true                            % from 0 down it never is
    ;   sleep(1),
        Left is Count - 1,
        thermometer(Left, Celsius)
    ).

%!  trend(+Before, +Now, -Sign) is det.
%
%   The sensor tells tenths of a degree; one more or less may be chance.

trend(Before, Now, Sign) :-
    (   Now > Before + 0.15
    ->  Sign = (+)
    ;   Now < Before - 0.15
    ->  Sign = (-)
    ;   Sign = (=)
    ).

%!  bar(+Celsius, -Bar) is det.
%
%   A column of mercury that lies down, a star a degree.

bar(Celsius, Bar) :-
    Length is max(0, min(50, round(Celsius))),
    length(Stars, Length),
    maplist(=(*), Stars),
    atomic_list_concat(Stars, Bar).
