% How close the drive gets: mean and worst error of turns and of courses, each
% with a seed of its own, on the virtual clock. The robots are those of the tests:
% one motor is 5 % stronger, encoders and gyro err and the gyro drifts, which shows
% in the ten seconds for which the robot stands first.
%
%   swipl -g main -t 'halt(1)' benches/accuracy.pl
%
% Prints, for turns in degrees and for courses in cm: how many, mean, root mean
% square, and worst error with its seed. The same on every machine.

:- use_module('../tests/support/robots').
:- use_module('../tests/support/simulation').
:- use_module(library(ev3dev)).
:- use_module(library(ev3dev/drive)).
:- use_module(library(ev3dev/sim)).
:- use_module(library(lists)).
:- use_module(library(random)).

main :-
    errors(turn, 300, Turns),
    print_errors(turns, degrees, Turns),
    errors(course, 60, Courses),
    print_errors(courses, cm, Courses),
    halt.

%   Errors are Error-Seed, of as many runs.

errors(What, Count, Errors) :-
    findall(Error-Seed,
            ( between(1, Count, Seed), error_of(What, Seed, Error) ),
            Errors).

%   A turn by up to half a turn, at 15 to 60 percent.

error_of(turn, Seed, Error) :-
    set_random(seed(Seed)),
    random(-180.0, 180.0, Angle),
    random(15.0, 60.0, Speed),
    noisy(Seed, true,
          ( sim_step(10),
            turn(Speed, Angle, []),
            sim_step(1),
            sim_pose(_, _, Heading) )),
    heading_wrapped(Heading - Angle, Off),
    Error is abs(Off).

%   Five places at most a meter away on each axis, one after the other, and then how far the robot
%   is from the last.

error_of(course, Seed, Error) :-
    set_random(seed(Seed)),
    findall(X-Y,
            ( between(1, 5, _),
              random(-100.0, 100.0, X), random(-100.0, 100.0, Y) ),
            Places),
    noisy(Seed, true,
          ( sim_step(10),
            forall(member(X-Y, Places), go_to(X, Y)),
            sim_step(1),
            sim_pose(X1, Y1, _) )),
    last(Places, X2-Y2),
    Error is sqrt((X1 - X2)^2 + (Y1 - Y2)^2).

print_errors(What, Unit, Errors) :-
    length(Errors, Count),
    findall(Error, member(Error-_, Errors), Values),
    sum_list(Values, Sum),
    findall(Square, ( member(Value, Values), Square is Value*Value ), Squares),
    sum_list(Squares, SumOfSquares),
    Mean is Sum/Count,
    Rms is sqrt(SumOfSquares/Count),
    max_member(Worst-Seed, Errors),
    format("~d ~w: mean ~3f, rms ~3f, worst ~3f ~w (seed ~d)~n",
           [Count, What, Mean, Rms, Worst, Unit, Seed]).
