% Prints the examples that run in a page, and the skeletons of the course, as JSON: a list of
% objects with group, name, about, which is the first sentence of the file, text, and lines of
% docs/view-protocol.md that begin its world; of an exercise also its task, as Markdown.
%
%   swipl -p library=prolog playground/examples.pl EXAMPLE...

:- use_module(library(http/json)).
:- use_module(library(lists), [select/4]).
:- use_module(library(main)).
:- use_module(library(occurs), [sub_term/2]).
:- use_module(library(ev3dev/private/marking/read)).
:- load_files(demo_script:'../tools/demo.pl', []).

:- initialization(main, main).

main(Names) :-
    findall(Json,
            (   member(Name, Names),
                example(Name, Json)
            ;   skeleton(Json)
            ),
            Examples),
    json_write(current_output, Examples, [width(0)]),
    nl.

example(Name, Json) :-
    format(atom(File), "examples/~w.pl", [Name]),
    (   demo_script:demo(Name, World, _) -> true ; World = room ),
    (   demo_script:robot(Name, Robot) -> true ; Robot = default ),
    entry('Examples', Name, File, World, Robot, json(Members0)),
    (   keys(Name, Keys)
    ->  select(about=About0, Members0, about=About, Members),
        format(string(About), "~w It waits for keys of the brick: ~w.", [About0, Keys])
    ;   Members = Members0
    ),
    Json = json(Members).

%   Those that somebody has to press.
keys(Name, Text) :-
    clause(demo_script:prepare(Name), Body),
    findall(Key, ( sub_term(sim_press(Key, _), Body), atom(Key) ), Keys0),
    sort(Keys0, Keys),
    Keys \== [],
    atomic_list_concat(Keys, ', ', Text).

%   An exercise begins in the world of its first seed.
skeleton(Json) :-
    expand_file_name('course/*/exercise.pl', Files),
    member(File, Files),
    file_directory_name(File, Folder),
    file_base_name(Folder, Name),
    atom_concat(Folder, '/skeleton.pl', Skeleton),
    absolute_file_name(File, Path),
    read_exercise(Path, Exercise),
    exercise_seeds(Exercise, open, [Seed|_]),
    exercise_world(Exercise, Seed, World),
    exercise_setting(Exercise, robot(Robot), default),
    entry('Course', Name, Skeleton, World, Robot, json(Members)),
    atom_concat(Folder, '/task.md', Task),
    read_file_to_string(Task, Text, [encoding(utf8)]),
    Json = json([task=Text|Members]).

entry(Group, Name, File, World, Robot,
      json([group=Group, name=Name, about=About, text=Text, lines=[RobotLine, WorldLine]])) :-
    read_file_to_string(File, Text, [encoding(utf8)]),
    about(Text, About),
    format(string(RobotLine), "choose robot pack ~w", [Robot]),
    world_line(World, WorldLine).

world_line(World, Line) :-
    is_list(World),
    !,
    with_output_to(string(Facts),
                   forall(member(Fact, World), format("~q.~n", [Fact]))),
    format(string(Line), "begin example ~w", [Facts]).
world_line(World, Line) :-
    format(string(Line), "choose world pack ~w", [World]).

%   The first sentence of the comment at the beginning.
about(Text, About) :-
    split_string(Text, "\n", "", Lines),
    comment(Lines, Words0),
    atomic_list_concat(Words0, ' ', Words),
    (   sub_atom(Words, Before, _, _, '. ')
    ->  sub_atom(Words, 0, Before, _, Sentence)
    ;   Sentence = Words
    ),
    atom_concat(Sentence, '.', About0),
    atomic_list_concat(Parts, '..', About0),
    atomic_list_concat(Parts, '.', About).

comment([Line|Lines], [Words|Rest]) :-
    string_concat("%", Words0, Line),
    !,
    split_string(Words0, "", " ", [Words]),
    comment(Lines, Rest).
comment(_, []).
