% Each example loads without a word, each in a program of its own; none of its
% names is that of a library that may be loaded beside it; `make demo` starts it.

:- use_module('../support/child').

:- begin_tests(examples).
loads(File, Goal, Said, End) :-
    format(atom(Text), "~q", [Goal]),
    (   getenv('SWIPL', Swipl)
    ->  true
    ;   current_prolog_flag(executable, Swipl)
    ),
    process_create(path(env),
                   [ Swipl, '-q', '-p', 'library=prolog', '-l', file(File),
                     '-g', Text, '-t', halt ],
                   [stdin(null), stderr(pipe(Out)), process(Id)]),
    read_string(Out, _, Said),
    close(Out),
    process_wait(Id, End).

test(loads_without_a_word_beside_any_library_and_has_its_start,
     [ forall(example(File)),
       setup(load_files(demo_script:'tools/demo.pl', [if(not_loaded)])),
       true(Said-End == ""-exit(0))
     ]) :-
    file_base_name(File, Base),
    file_name_extension(Name, _, Base),
    (   demo_script:part_of(Name, Program)
    ->  true
    ;   Program = Name
    ),
    (   demo_script:demo(Program, _, Goal)
    ->  true
    ;   Goal = start
    ),
    strip_module(user:Goal, Module, Start),
    atomic_list_concat(['examples/', Program, '.pl'], Example),
    loads(File,
          ( load_files(Example, [if(not_loaded)]),
            maplist(use_module, [ library(ev3dev/drive),
                                  library(ev3dev/golog),
                                  library(ev3dev/rules),
                                  library(ev3dev/plnxt),
                                  library(ev3dev/grid),
                                  library(ev3dev/planners),
                                  library(ev3dev/roadmap),
                                  library(ev3dev/sim) ]),
            predicate_property(Module:Start, defined) ),
          Said, End).

%   At the toplevel it would wait for a key, and to the view a program would
%   run. An example that does not end by itself is left.

test(leaves_no_choice_point,
     [ forall(( example(File), program(File, Name) )),
       true(Status-Found == exit(0)-"") ]) :-
    absolute_file_name(File, Path),
    format(string(Goal), "find(~q, ~q)", [Name, Path]),
    run_program(
        ":- use_module(library(ev3dev)).
         :- use_module(library(ev3dev/sim)).
         :- absolute_file_name('tools/demo.pl', File),
            load_files(demo:File, []).
         find(Name, File) :-
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
             demo:prepare(Name),
             with_output_to(string(_), for_seconds(100, called(Goal, Left))),
             (   Left == true
             ->  write(Goal)
             ;   true
             ).
         called(Goal, Left) :-
             call_cleanup(Goal, Ended = true),
             (   Ended == true
             ->  true
             ;   Left = true
             ).",
        [goal(Goal)], Status, Found).

program(File, Name) :-
    file_base_name(File, Base),
    file_name_extension(Name, _, Base),
    % Two are parts of programs; the robot of the third is another process.
    \+ memberchk(Name, [grid_planner, plnxt, far_grid]).

example(File) :-
    expand_file_name('examples/*.pl', Files),
    member(File, Files).
:- end_tests(examples).
