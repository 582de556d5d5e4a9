:- module(ev3dev_exercise,
          [ exercise_check/1,           % +Exercise
            exercise_check/2,           % +Exercise, +Options
            exercise_try/3,             % +Exercise, +File, +Options
            exercise_mark/4,            % +Exercise, +Files, +Options, -Marks
            run_seed/1,                 % -Seed
            run_world/1,                % -Facts
            collisions/1,               % ?Count
            ended/1,                    % -How
            duration/1,                 % -Seconds
            ended_at/2,                 % -Place, -Heading
            ended_near/2,               % +Place, -Distance
            path_length/1,              % -Length
            path_turns/1,               % -Degrees
            time_to/2,                  % +Place, -Seconds
            time_to/3,                  % +Place, +Radius, -Seconds
            cells_visited/2,            % +Size, -Count
            lap_fraction/2,             % +Distance, -Share
            pushed/2,                   % ?Name, -Length
            carried/2,                  % ?Name, -Length
            thing_in/2,                 % ?Name, +Area
            commands/1,                 % ?Count
            said/1,                     % -Text
            printed/1                   % +Text
          ]).
:- set_prolog_flag(generate_debug_info, false).
:- use_module(private/load/compiled, []).
:- use_module(private/checks/arguments, [must_be_options/3, number_value/3]).
:- use_module(private/checks/checks, [must_be/2]).
:- use_module(private/errors/public_clauses, [term_expansion/4]).
:- use_module(private/checks/places, [place/2, places/2]).
:- use_module(private/errors/errors, [domain_error/2]).
:- use_module(private/marking/mark,
              [ check_solution/2, marks/4, tried/3 ]).
:- use_module(private/marking/record,
              [run_collision/1, run_fact/1, run_pose/4, run_things/3]).
:- use_module(library(lists), [append/3, last/2, member/2, reverse/2]).
:- reexport(random_worlds).

/** <module> Exercises, and how programs do in them

An exercise says what a robot's program should do, in which worlds, and how
many points it earns. It is a file of facts and rules:

```
:- use_module(library(ev3dev/exercise)).

exercise(obstacles, [goal(start), seconds(60), noise(true), seeds(1-10)]).

world(Seed, World) :- random_room(Seed, [boxes(3-5)], World).

score(5, 'touches nothing') :-
    collisions(0),
    path_length(Cm), Cm > 200.
score(5, 'gets around') :-
    cells_visited(30, Count), Count >= 12.
score(partial(3), 'far from the start', Share) :-
    ended_near(40-40, Cm), Share is Cm/200.

forbid(shell/1).
```

A student tries a program, and a teacher marks those of a class:

```sh
swipl ev3dev try obstacles.pl mine.pl
swipl ev3dev mark obstacles.pl submissions/
```

The program runs once with each seed, in a process of its own that sees the
files of a robot and nothing else: see library(ev3dev/sim_fenced). It has no
world, no seed and no marks, and where bubblewrap is installed no other files
and no network. The same programs get the same marks, whatever else the
machine has to do.

## The facts of an exercise {#exercise-facts}

  - exercise(Name, Options)
    Once. Options:

      - goal(Goal)
        What is called after the program was loaded. Default is `start`.
      - seconds(Seconds)
        How long a run is, in the robot's time. Default is 60.
      - seeds(Seeds)
        A list of integers, or `From-To`: the runs that are marked. Default is
        1-10.
      - open(Seeds)
        The runs that students can try. Default is the first three.
      - robot(Robot), noise(Boolean), thinking(Thinking)
        As for sim_start/2. With `thinking(brick)` the robot drives on while
        its program computes, as on a brick.
      - cpu(Seconds)
        How much time of a processor a run may use. Default is 10. There is
        one second more for each second of the robot's time.
      - sleep(Seconds)
        How long a run may sleep without asking the robot anything. Default
        is 30.
      - memory(Megabytes)
        Default is 2000.
      - solution(File)
        For exercise_check/1, next to this file. Default is `solution.pl`.

  - world(Seed, World)
    The world of a seed, as for sim_start/2; `room` if there is no such rule.
  - score(Points, Text)
    A rule whose body is true of a run that earns Points. Text says for what.
  - score(partial(Points), Text, Share)
    The same for a Share of them, which is taken as 0 if it is less, and as 1
    if it is more.
  - happens(Seed)
    A goal at the beginning of each run, which may plan events by sim_at/2,
    sim_press/2 or sim_unplug/1.
  - forbid(Name/Arity)
    A program that mentions such a predicate has no points. It is searched in
    the text, so it is a help, not a fence.

For each score a program gets the mean of its runs. A run earns nothing if the
robot was not used, or if a limit on processor time, memory, sleep or output
ended it. If that happens with the first two seeds, the others are not run.

Other programs on the machine change no mark: only what the program itself
does counts for its limits, and its random numbers follow the seed of the run.
The text of the exercise goes into them, too, so a comment in the copy that
marks is enough, and nobody can find the seed from these numbers.

## What a run was like {#exercise-runs}

Scores ask about the run that has ended: collisions/1 and what follows it
here. All places are `X-Y` in cm.
*/

