:- module(ev3dev_view_worlds,
          [ world_line/3,               % +Word, +Rest, -Answer
            worlds_settings/1           % +Address
          ]).
:- use_module(library(lists), [member/2, nth1/3]).
:- use_module(library(pairs), [pairs_keys/2]).
:- use_module('../checks/arguments', [option/3, take_options/4]).
:- use_module('../simulation/random_seed', [end_chance/0]).
:- use_module('../files/facts',
              [facts_of_text/3, located_facts/3, shipped/2]).
:- use_module('../native/native',
              [sim_fault_/3, view_facts_/1, view_source_/1]).
:- use_module('../simulation/world_name',
              [name_world/1, noted_world/2, world_name/1]).
:- use_module(controls, [name_of/2]).
:- use_module(log, [error_text/2]).
:- use_module(program, [end_program/1, in_main/1]).
:- use_module(source, [program_directory/1]).

/** <module> Worlds that a page begins

To begin a world is to start the simulation again, in place of the running
one, after the program was stopped as by STOP. A page names a world or a robot
that there is, or sends one as the text of a file of facts, which is read and
never run.
*/

:- dynamic writes/1.                    % Boolean

writes(false).

%   How long, in seconds, the program may take to end.
patience(3).

%   How many files beside the program are looked into, and how long they may
%   be, in bytes.
most_files(200).
longest_file(200000).

%!  worlds_settings(+Address) is det.
%
%   Pages of this computer may write worlds into files.

worlds_settings(Address) :-
    (   Address == localhost
    ->  Writes = true
    ;   Writes = false
    ),
    retractall(writes(_)),
    assertz(writes(Writes)).

%!  world_line(+Word, +Rest, -Answer) is semidet.
%
%   Do what a line of the page says. Answer is done(More), refused(Why) or
%   refused(Why, More), More being pairs Name=Value. Fails if that is not a
%   line.

world_line(Word, Rest, Answer) :-
    request(Word, Rest, Request),
    (   catch(answer(Request, Answer0), error(Formal, Context), true)
    ->  (   var(Formal)
        ->  Answer = Answer0
        ;   why(Formal, Context, Answer)
        )
    ;   Answer = refused("The program does not end. Try again when it has.")
    ).

%   The line of a text is apart, as a page shows it or not.
why(Formal, fact(file(text, Line, _, _), Why), refused(Text, [line=Line])) :-
    !,
    error_text(error(Formal, context(_, Why)), Text0),
    (   Formal = domain_error(world_fact, Fact)
    ->  format(string(Text), "~q is no fact of a world; ~w", [Fact, Text0])
    ;   Text = Text0
    ).
why(syntax_error(What), stream(_, Line, _, _), refused(Text, [line=Line])) :-
    !,
    error_text(error(syntax_error(What), _), Text).
why(Formal, Context, refused(Text)) :-
    error_text(error(Formal, Context), Text).

request(reset, "", reset).
request(facts, "", facts).
request(worlds, "", worlds).
request(choose, Rest, choose(Kind, From, Name)) :-
    word_rest(Rest, Kind, Rest1),
    memberchk(Kind, [world, robot]),
    word_rest(Rest1, From, Name0),
    memberchk(From, [pack, file]),
    atom_string(Name, Name0).
request(check, Text, check(Text)).
request(Word, Rest, Request) :-
    memberchk(Word, [begin, write, rewrite]),
    word_rest(Rest, Name0, Text),
    atom_string(Name0, Name1),
    name_of(Name1, Name),
    Request =.. [Word, Name, Text].

word_rest(Text, Word, Rest) :-
    sub_string(Text, Before, 1, After, " "),
    !,
    sub_atom(Text, 0, Before, _, Word),
    sub_string(Text, _, After, 0, Rest).

answer(Request, Answer) :-
    (   needs(Request, Sources),
        view_source_(Source),
        \+ memberchk(Source, Sources)
    ->  (   Source == brick
        ->  Answer = refused("A real robot is in use.")
        ;   Answer = refused("No simulation runs.")
        )
    ;   do(Request, Answer)
    ).

needs(facts, [sim]).
needs(reset, [sim]).
needs(choose(_, _, _), [sim, none]).
needs(begin(_, _), [sim, none]).

do(facts, done([text=Text])) :-
    view_facts_(Text).
do(reset, done([])) :-
    noted(World, Options),
    (   world_name(Name)
    ->  true
    ;   Name = none
    ),
    begin(World, Options, Name).
do(choose(Kind, From, Name), Answer) :-
    (   choice(Kind, From, Name, Source)
    ->  noted(World, Options),
        (   Kind == world
        ->  begin(Source, Options, none)
        ;   take_options([robot], Options, _, Others),
            (   world_name(Called)
            ->  true
            ;   Called = none
            ),
            begin(World, [robot(Source)|Others], Called)
        ),
        Answer = done([])
    ;   format(string(Why), "There is no ~w ~w.", [Kind, Name]),
        Answer = refused(Why)
    ).
