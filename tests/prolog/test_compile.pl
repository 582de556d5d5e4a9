% What ev3dev_compile/0 makes is used where it is good, and never where not.


:- prolog_load_context(directory, Tests),
   atom_concat(Tests, '/../..', Up),
   absolute_file_name(Up, Home, [file_type(directory)]),
   assertz(pack_under_test(Home)).

:- use_module('../../prolog/ev3dev/private/help/libraries', [in_library/2]).

:- dynamic
    pack_under_test/1,
    copy/1.

% ---------------- PACKS

% A copy of the pack in a folder of its own.
make_copy :-
    pack_under_test(Home),
    tmp_file(compile, Pack),
    make_directory(Pack),
    command(cp, ['-R', file(Home/prolog), file(Pack)]),
    forall(( member(Folder, [lib, native]),
             directory_file_path(Home, Folder, From),
             exists_directory(From) ),
           ( directory_file_path(Pack, Folder, To),
             link_file(From, To, symbolic) )),
    assertz(copy(Pack)).

make_compiled_copy :-
    make_copy,
    compiles(0-"").

delete_copy :-
    retract(copy(Pack)),
    command(rm, ['-rf', file(Pack)]).

in_copy(Name, File) :-
    copy(Pack),
    directory_file_path(Pack, Name, File).

command(Name, Arguments) :-
    process_create(path(Name), Arguments, [process(Pid)]),
    process_wait(Pid, exit(0)).

% The pack's compiled unit of that name.
unit_file(Name, File) :-
    atomic_list_concat(['compiled/*/*/', Name, '.qlf'], Pattern0),
    in_copy(Pattern0, Pattern),
    expand_file_name(Pattern, Files),
    Files = [File].

index_file(Index) :-
    in_copy('compiled/*/index', Pattern),
    expand_file_name(Pattern, [Index]).

% Call Goal while File is another one; then it is as it was.
meanwhile(File, Change, Goal) :-
    atom_concat(File, '.kept', Kept),
    setup_call_cleanup(
        command(cp, ['-a', file(File), file(Kept)]),
        ( call(Change, File), call(Goal) ),
        command(mv, ['-f', file(Kept), file(File)])).

old(File) :-
    command(touch, ['-t', '200101010000', file(File)]).

empty(File) :-
    with_contents(File, []).

halved(File) :-
    contents(File, Bytes),
    length(Bytes, Length),
    Half is Length//2,
    length(Front, Half),
    append(Front, _, Bytes),
    with_contents(File, Front).

garbled(File) :-
    contents(File, Bytes0),
    length(Bytes0, Length),
    Half is Length//2,
    length(Front, Half),
    append(Front, [Byte0|Back], Bytes0),
    Byte is Byte0 xor 0x55,
    append(Front, [Byte|Back], Bytes),
    with_contents(File, Bytes).

as_it_is(_).

of_another_prolog(File) :-
    setup_call_cleanup(
        open(File, read, In),
        read(In, index(prolog(Version, _, Home, Mode), Pack, Units)),
        close(In)),
    setup_call_cleanup(
        open(File, write, Out),
        format(Out, '~q.~n', [index(prolog(Version, never, Home, Mode), Pack, Units)]),
        close(Out)).

contents(File, Bytes) :-
    read_file_to_codes(File, Bytes, [encoding(octet)]).

with_contents(File, Bytes) :-
    setup_call_cleanup(
        open(File, write, Out, [encoding(octet)]),
        format(Out, '~s', [Bytes]),
        close(Out)).

% ---------------- PROCESSES

% run(+Goal, -Result): Result is what a Prolog that finds the copy printed, and
% its status before it.
run(Goal, Result) :-
    start(Goal, Child),
    end(Child, Result).

