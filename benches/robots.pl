% How fast several robots in one world are, each with a program of rules in a thread of
% its own, on the virtual clock.
%
%   swipl -p library=prolog -g main -t 'halt(1)' benches/robots.pl
%
% Prints the number of robots, and simulated seconds in a second by the wall.

:- use_module(library(ev3dev)).
:- use_module(library(ev3dev/bricks)).
:- use_module(library(ev3dev/rules)).
:- use_module(library(ev3dev/sim)).

avoid :: us_dist_cm(_, D), D < 30 ~> turn(40).
drive :: true ~> go(40).

main :-
    forall(member(Count-Seconds, [1-60, 2-20, 10-10]),
           ( measured(Count, Seconds, Rate), format("~d ~1f~n", [Count, Rate]) )),
    halt.

measured(Count, Seconds, Rate) :-
    findall(Name-start(Name, X, Y, Heading),
            ( between(1, Count, I), atom_concat(robot, I, Name),
              X is I mod 4 * 60, Y is I // 4 * 60, Heading is I*40 ),
            Pairs),
    findall(Name-default, member(Name-_, Pairs), Robots),
    findall(Start, member(_-Start, Pairs), Starts),
    sim_start([bounds(-40, -40, 220, 160)|Starts], [clock(virtual), robots(Robots)]),
    get_time(Before),
    bricks_do(( set_robot(5.6, 10.6, outB, outC),
                behave([avoid, drive], [timeout(Seconds)]) )),
    get_time(After),
    forall(member(Name-_, Robots), brick_close(Name)),
    Rate is Seconds/(After-Before).
