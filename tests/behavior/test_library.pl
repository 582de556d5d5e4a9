:- use_module('../support/trees').
:- use_module('../support/child').
:- use_module('../support/libraries').

% ---------------- EXPORTS

:- begin_tests(exports).
% The names are in docs/predicates.md, compared with them by `make lint`.
test(library_ev3dev_has_all_of_its_parts, true(Missing-More == []-[])) :-
    findall(P, ( part(Name), public_export(Name, P) ), Expected),
    findall(P, public_export(ev3dev, P), Found),
    subtract(Expected, Found, Missing),
    subtract(Found, Expected, More).
test(each_export_of_each_library_is_defined,
     [ forall(public_library(Library)), true(Missing == []) ]) :-
    module_of(Library, Module),
    findall(Name/Arity,
            ( public_export(Library, Name/Arity),
              functor(Head, Name, Arity),
              \+ ( member(Is, [defined, imported_from(_), number_of_clauses(_)]),
                   predicate_property(Module:Head, Is) ) ),
            Missing).

%   A library that private/load/core.pl hands on.

part(Name) :-
    module_property(ev3dev_core, file(Core)),
    read_file_to_terms(Core, Terms, []),
    ( member((:- reexport(Spec)), Terms) ; member((:- reexport(Spec, _)), Terms) ),
    atom_concat('../../', Name, Spec).

module_of(Library, Module) :-
    (   Library == ev3dev
    ->  Module = ev3dev
    ;   use_module(library(ev3dev/Library), []),
        atom_concat(ev3dev_, Library, Module)
    ).
:- end_tests(exports).

% ---------------- LOADING

:- begin_tests(loading).
test(prints_nothing, true(Status-Output == exit(0)-"")) :-
    run_program(":- use_module(library(ev3dev)).", [], Status, Output).
test(works_from_any_folder, true(Status-Output == exit(0)-"ok")) :-
    run_program(":- use_module(library(ev3dev)).
                 main :- ( tacho_motor(nothing) -> true ; write(ok) ).",
                [goal(main), cwd('/')], Status, Output).
test(each_library_loads_alone,
     [ forall(( public_library(Layer), Layer \== ev3dev )),
       true(Status-Output == exit(0)-"") ]) :-
    format(string(Program), ":- use_module(library(ev3dev/~w)).", [Layer]),
    run_program(Program, [], Status, Output).
%   What is compiled is not read with pldoc_collecting.
test(sources_load_in_silence_whatever_the_flags,
     [ forall(( member(Flag, [iso, optimise]), \+ prolog_itself_complains(Flag) )),
       true(Status-Output == exit(0)-"") ]) :-
    findall(Text, ( public_library(Library), Library \== ev3dev,
                    format(string(Text), ":- use_module(library(ev3dev/~w), []).\n", [Library]) ),
            Texts),
    atomics_to_string([":- create_prolog_flag(pldoc_collecting, true, []).
                        :- set_prolog_flag(", Flag, ", true).\n"|Texts], Program),
    run_program(Program, [], Status, Output).
%   Libraries of 7.2.3 do not load with this flag.
prolog_itself_complains(iso) :-
    current_prolog_flag(version, Version),
    Version < 80000.
% The simulator is not a directory.
test(takes_the_tree_from_the_environment,
     [ forall(of_files(Tree)), true(Status-Output == exit(0)-"[outA,outB,outC,outD]") ]) :-
    with_tree(Tree, ( tree_root(Root),
                      run_program(":- use_module(library(ev3dev)).
                                   main :- findall(P, tacho_motor(P), Ps), print(Ps).",
                                  [goal(main), env('EV3DEV_SYSFS'=Root)],
                                  Status, Output) )).
test(an_empty_environment_is_none,
     [ forall(member(Variable-Query-Default,
                     [ 'EV3DEV_SYSFS'-ev3_sysfs-"/sys/class",
                       'EV3DEV_DEV'-ev3_dev-"/dev" ])),
       true(Status-Output == exit(0)-Default) ]) :-
    tells_directory(Query, Program),
    run_program(Program, [goal(main), env(Variable='')], Status, Output).
% There is a directory of that name beside the library's own files, too.
test(the_environment_is_relative_to_the_working_directory,
     [ forall(member(Variable-Query, [ 'EV3DEV_SYSFS'-ev3_sysfs,
                                       'EV3DEV_DEV'-ev3_dev ])),
       true(Status-Output == exit(0)-Expected) ]) :-
    tmp_file(home, Home),
    atom_concat(Home, '/worlds', Directory),
    atom_string(Directory, Expected),
    tells_directory(Query, Program),
    setup_call_cleanup(
        make_directory_path(Directory),
        run_program(Program, [goal(main), cwd(Home), env(Variable=worlds)],
                    Status, Output),
        delete_directory_and_contents(Home)).
test(an_environment_that_names_no_directory_is_an_error, true(Named == true)) :-
    run_program(":- use_module(library(ev3dev)).",
                [env('EV3DEV_SYSFS'='/nowhere/at/all')], Status, Output),
    % Before version 9, an error while loading leaves the status alone.
    (   current_prolog_flag(version, Version), Version < 90000
    ->  true
    ;   assertion(Status \== exit(0))
    ),
    ( sub_string(Output, _, _, _, "/nowhere/at/all") -> Named = true ; Named = Output ).

tells_directory(Query, Program) :-
    format(string(Program),
           ":- use_module(library(ev3dev)).
            main :- ~q(Directory), write(Directory).", [Query]).
:- end_tests(loading).

% ---------------- NATIVE PREDICATES

:- begin_tests(natives).
test(private_native_exports_what_the_library_registers, true(Registered == Exports)) :-
    findall(Name/Arity,
            ( predicate_property(ev3dev_native:Head, foreign),
              \+ predicate_property(ev3dev_native:Head, imported_from(_)),
              functor(Head, Name, Arity) ),
            Registered0),
    sort(Registered0, Registered),
    exports(Exports).

exports(Exports) :-
    module_property(ev3dev_native, exports(Exports0)),
    sort(Exports0, Exports).
:- end_tests(natives).

% ---------------- THE BINARY

% A dynamic library names those that it needs in its string table.
:- begin_tests(binary).
test(needs_no_libswipl, true(Needs == none)) :-
    ev3dev_library_file:library_file(File),
    read_file_to_string(File, Bytes, [encoding(octet)]),
    (   sub_string(Bytes, _, _, _, "libswipl.so")
    ->  Needs = libswipl
    ;   Needs = none
    ).
:- end_tests(binary).
