% docs/predicates.md has all predicates, and the examples that papers name are there.
% What they show of the prompt and the shell is played by tests/sessions/play.py.

:- use_module('../support/simulation').
:- use_module('../support/dev', [picture/1]).
% They run in another directory.
:- working_directory(Home, Home),
   atom_concat(Home, prolog, Library),
   asserta(user:file_search_path(library, Library)).

:- begin_tests(readme).
test(the_face_is_the_picture_beside_it, true(Drawn == Kept)) :-
    read_file_to_string('docs/predicates.md', Text, []),
    sub_string(Text, Start, _, _, "face :-"),
    sub_string(Text, Start, _, 0, Rest),
    setup_call_cleanup(open_string(Rest, In), read(In, (face :- Face)), close(In)),
    !,
    with_sim(room,
             ( call(Face),
               picture(Drawn),
               screen_clear, screen_image(0, 0, 'tests/pictures/face.png'),
               screen_show,
               picture(Kept) )).
test(the_readme_is_short) :-
    read_file_to_string('README.md', Text, []),
    split_string(Text, "\n", "", Lines),
    length(Lines, Count),
    assertion(Count =< 151).
test(each_example_of_rules_is_played, true(Without == [])) :-
    read_file_to_string('docs/reactive.md', Text, []),
    expand_file_name('examples/rules_*.pl', Files),
    findall(Example,
            ( member(Example, ['examples/plnxt_program.pl'|Files]),
              atom_concat('$ swipl ', Example, Command),
              \+ sub_string(Text, _, _, _, Command) ),
            Without).
test(each_example_it_names_is_there, [forall(named_example(File))]) :-
    exists_file(File).
test(each_predicate_is_in_the_table, true(Missing == [])) :-
    read_file_to_string('docs/predicates.md', Text, []),
    findall(Name/Arity,
            ( member(Library, [ev3dev, drive, events, rules, layers, plnxt, golog,
                               odometry, calibrate, grid,
                               planners, roadmap, navigation, sim]),
              ( Library == ev3dev -> Alias = ev3dev ; Alias = ev3dev/Library ),
              absolute_file_name(library(Alias), File,
                                 [file_type(prolog), access(read)]),
              load_files(File, [if(not_loaded), imports([])]),
              module_property(Module, file(File)),
              module_property(Module, exports(Exports)),
              member(Name/Arity, Exports),
              \+ named(Text, Name)
            ),
            Missing).

%   Name stands there, not as a part of another one.

named(Text, Name) :-
    sub_string(Text, Before, Length, _, Name),
    After is Before + Length,
    \+ ( Before > 0, B is Before - 1, sub_atom(Text, B, 1, _, C),
         char_type(C, csym) ),
    \+ ( sub_atom(Text, After, 1, _, C), char_type(C, csym) ),
    !.

named_example(File) :-
    read_file_to_string('README.md', Text, []),
    sub_string(Text, Start, _, _, "EXAMPLE="),
    From is Start + 8,
    sub_string(Text, From, _, 0, Rest),
    split_string(Rest, "` \n", "", [Name|_]),
    atomic_list_concat(['examples/', Name, '.pl'], File).
:- end_tests(readme).
