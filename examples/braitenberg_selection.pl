% Braitenberg's vehicle 6: nobody designs it. Vehicles with random wires drive
% in a hall with a lamp; those that end near it are copied with small errors,
% the others are taken apart. After some generations light attracts them.
%
%   ?- start.
%
% It needs no robot: all drives are simulated, on all processors at once. What
% comes out is one of the vehicles of braitenberg.pl. Which one is it?
%
% After Valentino Braitenberg, Vehicles: Experiments in Synthetic Psychology.

:- use_module(library(ev3dev)).
:- use_module(library(ev3dev/sim)).
:- use_module(library(ev3dev/sim_batch)).
:- use_module(library(random)).

start :-
    start(8, _).

%!  start(+Generations, -Best) is det.
%
%   Best is the best vehicle of the last generation, wires(Base, Same, Other):
%   a wheel turns at Base, and Same times the light of the eye on its side,
%   and Other times that of the other eye.

start(Generations, Best) :-
    set_random(seed(6)),
    findall(wires(Base, Same, Other),
            ( between(1, 12, _), random(0.0, 50.0, Base),
              random(-1.0, 1.0, Same), random(-1.0, 1.0, Other) ),
            Vehicles),
    generation(1, Generations, Vehicles, Best).

generation(Number, Last, Vehicles, Best) :-
    source_file(start, File),
    findall(Seed, nth1(Seed, Vehicles, _), Seeds),
    sim_batch(File, distance(Vehicles), Seeds, Scores,
              [world(none), progress(false)]),
    findall(Cm-Vehicle,
            ( member(Seed-Cm, Scores), nth1(Seed, Vehicles, Vehicle) ),
            Pairs),
    keysort(Pairs, Sorted),
    length(Kept, 6),
    append(Kept, _, Sorted),
    Kept = [Nearest-wires(Base, Same, Other)|_],
    format("~t~d~3|: ~0f cm from the lamp: ~0f, ~2f same, ~2f other~n",
           [Number, Nearest, Base, Same, Other]),
    (   Number =:= Last
    ->  Best = wires(Base, Same, Other)
    ;   findall(Copy, ( member(_-Parent, Kept), copied(Parent, Copy) ), More),
        Next is Number + 1,
        generation(Next, Last, More, Best)
    ).

%   A vehicle stays, and has a copy with errors.

copied(Vehicle, Vehicle).
copied(wires(Base0, Same0, Other0), wires(Base, Same, Other)) :-
    random(-5.0, 5.0, A), Base is Base0 + A,
    random(-0.3, 0.3, B), Same is Same0 + B,
    random(-0.3, 0.3, C), Other is Other0 + C.

%   How far from the lamp the drives of a vehicle end, from three places.

distance(Vehicles, Number, Cm) :-
    nth1(Number, Vehicles, Vehicle),
    findall(D,
            ( member(Place, [[130, 100, 0], [230, 90, 250], [60, 240, 45]]),
              drive(Place, Vehicle, D) ),
            Ds),
    sum_list(Ds, Sum),
    Cm is Sum / 3.

drive([X0, Y0, Heading], Vehicle, D) :-
    with_sim(lights,
             ( sim_place(X0, Y0, Heading),
               for_seconds(20, run(Vehicle)),
               sim_pose(X, Y, _) )),
    D is sqrt((X - 150)^2 + (Y - 190)^2).

run(Vehicle) :-
    Vehicle = wires(Base, Same, Other),
    col_ambient(in2, Left),
    col_ambient(in3, Right),
    wheel(outB, Base + Same*Left + Other*Right),
    wheel(outC, Base + Same*Right + Other*Left),
    !,
    run(Vehicle).

wheel(Port, Speed) :-
    motor_run(Port, max(-100, min(100, Speed))).
