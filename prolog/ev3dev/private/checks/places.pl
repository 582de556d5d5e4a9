:- module(ev3dev_places,
          [ place/2,                    % +Place, -Native
            places/2                    % +Places, -Native
          ]).
:- use_module(arguments, [number_value/2]).
:- use_module(checks, [must_be/2]).
:- use_module('../errors/errors', [domain_error/2]).

/** <module> Places

A place is written `X-Y`, in cm. Wherever a program gives one it may also be
`[X, Y]`. The facts of worlds have places, too: src/glue/places.rs reads
those, with the same errors.
*/

%!  place(+Place, -Native) is det.
%!  places(+Places, -Native) is det.
%
%   True if Native is `X-Y`, both numbers, for a Place whose coordinates may
%   be arithmetic expressions; or a list of such.
%
%   @error domain_error(place, Place)
%   @error domain_error(finite_number, Number)
%   @error as is/2

place(Place, X-Y) :-
    must_be(nonvar, Place),
    (   coordinates(Place, X0, Y0)
    ->  number_value(X0, X),
        number_value(Y0, Y)
    ;   domain_error(place, Place)
    ).

coordinates(X-Y, X, Y).
coordinates([X, Y], X, Y).

places(Places, Native) :-
    must_be(list, Places),
    each_place(Places, Native).

each_place([], []).
each_place([Place|Places], [Native|Natives]) :-
    place(Place, Native),
    each_place(Places, Natives).
