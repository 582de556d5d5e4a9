% With the recorder of library(ev3dev/reasoning), each example and each solution
% of the course does the same, and at the same moments.

:- use_module('../support/child').

:- begin_tests(reasoning_examples).
test(what_happens_is_the_same,
     [ forall(program(File, Name)), true(Status-Recorded == exit(0)-Plain) ]) :-
    run(File, Name, Goal, Goal, exit(0), Plain),
    run(File, Name, Goal, reasoning(Goal), Status, Recorded).

run(File, Name, Goal, Called, Status, Said) :-
    absolute_file_name(File, Path),
    format(string(Query), "trace_of(~q, ~q, ~q, ~q)",
           [Name, Path, Goal, Called]),
    run_program(
        ":- use_module(library(ev3dev)).
         :- use_module(library(ev3dev/sim)).
         :- use_module(library(ev3dev/reasoning)).
         :- absolute_file_name('tools/demo.pl', File),
            load_files(demo:File, []).
         trace_of(Name, File, Goal, Called) :-
             user:load_files(File, []),
             (   demo:demo(Name, World, Goal)
             ->  true
             ;   World = room,
                 Goal = start
             ),
             (   demo:robot(Name, Robot)
             ->  true
             ;   Robot = default
             ),
             sim_start(World, [clock(virtual), robot(Robot)]),
             ignore(demo:prepare(Name)),
             set_random(seed(7)),
             with_output_to(string(_), ignore(for_seconds(10, Called))),
             sim_trace(Trace),
             length(Trace, Length),
             variant_sha1(Trace, Sum),
             print(Length-Sum).",
        [goal(Query)], Status, Said).

%   Two are parts of programs, the robot of the third is another process, and
%   the fourth prints how long it has computed.

program(File, Name) :-
    expand_file_name('examples/*.pl', Files),
    member(File, Files),
    file_base_name(File, Base),
    file_name_extension(Name, _, Base),
    \+ memberchk(Name, [grid_planner, plnxt, far_grid, compare_planners]).
program(File, Name) :-
    expand_file_name('course/*/solution.pl', Files),
    member(File, Files),
    file_directory_name(File, Folder),
    file_base_name(Folder, Name).
:- end_tests(reasoning_examples).
