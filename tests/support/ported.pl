% Programs of the kinds that hobbyists write in python-ev3dev2 and Pybricks, with the
% words of docs/coming-from.md. tests/behavior/test_coming_from.pl runs each.

:- use_module(library(ev3dev)).
:- use_module(library(ev3dev/drive)).
:- use_module(library(ev3dev/events)).

% ---------------- A SNAKE BY REMOTE KEYS

%   on_channel1_top_left and the like: the red keys drive, the blue ones steer, the
%   beacon's key strikes. First the events of release, so that one key right after another
%   is not stopped by the release of the first.

key(red_up, outB, 60).
key(red_down, outB, -60).
key(blue_up, outC, 30).
key(blue_down, outC, -30).

held(Key) :-
    ir_remote(_, 1, Keys),
    memberchk(Key, Keys).

snake :-
    forall(key(Key, Port, _),
           on(\+ held(Key), motor_stop(Port), [armed(false)])),
    forall(key(Key, Port, Speed),
           on(held(Key), motor_run(Port, Speed))),
    on(held(beacon), strike),
    repeat,
    wait(1),
    fail.

%   proximity < 30: one that bites what comes near. The sensor takes 1.1 s from one mode to
%   the other, so this is another program.

bite :-
    until(( ir_prox(_, Percent), Percent < 30 ), wait(3600)),
    strike.

strike :-
    motor_run_timed(outA, 40, 0.2),
    motor_run_timed(outA, -40, 0.2).

% ---------------- AFTER THE BEACON

%   heading_and_distance: turn until the beacon is seen, then go where it is.

follow_beacon :-
    set_robot(5.6, 10.6, outB, outC),
    until(( ir_beacon(_, 1, _, Percent), Percent < 15 ), chase),
    stop.

chase :-
    repeat,
    (   ir_beacon(_, 1, Heading, _)
    ->  steer(30, 3 * Heading)
    ;   turn(15)
    ),
    wait(0.05),
    fail.

% ---------------- A LOG

%   DataLog('time', 'angle', 'speed'): those of a motor every tenth of a second.

log_motor(File) :-
    setup_call_cleanup(open(File, write, Log), log_to(Log), close(Log)).

log_to(Log) :-
    format(Log, "time,angle,speed~n", []),
    motor_run(outA, dps(300)),
    stopwatch(Watch),
    forall(between(1, 10, _),
           ( wait(0.1),
             elapsed(Watch, Time),
             motor_position(outA, Angle),
             motor_speed(outA, Speed),
             format(Log, "~3f,~w,~w~n", [Time, Angle, Speed]) )),
    motor_stop(outA, coast).

% ---------------- TWO TASKS

%   multitask(square(), blink()), or a generator that the main loop asks for its next step.

square :-
    set_robot(5.6, 10.6, outB, outC),
    forall(between(1, 4, _), ( go_cm(30, 20), turn(30, 90) )).

blink :-
    forall(between(1, 5, _),
           ( led(left, green), wait(0.3), led(left, off), wait(0.3) )).

square_and_blink :-
    both(square, blink).

square_until_blinked(Winner) :-
    race([square, blink], Winner).

% ---------------- A FACE AND A WORD

%   load_image(ImageFile.AWAKE), play_file(SoundFile.HELLO)

greet :-
    greet('/usr/share/images/ev3dev/mono/eyes/awake.png',
          '/usr/share/sounds/ev3dev/communication/hello.wav').

greet(Image, Sound) :-
    screen_clear,
    screen_image(0, 0, Image),
    screen_show,
    play(Sound).

% ---------------- A GEARED ARM

%   Motor(Port.A, Direction.COUNTERCLOCKWISE, [12, 36]), run_until_stalled(-60, duty_limit=30),
%   run_target(60, 90, wait=False) and control.done().

arm(Steps) :-
    motor_polarity(outA, inversed),
    motor_gear(outA, 36/12),
    motor_run_until_stalled(outA, dps(-60), [duty_limit(30)]),
    motor_position(outA, 0),
    motor_run_to(outA, dps(60), 90, [wait(false)]),
    until_done(outA, 0, Steps).

until_done(Port, Steps0, Steps) :-
    motor_states(Port, States),
    (   memberchk(running, States)
    ->  wait(0.05),
        Steps1 is Steps0 + 1,
        until_done(Port, Steps1, Steps)
    ;   Steps = Steps0
    ).

%   DriveBase of two motors with such gears: a car that goes on in centimeters.

geared_square :-
    set_robot(5.6, 10.6, outB, outC, [gear(36/12)]),
    forall(between(1, 4, _), ( go_cm(20, 20), turn(20, 90) )).