do(worlds, done([ worlds=Worlds, robots=Robots, robot=Robot,
                  directory=Directory, writes=Writes ])) :-
    choices(world, Worlds),
    choices(robot, Robots),
    noted(_, Options),
    option(robot(Robot0), Options, default),
    (   is_list(Robot0)
    ->  Robot = null
    ;   file_base_name(Robot0, Base),
        file_name_extension(Robot1, _, Base),
        atom_string(Robot1, Robot)
    ),
    program_directory(Directory0),
    atom_string(Directory0, Directory),
    writes(Writes).
do(check(Text), done([])) :-
    checked(Text, _).
do(begin(Name, Text), done([])) :-
    checked(Text, Facts),
    noted(_, Options),
    begin(Facts, Options, Name).
do(write(Name, Text), Answer) :-
    world_file(Name, File, Base),
    (   exists_file(File)
    ->  format(string(Why),
               "There is a file ~w already. Its comments would be lost.",
               [Base]),
        Answer = refused(Why, [exists=true])
    ;   write_world(File, Text, Answer)
    ).
do(rewrite(Name, Text), Answer) :-
    world_file(Name, File, Base),
    (   exists_file(File),
        \+ is_file_of(world, File)
    ->  format(string(Why), "~w is no world, and stays as it is.", [Base]),
        Answer = refused(Why)
    ;   write_world(File, Text, Answer)
    ).

noted(World, Options) :-
    noted_world(World, Options),
    !.
noted(room, []).

%   What is impossible is found before anything ends.
begin(World, Options, Name) :-
    use_module(library(ev3dev/sim), []),
    option(robot(Robot), Options, default),
    located_facts(world, World, Located),
    possible(Located, Robot),
    patience(Seconds),
    end_program(Seconds),
    ev3dev_sim:sim_start(World, Options),
    % The numbers of the seed are for the program, not for this thread.
    end_chance,
    in_main(ev3dev_random_seed:begin_chance_of(Options)),
    (   Name == none
    ->  true
    ;   name_world(Name)
    ).

checked(Text, Facts) :-
    facts_of_text(world, Text, Located),
    noted(_, Options),
    option(robot(Robot), Options, default),
    possible(Located, Robot),
    pairs_keys(Located, Facts).

%   The robot can stand at the start of the world.
possible(Located, Robot) :-
    located_facts(robot, Robot, LocatedRobot),
    pairs_keys(Located, World),
    pairs_keys(LocatedRobot, Parts),
    sim_fault_(World, Parts, Fault),
    (   Fault = fault(Kind, Index, Why)
    ->  (   memberchk(Kind-List, [world-Located, robot-LocatedRobot]),
            nth1(Index, List, Fact-Location)
        ->  true
        ;   Fact = Kind,
            Location = none
        ),
        throw(error(domain_error(possible_world, Fact),
                    fact(Location, Why)))
    ;   true
    ).

% ---------------- CHOICES

choices(Kind, Choices) :-
    findall(json([name=Text, from=FromText]),
            ( choice(Kind, From, Name, _),
              atom_string(Name, Text),
              atom_string(From, FromText) ),
            Choices).

%   choice(+Kind, ?From, ?Name, -Source): a world or robot of the pack, or a
%   file beside the program.
choice(Kind, pack, Name, Name) :-
    findall(Shipped, shipped(Kind, Shipped), Names0),
    msort(Names0, Names),
    member(Name, Names).
choice(Kind, file, Name, File) :-
    program_directory(Directory),
    catch(directory_files(Directory, Files0), error(_, _), fail),
    findall(File0, ( member(File0, Files0),
                     file_name_extension(_, pl, File0) ), Files1),
    msort(Files1, Files),
    most_files(Most),
    nth1(Index, Files, Name),
    (   Index > Most
    ->  !,
        fail
    ;   true
    ),
    atomic_list_concat([Directory, /, Name], File),
    is_file_of(Kind, File).

%   Reading ends at the first clause of a program.
is_file_of(Kind, File) :-
    catch(( longest_file(Longest),
            size_file(File, Size),
            Size =< Longest,
            located_facts(Kind, File, [_|_]) ),
          error(_, _), fail).

% ---------------- FILES

world_file(Name, File, Base) :-
    program_directory(Directory),
    atom_concat(Name, '.pl', Base),
    atomic_list_concat([Directory, /, Base], File).

write_world(File, Text, Answer) :-
    (   writes(true)
    ->  facts_of_text(world, Text, _),
        atom_concat(File, '.new', New),
        setup_call_cleanup(
            open(New, write, Out, [encoding(utf8)]),
            write(Out, Text),
            close(Out)),
        rename_file(New, File),
        atom_string(File, Path),
        Answer = done([file=Path])
    ;   Answer = refused("Only pages of this computer save there.")
    ).