% ---------------- MARKS

%!  exercise_mark(+Exercise, +Files, +Options, -Marks) is det.
%
%   Run each of the programs Files on the seeds of the file Exercise. A folder
%   has a file or a folder for each student: docs/marking.md shows the forms
%   of learning platforms, and which file begins. Marks is a list in that
%   order, of
%
%   ```
%   mark(Name, Points, Of, Scores, Runs, Reason)
%   ```
%
%   Name is that of the student's folder, or of the file without `.pl`, and
%   Points, of Of, what it earned. Scores is a list of
%   score(Text, Points, Of, Missed), Missed being the number of runs that did
%   not earn it whole. Runs is a list of run(Seed, Points, Ended, Seconds):
%   Ended is as of sim_fenced/3, or `not_run`. Reason is a text of what is
%   wrong with the program, or ''.
%   Options:
%
%     - seeds(Seeds)
%       Instead of those of the exercise.
%     - jobs(Number)
%       How many runs there are at once. By default one for each processor.
%     - redis(Address)
%       Have the workers of a Redis server make the runs: see sim_batch/5.
%     - out(Directory)
%       Write the reports into that directory: `index.html` for the teacher,
%       a page for each program in `pages`, `marks.csv`, `junit.xml`,
%       `results.json` with all marks, for each program its result in
%       Gradescope's form in `gradescope`, and where their students are known
%       `moodle.csv`, a grading worksheet, and `classroom.csv`.
%     - formats(List)
%       Which of `html`, `csv`, `junit`, `json`, `gradescope`, `moodle`,
%       `classroom`. Default is all.
%     - participants(File)
%       The list of the class, a table: Moodle's grading worksheet, a roster
%       of GitHub Classroom, or any other with names. Who is in no submission
%       gets a mark without points.
%     - earlier(Folder)
%       Submissions of an earlier class, for similar programs.
%     - resume(Boolean)
%       Whether runs whose results are in Directory already are not made
%       again, if neither the program nor the exercise has changed. The
%       results are written when they come, so a marking that was interrupted
%       goes on. Default is `false`.
%     - progress(Boolean)
%       Whether to print how many runs are over. Default is `false`.
%     - enclosed(Boolean)
%       Whether to shut programs in by bubblewrap. Default is `true`. With
%       `false` they can read files and use the network.
%
%   @error existence_error(source_sink, File)
%   @error existence_error(directory, Folder)
%   @error domain_error(participants, File) if it has no rows
%   @error existence_error(program, bwrap) if programs are to be enclosed, and
%          bubblewrap is not installed or may not be used
%   @error permission_error(_, _, _) if nothing can be written into Directory
%   @error domain_error(exercise, Fact) if something is wrong in Exercise, or
%          it does not load without errors
%   @error domain_error(exercise_option, Option)
%   @error the errors of sim_batch/5