start(Goal, Pid-Out) :-
    in_copy(prolog, Library),
    format(atom(Text),
           "asserta(user:file_search_path(library, ~q)), ~w, halt",
           [Library, Goal]),
    (   getenv('SWIPL', Swipl)
    ->  true
    ;   current_prolog_flag(executable, Swipl)
    ),
    process_create(path(env), [Swipl, '-q', '-f', none, '-g', Text, '-t', 'halt(7)'],
                   [ process(Pid), stdin(null), stdout(pipe(Out)),
                     stderr(pipe(Out)) ]).

end(Pid-Out, Status-Text) :-
    read_stream_to_codes(Out, Codes),
    close(Out),
    process_wait(Pid, exit(Status)),
    string_codes(Text, Codes).

compile_goal("use_module(library(ev3dev/compile)), ev3dev_compile").

compiles(Result) :-
    compile_goal(Goal),
    run(Goal, Result).

% Where library(ev3dev) comes from
origin(Origin) :-
    origin("use_module(library(ev3dev))", Origin).

origin(Loading, Origin) :-
    format(string(Goal),
           "~s, (ev3dev_compiled:used(_) -> write(compiled) ; write(sources)), \c
            \\+ tacho_motor(nothing)",
           [Loading]),
    run(Goal, Status-Origin0),
    (   Status == 0
    ->  Origin = Origin0
    ;   Origin = Status-Origin0
    ).

same_compiled_or_not(Goal) :-
    run(Goal, Compiled),
    index_file(Index),
    meanwhile(Index, empty, run(Goal, Sources)),
    Compiled = Status-_,
    assertion(Status == 0),
    assertion(Compiled == Sources).

:- begin_tests(compile, [setup(make_compiled_copy), cleanup(delete_copy)]).
test(is_used, Origin == "compiled") :-
    origin(Origin).
test(is_used_by_an_absolute_name, Origin == "compiled") :-
    in_copy('prolog/ev3dev', File),
    format(string(Loading), "use_module(~q)", [File]),
    origin(Loading, Origin).
