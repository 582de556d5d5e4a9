:- module(ev3dev_journal,
          [ because/2,                  % :Goal, +Cause
            why/1,                      % +What
            why/2,                      % +What, ?Why
            journal/1,                  % ?Journal
            journal_replay/1            % +File
          ]).
:- set_prolog_flag(generate_debug_info, false).
:- use_module(private/load/compiled, []).
:- use_module(library(lists), [append/3, member/2, reverse/2]).
:- use_module(private/checks/checks, [must_be/2, must_be_goal/1]).
:- use_module(private/errors/error_texts, [is_word/1]).
:- use_module(private/errors/errors,
              [existence_error/2, in_own_name/1, throw_error/3]).
:- use_module(private/errors/frames, [goal_of_program/1]).
:- use_module(private/errors/public_clauses, [term_expansion/4]).
:- use_module(private/files/directory, [readable_file/3, write_file/2]).
:- use_module(private/explain/hints, [fail_because/1]).
:- use_module(private/checks/arguments, [word/2]).
:- use_module(private/journal/causes,
              [acting_for/2, causes/2, explained/3, misspelt/2]).
:- use_module(private/files/facts, [throw_located/3]).
:- use_module(private/devices/robot_state, [robot/4, robot_description/1]).
:- use_module(private/journal/journal_words, [why_words//3]).
:- use_module(time, [wait/1]).
:- use_module(private/native/native,
              [ attribute_/4, attribute_write_/4, device_/3, drive_/4,
                drive_wait_/3, journal_entry_/4, led_set_color_/2,
                led_set_delays_/3, led_set_trigger_/2, motor_stop_/3,
                motor_wait_/3, now_/1, play_/3, say_/3, set_pose_/5,
                sound_stop_/0, stop_all_motors_/0, tones_/3 ]).
:- use_module(private/run/waits, [waited/1]).

:- meta_predicate because(0, +).

/** <module> Why did it do that?

The driver keeps the last 8192 commands to motors, lights and the loudspeaker,
with their times and their causes. A program says why it does something by
because/2; the libraries do so, too.

```
?- because(motor_run(outB, -30), too_near(18)).
?- why(outB).
outB runs at -30 %, since 2.31 s: too_near(18)
```

A move of the robot is one command; how the drive keeps the robot on its
course is not recorded. A new tree, such as that of sim_start/1, has an empty
journal.
*/

%!  because(:Goal, +Cause) is semidet.
%
%   Call Goal once. What it commands has Cause, a term, and the causes of the
%   goals around it. Leaves no choice point. An exception or a failure of Goal
%   is that of because/2, and ends Cause.
%
%   @error instantiation_error if Goal or Cause is unbound
%   @error type_error(callable, Goal)

because(Goal, Cause) :-
    must_be_goal(Goal),
    must_be(nonvar, Cause),
    plain_copy(Cause, Copy),
    acting_for(goal_of_program(Goal), Copy).

%   A fact has no attributes of variables.
plain_copy(Cause, Copy) :-
    term_attvars(Cause, Variables),
    (   Variables == []
    ->  Copy = Cause
    ;   copy_term_nat(Cause, Copy)
    ).

%!  why(+What) is det.
%
%   Print why/2 in words, or that nothing is known. Motors that were stopped
%   together are named together: `outB and outC were stopped (brake) at
%   3.20 s: rule halt`.
%
%   @error as why/2

why(What) :-
    why_at(What, inf).

why_at(What0, Until) :-
    (   Until == inf,
        nonvar(What0),
        explained(What0, _, Message)
    ->  print_message(help, Message)
    ;   is_misspelt(What0, Text)
    ->  print_message(help, ev3dev(why_misspelt(Text)))
    ;   word(What0, What),
        (   why_(What, Until, Why, Last)
        ->  stopped_with(What, Last, Ports),
            print_message(help, ev3dev(why(What, Ports, Why)))
        ;   print_message(help, ev3dev(why_nothing(What)))
        )
    ).

%   Nothing was commanded to What, and a library knows what may be meant.

is_misspelt(What, Text) :-
    nonvar(What),
    What \= rule(_),
    \+ ( atom(What),
         (   is_word(What)
         ;   memberchk(What, [robot, stop, sound])
         ;   why_(What, inf, _, _)
         ) ),
    once(misspelt(What, Text)).

%   The motors that got the same stop as the Last one, in the same instant:
%   within 0.02 s, by the same predicate, for the same cause.

stopped_with(What, done(Time, Of, Command, Cause, Called), Ports) :-
    is_stop(Command),
    Of \= robot(_, _),
    !,
    From is Time - 0.02,
    findall(Port,
            ( done_since(From, Done),
              Done = done(Then, Port, Same, Cause, Called),
              Then =< Time,
              Port \= robot(_, _),
              is_about(What, Port),
              same_stop(Command, Same) ),
            Ports0),
    sort(Ports0, Ports).
stopped_with(_, _, []).

done_since(From, done(Time, What, Command, Cause, Called)) :-
    done(Time, What, Command, Cause, Called),
    (   Time >= From
    ->  true
    ;   !,
        fail
    ).

%   The set-points that go with a stop are not the same for all.

same_stop(Command, Same) :-
    Command =.. [Class, Word, SetPoints],
    Same =.. [Class, Word, Others],
    (   memberchk(stop_action(Action), SetPoints)
    ->  memberchk(stop_action(Action), Others)
    ;   \+ memberchk(stop_action(_), Others)
    ).

:- multifile prolog:message//1.

prolog:message(ev3dev(why(What, Ports, Why))) -->
    why_words(Why, What, Ports).
prolog:message(ev3dev(why_misspelt(Text))) -->
    [ '~w'-[Text] ].
prolog:message(ev3dev(why_nothing(What))) -->
    [ '~w: no command is recorded'-[What] ].

%!  why(+What, ?Why) is semidet.
%
%   Why is the last command to What, a term `why(Time, Command, Causes)`. If
%   it is at(Time), print the last one that was given until Time. What is
%
%     - a port or a light, such as `outB`
%     - `robot`
%       The cause that moves the robot that is set, or its motors.
%     - `stop`
%       The last stop of a motor, or end of a course.
%     - `sound`
%       A command to play or to say something.
%     - rule(Name)
%       of the behave/1 that runs, or the last one. Why is rule(What, Place),
%       and What is `active`, false(Part) of its guard, above(Rule) that
%       applies, cooldown(Seconds), `ended` as long as its guard has not been
%       false again, or `applies`.
%     - a fluent of the run of Golog in this thread, or of the last one
%       Why is fluent(Value, By). By is initially(Place), or the last entry of
%       the history that set it, entry(Number, Entry, Place). Place is
%       File:Line of what says so, or `none`.
%     - a fluent of the run of library(ev3dev/layers) in this thread, or of
%       the last one
%       Why is fluent(Value, Since, Place): the time and the rule that
%       assigned it.
%
%   Time is that of ev3_time/1. Causes are those of because/2, the innermost
%   first, and at last called(Name/Arity), the predicate that wrote the
%   command; ev3dev_watchdog/0 is the stop of a program that computes for too
%   long (docs/safety.md). The libraries say
%
%     - rule(Name, Guard), rules(none), rules(ended), event(Id, Condition)
%       of library(ev3dev/rules): `none` if no rule applies, `ended` if
%       behave/1 has ended
%     - golog(Step, Action, Condition), proc(Name/Arity, Place),
%       interrupt(Condition), golog(ended(Reason))
%       of library(ev3dev/golog): the number of the step in the run, and the
%       condition of poss/2 that held; the innermost procedure, and
%       File:Line of its clause in which the action stands, or `none`; around
%       it the conditions of the interrupts that the action belongs to; why a
%       run stopped the motors at its end
%     - layers(Steps), layers(ended)
%       of library(ev3dev/layers): the proof of what sets the motor, steps
%       by(Head, Layer, Place) for rules, and sense(Sense, Value); `ended` if
%       control/1 has ended
%     - plan(Step, Cell)
%       of library(ev3dev/grid): `turn` or `move`
%     - leg(Part)
%       of library(ev3dev/navigation)
%     - course(Course, Options)
%       The course for which a wheel's motor is driven.
%     - replay(File)
%
%   Command is
%
%     - tacho_motor(Word, SetPoints), dc_motor(Word, SetPoints),
%       servo_motor(Word, SetPoints)
%       A word of the kernel's, and what the program had written of the
%       set-points that go with it, as speed_sp(-315).
%     - course(Course, Options)
%       A move of the robot; for the motor of a wheel it is `drive`, and the
%       course its first cause.
%     - ended(Reason)
%       The end of such a move, as in library(ev3dev/drive).
%     - stop(What, Command)
%       of `stop`
%     - wheel(Port, Command)
%       of `robot`, whose motor got a command by itself
%     - led(Color), led_trigger(Word), led_blink(On, Off)
%     - tones(Tones), say(Text), play(File), `stop`
%       of `sound`
%
%   Fails if there was no such command.
%
%   @error type_error(atom, What)
%   @error existence_error(rule, Name) if that behave/1 did not have it
%   @error existence_error(fluent, Fluent) if that run of Golog has none of
%          that name, but one that is spelt nearly so

why(What0, Why) :-
    (   nonvar(Why),
        Why = at(Until)
    ->  must_be(number, Until),
        why_at(What0, Until)
    ;   nonvar(What0),
        explained(What0, Why0, _)
    ->  Why = Why0
    ;   is_misspelt(What0, Text)
    ->  throw_error(existence_error(fluent, What0), _, Text)
    ;   word(What0, What),
        why_(What, inf, Why, _)
    ).

%   Last is what Why is about, as done/5 has it.

why_(stop, Until, Why, Last) :-
    !,
    Last = done(Time, What, Command0, Cause, Called),
    once(( concerning(stop, Until, Last),
           is_stop(Command0) )),
    shown(Command0, Command, First),
    all_causes(First, Cause, Called, Causes),
    Why = why(Time, stop(What, Command), Causes).
why_(What, Until, Why, Last) :-
    Last = done(Time, Of, Command0, Cause, Called),
    once(concerning(What, Until, Last)),
    (   Command0 = ended(_, _),
        What \== robot,
        once(( concerning(What, Time, Before),
               Before = done(_, _, Commanded, _, _),
               Commanded \= ended(_, _) )),
        Commanded \= course(_, _)
    ->  % The motor got another command on the way.
        Before = done(Time1, _, _, Cause1, Called1),
        all_causes([], Cause1, Called1, Causes),
        Why = why(Time1, Commanded, Causes)
    ;   shown(Command0, Command1, First),
        from_afar(What, Of, Command1, Command, First, First1),
        all_causes(First1, Cause, Called, Causes),
        Why = why(Time, Command, Causes)
    ).

done(Time, What, Command, Cause, Called) :-
    journal_entry_(Time, What-Command, Cause, Called).

concerning(What, Until, done(Time, Of, Command, Cause, Called)) :-
    done(Time, Of, Command, Cause, Called),
    Time @=< Until,            % a number stands before the atom inf
    Command \= pose(_, _, _),
    is_about(What, Of).

is_about(stop, _) :- !.
is_about(robot, Of) :-
    !,
    (   Of = robot(_, _)
    ->  true
    ;   robot(_, _, Left, Right),
        (   is_about(Left, Of)
        ->  true
        ;   is_about(Right, Of)
        )
    ).
is_about(Port, robot(Left, Right)) :-
    !,
    (   is_port(Port, Left)
    ->  true
    ;   is_port(Port, Right)
    ).
is_about(Port, Of) :-
    is_port(Port, Of).

%   A port may be spelled with the name of its board.
is_port(Port, Of) :-
    (   Port == Of
    ->  true
    ;   atom_concat(:, Of, End),
        sub_atom(Port, _, _, 0, End)
    ).

is_stop(ended(_, _)).
is_stop(tacho_motor(Word, _)) :- stop_word(Word).
is_stop(dc_motor(Word, _)) :- stop_word(Word).
is_stop(servo_motor(float, _)).

stop_word(stop).
stop_word(reset).

shown(ended(Reason, Course), ended(Reason), [Course]) :-
    !.
shown(Command, Command, []).

%   The motor of a wheel is asked about, and the robot got a command, or the
%   other way round.

from_afar(robot, Of, Command0, Command, First, First) :-
    !,
    (   Of = robot(_, _)
    ->  Command = Command0
    ;   Command = wheel(Of, Command0)
    ).
from_afar(_, _, Command0, Command, First0, First) :-
    (   Command0 = course(_, _)
    ->  Command = drive,
        First = [Command0]
    ;   Command = Command0,
        First = First0
    ).

all_causes(First, Number, Called, Causes) :-
    causes(Number, Around),
    (   Called == none
    ->  Last = []
    ;   Last = [called(Called)]
    ),
    append(Around, Last, Causes0),
    append(First, Causes0, Causes).

%!  journal(?Journal) is det.
%
%   If Journal is unbound, it becomes the list of what was done, in order:
%   terms command(Time, What, Command, Causes), as of why/2. The robot has
%   What = robot(Left, Right), and a command more: pose(X, Y, Heading) of
%   set_pose/3. A sound has What = `sound`, and tones(Tones), say(Text),
%   play(File) or `stop`. Else Journal is a file, which is written with these
%   terms as facts.
%
%   @error type_error(atom, Journal)
%   @error the errors of open/4

journal(Journal) :-
    (   var(Journal)
    ->  events(Events),
        Journal = Events
    ;   is_about_list(Journal)
    ->  events(Journal)
    ;   word(Journal, File),
        events(Events),
        write_file(File, write_events(Events))
    ).

is_about_list([]).
is_about_list([_|_]).

events(Events) :-
    findall(command(Time, What, Command, Causes),
            event(Time, What, Command, Causes),
            Events0),
    reverse(Events0, Events).

event(Time, What, Command, Causes) :-
    done(Time, What, Command0, Cause, Called),
    shown(Command0, Command, First),
    all_causes(First, Cause, Called, Causes).

% ---------------- FILES

write_events(Events, Stream) :-
    (   member(command(_, robot(_, _), _, _), Events),
        robot(_Diameter, _, _, _)
    ->  robot_description(Robot),
        write_fact(Stream, Robot)
    ;   true
    ),
    forall(member(Event, Events), write_fact(Stream, Event)),
    (   a_motor_runs
    ->  now_(Now),
        write_fact(Stream, end(Now))
    ;   true
    ).

a_motor_runs :-
    motor_class(Class),
    device_(Class, Port, _),
    attribute_(Class, Port, state, State),
    sub_atom(State, _, _, _, running),
    !.

motor_class('tacho-motor').
motor_class('dc-motor').

%   The operators are those of the language, whatever a program has added.

:- initialization(set_module(ev3dev_journal_text:base(system))).

write_fact(Stream, Fact0) :-
    readable(Fact0, Fact),
    numbervars(Fact, 0, _),
    write_term(Stream, Fact,
               [ quoted(true), numbervars(true), module(ev3dev_journal_text),
                 spacing(next_argument)
               ]),
    write(Stream, '.\n').

%   What cannot be read again, as a stream, becomes its name.

readable(Term0, Term) :-
    (   var(Term0)
    ->  Term = Term0
    ;   blob(Term0, Type),
        Type \== text,
        Term0 \== []
    ->  term_to_atom(Type, Term)
    ;   compound(Term0)
    ->  compound_name_arguments(Term0, Name, Arguments0),
        all_readable(Arguments0, Arguments),
        compound_name_arguments(Term, Name, Arguments)
    ;   Term = Term0
    ).

all_readable([], []).
all_readable([Term0|Terms0], [Term|Terms]) :-
    readable(Term0, Term),
    all_readable(Terms0, Terms).

%!  journal_replay(+File) is semidet.
%
%   Give the commands in a File of journal/1 again, at their times from the
%   first one on, on whatever robot or simulation is in use. Waits. A replay
%   reads no sensor, so it is the same run only if the robot begins in the
%   same place and meets the same things. The robot rests at the end, also
%   after an exception. Fails if a device is missing; then nothing has moved.
%
%   @error existence_error(source_sink, File)
%   @error domain_error(journal_fact, Fact), with file and line
%   @error syntax_error(What)

journal_replay(File) :-
    journal_file(File, Path),
    setup_call_cleanup(
        in_own_name(open(Path, read, Stream, [encoding(utf8)])),
        read_facts(Stream, Path, Facts),
        close(Stream)),
    must_be_there(Facts),
    replayed_robot(Facts, Robot),
    setup_call_cleanup(
        true,
        acting_for(replay(Facts, Robot), replay(Path)),
        stop_all_motors_).

journal_file(File, Path) :-
    must_be(nonvar, File),
    (   ( atom(File) ; string(File) ; compound(File) ),
        readable_file(File, pl, Path)
    ->  true
    ;   existence_error(source_sink, File)
    ).

read_facts(Stream, File, Facts) :-
    read_term(Stream, Fact,
              [module(ev3dev_journal_text), term_position(Position)]),
    (   Fact == end_of_file
    ->  Facts = []
    ;   (   is_fact(Fact)
        ->  true
        ;   stream_position_data(line_count, Position, Line),
            stream_position_data(line_position, Position, LinePosition),
            stream_position_data(char_count, Position, CharCount),
            throw_located(domain_error(journal_fact, Fact),
                          file(File, Line, LinePosition, CharCount),
                          'not a fact that journal/1 writes')
        ),
        Facts = [Fact|Rest],
        read_facts(Stream, File, Rest)
    ).

is_fact(Fact) :-
    var(Fact),
    !,
    fail.
is_fact(end(Time)) :-
    number(Time).
is_fact(robot(Left, Right, LeftCm, RightCm, LeftBack, RightBack, Cm,
              Offset)) :-
    all_are(atom, [Left, Right]),
    all_are(number, [LeftCm, RightCm, Cm, Offset]),
    all_are(boolean, [LeftBack, RightBack]).
is_fact(command(Time, What, Command, Causes)) :-
    number(Time),
    is_list(Causes),
    nonvar(What),
    nonvar(Command),
    is_command(What, Command).

is_command(robot(Left, Right), Command) :-
    !,
    all_are(atom, [Left, Right]),
    is_of_robot(Command).
is_command(sound, Command) :-
    !,
    is_sound(Command).
is_command(What, Command) :-
    atom(What),
    (   motor_command(Command, _, Word, SetPoints)
    ->  atom(Word),
        is_list(SetPoints),
        all_are(set_point, SetPoints)
    ;   is_light(Command)
    ).

is_of_robot(course(Course,
                   options(Percent, Acceleration, Action, UseGyro))) :-
    is_course(Course),
    all_are(number, [Percent, Acceleration]),
    is_a(stop_action, Action),
    is_a(boolean, UseGyro).
is_of_robot(ended(Reason)) :-
    atom(Reason).
is_of_robot(pose(X, Y, Heading)) :-
    all_are(number, [X, Y, Heading]).

is_course(Course) :-
    nonvar(Course),
    (   Course = legs(Legs, Backwards)
    ->  is_list(Legs),
        all_are(leg, Legs),
        is_a(boolean, Backwards)
    ;   Course =.. [Name, A, B],
        memberchk(Name, [cruise, change, wheels]),
        all_are(number, [A, B])
    ).

is_sound(stop).
is_sound(say(Text)) :- atom(Text).
is_sound(play(File)) :- atom(File).
is_sound(tones(Tones)) :- is_list(Tones), all_are(tone, Tones).

is_light(led(Color)) :-
    (   Color = levels(_, _)
    ;   Color = levels(_, _, _)
    ),
    !,
    Color =.. [_|Levels],
    all_are(nonneg, Levels).
is_light(led(Color)) :-
    is_a(color, Color).
is_light(led_trigger(Word)) :-
    atom(Word).
is_light(led_blink(On, Off)) :-
    all_are(nonneg, [On, Off]).

all_are(_, []).
all_are(Type, [Term|Terms]) :-
    is_a(Type, Term),
    all_are(Type, Terms).

is_a(atom, Term) :- atom(Term).
is_a(number, Term) :- number(Term).
is_a(nonneg, Term) :- integer(Term), Term >= 0.
is_a(boolean, Term) :- ( Term == true ; Term == false ), !.
is_a(color, Term) :- ( atom(Term) ; is_a(nonneg, Term) ), !.
is_a(stop_action, Term) :-
    atom(Term),
    memberchk(Term, [coast, brake, hold]).
is_a(set_point, Term) :-
    compound(Term),
    Term =.. [Name, Value],
    (   Name == stop_action
    ->  is_a(stop_action, Value)
    ;   memberchk(Name, [ speed_sp, position_sp, time_sp, duty_cycle_sp,
                          ramp_up_sp, ramp_down_sp ]),
        integer(Value)
    ).
is_a(tone, Term) :-
    nonvar(Term),
    Term = tone(Hertz, Milliseconds),
    all_are(nonneg, [Hertz, Milliseconds]).
is_a(leg, Term) :-
    compound(Term),
    (   Term = through(Places, Radius)
    ->  is_list(Places),
        all_are(place, Places),
        number(Radius)
    ;   Term =.. [Name|Numbers],
        length(Numbers, Count),
        memberchk(Name/Count,
                  [ turn/1, heading/1, face/1, towards/2, to/2, reach/2,
                    arc/2 ]),
        all_are(number, Numbers)
    ).
is_a(place, Term) :-
    nonvar(Term),
    Term = X-Y,
    all_are(number, [X, Y]).

motor_command(tacho_motor(Word, SetPoints), 'tacho-motor', Word, SetPoints).
motor_command(dc_motor(Word, SetPoints), 'dc-motor', Word, SetPoints).
motor_command(servo_motor(Word, SetPoints), 'servo-motor', Word, SetPoints).

% ---------------- AGAIN

%   All motors are there.

must_be_there([]).
must_be_there([Fact|Facts]) :-
    (   motor_of(Fact, Class, Port),
        \+ device_(Class, Port, _)
    ->  fail_because(absent(Class, Port))
    ;   must_be_there(Facts)
    ).

motor_of(command(_, Port, Command, _), Class, Port) :-
    motor_command(Command, Class, _, _),
    !.
motor_of(command(_, robot(Left, Right), _, _), 'tacho-motor', Port) :-
    ( Port = Left ; Port = Right ).

replayed_robot(Facts, Robot) :-
    (   member(Fact, Facts),
        functor(Fact, robot, 8)
    ->  Robot = Fact
    ;   member(command(_, robot(_, _), _, _), Facts)
    ->  robot_description(Robot)
    ;   Robot = none
    ).

replay(Facts, Robot) :-
    (   member(command(First, _, _, _), Facts)
    ->  now_(Now),
        Shift is Now - First,
        replay_each(Facts, Shift, Robot),
        (   member(end(_), Facts)
        ->  true
        ;   last_moves(Facts, Robot)
        )
    ;   true
    ).

replay_each([], _, _).
replay_each([Fact|Facts], Shift, Robot) :-
    replay_fact(Fact, Shift, Robot),
    replay_each(Facts, Shift, Robot).

replay_fact(command(Time, What, Command, _), Shift, Robot) :-
    !,
    wait_until(Time, Shift),
    once(again(What, Command, Robot)).
replay_fact(end(Time), Shift, _) :-
    !,
    wait_until(Time, Shift).
replay_fact(_, _, _).

wait_until(Time, Shift) :-
    now_(Now),
    Left is Time + Shift - Now,
    (   Left > 0
    ->  wait(Left)
    ;   true
    ).

again(robot(_, _), pose(X, Y, Heading), Robot) :-
    !,
    set_pose_(Robot, true, X, Y, Heading).
again(robot(_, _), course(Course, Options), Robot) :-
    !,
    Options = options(Percent, Acceleration, Action, UseGyro),
    drive_(Robot, Course,
           options(Percent, Acceleration, Action, UseGyro, false, infinite),
           _),
    !.
again(robot(Left, Right), ended(Reason), Robot) :-
    !,
    (   Reason == reached
    ->  % It may take a moment longer this time.
        drive_wait_(Robot, 2, Ended),
        waited(Ended)
    ;   motor_stop_('tacho-motor', Left, brake),
        motor_stop_('tacho-motor', Right, brake)
    ).
again(sound, Sound, _) :-
    !,
    sound_again(Sound).
again(Port, Command, _) :-
    motor_command(Command, Class, Word, SetPoints),
    !,
    forall(member(SetPoint, SetPoints),
           ( SetPoint =.. [Name, Value],
             attribute_write_(Class, Port, Name, Value) )),
    attribute_write_(Class, Port, command, Word).
again(Light, led(Color), _) :-
    led_set_color_(Light, Color).
again(Light, led_trigger(Word), _) :-
    led_set_trigger_(Light, Word).
again(Light, led_blink(On, Off), _) :-
    led_set_delays_(Light, On, Off).

sound_again(stop) :-
    sound_stop_.
sound_again(tones(Tones)) :-
    tones_(Tones, false, _),
    !.
sound_again(say(Text)) :-
    say_(Text, false, _),
    !.
sound_again(play(File)) :-
    play_(File, false, _),
    !.

%   Nothing ran when the journal was written: the last moves come to their
%   ends.

last_moves(Facts, Robot) :-
    findall(Port, last_moved(Facts, Port), Ports0),
    sort(Ports0, Ports),
    forall(member(Port, Ports),
           ( motor_wait_([Port], infinite, Reason), waited(Reason) )),
    (   reverse(Facts, Backwards),
        member(command(_, robot(_, _), Last, _), Backwards)
    ->  (   Last = course(legs(_, _), _)
        ->  drive_wait_(Robot, infinite, Ended),
            waited(Ended),
            !
        ;   true
        )
    ;   true
    ).

last_moved(Facts, Port) :-
    append(_, [command(_, Port, tacho_motor(Word, _), _)|Rest], Facts),
    memberchk(Word, ['run-to-abs-pos', 'run-to-rel-pos', 'run-timed']),
    \+ member(command(_, Port, _, _), Rest).
