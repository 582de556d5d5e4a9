% Draws the pictures of docs/first-afternoon.md and of worlds, and films of examples for the
% gallery; run by `make pictures`:
%
%   swipl -g main -t 'halt(1)' tools/films.pl
%
% What the paper's queries do is what its pictures show: they are called in their order, with
% the paper's programs, and where a picture stands the world is drawn.

:- asserta(user:file_search_path(library, prolog)).
:- use_module(library(ev3dev)).
:- use_module(library(ev3dev/sim)).
:- use_module(library(ev3dev/drive)).
:- use_module(library(ev3dev/private/marking/record)).
:- use_module(library(apply)).
:- use_module(library(lists)).
:- use_module(library(readutil)).

% film(Example, Goal, World, Robot, Seconds)
film(square,             start, [bounds(-130, -40, 140, 140), start(0, 0, 0)],
     default, 80).
film(obstacle_avoidance, start, room, default, 40).
film(rules_wander,       start, room, default, 40).
film(line_following,     start, line, default, 45).
film(braitenberg,        vehicle(aggression), lights, default, 25).
film(slalom,             start, [bounds(-40, -60, 260, 100), start(0, 0, 90)],
     default, 30).
film(grid_navigation,    start, grid, default, 45).
film(golog_rescue,
     ( sim_add(patch(red, [48-28, 72-28, 72-52, 48-52])), start ), grid,
     default, 60).
film(room_navigation,    start, room, default, 40).
film(explore_room,       start, room, default, 90).
film(rules_sumo,         start, sumo, default, 25).
film(clear_the_ring,     start, cans, default, 110).
film(sort_parcels,       start, parcels, carrier, 130).
film(goal,               start, soccer, carrier, 60).

main :-
    paper('docs/first-afternoon.md'),
    expand_file_name('prolog/ev3dev/worlds/*.pl', Worlds),
    forall(member(World, Worlds), world(World)),
    forall(film(Example, Goal, World, Robot, Seconds),
           (   catch(film_of(Example, Goal, World, Robot, Seconds), E,
                     ( print_message(error, E), fail ))
           ->  true
           ;   format(user_error, "no film of ~w~n", [Example])
           )),
    halt(0).

% ---------------- PAPER

paper(File) :-
    read_file_to_string(File, Text, [encoding(utf8)]),
    split_string(Text, "\n", "", Lines),
    sim_stop_if_any,
    blocks(Lines, text, "", Parts),
    atom_concat(paper_, first, Module),
    tmp_file(paper, Base),
    atom_concat(Base, '.pl', Program),
    findall(Code, member(code(Code), Parts), Codes),
    setup_call_cleanup(open(Program, write, Out),
                       maplist(write(Out), Codes),
                       close(Out)),
    style_check(-discontiguous),
    load_files(Module:Program, [silent(true)]),
    delete_file(Program),
    maplist(done(Module), Parts).

sim_stop_if_any :-
    ignore(sim_stop).

blocks([], _, _, []).
blocks(["```prolog"|Lines], text, _, Parts) :-
    !,
    blocks(Lines, code, "", Parts).
blocks(["```"|Lines], code, Block, [Part|Parts]) :-
    !,
    (   string_concat("?- ", _, Block)
    ->  Part = queries(Block)
    ;   Part = code(Block)
    ),
    blocks(Lines, text, "", Parts).
blocks([Line|Lines], code, Block, Parts) :-
    !,
    string_concat(Block, Line, Block1),
    string_concat(Block1, "\n", Block2),
    blocks(Lines, code, Block2, Parts).
blocks([Line|Lines], text, Block, [picture(Name)|Parts]) :-
    sub_string(Line, Before, _, _, "](pictures/afternoon-"),
    !,
    Start is Before+2,
    sub_string(Line, Start, _, 1, Name),
    blocks(Lines, text, Block, Parts).
blocks([_|Lines], text, Block, Parts) :-
    blocks(Lines, text, Block, Parts).

done(_, code(_)).
done(_, picture(Name)) :-
    string_concat("docs/", Name, File),
    sim_svg(File).
done(Module, queries(Block)) :-
    split_string(Block, "\n", "", Lines),
    forall(( member(Line, Lines), string_concat("?- ", Query, Line) ),
           asked(Module, Query)).

%   Those that go wrong in the paper do so here.

asked(Module, Query) :-
    term_string(Goal, Query, [module(Module)]),
    setup_call_cleanup(
        asserta((user:message_hook(_, _, _) :- !), Clause),
        with_output_to(string(_), ignore(catch(Module:Goal, _, true))),
        erase(Clause)).

:- dynamic user:message_hook/3.
:- multifile user:message_hook/3.

world(Path) :-
    file_base_name(Path, Base),
    file_name_extension(Name, _, Base),
    format(atom(Picture), 'docs/pictures/world_~w.svg', [Name]),
    with_sim(Name, sim_svg(Picture), [clock(virtual)]).