test(is_used_for_the_libraries_beside, Result == 0-"core drive grid ") :-
    run("use_module(library(ev3dev)), use_module(library(ev3dev/grid)),
         forall(( member(U, [core, drive, grid, roadmap]),
                  ev3dev_compiled:used(F), file_name_extension(B, _, F),
                  file_base_name(B, U) ),
                format('~w ', [U]))", Result).
test(is_used_by_a_library_that_is_loaded_first,
     [ forall(member(Library-Units,
                     [ drive-[core, drive_parts],
                       grid-[core, drive, planners_parts, grid_parts],
                       planners-[core, planners_parts, comparison],
                       roadmap-[core, drive, facts, roadmap_parts],
                       sim-[core, facts, sim_parts],
                       console-[core], jog-[core], colors-[core], raw-[core],
                       events-[core], rules-[core, events],
                       layers-[core],
                       plnxt-[core, drive_parts, drive, events] ])),
       true(Result == 0-Used) ]) :-
    format(string(Goal),
           "use_module(library(ev3dev/~w)),
            forall(( member(U, ~q), ev3dev_compiled:used(F),
                     file_name_extension(B, _, F), file_base_name(B, U) ),
                   format('~~w ', [U]))", [Library, Units]),
    atomic_list_concat(Units, ' ', Joined),
    string_concat(Joined, " ", Used),
    run(Goal, Result).
test(is_used_by_each_library_that_is_loaded_first,
     [ forall(( in_library(Library, _), Library \== compile )),
       true(Result == 0-"compiled") ]) :-
    format(string(Goal),
           "use_module(library(ev3dev/~w)),
            ( current_predicate(ev3dev_compiled:used/1), ev3dev_compiled:used(_) ->
                  write(compiled) ; write(sources) )",
           [Library]),
    run(Goal, Result).
test(each_library_that_is_loaded_first_is_in_a_unit, true(Result == 0-"")) :-
    run("use_module(library(ev3dev/compile)), use_module(library(ev3dev/private/help/libraries)),
         forall(( in_library(L, _), L \\== compile, atom_concat('ev3dev/', L, E),
                  \\+ ( ev3dev_compile:unit(_, Es), '$member'(E, Es) ) ),
                format('~w ', [L]))", Result).
test(has_the_same_exports) :-
    same_compiled_or_not(
        "use_module(library(ev3dev)), module_property(ev3dev, exports(Es)),
         msort(Es, Sorted), print(Sorted)").
test(knows_where_its_sources_are) :-
    same_compiled_or_not(
        "use_module(library(ev3dev)),
         forall(member(G, [go(_), motor_run(_,_,_), touch(_,_)]),
                ( predicate_property(G, file(F)),
                  predicate_property(G, line_count(L)), print(F:L), nl ))").
test(has_the_same_errors) :-
    same_compiled_or_not(
        "use_module(library(ev3dev)), use_module(library(ev3dev/drive)),
         forall(member(G, [motor_run(outB, foo), motor_run(outB, 1, 1, [x]),
                           led(left, blu), go_cm(a, 1, []), battery(volts, _)]),
                ( catch(G, E, true), print(E), nl ))").
test(explains_what_is_missing, true) :-
    run("use_module(library(ev3dev)), debug(ev3dev), \\+ led(nowhere, red)",
        Status-Text),
    assertion(Status == 0),
    assertion(sub_string(Text, _, _, _, "there is no light nowhere")),
    assertion(\+ sub_string(Text, _, _, _, "topic")).
test(is_not_gone_into_by_the_tracer, Result == 0-"") :-
    run("use_module(library(ev3dev)), use_module(library(ev3dev/grid)),
         use_module(library(ev3dev/sim)), sensor_type('lego-ev3-us', _),
         forall(( current_module(M), sub_atom(M, 0, _, _, ev3dev),
                  current_predicate(M:N/A), functor(H, N, A),
                  \\+ predicate_property(M:H, imported_from(_)),
                  \\+ predicate_property(M:H, dynamic),
                  \\+ predicate_property(M:H, nodebug) ),
                ( print(M:N/A), nl ))", Result).
test(is_found_by_make_after_an_edit, true(Status-Said == 0-true)) :-
    in_copy('prolog/ev3dev/motors.pl', File),
    format(string(Goal),
           "use_module(library(ev3dev)), F = ~q, source_file_property(F, modified(T0)),
            shell('touch -d tomorrow ~w'), make, source_file_property(F, modified(T)),
            ( T > T0 -> write(true) ; write(T0-T) )", [File, File]),
    meanwhile(File, as_it_is, run(Goal, Status-Text)),
    (   sub_string(Text, _, _, 0, "true")     % behind what make/0 has to say
    ->  Said = true
    ;   Said = Text
    ).
test(works_in_two_threads_at_once, Result == 0-"truetrue") :-
    run("findall(T, ( member(_, [1,2]),
                      thread_create(( use_module(library(ev3dev)),
                                      \\+ ev3dev:tacho_motor(nothing) ), T, []) ), Ts),
         forall(member(T, Ts), ( thread_join(T, S), write(S) ))", Result).
test(works_in_a_saved_state, Result == 0-"nothing") :-
    in_copy(state, State),
    format(string(Goal),
           "use_module(library(ev3dev)), use_module(library(ev3dev/drive)),
            qsave_program(~q, [toplevel(halt), goal((tacho_motor(nothing) -> true ;
                                       write(nothing)))])", [State]),
    run(Goal, Saved),
    assertion(Saved == 0-""),
    (   getenv('SWIPL', Swipl)
    ->  true
    ;   current_prolog_flag(executable, Swipl)
    ),
    process_create(path(env), [Swipl, '-x', file(State)],
                   [ process(Pid), stdin(null), stdout(pipe(Out)),
                     stderr(pipe(Out)) ]),
    end(Pid-Out, Result).

% Stale or broken

test(is_not_used_after_a_source_changed, Origins == "sources"-"compiled") :-
    in_copy('prolog/ev3dev/private/grid/map.pl', File),
    meanwhile(File, old, origin(Origin)),
    origin(After),
    Origins = Origin-After.
test(is_not_used_by_another_prolog, Origin == "sources") :-
    index_file(Index),
    meanwhile(Index, of_another_prolog, origin(Origin)).
test(is_not_used_elsewhere, Origin == "sources") :-
    copy(Pack),
    atom_concat(Pack, '-moved', Moved),
    setup_call_cleanup(
        ( rename_file(Pack, Moved), retract(copy(Pack)), assertz(copy(Moved)) ),
        origin(Origin),
        ( rename_file(Moved, Pack), retract(copy(Moved)), assertz(copy(Pack)) )).
test(is_not_used_if_it_is_broken,
     [ forall(member(Change, [empty, halved, garbled, delete_file])),
       true(Origin == "sources") ]) :-
    unit_file(core, File),
    meanwhile(File, Change, origin(Origin)).
test(the_rest_is_used_if_a_unit_is_broken, Origin == "compiled") :-
    unit_file(drive, File),
    meanwhile(File, garbled,
              origin("use_module(library(ev3dev)), use_module(library(ev3dev/grid))",
                     Origin)).
test(is_not_used_without_a_good_index,
     [ forall(member(Change, [empty, halved, delete_file])),
       true(Origin == "sources") ]) :-
    index_file(Index),
    meanwhile(Index, Change, origin(Origin)).
test(is_not_used_while_comments_are_collected,
     [ condition(exists_source(library(pldoc))), Origin == "sources" ]) :-
    origin("use_module(library(pldoc)), use_module(library(pldoc/doc_process)), \c
            doc_collect(true), use_module(library(ev3dev))", Origin).
test(is_not_used_if_sources_are_loaded_already, Origin == "sources") :-
    origin("use_module(library(ev3dev/motors)), use_module(library(ev3dev))", Origin).

% Making it

test(is_made_again_after_an_upgrade, Origins == "sources"-"compiled") :-
    in_copy('prolog/ev3dev/motors.pl', File),
    meanwhile(File, old,
              ( origin(Before), compiles(0-""), origin(After) )),
    compiles(0-""),
    Origins = Before-After.
test(leaves_nothing_of_the_last_time, Count == 1) :-
    compiles(0-""),
    in_copy('compiled/*/*/core.qlf', Pattern),
    expand_file_name(Pattern, Files),
    length(Files, Count).
test(is_made_by_two_at_once, Results-Origin == [0-"", 0-""]-"compiled") :-
    compile_goal(Goal),
    start(Goal, Child1),
    start(Goal, Child2),
    end(Child1, Result1),
    end(Child2, Result2),
    Results = [Result1, Result2],
    origin(Origin).
test(is_made_where_its_own_libraries_are_loaded, Results == (0-"")-"compiled") :-
    compile_goal(Compile),
    format(string(Goal),
           "use_module(library(lists)), use_module(library(assoc)), \c
            use_module(library(prolog_pack)), ~s", [Compile]),
    run(Goal, Result),
    origin("use_module(library(ev3dev)), use_module(library(ev3dev/grid))", Origin),
    Results = Result-Origin.
test(is_not_made_by_who_has_loaded_the_pack, Found == 0-permission_error) :-
    run("use_module(library(ev3dev)), use_module(library(ev3dev/compile)),
         catch(ev3dev_compile, error(E, _), ( functor(E, N, _), write(N) ))",
        Status-Text),
    atom_string(Atom, Text),
    Found = Status-Atom.
:- end_tests(compile).

:- begin_tests(compile_not, [setup(make_copy), cleanup(delete_copy)]).
test(then_the_sources_are_used, Origin == "sources") :-
    origin(Origin).
test(a_folder_that_cannot_be_written_is_an_error,
     true(Origin == "sources")) :-
    in_copy(compiled, File),
    with_contents(File, []),
    compiles(Status-Text),
    assertion(Status \== 0),
    assertion(sub_string(Text, _, _, _, "compiled")),
    origin(Origin).
:- end_tests(compile_not).
