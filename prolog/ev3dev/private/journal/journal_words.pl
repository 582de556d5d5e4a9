:- module(ev3dev_journal_words,
          [ why_words//3,               % +Why, +What, +Ports
            without_names/2,            % +Term0, -Term
            command_words//2,           % +Command, +What
            cause_words//1,             % +Cause
            step_words//1               % +Step
          ]).
:- use_module(library(lists), [append/3]).
:- use_module('../native/native', [motor_counts_/3]).

/** <module> Commands and their causes in words
*/

%!  why_words(+Why, +What, +Ports)// is semidet.
%
%   The message for a Why of why/2, which was asked about What. Ports are the
%   motors that were stopped together, if it is about such a stop, else [].

why_words(why(Time, Command0, Causes0), What, Ports) -->
    { without_names(Causes0, Causes),
      about(Command0, What, Command, Who0),
      (   Ports = [_, _|_]
      ->  Who = Ports
      ;   Who = Who0
      )
    },
    command(Command, Who, When),
    { when(When, Since) },
    [ '~w ~2f s'-[Since, Time] ],
    reasons(Causes).

when(since, ', since').
when(at, ' at').

%!  without_names(+Term0, -Term) is det.
%
%   A variable of Term is written as _.

without_names(Causes0, Causes) :-
    copy_term(Causes0, Causes),
    term_variables(Causes, Variables),
    unnamed(Variables).

unnamed([]).
unnamed(['$VAR'('_')|Variables]) :-
    unnamed(Variables).

about(stop(Of, Stop), _, Stop, Who) :-
    !,
    (   Of = robot(_, _)
    ->  Who = robot
    ;   Who = Of
    ).
about(wheel(Port, Command), _, Command, Port) :-
    !.
about(Command, What, Command, What).

%!  command_words(+Command, +What)// is semidet.
%
%   What was done to What, a port, a light, `sound`, or the robot. Asks no
%   device. Fails for what moves nothing.

command_words(Command, What) -->
    { What = robot(_, _)
    ->  Who = robot
    ;   Who = What
    },
    command(Command, Who, _).

%   Since is `since` or `at`: what goes on, or was done once.

command(tacho_motor('run-forever', SetPoints), Port, since) -->
    !,
    [ '~w runs'-[Port] ],
    speed(SetPoints, Port).
command(tacho_motor('run-timed', SetPoints), Port, at) -->
    !,
    [ '~w was sent'-[Port] ],
    speed(SetPoints, Port),
    time(SetPoints).
command(tacho_motor('run-to-abs-pos', SetPoints), Port, at) -->
    !,
    [ '~w was sent to '-[Port] ],
    angle(SetPoints, Port),
    speed(SetPoints, Port).
command(tacho_motor('run-to-rel-pos', SetPoints), Port, at) -->
    !,
    [ '~w was turned by '-[Port] ],
    angle(SetPoints, Port),
    speed(SetPoints, Port).
command(dc_motor('run-timed', SetPoints), Port, at) -->
    !,
    [ '~w was given'-[Port] ],
    duty(SetPoints),
    time(SetPoints).
command(servo_motor(run, SetPoints), Port, at) -->
    !,
    { memberchk(position_sp(Percent), SetPoints)
    ->  true
    ;   Percent = 'some'
    },
    [ '~w was sent to ~w %'-[Port, Percent] ].
command(servo_motor(float, _), Port, since) -->
    !,
    [ '~w floats'-[Port] ].
command(led(Color), Light, since) -->
    !,
    [ 'the light ~w is ~w'-[Light, Color] ].
command(led_trigger(Word), Light, since) -->
    !,
    [ 'the light ~w shows ~w'-[Light, Word] ].
command(led_blink(On, Off), Light, since) -->
    !,
    [ 'the light ~w blinks (~d ms on, ~d off)'-[Light, On, Off] ].
command(drive, Port, since) -->
    !,
    [ '~w drives the robot'-[Port] ].
command(course(Course, Options), _, since) -->
    !,
    [ 'the robot '-[] ],
    course(Course, Options).
command(ended(Reason), robot, since) -->
    !,
    [ 'the robot stands still (~w)'-[Reason] ].
command(ended(Reason), Port, since) -->
    !,
    [ '~w stands still (~w)'-[Port, Reason] ].
command(Sound, sound, at) -->
    !,
    sound(Sound).
command(Command, Port, Since) -->
    { Command =.. [_, Word, SetPoints] },
    of_any(Word, SetPoints, Port, Since).