% ---------------- FILMS

%   The path stays; the robot moves along it, ten times as fast as it did, and
%   so do the things that it pushes or carries.

film_of(Example, Goal, World, Robot, Seconds) :-
    format("~w~n", [Example]),
    atomic_list_concat(['examples/', Example, '.pl'], Source),
    load_files(Example:Source, [silent(true)]),
    ( module_property(Own, file(Path)), atom_concat(_, Source, Path) -> true ; Own = Example ),
    atomic_list_concat(['docs/pictures/film-', Example, '.svg'], File),
    tmp_file(film, Svg),
    with_sim(World,
             ( ev3dev_marking_record:with_record(
                   user:ignore(for_seconds(Seconds, Own:Goal)), 1, World, Robot),
               ev3dev_marking_record:record_end(over, "", []),
               sim_svg(Svg), sim_things(Things) ),
             [clock(virtual), seed(1), robot(Robot)]),
    read_file_to_string(Svg, Text, [encoding(utf8)]),
    recorded(Film0, Ways, _, Took),
    thinned(Film0, Places, Film),
    Duration is Took/10,
    once(sub_string(Text, Begin, _, _, "<g class=\"robot\"")),
    sub_string(Text, 0, Begin, _, Head0),
    sub_string(Text, Begin, _, 0, Robot0),
    sub_string(Robot0, Close, 1, _, ">"),
    !,
    After is Close+1,
    sub_string(Robot0, After, _, 0, Inside),
    half_size(Head0, Head),
    findall(Way,
            ( member(thing(Name, _, _, _), Things), memberchk(Name-Way, Ways) ),
            Its),
    setup_call_cleanup(
        open(File, write, Out, [encoding(utf8)]),
        ( split_string(Head, "\n", "", Lines),
          moving_things(Lines, Its, Places-Duration, Out),
          format(Out, "<g class=\"robot\">~n", []),
          animation(Out, translate, Film, Duration),
          animation(Out, rotate, Film, Duration),
          write(Out, Inside) ),
        close(Out)).

%   A thing is an element of one line; those that rest stay as they are.

moving_things([Last], _, _, Out) :-
    !,
    write(Out, Last).
moving_things([Line|Lines], Things, Places-Duration, Out) :-
    (   sub_string(Line, _, _, _, "class=\"thing\""),
        Things = [Way|Things1]
    ->  (   Way = [_, _|_]
        ->  moving_thing(Line, Way, Places, Duration, Out)
        ;   format(Out, "~s~n", [Line])
        )
    ;   Things1 = Things,
        format(Out, "~s~n", [Line])
    ),
    moving_things(Lines, Things1, Places-Duration, Out).

moving_thing(Line, Way, Places, Duration, Out) :-
    once(sub_string(Line, Before, _, _, " transform=")),
    sub_string(Line, 0, Before, _, Shape),
    split_string(Shape, " ", "<", [Element|_]),
    findall(Pose, ( member(Place, Places), there(Way, Place, Pose) ), Film),
    format(Out, "~s>~n", [Shape]),
    animation(Out, translate, Film, Duration),
    animation(Out, rotate, Film, Duration),
    format(Out, "</~s>~n", [Element]).

there(Way, Place, Pose) :-
    findall(Its, ( member([At|Its], Way), At =< Place ), Poses),
    last(Poses, Pose).

animation(Out, Type, Film, Duration) :-
    findall(Value, ( member(Pose, Film), moved(Type, Pose, Value) ), Values),
    atomic_list_concat(Values, ;, Text),
    format(Out, "<animateTransform attributeName=\"transform\" type=\"~w\" \c
                 additive=\"sum\" dur=\"~2fs\" repeatCount=\"indefinite\" \c
                 values=\"~w\"/>~n", [Type, Duration, Text]).

moved(translate, [X, Y, _], Value) :-
    CmX is X/10,
    CmY is Y/10,
    format(atom(Value), '~1f,~1f', [CmX, CmY]).
moved(rotate, [_, _, H], Value) :-
    Value is -H.

%   At most 150 poses, and their places in Film.

thinned(Film, Places, Thin) :-
    length(Film, Count),
    Step is max(1, ceiling(Count/150)),
    findall(N-Pose, ( nth0(N, Film, Pose), N mod Step =:= 0 ), Pairs),
    findall(N, member(N-_, Pairs), Places),
    findall(Pose, member(_-Pose, Pairs), Thin).

half_size(Text0, Text) :-
    sub_string(Text0, Before, _, _, " width=\""),
    sub_string(Text0, After, _, _, "\">\n"),
    After > Before,
    !,
    sub_string(Text0, 0, Before, _, Head),
    From is After+1,
    sub_string(Text0, From, _, 0, Tail),
    string_concat(Head, Tail, Text).
