% Four parcels wait at four places, and four stations are below them: red,
% yellow, green and blue. The colors are in another order in each run, and two
% of the parcels lie beside their places. For the robot `carrier`.

:- use_module(library(ev3dev/exercise)).

exercise(parcels, [seconds(240), noise(true), seeds(1-10), robot(carrier)]).

%   The places are 40, 80, 120 and 160 cm to the right of the left wall. A row
%   of a random grid says which parcel waits where.
world(Seed, [bounds(0, 0, 200, 150), start(25, 75, 0)|Facts]) :-
    random_grid(Seed, [ size(4-2), cell(40), boxes(0), things(4),
                        free([[1, 0], [2, 0], [3, 0]]) ], Grid),
    findall(box(X, 125, 5, 5, 0, [mass(0.05), color(Color), name(Name)]),
            ( member(box(X0, _, _, _, _, Options), Grid),
              memberchk(color(Color), Options),
              parcel(Color, Name),
              beside(Seed, X0, Cm),
              X is 40+X0+Cm ),
            Parcels),
    findall(patch(Color, Corners), station(Color, Corners), Stations),
    append(Stations, Parcels, Facts).

%   Every other parcel lies some cm to the left or to the right of its place.
beside(Seed, X0, Cm) :-
    Most is 5 + Seed mod 4,
    Turn is (Seed + X0//40) mod 4,
    nth0(Turn, [0, Most, 0, -Most], Cm).

parcel(Color, Name) :-
    atom_concat(Color, '_parcel', Name).

station(Color, [Left-10, Right-10, Right-40, Left-40]) :-
    member(Color-X, [red-40, yellow-80, green-120, blue-160]),
    Left is X-15,
    Right is X+15.

score(partial(6), 'brings parcels to the stations of their colors', Share) :-
    brought(Parcels),
    length(Parcels, Count),
    Share is Count/4.
score(partial(2), 'carries these, and does not push them', Share) :-
    brought(Parcels),
    findall(Parcel, ( member(Parcel, Parcels), was_carried(Parcel) ), Carried),
    length(Carried, Count),
    Share is Count/4.
score(2, 'brings all four in less than 150 s') :-
    brought([_, _, _, _]),
    duration(Seconds),
    Seconds < 150.

brought(Parcels) :-
    findall(Parcel,
            ( station(Color, Corners),
              parcel(Color, Parcel),
              thing_in(Parcel, Corners) ),
            Parcels).

was_carried(Parcel) :-
    carried(Parcel, Carried),
    Carried > 50,
    pushed(Parcel, Pushed),
    Pushed < 20.