sound(tones(Tones)) -->
    [ 'the brick played'-[] ],
    tones(Tones).
sound(say(Text)) -->
    [ 'the brick said ~w'-[Text] ].
sound(play(File)) -->
    [ 'the brick played ~w'-[File] ].
sound(stop) -->
    [ 'the brick was silenced'-[] ].

tones([]) -->
    [].
tones([tone(Hertz, _)|Tones]) -->
    [ ' ~d Hz'-[Hertz] ],
    tones(Tones).

of_any(stop, SetPoints, Port, at) -->
    !,
    those(Port),
    [ ' stopped'-[] ],
    (   { memberchk(stop_action(Action), SetPoints) }
    ->  [ ' (~w)'-[Action] ]
    ;   []
    ).
of_any(reset, _, Port, at) -->
    !,
    those(Port),
    [ ' reset'-[] ].
of_any(_, SetPoints, Port, since) -->
    [ '~w gets'-[Port] ],
    duty(SetPoints).

those([Port|Ports]) -->
    !,
    [ '~w'-[Port] ],
    and(Ports),
    [ ' were'-[] ].
those(Port) -->
    [ '~w was'-[Port] ].

and([Port]) -->
    !,
    [ ' and ~w'-[Port] ].
and([Port|Ports]) -->
    [ ', ~w'-[Port] ],
    and(Ports).

speed(SetPoints, Port) -->
    (   { memberchk(speed_sp(Speed), SetPoints) }
    ->  (   { motor_counts_(Port, max_speed, Max) }
        ->  { Percent is round(100 * Speed / Max) },
            [ ' at ~d %'-[Percent] ]
        ;   [ ' at ~d counts/s'-[Speed] ]
        )
    ;   []
    ).

duty(SetPoints) -->
    (   { memberchk(duty_cycle_sp(Percent), SetPoints) }
    ->  [ ' ~d % of the voltage'-[Percent] ]
    ;   [ ' voltage'-[] ]
    ).

time(SetPoints) -->
    (   { memberchk(time_sp(Milliseconds), SetPoints) }
    ->  { Seconds is Milliseconds / 1000.0 },
        [ ' for ~w s'-[Seconds] ]
    ;   []
    ).

angle(SetPoints, Port) -->
    (   { memberchk(position_sp(Position), SetPoints) }
    ->  (   { motor_counts_(Port, count_per_rot, Counts) }
        ->  { Degrees is round(Position * 360 / Counts) },
            [ '~d degrees'-[Degrees] ]
        ;   [ '~d counts'-[Position] ]
        )
    ;   [ 'a position'-[] ]
    ).

% ---------------- COURSES

course(legs(Legs, Backwards), options(Percent, _, _, _)) -->
    legs(Legs),
    (   { Backwards == true }
    ->  [ ' backwards'-[] ]
    ;   []
    ),
    { number_text(Percent, Text) },
    [ ' at ~w %'-[Text] ].
course(wheels(Left, Right), options(Percent, _, _, _)) -->
    { L is round(Left * Percent),
      R is round(Right * Percent)
    },
    [ 'runs its wheels at ~d % and ~d %'-[L, R] ].
course(cruise(Speed, Turn), _) -->
    cruise(Speed, Turn).
course(change(Speed, Turn), _) -->
    cruise(Speed, Turn).

cruise(Speed0, Turn0) -->
    { number_text(Speed0, Speed),
      number_text(Turn0, Turn)
    },
    [ 'goes at ~w cm/s and turns by ~w degrees/s'-[Speed, Turn] ].

legs([]) -->
    [ 'goes nowhere'-[] ].
%   To turn there is a part of the way.
legs([towards(_, _), To|Legs]) -->
    { functor(To, Name, _),
      memberchk(Name, [to, reach])
    },
    !,
    legs([To|Legs]).
legs([Leg]) -->
    !,
    leg(Leg).
legs([Leg|Legs]) -->
    leg(Leg),
    [ ', '-[] ],
    legs(Legs).

leg(arc(Length0, Curvature)) -->
    !,
    { number_text(Length0, Length) },
    (   { Curvature =:= 0 }
    ->  [ 'goes ~w cm'-[Length] ]
    ;   { Radius0 is 1 / Curvature,
          number_text(Radius0, Radius)
        },
        [ 'goes ~w cm on an arc with radius ~w cm'-[Length, Radius] ]
    ).
leg(turn(Degrees0)) -->
    !,
    { number_text(Degrees0, Degrees) },
    [ 'turns by ~w degrees'-[Degrees] ].
