:- module(ev3dev_facts,
          [ located_facts/3,            % +Kind, +Source, -Located
            facts_of_text/3,            % +Kind, +Text, -Located
            shipped/2,                  % +Kind, -Name
            source_location/3,          % +Kind, +Source, -Location
            throw_located/3             % +Formal, +Location, +Why
          ]).
:- use_module(directory, [readable_file/3]).
:- use_module('../checks/checks', [must_be/2]).
:- use_module('../errors/errors', [in_own_name/1, throw_error/3]).
:- use_module('../errors/error_texts', [item_said/3, shown/2]).
:- use_module(library(lists), [member/2]).
:- use_module('../native/native', [sim_check_/2]).

/** <module> Files of facts about worlds and robots

The files are read, never run. Each fact is checked as it is read; an error
has file and line.
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
    source_file(Kind, Source, File),
    setup_call_cleanup(
        open(File, read, Stream, [encoding(utf8)]),
        read_facts(Stream, Kind, File, Located),
        close(Stream)).

%!  facts_of_text(+Kind, +Text, -Located) is det.
%
%   The same for what would stand in a file.

facts_of_text(Kind, Text, Located) :-
    setup_call_cleanup(
        open_string(Text, Stream),
        read_facts(Stream, Kind, text, Located),
        close(Stream)).

%!  source_location(+Kind, +Source, -Location) is det.
%
%   True if Location is that of a whole Source: `file(File)`, or `none` for a
%   list of facts.

source_location(_, Facts, none) :-
    is_list(Facts),
    !.
source_location(Kind, Source, file(File)) :-
    source_file(Kind, Source, File).

source_file(Kind, Source, File) :-
    must_be(nonvar, Source),
    (   in_own_name(found(Kind, Source, File))
    ->  true
    ;   findall(Name, shipped(Kind, Name), Names),
        atomic_list_concat(Names, ', ', Listed),
        shown(Source, Shown),
        format(atom(Text), 'there is no ~w ~w; there are: ~w, or a file',
               [Kind, Shown, Listed]),
        throw_error(existence_error(Kind, Source), _, Text)
    ).

found(Kind, Source, File) :-
    shipped(Kind, Source, File),
    !.
found(_, Source, File) :-
    readable_file(Source, pl, File).

shipped(Kind, Name, File) :-
    atomic(Name),
    shipped_path(Kind, Name, Path),
    absolute_file_name(Path, File),
    exists_file(File).

%!  shipped(+Kind, -Name) is nondet.
%
%   The pack has a `world` or a `robot` called Name.

shipped(Kind, Name) :-
    shipped_path(Kind, *, Pattern),
    expand_file_name(Pattern, Files),
    member(File, Files),
    file_base_name(File, Base),
    file_name_extension(Name, _, Base).

shipped_path(Kind, Name, Path) :-
    module_property(ev3dev_facts, file(Here)),
    file_directory_name(Here, Room),
    file_directory_name(Room, Private),
    file_directory_name(Private, Ev3dev),
    atomic_list_concat([Ev3dev, /, Kind, 's/', Name, '.pl'], Path).

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
    catch(sim_check_(Kind, Fact),
          error(Formal, context(_, Why)),
          throw_located(Formal, Location, Why)).

%!  throw_located(+Formal, +Location, +Why)
%
%   Throw an error at a place in a file, with the reason.

throw_located(Formal, none, Why) :-
    !,
    throw_error(Formal, sim_start/2, Why).
throw_located(Formal, Location, Why) :-
    throw(error(Formal, fact(Location, Why))).

:- multifile
    prolog:message//1,
    prolog:message_location//1.

prolog:message(error(Formal, Context)) -->
    { nonvar(Formal),
      nonvar(Context),
      Context = fact(Location, Why),
      (   Formal = domain_error(Domain, Fact),
          memberchk(Domain, [possible_geometry, world_fact, robot_fact])
      ->  item_said(Fact, Why, Said)
      ;   Said = Why
      )
    },
    prolog:message_location(fact(Location, Why)),
    [ '~w'-[Said] ].

prolog:message_location(fact(file(File, Line, LinePosition, _), _)) -->
    [ '~w:~d:~d: '-[File, Line, LinePosition] ].
prolog:message_location(fact(file(File), _)) -->
    [ '~w: '-[File] ].