exercise_mark(Exercise, Files, Options, Marks) :-
    must_be(list, Files),
    must_be_options(exercise_option,
                    [ seeds, jobs, redis, out, formats, resume, progress,
                      enclosed, participants, earlier ], Options),
    marks(Exercise, Files, Options, Marks).

%!  exercise_try(+Exercise, +File, +Options) is semidet.
%
%   Run the program File on the open seeds of Exercise, and print what it
%   earns, and why it does not earn more. Fails if it did not earn all.
%   Options are `seeds`, `jobs`, `redis` and `enclosed` of exercise_mark/4; by
%   default the program is enclosed if bubblewrap is installed, and a message
%   says so if it is not.
%
%     - page(File)
%       Write a page with a picture of the worst run.
%
%   @error as exercise_mark/4

exercise_try(Exercise, File, Options) :-
    must_be_options(exercise_option, [seeds, jobs, redis, enclosed, page],
                    Options),
    tried(Exercise, File, Options).

%!  exercise_check(+Exercise) is semidet.
%!  exercise_check(+Exercise, +Options) is semidet.
%
%   For authors of exercises: run the solution on all seeds, and print how its
%   points vary. Fails if the solution does not earn all of them. Options are
%   `seeds`, `jobs` and `enclosed` of exercise_mark/4.
%
%   @error as exercise_mark/4

exercise_check(Exercise) :-
    exercise_check(Exercise, []).

exercise_check(Exercise, Options) :-
    must_be_options(exercise_option, [seeds, jobs, enclosed], Options),
    check_solution(Exercise, Options).

% ---------------- MEASURES

%!  run_seed(-Seed) is semidet.
%
%   The random seed of the run.

run_seed(Seed) :-
    run_fact(seed(Seed)).

%!  run_world(-Facts) is semidet.
%
%   The facts of the world of the run.

run_world(Facts) :-
    run_fact(world(Facts)).

%!  collisions(?Count) is semidet.
%
%   How often the robot ran into something; 256 if more often. A thing that it
%   began to push counts, too; one that lies between open jaws does not.

collisions(Count) :-
    findall(x, run_collision(_), Collisions),
    length(Collisions, Found),
    Count = Found.

%!  ended(-How) is semidet.
%
%   `over` if the time of the run was over, else exit(Status).

ended(How) :-
    run_fact(ended(How)).

%!  duration(-Seconds) is semidet.
%
%   The time of the run, on the robot's clock.

duration(Seconds) :-
    run_fact(seconds(Seconds)).

%!  ended_at(-Place, -Heading) is semidet.
%
%   Where the robot was at the end, and which way it looked: Place is `X-Y` in
%   cm, and Heading in degrees clockwise from north, from 0 to below 360.

ended_at(Place, Heading) :-
    findall(pose(X-Y, H), run_pose(_, X, Y, H), Poses),
    last(Poses, pose(Place, Turned)),
    Heading is Turned - 360*floor(Turned/360).

%!  ended_near(+Place, -Distance) is semidet.
%
%   How far from Place the robot was at the end, in cm.

ended_near(Place0, Distance) :-
    place(Place0, X-Y),
    ended_at(X1-Y1, _),
    Distance is sqrt((X1-X)**2 + (Y1-Y)**2).

%!  path_length(-Length) is semidet.
%
%   The length of the robot's path, in cm.

path_length(Length) :-
    findall(X-Y, run_pose(_, X, Y, _), Places),
    way_length(Places, 0, Length).

way_length([X-Y|Places], Length0, Length) :-
    (   Places = [X1-Y1|_]
    ->  Length1 is Length0 + sqrt((X1-X)**2 + (Y1-Y)**2),
        way_length(Places, Length1, Length)
    ;   Length = Length0
    ).

