:- module(ev3dev_facts,
          [ located_facts/3,            % +Kind, +Source, -Located
            fact_location/3,            % +Item, +Located, -Location
            throw_located/3             % +Formal, +Location, +Why
          ]).
:- use_module(errors, [existence_error/2, must_be/2]).
:- use_module(library(lists), [last/2, member/2]).
:- use_module(native, [sim_check_/1]).

/** <module> Files of facts about worlds and robots

The files are read, never run: what stands in them are facts, each checked
as it is read, and nothing else. What is wrong with one is thrown with file
and line.
*/

%!  located_facts(+Kind, +Source, -Located) is det.
%
%   True if Located is the list of Fact-Location that Source, a `world` or a
%   `robot`, consists of. Source is the name of a shipped one, a file, or a
%   list of facts; then Location is `none`.
%
%   @error existence_error(Kind, Source)
%   @error domain_error(world_fact, Fact) if a world has no such facts
%   @error domain_error(robot_fact, Fact) if a robot has no such facts
%   @error domain_error(possible_geometry, Fact)
%   @error syntax_error(What)

located_facts(Kind, Facts, Located) :-
    is_list(Facts),
    !,
    findall(Fact-none, member(Fact, Facts), Located),
    check_all(Located, Kind).
located_facts(Kind, Source, Located) :-
    must_be(nonvar, Source),
    (   shipped(Kind, Source, File)
    ->  true
    ;   absolute_file_name(Source, File,
                           [ extensions([pl, '']), access(read),
                             file_errors(fail)
                           ]),
        exists_file(File)
    ->  true
    ;   existence_error(Kind, Source)
    ),
    setup_call_cleanup(
        open(File, read, Stream, [encoding(utf8)]),
        read_facts(Stream, Kind, File, Located),
        close(Stream)).

shipped(Kind, Name, File) :-
    atomic(Name),
    module_property(ev3dev_facts, file(Here)),
    file_directory_name(Here, Private),
    atomic_list_concat([Private, '/../', Kind, 's/', Name, '.pl'], Path),
    absolute_file_name(Path, File),
    exists_file(File).

read_facts(Stream, Kind, File, Located) :-
    read_term(Stream, Fact,
              [module(ev3dev_facts), term_position(Position)]),
    (   Fact == end_of_file
    ->  Located = []
    ;   location(File, Position, Location),
        check(Kind, Fact, Location),
        Located = [Fact-Location|Rest],
        read_facts(Stream, Kind, File, Rest)
    ).

location(File, Position, file(File, Line, LinePosition, CharCount)) :-
    stream_position_data(line_count, Position, Line),
    stream_position_data(line_position, Position, LinePosition),
    stream_position_data(char_count, Position, CharCount).

check_all([], _).
check_all([Fact-Location|Rest], Kind) :-
    check(Kind, Fact, Location),
    check_all(Rest, Kind).

check(Kind, Fact, Location) :-
    must_be_of_kind(Kind, Fact, Location),
    catch(sim_check_(Fact),
          error(Formal, context(_, Why)),
          throw_located(Formal, Location, Why)).

must_be_of_kind(Kind, Fact, _) :-
    callable(Fact),
    functor(Fact, Name, Arity),
    vocabulary(Kind, Name, Arities),
    memberchk(Arity, Arities),
    !.
must_be_of_kind(Kind, Fact, Location) :-
    findall(Name, vocabulary(Kind, Name, _), Names),
    atomic_list_concat(Names, ', ', Known),
    atomic_list_concat(['a ', Kind, ' has: ', Known], Why),
    atom_concat(Kind, '_fact', Domain),
    throw_located(domain_error(Domain, Fact), Location, Why).

vocabulary(world, bounds,      [4]).
vocabulary(world, wall,        [4, 5]).
vocabulary(world, box,         [4, 5]).
vocabulary(world, circle,      [3]).
vocabulary(world, floor,       [1]).
vocabulary(world, patch,       [2]).
vocabulary(world, line,        [3]).
vocabulary(world, lamp,        [3, 4]).
vocabulary(world, beacon,      [3]).
vocabulary(world, ambient,     [1]).
vocabulary(world, temperature, [1]).
vocabulary(world, loudness,    [1]).
vocabulary(world, start,       [3]).
vocabulary(world, map,         [2]).
vocabulary(robot, left_wheel,  [2, 3]).
vocabulary(robot, right_wheel, [2, 3]).
vocabulary(robot, axle,        [1]).
vocabulary(robot, hull,        [1]).
vocabulary(robot, mass,        [1]).
vocabulary(robot, motor,       [2]).
vocabulary(robot, sensor,      [5]).
vocabulary(robot, noise,       [3]).
vocabulary(robot, encoder_noise, [2]).

%!  fact_location(+Item, +Located, -Location) is det.
%
%   True if Location is that of the fact that the simulator means by Item, as
%   in 'left wheel' or 'motor lego-ev3-l-motor on outB'; `none` if it is not
%   known. Of several the last, which is one too many.

fact_location(Item, Located, Location) :-
    findall(Found,
            ( member(Fact-Found, Located),
              meant(Item, Fact)
            ),
            Locations),
    (   last(Locations, Location)
    ->  true
    ;   Location = none
    ).

meant(Item, Fact) :-
    said_of(Fact, Start),
    sub_atom(Item, 0, _, _, Start).

said_of(motor(Port, Type), Start) :-
    !,
    atomic_list_concat([motor, Type, on, Port], ' ', Start).
said_of(sensor(Port, Type, _, _, _), Start) :-
    !,
    atomic_list_concat([sensor, Type, on, Port], ' ', Start).
said_of(encoder_noise(Port, _), Start) :-
    !,
    atomic_list_concat(['encoder noise on', Port], ' ', Start).
said_of(start(_, _, _), 'robot at ').
said_of(map(_, _), 'robot at ').
said_of(Fact, Start) :-
    functor(Fact, Name, _),
    atomic_list_concat(Words, '_', Name),
    atomic_list_concat(Words, ' ', Start).

%!  throw_located(+Formal, +Location, +Why)
%
%   Throw an error at a place in a file, with the reason.

throw_located(Formal, none, Why) :-
    !,
    throw(error(Formal, context(ev3dev_sim:sim_start/2, Why))).
throw_located(Formal, Location, Why) :-
    throw(error(Formal, fact(Location, Why))).

:- multifile
    prolog:message_location//1,
    prolog:message_context//1.

prolog:message_location(fact(file(File, Line, LinePosition, _), _)) -->
    [ '~w:~d:~d: '-[File, Line, LinePosition] ].

prolog:message_context(fact(_, Why)) -->
    (   { nonvar(Why),
          Why \== ''
        }
    ->  [ ' (~w)'-[Why] ]
    ;   []
    ).