leg(through(Places, _)) -->
    !,
    { length(Places, Count) },
    [ 'goes through ~d places'-[Count] ].
leg(towards(X, Y)) -->
    !,
    at_place('turns towards', X, Y).
leg(to(X, Y)) -->
    !,
    at_place('goes to', X, Y).
leg(reach(X, Y)) -->
    !,
    at_place('goes to', X, Y).
leg(Face) -->
    { Face =.. [_, Heading0],
      Wrapped is Heading0 - 360*round(Heading0/360),
      number_text(Wrapped, Heading)
    },
    [ 'turns to heading ~w'-[Heading] ].

at_place(Verb, X0, Y0) -->
    { number_text(X0, X),
      number_text(Y0, Y)
    },
    [ '~w (~w, ~w)'-[Verb, X, Y] ].

%   At most two decimals.

number_text(Number, Text) :-
    Rounded is round(Number * 100) / 100.0,
    Whole is integer(Rounded),
    (   Rounded =:= Whole
    ->  Text = Whole
    ;   Text = Rounded
    ).

% ---------------- CAUSES

reasons(Causes) -->
    (   { append(Before, [called(Called)], Causes) }
    ->  (   { Called == ev3dev_watchdog/0 }
        ->  [ ': the program computed for too long'-[] ]
        ;   { Before == [] }
        ->  [ ': ~w was called'-[Called] ]
        ;   [ ': '-[] ],
            causes(Before)
        )
    ;   { Causes == [] }
    ->  []
    ;   [ ': '-[] ],
        causes(Causes)
    ).

causes([Cause]) -->
    !,
    cause(Cause).
causes([Cause|Causes]) -->
    cause(Cause),
    [ '; '-[] ],
    causes(Causes).

%!  cause_words(+Cause)// is det.
%
%   A cause in words, or what begins, as a follower of causes.pl hears it.

cause_words(Cause0) -->
    { without_names(Cause0, Cause) },
    cause(Cause).

cause(rule(Name, Guard)) -->
    !,
    [ 'rule ~p'-[Name] ],
    condition_after(Guard).
cause(rules(none)) -->
    !,
    [ 'no rule applies'-[] ].
cause(rules(ended)) -->
    !,
    [ 'the rules have ended'-[] ].
cause(event(Id, Condition)) -->
    !,
    [ 'event ~p'-[Id] ],
    condition_after(Condition).
cause(golog(Step, Action, Condition)) -->
    !,
    [ 'golog: step ~w, ~p'-[Step, Action] ],
    (   { Condition == true }
    ->  []
    ;   [ ': poss ~p'-[Condition] ]
    ).
cause(golog(ended(Reason))) -->
    !,
    [ 'golog: the run ended: ~p'-[Reason] ].
cause(golog(Event)) -->
    !,
    [ 'golog: '-[] ],
    history(Event).
cause(proc(Proc, Place)) -->
    !,
    [ 'proc ~q'-[Proc] ],
    (   { Place = File:Line }
    ->  { file_base_name(File, Base) },
        [ ', ~w:~d'-[Base, Line] ]
    ;   []
    ).
cause(interrupt(Condition)) -->
    !,
    [ 'interrupt ~p'-[Condition] ].
cause(plan(Step, Cell)) -->
    !,
    [ 'the plan says ~w, cell ~p'-[Step, Cell] ].
cause(leg(Part)) -->
    !,
    [ 'on the way: ~p'-[Part] ].
cause(course(Course, Options)) -->
    !,
    { phrase(course(Course, Options), Words),
      infinitives(Words, Verbs)
    },
    [ 'move "'-[] ],
    all_of(Verbs),
    [ '"'-[] ].
cause(layers(ended)) -->
    !,
    [ 'the layers have ended'-[] ].
cause(layers(Steps)) -->
    !,
    steps(Steps).
cause(replay(File)) -->
    !,
    [ 'replay of ~w'-[File] ].
cause(Cause) -->
    [ '~p'-[Cause] ].

steps([]) -->
    [].
steps([Step]) -->
    !,
    step_words(Step).
steps([Step|Steps]) -->
    step_words(Step),
    [ '; '-[] ],
    steps(Steps).

%!  step_words(+Step)// is det.
%
%   A Step of the proof by which library(ev3dev/layers) has set a motor:
%   by(Head, Layer, Place) or sense(Sense, Value).

step_words(by(Head0, Layer, Place)) -->
    { all_rounded(Head0, Head) },
    [ '~p, layer ~w'-[Head, Layer] ],
    (   { Place = File:Line }
    ->  { file_base_name(File, Base) },
        [ ' (~w:~d)'-[Base, Line] ]
    ;   []
    ).