%!  path_turns(-Degrees) is semidet.
%
%   How far the robot turned on its path, to the left and to the right
%   together, in degrees. A robot that shakes turns much more than its path.

path_turns(Degrees) :-
    findall(Heading, run_pose(_, _, _, Heading), Headings),
    all_turns(Headings, 0, Degrees).

all_turns([Heading|Headings], Degrees0, Degrees) :-
    (   Headings = [Next|_]
    ->  Turn is abs(Next-Heading),
        Degrees1 is Degrees0 + min(Turn, abs(360-Turn)),
        all_turns(Headings, Degrees1, Degrees)
    ;   Degrees = Degrees0
    ).

%!  time_to(+Place, -Seconds) is semidet.
%!  time_to(+Place, +Radius, -Seconds) is semidet.
%
%   When the robot was first within Radius of Place, in cm; default is 10.
%   Fails if it never was.

time_to(Place, Seconds) :-
    time_to(Place, 10, Seconds).

time_to(Place0, Radius0, Seconds) :-
    place(Place0, X-Y),
    number_value(positive_number, Radius0, Radius),
    run_pose(Time, X1, Y1, _),
    (X1-X)**2 + (Y1-Y)**2 =< Radius**2,
    !,
    Seconds = Time.

%!  cells_visited(+Size, -Count) is semidet.
%
%   In how many squares the middle of the robot was, if the floor is laid out
%   with squares of Size cm, one of them with a corner at 0-0.

cells_visited(Size0, Count) :-
    number_value(positive_number, Size0, Size),
    findall(X-Y,
            ( run_pose(_, X0, Y0, _),
              X is floor(X0/Size),
              Y is floor(Y0/Size) ),
            Cells0),
    sort(Cells0, Cells),
    length(Cells, Found),
    Count = Found.

%!  lap_fraction(+Distance, -Share) is semidet.
%
%   Share, from 0 to 1, is how much of the first line of the world the robot
%   has passed within Distance cm. Fails if the world has no line.

lap_fraction(Distance0, Share) :-
    number_value(positive_number, Distance0, Distance),
    run_fact(world(Facts)),
    member(line(_, _, Points), Facts),
    !,
    marks_on(Points, Marks),
    findall(X-Y, run_pose(_, X, Y, _), Places),
    findall(Mark, ( member(Mark, Marks), passed(Mark, Places, Distance) ),
            Passed),
    length(Marks, All),
    length(Passed, Count),
    All > 0,
    Share is Count/float(All).

passed(MX-MY, Places, Distance) :-
    member(X-Y, Places),
    (X-MX)**2 + (Y-MY)**2 =< Distance**2,
    !.

%   At least each 5 cm.

marks_on([From|Points], Marks) :-
    (   Points = [To|_]
    ->  between_places(From, To, Here),
        marks_on(Points, Others),
        append(Here, Others, Marks)
    ;   Marks = [From]
    ).

between_places(X0-Y0, X1-Y1, Places) :-
    Count is max(1, ceiling(sqrt((X1-X0)**2 + (Y1-Y0)**2)/5)),
    Last is Count-1,
    findall(X-Y,
            ( between(0, Last, N),
              X is X0 + (X1-X0)*N/Count,
              Y is Y0 + (Y1-Y0)*N/Count ),
            Places).

%!  pushed(?Name, -Length) is nondet.
%!  carried(?Name, -Length) is nondet.
%
%   The length, in cm, of the way on which the thing called Name moved: pushed
%   is what it moved by itself or by a push, and carried what it moved while a
%   gripper of the robot held it. Things are those of sim_thing/4. Fails if
%   there was no such thing.

pushed(Name, Length) :-
    thing_ways(Name, Length, _).

carried(Name, Length) :-
    thing_ways(Name, _, Length).

