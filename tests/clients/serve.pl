% Mounts a simulated brick until the standard input ends. Each term in it is
% a goal to be called.

:- use_module(library(ev3dev)).
:- use_module(library(ev3dev/sim)).

serve(Directory) :-
    findall(Fact, robot(Fact), Robot),
    serve(Directory, Robot).

% The default robot with a controller of servos at in3.
robot(left_wheel(outB, 5.6)).
robot(right_wheel(outC, 5.6)).
robot(axle(10.6)).
robot(hull(circle(8))).
robot(mass(0.75)).
robot(motor(outA, 'lego-ev3-m-motor')).
robot(motor(outB, 'lego-ev3-l-motor')).
robot(motor(outC, 'lego-ev3-l-motor')).
robot(sensor(in1, 'lego-ev3-us', 0, 7, 0)).
robot(sensor(in2, 'lego-ev3-color', -3, 6.5, -30)).
robot(sensor(in3, 'ms-8ch-servo', 0, 0, 0)).
robot(sensor(in4, 'lego-ev3-gyro', 0, 0, 0)).

serve(Directory, Robot) :-
    sim_start(room, [clock(realtime), robot(Robot)]),
    atom_concat(Directory, '.dev', Dev),
    sim_mount(Directory, Dev),
    obey,
    sim_unmount,
    sim_stop,
    halt(0).

obey :-
    read_term(Goal, []),
    (   Goal == end_of_file
    ->  true
    ;   call(Goal),
        obey
    ).