step_words(sense(Sense, Value0)) -->
    { all_rounded(Value0, Value) },
    [ '~p is ~p'-[Sense, Value] ].

all_rounded(Term0, Term) :-
    (   float(Term0)
    ->  number_text(Term0, Term)
    ;   compound(Term0)
    ->  compound_name_arguments(Term0, Name, Arguments0),
        each_rounded(Arguments0, Arguments),
        compound_name_arguments(Term, Name, Arguments)
    ;   Term = Term0
    ).

each_rounded([], []).
each_rounded([Term0|Terms0], [Term|Terms]) :-
    all_rounded(Term0, Term),
    each_rounded(Terms0, Terms).

all_of([]) -->
    [].
all_of([Part|Parts]) -->
    [ Part ],
    all_of(Parts).

%   A course says what the robot does: `goes 20 cm`. A move is `go 20 cm`.

infinitives([], []).
infinitives([Format-Arguments|Parts0], ['~w'-[Said]|Parts]) :-
    format(atom(Said0), Format, Arguments),
    atomic_list_concat(Words0, ' ', Said0),
    infinitive(Words0, Words),
    atomic_list_concat(Words, ' ', Said),
    infinitives(Parts0, Parts).

infinitive([], []).
infinitive([Verb0|Words0], [Verb|Words]) :-
    (   verb(Verb0, Verb)
    ->  true
    ;   Verb = Verb0
    ),
    infinitive(Words0, Words).

verb(goes, go).
verb(turns, turn).
verb(runs, run).

%   What library(ev3dev/golog) adds to its history.

history(action(Action)) -->
    !,
    [ '~p'-[Action] ].
history(exog(Action)) -->
    !,
    [ '~p happened'-[Action] ].
history(sensed(Action, Value)) -->
    !,
    [ '~p sensed ~p'-[Action, Value] ].
history(Event) -->
    [ '~p'-[Event] ].

condition_after(Condition) -->
    (   { Condition == true }
    ->  []
    ;   [ ', '-[] ],
        condition(Condition)
    ).

%   A reading and the comparison of its value are said as one.

condition(_:Condition) -->
    !,
    condition(Condition).
condition((A0, B)) -->
    !,
    { plain(A0, A),
      first_of(B, Test0, Rest),
      plain(Test0, Test)
    },
    (   { comparison(Test, Value, Operator, Right),
          reading(A, Name, Value)
        }
    ->  [ '~w ~p ~w ~p'-[Name, Value, Operator, Right] ],
        (   { Rest == true }
        ->  []
        ;   [ ', '-[] ],
            condition(Rest)
        )
    ;   condition(A),
        [ ', '-[] ],
        condition(B)
    ).
condition((A ; B)) -->
    !,
    condition(A),
    [ ' or '-[] ],
    condition(B).
condition(\+ A) -->
    !,
    [ 'not '-[] ],
    condition(A).
condition(Goal) -->
    (   { comparison(Goal, Left, Operator, Right) }
    ->  [ '~p ~w ~p'-[Left, Operator, Right] ]
    ;   { Goal \= '$VAR'(_),
          callable(Goal),
          Goal =.. [Name|Arguments0],
          Arguments0 \== []
        }
    ->  { bound(Arguments0, Arguments) },
        [ '~w'-[Name] ],
        arguments(Arguments)
    ;   [ '~p'-[Goal] ]
    ).

first_of((A, B), A, B) :-
    !.
first_of(A, A, true).

plain(Goal0, Goal) :-
    (   Goal0 = _:Goal1
    ->  Goal = Goal1
    ;   Goal = Goal0
    ).

reading(Goal, Name, Value) :-
    callable(Goal),
    number(Value),
    Goal =.. [Name|Arguments],
    append(_, [Read|_], Arguments),
    Read == Value,
    !.

comparison(Goal, Left, Operator, Right) :-
    callable(Goal),
    Goal =.. [Operator, Left, Right],
    memberchk(Operator, [<, >, =<, >=, =:=, =\=, ==, \==, =, \=]).

bound([], []).
bound([Argument|Arguments0], Arguments) :-
    (   Argument == '$VAR'('_')
    ->  Arguments = Arguments1
    ;   Arguments = [Argument|Arguments1]
    ),
    bound(Arguments0, Arguments1).

arguments([]) -->
    [].
arguments([Argument|Arguments]) -->
    [ ' ~p'-[Argument] ],
    arguments(Arguments).
