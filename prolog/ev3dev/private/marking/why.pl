:- module(ev3dev_marking_why,
          [ collision_reason/1          % -Text
          ]).
:- use_module(record, [run_collision/1, run_fact/1, run_things/3]).
:- use_module(library(lists), [last/2, member/2, nth0/3]).

/** <module> Why a robot ran into something
*/

%!  collision_reason(-Text) is semidet.
%
%   Of the first collision in the run that is recorded. Fails if there was
%   none.

collision_reason(Text) :-
    run_collision(collision(Time, X, Y, _)),
    !,
    into(X, Y, Time, What),
    format(atom(Text0),
           'At ~1f s it ran into ~w.', [Time, What]),
    (   findall(Rule, ( run_fact(told(Then, Rule)), Then =< Time ), Rules),
        last(Rules, Rule)
    ->  format(atom(Text1), '~w It acted by: ~w.', [Text0, Rule])
    ;   Text1 = Text0
    ),
    findall(Shown,
            ( run_fact(seen(Then, File, Value)),
              seen(Then, File, Value, Time, Shown) ),
            Sensors),
    (   Sensors = [_|_]
    ->  atomic_list_concat(Sensors, '; ', Seen),
        format(atom(Text2), '~w Its sensors: ~w.', [Text1, Seen])
    ;   Text2 = Text1
    ),
    findall(Port, unread(Port), Ports),
    (   Ports = [_|_]
    ->  atomic_list_concat(Ports, ', ', Listed),
        format(atom(Text), '~w The program had not read ~w.',
               [Text2, Listed])
    ;   Text = Text2
    ).

%   A sensor of distances, which could have warned.

unread(Port) :-
    run_fact(robot(Facts)),
    findall(Port0-Type, member(sensor(Port0, Type, _, _, _), Facts),
            Sensors),
    nth0(Index, Sensors, Port-Type),
    memberchk(Type, ['lego-ev3-us', 'lego-nxt-us', 'lego-ev3-ir']),
    format(atom(Device), 'sensor~d/', [Index]),
    \+ ( run_fact(seen(_, File, _)), sub_atom(File, _, _, _, Device) ).

%   The simulator numbers the sensors of a robot in the order of its facts. An
%   ultrasonic sensor shows tenths of a cm, unless it has another mode.

seen(Then, File, Text, Time, Shown) :-
    sub_atom(File, Before, 6, _, sensor),
    sub_atom(File, Before, _, 0, Device),
    atomic_list_concat([Name|_], /, Device),
    atom_concat(sensor, Index0, Name),
    atom_number(Index0, Index),
    run_fact(robot(Facts)),
    findall(Port-Type, member(sensor(Port, Type, _, _, _), Facts), Sensors),
    nth0(Index, Sensors, Port-Type),
    split_string(Text, "", " \n", [Number]),
    (   memberchk(Type, ['lego-ev3-us', 'lego-nxt-us']),
        catch(number_string(Value, Number), _, fail)
    ->  Cm is Value/10,
        format(atom(Showed), '~w showed ~1f cm', [Port, Cm])
    ;   format(atom(Showed), '~w showed ~w', [Port, Number])
    ),
    Ago is Time-Then,
    (   Ago < 0.05
    ->  Shown = Showed
    ;   format(atom(Shown), '~w, ~1f s before', [Showed, Ago])
    ).

%   What is nearest to the middle of the robot, by its outline.

into(X, Y, Time, What) :-
    run_fact(world(Facts)),
    findall(Distance-Words,
            ( stands(Facts, Time, Fact, Name),
              thing(Fact, X-Y, Distance, Words0),
              ( Name == '' -> Words = Words0 ; Words = Name ) ),
            Things),
    keysort(Things, [Nearest-What0|_]),
    Nearest < 40,
    !,
    What = What0.
into(_, _, _, 'a wall').

%   A fact without its options, and the name that these give to it, or ''. A
%   thing that robots push stands where it was at that Time.

stands(Facts, Time, Fact, Name) :-
    findall(Thing, ( member(Thing, Facts), moves(Thing) ), Moving),
    findall(Things, run_things(_, Things, _), Newest),
    ( last(Newest, First) -> true ; First = [] ),
    (   run_things(Then, Now, _),
        Then =< Time
    ->  true
    ;   Now = First
    ),
    (   member(Fact0, Facts),
        \+ moves(Fact0),
        without_options(Fact0, Fact, Options)
    ;   nth0(Index, Moving, Fact0),
        nth0(Index, First, thing(Known, _, _, _)),
        memberchk(thing(Known, X, Y, Heading), Now),
        without_options(Fact0, Fact1, Options),
        placed(Fact1, X, Y, Heading, Fact)
    ),
    ( memberchk(name(Name0), Options) -> Name = Name0 ; Name = '' ).

moves(Fact) :-
    without_options(Fact, _, Options),
    memberchk(mass(_), Options).

without_options(Fact0, Fact, Options) :-
    (   Fact0 = box(X, Y, W, D, Heading, Options)
    ->  Fact = box(X, Y, W, D, Heading)
    ;   Fact0 = circle(X, Y, Radius, Options)
    ->  Fact = circle(X, Y, Radius)
    ;   Fact = Fact0,
        Options = []
    ).

placed(box(_, _, W, D, _), X, Y, Heading, box(X, Y, W, D, Heading)).
placed(circle(_, _, Radius), X, Y, _, circle(X, Y, Radius)).

thing(box(X, Y, W, D), Place, Distance, Words) :-
    thing(box(X, Y, W, D, 0), Place, Distance, Words).
thing(box(X, Y, W, D, Heading), PX-PY, Distance, Words) :-
    Angle is Heading*pi/180,
    Right is (PX-X)*cos(Angle) - (PY-Y)*sin(Angle),
    Ahead is (PX-X)*sin(Angle) + (PY-Y)*cos(Angle),
    DX is max(0, abs(Right) - W/2),
    DY is max(0, abs(Ahead) - D/2),
    Distance is sqrt(DX*DX + DY*DY),
    format(atom(Words), 'the box at ~0f, ~0f', [X, Y]).
thing(circle(X, Y, Radius), PX-PY, Distance, Words) :-
    Distance is sqrt((PX-X)**2 + (PY-Y)**2) - Radius,
    format(atom(Words), 'the pillar at ~0f, ~0f', [X, Y]).
thing(bounds(X1, Y1, X2, Y2), PX-PY, Distance, Words) :-
    member(Distance0-Words,
           [ (PX-X1)-'the wall on the left',
             (X2-PX)-'the wall on the right',
             (PY-Y1)-'the wall at the bottom',
             (Y2-PY)-'the wall at the top' ]),
    Distance is Distance0.
