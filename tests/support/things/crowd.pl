:- module(crowd,
          [ crowd_digest/2              % -Digest, -Expected
          ]).
:- use_module(library(ev3dev)).
:- use_module(library(ev3dev/sim)).
:- use_module(library(lists)).

/** <module> A robot drives about among twelve things

The places of all, to the last bit, are the same on each processor: on this one,
in WebAssembly, and on a brick.
*/

%!  crowd_digest(-Digest, -Expected) is det.
%
%   Digest is a number of the places after 18 simulated seconds. Expected is
%   renewed if the simulator pushes things in another way, and the commit says
%   why.

crowd_digest(Digest, Expected) :-
    findall(Thing, ( between(0, 11, N), thing(N, Thing) ), Things),
    with_sim([bounds(-60, -30, 60, 90)|Things], among(Places),
             [clock(virtual), noise(true), seed(42)]),
    format(codes(Codes), "~q", [Places]),
    digest(Codes, 0, Digest),
    Expected = 3870421724.

thing(N, Thing) :-
    X is N mod 4*14-20,
    Y is 20+N//4*13,
    Kg is 0.03+0.02*N,
    (   N mod 3 =:= 0
    ->  Thing = circle(X, Y, 2, [mass(Kg), rolls(true)])
    ;   Thing = box(X, Y, 5, 5, 0, [mass(Kg)])
    ).

among([robot(X, Y, Heading)|Things]) :-
    forall(( between(1, 6, _), member(B-C, [50-48, 45-50, -30 - -40]) ),
           ( motor_run(outB, B), motor_run(outC, C), wait(1) )),
    sim_pose(X, Y, Heading),
    sim_things(Things),
    findall(N, ( nth0(N, Things, thing(_, X0, Y0, _)),
                 thing(N, Thing),
                 arg(1, Thing, X1),
                 arg(2, Thing, Y1),
                 abs(X0-X1)+abs(Y0-Y1) > 1 ),
            Moved),
    length(Moved, Count),
    Count > 5.

digest([], Digest, Digest).
digest([Code|Codes], Digest0, Digest) :-
    Digest1 is (Digest0*31+Code) mod 4294967291,
    digest(Codes, Digest1, Digest).
