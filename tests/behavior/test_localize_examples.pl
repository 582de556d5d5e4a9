% The examples of robots that find out where they are do so.

:- use_module('../support/trees').
:- use_module(library(ev3dev/drive)).
:- use_module(library(ev3dev/rules), [after/2]).

:- initialization(( load_files(lost:example(lost), []),
                    load_files(grid_lost:example(grid_lost), []),
                    load_files(explore_room:example(explore_room), []) )).

:- meta_predicate lines(+, 0, -).

%   What Goal prints in a world with noise.
lines(World, Goal, Lines) :-
    with_output_to(string(Text), with_sim(World, Goal, [noise(true), seed(3)])),
    split_string(Text, "\n", "\n", Lines).

is_near(X, Y, Within) :-
    sim_pose(X1, Y1, _),
    sqrt((X-X1)**2 + (Y-Y1)**2) < Within.

begins(Line, Prefix) :-
    sub_string(Line, 0, _, _, Prefix).

:- begin_tests(localize_examples).
test(lost_in_the_room, Ends == ["at 40, 210", "at 250, 40"]) :-
    lines(room, ( sim_place(120, 80, 200),
                  lost:start([40-210, 250-40]),
                  is_near(250, 40, 8) ), [First|Ends]),
    begins(First, "I am at 120, 80 and look to ").
test(carried_away_it_finds_out_again, true) :-
    lines(room, ( sim_place(60, 60, 0),
                  after(20, sim_place(250, 190, 90)),
                  lost:start([40-210, 250-40]),
                  is_near(250, 40, 8) ), Lines),
    assertion(memberchk("Where am I?", Lines)),
    last(Lines, "at 250, 40").
%   It says where it is when it knows, and goes from there.
test(unknown_cell_of_the_grid,
     [forall(member(At, [pose(80, 100, 90), pose(140, 0, 0), pose(20, 80, 270)]))]) :-
    At = pose(X, Y, Heading),
    lines(grid, ( sim_place(X, Y, Heading),
                  grid_lost:start([0, 0]),
                  is_near(0, 0, 5) ), Lines),
    last(Lines, Line),
    assertion(begins(Line, "I am in [")).
test(explores_draws_the_map_and_goes_home, Last == "at home") :-
    tmp_file(explored, File),
    lines(room, ( sim_pose(X, Y, _),
                  explore_room:start(File),
                  is_near(X, Y, 8) ), Lines),
    last(Lines, Last),
    forall(member(Extension, [svg, pl]),
           ( file_name_extension(File, Extension, Made),
             size_file(Made, Size),
             assertion(Size > 1000),
             delete_file(Made) )).
:- end_tests(localize_examples).