thing_ways(Name, Pushed, Carried) :-
    findall(Things-Held, run_things(_, Things, Held), Newest),
    findall(Each,
            ( member(Things-_, Newest),
              member(thing(Each, _, _, _), Things) ),
            All),
    sort(All, Names),
    one_named(Name, Name, Names),
    reverse(Newest, Moments),
    moved(Moments, Name, 0, Pushed, 0, Carried).

%   A name that is given leaves no choice.

one_named(Name, Found, All) :-
    (   nonvar(Name)
    ->  memberchk(Found, All)
    ;   member(Found, All)
    ).

moved([Things-Held|Moments], Name, Pushed0, Pushed, Carried0, Carried) :-
    (   Moments = [Things1-Held1|_]
    ->  (   memberchk(thing(Name, X, Y, _), Things),
            memberchk(thing(Name, X1, Y1, _), Things1)
        ->  Length is sqrt((X1-X)**2 + (Y1-Y)**2)
        ;   Length = 0
        ),
        (   memberchk(Name, Held),
            memberchk(Name, Held1)
        ->  Pushed1 = Pushed0,
            Carried1 is Carried0+Length
        ;   Pushed1 is Pushed0+Length,
            Carried1 = Carried0
        ),
        moved(Moments, Name, Pushed1, Pushed, Carried1, Carried)
    ;   Pushed = Pushed0,
        Carried = Carried0
    ).

%!  thing_in(?Name, +Area) is nondet.
%
%   True if the thing called Name lies in Area at the end: its middle is
%   there, and no gripper of the robot holds it. Area is a list of corners, as
%   a patch of the world has, or circle(X, Y, Radius).
%
%   @error domain_error(area, Area)
%   @error as is/2

thing_in(Name, Area0) :-
    area(Area0, Area),
    run_things(_, Things, Held),
    !,                                  % the latest
    one_named(Name, thing(Name, X, Y, _), Things),
    \+ memberchk(Name, Held),
    within(Area, X, Y).

area(Area0, Area) :-
    must_be(nonvar, Area0),
    (   Area0 = circle(X0, Y0, Radius0)
    ->  place(X0-Y0, X-Y),
        number_value(positive_number, Radius0, Radius),
        Area = circle(X, Y, Radius)
    ;   Area0 = [_, _, _|_]
    ->  places(Area0, Corners),
        Area = corners(Corners)
    ;   domain_error(area, Area0)
    ).

within(circle(X0, Y0, Radius), X, Y) :-
    (X-X0)**2 + (Y-Y0)**2 =< Radius**2.
within(corners(Corners), X, Y) :-
    Corners = [First|_],
    append(Corners, [First], Around),
    findall(x, ( edge(Around, From, To), left_of(From, To, X, Y) ), Edges),
    length(Edges, Count),
    Count mod 2 =:= 1.

edge([From, To|_], From, To).
edge([_|Corners], From, To) :-
    edge(Corners, From, To).

%   A line from the place to the right crosses an odd number of edges.

left_of(X1-Y1, X2-Y2, X, Y) :-
    ( Y1 =< Y -> Y < Y2 ; Y2 =< Y ),
    X < X1 + (Y-Y1)*(X2-X1)/(Y2-Y1).

%!  commands(?Count) is semidet.
%
%   How many commands the program gave to motors, among the last 4096 files
%   that it wrote: to start, to stop, to hold. A new speed while a motor runs
%   is one, too, and so is the library's that stops a motor at the end.

commands(Count) :-
    run_fact(commands(Count)).

%!  said(-Text) is nondet.
%
%   What the robot said aloud, an atom.

said(Text) :-
    run_fact(said(Text)).

%!  printed(+Text) is semidet.
%
%   Whether the program printed Text, among other things.

printed(Text) :-
    must_be(text, Text),
    run_fact(output(Output)),
    sub_string(Output, _, _, _, Text),
    !.
