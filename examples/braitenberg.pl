% Braitenberg's vehicles 1 to 5: two wheels, two eyes, and wires between them.
%
%   ?- vehicle(fear).
%
% The left eye is a color sensor at in2, the left wheel a motor at outB; the
% right eye is at in3, the right wheel at outC. Light and speed both go from 0
% to 100. Stop a vehicle with Ctrl-C.
%
% Vehicle 6, which nobody designs, is in braitenberg_selection.pl.
%
% After Valentino Braitenberg, Vehicles: Experiments in Synthetic Psychology.

:- use_module(library(ev3dev)).

%!  vehicle(+Name) is failure.
%
%   Drive as one of the vehicles below while eyes and wheels are connected.
%   The wheels stop at the end, also after an error or Ctrl-C.

vehicle(Name) :-
    setup_call_cleanup(
        true,
        vehicle(Name, nothing),
        stop_all_motors).

vehicle(Name, Memory0) :-
    col_ambient(in2, Left),
    col_ambient(in3, Right),
    wires(Name, eyes(Left, Right), wheels(SpeedLeft, SpeedRight),
          Memory0, Memory),
    motors_run([run(outB, SpeedLeft), run(outC, SpeedRight)]),
    !,
    vehicle(Name, Memory).

%!  wires(?Name, +Eyes, -Wheels, +Memory0, -Memory) is nondet.
%
%   Computes the speeds of the wheels from the light at the eyes. Vehicles 1
%   to 4 remember nothing.

% Vehicle 1 drives straight: the more light, the faster.
wires(alive, eyes(Left, Right), wheels(Speed, Speed), M, M) :-
    Speed is (Left + Right) / 2.

% Vehicle 2a: each eye drives the wheel on its own side, so the vehicle turns
% away from the light.
wires(fear, eyes(Left, Right), wheels(Left, Right), M, M).

% Vehicle 2b: the wires cross, so it turns toward the light and rushes at it.
wires(aggression, eyes(Left, Right), wheels(Right, Left), M, M).

% Vehicle 3a: light slows down the wheel on its side, so that it turns toward
% the light and stops in front of it.
wires(love, eyes(Left, Right), wheels(SpeedLeft, SpeedRight), M, M) :-
    inhibited(Left, SpeedLeft),
    inhibited(Right, SpeedRight).

% Vehicle 3b: the wires cross. It slows down near the light, too, but turns
% away to look for other lights.
wires(explorer, eyes(Left, Right), wheels(SpeedLeft, SpeedRight), M, M) :-
    inhibited(Left, SpeedRight),
    inhibited(Right, SpeedLeft).

% Vehicle 4a: it likes one brightness best, and circles where it finds that.
wires(taste, eyes(Left, Right), wheels(SpeedLeft, SpeedRight), M, M) :-
    best_at_half(Left, SpeedRight),
    best_at_half(Right, SpeedLeft).

% Vehicle 4b: it makes decisions. Below a threshold it does not move.
wires(decision, eyes(Left, Right), wheels(SpeedLeft, SpeedRight), M, M) :-
    above_threshold(Left, SpeedRight),
    above_threshold(Right, SpeedLeft).

% Vehicle 5 remembers: each time a light dazzles it, it changes between
% aggression and fear.
wires(memory, Eyes, Wheels, Memory0, Memory) :-
    mind(Memory0, Eyes, Memory),
    Memory = memory(Character, _),
    wires(Character, Eyes, Wheels, nothing, _).

inhibited(Light, Speed) :-
    Speed is max(0, 50 - Light).

best_at_half(Light, Speed) :-
    Speed is 50 - abs(Light - 50).

above_threshold(Light, Speed) :-
    (   Light > 30
    ->  Speed = 60
    ;   Speed = 0
    ).

mind(nothing, Eyes, memory(aggression, Dazzled)) :-
    dazzled(Eyes, Dazzled).
mind(memory(Character0, Dazzled0), Eyes, memory(Character, Dazzled)) :-
    dazzled(Eyes, Dazzled),
    (   Dazzled0 == false,
        Dazzled == true
    ->  other(Character0, Character)
    ;   Character = Character0
    ).

dazzled(eyes(Left, Right), Dazzled) :-
    (   80 < max(Left, Right)
    ->  Dazzled = true
    ;   Dazzled = false
    ).

other(aggression, fear).
other(fear, aggression).
